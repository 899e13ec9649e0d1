//! Inflections of the stations and waterlines of a hull, before and after.

use crate::fairing::inspect::{Planes, Resolution, Traced};
use crate::hull::{Hull, StationNumbers, default_stations, default_waterlines};

/// The stations and waterlines on which inflections of a hull and of those like it are counted.
#[must_use]
pub fn counted_planes(hull: &Hull, numbers: StationNumbers) -> Planes {
    Planes {
        stations: default_stations(hull, numbers).into_iter().map(|station| station.x).collect(),
        waterlines: default_waterlines(hull),
        ..Planes::default()
    }
}

/// Whether a hull has at most one and a half times the inflections before, and two.
#[must_use]
pub fn is_about_as_fair(before: usize, after: usize) -> bool {
    2 * after <= 3 * before + 4
}

/// Changes of the sign of curvature along these planes that can be seen on a drawing.
#[must_use]
pub fn inflections(hull: &Hull, planes: &Planes) -> usize {
    let band = Resolution::for_length(hull.particulars().length_between_perpendiculars).tolerance();
    Traced::new(hull, planes).counts(band).iter().map(|(_, counts)| counts.inflections).sum()
}
