//! A sign of curvature over a part of a station or a waterline: the numerator of curvature is linear in the net (see
//! [`super::super::bends`]), so that its sign is imposed without approximation at five points of every span and at the
//! ends of the range.
//!
//! Convex is full as seen from outside, x' y'' - x'' y' <= 0; concave is hollow.

use super::super::bends::Line;
use super::super::model::Limit;
use super::super::surface::FairSurface;
use super::lines::along;

pub(super) fn limits(surface: &FairSurface, line: Line, over: [f64; 2], convex: bool) -> Result<Vec<Limit>, String> {
    Ok(along(surface, line, over)?.iter().filter_map(|bend| bend.limit(!convex, &surface.start, 0.0)).collect())
}
