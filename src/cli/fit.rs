//! `loftsman fit TABLE|METHOD`

use std::path::PathBuf;

use clap::Args;

use super::run_files::{Figures, RunFiles};
use super::{positive, stream};
use crate::plot::Figure;
use crate::report::{Destination, Failure, Inputs, fit_outputs, fit_page, read_fit_with};

#[derive(Debug, Args)]
#[command(after_help = super::TABLES)]
pub(super) struct Arguments {
    /// A table of offsets, or a method file (TOML) that names one
    #[arg(value_name = "TABLE|METHOD")]
    input: PathBuf,
    /// How: graded, bilinear, least-squares, uniform-bicubic, quadratic-net, parametric-stations, or a method file
    /// [default: graded]
    #[arg(long, value_name = "NAME|FILE")]
    method: Option<String>,
    /// Design draught above the base line [m] [default: of the table, where it states one; without it no displacement and
    /// no coefficients]
    #[arg(long, alias = "draft", value_parser = positive, value_name = "T", allow_hyphen_values = true)]
    draught: Option<f64>,
    #[command(flatten)]
    conventions: super::BodyFlags,
    #[command(flatten)]
    stations: super::StationFlags,
    #[command(flatten)]
    files: RunFiles,
    #[command(flatten)]
    figures: Figures,
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let conventions = arguments.stations.with(&arguments.conventions);
    let job = read_fit_with(&arguments.input, arguments.method.as_deref(), arguments.draught, &conventions)?;
    let shown = |code: &str| code != "W306" || !arguments.files.quiet;
    job.warnings().filter(|warning| shown(warning.code)).for_each(|warning| stream::message(&warning.to_string()));
    let figures = arguments.figures.chosen(&arguments.files, &Figure::ALL.map(Figure::key));
    let folder = arguments.files.folder(&arguments.input, false);
    let outputs = fit_outputs(&job, &figures)?;
    let destination = Destination { folder: &folder, inputs: &Inputs::of(job.files()), force: arguments.files.force };
    destination.write_run(&outputs.files)?;
    if arguments.files.json {
        stream::data(&stream::json(&outputs.summary)?)
    } else if arguments.files.quiet {
        Ok(())
    } else {
        stream::data(&fit_page(&job, &outputs, &folder.display().to_string()))
    }
}
