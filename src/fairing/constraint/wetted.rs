//! Wetted surface S at the design draught, about a hull c_0: S ~ S(c_0) + g_0 . (c - c_0).

use super::super::model::Limit;
use super::equal;
use crate::hull::Hull;
use crate::hydrostatics::{wetted_surface, wetted_surface_gradient};

/// S \[m^2\].
pub(super) fn surface(hull: &Hull) -> f64 {
    wetted_surface(hull, hull.reference_height())
}

pub(super) fn limit(hull: &Hull, target: f64) -> Limit {
    let gradient = wetted_surface_gradient(hull, hull.reference_height());
    let along: f64 = gradient.iter().zip(hull.surface().points()).map(|(g, p)| g * p[1]).sum();
    equal(&gradient, target - surface(hull) + along, target)
}
