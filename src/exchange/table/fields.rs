//! Numbers in the lines of a text, each with its place, and the list of what is wrong with them.
//!
//! Codes of the text formats: E320 size, E321 numbers, E322 counts, E323 order of sections, E324 terminators,
//! E325 half-breadths, E326 headers, E327 particulars, E328 no hull; W330 origin of x, W331 asymmetry, W332 what was left out,
//! W333 order, W334 conventions, W335 unusual values. Nothing is allocated by a count that stands in a file.

use super::{ReadTable, Severity, TableProblem};
use crate::hull::OffsetTable;

/// The most problems that are listed one by one; a file of another kind has as many as lines.
const LISTED: usize = 100;

/// No hull is longer, wider or higher than this \[m\], nor has a file as many sections or points.
const LARGEST: f64 = 1e6;

/// A place in a file; rows and columns from 1.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) struct Place {
    /// Line.
    pub(super) row: Option<usize>,
    /// Field of the line.
    pub(super) column: Option<usize>,
}

impl Place {
    /// The whole file.
    pub(super) const FILE: Self = Self { row: None, column: None };

    /// A line.
    pub(super) fn row(row: usize) -> Self {
        Self { row: Some(row), column: None }
    }
}

/// One field of a line.
#[derive(Debug, Clone, Copy)]
pub(super) struct Field<'a> {
    /// As it is written.
    pub(super) text: &'a str,
    /// Where.
    pub(super) place: Place,
}

/// One line with its fields.
#[derive(Debug, Clone)]
pub(super) struct Line<'a> {
    /// The line without blanks at its ends.
    pub(super) text: &'a str,
    /// Its number from 1.
    pub(super) row: usize,
    /// Its fields.
    pub(super) fields: Vec<Field<'a>>,
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
pub(super) fn lines(text: &str, separator: Separator) -> Vec<Line<'_>> {
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
                .map(|(k, (start, length))| Field {
                    text: &line[start..start + length],
                    place: Place { row: Some(row), column: Some(k + 1) },
                })
                .collect();
            Line { text: line.trim(), row, fields }
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

/// What is wrong with a file.
#[derive(Debug)]
pub(super) struct Problems {
    file: String,
    list: Vec<TableProblem>,
    errors: usize,
    /// Errors that are counted and not listed.
    silent: usize,
    /// Most digits after the decimal point of the lengths read so far.
    pub(super) decimals: usize,
}

impl Problems {
    /// None yet.
    pub(super) fn new(file: &str) -> Self {
        Self { file: file.to_owned(), list: Vec::new(), errors: 0, silent: 0, decimals: 0 }
    }

    /// Whether the table cannot be used.
    pub(super) fn has_errors(&self) -> bool {
        self.errors > 0
    }

    fn add(&mut self, problem: TableProblem) {
        if self.list.len() < LISTED { self.list.push(problem) } else { self.silent += 1 }
    }

    /// An error.
    pub(super) fn error(&mut self, code: &'static str, place: Place, found: &str, message: String, remedy: &str) {
        self.errors += 1;
        self.say(Severity::Error, code, place, found, message, remedy);
    }

    /// What the reader of the table should know.
    pub(super) fn note(&mut self, code: &'static str, place: Place, message: String, remedy: &str) {
        self.say(Severity::Warning, code, place, "", message, remedy);
    }

    fn say(
        &mut self,
        severity: Severity,
        code: &'static str,
        place: Place,
        found: &str,
        message: String,
        remedy: &str,
    ) {
        // What was found is quoted in one line of bearable length.
        let found: String = found.chars().filter(|c| !c.is_control()).take(60).collect();
        let (row, column) = (place.row, place.column);
        let file = self.file.clone();
        self.add(TableProblem { severity, code, file, row, column, found, message, remedy: remedy.to_owned() });
    }

    /// The number in a field.
    pub(super) fn number(&mut self, field: Field<'_>, what: &str) -> Option<f64> {
        match plain_number(field.text) {
            Some(value) if value.abs() <= LARGEST => Some(value),
            Some(_) => {
                let message = format!("{what} is beyond {LARGEST}");
                self.error("E321", field.place, field.text, message, "Check the number, and the columns of the line.");
                None
            }
            None => {
                let point = field.text.replace(',', ".");
                let remedy = if field.text.matches(',').count() == 1 && plain_number(&point).is_some() {
                    format!("Write {point}: this format has decimal points.")
                } else {
                    "Write one decimal number.".to_owned()
                };
                self.error("E321", field.place, field.text, format!("{what} is not a number"), &remedy);
                None
            }
        }
    }

    /// The length in a field; its digits are those of the table.
    pub(super) fn length(&mut self, field: Field<'_>, what: &str) -> Option<f64> {
        let value = self.number(field, what)?;
        self.decimals = self.decimals.max(decimals(field.text));
        Some(value)
    }

    /// The count in a field, `least` or more. Never allocate by it.
    pub(super) fn count(&mut self, field: Field<'_>, what: &str, least: usize) -> Option<usize> {
        let value = self.number(field, what)?;
        let whole = (value.fract().abs() < 1e-9).then_some(value).filter(|v| *v >= 0.0).map(|v| v as usize);
        match whole {
            Some(count) if count >= least => Some(count),
            _ => {
                let message = format!("{what} should be a whole number from {least}");
                self.error("E322", field.place, field.text, message, "Is the count before it right?");
                None
            }
        }
    }

    /// Lengths that are none of a ship, once they are metres.
    fn magnitudes(&mut self, table: &OffsetTable) {
        let beyond = |value: f64| value.is_nan() || value.abs() > super::assemble::LARGEST;
        let remedy = "Correct the number, or its unit.";
        let message = |value: f64| format!("a length of {value:e} m is no ship's");
        for &value in table.waterlines.iter().chain(&table.buttocks).filter(|v| beyond(**v)) {
            self.error("E321", Place::FILE, "", message(value), remedy);
        }
        for station in &table.stations {
            let x = station.station.x;
            let points = station.outlines.iter().flatten().flat_map(|p| [p.y, p.z]);
            if let Some(value) = std::iter::once(x).chain(points).find(|v| beyond(*v)) {
                let message = format!("station '{}': {}", station.station.name, message(value));
                self.error("E321", Place::FILE, "", message, remedy);
            }
            for cell in station.half_breadths.iter().chain(&station.heights) {
                if let Some(value) = cell.value().filter(|v| beyond(*v)) {
                    let place = cell
                        .written
                        .as_ref()
                        .map_or(Place::FILE, |w| Place { row: Some(w.row), column: Some(w.column) });
                    let found = cell.written.as_ref().map_or("", |w| w.text.as_str());
                    self.error("E321", place, found, message(value), remedy);
                }
            }
        }
    }

    /// The table with its notes, or every problem, in the order of rows and columns.
    pub(super) fn finish(mut self, table: Option<OffsetTable>) -> Result<ReadTable, Vec<TableProblem>> {
        if let Some(table) = &table {
            self.magnitudes(table);
        }
        self.list.sort_by_key(|problem| (problem.row.unwrap_or(0), problem.column.unwrap_or(0)));
        if self.silent > 0 {
            let message = format!("{} problems more", self.silent);
            self.silent = 0;
            let severity = if self.errors > 0 { Severity::Error } else { Severity::Warning };
            let file = self.file.clone();
            let (found, remedy) = (String::new(), "Is this the format that the name says?".to_owned());
            self.list.push(TableProblem {
                severity,
                code: "E320",
                file,
                row: None,
                column: None,
                found,
                message,
                remedy,
            });
        }
        match table {
            Some(table) if self.errors == 0 => Ok(ReadTable { table, notes: self.list }),
            _ => {
                if self.errors == 0 {
                    let message = "the file holds no table of offsets".to_owned();
                    self.error("E328", Place::FILE, "", message, "Was it cut off?");
                }
                Err(self.list)
            }
        }
    }
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

    #[test]
    fn many_problems_are_counted() {
        let mut problems = Problems::new("a");
        for row in 0..1000 {
            problems.error("E321", Place::row(1000 - row), "x", "bad".to_owned(), "");
        }
        let list = problems.finish(None).unwrap_err();
        assert_eq!(list.len(), LISTED + 1);
        assert!(list.windows(2).take(LISTED - 1).all(|pair| pair[0].row < pair[1].row));
        assert_eq!(list[LISTED].message, "900 problems more");
    }
}
