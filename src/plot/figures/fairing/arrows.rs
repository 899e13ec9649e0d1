//! Body plan before (grey) and after (black) with an arrow for every offset that moved, so many
//! times longer than the move as the sheet says. Where arrows or rings would overlap the longer is drawn, and the sheet says
//! how many are not.

use super::body::BodyView;
use super::plan::{left_out_words, station_words};
use super::sections::{station_cut, whole_curves};
use crate::fairing::record::FairRecord;
use crate::plot::paper::canvas::{Anchor, Canvas, Pen, Rectangle, TextStyle};
use crate::plot::paper::error::PlotError;
use crate::plot::paper::font::LETTERS;
use crate::plot::paper::label::LabelPlacer;
use crate::plot::paper::scale::short;
use crate::plot::paper::sheet::Sheet;
use crate::plot::paper::svg::Svg;
use crate::plot::ship::caption;
use crate::plot::ship::station_names::name_stations;

/// Length of the arrow of the largest move on A3 \[mm\], at most.
const LONGEST: f64 = 9.0;
/// Arrows shorter than this are not drawn \[mm\].
const LEAST: f64 = 0.25;
/// Radius of the ring around a suspect, and what arrows keep between them \[mm\].
const RING: f64 = 1.6;
const APART: f64 = 0.6;
pub(in crate::plot) const BEFORE: Pen = Pen::new(0.2, "#7d7d7d");
pub(in crate::plot) const AFTER: Pen = Pen::new(0.25, "#000000");
const OUTWARD: Pen = Pen::new(0.3, "#b35806");
const INWARD: Pen = Pen::new(0.3, "#2166ac");
const SUSPECT: Pen = Pen::new(0.5, "#7000a0");

/// Draws the plan.
///
/// # Errors
/// [`PlotError::Chart`] for a table without offsets.
pub fn fairing_arrows(record: &FairRecord, sheet: Sheet) -> Result<Svg, PlotError> {
    Ok(Svg::new(compose(record, sheet)?.finish("fairing-arrows")))
}

/// Length of the longest arrow, which grows with the paper \[mm\].
pub(in crate::plot) fn longest(paper: [f64; 2]) -> f64 {
    LONGEST * paper[0] / Sheet::A3.room()[0]
}

/// The largest of 1, 2, 5 times a power of ten, one at least, that keeps `largest` \[mm\] within [`longest`].
fn exaggeration(largest: f64, paper: [f64; 2]) -> f64 {
    let steps = (0..6).flat_map(|power| [1.0, 2.0, 5.0].map(|m| m * 10f64.powi(power)));
    steps.take_while(|n| n * largest <= longest(paper)).last().unwrap_or(1.0)
}

/// Title of the sheet, `words` about its scales, how far the offsets moved, and how many arrows and rings are not drawn.
pub(in crate::plot) fn head(canvas: &mut Canvas, record: &FairRecord, paper: [f64; 2], words: &str, left: [usize; 2]) {
    let name: String = caption::plain(&record.name).chars().take(60).collect();
    let middle = TextStyle::new(4.5, Anchor::Middle);
    canvas.text([0.5 * paper[0], 9.0], &format!("WHERE THE OFFSETS MOVED – {name}"), &middle);
    let (rms, largest, _) = record.moves();
    let words = format!("{words}    moves {:.2} mm RMS, {:.2} mm at most", 1000.0 * rms, 1000.0 * largest);
    canvas.text([0.5 * paper[0], 16.0], &words, &TextStyle::new(3.2, Anchor::Middle));
    if let Some(left) = left_out_words(left) {
        canvas.text([0.5 * paper[0], 21.3], &left, &TextStyle::new(LETTERS, Anchor::Middle));
    }
}

pub(in crate::plot) fn compose(record: &FairRecord, sheet: Sheet) -> Result<Canvas, PlotError> {
    let paper = sheet.room();
    let Some(view) = BodyView::new(record, paper) else {
        return Err(PlotError::Chart("the table has no offsets".to_owned()));
    };
    let mut canvas = Canvas::new(paper[0], paper[1]);
    let heights = view.draw_grid(&mut canvas, record);
    let mut drawn = Vec::new();
    for (hull, pen) in [(&record.before, &BEFORE), (&record.after, &AFTER)] {
        drawn.clear();
        for (k, station) in record.lines.stations.iter().enumerate() {
            let side = view.side(station.x);
            for line in whole_curves(hull, station_cut(record, station.x), 0.01 / view.millimetres) {
                let line: Vec<[f64; 2]> = line.into_iter().map(|p| view.on(side, p[1], p[2])).collect();
                canvas.polyline(&line, pen);
                drawn.push((k, line));
            }
        }
    }
    let (_, largest, _) = record.moves();
    let times = exaggeration(largest * view.millimetres, paper);
    let mut moves = Moves::default();
    for change in &record.changes {
        let side = view.side(change.x);
        let from = view.on(side, change.before, change.z);
        let length = times * view.millimetres * (change.after - change.before);
        moves.add(from, (!change.suspect).then_some(([length * side, 0.0], length)));
    }
    let mut placer = LabelPlacer::default();
    let left = moves.draw(&mut canvas, &mut placer, &view.window);
    drawn.iter().for_each(|(_, line)| placer.add_curve(line));
    placer.add_curve(&view.base_line());
    let one = short(f64::from(view.n) / times);
    let scales =
        format!("scale 1:{}    arrows {times:.0} times as long as the moves, 1 mm of arrow = {one} mm of move", view.n);
    head(&mut canvas, record, paper, &scales, left);
    let foot = TextStyle::new(LETTERS, Anchor::Middle);
    let names = format!("{}    waterlines by z [m] above the base line", station_words(record));
    canvas.text([0.5 * paper[0], paper[1] - 12.5], &names, &foot);
    view.name_sides(&mut canvas, paper);
    key(&mut canvas, paper, ["outward", "inward"], record.changes.iter().any(|change| change.suspect));
    canvas.texts().iter().for_each(|text| placer.take(text.place));
    view.name_heights(&mut canvas, &mut placer, &heights);
    name_stations(&mut canvas, record, &drawn, &mut placer, &view.window, [view.centre, view.midship]);
    Ok(canvas)
}

/// What offsets did, to be drawn at once: rings around suspects, arrows for the others.
#[derive(Debug, Default)]
pub(in crate::plot) struct Moves {
    rings: Vec<[f64; 2]>,
    /// Foot, way, and a number whose sign says outward or inward.
    arrows: Vec<([f64; 2], [f64; 2], f64)>,
}

impl Moves {
    /// An offset at a place: its way with its sign, none of a suspect.
    pub(in crate::plot) fn add(&mut self, at: [f64; 2], way: Option<([f64; 2], f64)>) {
        match way {
            Some((by, sign)) => self.arrows.push((at, by, sign)),
            None => self.rings.push(at),
        }
    }

    /// Draws those that keep apart and stay inside `window`, rings first, then the longest arrows; how many arrows and rings
    /// were not drawn. Moves that are too small to be seen count as drawn.
    pub(in crate::plot) fn draw(
        mut self,
        canvas: &mut Canvas,
        placer: &mut LabelPlacer,
        window: &Rectangle,
    ) -> [usize; 2] {
        let mut taken: Vec<Rectangle> = Vec::new();
        let mut left = [0, 0];
        let free = |taken: &[Rectangle], place: &Rectangle| {
            window.contains(place) && !taken.iter().any(|other| other.overlaps(place))
        };
        for [x, y] in self.rings {
            let place = Rectangle::new(x, y, x, y).grown(RING);
            if free(&taken, &place.grown(-0.2 * RING)) {
                canvas.ring([x, y], RING, &SUSPECT);
                placer.take(place.grown(0.2));
                taken.push(place);
            } else {
                left[1] += 1;
            }
        }
        let length = |by: [f64; 2]| by[0].hypot(by[1]);
        self.arrows.retain(|(_, by, _)| length(*by) >= LEAST);
        self.arrows.sort_by(|a, b| length(b.1).total_cmp(&length(a.1)));
        for (from, by, sign) in self.arrows {
            let tip = [from[0] + by[0], from[1] + by[1]];
            let [x, y] = [0, 1].map(|d| [from[d].min(tip[d]), from[d].max(tip[d])]);
            let place = Rectangle::new(x[0], y[0], x[1], y[1]).grown(0.5 * APART);
            if free(&taken, &place) {
                arrow(canvas, from, by, sign);
                placer.add_arrow([from, tip]);
                taken.push(place);
            } else {
                left[0] += 1;
            }
        }
        left
    }
}

/// An arrow along `by` \[mm\], orange where `sign` is positive and blue elsewhere; its head is at most a third of it.
fn arrow(canvas: &mut Canvas, from: [f64; 2], by: [f64; 2], sign: f64) {
    let length = by[0].hypot(by[1]).max(1e-9);
    let pen = if sign > 0.0 { &OUTWARD } else { &INWARD };
    let along = by.map(|d| d / length);
    let tip = [from[0] + by[0], from[1] + by[1]];
    canvas.line(from, tip, pen);
    let head = (0.35 * length).min(1.4);
    let wide = 0.35 * head;
    let corner =
        |s: f64| [tip[0] - head * along[0] - s * wide * along[1], tip[1] - head * along[1] + s * wide * along[0]];
    canvas.area(&[tip, corner(1.0), corner(-1.0)], pen.colour);
}

/// A ring around an offset that was left out.
/// The key at the foot of the sheet; `signs` are the words for the two colours of arrows.
pub(in crate::plot) fn key(canvas: &mut Canvas, paper: [f64; 2], signs: [&str; 2], suspects: bool) {
    let y = paper[1] - 7.0;
    let style = TextStyle::new(LETTERS, Anchor::Start);
    let mut x = 14.0;
    let mut add = |canvas: &mut Canvas, word: &str| {
        let place = [x + 14.0, y];
        canvas.text(place, word, &style);
        let from = x;
        x = Canvas::text_place(place, word, &style).right + 10.0;
        from
    };
    for (pen, word) in [(&BEFORE, "before"), (&AFTER, "after")] {
        let from = add(canvas, word);
        canvas.line([from, y], [from + 12.0, y], pen);
    }
    for (sign, word) in [1.0, -1.0].into_iter().zip(signs) {
        let from = add(canvas, word);
        let start = if sign > 0.0 { from } else { from + 11.0 };
        arrow(canvas, [start, y], [9.0 * sign, 0.0], sign);
    }
    if suspects {
        let from = add(canvas, "left out as a suspect");
        canvas.ring([from + 8.0, y], RING, &SUSPECT);
    }
    canvas.text([paper[0] - 8.0, y], &caption::program(), &TextStyle::new(LETTERS, Anchor::End));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arrows_keep_apart_and_inside_the_window() {
        let mut moves = Moves::default();
        for (k, length) in [6.0, 4.0, 0.1, 5.0].into_iter().enumerate() {
            moves.add([20.0 + k as f64, 20.0], Some(([length, 0.0], length)));
        }
        moves.add([20.0, 26.0], Some(([-9.0, 0.0], -9.0)));
        moves.add([38.0, 30.0], Some(([5.0, 0.0], 5.0)));
        moves.add([20.0, 40.0], None);
        moves.add([21.0, 40.0], None);
        let (mut canvas, mut placer) = (Canvas::new(60.0, 60.0), LabelPlacer::default());
        let left = moves.draw(&mut canvas, &mut placer, &Rectangle::new(10.0, 10.0, 40.0, 50.0));
        // Two on the longest of the row, one that would leave the window, one ring on another.
        assert_eq!(left, [3, 1]);
    }
}
