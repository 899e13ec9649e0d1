//! The command `report`: what it reads and refuses, its files, their bytes, its tables.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use loftsman::internals::plot::Sheet;
use loftsman::internals::report::{
    Destination, OutputFile, ReportSettings, fair_outputs, generate_outputs, read_design, read_fair, read_result,
    report_outputs,
};
use serde_json::Value;

use crate::support::{Folder, carried, command, folder, json, lasting_folder, program, read_text, stderr};

/// Small pictures: what is tested here does not depend on their size.
pub(crate) const SETTINGS: ReportSettings =
    ReportSettings { dots_per_inch: 24.0, sheet: Sheet::A3, combs: String::new(), date: None };

pub(crate) fn write(folder: &Path, files: &[OutputFile]) {
    Destination { folder, inputs: &loftsman::internals::report::Inputs::default(), force: true }.write(files).unwrap();
}

/// A generated hull in a folder of its own.
pub(crate) fn generated(test: &str) -> Folder {
    let path = folder(test);
    let config = carried("configs/wigley.toml");
    let (design, bytes) = read_design(&config).unwrap();
    let outputs = generate_outputs(&design, (&config, &bytes), &[]).unwrap();
    write(&path, &outputs.files);
    path
}

/// The table of the Wigley hull with one wrong offset: 0.4 m too much. It is written into this folder.
fn wrong_table(folder: &Path) -> PathBuf {
    let path = folder.join("wigley/offsets.csv");
    fs::create_dir_all(path.parent().unwrap()).unwrap();
    let text = read_text(carried("tests/data/wigley/offsets.csv"));
    let wrong = |line: &str| {
        let mut cells: Vec<String> = line.split(',').map(str::to_owned).collect();
        cells[6] = format!("{:.6}", cells[6].parse::<f64>().unwrap() + 0.4);
        cells.join(",")
    };
    let lines: Vec<String> =
        text.lines().map(|line| if line.starts_with("-20,") { wrong(line) } else { line.to_owned() }).collect();
    fs::write(&path, lines.join("\n") + "\n").unwrap();
    path
}

/// A faired table with its report, made once.
pub(crate) fn faired() -> &'static (PathBuf, Vec<OutputFile>) {
    static FAIRED: OnceLock<(PathBuf, Vec<OutputFile>)> = OnceLock::new();
    FAIRED.get_or_init(|| {
        let path = lasting_folder("report-faired");
        let draught = ("--draught", "dimensions.T", "4.375".to_owned());
        let job = read_fair(&wrong_table(&folder("table")), &[draught]).unwrap();
        write(&path, &fair_outputs(&job, false).unwrap().files);
        let files = report_outputs(&read_result(&path).unwrap(), &SETTINGS).unwrap();
        (path, files)
    })
}

pub(crate) fn text(files: &[OutputFile], name: &str) -> String {
    let found = files.iter().find(|file| file.name == name).unwrap_or_else(|| panic!("no {name}"));
    String::from_utf8(found.contents.clone()).unwrap()
}

/// The figures of a hull, and those of a faired table before them.
pub(crate) const HULL: [&str; 13] = [
    "bonjean",
    "design-condition",
    "diagram-sheet",
    "gaussian-map",
    "hydrostatic-table",
    "hydrostatic-table-2",
    "hydrostatic-table-3",
    "hydrostatics",
    "lines",
    "mean-map",
    "sectional-area",
    "sections",
    "zebra-map",
];
pub(crate) const FAIRED: [&str; 19] = [
    "constraints",
    "convergence",
    "deviation",
    "faired-offsets",
    "fairing-arrows",
    "fairing-arrows-long",
    "fairing-body-plan",
    "fairing-buttocks",
    "fairing-diagonals",
    "fairing-half-breadth-plan",
    "fairing-moves",
    "fairing-stations",
    "fairing-waterlines",
    "inflections",
    "lcurve",
    "notes",
    "pareto",
    "suspects",
    "verdict",
];

const TABLES: [&str; 13] = [
    "bonjean.csv",
    "diagonals-feet-inches-eighths.csv",
    "diagonals-m.csv",
    "diagonals-mm.csv",
    "heights-feet-inches-eighths.csv",
    "heights-m.csv",
    "heights-mm.csv",
    "hydrostatics.csv",
    "hydrostatics.json",
    "hydrostatics.xlsx",
    "offsets-feet-inches-eighths.csv",
    "offsets-m.csv",
    "offsets-mm.csv",
];

fn expected(figures: &[&str], more: &[&str]) -> Vec<String> {
    let pictures = figures.iter().flat_map(|key| [format!("{key}.png"), format!("{key}.svg")]);
    let others = TABLES.iter().chain(more).chain(&["report.html", "report.pdf"]).map(|name| (*name).to_owned());
    let mut names: Vec<String> = pictures.chain(others).collect();
    names.sort();
    names.push("manifest.json".to_owned());
    names
}

#[test]
fn every_result_becomes_a_report() {
    let names = |files: &[OutputFile]| files.iter().map(|file| file.name.clone()).collect::<Vec<_>>();
    let path = generated("generate");
    let out = path.join("report");
    let output = program(&["report", path.to_str().unwrap(), "--dpi", "24"]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    for name in expected(&HULL, &[]) {
        assert!(out.join(&name).is_file(), "{name}");
    }
    let both: Vec<&str> = HULL.iter().chain(&FAIRED).copied().collect();
    assert_eq!(names(&faired().1), expected(&both, &["changes.csv"]));

    let hydro = program(&["hydro", path.to_str().unwrap(), "--draughts", "1.25:6.25:1.25", "--json"]);
    fs::write(path.join("hydro.json"), hydro.stdout).unwrap();
    let result = read_result(&path.join("hydro.json")).unwrap();
    assert_eq!(result.draughts, [1.25, 2.5, 3.75, 5.0, 6.25]);
    assert_eq!(result.hull, read_result(&path).unwrap().hull);
    assert_eq!(result.hull, read_result(&path.join("hull.json")).unwrap().hull);
    assert_eq!(read_result(&path.join("summary.json")).unwrap().draughts, read_result(&path).unwrap().draughts);
}

#[test]
fn what_is_no_result_is_refused_with_file_found_expected_and_remedy() {
    let path = folder("refused");
    let refused = |arguments: &[&str], code: i32, parts: &[&str]| {
        let output = program(&[&["report"], arguments].concat());
        let message = stderr(&output);
        assert_eq!(output.status.code(), Some(code), "{message}");
        for part in parts {
            assert!(message.contains(part), "{part} is not in {message}");
        }
    };
    let shown = |name: &str| path.join(name).display().to_string();
    refused(&[path.to_str().unwrap()], 3, &["E181", "found nothing; expected hull.json", "Give the folder"]);
    refused(&[&shown("none.json")], 6, &["E602", "none.json"]);
    fs::write(path.join("other.json"), "{\"a\": 1, \"b\": 2}").unwrap();
    refused(&[&shown("other.json")], 3, &["E182", "other.json", "found an object of a, b"]);
    fs::write(path.join("broken.json"), "{\"a\": ").unwrap();
    refused(&[&shown("broken.json")], 3, &["E182", "line 1"]);
    fs::write(path.join("old.json"), "{\"conventions\": {}, \"rows\": [{\"T\": 1.0}]}").unwrap();
    refused(&[&shown("old.json")], 3, &["E182", "without their hull", "Run `hydro HULL"]);

    let (fair, _) = faired();
    let copy = |name: &str| fs::copy(fair.join(name), path.join(name)).map(drop).unwrap();
    copy("fairing.json");
    // A bare name: the folder is the one that the program stands in.
    let message = stderr(&command(&["report", "fairing.json"]).current_dir(&path).output().unwrap());
    assert!(message.starts_with("E181 . found broken.json, fairing.json"), "{message}");
    copy("hull.json");
    refused(&[path.to_str().unwrap()], 3, &["E181", "expected changes.csv, which `fair` writes"]);
    copy("changes.csv");
    refused(&[path.to_str().unwrap()], 3, &["E181", "expected fitted-hull.json"]);
    // The name that an older program gave it.
    fs::copy(fair.join("fitted-hull.json"), path.join("start.json")).unwrap();
    assert!(read_result(&path).is_ok());
    fs::remove_file(path.join("start.json")).unwrap();
    copy("fitted-hull.json");
    let changes = read_text(fair.join("changes.csv"));
    let cut: String = changes.split_inclusive('\n').take(3).collect();
    let rows = changes.lines().count() - 1;
    let ends = format!("line 4: the file ends after 2 offsets, expected the {rows} of fairing.json");
    let far = changes.lines().nth(5).unwrap().replacen(",0.", ",1000000.", 1);
    for (text, part) in [
        (changes.replacen("-50", "fifty", 1), "line 2, column"),
        (cut.clone(), &ends),
        (changes.replacen(changes.lines().nth(5).unwrap(), &far, 1), "line 6, column"),
    ] {
        fs::write(path.join("changes.csv"), text).unwrap();
        refused(&[path.to_str().unwrap()], 3, &["E182", "changes.csv", part, "Run the command that wrote it again"]);
    }
    // Of a program that did not write how many there are.
    let certificate = read_text(fair.join("fairing.json"));
    let count = format!("\"offsets\": {rows},");
    assert!(certificate.contains(&count));
    fs::write(path.join("fairing.json"), certificate.replace(&count, "")).unwrap();
    fs::write(path.join("changes.csv"), &cut).unwrap();
    refused(&[path.to_str().unwrap()], 3, &["E182", "changes.csv found 2 offsets that span no hull"]);
    copy("fairing.json");
    copy("changes.csv");
    let start = read_text(fair.join("fitted-hull.json"));
    fs::write(path.join("fitted-hull.json"), start.replace("\"Lpp\":100.0", "\"Lpp\":90.0")).unwrap();
    let other = "another ship: found Lpp 90 m where hull.json has 100 m";
    refused(&[path.to_str().unwrap()], 3, &["E182", "fitted-hull.json", other]);
    copy("fitted-hull.json");
    for (lines, part) in [
        ("buttock 99", "'buttock 99' does not cut the hull"),
        ("station 5, diagonal 99", "'diagonal 99' does not cut the hull"),
        (" , ", "expected lines, as \"station 5, waterline 2.0\""),
    ] {
        refused(&[path.to_str().unwrap(), "--combs", lines], 2, &["--combs", part]);
    }
    refused(&[path.to_str().unwrap(), "-o", path.to_str().unwrap()], 2, &["a folder of its own"]);
    refused(&[path.to_str().unwrap(), "--dpi", "5000"], 2, &["20 to 600"]);
}

#[test]
fn what_is_missing_from_a_result_is_told() {
    let notes = |of: &Path, gone: &[&str]| {
        let path = folder("missing");
        for entry in fs::read_dir(of).unwrap().map(|entry| entry.unwrap()).filter(|entry| entry.path().is_file()) {
            if gone.iter().all(|name| entry.file_name() != *name) {
                fs::copy(entry.path(), path.join(entry.file_name())).unwrap();
            }
        }
        read_result(&path).unwrap().notes
    };
    let (fair, _) = faired();
    let design = generated("missing-of");
    for (of, gone, parts) in [
        (fair.as_path(), &["summary.json"][..], &[][..]),
        (fair, &["fairing.json"], &["fairing.json is missing: the report has nothing of the fairing"]),
        (
            fair,
            &["fairing.json", "manifest.json"],
            &["manifest.json is missing: the report does not name", "fairing.json is"],
        ),
        (&design, &["summary.json"], &["summary.json is missing: the report has no targets"]),
        (&design, &["hydrostatics.csv"], &["hydrostatics.csv is missing: the report has the usual draughts"]),
    ] {
        let notes = notes(of, gone);
        assert_eq!(notes.len(), parts.len(), "{gone:?}: {notes:?}");
        assert!(parts.iter().zip(&notes).all(|(part, note)| note.contains(part)), "{gone:?}: {notes:?}");
    }
}

#[test]
fn a_result_that_was_changed_since_is_refused() {
    let path = generated("stale");
    assert!(read_result(&path).unwrap().notes.is_empty());
    let hull = read_text(path.join("hull.json"));
    fs::write(path.join("hull.json"), hull + "\n").unwrap();
    let refused = read_result(&path).unwrap_err().to_string();
    assert!(refused.starts_with("E185 ") && refused.contains("hull.json"), "{refused}");
}

#[test]
fn the_same_result_gives_the_same_bytes() {
    let path = generated("bytes");
    let result = read_result(&path).unwrap();
    let [first, second] = [(); 2].map(|()| report_outputs(&result, &SETTINGS).unwrap());
    for (a, b) in first.iter().zip(&second) {
        assert!(a == b, "{} differs", a.name);
    }
}

#[test]
fn what_fair_wrote_comes_back_as_it_was() {
    let (path, files) = faired();
    let result = read_result(path).unwrap();
    let (record, fairing) = result.fairing.unwrap();
    assert_eq!(record.after, result.hull);
    assert_eq!(record.changes.len(), 451);
    // Stations from -50 to 50 m of midship stand between AP and FP.
    assert_eq!((record.lines.stations[0].x, record.lines.stations[40].x), (0.0, 100.0));
    let [doubt] = &record.doubts[..] else { panic!("{:?}", record.doubts) };
    assert_eq!((doubt.id.as_str(), doubt.station, doubt.z), ("S1", 12, 3.125));
    assert!((doubt.value - 3.55).abs() < 1e-9 && (doubt.proposed - 3.15).abs() < 1e-2, "{doubt:?}");
    let energy = &fairing["energy"];
    let written = [&energy["before"], &energy["after"]].map(|value| value.as_f64().unwrap());
    assert!(record.energy.iter().zip(written).all(|(a, b)| (a - b).abs() <= 1e-12 * b), "{written:?}");
    let (rms, largest, _) = record.moves();
    let near = |a: f64, b: &Value| (a - b.as_f64().unwrap()).abs() < 1e-9;
    assert!(near(rms, &fairing["moves"]["rms"]) && near(largest, &fairing["moves"]["max"]));
    assert_eq!(text(files, "changes.csv"), read_text(path.join("changes.csv")));
}

#[test]
fn the_sheets_after_the_drawings_have_the_fair_table_the_inflections_and_the_notes() {
    let (path, files) = faired();
    let sheet = text(files, "faired-offsets.svg");
    let table = read_text(path.join("offsets.csv"));
    let offsets = table.lines().filter(|line| !line.starts_with('#')).skip(1).flat_map(|line| line.split(',').skip(1));
    let mut compared = 0;
    for offset in offsets.filter(|offset| offset.parse::<f64>().is_ok()) {
        assert!(sheet.contains(&format!(">{offset}<")), "{offset}");
        compared += 1;
    }
    assert!(
        compared > 400 && sheet.contains("left out as a suspect, the offset is that of the fair hull: 1"),
        "{compared}"
    );
    let certificate = json(read_text(path.join("fairing.json")));
    let lines: usize = ["waterlines", "stations", "buttocks", "diagonals"]
        .iter()
        .map(|kind| certificate["inflections"][kind].as_array().unwrap().len())
        .sum();
    let told = text(files, "inflections.svg");
    let rows = ["waterline", "station", "buttock", "diagonal"]
        .map(|kind| told.matches(&format!(">{kind}<")).count() + told.matches(&format!(">{kind} ")).count());
    assert_eq!(rows.iter().sum::<usize>(), lines);
    let notes = text(files, "notes.svg");
    let first = certificate["notes"][0].as_str().unwrap();
    assert!(notes.contains(first.split(['&', '<', '>', '\'', '_']).next().unwrap().trim()), "{first}");
}

#[test]
fn tables_agree_in_their_notations_and_with_the_hull() {
    let (path, files) = faired();
    let hull = read_result(path).unwrap().hull;
    let cells = |name: &str| -> Vec<Vec<String>> {
        text(files, name).lines().map(|line| line.split(',').map(str::to_owned).collect()).collect()
    };
    let (metres, millimetres) = (cells("offsets-m.csv"), cells("offsets-mm.csv"));
    let mut compared = 0;
    for (a, b) in metres.iter().zip(&millimetres).skip(1) {
        for (a, b) in a.iter().zip(b).skip(1) {
            if let (Ok(a), Ok(b)) = (a.parse::<f64>(), b.parse::<f64>()) {
                assert!((1e3 * a - b).abs() <= 0.5 + 1e-6, "{a} {b}");
                compared += 1;
            }
        }
    }
    assert!(compared > 300, "{compared}");
    // A point of a diagonal lies on the side.
    let diagonals = cells("diagonals-m.csv");
    let angle = diagonals[0][0].split(' ').find_map(|word| word.parse::<f64>().ok()).unwrap().to_radians();
    let mut compared = 0;
    for row in &diagonals[1..] {
        for (height, distance) in diagonals[0].iter().zip(row).skip(1) {
            let Ok(s) = distance.parse::<f64>() else { continue };
            let z = height.parse::<f64>().unwrap() - s * angle.sin();
            let y = hull.half_breadth(row[0].parse().unwrap(), z).unwrap();
            assert!((y - s * angle.cos()).abs() < 2e-3, "{row:?}");
            compared += 1;
        }
    }
    assert!(compared > 100, "{compared}");
    let json = json(text(files, "hydrostatics.json"));
    assert!(json["rows"].as_array().unwrap().len() > 10 && json["conventions"]["density"] == 1.025);
    let workbook = &files.iter().find(|file| file.name == "hydrostatics.xlsx").unwrap().contents;
    assert!(workbook.starts_with(b"PK"));
}

#[test]
fn the_verdict_says_how_many_offsets_were_kept_and_with_which_settings() {
    let svg = text(&faired().1, "verdict.svg");
    for part in [
        "450 of 451 offsets kept within",
        "1 suspected typing error left out",
        "Settings: toleranc",
        "smoothing weight",
        "from offsets.csv (sha256",
    ] {
        assert!(svg.contains(part), "{part} is not in {svg}");
    }
}

#[test]
fn the_page_has_the_tables_of_offsets_before_and_after() {
    let (_, files) = faired();
    let page = text(files, "report.html");
    for key in ["offsets", "heights", "diagonals"] {
        let section = page.split(&format!("<section id=\"{key}\">")).nth(1).unwrap();
        let section = section.split("</section>").next().unwrap();
        assert!(section.contains("class=\"sortable\"") && section.contains("<th>hull</th>"), "{key}");
        let csv = text(files, &format!("{key}-m.csv"));
        let rows: Vec<&str> = section.split("<tr").skip(2).collect();
        assert_eq!(rows.len(), 2 * (csv.lines().count() - 1), "{key}");
        for (line, pair) in csv.lines().skip(1).zip(rows.chunks(2)) {
            let cells = |row: &str| -> Vec<String> {
                row.split("<td>").skip(1).map(|cell| cell.split('<').next().unwrap().to_owned()).collect()
            };
            let [before, after] = [cells(pair[0]), cells(pair[1])];
            assert_eq!((before[1].as_str(), after[1].as_str()), ("before", "after"));
            for (cell, field) in after.iter().skip(2).zip(line.split(',').skip(1)) {
                let near = match (cell.parse::<f64>(), field.parse::<f64>()) {
                    (Ok(a), Ok(b)) => (a - b).abs() <= 0.5001e-4,
                    _ => cell == field,
                };
                assert!(near, "{key}: {cell} for {field}");
            }
        }
    }
}

#[test]
fn lines_with_combs_are_chosen_by_their_names() {
    let (path, files) = faired();
    let result = read_result(path).unwrap();
    let outputs = |combs: &str| report_outputs(&result, &ReportSettings { combs: combs.to_owned(), ..SETTINGS });
    let chosen = outputs("waterline 3.125, station -20").unwrap();
    assert!(text(&chosen, "fairing-buttocks.svg").contains("no combs"));
    let plan = text(&chosen, "fairing-body-plan.svg");
    assert!(plan.contains("combs of 1 of ") && plan.contains(" stations, on every sheet, before and after: 10 mm = "));
    assert!(plan.len() < text(files, "fairing-body-plan.svg").len());
    for (words, part) in [
        ("waterline 3", "'waterline 3' is no waterline of the table"),
        ("station x", "'station x' is no station of the table; there are -50, "),
        ("frame 4", "expected station, waterline, buttock or diagonal"),
        ("buttock", "expected a distance in metres, as buttock 2.5"),
    ] {
        let message = outputs(words).unwrap_err().to_string();
        assert!(message.contains(part), "{message}");
    }
}
