//! 0 <= y <= B/2 over the surface: at the points of a grid four times as fine as the knots, where the surface comes
//! near a limit.
//!
//! Limits of the control values would be sufficient and far too strict: the control points of a full waterline lie
//! outside it. Between the points of the grid the surface may pass a limit by h^2/8 times its second derivative, h a
//! quarter of a span.

use super::super::model::{Limit, value};
use super::super::program::Between;
use super::super::surface::basis_row;
use crate::hull::Hull;
use crate::spline::{BsplineSurface, KnotVector};

/// Points a span.
const FINENESS: usize = 4;

/// Points a span of [`excess`].
const FINER: usize = 12;

/// The greatest half-breadth of a surface over `greatest`, 0 where it is not over it \[m\], by twelve points a span: h^2/8
/// times its second derivative is missed at most, h a twelfth of a span.
#[must_use]
pub fn excess(surface: &BsplineSurface<3>, greatest: f64) -> f64 {
    let [u, v] = [surface.u(), surface.v()];
    let mut most = greatest;
    for i in u.spans() {
        for j in v.spans() {
            // The surface lies within the hull of its control points.
            let mut acting = (i - u.degree()..=i).flat_map(|k| (j - v.degree()..=j).map(move |l| (k, l)));
            if acting.all(|(k, l)| surface.point(k, l)[1] <= most) {
                continue;
            }
            let at = |knots: &KnotVector, span: usize, k: usize| {
                let [from, to] = [knots.knots()[span], knots.knots()[span + 1]];
                from + (to - from) * k as f64 / FINER as f64
            };
            for k in 0..=FINER {
                for l in 0..=FINER {
                    most = most.max(surface.eval(at(u, i, k), at(v, j, l))[1]);
                }
            }
        }
    }
    most - greatest
}

/// Points of the grid along one direction.
fn sites(knots: &KnotVector) -> Vec<f64> {
    let breaks = knots.breakpoints();
    let inner =
        breaks.windows(2).flat_map(|w| (0..FINENESS).map(move |k| w[0] + (w[1] - w[0]) * k as f64 / FINENESS as f64));
    inner.chain(breaks.last().copied()).collect()
}

/// Limits of the half-breadth wherever that of `net` is within `margin` \[m\] of the centreplane or of `greatest` \[m\].
#[must_use]
pub fn breadths(hull: &Hull, net: &[f64], greatest: f64, margin: f64) -> Vec<Limit> {
    let surface = hull.surface();
    let (us, vs) = (sites(surface.u()), sites(surface.v()));
    let mut limits = Vec::new();
    for &u in &us {
        for &v in &vs {
            let row = basis_row(surface, [u, v], [0, 0]);
            let y = value(&row, net);
            let lower = if y < margin { 0.0 } else { f64::NEG_INFINITY };
            let upper = if y > greatest - margin { greatest } else { f64::INFINITY };
            if lower.is_finite() || upper.is_finite() {
                limits.push(Limit { row, lower, upper });
            }
        }
    }
    limits
}

/// Moves limits to where `start` breaks them: what does not move cannot do better.
pub fn admit(limits: &mut [Limit], start: &[f64]) {
    for limit in limits {
        let own = value(&limit.row, start);
        (limit.lower, limit.upper) = (limit.lower.min(own), limit.upper.max(own));
    }
}

/// Limits that `net` breaks by more than `slack` \[m\]: of the surface, where `start` does not break them as well, and
/// of the control values, which on any hull lie between `-greatest` and `2 greatest`.
#[must_use]
pub fn broken(hull: &Hull, net: &[f64], start: &[f64], greatest: f64, slack: f64) -> Vec<Limit> {
    let mut limits = breadths(hull, net, greatest, -slack);
    admit(&mut limits, start);
    limits.retain(|limit| {
        let y = value(&limit.row, net);
        y < limit.lower - slack || y > limit.upper + slack
    });
    let far = |limit: &Limit| !(limit.lower..=limit.upper).contains(&value(&limit.row, net));
    limits.extend(control_values(net.len(), greatest).filter(far));
    limits
}

/// Limits of the control values of any hull of this greatest half-breadth \[m\]: from `-greatest` to `2 greatest`.
pub fn control_values(count: usize, greatest: f64) -> impl Iterator<Item = Limit> {
    (0..count).map(move |i| Limit { row: vec![(i, 1.0)], lower: -greatest, upper: 2.0 * greatest })
}

/// Limits of what the surface moves between the offsets that `net` breaks by more than `slack` \[m\], at the same
/// points: `tolerance` times `widening` and `room` \[m\] about `reference`.
#[must_use]
pub fn between(
    hull: &Hull,
    net: &[f64],
    reference: &[f64],
    [tolerance, widening, room]: [f64; 3],
    slack: f64,
) -> Vec<Between> {
    let surface = hull.surface();
    let (us, vs) = (sites(surface.u()), sites(surface.v()));
    let points = us.iter().flat_map(|&u| vs.iter().map(move |&v| [u, v]));
    let far = points.filter_map(|at| {
        let row = basis_row(surface, at, [0, 0]);
        let middle = value(&row, reference);
        let moved = (value(&row, net) - middle).abs();
        (moved > tolerance * widening + room + slack).then_some(Between { row, value: middle, tolerance, room })
    });
    far.collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// y = 5 sin(pi u) sin(pi v) at the Greville points: its top is at the middle of both.
    #[test]
    fn the_excess_is_that_of_the_top() {
        let knots = KnotVector::uniform(3, 7).unwrap();
        let wave = |t: f64| (std::f64::consts::PI * t).sin();
        let points = knots
            .greville()
            .into_iter()
            .flat_map(|u| knots.greville().into_iter().map(move |v| [100.0 * u, 5.0 * wave(u) * wave(v), 10.0 * v]));
        let surface = BsplineSurface::new(knots.clone(), knots.clone(), points.collect()).unwrap();
        let top = surface.eval(0.5, 0.5)[1];
        assert!((excess(&surface, 4.0) - (top - 4.0)).abs() < 1e-12, "{}", excess(&surface, 4.0));
        assert!(excess(&surface, top).abs() < 1e-12);
        assert!(excess(&surface, 5.1) == 0.0);
    }
}
