//! Curvature of plane sections of a surface, from the surface.
//!
//! The section of S(u, v) by the plane n . S = d is the curve along which f(u, v) = n . S - d vanishes. Moving with
//! u' = -f_v, v' = f_u keeps f = 0; differentiating S(u(t), v(t)) along that motion gives the first three derivatives P',
//! P'', P''' of the section in space, and with them (do Carmo 1976, 1-5)
//!
//! ```text
//! kappa = n . (P' x P'') / |P'|^3
//! d(kappa)/ds = n . (P' x P''') / |P'|^4 - 3 kappa (P' . P'') / |P'|^3
//! ```
//!
//! They are exact to rounding: the traced curve, which is within a tolerance of surface and plane, only says where.
//! With u forward and v upward S_v x S_u points outward, and kappa is positive where the section is convex outward, in
//! whichever direction it is followed. On a line of the net (a waterline where z = z(v), a station where x = x(u)) the
//! motion is along that parameter at unit speed. Curvature is not defined where the motion stands still: where the
//! surface touches the plane, and where its net is drawn together into a point; a speed below 1e-6 of its size
//! elsewhere counts as none.

use super::profile::{Local, Profile};
use crate::hull::Branch;
use crate::spline::{BsplineCurve, BsplineSurface, KnotVector, cross, dot, length, minus};

type Point = [f64; 3];

/// Steps of the search for the parameters of a point.
const STEPS: usize = 60;
/// Least speed along the section, in speeds of a regular surface.
const SLOWEST: f64 = 1e-6;
/// How far beyond the last two points of a curve the next is expected, in their distance.
const FARTHEST: f64 = 2.0;
/// A step over the length of the domain after which the next would be rounding: each squares the error.
const SETTLED: f64 = 1e-8;
/// Points to a span among which that search may start.
const STARTS: usize = 3;

/// Places of the search along a line u = constant, with the box about them.
#[derive(Debug)]
struct Starts {
    places: Vec<([f64; 2], Point)>,
    low: Point,
    high: Point,
}

impl Starts {
    fn new(places: Vec<([f64; 2], Point)>) -> Self {
        let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
        for (_, point) in &places {
            low = std::array::from_fn(|d| low[d].min(point[d]));
            high = std::array::from_fn(|d| high[d].max(point[d]));
        }
        Self { places, low, high }
    }

    /// The square of the distance of a point from the box.
    fn apart(&self, point: Point) -> f64 {
        (0..3).map(|d| (self.low[d] - point[d]).max(point[d] - self.high[d]).max(0.0).powi(2)).sum()
    }
}

/// The last two points of a curve that were found.
#[derive(Debug, Clone, Copy, Default)]
struct Course {
    last: Option<(f64, [f64; 2])>,
    before: Option<(f64, [f64; 2])>,
}

impl Course {
    /// Parameters of the surface that are to be expected at `t` of the curve: on the straight line through the last two.
    fn expected(&self, t: f64) -> Option<[f64; 2]> {
        let (a, at) = self.last?;
        let Some((b, from)) = self.before.filter(|(b, _)| (a - b).abs() > f64::EPSILON) else { return Some(at) };
        let share = ((t - a) / (a - b)).clamp(-FARTHEST, FARTHEST);
        Some([0, 1].map(|k| at[k] + share * (at[k] - from[k])))
    }

    fn passed(&mut self, t: f64, at: [f64; 2]) {
        (self.before, self.last) = (self.last, Some((t, at)));
    }
}

/// Finds the parameters of points of a surface.
#[derive(Debug)]
pub(super) struct Locator<'a> {
    surface: &'a BsplineSurface<3>,
    starts: Vec<Starts>,
    /// Size of the surface over the lengths of its domains: what |S_u| and |S_v| come to \[m\].
    speeds: [f64; 2],
}

/// Knots without repetition.
pub(super) fn breaks(knots: &KnotVector) -> Vec<f64> {
    let (from, to) = knots.domain();
    let mut breaks = vec![from];
    for &t in knots.knots() {
        if t > breaks[breaks.len() - 1] && t <= to {
            breaks.push(t);
        }
    }
    breaks
}

impl<'a> Locator<'a> {
    pub(super) fn new(surface: &'a BsplineSurface<3>) -> Self {
        let places = |knots: &KnotVector| -> Vec<f64> {
            let breaks = breaks(knots);
            let spans = breaks.windows(2);
            spans
                .flat_map(|s| {
                    let (from, step) = (s[0], (s[1] - s[0]) / STARTS as f64);
                    (0..STARTS).map(move |k| from + (k as f64 + 0.5) * step)
                })
                .collect()
        };
        let (us, vs) = (places(surface.u()), places(surface.v()));
        let line = |&u: &f64| Starts::new(vs.iter().map(|&v| ([u, v], surface.eval(u, v))).collect());
        let starts = us.iter().map(line).collect();
        let extents: Point = std::array::from_fn(|d| {
            let range = surface
                .points()
                .iter()
                .map(|p| p[d])
                .fold([f64::INFINITY, f64::NEG_INFINITY], |r, c| [r[0].min(c), r[1].max(c)]);
            range[1] - range[0]
        });
        let (du, dv) = (surface.u().domain(), surface.v().domain());
        // u runs along the ship, v around its girth.
        let speeds = [extents[0] / (du.1 - du.0), extents[1].hypot(extents[2]) / (dv.1 - dv.0)];
        Self { surface, starts, speeds }
    }

    /// The parameters of the point of the surface next to `point`, from the nearest start and from `near`.
    fn locate(&self, point: Point, near: Option<[f64; 2]>, tolerance: f64) -> Option<[f64; 2]> {
        if let Some(found) = near.and_then(|near| self.descend(point, near)).filter(|f| f.1 <= tolerance) {
            return Some(found.0);
        }
        let square = |p: Point| dot(minus(p, point), minus(p, point));
        let mut least: Option<([f64; 2], f64)> = None;
        for line in &self.starts {
            if least.is_some_and(|(_, least)| line.apart(point) > least) {
                continue;
            }
            for &(place, at) in &line.places {
                let apart = square(at);
                if least.is_none_or(|(_, least)| apart < least) {
                    least = Some((place, apart));
                }
            }
        }
        self.descend(point, least?.0).filter(|found| found.1 <= tolerance).map(|found| found.0)
    }

    /// Levenberg and Marquardt's steps towards the least |S - point|; parameters and the distance there.
    fn descend(&self, point: Point, start: [f64; 2]) -> Option<([f64; 2], f64)> {
        let (du, dv) = (self.surface.u().domain(), self.surface.v().domain());
        let inside = |w: [f64; 2]| [w[0].clamp(du.0, du.1), w[1].clamp(dv.0, dv.1)];
        let mut at = inside(start);
        let mut damping = 1e-12;
        let mut tangents = self.surface.tangents(at[0], at[1]);
        let mut gap = minus(point, tangents.point);
        for _ in 0..STEPS {
            let (a, b) = (tangents.du, tangents.dv);
            let (aa, ab, bb) = (dot(a, a), dot(a, b), dot(b, b));
            let (ga, gb) = (dot(a, gap), dot(b, gap));
            let (saa, sbb) = (aa * (1.0 + damping), bb * (1.0 + damping) + f64::MIN_POSITIVE);
            let determinant = saa * sbb - ab * ab;
            if determinant.is_nan() || determinant <= 0.0 {
                return None;
            }
            let step = [(ga * sbb - gb * ab) / determinant, (gb * saa - ga * ab) / determinant];
            let next = inside([at[0] + step[0], at[1] + step[1]]);
            let moved = self.surface.tangents(next[0], next[1]);
            let remaining = minus(point, moved.point);
            // Where the step is held back it says nothing of the distance.
            let settled = if damping <= 1e-6 { SETTLED } else { 4.0 * f64::EPSILON };
            let still = (next[0] - at[0]).abs() <= settled * (du.1 - du.0)
                && (next[1] - at[1]).abs() <= settled * (dv.1 - dv.0);
            if dot(remaining, remaining) <= dot(gap, gap) {
                (at, tangents, gap) = (next, moved, remaining);
                damping = (0.1 * damping).max(1e-14);
            } else {
                damping = (100.0 * damping).max(1e-6);
            }
            if still || damping > 1e12 {
                break;
            }
        }
        Some((at, length(gap)))
    }

    /// Motion along the section, kappa and d(kappa)/ds of the section through (u, v) by the plane with unit normal `n`.
    fn curvature(&self, [u, v]: [f64; 2], n: Point) -> Option<(Point, f64, f64)> {
        let s = self.surface.derivatives::<4>(u, v);
        let g = |i: usize, j: usize| dot(n, s[i][j]);
        let [along, up] = self.speeds;
        let (gu, gv) = (g(1, 0), g(0, 1));
        // Motion in the parameters with its first two derivatives, and the speed of that motion on a regular surface.
        let ([a, b], [a1, b1], [a2, b2], regular) = if gu.abs() <= 1e-14 * along {
            ([-(1f64.copysign(if gv.abs() > 0.0 { gv } else { n[2] })), 0.0], [0.0; 2], [0.0; 2], along)
        } else if gv.abs() <= 1e-14 * up {
            ([0.0, 1f64.copysign(gu)], [0.0; 2], [0.0; 2], up)
        } else {
            let (a, b) = (-gv, gu);
            let [a1, b1] = motion_rates(&s, n, [a, b]);
            let a2 = (g(2, 1) * a + g(1, 2) * b) * a + g(1, 1) * a1 + (g(1, 2) * a + g(0, 3) * b) * b + g(0, 2) * b1;
            let b2 = (g(3, 0) * a + g(2, 1) * b) * a + g(2, 0) * a1 + (g(2, 1) * a + g(1, 2) * b) * b + g(1, 1) * b1;
            ([a, b], [a1, b1], [-a2, b2], along * up)
        };
        let [first, second] = swept(&s, [a, b], [a1, b1]);
        let third: Point = std::array::from_fn(|d| {
            let cubes =
                s[3][0][d] * a.powi(3) + s[0][3][d] * b.powi(3) + 3.0 * a * b * (s[2][1][d] * a + s[1][2][d] * b);
            let squares = 3.0 * (s[2][0][d] * a * a1 + s[1][1][d] * (a1 * b + a * b1) + s[0][2][d] * b * b1);
            cubes + squares + s[1][0][d] * a2 + s[0][1][d] * b2
        });
        let (kappa, slope) = bending(n, [first, second, third], SLOWEST * regular)?;
        Some((first, kappa, slope))
    }

    /// Speed along a line of a regular net, the lesser one \[m\].
    fn slowest(&self) -> f64 {
        self.speeds[0].min(self.speeds[1])
    }

    /// 1 where a line of the net runs as the motion along the section does, -1 where it runs against it; none where the
    /// motion stands still everywhere.
    fn sense(&self, line: &BsplineCurve<3>, pieces: &[[f64; 2]], n: Point, tolerance: f64) -> Option<f64> {
        pieces.iter().find_map(|[from, to]| {
            let [point, velocity] = line.derivatives::<2>(0.5 * (from + to));
            let (direction, _, _) = self.curvature(self.locate(point, None, tolerance)?, n)?;
            Some(1f64.copysign(dot(direction, velocity)))
        })
    }
}

/// Derivatives of the motion [a, b] = [-g_v, g_u] along a section of a surface with the derivatives s\[i\]\[j\] in u
/// and v, g = n . S.
fn motion_rates<const N: usize>(s: &[[Point; N]; N], n: Point, [a, b]: [f64; 2]) -> [f64; 2] {
    let g = |i: usize, j: usize| dot(n, s[i][j]);
    [-(g(1, 1) * a + g(0, 2) * b), g(2, 0) * a + g(1, 1) * b]
}

/// P' and P'' of the motion [a, b] with the derivatives [a1, b1].
fn swept<const N: usize>(s: &[[Point; N]; N], [a, b]: [f64; 2], [a1, b1]: [f64; 2]) -> [Point; 2] {
    let first = std::array::from_fn(|d| s[1][0][d] * a + s[0][1][d] * b);
    let second = std::array::from_fn(|d| {
        let squares = s[2][0][d] * a * a + 2.0 * s[1][1][d] * a * b + s[0][2][d] * b * b;
        squares + s[1][0][d] * a1 + s[0][1][d] * b1
    });
    [first, second]
}

/// kappa and d(kappa)/ds of a motion with these derivatives in the plane with unit normal `n`; none where it stands
/// still.
fn bending(n: Point, [first, second, third]: [Point; 3], least: f64) -> Option<(f64, f64)> {
    let speed = length(first);
    if speed.is_nan() || speed <= least {
        return None;
    }
    let kappa = dot(n, cross(first, second)) / speed.powi(3);
    let slope = dot(n, cross(first, third)) / speed.powi(4) - 3.0 * kappa * dot(first, second) / speed.powi(3);
    (kappa.is_finite() && slope.is_finite()).then_some((kappa, slope))
}

/// Points of a piece at which the half-breadth is looked at.
const LOOKS: usize = 8;

/// Where a section has breadth.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Breadth {
    /// Half-breadths below this are none \[m\].
    pub(super) least: f64,
    /// A stretch without breadth at an end is left out when it is longer than this \[m\]: every fine end has a short one.
    pub(super) longest: f64,
}

impl Breadth {
    /// The first parameter of `pieces` at which the curve has breadth, and the length up to it; none without such a
    /// place.
    fn begins(self, pieces: &[[f64; 2]], point: &impl Fn(f64) -> Point) -> Option<(f64, f64)> {
        let mut along = 0.0;
        let mut before: Option<(f64, Point)> = None;
        for &[from, to] in pieces {
            for k in 0..=LOOKS {
                let t = from + (to - from) * k as f64 / LOOKS as f64;
                let here = point(t);
                if here[1].abs() >= self.least {
                    let Some((start, _)) = before else { return Some((t, 0.0)) };
                    let (mut low, mut high) = (start, t);
                    for _ in 0..50 {
                        let middle = 0.5 * (low + high);
                        if point(middle)[1].abs() >= self.least { high = middle } else { low = middle }
                    }
                    return Some((high, along));
                }
                if let Some((_, last)) = before {
                    let step = minus(here, last);
                    along += length(step);
                }
                before = Some((t, here));
            }
        }
        None
    }

    /// The pieces of a curve without its ends that have no breadth, and the length left out; no piece where there is no
    /// breadth at all. A closed curve has no ends.
    pub(super) fn clip(
        self,
        mut pieces: Vec<[f64; 2]>,
        closed: bool,
        point: impl Fn(f64) -> Point,
    ) -> (Vec<[f64; 2]>, f64) {
        let reversed: Vec<[f64; 2]> = pieces.iter().rev().map(|&[from, to]| [to, from]).collect();
        let ends = (self.begins(&pieces, &point), self.begins(&reversed, &point));
        let (Some((first, ahead)), Some((last, behind))) = ends else { return (Vec::new(), 0.0) };
        let mut left_out = 0.0;
        if !closed && ahead > self.longest {
            pieces.retain(|piece| piece[1] > first);
            if let Some(piece) = pieces.first_mut() {
                piece[0] = piece[0].max(first);
            }
            left_out += ahead;
        }
        if !closed && behind > self.longest {
            pieces.retain(|piece| piece[0] < last);
            if let Some(piece) = pieces.last_mut() {
                piece[1] = piece[1].min(last);
            }
            left_out += behind;
        }
        (pieces, left_out)
    }
}

/// A section curve with its plane: points in space are `origin` + x `axes[0]` + y `axes[1]`.
#[derive(Debug)]
pub(super) struct Trace {
    pub(super) profile: Profile,
    /// Length of the ends that have no breadth \[m\].
    pub(super) left_out: f64,
    origin: Point,
    pub(super) axes: [Point; 2],
}

impl Trace {
    /// The branch of the section by the plane with unit normal `n`, which it keeps to within `tolerance` \[m\]; a line
    /// of the net is the section itself. None for a branch that has no curvature, or no `breadth`, anywhere.
    pub(super) fn new(
        locator: &Locator,
        branch: &Branch,
        n: Point,
        tolerance: f64,
        breadth: Option<Breadth>,
        on_net: bool,
    ) -> Option<Self> {
        // The axis forward, or outboard where the plane is across the ship.
        let along: Point = if n[0].abs() < 0.9 { [1.0, 0.0, 0.0] } else { [0.0, 1.0, 0.0] };
        let out = minus(along, n.map(|c| c * dot(n, along)));
        let length = length(out);
        let first = out.map(|c| c / length);
        let axes = [first, cross(n, first)];
        let origin = branch.curve.points()[0];
        let flat = |p: Point| -> [f64; 2] { axes.map(|axis| dot(p, axis)) };
        let knots = breaks(branch.curve.knots());
        let pieces: Vec<[f64; 2]> = knots.windows(2).map(|pair| [pair[0], pair[1]]).collect();
        let (pieces, left_out) = match breadth {
            Some(breadth) => breadth.clip(pieces, branch.closed, |t| branch.curve.derivatives::<1>(t)[0]),
            None => (pieces, 0.0),
        };
        let along_net = on_net.then(|| locator.sense(&branch.curve, &pieces, n, tolerance));
        let mut course = Course::default();
        let profile = Profile::sample(&pieces, branch.closed, |t| {
            if let Some(sense) = along_net {
                let [point, first, second, third] = branch.curve.derivatives::<4>(t);
                let (kappa, slope) = bending(n, [first, second, third], SLOWEST * locator.slowest())?;
                let point = flat(minus(point, origin));
                return Some(Local { point, velocity: flat(first), curvature: sense? * kappa, slope: sense? * slope });
            }
            let [point, velocity] = branch.curve.derivatives::<2>(t);
            let at = locator.locate(point, course.expected(t), tolerance)?;
            course.passed(t, at);
            let (direction, kappa, slope) = locator.curvature(at, n)?;
            let turned = if dot(direction, velocity) < 0.0 { -1.0 } else { 1.0 };
            let point = flat(minus(point, origin));
            Some(Local { point, velocity: flat(velocity), curvature: kappa, slope: turned * slope })
        })?;
        Some(Self { profile, left_out, origin, axes })
    }

    /// The point of the plane in space.
    pub(super) fn space(&self, point: [f64; 2]) -> Point {
        std::array::from_fn(|d| self.origin[d] + point[0] * self.axes[0][d] + point[1] * self.axes[1][d])
    }

    /// A coordinate of space as axis and offset in the plane: coordinate = axis . point + offset.
    pub(super) fn coordinate(&self, d: usize) -> ([f64; 2], f64) {
        ([self.axes[0][d], self.axes[1][d]], self.origin[d])
    }
}
