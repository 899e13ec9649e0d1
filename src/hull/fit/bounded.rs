//! Splines of least energy that keep within limits: overshoot between data is pulled back.
//!
//! A spline of least energy through data that end flat (flat of side, closed end) swings beyond them in the
//! neighbouring gaps. Where it leaves the limits of a gap by more than the tolerance, it is made to meet the monotone
//! cubic of the data (Fritsch & Butland 1984) in the middle of the gap, which has a knot of its own for that. The data
//! are met as before.

use super::super::HullError;
use super::FitError;
use super::monotone::{monotone_cubic, monotone_slope};
use crate::spline::{BsplineCurve, Condition, Energy, KnotVector, MinimumEnergy, SplineError};

/// Points in which a gap is looked at.
const LOOKS: usize = 7;

/// A round that multiplies the swing of the control values by more than this is not taken.
const RUNAWAY: f64 = 3.0;

/// Values that differ by less than this part of the tolerance are equal.
const EQUAL: f64 = 1e-6;

/// Rounds of pulling back; a round frees neighbours that were held by the swing before.
const ROUNDS: usize = 4;

/// Further rounds for gaps in which the spline leaves its limits by more than this many tolerances though it is held in
/// the middle: beside a blunt end a fraction of the gap away (the dome of DTMB 5415 was 4.4 m wide between offsets of 3.1
/// and 2.7 m). It is held once more where it is furthest out, this part of the gap from what it meets there.
const WILD_ROUNDS: usize = 8;
const WILD: f64 = 50.0;
const APART: f64 = 0.1;

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
    /// Indices of sites at which the slope is given, and the slopes.
    pub(super) slopes: Vec<(usize, f64)>,
    /// First and last index of what is one value throughout.
    pub(super) runs: Vec<[usize; 2]>,
}

impl Line {
    /// In each gap the span of its two data and a margin on both sides, within [least, most]; the data themselves are
    /// always allowed.
    ///
    /// The margin is what an extremum between the data may need: half the width of the gap times half the smaller of
    /// the slopes on its two sides, each the greater of that within the gap and that of the neighbouring gap. A
    /// parabola sampled at even spaces needs half of it. Where the data are steep on one side only (an end close to a
    /// station, a transom cut by two stations), there is hardly any margin, and the spline cannot shoot over.
    pub(super) fn within(
        sites: Vec<f64>,
        values: Vec<f64>,
        slacks: Vec<f64>,
        limits: [f64; 2],
        tolerance: f64,
    ) -> Self {
        let low = values.iter().copied().fold(limits[0], f64::min);
        let high = values.iter().copied().fold(limits[1], f64::max);
        let gaps = sites.len().saturating_sub(1);
        let slope = |k: usize| ((values[k + 1] - values[k]) / (sites[k + 1] - sites[k])).abs();
        let limits = (0..gaps)
            .map(|k| {
                let sides = [k.checked_sub(1), Some(k + 1).filter(|&n| n < gaps)];
                let steep = sides.into_iter().flatten().map(|n| slope(n).max(slope(k))).fold(f64::INFINITY, f64::min);
                let margin = if steep.is_finite() { 0.25 * (sites[k + 1] - sites[k]) * steep } else { f64::INFINITY };
                let (a, b) = (values[k].min(values[k + 1]), values[k].max(values[k + 1]));
                [(a - margin).max(low), (b + margin).min(high)]
            })
            .collect();
        Self { sites, values, slacks, limits, tolerance, slopes: Vec::new(), runs: Vec::new() }
    }

    /// Limits only where two neighbouring data agree to `tolerance`. Where they are equal the spline is level: slopes
    /// of 0 at the edges of such runs, which want a double knot there.
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
        let mut line = Self {
            slacks: vec![0.0; sites.len()],
            sites,
            values,
            limits,
            tolerance,
            slopes: Vec::new(),
            runs: Vec::new(),
        };
        let last = line.sites.len() - 1;
        line.runs = line.equal();
        line.slopes = line.runs.iter().flatten().filter(|&&k| k > 0 && k < last).map(|&k| (k, 0.0)).collect();
        line
    }

    /// First and last index of each run of equal values.
    fn equal(&self) -> Vec<[usize; 2]> {
        let mut runs: Vec<[usize; 2]> = Vec::new();
        for (k, pair) in self.values.windows(2).enumerate() {
            if (pair[1] - pair[0]).abs() <= EQUAL * self.tolerance {
                match runs.last_mut() {
                    Some(run) if run[1] == k => run[1] = k + 1,
                    _ => runs.push([k, k + 1]),
                }
            }
        }
        runs
    }

    /// Where the spline falls below `lowest` between two sites, both get the slopes of the monotone cubic of the data,
    /// so that on double knots it is that cubic between them. Tells whether there are such gaps.
    pub(super) fn steer(&mut self, knots: &KnotVector, control: &[f64], lowest: f64) -> bool {
        if control.iter().all(|&c| c >= lowest) {
            return false;
        }
        let Ok(curve) = curve_of(knots, control) else { return false };
        let points = self.points();
        let gaps: Vec<usize> =
            (0..self.limits.len()).filter(|&k| self.looks(&curve, k).any(|value| value < lowest)).collect();
        let before = self.slopes.len();
        for k in gaps.into_iter().flat_map(|k| [k, k + 1]) {
            if self.slopes.iter().all(|s| s.0 != k) {
                self.slopes.push((k, monotone_slope(&points, k)));
            }
        }
        self.slopes.sort_unstable_by_key(|s| s.0);
        self.slopes.len() > before
    }

    /// Control values that are one value on each run, where the knots at its edges are double.
    pub(super) fn flattened(&self, knots: &KnotVector, mut control: Vec<f64>) -> Vec<f64> {
        for &[from, to] in &self.runs {
            flatten(knots, &mut control, [self.sites[from], self.sites[to]], self.values[from]);
        }
        control
    }

    /// Values and slopes at the sites.
    fn conditions(&self) -> (Vec<Condition>, Vec<f64>, Vec<f64>) {
        let values = self.sites.iter().map(|&site| Condition { site, order: 0 });
        let slopes = self.slopes.iter().map(|&(k, _)| Condition { site: self.sites[k], order: 1 });
        let mut slacks = self.slacks.clone();
        slacks.resize(self.sites.len() + self.slopes.len(), 0.0);
        (values.chain(slopes).collect(), self.data(), slacks)
    }

    /// What the conditions of the problem without limits ask for.
    pub(super) fn data(&self) -> Vec<f64> {
        self.values.iter().copied().chain(self.slopes.iter().map(|s| s.1)).collect()
    }

    /// The factored problem without limits.
    pub(super) fn problem(&self, energy: &Energy) -> Result<MinimumEnergy, FitError> {
        let (conditions, _, slacks) = self.conditions();
        Ok(energy.smoothing(&conditions, &slacks).map_err(HullError::from)?)
    }

    /// Its solution.
    pub(super) fn free(&self, energy: &Energy) -> Result<Vec<f64>, FitError> {
        Ok(self.problem(energy)?.solve(&self.data()))
    }

    /// Sites and values.
    fn points(&self) -> Vec<(f64, f64)> {
        self.sites.iter().copied().zip(self.values.iter().copied()).collect()
    }

    /// Values of a spline within gap `k`.
    fn looks(&self, curve: &BsplineCurve<1>, k: usize) -> impl Iterator<Item = f64> {
        let (a, b) = (self.sites[k], self.sites[k + 1]);
        (1..=LOOKS).map(move |n| curve.eval(a + (b - a) * n as f64 / (LOOKS + 1) as f64)[0])
    }

    /// Gaps in which the spline leaves its limits, and by how much.
    fn outside(&self, knots: &KnotVector, control: &[f64]) -> Vec<(usize, f64)> {
        // A spline stays within its control values.
        let low = self.limits.iter().map(|l| l[0]).fold(f64::NEG_INFINITY, f64::max) - self.tolerance;
        let high = self.limits.iter().map(|l| l[1]).fold(f64::INFINITY, f64::min) + self.tolerance;
        if control.iter().all(|c| (low..=high).contains(c)) {
            return Vec::new();
        }
        let Ok(curve) = curve_of(knots, control) else { return Vec::new() };
        let beyond = |k: usize| {
            let [low, high] = self.limits[k];
            self.looks(&curve, k).map(|value| (low - value).max(value - high)).fold(f64::NEG_INFINITY, f64::max)
        };
        (0..self.limits.len())
            .filter(|&k| self.limits[k].iter().any(|limit| limit.is_finite()))
            .map(|k| (k, beyond(k)))
            .filter(|gap| gap.1 > self.tolerance)
            .collect()
    }

    /// Middles of the gaps in which the spline leaves its limits.
    pub(super) fn swings(&self, knots: &KnotVector, control: &[f64]) -> Vec<f64> {
        self.outside(knots, control).into_iter().map(|(k, _)| 0.5 * (self.sites[k] + self.sites[k + 1])).collect()
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

    /// The knot inside gap `k` nearest to where the spline is furthest beyond its limits, apart from the sites and from
    /// what is held; none where there is none.
    fn knot_at_worst(
        &self,
        k: usize,
        (knots, breaks): (&KnotVector, &[f64]),
        control: &[f64],
        held: &[(usize, f64)],
    ) -> Option<f64> {
        let curve = curve_of(knots, control).ok()?;
        let ([a, b], [low, high]) = ([self.sites[k], self.sites[k + 1]], self.limits[k]);
        let beyond = |value: f64| (low - value).max(value - high);
        let looks = self.looks(&curve, k).map(beyond).enumerate();
        let (worst, _) = looks.max_by(|x, y| x.1.total_cmp(&y.1))?;
        let worst = a + (b - a) * (worst + 1) as f64 / (LOOKS + 1) as f64;
        let apart = |t: f64| {
            let margin = APART * (b - a);
            (a + margin..=b - margin).contains(&t) && held.iter().all(|h| (h.1 - t).abs() >= margin)
        };
        let inside = breaks.iter().copied().filter(|&t| apart(t));
        inside.min_by(|s, t| (s - worst).abs().total_cmp(&(t - worst).abs()))
    }

    /// The control values; `free` is the solution without limits. Only gaps with a knot inside are pulled back: in others
    /// one more datum would make the spline swing elsewhere. A round that makes it swing much more is not
    /// taken.
    pub(super) fn solve(&self, energy: &Energy, free: Vec<f64>) -> Vec<f64> {
        let points = self.points();
        let breaks = energy.knots().breakpoints();
        let mut held: Vec<(usize, f64)> = Vec::new();
        let mut control = free;
        let attempt = |held: &[(usize, f64)]| -> Option<Vec<f64>> {
            let (mut conditions, mut data, mut slacks) = self.conditions();
            for &(k, site) in held {
                conditions.push(Condition { site, order: 0 });
                data.push(monotone_cubic(&points, site).clamp(self.limits[k][0], self.limits[k][1]));
                slacks.push(0.0);
            }
            Some(energy.smoothing(&conditions, &slacks).ok()?.solve(&data))
        };
        for round in 0..ROUNDS + WILD_ROUNDS {
            let mut gaps: Vec<(usize, f64, f64)> = self
                .outside(energy.knots(), &control)
                .into_iter()
                .filter_map(|(k, by)| {
                    let again = held.iter().any(|h| h.0 == k);
                    let site = if again && by > WILD * self.tolerance {
                        self.knot_at_worst(k, (energy.knots(), &breaks), &control, &held)?
                    } else if again || round >= ROUNDS {
                        return None;
                    } else {
                        self.knot_inside(k, &breaks)?
                    };
                    Some((k, site, by))
                })
                .collect();
            gaps.sort_by(|a, b| b.2.total_cmp(&a.2).then(a.0.cmp(&b.0)));
            // All of them at once, or the worst alone.
            let taken =
                [gaps.len(), 1].into_iter().filter(|&count| count > 0 && count <= gaps.len()).find_map(|count| {
                    let mut trial = held.clone();
                    trial.extend(gaps[..count].iter().map(|gap| (gap.0, gap.1)));
                    let result = attempt(&trial)?;
                    let bound = RUNAWAY * (self.excess(&control) + self.tolerance);
                    (self.excess(&result) <= bound).then_some((trial, result))
                });
            let Some((now, result)) = taken else { break };
            (held, control) = (now, result);
        }
        control
    }
}

fn curve_of(knots: &KnotVector, control: &[f64]) -> Result<BsplineCurve<1>, SplineError> {
    BsplineCurve::new(knots.clone(), control.iter().map(|&c| [c]).collect())
}

/// Control values that have part in the curve between two places, of multiplicity two at least, become one value: what
/// differs is rounding.
pub(super) fn flatten(knots: &KnotVector, control: &mut [f64], [from, to]: [f64; 2], value: f64) {
    let reach = knots.degree() + 1;
    for (k, c) in control.iter_mut().enumerate() {
        if knots.knots()[k + reach] > from + ONE_KNOT && knots.knots()[k] < to - ONE_KNOT {
            *c = value;
        }
    }
}

/// Knots nearer than this to each other are one, over domains of length 1.
pub(super) const ONE_KNOT: f64 = 1e-7;

/// The knots with at least `times`-fold ones at `places`, or at knots that are there already.
pub(super) fn with_multiple(knots: &KnotVector, places: &[f64], times: usize) -> Result<KnotVector, FitError> {
    let mut all = knots.knots().to_vec();
    for &place in places {
        let t = all.iter().copied().find(|k| (k - place).abs() <= ONE_KNOT).unwrap_or(place);
        let lacking = times.saturating_sub(all.iter().filter(|k| (*k - t).abs() <= 0.0).count());
        all.extend(std::iter::repeat_n(t, lacking));
    }
    all.sort_by(f64::total_cmp);
    Ok(KnotVector::new(knots.degree(), all).map_err(HullError::from)?)
}

/// The control values over `to`, which holds all of the knots `from`, exactly.
pub(super) fn carried(from: &KnotVector, control: &[f64], to: &KnotVector) -> Result<Vec<f64>, FitError> {
    let (lower, upper) = from.domain();
    let added: Vec<f64> = to
        .breakpoints()
        .into_iter()
        .filter(|&t| t > lower && t < upper)
        .flat_map(|t| std::iter::repeat_n(t, to.multiplicity(t).saturating_sub(from.multiplicity(t))))
        .collect();
    if added.is_empty() {
        return Ok(control.to_vec());
    }
    let points = control.iter().map(|&c| [c]).collect();
    let fine = BsplineCurve::new(from.clone(), points).and_then(|c| c.insert_knots(&added)).map_err(HullError::from)?;
    Ok(fine.points().iter().map(|p| p[0]).collect())
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

#[cfg(test)]
mod tests {
    use super::*;

    /// The waterline 1 m below the base line of DTMB 5415, whose dome ends a fraction of the last space forward.
    #[test]
    fn a_row_beside_a_blunt_end_is_held_until_it_does_not_swing() {
        let sites = vec![0.0, 0.065, 0.135, 0.19, 0.5, 0.948, 1.0];
        let values = vec![0.0, 1.7, 2.65, 2.973, 3.094, 2.74, 0.0];
        let greatest = 10.2;
        let line = Line::within(sites, values, vec![0.0; 7], [0.0, greatest], 1e-4 * greatest);
        let knots = KnotVector::uniform(3, 60).unwrap();
        let energy = Energy::new(&knots, 2);
        let widest = |control: &[f64]| {
            let curve = curve_of(&knots, control).unwrap();
            (0..100).map(|k| curve.eval(0.5 + 0.00448 * f64::from(k))[0]).fold(0.0, f64::max)
        };
        let free = line.free(&energy).unwrap();
        assert!(widest(&free) > 5.0, "{}", widest(&free));
        let held = line.solve(&energy, free);
        assert!(widest(&held) < 3.25, "{}", widest(&held));
    }
}
