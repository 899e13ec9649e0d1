//! Proximal points (Rockafellar 1976) for linear programs on which the interior point stalls: each step solves
//!
//! ```text
//! minimise  1/2 x'P x + q'x + 1/2 rho |x - x_k|^2   subject to  l <= A x <= u
//! ```
//!
//! whose minimiser is unique. Of a linear program finitely many steps reach an optimum, where the multipliers of the
//! step are those of the program.

use super::problem::{Problem, ProblemError, Settings, Solution};
use super::sparse::SparseRows;
use super::structured::Solver;

/// Most steps.
const STEPS: usize = 30;

impl Problem {
    /// Solves from a point `from` on, until an answer is `good`; the last one otherwise. `rho` is over the square of
    /// the units of x.
    ///
    /// # Errors
    /// [`ProblemError`] when shapes or numbers are wrong.
    pub fn solve_by_proximal_points(
        &self,
        settings: &Settings,
        from: &[f64],
        rho: f64,
        good: impl Fn(&Solution) -> bool,
    ) -> Result<Solution, ProblemError> {
        let n = self.linear.len();
        let curved = (0..n).flat_map(|row| self.quadratic.entries(row).map(move |(column, p)| (row, column, p)));
        let entries: Vec<_> = curved.chain((0..n).map(|k| (k, k, rho))).collect();
        let mut step = Self { quadratic: SparseRows::from_entries(n, n, &entries), ..self.clone() };
        let pulled = |x: &[f64]| self.linear.iter().zip(x).map(|(q, x)| q - rho * x).collect::<Vec<_>>();
        step.linear = pulled(from);
        let mut solver = Solver::new(&step, settings)?;
        let mut solution = solver.solve();
        for _ in 1..STEPS {
            if good(&solution) {
                break;
            }
            step.linear = pulled(&solution.x);
            solver.update(&step)?;
            solution = solver.solve();
        }
        Ok(solution)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::qp::Status;

    /// min x + y subject to x + 2 y >= 4, 3 x + y >= 6: 2.8 at (1.6, 1.2), with multipliers -0.4 and -0.2.
    #[test]
    fn a_linear_program_is_solved_to_its_corner() {
        let mut rows = SparseRows::new(2);
        rows.push([(0, 1.0), (1, 2.0)]);
        rows.push([(0, 3.0), (1, 1.0)]);
        let problem = Problem {
            quadratic: SparseRows::from_entries(2, 2, &[]),
            linear: vec![1.0, 1.0],
            rows,
            lower: vec![4.0, 6.0],
            upper: vec![f64::INFINITY; 2],
        };
        let good = |solution: &Solution| problem.certificate(&solution.x, &solution.multipliers, 0.0).gap.abs() < 1e-9;
        let found = problem.solve_by_proximal_points(&Settings::default(), &[50.0, -9.0], 1e-3, good).unwrap();
        assert_eq!(found.status, Status::Optimal);
        assert!((found.x[0] - 1.6).abs() < 1e-8 && (found.x[1] - 1.2).abs() < 1e-8, "{:?}", found.x);
        assert!((found.multipliers[0] + 0.4).abs() < 1e-8 && (found.multipliers[1] + 0.2).abs() < 1e-8);
    }
}
