//! Text imports of FREE!ship: the precision in the first line, then lines `x y z`, with blank lines between the curves,
//! and perhaps a line `EOF`.
//!
//! Curves of constant x are sections from keel to deck ("round hull"). Otherwise they are chines, keel first and sheer
//! last: each becomes a knuckle of the table, and sections stand at every x of their points, straight between the
//! chines, the chines straight between their points. Round hulls are written with five decimals.

use super::fields::{Separator, TextLine, finish, lines};
use super::outline::{line_of, point};
use super::problem::{FilePosition, Problems};
use super::sections::{Body, Section, XOrigin, refuse_negative, table};
use super::{ReadTable, TableProblem};
use crate::hull::{FeatureLine, LineKind, Marks, OffsetTable, OutlinePoint, StatedParticulars};
use std::fmt::Write as _;

/// Points of one curve are at one x when they are so near \[m\].
const SAME_X: f64 = 1e-6;

/// More chines or points on them are no hull; sections grow with the product.
const MOST_CHINES: usize = 100;
const MOST_POINTS: usize = 5000;

/// Whether this is such a text: a whole number alone, then lines of three numbers.
pub(super) fn recognise(_name: &str, text: &str) -> bool {
    let mut rows = text.lines().map(str::trim).filter(|line| !line.is_empty());
    let precision = rows.next().is_some_and(|line| line.parse::<u8>().is_ok_and(|n| n <= 9));
    let second = rows.next().map(|line| line.split_whitespace().collect::<Vec<_>>()).unwrap_or_default();
    precision && second.len() == 3 && second.iter().all(|word| super::fields::plain_number(word).is_some())
}

/// Reads a round hull or chines.
///
/// # Errors
/// Every problem of the file.
pub(super) fn read(name: &str, text: &str) -> Result<ReadTable, Vec<TableProblem>> {
    let mut problems = Problems::new(name);
    let rows = lines(text, Separator::Blank);
    let curves = curves(&rows, &mut problems);
    if problems.any_errors() {
        return finish(problems, None);
    }
    let flat = |curve: &&Curve| curve.points.iter().all(|p| (p[0] - curve.points[0][0]).abs() <= SAME_X);
    let sections: Vec<&Curve> = curves.iter().filter(flat).collect();
    if sections.len() == curves.len() {
        return round_hull(&curves, problems);
    }
    if 2 * sections.len() > curves.len() {
        for curve in curves.iter().filter(|curve| !flat(curve)) {
            let (low, high) = range(curve);
            let message = format!("the section runs from x = {low} to {high} m; the others stand at one x each");
            problems.error(
                "E323",
                FilePosition::row(curve.row),
                message,
                "Is a blank line missing, or a number wrong?",
            );
        }
        return finish(problems, None);
    }
    chines(&curves, problems)
}

/// Points up to a blank line.
struct Curve {
    row: usize,
    points: Vec<[f64; 3]>,
}

fn range(curve: &Curve) -> (f64, f64) {
    curve.points.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), p| (a.min(p[0]), b.max(p[0])))
}

fn curves(rows: &[TextLine<'_>], problems: &mut Problems) -> Vec<Curve> {
    let mut curves: Vec<Curve> = Vec::new();
    let mut open = false;
    let mut lines = rows.iter().skip_while(|line| line.fields.is_empty());
    match lines.next() {
        Some(line) if line.fields.len() == 1 => {
            problems.count(line.fields[0], "the precision", 0);
        }
        other => {
            let (row, text) = other.map_or((1, ""), |line| (line.row, line.text));
            let message = "the first line is the precision, one whole number".to_owned();
            problems.error("E326", (FilePosition::row(row), text), message, "Write 0.");
        }
    }
    // The program's own files end with a line EOF.
    for line in lines.take_while(|line| line.text != "EOF") {
        if line.fields.is_empty() {
            open = false;
            continue;
        }
        let [x, y, z] = line.fields[..] else {
            let message = format!("{} fields; a point is x, y, z", line.fields.len());
            problems.error("E326", (FilePosition::row(line.row), line.text), message, "Write three numbers.");
            continue;
        };
        if !open {
            curves.push(Curve { row: line.row, points: Vec::new() });
            open = true;
        }
        let point = (problems.length(x, "x"), problems.length(y, "y"), problems.length(z, "z"));
        if let ((Some(x), Some(y), Some(z)), Some(curve)) = (point, curves.last_mut()) {
            curve.points.push([x, y, z]);
        }
    }
    if curves.is_empty() && !problems.any_errors() {
        problems.error("E328", FilePosition::FILE, "the file has no points".to_owned(), "");
    }
    curves
}

fn body(sections: Vec<Section>) -> Body {
    let stated = StatedParticulars::default();
    Body { name: String::new(), stated, sections, origin: XOrigin::Unknown, unit: 1.0 }
}

fn round_hull(curves: &[Curve], mut problems: Problems) -> Result<ReadTable, Vec<TableProblem>> {
    let mut sections = Vec::new();
    for curve in curves {
        let (x, place) = (curve.points[0][0], FilePosition::row(curve.row));
        let mut points: Vec<OutlinePoint> = curve.points.iter().map(|p| point(p[1], p[2])).collect();
        refuse_negative(&mut points, x, place, &mut problems);
        sections.push(Section { name: None, x, place, branches: vec![points], deck: None });
    }
    table(body(sections), problems)
}

fn chines(curves: &[Curve], mut problems: Problems) -> Result<ReadTable, Vec<TableProblem>> {
    let count: usize = curves.iter().map(|curve| curve.points.len()).sum();
    if curves.len() > MOST_CHINES || count > MOST_POINTS {
        let message = format!("{} chines with {count} points; at most {MOST_CHINES} and {MOST_POINTS}", curves.len());
        problems.error("E312", FilePosition::FILE, message, "Are these sections, with x that varies?");
    }
    let mut lines: Vec<FeatureLine> = Vec::new();
    for (k, curve) in curves.iter().enumerate() {
        let place = FilePosition::row(curve.row);
        let mut points = curve.points.clone();
        let mut plane: Vec<OutlinePoint> = points.iter().map(|p| point(p[1], p[2])).collect();
        refuse_negative(&mut plane, points[0][0], place, &mut problems);
        points.iter_mut().zip(&plane).for_each(|(p, flat)| p[1] = flat.y);
        if points[0][0] > points[points.len() - 1][0] {
            points.reverse();
        }
        if let Some(pair) = points.windows(2).find(|pair| pair[1][0] < pair[0][0]) {
            let message = format!("chine {}: x = {} m after {} m", k + 1, pair[1][0], pair[0][0]);
            problems.error("E323", place, message, "Points of a chine run along the ship.");
        }
        lines.push(FeatureLine { name: format!("chine {}", k + 1), kind: LineKind::Knuckle, points });
    }
    if problems.any_errors() {
        return finish(problems, None);
    }
    let mut positions: Vec<f64> = curves.iter().flat_map(|curve| &curve.points).map(|p| p[0]).collect();
    positions.sort_by(f64::total_cmp);
    positions.dedup_by(|a, b| (*a - *b).abs() <= SAME_X);
    let sections: Vec<Section> = positions
        .into_iter()
        .filter_map(|x| {
            let last = lines.len() - 1;
            let points: Vec<OutlinePoint> = lines
                .iter()
                .enumerate()
                .filter_map(|(k, line)| {
                    let [y, z] = at(&line.points, x)?;
                    let marks = Marks { knuckle: k > 0 && k < last, ..Marks::default() };
                    Some(OutlinePoint { y, z, marks })
                })
                .collect();
            (points.len() > 1).then(|| Section {
                name: None,
                x,
                place: FilePosition::FILE,
                branches: vec![points],
                deck: None,
            })
        })
        .collect();
    let message =
        format!("{} chines: sections at {} x are made of straight lines between them", lines.len(), sections.len());
    problems.warning("W334", FilePosition::FILE, message, "");
    let first = sections.first().map_or(0.0, |section| section.x);
    let mut read = table(body(sections), problems)?;
    // The table may have been moved to AP; its lines move with it.
    let shift = read.table.stations.first().map_or(0.0, |station| station.station.x - first);
    for line in &mut lines {
        line.points.iter_mut().for_each(|p| p[0] += shift);
    }
    read.table.lines = lines;
    Ok(read)
}

/// y and z of a chine at x, straight between its points.
fn at(points: &[[f64; 3]], x: f64) -> Option<[f64; 2]> {
    let near = points.iter().find(|p| (p[0] - x).abs() <= SAME_X);
    if let Some(p) = near {
        return Some([p[1], p[2]]);
    }
    points.windows(2).find(|pair| pair[0][0] < x && x < pair[1][0]).map(|pair| {
        let t = (x - pair[0][0]) / (pair[1][0] - pair[0][0]);
        [pair[0][1] + t * (pair[1][1] - pair[0][1]), pair[0][2] + t * (pair[1][2] - pair[0][2])]
    })
}

/// Writes a round hull.
#[must_use]
pub fn write(table: &OffsetTable) -> String {
    let mut text = "0\n".to_owned();
    let mut between = "";
    for station in &table.stations {
        let Some(line) = line_of(station, &table.waterlines) else { continue };
        text.push_str(between);
        between = "\n";
        for p in &line {
            let _ = writeln!(text, "{:16.5} {:15.5} {:15.5}", station.station.x, p.y, p.z);
        }
    }
    text
}
