//! Analytic test bodies: Wigley hull, box, ellipsoid.

use super::{Generated, Infeasible};

/// Main dimensions of a test body [m].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Dimensions {
    /// L.
    pub length: f64,
    /// B.
    pub breadth: f64,
    /// T.
    pub draught: f64,
    /// D, at least T.
    pub depth: f64,
}

/// y = (B/2) (1 - (2x/L)^2) (1 - (z/T)^2), wall-sided above the waterline.
///
/// # Errors
/// Dimensions outside their ranges.
pub fn wigley(name: &str, dimensions: &Dimensions) -> Result<Generated, Vec<Infeasible>> {
    let _ = (name, dimensions);
    Err(Vec::new())
}

/// A rectangular box.
///
/// # Errors
/// Dimensions outside their ranges.
pub fn rectangular_box(name: &str, dimensions: &Dimensions) -> Result<Generated, Vec<Infeasible>> {
    let _ = (name, dimensions);
    Err(Vec::new())
}

/// An ellipsoid with semi-axes L/2, B/2 and T, its centre at the design waterline; D at most 2 T.
///
/// # Errors
/// Dimensions outside their ranges.
pub fn ellipsoid(name: &str, dimensions: &Dimensions) -> Result<Generated, Vec<Infeasible>> {
    let _ = (name, dimensions);
    Err(Vec::new())
}
