//! Sewing: edges that faces do not share, though they lie on each other, become one.

use super::nearest::{Nearest, nearest};
use super::{Brep, BrepEdge};
use crate::spline::{length, minus};
use std::collections::HashMap;

/// Vertices nearer to each other than this part of the size of the body are one.
const WELD: f64 = 2e-6;

/// Edges between the same vertices whose middles are nearer to each other than this part of their length are one.
const ALONG: f64 = 2e-3;

impl Brep {
    /// The body with vertices that lie on each other as one, edges of one face alone split where a vertex lies on them,
    /// and equal edges as one.
    pub(super) fn sewn(&self) -> Self {
        let mut body = self.clone();
        let slack = WELD * body.size();
        body.weld(slack);
        if body.free().iter().any(|&free| free) {
            body.split(slack);
            body.unite(slack);
        }
        body
    }

    /// Whether each edge is of one face alone, once.
    fn free(&self) -> Vec<bool> {
        let mut uses = vec![0_usize; self.edges.len()];
        for &(edge, _) in self.faces.iter().flat_map(|face| &face.loops).flatten() {
            uses[edge] += 1;
        }
        uses.into_iter().map(|count| count == 1).collect()
    }

    /// Vertices nearer than `slack` to an earlier one become that one.
    fn weld(&mut self, slack: f64) {
        let cell = 4.0 * slack.max(f64::MIN_POSITIVE);
        let key = |p: [f64; 3]| p.map(|c| (c / cell).floor() as i64);
        let mut cells: HashMap<[i64; 3], Vec<usize>> = HashMap::new();
        let mut target: Vec<usize> = Vec::with_capacity(self.vertices.len());
        for (k, &point) in self.vertices.iter().enumerate() {
            let [x, y, z] = key(point);
            let around =
                (-1..=1).flat_map(|a| (-1..=1).flat_map(move |b| (-1..=1).map(move |c| [x + a, y + b, z + c])));
            let near = around
                .filter_map(|cell| cells.get(&cell))
                .flatten()
                .copied()
                .find(|&other| length(minus(self.vertices[other], point)) <= slack);
            target.push(near.unwrap_or(k));
            if near.is_none() {
                cells.entry([x, y, z]).or_default().push(k);
            }
        }
        self.edges.iter_mut().for_each(|edge| edge.ends = edge.ends.map(|k| target[k]));
    }

    /// Splits free edges at vertices of free edges that lie on them.
    fn split(&mut self, slack: f64) {
        let free = self.free();
        let mut ends: Vec<usize> =
            self.edges.iter().zip(&free).filter(|(_, free)| **free).flat_map(|(edge, _)| edge.ends).collect();
        ends.sort_unstable();
        ends.dedup();
        let mut pieces: HashMap<usize, Vec<usize>> = HashMap::new();
        for (k, _) in free.iter().enumerate().filter(|(_, free)| **free) {
            let edge = self.edges[k].clone();
            let [low, high] = [edge.range[0].min(edge.range[1]), edge.range[0].max(edge.range[1])];
            let [least, greatest] = edge.bounds(slack);
            let inside = |p: [f64; 3]| (0..3).all(|axis| p[axis] >= least[axis] && p[axis] <= greatest[axis]);
            let mut cuts: Vec<(f64, usize)> = ends
                .iter()
                .filter(|&&v| !edge.ends.contains(&v) && inside(self.vertices[v]))
                .map(|&v| (edge.nearest(self.vertices[v]), v))
                .filter(|(found, _)| found.distance <= slack && found.parameter > low && found.parameter < high)
                .map(|(found, v)| (found.parameter, v))
                .collect();
            if cuts.is_empty() {
                continue;
            }
            cuts.sort_by(|a, b| a.0.total_cmp(&b.0));
            if edge.range[0] > edge.range[1] {
                cuts.reverse();
            }
            let stops: Vec<(f64, usize)> = std::iter::once((edge.range[0], edge.ends[0]))
                .chain(cuts)
                .chain([(edge.range[1], edge.ends[1])])
                .collect();
            let mut list = Vec::new();
            for pair in stops.windows(2) {
                list.push(self.edges.len());
                let [(from, a), (to, b)] = [pair[0], pair[1]];
                self.edges.push(BrepEdge { ends: [a, b], curve: edge.curve.clone(), range: [from, to] });
            }
            pieces.insert(k, list);
        }
        self.replace(|(edge, forward)| match pieces.get(&edge) {
            Some(list) if forward => list.iter().map(|&piece| (piece, true)).collect(),
            Some(list) => list.iter().rev().map(|&piece| (piece, false)).collect(),
            None => vec![(edge, forward)],
        });
    }

    /// Free edges between the same vertices that lie on each other become one.
    fn unite(&mut self, slack: f64) {
        let free = self.free();
        let mut known: HashMap<[usize; 2], Vec<usize>> = HashMap::new();
        let mut same: HashMap<usize, (usize, bool)> = HashMap::new();
        for (k, _) in free.iter().enumerate().filter(|(_, free)| **free) {
            let edge = &self.edges[k];
            let [a, b] = edge.ends;
            let others = known.entry([a.min(b), a.max(b)]).or_default();
            let at =
                |edge: &BrepEdge, share: f64| edge.curve.point(edge.range[0] + share * (edge.range[1] - edge.range[0]));
            let middle = at(edge, 0.5);
            let far = (ALONG * edge.length()).max(slack);
            let twin = others.iter().copied().find(|&other| self.edges[other].nearest(middle).distance <= far);
            match twin {
                Some(other) => {
                    let own = &self.edges[other];
                    let forward = if a == b {
                        // Closed ones by which quarter lies near to the first quarter.
                        let quarter = at(edge, 0.25);
                        length(minus(quarter, at(own, 0.25))) <= length(minus(quarter, at(own, 0.75)))
                    } else {
                        own.ends == edge.ends
                    };
                    same.insert(k, (other, forward));
                    others.retain(|&mate| mate != other);
                }
                None => others.push(k),
            }
        }
        self.replace(|(edge, forward)| match same.get(&edge) {
            Some(&(other, alike)) => vec![(other, forward == alike)],
            None => vec![(edge, forward)],
        });
    }

    fn replace(&mut self, with: impl Fn((usize, bool)) -> Vec<(usize, bool)>) {
        for edges in self.faces.iter_mut().flat_map(|face| &mut face.loops) {
            *edges = edges.iter().copied().flat_map(&with).collect();
        }
    }
}

impl BrepEdge {
    fn shares(&self) -> impl Iterator<Item = f64> + '_ {
        (0..=8).map(|k| self.range[0] + (self.range[1] - self.range[0]) * f64::from(k) / 8.0)
    }

    /// Its length, about.
    fn length(&self) -> f64 {
        let points: Vec<[f64; 3]> = self.shares().map(|t| self.curve.point(t)).collect();
        points.windows(2).map(|w| length(minus(w[1], w[0]))).sum()
    }

    /// The point between its ends that is nearest to another: two arcs of a circle are two edges.
    fn nearest(&self, point: [f64; 3]) -> Nearest {
        let [a, b] = self.range;
        nearest(|t| self.curve.at(t), &self.curve.breaks(a.min(b), a.max(b)), false, point)
    }

    /// A box around it.
    fn bounds(&self, slack: f64) -> [[f64; 3]; 2] {
        let points: Vec<[f64; 3]> = self.shares().map(|t| self.curve.point(t)).collect();
        // What bends out between the points.
        let slack = slack + 0.2 * self.length();
        let fold = |pick: fn(f64, f64) -> f64, start: f64, by: f64| {
            [0, 1, 2].map(|k: usize| points.iter().map(|p| p[k]).fold(start, pick) + by)
        };
        [fold(f64::min, f64::INFINITY, -slack), fold(f64::max, f64::NEG_INFINITY, slack)]
    }
}
