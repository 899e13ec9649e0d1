//! The objects of a 3DM file that count: those that are shown, or those of the layers that are chosen.

use std::collections::BTreeMap;

use super::super::super::cad::{Model, ModelObject, PlacedObject, united};
use super::super::problem::{FilePosition, Problems};
use super::super::settings::Settings;
use super::Shape;
use super::frame::Given;
use super::parts::{chosen_names, is_by_name, joined, some};
use crate::units::counted;

/// The objects of a model without those that are left out: hidden ones, and those of layers that are not shown or, where
/// layers are chosen, not chosen. Says what there is.
pub(super) fn shape(model: Model, settings: &Settings, problems: &mut Problems) -> Shape {
    let Model { unit, layers, objects } = model;
    if unit.is_none() && settings.units.is_none() && settings.frame.scale.is_none() {
        let remedy = "Say --input-unit, or units or scale in a TOML file of the same name beside it";
        problems.error("E351", FilePosition::FILE, "the file states no unit of length".to_owned(), remedy);
        return Shape::Nothing;
    }
    let mut used = vec![false; layers.len()];
    objects.iter().filter(|placed| placed.object.has_area()).for_each(|placed| used[placed.layer] = true);
    let known: Vec<usize> = (0..layers.len()).filter(|&k| used[k]).collect();
    let names: Vec<&str> = known.iter().map(|&k| layers[k].name.as_str()).collect();
    if names.len() > 1 {
        problems.note(format!("layers with surfaces or meshes: {}", some(&names)));
    }
    let choice = settings.frame.parts.as_deref();
    let by_name = is_by_name(choice);
    let mut counts: Vec<bool> = layers.iter().map(|layer| layer.visible && !by_name).collect();
    for (&k, chosen) in known.iter().zip(chosen_names(&names, choice, problems)) {
        counts[k] = if by_name { chosen } else { layers[k].visible };
    }
    if problems.any_errors() {
        return Shape::Nothing;
    }
    let unseen = |placed: &PlacedObject| placed.hidden || !(by_name || layers[placed.layer].visible);
    let hidden: Vec<&PlacedObject> =
        objects.iter().filter(|placed| placed.object.has_area() && unseen(placed)).collect();
    if !hidden.is_empty() {
        let mut on: Vec<&str> = hidden.iter().map(|placed| layers[placed.layer].name.as_str()).collect();
        on.sort_unstable();
        on.dedup();
        let message =
            format!("left out: {} that the file hides (layers {})", counted(hidden.len(), "object"), some(&on));
        let remedy = "Show them in the file, or name their layers with --parts (parts in the TOML beside it)";
        problems.warning("W352", FilePosition::FILE, message, remedy);
    }
    let kept: Vec<ModelObject> = objects
        .into_iter()
        .filter(|placed| counts[placed.layer] && !placed.hidden)
        .map(|placed| placed.object)
        .collect();
    of_objects(kept, unit.unwrap_or(1.0), problems)
}

/// The body of the objects: meshes, or surfaces.
fn of_objects(objects: Vec<ModelObject>, unit: f64, problems: &mut Problems) -> Shape {
    let count = |is: fn(&ModelObject) -> bool| objects.iter().filter(|object| is(object)).count();
    let curves = count(|object| matches!(object, ModelObject::Curve));
    let others = count(|object| matches!(object, ModelObject::Other));
    let meshes = count(|object| matches!(object, ModelObject::Mesh(_)));
    let surfaces = count(|object| matches!(object, ModelObject::Faces(..) | ModelObject::Surface(_)));
    let left = format!("{} and {} of points, texts and the like", counted(curves, "curve"), counted(others, "object"));
    if meshes + surfaces + count(ModelObject::has_area) == 0 {
        let message = format!("no surfaces and no meshes that are shown: {left}");
        let remedy = "Give surfaces or a mesh; curves are read from IGES and DXF files";
        problems.error("E350", FilePosition::FILE, message, remedy);
        return Shape::Nothing;
    }
    if !unread(&objects, problems) {
        return Shape::Nothing;
    }
    if meshes > 0 && surfaces > 0 {
        let message = format!(
            "{} of a mesh beside {} of surfaces: they may be the same skin twice",
            counted(meshes, "object"),
            counted(surfaces, "object")
        );
        let remedy = "Put them on layers of their own and name those of the body with --parts";
        problems.error("E352", FilePosition::FILE, message, remedy);
        return Shape::Nothing;
    }
    if curves + others > 0 {
        problems.note(format!("not part of the body: {left}"));
    }
    if meshes == 0 {
        return Shape::Surfaces(united(objects, Some(unit)));
    }
    let all = objects.into_iter().filter_map(|object| match object {
        ModelObject::Mesh(mesh) => Some(mesh),
        _ => None,
    });
    Shape::Triangles(joined(all), Given::plain(unit))
}

/// Whether all objects are read; a problem with their kinds where they are not.
fn unread(objects: &[ModelObject], problems: &mut Problems) -> bool {
    let lost: Vec<_> = objects
        .iter()
        .filter_map(|object| match object {
            ModelObject::Unread(unread) => Some(unread),
            _ => None,
        })
        .collect();
    let Some(first) = lost.first() else { return true };
    let mut kinds: BTreeMap<&str, usize> = BTreeMap::new();
    lost.iter().for_each(|object| *kinds.entry(&object.kind).or_default() += 1);
    let kinds: Vec<String> = kinds.iter().map(|(kind, count)| format!("{count} {kind}")).collect();
    let whole = objects.iter().filter(|object| object.has_area()).count();
    let message = format!(
        "{} of {} cannot be read ({}), and without them the body is not whole: {}",
        lost.len(),
        counted(whole, "object"),
        kinds.join(", "),
        first.why
    );
    let remedy = "Convert them to surfaces or a mesh, or name the layers of the body with --parts";
    problems.error("E352", (FilePosition::FILE, first.name.as_str()), message, remedy);
    false
}
