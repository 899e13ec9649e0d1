//! Quantities as people write them: lengths, angles, masses, ratios with their units, lists of positions, and lengths in
//! the notations of tables of offsets. Text in, SI out (masses in tonnes, as the field counts them); no files, no floor.

mod cell;
mod list;
mod notation;
mod quantity;
mod text;

pub use cell::{CellEntry, CellError, CellReading, CellRules, CellWriting, LONGEST_CELL, parse_cell};
pub use list::{ListError, MAX_ITEMS, decimal, parse_list};
pub use notation::{Notation, feet_inches_eighths};
pub use quantity::{Dimension, KNOT, Measure, UnitError, parse, parse_length};
pub use text::{LONGEST_NAME, LineStarts, NAME_REMEDY, guarded, name_fault, unguarded};

/// A number and its noun, which takes an `s` where the number is not one: `1 station`, `3 stations`.
#[must_use]
pub fn counted(number: usize, noun: &str) -> String {
    format!("{number} {noun}{}", if number == 1 { "" } else { "s" })
}
