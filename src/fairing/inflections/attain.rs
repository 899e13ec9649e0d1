//! The linear programs: the least factor on the tolerances with which a pattern of bends is possible.
//!
//! ```text
//! minimise tau   subject to   |a_k c - d_k| <= tau delta_k,   s_i r_i c >= 0
//! ```
//!
//! Values are divided by their size and tolerances by the largest one. The answer of the solver is not believed: the
//! factor is that of the coefficients as they came, bends that fall short of their sign by less than a dead band
//! ([`dead_band`]) count as flat, and an exclusion is what the multipliers prove.

use super::bands::{Bands, Bend};
use super::space::Space;
use crate::qp::{LeastFactor, Problem, Settings, Status};

/// A coefficient of y'' below this part of the largest one is flat, and one whose sag over the whole length is below
/// this part of the size of the values.
const DEAD_BAND: f64 = 1e-7;

/// The y'' below which a curve is flat.
pub(super) fn dead_band(bands: &Bands, bends: &[f64]) -> f64 {
    let largest = bends.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
    let x = bands.sites();
    let length = x[x.len() - 1] - x[0];
    DEAD_BAND * largest.max(8.0 * bands.size() / (length * length))
}

/// Signs of the second differences of every stretch.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Pattern {
    /// The bend at the beginning of each stretch: whether it is hollow.
    pub(super) hollow: Vec<bool>,
    /// For each stretch the differences (counted along the whole curve) before which the bend changes.
    pub(super) changes: Vec<Vec<usize>>,
}

impl Pattern {
    /// The bend wanted of every difference.
    pub(super) fn bends(&self, space: &Space) -> Vec<Bend> {
        let mut result = Vec::with_capacity(space.places.len());
        for (stretch, changes) in self.changes.iter().enumerate() {
            let first = if self.hollow[stretch] { Bend::Hollow } else { Bend::Full };
            for i in space.starts[stretch]..space.starts[stretch + 1] {
                result.push(first.after(changes.iter().filter(|&&change| change <= i).count()));
            }
        }
        result
    }
}

/// What a program comes to.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Tried {
    /// The factor of the coefficients; infinite when there are none.
    pub(super) factor: f64,
    /// A factor that no curve of the space falls below, proved by the multipliers.
    pub(super) at_least: f64,
    /// The coefficients.
    pub(super) coefficients: Vec<f64>,
}

/// Points that are held are met to this part of the size of the values, which the solver can.
const HELD: f64 = 1e-9;

/// Solves for one pattern.
pub(super) fn least_factor(bands: &Bands, space: &Space, pattern: &Pattern) -> Tried {
    let d = bands.values();
    let n = space.values.column_count();
    let size = bands.size();
    let widest = bands.tolerances().iter().fold(0.0_f64, |most, &value| most.max(value));
    // Where every point is held, how far it is missed says how far off a pattern is.
    let unit = if widest > 0.0 { widest } else { HELD * size };
    let delta: Vec<f64> =
        bands.tolerances().iter().map(|&tolerance| if widest > 0.0 { tolerance } else { unit }).collect();
    // Values from their mean, so that rounding is relative to their range.
    let mean = d.iter().sum::<f64>() / d.len() as f64;
    let mut rows = LeastFactor::new(n);
    for k in 0..d.len() {
        let entries = space.values.entries(k);
        let right = (d[k] - mean) / size;
        if delta[k] > 0.0 {
            rows.push_giving(entries, [right, right], delta[k] / unit);
        } else {
            rows.push(entries, right, right);
        }
    }
    let wanted = pattern.bends(space);
    for (index, bend) in wanted.iter().enumerate() {
        let (columns, values) = space.bends.row(index);
        rows.push(columns.iter().zip(values).map(|(&column, value)| (column, bend.sign() * value)), 0.0, f64::INFINITY);
    }
    let problem = rows.into_problem();
    let none = Tried { factor: f64::INFINITY, at_least: 0.0, coefficients: Vec::new() };
    let Ok(solution) = problem.solve(&Settings::default()) else { return none };
    let at_least = proved(&problem, space, bands, &solution.multipliers, size / unit);
    if !matches!(solution.status, Status::Optimal | Status::Limit) {
        return Tried { at_least, ..none };
    }
    // B-splines sum to 1, so that the mean comes back by adding it to every coefficient.
    let coefficients: Vec<f64> = solution.x[..n].iter().map(|value| mean + size * value).collect();
    let factor = factor_of(bands, space, &wanted, &coefficients);
    Tried { factor, at_least, coefficients }
}

/// The factor that coefficients need, on [`HELD`] for points that are held; infinite when a bend has the wrong sign beyond
/// the dead band.
fn factor_of(bands: &Bands, space: &Space, wanted: &[Bend], coefficients: &[f64]) -> f64 {
    let bends = space.bends.apply(coefficients);
    let flat = dead_band(bands, &bends);
    if bends.iter().zip(wanted).any(|(value, bend)| bend.sign() * value < -flat) {
        return f64::INFINITY;
    }
    let mut factor = 0.0_f64;
    for (k, value) in space.values.apply(coefficients).iter().enumerate() {
        let off = (value - bands.values()[k]).abs();
        let slack = HELD * bands.size();
        factor = factor.max(match bands.tolerances()[k] {
            tolerance if tolerance > 0.0 => (off - slack).max(0.0) / tolerance,
            _ => off / slack,
        });
    }
    factor
}

/// A lower bound of the factor from multipliers alone, for the values at the sites as unknowns (0 where the space is
/// another).
///
/// Multiplied by z and summed the rows say: sum of limits <= (A'z)_tau tau + (A'z)_c c. What A'z leaves over in c is
/// bounded because every value lies within its band when tau <= 1: the bound holds if it exceeds 1 and proves then that
/// no curve exists.
fn proved(problem: &Problem, space: &Space, bands: &Bands, multipliers: &[f64], scale: f64) -> f64 {
    if space.knots.is_some() {
        return 0.0;
    }
    let n = problem.linear.len() - 1;
    let mean = bands.values().iter().sum::<f64>() / bands.values().len() as f64;
    // Multipliers with the sign of a lower limit are negative; a limit that does not exist proves nothing.
    let z: Vec<f64> = multipliers
        .iter()
        .enumerate()
        .map(|(row, &z)| {
            let limit = if z > 0.0 { problem.upper[row] } else { problem.lower[row] };
            if limit.is_finite() { z } else { 0.0 }
        })
        .collect();
    let pull = problem.rows.apply_transposed(&z);
    let mut bound = 0.0;
    // A multiplier of 0 may stand at a limit that is infinite.
    for (row, &z) in z.iter().enumerate().filter(|(_, z)| **z != 0.0) {
        bound -= z * if z > 0.0 { problem.upper[row] } else { problem.lower[row] };
    }
    let size = bands.size();
    for ((pull, value), tolerance) in pull[..n].iter().zip(bands.values()).zip(bands.tolerances()) {
        bound += pull * (value - mean) / size - pull.abs() * tolerance / size;
    }
    // bound <= -(A'z)_tau tau, tau in units of the program.
    let rate = -pull[n];
    let rounding = 1e-12;
    if !bound.is_finite() || bound <= rounding {
        return 0.0;
    }
    if rate <= 1e-9 * bound {
        return f64::INFINITY;
    }
    (bound - rounding) / rate * scale
}
