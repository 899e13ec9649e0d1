//! The problem, its settings and what comes back.

use super::sparse::SparseRows;

/// min 1/2 x'P x + q'x + 1/2 |F x|^2 subject to l <= A x <= u.
#[derive(Debug, Clone, PartialEq)]
pub struct Problem {
    /// P, symmetric positive semidefinite, both triangles stored, n x n.
    pub quadratic: SparseRows,
    /// q, length n.
    pub linear: Vec<f64>,
    /// F, dense forms of which the objective has half the squares, any number of rows x n.
    pub squares: SparseRows,
    /// A, m x n.
    pub rows: SparseRows,
    /// l, length m; minus infinity where there is no lower limit.
    pub lower: Vec<f64>,
    /// u, length m; infinity where there is no upper limit; l = u is an equality.
    pub upper: Vec<f64>,
}

/// Why numbers make no problem.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum ProblemError {
    /// Shapes that do not go together.
    #[error("{what} has {found} entries, {expected} wanted")]
    Shape {
        /// Which part.
        what: &'static str,
        /// Entries found.
        found: usize,
        /// Entries wanted.
        expected: usize,
    },
    /// A number that is none.
    #[error("{what} {index} is not finite")]
    NotFinite {
        /// Which part.
        what: &'static str,
        /// Which entry.
        index: usize,
    },
    /// Other places of entries than the solver was made for.
    #[error("the entries are not where the solver expects them")]
    Pattern,
    /// A lower limit above the upper one.
    #[error("row {row}: the lower limit lies above the upper one")]
    Limits {
        /// Which row.
        row: usize,
    },
}

/// How a problem is solved.
#[derive(Debug, Clone, PartialEq)]
pub struct Settings {
    /// Relative tolerance of gap and residuals.
    pub tolerance: f64,
    /// Most iterations.
    pub iterations: usize,
    /// Whether an iteration that stalls is followed by the search for a proof that there is no solution, which costs
    /// more than it did.
    pub proof: bool,
}

impl Default for Settings {
    fn default() -> Self {
        Self { tolerance: 1e-10, iterations: 200, proof: true }
    }
}

/// How a solve ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Status {
    /// Residuals and gap are within the tolerance.
    Optimal,
    /// No point satisfies the rows; the multipliers are a proof (Farkas): A'z = 0 and sup of the bound > 0.
    Infeasible,
    /// The objective falls without end from any feasible point; x is the direction.
    Unbounded,
    /// Stopped before the tolerance was met; the best point is given.
    Limit,
}

/// What a solve comes to.
#[derive(Debug, Clone, PartialEq)]
pub struct Solution {
    /// How it ended.
    pub status: Status,
    /// x, length n.
    pub x: Vec<f64>,
    /// z, one a row of A: P x + q + A'z = 0, z > 0 where the upper limit holds, z < 0 where the lower one does.
    pub multipliers: Vec<f64>,
    /// Iterations taken.
    pub iterations: usize,
    /// The iterates in order, those of every start; empty where the solver does not tell.
    pub progress: Vec<Progress>,
    /// An early iterate, for the start of a similar problem.
    pub interior: Option<Interior>,
}

/// A point well inside the limits of a problem, with multipliers, from which a similar one can start.
#[derive(Debug, Clone, PartialEq)]
pub struct Interior {
    /// x, length n.
    pub x: Vec<f64>,
    /// The slack and the multiplier of the upper and of the lower limit of each row, both above 0; the slack is infinite
    /// without a limit, and of an equality. None: unknown.
    pub rows: Vec<Option<[[f64; 2]; 2]>>,
}

/// How far an iterate is from a solution, each relative to the terms it is made of.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Progress {
    /// What the limits are missed by.
    pub primal: f64,
    /// The gradient of the Lagrangian.
    pub dual: f64,
    /// The sum of the products of slacks and multipliers.
    pub gap: f64,
}

impl Problem {
    /// The same rows and limits, with nothing to minimise.
    #[must_use]
    pub fn without_objective(&self) -> Self {
        let n = self.linear.len();
        let (quadratic, squares) = (SparseRows::from_entries(n, n, &[]), SparseRows::new(n));
        Self { quadratic, linear: vec![0.0; n], squares, ..self.clone() }
    }

    /// Checks shapes and numbers.
    ///
    /// # Errors
    /// [`ProblemError`] for the first part that is wrong.
    pub fn check(&self) -> Result<(), ProblemError> {
        let (n, m) = (self.linear.len(), self.rows.row_count());
        let shapes = [
            ("the quadratic part", self.quadratic.row_count(), n),
            ("a row of the quadratic part", self.quadratic.column_count(), n),
            ("a square", self.squares.column_count(), n),
            ("a row", self.rows.column_count(), n),
            ("the lower limits", self.lower.len(), m),
            ("the upper limits", self.upper.len(), m),
        ];
        for (what, found, expected) in shapes {
            if found != expected {
                return Err(ProblemError::Shape { what, found, expected });
            }
        }
        let numbers = [
            ("quadratic entry", self.quadratic.values()),
            ("linear entry", &self.linear[..]),
            ("entry of a square", self.squares.values()),
            ("row entry", self.rows.values()),
        ];
        for (what, values) in numbers {
            if let Some(index) = values.iter().position(|value| !value.is_finite()) {
                return Err(ProblemError::NotFinite { what, index });
            }
        }
        for row in 0..m {
            let (lower, upper) = (self.lower[row], self.upper[row]);
            if lower.is_nan() || upper.is_nan() || lower == f64::INFINITY || upper == f64::NEG_INFINITY {
                return Err(ProblemError::NotFinite { what: "limit of row", index: row });
            }
            if lower > upper {
                return Err(ProblemError::Limits { row });
            }
        }
        Ok(())
    }

    /// 1/2 x'P x + q'x + 1/2 |F x|^2.
    #[must_use]
    pub fn objective(&self, x: &[f64]) -> f64 {
        let curved = self.curved(x);
        x.iter().zip(&curved).zip(&self.linear).map(|((x, p), q)| x * (0.5 * p + q)).sum()
    }
}
