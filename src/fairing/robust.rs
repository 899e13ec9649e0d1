//! Readings that contradict the net which smooths all others: gross errors that the neighbours of a cell are too few to
//! tell from noise.
//!
//! 1. No cross-validation of contaminated readings: the weight has the least median of |e_k|, e_k = r_k / (1 - h_k) the
//!    residuals with reading k left out, among those with edf <= 0.35 m.
//! 2. Five rounds of Huber's weights min(1, k s / |e|), k = 1.345, then Tukey's (1 - (e / c s)^2)^2, c = 4.685, until
//!    they stand; s is 1.4826 times the median of |e| (Huber 1981, chapter 7; Beaton & Tukey 1974).
//! 3. What Tukey's weights all but leave out is rejected; the others are taken as they are. With sigma^2 = RSS / (m -
//!    edf) of these a reading is tested by t = r / (sigma sqrt(1 - h)) where it takes part and t = r / (sigma sqrt(1 +
//!    q)), q = a N^-1 a', where it does not. Beyond the point that one table in 50 exceeds by chance anywhere
//!    (Bonferroni) it stays out, below it comes in again, until nothing changes.
//!
//! Medians of the error to Wigley's hull without and with this stage, 8 tables each (`cargo bench --bench truth -- 8
//! once neighbours`): 2 mm of noise with 20, 20 and 30 mm in single cells 1.20 and 0.55 mm; with 12 mm in one 1.07 and
//! 0.67 mm; with 30 mm in three cells side by side 3.54 and 0.56 mm; 25 mm of noise with 250, 300 and 500 mm 6.71 and
//! 5.08 mm.

use super::smoothing::{Smoothed, Smoother};
use crate::numeric::{SingularMatrix, median};

/// Standard deviations of a residual, with the noise of the typical one, from which readings are looked at more closely.
const STANDS_OUT: f64 = 3.5;
/// Most effective degrees of freedom, in readings.
const FREEDOM: f64 = 0.35;
/// Powers of ten of the weight that are tried.
const POWERS: [i32; 2] = [-8, 3];
/// Huber's and Tukey's constants: 95 % efficiency for normal noise.
const HUBER: f64 = 1.345;
const TUKEY: f64 = 4.685;
/// Rounds of either.
const ROUNDS: [usize; 2] = [5, 10];
/// Weight below which a reading counts as rejected at first.
const REJECTED: f64 = 0.05;
/// Weight of a rejected reading: it has a leverage, and no say.
const NONE: f64 = 1e-9;
/// Probability that any reading of a clean table is rejected.
const LEVEL: f64 = 0.02;
/// Most rejections, in readings: more are no gross errors.
const MOST: f64 = 0.05;

/// 1.4826 times the median of the sizes: the standard deviation of most of them.
pub(super) fn typical(values: impl Iterator<Item = f64>) -> f64 {
    1.4826 * median(&mut values.map(f64::abs).collect::<Vec<_>>()).unwrap_or(0.0)
}

/// The t that a normal value exceeds with probability `p`, for `freedom` degrees of freedom (Abramowitz & Stegun 1964,
/// 26.2.23 and 26.7.5, the first term): within 1 % for p from 1e-6 to 1e-2 and 30 degrees of freedom or more.
pub(super) fn point_of_t(p: f64, freedom: f64) -> f64 {
    let t = (-2.0 * p.ln()).sqrt();
    let z =
        t - (2.515_517 + t * (0.802_853 + t * 0.010_328)) / (1.0 + t * (1.432_788 + t * (0.189_269 + t * 0.001_308)));
    z * (1.0 + (z * z + 1.0) / (4.0 * freedom.max(1.0)))
}

/// The problem with readings that have a leverage, and no say.
pub(super) fn without(smoother: &Smoother, out: &[bool]) -> Smoother {
    let weights = smoother.weights().iter().zip(out);
    smoother.reweighted(&weights.map(|(weight, out)| if *out { NONE * weight } else { *weight }).collect::<Vec<_>>())
}

/// The net with readings left out, the test value of every reading and the degrees of freedom.
pub(super) fn tested(
    smoother: &Smoother,
    lambda: f64,
    out: &[bool],
) -> Result<(Smoothed, Vec<f64>, f64), SingularMatrix> {
    let smoother = without(smoother, out);
    let (weights, smoothed) = (smoother.weights(), smoother.at(lambda)?);
    let kept = weights.iter().zip(out).filter(|(weight, out)| **weight > 0.0 && !**out).count() as f64;
    let freedom = (kept - smoothed.edf).max(1.0);
    let sigma = (smoothed.rss / freedom).sqrt();
    let values = (0..weights.len())
        .map(|k| {
            let (weight, h) = (weights[k], smoothed.leverages[k]);
            let spread = if out[k] { 1.0 + h / NONE } else { (1.0 - h).max(1e-6) };
            let own = if out[k] { weight / NONE } else { weight };
            if own > 0.0 { smoothed.residuals[k] * own.sqrt() / (sigma * spread.sqrt()) } else { 0.0 }
        })
        .collect();
    Ok((smoothed, values, freedom))
}

/// Indices of the readings that contradict all others, with what the net of these has more there \[m\]; `smoothed` is
/// the net of all. None where no reading stands out, or too many do.
///
/// # Errors
/// [`SingularMatrix`] when no weight gives a net.
pub(super) fn gross_errors(smoother: &Smoother, smoothed: &Smoothed) -> Result<Vec<(usize, f64)>, SingularMatrix> {
    let given = smoother.weights();
    let of = |smoothed: &Smoothed, k: usize| {
        (given[k] > 0.0)
            .then(|| smoothed.residuals[k] * given[k].sqrt() / (1.0 - smoothed.leverages[k]).max(1e-6).sqrt())
    };
    let sizes = || (0..given.len()).filter_map(|k| of(smoothed, k));
    if sizes().fold(0.0_f64, |most, size| most.max(size.abs())) <= STANDS_OUT * typical(sizes()) {
        return Ok(Vec::new());
    }
    let count = smoother.count() as f64;
    // The weight that predicts the typical reading best.
    let left_out = |smoothed: &Smoothed| -> Vec<f64> {
        smoothed.left_out().iter().zip(given).map(|(e, weight)| e * weight.sqrt()).collect()
    };
    let size_of = |list: &[f64]| typical(list.iter().zip(given).filter(|(_, weight)| **weight > 0.0).map(|(e, _)| *e));
    let mut best: Option<(f64, f64)> = None;
    for power in (POWERS[0]..=POWERS[1]).rev() {
        let Ok(tried) = smoother.at(10f64.powi(power)) else { continue };
        if tried.edf > FREEDOM * count {
            break;
        }
        let size = size_of(&left_out(&tried));
        if best.is_none_or(|(least, _)| size < least) {
            best = Some((size, tried.lambda));
        }
    }
    let Some((_, lambda)) = best else { return Ok(Vec::new()) };
    // Huber's weights, then Tukey's.
    let mut factors = vec![1.0; given.len()];
    for round in 0..ROUNDS[0] + ROUNDS[1] {
        let weights: Vec<f64> = given.iter().zip(&factors).map(|(weight, factor)| weight * factor).collect();
        let tried = smoother.reweighted(&weights).at(lambda)?;
        let errors = left_out(&tried);
        let scale = size_of(&errors).max(f64::MIN_POSITIVE);
        let next: Vec<f64> = errors
            .iter()
            .map(|e| match (e / scale).abs() {
                size if round < ROUNDS[0] => (HUBER / size).min(1.0),
                size => (1.0 - (size / TUKEY).powi(2)).max(0.0).powi(2).max(NONE),
            })
            .collect();
        let moved = next.iter().zip(&factors).fold(0.0_f64, |most, (a, b)| most.max((a - b).abs()));
        factors = next;
        if round >= ROUNDS[0] && moved < 1e-3 {
            break;
        }
    }
    let mut out: Vec<bool> = factors.iter().map(|factor| *factor < REJECTED).collect();
    let (mut smoothed, mut values, mut freedom) = tested(smoother, lambda, &out)?;
    for _ in 0..ROUNDS[1] {
        let limit = point_of_t(0.5 * LEVEL / count, freedom);
        let next: Vec<bool> = values.iter().map(|t| t.abs() > limit).collect();
        if next == out {
            break;
        }
        out = next;
        (smoothed, values, freedom) = tested(smoother, lambda, &out)?;
    }
    let list: Vec<usize> = (0..out.len()).filter(|&k| out[k]).collect();
    if list.len() as f64 > MOST * count {
        return Ok(Vec::new());
    }
    Ok(list.into_iter().map(|k| (k, smoothed.residuals[k])).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_of_student() {
        // Two-sided points of Student's t: 0.001 for 60 and 120 degrees of freedom, 1e-4 for infinitely many.
        for (p, freedom, point) in [(0.0005, 60.0, 3.460), (0.0005, 120.0, 3.373), (5e-5, 1e9, 3.891)] {
            assert!((point_of_t(p, freedom) / point - 1.0).abs() < 0.01, "{p} {freedom}");
        }
    }
}
