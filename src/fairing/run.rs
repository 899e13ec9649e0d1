//! A job on one net, from the model to the outcome: the program; tolerances that give way to noise; rules and targets
//! that cannot be met and what is done instead; lines that bend more often and are done again; what the page says of it all.

use super::bends::Line;
use super::change::Turns;
use super::changes::{Counted, Watched, changes, normal_moves, predicted, written};
use super::compromise::{Instead, within_reach};
use super::constraint::{Constraint, excess as excess_of_breadth};
use super::fair::{FairSettings, Faired, PRICE, Prepared, fair_prepared};
use super::field::points::is_on_centreplane;
use super::held::{self, Held, HeldRule};
use super::infeasible::{Diagnosis, Ends};
use super::inspect::{ON_CHORD, gaussian_regions, net_signs};
use super::job::{Holding, Job, JobError, LEAST_TOLERANCE, MOST_LENGTH};
use super::least::TableLine;
use super::noise::{Differences, left_by_differences};
use super::outcome::{Outcome, more_often, total};
use super::proposals::{Accepted, Proposal};
use super::record::bump;
use super::relinearise::ON_TARGET;
use super::start::{Started, Taken};
use super::strength::Fairness;
use super::surface::{FairSurface, Origin, Place};
use super::suspects::Suspects;
use crate::hull::{Hull, OffsetTable};
use crate::numeric::join;
use crate::qp::Status;
use crate::units::counted;
use std::sync::Arc;

/// Tolerance that a designer gives offsets lifted from a drawing: part of the breadth, or \[m\], whichever is more.
const MOST_TOLERANCE: [f64; 2] = [1e-3, 0.015];

/// A target that the surface through the table misses by less, over its scale, is no smooth move of that surface: errors of
/// the table are as much.
const ANOTHER: f64 = 2e-3;

/// Noise over the quantum of the writing from which an undeclared line is likely.
const ALARM: f64 = 3.0;

/// Part of its greatest by which the half-breadth may pass it between offsets without a note.
const BREADTH: f64 = 1e-6;

/// How far offsets without a resolution may be from the surface through them, over the breadth.
const LEAST_THROUGH: f64 = 1e-6;

/// Most that tolerances of the noise are widened where they contradict each other, and the room beyond the least that
/// has an answer.
const MOST_WIDENING: f64 = 3.0;
const WIDER: f64 = 1.1;

/// Hears in a few words what is being done.
pub type Progress<'t> = &'t (dyn Fn(&str) + Sync);

impl Job {
    /// Fairs a table.
    ///
    /// # Errors
    /// [`JobError`] when the table makes no surface; targets that cannot be met are the status of the outcome.
    pub fn run(&self, table: &OffsetTable) -> Result<Outcome, JobError> {
        self.run_telling(table, &|_| ())
    }

    /// Fairs a table and tells what is being done, which takes seconds for a large table or targets that cannot be met.
    ///
    /// # Errors
    /// As [`Job::run`].
    #[doc(hidden)]
    pub fn run_telling(&self, table: &OffsetTable, progress: Progress<'_>) -> Result<Outcome, JobError> {
        let raw = self.fairness.is_raw().then(|| self.through());
        let job = raw.as_ref().unwrap_or(self);
        let outcome = job.run_once(table, progress)?;
        job.or_without_the_field(table, progress, outcome)
    }

    fn run_once(&self, table: &OffsetTable, progress: Progress<'_>) -> Result<Outcome, JobError> {
        let (run, watched) = Run::new(self, table, Arc::new(Started::new(self, table)?), progress)?;
        run.at(self.fairness)?.outcome(watched)
    }

    /// A field whose tolerances have no room for the move to its targets bends for them. The net of the surface through the
    /// table, which goes through the offsets as they are, may be nearer to them.
    fn or_without_the_field(
        &self,
        table: &OffsetTable,
        progress: Progress<'_>,
        outcome: Outcome,
    ) -> Result<Outcome, JobError> {
        let bent = outcome.is_field && outcome.faired.carried.is_some_and(|factor| factor > 1.0);
        if !bent || outcome.status != Status::Optimal || !outcome.is_no_fairer() {
            return Ok(outcome);
        }
        progress("the field bends more often for its targets: again, on the net of the surface through the table");
        let mut other = Self { field: false, ..self.clone() }.run_once(table, progress)?;
        if other.status != Status::Optimal || other.changes_of_sign()[1] >= outcome.changes_of_sign()[1] {
            return Ok(outcome);
        }
        other.notes.insert(
            0,
            "a field bends more often to meet the targets within the tolerances: the net of the surface through the table was \
             faired"
                .to_owned(),
        );
        Ok(other)
    }

    /// The job of the surface through the table: it has the displacement and the humps that it has.
    pub(super) fn through(&self) -> Self {
        let given = match &self.holding {
            Holding::Table => Vec::new(),
            Holding::Given(given) | Holding::Both { given, .. } => given.clone(),
        };
        Self { signs: false, holding: Holding::Given(given), ..self.clone() }
    }
}

/// A job under way.
#[derive(Clone)]
pub(super) struct Run<'a> {
    job: &'a Job,
    table: &'a OffsetTable,
    progress: Progress<'a>,
    started: Arc<Started>,
    fairness: Fairness,
    /// The lines of a run with the same tolerances, whose least inflections are known. With them prices are left out.
    known: Option<&'a [Turns]>,
    found: Suspects,
    /// The surface through the table.
    before: Hull,
    surface: FairSurface,
    proposals: Vec<Proposal>,
    /// Cells that are left out.
    excluded: Vec<(usize, usize)>,
    /// Noise of the table, not below its rounding \[m\].
    noise: f64,
    /// Step of its writing \[m\].
    quantum: f64,
    /// Greatest half-breadth of the table, or B/2 \[m\].
    greatest: f64,
    /// What is to be held before anything gives way.
    asked: Vec<Constraint>,
    settings: FairSettings,
    prepared: Prepared,
    /// The first notes, and what the surface through the table had to assume, which comes last.
    notes: Vec<String>,
    assumed: Vec<String>,
}

/// What was done instead of what could not be had.
#[derive(Default)]
struct Given {
    /// Why it could not.
    refused: Option<Diagnosis>,
    /// Rules that were left out, by their index.
    rules: Vec<usize>,
    /// Whether targets gave way to the nearest that can be had.
    nearest: bool,
}

/// A fair hull, what its curves do, and what holds of it.
struct Attempt {
    faired: Faired,
    after: Hull,
    lines: Vec<Turns>,
    held: Vec<Held>,
}

impl<'a> Run<'a> {
    /// The model with the wishes as they are asked for, at the default grade of fairness.
    pub(super) fn new(
        job: &'a Job,
        table: &'a OffsetTable,
        started: Arc<Started>,
        progress: Progress<'a>,
    ) -> Result<(Self, Watched), JobError> {
        let Started {
            found,
            before,
            notes,
            assumed,
            noise,
            quantum,
            proposals,
            mut surface,
            likely,
            excluded,
            watched,
        } = Started::clone(&started);
        progress(&format!(
            "{}; {}",
            if surface.is_field { "a field follows the table" } else { "the net of the surface through the table" },
            counted(surface.start.len(), "control value")
        ));
        let depth = before.particulars().depth;
        if let Some(draught) = before.particulars().draught.filter(|draught| *draught > depth * (1.0 + 1e-9)) {
            return Err(JobError::Draught { draught, depth });
        }
        let (breadth, widest) = (before.particulars().breadth, surface.start.iter().copied().fold(0.0, f64::max));
        if surface.is_field && widest > breadth {
            return Err(JobError::Breadth { greatest: widest, breadth });
        }
        let (length, stations) = (before.particulars().length_between_perpendiculars, &table.stations);
        let places = stations.iter().map(|station| station.station.x);
        let ends = places.fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], x| [a.min(x), b.max(x)]);
        let over = ends[1] - ends[0];
        if !(over / MOST_LENGTH..=over * MOST_LENGTH).contains(&length) {
            return Err(JobError::Length { length, over });
        }
        let base = if surface.is_field { &surface.hull } else { &before };
        let asked = job.holding.constraints(base)?;
        // The net of the surface through the table meets a target that is this near by its offsets.
        let another = if surface.is_field { ON_TARGET } else { ANOTHER };
        let stations = table.stations.iter().map(|station| Line::Station(station.station.x));
        let waterlines = Watched::waterlines(table, &before).into_iter().map(Line::Waterline);
        let left = likely.is_none().then(|| left_by_differences(table, &excluded)).flatten();
        let differences = left.map(|left| Differences { left, noise: found.noise });
        let readings = surface.model.readings.iter().map(|reading| reading.value);
        let greatest = readings.fold(0.5 * before.particulars().breadth, f64::max);
        let roughness = (MOST_TOLERANCE[0] * before.particulars().breadth).max(MOST_TOLERANCE[1]) / 3.0;
        let mut settings = FairSettings {
            others: asked.iter().map(|c| c.missed(c.value(base), base) > another).collect(),
            constraints: asked.clone(),
            rooms: vec![0.0; asked.len()],
            rules: job.rules.clone(),
            strength: 1.0,
            through: None,
            weight: job.weight,
            // Whoever names a tolerance for the table says how noisy it is.
            table_noise: job.tolerance.table.map_or(found.noise, |named| found.noise.min(named / 3.0)),
            differences,
            most_noise: roughness,
            least_noise: quantum / 12f64.sqrt(),
            tolerance_levels: Some(3.0),
            least_tolerance: (2.0 * quantum).max(LEAST_TOLERANCE * before.particulars().breadth),
            tolerances: job.tolerances(&surface),
            signs: job.signs,
            price: job.price.unwrap_or(PRICE),
            few: None,
            before: 0,
            waves: job.waves_at(before.particulars().draught)?,
            lines: stations.chain(waterlines).collect(),
            seen: bump(before.particulars().length_between_perpendiculars, quantum),
            // Tolerances that are less than that leave no room to do better.
            admits: job.tolerance.table.is_some_and(|named| excess_of_breadth(before.surface(), greatest) > named),
            solver: job.solver.clone(),
        };
        let prepared = match likely {
            Some(likely) => Prepared::likely(&mut surface, &settings, likely)?,
            None => Prepared::new(&mut surface, &settings)?,
        };
        if surface.is_field && job.holding == Holding::Table {
            settings.rooms = prepared.twice_the_errors(&surface, &asked);
        }
        let run = Self {
            job,
            table,
            progress,
            started,
            fairness: Fairness::default(),
            known: None,
            found,
            before,
            surface,
            proposals,
            excluded,
            noise,
            quantum,
            greatest,
            asked,
            settings,
            prepared,
            notes,
            assumed,
        };
        Ok((run, watched))
    }

    /// The same, without prices of what is held; `known` are the lines of a run with the same tolerances.
    pub(super) fn beside(self, known: &'a [Turns]) -> Self {
        Self { known: Some(known), ..self }
    }

    /// The same at another grade of fairness.
    pub(super) fn at(mut self, fairness: Fairness) -> Result<Self, JobError> {
        let breadth = self.before.particulars().breadth;
        self.fairness = fairness;
        self.settings.strength = fairness.on_the_weight();
        self.settings.through = fairness.is_raw().then(|| (0.5 * self.quantum).max(LEAST_THROUGH * breadth));
        self.settings.price = self.job.price.unwrap_or(PRICE) * fairness.on_the_price();
        // Whoever names a price means it.
        self.settings.few = fairness.few().filter(|_| self.job.price.is_none());
        self.prepared = self.prepared.graded(&mut self.surface, &self.settings)?;
        Ok(self)
    }

    /// All of it.
    pub(super) fn outcome(mut self, watched: Watched) -> Result<Outcome, JobError> {
        let lines_before = watched.counted(self.settings.seen);
        self.settings.before = lines_before.changes_of_sign();
        let Self { surface, settings, prepared, .. } = &mut self;
        let faired = fair_prepared(surface, settings, prepared)?;
        (self.progress)(&format!(
            "{} solved: {}",
            counted(faired.programs, "program"),
            match (&faired.instead, &faired.diagnosis) {
                (None, None) => "all targets can be met",
                _ => "the targets cannot all be met",
            }
        ));
        let faired = self.widened(faired)?;
        let carried = faired.carried;
        let mut given = Given::default();
        let mut faired = self.without_rules(faired, &mut given)?;
        let attempt = match faired.instead.take() {
            Some(Instead::Targets(ends)) => {
                given.nearest = true;
                given.refused = given.refused.take().or(faired.diagnosis.take());
                self.nearest(&faired, &ends, carried, &lines_before)?
            }
            _ => self.attempt(faired, &lines_before)?,
        };
        let Attempt { mut faired, after, mut lines, held } = attempt;
        self.least(&mut lines, &faired);
        let asked = self.asked.iter().zip(held);
        let held: Vec<Held> = asked.map(|(&constraint, held)| Held { constraint, ..held }).collect();
        let mut rules = held::rules(&self.surface, &self.settings, &faired, self.is_priced());
        for &rule in &given.rules {
            rules.insert(rule, HeldRule::given_up(&self.job.rules[rule], &self.surface, &after));
        }
        faired.diagnosis = given.refused.or(faired.diagnosis);
        faired.carried = carried;
        let beyond = [&self.before, &after].map(|hull| excess_of_breadth(hull.surface(), self.greatest));
        self.tell(&faired, &held, &lines, beyond);
        let keels = self.keels_off(&after);
        self.notes.extend(keels);
        let mut changes = changes(self.table, &self.surface, &after, &self.excluded);
        for change in &mut changes {
            let deck = matches!(change.origin, Origin::Deck { .. });
            change.locked |= self.settings.rules.iter().any(|rule| rule.fixes([change.x, change.z], deck));
        }
        let predicted = predicted(self.table, &after);
        if !predicted.is_empty() {
            self.notes.push(format!(
                "{} are predicted from the fair surface: in brackets, as doubtful ones, in the fair table",
                counted(predicted.len(), "unknown offset")
            ));
        }
        let Self { surface, settings, before, .. } = self;
        let seen = settings.seen;
        let regions = join(|| gaussian_regions(&before, seen), || gaussian_regions(&after, seen));
        Ok(Outcome {
            regions: [regions.0, regions.1],
            proposals: self.proposals,
            signs: [&before, &after].map(|hull| net_signs(hull.surface(), ON_CHORD * settings.seen)),
            status: if let Some(found) = &faired.diagnosis {
                // What is feasible and was not solved is no contradiction.
                if found.widening.is_some_and(|least| least <= 1.0) { Status::Limit } else { Status::Infeasible }
            } else if faired.stalled() {
                Status::Limit
            } else {
                faired.solved.solution.status
            },
            table: written(self.table, &changes, &predicted),
            normal_moves: normal_moves(&surface, &after),
            predicted,
            jump: surface.greatest_jump(&after),
            beyond,
            fairness: self.fairness,
            before,
            after,
            changes,
            held,
            rules,
            turns: lines,
            suspects: self.found.suspects,
            order: surface.order,
            energy: [surface.model.energy_of(&surface.start), surface.model.energy_of(&faired.net)],
            faired,
            resolution: settings.seen,
            nearest: given.nearest,
            is_field: surface.is_field,
            table_noise: self.found.noise,
            line_errors: surface.line_errors,
            notes: self.notes,
            taken: Taken { job: self.job.clone(), started: self.started },
        })
    }

    /// Whether what is held costs moves: with a wave resistance it costs energy, and multipliers are the prices.
    fn is_priced(&self) -> bool {
        self.known.is_none() && self.settings.waves.is_none()
    }

    /// The program of the settings as they are.
    fn solve(&mut self) -> Result<Faired, JobError> {
        Ok(fair_prepared(&mut self.surface, &self.settings, &self.prepared)?)
    }

    /// Of several hundred offsets some are further off than three noise levels: where nobody named the tolerances, they
    /// give way.
    fn widened(&mut self, faired: Faired) -> Result<Faired, JobError> {
        let least = faired.diagnosis.as_ref().and_then(Diagnosis::of_tolerances_alone);
        let Some(least) = least.filter(|least| self.job.names_no_tolerance() && *least <= MOST_WIDENING) else {
            return Ok(faired);
        };
        self.surface.widen(least * WIDER);
        self.prepared.lines = self.prepared.lines.iter().map(|line| TableLine::new(&self.surface, line.line)).collect();
        self.notes.push(format!(
            "tolerances are {:.2} times three noise levels: with less, the offsets contradict each other, the ends of the hull or its \
             greatest half-breadth",
            least * WIDER
        ));
        self.solve()
    }

    /// The program without the rules that have to give way.
    fn without_rules(&mut self, mut faired: Faired, given: &mut Given) -> Result<Faired, JobError> {
        let mut kept: Vec<usize> = (0..self.job.rules.len()).collect();
        while let Some(Instead::WithoutRules(rules)) = &faired.instead {
            (self.progress)(&format!("again without {}", counted(rules.len(), "rule")));
            given.rules.extend(rules.iter().map(|&rule| kept[rule]));
            kept.retain(|rule| !given.rules.contains(rule));
            self.settings.rules = kept.iter().map(|&rule| self.job.rules[rule].clone()).collect();
            given.refused = given.refused.take().or(faired.diagnosis.take());
            faired = self.solve()?.after(&faired);
        }
        given.rules.sort_unstable();
        Ok(faired)
    }

    /// The nearest targets to those that cannot be met that leave a fair hull; the settings are theirs then.
    fn nearest(
        &mut self,
        faired: &Faired,
        ends: &Ends,
        carried: Option<f64>,
        lines: &Counted,
    ) -> Result<Attempt, JobError> {
        let plain = self.settings.clone();
        let mut best: Option<(Attempt, FairSettings)> = None;
        for constraints in within_reach(&self.asked, &self.before, ends, carried, &self.surface) {
            (self.progress)("the nearest feasible targets");
            self.settings = FairSettings { constraints, ..plain.clone() };
            let again = self.solve()?;
            if !again.solved.is_optimal() && best.is_some() {
                continue;
            }
            let attempted = self.attempt(again.after(faired), lines)?;
            let [before, after] = total(&attempted.lines);
            let done = after <= before;
            let fewest = best.as_ref().is_none_or(|(best, _)| after < total(&best.lines)[1]);
            if done || fewest {
                best = Some((attempted, self.settings.clone()));
            }
            if done {
                break;
            }
        }
        let Some((attempted, settings)) = best else { unreachable!("there is always one") };
        self.settings = settings;
        Ok(attempted)
    }

    /// The fair hull.
    fn attempt(&self, mut faired: Faired, watched: &Counted) -> Result<Attempt, JobError> {
        let after = match self.surface.hull_of(&faired.net) {
            // What a solver gives up need not be a hull: the one it began with is.
            Err(_) if !faired.solved.is_optimal() => {
                faired.net.clone_from(&self.surface.start);
                self.surface.hull_of(&faired.net)?
            }
            after => after?,
        };
        let Self { surface, settings, before, .. } = self;
        let (lines, held) = join(
            || watched.turns(&after),
            || held::constraints(surface, settings, &faired, [before, &after], self.is_priced()),
        );
        Ok(Attempt { faired, after, lines, held })
    }

    /// The least inflections of every line of the table.
    fn least(&self, lines: &mut [Turns], faired: &Faired) {
        let least = |turns: &mut Turns| {
            let Some(line) = Line::of(turns.cut) else { return };
            let known = faired.fewer.iter().flat_map(|fewer| &fewer.least).find(|(other, _, _)| *other == line);
            // The proof speaks of the line as one curve; where it is counted in pieces it may have less.
            let bounded = |(count, proved): (usize, bool)| (count.min(turns.after), proved && count <= turns.after);
            let beside = self.known.into_iter().flatten().find(|other| other.cut == turns.cut);
            turns.minimum = match known {
                Some((_, count, proved)) => Some((*count, *proved)),
                None if beside.is_some_and(|other| other.minimum.is_some()) => beside.and_then(|other| other.minimum),
                None if self.job.signs && faired.diagnosis.is_none() && faired.solved.is_optimal() => {
                    TableLine::minimum(&self.surface, line, &faired.net)
                }
                None => None,
            }
            .map(bounded);
        };
        let half = lines.len() / 2;
        let (some, others) = lines.split_at_mut(half);
        join(|| some.iter_mut().for_each(least), || others.iter_mut().for_each(least));
    }

    /// Where sections that are given as points end on the centreplane and the fair hull is wider than an offset may move, in
    /// words.
    fn keels_off(&self, after: &Hull) -> Option<String> {
        let stations = self.table.stations.iter().filter(|_| self.surface.is_field);
        let points = stations.flat_map(|s| s.outlines.iter().flatten().map(move |point| (&s.station, point)));
        let keels = points.filter(|(_, point)| is_on_centreplane(point.y, self.greatest));
        let off =
            keels.filter_map(|(station, point)| Some((after.half_breadth(station.x, point.z)?, station, point.z)));
        let off: Vec<_> =
            off.filter(|(y, ..)| *y > self.settings.least_tolerance.max(3.0 * self.prepared.sigma)).collect();
        let (y, station, z) = off.iter().max_by(|a, b| a.0.total_cmp(&b.0))?;
        Some(format!(
            "{} on the centreplane {} off the fair hull: at {} it has a half-breadth of {y:.3} m where the section ends, at z = {z:.3} m",
            counted(off.len(), "point"),
            if off.len() == 1 { "is" } else { "are" },
            station.words()
        ))
    }

    /// The notes, what bends more often before all else: whoever reads no further should know it.
    fn tell(&mut self, faired: &Faired, held: &[Held], lines: &[Turns], beyond: [f64; 2]) {
        let (job, surface, settings) = (self.job, &self.surface, &self.settings);
        let notes = &mut self.notes;
        let mut when = |applies: bool, note: &str| {
            if applies {
                notes.push(note.to_owned());
            }
        };
        surface.lines_of_field().for_each(|note| when(true, &note));
        let points = self.table.point_count();
        let is_point = |place: &&Place| matches!(place.origin, Origin::Point { .. });
        let others = points - surface.places.iter().filter(is_point).count().min(points);
        when(
            surface.is_field && others > 0,
            &format!(
                "{} of {} lie on the bottom, on other level pieces or inside: they stay where they are",
                others,
                counted(points, "point")
            ),
        );
        let [start, fair] = beyond.map(|beyond| 1e3 * beyond);
        when(
            beyond[1] > self.quantum.max(BREADTH * self.greatest),
            &format!(
                "between offsets the half-breadth passes {:.3} m by {fair:.2} mm at most, that of the surface through the table by \
                 {start:.2} mm",
                self.greatest
            ),
        );
        let suspects = self.excluded.len();
        when(suspects > 0, &format!("{suspects} suspects were left out of the fairing"));
        let left_alone = |proposal: &Proposal| !proposal.accepted;
        when(
            job.accepted == Accepted::All && self.proposals.iter().all(left_alone),
            "all proposed lines were to be taken, and there is none that could be",
        );
        when(
            self.noise > ALARM * self.quantum && self.proposals.iter().any(left_alone),
            "the noise is far above the rounding of the table, and lines are proposed that it does not declare",
        );
        when(
            settings.waves.is_some() && faired.waves.is_none(),
            "the wave resistance is as it comes: the targets cannot all be met, and it joins the objective where they can",
        );
        self.notes.extend(surface.out_of_reach(&faired.net));
        if surface.is_field && points > 0 && !self.assumed.is_empty() {
            self.notes.push(
                "what follows was assumed for the surface through the table; the fair hull ends where its field closes"
                    .to_owned(),
            );
        }
        self.notes.append(&mut self.assumed);
        let off = |held: &Held| held.constraint.missed(held.before, &self.before) > ON_TARGET;
        let asks = held.iter().any(off) || !job.rules.is_empty() || !job.locked.is_empty();
        self.notes.splice(0..0, more_often(lines, asks, faired.carried));
    }
}
