//! What a fairing came to, in sentences.

use serde_json::Value;

use super::page::{fixed, fixed_sign};
use super::result::JobResult;
use super::result_page::{list, text};
use crate::hydrostatics::{Conventions, Hydrostatics};
use crate::units::counted;

/// Curves whose inflections are counted, as files name them.
const KINDS: [&str; 4] = ["waterlines", "stations", "buttocks", "diagonals"];

/// Most lines that are named.
const NAMED: usize = 6;

/// Displacement and LCB at the design draught before and after.
fn displacement(before: &Hydrostatics, after: &Hydrostatics, conventions: &Conventions) -> String {
    let share = 100.0 * (after.displacement_mass / before.displacement_mass - 1.0);
    let lcb = |row: &Hydrostatics| row.lcb.map_or("-".to_owned(), |x| fixed(x, 3));
    let moved = after.lcb.zip(before.lcb).map_or(String::new(), |(a, b)| format!(" ({})", fixed_sign(a - b, 3, " m")));
    format!(
        "At T {} m{}: displacement {} → {} t ({}), LCB {} → {} m from AP{moved}.",
        fixed(after.draught, 3),
        conventions.draught_mark(),
        fixed(before.displacement_mass, 1),
        fixed(after.displacement_mass, 1),
        fixed_sign(share, 3, " %"),
        lcb(before),
        lcb(after)
    )
}

/// The lines that bend more often after fairing than `than` says, with the numbers of their inflections.
fn more_often(fairing: &Value, than: &str) -> Vec<String> {
    let one = |key: &str, line: &Value| {
        let (after, most) = line["after"].as_u64().zip(line[than].as_u64())?;
        let at = fixed(line["at"].as_f64()?, 3);
        (after > most).then(|| format!("{} {at} m ({after} for {most})", key.trim_end_matches('s')))
    };
    KINDS.iter().flat_map(|key| list(&fairing["inflections"][key]).filter_map(move |line| one(key, line))).collect()
}

/// Whether a note of what was assumed is a warning of the reader, `W320 ...`: it may change what all numbers mean.
pub(super) fn is_warning(note: &str) -> bool {
    let digits = note.strip_prefix('W').unwrap_or_default();
    digits.len() > 3 && digits.as_bytes()[..3].iter().all(u8::is_ascii_digit)
}

/// What the fairing came to, in sentences.
pub(super) fn verdict(result: &JobResult, conditions: [Option<&Hydrostatics>; 2]) -> Vec<(bool, String)> {
    let Some((record, fairing)) = &result.fairing else { return Vec::new() };
    let (rms, largest, _) = record.moves();
    let left_out = record.changes.iter().filter(|change| change.suspect).count();
    let mut lines = vec![match fairing["status"].as_str() {
        Some("optimal") => (
            false,
            "All targets, tolerances and locks are held; no net that does so has less energy of curvature and departure \
             together, which is proved."
                .to_owned(),
        ),
        Some(word) => (true, format!("Status {word}: not all wishes are held. What is shown is a compromise.")),
        None => (true, "The status is not known.".to_owned()),
    }];
    lines.extend(
        list(&fairing["notes"])
            .map(text)
            .filter(|note| is_warning(note))
            .map(|note| (true, note.replace("station_spacing", "spacing of stations"))),
    );
    lines.push((
        false,
        format!(
            "{} moved {} mm RMS and {} mm at most; the assumed noise is {} mm. {left_out} left out as suspects.",
            counted(record.changes.len() - left_out, "offset"),
            fixed(1e3 * rms, 2),
            fixed(1e3 * largest, 2),
            fixed(1e3 * record.sigma, 2)
        ),
    ));
    if let [Some(before), Some(after)] = conditions {
        lines.push((false, displacement(before, after, &result.conventions)));
    }
    if let Some(share) = fairing["rounding"]["volume_share"].as_f64() {
        lines.push((
            false,
            format!(
                "The table as it is written is rounded by {} mm at most, which is {} of displacement.",
                fixed(1e3 * fairing["rounding"]["largest"].as_f64().unwrap_or(0.0), 2),
                fixed_sign(100.0 * share, 4, " %")
            ),
        ));
    }
    let sum = |key: &str, when: &str| list(&fairing["inflections"][key]).filter_map(|l| l[when].as_u64()).sum::<u64>();
    let counts: Vec<String> =
        KINDS.iter().map(|key| format!("{key} {} → {}", sum(key, "before"), sum(key, "after"))).collect();
    lines.push((false, format!("Inflections before → after: {}.", counts.join(", "))));
    for (than, words) in [("before", "after than before"), ("allowed", "than was asked of them")] {
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
    if !more_often(fairing, "allowed").is_empty() {
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
