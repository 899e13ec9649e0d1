//! Proximal points (Rockafellar 1976) for linear programs on which the interior point stalls: each step solves
//!
//! ```text
//! minimise  1/2 x'P x + q'x + 1/2 |F x|^2 + 1/2 rho |x - x_k|^2   subject to  l <= A x <= u
//! ```
//!
//! whose minimiser is unique. Of a linear program finitely many steps reach an optimum, where the multipliers of the
//! step are those of the program.

use super::problem::{Problem, ProblemError, Settings, Solution, Status};
use super::sparse::SparseRows;
use super::structured::Solver;

/// Most steps.
const STEPS: usize = 30;

impl Problem {
    /// Solves from a point `from` on, until an answer is `good` for this problem. `rho` weighs the squares of all
    /// unknowns alike; entries of `from` that are not finite count as 0.
    ///
    /// The status is [`Status::Optimal`] only where the answer is good: that a step has its optimum says nothing of the
    /// program. The rows are those of the program, so that a proof that a step has no solution holds for it.
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
        self.check()?;
        let n = self.linear.len();
        if from.len() != n {
            return Err(ProblemError::Shape { what: "the start", found: from.len(), expected: n });
        }
        let curved = (0..n).flat_map(|row| self.quadratic.entries(row).map(move |(column, p)| (row, column, p)));
        let entries: Vec<_> = curved.chain((0..n).map(|k| (k, k, rho))).collect();
        let mut step = Self { quadratic: SparseRows::from_entries(n, n, &entries), ..self.clone() };
        let pulled = |x: &[f64]| {
            let finite = x.iter().map(|x| if x.is_finite() { *x } else { 0.0 });
            self.linear.iter().zip(finite).map(|(q, x)| q - rho * x).collect::<Vec<_>>()
        };
        step.linear = pulled(from);
        let mut solver = Solver::new(&step, settings)?;
        let mut solution = solver.solve();
        for _ in 1..STEPS {
            if good(&solution) || solution.status == Status::Infeasible {
                break;
            }
            step.linear = pulled(&solution.x);
            solver.update(&step)?;
            solution = solver.solve();
        }
        if solution.status != Status::Infeasible {
            solution.status = if good(&solution) { Status::Optimal } else { Status::Limit };
        }
        Ok(solution)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::cell::Cell;

    /// min x + y subject to x + 2 y >= 4, 3 x + y >= 6: 2.8 at (1.6, 1.2), with multipliers -0.4 and -0.2.
    fn corner() -> Problem {
        let mut rows = SparseRows::new(2);
        rows.push([(0, 1.0), (1, 2.0)]);
        rows.push([(0, 3.0), (1, 1.0)]);
        Problem {
            quadratic: SparseRows::from_entries(2, 2, &[]),
            linear: vec![1.0, 1.0],
            squares: SparseRows::new(2),
            rows,
            lower: vec![4.0, 6.0],
            upper: vec![f64::INFINITY; 2],
        }
    }

    fn proved(problem: &Problem, solution: &Solution) -> bool {
        let certificate = problem.certificate(&solution.x, &solution.multipliers, 0.0);
        certificate.gap.abs() < 1e-9 && certificate.max_violation < 1e-9
    }

    /// The optimum of the first step from so far away is no optimum of the program: more steps are needed, and taken.
    #[test]
    fn steps_go_on_until_the_linear_program_is_proved() {
        let problem = corner();
        for (rho, least) in [(1e-3, 2), (0.1, 5)] {
            let steps = Cell::new(0);
            let good = |solution: &Solution| {
                steps.set(steps.get() + 1);
                proved(&problem, solution)
            };
            let start = [20.0, -9.0];
            let found = problem.solve_by_proximal_points(&Settings::default(), &start, rho, good).unwrap();
            assert_eq!(found.status, Status::Optimal);
            assert!((found.x[0] - 1.6).abs() < 1e-8 && (found.x[1] - 1.2).abs() < 1e-8, "{:?}", found.x);
            assert!((found.multipliers[0] + 0.4).abs() < 1e-8 && (found.multipliers[1] + 0.2).abs() < 1e-8);
            // The last answer is judged twice.
            assert!(steps.get() > least, "{} steps", steps.get() - 1);
        }
    }

    #[test]
    fn an_answer_that_is_not_good_is_no_optimum() {
        let found = corner().solve_by_proximal_points(&Settings::default(), &[0.0, 0.0], 1.0, |_| false).unwrap();
        assert_eq!(found.status, Status::Limit);
    }

    #[test]
    fn starts_that_are_not_finite_shapes_that_are_wrong_and_rows_that_contradict_each_other() {
        let mut problem = corner();
        let settings = Settings::default();
        let good = |solution: &Solution| proved(&corner(), solution);
        let found = problem.solve_by_proximal_points(&settings, &[f64::NAN, f64::INFINITY], 0.1, good).unwrap();
        assert_eq!(found.status, Status::Optimal);
        let refused = problem.solve_by_proximal_points(&settings, &[0.0], 0.1, good).unwrap_err();
        assert_eq!(refused, ProblemError::Shape { what: "the start", found: 1, expected: 2 });
        problem.rows.push([(0, 1.0), (1, 2.0)]);
        problem.lower.push(f64::NEG_INFINITY);
        problem.upper.push(3.0);
        let none = problem.solve_by_proximal_points(&settings, &[0.0, 0.0], 0.1, |_| false).unwrap();
        assert_eq!(none.status, Status::Infeasible);
    }
}
