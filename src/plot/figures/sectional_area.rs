//! The sectional-area curve at the design draught, that before fairing under it.

use crate::fairing::record::SectionTarget;
use crate::hull::SectionalAreaCurve;
use crate::hydrostatics::{CurvesOfForm, Hydrostatics};
use crate::plot::paper::canvas::{Anchor, Canvas, Pen, Rectangle, TextStyle};
use crate::plot::paper::chart::{Axis, Chart, Series, colour};
use crate::plot::paper::error::PlotError;
use crate::plot::paper::font::LEAST_LETTERS;
use crate::plot::paper::label::LabelPlacer;
use crate::plot::paper::scale::{nice_step, volume_of};
use crate::plot::ship::inputs::FigureInputs;
use crate::plot::ship::{caption, outline};

/// Size of the sheet [mm].
const SHEET: [f64; 2] = [300.0, 170.0];
/// Stations along the immersed length at which the curve is taken.
const STATIONS: usize = 401;
/// How far inside the ends of the immersed length the curve begins, as a part of it.
const INSIDE: f64 = 1e-4;
/// Areas of a parallel middle body that is none to the last digit are within this part of the largest.
const PARALLEL: f64 = 5e-4;
/// Part of that stretch which sections that are equal to the last digit fill, where they alone are shaded.
const EQUAL: f64 = 0.8;
/// Marks of centres: after, before, and what was asked for.
const CENTRE: [&str; 2] = ["#d55e00", "#a34700"];
const CENTRE_BEFORE: [&str; 2] = ["#9a9a9a", "#666666"];
const CENTRE_ASKED: [&str; 2] = ["#007a59", "#007a59"];

/// Draws the curve.
pub(in crate::plot) fn draw(inputs: &FigureInputs) -> Result<Canvas, PlotError> {
    let (hull, design) = (inputs.hull, inputs.design.ok_or(PlotError::NoDraught)?);
    let length = hull.particulars().length_between_perpendiculars;
    let [aft, fore] = outline::immersed_length(hull, design.draught);
    // A hair inside the ends, so that a transom or a blunt bow begins with its area.
    let (first, whole) = (aft + INSIDE * (fore - aft), (1.0 - 2.0 * INSIDE) * (fore - aft));
    let stations: Vec<f64> = (0..STATIONS).map(|k| first + whole * k as f64 / (STATIONS - 1) as f64).collect();
    let curve = SectionalAreaCurve::new(hull, design.draught, &stations);
    let points = upright_ends(&curve, [aft, fore]);

    let (low, high) = (aft.min(0.0), fore.max(length));
    let room = 0.02 * (high - low);
    let largest = design.maximum_section_area.max(f64::MIN_POSITIVE);
    let left = Axis::new("section area A [m²]", 0.0, 1.02 * largest, 8.0);
    let frame = Rectangle::new(24.0, 36.0, SHEET[0] - 24.0, SHEET[1] - 32.0);
    let numbers = inputs.curves.conventions.stations;
    let number = |x: f64| numbers.number(x / numbers.spacing(length));
    let chart = Chart {
        frame,
        right: Some(left.divided("A / A_X [-]", largest, 0.1)),
        left,
        top: Some(Axis::exact(
            &format!("station, L_PP / {} from {}", numbers.spaces, numbers.zero()),
            number(low - room),
            number(high + room),
            nice_step(f64::from(numbers.spaces), 20.0).max(1.0),
        )),
        bottom: Axis::exact("x forward of AP [m]", low - room, high + room, nice_step(high - low, 12.0)),
        text_size: 2.8,
    };

    let mut canvas = Canvas::new(SHEET[0], SHEET[1]);
    let title = format!("SECTIONAL-AREA CURVE – {}", caption::plain(hull.name()));
    canvas.text([0.5 * SHEET[0], 8.0], &title, &TextStyle::new(4.5, Anchor::Middle));
    canvas.text([0.5 * SHEET[0], 15.0], &caption::conventions(inputs), &TextStyle::new(2.6, Anchor::Middle));
    let mut placer = LabelPlacer::default();
    let equal = design.parallel_body_aft.zip(design.parallel_body_fore).map(|(aft, fore)| [aft, fore]);
    if let Some((limits, words)) = parallel_body(&curve, equal) {
        mark_parallel_body(&mut canvas, &mut placer, &chart, limits, largest, &words);
    }
    // The names stand on the outer sides, off the other mark.
    let aft = design.lcb.zip(design.lcf).is_some_and(|(lcb, lcf)| lcf < lcb);
    let before_row = inputs
        .before
        .and_then(|hull| CurvesOfForm::new(hull, &[design.draught], &inputs.curves.conventions).rows.pop());
    let asked = inputs.record.map(|record| &record.targets);
    let name = if before_row.is_some() { "LCB after" } else { "LCB" };
    // The higher marks first: where centres are one, all of them are seen.
    for (name, position, row, aft, colours) in [
        ("LCB asked for", asked.and_then(|asked| asked.lcb), 3.0, !aft, CENTRE_ASKED),
        ("LCB before", before_row.as_ref().and_then(|row| row.lcb), 2.0, !aft, CENTRE_BEFORE),
        ("LCF", design.lcf, 1.0, aft, CENTRE),
        (name, design.lcb, 0.0, !aft, CENTRE),
    ] {
        if let Some(x) = position {
            let digits = if before_row.is_some() && name != "LCF" { 3 } else { 2 };
            mark_centre(&mut canvas, &mut placer, &chart, (&format!("{name} {x:.digits$} m"), x), row, aft, colours);
        }
    }
    for (name, x) in [("AP", 0.0), ("FP", length)] {
        let [at, _] = chart.place([x, 0.0]);
        canvas.line([at, frame.top], [at, frame.bottom], &Pen::new(0.2, "#000000").dashed(&[4.0, 1.0, 0.6, 1.0]));
        let style = TextStyle::new(2.8, if x > 0.0 { Anchor::End } else { Anchor::Start }).halo();
        let place = [at + if x > 0.0 { -1.2 } else { 1.2 }, frame.top + 3.0];
        placer.take(Canvas::text_place(place, name, &style).grown(0.4));
        canvas.text(place, name, &style);
    }
    let name = if inputs.before.is_some() { "after" } else { "A(x)" };
    let mut series = vec![Series { name, points, secondary: false, colour: colour::BLUE, dash: None, name_at: 0.2 }];
    if let Some(before) = inputs.before {
        let old = SectionalAreaCurve::new(before, design.draught, &stations);
        let apart = old.areas.iter().zip(&curve.areas).map(|(old, new)| (new - old).abs()).fold(0.0, f64::max);
        // The dashes stand on the curve after fairing, so that both are seen where they are one.
        let points = upright_ends(&old, outline::immersed_length(before, design.draught));
        let dash = Some([2.4, 1.2]);
        series.push(Series { name: "before", points, secondary: false, colour: colour::GREY, dash, name_at: 0.8 });
        let mut words = format!("areas before and after differ by {apart:.3} m² at most");
        if let Some(row) = &before_row {
            let volumes = [row.displacement_volume, design.displacement_volume];
            words.push_str(&format!("    ∇ {} m³ before, {} m³ after", volume_of(volumes[0]), volume_of(volumes[1])));
        }
        if let Some(volume) = asked.and_then(|asked| asked.volume) {
            words.push_str(&format!(", {} m³ asked for", volume_of(volume)));
        }
        canvas.text([0.5 * SHEET[0], 20.5], &words, &TextStyle::new(2.6, Anchor::Middle));
    }
    chart.draw(&mut canvas, &mut placer, &series, &[])?;
    for section in asked.iter().flat_map(|asked| &asked.sections) {
        mark_section(&mut canvas, &mut placer, &chart, section);
    }
    canvas.text([0.5 * SHEET[0], SHEET[1] - 11.0], &coefficients(inputs, design), &TextStyle::new(3.0, Anchor::Middle));
    canvas.text([SHEET[0] - 6.0, SHEET[1] - 4.0], &caption::program(), &TextStyle::new(LEAST_LETTERS, Anchor::End));
    Ok(canvas)
}

/// The points of a curve, which goes upright where the hull begins and ends with an area.
fn upright_ends(curve: &SectionalAreaCurve, [aft, fore]: [f64; 2]) -> Vec<[f64; 2]> {
    let inside: Vec<[f64; 2]> = curve.stations.iter().zip(&curve.areas).map(|(&x, &area)| [x, area]).collect();
    let end = |x: f64, point: Option<&[f64; 2]>| [[x, 0.0], [x, point.map_or(0.0, |p| p[1])]];
    let [low, first] = end(aft, inside.first());
    let [high, last] = end(fore, inside.last());
    [low, first].into_iter().chain(inside).chain([last, high]).collect()
}

/// Ends of the parallel middle body \[m\] with words for it: where sections are `equal` to the last digit, or where their
/// areas are as good as equal, if that is much longer.
fn parallel_body(curve: &SectionalAreaCurve, equal: Option<[f64; 2]>) -> Option<([f64; 2], String)> {
    let name = |[aft, fore]: [f64; 2]| format!("parallel middle body {aft:.2} – {fore:.2} m");
    let length = |[aft, fore]: [f64; 2]| fore - aft;
    match (equal, curve.parallel_middle_body(PARALLEL)) {
        (Some(equal), near) if near.is_none_or(|near| length(equal) >= EQUAL * length(near)) => {
            Some((equal, name(equal)))
        }
        (_, near) => near.map(|near| (near, format!("{}\nA within {} % of A_X", name(near), 100.0 * PARALLEL))),
    }
}

/// The area that was asked of a section, with its band.
fn mark_section(canvas: &mut Canvas, placer: &mut LabelPlacer, chart: &Chart, section: &SectionTarget) {
    let SectionTarget { x, area, band } = *section;
    let pen = Pen::new(0.4, CENTRE_ASKED[0]);
    let [low, at, high] = [-1.0, 0.0, 1.0].map(|side| chart.place([x, area + side * band]));
    canvas.line(low, high, &pen);
    for (end, half) in [(low, 1.2), (high, 1.2), (at, 2.2)] {
        canvas.line([end[0] - half, end[1]], [end[0] + half, end[1]], &pen);
    }
    let width = if band > 0.0 { format!(" ± {band}") } else { String::new() };
    let style = TextStyle::new(2.8, Anchor::Middle).coloured(CENTRE_ASKED[1]).halo();
    let name = format!("{area}{width} m² asked for");
    let half = 0.5 * Canvas::text_place([0.0, 0.0], &name, &style).width() + 3.0;
    let places: Vec<[f64; 2]> = [0.0, 4.0, -4.0, 8.0, -8.0, 12.0, -12.0, 18.0]
        .into_iter()
        .flat_map(|down| [half, -half, 0.0].map(|aside| [at[0] + aside, at[1] + down]))
        .collect();
    placer.name_clear(canvas, &name, &style, &places, &chart.frame);
}

/// The parallel middle body, shaded from keel to curve.
fn mark_parallel_body(
    canvas: &mut Canvas,
    placer: &mut LabelPlacer,
    chart: &Chart,
    limits: [f64; 2],
    area: f64,
    name: &str,
) {
    let [from, to] = limits.map(|x| chart.place([x, area]));
    let bottom = chart.frame.bottom;
    canvas.fill(&Rectangle::new(from[0], from[1], to[0], bottom), "#e8eef4");
    for end in [from, to] {
        canvas.line(end, [end[0], bottom], &Pen::new(0.15, "#5f7a94"));
    }
    for (k, line) in name.lines().enumerate() {
        let style = TextStyle::new(2.8, Anchor::Middle);
        let half = 0.5 * Canvas::text_place([0.0, 0.0], line, &style).width() + 1.0;
        // Lines that are wider than what is shaded have a white edge, as they cross its borders.
        let style = if 2.0 * half > to[0] - from[0] { style.halo() } else { style };
        let at = [0.5 * (from[0] + to[0]), from[1] + 0.3 * (bottom - from[1]) + 4.6 * k as f64];
        let place = Canvas::text_place(at, line, &style).grown(0.4);
        if chart.frame.contains(&place) {
            placer.take(place);
            canvas.text(at, line, &style);
        }
    }
}

/// A mark at the position of a centre, from the axis up, with its name and place aft or forward of it.
fn mark_centre(
    canvas: &mut Canvas,
    placer: &mut LabelPlacer,
    chart: &Chart,
    (text, x): (&str, f64),
    row: f64,
    aft: bool,
    [mark, letters]: [&'static str; 2],
) {
    let [at, bottom] = chart.place([x, 0.0]);
    let top = bottom - 9.0 - 5.0 * row;
    canvas.line([at, bottom], [at, top], &Pen::new(0.5, mark));
    canvas.area(&[[at, bottom], [at - 1.1, bottom - 2.6], [at + 1.1, bottom - 2.6]], mark);
    let (anchor, beside) = if aft { (Anchor::End, -1.2) } else { (Anchor::Start, 1.2) };
    let style = TextStyle::new(2.8, anchor).coloured(letters).halo();
    let place = [at + beside, top + 1.0];
    placer.take(Canvas::text_place(place, text, &style).grown(0.4));
    canvas.text(place, text, &style);
}

/// What the curve amounts to, in one line.
fn coefficients(inputs: &FigureInputs, design: &Hydrostatics) -> String {
    let mut parts = vec![caption::draught(inputs), format!("∇ {} m³", volume_of(design.displacement_volume))];
    parts.push(match design.maximum_section_position {
        Some(x) => format!("A_X {:.2} m² at x {x:.2} m", design.maximum_section_area),
        None => format!("A_X {:.2} m²", design.maximum_section_area),
    });
    for (symbol, value) in [
        ("C_P", design.prismatic_coefficient),
        ("C_PF", design.prismatic_coefficient_fore),
        ("C_PA", design.prismatic_coefficient_aft),
    ] {
        if let Some(value) = value {
            parts.push(format!("{symbol} {value:.4}"));
        }
    }
    if let Some(percent) = design.lcb_percent {
        let percent = if percent.abs() < 0.005 { 0.0 } else { percent };
        parts.push(format!("LCB {percent:+.2} % L_PP from midship"));
    }
    parts.join("    ")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::parametric::analytic::{Dimensions, rectangular_box};

    #[test]
    fn a_box_begins_and_ends_with_its_area() {
        let dimensions = Dimensions { length: 40.0, breadth: 12.0, draught: 3.0, depth: 5.0 };
        let hull = rectangular_box("box", &dimensions).unwrap().hull;
        let curve = SectionalAreaCurve::new(&hull, 3.0, &[0.01, 20.0, 39.99]);
        let points = upright_ends(&curve, [0.0, 40.0]);
        assert_eq!(points.len(), 7);
        let expected = [[0.0, 0.0], [0.0, 36.0], [40.0, 36.0], [40.0, 0.0]];
        for (found, expected) in [points[0], points[1], points[5], points[6]].iter().zip(expected) {
            assert!(found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-9), "{found:?}");
        }
    }
}
