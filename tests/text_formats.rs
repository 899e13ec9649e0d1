//! Readers of the text formats of other programs: published hulls, what is written is read back, every message, and bytes
//! that are no table.

use loftsman::exchange::{
    ReadTable, Severity, TableProblem, read_fractions, read_particulars, read_table, write_britfair, write_freeship,
    write_ghs, write_pdstrip, write_pias,
};
use loftsman::hull::{Marks, OffsetTable, OutlinePoint, StatedParticulars, StationOffsets};
use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};
use std::path::PathBuf;

/// A file of the folder with published hulls: `LOFTSMAN_DATA`, or `../shared/data` beside this package.
fn data(path: &str) -> Option<String> {
    let folder = std::env::var_os("LOFTSMAN_DATA")
        .map_or_else(|| PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../shared/data"), PathBuf::from);
    let file = folder.join(path);
    let text = std::fs::read_to_string(&file).ok();
    if text.is_none() {
        println!("skipped: {} is absent; set LOFTSMAN_DATA", file.display());
    }
    text
}

fn read(name: &str, text: &str) -> ReadTable {
    read_table(name, text.as_bytes()).unwrap_or_else(|problems| panic!("{name}: {}", list(&problems)))
}

fn list(problems: &[TableProblem]) -> String {
    problems.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n")
}

/// Area of both sides of a section below `draught`: the integral of y dz along its lines, which counts what a line doubles
/// back over once \[m^2\].
fn area(station: &StationOffsets, draught: f64) -> f64 {
    let mut sum = 0.0;
    for pair in station.outlines.iter().flat_map(|line| line.windows(2)) {
        let (a, b) = (pair[0], pair[1]);
        let (low, high) = (a.z.min(draught), b.z.min(draught));
        if (b.z - a.z).abs() > 0.0 {
            let at = |z: f64| a.y + (b.y - a.y) * (z - a.z) / (b.z - a.z);
            sum += (high - low) * (at(low) + at(high));
        }
    }
    sum
}

/// Volume below `draught` by the trapezoid rule over the sections \[m^3\].
fn volume(table: &OffsetTable, draught: f64) -> f64 {
    let stations = &table.stations;
    stations
        .windows(2)
        .map(|pair| 0.5 * (pair[1].station.x - pair[0].station.x) * (area(&pair[0], draught) + area(&pair[1], draught)))
        .sum()
}

fn breadth(table: &OffsetTable) -> f64 {
    2.0 * table.stations.iter().flat_map(|s| s.outlines.iter().flatten()).map(|p| p.y).fold(0.0, f64::max)
}

#[test]
fn loops_around_both_sides_have_the_volumes_of_the_file() {
    let Some(text) = data("formats/samples/ghs_hull_30fr.gf") else { return };
    let ReadTable { table, notes } = read("hull_30fr.gf", &text);
    assert_eq!(table.stations.len(), 30);
    assert!((table.stations[29].station.x - 100.0).abs() < 1e-3 && table.stations[0].station.x.abs() < 1e-12);
    assert!((breadth(&table) - 20.0).abs() < 1e-3);
    // The closed loops of the file have these volumes; starboard alone is within 0.05 % of the mean of both sides.
    for (draught, expected) in [(5.0, 5029.5), (8.0, 9376.7), (10.0, 12772.6)] {
        let volume = volume(&table, draught);
        println!("T {draught}: {volume:.1} of {expected} m3");
        assert!((volume / expected - 1.0).abs() < 5e-4, "{draught}: {volume} {expected}");
    }
    let bow = &table.stations[28];
    assert_eq!(bow.outlines.len(), 2, "bulb and flare");
    assert!((bow.outlines[0].last().unwrap().z - 19.767 * 0.3048).abs() < 1e-9);
    assert!((bow.outlines[1][0].z - 33.234 * 0.3048).abs() < 1e-9);
    for station in &table.stations[..29] {
        // The deck steps down aft.
        let deck = station.deck_height.unwrap() / 0.3048;
        assert!([46.869, 32.808].iter().any(|height| (deck - height).abs() < 1e-3), "{deck}");
        assert!(station.outlines.iter().flatten().all(|p| p.y >= 0.0 && p.z >= -1e-9));
    }
    assert!(notes.iter().any(|n| n.code == "W331" && n.message.contains("29 sections give both sides")));
    assert!(notes.iter().any(|n| n.code == "W330"));
    println!("{}", list(&notes));
}

#[test]
fn skegs_alone_are_no_hull() {
    let Some(text) = data("formats/samples/ghs_skegs_only.GF") else { return };
    let problems = read_table("ghs_skegs_only.GF", text.as_bytes()).unwrap_err();
    let text = list(&problems);
    assert!(text.contains("E328") && text.contains("'SKEG1.C'") && text.contains("5.885 to 6.335 m"), "{text}");
}

#[test]
fn sections_of_a_yacht_in_two_formats() {
    let (Some(geometry), Some(points)) = (data("pdstrip_yacht/geomet.out"), data("pdstrip_yacht/sections.csv")) else {
        return;
    };
    let yacht = read("geomet.out", &geometry).table;
    assert_eq!(yacht.stations.len(), 19);
    assert_eq!(yacht.stated.draught, Some(0.963_997_7));
    let measured = volume(&yacht, 10.0);
    assert!((measured - 24.781).abs() < 5e-4, "{measured}");
    let same = read("sections.csv", &points).table;
    for (a, b) in yacht.stations.iter().zip(&same.stations) {
        assert!((a.station.x - b.station.x).abs() < 1e-3);
        assert_eq!(a.outlines, b.outlines);
        // The waterline end comes last.
        assert!((a.outlines[0].last().unwrap().z - 0.9652).abs() < 1e-9);
    }
}

#[test]
fn container_ship_in_two_formats() {
    let (Some(seaway), Some(points)) = (data("s175/S175.seaway"), data("s175/sections.csv")) else { return };
    let ship = read("S175.seaway", &seaway).table;
    assert_eq!(ship.stations.len(), 25);
    assert_eq!(ship.stated.length_between_perpendiculars, Some(175.0));
    assert_eq!(ship.stations[0].station.name, "-0.38");
    assert!((ship.stations[0].station.x + 3.25).abs() < 1e-12);
    let measured = volume(&ship, 9.5);
    assert!((measured - 24016.0).abs() < 1.0, "{measured}");
    let same = read("sections.csv", &points).table;
    for (a, b) in ship.stations.iter().zip(&same.stations) {
        assert!((a.station.x - b.station.x).abs() < 1e-9);
        assert_eq!(a.outlines, b.outlines);
    }
}

#[test]
fn fractions_of_series_60_are_its_offsets() {
    for (block, raw) in
        [("060", "raw_binoyp_cb0p6.csv"), ("070", "raw_binoyp_cb0p7.csv"), ("075", "raw_binoyp_cb0p75.csv")]
    {
        let folder = format!("series60_cb{block}");
        let files = ["offsets_ratio.csv", raw, "offsets.csv", "reference.toml"].map(|f| data(&format!("{folder}/{f}")));
        let [Some(ratio), Some(raw), Some(offsets), Some(beside)] = files else { return };
        let missing = read_table("offsets_ratio.csv", ratio.as_bytes()).unwrap_err();
        assert!(list(&missing).contains("E327") && list(&missing).contains("L (Lpp), B, T"), "{}", list(&missing));
        let mut stated = read_particulars("reference.toml", &beside).unwrap();
        // The parents' proportions (L/B 7.5, 7.0, 6.75; B/T 2.5); the dimensions beside the tables are rounded.
        let exact = 121.92 / [7.5, 7.0, 6.75][usize::from(block == "070") + 2 * usize::from(block == "075")];
        assert!((stated.breadth.unwrap() - exact).abs() < 5.1e-5);
        (stated.breadth, stated.draught) = (Some(exact), Some(exact / 2.5));
        let table =
            read_fractions("offsets_ratio.csv", &ratio, &stated).unwrap_or_else(|p| panic!("{}", list(&p))).table;
        let rows: Vec<Vec<f64>> =
            offsets.lines().skip(1).map(|line| line.split(',').map(|v| v.parse().unwrap()).collect()).collect();
        let heights: Vec<f64> =
            offsets.lines().next().unwrap().split(',').skip(1).map(|v| v.parse().unwrap()).collect();
        assert_eq!(table.stations.len(), rows.len());
        for (z, expected) in table.waterlines.iter().zip(&heights) {
            assert!((z - expected).abs() < 1e-4, "{z} {expected}");
        }
        for (station, row) in table.stations.iter().zip(&rows) {
            assert!((station.station.x - row[0]).abs() < 1e-3);
            for (cell, expected) in station.half_breadths.iter().zip(&row[1..]) {
                assert!((cell.value().unwrap() - expected).abs() < 5.1e-5, "{} {expected}", cell.value().unwrap());
            }
            assert_eq!(station.flat_of_bottom, station.half_breadths[0].value());
        }
        // The raw table is the same; of Cb 0.60 one cell is a slip, which is noted and kept.
        let rough = read_fractions("raw.csv", &raw, &stated).unwrap_or_else(|p| panic!("{}", list(&p)));
        let mut others = 0;
        for (a, b) in table.stations.iter().zip(&rough.table.stations) {
            for (a, b) in a.half_breadths.iter().zip(&b.half_breadths) {
                others += usize::from((a.value().unwrap() - b.value().unwrap()).abs() > 1e-12);
            }
        }
        let slips = rough.notes.iter().filter(|note| note.code == "W335").count();
        assert_eq!((others, slips), if block == "060" { (1, 1) } else { (0, 0) });
        assert!(rough.notes.iter().any(|note| note.message.contains("taken as FP")));
    }
}

#[test]
fn fractions_of_half_the_breadth_with_waterlines_that_are_counted() {
    let (Some(ratio), Some(offsets)) = (data("coaster_sharif/offsets_ratio.csv"), data("coaster_sharif/offsets.csv"))
    else {
        return;
    };
    let stated = StatedParticulars {
        length_between_perpendiculars: Some(41.4),
        breadth: Some(9.9),
        draught: Some(2.6),
        depth: None,
    };
    let table = read_fractions("offsets_ratio.csv", &ratio, &stated).unwrap_or_else(|p| panic!("{}", list(&p))).table;
    assert!((table.waterlines[6] - 2.6).abs() < 1e-12);
    for (station, line) in table.stations.iter().zip(offsets.lines().skip(1)) {
        let row: Vec<f64> = line.split(',').map(|v| v.parse().unwrap()).collect();
        assert!((station.station.x - row[0]).abs() < 1e-9);
        for (cell, expected) in station.half_breadths.iter().zip(&row[2..]) {
            assert!((cell.value().unwrap() - expected).abs() < 5.1e-5);
        }
    }
}

#[test]
fn samples_of_other_programs() {
    if let Some(text) = data("formats/samples/pias_barge.txt") {
        let table = read("pias_barge.txt", &text).table;
        assert_eq!(table.stations.len(), 21);
        assert!((breadth(&table) - 10.0).abs() < 1e-9 && (table.stations[20].station.x - 100.0).abs() < 1e-9);
    }
    if let Some(text) = data("formats/samples/freeship_round_import.txt") {
        let table = read("round.txt", &text).table;
        assert!((table.stations[0].station.x + 2.3622).abs() < 1e-9 && table.lines.is_empty());
        assert!((table.stations[0].outlines[0][7].y - 0.76813).abs() < 1e-12);
        assert_eq!(table.form.decimals, Some(5));
    }
    if let Some(text) = data("formats/samples/freeship_chines_import.txt") {
        let read = read("chines.txt", &text);
        assert!(read.table.lines.len() > 3 && read.table.stations.len() > 20);
        let middle = read.table.stations.iter().find(|s| (s.station.x - 5.994).abs() < 0.01).unwrap();
        assert!(middle.outlines[0].len() >= read.table.lines.len() - 1);
        assert!((middle.outlines[0][0].z + 0.195).abs() < 1e-9 && middle.outlines[0][1].marks.knuckle);
    }
    for (file, count, points) in [("M16_GG.bri", 19, 175), ("M16_fine_GG.bri", 23, 234)] {
        let Some(text) = data(&format!("moro_m16/{file}")) else { return };
        let table = read(file, &text).table;
        assert_eq!(table.stations.len(), count);
        assert_eq!(table.stations.iter().map(|s| s.outlines[0].len()).sum::<usize>(), points);
    }
    for (folder, expected, draught, tolerance) in
        [("dtc", 173_398.0, 14.5, 0.01), ("dtmb5415", 8425.4, 6.15, 0.01), ("sterntrawler", 1633.48, 5.2736, 0.02)]
    {
        let Some(text) = data(&format!("{folder}/sections.csv")) else { return };
        let table = read("sections.csv", &text).table;
        let volume = volume(&table, draught);
        println!("{folder}: {volume:.1} of {expected} m3");
        assert!((volume / expected - 1.0).abs() < tolerance, "{folder}: {volume} {expected}");
    }
}

/// A transom, a flat bottom with a knuckle, and a bulb under a flare.
fn ship() -> OffsetTable {
    let station = |name: &str, x: f64, branches: &[&[(f64, f64)]]| StationOffsets {
        outlines: branches
            .iter()
            .map(|line| {
                let mark = |y: f64, z: f64| y > 6.0 && z < 1.5;
                line.iter()
                    .map(|&(y, z)| OutlinePoint { y, z, marks: Marks { knuckle: mark(y, z), ..Marks::default() } })
                    .collect()
            })
            .collect(),
        deck_centre_height: Some(7.125),
        ..StationOffsets::new(name, x)
    };
    OffsetTable {
        name: "three sections".to_owned(),
        stations: vec![
            station("0", 0.0, &[&[(0.0, 4.0), (3.0, 4.25), (3.5, 6.0), (3.5, 7.0)]]),
            station("1", 20.5, &[&[(0.0, 0.0), (5.0, 0.0), (6.25, 1.0), (6.25, 4.0), (6.25, 7.0)]]),
            station("2", 41.0, &[&[(0.0, 0.0), (1.0, 1.0), (0.0, 2.0)], &[(0.0, 4.0), (1.0, 5.0), (2.5, 7.0)]]),
        ],
        ..OffsetTable::default()
    }
}

type Writer = fn(&OffsetTable) -> String;

/// Name of a file, writer, half of the last digit \[m\].
const WRITERS: [(&str, Writer, f64); 5] = [
    ("a.gf", write_ghs, 0.5e-4 * 0.3048),
    ("a.bri", write_britfair, 0.5e-6),
    ("a.pias", write_pias, 0.5e-4),
    ("geomet.out", write_pdstrip, 0.5e-4),
    ("a.txt", write_freeship, 0.5e-5),
];

#[test]
fn what_is_written_is_read_back() {
    let ship = ship();
    for (name, write, digit) in WRITERS {
        let text = write(&ship);
        let back = read(name, &text).table;
        assert_eq!(back.stations.len(), 3, "{name}");
        for (a, b) in ship.stations.iter().zip(&back.stations) {
            assert!((a.station.x - b.station.x).abs() <= digit + 1e-12);
            assert_eq!(a.outlines.len(), b.outlines.len(), "{name} {:?}", b.outlines);
            for (a, b) in a.outlines.iter().flatten().zip(b.outlines.iter().flatten()) {
                assert!((a.y - b.y).abs() <= digit + 1e-12 && (a.z - b.z).abs() <= digit + 1e-12, "{name} {a:?} {b:?}");
                assert!(name != "a.pias" || a.marks == b.marks);
            }
            assert!(name != "a.gf" || (b.deck_centre_height.unwrap() - 7.125).abs() < digit);
        }
        assert!((volume(&ship, 6.0) / volume(&back, 6.0) - 1.0).abs() < 1e-4);
        assert_eq!(write(&back), text, "{name}: writing again changes nothing");
    }
}

#[test]
fn sections_under_water_for_strip_theory() {
    let mut ship = ship();
    ship.stated.draught = Some(4.5);
    let back = read("geomet.out", &write_pdstrip(&ship)).table;
    assert_eq!(back.stated.draught, Some(4.5));
    assert!((volume(&back, 9.0) / volume(&ship, 4.5) - 1.0).abs() < 1e-4);
    for station in &back.stations {
        assert!((station.outlines.last().unwrap().last().unwrap().z - 4.5).abs() < 1e-9);
    }
}

#[test]
fn grids_are_written_as_sections() {
    use loftsman::parametric::analytic::{self, Dimensions};
    let dimensions = Dimensions { length: 100.0, breadth: 10.0, draught: 6.25, depth: 9.0 };
    let hull = analytic::wigley("Wigley", &dimensions).expect("valid dimensions").hull;
    let table = OffsetTable::with_defaults(&hull);
    for (name, write, _) in WRITERS {
        let back = read(name, &write(&table)).table;
        let volume = volume(&back, 6.25);
        // Trapezoids of 7 waterlines and 20 stations lose 0.6 % of 4/9 L B T.
        assert!((volume / (4.0 / 9.0 * 6250.0) - 1.0).abs() < 0.01, "{name}: {volume}");
    }
}

const DELFTSHIP: &str = "3\n4\n1\n1\n1\n1\n1\n40.0\n10.0\n3.0\n0 10 30 40\n0.5 1.5 3.0\n\
    - - 1.00\n2.5 3.5 4.25\n3.0 4.0 5.0\n- 0.25 0.5\n\
    5 3.0  5 4.5  5 5.0  5.5 2.0\n2.0 0.25 0 0.5\n4.0 2.5 -1.0\n39.0 40.5 41.0\n0 1.0 1.5 0\n";

const SEAWAY: &str = "4.19\nSmall ship\n3.0 0.0 20.0 1.0\n2\n11.0 10.0\n2\n-1 2 0.0\n2.0 0.0 2.5 1.0 3.0\n2.0\n\
    10.00 3 0.0\n0.0 0.0 0.0 2.0 1.0 3.0\n3.0 3.0\n20.00 1 0.0\n0.0 0.0 3.0 0.5\n1.0 1.0 1.0\n*** End of file ***\n";

const CHINES: &str = "1\n0 0 0.1\n5 0 0\n10 0 1\n\n0 1 0.5\n5 1.5 0.4\n9 0.5 0.8\n10 0 1\n\n0 1.25 1\n10 0.25 1.5\n";

const FRACTIONS: &str = "# a small ship\n# L = 40 m, B = 32 ft, T = 3.0\n# station 0 = AP, 10 = FP\n\
    station,wl0_tangent,wl0.5,wl1,area\n0,0,0,0.2,0\n5,0.5,0.9,1,1\n10,0,0.01,0.02,0\nmax,0.8,0.9,1,\n";

const POINTS: &str = "x_from_AP_m,loop,point,y_mm,z_mm\n0,0,0,0,500\n0,0,1,1500,1000\n0,0,2,1600,3000\n\
    20,0,0,0,0\n20,0,1,2000,0\n20,0,2,2100,3000\n39,0,0,0,100\n39,0,1,250,500\n39,0,2,0,900\n\
    39,1,0,0,1500\n39,1,1,800,3000\n39,1,2,0,3010\n";

const MARKERS: &str = "Station\tLong. Pos. m\tOffset m\tHeight m\n1\t0\t0\t0.5\n1\t0\t2\t3\n2\t20\t0\t0\n2\t20\t3\t3\n";

#[test]
fn offsets_with_counts_and_flags() {
    let ReadTable { table, notes } = read("a.txt", DELFTSHIP);
    let cells: Vec<Vec<Option<f64>>> =
        table.stations.iter().map(|s| s.half_breadths.iter().map(loftsman::hull::Cell::value).collect()).collect();
    assert_eq!(cells[0], [None, None, Some(1.0)]);
    assert_eq!(cells[3], [None, Some(0.25), Some(0.5)]);
    assert_eq!(table.waterlines, [0.5, 1.5, 3.0]);
    assert_eq!(table.stations[3].deck_height, Some(5.5));
    assert_eq!(table.stations[1].deck_half_breadth, Some(4.5));
    assert_eq!(table.stations[3].keel_height, Some(0.5));
    assert_eq!(table.endings[2], [Some(-1.0), Some(41.0)]);
    assert_eq!(table.stations[2].flat_of_bottom, Some(1.5));
    assert_eq!(table.stated.breadth, Some(10.0));
    assert_eq!(table.form.decimals, Some(2));
    assert!(notes.iter().any(|note| note.message.contains("not published")));
    // A line a waterline is known by its length.
    let turned = DELFTSHIP.replace(
        "- - 1.00\n2.5 3.5 4.25\n3.0 4.0 5.0\n- 0.25 0.5\n",
        "- 2.5 3.0 -\n- 3.5 4.0 0.25\n1.00 4.25 5.0 0.5\n",
    );
    let turned = read("a.txt", &turned).table;
    for (a, b) in table.stations.iter().zip(&turned.stations) {
        let values = |s: &StationOffsets| s.half_breadths.iter().map(loftsman::hull::Cell::value).collect::<Vec<_>>();
        assert_eq!(values(a), values(b));
    }
}

#[test]
fn small_samples_of_the_others() {
    let ship = read("a.seaway", SEAWAY).table;
    assert_eq!(ship.name, "Small ship");
    assert_eq!(ship.stations.iter().map(|s| s.station.x).collect::<Vec<_>>(), [-1.0, 10.0, 20.0]);
    assert_eq!((ship.stations[1].outlines[0][1].y, ship.stations[1].outlines[0][1].z), (2.0, 0.0));
    let scaled = read("a.seaway", &SEAWAY.replace("1.0 1.0 1.0", "2.0 1.5 0.5"));
    assert!((volume(&scaled.table, 9.0) / volume(&ship, 9.0) - 1.5).abs() < 1e-12);
    assert!(list(&scaled.notes).contains("multiplied by 2, 1.5 and 0.5"));

    let boat = read("chines.txt", CHINES).table;
    assert_eq!(boat.lines.len(), 3);
    let at_five = boat.stations.iter().find(|s| (s.station.x - 5.0).abs() < 1e-12).unwrap();
    let points: Vec<(f64, f64)> = at_five.outlines[0].iter().map(|p| (p.y, p.z)).collect();
    assert_eq!(points, [(0.0, 0.0), (1.5, 0.4), (0.75, 1.25)]);
    assert!(at_five.outlines[0][1].marks.knuckle && !at_five.outlines[0][2].marks.knuckle);

    let table = read("ratio.csv", FRACTIONS).table;
    assert!((table.stations[1].half_breadths[1].value().unwrap() - 0.9 * 0.9 * 16.0 * 0.3048).abs() < 1e-12);
    assert!((table.stations[1].station.x - 20.0).abs() < 1e-12 && table.stations[1].half_breadths[0].marks.tangent);
    assert_eq!(table.stations[1].half_breadths[1].written.as_ref().unwrap().column, 3);
    assert!((table.waterlines[1] - 1.5).abs() < 1e-12);

    let points = read("sections.csv", POINTS).table;
    assert_eq!(points.stations[2].outlines.len(), 2);
    assert_eq!(points.stations[2].outlines[1].len(), 2, "the deck is taken off");
    assert!((points.stations[2].deck_centre_height.unwrap() - 3.01).abs() < 1e-12);
    assert!((points.stations[1].outlines[0][2].y - 2.1).abs() < 1e-12);
    assert_eq!(points.form.decimals, Some(3));
    assert!((breadth(&read("markers.txt", MARKERS).table) - 6.0).abs() < 1e-12);

    // A section that gives both sides, in a format of half sections.
    let both = "both\n1\n6 0 0\n0.1 0\n1 1\n1 2\n-1 2\n-1.1 1\n-0.1 0\n0\n3 5 5\n0 0\n2 1\n2 2\n0\n0 0 0\n";
    let both = read("a.bri", both);
    assert!(list(&both.notes).contains("differ by up to 0.1"), "{}", list(&both.notes));
    assert!((both.table.stations[0].outlines[0][1].y - 0.1).abs() < 1e-12);
    // An unsymmetric body of strip theory, with a gap.
    let unsymmetric = "2 f 2\n0 4 0\n 1 1 -1 -1\n 0 2 2 0\n9 5 1 3\n 1 1 0 -1 -1\n 0 2 2 2 0\n";
    assert_eq!(read("geomet.out", unsymmetric).table.stations[0].outlines[0].len(), 4);
}

#[test]
fn origins_and_directions() {
    // From the forward perpendicular aft: GHS counts aft, 65.6168 ft are 20 m.
    let shape = |xs: [f64; 3]| {
        let sections: String = xs.iter().map(|x| format!("{x},3\n0,0\n9,3\n9,9\n")).collect();
        format!(
            "a\nL:65.6168\n*\nS\n3\n{sections}0,0,0\n**\nC\n0\n1\n0,0,0\nS\n***\nHULL\nSEA WATER\n1\n1\n0,0,0\n1\nC\n****\n"
        )
    };
    for (xs, origin) in [
        ([0.0, 32.8084, 65.6168], "forward perpendicular"),
        ([-32.8084, 0.0, 32.8084], "amidships"),
        ([-65.6168, -32.8084, 0.0], "after perpendicular"),
        ([100.0, 132.8084, 165.6168], "the aftermost section is taken as AP"),
    ] {
        let read = read("a.gf", &shape(xs));
        assert!(list(&read.notes).contains(origin), "{origin}: {}", list(&read.notes));
        for (station, x) in read.table.stations.iter().zip([0.0, 10.0, 20.0]) {
            assert!((station.station.x - x).abs() < 1e-4, "{origin}: {}", station.station.x);
        }
    }
    // From the bow: turned round, with the same x.
    let text = "2\n20\n2\n0 0 1\n1 1 1\n0\n2\n0 0 1\n2 1 1\n";
    let table = read("a.pias", text).table;
    assert!(table.stations[0].station.x.abs() < 1e-12 && (table.stations[0].outlines[0][1].y - 2.0).abs() < 1e-12);
}

#[test]
fn one_sided_parts_and_others_are_left_out_with_notes() {
    let text = write_ghs(&ship()).replace("0,0,0\n**\n", "0,0,0\nSKEG\n2\n10,4\n3,0\n4,0\n4,1\n3,0\n30,4\n3,0\n4,0\n4,1\n3,0\n0,0,0\n**\nSKEG.S\n1\n1\n0,0,0\nSKEG\n")
        .replace("0,0,0\n1\nHULL.C\n", "0,0,0\n2\nSKEG.S\nHULL.C\nTANK\nFRESH WATER\n2\n1\n0,0,0\n1\nHULL.C\n");
    let read = read("a.gf", &text);
    assert_eq!(read.table.stations.len(), 3);
    let notes = list(&read.notes);
    assert!(
        notes.contains("component 'SKEG.S' is left out: 2 sections from y = 0.914 to 1.219 m, on starboard only"),
        "{notes}"
    );
    assert!(notes.contains("part 'TANK' is left out"), "{notes}");
    // The hull on one side only is not mirrored.
    let half = write_ghs(&ship()).replace("HULL.C\n0\n", "HULL.C\n1\n");
    let problems = list(&read_table("a.gf", half.as_bytes()).unwrap_err());
    assert!(problems.contains("on starboard only") && problems.contains("needs side 0"), "{problems}");
}

/// What is wrong with a file, provoked once each: name, text, code, row (0: the whole file), part of the message.
fn faults() -> Vec<(&'static str, String, &'static str, usize, &'static str)> {
    let ghs = write_ghs(&ship());
    let bri = write_britfair(&ship());
    let pias = write_pias(&ship());
    let strip = write_pdstrip(&ship());
    let round = write_freeship(&ship());
    let without = |text: &str, lines: &[usize]| -> String {
        let kept = text.lines().enumerate().filter(|(i, _)| !lines.contains(&(i + 1)));
        kept.map(|(_, line)| format!("{line}\n")).collect()
    };
    let cut =
        |text: &str, lines: usize| -> String { text.lines().take(lines).map(|line| format!("{line}\n")).collect() };
    let row_of = |text: &str, line: &str| text.lines().position(|l| l.trim() == line).unwrap() + 1;
    let star = |mark: &str| row_of(&ghs, mark);
    vec![
        ("a.gf", ghs.replace("P:M", "metric"), "E326", 2, "KEY:value"),
        ("a.gf", ghs.replace("P:M", "XY:1"), "W334", 2, "'XY:' is not used"),
        ("a.gf", without(&ghs, &[star("*")]), "E324", star("**") - 1, "'*' should end"),
        ("a.gf", without(&ghs, &[star("**")]), "E322", 0, "number of sections should be a whole number"),
        ("a.gf", without(&ghs, &[star("***")]), "E324", star("****") - 1, "'***' should end the components"),
        ("a.gf", without(&ghs, &[star("****")]), "E324", star("****") - 1, "ends before '****'"),
        ("a.gf", cut(&ghs, 12), "E324", 12, "ends before '**'"),
        ("a.gf", ghs.replace("*\nHULL\n3", "*\nHULL\n4"), "E322", 0, "x and number of points expected (row"),
        ("a.gf", ghs.replace("*\nHULL\n3", "*\nHULL\n2"), "E322", 0, "number of sections expected, one number"),
        ("a.gf", ghs.replace("*\nHULL\n3", "*\nHULL\n3000000"), "E321", row_of(&ghs, "*") + 2, "beyond 1000000"),
        ("a.gf", ghs.replace("*\nHULL\n3", "*\nHULL\n999999"), "E322", 0, "expected"),
        ("a.gf", ghs.replace("0.0000,6\n", "0.0000,7\n"), "E322", 0, "should be a whole number"),
        ("a.gf", ghs.replace("HULL.C\n0\n", "HULL.C\nx\n"), "E321", star("**") + 2, "the side is not a number"),
        (
            "a.gf",
            ghs.replace("0\n1\n0,0,0\nHULL\n***", "0\n1\n0,0\nHULL\n***"),
            "E322",
            star("**") + 4,
            "offset x, y, z",
        ),
        ("a.gf", ghs.replace("1\nHULL.C\n****", "1\nHULL.X\n****"), "E326", star("***") + 1, "does not define"),
        ("a.gf", ghs.replace("0,0,0\nHULL\n***", "0,0,0\nHILL\n***"), "E326", star("**") + 1, "has a shape that"),
        (
            "a.gf",
            ghs.replace("1\nHULL.C\n****", "2\nHULL.C\n****"),
            "E322",
            0,
            "announces 2 components, the file has 1",
        ),
        ("a.gf", ghs.replace("0,0,0\n**\n", "1,0,0\n**\n"), "W334", star("**") - 1, "are not applied"),
        ("a.gf", "a\n*\n**\n***\n****\n".to_owned(), "E328", 0, "no shapes"),
        ("a.gf", format!("{}****\n", cut(&ghs, star("***"))), "E328", 0, "no parts"),
        ("a.bri", bri.replace("\n1\n", "\n2\n"), "W332", 2, "2 hulls; the first is read"),
        ("a.bri", bri.replace("\n1\n", "\none\n"), "E321", 2, "number of hulls is not a number"),
        ("a.bri", bri.replace("\n1\n", "\n1 2\n"), "E326", 2, "second line"),
        ("a.bri", bri.replace("4 0.000000 0.000000", "5 0.000000 0.000000"), "E322", 3, "announces 5 points, 4 follow"),
        ("a.bri", bri.replace("4 0.000000 0.000000", "4 0.000000 0.500000"), "W334", 3, "x is written as 0 and as 0.5"),
        ("a.bri", without(&bri, &[8]), "E324", 8, "'0' should end the section of row 3"),
        ("a.bri", bri.replace("0 0 0\n", ""), "E324", 0, "without '0 0 0'"),
        ("a.bri", bri.replace("3.500000 6.000000", "3,5 6.000000"), "E321", 6, "y is not a number. Write 3.5"),
        (
            "a.bri",
            bri.replace("3.500000 6.000000", "-3.500000 6.000000")
                .replace("3.500000 7", "-3.500000 7")
                .replace("3.000000 4", "-3.000000 4")
                .replace("0.000000 4.000000\n-", "-1 4\n-"),
            "E325",
            3,
            "4 of 4 half-breadths are negative. Give the side with positive y",
        ),
        ("a.bri", bri.replace("\n0 0 0\n", "\n0 0 0\nmore\n"), "W332", 0, "what follows"),
        ("a.bri", bri.replace("5 20.500000 20.500000", "5 20.500000"), "E326", 9, "begins with its number of points"),
        ("a.bri", "name\n".to_owned(), "E324", 0, "ends after its name"),
        ("a.pias", pias.replacen('3', "4", 1), "E322", 1, "announces 4 sections, 3 follow"),
        ("a.pias", pias.replacen("     4\n", "     9\n", 1), "E322", 2, "announces 9 points, 4 follow"),
        (
            "a.pias",
            pias.replacen("3.5000   6.0000     1", "3.5000   6.0000", 1),
            "E322",
            6,
            "a point is y, z and a flag",
        ),
        (
            "a.pias",
            pias.replacen("3.5000   6.0000     1", "-3.5000   6.0000     1", 1),
            "E325",
            2,
            "1 of 4 half-breadths are negative",
        ),
        ("a.pias", pias.replacen("3.5000   6.0000     1", "-0.0001   6.0000     1", 1), "W335", 2, "taken as 0"),
        ("a.pias", pias.clone(), "W334", 0, "read as knuckles"),
        ("a.pias", without(&pias, &[8]), "E326", 0, "a line with x and one with the number of points"),
        ("a.pias", pias.replace(" 20.5000\n", " 50.5000\n"), "E323", 15, "x = 41 m after 50.5 m"),
        ("a.pias", pias.replace(" 20.5000\n", " 41.0000\n"), "E323", 15, "two sections at x = 41 m"),
        ("a.pias", cut(&pias, 7).replacen('3', "1", 1), "E328", 0, "1 sections are no hull"),
        ("geomet.out", strip.replacen('3', "2", 1), "E322", 1, "announces 2 sections, 3 follow"),
        (
            "geomet.out",
            strip.replace("0.0000 4 0", "0.0000 5 0"),
            "E322",
            4,
            "5 points announced in row 2, the lines of y hold 8",
        ),
        ("geomet.out", strip.replace("0.0000 4 0", "0.0000 3 0"), "E322", 3, "hold 4"),
        ("geomet.out", strip.replace("0.0000 4 0", "0.0000 999999 0"), "E322", 0, "the file ends after"),
        ("geomet.out", strip.replace("0.0000 4 0", "0.0000 4"), "E326", 2, "number of gaps expected"),
        ("geomet.out", strip.replace("0.0000 4 0", "0.0000 4 1"), "E322", 2, "1 gaps announced, 0 given"),
        ("geomet.out", strip.replacen(" t ", " f ", 1), "W331", 0, "sections give both sides"),
        ("geomet.out", "2 f 1\n0 2 0\n 0 0\n 0 1\n9 2 0\n 0 1\n 0 1\n".to_owned(), "E328", 2, "both sides expected"),
        ("a.seaway", SEAWAY.replace("\n2\n11.0", "\n5000\n11.0"), "E322", 4, "5000 intervals announced"),
        ("a.seaway", SEAWAY.replace("-1 2 0.0", "-1 400 0.0"), "E322", 7, "section 1 announces 401 points"),
        ("a.seaway", SEAWAY.replace("-1 2 0.0", "-1 3 0.0"), "E322", 0, ""),
        ("a.seaway", SEAWAY.replace("*** End of file ***\n", ""), "E324", 16, "without a line of stars"),
        ("a.seaway", cut(SEAWAY, 5), "E324", 5, "the file ends before"),
        ("a.seaway", SEAWAY.replace("3.0 0.0 20.0 1.0", "3.0 0.5 20.0 1.0"), "W334", 3, "trim 0.5 m is not applied"),
        ("a.seaway", SEAWAY.replace("1.0 1.0 1.0", "1.0 1.0 1.0\n7"), "E322", 16, "1 numbers after the three factors"),
        (
            "a.txt",
            round.replacen("0\n", "0\n", 1).replacen("6.00000", "6,00000", 1),
            "E321",
            4,
            "z is not a number. Write 6.00000",
        ),
        (
            "a.txt",
            round.replacen("        20.50000         6.25000", "        21.50000         6.25000", 1),
            "E323",
            7,
            "the section runs from x = 20.5 to 21.5 m",
        ),
        (
            "a.txt",
            round.replacen("         3.50000         6.00000", "         3.50000", 1),
            "E326",
            4,
            "2 fields; a point is x, y, z",
        ),
        ("chines.txt", CHINES.replace("9 0.5 0.8", "4 0.5 0.8"), "E323", 6, "chine 2: x = 4 m after 5 m"),
        ("chines.txt", CHINES.to_owned(), "W334", 0, "3 chines"),
        ("a.txt", DELFTSHIP.replacen('3', "4", 1), "E322", 1, "numbers after the head"),
        ("a.txt", DELFTSHIP.replace("10.0\n3.0", "10.0\n-3.0"), "E327", 10, "the draught is -3 m"),
        ("a.txt", DELFTSHIP.replace("2.5 3.5 4.25", "-2.5 3.5 4.25"), "E325", 14, "negative"),
        ("a.txt", DELFTSHIP.replace("0 10 30 40", "0 30 10 40"), "E323", 11, "10 after 30"),
        ("a.txt", DELFTSHIP.replace("2.5 3.5 4.25", "2.5 3,5 4.25"), "E321", 14, "Write 3.5"),
        ("ratio.csv", FRACTIONS.replace("# L = 40 m, B = 32 ft, T = 3.0", "# B = 32 ft"), "E327", 0, "L (Lpp), T"),
        ("ratio.csv", FRACTIONS.replace("B = 32 ft", "B = 32 leagues"), "E321", 2, ""),
        ("ratio.csv", FRACTIONS.replace("station 0 = AP", "station 0 = stern"), "E326", 3, "station 0 is AP or FP"),
        ("ratio.csv", FRACTIONS.replace("# station 0 = AP, 10 = FP\n", ""), "W334", 0, "taken as FP"),
        (
            "ratio.csv",
            FRACTIONS.replace("max,0.8,0.9,1,\n", "").replace("# a small", "# y / ymax of a small"),
            "E326",
            0,
            "no row of maxima",
        ),
        (
            "ratio.csv",
            FRACTIONS.replace("max,0.8,0.9,1,\n", "").replace("# a small", "# y/(B/2) of a small"),
            "W334",
            0,
            "fractions are of B/2",
        ),
        ("ratio.csv", FRACTIONS.replace("max,0.8,0.9,1,\n", "max,0.8,0.9\n"), "E322", 8, "shorter than the head"),
        ("ratio.csv", format!("{FRACTIONS}max,1,1,1,\n"), "E326", 9, "a second row of maxima"),
        ("ratio.csv", FRACTIONS.replace("5,0.5,0.9,1,1", "5,0.5,9,1,1"), "W335", 6, "above 1"),
        ("ratio.csv", FRACTIONS.replace("5,0.5,0.9,1,1", "5,0.5,-0.9,1,1"), "E325", 6, "negative"),
        ("ratio.csv", FRACTIONS.replace("5,0.5,0.9,1,1", "5,0.5,0.9"), "E322", 6, "3 cells, the head has 5"),
        ("ratio.csv", FRACTIONS.replace("5,0.5,0.9,1,1", "15,0.5,0.9,1,1"), "E323", 7, "station 10 after 15"),
        ("ratio.csv", FRACTIONS.replace("wl0.5,wl1", "wl1,wl0.5"), "E323", 4, "waterline at 1.5 m after 3 m"),
        ("ratio.csv", FRACTIONS.replace("wl0.5,wl1", "wl1,wl7"), "E326", 4, "7 times the draught"),
        ("ratio.csv", FRACTIONS.replace("wl0.5,wl1", "low,wl1"), "E326", 4, "a column is a waterline"),
        ("ratio.csv", FRACTIONS.replace("# a small ship", "# waterline k at z = k*x/0"), "E326", 1, "k times numbers"),
        ("ratio.csv", FRACTIONS.to_owned(), "W332", 4, "'area' is not used"),
        ("points.csv", POINTS.replace("x_from_AP_m,", "station,"), "E326", 1, "the head has no column x"),
        ("points.csv", POINTS.replace("y_mm", "y_normalised"), "E326", 1, "a column is station, x"),
        ("points.csv", POINTS.replace("loop,point", "point,point"), "E326", 1, "a second column"),
        ("points.csv", POINTS.replace("0,0,1,1500,1000", "0,0,1,1500"), "E322", 3, "4 fields, the head has 5"),
        (
            "points.csv",
            POINTS.replace("0,0,1,1500,1000", "0,0,1,-1500,1000"),
            "E325",
            2,
            "1 of 3 half-breadths are negative",
        ),
        ("points.csv", POINTS.replace("20,0,1,2000", "21,0,1,2000"), "E323", 0, "out of order"),
        (
            "markers.txt",
            MARKERS.replace("2\t20\t3", "2\t21\t3"),
            "E323",
            5,
            "station 2: x = 21 m here and 20 m in row 4",
        ),
        ("markers.txt", MARKERS.replace("2\t20\t3\t3", "2\t20\tx\t3"), "E321", 5, "'x': y is not a number"),
    ]
}

#[test]
fn every_message() {
    let mut missing = Vec::new();
    for (name, text, code, row, part) in faults() {
        let problems = match read_table(name, text.as_bytes()) {
            Ok(read) => {
                if code.starts_with('E') {
                    missing.push(format!("{name} {code} '{part}': was read\n{text}"));
                    continue;
                }
                read.notes
            }
            Err(problems) => problems,
        };
        let hit = problems.iter().any(|p| {
            p.code == code && p.to_string().contains(part) && (row == 0 || p.row == Some(row)) && p.file == name
        });
        if !hit {
            missing.push(format!("{name} {code} row {row} '{part}' not in:\n{}", list(&problems)));
        }
        let rows: Vec<usize> = problems.iter().map(|p| p.row.unwrap_or(0)).collect();
        assert!(rows.is_sorted(), "{rows:?}");
    }
    assert!(missing.is_empty(), "{}", missing.join("\n\n"));
}

#[test]
fn all_problems_of_a_file_at_once() {
    let text = write_pias(&ship())
        .replacen("     4\n", "     9\n", 1)
        .replacen("3.5000   6.0000     1", "3.5x00   6,0000     1", 1)
        .replacen("6.2500   4.0000     1", "-6.2500   4.0000     1", 1);
    let problems = read_table("a.pias", text.as_bytes()).unwrap_err();
    let places: Vec<_> =
        problems.iter().filter(|p| p.severity == Severity::Error).map(|p| (p.code, p.row, p.column)).collect();
    let expected =
        [("E322", Some(2), None), ("E321", Some(6), Some(1)), ("E321", Some(6), Some(2)), ("E325", Some(8), None)];
    assert_eq!(places, expected, "{}", list(&problems));
}

/// What must hold of whatever was read.
fn sound(name: &str, bytes: &[u8]) {
    match read_table(name, bytes) {
        Ok(ReadTable { table, .. }) => {
            assert!(table.stations.windows(2).all(|pair| pair[0].station.x <= pair[1].station.x), "{name}");
            for p in table.stations.iter().flat_map(|s| s.outlines.iter().flatten()) {
                assert!(p.y.is_finite() && p.z.is_finite() && p.y >= 0.0, "{name} {p:?}");
            }
            for (_, write, _) in WRITERS {
                write(&table);
            }
        }
        Err(problems) => {
            assert!(problems.iter().any(|p| p.severity == Severity::Error), "{name}");
            assert!(problems.len() < 1000 && problems.iter().all(|p| p.found.chars().count() < 200), "{name}");
        }
    }
}

#[test]
fn damaged_files_are_refused_or_read_and_never_stop_the_program() {
    let mut random = StdRng::seed_from_u64(2);
    let mut samples: Vec<(&str, String)> = WRITERS.iter().map(|(name, write, _)| (*name, write(&ship()))).collect();
    samples.extend(
        [
            ("a.seaway", SEAWAY),
            ("d.txt", DELFTSHIP),
            ("c.txt", CHINES),
            ("r.csv", FRACTIONS),
            ("p.csv", POINTS),
            ("m.txt", MARKERS),
        ]
        .map(|(name, text)| (name, text.to_owned())),
    );
    let words = [
        "-1",
        "0",
        "1e9",
        "999999999999999999999",
        "nan",
        "1e-300",
        "-0",
        "1,5",
        "*",
        "**",
        "****",
        "\n",
        "\n\n",
        "0 0 0",
        "\u{e9}",
        "t",
    ];
    for (name, text) in &samples {
        sound(name, text.as_bytes());
        for _ in 0..1500 {
            let mut bytes = text.clone().into_bytes();
            for _ in 0..random.random_range(1..4) {
                let at = random.random_range(0..bytes.len());
                let end = (at + random.random_range(0..12)).min(bytes.len());
                let word = words[random.random_range(0..words.len())];
                match random.random_range(0..5) {
                    0 => drop(bytes.drain(at..end)),
                    1 => drop(bytes.splice(at..at, word.bytes())),
                    2 => drop(bytes.splice(at..end, word.bytes())),
                    3 => bytes[at] = random.random_range(0..=255),
                    _ => bytes.truncate(at + 1),
                }
                if bytes.is_empty() {
                    break;
                }
            }
            sound(name, &bytes);
        }
    }
    for name in ["a.gf", "a.bri", "a.seaway", "a.txt", "a.csv"] {
        for _ in 0..1000 {
            let length = random.random_range(0..300);
            let alphabet = b"0123456789.,-* \n\n\n\tx#";
            let plain = random.random_bool(0.7);
            let bytes: Vec<u8> = (0..length)
                .map(|_| {
                    if plain { alphabet[random.random_range(0..alphabet.len())] } else { random.random_range(0..=255) }
                })
                .collect();
            sound(name, &bytes);
        }
    }
}
