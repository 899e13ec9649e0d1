//! One table at all whole grades of fairness, for whoever chooses one: a table, the hulls and a picture.

use super::job::{FairJob, GRADES_TABLE, grade_hull, hull_file, marked_name, refused, row};
use crate::exchange::grades_csv;
use crate::fairing::Progress;
use crate::fairing::outcome::Outcome;
use crate::fairing::strength::Fairness;
use crate::hydrostatics::Hydrostatics;
use crate::plot::{GradePoint, grades_figure};
use crate::qp::Status;
use crate::report::failure::Failure;
use crate::report::output::files::OutputFile;
use crate::report::output::pictures::pictures;

/// The files of all whole grades; `asked` is the outcome of the job.
pub(in crate::report) fn grade_files(
    job: &FairJob,
    asked: &Outcome,
    figures: bool,
    progress: Progress<'_>,
) -> Result<Vec<OutputFile>, Failure> {
    let run = job.job.run_grades(&job.table, asked, &Fairness::whole(), progress);
    let grades = run.map_err(|error| refused(job, &error))?;
    let rows = grades.iter().map(|outcome| row(job, &outcome.after)).collect::<Vec<_>>();
    let table: Vec<(&Outcome, Option<&Hydrostatics>)> = grades.iter().zip(rows.iter().map(Option::as_ref)).collect();
    let mut files = vec![OutputFile::text(GRADES_TABLE, grades_csv(&table))];
    for outcome in &grades {
        files.push(hull_file(job, &grade_hull(outcome.fairness), outcome)?);
    }
    if figures {
        let mut points: Vec<GradePoint> =
            grades.iter().map(|outcome| GradePoint::new(outcome, outcome.fairness == asked.fairness)).collect();
        if points.iter().all(|point| !point.asked) {
            points.push(GradePoint::new(asked, true));
            points.sort_by(|a, b| a.grade.total_cmp(&b.grade));
        }
        let ship = marked_name(&job.table.name, asked.status != Status::Optimal);
        files.extend(pictures("grades", grades_figure(&ship, asked.is_field, &points))?);
    }
    Ok(files)
}
