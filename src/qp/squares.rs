//! Squares of dense linear forms in an objective, 1/2 |F x|^2, as unknowns of their own:
//!
//! ```text
//! minimise    1/2 x'P x + q'x + 1/2 s's
//! subject to  l <= A x <= u,   F x - s = 0
//! ```
//!
//! P + F'F would be dense. The rows of F are dense rows instead, which [`super::structured`] keeps outside its normal matrix.

use super::problem::{Interior, Problem};
use super::sparse::SparseRows;

impl Problem {
    /// P x + F'F x.
    #[must_use]
    pub fn curved(&self, x: &[f64]) -> Vec<f64> {
        let mut curved = self.quadratic.apply(x);
        self.squares.add_transposed_product(&self.squares.apply(x), &mut curved);
        curved
    }

    /// The problem over x and s.
    pub(super) fn lifted(&self) -> Self {
        let count = self.squares.row_count();
        if count == 0 {
            return self.clone();
        }
        let n = self.linear.len();
        let wide = |rows: &SparseRows, own: &dyn Fn(usize) -> Option<(usize, f64)>| {
            let mut wide = SparseRows::new(n + count);
            (0..rows.row_count()).for_each(|k| wide.push(rows.entries(k).chain(own(k))));
            wide
        };
        let mut quadratic = wide(&self.quadratic, &|_| None);
        (n..n + count).for_each(|s| quadratic.push([(s, 1.0)]));
        let mut rows = wide(&self.rows, &|_| None);
        let forms = wide(&self.squares, &|k| Some((n + k, -1.0)));
        (0..count).for_each(|k| rows.push(forms.entries(k)));
        let with = |values: &[f64]| values.iter().copied().chain(std::iter::repeat_n(0.0, count)).collect();
        Self {
            quadratic,
            linear: with(&self.linear),
            squares: SparseRows::new(n + count),
            rows,
            lower: with(&self.lower),
            upper: with(&self.upper),
        }
    }

    /// A point of a problem as one of this, which is lifted: F x - s = 0 are its last rows, whose multipliers are s.
    pub(super) fn lifted_point(&self, point: &Interior) -> Interior {
        let mut lifted = point.clone();
        lifted.x.resize(self.linear.len(), 0.0);
        let forms = point.rows.len()..self.rows.row_count();
        let values: Vec<f64> = forms.map(|row| self.rows.dot(row, &lifted.x)).collect();
        lifted.x.truncate(point.x.len());
        lifted.x.extend_from_slice(&values);
        let row = |s: f64| Some([[f64::INFINITY, s.max(0.0)], [f64::INFINITY, (-s).max(0.0)]]);
        lifted.rows.extend(values.iter().map(|s| row(*s)));
        lifted
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Settings, Status};
    use super::*;

    /// Squares as rows and the same squares within P have one solution, one objective and one set of multipliers.
    #[test]
    fn squares_are_a_part_of_the_objective() {
        let n = 160;
        let form = |k: usize| (0..n).map(move |i| (i, (0.1 * ((k + 1) * (i + 1)) as f64).sin())).collect::<Vec<_>>();
        let mut squares = SparseRows::new(n);
        (0..3).for_each(|k| squares.push(form(k)));
        let mut rows = SparseRows::new(n);
        (0..n).for_each(|k| rows.push([(k, 1.0)]));
        let diagonal: Vec<_> = (0..n).map(|i| (i, i, 0.5 + 0.01 * i as f64)).collect();
        let problem = Problem {
            quadratic: SparseRows::from_entries(n, n, &diagonal),
            linear: (0..n).map(|i| (0.7 * i as f64).cos()).collect(),
            squares,
            rows,
            lower: vec![-0.4; n],
            upper: (0..n).map(|i| if i % 40 == 7 { -0.4 } else { 0.6 }).collect(),
        };
        let products = (0..3).flat_map(|k| {
            let form = form(k);
            form.clone().into_iter().flat_map(move |(i, a)| form.clone().into_iter().map(move |(j, b)| (i, j, a * b)))
        });
        let entries: Vec<_> = diagonal.iter().copied().chain(products).collect();
        let squares = SparseRows::new(n);
        let dense = Problem { quadratic: SparseRows::from_entries(n, n, &entries), squares, ..problem.clone() };
        let [one, other] = [&problem, &dense].map(|problem| problem.solve(&Settings::default()).unwrap());
        assert_eq!([one.status, other.status], [Status::Optimal; 2]);
        assert_eq!([one.x.len(), one.multipliers.len()], [n, n]);
        let far = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(far(&one.x, &other.x) < 1e-8 && far(&one.multipliers, &other.multipliers) < 1e-7);
        assert!((problem.objective(&one.x) - dense.objective(&one.x)).abs() < 1e-12);
        assert!(problem.certificate(&one.x, &one.multipliers, 0.0).gap.abs() < 1e-9);
        let again = problem.solve_from(&Settings::default(), one.interior.as_ref()).unwrap();
        assert!(again.status == Status::Optimal && far(&again.x, &one.x) < 1e-8);
    }
}
