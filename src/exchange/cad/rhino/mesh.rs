//! Meshes of an archive: vertices of 32 bits, those of 64 bits where the file has them, triangles and quadrilaterals.

use super::archive::Versions;
use super::chunks::{class, crc};
use super::cursor::{Cursor, Object};
use crate::exchange::fault::LARGEST;
use crate::exchange::mesh::MOST_TRIANGLES;
use crate::hull::TriangleMesh;

/// A packed byte stands for this many bytes at most.
const MOST_PACKED: usize = 1040;

/// Vertices of a face, at most, and those of a mesh of few faces: more are of no ship, and would unpack to much memory.
const MOST_VERTICES: usize = 12;
const FEW_VERTICES: usize = 1000;

/// Vertices of 64 bits that leave those of 32 bits by more than this part of a coordinate are old.
const ALIKE: f64 = 1e-6;

/// Reads a mesh, in the unit of the file; `left` is how many triangles more are read of the file.
///
/// # Errors
/// Why it cannot be read.
pub(super) fn read(object: &Object<'_>, versions: Versions, left: &mut usize) -> Result<TriangleMesh, &'static str> {
    let mut data = object.data.inside;
    let [major, minor] = data.version().ok_or(CUT)?;
    let [vertices, faces] = head(&mut data).ok_or(CUT)?;
    if vertices > 3 * MOST_TRIANGLES || 2 * faces > MOST_TRIANGLES {
        return Err("it has more triangles than are read");
    }
    if 2 * faces > *left {
        return Err("the meshes of the file have more triangles together than are read");
    }
    if vertices > MOST_VERTICES * faces + FEW_VERTICES {
        return Err("it has far more vertices than its faces need");
    }
    let quads = quads(&mut data, faces).ok_or(CUT)?;
    let points = match major {
        1 => {
            let count = data.count(12).ok_or(CUT)?;
            singles(data.take(12 * count).ok_or(CUT)?)
        }
        3 => packed(&mut data, [major, minor], vertices, versions)?,
        _ => return Err("its records have a version that is not read"),
    };
    let points = beside(object).filter(|own| is_alike(own, &points)).unwrap_or(points);
    let mesh = triangles(&points, &quads)?;
    *left = left.saturating_sub(mesh.triangles.len());
    Ok(mesh)
}

const CUT: &str = "its records end within a value";

/// The numbers of vertices and faces, up to the faces.
fn head(data: &mut Cursor<'_>) -> Option<[usize; 2]> {
    let [vertices, faces] = [data.int()?, data.int()?].map(usize::try_from);
    // Domains, scales, boxes, and whether it is closed.
    data.take(64 + 16 + 24 + 24 + 16 + 4)?;
    // How it was made, and statistics of its curvature.
    for _ in 0..5 {
        if data.flag()? {
            data.anonymous()?;
        }
    }
    Some([vertices.ok()?, faces.ok()?])
}

/// Faces of four vertices each; of triangles the last one is given twice.
fn quads(data: &mut Cursor<'_>, faces: usize) -> Option<Vec<[usize; 4]>> {
    let size = usize::try_from(data.int()?).ok().filter(|size| matches!(size, 1 | 2 | 4))?;
    let bytes = data.take(faces.checked_mul(4 * size)?)?;
    let number = |bytes: &[u8]| bytes.iter().rev().fold(0_usize, |n, &byte| n << 8 | usize::from(byte));
    let quad = |bytes: &[u8]| [0, 1, 2, 3].map(|k| number(&bytes[k * size..(k + 1) * size]));
    Some(bytes.chunks_exact(4 * size).map(quad).collect())
}

fn singles(bytes: &[u8]) -> Vec<[f64; 3]> {
    let number = |b: &[u8]| f64::from(f32::from_le_bytes([b[0], b[1], b[2], b[3]]));
    bytes.chunks_exact(12).map(|p| [number(&p[..4]), number(&p[4..8]), number(&p[8..])]).collect()
}

fn doubles(bytes: &[u8]) -> Vec<[f64; 3]> {
    let number = |b: &[u8]| f64::from_le_bytes([b[0], b[1], b[2], b[3], b[4], b[5], b[6], b[7]]);
    bytes.chunks_exact(24).map(|p| [number(&p[..8]), number(&p[8..16]), number(&p[16..])]).collect()
}

/// The vertices of a mesh whose arrays may be packed.
fn packed(
    data: &mut Cursor<'_>,
    [_, minor]: [u8; 2],
    vertices: usize,
    versions: Versions,
) -> Result<Vec<[f64; 3]>, &'static str> {
    if vertices == 0 {
        return Ok(Vec::new());
    }
    let points = singles(&buffer(data, Some(12 * vertices))?);
    // Normals, texture coordinates, curvatures and colours.
    for _ in 0..4 {
        buffer(data, None)?;
    }
    if minor < 7 {
        return Ok(points);
    }
    let wide = later(data, vertices, versions)?;
    Ok(wide.filter(|own| is_alike(own, &points)).unwrap_or(points))
}

/// The vertices of 64 bits that stand at the end of a mesh from version 6 on.
fn later(data: &mut Cursor<'_>, vertices: usize, versions: Versions) -> Result<Option<Vec<[f64; 3]>>, &'static str> {
    data.take(4 + 16).ok_or(CUT)?;
    buffer(data, None)?;
    if versions.toolkit >= 200_606_010 {
        data.anonymous().ok_or(CUT)?;
    }
    data.take(3).ok_or(CUT)?;
    if data.flag().ok_or(CUT)? {
        data.anonymous().ok_or(CUT)?;
    }
    if !data.flag().ok_or(CUT)? {
        return Ok(None);
    }
    let mut inside = data.anonymous().ok_or(CUT)?;
    // Two numbers of a version, and how many there are.
    inside.take(12).ok_or(CUT)?;
    buffer(&mut inside, Some(24 * vertices)).map(|bytes| Some(doubles(&bytes)))
}

/// An array with its length; without a `wanted` length it is passed over.
fn buffer(data: &mut Cursor<'_>, wanted: Option<usize>) -> Result<Vec<u8>, &'static str> {
    let length = data.int().and_then(|length| usize::try_from(length).ok()).ok_or(CUT)?;
    if wanted.is_some_and(|wanted| wanted != length) {
        return Err("its array of vertices has another length than it states");
    }
    if length == 0 {
        return Ok(Vec::new());
    }
    let stated = data.int().ok_or(CUT)?.cast_unsigned();
    let bytes = if data.flag().ok_or(CUT)? {
        let packed = data.chunk().ok_or(CUT)?.inside.rest();
        if wanted.is_none() {
            return Ok(Vec::new());
        }
        if length > MOST_PACKED.saturating_mul(packed.len()) {
            return Err("a packed array states more bytes than it can hold");
        }
        unpacked(packed, length)?
    } else {
        data.take(length).ok_or(CUT)?.to_vec()
    };
    if wanted.is_some() && crc(0, &bytes) != stated {
        return Err("an array of it is damaged: its CRC is another one");
    }
    Ok(bytes)
}

#[cfg(feature = "packages")]
fn unpacked(packed: &[u8], length: usize) -> Result<Vec<u8>, &'static str> {
    use std::io::Read as _;
    let mut bytes = Vec::new();
    let decoder = flate2::read::ZlibDecoder::new(packed);
    decoder.take(length as u64 + 1).read_to_end(&mut bytes).map_err(|_| "a packed array of it is damaged")?;
    if bytes.len() == length { Ok(bytes) } else { Err("a packed array has another length than it states") }
}

#[cfg(not(feature = "packages"))]
fn unpacked(_: &[u8], _: usize) -> Result<Vec<u8>, &'static str> {
    Err("its arrays are packed, which needs the feature `packages` of the library")
}

/// The vertices of 64 bits that stand beside a mesh of version 5.
fn beside(object: &Object<'_>) -> Option<Vec<[f64; 3]>> {
    let (_, data) = object.beside.iter().find(|(class, _)| *class == class::DOUBLE_VERTICES)?;
    let mut inside = { *data }.anonymous()?;
    // Two numbers of a version, two of vertices, two CRCs.
    inside.take(24)?;
    let count = inside.count(24)?;
    inside.take(24 * count).map(doubles)
}

/// Whether vertices are those of 32 bits but for rounding.
fn is_alike(own: &[[f64; 3]], points: &[[f64; 3]]) -> bool {
    let near = |a: &[f64; 3], b: &[f64; 3]| {
        let size = b.iter().fold(0.0, |m: f64, c| m.max(c.abs()));
        a.iter().zip(b).all(|(a, b)| (a - b).abs() <= ALIKE * size)
    };
    own.len() == points.len() && own.iter().zip(points).all(|(a, b)| near(a, b))
}

fn triangles(points: &[[f64; 3]], quads: &[[usize; 4]]) -> Result<TriangleMesh, &'static str> {
    if !points.iter().flatten().all(|c| c.abs() <= LARGEST) {
        return Err("a vertex of it is no number of at most 1e8");
    }
    let mut corners = Vec::with_capacity(2 * quads.len());
    for &quad in quads {
        if quad.iter().any(|&k| k >= points.len()) {
            return Err("a face of it has a vertex that it has not");
        }
        let [a, b, c, d] = quad.map(|k| points[k]);
        corners.push([a, b, c]);
        if quad[2] != quad[3] {
            corners.push([a, c, d]);
        }
    }
    Ok(TriangleMesh::from_corners(corners.into_iter()))
}
