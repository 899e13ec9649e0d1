//! The faces of a DXF file as triangles: 3DFACE, polyface and polygon meshes (POLYLINE), and the base faces of MESH.

use super::super::super::fault::Faults;
use super::super::surfaces::MOST_POINTS;
use super::curves::{Bulged, bulged, upright};
use super::groups::Record;
use crate::hull::Motion;

/// A triangle by its corners.
pub(super) type Corners = [[f64; 3]; 3];

/// What an entity draws.
#[derive(Debug)]
pub(super) enum Drawn {
    Curve(Vec<[f64; 3]>),
    Faces(Vec<Corners>),
}

/// A face as triangles from its first corner.
fn fan(corners: &[[f64; 3]], into: &mut Vec<Corners>) {
    into.extend((2..corners.len()).map(|k| [corners[0], corners[k - 1], corners[k]]));
}

/// A face of three or four corners.
pub(super) fn face(record: &Record<'_>, faults: &mut Faults) -> Vec<Corners> {
    let mut corners: Vec<[f64; 3]> = (10..14).filter_map(|code| record.point(code, faults)).collect();
    corners.dedup();
    let mut list = Vec::new();
    fan(&corners, &mut list);
    list
}

/// A mesh of faces over vertices: its base, and how many times its program subdivides it.
pub(super) fn mesh(record: &Record<'_>, faults: &mut Faults) -> (Vec<Corners>, i64) {
    let (mut vertices, mut list): (Vec<[f64; 3]>, Vec<i64>) = (Vec::new(), Vec::new());
    // Groups 90 follow a count of theirs: 93 of faces, 94 of edges.
    let (mut in_faces, mut in_vertices, mut level) = (false, false, 0);
    for group in &record.groups {
        match group.code {
            91 if vertices.is_empty() => level = group.whole(faults),
            92 => in_vertices = true,
            93 => (in_faces, in_vertices) = (true, false),
            94 => in_faces = false,
            90 if in_faces => list.push(group.whole(faults)),
            10 if in_vertices => vertices.push([group.real(faults), 0.0, 0.0]),
            20 | 30 if in_vertices => {
                let axis = if group.code == 20 { 1 } else { 2 };
                if let Some(last) = vertices.last_mut() {
                    last[axis] = group.real(faults);
                }
            }
            _ => {}
        }
    }
    let (mut triangles, mut at) = (Vec::new(), 0);
    while at < list.len() {
        let count = usize::try_from(list[at]).unwrap_or(usize::MAX);
        let Some(places) = list.get(at + 1..(at + 1).saturating_add(count)) else {
            let message = format!("a face of {} corners, {} numbers there", list[at], list.len() - at - 1);
            faults.add(record.line(), "MESH", message);
            break;
        };
        let corner = |place: &i64| usize::try_from(*place).ok().and_then(|place| vertices.get(place).copied());
        match places.iter().map(corner).collect::<Option<Vec<_>>>() {
            Some(corners) => fan(&corners, &mut triangles),
            None => {
                let message = format!("a face of a vertex that is not there; there are {}", vertices.len());
                faults.add(record.line(), "MESH", message);
                break;
            }
        }
        at += 1 + count;
    }
    (triangles, level)
}

/// A vertex of a polyline.
#[derive(Debug)]
struct Vertex {
    point: [f64; 3],
    bulge: f64,
    flags: i64,
    /// Numbers of the vertices of a face, from 1, negative before an edge that is not seen.
    places: [i64; 4],
    line: Option<usize>,
}

/// A polyline whose vertices are records of their own.
#[derive(Debug)]
pub(super) struct Polyline {
    flags: i64,
    /// Vertices in the two directions of a mesh, and those of the surface fitted to them.
    counts: [i64; 2],
    fitted: [i64; 2],
    height: f64,
    place: Motion,
    vertices: Vec<Vertex>,
    line: Option<usize>,
}

/// Flags of polylines.
const CLOSED: i64 = 1;
const SPLINED: i64 = 4;
const IN_SPACE: i64 = 8;
const MESH: i64 = 16;
const CLOSED_ACROSS: i64 = 32;
const POLYFACE: i64 = 64;

/// Flags of vertices: on a fitted spline; of its control frame; a face of a polyface mesh where [`PLACED`] is not set.
const ON_SPLINE: i64 = 8;
const OF_FRAME: i64 = 16;
const PLACED: i64 = 64;
const OF_POLYFACE: i64 = 128;

impl Polyline {
    pub(super) fn begin(record: &Record<'_>, faults: &mut Faults) -> Self {
        let [m, n, fitted_m, fitted_n] = [71, 72, 73, 74].map(|code| record.whole(code, faults));
        Self {
            flags: record.whole(70, faults),
            counts: [m, n],
            fitted: [fitted_m, fitted_n],
            height: record.real(30, 0.0, faults),
            place: upright(record, faults),
            vertices: Vec::new(),
            line: record.line(),
        }
    }

    pub(super) fn add(&mut self, record: &Record<'_>, faults: &mut Faults) {
        self.vertices.push(Vertex {
            point: record.point(10, faults).unwrap_or_default(),
            bulge: record.real(42, 0.0, faults),
            flags: record.whole(70, faults),
            places: [71, 72, 73, 74].map(|code| record.whole(code, faults)),
            line: record.line(),
        });
    }

    /// Whether it is a curve of more points than a drawing has.
    pub(super) fn is_too_long(&self) -> bool {
        self.flags & (MESH | POLYFACE) == 0 && self.vertices.len() > MOST_POINTS
    }

    /// What it draws.
    pub(super) fn finish(self, faults: &mut Faults) -> Drawn {
        if self.flags & POLYFACE != 0 {
            return Drawn::Faces(self.polyface(faults));
        }
        if self.flags & MESH != 0 {
            return Drawn::Faces(self.grid(faults));
        }
        // The frame of a spline is no part of it.
        let splined = self.flags & SPLINED != 0 && self.vertices.iter().any(|v| v.flags & ON_SPLINE != 0);
        let drawn = || self.vertices.iter().filter(|v| !splined || v.flags & OF_FRAME == 0);
        let closed = self.flags & CLOSED != 0;
        if self.flags & IN_SPACE != 0 {
            let mut points: Vec<[f64; 3]> = drawn().map(|v| v.point).collect();
            points.extend(points.first().copied().filter(|_| closed));
            return Drawn::Curve(points);
        }
        let plane: Vec<Bulged> = drawn().map(|v| ([v.point[0], v.point[1]], v.bulge)).collect();
        Drawn::Curve(bulged(&plane, closed, self.height, &self.place))
    }

    fn polyface(&self, faults: &mut Faults) -> Vec<Corners> {
        let is_face = |v: &&Vertex| v.flags & OF_POLYFACE != 0 && v.flags & PLACED == 0;
        let points: Vec<[f64; 3]> = self.vertices.iter().filter(|v| !is_face(v)).map(|v| v.point).collect();
        let mut list = Vec::new();
        for vertex in self.vertices.iter().filter(is_face) {
            let places = vertex.places.iter().filter(|place| **place != 0);
            let corner = |place: &i64| points.get(usize::try_from(place.unsigned_abs()).ok()?.checked_sub(1)?).copied();
            match places.map(corner).collect::<Option<Vec<_>>>() {
                Some(corners) => fan(&corners, &mut list),
                None => {
                    let message = format!("a face of a vertex that is not there; there are {}", points.len());
                    faults.add(vertex.line, "VERTEX", message);
                }
            }
            if faults.is_full() {
                break;
            }
        }
        list
    }

    /// The quadrilaterals between rows and columns of vertices.
    fn grid(&self, faults: &mut Faults) -> Vec<Corners> {
        let smooth = self.flags & SPLINED != 0;
        let [rows, columns] = if smooth { self.fitted } else { self.counts }.map(|n| usize::try_from(n).unwrap_or(0));
        let kept = self.vertices.iter().filter(|v| !smooth || v.flags & OF_FRAME == 0);
        let points: Vec<[f64; 3]> = kept.map(|v| v.point).collect();
        if rows.checked_mul(columns) != Some(points.len()) {
            let message = format!("{} vertices of a mesh of {rows} by {columns}", points.len());
            faults.add(self.line, "POLYLINE", message);
            return Vec::new();
        }
        // Rows of no columns are as many as the file states.
        if points.is_empty() {
            return Vec::new();
        }
        let ends = [self.flags & CLOSED != 0, self.flags & CLOSED_ACROSS != 0];
        let spaces = |count: usize, closed: bool| if closed { count } else { count.saturating_sub(1) };
        let mut list = Vec::new();
        for i in 0..spaces(rows, ends[0]) {
            for j in 0..spaces(columns, ends[1]) {
                let at = |i: usize, j: usize| points[(i % rows) * columns + j % columns];
                fan(&[at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)], &mut list);
            }
        }
        list
    }
}
