//! Sheets of paper: their sizes, and the frame with title block and check bar around a figure that has none.

use super::canvas::{Anchor, Canvas, Pen, Rectangle, TextStyle};
use super::figure::Svg;
use super::{caption, title_block};

/// Margin of the frame \[mm\].
const MARGIN: f64 = 8.0;
/// Height of the title block under a figure \[mm\].
const STRIP: f64 = 16.0;
/// What the frame leaves of A3 to a figure \[mm\].
pub(super) const ROOM: [f64; 2] = Sheet::A3.room();

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

    /// The frame of a drawing that fills it \[mm\].
    pub(super) fn frame(self) -> Rectangle {
        let [width, height] = self.size();
        Rectangle::new(MARGIN, MARGIN, width - MARGIN, height - MARGIN)
    }
}

/// The frame of drawing `number` of `count` on a sheet: name of the ship, title of the figure, check bar.
pub(super) fn framed(sheet: Sheet, ship: &str, title: &str, number: usize, count: usize) -> Svg {
    let [width, height] = sheet.size();
    let mut canvas = Canvas::new(width, height);
    let frame = sheet.frame();
    canvas.rectangle(&frame, &Pen::new(0.7, "#000000"));
    let top = frame.bottom - STRIP;
    let rule = Pen::new(0.25, "#000000");
    canvas.line([frame.left, top], [frame.right, top], &rule);
    let columns = [frame.left + 112.0, frame.right - 96.0];
    for x in columns {
        canvas.line([x, top], [x, frame.bottom], &rule);
    }
    title_block::draw_check_bar(&mut canvas, [frame.left + 6.0, top + 9.0]);
    let room = columns[1] - columns[0] - 8.0;
    let fitted = |canvas: &mut Canvas, y: f64, text: &str, size: f64| {
        let style = TextStyle::new(size, Anchor::Start);
        let width = Canvas::text_place([0.0, 0.0], text, &style).width().max(1.0);
        canvas.text([columns[0] + 4.0, y], text, &TextStyle { size: size * (room / width).min(1.0), ..style });
    };
    fitted(&mut canvas, top + 5.0, &caption::plain(ship), 4.6);
    fitted(&mut canvas, top + 11.5, title, 3.4);
    let style = TextStyle::new(3.0, Anchor::Start);
    canvas.text(
        [columns[1] + 4.0, top + 5.0],
        &format!("drawing {number} of {count}   {}, true size", sheet.as_str()),
        &style,
    );
    canvas.text([columns[1] + 4.0, top + 11.5], &caption::program(), &style);
    Svg { text: canvas.finish(title) }
}
