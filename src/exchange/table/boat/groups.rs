//! Rows of a table of lines, with the group that each belongs to: heights, half-breadths, diagonals or positions.
//!
//! A group holds for the rows below its heading. A waterline has half-breadths and a buttock heights, whatever the heading.

use std::borrow::Cow;

use super::super::around::unit_of_text;
use super::super::header::{Axis, Position, axis_of, position, unit_of};
use super::super::pieces::is_numeric;
use super::super::problem::{Field, Problems};
use super::super::settings::Settings;
use crate::units::Notation;

/// Fewer lines with heights and half-breadths are the side rows of a matrix.
const LEAST_LINES: usize = 2;

/// What the numbers of a row are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Group {
    Positions,
    Heights,
    HalfBreadths,
    Diagonals,
}

/// A row of the table.
pub(super) struct Row<'g> {
    pub(super) group: Option<Group>,
    /// The line, without what the group says.
    pub(super) name: String,
    pub(super) label: &'g Field,
    pub(super) cells: &'g [Field],
    /// The unit of positions that a heading of waterlines or buttocks states.
    pub(super) unit: Option<Notation>,
}

/// The header and the rows of a table of lines.
pub(super) struct Lines<'g> {
    pub(super) heads: &'g [Field],
    pub(super) rows: Vec<Row<'g>>,
    /// All labels, those of groups among them.
    pub(super) labels: Vec<&'g Field>,
    /// What the heads are, beside them.
    pub(super) positions: Option<&'g Field>,
    /// Titles, and what stands above the labels.
    pub(super) titles: Vec<&'g Field>,
    /// What comments and rows of words say, of where diagonals lie among others.
    pub(super) definitions: Vec<String>,
}

pub(super) fn words(text: &str) -> Vec<String> {
    let lower = text.to_lowercase().replace(['\u{2010}', '\u{2011}'], "-");
    lower
        .split(|c: char| !c.is_alphanumeric() && !matches!(c, '\'' | '"' | '.'))
        .filter(|w| !w.is_empty())
        .map(str::to_owned)
        .collect()
}

/// A label with letters in brackets as words, `Sheer (H)`, and without its unit.
fn plain_label(text: &str) -> String {
    let Some((before, after)) = text.split_once(['(', '[']) else { return text.to_owned() };
    let Some((inside, rest)) = after.split_once([')', ']']) else { return text.to_owned() };
    let word = match inside.trim().to_lowercase().as_str() {
        "h" | "z" => "height",
        "b" | "y" => "breadth",
        _ if Notation::from_word(inside).is_some() => "",
        _ => return text.to_owned(),
    };
    format!("{before} {word} {rest}")
}

/// The group that a label names, and the words that name something else.
pub(super) fn group_of(text: &str) -> (Option<Group>, Vec<String>) {
    let mut group = None;
    let mut rest = Vec::new();
    let mut has_origin = false;
    let all = words(&plain_label(text));
    let counts_down = all.iter().any(|word| matches!(word.as_str(), "below" | "under" | "beneath"));
    for (k, word) in all.iter().enumerate() {
        let is_unit = |at: usize| all.get(at).is_some_and(|word| Notation::from_word(word).is_some());
        match word.trim_end_matches('.') {
            // `in feet` is a unit.
            "in" if is_unit(k + 1) => {}
            _ if k > 0 && all[k - 1] == "in" && is_unit(k) => {}
            "above" | "below" => has_origin = true,
            // From where heights count.
            "bl" | "dwl" | "lwl" | "wl" | "waterline" if has_origin => {}
            "depth" | "depths" if counts_down => group = group.or(Some(Group::Heights)),
            "height" | "heights" | "ht" | "hts" | "hab" | "elevation" | "elevations" => {
                group = group.or(Some(Group::Heights))
            }
            "half" | "halves" | "semi" | "semibreadth" | "semibreadths" | "hb" | "breadth" | "breadths"
            | "halfbreadth" | "halfbreadths" | "width" | "widths" | "halfwidth" | "halfwidths" | "beam" | "beams" => {
                group = Some(Group::HalfBreadths)
            }
            // `z sheer`, `sheer_y`, `Zsheer`.
            "z" if all.len() > 1 => group = group.or(Some(Group::Heights)),
            "y" if all.len() > 1 => group = group.or(Some(Group::HalfBreadths)),
            "diagonal" | "diagonals" | "diag" => group = Some(Group::Diagonals),
            "length" | "dist" | "distance" | "distances" | "station" | "stations" | "position" | "x" => {
                group = group.or(Some(Group::Positions));
            }
            "of" | "full" | "whole" | "base" | "baseline" | "line" | "at" | "from" | "centreline" | "centerline"
            | "c.l" | "cl" => {}
            _ => rest.push(word.clone()),
        }
    }
    (group, rest)
}

/// What the rows of waterlines and of buttocks give, which their names settle.
fn group_of_cut(label: &Field) -> Option<Group> {
    match axis_of(label.trimmed()).filter(|_| position(label.trimmed(), false).is_ok())? {
        Axis::Waterline => Some(Group::HalfBreadths),
        Axis::Buttock => Some(Group::Heights),
        Axis::X | Axis::Station | Axis::Frame => None,
    }
}

/// Whether a field is a value, and no label that begins with a number: `0-3-0 WL`.
fn is_value(field: &Field) -> bool {
    is_numeric(field) && !matches!(axis_of(field.trimmed()), Some(Axis::Waterline | Axis::Buttock))
}

/// The rows with their groups; none where the table has no labels and cells.
pub(super) fn lines(rows: &[Vec<Field>]) -> Option<Lines<'_>> {
    let filled = |row: &Vec<Field>| row.iter().filter(|field| !field.is_blank()).count();
    // Main dimensions above the table are a word with a number.
    let widest = rows.iter().map(filled).max()?;
    let at = rows.iter().position(|row| filled(row) > 1 && (filled(row) > 2 || 2 * filled(row) >= widest))?;
    let head = &rows[at];
    let body: Vec<&Vec<Field>> = rows[at + 1..].iter().filter(|row| !row.is_empty()).collect();
    let width = head.len();
    let labels = (0..width.min(3))
        .take_while(|&j| body.iter().all(|row| row.get(j).is_none_or(|field| !is_value(field))))
        .count();
    if labels == 0 || labels + 2 > width {
        return None;
    }
    let (mut list, mut all) = (Vec::new(), Vec::new());
    let (mut group, mut unit) = (None, None);
    for row in body {
        let cells = row.get(labels..).unwrap_or_default();
        let is_heading = cells.iter().all(Field::is_blank);
        let mut named = row.iter().take(labels).filter(|field| !field.is_blank());
        let mut name = Vec::new();
        let mut own = None;
        for field in named.clone() {
            let (found, rest) = group_of(&field.text);
            // A diagonal with its name is one row: those below it belong to the group before.
            let is_one = found == Some(Group::Diagonals) && !is_heading && !rest.is_empty();
            if found.is_some_and(|found| found != Group::Positions) && !is_one && own.is_none() {
                group = found;
            }
            own = own.or(found);
            name.extend(rest);
        }
        all.extend(named.clone());
        let Some(label) = named.next_back() else { continue };
        if is_heading {
            let of_cuts = matches!(axis_of(label.trimmed()), Some(Axis::Waterline | Axis::Buttock));
            unit = unit_of_label(label).filter(|_| of_cuts);
            continue;
        }
        let group = own.or_else(|| group_of_cut(label)).or(group);
        list.push(Row { group, name: name.join(" "), label, cells, unit });
    }
    let positions = head[..labels].iter().rfind(|field| group_of(field.trimmed()).0 == Some(Group::Positions));
    let is_title = |field: &&Field| !field.is_blank() && positions.is_none_or(|own| !std::ptr::eq(own, *field));
    let titles = rows[..at].iter().flatten().chain(&head[..labels]).filter(is_title).collect();
    Some(Lines { heads: &head[labels..], rows: list, labels: all, positions, titles, definitions: Vec::new() })
}

impl Lines<'_> {
    /// Whether a line has rows of a group.
    fn has(&self, name: &str, group: Group) -> bool {
        self.rows.iter().any(|row| row.group == Some(group) && row.name == name)
    }

    /// The names of lines, which are no positions of waterlines or buttocks.
    pub(super) fn names(&self) -> Vec<&str> {
        let mut names: Vec<&str> = Vec::new();
        for row in self.rows.iter().filter(|row| matches!(row.group, Some(Group::Heights | Group::HalfBreadths))) {
            if !row.name.is_empty() && !names.contains(&row.name.as_str()) && across(row).is_none() {
                names.push(&row.name);
            }
        }
        names
    }

    /// All words around the numbers.
    pub(super) fn texts(&self) -> impl Iterator<Item = &str> {
        let fields = self.titles.iter().chain(&self.labels).map(|field| field.trimmed());
        fields.chain(self.definitions.iter().map(String::as_str))
    }

    /// Units that the labels of groups and the titles state, where the conventions do not.
    pub(super) fn units(&self, settings: &mut Settings, problems: &mut Problems) {
        let mut of = |group: Group| {
            let of_group = |label: &&&Field| group_of(&label.text).0 == Some(group);
            let mut found = self
                .labels
                .iter()
                .chain(&self.positions)
                .filter(of_group)
                .filter_map(|label| Some((*label, unit_of_label(label)?)));
            let first = found.next()?;
            if let Some((label, unit)) = found.find(|(_, unit)| *unit != first.1) {
                let message = format!("'{}' and '{}' state different units", first.0.trimmed(), label.trimmed());
                problems.error(
                    "E305",
                    label,
                    message,
                    &format!("Give all in {} or in {}", first.1.as_str(), unit.as_str()),
                );
            }
            Some(first)
        };
        let found = [Group::Positions, Group::HalfBreadths, Group::Heights].map(&mut of);
        let titles = self.titles.iter().map(|field| field.trimmed()).chain(self.definitions.iter().map(String::as_str));
        let title = titles.clone().find_map(|text| Some((text, unit_of_text(text)?)));
        if settings.units.is_some() {
            return;
        }
        let said = found.iter().flatten().map(|(label, unit)| (label.trimmed(), *unit)).chain(title);
        for (text, unit) in said.clone() {
            problems.note(format!("'{text}' states the unit {}", unit.as_str()));
        }
        let [x, y, z] = found.map(|own| own.map(|(_, unit)| unit));
        settings.x_units = settings.x_units.or(x);
        settings.z_units = settings.z_units.or(z);
        // A title states the unit of the offsets; scale judges whether positions have it too.
        settings.units = y.or(title.map(|(_, unit)| unit)).or(z).or(x);
    }
}

/// The unit in a label: in brackets, or after `in`.
fn unit_of_label(label: &Field) -> Option<Notation> {
    let text = label.trimmed();
    unit_of_text(text).or_else(|| unit_of(text).filter(|_| text.contains(['(', '['])))
}

/// Where a row of a waterline or a buttock lies.
pub(super) fn across(row: &Row<'_>) -> Option<Position> {
    let known = matches!(axis_of(row.label.trimmed()), Some(Axis::Waterline | Axis::Buttock)) || is_numeric(row.label);
    position(row.label.trimmed(), false).ok().filter(|_| known)
}

/// The rows of the file, or its columns where its stations stand below each other.
pub(super) fn settled(rows: &[Vec<Field>]) -> Cow<'_, [Vec<Field>]> {
    let is_boat = |rows: &[Vec<Field>]| {
        lines(rows).is_some_and(|lines| {
            let both = |name: &&&str| lines.has(name, Group::Heights) && lines.has(name, Group::HalfBreadths);
            lines.names().iter().filter(both).count() >= LEAST_LINES
        })
    };
    if is_boat(rows) {
        return Cow::Borrowed(rows);
    }
    let filled: Vec<&Vec<Field>> = rows.iter().filter(|row| row.iter().any(|field| !field.is_blank())).collect();
    let width = filled.iter().map(|row| row.len()).max().unwrap_or(0);
    let turned: Vec<Vec<Field>> = (0..width)
        .map(|j| filled.iter().map(|row| row.get(j).cloned().unwrap_or_default()).collect())
        .filter(|column: &Vec<Field>| column.iter().any(|field| !field.is_blank()))
        .collect();
    if is_boat(&turned) { Cow::Owned(turned) } else { Cow::Borrowed(&[]) }
}
