//! Fairs one waterline within 5 mm and proves the least number of its inflections.
//!
//! `cargo run --example fair_curve`

use loftsman::prelude::*;

/// Prints the moves of the points, and the inflections before and after.
pub fn main() -> Result<(), Failure> {
    let settings = CurveSettings { tolerance: Some(0.005), ..CurveSettings::default() };
    let done = fair_curve("examples/waterline.csv", settings)?;
    let [before, after] = &done.fair.inflections;
    println!("inflections {} > {}, least {}", before.len(), after.len(), done.fair.least.count);
    done.verdict()
}
