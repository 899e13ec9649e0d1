//! Rows of a sparse matrix, compressed (indices of columns and values, row after row).

/// A sparse matrix stored by rows.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SparseRows {
    columns: usize,
    starts: Vec<usize>,
    indices: Vec<usize>,
    values: Vec<f64>,
}

impl SparseRows {
    /// A matrix without rows, of `columns` columns.
    #[must_use]
    pub fn new(columns: usize) -> Self {
        Self { columns, starts: vec![0], indices: Vec::new(), values: Vec::new() }
    }

    /// The symmetric or general matrix with these entries (row, column, value); entries that name the same place are
    /// added. Columns of a row come out in rising order.
    #[must_use]
    pub fn from_entries(rows: usize, columns: usize, entries: &[(usize, usize, f64)]) -> Self {
        let mut starts = vec![0_usize; rows + 1];
        for &(row, _, _) in entries {
            starts[row + 1] += 1;
        }
        for row in 0..rows {
            starts[row + 1] += starts[row];
        }
        let mut next = starts.clone();
        let mut placed = vec![(0_usize, 0.0); entries.len()];
        for &(row, column, value) in entries {
            placed[next[row]] = (column, value);
            next[row] += 1;
        }
        let mut matrix = Self::new(columns);
        for row in 0..rows {
            let part = &mut placed[starts[row]..starts[row + 1]];
            part.sort_by_key(|entry| entry.0);
            let first = matrix.indices.len();
            for &(column, value) in part.iter() {
                if matrix.indices.len() > first && matrix.indices.last() == Some(&column) {
                    if let Some(last) = matrix.values.last_mut() {
                        *last += value;
                    }
                } else {
                    matrix.indices.push(column);
                    matrix.values.push(value);
                }
            }
            matrix.starts.push(matrix.indices.len());
        }
        matrix
    }

    /// Appends a row; `entries` are (column, value) with rising columns.
    pub fn push(&mut self, entries: impl IntoIterator<Item = (usize, f64)>) {
        for (column, value) in entries {
            debug_assert!(column < self.columns, "column {column} of {}", self.columns);
            self.indices.push(column);
            self.values.push(value);
        }
        self.starts.push(self.indices.len());
    }

    /// (Column, value) of a row, with rising columns.
    pub fn entries(&self, row: usize) -> impl Iterator<Item = (usize, f64)> + Clone + '_ {
        let (columns, values) = self.row(row);
        columns.iter().copied().zip(values.iter().copied())
    }

    /// Number of rows.
    #[must_use]
    pub fn row_count(&self) -> usize {
        self.starts.len() - 1
    }

    /// Number of columns.
    #[must_use]
    pub fn column_count(&self) -> usize {
        self.columns
    }

    /// Number of stored entries.
    #[must_use]
    pub fn entry_count(&self) -> usize {
        self.values.len()
    }

    /// The columns and values of a row.
    #[must_use]
    pub fn row(&self, row: usize) -> (&[usize], &[f64]) {
        let range = self.starts[row]..self.starts[row + 1];
        (&self.indices[range.clone()], &self.values[range])
    }

    /// Whether both have their entries at the same places.
    #[must_use]
    pub fn same_pattern(&self, other: &Self) -> bool {
        self.columns == other.columns && self.starts == other.starts && self.indices == other.indices
    }

    /// The same places with other values, in the order of [`SparseRows::row`].
    #[must_use]
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// Gives every place another value, that of its row, its column and its number in the order of [`SparseRows::values`].
    pub(super) fn refill(&mut self, value: impl Fn(usize, usize, usize) -> f64) {
        for row in 0..self.row_count() {
            for place in self.starts[row]..self.starts[row + 1] {
                self.values[place] = value(row, self.indices[place], place);
            }
        }
    }

    /// Multiplies each row by its factor.
    pub(super) fn scale_rows(&mut self, factors: &[f64]) {
        for (row, factor) in factors.iter().enumerate() {
            self.values[self.starts[row]..self.starts[row + 1]].iter_mut().for_each(|value| *value *= factor);
        }
    }

    /// One row times x.
    #[must_use]
    pub fn dot(&self, row: usize, x: &[f64]) -> f64 {
        let (columns, values) = self.row(row);
        columns.iter().zip(values).map(|(&column, value)| value * x[column]).sum()
    }

    /// A x.
    #[must_use]
    pub fn apply(&self, x: &[f64]) -> Vec<f64> {
        (0..self.row_count()).map(|row| self.dot(row, x)).collect()
    }

    /// A'y.
    #[must_use]
    pub fn apply_transposed(&self, y: &[f64]) -> Vec<f64> {
        let mut product = vec![0.0; self.columns];
        for (row, &factor) in y.iter().enumerate() {
            if factor == 0.0 {
                continue;
            }
            let (columns, values) = self.row(row);
            for (&column, value) in columns.iter().zip(values) {
                product[column] += factor * value;
            }
        }
        product
    }

    /// Largest absolute value of a row; 0 for an empty one.
    #[must_use]
    pub fn row_size(&self, row: usize) -> f64 {
        self.row(row).1.iter().fold(0.0, |largest: f64, value| largest.max(value.abs()))
    }

    /// The same matrix with other places: row r is row `rows[r]` of this one, column c becomes `columns[c]`; the
    /// columns of a row rise. Also where each value comes from, in the order of [`SparseRows::values`].
    pub(super) fn moved(&self, rows: impl Iterator<Item = usize>, columns: &[usize]) -> (Self, Vec<usize>) {
        let mut matrix = Self::new(self.columns);
        let mut origins = Vec::with_capacity(self.values.len());
        let mut part: Vec<(usize, usize)> = Vec::new();
        matrix.indices.reserve(self.values.len());
        matrix.values.reserve(self.values.len());
        for row in rows {
            part.clear();
            part.extend((self.starts[row]..self.starts[row + 1]).map(|origin| (columns[self.indices[origin]], origin)));
            part.sort_unstable();
            for &(column, origin) in &part {
                matrix.indices.push(column);
                matrix.values.push(self.values[origin]);
                origins.push(origin);
            }
            matrix.starts.push(matrix.indices.len());
        }
        (matrix, origins)
    }

    /// sum += A x.
    pub(super) fn add_product(&self, x: &[f64], sum: &mut [f64]) {
        for (row, value) in sum.iter_mut().enumerate() {
            *value += self.dot(row, x);
        }
    }

    /// sum += A'y.
    pub(super) fn add_transposed_product(&self, y: &[f64], sum: &mut [f64]) {
        for (row, &factor) in y.iter().enumerate() {
            if factor != 0.0 {
                let (columns, values) = self.row(row);
                for (&column, value) in columns.iter().zip(values) {
                    sum[column] += factor * value;
                }
            }
        }
    }

    /// The transposed matrix.
    #[must_use]
    pub fn transposed(&self) -> Self {
        let mut starts = vec![0_usize; self.columns + 1];
        for &column in &self.indices {
            starts[column + 1] += 1;
        }
        for column in 0..self.columns {
            starts[column + 1] += starts[column];
        }
        let mut next = starts.clone();
        let mut indices = vec![0; self.indices.len()];
        let mut values = vec![0.0; self.values.len()];
        for row in 0..self.row_count() {
            let (columns, entries) = self.row(row);
            for (&column, &value) in columns.iter().zip(entries) {
                indices[next[column]] = row;
                values[next[column]] = value;
                next[column] += 1;
            }
        }
        Self { columns: self.row_count(), starts, indices, values }
    }
}
