//! Knot vectors and the B-spline basis over them (Piegl & Tiller 1997, chapter 2; de Boor 2001, chapter IX).

use super::basis::{BasisValues, HIGHEST_DEGREE, MAX_DEGREE, WideValues, basis_orders, padded_orders};
use super::table::{Cubic, SpanTable};
use std::sync::Arc;

/// Why data do not make a spline.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SplineError {
    /// Degree outside 1 to [`MAX_DEGREE`] of a spline that is fitted or elevated, or of a hull.
    #[error("degree {0} is outside 1 to {MAX_DEGREE}")]
    Degree(usize),
    /// Degree outside 1 to [`HIGHEST_DEGREE`] of any spline.
    #[error("degree {0} is outside 1 to {HIGHEST_DEGREE}")]
    AnyDegree(usize),
    /// Knots that are not finite, decrease, are not clamped or repeat too often.
    #[error("knot {index} ({value}): {problem}")]
    Knot {
        /// Index of the knot, from 0.
        index: usize,
        /// Its value.
        value: f64,
        /// What is wrong with it.
        problem: &'static str,
    },
    /// A number of points that does not fit the knots.
    #[error("{found} control points, expected {expected}")]
    PointCount {
        /// Number found.
        found: usize,
        /// Number that the knots ask for.
        expected: usize,
    },
    /// A control point that is not finite.
    #[error("control point {0} is not finite")]
    NotFinite(usize),
    /// Sites of data that are not finite, do not increase or lie where they cannot.
    #[error("data site {index} ({value}): {problem}")]
    Site {
        /// Index of the site, from 0.
        index: usize,
        /// Its value.
        value: f64,
        /// What is wrong with it.
        problem: &'static str,
    },
    /// Data sites that do not determine the spline (Schoenberg-Whitney condition).
    #[error("the data sites do not determine the spline: no site belongs to basis function {column}")]
    Undetermined {
        /// The basis function without data.
        column: usize,
    },
}

/// A clamped, non-decreasing sequence of knots with a degree. Copies share their storage, so that cloning is cheap.
#[derive(Clone)]
pub struct KnotVector {
    degree: usize,
    knots: Arc<[f64]>,
    table: Arc<SpanTable>,
}

impl PartialEq for KnotVector {
    fn eq(&self, other: &Self) -> bool {
        self.degree == other.degree && self.knots == other.knots
    }
}

impl std::fmt::Debug for KnotVector {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("KnotVector").field("degree", &self.degree).field("knots", &self.knots).finish()
    }
}

impl KnotVector {
    /// Takes the full sequence of knots, `basis functions + degree + 1` of them.
    ///
    /// # Errors
    /// [`SplineError`] when the degree is outside 1 to [`HIGHEST_DEGREE`], a knot is not finite, the sequence decreases, an
    /// end is not `degree + 1` fold or an interior knot is more than `degree` fold.
    pub fn new(degree: usize, knots: Vec<f64>) -> Result<Self, SplineError> {
        if !(1..=HIGHEST_DEGREE).contains(&degree) {
            return Err(SplineError::AnyDegree(degree));
        }
        let bad = |index: usize, problem| {
            Err(SplineError::Knot { index, value: knots.get(index).copied().unwrap_or(f64::NAN), problem })
        };
        if knots.len() < 2 * (degree + 1) {
            return bad(knots.len(), "too few knots");
        }
        if let Some(index) = knots.iter().position(|t| !t.is_finite()) {
            return bad(index, "not finite");
        }
        if let Some(index) = knots.windows(2).position(|w| w[1] < w[0]) {
            return bad(index + 1, "smaller than the knot before it");
        }
        let (first, last) = (knots[0], knots[knots.len() - 1]);
        if knots[degree] > first {
            return bad(degree, "the start is not clamped");
        }
        if knots[knots.len() - 1 - degree] < last {
            return bad(knots.len() - 1 - degree, "the end is not clamped");
        }
        // More than `degree` equal knots inside (or degree + 1 at an end) would split the spline.
        let inner = &knots[1..knots.len() - 1];
        if let Some(index) = inner.windows(degree + 1).position(|w| w[0] >= w[degree]) {
            return bad(index + 1, "repeated more often than the degree allows");
        }
        Ok(Self::from_checked(degree, knots))
    }

    /// Knots known to be in order; used inside the kernel only.
    pub(super) fn from_checked(degree: usize, knots: Vec<f64>) -> Self {
        let table = Arc::new(SpanTable::new(degree, &knots));
        Self { degree, knots: knots.into(), table }
    }

    /// Clamped knots from increasing breakpoints; `multiplicities` belong to the interior breakpoints.
    ///
    /// # Errors
    /// As [`KnotVector::new`]; also when the number of multiplicities is not the number of interior breakpoints.
    pub fn from_breakpoints(degree: usize, breakpoints: &[f64], multiplicities: &[usize]) -> Result<Self, SplineError> {
        if breakpoints.len() < 2 || multiplicities.len() + 2 != breakpoints.len() {
            return Err(SplineError::PointCount { found: multiplicities.len() + 2, expected: breakpoints.len() });
        }
        let last = breakpoints.len() - 1;
        let mut knots = Vec::new();
        for (index, &at) in breakpoints.iter().enumerate() {
            let times = if index == 0 || index == last { degree + 1 } else { multiplicities[index - 1] };
            knots.extend(std::iter::repeat_n(at, times));
        }
        Self::new(degree, knots)
    }

    /// Clamped knots on [0, 1] with `spans` equal spans.
    ///
    /// # Errors
    /// As [`KnotVector::new`]; also when `spans` is 0.
    pub fn uniform(degree: usize, spans: usize) -> Result<Self, SplineError> {
        let breakpoints: Vec<f64> = (0..=spans).map(|k| k as f64 / spans.max(1) as f64).collect();
        Self::from_breakpoints(degree, &breakpoints, &vec![1; spans.saturating_sub(1)])
    }

    /// The degree p.
    #[must_use]
    pub fn degree(&self) -> usize {
        self.degree
    }

    /// All knots with their multiplicities.
    #[must_use]
    pub fn knots(&self) -> &[f64] {
        &self.knots
    }

    /// Number of basis functions, that is of control points.
    #[must_use]
    pub fn basis_count(&self) -> usize {
        self.knots.len() - self.degree - 1
    }

    /// First and last knot.
    #[must_use]
    pub fn domain(&self) -> (f64, f64) {
        (self.knots[0], self.knots[self.knots.len() - 1])
    }

    /// The distinct knots in increasing order.
    #[must_use]
    pub fn breakpoints(&self) -> Vec<f64> {
        let mut breaks = self.knots.to_vec();
        breaks.dedup_by(|a, b| a <= b);
        breaks
    }

    /// Indices k of the spans [t_k, t_k+1] of positive length, in order.
    #[must_use]
    pub fn spans(&self) -> Vec<usize> {
        (0..self.table.len()).map(|number| self.table.knot_index(number)).collect()
    }

    /// How often `t` occurs among the knots.
    #[must_use]
    pub fn multiplicity(&self, t: f64) -> usize {
        self.knots.partition_point(|&knot| knot <= t) - self.knots.partition_point(|&knot| knot < t)
    }

    /// The index k with t_k <= t < t_k+1 (the last span of positive length is closed); the basis functions k - p ..= k
    /// are the ones that do not vanish there. `t` outside the domain is taken to its nearest end. Constant time unless
    /// the spans are strongly graded, then that of a binary search.
    #[must_use]
    #[inline]
    pub fn find_span(&self, t: f64) -> usize {
        self.table.knot_index(self.table.locate(t))
    }

    /// Greville abscissae, the means of `degree` successive knots: the site that belongs to each control point.
    #[must_use]
    pub fn greville(&self) -> Vec<f64> {
        let p = self.degree;
        let (a, b) = self.domain();
        let count = self.basis_count();
        (0..count)
            .map(|i| match i {
                0 => a,
                i if i + 1 == count => b,
                i => self.knots[i + 1..=i + p].iter().sum::<f64>() / p as f64,
            })
            .collect()
    }

    /// Values of the `degree + 1` basis functions span - p ..= span at `t`; the rest of the array is 0.
    /// Of degrees above [`MAX_DEGREE`] they are not a number.
    #[must_use]
    pub fn basis(&self, span: usize, t: f64) -> [f64; MAX_DEGREE + 1] {
        self.basis_derivatives::<1>(span, t)[0]
    }

    /// Values and derivatives of order 0 to N - 1 of the basis functions span - p ..= span at `t`:
    /// `result[order][function]`. Orders above the degree are 0. Nothing is allocated.
    /// Of degrees above [`MAX_DEGREE`] they are not a number.
    #[must_use]
    pub fn basis_derivatives<const N: usize>(&self, span: usize, t: f64) -> [[f64; MAX_DEGREE + 1]; N] {
        self.orders_in(self.table.number_of(span), t)
    }

    /// `t` taken to the nearest end of the domain; NaN stays NaN.
    #[inline]
    pub(super) fn clamp(&self, t: f64) -> f64 {
        self.table.clamp(t)
    }

    /// Index of the first basis function that does not vanish at `t`, and basis values and derivatives there.
    #[inline]
    pub(super) fn orders_at<const N: usize>(&self, t: f64) -> (usize, [BasisValues; N]) {
        let t = self.clamp(t);
        let number = self.table.locate(t);
        (self.table.knot_index(number) - self.degree, self.orders_in(number, t))
    }

    /// The spans of a cubic, the end of the domain included; empty for other degrees.
    #[inline(always)]
    pub(super) fn cubics(&self) -> &[Cubic] {
        self.table.cubics()
    }

    /// The number of the span of a cubic that holds `t`, and how far `t` is from its start.
    #[inline(always)]
    pub(super) fn cubic_at(&self, t: f64) -> (usize, f64) {
        let t = self.table.clamp(t);
        let number = self.table.locate(t);
        (number, t - self.table.cubics()[number].start)
    }

    /// As [`Self::orders_at`] where the order K, the degree plus 1, is known.
    ///
    /// Cubics take their polynomials from the table (error about 2e-16 of the greatest value; 0 and 1 exactly at the
    /// ends).
    #[inline(always)]
    pub(super) fn orders_at_fixed<const K: usize, const N: usize>(&self, t: f64) -> (usize, [[f64; K]; N]) {
        let t = self.clamp(t);
        let number = self.table.locate(t);
        if K == 4 && N <= 3 {
            let Cubic { start, first, powers: [c0, c1, c2, c3] } = &self.table.cubics()[number];
            let x = t - start;
            let mut result = [[0.0; K]; N];
            // Horner's scheme, carried on for the derivatives.
            for r in 0..K {
                let b2 = c3[r] * x + c2[r];
                let b1 = b2 * x + c1[r];
                result[0][r] = b1 * x + c0[r];
                if N > 1 {
                    let e2 = c3[r] * x + b2;
                    result[1][r] = e2 * x + b1;
                    if N > 2 {
                        result[2][r] = 2.0 * (c3[r] * x + e2);
                    }
                }
            }
            return (*first, result);
        }
        let first = self.table.knot_index(number) + 1 - K;
        (first, basis_orders::<K, N>(&self.knots[first + 1..], self.table.reciprocals(number), t))
    }

    /// As [`Self::orders_at`] for any degree.
    pub(super) fn wide_orders_at<const N: usize>(&self, t: f64) -> (usize, [WideValues; N]) {
        let t = self.clamp(t);
        let number = self.table.locate(t);
        let first = self.table.knot_index(number) - self.degree;
        let (window, reciprocals) = (&self.knots[first + 1..], self.table.reciprocals(number));
        let orders = match self.degree {
            8 => padded_orders::<9, N, { HIGHEST_DEGREE + 1 }>(window, reciprocals, t),
            9 => padded_orders::<10, N, { HIGHEST_DEGREE + 1 }>(window, reciprocals, t),
            10 => padded_orders::<11, N, { HIGHEST_DEGREE + 1 }>(window, reciprocals, t),
            11 => padded_orders::<12, N, { HIGHEST_DEGREE + 1 }>(window, reciprocals, t),
            12 => padded_orders::<13, N, { HIGHEST_DEGREE + 1 }>(window, reciprocals, t),
            13 => padded_orders::<14, N, { HIGHEST_DEGREE + 1 }>(window, reciprocals, t),
            14 => padded_orders::<15, N, { HIGHEST_DEGREE + 1 }>(window, reciprocals, t),
            15 => padded_orders::<16, N, { HIGHEST_DEGREE + 1 }>(window, reciprocals, t),
            _ => self.orders_in::<N>(number, t).map(|narrow| {
                let mut wide = [0.0; HIGHEST_DEGREE + 1];
                wide[..=MAX_DEGREE].copy_from_slice(&narrow);
                wide
            }),
        };
        (first, orders)
    }

    fn orders_in<const N: usize>(&self, number: usize, t: f64) -> [BasisValues; N] {
        let window = &self.knots[self.table.knot_index(number) + 1 - self.degree..];
        let reciprocals = self.table.reciprocals(number);
        match self.degree {
            1 => padded_orders::<2, N, { MAX_DEGREE + 1 }>(window, reciprocals, t),
            2 => padded_orders::<3, N, { MAX_DEGREE + 1 }>(window, reciprocals, t),
            3 => padded_orders::<4, N, { MAX_DEGREE + 1 }>(window, reciprocals, t),
            4 => padded_orders::<5, N, { MAX_DEGREE + 1 }>(window, reciprocals, t),
            5 => padded_orders::<6, N, { MAX_DEGREE + 1 }>(window, reciprocals, t),
            6 => padded_orders::<7, N, { MAX_DEGREE + 1 }>(window, reciprocals, t),
            7 => padded_orders::<8, N, { MAX_DEGREE + 1 }>(window, reciprocals, t),
            _ => [[f64::NAN; MAX_DEGREE + 1]; N],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spline::tests::{knots, parameters};
    use proptest::prelude::*;

    /// Worked examples 2.3 and 2.4 of Piegl & Tiller 1997: basis and derivatives at 5/2.
    #[test]
    fn basis_as_in_the_nurbs_book() {
        let k = KnotVector::new(2, vec![0., 0., 0., 1., 2., 3., 4., 4., 5., 5., 5.]).unwrap();
        assert_eq!(k.find_span(2.5), 4);
        let [value, first, second] = k.basis_derivatives::<3>(4, 2.5);
        for (found, exact) in [(value, [0.125, 0.75, 0.125]), (first, [-0.5, 0.0, 0.5]), (second, [1.0, -2.0, 1.0])] {
            for r in 0..3 {
                assert!((found[r] - exact[r]).abs() < 1e-15, "{found:?}");
            }
        }
    }

    /// Open uniform and Bezier knots as commonly tabulated for five control points of order 3, 2 and 5.
    #[test]
    fn open_uniform_knots() {
        let scaled = |degree: usize, spans: usize| -> Vec<f64> {
            KnotVector::uniform(degree, spans).unwrap().knots().iter().map(|t| t * spans as f64).collect()
        };
        assert_eq!(scaled(2, 3), [0., 0., 0., 1., 2., 3., 3., 3.]);
        assert_eq!(scaled(1, 4), [0., 0., 1., 2., 3., 4., 4.]);
        assert_eq!(scaled(4, 1), [0., 0., 0., 0., 0., 1., 1., 1., 1., 1.]);
    }

    #[test]
    fn bad_knots_are_errors() {
        assert_eq!(KnotVector::uniform(16, 2), Err(SplineError::AnyDegree(16)));
        let problem = |knots: &[f64]| match KnotVector::new(2, knots.to_vec()) {
            Err(SplineError::Knot { index, problem, .. }) => (index, problem),
            other => panic!("{other:?}"),
        };
        assert_eq!(problem(&[0., 0., 0., 1., 1.]), (5, "too few knots"));
        assert_eq!(problem(&[0., 0., 0., f64::NAN, 1., 1., 1.]), (3, "not finite"));
        assert_eq!(problem(&[0., 0., 0., 2., 1., 3., 3., 3.]), (4, "smaller than the knot before it"));
        assert_eq!(problem(&[0., 0., 1., 2., 3., 3., 3.]), (2, "the start is not clamped"));
        assert_eq!(problem(&[0., 0., 0., 1., 2., 3., 3.]), (4, "the end is not clamped"));
        assert_eq!(problem(&[0., 0., 0., 1., 1., 1., 2., 2., 2.]), (3, "repeated more often than the degree allows"));
        assert!(matches!(
            KnotVector::from_breakpoints(2, &[0.0, 1.0], &[1]),
            Err(SplineError::PointCount { found: 3, expected: 2 })
        ));
    }

    #[test]
    fn strongly_graded_spans_are_found() {
        let breaks: Vec<f64> = (0..60).map(|k| 0.5f64.powi(59 - k)).collect();
        let k = KnotVector::from_breakpoints(3, &breaks, &[1; 58]).unwrap();
        for (number, w) in breaks.windows(2).enumerate() {
            assert_eq!(k.find_span(w[0]), number + 3);
            assert_eq!(k.find_span(0.5 * (w[0] + w[1])), number + 3);
            assert_eq!(k.find_span(w[1].next_down()), number + 3);
        }
        assert_eq!((k.find_span(-1.0), k.find_span(2.0)), (3, 61));
    }

    proptest! {
        #[test]
        fn basis_is_a_partition_of_unity(k in knots(7)) {
            for t in parameters(&k) {
                let span = k.find_span(t);
                prop_assert!(k.knots()[span] < k.knots()[span + 1]);
                prop_assert!(k.knots()[span] <= t && (t < k.knots()[span + 1] || t >= k.domain().1));
                let orders = k.basis_derivatives::<4>(span, t);
                prop_assert!((orders[0].iter().sum::<f64>() - 1.0).abs() < 1e-14);
                prop_assert!(orders[0].iter().all(|value| *value >= 0.0));
                for order in &orders[1..] {
                    let size: f64 = order.iter().map(|value| value.abs()).sum();
                    prop_assert!(order.iter().sum::<f64>().abs() <= 1e-14 * size);
                }
            }
        }

        #[test]
        fn derivatives_are_the_slopes_of_those_below(k in knots(7)) {
            for w in k.breakpoints().windows(2) {
                let (t, h) = (0.6 * w[0] + 0.4 * w[1], 1e-5 * (w[1] - w[0]));
                let span = k.find_span(t);
                let [low, mid, high] = [t - h, t, t + h].map(|t| k.basis_derivatives::<8>(span, t));
                for order in 0..7 {
                    let size = low[order + 1].iter().chain(&low[order]).fold(0.0f64, |m, x| m.max(x.abs()));
                    for r in 0..=k.degree() {
                        let slope = (high[order][r] - low[order][r]) / (2.0 * h);
                        let scale = size / (w[1] - w[0]);
                        prop_assert!((slope - mid[order + 1][r]).abs() <= 1e-7 * scale.max(size));
                    }
                }
            }
        }
    }
}
