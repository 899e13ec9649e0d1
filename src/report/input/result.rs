//! What `report` starts from: the folder that `generate`, `fit` or `fair` wrote, or the JSON of `hydro`.

use std::fs;
use std::path::{Path, PathBuf};

use serde_json::Value;

use super::source::{AGAIN, hull_faults, is_toml, read_bytes, utf8};
use crate::exchange::{
    FairingFile, HullFile, ManifestEntry, json_message, read_changes, read_fairing, read_hull, read_manifest_input,
    read_manifest_outputs, sha256,
};
use crate::fairing::change::Change;
use crate::fairing::record::{Doubt, FairRecord, resolution};
use crate::hull::Hull;
use crate::hydrostatics::{Conventions, default_draughts};
use crate::report::failure::{Failure, problem};
use crate::report::output::files::MANIFEST;
use crate::report::output::manifest::manifest_entry;
use crate::units::counted;

/// A result, read back.
#[derive(Debug, Clone)]
pub struct JobResult {
    /// The hull; of `fair` the fair one.
    pub hull: Hull,
    /// Conventions of its tables.
    pub conventions: Conventions,
    /// Draughts of its hydrostatic table \[m\].
    pub draughts: Vec<f64>,
    /// The faired table, and `fairing.json`.
    pub fairing: Option<(FairRecord, Value)>,
    /// What was asked of the hull at its design draught: keys of quantities, and values in their units.
    pub targets: Vec<(String, f64)>,
    /// `changes.csv`, where there is one.
    pub changes: Option<String>,
    /// What should be known about the files.
    pub notes: Vec<String>,
    /// The files that were read.
    pub inputs: Vec<ManifestEntry>,
    /// The file that the run was made from, as its manifest has it.
    pub origin: Option<ManifestEntry>,
    /// The folder of the result, where it is one.
    pub folder: Option<PathBuf>,
}

/// Names of the surface through a table in the folder of `fair`, the present one and the one before.
const FITTED_HULLS: [&str; 2] = ["fitted-hull.json", "start.json"];

const REMEDY: &str =
    "Give the folder that `generate`, `fit` or `fair` wrote, a JSON file in it, or the file of `hydro --json`";

/// Files of a result as they are read.
struct ResultReader {
    folder: PathBuf,
    inputs: Vec<ManifestEntry>,
}

impl ResultReader {
    fn text(&mut self, path: &Path) -> Result<String, Failure> {
        let bytes = read_bytes(path)?;
        self.inputs.push(manifest_entry(path, &bytes));
        utf8(path, bytes)
    }

    /// A file of the folder, when it is there.
    fn there(&mut self, name: &str) -> Result<Option<String>, Failure> {
        let path = self.folder.join(name);
        if path.is_file() { self.text(&path).map(Some) } else { Ok(None) }
    }

    /// A file that the result cannot be without; `of` is the command that writes it.
    fn needed(&mut self, name: &str, of: &str) -> Result<String, Failure> {
        if let Some(text) = self.there(name)? {
            return Ok(text);
        }
        let mut found: Vec<String> = fs::read_dir(&self.folder)
            .map(|entries| entries.flatten().map(|entry| entry.file_name().to_string_lossy().into_owned()).collect())
            .unwrap_or_default();
        found.sort();
        let listed = match found.len() {
            0 => "nothing".to_owned(),
            n if n > 6 => format!("{} and {} more", found[..6].join(", "), n - 6),
            _ => found.join(", "),
        };
        let message = format!("found {listed}; expected {name}, which {of} writes");
        Err(Failure::Input(vec![problem("E181", &self.folder, message, REMEDY)]))
    }

    fn hull(&mut self, name: &str, of: &str) -> Result<HullFile, Failure> {
        let text = self.needed(name, of)?;
        hull_of(&self.folder.join(name), &text)
    }
}

fn hull_of(path: &Path, text: &str) -> Result<HullFile, Failure> {
    read_hull(text).map_err(|error| Failure::Input(hull_faults("E182", path, &error)))
}

fn unread(path: &Path, message: &str) -> Failure {
    Failure::Input(vec![problem("E182", path, message.to_owned(), AGAIN)])
}

fn json(path: &Path, text: &str) -> Result<Value, Failure> {
    serde_json::from_str(text).map_err(|error| {
        let place = format!("line {}, column {}", error.line(), error.column());
        unread(path, &format!("{place}: {}", json_message(&error)))
    })
}

/// Reads a result.
///
/// # Errors
/// [`Failure::FileSystem`]; [`Failure::Input`] with the file, what was found, what was expected and what to do.
pub fn read_result(path: &Path) -> Result<JobResult, Failure> {
    let beside = |folder: &Path| ResultReader { folder: folder.to_owned(), inputs: Vec::new() };
    if path.is_dir() {
        return of_folder(beside(path));
    }
    // The parent of a bare name is empty, which is no folder that could be listed or named.
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let named = path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    if path.is_file() && ["fairing.json", "summary.json", "fit.json", "manifest.json"].contains(&named.as_str()) {
        return of_folder(beside(folder));
    }
    let mut reader = beside(folder);
    let text = reader.text(path)?;
    refuse_input(path, &text)?;
    let value = json(path, &text)?;
    if value["format"] == "loftsman-hull" {
        let HullFile { hull, conventions } = hull_of(path, &text)?;
        let p = hull.particulars();
        let draughts = default_draughts(p.draught, p.depth);
        return Ok(JobResult { draughts, ..bare(hull, conventions, reader.inputs) });
    }
    let rows = value["rows"].as_array().filter(|_| value["conventions"].is_object());
    let Some(rows) = rows else {
        let members: Vec<&str> = value.as_object().into_iter().flatten().map(|(key, _)| key.as_str()).take(6).collect();
        let message = format!(
            "found an object of {}; expected a result of a command",
            if members.is_empty() { "nothing".to_owned() } else { members.join(", ") }
        );
        return Err(Failure::Input(vec![problem("E182", path, message, REMEDY)]));
    };
    let mut draughts: Vec<f64> = rows.iter().filter_map(|row| row["T"].as_f64()).collect();
    draughts.sort_by(f64::total_cmp);
    draughts.dedup();
    if value["hull"].is_null() || draughts.len() < 2 {
        let message = match draughts.len() {
            _ if value["hull"].is_null() => {
                "found hydrostatics without their hull; expected the member `hull`".to_owned()
            }
            n => format!("found {}; expected two at least", counted(n, "draught")),
        };
        return Err(Failure::Input(vec![problem(
            "E182",
            path,
            message,
            "Run `hydro HULL --draughts LIST --json` again",
        )]));
    }
    let HullFile { hull, conventions } = hull_of(path, &value["hull"].to_string())?;
    Ok(JobResult { draughts, ..bare(hull, conventions, reader.inputs) })
}

/// Refuses a design or a table, which are no result: with the command that makes one of it.
fn refuse_input(path: &Path, text: &str) -> Result<(), Failure> {
    if text.trim_start().starts_with('{') {
        return Ok(());
    }
    let (found, command) = if is_toml(path) { ("a design or a job", "generate") } else { ("a table or a body", "fit") };
    let name = path.display();
    let message = format!("found {found}; expected a result of a command");
    let remedy = format!("Run `loftsman {command} {name} -o FOLDER`, then `loftsman report FOLDER`");
    Err(Failure::Input(vec![problem("E182", path, message, remedy)]))
}

fn bare(hull: Hull, conventions: Conventions, inputs: Vec<ManifestEntry>) -> JobResult {
    JobResult {
        hull,
        conventions,
        draughts: Vec::new(),
        fairing: None,
        targets: Vec::new(),
        changes: None,
        notes: Vec::new(),
        inputs,
        origin: None,
        folder: None,
    }
}

/// Refuses a folder with files that are not those of its manifest: they would be of two runs, or changed since.
fn of_one_run(folder: &Path) -> Result<(), Failure> {
    let manifest = fs::read_to_string(folder.join(MANIFEST)).unwrap_or_default();
    let differs =
        |entry: &ManifestEntry| fs::read(folder.join(&entry.file)).is_ok_and(|bytes| sha256(&bytes) != entry.sha256);
    let others = read_manifest_outputs(&manifest).into_iter().filter(differs);
    let of = |entry: ManifestEntry| {
        let message = format!("the file is not the one that {MANIFEST} lists: it is of another run, or was changed");
        problem("E185", &folder.join(entry.file), message, "Run the command again with --force")
    };
    let messages: Vec<_> = others.map(of).collect();
    if messages.is_empty() { Ok(()) } else { Err(Failure::Input(messages)) }
}

fn of_folder(mut reader: ResultReader) -> Result<JobResult, Failure> {
    of_one_run(&reader.folder)?;
    let HullFile { hull, conventions } = reader.hull("hull.json", "`generate`, `fit` or `fair`")?;
    let folder = reader.folder.clone();
    let mut changes = None;
    let fairing = match reader.there("fairing.json")? {
        None => None,
        Some(text) => {
            let path = folder.join("fairing.json");
            let file = read_fairing(&text).map_err(|error| unread(&path, &error.to_string()))?;
            let FairingFile {
                name,
                status,
                lines,
                targets: area,
                doubts,
                energy,
                is_field,
                resolution: band,
                sigma,
                errors,
                readings,
                offsets,
                edf,
                chosen,
                trials,
                progress,
                whole,
            } = file;
            let text = reader.needed("changes.csv", "`fair`")?;
            let moved = read_changes(&text, &lines, offsets)
                .map_err(|error| unread(&folder.join("changes.csv"), &error.to_string()))?;
            if !spans(&moved) {
                let found = counted(moved.len(), "offset");
                let message = format!("found {found} that span no hull; expected breadth at several x and heights");
                return Err(unread(&folder.join("changes.csv"), &message));
            }
            let file = FITTED_HULLS.into_iter().find(|name| folder.join(name).is_file()).unwrap_or(FITTED_HULLS[0]);
            let before = reader.hull(file, "`fair`")?.hull;
            if let Some(message) = another_ship(&before, &hull) {
                return Err(unread(&folder.join(file), &message));
            }
            let after = hull.clone();
            let (lambda, quantum) = (chosen.lambda, lines.quantum);
            // An older certificate does not say: those that are no suspects.
            let readings = readings.unwrap_or_else(|| moved.iter().filter(|change| !change.suspect).count());
            let record = FairRecord {
                name,
                status,
                before,
                after,
                lines,
                targets: area,
                doubts: Doubt::all(doubts, &moved),
                changes: moved,
                energy,
                is_field,
                // An older certificate does not say.
                resolution: band.unwrap_or_else(|| resolution(quantum, sigma)),
                sigma,
                errors,
                readings,
                lambda,
                edf,
                chosen,
                trials,
                progress,
            };
            changes = Some(text);
            Some((record, whole))
        }
    };
    let targets = match &fairing {
        Some((_, whole)) => held_targets(whole),
        None => match reader.there("summary.json")? {
            Some(text) => {
                // What a preset or the solver chose was not asked for.
                let all = &json(&folder.join("summary.json"), &text)?["targets"];
                let given = all.as_array().into_iter().flatten().filter(|target| target["origin"] == "given");
                targets(&Value::Array(given.cloned().collect()), "requested", str::to_owned)
            }
            None => Vec::new(),
        },
    };
    let p = *hull.particulars();
    let draughts = match reader.there("hydrostatics.csv")? {
        Some(text) => first_column(&folder.join("hydrostatics.csv"), &text)?,
        None => default_draughts(p.draught, p.depth),
    };
    let (mut origin, mut written) = (None, Vec::new());
    if let Some(text) = reader.there("manifest.json")? {
        origin = read_manifest_input(&text);
        written = read_manifest_outputs(&text);
    }
    let notes = missing(&folder, &written, fairing.is_some());
    Ok(JobResult {
        draughts,
        fairing,
        targets,
        changes,
        notes,
        origin,
        folder: Some(folder),
        ..bare(hull, conventions, reader.inputs)
    })
}

/// Whether offsets have length, breadth and height.
fn spans(changes: &[Change]) -> bool {
    let several = |of: fn(&Change) -> f64| changes.windows(2).any(|pair| (of(&pair[0]) - of(&pair[1])).abs() > 0.0);
    several(|change| change.x) && several(|change| change.z) && changes.iter().any(|c| c.before.max(c.after) > 0.0)
}

/// Main dimensions in which the hull before a fairing is not that after it, in words; none where it is.
fn another_ship(before: &Hull, after: &Hull) -> Option<String> {
    let dimensions = |hull: &Hull| {
        let p = hull.particulars();
        [("Lpp", Some(p.length_between_perpendiculars)), ("B", Some(p.breadth)), ("T", p.draught), ("D", Some(p.depth))]
    };
    let apart = |found: Option<f64>, expected: Option<f64>| match (found, expected) {
        (Some(found), Some(expected)) => (found - expected).abs() > 1e-6 * expected,
        (found, expected) => found.is_some() || expected.is_some(),
    };
    let shown = |value: Option<f64>| value.map_or("none".to_owned(), |value| format!("{value} m"));
    let pairs = dimensions(before).into_iter().zip(dimensions(after));
    let other: Vec<String> = pairs
        .filter(|((_, found), (_, expected))| apart(*found, *expected))
        .map(|((key, found), (_, expected))| format!("{key} {} where hull.json has {}", shown(found), shown(expected)))
        .collect();
    if other.is_empty() {
        return None;
    }
    Some(format!("the hull before the fairing is another ship: found {}", other.join(", ")))
}

/// Files that a report can be made without, and what it lacks then.
const LACKS: [(&str, &str); 3] = [
    ("fairing.json", "nothing of the fairing: before and after, moves, combs, prices"),
    ("summary.json", "no targets"),
    ("hydrostatics.csv", "the usual draughts, not those of the run"),
];

/// What the report lacks because files of the run, which its manifest lists, are no longer there.
fn missing(folder: &Path, written: &[ManifestEntry], faired: bool) -> Vec<String> {
    let there = |name: &str| folder.join(name).is_file();
    let mut notes = Vec::new();
    if !there("manifest.json") {
        notes.push(format!(
            "{} is missing: the report does not name the file that the hull was made from",
            folder.join("manifest.json").display()
        ));
    }
    for (name, lack) in LACKS {
        let listed = written.iter().any(|entry| entry.file == name);
        // Without a manifest the other files of a fairing tell that there was one.
        let known = listed || (name == "fairing.json" && FITTED_HULLS.into_iter().any(there));
        // The targets of a fairing stand in its certificate.
        if known && !there(name) && !(faired && name == "summary.json") {
            notes.push(format!("{} is missing: the report has {lack}", folder.join(name).display()));
        }
    }
    notes
}

/// The key and the value `wanted` of every member of a list that has both; `key` is the member `key`.
fn targets(list: &Value, wanted: &str, key: impl Fn(&str) -> String) -> Vec<(String, f64)> {
    let one =
        |target: &Value| Some((key(target["key"].as_str().or(target["kind"].as_str())?), target[wanted].as_f64()?));
    list.as_array().into_iter().flatten().filter_map(one).collect()
}

/// What a fairing held of the whole hull, where it is a quantity of the table of hydrostatics.
fn held_targets(fairing: &Value) -> Vec<(String, f64)> {
    let key = |kind: &str| match kind {
        "displacement" => "DISPVOL".to_owned(),
        "lcb" => "XCB".to_owned(),
        "block_coefficient" => "CB".to_owned(),
        "midship_coefficient" => "CM".to_owned(),
        "kb" => "KB".to_owned(),
        "waterplane_area" => "AWL".to_owned(),
        "waterplane_coefficient" => "CWP".to_owned(),
        "lcf" => "XWL".to_owned(),
        "km" => "KMT".to_owned(),
        "gm" => "GMT".to_owned(),
        "wetted_surface" => "S".to_owned(),
        other => other.to_owned(),
    };
    targets(&fairing["constraints"], "target", key)
}

/// The draughts of `hydrostatics.csv`.
fn first_column(path: &Path, text: &str) -> Result<Vec<f64>, Failure> {
    let cells = text.lines().skip(2).map(|line| line.split(',').next().unwrap_or_default());
    let draughts: Vec<f64> =
        cells.filter_map(|cell| cell.parse().ok()).filter(|value: &f64| value.is_finite()).collect();
    if draughts.len() < 2 {
        let message =
            format!("found {} in its first column; expected two at least", counted(draughts.len(), "draught"));
        return Err(unread(path, &message));
    }
    Ok(draughts)
}
