//! The body plan alone.

use crate::plot::paper::canvas::{Anchor, Canvas, TextStyle};
use crate::plot::paper::error::PlotError;
use crate::plot::paper::font::{LEAST_LETTERS, LETTERS};
use crate::plot::paper::scale::drawing_scale;
use crate::plot::paper::sheet::Sheet;
use crate::plot::ship::body_plan::{BOTTOM_ROOM, SIDE_ROOM, TOP_ROOM};
use crate::plot::ship::inputs::FigureInputs;
use crate::plot::ship::lines_grid::LinesGrid;
use crate::plot::ship::view::View;
use crate::plot::ship::{body_plan, caption};

/// Room for the title [mm].
const TITLE: f64 = 22.0;
/// Deviation of chords from their curves on paper [mm].
const DEVIATION: f64 = 0.004;

/// Draws the body plan on a sheet as large as it needs, at a scale of the list that fits into the frame of `sheet`.
#[allow(clippy::unnecessary_wraps, reason = "every figure may fail")]
pub(in crate::plot) fn draw(inputs: &FigureInputs, sheet: Sheet) -> Result<Canvas, PlotError> {
    let paper = sheet.room();
    let hull = inputs.hull;
    let p = hull.particulars();
    let rooms = [2.0 * SIDE_ROOM + 18.0, TITLE + TOP_ROOM + BOTTOM_ROOM + 8.0];
    let numbers = inputs.curves.conventions.stations;
    let table = inputs.record.map(|record| &record.lines);
    let coarse = LinesGrid::new(hull, 1e-3 * p.breadth, numbers, table);
    let extent = [2.0 * coarse.half_breadth, coarse.height[1] - coarse.height[0].min(0.0)];
    let scale = drawing_scale(extent[0], paper[0] - rooms[0]).max(drawing_scale(extent[1], paper[1] - rooms[1]));
    let millimetres = 1000.0 / f64::from(scale);
    let lowest = coarse.height[0].min(0.0);
    let grid = coarse.refined(DEVIATION / millimetres);
    // What fits to rounding does not grow by a millimetre.
    let size =
        [(extent[0] * millimetres + rooms[0]).max(180.0), extent[1] * millimetres + rooms[1]].map(|side| side - 1e-6);
    let mut canvas = Canvas::new(size[0].ceil(), size[1].ceil());
    let centre = 0.5 * size[0].ceil();
    // A picture of A3 is read on a screen, where letters grow with it; on larger sheets they have the size of those of
    // a lines plan.
    let letters = (LETTERS * size[0].ceil() / Sheet::A3.size()[0]).clamp(LEAST_LETTERS, LETTERS);
    let title = format!("BODY PLAN – {}", caption::plain(hull.name()));
    canvas.text([centre, 8.0], &title, &TextStyle::new(4.5, Anchor::Middle));
    let line = format!(
        "1 : {scale}   {}   {}, {}   moulded{}",
        caption::dimensions(inputs),
        if grid.numbered { caption::stations(inputs) } else { "stations".to_owned() },
        if grid.of_table[0] { "those of the table" } else { "half stations at the ends" },
        caption::assumed_note(inputs, "   ")
    );
    canvas.text([centre, 15.0], &line, &TextStyle::new(letters.max(2.6), Anchor::Middle));
    // z = 0 stands as far above the lower room as the hull reaches below it.
    let base = size[1].ceil() - BOTTOM_ROOM - 6.0 + lowest * millimetres;
    let view = View::new([centre, base], scale);
    body_plan::draw(&mut canvas, inputs, &grid, &view, letters / 0.9);
    canvas.text(
        [size[0].ceil() - 4.0, size[1].ceil() - 2.8],
        &caption::program(),
        &TextStyle::new(letters, Anchor::End),
    );
    Ok(canvas)
}
