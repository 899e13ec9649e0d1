//! Bodies of triangles, or of surfaces, in their files: read, put into the ship's frame, cut into the sections of a
//! table.
//!
//! Units, scale, axes and origin are those of the conventions beside the file. Axes that are not given are found: the
//! length is the longest, the breadth is along the axis about whose zero the body is symmetric or on one side of which
//! it lies. Half a body is mirrored. Triangles are turned outward, and shells inside others left out. Sections of a table
//! lie at x = x_a + L (1 - cos(pi k/n))/2, closer at the ends, and their points are thinned to [`THINNED`] of the breadth.

mod cad;
pub(super) mod frame;
mod model;
pub(super) mod parts;

use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::PI;

use super::super::cad::{
    CadSurfaces, Drawing, Model, is_3dm, is_dxf, is_iges, is_step, read_3dm, read_dxf, read_iges, read_step,
};
use super::super::fault::RecordFault;
#[cfg(feature = "packages")]
use super::super::mesh::{PackagedMesh, is_threemf, is_vtk_xml, read_threemf, read_vtk_xml};
use super::super::mesh::{
    PanelBody, is_gdf, is_glb, is_gltf, is_hydrostar, is_msh, is_nemoh, is_obj, is_off, is_ply, is_stl, is_vtk,
    read_gdf, read_glb, read_gltf, read_hydrostar, read_msh, read_nemoh, read_obj, read_off, read_ply, read_pnl,
    read_stl, read_vtk,
};
use super::super::subdivision::{SubdivisionProject, is_fbm, is_ftm, read_fbm, read_ftm};
use super::outline::{Deck, point, take_off_deck};
use super::problem::{FilePosition, Problems};
use super::sections::{Body, Section, XOrigin, note_asymmetry, starboard_of, table};
use super::settings::Settings;
use super::{ReadTable, TableProblem, sidecar};
use crate::hull::{MeshLine, StatedParticulars, TriangleMesh, enclosed};
use crate::numeric::trapezoids;
use frame::{AS_WRITTEN, Given, framed};
use parts::NamedMesh;

/// What points of sections that are left out are off by at most, over the breadth.
const THINNED: f64 = 2e-5;

/// Spaces between the sections of a table.
const SECTIONS: usize = 40;

/// The first and the last section lie inside the body by this part of its length.
const INSIDE: f64 = 1e-5;

/// Faces and steps at which the subdivision of a net ends.
const FACES: usize = 60_000;
const STEPS: usize = 6;

/// Ends of sections of surfaces that are as near to each other as this part of the length are joined.
pub(super) const SEAM: f64 = 2e-4;

/// A body in the ship's frame.
#[derive(Debug, Clone, PartialEq)]
pub struct ReadBody {
    /// Its name; empty when nothing gives it one.
    pub name: String,
    /// The triangles \[m\], both sides, turned outward; of surfaces twice, the second time with every edge halved.
    pub meshes: Vec<TriangleMesh>,
    /// What the triangles leave the surfaces of a CAD file by at most \[m\]; 0 where they are the body themselves.
    pub deviation: f64,
    /// Whether it is of surfaces that nothing trims: they may reach over each other.
    pub loose: bool,
    /// What the conventions beside the file state.
    pub stated: StatedParticulars,
    /// Warnings and notes: axes, units, openings.
    pub notes: Vec<TableProblem>,
    /// Spaces between the sections of its table.
    sections: usize,
}

/// What the volume between sections leaves that of their body by, over it, before it is a warning, and an error.
const SECTION_VOLUME: [f64; 2] = [1e-2, 5e-2];

/// Sides that differ by less than this part of the breadth are alike.
const ALIKE: f64 = 1e-4;

/// Sections with less than this part of the breadth tell nothing of the sides.
const NARROW: f64 = 0.02;

/// What stands in a file.
enum Shape {
    /// With what their format says.
    Triangles(TriangleMesh, Given),
    /// In parts with names.
    Named(Vec<NamedMesh>, Given),
    Surfaces(CadSurfaces),
    /// Objects on layers.
    Model(Model),
    Net(SubdivisionProject),
    /// Faces by layers, or curves.
    Drawn(Drawing),
    /// What cannot be read.
    Nothing,
}

impl Shape {
    fn of_panels(PanelBody { mesh, is_half, unit }: PanelBody) -> Self {
        Self::Triangles(mesh, Given { axes: Some(AS_WRITTEN), half: Some(is_half), ..Given::plain(unit) })
    }
}

type BodyReader = fn(&[u8]) -> Result<Shape, Vec<RecordFault>>;

/// A kind of file with a body.
struct BodyFormat {
    name: &'static str,
    /// Endings of the names of its files.
    endings: &'static [&'static str],
    /// Whether a file is of the kind by its content.
    recognise: fn(&[u8]) -> bool,
    read: BodyReader,
}

impl BodyFormat {
    const fn new(
        name: &'static str,
        endings: &'static [&'static str],
        recognise: fn(&[u8]) -> bool,
        read: BodyReader,
    ) -> Self {
        Self { name, endings, recognise, read }
    }
}

/// A mesh in metres, of which its format says nothing.
fn plain(mesh: TriangleMesh) -> Shape {
    Shape::Triangles(mesh, Given::plain(1.0))
}

/// A mesh in metres whose y is up.
fn upright(mesh: TriangleMesh) -> Shape {
    Shape::Triangles(mesh, Given { up: 1, ..Given::plain(1.0) })
}

/// What reads the kinds of files, in the order in which they are tried.
const FORMATS: &[BodyFormat] = &[
    BodyFormat::new("FREE!ship", &[".fbm"], is_fbm, |bytes| read_fbm(bytes).map(Shape::Net)),
    BodyFormat::new("FREE!ship", &[".ftm"], is_ftm, |bytes| read_ftm(bytes).map(Shape::Net)),
    BodyFormat::new("STEP", &[".step", ".stp"], is_step, |bytes| read_step(bytes).map(Shape::Surfaces)),
    BodyFormat::new("IGES", &[".iges", ".igs"], is_iges, |bytes| read_iges(bytes).map(Shape::Surfaces)),
    BodyFormat::new("DXF", &[".dxf"], is_dxf, |bytes| read_dxf(bytes).map(Shape::Drawn)),
    BodyFormat::new("3DM", &[".3dm"], is_3dm, |bytes| read_3dm(bytes).map(Shape::Model)),
    BodyFormat::new("PLY", &[".ply"], is_ply, |bytes| read_ply(bytes).map(plain)),
    BodyFormat::new("OFF", &[], is_off, |bytes| read_off(bytes).map(plain)),
    BodyFormat::new("gmsh", &[".msh"], is_msh, |bytes| read_msh(bytes).map(plain)),
    BodyFormat::new("VTK", &[".vtk"], is_vtk, |bytes| read_vtk(bytes).map(plain)),
    #[cfg(feature = "packages")]
    BodyFormat::new("VTK", &[".vtp", ".vtu"], is_vtk_xml, |bytes| read_vtk_xml(bytes).map(plain)),
    #[cfg(feature = "packages")]
    BodyFormat::new("3MF", &[".3mf"], is_threemf, |bytes| {
        read_threemf(bytes)
            .map(|PackagedMesh { mesh, unit, notes }| Shape::Triangles(mesh, Given { notes, ..Given::plain(unit) }))
    }),
    BodyFormat::new("STL", &[".stl"], is_stl, |bytes| {
        read_stl(bytes).map(|parts| Shape::Named(parts, Given::plain(1.0)))
    }),
    BodyFormat::new("GLB", &[".glb"], is_glb, |bytes| read_glb(bytes).map(upright)),
    BodyFormat::new("glTF", &[".gltf"], is_gltf, |bytes| read_gltf(bytes).map(upright)),
    BodyFormat::new("HydroStar", &[".hst"], is_hydrostar, |bytes| read_hydrostar(bytes).map(Shape::of_panels)),
    BodyFormat::new("GDF", &[".gdf"], is_gdf, |bytes| read_gdf(bytes).map(Shape::of_panels)),
    BodyFormat::new("PNL", &[".pnl"], |_| false, |bytes| read_pnl(bytes).map(Shape::of_panels)),
    BodyFormat::new("NEMOH", &[".mar"], is_nemoh, |bytes| read_nemoh(bytes).map(Shape::of_panels)),
    BodyFormat::new("OBJ", &[".obj"], is_obj, |bytes| {
        read_obj(bytes).map(|parts| Shape::Named(parts, Given::plain(1.0)))
    }),
];

/// The kind of a file, by its content or the ending of its name.
fn format(name: &str, bytes: &[u8]) -> Option<&'static BodyFormat> {
    let name = name.to_ascii_lowercase();
    FORMATS
        .iter()
        .find(|format| (format.recognise)(bytes) || format.endings.iter().any(|ending| name.ends_with(ending)))
}

/// Reads a body: a mesh (STL, OBJ, PLY, OFF, GLB, glTF, 3MF, VTK, gmsh), panels (GDF, PNL, NEMOH, HydroStar), the
/// surfaces of a CAD file (STEP, IGES, 3DM), the faces of a drawing (DXF) or a control net (FREE!ship), by its content or its name, with the conventions of
/// the TOML beside it, given by its name and its text, and of others, each over those before it; none when it is no such
/// file.
pub fn read_body<'a>(
    name: &str,
    bytes: &[u8],
    sidecar: impl IntoIterator<Item = (&'a str, &'a str)>,
) -> Option<Result<ReadBody, Vec<TableProblem>>> {
    let BodyFormat { name: kind, read, .. } = *format(name, bytes)?;
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
    let is_drawn = match &shape {
        Shape::Drawn(drawing) => drawing.parts.is_empty(),
        Shape::Model(model) => model.is_drawn(),
        _ => false,
    };
    if is_drawn {
        return None;
    }
    if let Shape::Surfaces(CadSurfaces { surfaces, body, unread, .. }) = &shape
        && surfaces.is_empty()
        && body.faces.is_empty()
        && unread.is_empty()
    {
        return None;
    }
    let shape = match shape {
        Shape::Drawn(drawing) => of_drawing(drawing, &settings, &mut problems),
        other => other,
    };
    let choice = settings.frame.parts.clone();
    let choice = choice.as_deref();
    let shape = match shape {
        Shape::Named(parts, given) => Shape::Triangles(parts::of_names(parts, choice, &mut problems), given),
        Shape::Net(mut project) => {
            let names: Vec<&str> = project.net.layers.iter().map(|layer| layer.name.as_str()).collect();
            let chosen = parts::chosen_names(&names, choice, &mut problems);
            for (layer, chosen) in project.net.layers.iter_mut().zip(chosen) {
                layer.in_hydrostatics &= chosen;
            }
            Shape::Net(project)
        }
        Shape::Model(model) => model::shape(model, &settings, &mut problems),
        other => {
            let is_nothing = matches!(other, Shape::Nothing);
            parts::chosen_names(&[], choice.filter(|_| !is_nothing), &mut problems);
            other
        }
    };
    let (mut deviation, mut loose) = (0.0, false);
    let meshes = match shape {
        Shape::Named(..) | Shape::Drawn(_) | Shape::Model(_) | Shape::Nothing => Vec::new(),
        Shape::Triangles(mesh, given) => {
            let (triangles, vertices) = (mesh.triangles.len(), mesh.vertices.len());
            given.notes.iter().for_each(|note| problems.warning("W352", FilePosition::FILE, note.clone(), ""));
            problems.note(format!("a mesh ({kind}) of {triangles} triangles, {vertices} vertices"));
            if kind == "GDF" && given.unit < 1.0 && settings.units.is_none() {
                let message =
                    "the acceleration of gravity in the file is that in feet: coordinates are taken as feet".to_owned();
                problems.warning("W320", FilePosition::FILE, message, "Say --input-unit m where they are metres");
            }
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
        Shape::Surfaces(read) => {
            let (meshes, off, untrimmed) = cad::meshes(read, kind, &settings, &mut problems);
            (deviation, loose) = (off, untrimmed);
            meshes
        }
    };
    Some(problems.finish().map(|notes| ReadBody {
        name: settings.name.unwrap_or_default(),
        meshes,
        deviation,
        loose,
        stated: settings.stated,
        notes,
        sections: settings.frame.sections.unwrap_or(SECTIONS),
    }))
}

/// The faces of a drawing by layers, with what of it is not read, and a warning where it states no unit.
fn of_drawing(drawing: Drawing, settings: &Settings, problems: &mut Problems) -> Shape {
    let Drawing { parts, unit, notes, surfaces, .. } = drawing;
    let choice = settings.frame.parts.as_deref();
    if has_acis(&surfaces, |layer| parts::is_chosen(layer, choice), problems) {
        return Shape::Nothing;
    }
    notes.into_iter().for_each(|note| problems.warning("W352", FilePosition::FILE, note, ""));
    Shape::Named(parts, Given::plain(drawing_unit(unit, settings, problems)))
}

/// Whether layers that count hold data of ACIS, by layer, kind and number; a problem where they do.
pub(super) fn has_acis(
    surfaces: &[(String, String, usize)],
    counts: impl Fn(&str) -> bool,
    problems: &mut Problems,
) -> bool {
    let mut kinds: BTreeMap<&str, usize> = BTreeMap::new();
    let mut layers: BTreeSet<&str> = BTreeSet::new();
    for (layer, kind, count) in surfaces.iter().filter(|(layer, ..)| counts(layer)) {
        *kinds.entry(kind).or_default() += count;
        layers.insert(layer);
    }
    if kinds.is_empty() {
        return false;
    }
    let kinds: Vec<String> = kinds.into_iter().map(|(kind, count)| format!("{count} of {kind}")).collect();
    let layers: Vec<&str> = layers.into_iter().collect();
    let message = format!(
        "{} (layers {}): data of ACIS, which are not read; the hull may be theirs",
        kinds.join(", "),
        parts::some(&layers)
    );
    let remedy =
        "Export STEP, IGES or a mesh, or name the layers of the hull with --parts (parts in the TOML beside it)";
    problems.error("E352", FilePosition::FILE, message, remedy);
    true
}

/// Metres in the unit of a drawing; metres, with a warning, where neither the file nor the settings state it.
pub(super) fn drawing_unit(unit: Option<f64>, settings: &Settings, problems: &mut Problems) -> f64 {
    match unit {
        Some(unit) => problems.note(format!("the unit of the file is {unit} m")),
        None if settings.units.is_none() && settings.frame.scale.is_none() => {
            let message = "the file states no unit of length: its numbers are taken as metres".to_owned();
            problems.warning("W320", FilePosition::FILE, message, "Say --input-unit (units in the TOML beside it)");
        }
        None => {}
    }
    unit.unwrap_or(1.0)
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

/// Lines whose ends are within `slack` of each other as one, the nearest ends first; each end has one mate at most. Of
/// n ends near each other all pairs are looked at, of others those that are within `slack` across.
pub(super) fn joined(lines: Vec<MeshLine>, slack: f64) -> Vec<MeshLine> {
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
        if gaps.iter().any(|(gap, _)| *gap > ALIKE * self.breadth()) {
            note_asymmetry(&gaps, "port", &mut problems);
        }
        if aside > 0 {
            let message = format!("{aside} loops that do not reach the centreplane are left out");
            problems.warning("W332", FilePosition::FILE, message, "");
        }
        self.weigh(&sections, &mut problems);
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

    /// Its extent athwartships \[m\].
    fn breadth(&self) -> f64 {
        let bounds = self.meshes.last().and_then(TriangleMesh::bounds);
        bounds.map_or(0.0, |[least, greatest]| greatest[1] - least[1])
    }

    /// Compares the volume between the sections with that of the body, to which an open deck adds nothing; not of surfaces
    /// that may reach over each other.
    fn weigh(&self, sections: &[Section], problems: &mut Problems) {
        let Some(mesh) = self.meshes.last().filter(|_| !self.loose) else { return };
        let area =
            |section: &Section| [section.x, 2.0 * section.branches.iter().map(|line| enclosed(line)).sum::<f64>()];
        let found = trapezoids(&sections.iter().map(area).collect::<Vec<_>>());
        let [volume, _] = mesh.enclosed_and_skin();
        let off = found / volume - 1.0;
        let [warned, refused] = SECTION_VOLUME;
        if off.abs() > warned {
            let message = format!(
                "the sections of the body enclose {found:.4e} m3, and the body {volume:.4e} m3 ({:+.1} %): sections from keel to deck \
                 are not its whole form",
                100.0 * off
            );
            if off.abs() > refused {
                let remedy = "`hydro` takes the body itself. Give a body that is alike on both sides and whole on the centreplane";
                problems.error("E354", FilePosition::FILE, message, remedy);
            } else {
                problems.warning(
                    "W340",
                    FilePosition::FILE,
                    message,
                    "Take the figures of the body itself from `hydro`",
                );
            }
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
            // A point of a stem is cut into edges of triangles, which differ where the sides do not.
            let widest = branches.iter().flatten().map(|point| point.y).fold(0.0, f64::max);
            if widest > NARROW * breadth {
                gaps.push((gap, x));
            }
            sections.push(Section { name: None, x, place: FilePosition::FILE, branches, deck });
        }
        (sections, gaps, aside)
    }
}

#[cfg(test)]
mod tests;
