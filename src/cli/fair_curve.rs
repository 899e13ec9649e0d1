//! `loftsman fair-curve CURVE.csv -o DIR`

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use super::{Lengths, length, lengths, stream};
use crate::fairing::curve::{CurveSettings, InflectionWish};
use crate::report::{
    CurveJob, Destination, Failure, Inputs, Kept, fair_curve_files, fair_curve_json, fair_curve_page, faired_curve,
};
use crate::units::Notation;

#[derive(Debug, Args)]
#[command(after_help = AFTER)]
pub(super) struct Arguments {
    /// The curve: a CSV file with the columns x,y[,tolerance][,flag]
    curve: PathBuf,
    /// Folder for curve.csv, fairing.json and the picture
    #[arg(short, long, value_name = "FOLDER")]
    output: Option<PathBuf>,
    /// How far the curve may pass a point that has no tolerance of its own; without it three times the noise that is
    /// found
    #[arg(long, value_parser = length, value_name = "LENGTH")]
    tolerance: Option<f64>,
    /// Abscissae of points that must not move
    #[arg(long, value_parser = lengths, value_name = "LIST", allow_hyphen_values = true)]
    lock: Option<Lengths>,
    /// Abscissae of knuckles
    #[arg(long, value_parser = lengths, value_name = "LIST", allow_hyphen_values = true)]
    knuckle: Option<Lengths>,
    /// Order of the energy: 2 bending, 3 change of curvature, 4 the change of that
    #[arg(long, default_value_t = 4, value_parser = clap::value_parser!(u8).range(2..=4))]
    order: u8,
    /// Most inflections: a number, least (as few as the tolerances allow and the price permits) or any
    #[arg(long, default_value = "least", value_parser = inflections, value_name = "N|least|any")]
    inflections: InflectionWish,
    /// Area under the curve: a number [m2; for section areas m3] or keep
    #[arg(long, value_parser = kept, value_name = "AREA|keep", allow_hyphen_values = true)]
    area: Option<Kept>,
    /// Abscissa of the centroid of that area: a number [m] or keep
    #[arg(long, value_parser = kept, value_name = "X|keep", allow_hyphen_values = true)]
    centroid: Option<Kept>,
    /// Take suspected points as they are
    #[arg(long)]
    keep_suspects: bool,
    /// Slope dy/dx at the first point
    #[arg(long, value_parser = number, value_name = "SLOPE", allow_hyphen_values = true)]
    first_slope: Option<f64>,
    /// Slope dy/dx at the last point
    #[arg(long, value_parser = number, value_name = "SLOPE", allow_hyphen_values = true)]
    last_slope: Option<f64>,
    /// Weight of the energy instead of that of cross-validation
    #[arg(long, value_parser = weight, value_name = "WEIGHT", allow_hyphen_values = true)]
    weight: Option<f64>,
    /// Energy of derivatives with respect to x instead of that of true curvature; taken by itself for a column named area
    #[arg(long)]
    derivatives: bool,
    /// Unit of plain numbers
    #[arg(long, value_enum, default_value = "m", value_name = "UNIT")]
    unit: Unit,
    /// One JSON object on stdout
    #[arg(long)]
    json: bool,
    /// No picture
    #[arg(long)]
    no_figures: bool,
    /// Overwrite files that are there already
    #[arg(long)]
    force: bool,
    /// Say nothing about what was assumed
    #[arg(short, long)]
    quiet: bool,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Unit {
    M,
    Cm,
    Mm,
    Ft,
    In,
}

const AFTER: &str = "\
Cells are those of tables of offsets: 6.41, 3-4-5+ (feet-inches-eighths), (6.41) doubtful, ? to be predicted, and the marks K (knuckle), T \
(tangent point of a straight piece) and ! (locked), on the ordinate or in the column flag. Units may stand in the first line, as y [mm], or area [ft2] for a curve of areas. \
Ends that are 0 stay 0 where no ordinate is below. curve.csv is in metres.
Points that contradict all others are left out and listed; those that are locked, doubtful or have a tolerance or a mark are not. Corners that \
the points show and do not declare are reported.
fairing.json holds the proof: the least number of inflections within the tolerances with three points for each change that no curve \
can pass without it, and the duality gap of the convex program.
Exit code 4 when the targets cannot be met within the tolerances; the message names the smallest tolerance that would do. \
The best curve with it is written, marked, or the nearest to an area, centroid or slopes that no curve can meet.";

fn inflections(text: &str) -> Result<InflectionWish, String> {
    match text {
        "least" => Ok(InflectionWish::Least),
        "any" => Ok(InflectionWish::Any),
        _ => text.parse().map(InflectionWish::AtMost).map_err(|_| "a number, least or any".to_owned()),
    }
}

fn kept(text: &str) -> Result<Kept, String> {
    match text {
        "keep" => Ok(Kept::AsGiven),
        _ => number(text).map(Kept::At).map_err(|_| "expected a number or keep".to_owned()),
    }
}

fn number(text: &str) -> Result<f64, String> {
    text.parse().ok().filter(|value: &f64| value.is_finite()).ok_or_else(|| "expected a number".to_owned())
}

fn weight(text: &str) -> Result<f64, String> {
    number(text).ok().filter(|weight| *weight > 0.0).ok_or_else(|| "expected a number above 0".to_owned())
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let list = |lengths: &Option<Lengths>| lengths.as_ref().map_or_else(Vec::new, |lengths| lengths.0.clone());
    let job = CurveJob {
        path: arguments.curve.clone(),
        unit: match arguments.unit {
            Unit::M => Notation::Metres,
            Unit::Cm => Notation::Centimetres,
            Unit::Mm => Notation::Millimetres,
            Unit::Ft => Notation::Feet,
            Unit::In => Notation::Inches,
        },
        locks: list(&arguments.lock),
        knuckles: list(&arguments.knuckle),
        area: arguments.area,
        centroid: arguments.centroid,
        keep_suspects: arguments.keep_suspects,
        settings: CurveSettings {
            order: usize::from(arguments.order),
            tolerance: arguments.tolerance,
            weight: arguments.weight,
            inflections: arguments.inflections,
            true_curvature: !arguments.derivatives,
            slopes: [arguments.first_slope, arguments.last_slope],
            ..CurveSettings::default()
        },
    };
    let done = faired_curve(&job)?;
    if !arguments.quiet {
        done.notes.iter().for_each(|note| stream::message(note));
    }
    if let Some(folder) = &arguments.output {
        Destination { folder, inputs: &Inputs::of(&[&arguments.curve]), force: arguments.force }
            .write(&fair_curve_files(&done, !arguments.no_figures)?)?;
    }
    let verdict = done.verdict();
    let json = || stream::json_judged(fair_curve_json(&done), &verdict);
    stream::data(&if arguments.json { json()? } else { fair_curve_page(&done) })?;
    verdict
}
