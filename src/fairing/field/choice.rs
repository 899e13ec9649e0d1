//! Chart, anisotropy and weight of greatest likelihood.
//!
//! Coordinate descent over grids of the four numbers of the chart, each with its best weight.

use super::chart::{Chart, Shape};
use super::likelihood::{Cell, Observed, Roughness, Smoothed, smoothed};
use super::net::Net;
use std::collections::BTreeMap;

/// Values of b.
const KEELS: [f64; 6] = [0.0, 0.1, 0.2, 0.3, 0.5, 1.0];

/// Anisotropies.
const ANISOTROPIES: [f64; 8] = [0.35, 0.5, 0.7, 1.0, 1.4, 2.0, 2.8, 4.0];

/// Values of c.
const ENDS: [f64; 4] = [0.0, 0.25, 0.5, 0.75];

/// Rounds of the descent.
const ROUNDS: usize = 3;

/// Decimal logarithms of the least and of the greatest weight, and the first step.
const WEIGHTS: [f64; 3] = [-10.0, 3.0, 1.0];

/// What was chosen.
#[derive(Debug, Clone)]
pub struct Chosen {
    /// The chart.
    pub chart: Chart,
    /// Anisotropy of the energy.
    pub anisotropy: f64,
    /// Decimal logarithm of the weight.
    pub exponent: f64,
    /// The field.
    pub field: Smoothed,
    /// Fields that were computed.
    pub trials: usize,
}

struct Search<'a> {
    net: &'a Net,
    cells: &'a [Cell],
    rectangle: Chart,
    least: f64,
    rough: BTreeMap<usize, Roughness>,
    known: BTreeMap<[usize; 4], (f64, Smoothed)>,
    exponent: f64,
    trials: usize,
}

impl Search<'_> {
    fn shape(at: [usize; 4]) -> Shape {
        Shape { keel: KEELS[at[0]], ends: [ENDS[at[2]], ENDS[at[3]]] }
    }

    fn chart(&self, at: [usize; 4]) -> Chart {
        Chart { shape: Self::shape(at), ..self.rectangle }
    }

    /// Cost of a chart with its best weight.
    fn cost(&mut self, at: [usize; 4]) -> f64 {
        if let Some((_, known)) = self.known.get(&at) {
            return known.cost;
        }
        let observed = Observed::new(self.net, &self.chart(at), self.cells);
        if !self.rough.contains_key(&at[1]) {
            let Ok(rough) = Roughness::new(self.net, ANISOTROPIES[at[1]]) else { return f64::INFINITY };
            self.rough.insert(at[1], rough);
        }
        let rough = &self.rough[&at[1]];
        let mut trials = 0;
        let mut best: Option<(f64, Smoothed)> = None;
        let mut seen = BTreeMap::new();
        let mut look = |exponent: f64, best: &mut Option<(f64, Smoothed)>| {
            let key = (exponent * 16.0).round() as i64;
            if !(WEIGHTS[0]..=WEIGHTS[1]).contains(&exponent) || seen.insert(key, ()).is_some() {
                return;
            }
            trials += 1;
            if let Ok(found) = smoothed(&observed, rough, 10f64.powf(exponent), self.least)
                && best.as_ref().is_none_or(|(_, b)| found.cost < b.cost)
            {
                *best = Some((exponent, found));
            }
        };
        // Outwards from the last best weight in steps of a decade, then finer.
        let mut step = WEIGHTS[2];
        look(self.exponent, &mut best);
        while step > 0.2 {
            while let Some(centre) = best.as_ref().map(|b| b.0) {
                look(centre - step, &mut best);
                look(centre + step, &mut best);
                if best.as_ref().is_none_or(|b| (b.0 - centre).abs() < 1e-9) {
                    break;
                }
            }
            step *= 0.5;
        }
        self.trials += trials;
        let Some((exponent, found)) = best else { return f64::INFINITY };
        self.exponent = exponent;
        let cost = found.cost;
        self.known.insert(at, (exponent, found));
        cost
    }
}

/// The chart of greatest likelihood over a rectangle; the noise is at least `least` \[m\]. None where the cells determine
/// no field.
#[must_use]
pub fn choose(net: &Net, cells: &[Cell], rectangle: Chart, least: f64) -> Option<Chosen> {
    let (rough, known) = (BTreeMap::new(), BTreeMap::new());
    let mut search = Search { net, cells, rectangle, least, rough, known, exponent: -4.0, trials: 0 };
    let mut at = [1, 3, 0, 0];
    for _ in 0..ROUNDS {
        let before = at;
        for k in [1, 0, 2, 3] {
            let count = [KEELS.len(), ANISOTROPIES.len(), ENDS.len(), ENDS.len()][k];
            let tried = (0..count).map(|q| {
                let mut place = at;
                place[k] = q;
                (search.cost(place), place)
            });
            at = tried.min_by(|a, b| a.0.total_cmp(&b.0))?.1;
        }
        if at == before {
            break;
        }
    }
    let chart = search.chart(at);
    let (exponent, field) = search.known.remove(&at)?;
    Some(Chosen { chart, anisotropy: ANISOTROPIES[at[1]], exponent, field, trials: search.trials })
}
