//! Published hulls, read where their folder is: the yacht of PDSTRIP, a stern trawler, small craft.

use super::tests::{greatest_residual, volume};
use super::*;
use crate::hull::{Cell, FeatureLine, Functional, LineKind, Marks, OutlinePoint, StationOffsets};

/// A file of the folder of published hulls; none, with a line that says so, where it is absent.
fn published(path: &str) -> Option<String> {
    let folder =
        std::env::var("LOFTSMAN_DATA").unwrap_or_else(|_| format!("{}/../shared/data", env!("CARGO_MANIFEST_DIR")));
    let text = std::fs::read_to_string(format!("{folder}/{path}")).ok();
    if text.is_none() {
        println!("skipped: there is no {path} in the folder named by LOFTSMAN_DATA");
    }
    text
}

/// Sections from rows of numbers; `columns` are those of x, branch, y and z.
fn sections(text: &str, columns: [Option<usize>; 4]) -> OffsetTable {
    let mut stations: Vec<StationOffsets> = Vec::new();
    for line in text.lines().skip(1) {
        let fields: Vec<f64> = line.split(',').map(|f| f.parse().unwrap()).collect();
        let [x, branch, y, z] = columns.map(|column| column.map_or(0.0, |c| fields[c]));
        if stations.last().is_none_or(|s| (s.station.x - x).abs() > 1e-9) {
            stations.push(StationOffsets::new(format!("{}", stations.len()), x));
        }
        let outlines = &mut stations.last_mut().unwrap().outlines;
        outlines.resize(outlines.len().max(branch as usize + 1), Vec::new());
        outlines[branch as usize].push(OutlinePoint { y, z, marks: Marks::default() });
    }
    OffsetTable { stations, ..OffsetTable::default() }
}

/// A grid of half-breadths: x, keel, perhaps top, then a column a waterline.
fn grid(text: &str, first: usize) -> OffsetTable {
    let mut lines = text.lines();
    let waterlines: Vec<f64> = lines.next().unwrap().split(',').skip(first).map(|f| f.parse().unwrap()).collect();
    let stations = lines
        .map(|line| {
            let fields: Vec<Option<f64>> = line.split(',').map(|f| f.parse().ok()).collect();
            StationOffsets {
                keel_height: fields[1],
                deck_height: if first > 2 { fields[2] } else { None },
                half_breadths: fields[first..].iter().map(|&f| Cell::from(f)).collect(),
                ..StationOffsets::new(line.split(',').next().unwrap(), fields[0].unwrap())
            }
        })
        .collect();
    OffsetTable { waterlines, stations, ..OffsetTable::default() }
}

/// Every point of every section lies on the surface to 1e-9 m.
fn assert_points_are_met(net: &Net) {
    for (k, profile) in net.profiles.iter().enumerate().filter(|(_, p)| p.station.is_some()) {
        for point in profile.points.iter().filter(|p| p.y.is_some()) {
            let Some(v) = net.v(k, point.z) else { continue };
            let on = net.surface.eval(net.length.sites[k], v);
            assert!((on[0] - profile.x).abs() < 1e-9 && (on[2] - point.z).abs() < 1e-9, "{on:?} {point:?}");
            assert!((on[1] - point.y.unwrap()).abs() < 1e-9, "{on:?} {point:?}");
        }
    }
}

/// `actual` lies within `percent` of `expected`.
fn assert_near(actual: f64, expected: f64, percent: f64, what: &str) {
    let off = 100.0 * (actual / expected - 1.0);
    println!("{what}: {actual:.4}, reference {expected} ({off:+.2} %)");
    assert!(off.abs() <= percent, "{what}: {actual} against {expected}");
}

/// V, LCB and KB are those of trapezoids through the published sections; ours hold a little more, and every second
/// station gives the same to a thousandth.
#[test]
fn the_yacht_of_pdstrip() {
    let Some(text) = published("pdstrip_yacht/sections.csv") else { return };
    let table = sections(&text, [Some(0), None, Some(2), Some(3)]);
    let net = Net::new(&table).unwrap();
    assert_points_are_met(&net);
    let [whole, lcb, vcb] = volume(&net.surface);
    assert_near(whole, 24.781, 0.5, "yacht, volume");
    assert!((lcb - 0.867).abs() < 0.02 && (vcb - 0.620).abs() < 0.002, "{lcb} {vcb}");
    let hull = fit(&table).unwrap().hull;
    assert_near(
        Functional::SectionArea { x: 0.4801 }.value(&hull, 0.9652),
        2.4014,
        0.5,
        "yacht, section near the largest",
    );
    assert_near(Functional::WaterplaneArea.value(&hull, 0.9652), 44.13, 1.5, "yacht, waterplane");
    let stations = table.stations.iter().step_by(2).cloned().collect();
    let [half, _, _] = volume(&Net::new(&OffsetTable { stations, ..table }).unwrap().surface);
    assert_near(half, whole, 0.1, "yacht, every second station");
    let Some(text) = published("pdstrip_yacht/offsets.csv") else { return };
    let [coarse, _, _] = volume(&Net::new(&grid(&text, 2)).unwrap().surface);
    assert_near(coarse, whole, 0.4, "yacht, table of 13 waterlines");
}

/// Creases of the control net: the root of the skeg, the lower and the upper edge of the flat side.
const SKEG: [[f64; 3]; 8] = [
    [3.18, 0.0, 3.52],
    [3.6, 0.2, 3.38],
    [7.2, 1.35, 2.37],
    [10.8, 1.92, 1.45],
    [14.4, 2.14, 0.78],
    [18.0, 2.18, 0.41],
    [21.6, 2.15, 0.30],
    [21.7, 2.15, 0.30],
];
const SIDE: [[f64; 3]; 11] = [
    [0.0, 5.8, 8.25],
    [1.8, 5.8, 7.33],
    [3.6, 5.8, 6.54],
    [7.2, 5.8, 5.29],
    [10.8, 5.8, 4.04],
    [14.4, 5.8, 2.93],
    [18.0, 5.8, 2.18],
    [21.6, 5.8, 2.0],
    [25.2, 5.8, 2.64],
    [28.8, 5.8, 5.02],
    [32.4, 5.8, 8.26],
];
const UPPER: [[f64; 3]; 2] = [[0.0, 5.8, 8.25], [32.4, 5.8, 8.26]];

/// The sharpest corners of the sections within 0.4 m of a crease, where they turn by 0.15 rad at least.
fn knuckle(sections: &OffsetTable, name: &str, crease: &[[f64; 3]]) -> FeatureLine {
    let mut points = Vec::new();
    for station in &sections.stations {
        let x = station.station.x;
        let Some(pair) = crease.windows(2).find(|w| w[0][0] <= x && x < w[1][0]) else { continue };
        let t = (x - pair[0][0]) / (pair[1][0] - pair[0][0]);
        let [y, z] = [1, 2].map(|d| pair[0][d] + t * (pair[1][d] - pair[0][d]));
        let outline = &station.outlines[0];
        let turn = |k: usize| {
            let angle = |p: &OutlinePoint, q: &OutlinePoint| (q.z - p.z).atan2(q.y - p.y);
            (angle(&outline[k], &outline[k + 1]) - angle(&outline[k - 1], &outline[k])).abs()
        };
        let near = (1..outline.len() - 1).filter(|&k| (outline[k].y - y).hypot(outline[k].z - z) < 0.4);
        if let Some(k) = near.max_by(|&a, &b| turn(a).total_cmp(&turn(b))).filter(|&k| turn(k) > 0.15) {
            points.push([x, outline[k].y, outline[k].z]);
        }
    }
    FeatureLine { name: name.to_owned(), kind: LineKind::Knuckle, points }
}

/// Chines, a skeg, a raked keel and a bulb: with the knuckles the volume is that of the subdivision surface to 0.1 %,
/// without them to 0.4 %.
#[test]
fn a_stern_trawler_with_and_without_its_knuckles() {
    let (Some(points), Some(offsets)) = (published("sterntrawler/sections.csv"), published("sterntrawler/offsets.csv"))
    else {
        return;
    };
    let sections = sections(&points, [Some(0), Some(1), Some(3), Some(4)]);
    let bare = grid(&offsets, 3);
    let creases: [(&str, &[[f64; 3]]); 3] = [("skeg", &SKEG), ("side", &SIDE), ("upper", &UPPER)];
    let lines = creases.map(|(name, crease)| knuckle(&sections, name, crease)).to_vec();
    for (table, percent, metres) in [(bare.clone(), 0.4, 0.1), (OffsetTable { lines, ..bare }, 0.15, 0.04)] {
        let fitted = fit(&table).unwrap();
        assert!(greatest_residual(&fitted.cells) < 1e-9);
        for (z, volume, lcb, largest, waterplane) in
            [(5.2736, 1633.484, 21.875, 55.168, 450.395), (5.75, 1851.552, 21.567, 60.694, 464.684)]
        {
            let value = |f: Functional| f.value(&fitted.hull, z);
            let found = value(Functional::Volume);
            assert_near(found, volume, percent, "trawler, volume");
            let centre = value(Functional::LongitudinalMoment) / found;
            println!("trawler, LCB {centre:.3}, reference {lcb}");
            assert!((centre - lcb).abs() < metres, "{centre} {lcb}");
            let area =
                (0..20).map(|k| value(Functional::SectionArea { x: 16.0 + 0.5 * f64::from(k) })).fold(0.0, f64::max);
            assert_near(area, largest, 0.3, "trawler, largest section");
            assert_near(value(Functional::WaterplaneArea), waterplane, 1.0, "trawler, waterplane");
        }
    }
}

/// A barge of sections with flat bottom and flat ends: its volume by the trapezoids of its points is exact for it.
#[test]
fn a_barge_of_points() {
    let Some(text) = published("formats/samples/pias_barge.txt") else { return };
    let mut numbers = text.split_ascii_whitespace().map(|n| n.parse::<f64>().unwrap());
    let count = numbers.next().unwrap() as usize;
    let stations = (0..count)
        .map(|k| {
            let (x, points) = (numbers.next().unwrap(), numbers.next().unwrap() as usize);
            let outline = (0..points)
                .map(|_| {
                    let [y, z, _] = [numbers.next(), numbers.next(), numbers.next()].map(Option::unwrap);
                    OutlinePoint { y, z, marks: Marks::default() }
                })
                .collect();
            StationOffsets { outlines: vec![outline], ..StationOffsets::new(format!("{k}"), x) }
        })
        .collect();
    let table = OffsetTable { stations, ..OffsetTable::default() };
    let net = Net::new(&table).unwrap();
    assert_points_are_met(&net);
    let area = |p: &Profile| 2.0 * 5.0 * (p.top() - p.keel());
    let exact: f64 = net.profiles.windows(2).map(|w| 0.5 * (w[1].x - w[0].x) * (area(&w[0]) + area(&w[1]))).sum();
    assert_near(volume(&net.surface)[0], exact, 0.2, "barge, volume");
    assert!(fit(&table).is_ok());
}
