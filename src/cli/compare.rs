//! `loftsman compare A B`

use std::path::PathBuf;

use clap::Args;

use super::{positive, stream};
use crate::exchange::compare_json;
use crate::report::{
    CompareJob, Destination, Failure, Inputs, compare_files, compare_outputs, compare_page, source_files,
};

#[derive(Debug, Args)]
#[command(after_help = AFTER)]
pub(super) struct Arguments {
    /// hull.json, a folder that holds one, a design file, a table of offsets, or a mesh or CAD file, as of hydro
    first: PathBuf,
    /// The other hull, which is measured by the first
    second: PathBuf,
    /// Draught of both above the base line, even keel [default: of each hull, where one is stated]
    #[arg(long, alias = "draft", value_parser = positive, value_name = "T")]
    draught: Option<f64>,
    #[command(flatten)]
    conventions: super::BodyFlags,
    #[command(flatten)]
    stations: super::StationFlags,
    /// Folder for compare.md, compare.csv, compare.json, the figures and manifest.json
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
    /// Overwrite files that are there already
    #[arg(long)]
    force: bool,
    /// Draw no figures
    #[arg(long)]
    no_figures: bool,
    /// Print the result as JSON on stdout instead of the page
    #[arg(long)]
    json: bool,
    /// Print no notes about what was assumed
    #[arg(short, long)]
    quiet: bool,
}

const AFTER: &str = "\
Changes are second less first, in per cent of the first. Those of LCB and LCF are per cent of Lpp.
Distances are those of nearest points of the surfaces as both stand: x from AP, z from the base line. Their largest, its place, the root \
of the mean square and the mean are printed.";

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let job = CompareJob {
        hulls: [arguments.first.clone(), arguments.second.clone()],
        overrides: arguments.stations.with(&arguments.conventions),
        draught: arguments.draught,
    };
    let outputs = compare_outputs(&job)?;
    if !arguments.quiet {
        outputs.notes.iter().for_each(|note| stream::message(note));
    }
    outputs.warnings.iter().for_each(|warning| stream::message(warning));
    if let Some(folder) = &arguments.output {
        let read: Vec<PathBuf> = job.hulls.iter().flat_map(|path| source_files(path)).collect();
        let inputs = Inputs::of(&read);
        Destination { folder, inputs: &inputs, force: arguments.force }
            .write_run(&compare_files(&outputs, !arguments.no_figures)?)?;
    }
    stream::data(&if arguments.json { stream::json(&compare_json(&outputs.file()))? } else { compare_page(&outputs) })
}
