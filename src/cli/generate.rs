//! `loftsman generate DESIGN`

use std::path::{Path, PathBuf};

use clap::Args;

use super::stream;
use crate::plot::Figure;
use crate::report::{Failure, generate_outputs, read_design, summary_page, write_run};

#[derive(Debug, Args)]
pub(super) struct Arguments {
    /// Design files: TOML, or .hgf
    #[arg(required = true, value_name = "DESIGN")]
    designs: Vec<PathBuf>,
    /// Folder for the files; with several designs, a folder in it for each [default: out/<name of the design file>]
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
    /// Overwrite files that are there already, and remove what an earlier run wrote and this one does not
    #[arg(long)]
    force: bool,
    /// Print summary.json on stdout instead of the page
    #[arg(long)]
    json: bool,
    /// Draw no figures
    #[arg(long, conflicts_with = "figures")]
    no_figures: bool,
    /// Figures to draw, with commas between them [default: those of the design, or all]
    #[arg(long, value_delimiter = ',', value_parser = figure, value_name = "LIST")]
    figures: Vec<Figure>,
    /// Print nothing but errors
    #[arg(short, long)]
    quiet: bool,
}

pub(super) fn figure(word: &str) -> Result<Figure, String> {
    Figure::ALL
        .into_iter()
        .find(|figure| figure.key() == word.trim())
        .ok_or_else(|| format!("known figures are {}", Figure::ALL.map(Figure::key).join(", ")))
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    arguments.designs.iter().try_for_each(|design| generate(arguments, design))
}

/// Where the files of one design go.
fn folder(arguments: &Arguments, design: &Path) -> PathBuf {
    let name = design.file_stem().unwrap_or_else(|| "design".as_ref());
    match &arguments.output {
        Some(folder) if arguments.designs.len() == 1 => folder.clone(),
        Some(folder) => folder.join(name),
        None => Path::new("out").join(name),
    }
}

fn generate(arguments: &Arguments, path: &Path) -> Result<(), Failure> {
    let (design, bytes) = read_design(path)?;
    let figures: Vec<Figure> = if arguments.no_figures {
        Vec::new()
    } else if arguments.figures.is_empty() {
        Figure::ALL.into_iter().filter(|figure| design.output.figures.contains(&figure.key())).collect()
    } else {
        arguments.figures.clone()
    };
    let folder = folder(arguments, path);
    let outputs = generate_outputs(&design, (path, &bytes), &figures)?;
    write_run(&folder, &outputs.files, arguments.force)?;
    if !arguments.quiet {
        for remark in &outputs.remarks {
            stream::message(&remark.to_string());
        }
    }
    if arguments.json {
        let summary = outputs.files.iter().find(|file| file.name == "summary.json");
        stream::data(&summary.map(|file| String::from_utf8_lossy(&file.contents)).unwrap_or_default())
    } else if arguments.quiet {
        Ok(())
    } else {
        stream::data(&summary_page(&outputs, &design.conventions, &folder.display().to_string()))
    }
}
