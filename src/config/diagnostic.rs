//! Messages about a file: what, where, why, and the remedy.

use std::fmt;

/// How serious a message is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Severity {
    /// The file cannot be used as it is.
    Error,
    /// It can be used, and the reader should know.
    Warning,
}

/// One message about a file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Diagnostic {
    /// Error or warning.
    pub severity: Severity,
    /// Code, `E102`.
    pub code: &'static str,
    /// File as it was named by the user.
    pub file: String,
    /// Line from 1; none when the message is about the whole file.
    pub line: Option<usize>,
    /// Column from 1, in characters.
    pub column: Option<usize>,
    /// Path of the key, `form.Cb`; empty when there is none.
    pub key: String,
    /// What was found, with numbers, and why it is a problem.
    pub message: String,
    /// The text of the file that is meant; empty when there is none of its own.
    pub found: String,
    /// The remedy; empty when the message says it.
    pub help: String,
}

/// `E102 hull.toml:12:6 Cb 0.85 with Cm 0.80 gives Cp 1.06 > 1. Cm must be at least 0.85.`
impl fmt::Display for Diagnostic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {}", self.code, self.file)?;
        if let Some(line) = self.line {
            write!(f, ":{line}")?;
            if let Some(column) = self.column {
                write!(f, ":{column}")?;
            }
        }
        let dotted = self.message.ends_with(['.', '?', '!']);
        write!(f, " {}", self.message)?;
        if !self.help.is_empty() {
            write!(f, "{} {}", if dotted { "" } else { "." }, self.help)?;
        }
        Ok(())
    }
}

impl std::error::Error for Diagnostic {}

impl Diagnostic {
    /// What the message or its remedy says that it expected; none where neither says it.
    #[must_use]
    pub fn expected(&self) -> Option<&str> {
        [&self.message, &self.help].into_iter().find_map(|text| {
            let at = [" expected ", "Expected "].iter().find_map(|word| text.find(word).map(|at| at + word.len()));
            let rest = &text[at.or_else(|| text.strip_prefix("expected ").map(|rest| text.len() - rest.len()))?..];
            let end = [". ", "; "].iter().filter_map(|stop| rest.find(stop)).min().unwrap_or(rest.len());
            Some(rest[..end].trim_end_matches('.'))
        })
    }
}

/// The text of a place as it is quoted: what is longer than a line or has several is cut.
pub(super) fn quoted(text: &str, span: &std::ops::Range<usize>) -> String {
    text.get(span.clone()).unwrap_or("").lines().next().unwrap_or("").chars().take(80).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn display_follows_the_house_style() {
        let mut diagnostic = Diagnostic {
            severity: Severity::Error,
            code: "E102",
            file: "hull.toml".into(),
            line: Some(12),
            column: Some(6),
            key: "form.Cb".into(),
            message: "Cb 0.85 with Cm 0.80 gives Cp 1.06 > 1".into(),
            found: "0.85".into(),
            help: "Cm must be at least 0.85".into(),
        };
        let error: &dyn std::error::Error = &diagnostic;
        assert_eq!(
            error.to_string(),
            "E102 hull.toml:12:6 Cb 0.85 with Cm 0.80 gives Cp 1.06 > 1. Cm must be at least 0.85"
        );
        (diagnostic.line, diagnostic.column) = (None, None);
        diagnostic.help.clear();
        assert_eq!(diagnostic.to_string(), "E102 hull.toml Cb 0.85 with Cm 0.80 gives Cp 1.06 > 1");
    }

    #[test]
    fn what_was_expected_is_read_from_the_message_or_the_remedy() {
        let of = |message: &str, help: &str| {
            let (file, key, found) = (String::new(), String::new(), String::new());
            let (severity, code, line, column) = (Severity::Error, "E122", None, None);
            let (message, help) = (message.to_owned(), help.to_owned());
            let problem = Diagnostic { severity, code, file, line, column, key, message, found, help };
            problem.expected().map(str::to_owned)
        };
        assert_eq!(of("form is 3, expected a table. So", "Write [form]").as_deref(), Some("a table"));
        assert_eq!(of("'x' is not a number", "Expected 0.5 to 1.5 m.").as_deref(), Some("0.5 to 1.5 m"));
        assert_eq!(of("not expected", "Leave it out"), None);
    }
}
