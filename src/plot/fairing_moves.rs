//! The map of moves: station by waterline, what each offset moved, outward positive, in millimetres.
//!
//! The colour runs from blue (inward) over white to orange (outward), full at the largest move; numbers say the same. Locked cells
//! have a black frame, cells that stop at their tolerance a bar below the number, suspects that were left out a ring; the
//! largest move is framed and called out.

use super::canvas::{Anchor, Canvas, Pen, Rectangle, TextStyle};
use super::sheet::ROOM;
use super::{PlotError, Svg, caption};
use crate::fairing::job::Change;
use crate::fairing::record::FairRecord;
use crate::fairing::surface::Origin;

/// Width of the sheet \[mm\].
const WIDTH: f64 = ROOM[0];
/// Room left and right \[mm\].
const MARGIN: f64 = 14.0;
/// Height over the map \[mm\].
const HEAD: f64 = 30.0;
/// Height under the map \[mm\].
const FOOT: f64 = 44.0;
/// Room left of the map for the heights \[mm\].
const NAMES: f64 = 18.0;
/// Largest width and height of a cell \[mm\].
const LARGEST: [f64; 2] = [15.0, 8.0];
/// Least width of a cell with a number \[mm\].
const LEAST: f64 = 4.2;
/// Colour of the full move outward and inward.
const OUTWARD: [f64; 3] = [179.0, 88.0, 6.0];
const INWARD: [f64; 3] = [33.0, 102.0, 172.0];

/// Draws the map.
///
/// # Errors
/// [`PlotError::Chart`] for a table without offsets.
pub fn fairing_moves(record: &FairRecord) -> Result<Svg, PlotError> {
    Ok(Svg { text: compose(record)?.finish("fairing-moves") })
}

/// The map on the sheet.
struct Map {
    frame: Rectangle,
    cell: [f64; 2],
    rows: usize,
    /// Points of sections, from the keel up; none of a table of half-breadths.
    points: Vec<Origin>,
    /// Largest move \[m\].
    full: f64,
    /// Digits after the point of a move in millimetres.
    digits: usize,
}

impl Map {
    /// The cell of an offset; the deck at side is the row above the waterlines, points of a section follow each other upwards.
    fn place(&self, change: &Change) -> Rectangle {
        let row = match change.origin {
            Origin::HalfBreadth { waterline, .. } => waterline,
            Origin::Deck { .. } => self.rows - 1,
            Origin::Point { station, .. } => {
                let mut points = self.points.iter().filter(|origin| origin.station() == station);
                points.position(|origin| *origin == change.origin).unwrap_or(0)
            }
        };
        let left = self.frame.left + self.cell[0] * change.station as f64;
        let bottom = self.frame.bottom - self.cell[1] * row as f64;
        Rectangle::new(left, bottom - self.cell[1], left + self.cell[0], bottom)
    }

    fn number(&self, change: &Change) -> String {
        let text = format!("{:+.*}", self.digits, 1000.0 * (change.after - change.before));
        if text.trim_start_matches(['+', '-']).chars().all(|c| matches!(c, '0' | '.')) { "0".to_owned() } else { text }
    }
}

fn moved(change: &Change) -> f64 {
    change.after - change.before
}

/// White for no move, the full colour for `share` 1 outward or -1 inward.
fn colour(share: f64) -> String {
    let full = if share > 0.0 { OUTWARD } else { INWARD };
    // The root shows small moves beside large ones.
    let part = 0.85 * share.abs().min(1.0).sqrt();
    let [r, g, b] = full.map(|c| (255.0 + part * (c - 255.0)).round() as u8);
    format!("#{r:02x}{g:02x}{b:02x}")
}

pub(super) fn compose(record: &FairRecord) -> Result<Canvas, PlotError> {
    let columns = record.lines.stations.len();
    let deck = record.changes.iter().any(|change| matches!(change.origin, Origin::Deck { .. }));
    let all = record.changes.iter().map(|change| change.origin);
    let points: Vec<Origin> = all.filter(|origin| matches!(origin, Origin::Point { .. })).collect();
    let longest = (0..columns).map(|k| points.iter().filter(|origin| origin.station() == k).count()).max();
    let rows = match longest {
        Some(rows) if rows > 0 => rows,
        _ => record.lines.waterlines.len() + usize::from(deck),
    };
    if record.changes.is_empty() || columns == 0 || rows == 0 {
        return Err(PlotError::Chart("the table has no offsets".to_owned()));
    }
    let room = WIDTH - 2.0 * MARGIN - NAMES;
    let cell = [(room / columns as f64).min(LARGEST[0]), LARGEST[1].min((ROOM[1] - HEAD - FOOT) / rows as f64)];
    let left = MARGIN + NAMES + 0.5 * (room - cell[0] * columns as f64);
    let bottom = HEAD + cell[1] * rows as f64;
    let frame = Rectangle::new(left, HEAD, left + cell[0] * columns as f64, bottom);
    let kept = record.changes.iter().filter(|change| !change.suspect);
    let full = kept.map(|change| moved(change).abs()).fold(0.0, f64::max);
    let digits = match 1000.0 * full {
        most if most >= 100.0 => 0,
        most if most >= 1.0 => 1,
        _ => 2,
    };
    let map = Map { frame, cell, rows, points, full, digits };
    let mut canvas = Canvas::new(WIDTH, bottom + FOOT);
    draw_cells(&mut canvas, record, &map);
    draw_names(&mut canvas, record, deck, &map);
    head(&mut canvas, record);
    key(&mut canvas, &map, bottom + 26.0);
    canvas.text([WIDTH - 8.0, bottom + FOOT - 5.0], &caption::program(), &TextStyle::new(2.2, Anchor::End));
    Ok(canvas)
}

fn draw_cells(canvas: &mut Canvas, record: &FairRecord, map: &Map) {
    let frame = &map.frame;
    canvas.fill(frame, "#e4e4e4");
    for change in &record.changes {
        let share = if map.full > 0.0 && !change.suspect { moved(change) / map.full } else { 0.0 };
        canvas.fill(&map.place(change), &colour(share));
    }
    let thin = Pen::new(0.08, "#b0b0b0");
    for change in &record.changes {
        canvas.rectangle(&map.place(change), &thin);
    }
    canvas.rectangle(frame, &Pen::new(0.25, "#000000"));
    let longest = record.changes.iter().map(|change| map.number(change).len()).max().unwrap_or(4);
    let size = (map.cell[0] / (0.68 * longest as f64)).min(2.6);
    let (_, _, largest) = record.moves();
    for change in &record.changes {
        let place = map.place(change);
        let middle = [0.5 * (place.left + place.right), 0.5 * (place.top + place.bottom)];
        if map.cell[0] >= LEAST {
            canvas.text(middle, &map.number(change), &TextStyle::new(size, Anchor::Middle));
        }
        marks(canvas, change, &place);
        if largest == Some(change) {
            canvas.rectangle(&place.grown(0.5), &Pen::new(0.9, "#c00000"));
        }
    }
}

/// Lock, ring of a suspect, bar at the tolerance.
fn marks(canvas: &mut Canvas, change: &Change, place: &Rectangle) {
    if change.locked {
        canvas.rectangle(&place.grown(-0.45), &Pen::new(0.5, "#000000"));
    }
    if change.suspect {
        let middle = [0.5 * (place.left + place.right), 0.5 * (place.top + place.bottom)];
        let radii = [0.56 * place.width().max(place.height()), 0.62 * place.height()];
        let ring: Vec<[f64; 2]> = (0..=32)
            .map(|k| (std::f64::consts::TAU * f64::from(k) / 32.0).sin_cos())
            .map(|(s, c)| [middle[0] + radii[0] * c, middle[1] + radii[1] * s])
            .collect();
        canvas.polyline(&ring, &Pen::new(0.5, "#7000a0"));
    }
    if change.tolerance.is_some_and(|t| t > 0.0 && !change.locked && moved(change).abs() >= 0.999 * t) {
        let y = place.bottom - 0.9;
        let inset = 0.2 * place.width();
        canvas.line([place.left + inset, y], [place.right - inset, y], &Pen::new(0.6, "#000000"));
    }
}

fn draw_names(canvas: &mut Canvas, record: &FairRecord, deck: bool, map: &Map) {
    let frame = &map.frame;
    let style = TextStyle::new(2.5, Anchor::End);
    let names: Vec<String> = if map.points.is_empty() {
        record.lines.waterlines.iter().map(|z| format!("{z:.3}")).collect()
    } else {
        (1..=map.rows).map(|row| row.to_string()).collect()
    };
    for (j, name) in names.iter().enumerate() {
        let y = frame.bottom - map.cell[1] * (j as f64 + 0.5);
        canvas.text([frame.left - 1.5, y], name, &style);
    }
    if deck {
        canvas.text([frame.left - 1.5, frame.top + 0.5 * map.cell[1]], "deck", &style);
    }
    let size = (0.7 * map.cell[0]).clamp(1.5, 2.5);
    let stride = (1.3 * size / map.cell[0]).ceil().max(1.0) as usize;
    for (i, station) in record.lines.stations.iter().enumerate().step_by(stride) {
        let name: String = caption::plain(&station.name).chars().take(9).collect();
        let x = frame.left + map.cell[0] * (i as f64 + 0.5);
        canvas.text([x, frame.bottom + 1.5], &name, &TextStyle::new(size, Anchor::End).upward());
    }
    canvas.text(
        [frame.left, frame.top - 3.0],
        if map.points.is_empty() {
            "waterline [m] over station, aft on the left"
        } else {
            "point of the section, from the keel up, over station, aft on the left"
        },
        &TextStyle::new(2.6, Anchor::Start),
    );
}

fn head(canvas: &mut Canvas, record: &FairRecord) {
    let name: String = caption::plain(&record.name).chars().take(60).collect();
    let words = format!("WHAT MOVED – {name}");
    canvas.text([0.5 * WIDTH, 9.0], &words, &TextStyle::new(4.5, Anchor::Middle));
    let (rms, _, largest) = record.moves();
    let called = largest.map(|change| {
        let station = record.lines.stations.get(change.station).map_or("", |s| s.name.as_str());
        let line = change.origin.words(change.z);
        format!("largest move {:+.2} mm at station {}, {line}", 1000.0 * moved(change), caption::plain(station))
    });
    let second = format!(
        "moves in millimetres, outward positive    {:.2} mm RMS    {}",
        1000.0 * rms,
        called.unwrap_or_default()
    );
    canvas.text([0.5 * WIDTH, 16.0], &second, &TextStyle::new(3.0, Anchor::Middle));
}

fn key(canvas: &mut Canvas, map: &Map, y: f64) {
    let style = TextStyle::new(2.6, Anchor::Start);
    let mut x = MARGIN + NAMES;
    for share in [-1.0, -0.5, -0.1, 0.0, 0.1, 0.5, 1.0] {
        let place = Rectangle::new(x, y - 3.0, x + 12.0, y + 3.0);
        canvas.fill(&place, &colour(share));
        canvas.rectangle(&place, &Pen::new(0.08, "#b0b0b0"));
        let text = format!("{:+.*}", map.digits + 1, 1000.0 * share * map.full);
        let text = if share.abs() > 0.0 { text } else { "0".to_owned() };
        canvas.text([x + 6.0, y], &text, &TextStyle::new(2.2, Anchor::Middle));
        x += 12.0;
    }
    canvas.text([x + 2.0, y], "mm", &style);
    x += 14.0;
    for (kind, word) in ["locked", "at its tolerance", "suspect, left out", "largest move"].into_iter().enumerate() {
        let place = Rectangle::new(x, y - 3.0, x + 10.0, y + 3.0);
        canvas.rectangle(&place, &Pen::new(0.08, "#b0b0b0"));
        let change = Change {
            station: 0,
            origin: Origin::Deck { station: 0 },
            x: 0.0,
            z: 0.0,
            before: 0.0,
            after: if kind == 1 { 1.0 } else { 0.0 },
            tolerance: Some(1.0),
            suspect: kind == 2,
            locked: kind == 0,
        };
        marks(canvas, &change, &place);
        if kind == 3 {
            canvas.rectangle(&place.grown(0.5), &Pen::new(0.9, "#c00000"));
        }
        canvas.text([x + 13.0, y], word, &style);
        x += 46.0;
    }
    let place = Rectangle::new(x, y - 3.0, x + 10.0, y + 3.0);
    canvas.fill(&place, "#e4e4e4");
    canvas.text([x + 13.0, y], "no offset", &style);
}
