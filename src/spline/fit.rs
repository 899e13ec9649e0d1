//! Interpolation: the banded collocation matrix of a knot vector at given sites.

use super::knots::{KnotVector, SplineError};
use super::parametrize::check_sites;
use crate::numeric::BandedLu;

/// What is given at a site: the value (order 0) or a derivative.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Condition {
    /// Parameter.
    pub site: f64,
    /// Order of the derivative that is given, 0 to 2.
    pub order: usize,
}

/// The factored matrix N_j^(order_i)(site_i), one condition a basis function, sites in increasing order.
#[derive(Debug, Clone)]
pub struct Collocation {
    lu: BandedLu,
    count: usize,
}

impl Collocation {
    /// Values at increasing sites, one a basis function.
    ///
    /// # Errors
    /// [`SplineError::PointCount`] when their number is not that of the basis functions, [`SplineError::Site`] when
    /// they do not increase, [`SplineError::Undetermined`] when they do not determine the spline (Schoenberg & Whitney
    /// 1953).
    pub fn new(knots: &KnotVector, sites: &[f64]) -> Result<Self, SplineError> {
        if sites.len() != knots.basis_count() {
            return Err(SplineError::PointCount { found: sites.len(), expected: knots.basis_count() });
        }
        check_sites(sites)?;
        knots.check_determined(sites, 0, knots.basis_count() - 1)?;
        let conditions: Vec<Condition> = sites.iter().map(|&site| Condition { site, order: 0 }).collect();
        Self::with_conditions(knots, &conditions)
    }

    /// Values and derivatives at sites that do not decrease, one condition a basis function.
    ///
    /// # Errors
    /// [`SplineError::PointCount`] when their number is not that of the basis functions, [`SplineError::Undetermined`]
    /// when they do not determine the spline.
    pub fn with_conditions(knots: &KnotVector, conditions: &[Condition]) -> Result<Self, SplineError> {
        let count = knots.basis_count();
        if conditions.len() != count {
            return Err(SplineError::PointCount { found: conditions.len(), expected: count });
        }
        let p = knots.degree();
        let (a, b) = knots.domain();
        let rows: Vec<(usize, [f64; 8])> = conditions
            .iter()
            .map(|c| {
                let t = c.site.clamp(a, b);
                let span = knots.find_span(t);
                (span - p, knots.basis_derivatives::<3>(span, t)[c.order.min(2)])
            })
            .collect();
        let lower = rows.iter().enumerate().map(|(i, r)| i.saturating_sub(r.0)).max().unwrap_or(0);
        let upper = rows.iter().enumerate().map(|(i, r)| (r.0 + p).saturating_sub(i)).max().unwrap_or(0);
        let entry = |i: usize, j: usize| {
            let (first, values) = &rows[i];
            if (*first..=first + p).contains(&j) { values[j - first] } else { 0.0 }
        };
        let lu = BandedLu::new(count, lower, upper, entry)
            .map_err(|error| SplineError::Undetermined { column: error.column })?;
        Ok(Self { lu, count })
    }

    /// Turns the given values `values[offset + i * stride]` into control values, in place.
    ///
    /// # Panics
    /// When `values` is too short.
    pub fn solve_strided(&self, values: &mut [f64], offset: usize, stride: usize) {
        self.lu.solve_strided(values, offset, stride);
    }

    /// Turns the given values into control values, in place.
    ///
    /// # Panics
    /// When `values` is too short.
    pub fn solve(&self, values: &mut [f64]) {
        self.lu.solve_strided(values, 0, 1);
    }

    /// Turns a matrix of given values (rows u, columns v, row by row) into the net of a tensor-product spline, in place:
    /// `self` in u and `across` in v.
    ///
    /// # Panics
    /// When `values` is too short.
    pub fn solve_tensor(&self, across: &Self, values: &mut [f64]) {
        for column in 0..across.count {
            self.solve_strided(values, column, across.count);
        }
        for row in 0..self.count {
            across.solve_strided(values, row * across.count, 1);
        }
    }
}
