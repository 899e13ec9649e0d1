//! The job of `fair`, run: the fair hull with its certificate. Nothing is written here.

use super::job::{
    FairJob, FairOutputs, conventions_beside, fitted, hull_file, hull_text, mark, marked_name, offsets_name, overrides,
    refused, row,
};

use serde_json::{Value, json};

use super::grades;
use crate::exchange::{
    Particulars, RoundingEffect, TableWriting, changes_csv, control_polygon_csv, conventions_json, fairing_json,
    read_table_with, row_json, status_word, write_table,
};
use crate::fairing::Progress;
use crate::fairing::held::Held;
use crate::fairing::job::Holding;
use crate::fairing::outcome::Outcome;
use crate::fairing::record::FairRecord;
use crate::hull::{Functional, OffsetTable};
use crate::hydrostatics::Hydrostatics;
use crate::qp::Status;
use crate::report::failure::Failure;
use crate::report::input::source::remark;
use crate::report::jobs::check::suspect_json;
use crate::report::jobs::waves::trade_files;
use crate::report::output::files::OutputFile;
use crate::report::output::manifest::{json_file, manifest_file};
use crate::report::words::remarks::unusual;

/// The fair table with the texts of what did not move.
fn with_texts(job: &FairJob, outcome: &Outcome) -> OffsetTable {
    let mut table = outcome.table.clone();
    mark(&mut table, outcome.status != Status::Optimal);
    for (station, old) in table.stations.iter_mut().zip(&job.table.stations) {
        for (cell, old) in station.half_breadths.iter_mut().zip(&old.half_breadths) {
            if let (Some(a), Some(b)) = (cell.value(), old.value())
                && (a - b).abs() <= 1e-9
            {
                cell.clone_from(old);
            }
        }
    }
    table
}

/// What rounding did to the offsets and to the volume; the table as it is read back.
fn rounded(job: &FairJob, outcome: &Outcome, name: &str, text: &str) -> (RoundingEffect, Option<OffsetTable>) {
    let stated = overrides(job).text();
    let sidecar = job.sidecar.iter().chain(&stated).map(|(name, text)| (name.as_str(), text.as_str()));
    let back = read_table_with(name, text.as_bytes(), sidecar).ok().map(|read| read.table);
    let volume = |table: &OffsetTable| {
        let mut table = table.clone();
        table.stated = job.table.stated;
        let hull = fitted(&table).ok()?;
        Some(Functional::Volume.value(&hull, hull.reference_height()))
    };
    let exact = volume(&outcome.table);
    let written = back.as_ref().and_then(volume);
    let change = exact.zip(written).map(|(exact, written)| written - exact);
    let share = change.zip(exact).map(|(change, exact)| change / exact);
    (RoundingEffect { volume: change, volume_share: share, ..RoundingEffect::default() }, back)
}

/// Fairs the table and makes every file about it.
///
/// # Errors
/// [`Failure::Input`] when the table makes no hull or no problem; [`Failure::Internal`] when a file cannot be made.
/// Infeasible targets are [`FairOutputs::verdict`].
pub fn fair_outputs(job: &FairJob, figures: bool) -> Result<FairOutputs, Failure> {
    fair_outputs_with_progress(job, figures, &|_| ())
}

/// The same, telling what is being done.
///
/// # Errors
/// As [`fair_outputs`].
pub fn fair_outputs_with_progress(
    job: &FairJob,
    figures: bool,
    progress: Progress<'_>,
) -> Result<FairOutputs, Failure> {
    if job.grades && job.job.waves.is_some() {
        let message = "--grades goes without --wave-resistance: run the grade that is wanted with it";
        return Err(Failure::Usage(message.to_owned()));
    }
    let mut outcome = job.job.run_telling(&job.table, progress).map_err(|error| refused(job, &error))?;
    let grades = job.grades.then(|| grades::grade_files(job, &outcome, figures, progress)).transpose()?;
    // What reading the table had to guess decides the hull as much.
    outcome.notes.splice(0..0, job.warnings().map(remark));
    let rows = row(job, &outcome.before).zip(row(job, &outcome.after)).map(|(before, after)| [before, after]);
    outcome.notes.extend(rows.as_ref().and_then(|[before, _]| unusual(before)));
    let name = offsets_name(job);
    let written = write_table(&with_texts(job, &outcome), TableWriting::default());
    let (effect, back) = rounded(job, &outcome, &name, &written.text);
    let rounding = RoundingEffect {
        largest: written.rounding.largest,
        root_mean_square: written.rounding.root_mean_square,
        ..effect
    };
    let suspects: Vec<Value> = outcome.suspects.iter().map(|suspect| suspect_json(&job.table, suspect)).collect();
    let certificate = fairing_json(&job.table, &outcome, &rounding, &suspects);
    let compromise = outcome.status != Status::Optimal;
    let hull = hull_file(job, "hull.json", &outcome)?;
    let name_of_hull = marked_name(outcome.after.name(), compromise);
    outcome.after = outcome.after.with_name(name_of_hull);
    let summary = summary(job, &outcome, rows.as_ref(), (&rounding, &certificate["held_below"]));
    let mut files = vec![
        hull,
        hull_text(job, "fitted-hull.json", &outcome.before)?,
        OutputFile::table(&name, written.text, &job.table.form)?,
        OutputFile::text("changes.csv", changes_csv(&job.table, &outcome, back.as_ref())),
        OutputFile::text("control-polygon.csv", control_polygon_csv(&outcome)),
        json_file("fairing.json", &certificate)?,
        json_file("summary.json", &summary)?,
    ];
    if let Some(text) = conventions_beside(job) {
        files.push(OutputFile::text("offsets.toml", text));
    }
    if figures {
        progress("figures");
        let mut record = FairRecord::new(&job.table, &outcome);
        record.name = marked_name(&record.name, compromise);
        files.extend(super::figures::fair_figures(&record)?);
        if let Some(waves) = &outcome.faired.waves {
            files.extend(trade_files(&record.name, waves)?);
        }
    }
    files.extend(grades.into_iter().flatten());
    files.sort_by(|a, b| a.name.cmp(&b.name));
    let input = job.inputs.first().cloned().ok_or_else(|| Failure::Internal("no input".to_owned()))?;
    let manifest = manifest_file(input, &files)?;
    files.push(manifest);
    Ok(FairOutputs {
        outcome,
        rounding,
        rows,
        certificate,
        files,
        table_file: job.table_file.clone(),
        request: job.request.clone(),
    })
}

/// Contents of `summary.json`.
fn summary(
    job: &FairJob,
    outcome: &Outcome,
    rows: Option<&[Hydrostatics; 2]>,
    (rounding, held_below): (&RoundingEffect, &Value),
) -> Value {
    let of_the_table = |held: &Held| match &job.job.holding {
        _ if !held.constraint.needs_draught() => true,
        Holding::Table => true,
        Holding::Given(_) => false,
        Holding::Both { own, .. } => own.iter().any(|own| own.words() == held.constraint.words()),
    };
    let targets: Vec<Value> = outcome
        .held
        .iter()
        .map(|held| {
            json!({
                "key": held.constraint.key(), "requested": held.constraint.target(), "achieved": held.after,
                "error": held.missed(), "origin": if of_the_table(held) { "table" } else { "given" },
            })
        })
        .collect();
    let (rms, max, _) = outcome.moves();
    let kinds = ["station", "waterline", "buttock", "diagonal"];
    let inflections: serde_json::Map<String, Value> =
        kinds.iter().map(|kind| (format!("{kind}s"), json!(outcome.inflections(kind)))).collect();
    json!({
        "name": marked_name(&job.table.name, outcome.status != Status::Optimal),
        "status": status_word(outcome.status),
        "inputs": job.inputs,
        "particulars": Particulars::from(outcome.after.particulars()),
        "design": rows.map(|[_, after]| row_json(after)),
        "before": rows.map(|[before, _]| row_json(before)),
        "targets": targets,
        "held_below": held_below,
        "moves": { "rms": rms, "max": max, "excluded": outcome.changes.iter().filter(|c| c.suspect).count() },
        "inflections": inflections,
        "monotone_pieces": outcome.monotone_pieces(),
        "gaussian_regions": outcome.regions,
        "rounding": { "largest": rounding.largest, "rms": rounding.root_mean_square, "volume_share": rounding.volume_share },
        "conventions": conventions_json(&job.conventions),
        "notes": outcome.notes,
        "reading": job.reading.iter().map(ToString::to_string).collect::<Vec<_>>(),
    })
}
