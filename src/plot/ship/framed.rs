//! The frame with title block and check bar around a figure that has none.

use super::{caption, title_block};
use crate::plot::paper::canvas::{Anchor, Canvas, Pen, TextStyle};
use crate::plot::paper::font::LETTERS;
use crate::plot::paper::sheet::{STRIP, Sheet, fitted, wide, wrapped};
use crate::plot::paper::svg::Svg;

/// Most lines of the caption in a title block.
const LINES: usize = 3;

/// What a title block says of its drawing.
#[derive(Debug, Clone, Copy)]
pub(in crate::plot) struct Titles<'a> {
    pub(in crate::plot) ship: &'a str,
    pub(in crate::plot) title: &'a str,
    /// What to look for.
    pub(in crate::plot) caption: &'a str,
    /// Number of the sheet, and how many there are.
    pub(in crate::plot) number: [usize; 2],
    /// What the drawing was made from.
    pub(in crate::plot) source: &'a str,
    /// Its date, as it was given.
    pub(in crate::plot) date: Option<&'a str>,
}

/// The frame of a drawing as large as `sheet` on a paper of that size or larger: name of the ship, title and caption of
/// the figure, check bar.
pub(in crate::plot) fn framed(sheet: Sheet, paper: Sheet, titles: &Titles<'_>) -> Svg {
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

/// The lines of a caption in the title block of a sheet.
fn caption_lines(sheet: Sheet, caption: &str) -> Vec<String> {
    wrapped(caption, |line| wide(line, LETTERS) <= sheet.caption_room())
}

/// Whether a caption has room in the title block of a sheet.
pub(in crate::plot) fn has_room_for_caption(sheet: Sheet, caption: &str) -> bool {
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
pub(in crate::plot) fn numbered_over(sheet: Sheet, titles: &Titles<'_>) -> Svg {
    let [width, height] = sheet.size();
    let mut canvas = Canvas::new(width, height);
    let date = titles.date.map_or(String::new(), |date| format!("   {date}"));
    let line = format!("{}{date}", numbered(titles, sheet));
    let frame = sheet.frame();
    title_block::draw_number(&mut canvas, &line, [frame.right, frame.bottom]);
    Svg::new(canvas.finish_clear(titles.title))
}
