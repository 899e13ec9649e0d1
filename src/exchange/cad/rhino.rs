//! 3DM (openNURBS, McNeel), the format of Rhino: an archive of chunks, each with its code, its length and, for most, a CRC.
//!
//! Written is the body of a hull as one closed polysurface. Read are the surfaces, polysurfaces and meshes of archives of
//! the versions 2 to 8, by their layers.

mod chunks;
mod write;

pub use write::write_3dm;
