//! `loftsman new [NAME]`

use std::path::PathBuf;

use clap::Args;

use super::stream;
use crate::config::{TEMPLATES, template};
use crate::report::Failure;

#[derive(Debug, Args)]
pub(super) struct Arguments {
    /// What to begin with; without it the names are listed
    #[arg(value_parser = clap::builder::PossibleValuesParser::new(TEMPLATES.iter().map(|t| t.name)))]
    preset: Option<String>,
    /// File to write instead of stdout
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Overwrite the file when it is there already
    #[arg(long)]
    force: bool,
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    match &arguments.preset {
        Some(name) => {
            stream::data_or_file(template(name).unwrap_or_default(), arguments.output.as_deref(), arguments.force)
        }
        None => {
            let list: String = TEMPLATES.iter().map(|t| format!("{:<14} {}\n", t.name, t.title)).collect();
            stream::data_or_file(list, arguments.output.as_deref(), arguments.force)
        }
    }
}
