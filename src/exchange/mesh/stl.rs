//! STL (3D Systems, 1988): binary, all regions in one solid; and ASCII, a named solid for each region.

use std::fmt::Write as _;

use super::{normal, regions};
use crate::hull::HullMesh;

/// Binary STL: 80 bytes of header, the number of triangles, and for each its normal, its corners as 32-bit reals \[m\] and two bytes
/// that say nothing.
#[must_use]
pub fn write_stl(mesh: &HullMesh, name: &str) -> Vec<u8> {
    let mut header: Vec<u8> = format!("{name}, metres").into_bytes();
    // A header that begins with "solid" is taken for ASCII.
    if header.starts_with(b"solid") {
        header.insert(0, b' ');
    }
    header.resize(80, b' ');
    let mut bytes = header;
    let count = u32::try_from(mesh.triangles.len()).unwrap_or(u32::MAX);
    bytes.extend(count.to_le_bytes());
    for (_, list) in regions(mesh) {
        for corners in list {
            let corners = corners.map(|k| mesh.vertices[k]);
            for point in [normal(corners)].into_iter().chain(corners) {
                for coordinate in point {
                    bytes.extend((coordinate as f32).to_le_bytes());
                }
            }
            bytes.extend([0, 0]);
        }
    }
    bytes
}

/// ASCII STL: `solid hull`, `solid transom`, ... each with its triangles \[m\].
#[must_use]
pub fn write_stl_ascii(mesh: &HullMesh) -> String {
    let mut text = String::new();
    let mut put = |line: String| {
        text.push_str(&line);
        text.push('\n');
    };
    for (region, list) in regions(mesh) {
        put(format!("solid {}", region.name()));
        for corners in list {
            let corners = corners.map(|k| mesh.vertices[k]);
            let [x, y, z] = normal(corners);
            put(format!("facet normal {x:e} {y:e} {z:e}\nouter loop"));
            for [x, y, z] in corners {
                let mut line = String::from("vertex");
                for coordinate in [x, y, z] {
                    let _ = write!(line, " {coordinate}");
                }
                put(line);
            }
            put("endloop\nendfacet".to_owned());
        }
        put(format!("endsolid {}", region.name()));
    }
    text
}
