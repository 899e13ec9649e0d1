//! STL (3D Systems, 1988): binary, all regions in one solid; and ASCII, a named solid for each region.
//!
//! A file is binary when its length is 84 + 50 n bytes, n being the number in bytes 81 to 84, whatever it begins with. It is
//! too where it has bytes of 0 and is longer, or states no triangles. Names are UTF-8 or what is nearest to it.
//! Normals of files are not read.

use std::fmt::Write as _;

use super::super::fault::{Faults, RecordFault};
use super::polygons::Polygons;
use super::{MOST_TRIANGLES, normal, regions};
use crate::hull::{HullMesh, TriangleMesh};
use crate::units::counted;

/// Bytes before the triangles of a binary file, and bytes of each.
const HEADER: usize = 84;
const RECORD: usize = 50;

/// The number of triangles that a binary file states.
fn stated_count(bytes: &[u8]) -> Option<usize> {
    Some(bytes.get(HEADER - 4..HEADER)?.iter().rev().fold(0_usize, |n, &byte| n << 8 | usize::from(byte)))
}

/// The number of triangles of a binary file; none when the length is not that of one.
fn binary_count(bytes: &[u8]) -> Option<usize> {
    let count = stated_count(bytes)?;
    (count > 0 && bytes.len() == HEADER + RECORD * count).then_some(count)
}

/// The number of triangles of a binary file with bytes after its last triangle, or that states none; none of a text.
fn binary_count_at_least(bytes: &[u8]) -> Option<usize> {
    let whole = bytes.len().checked_sub(HEADER)? / RECORD;
    let count = match stated_count(bytes)? {
        0 if bytes.len() == HEADER + RECORD * whole => whole,
        count => count,
    };
    (bytes.contains(&0) && (1..=whole).contains(&count)).then_some(count)
}

/// Text without the mark of its coding.
fn unmarked(text: &str) -> &str {
    text.trim_start_matches('\u{feff}')
}

/// Whether a text begins as ASCII STL does; some programs write its words in capitals.
fn is_solid(text: &str) -> bool {
    unmarked(text).split_whitespace().next().is_some_and(|word| word.eq_ignore_ascii_case("solid"))
}

/// Whether these are the bytes of an STL file.
#[must_use]
pub(in super::super) fn is_stl(bytes: &[u8]) -> bool {
    if binary_count(bytes).is_some() {
        return true;
    }
    let start = String::from_utf8_lossy(&bytes[..bytes.len().min(2000)]).to_ascii_lowercase();
    is_solid(&start) && start.contains("facet")
}

/// Reads an STL file, in its own units and axes: its solids with their names.
///
/// # Errors
/// Every fault of the file, up to a number of them.
pub(in super::super) fn read_stl(bytes: &[u8]) -> Result<Vec<(String, TriangleMesh)>, Vec<RecordFault>> {
    match binary_count(bytes).or_else(|| binary_count_at_least(bytes)) {
        Some(count) => read_binary(bytes, count).map(|mesh| vec![("body".to_owned(), mesh)]),
        None => read_ascii(bytes),
    }
}

fn read_binary(bytes: &[u8], count: usize) -> Result<TriangleMesh, Vec<RecordFault>> {
    let mut faults = Faults::default();
    if count > MOST_TRIANGLES {
        faults.add(None, "", format!("{count} triangles; at most {MOST_TRIANGLES} are read"));
        return Err(faults.list);
    }
    let mut corners = Vec::with_capacity(count);
    for (k, record) in bytes[HEADER..].chunks_exact(RECORD).take(count).enumerate() {
        let mut triangle = [[0.0; 3]; 3];
        for (slot, real) in triangle.iter_mut().flatten().zip(record[12..48].chunks_exact(4)) {
            *slot = f64::from(f32::from_le_bytes([real[0], real[1], real[2], real[3]]));
        }
        if faults.corners(k, &triangle) {
            corners.push(triangle);
        }
        if faults.is_full() {
            break;
        }
    }
    faults.or(|| TriangleMesh::from_corners(corners.into_iter()))
}

/// The statements of a line, of which there are often all of the file: a word and those up to the next one that may follow it.
/// Names may be any words but `facet`.
fn statements<'a>(words: &'a [&'a str]) -> Vec<&'a [&'a str]> {
    let following = |word: &str| -> &[&str] {
        match word.to_ascii_lowercase().as_str() {
            "solid" => &["facet", "endsolid"],
            "facet" => &["outer"],
            "outer" => &["vertex"],
            "vertex" => &["vertex", "endloop"],
            "endloop" => &["endfacet", "outer"],
            "endfacet" => &["facet", "endsolid"],
            "endsolid" => &["solid"],
            _ => &[],
        }
    };
    let mut found = Vec::new();
    let mut from = 0;
    while from < words.len() {
        let next = following(words[from]);
        let is_next = |word: &&str| next.iter().any(|other| word.eq_ignore_ascii_case(other));
        let to = words[from + 1..].iter().position(is_next).map_or(words.len(), |at| from + 1 + at);
        found.push(&words[from..to]);
        from = to;
    }
    found
}

fn read_ascii(bytes: &[u8]) -> Result<Vec<(String, TriangleMesh)>, Vec<RecordFault>> {
    let text = String::from_utf8_lossy(bytes);
    let mut faults = Faults::default();
    // Bytes of a binary file after a header that begins with `solid`.
    let is_binary = bytes.iter().take(1000).any(|byte| *byte == 0);
    if !is_solid(&text) || is_binary {
        let count = stated_count(bytes).unwrap_or(0);
        let wanted = HEADER + RECORD * count;
        faults.add(None, "", format!("{} bytes; a binary file of {count} triangles has {wanted}", bytes.len()));
        return Err(faults.list);
    }
    let (mut mesh, mut triangle) = (Polygons::default(), Vec::new());
    for (k, line) in unmarked(&text).lines().enumerate() {
        for words in statements(&line.split_whitespace().collect::<Vec<_>>()) {
            match words[0].to_ascii_lowercase().as_str() {
                "vertex" => {
                    if let Some(point) = faults.point(k + 1, &words.join(" "), &words[1..], 3) {
                        triangle.push(point);
                    }
                }
                "outer" => triangle.clear(),
                "endloop" => match triangle[..] {
                    [a, b, c] => {
                        if !mesh.push([a, b, c], k + 1, &mut faults) {
                            return mesh.finish_parts(faults);
                        }
                    }
                    _ => faults.add(
                        Some(k + 1),
                        &words.join(" "),
                        format!("a loop of {}, expected 3", counted(triangle.len(), "corner")),
                    ),
                },
                "solid" => mesh.begin(&words[1..].join(" ")),
                "facet" | "endfacet" | "endsolid" => {}
                _ => {
                    let expected = "expected solid, facet, outer loop, vertex, endloop or their ends";
                    faults.add(Some(k + 1), &words.join(" "), expected.to_owned());
                }
            }
            if faults.is_full() {
                return mesh.finish_parts(faults);
            }
        }
    }
    mesh.finish_parts(faults)
}

/// Binary STL: 80 bytes of header, the number of triangles, and for each its normal, its corners as 32-bit reals \[m\]
/// and two bytes that say nothing.
#[must_use]
pub fn write_stl(mesh: &HullMesh, name: &str) -> Vec<u8> {
    let mut header: Vec<u8> = name.as_bytes().to_vec();
    // A header that begins with "solid" is taken for ASCII.
    if header.starts_with(b"solid") {
        header.insert(0, b' ');
    }
    header.resize(80, b' ');
    let mut bytes = header;
    let count = u32::try_from(mesh.triangles.len()).unwrap_or(u32::MAX);
    bytes.extend(count.to_le_bytes());
    for (_, list) in regions(mesh) {
        for corners in list {
            let corners = corners.map(|k| mesh.vertices[k]);
            for point in [normal(corners)].into_iter().chain(corners) {
                for coordinate in point {
                    bytes.extend((coordinate as f32).to_le_bytes());
                }
            }
            bytes.extend([0, 0]);
        }
    }
    bytes
}

/// ASCII STL: `solid hull`, `solid transom`, ... each with its triangles \[m\].
#[must_use]
pub fn write_stl_ascii(mesh: &HullMesh) -> String {
    let mut text = String::new();
    let mut put = |line: String| {
        text.push_str(&line);
        text.push('\n');
    };
    for (region, list) in regions(mesh) {
        put(format!("solid {}", region.name()));
        for corners in list {
            let corners = corners.map(|k| mesh.vertices[k]);
            let [x, y, z] = normal(corners);
            put(format!("facet normal {x:e} {y:e} {z:e}\nouter loop"));
            for [x, y, z] in corners {
                let mut line = String::from("vertex");
                for coordinate in [x, y, z] {
                    let _ = write!(line, " {coordinate}");
                }
                put(line);
            }
            put("endloop\nendfacet".to_owned());
        }
        put(format!("endsolid {}", region.name()));
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_of_ascii_files_may_be_broken_anywhere() {
        let text = "solid outer hull\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n\
                    endsolid outer hull\nsolid keel\nfacet normal 0 0 1\nouter loop\nvertex 0 0 1\nvertex 1 0 1\nvertex 0 1 1\n\
                    endloop\nendfacet\nendsolid\n";
        let parts = read_stl(text.as_bytes()).unwrap();
        assert_eq!(parts.iter().map(|(name, _)| name.as_str()).collect::<Vec<_>>(), ["outer hull", "keel"]);
        assert_eq!(read_stl(text.replace('\n', " ").as_bytes()).unwrap(), parts);
        let broken = text.replace("vertex 1 0 0", "vertex 1 zero 0").replace('\n', " ");
        assert_eq!(read_stl(broken.as_bytes()).unwrap_err()[0].found, "zero");
    }
}
