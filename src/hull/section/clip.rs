//! Ending curves at the deck at side.

use super::Hull;
use super::bernstein::{Arc, join};
use crate::spline::BsplineCurve;

/// Places on an arc at which its height over the deck is compared first.
const PLACES: usize = 12;

/// The parts of a curve at or below the deck at side; the curve itself when it stays below. `closed` tells whether the
/// curve ends where it starts. The ends lie on the deck to `tolerance` \[m\].
pub(super) fn below_deck(
    hull: &Hull,
    curve: BsplineCurve<3>,
    closed: bool,
    tolerance: f64,
) -> Vec<(BsplineCurve<3>, bool)> {
    if !hull.is_cut_by_deck() {
        return vec![(curve, closed)];
    }
    let lowest = hull.deck().points().iter().map(|p| p[1]).fold(f64::INFINITY, f64::min);
    let slack = 1e-12 * (hull.top() - hull.bottom());
    if curve.points().iter().all(|p| p[2] <= lowest + slack) {
        return vec![(curve, closed)];
    }
    let over = |p: [f64; 3]| p[2] - hull.deck_height(p[0]) - slack;
    let (from, to) = curve.knots().domain();
    let mut parts: Vec<Vec<Arc<3>>> = Vec::new();
    let mut inside = false;
    let mut whole = true;
    for arc in Arc::of(&curve, from, to) {
        let mut rest = arc;
        // Fractions of the rest of the arc are taken anew after each cut.
        let mut stops = Vec::new();
        let mut before = over(arc.at(0.0));
        for k in 1..=PLACES {
            let r = k as f64 / PLACES as f64;
            let value = over(arc.at(r));
            if (value > 0.0) != (before > 0.0) {
                let (mut a, mut b) = ((k - 1) as f64 / PLACES as f64, r);
                let below = before <= 0.0;
                while b - a > 1e-16 {
                    let middle = 0.5 * (a + b);
                    if middle <= a || middle >= b {
                        break;
                    }
                    let height = over(arc.at(middle));
                    if (height <= 0.0) == below {
                        a = middle;
                    } else {
                        b = middle;
                    }
                    if height.abs() <= 1e-3 * tolerance {
                        break;
                    }
                }
                stops.push(0.5 * (a + b));
            }
            before = value;
        }
        let mut done = 0.0;
        let mut below = over(arc.at(0.0)) <= 0.0;
        for stop in stops.into_iter().chain([1.0]) {
            let r = if stop < 1.0 { (stop - done) / (1.0 - done) } else { 1.0 };
            let part = if stop < 1.0 {
                let [first, second] = rest.split(r);
                rest = second;
                first
            } else {
                rest
            };
            if below && part.high > part.low {
                match parts.last_mut() {
                    Some(last) if inside => last.push(part),
                    _ => parts.push(vec![part]),
                }
                inside = true;
            } else if !below {
                inside = false;
                whole = false;
            }
            done = stop;
            below = !below;
        }
    }
    if whole {
        return vec![(curve, closed)];
    }
    // A loop that starts below the deck: its last part runs on into its first.
    if closed && inside && parts.len() > 1 && over(curve.eval(from)) <= 0.0 {
        let first = parts.remove(0);
        if let Some(last) = parts.last_mut() {
            let shift = to - from;
            last.extend(first.into_iter().map(|mut arc| {
                arc.low += shift;
                arc.high += shift;
                arc
            }));
        }
    }
    // Where the curve only touches the deck nothing of it is left.
    let extent = |arcs: &[Arc<3>]| {
        let start = arcs[0].points[0];
        let away = |p: &[f64; 3]| (0..3).map(|d| (p[d] - start[d]).abs()).fold(0.0, f64::max);
        arcs.iter().flat_map(Arc::control).map(away).fold(0.0, f64::max)
    };
    parts
        .iter()
        .filter(|arcs| extent(arcs) > tolerance)
        .filter_map(|arcs| join(arcs))
        .map(|part| (part, false))
        .collect()
}
