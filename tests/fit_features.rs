//! What tables say besides half-breadths: transom plane, flat of side, tangent lines, level knuckles, heights at
//! buttocks, camber.

use loftsman::internals::hull::{
    Cell, Chart, FeatureLine, FitMethod, Fitted, Functional, Hull, LineKind, OffsetTable, StationOffsets, TransomPlane,
};
use proptest::prelude::*;

/// A table of y(x, z), blank where it is none.
fn table(stations: &[f64], waterlines: &[f64], y: impl Fn(f64, f64) -> Option<f64>) -> OffsetTable {
    let mut table = OffsetTable { name: "formula".to_owned(), ..OffsetTable::default() };
    table.waterlines = waterlines.to_vec();
    table.endings = vec![[None; 2]; waterlines.len()];
    for &x in stations {
        let mut station = StationOffsets::new(format!("{x}"), x);
        station.half_breadths = waterlines.iter().map(|&z| Cell::from(y(x, z))).collect();
        table.stations.push(station);
    }
    table
}

fn fit(table: &OffsetTable) -> Fitted {
    let fitted = Hull::fit(table, &FitMethod::Graded).unwrap();
    let missed = fitted.cells.iter().filter_map(|c| c.residual).fold(0.0f64, |m, r| m.max(r.abs()));
    let given = table.stations.iter().flat_map(|s| &s.half_breadths).filter(|c| c.value().is_some_and(|y| y > 0.0));
    let met = fitted.cells.iter().filter(|c| c.residual.is_some()).count();
    assert!(missed < 1e-9, "{missed}");
    assert!(met >= given.count(), "cells that the surface does not reach");
    fitted
}

fn says(fitted: &Fitted, words: &str) {
    assert!(fitted.notes.iter().any(|note| note.contains(words)), "{words}: {:?}", fitted.notes);
}

fn steps(from: f64, to: f64, count: usize) -> Vec<f64> {
    (0..=count).map(|k| from + (to - from) * k as f64 / count as f64).collect()
}

/// The stern profile lies in the plane above the height `foot` \[m\].
fn transom_is_plane(hull: &Hull, plane: TransomPlane, foot: f64) {
    for k in 0..=400 {
        let [x, y, z] = hull.surface().eval(0.0, f64::from(k) / 400.0);
        if z >= foot {
            assert!((x - plane.x_base - plane.slope * z).abs() < 1e-9, "{x} {z}");
            assert!(y > 0.0);
        }
    }
}

/// A box of half-breadth 5 from a raked transom to x = 60: volume 10 int (60 - x_base - slope z) dz.
#[test]
fn a_box_ends_on_its_raked_transom() {
    for (x_base, slope) in [(-1.0, -0.25), (-1.0, 0.0), (-1.0, 0.25), (0.0, -0.5)] {
        let plane = TransomPlane { x_base, slope };
        let inside = |x: f64, z: f64| (x >= x_base + slope * z).then_some(5.0);
        let mut table = table(&steps(0.0, 60.0, 6), &steps(0.0, 8.0, 4), inside);
        table.transom = Some(plane);
        let fitted = fit(&table);
        transom_is_plane(&fitted.hull, plane, 0.0);
        for draught in [3.0, 8.0] {
            let exact = 10.0 * ((60.0 - x_base) * draught - 0.5 * slope * draught * draught);
            let found = Functional::Volume.value(&fitted.hull, draught);
            assert!((found / exact - 1.0).abs() < 1e-9, "{slope} {draught}: {found} {exact}");
        }
        says(&fitted, "plane of the transom");
    }
}

/// A run that rises to a raked transom: y = 6 (1 - (1 - t)^2) c(x) with t the share of the height above the keel line
/// z_k(x).
fn run(x: f64, z: f64) -> Option<f64> {
    let keel = if x < 14.0 { 4.5 * (1.0 - x / 14.0).powi(2) } else { 0.0 };
    let t = (z - keel) / (8.0 - keel);
    let along = if x > 40.0 { 1.0 - ((x - 40.0) / 20.0).powi(2) } else { 1.0 };
    (t >= 0.0).then(|| 6.0 * (1.0 - (1.0 - t).powi(2)) * along)
}

#[test]
fn a_run_is_cut_by_its_transom() {
    let plane = TransomPlane { x_base: 1.0, slope: -0.3 };
    let stations: Vec<f64> = steps(0.0, 9.0, 9).into_iter().chain(steps(10.0, 60.0, 25)).collect();
    let lines = steps(0.0, 8.0, 16);
    let mut table = table(&stations, &lines, |x, z| run(x, z).filter(|_| x >= plane.x_base + plane.slope * z));
    for station in &mut table.stations {
        let x = station.station.x;
        station.keel_height = Some(if x < 14.0 { 4.5 * (1.0 - x / 14.0).powi(2) } else { 0.0 });
    }
    let without = fit(&table);
    table.transom = Some(plane);
    let fitted = fit(&table);
    says(&fitted, "the foot of the transom lies between the waterlines at z = ");
    // The plane meets the keel line near x = -0.4, z = 4.7; the waterlines from 5 m on end on it.
    transom_is_plane(&fitted.hull, plane, 5.0);
    // Beside the surface between its lines, aft of the first three stations.
    let (mut worst, mut bend) = (0.0f64, 0.0f64);
    for &x in &[0.7, 1.5, 4.0, 7.0] {
        for k in 0..60 {
            let z = 5.05 + 0.049 * f64::from(k);
            if let (Some(found), Some(exact)) = (fitted.hull.half_breadth(x, z), run(x, z)) {
                worst = worst.max((found - exact).abs());
            }
        }
        // The section has no knuckle where the transom begins.
        let slope = |z: f64| {
            fitted
                .hull
                .half_breadth(x, z + 1e-4)
                .zip(fitted.hull.half_breadth(x, z - 1e-4))
                .map(|(a, b)| (a - b) / 2e-4)
        };
        if let (Some(below), Some(above)) = (slope(5.0 - 1e-3), slope(5.0 + 1e-3)) {
            bend = bend.max((above - below).abs());
        }
    }
    println!("off by {worst:.1e} m, slope jumps by {bend:.1e}");
    let cell = 0.01;
    let mut exact = 0.0;
    for i in 0..6300 {
        for j in 0..800 {
            let (x, z) = (-2.0 + cell * (f64::from(i) + 0.5), cell * (f64::from(j) + 0.5));
            if x >= plane.x_base + plane.slope * z && x < 60.0 && x > -20.0 {
                exact += 2.0 * cell * cell * run(x, z).unwrap_or(0.0).max(0.0);
            }
        }
    }
    let error = |f: &Fitted| (Functional::Volume.value(&f.hull, 8.0) / exact - 1.0).abs();
    println!("volume off by {:.2e}, without the plane {:.2e}", error(&fitted), error(&without));
    assert!(error(&fitted) < 2e-3 && error(&fitted) < error(&without), "{} {}", error(&fitted), error(&without));
    assert!(worst < 0.05, "{worst}");
    assert!(bend < 0.05, "{bend}");
}

/// Half-breadth 6 above the edge z_f(x): 3 m from x = 30 to 90, rising to the deck at x = 10 and 110; below it 6 - (z_f
/// - z)^2 / 4.
fn edge(x: f64) -> f64 {
    3.0 + 5.0 * ((30.0 - x).max(x - 90.0).max(0.0) / 20.0).powi(2)
}

fn sided(x: f64, z: f64) -> f64 {
    let under = (edge(x) - z).max(0.0);
    (6.0 - 0.25 * under * under).max(0.0)
}

#[test]
fn the_flat_of_side_is_flat() {
    let stations = steps(0.0, 120.0, 12);
    for lines in [steps(0.0, 8.0, 8), vec![0.0, 0.5, 1.0, 2.0, 2.6, 3.4, 4.0, 5.0, 6.0, 7.0, 8.0]] {
        let mut table = table(&stations, &lines, |x, z| Some(sided(x, z)));
        for station in &mut table.stations {
            let z = edge(station.station.x);
            station.flat_of_side = (z <= 8.0).then_some(z);
        }
        let fitted = fit(&table);
        assert_eq!(fitted.chart, Chart::Level);
        for i in 0..=120 {
            let x = f64::from(i);
            // From the edge itself where it is level for two spaces on both sides, else from the waterline above it at
            // the stations on both sides.
            let beside = edge(10.0 * (x / 10.0).floor()).max(edge(10.0 * (x / 10.0).ceil()));
            let next = lines.iter().copied().find(|&z| z >= beside).unwrap_or(9.0);
            let from = if (50.0..=70.0).contains(&x) { 3.0 } else { next };
            for k in 0..=50 {
                let z = 8.0 - 0.1 * f64::from(k);
                if z >= from && (10.0..=110.0).contains(&x) {
                    let y = fitted.hull.half_breadth(x, z).unwrap();
                    assert!((y - 6.0).abs() < 1e-9, "{x} {z} {y}");
                }
            }
        }
        // The tangent line: below it the side leaves with slope 0.
        for x in [45.0, 60.0, 72.0] {
            let y = |z: f64| fitted.hull.half_breadth(x, z).unwrap();
            assert!((y(3.0 - 1e-3) - 6.0).abs() < 2e-5, "{}", y(3.0 - 1e-3) - 6.0);
            assert!((y(2.75) - sided(x, 2.75)).abs() < 0.02, "{}", y(2.75) - sided(x, 2.75));
            assert!(y(2.5) < 6.0 - 0.03);
        }
    }
}

#[test]
fn a_marked_flat_is_one_too_and_contradictions_are_told() {
    let lines = steps(0.0, 8.0, 8);
    let mut marked = table(&steps(30.0, 90.0, 6), &lines, |x, z| Some(sided(x, z)));
    for station in &mut marked.stations {
        station.half_breadths[3].marks.tangent = true;
    }
    let fitted = fit(&marked);
    for k in 0..=100 {
        let y = fitted.hull.half_breadth(30.0 + 0.6 * f64::from(k), 3.0 + 0.05 * f64::from(k)).unwrap();
        assert!((y - 6.0).abs() < 1e-9, "{y}");
    }
    marked.stations[2].flat_of_side = Some(1.0);
    says(&fit(&marked), "offsets of stations 50 above its lower edge are not 6.000 m");
}

/// y = 2 + z^2/8 up to 4 m, then straight on with its slope: the curvature jumps on the waterline at 4 m.
#[test]
fn curvature_jumps_on_a_tangent_line() {
    let y = |z: f64| if z < 4.0 { 2.0 + z * z / 8.0 } else { z };
    let mut table = table(&steps(0.0, 50.0, 5), &steps(0.0, 8.0, 8), |_, z| Some(y(z)));
    let smooth = fit(&table);
    let line = FeatureLine {
        name: "bilge".to_owned(),
        kind: LineKind::Tangent,
        points: vec![[0.0, 4.0, 4.0], [50.0, 4.0, 4.0]],
    };
    table.lines.push(line.clone());
    let fitted = fit(&table);
    let off = |f: &Fitted| {
        let at = |k: usize| 4.0 + 0.02 * k as f64;
        (0..=200).map(|k| (f.hull.half_breadth(21.0, at(k)).unwrap() - y(at(k))).abs()).fold(0.0, f64::max)
    };
    println!("straight to {:.1e} m, without the line to {:.1e} m", off(&fitted), off(&smooth));
    assert!(off(&fitted) < 1e-9 && off(&smooth) > 1e-4);
    table.lines[0].points[1][2] = 5.0;
    says(&fit(&table), "tangent line bilge is neither level nor the edge of the flat of side");
}

/// A chine along the waterline at 4 m: y = 3 z / 2 below, 6 + (z - 4) / 4 above; volume by triangles.
#[test]
fn a_level_knuckle_stays_on_the_level_chart() {
    let y = |z: f64| if z < 4.0 { 1.5 * z } else { 6.0 + 0.25 * (z - 4.0) };
    let (stations, lines) = (steps(0.0, 50.0, 5), steps(0.0, 8.0, 4));
    let mut by_line = table(&stations, &lines, |_, z| Some(y(z)));
    let mut by_marks = by_line.clone();
    by_line.lines.push(FeatureLine {
        name: "chine".to_owned(),
        kind: LineKind::Knuckle,
        points: vec![[0.0, 6.0, 4.0], [50.0, 6.0, 4.0]],
    });
    by_marks.stations.iter_mut().for_each(|s| s.half_breadths[2].marks.knuckle = true);
    for table in [by_line.clone(), by_marks] {
        let fitted = fit(&table);
        assert_eq!(fitted.chart, Chart::Level);
        let volume = Functional::Volume.value(&fitted.hull, 8.0);
        assert!((volume / (2.0 * 50.0 * (12.0 + 26.0)) - 1.0).abs() < 1e-9, "{volume}");
        for k in 0..80 {
            let z = 0.05 + 0.1 * f64::from(k);
            assert!((fitted.hull.half_breadth(33.0, z).unwrap() - y(z)).abs() < 1e-9, "{z}");
        }
    }
    // One that rises is a line of the upright chart.
    by_line.lines[0].points[1] = [50.0, 6.25, 5.0];
    assert_eq!(Hull::fit(&by_line, &FitMethod::Graded).unwrap().chart, Chart::Upright);
}

/// y = 8 (1 - s^4) (1 - (1 - z/10)^4), s from -1 to 1 over 100 m.
/// A flat bottom that flat panels leave at a corner, up to a knuckle at 2 m and from there on: between the offsets the
/// sections are the panels to 1.5 mm of 8 m, the error of a fourth power between stations. A bilge there would leave
/// them by 97 mm.
#[test]
fn panels_leave_a_flat_bottom_at_a_corner() {
    let panels = |z: f64| if z <= 2.0 { 0.6 + 0.15 * z } else { 0.9 + 0.025 * (z - 2.0) };
    let y = |x: f64, z: f64| 8.0 * (1.0 - ((x - 50.0) / 50.0).powi(4)) * panels(z);
    let stations = steps(0.0, 100.0, 20);
    let mut table = table(&stations, &[0.0, 0.5, 1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0], |x, z| Some(y(x, z)));
    let points = stations.iter().map(|&x| [x, y(x, 2.0), 2.0]).collect();
    table.lines.push(FeatureLine { name: "chine".to_owned(), kind: LineKind::Knuckle, points });
    let fitted = fit(&table);
    let mut most = 0.0_f64;
    for k in 0..=60 {
        // Off the ends, where nothing tells how the waterlines bend.
        for x in steps(20.0, 80.0, 48) {
            let z = 0.1 * f64::from(k);
            most = most.max((fitted.hull.half_breadth(x, z).unwrap() - y(x, z)).abs());
        }
    }
    assert!(most < 1.5e-3, "{most}");
}

#[test]
fn heights_at_buttocks_are_met() {
    let half = |x: f64| 8.0 * (1.0 - ((x - 50.0) / 50.0).powi(4));
    let mut table = table(&steps(0.0, 100.0, 16), &[0.0, 1.0, 4.0, 7.0, 10.0], |x, z| {
        Some(half(x) * (1.0 - (1.0 - z / 10.0).powi(4)))
    });
    let without = fit(&table);
    table.buttocks = vec![0.0, 1.5, 3.0, 4.5, 5.5, 6.5, 7.25];
    for station in &mut table.stations {
        let widest = half(station.station.x);
        let height = |b: f64| (b < 0.98 * widest).then(|| 10.0 * (1.0 - (1.0 - b / widest).powf(0.25)));
        station.heights = table.buttocks.iter().map(|&b| Cell::from(height(b))).collect();
    }
    let fitted = fit(&table);
    says(&fitted, "heights at buttocks; the surface");
    let mut count = 0;
    for station in &table.stations {
        for (cell, &b) in station.heights.iter().zip(&table.buttocks) {
            if let Some(z) = cell.value().filter(|_| b > 0.0) {
                let y = fitted.hull.half_breadth(station.station.x, z).unwrap();
                assert!((y - b).abs() < 1e-9, "{} {b}: {y}", station.station.x);
                count += 1;
            }
        }
    }
    assert!(count > 60, "{count}");
    // The sections between the waterlines.
    let off = |f: &Fitted| {
        let at = |x: f64, z: f64| f.hull.half_breadth(x, z).unwrap() - half(x) * (1.0 - (1.0 - z / 10.0).powi(4));
        let places = table.stations[4..13].iter().flat_map(|s| (1..45).map(|k| (s.station.x, 0.1 * f64::from(k))));
        places.map(|(x, z)| at(x, z).abs()).fold(0.0, f64::max)
    };
    println!("{count} heights: sections to {:.1e} m, without them to {:.1e} m", off(&fitted), off(&without));
    assert!(off(&fitted) < 0.5 * off(&without));
    // A height that contradicts the offsets beside it is not followed.
    table.stations[8].heights[3] = Cell::from(Some(9.0));
    says(&fit(&table), "contradict the offsets on waterlines");
}

#[test]
fn camber_is_told_and_an_upright_chart_tells_its_transom() {
    let mut table = table(&steps(0.0, 50.0, 5), &steps(0.0, 8.0, 4), |_, z| Some(2.0 + z / 4.0));
    table.stations.iter_mut().for_each(|s| (s.deck_height, s.deck_centre_height) = (Some(8.0), Some(8.3)));
    says(&fit(&table), "camber is no part of it");
    table.transom = Some(TransomPlane { x_base: -1.0, slope: -0.2 });
    table.stations.iter_mut().enumerate().for_each(|(k, s)| s.keel_height = Some(-0.4 * k as f64));
    let fitted = Hull::fit(&table, &FitMethod::Graded).unwrap();
    assert_eq!(fitted.chart, Chart::Upright);
    says(&fitted, "is not held by a chart of upright stations");
}

/// On the upright chart the flat of side is a line of the net, exact at the stations.
#[test]
fn a_rockered_keel_keeps_its_flat_of_side() {
    let keel = |x: f64| -4.0 * (1.0 - ((x - 60.0) / 35.0).powi(2));
    let mut table = table(&steps(30.0, 90.0, 12), &steps(0.0, 8.0, 8), |x, z| Some(sided(x, z)));
    for station in &mut table.stations {
        station.keel_height = Some(keel(station.station.x));
        station.flat_of_side = Some(2.9);
    }
    let fitted = fit(&table);
    assert_eq!(fitted.chart, Chart::Upright);
    for station in &table.stations {
        for k in 0..=50 {
            let y = fitted.hull.half_breadth(station.station.x, 2.9 + 0.1 * f64::from(k)).unwrap();
            assert!((y - 6.0).abs() < 1e-9, "{} {y}", station.station.x);
        }
    }
}

/// The flat has the breadth of most of its offsets, not that of the one that is wrong.
#[test]
fn one_wrong_offset_does_not_move_the_flat() {
    let mut table = table(&steps(30.0, 90.0, 6), &steps(0.0, 8.0, 8), |x, z| Some(sided(x, z)));
    table.stations.iter_mut().for_each(|s| s.flat_of_side = Some(3.0));
    table.stations[5].half_breadths[6] = Cell::from(Some(6.3));
    let fitted = fit(&table);
    says(&fitted, "offsets of stations 80 above its lower edge are not 6.000 m");
    let y = fitted.hull.half_breadth(44.0, 6.4).unwrap();
    assert!((y - 6.0).abs() < 1e-9, "{y}");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]
    /// Whatever else a table says: a hull that meets its offsets, or an error, never a panic.
    #[test]
    fn random_features(
        y in prop::collection::vec(prop::option::weighted(0.9, prop_oneof![Just(4.0), 0.0f64..5.0]), 56),
        flats in prop::collection::vec(prop::option::weighted(0.6, -1.0f64..7.0), 8),
        heights in prop::collection::vec(prop::option::weighted(0.3, -1.0f64..7.0), 24),
        transom in prop::option::of((-10.0f64..20.0, -2.0f64..2.0)),
        line in prop::option::of((0usize..7, prop::bool::ANY, -5.0f64..40.0, 0.0f64..60.0)),
        marks in prop::collection::vec(0u8..12, 56),
    ) {
        let mut table = table(&steps(0.0, 49.0, 7), &steps(0.0, 6.0, 6), |_, _| None);
        table.buttocks = vec![0.0, 1.5, 3.0];
        for (i, station) in table.stations.iter_mut().enumerate() {
            for (j, cell) in station.half_breadths.iter_mut().enumerate() {
                *cell = Cell::from(y[7 * i + j]);
                cell.marks.tangent = marks[7 * i + j] == 1;
                cell.marks.doubtful = marks[7 * i + j] == 2;
            }
            station.flat_of_side = flats[i];
            station.heights = (0..3).map(|j| Cell::from(heights[3 * i + j])).collect();
        }
        table.transom = transom.map(|(x_base, slope)| TransomPlane { x_base, slope });
        if let Some((j, knuckle, from, length)) = line {
            let kind = if knuckle { LineKind::Knuckle } else { LineKind::Tangent };
            let points = vec![[from, 4.0, j as f64], [from + length, 4.0, j as f64]];
            table.lines.push(FeatureLine { name: "line".to_owned(), kind, points });
        }
        if let Ok(fitted) = Hull::fit(&table, &FitMethod::Graded) {
            let upright = fitted.chart == Chart::Upright;
            for cell in &fitted.cells {
                prop_assert!(cell.half_breadth.is_finite());
                let doubtful = table.stations[cell.station].half_breadths[cell.waterline].marks.doubtful;
                prop_assert!(upright || doubtful || cell.residual.is_none_or(|r| r.abs() < 1e-8), "{cell:?}");
            }
        }
    }
}

#[test]
fn what_is_plumb_stays_plumb_and_what_is_closed_stays_closed() {
    // A stem that rakes below the second waterline and is plumb above it, with breadth; a keel without breadth that
    // opens over a bulb.
    let keel = [0.0, 0.15, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.13, 0.15, 0.0];
    let lines = [0.0, 0.5, 1.0, 2.0, 3.0, 4.0, 6.0, 8.0];
    let stations = steps(0.0, 120.0, 12);
    let mut table = table(&stations, &lines, |x, z| {
        let s = x / 60.0 - 1.0;
        Some(if z > 0.0 { 0.6 + 9.0 * (1.0 - s.powi(4)) * (1.0 - (1.0 - z / 8.0).powi(2)) } else { 0.0 })
    });
    for (station, y) in table.stations.iter_mut().zip(keel) {
        station.half_breadths[0] = Cell::from(Some(y));
    }
    let last = table.stations.len() - 1;
    table.stations[last].half_breadths[0] = Cell::from(None);
    let hull = fit(&table).hull;
    // The station at the stem is one section from the second waterline up, as wide as the table has it.
    for k in 0..=75 {
        let z = 0.5 + 0.1 * f64::from(k);
        assert!(hull.half_breadth(120.0, z).is_some_and(|y| (0.59..=9.7).contains(&y)), "z = {z}");
        assert!(hull.half_breadth(120.0 + 1e-9, z).is_none(), "z = {z}");
    }
    let lowest = (0..=2400).filter_map(|k| hull.half_breadth(0.05 * f64::from(k), 0.0)).fold(f64::INFINITY, f64::min);
    println!("keel down to {lowest:.1e} m");
    assert!(lowest > -1e-12, "{lowest}");
    for (x, y) in stations.iter().zip(keel).take(11) {
        assert!(hull.half_breadth(*x, 0.0).is_some_and(|found| (found - y).abs() < 1e-9), "{x}");
    }
}
