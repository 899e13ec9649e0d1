//! The body of a hull as a closed solid of untrimmed B-spline faces that share their edges, for CAD.
//!
//! The two sides are the surface itself and its mirror image. Their edges are cut where they leave the centreplane: a
//! piece on it is shared by both sides, any other piece has its mirror image and a ruled face between the two (bottom,
//! transom, flat bow, deck). Every face is run so that its normal S_u x S_v points out of the body, and its loop
//! counter-clockwise seen from outside.
//!
//! Where the deck at side cuts the surface, each side is two faces that meet along a line of the net: the surface as it
//! is below, and above it one that is interpolated up to the deck (`topsides`); its deviation is
//! reported. Where the surface goes through the centreplane its net ends there, so that the sides do not go through each
//! other; that is reported as well.

mod topsides;

use super::form::Hull;
use super::mesh::Region;
use crate::numeric::{GaussRule, gauss_legendre};
use crate::spline::{BsplineCurve, BsplineSurface, KnotVector, SplineError, cross, dot, length};

/// Half-breadths below this part of the greatest are on the centreplane.
const CENTREPLANE: f64 = 1e-9;

/// Points closer than this part of the length of the hull are one.
const SAME: f64 = 1e-9;

/// Intervals of a span in which a surface is looked at.
const SAMPLES: usize = 6;

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
    /// What the sides leave the surface of the hull by \[m\]: 0, or what was measured where the deck or the centreplane
    /// cuts it.
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

/// Edges of a face in turn, and whether they are run forward.
type Loop = Vec<(usize, bool)>;

impl Builder {
    /// The loops around a part of the starboard and of the port side, and the faces between the two along its edges. An
    /// edge without a region is shared with another part of the same side.
    fn around(
        &mut self,
        sides: [(Option<Region>, BsplineCurve<3>, bool); 4],
        slack: f64,
        closing: &mut Vec<SolidFace>,
    ) -> Result<[Loop; 2], SplineError> {
        let mut loops: [Loop; 2] = [Vec::new(), Vec::new()];
        for (region, curve, forward) in sides {
            let mut list = pieces(&curve, slack)?;
            if !forward {
                list.reverse();
            }
            for (left, flat) in list {
                let right = BsplineCurve::new(left.knots().clone(), mirrored(left.points()))?;
                let turned = |(edge, along): (usize, bool)| (edge, along == forward);
                let starboard_edge = self.edge(&right);
                let port_edge = self.edge(&left);
                loops[0].extend(starboard_edge.map(turned));
                loops[1].extend(port_edge.map(turned));
                let Some(region) = region.filter(|_| !flat) else { continue };
                // The face between runs so that its normal points out: bottom and bow against the curve, transom and
                // deck along it.
                let along = matches!(region, Region::Transom | Region::Deck);
                let (left, right) = if along { (left, right) } else { (left.reversed(), right.reversed()) };
                let knots = left.knots().clone();
                let net = right.points().iter().zip(left.points()).flat_map(|(&r, &l)| [r, l]).collect();
                let surface = BsplineSurface::new(knots, KnotVector::uniform(1, 1)?, net)?;
                let (first, last) = (left.points()[0], left.points()[left.points().len() - 1]);
                let mut boundary = Vec::new();
                let reverse = |(edge, along): (usize, bool)| (edge, !along);
                boundary.extend(self.edge(&right));
                boundary.extend(self.edge(&across(last)?));
                boundary.extend(self.edge(&left).map(reverse));
                boundary.extend(self.edge(&across(first)?).map(reverse));
                closing.push(SolidFace { region, name: region.name().to_owned(), surface, boundary });
            }
        }
        Ok(loops)
    }
}

/// What a face adds to the volume of its solid \[m^3\].
fn enclosed(surface: &BsplineSurface<3>) -> f64 {
    // The integrand is of degree 3 p - 1.
    let rule = |knots: &KnotVector| gauss_legendre((3 * knots.degree()).div_ceil(2));
    let (in_u, in_v) = (rule(surface.u()), rule(surface.v()));
    let (us, vs) = (surface.u().breakpoints(), surface.v().breakpoints());
    let cell = |u: &[f64], v: &[f64]| {
        let mut sum = 0.0;
        for (s, p) in in_u.on(u[0], u[1]) {
            for (t, q) in in_v.on(v[0], v[1]) {
                let d = surface.derivatives::<2>(s, t);
                sum += p * q * dot(d[0][0], cross(d[1][0], d[0][1]));
            }
        }
        sum
    };
    us.windows(2).map(|u| vs.windows(2).map(|v| cell(u, v)).sum::<f64>()).sum::<f64>() / 3.0
}

/// Parts of a face of which the area is measured: the order of the quadrature, and of the one that it is compared with.
const ORDERS: [usize; 2] = [5, 7];

/// The two agree to this part of the whole area for each part of a face.
const AGREEING: f64 = 1e-11;

/// How often a part is halved both ways at most.
const HALVINGS: usize = 8;

/// The area of a surface over a rectangle of its parameters, int |S_u x S_v| du dv, halved both ways until two orders
/// of Gauss's rule agree to `slack` \[m^2\].
fn area_over(
    surface: &BsplineSurface<3>,
    rules: &[&GaussRule; 2],
    [u, v]: [[f64; 2]; 2],
    slack: f64,
    halvings: usize,
) -> f64 {
    let by = |rule: &GaussRule| {
        let mut sum = 0.0;
        for (s, p) in rule.on(u[0], u[1]) {
            for (t, q) in rule.on(v[0], v[1]) {
                let d = surface.derivatives::<2>(s, t);
                sum += p * q * length(cross(d[1][0], d[0][1]));
            }
        }
        sum
    };
    let [coarse, fine] = [by(rules[0]), by(rules[1])];
    if halvings == 0 || (coarse - fine).abs() <= slack {
        return fine;
    }
    let halves = |[from, to]: [f64; 2]| {
        let middle = 0.5 * (from + to);
        [[from, middle], [middle, to]]
    };
    let over = |part| area_over(surface, rules, part, slack, halvings - 1);
    halves(u).into_iter().map(|u| halves(v).into_iter().map(|v| over([u, v])).sum::<f64>()).sum()
}

/// One end of a line between the two sides, straight across.
fn across(point: [f64; 3]) -> Result<BsplineCurve<3>, SplineError> {
    let [x, y, z] = point;
    BsplineCurve::new(KnotVector::uniform(1, 1)?, vec![[x, 0.0 - y, z], [x, y, z]])
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
        let topsides::Parts { surfaces, mut deviation } = topsides::below_deck(hull)?;
        let breadth = hull.surface().points().iter().map(|p| p[1].abs()).fold(0.0, f64::max);
        let slack = CENTREPLANE * breadth;
        let mut ports = Vec::new();
        for surface in surfaces {
            let crossed = crosses(&surface, slack);
            let on_centreplane = |y: f64| y.abs() <= slack || (crossed && y < 0.0);
            let points: Vec<[f64; 3]> =
                surface.points().iter().map(|&[x, y, z]| [x, if on_centreplane(y) { 0.0 } else { y }, z]).collect();
            let port = BsplineSurface::new(surface.u().clone(), surface.v().clone(), points)?;
            deviation = if crossed { deviation.max(moved(&surface, &port)) } else { deviation };
            ports.push(port);
        }
        let long = hull.particulars().length_between_perpendiculars;
        let mut builder = Builder { vertices: Vec::new(), edges: Vec::new(), same: SAME * long };
        let (mut faces, mut closing) = (Vec::new(), Vec::new());
        let mut seam: Option<BsplineCurve<3>> = None;
        for (k, port) in ports.iter().enumerate() {
            let last = k + 1 == ports.len();
            let (bottom, top) = (k == 0, last.then_some(Region::Deck));
            let ((a, b), (c, d)) = (port.u().domain(), port.v().domain());
            let below = seam.take().unwrap_or_else(|| port.curve_at_v(c));
            let above = port.curve_at_v(d);
            seam = Some(above.clone());
            // The four edges as a loop around the starboard side: bottom forward, stem up, deck aft, stern down.
            let sides = [
                (bottom.then_some(Region::Bottom), below, true),
                (Some(Region::Bow), port.curve_at_u(b), true),
                (top, above, false),
                (Some(Region::Transom), port.curve_at_u(a), false),
            ];
            let [right, left] = builder.around(sides, slack, &mut closing)?;
            let left = left.into_iter().rev().map(|(edge, along)| (edge, !along)).collect();
            let starboard = BsplineSurface::new(port.u().clone(), port.v().clone(), mirrored(port.points()))?;
            let part = if k == 0 { "hull" } else { "topsides" };
            let face = |side: &str, surface, boundary| SolidFace {
                region: Region::Hull,
                name: format!("{part} {side}"),
                surface,
                boundary,
            };
            faces.push(face("port", port.transposed(), left));
            faces.push(face("starboard", starboard, right));
        }
        faces.extend(closing);
        Ok(Self { vertices: builder.vertices, edges: builder.edges, faces, deviation })
    }

    /// The volume that the faces enclose, (1/3) sum of int S . (S_u x S_v) du dv, exact to rounding \[m^3\].
    #[must_use]
    pub fn volume(&self) -> f64 {
        self.faces.iter().map(|face| enclosed(&face.surface)).sum()
    }

    /// The area of the faces, the sum of int |S_u x S_v| du dv, to about 1e-10 of itself where they are smooth \[m^2\].
    #[must_use]
    pub fn area(&self) -> f64 {
        let rules = ORDERS.map(gauss_legendre);
        let cells = |surface: &BsplineSurface<3>| -> Vec<[[f64; 2]; 2]> {
            let (us, vs) = (surface.u().breakpoints(), surface.v().breakpoints());
            us.windows(2)
                .flat_map(|u| vs.windows(2).map(move |v| [[u[0], u[1]], [v[0], v[1]]]).collect::<Vec<_>>())
                .collect()
        };
        let sum = |slack: f64, halvings: usize| -> f64 {
            let of = |face: &SolidFace| -> f64 {
                let over = |cell| area_over(&face.surface, &rules, cell, slack, halvings);
                cells(&face.surface).into_iter().map(over).sum()
            };
            self.faces.iter().map(of).sum()
        };
        sum(AGREEING * sum(0.0, 0), HALVINGS)
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
