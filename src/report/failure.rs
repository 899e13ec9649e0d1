//! Why a job did not end well, and what the program returns then: in words, or in JSON for other programs.

use std::fmt;
use std::path::{Path, PathBuf};

use serde_json::{Value, json};

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
    /// Options that say something wrong: every message about them.
    Options(Vec<Diagnostic>),
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
    /// Some of several jobs, in their order, each of which was reported when it failed.
    Several {
        /// What failed, and why.
        failed: Vec<(PathBuf, Failure)>,
        /// Of how many.
        of: usize,
    },
}

/// What messages about options of the command name in place of a file.
pub const COMMAND_LINE: &str = "command line";

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
        found: String::new(),
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
        if messages.iter().all(of_command) { Self::Options(messages) } else { Self::Input(messages) }
    }

    /// A design draught of the command that is none of the hull.
    pub(super) fn of_draught(error: &impl fmt::Display) -> Self {
        Self::Usage(format!("--draught: {error}"))
    }

    /// The code of the first error of the message; none of messages without a code.
    #[must_use]
    pub fn code(&self) -> Option<&'static str> {
        match self {
            Self::Input(messages) | Self::Infeasible(messages) | Self::Options(messages) => {
                messages.iter().map(|message| message.code).find(|code| code.starts_with('E'))
            }
            Self::Exists(_) => Some("E601"),
            Self::FileSystem { .. } => Some("E602"),
            Self::Usage(message) => Some(coded("E705", message).code),
            Self::Check(message) => Some(coded("E502", message).code),
            Self::Internal(_) => Some("E901"),
            Self::Several { .. } => None,
        }
    }

    /// The failure for other programs: `{"error": [{"code", "file", "line", "key", "message", "found", "expected",
    /// "remedy"}]}`, with null for what there is not.
    #[must_use]
    pub fn to_json(&self) -> Value {
        json!({ "error": self.entries() })
    }

    /// The entries of [`Failure::to_json`].
    fn entries(&self) -> Vec<Value> {
        match self {
            Self::Input(messages) | Self::Infeasible(messages) | Self::Options(messages) => {
                // Notes are no errors; they stand on stderr.
                messages.iter().filter(|message| !message.code.starts_with('N')).map(entry).collect()
            }
            Self::Exists(paths) => {
                let of = |path: &PathBuf| {
                    let message = "there already".to_owned();
                    entry(&problem("E601", path, message, "Use --force to overwrite, or -o for another place"))
                };
                paths.iter().map(of).collect()
            }
            Self::FileSystem { act, path, error } => {
                vec![entry(&problem("E602", path, format!("cannot {act}: {error}"), remedy(error.kind())))]
            }
            Self::Usage(message) => vec![entry(&coded("E705", message))],
            Self::Check(message) => vec![entry(&coded("E502", message))],
            Self::Internal(message) => vec![entry(&coded("E901", message))],
            Self::Several { failed, .. } => failed.iter().flat_map(|(_, failure)| failure.entries()).collect(),
        }
    }

    /// Exit code: 1 internal, 2 usage, 3 bad input, 4 infeasible, 5 a check failed, 6 file system.
    #[must_use]
    pub fn exit_code(&self) -> u8 {
        match self {
            Self::Internal(_) => 1,
            Self::Usage(_) | Self::Options(_) => 2,
            Self::Input(_) => 3,
            Self::Infeasible(_) => 4,
            Self::Check(_) => 5,
            Self::Exists(_) | Self::FileSystem { .. } => 6,
            Self::Several { failed, .. } => failed.first().map_or(1, |(_, failure)| failure.exit_code()),
        }
    }
}

/// A message of the whole command; a code that opens it is its own.
fn coded(code: &'static str, message: &str) -> Diagnostic {
    let own = ["E203", "E501", "E502", "E503", "E504", "E505"].into_iter().find(|own| message.starts_with(own));
    let text = own.and_then(|own| message.strip_prefix(own)).map_or(message, str::trim_start);
    problem(own.unwrap_or(code), Path::new(COMMAND_LINE), text.to_owned(), "")
}

/// A message for other programs.
fn entry(message: &Diagnostic) -> Value {
    let text = |text: &str| Some(text.to_owned()).filter(|text| !text.is_empty());
    json!({
        "code": message.code,
        "file": Some(&message.file).filter(|file| *file != COMMAND_LINE),
        "line": message.line,
        "key": text(&message.key),
        "message": message.message,
        "found": text(&message.found),
        "expected": message.expected(),
        "remedy": text(&message.help),
    })
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Input(messages) | Self::Infeasible(messages) | Self::Options(messages) => {
                for (index, message) in messages.iter().enumerate() {
                    write!(f, "{}{message}", if index > 0 { "\n" } else { "" })?;
                }
                Ok(())
            }
            Self::Usage(message) => {
                let Diagnostic { code, message, .. } = coded("E705", message);
                write!(f, "{code} {message}")
            }
            Self::Check(message) => write!(f, "{message}"),
            Self::Several { failed, of } => several(f, failed, *of),
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

/// A table of the jobs that failed: the file, the exit code that it alone would give, its first message.
fn several(f: &mut fmt::Formatter<'_>, failed: &[(PathBuf, Failure)], of: usize) -> fmt::Result {
    write!(f, "{} of {of} failed; exit code, file, first message:", failed.len())?;
    for (path, failure) in failed {
        let text = failure.to_string();
        write!(f, "\n  {}  {}  {}", failure.exit_code(), path.display(), text.lines().next().unwrap_or(""))?;
    }
    Ok(())
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
        assert_eq!(Failure::Usage("no folder".to_owned()).code(), Some("E705"));
        assert_eq!(Failure::Check("E501 the self-test failed".to_owned()).code(), Some("E501"));
    }
}
