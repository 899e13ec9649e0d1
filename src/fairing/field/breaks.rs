//! Waterlines across which a field breaks (bilge tangents, chines), by the likelihood of its table.
//!
//! The score test ([`Observed::scores`]) says where a break is likely: between any two waterlines, with a jump that is a
//! polynomial along the ship. The likeliest is tried in the net, moved to where it is likeliest, and given the charge that
//! is. It is taken where -2 log l falls by more than 24. Then the next is looked for. Sections x = constant are no
//! candidates: a middle body ends at another place at every height. With them the error of 53 random tables was 2 % more
//! in the geometric mean; breaks of waterlines alone make it 9 % less.

use super::choice::Chosen;
use super::likelihood::{self, Observed, Readings, smoothed};
use super::net::{Break, Net};
use std::collections::BTreeSet;

/// Least gain in -2 log l of a break. Those of less made as many tables worse as better.
const GAIN: f64 = 24.0;

/// Least score of a break that is tried.
const SCORE: f64 = 25.0;

/// Most breaks.
const MOST: usize = 6;

/// Breaks of the greatest scores that are tried.
const TRIED: usize = 3;

/// Places an interval of the table at which a break may be.
const PLACES: usize = 4;

/// Heights of offsets over the waterlines of a table beyond which they are on no waterlines.
const MANY: f64 = 1.5;

/// Powers of the polynomial along a break.
const ALONG: usize = 4;

/// Charges of jumps that are tried, and those of them with which a break is looked at first.
const CHARGES: [f64; 7] = [1.0, 1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6];
const FIRST: [f64; 2] = [1e-1, 1e-4];

/// What -2 log l rises by from one charge to the next where no better one is expected beyond it.
const RISE: f64 = 5.0;

/// Least step of a break, in spans of the net.
const STEP: f64 = 0.04;

/// A break of the hull.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FoundBreak {
    /// Height \[m\].
    pub z: f64,
    /// What -2 log l falls by.
    pub gain: f64,
}

/// The net of so many spans with the breaks that the cells show, and the field on it.
#[must_use]
pub fn broken(
    mut net: Net,
    spans: [usize; 2],
    readings: &Readings,
    mut chosen: Chosen,
    least: f64,
) -> (Net, Chosen, Vec<FoundBreak>) {
    let (chart, intervals) = (chosen.chart, net.intervals);
    let cells_at = likelihood::places(&chart, readings.cells.iter().map(|cell| [cell.x, cell.z]));
    let mut lines = Vec::new();
    for _ in 0..MOST {
        let Ok(rough) = chosen.roughness(&net) else { break };
        let observed = Observed::new(&net, &chart, readings);
        let places = places(&cells_at, &net.breaks, intervals[1]);
        let functions: Vec<Vec<Vec<f64>>> = places.iter().map(|at| jumps(*at, &cells_at)).collect();
        let weight = 10f64.powf(chosen.exponent);
        let Ok(scores) = observed.scores(&rough, weight, &chosen.field, &functions) else { break };
        let trial = Trial { spans, intervals, readings, least, known: &net.breaks, chosen: &chosen };
        let mut best: Option<(f64, f64, Break)> = None;
        for (k, charge) in peaks(&scores).into_iter().take(TRIED).flat_map(|k| FIRST.map(|charge| (k, charge))) {
            let line = Break { at: places[k], order: 2, charge };
            let rival = best.map_or(f64::INFINITY, |best| best.0);
            if let Some((_, found)) = trial.weighed(line, chosen.exponent, rival)
                && found.field.cost < rival
            {
                best = Some((found.field.cost, found.exponent, line));
            }
        }
        let Some((_, exponent, line)) = best.filter(|best| best.0 < chosen.field.cost) else { break };
        let Some((tried, found, line)) = trial.refined(line, exponent) else { break };
        let gain = chosen.field.cost - found.field.cost;
        if gain < GAIN {
            break;
        }
        lines.push(FoundBreak { z: chart.z(line.at), gain });
        (net, chosen) = (tried, found);
    }
    (net, chosen, lines)
}

/// A break beside those that are known.
struct Trial<'a> {
    spans: [usize; 2],
    intervals: [f64; 2],
    readings: &'a Readings,
    least: f64,
    known: &'a [Break],
    chosen: &'a Chosen,
}

impl Trial<'_> {
    fn net(&self, line: Break) -> Option<Net> {
        let breaks = self.known.iter().copied().chain([line]).collect();
        Net::broken(self.spans, self.intervals, breaks).ok()
    }

    /// The net with the break, and the choice on it; none where it costs more than `rival`.
    fn weighed(&self, line: Break, start: f64, rival: f64) -> Option<(Net, Chosen)> {
        let net = self.net(line)?;
        let found = self.chosen.on(&net, self.readings, start, self.least, rival)?;
        Some((net, found))
    }

    /// -2 log l of a weight.
    fn cost(&self, line: Break, exponent: f64) -> f64 {
        let field = || {
            let net = self.net(line)?;
            let rough = self.chosen.roughness(&net).ok()?;
            let observed = Observed::new(&net, &self.chosen.chart, self.readings);
            smoothed(&observed, &rough, 10f64.powf(exponent), self.least).ok()
        };
        field().map_or(f64::INFINITY, |field| field.cost)
    }

    /// The break where it is likeliest, with the charge that is. Charges to each side are tried as far as cost does not rise
    /// by [`RISE`].
    fn refined(&self, line: Break, exponent: f64) -> Option<(Net, Chosen, Break)> {
        let spacing = 1.0 / self.spans[1] as f64;
        let mut best = (self.cost(line, exponent), line);
        let mut step = 0.5 * spacing;
        // Where the break came from costs more.
        let mut from = f64::NAN;
        while step > STEP * spacing {
            let moved = [-step, step].into_iter().find_map(|by| {
                let next = Break { at: best.1.at + by, ..line };
                let is_known = (next.at - from).abs() < 1e-9 * spacing;
                let inside = (0.5 * spacing..=1.0 - 0.5 * spacing).contains(&next.at);
                let cost = if inside && !is_known { self.cost(next, exponent) } else { f64::INFINITY };
                (cost < best.0).then_some((cost, next))
            });
            match moved {
                Some(moved) => {
                    from = best.1.at;
                    best = moved;
                }
                None => step *= 0.5,
            }
        }
        let line = best.1;
        let own = CHARGES.iter().position(|charge| line.charge.total_cmp(charge).is_eq())?;
        let mut best: Option<(Net, Chosen, Break)> = None;
        for charges in [CHARGES[own..].to_vec(), CHARGES[..own].iter().rev().copied().collect()] {
            for charge in charges {
                let line = Break { charge, ..line };
                let least = best.as_ref().map_or(f64::INFINITY, |best| best.1.field.cost);
                let found = self.weighed(line, exponent, least + RISE);
                let cost = found.as_ref().map_or(f64::INFINITY, |(_, found)| found.field.cost);
                if let Some((net, found)) = found.filter(|_| cost < least) {
                    best = Some((net, found, line));
                }
                if cost > least + RISE {
                    break;
                }
            }
        }
        best
    }
}

/// The scores that are high enough and above those beside them, the greatest first.
fn peaks(scores: &[f64]) -> Vec<usize> {
    let is_peak = |&k: &usize| {
        let near = k.saturating_sub(PLACES)..(k + PLACES + 1).min(scores.len());
        scores[k] > SCORE && scores[near].iter().all(|other| *other <= scores[k])
    };
    let mut peaks: Vec<usize> = (0..scores.len()).filter(is_peak).collect();
    peaks.sort_by(|&a, &b| scores[b].total_cmp(&scores[a]));
    peaks
}

/// Where a break may be in v: between the second waterline of the cells and the last but one, not beside one that is there.
/// Points of sections, and offsets over a keel with rocker, are at many heights: even intervals stand for waterlines.
fn places(cells: &[[f64; 2]], known: &[Break], intervals: f64) -> Vec<f64> {
    const UNIT: f64 = 1e-9;
    let lines: BTreeSet<u64> = cells.iter().map(|[_, v]| (v.max(0.0) / UNIT).round() as u64).collect();
    let mut lines: Vec<f64> = lines.into_iter().map(|line| line as f64 * UNIT).collect();
    if lines.len() as f64 > MANY * (intervals + 1.0) {
        let count = intervals.round().max(1.0) as usize;
        lines = (0..=count).map(|k| k as f64 / count as f64).collect();
    }
    let mean = 1.0 / (lines.len().max(2) - 1) as f64;
    let between = |pair: &[f64]| {
        let [low, high] = [pair[0], pair[1]];
        (0..PLACES).map(move |k| low + (high - low) * k as f64 / PLACES as f64)
    };
    let free =
        |at: &f64| (0.5 * mean..1.0 - 0.5 * mean).contains(at) && known.iter().all(|line| (line.at - at).abs() >= mean);
    let inner = lines.get(1..lines.len().saturating_sub(1)).unwrap_or(&[]);
    inner.windows(2).flat_map(between).filter(free).collect()
}

/// The jumps of curvature of a break at the cells: (v - v0)+^2 times the powers of 2 u - 1.
fn jumps(at: f64, cells: &[[f64; 2]]) -> Vec<Vec<f64>> {
    let value = |[u, v]: [f64; 2], power: usize| (v - at).max(0.0).powi(2) * (2.0 * u - 1.0).powi(power as i32);
    (0..ALONG).map(|power| cells.iter().map(|&cell| value(cell, power)).collect()).collect()
}
