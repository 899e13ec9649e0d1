//! What is wished of a table of offsets, and why it may not be faired: smoothing, what is held, rules, tolerances. How
//! it is done: `run`; what it comes to: [`super::outcome`].

use super::constraint::{Constraint, Rule};
use super::error::FairError;
use super::least_waves::WaveAim;
use super::lines::{LineCourse, LineKind, ProposedLine};
use super::proposals::Accepted;
use super::strength::Fairness;
use super::surface::{FairSurface, Origin};
use crate::hull::{FitError, Hull, HullError, OffsetTable};
use crate::qp::Settings;
use crate::resistance::WaveRequest;

/// Least tolerance over the breadth: below it a difference is rounding.
pub(super) const LEAST_TOLERANCE: f64 = 1e-6;

/// Least tolerance of the table over its noise with which a field has something to smooth.
const LEAST_ROOM: f64 = 0.5;

/// L_PP over the length of the stations, and the reverse, from which it is none of this hull.
pub(super) const MOST_LENGTH: f64 = 10.0;

/// A section this near to midship, over L_PP, is the midship section.
pub const AMIDSHIPS: f64 = 1e-6;

/// Coefficients that differ by less are one.
const SAME: f64 = 1e-9;

/// Area of a section over B T below which it is none.
const EMPTY: f64 = 1e-9;

/// What is held of the hull.
#[derive(Debug, Clone, PartialEq)]
pub enum Holding {
    /// Displacement, LCB and C_M of the table's own surface; where no draught is stated, volume and centre of volume below
    /// [`Hull::reference_height`].
    Table,
    /// These.
    Given(Vec<Constraint>),
    /// The first at the values of the table's own surface, the others as they are given.
    Both {
        /// Held at the table's own values, whatever their targets are.
        own: Vec<Constraint>,
        /// Held at their targets.
        given: Vec<Constraint>,
    },
}

impl Holding {
    /// The constraints, of the surface through the table where they are its own; without its own C_M where midship is not
    /// known ([`Hull::counts_from_aft_perpendicular`]). Where no draught is stated, volume and its centre below
    /// [`Hull::reference_height`] take the place of the table's displacement and LCB. Where displacement and C_B, or the area
    /// amidships and C_M, say the same to the digits in which the coefficient is written, the coefficient is left out.
    ///
    /// # Errors
    /// [`JobError::Apart`] where they do not; [`JobError::NoDraught`] where a target needs a draught and none is stated.
    pub(super) fn constraints(&self, before: &Hull) -> Result<Vec<Constraint>, JobError> {
        let p = before.particulars();
        let below = before.reference_height();
        // Without a draught nothing is held at one.
        let afloat = |constraint: &Constraint| match constraint {
            _ if p.draught.is_some() => Some(*constraint),
            Constraint::Displacement(volume) => Some(Constraint::Volume { volume: *volume, below }),
            Constraint::CentreOfBuoyancy(x) => Some(Constraint::CentreOfVolume { x: *x, below }),
            other => (!other.needs_draught()).then_some(*other),
        };
        let valued = |constraint: Constraint| constraint.with_target(constraint.value(before));
        if let (None, Self::Given(given) | Self::Both { given, .. }) = (p.draught, self) {
            let words: Vec<String> = given.iter().filter(|c| c.needs_draught()).map(Constraint::words).collect();
            if !words.is_empty() {
                return Err(JobError::NoDraught(words.join(", ")));
            }
        }
        // The section amidships of a hull whose midship is not known is any section.
        let counts = before.counts_from_aft_perpendicular();
        let known_place = |constraint: &&Constraint| counts || !matches!(constraint, Constraint::MidshipCoefficient(_));
        let mut constraints: Vec<Constraint> = match self {
            Self::Given(list) => list.clone(),
            Self::Both { own: list, given } => {
                // A section above the water has no area.
                let least = EMPTY * p.breadth * below;
                let there = |c: &Constraint| !matches!(c, Constraint::SectionArea { area, .. } if *area <= least);
                let own = list.iter().filter(known_place).filter_map(afloat).map(valued).filter(there);
                own.chain(given.iter().copied()).collect()
            }
            Self::Table => {
                [Constraint::Displacement(0.0), Constraint::CentreOfBuoyancy(0.0), Constraint::MidshipCoefficient(0.0)]
                    .iter()
                    .filter(known_place)
                    .filter_map(afloat)
                    .map(valued)
                    .collect()
            }
        };
        // What says a coefficient again is at a draught.
        let [length, breadth, draught] = [p.length_between_perpendiculars, p.breadth, below];
        // What says a coefficient again: the coefficient that it is, and itself in words.
        let said = |coefficient: &Constraint, other: &Constraint| match (coefficient, other) {
            (Constraint::BlockCoefficient(asked), Constraint::Displacement(volume)) => {
                let words = format!("a displacement of {volume:.2} m3 is C_B");
                Some((*asked, volume / (length * breadth * draught), words))
            }
            (Constraint::MidshipCoefficient(asked), Constraint::SectionArea { x, area, band })
                if *band <= 0.0 && (x - 0.5 * length).abs() <= AMIDSHIPS * length =>
            {
                let words = format!("a section area of {area:.3} m2 at x = {x:.3} m is C_M");
                Some((*asked, area / (breadth * draught), words))
            }
            _ => None,
        };
        let twice = |constraints: &[Constraint]| {
            let mut coefficients = constraints.iter().enumerate();
            coefficients.find_map(|(at, own)| Some((at, constraints.iter().find_map(|other| said(own, other))?)))
        };
        while let Some((at, (asked, implied, words))) = twice(&constraints) {
            let digits = format!("{asked}").split_once('.').map_or(0, |(_, digits)| digits.len());
            let written = 0.5 * 0.1f64.powi(i32::try_from(digits).unwrap_or(i32::MAX));
            if (implied - asked).abs() > written.max(SAME) {
                let words =
                    format!("{words} {implied:.4} with L_PP {length:.3} m, B {breadth:.3} m and T {draught:.3} m");
                return Err(JobError::Apart { coefficient: constraints[at].key(), words, asked });
            }
            constraints.remove(at);
        }
        Ok(constraints)
    }
}

/// How far a reading may move.
#[derive(Debug, Clone, PartialEq)]
pub struct Tolerance {
    /// The same for the whole table \[m\], three levels of the most that is taken for noise on the net of a fit; none:
    /// three noise levels, at least two quanta of the writing.
    pub table: Option<f64>,
    /// For single stations: (index, tolerance \[m\]); where a waterline has one too, the lesser.
    pub stations: Vec<(usize, f64)>,
    /// For single waterlines: (index, tolerance \[m\]).
    pub waterlines: Vec<(usize, f64)>,
    /// For single cells: (station, waterline, tolerance \[m\]).
    pub cells: Vec<(usize, usize, f64)>,
}

/// How a table is faired: grade, targets, tolerances and locks. [`Job::run`] does it.
#[derive(Debug, Clone)]
pub struct Job {
    /// How strongly the table is faired.
    pub fairness: Fairness,
    /// Smoothing weight; none: that of the likelihood of a field, else that for the errors of the table.
    pub weight: Option<f64>,
    /// What is held.
    pub holding: Holding,
    /// Rules for lines and regions.
    #[doc(hidden)]
    pub rules: Vec<Rule>,
    /// Which of the lines that are proposed are taken.
    #[doc(hidden)]
    pub accepted: Accepted,
    /// Lines across which slope or curvature break, that the table does not declare.
    #[doc(hidden)]
    pub lines: Vec<ProposedLine>,
    /// Tolerances.
    pub tolerance: Tolerance,
    /// Cells that must not move: (station, waterline).
    pub locked: Vec<(usize, usize)>,
    /// Whether a level table without locks, rules and lines is smoothed as a fair field ([`super::field`]), where that
    /// follows it.
    pub field: bool,
    /// Whether suspects are left out.
    pub exclude_suspects: bool,
    /// Whether extraneous changes of curvature are forbidden.
    pub signs: bool,
    /// Dearest change of curvature that is forbidden, in squares of the noise; none: by the grade and what it comes to.
    pub price: Option<f64>,
    /// The wave resistance that is made small besides, at the design draught.
    #[doc(hidden)]
    pub waves: Option<WaveRequest>,
    /// The solver.
    #[doc(hidden)]
    pub solver: Settings,
}

impl Job {
    /// Whether a field is asked for, and nothing that only the net of a fit can do; `noise` \[m\] is that of the table.
    pub(super) fn suits_a_field(&self, noise: f64) -> bool {
        self.field
            && self.tolerance.table.is_none_or(|tolerance| tolerance >= LEAST_ROOM * noise)
            && !self.rules.iter().any(|rule| matches!(rule, Rule::FlatOfSide { .. } | Rule::FlatOfBottom { .. }))
            && self.lines.is_empty()
            && self.accepted == Accepted::None
    }
}

impl Job {
    /// The wave resistance that is asked for, at the draught of the ship \[m\].
    pub(super) fn waves_at(&self, draught: Option<f64>) -> Result<Option<WaveAim>, JobError> {
        let aim = |request: &WaveRequest| match draught {
            Some(draught) => Ok(WaveAim { request: request.clone(), draught }),
            None => Err(JobError::NoDraught("wave resistance".to_owned())),
        };
        self.waves.as_ref().map(aim).transpose()
    }
}

impl Default for Job {
    fn default() -> Self {
        Self {
            fairness: Fairness::default(),
            weight: None,
            holding: Holding::Table,
            rules: Vec::new(),
            accepted: Accepted::None,
            lines: Vec::new(),
            tolerance: Tolerance { table: None, stations: Vec::new(), waterlines: Vec::new(), cells: Vec::new() },
            locked: Vec::new(),
            field: true,
            exclude_suspects: true,
            signs: true,
            price: None,
            waves: None,
            solver: Settings { tolerance: 1e-11, ..Settings::default() },
        }
    }
}

/// Why a table was not faired.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum JobError {
    /// The table makes no surface.
    #[error(transparent)]
    Fit(#[from] FitError),
    /// The surface makes no hull.
    #[error(transparent)]
    Hull(#[from] HullError),
    /// The offsets make no problem.
    #[error(transparent)]
    #[doc(hidden)]
    Fair(#[from] FairError),
    /// The draught lies above the hull.
    #[error(
        "the design draught of {draught:.3} m lies above the depth of {depth:.3} m up to which the hull goes: state one within it \
         (--draught, T under [dimensions])"
    )]
    Draught {
        /// Design draught \[m\].
        draught: f64,
        /// Depth \[m\].
        depth: f64,
    },
    /// Targets need a draught, and none is stated.
    #[error("{0}: no draught is stated; give --draught (T under [table] beside a table, under [dimensions] of a job)")]
    NoDraught(String),
    /// B is no breadth of this hull.
    #[error(
        "half-breadths up to {greatest:.3} m do not go with B = {breadth:?} m: state the moulded breadth of this hull (B under [dimensions])"
    )]
    Breadth {
        /// Greatest half-breadth \[m\].
        greatest: f64,
        /// B \[m\].
        breadth: f64,
    },
    /// L_PP is no length of this hull.
    #[error(
        "L_PP of {length:?} m does not go with stations over {over:.3} m: state the length between the perpendiculars of this hull \
         (Lpp under [dimensions])"
    )]
    Length {
        /// L_PP \[m\].
        length: f64,
        /// From the first station to the last \[m\].
        over: f64,
    },
    /// A coefficient is asked for, and what says it again, and they are not the same.
    #[error("{words}, and {asked} is asked for")]
    Apart {
        /// Name of the coefficient in files.
        coefficient: &'static str,
        /// What says it again, and the coefficient that it is.
        words: String,
        /// What is asked for.
        asked: f64,
    },
    /// A line is declared along which the surface cannot break.
    #[error("the {} at {at} m cannot be a {}: the surface through the table has no line of its net there", course.as_str(), kind.as_str())]
    #[doc(hidden)]
    NoCourse {
        /// Which way it runs.
        course: LineCourse,
        /// What should break.
        kind: LineKind,
        /// Where it is \[m\].
        at: f64,
    },
    /// A line is accepted that is not proposed.
    #[error("L{number} is not proposed: {}", match count { 0 => "no line is".to_owned(), 1 => "there is L1".to_owned(), n => format!("there are L1 to L{n}") })]
    #[doc(hidden)]
    NoLine {
        /// Its number.
        number: usize,
        /// How many are proposed.
        count: usize,
    },
}

impl Job {
    /// Whether all tolerances are those that the noise gives.
    pub(super) fn names_no_tolerance(&self) -> bool {
        let Tolerance { table, stations, waterlines, cells } = &self.tolerance;
        table.is_none() && stations.is_empty() && waterlines.is_empty() && cells.is_empty() && self.locked.is_empty()
    }

    /// Whether a cell stays though it is suspected: it is locked, by itself or with its line, or its own tolerance is
    /// named.
    pub(super) fn holds(&self, table: &OffsetTable, (station, waterline): (usize, usize)) -> bool {
        let column = &table.stations[station];
        let place = [column.station.x, table.waterlines[waterline]];
        column.half_breadths[waterline].marks.locked
            || self.locked.contains(&(station, waterline))
            || self.tolerance.cells.iter().any(|(s, w, _)| (*s, *w) == (station, waterline))
            || self.rules.iter().any(|rule| rule.fixes(place, false))
    }

    /// The table with what the job locks marked so.
    pub(super) fn marked(&self, table: &OffsetTable) -> OffsetTable {
        let mut marked = table.clone();
        for &(station, waterline) in &self.locked {
            marked.stations[station].half_breadths[waterline].marks.locked = true;
        }
        marked
    }

    /// Tolerances that the job names, one a reading.
    pub(super) fn tolerances(&self, surface: &FairSurface) -> Vec<Option<f64>> {
        let of = |list: &[(usize, f64)], index: usize| list.iter().rev().find(|(i, _)| *i == index).map(|(_, t)| *t);
        // Less than rounding leaves nothing to solve in, more than the breadth says nothing; what must not move at all
        // is locked.
        let breadth = surface.hull.particulars().breadth;
        let sensible = |named: f64| named.clamp(LEAST_TOLERANCE * breadth, breadth);
        surface
            .places
            .iter()
            .map(|place| match place.origin {
                Origin::HalfBreadth { station, waterline } => {
                    let cell = self.tolerance.cells.iter().rev().find(|(s, w, _)| (*s, *w) == (station, waterline));
                    let lines = [of(&self.tolerance.waterlines, waterline), of(&self.tolerance.stations, station)];
                    cell.map(|(_, _, t)| *t)
                        .or_else(|| lines.into_iter().flatten().reduce(f64::min))
                        .or(self.tolerance.table)
                        .map(sensible)
                }
                Origin::Deck { station } | Origin::Point { station, .. } => {
                    of(&self.tolerance.stations, station).or(self.tolerance.table).map(sensible)
                }
            })
            .collect()
    }
}
