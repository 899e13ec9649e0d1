//! `loftsman inspect HULL|TABLE`

use std::path::PathBuf;

use clap::Args;

use super::{Lengths, lengths, positive, section, stream};
use crate::fairing::inspect::{Inspection, Planes, Resolution};
use crate::hull::Cut;
use crate::report::{Failure, inspection_json, inspection_page, read_source_with, source_files};
use crate::units::{Dimension, parse};

#[derive(Debug, Args)]
#[command(after_help = AFTER)]
pub(super) struct Arguments {
    /// hull.json, a folder that holds one, a design file, or a table of offsets, a mesh or a CAD file (fitted first)
    hull: PathBuf,
    #[command(flatten)]
    conventions: super::BodyFlags,
    /// Stations, from AP [m]; each list that is not given has the lines of a table of offsets
    #[arg(long, value_parser = lengths, value_name = "LIST", allow_hyphen_values = true)]
    stations: Option<Lengths>,
    /// Waterlines, above the base line [m]
    #[arg(long, value_parser = lengths, value_name = "LIST", allow_hyphen_values = true)]
    waterlines: Option<Lengths>,
    /// Buttocks, from the centreplane [m]
    #[arg(long, value_parser = lengths, value_name = "LIST")]
    buttocks: Option<Lengths>,
    /// Diagonals by their heights on the centreplane [m]; without it at 0.7, 1 and 1.3 T. Without
    /// a draught at 0.5, 0.7 and 0.9 of the height H that all stations between the ends reach
    #[arg(long, value_parser = lengths, value_name = "LIST", allow_hyphen_values = true)]
    diagonals: Option<Lengths>,
    /// Angle of the diagonals below the horizontal; without it atan(T / (B/2)), or atan(H / (B/2))
    #[arg(long, value_parser = diagonal_angle, value_name = "ANGLE")]
    diagonal_angle: Option<f64>,
    /// One more plane a x + b y + c z = d [m]; may be repeated
    #[arg(long, value_parser = section::plane, value_name = "a,b,c,d", allow_hyphen_values = true)]
    plane: Vec<Cut>,
    /// Least departure from a batten that is seen on paper
    #[arg(long, value_parser = positive, value_name = "LENGTH", default_value = "0.1 mm")]
    resolution: f64,
    /// n of the scale 1:n of the drawing; without it the largest of 10, 25, 50, 100, 200, 500 at which the ship is at
    /// most 2.5 m long
    #[arg(long, value_parser = scale, value_name = "N")]
    scale: Option<f64>,
    /// Least departure that counts, on the ship, instead of resolution and scale
    #[arg(long, value_parser = positive, value_name = "LENGTH", conflicts_with_all = ["resolution", "scale"])]
    tolerance: Option<f64>,
    /// JSON instead of tables
    #[arg(long)]
    json: bool,
    /// File to write instead of stdout
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Overwrite the file when it is there already
    #[arg(long)]
    force: bool,
}

const AFTER: &str = "\
Columns: length; infl, inflections; extr, curvature extrema; flats, straight pieces and their part of the length; knuck, \
knuckles, which split the curve; kappa max, the curvature of largest magnitude; step max, its largest change between \
neighbouring stations (on stations: waterlines); int k2, the batten energy int kappa^2 ds; int dk2, int (d kappa/ds)^2 ds.
An inflection counts when the curve departs by more than the tolerance (resolution x scale) from its chord on both sides of \
it. An extremum of curvature counts when the ripple with its height A and width w is higher than that: A w^2 / (4 pi^2). A \
flat is at least 5 % of the curve, straight within the tolerance, with a curvature below 1/8 of the mean.
Control polygon: + outboard, - inboard, 0 within a tenth of the tolerance of the chord; fair lines change sign seldom and \
enclose no sign between two opposite ones.
Not counted are curves whose half-breadth is below B/1000 all along, and ends of curves longer than B/50 where it is.
JSON: name, tolerance, curves (kind, at, branch, length, turning, inflections, inflections_at, extrema, extrema_at, max_curvature, \
max_curvature_at, max_step, bending_energy, variation_energy, flats, knuckles, without_breadth); totals, empty, no_breadth, net (line, index, at, signs, \
changes, enclosed), surface (area, bending_energy, degenerate_points, gaussian, mean, principal_1, principal_2 with least and greatest).";

fn scale(text: &str) -> Result<f64, String> {
    let number = text.strip_prefix("1:").unwrap_or(text);
    match number.trim().parse::<f64>() {
        Ok(value) if value.is_finite() && value > 0.0 => Ok(value),
        _ => Err("expected n of 1:n, as 50".to_owned()),
    }
}

fn diagonal_angle(text: &str) -> Result<f64, String> {
    let measure = parse(text).map_err(|error| error.to_string())?;
    match measure.dimension {
        Dimension::Angle if measure.value > 0.0 && measure.value < std::f64::consts::FRAC_PI_2 => Ok(measure.value),
        _ => Err("expected an angle between 0 and 90 degrees with its unit, as 35deg".to_owned()),
    }
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let source = read_source_with(&arguments.hull, &arguments.conventions.overrides())?;
    source.notes.iter().for_each(|note| stream::message(note));
    let warnings = source.warnings();
    let hull = source.hull;
    let usual = Planes::with_defaults(&hull);
    let list = |given: &Option<Lengths>, usual: Vec<f64>| given.as_ref().map_or(usual, |list| list.0.clone());
    let planes = Planes {
        stations: list(&arguments.stations, usual.stations),
        waterlines: list(&arguments.waterlines, usual.waterlines),
        buttocks: list(&arguments.buttocks, usual.buttocks),
        diagonals: list(&arguments.diagonals, usual.diagonals),
        diagonal_angle: arguments.diagonal_angle.unwrap_or(usual.diagonal_angle),
        others: arguments.plane.clone(),
    };
    let fitting = Resolution::for_length(hull.particulars().length_between_perpendiculars);
    let resolution = Resolution { on_paper: arguments.resolution, scale: arguments.scale.unwrap_or(fitting.scale) };
    let tolerance = arguments.tolerance.unwrap_or_else(|| resolution.tolerance());
    let inspection = Inspection::new(&hull, &planes, tolerance);
    let text = if arguments.json {
        stream::json_of(inspection_json(hull.name(), &inspection), warnings)?
    } else {
        inspection_page(hull.name(), &inspection)
    };
    let inputs = source_files(&arguments.hull);
    stream::Target { file: arguments.output.as_deref(), inputs: &inputs, force: arguments.force }.text(text)
}
