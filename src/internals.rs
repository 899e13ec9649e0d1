//! Every floor with all that is `pub` in it, for the binary, tests, benches and fuzz targets. It is no part of the public
//! face: anything here may change with any version.
#![allow(missing_docs, reason = "each floor says what it is")]

#[cfg(feature = "cli")]
pub mod cli {
    pub use crate::cli::*;
}
pub mod config {
    pub use crate::config::*;
}
pub mod derivation {
    pub use crate::derivation::*;
}
pub mod exchange {
    pub use crate::exchange::*;
}
pub mod fairing {
    pub use crate::fairing::*;
}
pub mod hull {
    pub use crate::hull::*;
}
pub mod hydrostatics {
    pub use crate::hydrostatics::*;
}
pub mod numeric {
    pub use crate::numeric::*;
}
pub mod parametric {
    pub use crate::parametric::*;
}
pub mod plot {
    pub use crate::plot::*;
}
pub mod qp {
    pub use crate::qp::*;
}
pub mod report {
    pub use crate::report::*;
}
pub mod resistance {
    pub use crate::resistance::*;
}
pub mod spline {
    pub use crate::spline::*;
}
pub mod units {
    pub use crate::units::*;
}
