//! Surfaces through grids of points whose parameters are not given.

use super::knots::{KnotVector, SplineError};
use super::parametrize::Parametrization;
use super::surface::BsplineSurface;

impl<const D: usize> BsplineSurface<D> {
    /// The surface through a grid of points (`u` slowest, `columns` in v) with as many control points as data:
    /// parameters by `rule`, averaged over the rows and over the columns, knots by [`KnotVector::between_sites`], the
    /// net by solving the collocation equations. Of degree `degrees` in u and v, lower where there are too few points.
    ///
    /// # Errors
    /// [`SplineError::PointCount`] when the points are no grid of two rows and two columns at least,
    /// [`SplineError::Site`] when two successive rows or columns coincide, [`SplineError::NotFinite`].
    #[doc(hidden)]
    pub fn through_grid(
        degrees: [usize; 2],
        rule: Parametrization,
        columns: usize,
        points: &[[f64; D]],
    ) -> Result<Self, SplineError> {
        let [us, vs] = grid_parameters(rule, columns, points)?;
        let knots = |degree: usize, sites: &[f64]| KnotVector::between_sites(degree.min(sites.len() - 1), sites);
        Self::interpolate([knots(degrees[0], &us)?, knots(degrees[1], &vs)?], [&us, &vs], points)
    }
}

/// Parameters of the rows and of the columns of a grid.
pub(super) fn grid_parameters<const D: usize>(
    rule: Parametrization,
    columns: usize,
    points: &[[f64; D]],
) -> Result<[Vec<f64>; 2], SplineError> {
    let us = rule.averaged_parameters(points, columns)?;
    let rows = us.len();
    let turned: Vec<[f64; D]> = (0..columns).flat_map(|j| (0..rows).map(move |i| points[i * columns + j])).collect();
    Ok([us, rule.averaged_parameters(&turned, rows)?])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_points_are_met_in_the_order_of_the_grid() {
        let points: Vec<[f64; 3]> = (0..5)
            .flat_map(|i| (0..4).map(move |j| [f64::from(i), f64::from(i * i + j), 2.0 * f64::from(j * j)]))
            .collect();
        let rule = Parametrization::ChordLength;
        let [us, vs] = grid_parameters(rule, 4, &points).unwrap();
        for degree in 1..=4 {
            let surface = BsplineSurface::through_grid([degree; 2], rule, 4, &points).unwrap();
            assert_eq!([surface.u().degree(), surface.v().degree()], [degree, degree.min(3)]);
            for (i, &u) in us.iter().enumerate() {
                for (j, &v) in vs.iter().enumerate() {
                    let found = surface.eval(u, v);
                    assert!((0..3).all(|d| (found[d] - points[i * 4 + j][d]).abs() < 1e-13), "{i} {j} {found:?}");
                }
            }
        }
        assert!(BsplineSurface::through_grid([2, 2], rule, 20, &points).is_err());
        assert!(BsplineSurface::through_grid([2, 2], rule, 0, &points).is_err());
        assert!(BsplineSurface::through_grid([2, 2], rule, 3, &points).is_err());
    }
}
