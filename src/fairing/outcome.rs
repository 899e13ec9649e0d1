//! What a job comes to: every offset with its move, what is held, what bends, and what is to be said of it.

use super::change::{Change, Predicted, Turns, moves};
use super::constraint::Constraint;
use super::fair::Faired;
use super::field::line_errors::FoundErrors;
use super::held::{Held, HeldRule};
use super::inspect::{PolygonSigns, is_of_table, kind};
use super::proposals::Proposal;
use super::start::Taken;
use super::strength::{Fairness, far_above};
use super::suspects::Suspect;
use crate::hull::{Cut, Hull, OffsetTable};
use crate::numeric::median;
use crate::qp::Status;
use crate::units::counted;

/// What a job comes to.
#[derive(Debug, Clone)]
pub struct Outcome {
    /// How the program ended.
    pub status: Status,
    /// The surface through the table.
    pub before: Hull,
    /// The fair hull.
    pub after: Hull,
    /// The table of the fair hull, in the writing of the old one and not rounded yet.
    pub table: OffsetTable,
    /// Every cell that was read.
    pub changes: Vec<Change>,
    /// What they move normal to the hull, root of the mean square and the most \[m\].
    pub normal_moves: [f64; 2],
    /// Offsets that were unknown: doubtful ones of the fair table.
    pub predicted: Vec<Predicted>,
    /// Constraints.
    pub held: Vec<Held>,
    /// Rules for lines and regions.
    #[doc(hidden)]
    pub rules: Vec<HeldRule>,
    /// Regions of one sign of Gaussian curvature before and after.
    pub regions: [usize; 2],
    /// Curves of the table's stations and waterlines, of buttocks and of diagonals, which were never used.
    pub turns: Vec<Turns>,
    /// Knuckles and tangent lines that the table has and does not declare.
    #[doc(hidden)]
    pub proposals: Vec<Proposal>,
    /// Signs of the control polygons of the nets before and after.
    #[doc(hidden)]
    pub signs: [Vec<PolygonSigns>; 2],
    /// Suspects of the table.
    pub suspects: Vec<Suspect>,
    /// The program, its certificate, its noise level and its pattern.
    #[doc(hidden)]
    pub faired: Faired,
    /// How strongly the table was faired.
    pub fairness: Fairness,
    /// Order of the energy.
    pub order: usize,
    /// Energy of the start net and of the fair net.
    pub energy: [f64; 2],
    /// The greatest jump of curvature of the fair hull across lines of its net where the surface through the table has
    /// none and none is declared \[1/m\]; none on a field.
    pub jump: Option<f64>,
    /// By how much the half-breadth passes the greatest of the table, or B/2, before and after \[m\].
    pub beyond: [f64; 2],
    /// Whether the net is that of a fair field.
    pub is_field: bool,
    /// Noise of the offsets where their neighbourhood is smooth \[m\]; what is taken of it is [`Faired::sigma`].
    pub table_noise: f64,
    /// What offsets of a line were found to be off by together.
    #[doc(hidden)]
    pub line_errors: Option<FoundErrors>,
    /// Departure of a bend from its chord below which it is no inflection \[m\]: the rounding of the table, or a tenth of
    /// its noise.
    pub resolution: f64,
    /// Whether targets that cannot be met within the tolerances were replaced by the nearest that can.
    pub nearest: bool,
    /// What the job came to in words, and then what the surface through the table had to assume.
    pub notes: Vec<String>,
    /// The way in which it was done, for other grades of fairness.
    pub(super) taken: Taken,
}

/// Inflections of curves together, before and after.
pub(super) fn total(lines: &[Turns]) -> [usize; 2] {
    lines.iter().fold([0, 0], |[before, after], turns| [before + turns.before, after + turns.after])
}

/// Curves that bend more often after than before, in words; `wished` says whether anything is asked for besides what the
/// table has, `carried` is the factor on the tolerances from which targets are had by one smooth move.
pub(super) fn more_often(lines: &[Turns], wished: bool, carried: Option<f64>) -> Option<String> {
    let worse: Vec<&Turns> = lines.iter().filter(|turns| turns.after > turns.before).collect();
    let kinds = ["station", "waterline", "buttock", "diagonal"].map(|wanted| {
        let own: Vec<&&Turns> = worse.iter().filter(|turns| kind(&turns.cut) == wanted).collect();
        let [before, after] = own.iter().fold([0, 0], |sum, turns| [sum[0] + turns.before, sum[1] + turns.after]);
        (!own.is_empty()).then(|| format!("{} from {before} to {after}", counted(own.len(), wanted)))
    });
    let parts: Vec<String> = kinds.into_iter().flatten().collect();
    (!parts.is_empty()).then(|| {
        let wider = match carried.filter(|factor| *factor > 1.0) {
            Some(factor) => {
                format!("tolerances {factor:.2} times as wide, with which the targets are one smooth move,")
            }
            None => "wider tolerances".to_owned(),
        };
        let why = if wished {
            format!("the targets or locks require that; nearer targets or {wider} would leave a fairer hull")
        } else {
            "their signs do not go together with those of the other lines, half-breadths up to B/2 and the tolerances"
                .to_owned()
        };
        format!("bend more often than before: {}; {why}", parts.join(", "))
    })
}

impl Outcome {
    /// The height \[m\] below which volume and its centre are held where no draught is stated, and what is held there in
    /// words; none where a draught is stated, or neither is held.
    #[must_use]
    pub fn held_below(&self) -> Option<(f64, String)> {
        let of = |constraint: Constraint| match constraint {
            Constraint::Volume { below, .. } => Some(("volume", below)),
            Constraint::CentreOfVolume { below, .. } => Some(("centre of volume", below)),
            _ => None,
        };
        let (names, heights): (Vec<&str>, Vec<f64>) = self.held.iter().filter_map(|held| of(held.constraint)).unzip();
        let below = *heights.first()?;
        Some((below, format!("{} below z = {below:.3} m (no draught is stated)", names.join(" and "))))
    }

    /// Heights of the waterlines that were looked at \[m\]: those of the table, of a table of sections those of a
    /// drawing.
    #[must_use]
    pub fn waterlines(&self) -> Vec<f64> {
        let heights = self.turns.iter().filter_map(|turns| match turns.cut {
            Cut::Waterline { z } => Some(z),
            _ => None,
        });
        heights.collect()
    }

    /// Root of the mean square and largest of the moves of what was not left out \[m\], with the place of the largest.
    #[must_use]
    pub fn moves(&self) -> (f64, f64, Option<&Change>) {
        moves(&self.changes)
    }

    /// Inflections before and after of one kind of curve: station, waterline, buttock or diagonal.
    #[must_use]
    pub fn inflections(&self, of: &str) -> [usize; 2] {
        let list = self.turns.iter().filter(|turns| kind(&turns.cut) == of);
        list.fold([0, 0], |[before, after], turns| [before + turns.before, after + turns.after])
    }

    /// Changes of sign of curvature on all stations and waterlines before and after.
    #[must_use]
    pub fn changes_of_sign(&self) -> [usize; 2] {
        let [stations, waterlines] = ["station", "waterline"].map(|kind| self.inflections(kind));
        [stations[0] + waterlines[0], stations[1] + waterlines[1]]
    }

    /// The least number of them within the tolerances, the sum over the lines; none where that of a line is not known.
    #[must_use]
    pub fn least_changes_of_sign(&self) -> Option<usize> {
        self.table_lines().map(|turns| turns.minimum.map(|(least, _)| least)).sum()
    }

    /// Stations and waterlines.
    fn table_lines(&self) -> impl Iterator<Item = &Turns> {
        self.turns.iter().filter(|turns| is_of_table(&turns.cut))
    }

    /// Monotone pieces of curvature on all stations and waterlines before and after.
    #[must_use]
    pub fn monotone_pieces(&self) -> [usize; 2] {
        [0, 1].map(|side| self.table_lines().map(|turns| turns.pieces[side]).sum())
    }

    /// The least number of them, the sum of [`Turns::least_pieces`]; none where that of a line is not known.
    #[must_use]
    pub fn least_monotone_pieces(&self) -> Option<usize> {
        self.table_lines().map(Turns::least_pieces).sum()
    }

    /// Total variation of curvature over its range before and after \[-\], the median of the stations and waterlines that
    /// have both; none where none has.
    #[must_use]
    pub fn variation(&self) -> Option<[f64; 2]> {
        let pairs = self.table_lines().filter_map(|turns| Some([turns.variation[0]?, turns.variation[1]?]));
        let pairs: Vec<[f64; 2]> = pairs.collect();
        let middle = |side: usize| median(&mut pairs.iter().map(|pair| pair[side]).collect::<Vec<f64>>());
        Some([middle(0)?, middle(1)?])
    }

    /// Whether stations and waterlines have more changes of sign or more monotone pieces than before, or from the default
    /// grade of fairness on no fewer changes of sign where they are far above the least. Of the surface through the
    /// table nobody asks for less.
    #[must_use]
    pub fn is_no_fairer(&self) -> bool {
        let [before, after] = self.changes_of_sign();
        let [pieces, pieces_after] = self.monotone_pieces();
        let far = |least: usize| Fairness::default().near_least().is_some_and(|factor| far_above(after, least, factor));
        let promised = self.fairness.promises_a_fairer_hull();
        let stalled = promised && after == before && self.least_changes_of_sign().is_some_and(far);
        !self.fairness.is_raw() && (after > before || pieces_after > pieces || stalled)
    }

    /// How many targets the surface through the table is off by more than a part of their scale.
    #[must_use]
    pub fn targets_off(&self, part: f64) -> usize {
        self.held.iter().filter(|held| held.constraint.missed(held.before, &self.before) > part).count()
    }

    /// Inflections of all curves before and after.
    #[must_use]
    pub fn all_inflections(&self) -> [usize; 2] {
        total(&self.turns)
    }
}
