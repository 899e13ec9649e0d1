//! `loftsman section HULL --station X | --waterline Z | --buttock Y | --plane a,b,c,d`

use std::path::PathBuf;

use clap::Args;

use super::{Lengths, length, lengths, stream};
use crate::exchange::{section_csv, section_json};
use crate::hull::Cut;
use crate::report::{Failure, read_source_with, sections_of, source_files};

#[derive(Debug, Args)]
pub(super) struct Arguments {
    /// hull.json, a folder that holds one, a design file, a table of offsets, a mesh or a CAD file
    hull: PathBuf,
    #[command(flatten)]
    conventions: super::BodyFlags,
    #[command(flatten)]
    stations: super::StationFlags,
    #[command(flatten)]
    plane: Plane,
    /// Largest distance between the points' chords and the curve [m]
    #[arg(long, value_parser = deviation, default_value = "1 mm", value_name = "LENGTH")]
    deviation: f64,
    /// JSON instead of CSV
    #[arg(long)]
    json: bool,
    /// File to write instead of stdout
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Overwrite the file when it is there already
    #[arg(long)]
    force: bool,
}

#[derive(Debug, Args)]
#[group(required = true, multiple = false)]
struct Plane {
    /// Transverse plane, from AP [m]
    #[arg(long, value_parser = length, value_name = "X", allow_hyphen_values = true)]
    station: Option<f64>,
    /// Horizontal plane, above the base line [m]
    #[arg(long, value_parser = length, value_name = "Z", allow_hyphen_values = true)]
    waterline: Option<f64>,
    /// Longitudinal vertical plane, from the centreplane [m]
    #[arg(long, value_parser = length, value_name = "Y", allow_hyphen_values = true)]
    buttock: Option<f64>,
    /// The plane a x + b y + c z = d [m]
    #[arg(long, value_parser = plane, value_name = "a,b,c,d", allow_hyphen_values = true)]
    plane: Option<Cut>,
}

fn deviation(text: &str) -> Result<f64, String> {
    match length(text)? {
        value if value >= 1e-9 => Ok(value),
        _ => Err("must be at least 1e-9 m".to_owned()),
    }
}

pub(super) fn plane(text: &str) -> Result<Cut, String> {
    let Lengths(numbers) = lengths(text)?;
    match numbers[..] {
        [a, b, c, offset] if [a, b, c].iter().any(|n| n.abs() > 0.0) => Ok(Cut::Plane { normal: [a, b, c], offset }),
        [_, _, _, _] => Err("a, b and c are all 0".to_owned()),
        _ => Err("four numbers are needed: a,b,c,d".to_owned()),
    }
}

impl Plane {
    fn cut(&self) -> Option<Cut> {
        let station = self.station.map(|x| Cut::Station { x });
        let waterline = self.waterline.map(|z| Cut::Waterline { z });
        let buttock = self.buttock.map(|y| Cut::Buttock { y });
        station.or(waterline).or(buttock).or(self.plane)
    }
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let source = read_source_with(&arguments.hull, &arguments.stations.with(&arguments.conventions))?;
    source.notes.iter().for_each(|note| stream::message(note));
    let cut = arguments.plane.cut().ok_or_else(|| Failure::Internal("no plane".to_owned()))?;
    let section = sections_of(&source.hull, cut);
    if section.branches.is_empty() {
        stream::message("the plane does not cut the hull; the table is empty");
    }
    let text = if arguments.json {
        stream::json_of(section_json(&section, arguments.deviation), source.warnings())?
    } else {
        section_csv(&section, arguments.deviation)
    };
    let inputs = source_files(&arguments.hull);
    stream::Target { file: arguments.output.as_deref(), inputs: &inputs, force: arguments.force }.text(text)
}
