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
    let with_area = objects.iter().filter(|placed| placed.object.has_area());
    with_area.flat_map(|placed| &placed.layers).for_each(|&layer| used[layer] = true);
    let known: Vec<usize> = (0..layers.len()).filter(|&k| used[k]).collect();
    let names: Vec<&str> = known.iter().map(|&k| layers[k].name.as_str()).collect();
    if names.len() > 1 {
        problems.note(format!("layers with surfaces or meshes: {}", some(&names)));
    }
    let choice = settings.frame.parts.as_deref();
    let mut chosen = vec![false; layers.len()];
    known.iter().zip(chosen_names(&names, choice, problems)).for_each(|(&k, is_chosen)| chosen[k] = is_chosen);
    if problems.any_errors() {
        return Shape::Nothing;
    }
    let by_name = is_by_name(choice);
    let counts = |placed: &PlacedObject| {
        let mut layers_of = placed.layers.iter();
        if by_name { layers_of.any(|&k| chosen[k]) } else { layers_of.all(|&k| layers[k].visible) }
    };
    let names_of = |placed: &[&PlacedObject]| -> String {
        // That of a block may be the one that is not shown.
        let of = |placed: &&PlacedObject| {
            placed.layers.iter().copied().find(|&k| !layers[k].visible).unwrap_or(placed.layers[0])
        };
        let mut on: Vec<&str> = placed.iter().map(|placed| layers[of(placed)].name.as_str()).collect();
        on.sort_unstable();
        on.dedup();
        some(&on)
    };
    let left_out = |is: &dyn Fn(&PlacedObject) -> bool| {
        let list: Vec<&PlacedObject> = objects.iter().filter(|placed| placed.object.has_area() && is(placed)).collect();
        (!list.is_empty()).then(|| (counted(list.len(), "object"), names_of(&list)))
    };
    if let Some((count, names)) = left_out(&|placed| !by_name && !counts(placed)) {
        let message = format!("left out: {count} on layers that the file hides ({names})");
        let remedy =
            "Show these layers in the file, or name those that count with --parts (parts in the TOML beside it)";
        problems.warning("W352", FilePosition::FILE, message, remedy);
    }
    if let Some((count, names)) = left_out(&|placed| counts(placed) && placed.hidden) {
        let message = format!("left out: {count} that the file hides one by one (layers {names})");
        let remedy = "Show them in the file: --parts chooses among those that are shown";
        problems.warning("W352", FilePosition::FILE, message, remedy);
    }
    let kept: Vec<bool> = objects.iter().map(|placed| counts(placed) && !placed.hidden).collect();
    let kept = objects.into_iter().zip(kept).filter(|(_, kept)| *kept).map(|(placed, _)| placed.object).collect();
    of_objects(kept, unit.unwrap_or(1.0), problems)
}

/// The body of the objects: meshes, or surfaces.
fn of_objects(objects: Vec<ModelObject>, unit: f64, problems: &mut Problems) -> Shape {
    let count = |is: fn(&ModelObject) -> bool| objects.iter().filter(|object| is(object)).count();
    let curves = count(|object| matches!(object, ModelObject::Curve(_)));
    let others = count(|object| matches!(object, ModelObject::Other));
    let meshes = count(|object| matches!(object, ModelObject::Mesh(_)));
    let surfaces = count(|object| matches!(object, ModelObject::Faces(..) | ModelObject::Surface(_)));
    let left = format!("{} and {} of points, texts and the like", counted(curves, "curve"), counted(others, "object"));
    if meshes + surfaces + count(ModelObject::has_area) == 0 {
        let message = format!("no surfaces and no meshes that are shown: {left}");
        let remedy = "Show surfaces or a mesh. Curves make a table where a file has nothing else";
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
