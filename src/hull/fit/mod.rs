//! From a table of offsets to a hull: a surface through every cell, faithful where the table is silent.
//!
//! The default method works on a chart that follows the ship: see `level` for hulls whose waterlines run from profile
//! to profile, `upright` for rockered keels and chines, `skin` for tables of section outlines. Every cell with a value
//! is met to 1e-9 m unless it is marked doubtful; what had to be assumed is noted.

mod bounded;
mod chart;
mod estimate;
mod features;
mod floor;
mod level;
mod limits;
mod method;
mod methods;
mod misfit;
mod monotone;
mod outlines;
mod particulars;
mod points;
mod rows;
mod skin;
mod transom;
mod upright;

use super::cell::Entry;
use super::form::{Hull, HullError};
use super::offsets::OffsetTable;
use crate::spline::SplineError;
use crate::units::counted;
pub use estimate::{Thinned, VolumeEstimate};
pub use method::{
    FitMethod, LeastSquares, NetKnots, ParametricStations, QuadraticNet, SettingProblem, SettingProblems,
    UniformBicubic,
};
pub use misfit::Misfit;
pub use outlines::{PointResidual, only_outlines, side_points};
pub use upright::ends::{Outermost, carried_on};
pub use upright::has_rocker;

/// A cell that the table leaves open and the surface fills, or that the surface does not meet.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CellResidual {
    /// Index of the station in the table.
    pub station: usize,
    /// Index of the waterline in the table.
    pub waterline: usize,
    /// Half-breadth of the surface there \[m\].
    pub half_breadth: f64,
    /// Surface minus table \[m\]; none where the table has no value.
    pub residual: Option<f64>,
}

/// Which fixed functions x(u, v) and z(u, v) carry the half-breadths.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Chart {
    /// z = z(v): waterlines are lines of the net; x runs between the profiles.
    Level,
    /// x = x(u): stations are lines of the net; z runs between keel, knuckles and deck, or along the girth of each
    /// section.
    Upright,
}

/// What a fit comes to.
#[derive(Debug, Clone)]
pub struct Fitted {
    /// The hull.
    pub hull: Hull,
    /// The chart that was chosen.
    pub chart: Chart,
    /// Every cell with a value or to be predicted.
    pub cells: Vec<CellResidual>,
    /// What was assumed where the table says nothing (profiles, ends, deck), in words for the user.
    pub notes: Vec<String>,
}

/// Why a table does not make a hull.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum FitError {
    /// Too few lines.
    #[error(
        "{} with {}; a surface needs at least {least} of each",
        counted(*.stations, "station"),
        counted(*.waterlines, "waterline")
    )]
    TooFew {
        /// Stations with offsets.
        stations: usize,
        /// Waterlines with offsets.
        waterlines: usize,
        /// What is needed.
        least: usize,
    },
    /// The settings of the method are wrong, or do not go with the table: every problem.
    #[error(transparent)]
    #[doc(hidden)]
    Settings(#[from] SettingProblems),
    /// The surface is no hull.
    #[error(transparent)]
    Hull(#[from] HullError),
}

impl From<SplineError> for FitError {
    fn from(error: SplineError) -> Self {
        Self::Hull(HullError::from(error))
    }
}

impl Hull {
    /// The hull of a table.
    ///
    /// # Errors
    /// [`FitError`] when the table has too few offsets, or they make no hull.
    pub fn fit(table: &OffsetTable, method: &FitMethod) -> Result<Fitted, FitError> {
        match method {
            FitMethod::Graded => graded(table),
            FitMethod::Bilinear => methods::bilinear(table),
            FitMethod::LeastSquares(settings) => methods::least_squares(table, settings),
            FitMethod::UniformBicubic(settings) => methods::uniform_bicubic(table, settings),
            FitMethod::QuadraticNet(settings) => methods::quadratic_net(table, settings),
            FitMethod::ParametricStations(settings) => methods::parametric_stations(table, settings),
        }
    }
}

/// The default method.
fn graded(table: &OffsetTable) -> Result<Fitted, FitError> {
    let mut fitted = if outlines::only_outlines(table) {
        sections(table)?
    } else if upright::suits(table) {
        upright::fit(table)?
    } else {
        let (hull, mut notes) = level::loft(table, rows::prepare(table)?)?;
        let hull = points::follow(table, hull, &mut notes)?;
        let cells = residuals(table, &hull);
        Fitted { hull, chart: Chart::Level, cells, notes }
    };
    fitted.notes.extend(features::not_held(table, fitted.chart));
    Ok(fitted)
}

/// Tables of section outlines: with their knuckles as lines of the net where there are any, else, and where these make
/// no hull, or sections have level or falling parts above the bottom, from section to section by girth.
fn sections(table: &OffsetTable) -> Result<Fitted, FitError> {
    if !upright::has_knuckles(table) {
        return skin::fit(table);
    }
    if upright::profile::has_ledges(table) {
        let mut fitted = skin::fit(table)?;
        let note = "sections have level or falling parts above the bottom: knuckles are corners of the sections only";
        fitted.notes.insert(0, note.to_owned());
        return Ok(fitted);
    }
    match upright::fit(table) {
        Err(FitError::Hull(error)) => {
            let mut fitted = skin::fit(table)?;
            fitted.notes.insert(
                0,
                format!(
                    "knuckles as lines of the net make no hull here ({error}); they are corners of the sections only"
                ),
            );
            Ok(fitted)
        }
        done => done,
    }
}

/// Every cell with a value or to be predicted, as the surface has it.
fn residuals(table: &OffsetTable, hull: &Hull) -> Vec<CellResidual> {
    let mut cells = Vec::new();
    for (station, column) in table.stations.iter().enumerate() {
        for (waterline, (cell, &z)) in column.half_breadths.iter().zip(&table.waterlines).enumerate() {
            if matches!(cell.entry, Entry::Absent) {
                continue;
            }
            let Some(half_breadth) = hull.half_breadth(column.station.x, z) else { continue };
            let residual = cell.value().map(|y| half_breadth - y);
            cells.push(CellResidual { station, waterline, half_breadth, residual });
        }
    }
    cells
}
