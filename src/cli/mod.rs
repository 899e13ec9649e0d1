//! The command line: one file a subcommand. Data goes to stdout, messages to stderr; every number that is printed was
//! returned by a library function.

mod blend;
mod catalogue;
mod check;
mod compare;
mod completions;
mod convert;
mod derive;
mod explain;
mod export;
mod fair;
mod fair_curve;
mod fit;
mod generate;
mod hydro;
mod inspect;
mod loft;
mod new;
mod offsets;
mod report;
mod resistance;
mod run_files;
mod schema;
mod section;
mod self_test;
mod stream;
mod target_flags;
mod usage;
mod validate;

use std::ffi::OsString;
use std::process::ExitCode;

use clap::{Args, Parser, Subcommand};

use crate::report::{Failure, Overrides};
use crate::units::Notation;

/// The tables of offsets that are read, for the help of every command that takes one.
const TABLES: &str = "\
Tables of offsets, recognised by content: CSV and TSV (matrix of stations and waterlines, one offset a line, or sections as points), \
XLSX; metres, millimetres, feet-inches-eighths; GHS (.gf), BRITFAIR (.bri), PIAS, PDSTRIP, SEAWAY, text of FREE!ship, tables of \
DELFTship, input of Michlet, and tables of fractions of the half-breadth, as those of Series 60. A TOML file of the same name beside a table may \
say what it leaves open (units, axes, Lpp, B, T).
Bodies: meshes as STL (binary, ASCII), OBJ, PLY, OFF, GLB, glTF, 3MF, VTK and gmsh, panels as GDF, NEMOH (.mar, .dat), PNL and HydroStar, closed or without deck, transom and flat bow; the faces of IGES, STEP and 3DM \
files, trimmed or not; faces of DXF by layers, or its stations and waterlines in space; control nets of FREE!ship (.fbm, .ftm), which are subdivided; whole or half. They become sections of points. Beside them the TOML may say, in [table], units, scale, axes (\"x -z y\": the file's axes that point forward, to port and up) or up alone, body (\"half\" or \"whole\"), x_origin \
and z_origin (where the file's origin is, forward of AP and above the base line), Lpp, T, and sections, how many spaces.";

/// Generates, fits and fairs ship hulls, and computes their hydrostatics and drawings.
#[derive(Debug, Parser)]
#[command(name = "loftsman", version, max_term_width = 100, after_help = EXIT_CODES)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

const EXIT_CODES: &str = "Lists: 1:9:1 (from:to:step, both ends), 1,2.5,4 or 0,5,...,30; lengths are metres, or carry a unit: \
6150mm, 20ft6in, 3-4-5+.\nExit codes: 0 ok, 1 internal error, 2 usage, 3 bad input, 4 infeasible, 5 a check failed, 6 file system.\n\
With --json stdout is one document, of a failure {\"error\": [...]}. The file name - is standard input.";

#[derive(Debug, Subcommand)]
enum Command {
    /// Suspect cells and problems of a table of offsets
    Check(check::Arguments),
    /// Generate a hull from a design file: hull, offsets, hydrostatics, summary, figures
    Generate(generate::Arguments),
    /// Fair a table of offsets: hull, offsets, changes and a certificate, displacement and LCB held
    Fair(Box<fair::Arguments>),
    /// Fit a hull to a table of offsets: hull, residuals, hydrostatics, figures
    Fit(fit::Arguments),
    /// Fair one curve: a waterline, a sheer line, a curve of section areas
    FairCurve(fair_curve::Arguments),
    /// Print a commented design file; without a name, list the names
    New(new::Arguments),
    /// Figures and pages of what generate, fit, fair or hydro gave
    Report(report::Arguments),
    /// Print the JSON Schema of the design, the method or the job file
    Schema(schema::Arguments),
    /// Hydrostatic table of a hull at any draughts
    Hydro(hydro::Arguments),
    /// Calm-water resistance and effective power of a hull: Holtrop and Mennen, Michell, ITTC-57
    Resistance(Box<resistance::Arguments>),
    /// Derive a hull from a parent: other dimensions, displacement, coefficients and centres, all exact
    Derive(Box<derive::Arguments>),
    /// Blend two or more hulls by weights, or by the targets that the blend meets exactly
    Blend(Box<blend::Arguments>),
    /// Hulls that the program carries, ranked by how close they are to what is wanted
    Catalogue(catalogue::Arguments),
    /// Two hulls beside each other: particulars, hydrostatics in per cent, distances, body plans
    Compare(compare::Arguments),
    /// Table of offsets of a hull at any stations and waterlines
    Offsets(offsets::Arguments),
    /// Write a hull for other programs: STEP, IGES, 3DM, DXF, STL, OBJ, GLB, panels as GDF, NEMOH, PNL, sections
    Export(export::Arguments),
    /// Read a table of offsets and write it in its own notation and layout, or in others
    Convert(convert::Arguments),
    /// The curves in which a plane cuts a hull
    Section(section::Arguments),
    /// Frames of a mould loft at full size, inside or outside of the skin, with ordinates and bevels
    Loft(loft::Arguments),
    /// Inflections, curvature, energies and flats of a hull's curves, signs of its net, curvature of its surface
    Inspect(inspect::Arguments),
    /// Fit the tables of known hulls and compare with what is published about them
    Validate(validate::Arguments),
    /// Compare the analytic bodies with their closed forms
    SelfTest(self_test::Arguments),
    /// Completions of a shell; with -o those of all shells, and manual pages
    Completions(completions::Arguments),
    /// What the codes of messages mean, and what helps; without a code, all codes with their titles
    Explain(explain::Arguments),
}

/// A list of lengths [m] on the command line.
#[derive(Debug, Clone)]
struct Lengths(Vec<f64>);

fn lengths(text: &str) -> Result<Lengths, String> {
    crate::units::parse_list(text).map(Lengths).map_err(|error| error.to_string())
}

/// Conventions of a table or a body that override the TOML file beside it.
#[derive(Debug, Args)]
struct BodyFlags {
    /// Unit of a table, a mesh or a CAD file, over what it says itself: m, mm, cm, ft, in
    #[arg(long, value_parser = offsets::notation, value_name = "UNIT")]
    input_unit: Option<Notation>,
    /// Axis of a mesh or a CAD file that points up: z, y, x or -z, -y, -x; the longer of the other two points forward
    #[arg(long, value_name = "AXIS", allow_hyphen_values = true, conflicts_with = "axes")]
    up: Option<String>,
    /// Axes of a mesh or a CAD file that point forward, to port and up, as "x -z y"
    #[arg(long, value_name = "AXES", allow_hyphen_values = true)]
    axes: Option<String>,
    /// Whether a mesh or a CAD file has one side of the hull (half) or all of it (whole)
    #[arg(long, value_name = "PART", value_parser = ["half", "whole"])]
    body: Option<String>,
    /// Parts of a body that count, with commas between them: groups of OBJ, solids of STL, layers of 3DM and FREE!ship by name, shells by number
    #[arg(long, value_name = "PARTS")]
    parts: Option<String>,
    /// Distance between the numbers of stations of a table
    #[arg(long, value_parser = positive, value_name = "LENGTH", allow_hyphen_values = true)]
    station_spacing: Option<f64>,
    /// Distance between the numbers of waterlines of a table
    #[arg(long, value_parser = positive, value_name = "LENGTH", allow_hyphen_values = true)]
    waterline_spacing: Option<f64>,
}

impl BodyFlags {
    fn overrides(&self) -> Overrides {
        let unit = self.input_unit.map(|unit| unit.as_str().to_owned());
        let metres = |length: Option<f64>| length.map(|length| format!("{length} m"));
        let keys = [
            ("units", unit),
            ("up", self.up.clone()),
            ("axes", self.axes.clone()),
            ("body", self.body.clone()),
            ("parts", self.parts.clone()),
            ("station_spacing", metres(self.station_spacing)),
            ("waterline_spacing", metres(self.waterline_spacing)),
        ];
        Overrides { keys: keys.into_iter().filter_map(|(key, value)| Some((key, value?))).collect(), file: None }
    }
}

/// How the stations of a table are to be understood, over the TOML file beside it.
#[derive(Debug, Args)]
struct StationFlags {
    /// Stations of a table: "from AP", "from midship" or "from FP" for distances, "numbers from AP" or "numbers from FP"
    #[arg(long, value_name = "WORDS", value_parser = ["from AP", "from midship", "from FP", "numbers from AP", "numbers from FP"])]
    stations: Option<String>,
}

impl StationFlags {
    /// The conventions with that of the stations.
    fn with(&self, conventions: &BodyFlags) -> Overrides {
        let mut overrides = conventions.overrides();
        overrides.keys.extend(self.stations.clone().map(|words| ("stations", words)));
        overrides
    }
}

fn length(text: &str) -> Result<f64, String> {
    crate::units::parse_length(text).map_err(|error| error.to_string())
}

/// A length that is more than 0 [m].
fn positive(text: &str) -> Result<f64, String> {
    match length(text)? {
        value if value > 0.0 => Ok(value),
        _ => Err("must be more than 0".to_owned()),
    }
}

/// Stack of the commands \[bytes\], whatever that of the process is.
const STACK: usize = 16 << 20;

/// Runs the program on its arguments, the first of which is its name, and returns its exit code.
pub fn run(arguments: impl IntoIterator<Item = OsString>) -> ExitCode {
    let arguments: Vec<OsString> = arguments.into_iter().collect();
    let as_json = usage::wants_json(&arguments);
    let done = std::thread::scope(|scope| {
        let own = std::thread::Builder::new().stack_size(STACK).spawn_scoped(scope, || command(&arguments));
        match own {
            Ok(thread) => thread.join().unwrap_or_else(|_| Err(Failure::Internal("the job ended early".to_owned()))),
            Err(_) => command(&arguments),
        }
    });
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => told(&failure, as_json),
    }
}

fn command(arguments: &[OsString]) -> Result<(), Failure> {
    let cli = match Cli::try_parse_from(arguments) {
        Ok(cli) => cli,
        Err(error) if error.use_stderr() => return Err(usage::failure(&error)),
        Err(error) => {
            // Help and version go to stdout and are no error; a closed pipe changes neither.
            let _ = error.print();
            return Ok(());
        }
    };
    match &cli.command {
        Command::Check(arguments) => check::run(arguments),
        Command::Generate(arguments) => generate::run(arguments),
        Command::Fair(arguments) => fair::run(arguments),
        Command::Fit(arguments) => fit::run(arguments),
        Command::FairCurve(arguments) => fair_curve::run(arguments),
        Command::New(arguments) => new::run(arguments),
        Command::Report(arguments) => report::run(arguments),
        Command::Schema(arguments) => schema::run(arguments),
        Command::Hydro(arguments) => hydro::run(arguments),
        Command::Resistance(arguments) => resistance::run(arguments),
        Command::Derive(arguments) => derive::run(arguments),
        Command::Blend(arguments) => blend::run(arguments),
        Command::Compare(arguments) => compare::run(arguments),
        Command::Offsets(arguments) => offsets::run(arguments),
        Command::Export(arguments) => export::run(arguments),
        Command::Convert(arguments) => convert::run(arguments),
        Command::Catalogue(arguments) => catalogue::run(arguments),
        Command::Section(arguments) => section::run(arguments),
        Command::Loft(arguments) => loft::run(arguments),
        Command::Inspect(arguments) => inspect::run(arguments),
        Command::Validate(arguments) => validate::run(arguments),
        Command::SelfTest(arguments) => self_test::run(arguments),
        Command::Completions(arguments) => completions::run(arguments),
        Command::Explain(arguments) => explain::run(arguments),
    }
}

/// Reports a failure: in words, with how to read more about it, and as the one document where JSON is requested and none was
/// printed.
fn told(failure: &Failure, as_json: bool) -> ExitCode {
    if as_json && !stream::is_written() {
        // A closed pipe, or a full one, changes nothing about the failure.
        let _ = stream::json(&failure.to_json()).and_then(|text| stream::data(&text));
    }
    stream::message(&failure.to_string());
    if let Some(code) = failure.code().filter(|_| !as_json && failure.exit_code() != 2) {
        stream::message(&format!("More: loftsman explain {code}"));
    }
    ExitCode::from(failure.exit_code())
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    #[test]
    fn the_command_line_is_consistent() {
        Cli::command().debug_assert();
    }

    #[test]
    fn old_names_of_flags_are_read_and_not_shown() {
        for line in ["loftsman fair t.csv --sign-price 2", "loftsman export h.json -f gf,ghs --across 4"] {
            assert!(Cli::try_parse_from(line.split(' ')).is_ok(), "{line}");
        }
        let mut command = Cli::command();
        let mut help = |name: &str| command.find_subcommand_mut(name).unwrap().render_long_help().to_string();
        let shown = help("fair") + &help("export");
        assert!(["--sign-price", "--across", " gf"].iter().all(|old| !shown.contains(old)));
        assert!(shown.contains("--inflection-cost") && shown.contains("--divisions-across"));
    }

    /// With its value or without, before the table or behind it.
    #[test]
    fn options_that_were_removed_name_what_serves() {
        let shown = Cli::command().find_subcommand_mut("fair").unwrap().render_long_help().to_string();
        for (name, takes_value) in fair::REMOVED {
            let values: &[&str] = if takes_value { &["", " 3", "=-1"] } else { &[""] };
            let lines = values.iter().flat_map(|value| {
                [format!("loftsman fair --{name}{value} -o out t.csv"), format!("loftsman fair t.csv --{name}{value}")]
            });
            for line in lines {
                let error = Cli::try_parse_from(line.split(' ')).unwrap_err();
                let said = error.to_string();
                assert!(
                    error.use_stderr() && said.starts_with(&format!("error: --{name} was removed: --fairness")),
                    "{line}: {said}"
                );
            }
            assert!(!shown.contains(&format!("--{name}")), "{shown}");
        }
        assert!(Cli::try_parse_from(["loftsman", "fair-curve", "c.csv", "--order", "3"]).is_ok());
    }
}
