//! The Schur complement S = 1/W_o + A_o N^-1 A_o' of the dense rows, by Cholesky with dependent rows passed over.

use super::factor::Factor;

use super::scaled::Scaled;
use crate::numeric::dense::{Block, subtract_product};

/// Pivots below this part of their diagonal belong to rows that depend on earlier ones.
const DEPENDENT: f64 = 1e-13;

/// V = N^-1 A_o' and the factor of S.
#[derive(Default)]
pub(super) struct Schur {
    columns: Vec<f64>,
    lower: Vec<f64>,
}

impl Schur {
    pub(super) fn form(&mut self, scaled: &Scaled, factor: &mut Factor, weights: &[f64]) {
        let (n, count) = (scaled.linear.len(), scaled.outside.len());
        self.columns.clear();
        self.columns.resize(n * count, 0.0);
        for (place, &row) in scaled.outside.iter().enumerate() {
            let (indices, values) = scaled.rows.row(row);
            for (&index, value) in indices.iter().zip(values) {
                self.columns[place * n + index] = *value;
            }
        }
        let own = self.columns.clone();
        factor.solve_many(&mut self.columns);
        let mut s = vec![0.0; count * count];
        let [own, solved] = [&own, &self.columns].map(|columns| Block::new(columns, [n, count], n));
        subtract_product(&mut s, count, own.transposed(), solved);
        s.iter_mut().for_each(|value| *value = -*value);
        for (i, &row) in scaled.outside.iter().enumerate() {
            if !scaled.equal[row] {
                s[i * count + i] += inverse(weights[row]);
            }
        }
        // Cholesky in place; a dependent row gets an infinite pivot, that is a zero multiplier.
        for j in 0..count {
            let diagonal = s[j * count + j];
            let pivot = diagonal - (0..j).map(|k| s[j * count + k] * s[j * count + k]).sum::<f64>();
            let root = if pivot > DEPENDENT * diagonal.abs() { pivot.sqrt() } else { f64::INFINITY };
            s[j * count + j] = root;
            for i in j + 1..count {
                let sum: f64 = (0..j).map(|k| s[i * count + k] * s[j * count + k]).sum();
                s[i * count + j] = (s[i * count + j] - sum) / root;
            }
        }
        self.lower = s;
    }

    /// Given x = N^-1 r, the multipliers dz_o = S^-1 (A_o x - g_o), and x becomes x - V dz_o.
    pub(super) fn solve(&self, scaled: &Scaled, x: &mut [f64], g: &[f64]) -> Vec<f64> {
        let count = scaled.outside.len();
        let mut z: Vec<f64> = scaled.outside.iter().map(|&row| scaled.rows.dot(row, x) - g[row]).collect();
        for i in 0..count {
            let sum: f64 = (0..i).map(|k| self.lower[i * count + k] * z[k]).sum();
            z[i] = (z[i] - sum) / self.lower[i * count + i];
        }
        for i in (0..count).rev() {
            let sum: f64 = (i + 1..count).map(|k| self.lower[k * count + i] * z[k]).sum();
            z[i] = (z[i] - sum) / self.lower[i * count + i];
        }
        for (place, factor) in z.iter().enumerate() {
            let column = &self.columns[place * x.len()..(place + 1) * x.len()];
            for (value, entry) in x.iter_mut().zip(column) {
                *value -= factor * entry;
            }
        }
        z
    }
}

/// 1/W, bounded where the row does not bind.
pub(super) fn inverse(weight: f64) -> f64 {
    1.0 / weight.max(1e-30)
}
