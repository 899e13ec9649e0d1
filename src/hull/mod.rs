//! The naval nouns: frame, particulars, the hull as a half-breadth surface, its sections, areas, offsets and linear functionals.
//!
//! Frame (right-handed): x forward from the aft perpendicular AP, y to port, z up from the moulded base line; metres.

mod form;
mod particulars;

pub use form::{Hull, HullError};
pub use particulars::PrincipalParticulars;
