//! README and book: their links lead somewhere, their sentences are short, every page is in the summary, and commands,
//! options, outputs and members of files are those of the program.

use std::collections::{BTreeMap, BTreeSet};
use std::path::PathBuf;

use loftsman::internals::config::{DERIVE_KEYS, JOB_KEYS, KEYS, Key, METHOD_KEYS, TABLE_KEYS};
use loftsman::internals::hydrostatics::QUANTITIES;

use serde_json::Value;

use crate::support::{Folder, carried, command, commands, files_of, folder, json, program, read_text, stderr, stdout};

/// Most words of a sentence.
const WORDS: usize = 40;

/// Most lines of the README.
const LINES: usize = 120;

/// README, the documents beside it and all pages of the book.
fn documents() -> Vec<PathBuf> {
    let mut documents = vec![carried("README.md")];
    documents.extend(["ARCHITECTURE.md", "CONTRIBUTING.md", "RELEASING.md"].map(carried));
    documents.extend(files_of(&carried("docs/src"), "md"));
    documents
}

/// The links of a text that are not of the web: `[words](target)` outside of code blocks.
fn links(text: &str) -> Vec<String> {
    let mut block = false;
    let mut found = Vec::new();
    for line in text.lines() {
        block ^= line.starts_with("```");
        let targets = line.split("](").skip(1).filter_map(|rest| rest.split(')').next());
        found.extend(targets.filter(|target| !block && !target.contains("://")).map(ToOwned::to_owned));
    }
    found
}

/// Sentences of a text without its code blocks: of paragraphs, of items of lists and of cells of tables.
fn sentences(text: &str) -> Vec<String> {
    let mut pieces = vec![String::new()];
    let mut block = false;
    for line in text.lines() {
        let fence = line.trim_start().starts_with("```");
        let own = fence || block || line.trim().is_empty() || line.starts_with(['#', '|']);
        let item = line.trim_start().starts_with("* ") || line.trim_start().starts_with("- ");
        if own || item {
            pieces.push(String::new());
        }
        block ^= fence;
        if line.starts_with('|') && !block {
            pieces.extend(line.split('|').map(ToOwned::to_owned));
            pieces.push(String::new());
        } else if !own && let Some(last) = pieces.last_mut() {
            last.push(' ');
            last.push_str(line.trim());
        }
    }
    let ends = |piece: &String| {
        let marked = [". ", "? ", "! ", ": "].iter().fold(piece.clone(), |text, end| text.replace(end, ".\n"));
        marked.lines().map(ToOwned::to_owned).collect::<Vec<_>>()
    };
    pieces.iter().flat_map(ends).collect()
}

/// What is too long, by the name of its file.
fn long(name: &str, text: &str) -> Vec<String> {
    let words = |sentence: &String| sentence.split_whitespace().count();
    let too_long = sentences(text).into_iter().filter(|sentence| words(sentence) > WORDS);
    too_long.map(|sentence| format!("{name}: {} words: {}", words(&sentence), sentence.trim())).collect()
}

#[test]
fn links_lead_somewhere() {
    for document in documents() {
        let folder = document.parent().unwrap();
        for link in links(&read_text(&document)) {
            let file = link.split('#').next().unwrap_or_default();
            assert!(folder.join(file).exists(), "{}: {link}", document.display());
        }
    }
}

#[test]
fn every_page_is_in_the_summary() {
    let folder = carried("docs/src");
    let listed: Vec<PathBuf> =
        links(&read_text(folder.join("SUMMARY.md"))).iter().map(|link| folder.join(link)).collect();
    let pages: Vec<PathBuf> =
        files_of(&folder, "md").into_iter().filter(|page| !page.ends_with("SUMMARY.md")).collect();
    assert!(pages.len() > 15);
    for page in pages {
        assert_eq!(listed.iter().filter(|other| **other == page).count(), 1, "{}", page.display());
    }
}

#[test]
fn the_readme_is_short_and_no_sentence_is_long() {
    let lines = read_text(carried("README.md")).lines().count();
    assert!(lines <= LINES, "README.md: {lines} lines");
    let faults: Vec<String> =
        documents().iter().flat_map(|document| long(&document.display().to_string(), &read_text(document))).collect();
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn no_sentence_of_the_help_is_long() {
    let faults: Vec<String> = commands()
        .into_iter()
        .flat_map(|command| {
            // An option begins further out than what is said of it.
            let text =
                stdout(&program(&["help", &command])).replace("\n  -", "\n\n  -").replace("\n      -", "\n\n      -");
            // Items of a list end at semicolons.
            let text = text.replace(';', ".");
            long(&command, &text)
        })
        .collect();
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

/// A page of keys, a table of them for each table of the file.
fn keys(title: &str, about: &str, keys: &[Key]) -> String {
    let mut page = format!("# {title}\n\n{about}\n");
    let mut tables: Vec<&str> = Vec::new();
    for key in keys {
        if !tables.contains(&key.table) {
            tables.push(key.table);
        }
    }
    for table in tables {
        let head = if table.is_empty() { "At the top of the file".to_owned() } else { format!("`[{table}]`") };
        page.push_str(&format!("\n## {head}\n\n| key | value | meaning |\n|---|---|---|\n"));
        for key in keys.iter().filter(|key| key.table == table) {
            let families = match key.families {
                [] => String::new(),
                families => format!(" Family {}.", families.join(", ")),
            };
            let cell = |text: &str| text.replace('|', "\\|").replace('\n', " ");
            let (kind, meaning) = (cell(&key.kind.words()), cell(key.description));
            page.push_str(&format!("| `{}` | {kind} | {meaning}{families} |\n", key.name));
        }
    }
    page
}

/// Pages that are made from the lists of the program.
fn made() -> [(&'static str, String); 6] {
    let quantities =
        QUANTITIES.iter().map(|q| format!("| `{}` | {} | {} | {} |\n", q.key, q.name, q.unit, q.definition));
    let quantities = quantities.collect::<String>();
    [
        (
            "design-keys",
            keys("Keys of the design file", "`generate` reads them; `loftsman new` prints them with comments.", KEYS),
        ),
        (
            "job-keys",
            keys("Keys of the job file", "`fair` reads them; options of the command override them.", JOB_KEYS),
        ),
        (
            "derive-keys",
            keys(
                "Keys of the job file of derive",
                "`derive` reads them; options of the command override them.",
                DERIVE_KEYS,
            ),
        ),
        (
            "table-keys",
            keys(
                "Keys of the conventions beside a table",
                "A TOML file of the same name beside a table of offsets or a body. `loftsman schema table` prints its schema.",
                TABLE_KEYS,
            ),
        ),
        ("method-keys", keys("Keys of the method file", "`fit` reads them.", METHOD_KEYS)),
        (
            "quantities",
            format!(
                "# Hydrostatic quantities\n\nKeys are ITTC codes. They head the columns of `hydrostatics.csv` and are the keys of its \
                 JSON.\n\n| key | quantity | unit | definition |\n|---|---|---|---|\n{quantities}"
            ),
        ),
    ]
}

/// `LOFTSMAN_GOLDEN=1` writes them.
#[test]
fn pages_of_lists_are_those_of_the_program() {
    for (name, page) in made() {
        let path = carried("docs/src/reference").join(format!("{name}.md"));
        if std::env::var_os("LOFTSMAN_GOLDEN").is_some() {
            std::fs::write(&path, &page).unwrap();
        }
        assert!(read_text(&path) == page, "{}: LOFTSMAN_GOLDEN=1 writes it anew", path.display());
    }
}

/// Folders of the package that commands of the book read from.
const FOLDERS: [&str; 4] = ["configs/", "tests/", "reports/", "examples/"];

/// A line after a prompt, with the lines below it.
struct Shown {
    command: String,
    output: Vec<String>,
}

/// The commands of the code blocks of a page. A backslash at the end of a line goes on in the next.
fn shown(page: &str) -> Vec<Shown> {
    let mut list: Vec<Shown> = Vec::new();
    let (mut block, mut goes_on) = (false, false);
    for line in page.lines() {
        if line.starts_with("```") {
            block = !block;
            goes_on = false;
            list.push(Shown { command: String::new(), output: Vec::new() });
        } else if block && let Some(last) = list.last_mut() {
            let begins = line.strip_prefix("$ ");
            let text = begins.unwrap_or(line).trim_end_matches('\\');
            if begins.is_some() {
                list.push(Shown { command: text.to_owned(), output: Vec::new() });
            } else if goes_on {
                last.command.push_str(text);
            } else {
                last.output.push(line.to_owned());
            }
            goes_on = (begins.is_some() || goes_on) && line.ends_with('\\');
        }
    }
    list.retain(|shown| !shown.command.is_empty());
    list
}

/// The words of a command; what stands in quotes is one.
fn words_of(command: &str) -> Vec<String> {
    let parts = command.split('"').enumerate();
    let words = parts.flat_map(|(k, part)| match k % 2 {
        0 => part.split_whitespace().map(ToOwned::to_owned).collect::<Vec<String>>(),
        _ => vec![part.to_owned()],
    });
    words.collect()
}

/// A line by its words; what is rounding of nothing is nothing.
fn leveled(line: &str) -> String {
    let word = |word: &str| match word.trim_end_matches([',', ';', '.']).parse::<f64>() {
        Ok(value) if value.abs() < 1e-8 => "0".to_owned(),
        _ => word.to_owned(),
    };
    line.split_whitespace().map(word).collect::<Vec<_>>().join(" ")
}

/// What differs between the outputs of a page and those of the program, which runs in `folder`.
fn differences(name: &str, page: &str, folder: &Folder) -> Vec<String> {
    for file in page.split("```").filter_map(|block| block.split_once(" file=").map(|(_, rest)| rest)) {
        let (name, contents) = file.split_once('\n').unwrap();
        folder.write(name, contents);
    }
    let (mut faults, mut code) = (Vec::new(), None);
    for Shown { command: line, output } in shown(page) {
        let words = words_of(&line);
        let here = |word: &String| {
            let is_carried = FOLDERS.iter().any(|part| word.starts_with(*part));
            if is_carried { carried(word).display().to_string() } else { word.clone() }
        };
        let streams = match words[0].as_str() {
            "loftsman" => {
                let arguments: Vec<String> = words[1..].iter().map(here).collect();
                let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
                let done = command(&arguments).current_dir(folder).output().unwrap();
                code = done.status.code();
                [stdout(&done), stderr(&done)]
            }
            "echo" => [code.unwrap().to_string(), String::new()],
            "head" => [folder.read(&words[2]), String::new()],
            other => panic!("{name}: {other} is no command of the book"),
        };
        let root = carried("").display().to_string();
        let streams = streams.map(|text| text.replace(&root, "").lines().map(leveled).collect::<Vec<_>>());
        let mut at = [0; 2];
        for expected in output.iter().filter(|line| *line != "...") {
            let expected = leveled(expected);
            let found = (0..2).find_map(|k| Some((k, streams[k][at[k]..].iter().position(|l| *l == expected)?)));
            match found {
                Some((k, far)) => at[k] += far + 1,
                None => faults.push(format!("{name}: $ {line}\n  does not print: {expected}")),
            }
        }
    }
    faults
}

#[test]
#[ignore = "takes 30 s"]
fn tutorials_show_what_the_program_prints() {
    let mut pages = files_of(&carried("docs/src/tutorial"), "md");
    let others =
        ["README.md", "docs/src/tour.md", "docs/src/concepts/conventions.md", "docs/src/concepts/differences.md"];
    pages.extend(others.map(carried));
    assert!(pages.len() > 8);
    let mut faults = Vec::new();
    for page in pages {
        let name = page.file_stem().unwrap().display().to_string();
        let text = read_text(&page);
        assert!(!shown(&text).is_empty(), "{name}");
        faults.extend(differences(&name, &text, &folder(&name)));
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn commands_and_options_of_the_pages_are_those_of_the_program() {
    let help: BTreeMap<String, String> =
        commands().into_iter().map(|name| (name.clone(), stdout(&program(&["help", &name])))).collect();
    let of = |text: &str, option: &str| text.split(|c: char| !c.is_alphanumeric() && c != '-').any(|w| w == option);
    let developers = carried("docs/src/developers");
    let (mut faults, mut count) = (Vec::new(), 0);
    for page in documents().into_iter().filter(|page| !page.starts_with(&developers)) {
        let (name, text) = (page.display(), read_text(&page));
        for line in text.lines().map(|line| line.trim_start_matches("$ ")) {
            let Some(rest) = line.strip_prefix("loftsman ") else { continue };
            let words = words_of(rest.split(" && ").next().unwrap_or_default());
            let Some(help) = words.first().and_then(|command| help.get(command)) else { continue };
            count += 1;
            let options = words.iter().filter(|word| word.starts_with("--"));
            faults.extend(options.filter(|o| !of(help, o)).map(|o| format!("{name}: loftsman {}: {o}", words[0])));
        }
        for span in text.split('`').filter(|span| span.starts_with("--") && !span.starts_with("-- ")) {
            let option = span.split([' ', '=']).next().unwrap_or_default();
            if !help.values().any(|text| of(text, option)) {
                faults.push(format!("{name}: {option}"));
            }
        }
    }
    assert!(count > 30, "{count}");
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

/// Paths of all values of a document but objects; those of the members of a list are those of the list.
fn paths(value: &Value, path: &str, found: &mut BTreeSet<String>) {
    match value {
        Value::Object(members) if !members.is_empty() => {
            for (key, member) in members {
                let dot = if path.is_empty() { "" } else { "." };
                paths(member, &format!("{path}{dot}{key}"), found);
            }
        }
        Value::Array(list) if list.iter().any(Value::is_object) => {
            list.iter().for_each(|member| paths(member, path, found));
        }
        _ => {
            found.insert(path.to_owned());
        }
    }
}

/// Members that `files.md` documents, by the titles of its sections.
fn documented() -> BTreeMap<String, Vec<String>> {
    let (mut sections, mut title) = (BTreeMap::<String, Vec<String>>::new(), String::new());
    for line in read_text(carried("docs/src/reference/files.md")).lines() {
        if line.starts_with('#') {
            line.trim_start_matches(['#', ' ']).clone_into(&mut title);
        } else if let Some(cell) = line.strip_prefix("| ").and_then(|row| row.split(" | ").next()) {
            let names = cell.split('`').skip(1).step_by(2).map(ToOwned::to_owned);
            sections.entry(title.clone()).or_default().extend(names);
        }
    }
    sections
}

/// Whether a path is that of a name, in which `*` stands for one member or more.
fn is_of(path: &str, name: &str) -> bool {
    let (mut path, mut name) = (path.split('.').peekable(), name.split('.').peekable());
    while let Some(part) = name.next() {
        match path.next() {
            Some(_) if part == "*" && name.peek().is_none() => return true,
            Some(member) if part == "*" || part == member => {}
            _ => return false,
        }
    }
    path.next().is_none()
}

#[test]
fn members_of_files_are_on_their_page() {
    let folder = folder("members");
    let carried = |name: &str| format!("\"{}\"", carried(name).display());
    let [wigley, tug] = ["configs/wigley.toml", "configs/tug.toml"].map(carried);
    let [skiff, waterline] = ["tests/table_cases/skiff.csv", "examples/waterline.csv"].map(carried);
    let misprinted = carried("reports/suspects/series60-misprinted.csv");
    let table = carried("configs/methods/seed000-fishing-vessel.csv");
    let run = |line: &str| {
        let line = words_of(line);
        let done = command(&line.iter().map(String::as_str).collect::<Vec<_>>()).current_dir(&folder).output().unwrap();
        assert!(!stdout(&done).is_empty() || done.status.success(), "{line:?}: {}", stderr(&done));
        stdout(&done)
    };
    run(&format!("generate {wigley} --no-figures -o g"));
    run(&format!("fit {table} --no-figures -o fit"));
    run(&format!("fair {skiff} --no-figures -o fair"));
    run(&format!("fair-curve {waterline} --no-figures -o curve"));
    run(&format!("derive {wigley} --wave-resistance 0.3 --wave-weight 100 --no-figures -o d"));
    run(&format!("blend {wigley} d/hull.json --weights 0.5,0.5 --no-figures -o b"));
    run(&format!("resistance {tug} --speeds 10 --no-figures -o r"));
    let printed = ["check", "hydro", "inspect"].map(|name| {
        let hull = if name == "check" { &misprinted } else { &wigley };
        (format!("{name} --json"), json(run(&format!("{name} {hull} --json"))))
    });
    let written = [
        ("hull.json", "g/hull.json"),
        ("hull.json", "fair/hull.json"),
        ("summary.json", "g/summary.json"),
        ("summary.json", "d/summary.json"),
        ("fit.json", "fit/fit.json"),
        ("fairing.json", "fair/fairing.json"),
        ("summary.json of fair", "fair/summary.json"),
        ("fairing.json of fair-curve", "curve/fairing.json"),
        ("derive.json", "d/derive.json"),
        ("blend.json", "b/blend.json"),
        ("compare.json", "b/compare.json"),
        ("resistance.json", "r/resistance.json"),
        ("manifest.json", "b/manifest.json"),
    ];
    let written = written.map(|(title, file)| (title.to_owned(), json(folder.read(file))));
    let documented = documented();
    let mut faults = Vec::new();
    for (title, document) in written.into_iter().chain(printed) {
        let mut found = BTreeSet::new();
        paths(&document, "", &mut found);
        assert!(found.len() > 5, "{title}");
        let missing = found.iter().filter(|path| {
            let section = if path.starts_with("conventions.") { "conventions" } else { title.as_str() };
            // What is null or empty in a file may be an object in another.
            !documented[section].iter().any(|name| is_of(path, name) || name.starts_with(&format!("{path}.")))
        });
        faults.extend(missing.map(|path| format!("{title}: {path}")));
    }
    assert!(faults.is_empty(), "docs/src/reference/files.md lacks\n{}", faults.join("\n"));
}

/// The tutorial works Simpson's rule by hand; here it is worked again from its table.
#[test]
fn the_sums_of_the_tutorial_are_those_of_simpsons_rule() {
    let page = read_text(carried("docs/src/tutorial/student.md"));
    let (_, table) = page.split_once("file=ship.csv\n").unwrap();
    let numbers = |line: &str| -> Vec<f64> { line.split(',').map(|number| number.parse().unwrap()).collect() };
    let rows: Vec<Vec<f64>> = table.lines().skip(1).take(11).map(numbers).collect();
    let rule = |values: &[f64]| -> f64 {
        let factor = |k: usize| if k == 0 || k + 1 == values.len() { 1.0 } else { 2.0 + 2.0 * (k % 2) as f64 };
        values.iter().enumerate().map(|(k, value)| factor(k) * value).sum()
    };
    let levers = |values: &[f64]| -> Vec<f64> { values.iter().enumerate().map(|(k, v)| k as f64 * v).collect() };
    let (along, up) = (12.192, 1.6256);
    let (mut areas, mut moments) = (Vec::new(), Vec::new());
    for j in 1..6 {
        let column: Vec<f64> = rows.iter().map(|row| row[j]).collect();
        let [sum, lever] = [rule(&column), rule(&levers(&column))];
        let [area, moment] = [2.0 / 3.0 * along * sum, 2.0 / 3.0 * along * along * lever];
        let row = format!("{sum:.4} | {lever:.4} | {area:.2} | {moment:.1} |");
        assert!(page.contains(&row), "{row}");
        areas.push(area);
        moments.push(moment);
    }
    let sum = rule(&areas);
    for figure in [
        format!("V   = 1.6256/3 x 14141.56 = {:.1} m3", up / 3.0 * sum),
        format!("LCB = 835353.7 / 14141.56 = {:.3} m", rule(&moments) / sum),
        format!("KB  = 1.6256 x 30595.4 / 14141.56 = {:.3} m", up * rule(&levers(&areas)) / sum),
    ] {
        assert!(page.contains(&figure), "{figure}");
    }
}

#[test]
fn the_readme_shows_what_fair_prints() {
    let table = carried("tests/data/series60_cb060/offsets.csv");
    let headline = loftsman::prelude::fair(table, &[("dimensions.T", "6.502")]).unwrap().headline();
    assert!(read_text(carried("README.md")).contains(&headline), "{headline}");
}

#[test]
fn a_sentence_is_found() {
    let text = "# Head\n\nOne two.\nThree four: five.\n\n```\nnot this\n```\n* item one\n| a b | c |\n";
    let found: Vec<String> =
        sentences(text).into_iter().map(|s| s.trim().to_owned()).filter(|s| !s.is_empty()).collect();
    assert_eq!(found, ["One two.", "Three four.", "five.", "* item one", "a b", "c"]);
    assert_eq!(links("[a](b.md) and [c](d/e.md#f) [w](https://x)"), ["b.md", "d/e.md#f"]);
    let list = shown("```text\n$ loftsman a --b \\\n    \"c d\"\nout\n...\n$ echo $?\n0\n```\n");
    assert_eq!(words_of(&list[0].command), ["loftsman", "a", "--b", "c d"]);
    assert_eq!((list[0].output.join("|"), list[1].output.join("|")), ("out|...".to_owned(), "0".to_owned()));
    assert_eq!(leveled("a   -3e-16, 2.5"), "a 0 2.5");
    assert!(is_of("a.b.c", "a.*.c") && is_of("a.b.c", "a.*") && !is_of("a.b", "a") && !is_of("a", "a.*"));
}
