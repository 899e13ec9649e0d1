//! Reading of tables of offsets: published tables as they are, our own tables, random bytes.

use loftsman::internals::exchange::{
    ReadTable, Severity, TableWriting, heights_csv, offsets_csv, read_table, read_table_with, write_table,
};
use loftsman::internals::hull::{Cell, Entry, Marks, OffsetTable, StationOffsets, TableLayout};
use loftsman::internals::parametric::analytic::{self, Dimensions};
use loftsman::internals::units::Notation;
use proptest::prelude::*;
use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};

use crate::support::{read, read_text, shared_folder};

/// Folder, stations, waterlines, first x, last x, highest waterline, largest half-breadth.
const SHARED: [(&str, usize, usize, f64, f64, f64, f64); 13] = [
    ("bodyplan_nithya", 23, 11, 0.0, 10.0, 9.93, 11.0),
    ("coaster_sharif", 21, 8, 0.0, 41.4, 2.6, 4.95),
    ("dtc", 42, 26, -6.6, 365.3, 34.0, 25.5),
    ("dtmb5415", 38, 31, -0.05, 151.0, 16.0, 10.209),
    ("oe1012_cargo", 26, 10, -3.225, 129.0, 13.14, 13.12),
    ("pdstrip_yacht", 19, 12, -7.5198, 10.4802, 0.9652, 1.6325),
    ("s175", 25, 14, -3.25, 175.0, 11.0, 12.7),
    ("series60_cb060", 25, 8, 0.0, 121.92, 9.7536, 8.128),
    ("series60_cb070", 25, 8, 0.0, 121.92, 10.4503, 8.7086),
    ("series60_cb075", 25, 8, 0.0, 121.92, 10.8373, 9.0311),
    ("sterntrawler", 41, 21, -2.998, 48.4346, 10.7106, 5.8),
    ("vlcc_roh", 27, 24, -0.33, 20.43, 30.0, 30.0),
    // From midship in the file: AP and FP are the outermost stations.
    ("wigley", 41, 11, 0.0, 100.0, 6.25, 5.0),
];

#[test]
fn the_shared_tables_as_they_are() {
    let Some(folder) = shared_folder() else { return };
    for (hull, stations, waterlines, first, last, highest, largest) in SHARED {
        let text = read_text(folder.join(hull).join("offsets.csv"));
        let read = read(hull, &text);
        let t = &read.table;
        assert_eq!((t.stations.len(), t.waterlines.len()), (stations, waterlines), "{hull}");
        let found = [
            t.stations[0].station.x,
            t.stations[stations - 1].station.x,
            t.waterlines[waterlines - 1],
            t.stations.iter().flat_map(|s| &s.half_breadths).filter_map(Cell::value).fold(0.0, f64::max),
        ];
        for (found, expected) in found.into_iter().zip([first, last, highest, largest]) {
            assert!((found - expected).abs() < 1e-12, "{hull}: {found} {expected}");
        }
        // Every number of the file, read independently of the reader, stands in the table where it stands in the file.
        for (row, line) in text.lines().enumerate().skip(1) {
            let station = &t.stations[row - 1];
            let cells: Vec<&str> = line.split(',').collect();
            let sides = cells.len() - 1 - waterlines;
            for (cell, text) in station.half_breadths.iter().zip(&cells[1 + sides..]) {
                assert_eq!(cell.value(), text.parse().ok(), "{hull} line {}: {text}", row + 1);
            }
            if sides > 0 {
                assert_eq!(station.keel_height, cells[1].parse().ok(), "{hull}");
            }
            if sides > 1 {
                assert_eq!(station.deck_height, cells[2].parse().ok(), "{hull}");
            }
            if sides > 2 {
                assert_eq!(station.flat_of_bottom, cells[3].parse().ok(), "{hull}");
            }
        }
    }
}

#[test]
fn the_shared_tables_are_given_back_byte_for_byte() {
    let Some(folder) = shared_folder() else { return };
    for (hull, ..) in SHARED {
        let text = read_text(folder.join(hull).join("offsets.csv"));
        let written = write_table(&read(hull, &text).table, TableWriting::default());
        assert_eq!(written.text, text, "{hull}");
        assert!(written.rounding.largest <= 0.0 && written.rounding.kept == written.rounding.cells, "{hull}");
    }
    let raw = read_text(folder.join("vlcc_roh/raw_VLCC_offsets_from_Roh_2017.csv"));
    assert_eq!(write_table(&read("raw", &raw).table, TableWriting::default()).text, raw);
}

#[test]
fn a_raw_table_in_millimetres_with_station_numbers() {
    let Some(folder) = shared_folder() else { return };
    let raw = read_text(folder.join("vlcc_roh/raw_VLCC_offsets_from_Roh_2017.csv"));
    let table = read_text(folder.join("vlcc_roh/offsets.csv"));
    let conventions = "[table]\nLpp = 320.0\nspaces = 20\n";
    let with = |name: &str, text: &str| {
        read_table_with(name, text.as_bytes(), Some(("vlcc.toml", conventions))).unwrap_or_else(|p| panic!("{}", p[0]))
    };
    let (raw, table) = (with("raw.csv", &raw).table, with("offsets.csv", &table).table);
    assert_eq!(raw.form.notation, Notation::Millimetres);
    assert_eq!(raw.waterlines, table.waterlines);
    for (a, b) in raw.stations.iter().zip(&table.stations) {
        assert!((a.station.x - b.station.x).abs() < 1e-12);
        for (y, z) in a.half_breadths.iter().zip(&b.half_breadths) {
            assert!((y.value().unwrap() - z.value().unwrap()).abs() < 1e-12);
        }
    }
    assert!((raw.stations[26].station.x - 20.43 * 16.0).abs() < 1e-9);
}

#[test]
fn pairs_with_stray_brackets() {
    let Some(folder) = shared_folder() else { return };
    let raw = read_text(folder.join("bodyplan_nithya/BodyPlan_raw.csv"));
    let clean = read_text(folder.join("bodyplan_nithya/offsets.csv"));
    let (raw, clean) = (read("raw.csv", &raw).table, read("offsets.csv", &clean).table);
    assert_eq!(raw.waterlines, clean.waterlines);
    assert_eq!(raw.stations.len(), clean.stations.len());
    for (a, b) in raw.stations.iter().zip(&clean.stations) {
        assert!((a.station.x - b.station.x).abs() < 1e-12, "{} {}", a.station.name, b.station.name);
        let pair = |s: &StationOffsets| s.half_breadths.iter().map(Cell::value).collect::<Vec<_>>();
        assert_eq!(pair(a), pair(b), "{}", a.station.name);
    }
}

/// Values and marks of two tables are the same; how they were written may differ.
fn assert_same(a: &OffsetTable, b: &OffsetTable, slack: f64, what: &str) {
    let near = |p: Option<f64>, q: Option<f64>| match (p, q) {
        (Some(p), Some(q)) => (p - q).abs() <= slack,
        (None, None) => true,
        _ => false,
    };
    let lists = [(&a.waterlines, &b.waterlines), (&a.buttocks, &b.buttocks)];
    for (p, q) in lists {
        assert_eq!(p.len(), q.len(), "{what}");
        assert!(p.iter().zip(q).all(|(p, q)| (p - q).abs() <= slack), "{what}: {p:?} {q:?}");
    }
    assert_eq!(a.stations.len(), b.stations.len(), "{what}");
    for (p, q) in a.stations.iter().zip(&b.stations) {
        assert!((p.station.x - q.station.x).abs() <= slack, "{what}: {} {}", p.station.x, q.station.x);
        for (c, d) in [(&p.half_breadths, &q.half_breadths), (&p.heights, &q.heights)] {
            assert_eq!(c.len(), d.len(), "{what}");
            for (c, d) in c.iter().zip(d) {
                let same = match (c.entry, d.entry) {
                    (Entry::Given(c), Entry::Given(d)) => (c - d).abs() <= slack,
                    (c, d) => c == d,
                };
                assert!(same && c.marks == d.marks, "{what} at {}: {c:?} {d:?}", p.station.name);
            }
        }
        let sides = |s: &StationOffsets| {
            [s.keel_height, s.flat_of_bottom, s.flat_of_side, s.deck_height, s.deck_half_breadth, s.deck_centre_height]
        };
        for (c, d) in sides(p).into_iter().zip(sides(q)) {
            assert!(near(c, d), "{what} at {}: {c:?} {d:?}", p.station.name);
        }
    }
    for (p, q) in a.endings.iter().zip(&b.endings) {
        assert!(near(p[0], q[0]) && near(p[1], q[1]), "{what}: {p:?} {q:?}");
    }
}

#[test]
fn our_own_tables_read_back_equal() {
    let dimensions = Dimensions { length: 100.0, breadth: 10.0, draught: 6.25, depth: 9.0 };
    let hull = analytic::wigley("Wigley", &dimensions).unwrap().hull;
    let table = OffsetTable::with_defaults(&hull);
    let both = |notation| offsets_csv(&table, notation, true) + "\n" + &heights_csv(&table, notation);
    let back = read("offsets.csv", &both(Notation::Metres));
    assert_same(&table, &back.table, 0.0, "metres");
    assert_eq!(back.table.endings.len(), table.endings.len());
    assert_eq!(write_table(&back.table, TableWriting::default()).text, both(Notation::Metres));
    assert_same(&table, &read("mm", &both(Notation::Millimetres)).table, 0.000_5 + 1e-12, "mm");
    let eighths = read("eighths", &both(Notation::FeetInchesEighths));
    assert_same(&table, &eighths.table, 0.0254 / 32.0 + 1e-12, "eighths");
    assert_eq!(write_table(&eighths.table, TableWriting::default()).text, both(Notation::FeetInchesEighths));
    // Each file alone.
    let offsets = read("offsets.csv", &offsets_csv(&table, Notation::Metres, true)).table;
    assert_eq!(offsets.waterlines, table.waterlines);
    let heights = read("heights.csv", &heights_csv(&table, Notation::Metres)).table;
    assert_eq!((heights.buttocks.len(), heights.waterlines.len()), (table.buttocks.len(), 0));
    assert_same(&heights, &read("again", &write_table(&heights, TableWriting::default()).text).table, 0.0, "heights");
}

#[test]
fn one_table_in_many_writings() {
    let plain = "x [m],0.5,1,1.5\n0,,0.5,1\n10,1,2,2.5\n20,,0.25,0.5\n";
    let expected = read("plain", plain).table;
    for (what, text) in [
        ("semicolons, decimal commas", "x [m];0,5;1;1,5\n0;;0,5;1\n10;1;2;2,5\n20;-;0,25;0,5\n"),
        ("tabs, decimal commas", "x [m]\t0,5\t1\t1,5\r\n0\t\t0,5\t1\r\n10\t1\t2\t2,5\r\n20\t*\t0,25\t0,5\r\n"),
        ("bars", "x [m]|0.5|1|1.5\n0||0.5|1\n10|1|2|2.5\n20||0.25|0.5\n"),
        ("quoted decimal commas", "x [m],\"0,5\",1,\"1,5\"\n0,,\"0,5\",1\n10,1,2,\"2,5\"\n20,,\"0,25\",\"0,5\"\n"),
        ("rows are waterlines", "z\\x [m],0,10,20\n0.5,,1,\n1,0.5,2,0.25\n1.5,1,2.5,0.5\n"),
        (
            "by words",
            "WL,STN 0 (0.00 m),STN 1 (10 m),STN 2 (20 m)\nWL 1 (0.5 m),,1,\nWL 2 (1 m),0.5,2,0.25\nWL 3 (1.5 m),1,2.5,0.5\n",
        ),
        ("falling", "x [m],1.5,1,0.5\n20,0.5,0.25,\n10,2.5,2,1\n0,1,0.5,\n"),
        ("names and positions", "station,x,WL 0.5,WL 1,WL 1.5\nA,0,,0.5,1\nB,10,1,2,2.5\nC,20,,0.25,0.5\n"),
        (
            "names and positions, numbers alone",
            "station,x_from_AP_m,0.5,1,1.5\nA,0,,0.5,1\nB,10,1,2,2.5\nC,20,,0.25,0.5\n",
        ),
        ("names of any kind", "No.,x [m],0.5,1,1.5\nA,0,,0.5,1\nB,10,1,2,2.5\nC,20,,0.25,0.5\n"),
        ("two rows of headers", "station,WL 1,WL 2,WL 3\nz [m],0.5,1,1.5\n0 m,,0.5,1\n10 m,1,2,2.5\n20 m,,0.25,0.5\n"),
        ("no words", ",0.5,1,1.5\n0,,0.5,1\n10,1,2,2.5\n20,,0.25,0.5\n"),
        ("millimetres", "x\\z [mm],500,1000,1500\n0,,500,1000\n10000,1000,2000,2500\n20000,,250,500\n"),
        ("guessed millimetres", "x,0.5,1,1.5\n0,,500,1000\n10,1000,2000,2500\n20,,250,500\n"),
        ("own units", "x,0.5 m,1 m,150 cm\n0,,0.5 m,1 m\n10,1,2,2500 mm\n20,,0.25,50 cm\n"),
        ("full breadths", "# breadths = full\nx [m],0.5,1,1.5\n0,,1,2\n10,2,4,5\n20,,0.5,1\n"),
        ("starboard", "x [m],0.5,1,1.5\n0,,-0.5,-1\n10,-1,-2,-2.5\n20,,-0.25,-0.5\n"),
        ("station numbers", "# station_spacing = 10\nstation,0.5,1,1.5\n0,,0.5,1\n1,1,2,2.5\n2,,0.25,0.5\n"),
        ("from FP", "# Lpp = 20\nx_from_FP_m,0.5,1,1.5\n20,,0.5,1\n10,1,2,2.5\n0,,0.25,0.5\n"),
        (
            "numbers from FP",
            "# Lpp = 20\n# spaces = 2\n# stations = numbers from FP\nst,0.5,1,1.5\n0,,0.25,0.5\n1,1,2,2.5\n2,,0.5,1\n",
        ),
        ("from midship", "# Lpp = 20\nx_from_midship_m,0.5,1,1.5\n-10,,0.5,1\n0,1,2,2.5\n10,,0.25,0.5\n"),
        ("title", "Table of offsets,,,\nx [m],0.5,1,1.5\n0,,0.5,1\n10,1,2,2.5\n20,,0.25,0.5\n"),
        (
            "tidy",
            "station,x,curve,z,y,flag\n0,0,WL,1,0.5,\n0,0,WL,1.5,1,\n1,10,WL,0.5,1,\n1,10,WL,1,2,\n1,10,WL,1.5,2.5,\n2,20,WL,1,0.25,\n2,20,WL,1.5,0.5,\n",
        ),
        ("windows", "\u{feff}x [m];0,5;1;1,5\r\n0;;0,5;1\r\n10;1;2;2,5\r\n20;;0,25;0,5\r\n"),
    ] {
        let back = read(what, text);
        assert_same(&expected, &back.table, 1e-12, what);
        // Given back as it was, but for the mark of the encoding and quotes that nobody needs.
        let own = write_table(&back.table, TableWriting::default());
        assert!(own.rounding.largest < 1e-12, "{what}");
        if what != "windows" && what != "tidy" {
            assert_eq!(own.text, text, "{what}");
        }
        for layout in [TableLayout::Matrix, TableLayout::Tidy] {
            for notation in Notation::ALL {
                let writing = TableWriting { notation: Some(notation), layout: Some(layout) };
                let other = write_table(&back.table, writing);
                let again = read(what, &other.text).table;
                assert_same(
                    &expected,
                    &again,
                    0.0254 / 32.0 + 1e-12,
                    &format!("{what} {notation:?} {layout:?}\n{}", other.text),
                );
            }
        }
    }
}

#[test]
fn marks_lines_and_conventions() {
    let text = "x [m],0.5,1\n0,?,(0.5)\n10,1!,2K\n20,(0.25T),0.5K!\n";
    let conventions = "[table]\nname = \"boat\"\nLpp = \"20 m\"\nB = 4\n\n[endings]\nstem = [[0.5, 20.5], [1, 21]]\n\n[transom]\nx = -1.5\n\
                       slope = -0.1\n\n[[line]]\nname = \"chine\"\nkind = \"knuckle\"\npoints = [[0.0, 1.0, 0.5], [20, 0.5, 1.0]]\n";
    let read = read_table_with("t.csv", text.as_bytes(), Some(("t.toml", conventions))).unwrap();
    let t = &read.table;
    assert_eq!((t.name.as_str(), t.stated.breadth), ("boat", Some(4.0)));
    assert_eq!(t.endings, [[None, Some(20.5)], [None, Some(21.0)]]);
    assert_eq!(t.transom.unwrap().x_base.to_bits(), (-1.5f64).to_bits());
    assert_eq!((t.lines[0].name.as_str(), t.lines[0].points.len()), ("chine", 2));
    let cell = |i: usize, j: usize| &t.stations[i].half_breadths[j];
    assert_eq!(cell(0, 0).entry, Entry::Unknown);
    assert!(cell(0, 1).marks.doubtful && cell(1, 0).marks.locked && cell(1, 1).marks.knuckle);
    assert!(cell(2, 0).marks.doubtful && cell(2, 0).marks.tangent && cell(2, 1).marks.locked);
    assert_eq!((cell(2, 1).written.as_ref().unwrap().row, cell(2, 1).written.as_ref().unwrap().column), (4, 3));
    let tidy = write_table(t, TableWriting { layout: Some(TableLayout::Tidy), notation: None });
    let again = read_table("t.csv", tidy.text.as_bytes()).unwrap().table;
    assert_same(t, &again, 0.0, &tidy.text);
    assert_eq!(again.lines, t.lines);
    assert_eq!(again.endings, t.endings);
}

/// Blank cells in the side of a hull are offsets that are missing; outside of it, or with a dash, there is no hull.
#[test]
fn blank_cells_among_offsets_are_missing() {
    let text = "station,0,1,2,3,4\n0,,,1,2,3\n1,1,,2,3,4\n2,2,3,-,4,5\n3,,,,,\n4,1,,0,,4\n5,,1,2,3,4\n6,0,1,,2,3\n7,0,1,2,3,\n";
    let found = read("t.csv", text);
    let entry = |station: usize| {
        let entry = |cell: &Cell| match cell.entry {
            Entry::Absent => '-',
            Entry::Unknown => '?',
            Entry::Given(_) => '1',
        };
        found.table.stations[station].half_breadths.iter().map(entry).collect::<String>()
    };
    // Below the keel; connected with that; a dash; a station of which nothing is given; beside a zero; in the
    // side; above the deck.
    let entries: Vec<String> = (0..8).map(entry).collect();
    assert_eq!(entries, ["--111", "1-111", "11-11", "?????", "1-1-1", "-1111", "11?11", "1111-"]);
    let told = found.notes.iter().find(|note| note.code == "W314").unwrap().to_string();
    for part in ["6 blank cells", "station 3, waterline 0 m", "station 6, waterline 2 m", "'-' where there is no hull"]
    {
        assert!(told.contains(part), "{told}");
    }
    assert_eq!(write_table(&found.table, TableWriting::default()).text, text);
    // In another layout the same is said.
    let tidy = TableWriting { layout: Some(TableLayout::Tidy), ..TableWriting::default() };
    let again = read("t.csv", &write_table(&found.table, tidy).text);
    let of = |read: &ReadTable| -> Vec<Entry> {
        read.table.stations.iter().flat_map(|s| &s.half_breadths).map(|cell| cell.entry).collect()
    };
    assert_eq!(of(&again), of(&found));
}

#[test]
fn only_changed_cells_are_written_anew() {
    let text = "station;0,500;1,000\n0;0,50;1,000\n1;1,25;2,000\n";
    let mut table = read("t.csv", text).table;
    table.stations[1].half_breadths[0].entry = Entry::Given(1.300_44);
    let written = write_table(&table, TableWriting::default());
    assert_eq!(written.text, "station;0,500;1,000\n0;0,50;1,000\n1;1,300;2,000\n");
    assert_eq!((written.rounding.cells, written.rounding.kept), (4, 3));
    assert!((written.rounding.largest - 0.000_44).abs() < 1e-9);
    assert!((written.rounding.root_mean_square - 0.000_22).abs() < 1e-9);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]
    /// What is written reads back, within half a step of the notation, in each notation and layout.
    #[test]
    fn written_tables_read_back(
        stations in 2usize..7,
        waterlines in 2usize..6,
        seed in any::<u64>(),
        notation in 0usize..6,
        tidy in any::<bool>(),
    ) {
        let mut random = StdRng::seed_from_u64(seed);
        let mut table = OffsetTable {
            waterlines: (0..waterlines).map(|j| 0.5 + j as f64).collect(),
            buttocks: vec![1.0, 2.5],
            ..OffsetTable::default()
        };
        let cell = |random: &mut StdRng| {
            let value = (random.random_range(0.001..9.0f64) * 1e4).round() / 1e4;
            let entry = match random.random_range(0..8) {
                0 => Entry::Absent,
                1 => Entry::Unknown,
                _ => Entry::Given(value),
            };
            let given = entry != Entry::Absent;
            let doubtful = given && random.random_bool(0.2);
            let marks = Marks {
                doubtful: doubtful && entry != Entry::Unknown,
                locked: given && !doubtful && random.random_bool(0.2),
                knuckle: given && random.random_bool(0.2),
                tangent: given && random.random_bool(0.2),
            };
            Cell { entry, marks, written: None }
        };
        for i in 0..stations {
            let mut station = StationOffsets::new(format!("{i}"), 10.0 * i as f64);
            station.half_breadths = (0..waterlines).map(|_| cell(&mut random)).collect();
            station.half_breadths[0] = Cell::from(Some(1.5 + i as f64));
            station.heights = (0..2).map(|_| cell(&mut random)).collect();
            station.heights[0] = Cell::from(Some(0.25));
            station.keel_height = random.random_bool(0.5).then_some(0.125);
            station.deck_height = random.random_bool(0.5).then_some(7.5);
            station.deck_half_breadth = random.random_bool(0.5).then_some(4.25);
            table.stations.push(station);
        }
        // A waterline of a tidy table lives by its offsets.
        let first = &mut table.stations[0];
        for cell in first.half_breadths.iter_mut().chain(&mut first.heights) {
            if cell.entry == Entry::Absent {
                *cell = Cell::from(Some(2.0));
            }
        }
        table.endings = (0..waterlines).map(|j| [Some(-0.5), Some(70.0 + j as f64)]).collect();
        let notation = Notation::ALL[notation];
        let layout = if tidy { TableLayout::Tidy } else { TableLayout::Matrix };
        let writing = TableWriting { notation: Some(notation), layout: Some(layout) };
        let written = write_table(&table, writing);
        let back = read_table("random.csv", written.text.as_bytes());
        let back = back.map_err(|p| TestCaseError::fail(format!("{}\n{}", p[0], written.text)))?.table;
        assert_same(&table, &back, 0.0254 / 32.0 + 1e-9, &written.text);
        // Its own writing is a fixed point.
        let own = write_table(&back, TableWriting::default());
        prop_assert_eq!(&own.text, &written.text);
        assert_same(&back, &read_table("own.csv", own.text.as_bytes()).unwrap().table, 1e-12, &own.text);
    }
}

#[test]
fn random_bytes_and_mutations_never_panic() {
    let mut random = StdRng::seed_from_u64(42);
    let seeds = [
        "x [m],0.5,1,1.5\n0,,0.5,1\n10,1,(2),2.5K\n20,?,0.25,0.5\nstern,0,1,2\n\nx\\y [m],1,keel\n0,1,0\n10,1,0\n20,,0\n",
        "station,x,curve,z,y,flag\n0,0,WL,1,0.5,\n1,10,SEC,0.5,1,K\nc,10,KN,1,2,\n2,20,BT,1,0.25,?\n",
        "STN 0,STN 1\n\"(0,0)\",\"0,0\"\n\"1.5,2\",\"1,2\"\n",
        "# units = mm\nz\\x;0;1/2;3-4-5\n1,5;-;*;-0-3-4\n2 m;3' 4 5/8\";2;3,4,5\n",
        "PK\u{3}\u{4}xl/workbook.xml",
    ];
    let toml = "[table]\nunits = \"mm\"\n[endings]\nstem = [[1, 2]]\n[[line]]\npoints = [[1,2,3],[2,3,4]]\n";
    let pieces = [
        ",",
        ";",
        "\n",
        "\"",
        "\t",
        "#",
        "-",
        "1e308",
        "nan",
        "inf",
        "(",
        "\u{bd}",
        "WL",
        "=",
        "9999999999",
        "\r",
        "|",
        " ",
    ];
    for round in 0..6000 {
        let mut bytes: Vec<u8> = match round % 3 {
            0 => (0..random.random_range(0..200)).map(|_| random.random()).collect(),
            _ => seeds[random.random_range(0..seeds.len())].as_bytes().to_vec(),
        };
        for _ in 0..random.random_range(0..6) {
            let at = random.random_range(0..=bytes.len());
            match random.random_range(0..4) {
                0 if at < bytes.len() => bytes[at] = random.random(),
                1 if at < bytes.len() => {
                    bytes.remove(at);
                }
                2 => {
                    let piece = pieces[random.random_range(0..pieces.len())];
                    bytes.splice(at..at, piece.bytes());
                }
                _ => bytes.truncate(at.max(1)),
            }
        }
        let mut beside = toml.as_bytes().to_vec();
        let at = random.random_range(0..beside.len());
        beside[at] = random.random_range(32..127);
        let beside = String::from_utf8(beside).unwrap();
        let beside = random.random_bool(0.3).then_some(("b.toml", beside.as_str()));
        match read_table_with("fuzz", &bytes, beside) {
            Ok(read) => {
                let cells = read.table.stations.iter().flat_map(|s| s.half_breadths.iter().chain(&s.heights));
                assert!(cells.filter_map(Cell::value).all(f64::is_finite));
                assert!(read.table.stations.iter().all(|s| s.station.x.is_finite()));
                let _ = write_table(&read.table, TableWriting::default());
                let _ = write_table(
                    &read.table,
                    TableWriting { notation: Some(Notation::Feet), layout: Some(TableLayout::Tidy) },
                );
            }
            Err(problems) => {
                assert!(!problems.is_empty() && problems.len() < 300);
                assert!(problems.iter().any(|p| p.severity == Severity::Error));
                assert!(problems.iter().all(|p| p.to_string().len() < 1000));
            }
        }
    }
}

#[test]
fn a_table_of_40_by_25_is_read_fast() {
    let mut text = String::from("x [m]");
    for j in 0..25 {
        text += &format!(",{}", 0.5 * f64::from(j));
    }
    for i in 0..40 {
        text += &format!("\n{}", 2.5 * f64::from(i));
        for j in 0..25 {
            text += &format!(",{:.3}", 0.1 + 0.01 * f64::from(i * j));
        }
    }
    let start = std::time::Instant::now();
    for _ in 0..100 {
        assert_eq!(read("t.csv", &text).table.stations.len(), 40);
    }
    let one = start.elapsed().as_secs_f64() / 100.0;
    println!("40 x 25 offsets: {:.3} ms", 1e3 * one);
    // Generous, for busy machines and builds without optimisation.
    assert!(one < 0.1, "{one} s");
}
