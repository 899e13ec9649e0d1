//! The interval of each target, the others given: what half-breadths on the chart of the daughter reach without passing the
//! centreplane or B/2, without sections or waterlines that pass each other, and with the signs of curvature of the parent.
//!
//! Linear programs, one for each end. Their answers are evaluated: an end is the value of a hull, which is feasible as far as
//! rounding goes. Ratios of two linear functions (LCB, LCF, KB, C_P) take a few programs, each with the ratio that the one before
//! came to (Dinkelbach 1967). KM and wetted surface are curved: from the hull that has the others, steps towards the answers of
//! linear programs, each as long as it is best (Frank and Wolfe 1956), come near a local end; values beyond it are tried by the
//! nearest hull. The limits of a daughter are those over three charts, her own and those of sections that are shifted as far as a
//! search shifts them either way.

use super::derive::{Job, OF_FOLD};
use super::nearest::{Search, breadths, solved, with_breadths};
use super::quantity::{Quantity, Reference, equation, value_of};
use super::request::{Origin, Target};
use super::shift::{Ends, LEVEL_FOLD, level, shifted};
use crate::hull::Hull;
use crate::numeric::join;
use crate::qp::Problem;

/// Most iterations of a linear program.
const ITERATIONS: usize = 100;
/// Most steps towards the end of what is not linear.
const STEPS: usize = 12;
/// Most steps to its best length, and the part of the first slope that is level there.
const ROOT_STEPS: usize = 8;
const LEVEL_ENOUGH: f64 = 1e-3;
/// Relative gain of a step below which it is the last.
const LAST_GAIN: f64 = 1e-6;
/// The same of the ratio of linear functions.
const LAST_RATIO: f64 = 1e-8;
/// First step beyond the end of what is not linear, in parts of it; most steps, and halvings of the last.
const FIRST_BEYOND: f64 = 1e-3;
const DOUBLINGS: usize = 6;
const HALVINGS: usize = 4;

/// What a quantity of the daughter can be while the others are as they are.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Interval {
    /// The quantity.
    pub quantity: Quantity,
    /// Its least value.
    pub low: f64,
    /// Its greatest value.
    pub high: f64,
    /// Whether the signs of curvature of the parent are kept all over it.
    pub keeps_signs: bool,
}

impl Interval {
    /// Whether a value is within it, by more than rounding.
    #[must_use]
    pub fn holds(&self, value: f64) -> bool {
        let slack = 1e-9 * self.low.abs().max(self.high.abs());
        (self.low - slack..=self.high + slack).contains(&value)
    }

    /// The value within it that is nearest.
    #[must_use]
    pub fn nearest(&self, value: f64) -> f64 {
        value.clamp(self.low, self.high)
    }

    /// The least interval that holds both.
    fn with(self, other: Self) -> Self {
        Self {
            low: self.low.min(other.low),
            high: self.high.max(other.high),
            keeps_signs: self.keeps_signs && other.keeps_signs,
            ..self
        }
    }
}

impl Job<'_> {
    /// What `quantity` can be with the `others`, on the chart of a start and on those of shifted sections; none where the others
    /// are infeasible on all.
    pub(super) fn limits(&self, start: &Hull, quantity: Quantity, others: &[Target]) -> Option<Interval> {
        let of = |chart: &Hull, keeps_signs: bool| {
            let mut search = Search::new(self.scaled, chart, &self.reference, others, self.body);
            if !keeps_signs {
                search.without_signs();
            }
            interval(&mut search, quantity, others, &self.reference)
        };
        let most = OF_FOLD * LEVEL_FOLD;
        let shifts: &[[f64; 2]] = match quantity {
            _ if self.body.is_some() => &[],
            Quantity::Volume | Quantity::PrismaticCoefficient => &[[most, most], [-most, -most]],
            Quantity::Lcb | Quantity::Lcf => &[[most, -most], [-most, most]],
            _ => &[],
        };
        let ends = Ends::inside(self.scaled, self.midship());
        let moved = |amplitudes: &[f64; 2]| shifted(self.scaled, &ends, &|side, t| level(t, amplitudes[side])).ok();
        let charts: Vec<Hull> = shifts.iter().filter_map(moved).collect();
        // A chart on which signs go is left out where others keep them.
        [true, false].into_iter().find_map(|keeps| {
            let moved = || charts.iter().filter_map(|chart| of(chart, keeps)).collect::<Vec<_>>();
            let (own, others) = join(|| of(start, keeps), moved);
            own.into_iter().chain(others).reduce(Interval::with)
        })
    }
}

/// The interval of `quantity` with the `others` given within the limits of a search; none where they alone are infeasible.
fn interval(search: &mut Search<'_>, quantity: Quantity, others: &[Target], reference: &Reference) -> Option<Interval> {
    let [low, high] = extremes(search, quantity)?;
    let found = Interval { quantity, low: low.min(high), high: high.max(low), keeps_signs: search.has_signs() };
    if Course::of(quantity, others) != Course::Curved {
        return Some(found);
    }
    let mut meets = |value: f64| {
        let own = Target { quantity, value, origin: Origin::Given };
        let targets = [others, &[own]].concat();
        let mut search = search.with_targets(&targets);
        let found = search.run().ok().map(|nearest| value_of(quantity, &nearest.hull, reference));
        found.is_some_and(|found| (found - value).abs() <= 1e-6 * value.abs())
    };
    Some(Interval { low: beyond(found.low, 1.0, &mut meets), high: beyond(found.high, -1.0, &mut meets), ..found })
}

/// The least and the greatest value of `quantity`, of one that is not linear near the hull that has the others.
fn extremes(search: &mut Search<'_>, quantity: Quantity) -> Option<[f64; 2]> {
    // The hull that has the others.
    let course = Course::of(quantity, search.targets);
    let at = if course == Course::Curved { breadths(&search.run().ok()?.hull) } else { search.base.clone() };
    // A linear program needs its limits from the beginning.
    search.take_all();
    let equations = search.equations(search.start);
    let n = search.freedom.points.len();
    let problem = search.problem(&equations, &search.base, Some(&vec![0.0; n]));
    let ends = [1.0, -1.0].map(|way| extreme(search, problem.clone(), (quantity, course), &at, way));
    search.take_none();
    let [low, high] = ends;
    Some([low?, high?])
}

/// The least value of `quantity` from `at` on, or the greatest for a `way` of -1.
fn extreme(
    search: &Search<'_>,
    mut problem: Problem,
    (quantity, course): (Quantity, Course),
    at: &[f64],
    way: f64,
) -> Option<f64> {
    let (start, reference) = (search.start, search.reference);
    let hull_of = |y: &[f64]| with_breadths(start, y).ok();
    let value = |y: &[f64]| Some(way * value_of(quantity, &hull_of(y)?, reference));
    let slopes = |y: &[f64]| {
        let hull = hull_of(y)?;
        Some(equation(quantity, value_of(quantity, &hull, reference), &hull, reference).gradient)
    };
    let mut known = None;
    let mut towards = |gradient: &[f64]| {
        problem.linear = search.freedom.gradient(gradient).iter().map(|g| way * search.unit * g).collect();
        let solution = solved(&problem, known.as_ref(), ITERATIONS).ok()?;
        let y = search.moved(&solution.x);
        known = solution.interior;
        Some(y)
    };
    let mut gradient = slopes(at)?;
    if course != Course::Curved {
        let mut y = towards(&gradient)?;
        let mut least = value(&y)?;
        for _ in 0..if course == Course::Ratio { STEPS } else { 0 } {
            gradient = slopes(&y)?;
            let Some(next) = towards(&gradient) else { break };
            let found = value(&next)?;
            if least - found <= LAST_RATIO * least.abs() {
                break;
            }
            (y, least) = (next, found);
        }
        return Some(way * least);
    }
    let (mut y, mut least) = (at.to_vec(), value(at)?);
    for _ in 0..STEPS {
        let Some(vertex) = towards(&gradient) else { break };
        let along = |t: f64| -> Vec<f64> { y.iter().zip(&vertex).map(|(a, b)| a + t * (b - a)).collect() };
        let slope = |t: f64| {
            let y = along(t);
            let gradient = slopes(&y)?;
            Some(gradient.iter().zip(y.iter().zip(&vertex)).map(|(g, (a, b))| way * g * (b - a)).sum::<f64>())
        };
        let t = best_step(slope);
        let candidates = [t, 1.0].map(|t| (along(t), t));
        let Some((next, found)) = candidates
            .into_iter()
            .filter_map(|(y, _)| value(&y).map(|value| (y, value)))
            .min_by(|a, b| a.1.total_cmp(&b.1))
        else {
            break;
        };
        let gain = least - found;
        if gain <= 0.0 {
            break;
        }
        (y, least) = (next, found);
        if gain <= LAST_GAIN * least.abs() {
            break;
        }
        gradient = slopes(&y)?;
    }
    Some(way * least)
}

/// How a quantity depends on half-breadths that have the other targets.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Course {
    Linear,
    /// Of two linear functions.
    Ratio,
    Curved,
}

impl Course {
    fn of(quantity: Quantity, others: &[Target]) -> Self {
        let is_given = |wanted: Quantity| others.iter().any(|other| other.quantity == wanted);
        match quantity {
            Quantity::Km | Quantity::WettedSurface => Self::Curved,
            Quantity::Lcb | Quantity::Kb if is_given(Quantity::Volume) => Self::Linear,
            Quantity::Lcf if is_given(Quantity::WaterplaneCoefficient) => Self::Linear,
            Quantity::Lcb | Quantity::Lcf | Quantity::Kb | Quantity::PrismaticCoefficient => Self::Ratio,
            _ => Self::Linear,
        }
    }
}

/// How far below `end`, or above for a `way` of -1, values are met: by steps that double, then by halves.
fn beyond(end: f64, way: f64, mut meets: impl FnMut(f64) -> bool) -> f64 {
    let (mut met, mut step) = (end, FIRST_BEYOND * end.abs());
    let mut failed = None;
    for _ in 0..DOUBLINGS {
        let next = met - way * step;
        if !meets(next) {
            failed = Some(next);
            break;
        }
        (met, step) = (next, 2.0 * step);
    }
    // An end that nothing is met beyond is one.
    let Some(mut failed) = failed.filter(|_| (met - end).abs() > 0.0) else { return met };
    for _ in 0..HALVINGS {
        let middle = 0.5 * (met + failed);
        if meets(middle) {
            met = middle;
        } else {
            failed = middle;
        }
    }
    met
}

/// Where from 0 to 1 a function with this slope is least: the root of the slope by false position, or 1.
fn best_step(slope: impl Fn(f64) -> Option<f64>) -> f64 {
    let Some((mut at_low, mut at_high)) = slope(0.0).zip(slope(1.0)) else { return 1.0 };
    if at_high <= 0.0 || at_low >= 0.0 {
        return 1.0;
    }
    let [mut low, mut high] = [0.0, 1.0];
    let (first, mut t) = (at_low, 1.0);
    for _ in 0..ROOT_STEPS {
        t = low - at_low * (high - low) / (at_high - at_low);
        let Some(found) = slope(t) else { break };
        if found.abs() <= LEVEL_ENOUGH * first.abs() {
            break;
        }
        // Illinois: the end that stays counts half.
        if found < 0.0 {
            (low, at_low, at_high) = (t, found, 0.5 * at_high);
        } else {
            (high, at_high, at_low) = (t, found, 0.5 * at_low);
        }
    }
    t
}
