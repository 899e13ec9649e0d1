//! The page of `resistance`: inputs with their origin, the table, the limits of the method.

use std::fmt::Write as _;

use super::resistance::ResistanceOutputs;
use crate::report::words::page::{fixed, wrapped};
use crate::resistance::{Components, PredictionRow, limits, power};
use crate::units::KNOT;

type Column = (&'static str, &'static str, usize, fn(&Components) -> f64);

/// The first block of the table.
const SUMMARY: [Column; 7] = [
    ("V", "kn", 2, |c| c.speed / KNOT),
    ("Fn", "-", 4, |c| c.froude),
    ("Rn", "1e6", 2, |c| 1e-6 * c.reynolds),
    ("CF", "1e-3", 4, |c| 1e3 * c.friction_coefficient),
    ("1+k1", "-", 4, |c| c.form_factor),
    ("RT", "kN", 2, |c| 1e-3 * c.total()),
    ("PE", "kW", 1, |c| 1e-3 * c.effective_power()),
];

/// The second block: the parts of the total.
const PARTS: [Column; 8] = [
    ("V", "kn", 2, |c| c.speed / KNOT),
    ("RF", "kN", 2, |c| 1e-3 * c.friction),
    ("RF(1+k1)", "kN", 2, |c| 1e-3 * c.friction * c.form_factor),
    ("RAPP", "kN", 2, |c| 1e-3 * c.appendages),
    ("RW", "kN", 2, |c| 1e-3 * c.wave),
    ("RB", "kN", 2, |c| 1e-3 * c.bulb),
    ("RTR", "kN", 2, |c| 1e-3 * c.transom),
    ("RA", "kN", 2, |c| 1e-3 * c.allowance),
];

/// Decimals that leave about five figures of the largest value of a column, at most `decimals` more than are usual.
fn decimals(column: &Column, rows: &[PredictionRow]) -> usize {
    let (_, unit, usual, of) = *column;
    let largest = rows.iter().map(|row| of(&row.components).abs()).fold(0.0, f64::max);
    let small = matches!(unit, "kN" | "kW") && largest > 0.0 && largest < 1.0;
    if small { usual + 3 } else { usual }
}

/// The page.
#[must_use]
pub fn resistance_page(outputs: &ResistanceOutputs) -> String {
    let mut page = format!("{}: resistance in calm water, {}\n", outputs.name, outputs.method.as_str());
    page.push_str(&wrapped(&format!("Source: {}.", outputs.method.source()), 2));
    page.push('\n');
    for input in &outputs.inputs {
        let value = fixed(input.value, input.decimals);
        let note = if input.note.is_empty() { String::new() } else { format!(" ({})", input.note) };
        let unit = if input.unit == "-" { "" } else { input.unit };
        let line = format!("{:<8}{value:>12} {unit:<10}{}; {}{note}", input.symbol, input.origin.as_str(), input.name);
        page.push_str(&wrapped_line(&line));
    }
    page.push('\n');
    summary(&mut page, outputs);
    page.push('\n');
    block(&mut page, &PARTS, &outputs.rows, |_| String::new(), ["", ""]);
    page.push('\n');
    page.push_str(&wrapped(limits(outputs.method), 2));
    page
}

/// A line of the list of inputs; blanks between its columns stay.
fn wrapped_line(line: &str) -> String {
    format!("{}\n", line.trim_end())
}

fn summary(page: &mut String, outputs: &ResistanceOutputs) {
    let delivered = |row: &PredictionRow| {
        let value = outputs.efficiency.map(|efficiency| 1e-3 * power(row.components.effective_power(), efficiency));
        value.map_or(String::new(), |value| format!("{:>10}", fixed(value, 1)))
    };
    let last = |row: &PredictionRow| {
        let symbols: Vec<&str> = row.outside.iter().map(|range| range.symbol).collect();
        let outside = if symbols.is_empty() { String::new() } else { format!("  outside: {}", symbols.join(", ")) };
        delivered(row) + &outside
    };
    let heads = if outputs.efficiency.is_some() { ["        PD", "        kW"] } else { ["", ""] };
    block(page, &SUMMARY, &outputs.rows, last, heads);
}

fn block(
    page: &mut String,
    columns: &[Column],
    rows: &[PredictionRow],
    last: impl Fn(&PredictionRow) -> String,
    heads: [&str; 2],
) {
    let head = |of: fn(&Column) -> &'static str, last: &str| {
        let cells: String = columns.iter().map(|column| format!("{:>9}", of(column))).collect();
        format!("{}\n", (cells + last).trim_end())
    };
    page.push_str(&head(|column| column.0, heads[0]));
    page.push_str(&head(|column| column.1, heads[1]));
    let places: Vec<usize> = columns.iter().map(|column| decimals(column, rows)).collect();
    for row in rows {
        for (column, &places) in columns.iter().zip(&places) {
            let _ = write!(page, "{:>9}", fixed((column.3)(&row.components), places));
        }
        let _ = writeln!(page, "{}", last(row));
    }
}
