//! Sections as rows of points: CSV with the columns x, y, z and perhaps station, loop and point, and Maxsurf markers
//! (`Station`, x or longitudinal position, y or offset, z or height, separated by tabs).
//!
//! The head names the columns; a unit may follow a name (`y_m`, `Offset m`, `z [mm]`). Rows of one station,
//! or, without stations, of one x, are a section; each of its loops is a branch. Points are taken in the order of the
//! column `point` or, without one, of the rows, and turned round when a branch begins above its end.

use std::borrow::Cow;
use std::collections::BTreeSet;

use super::around::{self, unit_of_text};
use super::columns::{self, Column};
use super::fields::{Separator, TextLine, finish, lines, plain_number};
use super::header::{From, is_aftward};
use super::outline::{point, take_off_deck};
use super::problem::{Field, FilePosition, Problems};
use super::ratio::separator;
use super::scale::{LARGEST_HALF_BREADTH, UNIT};
use super::sections::{Body, Section, XOrigin, refuse_negative, table};
use super::settings::{Settings, StationScale};
use super::sides::{Sides, sides};
use super::{ReadTable, TableProblem};
use crate::hull::{Marks, OutlinePoint};
use crate::units::{CellEntry, CellReading, CellRules, CellWriting, Notation, parse_cell};

/// Points of one section are at one x when they are so near \[m\].
const SAME_X: f64 = 1e-6;

/// Decimals of metres that feet, inches and eighths are as fine as.
const EIGHTHS: usize = 3;

/// What a column of points holds, metres in its unit, and whether x counts from AP; none for any other column.
fn column(name: &str) -> Option<(Column, f64, bool)> {
    let named = columns::column(name).filter(|named| named.fraction.is_none())?;
    let point =
        matches!(named.column, Column::Station | Column::X | Column::Loop | Column::Point | Column::Y | Column::Z);
    point.then(|| (named.column, named.unit.map_or(1.0, |unit| unit.metres(1.0)), named.from_ap))
}

/// Marks between fields.
const MARKS: [char; 3] = [',', ';', '\t'];

/// Whether a line has a field, and is no comment.
fn has_field(line: &str) -> bool {
    let line = line.trim_start();
    !line.starts_with('#') && line.contains(|c: char| !c.is_whitespace() && !MARKS.contains(&c))
}

/// Whether a line has one field alone, as titles have.
fn is_title(line: &str) -> bool {
    !line.trim().trim_end_matches(MARKS).contains(MARKS)
}

/// The lines of fields from the head on: titles may stand above it.
fn content(text: &str) -> impl Iterator<Item = &str> {
    text.lines().filter(|line| has_field(line)).skip_while(|line| is_title(line))
}

fn head(text: &str) -> Option<(char, Vec<Option<Column>>)> {
    let line = content(text).next()?;
    let mark = separator(line);
    Some((mark, line.split(mark).map(|name| column(name).map(|(kind, _, _)| kind)).collect()))
}

/// Whether the head names x, y and z and nothing else, or points or loops of stations or x.
pub(super) fn recognise(_name: &str, text: &str) -> bool {
    let Some((mark, columns)) = head(text) else { return false };
    let has = |kind| columns.contains(&Some(kind));
    let points = has(Column::Point) || has(Column::Loop);
    let known = columns.iter().all(Option::is_some);
    (has(Column::X) && has(Column::Y) && has(Column::Z) && (known && is_grouped(text, mark, &columns) || points))
        || (points && (has(Column::Station) || has(Column::X)))
}

/// The text with decimal points for the decimal commas that another mark between columns allows.
fn pointed(text: &str, mark: char) -> Cow<'_, str> {
    let rows = || content(text).skip(1);
    let commas = mark != ',' && rows().any(|line| line.contains(',')) && !rows().any(|line| line.contains('.'));
    if commas { Cow::Owned(text.replace(',', ".")) } else { Cow::Borrowed(text) }
}

/// Whether the rows of a station, or of an x, follow each other.
fn is_grouped(text: &str, mark: char, columns: &[Option<Column>]) -> bool {
    let at = |kind| columns.iter().position(|column| *column == Some(kind));
    let Some(at) = at(Column::Station).or_else(|| at(Column::X)) else { return true };
    let names: Vec<&str> = content(text).skip(1).filter_map(|line| line.split(mark).nth(at)).map(str::trim).collect();
    let different: BTreeSet<&str> = names.iter().copied().collect();
    // An x that comes again in disorder is an error of the file; waterlines one after the other bring all of them again.
    names.chunk_by(|a, b| a == b).count() < 2 * different.len().max(2)
}

/// A row with its numbers.
struct PointRow<'a> {
    station: Option<&'a str>,
    x: f64,
    branch: f64,
    order: f64,
    point: OutlinePoint,
    place: FilePosition,
    /// Which of x, y and z state no unit themselves.
    plain: [bool; 3],
}

impl PointRow<'_> {
    /// Brings what states no unit to metres.
    fn scale(&mut self, factors: [f64; 3]) {
        let [x, y, z] = [0, 1, 2].map(|axis: usize| if self.plain[axis] { factors[axis] } else { 1.0 });
        self.x *= x;
        (self.point.y, self.point.z) = (self.point.y * y, self.point.z * z);
    }
}

/// Reads sections given by points.
///
/// # Errors
/// Every problem of the file.
pub(super) fn read(name: &str, text: &str) -> Result<ReadTable, Vec<TableProblem>> {
    read_with(name, text, &Settings::default())
}

/// The same with the unit, and the origin of x, of the conventions.
///
/// # Errors
/// Every problem of the file.
pub(super) fn read_with(name: &str, text: &str, settings: &Settings) -> Result<ReadTable, Vec<TableProblem>> {
    let mut problems = Problems::new(name);
    let mut settings = settings.clone();
    let of_line = |(k, line): (usize, &str)| Some((k + 1, line.trim_start().strip_prefix('#')?.trim().to_owned()));
    // What stands beside the file stands over what stands in it.
    let mut own = Settings::default();
    own.comments(&text.lines().enumerate().filter_map(of_line).collect::<Vec<_>>(), &mut problems);
    settings.stated = settings.stated.over(&own.stated);
    settings.units = settings.units.or(own.units);
    let mark = head(text).map_or(',', |(mark, _)| mark);
    let pointed = pointed(text, mark);
    let text = pointed.as_ref();
    let mut rows = lines(text, Separator::Exactly(mark));
    rows.retain(|line| has_field(line.text));
    let count = rows.iter().take_while(|line| is_title(line.text)).count();
    let titles = rows[..count].to_vec();
    titles.iter().for_each(|line| own.prose(line.text.trim_end_matches(MARKS)));
    let mut words = String::new();
    settings.stations = settings.stations.or(own.stations);
    if settings.stations.is_none()
        && let Some((from, said)) = said(&own, &mut problems)
    {
        settings.stations = Some(StationScale { from, numbers: false });
        words = said;
    }
    let title: Option<String> = titles.first().map(|line| line.text.trim_end_matches(MARKS).to_owned());
    let Some((head, lines)) = rows[count..].split_first() else {
        problems.error("E324", FilePosition::FILE, "the file is empty".to_owned(), "");
        return finish(problems, None);
    };
    let mut columns: Vec<(Column, usize, f64)> = Vec::new();
    let mut origin = XOrigin::Open;
    let is_declared =
        head.fields.iter().filter_map(|field| columns::column(field.text)).any(|named| named.unit.is_some());
    for (index, field) in head.fields.iter().enumerate() {
        let Some((kind, unit, from_ap)) = column(field.text) else {
            let message = "a column is station, x, loop, point, y or z, perhaps with a unit".to_owned();
            problems.error("E326", field, message, "Rename or remove it.");
            continue;
        };
        if columns.iter().any(|(other, _, _)| *other == kind) {
            let message = "a second column of this kind".to_owned();
            problems.error("E326", field, message, "Leave one out.");
        }
        if from_ap && kind == Column::X {
            origin = XOrigin::AfterPerpendicular;
        }
        columns.push((kind, index, unit));
    }
    for (kind, name) in [(Column::X, "x"), (Column::Y, "y"), (Column::Z, "z")] {
        if !columns.iter().any(|(other, _, _)| *other == kind) {
            let message = format!("the head has no column {name}");
            problems.error("E326", (FilePosition::row(head.row), head.text), message, "Points need x, y and z.");
        }
    }
    if problems.any_errors() {
        return finish(problems, None);
    }
    let mut rows: Vec<PointRow<'_>> =
        lines.iter().filter_map(|line| row(line, head.fields.len(), &columns, &mut problems)).collect();
    let places: Vec<[f64; 3]> = rows.iter().map(|row| [row.x, row.point.y, row.point.z]).collect();
    match sides(&places, &mut problems) {
        Sides::Kept => {}
        Sides::Turned => rows.iter_mut().for_each(|row| row.point.y = row.point.y.abs()),
        Sides::Doubled(doubled) => {
            let mut at = 0..;
            rows.retain(|_| at.next().is_some_and(|k| !doubled.contains(&k)));
        }
    }
    settings.units = settings.units.or(title.as_deref().and_then(unit_of_text));
    let stated = [settings.x_units.or(settings.units), settings.units, settings.z_units.or(settings.units)];
    let has_eighths = rows.iter().any(|row| row.plain.contains(&false));
    if !is_declared && (has_eighths || stated.iter().any(Option::is_some)) {
        // Plain numbers among feet, inches and eighths are feet.
        let usual = if has_eighths { Notation::Feet } else { Notation::Metres };
        let factors = stated.map(|unit| unit.unwrap_or(usual).metres(1.0));
        rows.iter_mut().for_each(|row| row.scale(factors));
    }
    let is_declared = is_declared || has_eighths || stated.iter().any(Option::is_some);
    if let Some(from) = settings.stations.map(|scale| scale.from) {
        origin = if from == From::AftPerpendicular { XOrigin::AfterPerpendicular } else { XOrigin::Named(from) };
        // Distances from FP count aft, unless they are negative.
        let turned = match from {
            From::ForePerpendicular => rows.iter().map(|row| row.x).sum::<f64>() > 0.0,
            From::Midship => is_aftward(&words),
            From::AftPerpendicular => false,
        };
        if turned {
            rows.iter_mut().for_each(|row| row.x = 0.0 - row.x);
        }
    }
    let mut unit = columns.iter().find(|(kind, _, _)| *kind == Column::Y).map_or(1.0, |(_, _, unit)| *unit);
    if !is_declared && are_millimetres(&rows) {
        let message = "no unit is declared; the points are taken as millimetres".to_owned();
        problems.warning("W320", FilePosition::FILE, message, UNIT);
        unit = 1e-3;
        rows.iter_mut().for_each(|row| row.scale([unit; 3]));
    } else if !is_declared {
        let message = "no unit is declared; the points are taken as metres".to_owned();
        problems.warning("W320", FilePosition::FILE, message, UNIT);
    }
    // What the conventions beside the file say is obeyed with all formats.
    if settings.full.is_none() {
        let field = |line: &TextLine<'_>| Field {
            text: line.text.trim_end_matches(MARKS).to_owned(),
            row: line.row,
            column: 1,
        };
        let fields: Vec<Field> = titles.iter().map(field).collect();
        around::breadths(&fields.iter().collect::<Vec<_>>(), &mut own, &mut problems);
        if own.full == Some(true) {
            rows.iter_mut().for_each(|row| row.point.y *= 0.5);
        }
    }
    let sections = group(&rows, &mut problems);
    let stated = settings.stated;
    let name = own.name.or(title).unwrap_or_default();
    table(Body { name, stated, sections, origin, unit }, problems)
}

/// Where distances count from by a sentence of the file, which is named.
fn said(own: &Settings, problems: &mut Problems) -> Option<(From, String)> {
    let scale =
        own.sentences.stations.as_ref().filter(|(scale, _)| !scale.numbers).map(|(scale, words)| (scale.from, words));
    let (from, words) = scale.or(own.sentences.end.as_ref().map(|(from, words)| (*from, words)))?;
    if from != From::AftPerpendicular {
        let message = format!("'{words}' says that stations are given by their distances from {}", from.as_str());
        problems.warning("W320", FilePosition::FILE, message, "Give stations in the conventions if it does not");
    }
    Some((from, words.clone()))
}

fn row<'a>(
    line: &TextLine<'a>,
    width: usize,
    columns: &[(Column, usize, f64)],
    problems: &mut Problems,
) -> Option<PointRow<'a>> {
    if line.fields.len() != width {
        let message = format!("{} fields, the head has {width}", line.fields.len());
        problems.error(
            "E322",
            (FilePosition::row(line.row), line.text),
            message,
            "A decimal comma, or a cell missing?",
        );
        return None;
    }
    let field = |kind: Column| -> Option<(Field<&'a str>, f64)> {
        let (_, index, unit) = columns.iter().find(|(other, _, _)| *other == kind)?;
        Some((*line.fields.get(*index)?, *unit))
    };
    let mut marks = Marks::default();
    let mut plain = [true; 3];
    let mut length = |kind: Column, what: &str| -> Option<f64> {
        let (field, unit) = field(kind)?;
        // What is no plain number may be feet, inches and eighths, or have a mark behind it.
        let rules = CellRules { unit: Notation::Metres, decimal_comma: false };
        let reading = parse_cell(field.text, rules).ok().filter(|_| plain_number(field.text).is_none());
        if let Some(CellReading { entry: CellEntry::Length(value), writing, .. }) = reading {
            let CellReading { doubtful, locked, knuckle, tangent, .. } = reading?;
            if kind == Column::Y {
                marks = Marks { doubtful, locked, knuckle, tangent };
            }
            if let CellWriting::Plain { decimals } = writing {
                problems.decimals = problems.decimals.max(if kind == Column::X { 0 } else { decimals });
                return Some(value * unit);
            }
            problems.decimals = problems.decimals.max(EIGHTHS);
            let axis = [Column::X, Column::Y, Column::Z].iter().position(|axis| *axis == kind);
            axis.into_iter().for_each(|axis| plain[axis] = false);
            return Some(value);
        }
        // Digits of x say nothing of those of the offsets.
        let value = if kind == Column::X { problems.number(field, what) } else { problems.length(field, what) };
        Some(value? * unit)
    };
    let (x, y, z) = (length(Column::X, "x"), length(Column::Y, "y"), length(Column::Z, "z"));
    let mut number = |kind: Column, what: &str| match field(kind) {
        Some((field, _)) => problems.number(field, what),
        None => Some(0.0),
    };
    let (branch, order) = (number(Column::Loop, "the loop"), number(Column::Point, "the point"));
    let station = field(Column::Station).map(|(field, _)| field.text);
    let place = FilePosition::row(line.row);
    let point = OutlinePoint { marks, ..point(y?, z?) };
    Some(PointRow { station, x: x?, branch: branch?, order: order?, point, place, plain })
}

/// Whether points without a unit are beyond any ship in metres.
fn are_millimetres(rows: &[PointRow<'_>]) -> bool {
    let largest = |of: fn(&PointRow<'_>) -> f64| rows.iter().map(|row| of(row).abs()).fold(0.0, f64::max);
    largest(|row| row.point.y) > LARGEST_HALF_BREADTH
}

/// Sections of rows that follow each other.
fn group(rows: &[PointRow<'_>], problems: &mut Problems) -> Vec<Section> {
    let same = |a: &PointRow<'_>, b: &PointRow<'_>| match (a.station, b.station) {
        (Some(a), Some(b)) => a == b,
        _ => (a.x - b.x).abs() <= SAME_X,
    };
    let mut sections = Vec::new();
    for rows in rows.chunk_by(same) {
        let first = &rows[0];
        if let Some(other) = rows.iter().find(|row| (row.x - first.x).abs() > SAME_X) {
            let message = format!(
                "station {}: x = {} m here and {} m in row {}",
                first.station.unwrap_or_default(),
                other.x,
                first.x,
                first.place.row.unwrap_or(0)
            );
            problems.error("E323", (other.place, other.x.to_string().as_str()), message, "A section stands at one x.");
        }
        let mut branches: Vec<Vec<OutlinePoint>> = Vec::new();
        for rows in rows.chunk_by(|a, b| (a.branch - b.branch).abs() < 0.5) {
            let mut rows: Vec<&PointRow<'_>> = rows.iter().collect();
            rows.sort_by(|a, b| a.order.total_cmp(&b.order));
            let mut points: Vec<OutlinePoint> = rows.iter().map(|row| row.point).collect();
            if points[0].z > points[points.len() - 1].z {
                points.reverse();
            }
            refuse_negative(&mut points, first.x, rows[0].place, problems);
            branches.push(points);
        }
        branches.sort_by(|a, b| a[0].z.total_cmp(&b[0].z));
        let deck = branches.last_mut().and_then(take_off_deck);
        let name = first.station.map(str::to_owned);
        sections.push(Section { name, x: first.x, place: first.place, branches, deck });
    }
    sections
}
