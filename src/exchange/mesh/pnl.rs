//! PNL, the hull mesh of HAMS: a header with the numbers of panels and nodes and the symmetries (0 1: y = 0 is a plane
//! of symmetry), the nodes with their numbers, and the panels with theirs, their number of corners and those,
//! counter-clockwise seen from the water.

use std::fmt::Write as _;

use crate::hull::PanelMesh;

/// Text of a PNL file \[m\], the half y >= 0.
#[must_use]
pub fn write_pnl(mesh: &PanelMesh) -> String {
    let mut text = format!(
        "    --------------Hull Mesh File---------------\n\n    # Number of Panels, Nodes, X-Symmetry and Y-Symmetry\n{} {} 0 1\n\n\
         #Start Definition of Node Coordinates     ! node_number   x   y   z\n",
        mesh.panels.len(),
        mesh.vertices.len()
    );
    for (k, [x, y, z]) in mesh.vertices.iter().enumerate() {
        let _ = writeln!(text, "{} {x} {y} {z}", k + 1);
    }
    text.push_str(
        "#End Definition of Node Coordinates\n\n\
         #Start Definition of Node Relations   ! panel_number  number_of_vertices   Vertex1_ID   Vertex2_ID   Vertex3_ID   (Vertex4_ID)\n",
    );
    for (k, &[a, b, c, d]) in mesh.panels.iter().enumerate() {
        let _ = match c == d {
            true => writeln!(text, "{} 3 {} {} {}", k + 1, a + 1, b + 1, c + 1),
            false => writeln!(text, "{} 4 {} {} {} {}", k + 1, a + 1, b + 1, c + 1, d + 1),
        };
    }
    text.push_str("#End Definition of Node Relations\n\n    --------------End Hull Mesh File---------------\n");
    text
}
