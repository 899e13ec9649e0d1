//! The integral over the directions of the waves, I = int_1^inf |F|^2 l^2 / sqrt(l^2 - 1) dl.
//!
//! With l = 1 + w^2 the integrand is smooth. Gauss rules of 16 nodes take three waves of the interference of bow and
//! stern each (relative error 1e-12). Octaves of l are added until what is left settles: |F|^2 falls like a power of l,
//! so that the octaves are a geometric series in the end, and its sum is that of the rest.

use std::f64::consts::TAU;

use crate::numeric::gauss_legendre;

/// Nodes of a rule.
const NODES: usize = 16;
/// Waves of e^{i nu L l} that a rule takes.
const WAVES: f64 = 3.0;
/// Octaves at least and at most.
const OCTAVES: [usize; 2] = [3, 10];
/// The ratio of octaves at most: slower series are not summed.
const SLOWEST: f64 = 0.5;

/// The value of the integral, the factor of the last octave that stands for the rest, and what the rest may be wrong by.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct DirectionIntegral {
    /// I.
    pub(super) value: f64,
    /// Estimate of its error.
    pub(super) error: f64,
}

/// Evaluations of one octave: `square` gets l and the weight, and returns |F|^2.
fn octave(phase: f64, index: usize, square: &mut impl FnMut(f64, f64) -> f64) -> f64 {
    let low = 2f64.powi(index as i32);
    let count = (phase * low / (TAU * WAVES)).ceil().max(2.0) as usize;
    let root = |part: f64| (low * (1.0 + part) - 1.0).max(0.0).sqrt();
    let mut sum = 0.0;
    for n in 0..count {
        let [from, to] = [n, n + 1].map(|n| root(n as f64 / count as f64));
        for (w, weight) in gauss_legendre(NODES).on(from, to) {
            let l = 1.0 + w * w;
            let weight = weight * 2.0 * l * l / (w * w + 2.0).sqrt();
            sum += weight * square(l, weight);
        }
    }
    sum
}

/// Sums octaves until what is left is known to `tolerance`; `phase` is nu L. After each octave `ended` gets the factor by
/// which that octave counts if it is the last.
pub(super) fn integral(
    phase: f64,
    tolerance: f64,
    mut square: impl FnMut(f64, f64) -> f64,
    mut ended: impl FnMut(bool, f64),
) -> DirectionIntegral {
    let (mut sum, mut before, mut estimate) = (0.0, 0.0, f64::INFINITY);
    let mut error = f64::INFINITY;
    for index in 0..OCTAVES[1] {
        let part = octave(phase, index, &mut square);
        let ratio: f64 = if before > 0.0 { part / before } else { 0.0 };
        let factor = 1.0 / (1.0 - ratio.min(SLOWEST));
        let value = sum + factor * part;
        error = (value - estimate).abs();
        let last = index + 1 >= OCTAVES[0] && error <= tolerance * value || index + 1 == OCTAVES[1];
        ended(last, factor);
        (sum, before, estimate) = (sum + part, part, value);
        if last {
            break;
        }
    }
    DirectionIntegral { value: estimate, error }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::FRAC_PI_4;

    /// int l^-4 / sqrt(l^2 - 1) dl over l^2 |F|^2 = l^-2 is int cos^2: pi/4; with l^-6 it is 5 pi/32... of cos^n.
    #[test]
    fn powers_are_exact() {
        let found = integral(5.0, 1e-10, |l, _| l.powi(-4), |_, _| {});
        assert!((found.value - FRAC_PI_4).abs() < 1e-9, "{found:?}");
        let found = integral(200.0, 1e-10, |l, _| l.powi(-6), |_, _| {});
        assert!((found.value - 0.75 * FRAC_PI_4).abs() < 1e-10, "{found:?}");
    }
}
