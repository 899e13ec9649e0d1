//! The job of `resistance`: a hull, a method and speeds become a table, files and a figure.

use std::path::PathBuf;

use super::resistance_inputs::{Afloat, Gathered, ResistanceOptions, gather, viscous_inputs};
use crate::config::{Diagnostic, Severity};
use crate::exchange::{ResistanceFile, resistance_csv, resistance_json};
use crate::hull::Hull;
use crate::hydrostatics::Hydrostatics;
use crate::plot::{ResistanceSheet, resistance_figure};
use crate::report::failure::{Failure, problem};
use crate::report::input::hydrostatic_body::{HydrostaticBody, read_hydrostatic_body_at, read_hydrostatic_body_with};
use crate::report::input::source::{Overrides, read_bytes, read_source_with, ship_name};
use crate::report::output::files::OutputFile;
use crate::report::output::manifest::{json_file, manifest_entry, manifest_file};
use crate::resistance::{
    InputOrigin, Method, Prediction, PredictionInput, PredictionRow, ShipFault, ShipParameters, ThinShip,
    ViscousOverrides, limits, predict,
};
use crate::units::KNOT;

/// Dots per inch of the figure.
const DOTS_PER_INCH: f64 = 150.0;
/// Part of the midship section that a transom has where thin-ship theory misses its wake.
const TRANSOM: f64 = 0.02;
/// C_B from which on thin-ship theory ranks at best.
const FULL: f64 = 0.6;

/// What is wanted.
#[derive(Debug, Clone)]
pub struct ResistanceJob {
    /// The hull, table, design, mesh or CAD file.
    pub hull: PathBuf,
    /// Conventions of a table or a body over those of its file.
    pub overrides: Overrides,
    /// Draught above the base line \[m\], over that of the hull.
    pub draught: Option<f64>,
    /// Speeds \[kn\].
    pub speeds: Vec<f64>,
    /// The method.
    pub method: Method,
    /// What is stated of the ship and the water.
    pub options: ResistanceOptions,
}

/// What it came to.
#[derive(Debug, Clone)]
pub struct ResistanceOutputs {
    /// Name of the hull.
    pub name: String,
    /// The method.
    pub method: Method,
    /// The inputs.
    pub inputs: Vec<PredictionInput>,
    /// A row a speed, speeds rising.
    pub rows: Vec<PredictionRow>,
    /// Propulsive efficiency, where it was given.
    pub efficiency: Option<f64>,
    /// Warnings, each with its code.
    pub warnings: Vec<String>,
    /// What was assumed when the hull was read.
    pub notes: Vec<String>,
    /// The file that was read.
    input: PathBuf,
}

impl ResistanceOutputs {
    /// What the files and the JSON of the command hold.
    #[must_use]
    pub fn file(&self) -> ResistanceFile<'_> {
        ResistanceFile {
            name: &self.name,
            method: self.method,
            limits: limits(self.method),
            inputs: &self.inputs,
            rows: &self.rows,
            efficiency: self.efficiency,
            warnings: &self.warnings,
        }
    }
}

/// Reads the hull and predicts.
///
/// # Errors
/// Those of [`read_hydrostatic_body_with`]; [`Failure::Usage`] without a draught or with a draught that is none of the
/// hull; [`Failure::Input`] with E510 where the formulas are not defined for the ship.
pub fn resistance_outputs(job: &ResistanceJob) -> Result<ResistanceOutputs, Failure> {
    let body = match job.draught {
        Some(draught) => read_hydrostatic_body_at(&job.hull, &job.overrides, draught)?,
        None => read_hydrostatic_body_with(&job.hull, &job.overrides)?,
    };
    let draught = body.particulars.draught.ok_or_else(|| Failure::without_draught("resistance", 1))?;
    let (table, warned) = body.curves_of_form(&[draught], &body.conventions)?;
    let row = table.rows.first().ok_or_else(|| Failure::Internal("no row of hydrostatics".to_owned()))?;
    let afloat = Afloat {
        row,
        hull: body.hull(),
        draught: draught - body.lowest(),
        draught_given: job.draught.is_some(),
        density: job.options.density.unwrap_or(body.conventions.density),
        density_given: body.conventions.given.density,
    };
    let gathered = gather(&afloat, &job.options);
    let thin = if job.method == Method::Michell { Some(thin_ship(job, &body, draught)?) } else { None };
    let mut speeds: Vec<f64> = job.speeds.iter().map(|knots| knots * KNOT).collect();
    speeds.sort_by(f64::total_cmp);
    let overrides = ViscousOverrides { form_factor: job.options.form_factor, allowance: job.options.allowance };
    let prediction = predict(job.method, &gathered.ship, thin.as_ref(), &speeds, &gathered.water, overrides)
        .map_err(|faults| undefined(job, &gathered.ship, &faults))?;
    let (form_factor, allowance) = notes_on_viscous(job.method, &gathered, &prediction);
    let mut inputs = vec![between_perpendiculars(&body)];
    inputs.extend(gathered.inputs.iter().cloned());
    inputs.extend(viscous_inputs(&job.options, form_factor, allowance));
    let mut warnings: Vec<String> = body.warnings().chain(warned).collect();
    warnings.extend(warnings_of(job, &gathered, &prediction, row).iter().map(ToString::to_string));
    let notes = body.notes.iter().filter(|note| !warnings.contains(note)).cloned().collect();
    let rows = prediction.rows;
    let name = body.hull().map_or_else(|| ship_name(&job.hull), |hull| hull.name().to_owned());
    let input = if job.hull.is_dir() { job.hull.join("hull.json") } else { job.hull.clone() };
    let efficiency = job.options.efficiency;
    Ok(ResistanceOutputs { name, method: job.method, inputs, rows, efficiency, warnings, notes, input })
}

/// L_PP, which the formulas do not take: its origin belongs on each page.
fn between_perpendiculars(body: &HydrostaticBody) -> PredictionInput {
    let (given, assumed) = (body.conventions.given.length, body.conventions.assumed.length);
    PredictionInput {
        symbol: "LPP",
        name: "length between perpendiculars",
        value: body.particulars.length_between_perpendiculars,
        unit: "m",
        decimals: 3,
        origin: match (given, assumed) {
            (true, _) => InputOrigin::Given,
            (false, true) => InputOrigin::Assumed,
            (false, false) => InputOrigin::FromHull,
        },
        note: "the formulas take L",
    }
}

/// The hull for thin-ship theory: of a body of triangles the surface through its sections.
fn thin_ship(job: &ResistanceJob, body: &HydrostaticBody, draught: f64) -> Result<ThinShip, Failure> {
    let of = |hull: &Hull| ThinShip::new(hull, draught).map_err(|error| Failure::of_draught(&error));
    match body.hull() {
        Some(hull) => of(hull),
        None => of(&read_source_with(&job.hull, &job.overrides)?.hull),
    }
}

fn undefined(job: &ResistanceJob, ship: &ShipParameters, faults: &[ShipFault]) -> Failure {
    let impossible = ship.impossible();
    let option = |symbol: &str| match symbol {
        "L" | "L/B" => "--lwl",
        "B" => "--breadth",
        "volume" | "C_P" => "--volume or --cm",
        "C_B" => "--volume, --lwl or --draught",
        "S" => "--wetted-surface",
        "C_M" => "--cm",
        "C_WP" => "--cwp",
        "i_E" => "--half-angle",
        "A_T" => "--transom-area",
        "A_BT" => "--bulb-area",
        "h_B" => "--bulb-height",
        _ => "--lcb",
    };
    let message = |fault: &ShipFault| {
        let help = match fault.symbol {
            "R_T over the weight" => "Give lower speeds, or the draught and displacement of a ship".to_owned(),
            _ if impossible.contains(fault) => format!("Correct {}", option(fault.symbol)),
            _ => format!("State {}, or take --method michell", option(fault.symbol)),
        };
        problem("E510", &job.hull, fault.to_string(), help)
    };
    Failure::Input(faults.iter().map(message).collect())
}

type Noted = (f64, &'static str);

/// Form factor and allowance with what they are where nobody gave them.
fn notes_on_viscous(method: Method, gathered: &Gathered, prediction: &Prediction) -> (Noted, Noted) {
    let of_holtrop = gathered.ship.faults().is_empty();
    let (form, allowance) = match method {
        Method::Holtrop1984 => ("Holtrop 1984", "Holtrop 1984"),
        Method::Holtrop1982 => ("Holtrop 1982", "Holtrop 1982"),
        _ if of_holtrop => ("Holtrop 1984", "smooth hull"),
        _ => ("no formula serves this hull", "smooth hull"),
    };
    ((prediction.form_factor, form), (prediction.allowance, allowance))
}

fn warnings_of(
    job: &ResistanceJob,
    gathered: &Gathered,
    prediction: &Prediction,
    row: &Hydrostatics,
) -> Vec<Diagnostic> {
    let warning = |code: &'static str, message: String, help: &str| Diagnostic {
        severity: Severity::Warning,
        ..problem(code, &job.hull, message, help)
    };
    let statistical = matches!(job.method, Method::Holtrop1982 | Method::Holtrop1984);
    let mut list = Vec::new();
    let count = prediction.rows.iter().filter(|row| !row.outside.is_empty()).count();
    if let Some(first) = prediction.rows.iter().rev().find(|row| !row.outside.is_empty()) {
        let ranges: Vec<String> = first.outside.iter().map(ToString::to_string).collect();
        let knots = first.components.speed / KNOT;
        let message = format!(
            "{} of {} speeds are outside the range of the data, at {knots:.2} kn: {}",
            count,
            prediction.rows.len(),
            ranges.join("; ")
        );
        list.push(warning("W510", message, "These figures are an extrapolation"));
    }
    if let Some(angle) = gathered.blunt.filter(|_| statistical) {
        let message = format!(
            "the hull's half angle of entrance, {angle:.1} deg, is that of a rounded stem; {:.1} deg is assumed",
            gathered.ship.half_angle
        );
        list.push(warning("W511", message, "State --half-angle"));
    }
    if job.method == Method::Michell {
        list.extend(
            thin_ship_doubts(gathered, row).map(|message| warning("W512", message, "Compare with holtrop-1984")),
        );
    }
    if !statistical && job.options.form_factor.is_none() {
        let message = format!("1 + k1 is assumed to be {:.3}", prediction.form_factor);
        list.push(warning("W513", message, "State --form-factor"));
    }
    if gathered.bulb_found && statistical {
        let message = format!(
            "the section at the stem is taken as a bulb of {:.2} m2, centre at {:.2} m",
            gathered.ship.bulb_area, gathered.ship.bulb_height
        );
        list.push(warning("W513", message, "State --bulb-area and --bulb-height, 0 for none"));
    }
    list
}

/// Why the figures of thin-ship theory are doubtful on this hull.
fn thin_ship_doubts(gathered: &Gathered, row: &Hydrostatics) -> Option<String> {
    let block = gathered.ship.block_coefficient();
    let full = (block > FULL).then(|| format!("C_B {block:.3} is above {FULL}: the theory ranks such hulls at best"));
    let part = row.transom_area / row.midship_section_area.max(f64::MIN_POSITIVE);
    let transom = (part > TRANSOM).then(|| {
        format!("the transom has {:.1} % of the midship section: its wake is taken as dry at all speeds", 100.0 * part)
    });
    let doubts: Vec<String> = [full, transom].into_iter().flatten().collect();
    (!doubts.is_empty()).then(|| doubts.join("; "))
}

/// `resistance.csv`, `resistance.json`, the figure as PNG and SVG, and `manifest.json`.
///
/// # Errors
/// [`Failure::FileSystem`] when the hull cannot be read again for its hash; [`Failure::Internal`] when the figure cannot
/// be drawn.
pub fn resistance_files(outputs: &ResistanceOutputs, figures: bool) -> Result<Vec<OutputFile>, Failure> {
    let file = outputs.file();
    let mut files = vec![
        OutputFile::text("resistance.csv", resistance_csv(&file)),
        json_file("resistance.json", &resistance_json(&file))?,
    ];
    let words = words(outputs);
    let sheet = ResistanceSheet { name: &outputs.name, method: outputs.method, rows: &outputs.rows, words: &words };
    let internal = |error: &dyn std::fmt::Display| Failure::Internal(format!("resistance: {error}"));
    let figure = if figures { resistance_figure(&sheet).map_err(|e| internal(&e))? } else { None };
    if let Some(figure) = figure {
        let contents = figure.to_png(DOTS_PER_INCH).map_err(|e| internal(&e))?;
        files.push(OutputFile { name: "resistance.png".to_owned(), contents });
        files.push(OutputFile::text("resistance.svg", figure.as_str().to_owned()));
    }
    let manifest = manifest_file(manifest_entry(&outputs.input, &read_bytes(&outputs.input)?), &files)?;
    files.push(manifest);
    Ok(files)
}

/// Dimensions and water in one line.
fn words(outputs: &ResistanceOutputs) -> String {
    let shown = ["L", "B", "T", "volume", "S", "density", "1+k1"];
    let inputs = outputs.inputs.iter().filter(|input| shown.contains(&input.symbol));
    let write = |input: &PredictionInput| {
        let unit = if input.unit == "-" { String::new() } else { format!(" {}", input.unit) };
        format!("{} {:.*}{unit}", input.symbol, input.decimals.min(3), input.value)
    };
    inputs.map(write).collect::<Vec<_>>().join("   ")
}
