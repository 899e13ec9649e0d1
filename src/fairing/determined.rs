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

/// An orthonormal basis of equalities; unknowns that one alone gives are no part of it.
#[derive(Debug, Default)]
pub(super) struct Determined {
    /// Values of unknowns.
    given: Vec<Option<f64>>,
    /// Vectors over the others with the value that x has along each.
    basis: Vec<(Vec<f64>, f64)>,
}

impl Determined {
    /// Over so many unknowns.
    pub(super) fn new(size: usize) -> Self {
        Self { given: vec![None; size], basis: Vec::new() }
    }

    /// Whether there are any.
    pub(super) fn is_empty(&self) -> bool {
        self.basis.is_empty() && self.given.iter().all(Option::is_none)
    }

    /// Takes an equality; false when it follows from those before. Those of one unknown are best taken first: they cost
    /// nothing, and others a product with every one of their like.
    pub(super) fn take(&mut self, row: &Row, value: f64) -> bool {
        let norm = row.iter().map(|(_, a)| a * a).sum::<f64>().sqrt();
        if norm <= 0.0 {
            return value.abs() > SLACK;
        }
        let mut rest = value / norm;
        let mut open: Row = Vec::with_capacity(row.len());
        for &(i, a) in row {
            match self.given[i] {
                Some(given) => rest -= a / norm * given,
                None => open.push((i, a / norm)),
            }
        }
        if let [(i, a)] = open[..]
            && a.abs() > SPANNED
            && self.basis.is_empty()
        {
            self.given[i] = Some(rest / a);
            return true;
        }
        let mut vector = vec![0.0; self.given.len()];
        open.iter().for_each(|&(i, a)| vector[i] += a);
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
        let given = |&(i, a): &(usize, f64)| self.given[i].map(|given| (a, given));
        for (a, given) in row.iter().filter_map(given) {
            left -= a * a;
            value += a * given;
        }
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

    #[test]
    fn unknowns_that_are_given_count_in_rows_of_several() {
        let mut known = Determined::new(4);
        assert!(known.take(&vec![(1, 2.0)], 6.0) && !known.take(&vec![(1, -1.0)], -3.0));
        assert!(known.take(&vec![(1, 1.0)], 4.0), "a contradiction stays");
        assert!(known.take(&vec![(0, 1.0), (1, 1.0)], 5.0), "gives unknown 0");
        assert!(known.take(&vec![(2, 1.0), (3, 1.0)], 1.0) && known.take(&vec![(3, 1.0)], 7.0));
        assert!(!known.take(&vec![(0, 1.0), (1, 1.0), (2, 1.0)], -1.0));
        assert!(known.decides(&vec![(0, 1.0), (1, 1.0), (3, 1.0)], [12.0, 12.0]));
        assert!(!known.decides(&vec![(0, 1.0), (1, 1.0), (3, 1.0)], [0.0, 11.0]));
    }
}
