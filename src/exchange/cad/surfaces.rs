//! The surfaces of a CAD file, without what trims them.

use super::super::fault::Faults;
use crate::hull::Brep;
use crate::spline::{BsplineCurve, BsplineSurface};

/// Most control points of a file.
pub(super) const MOST_POINTS: usize = 2_000_000;

/// The B-spline surfaces of a file.
#[derive(Debug, Clone, Default)]
pub(in super::super) struct CadSurfaces {
    /// Control points (w x, w y, w z, w) in the unit of the file.
    pub(in super::super) surfaces: Vec<BsplineSurface<4>>,
    /// Metres in the unit of the file, where it is stated.
    pub(in super::super) unit: Option<f64>,
    /// Curves, of a file without surfaces.
    pub(in super::super) curves: Vec<CadCurve>,
    /// What of the file is not used, in words.
    pub(in super::super) notes: Vec<String>,
    /// The faces, of a file that says what is inside and outside of its surfaces.
    pub(in super::super) body: Brep,
    /// Faces that cannot be read.
    pub(in super::super) unread: Vec<Unread>,
}

/// A face that cannot be read.
#[derive(Debug, Clone, Default)]
pub(in super::super) struct Unread {
    /// Line where it stands.
    pub(in super::super) line: Option<usize>,
    /// How the file calls it.
    pub(in super::super) name: String,
    /// The kind of its surface.
    pub(in super::super) kind: String,
    /// Why.
    pub(in super::super) why: String,
}

/// A curve of a file as points, in the unit of the file.
#[derive(Debug, Clone, Default)]
pub(in super::super) struct CadCurve {
    /// Line where it stands.
    pub(in super::super) line: usize,
    /// Points in turn, knots among them.
    pub(in super::super) points: Vec<[f64; 3]>,
    /// Its layer; empty where the format has none.
    pub(in super::super) layer: String,
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
    let made = BsplineSurface::clamped(degrees, [snapped(u), snapped(v)], points);
    made.map_err(|error| faults.add(line, name, error.to_string())).ok()
}

/// Parts of a span of the knots of a curve.
const PARTS: usize = 8;

/// A curve of knots, weights and points; none, with a fault, when they do not fit together.
pub(super) fn spline_curve(
    faults: &mut Faults,
    line: usize,
    name: &str,
    degree: usize,
    knots: Vec<f64>,
    net: impl Iterator<Item = (f64, [f64; 3])>,
) -> Option<BsplineCurve<4>> {
    let points: Vec<[f64; 4]> = net.map(|(w, [x, y, z])| [w * x, w * y, w * z, w]).collect();
    if !points.iter().all(|point| point[3] > 0.0 && point[3].is_finite()) {
        faults.add(Some(line), name, "a weight that is not larger than 0".to_owned());
        return None;
    }
    let made = BsplineCurve::clamped(degree, snapped(knots), points);
    made.map_err(|error| faults.add(Some(line), name, error.to_string())).ok()
}

/// The points of a curve between two of its parameters.
pub(super) fn points_of(line: usize, curve: &BsplineCurve<4>, [from, to]: [f64; 2]) -> CadCurve {
    let (a, b) = curve.knots().domain();
    let [from, to] = if from < to { [from.clamp(a, b), to.clamp(a, b)] } else { [a, b] };
    let breaks = curve.knots().breakpoints();
    let inner = breaks.windows(2).flat_map(|w| (0..PARTS).map(move |k| w[0] + (w[1] - w[0]) * k as f64 / PARTS as f64));
    let sites = std::iter::once(from).chain(inner.filter(|&t| from < t && t < to)).chain([to]);
    let points = sites.map(|t| {
        let [x, y, z, w] = curve.eval(t);
        [x / w, y / w, z / w]
    });
    CadCurve { line, points: points.collect(), ..CadCurve::default() }
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
