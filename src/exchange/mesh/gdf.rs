//! GDF, the low-order panels of WAMIT (WAMIT User Manual, section 6.1): a title, ULEN and GRAV, ISX and ISY, the number
//! of panels, and for each the coordinates of its four corners, counter-clockwise seen from the water. ISY = 1: y = 0
//! is a plane of symmetry.

use std::fmt::Write as _;

use super::title;
use crate::hull::PanelMesh;

/// Acceleration of gravity \[m/s^2\].
const GRAVITY: f64 = 9.80665;

/// Text of a GDF file \[m\], the half y >= 0.
#[must_use]
pub fn write_gdf(mesh: &PanelMesh, name: &str) -> String {
    let mut text = format!("{}\n1 {GRAVITY} ULEN GRAV\n0 1 ISX ISY\n{}\n", title(name), mesh.panels.len());
    for corner in mesh.panels.iter().flatten() {
        let [x, y, z] = mesh.vertices[*corner];
        let _ = writeln!(text, "{x} {y} {z}");
    }
    text
}
