//! Displacement and block coefficient: nabla = 2 int int y dz dx below the design draught, C_B = nabla / (L_PP B T); and the
//! volume below any height.

use super::super::model::Limit;
use super::equal;
use crate::hull::{Functional, Hull};

pub(super) fn volume(hull: &Hull, below: f64) -> f64 {
    Functional::Volume.value(hull, below)
}

/// L_PP B T \[m^3\].
fn block_of(hull: &Hull) -> f64 {
    let p = hull.particulars();
    p.length_between_perpendiculars * p.breadth * hull.reference_height()
}

pub(super) fn block_coefficient(hull: &Hull) -> f64 {
    volume(hull, hull.reference_height()) / block_of(hull)
}

pub(super) fn limit(hull: &Hull, below: f64, target: f64) -> Limit {
    equal(&Functional::Volume.row(hull, below), target, target)
}

pub(super) fn block(hull: &Hull, target: f64) -> Limit {
    limit(hull, hull.reference_height(), target * block_of(hull))
}
