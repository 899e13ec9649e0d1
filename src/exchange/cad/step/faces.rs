//! The faces of a STEP file (ISO 10303-42, topology): surfaces inside loops of edges, moved by the placements of their assemblies.

use std::collections::{BTreeMap, BTreeSet};

use super::super::surfaces::Unread;
use super::geometry::{Frame, Geometry, is_true};
use super::read::{Instance, Value};
use crate::hull::{Brep, BrepEdge, BrepFace, Motion, SpaceCurve};

/// Keywords of faces.
const FACES: [&str; 2] = ["ADVANCED_FACE", "FACE_SURFACE"];

/// Assemblies of assemblies at most, and faces of all their parts.
const DEEPEST: usize = 24;
const MOST_FACES: usize = 200_000;

/// Reads the faces of all parts; those that cannot be read are listed.
pub(super) fn faces(geometry: &mut Geometry<'_>) -> (Brep, Vec<Unread>) {
    let instances = geometry.instances;
    let mut body = Brep::default();
    let mut unread = Vec::new();
    let mut known = Known::default();
    let placed = placements(geometry);
    for (&number, instance) in instances {
        let Some([_, Value::List(bounds), surface, sense, ..]) =
            FACES.iter().find_map(|keyword| instance.part(keyword))
        else {
            continue;
        };
        let name = format!("#{number}");
        let kind = geometry.get(surface).map_or_else(String::new, Instance::kind);
        let same = is_true(sense);
        let read = geometry.surface(surface, 0).ok_or("its surface").and_then(|surface| {
            let loops = bounds.iter().map(|bound| known.bound(geometry, &mut body, bound));
            Ok((surface, loops.collect::<Option<Vec<_>>>().ok_or("its edges")?))
        });
        match read {
            Ok((surface, loops)) => {
                body.faces.push(BrepFace { name, kind, surface, loops, left: Some(same), part: number as usize });
            }
            Err(why) => {
                unread.push(Unread { line: Some(instance.line), name, kind, why: format!("{why} cannot be read") })
            }
        }
    }
    (placed.apply(body), unread)
}

/// Vertices and edges by their instances.
#[derive(Default)]
struct Known {
    vertices: BTreeMap<u64, usize>,
    edges: BTreeMap<u64, usize>,
}

impl Known {
    /// The edges of a bound of a face, so that its inside is to the left about the normal of the face.
    fn bound(&mut self, geometry: &mut Geometry<'_>, body: &mut Brep, bound: &Value) -> Option<Vec<(usize, bool)>> {
        let instances = geometry.instances;
        let Value::Reference(number) = bound else { return None };
        let bound = instances.get(number)?;
        let keywords = ["FACE_OUTER_BOUND", "FACE_BOUND"];
        let [_, Value::Reference(ring), forward, ..] = keywords.iter().find_map(|keyword| bound.part(keyword))? else {
            return None;
        };
        let ring = instances.get(ring)?;
        if ring.part("VERTEX_LOOP").is_some() {
            return Some(Vec::new());
        }
        let mut list = if let Some([_, Value::List(corners), ..]) = ring.part("POLY_LOOP") {
            self.polygon(geometry, body, corners)?
        } else {
            let [_, Value::List(edges), ..] = ring.part("EDGE_LOOP")? else { return None };
            edges.iter().map(|edge| self.oriented(geometry, body, edge)).collect::<Option<Vec<_>>>()?
        };
        if !is_true(forward) {
            list.reverse();
            list.iter_mut().for_each(|(_, along)| *along = !*along);
        }
        Some(list)
    }

    fn polygon(&mut self, geometry: &Geometry<'_>, body: &mut Brep, corners: &[Value]) -> Option<Vec<(usize, bool)>> {
        let mut ends = Vec::with_capacity(corners.len());
        for corner in corners {
            let Value::Reference(number) = corner else { return None };
            ends.push(self.vertex_at(*number, geometry.point(corner)?, body));
        }
        let pairs = ends.iter().zip(ends.iter().cycle().skip(1)).filter(|(a, b)| a != b);
        let mut list = Vec::new();
        for (&a, &b) in pairs {
            let curve = SpaceCurve::between(body.vertices[a], body.vertices[b]);
            body.edges.push(BrepEdge { ends: [a, b], curve, range: [0.0, 1.0] });
            list.push((body.edges.len() - 1, true));
        }
        Some(list)
    }

    fn oriented(&mut self, geometry: &mut Geometry<'_>, body: &mut Brep, value: &Value) -> Option<(usize, bool)> {
        let instances = geometry.instances;
        let Value::Reference(number) = value else { return None };
        let [_, _, _, Value::Reference(edge), forward, ..] = instances.get(number)?.part("ORIENTED_EDGE")? else {
            return None;
        };
        let forward = is_true(forward);
        if let Some(&known) = self.edges.get(edge) {
            return Some((known, forward));
        }
        let [_, from, to, curve, sense, ..] = instances.get(edge)?.part("EDGE_CURVE")? else { return None };
        let ends = [self.vertex(geometry, body, from)?, self.vertex(geometry, body, to)?];
        let curve = geometry.curve(curve, 0)?;
        body.edges.push(BrepEdge::new(curve, ends, &body.vertices, is_true(sense)));
        self.edges.insert(*edge, body.edges.len() - 1);
        Some((body.edges.len() - 1, forward))
    }

    fn vertex(&mut self, geometry: &Geometry<'_>, body: &mut Brep, value: &Value) -> Option<usize> {
        let Value::Reference(number) = value else { return None };
        let [_, point, ..] = geometry.part(value, "VERTEX_POINT")? else { return None };
        Some(self.vertex_at(*number, geometry.point(point)?, body))
    }

    fn vertex_at(&mut self, number: u64, point: [f64; 3], body: &mut Brep) -> usize {
        *self.vertices.entry(number).or_insert_with(|| {
            body.vertices.push(point);
            body.vertices.len() - 1
        })
    }
}

/// Faces with the same motions.
type Group = (Vec<Motion>, BTreeSet<usize>);

/// Where the faces of a file stand: of each all its motions, where assemblies move it.
struct Placed {
    motions: BTreeMap<usize, Vec<Motion>>,
}

impl Placed {
    /// The body with every face where its assemblies put it.
    fn apply(&self, body: Brep) -> Brep {
        if self.motions.is_empty() {
            return body;
        }
        let mut groups: BTreeMap<Vec<[u64; 12]>, Group> = BTreeMap::new();
        for (k, face) in body.faces.iter().enumerate() {
            let motions = self.motions.get(&face.part).cloned().unwrap_or_else(|| vec![Motion::NONE]);
            let key = motions.iter().map(Motion::bits).collect();
            groups.entry(key).or_insert_with(|| (motions, BTreeSet::new())).1.insert(k);
        }
        let mut all = Brep::default();
        for (motions, faces) in groups.into_values() {
            for motion in motions {
                if all.faces.len() + faces.len() <= MOST_FACES {
                    all.add(&body, &faces, &motion);
                }
            }
        }
        all
    }
}

/// The motion that takes one frame to another.
fn between((from, a): Frame, (to, b): Frame) -> Motion {
    let row = |k: usize| {
        let turn = [0, 1, 2].map(|j: usize| (0..3).map(|i| b[i][k] * a[i][j]).sum::<f64>());
        let moved: f64 = (0..3).map(|j| turn[j] * from[j]).sum();
        [turn[0], turn[1], turn[2], to[k] - moved]
    };
    Motion([row(0), row(1), row(2)])
}

/// The representations of a file that assemblies use, and by which motions.
fn placements(geometry: &Geometry<'_>) -> Placed {
    let instances = geometry.instances;
    // Of each representation those that it is part of.
    let mut above: BTreeMap<u64, Vec<(u64, Motion)>> = BTreeMap::new();
    let mut moves = false;
    for instance in instances.values() {
        let Some((child, parent, motion)) = relation(geometry, instance) else { continue };
        moves |= motion != Motion::NONE;
        above.entry(child).or_default().push((parent, motion));
    }
    let mapped = |number: u64| -> Option<(u64, Motion)> {
        let [_, source, target, ..] = instances.get(&number)?.part("MAPPED_ITEM")? else { return None };
        let [origin, Value::Reference(used), ..] = geometry.part(source, "REPRESENTATION_MAP")? else { return None };
        Some((*used, between(geometry.placement(origin)?, geometry.placement(target)?)))
    };
    let mut items: BTreeMap<u64, Vec<u64>> = BTreeMap::new();
    for (&number, instance) in instances.iter().filter(|(_, i)| i.kind().ends_with("SHAPE_REPRESENTATION")) {
        let Some([_, Value::List(list), ..]) = instance.parts.first().map(|(_, values)| values.as_slice()) else {
            continue;
        };
        for value in list {
            let Value::Reference(item) = value else { continue };
            items.entry(number).or_default().push(*item);
            if let Some((used, motion)) = mapped(*item) {
                moves = true;
                above.entry(used).or_default().push((number, motion));
            }
        }
    }
    let mut motions: BTreeMap<usize, Vec<Motion>> = BTreeMap::new();
    if !moves {
        return Placed { motions };
    }
    for (&number, list) in &items {
        let found = faces_of(instances, list);
        if found.is_empty() {
            continue;
        }
        let own = paths(&above, number, 0);
        for face in found {
            motions.entry(face as usize).or_default().extend(own.iter().copied());
        }
    }
    Placed { motions }
}

/// What two representations have to do with each other: the part, what it is part of, and how it is moved.
fn relation(geometry: &Geometry<'_>, instance: &Instance) -> Option<(u64, u64, Motion)> {
    let own = instance.part("SHAPE_REPRESENTATION_RELATIONSHIP").filter(|list| list.len() >= 4);
    let [_, _, Value::Reference(first), Value::Reference(second), ..] =
        own.or_else(|| instance.part("REPRESENTATION_RELATIONSHIP"))?
    else {
        return None;
    };
    let Some([Value::Reference(operator), ..]) = instance.part("REPRESENTATION_RELATIONSHIP_WITH_TRANSFORMATION")
    else {
        // Two names of one: the plain one is that of the assembly.
        let is_plain =
            |number: u64| geometry.instances.get(&number).is_some_and(|i| i.kind() == "SHAPE_REPRESENTATION");
        let (child, parent) = if is_plain(*first) { (second, first) } else { (first, second) };
        return Some((*child, *parent, Motion::NONE));
    };
    let [_, _, from, to, ..] = geometry.instances.get(operator)?.part("ITEM_DEFINED_TRANSFORMATION")? else {
        return None;
    };
    Some((*first, *second, between(geometry.placement(from)?, geometry.placement(to)?)))
}

/// All motions from a representation up to those that are part of no other.
fn paths(above: &BTreeMap<u64, Vec<(u64, Motion)>>, number: u64, depth: usize) -> Vec<Motion> {
    match above.get(&number) {
        Some(list) if depth < DEEPEST => list
            .iter()
            .flat_map(|(parent, motion)| {
                let motion = *motion;
                paths(above, *parent, depth + 1).into_iter().map(move |outer| outer.after(&motion))
            })
            .take(MOST_FACES)
            .collect(),
        _ => vec![Motion::NONE],
    }
}

/// The faces that items of a representation are made of.
fn faces_of(instances: &BTreeMap<u64, Instance>, items: &[u64]) -> BTreeSet<u64> {
    let mut found = BTreeSet::new();
    let mut seen = BTreeSet::new();
    let mut next: Vec<u64> = items.to_vec();
    while let Some(number) = next.pop() {
        let Some(instance) = instances.get(&number).filter(|_| seen.insert(number)) else { continue };
        if FACES.iter().any(|keyword| instance.part(keyword).is_some()) {
            found.insert(number);
            continue;
        }
        if instance.part("MAPPED_ITEM").is_some() {
            continue;
        }
        let mut values: Vec<&Value> = instance.parts.iter().flat_map(|(_, values)| values).collect();
        while let Some(value) = values.pop() {
            match value {
                Value::Reference(other) => next.push(*other),
                Value::List(list) | Value::Typed(list) => values.extend(list),
                _ => {}
            }
        }
    }
    found
}
