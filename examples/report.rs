//! Draws the figures and pages of a result: lines plan, sectional areas, curves of form, combs, PDF and HTML.
//!
//! `cargo run --example report`

use loftsman::prelude::*;

/// Writes a hull to `out/examples/report/wigley`, and its report to `report` in there.
pub fn main() -> Result<(), Failure> {
    let folder = "out/examples/report/wigley";
    overwrite(&generate("configs/wigley.toml")?.files, folder)?;
    let files = report(folder)?;
    files.iter().for_each(|file| println!("{:8} bytes  {}", file.contents.len(), file.name));
    overwrite(&files, "out/examples/report/wigley/report")
}
