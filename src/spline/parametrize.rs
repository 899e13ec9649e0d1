//! Parameters for data points, and knots for parameters (Piegl & Tiller 1997, chapter 9).

use super::knots::{KnotVector, SplineError};

/// How parameters follow from data points; they run from 0 to 1.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Parametrization {
    /// Equal steps.
    Uniform,
    /// Steps in proportion to the chords (Piegl & Tiller 1997, 9.5).
    ChordLength,
    /// Steps in proportion to the square roots of the chords (Lee 1989).
    Centripetal,
}

impl Parametrization {
    /// One parameter a point.
    ///
    /// # Errors
    /// [`SplineError::PointCount`] for fewer than two points, [`SplineError::Site`] when two successive points coincide.
    pub fn parameters<const D: usize>(self, points: &[[f64; D]]) -> Result<Vec<f64>, SplineError> {
        self.averaged_parameters(points, 1)
    }

    /// One parameter for each line of `width` points: the mean of the parameters along the `width` rows of points
    /// (Piegl & Tiller 1997, A9.3). Rows of zero length, as at a pole, are left out.
    ///
    /// # Errors
    /// [`SplineError::PointCount`] for fewer than two lines, [`SplineError::Site`] when a step is zero in every row.
    pub fn averaged_parameters<const D: usize>(
        self,
        points: &[[f64; D]],
        width: usize,
    ) -> Result<Vec<f64>, SplineError> {
        let count = points.len() / width.max(1);
        if count < 2 || width == 0 || !points.len().is_multiple_of(width) {
            return Err(SplineError::PointCount { found: points.len(), expected: 2 * width.max(1) });
        }
        let mut mean = vec![0.0; count];
        let mut used = 0.0;
        for row in 0..width {
            let step = |k: usize| {
                let (a, b) = (&points[(k - 1) * width + row], &points[k * width + row]);
                let chord = a.iter().zip(b).map(|(x, y)| (x - y) * (x - y)).sum::<f64>().sqrt();
                match self {
                    Self::Uniform => 1.0,
                    Self::ChordLength => chord,
                    Self::Centripetal => chord.sqrt(),
                }
            };
            let mut sums = vec![0.0; count];
            for k in 1..count {
                sums[k] = sums[k - 1] + step(k);
            }
            let total = sums[count - 1];
            if total > 0.0 {
                mean.iter_mut().zip(&sums).for_each(|(m, s)| *m += s / total);
                used += 1.0;
            }
        }
        mean.iter_mut().for_each(|m| *m /= used);
        mean[count - 1] = 1.0;
        match mean.windows(2).position(|w| w[0].is_nan() || w[1] <= w[0]) {
            Some(k) => Err(SplineError::Site { index: k + 1, value: mean[k + 1], problem: "points coincide" }),
            None => Ok(mean),
        }
    }
}

/// Errors for sites that are not finite or do not increase.
pub(super) fn check_sites(sites: &[f64]) -> Result<(), SplineError> {
    if let Some(index) = sites.iter().position(|t| !t.is_finite()) {
        return Err(SplineError::Site { index, value: sites[index], problem: "not finite" });
    }
    match sites.windows(2).position(|w| w[1] <= w[0]) {
        Some(k) => Err(SplineError::Site { index: k + 1, value: sites[k + 1], problem: "not above the one before it" }),
        None => Ok(()),
    }
}

impl KnotVector {
    /// Knots for interpolation at `sites`: interior knots are means of `degree` successive sites (de Boor 2001, XIII;
    /// Piegl & Tiller 1997, 9.8), so that the Schoenberg-Whitney condition holds.
    ///
    /// # Errors
    /// [`SplineError::PointCount`] for fewer than `degree + 1` sites, [`SplineError::Site`] when they do not increase,
    /// and as [`KnotVector::new`].
    pub fn averaged(degree: usize, sites: &[f64]) -> Result<Self, SplineError> {
        check_sites(sites)?;
        let interior = |p: usize| -> Vec<f64> {
            (1..sites.len() - p).map(|j| sites[j..j + p].iter().sum::<f64>() / p as f64).collect()
        };
        Self::clamped_around(degree, sites, sites.len(), interior)
    }

    /// Knots for a least-squares spline with `count` control points through data at `sites`: every span holds at least
    /// one site (Piegl & Tiller 1997, 9.68 and 9.69).
    ///
    /// # Errors
    /// [`SplineError::PointCount`] when `count` is below `degree + 1` or above the number of sites,
    /// [`SplineError::Site`] when the sites do not increase, and as [`KnotVector::new`].
    pub fn for_least_squares(degree: usize, sites: &[f64], count: usize) -> Result<Self, SplineError> {
        check_sites(sites)?;
        if count > sites.len() {
            return Err(SplineError::PointCount { found: count, expected: sites.len() });
        }
        let interior = |p: usize| -> Vec<f64> {
            let d = sites.len() as f64 / (count - p) as f64;
            (1..count - p)
                .map(|j| {
                    let at = j as f64 * d;
                    let (i, fraction) = (at.floor(), at.fract());
                    let i = i as usize;
                    (1.0 - fraction) * sites[i - 1] + fraction * sites[i]
                })
                .collect()
        };
        Self::clamped_around(degree, sites, count, interior)
    }

    /// Knots for interpolation at `sites` between the sites themselves (Silalahi 1999): for n sites t_1 .. t_n and the
    /// order k = `degree` + 1, the interior knots are x_{k+i} = t_{j+i} + (s/2) (t_{j+i+1} - t_{j+i}), 1 <= i <= n - k,
    /// with j = k div 2 and s = k mod 2. For even orders they are sites (two at each end left out, for a cubic: the
    /// spline has no knot there), for odd orders they lie midway between two.
    ///
    /// # Errors
    /// As [`KnotVector::averaged`].
    pub fn between_sites(degree: usize, sites: &[f64]) -> Result<Self, SplineError> {
        check_sites(sites)?;
        let interior = |p: usize| -> Vec<f64> {
            let (order, half) = (p + 1, 0.5 * ((p + 1) % 2) as f64);
            (1..=sites.len() - order)
                .map(|i| {
                    // t_{j+i}, counted from 1.
                    let at = order / 2 + i - 1;
                    sites[at] + half * (sites[at + 1] - sites[at])
                })
                .collect()
        };
        Self::clamped_around(degree, sites, sites.len(), interior)
    }

    /// Clamped knots of the same functions as `count` control points have over `knots` that need not be clamped, on the
    /// part where they make a full basis, \[t_p, t_count\] (counted from 0). Knots behind the last that `count` control
    /// points reach are left out.
    ///
    /// # Errors
    /// [`SplineError::PointCount`] when there are fewer than `count + degree + 1` knots or `count` is below `degree + 1`;
    /// [`SplineError::Knot`] when they decrease; and as [`KnotVector::new`].
    pub fn from_unclamped(degree: usize, knots: &[f64], count: usize) -> Result<Self, SplineError> {
        if !(1..=crate::spline::basis::MAX_DEGREE).contains(&degree) {
            return Err(SplineError::Degree(degree));
        }
        if count < degree + 1 || knots.len() < count + degree + 1 {
            return Err(SplineError::PointCount { found: knots.len(), expected: count.max(degree + 1) + degree + 1 });
        }
        let used = &knots[..count + degree + 1];
        if let Some(k) = used.windows(2).position(|w| w[0].is_nan() || w[1].is_nan() || w[1] < w[0]) {
            let problem = "smaller than the knot before it";
            return Err(SplineError::Knot { index: k + 1, value: used[k + 1], problem });
        }
        let (a, b) = (used[degree], used[count]);
        let mut clamped = vec![a; degree + 1];
        clamped.extend(used.iter().filter(|&&t| t > a && t < b));
        clamped.extend(std::iter::repeat_n(b, degree + 1));
        Self::new(degree, clamped)
    }

    fn clamped_around(
        degree: usize,
        sites: &[f64],
        count: usize,
        interior: impl Fn(usize) -> Vec<f64>,
    ) -> Result<Self, SplineError> {
        if !(1..=crate::spline::basis::MAX_DEGREE).contains(&degree) {
            return Err(SplineError::Degree(degree));
        }
        if count < degree + 1 {
            return Err(SplineError::PointCount { found: count, expected: degree + 1 });
        }
        let mut knots = vec![sites[0]; degree + 1];
        knots.extend(interior(degree));
        knots.extend(std::iter::repeat_n(sites[sites.len() - 1], degree + 1));
        Self::new(degree, knots)
    }

    /// The Schoenberg-Whitney condition: sites, increasing, can be given to the basis functions `from ..= to` in order,
    /// each to one that is positive there.
    ///
    /// # Errors
    /// [`SplineError::Undetermined`] with the first function that gets none.
    pub(super) fn check_determined(&self, sites: &[f64], from: usize, to: usize) -> Result<(), SplineError> {
        let (k, p) = (self.knots(), self.degree());
        let mut left = sites.iter().map(|&t| self.clamp(t));
        for i in from..=to {
            let low = k[i];
            let high = k[i + p + 1];
            let positive =
                |t: f64| (t > low && t < high) || (i == 0 && t <= low) || (i + 1 == self.basis_count() && t >= high);
            let found = left.by_ref().find(|&t| positive(t) || t >= high);
            if !found.is_some_and(positive) {
                return Err(SplineError::Undetermined { column: i });
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Worked example 9.1 of Piegl & Tiller 1997: chords 5, 5, 5 and sqrt(8) apart.. and averaged knots of degree 3.
    #[test]
    fn chord_length_and_averaged_knots_as_in_the_nurbs_book() {
        let points = [[0.0, 0.0], [3.0, 4.0], [-1.0, 4.0], [-4.0, 0.0], [-4.0, -3.0]];
        let t = Parametrization::ChordLength.parameters(&points).unwrap();
        let expected = [0.0, 5.0 / 17.0, 9.0 / 17.0, 14.0 / 17.0, 1.0];
        assert!(t.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-15), "{t:?}");
        let k = KnotVector::averaged(3, &t).unwrap();
        assert_eq!(k.knots().len(), 9);
        assert!((k.knots()[4] - 28.0 / 51.0).abs() < 1e-15);
    }

    #[test]
    fn centripetal_steps_are_square_roots() {
        let t = Parametrization::Centripetal.parameters(&[[0.0], [4.0], [5.0]]).unwrap();
        assert!((t[1] - 2.0 / 3.0).abs() < 1e-15);
        let t = Parametrization::Uniform.parameters(&[[0.0], [4.0], [5.0]]).unwrap();
        assert!((t[1] - 0.5).abs() < 1e-15);
    }

    /// Sites 0, 1, .. 6 and 5 control points of degree 2: d = 7/3, so that the knots are 7/3 - 1 and 14/3 - 1.
    #[test]
    fn least_squares_knots() {
        let sites: Vec<f64> = (0..7).map(f64::from).collect();
        let k = KnotVector::for_least_squares(2, &sites, 5).unwrap();
        assert!((k.knots()[3] - 4.0 / 3.0).abs() < 1e-14 && (k.knots()[4] - 11.0 / 3.0).abs() < 1e-14);
    }

    /// n = 6 sites: order 3 has its knots midway between inner sites, order 4 at the third and the last but two.
    #[test]
    fn knots_between_sites() {
        let sites = [0.0, 1.0, 3.0, 4.0, 6.0, 7.0];
        let inner = |degree: usize| {
            let k = KnotVector::between_sites(degree, &sites).unwrap();
            k.knots()[degree + 1..k.knots().len() - degree - 1].to_vec()
        };
        assert_eq!(inner(2), [2.0, 3.5, 5.0]);
        assert_eq!(inner(3), [3.0, 4.0]);
        assert_eq!(inner(4), [3.5]);
        assert!(inner(5).is_empty());
        assert!(matches!(KnotVector::between_sites(6, &sites), Err(SplineError::PointCount { found: 6, expected: 7 })));
        assert!(matches!(KnotVector::between_sites(2, &[0.0, 0.0, 1.0]), Err(SplineError::Site { index: 1, .. })));
    }

    /// The basis over the clamped knots spans what the functions over the knots as they are span.
    #[test]
    fn knots_that_are_not_clamped() {
        let open: Vec<f64> = [3., 3., 3., 6., 7., 7., 9., 10.].to_vec();
        let k = KnotVector::from_unclamped(2, &open, 4).unwrap();
        assert_eq!(k.knots(), [3., 3., 3., 6., 7., 7., 7.]);
        let uniform: Vec<f64> = (0..9).map(f64::from).collect();
        let k = KnotVector::from_unclamped(3, &uniform, 5).unwrap();
        assert_eq!(k.knots(), [3., 3., 3., 3., 4., 5., 5., 5., 5.]);
        assert_eq!(k.basis_count(), 5);
        let error = |knots: &[f64], count| KnotVector::from_unclamped(2, knots, count).unwrap_err();
        assert_eq!(error(&open, 6), SplineError::PointCount { found: 8, expected: 9 });
        assert_eq!(error(&open, 2), SplineError::PointCount { found: 8, expected: 6 });
        assert!(matches!(error(&[0., 1., 2., 1., 3., 4.], 3), SplineError::Knot { index: 3, .. }));
        assert!(matches!(KnotVector::from_unclamped(0, &open, 4), Err(SplineError::Degree(0))));
    }

    #[test]
    fn what_gives_no_parameters_is_an_error() {
        let rule = Parametrization::ChordLength;
        assert!(matches!(rule.parameters(&[[1.0], [1.0], [2.0]]), Err(SplineError::Site { index: 1, .. })));
        assert!(matches!(rule.parameters(&[[1.0], [1.0]]), Err(SplineError::Site { .. })));
        assert!(matches!(rule.parameters(&[[1.0]]), Err(SplineError::PointCount { .. })));
        assert!(matches!(KnotVector::averaged(3, &[0.0, 1.0, 2.0]), Err(SplineError::PointCount { .. })));
        assert!(matches!(KnotVector::averaged(1, &[0.0, 2.0, 1.0]), Err(SplineError::Site { index: 2, .. })));
        assert!(matches!(KnotVector::averaged(1, &[0.0, f64::NAN]), Err(SplineError::Site { index: 1, .. })));
        assert!(matches!(KnotVector::averaged(9, &[0.0, 1.0]), Err(SplineError::Degree(9))));
        assert!(matches!(KnotVector::for_least_squares(2, &[0.0, 1.0, 2.0], 4), Err(SplineError::PointCount { .. })));
    }
}
