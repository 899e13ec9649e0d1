//! The curves of a DXF file as points: lines, polylines with arcs between their vertices, arcs, ellipses and splines.
//!
//! Chords leave an arc by [`CHORD`] of its radius at most, an ellipse by that of its longer half axis, and a spline by
//! that of the box around its control points.

use std::f64::consts::TAU;

use super::super::super::fault::Faults;
use super::super::surfaces::{CHORD, MOST_POINTS, sampled, spline_curve};
use super::groups::Record;
use crate::hull::Motion;
use crate::spline::{BsplineCurve, Collocation, KnotVector, Parametrization, cross, length, minus};

/// A component of a normal below this part of its length is small, by the rule of the format for axes.
const ARBITRARY: f64 = 1.0 / 64.0;

/// The motion from the coordinates of an entity to those of the drawing, by its normal (group 210).
pub(super) fn upright(record: &Record<'_>, faults: &mut Faults) -> Motion {
    let normal = record.point(210, faults).unwrap_or([0.0, 0.0, 1.0]);
    axes(normal)
}

/// The axes that a normal stands for: x is across it and the world's y, where it is near the world's z, and else the
/// world's z.
fn axes(normal: [f64; 3]) -> Motion {
    let unit = |v: [f64; 3]| {
        let long = length(v);
        if long > 0.0 { v.map(|c| c / long) } else { [0.0, 0.0, 1.0] }
    };
    let z = unit(normal);
    let near = z[0].abs() < ARBITRARY && z[1].abs() < ARBITRARY;
    let x = unit(cross(if near { [0.0, 1.0, 0.0] } else { [0.0, 0.0, 1.0] }, z));
    let y = unit(cross(z, x));
    Motion([0, 1, 2].map(|k| [x[k], y[k], z[k], 0.0]))
}

/// The angles of chords of an arc, both ends among them \[rad\].
fn angles(from: f64, to: f64) -> impl Iterator<Item = f64> {
    let step = 2.0 * (1.0 - CHORD).acos();
    let count = ((to - from).abs() / step).ceil().clamp(1.0, 2000.0) as usize;
    (0..=count).map(move |k| from + (to - from) * k as f64 / count as f64)
}

/// Line: its two ends, in the coordinates of the drawing.
pub(super) fn line(record: &Record<'_>, faults: &mut Faults) -> Vec<[f64; 3]> {
    [10, 11].into_iter().filter_map(|code| record.point(code, faults)).collect()
}

/// Arc or circle.
pub(super) fn arc(record: &Record<'_>, whole: bool, faults: &mut Faults) -> Vec<[f64; 3]> {
    let Some([x, y, z]) = record.point(10, faults) else { return Vec::new() };
    let radius = record.real(40, 0.0, faults);
    let [from, mut to] = [50, 51].map(|code| record.real(code, 0.0, faults).to_radians());
    if whole {
        to = from + TAU;
    } else if to <= from {
        to += TAU * ((from - to) / TAU).floor().max(0.0) + TAU;
    }
    let place = upright(record, faults);
    angles(from, to).map(|a| place.point([x + radius * a.cos(), y + radius * a.sin(), z])).collect()
}

/// Ellipse: its centre, its longer half axis, the ratio of the shorter, and between which parameters.
pub(super) fn ellipse(record: &Record<'_>, faults: &mut Faults) -> Vec<[f64; 3]> {
    let (Some(centre), Some(long)) = (record.point(10, faults), record.point(11, faults)) else { return Vec::new() };
    let ratio = record.real(40, 1.0, faults);
    let [from, mut to] = [(41, 0.0), (42, TAU)].map(|(code, usual)| record.real(code, usual, faults));
    if to <= from {
        to += TAU;
    }
    let normal = upright(record, faults).along([0.0, 0.0, 1.0]);
    let short = cross(normal, long).map(|c| c * ratio);
    let at = |a: f64| [0, 1, 2].map(|k| centre[k] + a.cos() * long[k] + a.sin() * short[k]);
    angles(from, to.min(from + TAU)).map(at).collect()
}

/// A vertex of a plane polyline and its bulge, the tangent of a quarter of the angle of the arc to the next.
pub(super) type Bulged = ([f64; 2], f64);

/// The points of a plane polyline at its height, before the motion of its normal; little more than [`MOST_POINTS`].
pub(super) fn bulged(vertices: &[Bulged], closed: bool, height: f64, place: &Motion) -> Vec<[f64; 3]> {
    let Some(&(first, _)) = vertices.first() else { return Vec::new() };
    let mut points: Vec<[f64; 2]> = vec![first];
    let ends = vertices.iter().skip(1).chain(closed.then_some(&vertices[0]));
    for (&([ax, ay], bulge), &([bx, by], _)) in vertices.iter().zip(ends) {
        if points.len() > MOST_POINTS {
            break;
        }
        let (dx, dy) = (bx - ax, by - ay);
        if bulge.abs() > 1e-12 && dx.hypot(dy) > 0.0 {
            // The centre lies off the middle of the chord, to the left of an arc below half a turn.
            let turn = 4.0 * bulge.atan();
            let off = (1.0 - bulge * bulge) / (4.0 * bulge);
            let (cx, cy) = (0.5 * (ax + bx) - off * dy, 0.5 * (ay + by) + off * dx);
            let (radius, from) = ((ax - cx).hypot(ay - cy), (ay - cy).atan2(ax - cx));
            let inner: Vec<f64> = angles(from, from + turn).collect();
            let inside = &inner[1..inner.len() - 1];
            points.extend(inside.iter().map(|a| [cx + radius * a.cos(), cy + radius * a.sin()]));
        }
        points.push([bx, by]);
    }
    points.into_iter().map(|[x, y]| place.point([x, y, height])).collect()
}

/// A plane polyline of one record (LWPOLYLINE).
pub(super) fn light_polyline(record: &Record<'_>, faults: &mut Faults) -> Vec<[f64; 3]> {
    let mut vertices: Vec<Bulged> = Vec::new();
    for group in &record.groups {
        match (group.code, vertices.last_mut()) {
            (10, _) => vertices.push(([group.real(faults), 0.0], 0.0)),
            (20, Some((point, _))) => point[1] = group.real(faults),
            (42, Some((_, bulge))) => *bulge = group.real(faults),
            _ => {}
        }
    }
    let closed = record.whole(70, faults) & 1 == 1;
    let height = record.real(38, 0.0, faults);
    bulged(&vertices, closed, height, &upright(record, faults))
}

/// A spline: of control points and knots, or through its fit points where it has no others.
pub(super) fn spline(record: &Record<'_>, faults: &mut Faults) -> Vec<[f64; 3]> {
    let (net, through) = (record.points(10, faults), record.points(11, faults));
    let (knots, weights) = (record.reals(40, faults), record.reals(41, faults));
    let line = record.line().unwrap_or(0);
    let degree = usize::try_from(record.whole(71, faults)).unwrap_or(0);
    let curve = if net.is_empty() {
        fitted(&through)
    } else if !weights.is_empty() && weights.len() != net.len() {
        let message = format!("{} weights, expected {}", weights.len(), net.len());
        faults.add(record.line(), "SPLINE", message);
        None
    } else {
        let weight = |k: usize| weights.get(k).copied().unwrap_or(1.0);
        let weighted = net.iter().enumerate().map(|(k, &point)| (weight(k), point));
        spline_curve(faults, line, "SPLINE", degree, knots, weighted)
    };
    curve.map(|curve| sampled(&curve)).unwrap_or(through)
}

/// The cubic through points over the lengths of their chords; of fewer points a lower degree, of one or none nothing.
fn fitted(points: &[[f64; 3]]) -> Option<BsplineCurve<4>> {
    let mut distinct = points.to_vec();
    distinct.dedup_by(|b, a| length(minus(*a, *b)) <= 0.0);
    let sites = Parametrization::ChordLength.parameters(&distinct).ok()?;
    let degree = 3.min(distinct.len() - 1);
    // Not a knot: the second point and the last but one are none.
    let inner = if distinct.len() > 4 { &sites[2..sites.len() - 2] } else { &[] };
    let breaks: Vec<f64> = [0.0].into_iter().chain(inner.iter().copied()).chain([1.0]).collect();
    let knots = KnotVector::from_breakpoints(degree, &breaks, &vec![1; inner.len()]).ok()?;
    let collocation = Collocation::new(&knots, &sites).ok()?;
    let columns = [0, 1, 2].map(|axis| {
        let mut values: Vec<f64> = distinct.iter().map(|point| point[axis]).collect();
        collocation.solve(&mut values);
        values
    });
    let net = (0..distinct.len()).map(|k| [columns[0][k], columns[1][k], columns[2][k], 1.0]).collect();
    BsplineCurve::new(knots, net).ok()
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;

    #[test]
    fn axes_of_normals_are_those_of_the_format() {
        for (normal, x) in [
            ([0.0, 0.0, 1.0], [1.0, 0.0, 0.0]),
            ([0.0, 0.0, -1.0], [-1.0, 0.0, 0.0]),
            ([1.0, 0.0, 0.0], [0.0, 1.0, 0.0]),
            ([0.0, -2.0, 0.0], [1.0, 0.0, 0.0]),
        ] {
            let found = axes(normal).along([1.0, 0.0, 0.0]);
            assert!(length(minus(found, x)) < 1e-15, "{normal:?}: {found:?}");
        }
    }

    #[test]
    fn a_bulge_of_one_is_half_a_circle() {
        let vertices = [([1.0, 0.0], 1.0), ([-1.0, 0.0], -1.0)];
        let points = bulged(&vertices, true, 2.0, &Motion::NONE);
        assert!(points.iter().all(|[x, y, z]| (x.hypot(*y) - 1.0).abs() < 1e-12 && (z - 2.0).abs() < 1e-12));
        // Up and over, and back the same way: a clockwise arc.
        assert!(points.iter().all(|p| p[1] > -1e-12) && points.iter().any(|p| p[1] > 1.0 - 1e-5));
        // The chords of half a circle enclose its area.
        let half = &points[..points.len() / 2 + 1];
        let area: f64 = half.windows(2).map(|w| 0.5 * (w[0][0] * w[1][1] - w[1][0] * w[0][1])).sum();
        assert!((area / (0.5 * PI) - 1.0).abs() < 2e-5, "{area}");
    }

    #[test]
    fn fit_points_alone_are_met() {
        let points: Vec<[f64; 3]> = (0..7).map(f64::from).map(|t| [t, t * t, 0.1 * t * t * t]).collect();
        let curve = fitted(&points).unwrap();
        let made = sampled(&curve);
        for point in points {
            assert!(made.iter().any(|p| length(minus(*p, point)) < 0.4), "{point:?}");
        }
        assert!(fitted(&[[1.0; 3]; 4]).is_none());
    }
}
