//! The lines that moved most, a panel each: the line with its offsets and combs, and under it how far the offsets lie
//! from the fair line, each with the bar of its tolerance.
//!
//! The strip below is a draughtsman's batten laid straight: 0 is the fair line, dots are offsets of the table, bars run
//! as far as the offset may be moved, the grey line is the surface through the table. The fair line leaves no bar.

use super::combs::{FairingCombs, LONGEST_IN_STRIP};
use super::plan::{AFTER, AFTER_COMB, BEFORE, BEFORE_COMB, name_curvatures};
use super::sections::curves;
use super::strip_lines::{Along, GRID, StripLine, chosen};
use crate::fairing::change::Change;
use crate::fairing::inspect::Comb;
use crate::fairing::record::FairRecord;
use crate::hull::{Cut, Hull};
use crate::plot::paper::canvas::{Anchor, Canvas, Pen, Rectangle, TextStyle};
use crate::plot::paper::error::PlotError;
use crate::plot::paper::font::LETTERS;
use crate::plot::paper::label::LabelPlacer;
use crate::plot::paper::scale::{decimals, multiples, nice_step};
use crate::plot::paper::sheet::Sheet;
use crate::plot::paper::svg::Svg;
use crate::plot::ship::caption;
use crate::plot::ship::comb::{CombScale, draw_arrows};

/// Most that a strip reaches beyond what its offsets and tolerances need, for the surface through the table.
const FARTHEST: f64 = 3.0;
/// Room above and below the panels, and between them \[mm\].
const HEAD: f64 = 22.0;
const FOOT: f64 = 14.0;
const GAP: f64 = 10.0;
/// Room left of a panel for figures \[mm\].
const NAMES: f64 = 16.0;
/// Parts of the height of a panel: words above, the strip below with its axis.
const WORDS: f64 = 6.0;
const STRIP: f64 = 0.34;
const AXIS: f64 = 8.0;
/// What stays free at the left edge of a sheet \[mm\].
const EDGE_OF_SHEET: f64 = 3.0;
const BAR: Pen = Pen::new(0.35, "#9c9c9c");
const FRAME: Pen = Pen::new(0.18, "#000000");
const LIGHT: Pen = Pen::new(0.08, "#c8c8c8");

/// The waterlines that moved most; none of tables without offsets on waterlines.
///
/// # Errors
/// [`PlotError`] when nothing can be drawn.
pub fn fairing_waterlines(record: &FairRecord, combs: &FairingCombs, sheet: Sheet) -> Result<Option<Svg>, PlotError> {
    Ok(compose(record, combs, sheet, Along::Ship).map(|canvas| Svg::new(canvas.finish("fairing-waterlines"))))
}

/// The stations that moved most.
///
/// # Errors
/// [`PlotError`] when nothing can be drawn.
pub fn fairing_stations(record: &FairRecord, combs: &FairingCombs, sheet: Sheet) -> Result<Option<Svg>, PlotError> {
    Ok(compose(record, combs, sheet, Along::Height).map(|canvas| Svg::new(canvas.finish("fairing-stations"))))
}

/// Part of the height of a strip within which crosses of suspects stand.
const INSIDE: f64 = 0.86;

pub(in crate::plot) fn compose(
    record: &FairRecord,
    combs: &FairingCombs,
    sheet: Sheet,
    along: Along,
) -> Option<Canvas> {
    let lines = chosen(record, along);
    let first = lines.first()?.cut;
    let paper = sheet.room();
    let scale = combs.scale(&first).within(LONGEST_IN_STRIP);
    let mut canvas = Canvas::new(paper[0], paper[1]);
    let [title, plural, axis] = along.words();
    let name: String = caption::plain(&record.name).chars().take(60).collect();
    let middle = TextStyle::new(4.5, Anchor::Middle);
    canvas.text([0.5 * paper[0], 7.0], &format!("THE {title} THAT MOVED MOST – {name}"), &middle);
    let words = format!(
        "{}    grey: before, black and blue: after, rings: inflections, arrows: longer teeth, with the curvature after    strips: offsets less the fair line, bars: tolerances",
        combs.words(&first, [lines.len(); 2])
    );
    canvas.text([0.5 * paper[0], 13.5], &words, &TextStyle::new(LETTERS, Anchor::Middle));
    let size = [
        (paper[0] - GAP * (GRID[0] + 1) as f64) / GRID[0] as f64,
        (paper[1] - HEAD - FOOT - GAP * (GRID[1] - 1) as f64) / GRID[1] as f64,
    ];
    for (k, line) in lines.iter().enumerate() {
        let left = GAP + (size[0] + GAP) * (k % GRID[0]) as f64;
        let top = HEAD + (size[1] + GAP) * (k / GRID[0]) as f64;
        let place = Rectangle::new(left + NAMES, top, left + size[0], top + size[1]);
        panel(&mut canvas, record, (along, line), combs.of(line.cut), scale, &place, axis);
    }
    let y = paper[1] - 5.0;
    let style = TextStyle::new(LETTERS, Anchor::Start);
    let mut words = format!("{} {plural} of the table, by the RMS of their moves", lines.len());
    let chord = record.lines.notation.small(record.resolution);
    words.push_str(&format!("    inflections: of bends {chord} or more off their chord"));
    let any = |which: fn(&Change) -> bool| lines.iter().flat_map(|line| &line.offsets).any(|change| which(change));
    if any(|change| change.locked && !change.suspect) {
        words.push_str("    large red squares: locked");
    }
    if any(|change| change.suspect) {
        words.push_str("    red crosses: left out as suspects, at the edge of the strip where they lie beyond it");
    }
    canvas.text([GAP, y], &words, &style);
    canvas.text([paper[0] - 8.0, y], &caption::program(), &TextStyle::new(LETTERS, Anchor::End));
    Some(canvas)
}

/// A range of numbers on a side of a frame.
pub(in crate::plot) struct Range {
    pub(in crate::plot) low: f64,
    pub(in crate::plot) high: f64,
}

impl Range {
    fn of(values: impl Iterator<Item = f64>, room: f64) -> Self {
        let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| (a.min(v), b.max(v)));
        let more = room * (high - low).max(1e-9);
        Self { low: low - more, high: high + more }
    }

    fn share(&self, value: f64) -> f64 {
        (value - self.low) / (self.high - self.low)
    }
}

fn panel(
    canvas: &mut Canvas,
    record: &FairRecord,
    (along, line): (Along, &StripLine<'_>),
    [before, after]: [Vec<&Comb>; 2],
    scale: CombScale,
    place: &Rectangle,
    axis: &str,
) {
    let turns = |list: &[&Comb]| list.iter().map(|comb| comb.inflections.len()).sum::<usize>();
    let used =
        line.offsets.iter().filter_map(|c| c.tolerance.filter(|t| *t > 0.0).map(|t| (c.after - c.before).abs() / t));
    let used = used.fold(0.0, f64::max);
    let words = format!(
        "{}    moves {:.2} mm RMS, {:.2} mm at most    {:.0} % of tolerance    inflections {} → {}",
        line.name,
        1e3 * line.moves[0],
        1e3 * line.moves[1],
        100.0 * used.min(1.0),
        turns(&before),
        turns(&after)
    );
    canvas.text([place.left - NAMES + 6.0, place.top + 1.6], &words, &TextStyle::new(LETTERS, Anchor::Start));
    let strip_top = place.bottom - AXIS - STRIP * place.height();
    let upper = Rectangle::new(place.left, place.top + WORDS, place.right, strip_top - 2.0);
    let strip = Rectangle::new(place.left, strip_top, place.right, place.bottom - AXIS);
    let drawn = [&record.before, &record.after].map(|hull| curves(hull, line.cut, 1e-4 * breadth_of(hull)));
    let k = along.axis();
    let all = || drawn.iter().flatten().flatten();
    let across = Range::of(
        all().map(|p| p[k]).chain(line.offsets.iter().map(|c| along.place(c))),
        (LONGEST_IN_STRIP + 1.0) / (upper.width() - 2.0 * LONGEST_IN_STRIP - 2.0),
    );
    let heights = Range::of(all().map(|p| p[1]).chain(line.offsets.iter().map(|c| c.before)), 0.02);
    // Combs stand on the convex side of the line: they need room above it, and as much under hollows.
    let room = (LONGEST_IN_STRIP + 1.0).min(0.3 * upper.height());
    let below = room;
    let on = |p: [f64; 3]| {
        [
            upper.left + across.share(p[k]) * upper.width(),
            upper.bottom - below - heights.share(p[1]) * (upper.height() - room - below),
        ]
    };
    canvas.begin_clip(&upper);
    let (mut placer, mut cut) = (LabelPlacer::default(), Vec::new());
    for (list, pens, fair) in [(&before, &BEFORE_COMB, false), (&after, &AFTER_COMB, true)] {
        for comb in list {
            let frame = canvas.frame();
            let drawn = scale.draw(canvas, comb, on, pens, &frame);
            draw_arrows(canvas, &drawn.cut, &pens.cut);
            drawn.tips.iter().for_each(|line| placer.add_faint(line));
            if fair {
                placer.add_teeth(&drawn.teeth);
            }
            drawn.cut.iter().for_each(|(arrow, _)| placer.add_arrow(*arrow));
            cut.extend(drawn.cut.into_iter().filter(|_| fair));
            for &place in &comb.inflections {
                let [x, y] = on(place);
                placer.take(Rectangle::new(x, y, x, y).grown(1.2));
            }
        }
    }
    for (lines, pen) in drawn.iter().zip([&BEFORE, &AFTER]) {
        for curve in lines {
            let curve: Vec<[f64; 2]> = curve.iter().map(|&p| on(p)).collect();
            canvas.polyline(&curve, pen);
            placer.add_curve(&curve);
        }
    }
    before.iter().for_each(|comb| CombScale::rings(canvas, comb, on, &BEFORE_COMB));
    after.iter().for_each(|comb| CombScale::rings(canvas, comb, on, &AFTER_COMB));
    for change in &line.offsets {
        let at = on([change.x, change.before, change.z]);
        canvas.area(&square(at, 0.5), "#000000");
        placer.take(Rectangle::new(at[0], at[1], at[0], at[1]).grown(0.6));
    }
    name_curvatures(canvas, &mut placer, &cut, &upper.grown(-0.4));
    canvas.end_group();
    let inner = Rectangle { top: upper.top + room, bottom: upper.bottom - below, ..upper };
    figures(canvas, &inner, &heights, "y [m]");
    canvas.rectangle(&upper, &FRAME);
    deviations(canvas, record, (along, line), &strip, &across);
    let style = TextStyle::new(LETTERS, Anchor::Middle);
    let step = nice_step(across.high - across.low, 10.0);
    for value in multiples(step, across.low, across.high) {
        let x = strip.left + across.share(value) * strip.width();
        canvas.line([x, strip.bottom], [x, strip.bottom + 0.9], &FRAME);
        canvas.text([x, strip.bottom + 2.6], &format!("{:.*}", decimals(step), value + 0.0), &style);
    }
    canvas.text([0.5 * (strip.left + strip.right), strip.bottom + 5.8], axis, &style);
}

fn breadth_of(hull: &Hull) -> f64 {
    hull.particulars().breadth
}

fn square([x, y]: [f64; 2], half: f64) -> [[f64; 2]; 4] {
    [[x - half, y - half], [x + half, y - half], [x + half, y + half], [x - half, y + half]]
}

/// Figures at the left side of a frame, no more of them than keep apart.
fn figures(canvas: &mut Canvas, frame: &Rectangle, range: &Range, name: &str) {
    let style = TextStyle::new(LETTERS, Anchor::End);
    for (y, text) in rules(canvas, frame, range) {
        canvas.text([frame.left - 1.0, y], &text, &style);
    }
    let middle = [frame.left - 13.0, 0.5 * (frame.top + frame.bottom)];
    canvas.text(middle, name, &TextStyle::new(LETTERS, Anchor::Middle).upward());
}

/// Light lines across a frame, no more of them than leave room for their figures, which are returned with their places.
pub(in crate::plot) fn rules(canvas: &mut Canvas, frame: &Rectangle, range: &Range) -> Vec<(f64, String)> {
    let step = nice_step(range.high - range.low, (frame.height() / (1.4 * LETTERS)).clamp(1.0, 5.0));
    let rule = |value: f64| {
        let y = frame.bottom - range.share(value) * frame.height();
        canvas.line([frame.left, y], [frame.right, y], &LIGHT);
        (y, format!("{:.*}", decimals(step), value + 0.0))
    };
    multiples(step, range.low, range.high).into_iter().map(rule).collect()
}

/// The figures of [`rules`] left of a frame that combs reach out of: outside their reach where the sheet has room, or else
/// on a clear ground; what an arrow passes through has no figure.
pub(in crate::plot) fn figures_clear(
    canvas: &mut Canvas,
    placer: &mut LabelPlacer,
    frame: &Rectangle,
    rules: &[(f64, String)],
    name: &str,
) {
    let style = TextStyle::new(LETTERS, Anchor::End).halo();
    let at = |y: f64| [frame.left - 1.0, y];
    let places: Vec<Rectangle> =
        rules.iter().map(|(y, text)| Canvas::text_place(at(*y), text, &style).grown(0.5)).collect();
    let left = places.iter().map(|place| place.left).fold(frame.left - 1.0, f64::min);
    // Between the figures and the edge of the sheet stands the name of the axis.
    let shift = placer.clear_shift(&places, left - EDGE_OF_SHEET - 1.5 * LETTERS);
    for ((y, text), place) in rules.iter().zip(&places) {
        let place = Rectangle { left: place.left - shift, right: place.right - shift, ..*place };
        if placer.has_arrow(&place) {
            continue;
        }
        let [x, y] = at(*y);
        if shift > 0.0 {
            canvas.line([x - shift + 0.6, y], [frame.left, y], &LIGHT);
        }
        canvas.text([x - shift, y], text, &style);
        placer.take(place);
    }
    let usual = (frame.left - 13.0).min(left - shift - 0.9 * LETTERS);
    let middle = [usual.max(EDGE_OF_SHEET + 0.5 * LETTERS), 0.5 * (frame.top + frame.bottom)];
    canvas.text(middle, name, &TextStyle::new(LETTERS, Anchor::Middle).upward());
}

/// The surface through the table less the fair one along a line \[m, mm\], in runs below the deck.
fn departures(record: &FairRecord, (along, line): (Along, &StripLine<'_>)) -> Vec<Vec<[f64; 2]>> {
    const STEPS: u32 = 160;
    let Some((first, last)) = line.offsets.first().zip(line.offsets.last()) else { return Vec::new() };
    let (from, to) = (along.place(first), along.place(last));
    let below_deck = |hull: &Hull, x: f64, z: f64| {
        let slack = 1e-6 * hull.particulars().depth;
        hull.half_breadth(x, z).filter(|_| z <= hull.deck_height(x) + slack)
    };
    let half = |hull: &Hull, at: f64| match line.cut {
        Cut::Waterline { z } => below_deck(hull, at, z),
        Cut::Station { x } => below_deck(hull, x, at),
        _ => None,
    };
    let mut runs = vec![Vec::new()];
    for k in 0..=STEPS {
        let at = from + (to - from) * f64::from(k) / f64::from(STEPS);
        match (half(&record.before, at).zip(half(&record.after, at)), runs.last_mut()) {
            (Some((old, new)), Some(run)) => run.push([at, 1e3 * (old - new)]),
            _ => runs.push(Vec::new()),
        }
    }
    runs
}

/// The strip of offsets less the fair line \[mm\].
fn deviations(
    canvas: &mut Canvas,
    record: &FairRecord,
    (along, line): (Along, &StripLine<'_>),
    strip: &Rectangle,
    across: &Range,
) {
    let kept = || line.offsets.iter().filter(|change| !change.suspect);
    let largest = kept().map(|change| 1e3 * (change.before - change.after).abs()).fold(0.0, f64::max);
    // Bars that are far longer than the moves leave the strip.
    let bars = kept().filter_map(|change| change.tolerance).map(|t| 1e3 * t).fold(0.0, f64::max);
    let least = (1.1 * (largest + bars)).min(8.0 * largest).max(1e-3);
    let departures = departures(record, (along, line));
    let swing = departures.iter().flatten().map(|[_, by]| by.abs()).fold(0.0, f64::max);
    let reach = least.max((1.1 * swing).min(FARTHEST * least));
    let range = Range { low: -reach, high: reach };
    let on = |at: f64, by: f64| {
        [strip.left + across.share(at) * strip.width(), strip.bottom - range.share(by) * strip.height()]
    };
    figures(canvas, strip, &range, "offset - fair [mm]");
    canvas.begin_clip(strip);
    let mut longest = 0.0f64;
    for change in kept() {
        if let Some(tolerance) = change.tolerance {
            let (at, by) = (along.place(change), 1e3 * (change.before - change.after));
            let [from, to] = [-1.0, 1.0].map(|s| on(at, by + s * 1e3 * tolerance));
            canvas.line(from, to, &BAR);
            if from[1] > strip.bottom || to[1] < strip.top {
                longest = longest.max(1e3 * tolerance);
            }
            for end in [from, to] {
                canvas.line([end[0] - 0.7, end[1]], [end[0] + 0.7, end[1]], &BAR);
            }
        }
    }
    for run in &departures {
        canvas.polyline(&run.iter().map(|[at, by]| on(*at, *by)).collect::<Vec<_>>(), &BEFORE);
    }
    canvas.line(on(across.low, 0.0), on(across.high, 0.0), &Pen::new(0.4, "#1f5fa8"));
    for change in kept() {
        let at = on(along.place(change), 1e3 * (change.before - change.after));
        let ink = if change.locked { "#c00000" } else { "#000000" };
        canvas.area(&square(at, if change.locked { 0.9 } else { 0.6 }), ink);
    }
    for change in line.offsets.iter().filter(|change| change.suspect) {
        let by = 1e3 * (change.before - change.after);
        let [x, y] = on(along.place(change), by.clamp(-INSIDE * reach, INSIDE * reach));
        for up in [-1.0, 1.0] {
            canvas.line([x - 1.0, y - up], [x + 1.0, y + up], &Pen::new(0.4, "#c00000"));
        }
    }
    canvas.end_group();
    canvas.rectangle(strip, &FRAME);
    if longest > 0.0 {
        let words = format!("bars that end beyond the strip: tolerance {longest:.1} mm");
        canvas.text([strip.right - 1.0, strip.top + 2.0], &words, &TextStyle::new(LETTERS, Anchor::End).halo());
    }
}
