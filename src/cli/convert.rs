//! `loftsman convert TABLE [OUT]`

use std::path::PathBuf;

use clap::Args;

use super::stream;
use crate::exchange::TableWriting;
use crate::hull::TableLayout;
use crate::report::{Failure, convert_table};
use crate::units::Notation;

#[derive(Debug, Args)]
#[command(after_help = super::TABLES)]
pub(super) struct Arguments {
    /// Table of offsets, in any of the formats below
    table: PathBuf,
    /// File to write instead of stdout; a workbook when it ends in .xlsx
    output: Option<PathBuf>,
    /// How lengths are written: m, mm, feet-inches-eighths, cm, ft or in; as in the table where none is given
    #[arg(long, value_parser = super::offsets::notation)]
    notation: Option<Notation>,
    /// Shape of the file: matrix or tidy; as in the table where none is given
    #[arg(long, value_parser = layout)]
    layout: Option<TableLayout>,
    /// Overwrite the file when it is there already
    #[arg(long)]
    force: bool,
    /// Say nothing about what was detected
    #[arg(short, long)]
    quiet: bool,
}

fn layout(word: &str) -> Result<TableLayout, String> {
    match word {
        "matrix" => Ok(TableLayout::Matrix),
        "tidy" => Ok(TableLayout::Tidy),
        _ => Err("known are matrix, tidy".to_owned()),
    }
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let writing = TableWriting { notation: arguments.notation, layout: arguments.layout };
    let converted = convert_table(&arguments.table, writing)?;
    if !arguments.quiet {
        converted.messages.iter().for_each(|message| stream::message(message));
    }
    stream::table_or_file(converted.written.text, &converted.form, arguments.output.as_deref(), arguments.force)
}
