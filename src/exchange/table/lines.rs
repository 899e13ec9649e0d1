//! The curves of a file without surfaces (IGES, entities 126 and 110; DXF; 3DM) as a table: those at one x are sections;
//! where there are few, those at one height are waterlines, of which sections are made.
//!
//! Units, axes and origin are found as those of bodies are, and `parts` chooses layers. Sections at [`LEAST_SECTIONS`] x
//! and more stand before waterlines; of waterlines that are drawn as well, sections between the outermost of these and
//! the ends of the hull are made (`along`). Curves at one y and all others (diagonals, chines in space) are left out, and
//! the layers of these are named. At one x layers with few planes count where those with many have nothing.

mod across;
mod along;

use std::collections::BTreeMap;
use std::path::Path;

use super::super::cad::{
    CadCurve, CadSurfaces, Drawing, Model, ModelObject, PlacedObject, is_3dm, is_dxf, is_iges, read_3dm, read_dxf,
    read_iges, sampled,
};
use super::body::frame::{Extents, Given, Placement, off_base, size};
use super::body::parts::{chosen_names, is_by_name};
use super::body::{drawing_unit, has_acis};
use super::problem::{FilePosition, Problems};
use super::sections::{Body, Section, XOrigin, table};
use super::settings::Settings;
use super::{ReadTable, TableProblem, sidecar};
use crate::units::counted;
use along::{Along, LEAST_WATERLINES};

/// A curve whose extent in a direction is less than this part of the size is in a plane across it; planes nearer to
/// each other are one.
const FLAT: f64 = 1e-5;

/// With fewer sections waterlines, where there are enough, make the table.
const LEAST_SECTIONS: usize = 5;

/// Sections of more points on the average are samples of curves, whose turns are no chines.
const FEW: usize = 6;

/// Layers that a message names at most.
const MOST_NAMED: usize = 8;

/// The curves of a file in its unit.
struct Source {
    kind: &'static str,
    curves: Vec<CadCurve>,
    unit: Option<f64>,
    notes: Vec<String>,
    /// Surfaces that are not read: layer, kind and how many.
    surfaces: Vec<(String, String, usize)>,
    /// Layers that the file does not show.
    hidden: Vec<String>,
}

/// The curves of a file that has nothing else; none when it is no such file.
fn source(name: &str, bytes: &[u8]) -> Option<Source> {
    let has_ending = Path::new(name).extension().is_some_and(|ending| ending.eq_ignore_ascii_case("dxf"));
    if is_dxf(bytes) || has_ending {
        let Drawing { curves, unit, notes, parts, surfaces } = read_dxf(bytes).ok()?;
        let hidden = Vec::new();
        return parts.is_empty().then_some(Source { kind: "DXF", curves, unit, notes, surfaces, hidden });
    }
    if is_3dm(bytes) {
        return read_3dm(bytes).ok().filter(Model::is_drawn).map(of_model);
    }
    if !is_iges(bytes) {
        return None;
    }
    let CadSurfaces { surfaces, unit, curves, notes, body, unread } = read_iges(bytes).ok()?;
    let others = !surfaces.is_empty() || !body.faces.is_empty() || !unread.is_empty();
    let unit = unit.or(Some(1.0));
    let (surfaces, hidden) = (Vec::new(), Vec::new());
    (!others && !curves.is_empty()).then_some(Source { kind: "IGES", curves, unit, notes, surfaces, hidden })
}

/// The curves of a model by the layers of their own.
fn of_model(Model { unit, layers, objects }: Model) -> Source {
    let (mut curves, mut hidden, mut unread) = (Vec::new(), 0, 0);
    for PlacedObject { object, layers: on, hidden: is_hidden } in objects {
        let is_hidden = is_hidden || on[1..].iter().any(|&k| !layers[k].visible);
        match object {
            ModelObject::Curve(_) if is_hidden => hidden += 1,
            ModelObject::Curve(Some(curve)) => {
                let layer = layers[on[0]].name.clone();
                curves.push(CadCurve { points: sampled(&curve), layer, ..CadCurve::default() });
            }
            ModelObject::Curve(None) => unread += 1,
            _ => {}
        }
    }
    let mut notes = Vec::new();
    for (count, why) in [(hidden, "that the file hides one by one: not read"), (unread, "of kinds that are not read")] {
        if count > 0 {
            notes.push(format!("{} {why}", counted(count, "curve")));
        }
    }
    let hidden = layers.into_iter().filter(|layer| !layer.visible).map(|layer| layer.name).collect();
    Source { kind: "3DM", curves, unit, notes, surfaces: Vec::new(), hidden }
}

/// A curve in the ship's frame.
struct SpaceCurve {
    row: usize,
    points: Vec<[f64; 3]>,
    layer: String,
}

impl SpaceCurve {
    fn range(&self, axis: usize) -> [f64; 2] {
        range(&self.points, axis)
    }

    fn is_flat(&self, axis: usize, slack: f64) -> bool {
        let [least, greatest] = self.range(axis);
        greatest - least <= slack
    }

    fn is_on_centreplane(&self, slack: f64) -> bool {
        let [least, greatest] = self.range(1);
        least >= -slack && greatest <= slack
    }

    fn place(&self) -> FilePosition {
        if self.row > 0 { FilePosition::row(self.row) } else { FilePosition::FILE }
    }
}

fn range(points: &[[f64; 3]], axis: usize) -> [f64; 2] {
    let values = points.iter().map(|point| point[axis]);
    values.fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], v| [a.min(v), b.max(v)])
}

/// The table of a file of curves, with the conventions beside it; none when it is no such file, or has surfaces.
pub(super) fn read(name: &str, bytes: &[u8], sidecar: &[(&str, &str)]) -> Option<Result<ReadTable, Vec<TableProblem>>> {
    let source = source(name, bytes)?;
    let mut problems = Problems::new(name);
    let mut settings = Settings::default();
    for (name, text) in sidecar {
        sidecar::read(name, text, &mut settings, &mut problems);
    }
    let lines = lines(source, &settings, &mut problems).filter(|_| !problems.any_errors());
    let Some(lines) = lines else { return Some(Err(problems.finish().err().unwrap_or_default())) };
    let sections = sections(&lines, &mut problems);
    problems.decimals = 6;
    let body = Body {
        name: settings.name.clone().unwrap_or_default(),
        stated: settings.stated,
        sections,
        origin: if settings.frame.x_origin.is_some() { XOrigin::AfterPerpendicular } else { XOrigin::Unknown },
        unit: 1.0,
    };
    let read = table(body, problems);
    Some(read.and_then(|read| {
        let few = read.table.point_count() <= FEW * read.table.stations.len();
        super::formats::checked(name, read, &settings, [false, few])
    }))
}

/// The chosen curves in the ship's frame.
fn lines(source: Source, settings: &Settings, problems: &mut Problems) -> Option<Vec<SpaceCurve>> {
    let Source { kind, mut curves, unit, notes, surfaces, hidden } = source;
    notes.into_iter().for_each(|note| problems.warning("W352", FilePosition::FILE, note, ""));
    problems.note(format!("{} ({kind}) without surfaces", counted(curves.len(), "curve")));
    let unit = drawing_unit(unit, settings, problems);
    let all = curves.iter().map(|curve| &curve.layer).chain(surfaces.iter().map(|(layer, ..)| layer));
    let mut layers: Vec<&str> = all.map(String::as_str).filter(|layer| !layer.is_empty()).collect();
    layers.sort_unstable();
    layers.dedup();
    if !layers.is_empty() {
        problems.note(format!("layers: {}", named(layers.iter().map(|layer| (*layer).to_owned()).collect())));
    }
    let chosen = chosen_names(&layers, settings.frame.parts.as_deref(), problems);
    let left: Vec<String> =
        layers.iter().zip(chosen).filter(|(_, chosen)| !chosen).map(|(layer, _)| (*layer).to_owned()).collect();
    curves.retain(|curve| left.binary_search(&curve.layer).is_err());
    if !is_by_name(settings.frame.parts.as_deref()) {
        without_hidden(&mut curves, &hidden, problems);
    }
    if has_acis(&surfaces, |layer| !left.iter().any(|name| name == layer), problems) {
        return None;
    }
    let points: Vec<[f64; 3]> = curves.iter().flat_map(|curve| curve.points.iter().copied()).collect();
    let extents = Extents::of_points(&points)?;
    let longest = (0..3).map(|k| extents.extent(k)).fold(0.0, f64::max);
    if let Some(k) = (0..3).find(|&k| extents.extent(k) <= FLAT * longest) {
        let axis = ["x", "y", "z"][k];
        let message = format!(
            "all curves lie in one plane, {axis} = {:.6}: views of a drawing do not say where in space they are",
            points[0][k]
        );
        let remedy = "Give stations or waterlines as lines in space, each at its own x or z";
        problems.error("E328", FilePosition::FILE, message, remedy);
        return None;
    }
    let given = Given::plain(unit);
    let placement = Placement::of(&extents, settings, &given, problems)?;
    let line = |curve: CadCurve| SpaceCurve {
        row: curve.line,
        points: curve.points.iter().map(|&point| placement.place(point)).collect(),
        layer: curve.layer,
    };
    let lines: Vec<SpaceCurve> = curves.into_iter().map(line).collect();
    let [x, z] = [0, 2].map(|axis| {
        let ranges = lines.iter().map(|line| line.range(axis));
        ranges.fold([f64::INFINITY, f64::NEG_INFINITY], |p, q| [p[0].min(q[0]), p[1].max(q[1])])
    });
    size(x[1] - x[0], &given, settings, problems);
    off_base(z, settings, problems);
    Some(lines)
}

/// Leaves out curves of layers that are not shown, and says so.
fn without_hidden(curves: &mut Vec<CadCurve>, hidden: &[String], problems: &mut Problems) {
    let before = curves.len();
    curves.retain(|curve| !hidden.contains(&curve.layer));
    if curves.len() < before {
        let message = format!("left out: {} on layers that the file hides", counted(before - curves.len(), "curve"));
        let remedy =
            "Show these layers in the file, or name those that count with --parts (parts in the TOML beside it)";
        problems.warning("W352", FilePosition::FILE, message, remedy);
    }
}

/// The first names, and how many more there are.
fn named(mut names: Vec<String>) -> String {
    let more = names.len().saturating_sub(MOST_NAMED);
    names.truncate(MOST_NAMED);
    if more > 0 {
        names.push(format!("{more} more"));
    }
    names.join(", ")
}

/// Curves by the planes in which they lie.
#[derive(Default)]
struct Planes<'a> {
    /// At one x, off the centreplane.
    across: Vec<&'a SpaceCurve>,
    /// On the centreplane.
    middle: Vec<&'a SpaceCurve>,
    /// At one height.
    level: Vec<&'a SpaceCurve>,
    others: Vec<&'a SpaceCurve>,
}

impl<'a> Planes<'a> {
    /// What runs straight across the hull is part of a section where one is drawn at its x, and else of a waterline that ends at
    /// a raked transom.
    fn of(lines: &'a [SpaceCurve], slack: f64) -> Self {
        let mut planes = Self::default();
        let is_across = |line: &SpaceCurve| line.is_flat(0, slack) && !line.is_on_centreplane(slack);
        let upright = lines.iter().filter(|line| is_across(line) && !line.is_flat(2, slack));
        let mut drawn: Vec<f64> = upright.map(|line| line.points[0][0]).collect();
        drawn.sort_by(f64::total_cmp);
        let has_section = |x: f64| {
            let next = drawn.partition_point(|own| *own < x - slack);
            drawn.get(next).is_some_and(|own| *own <= x + slack)
        };
        for line in lines {
            let list = if line.is_on_centreplane(slack) {
                &mut planes.middle
            } else if line.is_flat(0, slack) && has_section(line.points[0][0]) {
                &mut planes.across
            } else if line.is_flat(2, slack) {
                &mut planes.level
            } else {
                &mut planes.others
            };
            list.push(line);
        }
        planes
    }
}

/// Sections of the curves that are such, or of waterlines.
fn sections(lines: &[SpaceCurve], problems: &mut Problems) -> Vec<Section> {
    let extent = |axis: usize| {
        let ranges = lines.iter().map(|line| line.range(axis));
        let [a, b] = ranges.fold([f64::INFINITY, f64::NEG_INFINITY], |p, q| [p[0].min(q[0]), p[1].max(q[1])]);
        b - a
    };
    let size = (0..3).map(extent).fold(0.0, f64::max);
    let slack = FLAT * size;
    let planes = Planes::of(lines, slack);
    let along = Along::of(&planes, size);
    let (mut list, dropped) = across::sections(&planes.across, size, problems);
    let of_waterlines = along.heights() >= LEAST_WATERLINES && list.len() < LEAST_SECTIONS;
    let mut left: Vec<&SpaceCurve> = planes.others.iter().copied().filter(|line| !along.uses(line)).collect();
    if of_waterlines {
        left.extend(&planes.across);
        list = along.sections(problems);
    } else if list.len() >= 2 {
        left_out(&dropped, "on layers of few sections", problems);
        let closed = along.close(&mut list, problems);
        left.extend(planes.level.iter().filter(|line| !closed && !along.uses(line)));
    } else {
        let message = format!(
            "{}: {} at one x, {} at one height; sections at two x at least, or {LEAST_WATERLINES} waterlines, make \
             a table",
            counted(lines.len(), "curve"),
            planes.across.len(),
            planes.level.len()
        );
        let place = lines.first().map_or(FilePosition::FILE, SpaceCurve::place);
        problems.error("E328", place, message, "Give surfaces, or curves in such planes.");
        return Vec::new();
    }
    if !list.is_empty() {
        left_out(&left, "in no plane of a section", problems);
    }
    list
}

/// Says which curves are left out, and why.
fn left_out(left: &[&SpaceCurve], why: &str, problems: &mut Problems) {
    if left.is_empty() {
        return;
    }
    let mut layers: BTreeMap<&str, usize> = BTreeMap::new();
    left.iter().filter(|line| !line.layer.is_empty()).for_each(|l| *layers.entry(&l.layer).or_default() += 1);
    let layers: Vec<String> = layers.into_iter().map(|(layer, count)| format!("{layer} {count}")).collect();
    let of = if layers.is_empty() { String::new() } else { format!(" ({})", named(layers)) };
    let message = format!("left out: {}, {why}{of}", counted(left.len(), "curve"));
    problems.warning("W332", FilePosition::FILE, message, "");
}

#[cfg(test)]
mod tests;
