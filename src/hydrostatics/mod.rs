//! Hydrostatics of the upright hull: the quantities of a floating condition, their list, and tables over draughts.

mod conventions;
mod draughts;
mod quantity;
mod table;

pub use draughts::default_draughts;
pub use conventions::{CoefficientLength, Conventions, PrismaticSection, Shell};
pub use quantity::{Hydrostatics, QUANTITIES, Quantity};
pub use table::CurvesOfForm;
