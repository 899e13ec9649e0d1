//! Suspects among the offsets of a table: cells that their neighbours in both directions contradict, and points of
//! sections that lie off the curve of the others.
mod boat_lines;
mod grid;
mod heights;
mod judge;
mod outline;
mod posterior;
mod reading;
mod search;
mod stencil;

pub(super) use grid::{Along, Grid};
pub use heights::{height_grid, height_suspects};
pub use outline::{LinePlace, PointNumber, PointSuspect, PointSuspects};
pub use posterior::Reading;
pub use reading::Hypothesis;
pub use search::{CellVerdict, Suspect, Suspects, suspects};

use crate::hull::OffsetTable;

/// The suspects among the points of the sections of a table; nothing is changed. Tables of lines, as boats have them, are
/// judged along their lines, others section by section.
#[must_use]
pub fn point_suspects(table: &OffsetTable) -> PointSuspects {
    if boat_lines::has_lines(table) { boat_lines::line_suspects(table) } else { outline::section_suspects(table) }
}
