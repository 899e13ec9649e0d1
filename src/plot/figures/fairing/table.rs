//! The faired table of offsets as it is written, on as many sheets as it takes: one row a station, one column a
//! waterline; of tables of sections one column a point, from the keel up.
//!
//! What moved by more than the accuracy of the table is shaded, what is locked framed, what was left out as a suspect
//! framed in dashes: marks that survive a print without colours. Offsets that are written as before are grey.

use super::plan::station_words;
use crate::fairing::change::Change;
use crate::fairing::record::FairRecord;
use crate::fairing::surface::Origin;
use crate::plot::paper::canvas::{Anchor, Canvas, Pen, Rectangle, TextStyle};
use crate::plot::paper::font;
use crate::plot::paper::font::LETTERS;
use crate::plot::paper::sheet::{ROOM, wide};
use crate::plot::paper::svg::Svg;
use crate::plot::ship::caption;

/// Height of a row \[mm\].
const ROW: f64 = 5.0;
/// Room over the table and under it, with its legend \[mm\].
const HEAD: f64 = 27.0;
const FOOT: f64 = 22.0;
/// Room left and right of the sheet, and between the texts of two columns \[mm\].
const MARGIN: f64 = 8.0;
const GAP: f64 = 2.6;
/// Most decimals of a table whose writing has no step.
const DECIMALS: usize = 4;
const SHADE: &str = "#ffd79c";
const UNCHANGED: &str = "#6e6e6e";
const LOCKED: Pen = Pen::new(0.5, "#000000");
const LEFT_OUT: Pen = Pen::new(0.5, "#7000a0").dashed(&[1.2, 0.7]);

/// A cell of the table.
struct Entry<'a> {
    change: &'a Change,
    text: String,
    unchanged: bool,
}

/// Draws the sheets. `texts` are the offsets as the table had them and as the fair table has them, in the order of the
/// changes, empty where that is not known; moves of more than `limit` \[m\] are marked, which is `words` in the legend.
#[must_use]
pub fn fairing_table(record: &FairRecord, texts: &[[String; 2]], limit: f64, words: &str) -> Vec<Svg> {
    compose(record, texts, limit, words).into_iter().map(|canvas| Svg::new(canvas.finish("faired-offsets"))).collect()
}

pub(in crate::plot) fn compose(record: &FairRecord, texts: &[[String; 2]], limit: f64, words: &str) -> Vec<Canvas> {
    let lines = &record.lines;
    let columns = columns(record);
    let mut table: Vec<Vec<Option<Entry<'_>>>> = lines.stations.iter().map(|_| Vec::new()).collect();
    table.iter_mut().for_each(|row| row.resize_with(columns.len(), || None));
    let decimals = decimals(record);
    for (k, change) in record.changes.iter().enumerate() {
        let write = |value: f64| lines.notation.write_to(value, Some(decimals));
        let known = texts.get(k).filter(|pair| pair.iter().all(|text| !text.is_empty()));
        let [old, new] = known.cloned().unwrap_or_else(|| [change.before, change.after].map(write));
        let column = place(record, change);
        if let Some(cell) = table.get_mut(change.station).and_then(|row| row.get_mut(column)) {
            let text = match change.origin {
                Origin::Point { .. } => format!("{new} at {}", write(change.z)),
                _ => new.clone(),
            };
            *cell = Some(Entry { change, text, unchanged: old == new });
        }
    }
    let names: Vec<String> =
        lines.stations.iter().map(|station| caption::plain(&station.name).chars().take(12).collect()).collect();
    let column_of = |text: &str| wide(text, LETTERS) + GAP;
    let first = names.iter().map(|name| column_of(name)).fold(column_of("station"), f64::max);
    let cells = table.iter().flatten().flatten().map(|entry| column_of(&entry.text));
    let width = cells.chain(columns.iter().map(|head| column_of(head))).fold(0.0, f64::max);
    let across = (((ROOM[0] - 2.0 * MARGIN - first) / width).floor().max(1.0) as usize).min(columns.len().max(1));
    let down = (((ROOM[1] - HEAD - FOOT) / ROW).floor() as usize - 1).min(names.len().max(1));
    // Parts of one size rather than full ones and a rest.
    let across = columns.len().div_ceil(columns.len().div_ceil(across).max(1)).max(1);
    let down = names.len().div_ceil(names.len().div_ceil(down).max(1)).max(1);
    let parts: Vec<[usize; 2]> = (0..names.len())
        .step_by(down)
        .flat_map(|row| (0..columns.len()).step_by(across).map(move |column| [row, column]))
        .collect();
    let sheets = parts.len();
    let draw = |(k, [row, column]): (usize, [usize; 2])| {
        let (rows, across) = (names.len().min(row + down) - row, columns.len().min(column + across) - column);
        let bottom = HEAD + ROW * (rows + 1) as f64;
        let mut canvas = Canvas::new(ROOM[0], bottom + FOOT);
        let whole = first + width * across as f64;
        let left = 0.5 * (ROOM[0] - whole);
        head(&mut canvas, record, [k + 1, sheets]);
        let style = TextStyle::new(LETTERS, Anchor::End);
        let rule = Pen::new(0.13, "#000000");
        let middle = |row: usize| HEAD + ROW * (row as f64 + 0.5);
        canvas.text([left + 0.5 * GAP, middle(0)], "station", &TextStyle { anchor: Anchor::Start, ..style });
        for (j, name) in columns[column..column + across].iter().enumerate() {
            canvas.text([left + first + width * (j + 1) as f64 - 0.5 * GAP, middle(0)], name, &style);
        }
        for (i, name) in names[row..row + rows].iter().enumerate() {
            let y = HEAD + ROW * (i + 1) as f64;
            for (j, entry) in table[row + i][column..column + across].iter().enumerate() {
                let right = left + first + width * (j + 1) as f64;
                if let Some(entry) = entry {
                    draw_entry(&mut canvas, entry, &Rectangle::new(right - width, y, right, y + ROW), limit);
                }
            }
            canvas.text([left + first - 0.5 * GAP, middle(i + 1)], name, &style);
            canvas.line([left, y], [left + whole, y], &rule);
        }
        canvas.line([left + first, HEAD], [left + first, bottom], &rule);
        canvas.rectangle(&Rectangle::new(left, HEAD, left + whole, bottom), &Pen::new(0.35, "#000000"));
        key(&mut canvas, record, (limit, words), bottom + 7.0);
        canvas
    };
    parts.into_iter().enumerate().map(draw).collect()
}

/// Decimals of the table, from its resolution.
fn decimals(record: &FairRecord) -> usize {
    let notation = record.lines.notation;
    let step = |digits: &usize| notation.quantum(Some(*digits)).zip(record.lines.quantum);
    (0..9).find(|digits| step(digits).is_some_and(|(a, b)| (a - b).abs() < 1e-3 * b)).unwrap_or(DECIMALS)
}

/// Heads of the columns: waterlines and the deck at side, or the numbers of points.
fn columns(record: &FairRecord) -> Vec<String> {
    let points = record.changes.iter().filter(|change| matches!(change.origin, Origin::Point { .. }));
    if let Some(most) = points.map(|change| place(record, change) + 1).max() {
        return (1..=most).map(|number| number.to_string()).collect();
    }
    let heights = record.lines.waterlines.iter().map(|z| record.lines.notation.write(*z));
    let deck = record.changes.iter().any(|change| matches!(change.origin, Origin::Deck { .. }));
    heights.chain(deck.then(|| "deck".to_owned())).collect()
}

/// The column of an offset.
fn place(record: &FairRecord, change: &Change) -> usize {
    match change.origin {
        Origin::HalfBreadth { waterline, .. } => waterline,
        Origin::Deck { .. } => record.lines.waterlines.len(),
        Origin::Point { station, .. } => {
            let mut own = record.changes.iter().filter(|other| other.origin.station() == station);
            own.position(|other| other.origin == change.origin).unwrap_or(0)
        }
    }
}

fn draw_entry(canvas: &mut Canvas, entry: &Entry<'_>, place: &Rectangle, limit: f64) {
    let change = entry.change;
    if moved_more(change, limit) {
        canvas.fill(&place.grown(-0.25), SHADE);
    }
    if change.locked {
        canvas.rectangle(&place.grown(-0.55), &LOCKED);
    }
    if change.suspect {
        canvas.rectangle(&place.grown(-0.55), &LEFT_OUT);
    }
    let colour = if entry.unchanged { UNCHANGED } else { "#000000" };
    let at = [place.right - 0.5 * GAP, 0.5 * (place.top + place.bottom)];
    canvas.text(at, &entry.text, &TextStyle::new(LETTERS, Anchor::End).coloured(colour));
}

/// Whether an offset that was not left out moved by more than `limit` \[m\].
fn moved_more(change: &Change, limit: f64) -> bool {
    !change.suspect && (change.after - change.before).abs() > limit * (1.0 + 1e-9)
}

fn head(canvas: &mut Canvas, record: &FairRecord, [sheet, sheets]: [usize; 2]) {
    let name: String = caption::plain(&record.name).chars().take(60).collect();
    let of = if sheets > 1 { format!(", sheet {sheet} of {sheets}") } else { String::new() };
    let words = format!("FAIRED OFFSETS – {name}{of}");
    canvas.text([0.5 * ROOM[0], 8.0], &words, &TextStyle::new(4.5, Anchor::Middle));
    let unit = record.lines.notation.as_str();
    let points = record.changes.iter().any(|change| matches!(change.origin, Origin::Point { .. }));
    let what = if points {
        format!("half-breadths at heights above the base line [{unit}], points of each section in their order")
    } else {
        format!("half-breadths [{unit}] over stations and waterlines [{unit}] above the base line")
    };
    let words = format!("{what}    {}", station_words(record));
    let size = ((ROOM[0] - 2.0 * MARGIN) / font::width(&words)).min(LETTERS);
    canvas.text([0.5 * ROOM[0], 15.0], &words, &TextStyle::new(size, Anchor::Middle));
    let words = "as the file of the fair table has them, in the notation of the table";
    canvas.text([0.5 * ROOM[0], 21.0], words, &TextStyle::new(LETTERS, Anchor::Middle));
}

/// What the marks are, and of how many offsets.
fn key(canvas: &mut Canvas, record: &FairRecord, (limit, words): (f64, &str), y: f64) {
    let count = |marked: &dyn Fn(&Change) -> bool| record.changes.iter().filter(|change| marked(change)).count();
    let more = count(&|change| moved_more(change, limit));
    let [locked, left_out] = [count(&|change| change.locked), count(&|change| change.suspect)];
    let style = TextStyle::new(LETTERS, Anchor::Start);
    let mut x = MARGIN + 6.0;
    let marks: [(Option<&Pen>, String); 3] = [
        (None, format!("moved by more than {words}: {more}")),
        (Some(&LOCKED), format!("locked: {locked}")),
        (Some(&LEFT_OUT), format!("left out as a suspect, the offset is that of the fair hull: {left_out}")),
    ];
    for (pen, text) in marks {
        let place = Rectangle::new(x, y - 2.3, x + 10.0, y + 2.3);
        match pen {
            None => canvas.fill(&place, SHADE),
            Some(pen) => canvas.rectangle(&place, pen),
        }
        canvas.text([x + 12.0, y], &text, &style);
        x = Canvas::text_place([x + 12.0, y], &text, &style).right + 7.0;
    }
    canvas.text([MARGIN + 6.0, y + 7.0], "grey: written as before", &style.coloured(UNCHANGED));
    let program = TextStyle::new(LETTERS, Anchor::End);
    canvas.text([ROOM[0] - 6.0, y + 7.0], &caption::program(), &program);
}
