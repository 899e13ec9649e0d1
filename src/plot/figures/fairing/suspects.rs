//! The offsets that are doubted, on the body plan of the fair hull, with what the table has and what is proposed for it.
//!
//! A hollow ring is the half-breadth of the table, the bar runs to the half-breadth that is proposed. Beside the plan
//! stand the list of them and, of the worst, the section and the waterline through the offset.

use super::sections::{station_cut, whole_curves};
use crate::fairing::record::{Doubt, FairRecord};
use crate::plot::figures::suspects::{Expected, small_plot};
use crate::plot::paper::canvas::{Anchor, Canvas, Pen, Rectangle, TextStyle};
use crate::plot::paper::error::PlotError;
use crate::plot::paper::font::LETTERS;
use crate::plot::paper::label::LabelPlacer;
use crate::plot::paper::scale::drawing_scale;
use crate::plot::paper::sheet::{Sheet, fitted};
use crate::plot::paper::svg::Svg;
use crate::plot::ship::caption;
use crate::plot::ship::extent::{base, extent, midship};
use crate::plot::ship::view::{BASE, GRID, THREAD};
use crate::units::{Notation, counted};

/// Room above and below the plan and at its sides \[mm\].
const HEAD: f64 = 34.0;
const FOOT: f64 = 30.0;
const SIDE: f64 = 8.0;
/// Width of the list \[mm\].
const LIST: f64 = 146.0;
/// Height of a row of the list \[mm\].
const ROW: f64 = 4.6;
/// Left edges of the columns of the list \[mm\], and their heads.
const COLUMNS: [(f64, &str); 7] = [
    (1.0, "mark"),
    (11.0, "station"),
    (27.0, "waterline [m]"),
    (52.0, "given"),
    (70.0, "proposed"),
    (88.0, "score"),
    (107.0, "what it may be"),
];
/// Height of a row of small plots \[mm\], most rows, and stations and waterlines on each side that they show.
const PLOTS: f64 = 48.0;
const MOST_PLOTS: usize = 4;
const REACH: usize = 4;
const QUIET: Pen = Pen::new(0.18, "#a8a8a8");
const OWN: Pen = Pen::new(0.3, "#000000");
const GIVEN: Pen = Pen::new(0.5, "#b35806");
const PROPOSED: Pen = Pen::new(0.7, "#2166ac");

/// Draws plan and list; none where no offset is doubted.
///
/// # Errors
/// [`PlotError::Chart`] for a table without offsets.
pub fn fairing_suspects(record: &FairRecord, sheet: Sheet) -> Result<Option<Svg>, PlotError> {
    Ok(compose(record, sheet)?.map(|canvas| Svg::new(canvas.finish("suspects"))))
}

fn circle(at: [f64; 2], radius: f64) -> Vec<[f64; 2]> {
    (0..=24)
        .map(|k| (std::f64::consts::TAU * f64::from(k) / 24.0).sin_cos())
        .map(|(s, c)| [at[0] + radius * c, at[1] + radius * s])
        .collect()
}

pub(in crate::plot) fn compose(record: &FairRecord, sheet: Sheet) -> Result<Option<Canvas>, PlotError> {
    if record.doubts.is_empty() {
        return Ok(None);
    }
    let paper = sheet.room();
    let Some((x, breadth, z)) = extent(record) else {
        return Err(PlotError::Chart("the table has no offsets".to_owned()));
    };
    let widest = record.doubts.iter().map(|doubt| doubt.value.max(doubt.proposed)).fold(breadth, f64::max);
    let room = [paper[0] - LIST - 3.0 * SIDE, paper[1] - HEAD - FOOT];
    let n = drawing_scale(2.0 * widest, room[0]).max(drawing_scale(z[1] - z[0], room[1]));
    let millimetres = 1000.0 / f64::from(n);
    let centre = SIDE + 0.5 * room[0];
    let floor = paper[1] - FOOT - 0.5 * (room[1] - millimetres * (z[1] - z[0])).max(0.0);
    let midship = midship(record, x);
    let side = |x: f64| if x < midship { -1.0 } else { 1.0 };
    let at = |x: f64, y: f64, height: f64| [centre + side(x) * millimetres * y, floor - millimetres * (height - z[0])];
    let mut canvas = Canvas::new(paper[0], paper[1]);
    let names = TextStyle::new(LETTERS, Anchor::End);
    let mut last = f64::INFINITY;
    for &height in &record.lines.waterlines {
        let y = at(x[0], 0.0, height)[1];
        canvas.line([centre - millimetres * breadth, y], [centre + millimetres * breadth, y], &GRID);
        if last - y >= 1.3 * LETTERS {
            last = y;
            canvas.text([centre - millimetres * breadth - 2.0, y], &format!("{height:.3} m"), &names);
        }
    }
    canvas.line(at(x[0], 0.0, z[0]), at(x[0], 0.0, z[1]), &BASE);
    canvas.line(at(x[0], breadth, base(z)), at(x[1], breadth, base(z)), &BASE);
    let mut placer = LabelPlacer::default();
    for (k, station) in record.lines.stations.iter().enumerate() {
        let own = record.doubts.iter().any(|doubt| doubt.station == k);
        for line in whole_curves(&record.after, station_cut(record, station.x), 0.01 / millimetres) {
            let line: Vec<[f64; 2]> = line.into_iter().map(|p| at(station.x, p[1], p[2])).collect();
            canvas.polyline(&line, if own { &OWN } else { &QUIET });
            placer.add_curve(&line);
        }
    }
    let place = |doubt: &Doubt, y: f64| Some(at(record.lines.stations.get(doubt.station)?.x, y, doubt.z));
    for doubt in &record.doubts {
        let (Some(given), Some(proposed)) = (place(doubt, doubt.value), place(doubt, doubt.proposed)) else { continue };
        canvas.line(given, proposed, &PROPOSED);
        canvas.area(&circle(proposed, 0.7), PROPOSED.colour);
        canvas.polyline(&circle(given, 1.3), &GIVEN);
        placer.take(Rectangle::new(given[0] - 1.6, given[1] - 1.6, given[0] + 1.6, given[1] + 1.6));
    }
    let window = Rectangle::new(4.0, 22.0, paper[0] - LIST - SIDE, paper[1] - 14.0);
    let style = TextStyle::new(LETTERS, Anchor::Middle).halo();
    for doubt in &record.doubts {
        let Some(given) = place(doubt, doubt.value) else { continue };
        let shifts = [4.0, 6.5, 9.0, 12.0, 16.0].into_iter().flat_map(|r| {
            (0..12)
                .map(move |k| (std::f64::consts::TAU * f64::from(k) / 12.0).sin_cos())
                .map(move |(s, c)| [r * c, -r * s])
        });
        let places: Vec<[f64; 2]> = shifts.map(|[dx, dy]| [given[0] + dx, given[1] + dy]).collect();
        placer.name_off_curves(&mut canvas, &doubt.id, &style, &places, &window, (given, &THREAD));
    }
    let bottom = list(&mut canvas, record, paper);
    plots(&mut canvas, record, paper, bottom + 10.0);
    head(&mut canvas, record, paper, n);
    let words = TextStyle::new(3.2, Anchor::Middle);
    let under = (floor + 6.0).min(paper[1] - 18.0);
    canvas.text([centre - 0.5 * millimetres * breadth, under], "AFT", &words);
    canvas.text([centre + 0.5 * millimetres * breadth, under], "FORWARD", &words);
    Ok(Some(canvas))
}

/// The list of doubted offsets, as many as there is room for; returns its lower edge.
fn list(canvas: &mut Canvas, record: &FairRecord, paper: [f64; 2]) -> f64 {
    let left = paper[0] - LIST - 0.5 * SIDE;
    let plots = record.doubts.len().min(2) as f64 * PLOTS;
    let room = ((paper[1] - HEAD - FOOT - plots) / ROW) as usize - 1;
    let shown = record.doubts.len().min(room);
    let style = TextStyle::new(LETTERS, Anchor::Start);
    let rule = Pen::new(0.13, "#000000");
    let notation = record.lines.notation;
    let words = format!("given and proposed in {}", notation.as_str());
    canvas.text([left, HEAD - 3.0], &words, &style);
    let y = |row: usize| HEAD + ROW * (row as f64 + 0.5);
    for (shift, words) in COLUMNS {
        canvas.text([left + shift, y(0)], words, &style);
    }
    for (row, doubt) in record.doubts.iter().take(shown).enumerate() {
        let station = record.lines.stations.get(doubt.station).map_or("", |s| s.name.as_str());
        let as_written = |text: &str, value: f64| {
            let decimals = (notation == Notation::Metres).then_some(4).or(Some(1));
            if text.is_empty() { notation.write_to(value, decimals) } else { text.to_owned() }
        };
        let cells = [
            doubt.id.clone(),
            caption::plain(station).chars().take(9).collect(),
            format!("{:.3}", doubt.z),
            as_written(&doubt.written[0], doubt.value),
            as_written(&doubt.written[1], doubt.proposed),
            doubt.score.map_or("-".to_owned(), |score| format!("{score:+.1}")),
            doubt.hypothesis.clone(),
        ];
        for (k, (cell, (shift, _))) in cells.iter().zip(COLUMNS).enumerate() {
            let room = COLUMNS.get(k + 1).map_or(LIST, |next| next.0) - shift - 1.0;
            let (cell, size) = fitted(cell, style.size, room);
            canvas.text([left + shift, y(row + 1)], &cell, &TextStyle { size, ..style });
        }
    }
    for row in 1..=shown {
        let y = HEAD + ROW * row as f64;
        canvas.line([left, y], [left + LIST, y], &rule);
    }
    let bottom = HEAD + ROW * (shown + 1) as f64;
    canvas.rectangle(&Rectangle::new(left, HEAD, left + LIST, bottom), &Pen::new(0.35, "#000000"));
    if record.doubts.len() > shown {
        let more = format!("{} more stand in fairing.json", record.doubts.len() - shown);
        canvas.text([left, bottom + 3.6], &more, &style);
    }
    bottom
}

/// The section and the waterline through the worst of them, as many as there is room for below `top`.
fn plots(canvas: &mut Canvas, record: &FairRecord, paper: [f64; 2], top: f64) {
    let left = paper[0] - LIST - 0.5 * SIDE;
    let count = (((paper[1] - FOOT + 12.0 - top) / PLOTS).max(0.0) as usize).min(MOST_PLOTS);
    let same = |a: f64, b: f64| (a - b).abs() < 1e-9;
    for (row, doubt) in record.doubts.iter().take(count).enumerate() {
        let Some(station) = record.lines.stations.get(doubt.station) else { continue };
        let y = top + PLOTS * row as f64;
        let frame = |k: f64| {
            Rectangle::new(left + 0.5 * LIST * k + 11.0, y + 5.0, left + 0.5 * LIST * (k + 1.0) - 2.0, y + PLOTS - 12.0)
        };
        canvas.text([left, y], &doubt.id, &TextStyle::new(LETTERS, Anchor::Start));
        let reading = Expected { value: doubt.value, expected: doubt.proposed, band: 0.0 };
        // The neighbours on both sides, but for what is doubted itself.
        let around = |mut all: Vec<[f64; 2]>, place: f64| {
            all.sort_by(|a, b| a[0].total_cmp(&b[0]));
            let k = all.partition_point(|p| p[0] < place);
            all[k.saturating_sub(REACH)..(k + REACH).min(all.len())].to_vec()
        };
        let kept = || record.changes.iter().filter(|change| !change.suspect);
        let own = kept().filter(|c| c.station == doubt.station).map(|c| [c.z, c.before]).collect();
        let section: Vec<[f64; 2]> = around(own, doubt.z).into_iter().map(|[z, y]| [y, z]).collect();
        small_plot(canvas, &frame(0.0), ["half-breadth [m]", "z [m]"], &section, reading, doubt.z, true);
        let line = kept().filter(|c| same(c.z, doubt.z)).map(|c| [c.x, c.before]).collect();
        let waterline = around(line, station.x);
        small_plot(canvas, &frame(1.0), ["x [m]", "half-breadth [m]"], &waterline, reading, station.x, false);
    }
}

fn head(canvas: &mut Canvas, record: &FairRecord, paper: [f64; 2], n: u32) {
    let name: String = caption::plain(&record.name).chars().take(60).collect();
    canvas.text([0.5 * paper[0], 9.0], &format!("SUSPECTS – {name}"), &TextStyle::new(4.5, Anchor::Middle));
    let left_out = record.changes.iter().filter(|change| change.suspect).count();
    let words = format!(
        "doubted: {} of {}    left out of the fairing: {left_out}    body plan 1:{n}, after fairing",
        record.doubts.len(),
        counted(record.changes.len(), "offset")
    );
    canvas.text([0.5 * paper[0], 16.0], &words, &TextStyle::new(3.2, Anchor::Middle));
    let y = paper[1] - 7.0;
    let style = TextStyle::new(LETTERS, Anchor::Start);
    canvas.polyline(&circle([18.0, y], 1.3), &GIVEN);
    canvas.text([22.0, y], "as the table has it", &style);
    canvas.line([62.0, y], [70.0, y], &PROPOSED);
    canvas.area(&circle([70.0, y], 0.7), PROPOSED.colour);
    canvas.text([73.0, y], "proposed", &style);
    canvas.line([100.0, y], [108.0, y], &OWN);
    canvas.text([110.0, y], "its station", &style);
    canvas.text([140.0, y], "S: its neighbours contradict it    N: the net of all others does", &style);
    canvas.text([paper[0] - 8.0, y], &caption::program(), &TextStyle::new(LETTERS, Anchor::End));
}
