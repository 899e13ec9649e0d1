//! Single curves as CSV: what `fair-curve` reads, and its `curve.csv` and `fairing.json`.
//!
//! Columns, by their names in the first line or in this order: abscissa (`x`), ordinate (`y`), tolerance, flag; others
//! are not read. Units may stand in the names, `y [mm]`, `area [ft2]`. Cells have the grammar of tables of offsets
//! ([`crate::units::parse_cell`]): feet-inches-eighths, brackets for doubtful ordinates, `?` for one that is to be
//! predicted, marks `K` (knuckle), `T` (tangent point) and `!` (locked) on the ordinate or in the column of flags.
//! Lines that are empty or begin with `#` are passed over.

use serde_json::{Value, json};

use super::fairing::COMPROMISE_LINE;
use super::fault::LARGEST;
use super::number::{cell, json_number, line};
use crate::fairing::curve::{Contradictions, CurvePoint, FairCurve, FairStatus};
use crate::fairing::inflections::Witness;
use crate::units::{CellEntry, CellRules, CellWriting, Notation, parse_cell};

/// Weight of a doubtful ordinate.
const DOUBTFUL: f64 = 0.01;
/// Most points of a curve.
const MOST: usize = 2000;

/// A curve as it was read; lengths in metres.
#[derive(Debug, Clone, PartialEq)]
pub struct CurveTable {
    /// The points with rising abscissae.
    pub points: Vec<CurvePoint>,
    /// Whether ordinates are lengths like abscissae: not in a column that is named `area`.
    pub lengths: bool,
    /// The step in which ordinates are written; 0 where that cannot be told.
    pub quantum: f64,
    /// What was assumed.
    pub notes: Vec<String>,
}

/// What is wrong with a line.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct CurveProblem {
    /// Line from 1; none for the whole file.
    pub line: Option<usize>,
    /// What was found.
    pub message: String,
    /// The remedy; empty when the message says it.
    pub remedy: String,
}

/// A column of numbers.
#[derive(Clone, Copy)]
struct Column {
    at: usize,
    /// The unit of lengths, or of the sides of areas.
    unit: Notation,
    area: bool,
}

impl Column {
    /// The step of numbers with so many decimals \[m or m2\].
    fn quantum(self, decimals: usize) -> Option<f64> {
        let step = if self.area { Notation::Metres } else { self.unit }.quantum(Some(decimals));
        step.map(|step| step * self.factor())
    }

    /// What a number that was read as a length \[m\] is multiplied by.
    fn factor(self) -> f64 {
        if self.area { self.unit.metres(1.0).powi(2) } else { 1.0 }
    }
}

/// Which column holds what.
struct Columns {
    x: Column,
    y: Column,
    tolerance: Option<Column>,
    flag: Option<usize>,
}

/// `y [mm]` as a name and what stands in the brackets.
fn name_and_unit(text: &str) -> (String, Option<String>) {
    let text = text.trim().trim_start_matches('\u{feff}').to_lowercase();
    let at = text.find(['[', '(']);
    let name = at.map_or(text.as_str(), |at| &text[..at]).trim().to_owned();
    (name, at.map(|at| text[at + 1..].trim_end_matches([']', ')', ' ']).trim().to_owned()))
}

/// The unit of a column whose head says one.
fn unit_of(written: Option<&str>, area: bool, name: &str, unit: Notation) -> Result<Notation, CurveProblem> {
    let Some(written) = written.filter(|written| !written.is_empty()) else { return Ok(unit) };
    let sides = written.strip_suffix("^2").or_else(|| written.strip_suffix(['2', '²']));
    let found = if area { sides.and_then(Notation::from_word) } else { Notation::from_word(written) };
    found.filter(|unit| !area || *unit != Notation::FeetInchesEighths).ok_or_else(|| CurveProblem {
        line: Some(1),
        message: format!("'{written}' is no unit of {} in the column {name}", if area { "areas" } else { "lengths" }),
        remedy: if area { "Expected m2, cm2, mm2, ft2 or in2." } else { "Expected m, cm, mm, ft or in." }.to_owned(),
    })
}

fn columns(header: &[String], unit: Notation) -> Result<Columns, CurveProblem> {
    let named: Vec<(String, Option<String>)> = header.iter().map(|text| name_and_unit(text)).collect();
    let find = |names: &[&str]| named.iter().position(|(name, _)| names.contains(&name.as_str()));
    let x = find(&["x", "abscissa", "station", "position"]);
    let y = find(&["y", "ordinate", "offset", "half-breadth", "z", "height", "area", "value"]);
    let (Some(x), Some(y)) = (x, y) else {
        return Err(CurveProblem {
            line: Some(1),
            message: format!("no column x or no column y among {}", header.join(", ")),
            remedy: "Name the columns x,y[,tolerance][,flag].".to_owned(),
        });
    };
    let area = named[y].0 == "area";
    let column = |at: usize, area: bool| {
        let (name, written) = &named[at];
        Ok(Column { at, unit: unit_of(written.as_deref(), area, name, unit)?, area })
    };
    let tolerance = find(&["tolerance", "tol", "band"]);
    Ok(Columns {
        x: column(x, false)?,
        y: column(y, area)?,
        tolerance: tolerance.map(|at| column(at, area)).transpose()?,
        flag: find(&["flag", "flags", "mark", "marks"]),
    })
}

/// Reads a curve; plain numbers without a unit are in `unit`.
///
/// # Errors
/// Every line that cannot be understood.
pub fn read_curve(text: &str, unit: Notation) -> Result<CurveTable, Vec<CurveProblem>> {
    let whole = |message: String| vec![CurveProblem { line: None, message, remedy: String::new() }];
    let sample: Vec<&str> = text.lines().filter(|l| !l.trim().is_empty() && !l.starts_with('#')).take(20).collect();
    let count = |c: char| sample.iter().map(|l| l.matches(c).count()).sum::<usize>();
    let delimiter = if count('\t') >= sample.len().max(1) {
        b'\t'
    } else if count(';') >= sample.len().max(1) {
        b';'
    } else {
        b','
    };
    let decimal_comma = delimiter != b',' && count(',') > 0 && count('.') == 0;
    let mut reader = csv::ReaderBuilder::new()
        .has_headers(false)
        .flexible(true)
        .delimiter(delimiter)
        .comment(Some(b'#'))
        .trim(csv::Trim::All)
        .from_reader(text.as_bytes());
    let (mut layout, mut points, mut problems) = (None, Vec::new(), Vec::new());
    let mut quantum: Option<f64> = None;
    let mut notes = Vec::new();
    for record in reader.records() {
        let record = record.map_err(|error| whole(error.to_string()))?;
        let number = record.position().map(|p| usize::try_from(p.line()).unwrap_or(0));
        let fields: Vec<String> = record.iter().map(str::to_owned).collect();
        if fields.iter().all(String::is_empty) {
            continue;
        }
        let layout = match &layout {
            Some(layout) => layout,
            None => {
                let plain = CellRules { unit, decimal_comma };
                let is_number = parse_cell(&fields[0], plain).is_ok_and(|c| matches!(c.entry, CellEntry::Length(_)));
                let found = if is_number {
                    let letters = |k: usize| {
                        fields.get(k).is_some_and(|f| f.chars().next().is_some_and(|c| c.is_alphabetic() || c == '!'))
                    };
                    let flag = if letters(2) { 2 } else { 3 };
                    let column = |at: usize| Column { at, unit, area: false };
                    Columns { x: column(0), y: column(1), tolerance: (flag == 3).then(|| column(2)), flag: Some(flag) }
                } else {
                    columns(&fields, unit).map_err(|problem| vec![problem])?
                };
                let layout = layout.insert(found);
                if !is_number {
                    continue;
                }
                layout
            }
        };
        match point(&fields, layout, decimal_comma) {
            Ok((point, step)) => {
                if let Some(step) = step {
                    quantum = Some(quantum.map_or(step, |least: f64| least.min(step)));
                }
                points.push((point, number));
            }
            Err((message, remedy)) => problems.push(CurveProblem { line: number, message, remedy }),
        }
        if points.len() > MOST {
            return Err(whole(format!("more than {MOST} points")));
        }
    }
    if !problems.is_empty() {
        return Err(problems);
    }
    if points.windows(2).any(|pair| pair[1].0.x < pair[0].0.x) {
        points.sort_by(|a, b| a.0.x.total_cmp(&b.0.x));
        notes.push("the points were put in the order of rising abscissae".to_owned());
    }
    let double = points.windows(2).filter(|pair| pair[1].0.x <= pair[0].0.x);
    let problems: Vec<CurveProblem> = double
        .map(|pair| CurveProblem {
            line: pair[1].1,
            message: format!("a second point at x = {}", pair[1].0.x),
            remedy: "Keep one of the two.".to_owned(),
        })
        .collect();
    if !problems.is_empty() {
        return Err(problems);
    }
    if points.is_empty() {
        let remedy = "Write one point a line: its x and its y.".to_owned();
        return Err(vec![CurveProblem { line: None, message: "no points".to_owned(), remedy }]);
    }
    Ok(CurveTable {
        points: points.into_iter().map(|(point, _)| point).collect(),
        lengths: layout.is_none_or(|layout| !layout.y.area),
        quantum: quantum.unwrap_or(0.0),
        notes,
    })
}

/// The point of one line, and the step in which its ordinate is written.
fn point(
    fields: &[String],
    layout: &Columns,
    decimal_comma: bool,
) -> Result<(CurvePoint, Option<f64>), (String, String)> {
    let read = |column: Column| {
        let text = fields.get(column.at).map_or("", String::as_str);
        let unit = if column.area { Notation::Metres } else { column.unit };
        let reading = parse_cell(text, CellRules { unit, decimal_comma });
        let mut reading = reading.map_err(|error| (format!("'{text}': {error}"), error.remedy()))?;
        if column.area && !matches!(reading.writing, CellWriting::Plain { .. } | CellWriting::Nothing) {
            let remedy = "Write areas as plain numbers, with their unit in the head: area [ft2].";
            return Err((format!("'{text}' is a length"), remedy.to_owned()));
        }
        if let CellEntry::Length(value) = &mut reading.entry {
            *value *= column.factor();
            if value.is_nan() || value.abs() > LARGEST {
                let remedy = format!("Expected at most {LARGEST:e} m, or m2 of an area.");
                return Err((format!("'{text}' is of no ship"), remedy));
            }
        }
        Ok(reading)
    };
    let x = match read(layout.x)?.entry {
        CellEntry::Length(x) => x,
        _ => return Err(("no abscissa".to_owned(), "Give every point its x.".to_owned())),
    };
    let cell = read(layout.y)?;
    let y = match cell.entry {
        CellEntry::Length(y) => Some(y),
        CellEntry::Unknown => None,
        CellEntry::Absent => {
            return Err(("no ordinate".to_owned(), "Write ? where it is to be predicted.".to_owned()));
        }
    };
    let tolerance = match layout.tolerance {
        Some(column) if fields.get(column.at).is_some_and(|text| !text.is_empty()) => match read(column)?.entry {
            CellEntry::Length(value) if value >= 0.0 => Some(value),
            CellEntry::Length(value) => {
                let remedy = "Expected a length of 0 or more; leave it empty for that of the noise.";
                return Err((format!("the tolerance is {value}"), remedy.to_owned()));
            }
            _ => None,
        },
        _ => None,
    };
    let mut made = CurvePoint {
        x,
        y,
        tolerance,
        weight: if cell.doubtful { DOUBTFUL } else { 1.0 },
        locked: cell.locked,
        knuckle: cell.knuckle,
        tangent: cell.tangent,
    };
    if let Some(text) = layout.flag.and_then(|at| fields.get(at)) {
        for mark in text.chars().filter(|c| !c.is_whitespace()) {
            match mark.to_ascii_uppercase() {
                'K' => made.knuckle = true,
                'T' => made.tangent = true,
                '!' | 'L' => made.locked = true,
                other => {
                    return Err((
                        format!("the flag '{other}'"),
                        "Flags are K (knuckle), T (tangent point), ! (locked).".to_owned(),
                    ));
                }
            }
        }
    }
    let step = match cell.writing {
        CellWriting::Plain { decimals } => layout.y.quantum(decimals),
        CellWriting::Eighths => Notation::FeetInchesEighths.quantum(None),
        CellWriting::WithUnit | CellWriting::Nothing => None,
    };
    Ok((made, step))
}

/// `curve.csv`: the fair curve at the points that were given, in metres, marked where it does not meet all targets; it
/// reads back as a curve.
#[must_use]
pub fn curve_csv(points: &[CurvePoint], fair: &FairCurve) -> String {
    let mut text = String::new();
    if fair.status == FairStatus::Infeasible {
        text.push_str(COMPROMISE_LINE);
        text.push('\n');
    }
    text.push_str("x,y,tolerance,flag,before,move,slope,curvature,status\n");
    for (given, point) in points.iter().zip(&fair.points) {
        let mut flag = String::new();
        for (set, mark) in [(given.knuckle, 'K'), (given.tangent, 'T'), (given.locked, '!')] {
            if set {
                flag.push(mark);
            }
        }
        text.push_str(&line(&[
            cell(Some(point.x)),
            cell(Some(point.after)),
            cell(point.tolerance),
            flag,
            cell(point.before),
            cell(point.moved()),
            cell(Some(point.slope)),
            cell(Some(point.curvature)),
            if point.suspect { "suspect".to_owned() } else { fair.status.as_str().to_owned() },
        ]));
    }
    text
}

fn witness(points: &[CurvePoint], witness: &Witness) -> Value {
    let read: Vec<&CurvePoint> = points.iter().filter(|point| point.y.is_some()).collect();
    let places: Vec<f64> = witness.places.iter().filter_map(|&k| read.get(k).map(|point| point.x)).collect();
    json!({ "bend": witness.bend.as_str(), "x": places, "excess": json_number(Some(witness.excess)) })
}

/// `fairing.json` of a curve. The list of inflections has one entry, the curve, with places, proof and refused numbers.
#[must_use]
pub fn curve_json(points: &[CurvePoint], fair: &FairCurve, found: &Contradictions) -> Value {
    let certificate = &fair.certificate;
    let least = &fair.least;
    let lines: Vec<Value> = fair
        .lines
        .iter()
        .map(|line| {
            json!({
                "kind": line.kind.key(), "target": json_number(Some(line.target)), "before": json_number(Some(line.before)),
                "after": json_number(Some(line.after)), "residual": json_number(Some(line.after - line.target)),
                "multiplier": json_number(Some(line.multiplier)), "price": json_number(Some(line.price)),
            })
        })
        .collect();
    let stretches: Vec<Value> = least
        .stretches
        .iter()
        .map(|stretch| {
            let chains: Vec<Value> = stretch
                .chains
                .iter()
                .map(|chain| {
                    let list: Vec<Value> = chain.witnesses.iter().map(|w| witness(points, w)).collect();
                    json!({ "if_it_begins": chain.first.as_str(), "witnesses": list })
                })
                .collect();
            let places: Vec<Value> = stretch
                .inflections
                .iter()
                .map(|place| json!({ "from": place.from, "to": place.to, "at": place.at }))
                .collect();
            json!({ "lower_bound": stretch.lower_bound, "begins": stretch.first.as_str(), "places": places, "proof": chains })
        })
        .collect();
    let smaller: Vec<Value> = least
        .smaller
        .iter()
        .map(|s| json!({ "inflections": s.count, "least_factor_on_tolerance": json_number(s.factor) }))
        .collect();
    let refused: Vec<Value> =
        fair.refused.iter().map(|r| json!({ "inflections": r.0, "price": json_number(Some(r.1)) })).collect();
    let (rms, max, at) = fair.moves();
    let place = |index: usize| fair.points.get(index).map(|point| point.x);
    let suspects = found.suspects.iter().map(|suspect| {
        json!({
            "x": json_number(place(suspect.index)), "value": json_number(Some(suspect.value)),
            "expected": json_number(Some(suspect.expected)), "score": json_number(Some(suspect.score)),
            "left_out": fair.points.get(suspect.index).is_some_and(|point| point.suspect),
        })
    });
    let suspects: Vec<Value> = suspects.collect();
    let corners = found.corners.iter().map(|corner| {
        let [before, after] = corner.noise.map(|noise| json_number(Some(noise)));
        json!({ "x": json_number(place(corner.index)), "noise_without": before, "noise_with_all": after })
    });
    let corners: Vec<Value> = corners.collect();
    let active: Vec<f64> = fair.points.iter().filter(|point| point.active).map(|point| point.x).collect();
    json!({
        "status": fair.status.as_str(),
        "energy": { "before": json_number(Some(fair.energy[1])), "after": json_number(Some(fair.energy[0])), "order": fair.order },
        "certificate": {
            "primal": json_number(Some(certificate.primal)), "dual": json_number(Some(certificate.dual)),
            "gap": json_number(Some(certificate.gap)), "stationarity": json_number(Some(certificate.stationarity)),
            "max_violation": json_number(Some(certificate.max_violation)),
        },
        "constraints": lines,
        "inflections": { "curve": [{
            "at": fair.inflections[1], "before": fair.inflections[0].len(), "after": fair.inflections[1].len(),
            "minimum": least.count, "certified": least.certified(), "lower_bound": least.lower_bound,
            "allowed": fair.allowed, "price": json_number(Some(fair.price)), "refused": refused, "smaller": smaller,
            "stretches": stretches,
        }] },
        "moves": { "rms": json_number(Some(rms)), "max": json_number(Some(max)), "at": at, "at_tolerance": active },
        "noise": { "sigma": json_number(Some(fair.sigma)) },
        "smoothing": { "weight": json_number(Some(fair.lambda)), "degrees_of_freedom": json_number(Some(fair.freedom)) },
        "widening": json_number(Some(fair.widening)),
        "infeasible": infeasible(fair),
        "suspects": suspects,
        "corners": corners,
        "work": { "solves": fair.work[0], "iterations": fair.work[1], "refreshes": fair.refreshes },
    })
}

/// Why area, centroid and slopes are infeasible: the least factor on the tolerances, and what each alone could be.
fn infeasible(fair: &FairCurve) -> Value {
    let Some(found) = &fair.diagnosis else { return Value::Null };
    let alone = found.reaches.iter().filter_map(|reach| {
        let line = fair.lines.get(reach.constraint)?;
        let [low, high] = reach.values.map_or([None; 2], |ends| ends.map(Some));
        Some(json!({
            "kind": line.kind.key(), "least": json_number(low), "greatest": json_number(high), "target": line.target,
        }))
    });
    json!({
        "widening": json_number(found.widening), "alone": alone.collect::<Vec<Value>>(), "nearest": fair.nearest,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn notations_marks_and_columns() {
        let text = "# a sheer line\nstation [ft]; y [feet-inches-eighths]; tol [mm]; flag\n0;3-4-5!;;\n10;(3-2-0);3;K\n\n20;?;;\n";
        let table = read_curve(text, Notation::Metres).unwrap();
        assert_eq!(table.points.len(), 3);
        assert!((table.points[0].y.unwrap() - 40.625 * 0.0254).abs() < 1e-14 && table.points[0].locked);
        assert!((table.points[1].x - 3.048).abs() < 1e-14 && table.points[1].knuckle);
        assert!((table.points[1].tolerance.unwrap() - 0.003).abs() < 1e-16);
        assert!(table.points[1].weight < 0.1 && table.points[2].y.is_none());
        assert!((table.quantum - 0.0254 / 16.0).abs() < 1e-16);
    }

    #[test]
    fn plain_columns_are_sorted_and_doubles_refused() {
        let table = read_curve("2,1.25\n1,1.50,0.01\n0,2.00,,!\n", Notation::Metres).unwrap();
        assert_eq!(table.points.iter().map(|p| p.x).collect::<Vec<_>>(), [0.0, 1.0, 2.0]);
        assert_eq!((table.points[1].tolerance, table.points[0].locked, table.notes.len()), (Some(0.01), true, 1));
        assert!((table.quantum - 0.01).abs() < 1e-16 && table.lengths);
        assert!(!read_curve("x,area [m2]\n0,1\n1,2\n", Notation::Metres).unwrap().lengths);
        let problems = read_curve("x,y\n0,1\n0,2\n", Notation::Metres).unwrap_err();
        assert_eq!((problems[0].line, problems.len()), (Some(3), 1));
    }

    #[test]
    fn every_bad_line_is_told() {
        let problems =
            read_curve("x,y,tolerance,flag\n0,3-13-1,,\n1,2,-1,\n2,3,,Q\n,4,,\n4,,,\n", Notation::Metres).unwrap_err();
        assert_eq!(problems.iter().map(|p| p.line.unwrap()).collect::<Vec<_>>(), [2, 3, 4, 5, 6]);
        assert!(problems[0].remedy.contains("Did you mean"));
        assert!(read_curve("a,b\n1,2\n", Notation::Metres).unwrap_err()[0].message.contains("no column"));
        assert!(read_curve("", Notation::Metres).is_err());
    }
}
