//! Rims of shells: open edges, where they lie on those of others, and what they close together.
//!
//! Plates that are meshed on their own meet along rims whose vertices differ. An edge of one rim is looked at in places; it is
//! closed where an odd number of other rims passes there. So a bulkhead between two blocks closes nothing, and each of the blocks
//! closes the other. A tube and the openings that it joins may be divided differently: these lie in one place, and run through
//! it in the same or the opposite direction.

use super::boxes::{Bounds, Boxes, around, widened};
use super::shells::chains;
use super::{TriangleMesh, open_edges};
use crate::spline::{cross, dot, length, minus};
use std::collections::{BTreeMap, HashMap};

/// Places of an edge at which it is looked at, over its length.
const PLACES: [f64; 3] = [0.21, 0.5, 0.79];

/// Most open edges that are looked at.
const MOST: usize = 400_000;

/// Vertices of open edges nearer than this part of the size of the body are one.
const WELD: f64 = 1e-6;

/// Openings whose ends differ by less than this part of their size are in one place.
const ALIKE: f64 = 0.02;

/// Openings in one place are joined where they begin below this part of the height of the body.
const LOW: f64 = 0.5;

/// Part of the rims of a shell that others close, from which it belongs to their skin.
pub(super) const CLOSING: f64 = 0.5;

/// An open edge.
struct Rim {
    ends: [usize; 2],
    shell: usize,
    length: f64,
}

/// The open edges of the shells of a mesh.
pub(super) struct Rims {
    rims: Vec<Rim>,
    /// At each place of each rim the other rims that pass there.
    passing: Vec<Vec<usize>>,
    /// Rims by shell.
    by_shell: Vec<Vec<usize>>,
    /// Shells with an opening in one place, and whether they run around it alike.
    openings: Vec<([usize; 2], bool)>,
}

impl TriangleMesh {
    /// The mesh with vertices of open edges that are as good as one made one.
    #[must_use]
    pub fn welded(mut self) -> Self {
        let Some([low, high]) = self.bounds() else { return self };
        let near = WELD * length(minus(high, low));
        let mut open: Vec<usize> = self.open_edges().into_iter().flatten().collect();
        open.sort_unstable();
        open.dedup();
        // Along a direction in which few vertices are level.
        let along = |k: usize| dot(self.vertices[k], [0.613, 0.547, 0.570]);
        let mut sorted: Vec<(f64, usize)> = open.into_iter().map(|k| (along(k), k)).collect();
        sorted.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut one: HashMap<usize, usize> = HashMap::new();
        for (at, &(place, k)) in sorted.iter().enumerate() {
            if one.contains_key(&k) {
                continue;
            }
            let following = sorted[at + 1..].iter().take_while(|(other, _)| other - place <= near);
            let same: Vec<usize> = following
                .map(|(_, other)| *other)
                .filter(|other| {
                    !one.contains_key(other) && length(minus(self.vertices[*other], self.vertices[k])) <= near
                })
                .collect();
            if let Some(first) = same.iter().copied().chain([k]).min().filter(|_| !same.is_empty()) {
                same.into_iter().chain([k]).for_each(|vertex| {
                    one.insert(vertex, first);
                });
            }
        }
        if one.is_empty() {
            return self;
        }
        self.triangles.iter_mut().flatten().for_each(|vertex| *vertex = *one.get(vertex).unwrap_or(vertex));
        let corners: Vec<[[f64; 3]; 3]> = self.corners().collect();
        Self::from_corners(corners.into_iter())
    }

    /// Open edges that no other lies on.
    #[must_use]
    pub fn gaps(&self) -> Vec<[usize; 2]> {
        self.openings(WELD)
    }

    /// Open edges that no other lies on, within a part of the size of the body.
    pub(super) fn openings(&self, near: f64) -> Vec<[usize; 2]> {
        let shells = self.shells();
        let rims = Rims::of(self, &shells, near);
        let all = |_: usize| true;
        let is_open = |rim: &usize| 2 * rims.closed(*rim, all) < PLACES.len();
        (0..rims.rims.len()).filter(is_open).map(|rim| rims.rims[rim].ends).collect()
    }
}

impl Rims {
    /// Of the shells of a mesh; rims are in one place within a part of the size of the body.
    pub(super) fn of(mesh: &TriangleMesh, shells: &[Vec<usize>], near: f64) -> Self {
        let mut rims = Vec::new();
        let mut by_shell = vec![Vec::new(); shells.len()];
        for (shell, triangles) in shells.iter().enumerate() {
            for ends in open_edges(triangles.iter().map(|&t| mesh.triangles[t])) {
                let [p, q] = ends.map(|v| mesh.vertices[v]);
                by_shell[shell].push(rims.len());
                rims.push(Rim { ends, shell, length: length(minus(q, p)) });
            }
        }
        let [low, high] = mesh.bounds().unwrap_or_default();
        let mut found =
            Self { passing: vec![Vec::new(); PLACES.len() * rims.len()], rims, by_shell, openings: Vec::new() };
        if found.rims.len() <= MOST && !found.rims.is_empty() {
            found.pass(mesh, near * length(minus(high, low)));
            found.join(mesh, low[2] + LOW * (high[2] - low[2]));
        }
        found
    }

    /// Finds the rims that pass at places of others.
    fn pass(&mut self, mesh: &TriangleMesh, near: f64) {
        let ends = |rim: &Rim| rim.ends.map(|v| mesh.vertices[v]);
        let tree = Boxes::new(self.rims.iter().map(|rim| around(ends(rim).into_iter())).collect());
        for (k, rim) in self.rims.iter().enumerate() {
            let [a, b] = ends(rim);
            for (at, share) in PLACES.into_iter().enumerate() {
                let point = [0, 1, 2].map(|i| a[i] + share * (b[i] - a[i]));
                let mut others: Vec<usize> = Vec::new();
                for other in tree.meeting(&widened([point; 2], near)) {
                    let is_new = |&known: &usize| {
                        let (one, two) = (&self.rims[known], &self.rims[other]);
                        one.shell != two.shell || one.ends.iter().all(|end| !two.ends.contains(end))
                    };
                    let is_beside = other != k && distance(point, ends(&self.rims[other])) <= near;
                    if is_beside && others.iter().all(is_new) {
                        others.push(other);
                    }
                }
                self.passing[PLACES.len() * k + at] = others;
            }
        }
    }

    /// Finds openings of two shells in one place that rims do not join.
    fn join(&mut self, mesh: &TriangleMesh, low: f64) {
        let mut loops: Vec<(usize, Bounds, [f64; 3])> = Vec::new();
        for (shell, rims) in self.by_shell.iter().enumerate() {
            let edges: Vec<[usize; 2]> = rims.iter().map(|&rim| self.rims[rim].ends).collect();
            for edges in chains(&edges) {
                let ends = || edges.iter().map(|&k| self.rims[rims[k]].ends.map(|v| mesh.vertices[v]));
                let turn = ends().fold([0.0; 3], |sum, [p, q]| {
                    let area = cross(p, q);
                    [0, 1, 2].map(|k| sum[k] + area[k])
                });
                loops.push((shell, around(ends().flatten()), turn));
            }
        }
        let size = |[low, high]: &Bounds| length(minus(*high, *low));
        let tree = Boxes::new(loops.iter().map(|(_, bounds, _)| *bounds).collect());
        for (k, (shell, bounds, turn)) in loops.iter().enumerate().filter(|(_, (_, bounds, _))| bounds[0][2] < low) {
            for (other, theirs, back) in tree.meeting(bounds).into_iter().filter(|at| *at > k).map(|at| &loops[at]) {
                let off = (0..2).map(|end| length(minus(bounds[end], theirs[end]))).fold(0.0, f64::max);
                if other != shell && off <= ALIKE * size(bounds).min(size(theirs)) {
                    self.openings.push(([*shell, *other], dot(*turn, *back) > 0.0));
                }
            }
        }
    }

    /// At how many of its places a rim is closed by others of shells that count.
    fn closed(&self, rim: usize, counts: impl Fn(usize) -> bool) -> usize {
        let places = &self.passing[PLACES.len() * rim..PLACES.len() * (rim + 1)];
        let odd = |others: &&Vec<usize>| others.iter().filter(|&&k| counts(self.rims[k].shell)).count() % 2 == 1;
        places.iter().filter(odd).count()
    }

    pub(super) fn is_open(&self, shell: usize) -> bool {
        !self.by_shell[shell].is_empty()
    }

    /// Part of the rims of a shell that others of those that count close.
    pub(super) fn closing(&self, shell: usize, counts: &[bool]) -> f64 {
        let own = &self.by_shell[shell];
        let others = |k: usize| k != shell && counts[k];
        let closed: f64 = own.iter().map(|&rim| self.rims[rim].length * self.closed(rim, others) as f64).sum();
        let all: f64 = own.iter().map(|&rim| self.rims[rim].length * PLACES.len() as f64).sum();
        if all > 0.0 { closed / all } else { 0.0 }
    }

    /// The shells whose rims pass those of a shell.
    pub(super) fn beside(&self, shell: usize) -> Vec<usize> {
        let places = self.by_shell[shell].iter().flat_map(|rim| PLACES.len() * rim..PLACES.len() * (rim + 1));
        let mut found: Vec<usize> =
            places.flat_map(|place| &self.passing[place]).map(|&other| self.rims[other].shell).collect();
        found.sort_unstable();
        found.dedup();
        found
    }

    /// Pairs of shells of one skin, and whether they run through their common rim in the same direction.
    pub(super) fn joints(&self, mesh: &TriangleMesh) -> Vec<([usize; 2], bool)> {
        let all = vec![true; self.by_shell.len()];
        let belongs: Vec<bool> = (0..all.len()).map(|shell| self.closing(shell, &all) >= CLOSING).collect();
        // Lengths that run alike, less those that run in the opposite direction.
        let mut sums: BTreeMap<[usize; 2], f64> = BTreeMap::new();
        for (k, rim) in self.rims.iter().enumerate() {
            let along = |ends: [usize; 2]| minus(mesh.vertices[ends[1]], mesh.vertices[ends[0]]);
            for others in &self.passing[PLACES.len() * k..PLACES.len() * (k + 1)] {
                let [other] = others[..] else { continue };
                let other = &self.rims[other];
                if other.shell != rim.shell && (belongs[rim.shell] || belongs[other.shell]) {
                    let pair = [rim.shell.min(other.shell), rim.shell.max(other.shell)];
                    *sums.entry(pair).or_default() += rim.length * dot(along(rim.ends), along(other.ends)).signum();
                }
            }
        }
        sums.into_iter().map(|(pair, sum)| (pair, sum > 0.0)).chain(self.openings.iter().copied()).collect()
    }
}

/// Distance of a point from a straight edge \[m\].
fn distance(point: [f64; 3], [a, b]: [[f64; 3]; 2]) -> f64 {
    let (along, out) = (minus(b, a), minus(point, a));
    let squared = dot(along, along);
    let share = if squared > 0.0 { (dot(along, out) / squared).clamp(0.0, 1.0) } else { 0.0 };
    length([0, 1, 2].map(|k| out[k] - share * along[k]))
}
