//! What a fairing came to, in sentences.

pub(in crate::report) use crate::report::jobs::fair::words::more_than;
pub(in crate::report) use crate::report::words::remarks::is_warning;

use serde_json::Value;

use super::cells::{figures, list, text};
use crate::fairing::change::Change;
use crate::fairing::record::FairRecord;
use crate::hydrostatics::Hydrostatics;
use crate::report::input::result::JobResult;
use crate::report::jobs::fair::words::{limit, millimetres};
use crate::report::words::page::{fixed, fixed_sign};
use crate::units::{Notation, counted};

/// Curves whose inflections are counted, as files name them.
const KINDS: [&str; 4] = ["waterlines", "stations", "buttocks", "diagonals"];

/// Most lines that are named.
const NAMED: usize = 6;

/// Displacement and LCB at the design draught before and after.
fn displacement(before: &Hydrostatics, after: &Hydrostatics) -> String {
    let share = 100.0 * (after.displacement_mass / before.displacement_mass - 1.0);
    let lcb = |row: &Hydrostatics| row.lcb.map_or("-".to_owned(), |x| fixed(x, 3));
    let moved = after.lcb.zip(before.lcb).map_or(String::new(), |(a, b)| format!(" ({})", fixed_sign(a - b, 3, " m")));
    format!(
        "At T {} m: displacement {} → {} t ({}), LCB {} → {} m from AP{moved}.",
        fixed(after.draught, 3),
        fixed(before.displacement_mass, 1),
        fixed(after.displacement_mass, 1),
        fixed_sign(share, 3, " %"),
        lcb(before),
        lcb(after)
    )
}

/// What moves of a table are measured by \[m\], and what it is in words; those of tables in eighths of an inch say it in
/// eighths.
pub(in crate::report) fn accuracy_words(record: &FairRecord) -> (f64, String) {
    let notation = record.lines.notation;
    let (limit, words) = limit(record.lines.quantum, record.sigma, notation);
    match words.split_once(" mm") {
        Some((_, rest)) if notation == Notation::FeetInchesEighths => {
            (limit, format!("{}{rest}", notation.small(limit)))
        }
        _ => (limit, words),
    }
}

/// A small length in the terms of the table, in millimetres to three figures.
fn small(length: f64, notation: Notation) -> String {
    match notation {
        Notation::FeetInchesEighths => notation.small(length),
        _ => format!("{} mm", millimetres(length)),
    }
}

/// How many offsets stayed within the accuracy of the table, and how far they moved.
fn kept(record: &FairRecord) -> String {
    let (limit, shown) = accuracy_words(record);
    let left_out = record.changes.iter().filter(|change| change.suspect).count();
    let moved = |change: &&Change| !change.suspect && (change.after - change.before).abs() > limit * (1.0 + 1e-9);
    let more = record.changes.iter().filter(moved).count();
    let mut line = format!(
        "{} of {} kept within {shown}",
        record.changes.len() - left_out - more,
        counted(record.changes.len(), "offset")
    );
    if more > 0 {
        line.push_str(&format!("; {more} moved more (shaded in the table of faired offsets)"));
    }
    line.push_str(&match left_out {
        0 => "; no suspected typing error is left out".to_owned(),
        n => format!("; {} left out", counted(n, "suspected typing error")),
    });
    let (rms, largest, _) = record.moves();
    let notation = record.lines.notation;
    let [rms, largest, noise] = [rms, largest, record.sigma].map(|length| small(length, notation));
    line.push_str(&format!(". Moves: {rms} RMS, {largest} at most; taken for noise {noise}."));
    line
}

/// The tolerances that were used, from the least to the greatest, and how many offsets stop at theirs.
fn tolerances(record: &FairRecord) -> String {
    let open = || record.changes.iter().filter(|change| !change.locked && !change.suspect);
    let all = || open().filter_map(|change| change.tolerance);
    let [least, most] = all().fold([f64::INFINITY, 0.0], |[a, b]: [f64; 2], t| [a.min(t), b.max(t)]);
    if most <= 0.0 {
        return "no tolerances".to_owned();
    }
    let at_limit = |change: &&Change| {
        change.tolerance.is_some_and(|t| t > 0.0 && (change.after - change.before).abs() >= 0.999 * t)
    };
    let stopped = match open().filter(at_limit).count() {
        0 => "at which no offset stops".to_owned(),
        1 => "1 offset stops at its own".to_owned(),
        n => format!("{n} offsets stop at theirs"),
    };
    let small = |t: f64| small(t, record.lines.notation);
    if most - least <= 1e-9 {
        format!("tolerance of every offset {}, {stopped}", small(most))
    } else {
        format!("tolerances from {} to {}, {stopped}", small(least), small(most))
    }
}

/// What the run was made with.
fn settings(result: &JobResult, record: &FairRecord, fairing: &Value) -> String {
    let locked = record.changes.iter().filter(|change| change.locked).count();
    let order = fairing["energy"]["order"].as_u64().map_or(String::new(), |order| format!(", energy of order {order}"));
    let from = result.origin.as_ref().map_or(String::new(), |origin| {
        let digits: String = origin.sha256.chars().take(8).collect();
        format!(" Made from {} (sha256 {digits}); nothing is random, so that there is no seed.", origin.file)
    });
    format!(
        "Settings: {}; {} locked; smoothing weight {}, {:.1} degrees of freedom{order}.{from}",
        tolerances(record),
        match locked {
            0 => "no offset is".to_owned(),
            1 => "1 offset is".to_owned(),
            n => format!("{n} offsets are"),
        },
        figures(&record.lambda.into(), 3),
        record.edf
    )
}

/// The lines that bend more often after fairing than `than` says, with the numbers of their inflections.
fn more_often(fairing: &Value, than: &str) -> Vec<String> {
    let one = |key: &str, line: &Value| {
        let [after, most] = more_than(line, than)?;
        let at = fixed(line["at"].as_f64()?, 3);
        Some(format!("{} {at} m ({after} for {most})", key.trim_end_matches('s')))
    };
    KINDS.iter().flat_map(|key| list(&fairing["inflections"][key]).filter_map(move |line| one(key, line))).collect()
}

/// How fair stations and waterlines are together, and the surface; none in files of old programs.
fn fair(counts: &Value) -> Option<String> {
    let pair = |key: &str| Some(format!("{} → {}", counts[key]["before"].as_u64()?, counts[key]["after"].as_u64()?));
    let least = |key: &str| counts[key]["least"].as_u64().map_or(String::new(), |least| format!(" (least {least})"));
    let variation = match ["before", "after"].map(|when| counts["variation"][when].as_f64()) {
        [Some(before), Some(after)] => {
            format!(", total variation of it over its range {} → {} in the median", fixed(before, 1), fixed(after, 1))
        }
        _ => String::new(),
    };
    let [signs, pieces] = ["changes_of_sign", "monotone_pieces"];
    Some(format!(
        "Curvature of stations and waterlines: changes of sign {}{}, monotone pieces {}{}{variation}; regions of one sign of \
         Gaussian curvature {}.",
        pair(signs)?,
        least(signs),
        pair(pieces)?,
        least(pieces),
        pair("gaussian_regions")?
    ))
}

/// What the fairing came to, in sentences.
pub(in crate::report) fn verdict(result: &JobResult, conditions: [Option<&Hydrostatics>; 2]) -> Vec<(bool, String)> {
    let Some((record, fairing)) = &result.fairing else { return Vec::new() };
    let mut lines = vec![match fairing["status"].as_str() {
        Some("optimal") => (
            false,
            "All targets, tolerances and locks are held; no net that does so has less energy of curvature and departure \
             together, which is proved."
                .to_owned(),
        ),
        Some(word) => (true, format!("Status {word}: not all targets are met. What is shown is a compromise.")),
        None => (true, "The status is not known.".to_owned()),
    }];
    lines.extend(
        list(&fairing["notes"])
            .map(text)
            .filter(|note| is_warning(note))
            .map(|note| (true, note.replace("station_spacing", "spacing of stations"))),
    );
    lines.push((false, kept(record)));
    lines.push((false, settings(result, record, fairing)));
    if let [Some(before), Some(after)] = conditions {
        lines.push((false, displacement(before, after)));
    }
    if let Some(held) = fairing["held_below"]["words"].as_str() {
        lines.push((false, format!("Held: {held}.")));
    }
    if let Some(share) = fairing["rounding"]["volume_share"].as_f64() {
        lines.push((
            false,
            format!(
                "The table as it is written is rounded by {} mm at most, which is {} of {}.",
                fixed(1e3 * fairing["rounding"]["largest"].as_f64().unwrap_or(0.0), 2),
                fixed_sign(100.0 * share, 4, " %"),
                if result.hull.particulars().draught.is_some() { "displacement" } else { "the volume" }
            ),
        ));
    }
    let sum = |key: &str, when: &str| list(&fairing["inflections"][key]).filter_map(|l| l[when].as_u64()).sum::<u64>();
    let counts: Vec<String> =
        KINDS.iter().map(|key| format!("{key} {} → {}", sum(key, "before"), sum(key, "after"))).collect();
    lines.push((false, format!("Inflections before → after: {}.", counts.join(", "))));
    lines.extend(fair(&fairing["fair"]).map(|line| (false, line)));
    for (than, words) in [("before", "after than before"), ("asked", "than was asked of them")] {
        let lines_there = more_often(fairing, than);
        if !lines_there.is_empty() {
            let more = lines_there.len().saturating_sub(NAMED);
            let and = if more > 0 { format!(" and {more} more") } else { String::new() };
            let named = lines_there[..lines_there.len() - more].join(", ");
            let count = lines_there.len();
            let (noun, verb) = if count == 1 { ("line", "bends") } else { ("lines", "bend") };
            lines.push((true, format!("{count} {noun} {verb} more often {words}: {named}{and}.")));
        }
    }
    if !more_often(fairing, "asked").is_empty() {
        let text = "Such bends lie between the places where the signs of the line were imposed, or within the dead band about no curvature; \
                    the table of inflections has every line.";
        lines.push((false, text.to_owned()));
    }
    let prices: Vec<String> = list(&fairing["constraints"]).map(|held| text(&held["words"])).collect();
    if !prices.is_empty() {
        lines.push((false, format!("Prices: {}.", prices.join("; "))));
    }
    lines
}
