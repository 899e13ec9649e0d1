//! GHS geometry files (`.gf`): shapes of sections, components made of shapes, parts made of components.
//!
//! Title, `KEY:value` lines, `*`, shapes, `**`, components, `***`, parts, and `****`. Coordinates are in feet whatever
//! the display units `P:` say; x grows aft, y to starboard. A component of side 0 is mirrored, one of side 1 or -1 is
//! not. A section is half of it, or a loop around both sides, which is cut at the centreplane. The table has the
//! sections of the component of the part HULL that reaches the centreplane on most sections; every other is named in
//! the notes.
//!
//! Limits: shell thickness of shapes is not applied. Written are half sections of side 0 in 1e-4 ft (0.03 mm).

use super::fields::{Separator, TextLine, finish, lines};
use super::outline::{Deck, line_of, point, take_off_deck};
use super::problem::{Field, FilePosition, Problems};
use super::sections::{Body, Section, XOrigin, note_asymmetry, starboard_of, table};
use super::{ReadTable, TableProblem};
use crate::hull::{OffsetTable, OutlinePoint, StatedParticulars};
use crate::units::counted;
use std::fmt::Write as _;

/// More shapes, components or parts than this are no ship.
const MOST_NAMES: usize = 5000;

/// Metres in a foot.
const FOOT: f64 = 0.3048;

/// A section of a shape, in the file's axes \[ft\].
#[derive(Debug, Clone)]
struct ShapeSection {
    x: f64,
    row: usize,
    points: Vec<[f64; 2]>,
}

#[derive(Debug)]
struct Shape<'a> {
    name: &'a str,
    sections: Vec<ShapeSection>,
}

#[derive(Debug)]
struct Component<'a> {
    name: &'a str,
    row: usize,
    side: f64,
    offset: [f64; 3],
    shape: &'a str,
}

#[derive(Debug)]
struct Part<'a> {
    name: &'a str,
    row: usize,
    components: Vec<&'a str>,
}

/// Whether this is a GHS geometry file.
pub(super) fn recognise(name: &str, text: &str) -> bool {
    let name = name.to_ascii_lowercase();
    let extension = [".gf", ".gf1", ".gft"].iter().any(|end| name.ends_with(end));
    let marks = |wanted: &str| text.lines().any(|line| line.trim() == wanted);
    extension || (marks("*") && marks("**") && marks("***"))
}

/// Lines one after another.
struct LineReader<'a> {
    lines: Vec<TextLine<'a>>,
    next: usize,
}

impl<'a> LineReader<'a> {
    fn peek(&mut self) -> Option<&TextLine<'a>> {
        while self.lines.get(self.next).is_some_and(|line| line.text.is_empty()) {
            self.next += 1;
        }
        self.lines.get(self.next)
    }

    fn take(&mut self) -> Option<TextLine<'a>> {
        self.peek()?;
        self.next += 1;
        self.lines.get(self.next - 1).cloned()
    }

    /// The next line unless it begins with `*`.
    fn data(&mut self) -> Option<TextLine<'a>> {
        if self.peek()?.text.starts_with('*') { None } else { self.take() }
    }

    /// Row of the next line, or of the last of the file.
    fn place(&mut self) -> FilePosition {
        let last = self.lines.last().map_or(1, |line| line.row);
        FilePosition::row(self.peek().map_or(last, |line| line.row))
    }

    /// Takes the mark that ends a block, skipping what is before it; says so when it is missing.
    fn mark(&mut self, mark: &str, block: &str, problems: &mut Problems) {
        while self.data().is_some() {}
        let place = self.place();
        match self.peek().map(|line| line.text) {
            Some(text) if text == mark => self.next += 1,
            Some(text) => {
                let message = format!("'{mark}' should end {block}");
                problems.error("E324", (place, text), message, &format!("Put a line '{mark}' before this one."));
            }
            None => {
                let message = format!("the file ends before '{mark}', which ends {block}");
                problems.error("E324", place, message, "Was the file cut off?");
            }
        }
    }
}

/// Reads a GHS geometry file.
///
/// # Errors
/// Every problem of the file.
pub(super) fn read(name: &str, text: &str) -> Result<ReadTable, Vec<TableProblem>> {
    let mut problems = Problems::new(name);
    let mut reader = LineReader { lines: lines(text, Separator::CommaOrBlank), next: 0 };
    let title = reader.data().map_or("", |line| line.text);
    let length = header(&mut reader, &mut problems);
    let shapes = shapes(&mut reader, &mut problems);
    let components = components(&mut reader, &mut problems);
    let parts = parts(&mut reader, &mut problems);
    let named: usize = parts.iter().map(|part| 1 + part.components.len()).sum();
    if shapes.len().max(components.len()).max(named) > MOST_NAMES {
        let message = format!("more than {MOST_NAMES} shapes, components or parts");
        problems.error("E312", FilePosition::FILE, message, "Keep those of the hull.");
    }
    if problems.any_errors() {
        return finish(problems, None);
    }
    let Some(component) = hull(&shapes, &components, &parts, &mut problems) else { return finish(problems, None) };
    let sections = sections(component, &shapes, &mut problems);
    let stated = StatedParticulars { length_between_perpendiculars: length.map(|l| l * FOOT), ..Default::default() };
    table(Body { name: title.to_owned(), stated, sections, origin: XOrigin::Unknown, unit: FOOT }, problems)
}

/// The `KEY:value` lines; gives the length `L:` \[ft\].
fn header(reader: &mut LineReader<'_>, problems: &mut Problems) -> Option<f64> {
    let mut length = None;
    while let Some(line) = reader.data() {
        let place = FilePosition::row(line.row);
        match line.text.split_once(':') {
            Some(("L", value)) => {
                length = problems.number(Field { text: value.trim(), row: line.row, column: 0 }, "the length L")
            }
            Some(("W" | "P" | "N" | "O" | "OL" | "OT" | "OV" | "V" | "D" | "C", _)) => {}
            Some((key, _)) => {
                problems.warning("W334", place, format!("the line '{}:' is not used", key.trim()), "");
            }
            None => {
                let message = "lines between the title and '*' are KEY:value".to_owned();
                problems.error("E326", (place, line.text), message, "Put '*' before the first shape.");
            }
        }
    }
    reader.mark("*", "the lines after the title", problems);
    length.filter(|l| *l > 0.0)
}

fn shapes<'a>(reader: &mut LineReader<'a>, problems: &mut Problems) -> Vec<Shape<'a>> {
    let mut shapes = Vec::new();
    while let Some(line) = reader.data() {
        match shape(&line, reader, problems) {
            Some(shape) => shapes.push(shape),
            // After a wrong count nothing up to the next mark can be told apart.
            None => break,
        }
    }
    reader.mark("**", "the shapes", problems);
    if shapes.is_empty() && !problems.any_errors() {
        problems.error("E328", FilePosition::FILE, "the file has no shapes".to_owned(), "");
    }
    shapes
}

fn shape<'a>(title: &TextLine<'a>, reader: &mut LineReader<'a>, problems: &mut Problems) -> Option<Shape<'a>> {
    let name = title.text;
    let missing = |what: &str, reader: &mut LineReader<'a>, problems: &mut Problems| {
        let place = reader.place();
        let found = reader.peek().map_or("", |line| line.text);
        let message = format!("{what} expected");
        problems.error("E322", (place, found), message, "Is the count before it right?");
    };
    let Some(line) = reader.data() else {
        missing(&format!("shape '{name}': number of sections"), reader, problems);
        return None;
    };
    if line.fields.len() != 1 {
        let message = format!("shape '{name}': number of sections expected, one number");
        let remedy = "Is the number of sections of the shape before it, or of the points of its last section, right?";
        problems.error("E322", (FilePosition::row(line.row), line.text), message, remedy);
        return None;
    }
    let announced = problems.count(line.fields[0], "the number of sections", 1)?;
    let count_row = line.row;
    let mut sections: Vec<ShapeSection> = Vec::new();
    for k in 0..announced {
        let Some(head) = reader.data() else {
            let what = format!(
                "shape '{name}' (row {count_row}) announces {}, the file has {k}; section",
                counted(announced, "section")
            );
            missing(&what, reader, problems);
            return None;
        };
        let blame = sections.last().map_or_else(String::new, |before: &ShapeSection| {
            format!(" (row {} announces {})", before.row, counted(before.points.len(), "point"))
        });
        let [x, count] = head.fields[..] else {
            let message = format!("section {} of '{name}': x and number of points expected{blame}", k + 1);
            problems.error("E322", (FilePosition::row(head.row), head.text), message, "Is the count before it right?");
            return None;
        };
        let x = problems.length(x, "x of the section");
        let count = problems.count(count, &format!("the number of points of section {}{blame}", k + 1), 1)?;
        let mut points = Vec::new();
        for i in 0..count {
            let Some(line) = reader.data() else {
                let what = format!(
                    "the section in row {} announces {}, the file has {i}; y, z",
                    head.row,
                    counted(count, "point")
                );
                missing(&what, reader, problems);
                return None;
            };
            let [y, z] = line.fields[..] else {
                let message = format!("point {} of {count}: y, z expected", i + 1);
                let remedy = format!("Is the number of points in row {} right?", head.row);
                problems.error("E322", (FilePosition::row(line.row), line.text), message, &remedy);
                return None;
            };
            if let (Some(y), Some(z)) = (problems.length(y, "y"), problems.length(z, "z")) {
                points.push([y, z]);
            }
        }
        sections.push(ShapeSection { x: x.unwrap_or(0.0), row: head.row, points });
    }
    // Three numbers that belong to the shape: shell thickness.
    if reader.peek().is_some_and(|line| triple(line).is_some())
        && let Some(line) = reader.take()
        && triple(&line).is_some_and(|t| t.iter().any(|v| v.abs() > 0.0))
    {
        problems.warning(
            "W334",
            FilePosition::row(line.row),
            format!("the three numbers after shape '{name}' are not applied"),
            "",
        );
    }
    Some(Shape { name, sections })
}

fn triple(line: &TextLine<'_>) -> Option<[f64; 3]> {
    let [a, b, c] = line.fields[..] else { return None };
    let number = |field: Field<&str>| super::fields::plain_number(field.text);
    Some([number(a)?, number(b)?, number(c)?])
}

fn components<'a>(reader: &mut LineReader<'a>, problems: &mut Problems) -> Vec<Component<'a>> {
    let mut components = Vec::new();
    while let Some(title) = reader.data() {
        let wanted = ["side (0, 1 or -1)", "effectiveness", "offset x, y, z", "name of the shape"];
        let mut found = Vec::new();
        for what in wanted {
            match reader.data() {
                Some(line) => found.push(line),
                None => {
                    let message = format!("component '{}': {what} expected", title.text);
                    problems.error("E322", reader.place(), message, "A component has five lines.");
                    break;
                }
            }
        }
        let [side, _, offset, shape] = &found[..] else { break };
        let side = side.fields.first().copied().and_then(|field| problems.number(field, "the side"));
        let shift = triple(offset);
        if shift.is_none() {
            let message = format!("component '{}': offset x, y, z expected", title.text);
            problems.error(
                "E322",
                (FilePosition::row(offset.row), offset.text),
                message,
                "Write three numbers with commas.",
            );
        }
        components.push(Component {
            name: title.text,
            row: title.row,
            side: side.unwrap_or(0.0),
            offset: shift.unwrap_or_default(),
            shape: shape.text,
        });
    }
    reader.mark("***", "the components", problems);
    components
}

fn parts<'a>(reader: &mut LineReader<'a>, problems: &mut Problems) -> Vec<Part<'a>> {
    let mut parts = Vec::new();
    while let Some(title) = reader.data() {
        let mut counted = None;
        // Contents, kind, density, reference point, then the number of components.
        for k in 0..5 {
            let Some(line) = reader.data() else {
                let message = format!("part '{}': six lines and its components expected", title.text);
                problems.error("E322", reader.place(), message, "");
                break;
            };
            if k == 4 {
                counted = line.fields.first().and_then(|field| problems.count(*field, "the number of components", 1));
            }
        }
        let Some(count) = counted else { break };
        let mut components = Vec::new();
        for k in 0..count {
            match reader.data() {
                Some(line) => components.push(line.text),
                None => {
                    let message = format!("part '{}' announces {count} components, the file has {k}", title.text);
                    problems.error("E322", reader.place(), message, "Correct the count.");
                    break;
                }
            }
        }
        parts.push(Part { name: title.text, row: title.row, components });
    }
    if reader.peek().is_some_and(|line| line.text.to_ascii_uppercase().starts_with("*CRT")) {
        reader.take();
    }
    reader.mark("****", "the file", problems);
    parts
}

/// The component that is the hull, and notes on all others.
fn hull<'c, 'a>(
    shapes: &[Shape<'a>],
    components: &'c [Component<'a>],
    parts: &[Part<'a>],
    problems: &mut Problems,
) -> Option<&'c Component<'a>> {
    for part in parts {
        for name in &part.components {
            if !components.iter().any(|c| c.name == *name) {
                let message = format!("part '{}' has a component that the file does not define", part.name);
                problems.error("E326", (FilePosition::row(part.row), *name), message, "Check the name.");
            }
        }
    }
    for component in components {
        if !shapes.iter().any(|s| s.name == component.shape) {
            let message = format!("component '{}' has a shape that the file does not define", component.name);
            problems.error("E326", (FilePosition::row(component.row), component.shape), message, "Check the name.");
        }
    }
    let named = |wanted: fn(&str) -> bool| parts.iter().find(|p| wanted(&p.name.to_ascii_uppercase()));
    let Some(part) = named(|n| n == "HULL").or_else(|| named(|n| n.contains("HULL"))).or(parts.first()) else {
        problems.error("E328", FilePosition::FILE, "the file has no parts".to_owned(), "A part HULL is needed.");
        return None;
    };
    for other in parts.iter().filter(|other| other.row != part.row) {
        problems.warning("W332", FilePosition::row(other.row), format!("part '{}' is left out", other.name), "");
    }
    let mut best: Option<(usize, &Component<'_>)> = None;
    let mut left_out = Vec::new();
    for component in components.iter().filter(|c| part.components.contains(&c.name)) {
        let Some(shape) = shapes.iter().find(|s| s.name == component.shape) else { continue };
        let centred = shape.sections.iter().filter(|s| usable(component, s)).count();
        if 2 * centred <= shape.sections.len() || best.is_some_and(|(most, _)| most >= centred) {
            left_out.push((component, shape));
        } else {
            if let Some((_, before)) = best
                && let Some(shape) = shapes.iter().find(|s| s.name == before.shape)
            {
                left_out.push((before, shape));
            }
            best = Some((centred, component));
        }
    }
    for (component, shape) in &left_out {
        let text = describe(component, shape);
        problems.warning(
            "W332",
            FilePosition::row(component.row),
            format!("component '{}' is left out: {text}", component.name),
            "",
        );
    }
    let Some((_, hull)) = best else {
        let all: Vec<String> = left_out.iter().map(|(c, s)| format!("'{}': {}", c.name, describe(c, s))).collect();
        let message =
            format!("no component of part '{}' is a hull over the centreplane; {}", part.name, all.join("; "));
        let remedy = "A half section needs side 0; a loop must go around both sides.";
        problems.error("E328", (FilePosition::row(part.row), part.name), message, remedy);
        return None;
    };
    Some(hull)
}

/// The points of a section in metres, shifted by the component's offset.
fn shifted(component: &Component<'_>, section: &ShapeSection) -> Vec<OutlinePoint> {
    let [_, dy, dz] = component.offset;
    section.points.iter().map(|[y, z]| point((y + dy) * FOOT, (z + dz) * FOOT)).collect()
}

/// Whether a section is a half of side 0 that begins at or under the centreplane, or a loop around both sides.
fn usable(component: &Component<'_>, section: &ShapeSection) -> bool {
    let points = shifted(component, section);
    let least = points.iter().map(|p| p.y).fold(f64::INFINITY, f64::min);
    let most = points.iter().map(|p| p.y).fold(f64::NEG_INFINITY, f64::max);
    let mirrored = component.side.abs() < 0.5;
    let both = least < -1e-9 && most > 1e-9;
    // Half a tenth of the breadth: sections of a half hull may begin at the edge of a flat bottom.
    both || (mirrored && least.abs().min(most.abs()) <= 0.05 * most.abs().max(least.abs()))
        || (most - least < 1e-9 && most.abs() < 1e-9)
}

fn describe(component: &Component<'_>, shape: &Shape<'_>) -> String {
    let all = shape.sections.iter().flat_map(|section| shifted(component, section));
    let (low, high) = all.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), p| (a.min(p.y), b.max(p.y)));
    let side = match component.side {
        s if s > 0.5 => "on starboard only",
        s if s < -0.5 => "on port only",
        _ => "on both sides",
    };
    format!("{} sections from y = {low:.3} to {high:.3} m, {side}", shape.sections.len())
}

fn sections(component: &Component<'_>, shapes: &[Shape<'_>], problems: &mut Problems) -> Vec<Section> {
    let Some(shape) = shapes.iter().find(|s| s.name == component.shape) else { return Vec::new() };
    let mut gaps = Vec::new();
    let mut sections = Vec::new();
    for section in &shape.sections {
        let place = FilePosition::row(section.row);
        let x = 0.0 - (section.x + component.offset[0]) * FOOT;
        let mut points = shifted(component, section);
        let both = points.iter().any(|p| p.y < -1e-9) && points.iter().any(|p| p.y > 1e-9);
        let mut branches = if both {
            match starboard_of(&points) {
                Some((branches, gap)) => {
                    gaps.push((gap, x));
                    branches
                }
                None => Vec::new(),
            }
        } else {
            points.iter_mut().for_each(|p| p.y = p.y.abs());
            open_half(&mut points);
            super::outline::branches(points)
        };
        if branches.iter().flatten().count() == 0 {
            let message = format!("the section at x = {} ft has no breadth on a side", section.x);
            problems.error("E328", place, message, "");
        }
        let deck: Option<Deck> = branches.last_mut().and_then(take_off_deck);
        sections.push(Section { name: None, x, place, branches, deck });
    }
    note_asymmetry(&gaps, "starboard", problems);
    sections
}

/// A half section that closes on its first point, or runs from deck to keel, as an open line from keel to deck.
fn open_half(points: &mut Vec<OutlinePoint>) {
    let closes = |points: &[OutlinePoint]| {
        points.len() > 3
            && (points[0].y - points[points.len() - 1].y).hypot(points[0].z - points[points.len() - 1].z) < 1e-9
    };
    if closes(points) {
        points.pop();
    }
    if let (Some(first), Some(last)) = (points.first(), points.last())
        && first.z > last.z
    {
        points.reverse();
    }
}

/// Writes half sections of a part HULL, in feet with four decimals, x aft from AP.
#[must_use]
pub fn write(table: &OffsetTable) -> String {
    let title: String = table.name.chars().filter(|c| !c.is_control()).take(58).collect();
    let mut text =
        format!("{}\n", if title.trim().is_empty() || title.starts_with('*') { "HULL" } else { title.trim() });
    if let Some(length) = table.stated.length_between_perpendiculars {
        let _ = writeln!(text, "L:{:.4}", length / FOOT);
    }
    if let Some(breadth) = table.stated.breadth {
        let _ = writeln!(text, "W:{:.4}", breadth / FOOT);
    }
    text.push_str("P:M\nN:1\nOL:After perpendicular\nOT:Centerplane\nOV:Baseline\n*\nHULL\n");
    // x grows aft: the foremost section comes first.
    let sections: Vec<(f64, Vec<OutlinePoint>)> = table
        .stations
        .iter()
        .rev()
        .filter_map(|station| {
            let mut line = line_of(station, &table.waterlines)?;
            // A section begins on the centreplane; one of a grid may begin at the edge of a flat bottom, or at its
            // lowest waterline.
            if station.outlines.is_empty() && line[0].y > 0.0 {
                line.insert(0, point(0.0, line[0].z));
            }
            if let (Some(last), Some(z)) = (line.last().copied(), station.deck_centre_height)
                && last.y > 0.0
            {
                line.push(point(0.0, z));
            }
            Some((station.station.x, line))
        })
        .collect();
    let feet = |value: f64| format!("{:.4}", value / FOOT + 0.0);
    let _ = writeln!(text, "{}", sections.len());
    for (x, line) in &sections {
        let _ = writeln!(text, "{},{}", feet(0.0 - x), line.len());
        for p in line {
            let _ = writeln!(text, "{},{}", feet(p.y), feet(p.z));
        }
    }
    text.push_str("0,0,0\n**\nHULL.C\n0\n1\n0,0,0\nHULL\n***\nHULL\nSEA WATER\n1\n1.025\n0,0,0\n1\nHULL.C\n****\n");
    text
}
