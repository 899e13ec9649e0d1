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

use super::{TriangleMesh, open_edges};
use crate::spline::{cross, dot, length, minus};
use std::collections::HashMap;
use std::f64::consts::PI;

/// The winding number from which a point is inside, between that of the skin and that of the inside.
const INSIDE: f64 = 0.75;

/// Shells of a mesh beyond which it is a heap of loose patches.
const SHELLS: usize = 64;

/// Triangles of a shell at which it is looked at, at most and at least.
const SAMPLES: [usize; 2] = [24, 4];

/// Solid angles that are computed, about.
const ANGLES: usize = 20_000_000;

/// What shells of a mesh do inside others.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct InnerShells {
    /// Triangles of shells inside, which add nothing.
    pub inside: usize,
    /// Triangles of shells that reach into others; what they share counts twice.
    pub crossing: usize,
}

impl TriangleMesh {
    /// The mesh without the shells inside others, and what was found. The triangles face outward.
    #[must_use]
    pub fn without_inner_shells(mut self) -> (Self, InnerShells) {
        let shells = self.shells();
        let mut found = InnerShells::default();
        if !(2..=SHELLS).contains(&shells.len()) {
            return (self, found);
        }
        let closed: Vec<Vec<[[f64; 3]; 3]>> = shells.iter().map(|shell| self.covered(shell)).collect();
        let [most, least] = SAMPLES;
        let samples = (ANGLES / (self.triangles.len() * shells.len())).clamp(least, most);
        let mut inside = vec![false; self.triangles.len()];
        for (k, shell) in shells.iter().enumerate() {
            let others = || closed.iter().enumerate().filter(|(other, _)| *other != k).flat_map(|(_, shell)| shell);
            let looked_at = shell.iter().step_by(shell.len().div_ceil(samples));
            let is_inside = |&t: &usize| {
                let middle = mean(self.triangles[t].into_iter().map(|v| self.vertices[v]), 3);
                others().map(|corners| solid_angle(corners.map(|corner| minus(corner, middle)))).sum::<f64>()
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
        let mut kept = inside.iter().map(|inside| !inside);
        self.triangles.retain(|_| kept.next().unwrap_or(true));
        (self, found)
    }

    /// Triangles that hang together across edges of two.
    fn shells(&self) -> Vec<Vec<usize>> {
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
fn solid_angle([a, b, c]: [[f64; 3]; 3]) -> f64 {
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
        assert_eq!((mesh.triangles.len(), found), (12, InnerShells { inside: 24, crossing: 0 }));
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
            assert_eq!((mesh.triangles.len(), found), (20, InnerShells { inside: 4, crossing: 0 }), "{by:?}");
        }
    }

    #[test]
    fn shells_that_reach_into_another_are_named() {
        // A skeg whose top is inside, and which has the middles of triangles of the bottom inside.
        let (mesh, found) = with(&[([1.0, 0.0, -0.8], 0.5)]).without_inner_shells();
        assert_eq!((mesh.triangles.len(), found.inside, found.crossing), (24, 0, 24));
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
