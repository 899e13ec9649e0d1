//! The net of a half-breadth field over the unit square and its energy.
//!
//! The energy is of order n = 4, over parameters counted in intervals of the table, s = N u and t = M v.
//!
//! ```text
//! E = int int sum_k C(n, k) a^(1-2k) (d^n y / ds^(n-k) dt^k)^2 ds dt = c'P(a) c
//! ```
//!
//! Here a is the anisotropy. The kernel of E are the polynomials in u and v of total degree n - 1.

use crate::numeric::{SingularMatrix, SymmetricBand};
use crate::spline::{Gram, KnotVector, SplineError, add_product, binomial};

/// Order of the energy.
pub const ORDER: usize = 4;

/// Degree of the net.
pub const DEGREE: usize = 5;

/// Polynomials of the kernel.
pub const KERNEL: usize = ORDER * (ORDER + 1) / 2;

/// A tensor-product net over the unit square, numbered v fastest, with the parts of its energy.
#[derive(Debug, Clone)]
pub struct Net {
    /// Knots along u and v.
    pub knots: [KnotVector; 2],
    /// Intervals that a parameter is counted in.
    pub intervals: [f64; 2],
    parts: Vec<SymmetricBand>,
    /// Control values that are taken out to make the energy definite, and the logarithm of the factor between the
    /// determinant of what is left and the product of the eigenvalues that are not zero, constants left out.
    grounded: Vec<usize>,
}

impl Net {
    /// The net on the given knots.
    #[must_use]
    pub fn new(knots: [KnotVector; 2], intervals: [f64; 2]) -> Self {
        let count = [knots[0].basis_count(), knots[1].basis_count()];
        let width = knots[0].degree().min(count[0] - 1) * count[1] + knots[1].degree().min(count[1] - 1);
        let grams = |k: usize, order: usize| {
            let gram = Gram::new(&knots[k], &knots[k], [order, order]);
            (gram, intervals[k].powi(1 - 2 * order as i32))
        };
        let parts = (0..=ORDER)
            .map(|k| {
                let mut part = SymmetricBand::zeros(count[0] * count[1], width);
                let ((along, p), (up, q)) = (grams(0, ORDER - k), grams(1, k));
                add_product(&mut part, [&along, &up], binomial(ORDER, k) * p * q, [&knots[0], &knots[1]]);
                part
            })
            .collect();
        let spread = |k: usize, j: usize| j * (count[k] - 1) / (ORDER - 1);
        let grounded = (0..ORDER)
            .flat_map(|i| (0..ORDER - i).map(move |j| (i, j)))
            .map(|(i, j)| spread(0, i) * count[1] + spread(1, j))
            .collect();
        Self { knots, intervals, parts, grounded }
    }

    /// Clamped uniform knots of so many spans.
    ///
    /// # Errors
    /// [`SplineError`] without spans.
    pub fn uniform(spans: [usize; 2], intervals: [f64; 2]) -> Result<Self, SplineError> {
        Ok(Self::new([KnotVector::uniform(DEGREE, spans[0])?, KnotVector::uniform(DEGREE, spans[1])?], intervals))
    }

    /// Numbers of control values along u and v.
    #[must_use]
    pub fn shape(&self) -> [usize; 2] {
        [self.knots[0].basis_count(), self.knots[1].basis_count()]
    }

    /// Number of control values.
    #[must_use]
    pub fn size(&self) -> usize {
        self.shape().iter().product()
    }

    /// Diagonals below the main one of the energy, and of the normal matrix of rows at places.
    #[must_use]
    pub fn energy_width(&self) -> usize {
        self.parts[0].width()
    }

    /// P(a).
    #[must_use]
    pub fn energy(&self, anisotropy: f64) -> SymmetricBand {
        let mut all = SymmetricBand::zeros(self.size(), self.parts[0].width());
        for (k, part) in self.parts.iter().enumerate() {
            all = all.plus(anisotropy.powi(1 - 2 * k as i32), part);
        }
        all
    }

    /// The logarithm of the product of the eigenvalues of P that are not zero, but for a constant of the net: that of the
    /// determinant of P without the rows and columns of as many control values as its kernel has functions.
    ///
    /// # Errors
    /// [`SingularMatrix`] when rounding makes it indefinite.
    pub fn log_determinant(&self, energy: &SymmetricBand) -> Result<f64, SingularMatrix> {
        let left: Vec<usize> = (0..self.size()).filter(|i| !self.grounded.contains(i)).collect();
        let mut matrix = SymmetricBand::zeros(left.len(), energy.width().min(left.len() - 1));
        for (row, &i) in left.iter().enumerate() {
            let first = left.partition_point(|&j| j + energy.width() < i);
            for (column, &j) in left[..=row].iter().enumerate().skip(first) {
                matrix.add(row, column, energy.get(i, j));
            }
        }
        Ok(matrix.factor()?.log_determinant())
    }

    /// The values of the functions along one direction that are not zero at a place, and the first of them.
    #[must_use]
    pub fn basis(&self, direction: usize, at: f64) -> (usize, [f64; DEGREE + 1]) {
        let knots = &self.knots[direction];
        let span = knots.find_span(at);
        let all = knots.basis(span, at);
        (span - DEGREE, std::array::from_fn(|k| all[k]))
    }

    /// Columns and values of the row that evaluates the net at (u, v), columns rising.
    #[must_use]
    pub fn row(&self, [u, v]: [f64; 2]) -> Vec<(usize, f64)> {
        let ((i, along), (j, up), [_, count]) = (self.basis(0, u), self.basis(1, v), self.shape());
        let entry = |r: usize, s: usize| ((i + r) * count + j + s, along[r] * up[s]);
        (0..=DEGREE).flat_map(|r| (0..=DEGREE).map(move |s| (r, s))).map(|(r, s)| entry(r, s)).collect()
    }
}
