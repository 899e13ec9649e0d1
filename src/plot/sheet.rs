//! Sheets of paper: their sizes, and the frame with title block and check bar around a figure that has none.

use super::canvas::{Anchor, Canvas, Pen, Rectangle, TextStyle};
use super::figure::Svg;
use super::{caption, title_block};

/// Margin of the frame \[mm\].
const MARGIN: f64 = 8.0;
/// Height of the title block under a figure \[mm\].
const STRIP: f64 = 18.0;
/// What the frame leaves of A3 to a figure \[mm\].
pub(super) const ROOM: [f64; 2] = Sheet::A3.room();

/// Least size of letters on a drawing as wide as A3: nine pixels where the drawing is 1200 pixels wide \[mm\].
pub(super) const LETTERS: f64 = 3.15;

/// Least size of letters on any sheet \[mm\]: capitals of 1.8 mm, the least of ISO 3098.
pub(super) const LEAST_LETTERS: f64 = 2.5;

/// A text as it fits into `room` \[mm\]: set smaller than `size`, but not below [`LEAST_LETTERS`]; then without its middle.
pub(super) fn fitted(text: &str, size: f64, room: f64) -> (String, f64) {
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
    fn columns(self) -> [f64; 2] {
        let frame = self.frame();
        [frame.left + 112.0, frame.right - 96.0]
    }

    /// Width that a caption has in the title block \[mm\].
    fn caption_room(self) -> f64 {
        let [left, right] = self.columns();
        right - left - 8.0
    }

    /// The frame of a drawing that fills it \[mm\].
    pub(super) fn frame(self) -> Rectangle {
        let [width, height] = self.size();
        Rectangle::new(MARGIN, MARGIN, width - MARGIN, height - MARGIN)
    }
}

/// Most lines of the caption in a title block.
const LINES: usize = 3;

/// What a title block says of its drawing.
#[derive(Debug, Clone, Copy)]
pub(super) struct Titles<'a> {
    pub(super) ship: &'a str,
    pub(super) title: &'a str,
    /// What to look for.
    pub(super) caption: &'a str,
    /// Number of the sheet, and how many there are.
    pub(super) number: [usize; 2],
    /// What the drawing was made from.
    pub(super) source: &'a str,
    /// Its date, as it was given.
    pub(super) date: Option<&'a str>,
}

/// The frame of a drawing as large as `sheet` on a paper of that size or larger: name of the ship, title and caption of
/// the figure, check bar.
pub(super) fn framed(sheet: Sheet, paper: Sheet, titles: &Titles<'_>) -> Svg {
    let [width, height] = sheet.size();
    let mut canvas = Canvas::new(width, height);
    let frame = sheet.frame();
    canvas.rectangle(&frame, &Pen::new(0.7, "#000000"));
    let top = frame.bottom - STRIP;
    let rule = Pen::new(0.25, "#000000");
    canvas.line([frame.left, top], [frame.right, top], &rule);
    let columns = sheet.columns();
    for x in columns {
        canvas.line([x, top], [x, frame.bottom], &rule);
    }
    title_block::draw_check_bar(&mut canvas, [frame.left + 6.0, top + 9.0]);
    let room = sheet.caption_room();
    let heading = format!("{} – {}", caption::plain(titles.ship), titles.title);
    let (heading, size) = fitted(&heading, 3.8, room);
    canvas.text([columns[0] + 4.0, top + 3.7], &heading, &TextStyle::new(size, Anchor::Start));
    let small = TextStyle::new(LETTERS, Anchor::Start);
    for (k, line) in caption_lines(sheet, titles.caption).iter().take(LINES).enumerate() {
        canvas.text([columns[0] + 4.0, top + 7.9 + 3.6 * k as f64], line, &small);
    }
    let lines = [numbered(titles, paper), titles.source.to_owned(), stamped(titles)];
    for (k, line) in lines.iter().enumerate() {
        let (line, size) = fitted(line, LETTERS, frame.right - columns[1] - 6.0);
        canvas.text([columns[1] + 3.0, top + 4.0 + 5.0 * k as f64], &line, &TextStyle { size, ..small });
    }
    Svg::new(canvas.finish(titles.title))
}

/// Width of a text on the sheet \[mm\].
pub(super) fn wide(text: &str, size: f64) -> f64 {
    Canvas::text_place([0.0, 0.0], text, &TextStyle::new(size, Anchor::Start)).width()
}

/// The lines of a caption in the title block of a sheet.
fn caption_lines(sheet: Sheet, caption: &str) -> Vec<String> {
    wrapped(caption, |line| wide(line, LETTERS) <= sheet.caption_room())
}

/// Whether a caption has room in the title block of a sheet.
pub(super) fn has_room_for_caption(sheet: Sheet, caption: &str) -> bool {
    caption_lines(sheet, caption).len() <= LINES
}

/// `sheet 3 of 24   A3, true size`.
fn numbered(titles: &Titles<'_>, sheet: Sheet) -> String {
    let [number, count] = titles.number;
    format!("sheet {number} of {count}   {}, true size", sheet.as_str())
}

/// The program and the date.
fn stamped(titles: &Titles<'_>) -> String {
    titles.date.map_or_else(caption::program, |date| format!("{}   {date}", caption::program()))
}

/// For a drawing that is a sheet with its own frame and title block: in that, which sheet it is.
pub(super) fn numbered_over(sheet: Sheet, titles: &Titles<'_>) -> Svg {
    let [width, height] = sheet.size();
    let mut canvas = Canvas::new(width, height);
    let date = titles.date.map_or(String::new(), |date| format!("   {date}"));
    let line = format!("{}{date}", numbered(titles, sheet));
    let frame = sheet.frame();
    title_block::draw_number(&mut canvas, &line, [frame.right, frame.bottom]);
    Svg::new(canvas.finish_clear(titles.title))
}

/// Words in lines that fit.
pub(super) fn wrapped(text: &str, fits: impl Fn(&str) -> bool) -> Vec<String> {
    in_lines(text.split_whitespace(), " ", fits)
}

/// Parts of a text in lines that fit, with a gap between those on one line.
pub(super) fn in_lines<'a>(
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
