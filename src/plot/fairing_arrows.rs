//! Body plan before (grey) and after (black) with an arrow for every offset that moved, so many
//! times longer than the move as the sheet says.

use super::canvas::{Anchor, Canvas, Pen, Rectangle, TextStyle};
use super::fairing::{base, extent, midship, short, station_cut, station_words, whole_curves};
use super::label::LabelPlacer;
use super::scale::drawing_scale;
use super::sheet::{LETTERS, Sheet};
use super::station_names::name_stations;
use super::view::{BASE, GRID};
use super::{PlotError, Svg, caption};
use crate::fairing::record::FairRecord;

/// Room at the sides, above and below the sections \[mm\].
const SIDE: f64 = 32.0;
const HEAD: f64 = 40.0;
const FOOT: f64 = 30.0;
/// Length of the arrow of the largest move on A3 \[mm\], at most.
const LONGEST: f64 = 9.0;
/// Arrows shorter than this are not drawn \[mm\].
const LEAST: f64 = 0.25;
pub(super) const BEFORE: Pen = Pen::new(0.2, "#7d7d7d");
pub(super) const AFTER: Pen = Pen::new(0.25, "#000000");
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
pub(super) fn longest(paper: [f64; 2]) -> f64 {
    LONGEST * paper[0] / Sheet::A3.room()[0]
}

/// The largest of 1, 2, 5 times a power of ten, one at least, that keeps `largest` \[mm\] within [`longest`].
fn exaggeration(largest: f64, paper: [f64; 2]) -> f64 {
    let steps = (0..6).flat_map(|power| [1.0, 2.0, 5.0].map(|m| m * 10f64.powi(power)));
    steps.take_while(|n| n * largest <= longest(paper)).last().unwrap_or(1.0)
}

/// Title of the sheet, `words` about its scales, and how far the offsets moved.
pub(super) fn head(canvas: &mut Canvas, record: &FairRecord, paper: [f64; 2], words: &str) {
    let name: String = caption::plain(&record.name).chars().take(60).collect();
    let middle = TextStyle::new(4.5, Anchor::Middle);
    canvas.text([0.5 * paper[0], 9.0], &format!("WHERE THE OFFSETS MOVED – {name}"), &middle);
    let (rms, largest, _) = record.moves();
    let words = format!("{words}    moves {:.2} mm RMS, {:.2} mm at most", 1000.0 * rms, 1000.0 * largest);
    canvas.text([0.5 * paper[0], 16.0], &words, &TextStyle::new(3.2, Anchor::Middle));
}

pub(super) fn compose(record: &FairRecord, sheet: Sheet) -> Result<Canvas, PlotError> {
    let paper = sheet.room();
    let Some((x, breadth, z)) = extent(record) else {
        return Err(PlotError::Chart("the table has no offsets".to_owned()));
    };
    let room = [paper[0] - 2.0 * SIDE, paper[1] - HEAD - FOOT];
    let n = drawing_scale(2.0 * breadth, room[0]).max(drawing_scale(z[1] - z[0], room[1]));
    let millimetres = 1000.0 / f64::from(n);
    let floor = paper[1] - FOOT - 0.5 * (room[1] - millimetres * (z[1] - z[0])).max(0.0);
    let midship = midship(record, x);
    let side = |x: f64| if x < midship { -1.0 } else { 1.0 };
    let at = |x: f64, y: f64, height: f64| {
        [0.5 * paper[0] + side(x) * millimetres * y, floor - millimetres * (height - z[0])]
    };
    let mut canvas = Canvas::new(paper[0], paper[1]);
    let names = TextStyle::new(LETTERS, Anchor::End);
    for &height in &record.lines.waterlines {
        let [aft, fore] = [-1.0, 1.0].map(|s| [0.5 * paper[0] + s * millimetres * breadth, at(x[0], 0.0, height)[1]]);
        canvas.line(aft, fore, &GRID);
    }
    let mut placer = LabelPlacer::default();
    let window = Rectangle::new(8.0, 20.0, paper[0] - 8.0, paper[1] - 14.0);
    for &height in &record.lines.waterlines {
        let place = [0.5 * paper[0] - millimetres * breadth - 12.0, at(x[0], 0.0, height)[1]];
        placer.name_point(&mut canvas, &format!("{height:.3}"), &names, &[place], &window);
    }
    canvas.line(at(x[0], 0.0, z[0]), at(x[0], 0.0, z[1]), &BASE);
    canvas.line(at(x[0], breadth, base(z)), at(x[1], breadth, base(z)), &BASE);
    let mut drawn = Vec::new();
    for (hull, pen) in [(&record.before, &BEFORE), (&record.after, &AFTER)] {
        drawn.clear();
        for (k, station) in record.lines.stations.iter().enumerate() {
            for line in whole_curves(hull, station_cut(record, station.x), 0.01 / millimetres) {
                let line: Vec<[f64; 2]> = line.into_iter().map(|p| at(station.x, p[1], p[2])).collect();
                canvas.polyline(&line, pen);
                drawn.push((k, line));
            }
        }
    }
    let (_, largest, _) = record.moves();
    let times = exaggeration(largest * millimetres, paper);
    for change in &record.changes {
        let from = at(change.x, change.before, change.z);
        if change.suspect {
            ring(&mut canvas, from);
            placer.take(Rectangle::new(from[0], from[1], from[0], from[1]).grown(1.8));
            continue;
        }
        let length = times * millimetres * (change.after - change.before);
        if let Some(drawn) = arrow(&mut canvas, from, [length * side(change.x), 0.0], length) {
            placer.add_arrow(drawn);
        }
    }
    drawn.iter().for_each(|(_, line)| placer.add_curve(line));
    name_stations(&mut canvas, record, &drawn, &mut placer, &window, [0.5 * paper[0], midship]);
    let one = short(f64::from(n) / times);
    let scales =
        format!("scale 1:{n}    arrows {times:.0} times as long as the moves, 1 mm of arrow = {one} mm of move");
    head(&mut canvas, record, paper, &scales);
    let foot = TextStyle::new(LETTERS, Anchor::Middle);
    let names = format!("{}    waterlines by z [m] above the base line", station_words(record));
    canvas.text([0.5 * paper[0], paper[1] - 12.5], &names, &foot);
    let words = TextStyle::new(3.2, Anchor::Middle);
    canvas.text([0.5 * paper[0] - 60.0, paper[1] - 18.0], "AFT", &words);
    canvas.text([0.5 * paper[0] + 60.0, paper[1] - 18.0], "FORWARD", &words);
    key(&mut canvas, paper, ["outward", "inward"], record.changes.iter().any(|change| change.suspect));
    Ok(canvas)
}

/// An arrow along `by` \[mm\], orange where `sign` is positive and blue elsewhere; its head is at most a third of it.
/// None where it would be too short to be seen; its foot and tip otherwise.
pub(super) fn arrow(canvas: &mut Canvas, from: [f64; 2], by: [f64; 2], sign: f64) -> Option<[[f64; 2]; 2]> {
    let length = by[0].hypot(by[1]);
    if length < LEAST {
        return None;
    }
    let pen = if sign > 0.0 { &OUTWARD } else { &INWARD };
    let along = by.map(|d| d / length);
    let tip = [from[0] + by[0], from[1] + by[1]];
    canvas.line(from, tip, pen);
    let head = (0.35 * length).min(1.4);
    let wide = 0.35 * head;
    let corner =
        |s: f64| [tip[0] - head * along[0] - s * wide * along[1], tip[1] - head * along[1] + s * wide * along[0]];
    canvas.area(&[tip, corner(1.0), corner(-1.0)], pen.colour);
    Some([from, tip])
}

/// A ring around an offset that was left out.
pub(super) fn ring(canvas: &mut Canvas, at: [f64; 2]) {
    let points: Vec<[f64; 2]> = (0..=24)
        .map(|k| (std::f64::consts::TAU * f64::from(k) / 24.0).sin_cos())
        .map(|(s, c)| [at[0] + 1.6 * c, at[1] + 1.6 * s])
        .collect();
    canvas.polyline(&points, &SUSPECT);
}

/// The key at the foot of the sheet; `signs` are the words for the two colours of arrows.
pub(super) fn key(canvas: &mut Canvas, paper: [f64; 2], signs: [&str; 2], suspects: bool) {
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
        let _ = arrow(canvas, [start, y], [9.0 * sign, 0.0], sign);
    }
    if suspects {
        let from = add(canvas, "left out as a suspect");
        ring(canvas, [from + 8.0, y]);
    }
    canvas.text([paper[0] - 8.0, y], &caption::program(), &TextStyle::new(LETTERS, Anchor::End));
}
