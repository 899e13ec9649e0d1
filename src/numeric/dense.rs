//! Dense blocks in column-major storage: products, Cholesky factors of panels, division by a triangle.
//!
//! Panels are halved until they are narrow, so that nearly all work is in matrix products (Golub & Van Loan 2013,
//! section 4.2.9). Rounding errors are those of the unblocked algorithms.

use nalgebra::{DMatrixView, DMatrixViewMut, Dyn};

/// Columns of a panel that are eliminated one after the other.
const NARROW: usize = 16;

/// Rows of a narrow panel that are divided by its triangle at once.
const LANES: usize = 8;

/// A block that is read: entry (i, j) is `values[i * strides[0] + j * strides[1]]`.
#[derive(Clone, Copy)]
pub(crate) struct Block<'a> {
    values: &'a [f64],
    shape: [usize; 2],
    strides: [usize; 2],
}

impl<'a> Block<'a> {
    /// Rows and columns of `shape`; columns begin `stride` values apart.
    pub(crate) fn new(values: &'a [f64], shape: [usize; 2], stride: usize) -> Self {
        Self { values, shape, strides: [1, stride] }
    }

    pub(crate) fn rows(&self) -> usize {
        self.shape[0]
    }

    fn columns(&self) -> usize {
        self.shape[1]
    }

    /// The part of `shape` whose first entry is `first`.
    pub(crate) fn part(self, first: [usize; 2], shape: [usize; 2]) -> Self {
        let offset = first[0] * self.strides[0] + first[1] * self.strides[1];
        Self { values: self.values.get(offset..).unwrap_or_default(), shape, ..self }
    }

    /// All columns of `count` rows from `first` on.
    pub(crate) fn rows_from(self, first: usize, count: usize) -> Self {
        self.part([first, 0], [count, self.shape[1]])
    }

    pub(crate) fn transposed(self) -> Self {
        let ([rows, columns], [down, across]) = (self.shape, self.strides);
        Self { shape: [columns, rows], strides: [across, down], ..self }
    }

    /// Writes the columns one after the other.
    pub(crate) fn copy_to(&self, values: &mut [f64]) {
        let columns = values.chunks_exact_mut(self.rows().max(1)).enumerate();
        columns.for_each(|(j, column)| column.iter_mut().enumerate().for_each(|(i, value)| *value = self.at(i, j)));
    }

    fn at(&self, i: usize, j: usize) -> f64 {
        self.values[i * self.strides[0] + j * self.strides[1]]
    }

    fn view(&self) -> DMatrixView<'a, f64, Dyn, Dyn> {
        let ([rows, columns], [down, across]) = (self.shape, self.strides);
        DMatrixView::from_slice_with_strides(self.values, rows, columns, down, across)
    }
}

/// T - A B for a block T whose columns begin `stride` values apart.
pub(crate) fn subtract_product(target: &mut [f64], stride: usize, a: Block<'_>, b: Block<'_>) {
    let (rows, columns) = (a.rows(), b.columns());
    if rows == 0 || columns == 0 || a.columns() == 0 {
        return;
    }
    // The left factor stands upright: of a small one that lies, `axcpy` of nalgebra 0.34 takes the span of a column in
    // memory for its length, and writes past the target.
    let mut upright = Vec::new();
    let a = if a.strides[0] == 1 {
        a
    } else {
        upright.resize(rows * a.columns(), 0.0);
        a.copy_to(&mut upright);
        Block::new(&upright, a.shape, rows)
    };
    let mut target = DMatrixViewMut::from_slice_with_strides_mut(target, rows, columns, 1, stride);
    target.gemm(-1.0, &a.view(), &b.view(), 1.0);
}

/// Overwrites the lower part of a panel, `columns` columns of `rows` rows that begin `stride` values apart, with its
/// Cholesky factor: \[A; B\] becomes \[L; B L'^-1\], A = L L'. What stands above the diagonal is lost.
///
/// # Errors
/// The first column whose pivot is not above `least(column)`.
pub(crate) fn factor_panel(
    panel: &mut [f64],
    [rows, columns]: [usize; 2],
    stride: usize,
    least: &impl Fn(usize) -> f64,
) -> Result<(), usize> {
    factor_columns(panel, [rows, columns], stride, 0, least)
}

/// The same for a part of a panel that begins in its column `first`.
fn factor_columns(
    panel: &mut [f64],
    [rows, columns]: [usize; 2],
    stride: usize,
    first: usize,
    least: &impl Fn(usize) -> f64,
) -> Result<(), usize> {
    if columns > NARROW {
        let half = (columns / 2).next_multiple_of(NARROW);
        factor_columns(panel, [rows, half], stride, first, least)?;
        let (done, rest) = panel.split_at_mut(half * stride);
        let under = Block::new(done, [rows, half], stride);
        let (tall, short) = (under.rows_from(half, rows - half), under.rows_from(half, columns - half));
        subtract_product(&mut rest[half..], stride, tall, short.transposed());
        return factor_columns(&mut rest[half..], [rows - half, columns - half], stride, first + half, least);
    }
    // Row by row: l_ij = (a_ij - sum_k l_ik l_jk) / l_jj.
    let mut triangle = [[0.0; NARROW]; NARROW];
    for i in 0..columns {
        for j in 0..=i {
            let mut value = panel[j * stride + i];
            (0..j).for_each(|k| value -= triangle[i][k] * triangle[j][k]);
            if i == j {
                if !(value > least(first + j) && value.is_finite()) {
                    return Err(first + j);
                }
                triangle[j][j] = value.sqrt();
            } else {
                triangle[i][j] = value / triangle[j][j];
            }
            panel[j * stride + i] = triangle[i][j];
        }
    }
    let inverse: [f64; NARROW] = std::array::from_fn(|j| 1.0 / triangle[j][j]);
    let whole = (rows - columns) / LANES * LANES;
    for row in (columns..columns + whole).step_by(LANES) {
        let mut lanes = [[0.0; LANES]; NARROW];
        for j in 0..columns {
            let Some(target) = panel[j * stride + row..].first_chunk_mut::<LANES>() else { break };
            let mut values = *target;
            for (known, factor) in lanes[..j].iter().zip(&triangle[j]) {
                (0..LANES).for_each(|t| values[t] -= known[t] * factor);
            }
            values.iter_mut().for_each(|value| *value *= inverse[j]);
            *target = values;
            lanes[j] = values;
        }
    }
    for row in columns + whole..rows {
        let mut known = [0.0; NARROW];
        for j in 0..columns {
            let value = &mut panel[j * stride + row];
            (0..j).for_each(|k| *value -= known[k] * triangle[j][k]);
            *value *= inverse[j];
            known[j] = *value;
        }
    }
    Ok(())
}

/// Y becomes Y L^-1 for `rows` rows whose columns begin `stride` values apart, and a lower triangle L.
pub(crate) fn divide_by_triangle(y: &mut [f64], rows: usize, stride: usize, triangle: Block<'_>) {
    let columns = triangle.columns();
    if rows == 0 {
        return;
    }
    if columns > NARROW {
        let half = (columns / 2).next_multiple_of(NARROW);
        let rest = columns - half;
        let (left, right) = y.split_at_mut(half * stride);
        divide_by_triangle(right, rows, stride, triangle.part([half, half], [rest, rest]));
        let right = Block::new(right, [rows, rest], stride);
        subtract_product(left, stride, right, triangle.part([half, 0], [rest, half]));
        return divide_by_triangle(left, rows, stride, triangle.part([0, 0], [half, half]));
    }
    for j in (0..columns).rev() {
        let (left, right) = y.split_at_mut((j + 1) * stride);
        let own = &mut left[j * stride..j * stride + rows];
        for (k, other) in (j + 1..columns).zip(right.chunks(stride)) {
            let factor = triangle.at(k, j);
            own.iter_mut().zip(other).for_each(|(value, entry)| *value -= factor * entry);
        }
        let pivot = triangle.at(j, j);
        own.iter_mut().for_each(|value| *value /= pivot);
    }
}

/// Scalar product in eight strands, which the compiler turns into vector instructions.
pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    let mut strands = [0.0; 8];
    let count = a.len().min(b.len());
    let (a, b) = (&a[..count], &b[..count]);
    let ((a, a_rest), (b, b_rest)) = (a.as_chunks::<8>(), b.as_chunks::<8>());
    for (x, y) in a.iter().zip(b) {
        (0..8).for_each(|k| strands[k] += x[k] * y[k]);
    }
    let tail: f64 = a_rest.iter().zip(b_rest).map(|(x, y)| x * y).sum();
    let [s, t] = [0, 4].map(|k| (strands[k] + strands[k + 1]) + (strands[k + 2] + strands[k + 3]));
    (s + t) + tail
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A positive definite n x n matrix and more rows under it, columns 3 values further apart than they must be.
    fn panel(rows: usize, columns: usize) -> Vec<f64> {
        let stride = rows + 3;
        let mut values = vec![f64::NAN; stride * columns - 3];
        for j in 0..columns {
            for i in 0..rows {
                let entry = ((i.max(j) * 7 + i.min(j) * 13) % 17) as f64 / 17.0 - 0.5;
                values[j * stride + i] = if i == j { columns as f64 } else { entry };
            }
        }
        values
    }

    #[test]
    fn the_factor_of_a_panel_gives_it_back_and_division_undoes_it() {
        for (rows, columns) in [(1, 1), (9, 5), (16, 16), (40, 17), (100, 64), (131, 90)] {
            let stride = rows + 3;
            let original = panel(rows, columns);
            let mut factor = original.clone();
            factor_panel(&mut factor, [rows, columns], stride, &|_| 0.0).unwrap();
            for j in 0..columns {
                for i in j..rows {
                    let product: f64 = (0..=j).map(|k| factor[k * stride + i] * factor[k * stride + j]).sum();
                    assert!((product - original[j * stride + i]).abs() < 1e-13 * columns as f64, "({i}, {j})");
                }
            }
            // (B L'^-1) L^-1 L L' = B.
            let below = rows - columns;
            let mut y: Vec<f64> =
                (0..columns).flat_map(|j| factor[j * stride + columns..j * stride + rows].to_vec()).collect();
            divide_by_triangle(&mut y, below, below.max(1), Block::new(&factor, [columns, columns], stride));
            for j in 0..columns {
                for i in 0..below {
                    let product: f64 =
                        (0..columns).map(|k| y[k * below + i] * original[k.min(j) * stride + k.max(j)]).sum();
                    assert!((product - original[j * stride + columns + i]).abs() < 1e-12 * columns as f64);
                }
            }
        }
    }

    #[test]
    fn a_pivot_that_is_too_small_is_named() {
        let (rows, columns) = (60, 40);
        let mut values = panel(rows, columns);
        values[(rows + 3) * 37 + 37] = 0.0;
        assert_eq!(factor_panel(&mut values, [rows, columns], rows + 3, &|_| 1e-12), Err(37));
    }

    /// All shapes about the size from which products go another way, standing and lying.
    #[test]
    fn products_of_parts_that_stand_or_lie() {
        let values: Vec<f64> = (0..400).map(|k| f64::from(k * 7 % 13) - 6.0).collect();
        let place = |first: [usize; 2], shape: [usize; 2], lies: bool| {
            let whole = Block::new(&values, [17, 17], 19);
            if lies {
                whole.part([first[1], first[0]], [shape[1], shape[0]]).transposed()
            } else {
                whole.part(first, shape)
            }
        };
        for (rows, columns, depth) in (1..10).flat_map(|a| (1..10).flat_map(move |b| (1..10).map(move |c| (a, b, c)))) {
            for (left, right) in [(false, false), (true, false), (false, true), (true, true)] {
                let (a, b) = (place([1, 2], [rows, depth], left), place([3, 1], [depth, columns], right));
                let mut target = vec![1.0; 11 * columns];
                subtract_product(&mut target, 11, a, b);
                for (k, value) in target.iter().enumerate() {
                    let (i, j) = (k % 11, k / 11);
                    let product = if i < rows { (0..depth).map(|l| a.at(i, l) * b.at(l, j)).sum() } else { 0.0 };
                    assert!((value - 1.0 + product).abs() < 1e-12, "{rows} x {columns} over {depth}");
                }
            }
        }
    }
}
