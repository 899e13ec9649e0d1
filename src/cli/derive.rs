//! `loftsman derive PARENT --cb 0.72 --lpp 91 -o DIR`

use std::path::PathBuf;

use clap::Args;

use super::run_files::{FIGURES_OF_MADE, Figures, Made, RunFiles};
use super::target_flags::{DIMENSIONS, TARGETS, TargetFlags};
use crate::config::DeriveFile;
use crate::exchange::derive_json;
use crate::report::{
    Destination, Failure, Inputs, derive_files, derive_outputs, derive_page, read_derive_job, source_files,
};

#[derive(Debug, Args)]
#[command(after_help = AFTER)]
pub(super) struct Arguments {
    /// The parent: hull.json, a folder that holds one, a design, a table of offsets, a mesh or CAD file, catalogue:NAME; or a job
    /// file with [derive]
    parent: PathBuf,
    /// How targets are met: affine, one-minus-prismatic, lackenby or nearest [default: nearest]
    #[arg(long, value_name = "METHOD")]
    method: Option<String>,
    #[command(flatten)]
    targets: TargetFlags,
    /// Design draught of the parent [default: its own]
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true, help_heading = DIMENSIONS)]
    parent_draught: Option<String>,
    /// Bilge radius r, instead of --cm: C_M = 1 - (2 - pi/2) r^2/(B T), of level bottom and plumb sides
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true, help_heading = TARGETS)]
    bilge_radius: Option<String>,
    /// Areas of sections below the design draught, both sides: a CSV of x and area
    #[arg(long, value_name = "FILE", help_heading = TARGETS)]
    section_areas: Option<String>,
    /// Aft and fore end of the parallel body, as 40,55, with --method nearest or lackenby
    #[arg(long, value_name = "AFT,FORE", allow_hyphen_values = true, help_heading = TARGETS)]
    parallel_body: Option<String>,
    /// What lies at height FROM of the scaled parent, as a level knuckle, comes to TO: "3.2 m:3.6 m"; may be repeated
    #[arg(long, value_name = "FROM:TO", allow_hyphen_values = true, help_heading = TARGETS)]
    move_height: Vec<String>,
    /// The same along the ship, forward of AP, as of a transom: "-2 m:-2.5 m"; may be repeated
    #[arg(long, value_name = "FROM:TO", allow_hyphen_values = true, help_heading = TARGETS)]
    move_position: Vec<String>,
    /// Froude numbers at which the wave resistance is made small, as 0.25:0.30:0.01, with displacement, centres and signs held
    #[arg(long, value_name = "LIST", help_heading = TARGETS)]
    wave_resistance: Option<String>,
    /// Weight of the wave resistance against bending, m2 [default: the knee of seven weights]
    #[arg(long, value_name = "WEIGHT", allow_hyphen_values = true, help_heading = TARGETS)]
    wave_weight: Option<String>,
    /// How far half-breadths move at most for the wave resistance [default: no limit]
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true, help_heading = TARGETS)]
    within: Option<String>,
    /// What is not kept although nothing states it: displacement, lcb or cm; may be repeated
    #[arg(long, value_name = "NAME", help_heading = TARGETS)]
    free: Vec<String>,
    /// Print what each target can be with the others as they are; without --output no files are written
    #[arg(long)]
    limits: bool,
    #[command(flatten)]
    conventions: super::BodyFlags,
    #[command(flatten)]
    stations: super::StationFlags,
    #[command(flatten)]
    files: RunFiles,
    #[command(flatten)]
    figures: Figures,
}

const AFTER: &str = "\
Targets in any combination are met to rounding. What is not named is kept: the dimensions, C_B, LCB in parts of Lpp, and C_M. All other \
quantities are free, and the page states their changes.
nearest: sections are shifted smoothly for C_B and LCB, then half-breadths change by least bending for all targets; profiles, keel, deck, \
centreplane and flat of side stay. lackenby and one-minus-prismatic: the classical shifts, iterated until C_P and LCB are exact. affine: \
dimensions alone.
--wave-resistance adds the mean of R_W over that of the parent to the bending, of thin ships (Michell), as one convex program.
A job file has the same in [derive]: parent, method, Lpp, B, T, D, displacement, Cb, Cp, Cm, Cwp, LCB, LCF, KB, KM, GM, KG, \
bilge_radius, wetted_surface, entrance, run, section_areas, parallel_body, move_height, move_position, wave_resistance, wave_weight, within, free. Options override it.
Files: those of generate, derive.json, compare.md, compare.csv, compare.json and the figures that compare parent and daughter. Exit code 4 \
when no daughter meets the targets; the message states what is within reach.";

impl Arguments {
    fn wanted(&self) -> Result<DeriveFile, Failure> {
        let own = [
            ("--method", "method", self.method.as_ref()),
            ("--parent-draught", "parent_draught", self.parent_draught.as_ref()),
            ("--bilge-radius", "bilge_radius", self.bilge_radius.as_ref()),
            ("--section-areas", "section_areas", self.section_areas.as_ref()),
            ("--parallel-body", "parallel_body", self.parallel_body.as_ref()),
            ("--wave-resistance", "wave_resistance", self.wave_resistance.as_ref()),
            ("--wave-weight", "wave_weight", self.wave_weight.as_ref()),
            ("--within", "within", self.within.as_ref()),
        ];
        if self.bilge_radius.is_some() && self.targets.states_midship() {
            return Err(Failure::Usage("--bilge-radius and --cm are one target: leave one of them out".to_owned()));
        }
        let lists = [
            ("--free", "free", &self.free),
            ("--move-height", "move_height", &self.move_height),
            ("--move-position", "move_position", &self.move_position),
        ];
        let repeated =
            lists.into_iter().flat_map(|(option, key, list)| list.iter().map(move |v| (option, key, Some(v))));
        self.targets.wanted(&own.into_iter().chain(repeated).collect::<Vec<_>>())
    }
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let overrides = arguments.stations.with(&arguments.conventions);
    let job = read_derive_job(&arguments.parent, arguments.wanted()?, overrides, arguments.limits)?;
    let folder = arguments.files.folder(&arguments.parent, false);
    let mut read = source_files(&job.parent);
    read.extend(job.other_inputs());
    let inputs = Inputs::of(&read);
    let destination = Destination { folder: &folder, inputs: &inputs, force: arguments.files.force };
    let is_written = arguments.files.is_written(arguments.limits);
    let mut figures = Vec::new();
    if is_written {
        destination.check(["hull.json", "derive.json", "manifest.json"])?;
        figures = arguments.figures.chosen(&arguments.files, &FIGURES_OF_MADE);
    }
    let outputs = derive_outputs(&job, &figures)?;
    let made = Made { is_written, notes: &outputs.notes, warnings: &outputs.warnings, verdict: outputs.verdict() };
    arguments.files.finish(
        &destination,
        made,
        || derive_files(&job, &outputs, !arguments.files.no_figures),
        || derive_json(&outputs.report()),
        || derive_page(&outputs),
    )
}
