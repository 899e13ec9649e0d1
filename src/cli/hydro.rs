//! `loftsman hydro HULL --draughts LIST`

use std::path::PathBuf;

use clap::Args;

use super::{Lengths, lengths, stream};
use crate::exchange::{hydrostatics_csv, hydrostatics_json};
use crate::hydrostatics::CurvesOfForm;
use crate::report::{Failure, hydrostatics_page, read_source};

#[derive(Debug, Args)]
pub(super) struct Arguments {
    /// hull.json, a folder that holds one, or a design file
    hull: PathBuf,
    /// Draughts above the base line [m], as 1:9:1
    #[arg(long, alias = "drafts", value_parser = lengths, value_name = "LIST", allow_hyphen_values = true)]
    draughts: Lengths,
    /// Every quantity as CSV
    #[arg(long, conflicts_with = "json")]
    csv: bool,
    /// Every quantity as JSON
    #[arg(long)]
    json: bool,
    /// File to write instead of stdout
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Overwrite the file when it is there already
    #[arg(long)]
    force: bool,
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let source = read_source(&arguments.hull)?;
    let table = CurvesOfForm::new(&source.hull, &arguments.draughts.0, &source.conventions);
    let text = if arguments.json {
        stream::json(&hydrostatics_json(&table))?
    } else if arguments.csv {
        hydrostatics_csv(&table)
    } else {
        hydrostatics_page(&table)
    };
    stream::data_or_file(text, arguments.output.as_deref(), arguments.force)
}
