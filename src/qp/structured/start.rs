//! Where the iteration starts.

use super::super::problem::Interior;
use super::newton::{Newton, Right};
use super::point::{Iterate, Slack};
use super::scaled::Scaled;

/// Weight of every inequality in the first fit, in units of the mean diagonal of P.
const SOFT: f64 = 1e-2;
/// The same without P, in units of the largest |q|.
const SOFT_LINEAR: f64 = 1.0;
/// Where slacks and multipliers start.
#[derive(Debug, Clone, Copy)]
pub(super) struct Start {
    /// The first slacks, in units of the root mean square of A x.
    margin: f64,
    /// The first multipliers, in units of the largest gradient.
    pull: f64,
}

/// Starts in the order in which they are tried: near the solution of a program whose limits cost little, and far inside.
/// The multipliers of a program that is nearly infeasible are orders of magnitude above the gradient. From the first start
/// the products s z fall faster than the residuals there, and steps become 1e-3; from the second it takes 25 iterations.
pub(super) const STARTS: [Start; 2] = [Start { margin: 0.05, pull: 0.02 }, Start { margin: 10.0, pull: 1e4 }];

/// Products of a warm start, in units of their mean.
const SPREAD: f64 = 10.0;

/// The least of 1/2 x'Px + q'x + SOFT/2 |A x - t|^2 on the equalities, t the nearest admissible values to 0, and all
/// products s z equal.
pub(super) fn cold(scaled: &Scaled, newton: &mut Newton, start: Start) -> Option<Iterate> {
    let m = scaled.rows.row_count();
    // Numbers near the greatest there are overflow.
    let is_number = |row: usize| scaled.lower[row] < f64::INFINITY && scaled.upper[row] > f64::NEG_INFINITY;
    if !(0..m).all(is_number) {
        return None;
    }
    let bounded = |row: usize| scaled.upper[row].is_finite() || scaled.lower[row].is_finite();
    let weight = if scaled.quadratic.values().iter().all(|value| *value == 0.0) { SOFT_LINEAR } else { SOFT };
    let soft = |row: usize| if scaled.equal[row] || !bounded(row) { 0.0 } else { weight };
    let weights: Vec<f64> = (0..m).map(soft).collect();
    if !newton.factor(scaled, &weights) {
        return None;
    }
    let f = scaled.linear.iter().map(|value| -value).collect();
    let g = (0..m)
        .map(|row| match (scaled.equal[row], scaled.inside[row]) {
            (true, _) => scaled.upper[row],
            (false, true) => weights[row] * middle(scaled.lower[row], scaled.upper[row]),
            (false, false) => middle(scaled.lower[row], scaled.upper[row]),
        })
        .collect();
    let step = newton.solve(scaled, &Right { f, g }, [1e-8, 1e-8]);
    let values = scaled.rows.apply(&step.x);
    let (mut sum, mut count) = (0.0, 0);
    for (row, value) in values.iter().enumerate() {
        if weights[row] > 0.0 {
            // The size includes what the value must move.
            let nearest = value.clamp(scaled.lower[row], scaled.upper[row]);
            sum += (nearest.abs() + (value - nearest).abs()).powi(2);
            count += 1;
        }
    }
    let size = if count > 0 && sum > 0.0 { (sum / f64::from(count)).sqrt() } else { 1.0 };
    let curved = scaled.quadratic.apply(&step.x);
    let steepest = curved.iter().zip(&scaled.linear).fold(0.0_f64, |most, (p, q)| most.max(p.abs()).max(q.abs()));
    let steepest = steepest.max(if weight == SOFT { rms(&step.x) } else { 0.0 });
    let pull = if steepest > 0.0 { start.pull * steepest } else { start.pull };
    if !(size.is_finite() && pull.is_finite()) {
        return None;
    }
    let margin = start.margin * size;
    Some(centred(scaled, step.x, &values, margin, margin * pull))
}

/// The point with these x, its slacks at least `margin` (or a quarter of the width), multipliers mu / s.
fn centred(scaled: &Scaled, x: Vec<f64>, values: &[f64], margin: f64, mu: f64) -> Iterate {
    let m = values.len();
    let mut point = Iterate { x, z: vec![0.0; m], upper: vec![Slack::NONE; m], lower: vec![Slack::NONE; m] };
    for (row, &value) in values.iter().enumerate() {
        let (l, u) = (scaled.lower[row], scaled.upper[row]);
        if scaled.equal[row] {
            continue;
        }
        let inset = margin.min(0.25 * (u - l));
        let t = value.clamp(l + inset, u - inset);
        if u.is_finite() {
            point.upper[row] = Slack { s: u - t, z: mu / (u - t) };
        }
        if l.is_finite() {
            point.lower[row] = Slack { s: t - l, z: mu / (t - l) };
        }
        point.z[row] = point.upper[row].z - point.lower[row].z;
    }
    point
}

/// A kept iterate in the limits of a changed problem: x and multipliers stay, every t moves to where both its slacks
/// are at least what they were (or a quarter of the width), and products that fall outside [mu / SPREAD, mu SPREAD] are
/// brought back.
pub(super) fn warm(scaled: &Scaled, kept: &Iterate) -> Iterate {
    let mut point = kept.clone();
    let values = scaled.rows.apply(&kept.x);
    let mu = kept.complementarity() / kept.sides().max(1) as f64;
    let side = |s: f64, z: f64| Slack { s, z: z.clamp(mu / (SPREAD * s), mu * SPREAD / s) };
    for (row, &value) in values.iter().enumerate() {
        let (l, u) = (scaled.lower[row], scaled.upper[row]);
        (point.upper[row], point.lower[row]) = (Slack::NONE, Slack::NONE);
        if scaled.equal[row] {
            continue;
        }
        let (above, below) = (kept.upper[row], kept.lower[row]);
        let room = |s: f64| s.min(if u - l < f64::INFINITY { 0.25 * (u - l) } else { s.min(1.0) });
        let t = value.clamp(l + room(below.s), u - room(above.s));
        if u.is_finite() {
            point.upper[row] = side(u - t, above.z);
        }
        if l.is_finite() {
            point.lower[row] = side(t - l, below.z);
        }
        point.z[row] = point.upper[row].z - point.lower[row].z;
    }
    point
}

/// A point of a similar problem as an iterate of this one. A row of which it knows nothing has slacks as large as it is
/// violated, at least the square root of the mean product, and products equal to that.
pub(super) fn like(scaled: &Scaled, known: &Interior) -> Iterate {
    let m = scaled.rows.row_count();
    let x = scaled.scaled_variables(&known.x);
    let values = scaled.rows.apply(&x);
    let mut point = Iterate { x, z: vec![0.0; m], upper: vec![Slack::NONE; m], lower: vec![Slack::NONE; m] };
    for (row, sides) in known.rows.iter().enumerate() {
        let Some([upper, lower]) = sides.map(|sides| sides.map(|side| scaled.side(row, side))) else { continue };
        (point.upper[row], point.lower[row]) = (upper, lower);
        point.z[row] = upper.z - lower.z;
    }
    let mu = (point.complementarity() / point.sides().max(1) as f64).max(f64::EPSILON);
    for (row, value) in values.into_iter().enumerate().filter(|(row, _)| known.rows[*row].is_none()) {
        let s = (scaled.lower[row] - value).max(value - scaled.upper[row]).max(mu.sqrt());
        (point.upper[row], point.lower[row]) = (Slack { s, z: mu / s }, Slack { s, z: mu / s });
    }
    point
}

/// The admissible value nearest to 0, of a band its middle.
fn middle(lower: f64, upper: f64) -> f64 {
    if lower.is_finite() && upper.is_finite() { 0.5 * (lower + upper) } else { 0.0_f64.max(lower).min(upper) }
}

fn rms(values: &[f64]) -> f64 {
    (values.iter().map(|value| value * value).sum::<f64>() / values.len().max(1) as f64).sqrt()
}
