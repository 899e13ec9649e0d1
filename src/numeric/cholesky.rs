//! Cholesky factor of a banded symmetric positive definite matrix, and the part of its inverse inside the band.
//!
//! For n rows and w diagonals below the main one: storage O(n w), factor and inverse O(n w^2), a solve O(n w). Rounding: the
//! residual of a solve is at unit roundoff times the size of matrix and solution (Golub & Van Loan 2013, section 4.3).

use super::SingularMatrix;

/// M = L L' with L lower triangular and banded.
#[derive(Debug, Clone)]
pub struct BandedCholesky {
    size: usize,
    width: usize,
    /// Row i: columns i - w ..= i, padded with zeros on the left.
    rows: Vec<f64>,
}

/// A symmetric banded matrix: its lower half, row by row.
#[derive(Debug, Clone, PartialEq)]
pub struct SymmetricBand {
    size: usize,
    width: usize,
    rows: Vec<f64>,
}

impl SymmetricBand {
    /// A zero matrix of `size` rows with `width` diagonals below the main one.
    #[must_use]
    pub fn zeros(size: usize, width: usize) -> Self {
        Self { size, width, rows: vec![0.0; size * (width + 1)] }
    }

    /// Number of rows.
    #[must_use]
    pub fn size(&self) -> usize {
        self.size
    }

    /// Diagonals below the main one.
    #[must_use]
    pub fn width(&self) -> usize {
        self.width
    }

    fn place(&self, i: usize, j: usize) -> Option<usize> {
        let (row, column) = if i >= j { (i, j) } else { (j, i) };
        (row - column <= self.width).then(|| row * (self.width + 1) + self.width + column - row)
    }

    /// Adds to the entry (i, j), and so to (j, i). Outside the band nothing can be added.
    pub fn add(&mut self, i: usize, j: usize, value: f64) {
        debug_assert!(i.abs_diff(j) <= self.width, "({i}, {j}) outside {} diagonals", self.width);
        if let Some(place) = self.place(i, j) {
            self.rows[place] += value;
        }
    }

    /// The entry (i, j); 0 outside the band.
    #[must_use]
    pub fn get(&self, i: usize, j: usize) -> f64 {
        self.place(i, j).map_or(0.0, |place| self.rows[place])
    }

    /// self + factor * other, for matrices of one shape.
    #[must_use]
    pub fn plus(&self, factor: f64, other: &Self) -> Self {
        let rows = self.rows.iter().zip(&other.rows).map(|(a, b)| a + factor * b).collect();
        Self { rows, ..*self }
    }

    /// Sum of the diagonal.
    #[must_use]
    pub fn trace(&self) -> f64 {
        self.rows.iter().skip(self.width).step_by(self.width + 1).sum()
    }

    /// M x.
    #[must_use]
    pub fn apply(&self, x: &[f64]) -> Vec<f64> {
        let w = self.width;
        let mut product = vec![0.0; self.size];
        for i in 0..self.size {
            let first = i.saturating_sub(w);
            let row = &self.rows[i * (w + 1) + w + first - i..=i * (w + 1) + w];
            for (j, value) in (first..i).zip(row) {
                product[i] += value * x[j];
                product[j] += value * x[i];
            }
            product[i] += row[i - first] * x[i];
        }
        product
    }

    /// Factors the matrix.
    ///
    /// # Errors
    /// [`SingularMatrix`] at the first pivot that is not above rounding: the matrix is not positive definite.
    pub fn factor(&self) -> Result<BandedCholesky, SingularMatrix> {
        let w = self.width;
        let stride = w + 1;
        let mut rows = self.rows.clone();
        for i in 0..self.size {
            let first = i.saturating_sub(w);
            let (done, rest) = rows.split_at_mut(i * stride);
            let row = &mut rest[..stride];
            let original = row[w];
            for j in first..i {
                // Columns that both rows hold.
                let from = first.max(j.saturating_sub(w));
                let other = &done[j * stride + w + from - j..j * stride + w];
                let own = &row[w + from - i..w + j - i];
                let sum: f64 = dot(own, other);
                let pivot = done[j * stride + w];
                row[w + j - i] = (row[w + j - i] - sum) / pivot;
            }
            let own = &row[w + first - i..w];
            let pivot = original - dot(own, own);
            if !(pivot > 1e-15 * original && pivot.is_finite()) {
                return Err(SingularMatrix { column: i });
            }
            row[w] = pivot.sqrt();
        }
        Ok(BandedCholesky { size: self.size, width: w, rows })
    }
}

/// Scalar product in four strands, which the compiler turns into vector instructions.
fn dot(a: &[f64], b: &[f64]) -> f64 {
    let mut strands = [0.0; 4];
    let (pairs, rest) = (a.chunks_exact(4).zip(b.chunks_exact(4)), a.len() / 4 * 4);
    for (x, y) in pairs {
        for (strand, (x, y)) in strands.iter_mut().zip(x.iter().zip(y)) {
            *strand += x * y;
        }
    }
    let tail: f64 = a[rest..].iter().zip(&b[rest..]).map(|(x, y)| x * y).sum();
    (strands[0] + strands[1]) + (strands[2] + strands[3]) + tail
}

impl BandedCholesky {
    /// Solves M x = b in place.
    pub fn solve(&self, b: &mut [f64]) {
        self.forward(b);
        let (w, stride) = (self.width, self.width + 1);
        for i in (0..self.size).rev() {
            b[i] /= self.rows[i * stride + w];
            let first = i.saturating_sub(w);
            let value = b[i];
            for (j, entry) in (first..i).zip(&self.rows[i * stride + w + first - i..]) {
                b[j] -= entry * value;
            }
        }
    }

    /// Solves L y = b in place; |y|^2 = b'M^-1 b.
    pub fn forward(&self, b: &mut [f64]) {
        let (w, stride) = (self.width, self.width + 1);
        for i in 0..self.size {
            let first = i.saturating_sub(w);
            let row = &self.rows[i * stride + w + first - i..i * stride + w];
            b[i] = (b[i] - dot(row, &b[first..i])) / self.rows[i * stride + w];
        }
    }

    /// The entries of M^-1 inside the band (Takahashi, Fagan & Chin 1973; Erisman & Tinney 1975): from the last row upwards,
    /// L'Z = L^-1 gives Z_ij = -(1/L_ii) sum_k>i L_ki Z_kj for j > i, and 1/L_ii^2 more on the diagonal.
    #[must_use]
    pub fn inverse_band(&self) -> SymmetricBand {
        let (n, w, stride) = (self.size, self.width, self.width + 1);
        let mut inverse = SymmetricBand::zeros(n, w);
        let mut column = vec![0.0; w];
        for i in (0..n).rev() {
            let last = (i + w).min(n - 1);
            let count = last - i;
            let pivot = self.rows[i * stride + w];
            for (k, value) in (i + 1..=last).zip(column.iter_mut()) {
                *value = self.rows[k * stride + w + i - k];
            }
            for j in (i + 1..=last).rev() {
                // Row j holds Z_jk for k <= j; rows below j hold Z_kj.
                let start = j * stride + w + i + 1 - j;
                let near = &inverse.rows[start..=j * stride + w];
                let mut sum = dot(&column[..near.len()], near);
                for k in j + 1..=last {
                    sum += column[k - i - 1] * inverse.rows[k * stride + w + j - k];
                }
                inverse.rows[j * stride + w + i - j] = -sum / pivot;
            }
            let mut sum = 0.0;
            for k in i + 1..=last {
                sum += column[k - i - 1] * inverse.rows[k * stride + w + i - k];
            }
            debug_assert!(count <= w);
            inverse.rows[i * stride + w] = (1.0 / pivot - sum) / pivot;
        }
        inverse
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn example(n: usize, w: usize) -> SymmetricBand {
        let mut matrix = SymmetricBand::zeros(n, w);
        for i in 0..n {
            for j in i.saturating_sub(w)..i {
                matrix.add(i, j, ((i * 7 + j * 3) % 11) as f64 / 11.0 - 0.4);
            }
            matrix.add(i, i, 2.0 + w as f64);
        }
        matrix
    }

    #[test]
    fn solves_to_rounding() {
        let matrix = example(40, 6);
        let x: Vec<f64> = (0..40).map(|i| (i as f64 * 0.7).sin()).collect();
        let mut b = matrix.apply(&x);
        matrix.factor().unwrap().solve(&mut b);
        assert!(x.iter().zip(&b).all(|(x, b)| (x - b).abs() < 1e-14), "{b:?}");
    }

    #[test]
    fn inverse_inside_the_band() {
        for (n, w) in [(1, 0), (5, 4), (30, 5), (12, 0)] {
            let matrix = example(n, w);
            let factor = matrix.factor().unwrap();
            let inverse = factor.inverse_band();
            for j in 0..n {
                let mut unit = vec![0.0; n];
                unit[j] = 1.0;
                factor.solve(&mut unit);
                for (i, entry) in unit.iter().enumerate().take((j + w).min(n - 1) + 1).skip(j.saturating_sub(w)) {
                    assert!((inverse.get(i, j) - entry).abs() < 1e-14, "({i}, {j}) of {n}, {w}");
                }
            }
        }
    }

    #[test]
    fn what_is_not_positive_definite_is_told() {
        let mut matrix = example(10, 2);
        matrix.add(4, 4, -20.0);
        assert_eq!(matrix.factor().unwrap_err(), SingularMatrix { column: 4 });
    }
}
