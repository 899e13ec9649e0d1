//! Checking a table of offsets: suspects and problems, on the terminal, as JSON, as a picture, and accepted one by one.

use std::path::Path;

use serde_json::{Value, json};

use super::failure::Failure;
use super::files::OutputFile;
use super::source::read_table_file;
use crate::config::{self, Diagnostic};
use crate::exchange::{self, TableProblem, TableWriting, write_table};
use crate::fairing::{Hypothesis, Suspect, Suspects, suspects};
use crate::hull::{Entry, OffsetTable, Written};
use crate::plot::suspects_figure;

/// Resolution of the picture \[dots per inch\].
const DOTS_PER_INCH: f64 = 160.0;
/// Hypotheses that the page names for each suspect.
const NAMED: usize = 3;
/// Hypotheses less probable than this are not named.
const LEAST_NAMED: f64 = 0.005;

/// Warnings that say how a file was read, not that a cell is wrong.
const ABOUT_READING: [&str; 6] = ["W320", "W330", "W331", "W332", "W333", "W334"];

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
    /// Its suspects.
    pub suspects: Option<Suspects>,
    /// What breaks a rule.
    pub problems: Vec<CheckProblem>,
    /// What was detected and assumed, for the user.
    pub notes: Vec<String>,
}

/// Reads and checks the table of a file. A table that cannot be read is a check with problems.
///
/// # Errors
/// [`Failure::FileSystem`].
pub fn check_table(path: &Path) -> Result<Check, Failure> {
    match read_table_file(path) {
        Ok((table, notes)) => {
            // A warning about a cell is a problem; that profiles are missing, or a column not used, is none of a table that is
            // only checked.
            let (located, general): (Vec<_>, Vec<_>) = notes.into_iter().partition(|note| {
                note.severity == exchange::Severity::Warning
                    && note.row.is_some()
                    && !ABOUT_READING.contains(&note.code)
            });
            Ok(Check {
                suspects: Some(suspects(&table)),
                table: Some(table),
                problems: located.iter().map(of_table).collect(),
                notes: general
                    .iter()
                    .filter(|note| !matches!(note.code, "W306" | "W307"))
                    .map(ToString::to_string)
                    .collect(),
            })
        }
        Err(Failure::Input(messages)) => {
            let (errors, warnings): (Vec<_>, Vec<_>) =
                messages.into_iter().partition(|message| message.severity == config::Severity::Error);
            Ok(Check {
                table: None,
                suspects: None,
                problems: errors.iter().map(of_file).collect(),
                notes: warnings.iter().map(ToString::to_string).collect(),
            })
        }
        Err(failure) => Err(failure),
    }
}

fn of_table(problem: &TableProblem) -> CheckProblem {
    CheckProblem { code: problem.code, row: problem.row, message: problem.to_string() }
}

fn of_file(message: &Diagnostic) -> CheckProblem {
    CheckProblem { code: message.code, row: message.line, message: message.to_string() }
}

impl Check {
    fn list(&self) -> &[Suspect] {
        self.suspects.as_ref().map_or(&[], |result| &result.suspects)
    }

    /// The number of offsets that were judged.
    #[must_use]
    pub fn judged(&self) -> usize {
        self.suspects.as_ref().map_or(0, |result| result.verdicts.iter().flatten().flatten().count())
    }

    /// The number of points of sections in the table; these are not judged.
    #[must_use]
    pub fn points(&self) -> usize {
        self.table.as_ref().map_or(0, points)
    }

    /// The failure that ends the program when there are suspects or problems, those that were accepted apart.
    ///
    /// # Errors
    /// [`Failure::Check`].
    pub fn verdict(&self, accepted: &[String]) -> Result<(), Failure> {
        let left = self.list().iter().filter(|suspect| !accepted.contains(&suspect.id)).count();
        if left + self.problems.len() == 0 {
            return Ok(());
        }
        Err(Failure::Check(format!("E502 {}, {}", counted(left, "suspect"), counted(self.problems.len(), "problem"))))
    }
}

fn counted(n: usize, what: &str) -> String {
    format!("{n} {what}{}", if n == 1 { "" } else { "s" })
}

fn points(table: &OffsetTable) -> usize {
    table.stations.iter().flat_map(|station| &station.outlines).map(Vec::len).sum()
}

/// Suspects of a table in one line, the most severe with its place; none without suspects.
pub(super) fn suspects_line(table: &OffsetTable, found: &Suspects) -> Option<String> {
    let worst = found.suspects.first()?;
    let station = table.stations.get(worst.station)?;
    let waterline = table.waterlines.get(worst.waterline)?;
    Some(format!(
        "{}: run `check`; the worst is station {}, waterline {waterline:.3} m: written {}, {:.4} m, expected {:.4} m",
        counted(found.suspects.len(), "suspect cell"),
        station.station.name,
        worst.written,
        worst.value,
        worst.verdict.expected
    ))
}

/// The same as JSON: `{"count", "worst": {"station", "waterline", "written", "value", "expected"}}`.
pub(super) fn suspects_json(table: &OffsetTable, found: &Suspects) -> Value {
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

fn place(table: &OffsetTable, suspect: &Suspect) -> Option<Written> {
    table.stations[suspect.station].half_breadths[suspect.waterline].written.clone()
}

fn probability(p: f64) -> String {
    if p > 0.9995 { "> 0.999".to_owned() } else { format!("{p:.3}") }
}

/// The suspects and problems for a terminal, 80 columns.
#[must_use]
pub fn check_page(check: &Check) -> String {
    let mut page = String::new();
    if let (Some(table), Some(result)) = (&check.table, &check.suspects) {
        let judged = check.judged();
        let name = if table.name.is_empty() { "table" } else { &table.name };
        page.push_str(&format!(
            "{name}: {} stations, {} waterlines, {judged} offsets judged; noise {:.2} mm\n",
            table.stations.len(),
            table.waterlines.len(),
            1000.0 * result.noise
        ));
        for suspect in &result.suspects {
            page.push_str(&suspect_lines(table, suspect));
        }
        let points = points(table);
        if points > 0 {
            page.push_str(&format!(
                "{points} points of sections are NOT judged: check knows offsets on waterlines only\n"
            ));
        }
        if judged == 0 {
            page.push_str("nothing was judged; this table may hold any error\n");
        } else if result.suspects.is_empty() {
            page.push_str("no suspects\n");
        }
    }
    for problem in &check.problems {
        page.push_str(&problem.message);
        page.push('\n');
    }
    page
}

fn suspect_lines(table: &OffsetTable, suspect: &Suspect) -> String {
    let verdict = &suspect.verdict;
    let file = place(table, suspect).map(|w| format!(" (row {}, column {})", w.row, w.column)).unwrap_or_default();
    let mut text = format!(
        "\n{:<4} station {}, waterline {:.3}{file}: {}\n     expected {:.4} m ± {:.1} mm, off by {:+.4} m = {:+.1} local noise, wrong with p {}\n",
        suspect.id,
        table.stations[suspect.station].station.name,
        table.waterlines[suspect.waterline],
        suspect.written,
        verdict.expected,
        1000.0 * verdict.uncertainty,
        suspect.value - verdict.expected,
        verdict.score,
        probability(suspect.probability)
    );
    for (name, [expected, uncertainty]) in [("station", verdict.along_station), ("waterline", verdict.along_waterline)]
    {
        text.push_str(&format!("     along the {name:<9} {expected:>9.4} m ± {:.1} mm\n", 1000.0 * uncertainty));
    }
    let named = suspect.readings.iter().filter(|r| r.hypothesis != Hypothesis::Noise && r.probability >= LEAST_NAMED);
    for reading in named.take(NAMED) {
        let value = if reading.text.is_empty() { format!("{:.4} m", reading.value) } else { reading.text.clone() };
        text.push_str(&format!(
            "     {:<36} {value:>12}  p {}\n",
            reading.hypothesis.as_str(),
            probability(reading.probability)
        ));
    }
    text
}

/// The check as one JSON object, keys as in the manual of the command.
#[must_use]
pub fn check_json(check: &Check) -> Value {
    let suspects: Vec<Value> = match (&check.table, &check.suspects) {
        (Some(table), Some(result)) => result.suspects.iter().map(|s| suspect_json(table, s)).collect(),
        _ => Vec::new(),
    };
    let problems: Vec<Value> = check
        .problems
        .iter()
        .map(|problem| json!({ "code": problem.code, "row": problem.row, "message": problem.message }))
        .collect();
    let sigma = check.suspects.as_ref().map(|result| result.noise);
    json!({
        "judged": check.judged(), "points_not_judged": check.points(),
        "noise": { "sigma": sigma }, "suspects": suspects, "problems": problems, "lines": [],
    })
}

fn suspect_json(table: &OffsetTable, suspect: &Suspect) -> Value {
    let verdict = &suspect.verdict;
    let file = place(table, suspect);
    let readings: Vec<Value> = suspect
        .readings
        .iter()
        .filter(|reading| reading.probability >= 1e-6)
        .map(|reading| {
            json!({
                "hypothesis": reading.hypothesis.as_str(), "written": reading.text, "value": reading.value,
                "probability": reading.probability,
            })
        })
        .collect();
    json!({
        "id": suspect.id,
        "station": table.stations[suspect.station].station.x,
        "station_name": table.stations[suspect.station].station.name,
        "waterline": table.waterlines[suspect.waterline],
        "row": file.as_ref().map(|w| w.row),
        "column": file.as_ref().map(|w| w.column),
        "written": suspect.written,
        "value": suspect.value,
        "expected": verdict.expected,
        "uncertainty": verdict.uncertainty,
        "noise": verdict.noise,
        "score": verdict.score,
        "along_station": { "expected": verdict.along_station[0], "uncertainty": verdict.along_station[1] },
        "along_waterline": { "expected": verdict.along_waterline[0], "uncertainty": verdict.along_waterline[1] },
        "hypothesis": suspect.hypothesis().as_str(),
        "proposed": suspect.proposed,
        "proposed_written": suspect.proposed_text,
        "probability": suspect.probability,
        "hypotheses": readings,
    })
}

/// The files of a check: the list as JSON, the figure as SVG and PNG.
///
/// # Errors
/// [`Failure::Internal`] when the figure cannot be drawn.
pub fn check_files(check: &Check, figures: bool) -> Result<Vec<OutputFile>, Failure> {
    let internal = |error: String| Failure::Internal(error);
    let text = serde_json::to_string_pretty(&check_json(check)).map_err(|error| internal(error.to_string()))?;
    let mut files = vec![OutputFile::text("check.json", text + "\n")];
    if let (Some(table), Some(result), true) = (&check.table, &check.suspects, figures) {
        let figure = suspects_figure(table, result).map_err(|error| internal(error.to_string()))?;
        let contents = figure.to_png(DOTS_PER_INCH).map_err(|error| internal(error.to_string()))?;
        files.push(OutputFile { name: "suspects.png".to_owned(), contents });
        files.push(OutputFile::text("suspects.svg", figure.as_str().to_owned()));
    }
    Ok(files)
}

/// The table with accepted proposals.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Accepted {
    /// The file.
    pub text: String,
    /// What was changed, a line a cell.
    pub changes: Vec<String>,
}

/// Takes over the proposals for the suspects named `ids`, in the notation of the table; nothing else is changed.
///
/// # Errors
/// [`Failure::Usage`] for names that no suspect has, or where the table could not be read.
pub fn accept(check: &Check, ids: &[String]) -> Result<Accepted, Failure> {
    let unknown: Vec<&str> =
        ids.iter().filter(|id| !check.list().iter().any(|s| &s.id == *id)).map(String::as_str).collect();
    if !unknown.is_empty() {
        let known: Vec<&str> = check.list().iter().map(|s| s.id.as_str()).collect();
        let known =
            if known.is_empty() { "there are none".to_owned() } else { format!("there are {}", known.join(", ")) };
        return Err(Failure::Usage(format!("E203 no suspect is called {}: {known}", unknown.join(", "))));
    }
    let Some(mut table) = check.table.clone() else {
        return Err(Failure::Usage("E203 the table could not be read; nothing can be accepted".to_owned()));
    };
    let mut changes = Vec::new();
    for suspect in check.list().iter().filter(|suspect| ids.contains(&suspect.id)) {
        let line = format!(
            "{}: station {}, waterline {:.3}: {} becomes {} ({})",
            suspect.id,
            table.stations[suspect.station].station.name,
            table.waterlines[suspect.waterline],
            suspect.written,
            suspect.proposed_text,
            suspect.hypothesis().as_str()
        );
        let cell = &mut table.stations[suspect.station].half_breadths[suspect.waterline];
        cell.entry = Entry::Given(suspect.proposed);
        if let Some(written) = &mut cell.written {
            written.text = suspect.proposed_text.clone();
        }
        changes.push(line);
    }
    Ok(Accepted { text: write_table(&table, TableWriting::default()).text, changes })
}
