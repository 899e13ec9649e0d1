//! N = L L' by the supernodal Cholesky factorisation of faer; the symbolic part is made once.

use super::normal::Normal;
use faer::dyn_stack::{MemBuffer, MemStack, StackReq};
use faer::linalg::cholesky::llt::factor::LltRegularization;
use faer::sparse::linalg::SupernodalThreshold;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, LltRef, SymbolicCholesky, SymmetricOrdering, factorize_symbolic_cholesky,
};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMatRef};
use faer::{Conj, MatMut, Par, Side, Spec};

/// L, with its pattern and the memory that factoring and solving use.
pub(super) struct Factor {
    symbolic: SymbolicCholesky<usize>,
    values: Vec<f64>,
    memory: MemBuffer,
}

impl Factor {
    /// The pattern of L for a matrix in elimination order, with room to solve for `right_sides` at once.
    pub(super) fn new(normal: &Normal, right_sides: usize) -> Option<Self> {
        let n = normal.starts.len() - 1;
        // Without a permutation faer reads the upper triangle for the symbolic part and the lower one for the numbers.
        let (starts, indices) = normal.upper_pattern();
        let pattern = SymbolicSparseColMatRef::new_checked(n, n, &starts, None, &indices);
        let settings = CholeskySymbolicParams {
            supernodal_flop_ratio_threshold: SupernodalThreshold::FORCE_SUPERNODAL,
            ..CholeskySymbolicParams::default()
        };
        let symbolic = factorize_symbolic_cholesky(pattern, Side::Upper, SymmetricOrdering::Identity, settings).ok()?;
        let values = vec![0.0; symbolic.len_val()];
        let need = StackReq::or(
            symbolic.factorize_numeric_llt_scratch::<f64>(Par::Seq, Spec::default()),
            symbolic.solve_in_place_scratch::<f64>(right_sides.max(1), Par::Seq),
        );
        Some(Self { symbolic, values, memory: MemBuffer::new(need) })
    }

    /// Factors; false where a pivot is not positive.
    pub(super) fn factor(&mut self, normal: &Normal) -> bool {
        let n = normal.starts.len() - 1;
        let pattern = SymbolicSparseColMatRef::new_checked(n, n, &normal.starts, None, &normal.rows);
        let matrix = SparseColMatRef::new(pattern, &normal.values[..]);
        let stack = MemStack::new(&mut self.memory);
        self.symbolic
            .factorize_numeric_llt(
                &mut self.values,
                matrix,
                Side::Lower,
                LltRegularization::default(),
                Par::Seq,
                stack,
                Spec::default(),
            )
            .is_ok()
    }

    /// Replaces the columns of `right` (n rows each, one after the other) by N^-1 times them.
    pub(super) fn solve(&mut self, right: &mut [f64]) {
        let n = self.symbolic.nrows();
        if n == 0 || right.is_empty() {
            return;
        }
        let columns = right.len() / n;
        let stack = MemStack::new(&mut self.memory);
        LltRef::new(&self.symbolic, &self.values[..]).solve_in_place_with_conj(
            Conj::No,
            MatMut::from_column_major_slice_mut(right, n, columns),
            Par::Seq,
            stack,
        );
    }
}
