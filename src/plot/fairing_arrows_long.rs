//! The moves in the two long views: in the half-breadth plan an arrow for every offset, in the profile an arrow for every crossing of a
//! buttock with a station.
//!
//! Half-breadths move, heights do not: z belongs to the chart of the hull. The arrows of the profile say how far the buttocks rise or
//! fall with the half-breadths. Across the ship both views are stretched by a whole number, which is printed; arrows are so many times
//! longer than the stretched moves as the sheet says.

use super::canvas::{Anchor, Canvas, Rectangle, TextStyle};
use super::fairing::{LONG_SIDE, base, curves, extent};
use super::fairing_arrows::{AFTER, BEFORE, arrow, exaggeration, head, key, ring};
use super::label::{LabelPlacer, Preference};
use super::scale::drawing_scale;
use super::sheet::{LETTERS, Sheet};
use super::station_names::ROWS;
use super::view::{BASE, GRID};
use super::{PlotError, Svg, caption};
use crate::fairing::inspect::Planes;
use crate::fairing::record::FairRecord;
use crate::hull::Cut;

/// Room above the profile, between the views and below them \[mm\].
const HEAD: f64 = 32.0;
const BETWEEN: f64 = 26.0;
const FOOT: f64 = 29.0;

/// Draws both views.
///
/// # Errors
/// [`PlotError::Chart`] for a table without offsets.
pub fn fairing_arrows_long(record: &FairRecord, sheet: Sheet) -> Result<Svg, PlotError> {
    Ok(Svg::new(compose(record, sheet)?.finish("fairing-arrows-long")))
}

/// One of the views: which coordinate of the ship stands upright on it, and how.
struct LongView {
    /// Coordinate across: 1 for half-breadths, 2 for heights.
    axis: usize,
    /// Where the aft end of the offsets and the least of the coordinate stand \[mm\].
    origin: [f64; 2],
    /// x of the aft end, and the least of the coordinate \[m\].
    from: [f64; 2],
    millimetres: f64,
    stretch: f64,
    /// Times by which arrows are longer than the stretched moves.
    times: f64,
}

impl LongView {
    fn at(&self, p: [f64; 3]) -> [f64; 2] {
        let [x, y] = self.origin;
        [
            x + self.millimetres * (p[0] - self.from[0]),
            y - self.stretch * self.millimetres * (p[self.axis] - self.from[1]),
        ]
    }

    fn arrow(&self, canvas: &mut Canvas, from: [f64; 3], by: f64) {
        arrow(canvas, self.at(from), [0.0, -self.times * self.stretch * self.millimetres * by], by);
    }
}

/// Heights of a buttock at `x`.
fn heights(lines: &[Vec<[f64; 3]>], x: f64) -> Vec<f64> {
    let crossing = |pair: &[[f64; 3]]| {
        let [a, b] = [pair[0], pair[1]];
        let inside = (a[0] <= x && x < b[0]) || (b[0] <= x && x < a[0]);
        inside.then(|| a[2] + (x - a[0]) / (b[0] - a[0]) * (b[2] - a[2]))
    };
    lines.iter().flat_map(|line| line.windows(2).filter_map(crossing)).collect()
}

/// Where the buttocks cross the stations before, and how much higher they do after; crossings that only one of the hulls has are left
/// out, and such as move by more than a fiftieth of `height`.
fn risen(before: &[Vec<[f64; 3]>], after: &[Vec<[f64; 3]>], x: f64, height: f64) -> Vec<[f64; 2]> {
    let (old, new) = (heights(before, x), heights(after, x));
    if old.len() != new.len() {
        return Vec::new();
    }
    let pairs = old.into_iter().zip(new).map(|(a, b)| [a, b - a]);
    pairs.filter(|[_, by]| by.abs() <= 0.02 * height).collect()
}

pub(super) fn compose(record: &FairRecord, sheet: Sheet) -> Result<Canvas, PlotError> {
    let paper = sheet.room();
    let Some((x, breadth, z)) = extent(record) else {
        return Err(PlotError::Chart("the table has no offsets".to_owned()));
    };
    let n = drawing_scale(x[1] - x[0], paper[0] - 2.0 * LONG_SIDE);
    let millimetres = 1000.0 / f64::from(n);
    let left = 0.5 * (paper[0] - millimetres * (x[1] - x[0]));
    let room = paper[1] - HEAD - BETWEEN - FOOT;
    // One stretch for both views, so that they can be compared.
    let stretch = (room / ((breadth + z[1] - z[0]) * millimetres)).floor().clamp(1.0, 10.0);
    let across = stretch * millimetres;
    let fine = 0.01 / across;

    let buttocks = Planes::with_defaults(&record.after).buttocks;
    let cut = |hull, y: f64| curves(hull, Cut::Buttock { y }, fine);
    let pairs: Vec<[Vec<Vec<[f64; 3]>>; 2]> =
        buttocks.iter().map(|&y| [cut(&record.before, y), cut(&record.after, y)]).collect();
    let rises: Vec<([f64; 3], f64)> = buttocks
        .iter()
        .zip(&pairs)
        .flat_map(|(&y, [before, after])| {
            let at = move |x: f64| risen(before, after, x, z[1] - z[0]).into_iter().map(move |[z, by]| ([x, y, z], by));
            record.lines.stations.iter().flat_map(move |station| at(station.x))
        })
        .collect();
    let (_, largest, _) = record.moves();
    let highest = rises.iter().map(|(_, by)| by.abs()).fold(0.0, f64::max);
    let view = |axis: usize, floor: f64, from: f64, largest: f64| LongView {
        axis,
        origin: [left, floor],
        from: [x[0], from],
        millimetres,
        stretch,
        times: exaggeration(largest * across, paper),
    };
    let profile = view(2, HEAD + across * (z[1] - z[0]), z[0], highest);
    let plan = view(1, paper[1] - FOOT, 0.0, largest);

    let mut canvas = Canvas::new(paper[0], paper[1]);
    let mut placer = LabelPlacer::default();
    for (view, top) in [(&profile, [0.0, 0.0, z[1]]), (&plan, [0.0, breadth, 0.0])] {
        let low = [0.0, 0.0, z[0]];
        for station in &record.lines.stations {
            let foot = view.at([station.x, 0.0, low[2]]);
            canvas.line(foot, view.at([station.x, top[1], top[2]]), &GRID);
            let style = TextStyle::new(LETTERS, Anchor::Middle);
            let name: String = caption::plain(&station.name).chars().take(9).collect();
            let window = Rectangle::new(4.0, 18.0, paper[0] - 4.0, paper[1] - 12.0);
            let places = ROWS.map(|down| [foot[0], foot[1] + down]);
            placer.name_point(&mut canvas, &name, &style, &places, &window);
        }
        canvas.line(view.at([x[0], 0.0, base(z)]), view.at([x[1], 0.0, base(z)]), &BASE);
    }
    let mut drawn: Vec<(usize, Vec<[f64; 2]>)> = Vec::new();
    for (k, [before, after]) in pairs.iter().enumerate() {
        for (lines, pen) in [(before, &BEFORE), (after, &AFTER)] {
            for line in lines {
                let line: Vec<[f64; 2]> = line.iter().map(|&p| profile.at(p)).collect();
                canvas.polyline(&line, pen);
                drawn.push((k, line));
            }
        }
    }
    for (hull, pen) in [(&record.before, &BEFORE), (&record.after, &AFTER)] {
        for &z in &record.lines.waterlines {
            for line in curves(hull, Cut::Waterline { z }, fine) {
                canvas.polyline(&line.into_iter().map(|p| plan.at(p)).collect::<Vec<_>>(), pen);
            }
        }
    }
    rises.iter().for_each(|(from, by)| profile.arrow(&mut canvas, *from, *by));
    for change in &record.changes {
        let from = [change.x, change.before, change.z];
        if change.suspect {
            ring(&mut canvas, plan.at(from));
        } else {
            plan.arrow(&mut canvas, from, change.after - change.before);
        }
    }
    let window = Rectangle::new(8.0, 24.0, paper[0] - 8.0, paper[1] - 14.0);
    drawn.iter().for_each(|(_, line)| placer.add_curve(line));
    for (k, y) in buttocks.iter().enumerate() {
        let Some(curve) = drawn.iter().position(|(other, _)| *other == k) else { continue };
        let preferred = Preference { part: 0.15 + 0.1 * (k % 3) as f64, crossings: 3, beside: false };
        placer.name_curve(
            &mut canvas,
            curve,
            &format!("y {y:.2} m"),
            &TextStyle::new(LETTERS, Anchor::Middle),
            preferred,
            &window,
        );
    }
    let style = TextStyle::new(3.2, Anchor::Start);
    let words = [
        format!(
            "PROFILE    buttocks; no height moves: arrows show how far buttocks rise or fall with the half-breadths, {:.0} times as long, \
             {:.1} mm at most",
            profile.times,
            1000.0 * highest
        ),
        format!("HALF-BREADTH PLAN    arrows {:.0} times as long as the moves", plan.times),
    ];
    canvas.text([left, HEAD - 6.0], &words[0], &style);
    canvas.text([left, plan.at([x[0], breadth, 0.0])[1] - 6.0], &words[1], &style);
    head(&mut canvas, record, paper, &format!("scale 1:{n}, breadths and heights x {stretch:.0}, moves with them"));
    let y = paper[1] - 14.0;
    canvas.text([14.0, y], "AFT", &style);
    canvas.text([paper[0] - 14.0, y], "FORWARD", &TextStyle::new(3.2, Anchor::End));
    let suspects = record.changes.iter().any(|change| change.suspect);
    key(&mut canvas, paper, ["outward, up", "inward, down"], suspects);
    Ok(canvas)
}
