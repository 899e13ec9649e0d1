//! Chart, metric and weight of greatest likelihood.
//!
//! Coordinate descent over grids of the numbers of chart and metric, each with its best weight.

use super::chart::{Chart, Shape};
use super::density::Density;
use super::likelihood::{Observed, Readings, Roughness, Smoothed, smoothed};
use super::net::{Metric, Net};
use crate::numeric::SingularMatrix;
use std::collections::BTreeMap;
use std::collections::btree_map::Entry;
use std::f64::consts::PI;

/// Values of b.
const KEELS: [f64; 6] = [0.0, 0.1, 0.2, 0.3, 0.5, 1.0];

/// Anisotropies.
const ANISOTROPIES: [f64; 8] = [0.35, 0.5, 0.7, 1.0, 1.4, 2.0, 2.8, 4.0];

/// Factors of the mixed derivatives.
const MIXED: [f64; 6] = [1.0, 0.3, 0.1, 0.03, 0.01, 0.001];

/// Values of c.
const ENDS: [f64; 4] = [0.0, 0.25, 0.5, 0.75];

/// Where the descent starts, in the grids: a flat bottom. It starts again where that ends, with the V keel of the last b. From
/// one alone an S-shaped hull whose sections leave the keel straight came out 30 mm fuller below its first waterline.
const START: [usize; 5] = [1, 3, 0, 0, 0];

/// Widths of the mean that makes a density, in intervals of the table.
pub(super) const WIDTHS: [f64; 3] = [3.0, 2.0, 1.5];

/// What -2 log l must fall by for each number that a density has: the intervals of the table over the 4 pi w^2 that a mean of
/// width w takes in.
const PRICE: f64 = 20.0;

/// Most rounds in which a density is taken from the field with the one before, and what -2 log l falls by in one that is
/// not the last.
const DENSITIES: usize = 3;
const WORTH: f64 = 10.0;

/// What later rounds add to the gain of the first at most.
const AGAIN: f64 = 0.5;

/// Rounds of the descent.
const ROUNDS: usize = 3;

/// What -2 log l rises by, and by for each offset, where no better chart is expected further along a grid.
const RISE: [f64; 2] = [200.0, 0.3];

/// What -2 log l falls by at most, and by for each offset, from the first weight that is tried to the best.
const FALL: [f64; 2] = [200.0, 0.3];

/// The same from the better of two weights, besides what its curvature says.
const SLACK: f64 = 100.0;

/// Least curvature of -2 log l over steps of the weight, for each offset.
const CURVATURE: f64 = 0.015;

/// Decimal logarithms of the least and of the greatest weight.
const WEIGHTS: [f64; 2] = [-10.0, 5.0];

/// Decimal logarithm of the weight that is tried first.
const FIRST: f64 = -4.0;

/// Weights a decade.
const PLACES: f64 = 4.0;

/// The energies of a net, each made once.
#[derive(Debug)]
pub struct Energies<'a> {
    /// The net.
    pub net: &'a Net,
    known: BTreeMap<[u64; 2], Roughness>,
}

impl<'a> Energies<'a> {
    /// None yet.
    #[must_use]
    pub fn new(net: &'a Net) -> Self {
        Self { net, known: BTreeMap::new() }
    }

    /// The one of a metric.
    ///
    /// # Errors
    /// [`SingularMatrix`] when rounding makes it indefinite.
    pub fn of(&mut self, metric: Metric) -> Result<&Roughness, SingularMatrix> {
        match self.known.entry([metric.anisotropy.to_bits(), metric.mixed.to_bits()]) {
            Entry::Occupied(known) => Ok(known.into_mut()),
            Entry::Vacant(place) => Ok(place.insert(Roughness::new(self.net, metric, None)?)),
        }
    }
}

/// What was chosen.
#[derive(Debug, Clone)]
pub struct Chosen {
    /// The chart.
    pub chart: Chart,
    /// The metric of the energy.
    pub metric: Metric,
    /// Where it bends more than elsewhere; none: alike everywhere.
    pub density: Option<Density>,
    /// Decimal logarithm of the weight.
    pub exponent: f64,
    /// The field.
    pub field: Smoothed,
    /// Fields that were computed.
    pub trials: usize,
}

impl Chosen {
    /// The energy on a net.
    ///
    /// # Errors
    /// [`SingularMatrix`] when rounding makes it indefinite.
    pub(super) fn roughness(&self, net: &Net) -> Result<Roughness, SingularMatrix> {
        Roughness::new(net, self.metric, self.density.as_ref())
    }

    /// What -2 log l has to fall by for its density, by the numbers that this has.
    pub(super) fn price(&self, net: &Net) -> f64 {
        let numbers = |density: &Density| net.intervals[0] * net.intervals[1] / (4.0 * PI * density.width.powi(2));
        self.density.as_ref().map_or(0.0, |density| PRICE * numbers(density))
    }

    /// With the density of its field where that is likelier by more than its price: of each of the `widths` the one of a few
    /// rounds, each of the field with the one before. Later rounds are not tried where a density would not be worth its price
    /// with [`AGAIN`] times the gain of the first.
    pub(super) fn with_density(&self, net: &Net, readings: &Readings, least: f64, widths: &[f64]) -> Self {
        let observed = Observed::new(net, &self.chart, readings);
        let mut best = self.clone();
        for width in widths {
            let mut last = self.clone();
            for round in 0..DENSITIES {
                let density = Some(Density::of(net, self.metric, &last.field.values, *width));
                let next = Self { density, ..self.clone() };
                let needed = self.field.cost + next.price(net) - best.field.cost - best.price(net);
                let worth = if round == 0 { (needed / (1.0 + AGAIN)).max(0.0) } else { 0.0 };
                let rival = last.field.cost - worth;
                let Some(found) = next.weighed(net, &observed, last.exponent, least, rival) else { break };
                let gain = last.field.cost - found.field.cost;
                if gain > worth {
                    last = found;
                }
                if gain < WORTH.max(worth) {
                    break;
                }
            }
            if last.field.cost + last.price(net) < best.field.cost + best.price(net) {
                best = last;
            }
        }
        best
    }

    /// The same chart and metric on another net, with the weight of greatest likelihood from `start` (its decimal
    /// logarithm) on. None where the cells determine no field, or where it costs more than `rival`.
    pub(super) fn on(&self, net: &Net, readings: &Readings, start: f64, least: f64, rival: f64) -> Option<Self> {
        self.weighed(net, &Observed::new(net, &self.chart, readings), start, least, rival)
    }

    fn weighed(&self, net: &Net, observed: &Observed, start: f64, least: f64, rival: f64) -> Option<Self> {
        self.weighed_with(&self.roughness(net).ok()?, observed, start, least, rival)
    }

    /// The same with its energy.
    pub(super) fn weighed_with(
        &self,
        rough: &Roughness,
        observed: &Observed,
        start: f64,
        least: f64,
        rival: f64,
    ) -> Option<Self> {
        let (found, trials) = weighed(observed, rough, start, least, rival);
        let Weighed::Best(exponent, field) = found else { return None };
        Some(Self { exponent, field, trials: self.trials + trials, ..self.clone() })
    }
}

struct Search<'a, 'n> {
    energies: &'a mut Energies<'n>,
    readings: &'a Readings,
    rectangle: Chart,
    least: f64,
    known: BTreeMap<[usize; 5], (f64, Smoothed)>,
    /// Costs that places without a known one have at least.
    bounds: BTreeMap<[usize; 5], f64>,
    trials: usize,
}

impl Search<'_, '_> {
    fn metric(at: [usize; 5]) -> Metric {
        Metric { anisotropy: ANISOTROPIES[at[1]], mixed: MIXED[at[4]] }
    }

    fn shape(at: [usize; 5]) -> Shape {
        Shape { keel: KEELS[at[0]], ends: [ENDS[at[2]], ENDS[at[3]]] }
    }

    fn chart(&self, at: [usize; 5]) -> Chart {
        Chart { shape: Self::shape(at), ..self.rectangle }
    }

    /// Cost of a chart with its best weight, looked for from `start` on; a lower bound that is above `rival` where it is
    /// not below that.
    fn cost(&mut self, at: [usize; 5], start: f64, rival: f64) -> f64 {
        if let Some((_, known)) = self.known.get(&at) {
            return known.cost;
        }
        if let Some(bound) = self.bounds.get(&at).filter(|bound| **bound > rival) {
            return *bound;
        }
        let observed = Observed::new(self.energies.net, &self.chart(at), self.readings);
        let Ok(rough) = self.energies.of(Self::metric(at)) else { return f64::INFINITY };
        let (found, trials) = weighed(&observed, rough, start, self.least, rival);
        self.trials += trials;
        match found {
            Weighed::Best(exponent, found) => {
                let cost = found.cost;
                self.known.insert(at, (exponent, found));
                cost
            }
            Weighed::AtLeast(bound) => {
                self.bounds.insert(at, bound);
                bound
            }
        }
    }

    /// The exponent with which the field of a place has the same energy in another metric.
    fn exponent(&self, from: [usize; 5], to: [usize; 5]) -> Option<f64> {
        let (exponent, field) = self.known.get(&from)?;
        let energies = self.energies.net.even_energies(&field.values);
        let [old, new] = [from, to].map(|at| {
            let metric = Self::metric(at);
            energies.iter().enumerate().map(|(k, energy)| metric.factor(k) * energy).sum::<f64>()
        });
        let shift = (old / new).log10();
        Some(if shift.is_finite() { (exponent + shift).clamp(WEIGHTS[0], WEIGHTS[1]) } else { *exponent })
    }

    /// The chart at which no single number is better, from a start on; each within `beside` steps of its grid. On a grid the
    /// places to each side are tried as far as cost does not rise by [`RISE`].
    fn descent(&mut self, mut at: [usize; 5], beside: usize, start: f64) -> Option<[usize; 5]> {
        let rise = RISE[0] + RISE[1] * self.readings.cells.len() as f64;
        let mut best = self.cost(at, start, f64::INFINITY);
        for _ in 0..ROUNDS {
            let before = at;
            for k in [1, 4, 0, 2, 3] {
                let count = [KEELS.len(), ANISOTROPIES.len(), ENDS.len(), ENDS.len(), MIXED.len()][k];
                let centre = at;
                let down = (0..centre[k]).rev().take(beside);
                let up = (centre[k] + 1..count).take(beside);
                for side in [down.collect::<Vec<_>>(), up.collect()] {
                    let mut from = centre;
                    for q in side {
                        let mut place = centre;
                        place[k] = q;
                        let cost = self.cost(place, self.exponent(from, place)?, best);
                        if cost < best {
                            (best, at) = (cost, place);
                        }
                        if cost > best + rise {
                            break;
                        }
                        if self.known.contains_key(&place) {
                            from = place;
                        }
                    }
                }
            }
            if at == before {
                break;
            }
        }
        (best < f64::INFINITY).then_some(at)
    }
}

/// The field of the best weight.
enum Weighed {
    /// The decimal logarithm of the weight, and the field.
    Best(f64, Smoothed),
    /// A lower bound of its cost, that is above that of the rival.
    AtLeast(f64),
}

/// The weight of greatest likelihood with its field, and how many were tried: the least of three neighbours on the grid of
/// steps of a quarter decade. It is bracketed from `start` on with steps that double, then found by parabolas (Brent 1973,
/// chapter 5). The search ends early where the best weight costs more than `rival`. For that -2 log l of n offsets is taken
/// to fall by [`FALL`] at most, and by [`SLACK`] + s^2 / (4 k n) where it changes by s between two weights, with the
/// curvature k of [`CURVATURE`].
fn weighed(observed: &Observed, rough: &Roughness, start: f64, least: f64, rival: f64) -> (Weighed, usize) {
    // Costs, and what the offsets alone cost.
    let mut costs: BTreeMap<i32, [f64; 2]> = BTreeMap::new();
    let mut best: Option<(f64, Smoothed)> = None;
    let mut both = |place: i32, best: &mut Option<(f64, Smoothed)>| {
        *costs.entry(place).or_insert_with(|| {
            let exponent = f64::from(place) / PLACES;
            if !(WEIGHTS[0]..=WEIGHTS[1]).contains(&exponent) {
                return [f64::INFINITY; 2];
            }
            let Ok(found) = smoothed(observed, rough, 10f64.powf(exponent), least) else {
                return [f64::INFINITY; 2];
            };
            let costs = [found.cost, found.cost - found.below];
            if best.as_ref().is_none_or(|(_, b)| found.cost < b.cost) {
                *best = Some((exponent, found));
            }
            costs
        })
    };
    let mut middle = (start * PLACES).round() as i32;
    let [_, first] = both(middle, &mut best);
    let count = observed.count() as f64;
    let bound = first - FALL[0] - FALL[1] * count;
    if first.is_infinite() || bound > rival {
        return (Weighed::AtLeast(bound), 1);
    }
    let [_, second] = both(middle + 1, &mut best);
    let bound = first.min(second) - SLACK - (second - first).powi(2) / (4.0 * CURVATURE * count);
    if bound > rival {
        return (Weighed::AtLeast(bound), 2);
    }
    let mut cost = |place: i32, best: &mut Option<(f64, Smoothed)>| both(place, best)[0];
    // Places beside the middle at which it is higher.
    let mut ends = [middle, middle];
    for (side, direction) in [(1, 1), (0, -1)] {
        if ends[side] != middle {
            continue;
        }
        let mut step = direction;
        while cost(middle + step, &mut best) < cost(middle, &mut best) {
            ends[1 - side] = middle;
            middle += step;
            step *= 2;
        }
        ends[side] = middle + step;
    }
    let [mut low, mut high] = ends;
    while high - low > 2 {
        let [left, right] =
            [low, high].map(|end| (cost(end, &mut best) - cost(middle, &mut best)) / f64::from(end - middle));
        // Of the parabola through the three, from the middle.
        let least = -0.5 * (left * f64::from(high - middle) - right * f64::from(low - middle)) / (right - left);
        let beside = if low + 1 == middle || (least > 0.0 && middle + 1 < high) { middle + 1 } else { middle - 1 };
        let vertex = middle + least.round() as i32;
        let next = if vertex != middle && low < vertex && vertex < high { vertex } else { beside };
        let is_less = cost(next, &mut best) < cost(middle, &mut best);
        match (next < middle, is_less) {
            (true, true) => (middle, high) = (next, middle),
            (true, false) => low = next,
            (false, true) => (low, middle) = (middle, next),
            (false, false) => high = next,
        }
    }
    let found = best.map_or(Weighed::AtLeast(f64::INFINITY), |(exponent, field)| Weighed::Best(exponent, field));
    (found, costs.len())
}

/// The chart of greatest likelihood over a rectangle; the noise is at least `least` \[m\]. With an earlier choice only charts
/// beside it are tried, as long as they are better. None where the cells determine no field.
#[must_use]
pub fn choose(
    energies: &mut Energies<'_>,
    readings: &Readings,
    rectangle: Chart,
    least: f64,
    earlier: Option<&Chosen>,
) -> Option<Chosen> {
    let (known, bounds) = (BTreeMap::new(), BTreeMap::new());
    let mut search = Search { energies, readings, rectangle, least, known, bounds, trials: 0 };
    let exponent = earlier.map_or(FIRST, |earlier| earlier.exponent);
    let beside = if earlier.is_some() { 1 } else { usize::MAX };
    let first = search.descent(earlier.map_or(START, place), beside, exponent)?;
    let second = earlier.is_none().then(|| {
        let v_keel = [KEELS.len() - 1, first[1], first[2], first[3], first[4]];
        search.descent(v_keel, beside, search.known[&first].0)
    });
    let ends = std::iter::once(first).chain(second.flatten());
    let at = ends.min_by(|a, b| search.known[a].1.cost.total_cmp(&search.known[b].1.cost))?;
    let chart = search.chart(at);
    let (exponent, field) = search.known.remove(&at)?;
    Some(Chosen { chart, metric: Search::metric(at), density: None, exponent, field, trials: search.trials })
}

/// Where a choice stands in the grids.
fn place(chosen: &Chosen) -> [usize; 5] {
    let of = |grid: &[f64], value: f64| grid.iter().position(|other| (other - value).abs() < 1e-12).unwrap_or(0);
    let (Shape { keel, ends }, Metric { anisotropy, mixed }) = (chosen.chart.shape, chosen.metric);
    [of(&KEELS, keel), of(&ANISOTROPIES, anisotropy), of(&ENDS, ends[0]), of(&ENDS, ends[1]), of(&MIXED, mixed)]
}
