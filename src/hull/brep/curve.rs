//! Curves of edges and of the profiles of surfaces.

use super::super::triangles::corners;
use super::nearest::{Nearest, nearest};
use super::{Motion, apart};
use crate::spline::{BsplineCurve, KnotVector, cross, dot, length, minus};
use std::f64::consts::{FRAC_PI_4, TAU};

/// Points nearer to an end of a curve than this part of its size are that end.
const AT_END: f64 = 1e-6;

/// Ends of a spline nearer to each other than this part of its size close it.
const CLOSED: f64 = 1e-6;

/// The kinds of conics, by what stands before their axes x and y.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Conic {
    /// cos t, sin t: circles too.
    Ellipse,
    /// t^2, t.
    Parabola,
    /// cosh t, sinh t.
    Hyperbola,
}

/// A curve in space with its parameter t.
#[derive(Debug, Clone)]
pub enum SpaceCurve {
    /// origin + t along.
    Line {
        /// Where t is 0.
        origin: [f64; 3],
        /// The derivative.
        along: [f64; 3],
    },
    /// centre + a(t) x + b(t) y, a and b by the kind.
    Conic {
        /// The kind.
        kind: Conic,
        /// The middle; of a parabola its apex.
        centre: [f64; 3],
        /// The first axis with its length.
        x: [f64; 3],
        /// The second axis with its length.
        y: [f64; 3],
    },
    /// A rational spline of points (w x, w y, w z, w).
    Spline(BsplineCurve<4>),
}

/// Whether a spline ends where it begins.
fn is_closed(curve: &BsplineCurve<4>) -> bool {
    let (a, b) = curve.knots().domain();
    let size = curve.points().iter().map(|&p| length(minus(over(p), over(curve.points()[0])))).fold(0.0, f64::max);
    length(minus(over(curve.eval(a)), over(curve.eval(b)))) <= CLOSED * size
}

/// Breakpoints of knots between two parameters, and whether the spline may have a corner at each; those of a closed spline
/// come again with every turn.
pub(super) fn knots_between(knots: &KnotVector, is_closed: bool, [from, to]: [f64; 2]) -> Vec<(f64, bool)> {
    let (a, b) = knots.domain();
    let slack = 1e-9 * (b - a);
    let turns = if is_closed { -2..=2 } else { 0..=0 };
    let breaks = corners(knots);
    let all = turns.flat_map(|turn| breaks.iter().map(move |&(t, corner)| (t + f64::from(turn) * (b - a), corner)));
    let mut inner: Vec<(f64, bool)> = all.filter(|(t, _)| *t > from + slack && *t < to - slack).collect();
    inner.dedup_by(|a, b| (a.0 - b.0).abs() <= slack);
    inner
}

/// The point of homogeneous coordinates.
pub(super) fn over([x, y, z, w]: [f64; 4]) -> [f64; 3] {
    [x / w, y / w, z / w]
}

/// The derivative of a quotient: (N' - C w')/w.
pub(super) fn slope_over(point: [f64; 3], [x, y, z, w]: [f64; 4], weight: f64) -> [f64; 3] {
    [(x - point[0] * w) / weight, (y - point[1] * w) / weight, (z - point[2] * w) / weight]
}

impl SpaceCurve {
    /// A line through two points; 0 and 1 are its ends.
    #[must_use]
    pub fn between(from: [f64; 3], to: [f64; 3]) -> Self {
        Self::Line { origin: from, along: minus(to, from) }
    }

    /// A line past a point at a distance from an origin.
    #[must_use]
    pub fn beside(origin: [f64; 3], x: [f64; 3], distance: f64, along: [f64; 3]) -> Self {
        Self::Line { origin: apart(origin, distance, x), along }
    }

    /// A circle from the unit vector x towards y.
    #[must_use]
    pub fn circle(centre: [f64; 3], x: [f64; 3], y: [f64; 3], radius: f64) -> Self {
        Self::Conic { kind: Conic::Ellipse, centre, x: x.map(|c| radius * c), y: y.map(|c| radius * c) }
    }

    /// Straight lines through points, which count the parameter; none of fewer than two points.
    #[must_use]
    pub fn polyline(points: &[[f64; 3]]) -> Option<Self> {
        let breaks: Vec<f64> = (0..points.len()).map(|k| k as f64).collect();
        let knots = KnotVector::from_breakpoints(1, &breaks, &vec![1; points.len().saturating_sub(2)]).ok()?;
        let net = points.iter().map(|&[x, y, z]| [x, y, z, 1.0]).collect();
        BsplineCurve::new(knots, net).ok().map(Self::Spline)
    }

    /// The same curve run through backwards.
    #[must_use]
    pub fn reversed(&self) -> Self {
        match self {
            Self::Line { origin, along } => Self::Line { origin: *origin, along: along.map(|c| -c) },
            Self::Conic { kind, centre, x, y } => Self::Conic { kind: *kind, centre: *centre, x: *x, y: y.map(|c| -c) },
            Self::Spline(curve) => Self::Spline(curve.reversed()),
        }
    }

    /// The parameters of two points of the curve, the second the larger one: once around where they are one point, and
    /// at the ends of the curve where they lie there.
    pub(super) fn between_points(&self, from: [f64; 3], to: [f64; 3]) -> [f64; 2] {
        let at_end = |end: Option<f64>, point: [f64; 3]| {
            let found = self.nearest(point);
            let near = |t: &f64| length(minus(self.point(*t), point)) <= 2.0 * found.distance + AT_END * self.extent();
            end.filter(near).unwrap_or(found.parameter)
        };
        let domain = self.domain();
        let a = at_end(domain.map(|[a, _]| a), from);
        let b = at_end(domain.map(|[_, b]| b), to);
        match self.period() {
            Some(period) if b <= a + 1e-9 * period => [a, b + period],
            Some(period) if b > a + (1.0 + 1e-9) * period => [a, b - period],
            _ => [a, b],
        }
    }

    /// Its size; of a line that of its vector.
    fn extent(&self) -> f64 {
        match self {
            Self::Line { along, .. } => length(*along),
            Self::Conic { x, y, .. } => length(*x) + length(*y),
            Self::Spline(curve) => {
                let first = over(curve.points()[0]);
                curve.points().iter().map(|&p| length(minus(over(p), first))).fold(0.0, f64::max)
            }
        }
    }

    /// Length of t after which the curve repeats itself.
    #[must_use]
    pub fn period(&self) -> Option<f64> {
        match self {
            Self::Conic { kind: Conic::Ellipse, .. } => Some(TAU),
            Self::Spline(curve) if is_closed(curve) => {
                let (a, b) = curve.knots().domain();
                Some(b - a)
            }
            _ => None,
        }
    }

    /// Where it begins and ends; none of lines and conics.
    pub(super) fn domain(&self) -> Option<[f64; 2]> {
        match self {
            Self::Spline(curve) => Some(curve.knots().domain().into()),
            _ => None,
        }
    }

    /// The point and the derivative at t; a closed spline is run through again beyond its ends.
    #[must_use]
    pub fn at(&self, t: f64) -> [[f64; 3]; 2] {
        match self {
            Self::Line { origin, along } => [apart(*origin, t, *along), *along],
            Self::Conic { kind, centre, x, y } => {
                let (a, b, da, db) = match kind {
                    Conic::Ellipse => (t.cos(), t.sin(), -t.sin(), t.cos()),
                    Conic::Parabola => (t * t, t, 2.0 * t, 1.0),
                    Conic::Hyperbola => (t.cosh(), t.sinh(), t.sinh(), t.cosh()),
                };
                let along = [0, 1, 2].map(|k| da * x[k] + db * y[k]);
                [[0, 1, 2].map(|k| centre[k] + a * x[k] + b * y[k]), along]
            }
            Self::Spline(curve) => {
                let (a, b) = curve.knots().domain();
                let inside = a..=b;
                let t = if inside.contains(&t) || !is_closed(curve) { t } else { a + (t - a).rem_euclid(b - a) };
                let [point, along] = curve.derivatives::<2>(t);
                let place = over(point);
                [place, slope_over(place, along, point[3])]
            }
        }
    }

    /// The point at t.
    #[must_use]
    pub fn point(&self, t: f64) -> [f64; 3] {
        self.at(t)[0]
    }

    /// Parameters between which the curve is smooth and turns little, `from` and `to` among them.
    pub(super) fn breaks(&self, from: f64, to: f64) -> Vec<f64> {
        let (low, high) = (from.min(to), from.max(to));
        let inner: Vec<f64> = match self {
            Self::Line { .. } => Vec::new(),
            Self::Conic { .. } => {
                let count = ((high - low) / FRAC_PI_4).ceil().clamp(1.0, 64.0);
                (1..count as usize).map(|k| low + (high - low) * k as f64 / count).collect()
            }
            Self::Spline(curve) => {
                knots_between(curve.knots(), is_closed(curve), [low, high]).into_iter().map(|(t, _)| t).collect()
            }
        };
        let mut all: Vec<f64> = std::iter::once(low).chain(inner).chain([high]).collect();
        if from > to {
            all.reverse();
        }
        all
    }

    /// The parameter of the point of the curve that is nearest to `point`, and its distance.
    #[must_use]
    pub fn nearest(&self, point: [f64; 3]) -> Nearest {
        if let Self::Line { origin, along } = self {
            let parameter = dot(minus(point, *origin), *along) / dot(*along, *along);
            return Nearest { parameter, distance: length(minus(self.point(parameter), point)) };
        }
        let [from, to] = self.search_range(point);
        nearest(|t| self.at(t), &self.breaks(from, to), self.period().is_some(), point)
    }

    /// Parameters between which points near to `point` are looked for.
    pub(super) fn search_range(&self, point: [f64; 3]) -> [f64; 2] {
        match self {
            Self::Conic { kind, centre, y, .. } => {
                let reach = |axis: [f64; 3]| dot(minus(point, *centre), axis).abs() / dot(axis, axis);
                match kind {
                    Conic::Ellipse => [0.0, TAU],
                    Conic::Parabola => [-1.0 - reach(*y), 1.0 + reach(*y)],
                    Conic::Hyperbola => [-1.0 - reach(*y).asinh(), 1.0 + reach(*y).asinh()],
                }
            }
            _ => self.domain().unwrap_or([0.0, 1.0]),
        }
    }

    /// The curve after a motion.
    #[must_use]
    pub fn moved(&self, motion: &Motion) -> Self {
        match self {
            Self::Line { origin, along } => Self::Line { origin: motion.point(*origin), along: motion.along(*along) },
            Self::Conic { kind, centre, x, y } => {
                let [x, y] = [*x, *y].map(|axis| motion.along(axis));
                Self::Conic { kind: *kind, centre: motion.point(*centre), x, y }
            }
            Self::Spline(curve) => {
                let points = curve.points().iter().map(|&p| motion.weighted(p)).collect();
                Self::Spline(BsplineCurve::new(curve.knots().clone(), points).unwrap_or_else(|_| curve.clone()))
            }
        }
    }

    /// Least cross product that tells a curve from a line: whether it stays on one line between two parameters.
    #[must_use]
    pub fn is_straight(&self, from: f64, to: f64) -> bool {
        let [a, b] = [from, to].map(|t| self.point(t));
        let along = minus(b, a);
        let size = dot(along, along);
        self.breaks(from, to).windows(2).all(|w| {
            let middle = minus(self.point(0.5 * (w[0] + w[1])), a);
            length(cross(along, middle)) <= 1e-9 * size
        })
    }
}
