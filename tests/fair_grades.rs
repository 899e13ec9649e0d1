//! `fair --grades`: one table at all whole grades of fairness.

use std::fs;

use loftsman::internals::plot::{GradePoint, grades_figure};
use loftsman::internals::report::read_source;

use crate::support::{carried, folder, json, names_in, program, read_text, stderr, stdout, table_of};

const YACHT: &str = "tests/data/pdstrip_yacht/offsets.csv";

/// Columns of `grades.csv`.
const CHANGES: [usize; 2] = [3, 4];
const RMS: usize = 6;
const ENERGY: usize = 8;

#[test]
fn all_grades_are_written_beside_the_one_that_is_asked_for() {
    let path = folder("grades");
    let (table, out) = (carried(YACHT).display().to_string(), path.join("out"));
    let fair = |more: &[&str]| {
        let options = ["fair", &table, "-o", out.to_str().unwrap(), "--no-figures", "--force"];
        let output = program(&[&options, more].concat());
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
        stdout(&output)
    };
    let page = fair(&["--grades", "--verbose"]);
    assert!(page.contains("grades.csv") && page.contains("grades/10/hull.json"), "{page}");
    let csv = read_text(out.join("grades.csv"));
    let rows: Vec<Vec<&str>> = csv.lines().skip(1).map(|line| line.split(',').collect()).collect();
    let grades: Vec<&str> = rows.iter().map(|row| row[0]).collect();
    assert_eq!(grades, ["0", "1", "2", "3", "4", "5", "6", "7", "8", "9", "10"]);
    assert!(csv.lines().all(|line| line.split(',').count() == 13) && csv.contains("move RMS [m]"), "{csv}");
    let number = |row: &[&str], column: usize| row[column].parse::<f64>().unwrap();
    for pair in rows.windows(2) {
        let [low, high] = [&pair[0], &pair[1]];
        assert!(number(high, RMS) > number(low, RMS), "{csv}");
        assert!(number(high, ENERGY) < number(low, ENERGY), "{csv}");
        let changes = |row: &[&str]| CHANGES.map(|column| number(row, column)).iter().sum::<f64>();
        assert!(changes(high) <= changes(low), "{csv}");
    }
    // The row of a grade is of the result that has its number in fairing.json.
    let hull = |grade: &str| fs::read(out.join(format!("grades/{grade}/hull.json"))).unwrap();
    assert_eq!(hull("5"), fs::read(out.join("hull.json")).unwrap());
    let certificate = json(read_text(out.join("fairing.json")));
    assert!((number(&rows[5], RMS) - certificate["moves"]["rms"].as_f64().unwrap()).abs() < 1e-9);
    let manifest = json(read_text(out.join("manifest.json")));
    let files = manifest["outputs"].as_array().unwrap();
    let listed = files.iter().filter(|file| file["file"].as_str().unwrap().starts_with("grades")).count();
    assert_eq!(listed, 12);
    // The hull of grade 0 has every offset to half the resolution.
    let table = table_of(carried(YACHT));
    let raw = read_source(&out.join("grades/0/hull.json")).unwrap().hull;
    let half = 0.5 * table.form.quantum().unwrap();
    let mut compared = 0;
    for station in &table.stations {
        for (cell, &z) in station.half_breadths.iter().zip(&table.waterlines) {
            if let Some((offset, own)) = cell.value().zip(raw.half_breadth(station.station.x, z)) {
                assert!((own - offset).abs() <= half * (1.0 + 1e-3), "{} {z}: {own} {offset}", station.station.name);
                compared += 1;
            }
        }
    }
    assert!(compared > 100, "{compared}");
    // Each grade is what the dial gives alone; files of all grades go with the next run without them.
    let smooth = hull("8");
    fair(&["--fairness", "8"]);
    assert_eq!(smooth, fs::read(out.join("hull.json")).unwrap());
    assert!(!names_in(&out).iter().any(|name| name.starts_with("grades")), "{:?}", names_in(&out));
}

/// A job file has its grade; that of another is not its result.
#[test]
fn a_job_is_done_at_all_grades() {
    let path = folder("job");
    let table = carried(YACHT).display().to_string();
    let job = path
        .write("job.toml", format!("fairness = \"light\"\n[table]\nfile = {table:?}\n[lock]\nlines = [\"stem\"]\n"));
    let out = path.join("out");
    let output = program(&["fair", &job, "-o", out.to_str().unwrap(), "--grades"]);
    assert!(matches!(output.status.code(), Some(0 | 5)), "{}", stderr(&output));
    let hull = |name: &str| fs::read(out.join(name)).unwrap();
    assert_eq!(hull("grades/3/hull.json"), hull("hull.json"));
    assert_ne!(hull("grades/5/hull.json"), hull("hull.json"));
    let csv = read_text(out.join("grades.csv"));
    assert!(csv.lines().count() == 12 && csv.lines().nth(1).unwrap().starts_with("0,optimal,met,"), "{csv}");
    let names = names_in(&out);
    assert!(["grades.png", "grades.svg"].iter().all(|name| names.contains(&(*name).to_owned())), "{names:?}");
    // What is there is not overwritten unasked.
    fs::remove_file(out.join("hull.json")).unwrap();
    assert_eq!(program(&["fair", &job, "-o", out.to_str().unwrap(), "--grades"]).status.code(), Some(6));
}

/// Grades that lie on each other have marks and numbers of their own, and what is not met is red.
#[test]
fn the_figure_marks_every_grade() {
    let point = |grade: f64, rms: f64| GradePoint {
        grade,
        rms,
        changes: 20 - grade as usize,
        energy: Some(2.0 - 0.1 * grade),
        met: grade > 0.0,
        asked: (grade - 5.0).abs() < 1e-9,
    };
    let points: Vec<GradePoint> = (0..11).map(|grade| point(f64::from(grade), 1e-6 * f64::from(grade / 3))).collect();
    let svg = grades_figure("Yacht", false, &points).unwrap().unwrap();
    let text = svg.as_str();
    // All marks but the filled one have a white inside, in both charts.
    let areas = text.split("<polygon").skip(1).filter_map(|rest| rest.split("/>").next());
    assert_eq!(areas.filter(|area| area.contains("#ffffff")).count(), 20, "{text}");
    assert!(text.contains("red: not all targets are met") && text.contains("energy / that of the start"));
    let still: Vec<GradePoint> = points.iter().map(|point| GradePoint { rms: 0.0, ..point.clone() }).collect();
    assert!(grades_figure("Yacht", false, &still).unwrap().is_none());
}
