//! The hull: a half-breadth surface over the centreplane.
//!
//! S(u, v) = (x(u, v), y(u, v), z(v)), a tensor-product B-spline with one knot vector in u (aft to forward) and one in v
//! (bottom to top). x and z are fixed functions of the parameters, y is the shape. Waterlines are the lines v = constant.
//! The body is {(x, y, z): |y| <= y(x, z)} over the domain of the surface, so that what closes it is implied and plane or
//! ruled:
//! * the flat of bottom, at z = z(v_min), where y > 0 on the lowest line;
//! * the transom, over the stern profile u = u_min, and a flat bow over the stem profile u = u_max, where y > 0 there;
//! * the deck, at the height of the deck at side; the surface reaches up to the highest point of the deck and the body
//!   ends at the deck.

use super::particulars::PrincipalParticulars;
use crate::spline::{BsplineCurve, BsplineSurface, SplineError};

/// Why data do not make a hull.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum HullError {
    /// The spline data do not fit together.
    #[error(transparent)]
    Spline(#[from] SplineError),
    /// A main dimension is not a positive number.
    #[error("{name} is {value} m; it must be a positive number")]
    Dimension {
        /// Name of the dimension.
        name: &'static str,
        /// Its value \[m\].
        value: f64,
    },
    /// The heights of the net are not one rising sequence, the same in every column.
    #[error("heights of the net, row {row}, column {column}: {problem}")]
    Heights {
        /// Index in u.
        row: usize,
        /// Index in v.
        column: usize,
        /// What is wrong.
        problem: &'static str,
    },
    /// The lengths of the net do not rise from aft to forward along a waterline.
    #[error("lengths of the net, row {row}, column {column}: x falls from aft to forward")]
    Lengths {
        /// Index in u.
        row: usize,
        /// Index in v.
        column: usize,
    },
    /// A half-breadth of the net that has nothing to do with the breadth.
    #[error(
        "half-breadths of the net, row {row}, column {column}: {value} m; with B {breadth} m it must be between -B and 10 B"
    )]
    Breadths {
        /// Index in u.
        row: usize,
        /// Index in v.
        column: usize,
        /// The value \[m\].
        value: f64,
        /// B \[m\].
        breadth: f64,
    },
    /// The deck at side does not rise in x, or lies outside the surface.
    #[error("deck at side, point {index}: {problem}")]
    Deck {
        /// Index of the control point.
        index: usize,
        /// What is wrong.
        problem: &'static str,
    },
}

/// A ship's hull, one side of it, symmetric about the centreplane.
#[derive(Debug, Clone, PartialEq)]
pub struct Hull {
    name: String,
    particulars: PrincipalParticulars,
    surface: BsplineSurface<3>,
    deck: BsplineCurve<2>,
    heights: BsplineCurve<1>,
}

impl Hull {
    /// Takes the surface (control points x, y, z in metres) and the deck at side (control points x, z; x rises).
    ///
    /// # Errors
    /// [`HullError`] when a dimension is not positive, a control half-breadth lies outside -B to 10 B, z depends on u or does not
    /// rise with v, x does not rise with u, or
    /// the deck does not rise in x or leaves the range of heights of the surface.
    pub fn new(
        name: &str,
        particulars: PrincipalParticulars,
        surface: BsplineSurface<3>,
        deck: BsplineCurve<2>,
    ) -> Result<Self, HullError> {
        let p = particulars;
        for (label, value) in
            [("Lpp", p.length_between_perpendiculars), ("B", p.breadth), ("T", p.draught), ("D", p.depth)]
        {
            if !(value.is_finite() && value > 0.0) {
                return Err(HullError::Dimension { name: label, value });
            }
        }
        let [rows, columns] = surface.shape();
        for row in 0..rows {
            for column in 0..columns {
                let [x, y, z] = surface.point(row, column);
                if !(-p.breadth..=10.0 * p.breadth).contains(&y) {
                    return Err(HullError::Breadths { row, column, value: y, breadth: p.breadth });
                }
                if z.to_bits() != surface.point(0, column)[2].to_bits() {
                    return Err(HullError::Heights { row, column, problem: "z differs along a waterline" });
                }
                if column > 0 && z < surface.point(row, column - 1)[2] {
                    return Err(HullError::Heights { row, column, problem: "z falls from bottom to top" });
                }
                if row > 0 && x < surface.point(row - 1, column)[0] {
                    return Err(HullError::Lengths { row, column });
                }
            }
        }
        let heights =
            BsplineCurve::new(surface.v().clone(), (0..columns).map(|column| [surface.point(0, column)[2]]).collect())?;
        let (bottom, top) = (surface.point(0, 0)[2], surface.point(0, columns - 1)[2]);
        if top <= bottom {
            return Err(HullError::Heights { row: 0, column: columns - 1, problem: "the hull has no height" });
        }
        let slack = 1e-9 * (top - bottom);
        for (index, point) in deck.points().iter().enumerate() {
            if index > 0 && point[0] <= deck.points()[index - 1][0] {
                return Err(HullError::Deck { index, problem: "x does not rise" });
            }
            if point[1] < bottom - slack || point[1] > top + slack {
                return Err(HullError::Deck { index, problem: "outside the heights of the surface" });
            }
        }
        Ok(Self { name: name.to_owned(), particulars, surface, deck, heights })
    }

    /// The name.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The main dimensions.
    #[must_use]
    pub fn particulars(&self) -> &PrincipalParticulars {
        &self.particulars
    }

    /// The surface; its control points are (x, y, z) \[m\].
    #[must_use]
    pub fn surface(&self) -> &BsplineSurface<3> {
        &self.surface
    }

    /// z(v) \[m\].
    #[must_use]
    pub fn heights(&self) -> &BsplineCurve<1> {
        &self.heights
    }

    /// The deck at side in the profile: control points (x, z) \[m\], x rising.
    #[must_use]
    pub fn deck(&self) -> &BsplineCurve<2> {
        &self.deck
    }

    /// Height of the lowest line of the surface \[m\].
    #[must_use]
    pub fn bottom(&self) -> f64 {
        self.heights.points()[0][0]
    }

    /// Height of the highest line of the surface \[m\].
    #[must_use]
    pub fn top(&self) -> f64 {
        self.heights.points()[self.heights.points().len() - 1][0]
    }

    /// The parameter v at which z(v) is `z`, to rounding; none outside the heights of the surface.
    #[must_use]
    pub fn height_parameter(&self, z: f64) -> Option<f64> {
        let (a, b) = self.heights.knots().domain();
        solve_increasing(z, (a, b), (self.bottom(), self.top()), |v| {
            let [value, slope] = self.heights.derivatives::<2>(v);
            (value[0], slope[0])
        })
    }

    /// The parameter u at which x(u, v) is `x` on the waterline `v`, to rounding; none beyond its ends.
    #[must_use]
    pub fn length_parameter(&self, x: f64, v: f64) -> Option<f64> {
        let domain = self.surface.u().domain();
        let ends = (self.surface.eval(domain.0, v)[0], self.surface.eval(domain.1, v)[0]);
        solve_increasing(x, domain, ends, |u| {
            let d = self.surface.derivatives::<2>(u, v);
            (d[0][0][0], d[1][0][0])
        })
    }

    /// The half-breadth at (x, z) \[m\]; none where the surface does not reach.
    #[must_use]
    pub fn half_breadth(&self, x: f64, z: f64) -> Option<f64> {
        let v = self.height_parameter(z)?;
        let u = self.length_parameter(x, v)?;
        Some(self.surface.eval(u, v)[1])
    }

    /// Ends of the waterline at height `z`: x at the stern and at the stem profile \[m\]; none outside the surface.
    #[must_use]
    pub fn endings(&self, z: f64) -> Option<[f64; 2]> {
        let v = self.height_parameter(z)?;
        let (a, b) = self.surface.u().domain();
        Some([self.surface.eval(a, v)[0], self.surface.eval(b, v)[0]])
    }

    /// Height of the deck at side at `x` \[m\]; beyond the ends of the deck, the height of its end.
    #[must_use]
    pub fn deck_height(&self, x: f64) -> f64 {
        let domain = self.deck.knots().domain();
        let points = self.deck.points();
        let ends = (points[0], points[points.len() - 1]);
        if x <= ends.0[0] {
            return ends.0[1];
        }
        if x >= ends.1[0] {
            return ends.1[1];
        }
        let t = solve_increasing(x, domain, (ends.0[0], ends.1[0]), |t| {
            let [value, slope] = self.deck.derivatives::<2>(t);
            (value[0], slope[0])
        });
        self.deck.eval(t.unwrap_or(domain.0))[1]
    }
}

/// Root of an increasing function by Newton's method inside a bracket that bisection keeps.
fn solve_increasing(
    target: f64,
    domain: (f64, f64),
    ends: (f64, f64),
    function: impl Fn(f64) -> (f64, f64),
) -> Option<f64> {
    let slack = 1e-12 * (ends.1 - ends.0).abs().max(ends.0.abs()).max(ends.1.abs());
    if !(ends.0 - slack..=ends.1 + slack).contains(&target) {
        return None;
    }
    if target <= ends.0 {
        return Some(domain.0);
    }
    if target >= ends.1 {
        return Some(domain.1);
    }
    let (mut low, mut high) = domain;
    let mut t = low + (high - low) * (target - ends.0) / (ends.1 - ends.0);
    for _ in 0..200 {
        let (value, slope) = function(t);
        let error = value - target;
        if error > 0.0 {
            high = t;
        } else if error < 0.0 {
            low = t;
        } else {
            return Some(t);
        }
        let newton = t - error / slope;
        let next = if newton > low && newton < high { newton } else { 0.5 * (low + high) };
        if (next - t).abs() <= 4.0 * f64::EPSILON * (domain.1 - domain.0) {
            return Some(next);
        }
        t = next;
    }
    Some(t)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spline::KnotVector;

    /// A wall-sided wedge: y = (1 - u) z with x = 10 u, z = 2 v.
    fn wedge() -> Hull {
        let line = || KnotVector::uniform(1, 1).unwrap();
        let points = vec![[0.0, 0.0, 0.0], [0.0, 2.0, 2.0], [10.0, 0.0, 0.0], [10.0, 0.0, 2.0]];
        let deck = BsplineCurve::new(line(), vec![[0.0, 2.0], [10.0, 2.0]]).unwrap();
        let particulars =
            PrincipalParticulars { length_between_perpendiculars: 10.0, breadth: 4.0, draught: 1.0, depth: 2.0 };
        Hull::new("wedge", particulars, BsplineSurface::new(line(), line(), points).unwrap(), deck).unwrap()
    }

    #[test]
    fn half_breadths_of_a_wedge() {
        let hull = wedge();
        assert!((hull.half_breadth(5.0, 1.0).unwrap() - 0.5).abs() < 1e-14);
        assert!(hull.half_breadth(10.5, 1.0).is_none());
        assert!(hull.half_breadth(5.0, 2.1).is_none());
        assert!((hull.deck_height(3.0) - 2.0).abs() < 1e-14);
        assert_eq!(hull.endings(1.0), Some([0.0, 10.0]));
    }

    #[test]
    fn heights_must_rise() {
        let line = || KnotVector::uniform(1, 1).unwrap();
        let points = vec![[0.0, 0.0, 1.0], [0.0, 2.0, 0.0], [10.0, 0.0, 1.0], [10.0, 0.0, 0.0]];
        let deck = BsplineCurve::new(line(), vec![[0.0, 1.0], [10.0, 1.0]]).unwrap();
        let surface = BsplineSurface::new(line(), line(), points).unwrap();
        let error = Hull::new("x", *wedge().particulars(), surface, deck).unwrap_err();
        assert!(matches!(error, HullError::Heights { .. }), "{error}");
    }

    #[test]
    fn half_breadths_belong_to_the_breadth() {
        let line = || KnotVector::uniform(1, 1).unwrap();
        let points = vec![[0.0, 0.0, 0.0], [0.0, 2.0, 2.0], [10.0, 0.0, 0.0], [10.0, 4.3e9, 2.0]];
        let deck = BsplineCurve::new(line(), vec![[0.0, 2.0], [10.0, 2.0]]).unwrap();
        let surface = BsplineSurface::new(line(), line(), points).unwrap();
        let error = Hull::new("x", *wedge().particulars(), surface, deck).unwrap_err();
        assert!(matches!(error, HullError::Breadths { row: 1, column: 1, .. }), "{error}");
    }
}
