//! Hydrostatics of a table of offsets; meshes, CAD files, designs and results are read alike.
//!
//! `cargo run --example hydrostatics`

use loftsman::prelude::*;

/// Prints a row a draught.
pub fn main() -> Result<(), Failure> {
    let body = hydrostatics("tests/data/s175/offsets.csv", &[7.0, 8.0, 9.0, 9.5])?;
    body.notes.iter().for_each(|note| eprintln!("{note}"));
    for row in &body.curves.rows {
        let (kb, lcb) = (row.kb.unwrap_or(f64::NAN), row.lcb.unwrap_or(f64::NAN));
        println!("{:6.2} m  {:9.1} m3  KB {kb:.3} m  LCB {lcb:.3} m", row.draught, row.displacement_volume);
    }
    Ok(())
}
