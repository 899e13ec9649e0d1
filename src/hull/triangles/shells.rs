//! Shells of a mesh inside others: tanks, decks and bulkheads add nothing to a body.
//!
//! A shell is what hangs together across edges of two triangles. A point is inside the other shells where these, with their
//! openings covered, have a winding number of 1 about it. That is the sum of the solid angles of their triangles, over 4 pi.
//! On a smooth skin it is 1/2. With the corners a, b, c counted from the point, a solid angle is this (van Oosterom and
//! Strackee 1983).
//!
//! ```text
//! tan(omega / 2) = a.(b x c) / (|a||b||c| + a.b |c| + b.c |a| + c.a |b|)
//! ```

use super::{TriangleMesh, open_edges, triangle_area};

mod union;

use crate::spline::{cross, dot, length, minus};
use std::collections::{HashMap, HashSet};
use std::f64::consts::PI;

/// The winding number from which a point is inside, between that of the skin and that of the inside.
const INSIDE: f64 = 0.75;

/// Shells of a mesh beyond which it is a heap of loose patches.
const SHELLS: usize = 4096;

/// Triangles of a shell at which it is looked at, at most and at least.
const SAMPLES: [usize; 2] = [24, 4];

/// Solid angles that are computed, about.
const ANGLES: usize = 20_000_000;

/// What shells of a mesh do inside others.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct InnerShells {
    /// Triangles of shells inside, which add nothing.
    pub inside: usize,
    /// Triangles of shells that reach into others.
    pub crossing: usize,
    /// Whether these are cut to the skin of the union. Otherwise what they share counts twice.
    pub united: bool,
    /// Shells, where there are too many to be looked at.
    pub unseen: usize,
}

/// What an open sheet encloses with its openings covered, over the power 3/2 of its area.
const FLAT: f64 = 1e-3;

/// Part of the edges of a sheet that may lie in an opening of the other shells.
const CLOSING: f64 = 0.5;

/// Openings longer than this part of the body, from lower than this part of its height on, and of more than this part of its
/// area, are no decks.
const LONG: f64 = 0.2;
const LOW: f64 = 0.25;
const WIDE: f64 = 0.02;

/// Vertices nearer than this part of the size of the body are one.
const ONE: f64 = 1e-4;

impl TriangleMesh {
    /// The mesh without the shells inside others, and what was found. The triangles face outward.
    #[must_use]
    pub fn without_inner_shells(mut self) -> (Self, InnerShells) {
        let shells = self.shells();
        let mut found = InnerShells::default();
        if !(2..=SHELLS).contains(&shells.len()) {
            found.unseen = if shells.len() > SHELLS { shells.len() } else { 0 };
            return (self, found);
        }
        let closed: Vec<Vec<[[f64; 3]; 3]>> = shells.iter().map(|shell| self.covered(shell)).collect();
        let [most, least] = SAMPLES;
        let samples = (ANGLES / (self.triangles.len() * shells.len().min(64))).clamp(least, most);
        let bounds: Vec<[[f64; 3]; 2]> = closed.iter().map(|shell| union::bounds(shell)).collect();
        let mut inside = vec![false; self.triangles.len()];
        for (k, shell) in shells.iter().enumerate() {
            let looked_at = shell.iter().step_by(shell.len().div_ceil(samples));
            let is_inside = |&t: &usize| {
                let middle = mean(self.triangles[t].into_iter().map(|v| self.vertices[v]), 3);
                // About a point outside its bounds a closed shell does not wind.
                let holds = |other: &usize| {
                    let [low, high] = bounds[*other];
                    *other != k && (0..3).all(|axis| (low[axis]..=high[axis]).contains(&middle[axis]))
                };
                let others = (0..closed.len()).filter(holds).flat_map(|other| &closed[other]);
                others.map(|corners| solid_angle(corners.map(|corner| minus(corner, middle)))).sum::<f64>()
                    > INSIDE * 4.0 * PI
            };
            let looked: Vec<bool> = looked_at.map(is_inside).collect();
            if looked.iter().all(|inside| *inside) {
                shell.iter().for_each(|&t| inside[t] = true);
                found.inside += shell.len();
            } else if looked.contains(&true) {
                found.crossing += shell.len();
            }
        }
        if found.crossing > 0
            && let Some(united) = union::united(&self, &shells, &closed)
        {
            found.united = true;
            return (united, found);
        }
        let mut kept = inside.iter().map(|inside| !inside);
        self.triangles.retain(|_| kept.next().unwrap_or(true));
        (self, found)
    }

    /// The mesh with one of the triangles that have the same three vertices, and how many are left out.
    #[must_use]
    pub fn without_doubles(mut self) -> (Self, usize) {
        let before = self.triangles.len();
        let mut known = HashSet::with_capacity(before);
        self.triangles.retain(|triangle| {
            let mut sorted = *triangle;
            sorted.sort_unstable();
            known.insert(sorted)
        });
        let left_out = before - self.triangles.len();
        (self, left_out)
    }

    /// The mesh without open sheets beside its body, such as bilge keels: flat shells whose edges do not lie in the openings of
    /// the others; and how many triangles they have.
    #[must_use]
    pub fn without_sheets(mut self) -> (Self, usize) {
        let shells = self.shells();
        let Some(size) = self.bounds().map(|[least, greatest]| length(minus(greatest, least))) else {
            return (self, 0);
        };
        let open: Vec<Vec<[usize; 2]>> =
            shells.iter().map(|shell| open_edges(shell.iter().map(|&t| self.triangles[t]))).collect();
        let is_flat = |k: usize| {
            let corners = self.covered(&shells[k]);
            let enclosed: f64 = corners.iter().map(|[a, b, c]| dot(*a, cross(*b, *c)) / 6.0).sum();
            let area: f64 = shells[k].iter().map(|&t| triangle_area(self.triangles[t].map(|v| self.vertices[v]))).sum();
            enclosed.abs() < FLAT * area.powf(1.5)
        };
        let sheets: Vec<usize> = (0..shells.len()).filter(|&k| !open[k].is_empty() && is_flat(k)).collect();
        if sheets.is_empty() || sheets.len() == shells.len() {
            return (self, 0);
        }
        // Places of the vertices of openings of the other shells, which close each other where a sheet is between them.
        let key = |vertex: usize| self.vertices[vertex].map(|c| (c / (ONE * size)).round() as i64);
        let is_sheet = |k: &usize| sheets.contains(k);
        let others = (0..shells.len()).filter(|k| !is_sheet(k)).flat_map(|k| &shells[k]);
        let openings = open_edges(others.map(|&t| self.triangles[t]));
        let openings: HashSet<[i64; 3]> = openings.into_iter().flatten().map(key).collect();
        let mut left_out = vec![false; self.triangles.len()];
        for &k in &sheets {
            let closing =
                open[k].iter().filter(|edge| edge.iter().all(|&vertex| openings.contains(&key(vertex)))).count();
            if (closing as f64) < CLOSING * open[k].len() as f64 {
                shells[k].iter().for_each(|&t| left_out[t] = true);
            }
        }
        let count = left_out.iter().filter(|out| **out).count();
        let mut out = left_out.into_iter();
        self.triangles.retain(|_| !out.next().unwrap_or(false));
        let kept: Vec<[[f64; 3]; 3]> = self.corners().collect();
        (if count > 0 { Self::from_corners(kept.into_iter()) } else { self }, count)
    }

    /// The greatest opening of the skin along the ship and below the deck: its area over that of the skin, and its least and
    /// greatest corner \[m\]. Openings in planes x = constant are transoms and bows, those at the centreplane are seams.
    #[must_use]
    pub fn hole(&self) -> Option<(f64, [[f64; 3]; 2])> {
        let [least, greatest] = self.bounds()?;
        let extent = minus(greatest, least);
        let open = self.open_edges();
        let mut at = HashMap::new();
        let ends = open.iter().enumerate().flat_map(|(k, edge)| edge.map(|vertex| (k, vertex)));
        let pairs: Vec<[usize; 2]> = ends.map(|(k, vertex)| [k, *at.entry(vertex).or_insert(k)]).collect();
        let skin: f64 = self.corners().map(triangle_area).sum();
        let hole = |edges: &Vec<usize>| {
            let points = || edges.iter().flat_map(|&k| open[k]).map(|vertex| self.vertices[vertex]);
            let first = points().next()?;
            let fold = |pick: fn(f64, f64) -> f64| {
                points().fold(first, |ends, point| [0, 1, 2].map(|k| pick(ends[k], point[k])))
            };
            let bounds = [fold(f64::min), fold(f64::max)];
            let middle = mean(edges.iter().map(|&k| self.vertices[open[k][0]]), edges.len());
            let area: f64 = edges
                .iter()
                .map(|&k| triangle_area([self.vertices[open[k][0]], self.vertices[open[k][1]], middle]))
                .sum();
            let is_long = bounds[1][0] - bounds[0][0] > LONG * extent[0];
            let is_low = bounds[0][2] - least[2] < LOW * extent[2];
            (is_long && is_low && area > WIDE * skin).then_some((area / skin, bounds))
        };
        let holes = connected(open.len(), pairs.into_iter());
        holes.iter().filter_map(hole).max_by(|a, b| a.0.total_cmp(&b.0))
    }

    /// The shells, those with the largest boxes around them first.
    #[must_use]
    pub fn parts(&self) -> Vec<Self> {
        let part =
            |shell: &Vec<usize>| Self::from_corners(shell.iter().map(|&t| self.triangles[t].map(|v| self.vertices[v])));
        let size = |mesh: &Self| mesh.bounds().map_or(0.0, |[low, high]| (0..3).map(|k| high[k] - low[k]).product());
        let mut parts: Vec<(f64, Self)> = self.shells().iter().map(part).map(|mesh| (size(&mesh), mesh)).collect();
        parts.sort_by(|a, b| b.0.total_cmp(&a.0));
        parts.into_iter().map(|(_, mesh)| mesh).collect()
    }

    /// Triangles that hang together across edges of two.
    pub(super) fn shells(&self) -> Vec<Vec<usize>> {
        let neighbours = self.neighbours();
        let beside = neighbours.iter().enumerate();
        let pairs = beside.flat_map(|(k, others)| others.iter().flatten().map(move |(other, _)| [k, *other]));
        connected(neighbours.len(), pairs)
    }

    /// The corners of a shell, with a fan from the middle of each opening to its edges.
    fn covered(&self, shell: &[usize]) -> Vec<[[f64; 3]; 3]> {
        let triangles = shell.iter().map(|&t| self.triangles[t]);
        let open = open_edges(triangles.clone());
        let mut at = HashMap::new();
        let ends = open.iter().enumerate().flat_map(|(k, edge)| edge.map(|vertex| (k, vertex)));
        let pairs = ends.map(|(k, vertex)| [k, *at.entry(vertex).or_insert(k)]);
        let openings = connected(open.len(), pairs);
        let fans = openings.iter().flat_map(|edges| {
            let first = edges.iter().map(|&k| self.vertices[open[k][0]]);
            let middle = mean(first, edges.len());
            edges.iter().map(|&k| open[k]).map(move |[p, q]| [self.vertices[q], self.vertices[p], middle])
        });
        triangles.map(|t| t.map(|v| self.vertices[v])).chain(fans).collect()
    }
}

/// The mean of `count` points.
fn mean(points: impl Iterator<Item = [f64; 3]>, count: usize) -> [f64; 3] {
    let sum = points.fold([0.0; 3], |sum, point| std::array::from_fn(|axis| sum[axis] + point[axis]));
    sum.map(|sum| sum / count as f64)
}

/// The first of the part of k.
fn root(parents: &mut [usize], mut k: usize) -> usize {
    while parents[k] != k {
        parents[k] = parents[parents[k]];
        k = parents[k];
    }
    k
}

/// Parts of `count` things that pairs of them connect, each rising, in the order of their first.
fn connected(count: usize, pairs: impl Iterator<Item = [usize; 2]>) -> Vec<Vec<usize>> {
    let mut parents: Vec<usize> = (0..count).collect();
    for [a, b] in pairs {
        let [a, b] = [root(&mut parents, a), root(&mut parents, b)];
        parents[a.max(b)] = a.min(b);
    }
    let mut parts: Vec<Vec<usize>> = vec![Vec::new(); count];
    for k in 0..count {
        parts[root(&mut parents, k)].push(k);
    }
    parts.retain(|part| !part.is_empty());
    parts
}

/// The solid angle of a triangle seen from the origin; 0 where that is in its plane.
pub(super) fn solid_angle([a, b, c]: [[f64; 3]; 3]) -> f64 {
    let [la, lb, lc] = [a, b, c].map(length);
    let volume = dot(a, cross(b, c));
    if volume.abs() <= 1e-12 * la * lb * lc {
        return 0.0;
    }
    2.0 * volume.atan2(la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb)
}

#[cfg(test)]
mod tests {
    use super::super::tests::brick;
    use super::*;

    /// A brick with others, each moved and scaled about the origin.
    fn with(others: &[([f64; 3], f64)]) -> TriangleMesh {
        let moved = others.iter().flat_map(|&(by, scale)| {
            let place = move |corner: [f64; 3]| std::array::from_fn(|axis| by[axis] + scale * corner[axis]);
            brick().corners().map(move |corners| corners.map(place)).collect::<Vec<_>>()
        });
        TriangleMesh::from_corners(brick().corners().chain(moved).collect::<Vec<_>>().into_iter())
    }

    #[test]
    fn a_triangle_seen_from_a_corner_of_a_cube_is_an_octant() {
        let unit = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        assert!((solid_angle(unit) - 0.5 * PI).abs() < 1e-14);
    }

    #[test]
    fn shells_inside_are_left_out() {
        let (mesh, found) = with(&[([1.0, 0.0, 0.5], 0.25), ([2.5, 0.3, 1.0], 0.1)]).without_inner_shells();
        assert_eq!((mesh.triangles.len(), found), (12, InnerShells { inside: 24, ..InnerShells::default() }));
    }

    #[test]
    fn triangles_given_twice_are_one() {
        let twice: Vec<_> = brick().corners().chain(brick().corners().map(|[a, b, c]| [a, c, b])).collect();
        let (mesh, left_out) = TriangleMesh::from_corners(twice.into_iter()).without_doubles();
        assert_eq!((mesh.triangles, left_out), (brick().triangles, 12));
    }

    #[test]
    fn sheets_beside_a_body_are_left_out_and_lids_are_not() {
        let (low, high) = ([0.5, 1.5, 0.5], [3.0, 1.5, 0.5]);
        let keel = [[low, high, [3.0, 2.0, 0.2]], [low, [3.0, 2.0, 0.2], [0.5, 2.0, 0.2]]];
        let with: Vec<_> = brick().corners().chain(keel).collect();
        let (mesh, left_out) = TriangleMesh::from_corners(with.into_iter()).without_sheets();
        assert_eq!((mesh.triangles.len(), left_out), (12, 2));
        // A lid with vertices of its own, a little off.
        let top = |t: &[[f64; 3]; 3]| t.iter().all(|corner| corner[2] > 1.9);
        let body = brick();
        let lid = body.corners().filter(top).map(|t| t.map(|[x, y, z]| [x, y, z + 1e-6]));
        let parts: Vec<_> = body.corners().filter(|t| !top(t)).chain(lid).collect();
        let parts = TriangleMesh::from_corners(parts.into_iter());
        assert_eq!(parts.clone().without_sheets(), (parts, 0));
    }

    #[test]
    fn a_side_that_is_missing_is_a_hole_and_a_deck_is_none() {
        let without = |axis: usize, greatest: bool| {
            let [least, most] = brick().bounds().unwrap();
            let value = if greatest { most[axis] } else { least[axis] };
            let kept: Vec<_> = brick().corners().filter(|t| t.iter().any(|c| (c[axis] - value).abs() > 1e-9)).collect();
            TriangleMesh::from_corners(kept.into_iter()).hole().map(|(share, _)| share > 0.1)
        };
        assert_eq!(
            [without(1, true), without(2, false), without(2, true), without(0, true)],
            [Some(true), Some(true), None, None]
        );
    }

    #[test]
    fn shells_beside_each_other_stay() {
        for by in [[5.0, 0.0, 0.0], [4.0, 2.0, 0.0], [4.0, 0.5, 0.1], [0.0; 3]] {
            let both = with(&[(by, 1.0)]);
            assert_eq!(both.clone().without_inner_shells(), (both, InnerShells::default()), "{by:?}");
        }
        // The two walls that they have in common are inside.
        for by in [[4.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 2.0]] {
            let (mesh, found) = with(&[(by, 1.0)]).without_inner_shells();
            assert_eq!(
                (mesh.triangles.len(), found),
                (20, InnerShells { inside: 4, ..InnerShells::default() }),
                "{by:?}"
            );
        }
    }

    #[test]
    fn shells_that_reach_into_another_are_named() {
        // A skeg whose top is inside, and which has the middles of triangles of the bottom inside.
        let (mesh, found) = with(&[([1.0, 0.0, -0.8], 0.5)]).without_inner_shells();
        assert_eq!((found.inside, found.crossing, found.united), (0, 24, true));
        assert!(mesh.triangles.len() > 24);
    }

    #[test]
    fn a_tank_in_a_hull_without_a_deck_is_inside() {
        let open = |corners: &[[f64; 3]; 3]| corners.iter().any(|corner| corner[2] < 2.0);
        let hull = brick();
        let tank = hull.corners().map(|t| t.map(|[x, y, z]| [1.0 + 0.5 * x, 0.9 * y, 0.1 + 0.9 * z]));
        let corners: Vec<_> = hull.corners().filter(open).chain(tank).collect();
        let (mesh, found) = TriangleMesh::from_corners(corners.into_iter()).without_inner_shells();
        assert_eq!((mesh.triangles.len(), found.inside), (10, 12));
    }
}
