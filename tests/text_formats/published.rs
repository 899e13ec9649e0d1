//! Published hulls, against figures that were found by other means.

use super::{breadth, list, read, volume};
use loftsman::internals::exchange::{ReadTable, read_fractions, read_particulars, read_table};
use loftsman::internals::hull::StatedParticulars;

use crate::support::shared_folder;

/// A file of the folder with published hulls.
fn data(path: &str) -> Option<String> {
    let file = shared_folder()?.join(path);
    let text = std::fs::read_to_string(&file).ok();
    if text.is_none() {
        println!("skipped: {} is absent", file.display());
    }
    text
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
