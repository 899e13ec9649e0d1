//! When the wishes cannot all be had: how far each would have to give way, by linear programs over the same rows.
//!
//! * The least factor s on all tolerances for which every other wish can be had: min s subject to |a_k c - d_k| <= s
//!   delta_k (and s delta_k besides the room between the offsets), and the rest.
//! * For each rule of lines and regions alone: the least slack of all its rows with which the rest can be had.
//! * For each constraint alone: the least and the greatest value that the tolerances and the other constraints leave,
//!   those of the quantity itself where its row is least and greatest. The distance from its target to that interval is
//!   what it would have to give.
//! * The nearest that the targets can be had together.

use super::model::Row;
use super::program::{Program, RowName};
use crate::qp::{LeastFactor, ProblemError, RepeatedSolver, Settings, Solution, Status};

/// What a target may miss, relative, and still count as had.
const HAD: f64 = 1e-9;

/// Most that a proved factor may break a limit by, in the units of the row.
const VIOLATED: f64 = 1e-9;

/// What the bound of a least factor may be off, relative, where the solver stalled before its tolerance was met.
const PROVED: f64 = 1e-5;

/// Weight of the squares of all unknowns of a step, half-breadths and factor alike, where the linear program stalls.
const PROXIMAL: f64 = 1e-4;

/// What one constraint could be.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reach {
    /// Index of the constraint.
    pub constraint: usize,
    /// Least and greatest value of its quantity within the tolerances and the other constraints, in its unit; where
    /// these cannot be met themselves, without them, and without the rules where these cannot be met either; none where the
    /// tolerances alone cannot be met. Of what is not
    /// linear: the values where its tangent at the start is least and greatest, which can be had, if the others are not
    /// its like.
    pub values: Option<[f64; 2]>,
    /// Distance of the target from that interval, over the scale of the target; none where the others had to be left
    /// out: giving way alone, it would not do.
    pub missing: Option<f64>,
}

/// What a constraint asks for.
#[derive(Debug, Clone, PartialEq)]
pub struct Target {
    /// Row over the unknowns along which the quantity grows, about the start: the row of the program turns with a target
    /// that is far away.
    pub row: Row,
    /// Least and greatest value that is wished, in the unit of the quantity.
    pub limits: [f64; 2],
    /// What a miss is measured in.
    pub scale: f64,
}

/// Two nets or points: the nearest that targets can be had, and the fairest.
pub type Ends = [Vec<f64>; 2];

/// Why a program has no solution, in numbers.
#[derive(Debug, Clone, PartialEq)]
pub struct Diagnosis {
    /// The least factor on the tolerances that makes the program feasible; none when no factor does, or none was found.
    pub widening: Option<f64>,
    /// Each constraint alone.
    pub reaches: Vec<Reach>,
    /// Each rule alone: its index, and by how much all its rows would have to give, in their unit; none when no giving
    /// of it helps, or none was found.
    pub rules: Vec<(usize, Option<f64>)>,
}

impl Diagnosis {
    /// The least factor on the tolerances when these contradict each other, the limits of half-breadths or the ends of
    /// the hull, whatever constraint is dropped.
    #[must_use]
    pub fn of_tolerances_alone(&self) -> Option<f64> {
        self.widening.filter(|_| self.rules.is_empty() && self.reaches.iter().all(|reach| reach.values.is_none()))
    }

    /// The single constraint that has to give least, in units of its row.
    #[must_use]
    pub fn cheapest(&self) -> Option<&Reach> {
        let able = self.reaches.iter().filter(|reach| reach.missing.is_some());
        able.min_by(|a, b| a.missing.unwrap_or(f64::INFINITY).total_cmp(&b.missing.unwrap_or(f64::INFINITY)))
    }
}

/// The least factor on the tolerances of a program whose tolerances are not widened; `cut` says with which further
/// limits an answer with tolerances times a factor is none that counts.
///
/// # Errors
/// [`ProblemError`] when the numbers make no problem.
pub fn least_widening(
    program: &Program,
    settings: &Settings,
    mut cut: impl FnMut(&[f64], f64) -> Option<Program>,
) -> Result<Option<f64>, ProblemError> {
    let Some((mut factor, mut x)) = widened(program, settings)? else { return Ok(None) };
    for _ in 0..CUTS {
        let Some(program) = cut(&x, factor) else { break };
        let Some(found) = widened(&program, settings)? else { return Ok(None) };
        (factor, x) = found;
    }
    Ok(Some(factor))
}

/// The least factor on the tolerances, and an answer with it.
fn widened(program: &Program, settings: &Settings) -> Result<Option<(f64, Vec<f64>)>, ProblemError> {
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
) -> Result<Option<(f64, Vec<f64>)>, ProblemError> {
    let problem = &program.problem;
    let n = problem.linear.len();
    let mut factor = LeastFactor::new(n);
    for k in 0..program.names.len() {
        let row = problem.rows.entries(k);
        let (low, high) = (problem.lower[k], problem.upper[k]);
        match give(k) {
            Some((narrowed, give)) => factor.push_giving(row, [low + narrowed, high - narrowed], give),
            None => factor.push(row, low, high),
        }
    }
    let problem = factor.into_problem();
    // Where many limits meet, the multipliers stall at what is proof enough of a factor.
    let proved = |solution: &Solution| {
        let certificate = problem.certificate(&solution.x, &solution.multipliers, 0.0);
        let gap = (certificate.primal - certificate.dual).abs();
        certificate.max_violation <= VIOLATED && gap <= PROVED * certificate.primal.abs()
    };
    let settings = Settings { proof: false, ..settings.clone() };
    let mut solution = problem.solve(&settings)?;
    let mut found = solution.status == Status::Optimal || proved(&solution);
    if solution.status == Status::Limit && !found {
        // A linear program whose least factor is hardly more than what is there already may lose its way.
        solution = problem.solve_by_proximal_points(&settings, &solution.x, PROXIMAL, proved)?;
        found = proved(&solution);
    }
    let factor = solution.x.split_off(n)[0];
    Ok(found.then_some((factor, solution.x)))
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
    /// Where a constraint's quantity is least and greatest when its own limits are lifted, and every row `without`.
    fn reach(
        &mut self,
        name: RowName,
        along: &Row,
        without: &impl Fn(RowName) -> bool,
    ) -> Result<Option<[Vec<f64>; 2]>, ProblemError> {
        let Some(least) = self.extreme(name, along, 1.0, without)? else { return Ok(None) };
        Ok(self.extreme(name, along, -1.0, without)?.map(|greatest| [least, greatest]))
    }

    /// Where it is least for sign 1, greatest for -1.
    fn extreme(
        &mut self,
        name: RowName,
        along: &Row,
        sign: f64,
        without: &impl Fn(RowName) -> bool,
    ) -> Result<Option<Vec<f64>>, ProblemError> {
        let mut found = None;
        for _ in 0..CUTS {
            // The limits that were broken come with the whole program.
            let program = self.program.without(without);
            let Some(row) = program.names.iter().position(|other| *other == name) else { break };
            let mut problem = program.problem.without_objective();
            (problem.lower[row], problem.upper[row]) = (f64::NEG_INFINITY, f64::INFINITY);
            along.iter().for_each(|&(column, value)| problem.linear[column] += sign * value);
            let solution = self.solver.solve(&problem)?;
            self.programs += 1;
            match solution.status {
                Status::Optimal => {}
                // With less than all limits the interval is only wider.
                Status::Limit if found.is_some() => break,
                _ => return Ok(None),
            }
            let further = (self.cut)(&solution.x);
            found = Some(solution.x);
            match further {
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
    let found = least_factor(program, settings, |k| (program.names[k] == these).then_some((0.0, 1.0)))?;
    Ok(found.map(|(slack, _)| slack))
}

/// Everything that can be said of a program without a solution, whose least widening is known, and the programs that it
/// took. `targets` are what its constraints ask for and `value` the quantity of one of them, in its unit; `cut` says
/// with which further limits an x is none that counts.
///
/// # Errors
/// [`ProblemError`] when the numbers make no problem.
pub fn diagnose(
    program: Program,
    widening: Option<f64>,
    targets: &[Target],
    value: impl Fn(usize, &[f64]) -> Option<f64>,
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
    let held = |constraint: &usize| program.names.contains(&RowName::Constraint(*constraint));
    let constraints: Vec<usize> = (0..targets.len()).filter(held).collect();
    // Whether the other targets are feasible together is asked, and no proof that they are not.
    let settings = Settings { proof: false, ..settings.clone() };
    let mut asked = Asked { program, cut, solver: RepeatedSolver::new(&settings), programs: rules.len() };
    let mut reaches = Vec::new();
    for constraint in constraints {
        let own = RowName::Constraint(constraint);
        let Target { limits: [lower, upper], scale, row } = &targets[constraint];
        let other = |name: RowName| matches!(name, RowName::Constraint(_)) && name != own;
        let ruled = |name: RowName| matches!(name, RowName::Rule(_));
        let mut ends = asked.reach(own, row, &|_| false)?;
        let alone = ends.is_some();
        if ends.is_none() {
            ends = asked.reach(own, row, &other)?;
        }
        if ends.is_none() && !rules.is_empty() {
            ends = asked.reach(own, row, &|name| other(name) || ruled(name))?;
        }
        let values = ends.and_then(|[a, b]| {
            let (a, b) = (value(constraint, &a)?, value(constraint, &b)?);
            Some([a.min(b), a.max(b)])
        });
        let missing = values.filter(|_| alone).map(|[low, high]| (lower - high).max(low - upper).max(0.0) / scale);
        reaches.push(Reach { constraint, values, missing });
    }
    Ok((Diagnosis { rules, widening, reaches }, asked.programs))
}

/// Two answers within every row but those of the constraints of which `gives` holds: where these miss their targets by
/// the least sum of relative misses, and the one of least objective without those that miss; with the programs that it
/// took. None where the other rows cannot be met. Every row is convex, so that the way from the one to the other keeps
/// what both keep. `cut` as in [`diagnose`].
///
/// # Errors
/// [`ProblemError`] when the numbers make no problem.
pub fn nearest(
    mut program: Program,
    gives: impl Fn(usize) -> bool,
    targets: &[Target],
    settings: &Settings,
    mut cut: impl FnMut(&[f64]) -> Option<Program>,
) -> Result<(Option<Ends>, usize), ProblemError> {
    let giving = |name: RowName| matches!(name, RowName::Constraint(k) if gives(k));
    let (mut found, mut programs) = (None, 0);
    for _ in 0..CUTS {
        let free = program.without(giving).problem.solve(settings)?;
        programs += 1;
        if free.status != Status::Optimal {
            break;
        }
        // Towards each target from the side that the free answer is on.
        let mut problem = program.problem.without_objective();
        let mut off = Vec::new();
        for k in (0..program.names.len()).filter(|&k| giving(program.names[k])) {
            let (value, limits) = (problem.rows.dot(k, &free.x), [problem.lower[k], problem.upper[k]]);
            let (sign, target) = match limits {
                [lower, _] if value < lower => (-1.0, lower),
                [_, upper] if value > upper => (1.0, upper),
                _ => continue,
            };
            [problem.lower[k], problem.upper[k]] =
                if sign < 0.0 { [f64::NEG_INFINITY, target] } else { [target, f64::INFINITY] };
            if let RowName::Constraint(constraint) = program.names[k] {
                let Target { row, scale, .. } = &targets[constraint];
                row.iter().for_each(|&(column, value)| problem.linear[column] += sign * value / scale);
            }
            off.push((program.names[k], k, target));
        }
        let near = problem.solve(settings)?;
        programs += 1;
        if near.status != Status::Optimal {
            break;
        }
        let misses = |name: RowName| {
            off.iter().any(|&(own, k, target)| own == name && (problem.rows.dot(k, &near.x) - target).abs() > HAD)
        };
        // Where all of them miss it is the net that is free of them.
        let fair = if program.names.iter().all(|name| !giving(*name) || misses(*name)) {
            free
        } else {
            programs += 1;
            program.without(misses).problem.solve(settings)?
        };
        if fair.status != Status::Optimal {
            break;
        }
        let further = cut(&near.x).or_else(|| cut(&fair.x));
        found = Some([near.x, fair.x]);
        match further {
            Some(more) => program = more,
            None => break,
        }
    }
    Ok((found, programs))
}
