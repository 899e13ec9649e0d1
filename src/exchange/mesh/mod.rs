//! Meshes for other programs: triangles as STL, OBJ, PLY, GLB, 3MF, VTK, gmsh; panels below a draught as GDF, NEMOH, PNL. All
//! of them are read, and others besides: OFF, VTP, VTU, HydroStar, glTF as text.

mod cells;
mod gdf;
mod glb;
mod glb_read;
mod hydrostar;
mod msh;
mod nemoh;
#[cfg(not(feature = "packages"))]
mod no_packages;
mod numbers;
mod obj;
mod off;
mod panels_read;
mod ply;
mod pnl;
mod polygons;
mod stl;
#[cfg(feature = "packages")]
mod threemf;
mod vtk;
#[cfg(feature = "packages")]
mod vtk_xml;

pub use gdf::write_gdf;
pub use glb::write_glb;
pub use glb_read::with_buffers;
pub(super) use glb_read::{is_glb, is_gltf, read_glb, read_gltf};
pub(super) use hydrostar::{is_hydrostar, read_hydrostar};
pub use msh::write_msh;
pub(super) use msh::{is_msh, read_msh};
pub use nemoh::write_nemoh;
#[cfg(not(feature = "packages"))]
pub use no_packages::write_threemf;
pub use obj::write_obj;
pub(super) use obj::{is_obj, read_obj};
pub(super) use off::{is_off, read_off};
pub(super) use panels_read::{PanelBody, is_gdf, is_nemoh, read_gdf, read_nemoh, read_pnl};
pub use ply::write_ply;
pub(super) use ply::{is_ply, read_ply};
pub use pnl::write_pnl;
pub(super) use stl::{is_stl, read_stl};
pub use stl::{write_stl, write_stl_ascii};
#[cfg(feature = "packages")]
pub use threemf::write_threemf;
#[cfg(feature = "packages")]
pub(super) use threemf::{PackagedMesh, is_threemf, read_threemf};
pub use vtk::write_vtk;
pub(super) use vtk::{is_vtk, read_vtk};
#[cfg(feature = "packages")]
pub(super) use vtk_xml::{is_vtk_xml, read_vtk_xml};

use crate::hull::{HullMesh, Region};
use crate::spline::{cross, length, minus};

/// Meshes of more triangles are not read.
pub(super) const MOST_TRIANGLES: usize = 6_000_000;

/// Regions of a mesh that have triangles, in the order of files, each with its triangles.
fn regions(mesh: &HullMesh) -> Vec<(Region, Vec<[usize; 3]>)> {
    let of = |wanted: Region| -> Vec<[usize; 3]> {
        mesh.triangles.iter().filter(|(region, _)| *region == wanted).map(|(_, corners)| *corners).collect()
    };
    Region::ALL.into_iter().map(|region| (region, of(region))).filter(|(_, list)| !list.is_empty()).collect()
}

/// A name on one line of printable ASCII, at most 72 of its characters.
fn title(name: &str) -> String {
    name.chars().take(72).map(|c| if c == ' ' || c.is_ascii_graphic() { c } else { '_' }).collect()
}

/// The normal of unit length of a triangle; zero where it has no area.
fn normal([a, b, c]: [[f64; 3]; 3]) -> [f64; 3] {
    let n = cross(minus(b, a), minus(c, a));
    let length = length(n);
    if length > 0.0 { n.map(|c| c / length) } else { [0.0; 3] }
}

#[cfg(test)]
mod tests;
