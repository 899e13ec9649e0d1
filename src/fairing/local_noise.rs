//! The noise about each offset, and what a field may pass the centreplane by.

use super::field::likelihood::ALLOWED;
use super::model::Reading;
use super::smoothing::Smoothed;
use super::surface::{FairSurface, Origin, Place};
use crate::hull::Hull;
use std::collections::BTreeSet;

/// Stations and waterlines to each side over which the noise is taken.
const AROUND: usize = 2;

/// Readings that the noise of the whole table counts as.
const PRIOR: f64 = 4.0;

/// Least 1 - h of a reading.
pub(super) const LEAST_FREEDOM: f64 = 0.05;

/// What a field of this noise \[m\] may pass the centreplane by \[m\].
pub(super) fn below_centreplane(sigma: f64, hull: &Hull) -> f64 {
    (ALLOWED[0] * sigma).max(ALLOWED[1] * hull.particulars().breadth)
}

/// The noise \[m\] about each reading of a field, normal to the hull: the mean of w r^2 / (1 - h) + w b^2 over the
/// readings at most [`AROUND`] stations and waterlines away, with `sigma` counting as [`PRIOR`] readings more. Here b is what
/// the line of an offset is too wide by, and r the residual without it.
pub(super) fn local_noise(surface: &FairSurface, smoothed: &Smoothed, sigma: f64) -> Vec<f64> {
    let square = |k: usize| {
        let Reading { weight, shared, .. } = surface.model.readings[k];
        let own = smoothed.residuals[k].powi(2) / (1.0 - smoothed.leverages[k]).max(LEAST_FREEDOM);
        weight * (own + shared * shared)
    };
    let stations: BTreeSet<usize> = surface.places.iter().map(|place| place.origin.station()).collect();
    let height = surface.hull.top() - surface.hull.bottom();
    // Of points of sections their mean distance stands for that of waterlines.
    let apart = height * stations.len() as f64 / surface.places.len().max(1) as f64;
    let is_near = |place: &Place, other: &Place| {
        let beside = match (place.origin.waterline(), other.origin.waterline()) {
            (Some(own), Some(other)) => own.abs_diff(other) <= AROUND,
            (None, None) => (place.z - other.z).abs() <= AROUND as f64 * apart,
            _ => true,
        };
        beside && place.origin.station().abs_diff(other.origin.station()) <= AROUND
    };
    let is_offset = |place: &Place| !matches!(place.origin, Origin::Deck { .. });
    let squares: Vec<(&Place, f64)> = surface
        .places
        .iter()
        .enumerate()
        .filter(|(_, place)| is_offset(place))
        .map(|(k, place)| (place, square(k)))
        .collect();
    let noise = |place: &Place| {
        let near = squares.iter().filter(|(other, _)| is_near(place, other));
        let (count, sum) = near.fold((PRIOR, PRIOR * sigma * sigma), |(n, s), (_, square)| (n + 1.0, s + square));
        (sum / count).sqrt()
    };
    surface.places.iter().map(noise).collect()
}
