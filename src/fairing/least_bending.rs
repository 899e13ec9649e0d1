//! The least bending energy of a surface within the rows of a program, exactly: not that of a frozen metric.
//!
//! J(c) = x'P x / 2 + q'x + mu F(c) with F of [`super::bending`] and x the free half-breadths c. Each step minimises
//! the quadratic model of J without its negative part over the same rows, a convex program with its certificate, and is
//! halved until J falls by a part of what the model promises (Armijo 1966): the points between two that keep linear
//! rows keep them. Where a step promises nothing more the point is stationary for the true problem (sequential
//! quadratic programming: Nocedal and Wright, Numerical Optimization, 2006, 18.1).

use super::bending::{BendingModel, bending_energy};
use super::refresh::RefreshError;
use super::surface::surface_with;
use crate::numeric::SymmetricBand;
use crate::qp::{Problem, RepeatedSolver, Settings, Solution, SparseRows, Status};
use crate::spline::BsplineSurface;

/// Most steps.
const STEPS: usize = 40;

/// Part of mu F below which what a step promises is nothing.
const NOTHING: f64 = 1e-10;

/// Part of what the model promises that a step must bring.
const ARMIJO: f64 = 1e-4;

/// Part of the bending energy that a step changes from which the next one gains nothing from its solution.
const FAR: f64 = 1e-2;

/// Most halvings of a step.
const HALVINGS: usize = 12;

/// Where the steps end.
#[derive(Debug, Clone)]
pub struct LeastBending {
    /// All half-breadths of the net \[m\].
    pub net: Vec<f64>,
    /// int (k1^2 + k2^2) dA at the first point that keeps the rows and after each step: J falls with each.
    pub energies: Vec<f64>,
    /// What the last step still promised, over mu F.
    pub promised: f64,
    /// The last program.
    pub problem: Problem,
    /// Its answer; its multipliers are those of the true problem where nothing is promised.
    pub solution: Solution,
    /// Programs solved.
    pub programs: usize,
    /// Iterations of the solver, all programs together.
    pub iterations: usize,
}

impl LeastBending {
    /// From what to what it fell, in how many programs, and whether it came to rest.
    #[must_use]
    pub fn words(&self) -> String {
        let [first, last] = [self.energies[0], self.energies[self.energies.len() - 1]];
        let rest = if self.is_at_rest() { "and is least" } else { "and had not come to rest" };
        format!(
            "bending energy, the integral of k1^2 + k2^2 over the surface: {first:.6} > {last:.6} in {} programs {rest}; the last promised \
             {:.0e} of it",
            self.programs,
            self.promised.max(0.0)
        )
    }

    /// Whether the last step promised nothing more.
    #[must_use]
    pub fn is_at_rest(&self) -> bool {
        self.promised <= NOTHING
    }
}

/// P + factor M over the free values.
fn sum(p: &SparseRows, m: &SymmetricBand, free: &[usize], factor: f64) -> SparseRows {
    let mut entries = Vec::with_capacity(p.entry_count() + free.len() * (m.width() + 1));
    for (k, &i) in free.iter().enumerate() {
        let (columns, values) = p.row(k);
        entries.extend(columns.iter().zip(values).map(|(&l, &value)| (k, l, value)));
        let first = free[..k].partition_point(|&j| j + m.width() < i);
        for (l, &j) in free.iter().enumerate().take(k + 1).skip(first) {
            let value = m.get(i, j);
            if value != 0.0 || l == k {
                entries.push((k, l, factor * value));
                if l != k {
                    entries.push((l, k, factor * value));
                }
            }
        }
    }
    SparseRows::from_entries(free.len(), free.len(), &entries)
}

/// Minimises mu F(c) + x'P x / 2 + q'x, where `rest` gives P, q and the rows over the half-breadths `free` of the net,
/// rising indices of its points, and `factor` is mu \[m^2\]. `kept` says that the surface keeps the rows itself. None
/// where the chart folds, where the first program has no answer, or where its answer is no step.
///
/// # Errors
/// [`RefreshError`] when numbers make no program or no surface.
///
/// # Panics
/// When `free` has an index beyond the net.
pub fn least_bending(
    surface: &BsplineSurface<3>,
    rest: &Problem,
    factor: f64,
    free: &[usize],
    kept: bool,
    settings: &Settings,
) -> Result<Option<LeastBending>, RefreshError> {
    let at = |net: &[f64]| surface_with(surface, net);
    let mut net: Vec<f64> = surface.points().iter().map(|point| point[1]).collect();
    let mut solver = RepeatedSolver::new(settings);
    let mut x: Vec<f64> = free.iter().map(|&i| net[i]).collect();
    let Some(mut energy) = bending_energy(surface) else { return Ok(None) };
    let mut energies = if kept { vec![energy] } else { Vec::new() };
    let mut last = None;
    let (mut programs, mut iterations) = (0, 0);
    for _ in 0..STEPS {
        let Some(model) = BendingModel::new(&at(&net)?) else { break };
        let mut moved = vec![0.0; net.len()];
        free.iter().zip(&x).for_each(|(&i, &value)| moved[i] = value);
        let turned = model.curved.apply(&moved);
        let slope = free.iter().map(|&i| factor * (model.gradient[i] - turned[i]));
        let problem = Problem {
            quadratic: sum(&rest.quadratic, &model.curved, free, factor),
            linear: rest.linear.iter().zip(slope).map(|(q, g)| q + g).collect(),
            rows: rest.rows.clone(),
            lower: rest.lower.clone(),
            upper: rest.upper.clone(),
        };
        let solution = solver.solve(&problem)?;
        programs += 1;
        iterations += solution.iterations;
        if solution.status != Status::Optimal {
            break;
        }
        let value = rest.objective(&x) + factor * energy;
        let promised = problem.objective(&x) - problem.objective(&solution.x);
        let step: Vec<f64> = solution.x.iter().zip(&x).map(|(new, old)| new - old).collect();
        let first = energies.is_empty();
        let mut part = 1.0;
        let mut taken = None;
        for _ in 0..HALVINGS {
            let next: Vec<f64> = x.iter().zip(&step).map(|(x, d)| x + part * d).collect();
            let mut all = net.clone();
            free.iter().zip(&next).for_each(|(&i, &value)| all[i] = value);
            let Some(bent) = bending_energy(&at(&all)?) else {
                part *= 0.5;
                continue;
            };
            let falls = value - (rest.objective(&next) + factor * bent);
            // What breaks the rows is left by a whole step alone.
            if (first && part >= 1.0) || (!first && falls >= ARMIJO * part * promised) {
                taken = Some((next, all, bent));
                break;
            }
            part *= 0.5;
        }
        let settled = !first && promised <= NOTHING * factor * energy;
        let mut solution = solution;
        if let Some((next, all, bent)) = taken {
            // The certificate is that of the point where it stands.
            solution.x.clone_from(&next);
            if first || (energy - bent).abs() > FAR * energy {
                solver.forget();
            }
            (x, net, energy) = (next, all, bent);
            energies.push(energy);
        } else if !settled {
            break;
        }
        last = Some((promised / (factor * energy), problem, solution));
        if settled {
            break;
        }
    }
    Ok(last.map(|(promised, problem, solution)| LeastBending {
        net,
        energies,
        promised,
        problem,
        solution,
        programs,
        iterations,
    }))
}
