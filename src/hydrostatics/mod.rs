//! Hydrostatics of the upright hull: the quantities of a floating condition, their list, and tables over draughts.

mod charted;
mod conventions;
mod draughts;
mod expansion;
mod halves;
mod node;
mod piece;
mod quantity;
mod row;
mod sections;
mod skin;
mod station;
mod table;
mod triangles;
mod volume;
mod waterplane;

pub use conventions::{
    Assumed, CoefficientLength, Conventions, DENSITIES, GRAVITY_HEIGHTS, Given, LcbReference, PrismaticSection,
    SHELL_FACTORS, SHELL_THICKNESSES, Shell, Statement, assumed_mark,
};
pub use draughts::default_draughts;
pub use quantity::{QUANTITIES, Quantity};
pub use row::{Hydrostatics, LEAST_GM};
pub use skin::{wetted_surface, wetted_surface_gradient};
pub use table::CurvesOfForm;
pub use triangles::closure::{Unclosed, unclosed};
