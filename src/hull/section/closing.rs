//! The plane and ruled faces that close the body, cut by a plane.
//!
//! The flat of bottom is {(x(u), s y(u), z_bottom)}, the transom {(x(v), s y(v), z(v))} over the stern profile, a flat
//! bow likewise over the stem, 0 <= s <= 1, where (x, y, z) is an edge of the surface. The plane n . (x, y, z) = d
//! meets the face at y* = (d - n_x x - n_z z) / n_y wherever 0 <= y* <= y: a curve that is a spline itself, exactly. A
//! plane that holds the y direction meets it in lines across, at the roots of n_x x + n_z z - d.

use super::bernstein::{Arc, curve_sign_changes, join};
use crate::spline::{BsplineCurve, KnotVector};

/// The curves in which the plane cuts the face that an edge of the surface closes; breadths below `least` \[m\] are none.
pub(super) fn cut_face(edge: &BsplineCurve<3>, normal: [f64; 3], offset: f64, least: f64) -> Vec<BsplineCurve<3>> {
    if edge.points().iter().all(|p| p[1].abs() <= least) {
        return Vec::new();
    }
    let small = 1e-13 * edge.points().iter().flatten().fold(offset.abs(), |m, c| m.max(c.abs()));
    let along = |p: &[f64; 3]| {
        let value = offset - normal[0] * p[0] - normal[2] * p[2];
        if value.abs() <= small { 0.0 } else { value }
    };
    let (from, to) = edge.knots().domain();
    let scalar = |f: &dyn Fn(&[f64; 3]) -> f64| {
        BsplineCurve::new(edge.knots().clone(), edge.points().iter().map(|p| [f(p)]).collect()).ok()
    };
    let mut curves = Vec::new();
    if normal[1].abs() <= 1e-12 {
        let Some(distance) = scalar(&along) else { return curves };
        let mut places = curve_sign_changes(&distance);
        // An end on the plane is a place too.
        for (end, t) in [(0, from), (edge.points().len() - 1, to)] {
            if distance.points()[end][0] == 0.0 && places.iter().all(|p| (p - t).abs() > 1e-12 * (to - from)) {
                places.push(t);
            }
        }
        if distance.points().iter().all(|p| p[0] == 0.0) {
            places.clear();
        }
        for t in places {
            let [x, y, z] = edge.eval(t);
            if y > least {
                curves.extend(line([x, 0.0, z], [x, y, z]));
            }
        }
        return curves;
    }
    let across = |p: &[f64; 3]| along(p) / normal[1];
    let room = |p: &[f64; 3]| p[1] - across(p);
    let (Some(inner), Some(outer)) = (scalar(&across), scalar(&room)) else { return curves };
    let mut stops = curve_sign_changes(&inner);
    stops.extend(curve_sign_changes(&outer));
    stops.extend([from, to]);
    stops.sort_by(f64::total_cmp);
    let moved = edge.points().iter().map(|p| [p[0], across(p), p[2]]).collect();
    let Ok(curve) = BsplineCurve::new(edge.knots().clone(), moved) else { return curves };
    let mut open: Option<f64> = None;
    for pair in stops.windows(2) {
        let middle = 0.5 * (pair[0] + pair[1]);
        let holds = pair[1] - pair[0] > 1e-13 * (to - from)
            && inner.eval(middle)[0] >= 0.0
            && outer.eval(middle)[0] >= 0.0
            && edge.eval(middle)[1] > least;
        match (holds, open) {
            (true, None) => open = Some(pair[0]),
            (false, Some(start)) if pair[1] - pair[0] > 1e-13 * (to - from) => {
                curves.extend(join(&Arc::of(&curve, start, pair[0])));
                open = None;
            }
            _ => {}
        }
    }
    if let Some(start) = open {
        curves.extend(join(&Arc::of(&curve, start, to)));
    }
    curves
}

/// A straight line; none when its ends coincide.
pub(super) fn line(a: [f64; 3], b: [f64; 3]) -> Option<BsplineCurve<3>> {
    let length = a.iter().zip(&b).map(|(x, y)| (x - y).powi(2)).sum::<f64>().sqrt();
    if length <= 0.0 {
        return None;
    }
    BsplineCurve::new(KnotVector::uniform(1, 1).ok()?, vec![a, b]).ok()
}
