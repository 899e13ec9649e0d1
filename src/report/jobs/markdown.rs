//! The page about a hull: what was asked, what it is, its figures, and published figures beside its own.

use std::fmt::Write as _;

use super::outputs::Outputs;
use crate::config::Reference;
use crate::hydrostatics::{CurvesOfForm, QUANTITIES, Quantity};
use crate::report::words::page::{conventions_line, fixed, lcb, unit, value};

/// The page as Markdown. `rows` are the hydrostatics at the draughts of each reference, in the order of the references.
pub(in crate::report) fn markdown_page(outputs: &Outputs, references: &[Reference], rows: &[CurvesOfForm]) -> String {
    let mut page = String::new();
    // Writing to a String cannot fail.
    let _ = write_page(&mut page, outputs, references, rows);
    page
}

/// Quantities of a reference in one table.
const COLUMNS: usize = 5;

/// Text that stands in a cell of a table.
fn cell(text: &str) -> String {
    text.replace('|', "\\|").replace('\n', " ")
}

fn write_page(
    page: &mut String,
    outputs: &Outputs,
    references: &[Reference],
    rows: &[CurvesOfForm],
) -> std::fmt::Result {
    let summary = &outputs.summary;
    let p = summary.particulars;
    writeln!(page, "# {}\n", summary.name)?;
    let draught = p.t.map_or(String::new(), |draught| format!(" T {draught:.3} m,"));
    writeln!(page, "Family {}; Lpp {:.3} m, B {:.3} m,{draught} D {:.3} m.\n", summary.family, p.lpp, p.b, p.d)?;
    if !summary.targets.is_empty() {
        writeln!(page, "| | requested | achieved | error | origin |\n|---|---|---|---|---|")?;
        for t in &summary.targets {
            let (requested, achieved) = (fixed(t.requested, 6), fixed(t.achieved, 6));
            writeln!(page, "| {} | {requested} | {achieved} | {:.0e} | {} |", t.key, t.error + 0.0, t.origin)?;
        }
        writeln!(page)?;
    }
    for remark in &summary.remarks {
        writeln!(page, "* {}", cell(remark))?;
    }
    if !summary.remarks.is_empty() {
        writeln!(page)?;
    }
    // Each picture once: as PNG where it is one.
    let stems = |ending: &'static str| outputs.files.iter().filter_map(move |file| file.name.strip_suffix(ending));
    let drawn = stems(".svg").filter(|stem| !stems(".png").any(|other| other == *stem));
    let pictures = stems(".png").map(|stem| (stem, "png")).chain(drawn.map(|stem| (stem, "svg")));
    for (stem, ending) in pictures {
        writeln!(page, "![{}]({stem}.{ending})\n", stem.replace('-', " "))?;
    }
    writeln!(page, "## At the design draught\n\n{}\n", conventions_line(&outputs.table.conventions))?;
    writeln!(page, "| | | value | unit |\n|---|---|---|---|")?;
    let conventions = &outputs.table.conventions;
    let (centre, unit_of_centre) = (lcb(&outputs.design_row, conventions, p.lpp), conventions.lcb_reference.unit());
    writeln!(
        page,
        "| LCB | centre of buoyancy as printed: {} | {centre} | {unit_of_centre} |",
        conventions.lcb_reference.statement()
    )?;
    for quantity in QUANTITIES {
        let shown = value(&outputs.design_row, quantity.key);
        if !shown.is_empty() {
            writeln!(page, "| {} | {} | {} | {} |", quantity.key, cell(quantity.name), shown, unit(quantity.key))?;
        }
    }
    writeln!(page, "\n## Design\n\n| | | value | unit | origin | from |\n|---|---|---|---|---|---|")?;
    for v in &summary.values {
        let number = v.value.map(|value| fixed(value, 4)).unwrap_or_default();
        writeln!(
            page,
            "| {} | {} | {number} | {} | {} | {} |",
            v.key,
            cell(v.name),
            v.unit,
            v.origin,
            cell(&v.source)
        )?;
    }
    for (reference, ours) in references.iter().zip(rows) {
        writeln!(page, "\n## Against {}\n", reference.source)?;
        for note in reference.note.lines().filter(|line| !line.trim().is_empty()) {
            writeln!(page, "{}\n", note.trim())?;
        }
        writeln!(page, "Theirs, ours, ours less theirs in %.\n")?;
        // Five quantities a table, so that it can be read without scrolling.
        for (block, keys) in reference.columns.chunks(COLUMNS).enumerate() {
            writeln!(page, "| T | {} | | |", keys.join(" | | | "))?;
            writeln!(page, "|---|{}", "---|".repeat(3 * keys.len()))?;
            for (line, row) in reference.rows.iter().zip(&ours.rows) {
                write!(page, "| {} |", line.draught)?;
                for (key, theirs) in keys.iter().zip(line.values.iter().skip(COLUMNS * block)) {
                    let difference = Quantity::of(key)
                        .and_then(|quantity| (quantity.value)(row))
                        .map(|ours| fixed(reference.difference_percent(*theirs, ours), 2))
                        .map(
                            |shown| {
                                if shown.starts_with(['-']) || shown == "0.00" { shown } else { format!("+{shown}") }
                            },
                        );
                    write!(page, " {theirs} | {} | {} |", value(row, key), difference.unwrap_or_default())?;
                }
                writeln!(page)?;
            }
            writeln!(page)?;
        }
    }
    Ok(())
}
