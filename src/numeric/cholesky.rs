//! Cholesky factor of a banded symmetric positive definite matrix, and the part of its inverse inside the band.
//!
//! For n rows and w diagonals below the main one: storage O(n w), factor and inverse O(n w^2) in products of dense
//! blocks, a solve O(n w). Rounding: the residual of a solve is at unit roundoff times the size of matrix and solution
//! (Golub & Van Loan 2013, section 4.3).

use super::SingularMatrix;
use super::dense::{Block, divide_by_triangle, dot, factor_panel, subtract_product};

/// Most columns of a panel.
const BLOCK: usize = 32;

/// M = L L' with L lower triangular and banded.
#[derive(Debug, Clone)]
pub struct BandedCholesky {
    panels: Panels,
}

/// A symmetric banded matrix: its lower half, column by column from the diagonal down.
#[derive(Debug, Clone, PartialEq)]
pub struct SymmetricBand {
    size: usize,
    width: usize,
    columns: Vec<f64>,
}

impl SymmetricBand {
    /// A zero matrix of `size` rows with `width` diagonals below the main one.
    #[must_use]
    pub fn zeros(size: usize, width: usize) -> Self {
        Self { size, width, columns: vec![0.0; size * (width + 1)] }
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
        (row - column <= self.width).then(|| column * (self.width + 1) + row - column)
    }

    /// Columns, each from its diagonal down to the last row of the band.
    fn columns_down(&self) -> impl Iterator<Item = (usize, &[f64])> {
        let last = self.size.saturating_sub(1);
        let columns = self.columns.chunks_exact(self.width + 1).enumerate();
        columns.map(move |(j, column)| (j, &column[..=self.width.min(last - j)]))
    }

    /// Adds to the entry (i, j), and so to (j, i). Outside the band nothing can be added.
    pub fn add(&mut self, i: usize, j: usize, value: f64) {
        debug_assert!(i.abs_diff(j) <= self.width, "({i}, {j}) outside {} diagonals", self.width);
        if let Some(place) = self.place(i, j) {
            self.columns[place] += value;
        }
    }

    /// Adds to the entries (i, j), (i + 1, j) and so on, from the diagonal on and inside the band.
    pub fn add_run(&mut self, i: usize, j: usize, values: &[f64]) {
        let place = j * (self.width + 1) + i - j;
        self.columns[place..place + values.len()].iter_mut().zip(values).for_each(|(sum, value)| *sum += value);
    }

    /// The matrix with rows and columns of the unit matrix in some places. Its determinant is that of the other rows and
    /// columns.
    #[must_use]
    pub fn without(mut self, places: &[usize]) -> Self {
        let (w, last) = (self.width, self.size.saturating_sub(1));
        for &k in places {
            (k.saturating_sub(w)..k).for_each(|j| self.columns[j * (w + 1) + k - j] = 0.0);
            self.columns[k * (w + 1)..=k * (w + 1) + w.min(last - k)].fill(0.0);
            self.columns[k * (w + 1)] = 1.0;
        }
        self
    }

    /// The entry (i, j); 0 outside the band.
    #[must_use]
    pub fn get(&self, i: usize, j: usize) -> f64 {
        self.place(i, j).map_or(0.0, |place| self.columns[place])
    }

    /// self + factor * other, for matrices of one shape.
    #[must_use]
    pub fn plus(&self, factor: f64, other: &Self) -> Self {
        let columns = self.columns.iter().zip(&other.columns).map(|(a, b)| a + factor * b).collect();
        Self { columns, ..*self }
    }

    /// Adds factor * other, whose band is no wider.
    pub fn add_band(&mut self, factor: f64, other: &Self) {
        let columns = self.columns.chunks_exact_mut(self.width + 1);
        for (own, (_, added)) in columns.zip(other.columns_down()) {
            own.iter_mut().zip(added).for_each(|(own, added)| *own += factor * added);
        }
    }

    /// Sum of the diagonal.
    #[must_use]
    pub fn trace(&self) -> f64 {
        self.columns.iter().step_by(self.width + 1).sum()
    }

    /// Sum of M_ij N_ij over all entries, which is the trace of M N; both of one shape.
    #[must_use]
    pub fn trace_of_product(&self, other: &Self) -> f64 {
        let pairs = self.columns.chunks_exact(self.width + 1).zip(other.columns.chunks_exact(self.width + 1));
        pairs.map(|(a, b)| 2.0 * dot(&a[1..], &b[1..]) + a[0] * b[0]).sum()
    }

    /// M x.
    #[must_use]
    pub fn apply(&self, x: &[f64]) -> Vec<f64> {
        let mut product = vec![0.0; self.size];
        for (j, column) in self.columns_down() {
            let (own, below) = (x[j], &column[1..]);
            product[j] += column[0] * own + dot(below, &x[j + 1..]);
            product[j + 1..].iter_mut().zip(below).for_each(|(sum, value)| *sum += value * own);
        }
        product
    }

    /// x'M x.
    #[must_use]
    pub fn quadratic(&self, x: &[f64]) -> f64 {
        self.columns_down().map(|(j, column)| x[j] * (column[0] * x[j] + 2.0 * dot(&column[1..], &x[j + 1..]))).sum()
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
        for (k, (&j, value)) in columns.iter().zip(values).enumerate() {
            let own = &self.columns[j * (w + 1)..(j + 1) * (w + 1)];
            // Whole runs below, and what is below one by one.
            let whole = if k < runs { (k + 1).next_multiple_of(R)..runs } else { k + 1..k + 1 };
            let mut lanes = [0.0; R];
            let pairs = columns[whole.clone()].chunks_exact(R).zip(values[whole.clone()].chunks_exact(R));
            for (run, others) in pairs {
                let entries = &own[run[0] - j..run[0] - j + R];
                (0..R).for_each(|t| lanes[t] += entries[t] * others[t]);
            }
            let single = (k + 1..whole.start).chain(whole.end..columns.len());
            let rest: f64 = single.map(|t| own[columns[t] - j] * values[t]).sum();
            sum += value * (2.0 * (lanes.iter().sum::<f64>() + rest) + value * own[0]);
        }
        sum
    }

    /// Factors the matrix.
    ///
    /// # Errors
    /// [`SingularMatrix`] at the first pivot that is not above rounding: the matrix is not positive definite.
    pub fn factor(&self) -> Result<BandedCholesky, SingularMatrix> {
        let copy = |j: usize, column: &mut [f64]| {
            column.copy_from_slice(&self.columns[j * (self.width + 1)..(j + 1) * (self.width + 1)]);
        };
        Panels::new(self.size, self.width, copy).factored()
    }

    /// Factors self + factor * other, for matrices of one shape.
    ///
    /// # Errors
    /// As [`Self::factor`].
    pub fn factor_plus(&self, factor: f64, other: &Self) -> Result<BandedCholesky, SingularMatrix> {
        let add = |j: usize, column: &mut [f64]| {
            let place = j * (self.width + 1)..(j + 1) * (self.width + 1);
            let pairs = self.columns[place.clone()].iter().zip(&other.columns[place]);
            column.iter_mut().zip(pairs).for_each(|(sum, (a, b))| *sum = a + factor * b);
        };
        Panels::new(self.size, self.width, add).factored()
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

    /// What `fill` writes to the columns, from their diagonals on.
    fn new(size: usize, width: usize, fill: impl Fn(usize, &mut [f64])) -> Self {
        let mut panels = Self::zeros(size, width);
        for j in 0..size {
            let place = panels.place(j, j);
            fill(j, &mut panels.values[place..=place + width]);
        }
        panels
    }

    fn factored(mut self) -> Result<BandedCholesky, SingularMatrix> {
        let (block, height) = (self.block, self.height());
        let least: Vec<f64> = (0..self.size).map(|j| 1e-15 * self.values[self.place(j, j)]).collect();
        for p in 0..self.count() {
            let (columns, first) = (self.columns(p), p * block);
            let (done, rest) = self.values.split_at_mut((p + 1) * block * height);
            let panel = &mut done[p * block * height..];
            let below = Self::reach(self.size, self.width, first + columns);
            factor_panel(panel, [columns + below, columns], height, &|j| least[first + j])
                .map_err(|j| SingularMatrix { column: first + j })?;
            let under = Block::new(panel, [columns + below, columns], height).rows_from(columns, below);
            for (q, panel) in rest.chunks_exact_mut(block * height).enumerate() {
                let offset = q * block;
                if offset >= below {
                    break;
                }
                let columns = block.min(below - offset);
                let (tall, short) = (under.rows_from(offset, below - offset), under.rows_from(offset, columns));
                subtract_product(panel, height, tall, short.transposed());
            }
        }
        Ok(BandedCholesky { panels: self })
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

    /// The first entries of a column, from its diagonal down.
    fn diagonal(&self, j: usize, count: usize) -> &[f64] {
        let place = self.place(j, j);
        &self.values[place..place + count]
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
        self.backward(b);
    }

    /// Solves L'x = y in place.
    pub fn backward(&self, b: &mut [f64]) {
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

    /// Solves M X = B in place for right-hand sides that follow one another, in products of dense blocks.
    pub fn solve_blocks(&self, b: &mut [f64]) {
        self.forward_blocks(b);
        self.backward_blocks(b);
    }

    /// Solves L Y = B in place for right-hand sides that follow one another. Those that begin with zeros cost less where the
    /// ones before them do not begin with more.
    pub fn forward_blocks(&self, b: &mut [f64]) {
        let (n, block) = (self.panels.size, self.panels.block);
        if b.is_empty() || n == 0 {
            return;
        }
        let first_of = |b: &[f64]| b.iter().position(|value| value.abs() > 0.0).unwrap_or(n);
        let firsts: Vec<usize> = b.chunks_exact(n).map(first_of).collect();
        let mut known = Vec::new();
        for p in 0..self.panels.count() {
            let (panel, columns, first) = (self.panels.panel(p), self.panels.columns(p), p * block);
            // The last of those that have begun.
            let count = firsts.iter().rposition(|begins| *begins < first + columns).map_or(0, |last| last + 1);
            known.clear();
            for b in b.chunks_exact_mut(n).take(count) {
                let own = &mut b[first..first + columns];
                for j in 0..columns {
                    let column = self.panels.diagonal(first + j, columns - j);
                    own[j] /= column[0];
                    let value = own[j];
                    own[j + 1..].iter_mut().zip(&column[1..]).for_each(|(b, entry)| *b -= entry * value);
                }
                known.extend_from_slice(own);
            }
            let under = panel.rows_from(columns, panel.rows() - columns);
            if let Some(below) = b.get_mut(first + columns..) {
                subtract_product(below, n, under, Block::new(&known, [columns, count], columns));
            }
        }
    }

    /// Solves L'X = Y in place for right-hand sides that follow one another.
    pub fn backward_blocks(&self, b: &mut [f64]) {
        let (n, block) = (self.panels.size, self.panels.block);
        let count = b.len() / n.max(1);
        if count == 0 {
            return;
        }
        let mut known = Vec::new();
        for p in (0..self.panels.count()).rev() {
            let (panel, columns, first) = (self.panels.panel(p), self.panels.columns(p), p * block);
            let below = panel.rows() - columns;
            known.clear();
            b.chunks_exact(n).for_each(|b| known.extend_from_slice(&b[first + columns..first + panel.rows()]));
            let under = panel.rows_from(columns, below).transposed();
            subtract_product(&mut b[first..], n, under, Block::new(&known, [below, count], below));
            for b in b.chunks_exact_mut(n) {
                let own = &mut b[first..first + columns];
                for j in (0..columns).rev() {
                    let column = self.panels.diagonal(first + j, columns - j);
                    own[j] = (own[j] - dot(&column[1..], &own[j + 1..])) / column[0];
                }
            }
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
            band.columns[j * (w + 1)..][..column.len()].copy_from_slice(column);
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
            let mut units: Vec<f64> = (0..n * n).map(|k| if k % (n + 1) == 0 { 1.0 } else { 0.0 }).collect();
            factor.solve_blocks(&mut units);
            for j in 0..n {
                let mut unit = vec![0.0; n];
                unit[j] = 1.0;
                factor.solve(&mut unit);
                assert!(unit.iter().zip(&units[j * n..]).all(|(a, b)| (a - b).abs() < 1e-14), "{j} of {n}, {w}");
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
