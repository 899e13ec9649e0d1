//! Cuts a hull by planes.
//!
//! `cargo run --example sections`

use loftsman::prelude::*;

/// Prints the points of a station, a waterline and an oblique plane.
pub fn main() -> Result<(), Failure> {
    let hull = open("configs/wigley.toml")?.hull;
    let oblique = Cut::Plane { normal: [0.0, 1.0, 1.0], offset: 6.0 };
    for section in sections(&hull, &[Cut::Station { x: 50.0 }, Cut::Waterline { z: 4.0 }, oblique]) {
        for branch in &section.branches {
            // Points whose chords are within 1 cm of the curve.
            let points = branch.polyline(0.01);
            println!("{:?}: {} points, first {:.3?}", section.cut, points.len(), points[0]);
        }
    }
    Ok(())
}
