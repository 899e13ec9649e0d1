//! Reading of tables of offsets: published tables as they are, our own tables, random bytes.

use std::fs;
use std::path::PathBuf;

use loftsman::exchange::{ReadTable, read_table};
use loftsman::hull::Cell;

/// The folder with published hulls: `LOFTSMAN_DATA`, or `../shared/data` beside this package.
fn data() -> Option<PathBuf> {
    let folder = std::env::var_os("LOFTSMAN_DATA")
        .map_or_else(|| PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../shared/data"), PathBuf::from);
    if folder.is_dir() {
        return Some(folder);
    }
    println!("skipped: {} is absent; set LOFTSMAN_DATA", folder.display());
    None
}

fn read(name: &str, text: &str) -> ReadTable {
    read_table(name, text.as_bytes()).unwrap_or_else(|problems| {
        let list: Vec<String> = problems.iter().take(10).map(ToString::to_string).collect();
        panic!("{name}:\n{}", list.join("\n"))
    })
}

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
    ("wigley", 41, 11, -50.0, 50.0, 6.25, 5.0),
];

#[test]
fn the_shared_tables_as_they_are() {
    let Some(folder) = data() else { return };
    for (hull, stations, waterlines, first, last, highest, largest) in SHARED {
        let text = fs::read_to_string(folder.join(hull).join("offsets.csv")).unwrap();
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
