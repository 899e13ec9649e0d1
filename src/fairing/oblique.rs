//! Curvature of buttocks and diagonals as linear forms of the half-breadths, near a hull.
//!
//! The curve in which the plane n . S = d, n = (0, n_y, n_z), meets the surface goes, as in [`super::inspect`], along
//! u' = a = -g_v, v' = b = g_u with g = n . S, and
//!
//! ```text
//! P' = a S_u + b S_v,   P'' = a^2 S_uu + 2 a b S_uv + b^2 S_vv + a' S_u + b' S_v,   a' = -(a g_uv + b g_vv),   b' = a g_uu + b g_uv,
//! F = n . (P' x P''),   kappa = F / |P'|^3.
//! ```
//!
//! F is cubic in each derivative of y, so that the curve moves with the net: its tangent at the start stands for it. At
//! a fixed (u, v) it tells of the plane's neighbour through that point, whose signs are those of the curve but where it
//! turns.

use super::bends::{Bend, kept, sites};
use super::inspect::{motion_rates, swept};
use super::model::{Limit, Row, value};
use crate::hull::{Cut, Hull};
use crate::numeric::bracketed_root;
use crate::spline::{BsplineSurface, basis_row, cross, dot, length};

type Point = [f64; 3];

/// The derivatives s\[i\]\[j\] of a surface, up to the second.
type Jet = [[Point; 3]; 3];

/// Orders of the derivatives on which F depends.
const ORDERS: [[usize; 2]; 5] = [[1, 0], [0, 1], [2, 0], [1, 1], [0, 2]];

/// How near a place of a curve is found, in the range between two sites.
const NEAR: f64 = 1e-14;

/// P' and F.
fn bending(jet: &Jet, n: Point) -> (Point, f64) {
    let motion = [-dot(n, jet[0][1]), dot(n, jet[1][0])];
    let [first, second] = swept(jet, motion, motion_rates(jet, n, motion));
    (first, dot(n, cross(first, second)))
}

/// dF by the derivatives of y: differences of four points, which are exact for cubics.
fn gradient(jet: &Jet, n: Point) -> [f64; 5] {
    ORDERS.map(|[i, j]| {
        let step = length(jet[i][j]).max(f64::MIN_POSITIVE);
        let at = |steps: f64| {
            let mut moved = *jet;
            moved[i][j][1] += steps * step;
            bending(&moved, n).1
        };
        (8.0 * (at(1.0) - at(-1.0)) - (at(2.0) - at(-2.0))) / (12.0 * step)
    })
}

/// The bends of a buttock or a diagonal of a surface whose half-breadths are those of `net`, from aft forward; none of
/// other planes.
#[must_use]
pub fn oblique_bends(surface: &BsplineSurface<3>, net: &[f64], cut: Cut) -> Vec<Bend> {
    let Some((n, offset)) = cut.plane().filter(|(n, _)| n[0] == 0.0 && n[1] > 0.0) else { return Vec::new() };
    let height = |u: f64, v: f64| dot(n, surface.eval(u, v)) - offset;
    let (us, vs) = (sites(surface.u()), sites(surface.v()));
    // The crossings of each line of the net; of those that run up, the lowest.
    let mut places: Vec<[f64; 2]> = Vec::new();
    for &u in &us {
        places.extend(crossings(&vs, |v| height(u, v)).first().map(|&v| [u, v]));
    }
    for &v in &vs {
        places.extend(crossings(&us, |u| height(u, v)).into_iter().map(|u| [u, v]));
    }
    let mut bends: Vec<Bend> = places
        .into_iter()
        .filter_map(|at| {
            let jet: Jet = surface.derivatives::<3>(at[0], at[1]);
            if dot(n, jet[0][1]) <= 0.0 {
                return None;
            }
            let (first, bending) = bending(&jet, n);
            let mut numerator: Row = Vec::new();
            for (order, by) in ORDERS.into_iter().zip(gradient(&jet, n)) {
                let row = basis_row(surface, at, order);
                if numerator.is_empty() {
                    numerator = row.iter().map(|&(column, _)| (column, 0.0)).collect();
                }
                numerator.iter_mut().zip(row).for_each(|(sum, (_, value))| sum.1 += by * value);
            }
            let offset = bending - value(&numerator, net);
            Some(Bend { numerator, offset, slope: Row::new(), along: length(first), at: jet[0][0][0] })
        })
        .collect();
    bends.sort_by(|a, b| a.at.total_cmp(&b.at));
    bends
}

/// Where a function of a line's parameter changes its sign between the sites.
fn crossings(sites: &[f64], height: impl Fn(f64) -> f64) -> Vec<f64> {
    let heights: Vec<f64> = sites.iter().map(|&t| height(t)).collect();
    let pairs = sites.windows(2).zip(heights.windows(2));
    let changing = pairs.filter(|(_, ends)| (ends[0] < 0.0) != (ends[1] < 0.0));
    changing
        .filter_map(|(pair, _)| bracketed_root(&height, pair[0], pair[1], NEAR * (pair[1] - pair[0])).ok())
        .collect()
}

/// Limits that keep a buttock or a diagonal at the signs that it has on a hull with the half-breadths `start` ([`kept`]).
#[must_use]
pub fn oblique_limits(hull: &Hull, start: &[f64], cut: Cut, seen: f64) -> Vec<Limit> {
    kept(&oblique_bends(hull.surface(), start, cut), start, seen, false)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spline::KnotVector;

    /// y = 5 + 3 v - (2 u - 1)^2 over x = 100 u, z = 10 v: the buttock is z = 10 (Y - 5 + (2 u - 1)^2) / 3, convex
    /// outward everywhere.
    #[test]
    fn a_buttock_that_is_a_parabola() {
        let knots = || KnotVector::uniform(2, 1).unwrap();
        let points = [1.0, -1.0, 1.0].into_iter().zip(0..3).flat_map(|(bow, i)| {
            (0..3).map(move |j| [50.0 * f64::from(i), 5.0 + 1.5 * f64::from(j) - bow, 5.0 * f64::from(j)])
        });
        let points: Vec<Point> = points.collect();
        let net: Vec<f64> = points.iter().map(|point| point[1]).collect();
        let surface = BsplineSurface::new(knots(), knots(), points).unwrap();
        let bends = oblique_bends(&surface, &net, Cut::Buttock { y: 6.0 });
        assert!(bends.len() >= 3);
        for bend in &bends {
            let (slope, second) = ((80.0 * (bend.at / 100.0) - 40.0) / 300.0, 80.0 / 30000.0);
            let expected = second / (1.0 + slope * slope).powf(1.5);
            assert!((bend.curvature(&net) / expected - 1.0).abs() < 1e-9, "{} {expected}", bend.curvature(&net));
        }
        let limits = kept(&bends, &net, 1e-3, false);
        assert!(limits.iter().all(|limit| limit.upper == f64::INFINITY && value(&limit.row, &net) > limit.lower));
        assert!(oblique_bends(&surface, &net, Cut::Station { x: 50.0 }).is_empty());
    }

    #[test]
    fn the_tangent_of_a_bend() {
        let values = [[9.0, 0.7, 0.2], [0.3, 2.0, 1.5], [0.1, -0.4, 0.05], [0.02, 0.6, -0.1], [0.4, -1.1, 0.3]];
        let mut jet = Jet::default();
        ORDERS.into_iter().zip(values).for_each(|([i, j], value)| jet[i][j] = value);
        let n = [0.0, 0.6, 0.8];
        for ([i, j], by) in ORDERS.into_iter().zip(gradient(&jet, n)) {
            let at = |step: f64| {
                let mut moved = jet;
                moved[i][j][1] += step;
                bending(&moved, n).1
            };
            let expected = (at(1e-4) - at(-1e-4)) / 2e-4;
            assert!((by - expected).abs() < 1e-6 * (1.0 + expected.abs()), "{i} {j}: {by} {expected}");
        }
    }
}
