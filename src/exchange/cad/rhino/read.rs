//! The objects of an archive with their layers.

use super::archive::{MAGIC, Mode, Record, Tables, Versions, tables};
use super::blocks::{Place, Reader};
use super::brep::{Lost, kind_of, read as read_brep};
use super::chunks::class;
use super::curves::{Budget, as_spline};
use super::surfaces::Patch;
use super::{extrusion, mesh};
use crate::exchange::cad::surfaces::whole;
use crate::exchange::cad::{CadSurfaces, Unread};
use crate::exchange::fault::RecordFault;
use crate::hull::{Brep, FaceSurface, Motion, TriangleMesh};
use crate::spline::{BsplineCurve, BsplineSurface, KnotVector};

/// What an object is.
#[derive(Debug, Clone)]
pub(in super::super::super) enum ModelObject {
    /// A mesh in the unit of the file.
    Mesh(TriangleMesh),
    /// Faces inside loops, and those that cannot be read.
    Faces(Brep, Vec<Unread>),
    /// A surface that nothing trims.
    Surface(Box<ModelSurface>),
    /// An object with faces that cannot be read, and why.
    Unread(Unread),
    /// A curve; none where its kind is not read.
    Curve(Option<BsplineCurve<4>>),
    /// An object without an area: a point, a text, a light.
    Other,
}

impl ModelObject {
    /// Whether it is, or would be, part of a skin.
    pub(in super::super::super) fn has_area(&self) -> bool {
        !matches!(self, Self::Curve(_) | Self::Other)
    }
}

/// A surface that nothing trims.
#[derive(Debug, Clone)]
pub(in super::super::super) struct ModelSurface {
    patch: Patch,
    kind: &'static str,
}

/// An object with where it stands.
#[derive(Debug, Clone)]
pub(in super::super::super) struct PlacedObject {
    pub(in super::super::super) object: ModelObject,
    /// Indices of its layer and of those of the blocks that it is part of.
    pub(in super::super::super) layers: Vec<usize>,
    /// Whether it, or a block that it is part of, is hidden by itself.
    pub(in super::super::super) hidden: bool,
}

/// A layer of a model.
#[derive(Debug, Clone)]
pub(in super::super::super) struct ModelLayer {
    /// Its names from the outermost layer in, with `::` between them.
    pub(in super::super::super) name: String,
    pub(in super::super::super) visible: bool,
}

/// A 3DM file.
#[derive(Debug, Clone)]
pub(in super::super::super) struct Model {
    /// Metres in its unit, where it states one.
    pub(in super::super::super) unit: Option<f64>,
    pub(in super::super::super) layers: Vec<ModelLayer>,
    pub(in super::super::super) objects: Vec<PlacedObject>,
}

impl Model {
    /// Whether it has curves and nothing that is, or would be, part of a skin.
    pub(in super::super::super) fn is_drawn(&self) -> bool {
        let is_curve = |placed: &PlacedObject| matches!(placed.object, ModelObject::Curve(_));
        self.objects.iter().any(is_curve) && !self.objects.iter().any(|placed| placed.object.has_area())
    }
}

/// Whether these are the first bytes of a 3DM file.
pub(in super::super::super) fn is_3dm(bytes: &[u8]) -> bool {
    bytes.starts_with(MAGIC)
}

/// Reads a 3DM file.
///
/// # Errors
/// What stands in the way of reading its tables; objects that cannot be read are among its objects.
pub(in super::super::super) fn read_3dm(bytes: &[u8]) -> Result<Model, Vec<RecordFault>> {
    let read = tables(bytes);
    let mut tables = read.map_err(|message| vec![RecordFault { line: None, found: String::new(), message }])?;
    let own = std::mem::take(&mut tables.layers).into_iter();
    let mut layers: Vec<ModelLayer> =
        own.map(|layer| ModelLayer { name: layer.name, visible: layer.visible }).collect();
    let nowhere = layers.len();
    layers.iter_mut().filter(|layer| layer.name.is_empty()).for_each(|layer| "(no name)".clone_into(&mut layer.name));
    layers.push(ModelLayer { name: "(no layer)".to_owned(), visible: true });
    let Tables { versions, unit, records, blocks, .. } = tables;
    let mut reader = Reader::new(&records, &blocks, versions, nowhere);
    for number in (0..records.len()).filter(|&k| records[k].mode != Mode::Defined) {
        reader.place(number, &Place::default());
    }
    Ok(Model { unit, layers, objects: reader.placed })
}

/// Kinds of records.
pub(super) mod kind {
    pub(in super::super) const CURVE: u32 = 4;
    pub(in super::super) const SURFACE: u32 = 8;
    pub(in super::super) const BREP: u32 = 0x10;
    pub(in super::super) const MESH: u32 = 0x20;
    pub(in super::super) const INSTANCE: u32 = 0x1000;
    pub(in super::super) const SUBDIVISION: u32 = 0x4_0000;
    pub(in super::super) const EXTRUSION: u32 = 0x4000_0000;
}

pub(super) fn object(
    number: usize,
    record: &Record<'_>,
    versions: Versions,
    (budget, triangles): (&mut Budget, &mut usize),
) -> ModelObject {
    let name = format!("object {}", number + 1);
    let unread = |kind: &str, why: &str| {
        ModelObject::Unread(Unread { line: None, name: name.clone(), kind: kind.to_owned(), why: why.to_owned() })
    };
    let Some(object) = &record.object else {
        return match record.kind {
            kind::CURVE => ModelObject::Curve(None),
            kind::SURFACE | kind::BREP | kind::MESH | kind::INSTANCE | kind::SUBDIVISION | kind::EXTRUSION => {
                unread("damaged object", "its records end within a value")
            }
            _ => ModelObject::Other,
        };
    };
    match object.class {
        class::MESH => match mesh::read(object, versions, triangles) {
            Ok(mesh) => ModelObject::Mesh(mesh),
            Err(why) => unread("ON_Mesh", why),
        },
        class::BREP => {
            let (mut body, mut lost) = (Brep::default(), Vec::new());
            match read_brep(object, versions, (&mut body, &mut lost), budget) {
                Some(()) => ModelObject::Faces(body, lost.iter().map(|lost| missing(&name, lost)).collect()),
                None => unread("ON_Brep", "its records cannot be read"),
            }
        }
        class::EXTRUSION => {
            let mut body = Brep::default();
            match extrusion::read(object, &mut body, budget) {
                Some(()) => ModelObject::Faces(body, Vec::new()),
                None => unread("ON_Extrusion", "its records cannot be read, or its ends are cut askew"),
            }
        }
        _ => match record.kind {
            kind::CURVE => ModelObject::Curve(budget.curve(object).and_then(|run| as_spline(&run))),
            kind::SURFACE => match budget.surface(object) {
                Some(patch) => ModelObject::Surface(Box::new(ModelSurface { patch, kind: kind_of(object.class) })),
                None => unread(kind_of(object.class), "its records cannot be read"),
            },
            kind::SUBDIVISION => unread("ON_SubD", "a subdivision surface is not read: make it NURBS, or a mesh"),
            kind::BREP | kind::MESH | kind::EXTRUSION | kind::INSTANCE => {
                unread("object of another class", "its class is not known")
            }
            _ => ModelObject::Other,
        },
    }
}

fn missing(object: &str, lost: &Lost) -> Unread {
    Unread {
        line: None,
        name: format!("{object}, face {}", lost.number + 1),
        kind: lost.kind.to_owned(),
        why: lost.why.to_owned(),
    }
}

impl ModelSurface {
    /// After a motion; none of a surface of revolution that it stretches.
    pub(super) fn moved(&self, motion: &Motion) -> Option<Self> {
        let Patch { surface, ends, swapped } = &self.patch;
        let surface = match self.spline() {
            Some(spline) => FaceSurface::Spline(spline).moved(motion),
            None if motion.is_similar() => surface.moved(motion),
            None => return None,
        };
        Some(Self { patch: Patch { surface, ends: *ends, swapped: *swapped }, kind: self.kind })
    }

    /// Its control points, about.
    pub(super) fn size(&self) -> usize {
        self.spline().map_or(1, |spline| spline.points().len())
    }

    /// As a spline; none of surfaces of revolution.
    fn spline(&self) -> Option<BsplineSurface<4>> {
        let [us, vs] = self.patch.ends;
        match &self.patch.surface {
            FaceSurface::Spline(spline) => Some(spline.clone()),
            plane @ FaceSurface::Plane { .. } => {
                let corner = |u: f64, v: f64| {
                    let [x, y, z] = plane.at([u, v])[0];
                    [x, y, z, 1.0]
                };
                let points = us.iter().flat_map(|&u| vs.iter().map(move |&v| corner(u, v))).collect();
                let knots = |ends: [f64; 2]| KnotVector::from_breakpoints(1, &ends, &[]).ok();
                BsplineSurface::new(knots(us)?, knots(vs)?, points).ok()
            }
            _ => None,
        }
    }
}

/// The surfaces and faces of objects as one body of a CAD file.
pub(in super::super::super) fn united(objects: Vec<ModelObject>, unit: Option<f64>) -> CadSurfaces {
    let mut read = CadSurfaces { unit, ..CadSurfaces::default() };
    let loose =
        objects.iter().all(|object| matches!(object, ModelObject::Surface(surface) if surface.spline().is_some()));
    for (number, object) in objects.into_iter().enumerate() {
        match object {
            ModelObject::Faces(body, lost) => {
                read.body.add(&body, &(0..body.faces.len()).collect(), &Motion::NONE);
                read.unread.extend(lost);
            }
            ModelObject::Surface(surface) if loose => read.surfaces.extend(surface.spline()),
            ModelObject::Surface(surface) => {
                let Patch { surface: patch, ends, .. } = &surface.patch;
                if whole(patch, *ends, surface.kind, &mut read.body).is_none() {
                    let (kind, why) = (surface.kind.to_owned(), "nothing bounds it".to_owned());
                    read.unread.push(Unread { line: None, name: format!("object {}", number + 1), kind, why });
                }
            }
            ModelObject::Unread(object) => read.unread.push(object),
            ModelObject::Mesh(_) | ModelObject::Curve(_) | ModelObject::Other => {}
        }
    }
    read
}
