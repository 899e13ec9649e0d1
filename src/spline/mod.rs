//! B-spline kernel: knots, basis, curves, surfaces, fitting, exact integrals. It knows no ship.
//!
//! Conventions: degree 1 to [`MAX_DEGREE`], clamped knots (both ends `degree + 1` fold), interior multiplicities up to
//! `degree` (a multiplicity of `degree` is a corner, `degree - 1` a jump of curvature). Functions are continuous from the
//! right; the last span is closed. Arguments outside the domain are taken to its nearest end.

mod basis;
mod bezier;
mod curve;
mod evaluate;
mod fit;
mod knots;
mod refine;
mod surface;
mod table;

pub use bezier::{BezierCurve, BezierPatch};
pub use curve::BsplineCurve;
pub use evaluate::{SurfaceJet, SurfaceTangents};
pub use fit::{Collocation, Condition};
pub use knots::{KnotVector, MAX_DEGREE, SplineError};
pub use surface::BsplineSurface;

#[cfg(test)]
mod tests;
