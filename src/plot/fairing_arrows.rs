//! Body plan before (grey) and after (black) with an arrow for every offset that moved, so many times longer than the move as the
//! sheet says.

use super::canvas::{Anchor, Canvas, Pen, TextStyle};
use super::fairing::{curves, extent, midship};
use super::scale::drawing_scale;
use super::sheet::ROOM;
use super::view::{BASE, GRID};
use super::{PlotError, Svg, caption};
use crate::fairing::record::FairRecord;
use crate::hull::Cut;

/// Room at the sides, above and below the sections \[mm\].
const SIDE: f64 = 32.0;
const HEAD: f64 = 34.0;
const FOOT: f64 = 30.0;
/// Length of the arrow of the largest move \[mm\], at most.
const LONGEST: f64 = 9.0;
/// Arrows shorter than this are not drawn \[mm\].
const LEAST: f64 = 0.25;
const BEFORE: Pen = Pen::new(0.45, "#b0b0b0");
const AFTER: Pen = Pen::new(0.18, "#000000");
const OUTWARD: Pen = Pen::new(0.3, "#b35806");
const INWARD: Pen = Pen::new(0.3, "#2166ac");

/// Draws the plan.
///
/// # Errors
/// [`PlotError::Chart`] for a table without offsets.
pub fn fairing_arrows(record: &FairRecord) -> Result<Svg, PlotError> {
    Ok(Svg { text: compose(record)?.finish("fairing-arrows") })
}

/// The largest of 1, 2, 5 times a power of ten, one at least, that keeps `largest` \[mm\] within [`LONGEST`].
fn exaggeration(largest: f64) -> f64 {
    let steps = (0..6).flat_map(|power| [1.0, 2.0, 5.0].map(|m| m * 10f64.powi(power)));
    steps.take_while(|n| n * largest <= LONGEST).last().unwrap_or(1.0)
}

pub(super) fn compose(record: &FairRecord) -> Result<Canvas, PlotError> {
    let Some((x, breadth, z)) = extent(record) else {
        return Err(PlotError::Chart("the table has no offsets".to_owned()));
    };
    let room = [ROOM[0] - 2.0 * SIDE, ROOM[1] - HEAD - FOOT];
    let n = drawing_scale(2.0 * breadth, room[0]).max(drawing_scale(z[1] - z[0], room[1]));
    let millimetres = 1000.0 / f64::from(n);
    let floor = ROOM[1] - FOOT - 0.5 * (room[1] - millimetres * (z[1] - z[0])).max(0.0);
    let midship = midship(record, x);
    let side = |x: f64| if x < midship { -1.0 } else { 1.0 };
    let at = |x: f64, y: f64, height: f64| {
        [0.5 * ROOM[0] + side(x) * millimetres * y, floor - millimetres * (height - z[0])]
    };
    let mut canvas = Canvas::new(ROOM[0], ROOM[1]);
    let names = TextStyle::new(2.4, Anchor::End);
    for &height in &record.lines.waterlines {
        let [aft, fore] = [-1.0, 1.0].map(|s| [0.5 * ROOM[0] + s * millimetres * breadth, at(x[0], 0.0, height)[1]]);
        canvas.line(aft, fore, &GRID);
    }
    let step = record.lines.waterlines.windows(2).map(|w| w[1] - w[0]).fold(f64::INFINITY, f64::min) * millimetres;
    let stride = (3.2 / step.max(0.1)).ceil().max(1.0) as usize;
    for &height in record.lines.waterlines.iter().step_by(stride) {
        let y = at(x[0], 0.0, height)[1];
        canvas.text([0.5 * ROOM[0] - millimetres * breadth - 12.0, y], &format!("{height:.3}"), &names);
    }
    canvas.line(at(x[0], 0.0, z[0]), at(x[0], 0.0, z[1]), &BASE);
    canvas.line(at(x[0], breadth, z[0]), at(x[1], breadth, z[0]), &BASE);
    for (hull, pen) in [(&record.before, &BEFORE), (&record.after, &AFTER)] {
        for station in &record.lines.stations {
            for line in curves(hull, Cut::Station { x: station.x }, 0.01 / millimetres) {
                let line: Vec<[f64; 2]> = line.into_iter().map(|p| at(station.x, p[1], p[2])).collect();
                canvas.polyline(&line, pen);
            }
        }
    }
    let (rms, largest, _) = record.moves();
    let times = exaggeration(largest * millimetres);
    for change in record.changes.iter().filter(|change| !change.suspect) {
        let from = at(change.x, change.before, change.z);
        let length = times * millimetres * (change.after - change.before) * side(change.x);
        if length.abs() >= LEAST {
            arrow(&mut canvas, from, length, if change.after > change.before { &OUTWARD } else { &INWARD });
        }
    }
    let ring = Pen::new(0.5, "#7000a0");
    let suspects: Vec<_> = record.changes.iter().filter(|change| change.suspect).collect();
    for change in &suspects {
        circle(&mut canvas, at(change.x, change.before, change.z), 1.6, &ring);
    }
    let name: String = caption::plain(&record.name).chars().take(60).collect();
    let middle = TextStyle::new(4.5, Anchor::Middle);
    canvas.text([0.5 * ROOM[0], 9.0], &format!("WHERE THE OFFSETS MOVED – {name}"), &middle);
    let words = format!(
        "scale 1:{n}    arrows {times:.0} times as long as the moves    moves {:.2} mm RMS, {:.2} mm at most",
        1000.0 * rms,
        1000.0 * largest
    );
    canvas.text([0.5 * ROOM[0], 16.0], &words, &TextStyle::new(3.0, Anchor::Middle));
    key(&mut canvas, !suspects.is_empty());
    Ok(canvas)
}

/// A horizontal arrow; its head is at most a third of it.
fn arrow(canvas: &mut Canvas, from: [f64; 2], length: f64, pen: &Pen) {
    let tip = [from[0] + length, from[1]];
    canvas.line(from, tip, pen);
    let head = (0.35 * length.abs()).min(1.4).copysign(length);
    let wide = 0.35 * head.abs();
    canvas.area(&[tip, [tip[0] - head, tip[1] - wide], [tip[0] - head, tip[1] + wide]], pen.colour);
}

fn circle(canvas: &mut Canvas, at: [f64; 2], radius: f64, pen: &Pen) {
    let points: Vec<[f64; 2]> = (0..=24)
        .map(|k| (std::f64::consts::TAU * f64::from(k) / 24.0).sin_cos())
        .map(|(s, c)| [at[0] + radius * c, at[1] + radius * s])
        .collect();
    canvas.polyline(&points, pen);
}

fn key(canvas: &mut Canvas, suspects: bool) {
    let words = TextStyle::new(3.0, Anchor::Middle);
    canvas.text([0.5 * ROOM[0] - 60.0, ROOM[1] - 18.0], "AFT", &words);
    canvas.text([0.5 * ROOM[0] + 60.0, ROOM[1] - 18.0], "FORWARD", &words);
    let y = ROOM[1] - 7.0;
    let style = TextStyle::new(2.8, Anchor::Start);
    let mut x = 14.0;
    for (pen, word) in [(&BEFORE, "before"), (&AFTER, "after")] {
        canvas.line([x, y], [x + 12.0, y], pen);
        canvas.text([x + 14.0, y], word, &style);
        x += 36.0;
    }
    for (pen, length, word) in [(&OUTWARD, 9.0, "outward (forward body)"), (&INWARD, -9.0, "inward (forward body)")] {
        arrow(canvas, [if length > 0.0 { x } else { x + 9.0 }, y], length, pen);
        canvas.text([x + 12.0, y], word, &style);
        x += 60.0;
    }
    if suspects {
        circle(canvas, [x + 2.0, y], 1.6, &Pen::new(0.5, "#7000a0"));
        canvas.text([x + 6.0, y], "left out as a suspect", &style);
    }
    canvas.text([ROOM[0] - 8.0, y], &caption::program(), &TextStyle::new(2.2, Anchor::End));
}
