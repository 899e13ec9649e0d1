//! Rules for single lines and regions of a hull: each is a handful of rows over the net, exact where its file says so.

use super::super::bends::Line;
use super::super::model::Limit;
use super::super::surface::FairSurface;
use super::lines::{FixedLine, TangentPlace, along, named, ranged};
use super::{curvature, fixed, flat, monotone, tangent};

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
