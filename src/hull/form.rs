//! The hull: a half-breadth surface over the centreplane.
//!
//! S(u, v) = (x(u, v), y(u, v), z(u, v)), a tensor-product B-spline with one knot vector in u (aft to forward) and one
//! in v (bottom to top). x and z are fixed functions of the parameters, the chart of the profile; y is the shape. The
//! chart does not fold: x rises with u, z with v, and J = x_u z_v - x_v z_u is positive inside, so that (x, z)
//! determines (u, v). Two pure charts, and anything between:
//! * level, z = z(v): the lines v = constant are waterlines. Stern and stem may rake and bulge;
//! * upright, x = x(u): the lines u = constant are stations. Keel, chines and sheer may be lines v = constant.
//!
//! The body is {(x, y, z): |y| <= y(x, z)} over the domain of the surface, so that what closes it is implied and plane or
//! ruled:
//! * the bottom, across the keel line v = v_min where y > 0 there: the flat of bottom of a level hull, else a ruled
//!   strip that follows the height of the keel line;
//! * the transom, over the stern profile u = u_min, and a flat bow over the stem profile u = u_max, where y > 0 there;
//! * the deck, at the height of the deck at side; the surface reaches up to the highest point of the deck and the body
//!   ends at the deck. Where the upper edge v = v_max is lower than the deck, or is the deck, the body ends there.

use super::chart;
use super::particulars::PrincipalParticulars;
use crate::spline::{BsplineCurve, BsplineSurface, KnotVector, MAX_DEGREE, SplineError};

/// Coordinates of the net that differ by less than this part of the largest one differ by rounding: a net that falls by
/// less does not fall, and stations on which x differs by less are upright.
const ROUNDING: f64 = 1e-12;

/// What is closer to the waterline than this part of the height of the hull lies on it.
pub(crate) const AFLOAT: f64 = 1e-7;

/// Lengths that differ by less than this part are one.
const SAME_LENGTH: f64 = 1e-6;

/// Part of L_PP that the aft end of a length that was not stated may stand from AP.
const FROM_PERPENDICULAR: f64 = 0.01;

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
    /// The design draught is above the depth.
    #[error(
        "the design draught of {draught:.3} m lies above the depth of {depth:.3} m: state one within it (--draught, T under \
         [dimensions]), or the depth that the ship has"
    )]
    Draught {
        /// T \[m\].
        draught: f64,
        /// D \[m\].
        depth: f64,
    },
    /// Nothing of the hull is below the design draught.
    #[error(
        "the design draught of {draught:?} m is not above the lowest point of the hull, {bottom:.3} m, and nothing floats: state one \
         above it (--draught, T under [dimensions])"
    )]
    Aground {
        /// T \[m\].
        draught: f64,
        /// The lowest point \[m\].
        bottom: f64,
    },
    /// The heights of the net do not rise from bottom to top.
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
    /// The chart of the profile folds: J = x_u z_v - x_v z_u is negative.
    #[error(
        "the lines of the net cross in the profile near x = {x} m, z = {z} m (u = {u}, v = {v}): x_u z_v - x_v z_u is \
         {jacobian} there, and must not be negative; move the keel or the ends apart from the lines above them"
    )]
    Folded {
        /// Parameter along the ship.
        u: f64,
        /// Parameter across.
        v: f64,
        /// Position of the point \[m\].
        x: f64,
        /// Its height \[m\].
        z: f64,
        /// J [m^2].
        jacobian: f64,
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
    /// A point of the net that has nothing to do with the dimensions.
    #[error("x or z of the net, row {row}, column {column}: {x} m, {z} m; they must be within {reach} m of the origin")]
    Places {
        /// Index in u.
        row: usize,
        /// Index in v.
        column: usize,
        /// The length \[m\].
        x: f64,
        /// The height \[m\].
        z: f64,
        /// A hundred times the largest of L_PP, B and D \[m\].
        reach: f64,
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

impl HullError {
    /// Whether the design draught is none of the hull.
    #[must_use]
    pub fn is_of_draught(&self) -> bool {
        matches!(self, Self::Draught { .. } | Self::Aground { .. })
    }
}

/// Most distance of a point of the net from the origin along x and z, in units of the largest of L_PP, B and D.
const REACH: f64 = 100.0;

/// A ship's hull, one side of it, symmetric about the centreplane.
#[derive(Debug, Clone, PartialEq)]
pub struct Hull {
    name: String,
    particulars: PrincipalParticulars,
    surface: BsplineSurface<3>,
    deck: BsplineCurve<2>,
    /// z(v) of a level hull.
    heights: Option<BsplineCurve<1>>,
    upright: bool,
    bottom: f64,
    top: f64,
    /// Whether the deck at side is somewhere below the upper edge of the surface.
    cut_by_deck: bool,
}

impl Hull {
    /// Takes the surface (control points x, y, z in metres) and the deck at side (control points x, z; x rises).
    ///
    /// That the chart does not fold is checked at 25 points of every cell of the knots; a level chart cannot fold.
    ///
    /// # Errors
    /// [`HullError`] when a dimension is not positive, or nothing floats at T, or T lies above D. Of the surface: when a point
    /// is a hundred times the largest dimension from the origin along x or z, or a control half-breadth is outside -B to 10 B.
    /// Of the chart: when z does not rise with v or x with u, or it folds. Of the deck: when it does not rise in x, or leaves
    /// the range of heights of the surface.
    pub fn new(
        name: &str,
        particulars: PrincipalParticulars,
        surface: BsplineSurface<3>,
        deck: BsplineCurve<2>,
    ) -> Result<Self, HullError> {
        let degrees = [surface.u(), surface.v(), deck.knots()].map(KnotVector::degree);
        if let Some(&degree) = degrees.iter().find(|&&degree| degree > MAX_DEGREE) {
            return Err(SplineError::Degree(degree).into());
        }
        let p = particulars;
        let dimensions = [
            ("Lpp", Some(p.length_between_perpendiculars)),
            ("B", Some(p.breadth)),
            ("T", p.draught),
            ("D", Some(p.depth)),
        ];
        for (label, value) in dimensions {
            if let Some(value) = value.filter(|value| !(value.is_finite() && *value > 0.0)) {
                return Err(HullError::Dimension { name: label, value });
            }
        }
        let [rows, columns] = surface.shape();
        let (mut level, mut upright) = (true, true);
        // A line that shrinks to a point has coordinates that are equal to rounding only.
        let largest = |axis: usize| surface.points().iter().map(|point| point[axis].abs()).fold(0.0, f64::max);
        let noise = [ROUNDING * largest(0), ROUNDING * largest(2)];
        let reach = REACH * p.length_between_perpendiculars.max(p.breadth).max(p.depth);
        for row in 0..rows {
            for column in 0..columns {
                let [x, y, z] = surface.point(row, column);
                if !(-reach..=reach).contains(&x) || !(-reach..=reach).contains(&z) {
                    return Err(HullError::Places { row, column, x, z, reach });
                }
                if !(-p.breadth..=10.0 * p.breadth).contains(&y) {
                    return Err(HullError::Breadths { row, column, value: y, breadth: p.breadth });
                }
                level &= z.to_bits() == surface.point(0, column)[2].to_bits();
                upright &= (x - surface.point(row, 0)[0]).abs() <= noise[0];
                if column > 0 && z < surface.point(row, column - 1)[2] - noise[1] {
                    return Err(HullError::Heights { row, column, problem: "z falls from bottom to top" });
                }
                if row > 0 && x < surface.point(row - 1, column)[0] - noise[0] {
                    return Err(HullError::Lengths { row, column });
                }
            }
        }
        let heights = if level {
            let points = (0..columns).map(|column| [surface.point(0, column)[2]]).collect();
            Some(BsplineCurve::new(surface.v().clone(), points)?)
        } else {
            None
        };
        let [bottom, top] = chart::heights(&surface, level);
        if top <= bottom {
            return Err(HullError::Heights { row: 0, column: columns - 1, problem: "the hull has no height" });
        }
        if !level && !upright {
            chart::unfolded(&surface)?;
        }
        let slack = 1e-9 * (top - bottom);
        // Control points of a curved sheer line stand above its highest point.
        let reach = if level { 0.0 } else { top - bottom };
        for (index, point) in deck.points().iter().enumerate() {
            if index > 0 && point[0] <= deck.points()[index - 1][0] {
                return Err(HullError::Deck { index, problem: "x does not rise" });
            }
            if point[1] < bottom - slack || point[1] > top + slack + reach {
                return Err(HullError::Deck { index, problem: "outside the heights of the surface" });
            }
        }
        let mut hull = Self {
            name: name.to_owned(),
            particulars,
            surface,
            deck,
            heights,
            upright,
            bottom,
            top,
            cut_by_deck: true,
        };
        hull.cut_by_deck = level || chart::is_cut_by_deck(&hull);
        p.draught.map_or(Ok(()), |draught| hull.takes_draught(draught))?;
        Ok(hull)
    }

    /// The name.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The same hull by another name.
    #[must_use]
    pub fn with_name(self, name: String) -> Self {
        Self { name, ..self }
    }

    /// The same hull with a design draught \[m\] above the base line.
    ///
    /// # Errors
    /// [`HullError`] when it is not positive, or none of the hull ([`Hull::takes_draught`]).
    pub fn with_draught(self, draught: f64) -> Result<Self, HullError> {
        let particulars = PrincipalParticulars { draught: Some(draught), ..self.particulars };
        Self::new(&self.name, particulars, self.surface, self.deck)
    }

    /// Whether the hull floats at a draught \[m\] above the base line, which may be that of a table which ends at the design
    /// waterline.
    ///
    /// # Errors
    /// [`HullError::Draught`] above D by more than a hundredth; [`HullError::Aground`] where rounding alone is immersed.
    pub fn takes_draught(&self, draught: f64) -> Result<(), HullError> {
        let p = PrincipalParticulars { draught: Some(draught), ..self.particulars };
        if p.draught_exceeds_depth() {
            return Err(HullError::Draught { draught, depth: p.depth });
        }
        if draught <= self.bottom + AFLOAT * (self.top - self.bottom) {
            return Err(HullError::Aground { draught, bottom: self.bottom });
        }
        Ok(())
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

    /// Whether z is a function of v alone, so that the lines v = constant are waterlines.
    #[must_use]
    pub fn is_level(&self) -> bool {
        self.heights.is_some()
    }

    /// Whether x is a function of u alone, so that the lines u = constant are stations.
    #[must_use]
    pub fn is_upright(&self) -> bool {
        self.upright
    }

    /// z(v) of a level hull \[m\].
    #[must_use]
    pub fn heights(&self) -> Option<&BsplineCurve<1>> {
        self.heights.as_ref()
    }

    /// Whether the deck at side may end the body below the upper edge of the surface.
    pub(crate) fn is_cut_by_deck(&self) -> bool {
        self.cut_by_deck
    }

    /// The deck at side in the profile: control points (x, z) \[m\], x rising.
    #[must_use]
    pub fn deck(&self) -> &BsplineCurve<2> {
        &self.deck
    }

    /// Height of the lowest point of the surface \[m\].
    #[must_use]
    pub fn bottom(&self) -> f64 {
        self.bottom
    }

    /// Height of the highest point of the surface \[m\].
    #[must_use]
    pub fn top(&self) -> f64 {
        self.top
    }

    /// The parameter v of the waterline at height `z` of a level hull, to rounding; none outside the heights of the
    /// surface and on hulls that are not level.
    #[must_use]
    pub fn height_parameter(&self, z: f64) -> Option<f64> {
        let heights = self.heights.as_ref()?;
        solve_increasing(z, heights.knots().domain(), (self.bottom, self.top), |v| {
            let [value, slope] = heights.derivatives::<2>(v);
            (value[0], slope[0])
        })
    }

    /// The parameter v at which z(u, v) is `z` on the line `u`, to rounding; none above and below its ends.
    #[must_use]
    pub fn height_parameter_at(&self, u: f64, z: f64) -> Option<f64> {
        if self.is_level() {
            return self.height_parameter(z);
        }
        let domain = self.surface.v().domain();
        let ends = (self.surface.eval(u, domain.0)[2], self.surface.eval(u, domain.1)[2]);
        solve_increasing(z, domain, ends, |v| {
            let at = self.surface.tangents(u, v);
            (at.point[2], at.dv[2])
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

    /// The parameter u at which x(u, v) is `x`, or the nearer end where the line `v` does not reach so far.
    pub(crate) fn nearest_length_parameter(&self, x: f64, v: f64) -> f64 {
        let (a, b) = self.surface.u().domain();
        self.length_parameter(x, v).unwrap_or(if x < self.surface.eval(a, v)[0] { a } else { b })
    }

    /// The half-breadth at (x, z) \[m\]; none where the surface does not reach.
    #[must_use]
    pub fn half_breadth(&self, x: f64, z: f64) -> Option<f64> {
        let [u, v] = self.parameters(x, z)?;
        Some(self.surface.eval(u, v)[1])
    }

    /// The parameters (u, v) of the point (x, z) of the profile, to rounding; none where the surface does not reach.
    #[must_use]
    pub fn parameters(&self, x: f64, z: f64) -> Option<[f64; 2]> {
        let v = if self.is_level() { self.height_parameter(z)? } else { chart::height_parameter_along(self, x, z)? };
        Some([self.length_parameter(x, v)?, v])
    }

    /// Ends of the waterline at height `z`: its aftmost and its foremost x \[m\]; none outside the surface. Where a
    /// hump of the keel or a dip of the sheer parts the waterline, they are the ends of the whole.
    #[must_use]
    pub fn endings(&self, z: f64) -> Option<[f64; 2]> {
        if !self.is_level() {
            return chart::endings(self, z);
        }
        let v = self.height_parameter(z)?;
        let (a, b) = self.surface.u().domain();
        Some([self.surface.eval(a, v)[0], self.surface.eval(b, v)[0]])
    }

    /// Whether midship is L_PP/2 forward of x = 0. It is not where L_PP is the length of the waterline at the design
    /// draught, or of the hull, and that does not begin within a hundredth of L_PP of x = 0: x counts from elsewhere.
    #[must_use]
    pub fn counts_from_aft_perpendicular(&self) -> bool {
        let length = self.particulars.length_between_perpendiculars;
        let along = self.surface.points().iter().map(|point| point[0]);
        let hull = along.fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], x| [a.min(x), b.max(x)]);
        let elsewhere = |[aft, fore]: [f64; 2]| {
            (fore - aft - length).abs() <= SAME_LENGTH * length && aft.abs() > FROM_PERPENDICULAR * length
        };
        let afloat = self.particulars.draught.and_then(|draught| self.endings(draught));
        ![afloat, Some(hull)].into_iter().flatten().any(elsewhere)
    }

    /// The height up to which volume, centres and areas of the hull are taken \[m\]: T, or where no draught is stated the
    /// highest waterline that every station between the ends has. That is the least height of the deck at side on the
    /// breakpoints between its ends, at most the top of the surface.
    #[must_use]
    pub fn reference_height(&self) -> f64 {
        self.particulars.draught.unwrap_or_else(|| {
            let mut places = self.deck.knots().breakpoints();
            if places.len() > 2 {
                places = places[1..places.len() - 1].to_vec();
            }
            let heights = places.into_iter().map(|t| self.deck.eval(t)[1]);
            let least = heights.fold(self.top, f64::min);
            if least > self.bottom { least } else { self.top }
        })
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
pub(super) fn solve_increasing(
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
            PrincipalParticulars { length_between_perpendiculars: 10.0, breadth: 4.0, draught: Some(1.0), depth: 2.0 };
        Hull::new("wedge", particulars, BsplineSurface::new(line(), line(), points).unwrap(), deck).unwrap()
    }

    /// A box of 10 m with a deck of these heights over x, and a draught where it is stated.
    fn decked(draught: Option<f64>, deck: &[[f64; 2]]) -> Hull {
        let particulars =
            PrincipalParticulars { length_between_perpendiculars: 10.0, breadth: 4.0, draught, depth: 2.0 };
        let (u, v) = (KnotVector::uniform(1, 1).unwrap(), KnotVector::uniform(1, 1).unwrap());
        let points = [[0.0, 2.0, 0.0], [0.0, 2.0, 3.0], [10.0, 2.0, 0.0], [10.0, 2.0, 3.0]].to_vec();
        let breaks: Vec<f64> = deck.iter().map(|point| point[0]).collect();
        let knots = KnotVector::from_breakpoints(1, &breaks, &vec![1; breaks.len() - 2]).unwrap();
        let surface = BsplineSurface::new(u, v, points).unwrap();
        Hull::new("box", particulars, surface, BsplineCurve::new(knots, deck.to_vec()).unwrap()).unwrap()
    }

    /// Stations at the ends may be lower than all waterlines: they do not count.
    #[test]
    fn without_a_draught_the_height_is_that_of_the_lowest_station_between_the_ends() {
        let sheer = [[0.0, 1.0], [2.0, 2.5], [5.0, 2.2], [8.0, 2.8], [10.0, 0.5]];
        assert!((decked(None, &sheer).reference_height() - 2.2).abs() < 1e-12);
        assert!((decked(Some(1.5), &sheer).reference_height() - 1.5).abs() < 1e-12);
        assert!((decked(None, &[[0.0, 2.4], [10.0, 2.6]]).reference_height() - 2.4).abs() < 1e-12);
        let stated = decked(None, &sheer).with_draught(1.7).unwrap();
        assert_eq!((stated.particulars().draught, stated.reference_height().to_bits()), (Some(1.7), 1.7f64.to_bits()));
        assert!(matches!(decked(None, &sheer).with_draught(2.5), Err(HullError::Draught { .. })));
        assert!(matches!(decked(None, &sheer).with_draught(0.0), Err(HullError::Dimension { name: "T", .. })));
        // A film of water is rounding.
        assert!(matches!(decked(None, &sheer).with_draught(1e-9), Err(HullError::Aground { .. })));
        assert!(decked(None, &sheer).with_draught(1e-6).is_ok());
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

    #[test]
    fn points_of_the_net_belong_to_the_dimensions() {
        let line = || KnotVector::uniform(1, 1).unwrap();
        let deck = || BsplineCurve::new(line(), vec![[0.0, 2.0], [10.0, 2.0]]).unwrap();
        for far in [1e308, -1e9, f64::NAN] {
            let points = vec![[0.0, 0.0, 0.0], [0.0, 2.0, 2.0], [10.0, 0.0, 0.0], [far, 2.0, 2.0]];
            let Ok(surface) = BsplineSurface::new(line(), line(), points) else { continue };
            let error = Hull::new("x", *wedge().particulars(), surface, deck()).unwrap_err();
            assert!(matches!(error, HullError::Places { row: 1, column: 1, .. }), "{error}");
        }
    }
}
