//! The faces of an IGES file: trimmed and bounded surfaces (entities 144, 143), faces of solids (510), and bounded planes (108).

use std::collections::{BTreeMap, BTreeSet};

use super::super::super::fault::Faults;
use super::super::surfaces::Unread;
use super::geometry::{Geometry, Piece};
use super::read::Entry;
use crate::hull::{Brep, BrepEdge, BrepFace, FaceSurface, SpaceCurve};
use crate::spline::{length, minus};

/// Points of a curve in the parameters of a surface, a span.
const SAMPLES: usize = 32;

/// The parameters of an entity, and those of its transformation.
pub(super) type Lists<'a> = &'a dyn Fn(&Entry) -> (Vec<f64>, Option<Vec<f64>>);

/// Ends of curves in space and in the parameters of a surface are nearer to each other than this part of the size of a loop.
const AGREES: f64 = 1e-3;

/// Gaps of a loop less than this part of others are smaller ones.
const CLEARLY: f64 = 0.5;

/// A loop, edge by edge and with their directions.
type Ring = Vec<(usize, bool)>;

/// Loops of a face, and whether its inside is to their left about S_u x S_v; none where the file does not say so.
type Loops = (Vec<Ring>, Option<bool>);

struct FaceReader<'a> {
    geometry: Geometry<'a>,
    body: Brep,
    unread: Vec<Unread>,
    /// Surfaces that faces refer to.
    used: BTreeSet<usize>,
    /// Edges of lists (504), by list and number.
    edges: BTreeMap<(usize, usize), usize>,
    /// Vertices of lists (502), by list and number.
    vertices: BTreeMap<(usize, usize), usize>,
}

/// Reads the faces of a file; those that cannot be read are listed.
pub(super) fn faces(directory: &BTreeMap<usize, Entry>, lists: Lists<'_>, faults: &mut Faults) -> (Brep, Vec<Unread>) {
    let geometry = Geometry { directory, lists, faults, points: 0 };
    let (edges, vertices) = (BTreeMap::new(), BTreeMap::new());
    let mut reader =
        FaceReader { geometry, body: Brep::default(), unread: Vec::new(), used: BTreeSet::new(), edges, vertices };
    for (&number, entry) in directory {
        let (list, _) = match entry.kind {
            143 | 144 | 510 => lists(entry),
            108 if entry.form == 1 => lists(entry),
            _ => continue,
        };
        reader.face(number, entry, &list);
    }
    let bounded = directory.values().any(|entry| matches!(entry.kind, 118 | 120 | 122 | 140));
    if bounded || !reader.body.faces.is_empty() || !reader.unread.is_empty() {
        reader.whole_surfaces();
    }
    (reader.body, reader.unread)
}

/// A pointer of a list.
fn pointer(list: &[f64], k: usize) -> usize {
    list.get(k).copied().filter(|v| (0.0..1e9).contains(v)).unwrap_or(0.0) as usize
}

/// Which curves of a loop run forward, by their ends, where the first does or not; and the sum of the gaps between them.
fn chained(ends: &[[[f64; 3]; 2]], first: bool) -> (Vec<bool>, f64) {
    let apart = |a: [f64; 3], b: [f64; 3]| length(minus(a, b));
    let (mut forward, mut gaps) = (vec![first; ends.len()], 0.0);
    for k in 1..ends.len() {
        let last = ends[k - 1][usize::from(forward[k - 1])];
        let [near, far] = ends[k].map(|end| apart(last, end));
        forward[k] = near <= far;
        gaps += near.min(far);
    }
    (forward, gaps)
}

/// A loop run through the other way round.
fn backward(ring: Ring) -> Ring {
    ring.into_iter().rev().map(|(edge, along)| (edge, !along)).collect()
}

impl FaceReader<'_> {
    fn face(&mut self, number: usize, entry: &Entry, list: &[f64]) {
        let support = match entry.kind {
            143 => pointer(list, 2),
            108 => number,
            _ => pointer(list, 1),
        };
        self.used.insert(support);
        let name = format!("entity {}, D{number}", entry.kind);
        let kind = self.geometry.directory.get(&support).map_or(0, |entry| entry.kind);
        let read = self.geometry.surface(support, 0).ok_or("its surface").and_then(|surface| {
            let loops = match entry.kind {
                144 => self.trimmed(list, &surface),
                143 => self.bounded(list, &surface),
                510 => self.of_solid(list),
                _ => self.pieces(pointer(list, 5)).map(|pieces| (vec![self.ring(pieces)], None)),
            };
            Ok((surface, loops.ok_or("its edges")?))
        });
        self.push(read, (name, number), kind, entry.line);
    }

    fn push(
        &mut self,
        read: Result<(FaceSurface, Loops), &'static str>,
        (name, part): (String, usize),
        kind: usize,
        line: usize,
    ) {
        let kind = format!("of entity {kind}");
        match read {
            Ok((surface, (loops, left))) => {
                self.body.faces.push(BrepFace { name, kind, surface, loops, left, part });
            }
            Err(why) => {
                self.unread.push(Unread { line: Some(line), name, kind, why: format!("{why} cannot be read") });
            }
        }
    }

    /// The surfaces that no face refers to, whole.
    fn whole_surfaces(&mut self) {
        let directory = self.geometry.directory;
        let bases: Vec<usize> = directory
            .values()
            .filter(|entry| entry.kind == 140)
            .map(|entry| pointer(&(self.geometry.lists)(entry).0, 5))
            .collect();
        self.used.extend(bases);
        for (&number, entry) in
            directory.iter().filter(|(_, entry)| matches!(entry.kind, 114 | 118 | 120 | 122 | 128 | 140))
        {
            if self.used.contains(&number) {
                continue;
            }
            let name = format!("entity {}, D{number}", entry.kind);
            let read = self.geometry.surface(number, 0).ok_or("its surface").and_then(|surface| {
                let ends = self.geometry.ends(number, &surface).ok_or("its edges")?;
                let ring = self.around(&surface, ends).ok_or("its edges")?;
                Ok((surface, (vec![ring], Some(true))))
            });
            self.push(read, (name, number), entry.kind, entry.line);
        }
    }

    /// The four sides of a surface, with its inside to their left.
    fn around(&mut self, surface: &FaceSurface, [[a, b], [c, d]]: [[f64; 2]; 2]) -> Option<Ring> {
        let sides = [(1, c, [a, b]), (0, b, [c, d]), (1, d, [b, a]), (0, a, [d, c])];
        let pieces: Option<Vec<Piece>> =
            sides.into_iter().map(|(axis, at, ends)| surface.side(axis, at, ends)).collect();
        Some(pieces?.into_iter().map(|piece| (self.edge(piece), true)).collect())
    }

    fn trimmed(&mut self, list: &[f64], surface: &FaceSurface) -> Option<Loops> {
        let (support, outer, inner) = (pointer(list, 1), pointer(list, 2), pointer(list, 3));
        let (mut loops, mut known) = (Vec::new(), true);
        if outer == 0 {
            let ends = self.geometry.ends(support, surface)?;
            loops.push(self.around(surface, ends)?);
        } else {
            let (ring, left) = self.on_surface(pointer(list, 4), (support, surface))?;
            known &= left.is_some();
            loops.push(if left == Some(false) { backward(ring) } else { ring });
        }
        for k in 0..inner.min(list.len()) {
            // An inner loop encloses what is outside.
            let (ring, left) = self.on_surface(pointer(list, 5 + k), (support, surface))?;
            known &= left.is_some();
            loops.push(if left == Some(true) { backward(ring) } else { ring });
        }
        Some((loops, known.then_some(true)))
    }

    fn bounded(&mut self, list: &[f64], surface: &FaceSurface) -> Option<Loops> {
        let count = pointer(list, 3).min(list.len());
        let loops: Option<Vec<Ring>> = (0..count).map(|k| self.boundary(pointer(list, 4 + k), surface)).collect();
        Some((loops?, None))
    }

    /// A boundary (141): curves in turn.
    fn boundary(&mut self, number: usize, surface: &FaceSurface) -> Option<Ring> {
        let (entry, list, _) = self.geometry.entity(number)?;
        if entry.kind != 141 {
            return None;
        }
        let (count, mut at) = (pointer(&list, 4), 5);
        let mut pieces = Vec::new();
        for _ in 0..count.min(list.len()) {
            let curve = pointer(&list, at);
            let own = pointer(&list, at + 2);
            let found = self.pieces(curve).or_else(|| {
                let own: Option<Vec<Vec<Piece>>> =
                    (0..own).map(|k| self.geometry.mapped(pointer(&list, at + 3 + k), surface, SAMPLES)).collect();
                own.map(|all| all.into_iter().flatten().collect())
            })?;
            let backward = pointer(&list, at + 1) == 2;
            pieces.extend(if backward {
                found.into_iter().rev().map(|(curve, [a, b])| (curve, [b, a])).collect::<Vec<Piece>>()
            } else {
                found
            });
            at += 3 + own;
        }
        Some(self.ring(pieces))
    }

    /// A curve on a surface (142), in space where it is given there, and otherwise by its parameters; and whether what it
    /// encloses among the parameters is to its left.
    fn on_surface(&mut self, number: usize, (support, surface): (usize, &FaceSurface)) -> Option<(Ring, Option<bool>)> {
        let (entry, list, _) = self.geometry.entity(number)?;
        if entry.kind != 142 {
            let pieces = self.pieces(number)?;
            return Some((self.ring(pieces), None));
        }
        let pieces =
            self.pieces(pointer(&list, 4)).or_else(|| self.geometry.mapped(pointer(&list, 3), surface, SAMPLES))?;
        let mut ring = self.ring(pieces);
        let plane = self.geometry.on_parameters(pointer(&list, 3), support);
        let left = plane.and_then(|plane| self.encloses_left(&mut ring, &plane, surface));
        Some((ring, left))
    }

    /// Whether a loop runs around what it encloses among the parameters so that this is to its left; none where its curves
    /// there do not agree with those in space. Closed edges, which have no direction by their ends, take that of these.
    fn encloses_left(&self, ring: &mut Ring, plane: &[Vec<[f64; 2]>], surface: &FaceSurface) -> Option<bool> {
        let apart = |a: [f64; 3], b: [f64; 3]| length(minus(a, b));
        let lifted = |points: &Vec<[f64; 2]>, share: f64| {
            let k = (share * (points.len() - 1) as f64).round() as usize;
            surface.at(points[k])[0]
        };
        let size = plane.iter().map(|points| apart(lifted(points, 0.0), lifted(points, 0.5))).fold(0.0, f64::max);
        let slack = AGREES * size;
        if plane.len() != ring.len() {
            return None;
        }
        let mut same = None;
        let mut closed = Vec::new();
        for (k, (points, &(edge, along))) in plane.iter().zip(ring.iter()).enumerate() {
            let BrepEdge { curve, range: [from, to], .. } = &self.body.edges[edge];
            let own = |share: f64| {
                let share = if along { share } else { 1.0 - share };
                curve.point(from + share * (to - from))
            };
            let off = |a: f64, b: f64| {
                let alike = apart(lifted(points, a), own(a)).max(apart(lifted(points, b), own(b)));
                let crosswise = apart(lifted(points, a), own(b)).max(apart(lifted(points, b), own(a)));
                (alike, crosswise)
            };
            let (alike, crosswise) = off(0.0, 1.0);
            if alike.min(crosswise) > slack {
                return None;
            }
            if alike.max(crosswise) <= slack {
                let (alike, crosswise) = off(0.25, 0.75);
                closed.push((k, alike <= crosswise));
            } else if same.is_some_and(|same| same != (alike <= crosswise)) {
                return None;
            } else {
                same = Some(alike <= crosswise);
            }
        }
        // A gap among the parameters is a point in space: a pole.
        let next = plane.iter().cycle().skip(1);
        for (points, next) in plane.iter().zip(next) {
            let (Some(&a), Some(&b)) = (points.last(), next.first()) else { return None };
            let between = |share: f64| surface.at([0, 1].map(|k: usize| a[k] + share * (b[k] - a[k])))[0];
            if (1..=4).any(|k| apart(between(0.25 * f64::from(k)), between(0.0)) > slack) {
                return None;
            }
        }
        let same = same.or(closed.first().map(|(_, alike)| *alike))?;
        closed.into_iter().filter(|(_, alike)| *alike != same).for_each(|(k, _)| ring[k].1 = !ring[k].1);
        let corners = || plane.iter().flatten();
        let area: f64 = corners().zip(corners().cycle().skip(1)).map(|(a, b)| a[0] * b[1] - b[0] * a[1]).sum();
        (area.abs() > 0.0).then_some((area > 0.0) == same)
    }

    fn pieces(&mut self, number: usize) -> Option<Vec<Piece>> {
        self.geometry.pieces(number, 0)
    }

    /// The loops of a face of a solid (508), whose edges stand in lists (504). The face is to their left about the normal of
    /// its surface.
    fn of_solid(&mut self, list: &[f64]) -> Option<Loops> {
        let count = pointer(list, 2).min(list.len());
        let mut loops = Vec::new();
        for k in 0..count {
            let (entry, ring, _) = self.geometry.entity(pointer(list, 4 + k))?;
            if entry.kind != 508 {
                return None;
            }
            let (number, mut at) = (pointer(&ring, 1).min(ring.len()), 2);
            let mut edges = Vec::new();
            for _ in 0..number {
                if pointer(&ring, at) == 0 {
                    let edge = self.listed(pointer(&ring, at + 1), pointer(&ring, at + 2))?;
                    edges.push((edge, pointer(&ring, at + 3) != 0));
                }
                at += 5 + 2 * pointer(&ring, at + 4).min(ring.len());
            }
            loops.push(edges);
        }
        Some((loops, self.geometry.has_our_normal(pointer(list, 1))))
    }

    fn listed(&mut self, number: usize, index: usize) -> Option<usize> {
        if let Some(&known) = self.edges.get(&(number, index)) {
            return Some(known);
        }
        let (entry, list, _) = self.geometry.entity(number)?;
        if entry.kind != 504 || index == 0 || index > pointer(&list, 1) {
            return None;
        }
        let at = 2 + 5 * (index - 1);
        let ends = [
            self.vertex(pointer(&list, at + 1), pointer(&list, at + 2))?,
            self.vertex(pointer(&list, at + 3), pointer(&list, at + 4))?,
        ];
        let mut pieces = self.pieces(pointer(&list, at))?;
        let (Some((curve, range)), true) = (pieces.pop(), pieces.is_empty()) else { return None };
        self.body.edges.push(BrepEdge { ends, curve, range });
        self.edges.insert((number, index), self.body.edges.len() - 1);
        Some(self.body.edges.len() - 1)
    }

    fn vertex(&mut self, number: usize, index: usize) -> Option<usize> {
        if let Some(&known) = self.vertices.get(&(number, index)) {
            return Some(known);
        }
        let (entry, list, motion) = self.geometry.entity(number)?;
        let at = 2 + 3 * index.checked_sub(1)?;
        let &[x, y, z] = list.get(at..at + 3)? else { return None };
        if entry.kind != 502 || !(x + y + z).is_finite() {
            return None;
        }
        self.body.vertices.push(motion.point([x, y, z]));
        self.vertices.insert((number, index), self.body.vertices.len() - 1);
        Some(self.body.vertices.len() - 1)
    }

    /// Curves end to end as edges, each turned to where the one before it ends; the first as it leaves the smaller gaps, of equal
    /// ones as it is given.
    fn ring(&mut self, pieces: Vec<Piece>) -> Ring {
        let ends: Vec<[[f64; 3]; 2]> =
            pieces.iter().map(|(curve, range): &(SpaceCurve, [f64; 2])| range.map(|t| curve.point(t))).collect();
        let [(given, gap), (turned, other)] = [true, false].map(|first| chained(&ends, first));
        let forward = if other < CLEARLY * gap { turned } else { given };
        pieces.into_iter().zip(forward).map(|(piece, along)| (self.edge(piece), along)).collect()
    }

    /// A curve as an edge between vertices of its own.
    fn edge(&mut self, (curve, range): Piece) -> usize {
        let first = self.body.vertices.len();
        self.body.vertices.extend(range.map(|t| curve.point(t)));
        self.body.edges.push(BrepEdge { ends: [first, first + 1], curve, range });
        self.body.edges.len() - 1
    }
}
