//! `loftsman loft HULL --frames LIST`

use std::path::PathBuf;

use clap::Args;

use super::export::unit;
use super::run_files::stem;
use super::{Lengths, lengths, positive, stream};
use crate::exchange::CadUnit;
use crate::hull::{default_buttocks, default_stations, default_waterlines};
use crate::report::{
    Destination, Failure, Inputs, LoftFormat, LoftSettings, SkinSide, loft, read_source_with, source_files,
};
use crate::units::Notation;

#[derive(Debug, Args)]
#[command(after_help = AFTER)]
pub(super) struct Arguments {
    /// hull.json, a folder that holds one, a design file, a table of offsets, a mesh or a CAD file
    hull: PathBuf,
    #[command(flatten)]
    conventions: super::BodyFlags,
    #[command(flatten)]
    stations: super::StationFlags,
    /// Frames, from AP [m], as 1:9:0.5 [default: the stations of the hull]
    #[arg(long, value_parser = lengths, value_name = "LIST", allow_hyphen_values = true)]
    frames: Option<Lengths>,
    /// Thickness of plating or planking, normal to the skin [default: none, the moulded surface]
    #[arg(long, value_parser = positive, value_name = "LENGTH", allow_hyphen_values = true)]
    thickness: Option<f64>,
    /// On which side of the moulded surface the skin lies: inside or outside
    #[arg(long, value_parser = side, value_name = "SIDE", default_value = "inside", requires = "thickness")]
    side: SkinSide,
    /// Waterlines at which half-breadths and bevels are given [default: those of tables of the hull]
    #[arg(long, value_parser = lengths, value_name = "LIST", allow_hyphen_values = true)]
    waterlines: Option<Lengths>,
    /// Buttocks at which heights are given [default: those of tables of the hull]
    #[arg(long, value_parser = lengths, value_name = "LIST")]
    buttocks: Option<Lengths>,
    /// Drawings, with commas between them: svg, dxf, pdf
    #[arg(short, long, value_delimiter = ',', value_parser = format, value_name = "LIST", default_value = "svg,dxf")]
    format: Vec<LoftFormat>,
    /// How lengths are written: m, mm, feet-inches-eighths, cm, ft or in
    #[arg(long, value_parser = super::offsets::notation, default_value = "mm")]
    notation: Notation,
    /// Unit of the DXF file: m or mm
    #[arg(long, value_parser = unit, value_name = "UNIT", default_value = "mm")]
    unit: CadUnit,
    /// What chords leave a frame by at most
    #[arg(long, value_parser = positive, value_name = "LENGTH", default_value = "0.1 mm")]
    deviation: f64,
    /// Folder for the files [default: out/<name of the input>]
    #[arg(short, long, value_name = "FOLDER")]
    output: Option<PathBuf>,
    /// Overwrite files that are there already
    #[arg(long)]
    force: bool,
    /// Print nothing but errors
    #[arg(short, long)]
    quiet: bool,
}

const AFTER: &str = "\
Drawings are at full size, of the side to port, from the centreplane to the deck at side. svg: a drawing a frame. dxf: all frames, each \
on a layer of its name. pdf: all frames on tiles of A3, which are trimmed at their windows and laid edge to edge; a bar of 100 mm checks \
the print.
The thickness is that normal to the skin: frames are sections of the face inside or outside, not moulded sections made smaller.
half-breadths.csv and heights.csv have the ordinates, bevels.csv the bevels in degrees: the angle between skin and square of the \
frame, positive where the hull closes in going forward.";

fn side(text: &str) -> Result<SkinSide, String> {
    match text {
        "inside" => Ok(SkinSide::Inside),
        "outside" => Ok(SkinSide::Outside),
        _ => Err("expected inside or outside".to_owned()),
    }
}

fn format(text: &str) -> Result<LoftFormat, String> {
    LoftFormat::ALL
        .into_iter()
        .find(|format| format.name() == text.trim())
        .ok_or_else(|| "expected svg, dxf or pdf".to_owned())
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let source = read_source_with(&arguments.hull, &arguments.stations.with(&arguments.conventions))?;
    source.notes.iter().for_each(|note| stream::message(note));
    let hull = &source.hull;
    let of = |list: &Option<Lengths>| list.as_ref().map(|Lengths(list)| list.clone());
    let stations = || default_stations(hull, source.conventions.stations).iter().map(|station| station.x).collect();
    let settings = LoftSettings {
        frames: of(&arguments.frames).unwrap_or_else(stations),
        thickness: arguments.thickness.unwrap_or(0.0),
        side: arguments.side,
        deviation: arguments.deviation,
        waterlines: of(&arguments.waterlines).unwrap_or_else(|| default_waterlines(hull)),
        buttocks: of(&arguments.buttocks).unwrap_or_else(|| default_buttocks(hull)),
        notation: arguments.notation,
        unit: arguments.unit,
    };
    let files = source_files(&arguments.hull);
    let stem = stem(&arguments.hull).to_string_lossy().into_owned();
    let ship = if hull.name().is_empty() { stem.as_str() } else { hull.name() };
    let lofted = loft(hull, ship, &settings, &arguments.format)?;
    lofted.warnings.iter().for_each(|warning| stream::message(warning));
    let folder = arguments.output.clone().unwrap_or_else(|| PathBuf::from("out").join(&stem));
    Destination { folder: &folder, inputs: &Inputs::of(&files), force: arguments.force }.write(&lofted.files)?;
    let verdict = if lofted.failed.is_empty() {
        Ok(())
    } else {
        Err(Failure::Check(format!("E504 not written: {}", lofted.failed.join("; "))))
    };
    if arguments.quiet {
        return verdict;
    }
    let names: Vec<&str> = lofted.files.iter().map(|file| file.name.as_str()).collect();
    stream::data(&format!("{}\nWritten to {}: {}\n", lofted.page, folder.display(), names.join(", ")))?;
    verdict
}
