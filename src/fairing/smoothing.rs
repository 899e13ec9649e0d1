//! How much to smooth: generalised cross-validation, the noise of the readings, leverages.
//!
//! For a weight lambda, c(lambda) minimises sum w_k (a_k c - d_k)^2 + lambda c'E c (Wahba 1990; E scaled to the mean
//! size of A'WA). With N = A'WA + lambda E, the leverage of a reading is h_k = w_k a_k N^-1 a_k', edf = sum h_k, and
//!
//! ```text
//! GCV(lambda) = m RSS / (m - gamma edf)^2,   gamma = 1.2 (Craven & Wahba 1979; Gu 2013, section 3.2, for gamma)
//! sigma^2 = RSS / (m - edf)
//! ```
//!
//! over the m readings of positive weight. All leverages come from the part of N^-1 inside the band, so that one weight
//! costs a factor and an inverse of a banded matrix, O(n w^2), without any eigenproblem. The search is a scan of 25
//! powers followed by Brent's method on log lambda.

use super::model::{Model, Reduced};
use crate::numeric::{BandedCholesky, SingularMatrix, SymmetricBand, median};
use argmin::core::{CostFunction, Executor, State};
use argmin::solver::brent::BrentOpt;

/// Weight of the degrees of freedom in the criterion; above 1 it guards against too little smoothing.
pub const GAMMA: f64 = 1.2;

/// Powers of ten of lambda that are scanned. Tried instead: on beyond the last one as long as that is best. Sections of
/// points of a boat with errors of 3 mm came to 2.8 mm from the hull for 2.5 mm, with 1e8 to 4.9 mm: the energy on the
/// net of a fit knows that hull's noise too.
const SCAN: [f64; 2] = [-11.0, 6.0];

/// Least power of ten of the weight that is taken for a given noise.
const LEAST: f64 = -7.0;

/// Weight of the start, over the mean of the diagonal of A'WA. It decides where the offsets say little: between them a
/// net that only smooths them swings by more than it takes out (1e-5 instead: 9.8 mm for 3.4 mm on an S-175 with 2 mm
/// of noise).
const PRIOR: f64 = 0.3;

/// Steps of the scan.
const STEPS: usize = 18;

/// Steps of half a power of ten below a weight that are tried for the surface through a table.
const BELOW: i32 = 24;

/// The smoothing problem, ready for any weight.
#[derive(Debug, Clone)]
pub struct Smoother {
    /// The model without known values.
    pub reduced: Reduced,
    normal: SymmetricBand,
    /// A'WA of the readings alone, without the pull to the start.
    of_readings: SymmetricBand,
    energy: SymmetricBand,
    right: Vec<f64>,
    pull: Vec<f64>,
    weights: Vec<f64>,
    /// What lambda = 1 stands for: multiplies E.
    pub unit: f64,
    count: usize,
}

/// Whether a weight is at an end of those that were tried, in words after it.
#[must_use]
pub fn end_of_search(lambda: f64, trials: &[Trial]) -> &'static str {
    let tried = || trials.iter().map(|trial| trial.lambda);
    match lambda {
        _ if trials.is_empty() => "",
        taken if taken >= tried().fold(0.0, f64::max) => " (the largest tried)",
        taken if taken <= tried().fold(f64::INFINITY, f64::min) => " (the smallest tried)",
        _ => "",
    }
}

/// A smoothed net.
#[derive(Debug, Clone)]
pub struct Smoothed {
    /// The weight, in units of [`Smoother::unit`].
    pub lambda: f64,
    /// The free control values.
    pub free: Vec<f64>,
    /// Residuals a_k c - d_k of all readings \[m\].
    pub residuals: Vec<f64>,
    /// Leverages of all readings: w_k a_k N^-1 a_k'.
    pub leverages: Vec<f64>,
    /// Effective degrees of freedom.
    pub edf: f64,
    /// Weighted sum of squared residuals \[m^2\].
    pub rss: f64,
    /// c'E c, unscaled.
    pub energy: f64,
    /// Cholesky factor of N.
    pub factor: BandedCholesky,
}

/// A point of the search, for the L-curve.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Trial {
    /// The weight.
    pub lambda: f64,
    /// The criterion.
    pub gcv: f64,
    /// Root of the mean weighted square of the residuals \[m\].
    pub rms: f64,
    /// c'E c.
    pub energy: f64,
    /// Effective degrees of freedom.
    pub edf: f64,
}

impl Trial {
    /// A net of weight `lambda` with its weighted sum of squares over `count` readings and its degrees of freedom.
    fn new(count: usize, lambda: f64, [rss, edf]: [f64; 2], energy: f64) -> Self {
        let m = count as f64;
        let freedom = m - GAMMA * edf;
        // Beyond the pole the criterion means nothing: too many degrees of freedom.
        let gcv = if freedom > 0.0 { m * rss / (freedom * freedom) } else { f64::INFINITY };
        Self { lambda, gcv, rms: (rss / m.max(1.0)).sqrt(), energy, edf }
    }
}

impl Smoothed {
    /// The point of the search where this net stands, for `count` readings.
    #[must_use]
    pub fn trial(&self, count: usize) -> Trial {
        Trial::new(count, self.lambda, [self.rss, self.edf], self.energy)
    }

    /// The noise of a reading of weight 1 \[m\].
    #[must_use]
    pub fn sigma(&self, count: usize) -> f64 {
        (self.rss / (count as f64 - self.edf).max(1.0)).sqrt()
    }

    /// The noise of a typical reading of weight 1 \[m\].
    fn typical_noise(&self, weights: &[f64]) -> f64 {
        let weighted = self.residuals.iter().zip(&self.leverages).zip(weights).filter(|(_, w)| **w > 0.0);
        let mut sizes: Vec<f64> = weighted.map(|((r, h), w)| r.abs() * w.sqrt() / (1.0 - h).max(1e-6).sqrt()).collect();
        1.4826 * median(&mut sizes).unwrap_or(0.0)
    }

    /// Residuals of readings left out one by one, r_k / (1 - h_k) \[m\]; readings of weight 0 are left out as they are.
    #[must_use]
    pub fn left_out(&self) -> Vec<f64> {
        self.residuals.iter().zip(&self.leverages).map(|(r, h)| r / (1.0 - h).max(1e-9)).collect()
    }
}

impl Smoother {
    /// Assembles A'WA and E over the free control values.
    #[must_use]
    pub fn new(model: &Model) -> Self {
        Self::weighted(model.reduced(), model.readings.iter().map(|reading| reading.weight).collect())
    }

    fn weighted(reduced: Reduced, weights: Vec<f64>) -> Self {
        let n = reduced.free.len();
        let straight = reduced.straight.as_ref().map_or(0, SymmetricBand::width);
        let mut width = reduced.energy.width().max(straight);
        for k in 0..reduced.data.row_count() {
            let columns = reduced.data.row(k).0;
            if let (Some(first), Some(last)) = (columns.first(), columns.last()) {
                width = width.max(last - first);
            }
        }
        let mut normal = SymmetricBand::zeros(n, width);
        let mut right = vec![0.0; n];
        for (k, &weight) in weights.iter().enumerate() {
            if weight == 0.0 {
                continue;
            }
            let (columns, values) = reduced.data.row(k);
            for (a, &i) in columns.iter().enumerate() {
                right[i] += weight * values[a] * reduced.values[k];
                for (b, &j) in columns[..=a].iter().enumerate() {
                    normal.add(i, j, weight * values[a] * values[b]);
                }
            }
        }
        let of_readings = normal.clone();
        if let Some(start) = &reduced.start {
            let weight = PRIOR * normal.trace() / n.max(1) as f64;
            for (i, value) in start.iter().enumerate() {
                normal.add(i, i, weight);
                right[i] += weight * value;
            }
        }
        let (trace, size) = (reduced.energy.trace(), normal.trace());
        if let Some(straight) = &reduced.straight {
            normal.add_band(size, straight);
        }
        let unit = if trace > 0.0 { size / trace } else { 1.0 };
        let mut energy = SymmetricBand::zeros(n, width);
        energy.add_band(unit, &reduced.energy);
        let pull = reduced.pull.iter().map(|e| unit * e).collect();
        let count = weights.iter().filter(|&&weight| weight > 0.0).count();
        Self { reduced, normal, of_readings, energy, right, pull, weights, unit, count }
    }

    /// The largest weight, in half powers of ten below `lambda`, whose residuals are `rms` at most \[m\]; the least that makes a
    /// net where none does.
    #[must_use]
    pub fn through(&self, lambda: f64, rms: f64) -> f64 {
        let mut best = lambda;
        for power in 0..=BELOW {
            let weight = lambda * 0.1f64.powf(0.5 * f64::from(power));
            let Ok((free, _)) = self.solved(weight) else { break };
            best = weight;
            if (self.rss(&free) / self.count.max(1) as f64).sqrt() <= rms {
                break;
            }
        }
        best
    }

    /// The same problem with other weights of the readings.
    #[must_use]
    pub fn reweighted(&self, weights: &[f64]) -> Self {
        Self::weighted(self.reduced.clone(), weights.to_vec())
    }

    /// Number of readings of positive weight.
    #[must_use]
    pub fn count(&self) -> usize {
        self.count
    }

    /// Weights of the readings.
    #[must_use]
    pub fn weights(&self) -> &[f64] {
        &self.weights
    }

    /// The right-hand side for a weight.
    fn right(&self, lambda: f64) -> Vec<f64> {
        self.right.iter().zip(&self.pull).map(|(b, e)| b - lambda * e).collect()
    }

    /// N = A'WA + lambda E and its right-hand side, for a quadratic program over the free values.
    #[must_use]
    pub fn normal(&self, lambda: f64) -> (SymmetricBand, Vec<f64>) {
        (self.normal.plus(lambda, &self.energy), self.right(lambda))
    }

    /// What a move of the control values costs where it is to be one of the whole hull, with this weight of its energy: over
    /// the whole surface where that is known, else at the readings.
    #[must_use]
    pub(super) fn metric_of_moves(&self, weight: f64) -> SymmetricBand {
        match &self.reduced.moves {
            Some(moves) => {
                let mut all = SymmetricBand::zeros(moves.size(), self.energy.width());
                all.add_band(1.0, moves);
                all.plus(weight, &self.energy)
            }
            None => self.normal(weight).0,
        }
    }

    /// lambda E over the unknowns: what a move d costs in energy alone, d'(lambda E) d \[m^2\].
    #[must_use]
    pub(super) fn energy_of_moves(&self, lambda: f64) -> SymmetricBand {
        let mut energy = SymmetricBand::zeros(self.energy.size(), self.energy.width());
        energy.add_band(lambda, &self.energy);
        energy
    }

    /// What the linear part of a program over these unknowns has more with the readings and the origin of `other`.
    #[must_use]
    pub fn linear_less(&self, lambda: f64, other: &Self) -> Vec<f64> {
        let (matrix, own) = self.normal(lambda);
        let apart = matrix.apply(&other.reduced.unknowns_of(&self.reduced.expand(&vec![0.0; own.len()])));
        let right = other.right(lambda);
        (0..own.len()).map(|i| 2.0 * (apart[i] + own[i] - right[i])).collect()
    }

    /// The free control values for one weight, with the factor of N.
    fn solved(&self, lambda: f64) -> Result<(Vec<f64>, BandedCholesky), SingularMatrix> {
        let (matrix, mut free) = self.normal(lambda);
        let factor = matrix.factor()?;
        factor.solve(&mut free);
        Ok((free, factor))
    }

    /// The net for one weight.
    ///
    /// # Errors
    /// [`SingularMatrix`] when readings and energy together do not determine a control value.
    pub fn at(&self, lambda: f64) -> Result<Smoothed, SingularMatrix> {
        let (free, factor) = self.solved(lambda)?;
        let inverse = factor.inverse_band();
        let data = &self.reduced.data;
        let mut leverages = Vec::with_capacity(self.weights.len());
        let mut residuals = Vec::with_capacity(self.weights.len());
        let (mut rss, mut edf) = (0.0, 0.0);
        for (k, &weight) in self.weights.iter().enumerate() {
            let residual = data.dot(k, &free) - self.reduced.values[k];
            residuals.push(residual);
            if weight == 0.0 {
                leverages.push(0.0);
                continue;
            }
            let leverage = inverse.quadratic_form(data.entries(k));
            leverages.push(weight * leverage);
            edf += weight * leverage;
            rss += weight * residual * residual;
        }
        let energy = self.energy_of(&free);
        Ok(Smoothed { lambda, free, residuals, leverages, edf, rss, energy, factor })
    }

    /// The energy, unscaled, of free control values ([`super::model::Model::energy_of`]).
    fn energy_of(&self, free: &[f64]) -> f64 {
        let curved = self.reduced.energy.apply(free);
        let energy = (0..free.len()).map(|i| free[i] * (curved[i] + 2.0 * self.reduced.pull[i])).sum::<f64>();
        energy + self.reduced.constant
    }

    /// What the search wants to know of a weight; edf is the trace of A'WA N^-1, without the leverages of single
    /// readings.
    pub(super) fn trial(&self, lambda: f64) -> Option<Trial> {
        let (free, factor) = self.solved(lambda).ok()?;
        let edf = self.of_readings.trace_of_product(&factor.inverse_band());
        Some(Trial::new(self.count, lambda, [self.rss(&free), edf], self.energy_of(&free)))
    }

    /// sum w_k r_k^2 + lambda E of unknowns \[m^2\].
    #[must_use]
    pub fn objective(&self, lambda: f64, x: &[f64]) -> f64 {
        self.rss(x) + lambda * self.unit * self.energy_of(x)
    }

    /// Weighted sum of squared residuals of free control values \[m^2\].
    fn rss(&self, free: &[f64]) -> f64 {
        let data = &self.reduced.data;
        let weighted = self.weights.iter().enumerate().filter(|(_, weight)| **weight > 0.0);
        weighted.map(|(k, weight)| weight * (data.dot(k, free) - self.reduced.values[k]).powi(2)).sum()
    }

    /// The weight of least Mallows C_p = RSS + 2 sigma^2 edf (Mallows 1973) for readings of known noise \[m\], to half
    /// a power of ten, and every weight that was tried, in rising order. Where features of the hull are cut, RSS pays
    /// for it: unlike the weight that leaves residuals of size sigma, this one does not smooth until they are. Tried
    /// without success: never less than the weight of least GCV, which takes the roughness of published tables for
    /// noise (Series 60 with 2 mm of noise, five tables: 4.2 mm for 3.1 mm, an S-175 6.0 mm for 4.1 mm).
    ///
    /// # Errors
    /// [`SingularMatrix`] when no weight of the scan gives a net.
    pub fn for_noise(&self, noise: f64) -> Result<(f64, Vec<Trial>), SingularMatrix> {
        let m = self.count as f64;
        let cost = |trial: &Trial| m * trial.rms * trial.rms + 2.0 * noise * noise * trial.edf;
        let mut trials: Vec<Trial> = Vec::new();
        let mut power = SCAN[1];
        while power >= LEAST {
            trials.extend(self.trial(10f64.powf(power)));
            // Beyond its least the criterion rises by what the degrees of freedom cost, no more.
            if trials.len() > 2 && trials[trials.len() - 3..].windows(2).all(|w| cost(&w[1]) > cost(&w[0])) {
                break;
            }
            power -= 1.0;
        }
        let least = |trials: &[Trial]| trials.iter().copied().min_by(|a, b| cost(a).total_cmp(&cost(b)));
        if let Some(best) = least(&trials) {
            trials.extend([-0.5, 0.5].iter().filter_map(|step| self.trial(best.lambda * 10f64.powf(*step))));
        }
        trials.sort_by(|a, b| a.lambda.total_cmp(&b.lambda));
        match least(&trials) {
            Some(best) => Ok((best.lambda, trials)),
            None => self.at(10f64.powf(LEAST)).map(|smoothed| (smoothed.lambda, trials)),
        }
    }

    /// The greatest weight of the scan at which the noise of a typical reading, 1.4826 times the median of |r_k|
    /// sqrt(w_k) / sqrt(1 - h_k), is no more than `noise` \[m\] (Morozov 1966); the least one where none is.
    ///
    /// # Errors
    /// [`SingularMatrix`] when no weight of the scan gives a net.
    pub fn for_discrepancy(&self, noise: f64) -> Result<f64, SingularMatrix> {
        let mut last = Err(SingularMatrix { column: 0 });
        let mut power = SCAN[1];
        while power >= LEAST {
            let lambda = 10f64.powf(power);
            match self.at(lambda) {
                Ok(smoothed) if smoothed.typical_noise(&self.weights) <= noise => return Ok(lambda),
                Ok(_) => last = Ok(lambda),
                Err(error) => last = last.or(Err(error)),
            }
            power -= 1.0;
        }
        last
    }

    /// The weight of least GCV, and every weight that was tried, in rising order.
    ///
    /// # Errors
    /// [`SingularMatrix`] when no weight of the scan gives a net.
    pub fn cross_validated(&self) -> Result<(f64, Vec<Trial>), SingularMatrix> {
        let step = (SCAN[1] - SCAN[0]) / (STEPS - 1) as f64;
        let mut trials: Vec<Trial> = Vec::new();
        // From the smoothest net on: once the criterion has grown tenfold beyond its least, less smoothing does not pay.
        let mut least = f64::INFINITY;
        for k in (0..STEPS).rev() {
            let Some(trial) = self.trial(10f64.powf(SCAN[0] + step * k as f64)) else { continue };
            trials.push(trial);
            least = least.min(trial.gcv);
            if trial.gcv > 10.0 * least || trial.gcv.is_infinite() {
                break;
            }
        }
        trials.reverse();
        let finite = trials.iter().enumerate().filter(|(_, trial)| trial.gcv.is_finite());
        let Some((best, _)) = finite.min_by(|a, b| a.1.gcv.total_cmp(&b.1.gcv)) else {
            let lambda = trials.last().map_or(1.0, |trial| trial.lambda);
            return self.at(lambda).map(|smoothed| (smoothed.lambda, trials));
        };
        let low = trials[best.saturating_sub(1)].lambda.log10();
        let high = trials[(best + 1).min(trials.len() - 1)].lambda.log10();
        let mut lambda = trials[best].lambda;
        if high > low {
            let solver = BrentOpt::new(low, high).set_tolerance(0.0, 0.02);
            let run = Executor::new(Criterion(self), solver).configure(|state| state.max_iters(20)).run();
            if let Some(found) = run.ok().and_then(|run| run.state().get_best_param().copied())
                && let Some(trial) = self.trial(10f64.powf(found))
                && trial.gcv <= trials[best].gcv
            {
                lambda = trial.lambda;
                trials.push(trial);
                trials.sort_by(|a, b| a.lambda.total_cmp(&b.lambda));
            }
        }
        Ok((lambda, trials))
    }
}

struct Criterion<'a>(&'a Smoother);

impl CostFunction for Criterion<'_> {
    type Param = f64;
    type Output = f64;

    fn cost(&self, power: &f64) -> Result<f64, argmin::core::Error> {
        let trial = self.0.trial(10f64.powf(*power)).filter(|trial| trial.gcv.is_finite());
        trial.map(|trial| trial.gcv.ln()).ok_or_else(|| argmin::core::Error::msg("no net for this weight"))
    }
}
