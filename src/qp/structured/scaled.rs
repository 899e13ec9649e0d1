//! The problem as the iteration sees it: variables in elimination order and of unit curvature each (Jacobi scaling: a
//! net has control values whose energy is 1e11 times that of others), rows of unit size, an objective of unit curvature.

use super::super::problem::Problem;
use super::super::sparse::SparseRows;
use super::normal::elimination_order;

/// A row longer than this, and than an eighth of the unknowns, stays outside the normal matrix.
const DENSE: usize = 100;
/// The nearer limit of a row over its largest entry at most: what rows of stiff variables leave of their limits is lost in
/// rounding.
const FARTHEST: f64 = 1e3;
/// Limits closer than this, relative to their size, are an equality.
const CLOSED: f64 = 1e-13;

/// The scaled problem and the way back.
#[derive(Clone)]
pub(super) struct Scaled {
    pub(super) quadratic: SparseRows,
    pub(super) linear: Vec<f64>,
    pub(super) rows: SparseRows,
    pub(super) lower: Vec<f64>,
    pub(super) upper: Vec<f64>,
    /// Rows with l = u.
    pub(super) equal: Vec<bool>,
    /// Rows inside the normal matrix; the dense ones are not.
    pub(super) inside: Vec<bool>,
    /// The others.
    pub(super) outside: Vec<usize>,
    /// Objective of the iteration over that of the problem.
    pub(super) objective_scale: f64,
    pub(super) row_scale: Vec<f64>,
    /// A variable of the problem over that of the iteration, in elimination order: powers of two, which round nothing.
    column_scale: Vec<f64>,
    order: Vec<usize>,
    quadratic_origins: Vec<usize>,
    row_origins: Vec<usize>,
}

impl Scaled {
    /// Orders and scales.
    pub(super) fn new(problem: &Problem) -> Self {
        let (n, m) = (problem.linear.len(), problem.rows.row_count());
        let inside: Vec<bool> = (0..m)
            .map(|row| {
                let count = problem.rows.row(row).0.len();
                count <= DENSE.max(n / 8)
            })
            .collect();
        let order = elimination_order(&problem.quadratic, &problem.rows, &inside);
        let mut places = vec![0; n];
        for (place, &index) in order.iter().enumerate() {
            places[index] = place;
        }
        let (quadratic, quadratic_origins) = problem.quadratic.moved(order.iter().copied(), &places);
        let (rows, row_origins) = problem.rows.moved(0..m, &places);
        let outside = (0..m).filter(|&row| !inside[row]).collect();
        let mut scaled = Self {
            quadratic,
            linear: vec![0.0; n],
            rows,
            lower: vec![0.0; m],
            upper: vec![0.0; m],
            equal: vec![false; m],
            inside,
            outside,
            objective_scale: 1.0,
            row_scale: vec![1.0; m],
            column_scale: order.iter().map(|&index| unit_curvature(diagonal(&problem.quadratic, index))).collect(),
            order,
            quadratic_origins,
            row_origins,
        };
        scaled.load(problem);
        scaled
    }

    /// Takes the values of a problem of the same pattern.
    pub(super) fn load(&mut self, problem: &Problem) {
        let n = self.linear.len();
        let columns = &self.column_scale;
        let (mut trace, mut largest) = (0.0, 0.0_f64);
        for (&index, scale) in self.order.iter().zip(columns) {
            trace += scale * scale * diagonal(&problem.quadratic, index);
            largest = largest.max((scale * problem.linear[index]).abs());
        }
        let size = if trace > 0.0 { trace / n as f64 } else { largest };
        self.objective_scale = if size > 0.0 { 1.0 / size } else { 1.0 };
        let factors: Vec<f64> = columns.iter().map(|scale| scale * self.objective_scale).collect();
        let (values, origins) = (problem.quadratic.values(), &self.quadratic_origins);
        self.quadratic.refill(|row, column, place| values[origins[place]] * factors[row] * columns[column]);
        for ((value, &index), factor) in self.linear.iter_mut().zip(&self.order).zip(&factors) {
            *value = problem.linear[index] * factor;
        }
        let (values, origins) = (problem.rows.values(), &self.row_origins);
        self.rows.refill(|_, column, place| values[origins[place]] * columns[column]);
        for row in 0..self.row_scale.len() {
            let (lower, upper) = (problem.lower[row], problem.upper[row]);
            let limits = [lower, upper].into_iter().map(f64::abs).filter(|limit| limit.is_finite());
            let nearest = limits.reduce(f64::min).unwrap_or(0.0);
            let size = self.rows.row_size(row).max(nearest / FARTHEST);
            let scale = if size > 0.0 { 1.0 / size } else { 1.0 };
            self.row_scale[row] = scale;
            let width = upper - lower;
            self.equal[row] = width.is_finite() && width <= CLOSED * upper.abs().max(lower.abs());
            if self.equal[row] {
                let middle = lower + 0.5 * (upper - lower);
                (self.lower[row], self.upper[row]) = (middle * scale, middle * scale);
            } else {
                (self.lower[row], self.upper[row]) = (lower * scale, upper * scale);
            }
        }
        self.rows.scale_rows(&self.row_scale);
    }

    /// x in the order of the problem.
    pub(super) fn variables(&self, x: &[f64]) -> Vec<f64> {
        let mut result = vec![0.0; x.len()];
        for ((value, &index), scale) in x.iter().zip(&self.order).zip(&self.column_scale) {
            result[index] = value * scale;
        }
        result
    }

    /// Multipliers of the rows of the problem.
    pub(super) fn multipliers(&self, z: &[f64]) -> Vec<f64> {
        z.iter().zip(&self.row_scale).map(|(z, scale)| z * scale / self.objective_scale).collect()
    }

    /// The x of a point in the units of the iteration.
    pub(super) fn scaled_variables(&self, x: &[f64]) -> Vec<f64> {
        self.order.iter().zip(&self.column_scale).map(|(&index, scale)| x[index] / scale).collect()
    }
}

/// The power of two next to 1 / sqrt(p) for the curvature p of a variable; 1 where it has none.
fn unit_curvature(p: f64) -> f64 {
    if p > 0.0 && p.is_finite() { (-0.5 * p.log2()).round().exp2() } else { 1.0 }
}

fn diagonal(matrix: &SparseRows, row: usize) -> f64 {
    let (places, entries) = matrix.row(row);
    places.iter().zip(entries).filter(|&(&place, _)| place == row).map(|(_, entry)| entry).sum()
}
