//! What `derive` and `blend` share: the tables, figures and pages of a hull that is made from others, its comparison with one
//! of them, and the messages of refusals.

use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use super::compare::hulls::{CompareOutputs, ComparedHull};
use super::compare::run::{compared, comparison_files, round_draughts};
use super::markdown::markdown_page;
use super::outputs::Outputs;
use crate::config::{DeriveFile, Diagnostic};
use crate::derivation::{Quantity, Refusal};
use crate::exchange::{
    SummaryFile, TargetLine, conventions_json, heights_csv, hydrostatics_csv, offsets_csv, row_json, write_hull,
};
use crate::hull::{Hull, OffsetStation, OffsetTable, default_buttocks, default_stations, default_waterlines};
use crate::hydrostatics::{Conventions, CurvesOfForm, Given, Hydrostatics, default_draughts};
use crate::plot::{Figure, FigureInputs};
use crate::report::failure::{COMMAND_LINE, Failure, problem};
use crate::report::input::source::read_bytes;
use crate::report::output::files::OutputFile;
use crate::report::output::manifest::{figure_files, json_file, manifest_entry, manifest_of, source_words};
use crate::units::{Notation, decimal};

/// Where the words of targets stand: options, and keys of the job file.
const PLACES: [(&str, &str, &str); 29] = [
    ("wave-resistance", "--wave-resistance", "wave_resistance"),
    ("cb", "--cb", "Cb"),
    ("displacement", "--displacement", "displacement"),
    ("lcb", "--lcb", "LCB"),
    ("cm", "--cm", "Cm"),
    ("bilge-radius", "--bilge-radius", "bilge_radius"),
    ("cp", "--cp", "Cp"),
    ("cwp", "--cwp", "Cwp"),
    ("lcf", "--lcf", "LCF"),
    ("kb", "--kb", "KB"),
    ("km", "--km", "KM"),
    ("gm", "--gm", "GM"),
    ("wetted-surface", "--wetted-surface", "wetted_surface"),
    ("entrance", "--entrance", "entrance"),
    ("run", "--run", "run"),
    ("section-areas", "--section-areas", "section_areas"),
    ("depth", "--depth", "D"),
    ("draught", "--parent-draught", "parent_draught"),
    ("method", "--method", "method"),
    ("parallel-body", "--parallel-body", "parallel_body"),
    ("move-height", "--move-height", "move_height"),
    ("move-position", "--move-position", "move_position"),
    ("lpp", "--lpp", "Lpp"),
    ("beam", "--beam", "B"),
    ("weights", "--weights", "weights"),
    ("hulls", COMMAND_LINE, "hulls"),
    ("free", "--free", "free"),
    ("within", "--within", "within"),
    ("wave-weight", "--wave-weight", "wave_weight"),
];

/// The failure of refusals: values and options as bad input, targets out of reach as infeasible.
pub(in crate::report) fn refused(refusals: Vec<Refusal>, wanted: &DeriveFile, job_file: Option<&Path>) -> Failure {
    let infeasible = refusals.iter().all(|refusal| refusal.code == "E420");
    let shown = |word: &str| {
        let stated_block = word == "displacement" && wanted.coefficients[0].is_some();
        let word = match word {
            _ if stated_block => "cb",
            "km" if wanted.stability[0].is_some() => "gm",
            "cm" if wanted.bilge_radius.is_some() => "bilge-radius",
            word => word,
        };
        PLACES.iter().find(|place| place.0 == word).map_or((COMMAND_LINE, "parent"), |place| (place.1, place.2))
    };
    let message = |refusal: Refusal| {
        let (option, key) = shown(refusal.words.first().copied().unwrap_or_default());
        let file = job_file.unwrap_or(Path::new(option));
        let key = if job_file.is_some() { format!("derive.{key}") } else { String::new() };
        let text = if key.is_empty() { refusal.message } else { format!("{key}: {}", refusal.message) };
        Diagnostic { key, ..problem(refusal.code, file, text, refusal.remedy) }
    };
    let messages: Vec<Diagnostic> = refusals.into_iter().map(message).collect();
    if infeasible { Failure::Infeasible(messages) } else { Failure::of_messages(messages) }
}

/// The targets that a job states but for C_B, LCB and LCF, in the units of the derivation.
pub(in crate::report) fn stated_targets(wanted: &DeriveFile, density: f64) -> Vec<(Quantity, f64)> {
    let volume = wanted.volume.or_else(|| wanted.mass.map(|mass| mass / density));
    let [_, prismatic, midship, waterplane] = wanted.coefficients;
    let targets = [
        (Quantity::Volume, volume),
        (Quantity::PrismaticCoefficient, prismatic),
        (Quantity::MidshipCoefficient, midship),
        (Quantity::WaterplaneCoefficient, waterplane),
        (Quantity::Kb, wanted.heights[0]),
        (Quantity::Km, wanted.heights[1].or_else(|| Some(wanted.stability[0]? + wanted.stability[1]?))),
        (Quantity::WettedSurface, wanted.wetted_surface),
        (Quantity::HalfAngleOfEntrance, wanted.angles[0]),
        (Quantity::HalfAngleOfRun, wanted.angles[1]),
    ];
    let areas = wanted.section_areas.iter().map(|&[x, area]| (Quantity::SectionArea { x }, area));
    targets.into_iter().filter_map(|(quantity, value)| Some((quantity, value?))).chain(areas).collect()
}

/// That GM and KG are stated together.
///
/// # Errors
/// [`Failure::Usage`] where one of them is alone.
pub(in crate::report) fn stability_is_whole(wanted: &DeriveFile) -> Result<(), Failure> {
    let message = match wanted.stability {
        [Some(_), None] => "--gm goes with --kg, the height of the centre of gravity: KM = KG + GM",
        [None, Some(_)] => "--kg goes with --gm: KG alone is no property of the hull",
        _ => return Ok(()),
    };
    Err(Failure::Usage(message.to_owned()))
}

/// A hull that is made from others, with what its files state of it.
pub(in crate::report) struct DerivedHull<'a> {
    /// The hull, with its own name.
    pub(in crate::report) hull: Hull,
    /// Its family in the summary.
    pub(in crate::report) family: &'static str,
    pub(in crate::report) conventions: Conventions,
    pub(in crate::report) targets: Vec<TargetLine>,
    pub(in crate::report) warnings: &'a [String],
    /// The file of the first hull that it is made from, which figures name.
    pub(in crate::report) input: PathBuf,
}

impl DerivedHull<'_> {
    /// With the draught of conventions as one that is given.
    pub(in crate::report) fn conventions(conventions: Conventions) -> Conventions {
        Conventions { given: Given { draught: Some(true), ..conventions.given }, ..conventions }
    }

    fn row(&self, hull: &Hull) -> Option<Hydrostatics> {
        let draught = hull.particulars().draught?;
        CurvesOfForm::new(hull, &[draught], &self.conventions).rows.pop()
    }

    /// The comparison with a hull that it is made from.
    pub(in crate::report) fn beside(&self, other: &Hull, roles: [&'static str; 2]) -> CompareOutputs {
        let hulls = [other, &self.hull];
        let low = hulls.iter().map(|hull| hull.bottom()).fold(f64::NEG_INFINITY, f64::max);
        let high = hulls.iter().map(|hull| hull.particulars().depth).fold(f64::INFINITY, f64::min);
        let draughts = round_draughts(self.hull.particulars().draught, [low, high]);
        let [a, b] = hulls.map(|hull| CurvesOfForm::new(hull, &draughts, &self.conventions).rows);
        let rows = a.into_iter().zip(b).map(|(a, b)| [a, b]).collect();
        // The names of all hulls of a blend are too long for the titles of figures.
        let name = |hull: &Hull| {
            let is_blend = self.family == "blend" && hull.name() == self.hull.name();
            if is_blend { self.family.to_owned() } else { hull.name().to_owned() }
        };
        let of = |hull: &Hull| ComparedHull {
            name: name(hull),
            hull: hull.clone(),
            particulars: *hull.particulars(),
            row: self.row(hull),
            input: None,
        };
        compared(hulls.map(of), roles, self.conventions, rows)
    }

    fn summary(&self, row: &Hydrostatics) -> SummaryFile {
        SummaryFile {
            name: self.hull.name().to_owned(),
            family: self.family,
            particulars: self.hull.particulars().into(),
            design: row_json(row),
            targets: self.targets.clone(),
            values: Vec::new(),
            conventions: conventions_json(&self.conventions),
            remarks: self.warnings.to_vec(),
        }
    }

    /// Tables and figures, as of `generate`.
    pub(in crate::report) fn outputs(&self, figures: &[Figure]) -> Result<Outputs, Failure> {
        let hull = self.hull.clone();
        let internal = |error: &dyn std::fmt::Display| Failure::Internal(format!("{}: {error}", self.family));
        let design_row = self.row(&hull).ok_or_else(|| Failure::Internal("no row of hydrostatics".to_owned()))?;
        let p = *hull.particulars();
        let table = CurvesOfForm::new(&hull, &default_draughts(p.draught, p.depth), &self.conventions);
        let stations = default_stations(&hull, self.conventions.stations).into_iter();
        let stations: Vec<OffsetStation> = stations.map(|s| OffsetStation { x: decimal(s.x), ..s }).collect();
        let decimals = |list: Vec<f64>| list.into_iter().map(decimal).collect::<Vec<f64>>();
        let (waterlines, buttocks) = (decimals(default_waterlines(&hull)), decimals(default_buttocks(&hull)));
        let offsets = OffsetTable::from_hull(&hull, &stations, &waterlines, &buttocks);
        let summary = self.summary(&design_row);
        let mut files = vec![
            OutputFile::text("hull.json", write_hull(&hull, &self.conventions).map_err(|e| internal(&e))?),
            OutputFile::text("offsets.csv", offsets_csv(&offsets, Notation::Metres, true)),
            OutputFile::text("heights.csv", heights_csv(&offsets, Notation::Metres)),
            OutputFile::text("hydrostatics.csv", hydrostatics_csv(&table)),
            json_file("summary.json", &summary)?,
        ];
        let (source, dense) = (source_words(&manifest_entry(&self.input, &read_bytes(&self.input)?)), OnceLock::new());
        let inputs = FigureInputs {
            hull: &hull,
            before: None,
            record: None,
            design: Some(&design_row),
            curves: &table,
            source: Some(&source),
            dense: Some(&dense),
        };
        files.extend(figure_files(&inputs, figures)?);
        files.sort_by(|a, b| a.name.cmp(&b.name));
        Ok(Outputs { hull, summary, design_row, table, remarks: Vec::new(), files })
    }
}

/// The file of a hull: that in a folder of a result.
pub(in crate::report) fn input_file(path: &Path) -> PathBuf {
    if path.is_dir() { path.join("hull.json") } else { path.to_owned() }
}

/// The files of a run: those of the hull, the records of how it was made, the comparison, `report.md` and the manifest.
/// `inputs` are the files that were read, the first of which is the source.
pub(in crate::report) fn run_files(
    outputs: &Outputs,
    records: Vec<OutputFile>,
    comparison: &CompareOutputs,
    inputs: &[PathBuf],
    drawn: bool,
) -> Result<Vec<OutputFile>, Failure> {
    let mut made = outputs.clone();
    made.files.extend(records);
    made.files.extend(comparison_files(comparison, drawn)?);
    made.files.sort_by(|a, b| a.name.cmp(&b.name));
    made.files.push(OutputFile::text("report.md", markdown_page(&made, &[], &[])));
    made.files.sort_by(|a, b| a.name.cmp(&b.name));
    let entry = |path: &PathBuf| Ok::<_, Failure>(manifest_entry(path, &read_bytes(path)?));
    let mut entries = inputs.iter().map(entry).collect::<Result<Vec<_>, _>>()?.into_iter();
    let Some(first) = entries.next() else { return Err(Failure::Internal("no file was read".to_owned())) };
    let manifest = manifest_of(first, entries.collect(), &made.files)?;
    made.files.push(manifest);
    Ok(made.files)
}
