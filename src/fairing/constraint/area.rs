//! Areas of sections A(x) = 2 int y dz below the design draught, and C_M = A(L_PP/2) / (B T).

use super::super::model::Limit;
use super::{compressed, equal};
use crate::hull::{Functional, Hull};

pub(super) fn section(hull: &Hull, x: f64) -> f64 {
    Functional::SectionArea { x }.value(hull, hull.reference_height())
}

fn midship(hull: &Hull) -> (f64, f64) {
    let p = hull.particulars();
    (0.5 * p.length_between_perpendiculars, p.breadth * hull.reference_height())
}

pub(super) fn midship_coefficient(hull: &Hull) -> f64 {
    let (x, rectangle) = midship(hull);
    section(hull, x) / rectangle
}

pub(super) fn midship_limit(hull: &Hull, target: f64) -> Limit {
    let (x, rectangle) = midship(hull);
    let row = Functional::SectionArea { x }.row(hull, hull.reference_height());
    equal(&row, target * rectangle, rectangle)
}

pub(super) fn section_limit(hull: &Hull, x: f64, area: f64, band: f64) -> Limit {
    let scale = midship(hull).1;
    let row = compressed(&Functional::SectionArea { x }.row(hull, hull.reference_height()), 1.0 / scale);
    Limit { row, lower: (area - band) / scale, upper: (area + band) / scale }
}
