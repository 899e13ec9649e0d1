//! `loftsman derive PARENT --cb 0.72 --lpp 91 -o DIR`

use std::path::PathBuf;

use clap::Args;

use super::run_files::{Figures, RunFiles};
use super::stream;
use crate::config::{DeriveFile, Diagnostic, read_derive_option};
use crate::exchange::derive_json;
use crate::report::{
    Destination, Failure, Inputs, derive_files, derive_outputs, derive_page, read_derive_job, source_files,
};

const DIMENSIONS: &str = "Dimensions";
const TARGETS: &str = "Targets";

#[derive(Debug, Args)]
#[command(after_help = AFTER)]
pub(super) struct Arguments {
    /// The parent: hull.json, a folder that holds one, a design, a table of offsets, a mesh or CAD file; or a job file with
    /// [derive]
    parent: PathBuf,
    /// How targets are met: affine, one-minus-prismatic, lackenby or nearest [default: nearest]
    #[arg(long, value_name = "METHOD")]
    method: Option<String>,
    /// Length between perpendiculars [default: of the parent]
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true, help_heading = DIMENSIONS)]
    lpp: Option<String>,
    /// Moulded breadth [default: of the parent]
    #[arg(long, alias = "breadth", value_name = "LENGTH", allow_hyphen_values = true, help_heading = DIMENSIONS)]
    beam: Option<String>,
    /// Design draught [default: of the parent]
    #[arg(long, alias = "draft", value_name = "LENGTH", allow_hyphen_values = true, help_heading = DIMENSIONS)]
    draught: Option<String>,
    /// Depth to the deck at side [default: of the parent]
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true, help_heading = DIMENSIONS)]
    depth: Option<String>,
    /// Design draught of the parent [default: its own]
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true, help_heading = DIMENSIONS)]
    parent_draught: Option<String>,
    /// Displacement, moulded: tonnes, or "4000 m3"
    #[arg(long, value_name = "MASS|VOLUME", allow_hyphen_values = true, help_heading = TARGETS)]
    displacement: Option<String>,
    /// Block coefficient [default: kept]
    #[arg(long, value_name = "CB", allow_hyphen_values = true, help_heading = TARGETS)]
    cb: Option<String>,
    /// Longitudinal centre of buoyancy, "+0.8 %" of Lpp from midship or "41 m AP" [default: kept, in parts of Lpp]
    #[arg(long, value_name = "LCB", allow_hyphen_values = true, help_heading = TARGETS)]
    lcb: Option<String>,
    /// Prismatic coefficient
    #[arg(long, value_name = "CP", allow_hyphen_values = true, help_heading = TARGETS)]
    cp: Option<String>,
    /// Midship section coefficient [default: kept]
    #[arg(long, value_name = "CM", allow_hyphen_values = true, help_heading = TARGETS)]
    cm: Option<String>,
    /// Waterplane coefficient
    #[arg(long, value_name = "CWP", allow_hyphen_values = true, help_heading = TARGETS)]
    cwp: Option<String>,
    /// Longitudinal centre of flotation, as LCB
    #[arg(long, value_name = "LCF", allow_hyphen_values = true, help_heading = TARGETS)]
    lcf: Option<String>,
    /// Height of the centre of buoyancy
    #[arg(long, value_name = "KB", allow_hyphen_values = true, help_heading = TARGETS)]
    kb: Option<String>,
    /// Height of the transverse metacentre
    #[arg(long, value_name = "KM", allow_hyphen_values = true, help_heading = TARGETS)]
    km: Option<String>,
    /// Wetted surface, m2
    #[arg(long, value_name = "AREA", allow_hyphen_values = true, help_heading = TARGETS)]
    wetted_surface: Option<String>,
    /// Aft and fore end of the parallel body, as 40,55, with --method lackenby
    #[arg(long, value_name = "AFT,FORE", allow_hyphen_values = true, help_heading = TARGETS)]
    parallel_body: Option<String>,
    /// What is not kept although nothing states it: displacement, lcb or cm; may be repeated
    #[arg(long, value_name = "NAME", help_heading = TARGETS)]
    free: Vec<String>,
    /// Print what each target can be with the others as they are
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
A job file has the same in [derive]: parent, method, Lpp, B, T, D, displacement, Cb, Cp, Cm, Cwp, LCB, LCF, KB, KM, wetted_surface, \
parallel_body, free. Options override it.
Files: those of generate, derive.json, compare.md, compare.csv, compare.json and the figures that compare parent and daughter. Exit code 4 \
when no daughter meets the targets; the message states what is within reach.";

impl Arguments {
    fn wanted(&self) -> Result<DeriveFile, Failure> {
        let named = [
            ("--method", "method", &self.method),
            ("--lpp", "Lpp", &self.lpp),
            ("--beam", "B", &self.beam),
            ("--draught", "T", &self.draught),
            ("--depth", "D", &self.depth),
            ("--parent-draught", "parent_draught", &self.parent_draught),
            ("--displacement", "displacement", &self.displacement),
            ("--cb", "Cb", &self.cb),
            ("--lcb", "LCB", &self.lcb),
            ("--cp", "Cp", &self.cp),
            ("--cm", "Cm", &self.cm),
            ("--cwp", "Cwp", &self.cwp),
            ("--lcf", "LCF", &self.lcf),
            ("--kb", "KB", &self.kb),
            ("--km", "KM", &self.km),
            ("--wetted-surface", "wetted_surface", &self.wetted_surface),
            ("--parallel-body", "parallel_body", &self.parallel_body),
        ];
        let (mut wanted, mut problems): (DeriveFile, Vec<Diagnostic>) = Default::default();
        let given = named.into_iter().filter_map(|(option, key, value)| Some((option, key, value.as_ref()?)));
        for (option, key, value) in given {
            match read_derive_option(option, key, value) {
                Ok(one) => wanted = wanted.over(one),
                Err(found) => problems.extend(found),
            }
        }
        for name in &self.free {
            match read_derive_option("--free", "free", name) {
                Ok(one) => wanted.free.extend(one.free),
                Err(found) => problems.extend(found),
            }
        }
        if self.cb.is_some() && self.displacement.is_some() {
            return Err(Failure::Usage("--cb and --displacement are one target: leave one of them out".to_owned()));
        }
        if problems.is_empty() { Ok(wanted) } else { Err(Failure::Options(problems)) }
    }
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let overrides = arguments.stations.with(&arguments.conventions);
    let job = read_derive_job(&arguments.parent, arguments.wanted()?, overrides, arguments.limits)?;
    let folder = arguments.files.folder(&arguments.parent, false);
    let mut read = source_files(&job.parent);
    read.extend(job.file.clone());
    let inputs = Inputs::of(&read);
    let destination = Destination { folder: &folder, inputs: &inputs, force: arguments.files.force };
    destination.check(["hull.json", "derive.json", "manifest.json"])?;
    let usual = ["lines", "sections", "sectional-area", "hydrostatics", "diagram-sheet"];
    let outputs = derive_outputs(&job, &arguments.figures.chosen(&arguments.files, &usual))?;
    if !arguments.files.quiet {
        outputs.notes.iter().for_each(|note| stream::message(note));
    }
    outputs.warnings.iter().for_each(|warning| stream::message(warning));
    destination.write_run(&derive_files(&job, &outputs, !arguments.files.no_figures)?)?;
    if arguments.files.json {
        return stream::data(&stream::json_judged(derive_json(&outputs.report()), &outputs.verdict())?)
            .and(outputs.verdict());
    }
    if !arguments.files.quiet {
        stream::page(&derive_page(&outputs))?;
    }
    outputs.verdict()
}
