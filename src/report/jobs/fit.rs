//! The job of `fit`: a table and a method in, the hull and every file about it out. Nothing is written here.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use serde_json::{Value, json};

use super::check::suspects_json;
use super::overshoot;
use crate::config::{self, Diagnostic, METHODS, MethodFile, Severity};
use crate::exchange::{
    self, ManifestEntry, Particulars, TableProblem, conventions_json, hydrostatics_csv, offsets_csv, residuals_csv,
    row_json, write_hull,
};
use crate::fairing::{Suspects, suspects};
use crate::hull::{
    Chart, FitError, FitMethod, Fitted, Hull, OffsetTable, PointResidual, StatedParticulars, VolumeEstimate,
};
use crate::hydrostatics::{Assumed, Conventions, CurvesOfForm, Given, Hydrostatics, default_draughts};
use crate::plot::{Figure, FigureInputs};
use crate::report::failure::{Failure, problem};
use crate::report::input::doubts::{drawn_doubt, spacing_doubts, suspects_doubt, suspects_line};
use crate::report::input::source::{
    Overrides, is_toml, read_bytes, read_table_stated, refuse_design, remark, ship_name, source_files, utf8,
};
use crate::report::output::files::OutputFile;
use crate::report::output::manifest::{figure_files, json_file, manifest_entry, manifest_file, source_words};
use crate::report::words::page::{WIDTH, conventions_line, dimensions, no_draught, quantities, wrapped};
use crate::report::words::remarks::unusual;
use crate::units::counted;

/// What is to be fitted, and how.
#[derive(Debug, Clone)]
pub struct FitJob {
    /// The table, with what the method file and the command say of its dimensions.
    pub table: OffsetTable,
    /// The method.
    pub method: MethodFile,
    /// What was detected and assumed when the table was read.
    pub reading: Vec<TableProblem>,
    /// Cells that their neighbours contradict; the fit takes them as they are.
    pub suspects: Suspects,
    /// Whether the command states the design draught.
    draught_of_command: bool,
    /// File of the table.
    table_file: PathBuf,
    /// The files that were read; the first is the one that the command named.
    inputs: Vec<ManifestEntry>,
    /// Their paths.
    files: Vec<PathBuf>,
}

impl FitJob {
    /// What reading the table had to guess.
    pub fn warnings(&self) -> impl Iterator<Item = &TableProblem> {
        self.reading.iter().filter(|problem| problem.severity == exchange::Severity::Warning)
    }

    /// The files that were read.
    #[must_use]
    pub fn files(&self) -> &[PathBuf] {
        &self.files
    }
}

/// What a fit gives.
#[derive(Debug, Clone)]
pub struct FitOutputs {
    /// The hull, its cells and what was assumed.
    pub fitted: Fitted,
    /// How well the table determines the volume at the design draught, or below the highest waterline that every station
    /// has where none is stated.
    pub estimate: VolumeEstimate,
    /// Where the surface leaves its data.
    pub warnings: Vec<String>,
    /// Hydrostatics at the design draught; none where none is stated.
    pub design_row: Option<Hydrostatics>,
    /// The hydrostatic table.
    pub table: CurvesOfForm,
    /// The contents of `fit.json`.
    pub summary: Value,
    /// The files, in the order of their names; the manifest is the last.
    pub files: Vec<OutputFile>,
}

fn read_method_file(path: &Path, inputs: &mut Vec<ManifestEntry>) -> Result<MethodFile, Failure> {
    let bytes = read_bytes(path)?;
    refuse_design(path, &bytes)?;
    inputs.push(manifest_entry(path, &bytes));
    let text = utf8(path, bytes)?;
    config::read_method(&path.display().to_string(), &text).map_err(Failure::Input)
}

/// The method that a word or a file names.
fn named_method(word: &str, inputs: &mut Vec<ManifestEntry>) -> Result<MethodFile, Failure> {
    if let Some(method) = FitMethod::all().into_iter().find(|method| method.as_str().eq_ignore_ascii_case(word)) {
        return Ok(MethodFile::new(method));
    }
    let path = Path::new(word);
    if !is_toml(path) && fs::metadata(path).is_err() {
        let known = METHODS.join(", ");
        return Err(Failure::Usage(format!("the method '{word}' is neither a file nor one of {known}")));
    }
    read_method_file(path, inputs)
}

/// Reads what `fit` starts from: a table of offsets, or a method file (`.toml`) that names one. `method_name` is a word of
/// [`METHODS`] or a method file; `draught` \[m\] overrides that of the files.
///
/// # Errors
/// [`Failure::FileSystem`]; [`Failure::Input`] with every problem of a file; [`Failure::Usage`].
pub fn read_fit(path: &Path, method_name: Option<&str>, draught: Option<f64>) -> Result<FitJob, Failure> {
    read_fit_with(path, method_name, draught, &Overrides::default())
}

/// The same, with conventions of the table over those of the file beside it.
///
/// # Errors
/// Those of [`read_fit`].
pub fn read_fit_with(
    path: &Path,
    method_name: Option<&str>,
    draught: Option<f64>,
    conventions: &Overrides,
) -> Result<FitJob, Failure> {
    let mut inputs = Vec::new();
    let (method, table_file) = if is_toml(path) {
        if let Some(word) = method_name {
            let message = format!("{} is a method file already; --method {word} says it twice", path.display());
            return Err(Failure::Usage(message));
        }
        let file = read_method_file(path, &mut inputs)?;
        let Some(table) = file.table.as_ref().filter(|table| !table.trim().is_empty()) else {
            let help =
                "Write table = \"FILE\" in it, or give the table and the method: fit TABLE --method FILE".to_owned();
            return Err(Failure::Input(vec![problem("E161", path, "the file names no table".to_owned(), help)]));
        };
        let table = path.parent().unwrap_or(Path::new("")).join(table);
        (file, table)
    } else {
        let file = method_name
            .map_or_else(|| Ok(MethodFile::new(FitMethod::default())), |word| named_method(word, &mut inputs))?;
        (file, path.to_owned())
    };
    let bytes = read_bytes(&table_file)?;
    // The file that the command named comes first.
    inputs.insert(if is_toml(path) { inputs.len() } else { 0 }, manifest_entry(&table_file, &bytes));
    let over = StatedParticulars { draught: draught.or(method.stated.draught), ..method.stated };
    let (mut table, notes) = read_table_stated(&table_file, &over, path, conventions)?;
    if table.name.trim().is_empty() {
        table.name = ship_name(&table_file);
    }
    let suspects = suspects(&table);
    let mut files = source_files(&table_file);
    files.push(path.to_owned());
    files.extend(method_name.map(PathBuf::from));
    let draught_of_command = draught.is_some();
    Ok(FitJob { table, method, reading: notes, suspects, draught_of_command, table_file, inputs, files })
}

/// Points of sections beside the surface: number, root mean square and the one that is missed most.
struct PointMisfit {
    count: usize,
    rms: f64,
    worst: PointResidual,
}

impl PointMisfit {
    /// None without points.
    fn new(points: &[PointResidual]) -> Option<Self> {
        let mut worst = *points.first()?;
        for point in points {
            if point.residual().abs() > worst.residual().abs() {
                worst = *point;
            }
        }
        let squares: f64 = points.iter().map(|point| point.residual().powi(2)).sum();
        Some(Self { count: points.len(), rms: (squares / points.len() as f64).sqrt(), worst })
    }
}

fn chart_word(chart: Chart) -> &'static str {
    match chart {
        Chart::Level => "level",
        Chart::Upright => "upright",
    }
}

fn refusal(job: &FitJob, error: FitError) -> Failure {
    let file = &job.table_file;
    let mut messages = match error {
        FitError::Settings(problems) => job.method.diagnose(&problems.0, &file.display().to_string()),
        FitError::Hull(error) if job.draught_of_command && error.is_of_draught() => return Failure::of_draught(&error),
        FitError::Hull(error) => {
            let message = format!("the {} surface over this table is no hull: {error}", job.method.method.as_str());
            let help = match error {
                error if error.is_of_draught() => "",
                _ => "Another method, or other settings of it, may do",
            };
            vec![problem("E163", file, message, help)]
        }
        other => vec![problem("E162", file, other.to_string(), String::new())],
    };
    // A misprint may be the reason.
    if let Some(line) = suspects_line(&job.table, &job.suspects) {
        messages.push(Diagnostic { severity: Severity::Warning, ..problem("W164", file, line, String::new()) });
    }
    Failure::Input(messages)
}

/// Contents of `fit.json`.
fn summary(
    job: &FitJob,
    fitted: &Fitted,
    estimate: &VolumeEstimate,
    warnings: &[String],
    row: Option<&Hydrostatics>,
    conventions: &Conventions,
) -> Value {
    let misfit = fitted.misfit();
    let worst = misfit.worst.and_then(|cell| {
        let station = &job.table.stations.get(cell.station)?.station;
        let waterline = job.table.waterlines.get(cell.waterline)?;
        Some(json!({ "station": station.name, "x": station.x, "waterline": waterline, "residual": cell.residual }))
    });
    let points = PointMisfit::new(&fitted.points(&job.table)).map(|points| {
        let worst = &points.worst;
        let station = job.table.stations.get(worst.station).map(|s| &s.station);
        json!({
            "compared": points.count,
            "max": worst.residual().abs(),
            "rms": points.rms,
            "worst": {
                "station": station.map(|s| &s.name), "x": station.map(|s| s.x), "z": worst.height,
                "given": worst.given, "surface": worst.half_breadth, "residual": worst.residual(),
            },
        })
    });
    json!({
        "name": job.table.name,
        "method": job.method.method.as_str(),
        "chart": chart_word(fitted.chart),
        "inputs": job.inputs,
        "particulars": Particulars::from(fitted.hull.particulars()),
        "cells": {
            "given": misfit.given,
            "predicted": misfit.predicted,
            "max": misfit.largest(),
            "rms": misfit.rms,
            "worst": worst,
        },
        "points": points,
        "volume_error": {
            "total": estimate.total(), "stations": estimate.stations, "waterlines": estimate.waterlines,
        },
        "suspects": suspects_json(&job.table, &job.suspects),
        "warnings": warnings,
        "notes": fitted.notes,
        "reading": job.reading.iter().map(remark).collect::<Vec<_>>(),
        "design": row.map(row_json),
        "conventions": conventions_json(conventions),
    })
}

/// Fits the table and makes every file about the hull; `figures` are drawn.
///
/// # Errors
/// [`Failure::Input`] when the table and the method make no hull, with every reason; [`Failure::Usage`] when the draught of
/// the command is none of the hull; [`Failure::Internal`] when a table or a figure cannot be made.
pub fn fit_outputs(job: &FitJob, figures: &[Figure]) -> Result<FitOutputs, Failure> {
    let fitted = Hull::fit(&job.table, &job.method.method).map_err(|error| refusal(job, error))?;
    let assumed = Assumed::of(&job.table.stated);
    let particulars = fitted.hull.particulars();
    // A method file states a draught as the command does.
    let by_user = job.draught_of_command || job.method.stated.draught.is_some();
    let given = Given::of_table(particulars.draught.map(|_| by_user));
    let conventions = Conventions { assumed, given, ..Conventions::default() };
    // All draughts in one pass over the surface.
    let mut draughts = default_draughts(particulars.draught, particulars.depth);
    draughts.extend(particulars.draught);
    let mut table = CurvesOfForm::new(&fitted.hull, &draughts, &conventions);
    let design_row = particulars.draught.and_then(|_| table.rows.pop());
    let estimate = VolumeEstimate::new(&job.table, &job.method.method, &fitted.hull, fitted.hull.reference_height());
    let mut warnings = overshoot::warnings(&job.table, &fitted.hull, design_row.as_ref());
    warnings.extend(drawn_doubt(&job.table, &fitted.hull));
    warnings.extend(spacing_doubts(&job.table, &fitted.hull));
    warnings.extend(design_row.as_ref().and_then(unusual));
    // The page has those of the reading among its notes.
    let all: Vec<String> = job.warnings().map(remark).chain(warnings.iter().cloned()).collect();
    let summary = summary(job, &fitted, &estimate, &all, design_row.as_ref(), &conventions);

    let surface = fitted.surface_table(&job.table);
    let endings = surface.endings.iter().flatten().any(Option::is_some);
    let hull = write_hull(&fitted.hull, &conventions).map_err(|e| Failure::Internal(format!("hull.json: {e}")))?;
    let mut files = vec![
        OutputFile::text("hull.json", hull),
        OutputFile::text("offsets.csv", offsets_csv(&surface, job.table.form.notation, endings)),
        OutputFile::text("residuals.csv", residuals_csv(&job.table, &fitted)),
        OutputFile::text("hydrostatics.csv", hydrostatics_csv(&table)),
        json_file("fit.json", &summary)?,
    ];
    let (source, dense) = (job.inputs.first().map(source_words), OnceLock::new());
    let (source, dense) = (source.as_deref(), Some(&dense));
    let inputs = FigureInputs {
        hull: &fitted.hull,
        before: None,
        record: None,
        design: design_row.as_ref(),
        curves: &table,
        source,
        dense,
    };
    files.extend(figure_files(&inputs, figures)?);
    files.sort_by(|a, b| a.name.cmp(&b.name));
    let input = job.inputs.first().cloned().ok_or_else(|| Failure::Internal("no input".to_owned()))?;
    let manifest = manifest_file(input, &files)?;
    files.push(manifest);
    Ok(FitOutputs { fitted, estimate, warnings, design_row, table, summary, files })
}

/// A length \[m\] that may be as small as rounding.
fn small(value: f64) -> String {
    if value < 5e-7 && value > 0.0 { format!("{value:.0e}") } else { format!("{value:.4}") }
}

/// Remarks about the table that the page shows.
const MOST_REMARKS: usize = 12;

/// What the surface leaves at the cells and at the points of sections.
fn misfit_lines(job: &FitJob, fitted: &Fitted) -> String {
    let mut lines = String::new();
    let misfit = fitted.misfit();
    let points = PointMisfit::new(&fitted.points(&job.table));
    if misfit.given + misfit.predicted > 0 || points.is_none() {
        let worst = misfit.worst.and_then(|cell| {
            let station = &job.table.stations.get(cell.station)?.station;
            let waterline = job.table.waterlines.get(cell.waterline)?;
            Some(format!(" (station {}, x {} m, waterline {waterline} m)", station.name, station.x))
        });
        let predicted = if misfit.predicted > 0 {
            format!("; {} predicted", counted(misfit.predicted, "cell"))
        } else {
            String::new()
        };
        let line = format!(
            "{}, missed by {} m at most{}, {} m RMS{predicted}.",
            counted(misfit.given, "cell"),
            small(misfit.largest()),
            worst.filter(|_| misfit.largest() >= 5e-7).unwrap_or_default(),
            small(misfit.rms)
        );
        lines.push_str(&wrapped(&line, 2));
    }
    if let Some(points) = points {
        let worst = &points.worst;
        let station = job.table.stations.get(worst.station).map(|s| s.station.words()).unwrap_or_default();
        let line = format!(
            "{} of sections, missed in half-breadth by {} m at most ({station}, z {:.3} m), {} m RMS.",
            counted(points.count, "point"),
            small(worst.residual().abs()),
            worst.height,
            small(points.rms)
        );
        lines.push_str(&wrapped(&line, 2));
    }
    lines
}

/// The page of `fit`, at most 80 columns wide.
#[must_use]
pub fn fit_page(job: &FitJob, outputs: &FitOutputs, folder: &str) -> String {
    let fitted = &outputs.fitted;
    let p = fitted.hull.particulars();
    let conventions = &outputs.table.conventions;
    let name: String = job.table.name.chars().take(WIDTH - 40).collect();
    let mut page = format!("{name} ({}, {} chart)\n", job.method.method.as_str(), chart_word(fitted.chart));
    let length = p.length_between_perpendiculars;
    page.push_str(&(dimensions(p) + "\n"));
    page.push_str(&misfit_lines(job, fitted));
    let below = match p.draught {
        Some(_) => String::new(),
        None => format!(" below z = {:.3} m", fitted.hull.reference_height()),
    };
    page.push_str(&wrapped(&format!("{}{below}.", outputs.estimate.words()), 2));
    let suspects = suspects_doubt(&job.table, &job.suspects);
    for warning in outputs.warnings.iter().chain(&suspects) {
        page.push_str(&wrapped(&format!("WARNING: {warning}"), 2));
    }
    for note in &fitted.notes {
        page.push_str(&wrapped(&format!("- {note}"), 2));
    }
    for note in job.reading.iter().take(MOST_REMARKS) {
        page.push_str(&wrapped(&format!("- {}", remark(note)), 2));
    }
    if job.reading.len() > MOST_REMARKS {
        let more = job.reading.len() - MOST_REMARKS;
        page.push_str(&format!("- {} about the table: fit.json, \"reading\"\n", counted(more, "more remark")));
    }
    page.push('\n');
    match &outputs.design_row {
        Some(row) => page.push_str(&quantities(row, conventions, length)),
        None => page.push_str(&wrapped(&no_draught(), 2)),
    }
    page.push('\n');
    page.push_str(&wrapped(&conventions_line(conventions), 2));
    let names: Vec<&str> = outputs.files.iter().map(|file| file.name.as_str()).collect();
    page.push_str(&wrapped(&format!("Written to {folder}: {}.", names.join(", ")), 2));
    page
}
