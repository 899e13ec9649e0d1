//! Splines of least energy that keep within limits: overshoot between data is pulled back.
//!
//! A spline of least energy through data that end flat (flat of side, closed end) swings beyond them in the neighbouring gaps. Where
//! it leaves the limits of a gap by more than the tolerance, it is made to meet the monotone cubic of the data (Fritsch & Butland
//! 1984) in the middle of the gap, which has a knot of its own for that. The data are met as before.

use super::super::HullError;
use super::FitError;
use super::monotone::monotone_cubic;
use crate::spline::{BsplineCurve, Condition, Energy, KnotVector, MinimumEnergy};

/// Points in which a gap is looked at.
const LOOKS: usize = 7;

/// A round that multiplies the swing of the control values by more than this is not taken.
const RUNAWAY: f64 = 3.0;

/// Rounds of pulling back; a round frees neighbours that were held by the swing before.
const ROUNDS: usize = 4;

/// Data on one line: sites rising, values, slacks, and how far the spline may go in each gap.
#[derive(Debug, Clone)]
pub(super) struct Line {
    pub(super) sites: Vec<f64>,
    pub(super) values: Vec<f64>,
    pub(super) slacks: Vec<f64>,
    /// Limits of each gap, one fewer than sites.
    pub(super) limits: Vec<[f64; 2]>,
    /// How far beyond the limits is left alone.
    pub(super) tolerance: f64,
}

impl Line {
    /// The same limits, [least, most], everywhere; the data themselves are always allowed.
    pub(super) fn within(
        sites: Vec<f64>,
        values: Vec<f64>,
        slacks: Vec<f64>,
        limits: [f64; 2],
        tolerance: f64,
    ) -> Self {
        let low = values.iter().copied().fold(limits[0], f64::min);
        let high = values.iter().copied().fold(limits[1], f64::max);
        let limits = vec![[low, high]; sites.len().saturating_sub(1)];
        Self { sites, values, slacks, limits, tolerance }
    }

    /// Limits only where two neighbouring data agree to `tolerance`.
    pub(super) fn flat_kept(sites: Vec<f64>, values: Vec<f64>, tolerance: f64) -> Self {
        let limits = values
            .windows(2)
            .map(|w| {
                if (w[1] - w[0]).abs() <= tolerance {
                    [w[0].min(w[1]), w[0].max(w[1])]
                } else {
                    [f64::NEG_INFINITY, f64::INFINITY]
                }
            })
            .collect();
        Self { slacks: vec![0.0; sites.len()], sites, values, limits, tolerance }
    }

    fn conditions(&self) -> Vec<Condition> {
        self.sites.iter().map(|&site| Condition { site, order: 0 }).collect()
    }

    /// The factored problem without limits.
    pub(super) fn problem(&self, energy: &Energy) -> Result<MinimumEnergy, FitError> {
        Ok(energy.smoothing(&self.conditions(), &self.slacks).map_err(HullError::from)?)
    }

    /// Gaps in which the spline leaves its limits.
    fn outside(&self, knots: &KnotVector, control: &[f64]) -> Vec<usize> {
        // A spline stays within its control values.
        let low = self.limits.iter().map(|l| l[0]).fold(f64::NEG_INFINITY, f64::max) - self.tolerance;
        let high = self.limits.iter().map(|l| l[1]).fold(f64::INFINITY, f64::min) + self.tolerance;
        if control.iter().all(|c| (low..=high).contains(c)) {
            return Vec::new();
        }
        let Ok(curve) = BsplineCurve::new(knots.clone(), control.iter().map(|&c| [c]).collect()) else {
            return Vec::new();
        };
        (0..self.limits.len())
            .filter(|&k| {
                let [low, high] = self.limits[k];
                let (a, b) = (self.sites[k], self.sites[k + 1]);
                (low.is_finite() || high.is_finite())
                    && (1..=LOOKS).any(|n| {
                        let value = curve.eval(a + (b - a) * n as f64 / (LOOKS + 1) as f64)[0];
                        value < low - self.tolerance || value > high + self.tolerance
                    })
            })
            .collect()
    }

    /// Middles of the gaps in which the spline leaves its limits.
    pub(super) fn swings(&self, knots: &KnotVector, control: &[f64]) -> Vec<f64> {
        self.outside(knots, control).into_iter().map(|k| 0.5 * (self.sites[k] + self.sites[k + 1])).collect()
    }

    /// How far the control values lie beyond all limits.
    pub(super) fn excess(&self, control: &[f64]) -> f64 {
        let low = self.limits.iter().map(|l| l[0]).fold(f64::INFINITY, f64::min);
        let high = self.limits.iter().map(|l| l[1]).fold(f64::NEG_INFINITY, f64::max);
        control.iter().map(|c| (low - c).max(c - high)).fold(0.0, f64::max)
    }

    /// The knot inside gap `k` that is nearest to its middle; none where the gap has no knot of its own.
    fn knot_inside(&self, k: usize, breaks: &[f64]) -> Option<f64> {
        let (a, b) = (self.sites[k], self.sites[k + 1]);
        let (middle, margin) = (0.5 * (a + b), 0.2 * (b - a));
        let inside = breaks.iter().copied().filter(|t| (a + margin..=b - margin).contains(t));
        inside.min_by(|s, t| (s - middle).abs().total_cmp(&(t - middle).abs()))
    }

    /// The control values; `free` is the solution without limits. Only gaps with a knot inside are pulled back: in others
    /// one more datum would make the spline swing elsewhere. A round that makes it swing much more is not
    /// taken.
    pub(super) fn solve(&self, energy: &Energy, free: Vec<f64>) -> Vec<f64> {
        let points: Vec<(f64, f64)> = self.sites.iter().copied().zip(self.values.iter().copied()).collect();
        let breaks = energy.knots().breakpoints();
        let mut held: Vec<(usize, f64)> = Vec::new();
        let mut control = free;
        for _ in 0..ROUNDS {
            let gaps = self.outside(energy.knots(), &control);
            let new: Vec<(usize, f64)> = gaps
                .into_iter()
                .filter(|k| held.iter().all(|h| h.0 != *k))
                .filter_map(|k| self.knot_inside(k, &breaks).map(|site| (k, site)))
                .collect();
            if new.is_empty() {
                break;
            }
            held.extend(new);
            let mut conditions = self.conditions();
            let (mut data, mut slacks) = (self.values.clone(), self.slacks.clone());
            for &(k, site) in &held {
                conditions.push(Condition { site, order: 0 });
                data.push(monotone_cubic(&points, site).clamp(self.limits[k][0], self.limits[k][1]));
                slacks.push(0.0);
            }
            let Ok(problem) = energy.smoothing(&conditions, &slacks) else { break };
            let trial = problem.solve(&data);
            if self.excess(&trial) > RUNAWAY * (self.excess(&control) + self.tolerance) {
                break;
            }
            control = trial;
        }
        control
    }
}

/// Adds simple knots at `middles` that are not near a knot already.
pub(super) fn with_knots(knots: &KnotVector, mut middles: Vec<f64>) -> Result<KnotVector, FitError> {
    let breaks = knots.breakpoints();
    middles.sort_by(f64::total_cmp);
    let mut added: Vec<f64> = Vec::new();
    for at in middles {
        let k = breaks.partition_point(|&b| b <= at).clamp(1, breaks.len() - 1);
        let width = breaks[k] - breaks[k - 1];
        let near = (at - breaks[k - 1]).min(breaks[k] - at) < 0.1 * width;
        if !near && added.last().is_none_or(|last| at - last > 0.1 * width) {
            added.push(at);
        }
    }
    let mut all = knots.knots().to_vec();
    all.extend(added);
    all.sort_by(f64::total_cmp);
    Ok(KnotVector::new(knots.degree(), all).map_err(HullError::from)?)
}
