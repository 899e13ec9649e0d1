//! Where a job states its targets.

use std::fmt;

use super::super::diagnostic::{Diagnostic, Severity};
use super::super::document::Document;

/// A key of a job file with line and column, or an option of the command.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Location {
    file: String,
    pub(super) key: String,
    at: Option<(usize, usize)>,
}

impl Location {
    /// A byte of the document, which belongs to the key.
    pub(super) fn new(document: &Document<'_>, key: &str, byte: usize) -> Self {
        let at = Some(document.position(byte));
        Self { file: document.file.to_owned(), key: key.to_owned(), at }
    }

    /// The place of an option: there is no line and no column.
    pub(super) fn of_option(&mut self) {
        self.at = None;
    }

    /// Whether it is an option.
    #[must_use]
    pub fn is_option(&self) -> bool {
        self.at.is_none()
    }

    /// A message about what stands there.
    #[must_use]
    pub fn problem(&self, code: &'static str, text: &str, help: impl Into<String>) -> Diagnostic {
        Diagnostic {
            severity: Severity::Error,
            code,
            file: self.file.clone(),
            line: self.at.map(|at| at.0),
            column: self.at.map(|at| at.1),
            key: self.key.clone(),
            message: format!("{}: {text}", self.key),
            found: String::new(),
            help: help.into(),
        }
    }
}

/// `job.toml:12`, or `--lcb`.
impl fmt::Display for Location {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.file)?;
        self.at.map_or(Ok(()), |(line, _)| write!(f, ":{line}"))
    }
}
