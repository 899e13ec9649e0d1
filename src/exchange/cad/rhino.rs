//! 3DM (openNURBS, McNeel), the format of Rhino: an archive of chunks, each with its code, its length and, for most, a CRC.
//!
//! Written is the body of a hull as one closed polysurface. Read are the surfaces, polysurfaces and meshes of archives of
//! the versions 2 to 8, by their layers, or the curves of one without these, all with those of blocks at their places.

mod archive;
mod blocks;
mod brep;
mod chunks;
mod cursor;
mod curves;
mod extrusion;
mod mesh;
mod read;
mod surfaces;
mod write;

pub(in super::super) use read::{Model, ModelObject, PlacedObject, is_3dm, read_3dm, united};
pub use write::write_3dm;
