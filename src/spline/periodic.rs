//! Interpolation of periodic data.
//!
//! A periodic spline of degree p through n points is p - 1 times continuously differentiable across the seam. Knots are
//! the sites (odd degree) or lie midway between them (even degree). On equal steps the relative error of the
//! interpolant of exp(i t) in the derivative of order m is about 2 (n - 1)^(m - p - 1) (Golomb 1968). The cyclic matrix
//! becomes a banded one when the unknowns are taken in the order 0, n - 1, 1, n - 2, ...

use super::basis::MAX_DEGREE;
use super::curve::BsplineCurve;
use super::knots::{KnotVector, SplineError};
use super::parametrize::check_sites;
use super::refine::{apply, refinement_rows};
use super::surface::BsplineSurface;
use crate::numeric::BandedLu;

/// The factored matrix of periodic interpolation at fixed sites, and the clamped knots of one period.
#[derive(Debug, Clone)]
pub struct PeriodicCollocation {
    lu: BandedLu,
    count: usize,
    /// Knots of several periods.
    unclamped: Vec<f64>,
    /// Index of the periodic control point that belongs to the first of `unclamped`, counted from below.
    lead: usize,
    clamped: KnotVector,
}

impl PeriodicCollocation {
    /// For values at increasing `sites` within one period of length `period`; the splines are given on the domain
    /// [`sites[0]`, `sites[0] + period`].
    ///
    /// # Errors
    /// [`SplineError::Degree`], [`SplineError::PointCount`] for fewer than `degree + 1` sites, [`SplineError::Site`]
    /// when they do not increase or reach beyond a period.
    pub fn new(degree: usize, sites: &[f64], period: f64) -> Result<Self, SplineError> {
        if !(1..=MAX_DEGREE).contains(&degree) {
            return Err(SplineError::Degree(degree));
        }
        check_sites(sites)?;
        let (p, n) = (degree, sites.len());
        if n < p + 1 {
            return Err(SplineError::PointCount { found: n, expected: p + 1 });
        }
        if period.is_nan() || sites[n - 1] >= sites[0] + period {
            return Err(SplineError::Site { index: n - 1, value: sites[n - 1], problem: "beyond one period" });
        }
        let site = |i: isize| {
            let (turns, rest) = (i.div_euclid(n as isize), i.rem_euclid(n as isize));
            sites[rest as usize] + turns as f64 * period
        };
        let knot = |i: isize| if p % 2 == 1 { site(i) } else { 0.5 * (site(i - 1) + site(i)) };
        // Knots -lead ..; function i of the periodic basis starts at knot i.
        let lead = 2 * (p + 1);
        let unclamped: Vec<f64> = (-(lead as isize)..=(n + lead) as isize).map(knot).collect();
        let rows: Vec<(usize, super::basis::WideValues)> = (0..n)
            .map(|i| {
                // The site lies in the span that starts at knot i.
                let span = i + lead;
                ((i + n - p) % n, super::basis::blossom_row(&unclamped, span, &vec![sites[i]; p]))
            })
            .collect();
        // Row i meets the functions i - p ..= i; moved by half of that, row and column numbers differ by p / 2 + 1 at
        // most.
        let shift = p / 2 + 1;
        let entry = |r: usize, c: usize| {
            let (i, j) = (unfold(r, n), (unfold(c, n) + n - shift) % n);
            let (first, values) = &rows[i];
            let offset = (j + n - first) % n;
            if offset <= p { values[offset] } else { 0.0 }
        };
        let band = (2 * (p + 1) + 2).min(n - 1);
        let lu =
            BandedLu::new(n, band, band, entry).map_err(|error| SplineError::Undetermined { column: error.column })?;
        let (start, end) = (sites[0], sites[0] + period);
        let inside = unclamped.iter().copied().filter(|&t| t > start && t < end);
        let clamped = std::iter::repeat_n(start, p + 1).chain(inside).chain(std::iter::repeat_n(end, p + 1)).collect();
        Ok(Self { lu, count: n, unclamped, lead, clamped: KnotVector::new(p, clamped)? })
    }

    /// The clamped knots of one period.
    #[must_use]
    pub fn knots(&self) -> &KnotVector {
        &self.clamped
    }

    /// Control items for items of `width` points, one a site.
    fn solve<const D: usize>(&self, items: &[[f64; D]], width: usize) -> Vec<[f64; D]> {
        let (n, p) = (self.count, self.clamped.degree());
        let mut folded: Vec<[f64; D]> = (0..n).flat_map(|r| &items[unfold(r, n) * width..][..width]).copied().collect();
        for offset in 0..width * D {
            self.lu.solve_strided(folded.as_flattened_mut(), offset, width * D);
        }
        let shift = p / 2 + 1;
        // Periodic control points, repeated along the unclamped knots, then cut at the ends of the period.
        let functions = self.unclamped.len() - p - 1;
        let repeated: Vec<[f64; D]> = (0..functions)
            .flat_map(|k| {
                let i = (k + n * self.lead - self.lead) % n;
                &folded[fold((i + shift) % n, n) * width..][..width]
            })
            .copied()
            .collect();
        let rows = refinement_rows(p, &self.unclamped, self.clamped.knots());
        apply(rows.iter().map(|row| (row.first, &row.weights[..=p])), &repeated, width)
    }
}

/// The number that stands at place `r` of 0, n - 1, 1, n - 2, ...
fn unfold(r: usize, n: usize) -> usize {
    if r.is_multiple_of(2) { r / 2 } else { n - 1 - r / 2 }
}

/// The place of number `i` in 0, n - 1, 1, n - 2, ...
fn fold(i: usize, n: usize) -> usize {
    if 2 * i < n { 2 * i } else { 2 * (n - 1 - i) + 1 }
}

impl<const D: usize> BsplineCurve<D> {
    /// The closed curve through the `points` at the sites of `collocation`, on one period.
    ///
    /// # Errors
    /// [`SplineError::PointCount`] or [`SplineError::NotFinite`].
    #[doc(hidden)]
    pub fn interpolate_periodic(collocation: &PeriodicCollocation, points: &[[f64; D]]) -> Result<Self, SplineError> {
        if points.len() != collocation.count {
            return Err(SplineError::PointCount { found: points.len(), expected: collocation.count });
        }
        Self::new(collocation.clamped.clone(), collocation.solve(points, 1))
    }
}

impl<const D: usize> BsplineSurface<D> {
    /// The surface, closed in u and in v, through the grid of `points` (`u` slowest) at the sites of the `collocations`.
    ///
    /// # Errors
    /// [`SplineError::PointCount`] or [`SplineError::NotFinite`].
    #[doc(hidden)]
    pub fn interpolate_periodic(
        collocations: [&PeriodicCollocation; 2],
        points: &[[f64; D]],
    ) -> Result<Self, SplineError> {
        let [u, v] = collocations;
        let expected = u.count * v.count;
        if points.len() != expected {
            return Err(SplineError::PointCount { found: points.len(), expected });
        }
        let along = u.solve(points, v.count);
        let rows = u.clamped.basis_count();
        let turned: Vec<[f64; D]> =
            (0..v.count).flat_map(|j| (0..rows).map(move |i| i * v.count + j)).map(|k| along[k]).collect();
        Ok(Self::new(v.clamped.clone(), u.clamped.clone(), v.solve(&turned, rows))?.transposed())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use std::f64::consts::TAU;

    fn circle(sites: &[f64]) -> Vec<[f64; 2]> {
        sites.iter().map(|t| [t.cos(), t.sin()]).collect()
    }

    #[test]
    fn places_are_a_permutation() {
        for n in 1..10 {
            assert!((0..n).all(|r| fold(unfold(r, n), n) == r), "{n}");
        }
    }

    /// Radius of the interpolant of a circle from its Fourier series: with n equal steps and odd degree p, the harmonics
    /// 1 + m n have amplitudes in proportion to (1 + m n)^(-p - 1) (Golomb 1968).
    #[test]
    fn a_circle_has_the_harmonics_of_theory() {
        for p in [3, 5, 7] {
            let n = 16;
            let sites: Vec<f64> = (0..n).map(|k| TAU * k as f64 / n as f64).collect();
            let c =
                BsplineCurve::interpolate_periodic(&PeriodicCollocation::new(p, &sites, TAU).unwrap(), &circle(&sites));
            let c = c.unwrap();
            let amplitude = |m: i32| (1.0 + f64::from(m * n)).powi(-(p as i32) - 1);
            let total: f64 = (-2000..=2000).map(amplitude).sum();
            for t in [0.0, 0.1, 0.2, 3.0, 6.2] {
                let exact: f64 = (-2000..=2000).map(|m| amplitude(m) / total * (f64::from(m * n) * t).cos()).sum();
                let [x, y] = c.eval(t);
                assert!((x * t.cos() + y * t.sin() - exact).abs() < 1e-13, "{p} {t}");
            }
        }
    }

    #[test]
    fn data_that_are_no_period_are_errors() {
        let sites = [0.0, 1.0, 2.0, 3.0];
        assert!(matches!(PeriodicCollocation::new(3, &sites, 3.0), Err(SplineError::Site { index: 3, .. })));
        assert!(matches!(PeriodicCollocation::new(4, &sites, 4.0), Err(SplineError::PointCount { .. })));
        assert!(matches!(PeriodicCollocation::new(0, &sites, 4.0), Err(SplineError::Degree(0))));
        let c = PeriodicCollocation::new(3, &sites, 4.0).unwrap();
        assert!(matches!(BsplineCurve::interpolate_periodic(&c, &[[0.0]; 3]), Err(SplineError::PointCount { .. })));
        let error = BsplineSurface::interpolate_periodic([&c, &c], &[[0.0]; 3]).unwrap_err();
        assert!(matches!(error, SplineError::PointCount { found: 3, expected: 16 }));
    }

    proptest! {
        #[test]
        fn uneven_data_are_met_and_the_seam_is_smooth(
            p in 1usize..=7,
            steps in prop::collection::vec(0.5f64..1.0, 8..30),
            start in -2.0f64..2.0,
        ) {
            let mut sites = vec![start];
            for step in &steps {
                sites.push(sites[sites.len() - 1] + step);
            }
            let period = sites.pop().unwrap() - start;
            let points = circle(&sites.iter().map(|t| (t - start) / period * TAU + 0.3).collect::<Vec<f64>>());
            let c = BsplineCurve::interpolate_periodic(&PeriodicCollocation::new(p, &sites, period).unwrap(), &points);
            let c = c.unwrap();
            for (t, point) in sites.iter().zip(&points) {
                let found = c.eval(*t);
                prop_assert!((0..2).all(|d| (found[d] - point[d]).abs() < 1e-11), "{} {:?} {:?}", t, found, point);
            }
            let (a, b) = c.knots().domain();
            let (low, high) = (c.derivatives::<8>(a), c.derivatives::<8>(b));
            for order in 0..p {
                let size = c.derivatives::<8>(a)[..=order].iter().flatten().fold(1.0f64, |m, x| m.max(x.abs()));
                for d in 0..2 {
                    let jump = (low[order][d] - high[order][d]).abs();
                    prop_assert!(jump <= 1e-10 * size * 8f64.powi(order as i32), "{} {} {}", p, order, jump);
                }
            }
        }
    }
}
