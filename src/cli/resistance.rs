//! `loftsman resistance HULL --speeds 8:16:1`

use std::ops::RangeInclusive;
use std::path::PathBuf;

use clap::{Args, ValueEnum};

use super::{Lengths, length, positive, stream};
use crate::exchange::resistance_json;
use crate::hydrostatics::DENSITIES;
use crate::report::{
    Destination, Failure, Inputs, ResistanceJob, ResistanceOptions, resistance_files, resistance_outputs,
    resistance_page, source_files,
};
use crate::resistance::{Appendage, AppendageKind, Method, SternShape, TEMPERATURES};
use crate::units::{Dimension, parse, parse_list};

/// Speeds that are taken \[kn\].
const SPEEDS: RangeInclusive<f64> = 0.1..=100.0;

#[derive(Debug, Args)]
#[command(after_help = AFTER)]
pub(super) struct Arguments {
    /// hull.json, a folder that holds one, a design file, a table of offsets, or a mesh or CAD file, as of hydro
    hull: PathBuf,
    /// Speeds [kn], as 8:16:1
    #[arg(long, value_parser = speeds, value_name = "LIST")]
    speeds: Lengths,
    /// Method of prediction
    #[arg(long, value_enum, default_value = "holtrop-1984", value_name = "METHOD")]
    method: MethodWord,
    /// Draught above the base line, even keel [default: of the hull, where one is stated]
    #[arg(long, alias = "draft", value_parser = positive, value_name = "T", help_heading = SHIP)]
    draught: Option<f64>,
    /// Length on the waterline L [default: of the hull]
    #[arg(long, value_parser = positive, value_name = "L", help_heading = SHIP)]
    lwl: Option<f64>,
    /// Breadth on the waterline [default: of the hull]
    #[arg(long, value_parser = positive, value_name = "B", help_heading = SHIP)]
    breadth: Option<f64>,
    /// Displacement volume, m3 [default: of the hull]
    #[arg(long, value_parser = volume, value_name = "VOLUME", help_heading = SHIP)]
    volume: Option<f64>,
    /// LCB forward of L/2, % of L [default: of the hull]
    #[arg(long, value_parser = centre, value_name = "PERCENT", allow_hyphen_values = true, help_heading = SHIP)]
    lcb: Option<f64>,
    /// Midship section coefficient on B and T [default: of the hull]
    #[arg(long, value_parser = coefficient, value_name = "CM", help_heading = SHIP)]
    cm: Option<f64>,
    /// Waterplane coefficient on L and B [default: of the hull]
    #[arg(long, value_parser = coefficient, value_name = "CWP", help_heading = SHIP)]
    cwp: Option<f64>,
    /// Wetted surface without transom, m2 [default: of the hull]
    #[arg(long, value_parser = area, value_name = "AREA", help_heading = SHIP)]
    wetted_surface: Option<f64>,
    /// Half angle of entrance, degrees [default: of the hull, of a rounded stem by Holtrop's formula]
    #[arg(long, value_parser = angle, value_name = "ANGLE", help_heading = SHIP)]
    half_angle: Option<f64>,
    /// Immersed area of the transom at rest, m2 [default: of the hull]
    #[arg(long, value_parser = area, value_name = "AREA", help_heading = SHIP)]
    transom_area: Option<f64>,
    /// Transverse area of the bulb where the waterline meets the stem, m2 [default: of the hull]
    #[arg(long, value_parser = area, value_name = "AREA", help_heading = SHIP)]
    bulb_area: Option<f64>,
    /// Height of the centre of that area above the keel [default: of the hull]
    #[arg(long, value_parser = length, value_name = "HEIGHT", help_heading = SHIP)]
    bulb_height: Option<f64>,
    /// Shape of the after body: C_stern -25, -10, 0 or 10 [default: normal]
    #[arg(long, value_enum, value_name = "SHAPE", help_heading = SHIP)]
    stern: Option<SternWord>,
    /// An appendage as KIND=AREA or 1+k2=AREA, as rudder-behind-stern=20 or 1.5=50, m2; any number of them
    #[arg(long = "appendage", value_parser = appendage, value_name = "KIND=AREA", help_heading = SHIP)]
    appendages: Vec<Appendage>,
    /// Form factor 1 + k1 [default: of the method; of michell and ittc-57 that of Holtrop 1984]
    #[arg(long, value_parser = form_factor, value_name = "1+k1", help_heading = SHIP)]
    form_factor: Option<f64>,
    /// Correlation allowance C_A, as 0.0004 [default: of the method; of michell and ittc-57 0]
    #[arg(long, value_parser = allowance, value_name = "CA", allow_hyphen_values = true, help_heading = SHIP)]
    correlation_allowance: Option<f64>,
    /// Propulsive efficiency, for the delivered power
    #[arg(long, value_parser = coefficient, value_name = "ETA", help_heading = SHIP)]
    propulsive_efficiency: Option<f64>,
    /// Density of the water: t/m3, or with a unit [default: of the hull]
    #[arg(long, value_parser = density, value_name = "DENSITY", help_heading = WATER)]
    density: Option<f64>,
    /// Temperature of the water, degrees Celsius, for its viscosity [default: 15]
    #[arg(long, value_parser = temperature, value_name = "T", conflicts_with = "viscosity", help_heading = WATER)]
    temperature: Option<f64>,
    /// Kinematic viscosity, m2/s, as 1.188e-6
    #[arg(long, value_parser = viscosity, value_name = "NU", help_heading = WATER)]
    viscosity: Option<f64>,
    #[command(flatten)]
    conventions: super::BodyFlags,
    #[command(flatten)]
    stations: super::StationFlags,
    /// Folder for resistance.csv, resistance.json, the figure and manifest.json
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
    /// Overwrite files that are there already
    #[arg(long)]
    force: bool,
    /// Draw no figure
    #[arg(long)]
    no_figures: bool,
    /// Print the result as JSON on stdout instead of the page
    #[arg(long)]
    json: bool,
    /// Print no notes about what was assumed
    #[arg(short, long)]
    quiet: bool,
}

const SHIP: &str = "Ship";
const WATER: &str = "Water";

const AFTER: &str = "\
What is not given comes from the hull at its draught, or is assumed; the page says which for each input. A figure outside the range of the \
data of a method says so beside it.
holtrop-1984 and holtrop-1982: statistics of displacement ships. michell: wave resistance of thin ships from the surface itself, in deep \
water, without sinkage; above C_B 0.6 it ranks hulls at best. ittc-57: friction with form factor, no waves.
Appendages by KIND (1 + k2): rudder-behind-skeg 1.75, rudder-behind-stern 1.4, twin-rudders 2.8, shaft-brackets 3.0, skeg 1.75, \
strut-bossings 3.0, hull-bossings 2.0, shafts 3.0, stabiliser-fins 2.8, dome 2.7, bilge-keels 1.4.";

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum MethodWord {
    #[value(name = "holtrop-1984")]
    Holtrop1984,
    #[value(name = "holtrop-1982")]
    Holtrop1982,
    #[value(name = "michell")]
    Michell,
    #[value(name = "ittc-57")]
    Ittc57,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum SternWord {
    #[value(name = "pram")]
    Pram,
    #[value(name = "V", alias = "v")]
    V,
    #[value(name = "normal")]
    Normal,
    #[value(name = "U", alias = "u")]
    U,
}

/// A number within a range.
fn within(text: &str, range: RangeInclusive<f64>, words: &str) -> Result<f64, String> {
    let number = text.trim().parse().ok().filter(|value: &f64| range.contains(value));
    number.ok_or_else(|| format!("expected {words}"))
}

/// A quantity of a dimension with its unit, or a plain number, from 0 on.
fn quantity(text: &str, dimension: Dimension, words: &str) -> Result<f64, String> {
    let measure = parse(text).map_err(|error| error.to_string())?;
    let fits = measure.dimension == Dimension::None || measure.dimension == dimension;
    if fits && measure.value >= 0.0 { Ok(measure.value) } else { Err(format!("expected {words}")) }
}

fn area(text: &str) -> Result<f64, String> {
    quantity(text, Dimension::Area, "an area from 0 on, m2 or with its unit")
}

fn volume(text: &str) -> Result<f64, String> {
    quantity(text, Dimension::Volume, "a volume, m3 or with its unit")
}

fn coefficient(text: &str) -> Result<f64, String> {
    within(text, f64::MIN_POSITIVE..=1.0, "a number above 0 and up to 1")
}

fn centre(text: &str) -> Result<f64, String> {
    within(text.trim_end_matches(['%', ' ']), -20.0..=20.0, "-20 to 20 % of L, + forward of L/2")
}

fn angle(text: &str) -> Result<f64, String> {
    within(text, 0.5..=89.0, "0.5 to 89 degrees")
}

fn form_factor(text: &str) -> Result<f64, String> {
    within(text, 0.8..=2.5, "1 + k1 from 0.8 to 2.5")
}

fn allowance(text: &str) -> Result<f64, String> {
    within(text, -0.001..=0.005, "C_A from -0.001 to 0.005, as 0.0004")
}

fn temperature(text: &str) -> Result<f64, String> {
    within(text, TEMPERATURES, "0 to 30 degrees Celsius")
}

fn viscosity(text: &str) -> Result<f64, String> {
    within(text, 1e-7..=1e-5, "1e-7 to 1e-5 m2/s, as 1.188e-6")
}

fn density(text: &str) -> Result<f64, String> {
    let value = quantity(text, Dimension::Density, "a density")?;
    if DENSITIES.contains(&value) { Ok(value) } else { Err("expected 0.9 to 1.3 t/m3, or 1025kg/m3".to_owned()) }
}

fn speeds(text: &str) -> Result<Lengths, String> {
    if text.chars().any(char::is_alphabetic) {
        return Err("expected plain numbers in knots, as 8:16:1 or 10,12.5,14".to_owned());
    }
    let list = parse_list(text).map_err(|error| error.to_string())?;
    if list.iter().all(|speed| SPEEDS.contains(speed)) {
        return Ok(Lengths(list));
    }
    Err(format!("expected {} to {} knots", SPEEDS.start(), SPEEDS.end()))
}

fn appendage(text: &str) -> Result<Appendage, String> {
    let known = || AppendageKind::ALL.map(AppendageKind::as_str).join(", ");
    let (kind, surface) = text.split_once('=').ok_or_else(|| "expected KIND=AREA, as 1.5=50".to_owned())?;
    let named = AppendageKind::ALL.into_iter().find(|one| one.as_str() == kind).map(AppendageKind::factor);
    let factor = named.map_or_else(
        || {
            within(kind, 1.0..=5.0, "")
                .map_err(|_| format!("{kind} is neither 1 + k2 from 1 to 5 nor one of {}", known()))
        },
        Ok,
    )?;
    Ok(Appendage { surface: area(surface)?, factor })
}

fn options(arguments: &Arguments) -> ResistanceOptions {
    ResistanceOptions {
        length: arguments.lwl,
        breadth: arguments.breadth,
        volume: arguments.volume,
        lcb: arguments.lcb,
        midship_coefficient: arguments.cm,
        waterplane_coefficient: arguments.cwp,
        wetted_surface: arguments.wetted_surface,
        half_angle: arguments.half_angle,
        transom_area: arguments.transom_area,
        bulb_area: arguments.bulb_area,
        bulb_height: arguments.bulb_height,
        stern: arguments.stern.map(|word| match word {
            SternWord::Pram => SternShape::Pram,
            SternWord::V => SternShape::V,
            SternWord::Normal => SternShape::Normal,
            SternWord::U => SternShape::U,
        }),
        appendages: arguments.appendages.clone(),
        form_factor: arguments.form_factor,
        allowance: arguments.correlation_allowance,
        density: arguments.density,
        temperature: arguments.temperature,
        viscosity: arguments.viscosity,
        efficiency: arguments.propulsive_efficiency,
    }
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let job = ResistanceJob {
        hull: arguments.hull.clone(),
        overrides: arguments.stations.with(&arguments.conventions),
        draught: arguments.draught,
        speeds: arguments.speeds.0.clone(),
        method: match arguments.method {
            MethodWord::Holtrop1984 => Method::Holtrop1984,
            MethodWord::Holtrop1982 => Method::Holtrop1982,
            MethodWord::Michell => Method::Michell,
            MethodWord::Ittc57 => Method::Ittc57,
        },
        options: options(arguments),
    };
    let outputs = resistance_outputs(&job)?;
    if !arguments.quiet {
        outputs.notes.iter().for_each(|note| stream::message(note));
    }
    outputs.warnings.iter().for_each(|warning| stream::message(warning));
    if let Some(folder) = &arguments.output {
        let inputs = Inputs::of(&source_files(&arguments.hull));
        Destination { folder, inputs: &inputs, force: arguments.force }
            .write_run(&resistance_files(&outputs, !arguments.no_figures)?)?;
    }
    stream::data(&if arguments.json {
        stream::json(&resistance_json(&outputs.file()))?
    } else {
        resistance_page(&outputs)
    })
}
