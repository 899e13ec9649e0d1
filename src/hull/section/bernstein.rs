//! Polynomials in Bernstein form: pieces of splines by blossoming, values, halving, roots.
//!
//! The sign of a number here is + from 0 up: a function f is treated as f + epsilon. Halving takes means of two numbers,
//! which never change a common sign nor an order; statements about signs made on a whole interval therefore hold, in
//! floating point too, on each of its dyadic parts.

use crate::spline::{BsplineCurve, KnotVector, MAX_DEGREE};

/// Most coefficients of one polynomial.
pub(super) const ORDER: usize = MAX_DEGREE + 1;

/// Halvings of an interval in which roots cannot be told apart.
const DEEPEST: u32 = 40;

/// The weights of the control points `span - p ..= span` in the blossom of a spline at the `arguments` 0 to p - 1
/// (Ramshaw 1989): the recurrence of the basis functions with one argument a level.
pub(super) fn blossom(knots: &KnotVector, span: usize, arguments: impl Fn(usize) -> f64) -> [f64; ORDER] {
    let (p, k) = (knots.degree(), knots.knots());
    let mut weights = [0.0; ORDER];
    weights[0] = 1.0;
    for j in 1..=p {
        let t = arguments(j - 1);
        let mut saved = 0.0;
        for r in 0..j {
            let (right, left) = (k[span + r + 1], k[span + 1 + r - j]);
            let term = weights[r] / (right - left);
            weights[r] = saved + (right - t) * term;
            saved = (t - left) * term;
        }
        weights[j] = saved;
    }
    weights
}

/// A polynomial arc of a curve in Bernstein form, over [`low`, `high`] of the curve's parameter.
#[derive(Debug, Clone, Copy)]
pub(super) struct Arc<const D: usize> {
    pub degree: usize,
    pub low: f64,
    pub high: f64,
    pub points: [[f64; D]; ORDER],
}

impl<const D: usize> Arc<D> {
    /// The arcs of a curve between the parameters `from` and `to`, one a span.
    pub(super) fn of(curve: &BsplineCurve<D>, from: f64, to: f64) -> Vec<Self> {
        let (knots, degree) = (curve.knots(), curve.knots().degree());
        let mut arcs = Vec::new();
        for span in knots.spans() {
            let (low, high) = (knots.knots()[span].max(from), knots.knots()[span + 1].min(to));
            if low >= high {
                continue;
            }
            let mut points = [[0.0; D]; ORDER];
            for (k, target) in points.iter_mut().enumerate().take(degree + 1) {
                let weights = blossom(knots, span, |level| if level < k { high } else { low });
                for (weight, point) in weights.iter().zip(&curve.points()[span - degree..=span]) {
                    for (sum, coordinate) in target.iter_mut().zip(point) {
                        *sum += weight * coordinate;
                    }
                }
            }
            arcs.push(Self { degree, low, high, points });
        }
        arcs
    }

    /// The control points.
    pub(super) fn control(&self) -> &[[f64; D]] {
        &self.points[..=self.degree]
    }

    /// The two parts before and after the fraction `r` of the arc.
    pub(super) fn split(&self, r: f64) -> [Self; 2] {
        let at = self.low + r * (self.high - self.low);
        let (mut first, mut second) = (*self, *self);
        first.high = at;
        second.low = at;
        for level in 1..=self.degree {
            for i in 0..=self.degree - level {
                second.points[i] = between(second.points[i], second.points[i + 1], r);
            }
            first.points[level] = second.points[0];
        }
        [first, second]
    }

    /// The point at the fraction `r` of the arc.
    pub(super) fn at(&self, r: f64) -> [f64; D] {
        let mut work = self.points;
        for level in 1..=self.degree {
            for i in 0..=self.degree - level {
                work[i] = between(work[i], work[i + 1], r);
            }
        }
        work[0]
    }
}

/// The point that divides the way from `a` to `b` at the fraction `r`.
pub(super) fn between<const D: usize>(a: [f64; D], b: [f64; D], r: f64) -> [f64; D] {
    std::array::from_fn(|d| (1.0 - r) * a[d] + r * b[d])
}

/// A curve made of arcs that follow each other; each joint is one control point. None without arcs.
pub(super) fn join<const D: usize>(arcs: &[Arc<D>]) -> Option<BsplineCurve<D>> {
    let (first, last) = (arcs.first()?, arcs.last()?);
    let degree = first.degree;
    let mut knots = vec![first.low; degree + 1];
    let mut points = Vec::with_capacity(arcs.len() * degree + 1);
    points.push(first.points[0]);
    for (index, arc) in arcs.iter().enumerate() {
        if index > 0 {
            knots.extend(std::iter::repeat_n(arc.low, degree));
        }
        points.extend_from_slice(&arc.points[1..=degree]);
    }
    knots.extend(std::iter::repeat_n(last.high, degree + 1));
    BsplineCurve::new(KnotVector::new(degree, knots).ok()?, points).ok()
}

/// Whether the sign is minus.
pub(super) fn minus(value: f64) -> bool {
    value < 0.0
}

/// Value and derivative at `t` of the polynomial with Bernstein coefficients `c` on [0, 1]: the scheme of de Casteljau
/// down to two numbers.
#[inline]
pub(super) fn value_and_slope(c: &[f64], t: f64) -> (f64, f64) {
    // The usual degree without loops.
    if let &[c0, c1, c2, c3] = c {
        let (a, b, d) = (c0 + t * (c1 - c0), c1 + t * (c2 - c1), c2 + t * (c3 - c2));
        let (a, b) = (a + t * (b - a), b + t * (d - b));
        return (a + t * (b - a), 3.0 * (b - a));
    }
    let p = c.len() - 1;
    let mut work = [0.0; ORDER];
    work[..=p].copy_from_slice(c);
    for level in 1..p {
        for i in 0..=p - level {
            work[i] += t * (work[i + 1] - work[i]);
        }
    }
    let slope = work[1] - work[0];
    (work[0] + t * slope, p as f64 * slope)
}

/// Halves: coefficients on [0, 1/2] and on [1/2, 1].
pub(super) fn halve(c: &[f64; ORDER], degree: usize) -> [[f64; ORDER]; 2] {
    let mut second = *c;
    let mut first = *c;
    for (level, value) in first.iter_mut().enumerate().take(degree + 1) {
        if level > 0 {
            for i in 0..=degree - level {
                second[i] = 0.5 * (second[i] + second[i + 1]);
            }
        }
        *value = second[0];
    }
    [first, second]
}

/// The root in [`low`, `high`] of a polynomial whose signs differ at the two ends: Newton's method inside a bracket that
/// bisection keeps. When the signs do not differ, the end at which the value is smaller.
pub(super) fn bracketed(c: &[f64], low: f64, high: f64, guess: f64) -> f64 {
    let (mut a, mut b) = (low, high);
    let ((at_a, slope_a), (at_b, slope_b)) = (value_and_slope(c, a), value_and_slope(c, b));
    let rising = minus(at_a);
    if rising == minus(at_b) {
        return if at_a.abs() <= at_b.abs() { a } else { b };
    }
    // A zero at an end is the place only if the sign changes there; else the polynomial comes back to zero inside.
    if at_a == 0.0 && slope_a < 0.0 {
        return a;
    }
    if at_b == 0.0 && slope_b > 0.0 {
        return b;
    }
    let mut t = if guess > a && guess < b { guess } else { 0.5 * (a + b) };
    for _ in 0..120 {
        let (value, slope) = value_and_slope(c, t);
        if value == 0.0 && (slope > 0.0) == rising {
            return t;
        }
        if minus(value) == rising {
            a = t;
        } else {
            b = t;
        }
        let newton = t - value / slope;
        let next = if newton > a && newton < b { newton } else { 0.5 * (a + b) };
        if (next - t).abs() <= 2e-16 {
            return next;
        }
        t = next;
    }
    t
}

/// Appends the places on [0, 1] where the sign of the polynomial changes, in increasing order. Descartes' rule isolates
/// them (Lane & Riesenfeld 1981); none is missed, places closer than 2^-40 count as one or, when the sign comes back,
/// as none.
pub(super) fn sign_changes(c: &[f64; ORDER], degree: usize, out: &mut Vec<f64>) {
    isolate(c, degree, 0.0, 1.0, 0, out);
}

fn isolate(c: &[f64; ORDER], degree: usize, low: f64, width: f64, depth: u32, out: &mut Vec<f64>) {
    let variations = c[..=degree].windows(2).filter(|w| minus(w[0]) != minus(w[1])).count();
    if variations == 0 {
        return;
    }
    if variations == 1 {
        let (first, last) = (c[0], c[degree]);
        let root = bracketed(&c[..=degree], 0.0, 1.0, first / (first - last));
        out.push(low + width * root);
    } else if depth == DEEPEST {
        if minus(c[0]) != minus(c[degree]) {
            out.push(low + 0.5 * width);
        }
    } else {
        let [first, second] = halve(c, degree);
        isolate(&first, degree, low, 0.5 * width, depth + 1, out);
        isolate(&second, degree, low + 0.5 * width, 0.5 * width, depth + 1, out);
    }
}

/// The parameters at which the sign of a scalar spline changes, in increasing order.
pub(in super::super) fn curve_sign_changes(curve: &BsplineCurve<1>) -> Vec<f64> {
    let (a, b) = curve.knots().domain();
    let mut changes = Vec::new();
    let mut local = Vec::new();
    let mut before: Option<f64> = None;
    for arc in Arc::of(curve, a, b) {
        let mut c = [0.0; ORDER];
        for (value, point) in c.iter_mut().zip(arc.control()) {
            *value = point[0];
        }
        // The value at a joint is taken once.
        if let Some(value) = before {
            c[0] = value;
        }
        before = Some(c[arc.degree]);
        local.clear();
        sign_changes(&c, arc.degree, &mut local);
        changes.extend(local.iter().map(|r| arc.low + r * (arc.high - arc.low)));
    }
    changes
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn roots_of_a_cubic() {
        // (t - 0.2)(t - 0.5)(t - 0.9) in Bernstein form by its values: c = a + b t + ...
        let (a, b, d) = (-0.09, 0.73, -1.6);
        let mut c = [0.0; ORDER];
        c[0] = a;
        c[1] = a + b / 3.0;
        c[2] = a + 2.0 * b / 3.0 + d / 3.0;
        c[3] = a + b + d + 1.0;
        let mut roots = Vec::new();
        sign_changes(&c, 3, &mut roots);
        assert_eq!(roots.len(), 3);
        for (root, exact) in roots.iter().zip([0.2, 0.5, 0.9]) {
            assert!((root - exact).abs() < 1e-14, "{root} {exact}");
        }
    }

    #[test]
    fn a_zero_at_an_end_is_not_taken_for_a_later_change() {
        // t (0.5 - t): + at 0, rises, falls through 0 at 0.5.
        let mut c = [0.0; ORDER];
        c[..3].copy_from_slice(&[0.0, 0.25, -0.5]);
        let mut roots = Vec::new();
        sign_changes(&c, 2, &mut roots);
        assert_eq!(roots.len(), 1);
        assert!((roots[0] - 0.5).abs() < 1e-15);
        // -t: + at 0 only.
        roots.clear();
        c[..3].copy_from_slice(&[0.0, -0.5, -1.0]);
        sign_changes(&c, 2, &mut roots);
        assert_eq!(roots, [0.0]);
    }

    #[test]
    fn a_double_root_does_not_change_the_sign() {
        let mut c = [0.0; ORDER];
        c[..3].copy_from_slice(&[0.25, -0.25, 0.25]);
        let mut roots = Vec::new();
        sign_changes(&c, 2, &mut roots);
        assert!(roots.is_empty() || roots.len() == 2, "{roots:?}");
    }

    #[test]
    fn arcs_are_the_curve() {
        let knots = KnotVector::new(3, vec![0.0, 0.0, 0.0, 0.0, 0.3, 0.7, 0.7, 1.0, 1.0, 1.0, 1.0]).unwrap();
        let points = (0..7).map(|i| [f64::from(i), f64::from(i * i % 5), f64::from(i % 3)]).collect();
        let curve = BsplineCurve::new(knots, points).unwrap();
        let arcs = Arc::of(&curve, 0.1, 0.9);
        assert_eq!(arcs.len(), 3);
        let joined = join(&arcs).unwrap();
        for k in 0..=40 {
            let t = 0.1 + 0.8 * f64::from(k) / 40.0;
            for (a, b) in joined.eval(t).iter().zip(curve.eval(t)) {
                assert!((a - b).abs() < 1e-13);
            }
        }
        let [first, second] = arcs[1].split(0.25);
        for (a, b) in first.at(1.0).iter().zip(second.at(0.0)) {
            assert!((a - b).abs() < 1e-14);
        }
        for (a, b) in second.at(0.5).iter().zip(arcs[1].at(0.625)) {
            assert!((a - b).abs() < 1e-14);
        }
    }
}
