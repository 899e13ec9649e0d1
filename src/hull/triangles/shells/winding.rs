//! The solid angle of a skin about a point, by a tree of boxes (Jacobson, Kavan and Sorkine-Hornung 2013).
//!
//! Triangles and the fan over their edges that no second one of them has are closed together. From outside of a box around
//! both these are seen under the same solid angle. So a far box with many triangles costs as much as its few edges.

use super::super::boxes::{Boxes, around};
use super::solid_angle;
use crate::spline::minus;
use std::cmp::Ordering;
use std::collections::HashMap;

type Triangle = [[f64; 3]; 3];

/// Edges from the smaller index to the greater one, rising, and how often they are run through in this direction.
type Rim = Vec<([usize; 2], i32)>;

pub(super) struct Winding {
    tree: Boxes,
    triangles: Vec<Triangle>,
    /// For each node of the tree the fan over its edges, where it has fewer triangles.
    fans: Vec<Option<Vec<Triangle>>>,
}

/// Edges of one or the other, without those that both have in opposite directions.
fn both(a: &Rim, b: &Rim) -> Rim {
    let (mut rim, mut i, mut j) = (Rim::with_capacity(a.len() + b.len()), 0, 0);
    while let (Some(&(p, m)), Some(&(q, n))) = (a.get(i), b.get(j)) {
        match p.cmp(&q) {
            Ordering::Less => rim.push((p, m)),
            Ordering::Greater => rim.push((q, n)),
            Ordering::Equal if m + n != 0 => rim.push((p, m + n)),
            Ordering::Equal => {}
        }
        i += usize::from(p <= q);
        j += usize::from(q <= p);
    }
    rim.extend(a[i..].iter().chain(&b[j..]));
    rim
}

fn rim_of([a, b, c]: [usize; 3]) -> Rim {
    let edge = |[p, q]: [usize; 2]| vec![([p.min(q), p.max(q)], if p < q { 1 } else { -1 })];
    [[a, b], [b, c], [c, a]].into_iter().filter(|[p, q]| p != q).fold(Rim::new(), |rim, ends| both(&rim, &edge(ends)))
}

impl Winding {
    pub(super) fn of(triangles: &[Triangle]) -> Self {
        let (mut places, mut points) = (HashMap::new(), Vec::new());
        let mut place = |point: [f64; 3]| {
            // -0 is 0.
            *places.entry(point.map(|c| (c + 0.0).to_bits())).or_insert_with(|| {
                points.push(point);
                points.len() - 1
            })
        };
        let corners: Vec<[usize; 3]> = triangles.iter().map(|t| t.map(&mut place)).collect();
        let tree = Boxes::new(triangles.iter().map(|t| around(t.iter().copied())).collect());
        let mut rims: Vec<Rim> = vec![Rim::new(); tree.nodes.len()];
        let mut fans = vec![None; tree.nodes.len()];
        // Nodes stand before those below them.
        for (at, node) in tree.nodes.iter().enumerate().rev() {
            let [from, to] = node.range;
            let rim = match node.second {
                Some(second) => both(&std::mem::take(&mut rims[at + 1]), &std::mem::take(&mut rims[second])),
                None => tree.order[from..to].iter().fold(Rim::new(), |rim, &k| both(&rim, &rim_of(corners[k]))),
            };
            let uses: usize = rim.iter().map(|(_, times)| times.unsigned_abs() as usize).sum();
            if uses < to - from {
                let fan = rim.iter().flat_map(|&([p, q], times)| {
                    let [p, q] = if times > 0 { [p, q] } else { [q, p] };
                    let triangle = [points[p], points[q], points[rim[0].0[0]]];
                    std::iter::repeat_n(triangle, times.unsigned_abs() as usize)
                });
                fans[at] = Some(fan.collect());
            }
            rims[at] = rim;
        }
        Self { tree, triangles: triangles.to_vec(), fans }
    }

    /// The solid angle about a point, 4 pi inside; and adds to the work how many triangles it took.
    pub(super) fn angle(&self, point: [f64; 3], work: &mut usize) -> f64 {
        let seen = |triangle: &Triangle| solid_angle(triangle.map(|corner| minus(corner, point)));
        let (mut sum, mut waiting) = (0.0, if self.tree.nodes.is_empty() { Vec::new() } else { vec![0] });
        while let Some(at) = waiting.pop() {
            let node = &self.tree.nodes[at];
            let [low, high] = node.bounds;
            let is_far = (0..3).any(|k| point[k] < low[k] || point[k] > high[k]);
            if let Some(fan) = self.fans[at].as_ref().filter(|_| is_far) {
                *work += fan.len();
                sum += fan.iter().map(seen).sum::<f64>();
            } else if let Some(second) = node.second {
                waiting.extend([second, at + 1]);
            } else {
                let own = &self.tree.order[node.range[0]..node.range[1]];
                *work += own.len();
                sum += own.iter().map(|&k| seen(&self.triangles[k])).sum::<f64>();
            }
        }
        sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    #[test]
    fn the_solid_angle_by_boxes_is_that_of_all_triangles() {
        // A torus of 64 by 32 spaces, one quarter of it open.
        let at = |i: usize, j: usize| {
            let [u, v] = [i as f64 / 64.0, j as f64 / 32.0].map(|share| 2.0 * PI * share);
            [(3.0 + v.cos()) * u.cos(), (3.0 + v.cos()) * u.sin(), v.sin()]
        };
        let spaces = (0..48).flat_map(|i| (0..32).map(move |j| (i, j)));
        let triangles: Vec<Triangle> = spaces
            .flat_map(|(i, j)| {
                let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, (j + 1) % 32), at(i, (j + 1) % 32)];
                [[a, b, c], [a, c, d]]
            })
            .collect();
        let winding = Winding::of(&triangles);
        let mut most = 0;
        for k in 0..200 {
            let k = f64::from(k);
            let point = [4.0 * (0.7 * k).sin(), 4.0 * (1.3 * k).sin(), 1.2 * (2.1 * k).sin()];
            let all: f64 = triangles.iter().map(|t| solid_angle(t.map(|corner| minus(corner, point)))).sum();
            let mut work = 0;
            assert!((winding.angle(point, &mut work) - all).abs() < 1e-9, "{point:?}");
            most = most.max(work);
        }
        assert!(most < triangles.len() / 2, "{most} of {}", triangles.len());
    }
}
