//! Quantities that are not linear in the net, metacentre and wetted surface: linearised, solved, linearised at the answer, until the
//! quantity itself is on its target.
//!
//! Each step is a convex program over all other rows of the last one; the segment from net to answer is the region of trust, since
//! every point of it keeps whatever the two ends keep. The whole step is taken when it halves the largest relative error; otherwise
//! Brent's method (argmin) finds the point of the segment with the least error, and the next tangents are taken there. The last
//! answer is that of a whole step, so that its certificate is one of the linearised program, whose rows at that point are tangents of
//! the quantities to second order in the step.

use super::constraint::Constraint;
use super::model::Model;
use super::program::{Program, RowName, Solved};
use super::refresh::RefreshError;
use super::smoothing::Smoother;
use super::surface::FairSurface;
use crate::qp::Settings;
use argmin::core::{CostFunction, Executor, State};
use argmin::solver::brent::BrentOpt;

/// Relative error of a quantity that is on its target.
pub const ON_TARGET: f64 = 1e-10;

/// Most steps.
const STEPS: usize = 12;

/// Part of a step along the segment that is worth another linearisation.
const LEAST_STEP: f64 = 1e-3;

/// What the steps come to.
#[derive(Debug, Clone)]
pub(super) struct Settled {
    pub(super) program: Program,
    pub(super) solved: Solved,
    /// Largest relative error before the first step and after each.
    pub(super) errors: Vec<f64>,
    pub(super) programs: usize,
    pub(super) iterations: usize,
}

/// What the steps are taken with.
pub(super) struct Settling<'a> {
    pub(super) surface: &'a FairSurface,
    pub(super) constraints: &'a [Constraint],
    pub(super) model: &'a Model,
    pub(super) smoother: &'a Smoother,
    pub(super) lambda: f64,
    pub(super) solver: &'a Settings,
}

/// The largest relative error of what is not linear along a segment of nets.
struct Segment<'a> {
    settling: &'a Settling<'a>,
    from: &'a [f64],
    to: &'a [f64],
}

impl Segment<'_> {
    fn at(&self, t: f64) -> Vec<f64> {
        self.from.iter().zip(self.to).map(|(a, b)| a + t * (b - a)).collect()
    }
}

impl CostFunction for Segment<'_> {
    type Param = f64;
    type Output = f64;

    fn cost(&self, t: &f64) -> Result<f64, argmin::core::Error> {
        self.settling.error(&self.at(*t)).map_err(argmin::core::Error::new)
    }
}

impl Settling<'_> {
    fn curved(&self) -> impl Iterator<Item = (usize, &Constraint)> {
        self.constraints.iter().enumerate().filter(|(_, constraint)| !constraint.is_linear())
    }

    fn error(&self, net: &[f64]) -> Result<f64, RefreshError> {
        let hull = self.surface.hull_of(net)?;
        let off = |(_, constraint): (usize, &Constraint)| {
            let scale = constraint.scale(&hull);
            ((constraint.value(&hull) - constraint.target()) / scale).abs()
        };
        Ok(self.curved().map(off).fold(0.0, f64::max))
    }

    /// Steps from an answer; none where every constraint is linear.
    pub(super) fn run(&self, program: &Program, solved: &Solved) -> Result<Option<Settled>, RefreshError> {
        if self.curved().next().is_none() {
            return Ok(None);
        }
        let mut settled = Settled {
            program: program.clone(),
            solved: solved.clone(),
            errors: vec![self.error(&solved.net)?],
            programs: 0,
            iterations: 0,
        };
        let mut net = solved.net.clone();
        let mut error = settled.errors[0];
        for _ in 0..STEPS {
            if error <= ON_TARGET {
                break;
            }
            let hull = self.surface.hull_of(&net)?;
            let rows = self.curved().map(|(k, constraint)| (RowName::Constraint(k), constraint.limit(&hull)));
            let candidate = settled.program.with_rows(&rows.collect::<Vec<_>>(), &self.smoother.reduced);
            let answer = candidate.solve(self.model, self.smoother, self.lambda, self.solver)?;
            settled.programs += 1;
            settled.iterations += answer.solution.iterations;
            if !answer.is_optimal() {
                break;
            }
            let whole = self.error(&answer.net)?;
            if whole <= 0.5 * error {
                (net, error) = (answer.net.clone(), whole);
                (settled.program, settled.solved) = (candidate, answer);
                settled.errors.push(error);
                continue;
            }
            let segment = Segment { settling: self, from: &net, to: &answer.net };
            let search = Executor::new(segment, BrentOpt::new(0.0, 1.0)).configure(|state| state.max_iters(20)).run();
            let found = search.ok().and_then(|run| Some((*run.state().get_best_param()?, run.state().get_best_cost())));
            let Some((t, least)) = found.filter(|(t, least)| *t > LEAST_STEP && *least < error) else { break };
            let segment = Segment { settling: self, from: &net, to: &answer.net };
            (net, error) = (segment.at(t), least);
            settled.errors.push(error);
        }
        Ok(Some(settled))
    }
}
