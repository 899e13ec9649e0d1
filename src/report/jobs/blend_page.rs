//! The page of `blend`: the hulls with their weights, what was wanted and what the blend has, and the blend beside a hull.

use std::fmt::Write as _;

use super::blend::BlendOutputs;
use super::compare::page::compare_page;
use super::derive_page::decimals;
use crate::exchange::BlendPart;
use crate::report::words::page::{dimensions, fixed, wrapped};

/// Most characters of a name in a column.
const NAME: usize = 32;

fn shortened(name: &str) -> String {
    if name.chars().count() <= NAME { name.to_owned() } else { name.chars().take(NAME - 1).chain(['~']).collect() }
}

fn hulls(page: &mut String, outputs: &BlendOutputs) {
    let _ = writeln!(page, "{:<34}{:>10}{:>14}{:>14}", "", "weight", "to chart mm", "inflections");
    for BlendPart { name, weight, moved, inflections, .. } in &outputs.parts {
        let (name, moved) = (shortened(name), fixed(1e3 * moved, 2));
        let _ = writeln!(page, "{name:<34}{:>10}{moved:>14}{inflections:>14}", fixed(*weight, 6));
    }
    let _ = writeln!(page, "{:<34}{:>10}{:>14}{:>14}", "blend", "", "", outputs.blend.inflections);
    page.push('\n');
}

fn targets(page: &mut String, outputs: &BlendOutputs) {
    if outputs.targets.is_empty() {
        return;
    }
    let columns = ["", "hulls from", "to", "requested", "achieved", "error"];
    let [key, low, high, requested, achieved, error] = columns;
    let _ = writeln!(page, "{key:<8}{low:>13}{high:>13}{requested:>13}{achieved:>13}{error:>10}");
    for (k, target) in outputs.targets.iter().enumerate() {
        let write = |value: f64| fixed(value, decimals(target));
        let values = outputs.parts.iter().map(|part| part.values[k]);
        let [low, high] = values.fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], v| [a.min(v), b.max(v)]);
        let error = (target.achieved - target.requested) / target.requested.abs().max(1e-300);
        let (low, high, requested, achieved) =
            (write(low), write(high), write(target.requested), write(target.achieved));
        let error = format!("{error:.0e}");
        let _ = writeln!(page, "{:<8}{low:>13}{high:>13}{requested:>13}{achieved:>13}{error:>10}", target.key);
    }
    for target in &outputs.targets {
        let Some([low, high]) = target.interval else { continue };
        let write = |value: f64| fixed(value, decimals(target));
        let line = format!("{} can be {} to {} with the others as they are.", target.key, write(low), write(high));
        page.push_str(&wrapped(&line, 2));
    }
    page.push('\n');
}

/// The page, at most 80 columns.
#[must_use]
pub fn blend_page(outputs: &BlendOutputs) -> String {
    let mut page = wrapped(&outputs.outputs.summary.name, 2);
    page.push_str(&dimensions(outputs.blend.hull.particulars()));
    page.push('\n');
    hulls(&mut page, outputs);
    targets(&mut page, outputs);
    let base = &outputs.parts[outputs.blend.base].name;
    let chart = if outputs.blend.is_linear {
        "Their profiles are the same below T: volume, moments and areas are linear in the weights."
    } else {
        "Their profiles differ, and are blended with the same weights."
    };
    page.push_str(&wrapped(&format!("All hulls stand on the chart of {base}. {chart}"), 2));
    if !outputs.free.is_empty() {
        let line = format!("Free for the targets: {}.", outputs.free.join(", "));
        page.push_str(&wrapped(&line, 2));
    }
    page.push('\n');
    page.push_str(&compare_page(&outputs.comparison));
    page
}
