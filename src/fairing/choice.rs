//! Which lines can be asked for signs of curvature together for no more than their price each.
//!
//! A line l may keep a part s_l of what its signs ask of it to give up, at `price` times s_l:
//!
//! ```text
//! minimise J + price sum_l s_l   subject to   a_k y + v_k s_l within the limits of row k of line l,   0 <= s_l <= 1,
//! ```
//!
//! v_k the violation of the row at a net that meets all else: with s = 1 nothing is asked, so that there always is an
//! answer. By duality s_l = 0 as long as sum_k z_k v_k, the charge of the line, is below the price: one convex program
//! finds the lines that are worth it, where a program with all of them has no solution and its proof only names some
//! that contradict each other.
//!
//! It is solved for moves from that net, in units of the least price, so that its accuracy is one of what the lines cost.
//! Against the whole objective an accuracy of 1e-4 left DTMB 5415 with 272 changes of sign for 162.

use super::model::{Limit, Reduced, value};
use super::program::Program;
use crate::qp::{Interior, Problem, ProblemError, Settings, SparseRows, Status};

/// Most iterations of a program that is tried: what takes more has next to nothing within its limits (those that are had
/// take 47 at most on the shared tables).
const ITERATIONS: usize = 70;

/// Accuracy of the choice, over what it costs.
const ACCURACY: f64 = 1e-4;

/// A line that keeps more than this part is not worth its price.
const KEEPS: f64 = 0.02;

/// Whether each of the `lines`, with these limits beside the rows of a program, is worth its one of `prices` \[m^2\]; none when that
/// was not found. `net` meets the rows of the program. The second is a point well inside the limits: rows and variables of the
/// program, and then the rows of the lines.
pub(super) fn worth_it(
    (program, reduced): (&Program, &Reduced),
    net: &[f64],
    lines: &[Vec<&Limit>],
    prices: &[f64],
    settings: &Settings,
) -> Result<(Option<Vec<bool>>, Option<Interior>), ProblemError> {
    let old = &program.problem;
    let (n, count) = (old.linear.len(), lines.len());
    let widened = |rows: &SparseRows, factor: f64| {
        let mut wide = SparseRows::new(n + count);
        for k in 0..rows.row_count() {
            wide.push(rows.entries(k).map(|(column, value)| (column, factor * value)));
        }
        wide
    };
    // About the net, and in units of the least price: what is left of the objective is what the lines cost.
    let unit = prices.iter().copied().fold(f64::INFINITY, f64::min);
    let centre = reduced.unknowns_of(net);
    let slopes = old.curved(&centre).into_iter().zip(&old.linear).map(|(slope, linear)| slope + linear);
    let there = old.rows.apply(&centre);
    let moved = |limits: &[f64]| limits.iter().zip(&there).map(|(limit, value)| limit - value).collect();
    let mut problem = Problem {
        quadratic: widened(&old.quadratic, unit.recip()),
        linear: slopes.chain(prices.iter().copied()).map(|slope| slope / unit).collect(),
        squares: widened(&old.squares, unit.recip().sqrt()),
        rows: widened(&old.rows, 1.0),
        lower: moved(&old.lower),
        upper: moved(&old.upper),
    };
    for (l, limits) in (n..).zip(lines) {
        problem.quadratic.push([(l, 0.0)]);
        for limit in limits {
            let missed = missed(limit, net);
            let (row, _) = reduced.row(&limit.row);
            problem.rows.push(row.into_iter().chain([(l, missed)]).filter(|(_, value)| *value != 0.0));
            let now = value(&limit.row, net);
            problem.lower.push(limit.lower - now);
            problem.upper.push(limit.upper - now);
        }
        problem.rows.push([(l, 1.0)]);
        problem.lower.push(0.0);
        problem.upper.push(1.0);
    }
    let answer = problem.solve(&Settings { tolerance: ACCURACY, proof: false, ..settings.clone() })?;
    let parts = (answer.status == Status::Optimal).then_some(&answer.x[n..]);
    let chosen = parts.map(|parts| parts.iter().map(|part| *part <= KEEPS).collect());
    let absolute = |Interior { mut x, rows }: Interior| {
        // Without what the lines keep: the variables after the first n, and the last row of each line.
        x.truncate(n);
        x.iter_mut().zip(&centre).for_each(|(x, centre)| *x += centre);
        let is_sign = lines.iter().flat_map(|limits| limits.iter().map(|_| true).chain([false]));
        let kept = std::iter::repeat_n(true, old.rows.row_count()).chain(is_sign);
        let row = |row: Option<[[f64; 2]; 2]>| row.map(|sides| sides.map(|[slack, z]| [slack, unit * z]));
        Interior {
            x,
            rows: rows.into_iter().zip(kept).filter(|(_, kept)| *kept).map(|(sides, _)| row(sides)).collect(),
        }
    };
    Ok((chosen, answer.interior.map(absolute)))
}

/// By how much a net is below (> 0) or above (< 0) a limit.
fn missed(limit: &Limit, net: &[f64]) -> f64 {
    let now = value(&limit.row, net);
    (limit.lower - now).max(0.0) + (limit.upper - now).min(0.0)
}

/// Settings for a program with signs that may not be had.
pub(super) fn trial(settings: &Settings) -> Settings {
    Settings { iterations: settings.iterations.min(ITERATIONS), proof: false, ..settings.clone() }
}
