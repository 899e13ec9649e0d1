//! Convex quadratic programs,
//!
//! ```text
//! minimise    1/2 x'P x + q'x + 1/2 |F x|^2
//! subject to  l <= A x <= u
//! ```
//!
//! with P positive semidefinite and sparse, F of few dense rows, rows of A sparse but for a few dense ones, and equalities as rows with l =
//! u. What a solver says of its answer is not believed: [`Problem::certificate`] computes a lower bound of the optimum,
//! the residuals and the violations from x and the multipliers alone. Knows no ship.

mod certificate;
mod factor;
mod problem;
mod proof;
mod proximal;
mod repeated;
mod sparse;
mod squares;
mod structured;

pub use certificate::Certificate;
pub use factor::LeastFactor;
pub use problem::{Interior, Problem, ProblemError, Progress, Settings, Solution, Status};
pub use repeated::RepeatedSolver;
pub use sparse::SparseRows;
pub use structured::Solver;
