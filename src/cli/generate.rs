//! `loftsman generate DESIGN`

use std::path::{Path, PathBuf};

use clap::Args;

use super::run_files::{Figures, RunFiles};
use super::stream;
use crate::report::{Failure, generate_outputs, read_design, summary_page, write_run};

#[derive(Debug, Args)]
pub(super) struct Arguments {
    /// Design files: TOML, or .hgf
    #[arg(required = true, value_name = "DESIGN")]
    designs: Vec<PathBuf>,
    #[command(flatten)]
    files: RunFiles,
    #[command(flatten)]
    figures: Figures,
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    arguments.designs.iter().try_for_each(|design| generate(arguments, design))
}

fn generate(arguments: &Arguments, path: &Path) -> Result<(), Failure> {
    let (design, bytes) = read_design(path)?;
    let figures = arguments.figures.chosen(&arguments.files, &design.output.figures);
    let folder = arguments.files.folder(path, arguments.designs.len() > 1);
    let outputs = generate_outputs(&design, (path, &bytes), &figures)?;
    write_run(&folder, &outputs.files, arguments.files.force)?;
    if !arguments.files.quiet {
        for remark in &outputs.remarks {
            stream::message(&remark.to_string());
        }
    }
    if arguments.files.json {
        let summary = outputs.files.iter().find(|file| file.name == "summary.json");
        stream::data(&summary.map(|file| String::from_utf8_lossy(&file.contents)).unwrap_or_default())
    } else if arguments.files.quiet {
        Ok(())
    } else {
        stream::data(&summary_page(&outputs, &design.conventions, &folder.display().to_string()))
    }
}
