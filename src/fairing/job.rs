//! From a table of offsets and wishes to a fair hull with everything that proves it.
//!
//! The table is searched for suspects, which are left out unless they are kept; it is fitted (the hull before); the
//! model of [`super::surface`] is faired by [`super::fair`]; what moved, what holds and what bends is told.

use super::bends::Line;
use super::compromise::{Instead, within_reach};
use super::constraint::{Constraint, Rule, excess as excess_of_breadth};
use super::fair::{FairError, FairSettings, Faired, PRICE, Prepared, fair_prepared};
use super::flats::shown_flat;
use super::held::{self, Held, HeldRule};
use super::infeasible::Diagnosis;
use super::inspect::{ON_CHORD, PolygonSigns, kind, net_signs};
use super::least::TableLine;
use super::least_bending::LeastBending;
use super::lines::{LineCourse, LineKind, ProposedLine};
use super::lobes::Lobes;
use super::noise::{Differences, left_by_differences};
use super::proposals::{Accepted, Proposal};
use super::record::{moves, resolution};
use super::relinearise::ON_TARGET;
use super::repeated::{Attempt, Repeated, excess};
use super::rules::guarded_lines;
use super::start::Started;
use super::surface::{EnergySettings, FairSurface, Origin};
use super::suspects::Suspect;
use super::told::{Watched, changes, written};
pub use super::unbroken::RunsOn;
use crate::hull::{Cut, FitError, Hull, HullError, OffsetTable};
use crate::numeric::at_once;
use crate::qp::{RepeatedSolver, Settings, Status};
use crate::units::counted;

/// Least tolerance over the breadth: below it a difference is rounding.
pub(super) const LEAST_TOLERANCE: f64 = 1e-6;

/// Tolerance that a designer gives offsets lifted from a drawing: part of the breadth, or \[m\], whichever is more.
const MOST_TOLERANCE: [f64; 2] = [1e-3, 0.015];

/// The surface through the table is off a target by more than this, over its scale, where it is another than its own:
/// less is what a target of the drawing office differs from a table by errors of the table, as long as no line bends
/// more often for it.
const ANOTHER: f64 = 2e-3;

/// A locked offset that moves by more did not stay \[m\].
const LOCKED: f64 = 1e-9;

/// Noise over the quantum of the writing from which an undeclared line is likely.
const ALARM: f64 = 3.0;

/// Area of a section over B T below which it is none.
const EMPTY: f64 = 1e-9;

/// Inflections elsewhere that one more than before on a line is worth.
const WORSE: usize = 4;

/// Part of its greatest by which the half-breadth may pass it between offsets and nobody is told.
const BREADTH: f64 = 1e-6;

/// Part of the smoothing weight that is tried where lines bend more often with all of it: DTC as sections 780 > 924
/// inflections with all of it, 773 with this part, 793 with a hundredth of it again.
const REDUCED_WEIGHT: f64 = 1e-2;

/// Most that tolerances of the noise are widened where they contradict each other, and the room beyond the least that
/// has an answer.
const MOST_WIDENING: f64 = 3.0;
const WIDER: f64 = 1.1;

/// What is held of the hull.
#[derive(Debug, Clone, PartialEq)]
pub enum Holding {
    /// Displacement, LCB and C_M of the table's own surface.
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

/// What is wished.
#[derive(Debug, Clone)]
pub struct Job {
    /// Order and direction of the energy.
    pub energy: EnergySettings,
    /// Smoothing weight; none: by cross-validation on a net of its own, for the errors of the table on that of a fit.
    pub weight: Option<f64>,
    /// What is held.
    pub holding: Holding,
    /// Rules for lines and regions.
    pub rules: Vec<Rule>,
    /// Whether the flat of side that the table shows is kept where no rule says what is flat; not on a net of its own,
    /// which keeps straight parts straight.
    pub keep_flat: bool,
    /// Where the curvature goes on not to jump where that of the surface through the table does not, though the net would
    /// let it.
    pub runs_on: RunsOn,
    /// Which of the lines that are proposed are taken.
    pub accepted: Accepted,
    /// Lines across which slope or curvature break, that the table does not declare.
    pub lines: Vec<ProposedLine>,
    /// Tolerances.
    pub tolerance: Tolerance,
    /// Cells that must not move: (station, waterline).
    pub locked: Vec<(usize, usize)>,
    /// Whether suspects are left out.
    pub exclude_suspects: bool,
    /// Whether the energy is that of true curvature: the metric is refreshed until it stands still.
    pub true_curvature: bool,
    /// Whether the bending energy of the surface takes the place of the energy at last.
    pub bending: bool,
    /// Whether extraneous changes of curvature are forbidden.
    pub signs: bool,
    /// Dearest change of curvature that is forbidden, in squares of the noise.
    pub price: f64,
    /// The solver.
    pub solver: Settings,
}

impl Default for Job {
    fn default() -> Self {
        Self {
            energy: EnergySettings::default(),
            weight: None,
            holding: Holding::Table,
            rules: Vec::new(),
            keep_flat: true,
            runs_on: RunsOn::Everywhere,
            accepted: Accepted::None,
            lines: Vec::new(),
            tolerance: Tolerance { table: None, stations: Vec::new(), waterlines: Vec::new(), cells: Vec::new() },
            locked: Vec::new(),
            exclude_suspects: true,
            signs: true,
            price: PRICE,
            true_curvature: false,
            bending: false,
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
    /// A line is declared along which the surface cannot break.
    #[error("the {} at {at} m cannot be a {}: the surface through the table has no line of its net there", course.as_str(), kind.as_str())]
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
    NoLine {
        /// Its number.
        number: usize,
        /// How many are proposed.
        count: usize,
    },
}

/// A cell and what became of it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Change {
    /// Index of the station.
    pub station: usize,
    /// What it is of the station.
    pub origin: Origin,
    /// Position forward of AP \[m\].
    pub x: f64,
    /// Height above the base line \[m\].
    pub z: f64,
    /// Half-breadth in the table \[m\].
    pub before: f64,
    /// Half-breadth of the fair surface \[m\].
    pub after: f64,
    /// Tolerance that was used \[m\]; none for cells that were left out.
    pub tolerance: Option<f64>,
    /// The cell was left out as a suspect.
    pub suspect: bool,
    /// The cell was locked.
    pub locked: bool,
}

/// Inflections of one curve.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Turns {
    /// The plane that cuts it.
    pub cut: Cut,
    /// Inflections of the surface through the table.
    pub before: usize,
    /// Inflections of the fair surface.
    pub after: usize,
    /// The least number of inflections of any curve within the tolerances of the offsets, and whether that is proved;
    /// none on lines that the table does not have.
    pub minimum: Option<(usize, bool)>,
}

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
    /// Constraints.
    pub held: Vec<Held>,
    /// Rules for lines and regions.
    pub rules: Vec<HeldRule>,
    /// Curves of the table's stations and waterlines, of buttocks and of diagonals, which were never used.
    pub turns: Vec<Turns>,
    /// Knuckles and tangent lines that the table has and does not declare.
    pub proposals: Vec<Proposal>,
    /// Signs of the control polygons of the nets before and after.
    pub signs: [Vec<PolygonSigns>; 2],
    /// Suspects of the table.
    pub suspects: Vec<Suspect>,
    /// The program, its certificate, its noise level and its pattern.
    pub faired: Faired,
    /// Order of the energy.
    pub order: usize,
    /// Energy of the start net and of the fair net.
    pub energy: [f64; 2],
    /// The greatest jump of curvature of the fair hull across lines of its net where the surface through the table has
    /// none and none is declared \[1/m\]; none on a net of its own.
    pub jump: Option<f64>,
    /// By how much the half-breadth passes the greatest of the table, or B/2, before and after \[m\].
    pub beyond: [f64; 2],
    /// Whether the net is one of its own and not that of the surface through the table.
    pub own: bool,
    /// Noise of the offsets where their neighbourhood is smooth \[m\]; what is taken of it is [`Faired::sigma`].
    pub table_noise: f64,
    /// Departure of a bend from its chord below which it is no inflection \[m\]: the rounding of the table, or a tenth of
    /// its noise.
    pub resolution: f64,
    /// Whether targets that cannot be had within the tolerances gave way to the nearest that can.
    pub nearest: bool,
    /// What the job came to in words, and then what the surface through the table had to assume.
    pub notes: Vec<String>,
}

/// Curves that bend more often after than before, in words; `wished` says whether anything is asked for besides what the
/// table has, `carried` is the factor on the tolerances from which targets are had by one smooth move.
fn more_often(lines: &[Turns], wished: bool, carried: Option<f64>) -> Option<String> {
    let worse: Vec<&Turns> = lines.iter().filter(|turns| turns.after > turns.before).collect();
    let kinds = ["station", "waterline", "buttock", "diagonal"].map(|wanted| {
        let own: Vec<&&Turns> = worse.iter().filter(|turns| kind(&turns.cut) == wanted).collect();
        let [before, after] = own.iter().fold([0, 0], |sum, turns| [sum[0] + turns.before, sum[1] + turns.after]);
        (!own.is_empty()).then(|| format!("{} from {before} to {after}", counted(own.len(), wanted)))
    });
    let told: Vec<String> = kinds.into_iter().flatten().collect();
    (!told.is_empty()).then(|| {
        let wider = match carried.filter(|factor| *factor > 1.0) {
            Some(factor) => {
                format!("tolerances {factor:.2} times as wide, with which the targets are one smooth move,")
            }
            None => "wider tolerances".to_owned(),
        };
        let why = if wished {
            format!("what is wished or locked asks for that, and nearer targets or {wider} would leave a fairer hull")
        } else {
            "their signs do not go together with those of the other lines, half-breadths up to B/2 and the tolerances"
                .to_owned()
        };
        format!("bend more often than before: {}; {why}", told.join(", "))
    })
}

/// Inflections of stations more than before, all together, and of waterlines.
fn more(outcome: &Outcome) -> usize {
    let more = |[before, after]: [usize; 2]| after.saturating_sub(before);
    ["station", "waterline"].map(|kind| more(outcome.inflections(kind))).iter().sum()
}

/// Inflections of all curves.
fn all(outcome: &Outcome) -> usize {
    outcome.turns.iter().map(|turns| turns.after).sum()
}

impl Job {
    /// Fairs a table.
    ///
    /// # Errors
    /// [`JobError`] when the table makes no surface; wishes that cannot be had are the status of the outcome.
    pub fn run(&self, table: &OffsetTable) -> Result<Outcome, JobError> {
        let mut outcome = self.run_with_flat(table, ANOTHER)?;
        let is_fair = |other: &Outcome| !other.own && other.status == Status::Optimal;
        if !self.signs || !is_fair(&outcome) {
            return Ok(outcome);
        }
        // What is near enough to be an error of the table may be a wish all the same.
        let near = outcome.targets_off(ON_TARGET) > outcome.targets_off(ANOTHER);
        if near && excess(&outcome.turns) > 0 {
            let other = self.run_with_flat(table, ON_TARGET)?;
            let before = other.turns.iter().map(|turns| turns.before).sum();
            if is_fair(&other) && excess(&other.turns) < excess(&outcome.turns) && all(&other) <= before {
                outcome = other;
            }
        }
        if self.weight.is_some() || outcome.faired.carried.is_some() || more(&outcome) == 0 {
            return Ok(outcome);
        }
        // What the smoothing bends more often and no signs could hold, less of it bends less.
        let weight = REDUCED_WEIGHT * outcome.faired.chosen.lambda;
        let mut other = Self { weight: Some(weight), ..self.clone() }.run_with_flat(table, ANOTHER)?;
        let fewer = more(&other) < more(&outcome) && all(&other) < all(&outcome);
        if !is_fair(&other) || !fewer {
            return Ok(outcome);
        }
        other.faired.trials = outcome.faired.trials;
        other.notes.insert(
            0,
            "the smoothing weight is a hundredth of that for the errors of the table, with which lines bent more often than \
             before"
                .to_owned(),
        );
        Ok(other)
    }

    /// Fairs a table, with the flat that it shows where that hinders nothing. A target that is off by more than
    /// `another`, over its scale, is one smooth move.
    fn run_with_flat(&self, table: &OffsetTable, another: f64) -> Result<Outcome, JobError> {
        let mut outcome = self.run_on(table, true, another)?;
        // Where the flat of side, or what is wished, takes all the room there is, curvature that must run on bends lines more
        // often and raises the energy.
        let worse = |outcome: &Outcome| {
            let energy = (outcome.energy[1] / outcome.energy[0]).max(1.0);
            (outcome.status == Status::Limit, excess(&outcome.turns), energy)
        };
        let flat = shown_flat(table, &[]).is_some();
        let tries = match self.runs_on {
            RunsOn::Everywhere if outcome.own || outcome.status == Status::Infeasible => &[][..],
            RunsOn::Everywhere if flat && outcome.status != Status::Limit => &[RunsOn::ButFlats, RunsOn::Nowhere],
            RunsOn::Everywhere => &[RunsOn::Nowhere],
            _ => &[],
        };
        for &runs_on in tries {
            if worse(&outcome) <= (false, 0, 1.0) {
                break;
            }
            let place = if runs_on == RunsOn::ButFlats { "beside the flat of side" } else { "across lines of the net" };
            let mut other = Self { runs_on, ..self.clone() }.run_on(table, false, another)?;
            if worse(&other) < worse(&outcome) {
                other.notes.insert(
                    0,
                    format!(
                        "{place} the curvature may jump where that of the surface through the table does not: else lines \
                         bend more often, the energy rises or nothing is proved"
                    ),
                );
                outcome = other;
            }
        }
        // What a net of its own cannot have, that of the fit may, which meets every offset.
        if outcome.own && outcome.status != Status::Optimal {
            let mut other = self.run_on(table, false, another)?;
            let moved = |outcome: &Outcome| {
                let locked = outcome.changes.iter().filter(|change| change.locked);
                locked.map(|change| (change.after - change.before).abs()).fold(0.0, f64::max)
            };
            if other.status == Status::Optimal || moved(&outcome) > moved(&other).max(LOCKED) {
                other.notes.insert(
                    0,
                    "what is wished cannot be had on a net of its own, which follows the table with fewer control values: the \
                     net of the surface through the table was faired"
                        .to_owned(),
                );
                outcome = other;
            }
        }
        // A net of its own that bends more often than the surface through the table, and more, does not follow it after
        // all.
        if outcome.own && more(&outcome) > 0 && outcome.energy[1] > outcome.energy[0] {
            let other = self.run_on(table, false, another)?;
            if more(&other) < more(&outcome) && other.status == outcome.status {
                return Ok(other);
            }
        }
        // A flat that the table shows and nobody asked for stands in the way of nothing.
        let flat = outcome.rules.iter().position(|rule| matches!(rule.rule, Rule::FlatShown { .. }));
        if let Some(flat) = flat {
            let gives = |found: &Diagnosis| {
                found.cheapest().is_none() || found.rules.iter().any(|(rule, give)| *rule == flat && give.is_some())
            };
            let hinders = outcome.rules[flat].given_up || outcome.faired.diagnosis.as_ref().is_some_and(gives);
            if hinders || excess(&outcome.turns) > 0 {
                let mut other = Self { keep_flat: false, ..self.clone() }.run_with_flat(table, another)?;
                let missed = |outcome: &Outcome| {
                    let each = outcome.held.iter().map(|held| held.constraint.missed(held.after, &outcome.before));
                    each.sum::<f64>()
                };
                let better = other.status == Status::Optimal && outcome.status != Status::Optimal;
                let told =
                    |outcome: &Outcome| outcome.faired.diagnosis.as_ref().is_some_and(|d| d.cheapest().is_some());
                let nearer = (missed(&other) < missed(&outcome) || told(&other) && !told(&outcome))
                    && excess(&other.turns) <= excess(&outcome.turns);
                // One inflection more than before is as bad as so many elsewhere.
                let counted = |outcome: &Outcome| all(outcome) + WORSE * excess(&outcome.turns);
                let fairer = excess(&other.turns) < excess(&outcome.turns) && counted(&other) <= counted(&outcome);
                if better || other.status == outcome.status && (fairer || nearer) {
                    other.notes.insert(
                        0,
                        "the flat of side that the table shows was not kept: with it the offsets cannot be had within their tolerances, \
                         targets are further away or lines bend more often"
                            .to_owned(),
                    );
                    return Ok(other);
                }
            }
        }
        Ok(outcome)
    }

    /// The rules, and the flat that the table shows where no rule says what is flat.
    fn rules(&self, table: &OffsetTable, surface: &FairSurface, left_out: &[(usize, usize)]) -> Vec<Rule> {
        let mut rules = self.rules.clone();
        let said = rules.iter().any(|rule| matches!(rule, Rule::FlatOfSide { .. }));
        if self.keep_flat && !surface.own && !said {
            let held = |rule: &Rule| rule.limits(surface).is_ok_and(|limits| !limits.is_empty());
            rules.extend(shown_flat(table, left_out).filter(held));
        }
        rules
    }

    /// Fairs a table, on a net of its own where that is allowed and follows it.
    fn run_on(&self, table: &OffsetTable, own: bool, another: f64) -> Result<Outcome, JobError> {
        let Started {
            found,
            before,
            mut notes,
            assumed,
            noise,
            quantum,
            proposals,
            mut surface,
            search,
            gap,
            excluded,
            watched,
        } = Started::new(self, table, own)?;
        let (draught, depth) = (before.particulars().draught, before.particulars().depth);
        if draught > depth * (1.0 + 1e-9) {
            return Err(JobError::Draught { draught, depth });
        }
        let valued = |constraint: &Constraint| constraint.with_target(constraint.value(&before));
        let constraints = match &self.holding {
            Holding::Given(list) => list.clone(),
            Holding::Both { own: list, given } => {
                // A section above the water has no area.
                let p = before.particulars();
                let least = EMPTY * p.breadth * p.draught;
                let there = |c: &Constraint| !matches!(c, Constraint::SectionArea { area, .. } if *area <= least);
                list.iter().map(valued).filter(there).chain(given.iter().copied()).collect()
            }
            Holding::Table => {
                [Constraint::Displacement(0.0), Constraint::CentreOfBuoyancy(0.0), Constraint::MidshipCoefficient(0.0)]
                    .map(|constraint| valued(&constraint))
                    .to_vec()
            }
        };
        // A net of its own has another volume between the offsets: the tolerances have room for the difference.
        let apart = 6.0 * gap;
        let stations = table.stations.iter().map(|station| Line::Station(station.station.x));
        let waterlines = Watched::waterlines(table, &before).into_iter().map(Line::Waterline);
        // What a rule says of the inflections of a line stands over the guard of them.
        let wished = self.rules(table, &surface, &excluded);
        let ruled: Vec<Line> = wished.iter().filter_map(Rule::counted_line).collect();
        let guarded = |line: &Line| !ruled.contains(line);
        // A net of its own is searched without them.
        let left = (!surface.own).then(|| left_by_differences(table, &excluded)).flatten();
        let differences = left.map(|left| Differences { left, noise: found.noise });
        let readings = surface.model.readings.iter().map(|reading| reading.value);
        let greatest = readings.fold(0.5 * before.particulars().breadth, f64::max);
        let mut settings = FairSettings {
            others: constraints.iter().map(|c| c.missed(c.value(&before), &before) > another).collect(),
            constraints,
            rules: wished.clone(),
            weight: self.weight,
            // Whoever names a tolerance for the table says how noisy it is.
            table_noise: Some(self.tolerance.table.map_or(found.noise, |named| found.noise.min(named / 3.0))),
            differences,
            most_noise: (MOST_TOLERANCE[0] * before.particulars().breadth).max(MOST_TOLERANCE[1]) / 3.0,
            least_noise: quantum / 12f64.sqrt(),
            tolerance_levels: Some(3.0),
            least_tolerance: (2.0 * quantum).max(LEAST_TOLERANCE * before.particulars().breadth).max(apart),
            tolerances: self.tolerances(&surface),
            signs: self.signs,
            price: self.price,
            true_curvature: self.true_curvature,
            bending: self.bending,
            lines: stations.chain(waterlines).collect(),
            kept: Vec::new(),
            strict: Vec::new(),
            oblique: Vec::new(),
            released: Vec::new(),
            seen: quantum,
            // Tolerances that are less than that leave no room to do better.
            admits: self.tolerance.table.is_some_and(|named| excess_of_breadth(before.surface(), greatest) > named),
            solver: self.solver.clone(),
        };
        let mut prepared = match search {
            Some(search) if self.weight.is_none() => {
                let found = (search.smoothed.lambda, search.trials);
                Prepared::searched(&mut surface, &settings, search.smoother, found, None)?
            }
            _ => Prepared::new(&mut surface, &settings)?,
        };
        let resolution = resolution(Some(quantum), prepared.sigma);
        settings.seen = resolution;
        let mut solver = RepeatedSolver::new(&self.solver);
        let (watched, faired) =
            at_once(|| watched.counted(resolution), || fair_prepared(&mut surface, &settings, &prepared, &mut solver));
        let mut faired = faired?;
        // Of several hundred offsets some are further off than three noise levels. Where nobody named the tolerances,
        // they give way.
        let least = faired.diagnosis.as_ref().and_then(Diagnosis::of_tolerances_alone);
        if let Some(least) = least.filter(|least| self.names_no_tolerance() && *least <= MOST_WIDENING) {
            surface.widen(least * WIDER);
            prepared.lines = prepared.lines.iter().map(|line| TableLine::new(&surface, line.line)).collect();
            faired = fair_prepared(&mut surface, &settings, &prepared, &mut solver)?;
            notes.push(format!(
                "tolerances are {:.2} times three noise levels: with less, the offsets contradict each other, the ends of the hull or its \
                 greatest half-breadth",
                least * WIDER
            ));
        }
        let whole = |surface: &mut FairSurface, settings: &mut FairSettings, solver: &mut _, faired: Faired| {
            let after = surface.hull_of(&faired.net)?;
            if surface.own {
                // Nothing is repeated on a net of its own: the prices are final.
                let (lines, prices) = at_once(
                    || watched.turns(&after),
                    || held::constraints(surface, settings, &faired, [&before, &after], solver),
                );
                return Ok::<_, JobError>((Attempt { faired, after, lines }, Some(prices)));
            }
            let lines = watched.turns(&after);
            let mut attempt = Attempt { faired, after, lines };
            if self.signs {
                let repeated = Repeated { surface, settings, prepared: &prepared, watched: &watched };
                attempt = repeated.until_none_is_worse(attempt, resolution, guarded)?;
                let lines = &guarded_lines(&prepared.lines, &settings.rules);
                attempt = Lobes { surface, settings, lines, watched: &watched, seen: resolution }.fewer(attempt)?;
            }
            Ok((attempt, None))
        };
        let (asked, carried) = (settings.constraints.clone(), faired.carried);
        let mut refused = None;
        let mut given_up: Vec<usize> = Vec::new();
        let mut kept: Vec<usize> = (0..wished.len()).collect();
        while let Some(Instead::WithoutRules(rules)) = &faired.instead {
            given_up.extend(rules.iter().map(|&rule| kept[rule]));
            kept.retain(|rule| !given_up.contains(rule));
            settings.rules = kept.iter().map(|&rule| wished[rule].clone()).collect();
            refused = refused.or(faired.diagnosis.take());
            solver = RepeatedSolver::new(&self.solver);
            let without = fair_prepared(&mut surface, &settings, &prepared, &mut solver)?;
            faired = without.after(&faired);
        }
        given_up.sort_unstable();
        let mut nearest = false;
        let (attempt, held) = match faired.instead.take() {
            // Targets that cannot be had give way: the nearest that leave a fair hull.
            Some(Instead::Targets(ends)) => {
                let mut best: Option<(Attempt, Option<Vec<Held>>, FairSettings)> = None;
                for constraints in within_reach(&asked, &before, &ends, carried, &surface)? {
                    let mut eased = FairSettings { constraints, ..settings.clone() };
                    solver = RepeatedSolver::new(&self.solver);
                    let again = fair_prepared(&mut surface, &eased, &prepared, &mut solver)?;
                    if !again.solved.is_optimal() && best.is_some() {
                        continue;
                    }
                    let (attempt, held) = whole(&mut surface, &mut eased, &mut solver, again.after(&faired))?;
                    let sum = |attempt: &Attempt, count: fn(&Turns) -> usize| attempt.lines.iter().map(count).sum();
                    let after: usize = sum(&attempt, |turns| turns.after);
                    let done = after <= sum(&attempt, |turns| turns.before);
                    let fewest = best.as_ref().is_none_or(|(best, ..)| after < sum(best, |turns| turns.after));
                    if done || fewest {
                        best = Some((attempt, held, eased));
                    }
                    if done {
                        break;
                    }
                }
                refused = refused.or(faired.diagnosis.take());
                let Some((attempt, held, eased)) = best else { unreachable!("there is a part") };
                (settings, nearest) = (eased, true);
                (attempt, held)
            }
            _ => whole(&mut surface, &mut settings, &mut solver, faired)?,
        };
        let Attempt { mut faired, after, mut lines } = attempt;
        let mut changes = changes(table, &surface, &after, &excluded);
        let fixed = |change: &Change| {
            let deck = matches!(change.origin, Origin::Deck { .. });
            settings.rules.iter().any(|rule| matches!(rule, Rule::Fixed(line) if line.has([change.x, change.z], deck)))
        };
        changes.iter_mut().for_each(|change| change.locked |= fixed(change));
        let least = |turns: &mut Turns| {
            let Some(line) = Line::of(turns.cut) else { return };
            let known = faired.guarded.iter().flat_map(|guarded| &guarded.least).find(|(other, _, _)| *other == line);
            // The proof speaks of the line as one curve; where it is counted in pieces it may have less.
            let told = |(count, proved): (usize, bool)| (count.min(turns.after), proved && count <= turns.after);
            turns.minimum = match known {
                Some((_, count, proved)) => Some((*count, *proved)),
                None if self.signs && faired.diagnosis.is_none() && faired.solved.is_optimal() => {
                    TableLine::minimum(&surface, line, &faired.net)
                }
                None => None,
            }
            .map(told);
        };
        let half = lines.len() / 2;
        let (some, others) = lines.split_at_mut(half);
        at_once(|| some.iter_mut().for_each(least), || others.iter_mut().for_each(least));
        let held =
            held.unwrap_or_else(|| held::constraints(&surface, &settings, &faired, [&before, &after], &mut solver));
        let held: Vec<Held> =
            asked.into_iter().zip(held).map(|(constraint, held)| Held { constraint, ..held }).collect();
        let mut rules = held::rules(&surface, &settings, &faired);
        given_up.iter().for_each(|&rule| rules.insert(rule, HeldRule::given_up(&wished[rule], &surface, &after)));
        faired.diagnosis = refused.or(faired.diagnosis);
        faired.carried = carried;
        let energy = [surface.model.energy_of(&surface.start), surface.model.energy_of(&faired.net)];
        notes.extend(surface.straight_parts());
        notes.extend(faired.bent.as_ref().map(LeastBending::words));
        if self.bending && faired.bent.is_none() && faired.solved.is_optimal() {
            notes.push(
                "the bending energy was not minimised: the surface is no graph over its centreplane everywhere, or no step of the solver \
                 lowers it"
                    .to_owned(),
            );
        }
        if let Some(wanted) = self.energy.order.filter(|&wanted| wanted != surface.order) {
            notes.push(format!(
                "the energy is of order {}: one of order {wanted} needs a net of its own, which does not follow this table",
                surface.order
            ));
        }
        let beyond = [&before, &after].map(|hull| excess_of_breadth(hull.surface(), greatest));
        if beyond[1] > quantum.max(BREADTH * greatest) {
            notes.push(format!(
                "between offsets the half-breadth passes {greatest:.3} m by {:.2} mm at most, that of the surface through the table by \
                 {:.2} mm",
                1e3 * beyond[1],
                1e3 * beyond[0]
            ));
        }
        if self.true_curvature && faired.refreshed.is_none() && faired.solved.is_optimal() {
            notes.push(
                "the metric of true curvature stayed that of the start: refreshing it did not lower the functional"
                    .to_owned(),
            );
        }
        if !surface.own && self.rules.iter().any(|rule| rule.keeps_the_fit(&before)) {
            notes.push(
                "a line that does not move, or a flat, keeps the net of the surface through the table, on which less is taken for noise \
                 than on a net of its own"
                    .to_owned(),
            );
        }
        let off = |held: &Held| held.constraint.missed(held.before, &before) > ON_TARGET;
        let asks = held.iter().any(off) || !self.rules.is_empty() || !self.locked.is_empty();
        // Before all else: whoever reads no further should know it.
        notes.splice(0..0, more_often(&lines, asks, faired.carried));
        if !excluded.is_empty() {
            notes.push(format!("{} suspects were left out of the fairing", excluded.len()));
        }
        if self.accepted == Accepted::All && !proposals.iter().any(|proposal| proposal.accepted) {
            notes.push("all proposed lines were to be taken, and there is none that could be".to_owned());
        }
        if noise > ALARM * quantum && proposals.iter().any(|proposal| !proposal.accepted) {
            notes.push(
                "the noise is far above the rounding of the table, and lines are proposed that it does not declare"
                    .to_owned(),
            );
        }
        notes.extend(assumed);
        let signs = [&before, &after].map(|hull| net_signs(hull.surface(), ON_CHORD * resolution));
        Ok(Outcome {
            proposals,
            signs,
            status: if let Some(found) = &faired.diagnosis {
                // What is feasible and was not solved is no contradiction.
                if found.widening.is_some_and(|least| least <= 1.0) { Status::Limit } else { Status::Infeasible }
            } else if faired.stalled() {
                Status::Limit
            } else {
                faired.solved.solution.status
            },
            table: written(table, &changes),
            jump: surface.greatest_jump(&after),
            beyond,
            before,
            after,
            changes,
            held,
            rules,
            turns: lines,
            suspects: found.suspects,
            order: surface.order,
            energy,
            faired,
            resolution,
            nearest,
            own: surface.own,
            table_noise: found.noise,
            notes,
        })
    }

    /// Whether all tolerances are those that the noise gives.
    fn names_no_tolerance(&self) -> bool {
        let Tolerance { table, stations, waterlines, cells } = &self.tolerance;
        table.is_none() && stations.is_empty() && waterlines.is_empty() && cells.is_empty() && self.locked.is_empty()
    }

    /// Whether a cell stays though it is suspected: it is locked, by itself or with its line, or its own tolerance is
    /// named.
    pub(super) fn holds(&self, table: &OffsetTable, (station, waterline): (usize, usize)) -> bool {
        let column = &table.stations[station];
        let place = [column.station.x, table.waterlines[waterline]];
        let fixed = |rule: &Rule| matches!(rule, Rule::Fixed(line) if line.has(place, false));
        column.half_breadths[waterline].marks.locked
            || self.locked.contains(&(station, waterline))
            || self.tolerance.cells.iter().any(|(s, w, _)| (*s, *w) == (station, waterline))
            || self.rules.iter().any(fixed)
    }

    /// Tolerances that the job names, one a reading.
    fn tolerances(&self, surface: &FairSurface) -> Vec<Option<f64>> {
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

impl Outcome {
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

    /// How many targets the surface through the table is off by more than a part of their scale.
    #[must_use]
    pub fn targets_off(&self, part: f64) -> usize {
        self.held.iter().filter(|held| held.constraint.missed(held.before, &self.before) > part).count()
    }
}
