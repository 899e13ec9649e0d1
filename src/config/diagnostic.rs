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

/// Line and column, both from 1, of a byte position; the column counts characters.
pub(super) fn position(text: &str, byte: usize) -> (usize, usize) {
    let mut at = byte.min(text.len());
    while !text.is_char_boundary(at) {
        at -= 1;
    }
    let before = &text[..at];
    let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
    (before.matches('\n').count() + 1, before[line_start..].chars().count() + 1)
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
            help: "Cm must be at least 0.85".into(),
        };
        assert_eq!(
            diagnostic.to_string(),
            "E102 hull.toml:12:6 Cb 0.85 with Cm 0.80 gives Cp 1.06 > 1. Cm must be at least 0.85"
        );
        (diagnostic.line, diagnostic.column) = (None, None);
        diagnostic.help.clear();
        assert_eq!(diagnostic.to_string(), "E102 hull.toml Cb 0.85 with Cm 0.80 gives Cp 1.06 > 1");
    }

    #[test]
    fn positions_count_characters() {
        assert_eq!(position("a\nbé c", 6), (2, 4));
        assert_eq!(position("a", 99), (1, 2));
        assert_eq!(position("é", 1), (1, 1));
    }
}
