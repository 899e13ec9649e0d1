//! Chart, metric and weight of greatest likelihood.
//!
//! Coordinate descent over grids of the numbers of chart and metric, each with its best weight.

use super::chart::{Chart, Shape};
use super::density::Density;
use super::likelihood::{Cell, Observed, Roughness, Smoothed, smoothed};
use super::net::{Metric, Net};
use crate::numeric::SingularMatrix;
use std::collections::btree_map::Entry;
use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::PI;

/// Values of b.
const KEELS: [f64; 6] = [0.0, 0.1, 0.2, 0.3, 0.5, 1.0];

/// Anisotropies.
const ANISOTROPIES: [f64; 8] = [0.35, 0.5, 0.7, 1.0, 1.4, 2.0, 2.8, 4.0];

/// Factors of the mixed derivatives.
const MIXED: [f64; 6] = [1.0, 0.3, 0.1, 0.03, 0.01, 0.001];

/// Values of c.
const ENDS: [f64; 4] = [0.0, 0.25, 0.5, 0.75];

/// Where the descent starts, in the grids: a flat bottom, and a V keel. From one alone an S-shaped hull whose sections leave
/// the keel straight came out 30 mm fuller below its first waterline.
const STARTS: [[usize; 5]; 2] = [[1, 3, 0, 0, 0], [5, 3, 0, 0, 0]];

/// Widths of the mean that makes a density, in intervals of the table.
pub(super) const WIDTHS: [f64; 3] = [3.0, 2.0, 1.5];

/// What -2 log l must fall by for each number that a density has: the intervals of the table over the 4 pi w^2 that a mean of
/// width w takes in.
const PRICE: f64 = 20.0;

/// Most rounds in which a density is taken from the field with the one before, and what -2 log l falls by in one that is
/// not the last.
const DENSITIES: usize = 3;
const WORTH: f64 = 10.0;

/// Rounds of the descent.
const ROUNDS: usize = 3;

/// Decimal logarithms of the least and of the greatest weight.
const WEIGHTS: [f64; 2] = [-10.0, 5.0];

/// Decimal logarithms of the weight that is tried first and of the first and the least step from it.
const FIRST: f64 = -4.0;
const STEPS: [f64; 2] = [1.0, 0.2];

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
    /// rounds, each of the field with the one before.
    pub(super) fn with_density(&self, net: &Net, cells: &[Cell], least: f64, widths: &[f64]) -> Self {
        let mut best = self.clone();
        for width in widths {
            let mut last = self.clone();
            for _ in 0..DENSITIES {
                let density = Some(Density::of(net, self.metric, &last.field.values, *width));
                let Some(found) = (Self { density, ..self.clone() }).on(net, cells, last.exponent, least) else {
                    break;
                };
                let gain = last.field.cost - found.field.cost;
                if gain > 0.0 {
                    last = found;
                }
                if gain < WORTH {
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
    /// logarithm) on. None where the cells determine no field.
    pub(super) fn on(&self, net: &Net, cells: &[Cell], start: f64, least: f64) -> Option<Self> {
        let rough = self.roughness(net).ok()?;
        let (found, trials) = weighed(&Observed::new(net, &self.chart, cells), &rough, start, least);
        let (exponent, field) = found?;
        Some(Self { exponent, field, trials: self.trials + trials, ..self.clone() })
    }
}

struct Search<'a, 'n> {
    energies: &'a mut Energies<'n>,
    cells: &'a [Cell],
    rectangle: Chart,
    least: f64,
    known: BTreeMap<[usize; 5], (f64, Smoothed)>,
    exponent: f64,
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

    /// Cost of a chart with its best weight.
    fn cost(&mut self, at: [usize; 5]) -> f64 {
        if let Some((_, known)) = self.known.get(&at) {
            return known.cost;
        }
        let observed = Observed::new(self.energies.net, &self.chart(at), self.cells);
        let Ok(rough) = self.energies.of(Self::metric(at)) else { return f64::INFINITY };
        let (best, trials) = weighed(&observed, rough, self.exponent, self.least);
        self.trials += trials;
        let Some((exponent, found)) = best else { return f64::INFINITY };
        self.exponent = exponent;
        let cost = found.cost;
        self.known.insert(at, (exponent, found));
        cost
    }

    /// The chart at which no single number is better, from a start on; each within `beside` steps of its grid.
    fn descent(&mut self, mut at: [usize; 5], beside: usize) -> Option<[usize; 5]> {
        for _ in 0..ROUNDS {
            let before = at;
            for k in [1, 4, 0, 2, 3] {
                let count = [KEELS.len(), ANISOTROPIES.len(), ENDS.len(), ENDS.len(), MIXED.len()][k];
                let last = count.min(at[k].saturating_add(beside).saturating_add(1));
                let tried = (at[k].saturating_sub(beside)..last).map(|q| {
                    let mut place = at;
                    place[k] = q;
                    (self.cost(place), place)
                });
                at = tried.min_by(|a, b| a.0.total_cmp(&b.0))?.1;
            }
            if at == before {
                break;
            }
        }
        Some(at)
    }
}

/// The decimal logarithm of the weight of greatest likelihood with its field, outwards from `start` in steps of a decade,
/// then finer; and how many were tried.
fn weighed(observed: &Observed, rough: &Roughness, start: f64, least: f64) -> (Option<(f64, Smoothed)>, usize) {
    let mut trials = 0;
    let mut best: Option<(f64, Smoothed)> = None;
    let mut seen = BTreeSet::new();
    let mut look = |exponent: f64, best: &mut Option<(f64, Smoothed)>| {
        let key = (exponent * 16.0).round() as i64;
        if !(WEIGHTS[0]..=WEIGHTS[1]).contains(&exponent) || !seen.insert(key) {
            return;
        }
        trials += 1;
        if let Ok(found) = smoothed(observed, rough, 10f64.powf(exponent), least)
            && best.as_ref().is_none_or(|(_, b)| found.cost < b.cost)
        {
            *best = Some((exponent, found));
        }
    };
    let mut step = STEPS[0];
    look(start, &mut best);
    while step > STEPS[1] {
        while let Some(centre) = best.as_ref().map(|b| b.0) {
            look(centre - step, &mut best);
            look(centre + step, &mut best);
            if best.as_ref().is_none_or(|b| (b.0 - centre).abs() < 1e-9) {
                break;
            }
        }
        step *= 0.5;
    }
    (best, trials)
}

/// The chart of greatest likelihood over a rectangle; the noise is at least `least` \[m\]. With an earlier choice only charts
/// beside it are tried, as long as they are better. None where the cells determine no field.
#[must_use]
pub fn choose(
    energies: &mut Energies<'_>,
    cells: &[Cell],
    rectangle: Chart,
    least: f64,
    earlier: Option<&Chosen>,
) -> Option<Chosen> {
    let known = BTreeMap::new();
    let exponent = earlier.map_or(FIRST, |earlier| earlier.exponent);
    let mut search = Search { energies, cells, rectangle, least, known, exponent, trials: 0 };
    let starts = earlier.map_or(STARTS.to_vec(), |earlier| vec![place(earlier)]);
    let beside = if earlier.is_some() { 1 } else { usize::MAX };
    let ends = starts.into_iter().filter_map(|start| search.descent(start, beside)).collect::<Vec<_>>();
    let at = ends.into_iter().min_by(|a, b| search.cost(*a).total_cmp(&search.cost(*b)))?;
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
