//! Tables of fractions: half-breadths over the largest of their waterline, or over B/2 (Series 60 and its like).
//!
//! A line a station, a column a waterline. With a last row `Max...` the fractions are of the waterline's own largest
//! half-breadth, which that row gives as a fraction of B/2: y = f max B/2. Without it they are of B/2. The label of a
//! waterline is its height over T, unless a comment says another, `waterline k at z = k*2.6/7`. Columns of sectional
//! areas are not used. What the table does not hold stands in comment lines,
//!
//! ```text
//! # Lpp = 121.92 m, B = 16.256 m, T = 6.5024 m
//! # station 0 = FP, 20 = AP
//! ```
//!
//! or, the dimensions, in a TOML beside it. Without a word about station 0 it is FP, as in Series 60 (Todd, DTMB 1712,
//! 1963), and a note says so.

use super::fields::{Separator, TextLine, decimals, finish, lines, plain_number};
use super::problem::{Field, FilePosition, Problems};
use super::sections::decimals_in_metres;
use super::{ReadTable, TableProblem};
use crate::hull::{
    Cell, Entry, Marks, OffsetTable, StatedParticulars, StationOffsets, TableForm, TableLayout, Written,
};
use crate::units::{counted, parse_length};

/// The separator of a table of cells: the most frequent of tab, semicolon and comma.
pub(super) fn separator(text: &str) -> char {
    let count = |mark: char| text.chars().filter(|c| *c == mark).count();
    let marks = ['\t', ';', ','];
    marks.into_iter().max_by_key(|&mark| (count(mark), mark == ',')).unwrap_or(',')
}

fn comments(text: &str) -> impl Iterator<Item = (usize, &str)> {
    let lines = text.lines().enumerate().map(|(i, line)| (i + 1, line.trim()));
    lines.filter_map(|(row, line)| Some((row, line.strip_prefix('#')?.trim())))
}

fn is_maxima(field: &str) -> bool {
    field.trim().to_ascii_lowercase().starts_with("max")
}

/// Whether these are fractions: a row of maxima, or a comment `y/(B/2)` or `y / ymax`, over a column of stations.
pub(super) fn recognise(_name: &str, text: &str) -> bool {
    let mark = separator(text);
    let mut rows = text.lines().filter(|line| !line.trim().is_empty() && !line.trim_start().starts_with('#'));
    let Some(head) = rows.next().and_then(|line| line.split(mark).next()) else { return false };
    let stations = matches!(head.trim().to_ascii_lowercase().as_str(), "" | "station" | "st" | "stn");
    let maxima = rows.next_back().is_some_and(|line| line.contains(mark) && is_maxima(line));
    let stated = || {
        comments(text).any(|(_, line)| {
            let line = line.to_ascii_lowercase().replace(' ', "");
            line.contains("y/(b/2)") || line.contains("y/ymax")
        })
    };
    stations && (maxima || stated())
}

/// Reads a table of fractions whose comment lines give its dimensions.
///
/// # Errors
/// Every problem of the file.
pub(super) fn read(name: &str, text: &str) -> Result<ReadTable, Vec<TableProblem>> {
    read_with(name, text, &StatedParticulars::default())
}

/// Reads a table of fractions; `sidecar` gives dimensions that its comment lines do not.
///
/// # Errors
/// Every problem of the file.
pub fn read_with(name: &str, text: &str, sidecar: &StatedParticulars) -> Result<ReadTable, Vec<TableProblem>> {
    let mut problems = Problems::new(name);
    let mut stated = *sidecar;
    let mut layout = Layout::default();
    for (row, line) in comments(text) {
        comment(line, FilePosition::row(row), &mut stated, &mut layout, &mut problems);
    }
    if let Some((message, remedy)) = missing_dimensions(&stated, [true; 3]) {
        problems.error("E327", FilePosition::FILE, message, remedy);
    }
    let main = [stated.length_between_perpendiculars, stated.breadth, stated.draught].map(|v| v.unwrap_or(1.0));
    let rows: Vec<TextLine<'_>> = lines(text, Separator::Exactly(separator(text)))
        .into_iter()
        .filter(|line| !line.text.is_empty() && !line.text.starts_with('#'))
        .collect();
    let table = fractions(&rows, main, &layout, &mut problems);
    finish(problems, table.map(|table| OffsetTable { stated, ..table }))
}

/// What is wrong, and the remedy, where one of L_PP, B and T that are `needed` is not stated.
pub(super) fn missing_dimensions(stated: &StatedParticulars, needed: [bool; 3]) -> Option<(String, &'static str)> {
    let all = [(stated.length_between_perpendiculars, "L (Lpp)"), (stated.breadth, "B"), (stated.draught, "T")];
    let absent = |(value, _): &(Option<f64>, &str)| value.is_none_or(|v| v <= 0.0);
    let missing = all.into_iter().zip(needed).filter(|(dimension, needed)| *needed && absent(dimension));
    let names: Vec<&str> = missing.map(|((_, name), _)| name).collect();
    let message = format!("the table holds fractions; missing, or not above 0: {}", names.join(", "));
    let remedy =
        "Write a line '# Lpp = ... m, B = ... m, T = ... m', or lpp, beam and draught in a TOML beside the table.";
    (!names.is_empty()).then_some((message, remedy))
}

/// What comments say of the layout.
#[derive(Debug, Clone, Copy, Default)]
struct Layout {
    /// Whether station 0 is AP.
    zero_is_ap: Option<bool>,
    /// The number of the last station, at the other perpendicular.
    last: Option<f64>,
    /// Height of waterline k over k \[m\].
    spacing: Option<f64>,
    /// Fractions are of the waterline's own maximum.
    own_maximum: bool,
}

fn comment(
    line: &str,
    place: FilePosition,
    stated: &mut StatedParticulars,
    layout: &mut Layout,
    problems: &mut Problems,
) {
    let close = line.to_ascii_lowercase().replace(' ', "");
    layout.own_maximum |= close.contains("y/ymax");
    if let Some((_, rest)) = close.split_once("waterlinekatz=k") {
        layout.spacing = product(rest);
        if layout.spacing.is_none() {
            let message = "the height of waterline k should be k times numbers, z = k*2.6/7".to_owned();
            problems.error("E326", (place, line), message, "");
        }
    }
    if let Some((_, rest)) = close.split_once("station0=") {
        layout.zero_is_ap = match rest.get(..2) {
            Some("ap") => Some(true),
            Some("fp") => Some(false),
            _ => {
                let message = "station 0 is AP or FP".to_owned();
                problems.error("E326", (place, line), message, "Write 'station 0 = AP'.");
                None
            }
        };
        let other = rest.get(2..).and_then(|rest| rest.strip_prefix(','));
        layout.last = other.and_then(|rest| plain_number(rest.split('=').next()?)).filter(|last| *last > 0.0);
        return;
    }
    for setting in line.split([',', ';']) {
        let Some((key, value)) = setting.split_once('=') else { continue };
        let Some(slot) = slot(stated, key) else { continue };
        match parse_length(value.trim()) {
            Ok(length) => {
                if let Some(before) = slot.replace(length).filter(|before| (before - length).abs() > 1e-9) {
                    let message =
                        format!("{} = {length} m here and {before} m beside the table; this is taken", key.trim());
                    problems.warning("W334", place, message, "");
                }
            }
            Err(error) => {
                problems.error("E321", (place, value.trim()), error.to_string(), "Write for example 'B = 16.256 m'.")
            }
        }
    }
}

/// The product of `*2.6/7`.
fn product(text: &str) -> Option<f64> {
    let text: String = text.chars().take_while(|c| c.is_ascii_digit() || matches!(c, '.' | '*' | '/')).collect();
    let mut value = 1.0;
    let mut rest = text.as_str();
    while !rest.is_empty() {
        let (operator, factors) = (rest.chars().next()?, rest.get(1..)?);
        let end = factors.find(['*', '/']).unwrap_or(factors.len());
        let (number, after) = factors.split_at(end);
        match operator {
            '*' => value *= plain_number(number)?,
            '/' => value /= plain_number(number).filter(|v| *v > 0.0)?,
            _ => return None,
        }
        rest = after;
    }
    (value.is_finite() && value > 0.0).then_some(value)
}

/// The dimension of a name.
pub(super) fn slot<'s>(stated: &'s mut StatedParticulars, key: &str) -> Option<&'s mut Option<f64>> {
    let lower = key.to_lowercase().replace('.', "").replace(['_', ',', '-'], " ");
    let is_bare = |word: &&str| !matches!(*word, "moulded" | "molded" | "mld" | "design" | "designed");
    let name: Vec<&str> = lower.split_whitespace().filter(is_bare).collect();
    match name.join(" ").as_str() {
        "l" | "lpp" | "lbp" | "l pp" | "length" | "length bp" | "length pp" | "length between perpendiculars" => {
            Some(&mut stated.length_between_perpendiculars)
        }
        "b" | "beam" | "breadth" => Some(&mut stated.breadth),
        "t" | "draught" | "draft" => Some(&mut stated.draught),
        "d" | "depth" => Some(&mut stated.depth),
        _ => None,
    }
}

/// A column of the table.
struct Waterline {
    index: usize,
    z: f64,
    tangent: bool,
    /// Largest half-breadth \[m\].
    largest: f64,
}

fn fractions(rows: &[TextLine<'_>], main: [f64; 3], layout: &Layout, problems: &mut Problems) -> Option<OffsetTable> {
    let [length, breadth, _] = main;
    let Some((head, rows)) = rows.split_first() else {
        problems.error("E324", FilePosition::FILE, "the table is empty".to_owned(), "");
        return None;
    };
    let mut waterlines = waterlines(head, main, layout, problems);
    let (maxima, stations): (Vec<&TextLine<'_>>, Vec<&TextLine<'_>>) =
        rows.iter().partition(|row| row.fields.first().is_some_and(|field| is_maxima(field.text)));
    match maxima[..] {
        [] if layout.own_maximum => {
            let message = "fractions of each waterline's own maximum, and no row of maxima".to_owned();
            let remedy = "Add a last row 'max, ...' with the largest half-breadth of each waterline over B/2.";
            problems.error("E326", FilePosition::FILE, message, remedy);
        }
        [] => problems.warning("W334", FilePosition::FILE, "no row of maxima: fractions are of B/2".to_owned(), ""),
        [row, ..] => {
            for waterline in &mut waterlines {
                let Some(field) = row.fields.get(waterline.index) else {
                    let message = "the row of maxima is shorter than the head".to_owned();
                    problems.error("E322", (FilePosition::row(row.row), row.text), message, "");
                    break;
                };
                waterline.largest = 0.5 * breadth * problems.number(*field, "the maximum").unwrap_or(1.0);
            }
            if let Some(second) = maxima.get(1) {
                let message = "a second row of maxima".to_owned();
                problems.error("E326", (FilePosition::row(second.row), second.text), message, "Leave one out.");
            }
        }
    }
    let mut digits = 0;
    let mut above = Vec::new();
    let mut read: Vec<(f64, StationOffsets)> = Vec::new();
    for row in stations {
        let Some(label) = row.fields.first().copied() else { continue };
        let Some(number) = problems.number(label, "the station") else { continue };
        if let Some((before, _)) = read.last().filter(|(before, _)| *before >= number) {
            let message = format!("station {number} after {before}");
            problems.error("E323", label, message, "Stations must rise.");
        }
        let mut station = StationOffsets::new(label.text, 0.0);
        for waterline in &waterlines {
            let Some(field) = row.fields.get(waterline.index).copied() else {
                let message = format!("{} cells, the head has {}", row.fields.len(), head.fields.len());
                problems.error(
                    "E322",
                    (FilePosition::row(row.row), row.text),
                    message,
                    "Write - where there is no hull.",
                );
                break;
            };
            let entry = fraction(field, problems);
            if let Entry::Given(f) = entry {
                digits = digits.max(decimals(field.text));
                if f > 1.0 + 1e-9 {
                    above.push((field, f));
                }
            }
            station.half_breadths.push(cell(field, entry, waterline));
        }
        if let Some(k) = waterlines.iter().position(|waterline| waterline.tangent) {
            station.flat_of_bottom = station.half_breadths.get(k).and_then(Cell::value);
        }
        read.push((number, station));
    }
    for (field, f) in above {
        let message = format!("'{}': the fraction {f} is above 1", field.text);
        problems.warning("W335", field.place(), message, "Is a decimal point missing?");
    }
    if read.len() < 2 {
        let message = format!("only {}", counted(read.len(), "station"));
        problems.error("E328", FilePosition::FILE, message, "At least two are needed.");
        return None;
    }
    let last = layout.last.unwrap_or_else(|| read.iter().map(|(number, _)| *number).fold(0.0, f64::max));
    if last <= 0.0 {
        problems.error("E323", FilePosition::FILE, format!("the last station is {last}"), "Number stations from 0.");
    }
    let zero_is_ap = layout.zero_is_ap.unwrap_or_else(|| {
        let message = format!("no comment says where station 0 is; taken as FP, and station {last} as AP");
        problems.warning("W334", FilePosition::FILE, message, "Write '# station 0 = AP' if it is not.");
        false
    });
    let mut stations: Vec<StationOffsets> = read
        .into_iter()
        .map(|(number, mut station)| {
            let from_zero = number / last;
            station.station.x = length * if zero_is_ap { from_zero } else { 1.0 - from_zero };
            station
        })
        .collect();
    if !zero_is_ap {
        stations.reverse();
    }
    let heights: Vec<f64> = waterlines.iter().map(|waterline| waterline.z).collect();
    let endings = vec![[None; 2]; heights.len()];
    // A step of the fraction is so many metres on the widest waterline.
    let form = TableForm {
        layout: TableLayout::Other,
        decimals: Some(decimals_in_metres(digits, 0.5 * breadth)),
        ..TableForm::default()
    };
    Some(OffsetTable { waterlines: heights, stations, endings, form, ..OffsetTable::default() })
}

fn waterlines(head: &TextLine<'_>, main: [f64; 3], layout: &Layout, problems: &mut Problems) -> Vec<Waterline> {
    let [_, breadth, draught] = main;
    let mut waterlines: Vec<Waterline> = Vec::new();
    for (index, field) in head.fields.iter().enumerate().skip(1) {
        let label = field.text.to_ascii_lowercase();
        if label.starts_with("sar") || label.contains("area") {
            problems.warning("W332", field.place(), format!("the column '{}' is not used", field.text), "");
            continue;
        }
        let number: String = label
            .trim_start_matches(|c: char| c.is_ascii_alphabetic() || c == ' ')
            .chars()
            .take_while(|c| c.is_ascii_digit() || *c == '.')
            .collect();
        let Some(k) = plain_number(&number) else {
            let message = "a column is a waterline (its height over T) or sectional areas".to_owned();
            problems.error("E326", field, message, "Write for example wl0.75.");
            continue;
        };
        let z = k * layout.spacing.unwrap_or(draught);
        if layout.spacing.is_none() && k > 3.0 {
            let message = format!("a waterline {k} times the draught above the base");
            let remedy = "If labels count waterlines, write a comment like '# waterline k at z = k*2.6/7 m'.";
            problems.error("E326", field, message, remedy);
        }
        if let Some(before) = waterlines.last().filter(|before| before.z >= z) {
            let message = format!("waterline at {z} m after {} m", before.z);
            problems.error("E323", field, message, "Waterlines must rise.");
        }
        waterlines.push(Waterline { index, z, tangent: label.contains("tangent"), largest: 0.5 * breadth });
    }
    if waterlines.is_empty() {
        problems.error("E326", (FilePosition::row(head.row), head.text), "the head names no waterlines".to_owned(), "");
    }
    waterlines
}

fn fraction(field: Field<&str>, problems: &mut Problems) -> Entry {
    match field.text {
        "" | "-" | "*" => Entry::Absent,
        "?" => Entry::Unknown,
        _ => match problems.number(field, "the fraction") {
            Some(f) if f < 0.0 => {
                let message = "a half-breadth is negative".to_owned();
                problems.error("E325", field, message, "Write - where there is no hull.");
                Entry::Absent
            }
            Some(f) => Entry::Given(f),
            None => Entry::Absent,
        },
    }
}

fn cell(field: Field<&str>, entry: Entry, waterline: &Waterline) -> Cell {
    let entry = match entry {
        Entry::Given(f) => Entry::Given(f * waterline.largest),
        other => other,
    };
    let written = Written { text: field.text.to_owned(), row: field.row, column: field.column };
    Cell { entry, marks: Marks { tangent: waterline.tangent, ..Marks::default() }, written: Some(written) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn heights_of_waterlines_are_products() {
        assert!((product("*2.6/7m").unwrap() - 2.6 / 7.0).abs() < 1e-15);
        assert!((product("*0.5").unwrap() - 0.5).abs() < 1e-15);
        assert!((product("m").unwrap() - 1.0).abs() < 1e-15);
        for bad in ["/0", "*", "2.6", "*2.6/"] {
            assert_eq!(product(bad), None, "{bad}");
        }
    }
}
