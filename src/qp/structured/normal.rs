//! The normal matrix N = P + A'WA of the sparse rows: its pattern, an ordering with little fill, and its assembly.
//!
//! Every product a_ki a_kj of a row has its place in N looked up once; afterwards an assembly is one pass over the rows.

use super::super::sparse::SparseRows;

/// The lower triangle of N by columns, rows rising.
pub(super) struct Normal {
    pub(super) starts: Vec<usize>,
    pub(super) rows: Vec<usize>,
    pub(super) values: Vec<f64>,
    /// Place in N of the lower entries of P, row after row of P read as a column.
    quadratic_places: Vec<u32>,
    /// Place in N of a_b a_a, a >= b, row after row of A.
    pair_places: Vec<u32>,
}

/// Pattern of the lower triangle of P + A'A over the rows with `inside`, by columns.
fn pattern(quadratic: &SparseRows, rows: &SparseRows, inside: &[bool]) -> (Vec<usize>, Vec<usize>) {
    let n = quadratic.row_count();
    let transposed = rows.transposed();
    let mut seen = vec![usize::MAX; n];
    let (mut starts, mut indices) = (vec![0], Vec::with_capacity(quadratic.entry_count()));
    for column in 0..n {
        let first = indices.len();
        seen[column] = column;
        indices.push(column);
        let mut take = |below: &[usize]| {
            for &index in &below[below.partition_point(|&index| index <= column)..] {
                if seen[index] != column {
                    seen[index] = column;
                    indices.push(index);
                }
            }
        };
        take(quadratic.row(column).0);
        for &row in transposed.row(column).0 {
            if inside[row] {
                take(rows.row(row).0);
            }
        }
        indices[first..].sort_unstable();
        starts.push(indices.len());
    }
    (starts, indices)
}

/// Approximate minimum degree ordering of N (Amestoy, Davis & Duff 1996): the variable that is eliminated k-th, for
/// every k. The natural order where the ordering fails.
pub(super) fn elimination_order(quadratic: &SparseRows, rows: &SparseRows, inside: &[bool]) -> Vec<usize> {
    let n = quadratic.row_count();
    let (starts, indices) = pattern(quadratic, rows, inside);
    amd::order(n, &starts, &indices, &amd::Control::default()).map_or_else(|_| (0..n).collect(), |(order, _, _)| order)
}

impl Normal {
    /// The pattern and the places for matrices in elimination order.
    pub(super) fn new(quadratic: &SparseRows, rows: &SparseRows, inside: &[bool]) -> Self {
        let n = quadratic.row_count();
        let (starts, indices) = pattern(quadratic, rows, inside);
        let mut quadratic_places = Vec::with_capacity(quadratic.entry_count() / 2 + n);
        let mut bases = vec![0_usize; rows.row_count() + 1];
        for row in 0..rows.row_count() {
            let count = if inside[row] { rows.row(row).0.len() } else { 0 };
            bases[row + 1] = bases[row] + count * (count + 1) / 2;
        }
        let mut next = bases.clone();
        let mut pair_places = vec![0_u32; bases[rows.row_count()]];
        let transposed = rows.transposed();
        let mut place = vec![0_u32; n];
        // Columns rise, and so do the places b within a row: the pairs of a row fill in the order of the assembly.
        for column in 0..n {
            for position in starts[column]..starts[column + 1] {
                place[indices[position]] = position as u32;
            }
            for &index in quadratic.row(column).0 {
                if index >= column {
                    quadratic_places.push(place[index]);
                }
            }
            for &row in transposed.row(column).0 {
                if inside[row] {
                    let columns = rows.row(row).0;
                    let first = columns.partition_point(|&other| other < column);
                    for &index in &columns[first..] {
                        pair_places[next[row]] = place[index];
                        next[row] += 1;
                    }
                }
            }
        }
        let values = vec![0.0; indices.len()];
        Self { starts, rows: indices, values, quadratic_places, pair_places }
    }

    /// The pattern of the upper triangle by columns.
    pub(super) fn upper_pattern(&self) -> (Vec<usize>, Vec<usize>) {
        let n = self.starts.len() - 1;
        let mut starts = vec![0_usize; n + 1];
        for &row in &self.rows {
            starts[row + 1] += 1;
        }
        for row in 0..n {
            starts[row + 1] += starts[row];
        }
        let mut next = starts.clone();
        let mut indices = vec![0; self.rows.len()];
        for column in 0..n {
            for &row in &self.rows[self.starts[column]..self.starts[column + 1]] {
                indices[next[row]] = column;
                next[row] += 1;
            }
        }
        (starts, indices)
    }

    /// N = P + A'WA with the weights of the rows inside.
    pub(super) fn assemble(&mut self, quadratic: &SparseRows, rows: &SparseRows, inside: &[bool], weights: &[f64]) {
        self.values.fill(0.0);
        let mut places = self.quadratic_places.iter();
        for column in 0..quadratic.row_count() {
            let (indices, values) = quadratic.row(column);
            for (&index, value) in indices.iter().zip(values) {
                if index >= column
                    && let Some(&place) = places.next()
                {
                    self.values[place as usize] += value;
                }
            }
        }
        let mut rest = &self.pair_places[..];
        for row in 0..rows.row_count() {
            if !inside[row] {
                continue;
            }
            let values = rows.row(row).1;
            for (b, &value) in values.iter().enumerate() {
                let factor = weights[row] * value;
                let (places, others) = rest.split_at(values.len() - b);
                for (&place, other) in places.iter().zip(&values[b..]) {
                    self.values[place as usize] += factor * other;
                }
                rest = others;
            }
        }
    }

    /// Adds to the diagonal: `absolute` + `relative` N_ii.
    pub(super) fn lift(&mut self, absolute: f64, relative: f64) {
        for &start in &self.starts[..self.starts.len() - 1] {
            self.values[start] += absolute + relative * self.values[start];
        }
    }
}
