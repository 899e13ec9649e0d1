//! The page that `fair` prints: what moved, what holds and at which price, what bends, and the proof.

use super::held::{hydrostatics, volume_of, volumes};
use super::job::{FairJob, FairOutputs};
use super::short::headline;
pub(in crate::report) use super::words::{assumed, counted, dimensions, limit, millimetres, place, tolerances};
use crate::exchange::{reached, status_word};
use crate::fairing::change::Change;
use crate::fairing::outcome::Outcome;
use crate::fairing::proposals::Proposal;
use crate::fairing::smoothing::end_of_search;
use crate::report::jobs::waves::waves_page;
use crate::report::words::lengths;
use crate::report::words::page::{WIDTH, fixed, fixed_sign, wrapped};

/// Moves and suspects that the page lists.
const MOST_LINES: usize = 8;

/// Remarks that the page shows.
const MOST_REMARKS: usize = 16;

/// Parts of its tolerance from which an offset is beyond it.
const BEYOND: f64 = 1.001;

/// The offsets: how many stayed, how many moved more, how many are suspected.
fn verdict(job: &FairJob, outcome: &Outcome, page: &mut String) {
    let (limit, shown) = limit(job.table.form.quantum(), outcome.faired.sigma, job.table.form.notation);
    let size = |change: &Change| (change.after - change.before).abs();
    let kept: Vec<&Change> = outcome.changes.iter().filter(|change| !change.suspect).collect();
    let mut more: Vec<&Change> = kept.iter().copied().filter(|change| size(change) > limit * (1.0 + 1e-9)).collect();
    more.sort_by(|a, b| size(b).total_cmp(&size(a)));
    let excluded: Vec<&Change> = outcome.changes.iter().filter(|change| change.suspect).collect();
    let mut line = format!(
        "{} of {} kept within {shown}",
        kept.len() - more.len(),
        counted(outcome.changes.len(), "offset", "offsets")
    );
    if !more.is_empty() {
        line.push_str(&format!("; {} moved more (listed)", more.len()));
    }
    line.push_str(&match excluded.len() {
        0 => "; no suspected typing error is left out".to_owned(),
        n => format!("; {} left out", counted(n, "suspected typing error", "suspected typing errors")),
    });
    let (rms, largest, at) = outcome.moves();
    let at = at.map(|change| format!(" ({})", place(job, change))).unwrap_or_default();
    line.push_str(&tolerances(outcome));
    line.push_str(&format!(
        ". Moves: {} mm RMS, {} mm at most{at}, normal to the hull {} and {} mm; {}.",
        millimetres(rms),
        millimetres(largest),
        millimetres(outcome.normal_moves[0]),
        millimetres(outcome.normal_moves[1]),
        noise(outcome)
    ));
    page.push_str(&wrapped(&line, 2));
    for change in more.iter().take(MOST_LINES) {
        page.push_str(&format!("  {:<46}{:>9} mm\n", place(job, change), signed(change.after - change.before)));
    }
    if more.len() > MOST_LINES {
        page.push_str(&format!("  {} more: changes.csv\n", more.len() - MOST_LINES));
    }
    for change in &excluded {
        let found = outcome
            .suspects
            .iter()
            .find(|s| (s.station, Some(s.waterline)) == (change.station, change.origin.waterline()));
        let (id, written, why) = match found {
            Some(s) => (s.id.as_str(), s.written.as_str(), s.hypothesis().as_str()),
            None => ("", "", ""),
        };
        let metres = match written.parse::<f64>() {
            Ok(value) if (value - change.before).abs() < 1e-9 => String::new(),
            _ => format!(", {} m", fixed(change.before, 4)),
        };
        let read = found.map_or(String::new(), |s| format!(" for {}", s.proposed_text));
        let text = format!(
            "  {id} {}: written {written}{metres} ({why}{read}); the fair hull has {}",
            place(job, change),
            lengths::length(job.table.form.notation, change.after, 4)
        );
        page.push_str(&format!("  {}", wrapped(&text, 5)));
    }
    let stopped = reached(outcome).count();
    if stopped > 0 {
        let shares = reached(outcome).filter_map(|change| Some(size(change) / change.tolerance?));
        let farthest = shares.fold(0.0, f64::max);
        // A compromise may widen the tolerances.
        let beyond =
            if farthest > BEYOND { format!(" or beyond, at {farthest:.3} times it at most") } else { String::new() };
        page.push_str(&format!("  {} at the tolerance{beyond}\n", counted(stopped, "offset stops", "offsets stop")));
    }
    let locked = outcome.changes.iter().filter(|change| change.locked).count();
    if locked > 0 {
        let moved = outcome.changes.iter().filter(|change| change.locked).map(size).fold(0.0, f64::max);
        let offsets = counted(locked, "offset is locked", "offsets are locked");
        page.push_str(&format!("  {offsets}; the largest move of one is {moved:.0e} m\n"));
    }
}

/// The noise of the table, and what was taken of it.
fn noise(outcome: &Outcome) -> String {
    let [sigma, errors] = [outcome.faired.sigma, outcome.faired.errors];
    let [admitted, taken, found] = [sigma, errors, outcome.table_noise].map(millimetres);
    let less = |part: f64, whole: f64| part < 0.995 * whole;
    match (less(sigma, outcome.table_noise), less(errors, sigma)) {
        (false, false) => format!("noise of the table {taken} mm"),
        (false, true) => format!(
            "noise of the table {found} mm, of which {taken} mm are taken for errors and the rest for the hull's own"
        ),
        (true, false) => format!("noise of the table {found} mm, of which {admitted} mm are taken for noise"),
        (true, true) => format!(
            "noise of the table {found} mm; {admitted} mm are taken for noise, {taken} mm of them for errors and the rest for the \
             hull's own"
        ),
    }
}

fn signed(length: f64) -> String {
    let text = millimetres(length);
    if text.starts_with('-') { text } else { format!("+{text}") }
}

/// The page of `fair` with everything, but for the first line at most 80 columns wide.
#[must_use]
pub fn fair_page(job: &FairJob, outputs: &FairOutputs, folder: &str) -> String {
    let outcome = &outputs.outcome;
    let name: String = job.table.name.chars().take(WIDTH - 20).collect();
    let mut page = headline(outcome) + "\n";
    page.push_str(&format!("{name}: {}\n", status_word(outcome.status)));
    page.push_str(&dimensions(outcome));
    page.push_str(&assumed(job, outcome));
    page.push('\n');
    verdict(job, outcome, &mut page);
    page.push('\n');
    hydrostatics(outputs, &mut page);
    page.push('\n');
    let faired = &outcome.faired;
    let certificate = &faired.solved.certificate;
    let energy = outcome.energy[1] / outcome.energy[0];
    let proof = format!(
        "Proof: duality gap {:.0e}, stationarity {:.0e}, largest violation of a row {:.0e}, computed without the solver. Energy \
         of order {}: {} of that {}. Fairness {}, smoothing weight {:.2e}{}, {:.1} degrees of freedom; {}, {} iterations.",
        certificate.gap.abs(),
        certificate.stationarity,
        certificate.max_violation.max(0.0),
        outcome.order,
        if energy >= 1e-3 { format!("{energy:.4}") } else { format!("{energy:.1e}") },
        if outcome.is_field { "of the likeliest field" } else { "before" },
        outcome.fairness,
        faired.lambda,
        end_of_search(faired.lambda, &faired.trials),
        faired.edf,
        counted(faired.programs, "program", "programs"),
        faired.iterations
    );
    page.push_str(&wrapped(&proof, 2));
    faired.waves.iter().for_each(|waves| page.push_str(&waves_page(waves, ["fair", "energy m2"])));
    let rounding = &outputs.rounding;
    let of = if outputs.rows.is_some() { "displacement" } else { "volume" };
    let volume = match rounding.volume_share {
        Some(share) => format!("{of} {}", fixed_sign(100.0 * share, 4, " %")),
        None => format!("{of} not known"),
    };
    page.push_str(&wrapped(
        &format!(
            "Rounding to the notation of the table, the last step: {} mm at most, {} mm RMS, {volume}.",
            millimetres(rounding.largest),
            millimetres(rounding.root_mean_square)
        ),
        2,
    ));
    // What the chart has no line for cannot be taken; it is in fairing.json.
    let proposals: Vec<&Proposal> =
        outcome.proposals.iter().filter(|line| line.accepted || line.rms.is_some()).collect();
    if !proposals.is_empty() {
        // What is taken, or cannot be, needs no hint.
        let open = proposals.iter().any(|line| line.rms.is_some() && !line.accepted);
        let hint = if open { " (--accept-lines takes them)" } else { "" };
        page.push_str(&format!("Lines that the table does not declare{hint}:\n"));
    }
    for line in proposals.into_iter().take(MOST_LINES) {
        page.push_str(&format!("  {}", wrapped(&proposal(line), 5)));
    }
    for note in outcome.notes.iter().take(MOST_REMARKS) {
        page.push_str(&wrapped(&format!("- {note}"), 2));
    }
    if outcome.notes.len() > MOST_REMARKS {
        page.push_str(&format!("- {} more: notes in fairing.json\n", outcome.notes.len() - MOST_REMARKS));
    }
    let names: Vec<&str> = outputs.files.iter().map(|file| file.name.as_str()).collect();
    page.push_str(&wrapped(&format!("Written to {folder}: {}.", names.join(", ")), 2));
    page
}

/// A line that is proposed, and what it would bring.
fn proposal(proposal: &Proposal) -> String {
    let line = &proposal.line;
    let taken = if proposal.accepted { ", taken" } else { "" };
    let brings = match (proposal.rms, proposal.gain) {
        (Some([without, with]), Some(gain)) => format!(
            "offsets depart by {} mm RMS without it and {} mm with it, the objective falls by {gain:.0} squares of the noise",
            millimetres(without),
            millimetres(with)
        ),
        _ => "the chart of the surface has no such line, so that it cannot be taken".to_owned(),
    };
    format!(
        "L{} {} along the {} at {} m, from {} to {} m{taken}: {brings}.",
        proposal.number,
        line.kind.as_str(),
        line.course.as_str(),
        fixed(line.at, 3),
        fixed(line.reach[0], 3),
        fixed(line.reach[1], 3)
    )
}

/// Four lines for a job that runs again and again.
#[must_use]
pub fn fair_line(outputs: &FairOutputs) -> String {
    let outcome = &outputs.outcome;
    let (rms, largest, _) = outcome.moves();
    let turns = ["waterline", "station", "buttock", "diagonal"].map(|kind| outcome.inflections(kind));
    let after: usize = turns.iter().map(|counts| counts[1]).sum();
    let form = match &outputs.rows {
        Some([_, row]) => {
            let value = |key: &str| crate::report::words::page::value(row, key);
            format!("displacement {} t, CB {}, XCB {} m", value("DISPM"), value("CB"), value("XCB"))
        }
        None => {
            let (below, [volumes, centres]) = volumes(outcome);
            let (volume, centre) = (volume_of(volumes[1]), fixed(centres[1], 3));
            format!("volume below z = {below:.3} m {volume} m3, its centre {centre} m")
        }
    };
    format!(
        "{}: {form}; moves {} mm RMS, {} mm at most; {after} inflections\n",
        status_word(outcome.status),
        millimetres(rms),
        millimetres(largest)
    )
}
