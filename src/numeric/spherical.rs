//! Spherical Bessel functions of low order, of the first kind and modified.
//!
//! They are the moments of oscillations and of decays over an interval: the integral of P_m(s) e^{iqs} over [-1, 1] is
//! 2 i^m j_m(q), that of P_m(s) e^{qs} is 2 i_m(q) (Abramowitz & Stegun 1964, 10.1.14 and 10.2.36). Upward recurrence is
//! stable for arguments above the order; below, Miller's downward recurrence is used (10.5, Example 1). Both are accurate
//! to about 1e-14 of the largest value of the list.

/// From this argument on the recurrence runs upward; above the orders that are served.
const UPWARD: f64 = 10.0;
/// Below this argument two terms of the power series are exact to rounding.
const SERIES: f64 = 1e-3;

/// j_0(x) to j_{N-1}(x) for x >= 0 and N from 1 to 8.
#[must_use]
pub fn spherical_j<const N: usize>(x: f64) -> [f64; N] {
    if x < SERIES {
        return series(x, -1.0);
    }
    let (sine, cosine) = x.sin_cos();
    let first = [sine / x, sine / (x * x) - cosine / x];
    if x >= UPWARD {
        return upward(x, first, -1.0);
    }
    let list = downward::<N>(x, -1.0);
    // j_0 and j_1 have no common zero.
    let index = usize::from(first[0].abs() < first[1].abs());
    let scale = first[index] / list.0[index];
    list.1.map(|value| scale * value)
}

/// e^{-x} i_0(x) to e^{-x} i_{N-1}(x) for x >= 0 and N from 1 to 8.
#[must_use]
pub fn scaled_spherical_i<const N: usize>(x: f64) -> [f64; N] {
    if x < SERIES {
        return series::<N>(x, 1.0).map(|value| value * (-x).exp());
    }
    let double = (-2.0 * x).exp();
    let zeroth = 0.5 * -(-2.0 * x).exp_m1() / x;
    if x >= UPWARD {
        return upward(x, [zeroth, 0.5 * (1.0 + double) / x - zeroth / x], 1.0);
    }
    let list = downward::<N>(x, 1.0);
    let scale = zeroth / list.0[0];
    list.1.map(|value| scale * value)
}

/// x^m / (2m + 1)!! (1 + sign x^2 / (2 (2m + 3))).
fn series<const N: usize>(x: f64, sign: f64) -> [f64; N] {
    let mut power = 1.0;
    std::array::from_fn(|m| {
        let m = m as f64;
        let value = power * (1.0 + sign * x * x / (2.0 * (2.0 * m + 3.0)));
        power *= x / (2.0 * m + 3.0);
        value
    })
}

/// f_{m+1} = (2m + 1)/x f_m - f_{m-1}, with the signs turned for the modified functions.
fn upward<const N: usize>(x: f64, first: [f64; 2], sign: f64) -> [f64; N] {
    let mut list = [0.0; N];
    let (mut before, mut here) = (first[0], first[1]);
    for (m, value) in list.iter_mut().enumerate() {
        *value = before;
        (before, here) = (here, sign * (before - (2.0 * m as f64 + 3.0) / x * here));
    }
    list
}

/// The first two and the first N values, to a common factor.
fn downward<const N: usize>(x: f64, sign: f64) -> ([f64; 2], [f64; N]) {
    let (start, inverse) = (N + 12 + (1.4 * x) as usize, 1.0 / x);
    let (mut list, mut first) = ([0.0; N], [0.0; 2]);
    let (mut above, mut here) = (0.0, 1e-200);
    for m in (0..start).rev() {
        // f_m of f_{m+1} and f_{m+2}.
        (above, here) = (here, (2.0 * m as f64 + 3.0) * inverse * here + sign * above);
        if let Some(value) = list.get_mut(m) {
            *value = here;
        }
        if let Some(value) = first.get_mut(m) {
            *value = here;
        }
    }
    (first, list)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numeric::gauss_legendre;

    fn legendre(m: usize, s: f64) -> f64 {
        let (mut before, mut here) = (1.0, s);
        for k in 1..m {
            let k = k as f64;
            (before, here) = (here, ((2.0 * k + 1.0) * s * here - k * before) / (k + 1.0));
        }
        if m == 0 { 1.0 } else { here }
    }

    /// Both are moments, which a rule of many nodes gives to rounding.
    #[test]
    fn they_are_the_moments_of_oscillations_and_decays() {
        for x in [0.0, 1e-5, 9e-4, 1.1e-3, 0.3, 1.0, 3.15, 4.4934, 9.9, 10.1, 17.0] {
            let (j, i) = (spherical_j::<8>(x), scaled_spherical_i::<8>(x));
            for (m, (j, i)) in j.into_iter().zip(i).enumerate() {
                let over = |f: &dyn Fn(f64) -> f64| -> f64 {
                    gauss_legendre(48).on(-1.0, 1.0).map(|(s, w)| w * legendre(m, s) * f(s)).sum()
                };
                // i^m is real for even orders: the even or the odd part of the oscillation.
                let wave = if m.is_multiple_of(2) { over(&|s| (x * s).cos()) } else { over(&|s| (x * s).sin()) };
                let sign = if (m / 2).is_multiple_of(2) { 1.0 } else { -1.0 };
                assert!((2.0 * sign * j - wave).abs() < 2e-14, "j_{m}({x}): {j} {wave}");
                let decay = over(&|s| (x * (s - 1.0)).exp());
                assert!((2.0 * i - decay).abs() < 2e-14, "i_{m}({x}): {i} {decay}");
            }
        }
    }

    #[test]
    fn large_arguments_keep_the_leading_terms() {
        let x = 1e5;
        assert!((scaled_spherical_i::<4>(x)[3] * 2.0 * x - 1.0).abs() < 1e-4);
        assert!((spherical_j::<4>(x)[2] + x.sin() / x).abs() < 1e-9);
    }
}
