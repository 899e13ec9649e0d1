//! Displacement and block coefficient: nabla = 2 int int y dz dx below the design draught, C_B = nabla / (L_PP B T).

use super::super::model::Limit;
use super::equal;
use crate::hull::{Functional, Hull};

pub(super) fn volume(hull: &Hull) -> f64 {
    Functional::Volume.value(hull, hull.particulars().draught)
}

/// L_PP B T \[m^3\].
fn block_of(hull: &Hull) -> f64 {
    let p = hull.particulars();
    p.length_between_perpendiculars * p.breadth * p.draught
}

pub(super) fn block_coefficient(hull: &Hull) -> f64 {
    volume(hull) / block_of(hull)
}

pub(super) fn displacement(hull: &Hull, target: f64) -> Limit {
    equal(&Functional::Volume.row(hull, hull.particulars().draught), target, target)
}

pub(super) fn block(hull: &Hull, target: f64) -> Limit {
    displacement(hull, target * block_of(hull))
}
