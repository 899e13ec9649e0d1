//! Hull files of SEAWAY (Journee): version, title, `draught trim Lpp x` with x the distance of AP from the aftmost
//! section, number of intervals and intervals, a code, then per section `station n knuckle` and n + 1 pairs `z y`, z
//! first; at the end three factors for x, y and z and a line of stars.
//!
//! x is given from AP by the file. Read only: the code and the knuckle of a section are not documented publicly.

use super::fields::{Separator, finish, lines};
use super::outline::point;
use super::problem::{Field, FilePosition, Problems};
use super::sections::{Body, Section, XOrigin, refuse_negative, table};
use super::{ReadTable, TableProblem};
use crate::hull::StatedParticulars;
use crate::units::counted;

/// Whether this is a SEAWAY hull file.
pub(super) fn recognise(name: &str, text: &str) -> bool {
    let number = |text: &str| super::fields::plain_number(text).is_some();
    let rows: Vec<Vec<&str>> = text.lines().take(4).map(|line| line.split_whitespace().collect()).collect();
    let shaped = matches!(&rows[..], [version, title, main, count]
        if version.len() == 1 && number(version[0]) && title.iter().any(|word| !number(word))
            && main.len() == 4 && main.iter().all(|word| number(word))
            && count.len() == 1 && count[0].parse::<u32>().is_ok());
    shaped || name.to_ascii_lowercase().ends_with(".seaway")
}

/// The fields of a text one after another.
struct Stream<'a> {
    fields: Vec<Field<&'a str>>,
    next: usize,
    last: FilePosition,
}

impl<'a> Stream<'a> {
    fn left(&self) -> usize {
        self.fields.len() - self.next
    }

    fn take(&mut self, what: &str, problems: &mut Problems) -> Option<Field<&'a str>> {
        let Some(&field) = self.fields.get(self.next) else {
            let message = format!("the file ends before {what}");
            problems.error("E324", self.last, message, "Is a count before it right, or was the file cut off?");
            return None;
        };
        self.next += 1;
        Some(field)
    }
}

/// Reads a SEAWAY hull file.
///
/// # Errors
/// Every problem of the file; after a count that does not match nothing more can be told apart.
pub(super) fn read(name: &str, text: &str) -> Result<ReadTable, Vec<TableProblem>> {
    let mut problems = Problems::new(name);
    let rows = lines(text, Separator::Blank);
    let title = rows.get(1).map_or("", |line| line.text).to_owned();
    // The line of stars and what follows it is no data.
    let fields: Vec<Field<&str>> = rows
        .iter()
        .skip(2)
        .take_while(|line| !line.text.starts_with('*'))
        .flat_map(|line| line.fields.clone())
        .collect();
    let last = fields.last().map_or(FilePosition::FILE, |field| FilePosition { column: None, ..field.place() });
    let mut stream = Stream { fields, next: 0, last };
    let body = read_body(title, &mut stream, &mut problems);
    if !rows.iter().any(|line| line.text.starts_with('*')) {
        let message = "the file ends without a line of stars".to_owned();
        problems.error("E324", last, message, "Was it cut off? End it with '*** End of file ***'.");
    }
    match body {
        Some(body) => table(body, problems),
        None => finish(problems, None),
    }
}

fn read_body(title: String, stream: &mut Stream<'_>, problems: &mut Problems) -> Option<Body> {
    let mut main = [0.0; 4];
    for (value, what) in
        main.iter_mut().zip(["the draught", "the trim", "Lpp", "the distance of AP from the aftmost section"])
    {
        let field = stream.take(what, problems)?;
        *value = problems.number(field, what)?;
    }
    let [draught, trim, length, from_aft] = main;
    if trim.abs() > 0.0 {
        let message = format!("trim {trim} m is not applied: heights are those of the file");
        problems.warning("W334", FilePosition::row(3), message, "");
    }
    let announced = stream.take("the number of intervals", problems)?;
    let intervals = problems.count(announced, "the number of intervals", 1)?;
    if intervals > stream.left() {
        let message = format!("{intervals} intervals announced, {} numbers follow", stream.left());
        problems.error("E322", announced, message, "Correct the count.");
        return None;
    }
    let mut x = 0.0 - from_aft;
    let mut positions = vec![x];
    for _ in 0..intervals {
        let field = stream.take("the intervals", problems)?;
        x += problems.length(field, "an interval").unwrap_or(0.0);
        positions.push(x);
    }
    let code = stream.take("the code after the intervals", problems)?;
    problems.number(code, "the code after the intervals");
    let mut sections = Vec::new();
    for (i, &x) in positions.iter().enumerate() {
        sections.push(section(i + 1, x, stream, problems)?);
    }
    let mut factors = [1.0; 3];
    for factor in &mut factors {
        let field = stream.take("the three factors at the end", problems)?;
        *factor = problems.number(field, "a factor").unwrap_or(1.0);
    }
    if stream.left() > 0 {
        let field = stream.fields[stream.next];
        let message = format!("{} numbers after the three factors", stream.left());
        problems.error("E322", field, message, "Is the number of intervals right?");
    }
    let [fx, fy, fz] = factors;
    if factors.iter().any(|f| (f - 1.0).abs() > 1e-12) {
        let message = format!("x, y and z are multiplied by {fx}, {fy} and {fz}, as the file asks");
        problems.warning("W334", stream.last, message, "");
        for section in &mut sections {
            section.x *= fx;
            for p in section.branches.iter_mut().flatten() {
                p.y *= fy;
                p.z *= fz;
            }
        }
    }
    let stated = StatedParticulars {
        length_between_perpendiculars: Some(length * fx).filter(|l| *l > 0.0),
        draught: Some(draught * fz).filter(|t| *t > 0.0),
        ..StatedParticulars::default()
    };
    Some(Body { name: title, stated, sections, origin: XOrigin::AfterPerpendicular, unit: 1.0 })
}

fn section(number: usize, x: f64, stream: &mut Stream<'_>, problems: &mut Problems) -> Option<Section> {
    let what = format!("section {number}");
    let station = stream.take(&what, problems)?;
    let name = problems.number(station, &format!("{what}: the station"))?;
    let count = stream.take(&what, problems)?;
    let points = 1 + problems.count(count, &format!("{what}: the number of points less one"), 0)?;
    let knuckle = stream.take(&what, problems)?;
    problems.number(knuckle, &format!("{what}: the knuckle"));
    if 2 * points > stream.left() {
        let message =
            format!("{what} announces {}, {} left", counted(points, "point"), counted(stream.left(), "number"));
        problems.error("E322", count, message, "Correct the count; was the file cut off?");
        return None;
    }
    let mut line = Vec::new();
    for _ in 0..points {
        let (z, y) = (stream.take(&what, problems)?, stream.take(&what, problems)?);
        if let (Some(z), Some(y)) = (problems.length(z, "z"), problems.length(y, "y")) {
            line.push(point(y, z));
        }
    }
    let place = FilePosition { column: None, ..station.place() };
    // A section ends with its line: a wrong count does not go unnoticed where the numbers happen to fit.
    if let Some(after) = stream.fields.get(stream.next).filter(|field| field.place().column != Some(1)) {
        let message = format!("{what} announces {}, the last of them within a line", counted(points, "point"));
        problems.error("E322", after, message, "Correct the count, or the points.");
        return None;
    }
    refuse_negative(&mut line, x, place, problems);
    Some(Section { name: Some(format!("{name}")), x, place, branches: vec![line], deck: None })
}
