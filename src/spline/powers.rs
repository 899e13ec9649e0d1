//! Bicubic surfaces as polynomials, span by span: S = sum a_mn (u - u_k)^m (v - v_l)^n, m, n = 0 to 3.
//!
//! A point and its derivatives are then Horner's scheme in u and in v, without basis functions, at 16 coefficients a
//! span instead of one control point. The ends of the domain are spans of their own, so that corners stay control points
//! exactly; elsewhere the rounding error is a few 1e-16 of the size of the net, as with the basis functions.

use super::jet::{SurfaceJet, add};
use super::knots::KnotVector;
use std::sync::{Arc, OnceLock};

/// Knots and net of a surface, `u` slowest.
#[derive(Clone, Copy)]
pub(super) struct Parts<'s, const D: usize> {
    pub(super) u: &'s KnotVector,
    pub(super) v: &'s KnotVector,
    pub(super) points: &'s [[f64; D]],
}

/// `[m][n]` belongs to (u - u_k)^m (v - v_l)^n.
type Patch<const D: usize> = [[[f64; D]; 4]; 4];

/// The polynomials of a bicubic surface, made when they are first asked for. They follow from knots and net: all are
/// equal, and copies share them.
#[derive(Clone, Default)]
pub(super) struct Powers<const D: usize>(OnceLock<Arc<Vec<Patch<D>>>>);

impl<const D: usize> PartialEq for Powers<D> {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl<const D: usize> std::fmt::Debug for Powers<D> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("Powers")
    }
}

impl<const D: usize> Powers<D> {
    /// The point at (u, v) of the bicubic surface to which these polynomials belong.
    #[inline(never)]
    pub(super) fn point(&self, net: Parts<'_, D>, u: f64, v: f64) -> [f64; D] {
        let patches = self.0.get_or_init(|| patches(net)).as_slice();
        let ((k, x), (l, y)) = (net.u.cubic_at(u), net.v.cubic_at(v));
        let [a0, a1, a2, a3] = &patches[k * net.v.cubics().len() + l];
        let mut point = [0.0; D];
        for (d, value) in point.iter_mut().enumerate() {
            let across = |n: usize| ((a3[n][d] * x + a2[n][d]) * x + a1[n][d]) * x + a0[n][d];
            *value = ((across(3) * y + across(2)) * y + across(1)) * y + across(0);
        }
        point
    }

    /// Point, first and second derivatives of the bicubic surface to which these polynomials belong.
    #[inline(never)]
    pub(super) fn jet(&self, net: Parts<'_, D>, u: f64, v: f64) -> SurfaceJet<D> {
        let patches = self.0.get_or_init(|| patches(net)).as_slice();
        let ((k, x), (l, y)) = (net.u.cubic_at(u), net.v.cubic_at(v));
        let [a0, a1, a2, a3] = &patches[k * net.v.cubics().len() + l];
        let (mut value, mut slope, mut bend) = ([[0.0; D]; 4], [[0.0; D]; 4], [[0.0; D]; 4]);
        for n in 0..4 {
            for d in 0..D {
                [value[n][d], slope[n][d], bend[n][d]] = horner([a0[n][d], a1[n][d], a2[n][d], a3[n][d]], x);
            }
        }
        let zero = [0.0; D];
        let mut jet = SurfaceJet { point: zero, du: zero, dv: zero, duu: zero, duv: zero, dvv: zero };
        for d in 0..D {
            [jet.point[d], jet.dv[d], jet.dvv[d]] = horner(value.map(|p| p[d]), y);
            [jet.du[d], jet.duv[d], _] = horner(slope.map(|p| p[d]), y);
            [jet.duu[d], _, _] = horner(bend.map(|p| p[d]), y);
        }
        jet
    }
}

/// Value, first and second derivative of c0 + c1 x + c2 x^2 + c3 x^3.
#[inline(always)]
fn horner([c0, c1, c2, c3]: [f64; 4], x: f64) -> [f64; 3] {
    let cx = c3 * x;
    let b2 = cx + c2;
    let b1 = b2 * x + c1;
    let e2 = cx + b2;
    let bend = cx + e2;
    [b1 * x + c0, e2 * x + b1, bend + bend]
}

/// The coefficients of all pairs of spans, those in u slowest.
#[cold]
fn patches<const D: usize>(net: Parts<'_, D>) -> Arc<Vec<Patch<D>>> {
    let (rows, columns) = (net.u.cubics(), net.v.cubics());
    let mut all = Vec::with_capacity(rows.len() * columns.len());
    for row in rows {
        // The net in powers of u.
        let mut line = vec![[[0.0; D]; 4]; net.v.basis_count()];
        for (j, sums) in line.iter_mut().enumerate() {
            for i in 0..4 {
                let point = net.points[(row.first + i) * net.v.basis_count() + j];
                for (sum, weights) in sums.iter_mut().zip(&row.powers) {
                    add(sum, weights[i], &point);
                }
            }
        }
        for column in columns {
            let mut patch = [[[0.0; D]; 4]; 4];
            for (j, sums) in line[column.first..][..4].iter().enumerate() {
                for (terms, sum) in patch.iter_mut().zip(sums) {
                    for (term, weights) in terms.iter_mut().zip(&column.powers) {
                        add(term, weights[j], sum);
                    }
                }
            }
            all.push(patch);
        }
    }
    Arc::new(all)
}
