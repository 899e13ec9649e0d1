//! What headers, words and numbers of a table say of its stations, waterlines, units and sides: each writing gives the plain
//! table, or a warning that names the key.

use std::fmt::Write as _;

use loftsman::internals::exchange::{ReadTable, Severity, TableProblem, read_table_with};
use loftsman::internals::hull::OffsetTable;
use loftsman::internals::report::read_hydrostatic_body;

use crate::support::folder;

/// Waterlines of the hull \[m\].
pub(super) const HEIGHTS: [f64; 7] = [0.0, 0.75, 1.5, 3.0, 4.5, 6.0, 7.5];

/// Half-breadth of a hull of 100 m at x and z \[m\].
pub(super) fn half_breadth(x: f64, z: f64) -> f64 {
    let s = (x - 50.0) / 50.0;
    let along = if s < 0.0 { 1.0 - s.powi(4) } else { 1.0 - s * s };
    8.0 * along * (1.0 - (1.0 - (z / 6.0).min(1.0)).powi(4))
}

/// A matrix of the hull: rows of stations by head, from `heads`, with the columns at `heights` by head; `cell` writes [m].
pub(super) fn matrix(
    corner: &str,
    heads: &[String],
    columns: &[(String, f64)],
    cell: impl Fn(f64) -> String,
) -> String {
    let names: Vec<&str> = columns.iter().map(|(name, _)| name.as_str()).collect();
    let mut text = format!("{corner},{}\n", names.join(","));
    for (k, head) in heads.iter().enumerate() {
        let x = 100.0 * k as f64 / (heads.len() - 1) as f64;
        let cells: Vec<String> = columns.iter().map(|(_, z)| cell(half_breadth(x, *z))).collect();
        writeln!(text, "{head},{}", cells.join(",")).unwrap();
    }
    text
}

pub(super) fn metres(y: f64) -> String {
    format!("{y:.3}")
}

pub(super) fn columns(name: impl Fn(f64) -> String) -> Vec<(String, f64)> {
    HEIGHTS.iter().map(|z| (name(*z), *z)).collect()
}

pub(super) fn distances() -> Vec<String> {
    (0..21).map(|k| format!("{}", 5 * k)).collect()
}

/// Numbers from AP, with other heads at the two ends.
fn numbers(aft: &str, fore: &str) -> Vec<String> {
    (0..21)
        .map(|k| {
            if k == 0 {
                aft.to_owned()
            } else if k == 20 {
                fore.to_owned()
            } else {
                k.to_string()
            }
        })
        .collect()
}

pub(super) fn read(text: &str, conventions: &str) -> Result<ReadTable, Vec<TableProblem>> {
    read_table_with("table.csv", text.as_bytes(), (!conventions.is_empty()).then_some(("table.toml", conventions)))
}

fn plain() -> OffsetTable {
    read(&matrix("x [m] \\ z [m]", &distances(), &columns(|z| z.to_string()), metres), "").unwrap().table
}

/// Warnings of a table whose numbers are those of the plain one.
#[track_caller]
pub(super) fn same(text: &str, conventions: &str) -> Vec<String> {
    let read = read(text, conventions).unwrap_or_else(|list| panic!("{}\n{text}", list[0]));
    let (found, plain) = (&read.table, plain());
    let near = |a: f64, b: f64| (a - b).abs() < 2e-3;
    assert_eq!(found.stations.len(), plain.stations.len(), "{text}");
    assert!(found.waterlines.iter().zip(&plain.waterlines).all(|(a, b)| near(*a, *b)), "{:?}", found.waterlines);
    for (a, b) in found.stations.iter().zip(&plain.stations) {
        assert!(near(a.station.x, b.station.x), "{} for {}\n{text}", a.station.x, b.station.x);
        for j in 0..plain.waterlines.len() {
            let (a, b) = (a.half_breadth(j).unwrap_or(0.0), b.half_breadth(j).unwrap_or(0.0));
            assert!(near(a, b), "{a} for {b}\n{text}");
        }
    }
    let warnings = read.notes.iter().filter(|note| note.severity == Severity::Warning);
    warnings.map(|note| format!("{} {}", note.code, note.message)).collect()
}

/// Warnings of a table, with their remedies.
#[track_caller]
fn warnings(text: &str, conventions: &str) -> Vec<String> {
    let read = read(text, conventions).unwrap_or_else(|list| panic!("{}\n{text}", list[0]));
    read.notes.iter().filter(|note| note.severity == Severity::Warning).map(ToString::to_string).collect()
}

#[track_caller]
fn warns(warnings: &[String], code: &str, of: &str) {
    assert!(warnings.iter().any(|w| w.starts_with(code) && w.contains(of)), "{code} {of}: {warnings:?}");
}

#[test]
fn perpendiculars_among_numbers_count_stations() {
    let lpp = "[table]\nLpp = 100.0\n";
    let heights = columns(|z| format!("{z} m"));
    for (aft, fore) in [("AP", "FP"), ("0 (AP)", "20 (FP)"), ("0 AFT", "20 FWD"), ("A.P.", "F.P.")] {
        let found = same(&matrix("station", &numbers(aft, fore), &heights, metres), lpp);
        assert!(!found.iter().any(|w| w.contains("numbered")), "{aft}: {found:?}");
    }
    // From FP, as in America.
    for (first, last) in [("FP", "AP"), ("0 (FP)", "20 (AP)"), ("0 FWD", "20 AFT")] {
        let text = matrix("station", &numbers(first, last), &heights, metres);
        let (head, rows) = text.split_once('\n').unwrap();
        // The offsets of station 0 are those at FP.
        let rows: Vec<&str> = rows.lines().collect();
        let turned: Vec<String> = (0..21)
            .map(|k| format!("{},{}", rows[k].split_once(',').unwrap().0, rows[20 - k].split_once(',').unwrap().1))
            .collect();
        let found = same(&format!("{head}\n{}\n", turned.join("\n")), lpp);
        assert!(!found.iter().any(|w| w.contains("from which end")), "{first}: {found:?}");
    }
    // L_PP that is known is never left for 1 m.
    let frames: Vec<String> = (0..21).map(|k| format!("FR {}", 10 * k)).collect();
    warns(&same(&matrix("", &frames, &heights, metres), lpp), "W320", "number of spaces");
    let comment = format!("# Stations 5 m apart\n{}", matrix("station", &numbers("0", "20"), &heights, metres));
    let found = same(&comment, "");
    assert!(!found.iter().any(|w| w.contains("1 m apart")), "{found:?}");
}

#[test]
fn waterlines_by_number_are_no_heights_in_silence() {
    let spaced: Vec<(&str, f64)> =
        vec![("0", 0.0), ("1/2", 0.75), ("1", 1.5), ("2", 3.0), ("3", 4.5), ("4", 6.0), ("5", 7.5)];
    let name = |form: &dyn Fn(&str) -> String| spaced.iter().map(|(n, z)| (form(n), *z)).collect::<Vec<_>>();
    for (corner, heads) in [
        ("x [m]", name(&|n| format!("WL {n}"))),
        ("x [m]", name(&|n| if n == "1/2" { "1/2 WL".to_owned() } else { format!("{n}. WL") })),
        ("x \\ WL", name(&|n| n.to_owned())),
        ("x [m]", name(&|n| format!("WL {n}")).into_iter().rev().collect()),
    ] {
        let text = matrix(corner, &distances(), &heads, metres);
        let read = read(&text, "").unwrap();
        let message = "waterlines are numbered";
        assert!(
            read.notes.iter().any(|note| note.code == "W320" && note.message.contains(message)),
            "{corner}: {text}"
        );
        same(&text, "[table]\nwaterline_spacing = 1.5\n");
    }
    // Heights with decimals, and the base line among them.
    for base in ["BL", "Base", "WL 0.00"] {
        let heads = columns(|z| if z > 0.0 { format!("WL {z:.2}") } else { base.to_owned() });
        let found = same(&matrix("x [m]", &distances(), &heads, metres), "");
        assert!(!found.iter().any(|w| w.contains("numbered")), "{base}: {found:?}");
    }
    let heads = columns(|z| if (z - 4.5).abs() < 0.1 { "DWL 4.5 m".to_owned() } else { format!("{z} m WL") });
    same(&matrix("x [m]", &distances(), &heads, metres), "");
}

#[test]
fn thousands_are_no_decimals() {
    let parted = |value: f64, sign: &str| {
        let whole = value.round() as u64;
        let text = if whole < 1000 { whole.to_string() } else { format!("{}{sign}{:03}", whole / 1000, whole % 1000) };
        format!("\"{text}\"")
    };
    for sign in [",", ".", " ", "\u{202f}", "'"] {
        let heads = columns(|z| parted(1e3 * z, sign));
        let text = matrix("x \\ z", &distances(), &heads, |y| parted(1e3 * y, sign));
        let found = same(&text, "");
        if [",", "."].contains(&sign) {
            warns(&found, "W320", "thousands");
        }
    }
    let old_mac = matrix("x [m] \\ z [m]", &distances(), &columns(|z| z.to_string()), metres).replace('\n', "\r");
    same(&old_mac, "");
}

#[test]
fn breadths_units_and_sums_beside_the_offsets() {
    let plain_columns = columns(|z| z.to_string());
    let full = matrix("x [m] \\ full breadths", &distances(), &plain_columns, |y| metres(2.0 * y));
    warns(&same(&full, ""), "W320", "full breadths");
    let mixed = matrix("x [m]; half-breadths in mm", &distances(), &columns(|z| format!("{z} m")), |y| {
        format!("{:.0}", 1e3 * y)
    });
    same(&mixed, "");
    let text = matrix("x [m] \\ z [m]", &distances(), &plain_columns, metres);
    let with_multipliers: Vec<String> =
        text.lines().enumerate().map(|(k, row)| format!("{row},{}", if k == 0 { "SM" } else { "4" })).collect();
    warns(&same(&with_multipliers.join("\n"), ""), "W332", "multipliers");
    warns(&same(&format!("{text}Total,9,9,9,9,9,9,9\n"), ""), "W332", "sums");
}

#[test]
fn points_one_a_row_in_other_words() {
    let points = |head: &str, row: &dyn Fn(f64, f64, f64) -> String| {
        let mut text = format!("{head}\n");
        for k in 0..21 {
            for z in HEIGHTS {
                let x = 5.0 * f64::from(k);
                writeln!(text, "{}", row(x, half_breadth(x, z), z)).unwrap();
            }
        }
        text
    };
    let xzy = |x: f64, y: f64, z: f64| format!("{x},{z},{y:.3}");
    same(&points("Frame,WL,HB", &xzy), "[table]\nstations = \"from AP\"\n");
    same(&points("Spant;Wasserlinie;Halbbreite", &|x, y, z| xzy(x, y, z).replace(',', ";").replace('.', ",")), "");
    warns(&same(&points("x_m,z_m,breadth_m", &xzy), ""), "W320", "breadths");
    warns(&same(&points("length,breadth,height", &|x, y, z| format!("{x},{y:.3},{z}")), ""), "W320", "breadths");
    let bare = read(&points("", &|x, y, z| format!("{x},{y:.3},{z}")), "").unwrap_err();
    assert!(bare[0].remedy.contains("x,y,z"), "{}", bare[0]);
    // Sections: the other side, both sides, millimetres.
    let of = |text: &str| read(text, "").unwrap().table;
    let sections = of(&points("x,y,z", &|x, y, z| format!("{x},{y:.3},{z}")));
    let both =
        points("x,y,z", &|x, y, z| format!("{x},{y:.3},{z}")) + &points("", &|x, y, z| format!("{x},{:.3},{z}", -y));
    let ordered = |text: &str| {
        let mut rows: Vec<&str> = text.lines().skip(1).filter(|row| !row.is_empty()).collect();
        rows.sort_by(|a, b| {
            let x = |row: &str| row.split(',').next().unwrap().parse::<f64>().unwrap();
            x(a).total_cmp(&x(b))
        });
        format!("x,y,z\n{}\n", rows.join("\n"))
    };
    for text in [
        points("x,y,z", &|x, y, z| format!("{x},{:.3},{z}", -y)),
        ordered(&both),
        points("x,y,z", &|x, y, z| format!("{:.0},{:.0},{:.0}", 1e3 * x, 1e3 * y, 1e3 * z)),
    ] {
        let found = of(&text);
        for (a, b) in found.stations.iter().zip(&sections.stations) {
            assert!((a.station.x - b.station.x).abs() < 1e-9);
            for (p, q) in a.outlines[0].iter().zip(&b.outlines[0]) {
                assert!((p.y - q.y).abs() < 1e-3 && (p.z - q.z).abs() < 1e-9, "{p:?} {q:?}");
            }
        }
    }
    // The conventions beside points are those of any table.
    let feet = read(&points("x,y,z", &|x, y, z| format!("{x},{y:.3},{z}")), "[table]\nunits = \"ft\"\nT = \"1.2 m\"\n")
        .unwrap()
        .table;
    assert!((feet.stations[20].station.x - 30.48).abs() < 1e-9 && feet.stated.draught == Some(1.2));
    let typo = read(&points("x,y,z", &|x, y, z| format!("{x},{y:.3},{z}")), "[table]\nunitz = \"ft\"\n").unwrap_err();
    assert_eq!(typo[0].code, "E311");
    let exchanged = read(&points("x,y,z", &|x, y, z| format!("{x},{z},{y:.3}")), "").unwrap();
    assert!(exchanged.notes.iter().any(|note| note.code == "W320" && note.message.contains("exchanged")));
    let vast = read(
        &matrix("station [km] \\ z", &distances(), &columns(|z| z.to_string()), |y| metres(100.0 * y)),
        "[table]\nunits = \"m\"\n",
    );
    assert!(vast.unwrap_err().iter().any(|problem| problem.code == "E305"));
}

/// Volume [m3] of a file of a table, and the notes.
fn volume(name: &str, text: &str, draught: f64) -> (f64, Vec<String>) {
    let path = folder(&format!("evidence-{name}")).join(name);
    std::fs::create_dir_all(path.parent().unwrap()).unwrap();
    std::fs::write(&path, text).unwrap();
    let body = read_hydrostatic_body(&path).unwrap_or_else(|error| panic!("{name}: {error}"));
    let (curves, _) =
        body.curves_of_form(&[draught], &loftsman::internals::hydrostatics::Conventions::default()).unwrap();
    (curves.rows[0].displacement_volume, body.notes)
}

#[track_caller]
fn has(notes: &[String], code: &str) {
    assert!(notes.iter().any(|note| note.starts_with(code)), "{code}: {notes:?}");
}

#[test]
fn sections_of_few_points_are_straight_and_others_are_weighed() {
    let sections = |points: &[(f64, f64)]| {
        let rows = (0..13).flat_map(|k| points.iter().map(move |(y, z)| format!("{},{y},{z}", 5 * k)));
        format!("x,y,z\n{}\n", rows.collect::<Vec<_>>().join("\n"))
    };
    // A section of keel, chine and deck: 60 m by 20.8 m2 up to 3 m.
    let (found, notes) = volume("vee.csv", &sections(&[(0.0, 0.0), (4.0, 1.0), (5.0, 6.0)]), 6.0);
    let exact = 60.0 * 2.0 * (2.0 + 22.5);
    assert!((found - exact).abs() < 1e-3 * exact, "{found} for {exact}");
    has(&notes, "W338");
    // Panels with points between, and no mark.
    let panels = [(0.0, 0.0), (2.0, 0.5), (4.0, 1.0), (4.4, 3.0), (4.8, 5.0), (5.0, 6.0)];
    let (found, notes) = volume("panels.csv", &sections(&panels), 6.0);
    assert!((found - exact).abs() < 2e-3 * exact, "{found} for {exact}");
    has(&notes, "W338");
    // A well: the sections fall on the way to the deck, and the hull through them is another.
    let dock = [(0.0, 0.0), (10.0, 0.0), (10.0, 3.0), (10.0, 6.0), (8.0, 6.0), (8.0, 4.0), (8.0, 2.0), (0.0, 2.0)];
    has(&volume("dock.csv", &sections(&dock), 5.0).1, "W340");
    // Few points: what is between them may be round or straight, by more than a hundredth.
    let few = [(0.0, 0.0), (1.8, 0.12), (3.2, 0.45), (3.92, 0.9), (4.0, 1.5)];
    has(&volume("few.csv", &sections(&few), 1.0).1, "W340");
    // A flat bottom on the base line is known.
    let flat = [(4.0, 0.0), (4.4, 0.3), (4.7, 0.65), (4.9, 1.1), (5.0, 2.0), (5.0, 4.0), (5.0, 6.0)];
    let notes = volume("flat.csv", &sections(&flat), 5.0).1;
    assert!(!notes.iter().any(|note| note.starts_with("W315")), "{notes:?}");
    // No bottom below the first points.
    let open = [(4.0, 0.3), (4.4, 0.6), (4.7, 0.95), (4.9, 1.4), (5.0, 2.0), (5.0, 4.0), (5.0, 6.0)];
    has(&volume("open.csv", &sections(&open), 5.0).1, "W315");
}

#[test]
fn lines_far_apart_are_warned_of() {
    let barge = |xs: &[f64], heights: &[f64]| {
        let heads: Vec<String> = heights.iter().map(f64::to_string).collect();
        let mut text = format!("x [m] \\ z [m],{}\n", heads.join(","));
        for &x in xs {
            let along = (x.min(60.0 - x) / 20.0).min(1.0);
            let cells: Vec<String> = heights.iter().map(|z| metres(5.0 * along * (z / 0.5).min(1.0))).collect();
            writeln!(text, "{x},{}", cells.join(",")).unwrap();
        }
        text
    };
    let (few, all) = ([0.0, 20.0, 40.0, 60.0], (0..13).map(|k| 5.0 * f64::from(k)).collect::<Vec<_>>());
    let dense = [0.0, 0.25, 0.5, 0.75, 1.0, 1.5, 2.0, 3.0];
    let between = |notes: &[String], lines: &str| {
        notes.iter().any(|note| note.starts_with("W342") && note.contains(&format!("between the {lines} the hull")))
    };
    let notes = volume("stations.csv", &barge(&few, &dense), 3.0).1;
    assert!(between(&notes, "stations") && !between(&notes, "waterlines"), "{notes:?}");
    let (found, notes) = volume("dense.csv", &barge(&all, &dense), 3.0);
    assert!(!between(&notes, "stations") && !between(&notes, "waterlines"), "{notes:?}");
    let exact = 2.0 * 5.0 * 40.0 * (3.0 - 0.25);
    assert!((found / exact - 1.0).abs() < 0.015, "{found} for {exact}");
}

#[test]
fn bottoms_ends_and_suspects_that_change_the_volume() {
    let tanker = |x: f64, z: f64| half_breadth(x, 6.0) * (0.9 + 0.1 * z / 6.0);
    let table = |heights: &[f64], xs: &[f64], keel: bool, shift: f64| {
        let heads: Vec<String> = heights.iter().map(|z| format!("{}", z - shift)).collect();
        let mut text = format!("x [m] \\ z [m],{}{}\n", heads.join(","), if keel { ",keel" } else { "" });
        for x in xs {
            let cells: Vec<String> = heights.iter().map(|z| metres(tanker(*x, *z))).collect();
            writeln!(text, "{x},{}{}", cells.join(","), if keel { ",0" } else { "" }).unwrap();
        }
        text
    };
    let all: Vec<f64> = (0..21).map(|k| 5.0 * f64::from(k)).collect();
    let high = [1.5, 3.0, 4.5, 6.0, 7.5];
    for (text, conventions) in [
        (table(&high, &all, false, 0.0), "[table]\nT = 4.5\n"),
        (table(&high, &all, true, 0.0), ""),
        (table(&high, &all, false, 4.5), ""),
    ] {
        let notes = read(&text, conventions).unwrap().notes;
        assert!(notes.iter().any(|note| note.code == "W315"), "{text}: {notes:?}");
    }
    let whole = read(&table(&HEIGHTS, &all, false, 0.0), "").unwrap().notes;
    assert!(!whole.iter().any(|note| note.code == "W315"), "{whole:?}");
    let cut = read(&table(&HEIGHTS, &all[2..19], false, 0.0), "[table]\nLpp = 100.0\n").unwrap().notes;
    assert_eq!(cut.iter().filter(|note| note.code == "W317").count(), 2, "{cut:?}");
    let text = matrix("x [m] \\ z [m]", &distances(), &columns(|z| z.to_string()), metres);
    let wrong = text.replacen("\n50,0.000,", "\n50,0.000,57.40,", 1).replacen(
        &format!("57.40,{}", metres(half_breadth(50.0, 0.75))),
        "57.40",
        1,
    );
    has(&volume("typing.csv", &wrong, 4.5).1, "W341");
}

/// A boat of keel, chine and sheer at nine stations: rows of lines, or stations below each other.
fn boat(cell: impl Fn(&str, usize, f64) -> String) -> Vec<(String, Vec<String>)> {
    let s = |k: usize| k as f64 / 4.0 - 1.0;
    let row = |name: &str, of: &dyn Fn(f64) -> f64| {
        (name.to_owned(), (0..9).map(|k| cell(name, k, of(s(k)))).collect::<Vec<_>>())
    };
    vec![
        row("Sheer height", &|s| 2.5 + 0.5 * s * s),
        row("Chine height", &|s| 0.6 + 0.4 * s * s),
        row("Keel height", &|s| 0.3 * s * s),
        row("Sheer half-breadth", &|s| 5.0 * (1.0 - 0.5 * s * s)),
        row("Chine half-breadth", &|s| 4.0 * (1.0 - 0.6 * s * s)),
        row("Keel half-breadth", &|_| 0.08),
    ]
}

fn boat_text(rows: &[(String, Vec<String>)]) -> String {
    let mut text = format!("Station,{}\n", (0..9).map(|k| k.to_string()).collect::<Vec<_>>().join(","));
    writeln!(text, "x,{}", (0..9).map(|k| (3 * k).to_string()).collect::<Vec<_>>().join(",")).unwrap();
    rows.iter().for_each(|(name, cells)| writeln!(text, "{name},{}", cells.join(",")).unwrap());
    text
}

#[test]
fn boats_of_other_writings() {
    let plain = boat(|_, _, value| format!("{value:.4}"));
    let read =
        |text: &str| read(text, "[table]\nunits = \"ft\"\n").unwrap_or_else(|list| panic!("{}\n{text}", list[0]));
    let same = |text: &str| {
        let (found, plain) = (read(text), read(&boat_text(&plain)));
        for (a, b) in found.table.stations.iter().zip(&plain.table.stations) {
            assert!((a.station.x - b.station.x).abs() < 1e-9, "{text}");
            assert_eq!(a.outlines[0].len(), b.outlines[0].len(), "{text}");
            for (p, q) in a.outlines[0].iter().zip(&b.outlines[0]) {
                assert!((p.y - q.y).abs() < 2e-3 && (p.z - q.z).abs() < 2e-3, "{p:?} {q:?}\n{text}");
            }
        }
        found.notes.into_iter().map(|note| format!("{} {}", note.code, note.message)).collect::<Vec<_>>()
    };
    // Stations below each other, and short words.
    let turned: String = boat_text(&plain)
        .lines()
        .map(|line| line.split(',').map(str::to_owned).collect::<Vec<_>>())
        .fold(vec![String::new(); 10], |mut rows, column| {
            rows.iter_mut()
                .zip(column)
                .for_each(|(row, cell)| write!(row, "{}{cell}", if row.is_empty() { "" } else { "," }).unwrap());
            rows
        })
        .join("\n");
    same(&turned);
    let short: Vec<_> = plain
        .iter()
        .map(|(name, row)| (name.replace("half-breadth", "HB").replace("height", "HAB"), row.clone()))
        .collect();
    same(&boat_text(&short));
    // Breadths without a word, full ones, a hole, lines that cross.
    let named: Vec<_> =
        plain.iter().map(|(name, row)| (name.replace("half-breadth", "breadth"), row.clone())).collect();
    warns(&same(&boat_text(&named)), "W320", "half or full");
    let double = boat(|name, _, value| format!("{:.4}", if name.contains("breadth") { 2.0 * value } else { value }));
    let double: Vec<_> =
        double.into_iter().map(|(name, row)| (name.replace("half-breadth", "full breadth"), row)).collect();
    warns(&same(&boat_text(&double)), "W320", "full breadths");
    let hole = boat(
        |name, k, value| if name == "Chine half-breadth" && k == 3 { String::new() } else { format!("{value:.4}") },
    );
    warns(&same(&boat_text(&hole)), "W320", "gives nothing at station '3'");
    let typing =
        boat(|name, k, value| format!("{:.4}", if name == "Chine height" && k == 4 { value + 6.0 } else { value }));
    let notes = read(&boat_text(&typing)).notes;
    assert!(notes.iter().any(|note| note.code == "W336"), "{notes:?}");
    // Feet and inches alone among fractions.
    let inches = |value: f64| {
        let eighths = (96.0 * value).round() as u64;
        let (feet, inch, eighth) = (eighths / 96, eighths % 96 / 8, eighths % 8);
        if eighth == 0 { format!("{feet}-{inch}") } else { format!("{feet}-{inch} {eighth}/8") }
    };
    let text = boat_text(&boat(|_, _, value| inches((96.0 * value).round() / 96.0)));
    let found = loftsman::internals::exchange::read_table("boat.csv", text.as_bytes())
        .unwrap_or_else(|list| panic!("{}\n{text}", list[0]));
    assert_eq!(found.table.stations.len(), 9);
}

/// Stations of which nothing says that they are numbers: a hull of 20 m by 16 m.
#[test]
fn stations_that_may_be_numbers_are_warned_of() {
    for corner in ["", "No.", "Half-breadths"] {
        let text = matrix(corner, &numbers("0", "20"), &columns(|z| format!("{z} m")), metres);
        let found = warnings(&text, "");
        assert!(
            found.iter().any(|w| w.contains("may be numbers") && w.contains("numbers from FP")),
            "{corner}: {found:?}"
        );
    }
}

#[test]
fn stations_numbered_from_one_begin_at_a_perpendicular() {
    let heads: Vec<String> = (1..22).map(|k| k.to_string()).collect();
    let text = matrix("Station", &heads, &columns(|z| format!("{z} m")), metres);
    let found = same(&text, "[table]\nLpp = 100\nunits = \"m\"\n");
    assert!(found.iter().any(|w| w.contains("1 is taken as AP")), "{found:?}");
}

#[test]
fn the_fuller_end_is_the_stern() {
    // Full at one end: a transom of half the breadth.
    let full = |x: f64, z: f64| half_breadth(x, z) + 4.0 * (1.0 - x / 100.0);
    let of = |turned: bool| {
        let mut text = String::from("Station,0 m,3 m,6 m\n");
        for k in 0..21 {
            let x = if turned { 100.0 - 5.0 * f64::from(k) } else { 5.0 * f64::from(k) };
            let cells: Vec<String> = [0.0, 3.0, 6.0].iter().map(|z| metres(full(x, *z))).collect();
            writeln!(text, "{k},{}", cells.join(",")).unwrap();
        }
        let read = read(&text, "[table]\nLpp = 100\nunits = \"m\"\n").unwrap();
        let said = read.notes.iter().any(|note| note.message.contains("because the fuller end is the stern"));
        (read.table.stations[0].half_breadth(2).unwrap(), said)
    };
    assert_eq!((of(false), of(true)), ((4.0, true), (4.0, true)));
}

#[test]
fn sentences_say_where_stations_count_from() {
    let conventions = "[table]\nLpp = 100\nunits = \"m\"\n";
    let forward = || (0..21).rev().map(|k| format!("{}", 5 * k)).collect::<Vec<String>>();
    let of = |title: &str, corner: &str| {
        format!("{title}{}", matrix(corner, &forward(), &columns(|z| format!("{z} m")), metres))
    };
    for (title, corner) in [
        ("", "Distance from stem (m)"),
        ("", "Distance from bow (m)"),
        ("", "x aft [m]"),
        ("Origin at forward perpendicular\n", "x [m]"),
        ("# Distances from the F.P.\n", "x [m]"),
    ] {
        same(&of(title, corner), conventions);
    }
    let numbered = matrix("Station", &numbers("0", "20"), &columns(|z| format!("{z} m")), metres);
    let spaced = "[table]\nunits = \"m\"\n";
    for words in ["# Station spacing: 5 m\n", "Station spacing,5 m\n\n", "# Stations 5 m apart\n"] {
        let found = same(&format!("{words}{numbered}"), spaced);
        assert!(!found.iter().any(|w| w.contains("1 m apart")), "{words}: {found:?}");
    }
    let turned: Vec<String> = (0..21).map(|k| (20 - k).to_string()).collect();
    let of = |words: &str| format!("{words}{}", matrix("Station", &turned, &columns(|z| format!("{z} m")), metres));
    for words in ["Stations are numbered from the F.P.\n\n", "# station 0 is at the forward perpendicular\n"] {
        let found = same(&of(words), conventions);
        assert!(!found.iter().any(|w| w.contains("nothing says")), "{words}: {found:?}");
    }
    let midship: Vec<String> = (0..21).map(|k| format!("{}", 50 - 5 * k)).collect();
    same(&matrix("x from midship (+ aft) [m]", &midship, &columns(|z| format!("{z} m")), metres), conventions);
}

#[test]
fn lines_that_are_something_else_are_warned_of() {
    let more = |name: &str, of: &dyn Fn(f64) -> f64| {
        let text = matrix("x [m]", &distances(), &columns(|z| format!("{z} m")), metres);
        let rows = text.lines().enumerate().map(|(k, row)| {
            let cell = if k == 0 { name.to_owned() } else { metres(of(5.0 * (k - 1) as f64)) };
            format!("{row},{cell}\n")
        });
        warnings(&rows.collect::<String>(), "")
    };
    let found = more("sheer", &|x| half_breadth(x, 7.5) * 0.8);
    assert!(found.iter().any(|w| w.contains("deck at side lies below waterlines")), "{found:?}");
    let found = more("keel", &|x| half_breadth(x, 0.75));
    assert!(found.iter().any(|w| w.contains("keel lies above waterlines")), "{found:?}");
    let found = more("height of sheer", &|_| 7.5);
    assert!(!found.iter().any(|w| w.contains("W320")), "{found:?}");
}

#[test]
fn a_lowest_waterline_without_values_shows_no_bottom() {
    let text = matrix("x [m]", &distances(), &columns(|z| format!("{z} m")), metres);
    // Half of the hull below 3 m is not given.
    let without = |mark: &str| {
        let blank = |row: &str| {
            let mut fields: Vec<&str> = row.split(',').collect();
            (fields[1], fields[2], fields[3]) = (mark, mark, mark);
            fields.join(",")
        };
        let rows = text.lines().enumerate().map(|(k, row)| if k == 0 { row.to_owned() } else { blank(row) } + "\n");
        warnings(&rows.collect::<String>(), "")
    };
    for mark in ["", "-"] {
        let found = without(mark);
        assert!(found.iter().any(|w| w.contains("W315")), "{mark}: {found:?}");
    }
}

#[test]
fn breadths_that_may_be_full_and_units_that_nobody_states_are_warned_of() {
    let double = |y: f64| format!("{:.3}", 2.0 * y);
    let table = matrix("x [m]", &distances(), &columns(|z| format!("{z} m")), double);
    for title in ["Breadths (m)\n", "Widths at waterlines\n"] {
        let found = warnings(&format!("{title}{table}"), "");
        assert!(found.iter().any(|w| w.contains("half or full")), "{title}: {found:?}");
    }
    let centimetres =
        matrix("x", &distances(), &columns(|z| format!("{}", 100.0 * z)), |y| format!("{:.1}", 100.0 * y));
    let found = warnings(&centimetres, "");
    assert!(found.iter().any(|w| w.contains("no unit is declared") && w.contains("--input-unit")), "{found:?}");
}

#[test]
fn heights_that_count_downward_are_refused() {
    let text = matrix("x \\ depth below DWL [m]", &distances(), &columns(|z| z.to_string()), metres);
    let list = read(&text, "").unwrap_err();
    assert!(list.iter().any(|p| p.message.contains("heights count downward")), "{list:?}");
}

#[test]
fn waterlines_by_number_are_warned_of_whatever_names_them() {
    let names = ["0", "0.5", "1", "2", "3", "4", "5"];
    let columns: Vec<(String, f64)> = names.iter().zip(HEIGHTS).map(|(name, z)| ((*name).to_owned(), z)).collect();
    let turned = matrix("x \\ WL", &distances(), &columns, metres);
    let found = warnings(&turned, "[table]\nunits = \"m\"\n");
    assert!(
        found.iter().any(|w| w.contains("waterlines are numbered")) || found.iter().all(|w| !w.contains("W320")),
        "{found:?}"
    );
    let found = warnings(&turned, "");
    assert!(found.iter().any(|w| w.contains("waterlines are numbered")), "{found:?}");
}

#[test]
fn points_may_be_in_feet_inches_and_eighths_and_have_marks() {
    let of = |cell: &dyn Fn(f64) -> String, mark: &str| {
        let mut text = String::from("x,y,z\n");
        for k in 0..21 {
            let x = 5.0 * f64::from(k);
            for z in HEIGHTS {
                let y = half_breadth(x, z);
                let mark = if (z - 3.0).abs() < 1e-9 { mark } else { "" };
                writeln!(text, "{},{}{mark},{}", cell(x), cell(y), cell(z)).unwrap();
            }
        }
        read(&text, "[table]\nunits = \"m\"\n").unwrap_or_else(|list| panic!("{}", list[0])).table
    };
    let feet = |length: f64| loftsman::internals::units::Notation::FeetInchesEighths.write(length);
    let (metric, imperial) = (of(&metres, "K"), of(&feet, ""));
    assert_eq!(metric.stations.len(), imperial.stations.len());
    for (a, b) in metric.stations.iter().zip(&imperial.stations) {
        assert!((a.station.x - b.station.x).abs() < 2e-3);
        for (p, q) in a.outlines.iter().flatten().zip(b.outlines.iter().flatten()) {
            assert!((p.y - q.y).abs() < 2e-3 && (p.z - q.z).abs() < 2e-3);
        }
    }
    let marked = metric.stations[10].outlines.iter().flatten().filter(|point| point.marks.knuckle).count();
    assert_eq!(marked, 1);
}
