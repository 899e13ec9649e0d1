//! Transverse metacentre at the design draught: KM_T = (int z dV + I_T) / V with I_T = (2/3) int y^3 dx on the waterline.
//!
//! int z dV + I_T - KM_T V = 0 is linear but for I_T, a cubic form of the half-breadths: I_T = g . c / 3 with its
//! gradient g_k = 2 int y^2 N_k dx. About c_0 it is I_T ~ g_0 . c - 2 I_T(c_0).

use super::super::model::Limit;
use super::equal;
use crate::hull::{Functional, Hull, transverse_inertia, transverse_inertia_gradient};

/// KM_T \[m\].
pub(super) fn height(hull: &Hull) -> f64 {
    let draught = hull.reference_height();
    let moment = Functional::VerticalMoment.value(hull, draught) + transverse_inertia(hull, draught);
    moment / Functional::Volume.value(hull, draught)
}

pub(super) fn limit(hull: &Hull, target: f64) -> Limit {
    let draught = hull.reference_height();
    let volume = Functional::Volume.row(hull, draught);
    let moment = Functional::VerticalMoment.row(hull, draught);
    let gradient = transverse_inertia_gradient(hull, draught);
    let row: Vec<f64> = moment.iter().zip(&gradient).zip(&volume).map(|((m, g), v)| m + g - target * v).collect();
    let scale = Functional::Volume.value(hull, draught) * target;
    equal(&row, 2.0 * transverse_inertia(hull, draught), scale)
}
