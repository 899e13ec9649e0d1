//! The outline of a hull on the centreplane and its deck at side.

use crate::hull::Hull;

/// Points taken per span of a curve.
const POINTS_PER_SPAN: usize = 24;

/// Parameters of a knot vector: its breakpoints, with points between.
fn parameters(breakpoints: &[f64]) -> Vec<f64> {
    let mut result: Vec<f64> = breakpoints
        .windows(2)
        .flat_map(|w| (0..POINTS_PER_SPAN).map(move |k| w[0] + (w[1] - w[0]) * k as f64 / POINTS_PER_SPAN as f64))
        .collect();
    result.extend(breakpoints.last());
    result
}

/// The line of the surface at its stern (`fore` false) or stem (`fore` true) end, from the keel to the deck at side.
pub(in crate::plot) fn end_profile(hull: &Hull, fore: bool) -> Vec<[f64; 3]> {
    let domain = hull.surface().u().domain();
    let curve = hull.surface().curve_at_u(if fore { domain.1 } else { domain.0 });
    let above = |p: &[f64; 3]| p[2] - hull.deck_height(p[0]);
    let mut points: Vec<[f64; 3]> = Vec::new();
    let mut before: Option<f64> = None;
    for t in parameters(&hull.surface().v().breakpoints()) {
        let point = curve.eval(t);
        if above(&point) > 0.0 {
            if let Some(low) = before {
                points.push(curve.eval(bisect(low, t, |t| above(&curve.eval(t)))));
            }
            return points;
        }
        before = Some(t);
        points.push(point);
    }
    points
}

/// The zero of a function that is not positive at `low` and positive at `high`.
fn bisect(mut low: f64, mut high: f64, function: impl Fn(f64) -> f64) -> f64 {
    for _ in 0..50 {
        let middle = 0.5 * (low + high);
        if function(middle) > 0.0 {
            high = middle;
        } else {
            low = middle;
        }
    }
    low
}

/// The deck at side from the stern to the stem profile: (x, y, z).
pub(in crate::plot) fn deck_at_side(hull: &Hull) -> Vec<[f64; 3]> {
    let surface = hull.surface();
    let (bottom, top) = surface.v().domain();
    parameters(&surface.u().breakpoints())
        .into_iter()
        .map(|u| {
            let above = |v: f64| {
                let p = surface.eval(u, v);
                p[2] - hull.deck_height(p[0])
            };
            let v = if above(top) <= 0.0 { top } else { bisect(bottom, top, above) };
            surface.eval(u, v)
        })
        .collect()
}

/// Height of the lowest point of the deck at side \[m\]: a draught beyond it floods the deck edge.
pub(in crate::plot) fn lowest_deck_edge(hull: &Hull) -> f64 {
    deck_at_side(hull).iter().map(|point| point[2]).fold(f64::INFINITY, f64::min)
}

/// The keel line (x, z) from aft to forward below the deck; on a level hull its ends say all.
fn keel_line(hull: &Hull) -> Vec<[f64; 2]> {
    if hull.is_level() {
        return Vec::new();
    }
    let keel = hull.surface().curve_at_v(hull.surface().v().domain().0);
    let points = parameters(&hull.surface().u().breakpoints()).into_iter().map(|u| keel.eval(u));
    points.filter(|p| p[2] <= hull.deck_height(p[0])).map(|p| [p[0], p[2]]).collect()
}

/// The outline on the centreplane (x, z): from the deck at the stern down, along the keel, and up the stem to the deck.
pub(in crate::plot) fn centreplane(hull: &Hull) -> Vec<[f64; 2]> {
    let flat = |p: &[f64; 3]| [p[0], p[2]];
    let mut points: Vec<_> = end_profile(hull, false).iter().rev().map(flat).collect();
    points.extend(keel_line(hull));
    points.extend(end_profile(hull, true).iter().map(flat));
    points
}

/// Aft and fore end of the hull below `draught`: x [m].
pub(in crate::plot) fn immersed_length(hull: &Hull, draught: f64) -> [f64; 2] {
    let ends = hull.endings(draught);
    let below = |fore: bool| {
        end_profile(hull, fore)
            .into_iter()
            .filter(|p| p[2] <= draught)
            .map(|p| p[0])
            .chain(ends.map(|e| e[usize::from(fore)]))
    };
    [below(false).fold(f64::INFINITY, f64::min), below(true).fold(f64::NEG_INFINITY, f64::max)]
}

/// Aft and fore end of the whole hull: x [m].
pub(in crate::plot) fn overall_length(hull: &Hull) -> [f64; 2] {
    let outline = centreplane(hull);
    outline.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], p| [a.min(p[0]), b.max(p[0])])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hull::PrincipalParticulars;
    use crate::spline::{BsplineCurve, BsplineSurface, KnotVector};

    #[test]
    fn the_outline_follows_a_rockered_keel() {
        // Keel z = 2 (2 u - 1)^2 over 10 m, deck at 3 m.
        let (u, v) = (KnotVector::uniform(2, 1).unwrap(), KnotVector::uniform(1, 1).unwrap());
        let keel = [2.0, -2.0, 2.0];
        let points = (0..3).flat_map(|i| [[5.0 * i as f64, 0.0, keel[i]], [5.0 * i as f64, 1.0, 3.0]]).collect();
        let line = KnotVector::uniform(1, 1).unwrap();
        let deck = BsplineCurve::new(line, vec![[-1.0, 3.0], [11.0, 3.0]]).unwrap();
        let particulars =
            PrincipalParticulars { length_between_perpendiculars: 10.0, breadth: 2.0, draught: Some(1.0), depth: 3.0 };
        let hull = Hull::new("x", particulars, BsplineSurface::new(u, v, points).unwrap(), deck).unwrap();
        let outline = centreplane(&hull);
        let lowest = outline.iter().min_by(|a, b| a[1].total_cmp(&b[1])).unwrap();
        assert!((lowest[0] - 5.0).abs() < 1e-12 && lowest[1].abs() < 1e-12, "{lowest:?}");
        let on_keel = |p: &&[f64; 2]| (p[1] - 2.0 * (0.2 * p[0] - 1.0).powi(2)).abs() < 1e-12;
        assert!(outline.iter().filter(on_keel).count() > POINTS_PER_SPAN);
        // The waterline at 0.5 m leaves through the keel at xi = -1/2 and 1/2.
        let [aft, fore] = immersed_length(&hull, 0.5);
        assert!((aft - 2.5).abs() < 1e-9 && (fore - 7.5).abs() < 1e-9, "{aft} {fore}");
    }
}
