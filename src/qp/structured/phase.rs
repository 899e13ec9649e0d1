//! Two auxiliary problems for an iteration that stalled. Both always have an interior and an optimum, and their answers
//! are the proofs of [`super::super::proof`].

use super::super::problem::Problem;
use super::super::sparse::SparseRows;

/// min 1/2 |e|^2, l <= Ax - e <= u, rows of unit size: the smallest change of the limits that makes the rows feasible.
/// At the optimum A'z = 0 and e = z: the multipliers are a Farkas proof unless e = 0.
pub(super) fn nearest_feasible(problem: &Problem) -> Problem {
    let (n, m) = (problem.linear.len(), problem.rows.row_count());
    let mut rows = SparseRows::new(n + m);
    let (mut lower, mut upper) = (Vec::with_capacity(m), Vec::with_capacity(m));
    for row in 0..m {
        let scale = scale(&problem.rows, row);
        let (columns, values) = problem.rows.row(row);
        rows.push(columns.iter().zip(values).map(|(&column, value)| (column, value * scale)).chain([(n + row, -1.0)]));
        lower.push(problem.lower[row] * scale);
        upper.push(problem.upper[row] * scale);
    }
    let entries: Vec<_> = (n..n + m).map(|index| (index, index, 1.0)).collect();
    Problem {
        quadratic: SparseRows::from_entries(n + m, n + m, &entries),
        linear: vec![0.0; n + m],
        squares: SparseRows::new(n + m),
        rows,
        lower,
        upper,
    }
}

/// The multipliers of the rows of the problem from those of [`nearest_feasible`].
pub(super) fn farkas(problem: &Problem, z: &[f64]) -> Vec<f64> {
    let mut multipliers: Vec<f64> = z.iter().enumerate().map(|(row, z)| z * scale(&problem.rows, row)).collect();
    for (row, z) in multipliers.iter_mut().enumerate() {
        let limit = if *z > 0.0 { problem.upper[row] } else { problem.lower[row] };
        if !limit.is_finite() {
            *z = 0.0;
        }
    }
    multipliers
}

/// min q'd + 1/2 |d|^2, P d = 0, A d in the recession cone of [l, u]: -q projected on the cone of the rays; d = 0 if
/// the objective is bounded below along every ray.
pub(super) fn steepest_ray(problem: &Problem) -> Problem {
    let (n, m) = (problem.linear.len(), problem.rows.row_count());
    let mut rows = SparseRows::new(n);
    let (mut lower, mut upper) = (Vec::new(), Vec::new());
    for row in 0..n {
        let scale = scale(&problem.quadratic, row);
        let (columns, values) = problem.quadratic.row(row);
        rows.push(columns.iter().zip(values).map(|(&column, value)| (column, value * scale)));
        lower.push(0.0);
        upper.push(0.0);
    }
    for row in 0..m {
        let scale = scale(&problem.rows, row);
        let (columns, values) = problem.rows.row(row);
        rows.push(columns.iter().zip(values).map(|(&column, value)| (column, value * scale)));
        lower.push(if problem.lower[row].is_finite() { 0.0 } else { f64::NEG_INFINITY });
        upper.push(if problem.upper[row].is_finite() { 0.0 } else { f64::INFINITY });
    }
    let largest = problem.linear.iter().fold(0.0_f64, |most, value| most.max(value.abs())).max(f64::MIN_POSITIVE);
    let entries: Vec<_> = (0..n).map(|index| (index, index, 1.0)).collect();
    Problem {
        quadratic: SparseRows::from_entries(n, n, &entries),
        linear: problem.linear.iter().map(|value| value / largest).collect(),
        squares: SparseRows::new(n),
        rows,
        lower,
        upper,
    }
}

fn scale(matrix: &SparseRows, row: usize) -> f64 {
    let size = matrix.row_size(row);
    if size > 0.0 { 1.0 / size } else { 1.0 }
}
