//! Curves and surfaces of IGES by their entities.

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use super::super::super::fault::Faults;
use super::super::surfaces::MOST_POINTS;
use super::faces::Lists;
use super::read::{Entry, entity_128, spline_126};
use crate::hull::{Conic, FaceSurface, Motion, SpaceCurve, frame};
use crate::spline::{BsplineCurve, KnotVector};

/// Curves of curves, and surfaces of surfaces, at most.
const DEEPEST: usize = 8;

/// Points of a straight piece of a curve in the parameters of a surface.
const STRAIGHT: usize = 8;

/// A curve between two of its parameters.
pub(super) type Piece = (SpaceCurve, [f64; 2]);

/// How the parameters of an entity become ours.
#[derive(Debug, Clone, Copy)]
enum Order {
    /// They are.
    Same,
    /// Those of a surface of revolution (120): along the generatrix, then the angle.
    Swapped,
    /// Those of a tabulated cylinder (122): shares of the generatrix between two of its parameters.
    Shares([f64; 2]),
}

impl Order {
    fn ours(self, [u, v]: [f64; 2]) -> [f64; 2] {
        match self {
            Self::Same => [u, v],
            Self::Swapped => [v, u],
            Self::Shares([from, to]) => [from + u * (to - from), v],
        }
    }
}

/// The entities of a file with what reading their geometry needs.
pub(super) struct Geometry<'a> {
    pub(super) directory: &'a BTreeMap<usize, Entry>,
    pub(super) lists: Lists<'a>,
    pub(super) faults: &'a mut Faults,
    /// Control points so far.
    pub(super) points: usize,
}

/// The motion of a transformation (124): three rows of a rotation and a translation.
pub(super) fn motion(list: Option<&[f64]>) -> Motion {
    match list {
        Some([_, m @ ..]) if m.len() >= 12 => Motion([0, 4, 8].map(|k| [m[k], m[k + 1], m[k + 2], m[k + 3]])),
        _ => Motion::NONE,
    }
}

fn pointer(list: &[f64], k: usize) -> Option<usize> {
    list.get(k).copied().filter(|v| (1.0..1e9).contains(v)).map(|v| v as usize)
}

fn triple(list: &[f64], k: usize) -> Option<[f64; 3]> {
    let &[x, y, z] = list.get(k..k + 3)? else { return None };
    (x + y + z).is_finite().then_some([x, y, z])
}

/// The angle of an arc's end above that of its start, once around where they are one.
fn turned(from: f64, to: f64) -> f64 {
    if to > from + 1e-9 { to } else { to + TAU }
}

impl<'a> Geometry<'a> {
    /// An entity with its parameters and its motion.
    pub(super) fn entity(&self, number: usize) -> Option<(&'a Entry, Vec<f64>, Motion)> {
        let entry = self.directory.get(&number)?;
        let (list, place) = (self.lists)(entry);
        Some((entry, list, motion(place.as_deref())))
    }

    /// The curves that a curve is made of.
    pub(super) fn pieces(&mut self, number: usize, depth: usize) -> Option<Vec<Piece>> {
        let (entry, list, motion) = self.entity(number)?;
        // Composites of composites end somewhere.
        self.points = self.points.saturating_add(list.len());
        if depth > DEEPEST || self.points > MOST_POINTS {
            return None;
        }
        if entry.kind == 102 {
            let count = pointer(&list, 1)?;
            let all: Option<Vec<Vec<Piece>>> =
                (0..count.min(list.len())).map(|k| self.pieces(pointer(&list, 2 + k)?, depth + 1)).collect();
            let moved = |(curve, ends): Piece| (curve.moved(&motion), ends);
            return Some(all?.into_iter().flatten().map(moved).collect());
        }
        if entry.kind == 126 {
            let (_, place) = (self.lists)(entry);
            let title = format!("entity 126, D{number}");
            let (curve, ends) = spline_126(self.faults, entry.line, &title, &list, place.as_deref(), &mut self.points)?;
            return Some(vec![(SpaceCurve::Spline(curve), ends)]);
        }
        let (curve, ends) = match entry.kind {
            100 => arc(&list)?,
            104 => conic(&list)?,
            106 => copious(&list)?,
            110 => (SpaceCurve::between(triple(&list, 1)?, triple(&list, 4)?), [0.0, 1.0]),
            112 => polynomial(&list)?,
            _ => return None,
        };
        Some(vec![(curve.moved(&motion), ends)])
    }

    /// One curve of a single piece.
    fn piece(&mut self, number: usize) -> Option<Piece> {
        let mut pieces = self.pieces(number, 0)?;
        let piece = pieces.pop()?;
        pieces.is_empty().then_some(piece)
    }

    /// A curve in the parameters of a spline surface as lines through its points in space.
    pub(super) fn mapped(&mut self, number: usize, surface: &FaceSurface, samples: usize) -> Option<Vec<Piece>> {
        if !matches!(surface, FaceSurface::Spline(_)) {
            return None;
        }
        let lift = |(curve, [from, to]): Piece| {
            let straight = curve.is_straight(from, to);
            let count = if straight { samples } else { 8 * samples };
            let sites = (0..=count).map(|k| curve.point(from + (to - from) * k as f64 / count as f64));
            let points: Vec<[f64; 3]> = sites.map(|[u, v, _]| surface.at([u, v])[0]).collect();
            let last = (points.len() - 1) as f64;
            SpaceCurve::polyline(&points).map(|curve| (curve, [0.0, last]))
        };
        self.pieces(number, 0)?.into_iter().map(lift).collect()
    }

    /// The curves of a loop in the parameters of a surface as points of ours, piece by piece; none where the file has no such
    /// curves, or the order of its parameters is not known.
    pub(super) fn on_parameters(&mut self, number: usize, support: usize) -> Option<Vec<Vec<[f64; 2]>>> {
        let order = self.order(support, 0)?;
        let sampled = |(curve, [from, to]): Piece| {
            let count = if curve.is_straight(from, to) { STRAIGHT } else { 8 * STRAIGHT };
            let site = |k: usize| from + (to - from) * k as f64 / count as f64;
            let place = |k: usize| {
                let [u, v, _] = curve.point(site(k));
                order.ours([u, v])
            };
            (0..=count).map(place).collect()
        };
        Some(self.pieces(number, 0)?.into_iter().map(sampled).collect())
    }

    /// How the parameters of an entity become ours.
    fn order(&mut self, number: usize, depth: usize) -> Option<Order> {
        let (entry, list, _) = self.entity(number)?;
        match entry.kind {
            118 | 128 => Some(Order::Same),
            120 => Some(Order::Swapped),
            122 => self.piece(pointer(&list, 1)?).map(|(_, ends)| Order::Shares(ends)),
            140 if depth <= DEEPEST => self.order(pointer(&list, 5)?, depth + 1),
            _ => None,
        }
    }

    /// Whether S_u x S_v of our parameters is the normal of an entity of a solid; none where it is not known.
    pub(super) fn has_our_normal(&mut self, number: usize) -> Option<bool> {
        let (entry, _, _) = self.entity(number)?;
        match entry.kind {
            108 | 190..=198 => Some(true),
            _ => self.order(number, 0).map(|order| !matches!(order, Order::Swapped)),
        }
    }

    fn direction(&self, number: usize) -> Option<[f64; 3]> {
        let (entry, list, motion) = self.entity(number)?;
        (entry.kind == 123).then(|| triple(&list, 1).map(|along| motion.along(along)))?
    }

    fn place(&self, number: usize) -> Option<[f64; 3]> {
        let (entry, list, motion) = self.entity(number)?;
        (entry.kind == 116).then(|| triple(&list, 1).map(|point| motion.point(point)))?
    }

    /// A surface; none where its kind is not read.
    pub(super) fn surface(&mut self, number: usize, depth: usize) -> Option<FaceSurface> {
        let (entry, list, motion) = self.entity(number)?;
        if depth > DEEPEST {
            return None;
        }
        if entry.kind == 128 {
            let (_, place) = (self.lists)(entry);
            let title = format!("entity 128, D{number}");
            let found = entity_128(self.faults, entry.line, &title, &list, place.as_deref(), &mut self.points)?;
            return Some(FaceSurface::Spline(found));
        }
        let surface = match entry.kind {
            108 => {
                let normal = triple(&list, 1)?;
                let square = normal.iter().map(|c| c * c).sum::<f64>();
                FaceSurface::plane(normal.map(|c| c * list.get(4).copied().unwrap_or(0.0) / square), normal, None)
            }
            118 => self.ruled(entry, &list)?,
            120 => {
                let (line, [from, to]) = self.piece(pointer(&list, 1)?)?;
                let (origin, end) = (line.point(from), line.point(to));
                let [_, _, axis] = frame([0, 1, 2].map(|k| end[k] - origin[k]), None);
                let (profile, _) = self.piece(pointer(&list, 2)?)?;
                FaceSurface::Revolved { origin, axis, profile }
            }
            122 => {
                let (profile, [from, _]) = self.piece(pointer(&list, 1)?)?;
                let (start, end) = (profile.point(from), triple(&list, 2)?);
                FaceSurface::Extruded { profile, along: [0, 1, 2].map(|k| end[k] - start[k]) }
            }
            140 => {
                let base = self.surface(pointer(&list, 5)?, depth + 1)?;
                let ends = self.ends(pointer(&list, 5)?, &base).unwrap_or([[0.0, 0.0]; 2]);
                let [_, du, dv] = base.at([ends[0][0], ends[1][0]]);
                let normal =
                    [0, 1, 2].map(|k: usize| du[(k + 1) % 3] * dv[(k + 2) % 3] - du[(k + 2) % 3] * dv[(k + 1) % 3]);
                let side: f64 = triple(&list, 1)?.iter().zip(normal).map(|(a, b)| a * b).sum();
                let distance = list.get(4).copied()? * side.signum();
                FaceSurface::Offset { base: Box::new(base), distance }
            }
            190..=198 => self.elementary(entry.kind, &list)?,
            _ => return None,
        };
        Some(surface.moved(&motion))
    }

    /// Straight lines between two curves, at equal parameters.
    fn ruled(&mut self, entry: &Entry, list: &[f64]) -> Option<FaceSurface> {
        let (first, ends) = self.piece(pointer(list, 1)?)?;
        let (second, [from, to]) = self.piece(pointer(list, 2)?)?;
        let even = |curve: &SpaceCurve| !matches!(curve, SpaceCurve::Spline(_));
        // Of form 0 at equal parts of their lengths.
        if entry.form == 0 && !(even(&first) && even(&second)) {
            return None;
        }
        let other = if list.get(3).is_some_and(|&flag| flag > 0.0) { [to, from] } else { [from, to] };
        Some(FaceSurface::Ruled { sides: [(first, ends), (second, other)] })
    }

    /// Planes, cylinders, cones, spheres and tori of solids.
    fn elementary(&self, kind: usize, list: &[f64]) -> Option<FaceSurface> {
        let origin = self.place(pointer(list, 1)?)?;
        let number = |k: usize| list.get(k).copied().filter(|v| v.is_finite());
        if kind == 196 {
            let axis = pointer(list, 3).and_then(|axis| self.direction(axis)).unwrap_or([0.0, 0.0, 1.0]);
            let [x, _, z] = frame(axis, None);
            let profile = SpaceCurve::circle(origin, x, z, number(2)?);
            return Some(FaceSurface::Revolved { origin, axis: z, profile });
        }
        let normal = self.direction(pointer(list, 2)?)?;
        let [x, _, z] = frame(normal, None);
        let profile = match kind {
            190 => return Some(FaceSurface::plane(origin, normal, None)),
            192 => SpaceCurve::beside(origin, x, number(3)?, z),
            194 => {
                let slope = number(4)?.to_radians().tan();
                SpaceCurve::beside(origin, x, number(3)?, [0, 1, 2].map(|k| slope * x[k] + z[k]))
            }
            198 => {
                let major = number(3)?;
                SpaceCurve::circle([0, 1, 2].map(|k| origin[k] + major * x[k]), x, z, number(4)?)
            }
            _ => return None,
        };
        Some(FaceSurface::Revolved { origin, axis: z, profile })
    }

    /// The parameters between which a surface lies when nothing trims it.
    pub(super) fn ends(&mut self, number: usize, surface: &FaceSurface) -> Option<[[f64; 2]; 2]> {
        let (entry, list, _) = self.entity(number)?;
        match (entry.kind, surface) {
            (_, FaceSurface::Spline(spline)) => Some([spline.u().domain().into(), spline.v().domain().into()]),
            (118, _) => Some([[0.0, 1.0]; 2]),
            (120, _) => {
                let (_, ends) = self.piece(pointer(&list, 2)?)?;
                Some([[*list.get(3)?, *list.get(4)?], ends])
            }
            (122, _) => {
                let (_, ends) = self.piece(pointer(&list, 1)?)?;
                Some([ends, [0.0, 1.0]])
            }
            _ => None,
        }
    }
}

/// A circular arc: z, centre, start and end, counterclockwise.
fn arc(list: &[f64]) -> Option<Piece> {
    let &[z, x, y, ax, ay, bx, by] = list.get(1..8)? else { return None };
    let radius = (ax - x).hypot(ay - y);
    let [from, to] = [(ay - y).atan2(ax - x), (by - y).atan2(bx - x)];
    let curve = SpaceCurve::circle([x, y, z], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], radius);
    (radius > 0.0 && radius.is_finite()).then(|| (curve, [from, turned(from, to)]))
}

/// A conic A x^2 + B x y + C y^2 + D x + E y + F = 0 about its own axes: an ellipse, from its start counterclockwise.
fn conic(list: &[f64]) -> Option<Piece> {
    let &[a, b, c, d, e, f, z, ax, ay, bx, by] = list.get(1..12)? else { return None };
    let own = [b, d, e].iter().all(|v| v.abs() <= 1e-12 * a.abs().max(c.abs()));
    let [p, q] = [-f / a, -f / c];
    if !(own && p > 0.0 && q > 0.0 && p.is_finite() && q.is_finite()) {
        return None;
    }
    let (p, q) = (p.sqrt(), q.sqrt());
    let [from, to] = [(ay / q).atan2(ax / p), (by / q).atan2(bx / p)];
    let curve = SpaceCurve::Conic { kind: Conic::Ellipse, centre: [0.0, 0.0, z], x: [p, 0.0, 0.0], y: [0.0, q, 0.0] };
    Some((curve, [from, turned(from, to)]))
}

/// Straight lines through points: of two coordinates at one z, of three, or of six of which three are vectors.
fn copious(list: &[f64]) -> Option<Piece> {
    let (form, count) = (pointer(list, 1)?, pointer(list, 2)?);
    let (first, width): (usize, usize) = match form {
        1 => (4, 2),
        2 => (3, 3),
        3 => (3, 6),
        _ => return None,
    };
    let values = list.get(first..first.saturating_add(count.checked_mul(width)?))?;
    let points: Vec<[f64; 3]> = values
        .chunks_exact(width)
        .map(|p| if width == 2 { [p[0], p[1], list[3]] } else { [p[0], p[1], p[2]] })
        .collect();
    Some((SpaceCurve::polyline(&points)?, [0.0, (count - 1) as f64]))
}

/// A cubic spline by the powers of its parameter (112).
fn polynomial(list: &[f64]) -> Option<Piece> {
    let count = pointer(list, 4)?;
    let breaks = list.get(5..5 + count.checked_add(1)?)?;
    let powers = list.get(6 + count..6 + count + count.checked_mul(12)?)?;
    let mut points = Vec::with_capacity(3 * count + 1);
    for (ends, own) in breaks.windows(2).zip(powers.chunks_exact(12)) {
        let h = ends[1] - ends[0];
        let at = |weights: [f64; 3]| {
            let [x, y, z] = [0, 4, 8].map(|k| {
                own[k]
                    + weights[0] * own[k + 1] * h
                    + weights[1] * own[k + 2] * h * h
                    + weights[2] * own[k + 3] * h * h * h
            });
            [x, y, z, 1.0]
        };
        if points.is_empty() {
            points.push(at([0.0; 3]));
        }
        points.extend([at([1.0 / 3.0, 0.0, 0.0]), at([2.0 / 3.0, 1.0 / 3.0, 0.0]), at([1.0; 3])]);
    }
    let knots = KnotVector::from_breakpoints(3, breaks, &vec![3; count - 1]).ok()?;
    let ends = knots.domain().into();
    Some((SpaceCurve::Spline(BsplineCurve::new(knots, points).ok()?), ends))
}
