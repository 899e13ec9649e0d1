//! `loftsman blend A B --weights 0.4,0.6 -o DIR`, or `--cb 0.7 --lcb "-1 %"` in place of weights

use std::path::PathBuf;

use clap::Args;

use super::run_files::{FIGURES_OF_MADE, Figures, Made, RunFiles};
use super::target_flags::{TARGETS, TargetFlags};
use crate::derivation::Dimension;
use crate::exchange::blend_json;
use crate::report::{
    BlendJob, Destination, Failure, HULL_KEYS, Inputs, OfHull, blend_files, blend_outputs, blend_page, source_files,
};

#[derive(Debug, Args)]
#[command(after_help = AFTER)]
pub(super) struct Arguments {
    /// Hulls, two or more: hull.json, a folder that holds one, a design, a table of offsets, a mesh or CAD file, catalogue:NAME
    #[arg(required = true, value_name = "HULL")]
    hulls: Vec<PathBuf>,
    /// Weights in the order of the hulls, as 0.4,0.6; they sum to 1
    #[arg(long, value_delimiter = ',', value_name = "LIST", allow_hyphen_values = true, help_heading = TARGETS)]
    weights: Vec<f64>,
    #[command(flatten)]
    targets: TargetFlags,
    /// Dimension that may change for the targets: lpp, beam or draught; may be repeated
    #[arg(long, value_parser = dimension, value_name = "NAME", help_heading = TARGETS)]
    free: Vec<Dimension>,
    /// Convention of one hull, as 2:T=9.5 or 1:units=ft; keys: T, units, up, axes, body, parts, stations, station_spacing,
    /// waterline_spacing; may be repeated
    #[arg(long, value_parser = of_hull, value_name = "N:KEY=VALUE")]
    of: Vec<OfHull>,
    /// Print what each target can be with the others as they are; without --output no files are written
    #[arg(long)]
    limits: bool,
    #[command(flatten)]
    conventions: super::BodyFlags,
    #[command(flatten)]
    stations: super::StationFlags,
    #[command(flatten)]
    files: RunFiles,
    #[command(flatten)]
    figures: Figures,
}

const AFTER: &str = "\
Hulls are brought to common dimensions, those of the first unless an option names others, and to one chart. \
Half-breadths of the blend lie between those of the hulls. Profiles that differ are blended with the same weights.
Without weights they follow from the targets: the weights nearest to equal ones that meet them to rounding. k hulls meet k - 1 targets, and one \
more for each dimension that is free.
Files: those of generate, blend.json, compare.md, compare.csv, compare.json and the figures that compare the blend with the hull of \
largest weight. Exit code 4 when no weights meet the targets; the message states what is within reach.";

fn dimension(word: &str) -> Result<Dimension, String> {
    let found = Dimension::ALL.into_iter().find(|dimension| dimension.word() == word);
    found.ok_or_else(|| format!("{word:?} is none of lpp, beam, draught"))
}

/// `2:T=9.5`
fn of_hull(text: &str) -> Result<OfHull, String> {
    let expected = || format!("expected N:KEY=VALUE with a KEY of {}", HULL_KEYS.join(", "));
    let (number, rest) = text.split_once(':').ok_or_else(expected)?;
    let (key, value) = rest.split_once('=').ok_or_else(expected)?;
    let number = number.trim().parse::<usize>().ok().filter(|number| *number > 0).ok_or_else(expected)?;
    let key = HULL_KEYS.into_iter().find(|known| *known == key.trim()).ok_or_else(expected)?;
    if key == "T" {
        super::positive(value.trim())?;
    }
    Ok(OfHull { number, key, value: value.trim().to_owned() })
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let job = BlendJob {
        hulls: arguments.hulls.clone(),
        overrides: arguments.stations.with(&arguments.conventions),
        of: arguments.of.clone(),
        wanted: arguments.targets.wanted(&[])?,
        weights: (!arguments.weights.is_empty()).then(|| arguments.weights.clone()),
        free: arguments.free.clone(),
        intervals: arguments.limits,
    };
    let folder = arguments.files.folder(&arguments.hulls[0], false);
    let read: Vec<PathBuf> = job.hulls.iter().flat_map(|path| source_files(path)).collect();
    let inputs = Inputs::of(&read);
    let destination = Destination { folder: &folder, inputs: &inputs, force: arguments.files.force };
    let is_written = arguments.files.is_written(arguments.limits);
    let mut figures = Vec::new();
    if is_written {
        destination.check(["hull.json", "blend.json", "manifest.json"])?;
        figures = arguments.figures.chosen(&arguments.files, &FIGURES_OF_MADE);
    }
    let outputs = blend_outputs(&job, &figures)?;
    let made = Made { is_written, notes: &outputs.notes, warnings: &outputs.warnings, verdict: outputs.verdict() };
    arguments.files.finish(
        &destination,
        made,
        || blend_files(&job, &outputs, !arguments.files.no_figures),
        || blend_json(&outputs.report()),
        || blend_page(&outputs),
    )
}
