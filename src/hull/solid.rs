//! The body of a hull as a closed solid of untrimmed B-spline faces that share their edges, for CAD.
//!
//! The two sides are the surface itself and its mirror image. Their edges are cut where they leave the centreplane: a piece on it is
//! shared by both sides, any other piece has its mirror image and a ruled face between the two (bottom, transom, flat bow, deck).
//! Every face is run so that its normal S_u x S_v points out of the body, and its loop counter-clockwise seen from outside.
//!
//! Where the deck at side cuts the surface, the part below it has no exact B-spline: it is interpolated on a net of
//! [`FINENESS`] times the spans, and what the new surface leaves the old one by is told. Where the surface goes through the
//! centreplane its net ends there, so that the sides do not go through each other; that is told as well.

use super::form::Hull;
use super::mesh::Region;
use crate::spline::{BsplineCurve, BsplineSurface, KnotVector, SplineError};

/// Half-breadths below this part of the greatest are on the centreplane.
const CENTREPLANE: f64 = 1e-9;

/// Points closer than this part of the length of the hull are one.
const SAME: f64 = 1e-9;

/// Intervals of a span in which a surface is looked at.
const SAMPLES: usize = 6;

/// Spans for one span where the surface is interpolated below its deck.
const FINENESS: usize = 6;

/// A curve between two vertices.
#[derive(Debug, Clone, PartialEq)]
pub struct Edge {
    /// Index of the vertex where it begins.
    pub from: usize,
    /// Index of the vertex where it ends.
    pub to: usize,
    /// The curve \[m\].
    pub curve: BsplineCurve<3>,
}

/// An untrimmed face.
#[derive(Debug, Clone, PartialEq)]
pub struct SolidFace {
    /// What it is.
    pub region: Region,
    /// Its name: hull port, hull starboard, transom ...
    pub name: String,
    /// The surface \[m\]; S_u x S_v points out.
    pub surface: BsplineSurface<3>,
    /// Edges in turn, and whether they are run forward; edges that shrink to a point are left out.
    pub boundary: Vec<(usize, bool)>,
}

/// A closed body.
#[derive(Debug, Clone, PartialEq)]
pub struct Solid {
    /// Vertices \[m\].
    pub vertices: Vec<[f64; 3]>,
    /// Edges, each used by two faces in opposite directions.
    pub edges: Vec<Edge>,
    /// Faces.
    pub faces: Vec<SolidFace>,
    /// What the sides leave the surface of the hull by \[m\]: 0, or what was measured where the deck or the centreplane cuts it.
    pub deviation: f64,
}

/// Largest distance between two points along the axes.
fn apart(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|k| (a[k] - b[k]).abs()).fold(0.0, f64::max)
}

fn mirrored(points: &[[f64; 3]]) -> Vec<[f64; 3]> {
    points.iter().map(|&[x, y, z]| [x, 0.0 - y, z]).collect()
}

/// Pieces of an edge of the surface: its curve, and whether it lies on the centreplane.
fn pieces(curve: &BsplineCurve<3>, slack: f64) -> Result<Vec<(BsplineCurve<3>, bool)>, SplineError> {
    let breaks = curve.knots().breakpoints();
    let mut runs: Vec<(f64, f64, bool)> = Vec::new();
    for span in breaks.windows(2) {
        let part = curve.part(span[0], span[1])?;
        let flat = part.points().iter().all(|p| p[1].abs() <= slack);
        match runs.last_mut() {
            Some((_, to, same)) if *same == flat => *to = span[1],
            _ => runs.push((span[0], span[1], flat)),
        }
    }
    let whole = runs.len() == 1;
    runs.into_iter()
        .map(|(from, to, flat)| {
            let part = if whole { curve.clone() } else { curve.part(from, to)? };
            let points = part.points().iter().map(|&[x, y, z]| [x, if y.abs() <= slack { 0.0 } else { y }, z]);
            let points = points.collect();
            Ok((BsplineCurve::new(part.knots().clone(), points)?, flat))
        })
        .collect()
}

/// Vertices and edges, each once.
struct Builder {
    vertices: Vec<[f64; 3]>,
    edges: Vec<Edge>,
    same: f64,
}

impl Builder {
    fn vertex(&mut self, point: [f64; 3]) -> usize {
        let found = self.vertices.iter().position(|&other| apart(other, point) <= self.same);
        found.unwrap_or_else(|| {
            self.vertices.push(point);
            self.vertices.len() - 1
        })
    }

    /// The edge along a curve, and whether it runs as the curve does; none when the curve is a point.
    fn edge(&mut self, curve: &BsplineCurve<3>) -> Option<(usize, bool)> {
        let points = curve.points();
        let (first, last) = (points[0], points[points.len() - 1]);
        if points.iter().all(|&point| apart(point, first) <= self.same) {
            return None;
        }
        let (from, to) = (self.vertex(first), self.vertex(last));
        let middle = |curve: &BsplineCurve<3>, share: f64| {
            let (a, b) = curve.knots().domain();
            curve.eval(a + share * (b - a))
        };
        for (k, edge) in self.edges.iter().enumerate() {
            let along = |share: f64| apart(middle(&edge.curve, share), middle(curve, share)) <= self.same;
            let against = |share: f64| apart(middle(&edge.curve, 1.0 - share), middle(curve, share)) <= self.same;
            if (edge.from, edge.to) == (from, to) && along(0.5) && along(0.3) {
                return Some((k, true));
            }
            if (edge.to, edge.from) == (from, to) && against(0.5) && against(0.3) {
                return Some((k, false));
            }
        }
        self.edges.push(Edge { from, to, curve: curve.clone() });
        Some((self.edges.len() - 1, true))
    }
}

/// One end of a line between the two sides, straight across.
fn across(point: [f64; 3]) -> Result<BsplineCurve<3>, SplineError> {
    let [x, y, z] = point;
    BsplineCurve::new(KnotVector::uniform(1, 1)?, vec![[x, 0.0 - y, z], [x, y, z]])
}

/// The surface below the deck at side, and what it leaves the surface by \[m\].
fn below_deck(hull: &Hull, parameter: impl Fn(f64) -> f64) -> Result<(BsplineSurface<3>, f64), SplineError> {
    let surface = hull.surface();
    let (from, to) = surface.v().domain();
    let finer = |knots: &KnotVector| -> Result<KnotVector, SplineError> {
        let breaks = knots.breakpoints();
        let mut fine = Vec::new();
        let mut folds = Vec::new();
        for (k, span) in breaks.windows(2).enumerate() {
            for part in 0..FINENESS {
                fine.push(span[0] + (span[1] - span[0]) * part as f64 / FINENESS as f64);
                folds.push(if part == 0 && k > 0 { knots.multiplicity(span[0]) } else { 1 });
            }
        }
        fine.push(breaks[breaks.len() - 1]);
        folds.push(1);
        KnotVector::from_breakpoints(knots.degree(), &fine, &folds[1..folds.len() - 1])
    };
    let (u, v) = (finer(surface.u())?, finer(surface.v())?);
    let point = |s: f64, t: f64| surface.eval(s, from + (t - from) * (parameter(s) - from) / (to - from));
    let (us, vs) = (u.greville(), v.greville());
    let points: Vec<[f64; 3]> =
        us.iter().flat_map(|&s| vs.iter().map(move |&t| (s, t))).map(|(s, t)| point(s, t)).collect();
    let below = BsplineSurface::interpolate([u, v], [&us, &vs], &points)?;
    let middles = |sites: &[f64]| sites.windows(2).map(|w| 0.5 * (w[0] + w[1])).collect::<Vec<_>>();
    let mut deviation = 0.0_f64;
    for &s in &middles(&us) {
        for &t in &middles(&vs) {
            let [x, y, z] = below.eval(s, t);
            // Points slide along the surface: what counts is the half-breadth at the same place of the profile.
            let there = hull.half_breadth(x, z).unwrap_or_else(|| point(s, t)[1]);
            deviation = deviation.max((y - there).abs());
        }
    }
    Ok((below, deviation))
}

/// Points of every span of a surface.
fn samples(surface: &BsplineSurface<3>) -> Vec<[f64; 2]> {
    let within = |knots: &KnotVector| -> Vec<f64> {
        let breaks = knots.breakpoints();
        let part = |w: &[f64], k: usize| w[0] + (w[1] - w[0]) * k as f64 / SAMPLES as f64;
        breaks.windows(2).flat_map(|w| (0..=SAMPLES).map(move |k| part(w, k))).collect()
    };
    let vs = within(surface.v());
    within(surface.u()).into_iter().flat_map(|u| vs.iter().map(move |&v| [u, v])).collect()
}

/// Whether the surface goes through the centreplane, where the sides would go through each other.
fn crosses(surface: &BsplineSurface<3>, slack: f64) -> bool {
    // A net that is not negative makes no surface that is.
    surface.points().iter().any(|point| point[1] < -slack)
        && samples(surface).into_iter().any(|[u, v]| surface.eval(u, v)[1] < -slack)
}

/// The greatest difference of the half-breadths of two surfaces of the same knots \[m\].
fn moved(a: &BsplineSurface<3>, b: &BsplineSurface<3>) -> f64 {
    samples(a).into_iter().map(|[u, v]| (a.eval(u, v)[1] - b.eval(u, v)[1]).abs()).fold(0.0, f64::max)
}

impl Solid {
    /// The body of a hull up to its deck.
    ///
    /// # Errors
    /// [`SplineError`] when the surface below the deck cannot be interpolated.
    pub fn new(hull: &Hull) -> Result<Self, SplineError> {
        let (_, to) = hull.surface().v().domain();
        let domain = hull.surface().u().domain();
        let parameter = |u: f64| super::mesh::deck_parameter(hull, u);
        let sites = hull.surface().u().greville();
        let cut = sites.iter().any(|&u| parameter(u.clamp(domain.0, domain.1)) < to);
        let (surface, deviation) = if cut { below_deck(hull, parameter)? } else { (hull.surface().clone(), 0.0) };
        let breadth = surface.points().iter().map(|p| p[1].abs()).fold(0.0, f64::max);
        let slack = CENTREPLANE * breadth;
        let crossed = crosses(&surface, slack);
        let on_centreplane = |y: f64| y.abs() <= slack || (crossed && y < 0.0);
        let points: Vec<[f64; 3]> =
            surface.points().iter().map(|&[x, y, z]| [x, if on_centreplane(y) { 0.0 } else { y }, z]).collect();
        let port = BsplineSurface::new(surface.u().clone(), surface.v().clone(), points)?;
        let deviation = if crossed { deviation.max(moved(&surface, &port)) } else { deviation };
        let starboard = BsplineSurface::new(surface.u().clone(), surface.v().clone(), mirrored(port.points()))?;
        let long = hull.particulars().length_between_perpendiculars;
        let mut builder = Builder { vertices: Vec::new(), edges: Vec::new(), same: SAME * long };
        let ((a, b), (c, d)) = (port.u().domain(), port.v().domain());
        // The four edges as a loop around the starboard side: bottom forward, stem up, deck aft, stern down.
        let sides = [
            (Region::Bottom, port.curve_at_v(c), true),
            (Region::Bow, port.curve_at_u(b), true),
            (Region::Deck, port.curve_at_v(d), false),
            (Region::Transom, port.curve_at_u(a), false),
        ];
        let mut loops: [Vec<(usize, bool)>; 2] = [Vec::new(), Vec::new()];
        let mut closing = Vec::new();
        for (region, curve, forward) in sides {
            let mut list = pieces(&curve, slack)?;
            if !forward {
                list.reverse();
            }
            for (piece, flat) in list {
                let left = piece.clone();
                let right = BsplineCurve::new(piece.knots().clone(), mirrored(piece.points()))?;
                let turned = |(edge, along): (usize, bool)| (edge, along == forward);
                let starboard_edge = builder.edge(&right);
                let port_edge = builder.edge(&left);
                loops[0].extend(starboard_edge.map(turned));
                loops[1].extend(port_edge.map(turned));
                if flat {
                    continue;
                }
                // The face between runs so that its normal points out: bottom and bow against the curve, transom and deck along it.
                let along = matches!(region, Region::Transom | Region::Deck);
                let (left, right) = if along { (left, right) } else { (left.reversed(), right.reversed()) };
                let knots = left.knots().clone();
                let net = right.points().iter().zip(left.points()).flat_map(|(&r, &l)| [r, l]).collect();
                let surface = BsplineSurface::new(knots, KnotVector::uniform(1, 1)?, net)?;
                let (first, last) = (left.points()[0], left.points()[left.points().len() - 1]);
                let mut boundary = Vec::new();
                let reverse = |(edge, along): (usize, bool)| (edge, !along);
                boundary.extend(builder.edge(&right));
                boundary.extend(builder.edge(&across(last)?));
                boundary.extend(builder.edge(&left).map(reverse));
                boundary.extend(builder.edge(&across(first)?).map(reverse));
                closing.push(SolidFace { region, name: region.name().to_owned(), surface, boundary });
            }
        }
        let [right, left] = loops;
        let left = left.into_iter().rev().map(|(edge, along)| (edge, !along)).collect();
        let mut faces = vec![
            SolidFace {
                region: Region::Hull,
                name: "hull port".to_owned(),
                surface: port.transposed(),
                boundary: left,
            },
            SolidFace { region: Region::Hull, name: "hull starboard".to_owned(), surface: starboard, boundary: right },
        ];
        faces.extend(closing);
        Ok(Self { vertices: builder.vertices, edges: builder.edges, faces, deviation })
    }

    /// The solid with its origin raised by `datum` \[m\].
    ///
    /// # Errors
    /// [`SplineError`] when a coordinate is no longer finite.
    pub fn lowered(mut self, datum: f64) -> Result<Self, SplineError> {
        let low = |points: &[[f64; 3]]| points.iter().map(|&[x, y, z]| [x, y, z - datum]).collect::<Vec<_>>();
        self.vertices = low(&self.vertices);
        for edge in &mut self.edges {
            edge.curve = BsplineCurve::new(edge.curve.knots().clone(), low(edge.curve.points()))?;
        }
        for face in &mut self.faces {
            let surface = &face.surface;
            face.surface = BsplineSurface::new(surface.u().clone(), surface.v().clone(), low(surface.points()))?;
        }
        Ok(self)
    }

    /// Whether every edge is used by exactly two faces, in opposite directions.
    #[must_use]
    pub fn is_closed(&self) -> bool {
        let mut uses = vec![[0_usize; 2]; self.edges.len()];
        for (edge, along) in self.faces.iter().flat_map(|face| &face.boundary) {
            uses[*edge][usize::from(*along)] += 1;
        }
        uses.iter().all(|uses| *uses == [1, 1])
    }
}

#[cfg(test)]
mod tests;
