//! PIAS (SARC) hull text: sections of points with a flag.
//!
//! Number of sections; per section x, number of points, and lines `y z flag` from keel to deck. Flag 1 is an ordinary
//! point; any other flag is a knuckle, as far as the public samples (all flags 1) let one tell, and is noted. Written
//! with four decimals, knuckles with flag 2.

use super::fields::{Separator, TextLine, lines};
use super::outline::line_of;
use super::problem::{FilePosition, Problems};
use super::sections::{Body, Section, XOrigin, refuse_negative, table};
use super::{ReadTable, TableProblem};
use crate::hull::{Marks, OffsetTable, OutlinePoint, StatedParticulars};
use crate::units::counted;
use std::fmt::Write as _;

/// Whether this is a PIAS hull: three lines of one number, then lines of three of which the last is whole.
pub(super) fn recognise(_name: &str, text: &str) -> bool {
    let rows: Vec<Vec<&str>> = text
        .lines()
        .filter(|line| !line.trim().is_empty())
        .take(4)
        .map(|line| line.split_whitespace().collect())
        .collect();
    let whole = |text: &str| text.parse::<u32>().is_ok();
    let [count, x, points, first] = &rows[..] else { return false };
    count.len() == 1
        && whole(count[0])
        && x.len() == 1
        && points.len() == 1
        && whole(points[0])
        && first.len() == 3
        && first[2].parse::<i32>().is_ok()
}

/// Reads a PIAS hull.
///
/// # Errors
/// Every problem of the file.
pub(super) fn read(name: &str, text: &str) -> Result<ReadTable, Vec<TableProblem>> {
    let mut problems = Problems::new(name);
    let rows: Vec<TextLine<'_>> =
        lines(text, Separator::Blank).into_iter().filter(|line| !line.fields.is_empty()).collect();
    let announced = rows.first().and_then(|line| problems.count(line.fields[0], "the number of sections", 1));
    let mut sections: Vec<Section> = Vec::new();
    let mut knuckles = 0;
    let mut index = 1;
    while let Some(head) = rows.get(index) {
        let place = FilePosition::row(head.row);
        let ([x], Some([count])) = (&head.fields[..], rows.get(index + 1).map(|line| &line.fields[..])) else {
            let message =
                format!("section {}: a line with x and one with the number of points expected", sections.len() + 1);
            problems.error("E326", (place, head.text), message, "Is a line missing before it?");
            // On to the next line of one number.
            index += 1;
            while rows.get(index).is_some_and(|line| line.fields.len() != 1) {
                index += 1;
            }
            continue;
        };
        let x = problems.length(*x, "x of the section");
        let count = problems.count(*count, "the number of points", 1);
        index += 2;
        let mut points = Vec::new();
        let mut found = 0;
        while let Some(line) = rows.get(index).filter(|line| line.fields.len() > 1) {
            index += 1;
            found += 1;
            let [y, z, flag] = line.fields[..] else {
                let message = "a point is y, z and a flag".to_owned();
                problems.error("E322", (FilePosition::row(line.row), line.text), message, "Write three numbers.");
                continue;
            };
            let (y, z) = (problems.length(y, "y"), problems.length(z, "z"));
            let flag = problems.number(flag, "the flag");
            if let (Some(y), Some(z), Some(flag)) = (y, z, flag) {
                let knuckle = (flag - 1.0).abs() > 0.5;
                knuckles += usize::from(knuckle);
                points.push(OutlinePoint { y, z, marks: Marks { knuckle, ..Marks::default() } });
            }
        }
        if let Some(count) = count.filter(|&count| count != found) {
            let message = format!("the section announces {}, {found} there", counted(count, "point"));
            problems.error("E322", (place, head.text), message, "Correct the count, or the points.");
        }
        let x = x.unwrap_or(0.0);
        refuse_negative(&mut points, x, place, &mut problems);
        sections.push(Section { name: None, x, place, branches: vec![points], deck: None });
    }
    if let Some(announced) = announced.filter(|&n| n != sections.len()) {
        let message = format!("the file announces {}, {} there", counted(announced, "section"), sections.len());
        problems.error(
            "E322",
            (FilePosition::row(1), rows[0].text),
            message,
            "Correct the count; was the file cut off?",
        );
    }
    if knuckles > 0 {
        let message = format!("{} with a flag other than 1: read as knuckles", counted(knuckles, "point"));
        problems.warning("W334", FilePosition::FILE, message, "");
    }
    let stated = StatedParticulars::default();
    table(Body { name: String::new(), stated, sections, origin: XOrigin::Unknown, unit: 1.0 }, problems)
}

/// Writes sections from keel to deck.
#[must_use]
pub fn write(table: &OffsetTable) -> String {
    let sections: Vec<(f64, Vec<OutlinePoint>)> = table
        .stations
        .iter()
        .filter_map(|station| Some((station.station.x, line_of(station, &table.waterlines)?)))
        .collect();
    let mut text = format!("{:6}\n", sections.len());
    for (x, line) in &sections {
        let _ = writeln!(text, "{x:8.4}\n{:6}", line.len());
        for p in line {
            let _ = writeln!(text, "{:8.4} {:8.4} {:5}", p.y, p.z, if p.marks.knuckle { 2 } else { 1 });
        }
    }
    text
}
