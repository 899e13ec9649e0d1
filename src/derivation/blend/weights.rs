//! The weights of hulls on one chart that meet targets, and how far the targets reach.
//!
//! ```text
//! minimise    1/2 sum (w_i - 1/k)^2 + 1/2 sum s_j^2,      s_j = ln(dimension / its value before)
//! subject to  w >= 0,  sum w = 1,  r_q(w, s) = 0          one equation for each target
//! ```
//!
//! by successive quadratic programs: the residuals r are relative, their derivatives are differences along the ways from the
//! blend to each hull. Where the profiles are the same, volume, moments and areas are linear in the weights, and one step
//! is enough. A last correction of least size over the weights above zero leaves residuals of rounding. Searches go over
//! polynomials of the weights ([`Model`]); the last correction and the ends of intervals are integrated.

use nalgebra::{DMatrix, DVector};

use super::super::affine::scaled;
use super::super::limits::Interval;
use super::super::quantity::{Quantity, Reference, value_of};
use super::super::request::{Dimensions, Request, Target};
use super::Dimension;
use super::model::Model;
use crate::hull::{Hull, HullError};
use crate::hydrostatics::Conventions;
use crate::qp::{Problem, Settings, SparseRows, Status};
use crate::spline::{BsplineCurve, BsplineSurface};

/// Step of the differences, in parts of the way to a hull and of the logarithm of a dimension.
const STEP: f64 = 1e-5;
/// Most programs.
const STEPS: usize = 40;
/// Parts of the way to the targets that a step tries.
const PARTS: [f64; 4] = [1.0, 0.5, 0.2, 0.05];
/// Relative residual from which the last correction takes over.
const NEAR: f64 = 1e-6;
/// Relative residual at which a target is met.
pub(super) const MET: f64 = 1e-10;
/// A weight below this is none.
const NO_WEIGHT: f64 = 1e-12;
/// Largest logarithm of the change of a free dimension: a factor of 1.5.
const MOST_CHANGE: f64 = 0.405_465_108_108_164_4;
/// Relative residual of the others at which an end of an interval counts.
const AT_END: f64 = 1e-7;
/// Most corrections of a mix.
const CORRECTIONS: usize = 10;
/// Most linear programs for the end of an interval.
const PROGRAMS_OF_END: usize = 12;

/// Weights and logarithms of the changes of the free dimensions.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Mix {
    pub(super) weights: Vec<f64>,
    pub(super) changes: Vec<f64>,
}

/// What is blended.
pub(super) struct Blending<'a> {
    pub(super) hulls: &'a [Hull],
    pub(super) request: &'a Request,
    pub(super) free: &'a [Dimension],
    pub(super) conventions: &'a Conventions,
    pub(super) quantities: Vec<Quantity>,
    /// The values over weights and dimensions by polynomials, where there are some.
    pub(super) model: Option<&'a Model>,
}

/// Why there are no weights.
pub(super) enum Failed {
    /// No weights meet the targets.
    Infeasible,
    /// The steps came to no end, with this relative residual.
    Astray(f64),
    /// A blend is no hull.
    Hull(HullError),
}

impl From<HullError> for Failed {
    fn from(error: HullError) -> Self {
        Self::Hull(error)
    }
}

/// sum of w_i times the nets and the decks of hulls on one chart.
pub(super) fn mixed(hulls: &[Hull], weights: &[f64]) -> Result<Hull, HullError> {
    let first = &hulls[0];
    let used: Vec<(&Hull, f64)> = hulls.iter().zip(weights.iter().copied()).filter(|(_, w)| *w != 0.0).collect();
    fn sum<const D: usize>(used: &[(&Hull, f64)], points: impl Fn(&Hull) -> &[[f64; D]]) -> Vec<[f64; D]> {
        let count = used.first().map_or(0, |(hull, _)| points(hull).len());
        let mut total = vec![[0.0; D]; count];
        for (hull, weight) in used {
            for (total, point) in total.iter_mut().zip(points(hull)) {
                total.iter_mut().zip(point).for_each(|(t, p)| *t += weight * p);
            }
        }
        total
    }
    let surface = first.surface();
    let surface =
        BsplineSurface::new(surface.u().clone(), surface.v().clone(), sum(&used, |hull| hull.surface().points()))?;
    let deck = BsplineCurve::new(first.deck().knots().clone(), sum(&used, |hull| hull.deck().points()))?;
    Hull::new(first.name(), *first.particulars(), surface, deck)
}

impl Blending<'_> {
    /// The mix to which the answer is nearest.
    fn even(&self) -> Mix {
        let count = self.hulls.len();
        Mix { weights: vec![1.0 / count as f64; count], changes: vec![0.0; self.free.len()] }
    }

    /// The hull of a mix.
    pub(super) fn hull(&self, mix: &Mix) -> Result<Hull, Failed> {
        let hull = mixed(self.hulls, &mix.weights)?;
        if self.free.is_empty() {
            return Ok(hull);
        }
        let p = *hull.particulars();
        let mut dimensions = Dimensions::default();
        for (dimension, change) in self.free.iter().zip(&mix.changes) {
            match dimension {
                Dimension::Length => dimensions.length = Some(p.length_between_perpendiculars * change.exp()),
                Dimension::Breadth => dimensions.breadth = Some(p.breadth * change.exp()),
                Dimension::Draught => dimensions.draught = p.draught.map(|t| t * change.exp()),
            }
        }
        // A refusal is one of the depth: the deck comes too near to the waterline.
        scaled(&hull, &dimensions).map_err(|_| Failed::Infeasible)
    }

    /// What a hull is asked for; targets in parts of dimensions follow them.
    pub(super) fn targets(&self, hull: &Hull) -> Option<(Reference, Vec<Target>)> {
        let reference = Reference::of(hull, self.conventions)?;
        let targets = self.quantities.iter().map(|quantity| {
            let value = self.request.stated(*quantity, &reference)?;
            Some(Target { quantity: *quantity, value, origin: super::super::request::Origin::Given })
        });
        Some((reference, targets.collect::<Option<Vec<_>>>()?))
    }

    /// Relative residuals of the targets of a hull, and the value of another quantity as it is stated.
    fn integrated(&self, hull: &Hull, also: Option<Quantity>) -> Result<Reached, Failed> {
        let Some((reference, targets)) = self.targets(hull) else { return Err(Failed::Infeasible) };
        let values = targets.iter().map(|target| value_of(target.quantity, hull, &reference));
        let value = also.map(|quantity| self.measured(quantity, value_of(quantity, hull, &reference), &reference));
        Ok(Reached { residuals: residuals(&reference, &targets, values), value })
    }

    /// The same of a mix; by polynomials where there are some and it need not be `exact`.
    fn reached(&self, mix: &Mix, also: Option<Quantity>, exact: bool) -> Result<Reached, Failed> {
        let Some(model) = self.model.filter(|_| !exact) else { return self.integrated(&self.hull(mix)?, also) };
        let Some((reference, values, targets)) = model.reached(self, mix, &self.quantities) else {
            return Err(Failed::Infeasible);
        };
        let of_model = |quantity: Quantity| Some(model.reached(self, mix, &[quantity])?.1[0]);
        let value = also.and_then(of_model).zip(also).map(|(value, of)| self.measured(of, value, &reference));
        Ok(Reached { residuals: residuals(&reference, &targets, values.into_iter()), value })
    }

    /// A mix so far along one of the ways: towards a hull, or a change of a free dimension.
    fn along(&self, mix: &Mix, way: usize, step: f64) -> Mix {
        let mut moved = mix.clone();
        let count = self.hulls.len();
        if way < count {
            moved.weights.iter_mut().for_each(|w| *w *= 1.0 - step);
            moved.weights[way] += step;
        } else {
            moved.changes[way - count] += step;
        }
        moved
    }

    /// What a mix comes to, with the derivatives of residuals by every way, one row a target, and those of the value.
    fn tangents(&self, mix: &Mix, also: Option<Quantity>) -> Result<Tangents, Failed> {
        let ways = self.hulls.len() + self.free.len();
        let at = self.reached(mix, also, false)?;
        let mut slopes = DMatrix::zeros(at.residuals.len(), ways);
        let mut of_value = vec![0.0; ways];
        for way in 0..ways {
            let [back, ahead] = [-STEP, STEP].map(|step| self.reached(&self.along(mix, way, step), also, false));
            let (back, ahead) = (back?, ahead?);
            for k in 0..at.residuals.len() {
                slopes[(k, way)] = (ahead.residuals[k] - back.residuals[k]) / (2.0 * STEP);
            }
            of_value[way] = back.value.zip(ahead.value).map_or(0.0, |(back, ahead)| (ahead - back) / (2.0 * STEP));
        }
        Ok(Tangents { at, slopes, of_value })
    }

    /// The program of a step: to the nearest mix, or in the direction of `towards`.
    fn step(&self, mix: &Mix, at: &[f64], slopes: &DMatrix<f64>, towards: Option<&[f64]>) -> Result<Mix, Failed> {
        let count = self.hulls.len();
        let ways = count + self.free.len();
        let (mut rows, mut lower, mut upper) = (SparseRows::new(ways), Vec::new(), Vec::new());
        let mut bound = |row: Vec<(usize, f64)>, low: f64, high: f64| {
            rows.push(row);
            lower.push(low);
            upper.push(high);
        };
        bound((0..count).map(|i| (i, 1.0)).collect(), 0.0, 0.0);
        for (k, residual) in at.iter().enumerate() {
            let size = (0..ways).map(|i| slopes[(k, i)].abs()).fold(1e-12, f64::max);
            bound((0..ways).map(|i| (i, slopes[(k, i)] / size)).collect(), -residual / size, -residual / size);
        }
        for (i, weight) in mix.weights.iter().enumerate() {
            bound(vec![(i, 1.0)], -weight, f64::INFINITY);
        }
        for (j, change) in mix.changes.iter().enumerate() {
            bound(vec![(count + j, 1.0)], -MOST_CHANGE - change, MOST_CHANGE - change);
        }
        let (quadratic, linear) = match towards {
            Some(direction) => (SparseRows::from_entries(ways, ways, &[]), direction.to_vec()),
            None => {
                let even = self.even();
                let entries: Vec<(usize, usize, f64)> = (0..ways).map(|i| (i, i, 1.0)).collect();
                let from = mix.weights.iter().zip(&even.weights).map(|(w, e)| w - e);
                (SparseRows::from_entries(ways, ways, &entries), from.chain(mix.changes.iter().copied()).collect())
            }
        };
        let problem = Problem { squares: SparseRows::new(linear.len()), quadratic, linear, rows, lower, upper };
        let solution =
            problem.solve(&Settings { tolerance: 1e-11, ..Settings::default() }).map_err(|_| Failed::Infeasible)?;
        let violation = problem.certificate(&solution.x, &solution.multipliers, 0.0).max_violation;
        if matches!(solution.status, Status::Infeasible | Status::Unbounded) || violation > 1e-7 {
            return Err(Failed::Infeasible);
        }
        let weights: Vec<f64> = mix.weights.iter().zip(&solution.x).map(|(w, d)| w + d).collect();
        let weights: Vec<f64> = weights.into_iter().map(|w| if w < NO_WEIGHT { 0.0 } else { w }).collect();
        let total: f64 = weights.iter().sum();
        Ok(Mix {
            weights: weights.into_iter().map(|w| w / total).collect(),
            changes: mix.changes.iter().zip(&solution.x[count..]).map(|(c, d)| c + d).collect(),
        })
    }

    /// The mix nearest to equal weights that meets the targets.
    pub(super) fn solve(&self) -> Result<Mix, Failed> {
        let (mix, left) = self.corrected(self.found()?, true)?;
        if left > MET { Err(Failed::Astray(left)) } else { Ok(mix) }
    }

    /// The same before the last correction.
    fn found(&self) -> Result<Mix, Failed> {
        let mut mix = self.even();
        let mut last = f64::INFINITY;
        let left = |mix: &Mix| Ok::<_, Failed>(size(&self.reached(mix, None, false)?.residuals));
        for _ in 0..STEPS {
            let Tangents { at, slopes, .. } = self.tangents(&mix, None)?;
            // Tangents may leave no way to the targets that the blends themselves have: a part of it then.
            let part = |part: f64| at.residuals.iter().map(|residual| part * residual).collect::<Vec<_>>();
            let steps = PARTS.iter().map(|way| self.step(&mix, &part(*way), &slopes, None));
            let next = steps.into_iter().find(Result::is_ok).unwrap_or(Err(Failed::Infeasible))?;
            let moved = next.weights.iter().zip(&mix.weights).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            mix = next;
            last = moved;
            if moved < 0.1 * NEAR && left(&mix)? < NEAR {
                break;
            }
        }
        if last > 1e-3 || left(&mix)? > 1e-4 { Err(Failed::Infeasible) } else { Ok(mix) }
    }

    /// Corrections of least size over the weights that are above zero and the free dimensions; the residual that is left, which is
    /// integrated where it is to be `exact`.
    fn corrected(&self, mut mix: Mix, exact: bool) -> Result<(Mix, f64), Failed> {
        let mut best = (mix.clone(), f64::INFINITY);
        for _ in 0..CORRECTIONS {
            let Tangents { at, slopes, .. } = self.tangents(&mix, None)?;
            let at = if exact && self.model.is_some() { self.reached(&mix, None, true)? } else { at }.residuals;
            let left = size(&at);
            if left < best.1 {
                best = (mix.clone(), left);
            }
            if left < 0.01 * MET {
                break;
            }
            let count = self.hulls.len();
            let ways: Vec<usize> = (0..slopes.ncols()).filter(|i| *i >= count || mix.weights[*i] > 0.0).collect();
            let sum = at.len();
            let rows = DMatrix::from_fn(sum + 1, ways.len(), |k, i| match (k == sum, ways[i] < count) {
                (false, _) => slopes[(k, ways[i])],
                (true, of_hull) => f64::from(u8::from(of_hull)),
            });
            let wanted = DVector::from_fn(sum + 1, |k, _| if k == sum { 0.0 } else { -at[k] });
            let Ok(change) = rows.svd(true, true).solve(&wanted, 1e-14) else { break };
            for (way, change) in ways.iter().zip(change.iter()) {
                if *way < count {
                    mix.weights[*way] = (mix.weights[*way] + change).max(0.0);
                } else {
                    mix.changes[way - count] += change;
                }
            }
            let total: f64 = mix.weights.iter().sum();
            mix.weights.iter_mut().for_each(|w| *w /= total);
        }
        Ok(best)
    }

    /// A value as it is stated: volumes as C_B, and centres in parts of L_PP, where the request states them so.
    pub(super) fn measured(&self, quantity: Quantity, value: f64, reference: &Reference) -> f64 {
        value / self.measure(quantity, reference)
    }

    /// The unit of that value.
    pub(super) fn measure(&self, quantity: Quantity, reference: &Reference) -> f64 {
        let in_parts = |centre: Option<[f64; 2]>| centre.is_some_and(|[share, _]| share != 0.0);
        match quantity {
            Quantity::Volume if self.request.block_coefficient.is_some() => reference.volume(),
            Quantity::Lcb if in_parts(self.request.centres[0]) => reference.between,
            Quantity::Lcf if in_parts(self.request.centres[1]) => reference.between,
            _ => 1.0,
        }
    }

    /// What `quantity` can be with the other targets met, as it is stated; none where they alone are infeasible.
    pub(super) fn interval(&self, quantity: Quantity) -> Option<Interval> {
        let others = self.quantities.iter().copied().filter(|other| *other != quantity).collect();
        let rest = Blending { quantities: others, ..*self };
        let ends = [1.0, -1.0].map(|way| rest.extreme(quantity, way));
        let [Some(low), Some(high)] = ends else { return None };
        Some(Interval { quantity, low: low.min(high), high: low.max(high), keeps_signs: true })
    }

    /// The least value of a quantity, or the greatest for a `way` of -1, by successive linear programs.
    fn extreme(&self, quantity: Quantity, way: f64) -> Option<f64> {
        let value = |mix: &Mix, exact: bool| self.reached(mix, Some(quantity), exact).ok()?.value;
        let has_others = !self.quantities.is_empty();
        let mut mix = self.even();
        if has_others {
            mix = self.corrected(self.found().ok()?, false).ok()?.0;
        }
        let mut best = value(&mix, false)?;
        for _ in 0..PROGRAMS_OF_END {
            let Tangents { at, slopes, of_value } = self.tangents(&mix, Some(quantity)).ok()?;
            let size = of_value.iter().map(|s| s.abs()).fold(1e-300, f64::max);
            let towards: Vec<f64> = of_value.iter().map(|s| way * s / size).collect();
            let Ok(mut next) = self.step(&mix, &at.residuals, &slopes, Some(&towards)) else { break };
            if has_others {
                // The program meets the others by their tangents alone.
                let Ok((corrected, left)) = self.corrected(next, false) else { break };
                if left > AT_END {
                    break;
                }
                next = corrected;
            }
            let Some(found) = value(&next, false) else { break };
            if way * (best - found) <= 1e-12 * best.abs() {
                break;
            }
            (mix, best) = (next, found);
        }
        if has_others {
            let (corrected, left) = self.corrected(mix, true).ok()?;
            if left > AT_END {
                return None;
            }
            mix = corrected;
        }
        value(&mix, true)
    }
}

/// What a mix comes to.
struct Reached {
    /// Relative residuals of the targets.
    residuals: Vec<f64>,
    /// The value of another quantity, as it is stated.
    value: Option<f64>,
}

/// The same with derivatives by every way.
struct Tangents {
    at: Reached,
    slopes: DMatrix<f64>,
    of_value: Vec<f64>,
}

/// Relative residuals of targets, of centres over L_PP.
fn residuals(reference: &Reference, targets: &[Target], values: impl Iterator<Item = f64>) -> Vec<f64> {
    let residual = |(target, value): (&Target, f64)| match target.quantity {
        Quantity::Lcb | Quantity::Lcf => (value - target.value) / reference.between,
        _ => value / target.value - 1.0,
    };
    targets.iter().zip(values).map(residual).collect()
}

/// The largest of residuals.
fn size(residuals: &[f64]) -> f64 {
    residuals.iter().map(|r| r.abs()).fold(0.0, f64::max)
}
