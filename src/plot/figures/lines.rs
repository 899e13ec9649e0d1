//! The lines plan on A3 or A1: profile, half-breadth plan and body plan in true proportion at scales of the list, with
//! a title block and a table of half-breadths. Diagonals in their true shape always stand under the half-breadth plan:
//! they are the judge of fairness, and worth a smaller scale. Where a larger scale is had for it, names stand at one end
//! of the long views alone.

use crate::plot::paper::canvas::{Anchor, Canvas, Pen, Rectangle, TextStyle};
use crate::plot::paper::error::PlotError;
use crate::plot::paper::font::LETTERS;
use crate::plot::paper::scale::{drawing_scale, drawing_scales};
use crate::plot::paper::sheet::Sheet;
use crate::plot::ship::extent::midship_of;
use crate::plot::ship::extrapolated::{BEYOND, is_guessed};
use crate::plot::ship::inputs::FigureInputs;
use crate::plot::ship::lines_grid::{GridPlane, LinesGrid};
use crate::plot::ship::profile::{LongStyle, Naming};
use crate::plot::ship::title_block::Scales;
use crate::plot::ship::view::{BEFORE, STATION, View};
use crate::plot::ship::{body_plan, profile, title_block};

/// Distance of drawings from the frame and from each other [mm].
const GAP: f64 = 5.0;
/// Height of the name of a view [mm].
const VIEW_TITLE: f64 = 6.0;
/// Size of the text at the grid [mm]; its capitals are 2.5 mm high.
const TEXT: f64 = 3.5;
/// Narrowest column that a body plan is set in beside the long views [mm].
const BODY_COLUMN: f64 = 128.0;
/// What fits to rounding fits [mm].
const ROUNDING: f64 = 1e-9;
/// Deviation of chords from their curves on paper [mm].
const DEVIATION: f64 = 0.004;

/// Sizes of the views [m].
struct Extents {
    length: f64,
    height: f64,
    half_breadth: f64,
    /// Largest distance along a diagonal.
    diagonals: f64,
    /// Smallest table of half-breadths [mm].
    table: [f64; 2],
}

impl Extents {
    fn new(grid: &LinesGrid) -> Self {
        Self {
            length: grid.length[1] - grid.length[0],
            height: grid.height[1] - grid.height[0].min(0.0),
            half_breadth: grid.half_breadth,
            diagonals: profile::diagonal_reach(grid),
            table: title_block::smallest_table(grid),
        }
    }

    /// Width of the long views and heights of profile and half-breadth plan at 1 : `scale` with their names [mm].
    fn long_views(&self, scale: u32, style: LongStyle) -> [f64; 3] {
        let millimetres = 1000.0 / f64::from(scale);
        let ends = profile::TOP_ROOM + profile::END_ROOM + VIEW_TITLE;
        [
            self.length * millimetres + style.naming.rooms().iter().sum::<f64>(),
            self.height * millimetres + ends,
            (self.half_breadth + self.diagonals) * millimetres + ends,
        ]
    }

    /// What a layout is worth: the fourth power of the scale of the two long views times that of the body plan, so that
    /// a body plan twice as large is not worth a step of the long views; a third of it when the table does not fit.
    fn merit(&self, layout: &Layout) -> f64 {
        let [long, body] = [layout.scale, layout.body_scale].map(|scale| 1000.0 / f64::from(scale));
        let table =
            layout.table.width() >= self.table[0] - ROUNDING && layout.table.height() >= self.table[1] - ROUNDING;
        long.powi(4) * body * if table { 1.0 } else { 0.35 }
    }

    /// Height of the body plan with its names at 1 : `scale` [mm].
    fn body_height(&self, scale: u32) -> f64 {
        self.height * 1000.0 / f64::from(scale) + body_plan::TOP_ROOM + body_plan::BOTTOM_ROOM + VIEW_TITLE
    }

    /// Width of the body plan with its names at 1 : `scale` [mm].
    fn body_width(&self, scale: u32) -> f64 {
        2.0 * self.half_breadth * 1000.0 / f64::from(scale) + 2.0 * body_plan::SIDE_ROOM
    }

    /// The largest scale at which the body plan fits into `room`.
    fn body_scale(&self, room: &Rectangle) -> u32 {
        let width = room.width() - 2.0 * body_plan::SIDE_ROOM;
        let height = room.height() - body_plan::TOP_ROOM - body_plan::BOTTOM_ROOM - VIEW_TITLE;
        drawing_scale(2.0 * self.half_breadth, width).max(drawing_scale(self.height, height))
    }
}

/// Where the views stand.
struct Layout {
    scale: u32,
    style: LongStyle,
    body_scale: u32,
    profile: Rectangle,
    half_breadths: Rectangle,
    body: Rectangle,
    table: Rectangle,
}

/// The long views at a scale: their width, and the heights of profile and half-breadth plan [mm].
struct Long {
    scale: u32,
    style: LongStyle,
    views: [f64; 3],
}

/// The layout of most merit, of those at scales of the list that leave the views their room, with the body
/// plan beside or below the long views.
fn layout(extents: &Extents, frame: &Rectangle) -> Layout {
    let inner = frame.grown(-GAP);
    let mut best: Option<(f64, Layout)> = None;
    let styles = Naming::ALL.map(|naming| LongStyle { text_size: TEXT, naming });
    for (style, scale) in styles.into_iter().flat_map(|style| drawing_scales().map(move |scale| (style, scale))) {
        let views = extents.long_views(scale, style);
        let long = Long { scale, style, views };
        let choices = beside(extents, &long, &inner).into_iter().chain(below(extents, &long, &inner));
        for choice in choices {
            let merit = extents.merit(&choice);
            if best.as_ref().is_none_or(|(most, _)| merit > *most * (1.0 + 1e-9)) {
                best = Some((merit, choice));
            }
        }
    }
    let nothing = Rectangle::new(inner.left, inner.top, inner.right, inner.top);
    let otherwise = Layout {
        scale: 1_000_000,
        style: LongStyle { text_size: TEXT, naming: Naming::Full },
        body_scale: 1_000_000,
        profile: nothing,
        half_breadths: nothing,
        body: nothing,
        table: nothing,
    };
    best.map_or(otherwise, |(_, layout)| layout)
}

/// The long views in a column on the left with the table under them, the body plan on the right.
fn beside(extents: &Extents, long: &Long, inner: &Rectangle) -> Option<Layout> {
    let Long { scale, style, views: [width, profile, half] } = *long;
    let spare = inner.height() - profile - half;
    if inner.width() - width - GAP < BODY_COLUMN || spare < GAP {
        return None;
    }
    let gap = if spare > 90.0 { 0.25 * (spare - 60.0) } else { GAP.min(0.5 * spare) };
    let right = inner.left + width;
    let upper = Rectangle::new(inner.left, inner.top, right, inner.top + profile);
    let lower = Rectangle::new(inner.left, upper.bottom + gap, right, upper.bottom + gap + half);
    let body = Rectangle::new(right + GAP, inner.top, inner.right, inner.bottom - title_block::SIZE[1] - GAP);
    let table = Rectangle::new(inner.left, lower.bottom + GAP, right, inner.bottom);
    let body_scale = extents.body_scale(&body);
    Some(Layout { scale, style, body_scale, profile: upper, half_breadths: lower, body, table })
}

/// The long views one under the other, the body plan under them, table and title block to its right: at the largest
/// scale of the body plan, and at smaller ones that may leave more room to the table.
fn below(extents: &Extents, long: &Long, inner: &Rectangle) -> Vec<Layout> {
    let Long { scale, style, views: [width, profile, half] } = *long;
    let body_height = inner.height() - profile - half - 2.0 * GAP;
    if width > inner.width() || body_height < title_block::SIZE[1] + 5.0 {
        return Vec::new();
    }
    let column = inner.right - title_block::SIZE[0] - GAP;
    let room = Rectangle::new(inner.left, inner.bottom - body_height, column, inner.bottom);
    let largest = extents.body_scale(&room);
    let arrange = |body_scale: u32| {
        // What the body plan leaves parts the views.
        let spare = 0.4 * (body_height - extents.body_height(body_scale)).max(0.0);
        // ... but for the table over the title block.
        let table = inner.bottom - title_block::SIZE[1] - GAP - extents.table[1];
        let gap = GAP + spare.min(0.5 * (table - inner.top - profile - half) - GAP).max(0.0);
        let left = inner.left + 0.5 * (inner.width() - width);
        let upper = Rectangle::new(left, inner.top, left + width, inner.top + profile);
        let lower = Rectangle::new(left, upper.bottom + gap, left + width, upper.bottom + gap + half);
        let top = lower.bottom + gap;
        // The table stands over the title block, or else between it and the body plan.
        let wide = column.min(inner.right - extents.table[0] - 0.5 * GAP);
        let column = wide.max(inner.left + extents.body_width(body_scale) + GAP).min(column);
        let over = Rectangle::new(column, top, inner.right, inner.bottom - title_block::SIZE[1] - GAP);
        let beside = column - extents.table[0] - GAP;
        let between =
            over.height() < extents.table[1] - ROUNDING && beside - GAP - inner.left >= extents.body_width(body_scale);
        let right = if between { beside - GAP } else { column };
        // Names beside the body plan stay off the frame of the table.
        let right = (right - GAP).max(inner.left + extents.body_width(body_scale)).min(right);
        let body = Rectangle::new(inner.left, top, right, inner.bottom);
        let table = if between { Rectangle::new(beside, top, column - GAP, inner.bottom) } else { over };
        Layout { scale, style, body_scale, profile: upper, half_breadths: lower, body, table }
    };
    drawing_scales().filter(|&body_scale| body_scale >= largest).take(4).map(arrange).collect()
}

/// The curves of planes before fairing, in grey.
fn draw_before(
    canvas: &mut Canvas,
    view: &View,
    planes: &[GridPlane],
    project: impl Fn(&[f64; 3], &GridPlane) -> [f64; 2],
) {
    for plane in planes {
        for curve in &plane.curves {
            view.draw(canvas, curve.iter().map(|point| project(point, plane)), &BEFORE);
        }
    }
}

/// Right edge of what stands inside the frame \[mm\].
fn inner_right(frame: &Rectangle) -> f64 {
    frame.right - GAP
}

/// What is grey and what is not, up to `end`.
fn key(canvas: &mut Canvas, end: [f64; 2]) {
    let style = TextStyle::new(LETTERS, Anchor::End);
    let [mut x, y] = end;
    for (pen, words) in [(&STATION, "black and colours: after"), (&BEFORE, "grey: before fairing")] {
        canvas.text([x, y], words, &style);
        x = Canvas::text_place([x, y], words, &style).left - 2.0;
        canvas.line([x - 12.0, y], [x, y], pen);
        x -= 20.0;
    }
}

/// Draws the sheet.
#[allow(clippy::unnecessary_wraps, reason = "every figure may fail")]
pub(in crate::plot) fn draw(inputs: &FigureInputs, sheet: Sheet) -> Result<Canvas, PlotError> {
    let hull = inputs.hull;
    let numbers = inputs.curves.conventions.stations;
    let table = inputs.record.map(|record| &record.lines);
    let coarse = LinesGrid::new(hull, 1e-3 * hull.particulars().breadth, numbers, table);
    let extents = Extents::new(&coarse);
    let frame = sheet.frame();
    let layout = layout(&extents, &frame);
    let body_scale = layout.body_scale;
    let grid = coarse.refined(DEVIATION * 1e-3 * f64::from(body_scale.min(layout.scale)));
    let before =
        inputs.before.map(|before| LinesGrid::new(before, DEVIATION * 1e-3 * f64::from(layout.scale), numbers, table));
    let mut canvas = Canvas::new(sheet.size()[0], sheet.size()[1]);
    canvas.rectangle(&frame, &Pen::new(0.7, "#000000"));
    let title = TextStyle::new(3.5, Anchor::Start);

    let style = layout.style;
    let millimetres = 1000.0 / f64::from(layout.scale);
    let origin_x = layout.profile.left + style.naming.rooms()[0] - grid.length[0] * millimetres;
    // The longest of the words that stays over its view.
    let name = |canvas: &mut Canvas, place: &Rectangle, words: &[&str], scale: u32| {
        let at = [place.left + 1.0, place.top + 2.0];
        let lines: Vec<String> = words.iter().map(|words| format!("{words}   1 : {scale}")).collect();
        let fitting = lines.iter().find(|line| Canvas::text_place(at, line, &title).right <= place.right);
        if let Some(line) = fitting.or(lines.last()) {
            canvas.text(at, line, &title);
        }
    };
    let dashed = format!("PROFILE ({BEYOND})");
    let words = if is_guessed(inputs) { &[dashed.as_str(), "PROFILE"][..] } else { &["PROFILE"] };
    name(&mut canvas, &layout.profile, words, layout.scale);
    if before.is_some() {
        key(&mut canvas, [inner_right(&frame), layout.profile.top + 2.0]);
    }
    let base = layout.profile.bottom - profile::END_ROOM + grid.height[0].min(0.0) * millimetres;
    let view = View::new([origin_x, base], layout.scale);
    if let Some(before) = &before {
        draw_before(&mut canvas, &view, &before.buttocks, |p, _| [p[0], p[2]]);
    }
    profile::draw_profile(&mut canvas, inputs, &grid, &view, style);

    let words = ["HALF-BREADTH PLAN, diagonals in true shape below", "HALF-BREADTH PLAN"];
    name(&mut canvas, &layout.half_breadths, &words, layout.scale);
    let centre = layout.half_breadths.bottom - profile::END_ROOM - extents.diagonals * millimetres;
    let view = View::new([origin_x, centre], layout.scale);
    if let Some(before) = &before {
        draw_before(&mut canvas, &view, &before.waterlines, |p, _| [p[0], p[1]]);
        draw_before(&mut canvas, &view, before.design_waterline.as_slice(), |p, _| [p[0], p[1]]);
        draw_before(&mut canvas, &view, &before.diagonals, |p, plane| {
            let [x, s] = LinesGrid::expanded(p, plane.at);
            [x, -s]
        });
    }
    profile::draw_half_breadths(&mut canvas, hull, &grid, &view, style);

    let needed = extents.body_height(body_scale);
    let foot = layout.body.top + needed.max(0.5 * (layout.body.height() + needed)) - body_plan::BOTTOM_ROOM;
    let middle = 0.5 * (layout.body.left + layout.body.right);
    let body_base = foot + grid.height[0].min(0.0) * 1000.0 / f64::from(body_scale);
    let top = foot - needed + body_plan::BOTTOM_ROOM;
    name(
        &mut canvas,
        &Rectangle { top, left: middle - 0.5 * extents.body_width(body_scale), ..layout.body },
        &["BODY PLAN"],
        body_scale,
    );
    let view = View::new([middle, body_base], body_scale);
    if let Some(before) = &before {
        let midship = midship_of(inputs);
        let side = |plane: &GridPlane| if plane.at < midship { -1.0 } else { 1.0 };
        draw_before(&mut canvas, &view, &before.stations, |p, plane| [side(plane) * p[1], p[2]]);
    }
    body_plan::draw(&mut canvas, inputs, &grid, &view, TEXT);

    let corner = [frame.right, frame.bottom];
    let scales = Scales { long: layout.scale, body: body_scale, sheet };
    title_block::draw(&mut canvas, inputs, &grid, scales, corner);
    title_block::draw_offsets(&mut canvas, inputs, &grid, &layout.table);
    Ok(canvas)
}
