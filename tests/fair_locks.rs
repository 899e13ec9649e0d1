//! What is locked, suspected, weighed or out of reach on a net of its own.

use loftsman::internals::fairing::bends::Line;
use loftsman::internals::fairing::constraint::{FixedLine, Rule};
use loftsman::internals::fairing::job::{Job, Tolerance};
use loftsman::internals::fairing::outcome::Outcome;
use loftsman::internals::hull::{Cell, Cut, Entry, Hull, OffsetTable, StatedParticulars};
use loftsman::internals::qp::Status;

use crate::support::{carried, sampled, table_of, weyl_noise};

/// 21 stations and 11 waterlines of a Wigley hull of 100 by 10 by 6.25 m in millimetres, with noise of this standard
/// deviation \[m\] from a sequence of its own (Weyl); keel, stem and stern stay closed.
fn wigley(noise: f64) -> OffsetTable {
    let waterlines: Vec<f64> = (0..11).map(|j| 0.625 * f64::from(j)).collect();
    let mut normal = weyl_noise();
    let half = |x: f64, z: f64| {
        let y = 5.0 * (1.0 - (x / 50.0 - 1.0).powi(2)) * (1.0 - (1.0 - z / 6.25).powi(2));
        if y > 0.0 { (y + noise * normal()).max(0.0) } else { 0.0 }
    };
    let mut table = sampled(waterlines, 21, |i| 5.0 * i, 3, half);
    table.stations.iter_mut().for_each(|station| station.keel_height = Some(0.0));
    table.endings = vec![[Some(0.0), Some(100.0)]; 11];
    table.stated = StatedParticulars {
        length_between_perpendiculars: Some(100.0),
        breadth: Some(10.0),
        draught: Some(6.25),
        depth: Some(6.25),
    };
    table
}

fn run(job: &Job, table: &OffsetTable) -> Outcome {
    let outcome = job.run(table).unwrap();
    assert_eq!(outcome.status, Status::Optimal, "{:?}", outcome.notes);
    outcome
}

fn largest(outcome: &Outcome, locked: bool) -> f64 {
    let changes = outcome.changes.iter().filter(|change| change.locked == locked);
    changes.map(|change| (change.after - change.before).abs()).fold(0.0, f64::max)
}

/// Root mean square \[m\] of the distance of a surface from the Wigley hull, in and between its offsets.
fn off_the_truth(hull: &Hull) -> f64 {
    let places = (1..100).flat_map(|i| (1..50).map(move |j| [f64::from(i), 0.125 * f64::from(j)]));
    let squares: Vec<f64> = places
        .filter_map(|[x, z]| {
            let y = 5.0 * (1.0 - (x / 50.0 - 1.0).powi(2)) * (1.0 - (1.0 - z / 6.25).powi(2));
            Some((hull.half_breadth(x, z)? - y).powi(2))
        })
        .collect();
    (squares.iter().sum::<f64>() / squares.len() as f64).sqrt()
}

/// A right station, or the deck, that does not move keeps the net of the fit; that a net of its own follows the table
/// tells all the same how much of it is errors.
#[test]
#[ignore = "takes 81 s"]
fn what_is_locked_right_leaves_the_rest_to_be_smoothed() {
    for noise in [0.002, 0.01, 0.025] {
        let mut table = wigley(noise);
        let exact = wigley(0.0);
        table.stations[10] = exact.stations[10].clone();
        (0..21).for_each(|i| table.stations[i].half_breadths[10] = exact.stations[i].half_breadths[10].clone());
        let station = Job { locked: (0..11).map(|j| (10, j)).collect(), ..Job::default() };
        let deck = Job { rules: vec![Rule::Fixed(FixedLine::Deck)], ..Job::default() };
        for job in [station, deck] {
            let outcome = run(&job, &table);
            let [before, after] = [&outcome.before, &outcome.after].map(off_the_truth);
            assert!(after < 0.8 * before, "{noise}: {before} > {after}");
        }
    }
}

/// A field passes through a whole station or waterline of locked cells.
#[test]
fn a_line_whose_cells_are_all_locked_stays() {
    let table = wigley(0.01);
    for locked in [(0..11).map(|j| (10, j)).collect::<Vec<_>>(), (0..21).map(|i| (i, 9)).collect()] {
        let count = locked.len();
        let outcome = run(&Job { locked, ..Job::default() }, &table);
        assert_eq!(outcome.changes.iter().filter(|change| change.locked).count(), count);
        assert!(outcome.is_field && largest(&outcome, true) < 1e-9, "{:e}", largest(&outcome, true));
        assert!(largest(&outcome, false) < 0.05, "{}", largest(&outcome, false));
        let [before, after] = outcome.all_inflections();
        assert!(after <= before, "{before} > {after}");
    }
}

/// 3.598 m written as 3.958 m: left out, but where somebody says that it stays.
#[test]
fn a_suspected_offset_that_is_locked_stays() {
    let mut table = wigley(0.002);
    table.stations[8].half_breadths[5] = Cell::from(Some(3.958));
    let moved = |outcome: &Outcome| {
        let here = |x: f64, z: f64| (x - 40.0).abs() < 1e-9 && (z - 3.125).abs() < 1e-9;
        let change = outcome.changes.iter().find(|change| here(change.x, change.z)).unwrap();
        ((change.after - change.before).abs(), change.suspect)
    };
    let (by, suspect) = moved(&run(&Job::default(), &table));
    assert!(suspect && by > 0.3, "{by}");
    let fixed = |line: Line| Job { rules: vec![Rule::Fixed(FixedLine::Line(line))], ..Job::default() };
    let mut marked = table.clone();
    marked.stations[8].half_breadths[5].marks.locked = true;
    let mut cases = vec![
        (Job { locked: vec![(8, 5)], ..Job::default() }, &table, 1e-12),
        (fixed(Line::Station(40.0)), &table, 1e-9),
        (fixed(Line::Waterline(3.125)), &table, 1e-9),
        (Job::default(), &marked, 1e-12),
    ];
    let cells = vec![(8, 5, 0.001)];
    let named = Tolerance { table: None, stations: Vec::new(), waterlines: Vec::new(), cells };
    cases.push((Job { tolerance: named, ..Job::default() }, &table, 0.001 + 1e-9));
    for (job, table, most) in cases {
        let outcome = run(&job, table);
        let (by, suspect) = moved(&outcome);
        assert!(!suspect && by <= most, "{by:e} of {most:e}");
        assert!(outcome.notes.iter().any(|note| note.contains("at 3.125 m is suspected, and stays")));
    }
    assert!(matches!(table.stations[8].half_breadths[5].entry, Entry::Given(_)));
}

/// Keel and stem lie on the centreplane already: who locks them asks for nothing, and has as fair a hull as before.
#[test]
fn edges_on_the_centreplane_are_locked_on_any_net() {
    let table = wigley(0.01);
    let free = run(&Job::default(), &table);
    for edge in [FixedLine::Keel, FixedLine::Stem, FixedLine::Stern] {
        let outcome = run(&Job { rules: vec![Rule::Fixed(edge)], ..Job::default() }, &table);
        assert!(outcome.is_field && outcome.rules[0].violation < 1e-12);
        assert_eq!(outcome.all_inflections()[1], free.all_inflections()[1]);
        let net = outcome.after.surface();
        let [rows, columns] = net.shape();
        let edge = (0..columns).chain((rows - 1) * columns..rows * columns).chain((0..rows).map(|i| i * columns));
        assert!(edge.map(|i| net.points()[i][1].abs()).fold(0.0, f64::max) < 1e-12);
    }
}

/// What the offsets are off by does not depend on how smooth somebody wants the hull.
#[test]
fn the_noise_is_that_of_the_table_at_any_weight() {
    let table = wigley(0.01);
    let free = run(&Job { weight: Some(1e4), ..Job::default() }, &table);
    for weight in [1e2, 1e6] {
        let outcome = run(&Job { weight: Some(weight), ..Job::default() }, &table);
        let ratio = outcome.faired.sigma / free.faired.sigma;
        assert!((0.9..1.1).contains(&ratio), "{ratio} at {weight:e}");
        assert_eq!(outcome.all_inflections()[0], free.all_inflections()[0]);
    }
}

/// Every waterline of hulls with flats of side and offsets at B/2, between which the surface through the table swings
/// past it: so does every other through them, and the rest is faired all the same.
#[test]
#[ignore = "takes 80 s"]
fn any_waterline_may_be_locked() {
    for name in ["series60_cb060", "s175", "pdstrip_yacht"] {
        waterlines_may_be_locked(name, 0..usize::MAX);
    }
}

#[test]
fn the_waterlines_of_a_yacht_may_be_locked() {
    waterlines_may_be_locked("pdstrip_yacht", 2..5);
}

fn waterlines_may_be_locked(name: &str, which: std::ops::Range<usize>) {
    let table = table_of(carried("tests/data").join(name).join("offsets.csv"));
    let mut sums = [0; 2];
    for waterline in which.start..which.end.min(table.waterlines.len()) {
        let given = |i: &usize| table.stations[*i].half_breadths[waterline].value().is_some();
        let locked: Vec<(usize, usize)> = (0..table.stations.len()).filter(given).map(|i| (i, waterline)).collect();
        let outcome = run(&Job { locked, ..Job::default() }, &table);
        let [stay, move_most] = [true, false].map(|locked| largest(&outcome, locked));
        assert!(stay < 1e-9 && move_most > 1e-3, "{name} {waterline}: {stay} {move_most}");
        let [before, after] = outcome.all_inflections();
        // A lowest waterline whose errors stay has them in the sections that cross it.
        assert!(after <= before + 2, "{name} {waterline}: {before} > {after}");
        sums = [sums[0] + before, sums[1] + after];
        // The locked line has what its offsets have.
        let own = |cut: Cut| matches!(cut, Cut::Waterline { z } if (z - table.waterlines[waterline]).abs() < 1e-9);
        let worse = outcome.turns.iter().filter(|turns| turns.after > turns.before && !own(turns.cut));
        let worse: Vec<_> = worse.collect();
        assert!(worse.iter().all(|turns| turns.after <= turns.before + 2), "{worse:?}");
    }
    assert!(sums[1] < sums[0], "{name}: {sums:?}");
}
