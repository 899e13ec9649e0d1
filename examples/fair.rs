//! Fairs a table of offsets: a draught, a tolerance and a target for LCB are stated. The verdict is an error where the
//! targets are not met within the tolerance, or where the hull is no fairer. Writes hull and tables to `out/examples/fair`.
//!
//! `cargo run --example fair`

use loftsman::prelude::*;

/// Prints the verdict, and writes the hull with its tables.
pub fn main() -> Result<(), Failure> {
    let settings = [("dimensions.T", "6.502"), ("tolerance.table", "20 mm"), ("hold.LCB", "-1.5 %")];
    let faired = fair("tests/data/series60_cb060/offsets.csv", &settings)?;
    println!("{}", faired.headline());
    overwrite(&faired.files, "out/examples/fair")?;
    faired.verdict()
}
