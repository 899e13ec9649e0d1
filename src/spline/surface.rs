//! Tensor-product B-spline surfaces with D coordinates.

use super::curve::BsplineCurve;
use super::knots::{KnotVector, SplineError};

/// S(u, v) = sum_ij P_ij N_i(u) M_j(v), D coordinates; P_ij is stored at `i * columns + j`.
#[derive(Debug, Clone, PartialEq)]
pub struct BsplineSurface<const D: usize> {
    u: KnotVector,
    v: KnotVector,
    points: Vec<[f64; D]>,
}

/// Point and partial derivatives up to the second order of a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SurfaceJet<const D: usize> {
    /// S
    pub point: [f64; D],
    /// S_u
    pub du: [f64; D],
    /// S_v
    pub dv: [f64; D],
    /// S_uu
    pub duu: [f64; D],
    /// S_uv
    pub duv: [f64; D],
    /// S_vv
    pub dvv: [f64; D],
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
        Ok(Self { u, v, points })
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

    /// The point at (u, v).
    #[must_use]
    pub fn eval(&self, u: f64, v: f64) -> [f64; D] {
        self.derivatives::<1>(u, v)[0][0]
    }

    /// `result[a][b]` is the derivative of order a in u and b in v, 0 to N - 1 each, in one call; nothing is allocated.
    #[must_use]
    pub fn derivatives<const N: usize>(&self, u: f64, v: f64) -> [[[f64; D]; N]; N] {
        let clamp = |k: &KnotVector, t: f64| t.clamp(k.domain().0, k.domain().1);
        let (u, v) = (clamp(&self.u, u), clamp(&self.v, v));
        let (span_u, span_v) = (self.u.find_span(u), self.v.find_span(v));
        let (basis_u, basis_v) = (self.u.basis_derivatives::<N>(span_u, u), self.v.basis_derivatives::<N>(span_v, v));
        let (first_u, first_v) = (span_u - self.u.degree(), span_v - self.v.degree());
        let columns = self.v.basis_count();
        let mut result = [[[0.0; D]; N]; N];
        for i in 0..=self.u.degree() {
            let row = &self.points[(first_u + i) * columns + first_v..=(first_u + i) * columns + span_v];
            let mut across = [[0.0; D]; N];
            for (j, point) in row.iter().enumerate() {
                for (sum, order) in across.iter_mut().zip(&basis_v) {
                    for (s, c) in sum.iter_mut().zip(point) {
                        *s += order[j] * c;
                    }
                }
            }
            for (a, order) in basis_u.iter().enumerate() {
                for b in 0..N {
                    for d in 0..D {
                        result[a][b][d] += order[i] * across[b][d];
                    }
                }
            }
        }
        result
    }

    /// Point, first and second derivatives at (u, v); nothing is allocated.
    #[must_use]
    pub fn jet(&self, u: f64, v: f64) -> SurfaceJet<D> {
        let d = self.derivatives::<3>(u, v);
        SurfaceJet { point: d[0][0], du: d[1][0], dv: d[0][1], duu: d[2][0], duv: d[1][1], dvv: d[0][2] }
    }

    /// The curve u -> S(u, v) at fixed `v`, exactly.
    #[must_use]
    pub fn curve_at_v(&self, v: f64) -> BsplineCurve<D> {
        let (a, b) = self.v.domain();
        let v = v.clamp(a, b);
        let span = self.v.find_span(v);
        let basis = self.v.basis(span, v);
        let first = span - self.v.degree();
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
        let (a, b) = self.u.domain();
        let u = u.clamp(a, b);
        let span = self.u.find_span(u);
        let basis = self.u.basis(span, u);
        let first = span - self.u.degree();
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
