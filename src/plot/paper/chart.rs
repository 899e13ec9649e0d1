//! A chart with one or two axes each way: grid, ticks and curves by plotters, names in place by this project.
//!
//! plotters rounds every coordinate to an integer. The chart is therefore drawn in units of 0.01 mm and set into the
//! drawing at that scale: a curve is within 0.005 mm of its place on paper.

use super::canvas::{Anchor, Canvas, Pen, Rectangle, TextStyle};
use super::error::PlotError;
use super::font;
use super::label::{LabelPlacer, Preference};
use super::scale::{decimals, multiples, nice_step};
use plotters::coord::ranged1d::{DefaultFormatting, KeyPointHint, Ranged};
use plotters::prelude::{
    ChartBuilder, DashedLineSeries, FontStyle, IntoDrawingArea, IntoFont, LabelAreaPosition, LineSeries, RGBColor,
    SVGBackend, ShapeStyle,
};
use plotters::style::register_font;
use std::ops::Range;
use std::sync::OnceLock;

/// Units of plotters in a millimetre.
const UNITS: f64 = 100.0;
/// plotters writes a font size 1.24 times smaller than it is asked for.
const PLOTTERS_FONT_RATIO: f64 = 1.24;
/// Length of tick marks [mm].
const TICK: f64 = 1.0;
/// Room for ticks and their figures above and below the frame [mm].
const MARGIN: f64 = 6.0;
/// Room for ticks and their figures beside the frame [mm].
const SIDE_MARGIN: f64 = 14.0;

/// An axis: its name with unit, its range and the step of its ticks.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::plot) struct Axis {
    name: String,
    range: [f64; 2],
    step: f64,
    /// Ticks where they are not the multiples of the step: powers of ten, written as what they are the powers of.
    powers: Option<Vec<f64>>,
}

/// Figures of a decade at which ticks may stand, from few to many.
const FIGURES: [&[f64]; 4] = [
    &[1.0],
    &[1.0, 2.0, 5.0],
    &[1.0, 1.5, 2.0, 3.0, 4.0, 6.0, 8.0],
    &[
        1.0, 1.1, 1.2, 1.3, 1.4, 1.5, 1.6, 1.8, 2.0, 2.2, 2.5, 3.0, 3.5, 4.0, 4.5, 5.0, 5.5, 6.0, 6.5, 7.0, 7.5, 8.0,
        8.5, 9.0, 9.5,
    ],
];

impl Axis {
    /// An axis that holds `low` to `high`, widened to whole steps; at most `count` steps.
    pub(in crate::plot) fn new(name: &str, low: f64, high: f64, count: f64) -> Self {
        let range = if high > low { high - low } else { 1.0 };
        let step = nice_step(range, count);
        let (first, last) = ((low / step + 1e-9).floor() * step, (high / step - 1e-9).ceil() * step);
        Self {
            name: name.to_owned(),
            range: [first, if last > first { last } else { first + step }],
            step,
            powers: None,
        }
    }

    /// An axis of powers of ten that holds those from `low` to `high`, widened to the next ticks; about `count` ticks.
    pub(in crate::plot) fn powers(name: &str, low: f64, high: f64, count: usize) -> Self {
        // Numbers have no more decades.
        let [low, high] = [low, high].map(|power| power.clamp(-330.0, 310.0));
        let decades = |every: i32| (low.floor() as i32 - every)..=(high.ceil() as i32 + every);
        let ticks = |figures: &[f64], every: i32| -> Vec<f64> {
            let all = decades(every).filter(|decade| decade.rem_euclid(every) == 0);
            let all: Vec<f64> =
                all.flat_map(|k| figures.iter().map(move |figure| f64::from(k) + figure.log10())).collect();
            let first = all.iter().rposition(|tick| *tick <= low + 1e-9).unwrap_or(0);
            let last = all.iter().position(|tick| *tick >= high - 1e-9).unwrap_or(all.len() - 1).max(first + 1);
            all[first..=last.min(all.len() - 1)].to_vec()
        };
        let sets = FIGURES.iter().rev().map(|figures| ticks(figures, 1)).chain((2..).map(|every| ticks(&[1.0], every)));
        let found = sets.into_iter().find(|ticks| ticks.len() <= count + 1).unwrap_or_default();
        let range = [found[0], found[found.len() - 1]];
        Self { name: name.to_owned(), range, step: 1.0, powers: Some(found) }
    }

    /// An axis from `low` to `high` as they are, with ticks at the multiples of `step`.
    pub(in crate::plot) fn exact(name: &str, low: f64, high: f64, step: f64) -> Self {
        Self { name: name.to_owned(), range: [low, high], step, powers: None }
    }

    /// The same axis for values that are `unit` times smaller.
    pub(in crate::plot) fn divided(&self, name: &str, unit: f64, step: f64) -> Self {
        Self { name: name.to_owned(), range: self.range.map(|value| value / unit), step, powers: None }
    }

    fn part(&self, value: f64) -> f64 {
        (value - self.range[0]) / (self.range[1] - self.range[0])
    }

    fn ticks(&self) -> Vec<f64> {
        self.powers
            .clone()
            .unwrap_or_else(|| multiples(self.step, self.range[0].min(self.range[1]), self.range[0].max(self.range[1])))
    }

    fn write(&self, value: f64) -> String {
        if self.powers.is_some() {
            let (decade, value) = (value.floor(), 10f64.powf(value));
            // One way of writing for the whole axis.
            if !(-4.0..6.0).contains(&decade) || self.range.iter().any(|end| !(-4.0..6.0).contains(end)) {
                return format!("{value:.1e}").replace(".0e", "e");
            }
            let text = format!("{value:.*}", (1.0 - decade).max(0.0) as usize);
            return if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text };
        }
        let value = if value.abs() < 1e-9 * self.step { 0.0 } else { value };
        format!("{value:.*}", decimals(self.step))
    }
}

/// What plotters asks of an axis; its ticks are ours, all of them.
impl Ranged for Axis {
    type FormatOption = DefaultFormatting;
    type ValueType = f64;

    fn map(&self, value: &f64, limit: (i32, i32)) -> i32 {
        limit.0 + (self.part(*value) * f64::from(limit.1 - limit.0)).round() as i32
    }

    fn key_points<Hint: KeyPointHint>(&self, hint: Hint) -> Vec<f64> {
        if hint.weight().allow_light_points() { Vec::new() } else { self.ticks() }
    }

    fn range(&self) -> Range<f64> {
        self.range[0]..self.range[1]
    }
}

/// A curve with its name.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::plot) struct Series {
    pub(in crate::plot) name: &'static str,
    /// Points (x, y) on the axes it belongs to.
    pub(in crate::plot) points: Vec<[f64; 2]>,
    /// Drawn on the top and right axes where they exist.
    pub(in crate::plot) secondary: bool,
    /// Colour, red, green, blue.
    pub(in crate::plot) colour: [u8; 3],
    /// Dash and gap [mm]; none: a full line.
    pub(in crate::plot) dash: Option<[f64; 2]>,
    /// Part of its length at which the curve bears its name.
    pub(in crate::plot) name_at: f64,
}

/// A chart on a drawing.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::plot) struct Chart {
    /// Frame of the curves on the sheet [mm]; figures and names of the axes stand outside.
    pub(in crate::plot) frame: Rectangle,
    pub(in crate::plot) bottom: Axis,
    pub(in crate::plot) left: Axis,
    pub(in crate::plot) top: Option<Axis>,
    pub(in crate::plot) right: Option<Axis>,
    /// Size of the text [mm].
    pub(in crate::plot) text_size: f64,
}

fn chart_error(error: impl std::fmt::Display) -> PlotError {
    PlotError::Chart(error.to_string())
}

fn register_typeface() -> Result<(), PlotError> {
    static DONE: OnceLock<bool> = OnceLock::new();
    let done = DONE.get_or_init(|| register_font(font::FAMILY, FontStyle::Normal, font::DEJAVU_SANS).is_ok());
    if *done { Ok(()) } else { Err(PlotError::Chart("the embedded font could not be read".to_owned())) }
}

fn units(millimetres: f64) -> u32 {
    (millimetres * UNITS).round() as u32
}

impl Chart {
    /// Where (x, y) of the bottom and left axes stands on the sheet [mm].
    pub(in crate::plot) fn place(&self, point: [f64; 2]) -> [f64; 2] {
        self.place_on(&self.bottom, &self.left, point)
    }

    fn place_on(&self, x: &Axis, y: &Axis, point: [f64; 2]) -> [f64; 2] {
        [
            self.frame.left + x.part(point[0]) * self.frame.width(),
            self.frame.bottom - y.part(point[1]) * self.frame.height(),
        ]
    }

    /// Draws grid, axes and curves, lines at levels of the left axis, and then the names, the curves' on the curves.
    pub(in crate::plot) fn draw(
        &self,
        canvas: &mut Canvas,
        placer: &mut LabelPlacer,
        series: &[Series],
        levels: &[Level<'_>],
    ) -> Result<(), PlotError> {
        let elements = self.elements(series)?;
        let corner = [self.frame.left - SIDE_MARGIN, self.frame.top - MARGIN];
        canvas.embed(&elements, corner, 1.0 / UNITS);
        self.note_ticks(canvas);
        self.name_axes(canvas);
        let (top, right) = (self.top.as_ref().unwrap_or(&self.bottom), self.right.as_ref().unwrap_or(&self.left));
        for one in series {
            let (x, y) = if one.secondary { (top, right) } else { (&self.bottom, &self.left) };
            let points: Vec<_> = one.points.iter().map(|&point| self.place_on(x, y, point)).collect();
            placer.add_curve(&points);
        }
        let first = placer.curve_count() - series.len();
        for level in levels {
            let y = self.place([self.bottom.range[0], level.at])[1];
            draw_level(canvas, placer, &self.frame, &Level { at: y, ..*level }, self.text_size);
        }
        for (k, one) in series.iter().enumerate() {
            let style = TextStyle::new(1.1 * self.text_size, Anchor::Middle).coloured(dark(one.colour));
            let preference = Preference { part: one.name_at, crossings: usize::MAX, beside: true };
            placer.name_curve(canvas, first + k, one.name, &style, preference, &self.frame.grown(-0.4));
        }
        Ok(())
    }

    /// The elements of the chart as plotters writes them.
    fn elements(&self, series: &[Series]) -> Result<String, PlotError> {
        register_typeface()?;
        let mut document = String::new();
        {
            let size = (units(self.frame.width() + 2.0 * SIDE_MARGIN), units(self.frame.height() + 2.0 * MARGIN));
            let root = SVGBackend::with_string(&mut document, size).into_drawing_area();
            let (bottom, left) = (&self.bottom, &self.left);
            let (top, right) = (self.top.as_ref().unwrap_or(bottom), self.right.as_ref().unwrap_or(left));
            let mut chart = ChartBuilder::on(&root)
                .set_label_area_size(LabelAreaPosition::Left, units(SIDE_MARGIN))
                .set_label_area_size(LabelAreaPosition::Right, units(SIDE_MARGIN))
                .set_label_area_size(LabelAreaPosition::Bottom, units(MARGIN))
                .set_label_area_size(LabelAreaPosition::Top, units(MARGIN))
                .build_cartesian_2d(bottom.clone(), left.clone())
                .map_err(chart_error)?
                .set_secondary_coord(top.clone(), right.clone());
            let grid = ShapeStyle { color: RGBColor(205, 205, 205).into(), filled: false, stroke_width: units(0.1) };
            let axis = ShapeStyle { color: RGBColor(0, 0, 0).into(), filled: false, stroke_width: units(0.25) };
            let label = (font::FAMILY, self.text_size * UNITS * PLOTTERS_FONT_RATIO).into_font();
            let write = |axis: &Axis, shown: bool, value: f64| if shown { axis.write(value) } else { String::new() };
            chart
                .configure_mesh()
                .bold_line_style(grid)
                .light_line_style(grid)
                .axis_style(axis)
                .label_style(label.clone())
                .set_all_tick_mark_size(units(TICK))
                .x_label_formatter(&|value| write(bottom, true, *value))
                .y_label_formatter(&|value| write(left, true, *value))
                .draw()
                .map_err(chart_error)?;
            let (shown_top, shown_right) = (self.top.is_some(), self.right.is_some());
            chart
                .configure_secondary_axes()
                .axis_style(axis)
                .label_style(label)
                .set_tick_mark_size(LabelAreaPosition::Top, if shown_top { units(TICK) } else { 0 })
                .set_tick_mark_size(LabelAreaPosition::Right, if shown_right { units(TICK) } else { 0 })
                .x_label_formatter(&|value| write(top, shown_top, *value))
                .y_label_formatter(&|value| write(right, shown_right, *value))
                .draw()
                .map_err(chart_error)?;
            for one in series {
                let [r, g, b] = one.colour;
                let style = ShapeStyle { color: RGBColor(r, g, b).into(), filled: false, stroke_width: units(0.45) };
                let points = one.points.iter().map(|&[x, y]| (x, y));
                match (one.dash, one.secondary) {
                    (None, false) => chart.draw_series(LineSeries::new(points, style)).map(|_| ()),
                    (None, true) => chart.draw_secondary_series(LineSeries::new(points, style)).map(|_| ()),
                    (Some([dash, gap]), false) => {
                        chart.draw_series(DashedLineSeries::new(points, units(dash), units(gap), style)).map(|_| ())
                    }
                    (Some([dash, gap]), true) => chart
                        .draw_secondary_series(DashedLineSeries::new(points, units(dash), units(gap), style))
                        .map(|_| ()),
                }
                .map_err(chart_error)?;
            }
            drop(chart);
            root.present().map_err(chart_error)?;
        }
        let start = document.find("<svg").and_then(|k| document[k..].find('>').map(|end| k + end + 1)).unwrap_or(0);
        let end = document.rfind("</svg>").unwrap_or(document.len());
        Ok(document[start..end].trim_start().to_owned())
    }

    /// Notes the figures that plotters has set at the ticks.
    fn note_ticks(&self, canvas: &mut Canvas) {
        let centred = TextStyle::new(self.text_size, Anchor::Middle);
        let distance = 2.0 * TICK + 0.4 * self.text_size;
        for tick in self.bottom.ticks() {
            let at = [self.place([tick, self.left.range[0]])[0], self.frame.bottom + distance];
            let text = self.bottom.write(tick);
            canvas.note_text(&text, Canvas::text_place(at, &text, &centred));
        }
        for tick in self.left.ticks() {
            let at = [self.frame.left - 2.0 * TICK, self.place([self.bottom.range[0], tick])[1]];
            let text = self.left.write(tick);
            canvas.note_text(&text, Canvas::text_place(at, &text, &TextStyle { anchor: Anchor::End, ..centred }));
        }
        if let Some(top) = &self.top {
            for tick in top.ticks() {
                let at = [self.frame.left + top.part(tick) * self.frame.width(), self.frame.top - distance];
                let text = top.write(tick);
                canvas.note_text(&text, Canvas::text_place(at, &text, &centred));
            }
        }
        if let Some(right) = &self.right {
            for tick in right.ticks() {
                let at = [self.frame.right + 2.0 * TICK, self.frame.bottom - right.part(tick) * self.frame.height()];
                let text = right.write(tick);
                canvas.note_text(&text, Canvas::text_place(at, &text, &TextStyle { anchor: Anchor::Start, ..centred }));
            }
        }
    }

    fn name_axes(&self, canvas: &mut Canvas) {
        let style = TextStyle::new(1.1 * self.text_size, Anchor::Middle);
        let (x, y) = (0.5 * (self.frame.left + self.frame.right), 0.5 * (self.frame.top + self.frame.bottom));
        canvas.text([x, self.frame.bottom + MARGIN + 0.6 * self.text_size], &self.bottom.name, &style);
        let widest = |axis: &Axis| {
            axis.ticks().into_iter().map(|tick| font::width(&axis.write(tick))).fold(0.0, f64::max) * self.text_size
        };
        canvas.text(
            [self.frame.left - 2.5 * TICK - widest(&self.left) - 0.7 * self.text_size, y],
            &self.left.name,
            &style.upward(),
        );
        if let Some(top) = &self.top {
            canvas.text([x, self.frame.top - MARGIN - 0.6 * self.text_size], &top.name, &style);
        }
        if let Some(right) = &self.right {
            let at = self.frame.right + 2.5 * TICK + widest(right) + 0.7 * self.text_size;
            canvas.text([at, y], &right.name, &style.upward());
        }
    }
}

/// A named line across a frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::plot) struct Level<'a> {
    /// Where it stands.
    pub(in crate::plot) at: f64,
    pub(in crate::plot) name: &'a str,
    pub(in crate::plot) pen: Pen,
}

/// The design waterline.
pub(in crate::plot) const DESIGN: Pen = Pen::new(0.25, "#000000").dashed(&[5.0, 1.0, 0.7, 1.0]);
/// The draught at which the deck edge goes under.
pub(in crate::plot) const EDGE: Pen = Pen::new(0.35, "#5a5a5a").dashed(&[1.2, 0.8]);

/// A line across `frame`, `at` millimetres down the sheet, its name at that end, above or below, where it meets fewest
/// curves.
pub(in crate::plot) fn draw_level(
    canvas: &mut Canvas,
    placer: &mut LabelPlacer,
    frame: &Rectangle,
    level: &Level<'_>,
    text_size: f64,
) {
    let Level { at: y, name, pen } = *level;
    canvas.line([frame.left, y], [frame.right, y], &pen);
    let style = TextStyle::new(text_size, Anchor::Middle).halo();
    let width = Canvas::text_place([0.0, 0.0], name, &style).width();
    let (up, aside) = (0.75 * text_size, 0.5 * width + 1.0);
    let places: Vec<_> = [y - up, y + up]
        .into_iter()
        .flat_map(|y| [frame.left + aside, frame.right - aside, frame.left + 2.2 * width].map(|x| [x, y]))
        .collect();
    placer.name_clear(canvas, name, &style, &places, frame);
    placer.add_curve(&[[frame.left, y], [frame.right, y]]);
}

/// Colours of curves: those of Okabe and Ito (2008), which the colour-blind tell apart, darkened until they can be read
/// on white.
pub(in crate::plot) mod colour {
    pub(in crate::plot) const BLACK: [u8; 3] = [0, 0, 0];
    pub(in crate::plot) const BLUE: [u8; 3] = [0, 114, 178];
    pub(in crate::plot) const VERMILION: [u8; 3] = [213, 94, 0];
    pub(in crate::plot) const GREEN: [u8; 3] = [0, 122, 89];
    pub(in crate::plot) const PURPLE: [u8; 3] = [168, 67, 127];
    pub(in crate::plot) const GREY: [u8; 3] = [150, 150, 150];
}

fn dark(colour: [u8; 3]) -> &'static str {
    match colour {
        colour::BLUE => "#0072b2",
        colour::VERMILION => "#d55e00",
        colour::GREEN => "#007a59",
        colour::PURPLE => "#a8437f",
        colour::GREY => "#767676",
        _ => "#000000",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The axis holds its range, has two ticks at least and not many more than are wanted, and writes what the powers
    /// are of.
    #[test]
    fn axes_of_powers() {
        for (low, high) in [
            (0.0, 0.02),
            (-0.46, -0.03),
            (-0.9, 1.7),
            (-7.2, 6.4),
            (-300.0, 300.0),
            (2.0, 2.0),
            (f64::NEG_INFINITY, f64::INFINITY),
        ] {
            for count in [7, 10, 16] {
                let axis = Axis::powers("", low, high, count);
                let ticks = axis.ticks();
                assert!((2..=count + 1).contains(&ticks.len()), "{low} {high}: {ticks:?}");
                assert!(
                    axis.range[0] <= low.max(-330.0) + 1e-9 && axis.range[1] >= high.min(310.0) - 1e-9,
                    "{low} {high}: {ticks:?}"
                );
            }
        }
        let axis = Axis::powers("", -1.0, 1.0, 10);
        let written: Vec<String> = axis.ticks().iter().map(|tick| axis.write(*tick)).collect();
        assert_eq!(written, ["0.1", "0.2", "0.5", "1", "2", "5", "10"]);
        assert_eq!(Axis::powers("", 6.0, 7.0, 3).write(6.0), "1e6");
    }
}
