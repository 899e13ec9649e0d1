//! A lower bound of the optimum and the residuals, from x and the multipliers alone.
//!
//! For any z the Lagrangian dual (Boyd & Vandenberghe 2004, section 5.2) of min 1/2 x'Px + q'x, l <= Ax <= u is
//!
//! ```text
//! g(z) = inf_x [1/2 x'Px + (q + A'z)'x] - sum_k (u_k z_k^+ - l_k z_k^-),   z^+ = max(z, 0), z^- = max(-z, 0)
//! ```
//!
//! The infimum is bounded at the given x: with r = Px + q + A'z it is -1/2 x'Px + inf_d (1/2 d'Pd + r'd) >= -1/2 x'Px -
//! |r|'rho for all minimisers within rho of x. The bound is therefore rigorous for every optimum inside the box |x* -
//! x| <= rho; with r at rounding level the last term is rounding too.

use super::problem::Problem;

/// How good an answer is, computed without the solver.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Certificate {
    /// 1/2 x'Px + q'x.
    pub primal: f64,
    /// Lower bound of the optimum.
    pub dual: f64,
    /// (primal - dual) / max(1, |primal|).
    pub gap: f64,
    /// Largest component of P x + q + A'z, relative to max(1, |q|, |Px|).
    pub stationarity: f64,
    /// Largest violation of a row, in the units of the row.
    pub max_violation: f64,
}

impl Problem {
    /// Judges x and multipliers z; `reach` bounds how far any minimiser can lie from x in any component (0 takes the
    /// largest |x|).
    ///
    /// Multipliers that pull at a limit which does not exist are set to 0 first.
    #[must_use]
    pub fn certificate(&self, x: &[f64], multipliers: &[f64], reach: f64) -> Certificate {
        let reach = if reach > 0.0 { reach } else { x.iter().fold(0.0, |most: f64, value| most.max(value.abs())) };
        let mut clipped = multipliers.to_vec();
        let mut support = 0.0;
        for (row, z) in clipped.iter_mut().enumerate() {
            if *z > 0.0 {
                if self.upper[row].is_finite() {
                    support += *z * self.upper[row];
                } else {
                    *z = 0.0;
                }
            } else if *z < 0.0 {
                if self.lower[row].is_finite() {
                    support += *z * self.lower[row];
                } else {
                    *z = 0.0;
                }
            }
        }
        let curved = self.curved(x);
        let pull = self.rows.apply_transposed(&clipped);
        let (mut square, mut linear, mut rest, mut worst, mut scale) = (0.0, 0.0, 0.0, 0.0_f64, 1.0_f64);
        for index in 0..x.len() {
            square += x[index] * curved[index];
            linear += x[index] * self.linear[index];
            let residual = curved[index] + self.linear[index] + pull[index];
            rest += residual.abs() * reach;
            worst = worst.max(residual.abs());
            scale = scale.max(self.linear[index].abs()).max(curved[index].abs());
        }
        let primal = 0.5 * square + linear;
        let dual = -0.5 * square - support - rest;
        let mut violation = 0.0_f64;
        for row in 0..self.rows.row_count() {
            let value = self.rows.dot(row, x);
            violation = violation.max(self.lower[row] - value).max(value - self.upper[row]);
        }
        Certificate {
            primal,
            dual,
            gap: (primal - dual) / primal.abs().max(1.0),
            stationarity: worst / scale,
            max_violation: violation,
        }
    }
}
