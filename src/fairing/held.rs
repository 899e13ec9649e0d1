//! What a fair hull holds and what each wish costs: the same program without its rows.

use super::choice::trial;
use super::constraint::{Constraint, Rule};
use super::fair::{FairSettings, Faired};
use super::model::{Model, violated};
use super::program::{RowName, Solved};
use super::surface::FairSurface;
use crate::hull::Hull;
use crate::qp::{RepeatedSolver, Settings, Status};

/// A row nearer to its limit than this binds: \[m\], a slope, or a part of the row's size.
const BINDING: f64 = 1e-9;

/// A constraint and how it is held.
#[derive(Debug, Clone, PartialEq)]
pub struct Held {
    /// The constraint with its target.
    pub constraint: Constraint,
    /// How far the quantity may be from its target, in its unit: 0 for exactly.
    pub band: f64,
    /// Its quantity before, for the surface through the table.
    pub before: f64,
    /// Its quantity after.
    pub after: f64,
    /// What its error is measured in ([`Constraint::scale`]).
    pub scale: f64,
    /// Multiplier of its row \[m^2 per unit of the row\].
    pub multiplier: f64,
    /// Root of the mean square of what the readings move less when it is dropped \[m\]: what holding it costs; not a
    /// number where that was not found or not asked for.
    pub price: f64,
}

/// What an end may be off its target, relative, and still count as had.
const HAD: f64 = 1e-9;

impl Held {
    /// Whether its target is met, within its band.
    #[must_use]
    pub fn is_had(&self) -> bool {
        self.missed().abs() <= HAD * self.constraint.target().abs()
    }

    /// From where to where the quantity may be, in its unit.
    #[must_use]
    pub fn interval(&self) -> [f64; 2] {
        let target = self.constraint.target();
        [target - self.band, target + self.band]
    }

    /// By how much the quantity is above its interval (> 0) or below it, in its unit.
    #[must_use]
    pub fn missed(&self) -> f64 {
        let [low, high] = self.interval();
        self.after - self.after.clamp(low, high)
    }
}

/// A rule for a line or a region and how it is held.
#[derive(Debug, Clone, PartialEq)]
pub struct HeldRule {
    /// The rule.
    pub rule: Rule,
    /// Its rows in the program.
    pub rows: usize,
    /// Rows that bind.
    pub binding: usize,
    /// Largest violation of one of its rows: \[m\] of half-breadth, a slope, or for signs of curvature a part of the
    /// row's size.
    pub violation: f64,
    /// Largest multiplier of its rows \[m^2 per unit of the row\].
    pub multiplier: f64,
    /// Root of the mean square of what the readings move less when the rule is dropped \[m\]; not a number where that was
    /// not found or not asked for.
    pub price: f64,
    /// Whether it was given up, because it cannot be met with the others.
    pub given_up: bool,
}

impl HeldRule {
    /// A rule that was given up, with what the hull breaks it by; of a number of inflections, which has no rows until it
    /// is asked for, 0.
    pub(super) fn given_up(rule: &Rule, surface: &FairSurface, hull: &Hull) -> Self {
        let net: Vec<f64> = hull.surface().points().iter().map(|point| point[1]).collect();
        let violation = rule.limits(surface).into_iter().flatten().map(|limit| violated(&limit, &net));
        Self {
            rule: rule.clone(),
            rows: 0,
            binding: 0,
            violation: violation.fold(0.0, f64::max),
            multiplier: 0.0,
            price: 0.0,
            given_up: true,
        }
    }
}

/// Constraints, and what they cost where that is asked for (`priced`).
pub(super) fn constraints(
    surface: &FairSurface,
    settings: &FairSettings,
    faired: &Faired,
    [before, after]: [&Hull; 2],
    priced: bool,
) -> Vec<Held> {
    let (model, count) = (&surface.model, settings.constraints.len());
    let prices = if priced {
        // A price of a field that takes long is not worth waiting for.
        let solver = if surface.is_field { trial(&settings.solver) } else { settings.solver.clone() };
        faired.prices_of_constraints(model, count, &mut RepeatedSolver::new(&solver))
    } else {
        vec![f64::NAN; count]
    };
    let list = settings.constraints.iter().zip(prices).enumerate();
    list.map(|(k, (&constraint, price))| {
        let row = |name: RowName| name == RowName::Constraint(k);
        let multiplier = faired.rows(row).map(|at| faired.solved.solution.multipliers[at]).sum();
        let [before_value, after_value] = [before, after].map(|hull| constraint.value(hull));
        let scale = constraint.scale(before);
        let band = constraint.band() + settings.rooms[k];
        Held { constraint, band, before: before_value, after: after_value, scale, multiplier, price }
    })
    .collect()
}

/// Rules, and what they cost where that is asked for (`priced`); one that does not bind costs nothing.
pub(super) fn rules(surface: &FairSurface, settings: &FairSettings, faired: &Faired, priced: bool) -> Vec<HeldRule> {
    let multipliers = &faired.solved.solution.multipliers;
    let list = settings.rules.iter().enumerate();
    list.map(|(k, rule)| {
        let own = |name: RowName| name == RowName::Rule(k);
        let at: Vec<usize> = faired.rows(own).collect();
        let binding = at.iter().filter(|&&row| faired.binds(row)).count();
        let largest = at.iter().fold(0.0_f64, |most, &row| most.max(multipliers[row].abs()));
        let violation = faired
            .rules
            .iter()
            .filter(|(rule, _)| *rule == k)
            .fold(0.0_f64, |most, (_, limit)| most.max(violated(limit, &faired.net)));
        let price = match binding {
            0 => 0.0,
            _ if !priced => f64::NAN,
            _ => faired.price_of(&surface.model, own, &settings.solver),
        };
        HeldRule { rule: rule.clone(), rows: at.len(), binding, violation, multiplier: largest, price, given_up: false }
    })
    .collect()
}

impl Faired {
    /// Whether the answer is at a limit of a row ([`BINDING`]).
    fn binds(&self, row: usize) -> bool {
        let problem = &self.program.problem;
        let y = problem.rows.dot(row, &self.solved.solution.x);
        (y - problem.lower[row]).min(problem.upper[row] - y) <= BINDING * (1.0 + y.abs())
    }

    /// What rows cost \[m\]: how much the root of the mean square of the moves falls when they are dropped; not a number
    /// where the program without them was not solved.
    #[must_use]
    pub fn price_of(&self, model: &Model, these: impl Fn(RowName) -> bool, solver: &Settings) -> f64 {
        if self.rows(&these).next().is_none() {
            return 0.0;
        }
        let without = self.program.without(these);
        let solved = without.solve(&self.smoother, self.lambda, solver);
        solved
            .ok()
            .filter(Solved::is_optimal)
            .map_or(f64::NAN, |solved| self.moved(model, &self.net) - self.moved(model, &solved.net))
    }

    /// [`Faired::price_of`] each of the first `count` constraints of the whole hull: one solver, one row opened after
    /// the other. One that does not bind costs nothing; not a number where the program was not solved.
    #[must_use]
    pub fn prices_of_constraints(&self, model: &Model, count: usize, solver: &mut RepeatedSolver<'_>) -> Vec<f64> {
        let price = |k: usize| {
            let mut problem = self.program.problem.clone();
            let own: Vec<usize> = self.rows(|name| name == RowName::Constraint(k)).collect();
            // What is smoothed is not moved for a target that is not held.
            let less = self.without.iter().find(|(other, _)| *other == k);
            if less.is_none() && !own.iter().any(|&row| self.binds(row)) {
                return Some(0.0);
            }
            for row in own {
                (problem.lower[row], problem.upper[row]) = (f64::NEG_INFINITY, f64::INFINITY);
            }
            less.into_iter().for_each(|(_, less)| problem.linear.iter_mut().zip(less).for_each(|(b, more)| *b += more));
            let mut solution = solver.solve(&problem).ok()?;
            if solution.status != Status::Optimal {
                // From the answer with the constraint it may be too far.
                solver.forget();
                solution = solver.solve(&problem).ok()?;
            }
            let net = self.smoother.reduced.expand(&solution.x);
            (solution.status == Status::Optimal).then(|| self.moved(model, &self.net) - self.moved(model, &net))
        };
        (0..count).map(price).map(|price| price.unwrap_or(f64::NAN)).collect()
    }

    /// Root of the mean weighted square of what a net moves the readings by \[m\].
    fn moved(&self, model: &Model, net: &[f64]) -> f64 {
        let squares = model.misfit(net, self.smoother.weights());
        (squares / self.smoother.count().max(1) as f64).sqrt()
    }
}
