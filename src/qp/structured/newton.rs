//! The Newton system: dense rows by a Schur complement, iterative refinement against the matrix without regularisation.
//!
//! ```text
//! P dx + A'dz           = f
//! A_k dx - dz_k / W_k   = g_k     (an equality: A_k dx = g_k; its W_k = 1/delta in the factored matrix only)
//! ```
//!
//! The rows inside the normal matrix are eliminated, dz = W (A dx - g); the others, o, remain:
//!
//! ```text
//! N dx + A_o'dz_o       = f + A'W g,          N = P + A'WA
//! S dz_o                = A_o N^-1 (f + A'W g) - g_o,    S = 1/W_o + A_o N^-1 A_o'
//! ```
//!
//! For the inequalities inside, the right side comes as h = W g, which stays finite where W vanishes.

use super::factor::Factor;
use super::normal::Normal;
use super::scaled::Scaled;
use super::schur::{Schur, inverse};

/// Weight 1/delta of the equalities inside the normal matrix, in units of the largest of the inequalities, and its
/// limits.
const EQUALITY_RATIO: f64 = 0.1;
const EQUALITY_WEIGHTS: [f64; 2] = [1e8, 1e13];
/// Relative lift of the diagonal at first and when the factorisation fails.
const LIFTS: [f64; 5] = [1e-15, 1e-13, 1e-11, 1e-9, 1e-7];
/// The primal regularisation d, in units of the mean diagonal of P. Refinement takes d / (d + e) off an error in a direction of
/// curvature e: with 1e-11 a net of 6056 values took 30 iterations more.
const PROXIMAL: f64 = 1e-14;
/// Most rounds of refinement.
const ROUNDS: usize = 3;

/// A right side: f, and g (h = W g for the inequalities inside).
pub(super) struct Right {
    pub(super) f: Vec<f64>,
    pub(super) g: Vec<f64>,
}

/// A solution (dx, dz), with A dx.
pub(super) struct Step {
    pub(super) x: Vec<f64>,
    pub(super) z: Vec<f64>,
    pub(super) values: Vec<f64>,
}

impl Step {
    fn add(&mut self, more: &Self, sign: f64) {
        for (sums, changes) in [(&mut self.x, &more.x), (&mut self.z, &more.z), (&mut self.values, &more.values)] {
            for (sum, change) in sums.iter_mut().zip(changes) {
                *sum += sign * change;
            }
        }
    }
}

/// The factored system.
pub(super) struct Newton {
    normal: Normal,
    factor: Factor,
    schur: Schur,
    weights: Vec<f64>,
    factored: Vec<f64>,
}

impl Newton {
    pub(super) fn new(scaled: &Scaled) -> Self {
        let normal = Normal::new(&scaled.quadratic, &scaled.rows, &scaled.inside);
        let factor = Factor::new(&normal);
        let m = scaled.rows.row_count();
        Self { normal, factor, schur: Schur::default(), weights: vec![0.0; m], factored: vec![0.0; m] }
    }

    /// Factors for the weights W of the inequalities; false if N is not positive definite whatever is added.
    pub(super) fn factor(&mut self, scaled: &Scaled, weights: &[f64]) -> bool {
        self.weights.copy_from_slice(weights);
        let most = weights.iter().fold(0.0_f64, |most, weight| most.max(*weight));
        let equality = (EQUALITY_RATIO * most).clamp(EQUALITY_WEIGHTS[0], EQUALITY_WEIGHTS[1]);
        for (row, weight) in weights.iter().enumerate() {
            self.factored[row] = if scaled.equal[row] { equality } else { *weight };
        }
        self.normal.assemble(&scaled.quadratic, &scaled.rows, &scaled.inside, &self.factored);
        for lift in LIFTS {
            self.normal.lift(PROXIMAL, lift);
            let ok = self.factor.factor(&self.normal);
            if ok {
                self.schur.form(scaled, &mut self.factor, weights);
                return true;
            }
        }
        false
    }

    /// One solve with the factors, without refinement.
    pub(super) fn pass(&mut self, scaled: &Scaled, right: &Right) -> Step {
        let mut x = right.f.clone();
        let mut pull = right.g.clone();
        for (row, value) in pull.iter_mut().enumerate() {
            if !scaled.inside[row] {
                *value = 0.0;
            } else if scaled.equal[row] {
                *value *= self.factored[row];
            }
        }
        scaled.rows.add_transposed_product(&pull, &mut x);
        self.factor.solve(&mut x);
        let outer = self.schur.solve(scaled, &mut x, &right.g);
        let values = scaled.rows.apply(&x);
        let mut z = vec![0.0; right.g.len()];
        for (row, value) in z.iter_mut().enumerate() {
            if scaled.inside[row] {
                *value = self.factored[row] * values[row] - pull[row];
            }
        }
        for (&row, value) in scaled.outside.iter().zip(outer) {
            z[row] = value;
        }
        Step { x, z, values }
    }

    /// What is left of the right side; the largest entries of both parts.
    fn rest(&self, scaled: &Scaled, right: &Right, step: &Step) -> (Right, f64, f64) {
        let mut f = vec![0.0; right.f.len()];
        scaled.quadratic.add_product(&step.x, &mut f);
        scaled.rows.add_transposed_product(&step.z, &mut f);
        let mut g = vec![0.0; right.g.len()];
        let (mut first, mut second) = (0.0_f64, 0.0_f64);
        for (value, wanted) in f.iter_mut().zip(&right.f) {
            *value = wanted - *value;
            first = first.max(value.abs());
        }
        for (row, value) in g.iter_mut().enumerate() {
            if scaled.equal[row] {
                *value = right.g[row] - step.values[row];
            } else if !scaled.inside[row] {
                *value = right.g[row] - step.values[row] + step.z[row] * inverse(self.weights[row]);
            }
            second = second.max(value.abs());
        }
        (Right { f, g }, first, second)
    }

    /// Solves, refined until what is left is below the tolerances or no longer falls.
    pub(super) fn solve(&mut self, scaled: &Scaled, right: &Right, tolerance: [f64; 2]) -> Step {
        let mut step = self.pass(scaled, right);
        self.refine(scaled, right, tolerance, &mut step);
        step
    }

    /// Refines a solution of [`Newton::pass`].
    pub(super) fn refine(&mut self, scaled: &Scaled, right: &Right, tolerance: [f64; 2], step: &mut Step) {
        let (mut rest, mut first, mut second) = self.rest(scaled, right, step);
        for _ in 0..ROUNDS {
            if first <= tolerance[0] && second <= tolerance[1] {
                return;
            }
            let more = self.pass(scaled, &rest);
            step.add(&more, 1.0);
            let (next, a, b) = self.rest(scaled, right, step);
            let (before, after) = (first / tolerance[0] + second / tolerance[1], a / tolerance[0] + b / tolerance[1]);
            if after.is_nan() || after >= before {
                step.add(&more, -1.0);
                return;
            }
            (rest, first, second) = (next, a, b);
            if after > 0.5 * before {
                return;
            }
        }
    }
}
