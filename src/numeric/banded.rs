//! LU factors of a banded matrix with partial pivoting.
//!
//! Storage and work for `n` rows and `k` diagonals on each side: O(n k) and O(n k^2) to factor, O(n k) to solve
//! (Golub & Van Loan 2013, section 4.3).

/// The matrix has no inverse: the column at which elimination found no pivot.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("the matrix is singular at column {column}")]
pub struct SingularMatrix {
    /// Column without a pivot, from 0.
    pub column: usize,
}

/// Factors P A = L U of a banded matrix.
#[derive(Debug, Clone)]
pub struct BandedLu {
    size: usize,
    lower: usize,
    width: usize,
    rows: Vec<f64>,
    multipliers: Vec<f64>,
    pivots: Vec<usize>,
}

impl BandedLu {
    /// Factors the matrix of `size` rows whose entries outside `lower` diagonals below and `upper` above the main one are
    /// zero; `entry(row, column)` is asked for the entries inside the band only.
    ///
    /// # Errors
    /// [`SingularMatrix`] when a pivot is zero or not finite.
    pub fn new(
        size: usize,
        lower: usize,
        upper: usize,
        entry: impl Fn(usize, usize) -> f64,
    ) -> Result<Self, SingularMatrix> {
        // Row i holds columns i - lower ..= i + upper + lower, shifted left as elimination proceeds.
        let width = 2 * lower + upper + 1;
        let mut rows = vec![0.0; size * width];
        for i in 0..size {
            let first = i.saturating_sub(lower);
            for j in first..=(i + upper).min(size.saturating_sub(1)) {
                rows[i * width + (j - first)] = entry(i, j);
            }
        }
        let mut multipliers = vec![0.0; size * lower];
        let mut pivots = vec![0; size];
        // Invariant: at step k rows k ..= k+lower start at column k.
        for k in 0..size {
            let last = (k + lower).min(size - 1);
            let mut pivot = k;
            for i in k + 1..=last {
                if rows[i * width].abs() > rows[pivot * width].abs() {
                    pivot = i;
                }
            }
            pivots[k] = pivot;
            let value = rows[pivot * width];
            if value == 0.0 || !value.is_finite() {
                return Err(SingularMatrix { column: k });
            }
            if pivot != k {
                for c in 0..width {
                    rows.swap(k * width + c, pivot * width + c);
                }
            }
            for i in k + 1..=last {
                let factor = rows[i * width] / value;
                multipliers[k * lower + (i - k - 1)] = factor;
                for c in 1..width {
                    rows[i * width + c - 1] = rows[i * width + c] - factor * rows[k * width + c];
                }
                rows[i * width + width - 1] = 0.0;
            }
        }
        Ok(Self { size, lower, width, rows, multipliers, pivots })
    }

    /// Solves A x = b for the right-hand side stored at `values[offset + i * stride]`, in place.
    ///
    /// # Panics
    /// When `values` is too short for the size, offset and stride.
    pub fn solve_strided(&self, values: &mut [f64], offset: usize, stride: usize) {
        let at = |i: usize| offset + i * stride;
        for k in 0..self.size {
            values.swap(at(k), at(self.pivots[k]));
            let head = values[at(k)];
            for i in k + 1..=(k + self.lower).min(self.size - 1) {
                values[at(i)] -= self.multipliers[k * self.lower + (i - k - 1)] * head;
            }
        }
        for k in (0..self.size).rev() {
            let row = &self.rows[k * self.width..(k + 1) * self.width];
            let mut value = values[at(k)];
            for (c, factor) in row.iter().enumerate().skip(1) {
                if k + c >= self.size {
                    break;
                }
                value -= factor * values[at(k + c)];
            }
            values[at(k)] = value / row[0];
        }
    }

    /// Solves A x = b in place.
    ///
    /// # Panics
    /// When `values` is shorter than the matrix.
    pub fn solve(&self, values: &mut [f64]) {
        self.solve_strided(values, 0, 1);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn solves_what_it_factored() {
        let (n, lower, upper) = (23, 3, 2);
        let entry = |i: usize, j: usize| ((i * 7 + j * 13) % 11) as f64 - 4.0 + if i == j { 0.5 } else { 0.0 };
        let inside = |i: usize, j: usize| j + lower >= i && j <= i + upper;
        let exact: Vec<f64> = (0..n).map(|i| (i as f64 * 0.7).sin()).collect();
        let mut b: Vec<f64> =
            (0..n).map(|i| (0..n).filter(|&j| inside(i, j)).map(|j| entry(i, j) * exact[j]).sum()).collect();
        BandedLu::new(n, lower, upper, entry).unwrap().solve(&mut b);
        for (a, e) in b.iter().zip(&exact) {
            assert!((a - e).abs() < 1e-11, "{a} {e}");
        }
    }

    #[test]
    fn a_singular_matrix_is_an_error() {
        let error = BandedLu::new(3, 1, 1, |i, j| if i == 1 || j == 1 { 0.0 } else { 1.0 }).unwrap_err();
        assert_eq!(error, SingularMatrix { column: 1 });
    }
}
