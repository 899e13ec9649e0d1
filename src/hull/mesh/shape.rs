//! Triangles of a good shape: lengths of edges as the curvature asks, and no angle below a bound but where the body has
//! a sharper corner.
//!
//! The wanted length of edges is sqrt(5 d / k) with the deviation d and the largest principal curvature k, at most the
//! half-breadth of a closing face beside it, and grows by at most a part of the distance. Edges are split, flipped and
//! collapsed to it, vertices moved to the middle of their neighbours (Botsch and Kobbelt 2004); then each triangle with
//! an angle that is too small is taken by itself: an edge is flipped, a short one collapsed, a vertex moved, or the
//! longest edge of those that follow from it is split (Rivara 1997), the first that makes it better. Where a few are
//! left that nothing helps, they may be off by the whole tolerance, vertices are moved towards each of their
//! neighbours, and edges on the way to the longest are split. The number of passes is bounded, so that it always ends.

use super::half::{Half, least_sine};
use super::{LEAST_ANGLE, Region};
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Edges longer than this many of their wanted lengths are split, and those shorter than this many are collapsed.
const LONG: f64 = 4.0 / 3.0;
const SHORT: f64 = 0.7;

/// How fast wanted lengths grow with the distance.
const GROWTH: f64 = 0.35;

/// Rounds of splitting, flipping, collapsing and moving.
const ROUNDS: usize = 2;

/// Passes over the triangles with angles that are too small.
const PASSES: usize = 16;

/// Where so few are left, every means is tried in this many passes.
const FEW: usize = 32;
const LAST_PASSES: usize = 40;

/// The first of these in which vertices are taken out wherever that helps.
const FREE: usize = 4;

/// Passes after which nothing more is tried where there are not fewer such triangles.
const PATIENCE: usize = 3;

/// Angles that are aimed at, over those that are promised.
const MARGIN: f64 = 1.05;

/// Sine of the least angle that is aimed at.
fn aim() -> f64 {
    (MARGIN * LEAST_ANGLE).sin()
}

/// Triangles that may be added to any mesh.
const SPARE: usize = 5_000;

/// Rounds of splitting what leaves the surface by too much.
const FOLLOWED: usize = 4;

/// Steps from a triangle over the longest edges of its neighbours.
const STEPS: usize = 40;

impl Half<'_> {
    /// Edges, each once, in the order of their triangles.
    fn edges(&self) -> Vec<[usize; 2]> {
        let mut list = Vec::with_capacity(3 * self.faces.len() / 2);
        for (f, face) in self.faces.iter().enumerate() {
            let Some((_, corners)) = face else { continue };
            for k in 0..3 {
                let (a, b) = (corners[k], corners[(k + 1) % 3]);
                let ([p, q], count) = self.beside(a, b);
                if count == 1 || f == p.min(q) {
                    list.push([a, b]);
                }
            }
        }
        list
    }

    /// Lets wanted lengths grow by no more than a part of the distance.
    pub(super) fn grade(&mut self) {
        let mut heap: BinaryHeap<Reverse<(u64, usize)>> = self
            .sizes
            .iter()
            .enumerate()
            .filter(|(_, size)| size.is_finite())
            .map(|(v, size)| Reverse((size.to_bits(), v)))
            .collect();
        while let Some(Reverse((bits, v))) = heap.pop() {
            let size = f64::from_bits(bits);
            if size > self.sizes[v] {
                continue;
            }
            for other in self.ring(v) {
                let most = size + GROWTH * self.distance(v, other);
                if most < self.sizes[other] {
                    self.sizes[other] = most;
                    heap.push(Reverse((most.to_bits(), other)));
                }
            }
        }
    }

    fn split_long(&mut self, most: usize) {
        let mut list: BinaryHeap<(u64, Reverse<[usize; 2]>)> = BinaryHeap::new();
        let key = |half: &Self, [a, b]: [usize; 2]| half.relative_length(a, b);
        for edge in self.edges() {
            let long = key(self, edge);
            if long > LONG {
                list.push((long.to_bits(), Reverse(edge)));
            }
        }
        for _ in 0..most {
            let Some((_, Reverse([a, b]))) = list.pop() else { return };
            if self.beside(a, b).1 == 0 {
                continue;
            }
            let Some(middle) = self.split(a, b) else { continue };
            self.settle(middle);
            for other in self.ring(middle) {
                let long = key(self, [middle, other]);
                if long > LONG {
                    list.push((long.to_bits(), Reverse([middle, other])));
                }
            }
        }
    }

    fn flip_all(&mut self) {
        for _ in 0..3 {
            let mut changed = false;
            for [a, b] in self.edges() {
                changed |= self.flip(a, b);
            }
            if !changed {
                break;
            }
        }
    }

    fn collapse_short(&mut self) {
        let mut list = self.edges();
        let key = |half: &Self, [a, b]: [usize; 2]| half.relative_length(a, b);
        list.retain(|edge| key(self, *edge) < SHORT);
        list.sort_by(|p, q| key(self, *p).total_cmp(&key(self, *q)));
        for [a, b] in list {
            if self.beside(a, b).1 == 0 || key(self, [a, b]) >= SHORT {
                continue;
            }
            let better = |before: f64, after: f64| after >= 0.5 * before.min(0.6);
            if !self.collapse(a, b, LONG, better) {
                self.collapse(b, a, LONG, better);
            }
        }
    }

    fn relax_all(&mut self) {
        for v in 0..self.points.len() {
            self.relax(v, false);
        }
    }

    /// The angle of the corner of the body that a corner of a triangle is in, where that is less than the bound
    /// \[rad\]: between the next edges of the body to both sides, or twice that to one side where the other is the
    /// centreplane.
    pub(super) fn sharp_corner(&self, face: usize, v: usize) -> Option<f64> {
        let (region, _) = self.faces[face]?;
        let (mut sum, mut halved) = (0.0, false);
        let (mut seen, mut list) = (Vec::new(), vec![face]);
        while let Some(f) = list.pop() {
            if seen.contains(&f) {
                continue;
            }
            seen.push(f);
            let (_, corners) = self.faces[f]?;
            let at = corners.iter().position(|&c| c == v)?;
            let (p, q) = (corners[(at + 1) % 3], corners[(at + 2) % 3]);
            let (s, t, r) = (self.distance(v, p), self.distance(v, q), self.distance(p, q));
            sum += ((s * s + t * t - r * r) / (2.0 * s * t)).clamp(-1.0, 1.0).acos();
            for other in [p, q] {
                let (beside, count) = self.beside(v, other);
                halved |= count == 1 && region != Region::Hull;
                if !self.is_feature(v, other) {
                    list.extend(beside);
                }
            }
            if sum >= LEAST_ANGLE {
                return None;
            }
        }
        Some(if halved { 2.0 * sum } else { sum })
    }

    /// The least angle of a triangle where that is too small and no corner of the body.
    fn bad(&self, face: usize, bound: f64) -> Option<f64> {
        let (_, corners) = self.faces[face]?;
        let (angle, at) = least_sine(self.corners(corners));
        (angle < bound && self.sharp_corner(face, corners[at]).is_none()).then_some(angle)
    }

    /// Flips around a vertex where that helps.
    fn settle(&mut self, v: usize) {
        for _ in 0..3 {
            let mut changed = false;
            let list: Vec<[usize; 3]> =
                self.around[v].iter().filter_map(|&f| self.faces[f]).map(|face| face.1).collect();
            for corners in list {
                for k in 0..3 {
                    let (a, b) = (corners[k], corners[(k + 1) % 3]);
                    if self.beside(a, b).1 == 2 {
                        changed |= self.flip(a, b);
                    }
                }
            }
            if !changed {
                break;
            }
        }
    }

    fn longest_edge(&self, corners: [usize; 3]) -> [usize; 2] {
        let edge = |k: usize| [corners[k], corners[(k + 1) % 3]];
        let long = |k: usize| self.distance(edge(k)[0], edge(k)[1]);
        edge((0..3).fold(0, |k, other| if long(other) > long(k) * (1.0 + 1e-9) { other } else { k }))
    }

    /// Splits the edge at the end of the path over longest edges that begins with a triangle, at last the one before it
    /// that can be split.
    fn split_path(&mut self, face: usize) -> bool {
        let mut at = face;
        let Some((_, corners)) = self.faces[at] else { return false };
        let mut path = vec![self.longest_edge(corners)];
        for _ in 0..STEPS {
            let edge = path[path.len() - 1];
            let ([f, g], count) = self.beside(edge[0], edge[1]);
            if count != 2 {
                break;
            }
            let next = if f == at { g } else { f };
            let Some((_, corners)) = self.faces[next] else { break };
            let longer = self.longest_edge(corners);
            if self.distance(longer[0], longer[1]) <= self.distance(edge[0], edge[1]) * (1.0 + 1e-9) {
                break;
            }
            at = next;
            path.push(longer);
        }
        let tries = if self.is_last() { path.len() } else { 1 };
        let middle = path.into_iter().rev().take(tries).find_map(|[a, b]| self.split(a, b));
        middle.is_some_and(|middle| {
            self.settle(middle);
            true
        })
    }

    /// Makes one triangle better; whether anything was done.
    fn mend(&mut self, face: usize, bound: f64, pass: usize, may_split: bool) -> bool {
        let Some((_, corners)) = self.faces[face] else { return false };
        for k in 0..3 {
            if self.flip(corners[k], corners[(k + 1) % 3]) {
                return true;
            }
        }
        // At last only where nothing is left to be done, since what was taken out might be put back for ever.
        let better = |before: f64, after: f64| after > before + 1e-6 && (pass < FREE || after >= bound);
        let (_, at) = least_sine(self.corners(corners));
        let (a, b) = (corners[(at + 1) % 3], corners[(at + 2) % 3]);
        // The short edge first, then the others.
        for (a, b) in [(a, b), (corners[at], a), (corners[at], b)] {
            if self.collapse(a, b, 2.0, better) || self.collapse(b, a, 2.0, better) {
                self.settle(if self.around[a].is_empty() { b } else { a });
                return true;
            }
        }
        let mut moved = false;
        for v in corners {
            moved |= self.relax(v, false) || (self.is_last() && self.relax(v, true));
        }
        if !may_split || (moved && self.bad(face, bound).is_none()) {
            return moved;
        }
        self.split_path(face)
    }

    /// Whether what is left may be off by the whole tolerance, and every means is tried.
    fn is_last(&self) -> bool {
        self.allowed > self.deviation
    }

    /// Triangles with an angle that is too small, the worst first.
    fn bad_faces(&self, bound: f64) -> Vec<usize> {
        let mut list: Vec<(f64, usize)> =
            (0..self.faces.len()).filter_map(|f| Some((self.bad(f, bound)?, f))).collect();
        list.sort_by(|p, q| p.0.total_cmp(&q.0).then(p.1.cmp(&q.1)));
        list.into_iter().map(|(_, face)| face).collect()
    }

    fn mend_all(&mut self, most: usize) {
        let bound = aim();
        let (mut best, mut stalled) = (usize::MAX, 0);
        for pass in 0..if self.is_last() { LAST_PASSES } else { PASSES } {
            let list = self.bad_faces(bound);
            if list.is_empty() {
                return;
            }
            let list_length = list.len();
            let mut changed = false;
            for face in list {
                if self.faces[face].is_none() || self.bad(face, bound).is_none() {
                    continue;
                }
                changed |= self.mend(face, bound, pass, pass > 0 && self.count() < most);
            }
            // A part of the body that cannot be meshed so well is not worth more.
            let fewer = list_length <= best - best.div_ceil(20);
            (best, stalled) = if fewer { (list_length, 0) } else { (best, stalled + 1) };
            if (!changed && pass > 0) || (stalled >= PATIENCE && pass > FREE && !self.is_last()) {
                return;
            }
        }
    }

    /// Splits triangles that leave the surface by more than is allowed.
    fn follow(&mut self, most: usize) -> bool {
        let mut changed = false;
        for f in 0..self.faces.len() {
            let Some(face) = self.faces[f] else { continue };
            if self.count() < most && self.off(face) > 1.02 * self.deviation {
                changed |= self.split_path(f);
            }
        }
        changed
    }

    /// Takes out vertices that neither the shape of triangles nor the surface needs.
    fn thin(&mut self) {
        let bound = (1.1 * LEAST_ANGLE).sin();
        let mut list = self.edges();
        list.sort_by(|p, q| self.relative_length(p[0], p[1]).total_cmp(&self.relative_length(q[0], q[1])));
        for [a, b] in list {
            if self.beside(a, b).1 == 0 {
                continue;
            }
            let better = |_: f64, after: f64| after >= bound;
            if !self.collapse(a, b, 10.0, better) {
                self.collapse(b, a, 10.0, better);
            }
        }
    }

    /// Takes the vertices between the edges of the side off the centreplane, which would belong to both sides with all
    /// that meets there.
    fn part(&mut self) {
        for v in 0..self.points.len() {
            if self.on_centreplane(v) && self.ring(v).into_iter().all(|other| self.beside(v, other).1 == 2) {
                self.points[v] = self.lifted(self.points[v]);
            }
        }
        for [a, b] in self.edges() {
            if self.on_centreplane(a) && self.on_centreplane(b) && self.beside(a, b).1 == 2 {
                self.split(a, b);
            }
        }
    }

    /// Brings all triangles into shape.
    pub(super) fn shape(&mut self) {
        self.part();
        for _ in 0..ROUNDS {
            self.collapse_short();
            self.flip_all();
            self.split_long(4 * self.count() + SPARE);
            self.flip_all();
            self.relax_all();
        }
        let most = 3 * self.count() / 2 + SPARE;
        self.mend_all(most);
        self.thin();
        self.flip_all();
        self.relax_all();
        self.thin();
        self.mend_all(most);
        for _ in 0..FOLLOWED {
            if !self.follow(most) {
                break;
            }
            self.mend_all(most);
        }
        if self.bad_faces(aim()).len() <= FEW {
            self.allowed = 2.0 * self.deviation;
            self.mend_all(most);
        }
        self.open_ends();
    }
}
