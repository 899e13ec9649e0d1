//! The chart of the profile, (u, v) -> (x(u, v), z(u, v)): its extremes, its inverse, and whether it folds.
//!
//! Inverse: on the line x(u, v) = X, continued along the stern and the stem profile where the line leaves the surface,
//! z rises with v, dz/dv = J / x_u inside and z_v on the profiles. So v is the root of an increasing function of one
//! variable, whose every value asks for the root u of another one: Newton's method in brackets, to rounding.

use super::form::{Hull, HullError, solve_increasing};
use super::section::curve_sign_changes;
use crate::spline::{BsplineCurve, BsplineSurface, KnotVector, MAX_DEGREE};

/// Places in each direction of a cell of the knots at which J is looked at.
const PLACES: usize = 5;

/// J below minus this part of its mean is a fold.
const ROUNDING: f64 = 1e-10;

/// Places a span at which the upper edge is compared with the deck at side.
const SAMPLES: usize = 16;

/// A deck at side that is nowhere farther below the upper edge than this part of the height of the hull is that edge.
const SAME_EDGE: f64 = 1e-7;

/// One coordinate of a curve.
pub(super) fn coordinate(curve: &BsplineCurve<3>, axis: usize, less: f64) -> Option<BsplineCurve<1>> {
    BsplineCurve::new(curve.knots().clone(), curve.points().iter().map(|p| [p[axis] - less]).collect()).ok()
}

/// The derivative of a scalar curve; none for straight pieces.
pub(super) fn slope(curve: &BsplineCurve<1>) -> Option<BsplineCurve<1>> {
    let (knots, p) = (curve.knots().knots(), curve.knots().degree());
    if p < 2 {
        return None;
    }
    let points = (0..curve.points().len() - 1)
        .map(|i| {
            let width = knots[i + p + 1] - knots[i + 1];
            let rise = curve.points()[i + 1][0] - curve.points()[i][0];
            [if width > 0.0 { p as f64 * rise / width } else { 0.0 }]
        })
        .collect();
    let knots = KnotVector::new(p - 1, knots[1..knots.len() - 1].to_vec()).ok()?;
    BsplineCurve::new(knots, points).ok()
}

/// Parameters at which a scalar curve may have an extreme: its breakpoints and the sign changes of its slope.
pub(super) fn turns(curve: &BsplineCurve<1>) -> Vec<f64> {
    let mut places = slope(curve).map(|s| curve_sign_changes(&s)).unwrap_or_default();
    places.extend(curve.knots().breakpoints());
    places
}

/// Lowest and highest point of the surface, which stand on the lower and the upper edge, z rising with v.
pub(super) fn heights(surface: &BsplineSurface<3>, level: bool) -> [f64; 2] {
    let columns = surface.shape()[1];
    if level {
        return [surface.point(0, 0)[2], surface.point(0, columns - 1)[2]];
    }
    let (a, b) = surface.v().domain();
    let along = |v: f64| -> Vec<f64> {
        let Some(z) = coordinate(&surface.curve_at_v(v), 2, 0.0) else { return Vec::new() };
        turns(&z).into_iter().map(|u| z.eval(u)[0]).collect()
    };
    [along(a).into_iter().fold(f64::INFINITY, f64::min), along(b).into_iter().fold(f64::NEG_INFINITY, f64::max)]
}

/// Checks that J is nowhere negative.
pub(super) fn unfolded(surface: &BsplineSurface<3>) -> Result<(), HullError> {
    let extent = |axis: usize| {
        let values = surface.points().iter().map(|p| p[axis]);
        values.clone().fold(f64::NEG_INFINITY, f64::max) - values.fold(f64::INFINITY, f64::min)
    };
    let (domain_u, domain_v) = (surface.u().domain(), surface.v().domain());
    let mean = extent(0) * extent(2) / ((domain_u.1 - domain_u.0) * (domain_v.1 - domain_v.0));
    let places = |breakpoints: Vec<f64>| -> Vec<f64> {
        let inside = |k: usize| (k as f64 + 0.5) / PLACES as f64;
        breakpoints.windows(2).flat_map(|w| (0..PLACES).map(|k| w[0] + (w[1] - w[0]) * inside(k))).collect()
    };
    let (along, up, columns) = (surface.u(), surface.v(), surface.shape()[1]);
    // Basis functions up are the same on every line u = constant, and each such line is summed once.
    let of_v = |v: f64| {
        let span = up.find_span(v);
        (v, span - up.degree(), up.basis_derivatives::<2>(span, v))
    };
    let across: Vec<(f64, usize, [[f64; MAX_DEGREE + 1]; 2])> =
        places(up.breakpoints()).into_iter().map(of_v).collect();
    let mut line = vec![[0.0; 4]; columns];
    for u in places(along.breakpoints()) {
        let span = along.find_span(u);
        let [values, slopes] = along.basis_derivatives::<2>(span, u);
        line.fill([0.0; 4]);
        for (i, row) in (span - along.degree()..=span).enumerate() {
            for (sum, point) in line.iter_mut().zip(&surface.points()[row * columns..]) {
                let terms = [values[i] * point[0], values[i] * point[2], slopes[i] * point[0], slopes[i] * point[2]];
                sum.iter_mut().zip(terms).for_each(|(sum, term)| *sum += term);
            }
        }
        for (v, first, [values, slopes]) in &across {
            // x_u, z_u, x_v, z_v.
            let mut at = [0.0; 4];
            for (column, (value, slope)) in line[*first..=first + up.degree()].iter().zip(values.iter().zip(slopes)) {
                let terms = [value * column[2], value * column[3], slope * column[0], slope * column[1]];
                at.iter_mut().zip(terms).for_each(|(sum, term)| *sum += term);
            }
            let jacobian = at[0] * at[3] - at[2] * at[1];
            if jacobian < -ROUNDING * mean {
                let [x, _, z] = surface.eval(u, *v);
                return Err(HullError::Folded { u, v: *v, x, z, jacobian });
            }
        }
    }
    Ok(())
}

/// Whether the deck at side is somewhere below the upper edge.
pub(super) fn is_cut_by_deck(hull: &Hull) -> bool {
    let edge = hull.surface().curve_at_v(hull.surface().v().domain().1);
    let least = SAME_EDGE * (hull.top() - hull.bottom());
    edge.knots().breakpoints().windows(2).any(|w| {
        (0..=SAMPLES).any(|k| {
            let [x, _, z] = edge.eval(w[0] + (w[1] - w[0]) * k as f64 / SAMPLES as f64);
            z - hull.deck_height(x) > least
        })
    })
}

/// v of the point at height `z` on the station at `x`, continued along the profiles; none above and below its ends.
pub(super) fn height_parameter_along(hull: &Hull, x: f64, z: f64) -> Option<f64> {
    let surface = hull.surface();
    let domain = surface.v().domain();
    if hull.is_upright() {
        return hull.height_parameter_at(hull.length_parameter(x, domain.0)?, z);
    }
    let height = |v: f64| {
        let u = hull.length_parameter(x, v);
        let at = surface.tangents(u.unwrap_or_else(|| hull.nearest_length_parameter(x, v)), v);
        let inside = u.is_some() && at.du[0] > 0.0;
        (at.point[2], at.dv[2] - if inside { at.du[2] * at.dv[0] / at.du[0] } else { 0.0 })
    };
    solve_increasing(z, domain, (height(domain.0).0, height(domain.1).0), height)
}

/// v up to which the station at `x` is below `z`: an end of v where it is so throughout or nowhere.
pub(super) fn end_along(hull: &Hull, x: f64, z: f64) -> f64 {
    let (a, b) = hull.surface().v().domain();
    height_parameter_along(hull, x, z).unwrap_or_else(|| {
        let u = hull.nearest_length_parameter(x, a);
        if z <= hull.surface().eval(u, a)[2] { a } else { b }
    })
}

/// Parameters of the points at height `z` on the lines v = constant at the given v.
pub(super) fn passages(surface: &BsplineSurface<3>, v: f64, z: f64) -> Vec<f64> {
    let Some(gap) = coordinate(&surface.curve_at_v(v), 2, z) else { return Vec::new() };
    let points = gap.points();
    if points.iter().all(|p| p[0] > 0.0) || points.iter().all(|p| p[0] < 0.0) {
        return Vec::new();
    }
    curve_sign_changes(&gap)
}

/// Ends of the waterline at height `z`, its aftmost and its foremost x.
pub(super) fn endings(hull: &Hull, z: f64) -> Option<[f64; 2]> {
    let surface = hull.surface();
    let ((first, last), (low, high)) = (surface.u().domain(), surface.v().domain());
    let slack = 1e-12 * (hull.top() - hull.bottom());
    let mut stops = passages(surface, low, z);
    stops.extend(passages(surface, high, z));
    stops.extend([first, last]);
    stops.sort_by(f64::total_cmp);
    let held = |u: f64| surface.eval(u, low)[2] <= z + slack && surface.eval(u, high)[2] >= z - slack;
    let mut wet = stops.windows(2).filter(|w| w[1] > w[0] && held(0.5 * (w[0] + w[1])));
    let aft = wet.next()?;
    let fore = wet.next_back().unwrap_or(aft);
    let x = |u: f64| {
        let v = hull.height_parameter_at(u, z).unwrap_or(if surface.eval(u, low)[2] > z { low } else { high });
        surface.eval(u, v)[0]
    };
    Some([x(aft[0]), x(fore[1])])
}
