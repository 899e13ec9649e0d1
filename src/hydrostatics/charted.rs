//! Volume, wetted surface, profile and waterplane below one draught on a hull that is not level.
//!
//! The parameter plane below the draught is integrated u-line by u-line over the pieces of [`Immersion`], with J = x_u
//! z_v - x_v z_u: volume 2 int int y J dv du, profile int int J dv du, side 2 int int |S_u x S_v| dv du, bottom 2 int y
//! (x_u^2 + z_u^2)^(1/2) du on the keel line v = v_min, and on the waterline dx = (J / z_v) du. Volume and moments are
//! exact to rounding where all of the lines u = constant is immersed; else the relative error of volume and waterplane
//! is about 1e-10 and that of areas of surfaces about 1e-8.
//!
//! The volume aft of midship is that aft of a line u_0 near midship and, where x depends on v, 2 int int y J (u_m(v) -
//! u_0) ds dv on the lines u = u_0 + s (u_m(v) - u_0), x(u_m(v), v) being L_PP / 2; its relative error is about 1e-8
//! there.
//!
//! Cells of the knots that lie below the waterline as a whole are integrated once for all draughts; a draught costs the
//! cells that its waterline passes through: O(cells) in all and O(spans_u + spans_v) a draught.

use super::node::{Node, node_at, nodes};
use super::volume::{Body, count_along, count_up};
use super::waterplane::{Waterplane, entrance_angle, largest};
use crate::hull::{Hull, Immersion, Piece, UpperEnd, advance};
use crate::numeric::{bracketed_root, gauss_legendre};
use crate::spline::cross;

/// Nodes in s between the line u_0 and midship.
const BAND_NODES: usize = 6;

/// A waterline whose velocity is below this part of the mean of J has its direction from points beside it.
const STANDSTILL: f64 = 1e-7;

/// What is the same for every draught.
struct Pass<'a, const N: usize> {
    hull: &'a Hull,
    /// Nodes on the whole spans in v, span by span.
    whole: Vec<Node<N>>,
    spans: Vec<usize>,
    count: usize,
    midship: f64,
    /// The line u_0.
    parting: f64,
    /// The spans in u, parted at u_0.
    strips: Vec<Strip>,
    /// u_m(v) at the nodes of the whole spans; empty on upright hulls.
    passage: Vec<f64>,
}

/// Volume, its moments, profile and its moments, side: what adds up over the parameter plane.
type Sums = [f64; 7];

/// A span in u, or a part of it, with the sums over its cells up to each knot line in v; as many cells as any draught
/// may immerse.
struct Strip {
    from: f64,
    to: f64,
    below: Vec<Sums>,
}

/// A point of the surface with its derivatives, each (x, y, z).
#[derive(Debug, Clone, Copy)]
struct SurfacePoint {
    at: [f64; 3],
    along: [f64; 3],
    up: [f64; 3],
}

impl SurfacePoint {
    fn jacobian(&self) -> f64 {
        self.along[0] * self.up[2] - self.up[0] * self.along[2]
    }

    /// |S_u x S_v|
    fn skin(&self) -> f64 {
        let (a, b) = (self.along, self.up);
        let normal = cross(a, b);
        normal.iter().map(|c| c * c).sum::<f64>().sqrt()
    }
}

/// The columns of the net on a line u = constant: S and S_u.
type Columns = Vec<[f64; 6]>;

/// The columns of the net at `u`: the first and those of `range`.
fn collapse(hull: &Hull, span: usize, u: f64, range: std::ops::Range<usize>, columns: &mut Columns) {
    let knots = hull.surface().u();
    let [value, slope] = knots.basis_derivatives::<2>(span, u);
    let count = columns.len();
    let first = range.start.max(1);
    let last = range.end.max(first);
    columns[0] = [0.0; 6];
    columns[first..last].fill([0.0; 6]);
    for (i, row) in (span - knots.degree()..=span).enumerate() {
        let (a, b) = (value[i], slope[i]);
        let points = &hull.surface().points()[row * count..(row + 1) * count];
        let wanted = columns.iter_mut().zip(points);
        for (_, (column, point)) in wanted.enumerate().filter(|(c, _)| *c == 0 || (first..last).contains(c)) {
            for axis in 0..3 {
                column[axis] += a * point[axis];
                column[axis + 3] += b * point[axis];
            }
        }
    }
}

fn point<const N: usize>(node: &Node<N>, columns: &Columns) -> SurfacePoint {
    let (mut value, mut up) = ([0.0; 6], [0.0; 3]);
    for ((column, b), d) in columns[node.first..node.first + N].iter().zip(&node.value).zip(&node.slope) {
        for (sum, c) in value.iter_mut().zip(column) {
            *sum += b * c;
        }
        for (sum, c) in up.iter_mut().zip(column) {
            *sum += d * c;
        }
    }
    let [x, y, z, xu, yu, zu] = value;
    SurfacePoint { at: [x, y, z], along: [xu, yu, zu], up }
}

/// Adds what a point with the weight `weight` adds.
fn take(sums: &mut Sums, p: &SurfacePoint, weight: f64) {
    let (profile, [x, y, z]) = (weight * p.jacobian(), p.at);
    let volume = 2.0 * profile * y;
    let added = [volume, volume * x, volume * z, profile, profile * x, profile * z, 2.0 * weight * p.skin()];
    sums.iter_mut().zip(added).for_each(|(sum, a)| *sum += a);
}

/// Integrals and waterplane below each immersion, volumes being parted at x = `midship`; zero where nothing is immersed.
pub(super) fn bodies<const N: usize>(
    hull: &Hull,
    immersions: &[Option<Immersion>],
    midship: f64,
) -> Vec<(Body, Waterplane)> {
    let highest = immersions.iter().flatten().map(Immersion::draught).fold(f64::NEG_INFINITY, f64::max);
    let pass = Pass::<N>::new(hull, midship, highest);
    immersions.iter().map(|i| i.as_ref().map_or_else(Default::default, |i| pass.below(i))).collect()
}

impl<'a, const N: usize> Pass<'a, N> {
    fn new(hull: &'a Hull, midship: f64, highest: f64) -> Self {
        let surface = hull.surface();
        let (spans, count) = (surface.v().spans(), count_up(hull));
        let mut whole = Vec::with_capacity(spans.len() * count);
        for &span in &spans {
            nodes::<N>(hull, span, f64::INFINITY, count, &mut whole);
        }
        let (low, high) = surface.v().domain();
        let parting = hull.nearest_length_parameter(midship, 0.5 * (low + high));
        let passage = if hull.is_upright() {
            Vec::new()
        } else {
            let knots = surface.v().knots();
            let places = spans.iter().flat_map(|&s| gauss_legendre(count).on(knots[s], knots[s + 1]));
            places.map(|(v, _)| hull.nearest_length_parameter(midship, v)).collect()
        };
        let mut pass = Self { hull, whole, spans, count, midship, parting, strips: Vec::new(), passage };
        let knots = surface.u().knots();
        for span in surface.u().spans() {
            let (from, to) = (knots[span], knots[span + 1]);
            let ends =
                if from < parting && parting < to { vec![[from, parting], [parting, to]] } else { vec![[from, to]] };
            for [from, to] in ends {
                let strip = pass.strip(span, [from, to], highest);
                pass.strips.push(strip);
            }
        }
        pass
    }

    /// Nodes in u that are exact on a strip.
    fn exact(&self) -> usize {
        count_along(self.hull).max(2 * self.hull.surface().u().degree())
    }

    /// The sums over the cells of a strip, as far up as it is below `highest` somewhere.
    fn strip(&self, span: usize, [from, to]: [f64; 2], highest: f64) -> Strip {
        let surface = self.hull.surface();
        let knots = surface.v().knots();
        let low = |v: f64| [from, 0.5 * (from + to), to].iter().any(|&u| surface.eval(u, v)[2] < highest);
        let cells = self.spans.iter().take_while(|&&s| low(knots[s])).count();
        let mut sums = vec![[0.0; 7]; cells];
        let mut columns = vec![[0.0; 6]; surface.shape()[1]];
        let last = self.whole[..cells * self.count].last().map_or(0, |node| node.first + N);
        for (u, weight) in gauss_legendre(self.exact()).on(from, to) {
            collapse(self.hull, span, u, 0..last, &mut columns);
            for (sum, nodes) in sums.iter_mut().zip(self.whole.chunks(self.count)) {
                nodes.iter().for_each(|node| take(sum, &point(node, &columns), weight * node.weight));
            }
        }
        let mut below = vec![[0.0; 7]];
        for cell in sums {
            let before = below[below.len() - 1];
            below.push(std::array::from_fn(|k| before[k] + cell[k]));
        }
        Strip { from, to, below }
    }

    /// Number of spans in v below `end` as a whole.
    fn whole_below(&self, end: f64) -> usize {
        let knots = self.hull.surface().v().knots();
        self.spans.partition_point(|&span| knots[span + 1] <= end)
    }

    /// Calls `visit` with the nodes in v below `end`, from the span number `first`.
    fn each_below(&self, first: usize, end: f64, mut visit: impl FnMut(&Node<N>)) {
        let knots = self.hull.surface().v().knots();
        let whole = self.whole_below(end).max(first);
        self.whole[first * self.count..whole * self.count].iter().for_each(&mut visit);
        if let Some(&span) = self.spans.get(whole).filter(|&&span| end > knots[span]) {
            for (v, weight) in gauss_legendre(self.count).on(knots[span], end) {
                visit(&node_at::<N>(self.hull, span, v, weight));
            }
        }
    }

    fn below(&self, immersion: &Immersion) -> (Body, Waterplane) {
        let hull = self.hull;
        let exact = self.exact();
        let mut body = Body::default();
        let mut aft = 0.0;
        let mut sums = [0.0; 4];
        let mut plane = Plane::default();
        let mut columns = vec![[0.0; 6]; hull.surface().shape()[1]];
        let pieces = self.parted(immersion.pieces());
        for strip in &self.strips {
            let own: Vec<&Piece> = pieces.iter().filter(|p| p.from >= strip.from && p.to <= strip.to).collect();
            // The waterline stays within one span in v on each piece; where it leaves the strip nothing is immersed as
            // a whole.
            let middle = |p: &Piece| immersion.end(0.5 * (p.from + p.to));
            let covered = own.iter().map(|p| p.to - p.from).sum::<f64>() >= (1.0 - 1e-12) * (strip.to - strip.from);
            let least = own.iter().map(|p| self.whole_below(middle(p))).min().filter(|_| covered).unwrap_or(0);
            let least = least.min(strip.below.len() - 1);
            let mut all = strip.below[least];
            for piece in own {
                let mut widest = 0.0f64;
                let afloat = piece.upper == UpperEnd::Waterline && !immersion.above();
                let highest = self.spans.len().min(self.whole_below(middle(piece)) + 2);
                let range = self.spans[least.min(self.spans.len() - 1)] + 1 - N..self.spans[highest - 1] + 1;
                for (u, weight) in piece.nodes(exact) {
                    let end = immersion.end(u);
                    collapse(hull, piece.span, u, range.clone(), &mut columns);
                    self.each_below(least, end, |node| take(&mut all, &point(node, &columns), weight * node.weight));
                    let [_, keel, _, x, _, z] = columns[0];
                    body.bottom += 2.0 * weight * keel * x.hypot(z);
                    if afloat {
                        let node = node_at::<N>(hull, hull.surface().v().find_span(end), end, 0.0);
                        let p = point(&node, &columns);
                        let area = weight * p.at[1] * advance(hull, [p.along[0], p.along[2]], [p.up[0], p.up[2]]);
                        for (sum, arm) in sums.iter_mut().zip([1.0, p.at[0], p.at[0].powi(2), p.at[1].powi(2)]) {
                            *sum += area * arm;
                        }
                        widest = widest.max(p.at[1]);
                    }
                }
                if afloat && widest > 0.0 {
                    plane.take(piece, widest);
                }
            }
            let [volume, moment_x, moment_z, lateral, lateral_x, lateral_z, side] = all;
            body.volume += volume;
            body.moment_x += moment_x;
            body.moment_z += moment_z;
            body.lateral += lateral;
            body.lateral_x += lateral_x;
            body.lateral_z += lateral_z;
            body.side += side;
            if strip.to <= self.parting {
                aft += volume;
            }
        }
        if !immersion.deck_immersed() {
            body.aft = Some(aft + self.band(immersion));
        }
        self.ends(immersion, &mut body);
        let mut waterplane = plane.extents(hull, immersion);
        waterplane.area = 2.0 * sums[0];
        waterplane.moment = 2.0 * sums[1];
        waterplane.second = 2.0 * sums[2];
        waterplane.transverse = 2.0 / 3.0 * sums[3];
        (body, waterplane)
    }

    /// The pieces, parted at the line u_0.
    fn parted(&self, pieces: &[Piece]) -> Vec<Piece> {
        let at = self.parting;
        let part = |p: &Piece| {
            let (low, high) = (Piece { to: at, ..*p }, Piece { from: at, ..*p });
            if p.from < at && at < p.to { vec![low, high] } else { vec![*p] }
        };
        pieces.iter().flat_map(part).collect()
    }

    /// The volume between the line u_0 and midship, negative where midship is aft of the line.
    fn band(&self, immersion: &Immersion) -> f64 {
        let reach = self.passage.iter().map(|u| (u - self.parting).abs()).fold(0.0, f64::max);
        let surface = self.hull.surface();
        let (first, last) = surface.u().domain();
        if reach <= 1e-12 * (last - first) {
            return 0.0;
        }
        let ((low, high), knots) = (surface.v().domain(), surface.v().knots());
        let mut volume = 0.0;
        for (s, share) in gauss_legendre(BAND_NODES).on(0.0, 1.0) {
            let place = |passage: f64| self.parting + s * (passage - self.parting);
            let over = |v: f64| {
                surface.eval(place(self.hull.nearest_length_parameter(self.midship, v)), v)[2] - immersion.draught()
            };
            let end = if over(high) <= 0.0 {
                high
            } else if over(low) >= 0.0 {
                low
            } else {
                bracketed_root(over, low, high, 1e-15 * (high - low)).unwrap_or(high)
            };
            let mut take = |v: f64, weight: f64, passage: f64| {
                let at = surface.tangents(place(passage), v);
                let jacobian = at.du[0] * at.dv[2] - at.dv[0] * at.du[2];
                volume += 2.0 * share * weight * at.point[1] * jacobian * (passage - self.parting);
            };
            for (k, &span) in self.spans.iter().enumerate() {
                let (from, to) = (knots[span], knots[span + 1]);
                for (j, (v, weight)) in gauss_legendre(self.count).on(from, to.min(end.max(from))).enumerate() {
                    let known = (end >= to).then(|| self.passage[k * self.count + j]);
                    take(v, weight, known.unwrap_or_else(|| self.hull.nearest_length_parameter(self.midship, v)));
                }
                if end <= to {
                    break;
                }
            }
        }
        volume
    }

    /// Areas of transom and flat bow.
    fn ends(&self, immersion: &Immersion, body: &mut Body) {
        let surface = self.hull.surface();
        let (first, last) = surface.u().domain();
        for (u, stern) in [(first, true), (last, false)] {
            self.each_below(0, immersion.end(u), |node| {
                let columns = surface.shape()[1];
                let row = if stern { 0 } else { surface.shape()[0] - 1 };
                let points = &surface.points()[row * columns + node.first..row * columns + node.first + N];
                let (mut y, mut up) = (0.0, [0.0; 2]);
                for ((point, b), d) in points.iter().zip(&node.value).zip(&node.slope) {
                    y += b * point[1];
                    up[0] += d * point[0];
                    up[1] += d * point[2];
                }
                body.ends += 2.0 * node.weight * y * up[0].hypot(up[1]);
                if stern {
                    body.transom += 2.0 * node.weight * y * up[1];
                }
            });
        }
    }
}

/// The pieces of a waterline.
#[derive(Debug, Default)]
struct Plane {
    ends: Option<[Piece; 2]>,
    widest: Option<(f64, Piece)>,
}

impl Plane {
    fn take(&mut self, piece: &Piece, breadth: f64) {
        let first = self.ends.map_or(*piece, |ends| ends[0]);
        self.ends = Some([first, *piece]);
        if self.widest.is_none_or(|(known, _)| breadth > known) {
            self.widest = Some((breadth, *piece));
        }
    }

    /// Length, breadth and angles of the waterline.
    fn extents(&self, hull: &Hull, immersion: &Immersion) -> Waterplane {
        let Some([aft, fore]) = self.ends else { return Waterplane::default() };
        let x = |u: f64| hull.surface().eval(u, immersion.end(u))[0];
        let breadth = self.widest.map_or(0.0, |(known, piece)| largest_on(hull, immersion, &piece, known));
        Waterplane {
            aft: x(aft.from),
            length: x(fore.to) - x(aft.from),
            breadth: 2.0 * breadth,
            entrance: entrance_angle(
                |u| hull.surface().eval(u, immersion.end(u))[1].max(0.0),
                |u| half_angle(hull, immersion, u, fore.from),
                [fore.to, aft.from],
                breadth,
            ),
            run: half_angle(hull, immersion, aft.from, aft.to),
            ..Waterplane::default()
        }
    }
}

/// (dx, dy) along the waterline at `u`, to a positive factor.
fn velocity(hull: &Hull, immersion: &Immersion, u: f64) -> [f64; 2] {
    let at = hull.surface().tangents(u, immersion.end(u));
    let across = |axis: usize| at.du[axis] * at.dv[2] - at.dv[axis] * at.du[2];
    // Where the waterline is an edge on which z_v vanishes, it is the edge.
    if at.dv[2] > 0.0 || at.du[2].abs() > 0.0 { [across(0), across(1)] } else { [at.du[0], at.du[1]] }
}

/// The largest y of the waterline on a piece and at its ends, at least `known`.
fn largest_on(hull: &Hull, immersion: &Immersion, piece: &Piece, known: f64) -> f64 {
    let y = |u: f64| hull.surface().eval(u, immersion.end(u))[1];
    let known = known.max(y(piece.from)).max(y(piece.to));
    largest(y, |u| velocity(hull, immersion, u)[1], piece.from, piece.to, known)
}

/// Angle between the waterline and the centreplane at its end `u` \[deg\]; where the waterline stands still there in
/// the parameters, extrapolated from points towards `inward`, to about 1e-5 deg.
fn half_angle(hull: &Hull, immersion: &Immersion, u: f64, inward: f64) -> Option<f64> {
    let surface = hull.surface();
    let ((a, b), (c, d)) = (surface.u().domain(), surface.v().domain());
    let mean = hull.particulars().length_between_perpendiculars * (hull.top() - hull.bottom()) / ((b - a) * (d - c));
    let angle = |[x, y]: [f64; 2]| y.abs().atan2(x.abs()).to_degrees();
    let there = velocity(hull, immersion, u);
    if there[0].hypot(there[1]) > STANDSTILL * mean {
        return Some(angle(there));
    }
    let beside = |step: f64| angle(velocity(hull, immersion, u + (inward - u) * step * step));
    let angle = 2.0 * beside(1e-3) - beside(2e-3);
    angle.is_finite().then_some(angle)
}
