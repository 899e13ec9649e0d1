//! From a parent to the hull that is wanted: other dimensions, coefficients and centres, all of them exact.
//!
//! [`scaled`] brings the parent to the dimensions. [`derive()`] then meets the targets by a method ([`Method`]): sections that
//! are shifted along the ship (one minus prismatic, Lackenby 1950), or the hull nearest to the scaled parent, found by a
//! convex quadratic program over the half-breadths. Targets are met to rounding; what is infeasible is refused with the
//! intervals that are within reach. [`blend()`] mixes two or more hulls by weights, which are given or follow from targets.

mod affine;
mod bending;
mod blend;
mod classical;
mod derive;
mod ending;
mod infeasible;
mod inflections;
mod lackenby;
mod limits;
mod moved;
mod nearest;
mod parallel;
mod pool;
mod quantity;
mod refusal;
mod request;
mod shift;
mod trade;

pub use affine::scaled;
pub use blend::{Blend, BlendRequest, BlendTarget, BlendedHull, Dimension, blend};
pub use derive::{Derived, Reached, derive};
pub use inflections::{counted_planes, inflections, is_about_as_fair};
pub use lackenby::{HalfBody, ShiftLimit, changes_of_halves};
pub use limits::Interval;
pub use nearest::BindingLimits;
pub use quantity::{Quantity, Reference, value_of};
pub use refusal::Refusal;
pub use request::{Dimensions, Method, Origin, Request, Target};
pub use shift::LEVEL_FOLD;

#[cfg(test)]
mod samples {
    use crate::hull::Hull;
    use crate::parametric::ShipType;
    use crate::parametric::analytic::{Dimensions, wigley};
    use crate::parametric::cosh::{DesignTargets, generate};

    pub(super) fn tug() -> Hull {
        let requested = DesignTargets {
            ship_type: Some(ShipType::Tug),
            length: 28.0,
            breadth: Some(9.0),
            draught: Some(3.6),
            depth: Some(4.8),
            ..DesignTargets::default()
        };
        generate("tug", &requested).unwrap().hull
    }

    pub(super) fn parabolic() -> Hull {
        let dimensions = Dimensions { length: 100.0, breadth: 10.0, draught: 6.25, depth: 9.0 };
        wigley("Wigley", &dimensions).unwrap().hull
    }
}
