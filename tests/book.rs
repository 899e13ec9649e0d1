//! README and book: their links lead somewhere, their sentences are short, and every page is in the summary.

use std::path::PathBuf;

use loftsman::internals::config::{DERIVE_KEYS, JOB_KEYS, KEYS, Key, METHOD_KEYS, TABLE_KEYS};
use loftsman::internals::hydrostatics::QUANTITIES;

use crate::support::{carried, commands, files_of, program, read_text, stdout};

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
}
