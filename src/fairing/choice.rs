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

use super::least::TableLine;
use super::model::{Limit, Reduced, value};
use super::program::{Program, RowName, Solved};
use crate::qp::{Problem, ProblemError, Settings, SparseRows, Status};

/// Most iterations of a program that is tried: what takes more has next to nothing within its limits (those that are had
/// take 47 at most on the shared tables).
const ITERATIONS: usize = 70;

/// Accuracy of the choice.
const ACCURACY: f64 = 1e-7;

/// A line that keeps more than this part is not worth its price.
const KEEPS: f64 = 0.02;

/// Whether each of the `lines`, with these limits beside the rows of a program, is worth its one of `prices` \[m^2\]; none when that
/// was not found. `net` meets the rows of the program.
pub(super) fn worth_it(
    program: (&Program, &Reduced),
    net: &[f64],
    lines: &[&[Limit]],
    prices: &[f64],
    settings: &Settings,
) -> Result<Option<Vec<bool>>, ProblemError> {
    let parts = given_up(program, net, lines, prices, settings)?;
    Ok(parts.map(|parts| parts.into_iter().map(|part| part <= KEEPS).collect()))
}

/// The part s_l that each line gives up.
pub(super) fn given_up(
    (program, reduced): (&Program, &Reduced),
    net: &[f64],
    lines: &[&[Limit]],
    prices: &[f64],
    settings: &Settings,
) -> Result<Option<Vec<f64>>, ProblemError> {
    let old = &program.problem;
    let (n, count) = (old.linear.len(), lines.len());
    let widened = |rows: &SparseRows| {
        let mut wide = SparseRows::new(n + count);
        for k in 0..rows.row_count() {
            wide.push(rows.entries(k));
        }
        wide
    };
    let mut problem = Problem {
        quadratic: widened(&old.quadratic),
        linear: old.linear.iter().copied().chain(prices.iter().copied()).collect(),
        rows: widened(&old.rows),
        lower: old.lower.clone(),
        upper: old.upper.clone(),
    };
    for (l, limits) in (n..).zip(lines) {
        problem.quadratic.push([(l, 0.0)]);
        for limit in *limits {
            let missed = missed(limit, net);
            let (row, offset) = reduced.row(&limit.row);
            problem.rows.push(row.into_iter().chain([(l, missed)]).filter(|(_, value)| *value != 0.0));
            problem.lower.push(limit.lower - offset);
            problem.upper.push(limit.upper - offset);
        }
        problem.rows.push([(l, 1.0)]);
        problem.lower.push(0.0);
        problem.upper.push(1.0);
    }
    let answer = problem.solve(&Settings { tolerance: ACCURACY, proof: false, ..settings.clone() })?;
    Ok((answer.status == Status::Optimal).then(|| answer.x[n..].to_vec()))
}

/// By how much a net is below (> 0) or above (< 0) a limit.
fn missed(limit: &Limit, net: &[f64]) -> f64 {
    let now = value(&limit.row, net);
    (limit.lower - now).max(0.0) + (limit.upper - now).min(0.0)
}

/// The limit with a part of what `net` misses given up.
pub(super) fn loosened(limit: &Limit, net: &[f64], part: f64) -> Limit {
    let given = part * missed(limit, net);
    Limit { lower: limit.lower - given.max(0.0), upper: limit.upper - given.min(0.0), row: limit.row.clone() }
}

/// Settings for a program with signs that may not be had.
pub(super) fn trial(settings: &Settings) -> Settings {
    Settings { iterations: settings.iterations.min(ITERATIONS), proof: false, ..settings.clone() }
}

/// What each line is charged for its limits \[m^2\]: the sum of multipliers times violations at `net`, which is without
/// them. The limits of the lines are the signs of the program from number `first` on.
pub(super) fn charges(
    (program, solved): (&Program, &Solved),
    lines: &[&[Limit]],
    first: usize,
    net: &[f64],
) -> Vec<f64> {
    let mut multipliers = vec![0.0; lines.iter().map(|limits| limits.len()).sum()];
    for (name, z) in program.names.iter().zip(&solved.solution.multipliers) {
        if let RowName::Bend(k) = *name
            && let Some(multiplier) = k.checked_sub(first).and_then(|k| multipliers.get_mut(k))
        {
            *multiplier = *z;
        }
    }
    let mut rest = multipliers.as_slice();
    let mut of_line = |limits: &&[Limit]| {
        let (own, others) = rest.split_at(limits.len());
        rest = others;
        TableLine::charge(limits, own, net)
    };
    lines.iter().map(&mut of_line).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_limit_gives_up_a_part_of_what_is_missed_on_the_side_that_is_missed() {
        let limit = |lower: f64, upper: f64| Limit { row: vec![(0, 2.0)], lower, upper };
        let at = |limit: &Limit, part: f64| {
            let loose = loosened(limit, &[1.5], part);
            (loose.lower, loose.upper)
        };
        assert_eq!(at(&limit(5.0, 7.0), 0.25), (4.5, 7.0));
        assert_eq!(at(&limit(f64::NEG_INFINITY, 1.0), 0.5), (f64::NEG_INFINITY, 2.0));
        assert_eq!(at(&limit(2.0, 4.0), 1.0), (2.0, 4.0));
        // With all of it the net is within.
        assert_eq!(at(&limit(5.0, 7.0), 1.0), (3.0, 7.0));
    }
}
