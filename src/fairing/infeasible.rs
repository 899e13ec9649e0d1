//! When the wishes cannot all be had: how far each would have to give way, by linear programs over the same rows.
//!
//! * The least factor s on all tolerances for which every other wish can be had: min s subject to |a_k c - d_k| <= s delta_k (and s delta_k
//!   besides the room between the offsets), and the rest.
//! * For each rule of lines and regions alone: the least slack of all its rows with which the rest can be had.
//! * For each constraint alone: the least and the greatest value that the tolerances and the other constraints leave, min and max
//!   of its row. The distance from its target to that interval is what it would have to give.

use super::program::{Program, RowName};
use crate::qp::{LeastFactor, ProblemError, Settings, SparseRows, Status};

/// What one constraint could be.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reach {
    /// Index of the constraint.
    pub constraint: usize,
    /// Least and greatest value of its row within the tolerances and the other constraints; none when these cannot be had
    /// themselves.
    pub row: Option<[f64; 2]>,
    /// Distance of the target from that interval, in units of the row.
    pub missing: Option<f64>,
}

/// Why a program has no solution, in numbers.
#[derive(Debug, Clone, PartialEq)]
pub struct Diagnosis {
    /// The least factor on the tolerances that makes the program feasible; none when no factor does.
    pub widening: Option<f64>,
    /// Each constraint alone.
    pub reaches: Vec<Reach>,
    /// Each rule alone: its index, and by how much all its rows would have to give, in their unit; none when no giving of it helps.
    pub rules: Vec<(usize, Option<f64>)>,
}

impl Diagnosis {
    /// The least factor on the tolerances when these contradict each other, the limits of half-breadths or the ends of the hull, whatever
    /// constraint is dropped.
    #[must_use]
    pub fn of_tolerances_alone(&self) -> Option<f64> {
        self.widening.filter(|_| self.rules.is_empty() && self.reaches.iter().all(|reach| reach.row.is_none()))
    }

    /// The single constraint that has to give least, in units of its row.
    #[must_use]
    pub fn cheapest(&self) -> Option<&Reach> {
        let able = self.reaches.iter().filter(|reach| reach.missing.is_some());
        able.min_by(|a, b| a.missing.unwrap_or(f64::INFINITY).total_cmp(&b.missing.unwrap_or(f64::INFINITY)))
    }
}

/// The least factor on the tolerances of a program whose tolerances are not widened.
///
/// # Errors
/// [`ProblemError`] when the numbers make no problem.
pub fn least_widening(program: &Program, settings: &Settings) -> Result<Option<f64>, ProblemError> {
    least_factor(program, settings, |k| {
        let tolerance = program.tolerances[k];
        (tolerance > 0.0).then_some((tolerance, tolerance))
    })
}

/// The least t with which the program can be had; `give` says of a row by how much its limits are narrowed first, and by how much they
/// give way for each unit of t; none of a row whose limits stay.
fn least_factor(
    program: &Program,
    settings: &Settings,
    give: impl Fn(usize) -> Option<(f64, f64)>,
) -> Result<Option<f64>, ProblemError> {
    let problem = &program.problem;
    let n = problem.linear.len();
    let mut factor = LeastFactor::new(n);
    for k in 0..program.names.len() {
        let (columns, values) = problem.rows.row(k);
        let row = columns.iter().copied().zip(values.iter().copied());
        let (low, high) = (problem.lower[k], problem.upper[k]);
        match give(k) {
            Some((narrowed, give)) => factor.push_giving(row, [low + narrowed, high - narrowed], give),
            None => factor.push(row, low, high),
        }
    }
    let solution = factor.into_problem().solve(settings)?;
    Ok((solution.status == Status::Optimal).then(|| solution.x[n]))
}

/// The interval of one row when its own limits are lifted.
fn reach(program: &Program, row: usize, settings: &Settings) -> Result<Option<[f64; 2]>, ProblemError> {
    let n = program.problem.linear.len();
    let mut problem = program.problem.clone();
    problem.quadratic = SparseRows::from_entries(n, n, &[]);
    problem.lower[row] = f64::NEG_INFINITY;
    problem.upper[row] = f64::INFINITY;
    let mut ends = [0.0; 2];
    for (end, sign) in ends.iter_mut().zip([1.0, -1.0]) {
        problem.linear = vec![0.0; n];
        let (columns, values) = program.problem.rows.row(row);
        for (&column, value) in columns.iter().zip(values) {
            problem.linear[column] = sign * value;
        }
        let solution = problem.solve(settings)?;
        if solution.status != Status::Optimal {
            return Ok(None);
        }
        *end = program.problem.rows.dot(row, &solution.x);
    }
    Ok(Some(ends))
}

/// The least slack on the rows of these names, the same for all of them and on both sides, with which the program can be had.
fn least_slack(program: &Program, these: RowName, settings: &Settings) -> Result<Option<f64>, ProblemError> {
    least_factor(program, settings, |k| (program.names[k] == these).then_some((0.0, 1.0)))
}

/// What each constraint alone could be.
fn reaches(program: &Program, settings: &Settings) -> Result<Vec<Reach>, ProblemError> {
    let mut reaches = Vec::new();
    for (row, name) in program.names.iter().enumerate() {
        let RowName::Constraint(constraint) = *name else { continue };
        let interval = reach(program, row, settings)?;
        let (lower, upper) = (program.problem.lower[row], program.problem.upper[row]);
        let missing = interval.map(|[low, high]| (lower - high).max(low - upper).max(0.0));
        reaches.push(Reach { constraint, row: interval, missing });
    }
    Ok(reaches)
}

/// Everything that can be said of a program without a solution, whose least widening is known.
///
/// # Errors
/// [`ProblemError`] when the numbers make no problem.
pub fn diagnose(program: &Program, widening: Option<f64>, settings: &Settings) -> Result<Diagnosis, ProblemError> {
    let mut rules: Vec<(usize, Option<f64>)> = Vec::new();
    for name in &program.names {
        if let RowName::Rule(rule) = *name
            && !rules.iter().any(|(known, _)| *known == rule)
        {
            rules.push((rule, least_slack(program, *name, settings)?));
        }
    }
    Ok(Diagnosis { rules, widening, reaches: reaches(program, settings)? })
}
