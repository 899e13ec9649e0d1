//! The page that `fair` prints: what moved, what holds and at which price, what bends, and the proof.

use super::fair::{FairJob, FairOutputs};
use super::fair_refused::line_name;
use super::fair_short::headline;
use super::page::{WIDTH, fixed, fixed_sign, no_draught, wrapped};
use super::verdict::more_than;
use crate::exchange::{priced, reached, status_word};
use crate::fairing::constraint::{Constraint, Rule};
use crate::fairing::held::Held;
use crate::fairing::inspect::PolygonSigns;
use crate::fairing::outcome::{Change, Outcome, Turns};
use crate::fairing::proposals::Proposal;
use crate::fairing::record::accuracy;
use crate::fairing::relinearise::ON_TARGET;
use crate::fairing::smoothing::end_of_search;
use crate::hydrostatics::Quantity;
use crate::units::Notation;

/// Moves and suspects that the page lists.
const MOST_LINES: usize = 8;

/// Section areas that the page lists one by one.
pub(super) const MOST_AREAS: usize = 4;

/// Remarks that the page shows.
const MOST_REMARKS: usize = 16;

/// A small length in the terms of the table: parts of an inch, or millimetres.
fn small(length: f64, notation: Notation) -> String {
    let sixteenths = (length / 0.0254 * 16.0).round();
    if notation == Notation::FeetInchesEighths && (length - sixteenths * 0.0254 / 16.0).abs() < 1e-9 {
        let (mut above, mut below) = (sixteenths as u64, 16u64);
        while above > 0 && above.is_multiple_of(2) && below > 1 {
            (above, below) = (above / 2, below / 2);
        }
        return if below == 1 { format!("{above} in") } else { format!("{above}/{below} in") };
    }
    format!("{} mm", millimetres(length))
}

/// Millimetres to three figures.
pub(super) fn millimetres(length: f64) -> String {
    let value = 1000.0 * length;
    let decimals = match value.abs() {
        v if v >= 99.95 => 0,
        v if v >= 9.995 => 1,
        v if v >= 0.0995 => 2,
        _ => 3,
    };
    fixed(value, decimals)
}

/// What moves of a table with that resolution and that noise are measured by \[m\], and what it is in words.
pub(super) fn limit(quantum: Option<f64>, sigma: f64, notation: Notation) -> (f64, String) {
    let limit = accuracy(quantum, sigma);
    let what = if limit > 2.0 * quantum.unwrap_or(0.0) { " (twice what is taken for noise)" } else { "" };
    (limit, format!("{}{what}", small(limit, notation)))
}

fn counted(n: usize, one: &str, many: &str) -> String {
    format!("{n} {}", if n == 1 { one } else { many })
}

/// "station 5, waterline 2.000 m".
pub(super) fn place(job: &FairJob, change: &Change) -> String {
    let station = job.table.stations.get(change.station).map_or_else(String::new, |station| station.station.words());
    format!("{station}, {}", change.origin.words(change.z))
}

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
            "  {id} {}: written {written}{metres} ({why}{read}); the fair hull has {} m",
            place(job, change),
            fixed(change.after, 4)
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

/// "; tolerances 1.20 to 22.0 mm" of what was not left out.
pub(super) fn tolerances(outcome: &Outcome) -> String {
    let all = outcome.changes.iter().filter(|change| !change.suspect).filter_map(|change| change.tolerance);
    let [least, most] = all.fold([f64::INFINITY, 0.0_f64], |[least, most], each| [least.min(each), most.max(each)]);
    if least < most * (1.0 - 1e-9) {
        format!("; tolerances {} to {} mm", millimetres(least), millimetres(most))
    } else if most > 0.0 {
        format!("; tolerance {} mm", millimetres(most))
    } else {
        String::new()
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

/// A constraint before and after, and what holding it costs.
fn held_line(held: &Held, length: Option<f64>, nearest: bool) -> String {
    let target = held.constraint.target();
    let (unit, decimals) = match held.constraint {
        Constraint::Displacement(_) | Constraint::Volume { .. } => (" m3", 3),
        Constraint::CentreOfBuoyancy(_)
        | Constraint::CentreOfFlotation(_)
        | Constraint::CentreOfVolume { .. }
        | Constraint::HeightOfBuoyancy(_)
        | Constraint::Metacentre { .. } => (" m", 4),
        Constraint::WaterplaneArea(_) | Constraint::SectionArea { .. } | Constraint::WettedSurface(_) => (" m2", 3),
        _ => ("", 6),
    };
    let percent = match (held.constraint, length) {
        (
            Constraint::CentreOfBuoyancy(_) | Constraint::CentreOfFlotation(_) | Constraint::CentreOfVolume { .. },
            Some(length),
        ) => {
            format!(" ({:+.3} % L)", 100.0 * (held.after / length - 0.5))
        }
        _ => String::new(),
    };
    let words = held.constraint.words();
    let missed = nearest && !held.is_had();
    let [low, high] = held.interval();
    let off = match held.missed() {
        _ if missed => {
            format!(
                "{} were asked for and are out of reach: this is the nearest found that leaves a fair hull",
                fixed(target, decimals) + unit
            )
        }
        off if held.band > 0.0 => {
            let place = if off.abs() > 0.0 { format!("{off:.0e}{unit} outside") } else { "within".to_owned() };
            // A band that nobody stated is that of the errors of the table.
            let why = if held.band > held.constraint.band() { ", two standard errors about the likeliest" } else { "" };
            format!("{place} {} to {}{why}", fixed(low, decimals), fixed(high, decimals) + unit)
        }
        off if off.abs() > 0.0 => format!("off target by {off:.0e}"),
        _ => "on target".to_owned(),
    };
    let price = priced(if missed { "what was reached" } else { "it" }, held.price);
    format!(
        "{words}: {} -> {}{unit}{percent}, {off}; {price}.",
        fixed(held.before, decimals),
        fixed(held.after, decimals),
    )
}

/// Monotone pieces and total variation of curvature on stations and waterlines, and the regions of the surface.
fn pieces(outcome: &Outcome) -> String {
    let [before, after] = outcome.monotone_pieces();
    let least = outcome.least_monotone_pieces().map_or(String::new(), |least| format!(" (least {least})"));
    let variation = outcome.variation().map_or(String::new(), |[before, after]| {
        format!(" total variation over its range, in the median of the lines, {before:.1} -> {after:.1};")
    });
    let [regions, regions_after] = outcome.regions;
    let line = format!(
        "Curvature of stations and waterlines: monotone pieces {before} -> {after}{least};{variation} regions of one sign of \
         Gaussian curvature {regions} -> {regions_after}. A bump counts from {} mm.",
        millimetres(outcome.resolution)
    );
    wrapped(&line, 2)
}

/// How many lines bend more often than the signs that they were asked for say; nothing where none does.
fn more_than_asked(outputs: &FairOutputs) -> String {
    let kinds = outputs.certificate["inflections"].as_object().into_iter().flatten();
    let lines = kinds.flat_map(|(_, lines)| lines.as_array().into_iter().flatten());
    let lines: Vec<_> = lines.filter(|line| more_than(line, "asked").is_some()).collect();
    let worse = lines.iter().filter(|line| more_than(line, "before").is_some()).count();
    match lines.len() {
        0 => String::new(),
        n => wrapped(
            &format!(
                "{} than was asked of {}, {} than before (asked and after in fairing.json): signs are asked for at places along a \
                 line, and what is held may leave it no room for them.",
                counted(n, "line bends more often", "lines bend more often"),
                if n == 1 { "it" } else { "them" },
                match worse {
                    0 => "none more often".to_owned(),
                    worse if worse == n => "more often".to_owned(),
                    worse => format!("{worse} of them more often"),
                }
            ),
            2,
        ),
    }
}

/// Displacement and LCB before and after, or volume and its centre where no draught is stated, with `arrow` between.
pub(super) fn change_of_form(outputs: &FairOutputs, arrow: &str) -> String {
    let length = outputs.outcome.after.particulars().length_between_perpendiculars;
    let moved = |a: f64, b: f64| fixed_sign(100.0 * (b - a) / length, 3, " % L");
    match &outputs.rows {
        Some([before, after]) => {
            let [a, b] = [before, after].map(|row| super::page::value(row, "DISPM"));
            let change = share(before.displacement_volume, after.displacement_volume);
            let lcb = before.lcb.zip(after.lcb).map_or(String::new(), |(a, b)| format!(", LCB {}", moved(a, b)));
            format!("Displacement {a} {arrow} {b} t{change}{lcb}")
        }
        None => {
            let (below, [volumes, centres]) = volumes(&outputs.outcome);
            let (change, [a, b]) = (share(volumes[0], volumes[1]), volumes.map(volume_of));
            let centre = moved(centres[0], centres[1]);
            format!("Volume below z = {below:.3} m {a} {arrow} {b} m3{change}, its centre {centre}")
        }
    }
}

/// Displacement, LCB, KB and C_M of both hulls.
fn hydrostatics(outputs: &FairOutputs, page: &mut String) {
    let length = outputs.outcome.after.particulars().length_between_perpendiculars;
    let from_midship = outputs.outcome.before.counts_from_aft_perpendicular().then_some(length);
    let mut line = change_of_form(outputs, "->") + ".";
    let turns = ["waterline", "station", "buttock", "diagonal"].map(|kind| outputs.outcome.inflections(kind));
    let sum = |side: usize| turns.iter().map(|counts| counts[side]).sum::<usize>();
    line.push_str(&format!(" Inflections {} -> {}:", sum(0), sum(1)));
    for (kind, [a, b]) in ["waterlines", "stations", "buttocks", "diagonals"].iter().zip(turns) {
        line.push_str(&format!(" {kind} {a} -> {b}{}", if *kind == "diagonals" { "." } else { "," }));
    }
    page.push_str(&wrapped(&line, 2));
    page.push_str("  (buttocks and diagonals are no lines of the table: they were never used)\n");
    page.push_str(&pieces(&outputs.outcome));
    page.push_str(&more_than_asked(outputs));
    page.push_str(&far_above_the_least(&outputs.outcome));
    let sum =
        |side: usize, count: fn(&PolygonSigns) -> usize| outputs.outcome.signs[side].iter().map(count).sum::<usize>();
    let line = format!(
        "Control polygon, signs + and -: {} -> {} changes, {} -> {} enclosed by two of the other (control-polygon.csv).",
        sum(0, |line| line.changes),
        sum(1, |line| line.changes),
        sum(0, |line| line.enclosed),
        sum(1, |line| line.enclosed)
    );
    page.push_str(&wrapped(&line, 2));
    if let Some(jump) = outputs.outcome.jump {
        let line = format!("Largest jump of curvature that fairing adds across lines of the net: {jump:.1e} 1/m.");
        page.push_str(&wrapped(&line, 2));
    }
    if outputs.outcome.held.is_empty() {
        page.push_str("Nothing of the whole hull is held.\n");
    }
    let areas = outputs.outcome.held.iter().filter(|held| matches!(held.constraint, Constraint::SectionArea { .. }));
    let areas: Vec<&Held> = areas.collect();
    let whole = areas.len() > MOST_AREAS;
    for held in &outputs.outcome.held {
        if !(whole && matches!(held.constraint, Constraint::SectionArea { .. })) {
            page.push_str(&wrapped(&held_line(held, from_midship, outputs.outcome.nearest), 2));
        }
    }
    if whole {
        let off = areas.iter().map(|held| held.missed().abs() / held.scale);
        let price = areas.iter().map(|held| held.price).fold(0.0, f64::max);
        let moved = areas.iter().map(|held| (held.after - held.before).abs()).fold(0.0, f64::max);
        let line = format!(
            "Section areas at {} places: off target by {:.0e} B T at most, changed by {moved:.3} m2 at most. Of the most expensive one, {} \
             (fairing.json).",
            areas.len(),
            off.fold(0.0, f64::max),
            priced("it", price)
        );
        page.push_str(&wrapped(&line, 2));
    }
    if outputs.outcome.targets_off(ON_TARGET) > 1 {
        let line = "The price of a target is the moves that the same program saves without it, the signs of its lines unchanged. A job \
                    without it may choose other signs.";
        page.push_str(&wrapped(line, 2));
    }
    for held in &outputs.outcome.rules {
        let words = held.rule.words() + &stays(&held.rule, &outputs.outcome);
        let binds = match held.binding {
            _ if held.given_up => "GIVEN UP, it is infeasible with the other targets".to_owned(),
            0 => "does not bind".to_owned(),
            n if n == held.rows => priced("it", held.price),
            n => format!("binds in {n} of {} rows; {}", held.rows, priced("it", held.price)),
        };
        page.push_str(&wrapped(&format!("{}{}: {binds}.", words[..1].to_uppercase(), &words[1..]), 2));
    }
    if let Some(errors) = &outputs.outcome.faired.settled {
        let last = errors.last().copied().unwrap_or(0.0);
        let steps = counted(errors.len() - 1, "step", "steps");
        let line = if last <= ON_TARGET {
            format!("Successive linearisation took {steps}: relative error {last:.0e}.")
        } else {
            format!("Successive linearisation STALLED after {steps}, {last:.0e} of its target away.")
        };
        page.push_str(&wrapped(&line, 2));
    }
}

/// A change in parts of what was before, ` (+0.012 %)`; nothing where there was nothing.
pub(super) fn share(before: f64, after: f64) -> String {
    if before.abs() > 0.0 {
        format!(" ({})", fixed_sign(100.0 * (after / before - 1.0), 3, " %"))
    } else {
        String::new()
    }
}

/// A volume \[m^3\] in as many decimals as a displacement volume has.
pub(super) fn volume_of(volume: f64) -> String {
    fixed(volume, Quantity::of("DISPVOL").map_or(1, |quantity| quantity.decimals_of(volume)))
}

/// The height \[m\] of [`Hull::reference_height`](crate::hull::Hull::reference_height) of the surface through the table,
/// and below it the volume \[m^3\] and its centre \[m\] before and after.
pub(super) fn volumes(outcome: &Outcome) -> (f64, [[f64; 2]; 2]) {
    let below = outcome.held_below().map_or_else(|| outcome.before.reference_height(), |(below, _)| below);
    let quantities = [Constraint::Volume { volume: 0.0, below }, Constraint::CentreOfVolume { x: 0.0, below }];
    (below, quantities.map(|quantity| [&outcome.before, &outcome.after].map(|hull| quantity.value(hull))))
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
        // Its own net takes the half-breadths of that surface for control values, which evens them out.
        if outcome.is_field {
            "of the likeliest field"
        } else if outcome.own {
            "of its net laid evenly through the surface before"
        } else {
            "before"
        },
        outcome.fairness,
        faired.lambda,
        end_of_search(faired.lambda, &faired.trials),
        faired.edf,
        counted(faired.programs, "program", "programs"),
        faired.iterations
    );
    page.push_str(&wrapped(&proof, 2));
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

/// The dimensions of a hull.
pub(super) fn dimensions(outcome: &Outcome) -> String {
    super::page::dimensions(outcome.after.particulars())
}

/// The dimensions that nobody stated.
pub(super) fn not_stated(job: &FairJob) -> Vec<&'static str> {
    let stated = &job.table.stated;
    let dimensions = [("Lpp", stated.length_between_perpendiculars), ("B", stated.breadth), ("D", stated.depth)];
    dimensions.iter().filter(|(_, value)| value.is_none()).map(|(name, _)| *name).collect()
}

/// What is held, and all figures, rest on dimensions that nobody stated: reported before all figures.
fn assumed(job: &FairJob, outcome: &Outcome) -> String {
    let names = not_stated(job);
    let mut text = if names.is_empty() {
        String::new()
    } else {
        wrapped(&format!("Not stated, so assumed (see the notes): {}.", names.join(", ")), 2)
    };
    text.push_str(&without_draught(outcome));
    if !outcome.before.counts_from_aft_perpendicular() {
        let line = match outcome.before.particulars().draught {
            Some(_) => {
                "x does not count from AP and no Lpp is stated: midship is not known, C_M is not held and LCB not related to it."
            }
            None => {
                "x does not count from AP and no Lpp is stated: midship is not known, and no centre is related to it."
            }
        };
        text.push_str(&wrapped(line, 2));
    }
    text
}

/// What to do where nobody stated a draught, and what is held in place of what is held at one; nothing where one is
/// stated.
fn without_draught(outcome: &Outcome) -> String {
    if outcome.before.particulars().draught.is_some() {
        return String::new();
    }
    let held = outcome.held_below().map(|(_, held)| wrapped(&format!("Held: {held}."), 2));
    wrapped(&no_draught(), 2) + &held.unwrap_or_default()
}

/// Inflections that a line keeps above its proved least from which the page names it, and how many lines it names.
const ABOVE: usize = 4;
const NAMED: usize = 4;

/// The lines that keep most inflections above their proved least, and how fewer can be asked for; nothing where none
/// keeps many.
fn far_above_the_least(outcome: &Outcome) -> String {
    let least = |turns: &Turns| turns.minimum.filter(|(_, proved)| *proved).map(|(least, _)| least);
    let above = |turns: &Turns| least(turns).map_or(0, |least| turns.after.saturating_sub(least));
    let mut lines: Vec<&Turns> = outcome.turns.iter().filter(|turns| above(turns) >= ABOVE).collect();
    if lines.is_empty() {
        return String::new();
    }
    let count = lines.len();
    lines.sort_by_key(|turns| std::cmp::Reverse(above(turns)));
    let name = |turns: &&Turns| {
        format!("{} {} (least {})", line_name(&turns.cut), turns.after, least(turns).unwrap_or_default())
    };
    let names: Vec<String> = lines.iter().take(NAMED).map(name).collect();
    let more = if count > NAMED { format!(", {} more", count - NAMED) } else { String::new() };
    let line = format!(
        "Lines that keep more inflections than necessary, since removing them would move offsets too far: {}{more}. \
         shape.inflections requires fewer at any cost.",
        names.join(", ")
    );
    wrapped(&line, 2)
}

/// A move that nobody sees [m].
const STAYS: f64 = 1e-6;

/// How many offsets of a flat that the table shows stay: it is held a cell inside of its outermost offsets.
fn stays(rule: &Rule, outcome: &Outcome) -> String {
    let Rule::FlatShown { half_breadth, .. } = rule else { return String::new() };
    let on_it = outcome.changes.iter().filter(|change| !change.suspect && (change.before - half_breadth).abs() < STAYS);
    let moves: Vec<f64> = on_it.map(|change| (change.after - change.before).abs()).collect();
    let edge: Vec<f64> = moves.iter().copied().filter(|size| *size > STAYS).collect();
    if edge.is_empty() {
        return String::new();
    }
    format!(
        ", of {} offsets at that half-breadth {} within it stay, {} at its edges move by {} mm at most",
        moves.len(),
        moves.len() - edge.len(),
        edge.len(),
        millimetres(edge.iter().copied().fold(0.0, f64::max))
    )
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
            let value = |key: &str| super::page::value(row, key);
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
