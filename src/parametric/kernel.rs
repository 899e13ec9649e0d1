//! Waterline kernels on the unit square: the hyperbolic-cosine curve J and its companion S with zero shoulder curvature.
//!
//! With the entire functions c_n(w) = sum_k w^k / (2k + n)! (so that c_0(a^2) = cosh a, c_1(a^2) = sinh a / a; for w <
//! 0 the cosine and the sine), every formula holds for the shape number mu = a^2 of either sign:
//!
//! * J_mu(t) = 1 - t^2 c_2(mu t^2) / c_2(mu) = 1 - (cosh(a t) - 1) / (cosh a - 1),  mu > -pi^2
//! * S_mu(t) = 1 - t^3 c_3(mu t^2) / c_3(mu) = 1 - (sinh(a t) - a t) / (sinh a - a),  mu > -4 pi^2
//!
//! t = 0 is the shoulder (value 1, slope 0), t = 1 the end (value 0). J with m = a / pi is the curve of the UCL design
//! building block generator (Calleya, Pawling & Greig 2015); S has the same range of fullness and joins a parallel body
//! with continuous curvature. Both increase with mu at every t; J is concave for mu >= -pi^2/4, S for mu >= -pi^2,
//! otherwise they have one inflection each.
//!
//! Accuracy: values and moments to 2e-14 for mu up to 4900 (tested against published values and quadrature).

use std::sync::OnceLock;

/// Which kernel.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kernel {
    /// Hyperbolic cosine; finite curvature at the shoulder.
    J,
    /// Hyperbolic sine minus its argument; no curvature at the shoulder.
    S,
}

impl Kernel {
    /// n of the function c_n that the kernel is made of: f = 1 - t^n c_n(mu t^2) / c_n(mu), fullness 1 - c_(n+1) / c_n.
    fn order(self) -> usize {
        match self {
            Self::J => 2,
            Self::S => 3,
        }
    }
}

/// Lowest fullness of either kernel: zero slope at the end.
pub(super) const LOWEST_FULLNESS: f64 = 0.5;
/// Highest fullness that is tabulated.
pub(super) const HIGHEST_FULLNESS: f64 = 0.98;

/// c_0 to c_5 at `w`.
fn entire(w: f64) -> [f64; 6] {
    let mut c = [0.0; 6];
    if w.abs() < 3.0 {
        // Series for c_4 and c_5; the others follow by c_n = 1/n! + w c_(n+2), which loses nothing here.
        for (n, value) in [(4usize, 24.0_f64), (5, 120.0)] {
            let mut term = 1.0 / value;
            let mut sum = term;
            let mut k = n as f64;
            while term.abs() > 1e-19 * sum.abs() {
                term *= w / ((k + 1.0) * (k + 2.0));
                k += 2.0;
                sum += term;
            }
            c[n] = sum;
        }
        c[3] = 1.0 / 6.0 + w * c[5];
        c[2] = 0.5 + w * c[4];
        c[1] = 1.0 + w * c[3];
        c[0] = 1.0 + w * c[2];
    } else {
        let a = w.abs().sqrt();
        (c[0], c[1]) = if w > 0.0 { (a.cosh(), a.sinh() / a) } else { (a.cos(), a.sin() / a) };
        c[2] = (c[0] - 1.0) / w;
        c[3] = (c[1] - 1.0) / w;
        c[4] = (c[2] - 0.5) / w;
        c[5] = (c[3] - 1.0 / 6.0) / w;
    }
    c
}

/// A kernel at one shape number.
#[derive(Debug, Clone, Copy)]
pub(super) struct Shape {
    kernel: Kernel,
    mu: f64,
    /// c_2(mu) or c_3(mu).
    scale: f64,
}

impl Shape {
    /// The kernel at shape number `mu`.
    pub(super) fn new(kernel: Kernel, mu: f64) -> Self {
        Self { kernel, mu, scale: entire(mu)[kernel.order()] }
    }

    /// The kernel whose integral over [0, 1] is `fullness`, clamped to the tabulated range.
    pub(super) fn of_fullness(kernel: Kernel, fullness: f64) -> Self {
        Self::new(kernel, shape_number(kernel, fullness))
    }

    /// f(t); t may exceed 1 (the curve continued).
    pub(super) fn value(&self, t: f64) -> f64 {
        let c = entire(self.mu * t * t);
        match self.kernel {
            Kernel::J => 1.0 - t * t * c[2] / self.scale,
            Kernel::S => 1.0 - t * t * t * c[3] / self.scale,
        }
    }

    /// -f'(t).
    pub(super) fn fall(&self, t: f64) -> f64 {
        let c = entire(self.mu * t * t);
        match self.kernel {
            Kernel::J => t * c[1] / self.scale,
            Kernel::S => t * t * c[2] / self.scale,
        }
    }

    /// -f''(0): the curvature at the shoulder.
    pub(super) fn shoulder_curvature(&self) -> f64 {
        match self.kernel {
            Kernel::J => 1.0 / self.scale,
            Kernel::S => 0.0,
        }
    }

    /// (int_0^t f, int_0^t s f(s) ds).
    pub(super) fn moments(&self, t: f64) -> (f64, f64) {
        let c = entire(self.mu * t * t);
        let t2 = t * t;
        match self.kernel {
            Kernel::J => (t - t * t2 * c[3] / self.scale, 0.5 * t2 - t2 * t2 * (c[3] - c[4]) / self.scale),
            Kernel::S => (t - t2 * t2 * c[4] / self.scale, 0.5 * t2 - t * t2 * t2 * (c[4] - c[5]) / self.scale),
        }
    }

    /// Fullness: int_0^1 f.
    pub(super) fn fullness(&self) -> f64 {
        self.moments(1.0).0
    }

    /// Whether the curve is concave all over, so that the waterline has no inflection.
    #[cfg(test)]
    pub(super) fn concave(&self) -> bool {
        let pi2 = std::f64::consts::PI.powi(2);
        self.mu >= if self.kernel == Kernel::J { -0.25 * pi2 } else { -pi2 }
    }
}

const TABLE: usize = 1024;

/// The shape number mu of a kernel of given fullness; fullness is clamped to [LOWEST_FULLNESS, HIGHEST_FULLNESS]. The
/// estimate from a table is polished by Newton's method; the fullness of the result is right to 1e-14.
fn shape_number(kernel: Kernel, fullness: f64) -> f64 {
    static J: OnceLock<Vec<f64>> = OnceLock::new();
    static S: OnceLock<Vec<f64>> = OnceLock::new();
    let cell = if kernel == Kernel::J { &J } else { &S };
    let table = cell.get_or_init(|| {
        (0..=TABLE)
            .map(|k| bisect(kernel, LOWEST_FULLNESS + (HIGHEST_FULLNESS - LOWEST_FULLNESS) * k as f64 / TABLE as f64))
            .collect()
    });
    let fullness = fullness.clamp(LOWEST_FULLNESS, HIGHEST_FULLNESS);
    let place = (fullness - LOWEST_FULLNESS) / (HIGHEST_FULLNESS - LOWEST_FULLNESS) * TABLE as f64;
    let index = (place as usize).min(TABLE - 1);
    let (low, high) = (table[index], table[index + 1]);
    let mut mu = low + (high - low) * (place - index as f64);
    for _ in 0..4 {
        let c = entire(mu);
        let error = 1.0 - c[kernel.order() + 1] / c[kernel.order()] - fullness;
        let next = (mu - error / fullness_slope(kernel, mu, &c)).clamp(low, high);
        if (next - mu).abs() <= 1e-15 * mu.abs() {
            break;
        }
        mu = next;
    }
    mu
}

/// d(fullness)/d(mu), from d c_n / d w = (c_(n-1) - n c_n) / (2 w) or its series near 0.
/// `c` is [`entire`] at mu.
fn fullness_slope(kernel: Kernel, mu: f64, c: &[f64; 6]) -> f64 {
    let slope = |n: usize| {
        if mu.abs() > 0.5 {
            (c[n - 1] - n as f64 * c[n]) / (2.0 * mu)
        } else {
            // sum_k k w^(k-1) / (2k + n)!
            let mut factorial: f64 = (1..=n).map(|k| k as f64).product();
            let (mut sum, mut power) = (0.0, 1.0);
            for k in 1..12 {
                let m = (2 * k + n) as f64;
                factorial *= m * (m - 1.0);
                sum += k as f64 * power / factorial;
                power *= mu;
            }
            sum
        }
    };
    // phi = 1 - c_(n+1) / c_n with n = 2 (J) or 3 (S).
    let n = kernel.order();
    -(slope(n + 1) * c[n] - c[n + 1] * slope(n)) / (c[n] * c[n])
}

fn bisect(kernel: Kernel, fullness: f64) -> f64 {
    let pi2 = std::f64::consts::PI.powi(2);
    let (mut low, mut high) = (if kernel == Kernel::J { -pi2 } else { -4.0 * pi2 }, 2.0);
    while Shape::new(kernel, high).fullness() < fullness {
        high *= 2.0;
    }
    for _ in 0..200 {
        let mid = 0.5 * (low + high);
        if Shape::new(kernel, mid).fullness() < fullness {
            low = mid;
        } else {
            high = mid;
        }
        if high - low <= 1e-15 * mid.abs() {
            break;
        }
    }
    0.5 * (low + high)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numeric::gauss_legendre;

    const PI2: f64 = std::f64::consts::PI * std::f64::consts::PI;

    /// mu, phi, psi, end slope, shoulder curvature.
    const J_VALUES: [[f64; 5]; 8] = [
        [-PI2, 0.5, 0.148678816357662, 0.0, 4.934802200545],
        [-8.0, 0.543355012658566, 0.174586153235777, 0.446538350504, 4.099698249235],
        [-PI2 / 4.0, std::f64::consts::FRAC_2_PI, 0.231335037798230, std::f64::consts::FRAC_PI_2, 2.467401100272],
        [0.0, 2.0 / 3.0, 0.25, 2.0, 2.0],
        [1.0, 0.677393774676932, 0.256720180469140, 2.163953413739, 1.841347188416],
        [0.64 * PI2, 0.723794038177841, 0.286196962492356, 2.956325903038, 1.211658014137],
        [25.0, 0.810945883797862, 0.344116210917670, 5.067836549063, 0.341483644010],
        [400.0, 0.950000003916192, 0.452500001855038, 20.000000082446, 0.000001648923],
    ];
    const S_VALUES: [[f64; 4]; 5] = [
        [-4.0 * PI2, 0.5, 0.141336370756082, 0.0],
        [-25.0, 0.604503710994738, 0.204349981046633, 0.601063028761],
        [-PI2, 0.702642367284676, 0.267987850309005, 2.0],
        [0.0, 0.75, 0.3, 3.0],
        [25.0, 0.824545861332413, 0.352504030810741, 5.289490755815],
    ];

    #[test]
    fn published_moments() {
        for [mu, phi, psi, slope, kappa] in J_VALUES {
            let shape = Shape::new(Kernel::J, mu);
            let (area, moment) = shape.moments(1.0);
            assert!((area - phi).abs() < 1e-14, "{mu}: {area}");
            assert!((moment - psi).abs() < 1e-14, "{mu}: {moment}");
            assert!((shape.fall(1.0) - slope).abs() < 1e-11, "{mu}");
            assert!((shape.shoulder_curvature() - kappa).abs() < 1e-11, "{mu}");
        }
        for [mu, phi, psi, slope] in S_VALUES {
            let shape = Shape::new(Kernel::S, mu);
            let (area, moment) = shape.moments(1.0);
            assert!((area - phi).abs() < 1e-14, "{mu}: {area}");
            assert!((moment - psi).abs() < 1e-14, "{mu}: {moment}");
            assert!((shape.fall(1.0) - slope).abs() < 1e-11, "{mu}");
        }
    }

    #[test]
    fn partial_moments_against_quadrature() {
        for kernel in [Kernel::J, Kernel::S] {
            for mu in [-9.0, -3.001, -2.999, -0.3, 0.0, 1e-9, 0.7, 2.999, 3.001, 40.0, 900.0] {
                let shape = Shape::new(kernel, mu);
                for end in [0.3, 0.8, 1.0] {
                    let (area, moment) = shape.moments(end);
                    let rule = gauss_legendre(48);
                    let quad: f64 = rule.on(0.0, end).map(|(t, w)| w * shape.value(t)).sum();
                    let quad_moment: f64 = rule.on(0.0, end).map(|(t, w)| w * t * shape.value(t)).sum();
                    assert!((area - quad).abs() < 2e-14, "{kernel:?} {mu} {end}: {area} {quad}");
                    assert!((moment - quad_moment).abs() < 2e-14, "{kernel:?} {mu} {end}");
                }
            }
        }
    }

    #[test]
    fn fullness_is_inverted() {
        for kernel in [Kernel::J, Kernel::S] {
            for k in 0..=960 {
                let fullness = 0.5 + 0.48 * f64::from(k) / 960.0;
                let shape = Shape::of_fullness(kernel, fullness);
                assert!((shape.fullness() - fullness).abs() < 1e-14, "{kernel:?} {fullness}: {}", shape.fullness());
            }
        }
    }

    #[test]
    fn curves_are_nested_and_concave_when_they_say_so() {
        for kernel in [Kernel::J, Kernel::S] {
            for k in 0..48 {
                let (lean, full) = (0.5 + 0.01 * f64::from(k), 0.51 + 0.01 * f64::from(k));
                let (lean, full) =
                    (Shape::of_fullness(kernel, lean), Shape::of_fullness(kernel, full.min(HIGHEST_FULLNESS)));
                let mut turned = false;
                for i in 1..100 {
                    let t = f64::from(i) / 100.0;
                    assert!(full.value(t) >= lean.value(t) - 1e-15);
                    let second = lean.fall(t + 1e-4) - lean.fall(t - 1e-4);
                    turned |= second < -1e-9;
                }
                assert_eq!(turned, !lean.concave(), "{kernel:?} {k}");
            }
        }
    }
}
