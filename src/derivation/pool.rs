//! What the half-breadths of a daughter keep to, as rows over its net: the centreplane, the breadth, the order of sections and
//! waterlines, and the signs of curvature of the parent.
//!
//! A line of the net on which the parent bends one way throughout bends that way on the daughter. On others the sign is kept
//! where it is definite. Curvature is kappa = (m D^2 y - m' D y) / (m^2 + (D y)^2)^(3/2) along the station, or the waterline,
//! through a point of the surface, with D the derivative along it, m = D z, or D x, and the metric of the parent: linear in
//! the half-breadths on a fixed chart.

use crate::hull::Hull;
use crate::spline::{BsplineSurface, MAX_DEGREE};

/// Points of a span in each direction at which signs are looked at.
const PLACES: usize = 2;
/// Part of the greatest curvature of a line from which a sign is definite.
const DEFINITE: f64 = 0.03;
/// The same, where a line bends one way throughout.
const FAINT: f64 = 1e-3;
/// Part of the greatest curvature of a line by which a sign may be missed.
const MISSED: f64 = 2e-4;
/// Half-breadths are within this part of B of a limit that they stand on.
pub(super) const AT_LIMIT: f64 = 1e-9;

/// What a row is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    /// y >= 0.
    Centreplane,
    /// y <= B/2.
    Breadth,
    /// Neighbouring sections, or waterlines, do not pass each other.
    Crossing,
    /// A sign of curvature.
    Sign,
    /// So near to the start.
    Tolerance,
}

impl Kind {
    pub(super) const ALL: [Self; 5] = [Self::Centreplane, Self::Breadth, Self::Crossing, Self::Sign, Self::Tolerance];

    /// The word in files.
    pub(super) fn word(self) -> &'static str {
        match self {
            Self::Centreplane => "centreplane",
            Self::Breadth => "breadth",
            Self::Crossing => "order",
            Self::Sign => "signs",
            Self::Tolerance => "within",
        }
    }
}

/// row . y >= lower.
#[derive(Debug, Clone)]
pub(super) struct Candidate {
    pub(super) kind: Kind,
    pub(super) row: Vec<(usize, f64)>,
    pub(super) lower: f64,
    /// By how much it may be missed.
    pub(super) slack: f64,
}

impl Candidate {
    pub(super) fn value(&self, y: &[f64]) -> f64 {
        self.row.iter().map(|&(k, weight)| weight * y[k]).sum()
    }

    pub(super) fn is_missed(&self, y: &[f64]) -> bool {
        self.value(y) < self.lower - self.slack
    }
}

/// The rows of a daughter on the chart of `start`, with order and signs of `parent`, which has the same net.
pub(super) fn candidates(parent: &Hull, start: &Hull) -> Vec<Candidate> {
    let mut list = bounds(parent, start);
    list.extend(orders(parent));
    for station in [false, true] {
        list.extend(signs(parent, start, station));
    }
    list
}

/// Centreplane and breadth.
fn bounds(parent: &Hull, start: &Hull) -> Vec<Candidate> {
    let breadth = parent.particulars().breadth;
    let slack = AT_LIMIT * breadth;
    let mut list = Vec::new();
    for (k, point) in start.surface().points().iter().enumerate() {
        let y = point[1];
        list.push(Candidate { kind: Kind::Centreplane, row: vec![(k, 1.0)], lower: y.min(0.0), slack });
        list.push(Candidate { kind: Kind::Breadth, row: vec![(k, -1.0)], lower: -y.max(0.5 * breadth), slack });
    }
    list
}

/// Differences of neighbouring control values keep their signs, along the ship and up.
fn orders(parent: &Hull) -> Vec<Candidate> {
    let surface = parent.surface();
    let [rows, columns] = surface.shape();
    let breadth = parent.particulars().breadth;
    let mut list = Vec::new();
    let mut add = |a: usize, b: usize| {
        let rise = surface.points()[b][1] - surface.points()[a][1];
        if rise.abs() > 1e-6 * breadth {
            let way = rise.signum();
            let row = vec![(a, -way), (b, way)];
            list.push(Candidate { kind: Kind::Crossing, row, lower: 0.0, slack: AT_LIMIT * breadth });
        }
    };
    for i in 0..rows {
        for j in 0..columns {
            let k = i * columns + j;
            if i + 1 < rows {
                add(k, k + columns);
            }
            if j + 1 < columns {
                add(k, k + 1);
            }
        }
    }
    list
}

/// The row of curvature at a point.
struct Bend {
    row: Vec<(usize, f64)>,
    value: f64,
}

/// Curvature along the station, or the waterline, through (u, v); none where the chart has no such line.
fn bend(surface: &BsplineSurface<3>, [u, v]: [f64; 2], station: bool) -> Option<Bend> {
    let d = surface.derivatives::<3>(u, v);
    // s runs on the line, t across it; `held` is what the line holds, `run` what it runs on.
    let (held, run) = if station { (0, 2) } else { (2, 0) };
    let of = |axis: usize, s: usize, t: usize| if station { d[t][s][axis] } else { d[s][t][axis] };
    let across = of(held, 0, 1);
    let size = of(held, 1, 0).abs().max(across.abs());
    if across.abs() <= 1e-9 * size.max(1e-300) || across.abs() <= 1e-12 {
        return None;
    }
    let along = of(held, 1, 0);
    let a = -along / across;
    let slope_s = -(of(held, 2, 0) * across - along * of(held, 1, 1)) / (across * across);
    let slope_t = -(of(held, 1, 1) * across - along * of(held, 0, 2)) / (across * across);
    let turn = slope_s + a * slope_t;
    let first = |axis: usize| of(axis, 1, 0) + a * of(axis, 0, 1);
    let second =
        |axis: usize| of(axis, 2, 0) + 2.0 * a * of(axis, 1, 1) + a * a * of(axis, 0, 2) + turn * of(axis, 0, 1);
    let (m, rate, slope) = (first(run), second(run), first(1));
    let metric = (m * m + slope * slope).powf(1.5);
    if metric <= 1e-300 || m.abs() <= 1e-9 * (m.hypot(slope)) {
        return None;
    }
    let value = (m * second(1) - rate * slope) / metric;
    // Weights of y_s, y_t, y_ss, y_st and y_tt.
    let weights = [-rate, m * turn - rate * a, m, 2.0 * m * a, m * a * a].map(|w| w / metric);
    let orders: [[usize; 2]; 5] = [[1, 0], [0, 1], [2, 0], [1, 1], [0, 2]];
    let orders = orders.map(|[s, t]| if station { [t, s] } else { [s, t] });
    Some(Bend { row: row_of(surface, [u, v], &orders, &weights), value })
}

/// sum of weights times derivatives of y of these orders in u and v, at most 2, over the net.
pub(super) fn row_of<const N: usize>(
    surface: &BsplineSurface<3>,
    [u, v]: [f64; 2],
    orders: &[[usize; 2]; N],
    weights: &[f64; N],
) -> Vec<(usize, f64)> {
    let (span_u, span_v) = (surface.u().find_span(u), surface.v().find_span(v));
    let (p, q) = (surface.u().degree(), surface.v().degree());
    let along: [[f64; MAX_DEGREE + 1]; 3] = surface.u().basis_derivatives::<3>(span_u, u);
    let up: [[f64; MAX_DEGREE + 1]; 3] = surface.v().basis_derivatives::<3>(span_v, v);
    let columns = surface.shape()[1];
    let mut row = Vec::with_capacity((p + 1) * (q + 1));
    let points = (0..=p).flat_map(|i| (0..=q).map(move |j| (i, j)));
    row.extend(points.map(|(i, j)| {
        let parts = orders.iter().zip(weights).map(|([a, b], weight)| weight * along[*a][i] * up[*b][j]);
        ((span_u - p + i) * columns + span_v - q + j, parts.sum())
    }));
    row
}

/// Places inside the spans of a knot vector.
fn places(breakpoints: &[f64]) -> Vec<f64> {
    let inside = |w: &[f64]| {
        let (from, step) = (w[0], (w[1] - w[0]) / PLACES as f64);
        (0..PLACES).map(move |k| from + step * (k as f64 + 0.5)).collect::<Vec<_>>()
    };
    breakpoints.windows(2).flat_map(inside).collect()
}

/// Signs along the lines of the net that are nearest to stations, or to waterlines.
fn signs(parent: &Hull, start: &Hull, station: bool) -> Vec<Candidate> {
    let surface = parent.surface();
    let (us, vs) = (places(&surface.u().breakpoints()), places(&surface.v().breakpoints()));
    let (lines, on) = if station { (us, vs) } else { (vs, us) };
    let mut list = Vec::new();
    for line in lines {
        let at = |place: f64| if station { [line, place] } else { [place, line] };
        let found: Vec<(f64, f64)> =
            on.iter().filter_map(|&place| bend(surface, at(place), station).map(|bend| (place, bend.value))).collect();
        let most = found.iter().map(|(_, value)| value.abs()).fold(0.0, f64::max);
        // A line that is straight to the eye over the whole ship has no sign.
        if most * parent.particulars().length_between_perpendiculars < 1e-6 {
            continue;
        }
        let has = |way: f64| found.iter().any(|(_, value)| way * value > FAINT * most);
        let one_way = has(1.0) != has(-1.0);
        let way = if has(1.0) { 1.0 } else { -1.0 };
        for (place, value) in found {
            let keeps = one_way || value.abs() >= DEFINITE * most;
            let sign = if one_way { way } else { value.signum() };
            let Some(bend) = bend(start.surface(), at(place), station).filter(|_| keeps) else { continue };
            let row = bend.row.into_iter().map(|(k, weight)| (k, sign * weight)).collect();
            list.push(Candidate { kind: Kind::Sign, row, lower: (sign * value).min(0.0), slack: MISSED * most });
        }
    }
    list
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::derivation::samples::{parabolic, tug};

    /// Rows times the net are the curvatures, and the parent keeps to all of its rows.
    #[test]
    fn the_parent_keeps_to_its_rows() {
        for hull in [parabolic(), tug()] {
            let y: Vec<f64> = hull.surface().points().iter().map(|p| p[1]).collect();
            let list = candidates(&hull, &hull);
            assert!(list.iter().filter(|c| c.kind == Kind::Sign).count() > 100);
            for candidate in &list {
                assert!(!candidate.is_missed(&y), "{:?} {}", candidate.kind, candidate.value(&y) - candidate.lower);
            }
        }
    }

    /// Wigley's waterline y = b (1 - X^2) with X = 2 x / L - 1 has y_xx = -8 b / L^2, wherever it is.
    #[test]
    fn curvature_of_a_parabola() {
        let hull = parabolic();
        for [u, v] in [[0.3, 0.5], [0.5, 0.6]] {
            let [x, _, z] = hull.surface().eval(u, v);
            let s = z / 6.25 - 1.0;
            let b = 5.0 * (1.0 - s * s);
            let slope = -b * 2.0 * (2.0 * x / 100.0 - 1.0) * 2.0 / 100.0;
            let expected = -8.0 * b / 1e4 / (1.0 + slope * slope).powf(1.5);
            let found = bend(hull.surface(), [u, v], false).unwrap();
            assert!((found.value - expected).abs() < 1e-9, "{} {expected}", found.value);
        }
    }
}
