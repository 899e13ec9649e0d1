//! Text of other people: where its lines begin, and which names are taken from it.

use std::borrow::Cow;

use super::{CellRules, Notation, parse, parse_cell};

/// The longest name of a ship, a station or a line \[characters\].
pub const LONGEST_NAME: usize = 255;

/// Why a text is no name for drawings and files; none where it is one. The rule is the same for every file.
#[must_use]
pub fn name_fault(name: &str) -> Option<String> {
    let count = name.chars().take(LONGEST_NAME + 1).count();
    if count > LONGEST_NAME {
        return Some(format!("the name has more than {LONGEST_NAME} characters"));
    }
    let unseen = |c: char| {
        c.is_control() || matches!(c, '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}' | '\u{fffe}' | '\u{ffff}')
    };
    name.chars().any(unseen).then(|| "the name has a control character".to_owned())
}

/// What helps against every fault of a name.
pub const NAME_REMEDY: &str = "Write the name on one line of plain text";

/// A text as a cell of a CSV: one that a spreadsheet would take for a formula begins with an apostrophe. Numbers and
/// readings with their signs, and "-", are no text.
#[must_use]
pub fn guarded(text: &str) -> Cow<'_, str> {
    let rules = CellRules { unit: Notation::Metres, decimal_comma: text.contains(',') };
    let is_reading = || text == "-" || parse(text).is_ok() || parse_cell(text, rules).is_ok();
    if text.starts_with(['=', '+', '-', '@']) && !is_reading() { format!("'{text}").into() } else { text.into() }
}

/// The text of a cell that [`guarded`] wrote.
#[must_use]
pub fn unguarded(text: &str) -> &str {
    text.strip_prefix('\'').filter(|rest| rest.starts_with(['=', '+', '-', '@'])).unwrap_or(text)
}

/// Where the lines of a text begin: found once, so that a place costs no pass over the text.
#[derive(Debug, Clone)]
pub struct LineStarts(Vec<usize>);

impl LineStarts {
    /// Of a text.
    #[must_use]
    pub fn new(text: &str) -> Self {
        Self(std::iter::once(0).chain(text.match_indices('\n').map(|(at, _)| at + 1)).collect())
    }

    /// Number of the line of a byte, from 1.
    #[must_use]
    pub fn line(&self, byte: usize) -> usize {
        self.0.partition_point(|&start| start <= byte)
    }

    /// The text of a line without its end; empty where there is no such line.
    #[must_use]
    pub fn text<'t>(&self, text: &'t str, line: usize) -> &'t str {
        let start = self.0.get(line.wrapping_sub(1)).copied().unwrap_or(text.len());
        text[start..].lines().next().unwrap_or("")
    }

    /// Line and column, both from 1, of a byte; the column counts characters.
    #[must_use]
    pub fn position(&self, text: &str, byte: usize) -> (usize, usize) {
        let mut at = byte.min(text.len());
        while !text.is_char_boundary(at) {
            at -= 1;
        }
        let line = self.line(at);
        (line, text[self.0[line - 1]..at].chars().count() + 1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_one_line_of_plain_text() {
        let long = "x".repeat(LONGEST_NAME + 1);
        assert!(["", "Wigley hull", "=1+2", "Ää Öö", &long[1..]].iter().all(|name| name_fault(name).is_none()));
        for (name, fault) in [("a\u{7}b", "control"), ("a\nb", "control"), ("\u{202e}", "control"), (&long[..], "255")]
        {
            assert!(name_fault(name).is_some_and(|found| found.contains(fault)), "{name}");
        }
    }

    #[test]
    fn text_is_no_formula_and_numbers_stay() {
        for text in ["=1+2", "+cmd", "-x", "@SUM(A1)", "-transom", "=", "+"] {
            assert_eq!(guarded(text), format!("'{text}"));
            assert_eq!(unguarded(&guarded(text)), text);
        }
        for text in ["-", "-1.25", "+3", "-1,25", "-1-2-3+", "+0.8 %", "-5 m", "1=2", "'tis", ""] {
            assert_eq!(guarded(text), text);
        }
        assert_eq!(unguarded("'tis"), "'tis");
    }

    #[test]
    fn lines_are_found_by_their_number() {
        let lines = LineStarts::new("a = 1\r\nb\n");
        assert_eq!([1, 2, 3, 9].map(|line| lines.text("a = 1\r\nb\n", line)), ["a = 1", "b", "", ""]);
    }
}
