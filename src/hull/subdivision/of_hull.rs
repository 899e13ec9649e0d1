//! The control net of a hull.
//!
//! A grid of parameters, lines of knuckles in it, and the points of the net such that the limit surface passes through
//! the points of the hull on the grid: along each line between knuckles (P_{i-1} + 4 P_i + P_{i+1}) / 6 = S_i with P =
//! S at the ends, first along, then around. Between the grid the limit leaves the hull by O(h^4), beside knuckles and
//! ends by O(h^2), since creases are natural. The faces that close the body (bottom, transom, flat bow, deck) are
//! strips from the edge of the surface to the centreline.

use super::super::form::Hull;
use super::super::mesh::{Region, deck_parameter};
use super::{NetEdge, NetFace, NetLayer, NetPointKind, SubdivisionNet, key, sides};
use crate::spline::{KnotVector, cross, dot, length, minus};
use std::collections::BTreeMap;

/// Half-breadths below this part of the greatest are on the centreplane.
const CENTREPLANE: f64 = 1e-9;

/// Intervals along and around with which the search begins, and their most.
const FIRST: [usize; 2] = [16, 8];
const MOST: [usize; 2] = [80, 40];

/// Part of the height of the lowest deck below which lines are not moved to the deck.
const UNMOVED: f64 = 0.75;

/// Layers: their regions and colours (red + 256 green + 65536 blue).
const LAYERS: [(Region, u32); 5] = [
    (Region::Hull, 0xC8_6414),
    (Region::Bottom, 0x32_32A0),
    (Region::Transom, 0x78_7878),
    (Region::Bow, 0x78_7878),
    (Region::Deck, 0x64_A0C8),
];

/// Parameters of the lines of the grid, and which of them are knuckles or ends.
struct Lines {
    at: Vec<f64>,
    knuckle: Vec<bool>,
}

/// About `count` intervals, a whole number between knuckles.
fn lines(knots: &KnotVector, count: usize) -> Lines {
    let (from, to) = knots.domain();
    let sharp = |t: f64| knots.multiplicity(t) >= knots.degree();
    let ends: Vec<f64> = knots.breakpoints().into_iter().filter(|&t| t <= from || t >= to || sharp(t)).collect();
    let (mut at, mut knuckle) = (vec![from], vec![true]);
    for pair in ends.windows(2) {
        let share = count as f64 * (pair[1] - pair[0]) / (to - from);
        let parts = share.round().max(1.0) as usize;
        at.extend((1..=parts).map(|k| pair[0] + (pair[1] - pair[0]) * k as f64 / parts as f64));
        knuckle.extend((1..=parts).map(|k| k == parts));
    }
    Lines { at, knuckle }
}

/// The points of a line of the net from those of the surface, between each two knuckles.
fn interpolated(points: &[[f64; 3]], knuckle: &[bool]) -> Vec<[f64; 3]> {
    let mut net = points.to_vec();
    let ends: Vec<usize> = (0..points.len()).filter(|&k| knuckle[k]).collect();
    for pair in ends.windows(2) {
        let (first, count) = (pair[0], pair[1] - pair[0]);
        // Tridiagonal elimination of 1 4 1 within.
        let mut pivots = vec![0.0_f64; count];
        for k in 1..count {
            pivots[k] = 1.0 / (4.0 - if k > 1 { pivots[k - 1] } else { 0.0 });
            net[first + k] = [0, 1, 2].map(|c| {
                let known = if k + 1 == count { points[first + count][c] } else { 0.0 };
                pivots[k] * (6.0 * points[first + k][c] - net[first + k - 1][c] - known)
            });
        }
        for k in (1..count.saturating_sub(1)).rev() {
            net[first + k] = [0, 1, 2].map(|c| net[first + k][c] - pivots[k] * net[first + k + 1][c]);
        }
    }
    net
}

/// Weights of the four points about the middle of an interval of a line, those beyond its ends by reflection.
fn middle_weights(k: usize, knuckle: &[bool]) -> [(usize, f64); 4] {
    let [outer, inner] = [1.0 / 48.0, 23.0 / 48.0];
    let mut weights = [(k.saturating_sub(1), outer), (k, inner), (k + 1, inner), (k + 2, outer)];
    // P_{-1} = 2 P_0 - P_1.
    if knuckle[k] {
        weights[0] = (k + 1, -outer);
        weights[1].1 += 2.0 * outer;
    }
    if knuckle[k + 1] {
        weights[3] = (k, -outer);
        weights[2].1 += 2.0 * outer;
    }
    weights
}

/// The grid of the net, and what its limit leaves the surface by between the lines \[m\].
fn grid(hull: &Hull, us: &Lines, vs: &Lines) -> (Vec<Vec<[f64; 3]>>, f64) {
    let surface = hull.surface();
    let (from, to) = surface.v().domain();
    let top = |u: f64| deck_parameter(hull, u);
    let lowest = us.at.iter().map(|&u| top(u)).fold(to, f64::min);
    let moved = vs.at.iter().copied().filter(|&v| v <= from + UNMOVED * (lowest - from)).fold(from, f64::max);
    let breadth = surface.points().iter().map(|p| p[1].abs()).fold(0.0, f64::max);
    let lowered =
        |v: f64, top: f64| if v > moved && top < to { moved + (v - moved) * (top - moved) / (to - moved) } else { v };
    let flat = |y: f64| if y <= CENTREPLANE * breadth { 0.0 } else { y };
    let columns: Vec<Vec<[f64; 3]>> = us
        .at
        .iter()
        .map(|&u| {
            let top = top(u);
            let along = vs.at.iter().map(|&v| {
                let [x, y, z] = surface.eval(u, lowered(v, top));
                [x, flat(y), z]
            });
            interpolated(&along.collect::<Vec<_>>(), &vs.knuckle)
        })
        .collect();
    let mut net = columns;
    for j in 0..vs.at.len() {
        let row: Vec<[f64; 3]> = net.iter().map(|column| column[j]).collect();
        for (column, [x, y, z]) in net.iter_mut().zip(interpolated(&row, &us.knuckle)) {
            column[j] = [x, flat(y), z];
        }
    }
    let mut deviation = 0.0_f64;
    for i in 0..us.at.len() - 1 {
        let u = 0.5 * (us.at[i] + us.at[i + 1]);
        let (top, along) = (top(u), middle_weights(i, &us.knuckle));
        for j in 0..vs.at.len() - 1 {
            let v = lowered(0.5 * (vs.at[j] + vs.at[j + 1]), top);
            let mut limit = [0.0; 3];
            for (p, a) in along {
                for (q, b) in middle_weights(j, &vs.knuckle) {
                    (0..3).for_each(|c| limit[c] += a * b * net[p][q][c]);
                }
            }
            let d = surface.derivatives::<2>(u, v);
            let normal = cross(d[1][0], d[0][1]);
            let long = length(normal);
            if long > 0.0 {
                deviation = deviation.max(dot(minus(limit, d[0][0]), normal).abs() / long);
            }
        }
    }
    (net, deviation)
}

/// Points and faces, each once.
#[derive(Default)]
struct Builder {
    net: SubdivisionNet,
    creases: BTreeMap<(usize, usize), bool>,
}

impl Builder {
    fn point(&mut self, point: [f64; 3]) -> usize {
        self.net.points.push((point, NetPointKind::Regular));
        self.net.points.len() - 1
    }

    /// A face of the corners, without those that repeat; none of less than three.
    fn face(&mut self, corners: &[usize], layer: usize) {
        let mut corners = corners.to_vec();
        corners.dedup();
        while corners.len() > 1 && corners[0] == corners[corners.len() - 1] {
            corners.pop();
        }
        if corners.len() > 2 {
            for side in sides(&corners) {
                self.creases.entry(side).or_insert(false);
            }
            self.net.faces.push(NetFace { corners, layer });
        }
    }

    fn crease(&mut self, a: usize, b: usize) {
        if let Some(crease) = self.creases.get_mut(&key(a, b)) {
            *crease = true;
        }
    }
}

impl SubdivisionNet {
    /// The net of the half y >= 0 of a hull up to its deck, all layers symmetric, with at most so many lines that its
    /// limit is within `deviation` \[m\] of the hull; and what it is within \[m\], which is more where more lines would
    /// be too many.
    #[must_use]
    pub fn of_hull(hull: &Hull, deviation: f64) -> (Self, f64) {
        let surface = hull.surface();
        let mut counts = FIRST;
        let (us, vs, grid, reached) = loop {
            let [us, vs] = [lines(surface.u(), counts[0]), lines(surface.v(), counts[1])];
            let (net, reached) = grid(hull, &us, &vs);
            if reached <= deviation || (0..2).all(|k| counts[k] >= MOST[k]) {
                break (us, vs, net, reached);
            }
            counts = [0, 1].map(|k| (counts[k] + counts[k] / 2).min(MOST[k]));
        };
        let (m, n) = (us.at.len(), vs.at.len());
        let mut builder = Builder::default();
        builder.net.layers = LAYERS
            .iter()
            .map(|&(region, colour)| NetLayer {
                name: region.name().to_owned(),
                colour,
                symmetric: true,
                in_hydrostatics: true,
            })
            .collect();
        // Points of an edge that has shrunk are one.
        let mut places: Vec<Vec<usize>> = vec![vec![0; n]; m];
        for i in 0..m {
            for j in 0..n {
                let same = |p: [f64; 3], q: [f64; 3]| p.map(f64::to_bits) == q.map(f64::to_bits);
                places[i][j] = if j > 0 && same(grid[i][j], grid[i][j - 1]) {
                    places[i][j - 1]
                } else if i > 0 && same(grid[i][j], grid[i - 1][j]) {
                    places[i - 1][j]
                } else {
                    builder.point(grid[i][j])
                };
            }
        }
        for i in 0..m - 1 {
            for j in 0..n - 1 {
                builder.face(&[places[i][j], places[i][j + 1], places[i + 1][j + 1], places[i + 1][j]], 0);
            }
        }
        let row = |j: usize| places.iter().map(|column| column[j]).collect::<Vec<usize>>();
        let reversed = |edge: &[usize]| edge.iter().rev().copied().collect::<Vec<usize>>();
        let edges = [reversed(&row(0)), places[0].clone(), reversed(&places[m - 1]), row(n - 1)];
        let mut centres: BTreeMap<usize, usize> = BTreeMap::new();
        let mut ends = Vec::new();
        for (layer, edge) in (1..).zip(&edges) {
            let mut centre = |builder: &mut Builder, at: usize| {
                let [x, y, z] = builder.net.points[at].0;
                if y > 0.0 { *centres.entry(at).or_insert_with(|| builder.point([x, 0.0, z])) } else { at }
            };
            let middles: Vec<usize> = edge.iter().map(|&at| centre(&mut builder, at)).collect();
            for k in 0..edge.len() - 1 {
                builder.face(&[middles[k], middles[k + 1], edge[k + 1], edge[k]], layer);
            }
            for k in [0, edge.len() - 1] {
                ends.push((middles[k], edge[k]));
            }
        }
        for (a, b) in ends {
            builder.crease(a, b);
        }
        for (j, _) in vs.knuckle.iter().enumerate().filter(|(_, knuckle)| **knuckle) {
            places.windows(2).for_each(|pair| builder.crease(pair[0][j], pair[1][j]));
        }
        for (i, _) in us.knuckle.iter().enumerate().filter(|(_, knuckle)| **knuckle) {
            places[i].windows(2).for_each(|pair| builder.crease(pair[0], pair[1]));
        }
        let corners = [places[0][0], places[0][n - 1], places[m - 1][0], places[m - 1][n - 1]];
        (builder.finished(&corners), reached)
    }
}

impl Builder {
    /// The net with its edges, edges of one face being creases, and the points declared by their number of creases.
    fn finished(mut self, corners: &[usize]) -> SubdivisionNet {
        let mut uses: BTreeMap<(usize, usize), usize> = BTreeMap::new();
        for side in self.net.faces.iter().flat_map(|face| sides(&face.corners)) {
            *uses.entry(side).or_default() += 1;
        }
        let mut counts = vec![0_usize; self.net.points.len()];
        for (&(a, b), crease) in &self.creases {
            let crease = *crease || uses.get(&(a, b)) != Some(&2);
            self.net.edges.push(NetEdge { ends: [a, b], crease });
            for at in [a, b] {
                counts[at] += usize::from(crease);
            }
        }
        for (at, (_, kind)) in self.net.points.iter_mut().enumerate() {
            *kind = match counts[at] {
                _ if corners.contains(&at) => NetPointKind::Corner,
                0 => NetPointKind::Regular,
                1 => NetPointKind::Dart,
                2 => NetPointKind::Crease,
                _ => NetPointKind::Corner,
            };
        }
        // Layers without faces are left out.
        let used: Vec<usize> =
            (0..self.net.layers.len()).filter(|&k| self.net.faces.iter().any(|face| face.layer == k)).collect();
        self.net.layers = used.iter().map(|&k| self.net.layers[k].clone()).collect();
        for face in &mut self.net.faces {
            face.layer = used.iter().position(|&k| k == face.layer).unwrap_or(0);
        }
        self.net
    }
}
