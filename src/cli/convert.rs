//! `loftsman convert FILE [OUT]`

use std::path::{Path, PathBuf};

use clap::Args;

use super::stream;
use crate::exchange::TableWriting;
use crate::hull::TableLayout;
use crate::report::{ExportFormat, ExportSettings, Failure, convert_file, convert_table, is_hull, source_files};
use crate::units::Notation;

#[derive(Debug, Args)]
#[command(after_help = super::TABLES)]
pub(super) struct Arguments {
    /// Table of offsets or body in any of the formats below; hull.json, a folder that holds one, or a design file
    table: PathBuf,
    /// File to write instead of stdout. Its ending says the format: .csv, .xlsx (a workbook); or one of those of
    /// `export`: .step, .igs, .dxf, .stl, .obj, .ply, .glb, .3mf, .vtk, .msh, .gdf,
    /// .mar, .pnl, .gf, .bri, .ftm, .mlt
    #[arg(value_name = "OUT")]
    output: Option<PathBuf>,
    /// The same file, as other commands name theirs
    #[arg(short, long = "output", value_name = "OUT", conflicts_with = "output")]
    output_file: Option<PathBuf>,
    /// Format of the file, one of those of `export`, where its ending does not say it
    #[arg(short, long, value_parser = super::export::format, value_name = "FORMAT")]
    format: Option<ExportFormat>,
    #[command(flatten)]
    conventions: super::BodyFlags,
    #[command(flatten)]
    stations: super::StationFlags,
    /// How lengths are written: m, mm, feet-inches-eighths, cm, ft or in; as in the table where none is given
    #[arg(long, value_parser = super::offsets::notation)]
    notation: Option<Notation>,
    /// Shape of the file: matrix or tidy; as in the table where none is given
    #[arg(long, value_parser = layout)]
    layout: Option<TableLayout>,
    /// Draught of panels, and of the files for Michlet, PDSTRIP and DELFTship, above the base line [default: of the table
    /// or the hull, where one is stated]
    #[arg(long, alias = "draft", value_parser = super::positive, value_name = "LENGTH", allow_hyphen_values = true)]
    draught: Option<f64>,
    /// Overwrite the file when it is there already
    #[arg(long)]
    force: bool,
    /// Say nothing about what was detected
    #[arg(short, long)]
    quiet: bool,
}

/// Endings of tables.
const TABLES: [&str; 2] = ["csv", "xlsx"];

fn layout(word: &str) -> Result<TableLayout, String> {
    match word {
        "matrix" => Ok(TableLayout::Matrix),
        "tidy" => Ok(TableLayout::Tidy),
        _ => Err("known are matrix, tidy".to_owned()),
    }
}

/// The ending of the file must say a format: that of a table, or that of the table which is written back. A name
/// without any is that of a stream.
fn known_ending(output: &Path, table: Option<&Path>) -> Result<(), Failure> {
    let Some(ending) = output.extension() else { return Ok(()) };
    let own = table.and_then(Path::extension).is_some_and(|own| own.eq_ignore_ascii_case(ending));
    if own || TABLES.iter().any(|known| ending.eq_ignore_ascii_case(known)) {
        return Ok(());
    }
    Err(Failure::Usage(format!(
        "the ending of {} says no format; known are .csv, .xlsx, .step, .stp, .igs, .iges, .3dm, .dxf, .stl, .obj, .ply, .glb, .3mf, .vtk, .msh, .gdf, .mar, .pnl, .gf, \
         .bri, .ftm, .mlt; --format says another",
        output.display()
    )))
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let output = arguments.output.as_deref().or(arguments.output_file.as_deref());
    let inputs = source_files(&arguments.table);
    let target = stream::Target { file: output, inputs: &inputs, force: arguments.force };
    let overrides = arguments.stations.with(&arguments.conventions);
    let of_name = || output.and_then(|path| ExportFormat::from_ending(&path.to_string_lossy()));
    let hull = is_hull(&arguments.table);
    let table = hull.then(|| {
        let workbook = output.and_then(|path| path.extension()).is_some_and(|e| e == "xlsx");
        if workbook { ExportFormat::Xlsx } else { ExportFormat::Csv }
    });
    let said_format = arguments.format.or_else(of_name);
    if let (None, Some(output)) = (said_format, output) {
        known_ending(output, Some(arguments.table.as_path()).filter(|_| !hull))?;
    }
    if let Some(format) = said_format.or(table) {
        let name = output.unwrap_or(&arguments.table).to_string_lossy().into_owned();
        let settings = ExportSettings { draught: arguments.draught, ..ExportSettings::default() };
        let (file, messages) = convert_file(&arguments.table, &overrides, &name, format, &settings)?;
        if !arguments.quiet {
            messages.iter().for_each(|message| stream::message(message));
        }
        return target.bytes(file.contents);
    }
    let writing = TableWriting { notation: arguments.notation, layout: arguments.layout };
    let converted = convert_table(&arguments.table, &overrides, writing)?;
    if !arguments.quiet {
        converted.messages.iter().for_each(|message| stream::message(message));
    }
    if output.is_none() && converted.conventions.is_some() && !arguments.quiet {
        stream::message(
            "not written: the conventions of the table, which OUT gets beside it in a TOML file of its name",
        );
    }
    target.table(converted.written.text, &converted.form, converted.conventions)
}
