//! Faces over numbered vertices, as most mesh files give them, made into triangles.

use std::collections::HashMap;

use super::super::fault::{Faults, RecordFault};
use super::MOST_TRIANGLES;
use crate::hull::TriangleMesh;
use crate::units::counted;

/// The name of faces that no group has.
const BODY: &str = "body";

/// The vertices and faces read so far.
#[derive(Default)]
pub(super) struct Polygons {
    pub(super) vertices: Vec<[f64; 3]>,
    corners: Vec<[[f64; 3]; 3]>,
    /// Names, each with the triangle from which it holds.
    names: Vec<(String, usize)>,
}

impl Polygons {
    /// Adds a face by the places of its vertices, from 0, as triangles from the first; whether to go on.
    pub(super) fn face(&mut self, line: Option<usize>, places: &[usize], faults: &mut Faults) -> bool {
        if places.len() < 3 {
            faults.add(line, "", format!("a face of {}", counted(places.len(), "corner")));
            return !faults.is_full();
        }
        if let Some(place) = places.iter().find(|place| **place >= self.vertices.len()) {
            faults.add(line, &place.to_string(), format!("no vertex; there are {}", self.vertices.len()));
            return !faults.is_full();
        }
        for k in 2..places.len() {
            self.triangle([places[0], places[k - 1], places[k]]);
        }
        self.has_room(line, faults)
    }

    /// Adds a triangle by its corners; whether to go on.
    pub(super) fn push(&mut self, corners: [[f64; 3]; 3], line: usize, faults: &mut Faults) -> bool {
        self.corners.push(corners);
        self.has_room(Some(line), faults)
    }

    /// Adds triangles of vertices that are known to be there.
    fn triangle(&mut self, places: [usize; 3]) {
        self.corners.push(places.map(|place| self.vertices[place]));
    }

    /// Adds a strip of triangles, every second turned.
    pub(super) fn strip(&mut self, places: &[usize], faults: &mut Faults) -> bool {
        let turned =
            |(k, t): (usize, &[usize])| if k.is_multiple_of(2) { [t[0], t[1], t[2]] } else { [t[1], t[0], t[2]] };
        places.windows(3).enumerate().map(turned).all(|t| self.face(None, &t, faults))
    }

    fn has_room(&self, line: Option<usize>, faults: &mut Faults) -> bool {
        if self.corners.len() > MOST_TRIANGLES {
            faults.add(line, "", format!("more than {MOST_TRIANGLES} triangles"));
            return false;
        }
        true
    }

    /// Begins a part of a name; faces before the first have the name of the body.
    pub(super) fn begin(&mut self, name: &str) {
        self.names.push((name.to_owned(), self.corners.len()));
    }

    /// The parts with their names, each once, in the order of the file.
    ///
    /// # Errors
    /// As for [`Self::finish`].
    pub(super) fn finish_parts(self, mut faults: Faults) -> Result<Vec<(String, TriangleMesh)>, Vec<RecordFault>> {
        let Self { corners, names, .. } = self;
        if corners.is_empty() && faults.list.is_empty() {
            faults.add(None, "", "no faces".to_owned());
        }
        if !faults.list.is_empty() {
            return Err(faults.list);
        }
        let mut parts: Vec<(String, Vec<[[f64; 3]; 3]>)> = Vec::new();
        let mut places: HashMap<&str, usize> = HashMap::new();
        let ends = names.iter().skip(1).map(|(_, from)| *from).chain([corners.len()]);
        let first = (BODY.to_owned(), 0);
        let until = names.first().map_or(corners.len(), |(_, from)| *from);
        let ranges = std::iter::once((&first, until)).chain(names.iter().zip(ends));
        for ((name, from), to) in ranges.filter(|((_, from), to)| from < to) {
            let place = *places.entry(name).or_insert_with(|| {
                parts.push((name.clone(), Vec::new()));
                parts.len() - 1
            });
            parts[place].1.extend(&corners[*from..to]);
        }
        let mesh = |(name, list): (String, Vec<_>)| (name, TriangleMesh::from_corners(list.into_iter()));
        Ok(parts.into_iter().map(mesh).collect())
    }

    /// # Errors
    /// The faults, and that there are no faces.
    pub(super) fn finish(self, mut faults: Faults) -> Result<TriangleMesh, Vec<RecordFault>> {
        if self.corners.is_empty() && faults.list.is_empty() {
            faults.add(None, "", "no faces".to_owned());
        }
        faults.or(|| TriangleMesh::from_corners(self.corners.into_iter()))
    }
}

/// A face of six or eight nodes, corners first, then the middles of its sides, as triangles or quadrilaterals between
/// its nodes, and of nine with its middle; other faces as they are.
pub(super) fn through_middles(nodes: &[usize]) -> Vec<Vec<usize>> {
    let by = |parts: &[&[usize]]| parts.iter().map(|part| part.iter().map(|&k| nodes[k]).collect()).collect();
    match nodes.len() {
        6 => by(&[&[0, 3, 5], &[3, 1, 4], &[5, 4, 2], &[3, 4, 5]]),
        8 => by(&[&[0, 4, 7], &[4, 1, 5], &[5, 2, 6], &[6, 3, 7], &[4, 5, 6, 7]]),
        9 => by(&[&[0, 4, 8, 7], &[4, 1, 5, 8], &[8, 5, 2, 6], &[7, 8, 6, 3]]),
        _ => vec![nodes.to_vec()],
    }
}
