//! From the energy of the parameters, or of the start's metric, to that of true curvature: the metric is frozen at the
//! net, the program solved, and again.
//!
//! F(c) = sum w r^2 + mu E_true(c; c), where the first step chooses mu so that the energy weighs at the answer what the
//! first one weighed. A step is accepted while F falls by more than `FALL`; the tolerances and the signs of the program
//! bound it. Every step is a convex program with its certificate; where the first step does not lower F the convex
//! answer stands.

use super::model::Model;
use super::program::{Program, Solved};
use super::smoothing::Smoother;
use super::surface::FairSurface;
use crate::hull::HullError;
use crate::qp::{ProblemError, Settings};

/// Most steps.
const STEPS: usize = 5;

/// Least part by which a step lowers the functional.
const FALL: f64 = 1e-5;

/// Why a metric could not be frozen.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum RefreshError {
    /// The numbers make no program.
    #[error(transparent)]
    Problem(#[from] ProblemError),
    /// The net makes no hull.
    #[error(transparent)]
    Hull(#[from] HullError),
}

/// An accepted step.
#[derive(Debug, Clone)]
pub struct Refreshed {
    /// The model with the energy of the last metric.
    pub model: Model,
    /// Its smoothing problem.
    pub smoother: Smoother,
    /// The weight of its energy.
    pub lambda: f64,
    /// The program.
    pub program: Program,
    /// Its answer.
    pub solved: Solved,
    /// F at the start and after each accepted step.
    pub functional: Vec<f64>,
    /// Programs solved.
    pub programs: usize,
    /// Iterations of the solver.
    pub iterations: usize,
}

/// Steps from an answer with the parametric energy; none when the first does not lower the functional.
pub(super) fn refresh(
    surface: &FairSurface,
    smoother: &Smoother,
    lambda: f64,
    program: &Program,
    solved: &Solved,
    solver: &Settings,
) -> Result<Option<Refreshed>, RefreshError> {
    let model = &surface.model;
    let frozen = |net: &[f64]| -> Result<Model, RefreshError> {
        let hull = surface.hull_of(net)?;
        Ok(Model { energy: surface.true_energy(hull.surface()), ..model.clone() })
    };
    let misfit = |net: &[f64]| model.misfit(net, smoother.weights());
    let mut next = frozen(&solved.net)?;
    let charged = lambda * smoother.unit * model.quadratic_of(&solved.net);
    let first = next.quadratic_of(&solved.net);
    if first <= 0.0 || charged <= 0.0 {
        return Ok(None);
    }
    let mu = charged / first;
    let mut functional = vec![misfit(&solved.net) + mu * first];
    let mut best: Option<Refreshed> = None;
    let (mut programs, mut iterations) = (0, 0);
    for _ in 0..STEPS {
        let smoother = Smoother::new(&next).reweighted(smoother.weights());
        let lambda = mu / smoother.unit;
        let candidate = program.with_objective(&smoother, lambda);
        let answer = candidate.solve(&smoother, lambda, solver)?;
        programs += 1;
        iterations += answer.solution.iterations;
        if !answer.is_optimal() {
            break;
        }
        let metric = frozen(&answer.net)?;
        let value = misfit(&answer.net) + mu * metric.quadratic_of(&answer.net);
        let last = functional[functional.len() - 1];
        if value.is_nan() || value >= last * (1.0 - FALL) {
            break;
        }
        functional.push(value);
        let model = std::mem::replace(&mut next, metric);
        best = Some(Refreshed {
            model,
            smoother,
            lambda,
            program: candidate,
            solved: answer,
            functional: functional.clone(),
            programs,
            iterations,
        });
    }
    Ok(best.map(|best| Refreshed { programs, iterations, ..best }))
}
