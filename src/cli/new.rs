//! `loftsman new [NAME]`

use std::path::PathBuf;

use clap::Args;

use super::stream;
use crate::config::{PRESET_ALIASES, TEMPLATES, template};
use crate::report::Failure;

#[derive(Debug, Args)]
pub(super) struct Arguments {
    /// What to begin with; without it the names are listed
    #[arg(value_parser = clap::builder::PossibleValuesParser::new(words()))]
    preset: Option<String>,
    /// File to write instead of stdout
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Overwrite the file when it is there already
    #[arg(long)]
    force: bool,
}

/// Every word that names a template.
fn words() -> impl Iterator<Item = &'static str> {
    TEMPLATES.iter().map(|t| t.name).chain(PRESET_ALIASES.iter().map(|(alias, _)| *alias))
}

/// The other words for a template, for the list.
fn also(name: &str) -> String {
    let words: Vec<&str> =
        PRESET_ALIASES.iter().filter(|(_, preset)| *preset == name).map(|(alias, _)| *alias).collect();
    if words.is_empty() { String::new() } else { format!(" (also: {})", words.join(", ")) }
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let text = match &arguments.preset {
        Some(name) => template(name).unwrap_or_default(),
        None => TEMPLATES.iter().map(|t| format!("{:<14} {}{}\n", t.name, t.title, also(t.name))).collect(),
    };
    stream::Target { file: arguments.output.as_deref(), inputs: &[], force: arguments.force }.text(text)
}
