//! A curve before and after fairing: combs of curvature at one scale with the inflections ringed, and the move of every
//! point within its tolerance.
//!
//! Curvature is that of the true curve, of a curve of areas its second derivative; the sheet may stretch ordinates, and
//! teeth stand normal to the line as it is drawn, on its convex side. Teeth that would leave the panel are cut off at its
//! edge, which is noted there: the scale is the same for both.

use crate::fairing::curve::{CurvePoint, FairCurve, FairStatus};
use crate::plot::paper::canvas::{Anchor, Canvas, Pen, Rectangle, TextStyle};
use crate::plot::paper::error::PlotError;
use crate::plot::paper::font::LEAST_LETTERS;
use crate::plot::paper::scale::{decimals, multiples, nice_step, sheet_scale};
use crate::plot::paper::svg::Svg;
use crate::plot::ship::caption;
use crate::spline::BsplineCurve;
use crate::units::counted;

/// Width and height of the sheet \[mm\].
const SHEET: [f64; 2] = [297.0, 222.0];
/// Left and right edge of the panels \[mm\].
const SIDES: [f64; 2] = [24.0, 285.0];
/// Top and bottom of the panels before and after \[mm\].
const PANELS: [[f64; 2]; 2] = [[22.0, 86.0], [96.0, 160.0]];
/// Top and bottom of the panel of moves \[mm\].
const MOVES: [f64; 2] = [174.0, 206.0];
/// Room above and below the curve for the teeth \[mm\].
const ROOM: f64 = 16.0;
/// The longest tooth of the fair curve \[mm\].
const TOOTH: f64 = 14.0;
/// Teeth over the length.
const TEETH: usize = 240;
/// Ordinates that differ by less than this part of the length are drawn as if they did.
const LEAST_RANGE: f64 = 1e-4;
/// Radius of the rings \[mm\].
const RING: f64 = 1.8;
const COMB: &str = "#2166ac";
const RED: &str = "#b30000";
const GREY: &str = "#808080";

/// What is drawn.
#[derive(Debug, Clone, Copy)]
pub struct CurveSheet<'a> {
    /// Name of the curve.
    pub name: &'a str,
    /// The points as they were used.
    pub given: &'a [CurvePoint],
    /// What came of them.
    pub fair: &'a FairCurve,
    /// Whether ordinates are lengths \[m\]; else they are areas \[m2\].
    pub lengths: bool,
}

impl CurveSheet<'_> {
    /// y'' / (1 + y'^2)^(3/2) of a curve of lengths, y'' of one of areas.
    fn curvature(&self, curve: &BsplineCurve<1>, x: f64) -> f64 {
        let d = curve.derivatives::<3>(x);
        let slope = if self.lengths { d[1][0] } else { 0.0 };
        d[2][0] / (1.0 + slope * slope).powf(1.5)
    }

    /// Unit of curvature.
    fn of_curvature(&self) -> &'static str {
        if self.lengths { "1/m" } else { "m2/m2 (second derivative)" }
    }

    /// Unit of a move, and its size.
    fn of_moves(&self) -> (&'static str, f64) {
        if self.lengths { ("mm", 1e-3) } else { ("m2", 1.0) }
    }

    /// What the marks mean that are there.
    fn key(&self) -> String {
        let points = &self.fair.points;
        let has = |mark: bool, words: &'static str| mark.then_some(words);
        let words = [
            has(self.fair.inflections.iter().any(|list| !list.is_empty()), "inflections ringed"),
            Some("dots: points as given"),
            has(points.iter().any(|point| point.tolerance.is_some_and(|t| t <= 0.0)), "squares: locked"),
            has(
                points.iter().any(|point| point.active && point.tolerance.is_some_and(|t| t > 0.0)),
                "triangles: at their tolerance",
            ),
            has(points.iter().any(|point| point.suspect), "crosses: left out"),
            has(self.given.iter().any(|point| point.knuckle), "K: knuckles"),
            has(self.given.iter().any(|point| point.tangent), "T: ends of straight parts"),
            has(self.given.iter().any(|point| point.weight < 1.0), "in brackets: doubtful"),
        ];
        words.into_iter().flatten().collect::<Vec<_>>().join(", ")
    }
}

/// Draws the figure.
///
/// # Errors
/// [`PlotError::Chart`] for a curve without length.
pub fn fair_curve_figure(sheet: &CurveSheet<'_>) -> Result<Svg, PlotError> {
    let CurveSheet { fair, given, .. } = *sheet;
    let (from, to) = fair.curve.knots().domain();
    if !(to > from && fair.points.len() > 1) {
        return Err(PlotError::Chart("the curve has no length".to_owned()));
    }
    let mut canvas = Canvas::new(SHEET[0], SHEET[1]);
    let title = format!("FAIRING OF A CURVE – {}", caption::plain(sheet.name));
    canvas.text([0.5 * SHEET[0], 8.0], &title, &TextStyle::new(4.5, Anchor::Middle));
    let abscissae: Vec<f64> = (0..=TEETH).map(|k| from + (to - from) * k as f64 / TEETH as f64).collect();
    let largest = abscissae.iter().fold(0.0_f64, |most, &x| most.max(sheet.curvature(&fair.curve, x).abs()));
    // Millimetres on paper for a curvature of 1/m.
    let unit = 1.0 / sheet_scale(largest.max(1e-12), TOOTH);
    let ordinates = fair.points.iter().filter_map(|p| p.before);
    let ordinates = ordinates.chain(abscissae.iter().map(|&x| fair.curve.eval(x)[0]));
    let (low, high) = ordinates.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), y| (a.min(y), b.max(y)));
    let height = PANELS[0][1] - PANELS[0][0] - 2.0 * ROOM;
    let scale_x = (SIDES[1] - SIDES[0]) / (to - from);
    let scale_y = height / (high - low).max(LEAST_RANGE * (to - from));
    let text = TextStyle::new(2.8, Anchor::Middle);
    let scales = format!(
        "combs at one scale: 10 mm = {} {}    ordinates drawn {} times as large as abscissae",
        short(10.0 / unit),
        sheet.of_curvature(),
        short(scale_y / scale_x)
    );
    canvas.text([0.5 * SHEET[0], 13.5], &scales, &text);
    canvas.text([0.5 * SHEET[0], 18.0], &sheet.key(), &text);
    let drawn = [
        (&fair.batten, &fair.inflections[0], "batten through the points"),
        (&fair.curve, &fair.inflections[1], "fair curve"),
    ];
    for ((curve, inflections, name), panel) in drawn.into_iter().zip(PANELS) {
        let place = |x: f64, y: f64| [SIDES[0] + (x - from) * scale_x, panel[1] - ROOM - (y - low) * scale_y];
        let window = Rectangle::new(SIDES[0], panel[0], SIDES[1], panel[1]);
        canvas.begin_clip(&window);
        let mut tips = Vec::new();
        for &x in &abscissae {
            let d = curve.derivatives::<2>(x);
            let foot = place(x, d[0][0]);
            // Normal to the line as drawn; y of the sheet points down.
            let slope = d[1][0] * scale_y / scale_x;
            let norm = slope.hypot(1.0);
            let tooth = sheet.curvature(curve, x) * unit;
            // The convex side: below where the curve is hollow (positive), above where it is full.
            let tip = [foot[0] + tooth * slope / norm, foot[1] + tooth / norm];
            canvas.line(foot, tip, &Pen::new(0.09, COMB));
            tips.push(tip);
        }
        canvas.polyline(&tips, &Pen::new(0.2, COMB));
        canvas.end_group();
        canvas.begin_clip(&Rectangle::new(SIDES[0] - 3.0, panel[0], SIDES[1] + 3.0, panel[1]));
        let line: Vec<[f64; 2]> = abscissae.iter().map(|&x| place(x, curve.eval(x)[0])).collect();
        canvas.polyline(&line, &Pen::new(0.35, "#000000"));
        for (point, mark) in fair.points.iter().zip(given) {
            let Some(before) = point.before else { continue };
            let at = place(point.x, before);
            let letters = [(mark.knuckle, "K", 2.8), (mark.tangent, "T", 2.8), (mark.weight < 1.0, "(  )", 0.0)];
            for (_, letter, above) in letters.into_iter().filter(|(there, _, _)| *there) {
                canvas.text([at[0], at[1] - above], letter, &TextStyle::new(2.8, Anchor::Middle));
            }
            match point.tolerance {
                _ if point.suspect => cross(&mut canvas, at),
                Some(t) if t <= 0.0 => square(&mut canvas, at),
                _ if point.active => triangle(&mut canvas, at),
                _ => canvas.ring(at, 0.5, &Pen::new(0.35, RED)),
            }
        }
        for &x in inflections {
            canvas.ring(place(x, curve.eval(x)[0]), RING, &Pen::new(0.4, RED));
        }
        canvas.end_group();
        canvas.rectangle(&window, &Pen::new(0.2, GREY));
        let out = tips.iter().any(|[_, y]| !(window.top..=window.bottom).contains(y));
        let cut = if out { "; longer teeth are cut off at the edge" } else { "" };
        let label = format!("{name}: {}{cut}", counted(inflections.len(), "inflection"));
        canvas.text([SIDES[0] + 2.0, panel[0] + 3.5], &label, &TextStyle::new(3.0, Anchor::Start).halo());
        scale_marks(&mut canvas, [low, high], |y| panel[1] - ROOM - (y - low) * scale_y);
        let axis = if sheet.lengths { "y [m]" } else { "area [m2]" };
        canvas.text([SIDES[0] - 2.0, panel[0] + 2.5], axis, &TextStyle::new(2.6, Anchor::End));
    }
    let step = nice_step(to - from, 10.0);
    for x in multiples(step, from, to) {
        let at = SIDES[0] + (x - from) * scale_x;
        for (_, bottom) in PANELS.map(|p| (p[0], p[1])) {
            canvas.line([at, bottom], [at, bottom + 1.2], &Pen::new(0.2, GREY));
        }
        canvas.text([at, MOVES[1] + 3.5], &format!("{x:.*}", decimals(step)), &TextStyle::new(2.6, Anchor::Middle));
    }
    canvas.text([SIDES[1], MOVES[1] + 8.0], "x [m]", &TextStyle::new(2.6, Anchor::End));
    moves(&mut canvas, sheet, |x| SIDES[0] + (x - from) * scale_x);
    if fair.status == FairStatus::Infeasible {
        caption::compromise(&mut canvas, [SIDES[0], SHEET[1] - 4.0], &TextStyle::new(3.0, Anchor::Start));
    }
    canvas.text([SHEET[0] - 6.0, SHEET[1] - 4.0], &caption::program(), &TextStyle::new(LEAST_LETTERS, Anchor::End));
    Ok(Svg::new(canvas.finish("fair-curve")))
}

/// A positive number with three significant digits.
fn short(value: f64) -> String {
    let digits = (2.0 - value.abs().max(1e-12).log10().floor()).clamp(0.0, 9.0) as usize;
    let text = format!("{value:.digits$}");
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}

fn scale_marks(canvas: &mut Canvas, [low, high]: [f64; 2], place: impl Fn(f64) -> f64) {
    let step = nice_step(high - low, 5.0);
    for y in multiples(step, low, high) {
        let at = place(y);
        canvas.line([SIDES[0] - 1.2, at], [SIDES[0], at], &Pen::new(0.2, GREY));
        let text = format!("{y:.*}", decimals(step));
        canvas.text([SIDES[0] - 2.0, at], &text, &TextStyle::new(2.6, Anchor::End));
    }
}

fn square(canvas: &mut Canvas, [x, y]: [f64; 2]) {
    canvas.fill(&Rectangle::new(x - 0.8, y - 0.8, x + 0.8, y + 0.8), RED);
}

fn cross(canvas: &mut Canvas, [x, y]: [f64; 2]) {
    for side in [-1.0, 1.0] {
        canvas.line([x - 1.0, y - side], [x + 1.0, y + side], &Pen::new(0.4, RED));
    }
}

fn triangle(canvas: &mut Canvas, [x, y]: [f64; 2]) {
    canvas.area(&[[x - 1.0, y + 0.8], [x + 1.0, y + 0.8], [x, y - 1.0]], RED);
}

/// Bars of the moves over bands of the tolerances.
fn moves(canvas: &mut Canvas, sheet: &CurveSheet<'_>, across: impl Fn(f64) -> f64) {
    let (fair, (words, size)) = (sheet.fair, sheet.of_moves());
    let window = Rectangle::new(SIDES[0], MOVES[0], SIDES[1], MOVES[1]);
    let middle = 0.5 * (MOVES[0] + MOVES[1]);
    let moved = |most: f64, value: Option<f64>| most.max(value.unwrap_or(0.0).abs());
    let kept = || fair.points.iter().filter(|point| !point.suspect);
    let largest = kept().fold(0.0, |most, p| moved(most, p.moved()));
    // Bands much wider than the moves are cut off.
    let widest = fair.points.iter().fold(0.0, |most, p| moved(most, p.tolerance)).min(3.0 * largest.max(1e-9));
    let reach = 1.1 * largest.max(widest).max(1e-9);
    let unit = 0.5 * window.height() / reach;
    canvas.begin_clip(&Rectangle::new(window.left - 2.0, window.top, window.right + 2.0, window.bottom));
    for point in kept() {
        let x = across(point.x);
        if let Some(tolerance) = point.tolerance {
            let half = tolerance * unit;
            canvas.fill(&Rectangle::new(x - 1.2, middle - half, x + 1.2, middle + half), "#dddddd");
        }
        if let Some(moved) = point.moved() {
            let colour = if point.active { RED } else { COMB };
            canvas.line([x, middle], [x, middle - moved * unit], &Pen::new(0.9, colour));
        }
    }
    canvas.line([window.left, middle], [window.right, middle], &Pen::new(0.15, GREY));
    canvas.end_group();
    canvas.rectangle(&window, &Pen::new(0.2, GREY));
    let (rms, most, at) = fair.moves();
    let title = format!(
        "moves [{words}] within their tolerances (grey; red where used up): RMS {} {words}, largest {} {words} at x = {} m",
        short(rms / size),
        short(most / size),
        short(at)
    );
    canvas.text([SIDES[0] + 2.0, MOVES[0] - 3.0], &title, &TextStyle::new(2.8, Anchor::Start));
    let step = nice_step(2.0 * reach / size, 4.0);
    for y in multiples(step, -reach / size, reach / size) {
        let text = format!("{:.*}", decimals(step), y + 0.0);
        canvas.text([SIDES[0] - 2.0, middle - size * y * unit], &text, &TextStyle::new(LEAST_LETTERS, Anchor::End));
    }
}
