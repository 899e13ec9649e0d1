//! Slopes of piecewise cubics through data, and the limits within which they make no waves.
//!
//! A cubic with values a, b and slopes s, t over a gap h has the Bezier values a, a + s h/3, b - t h/3, b. It stays
//! between a and b if these rise (or fall), s + t <= 3 (b - a)/h with neither against the direction of the gap (Fritsch
//! & Carlson 1980: sufficient).

/// Where neighbouring gaps turn, a slope up to this part of the smaller of theirs is left: samples of a parabola in a gap
/// ratio of three need one.
const TURN: f64 = 1.0;

/// Slopes at `sites` of the parabolas through three successive values (Bessel's; de Boor 2001, IV); second order.
pub(super) fn parabolic(sites: &[f64], values: &[f64]) -> Vec<f64> {
    let count = sites.len();
    if count < 2 {
        return vec![0.0; count];
    }
    let gap = |k: usize| sites[k + 1] - sites[k];
    let rate = |k: usize| (values[k + 1] - values[k]) / gap(k);
    (0..count)
        .map(|k| {
            if count == 2 {
                return rate(0);
            }
            let m = k.clamp(1, count - 2);
            let (h, g) = (gap(m - 1), gap(m));
            let (d, e) = (rate(m - 1), rate(m));
            let bend = (e - d) / (h + g);
            d + bend * (2.0 * sites[k] - sites[m - 1] - sites[m])
        })
        .collect()
}

/// Takes slopes back to where no cubic leaves the range of its gap by more than a turn needs, and none falls below
/// `floor`.
pub(super) fn limit(sites: &[f64], values: &[f64], floor: f64, slopes: &mut [f64]) {
    let gaps = sites.len().saturating_sub(1);
    let rate = |k: usize| (values[k + 1] - values[k]) / (sites[k + 1] - sites[k]);
    for (k, slope) in slopes.iter_mut().enumerate() {
        let (before, after) = (k.checked_sub(1).map(rate), (k < gaps).then(|| rate(k)));
        *slope = match (before, after) {
            (Some(a), Some(b)) if a * b < 0.0 => {
                let most = TURN * a.abs().min(b.abs());
                slope.clamp(-most, most)
            }
            (Some(a), Some(b)) => within(within(*slope, a), b),
            (Some(a), None) | (None, Some(a)) => within(*slope, a),
            (None, None) => 0.0,
        };
        let room = 3.0 * (values[k] - floor).max(0.0);
        if let Some(h) = k.checked_sub(1).map(|j| sites[k] - sites[j]) {
            *slope = slope.min(room / h);
        }
        if k < gaps {
            *slope = slope.max(-room / (sites[k + 1] - sites[k]));
        }
    }
}

/// The part of a slope that goes with a gap of the given rate, up to three times that.
fn within(slope: f64, rate: f64) -> f64 {
    let most = 3.0 * rate;
    slope.clamp(most.min(0.0), most.max(0.0))
}

/// Shrinks slopes of rising values so that the Bezier values rise as well.
pub(super) fn rise(sites: &[f64], values: &[f64], slopes: &mut [f64]) {
    let mut shares = vec![1.0f64; slopes.len()];
    slopes.iter_mut().for_each(|s| *s = s.max(0.0));
    for k in 0..sites.len().saturating_sub(1) {
        let (sum, most) = (slopes[k] + slopes[k + 1], 3.0 * (values[k + 1] - values[k]) / (sites[k + 1] - sites[k]));
        if sum > most {
            let share = most.max(0.0) / sum;
            shares[k] = shares[k].min(share);
            shares[k + 1] = shares[k + 1].min(share);
        }
    }
    slopes.iter_mut().zip(shares).for_each(|(slope, share)| *slope *= share);
}

/// The cubic of a gap of width `h` at the share `t` of it: value, and slope over the width.
pub(super) fn cubic(h: f64, [a, b]: [f64; 2], [s, e]: [f64; 2], t: f64) -> [f64; 2] {
    let r = 1.0 - t;
    let value = a * r * r * (1.0 + 2.0 * t) + b * t * t * (1.0 + 2.0 * r) + h * t * r * (s * r - e * t);
    let slope = 6.0 * t * r * (b - a) / h + s * r * (r - 2.0 * t) + e * t * (t - 2.0 * r);
    [value, slope]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parabolas_are_kept() {
        let sites = [0.0, 0.4, 1.5, 2.0, 3.7];
        let values = sites.map(|t: f64| 2.0 + t - 0.3 * t * t);
        for (slope, t) in parabolic(&sites, &values).iter().zip(sites) {
            assert!((slope - (1.0 - 0.6 * t)).abs() < 1e-13);
        }
        for t in [0.1, 0.5, 0.9] {
            let [value, slope] = cubic(2.0, [2.0, 2.8], [1.0, -0.2], t);
            let x = 2.0 * t;
            assert!((value - (2.0 + x - 0.3 * x * x)).abs() < 1e-14 && (slope - (1.0 - 0.6 * x)).abs() < 1e-14);
        }
    }

    #[test]
    fn steps_do_not_swing_and_corners_stay_sharp() {
        let sites: Vec<f64> = (0..7).map(f64::from).collect();
        let values = [0.0, 0.0, 0.0, 5.0, 5.1, 5.1, 0.2];
        let mut slopes = parabolic(&sites, &values);
        limit(&sites, &values, 0.0, &mut slopes);
        for k in 0..6 {
            for n in 0..=20 {
                let ends = [values[k], values[k + 1]];
                let value = cubic(1.0, ends, [slopes[k], slopes[k + 1]], f64::from(n) / 20.0)[0];
                assert!((-1e-12..=5.1 + 1e-12).contains(&value), "{k} {value}");
            }
        }
        // A corner between two level pieces and a rise leaves no slope.
        assert!(slopes[1].abs() < 1e-15 && slopes[2].abs() < 1e-15);
        let mut rising = vec![9.0; 4];
        rise(&sites[..4], &[0.0, 1.0, 1.0, 4.0], &mut rising);
        assert!(rising[1].abs() < 1e-15);
        assert!(rising[0] <= 3.0 && rising[3] <= 9.0);
    }
}
