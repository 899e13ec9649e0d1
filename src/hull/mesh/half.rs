//! Triangles of half a body that can be changed: edges flipped, split and collapsed, vertices moved, without opening it.

use super::Region;
use super::body::{Body, Form, Site};
use crate::spline::{cross, dot, length, minus};

/// Edges along which the surface bends little are longer than those across by at most this.
const STRETCH: f64 = 3.5;

/// Half-breadth between the edges of the side, at least, over the deviation: what touches the centreplane there would
/// belong to both sides.
const LIFT: f64 = 1e-3;

/// A triangle: its face, and its corners, normals outward.
pub(super) type Face = (Region, [usize; 3]);

/// The port half of a closed mesh. Vertices with y = 0 are on the centreplane, where it is open.
pub(super) struct Half<'a> {
    pub(super) body: &'a Body<'a>,
    pub(super) points: Vec<[f64; 3]>,
    pub(super) sites: Vec<Site>,
    /// Wanted lengths of edges \[m\].
    pub(super) sizes: Vec<f64>,
    /// How much of the curvature is seen along an edge.
    pub(super) forms: Vec<Form>,
    /// Triangles; none where one was taken out.
    pub(super) faces: Vec<Option<Face>>,
    /// Places of triangles that were taken out.
    pub(super) free: Vec<usize>,
    /// Triangles at each vertex.
    pub(super) around: Vec<Vec<usize>>,
    /// Half of the tolerance \[m\].
    pub(super) deviation: f64,
    /// What changes may leave the surface by \[m\].
    pub(super) allowed: f64,
}

/// The sine of the least angle of a triangle, and which corner has it.
pub(super) fn least_sine([a, b, c]: [[f64; 3]; 3]) -> (f64, usize) {
    let sides = [minus(c, b), minus(a, c), minus(b, a)];
    let squares = sides.map(|s| dot(s, s));
    // The least angle is opposite the shortest side.
    let least = (0..3).fold(0, |k, other| if squares[other] < squares[k] { other } else { k });
    let (p, q) = (sides[(least + 1) % 3], sides[(least + 2) % 3]);
    let sides = (squares[(least + 1) % 3] * squares[(least + 2) % 3]).sqrt();
    (if sides > 0.0 { length(cross(p, q)) / sides } else { 0.0 }, least)
}

pub(super) fn doubled([a, b, c]: [[f64; 3]; 3]) -> [f64; 3] {
    cross(minus(b, a), minus(c, a))
}

impl Half<'_> {
    pub(super) fn corners(&self, [a, b, c]: [usize; 3]) -> [[f64; 3]; 3] {
        [self.points[a], self.points[b], self.points[c]]
    }

    /// The sine of the least angle of a triangle: it rises with the angle, which is at most 60 degrees.
    pub(super) fn sine(&self, triangle: [usize; 3]) -> f64 {
        least_sine(self.corners(triangle)).0
    }

    pub(super) fn distance(&self, a: usize, b: usize) -> f64 {
        length(minus(self.points[a], self.points[b]))
    }

    /// The length of an edge over the wanted one, which is greater where the surface bends little along it.
    pub(super) fn relative_length(&self, a: usize, b: usize) -> f64 {
        let edge = minus(self.points[b], self.points[a]);
        let squared = dot(edge, edge);
        let along = |form: &Form| (0..3).map(|r| edge[r] * dot(form[r], edge)).sum::<f64>();
        let share = 0.5 * (along(&self.forms[a]) + along(&self.forms[b]));
        let stretched = share.max(squared / (STRETCH * STRETCH)).min(squared);
        stretched.sqrt() / (0.5 * (self.sizes[a] + self.sizes[b]))
    }

    /// A point between the edges of the side, where both sides may not touch.
    pub(super) fn lifted(&self, [x, y, z]: [f64; 3]) -> [f64; 3] {
        [x, y.max(LIFT * self.deviation), z]
    }

    pub(super) fn on_centreplane(&self, v: usize) -> bool {
        self.points[v][1] <= 0.0
    }

    pub(super) fn push(&mut self, face: Face) {
        let place = self.free.pop().unwrap_or_else(|| {
            self.faces.push(None);
            self.faces.len() - 1
        });
        for v in face.1 {
            self.around[v].push(place);
        }
        self.faces[place] = Some(face);
    }

    pub(super) fn take(&mut self, face: usize) {
        if let Some((_, corners)) = self.faces[face].take() {
            for v in corners {
                self.around[v].retain(|&other| other != face);
            }
            self.free.push(face);
        }
    }

    /// Triangles that there are.
    pub(super) fn count(&self) -> usize {
        self.faces.len() - self.free.len()
    }

    pub(super) fn push_vertex(&mut self, point: [f64; 3], site: Site, size: f64, form: Form) -> usize {
        self.points.push(point);
        self.sites.push(site);
        self.sizes.push(size);
        self.forms.push(form);
        self.around.push(Vec::new());
        self.points.len() - 1
    }

    /// The triangles at an edge: at most two, and how many there are.
    pub(super) fn beside(&self, a: usize, b: usize) -> ([usize; 2], usize) {
        let (mut found, mut count) = ([usize::MAX; 2], 0);
        for &f in &self.around[a] {
            if self.faces[f].is_some_and(|(_, corners)| corners.contains(&b)) {
                if count < 2 {
                    found[count] = f;
                }
                count += 1;
            }
        }
        (found, count)
    }

    /// Vertices that share an edge with one.
    pub(super) fn ring(&self, v: usize) -> Vec<usize> {
        let mut list = Vec::with_capacity(12);
        for &f in &self.around[v] {
            for other in self.faces[f].map_or([v; 3], |(_, corners)| corners) {
                if other != v && !list.contains(&other) {
                    list.push(other);
                }
            }
        }
        list
    }

    /// Whether an edge is one of the body: between two faces, on the centreplane, or a crease of the side.
    pub(super) fn is_feature(&self, a: usize, b: usize) -> bool {
        let ([f, g], count) = self.beside(a, b);
        if count != 2 {
            return true;
        }
        let region = |k: usize| self.faces[k].map_or(Region::Hull, |(region, _)| region);
        region(f) != region(g) || (region(f) == Region::Hull && self.body.is_crease(&self.sites[a], &self.sites[b]))
    }

    /// The ends of the edges of the body at a vertex.
    pub(super) fn feature_ring(&self, v: usize) -> Vec<usize> {
        self.ring(v).into_iter().filter(|&other| self.is_feature(v, other)).collect()
    }

    /// The triangle of a corner order in which `a` is followed by `b`, and its third corner.
    pub(super) fn third(&self, face: usize, a: usize, b: usize) -> Option<(bool, usize)> {
        let (_, corners) = self.faces[face]?;
        let at = corners.iter().position(|&v| v == a)?;
        let (next, last) = (corners[(at + 1) % 3], corners[(at + 2) % 3]);
        if next == b { Some((true, last)) } else { (last == b).then_some((false, next)) }
    }

    /// Places of corners on their patch.
    fn places(&self, (region, corners): Face) -> [[f64; 2]; 3] {
        let sites = corners.map(|v| self.body.site_on(&self.sites[v], region, self.on_centreplane(v)));
        let sure: Vec<[f64; 2]> = sites.iter().filter(|site| site.is_point()).map(Site::middle).collect();
        let list = if sure.is_empty() { sites.iter().map(Site::middle).collect() } else { sure };
        let mean = [0, 1].map(|k| list.iter().map(|place| place[k]).sum::<f64>() / list.len() as f64);
        sites.map(|site| site.nearest(mean))
    }

    /// What a triangle leaves the surface by along its normal \[m\], at its middle and at the middles of its sides.
    pub(super) fn off(&self, face: Face) -> f64 {
        self.off_at(face, |_, _| true)
    }

    /// The same at its middle and at the middles of those sides, from corner to next corner, that are wanted.
    pub(super) fn off_at(&self, face: Face, wanted: impl Fn(usize, usize) -> bool) -> f64 {
        let points = self.corners(face.1);
        let normal = doubled(points);
        let size = length(normal);
        if size <= 0.0 || matches!(face.0, Region::Bow | Region::Transom) {
            return 0.0;
        }
        let places = self.places(face);
        let at = |share: [f64; 3]| {
            let place = [0, 1].map(|k| (0..3).map(|j| share[j] * places[j][k]).sum::<f64>());
            let flat = [0, 1, 2].map(|k| (0..3).map(|j| share[j] * points[j][k]).sum::<f64>());
            dot(minus(self.body.point(face.0, place), flat), normal).abs() / size
        };
        let sides = (0..3).filter(|&k| wanted(face.1[k], face.1[(k + 1) % 3])).map(|k| {
            let mut share = [0.5; 3];
            share[(k + 2) % 3] = 0.0;
            at(share)
        });
        sides.fold(at([1.0 / 3.0; 3]), f64::max)
    }
}
