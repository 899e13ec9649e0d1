//! The net of a hull over the bent chart of its field: the same half-breadths, with stern and stem as edges, and the
//! energy of the field within the hull.
//!
//! With u = u(w, v) the fourth derivatives of F(u, v) = f(w(u, v), v) are linear in the net of f. At every node of a Gauss
//! rule the inverse w(u, v) is taken as its Taylor polynomial of degree 4. The functions of the net are composed with it.
//! What is left is the rule's own error, which is zero where the chart is not bent.

use super::chart::Chart;
use super::density::Density;
use super::net::{Break, DEGREE, Metric, Net, ORDER};
use super::region::{Bend, Field};
use crate::numeric::{SymmetricBand, gauss_legendre};
use crate::spline::{BsplineSurface, Collocation, KnotVector, MAX_DEGREE, SplineError};

/// Nodes of the rule in each direction of a cell.
const NODES: usize = 4;

/// What a jump of a derivative of the field is charged, over its size in intervals of the table.
const JUMP: f64 = 1e4;

/// Coefficients of a polynomial of total degree 4 in two variables: t\[p\]\[q\] of du^p dv^q.
type Taylor = [[f64; ORDER + 1]; ORDER + 1];

fn product(a: &Taylor, b: &Taylor) -> Taylor {
    let mut out = [[0.0; ORDER + 1]; ORDER + 1];
    for p in 0..=ORDER {
        for q in 0..=ORDER - p {
            let value = a[p][q];
            if value.abs() > 0.0 {
                for r in 0..=ORDER - p - q {
                    for s in 0..=ORDER - p - q - r {
                        out[p + r][q + s] += value * b[r][s];
                    }
                }
            }
        }
    }
    out
}

/// A net over the bent chart.
#[derive(Debug, Clone)]
pub struct Bent {
    /// The chart of the field.
    pub chart: Chart,
    /// Its bend.
    pub bend: Bend,
    /// Knots along w and v.
    pub knots: [KnotVector; 2],
    /// Lines v = constant across which the chart has a corner.
    pub corners: Vec<f64>,
    /// Lines v = constant across which the field breaks.
    pub breaks: Vec<Break>,
    /// Whether the hull closes at the ends, for every control value along v.
    pub closed: [Vec<bool>; 2],
    /// Whether it closes along the keel.
    pub keel_closed: bool,
}

impl Bent {
    /// Numbers of control values along w and v.
    #[must_use]
    pub fn shape(&self) -> [usize; 2] {
        [self.knots[0].basis_count(), self.knots[1].basis_count()]
    }

    /// Control values of what `value` gives at (w, v), by interpolation at the Greville places.
    ///
    /// # Errors
    /// [`SplineError`] when the knots do not determine it.
    pub fn interpolated(&self, value: impl Fn(f64, f64) -> f64) -> Result<Vec<f64>, SplineError> {
        let sites = [self.knots[0].greville(), self.knots[1].greville()];
        let [rows, columns] = self.shape();
        let mut values: Vec<f64> =
            sites[0].iter().flat_map(|&w| sites[1].iter().map(move |&v| (w, v))).map(|(w, v)| value(w, v)).collect();
        let along = Collocation::new(&self.knots[0], &sites[0])?;
        let up = Collocation::new(&self.knots[1], &sites[1])?;
        for j in 0..columns {
            along.solve_strided(&mut values, j, columns);
        }
        for i in 0..rows {
            up.solve_strided(&mut values, i * columns, 1);
        }
        Ok(values)
    }

    /// x and z of the control points \[m\].
    ///
    /// # Errors
    /// [`SplineError`] when the knots do not determine them.
    pub fn places(&self) -> Result<Vec<[f64; 2]>, SplineError> {
        let x = self.interpolated(|w, v| self.chart.x(self.bend.u(w, v)))?;
        let sites = self.knots[1].greville();
        let mut z: Vec<f64> = sites.iter().map(|&v| self.chart.z(v)).collect();
        Collocation::new(&self.knots[1], &sites)?.solve(&mut z);
        Ok(x.into_iter().enumerate().map(|(k, x)| [x, z[k % z.len()]]).collect())
    }

    /// Half-breadths of the control points of a field \[m\].
    ///
    /// # Errors
    /// [`SplineError`] when the knots do not determine them.
    pub fn half_breadths(&self, field: &Field) -> Result<Vec<f64>, SplineError> {
        let mut values = self.interpolated(|w, v| self.of_field(field, w, v))?;
        (0..values.len()).filter(|&k| self.is_closed(k)).for_each(|k| values[k] = 0.0);
        Ok(values)
    }

    /// Half-breadth of a field at (w, v) \[m\].
    fn of_field(&self, field: &Field, w: f64, v: f64) -> f64 {
        field.at([self.bend.u(w, v).clamp(0.0, 1.0), v])
    }

    /// Middles of the spans along v where the net misses the field by more than `most` \[m\]. Where the chart bends far,
    /// sections of the field are no splines on the knots of its net.
    ///
    /// # Errors
    /// [`SplineError`] when the knots do not determine the net.
    pub fn unresolved(&self, field: &Field, most: f64) -> Result<Vec<f64>, SplineError> {
        let exact = |w: f64, v: f64| self.of_field(field, w, v);
        let values = self.interpolated(exact)?.into_iter().map(|y| [y]).collect();
        let surface = BsplineSurface::<1>::new(self.knots[0].clone(), self.knots[1].clone(), values)?;
        let [along, up] = [self.knots[0].breakpoints(), self.knots[1].breakpoints()];
        let misses = |span: &[f64]| {
            let at = |part: f64| span[0] + part * (span[1] - span[0]);
            [0.25, 0.5, 0.75].map(at).into_iter().any(|v| {
                let misses = |cell: &[f64]| {
                    let w = 0.5 * (cell[0] + cell[1]);
                    (surface.eval(w, v)[0] - exact(w, v)).abs() > most
                };
                along.windows(2).any(misses)
            })
        };
        Ok(up.windows(2).filter(|span| misses(span)).map(|span| 0.5 * (span[0] + span[1])).collect())
    }

    /// The same chart with more knots along v.
    ///
    /// # Errors
    /// [`SplineError`] when a knot is outside.
    pub fn refined(mut self, inserted: &[f64]) -> Result<Self, SplineError> {
        for end in &mut self.bend.ends {
            *end = end.insert_knots(inserted)?;
        }
        self.knots[1] = self.bend.ends[0].knots().clone();
        Ok(self)
    }

    /// Whether a control value is on the centreplane.
    #[must_use]
    pub fn is_closed(&self, k: usize) -> bool {
        let [rows, columns] = self.shape();
        let (i, j) = (k / columns, k % columns);
        i == 0 && self.closed[0][j] || i + 1 == rows && self.closed[1][j] || j == 0 && self.keel_closed
    }

    /// The Taylor polynomial of w(u, v) - w0 at (w0, v0), with the polynomials of a span of v.
    fn inverse(&self, w: f64, v: f64, span: usize) -> Taylor {
        let Bend { ends, fades } = &self.bend;
        let knots = ends[0].knots();
        let (derivatives, degree) = (taylor(knots, span, v), knots.degree());
        let mut shifts = [[0.0; ORDER + 1]; 2];
        for order in 0..=ORDER {
            for side in 0..2 {
                let control = &ends[side].points()[span - degree..];
                let sum: f64 = derivatives[order][..=degree].iter().zip(control).map(|(b, [c])| b * c).sum();
                shifts[side][order] = sum;
            }
        }
        shifts[1][0] -= 1.0;
        // u(w + dw, v + dv) - u(w, v), of dw^p dv^q.
        let mut forward: Taylor = [[0.0; ORDER + 1]; ORDER + 1];
        forward[1][0] = 1.0;
        for side in 0..2 {
            let fade = fades[side].derivatives::<{ ORDER + 1 }>(w);
            for (p, [fade]) in fade.iter().enumerate() {
                let fade = fade / factorial(p);
                for q in 0..=ORDER - p {
                    forward[p][q] += shifts[side][q] * fade;
                }
            }
        }
        forward[0][0] = 0.0;
        let slope = forward[1][0];
        // Fixed point of dw = (du - rest(dw, dv)) / slope, exact to degree n after n rounds.
        let mut inverse: Taylor = [[0.0; ORDER + 1]; ORDER + 1];
        inverse[1][0] = 1.0 / slope;
        for _ in 0..ORDER {
            let mut next: Taylor = [[0.0; ORDER + 1]; ORDER + 1];
            next[1][0] = 1.0;
            let mut power: Taylor = [[0.0; ORDER + 1]; ORDER + 1];
            power[0][0] = 1.0;
            for p in 0..=ORDER {
                for q in 0..=ORDER - p {
                    if (p, q) == (1, 0) || (p, q) == (0, 0) {
                        continue;
                    }
                    let factor = forward[p][q];
                    if factor.abs() > 0.0 {
                        for r in 0..=ORDER - q {
                            for s in 0..=ORDER - q - r {
                                next[r][s + q] -= factor * power[r][s];
                            }
                        }
                    }
                }
                power = product(&power, &inverse);
            }
            inverse = next.map(|row| row.map(|value| value / slope));
        }
        inverse
    }

    /// The energy of the field within the hull, in the net of the hull; `net` is that of the field, for its counts.
    #[must_use]
    pub fn energy(&self, net: &Net, metric: Metric, density: Option<&Density>) -> SymmetricBand {
        let mut matrix = self.jumps(net);
        let columns = self.shape()[1];
        let rule = gauss_legendre(NODES);
        let factors = net.factors(metric);
        let breaks = [self.knots[0].breakpoints(), self.knots[1].breakpoints()];
        for across in breaks[1].windows(2) {
            for along in breaks[0].windows(2) {
                let size = (DEGREE + 1) * (DEGREE + 1);
                let mut block = vec![0.0; size * size];
                let mut first = [0, 0];
                for (v, share) in rule.on(across[0], across[1]) {
                    let span = self.knots[1].find_span(v);
                    let (j, up) = (span - DEGREE, taylor(&self.knots[1], span, v));
                    for (w, weight) in rule.on(along[0], along[1]) {
                        let ahead = self.knots[0].find_span(w);
                        let (i, ahead) = (ahead - DEGREE, taylor(&self.knots[0], ahead, w));
                        first = [i, j];
                        let inverse = self.inverse(w, v, span);
                        // du dv = u_w dw dv.
                        let rho = density.map_or(1.0, |density| density.at([self.bend.u(w, v), v]));
                        let measure = rho * share * weight / inverse[1][0];
                        let mut forms = vec![[0.0; ORDER + 1]; size];
                        for (r, composed) in composed(&inverse, &ahead).iter().enumerate() {
                            for s in 0..=DEGREE {
                                let form = &mut forms[r * (DEGREE + 1) + s];
                                for (k, target) in form.iter_mut().enumerate() {
                                    *target = derivative(composed, &up, s, [ORDER - k, k]);
                                }
                            }
                        }
                        for a in 0..size {
                            let scaled: [f64; ORDER + 1] = std::array::from_fn(|k| measure * factors[k] * forms[a][k]);
                            for b in 0..=a {
                                let sum: f64 = (0..=ORDER).map(|k| scaled[k] * forms[b][k]).sum();
                                block[a * size + b] += sum;
                            }
                        }
                    }
                }
                let place = |a: usize| (first[0] + a / (DEGREE + 1)) * columns + first[1] + a % (DEGREE + 1);
                for a in 0..size {
                    for b in 0..=a {
                        matrix.add(place(a), place(b), block[a * size + b]);
                    }
                }
            }
        }
        matrix
    }

    /// What the jumps of derivatives of the field are charged: across the corners of the chart, where those of the net
    /// jump, and across its breaks; `net` is that of the field, for its counts.
    #[must_use]
    pub fn jumps(&self, net: &Net) -> SymmetricBand {
        let [rows, columns] = self.shape();
        // Across a corner two spans of v meet that share one function.
        let reach = if self.corners.is_empty() && self.breaks.is_empty() { DEGREE } else { 2 * DEGREE };
        let width = DEGREE.min(rows - 1) * columns + reach.min(columns - 1);
        let mut matrix = SymmetricBand::zeros(rows * columns, width);
        let [n, m] = net.intervals;
        let rule = gauss_legendre(NODES);
        let breaks = self.knots[0].breakpoints();
        let corner = |&at: &f64| Break { at, order: 1, charge: JUMP };
        for line in self.corners.iter().map(corner).chain(self.breaks.iter().copied()) {
            let v = line.at;
            let above = self.knots[1].find_span(v);
            let below = above - line.multiplicity();
            let sides = [below, above].map(|span| (span, taylor(&self.knots[1], span, v)));
            for along in breaks.windows(2) {
                for (w, weight) in rule.on(along[0], along[1]) {
                    let ahead = self.knots[0].find_span(w);
                    let (i, ahead) = (ahead - DEGREE, taylor(&self.knots[0], ahead, w));
                    for k in line.order..ORDER {
                        let mut row: Vec<(usize, f64)> = Vec::new();
                        let mut measure = 0.0;
                        for (side, (span, up)) in sides.iter().enumerate() {
                            let inverse = self.inverse(w, v, *span);
                            measure = weight / inverse[1][0];
                            let sign = if side == 0 { -1.0 } else { 1.0 };
                            for (r, composed) in composed(&inverse, &ahead).iter().enumerate() {
                                for s in 0..=DEGREE {
                                    let at = (i + r) * columns + span - DEGREE + s;
                                    row.push((at, sign * derivative(composed, up, s, [0, k]) / m.powi(k as i32)));
                                }
                            }
                        }
                        let factor = line.charge * measure * n;
                        for (a, &(i, x)) in row.iter().enumerate() {
                            for (b, &(j, y)) in row.iter().enumerate() {
                                if j < i || i == j && (a == b) {
                                    matrix.add(i, j, factor * x * y);
                                } else if i == j && b < a {
                                    matrix.add(i, j, 2.0 * factor * x * y);
                                }
                            }
                        }
                    }
                }
            }
        }
        matrix
    }
}

/// Taylor coefficients of the functions of a span at t.
fn taylor(knots: &KnotVector, span: usize, t: f64) -> [[f64; MAX_DEGREE + 1]; ORDER + 1] {
    let mut orders = knots.basis_derivatives::<{ ORDER + 1 }>(span, t);
    for (order, row) in orders.iter_mut().enumerate() {
        row.iter_mut().for_each(|value| *value /= factorial(order));
    }
    orders
}

fn factorial(k: usize) -> f64 {
    (1..=k).product::<usize>() as f64
}

/// The functions along w, with the Taylor coefficients `ahead`, as polynomials of (u, v).
fn composed(inverse: &Taylor, ahead: &[[f64; MAX_DEGREE + 1]; ORDER + 1]) -> [Taylor; DEGREE + 1] {
    let mut functions = [[[0.0; ORDER + 1]; ORDER + 1]; DEGREE + 1];
    let mut power: Taylor = [[0.0; ORDER + 1]; ORDER + 1];
    power[0][0] = 1.0;
    for row in ahead {
        for (function, b) in functions.iter_mut().zip(row) {
            for (target, source) in function.iter_mut().zip(&power) {
                target.iter_mut().zip(source).for_each(|(t, s)| *t += b * s);
            }
        }
        power = product(&power, inverse);
    }
    functions
}

/// The derivative of order (p, q) of a composed function times function s along v, with the Taylor coefficients `up`.
fn derivative(composed: &Taylor, up: &[[f64; MAX_DEGREE + 1]; ORDER + 1], s: usize, [p, q]: [usize; 2]) -> f64 {
    let sum: f64 = (0..=q).map(|t| composed[p][t] * up[q - t][s]).sum();
    sum * factorial(p) * factorial(q)
}
