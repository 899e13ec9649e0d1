//! A body given by nothing but triangles.
//!
//! Its section by a plane x = X takes every vertex on the plane for one just forward of it (simulation of simplicity:
//! the section is that at X - 0), so that a plane that meets vertices, edges or whole triangles cuts each triangle in
//! one line or none, and lines end on edges that two triangles share. Sections of closed meshes are therefore closed
//! loops at every X, without tolerances.

mod boxes;
mod flood;
mod openings;
mod rims;
mod shells;
mod surfaces;

pub use flood::DrySkin;
pub use openings::{cover, lines_of_edges};
pub use shells::InnerShells;
pub(super) use surfaces::{Bends, corners};

use rims::Rims;

use super::mesh::{MeshReport, measure};
use super::vertices::Known;
use crate::spline::{cross, length, minus};
use std::collections::HashMap;

/// Corners of half a body nearer to the centreplane than this part of its largest extent are on it.
const CENTREPLANE: f64 = 1e-6;

/// Rims nearer than this part of the size of the body are in one place.
const ONE: f64 = 1e-4;

/// The inner edge of one side of a body is this near to the centreplane, over the half-breadth.
const NEAR: f64 = 0.02;

/// Part by which extents that are one differ.
const ALIKE: f64 = 1e-6;
/// Parts whose least and greatest y add to less than this part of the size of the body are symmetric about the centreplane.
const ASTRIDE: f64 = 1e-4;

/// A part of the side's area from which triangles on the centreplane are a wall that closes it.
const WALL: f64 = 0.1;

/// What of a body a mesh is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum BodyPart {
    /// Both sides of the centreplane, or a body beside it.
    Whole,
    /// One side, whose inner edge is at this |y| \[m\]; less than 0 where it reaches over the centreplane.
    Half {
        /// |y| of the inner edge \[m\].
        inner: f64,
    },
    /// One side, closed or with a wall on the centreplane: half a body, or a whole one that begins there.
    ClosedBeside,
}

/// A mesh of triangles, normals outward (right-hand rule).
#[derive(Debug, Clone, PartialEq, Default)]
pub struct TriangleMesh {
    /// Vertices \[m\], each once.
    pub vertices: Vec<[f64; 3]>,
    /// Triangles as indices of vertices.
    pub triangles: Vec<[usize; 3]>,
}

/// A connected line of a section.
#[derive(Debug, Clone, PartialEq)]
pub struct MeshLine {
    /// Points (y, z) \[m\]; the first is not repeated at the end of a closed line.
    pub points: Vec<[f64; 2]>,
    /// Whether the last point is joined to the first.
    pub closed: bool,
}

/// Edges of one of these triangles alone, in its direction.
fn open_edges(triangles: impl Iterator<Item = [usize; 3]> + Clone) -> Vec<[usize; 2]> {
    let mut uses: HashMap<(usize, usize), usize> = HashMap::new();
    let edges = triangles.flat_map(|t| [[t[0], t[1]], [t[1], t[2]], [t[2], t[0]]]);
    for [p, q] in edges.clone() {
        *uses.entry((p.min(q), p.max(q))).or_default() += 1;
    }
    edges.filter(|&[p, q]| uses.get(&(p.min(q), p.max(q))) == Some(&1)).collect()
}

impl TriangleMesh {
    /// A mesh of triangles given by their corners; equal corners are one vertex, triangles with two of them are left
    /// out, and so are corners that are not finite.
    #[must_use]
    pub fn from_corners(corners: impl Iterator<Item = [[f64; 3]; 3]>) -> Self {
        let mut mesh = Self::default();
        let mut known = Known::default();
        for triangle in corners.filter(|triangle| triangle.iter().flatten().all(|c| c.is_finite())) {
            let places = triangle.map(|point| known.place(&mut mesh.vertices, point));
            let [a, b, c] = places;
            if a != b && b != c && c != a {
                mesh.triangles.push(places);
            }
        }
        mesh
    }

    /// The corners of the triangles \[m\].
    pub fn corners(&self) -> impl Iterator<Item = [[f64; 3]; 3]> + '_ {
        self.triangles.iter().map(|triangle| triangle.map(|k| self.vertices[k]))
    }

    /// Least and greatest coordinates \[m\]; none without vertices.
    #[must_use]
    pub fn bounds(&self) -> Option<[[f64; 3]; 2]> {
        let first = *self.vertices.first()?;
        let fold = |pick: fn(f64, f64) -> f64| {
            self.vertices.iter().fold(first, |ends, point| [0, 1, 2].map(|k| pick(ends[k], point[k])))
        };
        Some([fold(f64::min), fold(f64::max)])
    }

    /// First moments int (x_k - o_k) dA and products int (x_k - o_k)(x_l - o_l) dA about a point o, over the area.
    ///
    /// Of a triangle with the corners a, b, c and their sum s: int x_k x_l dA / A = (a_k a_l + b_k b_l + c_k c_l + s_k s_l)/12.
    #[must_use]
    pub fn moments(&self, about: [f64; 3]) -> ([f64; 3], [[f64; 3]; 3]) {
        let (mut area, mut first, mut mixed) = (0.0, [0.0; 3], [[0.0; 3]; 3]);
        for corners in self.corners() {
            let own = triangle_area(corners);
            let corners = corners.map(|corner| minus(corner, about));
            let sum = [0, 1, 2].map(|k: usize| corners.iter().map(|corner| corner[k]).sum::<f64>());
            area += own;
            for k in 0..3 {
                first[k] += own * sum[k] / 3.0;
                for l in 0..3 {
                    let products: f64 = corners.iter().map(|corner| corner[k] * corner[l]).sum();
                    mixed[k][l] += own * (products + sum[k] * sum[l]) / 12.0;
                }
            }
        }
        (first.map(|value| value / area), mixed.map(|row| row.map(|value| value / area)))
    }

    /// The integral of y over the y of the area vectors \[m^3\], to which deck, bottom and transom add nothing, and the area
    /// of the skin \[m^2\].
    #[must_use]
    pub fn enclosed_and_skin(&self) -> [f64; 2] {
        [shells::enclosed(self.corners()), self.corners().map(triangle_area).sum()]
    }

    /// Checks closure and measures.
    #[must_use]
    pub fn report(&self) -> MeshReport {
        measure(&self.vertices, self.triangles.iter().copied())
    }

    /// The edges that belong to one triangle.
    #[must_use]
    pub fn open_edges(&self) -> Vec<[usize; 2]> {
        open_edges(self.triangles.iter().copied())
    }

    /// Of each triangle those beside it, edge by edge, and whether both run through the edge in the same direction; none where
    /// an edge is open, or of an odd number. Where shells share an edge, as many of its triangles run through it in one
    /// direction as in the other. Then the first of both are beside each other, and so on: files have shell after shell.
    fn neighbours(&self) -> Vec<[Option<(usize, bool)>; 3]> {
        // Sorted, the triangles of an edge stand beside each other.
        let mut edges = Vec::with_capacity(3 * self.triangles.len());
        for (k, t) in self.triangles.iter().enumerate() {
            edges.extend((0..3).map(|e| {
                let (p, q) = (t[e], t[(e + 1) % 3]);
                (p.min(q), p.max(q), k, e, p > q)
            }));
        }
        edges.sort_unstable();
        let mut neighbours: Vec<[Option<(usize, bool)>; 3]> = vec![[None; 3]; self.triangles.len()];
        let mut join = |a: (usize, usize), b: (usize, usize), alike: bool| {
            neighbours[a.0][a.1] = Some((b.0, alike));
            neighbours[b.0][b.1] = Some((a.0, alike));
        };
        for all in edges.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)) {
            if let [a, b] = all {
                join((a.2, a.3), (b.2, b.3), a.4 == b.4);
                continue;
            }
            let running = |back: bool| all.iter().filter(move |edge| edge.4 == back).map(|edge| (edge.2, edge.3));
            if running(true).count() == running(false).count() {
                running(true).zip(running(false)).for_each(|(a, b)| join(a, b, false));
            }
        }
        neighbours
    }

    /// The mesh with every triangle turned so that neighbours run through their common edge in opposite directions, and
    /// the parts that hang together enclose a positive volume, int y n_y; and how many triangles were turned.
    #[must_use]
    pub fn oriented(mut self) -> (Self, usize) {
        let neighbours = self.neighbours();
        let mut turn: Vec<Option<bool>> = vec![None; self.triangles.len()];
        let mut parts = Vec::new();
        for first in 0..self.triangles.len() {
            if turn[first].is_some() {
                continue;
            }
            turn[first] = Some(false);
            let (mut part, mut next) = (vec![first], 0);
            while next < part.len() {
                let k = part[next];
                next += 1;
                let own_turn = turn[k] == Some(true);
                for (other, alike) in neighbours[k].into_iter().flatten() {
                    if turn[other].is_none() {
                        turn[other] = Some(own_turn != alike);
                        part.push(other);
                    }
                }
            }
            parts.push(part);
        }
        for skin in self.skins(&parts, &turn) {
            let sum: f64 = skin
                .iter()
                .map(|&(k, opposite)| {
                    let [a, b, c] = self.triangles[k].map(|v| self.vertices[v]);
                    let along = cross(minus(b, a), minus(c, a))[1] * (a[1] + b[1] + c[1]);
                    if (turn[k] == Some(true)) != opposite { -along } else { along }
                })
                .sum();
            for (k, opposite) in skin {
                turn[k] = turn[k].map(|turned| (turned != opposite) != (sum < 0.0));
            }
        }
        let mut turned = 0;
        for (triangle, _) in self.triangles.iter_mut().zip(&turn).filter(|(_, turn)| **turn == Some(true)) {
            triangle.swap(1, 2);
            turned += 1;
        }
        (self, turned)
    }

    /// The triangles of parts that close each other along their rims, and whether a part is to be turned so that it runs
    /// through them as its neighbours do. Triangles of which `turn` is true are turned before.
    fn skins(&self, parts: &[Vec<usize>], turn: &[Option<bool>]) -> Vec<Vec<(usize, bool)>> {
        let mut seen = self.clone();
        for (triangle, _) in seen.triangles.iter_mut().zip(turn).filter(|(_, turn)| **turn == Some(true)) {
            triangle.swap(1, 2);
        }
        let rims = Rims::of(&seen, parts, ONE);
        let mut beside: Vec<Vec<(usize, bool)>> = vec![Vec::new(); parts.len()];
        for ([a, b], alike) in rims.joints(&seen) {
            beside[a].push((b, alike));
            beside[b].push((a, alike));
        }
        let mut opposite: Vec<Option<bool>> = vec![None; parts.len()];
        let mut skins = Vec::new();
        for first in 0..parts.len() {
            if opposite[first].is_some() {
                continue;
            }
            opposite[first] = Some(false);
            let (mut skin, mut next) = (vec![first], 0);
            while let Some(&part) = skin.get(next) {
                next += 1;
                for &(other, alike) in &beside[part] {
                    if opposite[other].is_none() {
                        opposite[other] = opposite[part].map(|own| own != alike);
                        skin.push(other);
                    }
                }
            }
            let triangles = skin.iter().flat_map(|&part| parts[part].iter().map(move |&k| (k, part)));
            skins.push(triangles.map(|(k, part)| (k, opposite[part] == Some(true))).collect());
        }
        skins
    }

    /// The parts that lie on both sides of y = 0 alike, and the rest.
    #[must_use]
    pub fn astride(&self) -> [Self; 2] {
        let Some([least, greatest]) = self.bounds() else { return [self.clone(), self.clone()] };
        let near = ASTRIDE * length(minus(greatest, least));
        let mut is_astride = vec![false; self.triangles.len()];
        for shell in self.shells() {
            let points = || shell.iter().flat_map(|&t| self.triangles[t]).map(|v| self.vertices[v][1]);
            let [low, high] = [points().fold(f64::MAX, f64::min), points().fold(f64::MIN, f64::max)];
            if high > near && (low + high).abs() <= near {
                shell.iter().for_each(|&t| is_astride[t] = true);
            }
        }
        [true, false].map(|wanted| {
            let chosen = self.corners().zip(&is_astride).filter(|(_, astride)| **astride == wanted);
            Self::from_corners(chosen.map(|(corners, _)| corners))
        })
    }

    /// What of a body this is, by where its parts that are not symmetric about the centreplane y = 0 lie beside it. Where these
    /// are the lesser ones it is whole.
    #[must_use]
    pub fn part(&self) -> BodyPart {
        let [both, rest] = self.astride();
        let extent = |mesh: &Self| mesh.bounds().map(|[low, high]| [high[0] - low[0], high[1].max(-low[1])]);
        let Some(main) = extent(&rest) else { return BodyPart::Whole };
        let is_lesser = extent(&both).is_some_and(|other| {
            let mut pairs = main.iter().zip(other);
            pairs.clone().any(|(own, other)| *own < other) || pairs.all(|(own, other)| *own <= (1.0 + ALIKE) * other)
        });
        if is_lesser { BodyPart::Whole } else { rest.side() }
    }

    fn side(&self) -> BodyPart {
        let Some([least, greatest]) = self.bounds() else { return BodyPart::Whole };
        let side = if least[1] + greatest[1] >= 0.0 { 1.0 } else { -1.0 };
        let [inner, outer] = [f64::min, f64::max].map(|pick| pick(side * least[1], side * greatest[1]));
        if outer <= 0.0 || inner.abs() > NEAR * outer {
            return BodyPart::Whole;
        }
        let near = |point: &[f64; 3]| (side * point[1] - inner).abs() <= NEAR * outer;
        // Areas as seen from the side, of what stands on the centreplane and of the rest.
        let (mut wall, mut skin) = (0.0, 0.0);
        for corners in self.corners() {
            let [a, b, c] = corners;
            let area = 0.5 * cross(minus(b, a), minus(c, a))[1].abs();
            if corners.iter().all(near) { wall += area } else { skin += area }
        }
        if wall > WALL * skin || self.open_edges().is_empty() {
            BodyPart::ClosedBeside
        } else {
            BodyPart::Half { inner }
        }
    }

    /// The whole of a body of which one side is given, but for parts that are symmetric about the centreplane: corners within `slack` \[m\] of the centreplane are put on it,
    /// triangles there are left out, the others mirrored.
    #[must_use]
    pub fn mirrored(&self, slack: f64) -> Self {
        let Some([least, greatest]) = self.bounds() else { return self.clone() };
        let slack = slack.max(CENTREPLANE * (0..3).map(|k| greatest[k] - least[k]).fold(0.0, f64::max));
        let [both, rest] = self.astride();
        let flat = |[x, y, z]: [f64; 3]| if y.abs() <= slack { [x, 0.0, z] } else { [x, y, z] };
        let half: Vec<[[f64; 3]; 3]> =
            rest.corners().map(|t| t.map(flat)).filter(|t| t.iter().any(|point| point[1].abs() > 0.0)).collect();
        let mirror = |[x, y, z]: [f64; 3]| [x, 0.0 - y, z];
        let other = half.iter().map(|&[a, b, c]| [mirror(a), mirror(c), mirror(b)]);
        Self::from_corners(half.iter().copied().chain(other).chain(both.corners()))
    }

    /// The section by the plane x = `x` (see the head), lines in the order of the triangles where they begin.
    #[must_use]
    pub fn section(&self, x: f64) -> Vec<MeshLine> {
        type EdgeKey = (usize, usize);
        let aft = |k: usize| self.vertices[k][0] < x;
        let mut lines: Vec<(EdgeKey, EdgeKey)> = Vec::new();
        for t in &self.triangles {
            let below = t.map(aft);
            if below == [true; 3] || below == [false; 3] {
                continue;
            }
            let (mut from, mut to) = ((0, 0), (0, 0));
            for k in 0..3 {
                let (p, q) = (t[k], t[(k + 1) % 3]);
                match (below[k], below[(k + 1) % 3]) {
                    (true, false) => from = (p.min(q), p.max(q)),
                    (false, true) => to = (p.min(q), p.max(q)),
                    _ => {}
                }
            }
            lines.push((from, to));
        }
        let mut begins: HashMap<EdgeKey, Vec<usize>> = HashMap::new();
        let mut ends: HashMap<EdgeKey, usize> = HashMap::new();
        for (k, (from, to)) in lines.iter().enumerate().rev() {
            begins.entry(*from).or_default().push(k);
            *ends.entry(*to).or_default() += 1;
        }
        let point = |(p, q): EdgeKey| {
            let (a, b) = (self.vertices[p], self.vertices[q]);
            let share = (x - a[0]) / (b[0] - a[0]);
            [a[1] + share * (b[1] - a[1]), a[2] + share * (b[2] - a[2])]
        };
        let mut used = vec![false; lines.len()];
        let mut found = Vec::new();
        // Lines with a loose end first, then the loops.
        for loose in [true, false] {
            for first in 0..lines.len() {
                if used[first] || (loose && ends.contains_key(&lines[first].0)) {
                    continue;
                }
                let mut edges = vec![lines[first].0];
                let mut at = first;
                loop {
                    used[at] = true;
                    edges.push(lines[at].1);
                    // What is used stays so, and is not looked at again.
                    let next = begins
                        .get_mut(&lines[at].1)
                        .and_then(|list| std::iter::from_fn(|| list.pop()).find(|&k| !used[k]));
                    match next {
                        Some(next) => at = next,
                        None => break,
                    }
                }
                let closed = edges.len() > 2 && edges[0] == edges[edges.len() - 1];
                if closed {
                    edges.pop();
                }
                let mut points: Vec<[f64; 2]> = edges.into_iter().map(point).collect();
                let same = |a: &[f64; 2], b: &[f64; 2]| a.map(f64::to_bits) == b.map(f64::to_bits);
                points.dedup_by(|a, b| same(a, b));
                while closed && points.len() > 1 && same(&points[0], &points[points.len() - 1]) {
                    points.pop();
                }
                if points.len() > 1 {
                    found.push(MeshLine { points, closed });
                }
            }
        }
        found
    }
}

impl MeshLine {
    /// The line without the points that its other points keep within `deviation` \[m\] (Ramer, Douglas and Peucker).
    #[must_use]
    pub fn thinned(&self, deviation: f64) -> Self {
        let mut points = self.points.clone();
        if self.closed {
            points.push(points[0]);
        }
        let mut kept = vec![false; points.len()];
        let last = points.len() - 1;
        (kept[0], kept[last]) = (true, true);
        // A loop begins and ends with its first point; the first cut is at the point farthest from it.
        let mut open = vec![(0, last)];
        while let Some((from, to)) = open.pop() {
            let (a, b) = (points[from], points[to]);
            let chord = [b[0] - a[0], b[1] - a[1]];
            let squared = chord[0] * chord[0] + chord[1] * chord[1];
            let off = |p: [f64; 2]| {
                let out = [p[0] - a[0], p[1] - a[1]];
                let share = if squared > 0.0 { (out[0] * chord[0] + out[1] * chord[1]) / squared } else { 0.0 };
                let share = share.clamp(0.0, 1.0);
                (out[0] - share * chord[0]).hypot(out[1] - share * chord[1])
            };
            let farthest = (from + 1..to).map(|k| (k, off(points[k]))).max_by(|p, q| p.1.total_cmp(&q.1));
            if let Some((k, distance)) = farthest
                && distance > deviation
            {
                kept[k] = true;
                open.extend([(from, k), (k, to)]);
            }
        }
        if self.closed {
            kept[last] = false;
        }
        let points = points.into_iter().zip(kept).filter(|(_, kept)| *kept).map(|(point, _)| point).collect();
        Self { points, closed: self.closed }
    }

    /// The area that a closed line encloses, and what an open one does with the centreplane, |int y dz| \[m^2\].
    #[must_use]
    pub fn area(&self) -> f64 {
        let pairs = self.points.windows(2).map(|pair| (pair[0], pair[1]));
        let last = self.closed.then(|| (self.points[self.points.len() - 1], self.points[0]));
        pairs.chain(last).map(|(a, b)| 0.5 * (a[0] + b[0]) * (b[1] - a[1])).sum::<f64>().abs()
    }
}

/// Twice the area of a triangle, as a vector along its normal.
pub(super) fn doubled(corners: [[f64; 3]; 3]) -> [f64; 3] {
    let [a, b, c] = corners;
    cross(minus(b, a), minus(c, a))
}

/// Area of a triangle \[m^2\].
#[must_use]
pub fn triangle_area(corners: [[f64; 3]; 3]) -> f64 {
    let normal = doubled(corners);
    0.5 * length(normal)
}

#[cfg(test)]
mod tests;
