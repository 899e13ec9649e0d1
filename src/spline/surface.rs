//! Tensor-product B-spline surfaces with D coordinates.

use super::curve::BsplineCurve;
use super::knots::{KnotVector, SplineError};
use super::powers::{Parts, Powers};

/// S(u, v) = sum_ij P_ij N_i(u) M_j(v), D coordinates; P_ij is stored at `i * columns + j`.
#[derive(Debug, Clone, PartialEq)]
pub struct BsplineSurface<const D: usize> {
    u: KnotVector,
    v: KnotVector,
    points: Vec<[f64; D]>,
    powers: Powers<D>,
}

impl<const D: usize> BsplineSurface<D> {
    /// Takes the two knot vectors and the net, `u` slowest.
    ///
    /// # Errors
    /// [`SplineError::PointCount`] or [`SplineError::NotFinite`].
    pub fn new(u: KnotVector, v: KnotVector, points: Vec<[f64; D]>) -> Result<Self, SplineError> {
        let expected = u.basis_count() * v.basis_count();
        if points.len() != expected {
            return Err(SplineError::PointCount { found: points.len(), expected });
        }
        if let Some(index) = points.iter().position(|p| p.iter().any(|c| !c.is_finite())) {
            return Err(SplineError::NotFinite(index));
        }
        Ok(Self::from_parts(u, v, points))
    }

    /// A surface whose parts are known to fit; used inside the kernel only.
    pub(super) fn from_parts(u: KnotVector, v: KnotVector, points: Vec<[f64; D]>) -> Self {
        debug_assert_eq!(points.len(), u.basis_count() * v.basis_count());
        Self { u, v, points, powers: Powers::default() }
    }

    /// The same surface with the parameters exchanged: (u, v) -> S(v, u).
    #[must_use]
    pub fn transposed(&self) -> Self {
        let [rows, columns] = self.shape();
        let points = (0..columns).flat_map(|j| (0..rows).map(move |i| self.point(i, j))).collect();
        Self::from_parts(self.v.clone(), self.u.clone(), points)
    }

    /// Knots in u.
    #[must_use]
    pub fn u(&self) -> &KnotVector {
        &self.u
    }

    /// Knots in v.
    #[must_use]
    pub fn v(&self) -> &KnotVector {
        &self.v
    }

    /// The net, `u` slowest.
    #[must_use]
    pub fn points(&self) -> &[[f64; D]] {
        &self.points
    }

    /// Knots and net.
    pub(super) fn parts(&self) -> Parts<'_, D> {
        Parts { u: &self.u, v: &self.v, points: &self.points }
    }

    /// The polynomials of a bicubic surface.
    #[inline(always)]
    pub(super) fn powers(&self) -> &Powers<D> {
        &self.powers
    }

    /// Numbers of control points in u and in v.
    #[must_use]
    pub fn shape(&self) -> [usize; 2] {
        [self.u.basis_count(), self.v.basis_count()]
    }

    /// The control point P_ij.
    ///
    /// # Panics
    /// When an index is out of range.
    #[must_use]
    pub fn point(&self, i: usize, j: usize) -> [f64; D] {
        self.points[i * self.v.basis_count() + j]
    }

    /// The curve u -> S(u, v) at fixed `v`, exactly.
    #[must_use]
    pub fn curve_at_v(&self, v: f64) -> BsplineCurve<D> {
        let (first, [basis]) = self.v.wide_orders_at::<1>(v);
        let points = (0..self.u.basis_count())
            .map(|i| {
                let mut sum = [0.0; D];
                for (j, weight) in basis.iter().enumerate().take(self.v.degree() + 1) {
                    let point = self.point(i, first + j);
                    for d in 0..D {
                        sum[d] += weight * point[d];
                    }
                }
                sum
            })
            .collect();
        BsplineCurve::from_parts(self.u.clone(), points)
    }

    /// The curve v -> S(u, v) at fixed `u`, exactly.
    #[must_use]
    pub fn curve_at_u(&self, u: f64) -> BsplineCurve<D> {
        let (first, [basis]) = self.u.wide_orders_at::<1>(u);
        let points = (0..self.v.basis_count())
            .map(|j| {
                let mut sum = [0.0; D];
                for (i, weight) in basis.iter().enumerate().take(self.u.degree() + 1) {
                    let point = self.point(first + i, j);
                    for d in 0..D {
                        sum[d] += weight * point[d];
                    }
                }
                sum
            })
            .collect();
        BsplineCurve::from_parts(self.v.clone(), points)
    }
}
