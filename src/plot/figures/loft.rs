//! Frames of the mould loft at true size: one drawing a frame, or tiles of A3 that are trimmed at their frames and laid edge
//! to edge.

use crate::hull::{FramePoint, LoftedFrame};
use crate::plot::paper::canvas::{Anchor, Canvas, Pen, Rectangle, TextStyle};
use crate::plot::paper::sheet::Sheet;
use crate::plot::paper::svg::Svg;

/// Room around the frame in its drawing, and the window of a tile on its paper \[mm\].
const ROOM: f64 = 40.0;
const MARGIN: [f64; 2] = [20.0, 22.0];

/// Millimetres in a metre.
const FULL: f64 = 1000.0;

const OUTLINE: Pen = Pen::new(0.35, "#000000");
const GRID: Pen = Pen::new(0.13, "#888888");
const AXIS: Pen = Pen::new(0.25, "#1f4e79");
const EDGE: Pen = Pen::new(0.18, "#000000");
const TICK: Pen = Pen::new(0.25, "#a33b00");
const SMALL: f64 = 3.2;
/// Length of the ticks of bevels \[mm\].
const TICKS: f64 = 6.0;

/// A frame with what is drawn around it.
#[derive(Debug, Clone, Copy)]
pub struct LoftSheet<'a> {
    /// Name of the ship.
    pub ship: &'a str,
    /// What the frame is called, with its position.
    pub title: &'a str,
    /// Which face of the skin it is.
    pub face: &'a str,
    /// The frame.
    pub frame: &'a LoftedFrame,
    /// Heights of waterlines, and distances of buttocks from the centreplane \[m\].
    pub waterlines: &'a [f64],
    /// The distances of buttocks.
    pub buttocks: &'a [f64],
}

impl LoftSheet<'_> {
    /// Greatest half-breadth, least and greatest height \[m\].
    fn extents(&self) -> [f64; 3] {
        self.frame.points().fold([0.0, f64::INFINITY, f64::NEG_INFINITY], |[y, low, high], p| {
            [y.max(p.y), low.min(p.z), high.max(p.z)]
        })
    }
}

/// Where the drawing lies on a sheet: the point of the hull in the lower left corner of the window \[m\].
struct View {
    window: Rectangle,
    origin: [f64; 2],
}

impl View {
    fn place(&self, y: f64, z: f64) -> [f64; 2] {
        let [y0, z0] = self.origin;
        [self.window.left + FULL * (y - y0), self.window.bottom - FULL * (z - z0)]
    }

    fn line(&self, points: &[FramePoint]) -> Vec<[f64; 2]> {
        points.iter().map(|point| self.place(point.y, point.z)).collect()
    }

    fn shows(&self, [x, y]: [f64; 2]) -> bool {
        let Rectangle { left, top, right, bottom } = self.window;
        (left..=right).contains(&x) && (top..=bottom).contains(&y)
    }
}

/// A length as a label \[m\].
fn label(length: f64) -> String {
    format!("{length:.3}")
}

fn draw(canvas: &mut Canvas, sheet: &LoftSheet<'_>, view: &View) {
    let [breadth, low, high] = sheet.extents();
    let Rectangle { left, bottom, .. } = view.window;
    canvas.begin_clip(&view.window);
    let across = |canvas: &mut Canvas, z: f64, pen: &Pen| {
        canvas.line(view.place(0.0, z), view.place(breadth + 0.02, z), pen);
    };
    let up = |canvas: &mut Canvas, y: f64, pen: &Pen| {
        canvas.line(view.place(y, low - 0.02), view.place(y, high + 0.02), pen);
    };
    sheet.waterlines.iter().for_each(|z| across(canvas, *z, &GRID));
    sheet.buttocks.iter().for_each(|y| up(canvas, *y, &GRID));
    across(canvas, 0.0, &AXIS);
    up(canvas, 0.0, &AXIS);
    for branch in &sheet.frame.branches {
        canvas.polyline(&view.line(branch), &OUTLINE);
    }
    let marked: Vec<FramePoint> = sheet.waterlines.iter().filter_map(|z| sheet.frame.at_height(*z)).collect();
    for point in &marked {
        let [x, y] = view.place(point.y, point.z);
        canvas.line([x, y], [x - TICKS, y], &TICK);
    }
    canvas.end_group();
    let style = TextStyle::new(SMALL, Anchor::Start).halo();
    for point in marked {
        let [x, y] = view.place(point.y, point.z);
        let at = [x - TICKS - 1.0, y - 2.4];
        let text = format!("{:+.1}°", point.bevel.to_degrees());
        let place = Canvas::text_place(at, &text, &TextStyle::new(SMALL, Anchor::End).halo());
        if view.window.contains(&place) && view.shows([x, y]) {
            canvas.text(at, &text, &TextStyle::new(SMALL, Anchor::End).coloured("#a33b00").halo());
        }
    }
    let mut named = |at: [f64; 2], text: String| {
        if view.window.contains(&Canvas::text_place(at, &text, &style)) {
            canvas.text(at, &text, &style);
        }
    };
    for z in sheet.waterlines {
        let y = view.place(0.0, *z)[1];
        named([left + 1.5, y - 2.2], format!("WL {}", label(*z)));
    }
    for distance in sheet.buttocks {
        let x = view.place(*distance, 0.0)[0];
        named([x + 1.0, bottom - 3.0], format!("B {}", label(*distance)));
    }
}

/// The frame at true size on a sheet of its own.
#[must_use]
pub fn loft_frame(sheet: &LoftSheet<'_>) -> Svg {
    let [breadth, low, high] = sheet.extents();
    let low = low.min(0.0);
    let (wide, tall) = (FULL * breadth + 2.0 * ROOM, FULL * (high - low) + 2.0 * ROOM);
    let mut canvas = Canvas::new(wide, tall);
    let window = Rectangle::new(2.0, 2.0, wide - 2.0, tall - 2.0);
    let view = View { window, origin: [(2.0 - ROOM) / FULL, low - (ROOM - 2.0) / FULL] };
    draw(&mut canvas, sheet, &view);
    let words = format!("{}: {}, {}; 1:1", sheet.ship, sheet.title, sheet.face);
    canvas.text([ROOM, 8.0], &words, &TextStyle::new(5.0, Anchor::Start));
    check_bar(&mut canvas, [ROOM, 18.0]);
    Svg::new(canvas.finish(&words))
}

/// A bar by which the print is checked.
fn check_bar(canvas: &mut Canvas, [x, y]: [f64; 2]) {
    canvas.line([x, y], [x + 100.0, y], &EDGE);
    for end in [x, x + 100.0] {
        canvas.line([end, y - 1.5], [end, y + 1.5], &EDGE);
    }
    canvas.text([x + 103.0, y], "100 mm", &TextStyle::new(SMALL, Anchor::Start));
}

/// Whether a line has a part in a window, by Liang and Barsky (1984).
fn passes(points: &[[f64; 2]], window: &Rectangle) -> bool {
    let sides = [[window.left, window.right], [window.top, window.bottom]];
    points.windows(2).any(|pair| {
        let mut part = [0.0_f64, 1.0_f64];
        for (k, [low, high]) in sides.into_iter().enumerate() {
            let (from, along) = (pair[0][k], pair[1][k] - pair[0][k]);
            if along.abs() <= 0.0 {
                if from < low || from > high {
                    return false;
                }
                continue;
            }
            let ends = [(low - from) / along, (high - from) / along];
            part = [part[0].max(ends[0].min(ends[1])), part[1].min(ends[0].max(ends[1]))];
        }
        part[0] <= part[1]
    })
}

/// The window of a tile on its paper.
fn tile_window() -> Rectangle {
    let [wide, tall] = Sheet::A3.size();
    Rectangle::new(MARGIN[0], MARGIN[1], wide - MARGIN[0], tall - MARGIN[1])
}

/// The tiles that the outline of a frame passes, by row and column, and how many rows and columns there are.
fn tiles(sheet: &LoftSheet<'_>) -> (Vec<([usize; 2], View)>, [usize; 2]) {
    let [breadth, low, high] = sheet.extents();
    let low = low.min(0.0);
    let window = tile_window();
    let start = [-0.02, low - 0.02];
    let count = |extent: f64, size: f64| (((extent + 0.04) * FULL) / size).ceil().max(1.0) as usize;
    let (columns, rows) = (count(breadth, window.width()), count(high - low, window.height()));
    let places = (0..rows).flat_map(|row| (0..columns).map(move |column| [row, column]));
    let view = |[row, column]: [usize; 2]| {
        let origin = [start[0] + column as f64 * window.width() / FULL, start[1] + row as f64 * window.height() / FULL];
        ([row, column], View { window, origin })
    };
    let passed =
        |(_, view): &([usize; 2], View)| sheet.frame.branches.iter().any(|line| passes(&view.line(line), &view.window));
    (places.map(view).filter(passed).collect(), [rows, columns])
}

/// How many tiles of A3 a frame takes.
#[must_use]
pub fn loft_tile_count(sheet: &LoftSheet<'_>) -> usize {
    tiles(sheet).0.len()
}

/// The frame at true size on tiles of A3, row by row from the keel; those that its outline does not pass are left out. They
/// are trimmed at their windows and laid edge to edge.
#[must_use]
pub fn loft_tiles(sheet: &LoftSheet<'_>) -> Vec<(String, Svg)> {
    let [wide, tall] = Sheet::A3.size();
    let (tiles, [rows, columns]) = tiles(sheet);
    let drawn = |([row, column], view): ([usize; 2], View)| {
        let mut canvas = Canvas::new(wide, tall);
        draw(&mut canvas, sheet, &view);
        canvas.rectangle(&view.window, &EDGE);
        let place =
            format!("row {} of {rows} from the keel, column {} of {columns} from the centreline", row + 1, column + 1);
        let words = format!("{}: {}, {}; 1:1; {place}", sheet.ship, sheet.title, sheet.face);
        canvas.text([MARGIN[0], 10.0], &words, &TextStyle::new(3.8, Anchor::Start));
        check_bar(&mut canvas, [MARGIN[0], 16.5]);
        let svg = Svg::new(canvas.finish(&words));
        (words, svg)
    };
    tiles.into_iter().map(drawn).collect()
}
