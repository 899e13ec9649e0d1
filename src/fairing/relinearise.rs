//! Quantities that are not linear in the net, metacentre and wetted surface: linearised, solved, linearised at the
//! answer, until the quantity itself is on its target.
//!
//! Each step is a convex program over all other rows of the last one; the segment from net to answer is the region of
//! trust, since every point of it keeps whatever the two ends keep. Where the whole step does not lower the largest
//! relative error, Brent's method (argmin) finds the point of the segment with the least one, and the next tangents are
//! taken there. After some steps the tangents stay and only their bounds are moved, by Broyden's method on the errors
//! (1965): about the keel of a hull whose sections leave it horizontally the wetted surface is hardly smooth, so that
//! tangents there never come to rest. What stands at the end is the answer of a whole step, optimal for the rows of
//! that step, whose certificate it has; where the tangents have come to rest it is a stationary point of the true
//! problem.

use super::constraint::Constraint;
use super::error::FairError;
use super::model::Limit;
use super::program::{Program, RowName, Solved};
use super::smoothing::Smoother;
use super::surface::FairSurface;
use crate::qp::Settings;
use argmin::core::{CostFunction, Executor, State};
use argmin::solver::brent::BrentOpt;
use nalgebra::{DMatrix, DVector};

/// Relative error of a quantity that is on its target.
pub const ON_TARGET: f64 = 1e-10;

/// Most steps.
const STEPS: usize = 16;

/// Steps with tangents of their own, at least.
const TANGENTS: usize = 3;

/// Part of a step along the segment that is worth another linearisation.
const LEAST_STEP: f64 = 1e-3;

/// Greatest part of an error that a whole step may leave.
const MOST_LEFT: f64 = 0.9;

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

fn largest(errors: &[f64]) -> f64 {
    errors.iter().fold(0.0, |most, error| most.max(error.abs()))
}

impl Settling<'_> {
    fn curved(&self) -> impl Iterator<Item = (usize, &Constraint)> {
        self.constraints.iter().enumerate().filter(|(_, constraint)| !constraint.is_linear())
    }

    /// Relative errors of what is not linear, with their signs.
    fn errors(&self, net: &[f64]) -> Result<Vec<f64>, FairError> {
        let hull = self.surface.hull_of(net)?;
        let off = |(_, constraint): (usize, &Constraint)| {
            (constraint.value(&hull) - constraint.target()) / constraint.scale(&hull)
        };
        Ok(self.curved().map(off).collect())
    }

    fn error(&self, net: &[f64]) -> Result<f64, FairError> {
        Ok(largest(&self.errors(net)?))
    }

    /// Steps from an answer; none where every constraint is linear.
    pub(super) fn run(&self, program: &Program, solved: &Solved) -> Result<Option<Settled>, FairError> {
        if self.curved().next().is_none() {
            return Ok(None);
        }
        let mut errors = self.errors(&solved.net)?;
        let mut settled = Settled {
            program: program.clone(),
            solved: solved.clone(),
            errors: vec![largest(&errors)],
            programs: 0,
            iterations: 0,
        };
        let mut best = largest(&errors);
        let mut net = solved.net.clone();
        let mut rows: Vec<(RowName, Limit)> = Vec::new();
        // What the errors do when the bounds are moved: a tangent moves with its bound.
        let mut answer_to = DMatrix::identity(errors.len(), errors.len());
        let mut whole_step = false;
        for step in 0..STEPS {
            if best <= ON_TARGET {
                break;
            }
            let mut moved = None;
            if step >= TANGENTS && whole_step {
                let wanted = -DVector::from_vec(errors.clone());
                let Some(shift) = answer_to.clone().lu().solve(&wanted) else { break };
                for ((_, limit), shift) in rows.iter_mut().zip(shift.iter()) {
                    limit.lower += shift;
                    limit.upper += shift;
                }
                moved = Some(shift);
            } else {
                let hull = self.surface.hull_of(&net)?;
                rows = self.curved().map(|(k, constraint)| (RowName::Constraint(k), constraint.limit(&hull))).collect();
            }
            let candidate = settled.program.with_rows(&rows, &self.smoother.reduced);
            let answer = candidate.solve(self.smoother, self.lambda, self.solver)?;
            settled.programs += 1;
            settled.iterations += answer.solution.iterations;
            if !answer.is_optimal() {
                break;
            }
            let found = self.errors(&answer.net)?;
            if let Some(shift) = moved {
                let change = DVector::from_iterator(found.len(), found.iter().zip(&errors).map(|(a, b)| a - b));
                let missed = change - &answer_to * &shift;
                answer_to += missed * shift.transpose() / shift.norm_squared().max(f64::MIN_POSITIVE);
            } else if largest(&found) > MOST_LEFT * largest(&errors) {
                let segment = Segment { settling: self, from: &net, to: &answer.net };
                let search =
                    Executor::new(segment, BrentOpt::new(0.0, 1.0)).configure(|state| state.max_iters(20)).run();
                let part = search.ok().and_then(|run| run.state().get_best_param().copied());
                if let Some(part) = part.filter(|part| *part > LEAST_STEP) {
                    net = Segment { settling: self, from: &net, to: &answer.net }.at(part);
                    (errors, whole_step) = (self.errors(&net)?, false);
                    continue;
                }
            }
            (net, errors, whole_step) = (answer.net.clone(), found, true);
            settled.errors.push(largest(&errors));
            if largest(&errors) < best {
                best = largest(&errors);
                (settled.program, settled.solved) = (candidate, answer);
            }
        }
        if settled.errors.last().is_some_and(|last| *last > best) {
            settled.errors.push(best);
        }
        Ok(Some(settled))
    }
}
