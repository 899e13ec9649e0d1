//! `loftsman check TABLE`

use std::path::PathBuf;

use clap::Args;

use super::stream;
use crate::report::{
    Destination, Failure, Inputs, accept, check_files, check_json, check_page, check_table_with, conventions_beside,
    source_files,
};

#[derive(Debug, Args)]
#[command(after_help = AFTER)]
pub(super) struct Arguments {
    /// Table of offsets, in any of the formats below
    table: PathBuf,
    #[command(flatten)]
    conventions: super::BodyFlags,
    #[command(flatten)]
    stations: super::StationFlags,
    /// One JSON object
    #[arg(long)]
    json: bool,
    /// Take over the proposals for these suspects and write the table with them, as S1,S3
    #[arg(long, value_delimiter = ',', value_name = "SUSPECTS")]
    accept: Vec<String>,
    /// Folder for the list and the figures; with --accept the file for the table, else stdout
    #[arg(short, long, value_name = "FOLDER|FILE")]
    output: Option<PathBuf>,
    /// No figures in the folder
    #[arg(long)]
    no_figures: bool,
    /// Overwrite files that are there already
    #[arg(long)]
    force: bool,
    /// Say nothing about what was detected
    #[arg(short, long)]
    quiet: bool,
}

const AFTER: &str = "\
Judged are offsets on waterlines (S1, S2, ...) and heights at buttocks (H1, ...), each against its neighbours in both directions, \
and sections as points (P1, ...), each point against the section through the others. Tables of lines, as boats have them, are \
judged along each line: its heights and its half-breadths (P1, ...).
JSON: judged, heights_judged, points_judged, points_not_judged, noise, suspects (id, of half-breadth, height, point or line; station, \
waterline or buttock, row, column, or branch, point, number, y, z, line; written, expected, score, hypothesis, proposed, probability, \
hypotheses), problems (code, row, message), lines (kind knuckle or tangent, course waterline or station, at, from, to, gain).
Exit code 5 with suspects or with problems of cells, 3 where the file has no table; remarks on how the file was read do not count.
Read are CSV and TSV (matrix, one offset a line, sections as points), XLSX, GHS (.gf), BRITFAIR (.bri), PIAS, PDSTRIP, SEAWAY, text \
of FREE!ship, tables of DELFTship, and tables of fractions of the half-breadth; a TOML file of the same name beside a table \
may say what it leaves open.";

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let inputs = source_files(&arguments.table);
    let conventions = arguments.stations.with(&arguments.conventions);
    let check = check_table_with(&arguments.table, &conventions)?;
    if !arguments.quiet {
        check.notes.iter().for_each(|note| stream::message(note));
    }
    if !arguments.accept.is_empty() {
        let accepted = accept(&check, &arguments.accept)?;
        if arguments.output.is_some() && arguments.json {
            stream::data(&stream::json_judged(check_json(&check), &check.verdict(&arguments.accept))?)?;
        }
        accepted.changes.iter().for_each(|change| stream::message(change));
        stream::Target { file: arguments.output.as_deref(), inputs: &inputs, force: arguments.force }.table(
            accepted.text,
            &accepted.form,
            conventions_beside(&arguments.table, &conventions)?,
        )?;
        return check.verdict(&arguments.accept);
    }
    if let Some(folder) = &arguments.output {
        Destination { folder, inputs: &Inputs::of(&inputs), force: arguments.force }
            .write(&check_files(&check, !arguments.no_figures)?)?;
    }
    let verdict = check.verdict(&[]);
    let json = || stream::json_judged(check_json(&check), &verdict);
    stream::data(&if arguments.json { json()? } else { check_page(&check) })?;
    verdict
}
