//! Sheets of paper: their sizes, and texts as they fit.

use super::canvas::{Anchor, Canvas, Rectangle, TextStyle};
use super::font::LEAST_LETTERS;

/// Margin of the frame \[mm\].
const MARGIN: f64 = 8.0;
/// Height of the title block under a figure \[mm\].
pub(in crate::plot) const STRIP: f64 = 18.0;
/// What the frame leaves of A3 to a figure \[mm\].
pub(in crate::plot) const ROOM: [f64; 2] = Sheet::A3.room();

/// A text as it fits into `room` \[mm\]: set smaller than `size`, but not below [`LEAST_LETTERS`]; then without its middle.
pub(in crate::plot) fn fitted(text: &str, size: f64, room: f64) -> (String, f64) {
    let size = (size * room / wide(text, size).max(1e-9)).min(size).max(LEAST_LETTERS.min(size));
    let letters: Vec<char> = text.chars().collect();
    let without = |count: usize| {
        let (head, tail) = (letters.len().div_ceil(2) - count.div_ceil(2), letters.len() / 2 - count / 2);
        let parts = [&letters[..head], &['…'], &letters[letters.len() - tail..]];
        parts.into_iter().flatten().collect::<String>()
    };
    let fits = |text: &String| wide(text, size) <= room * (1.0 + 1e-9);
    let shorter = (1..letters.len()).map(without);
    let found = std::iter::once(text.to_owned()).chain(shorter).find(fits);
    (found.unwrap_or_default(), size)
}

/// A sheet, landscape.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Sheet {
    /// 420 mm x 297 mm
    #[default]
    A3,
    /// 841 mm x 594 mm
    A1,
}

impl Sheet {
    /// Every sheet.
    pub const ALL: [Self; 2] = [Self::A3, Self::A1];

    /// Its name.
    #[must_use]
    pub fn as_str(self) -> &'static str {
        match self {
            Self::A3 => "A3",
            Self::A1 => "A1",
        }
    }

    /// Width and height \[mm\].
    #[must_use]
    pub const fn size(self) -> [f64; 2] {
        match self {
            Self::A3 => [420.0, 297.0],
            Self::A1 => [841.0, 594.0],
        }
    }

    /// What frame and title block leave to a figure \[mm\].
    #[must_use]
    pub const fn room(self) -> [f64; 2] {
        let [width, height] = self.size();
        [width - 2.0 * MARGIN - 2.0, height - 2.0 * MARGIN - STRIP - 2.0]
    }

    /// Where the columns of the title block end: check bar, title with caption, and what the drawing is \[mm\].
    pub(in crate::plot) fn columns(self) -> [f64; 2] {
        let frame = self.frame();
        [frame.left + 112.0, frame.right - 96.0]
    }

    /// Width that a caption has in the title block \[mm\].
    pub(in crate::plot) fn caption_room(self) -> f64 {
        let [left, right] = self.columns();
        right - left - 8.0
    }

    /// The frame of a drawing that fills it \[mm\].
    pub(in crate::plot) fn frame(self) -> Rectangle {
        let [width, height] = self.size();
        Rectangle::new(MARGIN, MARGIN, width - MARGIN, height - MARGIN)
    }
}

/// Width of a text on the sheet \[mm\].
pub(in crate::plot) fn wide(text: &str, size: f64) -> f64 {
    Canvas::text_place([0.0, 0.0], text, &TextStyle::new(size, Anchor::Start)).width()
}

/// Words in lines that fit.
pub(in crate::plot) fn wrapped(text: &str, fits: impl Fn(&str) -> bool) -> Vec<String> {
    in_lines(text.split_whitespace(), " ", fits)
}

/// Parts of a text in lines that fit, with a gap between those on one line.
pub(in crate::plot) fn in_lines<'a>(
    parts: impl IntoIterator<Item = &'a str>,
    gap: &str,
    fits: impl Fn(&str) -> bool,
) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for part in parts {
        let longer = lines.last().map(|line| format!("{line}{gap}{part}")).filter(|line| fits(line));
        match (longer, lines.last_mut()) {
            (Some(longer), Some(line)) => *line = longer,
            _ => lines.push(part.to_owned()),
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_are_wrapped_where_they_do_not_fit() {
        let lines = wrapped("one two  three four", |line| line.len() <= 9);
        assert_eq!(lines, ["one two", "three", "four"]);
        assert_eq!(in_lines(["one two", "three", "four"], "  ", |line| line.len() <= 14), ["one two  three", "four"]);
    }

    #[test]
    fn texts_that_do_not_fit_lose_their_middle() {
        let name = "a-very-long-name-of-a-file-of-offsets.csv  sha256 01234567";
        let whole = wide(name, 3.0);
        assert_eq!(fitted(name, 3.0, whole), (name.to_owned(), 3.0));
        let (text, size) = fitted(name, 3.0, 0.9 * whole);
        assert!(text == name && (size - 2.7).abs() < 1e-12);
        let (text, size) = fitted(name, 3.0, 0.4 * whole);
        assert!(text.starts_with("a-very") && text.contains('…') && text.ends_with("01234567"), "{text}");
        assert!(size >= LEAST_LETTERS && wide(&text, size) <= 0.4 * whole);
    }

    #[test]
    fn the_frame_leaves_the_room_that_figures_have() {
        for (found, expected) in [(ROOM, [402.0, 261.0]), (Sheet::A1.room(), [823.0, 558.0])] {
            assert!(found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-12), "{found:?}");
        }
    }
}
