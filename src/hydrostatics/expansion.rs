//! Expansions of integrands along a station in Legendre polynomials, whose integrals up to any height cost a few
//! products.

use super::piece::Piece;
use crate::numeric::gauss_legendre;

/// From the values at Gauss nodes to the coefficients of Legendre polynomials.
pub(super) struct Transform {
    /// Number of nodes and of coefficients.
    pub(super) count: usize,
    /// Row j: (2j + 1) / 2 w_k P_j(s_k).
    rows: Vec<f64>,
}

impl Transform {
    pub(super) fn new(count: usize) -> Self {
        let mut rows = vec![0.0; count * count];
        for (k, (s, weight)) in gauss_legendre(count).on(-1.0, 1.0).enumerate() {
            let (mut before, mut now) = (0.0, 1.0);
            for j in 0..count {
                let degree = j as f64;
                rows[j * count + k] = 0.5 * (2.0 * degree + 1.0) * weight * now;
                (before, now) = (now, ((2.0 * degree + 1.0) * s * now - degree * before) / (degree + 1.0));
            }
        }
        Self { count, rows }
    }

    pub(super) fn coefficient<const K: usize>(&self, j: usize, values: &[[f64; K]]) -> [f64; K] {
        let mut sum = [0.0; K];
        for (weight, value) in self.rows[j * self.count..(j + 1) * self.count].iter().zip(values) {
            for (s, v) in sum.iter_mut().zip(value) {
                *s += weight * v;
            }
        }
        sum
    }
}

/// Integrals over a part of a piece, up to any height within it.
pub(super) struct Series<const K: usize> {
    pub(super) piece: Piece,
    /// The part, in t.
    pub(super) part: (f64, f64),
    pub(super) coefficients: Vec<[f64; K]>,
    /// Integrals below it.
    pub(super) below: [f64; K],
}

/// Integrals along a station up to any height.
pub(super) struct Expansion<const K: usize> {
    pub(super) series: Vec<Series<K>>,
    pub(super) total: [f64; K],
}

impl<const K: usize> Expansion<K> {
    /// The upper end of the first piece.
    pub(super) fn first_end(&self) -> f64 {
        self.series.first().map_or(f64::NEG_INFINITY, |series| series.piece.to)
    }

    /// The integrals up to `end`.
    pub(super) fn up_to(&self, end: f64) -> [f64; K] {
        let t_of = |piece: &Piece| {
            let share = ((end - piece.from) / (piece.to - piece.from)).clamp(0.0, 1.0);
            // The inverse of t^2 (3 - 2t).
            if piece.profile { 0.5 - ((1.0 - 2.0 * share).asin() / 3.0).sin() } else { share }
        };
        let below =
            self.series.partition_point(|s| s.piece.to <= end || (s.piece.from < end && s.part.1 <= t_of(&s.piece)));
        let Some(series) = self.series.get(below) else { return self.total };
        let mut sum = series.below;
        if end <= series.piece.from {
            return sum;
        }
        let half = 0.5 * (series.part.1 - series.part.0);
        let s = ((t_of(&series.piece) - series.part.0) / half - 1.0).clamp(-1.0, 1.0);
        // int_(-1)^s P_j = (P_(j + 1) - P_(j - 1)) / (2 j + 1).
        let (mut before, mut now) = (1.0, s);
        for (j, c) in series.coefficients.iter().enumerate() {
            let degree = j as f64;
            let integral = if j == 0 {
                s + 1.0
            } else {
                let next = ((2.0 * degree + 1.0) * s * now - degree * before) / (degree + 1.0);
                let integral = (next - before) / (2.0 * degree + 1.0);
                (before, now) = (now, next);
                integral
            };
            for (target, c) in sum.iter_mut().zip(c) {
                *target += half * integral * c;
            }
        }
        sum
    }
}
