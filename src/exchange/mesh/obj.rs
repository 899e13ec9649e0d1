//! Wavefront OBJ: vertices once, a group and a material for each region. Read are vertices and faces (numbers from 1, or back from the
//! last one when negative; `a/b/c` means the vertex a); faces of more corners become fans of triangles, everything else
//! is passed over.

use std::borrow::Cow;
use std::fmt::Write as _;

use super::super::fault::{Faults, RecordFault};
use super::polygons::Polygons;
use super::regions;
use crate::hull::{HullMesh, TriangleMesh};

/// Whether this is the beginning of an OBJ file: lines of vertices before anything that has no place in one.
#[must_use]
pub(in super::super) fn is_obj(bytes: &[u8]) -> bool {
    let start = String::from_utf8_lossy(&bytes[..bytes.len().min(2000)]);
    let vertices = start.lines().filter(|line| line.starts_with("v ")).count();
    let others = start.lines().filter(|line| !line.starts_with(['#', 'v', 'o', 'g', 'm'])).count();
    vertices > 2 && 2 * vertices > others
}

/// Reads an OBJ file, in its own units and axes: its groups and objects with their names.
///
/// # Errors
/// Every fault of the file, up to a number of them.
pub(in super::super) fn read_obj(bytes: &[u8]) -> Result<Vec<(String, TriangleMesh)>, Vec<RecordFault>> {
    let text = String::from_utf8_lossy(bytes);
    let mut faults = Faults::default();
    let mut mesh = Polygons::default();
    // A line that ends with a backslash goes on in the next.
    let mut joined: Vec<(usize, Cow<'_, str>)> = Vec::new();
    let mut goes_on = false;
    for (k, line) in text.lines().enumerate() {
        let part = line.trim_end().strip_suffix('\\');
        let own = part.unwrap_or(line);
        match joined.last_mut().filter(|_| goes_on) {
            Some((_, begun)) => *begun = Cow::Owned(format!("{begun} {own}")),
            None => joined.push((k, Cow::Borrowed(own))),
        }
        goes_on = part.is_some();
    }
    for (k, line) in &joined {
        let (k, line) = (*k, line.as_ref());
        let mut words = line.split_whitespace();
        match words.next() {
            Some("v") => {
                let point: Vec<&str> = words.collect();
                // A vertex may carry a weight or a colour.
                if let Some(point) = faults.point(k + 1, line, &point[..point.len().min(3)], 3) {
                    mesh.vertices.push(point);
                }
            }
            Some("g" | "o") => {
                let name: Vec<&str> = words.collect();
                mesh.begin(&name.join(" "));
            }
            Some("f") => {
                let mut face = Vec::new();
                let before = faults.list.len();
                for word in words {
                    let number = word.split('/').next().unwrap_or_default().parse::<i64>();
                    let place = number.ok().and_then(|n| match n {
                        1.. => usize::try_from(n - 1).ok(),
                        0 => None,
                        _ => mesh.vertices.len().checked_sub(usize::try_from(n.unsigned_abs()).ok()?),
                    });
                    match place.filter(|place| *place < mesh.vertices.len()) {
                        Some(place) => face.push(place),
                        None => {
                            let message = format!("no vertex; there are {} so far", mesh.vertices.len());
                            faults.add(Some(k + 1), word, message);
                        }
                    }
                }
                if faults.list.len() == before && !mesh.face(Some(k + 1), &face, &mut faults) {
                    break;
                }
            }
            _ => {}
        }
        if faults.is_full() {
            break;
        }
    }
    mesh.finish_parts(faults)
}

/// Text of an OBJ file, in the unit of the mesh; x forward, y to port, z up.
#[must_use]
pub fn write_obj(mesh: &HullMesh, name: &str) -> String {
    let one_line = name.replace(['\n', '\r'], " ");
    let mut text = format!("# {one_line}: x forward, y to port, z up\no hull\n");
    for [x, y, z] in &mesh.vertices {
        let _ = writeln!(text, "v {x} {y} {z}");
    }
    for (region, list) in regions(mesh) {
        let _ = writeln!(text, "g {0}\nusemtl {0}", region.name());
        for [a, b, c] in list {
            let _ = writeln!(text, "f {} {} {}", a + 1, b + 1, c + 1);
        }
    }
    text
}
