//! Polysurfaces of an archive: surfaces inside loops of edges.

use super::archive::Versions;
use super::chunks::{class, code};
use super::cursor::{Cursor, Object};
use super::curves::{Budget, Run};
use super::surfaces::Patch;
use crate::hull::{Brep, BrepEdge, BrepFace};
use crate::spline::{length, minus};

/// Ends of edges nearer to their vertices than this part of the size of the body are there.
const AT_VERTEX: f64 = 1e-4;

/// A face that cannot be read: its number, the kind of its surface, and why.
pub(super) struct Lost {
    pub(super) number: usize,
    pub(super) kind: &'static str,
    pub(super) why: &'static str,
}

/// How the format calls a class.
pub(super) fn kind_of(class: [u8; 16]) -> &'static str {
    match class {
        class::NURBS_SURFACE => "ON_NurbsSurface",
        class::PLANE_SURFACE => "ON_PlaneSurface",
        class::REVOLVED_SURFACE => "ON_RevSurface",
        class::SUM_SURFACE => "ON_SumSurface",
        class::EXTRUSION => "ON_Extrusion",
        class::BREP => "ON_Brep",
        class::MESH => "ON_Mesh",
        _ => "surface of another class",
    }
}

/// An edge of the file.
struct Edge {
    curve: usize,
    reversed: bool,
    domain: [f64; 2],
    ends: [usize; 2],
}

/// A piece of a loop: its edge, or none, and whether it runs against it.
struct Trim {
    edge: Option<usize>,
    against: bool,
}

struct Face {
    loops: Vec<usize>,
    surface: usize,
    reversed: bool,
}

/// The lists of a polysurface.
struct Lists<'a> {
    curves: Vec<Option<Object<'a>>>,
    surfaces: Vec<Option<Object<'a>>>,
    vertices: Vec<[f64; 3]>,
    edges: Vec<Edge>,
    trims: Vec<Trim>,
    loops: Vec<Vec<usize>>,
    faces: Vec<Face>,
}

/// The objects of a list, in a chunk of its own.
fn objects<'a>(data: &mut Cursor<'a>) -> Option<Vec<Option<Object<'a>>>> {
    let mut inside = data.anonymous()?;
    let [1, _] = inside.version()? else { return None };
    let count = inside.count(4)?;
    let one = |inside: &mut Cursor<'a>| match inside.int()? {
        1 => inside.object().map(Some),
        _ => Some(None),
    };
    (0..count).map(|_| one(&mut inside)).collect()
}

/// The things of a list, each of some bytes at least, in a chunk of its own.
fn list<'a, T>(data: &mut Cursor<'a>, bytes: usize, one: impl Fn(&mut Cursor<'a>) -> Option<T>) -> Option<Vec<T>> {
    let mut inside = data.anonymous()?;
    let [1, _] = inside.version()? else { return None };
    let count = inside.count(bytes)?;
    (0..count).map(|_| one(&mut inside)).collect()
}

fn vertex(data: &mut Cursor<'_>) -> Option<[f64; 3]> {
    data.int()?;
    let point = data.reals()?;
    data.indices()?;
    data.take(8)?;
    Some(point)
}

/// Whether the records of trims and edges have what was added in June 2002.
fn has_domains(versions: Versions) -> bool {
    versions.archive >= 3 && versions.toolkit >= 200_206_180
}

fn edge(data: &mut Cursor<'_>, versions: Versions) -> Option<Edge> {
    data.int()?;
    let curve = usize::try_from(data.int()?).ok()?;
    let reversed = data.int()? != 0;
    let domain = data.reals()?;
    let ends = [data.int()?, data.int()?].map(|end| usize::try_from(end).unwrap_or(usize::MAX));
    data.indices()?;
    data.take(if has_domains(versions) { 24 } else { 8 })?;
    Some(Edge { curve, reversed, domain, ends })
}

fn trim(data: &mut Cursor<'_>) -> Option<Trim> {
    // Its number, its curve in the parameters and the domain of this.
    data.take(4 + 4 + 16)?;
    let edge = usize::try_from(data.int()?).ok();
    data.take(8)?;
    let against = data.int()? != 0;
    // Kind, side and loop, two tolerances, a domain with 32 bytes or two points, two tolerances.
    data.take(4 + 4 + 4 + 16 + 48 + 16)?;
    Some(Trim { edge, against })
}

fn ring(data: &mut Cursor<'_>) -> Option<Vec<usize>> {
    data.int()?;
    let trims = data.indices()?;
    data.take(8)?;
    Some(trims)
}

fn face(data: &mut Cursor<'_>) -> Option<Face> {
    data.int()?;
    let loops = data.indices()?;
    let surface = usize::try_from(data.int()?).ok()?;
    let reversed = data.int()? != 0;
    data.take(4)?;
    Some(Face { loops, surface, reversed })
}

impl<'a> Lists<'a> {
    fn read(mut data: Cursor<'a>, versions: Versions) -> Option<Self> {
        let [3, _] = data.version()? else { return None };
        // Curves in the parameters of the surfaces follow from the edges.
        data.inside(code::ANONYMOUS)?;
        let (curves, surfaces) = (objects(&mut data)?, objects(&mut data)?);
        Some(Self {
            curves,
            surfaces,
            vertices: list(&mut data, 40, vertex)?,
            edges: list(&mut data, 48, |data| edge(data, versions))?,
            trims: list(&mut data, 132, trim)?,
            loops: list(&mut data, 16, ring)?,
            faces: list(&mut data, 20, face)?,
        })
    }
}

impl Edge {
    /// The edge between its vertices, along its curve where the file has its parameters right.
    fn read(&self, run: &Run, vertices: &[[f64; 3]], size: f64) -> Option<BrepEdge> {
        let ends = self.ends;
        if ends.iter().any(|&end| end >= vertices.len()) {
            return None;
        }
        let mut range = self.domain.map(|t| run.parameter(t));
        if self.reversed {
            range.reverse();
        }
        let off = |k: usize| length(minus(run.curve.point(range[k]), vertices[ends[k]]));
        let fits = range[0].is_finite() && range[1].is_finite() && off(0).max(off(1)) <= AT_VERTEX * size;
        let edge = if fits {
            BrepEdge { ends, curve: run.curve.clone(), range }
        } else {
            BrepEdge::new(run.curve.clone(), ends, vertices, !self.reversed)
        };
        edge.range.iter().all(|t| t.is_finite()).then_some(edge)
    }
}

/// The loops of a face as edges of the body, so that its inside is to their left about its normal.
fn loops(lists: &Lists<'_>, face: &Face, edges: &[Option<usize>]) -> Option<Vec<Vec<(usize, bool)>>> {
    let of = |ring: &Vec<usize>| {
        let mut list = Vec::new();
        for &k in ring {
            let Trim { edge, against } = lists.trims.get(k)?;
            // A trim without an edge is a pole.
            let Some(edge) = edge else { continue };
            list.push(((*edges.get(*edge)?)?, against == &face.reversed));
        }
        if face.reversed {
            list.reverse();
        }
        Some(list)
    };
    face.loops.iter().map(|&k| of(lists.loops.get(k)?)).collect()
}

/// Adds the faces of a polysurface to a body, those that cannot be read to a list; none where its records cannot be read.
pub(super) fn read(
    object: &Object<'_>,
    versions: Versions,
    (body, lost): (&mut Brep, &mut Vec<Lost>),
    budget: &mut Budget,
) -> Option<()> {
    let lists = Lists::read(object.data.inside, versions)?;
    let first = body.vertices.len();
    let extent = |k: usize| {
        let ends =
            lists.vertices.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |e, p| [e[0].min(p[k]), e[1].max(p[k])]);
        ends[1] - ends[0]
    };
    let size = (0..3).map(extent).fold(0.0, f64::max);
    let runs: Vec<Option<Run>> = lists.curves.iter().map(|curve| budget.curve(curve.as_ref()?)).collect();
    let mut edges = Vec::with_capacity(lists.edges.len());
    for edge in &lists.edges {
        let run = runs.get(edge.curve).and_then(Option::as_ref);
        let made = run.and_then(|run| edge.read(run, &lists.vertices, size));
        edges.push(made.map(|made| {
            body.edges.push(BrepEdge { ends: made.ends.map(|end| first + end), ..made });
            body.edges.len() - 1
        }));
    }
    for (number, face) in lists.faces.iter().enumerate() {
        let source = lists.surfaces.get(face.surface).and_then(Option::as_ref);
        let kind = kind_of(source.map_or([0; 16], |object| object.class));
        let surface = source.and_then(|object| budget.surface(object));
        match (surface, loops(&lists, face, &edges)) {
            (None, _) => lost.push(Lost { number, kind, why: "its surface cannot be read" }),
            (_, None) => lost.push(Lost { number, kind, why: "its edges cannot be read" }),
            (Some(Patch { surface, swapped, .. }), Some(loops)) => {
                let part = body.faces.len();
                let left = Some(face.reversed == swapped);
                let name = format!("face {}", number + 1);
                body.faces.push(BrepFace { name, kind: kind.to_owned(), surface, loops, left, part });
            }
        }
    }
    body.vertices.extend(&lists.vertices);
    Some(())
}
