//! Monotone lines: dy/dx >= 0 or <= 0 along a waterline, dy/dz along a station, at five points of every span and at the
//! ends of the range.
//!
//! Rows are divided by x' or z', so that a violation is a slope. Differences of control values would be sufficient
//! everywhere, and too strong beside the ends of the range, where a control value acts on both sides of it.

use super::super::bends::Line;
use super::super::model::Limit;
use super::super::surface::FairSurface;
use super::lines::along;

pub(super) fn limits(surface: &FairSurface, line: Line, over: [f64; 2], rising: bool) -> Result<Vec<Limit>, String> {
    let (lower, upper) = if rising { (0.0, f64::INFINITY) } else { (f64::NEG_INFINITY, 0.0) };
    let bends = along(surface, line, over)?;
    let moving = bends.into_iter().filter(|bend| bend.along > 0.0);
    Ok(moving
        .map(|bend| {
            let row = bend.slope.iter().map(|&(i, value)| (i, value / bend.along)).collect();
            Limit { row, lower, upper }
        })
        .collect())
}
