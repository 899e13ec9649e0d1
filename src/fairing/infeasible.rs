//! When the wishes cannot all be had: how far each would have to give way, by linear programs over the same rows.
//!
//! * The least factor s on all tolerances for which every other wish can be had: min s subject to |a_k c - d_k| <= s
//!   delta_k (and s delta_k besides the room between the offsets), and the rest.
//! * For each rule of lines and regions alone: the least slack of all its rows with which the rest can be had.
//! * For each constraint alone: the least and the greatest value that the tolerances and the other constraints leave,
//!   min and max of its row. The distance from its target to that interval is what it would have to give.

use super::program::{Program, RowName};
use crate::qp::{LeastFactor, ProblemError, RepeatedSolver, Settings, SparseRows, Status};

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
    /// Each rule alone: its index, and by how much all its rows would have to give, in their unit; none when no giving
    /// of it helps.
    pub rules: Vec<(usize, Option<f64>)>,
}

impl Diagnosis {
    /// The least factor on the tolerances when these contradict each other, the limits of half-breadths or the ends of
    /// the hull, whatever constraint is dropped.
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

/// The least t with which the program can be had; `give` says of a row by how much its limits are narrowed first, and
/// by how much they give way for each unit of t; none of a row whose limits stay.
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

/// Most times that limits are added which an end of an interval breaks: an interval that still breaks some is too wide.
const CUTS: usize = 6;

/// A program whose rows are asked for extremes, with the limits that these break.
struct Asked<'a, F> {
    program: Program,
    /// The program with the limits that x breaks; none where it breaks none.
    cut: F,
    solver: RepeatedSolver<'a>,
    programs: usize,
}

impl<F: FnMut(&[f64]) -> Option<Program>> Asked<'_, F> {
    /// The interval of a constraint's row when its own limits are lifted.
    fn reach(&mut self, name: RowName) -> Result<Option<[f64; 2]>, ProblemError> {
        let mut ends = [0.0; 2];
        for (end, sign) in ends.iter_mut().zip([1.0, -1.0]) {
            match self.extreme(name, sign)? {
                Some(value) => *end = value,
                None => return Ok(None),
            }
        }
        Ok(Some(ends))
    }

    /// The least value of the row for sign 1, the greatest for -1.
    fn extreme(&mut self, name: RowName, sign: f64) -> Result<Option<f64>, ProblemError> {
        let mut found = None;
        for _ in 0..CUTS {
            let Some(row) = self.program.names.iter().position(|other| *other == name) else { break };
            let n = self.program.problem.linear.len();
            let mut problem = self.program.problem.clone();
            problem.quadratic = SparseRows::from_entries(n, n, &[]);
            (problem.lower[row], problem.upper[row]) = (f64::NEG_INFINITY, f64::INFINITY);
            problem.linear = vec![0.0; n];
            let (columns, values) = self.program.problem.rows.row(row);
            for (&column, value) in columns.iter().zip(values) {
                problem.linear[column] = sign * value;
            }
            let solution = self.solver.solve(&problem)?;
            self.programs += 1;
            match solution.status {
                Status::Optimal => {}
                // With less than all limits the interval is only wider.
                Status::Limit if found.is_some() => break,
                _ => return Ok(None),
            }
            found = Some(self.program.problem.rows.dot(row, &solution.x));
            match (self.cut)(&solution.x) {
                Some(program) => self.program = program,
                None => break,
            }
        }
        Ok(found)
    }
}

/// The least slack on the rows of these names, the same for all of them and on both sides, with which the program can
/// be had.
fn least_slack(program: &Program, these: RowName, settings: &Settings) -> Result<Option<f64>, ProblemError> {
    least_factor(program, settings, |k| (program.names[k] == these).then_some((0.0, 1.0)))
}

/// Everything that can be said of a program without a solution, whose least widening is known, and the programs that it
/// took. `cut` says with which further limits an x is none that counts.
///
/// # Errors
/// [`ProblemError`] when the numbers make no problem.
pub fn diagnose(
    program: Program,
    widening: Option<f64>,
    settings: &Settings,
    cut: impl FnMut(&[f64]) -> Option<Program>,
) -> Result<(Diagnosis, usize), ProblemError> {
    let mut rules: Vec<(usize, Option<f64>)> = Vec::new();
    for name in &program.names {
        if let RowName::Rule(rule) = *name
            && !rules.iter().any(|(known, _)| *known == rule)
        {
            rules.push((rule, least_slack(&program, *name, settings)?));
        }
    }
    let constraints = program.names.iter().enumerate().filter_map(|(row, name)| match *name {
        RowName::Constraint(constraint) => Some((constraint, [program.problem.lower[row], program.problem.upper[row]])),
        _ => None,
    });
    let constraints: Vec<(usize, [f64; 2])> = constraints.collect();
    let mut asked = Asked { program, cut, solver: RepeatedSolver::new(settings), programs: rules.len() };
    let mut reaches = Vec::new();
    for (constraint, [lower, upper]) in constraints {
        let row = asked.reach(RowName::Constraint(constraint))?;
        let missing = row.map(|[low, high]| (lower - high).max(low - upper).max(0.0));
        reaches.push(Reach { constraint, row, missing });
    }
    Ok((Diagnosis { rules, widening, reaches }, asked.programs))
}
