//! Lines that do not move: y = y_start along a line of the surface.
//!
//! Edges of the net are held by their control values. Along any other line y is held at the Greville points of the
//! parameter that runs along it: where the line is a line of the parameters (stations of an upright chart, waterlines
//! of a level one, knuckles) as many conditions as the curve has control values, so that it is held exactly (Schoenberg
//! & Whitney 1953); elsewhere at those points.

use super::super::bends::Line;
use super::super::model::{Limit, Row, value};
use super::super::surface::{FairSurface, basis_row};
use super::lines::FixedLine;

/// A line whose points differ by less than this part of the domain in v is a line of the net.
const SAME: f64 = 1e-6;

/// y stays what the start has.
pub(super) fn held(row: Row, start: &[f64]) -> Limit {
    let y = value(&row, start);
    Limit { row, lower: y, upper: y }
}

/// Control values of an edge of a net, by their numbers; none of other lines.
fn edge(line: &FixedLine, [rows, columns]: [usize; 2]) -> Option<Vec<usize>> {
    match line {
        FixedLine::Stern => Some((0..columns).collect()),
        FixedLine::Stem => Some(((rows - 1) * columns..rows * columns).collect()),
        FixedLine::Keel => Some((0..rows).map(|i| i * columns).collect()),
        _ => None,
    }
}

/// Each control value once.
fn values(surface: &FairSurface, indices: impl IntoIterator<Item = usize>) -> Vec<Limit> {
    indices.into_iter().map(|i| held(vec![(i, 1.0)], &surface.start)).collect()
}

pub(super) fn limits(surface: &FairSurface, line: &FixedLine) -> Result<Vec<Limit>, String> {
    let hull = &surface.hull;
    let net = hull.surface();
    let [rows, columns] = net.shape();
    let start = &surface.start;
    let at = |places: Vec<[f64; 2]>| -> Vec<Limit> {
        places.into_iter().map(|place| held(basis_row(net, place, [0, 0]), start)).collect()
    };
    let (us, vs) = (net.u().greville(), net.v().greville());
    let top = net.v().domain().1;
    if let Some(edge) = edge(line, [rows, columns]) {
        return Ok(values(surface, edge));
    }
    match line {
        FixedLine::Stern | FixedLine::Stem | FixedLine::Keel => Ok(Vec::new()),
        FixedLine::Deck => {
            let deck = |u: f64| {
                let mut v = top;
                // The deck is a curve over x, and x may lean with v.
                for _ in 0..6 {
                    v = hull.height_parameter_at(u, hull.deck_height(net.eval(u, v)[0])).unwrap_or(top);
                }
                [u, v]
            };
            let places: Vec<[f64; 2]> = us.into_iter().map(deck).collect();
            if places.iter().all(|place| place[1] >= top) {
                return Ok(values(surface, (0..rows).map(|i| i * columns + columns - 1)));
            }
            Ok(at(places))
        }
        FixedLine::Line(Line::Station(x)) => {
            let places: Vec<_> = vs.into_iter().filter_map(|v| Some([hull.length_parameter(*x, v)?, v])).collect();
            if places.is_empty() { Err(format!("the surface has no station at x = {x:.3} m")) } else { Ok(at(places)) }
        }
        FixedLine::Line(Line::Waterline(z)) => {
            let places: Vec<_> = us.into_iter().filter_map(|u| Some([u, hull.height_parameter_at(u, *z)?])).collect();
            if places.is_empty() {
                Err(format!("the surface has no waterline at z = {z:.3} m"))
            } else {
                Ok(at(places))
            }
        }
        FixedLine::Named(name, points) => {
            let places: Vec<[f64; 2]> = points.iter().filter_map(|[x, z]| hull.parameters(*x, *z)).collect();
            let Some(first) = places.first() else {
                return Err(format!("the line {name} does not lie on the surface"));
            };
            let domain = net.v().domain();
            let slack = SAME * (domain.1 - domain.0);
            if places.iter().all(|place| (place[1] - first[1]).abs() <= slack) {
                let (from, to) = places
                    .iter()
                    .fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), place| (a.min(place[0]), b.max(place[0])));
                let inside = us.into_iter().filter(|u| (from - SAME..=to + SAME).contains(u));
                return Ok(at(inside.map(|u| [u, first[1]]).collect()));
            }
            Ok(at(places))
        }
    }
}
