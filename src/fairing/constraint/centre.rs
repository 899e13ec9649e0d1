//! Centre of buoyancy: int x dV - x_B V = 0 is linear in the net for a given x_B, and so is int z dV - KB V = 0.

use super::super::model::Limit;
use super::centred;
use crate::hull::{Functional, Hull};

fn ratio(hull: &Hull, moment: Functional, below: f64) -> f64 {
    moment.value(hull, below) / Functional::Volume.value(hull, below)
}

pub(super) fn longitudinal(hull: &Hull, below: f64) -> f64 {
    ratio(hull, Functional::LongitudinalMoment, below)
}

pub(super) fn vertical(hull: &Hull) -> f64 {
    ratio(hull, Functional::VerticalMoment, hull.reference_height())
}

fn limit(hull: &Hull, moment: Functional, below: f64, target: f64, length: f64) -> Limit {
    let volume = Functional::Volume.row(hull, below);
    let scale = Functional::Volume.value(hull, below) * length;
    centred(&moment.row(hull, below), &volume, target, scale)
}

pub(super) fn longitudinal_limit(hull: &Hull, below: f64, target: f64) -> Limit {
    let length = hull.particulars().length_between_perpendiculars;
    limit(hull, Functional::LongitudinalMoment, below, target, length)
}

pub(super) fn vertical_limit(hull: &Hull, target: f64) -> Limit {
    let below = hull.reference_height();
    limit(hull, Functional::VerticalMoment, below, target, below)
}
