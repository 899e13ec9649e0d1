//! One table at several grades of fairness.
//!
//! The surface through the table, the field or net that follows it, its noise and the search for the weight do not depend
//! on the grade: they are made once.

use super::change::Turns;
use super::changes::Watched;
use super::job::{Job, JobError};
use super::outcome::Outcome;
use super::run::{Progress, Run};
use super::start::Taken;
use super::strength::Fairness;
use crate::hull::OffsetTable;
use crate::numeric::join;
use crate::units::counted;
use std::sync::Arc;

impl Taken {
    /// A run of `job` that only lacks its grade; the least inflections of lines that are `known` are not sought again.
    fn run<'a>(
        &self,
        job: &'a Job,
        table: &'a OffsetTable,
        known: &'a [Turns],
    ) -> Result<(Run<'a>, Watched), JobError> {
        let (run, watched) = Run::new(job, table, Arc::clone(&self.started), &|_| ())?;
        Ok((run.beside(known), watched))
    }
}

impl Job {
    /// The table at each of `grades`, from what `asked` came from, the outcome of [`Job::run`] for this job and table; `asked`
    /// itself at its own grade. What is held and the rules have no prices at the other grades.
    ///
    /// # Errors
    /// As [`Job::run`].
    #[doc(hidden)]
    pub fn run_grades(
        &self,
        table: &OffsetTable,
        asked: &Outcome,
        grades: &[Fairness],
        progress: Progress<'_>,
    ) -> Result<Vec<Outcome>, JobError> {
        let others: Vec<Fairness> = grades.iter().copied().filter(|grade| *grade != asked.fairness).collect();
        progress(&format!("{} of fairness", counted(others.len(), "other grade")));
        let smooth = Self { signs: self.signs, holding: self.holding.clone(), ..asked.taken.job.clone() };
        let through = smooth.through();
        let run = |job, known, raw: bool| {
            let needed = others.iter().any(|grade| grade.is_raw() == raw);
            needed.then(|| asked.taken.run(job, table, known)).transpose()
        };
        // Tolerances of the surface through the table are its own.
        let (smooth, through) = join(|| run(&smooth, &asked.turns, false), || run(&through, &[], true));
        let (smooth, through) = (smooth?, through?);
        let one = |grade: Fairness| {
            let base = if grade.is_raw() { &through } else { &smooth };
            let outcome = base.clone().map(|(run, watched)| run.at(grade)?.outcome(watched)).transpose();
            progress(&format!("grade {grade} done"));
            outcome
        };
        let some = |first: usize| others.iter().skip(first).step_by(2).map(|&grade| one(grade)).collect();
        let (even, odd): (Result<Vec<_>, JobError>, Result<Vec<_>, JobError>) = join(|| some(0), || some(1));
        let found: Vec<Outcome> = even?.into_iter().chain(odd?).flatten().collect();
        let of = |grade: &Fairness| found.iter().chain([asked]).find(|outcome| outcome.fairness == *grade).cloned();
        Ok(grades.iter().filter_map(of).collect())
    }
}
