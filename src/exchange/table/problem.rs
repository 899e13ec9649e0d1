//! What is wrong with a table of offsets, and what should be known about it.
//!
//! | code | about |
//! |---|---|
//! | E300 | the file holds no table of offsets |
//! | E301 | a cell that cannot be read |
//! | E303 | positions that do not rise |
//! | E304 | full breadths where half-breadths are meant |
//! | E305 | units that contradict the numbers |
//! | E306 | a station, waterline or buttock given twice |
//! | E307 | a row with more or fewer fields than the header |
//! | E308 | decimal commas among comma separators |
//! | E309 | signs that contradict each other |
//! | E310 | a header that is no position |
//! | E311 | a convention that is not known, or cannot be |
//! | E312 | a table that is too large |
//! | E313 | a table with too little in it |
//! | E315 | a length that is no ship's |
//! | W306 | no profiles of stem and stern |
//! | W307 | few waterlines below the draught |
//! | W308 | a draught above the top of the table |
//! | W309 | a breadth that is not that of the table |
//! | W310 | a length between perpendiculars that is not that of the table |
//! | W320 | something was assumed that changes numbers |
//! | N321 | what was detected: layout, separator, order, units |

use std::fmt;

/// How serious a problem of a table is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Severity {
    /// The table cannot be used as it is.
    Error,
    /// It can be used, and the reader should know.
    Warning,
    /// What was detected.
    Note,
}

/// One problem of a table: where, what was found, why it is wrong, and the likely remedy.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct TableProblem {
    /// Error, warning or note.
    pub severity: Severity,
    /// Code, `E301`.
    pub code: &'static str,
    /// File as it was named by the user.
    pub file: String,
    /// Row (line) from 1; none when it is about the whole file.
    pub row: Option<usize>,
    /// Column (field) from 1.
    pub column: Option<usize>,
    /// What stands there; empty when it is about the whole file.
    pub found: String,
    /// What is wrong, with numbers.
    pub message: String,
    /// The likely remedy; empty when the message says it.
    pub remedy: String,
}

/// `E301 offsets.csv row 14, column 3: '3-11-9': eighths are 0 to 7. Did you mean 3-11-0 or 4-0-1?`
impl fmt::Display for TableProblem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {}", self.code, self.file)?;
        match (self.row, self.column) {
            (Some(row), Some(column)) => write!(f, " row {row}, column {column}")?,
            (Some(row), None) => write!(f, " row {row}")?,
            (None, Some(column)) => write!(f, " column {column}")?,
            (None, None) => {}
        }
        write!(f, ": ")?;
        if !self.found.is_empty() {
            write!(f, "'{}': ", self.found)?;
        }
        write!(f, "{}", self.message)?;
        if !self.remedy.is_empty() {
            let dotted = self.message.ends_with(['.', '?', '!']);
            write!(f, "{} {}", if dotted { "" } else { "." }, self.remedy)?;
        }
        Ok(())
    }
}

/// After so many errors the rest is only counted.
const MOST_ERRORS: usize = 100;

/// A field of a file with its place.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub(super) struct Field {
    pub(super) text: String,
    /// Line, from 1.
    pub(super) row: usize,
    /// Field of the line, from 1.
    pub(super) column: usize,
}

impl Field {
    pub(super) fn trimmed(&self) -> &str {
        self.text.trim()
    }

    pub(super) fn is_blank(&self) -> bool {
        self.trimmed().is_empty()
    }
}

/// A text as it is quoted in messages: never longer than a line, without control characters.
fn quoted(text: &str) -> String {
    let shown: String = text.trim().chars().map(|c| if c.is_control() { ' ' } else { c }).collect();
    if shown.chars().count() > 40 { shown.chars().take(37).chain("...".chars()).collect() } else { shown }
}

/// Everything that was noticed while a table was read.
#[derive(Debug)]
pub(super) struct Problems {
    file: String,
    list: Vec<TableProblem>,
    errors: usize,
}

impl Problems {
    pub(super) fn new(file: &str) -> Self {
        Self { file: file.to_owned(), list: Vec::new(), errors: 0 }
    }

    /// Whether an error was noticed.
    pub(super) fn any_errors(&self) -> bool {
        self.errors > 0
    }

    fn push(&mut self, severity: Severity, code: &'static str, place: Option<&Field>, message: String, remedy: &str) {
        if severity == Severity::Error {
            self.errors += 1;
            if self.errors > MOST_ERRORS {
                return;
            }
        }
        self.list.push(TableProblem {
            severity,
            code,
            file: self.file.clone(),
            row: place.map(|field| field.row).filter(|&row| row > 0),
            column: place.map(|field| field.column).filter(|&column| column > 0),
            found: place.map(|field| quoted(&field.text)).unwrap_or_default(),
            message,
            remedy: remedy.to_owned(),
        });
    }

    /// An error of the whole file.
    pub(super) fn error(&mut self, code: &'static str, message: String, remedy: &str) {
        self.push(Severity::Error, code, None, message, remedy);
    }

    /// An error at a field.
    pub(super) fn error_at(&mut self, code: &'static str, field: &Field, message: String, remedy: &str) {
        self.push(Severity::Error, code, Some(field), message, remedy);
    }

    /// An error of a row.
    pub(super) fn error_in_row(&mut self, code: &'static str, row: usize, message: String, remedy: &str) {
        self.push(Severity::Error, code, Some(&Field { row, ..Field::default() }), message, remedy);
    }

    /// Something that the reader of the table should know.
    pub(super) fn warning(&mut self, code: &'static str, message: String, remedy: &str) {
        self.push(Severity::Warning, code, None, message, remedy);
    }

    /// Something that was detected.
    pub(super) fn note(&mut self, message: String) {
        self.push(Severity::Note, "N321", None, message, "");
    }

    /// An error of another file, of the conventions beside the table.
    pub(super) fn error_in(&mut self, file: &str, place: &Field, message: String, remedy: &str) {
        self.push(Severity::Error, "E311", Some(place), message, remedy);
        if let Some(last) = self.list.last_mut().filter(|_| self.errors <= MOST_ERRORS) {
            last.file = file.to_owned();
        }
    }

    /// The errors in the order of rows and columns, or the notes when there is none.
    pub(super) fn finish(mut self) -> Result<Vec<TableProblem>, Vec<TableProblem>> {
        if self.errors == 0 {
            self.list.sort_by_key(|problem| problem.severity);
            return Ok(self.list);
        }
        let hidden = self.errors.saturating_sub(MOST_ERRORS);
        // What was detected helps to understand the errors; it comes after them.
        self.list.sort_by_key(|p| (p.severity, p.row.unwrap_or(0), p.column.unwrap_or(0)));
        if hidden > 0 {
            let last = self.list.iter().position(|p| p.severity != Severity::Error).unwrap_or(self.list.len());
            let more = TableProblem {
                severity: Severity::Error,
                code: "E312",
                file: self.file,
                row: None,
                column: None,
                found: String::new(),
                message: format!("{hidden} more problems are not shown"),
                remedy: String::new(),
            };
            self.list.insert(last, more);
        }
        Err(self.list)
    }
}
