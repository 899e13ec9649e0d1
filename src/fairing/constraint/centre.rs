//! Centre of buoyancy: int x dV - x_B V = 0 is linear in the net for a given x_B, and so is int z dV - KB V = 0.

use super::super::model::Limit;
use super::centred;
use crate::hull::{Functional, Hull};

fn ratio(hull: &Hull, moment: Functional) -> f64 {
    let draught = hull.particulars().draught;
    moment.value(hull, draught) / Functional::Volume.value(hull, draught)
}

pub(super) fn longitudinal(hull: &Hull) -> f64 {
    ratio(hull, Functional::LongitudinalMoment)
}

pub(super) fn vertical(hull: &Hull) -> f64 {
    ratio(hull, Functional::VerticalMoment)
}

fn limit(hull: &Hull, moment: Functional, target: f64, length: f64) -> Limit {
    let draught = hull.particulars().draught;
    let volume = Functional::Volume.row(hull, draught);
    let scale = Functional::Volume.value(hull, draught) * length;
    centred(&moment.row(hull, draught), &volume, target, scale)
}

pub(super) fn longitudinal_limit(hull: &Hull, target: f64) -> Limit {
    limit(hull, Functional::LongitudinalMoment, target, hull.particulars().length_between_perpendiculars)
}

pub(super) fn vertical_limit(hull: &Hull, target: f64) -> Limit {
    limit(hull, Functional::VerticalMoment, target, hull.particulars().draught)
}
