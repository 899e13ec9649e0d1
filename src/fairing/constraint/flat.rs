//! Flats: y = B/2 over a region of the side, and the edge of the flat of bottom.
//!
//! Every cell of the knots that lies in the region with its corners and its middle is made flat by the control values
//! that act on it, all equal to B/2: there y = B/2 to rounding. The edges of the region are made tangent lines of the
//! net before ([`edged`]): the surface leaves the flat with its slope, and its curvature may jump, as behind a bilge.
//! In cells that lie in the region in part, the offsets of the table in it are held at B/2. The bottom of a hull is
//! plane by construction, so that its flat is held by the half-breadths of the lowest line.
//!
//! A flat that the table shows and nobody declares ([`shown`]) has no edge that is known to better than the spacing of
//! the offsets. It is held a cell of the knots inside of its outermost offsets, so that the surface may leave it in between
//! with continuous curvature: a cubic that is flat up to its last offset swings about those beyond. Tried instead: the
//! outermost offsets held within a millimetre besides (inflections of Series 60 C_B 0.70 81 > 96, C_B 0.75 66 > 74, DTC
//! 257 > 272; Series 60 C_B 0.60 and the VLCC 271 > 343 without the flat, which could not be had then).

use super::super::lines::{LineCourse, LineKind, ProposedLine};
use super::super::model::Limit;
use super::super::proposals::{broken, knots, parameter};
use super::super::surface::{FairSurface, Origin, basis_row};
use super::fixed::held;
use crate::hull::{Hull, HullError};
use std::collections::BTreeSet;

/// Slack of a region \[m\].
const SLACK: f64 = 1e-6;

fn within([from, to]: [f64; 2], value: f64) -> bool {
    (from - SLACK..=to + SLACK).contains(&value)
}

/// The edges of a flat of side.
pub fn edges(x: [f64; 2], z: [f64; 2]) -> [ProposedLine; 4] {
    let edge = |course, at, reach| ProposedLine { kind: LineKind::Tangent, course, at, reach, gain: 0.0 };
    let [station, waterline] = [LineCourse::Station, LineCourse::Waterline];
    [edge(station, x[0], z), edge(station, x[1], z), edge(waterline, z[0], x), edge(waterline, z[1], x)]
}

/// The same surface with the edges of a flat of side as lines along which the curvature may jump.
///
/// # Errors
/// [`HullError`] when the net makes no hull.
pub fn edged(hull: &Hull, edges: &[ProposedLine]) -> Result<Hull, HullError> {
    let mut edged = hull.clone();
    for edge in edges {
        let (from, to) = knots(hull, edge.course).domain();
        let slack = 1e-6 * (to - from);
        if let Some(t) = parameter(&edged, edge).filter(|&t| t > from + slack && t < to - slack) {
            edged = broken(&edged, edge.course, t, edge.kind)?;
        }
    }
    Ok(edged)
}

pub(super) fn side(surface: &FairSurface, x: [f64; 2], z: [f64; 2]) -> Result<Vec<Limit>, String> {
    let net = surface.hull.surface();
    let greatest = 0.5 * surface.hull.particulars().breadth;
    let columns = net.shape()[1];
    let inside = |u: f64, v: f64| {
        let point = net.eval(u, v);
        within(x, point[0]) && within(z, point[2])
    };
    let mut flat: BTreeSet<usize> = BTreeSet::new();
    let (p, q) = (net.u().degree(), net.v().degree());
    for i in net.u().spans() {
        let (a, b) = (net.u().knots()[i], net.u().knots()[i + 1]);
        for j in net.v().spans() {
            let (c, d) = (net.v().knots()[j], net.v().knots()[j + 1]);
            let corners = [(a, c), (a, d), (b, c), (b, d), (0.5 * (a + b), 0.5 * (c + d))];
            if corners.iter().all(|&(u, v)| inside(u, v)) {
                flat.extend((i - p..=i).flat_map(|k| (j - q..=j).map(move |l| k * columns + l)));
            }
        }
    }
    let mut limits: Vec<Limit> =
        flat.iter().map(|&k| Limit { row: vec![(k, 1.0)], lower: greatest, upper: greatest }).collect();
    let offsets = surface.places.iter().zip(&surface.model.readings).filter(|(place, reading)| {
        matches!(place.origin, Origin::HalfBreadth { .. })
            && reading.weight > 0.0
            && within(x, place.x)
            && within(z, place.z)
    });
    for (_, reading) in offsets {
        let covered = reading.row.iter().all(|(k, basis)| *basis == 0.0 || flat.contains(k));
        if !covered {
            limits.push(Limit { row: reading.row.clone(), lower: greatest, upper: greatest });
        }
    }
    if limits.is_empty() {
        return Err(format!(
            "no cell of the net and no offset lies from x = {:.3} to {:.3} m, z = {:.3} to {:.3} m",
            x[0], x[1], z[0], z[1]
        ));
    }
    Ok(limits)
}

pub(super) fn bottom(surface: &FairSurface, x: [f64; 2]) -> Result<Vec<Limit>, String> {
    let net = surface.hull.surface();
    let low = net.v().domain().0;
    let places = net.u().greville().into_iter().map(|u| [u, low]);
    let inside: Vec<[f64; 2]> = places.filter(|[u, v]| within(x, net.eval(*u, *v)[0])).collect();
    let breadth = 1e-6 * surface.hull.particulars().breadth;
    let wide = inside.iter().filter(|[u, v]| net.eval(*u, *v)[1] > breadth).count();
    if wide == 0 {
        return Err(format!("the hull has no flat of bottom from x = {:.3} to {:.3} m", x[0], x[1]));
    }
    Ok(inside.into_iter().map(|place| held(basis_row(net, place, [0, 0]), &surface.start)).collect())
}
