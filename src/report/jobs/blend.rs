//! The job of `blend`: hulls and weights or targets become a hull, its files as of `generate`, and a comparison with one of them.

use std::path::PathBuf;

use super::compare::hulls::CompareOutputs;
use super::compare::run::other_conventions;
use super::derive::{is_about_as_fair, target_line};
use super::derived_hull::{DerivedHull, input_file, refused, run_files, stability_is_whole, stated_targets};
use super::outputs::Outputs;
use crate::config::{DeriveFile, Diagnostic, Severity};
use crate::derivation::{Blend, BlendRequest, BlendTarget, Dimension, Dimensions, blend};
use crate::exchange::{BlendPart, BlendReport, DerivedTarget, blend_json};
use crate::numeric::join;
use crate::plot::Figure;
use crate::report::failure::{Failure, problem};
use crate::report::input::source::{Overrides, Source, read_source_with};
use crate::report::output::files::OutputFile;
use crate::report::output::manifest::json_file;
use crate::units::parse_length;

/// Part of L_PP that a hull may move on its way to the common chart before a warning tells of it.
const MOVED: f64 = 1e-4;

/// Keys that one hull of a blend may have: its design draught, and conventions of its table or body.
pub const HULL_KEYS: [&str; 9] =
    ["T", "units", "up", "axes", "body", "parts", "stations", "station_spacing", "waterline_spacing"];

/// A convention of one hull of a blend.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct OfHull {
    /// Its number in the order of the hulls, from 1.
    pub number: usize,
    /// One of [`HULL_KEYS`].
    pub key: &'static str,
    /// The value, as it would stand in the file beside a table.
    pub value: String,
}

/// What is asked for.
#[derive(Debug, Clone, Default)]
pub struct BlendJob {
    /// The hulls: hulls, folders of results, designs, tables, meshes or CAD files.
    pub hulls: Vec<PathBuf>,
    /// Conventions of tables and bodies over those of their files, of all hulls.
    pub overrides: Overrides,
    /// Those of single hulls, over these.
    pub of: Vec<OfHull>,
    /// Dimensions and targets of the blend.
    pub wanted: DeriveFile,
    /// The weights, where they are given.
    pub weights: Option<Vec<f64>>,
    /// Dimensions that may change for the targets.
    pub free: Vec<Dimension>,
    /// Whether the interval of each target is computed.
    pub intervals: bool,
}

/// What it comes to.
#[derive(Debug, Clone)]
pub struct BlendOutputs {
    /// The blend with its tables, figures and pages, as of `generate`.
    pub outputs: Outputs,
    /// How it was blended.
    #[doc(hidden)]
    pub blend: Blend,
    /// The blend beside the hull of largest weight.
    pub comparison: CompareOutputs,
    /// Its hulls.
    #[doc(hidden)]
    pub parts: Vec<BlendPart>,
    /// The targets.
    #[doc(hidden)]
    pub targets: Vec<DerivedTarget>,
    /// Words of the dimensions that were free.
    pub free: Vec<&'static str>,
    /// Warnings, each with its code.
    pub warnings: Vec<String>,
    /// What was assumed when the hulls were read.
    pub notes: Vec<String>,
}

impl BlendOutputs {
    /// The weights, in the order of the hulls.
    #[must_use]
    pub fn weights(&self) -> Vec<f64> {
        self.parts.iter().map(|part| part.weight).collect()
    }

    /// What `blend.json` and the JSON of the command hold.
    #[must_use]
    #[doc(hidden)]
    pub fn report(&self) -> BlendReport<'_> {
        BlendReport {
            hulls: &self.parts,
            base: &self.parts[self.blend.base].name,
            is_linear: self.blend.is_linear,
            targets: &self.targets,
            free: &self.free,
            inflections: self.blend.inflections,
            warnings: &self.warnings,
        }
    }

    /// The most inflections of a hull that has a weight.
    fn most_inflections(&self) -> usize {
        self.parts.iter().filter(|part| part.weight > 0.0).map(|part| part.inflections).max().unwrap_or(0)
    }

    /// Whether the blend is about as fair as its hulls: at most one and a half times their inflections, and two.
    ///
    /// # Errors
    /// [`Failure::Check`] (E505) otherwise; the files are written all the same.
    pub fn verdict(&self) -> Result<(), Failure> {
        is_about_as_fair("blend", [self.most_inflections(), self.blend.inflections])
    }
}

fn request(job: &BlendJob, density: f64) -> BlendRequest {
    let wanted = &job.wanted;
    let [length, breadth, draught, depth] = wanted.dimensions;
    BlendRequest {
        dimensions: Dimensions { length, breadth, draught, depth },
        weights: job.weights.clone(),
        block_coefficient: wanted.coefficients[0],
        centres: wanted.centres,
        targets: stated_targets(wanted, density),
        free: job.free.clone(),
    }
}

fn target(reached: &BlendTarget) -> DerivedTarget {
    let quantity = reached.target.quantity;
    DerivedTarget {
        key: quantity.label(),
        unit: quantity.unit(),
        origin: reached.target.origin.as_str(),
        scaled: reached.of_hulls.iter().sum::<f64>() / reached.of_hulls.len().max(1) as f64,
        requested: reached.target.value,
        achieved: reached.achieved,
        price: None,
        interval: reached.interval.map(|found| [found.low, found.high]),
        keeps_signs: false,
    }
}

/// Blends the hulls, with tables, figures and the comparison with the hull of largest weight.
///
/// # Errors
/// Those of [`read_source_with`]; [`Failure::Infeasible`] (E420) where no weights meet the targets, with what is within
/// reach; [`Failure::Options`] for weights and targets that do not go together (E423), values that no ship has (E421) and
/// profiles without a common chart (E424).
pub fn blend_outputs(job: &BlendJob, figures: &[Figure]) -> Result<BlendOutputs, Failure> {
    stability_is_whole(&job.wanted)?;
    let sources: Vec<Source> = (0..job.hulls.len()).map(|k| source(job, k)).collect::<Result<_, _>>()?;
    if let Some(beyond) = job.of.iter().find(|own| own.number > job.hulls.len()) {
        let message = format!("--of names hull {}, and {} are given", beyond.number, job.hulls.len());
        return Err(Failure::Usage(message));
    }
    let without = sources.iter().zip(&job.hulls).filter(|(source, _)| source.hull.particulars().draught.is_none());
    let without: Vec<Diagnostic> = without.map(|(_, path)| no_draught(path)).collect();
    if !without.is_empty() {
        return Err(Failure::Input(without));
    }
    let conventions = sources[0].conventions;
    let hulls: Vec<_> = sources.iter().map(|source| source.hull.clone()).collect();
    let made = blend(&hulls, &request(job, conventions.density), &conventions, job.intervals)
        .map_err(|refusals| refused(refusals, &job.wanted, None))?;
    let of = |k: usize| BlendPart {
        name: hulls[k].name().to_owned(),
        weight: made.parents[k].weight,
        moved: made.parents[k].error,
        inflections: made.parents[k].inflections,
        values: made.targets.iter().map(|target| target.of_hulls[k]).collect(),
    };
    let parts: Vec<BlendPart> = (0..hulls.len()).map(of).collect();
    let targets: Vec<DerivedTarget> = made.targets.iter().map(target).collect();
    let mut warnings = warnings(job, &made, &parts);
    let remedy = "Blend what states the same, or make the hull with the conventions of the first";
    let first = (job.hulls[0].as_path(), &conventions);
    let others = sources.iter().zip(&job.hulls).skip(1);
    warnings.extend(
        others.filter_map(|(source, path)| {
            other_conventions([first, (path.as_path(), &source.conventions)], "all", remedy)
        }),
    );
    let heaviest =
        parts.iter().enumerate().fold(0, |best, (k, part)| if part.weight > parts[best].weight { k } else { best });
    let names: Vec<&str> = parts.iter().filter(|part| part.weight > 0.0).map(|part| part.name.as_str()).collect();
    let derived = DerivedHull {
        hull: made.hull.clone().with_name(format!("blend of {}", names.join(" and "))),
        family: "blend",
        conventions: DerivedHull::conventions(conventions),
        targets: targets.iter().map(target_line).collect(),
        warnings: &warnings,
        input: input_file(&job.hulls[0]),
    };
    let (comparison, outputs) =
        join(|| derived.beside(&made.parents[heaviest].scaled, ["hull", "blend"]), || derived.outputs(figures));
    let notes = sources.iter().flat_map(|source| source.notes.iter().cloned()).collect();
    let free = job.free.iter().map(|dimension| dimension.word()).collect();
    Ok(BlendOutputs { outputs: outputs?, blend: made, comparison, parts, targets, free, warnings, notes })
}

/// A hull with its own conventions over those of all, at its own draught.
fn source(job: &BlendJob, k: usize) -> Result<Source, Failure> {
    let own = || job.of.iter().filter(move |own| own.number == k + 1);
    let mut overrides = job.overrides.clone();
    for OfHull { key, value, .. } in own().filter(|own| own.key != "T") {
        overrides.keys.retain(|(other, _)| other != key);
        overrides.keys.push((key, value.clone()));
    }
    let source = read_source_with(&job.hulls[k], &overrides)?;
    let Some(draught) = own().rfind(|own| own.key == "T") else { return Ok(source) };
    let place = format!("--of {}:T={}", draught.number, draught.value);
    let metres = parse_length(&draught.value).map_err(|error| Failure::Usage(format!("{place}: {error}")))?;
    let hull = source.hull.with_draught(metres).map_err(|error| Failure::Usage(format!("{place}: {error}")))?;
    Ok(Source { hull, ..source })
}

fn no_draught(path: &std::path::Path) -> Diagnostic {
    let message = "states no draught, at which the hulls of a blend are brought together".to_owned();
    problem(
        "E184",
        path,
        message,
        "State its own with --of N:T=9.5, N its number, or in its side file; --draught is that of the blend",
    )
}

fn warning(code: &'static str, path: &std::path::Path, message: String, help: &str) -> String {
    Diagnostic { severity: Severity::Warning, ..problem(code, path, message, help) }.to_string()
}

fn warnings(job: &BlendJob, made: &Blend, parts: &[BlendPart]) -> Vec<String> {
    let mut found = Vec::new();
    let length = made.hull.particulars().length_between_perpendiculars;
    for (part, path) in parts.iter().zip(&job.hulls).filter(|(part, _)| part.weight > 0.0) {
        if part.moved > MOVED * length {
            let base = &parts[made.base].name;
            let message =
                format!("{} moves by {:.1} mm at most on its way to the chart of {base}", part.name, 1e3 * part.moved);
            found.push(warning("W421", path, message, "Blend hulls whose profiles and knuckles are alike"));
        }
    }
    let counts: Vec<usize> = parts.iter().filter(|part| part.weight > 0.0).map(|part| part.inflections).collect();
    if made.inflections > counts.iter().copied().max().unwrap_or(0) {
        let list = counts.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ");
        let message =
            format!("the blend has {} inflections of stations and waterlines, its hulls {list}", made.inflections);
        let help = "Blend hulls that are more alike, or fair the table of the blend";
        found.push(warning("W420", &job.hulls[0], message, help));
    }
    found
}

/// Every file of a blend: those of `generate`, `blend.json`, the comparison, `report.md` and the manifest.
///
/// # Errors
/// [`Failure::FileSystem`] when an input cannot be read again for its hash; [`Failure::Internal`] when a figure cannot be
/// drawn.
pub fn blend_files(job: &BlendJob, outputs: &BlendOutputs, drawn: bool) -> Result<Vec<OutputFile>, Failure> {
    let record = json_file("blend.json", &blend_json(&outputs.report()))?;
    let inputs: Vec<PathBuf> = job.hulls.iter().map(|path| input_file(path)).collect();
    run_files(&outputs.outputs, vec![record], &outputs.comparison, &inputs, drawn)
}
