//! The job of `derive`: a parent and targets become a daughter, its files as of `generate`, and a comparison of the two.

use std::path::{Path, PathBuf};

use super::compare::hulls::CompareOutputs;
use super::derived_hull::{DerivedHull, input_file, refused, run_files, stability_is_whole, stated_targets};
use super::outputs::Outputs;
use super::waves::trade_files;
use crate::config::{DeriveFile, Diagnostic, Severity, read_derive};
use crate::derivation::{Derived, Dimensions, Method, Quantity, Reached, Request, derive};
use crate::exchange::{CurveProblem, DeriveReport, DerivedTarget, TargetLine, derive_json, read_curve};
use crate::hull::{Hull, SurfaceDistance, surface_distance};
use crate::hydrostatics::{Conventions, CurvesOfForm, Hydrostatics};
use crate::numeric::join;
use crate::plot::Figure;
use crate::report::failure::{Failure, problem};
use crate::report::input::source::{Overrides, Source, read_bytes, read_source_with, utf8};
use crate::report::output::files::OutputFile;
use crate::report::output::manifest::json_file;
use crate::resistance::{Water, WaveRequest};
use crate::units::Notation;

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
    /// Ends of the parallel middle body of the scaled parent and of the daughter \[m\], where they have one.
    #[doc(hidden)]
    pub middle_bodies: [Option<[f64; 2]>; 2],
    /// How far the daughter is from the scaled parent.
    pub moved: Option<SurfaceDistance>,
    /// Heights \[m\] that lines come from and to.
    #[doc(hidden)]
    pub moved_heights: Vec<[f64; 2]>,
    /// Positions \[m\] that lines come from and to.
    #[doc(hidden)]
    pub moved_positions: Vec<[f64; 2]>,
    /// GM and KG, where they are stated \[m\].
    #[doc(hidden)]
    pub stability: Option<[f64; 2]>,
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
            program: (derived.energy, derived.gap, derived.programs),
            limits: derived.binding.iter().map(|limits| (limits.kind, limits.count, limits.price)).collect(),
            parallel_body: derived.parallel_body,
            inflections: self.inflections,
            middle_bodies: self.middle_bodies,
            moved_lines: [&self.moved_heights, &self.moved_positions],
            moved: self.moved,
            waves: derived.waves.as_ref(),
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
    let folder = path.parent().unwrap_or(Path::new(""));
    let area_file = file.area_file.as_ref().map(|name| folder.join(name).display().to_string());
    let wanted = options.over(DeriveFile { area_file, ..file });
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

/// The job with the areas of the file that it names.
fn with_areas(job: &DeriveJob) -> Result<DeriveJob, Failure> {
    let mut job = job.clone();
    let Some(path) = job.wanted.area_file.as_ref().map(PathBuf::from) else { return Ok(job) };
    let curve = read_curve(&utf8(&path, read_bytes(&path)?)?, Notation::Metres).map_err(|problems| {
        let of = |p: CurveProblem| Diagnostic { line: p.line, ..problem("E340", &path, p.message, p.remedy) };
        Failure::Input(problems.into_iter().map(of).collect())
    })?;
    job.wanted.section_areas = curve.points.iter().filter_map(|p| Some([p.x, p.y?])).collect();
    Ok(job)
}

impl DeriveJob {
    /// The files that are read besides the parent.
    #[must_use]
    pub fn other_inputs(&self) -> Vec<PathBuf> {
        self.file.clone().into_iter().chain(self.wanted.area_file.as_ref().map(PathBuf::from)).collect()
    }

    fn request(&self, conventions: &Conventions) -> Request {
        let wanted = &self.wanted;
        let [length, breadth, draught, depth] = wanted.dimensions;
        let dimensions = Dimensions { length, breadth, draught, depth };
        let free = Quantity::ALL.into_iter().filter(|quantity| wanted.free.contains(&quantity.word())).collect();
        Request {
            dimensions,
            block_coefficient: wanted.coefficients[0],
            lcb_percent: None,
            centres: wanted.centres,
            bilge_radius: wanted.bilge_radius,
            moved_heights: wanted.moved_heights.clone(),
            moved_positions: wanted.moved_positions.clone(),
            targets: stated_targets(wanted, conventions.density),
            free,
            method: self.method(),
            parallel_body: wanted.parallel_body,
            waves: wanted.froude_numbers.clone().map(|froude_numbers| WaveRequest {
                froude_numbers,
                weight: wanted.wave_weight,
                within: wanted.within,
                water: Water::of_density(conventions.density),
            }),
        }
    }

    fn method(&self) -> Method {
        Method::ALL.into_iter().find(|method| Some(method.as_str()) == self.wanted.method).unwrap_or_default()
    }
}

fn target(reached: &Reached) -> DerivedTarget {
    let quantity = reached.target.quantity;
    DerivedTarget {
        key: quantity.label(),
        unit: quantity.unit(),
        origin: reached.target.origin.as_str(),
        scaled: reached.before,
        requested: reached.target.value,
        achieved: reached.achieved,
        price: reached.price,
        interval: reached.interval.map(|found| [found.low, found.high]),
        keeps_signs: reached.interval.is_some_and(|found| found.keeps_signs),
    }
}

/// Derives the daughter, with its tables, figures and the comparison with its parent.
///
/// # Errors
/// Those of [`read_source_with`]; [`Failure::Infeasible`] (E420) where no daughter meets the targets, with what is within
/// reach; [`Failure::Options`] or [`Failure::Input`] for values that no ship has (E421) and targets that the method does
/// not take (E422).
pub fn derive_outputs(job: &DeriveJob, figures: &[Figure]) -> Result<DeriveOutputs, Failure> {
    if job.wanted.froude_numbers.is_none() && (job.wanted.wave_weight.is_some() || job.wanted.within.is_some()) {
        let message = "--wave-weight and --within go with --wave-resistance, and no Froude numbers are given";
        return Err(Failure::Usage(message.to_owned()));
    }
    stability_is_whole(&job.wanted)?;
    let job = &with_areas(job)?;
    let source = read_source_with(&job.parent, &job.overrides)?;
    let Source { hull, conventions, notes, .. } = source;
    let parent = match job.wanted.parent_draught {
        Some(draught) => {
            hull.with_draught(draught).map_err(|error| Failure::Usage(format!("--parent-draught: {error}")))?
        }
        None => hull,
    };
    let derived = derive(&parent, &job.request(&conventions), &conventions, job.intervals)
        .map_err(|refusals| refused(refusals, &job.wanted, job.file.as_deref()))?;
    let rows = rows(&derived, &conventions);
    let warnings = warnings(job, &derived, rows.as_ref());
    let targets: Vec<DerivedTarget> = derived.targets.iter().map(target).collect();
    let made = DerivedHull {
        hull: derived.hull.clone().with_name(daughter_name(&parent)),
        family: "derived",
        conventions: DerivedHull::conventions(conventions),
        targets: targets.iter().map(target_line).collect(),
        warnings: &warnings,
        input: input_file(&job.parent),
    };
    let roles = ["parent", "daughter"];
    let (comparison, moved) = join(|| made.beside(&parent, roles), || surface_distance(&derived.hull, &derived.scaled));
    let outputs = made.outputs(figures)?;
    let method = job.method();
    let inflections = derived.inflections;
    let [gm, kg] = job.wanted.stability;
    let stability = gm.zip(kg).map(|(gm, kg)| [gm, kg]);
    let middle_bodies = rows.as_ref().map_or([None, None], |rows| rows.each_ref().map(middle_body));
    Ok(DeriveOutputs {
        stability,
        outputs,
        method,
        comparison,
        targets,
        inflections,
        middle_bodies,
        moved_heights: job.wanted.moved_heights.clone(),
        moved_positions: job.wanted.moved_positions.clone(),
        moved,
        warnings,
        notes,
        derived,
    })
}

impl DeriveOutputs {
    /// Whether the daughter is about as fair as her parent: at most one and a half times its inflections, and two.
    ///
    /// # Errors
    /// [`Failure::Check`] (E505) otherwise; the files are those of the daughter all the same.
    pub fn verdict(&self) -> Result<(), Failure> {
        is_about_as_fair("daughter", self.inflections)
    }
}

/// That a hull has at most one and a half times the inflections before, and two.
///
/// # Errors
/// [`Failure::Check`] (E505) otherwise.
pub(in crate::report) fn is_about_as_fair(what: &str, [before, after]: [usize; 2]) -> Result<(), Failure> {
    if crate::derivation::is_about_as_fair(before, after) {
        return Ok(());
    }
    Err(Failure::Check(format!(
        "E505 the targets are met, and the {what} is not fair: {before} > {after} inflections of stations and waterlines"
    )))
}

/// Part of B by which the breadth of the waterline may change without a warning.
const SAME_BREADTH: f64 = 1e-3;
/// Part of its length below which a parallel middle body is lost.
const SHORTER: f64 = 0.5;

/// The scaled parent and the daughter at the draught of the targets; none where one does not float there.
fn rows(derived: &Derived, conventions: &Conventions) -> Option<[Hydrostatics; 2]> {
    let row = |hull: &Hull| CurvesOfForm::new(hull, &[derived.reference.draught], conventions).rows.pop();
    let (scaled, own) = join(|| row(&derived.scaled), || row(&derived.hull));
    Some([scaled?, own?])
}

/// Ends of the parallel middle body \[m\].
fn middle_body(row: &Hydrostatics) -> Option<[f64; 2]> {
    Some([row.parallel_body_aft?, row.parallel_body_fore?])
}

fn warnings(job: &DeriveJob, derived: &Derived, rows: Option<&[Hydrostatics; 2]>) -> Vec<String> {
    let warning = |code: &'static str, message: String, help: &str| {
        Diagnostic { severity: Severity::Warning, ..problem(code, &job.parent, message, help) }.to_string()
    };
    let mut found = Vec::new();
    let [before, after] = derived.inflections;
    if after > before {
        let message =
            format!("the daughter has {after} inflections of stations and waterlines, its scaled parent {before}");
        let help = "Give targets nearer to the parent, free one that is kept, or fair the table of the daughter";
        found.push(warning("W420", message, help));
    }
    let Some(rows) = rows else { return found };
    let ([scaled, own], whole) = (rows.each_ref().map(|row| row.waterline_breadth), derived.reference.breadth);
    if (own - scaled).abs() > SAME_BREADTH * whole {
        let message = format!(
            "the waterline of the daughter is {own:.3} m broad, that of the scaled parent {scaled:.3} m: B and the coefficients are \
             those of {whole:.3} m"
        );
        found.push(warning(
            "W422",
            message,
            "Give a shorter parallel body, more displacement or C_M, or the B that is wanted",
        ));
    }
    let length = |body: [f64; 2]| body[1] - body[0];
    let [scaled, own] = rows.each_ref().map(middle_body);
    let lost = scaled.filter(|body| own.is_none_or(|own| length(own) < SHORTER * length(*body)));
    if let Some([aft, fore]) = lost.filter(|_| derived.parallel_body.is_none()) {
        let rest = own.map_or("none".to_owned(), |[aft, fore]| format!("one from {aft:.3} to {fore:.3} m"));
        let message = format!(
            "the scaled parent has a parallel middle body from {aft:.3} to {fore:.3} m, and the daughter {rest}: the targets leave it no room"
        );
        found.push(warning(
            "W423",
            message,
            "Give targets nearer to the parent, or the body that is wanted (--parallel-body)",
        ));
    }
    found
}

fn daughter_name(parent: &Hull) -> String {
    let parent = parent.name();
    if parent.ends_with("daughter") { parent.to_owned() } else { format!("{parent} daughter") }
}

/// A target in the summary of a hull.
pub(in crate::report) fn target_line(target: &DerivedTarget) -> TargetLine {
    TargetLine {
        key: target.key.clone(),
        requested: target.requested,
        achieved: target.achieved,
        error: target.achieved - target.requested,
        origin: target.origin,
    }
}

/// Every file of a daughter: those of `generate`, `derive.json`, the comparison, `report.md` and the manifest.
///
/// # Errors
/// [`Failure::FileSystem`] when an input cannot be read again for its hash; [`Failure::Internal`] when a figure cannot be
/// drawn.
pub fn derive_files(job: &DeriveJob, outputs: &DeriveOutputs, drawn: bool) -> Result<Vec<OutputFile>, Failure> {
    let record = json_file("derive.json", &derive_json(&outputs.report()))?;
    let inputs: Vec<PathBuf> = [input_file(&job.parent)].into_iter().chain(job.other_inputs()).collect();
    let mut records = vec![record];
    if let Some(waves) = outputs.derived.waves.as_ref().filter(|_| drawn) {
        records.extend(trade_files(&outputs.outputs.summary.name, waves)?);
    }
    run_files(&outputs.outputs, records, &outputs.comparison, &inputs, drawn)
}
