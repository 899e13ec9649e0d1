//! Lays a surface through a table of offsets and prints how well they determine its volume.
//!
//! `cargo run --example fit`

use loftsman::prelude::*;

/// Prints the volume of the surface, and that of a rule over the stations of the table.
pub fn main() -> Result<(), Failure> {
    let fitted = fit("tests/data/s175/offsets.csv")?;
    fitted.warnings.iter().for_each(|warning| eprintln!("{warning}"));
    let hull = &fitted.fitted.hull;
    println!("{}: {} control points", hull.name(), hull.surface().points().len());
    println!("volume {:.1} m3, over the stations alone {:.1?}", fitted.estimate.volume, fitted.estimate.stations);
    Ok(())
}
