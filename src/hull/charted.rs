//! Weights of volumes and waterplanes on hulls that are not level.
//!
//! With J = x_u z_v - x_v z_u, volume = 2 int int y J dv du, and on the waterline z(u, v) = T, dx = (J / z_v) du. Rules
//! in v are exact for the polynomials of each span, rules in u run over the pieces of `immersion`: exact to rounding
//! where all of the lines u = constant is immersed, else of a relative error of about 1e-10.

use super::form::Hull;

use super::immersion::{Immersion, UpperEnd};
use crate::numeric::gauss_legendre;
use crate::spline::MAX_DEGREE;

/// x, z, x_u, z_u and y of the columns of the net on a line u = constant.
fn collapse(hull: &Hull, span: usize, basis: &[[f64; MAX_DEGREE + 1]; 2], columns: &mut [[f64; 5]]) {
    let p = hull.surface().u().degree();
    let count = columns.len();
    columns.fill([0.0; 5]);
    for (i, row) in (span - p..=span).enumerate() {
        for (column, point) in columns.iter_mut().zip(&hull.surface().points()[row * count..]) {
            column[0] += basis[0][i] * point[0];
            column[1] += basis[0][i] * point[2];
            column[2] += basis[1][i] * point[0];
            column[3] += basis[1][i] * point[2];
            column[4] += basis[0][i] * point[1];
        }
    }
}

/// [x, z, x_u, z_u, y] summed with the functions of `basis`.
fn sum(columns: &[[f64; 5]], basis: &[f64]) -> [f64; 5] {
    let mut total = [0.0; 5];
    for (column, b) in columns.iter().zip(basis) {
        for (t, c) in total.iter_mut().zip(column) {
            *t += b * c;
        }
    }
    total
}

/// Enumerates the weights of the volume or a moment of it: `sink(i, j, w)` adds w_k to the weight of the point (i, j +
/// k).
pub(super) fn volume_weights(hull: &Hull, draught: f64, moment: Moment, sink: &mut dyn FnMut(usize, usize, &[f64])) {
    let Some(immersion) = Immersion::new(hull, draught) else { return };
    let surface = hull.surface();
    let (p, q, count) = (surface.u().degree(), surface.v().degree(), surface.shape()[1]);
    let (spans, knots) = (surface.v().spans(), surface.v().knots());
    let mut columns = vec![[0.0; 5]; count];
    let (mut line, mut scaled) = (vec![0.0; count], vec![0.0; count]);
    for piece in immersion.pieces() {
        // Degrees 4p - 1 and 4q - 1 with an arm.
        for (u, weight) in piece.nodes(2 * p) {
            let basis = surface.u().basis_derivatives::<2>(piece.span, u);
            collapse(hull, piece.span, &basis, &mut columns);
            let end = immersion.end(u);
            line.fill(0.0);
            for &span in &spans {
                let (from, to) = (knots[span], knots[span + 1].min(end));
                if to <= from {
                    break;
                }
                let first = span - q;
                for (v, share) in gauss_legendre(2 * q).on(from, to) {
                    let [values, slopes] = surface.v().basis_derivatives::<2>(span, v);
                    let at = sum(&columns[first..=span], &values);
                    let up = sum(&columns[first..=span], &slopes);
                    let arm = match moment {
                        Moment::None => 1.0,
                        Moment::Length => at[0],
                        Moment::Height => at[1],
                    };
                    let factor = 2.0 * weight * share * (at[2] * up[1] - up[0] * at[3]) * arm;
                    for (target, b) in line[first..=span].iter_mut().zip(&values) {
                        *target += factor * b;
                    }
                }
            }
            for (i, b) in basis[0][..=p].iter().enumerate() {
                for (target, value) in scaled.iter_mut().zip(&line) {
                    *target = b * value;
                }
                sink(piece.span - p + i, 0, &scaled);
            }
        }
    }
}

/// dx/du along the waterline at (u, v), from the derivatives (x_u, z_u) and (x_v, z_v) there.
pub(crate) fn advance(hull: &Hull, along: [f64; 2], up: [f64; 2]) -> f64 {
    let lean = if hull.is_upright() { 0.0 } else { up[0] * along[1] };
    // Where z_v vanishes on an edge the waterline is that edge.
    if lean.abs() > 0.0 && up[1] > 0.0 { along[0] - lean / up[1] } else { along[0] }
}

/// Enumerates the weights of the waterplane area or of a moment of it.
pub(super) fn waterplane_weights(hull: &Hull, draught: f64, arm: Arm, sink: &mut dyn FnMut(usize, usize, &[f64])) {
    let Some(immersion) = Immersion::new(hull, draught) else { return };
    if immersion.above() {
        return;
    }
    let surface = hull.surface();
    let (p, q) = (surface.u().degree(), surface.v().degree());
    let mut columns = vec![[0.0; 5]; surface.shape()[1]];
    let mut scaled = [0.0; MAX_DEGREE + 1];
    for piece in immersion.pieces().iter().filter(|piece| piece.upper == UpperEnd::Waterline) {
        for (u, weight) in piece.nodes(2 * p) {
            let basis = surface.u().basis_derivatives::<2>(piece.span, u);
            collapse(hull, piece.span, &basis, &mut columns);
            let v = immersion.end(u);
            let span = surface.v().find_span(v);
            let [across, slopes] = surface.v().basis_derivatives::<2>(span, v);
            let at = sum(&columns[span - q..=span], &across);
            let up = sum(&columns[span - q..=span], &slopes);
            let arm = match arm {
                Arm::One => 1.0,
                Arm::Length => at[0],
                Arm::BreadthSquared => at[4] * at[4],
            };
            let factor = 2.0 * weight * arm * advance(hull, [at[2], at[3]], [up[0], up[1]]);
            for (i, b) in basis[0][..=p].iter().enumerate() {
                for (target, a) in scaled.iter_mut().zip(&across) {
                    *target = factor * b * a;
                }
                sink(piece.span - p + i, span - q, &scaled[..=q]);
            }
        }
    }
}

/// What a volume is multiplied by.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Moment {
    None,
    Length,
    Height,
}

/// What a waterplane area is multiplied by.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Arm {
    One,
    Length,
    /// The square of the half-breadth of the hull.
    BreadthSquared,
}
