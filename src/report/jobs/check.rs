//! Checking a table of offsets: suspects and problems, on the terminal, as JSON, as a picture, and accepted one by one.

use std::path::Path;

use serde_json::{Value, json};

use crate::config::{self, Diagnostic};
use crate::exchange::{self, TableProblem, TableWriting, write_table};
use crate::fairing::{
    Hypothesis, PointNumber, PointSuspect, PointSuspects, ProposedLine, Reading, Suspect, Suspects, height_suspects,
    point_suspects, proposed_lines, suspects,
};
use crate::hull::{Cell, Entry, OffsetTable, TableForm, Written};
use crate::plot::{suspect_heights_figure, suspect_points_figure, suspects_figure};
use crate::report::failure::Failure;
use crate::report::input::source::{Overrides, read_table_file_with};
use crate::report::output::files::OutputFile;
use crate::report::words::lengths;
use crate::report::words::remarks::is_warning;
use crate::units::{Notation, counted};

/// Resolution of the picture \[dots per inch\].
const DOTS_PER_INCH: f64 = 160.0;
/// Hypotheses that the page names for each suspect.
const NAMED: usize = 3;
/// Hypotheses less probable than this are not named.
const LEAST_NAMED: f64 = 0.005;

/// Warnings that say how a file was read, not that a cell is wrong.
const ABOUT_READING: [&str; 6] = ["W312", "W320", "W330", "W331", "W332", "W334"];

/// What is wrong with a table, by rule.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct CheckProblem {
    /// Code, `E301`.
    pub code: &'static str,
    /// Row (line) from 1.
    pub row: Option<usize>,
    /// The whole message.
    pub message: String,
}

/// A checked table.
#[derive(Debug, Clone)]
pub struct Check {
    /// The table; none when it could not be read.
    pub table: Option<OffsetTable>,
    /// Suspects among its half-breadths.
    pub suspects: Option<Suspects>,
    /// Suspects among its heights at buttocks; none without heights.
    pub heights: Option<Suspects>,
    /// Suspects among the points of its sections; none without points.
    pub points: Option<PointSuspects>,
    /// Knuckles and tangent lines that the offsets speak for.
    pub lines: Vec<ProposedLine>,
    /// What breaks a rule.
    pub problems: Vec<CheckProblem>,
    /// What was detected and assumed, for the user.
    pub notes: Vec<String>,
}

/// Reads and checks the table of a file. One with rows or cells that cannot be read is a check with problems.
///
/// # Errors
/// [`Failure::FileSystem`]; [`Failure::Input`] where no table is found in the file.
pub fn check_table(path: &Path) -> Result<Check, Failure> {
    check_table_with(path, &Overrides::default())
}

/// The same, with conventions over those of the file beside the table.
///
/// # Errors
/// Those of [`check_table`].
pub fn check_table_with(path: &Path, conventions: &Overrides) -> Result<Check, Failure> {
    match read_table_file_with(path, conventions) {
        Ok((table, notes)) => {
            // A warning about a cell is a problem; that profiles are missing, or a column not used, is none of a table
            // that is only checked.
            let (located, general): (Vec<_>, Vec<_>) = notes.into_iter().partition(|note| {
                note.severity == exchange::Severity::Warning
                    && note.row.is_some()
                    && !ABOUT_READING.contains(&note.code)
            });
            let found = suspects(&table);
            Ok(Check {
                lines: proposed_lines(&table, &found),
                suspects: Some(found),
                heights: height_suspects(&table),
                points: Some(point_suspects(&table)).filter(|_| table.point_count() > 0),
                table: Some(table),
                problems: located.iter().map(of_table).collect(),
                notes: general
                    .iter()
                    .filter(|note| !matches!(note.code, "W306" | "W307"))
                    .map(ToString::to_string)
                    .collect(),
            })
        }
        // Cells that hold no number as they were typed are no errors of typing: the file is refused.
        Err(Failure::Input(messages)) if messages.iter().any(is_of_a_line) && !messages.iter().any(is_refusal) => {
            let (errors, warnings): (Vec<_>, Vec<_>) =
                messages.into_iter().partition(|message| message.severity == config::Severity::Error);
            Ok(Check {
                table: None,
                suspects: None,
                heights: None,
                points: None,
                lines: Vec::new(),
                problems: errors.iter().map(of_file).collect(),
                notes: warnings.iter().map(ToString::to_string).collect(),
            })
        }
        Err(failure) => Err(failure),
    }
}

fn is_refusal(message: &Diagnostic) -> bool {
    message.code == "E317"
}

fn is_of_a_line(message: &Diagnostic) -> bool {
    message.severity == config::Severity::Error && message.line.is_some()
}

fn of_table(problem: &TableProblem) -> CheckProblem {
    CheckProblem { code: problem.code, row: problem.row, message: problem.to_string() }
}

fn of_file(message: &Diagnostic) -> CheckProblem {
    CheckProblem { code: message.code, row: message.line, message: message.to_string() }
}

/// Which cells of a table were judged.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Grid {
    HalfBreadths,
    Heights,
}

impl Grid {
    /// What a column of the grid is called, and where its columns stand \[m\].
    fn columns(self, table: &OffsetTable) -> (&'static str, &[f64]) {
        match self {
            Self::HalfBreadths => ("waterline", &table.waterlines),
            Self::Heights => ("buttock", &table.buttocks),
        }
    }

    fn cell<'t>(self, table: &'t OffsetTable, suspect: &Suspect) -> Option<&'t Cell> {
        let station = table.stations.get(suspect.station)?;
        match self {
            Self::HalfBreadths => station.half_breadths.get(suspect.waterline),
            Self::Heights => station.heights.get(suspect.waterline),
        }
    }
}

fn verdicts(found: Option<&Suspects>) -> usize {
    found.map_or(0, |result| result.verdicts.iter().flatten().flatten().count())
}

impl Check {
    /// The suspects among cells, half-breadths before heights.
    fn cells(&self) -> impl Iterator<Item = (Grid, &Suspect)> {
        let all = [(Grid::HalfBreadths, &self.suspects), (Grid::Heights, &self.heights)];
        all.into_iter().flat_map(|(grid, found)| {
            found.iter().flat_map(|result| &result.suspects).map(move |suspect| (grid, suspect))
        })
    }

    fn point_list(&self) -> &[PointSuspect] {
        self.points.as_ref().map_or(&[], |result| &result.suspects)
    }

    fn names(&self) -> Vec<&str> {
        let cells = self.cells().map(|(_, suspect)| suspect.id.as_str());
        cells.chain(self.point_list().iter().map(|suspect| suspect.id.as_str())).collect()
    }

    /// The number of half-breadths, of heights and of points that were judged.
    #[must_use]
    pub fn judged(&self) -> [usize; 3] {
        let points = self.points.as_ref().map_or(0, |result| result.judged);
        [verdicts(self.suspects.as_ref()), verdicts(self.heights.as_ref()), points]
    }

    /// The number of points of sections, or of numbers of lines, that have too few neighbours to be judged.
    #[must_use]
    pub fn points_not_judged(&self) -> usize {
        let all = |table: &OffsetTable| {
            let cells = table.form.boat_lines.iter().flat_map(|line| &line.points).flat_map(|point| &point.cells);
            if table.form.boat_lines.is_empty() { table.point_count() } else { cells.flatten().count() }
        };
        self.table.as_ref().map_or(0, all).saturating_sub(self.judged()[2])
    }

    /// The failure that ends the program when there are suspects or problems, those that were accepted apart.
    ///
    /// # Errors
    /// [`Failure::Check`].
    pub fn verdict(&self, accepted: &[String]) -> Result<(), Failure> {
        let left = self.names().iter().filter(|id| !accepted.iter().any(|a| a == *id)).count();
        if left + self.problems.len() == 0 {
            return Ok(());
        }
        Err(Failure::Check(format!("E502 {}, {}", counted(left, "suspect"), counted(self.problems.len(), "problem"))))
    }
}

/// The same as JSON: `{"count", "worst": {"station", "waterline", "written", "value", "expected"}}`.
pub(in crate::report) fn suspects_json(table: &OffsetTable, found: &Suspects) -> Value {
    let worst = found.suspects.first().and_then(|worst| {
        Some(json!({
            "station": table.stations.get(worst.station)?.station.name,
            "waterline": table.waterlines.get(worst.waterline)?,
            "written": worst.written,
            "value": worst.value,
            "expected": worst.verdict.expected,
        }))
    });
    json!({ "count": found.suspects.len(), "worst": worst })
}

fn place(table: &OffsetTable, grid: Grid, suspect: &Suspect) -> Option<Written> {
    grid.cell(table, suspect)?.written.clone()
}

fn probability(p: f64) -> String {
    if p > 0.9995 { "> 0.999".to_owned() } else { format!("{p:.3}") }
}

/// The suspects and problems for a terminal, 80 columns.
#[must_use]
pub fn check_page(check: &Check) -> String {
    let mut page = String::new();
    if let (Some(table), Some(result)) = (&check.table, &check.suspects) {
        let [judged, heights, points] = check.judged();
        let name = if table.name.is_empty() { "table" } else { &table.name };
        page.push_str(&format!(
            "{name}: {}, {}, {} judged; noise {:.2} mm\n",
            counted(table.stations.len(), "station"),
            counted(table.waterlines.len(), "waterline"),
            counted(judged, "offset"),
            1000.0 * result.noise
        ));
        if let Some(found) = &check.heights {
            page.push_str(&format!(
                "{} at {} judged; noise {:.2} mm\n",
                counted(heights, "height"),
                counted(table.buttocks.len(), "buttock"),
                1000.0 * found.noise
            ));
        }
        let (noun, along) = match table.form.boat_lines.is_empty() {
            true => ("point", "of sections judged along their sections"),
            false => ("number", "of lines judged along their lines"),
        };
        if let Some(found) = &check.points {
            page.push_str(&format!("{} {along}; noise {:.2} mm\n", counted(points, noun), 1000.0 * found.noise));
        }
        let left = check.points_not_judged();
        if left > 0 {
            let of = along.split(" judged").next().unwrap_or_default();
            page.push_str(&format!("{} {of} NOT judged: too few beside them\n", counted(left, noun)));
        }
        for (grid, suspect) in check.cells() {
            page.push_str(&suspect_lines(table, grid, suspect));
        }
        for suspect in check.point_list() {
            page.push_str(&point_lines(table, suspect));
        }
        if judged + heights + points == 0 {
            page.push_str("nothing was judged; this table may hold any error\n");
        } else if check.names().is_empty() {
            page.push_str("no suspects\n");
        }
    }
    let notation = check.table.as_ref().map_or(Notation::Metres, |table| table.form.notation);
    for line in &check.lines {
        page.push_str(&format!(
            "{} along the {} at {}, from {} to {}: declared, it explains the offsets {:.1} times better\n",
            line.kind.as_str(),
            line.course.as_str(),
            lengths::length(notation, line.at, 3),
            lengths::length(notation, line.reach[0], 3).trim_end_matches(" m"),
            lengths::length(notation, line.reach[1], 3),
            line.gain
        ));
    }
    for problem in &check.problems {
        page.push_str(&problem.message);
        page.push('\n');
    }
    page
}

fn suspect_lines(table: &OffsetTable, grid: Grid, suspect: &Suspect) -> String {
    let (column, columns) = grid.columns(table);
    let form = &table.form;
    let (own, across, heads) = match grid {
        Grid::HalfBreadths => (form.notation, lengths::of_heights(form), &form.waterline_heads),
        Grid::Heights => (lengths::of_heights(form), form.notation, &form.buttock_heads),
    };
    let verdict = &suspect.verdict;
    let file =
        place(table, grid, suspect).map(|w| format!(" (row {}, column {})", w.row, w.column)).unwrap_or_default();
    let mut text = format!(
        "\n{:<4} station {}, {column} {}{file}: {}\n     expected {} ± {:.1} mm, off by {} = {:+.1} local noise, wrong with p {}\n",
        suspect.id,
        lengths::station(table, suspect.station),
        lengths::place(across, heads, columns[suspect.waterline]),
        suspect.written,
        lengths::length(own, verdict.expected, 4),
        1000.0 * verdict.uncertainty,
        lengths::difference(own, suspect.value - verdict.expected, 4),
        verdict.score,
        probability(suspect.probability)
    );
    let along = [("station", verdict.along_station), (column, verdict.along_waterline)];
    let expected = along.map(|(_, [expected, _])| lengths::length(own, expected, 4));
    let width = expected.iter().map(String::len).fold(11, usize::max);
    for ((name, [_, uncertainty]), expected) in along.into_iter().zip(expected) {
        text.push_str(&format!("     along the {name:<9} {expected:>width$} ± {:.1} mm\n", 1000.0 * uncertainty));
    }
    text + &named_readings(own, &suspect.readings)
}

/// The likeliest hypotheses, a line each.
fn named_readings(notation: Notation, readings: &[Reading]) -> String {
    let named = readings.iter().filter(|r| r.hypothesis != Hypothesis::Noise && r.probability >= LEAST_NAMED);
    let mut text = String::new();
    for reading in named.take(NAMED) {
        let value =
            if reading.text.is_empty() { lengths::length(notation, reading.value, 4) } else { reading.text.clone() };
        // Both together have 49 columns, whatever the unit.
        let width = 48_usize.saturating_sub(value.len().max(12));
        let name = reading.hypothesis.as_str();
        text.push_str(&format!("     {name:<width$} {value:>12}  p {}\n", probability(reading.probability)));
    }
    text
}

fn point_lines(table: &OffsetTable, suspect: &PointSuspect) -> String {
    let [[y, z], [near_y, near_z]] = [suspect.given, suspect.expected];
    if let Some(place) = &suspect.line {
        let index = usize::from(suspect.number == PointNumber::Height);
        let own = if index == 1 { lengths::of_heights(&table.form) } else { table.form.notation };
        let text = format!(
            "\n{:<4} station {}, {} (row {}, column {}): {}\n     \
             expected {} ± {:.1} mm along the line, off by {} = {:+.1} local noise, wrong with p {}\n",
            suspect.id,
            lengths::station(table, suspect.station),
            point_name(suspect),
            place.row,
            place.column,
            suspect.written,
            lengths::length(own, suspect.expected[index], 4),
            1000.0 * suspect.noise,
            lengths::difference(own, suspect.given[index] - suspect.expected[index], 4),
            suspect.score,
            probability(suspect.probability)
        );
        return text + &named_readings(own, &suspect.readings);
    }
    let own = table.form.notation;
    let pair = |y: f64, z: f64| match own {
        Notation::Metres => format!("y {y:.4}, z {z:.4} m"),
        _ => format!("y {}, z {}", lengths::length(own, y, 4), lengths::length(lengths::of_heights(&table.form), z, 4)),
    };
    let text = format!(
        "\n{:<4} station {}, {}: {}\n     \
         {} off the section, which passes {}\n     \
         {:.1} local noise, wrong with p {}\n",
        suspect.id,
        lengths::station(table, suspect.station),
        point_name(suspect),
        pair(y, z),
        lengths::length(own, suspect.distance, 4),
        pair(near_y, near_z),
        suspect.score,
        probability(suspect.probability)
    );
    text + &named_readings(own, &suspect.readings)
}

/// A number of a line, or a point. Points and branches count from 0, as in files that number them.
fn point_name(suspect: &PointSuspect) -> String {
    if let Some(place) = &suspect.line {
        let number = if suspect.number == PointNumber::Height { "height" } else { "half-breadth" };
        return format!("{number} of the {}", place.name);
    }
    match suspect.branch {
        0 => format!("point {}", suspect.point),
        branch => format!("branch {branch}, point {}", suspect.point),
    }
}

/// The check as one JSON object, keys as in the manual of the command.
#[must_use]
pub fn check_json(check: &Check) -> Value {
    let suspects: Vec<Value> = check.table.iter().flat_map(|table| all_json(check, table)).collect();
    let problems: Vec<Value> = check
        .problems
        .iter()
        .map(|problem| json!({ "code": problem.code, "row": problem.row, "message": problem.message }))
        .collect();
    let lines: Vec<Value> = check
        .lines
        .iter()
        .map(|line| {
            json!({
                "kind": line.kind.as_str(), "course": line.course.as_str(), "at": line.at, "from": line.reach[0],
                "to": line.reach[1], "gain": line.gain,
            })
        })
        .collect();
    let noise = |found: &Option<Suspects>| found.as_ref().map(|result| result.noise);
    let [judged, heights, points] = check.judged();
    json!({
        "judged": judged, "heights_judged": heights, "points_judged": points,
        "points_not_judged": check.points_not_judged(),
        "noise": {
            "sigma": noise(&check.suspects), "heights": noise(&check.heights),
            "points": check.points.as_ref().map(|result| result.noise),
        },
        "suspects": suspects, "problems": problems, "lines": lines,
        "warnings": check.notes.iter().filter(|note| is_warning(note)).collect::<Vec<_>>(),
    })
}

fn all_json(check: &Check, table: &OffsetTable) -> Vec<Value> {
    let cells = check.cells().map(|(grid, suspect)| cell_json(table, grid, suspect));
    cells.chain(check.point_list().iter().map(|suspect| point_json(table, suspect))).collect()
}

fn readings_json(readings: &[Reading]) -> Vec<Value> {
    let likely = readings.iter().filter(|reading| reading.probability >= 1e-6);
    likely
        .map(|reading| {
            json!({
                "hypothesis": reading.hypothesis.as_str(), "written": reading.text, "value": reading.value,
                "probability": reading.probability,
            })
        })
        .collect()
}

fn point_json(table: &OffsetTable, suspect: &PointSuspect) -> Value {
    let station = &table.stations[suspect.station].station;
    let [[y, z], [near_y, near_z]] = [suspect.given, suspect.expected];
    json!({
        "id": suspect.id, "of": if suspect.line.is_some() { "line" } else { "point" },
        "station": station.x, "station_name": station.name, "line": suspect.line.as_ref().map(|place| &place.name),
        "row": suspect.line.as_ref().map(|place| place.row), "column": suspect.line.as_ref().map(|place| place.column),
        "branch": suspect.branch, "point": suspect.point, "number": suspect.number.as_str(),
        "written": suspect.written, "y": y, "z": z, "expected": { "y": near_y, "z": near_z },
        "distance": suspect.distance, "noise": suspect.noise, "score": suspect.score,
        "hypothesis": suspect.hypothesis().as_str(), "proposed": suspect.proposed,
        "proposed_written": suspect.proposed_text, "probability": suspect.probability,
        "hypotheses": readings_json(&suspect.readings),
    })
}

/// A suspect among half-breadths.
pub(in crate::report) fn suspect_json(table: &OffsetTable, suspect: &Suspect) -> Value {
    cell_json(table, Grid::HalfBreadths, suspect)
}

fn cell_json(table: &OffsetTable, grid: Grid, suspect: &Suspect) -> Value {
    let verdict = &suspect.verdict;
    let file = place(table, grid, suspect);
    let (column, columns) = grid.columns(table);
    let (of, along) = match grid {
        Grid::HalfBreadths => ("half-breadth", "along_waterline"),
        Grid::Heights => ("height", "along_buttock"),
    };
    json!({
        "id": suspect.id,
        "of": of,
        "station": table.stations[suspect.station].station.x,
        "station_name": table.stations[suspect.station].station.name,
        column: columns[suspect.waterline],
        "row": file.as_ref().map(|w| w.row),
        "column": file.as_ref().map(|w| w.column),
        "written": suspect.written,
        "value": suspect.value,
        "expected": verdict.expected,
        "uncertainty": verdict.uncertainty,
        "noise": verdict.noise,
        "score": verdict.score,
        "along_station": { "expected": verdict.along_station[0], "uncertainty": verdict.along_station[1] },
        along: { "expected": verdict.along_waterline[0], "uncertainty": verdict.along_waterline[1] },
        "hypothesis": suspect.hypothesis().as_str(),
        "proposed": suspect.proposed,
        "proposed_written": suspect.proposed_text,
        "probability": suspect.probability,
        "hypotheses": readings_json(&suspect.readings),
    })
}

/// The files of a check: the list as JSON; what is judged of offsets, heights and points as figures, SVG and PNG.
///
/// # Errors
/// [`Failure::Internal`] when a figure cannot be drawn.
pub fn check_files(check: &Check, figures: bool) -> Result<Vec<OutputFile>, Failure> {
    let internal = |error: String| Failure::Internal(error);
    let text = serde_json::to_string_pretty(&check_json(check)).map_err(|error| internal(error.to_string()))?;
    let mut files = vec![OutputFile::text("check.json", text + "\n")];
    let Some(table) = check.table.as_ref().filter(|_| figures) else { return Ok(files) };
    // A table of points has no cells.
    let grid = check.suspects.as_ref().filter(|_| !table.waterlines.is_empty() && !table.stations.is_empty());
    let drawn = [
        ("suspects", grid.map(|found| suspects_figure(table, found))),
        ("suspect-heights", check.heights.as_ref().map(|found| suspect_heights_figure(table, found))),
        ("suspect-points", check.points.as_ref().map(|found| suspect_points_figure(table, found))),
    ];
    for (name, figure) in drawn.into_iter().filter_map(|(name, figure)| Some((name, figure?))) {
        let figure = figure.map_err(|error| internal(error.to_string()))?;
        let contents = figure.to_png(DOTS_PER_INCH).map_err(|error| internal(error.to_string()))?;
        files.push(OutputFile { name: format!("{name}.png"), contents });
        files.push(OutputFile::text(&format!("{name}.svg"), figure.as_str().to_owned()));
    }
    Ok(files)
}

/// The table with accepted proposals.
#[derive(Debug, Clone, PartialEq)]
pub struct Accepted {
    /// The file.
    pub text: String,
    /// How the table was written.
    pub form: TableForm,
    /// What was changed, a line a cell.
    pub changes: Vec<String>,
}

/// Takes over the proposals for the suspects named `ids`, in the notation of the table; nothing else is changed.
///
/// # Errors
/// [`Failure::Usage`] for names that no suspect has, or where the table could not be read.
pub fn accept(check: &Check, ids: &[String]) -> Result<Accepted, Failure> {
    let known = check.names();
    let unknown: Vec<&str> = ids.iter().map(String::as_str).filter(|id| !known.contains(id)).collect();
    if !unknown.is_empty() {
        let known =
            if known.is_empty() { "there are none".to_owned() } else { format!("there are {}", known.join(", ")) };
        return Err(Failure::Usage(format!("E203 no suspect is called {}: {known}", unknown.join(", "))));
    }
    let Some(mut table) = check.table.clone() else {
        return Err(Failure::Usage("E203 the table could not be read; nothing can be accepted".to_owned()));
    };
    let mut changes = Vec::new();
    for (grid, suspect) in check.cells().filter(|(_, suspect)| ids.contains(&suspect.id)) {
        let (column, columns) = grid.columns(&table);
        changes.push(format!(
            "{}: station {}, {column} {:.3}: {} becomes {} ({})",
            suspect.id,
            table.stations[suspect.station].station.name,
            columns[suspect.waterline],
            suspect.written,
            suspect.proposed_text,
            suspect.hypothesis().as_str()
        ));
        let station = &mut table.stations[suspect.station];
        let cell = match grid {
            Grid::HalfBreadths => &mut station.half_breadths[suspect.waterline],
            Grid::Heights => &mut station.heights[suspect.waterline],
        };
        cell.entry = Entry::Given(suspect.proposed);
        if let Some(written) = &mut cell.written {
            written.text = suspect.proposed_text.clone();
        }
    }
    for suspect in check.point_list().iter().filter(|suspect| ids.contains(&suspect.id)) {
        let station = &mut table.stations[suspect.station];
        changes.push(format!(
            "{}: station {}, {}: {} {} becomes {} ({})",
            suspect.id,
            station.station.name,
            point_name(suspect),
            suspect.number.as_str(),
            suspect.written,
            suspect.proposed_text,
            suspect.hypothesis().as_str()
        ));
        let point = &mut station.outlines[suspect.branch][suspect.point];
        match suspect.number {
            PointNumber::HalfBreadth => point.y = suspect.proposed,
            PointNumber::Height => point.z = suspect.proposed,
        }
    }
    let text = write_table(&table, TableWriting::default()).text;
    Ok(Accepted { text, form: table.form, changes })
}
