//! The problem as the iteration sees it: variables in elimination order, rows of unit size, an objective of unit
//! curvature.

use super::super::problem::Problem;
use super::super::sparse::SparseRows;
use super::normal::elimination_order;

/// A row longer than this, and than an eighth of the unknowns, stays outside the normal matrix.
const DENSE: usize = 100;
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
    row_scale: Vec<f64>,
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
        let trace: f64 = (0..n).map(|row| diagonal(&problem.quadratic, row)).sum();
        let largest = problem.linear.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
        let size = if trace > 0.0 { trace / n as f64 } else { largest };
        self.objective_scale = if size > 0.0 { 1.0 / size } else { 1.0 };
        for (value, &origin) in self.quadratic.values_mut().iter_mut().zip(&self.quadratic_origins) {
            *value = problem.quadratic.values()[origin] * self.objective_scale;
        }
        for (value, &index) in self.linear.iter_mut().zip(&self.order) {
            *value = problem.linear[index] * self.objective_scale;
        }
        for row in 0..self.row_scale.len() {
            let size = problem.rows.row_size(row);
            let scale = if size > 0.0 { 1.0 / size } else { 1.0 };
            self.row_scale[row] = scale;
            let (lower, upper) = (problem.lower[row], problem.upper[row]);
            let width = upper - lower;
            self.equal[row] = width.is_finite() && width <= CLOSED * upper.abs().max(lower.abs());
            if self.equal[row] {
                let middle = lower + 0.5 * (upper - lower);
                (self.lower[row], self.upper[row]) = (middle * scale, middle * scale);
            } else {
                (self.lower[row], self.upper[row]) = (lower * scale, upper * scale);
            }
        }
        let mut place = 0;
        for row in 0..self.row_scale.len() {
            for _ in 0..problem.rows.row(row).0.len() {
                self.rows.values_mut()[place] = problem.rows.values()[self.row_origins[place]] * self.row_scale[row];
                place += 1;
            }
        }
    }

    /// x in the order of the problem.
    pub(super) fn variables(&self, x: &[f64]) -> Vec<f64> {
        let mut result = vec![0.0; x.len()];
        for (value, &index) in x.iter().zip(&self.order) {
            result[index] = *value;
        }
        result
    }

    /// Multipliers of the rows of the problem.
    pub(super) fn multipliers(&self, z: &[f64]) -> Vec<f64> {
        z.iter().zip(&self.row_scale).map(|(z, scale)| z * scale / self.objective_scale).collect()
    }
}

fn diagonal(matrix: &SparseRows, row: usize) -> f64 {
    let (places, entries) = matrix.row(row);
    places.iter().zip(entries).filter(|&(&place, _)| place == row).map(|(_, entry)| entry).sum()
}
