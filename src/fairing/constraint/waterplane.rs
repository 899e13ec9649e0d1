//! Waterplane area A_W = 2 int y dx at the design draught, C_WP = A_W / (L_PP B), and its centre LCF.

use super::super::model::Limit;
use super::{centred, equal};
use crate::hull::{Functional, Hull};

pub(super) fn area(hull: &Hull) -> f64 {
    Functional::WaterplaneArea.value(hull, hull.reference_height())
}

/// L_PP B \[m^2\].
fn rectangle(hull: &Hull) -> f64 {
    hull.particulars().length_between_perpendiculars * hull.particulars().breadth
}

pub(super) fn coefficient(hull: &Hull) -> f64 {
    area(hull) / rectangle(hull)
}

pub(super) fn centre(hull: &Hull) -> f64 {
    Functional::WaterplaneMoment.value(hull, hull.reference_height()) / area(hull)
}

pub(super) fn area_limit(hull: &Hull, target: f64) -> Limit {
    equal(&Functional::WaterplaneArea.row(hull, hull.reference_height()), target, target)
}

pub(super) fn coefficient_limit(hull: &Hull, target: f64) -> Limit {
    area_limit(hull, target * rectangle(hull))
}

pub(super) fn centre_limit(hull: &Hull, target: f64) -> Limit {
    let draught = hull.reference_height();
    let size = Functional::WaterplaneArea.row(hull, draught);
    let scale = area(hull) * hull.particulars().length_between_perpendiculars;
    centred(&Functional::WaterplaneMoment.row(hull, draught), &size, target, scale)
}
