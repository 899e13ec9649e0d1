//! Curvature of the side of a hull, developed: position along the ship by girth from the keel.
//!
//! Signs stand on the fields of colour, for print without colours. The Gaussian map is white where the surface is developable, orange where it is convex both ways and blue where it is a saddle; the
//! mean map orange where it is convex outward and blue where it is hollow; on both, black lines mark zero. Colours are steps of the
//! square root of the curvature, full at a size that nineteen twentieths of the surface do not pass. Zebra stripes are the reflections of
//! lamps that run along the ship, seen from abeam: they are smooth where curvature is continuous, have kinks where only
//! the tangent plane is, and break at knuckles.

use super::canvas::{Anchor, Canvas, Pen, Rectangle, TextStyle};
use super::chart::{Axis, Chart};
use super::label::LabelPlacer;
use super::scale::{decimals, nice_step};
use super::sheet::ROOM;
use super::zero_lines::zero_lines;
use super::{PlotError, Svg, caption};
use crate::fairing::inspect::{MapPoint, SurfaceMap};
use crate::hull::Hull;

/// Columns and rows of the grid.
const GRID: [usize; 2] = [161, 49];
/// Steps of colour on each side of white.
const STEPS: i32 = 7;
/// Part of the surface that the full colours hold.
const SHARE: f64 = 0.95;
/// Curvature that is none, in 1/B (mean) and 1/B^2 (Gaussian).
const FLAT: f64 = 1e-9;
/// Height of a chart \[mm\].
const HEIGHT: f64 = 78.0;
/// Height of a chart with its head and axis \[mm\].
const PITCH: f64 = 104.0;
/// Part of the full size that a curvature reaches on both sides of a line of zero that is drawn: that of the first step of colour.
const ZERO: f64 = 0.25 / (STEPS * STEPS) as f64;
/// Distance of the signs of curvature on the sheet \[mm\].
const SIGNS: f64 = 9.0;
/// Dark stripes to a turn of the reflected ray.
const STRIPES: f64 = 16.0;

/// What is mapped.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SurfaceMapKind {
    /// Gaussian curvature.
    Gaussian,
    /// Mean curvature.
    Mean,
    /// Reflections.
    Zebra,
}

impl SurfaceMapKind {
    /// Every kind.
    pub const ALL: [Self; 3] = [Self::Gaussian, Self::Mean, Self::Zebra];

    /// Stem of the file name.
    #[must_use]
    pub fn key(self) -> &'static str {
        match self {
            Self::Gaussian => "gaussian-map",
            Self::Mean => "mean-map",
            Self::Zebra => "zebra-map",
        }
    }

    fn title(self) -> &'static str {
        match self {
            Self::Gaussian => "GAUSSIAN CURVATURE",
            Self::Mean => "MEAN CURVATURE",
            Self::Zebra => "ZEBRA STRIPES",
        }
    }

    fn unit(self) -> &'static str {
        match self {
            Self::Gaussian => "1/m²",
            _ => "1/m",
        }
    }

    /// What is compared with the levels: a curvature, or the brightness of the reflection from -1 to 1, which is 1 on upright sides
    /// and on flat bottoms; none where there is no tangent plane.
    fn value(self, point: &MapPoint) -> Option<f64> {
        match self {
            Self::Zebra => {
                // The ray from abeam, reflected: r = 2 (n . v) n - v with v to port.
                let [_, y, z] = point.normal?;
                let angle = (2.0 * y * z).atan2(2.0 * y * y - 1.0);
                Some((STRIPES * angle).cos())
            }
            Self::Gaussian => Some(point.curvature?[0]),
            Self::Mean => Some(point.curvature?[1]),
        }
    }

    /// Levels with the colours beyond them, in the order in which they are painted; below a negative level, above others.
    fn levels(self, full: f64) -> Vec<(f64, String)> {
        if self == Self::Zebra {
            // All of it bright, and then what is dark.
            return vec![(f64::NEG_INFINITY, self.colour(1)), (-f64::MIN_POSITIVE, self.colour(0))];
        }
        let level = |k: i32| full * ((f64::from(k) - 0.5) / f64::from(STEPS)).powi(2);
        let steps = (1..=STEPS).flat_map(|k| [(level(k), k), (-level(k), -k)]);
        if full > 0.0 { steps.map(|(at, k)| (at, self.colour(k))).collect() } else { Vec::new() }
    }

    fn colour(self, step: i32) -> String {
        if self == Self::Zebra {
            return if step == 0 { "#1a1a1a" } else { "#f4f4f4" }.to_owned();
        }
        let full = if step > 0 { [179.0, 88.0, 6.0] } else { [33.0, 102.0, 172.0] };
        let part = 0.9 * f64::from(step.abs()) / f64::from(STEPS);
        let [r, g, b] = full.map(|c: f64| (255.0 + part * (c - 255.0)).round() as u8);
        format!("#{r:02x}{g:02x}{b:02x}")
    }
}

/// A hull with its heading.
struct Side {
    heading: &'static str,
    map: SurfaceMap,
}

/// Draws the map of a hull, over that of the hull before fairing where there is one; both have one scale of colours.
///
/// # Errors
/// [`PlotError::Chart`] when the chart cannot be drawn.
pub fn surface_map(hull: &Hull, before: Option<&Hull>, kind: SurfaceMapKind) -> Result<Svg, PlotError> {
    Ok(Svg { text: compose(hull, before, kind)?.finish(kind.key()) })
}

pub(super) fn compose(hull: &Hull, before: Option<&Hull>, kind: SurfaceMapKind) -> Result<Canvas, PlotError> {
    let side = |heading, hull: &Hull| Side { heading, map: SurfaceMap::at_stations(hull, GRID[0], GRID[1]) };
    let mut sides: Vec<Side> = before.map(|before| side("before fairing", before)).into_iter().collect();
    sides.push(side(if before.is_some() { "after fairing" } else { "" }, hull));
    let which = usize::from(kind == SurfaceMapKind::Mean);
    let full = sides.iter().map(|side| side.map.size(which, SHARE)).fold(0.0, f64::max);
    // What is rounding on a hull of this size is flat.
    let rounding = FLAT / hull.particulars().breadth.powi(2 - which as i32);
    let full = if full > rounding { full } else { 0.0 };
    let points = || sides.iter().flat_map(|side| &side.map.points);
    let (low, high) = points().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), p| (a.min(p.at[0]), b.max(p.at[0])));
    let girth = points().map(|p| p.girth).fold(0.0, f64::max);
    let mut canvas = Canvas::new(ROOM[0], 22.0 + PITCH * sides.len() as f64 + 14.0);
    let title = format!("{} – {}", kind.title(), caption::plain(hull.name()));
    canvas.text([0.5 * ROOM[0], 8.0], &title, &TextStyle::new(4.5, Anchor::Middle));
    let words = "the side developed: girth of each station from the centreplane";
    canvas.text([0.5 * ROOM[0], 15.0], words, &TextStyle::new(2.8, Anchor::Middle));
    for (k, side) in sides.iter().enumerate() {
        let top = 28.0 + PITCH * k as f64;
        let chart = Chart {
            frame: Rectangle::new(26.0, top, ROOM[0] - 14.0, top + HEIGHT),
            bottom: Axis::exact("x forward of AP [m]", low, high, nice_step(high - low, 16.0)),
            left: Axis::new("girth [m]", 0.0, girth, 8.0),
            top: None,
            right: None,
            text_size: 2.8,
        };
        draw_cells(&mut canvas, &chart, &side.map, kind, full);
        if kind != SurfaceMapKind::Zebra && full > 0.0 {
            let place = |at: [f64; 2]| chart.place(at);
            draw_signs(&mut canvas, &chart, &side.map, which, ZERO * full);
            for line in zero_lines(&side.map, which, ZERO * full, &place) {
                canvas.polyline(&line, &Pen::new(0.3, "#000000"));
            }
        }
        let columns = side.map.columns();
        for row in [0, side.map.rows - 1] {
            let edge = (0..columns).map(|i| side.map.point(i, row));
            let edge: Vec<[f64; 2]> = edge.map(|p| chart.place([p.at[0], p.girth])).collect();
            canvas.polyline(&edge, &Pen::new(0.35, "#000000"));
        }
        chart.draw(&mut canvas, &mut LabelPlacer::default(), &[], None)?;
        let style = TextStyle::new(3.2, Anchor::Start);
        canvas.text([26.0, top - 3.4], side.heading, &style);
    }
    legend(&mut canvas, kind, full, 22.0 + PITCH * sides.len() as f64 + 2.0);
    let corner = [ROOM[0] - 6.0, 22.0 + PITCH * sides.len() as f64 + 10.0];
    canvas.text(corner, &caption::program(), &TextStyle::new(2.2, Anchor::End));
    Ok(canvas)
}

/// What lies beyond the levels, one over the other; cells that lie there as a whole are joined along a row.
fn draw_cells(canvas: &mut Canvas, chart: &Chart, map: &SurfaceMap, kind: SurfaceMapKind, full: f64) {
    let columns = map.columns();
    let values: Vec<Option<f64>> = map.points.iter().map(|point| kind.value(point)).collect();
    let places: Vec<[f64; 2]> = map.points.iter().map(|p| chart.place([p.at[0], p.girth])).collect();
    let corners = |i: usize, j: usize| [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)].map(|(i, j)| i * map.rows + j);
    for (level, colour) in kind.levels(full) {
        let beyond = |value: f64| match level {
            f64::NEG_INFINITY => 1.0,
            level if level < 0.0 => level - value,
            level => value - level,
        };
        let mut areas: Vec<Vec<[f64; 2]>> = Vec::new();
        for j in 0..map.rows - 1 {
            let mut run: Option<usize> = None;
            for i in 0..columns {
                // The two sides of a line of the surface stand at one place.
                let high = |i: usize| map.point(i, j + 1).girth > map.point(i, j).girth;
                let cell = (i + 1 < columns && (high(i) || high(i + 1))).then(|| corners(i, j));
                let signs = cell.and_then(|cell| {
                    let [a, b, c, d] = cell.map(|k| values[k].map(&beyond));
                    Some([a?, b?, c?, d?])
                });
                let whole = signs.is_some_and(|signs| signs.iter().all(|s| *s >= 0.0));
                if whole {
                    run.get_or_insert(i);
                    continue;
                }
                if let Some(from) = run.take() {
                    let below = (from..=i).map(|i| places[i * map.rows + j]);
                    let above = (from..=i).rev().map(|i| places[i * map.rows + j + 1]);
                    areas.push(below.chain(above).collect());
                }
                if let (Some(cell), Some(signs)) = (cell, signs) {
                    let part = clipped(cell.map(|k| places[k]), signs);
                    if part.len() > 2 {
                        areas.push(part);
                    }
                }
            }
        }
        canvas.edged_areas(&areas, &colour);
    }
}

/// The part of a cell in which what is linear between its corners is not negative.
fn clipped(corners: [[f64; 2]; 4], signs: [f64; 4]) -> Vec<[f64; 2]> {
    let mut part = Vec::new();
    for k in 0..4 {
        let next = (k + 1) % 4;
        let (a, b) = (signs[k], signs[next]);
        if a >= 0.0 {
            part.push(corners[k]);
        }
        if (a < 0.0) != (b < 0.0) {
            let t = a / (a - b);
            let [p, q] = [corners[k], corners[next]];
            part.push([p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1])]);
        }
    }
    part
}

/// Small signs over the fields of colour, so that they are told apart in black and white as well: + where the curvature is positive and
/// - where it is negative, about [`SIGNS`] apart.
fn draw_signs(canvas: &mut Canvas, chart: &Chart, map: &SurfaceMap, which: usize, least: f64) {
    let pen = Pen::new(0.14, "#303030");
    let mut across = f64::NEG_INFINITY;
    for i in 0..map.columns() {
        let place = |j: usize| {
            let point = map.point(i, j);
            chart.place([point.at[0], point.girth])
        };
        let x = place(0)[0];
        if x - across < SIGNS {
            continue;
        }
        across = x;
        let mut last = place(0)[1] - 0.3 * SIGNS;
        for j in 0..map.rows {
            let [x, y] = place(j);
            let Some(value) = map.point(i, j).curvature.map(|c| c[which]).filter(|_| last - y >= SIGNS) else {
                continue;
            };
            last = y;
            if value.abs() < least || y - chart.frame.top < 2.0 {
                continue;
            }
            canvas.line([x - 0.7, y], [x + 0.7, y], &pen);
            if value > 0.0 {
                canvas.line([x, y - 0.7], [x, y + 0.7], &pen);
            }
        }
    }
}

fn legend(canvas: &mut Canvas, kind: SurfaceMapKind, full: f64, y: f64) {
    let style = TextStyle::new(2.8, Anchor::Start);
    let mut x = 26.0;
    if kind == SurfaceMapKind::Zebra {
        let words = "reflections of lamps along the ship, seen from abeam: a kink is a break of curvature, a step a break of the tangent plane";
        canvas.text([x, y], words, &style);
        return;
    }
    if full <= 0.0 {
        canvas.text([x, y], "0 all over the side", &style);
        return;
    }
    for step in -STEPS..=STEPS {
        let place = Rectangle::new(x, y - 3.0, x + 13.0, y + 3.0);
        canvas.fill(&place, &kind.colour(step));
        canvas.rectangle(&place, &Pen::new(0.08, "#808080"));
        let value = full * (f64::from(step) / f64::from(STEPS)).powi(2).copysign(f64::from(step));
        let digits = decimals(nice_step(full.max(f64::MIN_POSITIVE), 50.0));
        let text = if step == 0 { "0".to_owned() } else { format!("{value:+.digits$}") };
        let ink = if step.abs() > 5 { "#ffffff" } else { "#000000" };
        if step.abs() % 2 == 1 || step == 0 {
            canvas.text([x + 6.5, y], &text, &TextStyle::new(2.2, Anchor::Middle).coloured(ink));
        }
        x += 13.0;
    }
    let words = match kind {
        SurfaceMapKind::Gaussian => "orange, +: convex both ways; white: developable; blue, -: saddle; black line: 0",
        _ => "orange, +: convex outward; blue, -: hollow; black line: 0",
    };
    canvas.text([x + 3.0, y], &format!("{}   {words}", kind.unit()), &style);
}
