//! What the neighbours on one line predict for a cell: polynomials through, or fitted to, the nearest offsets of its run,
//! the cell itself left out. A prediction is a row of weights, sum w_k y_k.
//!
//! Weights of the least-squares polynomial of degree d at the cell: w_k = sum_p q_p(t) q_p(t_k) with polynomials q_p
//! that are orthonormal over the points, made by the recurrence q_p ~ t q_(p-1) (Vandermonde with Arnoldi: Brubeck,
//! Nakatsukasa, Trefethen 2021), exact to rounding for the up to eight points in use.

use super::grid::{Along, Grid};

/// Most points of a stencil.
pub(super) const MOST: usize = 8;

/// Which neighbours a prediction uses.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Side {
    /// As many before as after the cell, as far as the run goes.
    Both,
    Before,
    After,
}

/// A way to predict a cell from its line.
#[derive(Debug, Clone, Copy)]
pub(super) struct Predictor {
    points: usize,
    degree: usize,
    side: Side,
    /// In the square root of the height over the keel: half-breadths leave a flat of bottom like a root.
    graded: bool,
}

const fn through(points: usize, degree: usize, side: Side, graded: bool) -> Predictor {
    Predictor { points, degree, side, graded }
}

/// The predictors. Few points follow features, many average reading noise; one side is right beside a knuckle or the
/// edge of a flat.
pub(super) const PREDICTORS: [Predictor; 14] = [
    through(4, 3, Side::Both, false),
    through(6, 3, Side::Both, false),
    through(6, 5, Side::Both, false),
    through(8, 3, Side::Both, false),
    through(8, 5, Side::Both, false),
    through(2, 1, Side::Both, false),
    through(4, 3, Side::Both, true),
    through(6, 3, Side::Both, true),
    through(3, 1, Side::Before, false),
    through(3, 1, Side::After, false),
    through(4, 2, Side::Before, false),
    through(4, 2, Side::After, false),
    through(4, 3, Side::Before, false),
    through(4, 3, Side::After, false),
];

/// Weights of neighbours.
#[derive(Debug, Clone, Copy)]
pub(super) struct Stencil {
    cells: [u32; MOST],
    weights: [f64; MOST],
    count: u8,
    /// Noise of (value - prediction) over the reading noise, squared: 1 + sum w².
    pub(super) gain: f64,
}

impl Stencil {
    pub(super) fn iter(&self) -> impl Iterator<Item = (usize, f64)> + '_ {
        let count = usize::from(self.count);
        self.cells[..count].iter().map(|&cell| cell as usize).zip(self.weights[..count].iter().copied())
    }

    pub(super) fn predict(&self, values: &[f64]) -> f64 {
        self.iter().map(|(cell, weight)| weight * values[cell]).sum()
    }

    /// The weight of a cell; 0 when it is not among the neighbours.
    pub(super) fn weight(&self, cell: usize) -> f64 {
        self.iter().find(|&(other, _)| other == cell).map_or(0.0, |(_, weight)| weight)
    }
}

/// Weights at 0 of the least-squares polynomial over the points `t`.
fn weights_at_zero(t: &[f64], degree: usize, weights: &mut [f64; MOST]) -> bool {
    let n = t.len();
    let mut basis = [[0.0; MOST]; MOST];
    let mut at_zero = [0.0; MOST];
    for p in 0..=degree {
        let mut v = [0.0; MOST];
        let mut v_zero = 0.0;
        for k in 0..n {
            v[k] = if p == 0 { 1.0 } else { t[k] * basis[p - 1][k] };
        }
        if p == 0 {
            v_zero = 1.0;
        }
        let before: f64 = v[..n].iter().map(|a| a * a).sum();
        for _ in 0..2 {
            for q in 0..p {
                let h: f64 = (0..n).map(|k| v[k] * basis[q][k]).sum();
                (0..n).for_each(|k| v[k] -= h * basis[q][k]);
                v_zero -= h * at_zero[q];
            }
        }
        let norm = v[..n].iter().map(|a| a * a).sum::<f64>();
        if norm <= 1e-20 * before {
            return false;
        }
        let scale = norm.sqrt().recip();
        (0..n).for_each(|k| basis[p][k] = v[k] * scale);
        at_zero[p] = v_zero * scale;
    }
    for k in 0..n {
        weights[k] = (0..=degree).map(|p| at_zero[p] * basis[p][k]).sum();
    }
    true
}

/// The stencil of one predictor at place `at` of a run; none where the run is too short.
fn stencil(grid: &Grid, along: Along, run: &[usize], at: usize, predictor: Predictor) -> Option<Stencil> {
    let last = run.len();
    let wanted = predictor.points;
    let (from, to) = match predictor.side {
        Side::Before => (at.checked_sub(wanted)?, at),
        Side::After => (at, (at + wanted < last).then_some(at + wanted + 1)?),
        Side::Both => {
            let width = (wanted + 1).min(last);
            let from = at.saturating_sub(wanted / 2).min(last - width);
            (from, from + width)
        }
    };
    let coordinate: Box<dyn Fn(usize) -> f64> = if predictor.graded {
        if along == Along::Waterline {
            return None;
        }
        let station = grid.place(run[0]).0;
        let first = grid.coordinate(along, run[0]);
        let bottom = grid.keel[station].map_or(first, |keel| keel.min(first));
        Box::new(move |cell| (grid.coordinate(along, cell) - bottom).max(0.0).sqrt())
    } else {
        Box::new(move |cell| grid.coordinate(along, cell))
    };
    let origin = coordinate(run[at]);
    let mut cells = [0u32; MOST];
    let mut t = [0.0; MOST];
    let mut count = 0;
    for (k, &cell) in run.iter().enumerate().take(to).skip(from) {
        if k != at && count < MOST {
            cells[count] = u32::try_from(cell).ok()?;
            t[count] = coordinate(cell) - origin;
            count += 1;
        }
    }
    if count <= predictor.degree || count < wanted.min(predictor.degree + 1) {
        return None;
    }
    let reach = t[..count].iter().fold(0.0f64, |a, b| a.max(b.abs()));
    t[..count].iter_mut().for_each(|a| *a /= reach);
    let mut weights = [0.0; MOST];
    if !weights_at_zero(&t[..count], predictor.degree, &mut weights) {
        return None;
    }
    let gain = 1.0 + weights[..count].iter().map(|w| w * w).sum::<f64>();
    Some(Stencil { cells, weights, count: u8::try_from(count).ok()?, gain })
}

/// The stencils of every cell, one list of cells a predictor.
pub(super) fn stencils(grid: &Grid, along: Along) -> Vec<Vec<Option<Stencil>>> {
    let mut all = vec![vec![None; grid.len()]; PREDICTORS.len()];
    for line in 0..grid.lines(along) {
        for run in grid.runs(along, line) {
            for (at, &cell) in run.iter().enumerate() {
                for (list, &predictor) in all.iter_mut().zip(&PREDICTORS) {
                    list[cell] = stencil(grid, along, &run, at, predictor);
                }
            }
        }
    }
    all
}
