//! Validation: tables of offsets of known hulls, fitted, against what is published about these hulls.
//!
//! Beside each figure stands an estimate of what the table itself leaves open ([`Thinned`]): a third of the change of the
//! figure when every second station is left out plus a third of the change when every second waterline (or point of a
//! section) is, both fitted afresh. Where that is larger than a difference, the difference says nothing about the fit.

mod page;
mod reference;

use std::fs;
use std::path::{Path, PathBuf};

use super::validate::reference::{CentreDatum, Figure, Reference};
use crate::exchange::Severity;
use crate::hull::{Chart, FitMethod, Hull, OffsetTable, PointResidual, Thinned};
use crate::hydrostatics::{Conventions, CurvesOfForm, Hydrostatics, Quantity};
use crate::report::failure::Failure;
use crate::report::input::source::read_table_file;
pub use page::{validation_csv, validation_json, validation_page};
pub use reference::Tolerance;

/// Whether a difference is within the tolerance.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Verdict {
    /// Within it.
    Within,
    /// Beyond it.
    Exceeded,
    /// There is no tolerance, or the table has fewer than three waterlines up to this draught.
    NotJudged,
    /// The hull has no such quantity.
    Missing,
}

impl Verdict {
    /// The word in tables.
    #[must_use]
    pub fn as_str(self) -> &'static str {
        match self {
            Self::Within => "ok",
            Self::Exceeded => "EXCEEDED",
            Self::NotJudged => "-",
            Self::Missing => "MISSING",
        }
    }
}

/// One figure: theirs and ours.
#[derive(Debug, Clone, PartialEq)]
pub struct Comparison {
    /// ITTC code of the quantity.
    pub key: &'static str,
    /// From where a centre is measured, in words; empty for other quantities.
    pub measured: &'static str,
    /// Unit.
    pub unit: &'static str,
    /// `published`, `exact` (closed form) or `check` (another integration of the same table).
    pub basis: &'static str,
    /// Draught \[m\].
    pub draught: f64,
    /// Theirs.
    pub theirs: f64,
    /// Ours.
    pub ours: Option<f64>,
    /// Estimated error from the spacing of stations and of waterlines together, see [`Thinned`].
    pub left_out: Option<f64>,
    /// What it may differ by.
    pub tolerance: Option<Tolerance>,
    /// Whether it does.
    pub verdict: Verdict,
}

impl Comparison {
    /// The verdict, and why when there is none.
    #[must_use]
    pub fn judgement(&self) -> String {
        match (self.verdict, self.tolerance) {
            (Verdict::NotJudged, None) => "not judged: no tolerance".to_owned(),
            (Verdict::NotJudged, Some(_)) => "not judged: fewer than 3 waterlines".to_owned(),
            (verdict, _) => verdict.as_str().to_owned(),
        }
    }

    /// Ours less theirs.
    #[must_use]
    pub fn difference(&self) -> Option<f64> {
        self.ours.map(|ours| ours - self.theirs)
    }

    /// Ours less theirs in % of theirs; none for theirs 0 and for centres, whose origin is a convention.
    #[must_use]
    pub fn percent(&self) -> Option<f64> {
        let centre = matches!(self.key, "XCB" | "XCBPC" | "XWL");
        self.difference().filter(|_| !centre && self.theirs.abs() > 0.0).map(|d| 100.0 * d / self.theirs)
    }
}

/// One hull.
#[derive(Debug, Clone, PartialEq)]
pub struct Case {
    /// Its folder.
    pub folder: PathBuf,
    /// Name of its folder.
    pub name: String,
    /// Title in its reference.
    pub title: String,
    /// Source of the figures.
    pub source: String,
    /// File of the table.
    pub table: String,
    /// Chart of the fit; none when nothing could be fitted.
    pub chart: Option<Chart>,
    /// Largest |surface - table| over cells and points of sections \[m\].
    pub residual: Option<f64>,
    /// The figures.
    pub comparisons: Vec<Comparison>,
    /// What was assumed or left aside.
    pub notes: Vec<String>,
    /// Why there is no hull; none when there is one.
    pub failure: Option<String>,
}

impl Case {
    /// Whether the hull could be made and every tolerance is kept.
    #[must_use]
    pub fn passed(&self) -> bool {
        let kept = |c: &Comparison| matches!(c.verdict, Verdict::Within | Verdict::NotJudged);
        self.failure.is_none() && self.comparisons.iter().all(kept)
    }
}

fn text_of(path: &Path) -> Result<String, Failure> {
    fs::read_to_string(path).map_err(|error| Failure::FileSystem { act: "read", path: path.to_owned(), error })
}

fn entries(folder: &Path) -> Result<Vec<PathBuf>, Failure> {
    let failure = |error| Failure::FileSystem { act: "read", path: folder.to_owned(), error };
    let mut paths = Vec::new();
    for entry in fs::read_dir(folder).map_err(failure)? {
        paths.push(entry.map_err(failure)?.path());
    }
    paths.sort();
    Ok(paths)
}

/// Validates every folder of `folders` that holds a `reference.toml`, and every folder right below them that does.
/// Folders without a table of offsets or without figures are passed over.
///
/// # Errors
/// [`Failure::FileSystem`]; [`Failure::Usage`] when there is no such folder, or a reference cannot be read.
pub fn validate(folders: &[PathBuf]) -> Result<Vec<Case>, Failure> {
    let mut cases = Vec::new();
    for folder in folders {
        let mut inside = vec![folder.clone()];
        inside.extend(entries(folder)?.into_iter().filter(|path| path.is_dir()));
        for folder in inside.into_iter().filter(|path| path.join("reference.toml").is_file()) {
            cases.extend(validate_folder(&folder)?);
        }
    }
    if cases.is_empty() {
        return Err(Failure::Usage("no folder with a table of offsets and a reference.toml with figures".to_owned()));
    }
    Ok(cases)
}

fn validate_folder(folder: &Path) -> Result<Option<Case>, Failure> {
    let path = folder.join("reference.toml");
    let published = entries(folder)?
        .into_iter()
        .find(|path| path.file_name().is_some_and(|name| name.to_string_lossy().ends_with("hydrostatics.csv")));
    let published = published.map(|path| text_of(&path)).transpose()?;
    let reference = reference::read(&text_of(&path)?, published.as_deref())
        .map_err(|message| Failure::Usage(format!("{}: {message}", path.display())))?;
    let files = match &reference.table {
        Some(file) => vec![file.clone()],
        None => ["sections.csv", "offsets.csv"].map(str::to_owned).to_vec(),
    };
    let files: Vec<String> = files.into_iter().filter(|file| folder.join(file).is_file()).collect();
    if files.is_empty() || reference.figures.is_empty() {
        return Ok(None);
    }
    let name = folder.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    let mut failures = Vec::new();
    for file in files {
        match attempt(folder, &file, &name, &reference) {
            Ok(mut case) => {
                case.notes.extend(failures);
                return Ok(Some(case));
            }
            Err(message) => failures.push(format!("{file}: {message}")),
        }
    }
    Ok(Some(Case {
        folder: folder.to_owned(),
        name,
        title: reference.title,
        source: reference.source,
        table: String::new(),
        chart: None,
        residual: None,
        comparisons: Vec::new(),
        notes: Vec::new(),
        failure: Some(failures.join("; ")),
    }))
}

/// The table in the frame of the hull, with the particulars that the reference adds.
fn prepared(mut table: OffsetTable, reference: &Reference, notes: &mut Vec<String>) -> OffsetTable {
    let stated = &mut table.stated;
    stated.length_between_perpendiculars = stated.length_between_perpendiculars.or(reference.length);
    stated.breadth = stated.breadth.or(reference.breadth);
    stated.draught = stated.draught.or(reference.draught);
    stated.depth = stated.depth.or(reference.depth);
    let ends = table.stations.first().zip(table.stations.last()).map(|(a, b)| [a.station.x, b.station.x]);
    if let (Some(length), Some([aft, fore])) = (reference.length, ends) {
        // A table from -L/2 to L/2 counts from midship, whatever its reader could know.
        if (aft + fore).abs() < 0.02 * length && aft < -0.4 * length {
            for column in &mut table.stations {
                column.station.x += 0.5 * length;
            }
            for x in table.endings.iter_mut().flatten().flatten() {
                *x += 0.5 * length;
            }
            notes.push("x counts from midship in the table".to_owned());
        }
    }
    table
}

fn attempt(folder: &Path, file: &str, name: &str, reference: &Reference) -> Result<Case, String> {
    let (table, remarks) = read_table_file(&folder.join(file)).map_err(|failure| failure.to_string())?;
    let remarks = remarks.iter().filter(|remark| remark.severity == Severity::Warning);
    let mut notes: Vec<String> = remarks.map(|remark| format!("{}: {}", remark.code, remark.message)).collect();
    let table = prepared(table, reference, &mut notes);
    let draughts: Vec<f64> = reference.figures.iter().map(|figure| figure.draught).collect();
    let fitted = Hull::fit(&table, &FitMethod::default()).map_err(|error| error.to_string())?;
    notes.extend(fitted.notes.iter().cloned());
    let rows = rows(&fitted.hull, &draughts);
    let thinned = Thinned::new(&table, &FitMethod::default(), fitted.hull.reference_height());
    let thinner: Vec<Vec<Hydrostatics>> = [&thinned.stations, &thinned.waterlines]
        .into_iter()
        .flatten()
        .map(|thin| self::rows(thin, &draughts))
        .collect();
    let length = fitted.hull.particulars().length_between_perpendiculars;
    // How far the table was moved when it was read.
    let moved = reference.aftmost.zip(table.stations.first()).map_or(0.0, |(x, first)| first.station.x - x);
    if moved.abs() > 1e-3 {
        notes.push(format!("centres that count from the x of the file are compared there: AP is at x {:.3} m", -moved));
    }
    let origin = Frame { length, moved };
    let comparisons = reference.figures.iter().enumerate().map(|(k, figure)| {
        let ours = value(figure, &rows[k], origin);
        let changes = thinner.iter().map(|rows| Some(Thinned::error(ours?, value(figure, &rows[k], origin)?)));
        // Both, or nothing is said.
        let left_out = changes.sum::<Option<f64>>().filter(|_| thinner.len() == 2);
        compare(figure, ours, left_out, &table)
    });
    let comparisons = comparisons.collect();
    if !reference.unread.is_empty() {
        notes.push(format!("not compared: {}", reference.unread.join(", ")));
    }
    let points = fitted.points(&table);
    let residuals = fitted.cells.iter().filter_map(|cell| cell.residual);
    let residual = residuals.chain(points.iter().map(PointResidual::residual)).map(f64::abs).reduce(f64::max);
    Ok(Case {
        folder: folder.to_owned(),
        name: name.to_owned(),
        title: reference.title.clone(),
        source: reference.source.clone(),
        table: file.to_owned(),
        chart: Some(fitted.chart),
        residual,
        comparisons,
        notes,
        failure: None,
    })
}

fn rows(hull: &Hull, draughts: &[f64]) -> Vec<Hydrostatics> {
    CurvesOfForm::new(hull, draughts, &Conventions::default()).rows
}

/// Where centres are measured from.
#[derive(Debug, Clone, Copy)]
struct Frame {
    /// Lpp \[m\].
    length: f64,
    /// Our x less that of the file \[m\].
    moved: f64,
}

/// Our value of a figure, measured as theirs is.
fn value(figure: &Figure, row: &Hydrostatics, Frame { length, moved }: Frame) -> Option<f64> {
    let quantity = Quantity::of(figure.known.key)?;
    let value = (quantity.value)(row).filter(|value| value.is_finite())?;
    Some(match figure.known.origin {
        CentreDatum::Plain => value,
        CentreDatum::Forward => value - 0.5 * length,
        CentreDatum::Aft => 0.5 * length - value,
        CentreDatum::Table => value - moved,
    })
}

fn compare(figure: &Figure, ours: Option<f64>, left_out: Option<f64>, table: &OffsetTable) -> Comparison {
    let quantity = Quantity::of(figure.known.key);
    // Between the base line and the first waterline above it a table says nothing.
    let lines = table.waterlines.iter().filter(|&&z| z <= figure.draught + 1e-9).count();
    let is_known = lines >= 3 || table.waterlines.is_empty();
    let verdict = match (ours, figure.tolerance.filter(|_| is_known)) {
        (None, _) => Verdict::Missing,
        (Some(_), None) => Verdict::NotJudged,
        (Some(ours), Some(tolerance)) => {
            let allowed = match tolerance {
                Tolerance::Absolute(allowed) => allowed,
                Tolerance::Percent(percent) => 0.01 * percent * figure.value.abs(),
            };
            if (ours - figure.value).abs() <= allowed { Verdict::Within } else { Verdict::Exceeded }
        }
    };
    Comparison {
        key: figure.known.key,
        measured: match figure.known.origin {
            CentreDatum::Plain => "",
            CentreDatum::Forward => "from midship, + forward",
            CentreDatum::Aft => "from midship, + aft",
            CentreDatum::Table => "from x = 0 of the file",
        },
        unit: quantity.map_or("", |quantity| quantity.unit),
        basis: figure.section,
        draught: figure.draught,
        theirs: figure.value,
        ours,
        left_out,
        tolerance: figure.tolerance,
        verdict,
    }
}
