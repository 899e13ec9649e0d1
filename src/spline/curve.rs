//! B-spline curves with D coordinates.

use super::basis::MAX_DEGREE;
use super::knots::{KnotVector, SplineError};

/// C(t) = sum_i P_i N_i(t), D coordinates.
#[derive(Debug, Clone, PartialEq)]
pub struct BsplineCurve<const D: usize> {
    knots: KnotVector,
    points: Vec<[f64; D]>,
}

impl<const D: usize> BsplineCurve<D> {
    /// Takes knots and as many control points as they have basis functions.
    ///
    /// # Errors
    /// [`SplineError::PointCount`] or [`SplineError::NotFinite`].
    pub fn new(knots: KnotVector, points: Vec<[f64; D]>) -> Result<Self, SplineError> {
        if points.len() != knots.basis_count() {
            return Err(SplineError::PointCount { found: points.len(), expected: knots.basis_count() });
        }
        if let Some(index) = points.iter().position(|p| p.iter().any(|c| !c.is_finite())) {
            return Err(SplineError::NotFinite(index));
        }
        Ok(Self { knots, points })
    }

    /// A curve whose parts are known to fit; used inside the kernel only.
    pub(super) fn from_parts(knots: KnotVector, points: Vec<[f64; D]>) -> Self {
        debug_assert_eq!(points.len(), knots.basis_count());
        Self { knots, points }
    }

    /// The knots.
    #[must_use]
    pub fn knots(&self) -> &KnotVector {
        &self.knots
    }

    /// The control points.
    #[must_use]
    pub fn points(&self) -> &[[f64; D]] {
        &self.points
    }

    /// The point at parameter `t`.
    #[must_use]
    pub fn eval(&self, t: f64) -> [f64; D] {
        self.derivatives::<1>(t)[0]
    }

    /// The point and the derivatives of order 1 to N - 1 at parameter `t`, in one call; nothing is allocated.
    #[must_use]
    pub fn derivatives<const N: usize>(&self, t: f64) -> [[f64; D]; N] {
        if self.knots.degree() > MAX_DEGREE {
            let (first, basis) = self.knots.wide_orders_at::<N>(t);
            return self.combined(first, &basis);
        }
        let (first, basis) = self.knots.orders_at::<N>(t);
        self.combined(first, &basis)
    }

    /// The sums of the control points from `first` on with each row of weights.
    #[inline(always)]
    fn combined<const N: usize, const W: usize>(&self, first: usize, basis: &[[f64; W]; N]) -> [[f64; D]; N] {
        let mut result = [[0.0; D]; N];
        for (i, point) in self.points[first..=first + self.knots.degree()].iter().enumerate() {
            for (row, order) in result.iter_mut().zip(basis) {
                for (sum, coordinate) in row.iter_mut().zip(point) {
                    *sum += order[i] * coordinate;
                }
            }
        }
        result
    }
}
