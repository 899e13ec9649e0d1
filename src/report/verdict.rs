//! What a fairing came to, in sentences.

use super::page::fixed;
use super::result::JobResult;
use super::result_page::{list, text};
use crate::hydrostatics::{Conventions, Hydrostatics};

/// Curves whose inflections are counted, as files name them.
const KINDS: [&str; 4] = ["waterlines", "stations", "buttocks", "diagonals"];

/// Displacement and LCB at the design draught before and after.
fn displacement(before: &Hydrostatics, after: &Hydrostatics, conventions: &Conventions) -> String {
    let share = 100.0 * (after.displacement_mass / before.displacement_mass - 1.0);
    let lcb = |row: &Hydrostatics| row.lcb.map_or("-".to_owned(), |x| fixed(x, 3));
    let moved = after.lcb.zip(before.lcb).map_or(String::new(), |(a, b)| format!(" ({:+.3} m)", a - b));
    format!(
        "At T {} m{}: displacement {} → {} t ({share:+.3} %), LCB {} → {} m from AP{moved}.",
        fixed(after.draught, 3),
        conventions.draught_mark(),
        fixed(before.displacement_mass, 1),
        fixed(after.displacement_mass, 1),
        lcb(before),
        lcb(after)
    )
}

/// What the fairing came to, in sentences.
pub(super) fn verdict(result: &JobResult, conditions: [Option<&Hydrostatics>; 2]) -> Vec<(bool, String)> {
    let Some((record, fairing)) = &result.fairing else { return Vec::new() };
    let (rms, largest, _) = record.moves();
    let left_out = record.changes.iter().filter(|change| change.suspect).count();
    let mut lines = vec![match fairing["status"].as_str() {
        Some("optimal") => (
            false,
            "All targets, tolerances and locks are held; of all nets that do so this one is proved to be the best."
                .to_owned(),
        ),
        Some(word) => (true, format!("Status {word}: not all wishes are held. What is shown is a compromise.")),
        None => (true, "The status is not known.".to_owned()),
    }];
    lines.push((
        false,
        format!(
            "{} offsets moved {} mm RMS and {} mm at most; the noise of the table is {} mm. {left_out} left out as suspects.",
            record.changes.len(),
            fixed(1e3 * rms, 2),
            fixed(1e3 * largest, 2),
            fixed(1e3 * record.sigma, 2)
        ),
    ));
    if let [Some(before), Some(after)] = conditions {
        lines.push((false, displacement(before, after, &result.conventions)));
    }
    let sum = |key: &str, when: &str| list(&fairing["inflections"][key]).filter_map(|l| l[when].as_u64()).sum::<u64>();
    let counts: Vec<String> =
        KINDS.iter().map(|key| format!("{key} {} → {}", sum(key, "before"), sum(key, "after"))).collect();
    lines.push((false, format!("Inflections before → after: {}.", counts.join(", "))));
    let all = || KINDS.iter().flat_map(|key| list(&fairing["inflections"][key]));
    let more_than = |than: &str| {
        all()
            .filter(|line| line["after"].as_u64().zip(line[than].as_u64()).is_some_and(|(after, most)| after > most))
            .count()
    };
    let (worse, beyond) = (more_than("before"), more_than("allowed"));
    if worse > 0 {
        lines.push((true, format!("{worse} lines bend more often after than before.")));
    }
    if beyond > 0 {
        let text = "lines bend more often than was asked of them, between the places where their signs were imposed or within the dead band \
                    about no curvature: compare the columns after and allowed.";
        lines.push((true, format!("{beyond} {text}")));
    }
    let prices: Vec<String> = list(&fairing["constraints"]).map(|held| text(&held["words"])).collect();
    if !prices.is_empty() {
        lines.push((false, format!("Prices: {}.", prices.join("; "))));
    }
    lines
}
