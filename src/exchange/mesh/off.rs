//! OFF (Geomview, The Geometry Center, 1996): `OFF`, numbers of vertices, faces and edges, the vertices, and the faces, each
//! with the number of its corners. Colours and normals behind them are left out.

use super::super::fault::RecordFault;
use super::numbers::{DOUBLE, Numbers};
use super::polygons::Polygons;
use crate::hull::TriangleMesh;

/// First words of files whose vertices begin with x, y and z.
const KINDS: [&str; 7] = ["OFF", "COFF", "NOFF", "CNOFF", "STOFF", "STCNOFF", "STCOFF"];

/// Whether these are the bytes of an OFF file.
pub(in super::super) fn is_off(bytes: &[u8]) -> bool {
    Numbers::of(&bytes[..bytes.len().min(1000)]).word().is_some_and(|word| KINDS.contains(&word))
}

/// Reads an OFF file of text, in its own units and axes.
///
/// # Errors
/// Every fault of the file, up to a number of them.
pub(in super::super) fn read_off(bytes: &[u8]) -> Result<TriangleMesh, Vec<RecordFault>> {
    let (mut numbers, mut mesh) = (Numbers::of(bytes), Polygons::default());
    let _ = read(&mut numbers, &mut mesh);
    mesh.finish(numbers.faults)
}

/// Reads up to the first fault after which nothing can be told.
fn read(numbers: &mut Numbers<'_>, mesh: &mut Polygons) -> Option<()> {
    let word = numbers.word().unwrap_or_default();
    if !KINDS.contains(&word) {
        numbers.faults.add(numbers.place(), word, format!("expected one of {}", KINDS.join(", ")));
        return None;
    }
    let line = numbers.line();
    let (vertices, faces) = (numbers.count("the number of vertices, as text")?, numbers.count("the number of faces")?);
    numbers.next_line(line);
    if !(numbers.holds(vertices, 6, "vertices") && numbers.holds(faces, 7, "faces")) {
        return None;
    }
    for k in 0..vertices {
        let line = numbers.line();
        mesh.vertices.push(numbers.point(DOUBLE, &format!("vertex {} of {vertices}", k + 1))?);
        numbers.next_line(line);
    }
    for k in 0..faces {
        let line = numbers.line();
        let what = format!("face {} of {faces}", k + 1);
        let corners = numbers.count(&what).filter(|corners| numbers.holds(*corners, 2, "corners"))?;
        let places: Vec<usize> = (0..corners).map(|_| numbers.count(&what)).collect::<Option<_>>()?;
        if !mesh.face(Some(line), &places, &mut numbers.faults) {
            return None;
        }
        numbers.next_line(line);
    }
    Some(())
}
