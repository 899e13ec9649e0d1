//! Every job of the program in a few lines: `use loftsman::prelude::*;`.
//!
//! | function | reads | returns |
//! |---|---|---|
//! | [`generate`] | a design file | hull, table of offsets, hydrostatics |
//! | [`fit`] | a table of offsets | the surface through it |
//! | [`fair`] | a table of offsets, or a job file | the fair hull, what moved, the certificate |
//! | [`fair_curve`] | the points of a curve | the fair curve |
//! | [`derive()`] | a parent: any hull, table, design, mesh or CAD file | the daughter with other dimensions and coefficients |
//! | [`blend`] | two hulls or more | the hull between them, by weights or targets |
//! | [`compare`] | two of them | particulars, hydrostatics and distances beside each other |
//! | [`hydrostatics`] | any hull, table, mesh or CAD file | hydrostatics at any draughts |
//! | [`open`] | the same | the hull, for [`sections`] and [`export`] |
//! | [`report`] | the folder of a result | figures and pages |
//!
//! Nothing is written but by [`write()`] and [`overwrite`]. All lengths are in metres: x forward from AP, y to port, z up
//! from the base line. Every error is a [`Failure`], which has the code, the place and the remedy of each problem.
//!
//! ```
//! use loftsman::prelude::*;
//!
//! fn main() -> Result<(), Failure> {
//!     let table = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/series60_cb060/offsets.csv");
//!     let fitted = fit(table)?;
//!     assert!((fitted.fitted.hull.half_breadth(60.96, 6.502).unwrap_or(0.0) - 8.13).abs() < 0.02);
//!     let floating = hydrostatics(table, &[6.502])?;
//!     assert!((floating.curves.rows[0].displacement_volume / 7732.0 - 1.0).abs() < 5e-3);
//!     Ok(())
//! }
//! ```

use std::path::Path;

#[doc(no_inline)]
pub use crate::fairing::curve::CurveSettings;
#[doc(no_inline)]
pub use crate::hull::{Cut, Hull, OffsetTable, Section};
#[doc(no_inline)]
pub use crate::hydrostatics::{Conventions, CurvesOfForm, Hydrostatics};
#[doc(no_inline)]
pub use crate::report::{
    BlendOutputs, CompareOutputs, DeriveOutputs, ExportFormat, Exported, Failure, FairOutputs, FairedCurve, FitOutputs,
    OutputFile, Outputs, Source,
};

use crate::config::{DeriveFile, read_derive_option};
use crate::report::{
    BlendJob, CompareJob, CurveJob, Destination, ExportSettings, Inputs, Overrides, ReportSettings, blend_outputs,
    compare_outputs, derive_outputs, fair_outputs, faired_curve, fit_outputs, generate_outputs, read_derive_job,
    read_design, read_fair, read_fit, read_hydrostatic_body, read_result, read_source, report_outputs, sections_of,
};

/// Hydrostatics of a body, and what should be known about it.
#[derive(Debug, Clone)]
pub struct FloatingBody {
    /// Hydrostatics at each draught.
    pub curves: CurvesOfForm,
    /// Notes and warnings of the reading, and warnings about the figures.
    pub notes: Vec<String>,
}

/// Generates the hull of a design file (`.toml`, `.hgf`), with its tables; no figures are drawn.
///
/// # Errors
/// [`Failure::FileSystem`]; [`Failure::Input`] with every problem of the file; [`Failure::Infeasible`] with every reason why
/// no hull has these particulars.
pub fn generate(design: impl AsRef<Path>) -> Result<Outputs, Failure> {
    let path = design.as_ref();
    let (design, bytes) = read_design(path)?;
    generate_outputs(&design, (path, &bytes), &[])
}

/// The surface through a table of offsets by the default method; no figures are drawn.
///
/// # Errors
/// [`Failure::FileSystem`]; [`Failure::Input`] with every problem of the table.
pub fn fit(table: impl AsRef<Path>) -> Result<FitOutputs, Failure> {
    fit_outputs(&read_fit(table.as_ref(), None, None)?, &[])
}

/// Fairs a table of offsets, or the table that a job file names. `settings` are keys of the job file with their values, as
/// `("tolerance.table", "20 mm")` or `("hold.LCB", "-1.5 %")`; they override the file. No figures are drawn.
/// `warning()` of the result says whether the targets are met, `verdict()` whether the hull is fairer.
///
/// # Errors
/// [`Failure::FileSystem`]; [`Failure::Input`] with every problem of the files and the settings; [`Failure::Usage`] with those
/// of the settings where the files have none.
pub fn fair(table: impl AsRef<Path>, settings: &[(&str, &str)]) -> Result<FairOutputs, Failure> {
    let settings: Vec<_> = settings.iter().map(|&(key, value)| (key, key, value.to_owned())).collect();
    fair_outputs(&read_fair(table.as_ref(), &settings)?, false)
}

/// The daughter of a parent: any hull, table, design, mesh or CAD file, or a job file with `[derive]`. `wanted` are keys of
/// such a file with their values, as `("Cb", "0.72")` or `("LCB", "+0.8 %")`; what is not named is kept. No figures are
/// drawn.
///
/// # Errors
/// [`Failure::FileSystem`]; [`Failure::Input`] and [`Failure::Options`] for values that are wrong; [`Failure::Infeasible`]
/// where no daughter meets the targets, with what is within reach.
pub fn derive(parent: impl AsRef<Path>, wanted: &[(&str, &str)]) -> Result<DeriveOutputs, Failure> {
    derive_outputs(&read_derive_job(parent.as_ref(), options(wanted)?, Overrides::default(), false)?, &[])
}

/// What keys of a job file of `derive` state with their values.
fn options(wanted: &[(&str, &str)]) -> Result<DeriveFile, Failure> {
    let mut options = DeriveFile::default();
    for &(key, value) in wanted {
        options = options.over(read_derive_option(key, key, value).map_err(Failure::Options)?);
    }
    Ok(options)
}

/// The hull between two or more: hulls, tables, designs, meshes or CAD files. Their weights in the order of the hulls are at least 0
/// and sum to 1. With none they follow from `wanted`, keys of a job file of [`derive()`] with their values, as `("Cb", "0.62")`:
/// dimensions, and at most one target less than hulls. No figures are drawn.
///
/// # Errors
/// [`Failure::FileSystem`]; [`Failure::Input`] and [`Failure::Options`] for values that are wrong; [`Failure::Infeasible`]
/// where no weights meet the targets, with what is within reach.
pub fn blend<P: AsRef<Path>>(hulls: &[P], weights: &[f64], wanted: &[(&str, &str)]) -> Result<BlendOutputs, Failure> {
    let hulls = hulls.iter().map(|path| path.as_ref().to_owned()).collect();
    let weights = (!weights.is_empty()).then(|| weights.to_vec());
    blend_outputs(&BlendJob { hulls, weights, wanted: options(wanted)?, ..BlendJob::default() }, &[])
}

/// Two hulls, tables, designs, meshes or CAD files beside each other, each at its own draught.
///
/// # Errors
/// [`Failure::FileSystem`]; [`Failure::Input`] with every problem of the files; [`Failure::Infeasible`] of a design.
pub fn compare(first: impl AsRef<Path>, second: impl AsRef<Path>) -> Result<CompareOutputs, Failure> {
    let hulls = [first.as_ref().to_owned(), second.as_ref().to_owned()];
    compare_outputs(&CompareJob { hulls, overrides: Overrides::default(), draught: None })
}

/// Fairs one curve: a waterline, a sheer line, a curve of sectional areas. Its points stand in a file of two columns.
///
/// # Errors
/// [`Failure::FileSystem`]; [`Failure::Input`] for lines that cannot be read and points that are no curve.
pub fn fair_curve(curve: impl AsRef<Path>, settings: CurveSettings) -> Result<FairedCurve, Failure> {
    faired_curve(&CurveJob { settings, ..CurveJob::new(curve.as_ref()) })
}

/// Hydrostatics of any hull, table of offsets, mesh or CAD file, at draughts above the base line \[m\]; at about 20 round
/// draughts where none are given.
///
/// # Errors
/// [`Failure::FileSystem`]; [`Failure::Input`] with every problem of the file, or with figures that no body can have.
pub fn hydrostatics(body: impl AsRef<Path>, draughts: &[f64]) -> Result<FloatingBody, Failure> {
    let body = read_hydrostatic_body(body.as_ref())?;
    let draughts = if draughts.is_empty() { body.default_draughts()? } else { draughts.to_vec() };
    let (curves, warnings) = body.curves_of_form(&draughts, &body.conventions)?;
    Ok(FloatingBody { curves, notes: body.notes.into_iter().chain(warnings).collect() })
}

/// The hull of a result, a design, a table of offsets, a mesh or a CAD file, with notes about it.
///
/// # Errors
/// [`Failure::FileSystem`]; [`Failure::Input`] with every problem of the file; [`Failure::Infeasible`] of a design.
pub fn open(hull: impl AsRef<Path>) -> Result<Source, Failure> {
    read_source(hull.as_ref())
}

/// The curves in which planes cut a hull: stations, waterlines, buttocks, any planes.
#[must_use]
pub fn sections(hull: &Hull, cuts: &[Cut]) -> Vec<Section> {
    cuts.iter().map(|&cut| sections_of(hull, cut)).collect()
}

/// A hull in the formats of other programs, as files in memory whose names begin with `name`.
///
/// # Errors
/// [`Failure::Usage`] where a format needs a draught and the hull states none, or where a setting is out of its range.
pub fn export(hull: &Hull, name: &str, formats: &[ExportFormat]) -> Result<Exported, Failure> {
    crate::report::export(hull, name, formats, &ExportSettings::default())
}

/// Figures, pages and tables of what `generate`, `fit` or `fair` wrote to a folder.
///
/// # Errors
/// [`Failure::FileSystem`]; [`Failure::Input`] where the folder holds no result.
pub fn report(result: impl AsRef<Path>) -> Result<Vec<OutputFile>, Failure> {
    report_outputs(&read_result(result.as_ref())?, &ReportSettings::default())
}

/// Writes files to a folder, all or none of them.
///
/// # Errors
/// [`Failure::Exists`] where one of them is there already; [`Failure::FileSystem`].
pub fn write(files: &[OutputFile], folder: impl AsRef<Path>) -> Result<(), Failure> {
    Destination { folder: folder.as_ref(), inputs: &Inputs::default(), force: false }.write(files)
}

/// Writes files to a folder over those that are there.
///
/// # Errors
/// [`Failure::FileSystem`].
pub fn overwrite(files: &[OutputFile], folder: impl AsRef<Path>) -> Result<(), Failure> {
    Destination { folder: folder.as_ref(), inputs: &Inputs::default(), force: true }.write_run(files)
}
