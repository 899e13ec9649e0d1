//! Volume, its moments, wetted surface, lateral plane and ends below each of many draughts, from one pass over the
//! surface.
//!
//! For every Gauss node in u the net is collapsed in u once; the products are then summed at fixed nodes in v: the
//! nodes of each span, and for each draught the nodes of the part of its last span below the waterline. Sums up to the
//! knots in v are kept, so that a draught costs its part of one span: O(spans_u (spans_v + draughts)) in all. Sums run
//! in a fixed order.
//!
//! Volume and moments are exact to rounding, the rules being exact for the piecewise polynomial integrands. The wetted
//! surface 2 int int |S_u x S_v| dv du is not polynomial; its relative error is below 1e-8 where the surface is smooth
//! within its spans. Draughts that immerse the deck at side are integrated one by one, u-line by u-line up to the deck.

use super::halves::volumes_to_midship;
use super::node::{Node, nodes};
use super::station::Stations;
use crate::hull::{Hull, Immersion, UpperEnd};
use crate::numeric::gauss_legendre;

/// Nodes a piece in u where the body ends at the deck.
const DECK_NODES: usize = 16;

/// Nodes at least over the whole of u, and of v, so that the wetted surface of a net with few spans is accurate too.
const NODES_ALONG: usize = 48;
const NODES_UP: usize = 24;

/// Nodes a span in v beyond those that make the moments exact: off a flat of bottom, where dz/dv starts from 0, the
/// wetted surface of a bulk carrier is wrong by 1.4e-8 without and by 1.4e-9 with them.
const SKIN_NODES: usize = 3;

/// Integrals over the body below one draught, both sides.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Body {
    /// Volume [m^3].
    pub(super) volume: f64,
    /// Its moment about x = 0 [m^4].
    pub(super) moment_x: f64,
    /// Its moment about z = 0 [m^4].
    pub(super) moment_z: f64,
    /// Volume aft of midship [m^3]; none where the deck is immersed.
    pub(super) aft: Option<f64>,
    /// Area of the side [m^2].
    pub(super) side: f64,
    /// True area of transom and flat bow [m^2].
    pub(super) ends: f64,
    /// Area of the transom projected along x [m^2].
    pub(super) transom: f64,
    /// Area of the bottom across the keel line [m^2]; set apart on level hulls, whose bottom is the same at every
    /// draught.
    pub(super) bottom: f64,
    /// Area of the profile [m^2].
    pub(super) lateral: f64,
    /// Its moment about x = 0 [m^3].
    pub(super) lateral_x: f64,
    /// Its moment about z = 0 [m^3].
    pub(super) lateral_z: f64,
}

impl Body {
    fn add(&mut self, other: &Self) {
        self.volume += other.volume;
        self.moment_x += other.moment_x;
        self.moment_z += other.moment_z;
        self.aft = self.aft.zip(other.aft).map(|(a, b)| a + b);
        self.side += other.side;
        self.ends += other.ends;
        self.transom += other.transom;
        self.lateral += other.lateral;
        self.lateral_x += other.lateral_x;
        self.lateral_z += other.lateral_z;
    }
}

/// Number of nodes in v on every span: volume moments are of degree 4q - 1, the wetted surface wants more.
pub(super) fn count_up(hull: &Hull) -> usize {
    let knots = hull.surface().v();
    (2 * knots.degree() + SKIN_NODES).max(NODES_UP.div_ceil(knots.spans().len()))
}

/// Number of nodes in u on every span: the moment about x = 0 is of degree 3p - 1.
pub(super) fn count_along(hull: &Hull) -> usize {
    let knots = hull.surface().u();
    (3 * knots.degree()).div_ceil(2).max(NODES_ALONG.div_ceil(knots.spans().len()))
}

/// Integrals in u at one node in v, one side.
#[derive(Debug, Clone, Copy, Default)]
struct LineIntegrals {
    area: f64,
    moment: f64,
    skin: f64,
    aft: f64,
}

/// Coordinates x, y and derivatives x_u, y_u of the columns of the net at one u.
fn collapse(hull: &Hull, span: usize, u: f64, columns: &mut [[f64; 4]]) {
    let knots = hull.surface().u();
    let [value, slope] = knots.basis_derivatives::<2>(span, u);
    columns.fill([0.0; 4]);
    let count = columns.len();
    for (i, row) in (span - knots.degree()..=span).enumerate() {
        let points = &hull.surface().points()[row * count..(row + 1) * count];
        for (column, point) in columns.iter_mut().zip(points) {
            column[0] += value[i] * point[0];
            column[1] += value[i] * point[1];
            column[2] += slope[i] * point[0];
            column[3] += slope[i] * point[1];
        }
    }
}

/// dz/dv below this part of the height of the hull is a level strip between two bodies.
const LEVEL_STRIP: f64 = 1e-6;

/// x, y, x_u, y_u and the norm of S_u x S_v at a node.
///
/// On a strip without height (dz/dv below `level`), over which a profile jumps along a level keel, it is the signed
/// area: the lines of the strip pass over one another, and what counts is the waterline above less that below.
fn point<const N: usize>(node: &Node<N>, columns: &[[f64; 4]], level: f64) -> ([f64; 4], f64) {
    let (mut at, mut up) = ([0.0; 4], [0.0; 2]);
    for ((column, value), slope) in columns[node.first..node.first + N].iter().zip(&node.value).zip(&node.slope) {
        for (sum, c) in at.iter_mut().zip(column) {
            *sum += value * c;
        }
        up[0] += slope * column[0];
        up[1] += slope * column[1];
    }
    let across = at[2] * up[1] - at[3] * up[0];
    if node.rise <= level {
        return (at, across);
    }
    let skin = ((at[2] * at[2] + at[3] * at[3]) * node.rise * node.rise + across * across).sqrt();
    (at, skin)
}

/// The integrals below each immersion, volumes being parted at x = `midship`; zero where nothing is immersed.
pub(super) fn bodies<const N: usize>(
    stations: &Stations<N>,
    immersions: &[Option<Immersion>],
    midship: f64,
) -> Vec<Body> {
    let hull = stations.hull;
    let knots = hull.surface().v();
    let spans = knots.spans();
    let count = count_up(hull);
    let mut all = Vec::with_capacity((spans.len() + immersions.len()) * count);
    for &span in &spans {
        nodes::<N>(hull, span, f64::INFINITY, count, &mut all);
    }
    // What each draught takes: the whole spans below it and its own nodes.
    let own: Vec<(usize, std::ops::Range<usize>)> = immersions
        .iter()
        .map(|immersion| {
            let start = all.len();
            let Some(immersion) = immersion.as_ref().filter(|i| !i.deck_immersed()) else { return (0, start..start) };
            let end = immersion.waterline();
            let whole = spans.iter().take_while(|&&span| knots.knots()[span + 1] <= end).count();
            if let Some(&span) = spans.get(whole) {
                nodes::<N>(hull, span, end, count, &mut all);
            }
            (whole, start..all.len())
        })
        .collect();
    // The knot line in u next to midship on the highest waterline.
    let top = hull.surface().v().domain().1;
    let parting = hull.length_parameter(midship, top).unwrap_or(hull.surface().u().domain().0);
    let parting = hull.surface().u().find_span(parting);
    let lines = pass(hull, &all, parting);
    let to_midship = volumes_to_midship(stations, immersions, midship, parting);
    let mut below = vec![Body { aft: Some(0.0), ..Body::default() }];
    let mut sum = below[0];
    for (k, (node, line)) in all.iter().zip(&lines).take(spans.len() * count).enumerate() {
        sum.add(&contribution(hull, node, line));
        if (k + 1) % count == 0 {
            below.push(sum);
        }
    }
    let mut bodies = Vec::with_capacity(immersions.len());
    for ((immersion, (whole, range)), rest) in immersions.iter().zip(own).zip(to_midship) {
        bodies.push(match immersion {
            None => Body::default(),
            Some(immersion) if immersion.deck_immersed() => body_below_deck::<N>(hull, immersion),
            Some(_) => {
                let mut body = below[whole];
                for (node, line) in all[range.clone()].iter().zip(&lines[range]) {
                    body.add(&contribution(hull, node, line));
                }
                body.aft = body.aft.zip(rest).map(|(aft, rest)| aft + rest);
                body
            }
        });
    }
    bodies
}

/// The pass over the surface: integrals in u at every node; `aft` is the part of the area before the span `parting`.
fn pass<const N: usize>(hull: &Hull, nodes: &[Node<N>], parting: usize) -> Vec<LineIntegrals> {
    let knots = hull.surface().u();
    let count = count_along(hull);
    let mut columns = vec![[0.0; 4]; hull.surface().shape()[1]];
    let level = LEVEL_STRIP * (hull.top() - hull.bottom());
    let mut lines = vec![LineIntegrals::default(); nodes.len()];
    for span in knots.spans() {
        if span == parting {
            for line in &mut lines {
                line.aft = line.area;
            }
        }
        for (u, weight) in gauss_legendre(count).on(knots.knots()[span], knots.knots()[span + 1]) {
            collapse(hull, span, u, &mut columns);
            for (node, line) in nodes.iter().zip(&mut lines) {
                let ([x, y, along, _], skin) = point(node, &columns, level);
                let area = weight * y * along;
                line.area += area;
                line.moment += area * x;
                line.skin += weight * skin;
            }
        }
    }
    lines
}

/// Half-breadth and length along the profile of one end at a node: x, y, and the length of S_v.
fn profile<const N: usize>(hull: &Hull, node: &Node<N>, row: usize) -> [f64; 3] {
    let columns = hull.surface().shape()[1];
    let points = &hull.surface().points()[row * columns + node.first..row * columns + node.first + N];
    let (mut x, mut y, mut up) = (0.0, 0.0, 0.0);
    for ((point, value), slope) in points.iter().zip(&node.value).zip(&node.slope) {
        x += value * point[0];
        y += value * point[1];
        up += slope * point[0];
    }
    [x, y, up.hypot(node.rise)]
}

/// What a node adds to the integrals, both sides.
fn contribution<const N: usize>(hull: &Hull, node: &Node<N>, line: &LineIntegrals) -> Body {
    let height = node.weight * node.rise;
    let [stern, breadth_aft, length_aft] = profile(hull, node, 0);
    let [stem, breadth_fore, length_fore] = profile(hull, node, hull.surface().shape()[0] - 1);
    let length = stem - stern;
    Body {
        volume: 2.0 * height * line.area,
        moment_x: 2.0 * height * line.moment,
        moment_z: 2.0 * height * line.area * node.z,
        aft: Some(2.0 * height * line.aft),
        side: 2.0 * node.weight * line.skin,
        ends: 2.0 * node.weight * (breadth_aft * length_aft + breadth_fore * length_fore),
        transom: 2.0 * height * breadth_aft,
        bottom: 0.0,
        lateral: height * length,
        lateral_x: height * length * 0.5 * (stern + stem),
        lateral_z: height * length * node.z,
    }
}

/// The nodes on a line u = constant up to where the body ends there; those of whole spans are the same on all lines.
struct NodesBelow<'a, const N: usize> {
    hull: &'a Hull,
    count: usize,
    /// Spans in v.
    spans: Vec<usize>,
    /// The nodes of all spans.
    all: Vec<Node<N>>,
    /// The nodes of the span in which the body ends.
    last: Vec<Node<N>>,
}

impl<'a, const N: usize> NodesBelow<'a, N> {
    /// `count` nodes a span.
    fn new(hull: &'a Hull, count: usize) -> Self {
        let (spans, mut all) = (hull.surface().v().spans(), Vec::new());
        spans.iter().for_each(|&span| nodes(hull, span, f64::INFINITY, count, &mut all));
        Self { hull, count, spans, all, last: Vec::with_capacity(count) }
    }

    /// The nodes below v = `end`, from the lowest.
    fn end(&mut self, end: f64) -> impl Iterator<Item = &Node<N>> {
        let knots = self.hull.surface().v().knots();
        let whole = self.spans.partition_point(|&span| knots[span + 1] <= end);
        self.last.clear();
        if let Some(&span) = self.spans.get(whole) {
            nodes(self.hull, span, end, self.count, &mut self.last);
        }
        self.all[..whole * self.count].iter().chain(&self.last)
    }
}

/// The integrals below a draught that may immerse the deck at side.
fn body_below_deck<const N: usize>(hull: &Hull, immersion: &Immersion) -> Body {
    let surface = hull.surface();
    let (count, along) = (count_up(hull), count_along(hull));
    let mut columns = vec![[0.0; 4]; surface.shape()[1]];
    let level = LEVEL_STRIP * (hull.top() - hull.bottom());
    let mut body = Body::default();
    let mut below = NodesBelow::<N>::new(hull, count);
    for piece in immersion.pieces() {
        let at_deck = piece.upper == UpperEnd::Deck;
        for (u, weight) in gauss_legendre(if at_deck { along.max(DECK_NODES) } else { along }).on(piece.from, piece.to)
        {
            collapse(hull, piece.span, u, &mut columns);
            for node in below.end(immersion.end(u)) {
                let ([x, y, along, _], skin) = point(node, &columns, level);
                let profile = weight * node.weight * node.rise * along;
                body.volume += 2.0 * profile * y;
                body.moment_x += 2.0 * profile * y * x;
                body.moment_z += 2.0 * profile * y * node.z;
                body.side += 2.0 * weight * node.weight * skin;
                body.lateral += profile;
                body.lateral_x += profile * x;
                body.lateral_z += profile * node.z;
            }
        }
    }
    for (u, row) in [(surface.u().domain().0, 0), (surface.u().domain().1, surface.shape()[0] - 1)] {
        for node in below.end(immersion.end(u)) {
            let [_, y, length] = profile(hull, node, row);
            body.ends += 2.0 * node.weight * y * length;
            if row == 0 {
                body.transom += 2.0 * node.weight * node.rise * y;
            }
        }
    }
    body
}
