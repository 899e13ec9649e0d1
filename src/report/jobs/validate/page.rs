//! The validation as Markdown, CSV and JSON.

use std::fmt::Write as _;

use serde_json::{Value, json};

use super::{Case, Comparison, Tolerance, Verdict};
use crate::hull::Chart;
use crate::report::words::page::{fixed, signed};
use crate::units::guarded;

/// Difference of the volume that tables of offsets are expected to keep, in %.
const GOAL: f64 = 0.3;

/// Five significant digits, never as a power of ten.
fn digits(value: f64) -> String {
    let magnitude = if value.abs() > 0.0 { value.abs().log10().floor() } else { 0.0 };
    fixed(value, (4.0 - magnitude).clamp(0.0, 5.0) as usize)
}

fn tolerance(c: &Comparison) -> String {
    match c.tolerance {
        Some(Tolerance::Absolute(allowed)) => format!("{allowed}"),
        Some(Tolerance::Percent(percent)) => format!("{percent} %"),
        None => String::new(),
    }
}

fn difference(c: &Comparison) -> String {
    match (c.percent(), c.difference()) {
        (Some(percent), _) => format!("{} %", signed(percent, 2)),
        (None, Some(difference)) => signed(difference, 3),
        _ => String::new(),
    }
}

/// The estimate in the measure of the difference.
fn left_out(c: &Comparison) -> String {
    match (c.left_out, c.percent()) {
        (Some(change), Some(_)) => format!("{} %", fixed(100.0 * change / c.theirs.abs(), 2)),
        (Some(change), None) => fixed(change, 3),
        _ => String::new(),
    }
}

fn chart(chart: Option<Chart>) -> &'static str {
    match chart {
        Some(Chart::Level) => "level chart",
        Some(Chart::Upright) => "upright chart",
        None => "no hull",
    }
}

fn cell(text: &str) -> String {
    text.replace('|', "\\|").replace('\n', " ")
}

/// The table and the remarks on the cases, as Markdown.
#[must_use]
pub fn validation_page(cases: &[Case]) -> String {
    let mut page = String::new();
    // Writing to a String cannot fail.
    let _ = write_page(&mut page, cases);
    page
}

fn write_page(page: &mut String, cases: &[Case]) -> std::fmt::Result {
    writeln!(page, "| case | quantity | T m | theirs | ours | difference | table | tolerance | verdict |")?;
    writeln!(page, "|---|---|---|---|---|---|---|---|---|")?;
    for case in cases {
        for c in &case.comparisons {
            let unit = if c.unit == "-" { "" } else { c.unit };
            let basis = if c.basis == "published" { String::new() } else { format!(" ({})", c.basis) };
            let name = [c.key, c.measured].join(" ");
            writeln!(
                page,
                "| {} | {}{basis} | {} | {} {unit} | {} | {} | {} | {} | {} |",
                case.name,
                name.trim(),
                fixed(c.draught, 3),
                digits(c.theirs),
                c.ours.map(digits).unwrap_or_default(),
                difference(c),
                left_out(c),
                tolerance(c),
                c.judgement()
            )?;
        }
        if let Some(failure) = &case.failure {
            writeln!(page, "| {} | no hull | | | | | | | FAILED: {} |", case.name, cell(failure))?;
        }
    }
    writeln!(page)?;
    writeln!(
        page,
        "`table` is what the table leaves open, estimated: a third (Richardson) of the change when every second station is left \
         out plus a third of that when every second waterline or point is, each fitted afresh.\n"
    )?;
    writeln!(
        page,
        "Coefficients are on Lpp and moulded breadth B at every draught, Cp on the largest section. Programs like Maxsurf refer \
         Cb, Cp and Cm to the length and the breadth of their own waterline at each draught; such coefficients differ from ours \
         by these conventions and are no measure of the fit: volumes are. Not judged are figures for which the reference states \
         no tolerance, and draughts that fewer than three waterlines of the table reach up to: below the first waterline above \
         the base line a table says nothing.\n"
    )?;
    for case in cases {
        let residual =
            case.residual.map(|r| format!("; largest residual {} mm", fixed(1000.0 * r, 3))).unwrap_or_default();
        let table = if case.table.is_empty() { String::new() } else { format!("{}, ", case.table) };
        let source = if case.source.is_empty() { String::new() } else { format!(". Figures: {}", case.source) };
        writeln!(page, "* **{}**: {}: {table}{}{residual}{source}", case.name, case.title, chart(case.chart))?;
        for c in case.comparisons.iter().filter(|c| c.key == "DISPVOL") {
            if let Some(percent) = c.percent().filter(|percent| percent.abs() > GOAL) {
                let cause = match c.left_out {
                    Some(change) if 100.0 * change / c.theirs.abs() >= percent.abs() => {
                        "the table leaves more than that open"
                    }
                    Some(_) => {
                        "the table leaves less than that open: theirs is another hull, or the lines do not show what differs"
                    }
                    None => "no estimate: the table without every second line makes no hull",
                };
                writeln!(
                    page,
                    "  * volume at {} m: {} %, beyond {GOAL} %; {cause}",
                    fixed(c.draught, 3),
                    signed(percent, 2)
                )?;
            }
        }
        for note in &case.notes {
            writeln!(page, "  * {}", cell(note))?;
        }
    }
    Ok(())
}

/// One line a figure:
/// `case,source,table,quantity,measured,basis,T,unit,theirs,ours,difference,difference_percent,left_out,
/// tolerance,verdict`; differences and `left_out` in the unit of the figure.
#[must_use]
pub fn validation_csv(cases: &[Case]) -> String {
    let mut text = String::from(
        "case,source,table,quantity,measured,basis,T,unit,theirs,ours,difference,difference_percent,left_out,tolerance,verdict\n",
    );
    let quoted = |field: &str| format!("\"{}\"", guarded(field).replace('"', "\"\""));
    let number = |value: Option<f64>| value.map(|value| format!("{}", value + 0.0)).unwrap_or_default();
    for case in cases {
        for c in &case.comparisons {
            let fields = [
                quoted(&case.name),
                quoted(&case.source),
                quoted(&case.table),
                c.key.to_owned(),
                quoted(c.measured),
                c.basis.to_owned(),
                number(Some(c.draught)),
                c.unit.to_owned(),
                number(Some(c.theirs)),
                number(c.ours),
                number(c.difference()),
                number(c.percent()),
                number(c.left_out),
                tolerance(c),
                c.verdict.as_str().to_owned(),
            ];
            text.push_str(&fields.join(","));
            text.push('\n');
        }
    }
    text
}

/// `{"passed", "cases": [{"case", "title", "source", "table", "chart", "residual", "failure", "notes", "figures":
/// [{"quantity", "measured", "basis", "T", "unit", "theirs", "ours", "difference", "difference_percent", "left_out",
/// "tolerance", "verdict"}]}]}`
#[must_use]
pub fn validation_json(cases: &[Case]) -> Value {
    let figure = |c: &Comparison| {
        json!({
            "quantity": c.key, "measured": c.measured, "basis": c.basis, "T": c.draught, "unit": c.unit,
            "theirs": c.theirs, "ours": c.ours, "difference": c.difference(), "difference_percent": c.percent(),
            "left_out": c.left_out, "tolerance": tolerance(c),
            "verdict": match c.verdict {
                Verdict::Within => "within",
                Verdict::Exceeded => "exceeded",
                Verdict::NotJudged => "not judged",
                Verdict::Missing => "missing",
            },
        })
    };
    let cases_json: Vec<Value> = cases
        .iter()
        .map(|case| {
            json!({
                "case": case.name, "title": case.title, "source": case.source, "table": case.table,
                "chart": case.chart.map(|_| chart(case.chart)), "residual": case.residual, "failure": case.failure,
                "notes": case.notes, "figures": case.comparisons.iter().map(figure).collect::<Vec<_>>(),
            })
        })
        .collect();
    json!({ "passed": cases.iter().all(Case::passed), "cases": cases_json })
}
