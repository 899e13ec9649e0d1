//! Rules of a job for single lines and regions: `[lock] lines`, `[tangent]`, `[flat]` and `[shape]`.

use std::ops::Range;

use super::super::diagnostic::Diagnostic;
use super::super::document::{Document, Raw, nearest};
use super::table_ref::TableRef;
use super::{JobFile, Location};
use crate::config::keys::expected;
use crate::fairing::bends::Line;
use crate::fairing::constraint::{FixedLine, Rule, TangentPlace};
use crate::fairing::proposals::Accepted;
use crate::fairing::{LineCourse, LineKind, ProposedLine};
use crate::hull::OffsetTable;
use crate::units::{Dimension, counted, decimal, parse_length};

/// Edges of the surface that may be fixed.
const EDGES: [&str; 4] = ["stem", "stern", "keel", "deck"];

/// Greatest angle of a tangent \[deg\].
const STEEPEST: f64 = 89.0;

/// A station or a waterline, or a part of it, in the words of the file.
#[derive(Debug, Clone, PartialEq)]
struct Part {
    station: bool,
    name: String,
    from: Option<String>,
    to: Option<String>,
}

/// A rule for a line or a region, in the words of the file.
#[derive(Debug, Clone, PartialEq)]
enum RuleText {
    Fixed(Part),
    Edge(FixedLine),
    Named(String),
    Entrance(String, f64),
    Run(String, f64),
    AlongWaterline(String, f64),
    AlongStation(String, f64),
    FlatOfSide([String; 2], [String; 2]),
    FlatOfBottom([String; 2]),
    Monotone(Part, bool),
    Curvature(Part, bool),
    Inflections(Part, usize),
    Breaks(Part, LineKind),
}

/// A rule with the place where it stands.
#[derive(Debug, Clone, PartialEq)]
pub struct RuleEntry {
    rule: RuleText,
    /// Where it stands.
    pub place: Location,
}

/// The words that name a station or a waterline, and whether it is a station.
fn sort(word: &str) -> Option<bool> {
    match word.to_lowercase().as_str() {
        "station" | "stations" => Some(true),
        "waterline" | "waterlines" => Some(false),
        _ => None,
    }
}

/// "NAME from A to B" without its first word; the name and the ends may have spaces.
fn part(text: &str) -> Option<Part> {
    let (word, rest) = text.trim().split_once(char::is_whitespace)?;
    let station = sort(word)?;
    let cut = |text: &str, word: &str| {
        let at = format!(" {text} ").to_lowercase().find(&format!(" {word} "))?;
        Some((text.get(..at.saturating_sub(1))?.trim().to_owned(), text.get(at + word.len()..)?.trim().to_owned()))
    };
    let (head, to) = match cut(rest, "to") {
        Some((head, to)) => (head, Some(to)),
        None => (rest.trim().to_owned(), None),
    };
    let (name, from) = match cut(&head, "from") {
        Some((name, from)) => (name, Some(from)),
        None => (head, None),
    };
    let whole =
        !name.is_empty() && from.as_ref().is_none_or(|f| !f.is_empty()) && to.as_ref().is_none_or(|t| !t.is_empty());
    whole.then_some(Part { station, name, from, to })
}

/// "stations A to B": the word and both ends.
fn span(text: &str) -> Option<(bool, [String; 2])> {
    let found = part(text)?;
    (found.from.is_none()).then_some(())?;
    Some((found.station, [found.name, found.to?]))
}

/// Reads the rules.
pub(super) fn read(document: &mut Document<'_>, job: &mut JobFile) {
    phrases(document, job, "lock.lines", |text| {
        let edge = EDGES.iter().position(|edge| edge.eq_ignore_ascii_case(text));
        if let Some(edge) = edge {
            let edges = [FixedLine::Stem, FixedLine::Stern, FixedLine::Keel, FixedLine::Deck];
            return edges.into_iter().nth(edge).map(RuleText::Edge);
        }
        if let Some(("line", name)) = text.split_once(char::is_whitespace) {
            return Some(RuleText::Named(name.trim().to_owned()));
        }
        part(text).filter(|part| part.from.is_none() && part.to.is_none()).map(RuleText::Fixed)
    });
    phrases(document, job, "flat.side", |text| {
        let (first, second) = text.split_once(',')?;
        match (span(first)?, span(second)?) {
            ((true, stations), (false, heights)) | ((false, heights), (true, stations)) => {
                Some(RuleText::FlatOfSide(stations, heights))
            }
            _ => None,
        }
    });
    phrases(document, job, "flat.bottom", |text| {
        span(text).filter(|(station, _)| *station).map(|(_, stations)| RuleText::FlatOfBottom(stations))
    });
    for (path, rising) in [("shape.rising", true), ("shape.falling", false)] {
        phrases(document, job, path, |text| part(text).map(|part| RuleText::Monotone(part, rising)));
    }
    for (path, convex) in [("shape.convex", true), ("shape.concave", false)] {
        phrases(document, job, path, |text| part(text).map(|part| RuleText::Curvature(part, convex)));
    }
    counts(document, job);
    accepted(document, job);
    // Lines are no rules: the net is made with them.
    let mut lines = JobFile::default();
    for (path, kind) in [("lines.knuckle", LineKind::Knuckle), ("lines.tangent", LineKind::Tangent)] {
        phrases(document, &mut lines, path, |text| part(text).map(|part| RuleText::Breaks(part, kind)));
    }
    job.lines.extend(lines.rules);
    type Make = fn(String, f64) -> RuleText;
    let angles: [(&str, Make); 4] = [
        ("tangent.entrance", RuleText::Entrance),
        ("tangent.run", RuleText::Run),
        ("tangent.waterlines", RuleText::AlongWaterline),
        ("tangent.stations", RuleText::AlongStation),
    ];
    for (path, rule) in angles {
        tangents(document, job, path, rule);
    }
}

/// `lines.accept`: numbers of proposals, "L1,L2" in one text too, or "all".
fn accepted(document: &mut Document<'_>, job: &mut JobFile) {
    let path = "lines.accept";
    let Some((raw, span, kind)) = document.raw(path) else { return };
    let single = [(raw.clone(), span.clone())];
    let items = match &raw {
        Raw::Array(items) => &items[..],
        _ => &single[..],
    };
    let (mut numbers, mut all) = (Vec::new(), false);
    for (item, at) in items {
        let Raw::Text(text) = item else {
            document.unexpected(path, item, at, kind);
            continue;
        };
        for word in text.split(',').map(str::trim) {
            let number = word.strip_prefix(['L', 'l']).and_then(|digits| digits.parse::<usize>().ok());
            match number {
                _ if word.eq_ignore_ascii_case("all") => all = true,
                Some(number) if number > 0 => numbers.push(number),
                _ => {
                    let message = format!("{path}: \"{word}\" is no line that is proposed");
                    document.problem("E123", path, at, message, "Expected L1, L2, ... or all.".into());
                }
            }
        }
    }
    job.accepted = Some(if all { Accepted::All } else { Accepted::These(numbers) });
}

fn mark(document: &Document<'_>, path: &str, rule: RuleText, at: &Range<usize>) -> RuleEntry {
    RuleEntry { rule, place: Location::new(document, path, at.start) }
}

/// A list of texts, or one; `meaning` is none for what is no such text.
fn phrases(document: &mut Document<'_>, job: &mut JobFile, path: &str, meaning: impl Fn(&str) -> Option<RuleText>) {
    let Some((raw, span, kind)) = document.raw(path) else { return };
    let single = [(raw.clone(), span.clone())];
    let items = match &raw {
        Raw::Array(items) => &items[..],
        Raw::Text(_) => &single[..],
        _ => {
            document.unexpected(path, &raw, &span, kind);
            return;
        }
    };
    for (item, at) in items {
        let Raw::Text(text) = item else {
            document.unexpected(path, item, at, kind);
            continue;
        };
        match meaning(text.trim()) {
            Some(rule) => job.rules.push(mark(document, path, rule, at)),
            None => unclear(document, path, text, at, &expected(kind)),
        }
    }
}

fn unclear(document: &mut Document<'_>, path: &str, text: &str, at: &Range<usize>, expected: &str) {
    let first = text.split_whitespace().next().unwrap_or("");
    let words = ["station", "waterline", "stations", "waterlines"].into_iter().chain(EDGES);
    let mut known = words.clone();
    let help = match nearest(first, words) {
        Some(near) if !known.any(|word| word.eq_ignore_ascii_case(first)) => format!("Did you mean {near}?"),
        _ => format!("Expected {expected}."),
    };
    document.problem("E123", path, at, format!("{path}: \"{}\" is not clear", text.trim()), help);
}

/// `shape.inflections`: lines or parts of them with the greatest number of their inflections.
fn counts(document: &mut Document<'_>, job: &mut JobFile) {
    let path = "shape.inflections";
    let Some((raw, span, kind)) = document.raw(path) else { return };
    let Raw::Table(fields) = &raw else {
        document.unexpected(path, &raw, &span, kind);
        return;
    };
    for (text, value, at) in fields {
        let line = part(text);
        let count = match value {
            Raw::Number(value) if value.fract() == 0.0 && (0.0..=99.0).contains(value) => Some(*value as usize),
            _ => None,
        };
        match (line, count) {
            (Some(line), Some(count)) => job.rules.push(mark(document, path, RuleText::Inflections(line, count), at)),
            (None, _) => unclear(document, path, text, at, &expected(kind)),
            (_, None) => {
                let message = format!("{path}.{text} is {}", value.describe());
                document.problem("E122", path, at, message, "Expected a whole number from 0 to 99.".into());
            }
        }
    }
}

/// A table of places with angles.
fn tangents(document: &mut Document<'_>, job: &mut JobFile, path: &str, rule: fn(String, f64) -> RuleText) {
    let Some((raw, span, kind)) = document.raw(path) else { return };
    let Raw::Table(fields) = &raw else {
        document.unexpected(path, &raw, &span, kind);
        return;
    };
    let cells = path == "tangent.waterlines" || path == "tangent.stations";
    for (text, value, at) in fields {
        let Some(measure) = document.measure(&format!("{path}.{text}"), value, at, kind) else { continue };
        let angle = if measure.dimension == Dimension::None { measure.value.to_radians() } else { measure.value };
        let degrees = decimal(angle.to_degrees());
        let least = if cells { -STEEPEST } else { 0.0 };
        if !(least..=STEEPEST).contains(&degrees) {
            let message = format!("{path}.{text} is {degrees} deg");
            document.problem("E124", path, at, message, format!("Expected {least} to {STEEPEST} deg."));
            continue;
        }
        if cells && text.split('@').filter(|part| !part.trim().is_empty()).count() != 2 {
            let help = "Write \"station@height\", as \"5@6.5\".".into();
            document.problem("E123", path, at, format!("{path}: \"{text}\" is no place"), help);
            continue;
        }
        job.rules.push(mark(document, path, rule(text.trim().to_owned(), angle), at));
    }
}

impl RuleEntry {
    /// Place of a station, by its name or its position, which may lie between those of the table \[m\].
    fn x(&self, table: &OffsetTable, text: &str) -> Result<f64, Box<Diagnostic>> {
        match TableRef::new(&self.place).station(table, text) {
            Ok(index) => Ok(table.stations[index].station.x),
            Err(problem) => parse_length(text).map_err(|_| problem),
        }
    }

    /// Height of a waterline, by its header or its height, which may lie between those of the table \[m\].
    fn z(&self, table: &OffsetTable, text: &str) -> Result<f64, Box<Diagnostic>> {
        match TableRef::new(&self.place).waterline(table, text) {
            Ok(index) => Ok(table.waterlines[index]),
            Err(problem) => parse_length(text).map_err(|_| problem),
        }
    }

    fn range(&self, from: f64, to: f64) -> Result<[f64; 2], Box<Diagnostic>> {
        let text = || format!("the range from {from} m to {to} m is empty");
        if from < to {
            Ok([from, to])
        } else {
            Err(Box::new(self.place.problem("E177", &text(), "Write the lesser of both first.")))
        }
    }

    fn line(&self, table: &OffsetTable, part: &Part) -> Result<Line, Box<Diagnostic>> {
        let name = &part.name;
        Ok(if part.station { Line::Station(self.x(table, name)?) } else { Line::Waterline(self.z(table, name)?) })
    }

    /// The part of a line that is meant \[m\].
    fn over(&self, table: &OffsetTable, part: &Part) -> Result<[f64; 2], Box<Diagnostic>> {
        let end = |text: &Option<String>, open: f64| match text {
            None => Ok(open),
            Some(text) if part.station => self.z(table, text),
            Some(text) => self.x(table, text),
        };
        self.range(end(&part.from, f64::NEG_INFINITY)?, end(&part.to, f64::INFINITY)?)
    }

    /// The line that breaks, over the stations or the waterlines of a table where no ends are named; none of rules.
    ///
    /// # Errors
    /// A message that says what the table has.
    pub fn find_line(&self, table: &OffsetTable) -> Result<Option<ProposedLine>, Box<Diagnostic>> {
        let RuleText::Breaks(part, kind) = &self.rule else { return Ok(None) };
        let (course, at) = match self.line(table, part)? {
            Line::Station(x) => (LineCourse::Station, x),
            Line::Waterline(z) => (LineCourse::Waterline, z),
        };
        let places: Vec<f64> = match course {
            LineCourse::Station => table.waterlines.clone(),
            LineCourse::Waterline => table.stations.iter().map(|station| station.station.x).collect(),
        };
        let [low, high] = places.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], p| [a.min(*p), b.max(*p)]);
        let [from, to] = self.over(table, part)?;
        let reach = [from.max(low), to.min(high)];
        let crossed = places.iter().filter(|place| (reach[0]..=reach[1]).contains(*place)).count();
        if crossed < 2 {
            let lines = if course == LineCourse::Station { "waterline" } else { "station" };
            let text = format!("the part of the line that breaks has {} of the table", counted(crossed, lines));
            let help = format!("Name a part with two of them at least, between {low} and {high} m.");
            return Err(Box::new(self.place.problem("E177", &text, help)));
        }
        Ok(Some(ProposedLine { kind: *kind, course, at, reach, gain: 1.0 }))
    }

    /// The rule for a table; none of lines that break.
    ///
    /// # Errors
    /// A message that says what the table has.
    pub fn find(&self, table: &OffsetTable) -> Result<Option<Rule>, Box<Diagnostic>> {
        let x = |text: &str| self.x(table, text);
        let z = |text: &str| self.z(table, text);
        let range = |from: f64, to: f64| self.range(from, to);
        let line = |part: &Part| self.line(table, part);
        let over = |part: &Part| self.over(table, part);
        let cell = |text: &str| -> Result<[f64; 2], Box<Diagnostic>> {
            let (station, height) = text.split_once('@').unwrap_or((text, ""));
            Ok([x(station.trim())?, z(height.trim())?])
        };
        Ok(Some(match &self.rule {
            RuleText::Breaks(..) => return Ok(None),
            RuleText::Fixed(part) => Rule::Fixed(FixedLine::Line(line(part)?)),
            RuleText::Edge(edge) => Rule::Fixed(edge.clone()),
            RuleText::Named(word) => Rule::Fixed(self.named(table, word)?),
            RuleText::Entrance(height, angle) => Rule::Tangent(TangentPlace::Entrance(z(height)?), *angle),
            RuleText::Run(height, angle) => Rule::Tangent(TangentPlace::Run(z(height)?), *angle),
            RuleText::AlongWaterline(place, angle) => Rule::Tangent(TangentPlace::Waterline(cell(place)?), *angle),
            RuleText::AlongStation(place, angle) => Rule::Tangent(TangentPlace::Station(cell(place)?), *angle),
            RuleText::FlatOfSide(stations, heights) => Rule::FlatOfSide {
                x: range(x(&stations[0])?, x(&stations[1])?)?,
                z: range(z(&heights[0])?, z(&heights[1])?)?,
            },
            RuleText::FlatOfBottom(stations) => Rule::FlatOfBottom { x: range(x(&stations[0])?, x(&stations[1])?)? },
            RuleText::Monotone(part, rising) => {
                Rule::Monotone { line: line(part)?, over: over(part)?, rising: *rising }
            }
            RuleText::Curvature(part, convex) => {
                Rule::Curvature { line: line(part)?, over: over(part)?, convex: *convex }
            }
            RuleText::Inflections(part, most) => {
                Rule::Inflections { line: line(part)?, over: over(part)?, most: *most }
            }
        }))
    }

    fn named(&self, table: &OffsetTable, word: &str) -> Result<FixedLine, Box<Diagnostic>> {
        let names = || table.lines.iter().map(|line| line.name.trim());
        match table.lines.iter().find(|line| line.name.trim().eq_ignore_ascii_case(word)) {
            Some(line) => {
                Ok(FixedLine::Named(line.name.clone(), line.points.iter().map(|point| [point[0], point[2]]).collect()))
            }
            None => {
                let help = match (nearest(word, names()), names().count()) {
                    (Some(near), _) => format!("Did you mean \"{near}\"?"),
                    (None, 0) => "The table declares no knuckles and no tangent lines.".to_owned(),
                    _ => format!("The table has {}.", names().collect::<Vec<_>>().join(", ")),
                };
                Err(Box::new(self.place.problem("E178", &format!("no line \"{word}\""), &help)))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_of_lines() {
        let found = |text: &str| part(text).map(|p| (p.station, p.name, p.from, p.to));
        let some = |text: &str| Some(text.to_owned());
        assert_eq!(found("waterline 6.5 from 0 to 9 1/2"), Some((false, "6.5".into(), some("0"), some("9 1/2"))));
        assert_eq!(found("Station 9 1/2"), Some((true, "9 1/2".into(), None, None)));
        assert_eq!(found("station 5 from 2 m"), Some((true, "5".into(), some("2 m"), None)));
        assert_eq!(found("station 5 to 2 m"), Some((true, "5".into(), None, some("2 m"))));
        for text in ["", "waterline", "waterline ", "6.5", "waterline from 2", "station 5 from to 3", "station 5 to "] {
            assert_eq!(found(text), None, "{text}");
        }
        assert_eq!(span("stations 8 to 12"), Some((true, ["8".into(), "12".into()])));
        assert_eq!(span("stations 8 from 9 to 12"), None);
    }
}
