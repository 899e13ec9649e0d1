//! Every code of a message is explained in `CODES`, which has no other, and is provoked by a test; and the messages of
//! whole jobs that no other test provokes.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use loftsman::internals::exchange::{ReadTable, TableProblem, read_table};
use loftsman::internals::fairing::curve::CurveSettings;
use loftsman::internals::qp::Status;
use loftsman::internals::report::{
    CODES, CurveJob, Explanation, Failure, check_table, codes_page, fair_outputs, faired_curve, fit_outputs, read_fair,
    read_fit, read_source,
};
use loftsman::internals::units::Notation;

use crate::support::{carried, folder, program, read_text, sources, stderr, stdout};

/// Codes that no input is known to reach: the program is prepared for a fault of its own.
const UNREACHED: [(&str, &str); 3] = [
    ("E199", "the interpolation of a net of a valid form fails"),
    ("E403", "metacentre and wetted surface come to their targets or are refused on every hull that was tried"),
    ("W514", "sections of every hull that was tried have its volume within 0.3 %"),
];

/// The codes in a text, with the character before each.
fn codes(text: &str) -> Vec<(char, String)> {
    let bytes = text.as_bytes();
    let is_code = |at: usize| {
        let word = bytes.get(at..at + 4)?;
        let ends = bytes.get(at + 4).is_none_or(|b| !b.is_ascii_alphanumeric() && *b != b'_');
        (matches!(word[0], b'E' | b'W' | b'N') && word[1..].iter().all(u8::is_ascii_digit) && ends).then_some(())
    };
    let before = |at: usize| if at == 0 { '\n' } else { char::from(bytes[at - 1]) };
    let starts = (0..bytes.len()).filter(|&at| is_code(at).is_some());
    starts
        .map(|at| (before(at), text[at..at + 4].to_owned()))
        .filter(|(before, _)| !before.is_ascii_alphanumeric() && *before != '_')
        .collect()
}

/// Codes that the program reports, codes that the heads of its files explain, and codes that its tests name: those of
/// `tests/`, and those of the tests within the sources. The list of the codes itself is not looked at.
fn known() -> [BTreeSet<String>; 3] {
    let [mut said, mut explained, mut tested] = [const { BTreeSet::new() }; 3];
    let list = carried("src/report/words/codes");
    for file in sources(&carried("src")).iter().filter(|file| !file.with_extension("").starts_with(&list)) {
        let text = read_text(file);
        let own = file.file_name().is_some_and(|name| name == "tests.rs");
        let (program, tests) =
            if own { ("", text.as_str()) } else { text.split_once("#[cfg(test)]\nmod ").unwrap_or((&text, "")) };
        tested.extend(codes(tests).into_iter().map(|(_, code)| code));
        for line in program.lines() {
            let line = line.trim_start();
            for (before, code) in codes(line) {
                if line.starts_with("//!") {
                    explained.insert(code);
                } else if !line.starts_with("//") && before == '"' {
                    said.insert(code);
                }
            }
        }
    }
    for file in sources(&carried("tests")).iter().filter(|file| !file.ends_with("codes.rs")) {
        tested.extend(codes(&read_text(file)).into_iter().map(|(_, code)| code));
    }
    // Of this file, what is compared with a message: the code opens a literal.
    let own = read_text(carried("tests/codes.rs"));
    let own = own.split_once("fn refusals").map_or("", |(_, tests)| tests);
    tested.extend(codes(own).into_iter().filter(|(before, _)| *before == '"').map(|(_, code)| code));
    [said, explained, tested]
}

#[test]
fn every_code_is_provoked() {
    let [said, _, tested] = known();
    assert!(said.len() > 60 && said.contains("E301") && said.contains("W332"), "the scan finds {said:?}");
    let missing: Vec<&String> =
        said.iter().filter(|code| !tested.contains(*code) && UNREACHED.iter().all(|(c, _)| c != code)).collect();
    assert!(missing.is_empty(), "no test provokes {missing:?}");
    assert!(UNREACHED.iter().all(|(code, _)| said.contains(*code) && !tested.contains(*code)));
}

#[test]
fn every_code_is_explained_once() {
    let [said, explained, _] = known();
    let listed: BTreeSet<String> = CODES.iter().map(|found| found.code.to_owned()).collect();
    let missing: Vec<&String> = said.difference(&listed).collect();
    assert!(missing.is_empty(), "CODES lacks {missing:?}");
    let stray: Vec<&String> = listed.difference(&said).collect();
    assert!(stray.is_empty(), "CODES explains {stray:?}, which nothing reports");
    assert!(CODES.windows(2).all(|pair| pair[0].code < pair[1].code), "CODES is not sorted, or has a code twice");
    assert!(explained.is_empty(), "heads of files explain {explained:?}; CODES does");
}

/// Most words of a sentence; a code span is one word.
const MOST_WORDS: usize = 25;

/// A text with an x for each code span.
fn without_spans(text: &str) -> String {
    text.split('`').enumerate().map(|(k, part)| if k % 2 == 0 { part } else { "x" }).collect()
}

#[test]
fn explanations_are_short_sentences() {
    for Explanation { code, title, cause, example, remedy } in CODES {
        assert!((2..=9).contains(&title.split(' ').count()), "{code}: {title}");
        for text in [title, cause, example, remedy] {
            let begins = |c: char| c.is_uppercase() || c == '`' && text == example;
            assert!(text.starts_with(begins) && text.trim() == text && !text.contains("  "), "{code}: {text}");
            assert!(text.matches('`').count() % 2 == 0, "{code}: {text}");
            let prose = without_spans(text);
            let mut words = 0;
            for word in prose.split_whitespace() {
                words += 1;
                assert!(words <= MOST_WORDS, "{code}: {text}");
                words *= usize::from(!word.ends_with(['.', '?', '!']));
            }
            assert_eq!(text.ends_with(['.', '?']), text != title, "{code}: {text}");
        }
    }
}

/// The page is written anew with LOFTSMAN_GOLDEN=1.
#[test]
fn the_reference_of_codes_is_up_to_date() {
    let kept = carried("docs/src/reference/codes.md");
    if std::env::var_os("LOFTSMAN_GOLDEN").is_some() {
        fs::create_dir_all(kept.parent().unwrap()).unwrap();
        fs::write(&kept, codes_page()).unwrap();
    }
    assert!(read_text(&kept) == codes_page(), "write {} anew with LOFTSMAN_GOLDEN=1", kept.display());
}

#[test]
fn the_command_explains_codes() {
    let all = stdout(&program(&["explain"]));
    assert!(all.lines().zip(CODES).all(|(line, found)| line == format!("{} {}", found.code, found.title)));
    assert_eq!(all.lines().count(), CODES.len());
    let (code, title) = (CODES[0].code, CODES[0].title);
    let two = stdout(&program(&["explain", &code.to_lowercase(), CODES[1].code]));
    let starts = format!("{code} {title}\n");
    assert!(two.starts_with(&starts) && two.contains(&format!("\n\n{} {}\n", CODES[1].code, CODES[1].title)), "{two}");
    assert!(["\nCause: ", "\nExample: ", "\nRemedy: "].iter().all(|part| two.matches(part).count() == 2), "{two}");
    let json: serde_json::Value = serde_json::from_str(&stdout(&program(&["explain", code, "--json"]))).unwrap();
    assert_eq!((&json[0]["code"], &json[0]["title"], json.as_array().unwrap().len()), (&code.into(), &title.into(), 1));
    let unknown = program(&["explain", code, "E1O1"]);
    assert!(unknown.status.code() == Some(2) && unknown.stdout.is_empty());
    assert!(stderr(&unknown).starts_with("E705 no message has the code 'E1O1'. Did you mean "), "{}", stderr(&unknown));
}

/// Refusals name the command that explains them, once and on stderr; not beside JSON, and not without a code.
#[test]
fn refusals_name_the_explanation() {
    let last = |arguments: &[&str]| stderr(&program(arguments)).lines().last().unwrap_or_default().to_owned();
    let code = Failure::Exists(Vec::new()).code().unwrap();
    assert!(CODES.iter().any(|found| found.code == code));
    let missing = program(&["hydro", "nothing.csv"]);
    let said = stderr(&missing);
    let (first, more) = said.split_once('\n').unwrap();
    assert_eq!(more, format!("More: loftsman explain {}\n", &first[..4]));
    assert!(!last(&["check", "nothing.csv", "--json"]).starts_with("More"));
    assert!(!last(&["explain", "nothing"]).starts_with("More"));
}

fn refusals(failure: Failure) -> Vec<String> {
    match failure {
        Failure::Input(messages) | Failure::Infeasible(messages) => messages.iter().map(ToString::to_string).collect(),
        other => panic!("{other}"),
    }
}

#[track_caller]
fn says(messages: &[String], code: &str, words: &str) {
    let found = messages.iter().any(|message| message.starts_with(code) && message.contains(words));
    assert!(found, "{code} {words} in\n{}", messages.join("\n"));
}

#[test]
fn tables_that_make_no_hull() {
    let folder = folder("line");
    let line = folder.join("line.csv");
    fs::write(&line, "x\\z [m],1,2,3\n0,1,1.5,2\n").unwrap();
    let job = read_fit(&line, None, None).unwrap();
    says(&refusals(fit_outputs(&job, &[]).map(|_| ()).unwrap_err()), "E162", "a surface needs at least 2 of each");
    says(&refusals(read_source(&line).unwrap_err()), "E314", "a surface needs at least 2 of each");
    let faired = read_fair(&line, &[]).map(|job| fair_outputs(&job, false).map(|_| ()));
    says(&refusals(faired.and_then(|done| done).unwrap_err()), "E175", "line.csv");
}

#[test]
fn a_refused_fit_names_the_worst_suspect() {
    let text = read_text(carried("tests/data/wigley/offsets.csv"));
    // 4.3 for 3.4: digits swapped at a place of full breadth.
    let row = text.lines().find(|line| line.starts_with("0,")).unwrap();
    let cells: Vec<&str> = row.split(',').collect();
    let breadth: f64 = cells[6].parse().unwrap();
    let wrong = row.replacen(cells[6], &format!("{:.6}", breadth - 1.0), 1);
    let folder = folder("misprint");
    let table = folder.write("misprint.csv", text.replacen(row, &wrong, 1));
    let narrow = folder.write("narrow.toml", "[dimensions]\nB = 0.1\n[method]\nkind = \"bilinear\"\n");
    let job = read_fit(Path::new(&table), Some(&narrow), None).unwrap();
    let messages = refusals(fit_outputs(&job, &[]).map(|_| ()).unwrap_err());
    says(&messages, "E163", "no hull");
    says(&messages, "W164", "the worst is station 0, waterline 3.125 m");
}

#[test]
fn a_program_that_stops_early_is_no_proof() {
    let job = read_fair(&carried("tests/data/wigley/offsets.csv"), &[]).unwrap();
    let mut outputs = fair_outputs(&job, false).unwrap();
    outputs.verdict().unwrap();
    outputs.outcome.status = Status::Limit;
    let failure = outputs.verdict().unwrap_err();
    assert_eq!(failure.exit_code(), 4);
    says(&refusals(failure), "E402", "stopped before the optimum was proved");
}

#[test]
fn a_curve_that_is_no_text() {
    let folder = folder("curve");
    let path = folder.join("curve.csv");
    fs::write(&path, b"x,y\n0,1\n\xff\xfe,2\n").unwrap();
    let job = CurveJob {
        keep_suspects: false,
        path,
        unit: Notation::Metres,
        locks: Vec::new(),
        knuckles: Vec::new(),
        area: None,
        centroid: None,
        settings: CurveSettings::default(),
    };
    says(&refusals(faired_curve(&job).unwrap_err()), "E341", "not text in UTF-8");
}

fn read(name: &str, text: &str) -> Result<ReadTable, Vec<String>> {
    let shown = |problems: Vec<TableProblem>| problems.iter().map(ToString::to_string).collect();
    read_table(name, text.as_bytes()).map_err(shown)
}

#[test]
fn text_formats_have_a_largest_size() {
    // 101 chines of three points.
    let chines: String =
        (0..101).map(|k| format!("0 {k} 0.1\n5 {k} 0.2\n10 {k} 1\n\n")).fold("1\n".to_owned(), |all, one| all + &one);
    says(&read("a.txt", &chines).unwrap_err(), "E312", "101 chines with 303 points");
    // 5001 sections of two points, none of them with the x of another.
    let sections: String =
        (0..5001).map(|k| format!("{k} 0 0\n{k} 1 1\n{k} 1 2\n\n")).fold("0\n".to_owned(), |all, one| all + &one);
    says(&read("a.txt", &sections).unwrap_err(), "E312", "5001 sections; a table has at most 4000");
    let shape = |k: usize| format!("S{k}\n1\n0,2\n0,0\n1,1\n0,0,0\n");
    let ghs = format!("many\nP:M\n*\n{}**\n***\n****\n", (0..5001).map(shape).collect::<String>());
    says(&read("a.gf", &ghs).unwrap_err(), "E312", "more than 5000 shapes, components or parts");
}

#[test]
fn remarks_are_counted_where_they_are_many() {
    // 150 columns of section areas that are not used, beside two waterlines.
    let areas = |n: usize, word: &str| format!(",{word}").repeat(n);
    let row = |cells: &str| format!("{cells}{}\n", areas(150, "1"));
    let text = format!(
        "# L = 40 m, B = 8 m, T = 3 m\n# station 0 = AP, 10 = FP\nstation,wl0.5,wl1{}\n{}{}{}{}",
        areas(150, "area"),
        row("0,0,0.2"),
        row("5,0.9,1"),
        row("10,0,0.1"),
        row("max,0.9,1"),
    );
    let table = read("a.csv", &text).unwrap_or_else(|problems| panic!("{}", problems.join("\n")));
    let shown: Vec<String> = table.notes.iter().map(ToString::to_string).collect();
    says(&shown, "W312", "50 more problems not shown");
    assert_eq!(shown.iter().filter(|note| note.starts_with("W332")).count(), 100);
    // That remarks were left out is no fault of a cell.
    let folder = folder("remarks");
    folder.write("remarks.csv", &text);
    assert!(check_table(&folder.join("remarks.csv")).unwrap().problems.is_empty());
}

#[test]
fn sections_from_the_bow_are_turned_with_a_note() {
    let text = "x,y,z\n40,0,0\n40,1,3\n20,0,0\n20,4,3\n0,0,0\n0,2,3\n";
    let table = read("a.csv", text).unwrap_or_else(|problems| panic!("{}", problems.join("\n")));
    assert!(table.table.stations.windows(2).all(|pair| pair[0].station.x < pair[1].station.x));
    let shown: Vec<String> = table.notes.iter().map(ToString::to_string).collect();
    says(&shown, "N321", "their order is turned");
}
