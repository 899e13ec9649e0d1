//! Bezier pieces of curves and surfaces: the polynomials between the knots, in Bernstein form.

use super::basis::MAX_DEGREE;
use super::curve::BsplineCurve;
use super::knots::KnotVector;
use super::refine::{apply, missing_for_bezier, refinement_rows};
use super::surface::BsplineSurface;

/// The polynomial of one span of a curve: sum_i P_i B_i^p(s), s = (t - from) / (to - from).
#[derive(Debug, Clone, PartialEq)]
pub struct BezierCurve<const D: usize> {
    /// Start of the span.
    pub from: f64,
    /// End of the span.
    pub to: f64,
    /// The `degree + 1` control points.
    pub points: Vec<[f64; D]>,
}

/// The polynomial of one pair of spans of a surface: sum_ij P_ij B_i^p(r) B_j^q(s).
#[derive(Debug, Clone, PartialEq)]
pub struct BezierPatch<const D: usize> {
    /// Start and end of the span in u.
    pub u: [f64; 2],
    /// Start and end of the span in v.
    pub v: [f64; 2],
    /// Degrees in u and in v.
    pub degrees: [usize; 2],
    /// The control points, `u` slowest.
    pub points: Vec<[f64; D]>,
}

/// Values of the Bernstein polynomials B_0^p .. B_p^p at `s` in [0, 1].
fn bernstein(degree: usize, s: f64) -> [f64; MAX_DEGREE + 1] {
    let mut values = [0.0; MAX_DEGREE + 1];
    values[0] = 1.0;
    for j in 1..=degree {
        let mut saved = 0.0;
        for value in values.iter_mut().take(j) {
            let term = *value;
            *value = saved + (1.0 - s) * term;
            saved = s * term;
        }
        values[j] = saved;
    }
    values
}

impl<const D: usize> BezierCurve<D> {
    /// The point at parameter `t` of the whole curve; outside the span, the polynomial continued.
    #[must_use]
    pub fn eval(&self, t: f64) -> [f64; D] {
        let weights = bernstein(self.points.len() - 1, (t - self.from) / (self.to - self.from));
        let mut sum = [0.0; D];
        for (weight, point) in weights.iter().zip(&self.points) {
            for d in 0..D {
                sum[d] += weight * point[d];
            }
        }
        sum
    }
}

impl<const D: usize> BezierPatch<D> {
    /// The point at parameters (u, v) of the whole surface; outside the spans, the polynomial continued.
    #[must_use]
    pub fn eval(&self, u: f64, v: f64) -> [f64; D] {
        let [p, q] = self.degrees;
        let in_u = bernstein(p, (u - self.u[0]) / (self.u[1] - self.u[0]));
        let in_v = bernstein(q, (v - self.v[0]) / (self.v[1] - self.v[0]));
        let mut sum = [0.0; D];
        for (i, line) in self.points.chunks_exact(q + 1).enumerate() {
            for (j, point) in line.iter().enumerate() {
                for d in 0..D {
                    sum[d] += in_u[i] * in_v[j] * point[d];
                }
            }
        }
        sum
    }
}

/// Items over knots that are `degree` fold inside.
fn decompose<const D: usize>(knots: &KnotVector, points: &[[f64; D]], width: usize) -> Vec<[f64; D]> {
    let mut all = knots.knots().to_vec();
    all.extend(missing_for_bezier(knots));
    all.sort_by(f64::total_cmp);
    let rows = refinement_rows(knots.degree(), knots.knots(), &all);
    apply(rows.iter().map(|row| (row.first, &row.weights[..=knots.degree()])), points, width)
}

impl<const D: usize> BsplineCurve<D> {
    /// The polynomial pieces in order, one a span of positive length.
    #[must_use]
    #[doc(hidden)]
    pub fn bezier_pieces(&self) -> Vec<BezierCurve<D>> {
        let p = self.knots().degree();
        let points = decompose(self.knots(), self.points(), 1);
        let breaks = self.knots().breakpoints();
        let piece = |(k, ends): (usize, &[f64])| BezierCurve {
            from: ends[0],
            to: ends[1],
            points: points[k * p..=(k + 1) * p].to_vec(),
        };
        breaks.windows(2).enumerate().map(piece).collect()
    }
}

impl<const D: usize> BsplineSurface<D> {
    /// The polynomial patches, one a pair of spans of positive length, `u` slowest.
    #[must_use]
    #[doc(hidden)]
    pub fn bezier_patches(&self) -> Vec<BezierPatch<D>> {
        let (p, q) = (self.u().degree(), self.v().degree());
        let (in_u, in_v) = (self.u().breakpoints(), self.v().breakpoints());
        let rows = (in_u.len() - 1) * p + 1;
        let along = decompose(self.u(), self.points(), self.v().basis_count());
        let columns = self.v().basis_count();
        let turned: Vec<[f64; D]> =
            (0..columns).flat_map(|j| (0..rows).map(move |i| i * columns + j)).map(|k| along[k]).collect();
        // Net of the pieces, `v` slowest.
        let net = decompose(self.v(), &turned, rows);
        let mut patches = Vec::with_capacity((in_u.len() - 1) * (in_v.len() - 1));
        for (a, u) in in_u.windows(2).enumerate() {
            for (b, v) in in_v.windows(2).enumerate() {
                let points = (0..=p)
                    .flat_map(|i| (0..=q).map(move |j| (b * q + j) * rows + a * p + i))
                    .map(|k| net[k])
                    .collect();
                patches.push(BezierPatch { u: [u[0], u[1]], v: [v[0], v[1]], degrees: [p, q], points });
            }
        }
        patches
    }
}
