//! A table on a sheet of its own, for pages on paper.

use crate::plot::paper::canvas::{Anchor, Canvas, Pen, Rectangle, TextStyle};
use crate::plot::paper::font;
use crate::plot::paper::font::LETTERS;
use crate::plot::paper::sheet::{ROOM, wide, wrapped};
use crate::plot::paper::svg::Svg;
use crate::plot::ship::caption;

/// Largest height of a row \[mm\].
const ROW: f64 = 6.4;
/// Size of the text, as a part of the height of a row.
const TEXT: f64 = 0.74;
/// Largest size of the text \[mm\].
const LARGEST: f64 = 3.6;
/// Room between columns, in sizes of the text.
const GAP: f64 = 2.0;
/// Distance of the lines of words over a table \[mm\].
const LINE: f64 = 4.6;
/// Room above the table, with one line of words, and below it \[mm\].
const HEAD: f64 = 21.0;
const FOOT: f64 = 10.0;
/// Fewest rows of a part that stands beside another.
const LEAST: usize = 12;

/// Height of a row, and size of the text, of a table that goes on over several sheets \[mm\].
const EVEN_ROW: f64 = 5.0;
const EVEN_TEXT: f64 = 3.3;
/// Room between parts of a table that stand side by side \[mm\].
const BESIDE: f64 = 10.0;

/// A table: its heads, how many of its columns are text, and the widths of all in sizes of the text.
struct Columns<'a> {
    heads: &'a [&'a str],
    words: usize,
    widths: Vec<f64>,
}

impl<'a> Columns<'a> {
    fn new(heads: &'a [&'a str], words: usize, rows: &[Vec<String>]) -> Self {
        let widest = |column: usize| {
            let cells = rows.iter().filter_map(|row| row.get(column)).map(|cell| font::width(cell));
            cells.fold(font::width(heads[column]), f64::max)
        };
        Self { heads, words, widths: (0..heads.len()).map(widest).collect() }
    }

    /// Width of the table in sizes of its text.
    fn width(&self) -> f64 {
        self.widths.iter().sum::<f64>() + GAP * self.heads.len() as f64
    }

    /// Draws rows of `height` with text of `size` under the heads, with the upper left corner there.
    fn draw(&self, canvas: &mut Canvas, [left, top]: [f64; 2], [height, size]: [f64; 2], rows: &[Vec<String>]) {
        let rule = Pen::new(0.13, "#000000");
        let mut x = left;
        for (column, wide) in self.widths.iter().enumerate() {
            let column_width = size * (wide + GAP);
            let (at, anchor) = if column < self.words {
                (x + 0.5 * GAP * size, Anchor::Start)
            } else {
                (x + column_width - 0.5 * GAP * size, Anchor::End)
            };
            let style = TextStyle::new(size, anchor);
            canvas.text([at, top + 0.5 * height], self.heads[column], &style);
            for (row, cells) in rows.iter().enumerate() {
                if let Some(cell) = cells.get(column) {
                    canvas.text([at, top + height * (row as f64 + 1.5)], cell, &style);
                }
            }
            x += column_width;
        }
        for (row, _) in rows.iter().enumerate().filter(|(_, cells)| !goes_on(cells)) {
            let y = top + height * (row + 1) as f64;
            canvas.line([left, y], [x, y], &rule);
        }
        let bottom = top + height * (rows.len() + 1) as f64;
        canvas.rectangle(&Rectangle::new(left, top, x, bottom), &Pen::new(0.35, "#000000"));
    }
}

/// Whether a row goes on with the one above.
fn goes_on(cells: &[String]) -> bool {
    cells.first().is_some_and(|cell| cell.starts_with(' '))
}

/// The lines of words over a table.
fn noted(note: &str) -> Vec<String> {
    wrapped(note, |line| wide(line, LETTERS) <= ROOM[0] - 40.0)
}

/// Where a table begins under so many lines of words \[mm\].
fn top(lines: &[String]) -> f64 {
    HEAD + LINE * lines.len().saturating_sub(1) as f64
}

/// Title and words over a table on a sheet that ends at `bottom`.
fn sheet(title: &str, lines: &[String], bottom: f64) -> Canvas {
    let mut canvas = Canvas::new(ROOM[0], bottom);
    canvas.text([0.5 * ROOM[0], 8.0], title, &TextStyle::new(4.5, Anchor::Middle));
    for (k, line) in lines.iter().enumerate() {
        canvas.text([0.5 * ROOM[0], 15.0 + LINE * k as f64], line, &TextStyle::new(LETTERS, Anchor::Middle));
    }
    canvas.text([ROOM[0] - 6.0, bottom - 4.0], &caption::program(), &TextStyle::new(LETTERS, Anchor::End));
    canvas
}

/// Words over a table, the heads of its columns, its rows; the first `words` columns are text. A row whose first cell is
/// set in by a space goes on with the one above: no rule parts them. Rows become lower and text
/// smaller until all of it stands on the sheet.
#[must_use]
pub fn table_figure(title: &str, note: &str, heads: &[&str], words: usize, rows: &[Vec<String>]) -> Svg {
    let (columns, lines) = (Columns::new(heads, words, rows), noted(note));
    let top = top(&lines);
    let height = ((ROOM[1] - top - FOOT) / (rows.len() + 1) as f64).min(ROW);
    let size = (TEXT * height).min((ROOM[0] - 10.0) / columns.width()).min(LARGEST);
    let mut canvas = sheet(title, &lines, top + height * (rows.len() + 1) as f64 + FOOT);
    columns.draw(&mut canvas, [0.5 * (ROOM[0] - size * columns.width()), top], [height, size], rows);
    Svg::new(canvas.finish("table"))
}

/// The same with rows of one height, in parts side by side where they are narrow, on as many sheets as they take.
#[must_use]
pub fn table_sheets(title: &str, note: &str, heads: &[&str], words: usize, rows: &[Vec<String>]) -> Vec<Svg> {
    let (columns, lines) = (Columns::new(heads, words, rows), noted(note));
    let top = top(&lines);
    let size = EVEN_TEXT.min((ROOM[0] - 10.0) / columns.width());
    let width = size * columns.width();
    let beside = ((ROOM[0] - 10.0 + BESIDE) / (width + BESIDE)).floor().max(1.0) as usize;
    let most = ((ROOM[1] - top - FOOT) / EVEN_ROW).floor() as usize - 1;
    let count = rows.len().div_ceil(most * beside);
    let parts = parts(rows, rows.len().div_ceil(count.max(1) * beside).max(LEAST.min(most)), most);
    let sheets = parts.len().div_ceil(beside);
    let drawn = parts.chunks(beside).enumerate().map(|(k, parts)| {
        let longest = parts.iter().map(|part| part.len()).max().unwrap_or(0);
        let title = if sheets > 1 { format!("{title}, sheet {} of {sheets}", k + 1) } else { title.to_owned() };
        let mut canvas = sheet(&title, &lines, top + EVEN_ROW * (longest + 1) as f64 + FOOT);
        let whole = width * parts.len() as f64 + BESIDE * (parts.len() - 1) as f64;
        for (k, part) in parts.iter().enumerate() {
            let left = 0.5 * (ROOM[0] - whole) + (width + BESIDE) * k as f64;
            columns.draw(&mut canvas, [left, top], [EVEN_ROW, size], part);
        }
        Svg::new(canvas.finish("table"))
    });
    drawn.collect()
}

/// Rows in parts of `wanted`, or up to `most` where a row goes on.
fn parts(mut rows: &[Vec<String>], wanted: usize, most: usize) -> Vec<&[Vec<String>]> {
    let mut parts = Vec::new();
    while rows.len() > wanted {
        let begins = |at: &usize| rows.get(*at).is_none_or(|cells| !goes_on(cells));
        let at = (wanted..=most.min(rows.len())).find(begins).or_else(|| (1..wanted).rev().find(begins));
        let (part, rest) = rows.split_at(at.unwrap_or(wanted));
        parts.push(part);
        rows = rest;
    }
    if !rows.is_empty() {
        parts.push(rows);
    }
    parts
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_tables_go_on_and_lose_no_row() {
        let rows: Vec<Vec<String>> = (0..173).map(|k| vec![format!("row {k}"), k.to_string()]).collect();
        let sheets = table_sheets("TABLE", "", &["line", "number"], 1, &rows);
        assert_eq!(sheets.len(), 1);
        let long: Vec<Vec<String>> = (0..173).map(|k| vec![format!("{k} {}", "w".repeat(100))]).collect();
        let sheets = table_sheets("TABLE", "", &["words"], 1, &long);
        assert_eq!(sheets.len(), 4);
        let text: String = sheets.iter().map(|sheet| sheet.as_str().to_owned()).collect();
        assert!((0..173).all(|k| text.contains(&format!(">{k} w"))) && text.contains("TABLE, sheet 4 of 4"));
    }

    #[test]
    fn rows_that_go_on_stay_with_the_one_above() {
        let rows: Vec<Vec<String>> =
            ["a", "b", "  b", "  b", "c", "d"].iter().map(|cell| vec![(*cell).to_owned()]).collect();
        let lengths = |wanted, most| parts(&rows, wanted, most).iter().map(|part| part.len()).collect::<Vec<_>>();
        assert_eq!(lengths(3, 4), [4, 2]);
        assert_eq!(lengths(3, 3), [1, 3, 2]);
        assert_eq!(lengths(6, 6), [6]);
    }
}
