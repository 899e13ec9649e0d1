//! The least factor by which limits must be relaxed together:
//!
//! ```text
//! minimise t   subject to   l <= A x <= u,   a x - g t <= u,   a x + g t >= l,   t >= 0.
//! ```

use super::problem::Problem;
use super::sparse::SparseRows;

/// Rows over n unknowns and t, which is the last of n + 1.
#[derive(Debug, Clone)]
pub struct LeastFactor {
    unknowns: usize,
    rows: SparseRows,
    lower: Vec<f64>,
    upper: Vec<f64>,
}

impl LeastFactor {
    /// No rows yet, over `unknowns` besides t.
    #[must_use]
    pub fn new(unknowns: usize) -> Self {
        Self { unknowns, rows: SparseRows::new(unknowns + 1), lower: Vec::new(), upper: Vec::new() }
    }

    /// A row whose limits stay.
    pub fn push(&mut self, row: impl IntoIterator<Item = (usize, f64)>, lower: f64, upper: f64) {
        self.rows.push(row);
        self.lower.push(lower);
        self.upper.push(upper);
    }

    /// A row whose limits are relaxed by `give` times t; limits that are infinite say nothing.
    pub fn push_giving(
        &mut self,
        row: impl Iterator<Item = (usize, f64)> + Clone,
        [lower, upper]: [f64; 2],
        give: f64,
    ) {
        if upper.is_finite() {
            self.push(row.clone().chain([(self.unknowns, -give)]), f64::NEG_INFINITY, upper);
        }
        if lower.is_finite() {
            self.push(row.chain([(self.unknowns, give)]), lower, f64::INFINITY);
        }
    }

    /// The linear program; t is its last unknown.
    #[must_use]
    pub fn into_problem(mut self) -> Problem {
        let n = self.unknowns;
        self.push([(n, 1.0)], 0.0, f64::INFINITY);
        let mut linear = vec![0.0; n + 1];
        linear[n] = 1.0;
        Problem {
            quadratic: SparseRows::from_entries(n + 1, n + 1, &[]),
            linear,
            squares: SparseRows::new(n + 1),
            rows: self.rows,
            lower: self.lower,
            upper: self.upper,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::qp::Settings;

    /// x in [3, 5] and -x in [0, 1], which is relaxed by 2 t: t = 1.5 at x = 3.
    #[test]
    fn limits_give_way_as_far_as_they_must() {
        let mut rows = LeastFactor::new(1);
        rows.push([(0, 1.0)], 3.0, 5.0);
        rows.push_giving([(0, -1.0)].into_iter(), [0.0, 1.0], 2.0);
        let solution = rows.into_problem().solve(&Settings::default()).unwrap();
        assert!((solution.x[1] - 1.5).abs() < 1e-7 && (solution.x[0] - 3.0).abs() < 1e-6, "{:?}", solution.x);
    }
}
