//! Words that the pages of `fair` share.

use super::job::FairJob;
use crate::fairing::change::Change;
use crate::fairing::outcome::Outcome;
use crate::fairing::record::accuracy;
use crate::fairing::surface::Origin;
use crate::hull::Cut;
use crate::report::words::lengths;
use crate::report::words::page::{fixed, no_draught, wrapped};
use crate::units::Notation;
use serde_json::Value;

/// A small length in the terms of the table: parts of an inch, or millimetres.
pub(in crate::report) fn small(length: f64, notation: Notation) -> String {
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
pub(in crate::report) fn millimetres(length: f64) -> String {
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
pub(in crate::report) fn limit(quantum: Option<f64>, sigma: f64, notation: Notation) -> (f64, String) {
    let limit = accuracy(quantum, sigma);
    let what = if limit > 2.0 * quantum.unwrap_or(0.0) { " (twice what is taken for noise)" } else { "" };
    (limit, format!("{}{what}", small(limit, notation)))
}

pub(in crate::report) fn counted(n: usize, one: &str, many: &str) -> String {
    format!("{n} {}", if n == 1 { one } else { many })
}

/// "station 5, waterline 2.000 m", in the notation of the table: "station 20 ft, waterline 6 ft (1.829 m)".
pub(in crate::report) fn place(job: &FairJob, change: &Change) -> String {
    let form = &job.table.form;
    let station = match job.table.stations.get(change.station) {
        None => String::new(),
        Some(station) if form.x_notation == Notation::Metres => station.station.words(),
        Some(_) => format!("station {}", lengths::station(&job.table, change.station)),
    };
    let line = match (change.origin, lengths::of_heights(form)) {
        (Origin::HalfBreadth { .. }, notation) if notation != Notation::Metres => {
            format!("waterline {}", lengths::place(notation, &form.waterline_heads, change.z))
        }
        (Origin::Point { point, .. }, notation) if notation != Notation::Metres => {
            format!("point {point} at {}", lengths::place(notation, &[], change.z))
        }
        _ => change.origin.words(change.z),
    };
    format!("{station}, {line}")
}

/// "; tolerances 1.20 to 22.0 mm" of what was not left out.
pub(in crate::report) fn tolerances(outcome: &Outcome) -> String {
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

/// The dimensions of a hull.
pub(in crate::report) fn dimensions(outcome: &Outcome) -> String {
    crate::report::words::page::dimensions(outcome.after.particulars())
}

/// What is given, from the table and assumed, the depth among it.
pub(in crate::report) fn sources(job: &FairJob) -> String {
    let mut sources = job.conventions.sources();
    if job.table.stated.depth.is_none() {
        sources.push_str(if sources.contains("assumed: ") { ", D" } else { "; assumed: D" });
    }
    format!("{}{}", sources[..1].to_uppercase(), &sources[1..])
}

/// What is held, and all figures, rest on dimensions that nobody stated: reported before all figures.
pub(in crate::report) fn assumed(job: &FairJob, outcome: &Outcome) -> String {
    let mut text = wrapped(&format!("{}.", sources(job)), 2);
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
pub(in crate::report) fn without_draught(outcome: &Outcome) -> String {
    if outcome.before.particulars().draught.is_some() {
        return String::new();
    }
    let held = outcome.held_below().map(|(_, held)| wrapped(&format!("Held: {held}."), 2));
    wrapped(&no_draught(), 2) + &held.unwrap_or_default()
}

/// "waterline 2.000 m".
pub(in crate::report) fn line_name(cut: &Cut) -> String {
    match cut {
        Cut::Station { x } => format!("station at x = {x:.3} m"),
        Cut::Waterline { z } => format!("waterline {z:.3} m"),
        Cut::Buttock { y } => format!("buttock {y:.3} m"),
        Cut::Diagonal { .. } | Cut::Plane { .. } => "a diagonal".to_owned(),
    }
}

/// The least number of changes of sign, and whether it is proved on every line.
pub(in crate::report) fn least(outcome: &Outcome) -> String {
    let Some(least) = outcome.least_changes_of_sign() else { return String::new() };
    let proved = outcome.turns.iter().filter_map(|turns| turns.minimum).all(|(_, proved)| proved);
    format!(" (least {least}{})", if proved { "" } else { ", not proved" })
}

/// How often a line of `fairing.json` bends after, and the number that it is compared with (`before`, `asked`), where
/// it bends more often than that.
pub(in crate::report) fn more_than(line: &Value, than: &str) -> Option<[u64; 2]> {
    let (after, most) = line["after"].as_u64().zip(line[than].as_u64())?;
    (after > most).then_some([after, most])
}
