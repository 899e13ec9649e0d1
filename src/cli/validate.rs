//! `loftsman validate FOLDER...`

use std::path::PathBuf;

use clap::Args;

use super::stream;
use crate::report::{
    Destination, Failure, Inputs, OutputFile, validate, validation_csv, validation_json, validation_page,
};

#[derive(Debug, Args)]
#[command(after_help = AFTER)]
pub(super) struct Arguments {
    /// Folders of hulls: each holds, or is, a folder with a table of offsets and a reference.toml
    #[arg(required = true, value_name = "FOLDER")]
    folders: Vec<PathBuf>,
    /// JSON instead of the table
    #[arg(long)]
    json: bool,
    /// Folder for report.md and validation.csv
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
    /// Overwrite the files when they are there already
    #[arg(long)]
    force: bool,
}

const AFTER: &str = "\
reference.toml: [particulars] lpp (or lbp), beam, draught (or z_waterline, lwl_draught), depth; [published] figures at that \
draught and their source; [published.volume_m3] with T2_5 = ... for other draughts; [exact] closed forms; [check] other \
integrations of the same table, where nothing is published; [tolerance] what a figure may differ by; [table] file. Figures: \
volume_m3, displacement_t (in water of 1.025 t/m3), cb, cm, cp, cwp, lcb_percent_lpp_fwd, lcb_from_ap_m, lcb_m and lcf_m (from \
midship, + forward), lcb_m_aft_of_midship, lcb_x_m, kb_m, km_m, bmt_m, bml_m, it_m4, il_m4, waterplane_area_m2, \
wetted_surface_m2, tpc_t_per_cm; with _implied, _other, _pchip or _trapezoid behind them they are the same. Tolerances: \
the name for an absolute one (lcb_percent_lpp, lcb_m for all centres of buoyancy), volume_percent, cb_percent, \
wetted_surface_percent ... for one in %. [sign_trap] says that columns ..._printed count centres + aft. A file \
*hydrostatics.csv with a column T_m is a published table with the same names. What has no tolerance is not judged, nor is \
a draught with fewer than three waterlines up to it. Our coefficients are on Lpp and moulded B; those of programs that refer \
them to the waterline at each draught (Maxsurf) differ by that. Exit code 5 when a tolerance is exceeded.";

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let cases = validate(&arguments.folders)?;
    if let Some(folder) = &arguments.output {
        let page = format!("# Fitted tables against published figures\n\n{}", validation_page(&cases));
        let files = [OutputFile::text("report.md", page), OutputFile::text("validation.csv", validation_csv(&cases))];
        let inputs: Vec<PathBuf> = cases.iter().map(|case| case.folder.join(&case.table)).collect();
        Destination { folder, inputs: &Inputs::of(&inputs), force: arguments.force }.write(&files)?;
    }
    let failed: Vec<&str> = cases.iter().filter(|case| !case.passed()).map(|case| case.name.as_str()).collect();
    let verdict = match failed.as_slice() {
        [] => Ok(()),
        failed => Err(Failure::Check(format!("E502 beyond a tolerance, or no hull: {}", failed.join(", ")))),
    };
    let json = || stream::json_judged(validation_json(&cases), &verdict);
    stream::data(&if arguments.json { json()? } else { validation_page(&cases) })?;
    verdict
}
