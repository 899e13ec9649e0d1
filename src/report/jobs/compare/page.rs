//! The pages of `compare`: for the terminal, and as Markdown.

use std::fmt::Write as _;

use super::hulls::{CompareOutputs, ComparedHull};
use crate::exchange::{ComparedValue, per_cent};
use crate::hull::SurfaceDistance;
use crate::hydrostatics::{Hydrostatics, Quantity};
use crate::report::words::page::{conventions_line, fixed, signed, wrapped};

/// Quantities of the table over draughts.
const COLUMNS: [&str; 8] = ["DISPVOL", "AWL", "CB", "CM", "CWP", "KB", "KMT", "S"];

/// A value with the decimals of its quantity; `-` where it is not defined.
fn shown(value: &ComparedValue, which: usize) -> String {
    value.values[which].map_or("-".to_owned(), |v| fixed(v, value.decimals))
}

fn unit(value: &ComparedValue) -> &'static str {
    if value.unit == "-" { "" } else { value.unit }
}

/// A change with its unit: per cent, of centres per cent of L_PP.
fn change(value: &ComparedValue) -> String {
    let of_length = ["XCB", "XWL", "XCBPC"].contains(&value.key);
    let word = if of_length { " % Lpp" } else { " %" };
    value.change.map_or("-".to_owned(), |change| format!("{}{word}", signed(change, 2)))
}

/// Changes of the quantities of a row, in per cent, each with two decimals.
fn changes([a, b]: &[Hydrostatics; 2]) -> Vec<String> {
    let of = |key: &str| Quantity::of(key).and_then(|quantity| per_cent([(quantity.value)(a), (quantity.value)(b)]));
    COLUMNS.iter().map(|key| of(key).map_or("-".to_owned(), |change| signed(change, 2))).collect()
}

/// A hull by its role and its name.
fn named(outputs: &CompareOutputs, which: usize) -> String {
    format!("{} ({})", outputs.hulls[which].name, outputs.roles[which])
}

/// What the distances are, one sentence a direction.
fn distances(outputs: &CompareOutputs) -> Vec<String> {
    let of = |distance: &Option<SurfaceDistance>, from: usize, hull: &ComparedHull| {
        let d = (*distance)?;
        let [x, y, z] = d.at;
        let side = if d.outside { "outside" } else { "inside" };
        let part = 100.0 * d.largest / hull.particulars.breadth;
        Some(format!(
            "Side of the {} from the {}: largest {:.4} m ({part:.2} % of B), {side}, at x {x:.2} y {y:.2} z {z:.2}; RMS {:.4} m, mean {:.4} m.",
            outputs.roles[from],
            outputs.roles[1 - from],
            d.largest,
            d.rms,
            d.mean
        ))
    };
    let [ahead, back] = &outputs.distances;
    [of(ahead, 1, &outputs.hulls[0]), of(back, 0, &outputs.hulls[0])].into_iter().flatten().collect()
}

/// The page of a comparison for the terminal: at most 80 columns.
#[must_use]
pub fn compare_page(outputs: &CompareOutputs) -> String {
    let mut page = wrapped(&format!("{} and {}, {}", named(outputs, 0), named(outputs, 1), outputs.draughts()), 2);
    page.push('\n');
    let _ = writeln!(page, "{:<10}{:>16}{:>16} {:<6}{:>16}", "", outputs.roles[0], outputs.roles[1], "", "change");
    for value in outputs.values.iter().filter(|value| value.values.iter().any(Option::is_some)) {
        let [first, second] = [0, 1].map(|which| shown(value, which));
        let _ = writeln!(page, "{:<10}{first:>16}{second:>16} {:<6}{:>16}", value.key, unit(value), change(value));
    }
    page.push('\n');
    page.push_str(&wrapped("Changes of hydrostatics at common draughts, per cent of the first:", 2));
    let cells = |first: &str, cells: &[String]| {
        let cells: String = cells.iter().map(|cell| format!("{cell:>9}")).collect();
        format!("{first:>8}{cells}\n")
    };
    page.push_str(&cells("T [m]", &COLUMNS.map(str::to_owned)));
    for row in &outputs.rows {
        page.push_str(&cells(&fixed(row[0].draught, 3), &changes(row)));
    }
    page.push('\n');
    distances(outputs).iter().for_each(|line| page.push_str(&wrapped(line, 2)));
    page.push_str(&wrapped(&conventions_line(&outputs.conventions), 2));
    page
}

/// The page of a comparison as Markdown, with its figures by their names.
pub(in crate::report) fn compare_markdown(outputs: &CompareOutputs, figures: &[&str]) -> String {
    let mut page = format!("# {} and {}\n\n", named(outputs, 0), named(outputs, 1));
    let _ = writeln!(
        page,
        "Compared {}. Changes are per cent of the first; those of centres are per cent of L_PP.\n",
        outputs.draughts()
    );
    let _ = writeln!(
        page,
        "| key | quantity | unit | {} | {} | change |\n|---|---|---|---:|---:|---:|",
        outputs.roles[0], outputs.roles[1]
    );
    for value in outputs.values.iter().filter(|value| value.values.iter().any(Option::is_some)) {
        let cells = [value.key, value.name, value.unit, &shown(value, 0), &shown(value, 1), &change(value)].join(" | ");
        let _ = writeln!(page, "| {cells} |");
    }
    page.push_str("\n## Distances of the surfaces\n\n");
    distances(outputs).iter().for_each(|line| page.push_str(&format!("* {line}\n")));
    page.push_str("\n## Hydrostatics at common draughts\n\nChanges in per cent.\n\n");
    let _ = writeln!(page, "| T [m] | {} |\n|{}", COLUMNS.join(" | "), "---:|".repeat(COLUMNS.len() + 1));
    for row in &outputs.rows {
        let _ = writeln!(page, "| {} | {} |", fixed(row[0].draught, 3), changes(row).join(" | "));
    }
    for name in figures {
        let _ = write!(page, "\n![{}]({name}.png)\n", name.replace('-', " "));
    }
    let _ = write!(page, "\n{}", conventions_line(&outputs.conventions));
    page.push('\n');
    page
}
