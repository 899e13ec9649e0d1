//! loftsman: the shape of ships.
pub mod hull;
pub mod hydrostatics;
pub mod numeric;
pub mod parametric;
pub mod plot;
pub mod spline;
