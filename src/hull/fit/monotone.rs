//! Monotone piecewise cubics through points, for profiles (Fritsch & Butland 1984).

/// The slope at point `i` of the monotone piecewise cubic through `points` (t rising): the weighted harmonic mean of
/// the slopes of the neighbouring chords, 0 where these change sign; one-sided at the ends, limited to three times the
/// chord; 0 for a single point.
pub(super) fn monotone_slope(points: &[(f64, f64)], i: usize) -> f64 {
    let Some(last) = points.len().checked_sub(1).filter(|&last| last > 0) else { return 0.0 };
    let chord = |i: usize| (points[i + 1].1 - points[i].1) / (points[i + 1].0 - points[i].0);
    if i == 0 || i == last {
        let (near, inner) = if i == 0 { (chord(0), 1) } else { (chord(last - 1), last - 1) };
        if last < 2 {
            return near;
        }
        let far = if i == 0 { chord(inner) } else { chord(inner - 1) };
        let guess = 1.5 * near - 0.5 * far;
        return if guess * near <= 0.0 { 0.0 } else { guess.abs().min(3.0 * near.abs()) * near.signum() };
    }
    let (before, after) = (chord(i - 1), chord(i));
    if before * after <= 0.0 {
        return 0.0;
    }
    let (h, g) = (points[i].0 - points[i - 1].0, points[i + 1].0 - points[i].0);
    let (w, v) = (2.0 * g + h, g + 2.0 * h);
    (w + v) / (w / before + v / after)
}

/// The value at `t` of the monotone piecewise cubic through `points` (t rising, at least one); its end values beyond
/// them.
///
/// Slopes are those of [`monotone_slope`]. Accuracy: second order, no overshoot.
pub(super) fn monotone_cubic(points: &[(f64, f64)], t: f64) -> f64 {
    let last = points.len() - 1;
    if points.len() < 2 || t <= points[0].0 {
        return points[0].1;
    }
    if t >= points[last].0 {
        return points[last].1;
    }
    let k = points.partition_point(|p| p.0 <= t).clamp(1, last);
    let (a, b) = (points[k - 1], points[k]);
    let width = b.0 - a.0;
    let s = (t - a.0) / width;
    let (da, db) = (monotone_slope(points, k - 1) * width, monotone_slope(points, k) * width);
    let r = 1.0 - s;
    a.1 * r * r * (1.0 + 2.0 * s) + b.1 * s * s * (1.0 + 2.0 * r) + da * s * r * r - db * s * s * r
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_meets_its_points_and_does_not_overshoot() {
        let points = [(0.0, 0.0), (1.0, 0.1), (1.5, 3.0), (4.0, 3.0), (5.0, 10.0)];
        for p in points {
            assert!((monotone_cubic(&points, p.0) - p.1).abs() < 1e-14);
        }
        let values: Vec<f64> = (0..=500).map(|k| monotone_cubic(&points, 0.01 * f64::from(k))).collect();
        assert!(values.windows(2).all(|w| w[1] >= w[0] - 1e-14));
        // A line stays a line.
        let line = [(0.0, 1.0), (2.0, 5.0), (3.0, 7.0)];
        assert!((monotone_cubic(&line, 0.7) - 2.4).abs() < 1e-14);
    }
}
