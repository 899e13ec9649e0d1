//! `loftsman fit TABLE|METHOD`

use std::path::{Path, PathBuf};

use clap::Args;

use super::generate::figure;
use super::{length, stream};
use crate::plot::Figure;
use crate::report::{Failure, fit_outputs, fit_page, read_fit, write_run};

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
    /// Design draught above the base line [m] [default: of the table]
    #[arg(long, alias = "draft", value_parser = length, value_name = "T")]
    draught: Option<f64>,
    /// Folder for the files [default: out/<name of the input>]
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
    /// Overwrite files that are there already, and remove what an earlier run wrote and this one does not
    #[arg(long)]
    force: bool,
    /// Print fit.json on stdout instead of the page
    #[arg(long)]
    json: bool,
    /// Draw no figures
    #[arg(long, conflicts_with = "figures")]
    no_figures: bool,
    /// Figures to draw, with commas between them [default: all]
    #[arg(long, value_delimiter = ',', value_parser = figure, value_name = "LIST")]
    figures: Vec<Figure>,
    /// Print nothing but errors
    #[arg(short, long)]
    quiet: bool,
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let job = read_fit(&arguments.input, arguments.method.as_deref(), arguments.draught)?;
    let figures: Vec<Figure> = match (arguments.no_figures, arguments.figures.is_empty()) {
        (true, _) => Vec::new(),
        (false, true) => Figure::ALL.to_vec(),
        (false, false) => arguments.figures.clone(),
    };
    let name = arguments.input.file_stem().unwrap_or_else(|| "table".as_ref());
    let folder = arguments.output.clone().unwrap_or_else(|| Path::new("out").join(name));
    let outputs = fit_outputs(&job, &figures)?;
    write_run(&folder, &outputs.files, arguments.force)?;
    if arguments.json {
        stream::data(&stream::json(&outputs.summary)?)
    } else if arguments.quiet {
        Ok(())
    } else {
        stream::data(&fit_page(&job, &outputs, &folder.display().to_string()))
    }
}
