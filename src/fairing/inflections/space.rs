//! Splines as linear forms: their values at the sites and the coefficients of their second derivative.

use super::bands::Bands;
use crate::qp::SparseRows;
use crate::spline::{KnotVector, SplineError};

/// One coefficient of the second derivative of a spline over its control values, y'' = sum_i r_i M_i with B-splines M_i
/// of degree p - 2.
#[derive(Debug, Clone, PartialEq)]
pub struct CurvatureRow {
    /// The first of the three control values that it combines.
    pub first: usize,
    /// Their weights.
    pub weights: [f64; 3],
    /// Greville abscissa of M_i, the place the coefficient belongs to.
    pub at: f64,
    /// The ends of the support of M_i.
    pub support: [f64; 2],
}

/// The coefficients of the second derivative, in order. A curve has no more changes of the sign of y'' than they have
/// (variation diminishing), for cubics exactly as many: there y'' is piecewise linear and they are its values at the
/// knots. At a knot of full multiplicity, a knuckle, there is none: nothing is said across it.
#[must_use]
pub fn curvature_rows(knots: &KnotVector) -> Vec<CurvatureRow> {
    let (p, t) = (knots.degree(), knots.knots());
    if p < 2 {
        return Vec::new();
    }
    let step = |i: usize| p as f64 / (t[i + p + 1] - t[i + 1]);
    (0..knots.basis_count().saturating_sub(2))
        .filter(|i| t[i + p + 1] > t[i + 2])
        .map(|i| {
            let outer = (p - 1) as f64 / (t[i + p + 1] - t[i + 2]);
            let (left, right) = (outer * step(i), outer * step(i + 1));
            let inner = &t[i + 3..i + p + 1];
            let at = if inner.is_empty() {
                0.5 * (t[i + 2] + t[i + p + 1])
            } else {
                inner.iter().sum::<f64>() / inner.len() as f64
            };
            CurvatureRow { first: i, weights: [left, -left - right, right], at, support: [t[i + 2], t[i + p + 1]] }
        })
        .collect()
}

/// A linear space of curves over bands.
#[derive(Debug, Clone)]
pub(super) struct Space {
    /// The knots; none for the values at the sites themselves.
    pub(super) knots: Option<KnotVector>,
    /// The value at each site.
    pub(super) values: SparseRows,
    /// The second differences, in order along the curve.
    pub(super) bends: SparseRows,
    /// Where each of them belongs.
    pub(super) places: Vec<f64>,
    /// The first of them of each stretch, and their number at the end.
    pub(super) starts: Vec<usize>,
}

impl Space {
    /// Values at the sites of a single stretch and their divided differences.
    pub(super) fn of_values(bands: &Bands) -> Self {
        let x = bands.sites();
        let mut values = SparseRows::new(x.len());
        for k in 0..x.len() {
            values.push([(k, 1.0)]);
        }
        let mut bends = SparseRows::new(x.len());
        for k in 1..x.len() - 1 {
            // Divided by its largest weight; the sign is all that counts.
            let w = (x[k + 1] - x[k]) / (x[k + 1] - x[k - 1]);
            bends.push([(k - 1, w), (k, -1.0), (k + 1, 1.0 - w)]);
        }
        let places = x[1..x.len() - 1].to_vec();
        Self { knots: None, values, starts: vec![0, places.len()], bends, places }
    }

    /// Cubic splines with knots at the sites and `between` more in each cell, threefold at knuckles.
    pub(super) fn cubic(bands: &Bands, between: usize) -> Result<Self, SplineError> {
        let x = bands.sites();
        let (mut breaks, mut times) = (vec![x[0]], Vec::new());
        for k in 1..x.len() {
            for part in 1..=between {
                breaks.push(x[k - 1] + (x[k] - x[k - 1]) * part as f64 / (between + 1) as f64);
                times.push(1);
            }
            breaks.push(x[k]);
            if k + 1 < x.len() {
                times.push(if bands.knuckles().contains(&k) { 3 } else { 1 });
            }
        }
        let knots = KnotVector::from_breakpoints(3, &breaks, &times)?;
        let count = knots.basis_count();
        let mut values = SparseRows::new(count);
        for &site in x {
            let span = knots.find_span(site);
            let basis = knots.basis(span, site);
            values.push((0..=3).map(|r| (span - 3 + r, basis[r])).filter(|entry| entry.1 != 0.0));
        }
        let rows = curvature_rows(&knots);
        let mut bends = SparseRows::new(count);
        for row in &rows {
            bends.push(row.weights.iter().enumerate().map(|(k, &w)| (row.first + k, w)));
        }
        let places: Vec<f64> = rows.iter().map(|row| row.at).collect();
        // A row belongs to the stretch in which its support lies.
        let mut starts = vec![0];
        for &knuckle in bands.knuckles() {
            starts.push(rows.partition_point(|row| row.support[0] < x[knuckle]));
        }
        starts.push(rows.len());
        Ok(Self { knots: Some(knots), values, bends, places, starts })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spline::BsplineCurve;

    #[test]
    fn the_coefficients_are_those_of_the_second_derivative() {
        // x^4 on any knots of degree 5: y'' = 12 x^2 is reproduced by its own coefficients at the ends, and for cubics
        // with c from interpolation the coefficient is y'' at the knot.
        let knots = KnotVector::from_breakpoints(3, &[0.0, 0.4, 1.0, 2.5, 3.0], &[1, 3, 1]).unwrap();
        let control: Vec<[f64; 1]> = (0..knots.basis_count()).map(|i| [((7 * i * i) % 11) as f64]).collect();
        let rows = curvature_rows(&knots);
        let curve = BsplineCurve::new(knots, control.clone()).unwrap();
        // Between the knuckle at 1 and both ends: three values each.
        assert_eq!(rows.iter().map(|row| row.at).collect::<Vec<_>>(), [0.0, 0.4, 1.0, 1.0, 2.5, 3.0]);
        for (index, row) in rows.iter().enumerate() {
            let value: f64 = (0..3).map(|k| row.weights[k] * control[row.first + k][0]).sum();
            let from_left = if index == 2 { row.at - 1e-12 } else { row.at };
            let exact = curve.derivatives::<3>(from_left)[2][0];
            assert!((value - exact).abs() < 1e-8 * (1.0 + exact.abs()), "{index}: {value} {exact}");
        }
    }
}
