//! Meshes of NEMOH (Ecole Centrale de Nantes): `2 1` (1: y = 0 is a plane of symmetry), the vertices with their numbers
//! up to a line of zeros, and the four corners of each panel, counter-clockwise seen from the water, up to a line of
//! zeros. A triangle repeats a corner.

use std::fmt::Write as _;

use crate::hull::PanelMesh;

/// Text of a mesh file of NEMOH \[m\], the half y >= 0.
#[must_use]
pub fn write_nemoh(mesh: &PanelMesh) -> String {
    let mut text = String::from("2 1\n");
    for (k, [x, y, z]) in mesh.vertices.iter().enumerate() {
        let _ = writeln!(text, "{} {x} {y} {z}", k + 1);
    }
    text.push_str("0 0 0 0\n");
    for [a, b, c, d] in &mesh.panels {
        let _ = writeln!(text, "{} {} {} {}", a + 1, b + 1, c + 1, d + 1);
    }
    text.push_str("0 0 0 0\n");
    text
}
