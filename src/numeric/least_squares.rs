//! Least squares with a banded matrix by Givens rotations.
//!
//! Each row of the data has its nonzero entries in `band` successive columns. It is rotated into the triangle R as it
//! comes, which costs O(band (band + width)) a column it passes and never squares the condition number (Golub & Van
//! Loan 2013, 5.2.5; Bjorck 1996, section 6.2).

use super::banded::SingularMatrix;

/// Triangle R of A = Q R and Q' b, for `width` right-hand sides at once.
#[derive(Debug, Clone)]
pub struct BandedLeastSquares {
    columns: usize,
    band: usize,
    width: usize,
    /// Row k holds the columns k .. k + band.
    triangle: Vec<f64>,
    right: Vec<f64>,
    largest: f64,
}

impl BandedLeastSquares {
    /// No data yet; unknowns `columns` x `width`.
    #[must_use]
    pub fn new(columns: usize, band: usize, width: usize) -> Self {
        let band = band.max(1);
        Self {
            columns,
            band,
            width,
            triangle: vec![0.0; columns * band],
            right: vec![0.0; columns * width],
            largest: 0.0,
        }
    }

    /// Adds the data sum_k `entries[k]` x\[`first` + k\] = `right`.
    ///
    /// # Panics
    /// When there are more entries than the band or columns allow, or `right` is shorter than the width.
    pub fn add(&mut self, first: usize, entries: &[f64], right: &[f64]) {
        let band = self.band;
        let mut row = vec![0.0; band];
        row[..entries.len()].copy_from_slice(entries);
        let mut right = right[..self.width].to_vec();
        self.largest = entries.iter().fold(self.largest, |m, x| m.max(x.abs()));
        for k in first..self.columns {
            // Here `row` starts at column k; the rotations fill it from the rows above until nothing is left.
            if row.iter().all(|&entry| entry == 0.0) {
                break;
            }
            let above = &mut self.triangle[k * band..(k + 1) * band];
            if row[0] != 0.0 {
                let length = above[0].hypot(row[0]);
                let (c, s) = (above[0] / length, row[0] / length);
                for (a, b) in above.iter_mut().zip(&mut row) {
                    (*a, *b) = (c * *a + s * *b, c * *b - s * *a);
                }
                for (a, b) in self.right[k * self.width..(k + 1) * self.width].iter_mut().zip(&mut right) {
                    (*a, *b) = (c * *a + s * *b, c * *b - s * *a);
                }
            }
            row.rotate_left(1);
            row[band - 1] = 0.0;
        }
    }

    /// The solution x, `width` numbers for each column.
    ///
    /// # Errors
    /// [`SingularMatrix`] when the data do not determine a column: its pivot is below 1e-13 of the largest entry.
    pub fn solve(&self) -> Result<Vec<f64>, SingularMatrix> {
        let (band, width) = (self.band, self.width);
        let mut x = self.right.clone();
        let small = 1e-13 * self.largest;
        let weak = |pivot: f64| pivot.is_nan() || pivot <= small;
        if let Some(column) = (0..self.columns).find(|&k| weak(self.triangle[k * band].abs())) {
            return Err(SingularMatrix { column });
        }
        for k in (0..self.columns).rev() {
            let row = &self.triangle[k * band..(k + 1) * band];
            let (head, tail) = x.split_at_mut((k + 1) * width);
            let own = &mut head[k * width..];
            for (factor, known) in row[1..].iter().zip(tail.chunks_exact(width)) {
                own.iter_mut().zip(known).for_each(|(a, b)| *a -= factor * b);
            }
            own.iter_mut().for_each(|a| *a /= row[0]);
        }
        Ok(x)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn residual_is_orthogonal_to_the_columns() {
        let (rows, columns, band) = (40, 12, 3);
        let entry = |i: usize, k: usize| ((i * 7 + k * 5) % 9) as f64 - 3.5;
        let first = |i: usize| (i * 3) % (columns - band + 1);
        let right = |i: usize| [(i as f64).sin(), (0.3 * i as f64).cos()];
        let mut problem = BandedLeastSquares::new(columns, band, 2);
        for i in 0..rows {
            problem.add(first(i), &[entry(i, 0), entry(i, 1), entry(i, 2)], &right(i));
        }
        let x = problem.solve().unwrap();
        let mut gradient = vec![0.0; columns * 2];
        for i in 0..rows {
            for d in 0..2 {
                let value: f64 = (0..band).map(|k| entry(i, k) * x[(first(i) + k) * 2 + d]).sum();
                for k in 0..band {
                    gradient[(first(i) + k) * 2 + d] += entry(i, k) * (value - right(i)[d]);
                }
            }
        }
        assert!(gradient.iter().all(|g| g.abs() < 1e-12), "{gradient:?}");
    }

    #[test]
    fn missing_data_are_an_error() {
        let mut problem = BandedLeastSquares::new(3, 2, 1);
        problem.add(0, &[1.0, 1.0], &[1.0]);
        problem.add(1, &[1.0], &[2.0]);
        assert_eq!(problem.solve(), Err(SingularMatrix { column: 2 }));
    }
}
