//! The body of a hull as a polysurface of untrimmed faces that share their edges, in an archive of version 5.

use super::super::CadUnit;
use super::chunks::{Archive, class, code};
use crate::exchange::manifest::sha256;
use crate::hull::{Region, Solid, SolidFace};
use crate::spline::{BsplineCurve, BsplineSurface, length, minus};

/// Version of the archive, of Rhino 5 and later, and of the toolkit that its records follow: a day, and the version.
const VERSION: &str = "3D Geometry File Format       50";
const TOOLKIT: i64 = 201_401_155;

/// Kinds of objects, trims and loops.
const POLYSURFACE: i64 = 16;
const MATED: i32 = 2;
const SEAM: i32 = 3;
const SINGULAR: i32 = 4;
const OUTER: i32 = 1;

/// What edges may leave the faces by \[m\].
const TOLERANCE: f64 = 1e-9;

/// Points nearer to each other than this part of the size are one.
const SAME: f64 = 1e-8;

/// A side of a surface by the numbers that trims have for it: along u at least and greatest v, along v at greatest and
/// least u.
const SIDES: [Side; 4] = [
    Side { number: 4, along: 0, at: 0, forward: true },
    Side { number: 5, along: 1, at: 1, forward: true },
    Side { number: 6, along: 0, at: 1, forward: false },
    Side { number: 3, along: 1, at: 0, forward: false },
];

/// One of the four sides of a surface as a loop with the inside to its left runs along it.
#[derive(Clone, Copy)]
struct Side {
    /// Its number in the format.
    number: i32,
    /// The parameter that runs: 0 u, 1 v.
    along: usize,
    /// The end of the other parameter.
    at: usize,
    /// Whether the parameter grows.
    forward: bool,
}

/// A piece of the loop of a face in the parameters of its surface.
struct Trim {
    /// Edge and whether it is run forward; none where the side is a point.
    edge: Option<(usize, bool)>,
    /// The vertices where it begins and ends.
    ends: [usize; 2],
    /// The parameters where it begins and ends.
    from: [f64; 2],
    to: [f64; 2],
    side: i32,
    face: usize,
}

/// A side with its curve and the ends of its parameter in the direction of the loop.
struct Run {
    side: Side,
    curve: BsplineCurve<3>,
    other: f64,
    breaks: Vec<f64>,
}

impl Run {
    fn of(surface: &BsplineSurface<3>, side: Side) -> Self {
        let (u, v) = (surface.u().domain(), surface.v().domain());
        let pick = |(a, b): (f64, f64)| if side.at == 0 { a } else { b };
        let other = pick(if side.along == 0 { v } else { u });
        let curve = if side.along == 0 { surface.curve_at_v(other) } else { surface.curve_at_u(other) };
        let mut breaks = curve.knots().breakpoints();
        if !side.forward {
            breaks.reverse();
        }
        Self { side, curve, other, breaks }
    }

    fn parameters(&self, t: f64) -> [f64; 2] {
        if self.side.along == 0 { [t, self.other] } else { [self.other, t] }
    }

    fn is_point(&self, same: f64) -> bool {
        let first = self.curve.points()[0];
        self.curve.points().iter().all(|&point| length(minus(point, first)) <= same)
    }
}

/// The trims of a face whose first edge begins on one of its sides; none where it does not.
fn trims_from(first: usize, solid: &Solid, (number, face): (usize, &SolidFace), same: f64) -> Option<Vec<Trim>> {
    let ends = |(edge, along): (usize, bool)| {
        let edge = &solid.edges[edge];
        if along { [edge.from, edge.to] } else { [edge.to, edge.from] }
    };
    let near = |a: [f64; 3], b: [f64; 3]| length(minus(a, b)) <= same;
    let middle = |edge: usize| {
        let curve = &solid.edges[edge].curve;
        let (a, b) = curve.knots().domain();
        curve.eval(0.5 * (a + b))
    };
    let mut edges = face.boundary.iter().copied().peekable();
    let mut vertex = ends(*face.boundary.first()?)[0];
    let mut trims = Vec::new();
    for side in (0..4).map(|k| SIDES[(first + k) % 4]) {
        let run = Run::of(&face.surface, side);
        let last = run.breaks.len() - 1;
        let mut add = |edge, ends, from: f64, to: f64| {
            let [from, to] = [from, to].map(|t| run.parameters(t));
            trims.push(Trim { edge, ends, from, to, side: side.number, face: number });
        };
        if run.is_point(same) {
            add(None, [vertex; 2], run.breaks[0], run.breaks[last]);
            continue;
        }
        let mut at = 0;
        while at < last {
            let edge = edges.next()?;
            let [from, to] = ends(edge);
            let point = |k: usize| run.curve.eval(run.breaks[k]);
            let end = (at + 1..=last).find(|&k| {
                let half = run.curve.eval(0.5 * (run.breaks[at] + run.breaks[k]));
                near(point(k), solid.vertices[to]) && near(half, middle(edge.0))
            })?;
            if from != vertex || !near(point(at), solid.vertices[from]) {
                return None;
            }
            add(Some(edge), [from, to], run.breaks[at], run.breaks[end]);
            (at, vertex) = (end, to);
        }
    }
    edges.peek().is_none().then_some(trims)
}

fn bounds<'a>(points: impl Iterator<Item = &'a [f64; 3]>) -> [[f64; 3]; 2] {
    points.fold([[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]], |[low, high], p| {
        [[0, 1, 2].map(|k| f64::min(low[k], p[k])), [0, 1, 2].map(|k| f64::max(high[k], p[k]))]
    })
}

/// Knots as the format has them, without the first and the last.
fn knots(archive: &mut Archive, knots: &[f64]) {
    archive.count(knots.len() - 2);
    archive.reals(&knots[1..knots.len() - 1]);
}

/// A list of things in a chunk of its own.
fn list<T>(archive: &mut Archive, all: &[T], mut put: impl FnMut(&mut Archive, usize, &T)) {
    archive.chunk(code::ANONYMOUS, |archive| {
        archive.byte(0x10);
        archive.count(all.len());
        all.iter().enumerate().for_each(|(k, one)| put(archive, k, one));
    });
}

/// Objects of classes in a chunk of their own.
fn objects<T>(archive: &mut Archive, class: [u8; 16], all: &[T], data: impl Fn(&mut Archive, &T)) {
    list(archive, all, |archive, _, one| {
        archive.int(1);
        archive.object(class, |archive| data(archive, one));
    });
}

/// A body with its trims.
struct Body<'a> {
    solid: &'a Solid,
    trims: Vec<Trim>,
    scale: f64,
}

impl<'a> Body<'a> {
    fn new(solid: &'a Solid, scale: f64) -> Result<Self, String> {
        let [low, high] = bounds(solid.vertices.iter());
        let same = SAME * length(minus(high, low));
        let mut trims = Vec::new();
        for (k, face) in solid.faces.iter().enumerate() {
            let found = (0..4).find_map(|first| trims_from(first, solid, (k, face), same));
            trims.extend(found.ok_or_else(|| format!("the edges of the face {} are not its sides", face.name))?);
        }
        Ok(Self { solid, trims, scale })
    }

    fn point(&self, archive: &mut Archive, point: [f64; 3]) {
        archive.reals(&point.map(|c| c * self.scale));
    }

    fn curve(&self, archive: &mut Archive, curve: &BsplineCurve<3>) {
        archive.byte(0x10);
        let degree = curve.knots().degree();
        archive.int(3);
        archive.int(0);
        archive.count(degree + 1);
        archive.count(curve.points().len());
        archive.put(&[0; 8]);
        archive.reals(&[0.0; 6]);
        knots(archive, curve.knots().knots());
        archive.count(curve.points().len());
        curve.points().iter().for_each(|&point| self.point(archive, point));
    }

    fn surface(&self, archive: &mut Archive, surface: &BsplineSurface<3>) {
        archive.byte(0x10);
        archive.int(3);
        archive.int(0);
        [surface.u(), surface.v()].iter().for_each(|knots| archive.count(knots.degree() + 1));
        surface.shape().iter().for_each(|&count| archive.count(count));
        archive.put(&[0; 8]);
        archive.reals(&[0.0; 6]);
        knots(archive, surface.u().knots());
        knots(archive, surface.v().knots());
        archive.count(surface.points().len());
        surface.points().iter().for_each(|&point| self.point(archive, point));
    }

    fn vertices(&self, archive: &mut Archive) {
        let mut edges = vec![Vec::new(); self.solid.vertices.len()];
        for (k, edge) in self.solid.edges.iter().enumerate() {
            edges[edge.from].push(k);
            edges[edge.to].push(k);
        }
        list(archive, &self.solid.vertices, |archive, k, &vertex| {
            archive.count(k);
            self.point(archive, vertex);
            archive.indices(&edges[k]);
            archive.reals(&[TOLERANCE * self.scale]);
        });
    }

    /// The trims of each edge.
    fn uses(&self) -> Vec<Vec<usize>> {
        let mut uses = vec![Vec::new(); self.solid.edges.len()];
        for (k, trim) in self.trims.iter().enumerate() {
            trim.edge.iter().for_each(|(edge, _)| uses[*edge].push(k));
        }
        uses
    }

    fn edges(&self, archive: &mut Archive, uses: &[Vec<usize>]) {
        list(archive, &self.solid.edges, |archive, k, edge| {
            let (a, b) = edge.curve.knots().domain();
            archive.count(k);
            archive.count(k);
            archive.int(0);
            archive.reals(&[a, b]);
            archive.count(edge.from);
            archive.count(edge.to);
            archive.indices(&uses[k]);
            archive.reals(&[TOLERANCE * self.scale, a, b]);
        });
    }

    fn trims(&self, archive: &mut Archive, uses: &[Vec<usize>]) {
        list(archive, &self.trims, |archive, k, trim| {
            let kind = match trim.edge {
                None => SINGULAR,
                Some((edge, _)) if uses[edge].iter().all(|&other| self.trims[other].face == trim.face) => SEAM,
                Some(_) => MATED,
            };
            archive.count(k);
            archive.count(k);
            archive.reals(&[0.0, 1.0]);
            archive.int(trim.edge.map_or(-1, |(edge, _)| i32::try_from(edge).unwrap_or(i32::MAX)));
            trim.ends.iter().for_each(|&end| archive.count(end));
            archive.int(i32::from(trim.edge.is_some_and(|(_, along)| !along)));
            archive.int(kind);
            archive.int(trim.side);
            archive.count(trim.face);
            archive.reals(&[0.0, 0.0, 0.0, 1.0]);
            archive.put(&[0; 32]);
            archive.reals(&[0.0, TOLERANCE * self.scale]);
        });
    }

    fn loops(&self, archive: &mut Archive) {
        let mut own = vec![Vec::new(); self.solid.faces.len()];
        self.trims.iter().enumerate().for_each(|(k, trim)| own[trim.face].push(k));
        list(archive, &own, |archive, k, trims| {
            archive.count(k);
            archive.indices(trims);
            archive.int(OUTER);
            archive.count(k);
        });
    }

    /// The data of the polysurface.
    fn data(&self, archive: &mut Archive) {
        let (solid, uses) = (self.solid, self.uses());
        archive.byte(0x32);
        objects(archive, class::LINE_CURVE, &self.trims, |archive, Trim { from, to, .. }| {
            archive.byte(0x10);
            archive.reals(&[from[0], from[1], 0.0, to[0], to[1], 0.0, 0.0, 1.0]);
            archive.int(2);
        });
        objects(archive, class::NURBS_CURVE, &solid.edges, |archive, edge| self.curve(archive, &edge.curve));
        objects(archive, class::NURBS_SURFACE, &solid.faces, |archive, face| self.surface(archive, &face.surface));
        self.vertices(archive);
        self.edges(archive, &uses);
        self.trims(archive, &uses);
        self.loops(archive);
        list(archive, &solid.faces, |archive, k, _| {
            archive.count(k);
            archive.indices(&[k]);
            archive.count(k);
            archive.int(0);
            archive.int(0);
        });
        let points = solid.faces.iter().flat_map(|face| face.surface.points());
        bounds(points).iter().for_each(|&corner| self.point(archive, corner));
        // No meshes of the faces, neither to render nor to analyse.
        (0..2).for_each(|_| archive.chunk(code::ANONYMOUS, |archive| archive.put(&vec![0; solid.faces.len()])));
        // Closed, with its normals outward.
        archive.int(1);
    }
}

/// An identifier that the contents alone decide (RFC 9562, version 8).
fn identifier(text: &str) -> [u8; 16] {
    let digits = sha256(text.as_bytes());
    let mut id = [0; 16];
    for (byte, pair) in id.iter_mut().zip(digits.as_bytes().chunks(2)) {
        *byte = std::str::from_utf8(pair).ok().and_then(|pair| u8::from_str_radix(pair, 16).ok()).unwrap_or(0);
    }
    (id[7], id[8]) = (0x80 | id[7] & 0x0f, 0x80 | id[8] & 0x3f);
    id
}

/// The record of a visible layer of a colour, the first one.
fn layer(archive: &mut Archive, name: &str, [red, green, blue]: [u8; 3]) {
    archive.byte(0x18);
    archive.int(0);
    archive.int(0);
    archive.int(-1);
    archive.int(-1);
    archive.int(0);
    archive.put(&[red, green, blue, 0]);
    archive.put(&[0; 4]);
    archive.reals(&[0.0, 1.0]);
    archive.text(name);
    archive.byte(1);
    archive.int(-1);
    archive.put(&[0xff; 4]);
    archive.reals(&[0.0]);
    archive.byte(0);
    archive.put(&identifier(&format!("layer {name}")));
    archive.put(&[0; 16]);
    archive.byte(1);
    archive.chunk(code::ANONYMOUS, |archive| [1, 0, 0].iter().for_each(|&number| archive.int(number)));
    archive.put(&[0; 16]);
}

/// Unit and tolerances of the model.
fn units(archive: &mut Archive, unit: CadUnit) {
    archive.int(102);
    archive.int(match unit {
        CadUnit::Metre => 4,
        CadUnit::Millimetre => 2,
    });
    archive.reals(&[1e-6 * unit.in_a_metre(), 1f64.to_radians(), 0.01]);
    archive.int(0);
    archive.int(3);
    archive.reals(&[1.0 / unit.in_a_metre()]);
    archive.text("");
}

/// Bytes of a 3DM file of version 5 of the solid: one closed polysurface with its name on the layer `hull`, in metres or
/// millimetres; its faces have the nets and knots of the solid.
///
/// # Errors
/// The edges of a face are not the sides of its surface.
pub fn write_3dm(solid: &Solid, name: &str, unit: CadUnit) -> Result<Vec<u8>, String> {
    let body = Body::new(solid, unit.in_a_metre())?;
    let mut archive = Archive::default();
    archive.put(VERSION.as_bytes());
    archive.chunk(code::COMMENT, |archive| {
        archive.put(concat!("loftsman ", env!("CARGO_PKG_VERSION"), "\n\u{1a}\0").as_bytes());
    });
    archive.table(code::PROPERTIES, |archive| archive.short(code::TOOLKIT, TOOLKIT));
    archive.table(code::SETTINGS, |archive| archive.chunk(code::UNITS, |archive| units(archive, unit)));
    for table in [code::BITMAPS, code::TEXTURE_MAPPINGS, code::MATERIALS, code::LINE_TYPES] {
        archive.table(table, |_| {});
    }
    archive.table(code::LAYERS, |archive| {
        archive.chunk(code::LAYER, |archive| {
            archive.object(class::LAYER, |archive| layer(archive, Region::Hull.name(), [0, 89, 140]));
        });
    });
    let empty =
        [code::GROUPS, code::FONTS, code::DIMENSION_STYLES, code::LIGHTS, code::HATCH_PATTERNS, code::DEFINITIONS];
    for table in empty {
        archive.table(table, |_| {});
    }
    archive.table(code::OBJECTS, |archive| {
        archive.chunk(code::OBJECT, |archive| {
            archive.short(code::OBJECT_KIND, POLYSURFACE);
            archive.object(class::BREP, |archive| body.data(archive));
            archive.chunk(code::OBJECT_ATTRIBUTES, |archive| {
                archive.byte(0x20);
                archive.put(&identifier(&format!("object {name}")));
                archive.int(0);
                if !name.is_empty() {
                    archive.byte(1);
                    archive.text(name);
                }
                archive.byte(0);
            });
            archive.short(code::OBJECT_END, 0);
        });
    });
    archive.table(code::HISTORY, |_| {});
    Ok(archive.finish())
}
