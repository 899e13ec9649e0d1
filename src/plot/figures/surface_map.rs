//! Curvature of the side of a hull, developed: position along the ship by girth from the keel.
//!
//! Signs stand on the fields of colour, for print without colours. The Gaussian map is white where the surface is
//! developable, orange where it is convex both ways and blue where it is a saddle; the mean map orange where it is
//! convex outward and blue where it is hollow; on both, black lines mark zero. Colours are steps of the square root of
//! the curvature, full at a size that nineteen twentieths of the side do not pass. Zebra stripes are the reflections of
//! lamps that run along the ship, seen from abeam: they are smooth where curvature is continuous, have kinks where only
//! the tangent plane is, and break at knuckles. Both sides of a knot line of the surface are looked at: where curvature
//! jumps by a quarter of a step of colour or more the line is dashed, where the tangent plane breaks it is heavy, so
//! that what the surface is made with is not taken for a bump. Between the points of the map the curvature, or the
//! angle of the reflection, is linear.

use super::map_legend::{JUMP, KEEL_END, KNUCKLE_LINE, Legend, SHARE, STEPS, SurfaceMapKind, TEXT, hatch};
use crate::fairing::inspect::{KnotLine, MapPoint, SurfaceMap};
use crate::hull::Hull;
use crate::numeric::join;
use crate::plot::paper::canvas::{Anchor, Canvas, HAIR, Pen, Rectangle, TextStyle};
use crate::plot::paper::chart::{Axis, Chart};
use crate::plot::paper::error::PlotError;
use crate::plot::paper::label::LabelPlacer;
use crate::plot::paper::scale::nice_step;
use crate::plot::paper::sheet::ROOM;
use crate::plot::paper::svg::Svg;
use crate::plot::ship::caption;
use crate::plot::ship::zero_lines::{FAINT, zero_lines};
use std::f64::consts::PI;

/// Columns and rows of the grid, about.
const GRID: [usize; 2] = [331, 141];
/// Curvature that is none, in 1/B (mean) and 1/B^2 (Gaussian).
const FLAT: f64 = 1e-9;
/// Height of a chart \[mm\].
const HEIGHT: f64 = 78.0;
/// Height of a chart with its head and axis \[mm\].
const PITCH: f64 = 104.0;
/// Part of the full size that a curvature reaches on both sides of a line of zero that is drawn: that of the first step
/// of colour.
const ZERO: f64 = 0.25 / (STEPS * STEPS) as f64;
/// Distance of the signs of curvature on the sheet \[mm\].
const SIGNS: f64 = 9.0;
/// Dark stripes to a turn of the reflected ray.
const STRIPES: f64 = 16.0;
/// Least angle between the tangent planes of the two sides of a line that is a knuckle \[rad\].
const KNUCKLE: f64 = 0.02;
/// Least jump of curvature that is shown, in steps of colour: borders of colours are seen to step by it.
const JUMP_STEP: f64 = 0.25;
const MARKED: f64 = 5e-3;
/// How near to its end an axis has a round number that it begins with, in lengths of the hull.
const AT_END: f64 = 2e-3;

/// The ranges of values that have a colour, of those between two values.
type Ranges = Box<dyn Fn(f64, f64) -> Vec<[f64; 2]>>;

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

    pub(in crate::plot) fn unit(self) -> &'static str {
        match self {
            Self::Gaussian => "1/m²",
            _ => "1/m",
        }
    }

    /// What is compared with the levels: a curvature, or the phase of the reflection, of which stripes from even to odd
    /// numbers are dark; upright sides and flat bottoms are bright. None where there is no tangent plane.
    fn value(self, point: &MapPoint) -> Option<f64> {
        match self {
            Self::Zebra => {
                // The ray from abeam, reflected: r = 2 (n . v) n - v with v to port.
                let [_, y, z] = point.normal?;
                let angle = (2.0 * y * z).atan2(2.0 * y * y - 1.0);
                Some(STRIPES / PI * angle - 0.5)
            }
            Self::Gaussian => Some(point.curvature?[0]),
            Self::Mean => Some(point.curvature?[1]),
        }
    }

    /// What is painted one over the other: a colour with the ranges of values, of those between `low` and `high`, that
    /// have it.
    fn layers(self, full: f64) -> Vec<(String, Ranges)> {
        let all: Ranges = Box::new(|_, _| vec![[f64::NEG_INFINITY, f64::INFINITY]]);
        if self == Self::Zebra {
            let dark: Ranges = Box::new(|low, high| {
                let first = (0.5 * (low - 1.0)).ceil() as i64;
                (first..)
                    .map(|m| 2.0 * m as f64)
                    .take_while(|from| *from <= high)
                    .map(|from| [from, from + 1.0])
                    .collect()
            });
            return vec![(self.colour(1), all), (self.colour(0), dark)];
        }
        let level = |k: i32| full * ((f64::from(k) - 0.5) / f64::from(STEPS)).powi(2);
        let beyond = |k: i32| -> Ranges {
            let range = if k > 0 { [level(k), f64::INFINITY] } else { [f64::NEG_INFINITY, -level(-k)] };
            Box::new(move |_, _| vec![range])
        };
        let steps = if full > 0.0 { STEPS } else { 0 };
        let steps = (1..=steps).flat_map(|k| [k, -k]).map(|k| (self.colour(k), beyond(k)));
        [(self.colour(0), all)].into_iter().chain(steps).collect()
    }

    pub(in crate::plot) fn colour(self, step: i32) -> String {
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
struct HeadedMap<'a> {
    heading: &'static str,
    map: &'a SurfaceMap,
}

/// The maps that the figures are drawn from: of a hull, and of that before fairing where there is one.
#[derive(Debug, Clone)]
pub struct SurfaceMaps {
    name: String,
    breadth: f64,
    /// x of the ends of the keel \[m\].
    keel: [f64; 2],
    after: SurfaceMap,
    before: Option<SurfaceMap>,
}

impl SurfaceMaps {
    /// Looks at the surfaces.
    #[must_use]
    pub fn new(hull: &Hull, before: Option<&Hull>) -> Self {
        let map = |hull: &Hull| SurfaceMap::at_stations(hull, GRID[0], GRID[1]);
        let (before, after) = match before {
            Some(before) => join(|| Some(map(before)), || map(hull)),
            None => (None, map(hull)),
        };
        let surface = hull.surface();
        let ((u0, u1), (v0, _)) = (surface.u().domain(), surface.v().domain());
        let keel = [u0, u1].map(|u| surface.eval(u, v0)[0]);
        Self { name: hull.name().to_owned(), breadth: hull.particulars().breadth, keel, after, before }
    }
}

/// Draws the map of a hull, over that of the hull before fairing where there is one; both have one scale of colours.
///
/// # Errors
/// [`PlotError::Chart`] when the chart cannot be drawn.
pub fn surface_map(maps: &SurfaceMaps, kind: SurfaceMapKind) -> Result<Svg, PlotError> {
    Ok(Svg::new(compose(maps, kind)?.finish(kind.key())))
}

pub(in crate::plot) fn compose(maps: &SurfaceMaps, kind: SurfaceMapKind) -> Result<Canvas, PlotError> {
    let before = maps.before.as_ref();
    let mut sides: Vec<HeadedMap> =
        before.map(|map| HeadedMap { heading: "before fairing", map }).into_iter().collect();
    sides.push(HeadedMap { heading: if before.is_some() { "after fairing" } else { "" }, map: &maps.after });
    let full = |which: usize| {
        let full = sides.iter().map(|side| side.map.size(which, SHARE)).fold(0.0, f64::max);
        // What is rounding on a hull of this size is flat.
        if full > FLAT / maps.breadth.powi(2 - which as i32) { full } else { 0.0 }
    };
    let which = usize::from(kind == SurfaceMapKind::Mean);
    // The jumps of a zebra map are those of the mean curvature.
    let jumps = if kind == SurfaceMapKind::Zebra { 1 } else { which };
    let (full, jump) = (full(which), full(jumps));
    let points = || sides.iter().flat_map(|side| &side.map.points);
    let (low, high) = points().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), p| (a.min(p.at[0]), b.max(p.at[0])));
    let step = nice_step(high - low, 16.0);
    // An end that a round number stands next to bears it.
    let round = step * (low / step).round();
    let low = if (low - round).abs() <= AT_END * (high - low) { low.min(round) } else { low };
    let girth = points().map(|p| p.girth).fold(0.0, f64::max);
    let foot = 22.0 + PITCH * sides.len() as f64;
    let ends: Vec<f64> = maps.keel.into_iter().filter(|x| (x - low).min(high - x) > MARKED * (high - low)).collect();
    let mut canvas = Canvas::new(ROOM[0], foot + 29.0);
    let title = format!("{} – {}", kind.title(), caption::plain(&maps.name));
    canvas.text([0.5 * ROOM[0], 8.0], &title, &TextStyle::new(4.5, Anchor::Middle));
    let words = "the side developed: girth of each station from the centreplane, or from the stern or stem profile where it has no keel";
    canvas.text([0.5 * ROOM[0], 15.0], words, &TextStyle::new(TEXT, Anchor::Middle));
    let mut marked = [false; 2];
    for (k, side) in sides.iter().enumerate() {
        let top = 28.0 + PITCH * k as f64;
        let chart = Chart {
            frame: Rectangle::new(26.0, top, ROOM[0] - 14.0, top + HEIGHT),
            bottom: Axis::exact("x forward of AP [m]", low, high, step),
            left: Axis::new("girth [m]", 0.0, girth, 8.0),
            top: None,
            right: None,
            text_size: TEXT,
        };
        hatch(&mut canvas, &chart.frame);
        draw_cells(&mut canvas, &chart, side.map, kind, full);
        if kind != SurfaceMapKind::Zebra && full > 0.0 {
            let place = |at: [f64; 2]| chart.place(at);
            draw_signs(&mut canvas, &chart, side.map, which, ZERO * full);
            for line in zero_lines(side.map, which, ZERO * full, &place) {
                canvas.polyline(&line, &Pen::new(0.3, "#000000"));
            }
        }
        let drawn = draw_breaks(&mut canvas, &chart, side.map, jumps, jump);
        marked = [0, 1].map(|k| marked[k] || drawn[k]);
        for &x in &ends {
            let [at, _] = chart.place([x, 0.0]);
            canvas.line([at, chart.frame.bottom], [at, chart.frame.top], &KEEL_END);
        }
        let columns = side.map.columns();
        for row in [0, side.map.rows - 1] {
            let edge = (0..columns).map(|i| side.map.point(i, row));
            let edge: Vec<[f64; 2]> = edge.map(|p| chart.place([p.at[0], p.girth])).collect();
            canvas.polyline(&edge, &Pen::new(0.35, "#000000"));
        }
        chart.draw(&mut canvas, &mut LabelPlacer::default(), &[], &[])?;
        let style = TextStyle::new(3.2, Anchor::Start);
        canvas.text([26.0, top - 3.4], side.heading, &style);
    }
    let legend = Legend {
        kind,
        full,
        floor: FAINT * ZERO,
        more: sides.iter().map(|side| side.map.more_breaks).max().unwrap_or(0),
        marked,
        ends: !ends.is_empty(),
        pair: before.is_some(),
    };
    legend.draw(&mut canvas, foot + 1.0);
    canvas.text([ROOM[0] - 6.0, foot + 25.5], &caption::program(), &TextStyle::new(TEXT, Anchor::End));
    Ok(canvas)
}

/// A corner of a cell: its place on the sheet and its value.
type Corner = ([f64; 2], f64);

/// The values at the corners of a cell; angles are taken on the turn of the first.
fn turned(values: [f64; 4], kind: SurfaceMapKind) -> [f64; 4] {
    let turn = 2.0 * STRIPES;
    if kind == SurfaceMapKind::Zebra { values.map(|v| v - turn * ((v - values[0]) / turn).round()) } else { values }
}

/// The colours, one over the other; cells that have one as a whole are joined along a row.
fn draw_cells(canvas: &mut Canvas, chart: &Chart, map: &SurfaceMap, kind: SurfaceMapKind, full: f64) {
    let columns = map.columns();
    let values: Vec<Option<f64>> = map.points.iter().map(|point| kind.value(point)).collect();
    let places: Vec<[f64; 2]> = map.points.iter().map(|p| chart.place([p.at[0], p.girth])).collect();
    let high = |i: usize, j: usize| map.point(i, j + 1).girth > map.point(i, j).girth;
    // The two sides of a line of the surface stand at one place.
    let cell = |i: usize, j: usize| {
        let wide = i + 1 < columns && map.point(i + 1, j).at[0] > map.point(i, j).at[0];
        let ks = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)].map(|(i, j)| i * map.rows + j);
        let there = wide && (high(i, j) || high(i + 1, j)) && ks.iter().all(|&k| values[k].is_some());
        there.then(|| {
            let found = turned(ks.map(|k| values[k].unwrap_or_default()), kind);
            std::array::from_fn::<Corner, 4, _>(|n| (places[ks[n]], found[n]))
        })
    };
    for (colour, ranges) in kind.layers(full) {
        let mut runs: Vec<Vec<[f64; 2]>> = Vec::new();
        let mut areas: Vec<Vec<[f64; 2]>> = Vec::new();
        for j in 0..map.rows - 1 {
            let mut run: Option<usize> = None;
            for i in 0..columns {
                let corners = cell(i, j);
                let (mut whole, mut parts) = (false, Vec::new());
                if let Some(corners) = corners {
                    let (low, top) =
                        corners.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), c| (a.min(c.1), b.max(c.1)));
                    let ranges = ranges(low, top);
                    whole = ranges.iter().any(|[from, to]| *from <= low && top <= *to);
                    parts =
                        if whole { Vec::new() } else { ranges.iter().map(|range| clipped(&corners, *range)).collect() };
                }
                if whole {
                    run.get_or_insert(i);
                    continue;
                }
                if let Some(from) = run.take() {
                    // A hair wider and higher than its cells, which is drawn far quicker than a line around them.
                    let along = |k: usize| {
                        if k == from {
                            -HAIR
                        } else if k == i {
                            HAIR
                        } else {
                            0.0
                        }
                    };
                    let grown = |k: usize, row: usize, by: f64| {
                        let [x, y] = places[k * map.rows + row];
                        [x + along(k), y + by]
                    };
                    let below = (from..=i).map(|k| grown(k, j, HAIR));
                    let above = (from..=i).rev().map(|k| grown(k, j + 1, -HAIR));
                    runs.push(below.chain(above).collect());
                }
                areas.extend(parts.into_iter().filter(|part| part.len() > 2));
            }
        }
        canvas.areas(&runs, &colour, false);
        canvas.areas(&areas, &colour, true);
    }
}

/// The part of a cell in which what is linear between its corners lies in a range.
fn clipped(corners: &[Corner], [low, high]: [f64; 2]) -> Vec<[f64; 2]> {
    let above = half(corners, |value| value - low);
    half(&above, |value| high - value).into_iter().map(|(place, _)| place).collect()
}

/// The part of a polygon in which a function of what is linear between its corners is not negative.
fn half(corners: &[Corner], sign: impl Fn(f64) -> f64) -> Vec<Corner> {
    let mut part = Vec::with_capacity(corners.len() + 1);
    for (k, &(p, value)) in corners.iter().enumerate() {
        let (q, other) = corners[(k + 1) % corners.len()];
        let (a, b) = (sign(value), sign(other));
        if a >= 0.0 {
            part.push((p, value));
        }
        if (a < 0.0) != (b < 0.0) {
            let t = a / (a - b);
            part.push(([p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1])], value + t * (other - value)));
        }
    }
    part
}

/// The knot lines of the surface where curvature `which` jumps by [`JUMP_STEP`] or more, or the tangent plane breaks.
/// Whether there are lines of either kind.
fn draw_breaks(canvas: &mut Canvas, chart: &Chart, map: &SurfaceMap, which: usize, full: f64) -> [bool; 2] {
    let mut drawn = [false; 2];
    let step = |value: f64| (value.abs() / full).min(1.0).sqrt().copysign(value) * f64::from(STEPS);
    for found in &map.breaks {
        let mut runs: [Vec<[f64; 2]>; 2] = [Vec::new(), Vec::new()];
        for [a, b] in map.across(found) {
            let angle =
                a.normal.zip(b.normal).map_or(0.0, |(n, m)| (0..3).map(|d| (n[d] - m[d]).powi(2)).sum::<f64>().sqrt());
            let knuckle = found.line == KnotLine::Knuckle && angle >= KNUCKLE;
            let difference = a.curvature.zip(b.curvature).map_or(0.0, |(p, q)| (step(p[which]) - step(q[which])).abs());
            let jump = !knuckle && full > 0.0 && difference >= JUMP_STEP;
            let place = chart.place([a.at[0], a.girth]);
            let kinds = [(jump, &JUMP), (knuckle, &KNUCKLE_LINE)];
            for (k, (run, (here, pen))) in runs.iter_mut().zip(kinds).enumerate() {
                drawn[k] |= here;
                if here {
                    run.push(place);
                } else {
                    canvas.polyline(&std::mem::take(run), pen);
                }
            }
        }
        let [jumps, knuckles] = runs;
        canvas.polyline(&jumps, &JUMP);
        canvas.polyline(&knuckles, &KNUCKLE_LINE);
    }
    drawn
}

/// Small signs over the fields of colour, so that they can be distinguished in black and white as well: + where the curvature
/// is positive and
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
