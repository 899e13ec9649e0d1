//! Bodies of triangles, or of surfaces, in their files: read, put into the ship's frame, cut into the sections of a
//! table.
//!
//! Units, scale, axes and origin are those of the conventions beside the file. Axes that are not given are found: the
//! length is the longest, the breadth is along the axis about whose zero the body is symmetric or on one side of which
//! it lies. Half a body is mirrored. Triangles are turned outward. Sections of a table lie at x = x_a + L (1 - cos(pi
//! k/n))/2, closer at the ends, and their points are thinned to [`THINNED`] of the breadth.

use std::f64::consts::PI;

use super::super::cad::{CadSurfaces, is_iges, is_step, read_iges, read_step};
use super::super::fault::RecordFault;
use super::super::mesh::{
    PanelBody, is_glb, is_nemoh, is_obj, is_stl, read_gdf, read_glb, read_nemoh, read_obj, read_pnl, read_stl,
};
use super::super::subdivision::{SubdivisionProject, is_fbm, is_ftm, read_fbm, read_ftm};
use super::outline::{Deck, point, take_off_deck};
use super::problem::{FilePosition, Problems};
use super::sections::{Body, Section, XOrigin, note_asymmetry, starboard_of, table};
use super::settings::{BodyFrame, Settings};
use super::{ReadTable, TableProblem, sidecar};
use crate::hull::{BodyPart, MeshLine, StatedParticulars, TriangleMesh};
use crate::spline::BsplineSurface;
use crate::units::counted;

/// What points of sections that are left out are off by at most, over the breadth.
const THINNED: f64 = 2e-5;

/// Spaces between the sections of a table.
const SECTIONS: usize = 40;

/// The first and the last section lie inside the body by this part of its length.
const INSIDE: f64 = 1e-5;

/// A body whose ends of an axis differ by less than this part of its size is symmetric about the zero of the axis.
const SYMMETRIC: f64 = 1e-3;

/// The middle of a body over its extent: up to the first athwartships, from the second on upwards, of one that is not quite
/// symmetric.
const NEARLY: f64 = 0.1;
const NOT_NEARLY: f64 = 0.5;

/// Corners of one side of a body this many times as far from the centreplane as its inner edge belong on it.
const MOVED: f64 = 1.5;

/// Points nearer to the centreplane than this part of the size of the body are on it.
const ON_CENTREPLANE: f64 = 1e-6;

/// What triangles leave surfaces by at most, over the longest extent of these.
const DEVIATION: f64 = 1e-5;

/// More triangles than this are made fewer by a deviation that is doubled.
const ENOUGH: usize = 150_000;

/// Faces and steps at which the subdivision of a net ends.
const FACES: usize = 60_000;
const STEPS: usize = 6;

/// Ends of sections of surfaces that are as near to each other as this part of the length are joined.
const SEAM: f64 = 2e-4;

/// A body in the ship's frame.
#[derive(Debug, Clone, PartialEq)]
pub struct ReadBody {
    /// Its name; empty when nothing gives it one.
    pub name: String,
    /// The triangles \[m\], both sides, turned outward; of surfaces twice, the second time with every edge halved.
    pub meshes: Vec<TriangleMesh>,
    /// What the conventions beside the file state.
    pub stated: StatedParticulars,
    /// Warnings and notes: axes, units, openings.
    pub notes: Vec<TableProblem>,
    /// Spaces between the sections of its table.
    sections: usize,
}

/// What stands in a file.
enum Shape {
    Triangles(TriangleMesh),
    Panels(PanelBody),
    Surfaces(CadSurfaces),
    Net(SubdivisionProject),
    /// What cannot be read.
    Nothing,
}

/// The kinds of files, with what reads them.
type BodyReader = fn(&[u8]) -> Result<Shape, Vec<RecordFault>>;

fn reader(name: &str, bytes: &[u8]) -> Option<(&'static str, BodyReader)> {
    let name = name.to_ascii_lowercase();
    let ends = |endings: &[&str]| endings.iter().any(|ending| name.ends_with(ending));
    if is_fbm(bytes) || ends(&[".fbm"]) {
        Some(("FREE!ship", |bytes| read_fbm(bytes).map(Shape::Net)))
    } else if is_ftm(bytes) || ends(&[".ftm"]) {
        Some(("FREE!ship", |bytes| read_ftm(bytes).map(Shape::Net)))
    } else if is_step(bytes) || ends(&[".step", ".stp"]) {
        Some(("STEP", |bytes| read_step(bytes).map(Shape::Surfaces)))
    } else if is_iges(bytes) || ends(&[".iges", ".igs"]) {
        Some(("IGES", |bytes| read_iges(bytes).map(Shape::Surfaces)))
    } else if ends(&[".stl"]) || is_stl(bytes) {
        Some(("STL", |bytes| read_stl(bytes).map(Shape::Triangles)))
    } else if is_glb(bytes) || ends(&[".glb"]) {
        Some(("GLB", |bytes| read_glb(bytes).map(Shape::Triangles)))
    } else if ends(&[".gdf"]) {
        Some(("GDF", |bytes| read_gdf(bytes).map(Shape::Panels)))
    } else if ends(&[".pnl"]) {
        Some(("PNL", |bytes| read_pnl(bytes).map(Shape::Panels)))
    } else if ends(&[".mar"]) || is_nemoh(bytes) {
        Some(("NEMOH", |bytes| read_nemoh(bytes).map(Shape::Panels)))
    } else if ends(&[".obj"]) || is_obj(bytes) {
        Some(("OBJ", |bytes| read_obj(bytes).map(Shape::Triangles)))
    } else {
        None
    }
}

/// Reads a body: triangles (STL, OBJ, GLB), panels (GDF, PNL, NEMOH), the surfaces of a CAD file (STEP, IGES) or a
/// control net (FREE!ship), by its content or its name, with the conventions of the TOML beside it, given by its name
/// and its text, and of others, each over those before it; none when it is no such file.
pub fn read_body<'a>(
    name: &str,
    bytes: &[u8],
    sidecar: impl IntoIterator<Item = (&'a str, &'a str)>,
) -> Option<Result<ReadBody, Vec<TableProblem>>> {
    let (kind, read) = reader(name, bytes)?;
    let mut problems = Problems::new(name);
    let mut settings = Settings::default();
    for (sidecar, text) in sidecar {
        sidecar::read(sidecar, text, &mut settings, &mut problems);
    }
    let shape = read(bytes).unwrap_or_else(|faults| {
        faulty(faults, &mut problems);
        Shape::Nothing
    });
    // Curves alone are a table.
    if let Shape::Surfaces(CadSurfaces { surfaces, .. }) = &shape
        && surfaces.is_empty()
    {
        return None;
    }
    let meshes = match shape {
        Shape::Triangles(mesh) => {
            let (triangles, vertices) = (mesh.triangles.len(), mesh.vertices.len());
            problems.note(format!("a mesh ({kind}) of {triangles} triangles, {vertices} vertices"));
            framed(vec![mesh], &settings, &Given::plain(1.0), &mut problems)
        }
        Shape::Panels(PanelBody { mesh, is_half }) => {
            let (triangles, vertices) = (mesh.triangles.len(), mesh.vertices.len());
            problems.note(format!("a mesh ({kind}) of {triangles} triangles, {vertices} vertices"));
            let given = Given { axes: Some(AS_WRITTEN), half: Some(is_half), ..Given::plain(1.0) };
            framed(vec![mesh], &settings, &given, &mut problems)
        }
        Shape::Net(SubdivisionProject { name, stated, unit, net }) => {
            let [points, faces, edges] = [net.points.len(), net.faces.len(), net.edges.len()];
            let creases = net.edges.iter().filter(|edge| edge.crease).count();
            problems.note(format!(
                "a control net ({kind}) of {points} points, {faces} faces, {edges} edges, {creases} of them creases; its unit is {unit} m"
            ));
            let dry: Vec<&str> =
                net.layers.iter().filter(|layer| !layer.in_hydrostatics).map(|layer| layer.name.as_str()).collect();
            if !dry.is_empty() {
                problems.note(format!("layers that displace no water are left out: {}", dry.join(", ")));
            }
            let meshes = net.meshes(FACES, STEPS);
            problems.note(format!("subdivided into {} triangles", meshes[1].triangles.len()));
            settings.name = settings.name.or(Some(name).filter(|name| !name.is_empty()));
            let StatedParticulars { length_between_perpendiculars, breadth, draught, .. } = &mut settings.stated;
            *length_between_perpendiculars = length_between_perpendiculars.or(stated.length_between_perpendiculars);
            *breadth = breadth.or(stated.breadth);
            *draught = draught.or(stated.draught);
            let given = Given { axes: Some(AS_WRITTEN), ..Given::plain(unit) };
            framed(meshes.to_vec(), &settings, &given, &mut problems)
        }
        Shape::Nothing => Vec::new(),
        Shape::Surfaces(CadSurfaces { surfaces, unit, notes, .. }) => {
            let points = surfaces.iter().map(|surface| surface.points().len()).sum::<usize>();
            let unit = unit.unwrap_or(1.0);
            problems.note(format!(
                "{} surfaces ({kind}) of {points} control points, untrimmed; the unit of the file is {unit} m",
                surfaces.len()
            ));
            notes.into_iter().for_each(|note| problems.warning("W352", FilePosition::FILE, note, ""));
            let size = extent(&surfaces);
            match TriangleMesh::nested(&surfaces, DEVIATION * size, ENOUGH) {
                Ok((nested, deviation)) => {
                    let triangles = nested[1].triangles.len();
                    problems.note(format!("within {:.1e} m of them: {triangles} triangles", deviation * unit));
                    framed(nested.to_vec(), &settings, &Given { surfaces: true, ..Given::plain(unit) }, &mut problems)
                }
                Err(count) => {
                    let message = format!(
                        "the surfaces bend so often that {count} triangles would not follow them, expected at most {}",
                        4 * ENOUGH
                    );
                    problems.error(
                        "E350",
                        FilePosition::FILE,
                        message,
                        "Give the surfaces of the hull alone, or a mesh",
                    );
                    Vec::new()
                }
            }
        }
    };
    Some(problems.finish().map(|notes| ReadBody {
        name: settings.name.unwrap_or_default(),
        meshes,
        stated: settings.stated,
        notes,
        sections: settings.frame.sections.unwrap_or(SECTIONS),
    }))
}

pub(super) fn faulty(faults: Vec<RecordFault>, problems: &mut Problems) {
    for RecordFault { line, found, message } in faults {
        let place = line.map_or(FilePosition::FILE, FilePosition::row);
        problems.error("E350", (place, found.as_str()), message, "");
    }
}

/// The faults of the records of a body as problems of its file.
pub(in super::super) fn body_faults(name: &str, faults: Vec<RecordFault>) -> Vec<TableProblem> {
    let mut problems = Problems::new(name);
    faulty(faults, &mut problems);
    problems.finish().err().unwrap_or_default()
}

/// The longest extent of the control points.
fn extent(surfaces: &[BsplineSurface<4>]) -> f64 {
    let points = || surfaces.iter().flat_map(|surface| surface.points()).map(|[x, y, z, w]| [x / w, y / w, z / w]);
    let along = |k: usize| {
        let least = points().map(|p| p[k]).fold(f64::INFINITY, f64::min);
        points().map(|p| p[k]).fold(f64::NEG_INFINITY, f64::max) - least
    };
    (0..3).map(along).fold(0.0, f64::max)
}

/// What a file says of its body.
pub(super) struct Given {
    /// Its unit \[m\].
    pub(super) unit: f64,
    /// The axes, where the format has them.
    pub(super) axes: Option<[(usize, f64); 3]>,
    /// Whether one side is given, where the format says so.
    pub(super) half: Option<bool>,
    /// Triangles over surfaces, each for itself.
    pub(super) surfaces: bool,
}

impl Given {
    /// A file that says nothing but its unit \[m\].
    pub(super) fn plain(unit: f64) -> Self {
        Self { unit, axes: None, half: None, surfaces: false }
    }
}

/// The axes of a file whose x is forward, y to port and z up.
const AS_WRITTEN: [(usize, f64); 3] = [(0, 1.0), (1, 1.0), (2, 1.0)];

/// How points of a file come into the ship's frame.
pub(super) struct Placement {
    axes: [(usize, f64); 3],
    unit: f64,
    slack: f64,
    origin: [f64; 2],
}

impl Placement {
    /// By the bounds of the points, the settings and what the file says; none, with a problem, when the axes cannot be
    /// told.
    pub(super) fn of(
        bounds: [[f64; 3]; 2],
        settings: &Settings,
        given: &Given,
        problems: &mut Problems,
    ) -> Option<Self> {
        let BodyFrame { axes, up, scale, x_origin, z_origin, .. } = settings.frame;
        let known = axes.or(if up.is_none() { given.axes } else { None });
        let axes = known.or_else(|| found_axes(bounds, up, problems))?;
        let unit = settings.units.map_or(given.unit, |units| units.metres(1.0)) * scale.unwrap_or(1.0);
        let size = (0..3).map(|k| bounds[1][k] - bounds[0][k]).fold(0.0, f64::max) * unit;
        let origin = [x_origin, z_origin].map(|place| place.unwrap_or(0.0));
        Some(Self { axes, unit, slack: ON_CENTREPLANE * size, origin })
    }

    /// Points nearer to the centreplane than a millionth of the size are on it.
    pub(super) fn place(&self, corner: [f64; 3]) -> [f64; 3] {
        let [x, y, z] = self.axes.map(|(axis, sign)| sign * self.unit * corner[axis]);
        [x + self.origin[0], if y.abs() <= self.slack { 0.0 } else { y }, z + self.origin[1]]
    }
}

/// The body in the ship's frame: metres, x forward from AP, y to port, z up; whole, and turned outward. All meshes are
/// of one body and are moved alike; a second one comes from surfaces.
fn framed(
    mut meshes: Vec<TriangleMesh>,
    settings: &Settings,
    given: &Given,
    problems: &mut Problems,
) -> Vec<TriangleMesh> {
    let Some(bounds) = meshes[0].bounds().filter(|_| !problems.any_errors()) else { return meshes };
    let Some(placement) = Placement::of(bounds, settings, given, problems) else { return meshes };
    let BodyFrame { x_origin, z_origin, .. } = settings.frame;
    let surfaces = given.surfaces;
    let place = |corner: [f64; 3]| placement.place(corner);
    let mut half = None;
    for (k, mesh) in meshes.iter_mut().enumerate() {
        let corners: Vec<[[f64; 3]; 3]> = mesh.corners().map(|triangle| triangle.map(place)).collect();
        *mesh = TriangleMesh::from_corners(corners.into_iter());
        if k == 0 {
            half = one_side(mesh, settings.frame.half, given.half, problems);
        }
        if let Some(slack) = half {
            *mesh = mesh.mirrored(slack);
        }
        if surfaces {
            *mesh = without_top(mesh);
        }
        let (oriented, turned) = std::mem::take(mesh).oriented();
        *mesh = oriented;
        if turned > 0 && k == 0 && !surfaces {
            problems.note(format!("{} turned outward", counted(turned, "triangle")));
        }
    }
    let Some([least, greatest]) = meshes[0].bounds() else { return meshes };
    let length = greatest[0] - least[0];
    if !(0.01..=1e4).contains(&length) {
        let message = format!("the body is {length} m long");
        problems.error(
            "E351",
            FilePosition::FILE,
            message,
            "Say units or scale in a TOML file of the same name beside it",
        );
    }
    if x_origin.is_none() && least[0].abs() > 0.2 * length {
        meshes.iter_mut().flat_map(|mesh| &mut mesh.vertices).for_each(|vertex| vertex[0] -= least[0]);
        let message = format!(
            "x of the file runs from {:.3} to {:.3} m; its aftmost point is taken as AP. x_origin in the TOML beside it says \
             otherwise",
            least[0], greatest[0]
        );
        problems.warning("W320", FilePosition::FILE, message, "");
    }
    let depth = greatest[2] - least[2];
    if z_origin.is_none() && least[2].abs() > 0.2 * depth {
        let message = format!(
            "the lowest point is {:.3} m from z = 0 of the file, from where draughts count; z_origin in the TOML beside it moves it",
            least[2]
        );
        problems.warning("W320", FilePosition::FILE, message, "");
    }
    let open = if surfaces { Vec::new() } else { meshes[0].open_edges() };
    if !open.is_empty() {
        let lowest = open.iter().flatten().map(|&k| meshes[0].vertices[k][2]).fold(f64::INFINITY, f64::min);
        let message = format!(
            "{} open, the lowest at z = {lowest:.3} m: what is missing must be deck, transom or flat bow",
            counted(open.len(), "edge")
        );
        problems.warning("W351", FilePosition::FILE, message, "");
    }
    meshes
}

/// Of a body of which one side is given, within how much of the centreplane its corners belong on it \[m\]; none of a
/// whole one. `stated` stands before what the `format` says, and both before how the body lies.
fn one_side(mesh: &TriangleMesh, stated: Option<bool>, format: Option<bool>, problems: &mut Problems) -> Option<f64> {
    let part = mesh.part();
    let known = stated.or(format);
    if known == Some(false) {
        if stated.is_none() && part != BodyPart::Whole {
            let message = "the body is on one side of y = 0, and the file names no plane of symmetry there: it is taken as whole. \
                           --body half (body in the TOML beside it) says otherwise";
            problems.warning("W320", FilePosition::FILE, message.to_owned(), "");
        }
        return None;
    }
    let slack = match part {
        BodyPart::Half { inner } => MOVED * inner.abs(),
        BodyPart::Whole if known.is_none() => return None,
        BodyPart::BesideWall if known.is_none() => {
            let message = "the body lies on one side of y = 0 and has a wall there: one half of a hull, or a whole body beside it";
            problems.error(
                "E351",
                FilePosition::FILE,
                message.to_owned(),
                "Say --body half or --body whole (body in the TOML beside it)",
            );
            return None;
        }
        _ => 0.0,
    };
    let [least, greatest] = mesh.bounds()?;
    if slack > ON_CENTREPLANE * (greatest[1] - least[1]) {
        let message = format!(
            "one side of the body is given, and its inner edge is {:.4} m off y = 0: it is moved there and mirrored. \
             --body whole (body in the TOML beside it) says otherwise",
            slack / MOVED
        );
        problems.warning("W320", FilePosition::FILE, message, "");
    } else {
        problems.note("one side of the body is given; it is mirrored".to_owned());
    }
    Some(slack)
}

/// A body without what is level at its top: an untrimmed deck is wider than the hull, and closes nothing that counts.
fn without_top(mesh: &TriangleMesh) -> TriangleMesh {
    let Some([least, greatest]) = mesh.bounds() else { return mesh.clone() };
    let top = greatest[2] - ON_CENTREPLANE * (greatest[2] - least[2]);
    let kept: Vec<[[f64; 3]; 3]> = mesh.corners().filter(|t| t.iter().any(|point| point[2] < top)).collect();
    TriangleMesh::from_corners(kept.into_iter())
}

/// The axes of a body by its extents; none, with a problem, when they cannot be told.
fn found_axes(
    [least, greatest]: [[f64; 3]; 2],
    up: Option<(usize, f64)>,
    problems: &mut Problems,
) -> Option<[(usize, f64); 3]> {
    let extent = |k: usize| greatest[k] - least[k];
    if let Some((up, sign)) = up {
        let (a, b) = ((up + 1) % 3, (up + 2) % 3);
        // Right-handed: port is up x forward.
        return Some(if extent(a) >= extent(b) {
            [(a, 1.0), (b, sign), (up, sign)]
        } else {
            [(b, 1.0), (a, -sign), (up, sign)]
        });
    }
    let long = (0..3).max_by(|&a, &b| extent(a).total_cmp(&extent(b)).then(b.cmp(&a)))?;
    let size = extent(long);
    let across = |k: usize| {
        let near = |value: f64| value.abs() <= SYMMETRIC * size;
        near(least[k] + greatest[k]) || near(least[k]) || near(greatest[k])
    };
    let symmetric = |k: usize| (least[k] + greatest[k]).abs() <= SYMMETRIC * size;
    // A body whose centreline is a little off, or whose sides differ, is nearer to symmetry across than up.
    let off = |k: usize| (least[k] + greatest[k]).abs() / extent(k).max(f64::MIN_POSITIVE);
    let is_nearly = |[across, up]: [usize; 2]| off(across) <= NEARLY && off(up) >= NOT_NEARLY;
    let names = ["x", "y", "z"];
    // The right-handed frame in which the longest axis is forward and the third is up.
    let (y, z) = ((long + 1) % 3, (long + 2) % 3);
    let frame = match [y, z].map(|k| (symmetric(k), across(k))) {
        [(true, _), (false, _)] => [(long, 1.0), (y, 1.0), (z, 1.0)],
        [(false, _), (true, _)] => [(long, 1.0), (z, -1.0), (y, 1.0)],
        [(false, true), (false, false)] if !is_nearly([z, y]) => [(long, 1.0), (y, 1.0), (z, 1.0)],
        [(false, false), (false, true)] if !is_nearly([y, z]) => [(long, 1.0), (z, -1.0), (y, 1.0)],
        _ if is_nearly([y, z]) => [(long, 1.0), (y, 1.0), (z, 1.0)],
        _ if is_nearly([z, y]) => [(long, 1.0), (z, -1.0), (y, 1.0)],
        // Both may be: what is usual.
        [(a, true), (b, true)] if a == b => [(long, 1.0), (y, 1.0), (z, 1.0)],
        _ => {
            let message = format!(
                "the axes are ambiguous: x runs from {} to {}, y from {} to {}, z from {} to {}",
                least[0], greatest[0], least[1], greatest[1], least[2], greatest[2]
            );
            let remedy = "Say axes = \"x y z\" (the file's axis for forward, port and up) in a TOML file of the same name beside it";
            problems.error("E351", FilePosition::FILE, message, remedy);
            return None;
        }
    };
    let across = frame[1].0;
    if !symmetric(across) && is_nearly([across, frame[2].0]) {
        let message = format!(
            "{} runs from {} to {}: the body is not symmetric about the centreplane, and is taken as it is",
            names[across], least[across], greatest[across]
        );
        problems.warning("W320", FilePosition::FILE, message, "");
    }
    if frame.map(|(axis, _)| axis) != [0, 1, 2] {
        let written = frame.map(|(axis, sign)| format!("{}{}", if sign < 0.0 { "-" } else { "" }, names[axis]));
        let message = format!("axes are taken as \"{}\" by the extents of the body", written.join(" "));
        problems.warning("W320", FilePosition::FILE, message, "");
    }
    Some(frame)
}

/// Lines whose ends are within `slack` of each other as one, the nearest ends first; each end has one mate at most. Of
/// n ends near each other all pairs are looked at, of others those that are within `slack` across.
fn joined(lines: Vec<MeshLine>, slack: f64) -> Vec<MeshLine> {
    // End 2 k is the first point of line k, 2 k + 1 its last.
    let end = |e: usize| {
        let points = &lines[e / 2].points;
        points[if e.is_multiple_of(2) { 0 } else { points.len() - 1 }]
    };
    let mut ends: Vec<usize> = (0..2 * lines.len()).filter(|&e| !lines[e / 2].closed).collect();
    ends.sort_by(|&a, &b| end(a)[0].total_cmp(&end(b)[0]));
    let mut pairs = Vec::new();
    for (n, &a) in ends.iter().enumerate() {
        let p = end(a);
        for &b in ends[n + 1..].iter().take_while(|&&b| end(b)[0] - p[0] <= slack) {
            let distance = (p[0] - end(b)[0]).hypot(p[1] - end(b)[1]);
            if distance <= slack {
                pairs.push((distance, a.min(b), a.max(b)));
            }
        }
    }
    pairs.sort_by(|a, b| a.0.total_cmp(&b.0).then((a.1, a.2).cmp(&(b.1, b.2))));
    let mut mates = vec![None; 2 * lines.len()];
    for (_, a, b) in pairs {
        if mates[a].is_none() && mates[b].is_none() {
            (mates[a], mates[b]) = (Some(b), Some(a));
        }
    }
    let mut used = vec![false; lines.len()];
    let mut result = Vec::with_capacity(lines.len());
    for k in 0..lines.len() {
        if used[k] {
            continue;
        }
        // Back to the loose end of its chain, or once round.
        let mut from = 2 * k;
        while let Some(mate) = mates[from] {
            from = mate ^ 1;
            if from == 2 * k {
                break;
            }
        }
        let mut chain = MeshLine { points: Vec::new(), closed: lines[k].closed };
        let mut at = Some(from);
        while let Some(entered) = at {
            let line = &lines[entered / 2];
            used[entered / 2] = true;
            if entered.is_multiple_of(2) {
                chain.points.extend(&line.points);
            } else {
                chain.points.extend(line.points.iter().rev());
            }
            at = mates[entered ^ 1];
            if at == Some(from) {
                chain.closed = true;
                break;
            }
        }
        result.push(chain);
    }
    result
}

impl ReadBody {
    /// The sections of the body as a table.
    ///
    /// # Errors
    /// Every problem of the sections.
    pub fn table(self) -> Result<ReadTable, Vec<TableProblem>> {
        let mut problems = Problems::new("");
        let (sections, gaps, aside) = self.cut();
        note_asymmetry(&gaps, &mut problems);
        if aside > 0 {
            let message = format!("{aside} loops that do not reach the centreplane are left out");
            problems.warning("W332", FilePosition::FILE, message, "");
        }
        let Self { name, stated, notes, .. } = self;
        let body = Body { name, stated, sections, origin: XOrigin::AfterPerpendicular, unit: 1.0 };
        problems.decimals = 6;
        let file = notes.first().map(|note| note.file.clone()).unwrap_or_default();
        let named = |problem: TableProblem| TableProblem { file: file.clone(), ..problem };
        match table(body, problems) {
            Ok(read) => {
                let notes = notes.iter().cloned().chain(read.notes.into_iter().map(named)).collect();
                Ok(ReadTable { table: read.table, notes })
            }
            Err(list) => Err(list.into_iter().map(named).collect()),
        }
    }

    /// The sections, how far their sides differ with x, and how many loops are left out.
    fn cut(&self) -> (Vec<Section>, Vec<(f64, f64)>, usize) {
        let Some(mesh) = self.meshes.last() else { return (Vec::new(), Vec::new(), 0) };
        let Some([least, greatest]) = mesh.bounds() else { return (Vec::new(), Vec::new(), 0) };
        let (length, breadth) = (greatest[0] - least[0], greatest[1] - least[1]);
        let (mut sections, mut gaps, mut aside) = (Vec::new(), Vec::new(), 0);
        for k in 0..=self.sections {
            let share = 0.5 * (1.0 - (PI * k as f64 / self.sections as f64).cos());
            let x = least[0] + length * share.clamp(INSIDE, 1.0 - INSIDE);
            let (mut branches, mut gap) = (Vec::new(), 0.0_f64);
            let lines = mesh.section(x);
            let lines = if self.meshes.len() > 1 { joined(lines, SEAM * length) } else { lines };
            for line in lines {
                let points: Vec<_> =
                    line.thinned(THINNED * breadth).points.into_iter().map(|[y, z]| point(y, z)).collect();
                match starboard_of(&points) {
                    Some((found, apart)) => {
                        branches.extend(found);
                        gap = gap.max(apart);
                    }
                    None => aside += 1,
                }
            }
            branches.sort_by(|a, b| a[0].z.total_cmp(&b[0].z));
            if branches.is_empty() {
                continue;
            }
            let deck: Option<Deck> = branches.last_mut().and_then(take_off_deck);
            gaps.push((gap, x));
            sections.push(Section { name: None, x, place: FilePosition::FILE, branches, deck });
        }
        (sections, gaps, aside)
    }
}

#[cfg(test)]
mod tests;
