//! Fairs a table of offsets: a draught, a tolerance and a target for LCB are stated.
//!
//! `cargo run --example fair`

use loftsman::prelude::*;

/// Prints the verdict, the largest moves and a half-breadth of the fair hull.
pub fn main() -> Result<(), Failure> {
    let settings = [("dimensions.T", "6.502"), ("tolerance.table", "20 mm"), ("hold.LCB", "-1.5 %")];
    let faired = fair("tests/data/series60_cb060/offsets.csv", &settings)?;
    println!("{}", faired.headline());
    let outcome = &faired.outcome;
    outcome.notes.iter().for_each(|note| println!("- {note}"));
    println!("half-breadth {:.4} m at 60 m, 5 m up", outcome.after.half_breadth(60.0, 5.0).unwrap_or(0.0));
    // An error where the targets are not met within the tolerance, or where the hull is no fairer.
    faired.verdict()
}
