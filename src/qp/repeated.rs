//! One problem after the other, most of them with the pattern of the one before.

use super::problem::{Problem, ProblemError, Settings, Solution};
use super::structured::Solver;

/// Solves problems; orderings, the symbolic factorisation and an early iterate of one serve the next as long as the
/// pattern is the same.
pub struct RepeatedSolver<'a> {
    settings: &'a Settings,
    kept: Option<Solver>,
}

impl Clone for RepeatedSolver<'_> {
    /// One for the same settings. It knows nothing yet.
    fn clone(&self) -> Self {
        Self::new(self.settings)
    }
}

impl<'a> RepeatedSolver<'a> {
    /// Nothing is known yet.
    #[must_use]
    pub fn new(settings: &'a Settings) -> Self {
        Self { settings, kept: None }
    }

    /// Forgets the last solution: the next solve starts cold.
    pub fn forget(&mut self) {
        if let Some(solver) = &mut self.kept {
            solver.forget();
        }
    }

    /// Solves.
    ///
    /// # Errors
    /// [`ProblemError`] when shapes or numbers are wrong; not solving is a status.
    pub fn solve(&mut self, problem: &Problem) -> Result<Solution, ProblemError> {
        if let Some(solver) = &mut self.kept {
            match solver.update(problem) {
                Ok(()) => return Ok(solver.solve()),
                Err(ProblemError::Pattern) => {}
                Err(other) => return Err(other),
            }
        }
        Ok(self.kept.insert(Solver::new(problem, self.settings)?).solve())
    }
}
