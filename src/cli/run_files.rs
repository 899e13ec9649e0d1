//! What the commands that write a folder of files have in common: where, over what, which figures, what is printed.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};

use clap::Args;

use super::stream;
use crate::plot::Figure;
use crate::report::{Destination, Failure, OutputFile};

/// The options of a command that writes a folder of files.
#[derive(Debug, Args)]
pub(super) struct RunFiles {
    /// Folder for the files; with several inputs, a folder in it for each [default: out/<name of the input>]
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
    /// Overwrite files that are there already, and remove what an earlier run wrote and this one does not
    #[arg(long)]
    pub(super) force: bool,
    /// Draw no figures
    #[arg(long)]
    pub(super) no_figures: bool,
    /// Print the result as JSON (summary.json; of fit fit.json, of fair fairing.json) on stdout instead of the page
    #[arg(long)]
    pub(super) json: bool,
    /// Print nothing but errors
    #[arg(short, long)]
    pub(super) quiet: bool,
}

/// What files about an input are called: its name without ending, or `hull` of standard input.
pub(super) fn stem(input: &Path) -> &OsStr {
    let stem = input.file_stem().filter(|stem| *stem != "-").unwrap_or_else(|| "hull".as_ref());
    stem.to_str().and_then(|name| name.strip_prefix("catalogue:")).map_or(stem, OsStr::new)
}

/// The figures that a command that makes one hull from others draws where none are chosen.
pub(super) const FIGURES_OF_MADE: [&str; 5] = ["lines", "sections", "sectional-area", "hydrostatics", "diagram-sheet"];

/// What a command that makes one hull from others comes to.
pub(super) struct Made<'a> {
    /// Whether its files are written.
    pub(super) is_written: bool,
    pub(super) notes: &'a [String],
    pub(super) warnings: &'a [String],
    pub(super) verdict: Result<(), Failure>,
}

impl RunFiles {
    /// Prints notes and warnings, writes the files, and prints the record as JSON or the page; ends with the verdict.
    pub(super) fn finish(
        &self,
        destination: &Destination<'_>,
        made: Made<'_>,
        files: impl FnOnce() -> Result<Vec<OutputFile>, Failure>,
        record: impl FnOnce() -> serde_json::Value,
        page: impl FnOnce() -> String,
    ) -> Result<(), Failure> {
        if !self.quiet {
            made.notes.iter().for_each(|note| stream::message(note));
        }
        made.warnings.iter().for_each(|warning| stream::message(warning));
        if made.is_written {
            destination.write_run(&files()?)?;
        }
        if self.json {
            stream::data(&stream::json_judged(record(), &made.verdict)?)?;
        } else if !self.quiet {
            stream::page(&page())?;
        }
        made.verdict
    }

    /// Whether files are written: not where limits alone are asked for, and no folder.
    pub(super) fn is_written(&self, limits: bool) -> bool {
        self.output.is_some() || !limits
    }

    /// The folder for the files about one input; `several` when the command was given more than one.
    pub(super) fn folder(&self, input: &Path, several: bool) -> PathBuf {
        let name = stem(input);
        match &self.output {
            Some(folder) if several => folder.join(name),
            Some(folder) => folder.clone(),
            None => Path::new("out").join(name),
        }
    }
}

/// The options of a command whose figures can be chosen.
#[derive(Debug, Args)]
pub(super) struct Figures {
    /// Figures to draw, with commas between them [default: those that the input names, or all]
    #[arg(long, value_delimiter = ',', value_parser = figure, value_name = "LIST", conflicts_with = "no_figures")]
    figures: Vec<Figure>,
}

impl Figures {
    /// The figures that were chosen, else those among `usual`; none with `--no-figures`.
    pub(super) fn chosen(&self, files: &RunFiles, usual: &[&str]) -> Vec<Figure> {
        if files.no_figures {
            Vec::new()
        } else if self.figures.is_empty() {
            Figure::ALL.into_iter().filter(|figure| usual.contains(&figure.key())).collect()
        } else {
            self.figures.clone()
        }
    }
}

fn figure(word: &str) -> Result<Figure, String> {
    Figure::ALL
        .into_iter()
        .find(|figure| figure.key() == word.trim())
        .ok_or_else(|| format!("known figures are {}", Figure::ALL.map(Figure::key).join(", ")))
}
