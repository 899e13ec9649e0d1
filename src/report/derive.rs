//! The job of `derive`: a parent and targets become a daughter, its files as of `generate`, and a comparison of the two.

use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use super::compare::{CompareOutputs, ComparedHull, compared, comparison_files, round_draughts};
use super::failure::{Failure, problem};
use super::files::OutputFile;
use super::generate::{Outputs, figure_files, json_file, manifest_entry, manifest_of};
use super::markdown::markdown_page;
use super::result_files::source_words;
use super::source::{Overrides, Source, read_bytes, read_source_with, utf8};
use crate::config::{DeriveFile, Diagnostic, Severity, read_derive};
use crate::derivation::{Derived, Dimensions, Method, Quantity, Reached, Refusal, Request, derive};
use crate::exchange::{
    DeriveReport, DerivedTarget, SummaryFile, TargetLine, conventions_json, derive_json, heights_csv, hydrostatics_csv,
    offsets_csv, row_json, write_hull,
};
use crate::hull::{
    Hull, OffsetStation, OffsetTable, SurfaceDistance, default_buttocks, default_stations, default_waterlines,
    surface_distance,
};
use crate::hydrostatics::{Conventions, CurvesOfForm, Given, Hydrostatics, default_draughts};
use crate::numeric::join;
use crate::plot::{Figure, FigureInputs};
use crate::units::{Notation, decimal};

/// What is asked for.
#[derive(Debug, Clone)]
pub struct DeriveJob {
    /// The parent: hull, folder of a result, design, table, mesh or CAD file.
    pub parent: PathBuf,
    /// The job file, where there is one.
    pub file: Option<PathBuf>,
    /// Conventions of a table or a body over those of its file.
    pub overrides: Overrides,
    /// What the daughter is to have.
    pub wanted: DeriveFile,
    /// Whether the interval of each target is computed.
    pub intervals: bool,
}

/// What it comes to.
#[derive(Debug, Clone)]
pub struct DeriveOutputs {
    /// The daughter with its tables, figures and pages, as of `generate`.
    pub outputs: Outputs,
    /// How it was derived.
    pub derived: Derived,
    /// The method.
    pub method: Method,
    /// The parent and the daughter beside each other.
    pub comparison: CompareOutputs,
    /// The targets.
    #[doc(hidden)]
    pub targets: Vec<DerivedTarget>,
    /// Inflections of stations and waterlines, of the scaled parent and of the daughter.
    pub inflections: [usize; 2],
    /// How far the daughter is from the scaled parent.
    pub moved: Option<SurfaceDistance>,
    /// Warnings, each with its code.
    pub warnings: Vec<String>,
    /// What was assumed when the parent was read.
    pub notes: Vec<String>,
}

impl DeriveOutputs {
    /// What `derive.json` and the JSON of the command hold.
    #[must_use]
    #[doc(hidden)]
    pub fn report(&self) -> DeriveReport<'_> {
        let derived = &self.derived;
        DeriveReport {
            parent: &self.comparison.hulls[0].name,
            method: self.method.as_str(),
            targets: &self.targets,
            shift: derived.shift,
            shift_reach: derived.shift_reach,
            program: (derived.energy, derived.gap, derived.binding, derived.programs),
            inflections: self.inflections,
            moved: self.moved,
            warnings: &self.warnings,
        }
    }
}

/// The job of a path: a job file with a table `[derive]`, or a parent. `options` override the file.
///
/// # Errors
/// [`Failure::FileSystem`]; [`Failure::Input`] with every problem of the job file, or where it names no parent.
pub fn read_derive_job(
    path: &Path,
    options: DeriveFile,
    overrides: Overrides,
    intervals: bool,
) -> Result<DeriveJob, Failure> {
    if !path.is_file() || path.extension().is_none_or(|ending| !ending.eq_ignore_ascii_case("toml")) {
        return Ok(DeriveJob { parent: path.to_owned(), file: None, overrides, wanted: options, intervals });
    }
    let text = utf8(path, read_bytes(path)?)?;
    let names_table =
        text.lines().any(|line| line.trim_start().starts_with("[derive]") || line.trim_start().starts_with("derive."));
    if !names_table {
        return Ok(DeriveJob { parent: path.to_owned(), file: None, overrides, wanted: options, intervals });
    }
    let file = read_derive(&path.display().to_string(), &text).map_err(Failure::Input)?;
    let wanted = options.over(file);
    let Some(parent) = &wanted.parent else {
        let message = "derive.parent is missing: the hull, design or table to derive from".to_owned();
        return Err(Failure::Input(vec![problem(
            "E125",
            path,
            message,
            "Write parent = \"hull.json\" under [derive]",
        )]));
    };
    let parent = path.parent().unwrap_or(Path::new("")).join(parent);
    Ok(DeriveJob { parent, file: Some(path.to_owned()), overrides, wanted, intervals })
}

/// Where the words of targets stand: options, and keys of the job file.
const PLACES: [(&str, &str, &str); 16] = [
    ("cb", "--cb", "Cb"),
    ("displacement", "--displacement", "displacement"),
    ("lcb", "--lcb", "LCB"),
    ("cm", "--cm", "Cm"),
    ("cp", "--cp", "Cp"),
    ("cwp", "--cwp", "Cwp"),
    ("lcf", "--lcf", "LCF"),
    ("kb", "--kb", "KB"),
    ("km", "--km", "KM"),
    ("wetted-surface", "--wetted-surface", "wetted_surface"),
    ("depth", "--depth", "D"),
    ("draught", "--parent-draught", "parent_draught"),
    ("method", "--method", "method"),
    ("parallel-body", "--parallel-body", "parallel_body"),
    ("lpp", "--lpp", "Lpp"),
    ("beam", "--beam", "B"),
];

impl DeriveJob {
    fn request(&self, parent: &Hull, conventions: &Conventions) -> Request {
        let wanted = &self.wanted;
        let [length, breadth, draught, depth] = wanted.dimensions;
        let dimensions = Dimensions { length, breadth, draught, depth };
        let between = length.unwrap_or(parent.particulars().length_between_perpendiculars);
        let at = |centre: Option<[f64; 2]>| centre.map(|[share, shift]| share * between + shift);
        let volume = wanted.volume.or_else(|| wanted.mass.map(|mass| mass / conventions.density));
        let [block, prismatic, midship, waterplane] = wanted.coefficients;
        let targets = [
            (Quantity::Volume, volume),
            (Quantity::Lcb, at(wanted.centres[0])),
            (Quantity::PrismaticCoefficient, prismatic),
            (Quantity::MidshipCoefficient, midship),
            (Quantity::WaterplaneCoefficient, waterplane),
            (Quantity::Lcf, at(wanted.centres[1])),
            (Quantity::Kb, wanted.heights[0]),
            (Quantity::Km, wanted.heights[1]),
            (Quantity::WettedSurface, wanted.wetted_surface),
        ];
        let free = Quantity::ALL.into_iter().filter(|quantity| wanted.free.contains(&quantity.word())).collect();
        Request {
            dimensions,
            block_coefficient: block,
            lcb_percent: None,
            targets: targets.into_iter().filter_map(|(quantity, value)| Some((quantity, value?))).collect(),
            free,
            method: self.method(),
            parallel_body: wanted.parallel_body,
        }
    }

    fn method(&self) -> Method {
        Method::ALL.into_iter().find(|method| Some(method.as_str()) == self.wanted.method).unwrap_or_default()
    }

    /// The failure of refusals: values and options as bad input, targets out of reach as infeasible.
    fn refused(&self, refusals: Vec<Refusal>) -> Failure {
        let infeasible = refusals.iter().all(|refusal| refusal.code == "E420");
        let shown = |word: &str| {
            let stated_block = word == "displacement" && self.wanted.coefficients[0].is_some();
            let word = if stated_block { "cb" } else { word };
            PLACES.iter().find(|place| place.0 == word).map_or(("--cb", "Cb"), |place| (place.1, place.2))
        };
        let message = |refusal: Refusal| {
            let (option, key) = shown(refusal.words.first().copied().unwrap_or_default());
            let file = self.file.as_deref().unwrap_or(Path::new(option));
            let key = if self.file.is_some() { format!("derive.{key}") } else { String::new() };
            let text = if key.is_empty() { refusal.message } else { format!("{key}: {}", refusal.message) };
            Diagnostic { key, ..problem(refusal.code, file, text, refusal.remedy) }
        };
        let messages: Vec<Diagnostic> = refusals.into_iter().map(message).collect();
        if infeasible { Failure::Infeasible(messages) } else { Failure::of_messages(messages) }
    }
}

fn target(reached: &Reached) -> DerivedTarget {
    let quantity = reached.target.quantity;
    DerivedTarget {
        key: quantity.key(),
        unit: quantity.unit(),
        origin: reached.target.origin.as_str(),
        scaled: reached.before,
        requested: reached.target.value,
        achieved: reached.achieved,
        price: reached.price,
        interval: reached.interval.map(|found| [found.low, found.high]),
    }
}

/// Derives the daughter, with its tables, figures and the comparison with its parent.
///
/// # Errors
/// Those of [`read_source_with`]; [`Failure::Infeasible`] (E420) where no daughter meets the targets, with what is within
/// reach; [`Failure::Options`] or [`Failure::Input`] for values that no ship has (E421) and targets that the method does
/// not take (E422).
pub fn derive_outputs(job: &DeriveJob, figures: &[Figure]) -> Result<DeriveOutputs, Failure> {
    let source = read_source_with(&job.parent, &job.overrides)?;
    let Source { hull, conventions, notes, .. } = source;
    let parent = match job.wanted.parent_draught {
        Some(draught) => {
            hull.with_draught(draught).map_err(|error| Failure::Usage(format!("--parent-draught: {error}")))?
        }
        None => hull,
    };
    let derived = derive(&parent, &job.request(&parent, &conventions), &conventions, job.intervals)
        .map_err(|refusals| job.refused(refusals))?;
    let warnings = warnings(job, derived.inflections);
    let targets: Vec<DerivedTarget> = derived.targets.iter().map(target).collect();
    let conventions = Conventions { given: Given { draught: Some(true), ..conventions.given }, ..conventions };
    let made = Made { job, parent: &parent, derived: &derived, conventions, targets: &targets, warnings: &warnings };
    let (comparison, moved) = join(|| made.comparison(), || surface_distance(&derived.hull, &derived.scaled));
    let outputs = made.outputs(figures)?;
    let method = job.method();
    let inflections = derived.inflections;
    Ok(DeriveOutputs { outputs, method, comparison, targets, inflections, moved, warnings, notes, derived })
}

impl DeriveOutputs {
    /// Whether the daughter is about as fair as her parent: at most one and a half times its inflections, and two.
    ///
    /// # Errors
    /// [`Failure::Check`] (E505) otherwise; the files are those of the daughter all the same.
    pub fn verdict(&self) -> Result<(), Failure> {
        let [before, after] = self.inflections;
        if 2 * after <= 3 * before + 4 {
            return Ok(());
        }
        Err(Failure::Check(format!(
            "E505 the targets are met, and the daughter is not fair: {before} > {after} inflections of stations and waterlines"
        )))
    }
}

fn warnings(job: &DeriveJob, [before, after]: [usize; 2]) -> Vec<String> {
    let warning = |code: &'static str, message: String, help: &str| {
        Diagnostic { severity: Severity::Warning, ..problem(code, &job.parent, message, help) }.to_string()
    };
    let more = after > before;
    let message =
        || format!("the daughter has {after} inflections of stations and waterlines, its scaled parent {before}");
    let help = "Give targets nearer to the parent, free one that is kept, or fair the table of the daughter";
    more.then(|| warning("W420", message(), help)).into_iter().collect()
}

/// What the files of a daughter are made of.
struct Made<'a> {
    job: &'a DeriveJob,
    parent: &'a Hull,
    derived: &'a Derived,
    conventions: Conventions,
    targets: &'a [DerivedTarget],
    warnings: &'a [String],
}

impl Made<'_> {
    fn name(&self) -> String {
        let parent = self.parent.name();
        if parent.ends_with("daughter") { parent.to_owned() } else { format!("{parent} daughter") }
    }

    fn row(&self, hull: &Hull) -> Option<Hydrostatics> {
        let draught = hull.particulars().draught?;
        CurvesOfForm::new(hull, &[draught], &self.conventions).rows.pop()
    }

    fn comparison(&self) -> CompareOutputs {
        let hulls = [(self.parent, self.parent.name().to_owned()), (&self.derived.hull, self.name())];
        let low = hulls.iter().map(|(hull, _)| hull.bottom()).fold(f64::NEG_INFINITY, f64::max);
        let high = hulls.iter().map(|(hull, _)| hull.particulars().depth).fold(f64::INFINITY, f64::min);
        let draughts = round_draughts(self.derived.hull.particulars().draught, [low, high]);
        let tables =
            [self.parent, &self.derived.hull].map(|hull| CurvesOfForm::new(hull, &draughts, &self.conventions));
        let [a, b] = tables.map(|table| table.rows);
        let rows = a.into_iter().zip(b).map(|(a, b)| [a, b]).collect();
        let of = |(hull, name): (&Hull, String)| ComparedHull {
            name,
            hull: hull.clone(),
            particulars: *hull.particulars(),
            row: self.row(hull),
            input: None,
        };
        compared(hulls.map(of), ["parent", "daughter"], self.conventions, rows)
    }

    fn summary(&self, row: &Hydrostatics) -> SummaryFile {
        let line = |target: &DerivedTarget| TargetLine {
            key: target.key,
            requested: target.requested,
            achieved: target.achieved,
            error: target.achieved - target.requested,
            origin: target.origin,
        };
        SummaryFile {
            name: self.name(),
            family: "derived",
            particulars: self.derived.hull.particulars().into(),
            design: row_json(row),
            targets: self.targets.iter().map(line).collect(),
            values: Vec::new(),
            conventions: conventions_json(&self.conventions),
            remarks: self.warnings.to_vec(),
        }
    }

    /// Tables and figures of the daughter, as of `generate`.
    fn outputs(&self, figures: &[Figure]) -> Result<Outputs, Failure> {
        let hull = self.derived.hull.clone().with_name(self.name());
        let internal = |error: &dyn std::fmt::Display| Failure::Internal(format!("derive: {error}"));
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
        let input = self.input();
        let (source, dense) = (source_words(&manifest_entry(&input, &read_bytes(&input)?)), OnceLock::new());
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

    /// The file of the parent.
    fn input(&self) -> PathBuf {
        let path = &self.job.parent;
        if path.is_dir() { path.join("hull.json") } else { path.clone() }
    }
}

/// Every file of a daughter: those of `generate`, `derive.json`, the comparison, `report.md` and the manifest.
///
/// # Errors
/// [`Failure::FileSystem`] when an input cannot be read again for its hash; [`Failure::Internal`] when a figure cannot be
/// drawn.
pub fn derive_files(job: &DeriveJob, outputs: &DeriveOutputs, drawn: bool) -> Result<Vec<OutputFile>, Failure> {
    let mut made = outputs.outputs.clone();
    made.files.push(json_file("derive.json", &derive_json(&outputs.report()))?);
    made.files.extend(comparison_files(&outputs.comparison, drawn)?);
    made.files.sort_by(|a, b| a.name.cmp(&b.name));
    made.files.push(OutputFile::text("report.md", markdown_page(&made, &[], &[])));
    made.files.sort_by(|a, b| a.name.cmp(&b.name));
    let path = if job.parent.is_dir() { job.parent.join("hull.json") } else { job.parent.clone() };
    let entry = |path: &Path| Ok::<_, Failure>(manifest_entry(path, &read_bytes(path)?));
    let others = job.file.as_deref().map(entry).transpose()?.into_iter().collect();
    let manifest = manifest_of(entry(&path)?, others, &made.files)?;
    made.files.push(manifest);
    Ok(made.files)
}
