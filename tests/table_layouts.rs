//! Tables as people type them: blanks between columns, one point a row, feet and inches in all writings, rows for several
//! stations, workbooks with titles and notes, rows of lines of boats. Every layout gives the volume of the plain table.

use std::fmt::Write as _;
use std::path::Path;

use loftsman::internals::exchange::{Severity, read_table, read_table_with};
use loftsman::internals::hull::{Cell, OffsetTable, SectionalAreaCurve};
use loftsman::internals::hydrostatics::Conventions;
use loftsman::internals::report::read_hydrostatic_body;

use crate::support::{among, carried, folder, read_text};

/// Volumes of one table on waterlines, and of the same points as sections \[m3\].
const VOLUMES: std::ops::RangeInclusive<f64> = 3151.0..=3187.0;

fn case(name: &str) -> std::path::PathBuf {
    carried("tests/table_cases").join(name)
}

/// The volume of the file at a draught \[m\].
fn volume(path: &Path, draught: f64) -> f64 {
    let body = read_hydrostatic_body(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    let rows = body.curves_of_form(&[draught], &Conventions::default()).unwrap().0.rows;
    rows[0].displacement_volume
}

/// Stations, waterlines and half-breadths of the ship.
fn ship() -> (Vec<String>, Vec<String>, Vec<Vec<String>>) {
    let text = read_text(case("b_long.csv"));
    let (mut xs, mut zs, mut table): (Vec<String>, Vec<String>, Vec<Vec<String>>) = Default::default();
    for line in text.lines().skip(1) {
        let [x, z, y] = line.split(',').map(str::to_owned).collect::<Vec<_>>().try_into().unwrap();
        if xs.last() != Some(&x) {
            xs.push(x);
            table.push(Vec::new());
        }
        if xs.len() == 1 {
            zs.push(z);
        }
        table.last_mut().unwrap().push(y);
    }
    (xs, zs, table)
}

/// One row a point, written by `row` of the indices and the texts of x, z and y.
fn long(head: &str, row: impl Fn(usize, usize, [&str; 3]) -> String) -> String {
    let (xs, zs, table) = ship();
    let mut text = format!("{head}\n");
    for (i, (x, line)) in xs.iter().zip(&table).enumerate() {
        for (j, (z, y)) in zs.iter().zip(line).enumerate() {
            writeln!(text, "{}", row(i, j, [x, z, y])).unwrap();
        }
    }
    text
}

/// The matrix with these fields between its columns.
fn matrix(corner: &str, separator: &str) -> String {
    let (xs, zs, table) = ship();
    let mut text = format!("{corner}{separator}{}\n", zs.join(separator));
    for (x, line) in xs.iter().zip(&table) {
        writeln!(text, "{x}{separator}{}", line.join(separator)).unwrap();
    }
    text
}

#[track_caller]
fn displaces(name: &str, text: &str) {
    let folder = folder(&name.replace('.', "-"));
    let path = folder.write(name, text);
    let found = volume(Path::new(&path), 4.0);
    assert!(VOLUMES.contains(&found), "{name}: {found}\n{text}");
}

fn problems(text: &str) -> Vec<String> {
    let problems = read_table("t.csv", text.as_bytes()).unwrap_err();
    problems.iter().filter(|p| p.severity == Severity::Error).map(ToString::to_string).collect()
}

fn warnings(table: &str, beside: &str) -> Vec<String> {
    let read = read_table_with("t.csv", table.as_bytes(), Some(("t.toml", beside))).unwrap();
    read.notes.iter().filter(|p| p.severity == Severity::Warning).map(ToString::to_string).collect()
}

#[test]
fn blanks_between_columns() {
    displaces("spaces.txt", &matrix("x", "  "));
    displaces("unit.txt", &matrix("station [m]", " "));
    displaces("comment.txt", &matrix("# x", " "));
    displaces("zero.txt", &matrix("0.0", " "));
    displaces("nan.txt", &matrix("nan", " "));
    displaces("comma.txt", &matrix("x", "  ").replace('.', ","));
    // No word over the index.
    displaces("index.txt", &matrix("    ", "  "));
}

#[test]
fn half_breadths_alone_ask_for_positions() {
    let (_, _, table) = ship();
    for separator in [" ", ","] {
        let bare: Vec<String> = table.iter().map(|line| line.join(separator)).collect();
        among(
            &problems(&bare.join("\n")),
            &["E300 t.csv row 1, column 1: '0.000': half-breadths alone", "heights of the waterlines above them"],
        );
    }
}

#[test]
fn one_point_a_row_under_any_header() {
    let plain = |_: usize, _: usize, [x, z, y]: [&str; 3]| format!("{x},{z},{y}");
    for head in ["station,waterline,half_breadth", "x,z,y", "Station,Height,Offset", "x [m],wl,Half-breadth [m]"] {
        displaces("plain.csv", &long(head, plain));
    }
    displaces(
        "named.csv",
        &long("hull,station_id,waterline_id,x,z,y", |i, j, [x, z, y]| format!("a,{i},{j},{x},{z},{y}")),
    );
    displaces("index.csv", &long(",station,wl,offset", |i, j, [x, z, y]| format!("{},{x},{z},{y}", 8 * i + j)));
    displaces("blanks.txt", &long("i x y z", |i, j, [x, z, y]| format!("{} {x} {y} {z}", 8 * i + j)));
    let mm = |text: &str| format!("{:.0}", 1e3 * text.parse::<f64>().unwrap());
    displaces("mm.csv", &long("x_m,z_mm,y_mm", |_, _, [x, z, y]| format!("{x},{},{}", mm(z), mm(y))));
    let semicolons = long("x;z;half-breadth", |_, _, [x, z, y]| format!("{x};{z};{y}").replace('.', ","));
    displaces("semicolons.csv", &semicolons);
}

#[test]
fn columns_that_only_count_ask_for_positions() {
    let counted = long("i,j,y", |i, j, [_, _, y]| format!("{i},{j},{y}"));
    among(&problems(&counted), &["E310 t.csv row 1: the columns count stations and waterlines", "columns x and z"]);
}

#[test]
fn fractions_ask_for_the_main_dimensions() {
    let fraction = |text: &str, of: f64| text.parse::<f64>().unwrap() / of;
    let text = long("x_frac,z_frac,y_frac", |_, _, [x, z, y]| {
        format!("{:.4},{:.4},{:.5}", fraction(x, 100.0), fraction(z, 4.0), fraction(y, 6.0))
    });
    among(&problems(&text), &["E327", "fractions; missing, or not above 0: L (Lpp), B, T"]);
    let comment = "# Lpp = 100 m, B = 12 m, T = 4 m\n";
    displaces("words.csv", &format!("{comment}{text}"));
    displaces("over.csv", &format!("{comment}{}", text.replacen("x_frac,z_frac,y_frac", "x/L,z/T,y/(B/2)", 1)));
    let alone = text.replacen("x_frac,z_frac,y_frac", "station,waterline,frac", 1);
    displaces("alone.csv", &format!("{comment}{alone}"));
    among(&warnings(&format!("{comment}{alone}"), ""), &["W320", "half-breadths are fractions"]);
    // Half of all: of B, or of B/2?
    let half = long("x [m],z [m],y_frac", |_, _, [x, z, y]| format!("{x},{z},{:.5}", fraction(y, 8.0)));
    among(&problems(&format!("{comment}{half}")), &["E310", "fractions of B or of B/2"]);
}

#[test]
fn numbers_of_stations_and_waterlines_in_columns_are_settled() {
    let text = long("station,waterline,half_breadth", |i, j, [_, _, y]| format!("{i},{j},{y}"));
    let found = warnings(&text, "");
    among(&found, &["W320", "waterlines 0 to 7 may be numbers"]);
    among(&found, &["W320", "stations are numbered and neither L_PP nor their spacing is known"]);
    let beside = "[table]\nstation_spacing = 10\nwaterline_spacing = 0.5\nstations = \"numbers from AP\"\n";
    let table = read_table_with("t.csv", text.as_bytes(), Some(("t.toml", beside))).unwrap().table;
    assert!((table.stations[10].station.x - 100.0).abs() < 1e-9 && (table.waterlines[7] - 3.5).abs() < 1e-9);
}

/// The boat in feet, inches and eighths, each cell written by `write`.
fn boat(write: impl Fn([u32; 3]) -> String) -> String {
    let text = read_text(case("dash.csv"));
    let mut lines = text.lines();
    let mut out = format!("{}\n", lines.next().unwrap());
    for line in lines {
        let (head, cells) = line.split_once(',').unwrap();
        let cell = |cell: &str| -> String {
            let numbers: Vec<u32> = cell.split('-').map(|n| n.parse().unwrap()).collect();
            format!("\"{}\"", write(numbers.try_into().unwrap()).replace('"', "\"\""))
        };
        writeln!(out, "{head},{}", cells.split(',').map(cell).collect::<Vec<_>>().join(",")).unwrap();
    }
    out
}

/// How feet, inches and eighths are written.
type Writing = Box<dyn Fn([u32; 3]) -> String>;

#[test]
fn every_way_of_writing_feet_and_inches() {
    const COMMON: [&str; 8] = ["", " 1/8", " 1/4", " 3/8", " 1/2", " 5/8", " 3/4", " 7/8"];
    const SIGNS: [&str; 8] = ["", "\u{215b}", "\u{bc}", "\u{215c}", "\u{bd}", "\u{215d}", "\u{be}", "\u{215e}"];
    let at = |signs: [&'static str; 8], eighths: u32| signs[usize::try_from(eighths).unwrap()];
    let writings: [(&str, Writing); 9] = [
        ("dash", Box::new(|[f, i, e]| format!("{f}-{i}-{e}"))),
        ("dot", Box::new(|[f, i, e]| format!("{f}.{i}.{e}"))),
        ("space", Box::new(|[f, i, e]| format!("{f} {i} {e}"))),
        ("slash", Box::new(|[f, i, e]| format!("{f}/{i}/{e}"))),
        ("enddash", Box::new(|[f, i, e]| format!("{f}\u{2013}{i}\u{2013}{e}"))),
        ("prime", Box::new(move |[f, i, e]| format!("{f}'-{i}{}\"", at(COMMON, e)))),
        ("uprime", Box::new(move |[f, i, e]| format!("{f}\u{2032} {i}{}\u{2033}", at(SIGNS, e)))),
        ("quote", Box::new(move |[f, i, e]| format!("{f}\u{2019}{i}{}\u{201d}", at(SIGNS, e)))),
        ("words", Box::new(move |[f, i, e]| format!("{f} ft {i}{} in", at(COMMON, e)))),
    ];
    for (name, write) in writings {
        let folder = folder(name);
        let path = folder.write("boat.csv", boat(write));
        let found = volume(Path::new(&path), 0.6096);
        assert!((found - 4.998).abs() < 2e-3, "{name}: {found}");
    }
    let dots = boat(|[f, i, e]| format!("{f}.{i}.{e}"));
    among(&warnings(&dots, ""), &["W320 t.csv: 54 cells as '0.0.0': read as feet, inches and eighths"]);
    among(
        &problems(&dots.replacen("1.1.6", "1.1", 1)),
        &["E301 t.csv row 3, column 3: '1.1'", "feet and inches, or a decimal"],
    );
    // One cell among decimal numbers is no notation.
    among(&problems("x [m],0.5,1\n0,1.5,1.2.3\n10,2.5,3.5\n"), &["E301 t.csv row 2, column 3: '1.2.3'"]);
}

#[test]
fn a_row_for_several_stations() {
    let text = read_text(case("stations-4-5-6.csv"));
    for label in ["\"4,5,6\"", "4-6", "\"4, 5 & 6\"", "4 to 6", "4\u{2013}6", "4-5-6"] {
        let read = read_table("t.csv", text.replacen("\"4,5,6\"", label, 1).as_bytes()).unwrap();
        let names: Vec<&str> = read.table.stations.iter().map(|s| s.station.name.as_str()).collect();
        assert_eq!(names, ["0", "1", "2", "4", "5", "6", "8", "9", "10"], "{label}");
        for station in &read.table.stations[3..6] {
            assert_eq!(station.half_breadths[2].value(), Some(11.2));
        }
        let stern: Vec<Option<f64>> = read.table.endings.iter().map(|ends| ends[0]).collect();
        assert_eq!(stern, [None, None, None, Some(0.3), Some(1.5)]);
    }
    among(&warnings(&text, ""), &["W320", "the profile of the stern is at x 0.3 m on waterline 4 m", "are negative"]);
    let stem = text.replace("STERN CONTOUR", "STEM CONTOUR");
    among(&problems(&stem), &["E303", "the profile of the stem is at x 0.3 m", "beyond the middle of the stations"]);
    // Among decimal commas 4,5 is a number, unless all other stations are whole.
    let comma = "x;0,5;1\n4;1,5;2,5\n4,5;2,5;3,5\n5,5;2,5;3,5\n";
    assert_eq!(read_table("t.csv", comma.as_bytes()).unwrap().table.stations.len(), 3);
    let whole = "station;0,5;1\n3;1,5;2,5\n4,5;2,5;3,5\n6;2,5;3,5\n";
    among(&warnings(whole, ""), &["W320", "'4,5' stands for the stations 4, 5, not for a decimal number"]);
}

#[test]
fn workbooks_as_people_lay_them_out() {
    for name in ["group_header2", "notes_below", "offset_block", "second_sheet", "textcomma", "units_row"] {
        let found = volume(&case(&format!("{name}.xlsx")), 4.0);
        assert!((found - 3151.9).abs() < 0.5, "{name}: {found}");
    }
}

/// The rows of the plain table as fields.
fn plain_rows() -> Vec<Vec<String>> {
    matrix("x [m]", ",").lines().map(|line| line.split(',').map(str::to_owned).collect()).collect()
}

fn csv(rows: &[Vec<String>]) -> String {
    rows.iter().map(|row| row.join(",") + "\n").collect()
}

/// Rows beside others, with an empty column between them.
fn beside(left: &[Vec<String>], right: &[Vec<String>]) -> String {
    let rows = (0..left.len().max(right.len())).map(|k| {
        let row = left.get(k).cloned().unwrap_or_else(|| vec![String::new(); left[0].len()]);
        [row, vec![String::new()], right.get(k).cloned().unwrap_or_default()].concat()
    });
    csv(&rows.collect::<Vec<_>>())
}

#[test]
fn pieces_around_and_beside_a_table() {
    let rows = plain_rows();
    let texts = |texts: &[&str]| texts.iter().map(|&text| text.to_owned()).collect::<Vec<String>>();
    displaces("blank-row.csv", &csv(&[&rows[..5], &[Vec::new()], &rows[5..]].concat()));
    displaces(
        "notes.csv",
        &csv(&[&rows[..], &[texts(&["Note: to the moulded surface"]), texts(&["Checked by N.N."])]].concat()),
    );
    displaces("group.csv", &csv(&[&[texts(&["", "Half Breadth from C.L."])], &rows[..]].concat()));
    let shifted: Vec<Vec<String>> = rows.iter().map(|row| [texts(&["", ""]), row.clone()].concat()).collect();
    displaces("shifted.csv", &csv(&shifted));
    let columns = |from: usize, to: usize| rows.iter().map(|row| row[from..to].to_vec()).collect::<Vec<_>>();
    let stations = |from: usize, to: usize| {
        columns(from, to).into_iter().zip(&rows).map(|(c, r)| [vec![r[0].clone()], c].concat())
    };
    displaces("waterlines.csv", &beside(&columns(0, 5), &stations(5, 9).collect::<Vec<_>>()));
    displaces("gap.csv", &beside(&columns(0, 5), &columns(5, 9)));
    displaces("stations.csv", &beside(&rows[..6], &[&rows[..1], &rows[6..]].concat()));
    let curves: Vec<Vec<String>> =
        [["T [m]", "Volume [m3]"], ["1", "500"], ["2", "1200"]].iter().map(|row| texts(row)).collect();
    displaces("hydrostatics.csv", &beside(&rows, &curves));
    let other: Vec<Vec<String>> =
        rows.iter().map(|row| [row[..1].to_vec(), vec!["1".to_owned(); 8]].concat()).collect();
    let other = [&rows[..1], &other[1..]].concat();
    among(&problems(&beside(&rows, &other)), &["E306", "a second block of half-breadths"]);
    // Heights at buttocks without a word are no waterlines.
    let heights: Vec<Vec<String>> =
        rows.iter().map(|row| texts(&[&row[0], if row[0] == "x [m]" { "7" } else { "0.3" }])).collect();
    among(&problems(&beside(&rows, &heights)), &["E306", "a second block of half-breadths"]);
}

#[test]
fn words_around_a_table_state_its_units_and_dimensions() {
    let table = "Lpp,20\nT [mm],800\n\nx,0,0.5,1\nm,mm,mm,mm\n0,100,200,300\n10,200,300,400\n20,0,100,200\n";
    let read = read_table("t.csv", table.as_bytes()).unwrap().table;
    assert_eq!((read.stated.length_between_perpendiculars, read.stated.draught), (Some(20.0), Some(0.8)));
    assert_eq!(read.stations[1].half_breadths[0].value(), Some(0.2));
    assert!((read.waterlines[1] - 0.5).abs() < 1e-12 && (read.stations[2].station.x - 20.0).abs() < 1e-12);
    let feet = "Offsets in feet\nx,0,1\n0,1,2\n10,2,3\n";
    let read = read_table("t.csv", feet.as_bytes()).unwrap().table;
    assert!((read.stations[1].half_breadths[1].value().unwrap() - 0.9144).abs() < 1e-12);
    let full = "Full breadths\nx [m],0,1\n0,1,2\n10,2,3\n";
    among(&warnings(full, ""), &["W320", "full breadths, by 'Full breadths'"]);
    among(&problems("x [m],0,1\nmm,m,m\n0,1,2\n10,2,3\n"), &["E305", "the header states m, and the row below it mm"]);
    among(&problems("x [m],0,1\nm,m,ft\n0,1,2\n10,2,3\n"), &["E305", "offsets in m and in ft"]);
}

#[test]
fn many_bad_cells_are_one_line() {
    let mut text = "x [m],1,2,3\n".to_owned();
    for row in 0..20 {
        writeln!(text, "{row},abc,?{row},1").unwrap();
    }
    let found = problems(&text);
    assert_eq!(found.len(), 1, "{found:?}");
    among(&found, &["E301 t.csv row 2, column 2", "so are 40 cells in all, rows 2 to 21, columns 2 to 3"]);
}

fn cells(table: &OffsetTable, station: usize) -> Vec<Option<f64>> {
    table.stations[station].half_breadths.iter().map(Cell::value).collect()
}

#[test]
fn columns_of_fixed_width_may_be_empty() {
    let text = "x      0.0   1.0   2.0\n0             0.5   1.5\n10     1.0   2.0   3.0\n20                  1.0\n";
    let table = read_table("t.txt", text.as_bytes()).unwrap().table;
    assert_eq!(cells(&table, 0), [None, Some(0.5), Some(1.5)]);
    assert_eq!(cells(&table, 2), [None, None, Some(1.0)]);
}

#[test]
fn lines_of_a_boat_are_sections_with_knuckles() {
    let read = read_table("skiff.csv", read_text(case("skiff.csv")).as_bytes()).unwrap();
    let table = &read.table;
    assert_eq!(table.stations.len(), 6);
    let section = &table.stations[2].outlines[0];
    let foot = 0.3048;
    let expected = [(0.0625, 1.0 / 12.0, false), (22.0 / 12.0, 4.0 / 12.0, true), (25.5 / 12.0, 20.0 / 12.0, false)];
    for (point, (y, z, knuckle)) in section.iter().zip(expected) {
        assert!((point.y - y * foot).abs() < 1e-12 && (point.z - z * foot).abs() < 1e-12, "{point:?}");
        assert_eq!(point.marks.knuckle, knuckle);
    }
    let length = table.stations[5].station.x - table.stations[0].station.x;
    assert!((length - 14.0 * foot).abs() < 1e-12);
    // Straight panels: the section at 6 ft below 0.8 ft.
    let body = read_hydrostatic_body(&case("skiff.csv")).unwrap();
    let hull = body.hull().expect("a fitted hull");
    let area = SectionalAreaCurve::new(hull, 0.8 * foot, &[6.0 * foot]).areas[0];
    assert!((area - 0.2074).abs() < 1e-4, "{area}");
    // From the stem: turned about.
    let turned = "name,stem,1,transom\nstation,0-0-0,3-0-0,6-0-0\nheights,,,\nsheer,2-0-0,1-8-0,1-9-0\nchine,1-0-0,0-4-0,0-5-0\n\
                  keel,0-8-0,0-1-0,0-2-0\nhalf-breadths,,,\nsheer,0-0-6,2-0-0,1-8-0\nchine,0-0-6,1-8-0,1-4-0\nkeel,0-0-6,0-0-6,0-0-6\n";
    let table = read_table("t.csv", turned.as_bytes()).unwrap().table;
    assert_eq!(table.stations[0].station.name, "transom");
    assert!(table.stations[0].station.x.abs() < 1e-12);
    let worded = turned.replace("station,", "distance from stem,").replace("stem,1,transom", "0,1,2");
    let table = read_table("t.csv", worded.as_bytes()).unwrap().table;
    assert_eq!(table.stations[0].station.name, "2");
    let unnamed = turned.replace("stem", "0").replace("transom", "2");
    among(&warnings(&unnamed, ""), &["W320", "no name says which end is the stem"]);
}
