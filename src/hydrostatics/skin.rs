//! The wetted surface of one draught and its gradient over the net of half-breadths.
//!
//! On a fixed chart the parameters of the wetted part do not change with the half-breadths. With n = S_u x S_v,
//!
//! ```text
//! S = 2 int int |n| dv du + 2 int y ds on the keel line + 2 int y ds on the stern and stem profiles
//! dS/dy_k = 2 int int ((n_x z_v - n_z x_v) dN_k/du + (n_z x_u - n_x z_u) dN_k/dv) / |n| dv du + 2 int N_k ds on these lines,
//! ```
//!
//! n_x = y_u z_v - z_u y_v, n_z = x_u y_v - y_u x_v; ds is the length in the profile. Gauss rules as for the surface
//! itself.

use super::conventions::Conventions;
use super::table::CurvesOfForm;
use super::volume::{count_along, count_up};
use crate::hull::{Hull, Immersion};
use crate::numeric::gauss_legendre;

/// Wetted surface S \[m^2\] below `draught` \[m\]: side, flat of bottom, immersed transom and flat bow; 0 where nothing
/// is immersed.
#[must_use]
pub fn wetted_surface(hull: &Hull, draught: f64) -> f64 {
    let curves = CurvesOfForm::new(hull, &[draught], &Conventions::default());
    curves.rows.first().map_or(0.0, |row| row.wetted_surface)
}

/// x, y, z and their derivatives in u of the columns of the net on a line u = constant.
fn collapse(hull: &Hull, span: usize, u: f64) -> Vec<[f64; 6]> {
    let knots = hull.surface().u();
    let [value, slope] = knots.basis_derivatives::<2>(span, u);
    let count = hull.surface().shape()[1];
    let mut columns = vec![[0.0; 6]; count];
    for (i, row) in (span - knots.degree()..=span).enumerate() {
        for (column, point) in columns.iter_mut().zip(&hull.surface().points()[row * count..]) {
            for axis in 0..3 {
                column[axis] += value[i] * point[axis];
                column[axis + 3] += slope[i] * point[axis];
            }
        }
    }
    columns
}

/// dS/dy \[m\] over the net, `u` slowest, of the wetted surface below `draught` \[m\].
#[must_use]
pub fn wetted_surface_gradient(hull: &Hull, draught: f64) -> Vec<f64> {
    let surface = hull.surface();
    let [rows, columns] = surface.shape();
    let mut gradient = vec![0.0; rows * columns];
    let Some(immersion) = Immersion::new(hull, draught) else { return gradient };
    let (p, q) = (surface.u().degree(), surface.v().degree());
    let knots = surface.v().knots();
    let (spans, count) = (surface.v().spans(), count_up(hull));
    for piece in immersion.pieces() {
        for (u, weight) in piece.nodes(count_along(hull).max(2 * p)) {
            let [along, rise] = surface.u().basis_derivatives::<2>(piece.span, u);
            let line = collapse(hull, piece.span, u);
            let end = immersion.end(u);
            // Weights of N and of dN/du along v on this line.
            let (mut of_value, mut of_slope) = (vec![0.0; columns], vec![0.0; columns]);
            for &span in spans.iter().take_while(|&&span| knots[span] < end) {
                let first = span - q;
                for (v, share) in gauss_legendre(count).on(knots[span], knots[span + 1].min(end)) {
                    let [value, slope] = surface.v().basis_derivatives::<2>(span, v);
                    let sum = |basis: &[f64], axis: usize| -> f64 {
                        basis.iter().zip(&line[first..=span]).map(|(b, c)| b * c[axis]).sum()
                    };
                    let [xu, yu, zu] = [3, 4, 5].map(|axis| sum(&value, axis));
                    let [xv, yv, zv] = [0, 1, 2].map(|axis| sum(&slope, axis));
                    let (nx, ny, nz) = (yu * zv - zu * yv, zu * xv - xu * zv, xu * yv - yu * xv);
                    let size = (nx * nx + ny * ny + nz * nz).sqrt();
                    if size <= 0.0 {
                        continue;
                    }
                    let factor = 2.0 * weight * share / size;
                    for k in 0..=q {
                        of_slope[first + k] += factor * (nx * zv - nz * xv) * value[k];
                        of_value[first + k] += factor * (nz * xu - nx * zu) * slope[k];
                    }
                }
            }
            // The flat of bottom, ruled across the keel line.
            of_value[0] += 2.0 * weight * line[0][3].hypot(line[0][5]);
            for i in 0..=p {
                let target = &mut gradient[(piece.span - p + i) * columns..][..columns];
                for ((target, value), slope) in target.iter_mut().zip(&of_value).zip(&of_slope) {
                    *target += along[i] * value + rise[i] * slope;
                }
            }
        }
    }
    let (aft, fore) = surface.u().domain();
    for (u, row) in [(aft, 0), (fore, rows - 1)] {
        let end = immersion.end(u);
        for &span in spans.iter().take_while(|&&span| knots[span] < end) {
            for (v, share) in gauss_legendre(count).on(knots[span], knots[span + 1].min(end)) {
                let [value, _] = surface.v().basis_derivatives::<2>(span, v);
                let dv = surface.tangents(u, v).dv;
                let length = 2.0 * share * dv[0].hypot(dv[2]);
                for (k, basis) in value[..=q].iter().enumerate() {
                    gradient[row * columns + span - q + k] += length * basis;
                }
            }
        }
    }
    gradient
}
