//! Numbers in the lines of a text, each with its place, and the list of what is wrong with them.
//!
//! Nothing is allocated by a count that stands in a file.

use super::problem::{Field, FilePosition, Problems};
use super::{ReadTable, TableProblem};
use crate::hull::OffsetTable;

/// No hull is longer, wider or higher than this \[m\], nor has a file as many sections or points.
const LARGEST: f64 = 1e6;

/// One line with its fields.
#[derive(Debug, Clone)]
pub(super) struct TextLine<'a> {
    /// The line without blanks at its ends.
    pub(super) text: &'a str,
    /// Its number from 1.
    pub(super) row: usize,
    /// Its fields.
    pub(super) fields: Vec<Field<&'a str>>,
}

/// What separates the fields of a line.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Separator {
    /// Any white space.
    Blank,
    /// Commas, or white space where a line has no comma.
    CommaOrBlank,
    /// One character; empty fields count.
    Exactly(char),
}

/// The lines of a text with their fields.
pub(super) fn lines(text: &str, separator: Separator) -> Vec<TextLine<'_>> {
    let split = |line: &'_ str| -> Vec<(usize, usize)> {
        // Byte ranges, so that one closure serves the three ways.
        let base = line.as_ptr() as usize;
        let range = |part: &str| (part.as_ptr() as usize - base, part.len());
        match separator {
            Separator::Exactly(mark) => line.split(mark).map(|part| range(part.trim())).collect(),
            Separator::CommaOrBlank if line.contains(',') => line.split(',').map(|part| range(part.trim())).collect(),
            Separator::Blank | Separator::CommaOrBlank => line.split_whitespace().map(range).collect(),
        }
    };
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    text.lines()
        .enumerate()
        .map(|(index, line)| {
            let row = index + 1;
            let fields = split(line)
                .into_iter()
                .enumerate()
                .map(|(k, (start, length))| Field { text: &line[start..start + length], row, column: k + 1 })
                .collect();
            TextLine { text: line.trim(), row, fields }
        })
        .collect()
}

/// A number as FORTRAN and C write them, `1.5`, `.5`, `1.`, `1.5E+01`, `1.5D+01`; none for anything else and what is not
/// finite.
pub(super) fn plain_number(text: &str) -> Option<f64> {
    let usual = text.chars().all(|c| c.is_ascii_digit() || matches!(c, '+' | '-' | '.' | 'e' | 'E' | 'd' | 'D'));
    if !usual || !text.contains(|c: char| c.is_ascii_digit()) {
        return None;
    }
    text.replace(['d', 'D'], "e").parse::<f64>().ok().filter(|value| value.is_finite())
}

/// Digits after the decimal point of a number as it is written; exponents count.
pub(super) fn decimals(text: &str) -> usize {
    let (mantissa, exponent) = text.split_once(['e', 'E', 'd', 'D']).unwrap_or((text, "0"));
    let digits = mantissa.split_once('.').map_or(0, |(_, digits)| digits.len());
    let exponent = exponent.parse::<i32>().unwrap_or(0).clamp(-17, 17);
    usize::try_from(i32::try_from(digits.min(17)).unwrap_or(17) - exponent).unwrap_or(0).min(17)
}

impl Problems {
    /// The number in a field.
    pub(super) fn number(&mut self, field: Field<&str>, what: &str) -> Option<f64> {
        match plain_number(field.text) {
            Some(value) if value.abs() <= LARGEST => Some(value),
            Some(_) => {
                let message = format!("{what} is beyond {LARGEST}");
                self.error("E321", field, message, "Check the number, and the columns of the line.");
                None
            }
            None => {
                let point = field.text.replace(',', ".");
                let remedy = if field.text.matches(',').count() == 1 && plain_number(&point).is_some() {
                    format!("Write {point}: this format has decimal points.")
                } else {
                    "Write one decimal number.".to_owned()
                };
                self.error("E321", field, format!("{what} is not a number"), &remedy);
                None
            }
        }
    }

    /// The length in a field; its digits are those of the table.
    pub(super) fn length(&mut self, field: Field<&str>, what: &str) -> Option<f64> {
        let value = self.number(field, what)?;
        self.decimals = self.decimals.max(decimals(field.text));
        Some(value)
    }

    /// The count in a field, `least` or more. Never allocate by it.
    pub(super) fn count(&mut self, field: Field<&str>, what: &str, least: usize) -> Option<usize> {
        let value = self.number(field, what)?;
        let whole = (value.fract().abs() < 1e-9).then_some(value).filter(|v| *v >= 0.0).map(|v| v as usize);
        match whole {
            Some(count) if count >= least => Some(count),
            _ => {
                let message = format!("{what} should be a whole number from {least}");
                self.error("E322", field, message, "Is the count before it right?");
                None
            }
        }
    }
}

/// Lengths that are none of a ship, once they are metres.
fn magnitudes(table: &OffsetTable, problems: &mut Problems) {
    let beyond = |value: f64| value.is_nan() || value.abs() > super::assemble::LARGEST;
    let remedy = "Correct the number, or its unit.";
    let message = |value: f64| format!("a length of {value:e} m is no ship's");
    for &value in table.waterlines.iter().chain(&table.buttocks).filter(|v| beyond(**v)) {
        problems.error("E321", FilePosition::FILE, message(value), remedy);
    }
    for station in &table.stations {
        let x = station.station.x;
        let points = station.outlines.iter().flatten().flat_map(|p| [p.y, p.z]);
        if let Some(value) = std::iter::once(x).chain(points).find(|v| beyond(*v)) {
            let message = format!("station '{}': {}", station.station.name, message(value));
            problems.error("E321", FilePosition::FILE, message, remedy);
        }
        for cell in station.half_breadths.iter().chain(&station.heights) {
            if let Some(value) = cell.value().filter(|v| beyond(*v)) {
                problems.error("E321", &Field::of_cell(cell), message(value), remedy);
            }
        }
    }
}

/// The table with its notes, or every problem, in the order of rows and columns.
pub(super) fn finish(mut problems: Problems, table: Option<OffsetTable>) -> Result<ReadTable, Vec<TableProblem>> {
    if let Some(table) = &table {
        magnitudes(table, &mut problems);
    }
    if table.is_none() && !problems.any_errors() {
        problems.error("E328", FilePosition::FILE, "the file holds no table of offsets".to_owned(), "Was it cut off?");
    }
    let notes = problems.finish()?;
    Ok(ReadTable { table: table.unwrap_or_default(), notes })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_of_all_programs() {
        for (text, value) in [("1.5", 1.5), (".5", 0.5), ("-1.", -1.0), ("1.5D+01", 15.0), ("+2e-1", 0.2)] {
            assert!((plain_number(text).unwrap() - value).abs() < 1e-15, "{text}");
        }
        for text in ["", "-", "nan", "inf", "1,5", "1.5.2", "0x1", "1e999", "e", "d", "1 2"] {
            assert_eq!(plain_number(text), None, "{text}");
        }
        for (text, digits) in [("1.250", 3), ("3", 0), ("1.5E-02", 3), ("1.50D+01", 1), ("9.E-99", 17)] {
            assert_eq!(decimals(text), digits, "{text}");
        }
    }
}
