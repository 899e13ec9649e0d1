//! What is unfair or wrong in a table or a hull: suspects among the offsets, inflections and energies of its curves.

pub mod inspect;
mod suspects;

pub use suspects::{CellVerdict, Hypothesis, Reading, Suspect, Suspects, suspects};
