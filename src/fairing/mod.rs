//! What is unfair or wrong in a table or a hull: suspects among the offsets, lines that break, inflections and energies
//! of its curves.

mod adapt;
pub mod bends;
mod carry;
mod cells;
pub mod change;
mod changes;
mod choice;
mod compromise;
pub mod constraint;
pub mod curve;
mod determined;
pub mod error;
pub mod fair;
pub mod field;
mod fielded;
mod grades;
pub mod held;
mod humps;
pub mod infeasible;
pub mod inflections;
pub mod inspect;
pub mod job;
pub mod least;
pub mod least_waves;
mod lines;
mod local_noise;
pub mod metric;
pub mod model;
mod move_metric;
pub mod noise;
pub mod outcome;
pub mod program;
pub mod proposals;
pub mod record;
pub mod relinearise;
mod robust;
mod rules;
mod run;
pub mod smoothing;
mod start;
pub mod strength;
pub mod surface;
mod suspects;
mod unbroken;

pub use lines::{LineCourse, LineKind, ProposedLine, proposed_lines};
pub use run::Progress;
pub use suspects::{
    CellVerdict, Hypothesis, LinePlace, PointNumber, PointSuspect, PointSuspects, Reading, Suspect, Suspects,
    height_grid, height_suspects, point_suspects, suspects,
};
