//! Cholesky factor of a banded symmetric positive definite matrix, and the part of its inverse inside the band.
//!
//! For n rows and w diagonals below the main one: storage O(n w), factor and inverse O(n w^2) in products of dense
//! blocks, a solve O(n w). Rounding: the residual of a solve is at unit roundoff times the size of matrix and solution
//! (Golub & Van Loan 2013, section 4.3).

use super::SingularMatrix;
use super::dense::{Block, divide_by_triangle, dot, factor_panel, subtract_product};

/// Most columns of a panel.
const BLOCK: usize = 48;

/// M = L L' with L lower triangular and banded.
#[derive(Debug, Clone)]
pub struct BandedCholesky {
    panels: Panels,
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

    /// Adds factor * other, whose band is no wider.
    pub fn add_band(&mut self, factor: f64, other: &Self) {
        for i in 0..other.size {
            for j in i.saturating_sub(other.width)..=i {
                self.add(i, j, factor * other.get(i, j));
            }
        }
    }

    /// Sum of the diagonal.
    #[must_use]
    pub fn trace(&self) -> f64 {
        self.rows.iter().skip(self.width).step_by(self.width + 1).sum()
    }

    /// Sum of M_ij N_ij over all entries, which is the trace of M N; both of one shape.
    #[must_use]
    pub fn trace_of_product(&self, other: &Self) -> f64 {
        let rows = self.rows.chunks_exact(self.width + 1).zip(other.rows.chunks_exact(self.width + 1));
        rows.map(|(a, b)| 2.0 * dot(&a[..self.width], &b[..self.width]) + a[self.width] * b[self.width]).sum()
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

    /// x'M x.
    #[must_use]
    pub fn quadratic(&self, x: &[f64]) -> f64 {
        self.apply(x).iter().zip(x).map(|(m, x)| m * x).sum()
    }

    /// a'M a for a row a of rising columns, all within the band of each other.
    #[must_use]
    pub fn quadratic_form(&self, row: impl Iterator<Item = (usize, f64)>) -> f64 {
        let (columns, values): (Vec<usize>, Vec<f64>) = row.unzip();
        // A row of a tensor product is as many columns again and again.
        let run = (1..columns.len()).find(|&k| columns[k] != columns[k - 1] + 1).unwrap_or(1);
        match run {
            4 => self.form_of_runs::<4>(&columns, &values),
            6 => self.form_of_runs::<6>(&columns, &values),
            _ => self.form_of_runs::<1>(&columns, &values),
        }
    }

    /// The same for rows of which R columns each are neighbours, as long as they are.
    fn form_of_runs<const R: usize>(&self, columns: &[usize], values: &[f64]) -> f64 {
        let runs = columns.chunks_exact(R).take_while(|run| run[R - 1] == run[0] + R - 1).count() * R;
        let (w, mut sum) = (self.width, 0.0);
        for (k, (&i, value)) in columns.iter().zip(values).enumerate() {
            let own = &self.rows[i * (w + 1)..(i + 1) * (w + 1)];
            let whole = k.min(runs) / R * R;
            let mut lanes = [0.0; R];
            for (run, others) in columns[..whole].chunks_exact(R).zip(values[..whole].chunks_exact(R)) {
                let from = w + run[0] - i;
                let entries = &own[from..from + R];
                (0..R).for_each(|t| lanes[t] += entries[t] * others[t]);
            }
            let rest: f64 = columns[whole..k].iter().zip(&values[whole..k]).map(|(j, a)| own[w + j - i] * a).sum();
            sum += value * (2.0 * (lanes.iter().sum::<f64>() + rest) + value * own[w]);
        }
        sum
    }

    /// Factors the matrix.
    ///
    /// # Errors
    /// [`SingularMatrix`] at the first pivot that is not above rounding: the matrix is not positive definite.
    pub fn factor(&self) -> Result<BandedCholesky, SingularMatrix> {
        let mut panels = Panels::zeros(self.size, self.width);
        for i in 0..self.size {
            for j in i.saturating_sub(self.width)..=i {
                panels.set(i, j, self.rows[i * (self.width + 1) + self.width + j - i]);
            }
        }
        for p in 0..panels.count() {
            let columns = panels.columns(p);
            let (first, height) = (p * panels.block, panels.height());
            let (done, rest) = panels.values.split_at_mut((p + 1) * panels.block * height);
            let panel = &mut done[p * panels.block * height..];
            let below = Panels::reach(self.size, self.width, first + columns);
            let least = |j: usize| 1e-15 * self.rows[(first + j) * (self.width + 1) + self.width];
            factor_panel(panel, [columns + below, columns], height, &least)
                .map_err(|j| SingularMatrix { column: first + j })?;
            let under = Block::new(panel, [columns + below, columns], height).rows_from(columns, below);
            for (q, panel) in rest.chunks_exact_mut(panels.block * height).enumerate() {
                let offset = q * panels.block;
                if offset >= below {
                    break;
                }
                let columns = panels.block.min(below - offset);
                let (tall, short) = (under.rows_from(offset, below - offset), under.rows_from(offset, columns));
                subtract_product(panel, height, tall, short.transposed());
            }
        }
        Ok(BandedCholesky { panels })
    }
}

/// A lower banded triangle in panels of columns, each a dense block with the columns one after the other: from its own
/// diagonal block down to the last row that a column of it reaches.
#[derive(Debug, Clone)]
struct Panels {
    size: usize,
    width: usize,
    /// Columns of a panel.
    block: usize,
    values: Vec<f64>,
}

impl Panels {
    fn zeros(size: usize, width: usize) -> Self {
        let block = width.clamp(1, BLOCK);
        Self { size, width, block, values: vec![0.0; size.div_ceil(block) * block * (block + width)] }
    }

    fn count(&self) -> usize {
        self.size.div_ceil(self.block)
    }

    fn height(&self) -> usize {
        self.block + self.width
    }

    fn columns(&self, panel: usize) -> usize {
        self.block.min(self.size - panel * self.block)
    }

    /// Rows from `first` on that the columns before it reach.
    fn reach(size: usize, width: usize, first: usize) -> usize {
        width.min(size - first)
    }

    fn place(&self, i: usize, j: usize) -> usize {
        j * self.height() + i - j / self.block * self.block
    }

    fn set(&mut self, i: usize, j: usize, value: f64) {
        let place = self.place(i, j);
        self.values[place] = value;
    }

    /// Columns, each from its diagonal down.
    fn columns_down(&self) -> impl DoubleEndedIterator<Item = (usize, &[f64])> {
        let (height, block, size, width) = (self.height(), self.block, self.size, self.width);
        let panels = self.values.chunks_exact(block * height).enumerate();
        let columns = panels.flat_map(move |(p, panel)| {
            panel.chunks_exact(height).enumerate().map(move |(k, column)| (p * block + k, &column[k..]))
        });
        columns.filter(move |(j, _)| *j < size).map(move |(j, column)| (j, &column[..=width.min(size - 1 - j)]))
    }

    /// A panel: its diagonal block and the rows below.
    fn panel(&self, p: usize) -> Block<'_> {
        let (first, columns, height) = (p * self.block, self.columns(p), self.height());
        let rows = columns + Self::reach(self.size, self.width, first + columns);
        let values = &self.values[first * height..(first + self.block) * height];
        Block::new(values, [rows, columns], height)
    }
}

impl BandedCholesky {
    /// Solves M x = b in place.
    pub fn solve(&self, b: &mut [f64]) {
        self.forward(b);
        for (j, column) in self.panels.columns_down().rev() {
            let (known, own) = (&b[j + 1..j + column.len()], b[j]);
            b[j] = (own - dot(&column[1..], known)) / column[0];
        }
    }

    /// Solves M X = B in place for `count` right-hand sides, which are the columns of B; B is given row by row.
    pub fn solve_columns(&self, b: &mut [f64], count: usize) {
        for (j, column) in self.panels.columns_down() {
            let (done, rest) = b.split_at_mut((j + 1) * count);
            let own = &mut done[j * count..];
            own.iter_mut().for_each(|value| *value /= column[0]);
            for (row, entry) in rest.chunks_exact_mut(count).zip(&column[1..]) {
                row.iter_mut().zip(&*own).for_each(|(b, value)| *b -= entry * value);
            }
        }
        for (j, column) in self.panels.columns_down().rev() {
            let (open, known) = b.split_at_mut((j + 1) * count);
            let own = &mut open[j * count..];
            for (row, entry) in known.chunks_exact(count).zip(&column[1..]) {
                own.iter_mut().zip(row).for_each(|(b, value)| *b -= entry * value);
            }
            own.iter_mut().for_each(|value| *value /= column[0]);
        }
    }

    /// Solves L y = b in place; |y|^2 = b'M^-1 b.
    pub fn forward(&self, b: &mut [f64]) {
        for (j, column) in self.panels.columns_down() {
            let value = b[j] / column[0];
            b[j] = value;
            b[j + 1..j + column.len()].iter_mut().zip(&column[1..]).for_each(|(b, entry)| *b -= entry * value);
        }
    }

    /// log det M.
    #[must_use]
    pub fn log_determinant(&self) -> f64 {
        2.0 * self.panels.columns_down().map(|(_, column)| column[0].ln()).sum::<f64>()
    }

    /// The entries of M^-1 inside the band (Takahashi, Fagan & Chin 1973; Erisman & Tinney 1975), a panel J at a time
    /// from the last one on: with S the rows below that J reaches and Y = L_SJ L_JJ^-1,
    ///
    /// ```text
    /// Z_SJ = -Z_SS Y,   Z_JJ = (L_JJ L_JJ')^-1 - Y'Z_SJ.
    /// ```
    #[must_use]
    pub fn inverse_band(&self) -> SymmetricBand {
        let (n, w, block) = (self.panels.size, self.panels.width, self.panels.block);
        let mut inverse = Panels::zeros(n, w);
        let height = inverse.height();
        let [mut scaled, mut under_block] = [vec![0.0; w * block], vec![0.0; w * block]];
        let [mut unit, mut negative] = [vec![0.0; block * block], vec![0.0; block * block]];
        for p in (0..inverse.count()).rev() {
            let columns = inverse.columns(p);
            let below = Panels::reach(n, w, p * block + columns);
            let factor = self.panels.panel(p);
            let (triangle, under) = (factor.rows_from(0, columns), factor.rows_from(columns, below));
            // Y: columns of the block stand `below` apart.
            let y = &mut scaled[..below * columns];
            under.copy_to(y);
            divide_by_triangle(y, below, below, triangle);
            let y = Block::new(y, [below, columns], below);
            let (own, later) = inverse.values.split_at_mut((p + 1) * block * height);
            let own = &mut own[p * block * height..];
            for (q, panel) in later.chunks_exact(block * height).enumerate() {
                let offset = q * block;
                if offset >= below {
                    break;
                }
                let across = block.min(below - offset);
                let further = below - offset - across;
                let panel = Block::new(panel, [below - offset, across], height);
                let (near, far) = (y.rows_from(offset, across), y.rows_from(offset + across, further));
                let target = &mut own[columns + offset..];
                subtract_product(target, height, panel, near);
                subtract_product(target, height, panel.rows_from(across, further).transposed(), far);
            }
            // Z_JJ = (L^-1)'L^-1 - Y'Z_SJ: the product of -(L^-1)' and L^-1 is subtracted.
            unit.fill(0.0);
            (0..columns).for_each(|j| unit[j * block + j] = 1.0);
            divide_by_triangle(&mut unit, columns, block, triangle);
            negative.iter_mut().zip(&unit).for_each(|(negative, value)| *negative = -value);
            let [lower, minus] = [&unit, &negative].map(|values| Block::new(values, [columns, columns], block));
            for j in 0..columns {
                under_block[j * below..(j + 1) * below].copy_from_slice(&own[j * height + columns..][..below]);
            }
            let under = Block::new(&under_block, [below, columns], below);
            subtract_product(own, height, minus.transposed(), lower);
            subtract_product(own, height, y.transposed(), under);
            // Both halves of the diagonal block are read by the panels before.
            for j in 0..columns {
                for i in 0..j {
                    own[j * height + i] = own[i * height + j];
                }
            }
        }
        let mut band = SymmetricBand::zeros(n, w);
        for (j, column) in inverse.columns_down() {
            for (i, value) in (j..).zip(column) {
                band.rows[i * (w + 1) + w + j - i] = *value;
            }
        }
        band
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
        let mut pairs: Vec<f64> = b.iter().flat_map(|value| [*value, -2.0 * value]).collect();
        let factor = matrix.factor().unwrap();
        factor.solve(&mut b);
        assert!(x.iter().zip(&b).all(|(x, b)| (x - b).abs() < 1e-14), "{b:?}");
        factor.solve_columns(&mut pairs, 2);
        assert!(x.iter().zip(pairs.chunks(2)).all(|(x, b)| (x - b[0]).abs().max((-2.0 * x - b[1]).abs()) < 1e-14));
        let form = matrix.quadratic_form([(3, 1.0), (5, -2.0), (8, 0.5)].into_iter());
        let spread: Vec<f64> =
            (0..40).map(|i| [(3, 1.0), (5, -2.0), (8, 0.5)].iter().find(|e| e.0 == i).map_or(0.0, |e| e.1)).collect();
        let product = matrix.quadratic(&spread);
        assert!((form - product).abs() < 1e-14);
        let trace: f64 = (0..40).map(|j| (0..40).map(|i| matrix.get(i, j) * matrix.get(j, i)).sum::<f64>()).sum();
        assert!((matrix.trace_of_product(&matrix) / trace - 1.0).abs() < 1e-14);
        // Runs as of a tensor product, the last one cut short.
        let columns = [2, 3, 4, 5, 8, 9, 10, 11, 13, 14];
        let long = example(40, 12);
        let mut spread = vec![0.0; 40];
        columns.iter().for_each(|&k| spread[k] = (k as f64).cos());
        let product = long.quadratic(&spread);
        assert!((long.quadratic_form(columns.iter().map(|&k| (k, spread[k]))) - product).abs() < 1e-14);
    }

    #[test]
    fn inverse_inside_the_band() {
        for (n, w) in [(1, 0), (5, 4), (30, 5), (12, 0), (131, 60), (96, 48), (97, 95)] {
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

    /// The tridiagonal matrix of 2 and -1 has the determinant n + 1.
    #[test]
    fn determinant_of_second_differences() {
        let mut matrix = SymmetricBand::zeros(70, 1);
        for i in 0..70 {
            matrix.add(i, i, 2.0);
            if i > 0 {
                matrix.add(i, i - 1, -1.0);
            }
        }
        assert!((matrix.factor().unwrap().log_determinant() - 71f64.ln()).abs() < 1e-13);
    }

    #[test]
    fn what_is_not_positive_definite_is_told() {
        let mut matrix = example(10, 2);
        matrix.add(4, 4, -20.0);
        assert_eq!(matrix.factor().unwrap_err(), SingularMatrix { column: 4 });
    }
}
