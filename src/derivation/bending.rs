//! The bending energy of a change of half-breadths, as a quadratic form over the net.
//!
//! With s the way along a line of the net from stern to stem over L, and g the way up a line of it over the girth of half the
//! midship section, both measured on the control points in space,
//!
//! ```text
//! J = 1/2 int int (d^2 c/ds^2)^2 + 2 (d^2 c/ds dg)^2 + (d^2 c/dg^2)^2 ds dg
//! ```
//!
//! by divided differences of the control values c. A spline may bend at a line of repeated knots for nothing: a jump of the slope
//! of the change there is charged besides, so that no change makes a knuckle.

use std::collections::BTreeMap;

use crate::hull::Hull;
use crate::qp::SparseRows;
use crate::spline::KnotVector;

/// Points nearer than this part of a unit length count as so far apart: edges that shrink to a point.
const NEAREST: f64 = 2e-3;
/// Weight of the mean square of the change beside its bending, which makes the form definite.
const MASS: f64 = 1e-3;

/// Distances between neighbouring control points along and up, over their units.
struct Spacing {
    along: Vec<f64>,
    up: Vec<f64>,
    columns: usize,
}

impl Spacing {
    fn new(hull: &Hull) -> Self {
        let surface = hull.surface();
        let [rows, columns] = surface.shape();
        let p = hull.particulars();
        let girth = 0.5 * p.breadth + hull.reference_height();
        let length = p.length_between_perpendiculars;
        let at = |i: usize, j: usize| surface.point(i.min(rows - 1), j.min(columns - 1));
        let (mut along, mut up) = (Vec::new(), Vec::new());
        for i in 0..rows {
            for j in 0..columns {
                let ([x, y, z], [a, _, c], [_, e, f]) = (at(i, j), at(i + 1, j), at(i, j + 1));
                along.push(((a - x).hypot(c - z) / length).max(NEAREST));
                up.push(((e - y).hypot(f - z) / girth).max(NEAREST));
            }
        }
        Self { along, up, columns }
    }

    /// Steps along and up from the point (i, j).
    fn at(&self, i: usize, j: usize) -> [f64; 2] {
        [self.along[i * self.columns + j], self.up[i * self.columns + j]]
    }
}

/// Weights of the second divided difference over three values at distances `h` and `k`, times the root of the way that it
/// stands for.
fn second([h, k]: [f64; 2]) -> [f64; 3] {
    let root = (0.5 * (h + k)).sqrt();
    [2.0 * root / (h * (h + k)), -2.0 * root / (h * k), 2.0 * root / (k * (h + k))]
}

/// Charge of a unit jump of slope at a line of as many knots as the degree, over a unit of that line.
const KINK: f64 = 100.0;

/// Control values on lines of the surface at which knots are repeated as often as the degree: slopes are free there.
fn broken(knots: &KnotVector) -> Vec<usize> {
    let inside = knots.breakpoints();
    let inside = inside.iter().skip(1).take(inside.len().saturating_sub(2));
    let lines = inside.filter(|t| knots.multiplicity(**t) >= knots.degree());
    // The last knot before the span that begins at t is the last of them.
    lines.map(|&t| knots.find_span(t) - knots.degree()).collect()
}

/// Jumps of the slope of the change across such lines, along and up.
fn kinks(hull: &Hull, spacing: &Spacing) -> Vec<Stencil> {
    let surface = hull.surface();
    let [rows, columns] = surface.shape();
    let stencil = |points: [usize; 3], [h, k]: [f64; 2], way: f64| -> Stencil {
        let weights = [1.0 / h, -1.0 / h - 1.0 / k, 1.0 / k].map(|weight| KINK * way.sqrt() * weight);
        points.into_iter().zip(weights).collect()
    };
    let mut list = Vec::new();
    for j in broken(surface.v()).into_iter().filter(|j| *j > 0 && j + 1 < columns) {
        for i in 0..rows {
            let k = i * columns + j;
            let ([along, up], below) = (spacing.at(i, j), spacing.at(i, j - 1)[1]);
            list.push(stencil([k - 1, k, k + 1], [below, up], along));
        }
    }
    for i in broken(surface.u()).into_iter().filter(|i| *i > 0 && i + 1 < rows) {
        for j in 0..columns {
            let k = i * columns + j;
            let ([along, up], behind) = (spacing.at(i, j), spacing.at(i - 1, j)[0]);
            list.push(stencil([k - columns, k, k + columns], [behind, along], up));
        }
    }
    list
}

/// A difference with its points.
type Stencil = Vec<(usize, f64)>;

fn stencils(hull: &Hull) -> Vec<Stencil> {
    let [rows, columns] = hull.surface().shape();
    let spacing = Spacing::new(hull);
    let index = |i: usize, j: usize| i * columns + j;
    let mut list = kinks(hull, &spacing);
    for i in 0..rows {
        for j in 0..columns {
            let [along, up] = spacing.at(i, j);
            if i > 0 && i + 1 < rows {
                let weights = second([spacing.at(i - 1, j)[0], along]);
                let across = up.sqrt();
                list.push((0..3).map(|k| (index(i + k - 1, j), across * weights[k])).collect());
            }
            if j > 0 && j + 1 < columns {
                let weights = second([spacing.at(i, j - 1)[1], up]);
                let across = along.sqrt();
                list.push((0..3).map(|k| (index(i, j + k - 1), across * weights[k])).collect());
            }
            if i + 1 < rows && j + 1 < columns {
                let twist = (2.0 / (along * up)).sqrt();
                let corners = [(i, j, twist), (i + 1, j, -twist), (i, j + 1, -twist), (i + 1, j + 1, twist)];
                list.push(corners.into_iter().map(|(i, j, weight)| (index(i, j), weight)).collect());
            }
            list.push(vec![(index(i, j), (MASS * along * up).sqrt())]);
        }
    }
    list
}

/// The form over the free control values, both triangles; `places[k]` is the number of the point k among them.
pub(super) fn form(hull: &Hull, places: &[Option<usize>]) -> SparseRows {
    let count = places.iter().flatten().count();
    let mut rows: Vec<BTreeMap<usize, f64>> = vec![BTreeMap::new(); count];
    for stencil in stencils(hull) {
        let free: Vec<(usize, f64)> =
            stencil.iter().filter_map(|&(point, weight)| Some((places[point]?, weight))).collect();
        for &(a, by) in &free {
            for &(b, and) in &free {
                *rows[a].entry(b).or_insert(0.0) += by * and;
            }
        }
    }
    let mut form = SparseRows::new(count);
    for row in rows {
        form.push(row);
    }
    form
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::derivation::samples::parabolic;

    /// A triple knot between others: the control value on its line.
    #[test]
    fn lines_of_repeated_knots_have_their_control_value() {
        let knots = KnotVector::from_breakpoints(3, &[0.0, 1.0, 2.0, 3.0], &[1, 3]).unwrap();
        let line = broken(&knots);
        assert_eq!(line.len(), 1);
        assert!((knots.greville()[line[0]] - 2.0).abs() < 1e-12, "{line:?} {:?}", knots.greville());
    }

    /// Free of bending but for the mass: nothing is charged for a plane; the form is symmetric.
    #[test]
    fn the_form_is_symmetric_and_charges_bends() {
        let hull = parabolic();
        let count = hull.surface().points().len();
        let places: Vec<Option<usize>> = (0..count).map(Some).collect();
        let form = form(&hull, &places);
        let dense = |i: usize, j: usize| form.entries(i).find(|(k, _)| *k == j).map_or(0.0, |(_, value)| value);
        for i in 0..count {
            for (j, value) in form.entries(i) {
                assert!((dense(j, i) - value).abs() <= 1e-12 * value.abs());
            }
        }
        let energy = |x: &[f64]| -> f64 { x.iter().zip(form.apply(x)).map(|(x, y)| x * y).sum() };
        let flat = energy(&vec![1.0; count]);
        let saw: Vec<f64> = (0..count).map(|k| if k % 2 == 0 { 1.0 } else { -1.0 }).collect();
        assert!(flat > 0.0 && flat < 2.0 * MASS && energy(&saw) > 1e3 * flat, "{flat} {}", energy(&saw));
    }
}
