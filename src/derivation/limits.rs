//! The interval of each target, the others given: what half-breadths on the chart of the daughter reach without passing the
//! centreplane or B/2, without sections or waterlines that pass each other, and with the signs of curvature of the parent.
//!
//! Linear programs, one for each end. Their answers are evaluated: an end is the value of a hull, which is feasible as far as
//! rounding goes. KM and wetted surface are not linear: from the hull that has the others, steps towards the answers of linear
//! programs, each as long as it is best (Frank and Wolfe 1956), come near a local end; values beyond it are tried by the nearest hull. The limits of a daughter are those over
//! three charts, her own and those of sections that are shifted as far as a search shifts them either way.

use super::derive::{Job, OF_FOLD};
use super::nearest::{Search, breadths, with_breadths};
use super::pool::Kind;
use super::quantity::{Quantity, Reference, equation, value_of};
use super::request::{Origin, Target};
use super::shift::{Ends, LEVEL_FOLD, level, shifted};
use crate::hull::Hull;
use crate::numeric::join;

/// Most rounds in which missed signs come into a linear program; after them the interval is that without signs.
const ROUNDS: usize = 10;
/// Most steps towards the end of what is not linear.
const STEPS: usize = 12;
/// Thirds of a step, by which its best length is found.
const THIRDS: usize = 24;
/// Relative gain of a step below which it is the last.
const LAST_GAIN: f64 = 1e-6;
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
        let of = |chart: &Hull| interval(self.scaled, chart, &self.reference, quantity, others, self.body);
        let most = OF_FOLD * LEVEL_FOLD;
        let shifts: &[[f64; 2]] = match quantity {
            _ if self.body.is_some() => &[],
            Quantity::Volume | Quantity::PrismaticCoefficient => &[[most, most], [-most, -most]],
            Quantity::Lcb | Quantity::Lcf => &[[most, -most], [-most, most]],
            _ => &[],
        };
        let moved = |amplitudes: &[f64; 2]| {
            let ends = Ends::inside(self.scaled, self.midship());
            of(&shifted(self.scaled, &ends, &|side, t| level(t, amplitudes[side])).ok()?)
        };
        let (own, others) = join(|| of(start), || shifts.iter().filter_map(moved).collect::<Vec<_>>());
        let found: Vec<Interval> = own.into_iter().chain(others).collect();
        // A chart on which signs go is left out where others keep them.
        let keeps = found.iter().any(|interval| interval.keeps_signs);
        found.into_iter().filter(|interval| interval.keeps_signs || !keeps).reduce(Interval::with)
    }
}

/// The interval of `quantity` with the `others` given; none where they alone are infeasible. Where the signs of curvature of the
/// parent are, it is that without them.
fn interval(
    parent: &Hull,
    start: &Hull,
    reference: &Reference,
    quantity: Quantity,
    others: &[Target],
    body: Option<[f64; 2]>,
) -> Option<Interval> {
    let of = |keeps_signs: bool| {
        let meets = |value: f64| {
            let own = Target { quantity, value, origin: Origin::Given };
            let targets = [others, &[own]].concat();
            let mut search = prepared((parent, start), reference, (&targets, body), keeps_signs);
            let found = search.run().ok().map(|nearest| value_of(quantity, &nearest.hull, reference));
            found.is_some_and(|found| (found - value).abs() <= 1e-6 * value.abs())
        };
        let end = |way: f64| {
            let found = extreme(prepared((parent, start), reference, (others, body), keeps_signs), quantity, way)?;
            Some(if is_linear(quantity) { found } else { beyond(found, way, meets) })
        };
        let (low, high) = (end(1.0)?, end(-1.0)?);
        Some(Interval { quantity, low: low.min(high), high: high.max(low), keeps_signs })
    };
    of(true).or_else(|| of(false))
}

/// A search for a hull with these targets, with the signs of curvature of the parent or without.
fn prepared<'a>(
    (parent, start): (&Hull, &'a Hull),
    reference: &'a Reference,
    (targets, body): (&'a [Target], Option<[f64; 2]>),
    keeps_signs: bool,
) -> Search<'a> {
    let mut search = Search::new(parent, start, reference, targets, body);
    if !keeps_signs {
        search.without_signs();
    }
    search
}

/// The least value of `quantity`, or the greatest for a `way` of -1.
fn extreme(mut search: Search<'_>, quantity: Quantity, way: f64) -> Option<f64> {
    let (start, reference) = (search.start, search.reference);
    let value = |y: &[f64]| Some(value_of(quantity, &with_breadths(start, y).ok()?, reference));
    // The hull that has the others.
    let mut at = if is_linear(quantity) { None } else { search.run().ok().map(|nearest| breadths(&nearest.hull)) };
    search.rounds = ROUNDS;
    // A linear program needs its limits from the beginning.
    for (taken, candidate) in search.taken.iter_mut().zip(&search.candidates) {
        *taken = candidate.kind != Kind::Sign;
    }
    let equations = search.equations(start);
    let base = search.base.clone();
    let towards = |search: &mut Search<'_>, y: &[f64]| {
        let hull = with_breadths(start, y).ok()?;
        let gradient = equation(quantity, value_of(quantity, &hull, reference), &hull, reference).gradient;
        let towards: Vec<f64> = search.freedom.gradient(&gradient).iter().map(|g| way * search.unit * g).collect();
        Some(search.solve(&equations, &base, Some(&towards)).ok()?.y)
    };
    let Some(mut y) = at.take() else { return value(&towards(&mut search, &base)?) };
    for _ in 0..STEPS {
        let Some(vertex) = towards(&mut search, &y) else { break };
        let along = |t: f64| -> Vec<f64> { y.iter().zip(&vertex).map(|(a, b)| a + t * (b - a)).collect() };
        let (before, best) = (value(&y)?, best_step(|t| value(&along(t)).map_or(f64::INFINITY, |value| way * value)));
        let next = along(best);
        let gain = way * (before - value(&next)?);
        y = next;
        if gain <= LAST_GAIN * before.abs() {
            break;
        }
    }
    value(&y)
}

fn is_linear(quantity: Quantity) -> bool {
    !matches!(quantity, Quantity::Km | Quantity::WettedSurface)
}

/// How far below `end`, or above for a `way` of -1, values are met: by steps that double, then by halves.
fn beyond(end: f64, way: f64, meets: impl Fn(f64) -> bool) -> f64 {
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
    let Some(mut failed) = failed else { return met };
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

/// Where from 0 to 1 a function is least, to a thousandth: by thirds, or an end.
fn best_step(of: impl Fn(f64) -> f64) -> f64 {
    let [mut low, mut high] = [0.0, 1.0];
    for _ in 0..THIRDS {
        let third = (high - low) / 3.0;
        if of(low + third) <= of(high - third) {
            high -= third;
        } else {
            low += third;
        }
    }
    let middle = 0.5 * (low + high);
    [0.0, middle, 1.0].into_iter().min_by(|a, b| of(*a).total_cmp(&of(*b))).unwrap_or(middle)
}
