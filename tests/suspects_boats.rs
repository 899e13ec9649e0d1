//! Typing errors in tables of lines, as boats have them, and lines of such tables that are no lines of the hull itself.

use std::fmt::Write as _;

use loftsman::internals::exchange::{ReadTable, TableWriting, read_table, write_table};
use loftsman::internals::fairing::{PointSuspects, point_suspects};
use loftsman::internals::hull::OffsetTable;
use serde_json::Value;

use crate::support::{carried, folder, json, program, read_text, stderr, stdout};

/// Stations of the boat, 2 ft apart.
const STATIONS: usize = 13;

/// Lengths in eighths of an inch, as `feet-inches-eighths`.
fn written(inches: f64) -> String {
    let eighths = (8.0 * inches).round() as i64;
    let (sign, eighths) = (if eighths < 0 { "-" } else { "" }, eighths.abs());
    format!("{sign}{}-{}-{}", eighths / 96, eighths % 96 / 8, eighths % 8)
}

type Line = (&'static str, fn(f64) -> f64, fn(f64) -> f64);

/// Heights and half-breadths over -1 to 1 \[in\]: a round boat of two chines with a siding of 2 1/4 in.
const LINES: [Line; 4] = [
    ("sheer", |s| 36.0 + 8.0 * s * s + 2.0 * s.powi(3), |s| 2.0 + 40.0 * (1.0 - s.abs().powf(2.4)).max(0.0)),
    ("upper chine", |s| 20.0 + 6.0 * s * s + 2.0 * s.powi(3), |s| 1.5 + 36.0 * (1.0 - s.abs().powf(2.2)).max(0.0)),
    ("lower chine", |s| 9.0 + 7.0 * s * s + 3.0 * s.powi(3), |s| 1.2 + 27.0 * (1.0 - s * s).max(0.0)),
    ("keel", |s| 2.0 + 4.0 * s * s, |_| 1.125),
];

/// Rows of the table; those of lines begin with the fourth and the ninth.
fn rows() -> Vec<Vec<String>> {
    let row = |name: &str, of: &dyn Fn(usize) -> String| -> Vec<String> {
        std::iter::once(name.to_owned()).chain((0..STATIONS).map(of)).collect()
    };
    let s = |k: usize| (k as f64 - 6.5) / 6.5;
    let mut rows = vec![row("line", &|k| k.to_string()), row("distance from transom", &|k| written(24.0 * k as f64))];
    for (title, half) in [("heights above base", false), ("half-breadths", true)] {
        rows.push(row(title, &|_| String::new()));
        rows.extend(LINES.map(|(name, z, y)| row(name, &|k| written(if half { y(s(k)) } else { z(s(k)) }))));
    }
    rows
}

fn text(rows: &[Vec<String>]) -> String {
    rows.iter().fold(String::new(), |mut text, row| {
        writeln!(text, "{}", row.join(",")).unwrap();
        text
    })
}

fn read(text: &str) -> ReadTable {
    read_table("boat.csv", text.as_bytes()).unwrap_or_else(|list| panic!("{}\n{text}", list[0]))
}

fn found(rows: &[Vec<String>]) -> PointSuspects {
    point_suspects(&read(&text(rows)).table)
}

/// Another cell of the kind of an error: a foot, figures that are swapped, half an inch and more in the eighths.
fn wrong(cell: &str, kind: &str) -> Option<String> {
    let parts: Vec<i64> = cell.split('-').filter_map(|part| part.parse().ok()).collect();
    let [feet, inches, eighths] = parts[..] else { return None };
    let other = match kind {
        "foot" => [feet + 1, inches, eighths],
        "swap" => [inches, feet, eighths],
        _ => [feet, inches, (eighths + 4) % 8],
    };
    let differs = other != [feet, inches, eighths] && other[0] < 9;
    differs.then(|| format!("{}-{}-{}", other[0], other[1], other[2]))
}

#[test]
fn errors_in_heights_and_half_breadths_of_lines_are_named() {
    let clean = found(&rows());
    assert!(clean.suspects.is_empty() && clean.judged == 2 * STATIONS * LINES.len(), "{:?}", clean.suspects);
    for (kind, least) in [("foot", 0.95), ("swap", 0.9), ("eighths", 0.1)] {
        let (mut planted, mut hit, mut others) = (0, 0, 0);
        for row in [3, 4, 5, 6, 8, 9, 10, 11] {
            for column in (1..=STATIONS).step_by(3) {
                let mut rows = rows();
                let Some(cell) = wrong(&rows[row][column], kind) else { continue };
                let meant = std::mem::replace(&mut rows[row][column], cell);
                planted += 1;
                for suspect in found(&rows).suspects {
                    let place = suspect.line.as_ref().unwrap();
                    if (place.row, place.column) == (row + 1, column + 1) {
                        assert_eq!((suspect.station, place.name.as_str()), (column - 1, rows[row][0].as_str()));
                        hit += 1;
                        assert!(kind != "foot" || suspect.proposed_text == meant, "{meant}: {suspect:?}");
                    } else {
                        others += 1;
                    }
                }
            }
        }
        assert!(f64::from(hit) >= least * f64::from(planted) && others == 0, "{kind}: {hit} of {planted}, {others}");
    }
}

/// The boat of six stations that the program reads as an example.
#[test]
fn a_foot_in_a_skiff_has_its_cell_line_and_station() {
    let folder = folder("skiff");
    let clean = read_text(carried("tests/table_cases/skiff.csv"));
    let path = folder.write("skiff.csv", &clean);
    let done = program(&["check", &path]);
    assert_eq!(done.status.code(), Some(0), "{}", stdout(&done));
    assert!(stdout(&done).contains("36 numbers of lines judged"), "{}", stdout(&done));
    // The bottom of the keel is as broad as its siding of 19 mm.
    assert!(!stderr(&done).contains("W315"), "{}", stderr(&done));
    let path = folder
        .write("foot.csv", clean.replacen("heights,sheer,1-10-0,1-8-4,1-8-0", "heights,sheer,1-10-0,1-8-4,2-8-0", 1));
    let done = program(&["check", &path]);
    assert_eq!(done.status.code(), Some(5), "{}", stderr(&done));
    let page = stdout(&done);
    assert!(page.contains("station 2, height of the sheer (row 3, column 5): 2-8-0"), "{page}");
    assert!(page.contains("wrong foot") && page.contains("1-8-0"), "{page}");
    let done = program(&["check", &path, "--json"]);
    let suspect = &json(stdout(&done))["suspects"][0];
    let expected: [(&str, Value); 5] = [
        ("of", "line".into()),
        ("line", "sheer".into()),
        ("row", 3.into()),
        ("column", 5.into()),
        ("station_name", "2".into()),
    ];
    for (key, value) in expected {
        assert_eq!(suspect[key], value, "{key}: {suspect}");
    }
    let fixed = folder.join("fixed.csv").display().to_string();
    let done = program(&["check", &path, "--accept", "P1", "-o", &fixed]);
    assert_eq!(done.status.code(), Some(0), "{}", stderr(&done));
    assert!(read_text(&fixed).contains("heights,sheer,1-10-0,1-8-4,1-8-0,"), "{}", read_text(&fixed));
    let points =
        |path: &str| read_table("t.csv", read_text(path).as_bytes()).unwrap().table.stations[2].outlines.clone();
    let sheer = points(&fixed)[0].last().copied().unwrap();
    assert!((sheer.z - 20.0 * 0.0254).abs() < 1e-9, "{sheer:?}");
}

#[test]
fn diagonals_are_read_where_words_define_them() {
    let diagonal = |half: f64| -> Vec<String> {
        let s = |k: usize| (k as f64 - 6.5) / 6.5;
        (0..STATIONS).map(|k| written(half * (1.0 - 0.8 * s(k) * s(k)))).collect()
    };
    let row =
        |label: &str| format!("diagonals,{}\n\"{label}\",{}\n", ",".repeat(STATIONS - 1), diagonal(25.0).join(","));
    let plain = text(&rows());
    let note = "\"Diagonal A: up 4-0-0 on CL, out 3-0-0 on base\"\n";
    for text in [
        format!("{plain}{}{note}", row("Diagonal A")),
        format!("{note}{plain}{}", row("A")),
        format!("{plain}{}# Diagonal A: up 4-0-0 on CL, out 3-0-0 on base\n", row("Diag. A")),
        format!("{plain}{}", row("Diagonal A (up 4-0-0 on CL, out 3-0-0 on base)")),
        format!("{plain}{}Diagonal A: up 4-0-0 on CL, out 3-0-0 on base\n", row("Diagonal A")),
    ] {
        let read = read(&text);
        let section = &read.table.stations[6].outlines[0];
        // 25 in from the centreplane along a line of 3 by 4.
        let far = 25.0 * (1.0 - 0.8 / 169.0);
        let is_there = |y: f64, z: f64| section.iter().any(|p| (p.y - y * 0.0254).hypot(p.z - z * 0.0254) < 2e-3);
        assert!(section.len() == 5 && is_there(0.6 * far, 48.0 - 0.8 * far), "{section:?}\n{text}");
        assert!(read.notes.iter().any(|note| note.message.contains("falls by 53.1 degrees")), "{:?}", read.notes);
    }
    let unknown = read(&format!("{plain}{}", row("Diagonal A")));
    let note = unknown.notes.iter().find(|note| note.code == "W332").expect("a warning");
    assert!(note.message.contains("of which nothing says where it lies"), "{note}");
    assert!(note.remedy.contains("up 4-0-0 on CL, out 3-0-0 on base"), "{note}");
    assert_eq!(unknown.table.stations[6].outlines[0].len(), 4);
}

/// Sections as points that begin at the side of a keel, and sections of which the bottom is not known.
#[test]
fn a_siding_is_no_open_bottom() {
    let table = |sections: &dyn Fn(f64) -> Vec<(f64, f64)>| {
        let mut text = "station,x [m],curve,z [m],y [m],flag\n".to_owned();
        for k in 0..9 {
            let s = f64::from(k) / 4.0 - 1.0;
            for (y, z) in sections(1.0 - 0.9 * s * s) {
                writeln!(text, "{k},{k},SEC,{z:.4},{y:.4},").unwrap();
            }
        }
        read(&text).notes.iter().any(|note| note.code == "W315")
    };
    // Half siding of 5, 19, 80 mm of a boat of 1.3 m of half-breadth, with and without the sides of the keel.
    for siding in [0.005, 0.019, 0.08] {
        assert!(!table(&|f| vec![(siding, 0.1), (siding + 0.8 * f, 0.4), (siding + 1.2 * f, 1.2)]), "{siding}");
        assert!(!table(&|f| vec![(siding, 0.0), (siding, 0.2), (siding + 0.8 * f, 0.5), (siding + 1.2 * f, 1.2)]));
    }
    assert!(table(&|f| vec![(0.5 * f, 0.3), (0.9 * f, 0.6), (1.2 * f, 1.2)]), "half of the bottom is not there");
    assert!(table(&|f| vec![(1.2 * f, 0.2), (1.2 * f, 0.6), (1.2 * f, 1.2)]), "no bottom at all");
    assert!(!table(&|f| vec![(1.2 * f, 0.0), (1.2 * f, 0.6), (1.2 * f, 1.2)]), "a flat bottom on the base line");
}

/// A table of lines is written as it was read: the same rows, with the texts of the cells.
#[test]
fn a_table_of_lines_is_written_as_lines() {
    let read = |text: &str| read(text).table;
    let skiff = read_text(carried("tests/table_cases/skiff.csv"));
    // With a waterline and a buttock besides.
    let cuts = skiff.replace("widths,sheer", "widths,WL 1-2-0,1-4-4,1-9-6,1-11-6,1-10-4,1-0-2,0-0-6\nwidths,sheer");
    for text in [&skiff, &cuts] {
        let table = read(text);
        let written = write_table(&table, TableWriting::default());
        assert!(written.text.contains("\nheights,sheer,1-10-0,1-8-4,1-8-0,1-9-2,2-0-0,2-3-0\n"), "{}", written.text);
        assert!(
            written.text.contains("\nhalf-breadths,chine,1-3-0,1-7-4,1-10-0,1-7-6,0-9-4,0-0-6\n"),
            "{}",
            written.text
        );
        assert!(written.rounding.largest < 1e-12);
        let again = read(&written.text);
        for (one, other) in table.stations.iter().zip(&again.stations) {
            assert!((one.station.x - other.station.x).abs() < 1e-9 && one.station.name == other.station.name);
            let points = |station: &loftsman::internals::hull::StationOffsets| -> Vec<[f64; 2]> {
                station.outlines.iter().flatten().map(|point| [point.y, point.z]).collect()
            };
            for (a, b) in points(one).iter().zip(&points(other)) {
                assert!((a[0] - b[0]).abs() < 1e-9 && (a[1] - b[1]).abs() < 1e-9, "{one:?} {other:?}");
            }
            assert_eq!(points(one).len(), points(other).len());
        }
        let names =
            |table: &OffsetTable| table.form.boat_lines.iter().map(|line| line.name.clone()).collect::<Vec<_>>();
        assert_eq!(names(&table).len(), names(&again).len());
    }
    assert!(write_table(&read(&cuts), TableWriting::default()).text.contains("\nhalf-breadths,WL 1-2-0,"));
    // A point that moved has its new number.
    let mut table = read(&skiff);
    table.stations[2].outlines[0][1].y += 0.0254;
    let written = write_table(&table, TableWriting::default()).text;
    assert!(written.contains("\nhalf-breadths,chine,1-3-0,1-7-4,1-11-0,1-7-6,"), "{written}");
}

/// The page of a table in feet has its lengths in feet, inches and eighths, with metres beside.
#[test]
fn lengths_of_a_page_are_written_as_in_the_table() {
    let mut rows = rows();
    rows[4][6] = wrong(&rows[4][6], "foot").unwrap();
    let folder = folder("page-of-feet");
    let path = folder.write("boat.csv", text(&rows));
    let page = stdout(&program(&["check", &path]));
    let expected = page.lines().find(|line| line.contains("expected")).unwrap_or_else(|| panic!("{page}"));
    let after = expected.split("expected ").nth(1).unwrap();
    let (own, metres) = after.split_once(" (").unwrap_or_else(|| panic!("{expected}"));
    let parts: Vec<f64> = own.trim_end_matches('+').split('-').map(|part| part.parse().unwrap()).collect();
    let read = 0.3048 * parts[0] + 0.0254 * (parts[1] + parts[2] / 8.0);
    let metres: f64 = metres.split(" m)").next().unwrap().parse().unwrap();
    assert!((read - metres).abs() < 0.0254 / 8.0, "{expected}");
    assert!(expected.contains("off by +1-"), "{expected}");
    // A grid with feet over its columns and metres along the hull.
    let mut grid = "x [m],1 ft,2 ft,3 ft,4 ft,5 ft,6 ft\n".to_owned();
    for k in 0..12 {
        let s = (f64::from(k) - 5.5) / 5.5;
        let cell = |z: f64| {
            written(
                12.0 * 5.0 * (1.0 - s * s).max(0.0) * (z / 6.0).sqrt()
                    + if k == 5 && z > 3.5 && z < 4.5 { 12.0 } else { 0.0 },
            )
        };
        let cells: Vec<String> = (1..=6).map(|j| cell(f64::from(j))).collect();
        writeln!(grid, "{k},{}", cells.join(",")).unwrap();
    }
    let path = folder.write("grid.csv", grid);
    let page = stdout(&program(&["check", &path]));
    assert!(page.contains("station 5, waterline 4 ft (1.219 m) (row 7, column 5)"), "{page}");
}
