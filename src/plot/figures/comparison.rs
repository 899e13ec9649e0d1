//! Two hulls over each other: their body plans, the first in grey, and their curves of areas without dimensions.

use crate::hull::{Hull, SectionalAreaCurve, StationNumbers};
use crate::plot::paper::canvas::{Anchor, Canvas, Pen, Rectangle, TextStyle};
use crate::plot::paper::chart::{Axis, Chart, Series, colour};
use crate::plot::paper::error::PlotError;
use crate::plot::paper::font::{LEAST_LETTERS, LETTERS};
use crate::plot::paper::label::LabelPlacer;
use crate::plot::paper::scale::{drawing_scale, nice_step};
use crate::plot::paper::sheet::Sheet;
use crate::plot::paper::svg::Svg;
use crate::plot::ship::lines_grid::LinesGrid;
use crate::plot::ship::view::{BASE, GRID, View};
use crate::plot::ship::{caption, outline};

/// Sections of the first hull and of the second.
const FIRST: Pen = Pen::new(0.45, "#9a9a9a");
const SECOND: Pen = Pen::new(0.35, "#0b3d78");
const DECK: [Pen; 2] = [Pen::new(0.6, "#9a9a9a"), Pen::new(0.5, "#0b3d78")];
/// The waterlines at the draughts.
const AFLOAT: [Pen; 2] =
    [Pen::new(0.3, "#9a9a9a").dashed(&[6.0, 1.0, 0.8, 1.0]), Pen::new(0.25, "#0b3d78").dashed(&[6.0, 1.0, 0.8, 1.0])];
/// Room at the sides, above and below the plans \[mm\].
const ROOM: [f64; 3] = [26.0, 32.0, 16.0];
/// How far lines go beyond the hulls \[mm\].
const BEYOND: f64 = 4.0;
/// Deviation of chords on paper \[mm\].
const DEVIATION: f64 = 0.02;
/// Size of the sheet of the curves \[mm\].
const SHEET: [f64; 2] = [260.0, 165.0];
/// Stations of a curve of areas, and how far inside its ends it begins, as a part of its length.
const STATIONS: usize = 301;
const INSIDE: f64 = 1e-4;

/// What is drawn of two hulls.
#[derive(Debug, Clone, Copy)]
pub struct ComparedHulls<'a> {
    /// The hulls.
    pub hulls: [&'a Hull; 2],
    /// Their names.
    pub names: [&'a str; 2],
    /// What they are to each other.
    pub roles: [&'static str; 2],
    /// Their draughts \[m\], where they are stated.
    pub draughts: [Option<f64>; 2],
    /// How stations are numbered.
    pub stations: StationNumbers,
    /// A line of words under the titles.
    pub words: &'a str,
}

/// The body plans over each other: aft sections on the left. Stations have the same number on both, and stand at the same
/// part of the length of each.
///
/// # Errors
/// [`PlotError::Chart`] for hulls without breadth or height.
pub fn compared_body_plans(compared: &ComparedHulls<'_>) -> Result<Svg, PlotError> {
    let breadth = compared.hulls[0].particulars().breadth;
    let grids = compared.hulls.map(|hull| LinesGrid::new(hull, 1e-3 * breadth, compared.stations, None));
    let half = grids.iter().map(|grid| grid.half_breadth).fold(0.0, f64::max);
    let low = grids.iter().map(|grid| grid.height[0]).fold(0.0, f64::min);
    let high = grids.iter().map(|grid| grid.height[1]).fold(f64::NEG_INFINITY, f64::max);
    if half <= 0.0 || high <= low {
        return Err(PlotError::Chart("the hulls have no sections".to_owned()));
    }
    let paper = Sheet::A3.room();
    let [side, top, foot] = ROOM;
    let scale = drawing_scale(2.0 * half, paper[0] - 2.0 * side).max(drawing_scale(high - low, paper[1] - top - foot));
    let millimetres = 1000.0 / f64::from(scale);
    let size =
        [(2.0 * half * millimetres + 2.0 * side).max(200.0).ceil(), ((high - low) * millimetres + top + foot).ceil()];
    let grids = grids.map(|grid| grid.refined(DEVIATION / millimetres));
    let view = View::new([0.5 * size[0], size[1] - foot + low * millimetres], scale);
    let mut canvas = Canvas::new(size[0], size[1]);
    let words = format!("1 : {scale}   {}", compared.words);
    caption::head(&mut canvas, size[0], "BODY PLANS", &joined(compared.names), &words);
    draw_frame(&mut canvas, &view, compared, [half, low, high]);
    let mut placer = LabelPlacer::default();
    for text in canvas.texts() {
        placer.take(text.place);
    }
    for (k, (grid, hull)) in grids.iter().zip(compared.hulls).enumerate() {
        let midship = 0.5 * hull.particulars().length_between_perpendiculars;
        draw_sections(&mut canvas, &mut placer, (grid, &view), midship, k);
    }
    let midship = 0.5 * compared.hulls[1].particulars().length_between_perpendiculars;
    name_sections(&mut canvas, &mut placer, &grids[1], &view, midship);
    key(&mut canvas, compared, size);
    Ok(Svg::new(canvas.finish("compared-body-plans")))
}

fn joined(names: [&str; 2]) -> String {
    let [first, second] = names.map(caption::plain);
    // A daughter bears the name of its parent.
    if second.starts_with(&first) {
        return second;
    }
    [first, second].map(|name| name.chars().take(18).collect::<String>()).join(" / ")
}

/// Base line, centre line, and both waterlines with their draughts.
fn draw_frame(canvas: &mut Canvas, view: &View, compared: &ComparedHulls<'_>, [half, low, high]: [f64; 3]) {
    let reach = half + BEYOND / view.scale;
    canvas.line(view.at([-reach, 0.0]), view.at([reach, 0.0]), &BASE);
    canvas.line(view.at([0.0, low]), view.at([0.0, high]), &BASE);
    let style = TextStyle::new(LETTERS, Anchor::Start);
    let mut named: Option<f64> = None;
    for (k, draught) in compared.draughts.iter().enumerate().rev() {
        let Some(draught) = *draught else { continue };
        canvas.line(view.at([-reach, draught]), view.at([reach, draught]), &AFLOAT[k]);
        let [x, y] = view.at([reach, draught]);
        // Two names at one height are one.
        let shift = named.map_or(0.0, |other: f64| if (other - y).abs() < 1.3 * LETTERS { 1.4 * LETTERS } else { 0.0 });
        if named.is_none_or(|other| (other - y).abs() > 1e-6) {
            let style = style.coloured(if k == 0 { "#6a6a6a" } else { SECOND.colour });
            canvas.text([x + 1.5, y + shift], &format!("T {draught:.2}"), &style);
        }
        named = Some(y);
    }
    for y in [-half, half] {
        canvas.line(view.at([y, low]), view.at([y, high]), &GRID);
    }
}

/// -1 for what stands on the left, 1 on the right; both for the section at midship.
fn sides(x: f64, midship: f64) -> Vec<f64> {
    let slack = 1e-6 * midship.abs();
    [(-1.0, x <= midship + slack), (1.0, x >= midship - slack)].into_iter().filter(|s| s.1).map(|s| s.0).collect()
}

fn draw_sections(
    canvas: &mut Canvas,
    placer: &mut LabelPlacer,
    (grid, view): (&LinesGrid, &View),
    midship: f64,
    which: usize,
) {
    canvas.begin_group(["first", "second"][which]);
    let pen = [&FIRST, &SECOND][which];
    for plane in &grid.stations {
        for side in sides(plane.at, midship) {
            for curve in plane.curves.iter().take(plane.on_side) {
                let placed = view.draw(canvas, curve.iter().map(|p| [side * p[1], p[2]]), pen);
                placer.add_curve(&placed);
            }
        }
    }
    for side in [-1.0, 1.0] {
        let deck = grid.deck.iter().filter(|p| sides(p[0], midship).contains(&side));
        view.draw(canvas, deck.map(|p| [side * p[1], p[2]]).collect::<Vec<_>>(), &DECK[which]);
    }
    for (end, side) in grid.ends.iter().zip([-1.0, 1.0]) {
        if end.iter().any(|p| p[1] * view.scale > 0.1) {
            view.draw(canvas, end.iter().map(|p| [side * p[1], p[2]]), &DECK[which]);
        }
    }
    canvas.end_group();
}

/// Numbers of the stations of the second hull over the ends of its sections at the deck.
fn name_sections(canvas: &mut Canvas, placer: &mut LabelPlacer, grid: &LinesGrid, view: &View, midship: f64) {
    let window = Rectangle::new(4.0, 20.0, canvas.frame().right - 4.0, canvas.frame().bottom - 8.0);
    let style = TextStyle::new(LETTERS, Anchor::Middle).coloured(SECOND.colour).halo();
    for plane in grid.stations.iter().filter(|plane| plane.whole) {
        for side in sides(plane.at, midship) {
            let points = plane.curves.iter().take(plane.on_side).flatten();
            let Some(top) = points.max_by(|a, b| a[2].total_cmp(&b[2])) else { continue };
            let [x, y] = view.at([side * top[1], top[2]]);
            let places: Vec<[f64; 2]> =
                (0..4).flat_map(|k| [0.0, 2.0, -2.0].map(|aside| [x + aside, y - 3.0 - 3.2 * f64::from(k)])).collect();
            placer.name_clear(canvas, &plane.name, &style, &places, &window);
        }
    }
}

/// Which colour is which hull.
fn key(canvas: &mut Canvas, compared: &ComparedHulls<'_>, size: [f64; 2]) {
    let style = TextStyle::new(LETTERS, Anchor::Start);
    let y = size[1] - 5.0;
    let named = compared.roles.iter().zip(compared.names);
    for (k, ((role, name), x)) in named.zip([8.0, 0.5 * size[0] - 20.0]).enumerate() {
        canvas.line([x, y], [x + 12.0, y], &Pen { width: 0.8, ..DECK[k] });
        let name: String = caption::plain(name).chars().take(24).collect();
        canvas.text([x + 14.0, y], &format!("{role}: {name}"), &style);
    }
    canvas.text([size[0] - 4.0, y], &caption::program(), &TextStyle::new(LEAST_LETTERS, Anchor::End));
}

/// The curve of areas over B T, over x over L_PP: what is below it is C_B.
fn areas(hull: &Hull, draught: f64) -> Vec<[f64; 2]> {
    let p = hull.particulars();
    let [aft, fore] = outline::immersed_length(hull, draught);
    let (from, whole) = (aft + INSIDE * (fore - aft), (1.0 - 2.0 * INSIDE) * (fore - aft));
    let stations: Vec<f64> = (0..STATIONS).map(|k| from + whole * k as f64 / (STATIONS - 1) as f64).collect();
    let curve = SectionalAreaCurve::new(hull, draught, &stations);
    let scaled = |x: f64, area: f64| [x / p.length_between_perpendiculars, area / (p.breadth * draught)];
    let mut points: Vec<[f64; 2]> = stations.iter().zip(&curve.areas).map(|(&x, &area)| scaled(x, area)).collect();
    points.insert(0, scaled(aft, 0.0));
    points.push(scaled(fore, 0.0));
    points
}

/// The curves of areas of both hulls, each at its draught; none where one has none.
///
/// # Errors
/// [`PlotError`] when the chart cannot be drawn.
pub fn compared_areas(compared: &ComparedHulls<'_>) -> Result<Option<Svg>, PlotError> {
    let [Some(first), Some(second)] = compared.draughts else { return Ok(None) };
    let curves = [areas(compared.hulls[0], first), areas(compared.hulls[1], second)];
    let all = || curves.iter().flatten();
    let low = all().map(|p| p[0]).fold(0.0, f64::min);
    let high = all().map(|p| p[0]).fold(1.0, f64::max);
    let most = all().map(|p| p[1]).fold(0.0, f64::max);
    let room = 0.02 * (high - low);
    let chart = Chart {
        frame: Rectangle::new(24.0, 26.0, SHEET[0] - 14.0, SHEET[1] - 24.0),
        left: Axis::new("A / (B T) [-]", 0.0, 1.02 * most, 10.0),
        right: None,
        top: None,
        bottom: Axis::exact("x forward of AP / L_PP [-]", low - room, high + room, nice_step(high - low, 12.0)),
        text_size: 2.8,
    };
    let mut canvas = Canvas::new(SHEET[0], SHEET[1]);
    caption::head(&mut canvas, SHEET[0], "CURVES OF AREAS", &joined(compared.names), compared.words);
    let [old, new] = curves;
    let [before, after] = compared.roles;
    let series = [
        Series { name: before, points: old, secondary: false, colour: colour::GREY, dash: None, name_at: 0.3 },
        Series { name: after, points: new, secondary: false, colour: colour::BLUE, dash: None, name_at: 0.75 },
    ];
    chart.draw(&mut canvas, &mut LabelPlacer::default(), &series, &[])?;
    let style = TextStyle::new(LEAST_LETTERS, Anchor::Start);
    canvas.text([6.0, SHEET[1] - 4.0], "the area below a curve is C_B", &style);
    canvas.text([SHEET[0] - 6.0, SHEET[1] - 4.0], &caption::program(), &TextStyle { anchor: Anchor::End, ..style });
    Ok(Some(Svg::new(canvas.finish("compared-areas"))))
}
