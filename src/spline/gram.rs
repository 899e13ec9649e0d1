//! Exact integrals: Gram matrices of derivatives of basis functions, and moments of basis functions.
//!
//! Every integrand is a polynomial between the knots, integrated by a Gauss-Legendre rule of sufficient order; the
//! error is that of rounding, about 1e-15 of the size of the result (Vermeulen, Bartels & Heppler 1992).

use super::basis::{BasisValues, MAX_DEGREE};
use super::knots::KnotVector;
use crate::numeric::gauss_legendre;

/// G_ij = int N_i^(a)(t) M_j^(b)(t) dt, stored as rows of its nonzero part.
#[derive(Debug, Clone, PartialEq)]
pub struct Gram {
    columns: usize,
    width: usize,
    first: Vec<usize>,
    values: Vec<f64>,
}

impl Gram {
    /// The matrix over the whole domain of `rows`, for derivatives of orders `orders[0]` of its functions and
    /// `orders[1]` of those of `columns`. The two may differ in knots and degree; functions vanish outside their
    /// domain.
    #[must_use]
    pub fn new(rows: &KnotVector, columns: &KnotVector, orders: [usize; 2]) -> Self {
        let (from, to) = rows.domain();
        Self::over(rows, columns, orders, from, to)
    }

    /// The matrix over the part of the domains between `from` and `to`.
    #[must_use]
    pub fn over(rows: &KnotVector, columns: &KnotVector, orders: [usize; 2], from: f64, to: f64) -> Self {
        let ((a, b), (c, d)) = (rows.domain(), columns.domain());
        let pieces = pieces([rows, columns], from.max(a).max(c), to.min(b).min(d));
        let count = rows.basis_count();
        // Which columns a row meets: from its first piece to its last.
        let mut first = vec![usize::MAX; count];
        let mut last = vec![0; count];
        let spans: Vec<[usize; 2]> = pieces
            .iter()
            .map(|[low, high]| {
                let mid = 0.5 * (low + high);
                [rows.find_span(mid) - rows.degree(), columns.find_span(mid) - columns.degree()]
            })
            .collect();
        for [i, j] in &spans {
            for row in *i..=i + rows.degree() {
                first[row] = first[row].min(*j);
                last[row] = last[row].max(j + columns.degree());
            }
        }
        let width = first.iter().zip(&last).map(|(f, l)| (l + 1).saturating_sub(*f)).max().unwrap_or(0);
        first.iter_mut().for_each(|f| *f = (*f).min(columns.basis_count().saturating_sub(1)));
        let mut values = vec![0.0; count * width];
        let degree = (rows.degree() + columns.degree()).saturating_sub(orders[0] + orders[1]);
        let rule = gauss_legendre(degree / 2 + 1);
        if orders[0] <= rows.degree() && orders[1] <= columns.degree() {
            for ([low, high], [i, j]) in pieces.iter().zip(&spans) {
                for (t, weight) in rule.on(*low, *high) {
                    let (n, m) = (order_at(rows, orders[0], t), order_at(columns, orders[1], t));
                    for (r, n) in n.iter().enumerate().take(rows.degree() + 1) {
                        let start = (i + r) * width + j - first[i + r];
                        for (value, m) in values[start..].iter_mut().zip(&m[..=columns.degree()]) {
                            *value += weight * n * m;
                        }
                    }
                }
            }
        }
        Self { columns: columns.basis_count(), width, first, values }
    }

    /// Numbers of rows and columns.
    #[must_use]
    pub fn shape(&self) -> [usize; 2] {
        [self.first.len(), self.columns]
    }

    /// The entry G_ij; 0 outside the band.
    #[must_use]
    pub fn get(&self, i: usize, j: usize) -> f64 {
        let (first, values) = self.row(i);
        j.checked_sub(first).and_then(|k| values.get(k)).copied().unwrap_or(0.0)
    }

    /// The band of row `i`: its first column and the entries from there on.
    ///
    /// # Panics
    /// When `i` is not a row.
    #[must_use]
    pub fn row(&self, i: usize) -> (usize, &[f64]) {
        let first = self.first[i];
        let length = self.width.min(self.columns - first);
        (first, &self.values[i * self.width..i * self.width + length])
    }

    /// G x.
    ///
    /// # Panics
    /// When `x` is shorter than the number of columns.
    #[must_use]
    pub fn apply(&self, x: &[f64]) -> Vec<f64> {
        (0..self.first.len())
            .map(|i| {
                let (first, values) = self.row(i);
                values.iter().zip(&x[first..]).map(|(g, x)| g * x).sum()
            })
            .collect()
    }
}

/// Parts of [from, to] without a knot inside.
fn pieces(knots: [&KnotVector; 2], from: f64, to: f64) -> Vec<[f64; 2]> {
    let mut ends = vec![from, to];
    for k in knots {
        ends.extend(k.knots().iter().copied().filter(|&t| t > from && t < to));
    }
    ends.sort_by(f64::total_cmp);
    if to > from { ends.windows(2).filter(|w| w[0] < w[1]).map(|w| [w[0], w[1]]).collect() } else { Vec::new() }
}

fn order_at(knots: &KnotVector, order: usize, t: f64) -> BasisValues {
    match order {
        0 => knots.orders_at::<1>(t).1[0],
        1 => knots.orders_at::<2>(t).1[1],
        2 => knots.orders_at::<3>(t).1[2],
        3 => knots.orders_at::<4>(t).1[3],
        _ => knots.orders_at::<{ MAX_DEGREE + 1 }>(t).1[order.min(MAX_DEGREE)],
    }
}

impl KnotVector {
    /// The integrals of the basis functions over the domain, (t_{i+p+1} - t_i) / (p + 1) (de Boor 2001, X (33)).
    #[must_use]
    pub fn integrals(&self) -> Vec<f64> {
        let p = self.degree();
        let k = self.knots();
        (0..self.basis_count()).map(|i| (k[i + p + 1] - k[i]) / (p + 1) as f64).collect()
    }

    /// int t^power N_i(t) dt between `from` and `to`, for every basis function; exact to rounding, the part of the
    /// integral that lies outside the domain is 0. Powers up to 119.
    #[must_use]
    pub fn moments(&self, power: u32, from: f64, to: f64) -> Vec<f64> {
        let (a, b) = self.domain();
        let rule = gauss_legendre((self.degree() + power as usize) / 2 + 1);
        let mut result = vec![0.0; self.basis_count()];
        for [low, high] in pieces([self, self], from.max(a), to.min(b)) {
            for (t, weight) in rule.on(low, high) {
                let (first, [values]) = self.orders_at::<1>(t);
                let factor = weight * t.powi(power as i32);
                for (sum, value) in result[first..].iter_mut().zip(&values[..=self.degree()]) {
                    *sum += factor * value;
                }
            }
        }
        result
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spline::tests::knots;
    use proptest::prelude::*;

    fn unit_spans(degree: usize, spans: usize) -> KnotVector {
        let breaks: Vec<f64> = (0..=spans).map(|k| k as f64).collect();
        KnotVector::from_breakpoints(degree, &breaks, &vec![1; spans - 1]).unwrap()
    }

    /// Rows of uniform cubic B-splines away from the ends (values as in the finite-element literature, Prenter 1975).
    #[test]
    fn uniform_cubics() {
        let k = unit_spans(3, 12);
        let cases = [
            (0, [2416.0, 1191.0, 120.0, 1.0].map(|g| g / 5040.0)),
            (1, [2.0 / 3.0, -1.0 / 8.0, -1.0 / 5.0, -1.0 / 120.0]),
            (2, [8.0 / 3.0, -1.5, 0.0, 1.0 / 6.0]),
            (3, [20.0, -15.0, 6.0, -1.0]),
        ];
        for (order, exact) in cases {
            let g = Gram::new(&k, &k, [order, order]);
            for (offset, exact) in exact.iter().enumerate() {
                for (i, j) in [(7, 7 + offset), (7, 7 - offset)] {
                    assert!((g.get(i, j) - exact).abs() < 1e-14, "{order} {offset}: {} {exact}", g.get(i, j));
                }
            }
            assert!(g.get(7, 11).abs() < 1e-300);
        }
    }

    /// Bernstein polynomials: int B_i^p B_j^q = C(p,i) C(q,j) / (C(p+q,i+j) (p+q+1)) (Farouki & Rajan 1988).
    #[test]
    fn bernstein_polynomials_of_different_degree() {
        let choose = |n: u32, k: u32| (0..k).fold(1.0, |c, i| c * f64::from(n - i) / f64::from(i + 1));
        for (p, q) in [(3, 3), (2, 5), (7, 7), (1, 4)] {
            let (a, b) = (unit_spans(p as usize, 1), unit_spans(q as usize, 1));
            let g = Gram::new(&a, &b, [0, 0]);
            assert_eq!(g.shape(), [p as usize + 1, q as usize + 1]);
            for i in 0..=p {
                for j in 0..=q {
                    let exact = choose(p, i) * choose(q, j) / (choose(p + q, i + j) * f64::from(p + q + 1));
                    assert!((g.get(i as usize, j as usize) - exact).abs() < 1e-15);
                }
            }
        }
    }

    /// A hat function over [0, 2]: int_0^1 t N = 1/3, int_1^2 t N = 2/3, int t^2 N = 7/6.
    #[test]
    fn moments_of_a_hat() {
        let k = unit_spans(1, 2);
        let close = |found: f64, exact: f64| assert!((found - exact).abs() < 1e-15, "{found} {exact}");
        close(k.moments(1, 0.0, 1.0)[1], 1.0 / 3.0);
        close(k.moments(1, 1.0, 9.0)[1], 2.0 / 3.0);
        close(k.moments(2, -1.0, 2.0)[1], 7.0 / 6.0);
        close(k.moments(0, 0.5, 0.75)[0], 0.25 * 0.375);
        close(k.moments(0, 1.5, 0.5)[0], 0.0);
    }

    proptest! {
        #[test]
        fn sums_are_those_of_polynomials(a in knots(7), b in knots(7), f in 0.0f64..1.0, g in 0.0f64..1.0) {
            let (low, high) = a.domain();
            let (from, to) = (low + f.min(g) * (high - low), low + f.max(g) * (high - low));
            // Sum over all i of N_i is 1, and of greville_i N_i is t.
            for power in 0..4 {
                let sum: f64 = a.moments(power, from, to).iter().sum();
                let n = power as i32 + 1;
                let exact = (to.powi(n) - from.powi(n)) / f64::from(n);
                prop_assert!((sum - exact).abs() < 1e-12, "{} {}", sum, exact);
            }
            for (x, y) in a.moments(0, low, high).iter().zip(a.integrals()) {
                prop_assert!((x - y).abs() < 1e-14);
            }
            // Rows over another basis sum to the moments over the common part.
            let (c, d) = b.domain();
            let gram = Gram::over(&a, &b, [0, 0], from, to);
            let ones = gram.apply(&vec![1.0; b.basis_count()]);
            for (x, y) in ones.iter().zip(a.moments(0, from.max(c), to.min(d))) {
                prop_assert!((x - y).abs() < 1e-14);
            }
            // Derivatives of constants and of t.
            let slopes = Gram::new(&a, &a, [1, 1]);
            prop_assert!(slopes.apply(&vec![1.0; a.basis_count()]).iter().all(|x| x.abs() < 1e-9));
            let linear = Gram::over(&a, &a, [0, 1], from, to).apply(&a.greville());
            for (x, y) in linear.iter().zip(a.moments(0, from, to)) {
                prop_assert!((x - y).abs() < 1e-12);
            }
        }
    }
}
