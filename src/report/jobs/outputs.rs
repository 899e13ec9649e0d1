//! A hull that a job made, with the files about it.

use crate::config::Diagnostic;
use crate::exchange::SummaryFile;
use crate::hull::Hull;
use crate::hydrostatics::{CurvesOfForm, Hydrostatics};
use crate::report::output::files::OutputFile;

/// What the main job gives.
#[derive(Debug, Clone)]
pub struct Outputs {
    /// The hull.
    pub hull: Hull,
    /// The design condition.
    #[doc(hidden)]
    pub summary: SummaryFile,
    /// Hydrostatics at the design draught.
    pub design_row: Hydrostatics,
    /// The hydrostatic table.
    pub table: CurvesOfForm,
    /// Remarks about the design.
    pub remarks: Vec<Diagnostic>,
    /// The files, in the order of their names; the manifest is the last.
    pub files: Vec<OutputFile>,
}
