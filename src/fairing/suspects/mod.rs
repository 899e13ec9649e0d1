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
pub use outline::{LinePlace, PointNumber, PointSuspect, PointSuspects, point_suspects};
pub use posterior::Reading;
pub use reading::Hypothesis;
pub use search::{CellVerdict, Suspect, Suspects, suspects};
