//! Generates the hull of a design file and prints its hydrostatics at the design draught.
//!
//! `cargo run --example generate`

use loftsman::prelude::*;

/// Prints displacement and coefficients, which are those of the file to machine precision.
pub fn main() -> Result<(), Failure> {
    let frigate = generate("configs/frigate.toml")?;
    let row = &frigate.design_row;
    println!("displacement {:.3} m3 at {:.2} m", row.displacement_volume, row.draught);
    println!("Cb {:.6}, Cm {:.6}", row.block_coefficient.unwrap_or(0.0), row.midship_coefficient.unwrap_or(0.0));
    println!("half-breadth {:.4} m at 20 m, 2 m up", frigate.hull.half_breadth(20.0, 2.0).unwrap_or(0.0));
    Ok(())
}
