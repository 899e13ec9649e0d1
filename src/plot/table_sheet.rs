//! A table on a sheet of its own, for pages on paper.

use super::canvas::{Anchor, Canvas, Pen, Rectangle, TextStyle};
use super::sheet::{LETTERS, ROOM};
use super::{Svg, caption, font};

/// Largest height of a row \[mm\].
const ROW: f64 = 6.4;
/// Size of the text, as a part of the height of a row.
const TEXT: f64 = 0.74;
/// Largest size of the text \[mm\].
const LARGEST: f64 = 3.6;
/// Room between columns, in sizes of the text.
const GAP: f64 = 2.0;
/// Room above and below the table \[mm\].
const HEAD: f64 = 21.0;
const FOOT: f64 = 10.0;

/// Words over a table, the heads of its columns, its rows; the first `words` columns are text. A row whose first cell is
/// set in by a space goes on with the one above: no rule parts them. Rows become lower and text
/// smaller until all of it stands on the sheet.
#[must_use]
pub fn table_figure(title: &str, note: &str, heads: &[&str], words: usize, rows: &[Vec<String>]) -> Svg {
    let widest = |column: usize| {
        let cells = rows.iter().filter_map(|row| row.get(column)).map(|cell| font::width(cell));
        cells.fold(font::width(heads[column]), f64::max)
    };
    let widths: Vec<f64> = (0..heads.len()).map(widest).collect();
    let whole: f64 = widths.iter().sum::<f64>() + GAP * heads.len() as f64;
    let height = ((ROOM[1] - HEAD - FOOT) / (rows.len() + 1) as f64).min(ROW);
    let size = (TEXT * height).min((ROOM[0] - 10.0) / whole).min(LARGEST);
    let width = size * whole;
    let left = 0.5 * (ROOM[0] - width);
    let bottom = HEAD + height * (rows.len() + 1) as f64;
    let mut canvas = Canvas::new(ROOM[0], bottom + FOOT);
    canvas.text([0.5 * ROOM[0], 8.0], title, &TextStyle::new(4.5, Anchor::Middle));
    canvas.text([0.5 * ROOM[0], 15.0], note, &TextStyle::new(LETTERS, Anchor::Middle));
    let rule = Pen::new(0.13, "#000000");
    let mut x = left;
    for (column, wide) in widths.iter().enumerate() {
        let column_width = size * (wide + GAP);
        let (at, anchor) = if column < words {
            (x + 0.5 * GAP * size, Anchor::Start)
        } else {
            (x + column_width - 0.5 * GAP * size, Anchor::End)
        };
        let style = TextStyle::new(size, anchor);
        canvas.text([at, HEAD + 0.5 * height], heads[column], &style);
        for (row, cells) in rows.iter().enumerate() {
            if let Some(cell) = cells.get(column) {
                canvas.text([at, HEAD + height * (row as f64 + 1.5)], cell, &style);
            }
        }
        x += column_width;
    }
    for (row, cells) in rows.iter().enumerate() {
        if cells.first().is_none_or(|cell| !cell.starts_with(' ')) {
            let y = HEAD + height * (row + 1) as f64;
            canvas.line([left, y], [left + width, y], &rule);
        }
    }
    canvas.rectangle(&Rectangle::new(left, HEAD, left + width, bottom), &Pen::new(0.35, "#000000"));
    canvas.text([ROOM[0] - 6.0, bottom + FOOT - 4.0], &caption::program(), &TextStyle::new(LETTERS, Anchor::End));
    Svg::new(canvas.finish("table"))
}
