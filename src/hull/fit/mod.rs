//! From a table of offsets to a hull.

mod method;
mod upright;

use super::form::{Hull, HullError};
use super::offsets::OffsetTable;
pub use method::FitMethod;

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
    /// x = x(u): stations are lines of the net; z runs between keel, knuckles and deck.
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
    #[error("{stations} stations with {waterlines} waterlines; a surface needs at least {least} of each")]
    TooFew {
        /// Stations with offsets.
        stations: usize,
        /// Waterlines with offsets.
        waterlines: usize,
        /// What is needed.
        least: usize,
    },
    /// The surface is no hull.
    #[error(transparent)]
    Hull(#[from] HullError),
}

impl Hull {
    /// The hull of a table.
    ///
    /// # Errors
    /// [`FitError`] when the table has too few offsets, or they make no hull.
    pub fn fit(table: &OffsetTable, method: &FitMethod) -> Result<Fitted, FitError> {
        let _ = method;
        if upright::suits(table) {
            return upright::fit(table);
        }
        Err(FitError::TooFew { stations: table.stations.len(), waterlines: table.waterlines.len(), least: 2 })
    }
}
