//! The integral over the directions of the waves, I = int_1^inf |F|^2 l^2 / sqrt(l^2 - 1) dl.
//!
//! With l = 1 + w^2 the integrand is smooth. Gauss rules of 16 nodes take three waves of the interference of bow and
//! stern each (relative error 1e-12). Octaves of l are added, the last one under a smooth window, so that no wave ends at
//! its edge. |F|^2 falls like a power of l, so that the sums are a geometric series in the end: its limit is taken, and the
//! limits of successive octaves are extrapolated once more (Aitken 1926).

use std::f64::consts::TAU;

use crate::numeric::gauss_legendre;

/// Nodes of a rule.
const NODES: usize = 16;
/// Waves of e^{i nu L l} that a rule takes.
const WAVES: f64 = 3.0;
/// Octaves at most.
const OCTAVES: usize = 10;
/// The ratio of successive differences at most: slower series are not summed.
const SLOWEST: f64 = 0.7;
/// The ratio of differences of limits up to which they are extrapolated.
const SETTLING: f64 = 0.3;

/// What one octave adds: in full, and under the window that ends the integral.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct OctaveWeights {
    /// Weight of the rule.
    pub(super) full: f64,
    /// The same under the window.
    pub(super) windowed: f64,
}

/// What follows an octave: it is the last, and the factor of the last difference of windowed sums that stands for the
/// rest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct OctaveEnd {
    /// Whether the integral ends here.
    pub(super) last: bool,
    /// r / (1 - r) of the ratio r of successive differences.
    pub(super) rest: f64,
}

/// 1 at the lower end of an octave, 0 at the upper, with all derivatives 0 to the fifth at both; `part` from 0 to 1 along
/// log2 l.
fn window(part: f64) -> f64 {
    let x = 1.0 - part;
    x.powi(6) * (462.0 + x * (-1980.0 + x * (3465.0 + x * (-3080.0 + x * (1386.0 - 252.0 * x)))))
}

/// Full and windowed integral over one octave; `square` gets l and the weights, and returns |F|^2.
fn octave(phase: f64, index: usize, square: &mut impl FnMut(f64, OctaveWeights) -> f64) -> OctaveWeights {
    let low = 2f64.powi(index as i32);
    let count = (phase * low / (TAU * WAVES)).ceil().max(2.0) as usize;
    let root = |part: f64| (low * (1.0 + part) - 1.0).max(0.0).sqrt();
    let mut sums = OctaveWeights::default();
    for n in 0..count {
        let [from, to] = [n, n + 1].map(|n| root(n as f64 / count as f64));
        // From l = 1 on the waves become shorter along w: the first panel is two.
        let middle = if index + n == 0 { 0.5 * to } else { to };
        let [first, second] = [(from, middle), (middle, to)].map(|(a, b)| gauss_legendre(NODES).on(a, b));
        for (w, weight) in first.chain(second.filter(|_| middle < to)) {
            let l = 1.0 + w * w;
            let full = weight * 2.0 * l * l / (w * w + 2.0).sqrt();
            let weights = OctaveWeights { full, windowed: full * window((l / low).log2()) };
            let value = square(l, weights);
            sums.full += weights.full * value;
            sums.windowed += weights.windowed * value;
        }
    }
    sums
}

/// The integral, until the limits of two octaves agree to `tolerance`; `phase` is nu L. The result differs from the last
/// limit by less than they do. `ended` is called after each octave.
pub(super) fn integral(
    phase: f64,
    tolerance: f64,
    mut square: impl FnMut(f64, OctaveWeights) -> f64,
    mut ended: impl FnMut(OctaveEnd),
) -> f64 {
    let (mut full, mut sum, mut difference) = (0.0, 0.0, 0.0);
    let mut limits = [0.0; 3];
    for index in 0..OCTAVES {
        let part = octave(phase, index, &mut square);
        let next = full + part.windowed;
        let step: f64 = next - sum;
        let ratio = if index > 1 && difference > 0.0 { (step / difference).clamp(0.0, SLOWEST) } else { 0.0 };
        let rest = ratio / (1.0 - ratio);
        (full, sum, difference) = (full + part.full, next, step);
        limits = [limits[1], limits[2], sum + rest * step];
        let settled = index > 2 && (limits[2] - limits[1]).abs() <= tolerance * limits[2];
        let last = settled || index + 1 == OCTAVES;
        ended(OctaveEnd { last, rest });
        if last {
            break;
        }
    }
    let [before, between] = [limits[1] - limits[0], limits[2] - limits[1]];
    let ratio = between / before;
    if ratio.abs() < SETTLING { limits[2] + between * ratio / (1.0 - ratio) } else { limits[2] }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::FRAC_PI_4;

    /// int l^-2 / sqrt(l^2 - 1) dl is 1, of l^-3 pi/4, of l^-5 3 pi/16.
    #[test]
    fn powers_are_exact() {
        for (phase, power, exact) in [(5.0, -4, 1.0), (0.5, -5, FRAC_PI_4), (300.0, -7, 0.75 * FRAC_PI_4)] {
            let found = integral(phase, 1e-8, |l, _| l.powi(power), |_| {});
            assert!((found - exact).abs() < 3e-9, "{power}: {found} {exact}");
        }
    }

    #[test]
    fn the_window_falls_from_1_to_0() {
        assert!((window(0.0) - 1.0).abs() < 1e-13 && window(1.0) == 0.0 && (window(0.5) - 0.5).abs() < 1e-13);
    }
}
