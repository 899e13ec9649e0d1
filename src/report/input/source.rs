//! What a job starts from: a design file, or a hull.

use std::fs;
use std::io::{ErrorKind, Read as _};
use std::path::{Component, Path, PathBuf};
use std::sync::OnceLock;

use super::carried::{catalogue_bytes, catalogue_ending, without_prefix};
use super::doubts::{drawn_doubt, spacing_doubts, suspects_doubt};
use crate::config::{self, Design, Diagnostic, Severity};
use crate::exchange::{self, HullFile, HullFileError, ReadTable, TableProblem};
use crate::fairing::suspects;
use crate::hull::{Cut, FitError, FitMethod, Hull, OffsetStation, OffsetTable, Section, StatedParticulars};
use crate::hydrostatics::{Assumed, Conventions, Given};
use crate::parametric::{Family, Generated};
use crate::report::failure::{COMMAND_LINE, Failure, problem};
use crate::report::words::remarks::{is_warning, without_folder};
use crate::units::{counted, name_fault};

/// A hull with the conventions of its tables.
#[derive(Debug, Clone)]
pub struct Source {
    /// The hull.
    pub hull: Hull,
    /// Conventions it was made with.
    pub conventions: Conventions,
    /// What was assumed where a table of offsets says nothing, in words for the user.
    pub notes: Vec<String>,
    /// The file that was read.
    pub file: PathBuf,
}

impl Source {
    /// Those of the notes that are warnings, for files: without the folder of the input.
    #[must_use]
    pub fn warnings(&self) -> Vec<String> {
        self.notes.iter().filter(|note| is_warning(note)).map(|note| without_folder(note, &self.file)).collect()
    }
}

/// No input but a body is longer than this \[bytes\]; the readers have limits of their own.
const LARGEST_INPUT: u64 = exchange::LARGEST_HULL_FILE as u64;

/// No mesh or CAD file is longer than this \[bytes\].
const LARGEST_BODY: u64 = 1 << 30;

/// Of standard input so much is looked at to find its kind \[bytes\].
const CONTENT: usize = 1 << 16;

/// Endings of meshes and CAD files.
const BODIES: [&str; 18] = [
    "3dm", "stl", "obj", "ply", "off", "glb", "gltf", "3mf", "vtk", "vtp", "vtu", "msh", "hst", "step", "stp", "igs",
    "iges", "dxf",
];

/// Whether a path is standard input: `-`.
fn is_standard_input(path: &Path) -> bool {
    path.as_os_str() == "-"
}

/// Standard input, which is read once.
fn standard_input() -> Result<Vec<u8>, Failure> {
    static READ: OnceLock<Result<Vec<u8>, ErrorKind>> = OnceLock::new();
    let read = READ.get_or_init(|| {
        let mut bytes = Vec::new();
        let done = std::io::stdin().lock().take(LARGEST_BODY + 1).read_to_end(&mut bytes);
        done.map(|_| bytes).map_err(|error| error.kind())
    });
    read.clone().map_err(|kind| Failure::FileSystem { act: "read", path: "standard input".into(), error: kind.into() })
}

/// The ending of the name of a file in lower case; of standard input that of a file with its content.
pub(in crate::report) fn ending(path: &Path) -> String {
    if let Some(ending) = catalogue_ending(path) {
        return ending.to_owned();
    }
    if !is_standard_input(path) {
        return path.extension().map(|e| e.to_string_lossy().to_lowercase()).unwrap_or_default();
    }
    let bytes = standard_input().unwrap_or_default();
    let text = String::from_utf8_lossy(&bytes[..bytes.len().min(CONTENT)]);
    let mut lines = text.lines().map(str::trim).filter(|line| !line.is_empty() && !line.starts_with('#'));
    let first = lines.next().unwrap_or("");
    let is_key = |key: &str| !key.is_empty() && key.chars().all(|c| c.is_alphanumeric() || "._-\" ".contains(c));
    if first.starts_with('{') {
        "json".to_owned()
    } else if first.starts_with('[') || first.split_once('=').is_some_and(|(key, _)| is_key(key.trim())) {
        "toml".to_owned()
    } else if first.split(',').any(|head| head.trim() == "HullData") {
        "hgf".to_owned()
    } else {
        String::new()
    }
}

/// Refuses a file whose name no drawing can show, before any work is done.
fn name_of_file(path: &Path) -> Result<(), Failure> {
    let name = path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    match name_fault(&name) {
        None => Ok(()),
        Some(fault) => Err(Failure::Input(vec![problem("E132", path, fault, "Rename the file")])),
    }
}

pub(in crate::report) fn read_bytes(path: &Path) -> Result<Vec<u8>, Failure> {
    if let Some(bytes) = catalogue_bytes(path) {
        return bytes;
    }
    if is_standard_input(path) {
        return standard_input();
    }
    name_of_file(path)?;
    let failure = |error: std::io::Error| {
        let named = without_prefix(path).filter(|_| error.kind() == ErrorKind::NotFound);
        named.unwrap_or_else(|| Failure::FileSystem { act: "read", path: path.to_owned(), error })
    };
    let body = path.extension().is_some_and(|e| BODIES.iter().any(|known| e.eq_ignore_ascii_case(known)));
    let most = if body { LARGEST_BODY } else { LARGEST_INPUT };
    let mut bytes = Vec::new();
    // One byte more than may be read tells a file that is too long, also one without an end.
    fs::File::open(path).and_then(|file| file.take(most + 1).read_to_end(&mut bytes)).map_err(failure)?;
    if bytes.len() as u64 > most {
        let message = format!("the file has more than {most} bytes; longer ones are not read");
        return Err(Failure::Input(vec![diagnostic("E129", path, None, None, message)]));
    }
    if ending(path) == "gltf" {
        let mut left = LARGEST_BODY;
        let beside = |name: &str| {
            let is_inside = Path::new(name).components().all(|part| matches!(part, Component::Normal(_)));
            let file = is_inside.then(|| fs::File::open(path.with_file_name(name)).ok()).flatten()?;
            let mut found = Vec::new();
            file.take(left + 1).read_to_end(&mut found).ok()?;
            left = left.checked_sub(found.len() as u64)?;
            Some(found)
        };
        bytes = exchange::with_buffers(&bytes, beside).unwrap_or(bytes);
    }
    Ok(bytes)
}

fn diagnostic(
    code: &'static str,
    file: &Path,
    line: Option<usize>,
    column: Option<usize>,
    message: String,
) -> Diagnostic {
    Diagnostic { line, column, ..problem(code, file, message, "") }
}

pub(in crate::report) fn utf8(path: &Path, bytes: Vec<u8>) -> Result<String, Failure> {
    String::from_utf8(bytes).map_err(|error| {
        let at = error.utf8_error().valid_up_to();
        let line = error.as_bytes()[..at].iter().filter(|&&b| b == b'\n').count() + 1;
        let message = format!("byte {at} is not UTF-8 text");
        Failure::Input(vec![diagnostic("E129", path, Some(line), None, message)])
    })
}

/// The design of a file, TOML or `.hgf` by its name, and its bytes.
///
/// # Errors
/// [`Failure::FileSystem`], [`Failure::Input`].
pub fn read_design(path: &Path) -> Result<(Design, Vec<u8>), Failure> {
    let bytes = read_bytes(path)?;
    let text = utf8(path, bytes.clone())?;
    let shown = path.display().to_string();
    let extension = ending(path);
    if matches!(extension.as_str(), "hgf" | "huf") {
        let ship = exchange::read_hgf(&text).map_err(|errors| {
            let messages = errors.iter().map(|error| {
                // The line stands in the place of the message already.
                let message = error.to_string();
                let message = match error.line() {
                    Some(line) => message
                        .trim_start_matches(&format!("line {line}"))
                        .trim_start_matches([':', ',', ' '])
                        .to_owned(),
                    None => message,
                };
                diagnostic("E130", path, error.line(), None, message)
            });
            Failure::Input(messages.collect())
        })?;
        let stem = path.file_stem().map(|s| s.to_string_lossy().into_owned()).unwrap_or_default();
        let name = if ship.name.is_empty() { stem } else { ship.name };
        return Ok((Design::new(&shown, &name, Family::UclCosh(ship.parameters)), bytes));
    }
    let mut design = config::read(&shown, &text).map_err(Failure::Input)?;
    if design.name == "-" {
        STANDARD_INPUT.clone_into(&mut design.name);
    }
    Ok((design, bytes))
}

/// What a ship is called that comes from standard input and has no name.
const STANDARD_INPUT: &str = "standard input";

/// Names of files that say what is in them and not of which ship.
const WORDS: [&str; 3] = ["offsets", "sections", "table"];

/// What a ship is called whose table has no name: the file, or its folder where the file is just `offsets`.
pub(in crate::report) fn ship_name(path: &Path) -> String {
    if is_standard_input(path) {
        return STANDARD_INPUT.to_owned();
    }
    let text = |name: Option<&std::ffi::OsStr>| name.map(|s| s.to_string_lossy().into_owned()).unwrap_or_default();
    let stem = text(path.file_stem());
    let folder = text(path.parent().and_then(Path::file_name));
    if WORDS.contains(&stem.to_lowercase().as_str()) && !folder.is_empty() { folder } else { stem }
}

/// Generates the hull of a design.
///
/// # Errors
/// [`Failure::Infeasible`] with every reason.
pub(in crate::report) fn build(design: &Design) -> Result<Generated, Failure> {
    design.family.generate(&design.name).map_err(|reasons| {
        // A value outside its own range is no target that another hull could meet: the input is wrong.
        let out_of_range = reasons.iter().any(|reason| reason.code == "E101");
        let messages = design.diagnose_all(&reasons);
        if out_of_range { Failure::Input(messages) } else { Failure::Infeasible(messages) }
    })
}

/// The files that are read of a hull, a design or a table at `path`: its own, or `hull.json` of a folder, and the
/// conventions beside it.
#[must_use]
pub fn source_files(path: &Path) -> Vec<PathBuf> {
    let file = if path.is_dir() { path.join("hull.json") } else { path.to_owned() };
    vec![file.with_extension("toml"), file]
}

/// The hull of a `hull.json`, of a folder that holds one, of a design file, or of a table of offsets or a mesh, through
/// which a surface is laid.
///
/// # Errors
/// [`Failure::FileSystem`], [`Failure::Input`], [`Failure::Infeasible`].
pub fn read_source(path: &Path) -> Result<Source, Failure> {
    read_source_with(path, &Overrides::default())
}

/// The same, with conventions of a table or body over those of its file.
///
/// # Errors
/// Those of [`read_source`]; [`Failure::Usage`] when conventions are given for a file that has its own.
pub fn read_source_with(path: &Path, overrides: &Overrides) -> Result<Source, Failure> {
    let file: PathBuf = if path.is_dir() { path.join("hull.json") } else { path.to_owned() };
    let extension = ending(&file);
    if matches!(extension.as_str(), "toml" | "hgf" | "huf") {
        overrides.refuse(&file)?;
        let (design, _) = read_design(&file)?;
        let hull = build(&design)?.hull;
        return Ok(Source { hull, conventions: design.conventions, notes: Vec::new(), file });
    }
    source_of(&file, read_bytes(&file)?, overrides)
}

/// The hull of a file, not a design, with these contents.
pub(in crate::report) fn source_of(file: &Path, bytes: Vec<u8>, overrides: &Overrides) -> Result<Source, Failure> {
    let extension = ending(file);
    let first = bytes.iter().find(|b| !b.is_ascii_whitespace());
    let is_json = extension == "json" || first.is_some_and(|&b| b == b'{');
    if !is_json || extension == "gltf" {
        return fitted(file, &bytes, overrides);
    }
    overrides.refuse(file)?;
    let text = utf8(file, bytes)?;
    match exchange::read_hull(&text) {
        Ok(HullFile { hull, conventions }) => {
            Ok(Source { hull, conventions, notes: Vec::new(), file: file.to_owned() })
        }
        Err(HullFileError::Json { line, column, field, message }) => {
            let found = diagnostic("E140", file, Some(line), Some(column), format!("{field}{message}"));
            Err(Failure::Input(vec![Diagnostic { help: AGAIN.to_owned(), ..found }]))
        }
        Err(error) => Err(Failure::Input(hull_faults("E141", file, &error))),
    }
}

/// What helps where a file of this program is damaged.
pub(in crate::report) const AGAIN: &str = "Run the command that wrote it again";

/// What is wrong with a hull file, each fault for itself.
pub(in crate::report) fn hull_faults(code: &'static str, file: &Path, error: &HullFileError) -> Vec<Diagnostic> {
    let (faults, help) = match error {
        HullFileError::Values(faults) => {
            (faults.clone(), "Correct it in the file, or run the command that wrote it again")
        }
        HullFileError::Version(_) => (vec![error.to_string()], ""),
        error => (vec![error.to_string()], AGAIN),
    };
    faults.into_iter().map(|fault| problem(code, file, fault, help)).collect()
}

/// Conventions of a table or a body that override those of the TOML beside it: a value for each key of its `[table]`.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Overrides {
    /// Keys and values, as they would stand in the file.
    pub keys: Vec<(&'static str, String)>,
    /// The file that says them; none: the command line.
    pub file: Option<PathBuf>,
}

impl Overrides {
    /// Main dimensions \[m\] that a job or a method file says, or the command line over it.
    pub(in crate::report) fn dimensions(stated: &StatedParticulars, path: &Path) -> Self {
        let dimensions = [
            ("Lpp", stated.length_between_perpendiculars),
            ("B", stated.breadth),
            ("T", stated.draught),
            ("D", stated.depth),
        ];
        let keys = dimensions.into_iter().filter_map(|(key, value)| Some((key, format!("{} m", value?)))).collect();
        Self { keys, file: is_toml(path).then(|| path.to_owned()) }
    }

    /// These and others.
    pub(in crate::report) fn and(mut self, others: &Self) -> Self {
        self.keys.extend(others.keys.iter().cloned());
        self
    }

    /// The conventions as a file: its name in messages, and its text.
    pub(in crate::report) fn text(&self) -> Option<(String, String)> {
        let lines: Vec<String> = self.keys.iter().map(|(key, value)| format!("{key} = {value:?}\n")).collect();
        (!lines.is_empty()).then(|| (self.origin(), format!("[table]\n{}", lines.concat())))
    }

    /// What says them, for messages.
    fn origin(&self) -> String {
        self.file.as_ref().map_or_else(|| COMMAND_LINE.to_owned(), |file| file.display().to_string())
    }

    /// Whether the command states the design draught.
    pub(in crate::report) fn states_draught(&self) -> bool {
        self.file.is_none() && self.keys.iter().any(|(key, _)| *key == "T")
    }

    /// The failure of problems of a table or a body.
    pub(in crate::report) fn refused(&self, problems: Vec<TableProblem>) -> Failure {
        Failure::of_messages(problems.into_iter().map(|problem| of_table(self.placed(problem))).collect())
    }

    /// A problem of [`Overrides::text`] has no place in a file.
    fn placed(&self, problem: TableProblem) -> TableProblem {
        if problem.file == self.origin() { TableProblem { row: None, column: None, ..problem } } else { problem }
    }

    /// A hull or a design says its units and axes itself.
    fn refuse(&self, path: &Path) -> Result<(), Failure> {
        if self.keys.is_empty() {
            return Ok(());
        }
        let keys: Vec<&str> = self.keys.iter().map(|(key, _)| *key).collect();
        let message = format!(
            "{} is a hull in metres and our axes; leave out its conventions: {}",
            path.display(),
            keys.join(", ")
        );
        Err(Failure::Usage(message))
    }
}

/// The name and the text of the TOML file of the same name beside a file, when there is one, and of its overrides.
pub(in crate::report) fn sidecar(path: &Path, overrides: &Overrides) -> Result<Vec<(String, String)>, Failure> {
    let sidecar = path.with_extension("toml");
    let mut list = Vec::new();
    if sidecar.is_file() {
        let text = utf8(&sidecar, read_bytes(&sidecar)?)?;
        list.push((sidecar.display().to_string(), text));
    }
    list.extend(overrides.text());
    Ok(list)
}

/// The conventions of a file for a copy of it: the text of the TOML file of the same name beside it, with others over it.
///
/// # Errors
/// [`Failure::FileSystem`]; [`Failure::Input`] where it is no text.
pub fn conventions_beside(path: &Path, overrides: &Overrides) -> Result<Option<String>, Failure> {
    Ok(merged(sidecar(path, &Overrides::default())?.into_iter().next().map(|(_, text)| text), overrides))
}

/// The conventions of a file with others over them.
pub(in crate::report) fn merged(sidecar: Option<String>, overrides: &Overrides) -> Option<String> {
    let Some((_, stated)) = overrides.text() else { return sidecar };
    let Some(sidecar) = sidecar else { return Some(stated) };
    let (mut all, over) = (sidecar.parse::<toml::Table>().ok()?, stated.parse::<toml::Table>().ok()?);
    for (name, keys) in over {
        let toml::Value::Table(keys) = keys else { continue };
        // The dimensions may stand in two tables, in capital or small letters.
        for (_, table) in &mut all {
            if let toml::Value::Table(table) = table {
                table.retain(|old, _| !keys.keys().any(|key| key.eq_ignore_ascii_case(old)));
            }
        }
        let table = all.entry(name).or_insert_with(|| toml::Value::Table(toml::Table::new()));
        if let toml::Value::Table(table) = table {
            table.extend(keys);
        }
    }
    toml::to_string(&all).ok()
}

/// The table of offsets of a file, with what should be known about it. Conventions are taken from the TOML file of the
/// same name beside it, when there is one.
///
/// # Errors
/// [`Failure::FileSystem`]; [`Failure::Input`] with every problem of the table.
pub fn read_table_file(path: &Path) -> Result<(OffsetTable, Vec<TableProblem>), Failure> {
    read_table_file_with(path, &Overrides::default())
}

/// The same, with conventions over those of its file.
///
/// # Errors
/// Those of [`read_table_file`].
pub fn read_table_file_with(path: &Path, overrides: &Overrides) -> Result<(OffsetTable, Vec<TableProblem>), Failure> {
    let bytes = read_bytes(path)?;
    refuse_design(path, &bytes)?;
    table_of(path, &bytes, overrides)
}

/// Refuses a design where a table of offsets is read: with what to do instead.
pub(in crate::report) fn refuse_design(path: &Path, bytes: &[u8]) -> Result<(), Failure> {
    let is_key = |line: &str| ["[project]", "[form]", "[water]", "[output]"].contains(&line.trim());
    if !is_toml(path) || !String::from_utf8_lossy(bytes).lines().any(is_key) {
        return Ok(());
    }
    let message = "the file is a design, and no table of offsets".to_owned();
    let name = path.display();
    let remedy =
        format!("Run `loftsman generate {name}` and give the offsets.csv that it writes, or `loftsman hydro {name}`");
    Err(Failure::Input(vec![problem("E300", path, message, remedy)]))
}

/// The same, with main dimensions over those that the table states, which the job or method file `by` says, or the
/// command line, and with conventions over those of the file beside it: numbered stations and ratios stand where these put them.
///
/// # Errors
/// Those of [`read_table_file`].
pub(in crate::report) fn read_table_stated(
    path: &Path,
    over: &StatedParticulars,
    by: &Path,
    conventions: &Overrides,
) -> Result<(OffsetTable, Vec<TableProblem>), Failure> {
    let (mut table, notes) = read_table_file_with(path, &Overrides::dimensions(over, by).and(conventions))?;
    table.stated = over.over(&table.stated);
    Ok((table, notes))
}

/// A remark about a table without the name of its file.
pub(in crate::report) fn remark(problem: &TableProblem) -> String {
    let TableProblem { code, row, message, remedy, .. } = problem;
    let row = row.map(|row| format!("row {row}: ")).unwrap_or_default();
    let (gap, remedy) = if remedy.is_empty() { ("", "") } else { (". ", remedy.trim_end_matches('.')) };
    format!("{code} {row}{message}{gap}{remedy}")
}

fn table_of(path: &Path, bytes: &[u8], overrides: &Overrides) -> Result<(OffsetTable, Vec<TableProblem>), Failure> {
    let sidecar = sidecar(path, overrides)?;
    let sidecar = sidecar.iter().map(|(name, text)| (name.as_str(), text.as_str()));
    let read = exchange::read_table_with(&path.display().to_string(), bytes, sidecar);
    let placed = |notes: Vec<TableProblem>| notes.into_iter().map(|note| overrides.placed(note)).collect();
    read.map(|ReadTable { table, notes }| (table, placed(notes))).map_err(|problems| overrides.refused(problems))
}

/// Whether a file is a job, a method or a design by its name.
pub(in crate::report) fn is_toml(path: &Path) -> bool {
    ending(path) == "toml"
}

/// A problem of a table among the messages about files.
fn of_table(problem: TableProblem) -> Diagnostic {
    // A field of a table is counted, a column of a text file is not: it goes into the message.
    let place = problem.column.map(|column| format!("column {column}, ")).unwrap_or_default();
    let quoted = if problem.found.is_empty() { String::new() } else { format!("{place}'{}': ", problem.found) };
    Diagnostic {
        severity: if problem.severity == exchange::Severity::Error { Severity::Error } else { Severity::Warning },
        code: problem.code,
        file: problem.file,
        line: problem.row,
        column: None,
        key: String::new(),
        message: format!("{quoted}{}", problem.message),
        found: problem.found,
        help: problem.remedy,
    }
}

/// The hull of a table of offsets.
fn fitted(path: &Path, bytes: &[u8], overrides: &Overrides) -> Result<Source, Failure> {
    let (table, notes) = table_of(path, bytes, overrides)?;
    let fitted = Hull::fit(&table, &FitMethod::default()).map_err(|error| match error {
        FitError::Hull(error) if error.is_of_draught() && overrides.states_draught() => Failure::of_draught(&error),
        error => Failure::Input(vec![diagnostic("E314", path, None, None, error.to_string())]),
    })?;
    // What was detected, as units and orders, decides the hull as much as what was assumed.
    let notes = notes.iter().map(ToString::to_string);
    let doubts = [drawn_doubt(&table, &fitted.hull), suspects_doubt(&table, &suspects(&table))];
    let spaced = spacing_doubts(&table, &fitted.hull);
    let notes = notes.chain(doubts.into_iter().flatten()).chain(spaced).chain(fitted.notes).collect();
    let given = Given::of_table(fitted.hull.particulars().draught.map(|_| overrides.states_draught()));
    let conventions = Conventions { assumed: Assumed::of(&table.stated), given, ..Conventions::default() };
    Ok(Source { hull: fitted.hull, conventions, notes, file: path.to_owned() })
}

/// The most cells of one table of offsets.
const MOST_CELLS: usize = 1_000_000;

/// The offsets of a hull at any stations, waterlines and buttocks \[m\].
///
/// # Errors
/// [`Failure::Usage`] when the table would have more than a million cells.
pub fn offsets(hull: &Hull, stations: &[f64], waterlines: &[f64], buttocks: &[f64]) -> Result<OffsetTable, Failure> {
    let cells = stations.len() * (waterlines.len() + buttocks.len());
    if cells > MOST_CELLS {
        return Err(Failure::Usage(format!(
            "{} with {} and {} make {cells} cells; a table has at most {MOST_CELLS}",
            counted(stations.len(), "station"),
            counted(waterlines.len(), "waterline"),
            counted(buttocks.len(), "buttock")
        )));
    }
    let stations: Vec<OffsetStation> = stations.iter().map(|&x| OffsetStation { name: format!("{x}"), x }).collect();
    Ok(OffsetTable::from_hull(hull, &stations, waterlines, buttocks))
}

/// The section of a hull by a plane, within 1e-9 m of both.
#[must_use]
pub fn sections_of(hull: &Hull, cut: Cut) -> Section {
    hull.section(cut, 1e-9)
}

/// Whether a file is a hull or a design by its name.
#[must_use]
pub fn is_hull(path: &Path) -> bool {
    let extension = ending(path);
    path.is_dir() || matches!(extension.as_str(), "json" | "toml" | "hgf" | "huf")
}
