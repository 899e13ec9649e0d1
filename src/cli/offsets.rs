//! `loftsman offsets HULL --stations LIST --waterlines LIST`

use std::path::PathBuf;

use clap::Args;

use super::{Lengths, lengths, stream};
use crate::exchange::{heights_csv, offsets_csv};
use crate::report::{Failure, offsets, read_source_with, source_files};
use crate::units::Notation;

#[derive(Debug, Args)]
pub(super) struct Arguments {
    /// hull.json, a folder that holds one, a design file, a table of offsets, a mesh or a CAD file
    hull: PathBuf,
    #[command(flatten)]
    conventions: super::BodyFlags,
    /// Stations, from AP [m]
    #[arg(long, value_parser = lengths, value_name = "LIST", allow_hyphen_values = true)]
    stations: Lengths,
    /// Waterlines, above the base line [m]
    #[arg(long, value_parser = lengths, value_name = "LIST", allow_hyphen_values = true)]
    waterlines: Lengths,
    /// Buttocks, from the centreplane [m]: a second table, of heights, after an empty line
    #[arg(long, value_parser = lengths, value_name = "LIST")]
    buttocks: Option<Lengths>,
    /// How lengths are written: m, mm, feet-inches-eighths, cm, ft or in
    #[arg(long, value_parser = notation, default_value = "m")]
    notation: Notation,
    /// File to write instead of stdout
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Overwrite the file when it is there already
    #[arg(long)]
    force: bool,
}

pub(super) fn notation(word: &str) -> Result<Notation, String> {
    let known = Notation::ALL.map(Notation::as_str).join(", ");
    Notation::from_word(word).ok_or(format!("known are {known}"))
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let source = read_source_with(&arguments.hull, &arguments.conventions.overrides())?;
    source.notes.iter().for_each(|note| stream::message(note));
    let buttocks = arguments.buttocks.as_ref().map_or(&[][..], |list| &list.0);
    let table = offsets(&source.hull, &arguments.stations.0, &arguments.waterlines.0, buttocks)?;
    let mut text = offsets_csv(&table, arguments.notation, false);
    if arguments.buttocks.is_some() {
        text.push('\n');
        text.push_str(&heights_csv(&table, arguments.notation));
    }
    let inputs = source_files(&arguments.hull);
    stream::Target { file: arguments.output.as_deref(), inputs: &inputs, force: arguments.force }.text(text)
}
