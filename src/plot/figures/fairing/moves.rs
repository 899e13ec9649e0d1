//! The map of moves: station by waterline, what each offset moved, outward positive, in millimetres; in eighths of an
//! inch where the table is written in feet, inches and eighths.
//!
//! The colour runs from blue (inward) over white to orange (outward), full at the largest move; numbers say the same,
//! in whole units where cells have room for no more, and not at all where they have no room for those. Locked cells
//! have a black frame, cells that stop at their tolerance a bar below the number, suspects that were left out a ring;
//! the largest move is framed and called out. Diamonds at the left edge stand at the height at which a station crosses
//! a knuckle (full) or a tangent line (hollow).

use super::plan::station_words;
use crate::fairing::change::Change;
use crate::fairing::record::{Crossing, FairRecord};
use crate::fairing::surface::Origin;
use crate::hull::{LineKind, OffsetStation};
use crate::plot::paper::canvas::{Anchor, Canvas, Pen, Rectangle, TextStyle};
use crate::plot::paper::error::PlotError;
use crate::plot::paper::font::LETTERS;
use crate::plot::paper::sheet::ROOM;
use crate::plot::paper::svg::Svg;
use crate::plot::ship::caption;
use crate::units::Notation;

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
/// Colour of the full move outward and inward.
const OUTWARD: [f64; 3] = [179.0, 88.0, 6.0];
const INWARD: [f64; 3] = [33.0, 102.0, 172.0];

/// Draws the map.
///
/// # Errors
/// [`PlotError::Chart`] for a table without offsets.
pub fn fairing_moves(record: &FairRecord) -> Result<Svg, PlotError> {
    Ok(Svg::new(compose(record)?.finish("fairing-moves")))
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
    /// What moves are written in.
    unit: Unit,
    /// Digits after the point of a move.
    digits: usize,
}

/// What moves are written in.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::plot) struct Unit {
    /// Length \[m\].
    length: f64,
    /// For the axis and for a number.
    words: [&'static str; 2],
}

impl Unit {
    /// Eighths of an inch for tables in feet, inches and eighths, else millimetres.
    pub(in crate::plot) fn of(notation: Notation) -> Self {
        match notation {
            Notation::FeetInchesEighths => {
                Self { length: 0.0254 / 8.0, words: ["eighths of an inch (1 is 3.175 mm)", "eighths"] }
            }
            _ => Self { length: 1e-3, words: ["millimetres", "mm"] },
        }
    }
}

impl Map {
    /// The cell of an offset; the deck at side is the row above the waterlines, points of a section follow each other
    /// upwards.
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

    /// The row, in cells and parts of them, at which a crossing stands; none above and below the rows of its station.
    fn row_of(&self, record: &FairRecord, crossing: &Crossing) -> Option<f64> {
        let heights: Vec<f64> = if self.points.is_empty() {
            record.lines.waterlines.clone()
        } else {
            let own =
                |change: &&Change| change.station == crossing.station && matches!(change.origin, Origin::Point { .. });
            record.changes.iter().filter(own).map(|change| change.z).collect()
        };
        let k = (0..heights.len().saturating_sub(1)).find(|&k| {
            let [a, b] = [heights[k], heights[k + 1]];
            a - 1e-9 <= crossing.z && crossing.z <= b + 1e-9 && b > a
        })?;
        Some(k as f64 + ((crossing.z - heights[k]) / (heights[k + 1] - heights[k])).clamp(0.0, 1.0))
    }

    /// Size of the numbers that fit the cells \[mm\]; below [`LETTERS`] there are none.
    fn letters(&self, record: &FairRecord) -> f64 {
        let kept = record.changes.iter().filter(|change| !change.suspect);
        let longest = kept.map(|change| self.number(change).len()).max().unwrap_or(4);
        (self.cell[0] / (0.62 * longest as f64)).min(3.4)
    }

    fn number(&self, change: &Change) -> String {
        let text = format!("{:+.*}", self.digits, moved(change) / self.unit.length);
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

pub(in crate::plot) fn compose(record: &FairRecord) -> Result<Canvas, PlotError> {
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
    let unit = Unit::of(record.lines.notation);
    let digits = match full / unit.length {
        most if most >= 100.0 => 0,
        most if most >= 1.0 => 1,
        _ => 2,
    };
    let mut map = Map { frame, cell, rows, points, full, unit, digits };
    if map.letters(record) < LETTERS && full / unit.length >= 10.0 {
        map.digits = 0;
    }
    let mut canvas = Canvas::new(WIDTH, bottom + FOOT);
    draw_cells(&mut canvas, record, &map);
    draw_names(&mut canvas, record, deck, &map);
    draw_crossings(&mut canvas, record, &map);
    head(&mut canvas, record, &map);
    key(&mut canvas, &map, bottom + 26.0);
    canvas.text([WIDTH - 8.0, bottom + FOOT - 5.0], &caption::program(), &TextStyle::new(LETTERS, Anchor::End));
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
    let size = map.letters(record);
    let (_, _, largest) = record.moves();
    for change in &record.changes {
        let place = map.place(change);
        let middle = [0.5 * (place.left + place.right), 0.5 * (place.top + place.bottom)];
        if size >= LETTERS && !change.suspect {
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
    let style = TextStyle::new(LETTERS, Anchor::End);
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
    let size = LETTERS;
    let stride = (1.3 * size / map.cell[0]).ceil().max(1.0) as usize;
    for (i, station) in record.lines.stations.iter().enumerate().step_by(stride) {
        let name: String = caption::plain(&station.name).chars().take(9).collect();
        let x = frame.left + map.cell[0] * (i as f64 + 0.5);
        canvas.text([x, frame.bottom + 1.5], &name, &TextStyle::new(size, Anchor::End).upward());
    }
    let rows = if map.points.is_empty() {
        "waterline [m] over station, aft on the left"
    } else {
        "point of the section, from the keel up, over station, aft on the left"
    };
    let words = format!("{rows}    {}", station_words(record));
    canvas.text([frame.left, frame.top - 3.0], &words, &TextStyle::new(LETTERS, Anchor::Start));
}

/// A diamond at each crossing of a station with a knuckle or a tangent line.
fn draw_crossings(canvas: &mut Canvas, record: &FairRecord, map: &Map) {
    for crossing in &record.lines.crossings {
        let Some(row) = map.row_of(record, crossing) else { continue };
        let at = [map.frame.left + map.cell[0] * crossing.station as f64, map.frame.bottom - map.cell[1] * (row + 0.5)];
        diamond(canvas, [at[0] + 1.2, at[1]], crossing.kind);
    }
}

/// Full for a knuckle, hollow for a tangent line.
fn diamond(canvas: &mut Canvas, [x, y]: [f64; 2], kind: LineKind) {
    let points = [[x, y - 1.3], [x + 1.0, y], [x, y + 1.3], [x - 1.0, y], [x, y - 1.3]];
    canvas.area(&points[..4], if kind == LineKind::Knuckle { "#000000" } else { "#ffffff" });
    canvas.polyline(&points, &Pen::new(0.25, "#000000"));
}

fn head(canvas: &mut Canvas, record: &FairRecord, map: &Map) {
    let unit = map.unit;
    let name: String = caption::plain(&record.name).chars().take(60).collect();
    let words = format!("WHAT MOVED – {name}");
    canvas.text([0.5 * WIDTH, 9.0], &words, &TextStyle::new(4.5, Anchor::Middle));
    let (rms, _, largest) = record.moves();
    let rms = rms / unit.length;
    let called = largest.map(|change| {
        let station = record.lines.stations.get(change.station).map_or_else(String::new, OffsetStation::words);
        let line = change.origin.words(change.z);
        let size = moved(change) / unit.length;
        format!("largest move {size:+.2} {} at {}, {line}", unit.words[1], caption::plain(&station))
    });
    let second = format!(
        "moves in {}, outward positive{}    {rms:.2} {} RMS    {}",
        unit.words[0],
        if map.letters(record) < LETTERS { ", numbers in changes.csv" } else { "" },
        unit.words[1],
        called.unwrap_or_default()
    );
    canvas.text([0.5 * WIDTH, 16.0], &second, &TextStyle::new(3.2, Anchor::Middle));
}

fn key(canvas: &mut Canvas, map: &Map, y: f64) {
    let style = TextStyle::new(LETTERS, Anchor::Start);
    let mut x = MARGIN + NAMES;
    for share in [-1.0, -0.5, -0.1, 0.0, 0.1, 0.5, 1.0] {
        let place = Rectangle::new(x, y - 3.0, x + 12.0, y + 3.0);
        canvas.fill(&place, &colour(share));
        canvas.rectangle(&place, &Pen::new(0.08, "#b0b0b0"));
        let digits = if map.full / map.unit.length >= 10.0 { 1 } else { map.digits + 1 };
        let text = format!("{:+.*}", digits, share * map.full / map.unit.length);
        let text = if share.abs() > 0.0 { text } else { "0".to_owned() };
        canvas.text([x + 6.0, y], &text, &TextStyle::new(LETTERS, Anchor::Middle));
        x += 12.0;
    }
    canvas.text([x + 2.0, y], map.unit.words[1], &style);
    x += 17.0;
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
        canvas.text([x + 12.0, y], word, &style);
        x = Canvas::text_place([x + 12.0, y], word, &style).right + 6.0;
    }
    let place = Rectangle::new(x, y - 3.0, x + 10.0, y + 3.0);
    canvas.fill(&place, "#e4e4e4");
    let word = "no offset, or beyond the hull";
    canvas.text([x + 12.0, y], word, &style);
    x = Canvas::text_place([x + 12.0, y], word, &style).right + 7.0;
    for (kind, word) in [(LineKind::Knuckle, "knuckle"), (LineKind::Tangent, "tangent line")] {
        diamond(canvas, [x, y], kind);
        canvas.text([x + 3.0, y], word, &style);
        x = Canvas::text_place([x + 3.0, y], word, &style).right + 6.0;
    }
}
