//! Wavefront OBJ: vertices once, a group for each region.

use std::fmt::Write as _;

use super::regions;
use crate::hull::HullMesh;

/// Text of an OBJ file \[m\]; x forward, y to port, z up.
#[must_use]
pub fn write_obj(mesh: &HullMesh, name: &str) -> String {
    let one_line = name.replace(['\n', '\r'], " ");
    let mut text = format!("# {one_line}: x forward, y to port, z up, metres\no hull\n");
    for [x, y, z] in &mesh.vertices {
        let _ = writeln!(text, "v {x} {y} {z}");
    }
    for (region, list) in regions(mesh) {
        let _ = writeln!(text, "g {}", region.name());
        for [a, b, c] in list {
            let _ = writeln!(text, "f {} {} {}", a + 1, b + 1, c + 1);
        }
    }
    text
}
