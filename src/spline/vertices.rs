//! Uniform splines over vertices that may be repeated (Barsky & Greenberg 1980; Bartels, Beatty & Barsky 1987, chapter
//! 8).
//!
//! A uniform spline of degree p has one span for every p + 1 successive vertices, on which a cubic is S(t) = [t^3 t^2 t
//! 1] M_s [V_0 V_1 V_2 V_3]^T, 0 <= t <= 1, with M_s = 1/6 [[-1, 3, -3, 1], [3, -6, 3, 0], [-3, 0, 3, 0], [1, 4, 1,
//! 0]]. It does not pass through its vertices. A vertex that stands p times in succession is met, and the tangent may
//! break there: the spans on its two sides have no other vertex in common, so that they could as well be two splines
//! that share it.
//!
//! With both ends repeated p times the spline over the uniform knots is the one over the clamped knots with the same
//! control points, exactly and without a computation: the control points that clamping changes are affine combinations
//! of equal ones. The first p - 1 derivatives by the parameter vanish at a repeated vertex; directions exist as limits
//! only.

use super::curve::BsplineCurve;
use super::knots::{KnotVector, SplineError};
use super::surface::BsplineSurface;

/// Indices of `count` vertices, the ends and the `corners` repeated `degree` times.
fn repeated(degree: usize, count: usize, corners: &[usize]) -> Vec<usize> {
    let times = |k: usize| if k == 0 || k + 1 == count || corners.contains(&k) { degree } else { 1 };
    (0..count).flat_map(|k| std::iter::repeat_n(k, times(k))).collect()
}

/// The knots 0, 1, 2 .. of as many vertices, clamped.
fn knots(degree: usize, vertices: usize) -> Result<KnotVector, SplineError> {
    let least = degree + 1;
    if vertices < least {
        return Err(SplineError::PointCount { found: vertices, expected: least });
    }
    let spans = vertices - degree;
    let breakpoints: Vec<f64> = (0..=spans).map(|k| k as f64).collect();
    KnotVector::from_breakpoints(degree, &breakpoints, &vec![1; spans - 1])
}

impl<const D: usize> BsplineCurve<D> {
    /// The uniform spline of `degree` over the vertices, of which the ends and those with an index in `corners` are
    /// met: they are repeated `degree` times. The knots are 0, 1, 2 ..
    ///
    /// # Errors
    /// [`SplineError::Degree`]; [`SplineError::PointCount`] for fewer than two vertices; [`SplineError::NotFinite`].
    pub fn from_vertices(degree: usize, vertices: &[[f64; D]], corners: &[usize]) -> Result<Self, SplineError> {
        check(degree, vertices.len())?;
        let order = repeated(degree, vertices.len(), corners);
        Self::new(knots(degree, order.len())?, order.iter().map(|&k| vertices[k]).collect())
    }
}

impl<const D: usize> BsplineSurface<D> {
    /// The uniform surface of `degree` in both directions over a grid of vertices (`u` slowest, `columns` in v). The four
    /// boundary curves are those of the boundary vertices and the corners are met; `corners` are rows (u) and columns (v)
    /// along which two surfaces meet with a common curve and a free tangent.
    ///
    /// # Errors
    /// As [`BsplineCurve::from_vertices`], in each direction; [`SplineError::PointCount`] also when the vertices are no
    /// grid.
    pub fn from_vertices(
        degree: usize,
        columns: usize,
        vertices: &[[f64; D]],
        corners: [&[usize]; 2],
    ) -> Result<Self, SplineError> {
        let rows = vertices.len() / columns.max(1);
        if rows * columns != vertices.len() {
            return Err(SplineError::PointCount { found: vertices.len(), expected: rows * columns });
        }
        check(degree, rows)?;
        check(degree, columns)?;
        let [in_u, in_v] = [repeated(degree, rows, corners[0]), repeated(degree, columns, corners[1])];
        let net = in_u.iter().flat_map(|&i| in_v.iter().map(move |&j| vertices[i * columns + j])).collect();
        Self::new(knots(degree, in_u.len())?, knots(degree, in_v.len())?, net)
    }
}

fn check(degree: usize, vertices: usize) -> Result<(), SplineError> {
    if !(1..=crate::spline::basis::MAX_DEGREE).contains(&degree) {
        return Err(SplineError::Degree(degree));
    }
    if vertices < 2 {
        return Err(SplineError::PointCount { found: vertices, expected: 2 });
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    const VERTICES: [[f64; 2]; 5] = [[0.0, 0.0], [3.0, 9.0], [6.0, 3.0], [9.0, 6.0], [11.0, -2.0]];

    /// [t^3 t^2 t 1] M_s [V], written out.
    fn by_matrix(v: &[[f64; 2]], t: f64) -> [f64; 2] {
        let m = [[-1.0, 3.0, -3.0, 1.0], [3.0, -6.0, 3.0, 0.0], [-3.0, 0.0, 3.0, 0.0], [1.0, 4.0, 1.0, 0.0]];
        let powers = [t * t * t, t * t, t, 1.0];
        let weight = |k: usize| (0..4).map(|r| powers[r] * m[r][k] / 6.0).sum::<f64>();
        [0, 1].map(|d| (0..4).map(|k| weight(k) * v[k][d]).sum())
    }

    #[test]
    fn the_spline_is_that_of_the_basis_matrix() {
        for corners in [&[][..], &[2]] {
            let curve = BsplineCurve::from_vertices(3, &VERTICES, corners).unwrap();
            let repeated: Vec<[f64; 2]> = (0..5)
                .flat_map(|k| vec![VERTICES[k]; if k % 4 == 0 || corners.contains(&k) { 3 } else { 1 }])
                .collect();
            for span in 0..repeated.len() - 3 {
                for k in 0..=10 {
                    let t = f64::from(k) / 10.0;
                    let (found, exact) = (curve.eval(span as f64 + t), by_matrix(&repeated[span..span + 4], t));
                    assert!((0..2).all(|d| (found[d] - exact[d]).abs() < 1e-14), "{span} {t} {found:?} {exact:?}");
                }
            }
            let (a, b) = curve.knots().domain();
            for (t, vertex) in [(a, VERTICES[0]), (b, VERTICES[4])] {
                assert!((0..2).all(|d| (curve.eval(t)[d] - vertex[d]).abs() < 1e-15));
            }
        }
    }

    /// A curve with a corner is two curves that share the vertex.
    #[test]
    fn a_corner_parts_the_spline() {
        let whole = BsplineCurve::from_vertices(3, &VERTICES, &[2]).unwrap();
        let [left, right] = [&VERTICES[..3], &VERTICES[2..]].map(|v| BsplineCurve::from_vertices(3, v, &[]).unwrap());
        let middle = left.knots().domain().1;
        for k in 0..=40 {
            let t = f64::from(k) / 10.0;
            let pairs = [(whole.eval(t), left.eval(t)), (whole.eval(middle + t), right.eval(t))];
            for (a, b) in pairs {
                assert!((0..2).all(|d| (a[d] - b[d]).abs() < 1e-14), "{t} {a:?} {b:?}");
            }
        }
    }

    #[test]
    fn what_makes_no_spline_is_an_error() {
        assert_eq!(
            BsplineCurve::from_vertices(3, &VERTICES[..1], &[]).unwrap_err().to_string(),
            "1 control points, expected 2"
        );
        assert_eq!(BsplineCurve::from_vertices(0, &VERTICES, &[]).unwrap_err(), SplineError::Degree(0));
        let surface = |columns| BsplineSurface::from_vertices(3, columns, &VERTICES, [&[], &[]]);
        assert!(matches!(surface(2), Err(SplineError::PointCount { found: 5, expected: 4 })));
        assert!(matches!(surface(5), Err(SplineError::PointCount { found: 1, expected: 2 })));
        assert!(matches!(surface(0), Err(SplineError::PointCount { .. })));
        // Two vertices of degree 1 are a line.
        let middle = BsplineCurve::from_vertices(1, &VERTICES[..2], &[]).unwrap().eval(0.5);
        assert!((middle[0] - 1.5).abs() < 1e-15 && (middle[1] - 4.5).abs() < 1e-15);
    }
}
