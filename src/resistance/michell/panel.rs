//! Functions along one axis as Legendre series over panels, and their oscillating and decaying moments.

use crate::numeric::{gauss_legendre, scaled_spherical_i, spherical_j};

/// Terms of a series.
pub(super) const TERMS: usize = 8;
/// Nodes of the rule that finds them: exact for what has twice as many terms.
const NODES: usize = 10;
/// Most halvings of a span.
const HALVINGS: u32 = 16;
/// Terms below this part of the largest are rounding.
const ROUNDING: f64 = 1e-13;
/// Halves of panels that differ by less than this part are one.
const SAME: f64 = 1e-12;

/// A Legendre series sum of c_m P_m(s), s from -1 to 1.
pub(super) type LegendreTerms = [f64; TERMS];

/// `K` functions over an interval of x or z.
#[derive(Debug, Clone)]
pub(super) struct Panel<const K: usize> {
    /// Middle of the interval \[m\].
    pub(super) middle: f64,
    /// Half of its length \[m\].
    pub(super) half: f64,
    /// The series of each function.
    pub(super) series: [LegendreTerms; K],
    /// Terms that are not zero.
    pub(super) count: usize,
}

/// `K` functions f(t) with the coordinate x(t) that rises with t: values x, dx/dt, f.
pub(super) type Sample<const K: usize> = (f64, f64, [f64; K]);

/// Panels from `from` to `to` in the parameter. The functions are taken per dx where `density` holds (as df/dt they
/// become df/ds), else as values. A panel is halved until the last two terms are below `tolerance`.
pub(super) fn panels<const K: usize>(
    sample: &impl Fn(f64) -> Sample<K>,
    [from, to]: [f64; 2],
    density: bool,
    tolerance: f64,
) -> Vec<Panel<K>> {
    let mut list = Vec::new();
    halve(&Halving { sample, density, tolerance }, [from, to], HALVINGS, &mut list);
    list
}

struct Halving<'a, F> {
    sample: &'a F,
    density: bool,
    tolerance: f64,
}

fn halve<const K: usize, F: Fn(f64) -> Sample<K>>(
    way: &Halving<'_, F>,
    [from, to]: [f64; 2],
    left: u32,
    list: &mut Vec<Panel<K>>,
) {
    let [start, end] = [from, to].map(|t| (way.sample)(t).0);
    let (middle, half) = (0.5 * (start + end), 0.5 * (end - start));
    let panel = project(way, [from, to], middle, half);
    let settled = panel.series.iter().all(|s| s[TERMS - 2].abs() + s[TERMS - 1].abs() <= way.tolerance);
    if settled {
        list.push(panel);
    } else if left == 0 {
        list.push(Panel { count: 1, ..panel });
    } else {
        let between = 0.5 * (from + to);
        halve(way, [from, between], left - 1, list);
        halve(way, [between, to], left - 1, list);
    }
}

/// The series of the functions over one panel.
fn project<const K: usize, F: Fn(f64) -> Sample<K>>(
    way: &Halving<'_, F>,
    ends: [f64; 2],
    middle: f64,
    half: f64,
) -> Panel<K> {
    let mut series = [[0.0; TERMS]; K];
    for (s, weight) in gauss_legendre(NODES).on(-1.0, 1.0) {
        let t = parameter(way.sample, ends, middle + half * s, s);
        let (_, slope, values) = (way.sample)(t);
        let factor = if way.density { half / slope } else { 1.0 };
        let legendre = legendre_values(s);
        for (series, value) in series.iter_mut().zip(values) {
            for (m, (term, p)) in series.iter_mut().zip(legendre).enumerate() {
                *term += (m as f64 + 0.5) * weight * p * factor * value;
            }
        }
    }
    let largest = series.iter().flatten().fold(0.0f64, |most, term| most.max(term.abs()));
    let counts = |m: usize| series.iter().any(|s| s[m].abs() > ROUNDING * largest);
    let count = (1..TERMS).rev().find(|&m| counts(m)).map_or(1, |m| m + 1);
    Panel { middle, half, series, count }
}

/// The parameter at which x(t) is `x`: Newton's method, kept between the ends by bisection.
fn parameter<const K: usize>(sample: &impl Fn(f64) -> Sample<K>, ends: [f64; 2], x: f64, s: f64) -> f64 {
    let [mut low, mut high] = ends;
    let mut t = 0.5 * (low + high) + 0.5 * s * (high - low);
    for _ in 0..40 {
        let (value, slope, _) = sample(t);
        let miss = value - x;
        if (miss / slope).abs() <= 1e-15 * (ends[1] - ends[0]).abs().max(t.abs()) {
            break;
        }
        if miss > 0.0 {
            high = t;
        } else {
            low = t;
        }
        let next = t - miss / slope;
        t = if next > low && next < high { next } else { 0.5 * (low + high) };
    }
    t
}

fn legendre_values(s: f64) -> LegendreTerms {
    let mut values = [1.0; TERMS];
    values[1] = s;
    for m in 2..TERMS {
        let k = m as f64;
        values[m] = ((2.0 * k - 1.0) * s * values[m - 1] - (k - 1.0) * values[m - 2]) / k;
    }
    values
}

/// The integrals of P_m(s) over a panel with a kernel; panels of one length share them.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Moments {
    half: f64,
    values: LegendreTerms,
    known: bool,
}

impl Moments {
    /// i^-m of the integrals of P_m(s) e^{i k h s}: 2 j_m(k h).
    pub(super) fn of_wave(&mut self, wave_number: f64, half: f64) -> &LegendreTerms {
        self.of(half, || spherical_j::<TERMS>(wave_number * half))
    }

    /// The integrals of P_m(s) e^{k h (s - 1)}: 2 e^{-k h} i_m(k h).
    pub(super) fn of_decay(&mut self, decay: f64, half: f64) -> &LegendreTerms {
        self.of(half, || scaled_spherical_i::<TERMS>(decay * half))
    }

    fn of(&mut self, half: f64, values: impl FnOnce() -> LegendreTerms) -> &LegendreTerms {
        if !self.known || (half - self.half).abs() > SAME * half {
            (self.half, self.values, self.known) = (half, values().map(|value| 2.0 * value), true);
        }
        &self.values
    }
}

/// The integral of a series with e^{i k h s}, real and imaginary part: sum of i^m c_m 2 j_m.
pub(super) fn oscillation(series: &LegendreTerms, moments: &LegendreTerms, count: usize) -> [f64; 2] {
    let mut sums = [0.0; 2];
    let pairs = series[..count.next_multiple_of(4).min(TERMS)].chunks_exact(4).zip(moments.chunks_exact(4));
    for (c, j) in pairs {
        sums[0] += c[0] * j[0] - c[2] * j[2];
        sums[1] += c[1] * j[1] - c[3] * j[3];
    }
    sums
}

#[cfg(test)]
mod tests {
    use super::*;

    /// sqrt(x) on a graded parameter: the integral of e^{ikx} d(sqrt x) from 0 to 1 against a rule in the root.
    #[test]
    fn panels_integrate_a_round_end() {
        let sample = |t: f64| (t * t, 2.0 * t, [1.0]);
        let list = panels(&sample, [0.0, 1.0], true, 1e-10);
        for k in [0.5, 20.0, 300.0] {
            let (mut real, mut imaginary) = (0.0, 0.0);
            for panel in &list {
                let mut moments = Moments::default();
                let [a, b] = oscillation(&panel.series[0], moments.of_wave(k, panel.half), panel.count);
                let (sine, cosine) = (k * panel.middle).sin_cos();
                real += cosine * a - sine * b;
                imaginary += cosine * b + sine * a;
            }
            let exact = |f: fn(f64) -> f64| -> f64 {
                (0..64)
                    .map(|n| f64::from(n) / 64.0)
                    .flat_map(|a| gauss_legendre(12).on(a, a + 1.0 / 64.0))
                    .map(|(t, w)| w * f(k * t * t))
                    .sum()
            };
            assert!((real - exact(f64::cos)).abs() < 1e-5, "{k}: {real} {}", exact(f64::cos));
            assert!((imaginary - exact(f64::sin)).abs() < 1e-5, "{k}: {imaginary} {}", exact(f64::sin));
        }
    }

    #[test]
    fn cubics_over_a_linear_coordinate_are_exact() {
        let sample = |t: f64| (2.0 + 3.0 * t, 3.0, [t * t * t - t]);
        let list = panels(&sample, [0.0, 1.0], false, 1e-12);
        assert_eq!((list.len(), list[0].count), (1, 4));
        let mut moments = Moments::default();
        let decay = moments.of_decay(0.7, list[0].half);
        let found: f64 = list[0].series[0].iter().zip(decay).map(|(c, i)| c * i).sum();
        let exact: f64 = gauss_legendre(20)
            .on(-1.0, 1.0)
            .map(|(s, w)| {
                let t = 0.5 * (s + 1.0);
                w * (t * t * t - t) * (1.05 * (s - 1.0)).exp()
            })
            .sum();
        assert!((found - exact).abs() < 1e-14, "{found} {exact}");
    }
}
