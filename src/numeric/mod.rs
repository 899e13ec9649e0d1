//! Mathematics that knows no geometry: quadrature, bracketed roots, banded systems.

mod banded;
mod quadrature;
mod root;

pub use banded::{BandedLu, SingularMatrix};
pub use quadrature::{GaussRule, gauss_legendre};
pub use root::{RootError, bracketed_root};
