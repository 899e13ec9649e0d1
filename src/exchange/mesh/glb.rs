//! Writing of binary glTF 2.0 (Khronos, ISO/IEC 12113): one mesh, a primitive and a colour for each region. glTF has y up
//! and z towards the viewer: X = x, Y = z, Z = -y.

use serde_json::json;

use super::regions;
use crate::hull::{HullMesh, Region};

/// 32-bit little-endian integers by which a file of glTF is known.
pub(super) const MAGIC: u32 = 0x4654_6C67;
const JSON_CHUNK: u32 = 0x4E4F_534A;
const BINARY_CHUNK: u32 = 0x004E_4942;

/// Numbers of glTF for 32-bit reals, 32-bit integers, and the two kinds of buffers.
pub(super) const REAL: u64 = 5126;
pub(super) const INDEX: u64 = 5125;
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
        Region::Centreplane => [0.6, 0.6, 0.6],
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
