//! Plane sections of a hull: connected curves, in order, to a stated tolerance.

mod bernstein;
mod clip;
mod closing;
mod contour;
mod field;
mod trace;

use super::form::Hull;
use crate::spline::BsplineCurve;
pub(super) use bernstein::curve_sign_changes;
use bernstein::{Arc, join};
use clip::below_deck;
use closing::{cut_face, line};
use field::Field;

/// A plane that cuts the hull.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Cut {
    /// Transverse plane at `x` \[m\].
    Station {
        /// Position forward of AP \[m\].
        x: f64,
    },
    /// Horizontal plane at `z` \[m\].
    Waterline {
        /// Height above the base line \[m\].
        z: f64,
    },
    /// Longitudinal vertical plane at `y` \[m\].
    Buttock {
        /// Distance from the centreplane \[m\].
        y: f64,
    },
    /// Plane through the line y = 0, z = `height`, going down outboard by `angle` below the horizontal \[rad\].
    Diagonal {
        /// Height on the centreplane \[m\].
        height: f64,
        /// Angle below the horizontal \[rad\], between 0 and pi/2.
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
    /// The bottom across the keel line: the flat of bottom, or a strip that follows the height of the keel.
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
    /// The curve (x, y, z) \[m\], port side.
    pub curve: BsplineCurve<3>,
    /// Whether it closes on itself.
    pub closed: bool,
}

/// All branches of a plane section of one side of the hull, below the deck at side.
#[derive(Debug, Clone, PartialEq)]
pub struct Section {
    /// The plane.
    pub cut: Cut,
    /// The branches: on the side first, from bottom to top (waterlines, buttocks, diagonals: from aft to forward).
    pub branches: Vec<Branch>,
}

impl Branch {
    /// Points on the curve, so dense that the chords between them stay within `deviation` \[m\] of it; the first and
    /// the last are its ends, and no span of the curve is skipped. Arcs are halved until their control points lie
    /// within the deviation of the chord (the curve stays in their convex hull), at most 20 times.
    #[must_use]
    pub fn polyline(&self, deviation: f64) -> Vec<[f64; 3]> {
        let (from, to) = self.curve.knots().domain();
        let points = self.curve.points();
        let mut line = vec![points[0]];
        for arc in Arc::of(&self.curve, from, to) {
            flatten(&arc, deviation, 0, &mut line);
        }
        if let (Some(end), Some(last)) = (line.last_mut(), points.last()) {
            *end = *last;
        }
        line
    }
}

fn flatten(arc: &Arc<3>, deviation: f64, depth: u32, line: &mut Vec<[f64; 3]>) {
    let control = arc.control();
    let (a, b) = (control[0], control[arc.degree]);
    let chord: [f64; 3] = std::array::from_fn(|d| b[d] - a[d]);
    let length = chord.iter().map(|c| c * c).sum::<f64>();
    let flat = control[1..arc.degree].iter().all(|p| {
        let out: [f64; 3] = std::array::from_fn(|d| p[d] - a[d]);
        let r = if length > 0.0 { (0..3).map(|d| out[d] * chord[d]).sum::<f64>() / length } else { 0.0 };
        let r = r.clamp(0.0, 1.0);
        (0..3).map(|d| (out[d] - r * chord[d]).powi(2)).sum::<f64>() <= deviation * deviation
    });
    if flat || depth >= 20 {
        line.push(b);
    } else {
        let [first, second] = arc.split(0.5);
        flatten(&first, deviation, depth + 1, line);
        flatten(&second, deviation, depth + 1, line);
    }
}

impl Cut {
    /// The plane as a unit normal n and an offset d: n . (x, y, z) = d. None when the normal is zero or not finite.
    #[must_use]
    pub fn plane(&self) -> Option<([f64; 3], f64)> {
        let (normal, offset) = match *self {
            Self::Station { x } => ([1.0, 0.0, 0.0], x),
            Self::Waterline { z } => ([0.0, 0.0, 1.0], z),
            Self::Buttock { y } => ([0.0, 1.0, 0.0], y),
            Self::Diagonal { height, angle } => ([0.0, angle.sin(), angle.cos()], height * angle.cos()),
            Self::Plane { normal, offset } => (normal, offset),
        };
        // Scaled by the largest component first, so that squares neither overflow nor vanish.
        let largest = normal.iter().fold(0.0f64, |m, c| m.max(c.abs()));
        if !(largest > 0.0 && largest.is_finite() && offset.is_finite()) {
            return None;
        }
        let normal = normal.map(|c| c / largest);
        let length = normal.iter().map(|c| c * c).sum::<f64>().sqrt();
        Some((normal.map(|c| c / length), offset / largest / length))
    }

    /// A plane along two axes as the station, waterline or buttock that it is; other cuts as they are.
    fn canonical(self) -> Self {
        let Self::Plane { .. } = self else { return self };
        match self.plane() {
            Some(([x, 0.0, 0.0], offset)) => Self::Station { x: offset / x },
            Some(([0.0, y, 0.0], offset)) => Self::Buttock { y: offset / y },
            Some(([0.0, 0.0, z], offset)) => Self::Waterline { z: offset / z },
            _ => self,
        }
    }
}

impl Hull {
    /// The curves in which a plane cuts one side of the body, closing lines on the flats included; deviation from the
    /// surface and from the plane at most `tolerance` \[m\], which is taken as 1e-11 m at least. No branch when the plane
    /// misses the hull or is no plane.
    ///
    /// * A waterline of a level hull and a station of an upright one are the isoparametric curves themselves, of the
    ///   degree of the surface. Other branches on the side are chains of quintics. Branches on flats are exact.
    /// * Where the surface lies in the plane, the branch is the boundary of that part of the surface. The edges of the
    ///   surface count as such: the station at the end of a hull with a transom across is the outline of the transom, the
    ///   buttock at y = 0 the profile.
    /// * Stations run from bottom to top, other branches from aft to forward.
    #[must_use]
    pub fn section(&self, cut: Cut, tolerance: f64) -> Section {
        let tolerance = tolerance.max(1e-11);
        let mut branches = Vec::new();
        let (asked, cut) = (cut, cut.canonical());
        let Some((normal, offset)) = cut.plane() else { return Section { cut: asked, branches } };
        let station = matches!(cut, Cut::Station { .. });
        let mut add = |face: Face, curve: BsplineCurve<3>, closed: bool| {
            for (curve, closed) in below_deck(self, curve, closed, tolerance) {
                branches.push(oriented(Branch { face, curve, closed }, station));
            }
        };
        if self.follows_net(cut) {
            if let Some(curve) = self.net_line(cut) {
                add(Face::Side, curve, false);
            }
        } else {
            // The side on which a plane through an edge of the surface leaves the surface.
            let middle =
                0.5 * (self.surface().point(0, 0)[0] + self.surface().point(self.surface().shape()[0] - 1, 0)[0]);
            let outward = match cut {
                Cut::Station { x } if x < middle => -1.0,
                Cut::Buttock { y } if y <= 0.0 => -1.0,
                Cut::Waterline { z } if z <= self.bottom() => -1.0,
                _ => 1.0,
            };
            let field = Field::new(self.surface(), normal.map(|c| c * outward), offset * outward);
            let (patches, chains) = contour::chains(self.surface(), &field, tolerance);
            for chain in &chains {
                if let Some(curve) = join(&trace::trace(chain, &patches, tolerance)) {
                    add(Face::Side, curve, chain.closed);
                }
            }
        }
        let least = 1e-12 * self.particulars().breadth;
        let ([u0, u1], [v0, _]) =
            ([self.surface().u().domain().0, self.surface().u().domain().1], [self.surface().v().domain().0, 0.0]);
        // A waterline does not meet the flat of bottom of a level hull.
        if !(self.is_level() && matches!(cut, Cut::Waterline { .. })) {
            for curve in cut_face(&self.surface().curve_at_v(v0), normal, offset, least) {
                // A plane meets the plane of the bottom in a straight line, a strip that follows the keel in a curve.
                let points = curve.points();
                let met = if self.is_level() { line(points[0], points[points.len() - 1]) } else { Some(curve) };
                if let Some(curve) = met {
                    add(Face::Bottom, curve, false);
                }
            }
        }
        for (face, u) in [(Face::Transom, u0), (Face::Bow, u1)] {
            for curve in cut_face(&self.surface().curve_at_u(u), normal, offset, least) {
                add(face, curve, false);
            }
        }
        let key = |b: &Branch| {
            let p = b.curve.points()[0];
            if station { [p[2], p[1], p[0]] } else { [p[0], p[2], p[1]] }
        };
        branches.sort_by(|a, b| {
            let order = (a.face as u8).cmp(&(b.face as u8));
            let by_place = key(a).iter().zip(key(b)).map(|(x, y)| x.total_cmp(&y)).find(|o| o.is_ne());
            order.then(by_place.unwrap_or(std::cmp::Ordering::Equal))
        });
        Section { cut: asked, branches }
    }

    /// Whether a plane cuts the side along a line of the net: a waterline of a level hull, a station of an upright one.
    #[must_use]
    pub fn follows_net(&self, cut: Cut) -> bool {
        match cut {
            Cut::Waterline { .. } => self.is_level(),
            Cut::Station { .. } => self.is_upright(),
            _ => false,
        }
    }

    /// That line; none beyond the ends of the surface.
    fn net_line(&self, cut: Cut) -> Option<BsplineCurve<3>> {
        match cut {
            Cut::Waterline { z } => self.height_parameter(z).map(|v| self.surface().curve_at_v(v)),
            Cut::Station { x } => {
                let lowest = self.surface().v().domain().0;
                self.length_parameter(x, lowest).map(|u| self.surface().curve_at_u(u))
            }
            _ => None,
        }
    }
}

/// The branch from bottom to top (stations) or from aft to forward.
fn oriented(branch: Branch, station: bool) -> Branch {
    let points = branch.curve.points();
    let (a, b) = (points[0], points[points.len() - 1]);
    let key = |p: [f64; 3]| if station { [p[2], p[1]] } else { [p[0], p[2]] };
    let (a, b) = (key(a), key(b));
    if branch.closed || a[0] < b[0] || (a[0] <= b[0] && a[1] <= b[1]) {
        return branch;
    }
    let knots = branch.curve.knots();
    let (from, to) = knots.domain();
    let turned = knots.knots().iter().rev().map(|t| from + (to - t)).collect();
    let reversed: Vec<[f64; 3]> = points.iter().rev().copied().collect();
    let curve =
        crate::spline::KnotVector::new(knots.degree(), turned).and_then(|knots| BsplineCurve::new(knots, reversed));
    match curve {
        Ok(curve) => Branch { curve, ..branch },
        Err(_) => branch,
    }
}
