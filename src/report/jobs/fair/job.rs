//! The job of `fair`: a table of offsets or a job file in, the fair hull with its certificate out. Nothing is written
//! here.

use crate::fairing::strength::Fairness;
use std::path::{Path, PathBuf};

use serde_json::Value;

use crate::config::{self, Diagnostic, JobFile};
use crate::exchange::{
    COMPROMISE_LINE, CurveProblem, ManifestEntry, RoundingEffect, Severity, TableProblem, read_curve, write_hull,
};
use crate::fairing::ProposedLine;
use crate::fairing::error::FairError;
use crate::fairing::job::{Job, JobError};
use crate::fairing::outcome::Outcome;
use crate::hull::{FitError, Hull, HullError, OffsetTable, TableLayout};
use crate::hydrostatics::{Assumed, Conventions, CurvesOfForm, Given, Hydrostatics};
use crate::qp::Status;
use crate::report::failure::{Failure, problem};
use crate::report::input::source::{Overrides, is_toml, merged, read_bytes, read_table_stated, ship_name, utf8};
use crate::report::output::files::OutputFile;
use crate::report::output::manifest::manifest_entry;
use crate::units::Notation;

/// A table, and the targets for it.
#[derive(Debug, Clone)]
pub struct FairJob {
    /// The table, with what the job says of its dimensions.
    pub table: OffsetTable,
    /// The job.
    pub job: Job,
    /// What was detected and assumed when the table was read.
    pub reading: Vec<TableProblem>,
    /// Conventions of what is printed.
    pub conventions: Conventions,
    /// Conventions of the table over those of the file beside it.
    pub(in crate::report) table_conventions: Overrides,
    /// Whether the table is faired at all whole grades of fairness besides.
    pub grades: bool,
    pub(in crate::report) table_file: PathBuf,
    /// Name and text of the conventions beside the table.
    pub(in crate::report) sidecar: Option<(String, String)>,
    /// What file and options say, with its places.
    pub(in crate::report) request: JobFile,
    /// The files that were read; the first is the one that the command named.
    pub(in crate::report) inputs: Vec<ManifestEntry>,
    pub(in crate::report) files: Vec<PathBuf>,
}

/// What fairing gives.
#[derive(Debug, Clone)]
pub struct FairOutputs {
    /// The hull, what moved and what holds.
    pub outcome: Outcome,
    /// What writing the table in its notation did.
    #[doc(hidden)]
    pub rounding: RoundingEffect,
    /// Hydrostatics at the design draught, before and after; none where no draught is stated.
    pub rows: Option<[Hydrostatics; 2]>,
    /// The contents of `fairing.json`.
    pub certificate: Value,
    /// The files, in the order of their names; the manifest is the last.
    pub files: Vec<OutputFile>,
    pub(in crate::report) table_file: PathBuf,
    /// What file and options say, with its places.
    pub(in crate::report) request: JobFile,
}

/// The table file of a job file.
fn table_of(path: &Path, job: &JobFile) -> Result<PathBuf, Failure> {
    if !is_toml(path) {
        return Ok(path.to_owned());
    }
    match job.table.as_ref().filter(|table| !table.trim().is_empty()) {
        Some(table) => Ok(path.parent().unwrap_or(Path::new("")).join(table)),
        None => {
            let help = "Write [table] file = \"FILE\" in it, or give the table to the command";
            Err(Failure::Input(vec![problem("E174", path, "the file names no table".to_owned(), help)]))
        }
    }
}

/// Reads what `fair` starts from: a table of offsets, or a job file (`.toml`) that names one. `options` override the
/// job file: name of the option, path of the key, text of the value.
///
/// # Errors
/// [`Failure::FileSystem`]; [`Failure::Input`] with every problem of the files and of the options; [`Failure::Usage`] with
/// those of the options where the files have none.
pub fn read_fair(path: &Path, options: &[(&str, &str, String)]) -> Result<FairJob, Failure> {
    read_fair_with(path, options, &Overrides::default())
}

/// The same, with conventions of the table over those of the file beside it.
///
/// # Errors
/// Those of [`read_fair`].
pub fn read_fair_with(
    path: &Path,
    options: &[(&str, &str, String)],
    table_conventions: &Overrides,
) -> Result<FairJob, Failure> {
    let (mut inputs, mut files) = (Vec::new(), Vec::new());
    let mut read = |path: &Path| -> Result<Vec<u8>, Failure> {
        let bytes = read_bytes(path)?;
        inputs.push(manifest_entry(path, &bytes));
        files.push(path.to_owned());
        Ok(bytes)
    };
    let mut problems = Vec::new();
    let mut request = JobFile::default();
    if is_toml(path) {
        match config::read_job(&path.display().to_string(), &utf8(path, read(path)?)?) {
            Ok(file) => request = file,
            Err(found) => problems.extend(found),
        }
    }
    let mut asked = JobFile::default();
    for (option, key, value) in options {
        match config::read_option(option, key, value) {
            Ok(option) => asked = asked.and(option),
            Err(found) => problems.extend(found),
        }
    }
    request = request.with(asked);
    if !problems.is_empty() {
        return Err(Failure::of_messages(problems));
    }
    let table_file = table_of(path, &request)?;
    read(&table_file)?;
    let beside_file = table_file.with_extension("toml");
    let sidecar = if beside_file.is_file() && beside_file != path {
        Some((beside_file.display().to_string(), utf8(&beside_file, read(&beside_file)?)?))
    } else {
        None
    };
    let (mut table, reading) = read_table_stated(&table_file, &request.stated, path, table_conventions)?;
    if table.name.trim().is_empty() {
        table.name = ship_name(&table_file);
    }
    let length = match table.stated.length_between_perpendiculars {
        Some(length) => length,
        None => {
            let hull = fitted(&table).map_err(|error| refusal(&request, &[], &table_file, &error.into()))?;
            hull.particulars().length_between_perpendiculars
        }
    };
    let area_file =
        request.area_file().map(|(file, place)| (path.parent().unwrap_or(Path::new("")).join(file), place.clone()));
    if let Some((file, place)) = area_file {
        let curve = read_curve(&utf8(&file, read(&file)?)?, Notation::Metres).map_err(|problems| {
            let of = |p: CurveProblem| Diagnostic { line: p.line, ..problem("E340", &file, p.message, p.remedy) };
            Failure::Input(problems.into_iter().map(of).collect())
        })?;
        let band = request.section_area_band;
        let rows = curve.points.iter().filter_map(|p| Some([p.x, p.y?, p.tolerance.unwrap_or(band)]));
        request.section_areas.extend(rows.map(|row| (row, place.clone())));
    }
    let job = request.for_table(&table, length).map_err(Failure::of_messages)?;
    let density = request.density.unwrap_or(Conventions::default().density);
    let assumed = Assumed::of(&table.stated);
    let by_user = request.stated.draught.is_some();
    let given = Given::of_table(table.stated.draught.map(|_| by_user));
    let given = Given { density: request.density.is_some(), ..given };
    let conventions = Conventions { density, assumed, given, ..Conventions::default() };
    let table_conventions = table_conventions.clone();
    Ok(FairJob {
        table,
        job,
        reading,
        conventions,
        table_conventions,
        grades: false,
        table_file,
        sidecar,
        request,
        inputs,
        files,
    })
}

/// The surface through a table.
pub(in crate::report) fn fitted(table: &OffsetTable) -> Result<Hull, FitError> {
    Hull::fit(table, &crate::hull::FitMethod::Graded).map(|fitted| fitted.hull)
}

/// Files that every fairing writes, besides the table.
const FILES: [&str; 7] = [
    "hull.json",
    "fitted-hull.json",
    "changes.csv",
    "control-polygon.csv",
    "fairing.json",
    "summary.json",
    "manifest.json",
];

impl FairJob {
    /// Names of the files that the job writes, whatever comes of it; figures are not among them.
    #[must_use]
    pub fn outputs(&self) -> Vec<String> {
        let conventions = conventions_beside(self).map(|_| "offsets.toml".to_owned());
        let grades = self.grades.then(grade_names).into_iter().flatten();
        FILES.map(str::to_owned).into_iter().chain([offsets_name(self)]).chain(conventions).chain(grades).collect()
    }

    /// The files that were read.
    #[must_use]
    pub fn files(&self) -> &[PathBuf] {
        &self.files
    }

    /// What reading the table had to guess.
    pub fn warnings(&self) -> impl Iterator<Item = &TableProblem> {
        self.reading.iter().filter(|problem| problem.severity == Severity::Warning)
    }

    /// Stations, waterlines, offsets on them and points of sections of the table.
    #[must_use]
    pub fn size(&self) -> [usize; 4] {
        let cells = self.table.stations.iter().flat_map(|station| &station.half_breadths);
        let given = cells.filter(|cell| cell.value().is_some()).count();
        let points = self.table.point_count();
        [self.table.stations.len(), self.table.waterlines.len(), given, points]
    }
}

/// Name of the table.
pub(in crate::report) const GRADES_TABLE: &str = "grades.csv";

/// Name of the file of the hull at a grade.
pub(in crate::report) fn grade_hull(grade: Fairness) -> String {
    format!("grades/{}/hull.json", grade.grade())
}

/// Names of the files, besides the picture.
pub(in crate::report) fn grade_names() -> impl Iterator<Item = String> {
    std::iter::once(GRADES_TABLE.to_owned()).chain(Fairness::whole().map(grade_hull))
}

/// Name of the file of the fair table: `offsets.csv`, or with the extension of the other program's format it is written
/// in.
pub(in crate::report) fn offsets_name(job: &FairJob) -> String {
    let extension = job.table_file.extension().map(|e| e.to_string_lossy().to_lowercase());
    match (job.table.form.layout, job.table.form.program, extension) {
        (TableLayout::Other, Some(_), Some(extension)) => format!("offsets.{extension}"),
        _ if job.table.form.sheet.is_some() => "offsets.xlsx".to_owned(),
        _ => "offsets.csv".to_owned(),
    }
}

/// What the name of a hull ends with that does not meet all targets: it stands on every drawing and in every file that
/// has the name.
const COMPROMISE: &str = " (compromise)";

/// A name without the mark of an earlier fairing, and with it where `compromise`.
pub(in crate::report) fn marked_name(name: &str, compromise: bool) -> String {
    let plain = name.trim_end_matches(COMPROMISE);
    format!("{plain}{}", if compromise { COMPROMISE } else { "" })
}

/// What the line of a compromise begins with, that of an older program too.
const COMPROMISE_START: &str = "# compromise: not all ";

/// Marks a table, and takes the mark of an earlier fairing away.
pub(in crate::report) fn mark(table: &mut OffsetTable, compromise: bool) {
    table.name = marked_name(&table.name, compromise);
    table.form.preamble.retain(|line| !line.starts_with(COMPROMISE_START));
    if compromise {
        table.form.preamble.insert(0, COMPROMISE_LINE.to_owned());
    }
}

/// The dimensions that the job says, and the conventions of the table that the command says.
pub(in crate::report) fn overrides(job: &FairJob) -> Overrides {
    let dimensions = Overrides::dimensions(&job.request.stated, job.files.first().unwrap_or(&job.table_file));
    dimensions.and(&job.table_conventions)
}

/// What the table leaves open belongs to the new one as well: the conventions beside it, with the dimensions that the
/// job says.
pub(in crate::report) fn conventions_beside(job: &FairJob) -> Option<String> {
    merged(job.sidecar.as_ref().map(|(_, text)| text.clone()), &overrides(job))
}

/// The keys of the dimensions with which the table makes no hull.
fn dimensions_at_fault(error: &JobError) -> &'static [&'static str] {
    match error {
        JobError::Draught { .. } => &["dimensions.T", "dimensions.D"],
        JobError::NoDraught(_) => &["dimensions.T"],
        JobError::Breadth { .. } => &["dimensions.B"],
        JobError::Length { .. } => &["dimensions.Lpp"],
        JobError::Fit(FitError::Hull(hull)) | JobError::Hull(hull) | JobError::Fair(FairError::Hull(hull)) => {
            match hull {
                HullError::Draught { .. } => &["dimensions.T", "dimensions.D"],
                HullError::Aground { .. } => &["dimensions.T"],
                HullError::Breadths { .. } => &["dimensions.B"],
                _ => &[],
            }
        }
        _ => &[],
    }
}

/// Why nothing was faired, at the place of the job that is infeasible; `lines` are the lines of the job
/// as the table has them.
fn refusal(request: &JobFile, lines: &[ProposedLine], table_file: &Path, error: &JobError) -> Failure {
    // An option comes after the job and is what was changed last.
    let first = |keys: &[&str]| keys.iter().filter_map(|key| request.place(key)).min_by_key(|place| !place.is_option());
    let (code, place, help) = match error {
        JobError::Fair(FairError::Rules(list)) => {
            let help = "Look at the hull with `loftsman fit` and `loftsman inspect`";
            let at = |(rule, why): &(usize, String)| Some(request.rules.get(*rule)?.place.problem("E176", why, help));
            return Failure::of_messages(list.iter().filter_map(at).collect());
        }
        JobError::NoCourse { course, kind, at } => {
            let same =
                |line: &ProposedLine| (line.course, line.kind) == (*course, *kind) && line.at.total_cmp(at).is_eq();
            let line = lines.iter().position(same).and_then(|line| request.lines.get(line));
            let help = "Take a waterline or a station that runs along the net of the surface, or declare the line beside the table";
            ("E180", line.map(|line| &line.place), help)
        }
        JobError::Apart { coefficient, .. } => {
            let key = if *coefficient == "block_coefficient" { "hold.Cb" } else { "hold.Cm" };
            ("E170", first(&[key]), "Give one of them")
        }
        JobError::NoLine { .. } => {
            let help = "Run without it: --verbose and fairing.json list what is proposed";
            ("E180", first(&["lines.accept"]), help)
        }
        JobError::Fair(FairError::Waves(_) | FairError::NoWaves) => {
            let help = "Leave it out, or fair a table with a level keel, level waterlines and fewer lines";
            ("E425", first(&["waves.froude_numbers"]), help)
        }
        _ => {
            let place = first(dimensions_at_fault(error));
            let help = "Look at the table with `loftsman check` and `loftsman fit`";
            ("E175", place, if place.is_some() { "" } else { help })
        }
    };
    Failure::of_messages(vec![match place {
        Some(place) => place.problem(code, &error.to_string(), help),
        None => problem(code, table_file, error.to_string(), help),
    }])
}

/// Why the table of a job was not faired.
pub(in crate::report) fn refused(job: &FairJob, error: &JobError) -> Failure {
    refusal(&job.request, &job.job.lines, &job.table_file, error)
}

/// Hydrostatics at the design draught; none where none is stated.
pub(in crate::report) fn row(job: &FairJob, hull: &Hull) -> Option<Hydrostatics> {
    CurvesOfForm::new(hull, &[hull.particulars().draught?], &job.conventions).rows.pop()
}

pub(in crate::report) fn hull_text(job: &FairJob, name: &str, hull: &Hull) -> Result<OutputFile, Failure> {
    let text = write_hull(hull, &job.conventions).map_err(|e| Failure::Internal(format!("{name}: {e}")))?;
    Ok(OutputFile::text(name, text))
}

/// The fair hull of an outcome, marked where it does not meet all targets.
pub(in crate::report) fn hull_file(job: &FairJob, name: &str, outcome: &Outcome) -> Result<OutputFile, Failure> {
    let marked = marked_name(outcome.after.name(), outcome.status != Status::Optimal);
    hull_text(job, name, &outcome.after.clone().with_name(marked))
}
