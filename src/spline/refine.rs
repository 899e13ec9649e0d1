//! Knot insertion, degree elevation, splitting and clamping: new control points of the same shape.
//!
//! Every new control point is a blossom of the old spline at successive new knots. Arranged as rows of the Oslo
//! algorithm (Cohen, Lyche & Riesenfeld 1980; Lyche & Morken 1986) it is a convex combination of at most `degree + 1`
//! old ones, so that rounding does not grow: shapes are kept to about 1e-15 of their size. Elevation is the mean over
//! the blossoms that leave out one argument (Ramshaw 1989; Piegl & Tiller 1997, 5.5).

use super::basis::{HIGHEST_DEGREE, MAX_DEGREE, WideValues, blossom_row};
use super::curve::BsplineCurve;
use super::knots::{KnotVector, SplineError};
use super::surface::BsplineSurface;

/// The index k with t_k <= t < t_{k+1} among old knots, within the spans `degree ..= count - 1` of positive length.
fn last_not_above(knots: &[f64], degree: usize, count: usize, t: f64) -> usize {
    let mut span = knots.partition_point(|&knot| knot <= t).saturating_sub(1).clamp(degree, count - 1);
    while span > degree && knots[span] >= knots[span + 1] {
        span -= 1;
    }
    span
}

/// One new control point: index of the first old control point it depends on, and the weights.
pub(super) struct RefinementRow {
    pub(super) first: usize,
    pub(super) weights: WideValues,
}

/// Rows that take control points over `old` knots (of `degree`, clamped or not) to control points over the refinement
/// `new`, which holds each of `old` knots at least as often and whose first and last `degree + 1` knots lie in the
/// domain.
pub(super) fn refinement_rows(degree: usize, old: &[f64], new: &[f64]) -> Vec<RefinementRow> {
    let count = old.len() - degree - 1;
    (0..new.len() - degree - 1)
        .map(|i| {
            let span = last_not_above(old, degree, count, new[i]);
            RefinementRow { first: span - degree, weights: blossom_row(old, span, &new[i + 1..=i + degree]) }
        })
        .collect()
}

/// Rows that take control points over `old` clamped knots of `degree` to those of `degree + 1` over `new` knots, in which
/// every knot occurs once more. A row spans up to `2 degree + 1` old control points.
fn elevation_rows(degree: usize, old: &[f64], new: &[f64]) -> Vec<(usize, Vec<f64>)> {
    let count = old.len() - degree - 1;
    (0..new.len() - degree - 2)
        .map(|i| {
            let span = last_not_above(old, degree, count, new[i]);
            let arguments = &new[i + 1..=i + degree + 1];
            let mut weights = vec![0.0; degree + 1];
            let mut others = [0.0; MAX_DEGREE];
            for left_out in 0..=degree {
                let kept = arguments.iter().enumerate().filter(|&(k, _)| k != left_out).map(|(_, t)| *t);
                others.iter_mut().zip(kept).for_each(|(slot, t)| *slot = t);
                let row = blossom_row(old, span, &others[..degree]);
                weights.iter_mut().zip(row).for_each(|(sum, w)| *sum += w / (degree + 1) as f64);
            }
            (span - degree, weights)
        })
        .collect()
}

/// Applies rows to items of `width` coordinates each.
pub(super) fn apply<'a, const D: usize>(
    rows: impl Iterator<Item = (usize, &'a [f64])>,
    points: &[[f64; D]],
    width: usize,
) -> Vec<[f64; D]> {
    let mut result = Vec::new();
    for (first, weights) in rows {
        let start = result.len();
        result.resize(start + width, [0.0; D]);
        for (k, &weight) in weights.iter().enumerate() {
            if weight == 0.0 {
                continue;
            }
            let item = &points[(first + k) * width..(first + k + 1) * width];
            for (sum, point) in result[start..].iter_mut().zip(item) {
                for d in 0..D {
                    sum[d] += weight * point[d];
                }
            }
        }
    }
    result
}

fn apply_refinement<const D: usize>(
    rows: &[RefinementRow],
    degree: usize,
    points: &[[f64; D]],
    width: usize,
) -> Vec<[f64; D]> {
    apply(rows.iter().map(|row| (row.first, &row.weights[..=degree])), points, width)
}

/// What becomes of the items of one direction: new knots and new items.
type Changed<const D: usize> = (KnotVector, Vec<[f64; D]>);

fn insert<const D: usize>(
    knots: &KnotVector,
    points: &[[f64; D]],
    width: usize,
    inserted: &[f64],
) -> Result<Changed<D>, SplineError> {
    let (a, b) = knots.domain();
    for (index, &value) in inserted.iter().enumerate() {
        if !(value > a && value < b) {
            return Err(SplineError::Knot { index, value, problem: "not inside the domain" });
        }
    }
    let mut all = knots.knots().to_vec();
    all.extend(inserted);
    all.sort_by(f64::total_cmp);
    let new = KnotVector::new(knots.degree(), all)?;
    let rows = refinement_rows(knots.degree(), knots.knots(), new.knots());
    Ok((new, apply_refinement(&rows, knots.degree(), points, width)))
}

fn elevate<const D: usize>(
    knots: &KnotVector,
    points: &[[f64; D]],
    width: usize,
    times: usize,
) -> Result<Changed<D>, SplineError> {
    if knots.degree() + times > MAX_DEGREE {
        return Err(SplineError::Degree(knots.degree() + times));
    }
    let mut changed = (knots.clone(), points.to_vec());
    for _ in 0..times {
        let (knots, points) = changed;
        let breaks = knots.breakpoints();
        let interior = &breaks[1..breaks.len() - 1];
        let multiplicities: Vec<usize> = interior.iter().map(|&t| knots.multiplicity(t) + 1).collect();
        let new = KnotVector::from_breakpoints(knots.degree() + 1, &breaks, &multiplicities)?;
        let rows = elevation_rows(knots.degree(), knots.knots(), new.knots());
        changed = (new, apply(rows.iter().map(|(first, weights)| (*first, &weights[..])), &points, width));
    }
    Ok(changed)
}

/// The items of the part between `from` and `to`.
fn part<const D: usize>(
    knots: &KnotVector,
    points: &[[f64; D]],
    width: usize,
    from: f64,
    to: f64,
) -> Result<Changed<D>, SplineError> {
    let (a, b) = knots.domain();
    for (index, value) in [from, to].into_iter().enumerate() {
        if !(value >= a && value <= b) {
            return Err(SplineError::Knot { index, value, problem: "not in the domain" });
        }
    }
    if to <= from {
        return Err(SplineError::Knot { index: 1, value: to, problem: "not above the start of the part" });
    }
    let p = knots.degree();
    let inside = knots.knots().iter().copied().filter(|&t| t > from && t < to);
    let new: Vec<f64> = std::iter::repeat_n(from, p + 1).chain(inside).chain(std::iter::repeat_n(to, p + 1)).collect();
    let rows = refinement_rows(p, knots.knots(), &new);
    Ok((KnotVector::new(p, new)?, apply_refinement(&rows, p, points, width)))
}

/// Items over knots that need not be clamped: the same shape on its domain [t_p, t_n], n items, over clamped knots.
fn clamped<const D: usize>(
    degree: usize,
    knots: Vec<f64>,
    points: Vec<[f64; D]>,
    width: usize,
) -> Result<Changed<D>, SplineError> {
    let expected = knots.len().saturating_sub(degree + 1);
    if !(1..=HIGHEST_DEGREE).contains(&degree) {
        return Err(SplineError::AnyDegree(degree));
    }
    if expected <= degree || points.len() != expected * width {
        return Err(SplineError::PointCount { found: points.len(), expected: expected * width });
    }
    let bad = |index: usize, problem| Err(SplineError::Knot { index, value: knots[index], problem });
    if let Some(index) = knots.iter().position(|t| !t.is_finite()) {
        return bad(index, "not finite");
    }
    if let Some(index) = knots.windows(2).position(|w| w[1] < w[0]) {
        return bad(index + 1, "smaller than the knot before it");
    }
    let (a, b) = (knots[degree], knots[expected]);
    if b <= a {
        return bad(expected, "not above the start of the domain");
    }
    let inside = knots.iter().copied().filter(|&t| t > a && t < b);
    let new: Vec<f64> =
        std::iter::repeat_n(a, degree + 1).chain(inside).chain(std::iter::repeat_n(b, degree + 1)).collect();
    if new == knots {
        return Ok((KnotVector::new(degree, new)?, points));
    }
    let rows = refinement_rows(degree, &knots, &new);
    Ok((KnotVector::new(degree, new)?, apply_refinement(&rows, degree, &points, width)))
}

/// The knots that are missing to make every interior breakpoint `degree` fold.
pub(super) fn missing_for_bezier(knots: &KnotVector) -> Vec<f64> {
    let breaks = knots.breakpoints();
    let interior = &breaks[1..breaks.len() - 1];
    interior.iter().flat_map(|&t| std::iter::repeat_n(t, knots.degree() - knots.multiplicity(t))).collect()
}

impl<const D: usize> BsplineCurve<D> {
    /// The curve of control points over knots that need not be clamped, periodic ones among them, on its domain
    /// [t_p, t_n] (n control points): knots are inserted until both ends are `degree + 1` fold (Boehm 1980).
    ///
    /// # Errors
    /// [`SplineError`] when degree, knots and points do not make a spline.
    pub fn clamped(degree: usize, knots: Vec<f64>, points: Vec<[f64; D]>) -> Result<Self, SplineError> {
        let (knots, points) = clamped(degree, knots, points, 1)?;
        Self::new(knots, points)
    }

    /// The same curve with more knots, each as often as listed; the order does not matter.
    ///
    /// # Errors
    /// [`SplineError::Knot`] when a knot is not strictly inside the domain or would occur more often than the degree.
    pub fn insert_knots(&self, inserted: &[f64]) -> Result<Self, SplineError> {
        let (knots, points) = insert(self.knots(), self.points(), 1, inserted)?;
        Ok(Self::from_parts(knots, points))
    }

    /// The same curve with its degree raised by `times`; every multiplicity rises likewise.
    ///
    /// # Errors
    /// [`SplineError::Degree`] when the new degree is above [`MAX_DEGREE`].
    pub fn elevate(&self, times: usize) -> Result<Self, SplineError> {
        let (knots, points) = elevate(self.knots(), self.points(), 1, times)?;
        Ok(Self::from_parts(knots, points))
    }

    /// The curve between the parameters `from` and `to`, on the domain [`from`, `to`].
    ///
    /// # Errors
    /// [`SplineError::Knot`] when they do not rise or leave the domain.
    pub fn part(&self, from: f64, to: f64) -> Result<Self, SplineError> {
        let (knots, points) = part(self.knots(), self.points(), 1, from, to)?;
        Ok(Self::from_parts(knots, points))
    }

    /// The curves before and after the parameter `t`; they share the point there exactly.
    ///
    /// # Errors
    /// [`SplineError::Knot`] when `t` is not strictly inside the domain.
    pub fn split(&self, t: f64) -> Result<[Self; 2], SplineError> {
        let (a, b) = self.knots().domain();
        let halves = [self.part(a, t)?, self.part(t, b)?];
        Ok(halves)
    }

    /// The same curve run through backwards, on the same domain: t -> C(a + b - t).
    #[must_use]
    pub fn reversed(&self) -> Self {
        Self::from_parts(self.knots().reversed(), self.points().iter().rev().copied().collect())
    }
}

impl KnotVector {
    /// The knots mirrored in the middle of their domain.
    #[must_use]
    pub fn reversed(&self) -> Self {
        let (a, b) = self.domain();
        let p = self.degree();
        let count = self.basis_count();
        let mirrored = |(i, &t): (usize, &f64)| match i {
            i if i < count && i > p => a + (b - t),
            i if i <= p => b,
            _ => a,
        };
        let knots: Vec<f64> = self.knots().iter().enumerate().map(mirrored).rev().collect();
        Self::from_checked(p, knots)
    }
}

impl<const D: usize> BsplineSurface<D> {
    /// The surface of a net, `u` slowest, over knots that need not be clamped in either direction; see
    /// [`BsplineCurve::clamped`].
    ///
    /// # Errors
    /// [`SplineError`] when degrees, knots and points do not make a spline.
    pub fn clamped(degrees: [usize; 2], knots: [Vec<f64>; 2], points: Vec<[f64; D]>) -> Result<Self, SplineError> {
        let [in_u, in_v] = knots;
        let columns = in_v.len().saturating_sub(degrees[1] + 1);
        let (u, points) = clamped(degrees[0], in_u, points, columns)?;
        let rows = u.basis_count();
        let turned = (0..columns).flat_map(|j| (0..rows).map(move |i| i * columns + j)).map(|k| points[k]).collect();
        let (v, net) = clamped(degrees[1], in_v, turned, rows)?;
        Ok(Self::new(v, u, net)?.transposed())
    }

    /// The same surface with more knots in u and in v.
    ///
    /// # Errors
    /// [`SplineError::Knot`] when a knot is not strictly inside its domain or would occur more often than the degree.
    pub fn insert_knots(&self, in_u: &[f64], in_v: &[f64]) -> Result<Self, SplineError> {
        self.change(
            |knots, points, width| insert(knots, points, width, in_u),
            |knots, points, width| insert(knots, points, width, in_v),
        )
    }

    /// The same surface with its degrees raised by `in_u` and `in_v`.
    ///
    /// # Errors
    /// [`SplineError::Degree`] when a new degree is above [`MAX_DEGREE`].
    pub fn elevate(&self, in_u: usize, in_v: usize) -> Result<Self, SplineError> {
        self.change(
            |knots, points, width| elevate(knots, points, width, in_u),
            |knots, points, width| elevate(knots, points, width, in_v),
        )
    }

    /// The surface over [`u[0]`, `u[1]`] x [`v[0]`, `v[1]`].
    ///
    /// # Errors
    /// [`SplineError::Knot`] when the bounds do not rise or leave the domain.
    pub fn part(&self, u: [f64; 2], v: [f64; 2]) -> Result<Self, SplineError> {
        self.change(
            |knots, points, width| part(knots, points, width, u[0], u[1]),
            |knots, points, width| part(knots, points, width, v[0], v[1]),
        )
    }

    /// The surfaces before and after the line at `u`; they share it exactly.
    ///
    /// # Errors
    /// [`SplineError::Knot`] when `u` is not strictly inside the domain.
    pub fn split_u(&self, u: f64) -> Result<[Self; 2], SplineError> {
        let ((a, b), (c, d)) = (self.u().domain(), self.v().domain());
        Ok([self.part([a, u], [c, d])?, self.part([u, b], [c, d])?])
    }

    /// The surfaces before and after the line at `v`; they share it exactly.
    ///
    /// # Errors
    /// [`SplineError::Knot`] when `v` is not strictly inside the domain.
    pub fn split_v(&self, v: f64) -> Result<[Self; 2], SplineError> {
        let ((a, b), (c, d)) = (self.u().domain(), self.v().domain());
        Ok([self.part([a, b], [c, v])?, self.part([a, b], [v, d])?])
    }

    fn change(
        &self,
        in_u: impl Fn(&KnotVector, &[[f64; D]], usize) -> Result<Changed<D>, SplineError>,
        in_v: impl Fn(&KnotVector, &[[f64; D]], usize) -> Result<Changed<D>, SplineError>,
    ) -> Result<Self, SplineError> {
        let (u, points) = in_u(self.u(), self.points(), self.v().basis_count())?;
        let across = Self::from_parts(u, self.v().clone(), points).transposed();
        let (v, points) = in_v(across.u(), across.points(), across.v().basis_count())?;
        Ok(Self::from_parts(v, across.v().clone(), points).transposed())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spline::tests::{curve, distance, parameters, surface};
    use proptest::prelude::*;

    /// Worked example 5.1 of Piegl & Tiller 1997: 5/2 into a cubic, new points weighted 5/6, 1/2 and 1/6.
    #[test]
    fn insertion_of_a_new_knot_as_in_the_nurbs_book() {
        let knots = KnotVector::new(3, vec![0., 0., 0., 0., 1., 2., 3., 4., 5., 5., 5., 5.]).unwrap();
        let points: Vec<[f64; 2]> = (0..8).map(|i| [f64::from(i), f64::from(i * i) - 3.0 * f64::from(i % 3)]).collect();
        let new = BsplineCurve::new(knots, points.clone()).unwrap().insert_knots(&[2.5]).unwrap();
        let mix = |i: usize, a: f64| [0, 1].map(|d| a * points[i][d] + (1.0 - a) * points[i - 1][d]);
        let expected = [
            points[0],
            points[1],
            points[2],
            mix(3, 5.0 / 6.0),
            mix(4, 0.5),
            mix(5, 1.0 / 6.0),
            points[5],
            points[6],
            points[7],
        ];
        assert!(distance(new.points(), &expected) < 1e-14, "{:?}", new.points());
    }

    /// A circle of seven points over periodic knots, and a cubic over uniform ones, before and after they are clamped.
    #[test]
    fn splines_over_periodic_knots_are_clamped_exactly() {
        let third = std::f64::consts::TAU / 3.0;
        let knots: Vec<f64> = [-1, 0, 0, 1, 1, 2, 2, 3, 3, 4].map(|k| f64::from(k) * third).to_vec();
        let round = |k: usize| {
            let (w, radius) = if k.is_multiple_of(2) { (1.0, 1.0) } else { (0.5, 2.0) };
            let angle = 0.5 * third * k as f64;
            [w * radius * angle.cos(), w * radius * angle.sin(), w]
        };
        let points: Vec<[f64; 3]> = (0..7).map(round).collect();
        let circle = BsplineCurve::clamped(2, knots.clone(), points.clone()).unwrap();
        assert_eq!(circle.knots().domain(), (0.0, 3.0 * third));
        for k in 0..=60 {
            let [x, y, w] = circle.eval(f64::from(k) * third / 20.0);
            assert!((x.hypot(y) / w - 1.0).abs() < 1e-14);
        }
        let cubic = BsplineCurve::clamped(3, (0..9).map(f64::from).collect(), vec![[0.0], [6.0], [-6.0], [3.0], [1.0]]);
        let cubic = cubic.unwrap();
        assert_eq!(cubic.knots().domain(), (3.0, 5.0));
        // (P_0 + 4 P_1 + P_2)/6 at its start, by the uniform basis.
        for (t, exact) in [(3.0, 3.0), (4.0, (6.0 - 24.0 + 3.0) / 6.0), (5.0, (-6.0 + 12.0 + 1.0) / 6.0)] {
            assert!((cubic.eval(t)[0] - exact).abs() < 1e-14, "{t}");
        }
        // A cylinder, with the circle in either direction.
        let pair = vec![0.0, 0.0, 2.0, 2.0];
        let net: Vec<[f64; 4]> = points.iter().flat_map(|&[x, y, w]| [[x, y, 0.0, w], [x, y, 2.0 * w, w]]).collect();
        let along = BsplineSurface::clamped([2, 1], [knots.clone(), pair.clone()], net.clone()).unwrap();
        let turned = (0..2).flat_map(|j| (0..7).map(move |i| 2 * i + j)).map(|k| net[k]).collect();
        let around = BsplineSurface::clamped([1, 2], [pair, knots], turned).unwrap();
        assert_eq!(around.transposed(), along);
        let [x, y, z, w] = along.eval(1.0, 0.5);
        assert!((x.hypot(y) / w - 1.0).abs() < 1e-14 && (z / w - 0.5).abs() < 1e-14);
        let refused = BsplineCurve::clamped(2, vec![0.0, 1.0, 1.0, 1.0, 1.0, 2.0], vec![[0.0]; 3]).unwrap_err();
        assert!(refused.to_string().contains("not above the start of the domain"), "{refused}");
    }

    /// Bernstein polynomials of all degrees that files have.
    #[test]
    fn high_degrees_are_evaluated_and_cut() {
        for degree in 8..=HIGHEST_DEGREE {
            let points: Vec<[f64; 2]> =
                (0..=degree).map(|k| [k as f64 / degree as f64, f64::from(k == degree)]).collect();
            let curve = BsplineCurve::new(KnotVector::uniform(degree, 1).unwrap(), points).unwrap();
            let half = curve.part(0.25, 0.75).unwrap();
            for t in [0.25, 0.4, 0.75] {
                for [[x, y], [dx, _]] in [curve.derivatives::<2>(t), half.derivatives::<2>(t)] {
                    assert!(
                        (x - t).abs() < 1e-14 && (y - t.powi(degree as i32)).abs() < 1e-14 && (dx - 1.0).abs() < 1e-12
                    );
                }
            }
            let line = KnotVector::uniform(1, 1).unwrap();
            let net = curve.points().iter().flat_map(|&[x, y]| [[x, y], [x, y + 1.0]]).collect();
            let surface = BsplineSurface::new(curve.knots().clone(), line, net).unwrap();
            for surface in [surface.clone(), surface.transposed()] {
                let wanted = [0.5, 0.5f64.powi(degree as i32) + 0.5];
                let mut seen = surface.eval(0.5, 0.5);
                assert!((0..2).all(|d| (seen[d] - wanted[d]).abs() < 1e-14));
                surface.grid_jets(&[0.5], &[0.5], |_, _, jet| seen = jet.point);
                assert!((0..2).all(|d| (seen[d] - wanted[d]).abs() < 1e-14));
            }
        }
    }

    /// Worked example 5.2 of the same: 2 once more, weights 2/3 and 1/3.
    #[test]
    fn insertion_of_an_old_knot_as_in_the_nurbs_book() {
        let knots = KnotVector::new(3, vec![0., 0., 0., 0., 1., 2., 3., 4., 5., 5., 5., 5.]).unwrap();
        let points: Vec<[f64; 1]> = [3.0, -1.0, 4.0, 1.0, -5.0, 9.0, 2.0, 6.0].map(|y| [y]).to_vec();
        let new = BsplineCurve::new(knots, points).unwrap().insert_knots(&[2.0]).unwrap();
        let expected =
            [3.0, -1.0, 4.0, 2.0 / 3.0 + 4.0 / 3.0, -5.0 / 3.0 + 2.0 / 3.0, -5.0, 9.0, 2.0, 6.0].map(|y| [y]);
        assert!(distance(new.points(), &expected) < 1e-14, "{:?}", new.points());
    }

    /// A Bezier curve of degree p raised once: Q_i = i / (p + 1) P_{i-1} + (1 - i / (p + 1)) P_i (Farin 2002, 6.1).
    #[test]
    fn elevation_of_a_bezier_curve() {
        let points = vec![[1.0], [4.0], [-2.0], [7.0]];
        let new = BsplineCurve::new(KnotVector::uniform(3, 1).unwrap(), points).unwrap().elevate(1).unwrap();
        let expected = [[1.0], [0.25 + 3.0], [2.0 - 1.0], [-1.5 + 1.75], [7.0]];
        assert!(distance(new.points(), &expected) < 1e-15);
        assert_eq!(new.knots().degree(), 4);
    }

    #[test]
    fn what_cannot_be_refined_is_an_error() {
        let line = BsplineCurve::new(KnotVector::uniform(2, 2).unwrap(), vec![[0.0]; 4]).unwrap();
        assert!(matches!(line.insert_knots(&[0.0]), Err(SplineError::Knot { index: 0, .. })));
        assert!(matches!(line.insert_knots(&[0.5, 0.5]), Err(SplineError::Knot { .. })));
        assert!(line.insert_knots(&[f64::NAN]).is_err());
        assert_eq!(line.elevate(6), Err(SplineError::Degree(8)));
        assert!(matches!(line.part(0.7, 0.3), Err(SplineError::Knot { .. })));
        assert!(matches!(line.split(1.0), Err(SplineError::Knot { .. })));
    }

    proptest! {
        #[test]
        fn refined_curves_keep_their_shape(c in curve::<3>(7), fractions in prop::collection::vec(0.001f64..0.999, 1..6)) {
            let (a, b) = c.knots().domain();
            let inserted: Vec<f64> = fractions.iter().map(|f| a + (b - a) * f).collect();
            let refined = c.insert_knots(&inserted).unwrap();
            prop_assert_eq!(refined.points().len(), c.points().len() + inserted.len());
            let pieces = c.bezier_pieces();
            let halves = c.split(inserted[0]).unwrap();
            let seam = [halves[0].points()[halves[0].points().len() - 1], halves[1].points()[0]];
            prop_assert_eq!(seam[0].map(f64::to_bits), seam[1].map(f64::to_bits));
            let reversed = c.reversed();
            for t in parameters(c.knots()) {
                let exact = c.eval(t);
                prop_assert!(distance(&[refined.eval(t)], &[exact]) < 1e-13);
                prop_assert!(distance(&[reversed.eval(a + (b - t))], &[exact]) < 1e-13);
                let half = &halves[usize::from(t > inserted[0])];
                prop_assert!(distance(&[half.eval(t)], &[exact]) < 1e-13);
                let piece = pieces.iter().find(|piece| t <= piece.to).unwrap();
                prop_assert!(distance(&[piece.eval(t)], &[exact]) < 1e-13);
                for times in 1..=MAX_DEGREE - c.knots().degree() {
                    prop_assert!(distance(&[c.elevate(times).unwrap().eval(t)], &[exact]) < 1e-13);
                }
            }
        }

        #[test]
        fn refined_surfaces_keep_their_shape(s in surface::<3>(4), f in 0.01f64..0.99, g in 0.01f64..0.99) {
            let at = |k: &KnotVector, f: f64| k.domain().0 + (k.domain().1 - k.domain().0) * f;
            let (u0, v0) = (at(s.u(), f), at(s.v(), g));
            let refined = s.insert_knots(&[u0], &[v0]).unwrap();
            let raised = s.elevate(1, 2).unwrap();
            let (left, lower) = (s.split_u(u0).unwrap(), s.split_v(v0).unwrap());
            let patches = s.bezier_patches();
            for u in parameters(s.u()).into_iter().step_by(3) {
                for v in parameters(s.v()).into_iter().step_by(2) {
                    let exact = s.eval(u, v);
                    let patch = patches.iter().find(|p| u <= p.u[1] && v <= p.v[1]).unwrap();
                    let found = [
                        refined.eval(u, v),
                        raised.eval(u, v),
                        left[usize::from(u > u0)].eval(u, v),
                        lower[usize::from(v > v0)].eval(u, v),
                        s.transposed().eval(v, u),
                        patch.eval(u, v),
                    ];
                    prop_assert!(distance(&found, &[exact; 6]) < 1e-13, "{:?} {:?}", found, exact);
                }
            }
        }
    }
}
