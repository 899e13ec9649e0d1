//! PLY (G. Turk, The Stanford Repository, 1994): a header of elements with their properties, then the elements, as text or
//! as bytes of either order. Of vertices x, y and z are read, of faces the list of their vertices, of strips of triangles
//! the list of theirs, where -1 begins another. Elements stand in the order of the header, faces before vertices too.

use std::fmt::Write as _;

use super::super::fault::RecordFault;
use super::numbers::{Coding, Kind, Numbers};
use super::polygons::Polygons;
use super::title;
use crate::hull::{HullMesh, TriangleMesh};

/// Names of kinds of numbers.
const KINDS: [(&str, Kind); 16] = [
    ("char", Kind::Signed(1)),
    ("uchar", Kind::Unsigned(1)),
    ("short", Kind::Signed(2)),
    ("ushort", Kind::Unsigned(2)),
    ("int", Kind::Signed(4)),
    ("uint", Kind::Unsigned(4)),
    ("float", Kind::Real(4)),
    ("double", Kind::Real(8)),
    ("int8", Kind::Signed(1)),
    ("uint8", Kind::Unsigned(1)),
    ("int16", Kind::Signed(2)),
    ("uint16", Kind::Unsigned(2)),
    ("int32", Kind::Signed(4)),
    ("uint32", Kind::Unsigned(4)),
    ("float32", Kind::Real(4)),
    ("float64", Kind::Real(8)),
];

/// A property of an element: its name, the kind of its numbers, and that of their number where it is a list.
struct Property {
    name: String,
    kind: Kind,
    list: Option<Kind>,
}

struct Element {
    name: String,
    count: usize,
    properties: Vec<Property>,
}

/// Whether these are the bytes of a PLY file.
pub(in super::super) fn is_ply(bytes: &[u8]) -> bool {
    bytes.starts_with(b"ply\n") || bytes.starts_with(b"ply\r")
}

/// Reads a PLY file, in its own units and axes.
///
/// # Errors
/// Every fault of the file, up to a number of them.
pub(in super::super) fn read_ply(bytes: &[u8]) -> Result<TriangleMesh, Vec<RecordFault>> {
    let (mut numbers, mut mesh) = (Numbers::of(bytes), Polygons::default());
    if let Some((coding, elements)) = header(&mut numbers) {
        numbers.coding = coding;
        let mut faces = Faces { waiting: elements.iter().any(|element| element.name == "vertex").then(Vec::new) };
        let _ = elements.iter().try_for_each(|element| {
            read(element, &mut numbers, &mut mesh, &mut faces)?;
            if element.name == "vertex" { faces.release(&mut numbers, &mut mesh) } else { Some(()) }
        });
    }
    mesh.finish(numbers.faults)
}

fn header(numbers: &mut Numbers<'_>) -> Option<(Coding, Vec<Element>)> {
    let (mut coding, mut elements) = (None, Vec::<Element>::new());
    let kind = |name: &str| KINDS.iter().find(|(known, _)| *known == name).map(|(_, kind)| *kind);
    loop {
        let Some(line) = numbers.rest_of_line() else {
            numbers.faults.add(numbers.place(), "", "the file ends, expected end_header".to_owned());
            return None;
        };
        let words: Vec<&str> = line.split_whitespace().collect();
        let understood = match words[..] {
            [] | ["ply" | "comment" | "obj_info", ..] => Some(()),
            ["format", name, _] => {
                coding = match name {
                    "ascii" => Some(Coding::Text),
                    "binary_little_endian" => Some(Coding::LittleEndian),
                    "binary_big_endian" => Some(Coding::BigEndian),
                    _ => None,
                };
                coding.map(|_| ())
            }
            ["element", name, count] => count
                .parse()
                .ok()
                .map(|count| elements.push(Element { name: name.to_owned(), count, properties: Vec::new() })),
            ["property", "list", of, many, name] => kind(of).zip(kind(many)).and_then(|(of, many)| {
                let property = Property { name: name.to_owned(), kind: many, list: Some(of) };
                elements.last_mut().map(|element| element.properties.push(property))
            }),
            ["property", of, name] => kind(of).and_then(|kind| {
                let property = Property { name: name.to_owned(), kind, list: None };
                elements.last_mut().map(|element| element.properties.push(property))
            }),
            ["end_header"] => break,
            _ => None,
        };
        if understood.is_none() {
            numbers.faults.add(numbers.place(), line, "no line of a header of PLY 1.0".to_owned());
            return None;
        }
    }
    if coding.is_none() {
        numbers.faults.add(None, "", "the header has no line `format`".to_owned());
    }
    Some((coding?, elements))
}

/// Vertices of a face, or of a strip of triangles, and its line.
struct Face {
    line: Option<usize>,
    places: Vec<usize>,
    is_strip: bool,
}

/// Faces that wait for their vertices; none once these are known.
struct Faces {
    waiting: Option<Vec<Face>>,
}

impl Faces {
    /// Adds a face, or keeps it until there are vertices; none where the file has too many faults.
    fn add(&mut self, face: Face, numbers: &mut Numbers<'_>, mesh: &mut Polygons) -> Option<()> {
        if let Some(waiting) = &mut self.waiting {
            waiting.push(face);
            return Some(());
        }
        let Face { line, places, is_strip } = face;
        let goes_on = if is_strip {
            mesh.strip(&places, &mut numbers.faults)
        } else {
            mesh.face(line, &places, &mut numbers.faults)
        };
        goes_on.then_some(())
    }

    /// Adds what waited.
    fn release(&mut self, numbers: &mut Numbers<'_>, mesh: &mut Polygons) -> Option<()> {
        let waiting = self.waiting.take().unwrap_or_default();
        waiting.into_iter().try_for_each(|face| self.add(face, numbers, mesh))
    }
}

/// Reads all of an element.
fn read(element: &Element, numbers: &mut Numbers<'_>, mesh: &mut Polygons, faces: &mut Faces) -> Option<()> {
    let Element { name, count, properties } = element;
    let bytes = |property: &Property| {
        if numbers.coding == Coding::Text { 1 } else { property.list.unwrap_or(property.kind).bytes() }
    };
    let least = properties.iter().map(bytes).sum();
    if *count > 0 && properties.is_empty() {
        numbers.faults.add(None, name, "an element without properties".to_owned());
        return None;
    }
    if !numbers.holds(*count, least, &format!("items of {name}")) {
        return None;
    }
    let axes = ["x", "y", "z"].map(|axis| properties.iter().position(|p| p.name == axis && p.list.is_none()));
    let is_vertex = name == "vertex";
    if is_vertex && axes.iter().any(Option::is_none) {
        numbers.faults.add(None, name, "vertices have no x, y and z".to_owned());
        return None;
    }
    for item in 0..*count {
        let what = format!("{name} {} of {count}", item + 1);
        let mut point = [0.0; 3];
        for (place, property) in properties.iter().enumerate() {
            let Some(of) = property.list else {
                match axes.iter().position(|axis| is_vertex && *axis == Some(place)) {
                    Some(axis) => point[axis] = numbers.real(property.kind, &what)?,
                    None => numbers.skip(property.kind, &what)?,
                }
                continue;
            };
            let long = numbers.whole(of, &what)?;
            let width = if numbers.coding == Coding::Text { 2 } else { property.kind.bytes() };
            if !numbers.holds(long, width, "numbers of a list") {
                return None;
            }
            let is_vertices = matches!(property.name.as_str(), "vertex_indices" | "vertex_index");
            if is_vertices && name == "face" {
                let places: Vec<usize> =
                    (0..long).map(|_| numbers.whole(property.kind, &what)).collect::<Option<_>>()?;
                faces.add(Face { line: numbers.place(), places, is_strip: false }, numbers, mesh)?;
            } else if is_vertices && name == "tristrips" {
                let places: Vec<f64> = (0..long).map(|_| numbers.real(property.kind, &what)).collect::<Option<_>>()?;
                for strip in places.split(|place| *place < 0.0) {
                    let places: Vec<usize> = strip.iter().map(|place| *place as usize).collect();
                    faces.add(Face { line: None, places, is_strip: true }, numbers, mesh)?;
                }
            } else {
                (0..long).try_for_each(|_| numbers.skip(property.kind, &what))?;
            }
        }
        if is_vertex {
            mesh.vertices.push(point);
        }
    }
    Some(())
}

/// Text of a PLY file, in the unit of the mesh; x forward, y to port, z up.
#[must_use]
pub fn write_ply(mesh: &HullMesh, name: &str) -> String {
    let mut text = format!("ply\nformat ascii 1.0\ncomment {}: x forward, y to port, z up\n", title(name));
    let _ = writeln!(text, "element vertex {}", mesh.vertices.len());
    text.push_str("property double x\nproperty double y\nproperty double z\n");
    let _ = writeln!(text, "element face {}", mesh.triangles.len());
    text.push_str("property list uchar int vertex_indices\nend_header\n");
    for [x, y, z] in &mesh.vertices {
        let _ = writeln!(text, "{x} {y} {z}");
    }
    for (_, [a, b, c]) in &mesh.triangles {
        let _ = writeln!(text, "3 {a} {b} {c}");
    }
    text
}
