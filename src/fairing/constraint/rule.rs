//! Rules for single lines and regions of a hull: each is a handful of rows over the net, exact where its file says so.

use super::super::bends::{Bend, Line, bend, inside, moving};
use super::super::model::Limit;
use super::super::surface::FairSurface;
use super::{curvature, fixed, flat, monotone, tangent};

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

/// A wish for a line or a region.
#[derive(Debug, Clone, PartialEq)]
pub enum Rule {
    /// A line that does not move.
    Fixed(FixedLine),
    /// A tangent, with its angle \[rad\].
    Tangent(TangentPlace, f64),
    /// A flat of side: y = B/2 over a range of x and a range of z \[m\].
    FlatOfSide {
        /// From and to, forward of AP \[m\].
        x: [f64; 2],
        /// From and to, above the base line \[m\].
        z: [f64; 2],
    },
    /// The edge of the flat of bottom stays where it is over a range of x \[m\].
    FlatOfBottom {
        /// From and to, forward of AP \[m\].
        x: [f64; 2],
    },
    /// The half-breadth rises or falls: forward along a waterline, upward along a station.
    Monotone {
        /// Which line.
        line: Line,
        /// From and to along the line: x of a waterline, z of a station \[m\].
        over: [f64; 2],
        /// Whether it rises.
        rising: bool,
    },
    /// The line is convex (full, as seen from outside) or concave (hollow).
    Curvature {
        /// Which line.
        line: Line,
        /// From and to along the line \[m\].
        over: [f64; 2],
        /// Whether it is convex.
        convex: bool,
    },
    /// A line has no more than so many inflections.
    Inflections {
        /// Which line.
        line: Line,
        /// From and to along the line, infinite for all of it \[m\].
        over: [f64; 2],
        /// The greatest number.
        most: usize,
    },
}

fn named(line: &Line) -> String {
    match line {
        Line::Station(x) => format!("station at x = {x:.3} m"),
        Line::Waterline(z) => format!("waterline at z = {z:.3} m"),
    }
}

fn ranged(line: &Line, [from, to]: [f64; 2]) -> String {
    let axis = if matches!(line, Line::Station(_)) { 'z' } else { 'x' };
    match (from.is_finite(), to.is_finite()) {
        (false, false) => named(line),
        (true, false) => format!("{} from {axis} = {from:.3} m", named(line)),
        (false, true) => format!("{} up to {axis} = {to:.3} m", named(line)),
        (true, true) => format!("{} from {axis} = {from:.3} to {to:.3} m", named(line)),
    }
}

impl Rule {
    /// The unit of its rows, after a number.
    #[must_use]
    pub fn unit(&self) -> &'static str {
        match self {
            Self::Tangent(..) | Self::Monotone { .. } => " in slope",
            Self::Curvature { .. } | Self::Inflections { .. } => " m of one control half-breadth",
            _ => " m of half-breadth",
        }
    }

    /// Name in files.
    #[must_use]
    pub fn key(&self) -> &'static str {
        match self {
            Self::Fixed(_) => "fixed_line",
            Self::Tangent(..) => "tangent",
            Self::FlatOfSide { .. } => "flat_of_side",
            Self::FlatOfBottom { .. } => "flat_of_bottom",
            Self::Monotone { rising: true, .. } => "rising",
            Self::Monotone { .. } => "falling",
            Self::Curvature { convex: true, .. } => "convex",
            Self::Curvature { .. } => "concave",
            Self::Inflections { .. } => "inflections",
        }
    }

    /// In words, for people.
    #[must_use]
    pub fn words(&self) -> String {
        match self {
            Self::Fixed(line) => match line {
                FixedLine::Line(line) => format!("the {} fixed", named(line)),
                FixedLine::Stem => "the stem fixed".to_owned(),
                FixedLine::Stern => "the stern fixed".to_owned(),
                FixedLine::Keel => "the keel line fixed".to_owned(),
                FixedLine::Deck => "the deck at side fixed".to_owned(),
                FixedLine::Named(name, _) => format!("the line {name} fixed"),
            },
            Self::Tangent(place, angle) => {
                let angle = angle.to_degrees();
                match place {
                    TangentPlace::Entrance(z) => format!("the half angle of entrance {angle:.2} deg at z = {z:.3} m"),
                    TangentPlace::Run(z) => format!("the half angle of run {angle:.2} deg at z = {z:.3} m"),
                    TangentPlace::Waterline([x, z]) => {
                        format!("the waterline at {angle:.2} deg from the centreline at x = {x:.3} m, z = {z:.3} m")
                    }
                    TangentPlace::Station([x, z]) => {
                        format!("the station at {angle:.2} deg from the vertical at x = {x:.3} m, z = {z:.3} m")
                    }
                }
            }
            Self::FlatOfSide { x, z } => {
                format!("the flat of side from x = {:.3} to {:.3} m, z = {:.3} to {:.3} m", x[0], x[1], z[0], z[1])
            }
            Self::FlatOfBottom { x } => format!("the flat of bottom from x = {:.3} to {:.3} m", x[0], x[1]),
            Self::Monotone { line, over, rising } => {
                format!("the {} {}", ranged(line, *over), if *rising { "rising" } else { "falling" })
            }
            Self::Curvature { line, over, convex } => {
                format!("the {} {}", ranged(line, *over), if *convex { "convex" } else { "concave" })
            }
            Self::Inflections { line, over, most } => {
                let count = match most {
                    0 => "without inflections".to_owned(),
                    1 => "with one inflection at most".to_owned(),
                    _ => format!("with {most} inflections at most"),
                };
                format!("the {} {count}", ranged(line, *over))
            }
        }
    }

    /// Whether the rule lets a place (x, z) \[m\] of the table, or its offset at the deck at side (`deck`), not move.
    #[must_use]
    pub fn fixes(&self, place: [f64; 2], deck: bool) -> bool {
        matches!(self, Self::Fixed(line) if line.has(place, deck))
    }

    /// The line whose inflections the rule decides, which nothing else should; none where it decides a part of it.
    #[must_use]
    pub fn counted_line(&self) -> Option<Line> {
        match self {
            Self::Inflections { line, over: [from, to], .. } if from.is_infinite() && to.is_infinite() => Some(*line),
            _ => None,
        }
    }

    /// The rows of the rule; of [`Self::Inflections`], whose rows depend on an answer, none.
    ///
    /// # Errors
    /// In words, what the hull has instead of the place that the rule names.
    pub fn limits(&self, surface: &FairSurface) -> Result<Vec<Limit>, String> {
        match self {
            Self::Fixed(line) => fixed::limits(surface, line),
            Self::Tangent(place, angle) => tangent::limits(surface, *place, *angle),
            Self::FlatOfSide { x, z } => flat::side(surface, *x, *z),
            Self::FlatOfBottom { x } => flat::bottom(surface, *x),
            Self::Monotone { line, over, rising } => monotone::limits(surface, *line, *over, *rising),
            Self::Curvature { line, over, convex } => curvature::limits(surface, *line, *over, *convex),
            Self::Inflections { line, over, .. } => along(surface, *line, *over).map(|_| Vec::new()),
        }
    }
}

/// Places in a span at which signs are asked for: with the ends of the range these leave second derivatives of cubics,
/// which are straight in a span, no room for another sign, and slopes no more than a sixteenth of what they change by
/// in it.
const PLACES: [f64; 5] = [0.001, 0.25, 0.5, 0.75, 0.999];

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
