//! Binary glTF 2.0 (Khronos, ISO/IEC 12113): one mesh, a primitive and a colour for each region. glTF has y up and z
//! towards the viewer: X = x, Y = z, Z = -y. Read are the triangles of all meshes (primitives of mode 4 with positions
//! as 32-bit reals), each as it stands in its mesh: transformations of nodes are not heeded, and a file that has some
//! is refused.

use serde_json::{Value, json};
use std::collections::HashSet;

use super::super::fault::{Faults, RecordFault};
use super::{MOST_TRIANGLES, regions};
use crate::hull::{HullMesh, Region, TriangleMesh};

/// 32-bit little-endian integers by which a file of glTF is known.
const MAGIC: u32 = 0x4654_6C67;
const JSON_CHUNK: u32 = 0x4E4F_534A;
const BINARY_CHUNK: u32 = 0x004E_4942;

/// Numbers of glTF for 32-bit reals, 32-bit integers, and the two kinds of buffers.
const REAL: u64 = 5126;
const INDEX: u64 = 5125;
const VERTICES: u32 = 34962;
const INDICES: u32 = 34963;

/// Colours (red, green, blue) that differ in lightness too.
fn colour(region: Region) -> [f64; 3] {
    match region {
        Region::Hull => [0.0, 0.27, 0.45],
        Region::Bottom => [0.55, 0.15, 0.1],
        Region::Transom => [0.35, 0.55, 0.7],
        Region::Bow => [0.2, 0.4, 0.6],
        Region::Deck => [0.85, 0.8, 0.7],
    }
}

/// Bytes of a GLB file \[m\].
#[must_use]
pub fn write_glb(mesh: &HullMesh, name: &str) -> Vec<u8> {
    let places: Vec<[f32; 3]> = mesh.vertices.iter().map(|&[x, y, z]| [x as f32, z as f32, (0.0 - y) as f32]).collect();
    let ends =
        |pick: fn(f32, f32) -> f32, from: f32| [0, 1, 2].map(|k| places.iter().map(|place| place[k]).fold(from, pick));
    let (least, greatest) = (ends(f32::min, f32::INFINITY), ends(f32::max, f32::NEG_INFINITY));
    let mut binary: Vec<u8> = places.iter().flatten().flat_map(|coordinate| coordinate.to_le_bytes()).collect();
    let mut views = vec![json!({"buffer": 0, "byteOffset": 0, "byteLength": binary.len(), "target": VERTICES})];
    let mut accessors = vec![json!({
        "bufferView": 0, "componentType": REAL, "count": places.len(), "type": "VEC3", "min": least, "max": greatest,
    })];
    let (mut primitives, mut materials) = (Vec::new(), Vec::new());
    for (region, list) in regions(mesh) {
        let offset = binary.len();
        let indices = list.iter().flatten().map(|&k| u32::try_from(k).unwrap_or(u32::MAX));
        binary.extend(indices.flat_map(u32::to_le_bytes));
        views.push(json!({
            "buffer": 0, "byteOffset": offset, "byteLength": binary.len() - offset, "target": INDICES,
        }));
        accessors.push(json!({
            "bufferView": views.len() - 1, "componentType": INDEX, "count": 3 * list.len(), "type": "SCALAR",
        }));
        let [red, green, blue] = colour(region);
        materials.push(json!({
            "name": region.name(),
            "pbrMetallicRoughness": {
                "baseColorFactor": [red, green, blue, 1.0], "metallicFactor": 0.1, "roughnessFactor": 0.6,
            },
        }));
        primitives.push(json!({
            "attributes": {"POSITION": 0}, "indices": accessors.len() - 1, "material": materials.len() - 1,
        }));
    }
    let scene = json!({
        "asset": {"version": "2.0", "generator": "loftsman"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0, "name": name}],
        "meshes": [{"name": name, "primitives": primitives}],
        "materials": materials,
        "accessors": accessors,
        "bufferViews": views,
        "buffers": [{"byteLength": binary.len()}],
    });
    let mut text = scene.to_string().into_bytes();
    text.resize(text.len().next_multiple_of(4), b' ');
    binary.resize(binary.len().next_multiple_of(4), 0);
    let mut bytes = Vec::with_capacity(28 + text.len() + binary.len());
    let size = |length: usize| u32::try_from(length).unwrap_or(u32::MAX);
    for word in [MAGIC, 2, size(28 + text.len() + binary.len()), size(text.len()), JSON_CHUNK] {
        bytes.extend(word.to_le_bytes());
    }
    bytes.extend(text);
    for word in [size(binary.len()), BINARY_CHUNK] {
        bytes.extend(word.to_le_bytes());
    }
    bytes.extend(binary);
    bytes
}

/// Whether these are the bytes of a GLB file.
#[must_use]
pub(in super::super) fn is_glb(bytes: &[u8]) -> bool {
    bytes.starts_with(&MAGIC.to_le_bytes())
}

fn word(bytes: &[u8], at: usize) -> Option<usize> {
    let four: [u8; 4] = bytes.get(at..at.checked_add(4)?)?.try_into().ok()?;
    usize::try_from(u32::from_le_bytes(four)).ok()
}

/// What an accessor shows of the binary part: its bytes, the distance between its items, their number, and their kind.
struct Items<'a> {
    bytes: &'a [u8],
    stride: usize,
    count: usize,
    kind: u64,
}

fn size_of(value: &Value, key: &str) -> Option<usize> {
    value.get(key).map_or(Some(0), |value| value.as_u64().and_then(|n| usize::try_from(n).ok()))
}

/// The items of an accessor of `width` bytes of the kinds that are `allowed`.
fn items<'a>(
    scene: &Value,
    binary: &'a [u8],
    number: &Value,
    parts: usize,
    allowed: &[(u64, usize)],
) -> Option<Items<'a>> {
    let accessor = scene.get("accessors")?.get(usize::try_from(number.as_u64()?).ok()?)?;
    let view = scene.get("bufferViews")?.get(usize::try_from(accessor.get("bufferView")?.as_u64()?).ok()?)?;
    let kind = accessor.get("componentType")?.as_u64()?;
    let width = parts * allowed.iter().find(|(other, _)| *other == kind)?.1;
    let (count, stride) = (size_of(accessor, "count")?, size_of(view, "byteStride")?.max(width));
    let from = size_of(view, "byteOffset")?.checked_add(size_of(accessor, "byteOffset")?)?;
    let bytes = binary.get(from..)?;
    let needed = count.checked_sub(1).map_or(Some(0), |k| k.checked_mul(stride)?.checked_add(width))?;
    (needed <= bytes.len()).then_some(Items { bytes, stride, count, kind })
}

impl Items<'_> {
    fn index(&self, k: usize) -> usize {
        let at = &self.bytes[k * self.stride..];
        match self.kind {
            INDEX => u32::from_le_bytes([at[0], at[1], at[2], at[3]]) as usize,
            5123 => usize::from(u16::from_le_bytes([at[0], at[1]])),
            _ => usize::from(at[0]),
        }
    }

    fn point(&self, k: usize) -> [f64; 3] {
        let at = &self.bytes[k * self.stride..];
        let real = |n: usize| f64::from(f32::from_le_bytes([at[n], at[n + 1], at[n + 2], at[n + 3]]));
        [real(0), real(4), real(8)]
    }
}

/// The triangles of a primitive; none when it does not say them as it must.
fn primitive(scene: &Value, binary: &[u8], value: &Value) -> Option<Vec<[[f64; 3]; 3]>> {
    if value.get("mode").is_some_and(|mode| mode.as_u64() != Some(4)) {
        return Some(Vec::new());
    }
    let points = items(scene, binary, value.get("attributes")?.get("POSITION")?, 3, &[(REAL, 4)])?;
    let order: Vec<usize> = match value.get("indices") {
        Some(number) => {
            let list = items(scene, binary, number, 1, &[(INDEX, 4), (5123, 2), (5121, 1)])?;
            (0..list.count).map(|k| list.index(k)).collect()
        }
        None => (0..points.count).collect(),
    };
    if order.iter().any(|&k| k >= points.count) {
        return None;
    }
    Some(order.chunks_exact(3).map(|t| [t[0], t[1], t[2]].map(|k| points.point(k))).collect())
}

/// Reads a GLB file, in its own axes (y up).
///
/// # Errors
/// Every fault of the file, up to a number of them.
pub(in super::super) fn read_glb(bytes: &[u8]) -> Result<TriangleMesh, Vec<RecordFault>> {
    let mut faults = Faults::default();
    let text = word(bytes, 12).and_then(|size| bytes.get(20..20_usize.checked_add(size)?));
    let scene = text.and_then(|text| serde_json::from_slice::<Value>(text).ok());
    let (Some(text), Some(scene)) = (text, scene) else {
        faults.add(None, "first chunk", "expected a scene of glTF 2.0 in JSON".to_owned());
        return Err(faults.list);
    };
    let binary = bytes.get(28 + text.len()..).unwrap_or_default();
    let list = |value: &Value, key: &str| value.get(key).and_then(Value::as_array).cloned().unwrap_or_default();
    for (k, node) in list(&scene, "nodes").iter().enumerate() {
        if ["matrix", "translation", "rotation", "scale"].iter().any(|key| node.get(*key).is_some()) {
            faults.add(
                None,
                &format!("node {k}"),
                "nodes that are moved are not read; apply the transformations and write it again".to_owned(),
            );
        }
    }
    let mut corners = Vec::new();
    let mut seen = HashSet::new();
    for (m, mesh) in list(&scene, "meshes").iter().enumerate() {
        for (p, value) in list(mesh, "primitives").iter().enumerate() {
            // The same triangles again are no others.
            if !seen.insert(format!("{:?} {:?} {:?}", value.get("mode"), value.get("attributes"), value.get("indices")))
            {
                continue;
            }
            match primitive(&scene, binary, value) {
                Some(found) => corners.extend(found),
                None => faults.add(
                    None,
                    &format!("mesh {m}, primitive {p}"),
                    "its positions or indices are not in the file".to_owned(),
                ),
            }
            if corners.len() > MOST_TRIANGLES {
                faults.add(None, "", format!("more than {MOST_TRIANGLES} triangles"));
                return Err(faults.list);
            }
        }
    }
    for (k, triangle) in corners.iter().enumerate() {
        faults.corners(k, triangle);
        if faults.is_full() {
            break;
        }
    }
    if corners.is_empty() && faults.list.is_empty() {
        faults.add(None, "", "no triangles".to_owned());
    }
    faults.or(|| TriangleMesh::from_corners(corners.into_iter()))
}
