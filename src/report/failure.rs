//! Why a job did not end well, and what the program returns then.

use std::fmt;
use std::path::{Path, PathBuf};

use super::codes::explanation;
use crate::config::{Diagnostic, Severity};

/// Why a job did not end well.
#[derive(Debug)]
pub enum Failure {
    /// A file that says something wrong: every message about it.
    Input(Vec<Diagnostic>),
    /// A design that cannot be built: every reason.
    Infeasible(Vec<Diagnostic>),
    /// A command that asks for what no command gives.
    Usage(String),
    /// A check that did not pass.
    Check(String),
    /// Files that are there already.
    Exists(Vec<PathBuf>),
    /// The file system refused.
    FileSystem {
        /// What was tried, `read`, `write`.
        act: &'static str,
        /// On which path.
        path: PathBuf,
        /// What it answered.
        error: std::io::Error,
    },
    /// A fault of this program.
    Internal(String),
}

/// What messages about options of the command name in place of a file.
pub(super) const COMMAND_LINE: &str = "command line";

/// What is wrong with a file as a whole.
pub(super) fn problem(code: &'static str, file: &Path, message: String, help: impl Into<String>) -> Diagnostic {
    Diagnostic {
        severity: Severity::Error,
        code,
        file: file.display().to_string(),
        line: None,
        column: None,
        key: String::new(),
        message,
        help: help.into(),
    }
}

impl Failure {
    /// `what` needs a draught, or several things do, and nobody states one.
    #[must_use]
    pub fn without_draught(what: &str, count: usize) -> Self {
        let needs = if count == 1 { "needs" } else { "need" };
        Self::Usage(format!("{what} {needs} a draught, and none is stated: give --draught"))
    }

    /// Messages about the input; those about options of the command alone are of the command.
    pub(super) fn of_messages(messages: Vec<Diagnostic>) -> Self {
        let of_command = |message: &Diagnostic| {
            message.severity != Severity::Error || message.file.starts_with("--") || message.file == COMMAND_LINE
        };
        let failure = Self::Input(messages);
        match &failure {
            Self::Input(messages) if messages.iter().all(of_command) => Self::Usage(failure.to_string()),
            _ => failure,
        }
    }

    /// A design draught of the command that is none of the hull.
    pub(super) fn of_draught(error: &impl fmt::Display) -> Self {
        Self::Usage(format!("--draught: {error}"))
    }

    /// The code of the first error of the message; none of messages without a code.
    #[must_use]
    pub fn code(&self) -> Option<&'static str> {
        let text = self.to_string();
        let first = |line: &str| explanation(line.split_once(' ')?.0).map(|found| found.code);
        text.lines().filter_map(first).find(|code| code.starts_with('E'))
    }

    /// Exit code: 1 internal, 2 usage, 3 bad input, 4 infeasible, 5 a check failed, 6 file system.
    #[must_use]
    pub fn exit_code(&self) -> u8 {
        match self {
            Self::Internal(_) => 1,
            Self::Usage(_) => 2,
            Self::Input(_) => 3,
            Self::Infeasible(_) => 4,
            Self::Check(_) => 5,
            Self::Exists(_) | Self::FileSystem { .. } => 6,
        }
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Input(messages) | Self::Infeasible(messages) => {
                for (index, message) in messages.iter().enumerate() {
                    write!(f, "{}{message}", if index > 0 { "\n" } else { "" })?;
                }
                Ok(())
            }
            Self::Usage(message) | Self::Check(message) => write!(f, "{message}"),
            Self::Exists(paths) => {
                let names: Vec<String> = paths.iter().map(|path| path.display().to_string()).collect();
                write!(f, "E601 there already: {}. Use --force to overwrite, or -o for another place", names.join(", "))
            }
            Self::FileSystem { act, path, error } => {
                write!(f, "E602 cannot {act} {}: {error}. {}", path.display(), remedy(error.kind()))
            }
            Self::Internal(message) => write!(f, "E901 {message}. This is a fault of the program; please report it"),
        }
    }
}

/// What helps against a failure of the file system.
fn remedy(kind: std::io::ErrorKind) -> &'static str {
    match kind {
        std::io::ErrorKind::NotFound => "Check the name and the folder",
        std::io::ErrorKind::PermissionDenied => "Allow it, or name another place",
        std::io::ErrorKind::IsADirectory => "Name a file in it",
        std::io::ErrorKind::NotADirectory => "Name another folder, a file has this name",
        std::io::ErrorKind::StorageFull => "Make room, or name another place",
        _ => "Check the path, or name another place",
    }
}

impl std::error::Error for Failure {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_fault_of_the_program_says_so() {
        let failure = Failure::Internal("no plane".to_owned());
        assert_eq!(failure.exit_code(), 1);
        assert_eq!(failure.to_string(), "E901 no plane. This is a fault of the program; please report it");
        assert_eq!(failure.code(), Some("E901"));
    }

    #[test]
    fn the_code_is_that_of_the_first_error() {
        let warning = problem("W164", Path::new("a.csv"), "one suspect".to_owned(), "");
        let error = problem("E162", Path::new("a.csv"), "1 station".to_owned(), "");
        assert_eq!(Failure::Input(vec![warning, error]).code(), Some("E162"));
        assert_eq!(Failure::Usage("no folder".to_owned()).code(), None);
        assert_eq!(Failure::Check("E501 the self-test failed".to_owned()).code(), Some("E501"));
    }
}
