//! A closed mesh of triangles over the body of a hull, up to its deck.
//!
//! Vertices lie on the surface. The mesh begins as a grid of its parameters (`start`), each span of the knots cut into
//! as many parts as the second derivatives ask for: a triangle over a cell of h by k parameters is off the surface by
//! at most
//!
//! ```text
//! (h^2 |S_uu| + 2 h k |S_uv| + k^2 |S_vv|) / 8,
//! ```
//!
//! of which each of the three terms gets a third of the tolerance, with the largest derivatives at points of each span.
//! The triangles are then brought into shape (`shape`), so that their angles are [`LEAST_ANGLE`] or more and they are
//! off the surface by at most half of the tolerance, as seen at their middles and those of their sides (the whole of it
//! for the last few that have no such angles otherwise). Halving the tolerance therefore halves the error of the
//! volume: second order in the length of edges. Where the surface has a crease, it is an edge of the mesh; above the
//! last knuckle, or three quarters of the height, below a deck that cuts the surface, rows are drawn down to the deck.
//!
//! The faces that close the body (bottom, transom, flat bow, deck) are ruled between the two sides and share their
//! vertices. What is narrower than half of the tolerance has no face.

mod body;
mod centreplane;
mod change;
mod half;
mod mirror;
mod shape;
mod start;

use self::body::Body;
use self::half::{Half, least_sine};
use super::form::Hull;
use super::functional::Functional;
use crate::spline::{cross, dot, length, minus};
use std::collections::{HashMap, HashSet};

/// The least angle of a triangle of a [`HullMesh`], but at corners of the body that are sharper: 15 degrees \[rad\].
pub const LEAST_ANGLE: f64 = 15.0 * std::f64::consts::PI / 180.0;

/// Points of a span at which second derivatives are looked at, from its first knot to its last.
const SITES: [f64; 5] = [0.0, 0.25, 0.5, 0.75, 1.0];

/// Most parts of a span.
const MOST_PARTS: usize = 20_000;

/// Most triangles of a mesh.
const MOST_TRIANGLES: usize = 4_000_000;

/// Why there is no mesh.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum MeshError {
    /// The tolerance is too small for the hull.
    #[error("the mesh would have {count} triangles, expected at most {MOST_TRIANGLES}")]
    TooMany {
        /// The triangles that there would be on the hull.
        count: usize,
    },
}

/// Which face of the body a triangle belongs to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Region {
    /// The surface of the hull, both sides.
    Hull,
    /// The flat of bottom, or the strip across the keel line.
    Bottom,
    /// The transom.
    Transom,
    /// A flat bow.
    Bow,
    /// The deck.
    Deck,
    /// The cut along the centreplane, of half a body.
    Centreplane,
}

impl Region {
    /// All of them, in the order of files.
    pub const ALL: [Self; 6] = [Self::Hull, Self::Bottom, Self::Transom, Self::Bow, Self::Deck, Self::Centreplane];

    /// Its name in files.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Hull => "hull",
            Self::Bottom => "bottom",
            Self::Transom => "transom",
            Self::Bow => "bow",
            Self::Deck => "deck",
            Self::Centreplane => "centreplane",
        }
    }
}

/// A closed mesh of triangles, normals outward (right-hand rule).
#[derive(Debug, Clone, PartialEq, Default)]
pub struct HullMesh {
    /// Vertices \[m\], each once.
    pub vertices: Vec<[f64; 3]>,
    /// Triangles as indices of vertices, by region in the order of [`Region::ALL`].
    pub triangles: Vec<(Region, [usize; 3])>,
    /// Corners of the body at which a triangle has an angle of less than [`LEAST_ANGLE`].
    #[doc(hidden)]
    pub sharp_corners: Vec<SharpCorner>,
}

/// A corner of a face of the body that is sharper than [`LEAST_ANGLE`]: a triangle must be as sharp there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SharpCorner {
    /// Index of its vertex.
    pub vertex: usize,
    /// The face.
    pub region: Region,
    /// Its angle in the mesh \[rad\].
    pub angle: f64,
}

/// What is known of a mesh without its origin.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeshReport {
    /// Every edge belongs to two triangles that run through it in opposite directions.
    pub closed: bool,
    /// Edges.
    pub edges: usize,
    /// Edges that belong to one triangle, or to more than two.
    pub open_edges: usize,
    /// Smallest angle of a triangle \[rad\].
    pub least_angle: f64,
    /// Volume (1/6) sum of a.(b x c) \[m^3\].
    pub volume: f64,
    /// Area of all triangles \[m^2\].
    pub area: f64,
}

/// Parameters of the lines of the grid in u and in v.
fn lines(hull: &Hull, deviation: f64) -> [Vec<f64>; 2] {
    let surface = hull.surface();
    let breaks = [surface.u().breakpoints(), surface.v().breakpoints()];
    let mut parts = [vec![1_usize; breaks[0].len() - 1], vec![1_usize; breaks[1].len() - 1]];
    for i in 0..parts[0].len() {
        for j in 0..parts[1].len() {
            let (u0, v0) = (breaks[0][i], breaks[1][j]);
            let [h, k] = [breaks[0][i + 1] - u0, breaks[1][j + 1] - v0];
            let mut bend = [0.0_f64; 3];
            for s in SITES {
                for t in SITES {
                    // Not quite on the last knot, where the next span begins.
                    let at = [u0 + h * s.min(1.0 - 1e-9), v0 + k * t.min(1.0 - 1e-9)];
                    let d = surface.derivatives::<3>(at[0], at[1]);
                    bend[0] = bend[0].max(length(d[2][0]) * h * h);
                    bend[1] = bend[1].max(length(d[1][1]) * h * k);
                    bend[2] = bend[2].max(length(d[0][2]) * k * k);
                }
            }
            // Terms of the head, each a third.
            let third = deviation / 3.0;
            let mut m = (bend[0] / (8.0 * third)).sqrt();
            let mut n = (bend[2] / (8.0 * third)).sqrt();
            let twist = bend[1] / (4.0 * third) / (m.max(1.0) * n.max(1.0));
            if twist > 1.0 {
                m = m.max(1.0) * twist.sqrt();
                n = n.max(1.0) * twist.sqrt();
            }
            let whole = |x: f64| (x.ceil().max(1.0) as usize).min(MOST_PARTS);
            parts[0][i] = parts[0][i].max(whole(m));
            parts[1][j] = parts[1][j].max(whole(n));
        }
    }
    let cut = |breaks: &[f64], parts: &[usize]| -> Vec<f64> {
        let inner = breaks.windows(2).zip(parts).flat_map(|(w, &count)| {
            let (from, width) = (w[0], w[1] - w[0]);
            (0..count).map(move |k| from + width * k as f64 / count as f64)
        });
        inner.chain(breaks.last().copied()).collect()
    };
    [cut(&breaks[0], &parts[0]), cut(&breaks[1], &parts[1])]
}

/// How far a point of the surface lies above the deck \[m\].
fn above_deck(hull: &Hull, [u, v]: [f64; 2]) -> f64 {
    let [x, _, z] = hull.surface().point_of_many(u, v);
    z - hull.deck_height(x)
}

/// The parameter v at which the line `u` passes the deck at side, its upper end where it stays below.
pub(super) fn deck_parameter(hull: &Hull, u: f64) -> f64 {
    let surface = hull.surface();
    let (mut low, mut high) = surface.v().domain();
    let above = |v: f64| above_deck(hull, [u, v]);
    let slack = 1e-9 * (hull.top() - hull.bottom());
    if above(high) <= slack {
        return high;
    }
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            break;
        }
        if above(middle) > 0.0 { high = middle } else { low = middle }
    }
    0.5 * (low + high)
}

impl HullMesh {
    /// A mesh that leaves the surface by at most `deviation` \[m\], about (see the head); edges on the faces that close
    /// it are at most about their breadth over `across`, or as the angles want it.
    ///
    /// Mirrored exactly: for each vertex (x, y, z) there is (x, -y, z).
    ///
    /// # Errors
    /// [`MeshError::TooMany`] when it would have more than 4,000,000 triangles; nothing of that size is laid out.
    pub fn new(hull: &Hull, deviation: f64, across: usize) -> Result<Self, MeshError> {
        Self::made(hull, deviation, across, mirror::whole)
    }

    /// The half y >= 0 of such a mesh, closed by a face on the centreplane, whose triangles keep no bound of their angles.
    ///
    /// # Errors
    /// As for [`Self::new`].
    pub fn half(hull: &Hull, deviation: f64, across: usize) -> Result<Self, MeshError> {
        Self::made(hull, deviation, across, centreplane::closed)
    }

    fn made(hull: &Hull, deviation: f64, across: usize, make: fn(&Half<'_>) -> Self) -> Result<Self, MeshError> {
        let [us, ws] = lines(hull, deviation);
        let across = across.max(1).div_ceil(2);
        let strips = 4 * across * (us.len() + ws.len());
        let count = 4 * (us.len() - 1) * (ws.len() - 1) + strips;
        if count > MOST_TRIANGLES {
            return Err(MeshError::TooMany { count });
        }
        let body = Body::new(hull, &us);
        let mut half = start::half(&body, [&us, &ws], deviation, across);
        half.shape();
        Ok(make(&half))
    }

    /// Triangles with an angle of less than [`LEAST_ANGLE`] that stand at none of the sharp corners: 0 but where the
    /// surface itself is folded, as one laid through a table may be.
    #[must_use]
    pub fn slivers(&self) -> usize {
        let known: HashSet<(usize, Region)> = self.sharp_corners.iter().map(|c| (c.vertex, c.region)).collect();
        let is_sliver = |(region, corners): &&(Region, [usize; 3])| {
            let (sine, at) = least_sine(corners.map(|k| self.vertices[k]));
            *region != Region::Centreplane && sine < LEAST_ANGLE.sin() && !known.contains(&(corners[at], *region))
        };
        self.triangles.iter().filter(is_sliver).count()
    }

    /// Checks closure and measures.
    #[must_use]
    #[doc(hidden)]
    pub fn report(&self) -> MeshReport {
        measure(&self.vertices, self.triangles.iter().map(|(_, corners)| *corners))
    }
}

/// Checks closure of triangles and measures them.
pub(super) fn measure(vertices: &[[f64; 3]], triangles: impl Iterator<Item = [usize; 3]>) -> MeshReport {
    let mut edges: HashMap<(usize, usize), [usize; 2]> = HashMap::new();
    let (mut volume, mut area, mut least_angle) = (0.0, 0.0, std::f64::consts::PI);
    for corners in triangles {
        let [a, b, c] = corners.map(|k| vertices[k]);
        volume += dot(a, cross(b, c)) / 6.0;
        area += 0.5 * length(cross(minus(b, a), minus(c, a)));
        for (p, q, r) in [(a, b, c), (b, c, a), (c, a, b)] {
            let (s, t) = (minus(q, p), minus(r, p));
            least_angle = least_angle.min(length(cross(s, t)).atan2(dot(s, t)));
        }
        for k in 0..3 {
            let (p, q) = (corners[k], corners[(k + 1) % 3]);
            edges.entry((p.min(q), p.max(q))).or_default()[usize::from(p > q)] += 1;
        }
    }
    let open_edges = edges.values().filter(|uses| **uses != [1, 1]).count();
    let closed = edges.values().all(|uses| uses[0] == uses[1]) && !edges.is_empty();
    MeshReport { closed, edges: edges.len(), open_edges, least_angle, volume, area }
}

/// The volume \[m^3\] of the body up to its deck, from the rows over the net.
#[must_use]
pub fn whole_volume(hull: &Hull) -> f64 {
    Functional::Volume.value(hull, hull.top() + (hull.top() - hull.bottom()))
}

#[cfg(test)]
mod tests;
