//! What is wrong with a table of offsets.

use std::fmt;

/// How serious a problem of a table is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Severity {
    /// The table cannot be used as it is.
    Error,
    /// It can be used, and the reader should know.
    Warning,
}

/// One problem of a table: where, what was found, why it is wrong, and the likely remedy.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct TableProblem {
    /// Error or warning.
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
