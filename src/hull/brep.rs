//! A body of faces: surfaces inside loops of edges, as CAD files hold it.
//!
//! A face is its surface inside its loops. Edges become chains of points that the faces beside them share, so that the
//! triangles over a closed body are closed. The loops are carried into the parameters of the surface, and closed across
//! its seam or at its poles where they wind around it. Their inside is triangulated with the points of a grid that follows
//! the surface. A second mesh halves every edge of the first on curves and surfaces: what is integrated over
//! the two is extrapolated (see [`super::TriangleMesh::nested`]).

mod curve;
pub(in crate::hull) mod face;
mod nearest;
mod outline;
mod sew;
mod surface;

pub use curve::{Conic, SpaceCurve};
pub use nearest::Nearest;
pub use surface::{FaceSurface, frame};

use self::face::Patch;
use self::outline::Outline;
use self::surface::Chart;
use super::TriangleMesh;
use super::triangles::Bends;
use crate::spline::{BsplineSurface, dot, length};
use std::collections::{BTreeSet, HashMap};

/// Loops may be off their surface by this part of the size of the body.
const OFF: f64 = 1e-3;

/// Most parts of a part of an edge between two of its points.
const MOST_PARTS: f64 = 200.0;

/// Loops nearer to the ends of a surface than this part of its domain run along them.
const AT_END: f64 = 1e-6;

/// point + factor vector
fn apart(point: [f64; 3], factor: f64, vector: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|k| point[k] + factor * vector[k])
}

/// A rotation, or a reflection, and a translation, or another affine map: three rows of four numbers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Motion(pub [[f64; 4]; 3]);

impl Motion {
    /// None.
    pub const NONE: Self = Self([[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]]);

    /// This one after another.
    #[must_use]
    pub fn after(&self, first: &Self) -> Self {
        let columns = [0, 1, 2].map(|k| self.along([0, 1, 2].map(|row: usize| first.0[row][k])));
        let moved = self.point([0, 1, 2].map(|row: usize| first.0[row][3]));
        Self([0, 1, 2].map(|row: usize| [columns[0][row], columns[1][row], columns[2][row], moved[row]]))
    }

    /// Whether it keeps angles: a rotation, or a reflection, with one scale in all directions.
    #[must_use]
    pub fn is_similar(&self) -> bool {
        let columns = [0, 1, 2].map(|k: usize| self.0.map(|row| row[k]));
        let [a, b, c] = columns;
        let squared = columns.map(|column| dot(column, column));
        let slack = 1e-9 * squared.iter().sum::<f64>();
        squared.iter().all(|size| (size - squared[0]).abs() <= slack)
            && [dot(a, b), dot(b, c), dot(c, a)].iter().all(|product| product.abs() <= slack)
    }

    /// Its numbers bit for bit, to compare motions by.
    #[must_use]
    pub fn bits(&self) -> [u64; 12] {
        let mut all = self.0.iter().flatten().map(|number| (number + 0.0).to_bits());
        std::array::from_fn(|_| all.next().unwrap_or_default())
    }

    /// The point after it.
    #[must_use]
    pub fn point(&self, [x, y, z]: [f64; 3]) -> [f64; 3] {
        self.0.map(|[a, b, c, d]| a * x + b * y + c * z + d)
    }

    /// A vector after it.
    #[must_use]
    pub fn along(&self, [x, y, z]: [f64; 3]) -> [f64; 3] {
        self.0.map(|[a, b, c, _]| a * x + b * y + c * z)
    }

    /// A point (w x, w y, w z, w) after it.
    #[must_use]
    pub fn weighted(&self, [x, y, z, w]: [f64; 4]) -> [f64; 4] {
        let [x, y, z] = self.0.map(|[a, b, c, d]| a * x + b * y + c * z + d * w);
        [x, y, z, w]
    }
}

/// A curve between two vertices.
#[derive(Debug, Clone)]
pub struct BrepEdge {
    /// The vertex where it begins, and where it ends.
    pub ends: [usize; 2],
    /// What it runs along.
    pub curve: SpaceCurve,
    /// The parameters of its ends; the second may be the smaller one.
    pub range: [f64; 2],
}

impl BrepEdge {
    /// Along a curve between two of the vertices; against it where `same` is false.
    #[must_use]
    pub fn new(curve: SpaceCurve, ends: [usize; 2], vertices: &[[f64; 3]], same: bool) -> Self {
        let [from, to] = ends.map(|k| vertices[k]);
        let range = if same {
            curve.between_points(from, to)
        } else {
            let [a, b] = curve.between_points(to, from);
            [b, a]
        };
        Self { ends, curve, range }
    }
}

/// A surface inside loops.
#[derive(Debug, Clone)]
pub struct BrepFace {
    /// How the file calls it.
    pub name: String,
    /// The kind of its surface.
    pub kind: String,
    /// The surface.
    pub surface: FaceSurface,
    /// Edges in turn, and whether each runs in its own direction.
    pub loops: Vec<Vec<(usize, bool)>>,
    /// Whether the inside is to the left of the loops about S_u x S_v; none where the file does not say so.
    pub left: Option<bool>,
    /// The number of its entity in the file.
    pub part: usize,
}

/// Faces with the edges between them.
#[derive(Debug, Clone, Default)]
pub struct Brep {
    /// Points where edges end.
    pub vertices: Vec<[f64; 3]>,
    /// The edges.
    pub edges: Vec<BrepEdge>,
    /// The faces.
    pub faces: Vec<BrepFace>,
}

/// A face that cannot be triangulated.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FaceFault {
    /// Its index.
    pub face: usize,
    /// Why.
    pub why: &'static str,
}

/// The triangles over a body of faces.
#[derive(Debug, Clone)]
pub struct BrepMesh {
    /// Two meshes, the second with every edge halved.
    pub meshes: [TriangleMesh; 2],
    /// What they leave the surfaces by at most, about \[m\].
    pub deviation: f64,
    /// Faces that are missing.
    pub faults: Vec<FaceFault>,
}

/// The points of all edges, and of the middles between them.
struct Samples {
    points: Vec<[f64; 3]>,
    /// Of each edge its points in turn, as indices.
    edges: Vec<Vec<usize>>,
    /// The middle between two neighbouring points, the smaller index first.
    middles: HashMap<[usize; 2], [f64; 3]>,
}

/// Parameters of an edge so that its chords stay within a deviation.
fn sites(edge: &BrepEdge, deviation: f64) -> Vec<f64> {
    let breaks = edge.curve.breaks(edge.range[0], edge.range[1]);
    let point = |t: f64| edge.curve.point(t);
    let mut all = vec![breaks[0]];
    for w in breaks.windows(2) {
        let at = |share: f64| point(w[0] + share * (w[1] - w[0]));
        let off = |a: f64, b: f64| {
            let (p, q, m) = (at(a), at(b), at(0.5 * (a + b)));
            length([0, 1, 2].map(|k| m[k] - 0.5 * (p[k] + q[k])))
        };
        // The bend of a half is a quarter of that of the whole.
        let bend = off(0.0, 0.5).max(off(0.5, 1.0)).max(0.25 * off(0.0, 1.0));
        let parts = (2.0 * (bend / deviation).sqrt()).ceil().clamp(1.0, MOST_PARTS) as usize;
        all.extend((1..=parts).map(|k| if k == parts { w[1] } else { w[0] + (w[1] - w[0]) * k as f64 / parts as f64 }));
    }
    all
}

impl Samples {
    fn of(vertices: &[[f64; 3]], edges: &[BrepEdge], sites: &[Vec<f64>]) -> Self {
        let mut points = vertices.to_vec();
        let mut lines = Vec::with_capacity(edges.len());
        let mut middles = HashMap::new();
        for (edge, sites) in edges.iter().zip(sites) {
            let first = points.len();
            points.extend(sites[1..sites.len() - 1].iter().map(|&t| edge.curve.point(t)));
            let line: Vec<usize> =
                std::iter::once(edge.ends[0]).chain(first..points.len()).chain([edge.ends[1]]).collect();
            for (pair, ts) in line.windows(2).zip(sites.windows(2)) {
                let key = [pair[0].min(pair[1]), pair[0].max(pair[1])];
                middles.insert(key, edge.curve.point(0.5 * (ts[0] + ts[1])));
            }
            lines.push(line);
        }
        Self { points, edges: lines, middles }
    }
}

impl Brep {
    /// Adds faces of another body after a motion.
    pub fn add(&mut self, other: &Self, faces: &BTreeSet<usize>, motion: &Motion) {
        let (first_vertex, first_edge) = (self.vertices.len(), self.edges.len());
        self.vertices.extend(other.vertices.iter().map(|&point| motion.point(point)));
        self.edges.extend(other.edges.iter().map(|edge| BrepEdge {
            ends: edge.ends.map(|k| first_vertex + k),
            curve: edge.curve.moved(motion),
            range: edge.range,
        }));
        for face in faces.iter().map(|&k| &other.faces[k]) {
            let loops =
                face.loops.iter().map(|edges| edges.iter().map(|&(k, along)| (first_edge + k, along)).collect());
            self.faces.push(BrepFace { surface: face.surface.moved(motion), loops: loops.collect(), ..face.clone() });
        }
    }

    /// The longest extent of the vertices and of the middles of edges.
    #[must_use]
    pub fn size(&self) -> f64 {
        let middles = self.edges.iter().map(|edge| edge.curve.point(0.5 * (edge.range[0] + edge.range[1])));
        // A surface without loops is round.
        let round = self.faces.iter().filter(|face| face.loops.iter().all(Vec::is_empty));
        let around = round.flat_map(|face| face.surface.around());
        let all: Vec<[f64; 3]> = self.vertices.iter().copied().chain(middles).chain(around).collect();
        let extent = |k: usize| {
            let (low, high) =
                all.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), p| (a.min(p[k]), b.max(p[k])));
            high - low
        };
        (0..3).map(extent).fold(0.0, f64::max)
    }

    /// The surfaces, where each face is the whole of a spline.
    #[must_use]
    pub fn whole_surfaces(&self) -> Option<Vec<BsplineSurface<4>>> {
        let size = self.size();
        self.faces.iter().map(|face| self.whole(face, size)).collect()
    }

    fn whole(&self, face: &BrepFace, size: f64) -> Option<BsplineSurface<4>> {
        let (FaceSurface::Spline(surface), [edges]) = (&face.surface, &face.loops[..]) else { return None };
        let chart = Chart::new(&face.surface, size);
        // The two sides of a seam would be cut apart.
        if chart.period.iter().any(Option::is_some) {
            return None;
        }
        let ends = [0, 1].map(|k| chart.domain[k].unwrap_or([0.0, 1.0]));
        let at_end = |uv: [f64; 2]| {
            [0, 1].iter().any(|&k: &usize| {
                let [a, b] = ends[k];
                let slack = AT_END * (b - a);
                let t = uv[k] - a;
                t <= slack || t >= b - a - slack
            })
        };
        let on_ends = edges.iter().all(|&(k, _)| {
            let edge = &self.edges[k];
            let breaks = edge.curve.breaks(edge.range[0], edge.range[1]);
            let sites = breaks.windows(2).flat_map(|w| [w[0], 0.5 * (w[0] + w[1])]);
            sites
                .map(|t| chart.preimage(edge.curve.point(t), None))
                .all(|found| found.distance <= OFF * size && at_end(found.uv))
        });
        on_ends.then(|| surface.clone())
    }

    /// Triangles that leave the faces by at most about `deviation` of the size, doubled up to eight times until there are
    /// `enough`.
    #[must_use]
    pub fn triangulated(&self, deviation: f64, enough: usize) -> BrepMesh {
        let sewn = self.sewn();
        let size = sewn.size();
        let charts: Vec<Chart<'_>> = sewn.faces.iter().map(|face| Chart::new(&face.surface, size)).collect();
        let mut deviation = deviation * size;
        for _ in 0..8 {
            if let Some(mesh) = sewn.mesh((&charts, size), deviation, enough) {
                return mesh;
            }
            deviation *= 2.0;
        }
        let too_many =
            |face: usize| FaceFault { face, why: "it bends so often that too many triangles would follow it" };
        sewn.mesh((&charts, size), deviation, 4 * enough).unwrap_or_else(|| BrepMesh {
            meshes: [TriangleMesh::default(), TriangleMesh::default()],
            deviation,
            faults: (0..self.faces.len()).map(too_many).collect(),
        })
    }

    /// The meshes of a deviation \[m\], by the charts of the faces and the size of the body; none where there would be more
    /// than `enough` triangles.
    fn mesh(&self, (charts, size): (&[Chart<'_>], f64), deviation: f64, enough: usize) -> Option<BrepMesh> {
        let mut sites: Vec<Vec<f64>> = self.edges.iter().map(|edge| sites(edge, deviation)).collect();
        let count = |sites: &[Vec<f64>]| sites.iter().map(Vec::len).fold(0, usize::saturating_add);
        if count(&sites) > enough {
            return None;
        }
        let mut samples = Samples::of(&self.vertices, &self.edges, &sites);
        let mut lines = Vec::with_capacity(charts.len());
        let mut parts: Vec<Vec<usize>> = sites.iter().map(|sites| vec![1; sites.len() - 1]).collect();
        let mut cells = 0;
        for (face, chart) in self.faces.iter().zip(charts) {
            let found = Outline::of(face, chart, &mut samples, OFF * size).map(|outline| {
                let lines = grid_lines(chart, outline.bounds(), deviation);
                outline.crossed(&lines, &mut parts);
                lines
            });
            cells += found.as_ref().map_or(0, |[us, vs]| 2 * (us.len() - 1) * (vs.len() - 1));
            lines.push(found);
        }
        if cells > enough {
            return None;
        }
        for (sites, parts) in sites.iter_mut().zip(&parts) {
            let old = std::mem::take(sites);
            for (w, &count) in old.windows(2).zip(parts) {
                sites.extend((0..count).map(|k| w[0] + (w[1] - w[0]) * k as f64 / count as f64));
            }
            sites.extend(old.last());
        }
        if count(&sites) > enough {
            return None;
        }
        let mut samples = Samples::of(&self.vertices, &self.edges, &sites);
        let (mut coarse, mut fine, mut faults) = (Vec::new(), Vec::new(), Vec::new());
        for (k, (face, chart)) in self.faces.iter().zip(charts).enumerate() {
            let found = Outline::of(face, chart, &mut samples, OFF * size).and_then(|outline| {
                let lines = lines[k].as_ref().map_err(|why| *why)?;
                Patch::of(outline.refined(lines, chart, &mut samples), lines)
            });
            match found {
                Ok(patch) => patch.triangles(chart, &samples, &mut coarse, &mut fine),
                Err(why) => faults.push(FaceFault { face: k, why }),
            }
        }
        if coarse.len() > enough.saturating_mul(2) {
            return None;
        }
        let meshes = [coarse, fine].map(|list| TriangleMesh::from_corners(list.into_iter()));
        Some(BrepMesh { meshes, deviation, faults })
    }
}

/// The lines of a grid over the part of a surface between bounds of its parameters.
fn grid_lines(chart: &Chart<'_>, [low, high]: [[f64; 2]; 2], deviation: f64) -> [Vec<f64>; 2] {
    let range = |axis: usize| [low[axis], high[axis]];
    if matches!(chart.surface, FaceSurface::Plane { .. }) {
        return [0, 1].map(|axis| range(axis).to_vec());
    }
    let breaks = [0, 1].map(|axis| chart.breaks(axis, range(axis)));
    Bends::of(|us, vs| chart.grid(us, vs), breaks).lines(deviation, 1)
}
