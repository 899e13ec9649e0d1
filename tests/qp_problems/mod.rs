//! Programs for tests and benches of `qp`: the fairing of a noisy Wigley hull, and random programs.

pub(crate) mod second_opinion;

use loftsman::internals::qp::{Problem, SparseRows};
use loftsman::internals::spline::{Gram, KnotVector};
use rand::{RngExt, SeedableRng, rngs::StdRng};

const LENGTH: f64 = 100.0;
const BEAM: f64 = 10.0;
const DRAUGHT: f64 = 6.25;
const NOISE: f64 = 0.010;
const TOLERANCE: f64 = 0.015;
/// Weight of the mean square deviation from the offsets.
const DATA: f64 = 1e5;

/// The fairing of `offsets` (stations x waterlines) by a bicubic net y(u, v) of `net` points: min of the thin-plate
/// energy and the deviation; bands at all offsets, y >= 0, control polygons concave along both directions; displacement
/// and LCB are equalities (rows 0 and 1).
pub(crate) fn fairing(offsets: [usize; 2], net: [usize; 2], seed: u64) -> Problem {
    fairing_of(offsets, net, &readings(offsets, seed))
}

/// Half-breadths of the hull with noise \[m\], station by station.
pub(crate) fn readings(offsets: [usize; 2], seed: u64) -> Vec<f64> {
    let mut rng = StdRng::seed_from_u64(seed);
    let mut reading = |k: usize| {
        let [u, v] = [k / offsets[1], k % offsets[1]];
        let (u, v) = (u as f64 / (offsets[0] - 1) as f64, v as f64 / (offsets[1] - 1) as f64);
        let half = 0.5 * BEAM * (1.0 - (2.0 * u - 1.0).powi(2)) * (1.0 - (v - 1.0).powi(2));
        half + rng.random_range(-NOISE..NOISE)
    };
    (0..offsets[0] * offsets[1]).map(&mut reading).collect()
}

/// The part of the objective that does not depend on the net: the weighted mean square of the readings.
#[allow(dead_code, reason = "of the bench")]
pub(crate) fn constant_part(readings: &[f64]) -> f64 {
    DATA * readings.iter().map(|y| y * y).sum::<f64>() / readings.len() as f64
}

/// [`fairing`] of given half-breadths \[m\], station by station.
pub(crate) fn fairing_of(offsets: [usize; 2], net: [usize; 2], readings: &[f64]) -> Problem {
    let knots = net.map(|count| KnotVector::uniform(3, count - 3).unwrap());
    let n = net[0] * net[1];
    let place = |i: usize, j: usize| i * net[1] + j;
    let grams = |k: &KnotVector| [0, 1, 2].map(|order| Gram::new(k, k, [order, order]));
    let (gu, gv) = (grams(&knots[0]), grams(&knots[1]));
    let mut entries = Vec::new();
    for i in 0..net[0] {
        for k in i.saturating_sub(3)..(i + 4).min(net[0]) {
            for j in 0..net[1] {
                for l in j.saturating_sub(3)..(j + 4).min(net[1]) {
                    let value = gu[2].get(i, k) * gv[0].get(j, l)
                        + 2.0 * gu[1].get(i, k) * gv[1].get(j, l)
                        + gu[0].get(i, k) * gv[2].get(j, l);
                    entries.push((place(i, j), place(k, l), 2.0 * value));
                }
            }
        }
    }
    let (mut rows, mut lower, mut upper) = (SparseRows::new(n), Vec::new(), Vec::new());
    let volume = 4.0 / 9.0 * LENGTH * BEAM * DRAUGHT * 1.0005;
    let along = [knots[0].integrals(), knots[0].moments(1, 0.0, 1.0)];
    let high = knots[1].integrals();
    let factor = 2.0 * LENGTH * DRAUGHT / volume;
    for (order, target) in [(0, 1.0), (1, 0.0)] {
        let weight = |i: usize| {
            if order == 0 { along[0][i] } else { along[1][i] - (0.5 + 0.015 / LENGTH) * along[0][i] }
        };
        rows.push((0..n).map(|index| (index, factor * weight(index / net[1]) * high[index % net[1]])));
        lower.push(target);
        upper.push(target);
    }
    let mut linear = vec![0.0; n];
    let data = 2.0 * DATA / (offsets[0] * offsets[1]) as f64;
    for a in 0..offsets[0] {
        for b in 0..offsets[1] {
            let (u, v) = (a as f64 / (offsets[0] - 1) as f64, b as f64 / (offsets[1] - 1) as f64);
            let reading = readings[a * offsets[1] + b];
            let (su, sv) = (knots[0].find_span(u), knots[1].find_span(v));
            let (nu, nv) = (knots[0].basis(su, u), knots[1].basis(sv, v));
            let row: Vec<(usize, f64)> =
                (0..16).map(|k| (place(su - 3 + k / 4, sv - 3 + k % 4), nu[k / 4] * nv[k % 4])).collect();
            for &(i, x) in &row {
                linear[i] -= data * reading * x;
                entries.extend(row.iter().map(|&(j, y)| (i, j, data * x * y)));
            }
            rows.push(row);
            lower.push(reading - TOLERANCE);
            upper.push(reading + TOLERANCE);
        }
    }
    for (direction, size) in net.into_iter().enumerate() {
        let g = knots[direction].greville();
        for i in 0..net[0] {
            for j in 0..net[1] {
                let at = [i, j][direction];
                if at == 0 || at + 1 == size {
                    continue;
                }
                let step = if direction == 0 { net[1] } else { 1 };
                let (before, after) = (1.0 / (g[at] - g[at - 1]), 1.0 / (g[at + 1] - g[at]));
                let scale = 1.0 / size as f64;
                let middle = place(i, j);
                rows.push([
                    (middle - step, scale * before),
                    (middle, -scale * (before + after)),
                    (middle + step, scale * after),
                ]);
                lower.push(f64::NEG_INFINITY);
                upper.push(0.0);
            }
        }
    }
    for index in 0..n {
        rows.push([(index, 1.0)]);
        lower.push(0.0);
        upper.push(f64::INFINITY);
    }
    let squares = SparseRows::new(n);
    Problem { quadratic: SparseRows::from_entries(n, n, &entries), linear, squares, rows, lower, upper }
}

/// What the objective of a random program is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Shape {
    Definite,
    Semidefinite,
    Linear,
}

/// A random program with a feasible point and a bounded optimum: rows of 1 to 4 entries and of different size,
/// equalities, bands, one-sided rows, rows without limits, doubled rows, bands of no width and, now and then, one dense
/// equality.
pub(crate) fn random(seed: u64, shape: Shape) -> Problem {
    let mut rng = StdRng::seed_from_u64(seed);
    let n = rng.random_range(1..30_usize);
    let mut entries = Vec::new();
    let terms = match shape {
        Shape::Definite => n + 3,
        Shape::Semidefinite => 1 + n / 2,
        Shape::Linear => 0,
    };
    for _ in 0..terms {
        let part: Vec<(usize, f64)> =
            (0..rng.random_range(1..4)).map(|_| (rng.random_range(0..n), rng.random_range(-1.0..1.0))).collect();
        for &(i, a) in &part {
            entries.extend(part.iter().map(|&(j, b)| (i, j, a * b)));
        }
    }
    if shape == Shape::Definite {
        entries.extend((0..n).map(|i| (i, i, 0.01)));
    }
    let point: Vec<f64> = (0..n).map(|_| rng.random_range(-3.0..3.0)).collect();
    let value = |row: &[(usize, f64)]| row.iter().map(|&(i, a)| a * point[i]).sum::<f64>();
    type Limited = (Vec<(usize, f64)>, f64, f64);
    let mut all: Vec<Limited> = Vec::new();
    for _ in 0..rng.random_range(0..60) {
        let mut columns: Vec<usize> = (0..rng.random_range(1..5)).map(|_| rng.random_range(0..n)).collect();
        columns.sort_unstable();
        columns.dedup();
        let size = if rng.random_bool(0.2) { 10_f64.powf(rng.random_range(-3.0..3.0)) } else { 1.0 };
        let row: Vec<_> = columns.iter().map(|&i| (i, size * rng.random_range(-1.0..1.0))).collect();
        let at = value(&row);
        let mut room = || if rng.random_bool(0.3) { 0.0 } else { size * rng.random_range(0.0..1.0) };
        let (below, above) = (room(), room());
        let (l, u) = match rng.random_range(0..5) {
            0 => (at, at),
            1 => (f64::NEG_INFINITY, at + above),
            2 => (at - below, f64::INFINITY),
            3 => (at - below, at + above),
            _ => (f64::NEG_INFINITY, f64::INFINITY),
        };
        all.push((row, l, u));
        if rng.random_bool(0.1) {
            all.push(all[rng.random_range(0..all.len())].clone());
        }
    }
    if rng.random_bool(0.5) {
        let row: Vec<_> = (0..n).map(|i| (i, rng.random_range(0.0..1.0))).collect();
        let at = value(&row);
        all.push((row, at, at));
    }
    if shape != Shape::Definite {
        for (i, &x) in point.iter().enumerate() {
            all.push((vec![(i, 1.0)], x - rng.random_range(0.0..5.0), x + rng.random_range(0.0..5.0)));
        }
    }
    let (mut rows, mut lower, mut upper) = (SparseRows::new(n), Vec::new(), Vec::new());
    for (row, l, u) in all {
        rows.push(row);
        lower.push(l);
        upper.push(u);
    }
    let linear = (0..n).map(|_| rng.random_range(-1.0..1.0)).collect();
    let squares = SparseRows::new(n);
    Problem { quadratic: SparseRows::from_entries(n, n, &entries), linear, squares, rows, lower, upper }
}
