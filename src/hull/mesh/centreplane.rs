//! Half a mesh, closed by a face on the centreplane: the triangles of a constrained Delaunay triangulation of its edges there.

use std::collections::{HashMap, HashSet};

use spade::{ConstrainedDelaunayTriangulation, Point2, Triangulation, mitigate_underflow};

use super::half::Half;
use super::{HullMesh, Region};
use crate::hull::brep::face::inside;

/// The mesh of which the half to port is given, with a face on the centreplane. Its triangles have the vertices of the
/// half alone, and what angles these leave.
pub(super) fn closed(half: &Half) -> HullMesh {
    let mut mesh = HullMesh::default();
    let mut places = HashMap::new();
    for wanted in Region::ALL {
        for &(region, corners) in half.faces.iter().flatten().filter(|(region, _)| *region == wanted) {
            let corners = corners.map(|v| {
                *places.entry(v).or_insert_with(|| {
                    mesh.vertices.push(half.points[v]);
                    mesh.vertices.len() - 1
                })
            });
            mesh.triangles.push((region, corners));
        }
    }
    let edges: HashSet<[usize; 2]> =
        mesh.triangles.iter().flat_map(|(_, [a, b, c])| [[*a, *b], [*b, *c], [*c, *a]]).collect();
    let mut open: Vec<[usize; 2]> = edges.iter().filter(|[a, b]| !edges.contains(&[*b, *a])).copied().collect();
    open.sort_unstable();
    let mut net = ConstrainedDelaunayTriangulation::<Point2<f64>>::new();
    let mut vertices = Vec::new();
    for edge in open {
        let mut handles = Vec::with_capacity(2);
        for v in edge {
            let [x, _, z] = mesh.vertices[v];
            let Ok(handle) = net.insert(mitigate_underflow(Point2::new(x, z))) else { return mesh };
            if handle.index() == vertices.len() {
                vertices.push(v);
            }
            handles.push(handle);
        }
        if handles[0] != handles[1] && net.can_add_constraint(handles[0], handles[1]) {
            net.add_constraint(handles[0], handles[1]);
        }
    }
    let within = inside(&net, &HashSet::new());
    for face in net.inner_faces().filter(|face| within[face.index()]) {
        // Counter-clockwise in x and z: the normal is to starboard.
        mesh.triangles.push((Region::Centreplane, face.vertices().map(|corner| vertices[corner.index()])));
    }
    mesh
}
