//! The signed distance of the surface from a plane, a scalar tensor-product spline in Bernstein form, and the Bezier
//! patches of the surface.

use super::bernstein::{ORDER, blossom, bracketed, value_and_slope};
use crate::spline::{BsplineSurface, KnotVector};

/// The spans of a knot vector and the operators that take control values to Bernstein coefficients.
pub(super) struct Spans {
    pub degree: usize,
    pub breaks: Vec<[f64; 2]>,
    first: Vec<usize>,
    operators: Vec<[[f64; ORDER]; ORDER]>,
}

impl Spans {
    pub(super) fn new(knots: &KnotVector) -> Self {
        let degree = knots.degree();
        let (mut breaks, mut first, mut operators) = (Vec::new(), Vec::new(), Vec::new());
        for span in knots.spans() {
            let (a, b) = (knots.knots()[span], knots.knots()[span + 1]);
            let mut operator = [[0.0; ORDER]; ORDER];
            for (k, row) in operator.iter_mut().enumerate().take(degree + 1) {
                *row = blossom(knots, span, |level| if level < k { b } else { a });
            }
            breaks.push([a, b]);
            first.push(span - degree);
            operators.push(operator);
        }
        Self { degree, breaks, first, operators }
    }

    pub(super) fn count(&self) -> usize {
        self.breaks.len()
    }

    /// Span and row of its operator of a Bernstein coefficient of the whole spline; joints belong to the span before
    /// them.
    fn place(&self, index: usize) -> (usize, usize) {
        let span = (index.saturating_sub(1)) / self.degree;
        (span, index - span * self.degree)
    }
}

/// f(u, v) = n . S(u, v) - d over the whole surface; n is of unit length, so that f is a distance \[m\]. Coefficients
/// on the edge of two patches are one number.
pub(super) struct Field {
    pub u: Spans,
    pub v: Spans,
    pub normal: [f64; 3],
    columns: usize,
    values: Vec<f64>,
}

impl Field {
    /// Distances below `1e-13` of the size of the hull are taken as 0.
    pub(super) fn new(surface: &BsplineSurface<3>, normal: [f64; 3], offset: f64) -> Self {
        let (u, v) = (Spans::new(surface.u()), Spans::new(surface.v()));
        let [rows, columns] = surface.shape();
        let mut size = offset.abs();
        let net: Vec<f64> = surface
            .points()
            .iter()
            .map(|p| {
                size = size.max(p[0].abs()).max(p[1].abs()).max(p[2].abs());
                normal[0] * p[0] + normal[1] * p[1] + normal[2] * p[2] - offset
            })
            .collect();
        let wide = v.count() * v.degree + 1;
        let mut across = vec![0.0; rows * wide];
        for index in 0..wide {
            let (span, k) = v.place(index);
            let (weights, first) = (&v.operators[span][k][..=v.degree], v.first[span]);
            for row in 0..rows {
                let from = row * columns + first;
                across[row * wide + index] = weights.iter().zip(&net[from..=from + v.degree]).map(|(w, c)| w * c).sum();
            }
        }
        let tall = u.count() * u.degree + 1;
        let mut values = vec![0.0; tall * wide];
        let small = 1e-13 * size;
        for index in 0..tall {
            let (span, k) = u.place(index);
            let target = &mut values[index * wide..(index + 1) * wide];
            for (i, weight) in u.operators[span][k].iter().enumerate().take(u.degree + 1) {
                let source = &across[(u.first[span] + i) * wide..(u.first[span] + i + 1) * wide];
                for (sum, value) in target.iter_mut().zip(source) {
                    *sum += weight * value;
                }
            }
            for value in target.iter_mut() {
                if value.abs() <= small {
                    *value = 0.0;
                }
            }
        }
        Self { u, v, normal, columns: wide, values }
    }

    /// The coefficients of f on a patch; none when they have one sign, that is when no contour passes.
    pub(super) fn coefficients(&self, i: usize, j: usize) -> Option<[[f64; ORDER]; ORDER]> {
        let (p, q) = (self.u.degree, self.v.degree);
        let row = |k: usize| {
            let from = (i * p + k) * self.columns + j * q;
            &self.values[from..=from + q]
        };
        let negative = (0..=p).map(|k| row(k).iter().filter(|&&c| c < 0.0).count()).sum::<usize>();
        if negative == 0 || negative == (p + 1) * (q + 1) {
            return None;
        }
        let mut c = [[0.0; ORDER]; ORDER];
        for (k, target) in c.iter_mut().enumerate().take(p + 1) {
            target[..=q].copy_from_slice(row(k));
        }
        Some(c)
    }

    /// The Bezier patch of the surface with its coefficients of f.
    pub(super) fn patch(
        &self,
        surface: &BsplineSurface<3>,
        i: usize,
        j: usize,
        distance: [[f64; ORDER]; ORDER],
    ) -> Patch {
        let (p, q) = (self.u.degree, self.v.degree);
        let (across, along) = (&self.v.operators[j], &self.u.operators[i]);
        let mut points = [[[0.0; 3]; ORDER]; ORDER];
        for row in 0..=p {
            for k in 0..=q {
                let mut sum = [0.0; 3];
                for (column, weight) in across[k].iter().enumerate().take(q + 1) {
                    let point = surface.point(self.u.first[i] + row, self.v.first[j] + column);
                    add(&mut sum, *weight, &point);
                }
                for (l, operator) in along.iter().enumerate().take(p + 1) {
                    add(&mut points[l][k], operator[row], &sum);
                }
            }
        }
        Patch { p, q, normal: self.normal, points, distance, size: [width(self.u.breaks[i]), width(self.v.breaks[j])] }
    }
}

/// sum + weight * point, in place.
#[inline]
fn add(sum: &mut [f64; 3], weight: f64, point: &[f64; 3]) {
    for (s, c) in sum.iter_mut().zip(point) {
        *s += weight * c;
    }
}

fn width(ends: [f64; 2]) -> f64 {
    ends[1] - ends[0]
}

/// One Bezier patch of the surface over [0, 1]^2 with f.
pub(super) struct Patch {
    p: usize,
    q: usize,
    normal: [f64; 3],
    points: [[[f64; 3]; ORDER]; ORDER],
    distance: [[f64; ORDER]; ORDER],
    /// Lengths of the spans in u and in v.
    pub size: [f64; 2],
}

/// A point of the surface on a patch with first and second derivatives, and the first and second derivatives of f.
#[derive(Clone, Copy)]
pub(super) struct Node {
    pub st: [f64; 2],
    pub point: [f64; 3],
    pub first: [[f64; 3]; 2],
    /// S_ss, S_st, S_tt
    pub second: [[f64; 3]; 3],
    pub slope: [f64; 2],
    /// f_ss, f_st, f_tt
    pub bend: [f64; 3],
}

impl Patch {
    pub(super) fn point(&self, st: [f64; 2]) -> [f64; 3] {
        let (a, b) = (basis(self.p, st[0]), basis(self.q, st[1]));
        let mut sum = [0.0; 3];
        for (i, wa) in a.iter().enumerate().take(self.p + 1) {
            let mut row = [0.0; 3];
            for (j, wb) in b.iter().enumerate().take(self.q + 1) {
                add(&mut row, *wb, &self.points[i][j]);
            }
            add(&mut sum, *wa, &row);
        }
        sum
    }

    pub(super) fn node(&self, st: [f64; 2]) -> Node {
        let (a, b) = (basis_derivatives(self.p, st[0]), basis_derivatives(self.q, st[1]));
        let mut result = [[[0.0; 3]; 3]; 3];
        for (i, line) in self.points.iter().enumerate().take(self.p + 1) {
            let mut rows = [[0.0; 3]; 3];
            for (j, point) in line.iter().enumerate().take(self.q + 1) {
                for (row, order) in rows.iter_mut().zip(&b) {
                    add(row, order[j], point);
                }
            }
            for (k, (sums, order)) in result.iter_mut().zip(&a).enumerate() {
                for (sum, row) in sums.iter_mut().zip(&rows).take(3 - k) {
                    add(sum, order[i], row);
                }
            }
        }
        let n = self.normal;
        let along = |s: [f64; 3]| n[0] * s[0] + n[1] * s[1] + n[2] * s[2];
        let (first, second) = ([result[1][0], result[0][1]], [result[2][0], result[1][1], result[0][2]]);
        Node {
            st,
            point: result[0][0],
            first,
            second,
            slope: [along(first[0]), along(first[1])],
            bend: [along(second[0]), along(second[1]), along(second[2])],
        }
    }

    /// f at a point of the patch.
    pub(super) fn distance(&self, st: [f64; 2]) -> f64 {
        value_and_slope(&self.line(1, st[1])[..=self.p], st[0]).0
    }

    /// Coefficients of f along the line on which coordinate `fixed` (0: s, 1: t) has the value `at`.
    fn line(&self, fixed: usize, at: f64) -> [f64; ORDER] {
        let mut line = [0.0; ORDER];
        if fixed == 1 {
            let weights = basis(self.q, at);
            for (sum, row) in line.iter_mut().zip(&self.distance).take(self.p + 1) {
                *sum = row.iter().zip(&weights).take(self.q + 1).map(|(c, w)| c * w).sum();
            }
        } else {
            let weights = basis(self.p, at);
            for (row, w) in self.distance.iter().zip(&weights).take(self.p + 1) {
                for (sum, c) in line.iter_mut().zip(row).take(self.q + 1) {
                    *sum += c * w;
                }
            }
        }
        line
    }

    /// The point on the line where coordinate `fixed` has the value `at` and f = 0, the other one between `ends`.
    pub(super) fn solve(&self, fixed: usize, at: f64, ends: [f64; 2], guess: f64) -> [f64; 2] {
        let line = self.line(fixed, at);
        let degree = if fixed == 1 { self.p } else { self.q };
        let other = bracketed(&line[..=degree], ends[0], ends[1], guess);
        if fixed == 1 { [other, at] } else { [at, other] }
    }
}

/// Bernstein polynomials of degree `p` at `t`.
fn basis(p: usize, t: f64) -> [f64; ORDER] {
    let mut values = [0.0; ORDER];
    values[0] = 1.0;
    for degree in 1..=p {
        raise(&mut values, degree, t);
    }
    values
}

fn raise(values: &mut [f64; ORDER], degree: usize, t: f64) {
    let mut saved = 0.0;
    for value in values.iter_mut().take(degree) {
        let old = *value;
        *value = saved + (1.0 - t) * old;
        saved = t * old;
    }
    values[degree] = saved;
}

/// Bernstein polynomials of degree `p` at `t` with first and second derivatives.
fn basis_derivatives(p: usize, t: f64) -> [[f64; ORDER]; 3] {
    let mut values = [0.0; ORDER];
    values[0] = 1.0;
    let mut result = [[0.0; ORDER]; 3];
    for degree in 0..=p {
        if degree > 0 {
            raise(&mut values, degree, t);
        }
        if degree + 2 == p {
            let factor = (p * (p - 1)) as f64;
            for i in 0..=degree {
                let value = factor * values[i];
                result[2][i] += value;
                result[2][i + 1] -= 2.0 * value;
                result[2][i + 2] += value;
            }
        }
        if degree + 1 == p {
            for i in 0..=degree {
                let value = p as f64 * values[i];
                result[1][i] -= value;
                result[1][i + 1] += value;
            }
        }
    }
    result[0] = values;
    result
}
