//! Suspects among the offsets of a table: cells that their neighbours in both directions contradict.
mod grid;
mod judge;
mod posterior;
mod reading;
mod search;
mod stencil;

pub use posterior::Reading;
pub use reading::Hypothesis;
pub use search::{CellVerdict, Suspect, Suspects, suspects};
