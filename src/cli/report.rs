//! `loftsman report RESULT`

use std::path::{Path, PathBuf};

use clap::Args;

use super::stream;
use crate::plot::Sheet;
use crate::report::{Destination, Failure, Inputs, ReportSettings, read_result, report_outputs, same_path};

#[derive(Debug, Args)]
#[command(after_help = AFTER)]
pub(super) struct Arguments {
    /// Folder that `generate`, `fit` or `fair` wrote, a JSON file in it, or the file of `hydro --json`
    #[arg(value_name = "RESULT")]
    result: PathBuf,
    /// Folder for the report [default: `report` in the folder of the result, else out/<name of the file>]
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
    /// Resolution of the pictures, 20 to 600 dots per inch; 300 for print. Memory grows with its square: about 1 GB at
    /// 600; what is to be larger is drawn from the SVG
    #[arg(long, value_parser = dpi, value_name = "DPI", default_value = "150")]
    dpi: f64,
    /// Sheets of report.pdf: A3, or A1 with larger drawings and the charts four to a sheet
    #[arg(long, value_parser = sheet, value_name = "SHEET", default_value = "A3")]
    sheet: Sheet,
    /// Lines of a faired table that bear combs, by kind and name or distance in metres: "station 5, waterline 2.0,
    /// buttock 1.5, diagonal 3"
    #[arg(long, value_parser = combs, value_name = "LINES")]
    combs: Option<String>,
    /// Date for the title blocks, as it is to stand there; without it they have none, so that the same result gives the
    /// same bytes
    #[arg(long, value_parser = date, value_name = "TEXT")]
    date: Option<String>,
    /// Overwrite files that are there already, and remove what an earlier report wrote and this one does not
    #[arg(long)]
    force: bool,
    /// Print nothing but errors
    #[arg(short, long)]
    quiet: bool,
}

const AFTER: &str = "\
Every figure is written as PNG and as SVG in millimetres; report.html holds all of them, tables that can be sorted and the hull in \
space, and opens without a network; report.pdf holds them at true size, each sheet with a check bar of 100 mm.
Of every hull: lines plan, body plan, sectional areas, hydrostatic curves, diagram sheet, Bonjean curves, maps of Gaussian and mean \
curvature and zebra stripes over the developed side. Of `fair`, besides: constraints and prices, suspects, moves as a map and as arrows \
in three views; the lines that moved most with the tolerances of their offsets, stations, waterlines, buttocks and diagonals before and \
after with combs (one scale for each kind of line); moves against the assumed noise, the search for the weight, deviation against fairness, convergence.
Tables: offsets, heights and diagonals in metres, millimetres and feet-inches-eighths; hydrostatics as CSV, JSON and XLSX with its \
conventions; Bonjean areas; changes.";

/// Resolution at which the pictures of a report take about 1 GB of memory [dots per inch].
const MOST_DPI: f64 = 600.0;

fn dpi(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(value) if (20.0..=MOST_DPI).contains(&value) => Ok(value),
        Ok(value) if value > MOST_DPI => {
            Err(format!("expected 20 to {MOST_DPI} dots per inch, which takes 1 GB; draw larger pictures from the SVG"))
        }
        _ => Err(format!("expected 20 to {MOST_DPI} dots per inch")),
    }
}

fn combs(text: &str) -> Result<String, String> {
    if text.split(',').all(|word| word.trim().is_empty()) {
        return Err("expected lines, as \"station 5, waterline 2.0\"; without --combs some of all bear them".to_owned());
    }
    Ok(text.to_owned())
}

fn sheet(text: &str) -> Result<Sheet, String> {
    let found = Sheet::ALL.into_iter().find(|sheet| sheet.as_str().eq_ignore_ascii_case(text));
    found.ok_or_else(|| "expected A3 or A1".to_owned())
}

fn date(text: &str) -> Result<String, String> {
    let text = text.trim();
    let fits = (1..=20).contains(&text.chars().count()) && !text.chars().any(char::is_control);
    if fits { Ok(text.to_owned()) } else { Err("expected 1 to 20 characters, as 2026-03-31".to_owned()) }
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let result = read_result(&arguments.result)?;
    let folder = match (&arguments.output, &result.folder) {
        (Some(folder), _) => folder.clone(),
        (None, Some(folder)) => folder.join("report"),
        (None, None) => Path::new("out").join(arguments.result.file_stem().unwrap_or_else(|| "report".as_ref())),
    };
    if result.folder.as_ref().is_some_and(|of| same_path(of, &folder)) {
        return Err(Failure::Usage(format!(
            "{} is the folder of the result; a report has a folder of its own (-o DIR)",
            folder.display()
        )));
    }
    let settings = ReportSettings {
        dots_per_inch: arguments.dpi,
        sheet: arguments.sheet,
        combs: arguments.combs.clone().unwrap_or_default(),
        date: arguments.date.clone(),
    };
    let inputs = Inputs::of(&[&arguments.result]);
    let destination = Destination { folder: &folder, inputs: &inputs, force: arguments.force };
    destination.check(["report.html", "report.pdf", "manifest.json"])?;
    let files = report_outputs(&result, &settings)?;
    destination.write_run(&files)?;
    if arguments.quiet {
        return Ok(());
    }
    result.notes.iter().for_each(|note| stream::message(note));
    let names: Vec<&str> = files.iter().map(|file| file.name.as_str()).collect();
    stream::data(&format!("Written to {}: {}\n", folder.display(), names.join(", ")))
}
