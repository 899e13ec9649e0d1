//! Interpolation and least squares of points: curves, and surfaces through grids of points.

use super::curve::BsplineCurve;
use super::fit::Collocation;
use super::knots::{KnotVector, SplineError};
use super::parametrize::check_sites;
use super::surface::BsplineSurface;
use crate::numeric::BandedLeastSquares;

/// What a least-squares spline does at the ends of its data.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ends {
    /// The ends are fitted like all other data.
    Free,
    /// The spline starts and ends in the first and last data point, which belong to the ends of the domain.
    Held,
}

fn check_points<const D: usize>(found: usize, expected: usize, points: &[[f64; D]]) -> Result<(), SplineError> {
    if found != expected {
        return Err(SplineError::PointCount { found, expected });
    }
    match points.iter().position(|p| p.iter().any(|c| !c.is_finite())) {
        Some(index) => Err(SplineError::NotFinite(index)),
        None => Ok(()),
    }
}

/// Least-squares control items of `width` points each for as many items of data as there are sites.
fn fit_items<const D: usize>(
    knots: &KnotVector,
    sites: &[f64],
    items: &[[f64; D]],
    width: usize,
    ends: Ends,
) -> Result<Vec<[f64; D]>, SplineError> {
    check_sites(sites)?;
    let (p, count, last) = (knots.degree(), knots.basis_count(), sites.len().saturating_sub(1));
    let (a, b) = knots.domain();
    let item = |i: usize| &items.as_flattened()[i * width * D..(i + 1) * width * D];
    // The unknown columns and the data used.
    let (from, to, data) = match ends {
        Ends::Free => (0, count - 1, 0..sites.len()),
        Ends::Held => {
            for (index, end) in [(0, a), (last, b)] {
                let value = sites.get(index).copied().unwrap_or(f64::NAN);
                if value.is_nan() || (value - end).abs() > 1e-14 * (b - a) {
                    return Err(SplineError::Site { index, value, problem: "a held end is not the end of the domain" });
                }
            }
            (1, count - 2, 1..last)
        }
    };
    let mut solution = Vec::with_capacity(count * width * D);
    if ends == Ends::Held {
        solution.extend_from_slice(item(0));
    }
    if to >= from {
        knots.check_determined(&sites[data.clone()], from, to)?;
        let mut problem = BandedLeastSquares::new(to + 1 - from, p + 1, width * D);
        let mut right = Vec::with_capacity(width * D);
        for i in data {
            let (first, [weights]) = knots.orders_at::<1>(sites[i]);
            right.clear();
            right.extend_from_slice(item(i));
            if ends == Ends::Held {
                for (column, end) in [(0, 0), (count - 1, last)] {
                    if (first..=first + p).contains(&column) {
                        right.iter_mut().zip(item(end)).for_each(|(r, e)| *r -= weights[column - first] * e);
                    }
                }
            }
            let (low, high) = (first.max(from), (first + p).min(to));
            if low <= high {
                problem.add(low - from, &weights[low - first..=high - first], &right);
            }
        }
        let free = problem.solve().map_err(|error| SplineError::Undetermined { column: error.column + from })?;
        solution.extend(free);
    }
    if ends == Ends::Held {
        solution.extend_from_slice(item(last));
    }
    let (points, _) = solution.as_chunks::<D>();
    Ok(points.to_vec())
}

impl<const D: usize> BsplineCurve<D> {
    /// The curve over `knots` that takes the `points` at the `sites`, as many as there are control points.
    ///
    /// # Errors
    /// [`SplineError::PointCount`], [`SplineError::NotFinite`], [`SplineError::Site`] when the sites do not increase,
    /// [`SplineError::Undetermined`] when they do not determine the curve (Schoenberg & Whitney 1953).
    pub fn interpolate(knots: KnotVector, sites: &[f64], points: &[[f64; D]]) -> Result<Self, SplineError> {
        check_points(points.len(), sites.len(), points)?;
        let collocation = Collocation::new(&knots, sites)?;
        let mut values = points.to_vec();
        for d in 0..D {
            collocation.solve_strided(values.as_flattened_mut(), d, D);
        }
        Ok(Self::from_parts(knots, values))
    }

    /// The curve over `knots` with the least sum of squared distances to the `points` at the `sites`.
    ///
    /// # Errors
    /// As [`BsplineCurve::interpolate`]; [`SplineError::Site`] also when an end is held and its site is not that of the
    /// domain.
    #[doc(hidden)]
    pub fn fit(knots: KnotVector, sites: &[f64], points: &[[f64; D]], ends: Ends) -> Result<Self, SplineError> {
        check_points(points.len(), sites.len(), points)?;
        let control = fit_items(&knots, sites, points, 1, ends)?;
        Ok(Self::from_parts(knots, control))
    }
}

impl<const D: usize> BsplineSurface<D> {
    /// The surface over `knots` (in u and in v) that takes the grid of `points` (`u` slowest) at the `sites`.
    ///
    /// # Errors
    /// As [`BsplineCurve::interpolate`].
    pub fn interpolate(knots: [KnotVector; 2], sites: [&[f64]; 2], points: &[[f64; D]]) -> Result<Self, SplineError> {
        check_points(points.len(), sites[0].len() * sites[1].len(), points)?;
        let (in_u, in_v) = (Collocation::new(&knots[0], sites[0])?, Collocation::new(&knots[1], sites[1])?);
        let mut values = points.to_vec();
        let columns = sites[1].len();
        let numbers = values.as_flattened_mut();
        for offset in 0..columns * D {
            in_u.solve_strided(numbers, offset, columns * D);
        }
        for row in 0..sites[0].len() {
            for d in 0..D {
                in_v.solve_strided(numbers, row * columns * D + d, D);
            }
        }
        let [u, v] = knots;
        Ok(Self::from_parts(u, v, values))
    }

    /// The surface over `knots` (in u and in v) with the least sum of squared distances to the grid of `points` (`u`
    /// slowest) at the `sites`. With held ends, the four boundary curves are the fits of the boundary points and the
    /// corners are met.
    ///
    /// # Errors
    /// As [`BsplineCurve::fit`].
    #[doc(hidden)]
    pub fn fit(
        knots: [KnotVector; 2],
        sites: [&[f64]; 2],
        points: &[[f64; D]],
        ends: Ends,
    ) -> Result<Self, SplineError> {
        let (rows, columns) = (sites[0].len(), sites[1].len());
        check_points(points.len(), rows * columns, points)?;
        let [u, v] = knots;
        let along = fit_items(&u, sites[0], points, columns, ends)?;
        let count = u.basis_count();
        let turned: Vec<[f64; D]> =
            (0..columns).flat_map(|j| (0..count).map(move |i| i * columns + j)).map(|k| along[k]).collect();
        let net = fit_items(&v, sites[1], &turned, count, ends)?;
        Ok(Self::from_parts(v, u, net).transposed())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spline::Parametrization;
    use crate::spline::tests::{curve, distance, parameters, surface};
    use proptest::prelude::*;

    const EXAMPLE: [[f64; 2]; 5] = [[0.0, 0.0], [3.0, 4.0], [-1.0, 4.0], [-4.0, 0.0], [-4.0, -3.0]];

    /// Worked example 9.1 of Piegl & Tiller 1997: five points, cubic, chord lengths, averaged knots. The matrix of the
    /// book has the row of the site 9/17 with the values checked here.
    #[test]
    fn interpolation_as_in_the_nurbs_book() {
        let sites = Parametrization::ChordLength.parameters(&EXAMPLE).unwrap();
        let knots = KnotVector::averaged(3, &sites).unwrap();
        let c = BsplineCurve::interpolate(knots, &sites, &EXAMPLE).unwrap();
        let found: Vec<[f64; 2]> = sites.iter().map(|&t| c.eval(t)).collect();
        assert!(distance(&found, &EXAMPLE) < 1e-14);
        // With one interior knot 28/51 the second function at the site 5/17 is known in closed form:
        // N_0 = (1 - x)^3 with x = (5/17) / (28/51) = 15/28.
        let n0 = c.knots().basis(3, sites[1])[0];
        assert!((n0 - (13.0f64 / 28.0).powi(3)).abs() < 1e-15);
    }

    /// The straight line through (0, 0), (1, 1), (2, 1): 1/6 + x/2 (normal equations by hand).
    #[test]
    fn line_of_least_squares() {
        let knots = KnotVector::from_breakpoints(1, &[0.0, 2.0], &[]).unwrap();
        let sites = [0.0, 1.0, 2.0];
        let c = BsplineCurve::fit(knots.clone(), &sites, &[[0.0], [1.0], [1.0]], Ends::Free).unwrap();
        assert!(distance(c.points(), &[[1.0 / 6.0], [7.0 / 6.0]]) < 1e-15);
        let held = BsplineCurve::fit(knots, &sites, &[[0.0], [1.0], [1.0]], Ends::Held).unwrap();
        assert!(distance(held.points(), &[[0.0], [1.0]]) < 1e-15);
    }

    /// A parabola with held ends 0 at 0 and 1 through data y_i: one unknown P_1 = sum w y / sum w^2, w = 2 t (1 - t).
    #[test]
    fn held_ends_leave_the_inner_points() {
        let knots = KnotVector::uniform(2, 1).unwrap();
        let sites = [0.0, 0.25, 0.5, 0.75, 1.0];
        let c = BsplineCurve::fit(knots, &sites, &[[0.0], [1.0], [3.0], [2.0], [0.0]], Ends::Held).unwrap();
        let (w, y) = ([0.375, 0.5, 0.375], [1.0, 3.0, 2.0]);
        let exact = (0..3).map(|i| w[i] * y[i]).sum::<f64>() / w.iter().map(|w| w * w).sum::<f64>();
        assert!(distance(c.points(), &[[0.0], [exact], [0.0]]) < 1e-14);
    }

    #[test]
    fn data_that_determine_nothing_are_errors() {
        let knots = KnotVector::uniform(3, 4).unwrap();
        let few = [0.0, 0.05, 0.1, 0.15, 0.2, 0.22, 1.0];
        let points = vec![[0.0]; 7];
        let expected = SplineError::Undetermined { column: 4 };
        assert_eq!(BsplineCurve::interpolate(knots.clone(), &few, &points).unwrap_err(), expected);
        assert_eq!(BsplineCurve::fit(knots.clone(), &few, &points, Ends::Free).unwrap_err(), expected);
        let error = BsplineCurve::fit(knots.clone(), &few[..6], &points[..6], Ends::Held).unwrap_err();
        assert!(matches!(error, SplineError::Site { index: 5, .. }), "{error}");
        let error = BsplineCurve::fit(knots.clone(), &few, &points[..6], Ends::Held).unwrap_err();
        assert!(matches!(error, SplineError::PointCount { found: 6, expected: 7 }), "{error}");
        let error = BsplineCurve::fit(knots, &few, &[[f64::NAN]; 7], Ends::Held).unwrap_err();
        assert!(matches!(error, SplineError::NotFinite(0)), "{error}");
    }

    proptest! {
        #[test]
        fn curves_are_found_again(c in curve::<2>(7)) {
            let sites: Vec<f64> = c.knots().greville();
            let distinct = sites.windows(2).all(|w| w[1] - w[0] > 1e-6);
            prop_assume!(distinct);
            let points: Vec<[f64; 2]> = sites.iter().map(|&t| c.eval(t)).collect();
            let same = BsplineCurve::interpolate(c.knots().clone(), &sites, &points).unwrap();
            prop_assert!(distance(same.points(), c.points()) < 1e-10);
            let mut many: Vec<f64> = sites.windows(2).flat_map(|w| [w[0], 0.5 * (w[0] + w[1])]).collect();
            many.push(c.knots().domain().1);
            let points: Vec<[f64; 2]> = many.iter().map(|&t| c.eval(t)).collect();
            for ends in [Ends::Free, Ends::Held] {
                let same = BsplineCurve::fit(c.knots().clone(), &many, &points, ends).unwrap();
                prop_assert!(distance(same.points(), c.points()) < 1e-10);
            }
        }

        #[test]
        fn surfaces_are_found_again(s in surface::<3>(3)) {
            let (us, vs) = (s.u().greville(), s.v().greville());
            prop_assume!(us.windows(2).chain(vs.windows(2)).all(|w| w[1] - w[0] > 1e-6));
            let grid = |us: &[f64], vs: &[f64]| -> Vec<[f64; 3]> {
                us.iter().flat_map(|&u| vs.iter().map(move |&v| (u, v))).map(|(u, v)| s.eval(u, v)).collect()
            };
            let knots = || [s.u().clone(), s.v().clone()];
            let same = BsplineSurface::interpolate(knots(), [&us, &vs], &grid(&us, &vs)).unwrap();
            prop_assert!(distance(same.points(), s.points()) < 1e-10);
            let dense = |k: &KnotVector| {
                let mut all = parameters(k);
                all.extend(k.greville());
                all.sort_by(f64::total_cmp);
                all.dedup_by(|a, b| *a - *b < 1e-9);
                all
            };
            let (us, vs) = (dense(s.u()), dense(s.v()));
            for ends in [Ends::Free, Ends::Held] {
                let same = BsplineSurface::fit(knots(), [&us, &vs], &grid(&us, &vs), ends).unwrap();
                prop_assert!(distance(same.points(), s.points()) < 1e-9);
            }
        }
    }
}
