//! Figures on the pages of a PDF at true size: vectors, and text in the embedded font. No dates: the same figures give
//! the same bytes.

use super::pages::{Heading, Page};
use super::paper::error::PlotError;
use super::paper::sheet::{ROOM, Sheet};
use super::ship::caption;
use super::ship::framed::{Titles, framed, has_room_for_caption, numbered_over};
use document::{About, Document};
use drawing::PageContent;
use resvg::usvg::Tree;
use std::sync::Arc;

mod document;
mod drawing;
mod letters;
mod packed;
#[cfg(test)]
mod tests;

/// Points of a PDF in a millimetre.
const POINTS: f64 = 72.0 / 25.4;
/// Millimetres in a pixel of SVG.
const PIXEL: f64 = 25.4 / 96.0;

fn error(what: impl std::fmt::Display) -> PlotError {
    PlotError::Pdf(what.to_string())
}

/// Width and height of a drawing \[mm\].
fn size(tree: &Tree) -> [f64; 2] {
    [f64::from(tree.size().width()), f64::from(tree.size().height())].map(|pixels| pixels * PIXEL)
}

/// Draws with the upper left corner at `at` \[mm\].
fn place(content: &mut PageContent<'_>, tree: &Tree, at: [f64; 2]) -> Result<(), PlotError> {
    content.place(tree, at.map(|millimetres| millimetres * POINTS))
}

/// A figure that was read, with its size \[mm\].
struct Read<'a> {
    titles: Titles<'a>,
    tree: Arc<Tree>,
    size: [f64; 2],
}

impl Read<'_> {
    fn fits(&self, room: [f64; 2]) -> bool {
        self.size[0] <= room[0] + 0.1 && self.size[1] <= room[1] + 0.1
    }

    /// Whether `below` has room under it on a sheet, and both captions in one title block.
    fn leaves_room_for(&self, below: &Self, sheet: Sheet) -> bool {
        let [width, height] = sheet.room();
        let both_fit = self.fits([width, height]) && below.fits([width, height - self.size[1]]);
        both_fit && has_room_for_caption(sheet, &joint_caption([self, below]))
    }

    /// The frame of `sheet` with its upper left corner at `corner` \[mm\] of the paper, and the figure in the middle of
    /// it.
    fn draw_framed(
        &self,
        content: &mut PageContent<'_>,
        [sheet, paper]: [Sheet; 2],
        corner: [f64; 2],
        number: [usize; 2],
    ) -> Result<(), PlotError> {
        let frame = framed(sheet, paper, &Titles { number, ..self.titles });
        place(content, frame.tree()?.as_ref(), corner)?;
        let [width, height] = self.size;
        // A figure covers what is under it: it stays off the frame.
        let left = corner[0] + 0.5 * (sheet.size()[0] - width);
        let top = corner[1] + sheet.frame().top + 1.0 + 0.5 * (sheet.room()[1] - height).max(0.0);
        place(content, &self.tree, [left, top])
    }
}

/// A page of the document, its size \[mm\].
fn page(
    document: &mut Document,
    paper: [f64; 2],
    draw: impl FnOnce(&mut PageContent<'_>) -> Result<(), PlotError>,
) -> Result<(), PlotError> {
    document.page(paper.map(|millimetres| millimetres * POINTS), draw)
}

/// The caption of two figures on one sheet.
fn joint_caption(pair: [&Read<'_>; 2]) -> String {
    pair.map(|figure| figure.titles.caption).join(" ")
}

/// Two figures one above the other in the frame of `sheet`, under one title.
fn draw_pair(document: &mut Document, pair: [&Read<'_>; 2], sheet: Sheet, number: [usize; 2]) -> Result<(), PlotError> {
    let [upper, lower] = pair.map(|figure| &figure.titles);
    let title = format!("{}. {}", upper.title, lower.title);
    let caption = joint_caption(pair);
    let titles = Titles { title: &title, caption: &caption, number, ..*upper };
    page(document, sheet.size(), |content| {
        place(content, framed(sheet, sheet, &titles).tree()?.as_ref(), [0.0, 0.0])?;
        let spare = sheet.room()[1] - pair[0].size[1] - pair[1].size[1];
        let mut top = sheet.frame().top + 1.0 + spare / 3.0;
        for figure in pair {
            place(content, &figure.tree, [0.5 * (sheet.size()[0] - figure.size[0]), top])?;
            top += figure.size[1] + spare / 3.0;
        }
        Ok(())
    })
}

/// A figure on a page of its own.
fn draw_alone(document: &mut Document, figure: &Read<'_>, sheet: Sheet, number: [usize; 2]) -> Result<(), PlotError> {
    let (paper, fits) = if figure.fits(sheet.room()) { (sheet.size(), true) } else { (figure.size, false) };
    page(document, paper, |content| {
        if fits {
            return figure.draw_framed(content, [sheet, sheet], [0.0, 0.0], number);
        }
        place(content, &figure.tree, [0.0, 0.0])?;
        let titles = Titles { number, ..figure.titles };
        place(content, numbered_over(sheet, &titles).tree()?.as_ref(), [0.0, 0.0])
    })
}

/// The figures at true size, each with frame, title block and check bar, or as the whole sheet where it is larger than
/// the frame leaves.
///
/// Pages are in the order of the figures. On A3 a figure has a sheet of its own, or shares it with the next where both
/// are low enough. On A1 one that was drawn larger has a sheet of its own, and those that fit into the frame of A3
/// stand up to four to a sheet, as they follow each other.
///
/// # Errors
/// [`PlotError::Svg`], [`PlotError::Pdf`].
pub fn write_pdf<'a>(heading: &Heading<'a>, figures: &[Page<'a>], sheet: Sheet) -> Result<Vec<u8>, PlotError> {
    let mut document = Document::new();
    let read = |figure: &Page<'a>| -> Result<Read<'a>, PlotError> {
        let tree = figure.svg.tree()?;
        let Heading { ship, source, date } = *heading;
        let titles = Titles { ship, title: figure.title, caption: figure.caption, number: [1, 1], source, date };
        Ok(Read { titles, size: size(&tree), tree })
    };
    let all = figures.iter().map(read).collect::<Result<Vec<_>, _>>()?;
    let is_small = |figure: &Read<'_>| sheet != Sheet::A3 && figure.fits(ROOM);
    let sheets = sheets(&all, sheet, is_small);
    for (k, figures) in sheets.iter().enumerate() {
        let number = [k + 1, sheets.len()];
        match figures {
            [one] if !is_small(one) => draw_alone(&mut document, one, sheet, number)?,
            [upper, lower] if !is_small(upper) => draw_pair(&mut document, [upper, lower], sheet, number)?,
            four => page(&mut document, sheet.size(), |content| {
                let [wide, high] = Sheet::A3.size();
                let spare = [0.5 * (sheet.size()[0] - 2.0 * wide), 0.5 * (sheet.size()[1] - 2.0 * high)];
                for (k, figure) in four.iter().enumerate() {
                    let corner = [spare[0] + wide * (k % 2) as f64, spare[1] + high * (k / 2) as f64];
                    figure.draw_framed(content, [Sheet::A3, sheet], corner, number)?;
                }
                Ok(())
            })?,
        }
    }
    document.finish(&About { title: heading.ship, creator: &caption::program(), language: "en" })
}

/// The figures of each sheet: one, two over each other, or up to four small ones.
fn sheets<'r, 'a>(all: &'r [Read<'a>], sheet: Sheet, is_small: impl Fn(&Read<'a>) -> bool) -> Vec<&'r [Read<'a>]> {
    let mut sheets = Vec::new();
    for run in all.chunk_by(|a, b| is_small(a) == is_small(b)) {
        if is_small(&run[0]) {
            sheets.extend(run.chunks(4));
            continue;
        }
        let mut rest = run;
        while let [first, others @ ..] = rest {
            let pair = others.first().is_some_and(|below| first.leaves_room_for(below, sheet));
            let (here, after) = rest.split_at(1 + usize::from(pair));
            sheets.push(here);
            rest = after;
        }
    }
    sheets
}
