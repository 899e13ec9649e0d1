//! The short page of `fair`: whether the hull is fairer, by how much and at which cost, and eight lines more.

use super::held::{MOST_AREAS, change_of_form};
use super::job::{FairJob, FairOutputs};
pub(in crate::report) use super::words::least;
use super::words::{dimensions, limit, millimetres, place, sources, tolerances};
use crate::exchange::status_word;
use crate::fairing::change::Change;
use crate::fairing::constraint::Constraint;
use crate::fairing::field::line_errors::FoundErrors;
use crate::fairing::held::Held;
use crate::fairing::outcome::Outcome;
use crate::qp::Status;
use crate::report::words::page::WIDTH;
use crate::resistance::WaveResult;
use crate::units::counted;

/// Change of a quantity over its scale up to which it is kept.
const KEPT: f64 = 1e-3;

/// Suspects that are named.
const NAMED: usize = 3;

/// Whether the hull is fairer, by how much, and what it cost.
pub(in crate::report) fn headline(outcome: &Outcome) -> String {
    let ([before, after], [pieces, pieces_after]) = (outcome.changes_of_sign(), outcome.monotone_pieces());
    let verdict = match outcome.status {
        Status::Optimal if outcome.fairness.is_raw() => "Through the table",
        Status::Optimal if outcome.is_no_fairer() => "No fairer",
        Status::Optimal if [after, pieces_after] == [before, pieces] => "Fair as before",
        Status::Optimal => "Fairer",
        _ => "Compromise",
    };
    let moves = millimetres(outcome.moves().0);
    // Volume and centre below one height are one item.
    let below = outcome.held_below().map(|(z, _)| z);
    let words = |constraint: &Constraint| match (constraint, below) {
        (Constraint::Volume { .. }, Some(_)) => "volume".to_owned(),
        (Constraint::CentreOfVolume { .. }, Some(z)) => format!("centre of volume below z = {z:.3} m"),
        (other, _) => other.words(),
    };
    let had: Vec<&Held> = outcome.held.iter().filter(|held| held.is_had()).collect();
    let stays = |held: &&Held| (held.after - held.before).abs() <= KEPT * held.scale;
    let kept = if had.iter().all(stays) { "kept" } else { "on target" };
    let names: Vec<String> = had.iter().map(|held| words(&held.constraint)).collect();
    let kept = match names.as_slice() {
        [] => String::new(),
        [one] => format!(", {one} {kept}"),
        [first @ .., last] if first.len() < MOST_AREAS => format!(", {} and {last} {kept}", first.join(", ")),
        many => format!(", {} quantities {kept}", many.len()),
    };
    format!(
        "{verdict}: {before} > {after} changes of sign{}, {pieces} > {pieces_after} monotone pieces, moves {moves} mm RMS{kept}.",
        least(outcome)
    )
}

/// The page of `fair` in short: the first line says whether the hull is fairer, by how much and what it cost. Eight
/// lines follow; the page has the rest.
#[must_use]
pub fn fair_summary(job: &FairJob, outputs: &FairOutputs, folder: &str) -> String {
    let outcome = &outputs.outcome;
    let name: String = job.table.name.chars().take(WIDTH - 20).collect();
    let noise = millimetres(outcome.faired.sigma);
    let of_lines =
        |found: &FoundErrors| format!(", and {} mm of whole {}s", millimetres(found.rms), found.course.as_str());
    let of_lines = outcome.line_errors.as_ref().map(of_lines).unwrap_or_default();
    let lines = [
        headline(outcome),
        format!("{name}: {}; fairness {}; noise {noise} mm{of_lines}", status_word(outcome.status), outcome.fairness),
        dimensions(outcome).trim_end().to_owned(),
        stated(job, outcome),
        offsets(job, outcome),
        moves(job, outcome),
        suspects(job, outcome),
        held(outputs),
        written(outputs, folder),
    ];
    let waves = outcome.faired.waves.as_ref().map(waves);
    lines.into_iter().chain(waves).map(|line| line + "\n").collect()
}

/// The wave resistance against that of the fair hull without it.
fn waves(waves: &WaveResult) -> String {
    let change = waves.trades.get(waves.taken).map_or(0.0, |taken| 100.0 * (taken.ratio - 1.0));
    let numbers = match (waves.froude_numbers.first(), waves.froude_numbers.last()) {
        (Some(first), Some(last)) if waves.froude_numbers.len() > 1 => format!("{first} to {last}"),
        (Some(first), _) => format!("{first}"),
        _ => String::new(),
    };
    format!(
        "Wave resistance of thin ships at Fn {numbers}: {change:+.2} % of that of the fair hull without its weight."
    )
}

/// What is given, from the table and assumed.
fn stated(job: &FairJob, outcome: &Outcome) -> String {
    let sources = sources(job);
    let midship = if outcome.before.counts_from_aft_perpendicular() { "" } else { "; midship is not known" };
    let rest = match outcome.before.particulars().draught {
        None => ". No draught is stated: give --draught",
        Some(_) if !midship.is_empty() => ", C_M is not held",
        Some(_) => "",
    };
    format!("{sources}{midship}{rest}.")
}

/// How many offsets stayed, and their tolerances.
fn offsets(job: &FairJob, outcome: &Outcome) -> String {
    let (limit, shown) = limit(job.table.form.quantum(), outcome.faired.sigma, job.table.form.notation);
    let shown = shown.split(" (").next().unwrap_or_default();
    let stays = |change: &&Change| !change.suspect && (change.after - change.before).abs() <= limit * (1.0 + 1e-9);
    let kept = outcome.changes.iter().filter(stays).count();
    let all = counted(outcome.changes.len(), "offset");
    format!("{kept} of {all} kept within {shown}{}.", tolerances(outcome))
}

/// The largest move, and what is locked.
fn moves(job: &FairJob, outcome: &Outcome) -> String {
    let (_, largest, at) = outcome.moves();
    let at = at.map(|change| format!(" ({})", place(job, change))).unwrap_or_default();
    let locked = match outcome.changes.iter().filter(|change| change.locked).count() {
        0 => String::new(),
        n => format!("; {n} locked"),
    };
    format!("Largest move {} mm{at}{locked}.", millimetres(largest))
}

/// The suspects that were left out.
fn suspects(job: &FairJob, outcome: &Outcome) -> String {
    let left_out: Vec<&Change> = outcome.changes.iter().filter(|change| change.suspect).collect();
    if left_out.is_empty() {
        return "No suspected typing error is left out.".to_owned();
    }
    let name = |change: &&Change| {
        let cell = (change.station, change.origin.waterline());
        let found = outcome.suspects.iter().find(|suspect| (suspect.station, Some(suspect.waterline)) == cell);
        let id = found.map_or(String::new(), |suspect| format!("{} ", suspect.id));
        id + &place(job, change)
    };
    let mut names: Vec<String> = left_out.iter().take(NAMED).map(name).collect();
    if left_out.len() > NAMED {
        names.push(format!("{} more", left_out.len() - NAMED));
    }
    format!("{} left out: {}.", counted(left_out.len(), "suspected typing error"), names.join("; "))
}

/// Displacement and LCB before and after, and what is not held.
fn held(outputs: &FairOutputs) -> String {
    let outcome = &outputs.outcome;
    let mut line = change_of_form(outputs, ">");
    let targets = outcome.held.iter().filter(|held| !held.is_had()).map(|held| held.constraint.words());
    let rules = outcome.rules.iter().filter(|held| held.given_up).map(|held| held.rule.words());
    let missed: Vec<String> = targets.chain(rules).collect();
    match missed.as_slice() {
        [] if outcome.held.is_empty() => line.push_str("; nothing of the whole hull is held"),
        [] => {}
        missed if missed.len() > MOST_AREAS => line.push_str(&format!("; NOT MET: {} targets", missed.len())),
        missed => line.push_str(&format!("; NOT MET: {}", missed.join(", "))),
    }
    line + "."
}

/// Where the files are, and what else there is to read.
fn written(outputs: &FairOutputs, folder: &str) -> String {
    let files = counted(outputs.files.len(), "file");
    let remarks = match outputs.outcome.notes.len() {
        0 => String::new(),
        n => format!(", {}", counted(n, "remark")),
    };
    format!("Written to {folder}: {files}{remarks}; all else with --verbose.")
}
