//! What drawings and reports need of a faired table, without the program that made it: the hulls before and after, the
//! lines of the table, every offset with its move, the noise and the search for the smoothing weight.

use super::change::{Change, moves};
use super::constraint::Constraint;
use super::held::Held;
use super::lines::{self as proposed, LineCourse};
use super::outcome::Outcome;
use super::smoothing::Trial;
use super::suspects::Suspect;
use crate::hull::{Hull, LineKind, OffsetStation, OffsetTable};
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
    /// Where stations cross knuckles and tangent lines, station by station.
    pub crossings: Vec<Crossing>,
}

/// Where a station crosses a line along which the surface is less smooth.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Crossing {
    /// Index of the station.
    pub station: usize,
    /// Height \[m\].
    pub z: f64,
    /// What the line is.
    pub kind: LineKind,
}

/// The area that was asked of a section.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SectionTarget {
    /// Its place, forward of AP \[m\].
    pub x: f64,
    /// Area below the design draught \[m^2\].
    pub area: f64,
    /// How far the area may be off \[m^2\].
    pub band: f64,
}

/// What was asked of the sectional-area curve at the design draught.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct AreaTargets {
    /// Its area: the volume of displacement \[m^3\].
    pub volume: Option<f64>,
    /// Its centroid, forward of AP \[m\].
    pub lcb: Option<f64>,
    /// Its ordinates.
    pub sections: Vec<SectionTarget>,
}

impl AreaTargets {
    fn new(held: &[Held]) -> Self {
        let mut targets = Self::default();
        for constraint in held.iter().map(|held| &held.constraint) {
            match *constraint {
                Constraint::Displacement(volume) => targets.volume = Some(volume),
                Constraint::CentreOfBuoyancy(lcb) => targets.lcb = Some(lcb),
                Constraint::SectionArea { x, area, band } => targets.sections.push(SectionTarget { x, area, band }),
                _ => {}
            }
        }
        targets
    }
}

/// An offset that its neighbours contradict, or the net through all others.
#[derive(Debug, Clone, PartialEq)]
pub struct Doubt {
    /// `S1` is the most severe of those that the neighbours contradict; `N1` the first of those that the net contradicts.
    pub id: String,
    /// Index of the station.
    pub station: usize,
    /// Height of the waterline \[m\].
    pub z: f64,
    /// The half-breadth as the table has it \[m\].
    pub value: f64,
    /// What is proposed in its place \[m\].
    pub proposed: f64,
    /// Both as they are written; empty where the net contradicts.
    pub written: [String; 2],
    /// The slip that it may be, in words.
    pub hypothesis: String,
    /// How far it lies off, in local noise; none where the net contradicts.
    pub score: Option<f64>,
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
    /// What was asked of the sectional-area curve.
    pub targets: AreaTargets,
    /// Every offset that was read.
    pub changes: Vec<Change>,
    /// Offsets that are doubted, those that were left out first heard by their neighbours, then by the net.
    pub doubts: Vec<Doubt>,
    /// Energy of the start net, or of the likeliest field, and of the fair net, in the unit of [`Trial::energy`].
    pub energy: [f64; 2],
    /// Whether the first is that of the likeliest field.
    pub is_field: bool,
    /// The departure of a bend from its chord that counts \[m\].
    pub resolution: f64,
    /// Noise level of an offset \[m\].
    pub sigma: f64,
    /// What a search for the smoothing weight takes of it for errors \[m\].
    pub errors: f64,
    /// Offsets that are smoothed.
    pub readings: usize,
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
            crossings: crossings(table, outcome),
        }
    }
}

fn kind_of(kind: proposed::LineKind) -> LineKind {
    match kind {
        proposed::LineKind::Knuckle => LineKind::Knuckle,
        proposed::LineKind::Tangent => LineKind::Tangent,
    }
}

/// Marked cells, and where the lines of the table and those that were accepted meet its stations.
fn crossings(table: &OffsetTable, outcome: &Outcome) -> Vec<Crossing> {
    let accepted = || outcome.proposals.iter().filter(|proposal| proposal.accepted).map(|proposal| &proposal.line);
    let mut list: Vec<Crossing> = Vec::new();
    for (k, station) in table.stations.iter().enumerate() {
        let mut add = |z: f64, kind: LineKind| {
            let crossing = Crossing { station: k, z, kind };
            if !list.iter().any(|other| other.station == k && other.kind == kind && (other.z - z).abs() < 1e-6) {
                list.push(crossing);
            }
        };
        for (z, cell) in table.waterlines.iter().zip(&station.half_breadths) {
            for (marked, kind) in [(cell.marks.knuckle, LineKind::Knuckle), (cell.marks.tangent, LineKind::Tangent)] {
                if marked {
                    add(*z, kind);
                }
            }
        }
        let x = station.station.x;
        for line in accepted().filter(|line| line.course == LineCourse::Waterline) {
            if line.reach[0] <= x && x <= line.reach[1] {
                add(line.at, kind_of(line.kind));
            }
        }
        for line in &table.lines {
            for pair in line.points.windows(2) {
                let [a, b] = [pair[0], pair[1]];
                if a[0] <= x && x <= b[0] && b[0] > a[0] {
                    add(a[2] + (x - a[0]) / (b[0] - a[0]) * (b[2] - a[2]), line.kind);
                }
            }
        }
    }
    list
}

impl Doubt {
    fn of(suspect: &Suspect, waterlines: &[f64]) -> Self {
        Self {
            id: suspect.id.clone(),
            station: suspect.station,
            z: waterlines.get(suspect.waterline).copied().unwrap_or_default(),
            value: suspect.value,
            proposed: suspect.proposed,
            written: [suspect.written.clone(), suspect.proposed_text.clone()],
            hypothesis: suspect.hypothesis().as_str().to_owned(),
            score: Some(suspect.verdict.score),
        }
    }

    /// `heard` by their neighbours, and those that were left out besides: the net contradicts them.
    #[must_use]
    pub fn all(heard: Vec<Self>, changes: &[Change]) -> Vec<Self> {
        let known =
            |change: &Change| heard.iter().any(|d| d.station == change.station && (d.z - change.z).abs() < 1e-9);
        let left: Vec<Self> = changes
            .iter()
            .filter(|change| change.suspect && !known(change))
            .enumerate()
            .map(|(k, change)| Self {
                id: format!("N{}", k + 1),
                station: change.station,
                z: change.z,
                value: change.before,
                proposed: change.after,
                written: [String::new(), String::new()],
                hypothesis: "against the net of all others".to_owned(),
                score: None,
            })
            .collect();
        heard.into_iter().chain(left).collect()
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
            targets: AreaTargets::new(&outcome.held),
            changes: outcome.changes.clone(),
            doubts: Doubt::all(
                outcome.suspects.iter().map(|suspect| Doubt::of(suspect, &table.waterlines)).collect(),
                &outcome.changes,
            ),
            energy: outcome.energy,
            is_field: outcome.is_field,
            resolution: outcome.resolution,
            sigma: faired.sigma,
            errors: faired.errors,
            readings: faired.smoother.count(),
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
}

/// The departure that counts as one of a table \[m\]: its rounding, or a tenth of its noise.
#[must_use]
pub fn resolution(quantum: Option<f64>, sigma: f64) -> f64 {
    quantum.unwrap_or(0.0).max(0.1 * sigma)
}

/// What counts as a bump of a line of a hull of length `length` \[m\] whose offsets are written to `quantum` \[m\]: L_PP /
/// 50,000 or twice the resolution, whichever is more.
pub(super) fn bump(length: f64, quantum: f64) -> f64 {
    (length / 50_000.0).max(2.0 * quantum)
}

/// What counts as the accuracy of a table \[m\]: two steps of its writing, or twice its noise where that is more.
#[must_use]
pub fn accuracy(quantum: Option<f64>, sigma: f64) -> f64 {
    (2.0 * quantum.unwrap_or(0.0)).max(2.0 * sigma)
}
