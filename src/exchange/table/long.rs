//! Tables of one point a row under any usual headers (see `columns`), as rows of a tidy table.
//!
//! Points on common heights are half-breadths at waterlines, all others are points of sections. Columns of indices are
//! left out. Fractions of L_PP, T and B become metres.

use std::collections::{BTreeMap, BTreeSet};

use super::around::{HALF_OR_FULL, UPWARD, by_slenderness, half_taken, says_full, taken, unit_of_text};
use super::columns::{Column, KNOWN, Named, Whole, breadths, column, is_ordinate};
use super::fields::decimals;
use super::header::{Axis, axis_of, begins_as_number, counts_down, position};
use super::heights;
use super::outline::{keel_of, take_off_deck};
use super::problem::{Field, FilePosition, Problems};
use super::ratio::missing_dimensions;
use super::sections::{decimals_in_metres, refuse_negative};
use super::settings::Settings;
use super::sides::{Sides, sides};
use super::tidy;
use crate::hull::{OffsetTable, TableForm};
use crate::units::Notation;

/// Station numbers follow each other in steps up to this.
const LARGEST_STEP: f64 = 2.0;
/// Heights over the draught are no larger.
const MOST_DRAUGHTS: f64 = 3.0;
/// Fewer common heights are those of keel, chine and sheer, and make no waterlines.
const LEAST_HEIGHTS: usize = 5;
/// More columns are no points.
const MOST_COLUMNS: usize = 6;

/// The columns of a header.
struct Columns {
    all: Vec<Option<Named>>,
    /// The column of breadths without a word for half or full.
    unsaid: Option<usize>,
    /// That of full breadths, and that of heights that count downward.
    full: Option<usize>,
    downward: Option<usize>,
}

impl Columns {
    fn of(header: &[Field]) -> Self {
        let all = header.iter().map(|field| column(&field.text)).collect();
        let mut columns = Self { all, unsaid: None, full: None, downward: None };
        let named = |column| Named { column, unit: None, from_ap: false, fraction: None };
        let full = header.iter().position(|field| says_full(&field.text));
        if let Some(at) = full.filter(|_| columns.find(Column::Y).is_none()) {
            let bare = field_without(&header[at].text, ["full", "whole"]);
            columns.all[at] = Some(breadths(&bare).unwrap_or(named(Column::Y)));
            columns.full = full;
        }
        let downward = header.iter().position(|field| counts_down(field.trimmed()));
        if let Some(at) = downward.filter(|_| columns.height().is_none()) {
            columns.all[at] = Some(named(Column::Z));
            columns.downward = downward;
        }
        if columns.find(Column::Y).is_none()
            && let Some((at, named)) =
                header.iter().enumerate().find_map(|(at, field)| Some((at, breadths(&field.text)?)))
        {
            (columns.all[at], columns.unsaid) = (Some(named), Some(at));
        }
        // Beside a column of stations an ordinate is no station.
        let ordinate = (0..header.len()).rfind(|at| is_ordinate(&header[*at].text));
        if columns.find(Column::Y).is_none()
            && let Some((at, named)) = ordinate.and_then(|at| Some((at, columns.all[at]?)))
            && columns.all[..at].iter().flatten().any(|n| matches!(n.column, Column::Station | Column::X))
        {
            (columns.all[at], columns.unsaid) = (Some(Named { column: Column::Y, ..named }), Some(at));
        }
        columns
    }

    fn find(&self, column: Column) -> Option<(usize, Named)> {
        let place = |(at, named): (usize, &Option<Named>)| named.filter(|n| n.column == column).map(|n| (at, n));
        self.all.iter().enumerate().find_map(place)
    }

    fn height(&self) -> Option<(usize, Named)> {
        self.find(Column::Z).or_else(|| self.find(Column::Waterline))
    }

    /// Whether columns hold half-breadths with their heights and stations.
    fn is_placed(&self) -> bool {
        let has = |column| self.find(column).is_some();
        has(Column::Y) && self.height().is_some() && (has(Column::X) || has(Column::Station))
    }

    fn indices(&self) -> usize {
        self.all.iter().flatten().filter(|named| named.column == Column::Index).count()
    }
}

/// A header in small letters without some words.
fn field_without(text: &str, words: [&str; 2]) -> String {
    words.into_iter().fold(text.to_lowercase(), |text, word| text.replace(word, "")).trim().to_owned()
}

/// A header of points, or of one offset a row, stands among so many rows.
const HIGHEST_HEADER: usize = 20;

/// The rows from the header on: titles of one field may stand above it, and of more above the words of columns.
pub(super) fn from_header(rows: &[Vec<Field>]) -> &[Vec<Field>] {
    let filled = |row: &Vec<Field>| row.iter().filter(|field| !field.is_blank()).count();
    let has_number = |row: &Vec<Field>| row.iter().any(|field| begins_as_number(&field.text));
    let words = rows.iter().take(HIGHEST_HEADER).take_while(|row| !has_number(row));
    let named =
        words.enumerate().find(|(_, row)| tidy::is_header(row) || Columns::of(row).is_placed()).map(|(at, _)| at);
    let at = named.or_else(|| rows.iter().position(|row| filled(row) > 1)).unwrap_or(0);
    &rows[at..]
}

/// Whether rows are points under words of which too few are known: no matrix has the same position twice.
pub(super) fn unknown_words(rows: &[Vec<Field>]) -> Option<&[Field]> {
    let rows = from_header(rows);
    let (header, body) = rows.split_first()?;
    let are_words = header
        .iter()
        .all(|field| !field.is_blank() && !begins_as_number(&field.text) && position(field.trimmed(), false).is_err());
    let body: Vec<&Vec<Field>> = body.iter().filter(|row| row.iter().any(|field| !field.is_blank())).collect();
    let numbers = body.iter().all(|row| row.len() == header.len() && row.iter().all(|f| begins_as_number(&f.text)));
    let firsts = |k: usize| body.iter().map(|row| row[k].trimmed()).collect::<BTreeSet<_>>().len();
    let fits = (3..=MOST_COLUMNS).contains(&header.len()) && are_words && body.len() > header.len() && numbers;
    (fits && 2 * firsts(0) <= body.len()).then_some(header)
}

/// Says which words are known.
pub(super) fn refuse_words(header: &[Field], problems: &mut Problems) {
    let unknown = header.iter().find(|field| column(&field.text).is_none()).unwrap_or(&header[0]);
    let message = format!("one point a row, and no word that is known for its columns: '{}'", unknown.trimmed());
    problems.error("E310", unknown, message, &format!("Name the columns {KNOWN}"));
}

/// Whether the first row names the columns of points and no kind of curve.
pub(super) fn is_long(rows: &[Vec<Field>]) -> bool {
    let Some(header) = from_header(rows).first() else { return false };
    let columns = Columns::of(header);
    let is_word =
        |(field, named): (&Field, &Option<Named>)| named.is_some() || field.text.contains(char::is_alphabetic);
    let has = |column| columns.find(column).is_some();
    let placed = columns.height().is_some() && (has(Column::X) || has(Column::Station));
    has(Column::Y)
        && !has(Column::Curve)
        && header.iter().zip(&columns.all).all(is_word)
        && (placed || columns.indices() > 1)
}

/// A point with its fields.
struct Point {
    station: Field,
    x: Field,
    z: Field,
    y: Field,
    flag: Field,
}

/// The table of a file of points.
pub(super) fn read(
    rows: &[Vec<Field>],
    form: TableForm,
    settings: &Settings,
    problems: &mut Problems,
) -> Option<OffsetTable> {
    let titles = &rows[..rows.len() - from_header(rows).len()];
    let rows = from_header(rows);
    let header = rows.first()?;
    let columns = Columns::of(header);
    if let Some(at) = columns.downward {
        problems.error("E311", &header[at], "heights count downward, and are not read so".to_owned(), UPWARD);
        return None;
    }
    let mut points = points(rows, header, &columns, problems)?;
    waterlines(&mut points, &columns, settings, problems);
    let mut settings = Settings { waterline_spacing: None, ..settings.clone() };
    units(&columns, &mut settings);
    let title = titles.iter().flatten().find(|field| !field.is_blank());
    settings.units = settings.units.or(title.and_then(|title| unit_of_text(title.trimmed())));
    if let Some(at) = columns.full.filter(|_| settings.full.is_none()) {
        let message = format!("full breadths, by '{}'", header[at].trimmed());
        problems.warning("W320", header[at].place(), message, HALF_OR_FULL);
        settings.full = Some(true);
    }
    left_out(header, &columns, problems);
    let comma = form.decimal_comma;
    if let Some(at) = columns.unsaid.filter(|_| settings.full.is_none()) {
        let is_placed = columns.find(Column::X).is_some();
        settings.full = weighed(&header[at], &points, (comma, is_placed), &settings, problems);
    }
    let digits = points.iter().map(|point| decimals(&point.y.text.replace(',', "."))).max().unwrap_or(0);
    let scaled = fractions(&mut points, &columns, comma, &settings, problems)?;
    let is_spaced =
        settings.station_spacing.is_some() || settings.sentences.frames.is_some() && by_frames(header, &columns);
    distances(&mut points, &columns, comma, (&settings, is_spaced), problems);
    one_side(&mut points, comma, problems);
    let (on_waterlines, heights) = on_waterlines(&points);
    // Points of keel, chine and sheer, station after station, are no waterlines.
    let few = heights < LEAST_HEIGHTS && columns.find(Column::Z).is_some() && by_stations(&points);
    let curve = if on_waterlines && !few { "WL" } else { "SEC" };
    problems.note(match curve {
        "WL" => "the points stand on common heights and are read as half-breadths at waterlines".to_owned(),
        _ if on_waterlines => format!("the points stand on {heights} heights and are read as sections"),
        _ => "the points stand on different heights and are read as sections".to_owned(),
    });
    let name = if by_frames(header, &columns) { "frame" } else { "station" };
    let mut table = tidy::read(&tidy_rows(points, name, curve), form, &settings, problems)?;
    if curve == "SEC" {
        sections(&mut table, problems);
    }
    if let Some(largest) = scaled {
        table.form.decimals = Some(decimals_in_metres(digits, largest));
    }
    Some(table)
}

/// Whether breadths without a word for half or full are full, by L/B; says what was taken.
fn weighed(
    header: &Field,
    points: &[Point],
    (comma, is_placed): (bool, bool),
    settings: &Settings,
    problems: &mut Problems,
) -> Option<bool> {
    let range = |field: fn(&Point) -> &Field| {
        let numbers = points.iter().filter_map(|point| number(field(point), comma));
        numbers.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], n| [low.min(n), high.max(n)])
    };
    let ([aft, fore], [_, largest]) = (range(|point| &point.x), range(|point| &point.y));
    let [x, y] = [settings.x_units, settings.units].map(|unit| unit.unwrap_or(Notation::Metres));
    let by_stations = is_placed.then(|| x.metres(fore - aft));
    let length = settings.stated.length_between_perpendiculars.or(by_stations);
    match length.and_then(|length| by_slenderness(length, y.metres(largest))) {
        Some((full, why)) => {
            problems.warning("W320", header.place(), taken(header.trimmed(), full, &why), HALF_OR_FULL);
            Some(full)
        }
        None => {
            problems.warning("W320", header.place(), half_taken(header.trimmed()), HALF_OR_FULL);
            None
        }
    }
}

/// Units that the headers state.
fn units(columns: &Columns, settings: &mut Settings) {
    let unit = |found: Option<(usize, Named)>| found.and_then(|(_, named)| named.unit);
    let along = columns.find(Column::X).or_else(|| columns.find(Column::Station));
    let (x, y, z) = (unit(along), unit(columns.find(Column::Y)), unit(columns.height()));
    settings.x_units = settings.x_units.or(settings.units).or(x);
    settings.z_units = settings.z_units.or(settings.units).or(z);
    settings.units = settings.units.or(y).or(x).or(z);
}

/// Names the columns that are not used.
fn left_out(header: &[Field], columns: &Columns, problems: &mut Problems) {
    let named = |index: bool| -> Vec<String> {
        let fields = header.iter().zip(&columns.all);
        let wanted = fields.filter(|(_, named)| match named {
            Some(named) => index && named.column == Column::Index,
            None => !index,
        });
        wanted.map(|(field, _)| format!("'{}'", field.trimmed())).collect()
    };
    let (indices, unknown) = (named(true), named(false));
    if !indices.is_empty() {
        problems.note(format!("columns that count or name are left out: {}", indices.join(", ")));
    }
    if !unknown.is_empty() {
        let message = format!("left out: columns that are not known, {}", unknown.join(", "));
        problems.warning("W332", FilePosition::row(header[0].row), message, "");
    }
}

fn points(rows: &[Vec<Field>], header: &[Field], columns: &Columns, problems: &mut Problems) -> Option<Vec<Point>> {
    let along = columns.find(Column::X).or_else(|| columns.find(Column::Station));
    let (Some((along, _)), Some((height, _)), Some((y, _))) = (along, columns.height(), columns.find(Column::Y)) else {
        let message = "the columns count stations and waterlines, and none says where they stand".to_owned();
        let remedy = "Give columns x and z with their distances and heights";
        problems.error("E310", FilePosition::row(header[0].row), message, remedy);
        return None;
    };
    let blank = Field::default();
    let mut points = Vec::new();
    for row in rows.iter().skip(1).filter(|row| row.iter().any(|field| !field.is_blank())) {
        if row.len() != header.len() {
            let message = format!("the row has {} fields, the header has {}", row.len(), header.len());
            problems.error("E307", FilePosition::row(row[0].row), message, "");
            continue;
        }
        let optional = |column| columns.find(column).map_or(&blank, |(at, _)| &row[at]).clone();
        points.push(Point {
            station: optional(Column::Station),
            x: row[along].clone(),
            z: row[height].clone(),
            y: row[y].clone(),
            flag: optional(Column::Flag),
        });
    }
    Some(points)
}

fn number(field: &Field, comma: bool) -> Option<f64> {
    let text = field.trimmed();
    if comma { text.replace(',', ".").parse().ok() } else { text.parse().ok() }.filter(|n: &f64| n.is_finite())
}

/// Leaves the points of one side, with positive half-breadths.
fn one_side(points: &mut Vec<Point>, comma: bool, problems: &mut Problems) {
    let place = |point: &Point| {
        let along = if point.x.is_blank() { &point.station } else { &point.x };
        Some([number(along, comma)?, number(&point.y, comma)?, number(&point.z, comma)?])
    };
    let Some(places) = points.iter().map(place).collect::<Option<Vec<_>>>() else { return };
    match sides(&places, problems) {
        Sides::Kept => {}
        Sides::Turned => {
            for point in points {
                point.y.text = point.y.trimmed().trim_start_matches('-').to_owned();
            }
        }
        Sides::Doubled(doubled) => {
            let mut at = 0..;
            points.retain(|_| at.next().is_some_and(|k| !doubled.contains(&k)));
        }
    }
}

/// Replaces a plain number by a length in metres.
fn scale(field: &mut Field, factor: f64, comma: bool) {
    if let Some(value) = number(field, comma) {
        let text = format!("{:.9}", factor * value);
        let text = text.trim_end_matches('0').trim_end_matches('.').to_owned();
        field.text = if comma { text.replace('.', ",") } else { text };
    }
}

/// Makes metres of fractions; the length that a fraction of half-breadths is of \[m\], where they are such.
fn fractions(
    points: &mut [Point],
    columns: &Columns,
    comma: bool,
    settings: &Settings,
    problems: &mut Problems,
) -> Option<Option<f64>> {
    let of = |found: Option<(usize, Named)>| found.and_then(|(_, named)| named.fraction);
    let along = of(columns.find(Column::X).or_else(|| columns.find(Column::Station)));
    let (y, z) = (of(columns.find(Column::Y)), of(columns.height()));
    if along.or(y).or(z).is_none() {
        return Some(None);
    }
    // Beside fractions of the breadth, positions without a word may be fractions too: of one length, or of one draught.
    let within = |least: f64, most: f64, field: fn(&Point) -> &Field| {
        points.iter().filter_map(|point| number(field(point), comma)).all(|value| (least..=most).contains(&value))
    };
    let named = along.is_some() || z.is_some();
    let along = along.is_some() || !named && within(-0.2, 1.2, |point| &point.x);
    let z = z.is_some() || !named && within(-0.2, MOST_DRAUGHTS, |point| &point.z);
    if !named && (along || z) {
        let message = "half-breadths are fractions: positions up to 1.2 are taken as fractions of L_PP, heights up to 3 as fractions of T";
        problems.warning(
            "W320",
            FilePosition::FILE,
            message.to_owned(),
            "Name such columns x/L and z/T, and others x [m] and z [m]",
        );
    }
    let stated = &settings.stated;
    let of_depth = of(columns.height()) == Some(Whole::Depth);
    let depth = stated.depth.filter(|depth| *depth > 0.0);
    if of_depth && depth.is_none() {
        let message = "heights are fractions of the depth, which is missing, or not above 0".to_owned();
        problems.error("E327", FilePosition::FILE, message, "Give D in the conventions");
        return None;
    }
    if let Some(problem) = missing_dimensions(stated, [true, true, !of_depth]) {
        problems.error("E327", FilePosition::FILE, problem.0, problem.1);
        return None;
    }
    let [length, breadth, draught] =
        [stated.length_between_perpendiculars, stated.breadth, stated.draught].map(|v| v.unwrap_or(1.0));
    let (draught, of_height) = depth.filter(|_| of_depth).map_or((draught, "T"), |depth| (depth, "D"));
    let largest = points.iter().filter_map(|point| number(&point.y, comma)).map(f64::abs).fold(0.0, f64::max);
    let half = match y {
        Some(Whole::Breadth) => breadth,
        Some(Whole::Unsaid) if (0.4..=0.55).contains(&largest) => {
            let message = format!("half-breadths up to {largest} are taken as fractions of B, not of B/2");
            problems.warning("W320", FilePosition::FILE, message, "Name the column y/B or y/(B/2)");
            breadth
        }
        Some(Whole::Unsaid) if !(0.9..=1.1).contains(&largest) => {
            let message = format!(
                "half-breadths up to {largest} are fractions of B or of B/2, and the header does not say which"
            );
            problems.error("E310", FilePosition::FILE, message, "Name the column y/B or y/(B/2)");
            return None;
        }
        _ => 0.5 * breadth,
    };
    for point in points.iter_mut() {
        if along {
            scale(&mut point.x, length, comma);
        }
        if z {
            scale(&mut point.z, draught, comma);
        }
        if y.is_some() {
            scale(&mut point.y, half, comma);
        }
    }
    problems.note(format!(
        "fractions of L_PP {length} m, B {breadth} m and {of_height} {draught} m, where the headers name such"
    ));
    Some(y.map(|_| half))
}

/// Steps between the different plain numbers of some fields, smallest first; none where one is no number.
fn steps<'p>(fields: impl Iterator<Item = &'p Field>, comma: bool) -> Option<(Vec<f64>, Vec<f64>)> {
    let mut values: Vec<f64> = fields.map(|field| number(field, comma)).collect::<Option<_>>()?;
    values.sort_by(f64::total_cmp);
    values.dedup_by(|a, b| (*a - *b).abs() < 1e-9);
    let mut steps: Vec<f64> = values.windows(2).map(|pair| pair[1] - pair[0]).collect();
    steps.sort_by(f64::total_cmp);
    Some((values, steps))
}

/// Whether the column of stations holds numbers of frames.
fn by_frames(header: &[Field], columns: &Columns) -> bool {
    columns.find(Column::Station).is_some_and(|(at, _)| axis_of(header[at].trimmed()) == Some(Axis::Frame))
}

/// Stations without a column x: their numbers, which stay in the column of stations, or distances.
fn distances(
    points: &mut [Point],
    columns: &Columns,
    comma: bool,
    (settings, is_spaced): (&Settings, bool),
    problems: &mut Problems,
) {
    let Some((_, named)) = columns.find(Column::Station).filter(|_| columns.find(Column::X).is_none()) else { return };
    let numbered = settings.stations.map(|scale| scale.numbers);
    let found = steps(points.iter().map(|point| &point.x), comma);
    let median = found.as_ref().and_then(|(_, steps)| steps.get(steps.len() / 2).copied());
    let by_size = median.is_some_and(|step| step > LARGEST_STEP);
    let stated = named.unit.is_some() || named.fraction.is_some() || is_spaced;
    if numbered.is_none()
        && !stated
        && by_size
        && let Some((values, _)) = &found
    {
        let message = format!(
            "the column of stations holds {} to {} in steps of {}: taken as distances, not as numbers of stations",
            values[0],
            values[values.len() - 1],
            median.unwrap_or_default()
        );
        problems.warning(
            "W320",
            FilePosition::FILE,
            message,
            "Name the column x, or give station_spacing in the conventions",
        );
    }
    let lengths = named.unit.is_some() || named.fraction.is_some() || numbered == Some(false);
    if !(lengths || numbered.is_none() && !is_spaced && by_size) {
        points.iter_mut().for_each(|point| point.x.text.clear());
    }
}

/// Heights that are numbers of waterlines, which the conventions space, become lengths.
fn waterlines(points: &mut [Point], columns: &Columns, settings: &Settings, problems: &mut Problems) {
    let Some((_, named)) = columns.height().filter(|(_, named)| named.fraction.is_none()) else { return };
    let fields: Vec<&Field> = points.iter().map(|point| &point.z).collect();
    let is_waterline = named.column == Column::Waterline;
    let Some(spacing) =
        heights::counted_points(&fields, is_waterline, named.unit.or(settings.z_units), settings, problems)
    else {
        return;
    };
    for field in points.iter_mut().map(|point| &mut point.z) {
        if let Some(value) = number(field, false) {
            field.text = format!("{} m", value * spacing);
        }
    }
}

/// The station of a point, as it is written.
fn place(point: &Point) -> &str {
    if point.x.is_blank() { point.station.trimmed() } else { point.x.trimmed() }
}

/// Whether the points stand where stations and waterlines cross: half of the crossings at least, and hardly one twice; and the
/// number of heights.
fn on_waterlines(points: &[Point]) -> (bool, usize) {
    let stations: BTreeSet<&str> = points.iter().map(place).collect();
    let mut heights: BTreeMap<&str, usize> = BTreeMap::new();
    for point in points {
        *heights.entry(point.z.trimmed()).or_default() += 1;
    }
    let crossings: BTreeSet<(&str, &str)> = points.iter().map(|point| (place(point), point.z.trimmed())).collect();
    let twice = points.len() - crossings.len();
    (2 * points.len() > stations.len() * heights.len() && 4 * twice < stations.len(), heights.len())
}

/// Whether the points of a station follow each other.
fn by_stations(points: &[Point]) -> bool {
    let stations: BTreeSet<&str> = points.iter().map(place).collect();
    points.chunk_by(|a, b| place(a) == place(b)).count() < 2 * stations.len()
}

fn tidy_rows(points: Vec<Point>, name: &str, curve: &str) -> Vec<Vec<Field>> {
    let word = |text: &str| Field { text: text.to_owned(), ..Field::default() };
    let mut rows = vec![[name, "x", "curve", "z", "y", "flag"].map(word).to_vec()];
    rows.extend(points.into_iter().map(|point| {
        let Point { station, x, z, y, flag } = point;
        vec![station, x, word(curve), z, y, flag]
    }));
    rows
}

/// Turns sections that begin at the deck, and takes lines on the deck off them.
fn sections(table: &mut OffsetTable, problems: &mut Problems) {
    for station in &mut table.stations {
        for outline in &mut station.outlines {
            if outline.len() > 1 && outline[0].z > outline[outline.len() - 1].z {
                outline.reverse();
            }
            refuse_negative(outline, station.station.x, FilePosition::FILE, problems);
        }
        if let Some(deck) = station.outlines.last_mut().and_then(take_off_deck) {
            station.deck_height = Some(deck.side.z);
            station.deck_half_breadth = Some(deck.side.y);
            station.deck_centre_height = Some(deck.centre_height);
        }
        station.keel_height = station.keel_height.or_else(|| keel_of(&station.outlines));
    }
}
