//! Geometry of PDSTRIP (Soeding, Bertram): sections below the still waterline.
//!
//! `sections symmetric draught`; per section `x points gaps ...`, the list of y and the list of z, each from a new line
//! and over as many as it needs. The waterline end of a section comes last; z is that of the file. Sections of an
//! unsymmetric body are cut at the centreplane and the half of y > 0 is taken. A gap after a point is where a new
//! branch begins. Written with four decimals, seven numbers a line.

use super::fields::{Separator, TextLine, finish, lines};
use super::outline::{point, section_of};
use super::problem::{Field, FilePosition, Problems};
use super::sections::{Body, Section, XOrigin, note_asymmetry, refuse_negative, starboard_of, table};
use super::{ReadTable, TableProblem};
use crate::hull::{OffsetTable, OutlinePoint, StatedParticulars};
use crate::units::counted;
use std::collections::BTreeSet;
use std::fmt::Write as _;

/// A logical value as FORTRAN reads it.
fn logical(text: &str) -> Option<bool> {
    match text.trim_matches('.').to_ascii_lowercase().as_str() {
        "t" | "true" => Some(true),
        "f" | "false" => Some(false),
        _ => None,
    }
}

/// Whether this is a PDSTRIP geometry: its first line is a count, a logical value and a number.
pub(super) fn recognise(_name: &str, text: &str) -> bool {
    let Some(first) = text.lines().find(|line| !line.trim().is_empty()) else { return false };
    let fields: Vec<&str> = first.split_whitespace().collect();
    fields.len() == 3 && fields[0].parse::<u32>().is_ok() && logical(fields[1]).is_some()
}

/// Reads a PDSTRIP geometry.
///
/// # Errors
/// Every problem of the file.
pub(super) fn read(name: &str, text: &str) -> Result<ReadTable, Vec<TableProblem>> {
    let mut problems = Problems::new(name);
    let rows: Vec<TextLine<'_>> =
        lines(text, Separator::Blank).into_iter().filter(|line| !line.fields.is_empty()).collect();
    let Some([count, symmetric, draught]) = rows.first().map(|line| &line.fields[..]) else {
        let message = "the first line is number of sections, t or f for symmetric, and draught".to_owned();
        problems.error(
            "E326",
            (FilePosition::row(1), rows.first().map_or("", |l| l.text)),
            message,
            "Write for example '19 t 0.96'.",
        );
        return finish(problems, None);
    };
    let announced = problems.count(*count, "the number of sections", 1);
    let symmetric = logical(symmetric.text).unwrap_or(true);
    let draught = problems.number(*draught, "the draught");
    let mut sections: Vec<Section> = Vec::new();
    let mut gaps = Vec::new();
    let mut index = 1;
    while index < rows.len() {
        let Some((x, place, mut branches)) = section(&rows, &mut index, sections.len() + 1, &mut problems) else {
            break;
        };
        let branches = if symmetric {
            branches.iter_mut().for_each(|points| refuse_negative(points, x, place, &mut problems));
            branches
        } else {
            let whole: Vec<OutlinePoint> = branches.into_iter().flatten().collect();
            match starboard_of(&whole) {
                Some((branches, gap)) => {
                    gaps.push((gap, x));
                    branches
                }
                None => {
                    let message = format!("section at x = {x}: both sides expected, as the body is not symmetric");
                    problems.error("E328", place, message, "Write t in the first line if one side is given.");
                    Vec::new()
                }
            }
        };
        sections.push(Section { name: None, x, place, branches, deck: None });
    }
    if let Some(announced) = announced.filter(|&n| n != sections.len() && !problems.any_errors()) {
        let message = format!("the file announces {}, {} there", counted(announced, "section"), sections.len());
        problems.error("E322", count, message, "Correct the count; was the file cut off?");
    }
    note_asymmetry(&gaps, "starboard", &mut problems);
    let stated = StatedParticulars { draught: draught.filter(|t| *t > 0.0), ..StatedParticulars::default() };
    table(Body { name: String::new(), stated, sections, origin: XOrigin::Unknown, unit: 1.0 }, problems)
}

/// One section; none where the rest of the file cannot be told apart.
fn section(
    rows: &[TextLine<'_>],
    index: &mut usize,
    number: usize,
    problems: &mut Problems,
) -> Option<(f64, FilePosition, Vec<Vec<OutlinePoint>>)> {
    let head = &rows[*index];
    let place = FilePosition::row(head.row);
    *index += 1;
    let [x, count, gap_count, gaps @ ..] = &head.fields[..] else {
        let message = format!("section {number}: x, number of points and number of gaps expected");
        problems.error("E326", (place, head.text), message, "Is the number of points of the section before it right?");
        return None;
    };
    let x = problems.length(*x, "x of the section").unwrap_or(0.0);
    let count = problems.count(*count, &format!("the number of points of section {number}"), 1)?;
    let gap_count = problems.count(*gap_count, "the number of gaps", 0)?;
    if gap_count != gaps.len() {
        let message = format!("{gap_count} gaps announced, {} given", gaps.len());
        problems.error("E322", (place, head.text), message, "Write the numbers of the points before the gaps, or 0.");
        return None;
    }
    let gaps: BTreeSet<usize> =
        gaps.iter().filter_map(|field| problems.count(*field, "the number of the point before a gap", 1)).collect();
    let ys = list(rows, index, count, "y", head, problems)?;
    let zs = list(rows, index, count, "z", head, problems)?;
    let mut branches: Vec<Vec<OutlinePoint>> = vec![Vec::new()];
    for (i, (y, z)) in ys.into_iter().zip(zs).enumerate() {
        if let (Some(y), Some(z), Some(branch)) =
            (problems.length(y, "y"), problems.length(z, "z"), branches.last_mut())
        {
            branch.push(point(y, z));
        }
        if gaps.contains(&(i + 1)) && i + 1 < count {
            branches.push(Vec::new());
        }
    }
    Some((x, place, branches))
}

/// The fields of as many lines as the list needs; it ends with a line.
fn list<'a>(
    rows: &[TextLine<'a>],
    index: &mut usize,
    count: usize,
    what: &str,
    head: &TextLine<'_>,
    problems: &mut Problems,
) -> Option<Vec<Field<&'a str>>> {
    let mut fields: Vec<Field<&'a str>> = Vec::new();
    let mut row = head.row;
    while fields.len() < count {
        let Some(line) = rows.get(*index) else {
            let message =
                format!("the file ends after {} of {count} {what} of the section in row {}", fields.len(), head.row);
            problems.error("E322", FilePosition::row(row), message, "Is the count right, or was the file cut off?");
            return None;
        };
        row = line.row;
        fields.extend(&line.fields);
        *index += 1;
    }
    if fields.len() > count {
        let message = format!(
            "{} announced in row {}, the lines of {what} hold {}",
            counted(count, "point"),
            head.row,
            fields.len()
        );
        problems.error(
            "E322",
            (FilePosition::row(row), fields[count].text),
            message,
            "Correct the count, or the line.",
        );
        return None;
    }
    Some(fields)
}

/// Writes the sections up to the stated draught; whole sections where none is stated.
///
/// The draught in the first line is the stated one, or the highest point. Branches are separated by gaps.
#[must_use]
pub fn write(table: &OffsetTable) -> String {
    let draught = table.stated.draught;
    let mut highest = f64::NEG_INFINITY;
    let mut sections: Vec<(f64, Vec<Vec<OutlinePoint>>)> = Vec::new();
    for station in &table.stations {
        let mut branches = section_of(station, &table.waterlines);
        if let Some(draught) = draught {
            branches = branches.iter().flat_map(|branch| below(branch, draught)).collect();
        }
        branches.retain(|branch| branch.len() > 1);
        if !branches.is_empty() {
            highest = branches.iter().flatten().map(|p| p.z).fold(highest, f64::max);
            sections.push((station.station.x, branches));
        }
    }
    let draught = draught.unwrap_or(if highest.is_finite() { highest } else { 0.0 });
    let mut text = format!("{} t {draught:.4}\n", sections.len());
    for (x, branches) in &sections {
        let all: Vec<&OutlinePoint> = branches.iter().flatten().collect();
        let ends = branches.iter().scan(0, |sum, branch| {
            *sum += branch.len();
            Some(*sum)
        });
        let gaps: Vec<String> = ends.take(branches.len() - 1).map(|end| end.to_string()).collect();
        let _ = write!(text, "{x:.4} {} {}", all.len(), gaps.len());
        gaps.iter().for_each(|gap| {
            let _ = write!(text, " {gap}");
        });
        text.push('\n');
        for value in [|p: &OutlinePoint| p.y, |p: &OutlinePoint| p.z] {
            for row in all.chunks(7) {
                row.iter().for_each(|p| {
                    let _ = write!(text, " {:10.4}", value(p));
                });
                text.push('\n');
            }
        }
    }
    text
}

/// The parts of a line of points at and below a height, with points where it crosses.
fn below(branch: &[OutlinePoint], height: f64) -> Vec<Vec<OutlinePoint>> {
    let mut parts: Vec<Vec<OutlinePoint>> = vec![Vec::new()];
    for (i, &p) in branch.iter().enumerate() {
        let inside = p.z <= height;
        if let Some(&before) = i.checked_sub(1).and_then(|k| branch.get(k))
            && (before.z <= height) != inside
        {
            let t = (height - before.z) / (p.z - before.z);
            let crossing = point(before.y + t * (p.y - before.y), height);
            if inside {
                parts.push(Vec::new());
            }
            if let Some(part) = parts.last_mut()
                && part.last().is_none_or(|last| (last.z - height).abs() > 1e-12)
            {
                part.push(crossing);
            }
        }
        if let Some(part) = parts.last_mut().filter(|_| inside) {
            part.push(p);
        }
    }
    parts.retain(|part| !part.is_empty());
    parts
}
