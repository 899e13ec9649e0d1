//! Names of stations, waterlines and cells in a job, and what they are in a table.

use super::super::diagnostic::Diagnostic;
use super::super::document::{Document, Raw};
use super::{JobFile, Location, name};
use crate::hull::OffsetTable;
use crate::units::parse_length;

/// A line or a cell of a table, by its indices.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TableItem {
    /// A station.
    Station(usize),
    /// A waterline.
    Waterline(usize),
    /// A cell: station, waterline.
    Cell(usize, usize),
}

impl TableItem {
    /// Its cells that hold an offset: (station, waterline).
    #[must_use]
    pub fn cells(self, table: &OffsetTable) -> Vec<(usize, usize)> {
        let all = table.stations.iter().enumerate().flat_map(|(i, station)| {
            let given = station.half_breadths.iter().enumerate().filter(|(_, cell)| cell.value().is_some());
            given.map(move |(j, _)| (i, j))
        });
        all.filter(|&(i, j)| match self {
            Self::Station(station) => station == i,
            Self::Waterline(waterline) => waterline == j,
            Self::Cell(station, waterline) => (station, waterline) == (i, j),
        })
        .collect()
    }
}

/// What a name is the name of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum ItemKind {
    Station,
    Waterline,
    Cell,
}

/// A name of a station, a waterline or a cell with the place where it stands.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct TableRef {
    text: String,
    sort: ItemKind,
    pub(super) place: Location,
}

const LISTS: [(&str, ItemKind); 3] =
    [("stations", ItemKind::Station), ("waterlines", ItemKind::Waterline), ("cells", ItemKind::Cell)];

/// Reads `[tolerance]` and `[lock]` but for the tolerance of the whole table.
pub(super) fn read(document: &mut Document<'_>, job: &mut JobFile) {
    for (list, sort) in LISTS {
        let path = format!("tolerance.{list}");
        if let Some((raw, span, kind)) = document.raw(&path) {
            let Raw::Table(fields) = &raw else {
                document.unexpected(&path, &raw, &span, kind);
                continue;
            };
            for (text, raw, span) in fields {
                let Some(measure) = document.measure(&format!("{path}.{text}"), raw, span, kind) else { continue };
                if measure.value <= 0.0 {
                    let message = format!("{path}.{text} is {} m", measure.value);
                    let help = "Expected a positive length; what must not move is locked under [lock].".to_owned();
                    document.problem("E124", &path, span, message, help);
                    continue;
                }
                let mark = mark(document, text, sort, &path, span.start);
                job.tolerances.extend(mark.map(|mark| (mark, measure.value)));
            }
        }
    }
    for (list, sort) in LISTS {
        let path = format!("lock.{list}");
        if let Some((raw, span, kind)) = document.raw(&path) {
            let single = [(raw.clone(), span.clone())];
            let items = match &raw {
                Raw::Array(items) => &items[..],
                Raw::Text(_) | Raw::Number(_) => &single[..],
                _ => {
                    document.unexpected(&path, &raw, &span, kind);
                    continue;
                }
            };
            for (item, at) in items {
                match name(item) {
                    Some(text) => job.locks.extend(mark(document, &text, sort, &path, at.start)),
                    None => document.unexpected(&path, item, at, kind),
                }
            }
        }
    }
}

/// A mark, when the text has the form of its sort.
fn mark(document: &mut Document<'_>, text: &str, sort: ItemKind, key: &str, byte: usize) -> Option<TableRef> {
    if sort == ItemKind::Cell && text.split('@').filter(|part| !part.trim().is_empty()).count() != 2 {
        let help = "Write \"station@waterline\", as \"5@6.5\".".into();
        document.problem("E123", key, &(byte..byte), format!("{key}: \"{text}\" is no cell"), help);
        return None;
    }
    Some(TableRef { text: text.trim().to_owned(), sort, place: Location::new(document, key, byte) })
}

impl TableRef {
    /// A name to be looked up for another key, whose messages it has.
    pub(super) fn new(place: &Location) -> Self {
        Self { text: String::new(), sort: ItemKind::Cell, place: place.clone() }
    }

    /// The message that the same line or cell has another tolerance \[m\] already.
    pub(super) fn named_twice(&self, before: f64, now: f64) -> Diagnostic {
        let text = format!("\"{}\" is {now} m, and {before} m under another name of it", self.text);
        self.place.problem("E183", &text, "Name it once.")
    }

    /// The line or cell of a table.
    ///
    /// # Errors
    /// A message that says what the table has.
    pub fn find(&self, table: &OffsetTable) -> Result<TableItem, Box<Diagnostic>> {
        match self.sort {
            ItemKind::Station => self.station(table, &self.text).map(TableItem::Station),
            ItemKind::Waterline => self.waterline(table, &self.text).map(TableItem::Waterline),
            ItemKind::Cell => {
                let (station, waterline) = self.text.split_once('@').unwrap_or((&self.text, ""));
                let (i, j) = (self.station(table, station.trim())?, self.waterline(table, waterline.trim())?);
                if table.stations[i].half_breadths.get(j).is_some_and(|cell| cell.value().is_some()) {
                    return Ok(TableItem::Cell(i, j));
                }
                Err(self.problem("E173", format!("the table has no offset at {}", self.text), String::new()))
            }
        }
    }

    fn problem(&self, code: &'static str, text: String, help: String) -> Box<Diagnostic> {
        Box::new(self.place.problem(code, &text, help))
    }

    /// The station of that name; then the one whose name is that number; then the one at that position.
    pub(super) fn station(&self, table: &OffsetTable, text: &str) -> Result<usize, Box<Diagnostic>> {
        let names = || table.stations.iter().map(|station| station.station.name.trim());
        let number: Option<f64> = text.parse().ok();
        let same = |name: &str| number.is_some_and(|n| name.parse::<f64>().is_ok_and(|m| (m - n).abs() <= 1e-9));
        let found = names().position(|name| name.eq_ignore_ascii_case(text)).or_else(|| names().position(same));
        let found = found.or_else(|| {
            let positions: Vec<f64> = table.stations.iter().map(|station| station.station.x).collect();
            nearest(&positions, parse_length(text).ok()?)
        });
        found.ok_or_else(|| {
            let known: Vec<&str> = names().collect();
            self.problem("E171", format!("no station \"{text}\""), format!("The table has {}.", listed(&known)))
        })
    }

    /// The waterline with that header, or at that height.
    pub(super) fn waterline(&self, table: &OffsetTable, text: &str) -> Result<usize, Box<Diagnostic>> {
        let heads = &table.form.waterline_heads;
        let head = heads.iter().find(|head| head.text.trim().eq_ignore_ascii_case(text)).map(|head| head.value);
        let height = parse_length(text).ok().and_then(|z| nearest(&table.waterlines, z));
        let found = height.or_else(|| nearest(&table.waterlines, head?));
        found.ok_or_else(|| {
            let known: Vec<String> =
                table.waterlines.iter().map(|z| format!("{}", crate::units::decimal(*z))).collect();
            let known: Vec<&str> = known.iter().map(String::as_str).collect();
            self.problem("E172", format!("no waterline \"{text}\""), format!("The table has {} m.", listed(&known)))
        })
    }
}

/// The place in a list that lies within a millimetre.
fn nearest(list: &[f64], value: f64) -> Option<usize> {
    let found = list.iter().enumerate().min_by(|a, b| (a.1 - value).abs().total_cmp(&(b.1 - value).abs()));
    found.filter(|(_, other)| (*other - value).abs() <= 1e-3).map(|(index, _)| index)
}

/// Most names that a message shows.
const SHOWN: usize = 12;

fn listed(names: &[&str]) -> String {
    if names.len() <= SHOWN {
        return names.join(", ");
    }
    format!("{}, ... {}", names[..SHOWN - 1].join(", "), names[names.len() - 1])
}
