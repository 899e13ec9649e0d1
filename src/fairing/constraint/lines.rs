//! The lines and places that rules speak of, and the bends along them.

use super::super::bends::{Bend, Line, bend, inside, moving};
use super::super::surface::FairSurface;

/// A line that stays where the surface through the table has it.
#[derive(Debug, Clone, PartialEq)]
pub enum FixedLine {
    /// A station or a waterline.
    Line(Line),
    /// The edge of the surface at the stem.
    Stem,
    /// The edge of the surface at the stern, or at the transom.
    Stern,
    /// The lower edge of the surface.
    Keel,
    /// The deck at side.
    Deck,
    /// A line of the table, by its name, through its points (x, z) \[m\].
    Named(String, Vec<[f64; 2]>),
}

impl FixedLine {
    /// Whether a place (x, z) \[m\] of the table lies on it, or its offset at the deck at side (`deck`); of stem, stern
    /// and keel no offset is known to lie on them.
    #[must_use]
    pub fn has(&self, [x, z]: [f64; 2], deck: bool) -> bool {
        let near = |a: f64, b: f64| (a - b).abs() <= 1e-9 * (1.0 + b.abs());
        match self {
            Self::Line(Line::Station(at)) => near(*at, x),
            Self::Line(Line::Waterline(at)) => near(*at, z) && !deck,
            Self::Deck => deck,
            Self::Named(_, points) => points.iter().any(|point| near(point[0], x) && near(point[1], z)),
            Self::Stem | Self::Stern | Self::Keel => false,
        }
    }
}

/// Where a tangent is prescribed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum TangentPlace {
    /// The fore end of the waterline at a height \[m\]: half angle of entrance.
    Entrance(f64),
    /// The after end of the waterline at a height \[m\]: half angle of run.
    Run(f64),
    /// The waterline at (x, z) \[m\]: angle from the centreline, positive where the half-breadth rises forward.
    Waterline([f64; 2]),
    /// The station at (x, z) \[m\]: angle from the vertical, positive where the half-breadth rises upward.
    Station([f64; 2]),
}

/// Places in a span at which signs are asked for, besides the ends of the range. Second derivatives of cubics are straight in a
/// span and have no room for another sign. Slopes have no more than a sixteenth of what they change by in it.
pub(super) const PLACES: [f64; 5] = [0.001, 0.25, 0.5, 0.75, 0.999];

/// The bends along a part of a line, its ends among them.
pub(super) fn along(surface: &FairSurface, line: Line, over: [f64; 2]) -> Result<Vec<Bend>, String> {
    let hull = &surface.hull;
    let net = hull.surface();
    let station = matches!(line, Line::Station(_));
    let mut places: Vec<[f64; 2]> = match line {
        Line::Station(x) => {
            let sites = inside(net.v(), &PLACES).into_iter();
            sites.filter_map(|v| Some([hull.length_parameter(x, v)?, v])).collect()
        }
        Line::Waterline(z) => {
            let sites = inside(net.u(), &PLACES).into_iter();
            sites.filter_map(|u| Some([u, hull.height_parameter_at(u, z)?])).collect()
        }
    };
    for end in over.into_iter().filter(|end| end.is_finite()) {
        places.extend(match line {
            Line::Station(x) => hull.parameters(x, end),
            Line::Waterline(z) => hull.parameters(end, z),
        });
    }
    let bends = places.into_iter().filter_map(|at| bend(net, at, station));
    let within = |bend: &Bend| bend.at >= over[0] - 1e-9 && bend.at <= over[1] + 1e-9;
    let mut found = moving(bends.filter(within).collect(), &surface.start);
    found.sort_by(|a, b| a.at.total_cmp(&b.at));
    if found.is_empty() { Err(format!("the surface has no {}", ranged(&line, over))) } else { Ok(found) }
}

pub(super) fn named(line: &Line) -> String {
    match line {
        Line::Station(x) => format!("station at x = {x:.3} m"),
        Line::Waterline(z) => format!("waterline at z = {z:.3} m"),
    }
}

pub(super) fn ranged(line: &Line, [from, to]: [f64; 2]) -> String {
    let axis = if matches!(line, Line::Station(_)) { 'z' } else { 'x' };
    match (from.is_finite(), to.is_finite()) {
        (false, false) => named(line),
        (true, false) => format!("{} from {axis} = {from:.3} m", named(line)),
        (false, true) => format!("{} up to {axis} = {to:.3} m", named(line)),
        (true, true) => format!("{} from {axis} = {from:.3} to {to:.3} m", named(line)),
    }
}
