//! Mathematics that knows no geometry: quadrature, bracketed roots, banded systems, least squares, the median,
//! spherical Bessel functions, two threads.

mod banded;
mod cholesky;
pub(crate) mod dense;
mod least_squares;
mod median;
mod quadrature;
mod root;
mod spherical;
mod threads;

pub use banded::{BandedLu, SingularMatrix};
pub use cholesky::{BandedCholesky, SymmetricBand};
pub use least_squares::BandedLeastSquares;
pub use median::median;
pub use quadrature::{GaussRule, gauss_legendre, trapezoids};
pub use root::{RootError, bracketed_root};
pub use spherical::{scaled_spherical_i, spherical_j};
pub use threads::join;
