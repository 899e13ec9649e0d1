//! Subdivision surfaces as FREE!ship and DELFTship have them: a control net of triangles, quadrilaterals and larger
//! faces with creases.
//!
//! One step puts a point into the middle of every edge and of every face but triangles, cuts triangles into four and
//! other faces into quadrilaterals, and then moves each point p (J. Stam and C. Loop, Quad/Triangle Subdivision,
//! Computer Graphics Forum 22, 2003):
//!
//! ```text
//! corner       stays,
//! on a crease  p / 2 + (a + b) / 4                     a, b: its neighbours along the crease,
//! elsewhere    p + s (c - p)                           c: mean of the centres of its faces, weighted by pi/2 and pi/3,
//! ```
//!
//! the centre of a triangle being p / 4 + 3/8 of each other corner, and s = 4/n among n quadrilaterals, 12 / (3 q + 2
//! t) among q quadrilaterals and t triangles, 5/3 - 8/3 (3/8 + cos(2 pi/n)/4)^2 among n triangles. Edges of one face,
//! or of more than two, are creases; a point with three creases or more is a corner, and one with less than two is on
//! none. On a regular grid the limit is the uniform bicubic spline, natural across creases. A mesh after k steps leaves
//! it by O(4^-k).

mod of_hull;

use super::TriangleMesh;
use crate::spline::minus;
use std::collections::HashMap;
use std::f64::consts::PI;

/// What a point of the net was declared as.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum NetPointKind {
    /// On no crease.
    #[default]
    Regular,
    /// On a crease.
    Crease,
    /// Where a crease ends within the surface.
    Dart,
    /// Kept where it is.
    Corner,
}

impl NetPointKind {
    /// In the order of their numbers in files, from 0.
    pub const ALL: [Self; 4] = [Self::Regular, Self::Crease, Self::Dart, Self::Corner];
}

/// An edge of the net.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct NetEdge {
    /// Its two points.
    pub ends: [usize; 2],
    /// Whether the surface has a knuckle along it.
    pub crease: bool,
}

/// A face of the net.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct NetFace {
    /// Points in turn, three at least.
    pub corners: Vec<usize>,
    /// Index of its layer.
    pub layer: usize,
}

/// A layer of faces.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct NetLayer {
    /// Its name.
    pub name: String,
    /// Colour, red + 256 green + 65536 blue.
    pub colour: u32,
    /// Whether its mirror image y to -y belongs to the body.
    pub symmetric: bool,
    /// Whether it displaces water.
    pub in_hydrostatics: bool,
}

/// A control net.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SubdivisionNet {
    /// Points and what they were declared as.
    pub points: Vec<([f64; 3], NetPointKind)>,
    /// Edges, each once.
    pub edges: Vec<NetEdge>,
    /// Faces.
    pub faces: Vec<NetFace>,
    /// Layers.
    pub layers: Vec<NetLayer>,
}

/// No corner: the fourth of a triangle.
const NONE: usize = usize::MAX;

/// The net after some steps: triangles and quadrilaterals.
struct Level {
    points: Vec<[f64; 3]>,
    corner: Vec<bool>,
    /// Edges by their points, the lower first, and whether they are creases.
    edges: HashMap<(usize, usize), bool>,
    faces: Vec<Vec<usize>>,
    layers: Vec<usize>,
}

fn key(a: usize, b: usize) -> (usize, usize) {
    (a.min(b), a.max(b))
}

fn sides(corners: &[usize]) -> impl Iterator<Item = (usize, usize)> + '_ {
    (0..corners.len()).map(|k| key(corners[k], corners[(k + 1) % corners.len()]))
}

fn mean(points: &[[f64; 3]], corners: &[usize]) -> [f64; 3] {
    [0, 1, 2].map(|k| corners.iter().map(|&at| points[at][k]).sum::<f64>() / corners.len() as f64)
}

impl Level {
    fn of(net: &SubdivisionNet) -> Self {
        let mut edges: HashMap<(usize, usize), bool> = HashMap::new();
        let mut uses: HashMap<(usize, usize), usize> = HashMap::new();
        for face in &net.faces {
            for side in sides(&face.corners) {
                *uses.entry(side).or_default() += 1;
            }
        }
        for (&side, &count) in &uses {
            edges.insert(side, count != 2);
        }
        for edge in net.edges.iter().filter(|edge| edge.crease) {
            if let Some(crease) = edges.get_mut(&key(edge.ends[0], edge.ends[1])) {
                *crease = true;
            }
        }
        Self {
            points: net.points.iter().map(|(point, _)| *point).collect(),
            corner: net.points.iter().map(|(_, kind)| *kind == NetPointKind::Corner).collect(),
            edges,
            faces: net.faces.iter().map(|face| face.corners.clone()).collect(),
            layers: net.faces.iter().map(|face| face.layer).collect(),
        }
    }

    /// Every face cut, points in the middles.
    fn split(&self) -> Self {
        let mut points = self.points.clone();
        let mut order: Vec<(usize, usize)> = self.edges.keys().copied().collect();
        order.sort_unstable();
        let mut middles: HashMap<(usize, usize), usize> = HashMap::with_capacity(order.len());
        let mut edges: HashMap<(usize, usize), bool> = HashMap::with_capacity(4 * order.len());
        for (a, b) in order {
            let middle = points.len();
            points.push(mean(&self.points, &[a, b]));
            middles.insert((a, b), middle);
            let crease = self.edges[&(a, b)];
            edges.insert(key(a, middle), crease);
            edges.insert(key(middle, b), crease);
        }
        let (mut faces, mut layers) = (Vec::with_capacity(4 * self.faces.len()), Vec::new());
        for (face, &layer) in self.faces.iter().zip(&self.layers) {
            let n = face.len();
            let middle = |k: usize| middles[&key(face[k], face[(k + 1) % n])];
            if n == 3 {
                let inner = [middle(0), middle(1), middle(2)];
                edges.extend(sides(&inner).map(|side| (side, false)));
                faces.extend((0..3).map(|k| vec![face[k], inner[k], inner[(k + 2) % 3]]));
                faces.push(inner.to_vec());
                layers.extend([layer; 4]);
            } else {
                let centre = points.len();
                points.push(mean(&self.points, face));
                for (k, &at) in face.iter().enumerate() {
                    edges.insert(key(middle(k), centre), false);
                    faces.push(vec![at, middle(k), centre, middle((k + n - 1) % n)]);
                    layers.push(layer);
                }
            }
        }
        let mut corner = self.corner.clone();
        corner.resize(points.len(), false);
        Self { points, corner, edges, faces, layers }
    }

    /// Every point moved as the head says.
    fn averaged(mut self) -> Self {
        let count = self.points.len();
        let mut along = vec![[NONE; 2]; count];
        let mut creases = vec![0_usize; count];
        for (&(a, b), _) in self.edges.iter().filter(|(_, crease)| **crease) {
            for (p, q) in [(a, b), (b, a)] {
                if creases[p] < 2 {
                    along[p][creases[p]] = q;
                }
                creases[p] += 1;
            }
        }
        let mut sums = vec![[0.0_f64; 4]; count];
        let mut around = vec![[0_usize; 2]; count];
        for face in &self.faces {
            let triangle = face.len() == 3;
            let weight = if triangle { PI / 3.0 } else { PI / 2.0 };
            let middle = mean(&self.points, face);
            for &at in face {
                let p = self.points[at];
                // Of a triangle 3 (mean) = p + others: p/4 + 3/8 others = 9/8 mean - p/8.
                let centre = [0, 1, 2].map(|k| if triangle { 1.125 * middle[k] - 0.125 * p[k] } else { middle[k] });
                for k in 0..3 {
                    sums[at][k] += weight * centre[k];
                }
                sums[at][3] += weight;
                around[at][usize::from(triangle)] += 1;
            }
        }
        let old = self.points.clone();
        for (at, point) in self.points.iter_mut().enumerate() {
            let p = old[at];
            if self.corner[at] || creases[at] > 2 || sums[at][3] <= 0.0 {
                continue;
            }
            if creases[at] == 2 {
                // In a fixed order, so that the sum does not depend on that of a map.
                let [low, high] = if along[at][0] < along[at][1] { along[at] } else { [along[at][1], along[at][0]] };
                let (a, b) = (old[low], old[high]);
                *point = [0, 1, 2].map(|k| 0.5 * p[k] + 0.25 * (a[k] + b[k]));
                continue;
            }
            let [quads, triangles] = around[at].map(|n| n as f64);
            let share = if around[at][0] == 0 {
                let root = 0.375 + 0.25 * (2.0 * PI / triangles).cos();
                5.0 / 3.0 - 8.0 / 3.0 * root * root
            } else if around[at][1] == 0 {
                4.0 / quads
            } else {
                12.0 / (3.0 * quads + 2.0 * triangles)
            };
            *point = [0, 1, 2].map(|k| p[k] + share * (sums[at][k] / sums[at][3] - p[k]));
        }
        self
    }

    /// Triangles of the layers that count, mirrored where the layer is.
    fn triangles(&self, net: &SubdivisionNet, wet: bool) -> TriangleMesh {
        let mut corners = Vec::with_capacity(4 * self.faces.len());
        for (face, &layer) in self.faces.iter().zip(&self.layers) {
            let layer = net.layers.get(layer);
            if wet && layer.is_some_and(|layer| !layer.in_hydrostatics) {
                continue;
            }
            let points: Vec<[f64; 3]> = face.iter().map(|&at| self.points[at]).collect();
            let length = |a: usize, b: usize| minus(points[a], points[b]).map(|c| c * c).iter().sum::<f64>();
            let first = corners.len();
            match points[..] {
                [a, b, c, d] if length(0, 2) <= length(1, 3) => corners.extend([[a, b, c], [a, c, d]]),
                [a, b, c, d] => corners.extend([[b, c, d], [b, d, a]]),
                _ => corners.extend((2..points.len()).map(|k| [points[0], points[k - 1], points[k]])),
            }
            if layer.is_none_or(|layer| layer.symmetric) && points.iter().any(|point| point[1].abs() > 0.0) {
                let mirror = |[x, y, z]: [f64; 3]| [x, 0.0 - y, z];
                let half = corners[first..].to_vec();
                corners.extend(half.into_iter().map(|[a, b, c]| [mirror(a), mirror(c), mirror(b)]));
            }
        }
        TriangleMesh::from_corners(corners.into_iter())
    }
}

impl SubdivisionNet {
    /// Triangles over the body after as many steps as make at most `most` faces, and after one step less: the coarser
    /// first.
    ///
    /// Layers that displace no water are left out, unless no other has faces.
    #[must_use]
    pub fn meshes(&self, most: usize, steps: usize) -> [TriangleMesh; 2] {
        let wet = self.faces.iter().any(|face| self.layers.get(face.layer).is_none_or(|layer| layer.in_hydrostatics));
        let mut level = Level::of(self);
        let mut pair = [TriangleMesh::default(), level.triangles(self, wet)];
        for step in 0.. {
            if step > 0 && (step >= steps || 4 * level.faces.len() > most) {
                break;
            }
            level = level.split().averaged();
            let [_, last] = pair;
            pair = [last, level.triangles(self, wet)];
        }
        pair
    }
}

#[cfg(test)]
mod tests;
