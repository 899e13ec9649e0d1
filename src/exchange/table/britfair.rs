//! BRITFAIR offsets (`.bri`): sections of points, each with its count and x and closed by `0`.
//!
//! Name; number of hulls; per section `n x x` and n lines `y z`, then `0`; at the end `0 0 0`. A section that gives
//! both sides is cut at the centreplane and its starboard (y > 0) half is taken. Written with six decimals.

use super::fields::{Separator, TextLine, lines};
use super::outline::{line_of, point};
use super::problem::{FilePosition, Problems};
use super::sections::{Body, Section, XOrigin, note_asymmetry, starboard_of, table};
use super::{ReadTable, TableProblem};
use crate::hull::{OffsetTable, OutlinePoint, StatedParticulars};
use crate::units::counted;
use std::fmt::Write as _;

/// Whether this is a BRITFAIR file: its third line is `n x x` with equal x.
pub(super) fn recognise(name: &str, text: &str) -> bool {
    let mut rows = text.lines().map(str::trim).filter(|line| !line.is_empty()).skip(1);
    let one = rows.next().is_some_and(|line| line.parse::<u32>().is_ok());
    let head = rows.next().is_some_and(|line| {
        let fields: Vec<&str> = line.split_whitespace().collect();
        fields.len() == 3 && fields[1] == fields[2] && fields[0].parse::<u32>().is_ok_and(|n| n > 0)
    });
    name.to_ascii_lowercase().ends_with(".bri") || (one && head)
}

/// Reads a BRITFAIR file.
///
/// # Errors
/// Every problem of the file.
pub(super) fn read(name: &str, text: &str) -> Result<ReadTable, Vec<TableProblem>> {
    let mut problems = Problems::new(name);
    let rows: Vec<TextLine<'_>> =
        lines(text, Separator::Blank).into_iter().filter(|line| !line.fields.is_empty()).collect();
    let title = rows.first().map_or("", |line| line.text);
    match rows.get(1) {
        Some(line) if line.fields.len() == 1 => {
            if problems.count(line.fields[0], "the number of hulls", 1).is_some_and(|n| n > 1) {
                let message = format!("{} hulls; the first is read", line.text);
                problems.warning("W332", FilePosition::row(line.row), message, "");
            }
        }
        Some(line) => {
            let message = "the second line is the number of hulls".to_owned();
            problems.error("E326", (FilePosition::row(line.row), line.text), message, "Write 1.");
        }
        None => {
            let message = "the file ends after its name".to_owned();
            problems.error("E324", FilePosition::FILE, message, "Was it cut off?");
        }
    }
    let mut sections: Vec<Section> = Vec::new();
    let mut gaps = Vec::new();
    let mut index = 2;
    let mut ended = false;
    while let Some(head) = rows.get(index) {
        index += 1;
        let place = FilePosition::row(head.row);
        let [count, x, repeated] = head.fields[..] else {
            let message = "a section begins with its number of points and x twice".to_owned();
            problems.error(
                "E326",
                (place, head.text),
                message,
                "Is the number of points of the section before it right?",
            );
            // On to the next line of three.
            while rows.get(index).is_some_and(|line| line.fields.len() != 3) {
                index += 1;
            }
            continue;
        };
        let zero =
            head.fields.iter().all(|field| super::fields::plain_number(field.text).is_some_and(|v| v.abs() < 1e-12));
        if zero {
            ended = true;
            break;
        }
        let count = problems.count(count, "the number of points", 1);
        let at = problems.length(x, "x");
        if let (Some(a), Some(b)) = (at, problems.length(repeated, "x"))
            && (a - b).abs() > 1e-9
        {
            problems.warning(
                "W334",
                repeated.place(),
                format!("x is written as {a} and as {b}; the first is taken"),
                "",
            );
        }
        let mut points = points(&rows, &mut index, count, head, &mut problems);
        let x = at.unwrap_or(0.0);
        let both = points.iter().any(|p| p.y < -1e-9) && points.iter().any(|p| p.y > 1e-9);
        let branches = if both {
            let (branches, gap) = starboard_of(&points).unwrap_or_default();
            gaps.push((gap, x));
            branches
        } else {
            super::sections::refuse_negative(&mut points, x, place, &mut problems);
            vec![points]
        };
        sections.push(Section { name: None, x, place, branches, deck: None });
    }
    if !ended {
        let message = "the file ends without '0 0 0'".to_owned();
        problems.error("E324", FilePosition::FILE, message, "Was it cut off? End it with a line '0 0 0'.");
    } else if let Some(line) = rows.get(index) {
        let message = format!("what follows '0 0 0', {} lines, is not read", rows.len() - index);
        problems.warning("W332", FilePosition::row(line.row), message, "");
    }
    note_asymmetry(&gaps, "starboard", &mut problems);
    let stated = StatedParticulars::default();
    table(Body { name: title.to_owned(), stated, sections, origin: XOrigin::Unknown, unit: 1.0 }, problems)
}

/// The lines `y z` up to the `0`.
fn points(
    rows: &[TextLine<'_>],
    index: &mut usize,
    count: Option<usize>,
    head: &TextLine<'_>,
    problems: &mut Problems,
) -> Vec<OutlinePoint> {
    let mut points = Vec::new();
    let mut found = 0;
    while let Some([y, z]) = rows.get(*index).map(|line| &line.fields[..]) {
        *index += 1;
        found += 1;
        if let (Some(y), Some(z)) = (problems.length(*y, "y"), problems.length(*z, "z")) {
            points.push(point(y, z));
        }
    }
    if let Some(count) = count.filter(|&count| count != found) {
        let message = format!("the section announces {}, {found} there", counted(count, "point"));
        problems.error("E322", (FilePosition::row(head.row), head.text), message, "Correct the count, or the points.");
    }
    match rows.get(*index).map(|line| (&line.fields[..], line.row)) {
        Some(([zero], _)) if super::fields::plain_number(zero.text).is_some_and(|v| v.abs() < 1e-12) => *index += 1,
        other => {
            let place = other.map_or(FilePosition::row(head.row), |(_, row)| FilePosition::row(row));
            let message = format!("'0' should end the section of row {}", head.row);
            problems.error("E324", place, message, "Put a line '0' after its last point.");
            if other.is_some_and(|(fields, _)| fields.len() == 1) {
                *index += 1;
            }
        }
    }
    points
}

/// Writes sections from keel to deck.
#[must_use]
pub fn write(table: &OffsetTable) -> String {
    let title: String = table.name.chars().filter(|c| !c.is_control()).collect();
    let mut text = format!("{}\n1\n", if title.trim().is_empty() { "hull" } else { title.trim() });
    for station in &table.stations {
        let Some(line) = line_of(station, &table.waterlines) else { continue };
        let x = station.station.x;
        let _ = writeln!(text, "{} {x:.6} {x:.6}", line.len());
        for p in &line {
            let _ = writeln!(text, "{:.6} {:.6}", p.y, p.z);
        }
        text.push_str("0\n");
    }
    text.push_str("0 0 0\n");
    text
}
