//! Writes a hull as STEP, IGES and a closed mesh.
//!
//! `cargo run --example export`

use loftsman::prelude::*;

/// Writes to `out/examples/export`.
pub fn main() -> Result<(), Failure> {
    let hull = open("configs/tug.toml")?.hull;
    let exported = export(&hull, "tug", &[ExportFormat::Step, ExportFormat::Iges, ExportFormat::Stl])?;
    println!("{}", exported.page);
    overwrite(&exported.files, "out/examples/export")
}
