//! Sections that are given as points.

use loftsman::internals::exchange::read_table;
use loftsman::internals::fairing::job::Job;
use loftsman::internals::hull::{Hull, Marks, OffsetTable, OutlinePoint, StationOffsets};
use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};

use crate::support::{carried, half_breadth_of_form, normal, random_form, table_of};

/// Stations of a table.
const STATIONS: i32 = 17;

/// A hull of random form on a level keel, closed at both ends.
struct Truth {
    length: f64,
    breadth: f64,
    depth: f64,
    /// Exponents of the waterlines and of the sections.
    powers: [f64; 3],
}

impl Truth {
    fn new(random: &mut StdRng) -> Self {
        let length = random.random_range(10.0..150.0);
        let breadth = length * random.random_range(0.13..0.3);
        Self { length, breadth, depth: breadth * random.random_range(0.4..0.7), powers: random_form(random) }
    }

    fn half_breadth(&self, x: f64, z: f64) -> f64 {
        let below = (1.0 - z / self.depth).max(0.0);
        0.5 * self.breadth * half_breadth_of_form(self.powers, x / self.length, below)
    }

    fn station(&self, i: f64) -> f64 {
        self.length * (0.02 + 0.96 * i / f64::from(STATIONS - 1))
    }

    /// Points of every section at heights of its own, with errors of this standard deviation \[m\].
    fn table(&self, noise: f64, random: &mut StdRng) -> OffsetTable {
        let section = |random: &mut StdRng, x: f64| {
            let count = random.random_range(9..15);
            let point = |j: i32| {
                let shift = if j == 0 || j == count { 0.0 } else { random.random_range(-0.3..0.3) };
                let z = self.depth * ((f64::from(j) + shift) / f64::from(count)).powf(1.5);
                let error = if j == 0 { 0.0 } else { noise * normal(random) };
                OutlinePoint { y: (self.half_breadth(x, z) + error).max(0.0), z, marks: Marks::default() }
            };
            (0..=count).map(point).collect::<Vec<_>>()
        };
        let stations = (0..STATIONS).map(|i| {
            let x = self.station(f64::from(i));
            StationOffsets { outlines: vec![section(random, x)], ..StationOffsets::new(format!("{i}"), x) }
        });
        OffsetTable { stations: stations.collect(), ..OffsetTable::default() }
    }

    /// How far a hull is off on sections between those of the table, normal to the hull, in the mean \[m\].
    fn off(&self, hull: &Hull) -> f64 {
        let places = (1..STATIONS - 2).flat_map(|i| (2..19).map(move |k| (f64::from(i) + 0.5, 0.05 * f64::from(k))));
        let square = |(i, part): (f64, f64)| {
            let (x, z) = (self.station(i), part * self.depth);
            let step = 1e-3 * self.depth;
            let slope = (self.half_breadth(x, z + step) - self.half_breadth(x, z - step)) / (2.0 * step);
            let off = hull.half_breadth(x, z)? - self.half_breadth(x, z);
            Some(off * off / (1.0 + slope * slope))
        };
        let squares: Vec<f64> = places.filter_map(square).collect();
        (squares.iter().sum::<f64>() / squares.len() as f64).sqrt()
    }
}

/// The fair hull is at most three fifths as far from the truth as the surface through the points, which goes from section to section
/// by girth, and less far than the errors of the points; it has fewer changes of sign and pieces.
#[test]
fn sections_as_points_come_nearer_to_their_truth() {
    let mut worse = Vec::new();
    for seed in 0..8 {
        let random = &mut StdRng::seed_from_u64(seed);
        let truth = Truth::new(random);
        for noise in [0.0, 2.5e-4 * truth.breadth] {
            let outcome = Job::default().run(&truth.table(noise, random)).unwrap();
            let [before, after] = [&outcome.before, &outcome.after].map(|hull| truth.off(hull));
            let [signs, pieces] = [outcome.changes_of_sign(), outcome.monotone_pieces()];
            let is_near = after < 0.6 * before && (noise <= 0.0 || after < noise);
            if !outcome.is_field || !is_near || signs[1] > signs[0] || pieces[1] >= pieces[0] {
                worse.push(format!("{seed} {noise}: {before} > {after} {signs:?} {pieces:?} {}", outcome.is_field));
            }
        }
    }
    assert!(worse.is_empty(), "{}", worse.join("\n"));
}

/// A keel above the base is where a section ends, and no half-breadth that the field has to have: S-175 with the sections of
/// its counter, and a yacht with rocker.
#[test]
fn keels_of_sections_are_no_half_breadths() {
    for name in ["s175", "pdstrip_yacht"] {
        let outcome = Job::default().run(&table_of(carried(format!("tests/data/{name}/sections.csv")))).unwrap();
        let [before, after] = outcome.changes_of_sign();
        assert!(outcome.is_field && after <= before * 6 / 10, "{name}: {before} > {after}");
        let is_named = outcome.notes.iter().any(|note| note.contains("off the fair hull: at station 0.5"));
        assert_eq!(is_named, name == "s175", "{name}: {:?}", outcome.notes);
    }
}

/// A locked point stays to rounding, and moves the points beside it.
#[test]
fn locked_points_stay() {
    let random = &mut StdRng::seed_from_u64(3);
    let truth = Truth::new(random);
    let noise = 2.5e-4 * truth.breadth;
    let mut table = truth.table(noise, random);
    table.stations[8].outlines[0][5].y += 4.0 * noise;
    table.stations[8].outlines[0][5].marks.locked = true;
    let outcome = Job::default().run(&table).unwrap();
    let locked: Vec<_> = outcome.changes.iter().filter(|change| change.locked).collect();
    assert_eq!(locked.len(), 1);
    assert!((locked[0].after - locked[0].before).abs() < 1e-9, "{:?}", locked[0]);
}

/// A skeg under level bottoms, and no knuckle is declared: parts of its lines that nobody sees are straight to rounding.
#[test]
fn a_skeg_under_a_level_bottom_is_faired() {
    let sections = [
        [0.2, 1.4, 1.4, 1.6],
        [0.3, 1.2, 1.5, 1.8],
        [0.45, 1.0, 1.6, 2.0],
        [0.6, 0.95, 1.65, 2.05],
        [0.75, 1.0, 1.5, 1.9],
        [0.9, 1.15, 1.0, 1.4],
        [1.1, 1.4, 0.4, 0.7],
    ];
    let mut text = "# units = ft\nstation,x,curve,z,y,flag\n".to_owned();
    for (k, [keel, bottom, chine, sheer]) in sections.into_iter().enumerate() {
        for [z, y] in [[keel, 0.0], [keel, 0.04], [bottom, 0.04], [bottom, chine], [2.3, sheer]] {
            text += &format!("{k},{},SEC,{z},{y},\n", 2 * k);
        }
    }
    let table = read_table("skeg.csv", text.as_bytes()).unwrap().table;
    let outcome = Job::default().run(&table).unwrap();
    let furthest = outcome.changes.iter().map(|change| (change.after - change.before).abs()).fold(0.0, f64::max);
    assert!(furthest < 1e-3, "{furthest}");
}
