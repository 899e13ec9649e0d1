//! The iterate, its residuals and how far a direction may go.

use super::super::problem::Interior;
use super::newton::Step;
use super::scaled::Scaled;

/// x, the slacks s_u = u - t, s_l = t - l > 0 (infinite without a limit) and the multipliers; of an equality only z
/// counts.
#[derive(Clone)]
pub(super) struct Iterate {
    pub(super) x: Vec<f64>,
    pub(super) z: Vec<f64>,
    pub(super) upper: Vec<Slack>,
    pub(super) lower: Vec<Slack>,
}

/// A slack with its multiplier.
#[derive(Clone, Copy)]
pub(super) struct Slack {
    pub(super) s: f64,
    pub(super) z: f64,
}

impl Slack {
    /// No limit.
    pub(super) const NONE: Self = Self { s: f64::INFINITY, z: 0.0 };

    pub(super) fn exists(self) -> bool {
        self.s < f64::INFINITY
    }
}

/// How far the conditions of optimality are from holding.
pub(super) struct Residuals {
    /// P x + q + A'z.
    pub(super) dual: Vec<f64>,
    /// t - A x; of an equality b - A x.
    pub(super) primal: Vec<f64>,
    /// Largest of each, relative to the size of its terms (at least 1).
    pub(super) dual_size: f64,
    pub(super) primal_size: f64,
    /// Size of the terms.
    pub(super) dual_scale: f64,
    pub(super) primal_scale: f64,
    /// Sum of s z.
    pub(super) complementarity: f64,
    /// 1/2 x'Px + q'x.
    pub(super) objective: f64,
    /// Largest entry of A'z, and sum of u z^+ - l z^-: the parts of a Farkas proof.
    pub(super) pull: f64,
    pub(super) support: f64,
}

impl Residuals {
    /// The duality gap that a certificate will find: sums of s z and of |z r_p|, and |r_d|_1 |x|_inf.
    pub(super) fn gap(&self, point: &Iterate) -> f64 {
        let reach = point.x.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
        let missed: f64 = self.primal.iter().zip(&point.z).map(|(r, z)| (r * z).abs()).sum();
        self.complementarity + missed + reach * self.dual.iter().map(|value| value.abs()).sum::<f64>()
    }
}

impl Iterate {
    /// Number of slacks.
    pub(super) fn sides(&self) -> usize {
        self.upper.iter().chain(&self.lower).filter(|side| side.exists()).count()
    }

    /// Sum of s z.
    pub(super) fn complementarity(&self) -> f64 {
        self.upper.iter().chain(&self.lower).filter(|side| side.exists()).map(|side| side.s * side.z).sum()
    }

    pub(super) fn residuals(&self, scaled: &Scaled) -> Residuals {
        let n = self.x.len();
        let mut curved = vec![0.0; n];
        scaled.quadratic.add_product(&self.x, &mut curved);
        let mut pull = vec![0.0; n];
        scaled.rows.add_transposed_product(&self.z, &mut pull);
        let (mut objective, mut dual_scale, mut worst, mut largest) = (0.0, 1.0_f64, 0.0_f64, 0.0_f64);
        let mut dual = vec![0.0; n];
        for i in 0..n {
            objective += self.x[i] * (0.5 * curved[i] + scaled.linear[i]);
            dual[i] = curved[i] + scaled.linear[i] + pull[i];
            dual_scale = dual_scale.max(curved[i].abs()).max(scaled.linear[i].abs());
            largest = largest.max(pull[i].abs());
            worst = worst.max(dual[i].abs());
        }
        let (mut primal_scale, mut gap, mut support) = (1.0_f64, 0.0_f64, 0.0);
        let primal: Vec<f64> = (0..self.z.len())
            .map(|row| {
                let value = scaled.rows.dot(row, &self.x);
                let (upper, lower) = (self.upper[row], self.lower[row]);
                let target = if scaled.equal[row] {
                    support += scaled.upper[row] * self.z[row];
                    scaled.upper[row]
                } else {
                    if upper.exists() {
                        support += scaled.upper[row] * upper.z;
                    }
                    if lower.exists() {
                        support -= scaled.lower[row] * lower.z;
                    }
                    if !upper.exists() && !lower.exists() {
                        return 0.0;
                    }
                    if upper.s <= lower.s { scaled.upper[row] - upper.s } else { scaled.lower[row] + lower.s }
                };
                primal_scale = primal_scale.max(value.abs());
                gap = gap.max((target - value).abs());
                target - value
            })
            .collect();
        let dual_scale_all = dual_scale.max(largest);
        Residuals {
            dual,
            primal,
            dual_size: worst / dual_scale_all,
            primal_size: gap / primal_scale,
            dual_scale: dual_scale_all,
            primal_scale,
            complementarity: self.complementarity(),
            objective,
            pull: largest,
            support,
        }
    }

    /// W = z_u/s_u + z_l/s_l.
    pub(super) fn weights(&self) -> Vec<f64> {
        self.upper.iter().zip(&self.lower).map(|(upper, lower)| upper.z / upper.s + lower.z / lower.s).collect()
    }

    /// The largest steps that keep slacks (first) and multipliers (second) at or above 0; infinite where nothing stops
    /// them.
    pub(super) fn longest(&self, direction: &Direction) -> [f64; 2] {
        let mut longest = [f64::INFINITY; 2];
        for row in 0..self.z.len() {
            for (side, ds, dz) in [
                (self.upper[row], -direction.t[row], direction.upper[row]),
                (self.lower[row], direction.t[row], direction.lower[row]),
            ] {
                if ds < 0.0 {
                    longest[0] = longest[0].min(-side.s / ds);
                }
                if dz < 0.0 {
                    longest[1] = longest[1].min(-side.z / dz);
                }
            }
        }
        longest
    }

    /// Mean of (s + a ds)(z + b dz).
    pub(super) fn mean_after(&self, direction: &Direction, [a, b]: [f64; 2], sides: usize) -> f64 {
        let mut sum = 0.0;
        for row in 0..self.z.len() {
            let (upper, lower) = (self.upper[row], self.lower[row]);
            if upper.exists() {
                sum += (upper.s - a * direction.t[row]) * (upper.z + b * direction.upper[row]);
            }
            if lower.exists() {
                sum += (lower.s + a * direction.t[row]) * (lower.z + b * direction.lower[row]);
            }
        }
        sum / sides.max(1) as f64
    }

    /// Goes along a direction.
    pub(super) fn advance(&mut self, direction: &Direction, [a, b]: [f64; 2], equal: &[bool]) {
        for (value, change) in self.x.iter_mut().zip(&direction.step.x) {
            *value += a * change;
        }
        for (row, &equal) in equal.iter().enumerate() {
            if equal {
                self.z[row] += b * direction.step.z[row];
                continue;
            }
            self.upper[row].s -= a * direction.t[row];
            self.lower[row].s += a * direction.t[row];
            self.upper[row].z += b * direction.upper[row];
            self.lower[row].z += b * direction.lower[row];
            self.z[row] = self.upper[row].z - self.lower[row].z;
        }
    }
}

impl Scaled {
    /// An iterate in the units of the problem.
    pub(super) fn interior(&self, point: &Iterate) -> Interior {
        let sides = |row: usize| {
            let (scale, z) = (self.row_scale[row], point.z[row]);
            let sides = if self.equal[row] {
                [z.max(0.0), (-z).max(0.0)].map(|z| Slack { z, ..Slack::NONE })
            } else {
                [point.upper[row], point.lower[row]]
            };
            sides.map(|side| [side.s / scale, side.z * scale / self.objective_scale])
        };
        Interior { x: self.variables(&point.x), rows: (0..point.z.len()).map(|row| Some(sides(row))).collect() }
    }

    /// A slack with its multiplier in the units of the iteration.
    pub(super) fn side(&self, row: usize, [s, z]: [f64; 2]) -> Slack {
        Slack { s: s * self.row_scale[row], z: z * self.objective_scale / self.row_scale[row] }
    }
}

/// A direction: (dx, dz), dt and the changes of the multipliers of both sides.
pub(super) struct Direction {
    pub(super) step: Step,
    pub(super) t: Vec<f64>,
    pub(super) upper: Vec<f64>,
    pub(super) lower: Vec<f64>,
}
