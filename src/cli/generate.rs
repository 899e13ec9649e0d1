//! `loftsman generate DESIGN`

use std::path::{Path, PathBuf};

use clap::Args;

use super::run_files::{Figures, RunFiles};
use super::stream;
use crate::report::{Destination, Failure, generate_outputs, read_design, summary_page};

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
    let several = arguments.designs.len() > 1;
    let folders: Vec<PathBuf> = arguments.designs.iter().map(|path| arguments.files.folder(path, several)).collect();
    for (k, folder) in folders.iter().enumerate() {
        if let Some(other) = folders[..k].iter().position(|other| other == folder) {
            let [first, second] = [other, k].map(|k| arguments.designs[k].display());
            return Err(Failure::Usage(format!(
                "{first} and {second} would both be written to {}; rename one, or generate each with its own -o",
                folder.display()
            )));
        }
    }
    arguments.designs.iter().zip(&folders).try_for_each(|(design, folder)| generate(arguments, design, folder))
}

fn generate(arguments: &Arguments, path: &Path, folder: &Path) -> Result<(), Failure> {
    let (design, bytes) = read_design(path)?;
    let figures = arguments.figures.chosen(&arguments.files, &design.output.figures);
    let outputs = generate_outputs(&design, (path, &bytes), &figures)?;
    let destination = Destination { folder, inputs: &arguments.designs, force: arguments.files.force };
    destination.write_run(&outputs.files)?;
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
