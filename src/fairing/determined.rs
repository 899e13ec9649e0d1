//! Rows that equalities decide already: an equality that follows from others, and limits of what is fixed.
//!
//! Lines that are fixed cross each other and cells that are locked, and on a flat every limit of the half-breadth is
//! met by equality. Such rows leave a program without an interior and its multipliers without a value. The equalities
//! are orthonormalised one after another (modified Gram-Schmidt); a row that lies in their span has the value that
//! their right-hand sides give it, and is left out where this is within its limits. A row that they decide otherwise
//! stays: then the wishes cannot all be had.

use super::model::Row;

/// A row with less than this part of its size outside the span of the equalities lies in it.
const SPANNED: f64 = 1e-8;

/// How far a decided value may be off its limits: in the unit of a row of size 1.
const SLACK: f64 = 1e-8;

/// An orthonormal basis of equalities.
#[derive(Debug, Default)]
pub(super) struct Determined {
    size: usize,
    /// Vectors with the value that x has along each.
    basis: Vec<(Vec<f64>, f64)>,
}

impl Determined {
    /// Over so many unknowns.
    pub(super) fn new(size: usize) -> Self {
        Self { size, basis: Vec::new() }
    }

    /// Whether there are any.
    pub(super) fn is_empty(&self) -> bool {
        self.basis.is_empty()
    }

    /// Takes an equality; false when it follows from those before.
    pub(super) fn take(&mut self, row: &Row, value: f64) -> bool {
        let norm = row.iter().map(|(_, a)| a * a).sum::<f64>().sqrt();
        if norm <= 0.0 {
            return value.abs() > SLACK;
        }
        let (mut vector, mut rest) = (vec![0.0; self.size], value / norm);
        row.iter().for_each(|&(i, a)| vector[i] += a / norm);
        for _ in 0..2 {
            for (basis, along) in &self.basis {
                let share: f64 = basis.iter().zip(&vector).map(|(a, b)| a * b).sum();
                if share != 0.0 {
                    vector.iter_mut().zip(basis).for_each(|(a, b)| *a -= share * b);
                    rest -= share * along;
                }
            }
        }
        let left = vector.iter().map(|a| a * a).sum::<f64>().sqrt();
        if left <= SPANNED {
            return rest.abs() > SLACK;
        }
        vector.iter_mut().for_each(|a| *a /= left);
        self.basis.push((vector, rest / left));
        true
    }

    /// Whether the equalities decide a row, and within its limits.
    pub(super) fn decides(&self, row: &Row, [lower, upper]: [f64; 2]) -> bool {
        let norm = row.iter().map(|(_, a)| a * a).sum::<f64>().sqrt();
        let (mut left, mut value) = (norm * norm, 0.0);
        for (basis, along) in &self.basis {
            let share: f64 = row.iter().map(|&(i, a)| a * basis[i]).sum();
            left -= share * share;
            value += share * along;
        }
        let slack = SLACK * norm;
        left <= (1e-6 * norm).powi(2) && value >= lower - slack && value <= upper + slack
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_follows_is_left_out_and_what_contradicts_stays() {
        let mut known = Determined::new(4);
        assert!(known.take(&vec![(0, 1.0), (1, 1.0)], 3.0));
        assert!(known.take(&vec![(1, 2.0), (2, 2.0)], 2.0));
        // The difference of both, and the same against it.
        assert!(!known.take(&vec![(0, 5.0), (2, -5.0)], 10.0));
        assert!(known.take(&vec![(0, 5.0), (2, -5.0)], 11.0));
        assert!(known.decides(&vec![(0, 1.0), (1, 3.0), (2, 2.0)], [4.0, 5.0]));
        assert!(!known.decides(&vec![(0, 1.0), (1, 3.0), (2, 2.0)], [5.5, 6.0]));
        assert!(!known.decides(&vec![(3, 1.0)], [-1e9, 1e9]));
        assert!(!known.is_empty() && Determined::new(2).is_empty());
    }
}
