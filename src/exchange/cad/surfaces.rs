//! The surfaces of a CAD file, without what trims them.

use super::super::fault::Faults;
use crate::spline::{BsplineSurface, KnotVector};

/// Most control points of a file.
pub(super) const MOST_POINTS: usize = 2_000_000;

/// The B-spline surfaces of a file.
#[derive(Debug, Clone, Default)]
pub(in super::super) struct CadSurfaces {
    /// Control points (w x, w y, w z, w) in the unit of the file.
    pub(in super::super) surfaces: Vec<BsplineSurface<4>>,
    /// Metres in the unit of the file, where it is stated.
    pub(in super::super) unit: Option<f64>,
    /// What of the file is not used, in words.
    pub(in super::super) notes: Vec<String>,
}

/// A surface of knots, weights and points, in the order u slowest; none, with a fault, when they do not fit together.
pub(super) fn surface(
    faults: &mut Faults,
    line: Option<usize>,
    name: &str,
    degrees: [usize; 2],
    knots: [Vec<f64>; 2],
    net: impl Iterator<Item = (f64, [f64; 3])>,
) -> Option<BsplineSurface<4>> {
    let [u, v] = knots;
    let mut positive = true;
    let points = net
        .map(|(w, [x, y, z])| {
            positive &= w > 0.0 && w.is_finite();
            [w * x, w * y, w * z, w]
        })
        .collect();
    if !positive {
        faults.add(line, name, "a weight that is not larger than 0".to_owned());
        return None;
    }
    let made = KnotVector::new(degrees[0], snapped(u))
        .and_then(|u| Ok((u, KnotVector::new(degrees[1], snapped(v))?)))
        .and_then(|(u, v)| BsplineSurface::new(u, v, points));
    made.map_err(|error| faults.add(line, name, error.to_string())).ok()
}

/// Knots that differ by rounding of their text are one.
fn snapped(mut knots: Vec<f64>) -> Vec<f64> {
    let slack = knots.first().zip(knots.last()).map_or(0.0, |(a, b)| 1e-10 * (b - a).abs());
    for k in 1..knots.len() {
        if (knots[k] - knots[k - 1]).abs() <= slack {
            knots[k] = knots[k - 1];
        }
    }
    knots
}
