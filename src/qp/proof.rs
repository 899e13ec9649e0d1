//! Proofs that a problem has no solution, checked without the solver.
//!
//! *Farkas.* For every z, every x with l <= Ax <= u has z'Ax <= h(z) = sum_k (u_k z_k^+ - l_k z_k^-). If h(z) < 0 and
//! r = A'z, then r'x <= h(z) < 0, so |x|_inf >= -h(z) / |r|_1: no feasible point lies nearer than that. With r = 0 there
//! is none at all (Boyd & Vandenberghe 2004, section 5.8); with r at rounding level the radius says how far away one
//! would have to be.
//!
//! *Rays.* With P d = 0, F d = 0, q'd < 0 and A d in the recession cone of [l, u], x + t d stays feasible and falls without end.

use super::problem::Problem;

impl Problem {
    /// The radius in which the multipliers z prove that no feasible point lies (largest component of x); 0 if they prove
    /// nothing, infinite if A'z vanishes.
    #[must_use]
    pub fn infeasible_within(&self, z: &[f64]) -> f64 {
        let mut support = 0.0;
        for (row, &z) in z.iter().enumerate() {
            let limit = if z > 0.0 { self.upper[row] } else { self.lower[row] };
            if z != 0.0 {
                support += z * limit;
            }
        }
        let rest: f64 = self.rows.apply_transposed(z).iter().map(|value| value.abs()).sum();
        if support.is_nan() || rest.is_nan() || support >= 0.0 || support == f64::NEG_INFINITY {
            0.0
        } else {
            -support / rest
        }
    }

    /// How badly d is a direction of endless fall: the largest of |P d| and of the way A d (rows of unit size) leads
    /// out of the limits, over the fall -q'd, for |q| = |P| = 1; infinite if the objective does not fall.
    #[must_use]
    pub fn ray_defect(&self, d: &[f64]) -> f64 {
        let size = |values: &[f64]| values.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
        let slope: f64 = d.iter().zip(&self.linear).map(|(d, q)| d * q).sum();
        let (steep, curved) = (size(&self.linear), size(self.quadratic.values()).max(size(self.squares.values())));
        if slope.is_nan() || slope >= 0.0 {
            return f64::INFINITY;
        }
        let fall = -slope / steep;
        let mut defect =
            if curved > 0.0 { size(&self.quadratic.apply(d)).max(size(&self.squares.apply(d))) / curved } else { 0.0 };
        for row in 0..self.rows.row_count() {
            let scale = self.rows.row_size(row);
            if scale > 0.0 {
                let value = self.rows.dot(row, d) / scale;
                if self.upper[row].is_finite() {
                    defect = defect.max(value);
                }
                if self.lower[row].is_finite() {
                    defect = defect.max(-value);
                }
            }
        }
        defect / fall
    }
}
