//! The methods of five published systems. All make surfaces whose waterlines are level, v = constant.
//!
//! | method | order | meets the cells | needs |
//! |---|---|---|---|
//! | bilinear | 2 | all | 2 x 2 |
//! | least squares | any | none | as many lines as control points |
//! | uniform bicubic | 4 | corners, corners of knuckles | 2 x 2 |
//! | quadratic net | 3 | corners, corners of splits | 3 x 3 |
//! | parametric stations | any | none, nearly | 3 offsets a waterline with its ends |
//!
//! Limits: they need half-breadths at stations and waterlines (what the table lacks of that is filled by [`matrix`]'s
//! rules, and noted), the surface begins at the lowest waterline and ends at the highest, and knuckles, tangent lines,
//! transoms and heights of the table are not used. Cost: one banded solve a direction.

mod matrix;
mod net;
mod stations;

use super::method::{LeastSquares, ParametricStations, QuadraticNet, UniformBicubic};
use super::{FitError, Fitted};
use crate::hull::offsets::OffsetTable;
use matrix::Matrix;

/// [`super::FitMethod::Bilinear`].
pub(super) fn bilinear(table: &OffsetTable) -> Result<Fitted, FitError> {
    let matrix = Matrix::new(table, [2, 2])?;
    let surface = net::bilinear(&matrix)?;
    matrix.finish(table, surface)
}

/// [`super::FitMethod::LeastSquares`].
pub(super) fn least_squares(table: &OffsetTable, settings: &LeastSquares) -> Result<Fitted, FitError> {
    let matrix = Matrix::new(table, [2, 2])?;
    let surface = net::least_squares(&matrix, settings)?;
    matrix.finish(table, surface)
}

/// [`super::FitMethod::UniformBicubic`].
pub(super) fn uniform_bicubic(table: &OffsetTable, settings: &UniformBicubic) -> Result<Fitted, FitError> {
    let matrix = Matrix::new(table, [2, 2])?;
    let surface = net::uniform_bicubic(&matrix, settings)?;
    matrix.finish(table, surface)
}

/// [`super::FitMethod::QuadraticNet`].
pub(super) fn quadratic_net(table: &OffsetTable, settings: &QuadraticNet) -> Result<Fitted, FitError> {
    let matrix = Matrix::new(table, [3, 3])?;
    let surface = net::quadratic_net(&matrix, settings)?;
    matrix.finish(table, surface)
}

/// [`super::FitMethod::ParametricStations`].
pub(super) fn parametric_stations(table: &OffsetTable, settings: &ParametricStations) -> Result<Fitted, FitError> {
    let mut matrix = Matrix::new(table, [2, 2])?;
    let surface = stations::surface(table, &mut matrix, settings)?;
    matrix.finish(table, surface)
}
