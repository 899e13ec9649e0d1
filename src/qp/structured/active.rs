//! A restart from the limits that bound the last solution, for a program of which limits alone have changed.
//!
//! The primal-dual active set method (Hintermüller, Ito & Kunisch 2002): rows that bind are equalities, the others are
//! not there,
//!
//! ```text
//! P x + q + A_b'z_b = 0,   A_b x = t_b,   z = 0 elsewhere;
//! ```
//!
//! afterwards a row binds where its value is beyond a limit, and does no longer where its multiplier pulls the wrong
//! way. A set that stays has found the solution, exactly: it is the Newton iteration of a piecewise linear system. A
//! local change turns few rows over, and each round has one factorisation. It may also go round in circles: rounds that
//! turn over more than [`FALL`] of what the round before did end it, and the interior point takes over.

use super::newton::{Newton, Right};
use super::point::{Iterate, Slack};
use super::scaled::Scaled;

/// Most rounds.
const ROUNDS: usize = 14;
/// Rows that a round may turn over, in parts of those of the round before.
const FALL: f64 = 0.7;
/// Rows that every round may turn over.
const FEW: f64 = 10.0;
/// Rows that the first round may turn over, as a part of all.
const LOCAL: f64 = 0.05;
/// Beyond a limit by less, in units of the largest value of a row, is at it.
const AT: f64 = 1e-13;
/// Relative precision of the system of a round.
const EXACT: f64 = 1e-14;

/// A row at a limit, or between them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Binding {
    Upper,
    Lower,
    Neither,
}

/// The rows that bind at a solution.
pub(super) fn bindings(point: &Iterate) -> Vec<Binding> {
    let binds = |side: Slack| side.exists() && side.z > side.s;
    let of = |(upper, lower): (&Slack, &Slack)| match (binds(*upper), binds(*lower)) {
        (true, false) => Binding::Upper,
        (false, true) => Binding::Lower,
        // Of two limits that are next to each other the one that pulls more.
        (true, true) => {
            if upper.z >= lower.z {
                Binding::Upper
            } else {
                Binding::Lower
            }
        }
        (false, false) => Binding::Neither,
    };
    point.upper.iter().zip(&point.lower).map(of).collect()
}

/// The solution from the rows that bound the last one, and the rounds that it took; none where the rounds come to
/// nothing.
pub(super) fn resume(scaled: &Scaled, newton: &mut Newton, bound: &[Binding]) -> Option<(Iterate, usize)> {
    let m = bound.len();
    // A limit that is there no longer does not bind.
    let there = |(row, binding): (usize, &Binding)| match binding {
        Binding::Upper if scaled.upper[row].is_finite() => Binding::Upper,
        Binding::Lower if scaled.lower[row].is_finite() => Binding::Lower,
        _ => Binding::Neither,
    };
    let mut binding: Vec<Binding> = bound.iter().enumerate().map(there).collect();
    let mut held = scaled.clone();
    let mut turned_before = (LOCAL * m as f64).max(8.0) / FALL;
    for round in 1..=ROUNDS {
        for (row, binding) in binding.iter().enumerate() {
            held.equal[row] = scaled.equal[row] || *binding != Binding::Neither;
            held.upper[row] = if *binding == Binding::Lower { scaled.lower[row] } else { scaled.upper[row] };
        }
        if !newton.factor(&held, &vec![0.0; m]) {
            return None;
        }
        let right = Right {
            f: scaled.linear.iter().map(|value| -value).collect(),
            g: (0..m).map(|row| if held.equal[row] { held.upper[row] } else { 0.0 }).collect(),
        };
        let step = newton.solve(&held, &right, [EXACT, EXACT]);
        let largest = step.values.iter().fold(1.0_f64, |most, value| most.max(value.abs()));
        let mut turned = 0;
        for (row, binding) in binding.iter_mut().enumerate() {
            let value = step.values[row];
            let next = match *binding {
                _ if scaled.equal[row] => Binding::Neither,
                Binding::Upper if step.z[row] >= 0.0 => Binding::Upper,
                Binding::Lower if step.z[row] <= 0.0 => Binding::Lower,
                Binding::Neither if value > scaled.upper[row] + AT * largest => Binding::Upper,
                Binding::Neither if value < scaled.lower[row] - AT * largest => Binding::Lower,
                _ => Binding::Neither,
            };
            turned += usize::from(next != *binding);
            *binding = next;
        }
        if turned == 0 {
            return Some((solution(scaled, &held, step.x, &step.z, &step.values), round));
        }
        if turned as f64 > (FALL * turned_before).max(FEW) {
            return None;
        }
        turned_before = turned as f64;
    }
    None
}

/// The point of a solution: slacks of rows that bind are 0.
fn solution(scaled: &Scaled, held: &Scaled, x: Vec<f64>, multipliers: &[f64], values: &[f64]) -> Iterate {
    let m = values.len();
    let mut point = Iterate { x, z: vec![0.0; m], upper: vec![Slack::NONE; m], lower: vec![Slack::NONE; m] };
    for row in 0..m {
        let z = multipliers[row];
        if scaled.equal[row] {
            point.z[row] = z;
            continue;
        }
        let t = values[row].clamp(scaled.lower[row], scaled.upper[row]);
        let z = if held.equal[row] { z } else { 0.0 };
        point.upper[row] = Slack { s: scaled.upper[row] - t, z: z.max(0.0) };
        point.lower[row] = Slack { s: t - scaled.lower[row], z: (-z).max(0.0) };
        point.z[row] = z;
    }
    point
}
