//! The files of `fair`: the fair table in its notation, what moved, what is read and written.

use std::fs;
use std::path::PathBuf;
use std::process::Stdio;

use loftsman::internals::exchange::read_table;
use loftsman::internals::report::{FairOutputs, fair_page, read_fair, read_source};

use crate::fair::{TABLE, faired, file, number, wigley_table};
use crate::support::{carried, command, folder, json, names_in, program, read_text, stderr, stdout};

#[test]
fn a_table_becomes_a_fair_hull_with_its_files() {
    let path = folder("files");
    let out = path.join("out");
    let table = carried(TABLE).display().to_string();
    let arguments = ["fair", &table, "-o", out.to_str().unwrap(), "--draught", "6.828"];
    let output = program(&arguments);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let page = stdout(&output);
    let (first, rest) = page.split_once('\n').unwrap();
    let of_page: Vec<&str> = rest.lines().filter(|line| !line.starts_with("Written to ")).collect();
    assert!(of_page.len() == 7 && of_page.iter().all(|line| line.chars().count() <= 80), "{page}");
    let parts = [
        "Fairer: ",
        " changes of sign (least ",
        " monotone pieces, moves ",
        " mm RMS, displacement, LCB and C_M kept.",
    ];
    assert!(first.starts_with(parts[0]) && parts.iter().all(|part| first.contains(part)), "{page}");
    assert!(rest.contains("Lpp 121.920 m") && rest.contains("kept within") && rest.contains("--verbose"), "{page}");
    let names = names_in(&out);
    let expected = [
        "changes.csv",
        "control-polygon.csv",
        "fairing-body-plan.png",
        "fairing-body-plan.svg",
        "fairing-half-breadth-plan.png",
        "fairing-half-breadth-plan.svg",
        "fairing-moves.png",
        "fairing-moves.svg",
        "fairing.json",
        "fitted-hull.json",
        "hull.json",
        "lcurve.png",
        "lcurve.svg",
        "manifest.json",
        "offsets.csv",
        "offsets.toml",
        "summary.json",
    ];
    assert_eq!(names, expected);
    let certificate = json(read_text(out.join("fairing.json")));
    assert_eq!(certificate["status"], "optimal");
    for key in ["primal", "dual", "gap", "stationarity", "max_violation"] {
        number(&certificate["certificate"][key]);
    }
    assert!(number(&certificate["certificate"]["gap"]).abs() < 1e-8);
    // What fair means, line by line and together.
    let lines = ["stations", "waterlines"].map(|kind| certificate["inflections"][kind].as_array().unwrap().clone());
    let sum = |of: &str| lines.iter().flatten().map(|line| number(&line["pieces"][of]) as u64).sum::<u64>();
    let fair = &certificate["fair"];
    for of in ["before", "after", "least"] {
        assert_eq!(fair["monotone_pieces"][of].as_u64(), Some(sum(of)), "{of}");
    }
    assert!(sum("least") <= sum("after") && sum("after") < sum("before"), "{fair}");
    for line in lines.iter().flatten() {
        let [pieces, least] = ["after", "least"].map(|of| number(&line["pieces"][of]));
        let minimum = number(&line["minimum"]).max(1.0);
        assert!(least >= 1.0 && least <= pieces && least <= minimum, "{line}");
        // None on straight lines; one rise or fall has 1.
        assert!(line["variation"]["after"].as_f64().is_none_or(|variation| variation > 1.0 - 1e-9), "{line}");
    }
    assert!(["before", "after"].iter().all(|of| number(&fair["variation"][of]) > 1.0), "{fair}");
    // The plan has rings where the counts have inflections.
    let band = 1000.0 * number(&certificate["inflections"]["dead_band"]);
    let plan = read_text(out.join("fairing-half-breadth-plan.svg"));
    assert!(plan.contains(&format!("bends {band:.2} mm or more")), "{band}");
    assert!(number(&fair["gaussian_regions"]["after"]) >= 1.0, "{fair}");
    let kinds: Vec<&str> =
        certificate["constraints"].as_array().unwrap().iter().map(|c| c["kind"].as_str().unwrap()).collect();
    assert_eq!(kinds, ["displacement", "lcb", "midship_coefficient"]);
    // Nobody stated the displacement: that of the hull that was written is within two standard errors of the field's.
    let written = read_source(&out.join("hull.json")).unwrap().hull;
    let held = &certificate["constraints"][0];
    let volume = loftsman::internals::hull::Functional::Volume.value(&written, written.reference_height());
    let [low, high] = ["low", "high"].map(|key| number(&held[key]));
    assert!((low..=high).contains(&volume) && low < number(&held["target"]), "{volume} {held}");
    assert!((5e-5..1e-3).contains(&(high / low - 1.0)) && number(&held["residual"]).abs() < 1e-12, "{held}");
    assert!((volume / number(&held["after"]) - 1.0).abs() < 1e-10, "{volume} {held}");
    assert!((number(&held["after"]) / number(&held["before"]) - 1.0).abs() < 2e-3, "{held}");
    // The same bytes once more; what is there is not overwritten unasked.
    let again = path.join("again");
    let second = program(&["fair", arguments[1], "-o", again.to_str().unwrap(), "-q", "--draught", "6.828"]);
    assert!(second.status.success() && second.stdout.is_empty(), "{}", stdout(&second));
    assert!(stderr(&second).lines().all(|line| line.starts_with("W402")), "{}", stderr(&second));
    for name in &names {
        assert!(fs::read(out.join(name)).unwrap() == fs::read(again.join(name)).unwrap(), "{name}");
    }
    assert_eq!(program(&arguments).status.code(), Some(6));
    let announced = read_fair(&carried(TABLE), &[]).unwrap().outputs();
    assert!(announced.len() == 8 && announced.iter().all(|name| names.contains(name)), "{announced:?}");
}

#[test]
fn the_table_keeps_its_notation_and_says_what_rounding_did() {
    let (job, outputs) = faired(&carried(TABLE), &[]);
    let (old, new) = (read_text(carried(TABLE)), file(&outputs, "offsets.csv"));
    assert_eq!(old.lines().next(), new.lines().next());
    assert_eq!(old.lines().count(), new.lines().count());
    let table = read_table("offsets.csv", new.as_bytes()).unwrap().table;
    let quantum = table.form.quantum().unwrap();
    assert_eq!(job.table.form.quantum(), Some(quantum));
    let mut worst = 0.0_f64;
    for (a, b) in outputs.outcome.table.stations.iter().zip(&table.stations) {
        for (a, b) in a.half_breadths.iter().zip(&b.half_breadths) {
            match (a.value(), b.value()) {
                (Some(a), Some(b)) => worst = worst.max((a - b).abs()),
                (a, b) => assert_eq!(a.is_some(), b.is_some()),
            }
        }
    }
    let said = outputs.rounding.largest;
    assert!(worst <= 0.5 * quantum + 1e-12 && (said - worst).abs() < 1e-9, "{worst} {said}");
    assert!(outputs.rounding.volume_share.unwrap().abs() < 1e-4);
    // Texts of the changes are those of the two tables.
    let changes = file(&outputs, "changes.csv");
    let rows: Vec<Vec<&str>> = changes.lines().skip(1).map(|line| line.split(',').collect()).collect();
    // Zeros beyond an end that the field finds are no offsets of the hull.
    let (unused, rows): (Vec<_>, Vec<_>) = rows.into_iter().partition(|row| row.contains(&"not used"));
    assert!(unused.iter().all(|row| row[4].parse::<f64>().is_ok_and(|y| y.abs() < 1e-9)), "{unused:?}");
    assert_eq!(rows.len(), outputs.outcome.changes.len());
    for row in &rows {
        let [before, after, moved] = [4, 5, 6].map(|k| row[k].parse::<f64>().unwrap());
        assert!((after - before - moved).abs() < 1e-12);
        assert!((row[11].parse::<f64>().unwrap() - before).abs() < 1e-9, "{row:?}");
        assert!((row[12].parse::<f64>().unwrap() - after).abs() <= 0.5 * quantum + 1e-9, "{row:?}");
    }
    assert!(rows.iter().any(|row| row[6].parse::<f64>().unwrap().abs() > quantum));
}

#[test]
fn feet_inches_and_eighths_stay_so() {
    let path = folder("eighths");
    let feet = path.join("feet.csv");
    let table = carried("tests/data/wigley/offsets.csv");
    let notation = ["convert", table.to_str().unwrap(), feet.to_str().unwrap(), "--notation", "feet-inches-eighths"];
    let output = program(&notation);
    assert!(output.status.success(), "{}", stderr(&output));
    let (job, outputs) = faired(&feet, &[]);
    let new = file(&outputs, "offsets.csv");
    let back = read_table("offsets.csv", new.as_bytes()).unwrap().table;
    assert_eq!(back.form.notation, job.table.form.notation);
    assert!(outputs.rounding.largest <= 0.0254 / 32.0 + 1e-12 && outputs.rounding.largest > 0.0);
    let page = fair_page(&job, &outputs, "out");
    assert!(page.contains("kept within 1/8 in"), "{page}");
}

/// What is unknown in the table is predicted: told, with its place, and doubtful in the fair table.
#[test]
fn unknown_offsets_are_predicted() {
    let path = folder("unknown");
    let text = read_text(carried("tests/data/series60_cb060/offsets.csv"));
    assert!(text.contains(",2.6420,3.3569,4.3972,"));
    let table = path.join("table.csv");
    fs::write(&table, text.replace(",2.6420,3.3569,4.3972,", ",2.6420,?,4.3972,")).unwrap();
    let out = path.join("out").display().to_string();
    let output = program(&["fair", &table.display().to_string(), "-o", &out, "--no-figures", "--verbose"]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let changes = read_text(path.join("out/changes.csv"));
    let mut rows = changes.lines().map(|line| line.split(',').collect::<Vec<&str>>());
    let last = rows.find(|row| row.get(11) == Some(&"?")).unwrap();
    assert_eq!((last[0], last[3], last[4]), ("18.288", "3.2512", ""));
    assert!((last[5].parse::<f64>().unwrap() - 3.3569).abs() < 0.02, "{last:?}");
    assert!(last[12].starts_with("(3.3") && last[12].ends_with(')'), "{last:?}");
    let fair = read_text(path.join("out/offsets.csv"));
    assert!(fair.contains(&format!(",{},", last[12])), "{fair}");
    assert!(String::from_utf8_lossy(&output.stdout).contains("1 unknown offset"));
    let output = program(&["report", &out, "-o", &path.join("report").display().to_string(), "--dpi", "30"]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
}

/// Cells that no part of the hull reads are listed as they stay.
#[test]
fn changes_list_every_offset_of_the_table() {
    let (job, outputs) = faired(&carried(TABLE), &[]);
    let given = |cell: &&loftsman::internals::hull::Cell| cell.value().is_some();
    let all = job.table.stations.iter().flat_map(|station| &station.half_breadths).filter(given).count();
    let changes = file(&outputs, "changes.csv");
    let not_used = changes.lines().filter(|row| row.ends_with(",not used")).count();
    assert_eq!(changes.lines().count() - 1, all);
    assert_eq!(not_used, all - outputs.outcome.changes.len());
}

#[test]
fn a_changed_file_is_faired_again() {
    use std::io::{BufRead, BufReader};
    use std::time::{Duration, SystemTime};
    let path = folder("watch");
    let table = path.join("table.csv");
    fs::copy(carried(TABLE), &table).unwrap();
    let out = path.join("out");
    let mut child = command(&["fair", table.to_str().unwrap(), "-o", out.to_str().unwrap(), "--watch", "--no-figures"])
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    let mut lines = BufReader::new(child.stdout.take().unwrap()).lines();
    let first = lines
        .find(|line| line.as_ref().is_ok_and(|line| line.contains("Written to") || line.contains("manifest.json")));
    assert!(first.is_some());
    let before = fs::read(out.join("fairing.json")).unwrap();
    // A tenth of a metre narrower at the upper edge of five stations is another hull.
    let text = read_text(&table).replace("8.1280\n", "8.0280\n");
    fs::write(&table, text).unwrap();
    let later = SystemTime::now() + Duration::from_secs(2);
    fs::File::options().write(true).open(&table).unwrap().set_modified(later).unwrap();
    let again = lines.find(|line| line.as_ref().is_ok_and(|line| line.starts_with("optimal: volume below z = ")));
    child.kill().unwrap();
    child.wait().unwrap();
    assert!(again.is_some());
    assert_ne!(before, fs::read(out.join("fairing.json")).unwrap());
}

/// Stations that have numbers stand where the job's L_PP puts them, and the fair table says so; without a length that
/// is told.
#[test]
fn numbered_stations_stand_where_the_length_of_the_job_puts_them() {
    let folder = folder("numbered");
    let numbered = folder.join("numbered.csv");
    fs::write(&numbered, wigley_table(|station| format!("{station}"))).unwrap();
    let (_, outputs) = faired(&numbered, &[]);
    assert!(outputs.outcome.notes.iter().any(|note| note.starts_with("W320 stations are numbered")));
    let metres = folder.join("metres.csv");
    fs::write(&metres, wigley_table(|station| format!("{} m", 5.0 * station))).unwrap();
    let (_, wanted) = faired(&metres, &[("--job", "dimensions.Lpp", "100 m")]);
    let volume = |outputs: &FairOutputs| outputs.certificate["constraints"][0]["after"].as_f64().unwrap();
    // One file beside the table says another length, and more.
    for beside in [None, Some("[table]\nname = \"Wigley\"\nLpp = 50.0\n")] {
        if let Some(beside) = beside {
            fs::write(folder.join("numbered.toml"), beside).unwrap();
        }
        let (_, outputs) = faired(&numbered, &[("--job", "dimensions.Lpp", "100 m")]);
        assert!((volume(&outputs) / volume(&wanted) - 1.0).abs() < 1e-9, "{} {}", volume(&outputs), volume(&wanted));
        assert!(outputs.rounding.volume_share.unwrap().abs() < 1e-4);
        // The fair table alone is that hull, to what a table tells of its volume.
        let again = folder.join("again.csv");
        fs::write(&again, file(&outputs, "offsets.csv")).unwrap();
        fs::write(folder.join("again.toml"), file(&outputs, "offsets.toml")).unwrap();
        let (job, repeated) = faired(&again, &[]);
        assert!((volume(&repeated) / volume(&wanted) - 1.0).abs() < 1e-4);
        assert_eq!(job.table.name == "Wigley", beside.is_some());
    }
}

#[test]
fn a_table_that_is_read_is_not_written_over() {
    let path = folder("own");
    let table = path.join("offsets.csv");
    fs::copy(carried(TABLE), &table).unwrap();
    let before = fs::read(&table).unwrap();
    let output = program(&["fair", table.to_str().unwrap(), "-o", path.to_str().unwrap(), "--force"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(stderr(&output).contains("is read and would be overwritten"), "{}", stderr(&output));
    assert_eq!(fs::read(&table).unwrap(), before);
    assert_eq!(fs::read_dir(&path).unwrap().count(), 1);
}

#[test]
fn every_job_of_the_examples_runs() {
    let mut files: Vec<PathBuf> =
        fs::read_dir(carried("configs/fair")).unwrap().map(|entry| entry.unwrap().path()).collect();
    files.sort();
    assert!(!files.is_empty());
    for path in files {
        let (job, outputs) = faired(&path, &[]);
        outputs.verdict().unwrap_or_else(|failure| panic!("{}: {failure}", path.display()));
        let page = fair_page(&job, &outputs, "out");
        assert!(page.contains("holding it"), "{page}");
        for held in &outputs.outcome.held {
            let error = (held.after - held.constraint.target()).abs() / held.constraint.target().abs();
            assert!(error < 1e-10, "{}: {} {error:e}", path.display(), held.constraint.key());
        }
    }
}
