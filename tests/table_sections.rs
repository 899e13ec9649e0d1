//! Tables that are converted keep their sections; files of other kinds are refused in one message; all problems of a
//! table are said at once; particulars that contradict a table are warned of.

use std::fs;

use loftsman::internals::exchange::{
    Severity, TableProblem, TableWriting, read_table, read_table_with, write_britfair, write_freeship, write_ghs,
    write_pdstrip, write_pias, write_table,
};
use loftsman::internals::hull::{OffsetTable, OutlinePoint, StationOffsets, TableLayout};
use loftsman::internals::units::Notation;

use crate::support::{among, carried, convert, folder, notes, program, read, read_text, stderr, stdout};

fn shown(problems: &[TableProblem]) -> String {
    problems.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n")
}

fn errors(name: &str, bytes: &[u8]) -> Vec<String> {
    let problems = read_table(name, bytes).expect_err("the table is refused");
    problems.iter().filter(|p| p.severity == Severity::Error).map(ToString::to_string).collect()
}

/// Largest distance of the points of two tables; infinite when they have not the same stations, branches and points
/// \[m\].
fn apart(a: &OffsetTable, b: &OffsetTable) -> f64 {
    let shape = |t: &OffsetTable| -> Vec<Vec<usize>> {
        t.stations.iter().map(|s| s.outlines.iter().map(Vec::len).collect()).collect()
    };
    if shape(a) != shape(b) {
        return f64::INFINITY;
    }
    let points = |t: &OffsetTable| -> Vec<[f64; 3]> {
        let of = |s: &StationOffsets| -> Vec<[f64; 3]> {
            s.outlines.iter().flatten().map(|p| [s.station.x, p.y, p.z]).collect()
        };
        t.stations.iter().flat_map(of).collect()
    };
    points(a).iter().zip(points(b)).flat_map(|(p, q)| (0..3).map(move |k| (p[k] - q[k]).abs())).fold(0.0, f64::max)
}

fn ship() -> OffsetTable {
    let station = |name: &str, x: f64, points: &[(f64, f64)]| StationOffsets {
        outlines: vec![points.iter().map(|&(y, z)| OutlinePoint { y, z, marks: Default::default() }).collect()],
        ..StationOffsets::new(name, x)
    };
    OffsetTable {
        stations: vec![
            station("0", 0.0, &[(0.0, 1.0), (2.25, 2.0), (3.0, 4.0)]),
            station("1", 12.5, &[(0.0, 0.0), (3.5, 0.5), (4.0, 4.0)]),
            station("2", 25.0, &[(0.0, 0.25), (1.0, 2.0), (1.5, 4.0)]),
        ],
        ..OffsetTable::default()
    }
}

/// A writer of a program's text.
type Writer = fn(&OffsetTable) -> String;

#[test]
fn formats_with_a_writer_are_written_in_their_own() {
    let all: [(&str, Writer); 5] = [
        ("a.gf", write_ghs),
        ("a.bri", write_britfair),
        ("a.pias", write_pias),
        ("geomet.out", write_pdstrip),
        ("a.txt", write_freeship),
    ];
    for (name, write) in all {
        let first = read(name, &write(&ship())).table;
        let written = write_table(&first, TableWriting::default());
        let again = read(name, &written.text).table;
        assert_eq!(again.form.program, first.form.program, "{name}");
        assert!(again.form.program.is_some(), "{name}");
        assert_eq!(written.rounding.cells, 9, "{name}");
        assert!(apart(&first, &again) < 1.6e-5, "{name} {}", apart(&first, &again));
        // Another notation goes with a table of this program.
        let writing = TableWriting { notation: Some(Notation::Millimetres), layout: None };
        let tidy = read("a.csv", &write_table(&first, writing).text).table;
        assert_eq!(tidy.form.layout, TableLayout::Tidy, "{name}");
        assert!(apart(&first, &tidy) < 0.51e-3, "{name} {}", apart(&first, &tidy));
    }
}

#[test]
fn points_without_a_writer_become_a_tidy_table() {
    let path = carried("tests/data/s175/sections.csv");
    let first = read("sections.csv", &read_text(path)).table;
    let points = first.stations.iter().flat_map(|s| s.outlines.iter().flatten()).count();
    assert!(points > 300, "{points}");
    let tidy = write_table(&first, TableWriting::default());
    assert_eq!(tidy.text.matches(",SEC,").count(), points);
    let again = read("tidy.csv", &tidy.text).table;
    assert!(apart(&first, &again) < 0.51e-3, "{}", apart(&first, &again));
    let sides = |t: &OffsetTable| -> Vec<[Option<f64>; 3]> {
        t.stations.iter().map(|s| [s.keel_height, s.deck_height, s.deck_centre_height]).collect()
    };
    assert_eq!(sides(&first), sides(&again));
}

#[test]
fn branches_and_particulars_outlive_a_tidy_table() {
    let mut ship = ship();
    let bulb = [(0.0, 0.25), (1.0, 1.0), (0.5, 2.0)].map(|(y, z)| OutlinePoint { y, z, marks: Default::default() });
    ship.stations[2].outlines = vec![
        bulb.to_vec(),
        vec![OutlinePoint { y: 0.25, z: 3.0, ..bulb[0] }, OutlinePoint { y: 1.5, z: 4.0, ..bulb[0] }],
    ];
    (ship.form.layout, ship.name) = (TableLayout::Other, "small ship".to_owned());
    (ship.stated.length_between_perpendiculars, ship.stated.draught) = (Some(25.0), Some(2.5));
    let text = write_table(&ship, TableWriting::default()).text;
    let again = read("a.csv", &text).table;
    assert!(apart(&ship, &again) < 1e-12, "{text}");
    assert_eq!((again.stated, again.name.as_str()), (ship.stated, "small ship"));
}

#[test]
fn the_command_refuses_a_matrix_of_points() {
    let folder = folder("sections");
    let path = folder.join("a.bri");
    fs::write(&path, write_britfair(&ship())).unwrap();
    let path = path.display().to_string();
    let own = convert(&[&path]);
    assert_eq!(own.status.code(), Some(0));
    assert_eq!(stdout(&own), write_britfair(&ship()));
    let said = stderr(&own);
    assert!(said.contains("rounding: 9 offsets") && !said.contains("not written"), "{said}");
    let matrix = convert(&[&path, "--layout", "matrix"]);
    assert_eq!(matrix.status.code(), Some(2));
    assert!(matrix.stdout.is_empty());
    assert!(stderr(&matrix).contains("--layout tidy"));
    let feet = convert(&[&path, "--notation", "mm"]);
    assert!(stderr(&feet).contains("a tidy table of 9 points"));
}

#[test]
fn notes_of_the_reading_reach_the_user() {
    let folder = folder("notes");
    let path = folder.join("a.csv");
    let mut text = "x,0,500,1000,2000\n".to_owned();
    for (x, y) in [(20_000, 0), (15_000, 1500), (10_000, 2000), (5000, 1500), (0, 0)] {
        text += &format!("{x},0,{},{},{y}\n", y / 2, 3 * y / 4);
    }
    fs::write(&path, text).unwrap();
    for job in [vec!["hydro", "--draughts", "1.5"], vec!["offsets", "--stations", "10", "--waterlines", "1"]] {
        let arguments = [&job[..1], &[path.to_str().unwrap()], &job[1..]].concat();
        let said = stderr(&program(&arguments));
        for part in ["taken as millimetres", "rows are stations", "their order is turned", "W306"] {
            assert!(said.contains(part), "{arguments:?} {part}\n{said}");
        }
    }
}

#[test]
fn pairs_keep_their_commas_out_of_the_numbers() {
    let text = "STN 0,STN 1\n\"(0,0)\",\"0,0\"\n\"0.5,1\",\"0,1\"\n\"1.5,2\",\"0.25,2\"\n";
    let first = read("pairs.csv", text).table;
    assert!(!first.form.decimal_comma);
    for layout in [TableLayout::Matrix, TableLayout::Tidy] {
        let written = write_table(&first, TableWriting { notation: None, layout: Some(layout) }).text;
        let again = read("a.csv", &written).table;
        assert_eq!(again.waterlines, first.waterlines, "{written}");
        let values = |t: &OffsetTable| -> Vec<Option<f64>> {
            t.stations.iter().flat_map(|s| &s.half_breadths).map(|c| c.value()).collect()
        };
        assert_eq!(values(&again), values(&first), "{written}");
    }
}

#[test]
fn structure_hides_no_cell() {
    let text = "x [m],0.5,1,1.5\n0,1,abc,2\n10,1,2\n10,3-11-9,2,3\n20,1,2,3\n";
    let found = errors("t.csv", text.as_bytes());
    assert_eq!(found.len(), 4, "{found:?}");
    among(&found, &["E301", "row 2, column 3", "'abc'"]);
    among(&found, &["E307", "row 3", "3 fields, the header has 4"]);
    among(&found, &["E306", "row 4, column 1", "stands in row 3"]);
    among(&found, &["E301", "row 4, column 2", "eighths are 0 to 7"]);
    let found = errors("t.csv", b"x [m],0.5,foo,1.5,1\n0,1,abc,2,2\n10,1,2,3.3.3,2\n");
    among(&found, &["E310", "'foo'"]);
    among(&found, &["'abc'"]);
    among(&found, &["'3.3.3'"]);
    let found = errors("t.csv", b"STN 0,foo,STN 1\n\"0.5,1\",\"0.5,1\",\"1.5,1\"\nx,\"0.5,1\",\"1.5,1\"\n");
    assert_eq!(found.len(), 2, "{found:?}");
}

#[test]
fn lengths_of_no_ship() {
    let found = errors("t.csv", b"x [m],0.5,1\n0,1,1e280\n10,1e6,2\n20,1,2\n");
    among(&found, &["E315 t.csv row 2, column 3: '1e280': a length of 1e280 m is no ship's"]);
    among(&found, &["row 3, column 2"]);
    among(&errors("t.csv", b"x [m],0.5,1\n0,1,1\n1e280,1,2\n"), &["row 3, column 1", "is no ship's"]);
    among(&errors("t.csv", b"x [m],0.5,1e9\n0,1,1\n10,1,2\n"), &["row 1, column 3", "is no ship's"]);
    let mut far = ship();
    far.stations[1].outlines[0][1].y = 3e5;
    for (name, text) in [("a.bri", write_britfair(&far)), ("a.pias", write_pias(&far)), ("a.gf", write_ghs(&far))] {
        among(&errors(name, text.as_bytes()), &["E321"]);
    }
    let points = "x_m,y_m,z_m\n0,0,0\n0,1,1\n5,0,0\n5,3e5,1\n";
    among(&errors("a.csv", points.as_bytes()), &["E321", "is no ship's"]);
}

#[test]
fn the_notation_is_that_of_the_offsets() {
    let text = "x [m],0.5,1,1.5\n0,3-4-5,4-0-0,1.5\n10,5-1-2,6-0-1,7-3-4+\n";
    let read = read("t.csv", text).table;
    assert_eq!(read.form.notation, Notation::FeetInchesEighths);
    assert!(read.form.quantum().is_some_and(|q| q < 0.005), "{:?}", read.form.quantum());
    assert_eq!(write_table(&read, TableWriting::default()).text, text);
    // Where the unit of the offsets is said elsewhere it goes with the table.
    let units = Some(("t.toml", "[table]\nunits = \"m\"\n"));
    let metres = "x [ft],0.5,1\n0,1.5,2\n30,2,3\n";
    let other = read_table_with("t.csv", metres.as_bytes(), units).unwrap().table;
    let written = write_table(&other, TableWriting::default()).text;
    assert_eq!(written, format!("# units = m\n{metres}"));
    let again = read_table("t.csv", written.as_bytes()).unwrap().table;
    let values = |table: &OffsetTable| table.stations[1].half_breadths.iter().map(|c| c.value()).collect::<Vec<_>>();
    assert_eq!(values(&again), values(&other));
    assert!((again.stations[1].station.x - 9.144).abs() < 1e-12);
    // One cell with a digit more does not make the table finer.
    let digits = |text: &str| read_table("t.csv", text.as_bytes()).unwrap().table.form.decimals;
    assert_eq!(digits("x [m],0.5,1,1.5\n0,1.25,2,1.559\n10,1.5,2.75,3.25\n"), Some(2));
    assert_eq!(digits("x [m],0.5,1\n0,1,2\n10,2,2.1234\n"), Some(4));
    assert_eq!(digits("x [mm],500,1000\n0,1000,2000\n10000,2000,3000\n"), Some(0));
}

#[test]
fn particulars_that_contradict_the_table() {
    let text = "x [m],0,0.5,1,1.5\n0,0,0.5,1,1.2\n10,0,1,2,3\n20,0,1,1.5,2\n";
    among(&notes(text, "[table]\nT = 2.5\n"), &["W308", "T is stated as 2.5 m", "1.500 m", "1.000 m below"]);
    among(&notes(text, "[table]\nB = 8\n"), &["W309", "8 m", "6.000 m: -25.0 %"]);
    among(&notes(text, "[table]\nB = 5.5\n"), &["W309", "+9.1 %"]);
    among(&notes(text, "[table]\nLpp = 62\n"), &["W310", "62 m", "20.000 m"]);
    let quiet = notes(text, "[table]\nLpp = 20\nB = 5.9\nT = 1.5\n");
    assert!(!quiet.iter().any(|n| ["W308", "W309", "W310"].iter().any(|code| n.contains(code))), "{quiet:?}");
    // Flare above the draught is no contradiction.
    assert!(!notes(text, "[table]\nB = 4\nT = 1\n").iter().any(|n| n.contains("W309")));
}

#[test]
fn keys_in_any_case_and_several_in_a_comment() {
    let text = "x [m],0.5,1\n0,1,2\n10,2,3\n";
    let stated = |text: &str, toml: Option<&str>| {
        let read = read_table_with("t.csv", text.as_bytes(), toml.map(|toml| ("t.toml", toml)));
        read.unwrap_or_else(|p| panic!("{}", shown(&p))).table.stated
    };
    let beside = stated(text, Some("[Table]\nLPP = 10\nb = 6.0\n"));
    let comments = stated(&format!("# Lpp = 10 m, B = 6 m\n{text}"), None);
    assert_eq!((beside.length_between_perpendiculars, beside.breadth), (Some(10.0), Some(6.0)));
    assert_eq!(beside, comments);
    let wrong = |toml: &str| {
        let read = read_table_with("t.csv", text.as_bytes(), Some(("t.toml", toml)));
        read.expect_err("refused").iter().map(ToString::to_string).collect::<Vec<_>>()
    };
    among(&wrong("Lpp = 10\n"), &["E311", "'Lpp'", "below a line [table]"]);
    among(&wrong("B = 10\n[table]\nT = 1\n"), &["E311", "'B'", "below a line [table]"]);
    among(&wrong("hull = 10\n[table]\nT = 1\n"), &["E311", "'hull'", "Known are [table]"]);
    among(&wrong("[tables]\nT = 1\n"), &["E311", "'tables'", "Did you mean [table]?"]);
}

#[test]
fn units_of_each_direction_by_its_size() {
    let text = "x\\z,0.5,1,2\n0,0,500,1000\n10,1500,2000,2500\n20,0,500,1000\n";
    let all = read("t.csv", text);
    assert_eq!(all.table.waterlines, [0.5, 1.0, 2.0]);
    assert!((all.table.stations[2].station.x - 20.0).abs() < 1e-12);
    assert!((all.table.stations[1].half_breadths[2].value().unwrap() - 2.5).abs() < 1e-12);
    among(&notes(text, ""), &["half-breadths up to 2500 are taken as millimetres"]);
    among(&notes(text, ""), &["heights up to 2 are taken as metres"]);
    // A model with half-breadths that would pass for metres.
    let model = "x\\z,0.05,0.1\n0,0,50\n1,90,100\n2,0,50\n";
    assert!((read("t.csv", model).table.stations[1].half_breadths[1].value().unwrap() - 0.1).abs() < 1e-12);
    // All of a model in millimetres, low as it is.
    let model = "x\\z,50,100\n0,0,50\n1000,140,150\n2000,0,50\n";
    let model = read("t.csv", model).table;
    assert!((model.waterlines[1] - 0.1).abs() < 1e-12 && (model.stations[2].station.x - 2.0).abs() < 1e-12);
}

#[test]
fn a_header_that_contradicts_the_numbers() {
    // The first row under 'Station' tapers to both of its ends, as a waterline does.
    let text = "Station,0,5,10,15,20\n1,0,2,3,2,0\n2,0.2,2.5,3,2.5,0.5\n3,0.5,2.8,3,2.8,1\n";
    among(
        &notes(text, ""),
        &["W320", "rows are not taken as stations: the hull would be 2 long, 6 broad and 20 high", "rows = "],
    );
    let low = text.replace("0,5,10,15,20", "0,1,2,3,4");
    among(&notes(&low, ""), &["W320", "rows are taken as stations by the first header 'Station'", "rows = "]);
    let usual = "Station,1,2,3\n0,0,0.2,0.5\n5,2,2.5,2.8\n10,3,3,3\n20,0,0.5,1\n";
    assert!(!notes(usual, "").iter().any(|n| n.contains("by the first header")), "{:?}", notes(usual, ""));
}

#[test]
fn files_of_other_kinds_in_one_message() {
    let cases: [(&str, &[u8], &str); 2] =
        [("a.csv.gz", b"\x1f\x8b\x08\0\0\0\0\0", "gzip"), ("hull.json", b"{\n  \"schema\": \"hull\"\n}", "JSON")];
    for (name, bytes, kind) in cases {
        let found = errors(name, bytes);
        assert_eq!(found.len(), 1, "{name} {found:?}");
        assert!(found[0].contains("E300") && found[0].contains(kind) && found[0].contains("is not read"), "{found:?}");
    }
}

#[test]
fn a_count_alone_is_no_format() {
    for lines in [200_002, 150_000] {
        let found = errors("t.csv", "1\n".repeat(lines).as_bytes());
        assert!(found[0].contains(if lines > 200_000 { "E312" } else { "E300" }), "{found:?}");
    }
    let long = format!("hull\n1\n2 0 0\n{}0\n0 0 0\n", "1 1\n".repeat(200_010));
    among(&errors("a.bri", long.as_bytes()), &["E312", "more than 200000 rows"]);
}
