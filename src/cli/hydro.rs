//! `loftsman hydro HULL [--draughts LIST]`

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use super::{Lengths, length, lengths, positive, stream};
use crate::exchange::{hydrostatics_csv, hydrostatics_json};
use crate::hydrostatics::{
    CoefficientLength, Conventions, DENSITIES, GRAVITY_HEIGHTS, Given, LcbReference, PrismaticSection,
};
use crate::report::{Failure, hydrostatics_page, read_hydrostatic_body_at, read_hydrostatic_body_with, source_files};
use crate::units::{Dimension, parse};

#[derive(Debug, Args)]
#[command(after_help = super::TABLES)]
pub(super) struct Arguments {
    /// hull.json, a folder that holds one, a design file, a table of offsets (which is fitted first), or a mesh or CAD
    /// file (taken as it is)
    hull: PathBuf,
    /// Draughts above the base line [m], as 1:9:1 [default: about 20 round ones from a fifth of the design draught to the
    /// depth, with both; from a fifth of the depth where no design draught is stated]
    #[arg(long, alias = "drafts", value_parser = lengths, value_name = "LIST", allow_hyphen_values = true)]
    draughts: Option<Lengths>,
    /// Design draught above the base line [default: of the hull, where one is stated]
    #[arg(long, alias = "draft", value_parser = positive, value_name = "T", allow_hyphen_values = true)]
    draught: Option<f64>,
    #[command(flatten)]
    conventions: super::BodyFlags,
    #[command(flatten)]
    stations: super::StationFlags,
    /// Every quantity as CSV
    #[arg(long, conflicts_with = "json")]
    csv: bool,
    /// Every quantity as JSON
    #[arg(long)]
    json: bool,
    /// Density of the water: t/m3, or with a unit [default: of the hull]
    #[arg(long, value_parser = density, value_name = "DENSITY")]
    density: Option<f64>,
    /// Length that coefficients are referred to [default: of the hull]
    #[arg(long, value_enum, value_name = "LENGTH")]
    coefficient_length: Option<CoefficientLengthWord>,
    /// Section that Cp is referred to [default: of the hull]
    #[arg(long, value_enum, value_name = "SECTION")]
    section_for_cp: Option<SectionWord>,
    /// Height of the centre of gravity above the base line, for GM and MTC [default: of the hull]
    #[arg(long, value_parser = height_of_gravity, value_name = "KG", allow_hyphen_values = true)]
    kg: Option<f64>,
    /// Where the LCB of the table is measured from [default: of the hull]
    #[arg(long, value_parser = lcb_reference, value_name = "AP|midship|FP|percent")]
    lcb_reference: Option<LcbReference>,
    /// File to write instead of stdout
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Overwrite the file when it is there already
    #[arg(long)]
    force: bool,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum CoefficientLengthWord {
    #[value(name = "Lpp", alias = "lpp")]
    Lpp,
    #[value(name = "Lwl", alias = "lwl")]
    Lwl,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum SectionWord {
    Maximum,
    Midship,
}

fn density(text: &str) -> Result<f64, String> {
    let measure = parse(text).map_err(|error| error.to_string())?;
    if !matches!(measure.dimension, Dimension::None | Dimension::Density) {
        return Err(format!("{text} is {}, expected a density", measure.dimension.as_str()));
    }
    if DENSITIES.contains(&measure.value) {
        return Ok(measure.value);
    }
    Err("expected 0.9 to 1.3 t/m3, or with its unit as 1025kg/m3".to_owned())
}

fn height_of_gravity(text: &str) -> Result<f64, String> {
    let height = length(text)?;
    if GRAVITY_HEIGHTS.contains(&height) { Ok(height) } else { Err("expected -1000 to 1000 m".to_owned()) }
}

fn lcb_reference(word: &str) -> Result<LcbReference, String> {
    let known = LcbReference::ALL.map(LcbReference::as_str).join(", ");
    LcbReference::ALL
        .into_iter()
        .find(|reference| reference.as_str().eq_ignore_ascii_case(word))
        .ok_or(format!("known are {known}"))
}

/// The conventions stored with the hull, and over them what the command line says.
fn conventions(arguments: &Arguments, stored: Conventions) -> Conventions {
    let given = Given {
        draught: arguments.draught.map(|_| true).or(stored.given.draught),
        lcb_reference: stored.given.lcb_reference || arguments.lcb_reference.is_some(),
        density: stored.given.density || arguments.density.is_some(),
        ..stored.given
    };
    Conventions {
        given,
        density: arguments.density.unwrap_or(stored.density),
        coefficient_length: match arguments.coefficient_length {
            Some(CoefficientLengthWord::Lpp) => CoefficientLength::BetweenPerpendiculars,
            Some(CoefficientLengthWord::Lwl) => CoefficientLength::Waterline,
            None => stored.coefficient_length,
        },
        prismatic_section: match arguments.section_for_cp {
            Some(SectionWord::Maximum) => PrismaticSection::Maximum,
            Some(SectionWord::Midship) => PrismaticSection::Midship,
            None => stored.prismatic_section,
        },
        lcb_reference: arguments.lcb_reference.unwrap_or(stored.lcb_reference),
        centre_of_gravity_height: arguments.kg.or(stored.centre_of_gravity_height),
        ..stored
    }
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let overrides = arguments.stations.with(&arguments.conventions);
    let source = match arguments.draught {
        Some(draught) => read_hydrostatic_body_at(&arguments.hull, &overrides, draught)?,
        None => read_hydrostatic_body_with(&arguments.hull, &overrides)?,
    };
    source.notes.iter().for_each(|note| stream::message(note));
    let draughts = match &arguments.draughts {
        Some(Lengths(list)) => list.clone(),
        None => source.default_draughts()?,
    };
    let (table, warnings) = source.curves_of_form(&draughts, &conventions(arguments, source.conventions))?;
    warnings.iter().for_each(|warning| stream::message(warning));
    let text = if arguments.json {
        let all = source.warnings().chain(warnings).collect::<Vec<String>>();
        stream::json(&hydrostatics_json(source.hull(), &table, &all).map_err(|e| Failure::Internal(e.to_string()))?)?
    } else if arguments.csv {
        hydrostatics_csv(&table)
    } else {
        let page = hydrostatics_page(&table, &source.particulars);
        if arguments.output.is_none() {
            return stream::page(&page);
        }
        page
    };
    let inputs = source_files(&arguments.hull);
    stream::Target { file: arguments.output.as_deref(), inputs: &inputs, force: arguments.force }.text(text)
}
