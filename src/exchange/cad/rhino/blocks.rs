//! The objects of an archive at their places: those of blocks as often as instances show them.

use std::collections::HashMap;

use super::archive::{Id, Mode, Record, Versions};
use super::cursor::Cursor;
use super::curves::Budget;
use super::read::{ModelObject, PlacedObject, kind, object};
use crate::exchange::cad::Unread;
use crate::exchange::mesh::MOST_TRIANGLES;
use crate::hull::{Brep, FaceSurface, Motion, SpaceCurve, TriangleMesh};
use crate::spline::BsplineCurve;

/// Blocks inside blocks, and instances and objects that these show, at most.
const DEEPEST: usize = 16;
const MOST_SHOWN: usize = 100_000;

/// Where the objects of a block stand.
#[derive(Debug, Clone)]
pub(super) struct Place {
    motion: Motion,
    layers: Vec<usize>,
    hidden: bool,
}

impl Default for Place {
    fn default() -> Self {
        Self { motion: Motion::NONE, layers: Vec::new(), hidden: false }
    }
}

/// Reads the records of objects.
pub(super) struct Reader<'a> {
    records: &'a [Record<'a>],
    blocks: &'a HashMap<Id, Vec<Id>>,
    by_id: HashMap<Id, usize>,
    versions: Versions,
    /// The layer of objects without one.
    nowhere: usize,
    /// Objects of blocks, which may be shown again.
    known: HashMap<usize, ModelObject>,
    budget: Budget,
    triangles: usize,
    shown: usize,
    pub(super) placed: Vec<PlacedObject>,
}

/// The block of an instance, and from its objects to where it stands.
fn instance(mut data: Cursor<'_>) -> Option<(Id, Motion)> {
    let [1, _] = data.version()? else { return None };
    let id = data.id()?;
    let all: [f64; 16] = data.reals()?;
    let row = |k: usize| [all[4 * k], all[4 * k + 1], all[4 * k + 2], all[4 * k + 3]];
    let [a, b, c, d] = row(3);
    let is_affine = [a, b, c, d - 1.0].iter().all(|value| value.abs() <= 1e-12);
    is_affine.then(|| (id, Motion([row(0), row(1), row(2)])))
}

impl<'a> Reader<'a> {
    pub(super) fn new(
        records: &'a [Record<'a>],
        blocks: &'a HashMap<Id, Vec<Id>>,
        versions: Versions,
        nowhere: usize,
    ) -> Self {
        let by_id = records.iter().enumerate().map(|(k, record)| (record.id, k)).collect();
        let (budget, triangles) = (Budget::default(), MOST_TRIANGLES);
        let (known, placed) = (HashMap::new(), Vec::new());
        Self { records, blocks, by_id, versions, nowhere, known, budget, triangles, shown: 0, placed }
    }

    /// Adds what a record shows at a place.
    pub(super) fn place(&mut self, number: usize, place: &Place) {
        let records = self.records;
        let record = &records[number];
        let depth = place.layers.len();
        let mut layers = vec![record.layer.unwrap_or(self.nowhere)];
        layers.extend(&place.layers);
        let hidden = place.hidden || record.mode == Mode::Hidden;
        let shown = match &record.object {
            Some(object) if record.kind == kind::INSTANCE => {
                let inner = instance(object.data.inside).ok_or("its records cannot be read");
                let inner = inner
                    .map(|(id, own)| (id, Place { motion: place.motion.after(&own), layers: layers.clone(), hidden }));
                inner.and_then(|(id, inner)| self.block(&id, &inner, depth))
            }
            _ if depth == 0 => {
                let made = object(number, record, self.versions, (&mut self.budget, &mut self.triangles));
                self.placed.push(PlacedObject { object: made, layers: layers.clone(), hidden });
                Ok(())
            }
            _ => self.copy(number, &place.motion).map(|object| {
                self.placed.push(PlacedObject { object, layers: layers.clone(), hidden });
            }),
        };
        if let Err(why) = shown {
            let (name, kind) = (format!("object {}", number + 1), "object of a block".to_owned());
            let object = ModelObject::Unread(Unread { line: None, name, kind, why: why.to_owned() });
            self.placed.push(PlacedObject { object, layers, hidden });
        }
    }

    /// Adds the objects of a block.
    fn block(&mut self, id: &Id, place: &Place, depth: usize) -> Result<(), &'static str> {
        let objects = self.blocks.get(id).filter(|list| !list.is_empty());
        let objects = objects.ok_or("its block is not in the file: embed it, or explode the instance")?;
        self.shown = self.shown.saturating_add(objects.len());
        if depth >= DEEPEST || self.shown > MOST_SHOWN {
            return Err("blocks stand in each other too often: explode them");
        }
        for object in objects {
            let number = *self.by_id.get(object).ok_or("an object of its block is not in the file")?;
            self.place(number, place);
        }
        Ok(())
    }

    /// An object of a block after a motion.
    fn copy(&mut self, number: usize, motion: &Motion) -> Result<ModelObject, &'static str> {
        let (budget, triangles) = (&mut self.budget, &mut self.triangles);
        let known = self.known.entry(number);
        let own = known.or_insert_with(|| object(number, &self.records[number], self.versions, (budget, triangles)));
        let [points, own_triangles] = size(own);
        if own_triangles > self.triangles || !self.budget.allows(points) {
            return Err("the blocks of the file show more than is read");
        }
        self.triangles -= own_triangles;
        moved(own, motion).ok_or("its instance stretches round faces: explode it")
    }
}

/// Control points and triangles of an object, about.
fn size(object: &ModelObject) -> [usize; 2] {
    match object {
        ModelObject::Mesh(mesh) => [0, mesh.triangles.len()],
        ModelObject::Faces(body, _) => {
            let of_face = |surface: &FaceSurface| match surface {
                FaceSurface::Spline(spline) => spline.points().len(),
                _ => 1,
            };
            let of_edge = |curve: &SpaceCurve| match curve {
                SpaceCurve::Spline(spline) => spline.points().len(),
                _ => 1,
            };
            let faces: usize = body.faces.iter().map(|face| of_face(&face.surface)).sum();
            let edges: usize = body.edges.iter().map(|edge| of_edge(&edge.curve)).sum();
            [faces + edges, 0]
        }
        ModelObject::Surface(surface) => [surface.size(), 0],
        ModelObject::Curve(curve) => [curve.as_ref().map_or(0, |curve| curve.points().len()), 0],
        ModelObject::Unread(_) | ModelObject::Other => [0, 0],
    }
}

/// An object after a motion; none where it has round faces that this stretches.
fn moved(object: &ModelObject, motion: &Motion) -> Option<ModelObject> {
    Some(match object {
        ModelObject::Mesh(mesh) => {
            let vertices = mesh.vertices.iter().map(|&point| motion.point(point)).collect();
            ModelObject::Mesh(TriangleMesh { vertices, triangles: mesh.triangles.clone() })
        }
        ModelObject::Faces(body, lost) => {
            let is_round = body.faces.iter().any(|face| matches!(face.surface, FaceSurface::Revolved { .. }))
                || body.edges.iter().any(|edge| matches!(edge.curve, SpaceCurve::Conic { .. }));
            if is_round && !motion.is_similar() {
                return None;
            }
            let mut copy = Brep::default();
            copy.add(body, &(0..body.faces.len()).collect(), motion);
            ModelObject::Faces(copy, lost.clone())
        }
        ModelObject::Surface(surface) => ModelObject::Surface(Box::new(surface.moved(motion)?)),
        ModelObject::Curve(Some(curve)) => {
            let points = curve.points().iter().map(|&point| motion.weighted(point)).collect();
            ModelObject::Curve(BsplineCurve::new(curve.knots().clone(), points).ok())
        }
        other => other.clone(),
    })
}
