//! Tables of offsets of DELFTship and FREE!ship (text with counts and flags).
//!
//! Ten lines of one number: waterlines, stations, five flags 0 or 1 (deck line at stations, contour at stations, aft
//! contour at waterlines, forward contour at waterlines, flat of bottom at stations), length, beam, draught. That much
//! is published. The order of what follows is not, and is read as: x of the stations, z of the waterlines,
//! half-breadths (a line a station, or a line a waterline where the lengths of the lines tell), then in the order of
//! the flags: height and half-breadth of the deck at each station, height of the contour at each station, x of the aft
//! and of the forward contour at each waterline, half-breadth of the flat of bottom at each station. A note says so.
//! `-` and `*` are cells without hull. Written in the same order, a line a station, six decimals.

use super::fields::{Separator, TextLine, finish, lines};
use super::problem::{Field, FilePosition, Problems};
use super::{ReadTable, TableProblem};
use crate::hull::{
    Cell, Entry, Marks, OffsetTable, StatedParticulars, StationOffsets, TableForm, TableLayout, Written,
};
use crate::units::counted;

/// Numbers of the head.
const HEAD: usize = 10;

fn rows(text: &str) -> Vec<TextLine<'_>> {
    lines(text, Separator::Blank).into_iter().filter(|line| !line.fields.is_empty()).collect()
}

/// Whether this is such a table: ten lines of one number, with 0 or 1 in lines three to seven.
pub(super) fn recognise(_name: &str, text: &str) -> bool {
    let mut numbers = Vec::new();
    let mut rows = text.lines().map(str::trim).filter(|line| !line.is_empty());
    for line in rows.by_ref().take(HEAD) {
        match super::fields::plain_number(line) {
            Some(value) => numbers.push(value),
            None => return false,
        }
    }
    let whole = |v: &f64| v.fract().abs() < 1e-12 && *v >= 1.0;
    let flag = |v: &f64| v.abs() < 1e-12 || (v - 1.0).abs() < 1e-12;
    // The positions of at least two stations stand in one line.
    let several = rows.next().is_none_or(|line| line.split_whitespace().count() > 1);
    several && numbers.len() == HEAD && numbers[..2].iter().all(whole) && numbers[2..7].iter().all(flag)
}

/// The fields after the head.
struct Stream<'a> {
    fields: Vec<Field<&'a str>>,
    next: usize,
}

impl<'a> Stream<'a> {
    fn take(&mut self, count: usize) -> Option<&[Field<&'a str>]> {
        let block = self.fields.get(self.next..self.next.checked_add(count)?)?;
        self.next += count;
        Some(block)
    }
}

/// Reads such a table.
///
/// # Errors
/// Every problem of the file.
pub(super) fn read(name: &str, text: &str) -> Result<ReadTable, Vec<TableProblem>> {
    let mut problems = Problems::new(name);
    let rows = rows(text);
    let head: Vec<Field<&str>> = rows.iter().take(HEAD).filter_map(|line| line.fields.first().copied()).collect();
    let [waterlines, stations, flags @ .., length, beam, draught] = &head[..] else {
        let message = format!("the head has {} of {HEAD} lines", head.len());
        problems.error("E324", FilePosition::FILE, message, "Was the file cut off?");
        return finish(problems, None);
    };
    let counts = (
        problems.count(*waterlines, "the number of waterlines", 1),
        problems.count(*stations, "the number of stations", 2),
    );
    let names = [
        "the flag of the deck line",
        "the flag of the contour",
        "the flag of the aft contour",
        "the flag of the forward contour",
        "the flag of the flat of bottom",
    ];
    let mut given = [false; 5];
    for ((given, field), what) in given.iter_mut().zip(flags).zip(names) {
        match problems.count(*field, what, 0) {
            Some(flag) if flag <= 1 => *given = flag == 1,
            Some(_) => {
                let message = format!("{what} is 0 or 1");
                problems.error("E326", field, message, "");
            }
            None => {}
        }
    }
    let mut main = [None; 3];
    for ((value, field), what) in
        main.iter_mut().zip([length, beam, draught]).zip(["the length", "the beam", "the draught"])
    {
        *value = problems.number(*field, what);
        if let Some(v) = value.filter(|v| *v <= 0.0) {
            problems.error("E327", field, format!("{what} is {v} m"), "It must be above 0.");
        }
    }
    let (Some(n), Some(m)) = counts else { return finish(problems, None) };
    let stream = Stream { fields: rows.iter().skip(HEAD).flat_map(|line| line.fields.clone()).collect(), next: 0 };
    let stations_at = m.saturating_mul(usize::from(given[4]) + usize::from(given[1]) + 2 * usize::from(given[0]));
    let waterlines_at = n.saturating_mul(usize::from(given[2]) + usize::from(given[3]));
    let wanted = m
        .saturating_mul(n)
        .saturating_add(m)
        .saturating_add(n)
        .saturating_add(stations_at)
        .saturating_add(waterlines_at);
    if wanted != stream.fields.len() {
        let message = format!(
            "{} and {} with these flags make {wanted} numbers after the head; {} there",
            counted(n, "waterline"),
            counted(m, "station"),
            stream.fields.len()
        );
        problems.error("E322", waterlines, message, "Correct the counts, the flags or the rows.");
        return finish(problems, None);
    }
    let by_waterline = rows
        .iter()
        .skip(HEAD)
        .scan(0, |sum, line| {
            let start = *sum;
            *sum += line.fields.len();
            Some((start, line.fields.len()))
        })
        .find(|(start, _)| *start >= n + m)
        .is_some_and(|(start, count)| start == n + m && count == m && n != m);
    let table = blocks(stream, n, m, given, by_waterline, &mut problems);
    let message = format!(
        "the order after the tenth line is not published; read as x of stations, z of waterlines, half-breadths with a line \
         for each {}, then what the flags announce in their order",
        if by_waterline { "waterline" } else { "station" }
    );
    problems.warning("W334", FilePosition::row(rows.get(HEAD).map_or(HEAD, |line| line.row)), message, "");
    let [length, breadth, draught] = main;
    let stated = StatedParticulars { length_between_perpendiculars: length, breadth, draught, depth: None };
    let form = TableForm { layout: TableLayout::Other, decimals: Some(problems.decimals), ..TableForm::default() };
    finish(problems, table.map(|table| OffsetTable { stated, form, ..table }))
}

fn blocks(
    mut stream: Stream<'_>,
    n: usize,
    m: usize,
    given: [bool; 5],
    by_waterline: bool,
    problems: &mut Problems,
) -> Option<OffsetTable> {
    let xs = rising(stream.take(m)?, "x of a station", problems);
    let waterlines = rising(stream.take(n)?, "z of a waterline", problems);
    let mut stations: Vec<StationOffsets> =
        xs.iter().enumerate().map(|(i, &x)| StationOffsets::new(i.to_string(), x)).collect();
    let offsets = stream.take(n * m)?;
    for (i, station) in stations.iter_mut().enumerate() {
        let cells = (0..n).map(|j| cell(offsets[if by_waterline { j * m + i } else { i * n + j }], problems));
        station.half_breadths = cells.collect();
    }
    let mut endings = vec![[None; 2]; n];
    if given[0] {
        for (station, pair) in stations.iter_mut().zip(stream.take(2 * m)?.chunks(2)) {
            station.deck_height = optional(pair[0], "the height of the deck", problems);
            station.deck_half_breadth = optional(pair[1], "the half-breadth of the deck", problems);
        }
    }
    if given[1] {
        for (station, field) in stations.iter_mut().zip(stream.take(m)?) {
            station.keel_height = optional(*field, "the height of the contour", problems);
        }
    }
    for end in 0..2 {
        if given[2 + end] {
            for (ends, field) in endings.iter_mut().zip(stream.take(n)?) {
                ends[end] = optional(*field, "x of the contour", problems);
            }
        }
    }
    if given[4] {
        for (station, field) in stations.iter_mut().zip(stream.take(m)?) {
            station.flat_of_bottom = optional(*field, "the flat of bottom", problems);
        }
    }
    Some(OffsetTable { waterlines, stations, endings, ..OffsetTable::default() })
}

/// Numbers that must rise.
fn rising(fields: &[Field<&str>], what: &str, problems: &mut Problems) -> Vec<f64> {
    let values: Vec<f64> = fields.iter().map(|field| problems.length(*field, what).unwrap_or(f64::NAN)).collect();
    for (pair, field) in values.windows(2).zip(&fields[1..]) {
        if pair[1] <= pair[0] {
            let message = format!("{what}: {} after {}", pair[1], pair[0]);
            problems.error("E323", field, message, "They must rise.");
        }
    }
    values
}

/// Writes a table of half-breadths with what else it holds of deck, contours and flat of bottom.
///
/// Sections given as points are not written: the format has none.
#[must_use]
pub fn write(table: &OffsetTable) -> String {
    let (stations, waterlines) = (&table.stations, &table.waterlines);
    let flags = [
        stations.iter().any(|s| s.deck_height.is_some() || s.deck_half_breadth.is_some()),
        stations.iter().any(|s| s.keel_height.is_some()),
        table.endings.iter().any(|ends| ends[0].is_some()),
        table.endings.iter().any(|ends| ends[1].is_some()),
        stations.iter().any(|s| s.flat_of_bottom.is_some()),
    ];
    let number = |value: f64| format!("{:.6}", value + 0.0);
    let or_dash = |value: Option<f64>| value.map_or("-".to_owned(), number);
    let mut text = format!("{}\n{}\n", waterlines.len(), stations.len());
    flags.iter().for_each(|&flag| text.push_str(if flag { "1\n" } else { "0\n" }));
    let mut line = |words: Vec<String>| {
        text.push_str(&words.join(" "));
        text.push('\n');
    };
    // What is not stated is the extent of the table.
    let ends = stations.first().zip(stations.last()).map(|(a, b)| b.station.x - a.station.x);
    let widest = stations.iter().flat_map(|s| &s.half_breadths).filter_map(Cell::value).fold(0.0, f64::max);
    let stated = table.stated;
    line(vec![number(stated.length_between_perpendiculars.or(ends).unwrap_or(0.0))]);
    line(vec![number(stated.breadth.unwrap_or(2.0 * widest))]);
    line(vec![number(stated.draught.or(waterlines.last().copied()).unwrap_or(0.0))]);
    line(stations.iter().map(|s| number(s.station.x)).collect());
    line(waterlines.iter().map(|&z| number(z)).collect());
    for station in stations {
        let cell = |j: usize| or_dash(station.half_breadths.get(j).and_then(Cell::value));
        line((0..waterlines.len()).map(cell).collect());
    }
    if flags[0] {
        stations.iter().for_each(|s| line(vec![or_dash(s.deck_height), or_dash(s.deck_half_breadth)]));
    }
    if flags[1] {
        line(stations.iter().map(|s| or_dash(s.keel_height)).collect());
    }
    for end in 0..2 {
        if flags[2 + end] {
            let place = |j: usize| or_dash(table.endings.get(j).and_then(|ends| ends[end]));
            line((0..waterlines.len()).map(place).collect());
        }
    }
    if flags[4] {
        line(stations.iter().map(|s| or_dash(s.flat_of_bottom)).collect());
    }
    text
}

fn absent(field: Field<&str>) -> bool {
    matches!(field.text, "-" | "*")
}

fn optional(field: Field<&str>, what: &str, problems: &mut Problems) -> Option<f64> {
    if absent(field) { None } else { problems.length(field, what) }
}

fn cell(field: Field<&str>, problems: &mut Problems) -> Cell {
    let entry = optional(field, "the half-breadth", problems).map_or(Entry::Absent, Entry::Given);
    if matches!(entry, Entry::Given(y) if y < 0.0) {
        let message = "a half-breadth is negative".to_owned();
        problems.error("E325", field, message, "Write - where there is no hull.");
    }
    let written = Written { text: field.text.to_owned(), row: field.row, column: field.column };
    Cell { entry, marks: Marks::default(), written: Some(written) }
}
