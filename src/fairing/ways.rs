//! A job is done in the way that suits most tables, and again in another where the result shows that it does not suit
//! this one: each other way is taken where it is better, and says so before all else.

use super::constraint::Rule;
use super::flats::shown_flat;
use super::infeasible::Diagnosis;
use super::job::{Holding, Job, JobError};
use super::outcome::Outcome;
use super::relinearise::ON_TARGET;
use super::run::{Progress, Way};
use super::start::Started;
use super::unbroken::RunsOn;
use crate::hull::OffsetTable;
use crate::qp::Status;

/// The surface through the table is off a target by more than this, over its scale, where it is another than its own:
/// less is what a target of the drawing office differs from a table by errors of the table, as long as no line bends
/// more often for it.
const ANOTHER: f64 = 2e-3;

/// A locked offset that moves by more did not stay \[m\].
const LOCKED: f64 = 1e-9;

/// Inflections elsewhere that one more than before on a line is worth.
const WORSE: usize = 4;

/// Part of the smoothing weight that is tried where lines bend more often with all of it: DTC as sections 780 > 924
/// inflections with all of it, 773 with this part, 793 with a hundredth of it again.
const REDUCED_WEIGHT: f64 = 1e-2;

impl Outcome {
    /// The other one where it is better, with why it was taken.
    fn or(self, mut other: Self, better: bool, why: &str) -> Self {
        if !better {
            return self;
        }
        other.notes.insert(0, why.to_owned());
        other
    }

    /// The net is that of the surface through the table, and the optimum is proved.
    fn is_proved_on_the_fit(&self) -> bool {
        !self.own && self.status == Status::Optimal
    }

    /// Inflections of stations more than before, all together, and of waterlines.
    fn more(&self) -> usize {
        let more = |[before, after]: [usize; 2]| after.saturating_sub(before);
        ["station", "waterline"].map(|kind| more(self.inflections(kind))).iter().sum()
    }

    /// Inflections of all curves where one more than before on a line counts as several elsewhere.
    fn counted(&self) -> usize {
        self.all_inflections()[1] + WORSE * self.excess()
    }

    /// What all targets are missed by together, over their scales.
    fn missed(&self) -> f64 {
        self.held.iter().map(|held| held.constraint.missed(held.after, &self.before)).sum()
    }

    /// The furthest that a locked offset moved \[m\].
    fn moved_though_locked(&self) -> f64 {
        let locked = self.changes.iter().filter(|change| change.locked);
        locked.map(|change| (change.after - change.before).abs()).fold(0.0, f64::max)
    }

    /// The first of these that is more is worse: nothing proved, lines that bend more often, energy above the start's.
    fn trouble(&self) -> (bool, usize, f64) {
        (self.status == Status::Limit, self.excess(), (self.energy[1] / self.energy[0]).max(1.0))
    }
}

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
    pub fn run_telling(&self, table: &OffsetTable, progress: Progress<'_>) -> Result<Outcome, JobError> {
        if self.fairness.is_raw() {
            return self.through().run_within_ways(table, progress);
        }
        self.run_within_ways(table, progress)
    }

    /// The job of the surface through the table: it has the displacement and the humps that it has.
    pub(super) fn through(&self) -> Self {
        let given = match &self.holding {
            Holding::Table => Vec::new(),
            Holding::Given(given) | Holding::Both { given, .. } => given.clone(),
        };
        Self { signs: false, holding: Holding::Given(given), ..self.clone() }
    }

    /// The table faired in the way that suits it.
    fn run_within_ways(&self, table: &OffsetTable, progress: Progress<'_>) -> Result<Outcome, JobError> {
        let mut way = Way { own: true, another: ANOTHER, followed: None, progress };
        let start = Started::new(self, table, way.own)?;
        if start.surface.is_field {
            let outcome = self.run_from(table, way, start)?;
            return self.or_without_the_field(table, progress, outcome);
        }
        // What has no field has none in any other way.
        let job = Self { field: false, ..self.clone() };
        way.followed = job.followed(table)?;
        let first = job.run_from(table, way, start)?;
        job.within_other_ways(table, way, first)
    }

    /// The table faired on the net of the fit or on one of its own, in the way that suits it.
    fn within_other_ways(&self, table: &OffsetTable, way: Way<'_>, first: Outcome) -> Result<Outcome, JobError> {
        let progress = way.progress;
        let mut outcome = self.run_after(table, way, first)?;
        if !self.signs || !outcome.is_proved_on_the_fit() {
            return Ok(outcome);
        }
        // What is near enough to be an error of the table may be a wish all the same.
        if outcome.excess() > 0 && outcome.targets_off(ON_TARGET) > outcome.targets_off(ANOTHER) {
            progress("lines bend more often: targets as one smooth move");
            let other = self.run_within(table, Way { another: ON_TARGET, ..way })?;
            let [before, after] = other.all_inflections();
            if other.is_proved_on_the_fit() && other.excess() < outcome.excess() && after <= before {
                outcome = other;
            }
        }
        if self.weight.is_some() || outcome.faired.carried.is_some() || outcome.more() == 0 {
            return Ok(outcome);
        }
        // What the smoothing bends more often and no signs could hold, less of it bends less.
        // The grade of fairness multiplies a weight that is named.
        let weight = REDUCED_WEIGHT * outcome.faired.chosen.lambda / self.fairness.on_the_weight();
        progress("lines bend more often: a hundredth of the smoothing weight");
        let mut other = Self { weight: Some(weight), ..self.clone() }.run_within(table, way)?;
        other.faired.trials.clone_from(&outcome.faired.trials);
        let fewer = other.more() < outcome.more() && other.all_inflections()[1] < outcome.all_inflections()[1];
        let better = other.is_proved_on_the_fit() && fewer;
        Ok(outcome.or(
            other,
            better,
            "the smoothing weight is a hundredth of that for the errors of the table, with which lines bent more often than \
             before",
        ))
    }

    /// A field whose tolerances have no room for the move to its targets bends for them. The net of the fit, which
    /// goes through the offsets as they are, may be nearer to them.
    fn or_without_the_field(
        &self,
        table: &OffsetTable,
        progress: Progress<'_>,
        outcome: Outcome,
    ) -> Result<Outcome, JobError> {
        let bent = outcome.faired.carried.is_some_and(|factor| factor > 1.0);
        if !bent || outcome.status != Status::Optimal || !outcome.is_no_fairer() {
            return Ok(outcome);
        }
        progress("the field bends more often for its targets: again, on the net of the surface through the table");
        let other = Self { field: false, ..self.clone() }.run_within_ways(table, progress)?;
        let better = other.status == Status::Optimal && other.changes_of_sign()[1] < outcome.changes_of_sign()[1];
        Ok(outcome.or(
            other,
            better,
            "a field bends more often to meet the targets within the tolerances: the net of the surface through the table was faired",
        ))
    }

    /// The noise of a table \[m\] that a net of its own follows where rules keep the net of the fit; none elsewhere.
    fn followed(&self, table: &OffsetTable) -> Result<Option<f64>, JobError> {
        let kept = |rule: &Rule| matches!(rule, Rule::Fixed(_) | Rule::FlatOfSide { .. } | Rule::FlatOfBottom { .. });
        if self.weight.is_some() || !self.rules.iter().any(kept) {
            return Ok(None);
        }
        let rules = self.rules.iter().filter(|rule| !kept(rule)).cloned().collect();
        let without = Self { rules, field: false, ..self.clone() };
        Ok(Started::new(&without, table, true)?.noise_of_its_own_net())
    }

    /// Fairs a table.
    fn run_within(&self, table: &OffsetTable, way: Way<'_>) -> Result<Outcome, JobError> {
        let first = self.run_on(table, way)?;
        self.run_after(table, way, first)
    }

    /// The same, where a first outcome is known.
    fn run_after(&self, table: &OffsetTable, way: Way<'_>, first: Outcome) -> Result<Outcome, JobError> {
        if first.is_field {
            return Ok(first);
        }
        let on_the_fit = Way { own: false, ..way };
        let outcome = self.or_with_jumps(table, on_the_fit, first)?;
        let outcome = self.or_on_the_fit(table, on_the_fit, outcome)?;
        let outcome = self.or_fitted_without_lines(table, way, outcome)?;
        self.or_without_the_flat(table, way, outcome)
    }

    /// A surface that is fitted with the lines that are declared may be of another chart, with which the table cannot be
    /// had: the one that is fitted without them may break along them as well.
    fn or_fitted_without_lines(
        &self,
        table: &OffsetTable,
        way: Way<'_>,
        outcome: Outcome,
    ) -> Result<Outcome, JobError> {
        let taken = outcome.proposals.iter().any(|proposal| proposal.accepted);
        if !self.refitted || !taken || outcome.status == Status::Optimal {
            return Ok(outcome);
        }
        (way.progress)("again, on the surface that is fitted without the declared lines");
        let other = Self { refitted: false, ..self.clone() }.run_within(table, way)?;
        let better = other.status == Status::Optimal;
        Ok(outcome.or(
            other,
            better,
            "the surface through the table is fitted without the lines that break, and may break along them: with the one \
             that is fitted with them the offsets cannot be met within their tolerances",
        ))
    }

    /// Where the flat of side, or what is wished, takes all the room there is, curvature that must run on bends lines
    /// more often and raises the energy.
    fn or_with_jumps(&self, table: &OffsetTable, way: Way<'_>, mut outcome: Outcome) -> Result<Outcome, JobError> {
        if self.runs_on != RunsOn::Everywhere || outcome.own || outcome.status == Status::Infeasible {
            return Ok(outcome);
        }
        let beside_flats = shown_flat(table, &[]).is_some() && outcome.status != Status::Limit;
        let tries = [(RunsOn::ButFlats, "beside the flat of side"), (RunsOn::Nowhere, "across lines of the net")];
        for (runs_on, place) in tries.into_iter().skip(usize::from(!beside_flats)) {
            if outcome.trouble() <= (false, 0, 1.0) {
                break;
            }
            (way.progress)(&format!("again, and {place} the curvature may jump"));
            let other = Self { runs_on, ..self.clone() }.run_on(table, way)?;
            let better = other.trouble() < outcome.trouble();
            let why = format!(
                "{place} the curvature may jump where that of the surface through the table does not: else lines bend more \
                 often, the energy rises or nothing is proved"
            );
            outcome = outcome.or(other, better, &why);
        }
        Ok(outcome)
    }

    /// What a net of its own cannot have, that of the fit may, which meets every offset; and one that bends more often
    /// than the surface through the table, and more, does not follow it after all.
    fn or_on_the_fit(&self, table: &OffsetTable, way: Way<'_>, outcome: Outcome) -> Result<Outcome, JobError> {
        let refused = outcome.status != Status::Optimal;
        let bends = outcome.more() > 0 && outcome.energy[1] > outcome.energy[0];
        if !outcome.own || !refused && !bends {
            return Ok(outcome);
        }
        (way.progress)("again, on the net of the surface through the table");
        // What is locked is no reason to doubt what that net says of the errors.
        let followed = (refused && !self.locked.is_empty()).then_some(outcome.faired.sigma);
        let other = self.run_on(table, Way { followed, ..way })?;
        if refused {
            let moves_less = outcome.moved_though_locked() > other.moved_though_locked().max(LOCKED);
            let better = other.status == Status::Optimal || moves_less;
            return Ok(outcome.or(
                other,
                better,
                "the targets cannot be met on an independent net, which follows the table with fewer control values: the net \
                 of the surface through the table was faired",
            ));
        }
        Ok(if other.more() < outcome.more() && other.status == outcome.status { other } else { outcome })
    }

    /// A flat that the table shows and nobody asked for stands in the way of nothing.
    fn or_without_the_flat(&self, table: &OffsetTable, way: Way<'_>, outcome: Outcome) -> Result<Outcome, JobError> {
        let flat = outcome.rules.iter().position(|rule| matches!(rule.rule, Rule::FlatShown { .. }));
        let Some(flat) = flat else { return Ok(outcome) };
        let gives = |found: &Diagnosis| {
            found.cheapest().is_none() || found.rules.iter().any(|(rule, give)| *rule == flat && give.is_some())
        };
        let hinders = outcome.rules[flat].given_up || outcome.faired.diagnosis.as_ref().is_some_and(gives);
        if !hinders && outcome.excess() == 0 {
            return Ok(outcome);
        }
        (way.progress)("again, without the flat of side that the table shows");
        let other = Self { keep_flat: false, ..self.clone() }.run_within(table, way)?;
        let proved = other.status == Status::Optimal && outcome.status != Status::Optimal;
        let has_cheapest =
            |outcome: &Outcome| outcome.faired.diagnosis.as_ref().is_some_and(|d| d.cheapest().is_some());
        let nearer = (other.missed() < outcome.missed() || has_cheapest(&other) && !has_cheapest(&outcome))
            && other.excess() <= outcome.excess();
        let fairer = other.excess() < outcome.excess() && other.counted() <= outcome.counted();
        let better = proved || other.status == outcome.status && (fairer || nearer);
        Ok(outcome.or(
            other,
            better,
            "the flat of side that the table shows was not kept: with it the offsets cannot be met within their tolerances, \
             targets are further away or lines bend more often",
        ))
    }
}
