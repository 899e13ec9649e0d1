//! The triangles over the surfaces and the faces of a CAD file.

use std::collections::BTreeMap;

use super::super::super::cad::{CadSurfaces, Unread};
use super::super::problem::{FilePosition, Problems};
use super::super::settings::Settings;
use super::frame::{Given, framed};
use crate::hull::{Brep, TriangleMesh};
use crate::spline::BsplineSurface;
use crate::units::counted;

/// What triangles leave surfaces by at most, over the longest extent of these.
const DEVIATION: f64 = 1e-5;

/// What triangles leave faces inside loops by at most, over the longest extent of the body; the two meshes are
/// extrapolated.
const FACE_DEVIATION: f64 = 3e-5;

/// More triangles than this are made fewer by a deviation that is doubled.
const ENOUGH: usize = 150_000;

/// The body of a CAD file in the ship's frame, and what it leaves the surfaces by at most \[m\]; none, with problems, when
/// it cannot be read whole.
pub(super) fn meshes(
    read: CadSurfaces,
    kind: &str,
    settings: &Settings,
    problems: &mut Problems,
) -> (Vec<TriangleMesh>, f64) {
    let CadSurfaces { mut surfaces, unit, notes, body, mut unread, .. } = read;
    let unit = unit.unwrap_or(1.0);
    notes.into_iter().for_each(|note| problems.warning("W352", FilePosition::FILE, note, ""));
    let faces = body.faces.len() + unread.len();
    if faces > 0 {
        match body.whole_surfaces().filter(|_| unread.is_empty()) {
            Some(whole) => surfaces.extend(whole),
            None => return of_faces(&body, &mut unread, (kind, unit), settings, problems),
        }
    }
    of_surfaces(&surfaces, (kind, unit), settings, problems)
}

/// Faces inside their loops, in two nested meshes.
fn of_faces(
    body: &Brep,
    unread: &mut Vec<Unread>,
    (kind, unit): (&str, f64),
    settings: &Settings,
    problems: &mut Problems,
) -> (Vec<TriangleMesh>, f64) {
    let faces = body.faces.len() + unread.len();
    let edges = body.edges.len();
    problems.note(format!("a body ({kind}) of {faces} faces, {edges} edges; the unit of the file is {unit} m"));
    let made = body.triangulated(FACE_DEVIATION, ENOUGH);
    unread.extend(made.faults.iter().map(|fault| {
        let face = &body.faces[fault.face];
        Unread { line: None, name: face.name.clone(), kind: face.kind.clone(), why: fault.why.to_owned() }
    }));
    if let Some(first) = unread.first() {
        let mut kinds: BTreeMap<&str, usize> = BTreeMap::new();
        unread.iter().for_each(|face| *kinds.entry(&face.kind).or_default() += 1);
        let kinds: Vec<String> = kinds.iter().map(|(kind, count)| format!("{count} {kind}")).collect();
        let message = format!(
            "{} of {} cannot be read ({}), and without them the body is not whole: {}",
            unread.len(),
            counted(faces, "face"),
            kinds.join(", "),
            first.why
        );
        let place = first.line.map_or(FilePosition::FILE, FilePosition::row);
        problems.error(
            "E352",
            (place, first.name.as_str()),
            message,
            "Convert these faces to B-splines where the file comes from, or give a mesh",
        );
        return (Vec::new(), 0.0);
    }
    in_frame(made.meshes, made.deviation, &Given::plain(unit), settings, problems)
}

/// Whole surfaces, in two nested meshes.
fn of_surfaces(
    surfaces: &[BsplineSurface<4>],
    (kind, unit): (&str, f64),
    settings: &Settings,
    problems: &mut Problems,
) -> (Vec<TriangleMesh>, f64) {
    let points = surfaces.iter().map(|surface| surface.points().len()).sum::<usize>();
    problems.note(format!(
        "{} surfaces ({kind}) of {points} control points, untrimmed; the unit of the file is {unit} m",
        surfaces.len()
    ));
    match TriangleMesh::nested(surfaces, DEVIATION * extent(surfaces), ENOUGH) {
        Ok((nested, deviation)) => {
            let given = Given { surfaces: true, ..Given::plain(unit) };
            in_frame(nested, deviation, &given, settings, problems)
        }
        Err(count) => {
            let message = format!(
                "the surfaces bend so often that {count} triangles would not follow them, expected at most {}",
                4 * ENOUGH
            );
            problems.error("E350", FilePosition::FILE, message, "Give the surfaces of the hull alone, or a mesh");
            (Vec::new(), 0.0)
        }
    }
}

/// Two nested meshes in the ship's frame, and what they leave the surfaces by, `deviation` in units of the file \[m\].
fn in_frame(
    nested: [TriangleMesh; 2],
    deviation: f64,
    given: &Given,
    settings: &Settings,
    problems: &mut Problems,
) -> (Vec<TriangleMesh>, f64) {
    let deviation = deviation * given.metres(settings);
    problems.note(format!("within {deviation:.1e} m of them: {} triangles", nested[1].triangles.len()));
    (framed(nested.to_vec(), settings, given, problems), deviation)
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
