//! The bending energy of a surface, with its derivatives by the half-breadths of the net.
//!
//! With y as a function of x and z, p = y_x, q = y_z, r = y_xx, s = y_xz, t = y_zz and W^2 = 1 + p^2 + q^2,
//!
//! ```text
//! F = int int (k1^2 + k2^2) dA = int int (N^2 / W^5 - 2 (r t - s^2) / W^3) dx dz,     N = (1 + q^2) r - 2 p q s + (1 + p^2) t
//! ```
//!
//! of the principal curvatures k1 and k2 (4 H^2 - 2 K by mean and Gaussian curvature; do Carmo, Differential Geometry
//! of Curves and Surfaces, 1976, 3-3), a number without a unit. x and z stay functions of the parameters, so that p to
//! t are linear in the half-breadths; Gauss sums over the cells of the net, with as many nodes in either direction as
//! its degree plus one.
//!
//! The second derivatives of the integrand by p to t are exact and are taken without their negative part: F is not
//! convex, its quadratic model is.

use super::cells::{Cells, Place};
use crate::numeric::SymmetricBand;
use crate::spline::BsplineSurface;
use nalgebra::{SMatrix, SVector};

/// Slopes and second derivatives: p, q, r, s, t.
const FORMS: usize = 5;

/// Orders along the ship and up of the derivatives of y by the parameters that make them.
const ORDERS: [(usize, usize); FORMS] = [(1, 0), (0, 1), (2, 0), (1, 1), (0, 2)];

/// Part of the greatest possible determinant of a chart below which it counts as folded.
const FOLDED: f64 = 1e-6;

type Vector = SVector<f64, FORMS>;
type Matrix = SMatrix<f64, FORMS, FORMS>;

/// p, q, r, s and t at a place.
struct Graph {
    values: Vector,
    /// What they are of the derivatives by the parameters.
    of: Matrix,
    /// dx dz over du dv.
    area: f64,
}

impl Graph {
    /// None where the chart folds: its determinant vanishes or has not the sign `side`, which the first place gives.
    fn new(place: &Place<'_>, side: &mut f64) -> Option<Self> {
        let d = &place.derivatives;
        let [xu, zu, xv, zv] = [d[1][0][0], d[1][0][2], d[0][1][0], d[0][1][2]];
        let area = xu * zv - xv * zu;
        if *side == 0.0 {
            *side = area.signum();
        }
        if *side * area <= FOLDED * xu.hypot(zu) * xv.hypot(zv) {
            return None;
        }
        // d/dx = a d/du + b d/dv and d/dz = e d/du + f d/dv.
        let [a, b, e, f] = [zv / area, -zu / area, -xv / area, xu / area];
        let mut of = Matrix::zeros();
        (of[(0, 0)], of[(0, 1)], of[(1, 0)], of[(1, 1)]) = (a, b, e, f);
        let second = [[a * a, 2.0 * a * b, b * b], [a * e, a * f + b * e, b * f], [e * e, 2.0 * e * f, f * f]];
        for (row, factors) in (2..).zip(second) {
            for (k, factor) in factors.into_iter().enumerate() {
                of[(row, 2 + k)] = factor;
                // The bend of the chart itself is taken off.
                let (s, t) = ORDERS[2 + k];
                let [x, z] = [d[s][t][0], d[s][t][2]];
                of[(row, 0)] -= factor * (x * a + z * e);
                of[(row, 1)] -= factor * (x * b + z * f);
            }
        }
        let own = Vector::from(ORDERS.map(|(s, t)| d[s][t][1]));
        Some(Self { values: of * own, of, area: area.abs() })
    }

    fn density(&self) -> f64 {
        let [p, q, r, s, t] = self.values.into();
        let square = 1.0 + p * p + q * q;
        let n = (1.0 + q * q) * r - 2.0 * p * q * s + (1.0 + p * p) * t;
        n * n / square.powf(2.5) - 2.0 * (r * t - s * s) / square.powf(1.5)
    }

    /// Gradient and second derivatives of the density.
    fn derivatives(&self) -> (Vector, Matrix) {
        let [p, q, r, s, t] = self.values.into();
        let inverse = 1.0 / (1.0 + p * p + q * q);
        let b = inverse * inverse.sqrt();
        let a = b * inverse;
        // a = W^-5 and b = W^-3 by p and q.
        let slopes = |power: f64, value: f64| {
            let first = -power * value * inverse;
            let second = power * (power + 2.0) * value * inverse * inverse;
            let gradient = Vector::new(first * p, first * q, 0.0, 0.0, 0.0);
            let mut curved = Matrix::zeros();
            curved[(0, 0)] = first + second * p * p;
            curved[(1, 1)] = first + second * q * q;
            (curved[(0, 1)], curved[(1, 0)]) = (second * p * q, second * p * q);
            (gradient, curved)
        };
        let ((da, dda), (db, ddb)) = (slopes(5.0, a), slopes(3.0, b));
        let n = (1.0 + q * q) * r - 2.0 * p * q * s + (1.0 + p * p) * t;
        let dn = Vector::new(2.0 * (p * t - q * s), 2.0 * (q * r - p * s), 1.0 + q * q, -2.0 * p * q, 1.0 + p * p);
        let mut ddn = Matrix::zeros();
        let mut dk = Vector::zeros();
        let mut ddk = Matrix::zeros();
        let upper = [(0, 0, t), (0, 1, -s), (0, 3, -q), (0, 4, p), (1, 1, r), (1, 2, q), (1, 3, -p)];
        for (i, j, half) in upper {
            (ddn[(i, j)], ddn[(j, i)]) = (2.0 * half, 2.0 * half);
        }
        let k = r * t - s * s;
        (dk[2], dk[3], dk[4]) = (t, -2.0 * s, r);
        (ddk[(2, 4)], ddk[(4, 2)], ddk[(3, 3)]) = (1.0, 1.0, -2.0);
        let both = |left: &Vector, right: &Vector| left * right.transpose() + right * left.transpose();
        let gradient = dn * (2.0 * n * a) + da * (n * n) - dk * (2.0 * b) - db * (2.0 * k);
        let curved = dn * dn.transpose() * (2.0 * a) + ddn * (2.0 * n * a) + both(&dn, &da) * (2.0 * n) + dda * (n * n)
            - ddk * (2.0 * b)
            - both(&dk, &db) * 2.0
            - ddb * (2.0 * k);
        (gradient, curved)
    }
}

/// The nearest matrix without negative eigenvalues.
fn convex(curved: Matrix) -> Matrix {
    if curved.cholesky().is_some() {
        return curved;
    }
    let parts = curved.symmetric_eigen();
    let kept = parts.eigenvalues.map(|value| value.max(0.0));
    parts.eigenvectors * Matrix::from_diagonal(&kept) * parts.eigenvectors.transpose()
}

/// int (k1^2 + k2^2) dA of a surface that is a graph over its centreplane; none where its chart folds.
#[must_use]
pub fn bending_energy(surface: &BsplineSurface<3>) -> Option<f64> {
    let cells = Cells::new(surface);
    let (mut sum, mut side) = (0.0, 0.0);
    for cell in cells.all() {
        for place in cells.places(cell) {
            let graph = Graph::new(&place, &mut side)?;
            sum += place.weight * graph.area * graph.density();
        }
    }
    Some(sum)
}

/// The quadratic model of the bending energy about a surface: F(y + d) = value + gradient'd + d'M d / 2 + ...
pub(super) struct BendingModel {
    /// By the half-breadths of the net.
    pub(super) gradient: Vec<f64>,
    /// M.
    pub(super) curved: SymmetricBand,
}

impl BendingModel {
    /// None where the chart folds.
    pub(super) fn new(surface: &BsplineSurface<3>) -> Option<Self> {
        let cells = Cells::new(surface);
        let mut curved = cells.zeros();
        let mut gradient = vec![0.0; surface.points().len()];
        let (mut own, mut places, mut side) = (Vec::new(), Vec::new(), 0.0);
        for cell in cells.all() {
            let mut block: Vec<f64> = Vec::new();
            for place in cells.places(cell) {
                let graph = Graph::new(&place, &mut side)?;
                own.clear();
                places.clear();
                for (index, factors) in place.factors(ORDERS) {
                    places.push(index);
                    own.push(factors);
                }
                block.resize(own.len() * own.len(), 0.0);
                let weight = place.weight * graph.area;
                let (slope, second) = graph.derivatives();
                let slope = graph.of.tr_mul(&slope) * weight;
                let second = graph.of.tr_mul(&convex(second)) * graph.of * weight;
                for ((k, factors), &index) in own.iter().enumerate().zip(&places) {
                    let factors = Vector::from(*factors);
                    gradient[index] += slope.dot(&factors);
                    let line: [f64; FORMS] = (second * factors).into();
                    for (sum, other) in block[k * own.len()..=k * own.len() + k].iter_mut().zip(&own) {
                        *sum += (0..FORMS).map(|form| line[form] * other[form]).sum::<f64>();
                    }
                }
            }
            for (k, &i) in places.iter().enumerate() {
                for (l, &j) in places[..=k].iter().enumerate() {
                    curved.add(i, j, block[k * places.len() + l]);
                }
            }
        }
        Some(Self { gradient, curved })
    }
}
