//! The surfaces of a CAD file, without what trims them.

use super::super::fault::Faults;
use crate::hull::{Brep, BrepEdge, BrepFace, FaceSurface, SpaceCurve};
use crate::spline::{BsplineCurve, BsplineSurface, length, minus};

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

/// What chords leave a curve by at most, over its size.
pub(super) const CHORD: f64 = 1e-5;

/// Chords of a span of a spline, from and to.
const CHORDS: [usize; 2] = [4, 256];

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

/// Points of a spline: chords of a span are doubled until they leave it by little.
pub(in super::super) fn sampled(curve: &BsplineCurve<4>) -> Vec<[f64; 3]> {
    let net = || curve.points().iter().map(|[x, y, z, w]| [x / w, y / w, z / w]);
    let extent = |k: usize| {
        let ends = net().fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], p| [a.min(p[k]), b.max(p[k])]);
        ends[1] - ends[0]
    };
    let slack = CHORD * (0..3).map(extent).fold(0.0, f64::max);
    let at = |t: f64| {
        let [x, y, z, w] = curve.eval(t);
        [x / w, y / w, z / w]
    };
    let breaks = curve.knots().breakpoints();
    let most = (MOST_POINTS / 8 / breaks.len()).clamp(CHORDS[0], CHORDS[1]);
    let mut points = vec![at(breaks[0])];
    for span in breaks.windows(2) {
        let place = |k: usize, count: usize| at(span[0] + (span[1] - span[0]) * k as f64 / count as f64);
        let mut count = CHORDS[0];
        let mut chords: Vec<[f64; 3]> = (0..=count).map(|k| place(k, count)).collect();
        while 2 * count <= most {
            let finer: Vec<[f64; 3]> = (0..=2 * count)
                .map(|k| if k.is_multiple_of(2) { chords[k / 2] } else { place(k, 2 * count) })
                .collect();
            let off = finer.windows(3).step_by(2).map(|w| {
                let middle = [0, 1, 2].map(|k| 0.5 * (w[0][k] + w[2][k]));
                length(minus(w[1], middle))
            });
            let off = off.fold(0.0, f64::max);
            (chords, count) = (finer, 2 * count);
            // The error of chords falls by four.
            if off <= 4.0 * slack {
                break;
            }
        }
        points.extend(&chords[1..]);
    }
    points
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

/// Points nearer to each other than this part of the size of a surface are one.
const CLOSED: f64 = 1e-6;

/// Whether two opposite sides of a surface are one line, its seam. Without one it would be cut open there.
pub(in super::super) fn is_closed(surface: &BsplineSurface<4>) -> bool {
    let [us, vs]: [[f64; 2]; 2] = [surface.u(), surface.v()].map(|knots| knots.domain().into());
    let shares = [0.0, 0.2, 0.5, 0.7, 1.0];
    let on = |[a, b]: [f64; 2], share: f64| a + share * (b - a);
    let at = |u: f64, v: f64| {
        let [x, y, z, w] = surface.eval(u, v);
        [x / w, y / w, z / w]
    };
    let side = |axis: usize, end: usize| {
        shares.map(|share| if axis == 0 { at(us[end], on(vs, share)) } else { at(on(us, share), vs[end]) })
    };
    let size = length(minus(at(us[0], vs[0]), at(on(us, 0.5), on(vs, 0.5))));
    let near = |a: &[f64; 3], b: &[f64; 3]| length(minus(*a, *b)) <= CLOSED * size;
    [0, 1].into_iter().any(|axis| {
        let [from, to] = [side(axis, 0), side(axis, 1)];
        from.iter().zip(&to).all(|(a, b)| near(a, b))
    })
}

/// Adds a surface inside its four sides to a body; none where it has none.
pub(in super::super) fn whole(
    surface: &FaceSurface,
    [[a, b], [c, d]]: [[f64; 2]; 2],
    kind: &str,
    body: &mut Brep,
) -> Option<()> {
    let sides = [(1, c, [a, b]), (0, b, [c, d]), (1, d, [b, a]), (0, a, [d, c])];
    let mut ring = Vec::new();
    for (axis, value, ends) in sides {
        let (curve, range) = match surface {
            FaceSurface::Plane { .. } => {
                let [from, to] = ends.map(|t| surface.at(if axis == 1 { [t, value] } else { [value, t] })[0]);
                (SpaceCurve::between(from, to), [0.0, 1.0])
            }
            _ => surface.side(axis, value, ends)?,
        };
        let first = body.vertices.len();
        body.vertices.extend(range.map(|t| curve.point(t)));
        ring.push((body.edges.len(), true));
        body.edges.push(BrepEdge { ends: [first, first + 1], curve, range });
    }
    let part = body.faces.len();
    let name = format!("surface {}", part + 1);
    body.faces.push(BrepFace {
        name,
        kind: kind.to_owned(),
        surface: surface.clone(),
        loops: vec![ring],
        left: Some(true),
        part,
    });
    Some(())
}
