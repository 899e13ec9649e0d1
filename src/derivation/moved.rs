//! Lines at prescribed places: what lies at a height, or a position, of the scaled parent comes to another one.
//!
//! Each control point moves by d(z), or d(x). At stated places d is the stated move; between two places it is
//!
//! ```text
//! d = d_0 + (d_1 - d_0) q(s),   q = s^3 (10 - 15 s + 6 s^2),   s = (z - z_0) / (z_1 - z_0)
//! ```
//!
//! The map z + d(z) is twice differentiable and level about each line. It rises as long as d_1 - d_0 > -(z_1 - z_0) / 1.875.
//! Bottom, T and deck stay where nothing is stated there, and so do the ends and midship: T and midship only as far as the moves
//! leave room. A line of the net at one height, as a level knuckle is or the edge of a transom at one x, moves exactly. A
//! line that rises moves as its control points do.

use super::refusal::Refusal;
use crate::hull::Hull;
use crate::spline::{BsplineCurve, BsplineSurface};

/// Least slope of d between two places: the map keeps a sixteenth of its own there.
const LEAST_SLOPE: f64 = -0.5;
/// Part of the length within which an end moves with a line.
const NEAR_END: f64 = 0.05;
/// Part of the extent within which two places are one.
const SAME: f64 = 1e-9;

/// A place \[m\] with its move.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Node {
    at: f64,
    by: f64,
    is_stated: bool,
}

/// The moves of one coordinate.
#[derive(Debug, Clone, PartialEq)]
struct Moves(Vec<Node>);

impl Moves {
    /// With places that stay: those of `fixed`, and those of `optional` where they leave room.
    ///
    /// # Errors
    /// What is wrong, in words, with what helps.
    fn new(
        stated: &[[f64; 2]],
        fixed: &[f64],
        optional: &[f64],
        extent: f64,
        what: &str,
    ) -> Result<Self, (String, String)> {
        let mut nodes: Vec<Node> =
            stated.iter().map(|[from, to]| Node { at: *from, by: to - from, is_stated: true }).collect();
        let is_near = |nodes: &[Node], at: f64| nodes.iter().any(|node| (node.at - at).abs() <= SAME * extent);
        for &at in fixed {
            if !is_near(&nodes, at) {
                nodes.push(Node { at, by: 0.0, is_stated: false });
            }
        }
        nodes.sort_by(|a, b| a.at.total_cmp(&b.at));
        if let Some(pair) = nodes.windows(2).find(|pair| pair[1].at - pair[0].at <= SAME * extent) {
            return Err((format!("the {what} {:.3} m is moved twice", pair[0].at), "Leave one of them out".to_owned()));
        }
        for &at in optional {
            let mut with = nodes.clone();
            with.push(Node { at, by: 0.0, is_stated: false });
            with.sort_by(|a, b| a.at.total_cmp(&b.at));
            if !is_near(&nodes, at) && folds(&with).is_none() {
                nodes = with;
            }
        }
        let Some(k) = folds(&nodes) else { return Ok(Self(nodes)) };
        let k = if nodes[k].is_stated { k } else { k + 1 };
        let node = nodes[k];
        let side = |other: Option<&Node>, way: f64| {
            other.map(|other| other.by + way * LEAST_SLOPE.abs() * (other.at - node.at).abs())
        };
        let low = side(k.checked_sub(1).and_then(|before| nodes.get(before)), -1.0);
        let high = side(nodes.get(k + 1), 1.0);
        let [low, high] = [low, high].map(|by| by.map(|by| format!("{:.3}", node.at + by)));
        let within = match (low, high) {
            (Some(low), Some(high)) => format!("Give {low} to {high} m"),
            (Some(low), None) => format!("Give {low} m or more"),
            (None, Some(high)) => format!("Give {high} m or less"),
            (None, None) => "Leave it out".to_owned(),
        };
        let message = format!("moved from {what} {:.3} to {:.3} m, lines pass each other", node.at, node.at + node.by);
        Err((message, within))
    }

    fn at(&self, t: f64) -> f64 {
        let nodes = &self.0;
        let next = nodes.partition_point(|node| node.at <= t);
        let Some(before) = next.checked_sub(1).map(|k| nodes[k]) else {
            return t + nodes.first().map_or(0.0, |n| n.by);
        };
        let Some(after) = nodes.get(next) else { return t + before.by };
        let s = (t - before.at) / (after.at - before.at);
        let part = s.powi(3) * (10.0 - 15.0 * s + 6.0 * s * s);
        t + before.by + (after.by - before.by) * part
    }
}

/// The first interval between places on which the map would fold.
fn folds(nodes: &[Node]) -> Option<usize> {
    nodes.windows(2).position(|pair| pair[1].by - pair[0].by < LEAST_SLOPE * (pair[1].at - pair[0].at))
}

/// The hull with lines moved: pairs (from, to) of heights and of positions \[m\].
///
/// # Errors
/// E421 for places that are not on the hull, E420 where lines would pass each other, with the nearest that do not.
pub(super) fn with_moves(hull: &Hull, heights: &[[f64; 2]], positions: &[[f64; 2]]) -> Result<Hull, Refusal> {
    if heights.is_empty() && positions.is_empty() {
        return Ok(hull.clone());
    }
    let p = hull.particulars();
    let (bottom, depth) = (hull.bottom(), p.depth);
    let xs = hull.surface().points().iter().map(|point| point[0]);
    let (aft, fore) = (xs.clone().fold(f64::INFINITY, f64::min), xs.fold(f64::NEG_INFINITY, f64::max));
    for (word, list, low, high, help) in [
        ("move-height", heights, bottom, depth, "; the deck line moves with --depth"),
        ("move-position", positions, aft, fore, ""),
    ] {
        let slack = SAME * (high - low);
        let is_deck = |from: f64| word == "move-height" && from >= high - slack;
        if let Some([from, _]) =
            list.iter().find(|[from, _]| !(low - slack..=high + slack).contains(from) || is_deck(*from))
        {
            let message = format!("nothing of the hull is moved from {from:.3} m");
            let remedy = format!("Give a place from {low:.3} m to below {high:.3} m{help}");
            return Err(Refusal::new("E421", vec![word], message, remedy));
        }
    }
    let refused = |word: &'static str| {
        move |(message, remedy): (String, String)| Refusal::new("E420", vec![word], message, remedy)
    };
    let waterline: Vec<f64> = p.draught.into_iter().filter(|t| *t < depth).collect();
    let up = Moves::new(heights, &[bottom, depth], &waterline, depth - bottom, "height");
    let up = up.map_err(refused("move-height"))?;
    let near = NEAR_END * p.length_between_perpendiculars;
    let ends: Vec<f64> =
        [aft, fore].into_iter().filter(|end| positions.iter().all(|[from, _]| (from - end).abs() > near)).collect();
    let midship = [0.5 * p.length_between_perpendiculars];
    let along = Moves::new(positions, &ends, &midship, fore - aft, "position").map_err(refused("move-position"))?;
    let surface = hull.surface();
    let points = surface.points().iter().map(|[x, y, z]| [along.at(*x), *y, up.at(*z)]).collect();
    let deck = hull.deck().points().iter().map(|[x, z]| [along.at(*x), up.at(*z)]).collect();
    let surface = BsplineSurface::new(surface.u().clone(), surface.v().clone(), points);
    let surface = surface.map_err(|error| Refusal::hull(&error))?;
    let deck = BsplineCurve::new(hull.deck().knots().clone(), deck).map_err(|error| Refusal::hull(&error))?;
    Hull::new(hull.name(), *p, surface, deck).map_err(|error| Refusal::hull(&error))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::derivation::samples::tug;

    #[test]
    fn maps_are_exact_at_their_places_and_rise() {
        let moves = Moves::new(&[[3.0, 3.4], [1.0, 0.8]], &[0.0, 5.0], &[2.0], 5.0, "height").unwrap();
        for (from, to) in [(0.0, 0.0), (1.0, 0.8), (2.0, 2.0), (3.0, 3.4), (5.0, 5.0), (6.0, 6.0), (-1.0, -1.0)] {
            assert!((moves.at(from) - to).abs() < 1e-15, "{from}");
        }
        let step = 1e-3;
        assert!((0..5000).all(|k| moves.at(f64::from(k + 1) * step) > moves.at(f64::from(k) * step)));
    }

    /// Lines of the net at one height move exactly, the rest of the profile with them; T stays where there is room.
    #[test]
    fn a_level_line_of_the_net_moves_exactly() {
        let parent = tug();
        let columns = parent.surface().shape()[1];
        let from = parent.surface().point(0, columns - 4)[2];
        let hull = with_moves(&parent, &[[from, from + 0.1]], &[]).unwrap();
        let moved = hull.surface().point(0, columns - 4)[2];
        assert!(((moved - from) - 0.1).abs() < 1e-12 && (hull.top() - parent.top()).abs() < 1e-12);
        let refused = with_moves(&parent, &[[4.0, 4.75]], &[]).unwrap_err();
        // Half of the way to the deck at 4.8 m.
        assert!(refused.code == "E420" && refused.remedy.contains("to 4.400 m"), "{refused:?}");
        let outside = with_moves(&parent, &[], &[[80.0, 81.0]]).unwrap_err();
        assert!(outside.code == "E421", "{outside:?}");
    }
}
