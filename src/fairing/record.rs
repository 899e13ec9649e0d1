//! What drawings and reports need of a faired table, without the program that made it: the hulls before and after, the lines of
//! the table, every offset with its move, the noise and the search for the smoothing weight.

use super::job::{Change, Outcome};
use super::smoothing::Trial;
use crate::hull::{Hull, OffsetStation, OffsetTable};
use crate::qp::{Progress, Status};
use crate::units::Notation;

/// The lines of a table and the steps of its writing.
#[derive(Debug, Clone, PartialEq)]
pub struct TableLines {
    /// Stations, rising in x.
    pub stations: Vec<OffsetStation>,
    /// Heights of the waterlines \[m\]; of a table of sections those of a drawing.
    pub waterlines: Vec<f64>,
    /// Ends of each waterline, aft and fore \[m\].
    pub endings: Vec<[Option<f64>; 2]>,
    /// Step between two offsets that can be told apart \[m\].
    pub quantum: Option<f64>,
    /// Notation of the offsets.
    pub notation: Notation,
}

/// A faired table.
#[derive(Debug, Clone)]
pub struct FairRecord {
    /// Name of the ship.
    pub name: String,
    /// How the program ended.
    pub status: Status,
    /// The surface through the table.
    pub before: Hull,
    /// The fair hull.
    pub after: Hull,
    /// Lines of the table.
    pub lines: TableLines,
    /// Every offset that was read.
    pub changes: Vec<Change>,
    /// Noise level of an offset \[m\].
    pub sigma: f64,
    /// Smoothing weight.
    pub lambda: f64,
    /// Effective degrees of freedom of the smoothed net.
    pub edf: f64,
    /// The smoothed net without any wish, at the weight that was taken.
    pub chosen: Trial,
    /// The search for the weight.
    pub trials: Vec<Trial>,
    /// The iterates of the last program.
    pub progress: Vec<Progress>,
}

impl TableLines {
    /// Those of a table and of what was looked at.
    #[must_use]
    pub fn new(table: &OffsetTable, outcome: &Outcome) -> Self {
        Self {
            stations: table.stations.iter().map(|station| station.station.clone()).collect(),
            waterlines: if table.waterlines.is_empty() { outcome.waterlines() } else { table.waterlines.clone() },
            endings: table.endings.clone(),
            quantum: table.form.quantum(),
            notation: table.form.notation,
        }
    }
}

impl FairRecord {
    /// What is drawn of a table and what became of it.
    #[must_use]
    pub fn new(table: &OffsetTable, outcome: &Outcome) -> Self {
        let faired = &outcome.faired;
        Self {
            name: table.name.clone(),
            status: outcome.status,
            before: outcome.before.clone(),
            after: outcome.after.clone(),
            lines: TableLines::new(table, outcome),
            changes: outcome.changes.clone(),
            sigma: faired.sigma,
            lambda: faired.lambda,
            edf: faired.edf,
            chosen: faired.chosen,
            trials: faired.trials.clone(),
            progress: faired.solved.solution.progress.clone(),
        }
    }

    /// Root of the mean square and largest of the moves of what was not left out \[m\], with the place of the largest.
    #[must_use]
    pub fn moves(&self) -> (f64, f64, Option<&Change>) {
        moves(&self.changes)
    }

    /// The departure that counts as one of the table \[m\]: its rounding, or a tenth of its noise.
    #[must_use]
    pub fn tolerance(&self) -> f64 {
        self.lines.quantum.unwrap_or(0.0).max(0.1 * self.sigma)
    }
}

/// Root of the mean square and largest of the moves of what was not left out \[m\], with the place of the largest.
pub(super) fn moves(changes: &[Change]) -> (f64, f64, Option<&Change>) {
    let kept: Vec<&Change> = changes.iter().filter(|change| !change.suspect).collect();
    let size = |change: &Change| (change.after - change.before).abs();
    let squares: f64 = kept.iter().map(|change| size(change).powi(2)).sum();
    let largest = kept.iter().copied().max_by(|a, b| size(a).total_cmp(&size(b)));
    ((squares / kept.len().max(1) as f64).sqrt(), largest.map_or(0.0, size), largest)
}
