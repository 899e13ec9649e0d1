//! `loftsman generate DESIGN`

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use clap::Args;
use serde::Serialize;
use serde_json::Value;

use super::run_files::{Figures, RunFiles};
use super::stream;
use crate::exchange::SummaryFile;
use crate::report::{Destination, Failure, Inputs, generate_outputs, read_design, summary_page};

#[derive(Debug, Args)]
#[command(after_help = AFTER)]
pub(super) struct Arguments {
    /// Design files: TOML, or .hgf; - reads one from standard input
    #[arg(required = true, value_name = "DESIGN")]
    designs: Vec<PathBuf>,
    #[command(flatten)]
    files: RunFiles,
    #[command(flatten)]
    figures: Figures,
    /// Print one JSON object a line for each design: its summary.json, or its error
    #[arg(long, conflicts_with = "json")]
    jsonl: bool,
    /// Stop at the first design that fails
    #[arg(long)]
    fail_fast: bool,
}

const AFTER: &str = "\
After a design that fails the others are generated. A table of the failures follows, and the exit code is that of the first of them.
JSON of several designs: designs, for each its summary.json or {error: [...]}, in the order of the command.";

/// What is printed of one design.
#[derive(Serialize)]
#[serde(untagged)]
enum Answer {
    Made(Box<SummaryFile>),
    Failed(Value),
}

/// What `--json` prints of several designs.
#[derive(Serialize)]
struct Answers {
    designs: Vec<Answer>,
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let folders = folders(arguments)?;
    let inputs = Inputs::of(&arguments.designs);
    let (mut answers, mut failed) = (Vec::new(), Vec::new());
    let several = folders.len() > 1;
    for (path, folder) in arguments.designs.iter().zip(&folders) {
        let answer = match generate(arguments, path, folder, &inputs) {
            Ok(summary) => Answer::Made(Box::new(summary)),
            Err(failure) => {
                let answer = Answer::Failed(failure.to_json());
                if several {
                    stream::message(&failure.to_string());
                }
                failed.push((path.clone(), failure));
                answer
            }
        };
        if arguments.jsonl {
            let line = serde_json::to_string(&answer).map_err(|error| Failure::Internal(error.to_string()))?;
            stream::data(&(line + "\n"))?;
        } else if arguments.files.json {
            answers.push(answer);
        }
        if arguments.fail_fast && !failed.is_empty() {
            break;
        }
    }
    if arguments.files.json {
        print(answers, several)?;
    }
    match failed.pop() {
        None => Ok(()),
        Some((_, failure)) if !several => Err(failure),
        Some(last) => {
            failed.push(last);
            Err(Failure::Several { failed, of: folders.len() })
        }
    }
}

fn print(mut answers: Vec<Answer>, several: bool) -> Result<(), Failure> {
    match answers.pop() {
        Some(Answer::Made(summary)) if !several => stream::data(&stream::json(&summary)?),
        Some(Answer::Failed(_)) if !several => Ok(()),
        last => {
            answers.extend(last);
            stream::data(&stream::json(&Answers { designs: answers })?)
        }
    }
}

/// The folder of each design; no two have the same.
fn folders(arguments: &Arguments) -> Result<Vec<PathBuf>, Failure> {
    let several = arguments.designs.len() > 1;
    let folders: Vec<PathBuf> = arguments.designs.iter().map(|path| arguments.files.folder(path, several)).collect();
    let mut owners = HashMap::new();
    for (design, folder) in arguments.designs.iter().zip(&folders) {
        if let Some(other) = owners.insert(folder, design) {
            return Err(Failure::Usage(format!(
                "{} and {} would both be written to {}; rename one, or generate each with its own -o",
                other.display(),
                design.display(),
                folder.display()
            )));
        }
    }
    Ok(folders)
}

fn generate(arguments: &Arguments, path: &Path, folder: &Path, inputs: &Inputs) -> Result<SummaryFile, Failure> {
    let (design, bytes) = read_design(path)?;
    let figures = arguments.figures.chosen(&arguments.files, &design.output.figures);
    let outputs = generate_outputs(&design, (path, &bytes), &figures)?;
    let destination = Destination { folder, inputs, force: arguments.files.force };
    destination.write_run(&outputs.files)?;
    if !arguments.files.quiet {
        for remark in &outputs.remarks {
            stream::message(&remark.to_string());
        }
    }
    if !arguments.files.quiet && !arguments.files.json && !arguments.jsonl {
        stream::page(&summary_page(&outputs, &design.conventions, &folder.display().to_string()))?;
    }
    Ok(outputs.summary)
}
