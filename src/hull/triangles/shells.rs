//! Shells of a mesh inside others: tanks, decks and bulkheads add nothing to a body.
//!
//! A shell is what hangs together across edges of two triangles. Shells that close each other along their rims are one skin. A
//! point is inside another skin where this, with its openings covered, has a winding number of 1 about it. That is the sum of the solid angles of their triangles, over 4 pi.
//! On a smooth skin it is 1/2. With the corners a, b, c counted from the point, a solid angle is this (van Oosterom and
//! Strackee 1983).
//!
//! ```text
//! tan(omega / 2) = a.(b x c) / (|a||b||c| + a.b |c| + b.c |a| + c.a |b|)
//! ```

use super::boxes::{Bounds, around};
use super::rims::{CLOSING, Rims};
use super::{ONE, TriangleMesh, open_edges, triangle_area};

mod union;
mod winding;

use crate::spline::{cross, dot, length, minus};
use std::collections::{HashMap, HashSet};
use union::{Fate, Skin};

/// Shells of a mesh beyond which it is a heap of loose patches.
const SHELLS: usize = 4096;

/// What skins that only touch share, over what they enclose, at most.
const TOUCHING: f64 = 1e-7;

/// Shells have no area that is less than this part of the squared size of the body.
const NO_AREA: f64 = 1e-12;

/// What integrals over the skin of a union differ by at most, over what they are.
const CLOSED: f64 = 1e-4;

/// What shells of a mesh do inside others.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct InnerShells {
    /// Triangles of shells inside, which add nothing.
    pub inside: usize,
    /// Triangles of shells that reach into others, but for the largest of them.
    pub crossing: usize,
    /// Whether these only touch the others.
    pub touching: bool,
    /// Whether these are cut to the skin of the union. Otherwise what they share counts twice.
    pub united: bool,
    /// Whether the skin of their union was cut and is not closed.
    pub torn: bool,
    /// What all skins enclose together, each for itself \[m^3\]; 0 where none reach into others.
    pub sum: f64,
    /// Shells, where there are too many to be looked at.
    pub unseen: usize,
}

/// What an open sheet encloses with its openings covered, over the power 3/2 of its area.
const FLAT: f64 = 1e-3;

/// Most sheets of which each is looked at again.
const PUT_BACK: usize = 64;

/// Openings longer than this part of the body, from lower than this part of its height on, and of more than this part of its
/// area, are no decks.
const LONG: f64 = 0.2;
const LOW: f64 = 0.25;
const WIDE: f64 = 0.02;

/// An opening faces upward where this part of what covers it is level, and less than that part of it faces aside.
const LEVEL: f64 = 0.5;
const ASIDE: f64 = 0.02;

/// The rims of a slit differ in their ends by this part of their size at most, and their areas by that part.
const SLIT: f64 = 0.01;
const SLIT_TURN: f64 = 0.05;

/// Edges of an odd number of triangles, of which a closed body has none.
fn odd_edges(triangles: impl Iterator<Item = [usize; 3]>) -> usize {
    let mut odd = HashSet::new();
    for [a, b, c] in triangles {
        for (from, to) in [(a, b), (b, c), (c, a)] {
            let edge = (from.min(to), from.max(to));
            if !odd.remove(&edge) {
                odd.insert(edge);
            }
        }
    }
    odd.len()
}

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
        let skins = self.closed_skins(&shells);
        let counts = |skin: &Skin| skin.triangles.len();
        let Some(fates) = union::fates(&self, &skins) else {
            found.crossing = skins.iter().skip(1).map(counts).sum();
            found.sum = enclosed(self.corners());
            return (self, found);
        };
        let (mut reaching, mut before) = (Vec::new(), 0.0);
        for skin in &skins {
            if skin.triangles.iter().all(|&t| fates[t] == Fate::Within) {
                found.inside += counts(skin);
                continue;
            }
            before += enclosed(skin.triangles.iter().map(|&t| self.triangles[t].map(|v| self.vertices[v])));
            if skin.triangles.iter().any(|&t| fates[t] != Fate::Kept) {
                reaching.push(counts(skin));
            }
        }
        if let Some(largest) = reaching.first() {
            found.united = true;
            found.crossing = reaching[1..].iter().sum::<usize>();
            if found.crossing == 0 {
                found.crossing = *largest;
            }
            let pieces = self.corners().zip(&fates).flat_map(|(corners, fate)| match fate {
                Fate::Kept => vec![corners],
                Fate::Within => Vec::new(),
                Fate::Cut(pieces) => pieces.iter().flat_map(|p| (2..p.len()).map(|k| [p[0], p[k - 1], p[k]])).collect(),
            });
            let united = Self::from_corners(pieces);
            let after = enclosed(united.corners());
            found.sum = before;
            found.touching = (before - after).abs() <= TOUCHING * after.abs();
            let are_closed = skins.iter().all(|skin| skin.closed.len() == counts(skin));
            if are_closed && !(united.is_closed_by_integrals() && after <= (1.0 + CLOSED) * before) {
                found.united = false;
                found.torn = true;
                return (self, found);
            }
            return (united, found);
        }
        if found.inside > 0 {
            let mut kept = fates.iter().map(|fate| *fate == Fate::Kept);
            self.triangles.retain(|_| kept.next().unwrap_or(true));
        }
        (self, found)
    }

    /// The mesh without shells whose triangles have no area, such as faces over the edge of a body that has no breadth there.
    #[must_use]
    pub fn without_shells_of_no_area(self) -> Self {
        let Some([low, high]) = self.bounds() else { return self };
        let least = NO_AREA * dot(minus(high, low), minus(high, low));
        let shells = self.shells();
        let area = |shell: &Vec<usize>| -> f64 {
            shell.iter().map(|&t| triangle_area(self.triangles[t].map(|v| self.vertices[v]))).sum()
        };
        let counts: Vec<bool> = shells.iter().map(|shell| area(shell) > least).collect();
        if counts.iter().all(|counts| *counts) { self } else { self.of_shells(&shells, &counts) }
    }

    /// Whether the integrals of x dA_x, y dA_y and z dA_z over the skin are one volume, and its vector of area is none. So it
    /// is of a closed skin, also where its triangles do not meet edge to edge.
    #[must_use]
    pub fn is_closed_by_integrals(&self) -> bool {
        let Some([low, high]) = self.bounds() else { return true };
        let middle = [0, 1, 2].map(|k| 0.5 * (low[k] + high[k]));
        let (mut skin, mut turn, mut volumes) = (0.0, [0.0; 3], [0.0; 3]);
        for corners in self.corners() {
            let [a, b, c] = corners.map(|corner| minus(corner, middle));
            let area = cross(minus(b, a), minus(c, a)).map(|part| 0.5 * part);
            skin += length(area);
            for k in 0..3 {
                turn[k] += area[k];
                volumes[k] += area[k] * (a[k] + b[k] + c[k]) / 3.0;
            }
        }
        let [least, greatest] = [f64::min, f64::max].map(|pick| volumes.into_iter().fold(volumes[0], pick));
        length(turn) <= CLOSED * skin && greatest - least <= CLOSED * greatest.abs()
    }

    /// The skins that shells make together, with their openings covered, the largest first.
    fn closed_skins(&self, shells: &[Vec<usize>]) -> Vec<Skin> {
        let rims = Rims::of(self, shells, ONE);
        let joints = rims.joints(self).into_iter().map(|(pair, _)| pair);
        let skins = connected(shells.len(), joints);
        let skin = |parts: &Vec<usize>| {
            let triangles: Vec<usize> = parts.iter().flat_map(|&k| shells[k].iter().copied()).collect();
            let closed: Vec<[[f64; 3]; 3]> = parts.iter().flat_map(|&k| self.covered(&shells[k])).collect();
            let bounds = around(closed.iter().flatten().copied());
            Skin { triangles, closed, bounds }
        };
        let mut skins: Vec<Skin> = skins.iter().map(skin).collect();
        let size = |skin: &Skin| (0..3).map(|k| skin.bounds[1][k] - skin.bounds[0][k]).product::<f64>();
        skins.sort_by(|a, b| size(b).total_cmp(&size(a)));
        skins
    }

    /// Edges of an odd number of triangles, of which a closed body has none.
    #[must_use]
    pub fn odd_edges(&self) -> usize {
        odd_edges(self.triangles.iter().copied())
    }

    /// The mesh with one of the triangles that have the same three vertices, and how many are left out. What closed shells have
    /// in common is of each of them, and nothing is left out where more edges would be open for it.
    #[must_use]
    pub fn without_doubles(mut self) -> (Self, usize) {
        let sorted = |&t: &usize| {
            let mut triangle = self.triangles[t];
            triangle.sort_unstable();
            triangle
        };
        let neighbours = self.neighbours();
        let mut known = HashSet::with_capacity(self.triangles.len());
        let mut left_out = vec![false; self.triangles.len()];
        for shell in self.shells() {
            let is_known = shell.iter().all(|t| known.contains(&sorted(t)));
            let is_closed = shell.iter().all(|&t| neighbours[t].iter().all(Option::is_some));
            for t in shell {
                left_out[t] = !known.insert(sorted(&t)) && (is_known || !is_closed);
            }
        }
        let count = left_out.iter().filter(|out| **out).count();
        let single = self.triangles.iter().zip(&left_out).filter(|(_, out)| !**out).map(|(triangle, _)| *triangle);
        if count > 0 && odd_edges(single) > self.odd_edges() {
            return (self, 0);
        }
        let mut out = left_out.into_iter();
        self.triangles.retain(|_| !out.next().unwrap_or(false));
        (self, count)
    }

    /// The mesh without open sheets beside its body, such as bilge keels and bulkheads: flat shells most of whose rims close
    /// nothing; and how many triangles they have. The sheet that closes least is left out first, of several the innermost.
    #[must_use]
    pub fn without_sheets(self) -> (Self, usize) {
        let shells = self.shells();
        let Some(bounds) = self.bounds().filter(|_| shells.len() > 1) else { return (self, 0) };
        let rims = Rims::of(&self, &shells, ONE);
        let is_flat = |k: usize| {
            let corners = self.covered(&shells[k]);
            let enclosed: f64 = corners.iter().map(|[a, b, c]| dot(*a, cross(*b, *c)) / 6.0).sum();
            let area: f64 = shells[k].iter().map(|&t| triangle_area(self.triangles[t].map(|v| self.vertices[v]))).sum();
            enclosed.abs() < FLAT * area.powf(1.5)
        };
        let innermost = |k: usize| {
            let points = shells[k].iter().flat_map(|&t| self.triangles[t]).map(|v| self.vertices[v]);
            let middle = mean(points, 3 * shells[k].len());
            (0..3)
                .map(|axis| (middle[axis] - bounds[0][axis]).min(bounds[1][axis] - middle[axis]))
                .fold(f64::MAX, f64::min)
        };
        let mut counts = vec![true; shells.len()];
        let mut sheets: HashMap<usize, (f64, f64)> = (0..shells.len())
            .filter(|&k| rims.is_open(k) && is_flat(k))
            .map(|k| (k, (rims.closing(k, &counts), -innermost(k))))
            .collect();
        let order = |a: &(&usize, &(f64, f64)), b: &(&usize, &(f64, f64))| {
            a.1.0.total_cmp(&b.1.0).then(a.1.1.total_cmp(&b.1.1)).then(a.0.cmp(b.0))
        };
        while let Some(least) = sheets.iter().min_by(order).filter(|(_, (part, _))| *part < CLOSING).map(|(k, _)| *k) {
            sheets.remove(&least);
            counts[least] = false;
            for other in rims.beside(least) {
                if let Some((part, _)) = sheets.get_mut(&other) {
                    *part = rims.closing(other, &counts);
                }
            }
        }
        self.put_back(&shells, &mut counts);
        let sheets: usize = shells.iter().zip(&counts).filter(|(_, kept)| !**kept).map(|(shell, _)| shell.len()).sum();
        if sheets == 0 || sheets == self.triangles.len() {
            return (self, 0);
        }
        (self.of_shells(&shells, &counts), sheets)
    }

    /// Takes back those shells without which more of the skin is open than with them: plates beside the skin that nearly
    /// close it.
    fn put_back(&self, shells: &[Vec<usize>], counts: &mut [bool]) {
        let sheets: Vec<usize> = (0..shells.len()).filter(|&k| !counts[k]).collect();
        let mut open = self.of_shells(shells, counts).open_area();
        if sheets.is_empty() || sheets.len() > PUT_BACK || open <= self.open_area() {
            return;
        }
        for sheet in sheets {
            counts[sheet] = true;
            let with = self.of_shells(shells, counts).open_area();
            if with < open {
                open = with;
            } else {
                counts[sheet] = false;
            }
        }
    }

    /// The shells that count.
    fn of_shells(&self, shells: &[Vec<usize>], counts: &[bool]) -> Self {
        let mut out = vec![true; self.triangles.len()];
        shells.iter().zip(counts).filter(|(_, kept)| **kept).flat_map(|(shell, _)| shell).for_each(|&t| out[t] = false);
        Self::from_corners(self.corners().zip(out).filter(|(_, out)| !out).map(|(t, _)| t))
    }

    /// The greatest opening of the skin along the ship and below the deck: its area over that of the skin, and its least and
    /// greatest corner \[m\]. Openings in planes x = constant are transoms and bows, those at the centreplane are seams.
    #[must_use]
    pub fn hole(&self) -> Option<(f64, [[f64; 3]; 2])> {
        let [least, greatest] = self.bounds()?;
        let extent = minus(greatest, least);
        let open = self.openings(ONE);
        let skin: f64 = self.corners().map(triangle_area).sum();
        let turn = |edges: &[usize]| {
            let middle = mean(edges.iter().map(|&k| self.vertices[open[k][0]]), edges.len());
            edges.iter().map(|&k| open[k]).fold([0.0; 3], |sum, [p, q]| {
                let area = cross(minus(self.vertices[q], middle), minus(self.vertices[p], middle));
                [0, 1, 2].map(|axis| sum[axis] + area[axis])
            })
        };
        let bounds = |edges: &[usize]| around(edges.iter().flat_map(|&k| open[k]).map(|vertex| self.vertices[vertex]));
        let chains = chains(&open);
        // A slit has two rims, which run around one place in opposite directions.
        let rims: Vec<([f64; 3], Bounds)> = chains.iter().map(|edges| (turn(edges), bounds(edges))).collect();
        let is_slit = |own: usize| {
            let (turn, [low, high]) = rims[own];
            let size = length(minus(high, low));
            rims.iter().enumerate().any(|(k, (other, ends))| {
                let off = length(minus(low, ends[0])).max(length(minus(high, ends[1])));
                let rest = [0, 1, 2].map(|axis| turn[axis] + other[axis]);
                k != own && off <= SLIT * size && length(rest) <= SLIT_TURN * length(turn)
            })
        };
        let hole = |(own, edges): (usize, &Vec<usize>)| {
            let (turn, bounds) = rims[own];
            let middle = mean(edges.iter().map(|&k| self.vertices[open[k][0]]), edges.len());
            let area: f64 = edges
                .iter()
                .map(|&k| triangle_area([self.vertices[open[k][0]], self.vertices[open[k][1]], middle]))
                .sum();
            // With a transom that is missing too, a deck is open down to the keel.
            let is_deck = turn[2] > LEVEL * length(turn) && turn[1].abs() < ASIDE * length(turn);
            let is_long = bounds[1][0] - bounds[0][0] > LONG * extent[0];
            let is_low = bounds[0][2] - least[2] < LOW * extent[2];
            (is_long && is_low && !is_deck && area > WIDE * skin && !is_slit(own)).then_some((area / skin, bounds))
        };
        chains.iter().enumerate().filter_map(hole).max_by(|a, b| a.0.total_cmp(&b.0))
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
        let openings = chains(&open);
        let fans = openings.iter().flat_map(|edges| {
            let first = edges.iter().map(|&k| self.vertices[open[k][0]]);
            let middle = mean(first, edges.len());
            edges.iter().map(|&k| open[k]).map(move |[p, q]| [self.vertices[q], self.vertices[p], middle])
        });
        triangles.map(|t| t.map(|v| self.vertices[v])).chain(fans).collect()
    }
}

/// The integral of y over the y of the area vectors, which a deck adds nothing to \[m^3\].
pub(super) fn enclosed(triangles: impl Iterator<Item = [[f64; 3]; 3]>) -> f64 {
    triangles.map(|[a, b, c]| cross(minus(b, a), minus(c, a))[1] * (a[1] + b[1] + c[1]) / 6.0).sum()
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
pub(super) fn connected(count: usize, pairs: impl Iterator<Item = [usize; 2]>) -> Vec<Vec<usize>> {
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

/// Edges that hang together at their ends, by their places in the list.
pub(super) fn chains(edges: &[[usize; 2]]) -> Vec<Vec<usize>> {
    let mut at = HashMap::new();
    let ends = edges.iter().enumerate().flat_map(|(k, edge)| edge.map(|vertex| (k, vertex)));
    connected(edges.len(), ends.map(|(k, vertex)| [k, *at.entry(vertex).or_insert(k)]))
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
    use std::f64::consts::PI;

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
        for by in [[5.0, 0.0, 0.0], [4.0, 2.0, 0.0]] {
            let both = with(&[(by, 1.0)]);
            assert_eq!(both.clone().without_inner_shells(), (both, InnerShells::default()), "{by:?}");
        }
        let (mesh, found) = with(&[([0.0; 3], 1.0)]).without_inner_shells();
        assert_eq!((mesh, found), (brick(), InnerShells { inside: 12, ..InnerShells::default() }));
        // The two walls that they have in common are inside, and what others share of theirs.
        let touching =
            |sum: f64| InnerShells { crossing: 12, touching: true, united: true, sum, ..InnerShells::default() };
        for by in [[4.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 2.0]] {
            let (mesh, found) = with(&[(by, 1.0)]).without_inner_shells();
            assert_eq!((mesh.triangles.len(), found), (20, touching(found.sum)), "{by:?}");
        }
        let (mesh, found) = with(&[([4.0, 0.5, 0.1], 1.0)]).without_inner_shells();
        let area = |mesh: &TriangleMesh| mesh.corners().map(triangle_area).sum::<f64>();
        let shared = 2.0 * 1.5 * 1.9;
        assert!(
            (area(&mesh) - 2.0 * area(&brick()) + shared).abs() < 1e-9 && found == touching(found.sum),
            "{found:?}"
        );
    }

    #[test]
    fn shells_that_reach_into_another_are_named() {
        // A skeg whose top is inside, and which has the middles of triangles of the bottom inside.
        let (mesh, found) = with(&[([1.0, 0.0, -0.8], 0.5)]).without_inner_shells();
        assert_eq!((found.inside, found.crossing, found.united, found.touching), (0, 12, true, false));
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
