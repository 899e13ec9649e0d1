//! The objects of an archive with their layers.

use super::archive::{MAGIC, Mode, Record, Tables, tables};
use super::brep::{Lost, kind_of, read as read_brep, whole};
use super::chunks::class;
use super::curves::Budget;
use super::surfaces::Patch;
use super::{extrusion, mesh};
use crate::exchange::cad::{CadSurfaces, Unread};
use crate::exchange::fault::RecordFault;
use crate::exchange::mesh::MOST_TRIANGLES;
use crate::hull::{Brep, FaceSurface, Motion, TriangleMesh};
use crate::spline::{BsplineSurface, KnotVector, length, minus};

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
    /// A curve.
    Curve,
    /// An object without an area: a point, a text, a light.
    Other,
}

impl ModelObject {
    /// Whether it is, or would be, part of a skin.
    pub(in super::super::super) fn has_area(&self) -> bool {
        !matches!(self, Self::Curve | Self::Other)
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
    /// Index of its layer.
    pub(in super::super::super) layer: usize,
    /// Whether it is hidden by itself.
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

/// Points nearer to each other than this part of the size of a surface are one.
const CLOSED: f64 = 1e-6;

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
    let Tables { versions, unit, layers, records, .. } =
        read.map_err(|message| vec![RecordFault { line: None, found: String::new(), message }])?;
    let mut layers: Vec<ModelLayer> =
        layers.into_iter().map(|layer| ModelLayer { name: layer.name, visible: layer.visible }).collect();
    let nowhere = layers.len();
    layers.iter_mut().filter(|layer| layer.name.is_empty()).for_each(|layer| "(no name)".clone_into(&mut layer.name));
    layers.push(ModelLayer { name: "(no layer)".to_owned(), visible: true });
    let (mut budget, mut triangles) = (Budget::default(), MOST_TRIANGLES);
    let placed = |(number, record): (usize, &Record<'_>)| {
        let object = object(number, record, versions, (&mut budget, &mut triangles));
        PlacedObject { object, layer: record.layer.unwrap_or(nowhere), hidden: record.mode == Mode::Hidden }
    };
    let seen = records.iter().enumerate().filter(|(_, record)| record.mode != Mode::Defined);
    Ok(Model { unit, layers, objects: seen.map(placed).collect() })
}

/// Kinds of records.
mod kind {
    pub(super) const CURVE: u32 = 4;
    pub(super) const SURFACE: u32 = 8;
    pub(super) const BREP: u32 = 0x10;
    pub(super) const MESH: u32 = 0x20;
    pub(super) const INSTANCE: u32 = 0x1000;
    pub(super) const SUBDIVISION: u32 = 0x4_0000;
    pub(super) const EXTRUSION: u32 = 0x4000_0000;
}

fn object(
    number: usize,
    record: &Record<'_>,
    versions: super::archive::Versions,
    (budget, triangles): (&mut Budget, &mut usize),
) -> ModelObject {
    let name = format!("object {}", number + 1);
    let unread = |kind: &str, why: &str| {
        ModelObject::Unread(Unread { line: None, name: name.clone(), kind: kind.to_owned(), why: why.to_owned() })
    };
    let Some(object) = &record.object else {
        return match record.kind {
            kind::CURVE => ModelObject::Curve,
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
            kind::CURVE => ModelObject::Curve,
            kind::SURFACE => match budget.surface(object) {
                Some(patch) => ModelObject::Surface(Box::new(ModelSurface { patch, kind: kind_of(object.class) })),
                None => unread(kind_of(object.class), "its records cannot be read"),
            },
            kind::SUBDIVISION => unread("ON_SubD", "a subdivision surface is not read: make it NURBS, or a mesh"),
            kind::INSTANCE => unread("ON_InstanceRef", "an instance of a block is not read: explode it"),
            kind::BREP | kind::MESH | kind::EXTRUSION => unread("object of another class", "its class is not known"),
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
    /// Whether two opposite sides are one line, or a side is a point.
    fn is_closed(&self) -> bool {
        let Patch { surface, ends: [us, vs], .. } = &self.patch;
        let shares = [0.0, 0.2, 0.5, 0.7, 1.0];
        let on = |[a, b]: [f64; 2], share: f64| a + share * (b - a);
        let side = |axis: usize, end: usize| {
            let uv = |share: f64| if axis == 0 { [us[end], on(*vs, share)] } else { [on(*us, share), vs[end]] };
            shares.map(|share| surface.at(uv(share))[0])
        };
        let size = length(minus(surface.at([us[0], vs[0]])[0], surface.at([on(*us, 0.5), on(*vs, 0.5)])[0]));
        let near = |a: &[f64; 3], b: &[f64; 3]| length(minus(*a, *b)) <= CLOSED * size;
        [0, 1].into_iter().any(|axis| {
            let sides = [side(axis, 0), side(axis, 1)];
            let is_point = |side: &[[f64; 3]; 5]| side.iter().all(|point| near(point, &side[0]));
            sides[0].iter().zip(&sides[1]).all(|(a, b)| near(a, b)) || sides.iter().any(is_point)
        })
    }

    /// As a spline that nothing closes; none of others and of surfaces of revolution.
    fn spline(&self) -> Option<BsplineSurface<4>> {
        if self.is_closed() {
            return None;
        }
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
                if whole(&surface.patch, surface.kind, &mut read.body).is_none() {
                    let (kind, why) = (surface.kind.to_owned(), "nothing bounds it".to_owned());
                    read.unread.push(Unread { line: None, name: format!("object {}", number + 1), kind, why });
                }
            }
            ModelObject::Unread(object) => read.unread.push(object),
            ModelObject::Mesh(_) | ModelObject::Curve | ModelObject::Other => {}
        }
    }
    read
}
