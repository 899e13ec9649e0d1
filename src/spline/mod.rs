//! B-spline kernel: knots, basis, curves, surfaces, refinement, fitting, exact integrals, curvature. It knows no ship.
//!
//! Conventions: degree 1 to [`MAX_DEGREE`] ([`HIGHEST_DEGREE`] where splines are only evaluated, cut and clamped), clamped knots (both ends `degree + 1` fold), interior multiplicities up to
//! `degree` (a multiplicity of `degree` is a corner, `degree - 1` a jump of curvature). Functions are continuous from
//! the right; the last span is closed. Arguments outside the domain are taken to its nearest end. Nets are stored `u`
//! slowest. Signs of curvature: a planar curve that turns left is positive; a surface that bends towards S_u x S_v is
//! positive.
//!
//! Evaluation finds its span in constant time; [`BsplineSurface::grid_jets`] is for grids. Refinement
//! keeps shapes to rounding (1e-13 of their size in the tests), integrals are exact to rounding.

mod basis;
mod bezier;
mod curvature;
mod curve;
mod energy;
mod evaluate;
mod fit;
mod gram;
mod grid;
mod jet;
mod knots;
mod least_squares;
mod net;
mod parametrize;
mod periodic;
mod powers;
mod refine;
mod surface;
mod table;
mod vector;
mod vertices;

pub use basis::{HIGHEST_DEGREE, MAX_DEGREE};
pub use bezier::{BezierCurve, BezierPatch};
pub use curvature::SurfaceCurvature;
pub use curve::BsplineCurve;
pub use energy::{Energy, MinimumEnergy};
pub use evaluate::SurfaceTangents;
pub use fit::{Collocation, Condition};
pub use gram::Gram;
pub use jet::SurfaceJet;
pub use knots::{KnotVector, SplineError};
pub use least_squares::Ends;
pub use net::{add_product, basis_row, binomial, energy};
pub use parametrize::Parametrization;
pub use periodic::PeriodicCollocation;
pub use surface::BsplineSurface;
pub(crate) use vector::{cross, dot, length, minus};

#[cfg(test)]
mod tests;
