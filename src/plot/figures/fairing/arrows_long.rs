//! The moves in the two long views: in the half-breadth plan an arrow for every offset, in the profile an arrow for
//! every crossing of a buttock with a station.
//!
//! Half-breadths move, heights do not: z belongs to the chart of the hull. The arrows of the profile say how far the
//! buttocks rise or fall with the half-breadths. Across the ship both views are stretched by a whole number, which is
//! printed; arrows have a scale of their own, millimetres of move a millimetre of arrow.

use super::arrows::{AFTER, BEFORE, Moves, head, key, longest};
use super::plan::station_words;
use super::sections::curves;
use crate::fairing::inspect::Planes;
use crate::fairing::record::FairRecord;
use crate::hull::Cut;
use crate::plot::paper::canvas::{Anchor, Canvas, Rectangle, TextStyle};
use crate::plot::paper::error::PlotError;
use crate::plot::paper::font::LETTERS;
use crate::plot::paper::label::{LabelPlacer, Preference, length};
use crate::plot::paper::scale::{drawing_scale, sheet_scale, short};
use crate::plot::paper::sheet::Sheet;
use crate::plot::paper::svg::Svg;
use crate::plot::ship::extent::{LONG_SIDES, base, extent, long_left, long_scale};
use crate::plot::ship::extrapolated::{BEYOND, guessed, known, parts, profile_parts};
use crate::plot::ship::station_names::ROWS;
use crate::plot::ship::view::{BASE, DESIGN, GRID, OUTLINE, THREAD};
use crate::plot::ship::{caption, outline};

/// Room above the profile, between the views and below them \[mm\].
const HEAD: f64 = 33.0;
const BETWEEN: f64 = 26.0;
const FOOT: f64 = 32.0;

/// Pieces of buttocks as long as this, and as far from other pieces, bear names of their own \[mm\].
const PIECE: f64 = 6.0;

/// The middle of the rectangle around a line \[mm\].
fn middle_of(line: &[[f64; 2]]) -> [f64; 2] {
    [0, 1].map(|d| {
        let range = |(low, high): (f64, f64), p: &[f64; 2]| (low.min(p[d]), high.max(p[d]));
        let (low, high) = line.iter().fold((f64::INFINITY, f64::NEG_INFINITY), range);
        0.5 * (low + high)
    })
}

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
    /// Move that an arrow of a millimetre stands for \[mm\].
    move_a_millimetre: f64,
}

impl LongView {
    fn at(&self, p: [f64; 3]) -> [f64; 2] {
        let [x, y] = self.origin;
        [
            x + self.millimetres * (p[0] - self.from[0]),
            y - self.stretch * self.millimetres * (p[self.axis] - self.from[1]),
        ]
    }

    /// Adds the move `by` of a point.
    fn add(&self, moves: &mut Moves, from: [f64; 3], by: f64) {
        moves.add(self.at(from), Some(([0.0, -1000.0 * by / self.move_a_millimetre], by)));
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

/// Where the buttocks cross the stations before, and how much higher they do after; crossings that only one of the
/// hulls has are left out, and such as move by more than a fiftieth of `height`.
fn risen(before: &[Vec<[f64; 3]>], after: &[Vec<[f64; 3]>], x: f64, height: f64) -> Vec<[f64; 2]> {
    let (old, new) = (heights(before, x), heights(after, x));
    if old.len() != new.len() {
        return Vec::new();
    }
    let pairs = old.into_iter().zip(new).map(|(a, b)| [a, b - a]);
    pairs.filter(|[_, by]| by.abs() <= 0.02 * height).collect()
}

pub(in crate::plot) fn compose(record: &FairRecord, sheet: Sheet) -> Result<Canvas, PlotError> {
    let paper = sheet.room();
    let Some((x, breadth, z)) = extent(record) else {
        return Err(PlotError::Chart("the table has no offsets".to_owned()));
    };
    let deck = outline::deck_at_side(&record.after);
    let z = [z[0], deck.iter().map(|p| p[2]).fold(z[1], f64::max)];
    let breadth = deck.iter().map(|p| p[1]).fold(breadth, f64::max);
    let room = paper[1] - HEAD - BETWEEN - FOOT;
    let n = long_scale(x, paper).max(drawing_scale(breadth + z[1] - z[0], room));
    let millimetres = 1000.0 / f64::from(n);
    let left = long_left(paper, millimetres * (x[1] - x[0]));
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
        move_a_millimetre: sheet_scale(1000.0 * largest, longest(paper)),
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
    // Heights of the waterlines, that of the draught before all.
    let style = TextStyle::new(LETTERS, Anchor::End);
    let draught = record.after.particulars().draught.filter(|draught| (z[0]..=z[1]).contains(draught));
    let window = Rectangle::new(4.0, 18.0, paper[0] - 4.0, paper[1] - 12.0);
    let [aft, fore] = [x[0], x[1]].map(|x| move |z: f64| [x, 0.0, z]);
    if let Some(draught) = draught {
        let [from, to] = [profile.at(aft(draught)), profile.at(fore(draught))];
        canvas.line(from, to, &DESIGN);
    }
    for &height in record.lines.waterlines.iter().filter(|height| **height <= z[1]) {
        let [from, to] = [profile.at(aft(height)), profile.at(fore(height))];
        canvas.line(from, to, &GRID);
        placer.name_point(&mut canvas, &short(height), &style, &[[from[0] - 2.0, from[1]]], &window);
    }
    let centreplane: Vec<[f64; 3]> =
        outline::centreplane(&record.after).into_iter().map(|[x, z]| [x, 0.0, z]).collect();
    let outlines: Vec<Vec<[f64; 2]>> = [(&profile, centreplane.clone()), (&profile, deck.clone()), (&plan, deck)]
        .into_iter()
        .map(|(view, line): (&LongView, Vec<[f64; 3]>)| line.into_iter().map(|p| view.at(p)).collect())
        .collect();
    let mut beyond = false;
    for (out, part) in profile_parts(record, &centreplane) {
        let part: Vec<[f64; 2]> = part.into_iter().map(|p| profile.at(p)).collect();
        canvas.polyline(&part, &if out { guessed(OUTLINE) } else { OUTLINE });
        beyond |= out;
    }
    outlines[1..].iter().for_each(|line| canvas.polyline(line, &OUTLINE));
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
    // Numbered on from the buttocks.
    for (hull, pen) in [(&record.before, &BEFORE), (&record.after, &AFTER)] {
        for (k, &z) in record.lines.waterlines.iter().enumerate() {
            let cut = Cut::Waterline { z };
            for line in curves(hull, cut, fine) {
                for (out, part) in parts(&line, known(record, &cut)) {
                    let part: Vec<[f64; 2]> = part.into_iter().map(|p| plan.at(p)).collect();
                    let pen = if out { guessed(*pen) } else { *pen };
                    canvas.polyline(&part, &pen);
                    beyond |= out;
                }
                let line: Vec<[f64; 2]> = line.into_iter().map(|p| plan.at(p)).collect();
                drawn.push((buttocks.len() + k, line));
            }
        }
    }
    let mut moves = Moves::default();
    rises.iter().for_each(|(from, by)| profile.add(&mut moves, *from, *by));
    for change in &record.changes {
        let from = [change.x, change.before, change.z];
        if change.suspect {
            moves.add(plan.at(from), None);
        } else {
            plan.add(&mut moves, from, change.after - change.before);
        }
    }
    let window = Rectangle::new(8.0, 24.0, paper[0] - 8.0, paper[1] - 14.0);
    let left_out = moves.draw(&mut canvas, &mut placer, &window);
    let small = TextStyle::new(3.2, Anchor::Start);
    let words = [
        format!(
            "PROFILE    heights by z [m], buttocks by y; arrows: how far they rise or fall, {:.1} mm at most, 1 mm of arrow = {} mm",
            1000.0 * highest,
            profile.move_a_millimetre
        ),
        format!(
            "HALF-BREADTH PLAN    waterlines by z [m]; arrows: moves of the offsets, 1 mm of arrow = {} mm",
            plan.move_a_millimetre
        ),
    ];
    let start = left.min(LONG_SIDES[0]);
    canvas.text([start, HEAD - 7.0], &words[0], &small);
    canvas.text([start, plan.at([x[0], breadth, 0.0])[1] - 6.0], &words[1], &small);
    for text in canvas.texts() {
        placer.take(text.place);
    }
    drawn.iter().map(|(_, line)| line).chain(&outlines).for_each(|line| placer.add_curve(line));
    for view in [&profile, &plan] {
        placer.add_curve(&[view.at([x[0], 0.0, base(z)]), view.at([x[1], 0.0, base(z)])]);
    }
    if let Some(draught) = draught {
        // Over the line, where it meets fewest others.
        let words = format!("DWL {draught:.2} m");
        let style = TextStyle::new(LETTERS, Anchor::Start).halo();
        let [from, to] = [profile.at(aft(draught)), profile.at(fore(draught))];
        let places: Vec<[f64; 2]> =
            (0..40).map(|k| [from[0] + 1.5 + 0.025 * f64::from(k) * (to[0] - from[0]), from[1] - 2.4]).collect();
        placer.name_clear(&mut canvas, &words, &style, &places, &window);
    }
    let style = TextStyle::new(LETTERS, Anchor::Middle);
    let names = buttocks.iter().map(|y| format!("y {y:.2} m"));
    let names = names.chain(record.lines.waterlines.iter().map(|z| short(*z)));
    for (k, name) in names.enumerate() {
        // Of a waterline the longest piece bears the name, of a buttock every piece that can be told from a dot.
        let mut pieces: Vec<usize> = (0..drawn.len()).filter(|curve| drawn[*curve].0 == k).collect();
        pieces.sort_by(|a, b| length(&drawn[*b].1).total_cmp(&length(&drawn[*a].1)));
        // Before and after lie on each other.
        let mut named: Vec<[f64; 2]> = Vec::new();
        for curve in pieces {
            let [x, y] = middle_of(&drawn[curve].1);
            let further = !named.is_empty();
            let seen = named.iter().any(|[a, b]| (a - x).hypot(b - y) < PIECE);
            if further && (k >= buttocks.len() || seen || length(&drawn[curve].1) < PIECE) {
                continue;
            }
            named.push([x, y]);
            let preferred = Preference { part: 0.15 + 0.1 * (k % 3) as f64, crossings: 3, beside: false };
            if !placer.name_curve(&mut canvas, curve, &name, &style, preferred, &window) {
                placer.name_by_leader(&mut canvas, curve, &name, &style, &THREAD, &window);
            }
        }
    }
    let stretched =
        if stretch > 1.0 { format!(", breadths and heights drawn {stretch:.0} times as large") } else { String::new() };
    head(&mut canvas, record, paper, &format!("scale 1:{n}{stretched}"), left_out);
    let y = paper[1] - 14.0;
    canvas.text([14.0, y], "AFT", &small);
    let middle = TextStyle::new(LETTERS, Anchor::Middle);
    let note = if beyond { format!("    {BEYOND}") } else { String::new() };
    canvas.text([0.5 * paper[0], y], &format!("{}{note}", station_words(record)), &middle);
    canvas.text([paper[0] - 14.0, y], "FORWARD", &TextStyle::new(3.2, Anchor::End));
    let suspects = record.changes.iter().any(|change| change.suspect);
    key(&mut canvas, paper, ["outward, up", "inward, down"], suspects);
    Ok(canvas)
}
