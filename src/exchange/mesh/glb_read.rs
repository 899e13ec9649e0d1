//! Reading of glTF 2.0 (Khronos, ISO/IEC 12113), binary or as text with its bytes in base 64, in its own axes (y up).
//!
//! Read are the triangles (modes 4, 5 and 6) of the meshes that the nodes of the scene show, each moved by its node and the
//! nodes above it. A node has a matrix, column by column, or M = T R S of a translation, a unit quaternion (x, y, z, w) and
//! a scale. Positions are 32-bit reals or quantised integers (KHR_mesh_quantization). Without nodes all meshes are read as
//! they stand. What else moves vertices, or packs them, is refused by its name.

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use nalgebra::{Matrix4, Point3, Quaternion, Translation3, UnitQuaternion, Vector3};
use serde_json::Value;
use std::borrow::Cow;
use std::collections::HashSet;

use super::super::fault::{Faults, RecordFault};
use super::MOST_TRIANGLES;
use super::glb::{INDEX, MAGIC, REAL};
use crate::hull::TriangleMesh;

/// Kinds of integers, with their bytes.
const INTEGERS: [(u64, usize); 5] = [(5120, 1), (5121, 1), (5122, 2), (5123, 2), (INDEX, 4)];

/// What packs or repeats geometry and is not read.
const PACKED: [&str; 4] =
    ["KHR_draco_mesh_compression", "EXT_meshopt_compression", "KHR_meshopt_compression", "EXT_mesh_gpu_instancing"];

/// Whether these are the bytes of a GLB file.
#[must_use]
pub(in super::super) fn is_glb(bytes: &[u8]) -> bool {
    bytes.starts_with(&MAGIC.to_le_bytes())
}

fn word(bytes: &[u8], at: usize) -> Option<usize> {
    let four: [u8; 4] = bytes.get(at..at.checked_add(4)?)?.try_into().ok()?;
    usize::try_from(u32::from_le_bytes(four)).ok()
}

fn number(value: &Value) -> Option<usize> {
    value.as_u64().and_then(|n| usize::try_from(n).ok())
}

/// What packs or repeats the geometry of a value, if anything does.
fn refused(value: &Value) -> Option<String> {
    let name = PACKED.iter().find(|name| value.get("extensions").is_some_and(|all| all.get(**name).is_some()))?;
    Some(format!("{name} is not read; write the file without it"))
}

fn list<'a>(value: &'a Value, key: &str) -> &'a [Value] {
    value.get(key).and_then(Value::as_array).map_or(&[], Vec::as_slice)
}

/// What an accessor shows of the binary part: its bytes, the distance between its items, their number, and their kind.
struct Items<'a> {
    bytes: &'a [u8],
    stride: usize,
    count: usize,
    kind: u64,
    /// Whether integers stand for parts of their greatest.
    normalized: bool,
}

fn size_of(value: &Value, key: &str) -> Option<usize> {
    value.get(key).map_or(Some(0), number)
}

/// The items of an accessor of `parts` numbers of the kinds that are `allowed`.
fn items<'a>(
    scene: &Value,
    buffers: &'a Buffers<'_>,
    accessor: &Value,
    parts: usize,
    allowed: impl Iterator<Item = (u64, usize)>,
) -> Result<Items<'a>, String> {
    let missing = || "its positions or indices are not in the file".to_owned();
    let accessor = number(accessor).and_then(|k| scene.get("accessors")?.get(k)).ok_or_else(missing)?;
    if accessor.get("sparse").is_some() {
        return Err("sparse accessors are not read".to_owned());
    }
    let view = accessor.get("bufferView").and_then(number).and_then(|k| scene.get("bufferViews")?.get(k));
    let view = view.ok_or_else(missing)?;
    if let Some(message) = refused(view) {
        return Err(message);
    }
    let found = || {
        let kind = accessor.get("componentType")?.as_u64()?;
        let width = parts * { allowed }.find(|(other, _)| *other == kind)?.1;
        let (count, stride) = (size_of(accessor, "count")?, size_of(view, "byteStride")?.max(width));
        let from = size_of(view, "byteOffset")?.checked_add(size_of(accessor, "byteOffset")?)?;
        let bytes = buffers.get(size_of(view, "buffer")?)?.get(from..)?;
        let needed = count.checked_sub(1).map_or(Some(0), |k| k.checked_mul(stride)?.checked_add(width))?;
        let normalized = accessor.get("normalized").and_then(Value::as_bool).unwrap_or(false);
        (needed <= bytes.len()).then_some(Items { bytes, stride, count, kind, normalized })
    };
    found().ok_or_else(missing)
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

    fn point(&self, k: usize) -> Point3<f64> {
        let at = &self.bytes[k * self.stride..];
        let two = |n: usize| [at[2 * n], at[2 * n + 1]];
        // With the greatest of the kind.
        let part = |n: usize| match self.kind {
            5120 => (f64::from(at[n].cast_signed()), 127.0),
            5121 => (f64::from(at[n]), 255.0),
            5122 => (f64::from(i16::from_le_bytes(two(n))), 32767.0),
            5123 => (f64::from(u16::from_le_bytes(two(n))), 65535.0),
            _ => (f64::from(f32::from_le_bytes([at[4 * n], at[4 * n + 1], at[4 * n + 2], at[4 * n + 3]])), 1.0),
        };
        let is_part = self.normalized && self.kind != REAL;
        let value = |n: usize| match part(n) {
            (value, greatest) if is_part => (value / greatest).max(-1.0),
            (value, _) => value,
        };
        Point3::from([0, 1, 2].map(value))
    }
}

/// The triangles of a primitive.
fn primitive(scene: &Value, buffers: &Buffers<'_>, value: &Value) -> Result<Vec<[Point3<f64>; 3]>, String> {
    let mode = value.get("mode").map_or(Some(4), Value::as_u64);
    if !matches!(mode, Some(4..=6)) {
        return Ok(Vec::new());
    }
    if let Some(message) = refused(value) {
        return Err(message);
    }
    let missing = || "it has no positions".to_owned();
    let positions = value.get("attributes").and_then(|all| all.get("POSITION")).ok_or_else(missing)?;
    let allowed = INTEGERS[..4].iter().copied().chain([(REAL, 4)]);
    let points = items(scene, buffers, positions, 3, allowed)?;
    let order: Vec<usize> = match value.get("indices") {
        Some(number) => {
            let unsigned = INTEGERS.into_iter().filter(|(kind, _)| ![5120, 5122].contains(kind));
            let list = items(scene, buffers, number, 1, unsigned)?;
            (0..list.count).map(|k| list.index(k)).collect()
        }
        None => (0..points.count).collect(),
    };
    if let Some(k) = order.iter().find(|&&k| k >= points.count) {
        return Err(format!("index {k} of {} positions", points.count));
    }
    let corners = |t: [usize; 3]| t.map(|k| points.point(k));
    Ok(match mode {
        Some(5) => order.windows(3).map(|t| corners([t[0], t[1], t[2]])).collect(),
        Some(6) => order.windows(2).skip(1).map(|t| corners([order[0], t[0], t[1]])).collect(),
        _ => order.chunks_exact(3).map(|t| corners([t[0], t[1], t[2]])).collect(),
    })
}

/// What a node does to what it holds; the fault where it is none.
fn transformation(node: &Value) -> Result<Matrix4<f64>, String> {
    let numbers = |key: &str, count: usize| -> Result<Option<Vec<f64>>, String> {
        let Some(value) = node.get(key) else { return Ok(None) };
        let found: Option<Vec<f64>> = value.as_array().and_then(|all| all.iter().map(Value::as_f64).collect());
        let found = found.filter(|all| all.len() == count && all.iter().all(|value| value.is_finite()));
        found.map(Some).ok_or_else(|| format!("{key} must be {count} numbers"))
    };
    if let Some(matrix) = numbers("matrix", 16)? {
        return Ok(Matrix4::from_column_slice(&matrix));
    }
    let [translation, scale] = [("translation", 0.0), ("scale", 1.0)].map(|(key, none)| {
        numbers(key, 3).map(|found| found.map_or(Vector3::repeat(none), |all| Vector3::from_column_slice(&all)))
    });
    let rotation = match numbers("rotation", 4)? {
        None => UnitQuaternion::identity(),
        Some(all) => UnitQuaternion::try_new(Quaternion::new(all[3], all[0], all[1], all[2]), 1e-6)
            .ok_or("rotation must be a unit quaternion")?,
    };
    let moved = Translation3::from(translation?).to_homogeneous() * rotation.to_homogeneous();
    Ok(moved * Matrix4::new_nonuniform_scaling(&scale?))
}

/// The meshes that the scene shows, each with what moves it; all as they stand where it has no nodes.
fn shown(scene: &Value, faults: &mut Faults) -> Vec<(usize, Matrix4<f64>)> {
    let nodes = list(scene, "nodes");
    if nodes.is_empty() {
        return (0..list(scene, "meshes").len()).map(|mesh| (mesh, Matrix4::identity())).collect();
    }
    let children = |node: &Value| list(node, "children").iter().filter_map(number).collect::<Vec<_>>();
    let below: HashSet<usize> = nodes.iter().flat_map(children).collect();
    let first = scene.get("scene").map_or(Some(0), number).and_then(|k| list(scene, "scenes").get(k));
    let roots: Vec<usize> = match first {
        Some(first) => list(first, "nodes").iter().filter_map(number).collect(),
        None => (0..nodes.len()).filter(|k| !below.contains(k)).collect(),
    };
    let mut found = Vec::new();
    let mut seen = HashSet::new();
    let mut open: Vec<(usize, Matrix4<f64>)> = roots.into_iter().rev().map(|k| (k, Matrix4::identity())).collect();
    while let Some((k, above)) = open.pop() {
        let name = format!("node {k}");
        let Some(node) = nodes.get(k) else {
            faults.add(None, &name, format!("there are {} nodes", nodes.len()));
            continue;
        };
        if !seen.insert(k) {
            faults.add(None, &name, "it is below two nodes, or below itself".to_owned());
            continue;
        }
        let matrix = match transformation(node) {
            Ok(own) => above * own,
            Err(message) => {
                faults.add(None, &name, message);
                continue;
            }
        };
        let skin = || node.get("skin").map(|_| "a skin is not read; write the file without it".to_owned());
        if let Some(message) = refused(node).or_else(skin) {
            faults.add(None, &name, message);
        }
        found.extend(node.get("mesh").and_then(number).map(|mesh| (mesh, matrix)));
        open.extend(children(node).into_iter().rev().map(|child| (child, matrix)));
    }
    found
}

/// The bytes of each buffer.
type Buffers<'a> = Vec<Cow<'a, [u8]>>;

/// The buffers of a scene: the first without an address is `binary`; others stand in the text, in base 64.
fn buffers<'a>(scene: &Value, binary: &'a [u8], faults: &mut Faults) -> Buffers<'a> {
    let mut all = Vec::new();
    for (k, buffer) in list(scene, "buffers").iter().enumerate() {
        let bytes = match buffer.get("uri").and_then(Value::as_str) {
            None => Some(Cow::Borrowed(if k == 0 { binary } else { &[] })),
            Some(uri) => {
                let text = uri.strip_prefix("data:").and_then(|rest| rest.split_once(";base64,"));
                text.and_then(|(_, text)| STANDARD.decode(text).ok()).map(Cow::Owned)
            }
        };
        if bytes.is_none() {
            let message =
                "its bytes are neither in the file nor beside it; write one file (GLB, or glTF with its bytes in it)"
                    .to_owned();
            faults.add(None, &format!("buffer {k}"), message);
        }
        all.push(bytes.unwrap_or_default());
    }
    all
}

/// Whether these are the bytes of a scene of glTF as text.
#[must_use]
pub(in super::super) fn is_gltf(bytes: &[u8]) -> bool {
    let start = String::from_utf8_lossy(&bytes[..bytes.len().min(4096)]).into_owned();
    start.trim_start().starts_with('{') && start.contains("\"asset\"")
}

/// A scene of glTF as text with the bytes of its buffers in it, which `read` finds in files by their names relative to that of
/// the scene; none where all are in it, or where it is no scene. Buffers that are not found stay as they are.
pub fn with_buffers(bytes: &[u8], mut read: impl FnMut(&str) -> Option<Vec<u8>>) -> Option<Vec<u8>> {
    let mut scene: Value = serde_json::from_slice(bytes).ok()?;
    let mut is_changed = false;
    for buffer in scene.get_mut("buffers")?.as_array_mut()? {
        let Some(uri) = buffer.get("uri").and_then(Value::as_str).filter(|uri| !uri.starts_with("data:")) else {
            continue;
        };
        let Some(name) = decoded(uri) else { continue };
        if let Some(found) = read(&name) {
            buffer["uri"] = format!("data:application/octet-stream;base64,{}", STANDARD.encode(found)).into();
            is_changed = true;
        }
    }
    if is_changed { serde_json::to_vec(&scene).ok() } else { None }
}

/// A relative address without the percent signs of its escapes (RFC 3986, 2.1).
fn decoded(uri: &str) -> Option<String> {
    let mut bytes = Vec::with_capacity(uri.len());
    let mut rest = uri.as_bytes();
    while let [first, others @ ..] = rest {
        let escaped = others.get(..2).filter(|_| *first == b'%').and_then(|two| std::str::from_utf8(two).ok());
        match escaped.and_then(|two| u8::from_str_radix(two, 16).ok()) {
            Some(byte) => {
                bytes.push(byte);
                rest = &others[2..];
            }
            None => {
                bytes.push(*first);
                rest = others;
            }
        }
    }
    String::from_utf8(bytes).ok()
}

/// Reads a scene of glTF as text, in its own axes (y up).
///
/// # Errors
/// Every fault of the file, up to a number of them.
pub(in super::super) fn read_gltf(bytes: &[u8]) -> Result<TriangleMesh, Vec<RecordFault>> {
    let mut faults = Faults::default();
    match serde_json::from_slice(bytes) {
        Ok(scene) => {
            let buffers = buffers(&scene, &[], &mut faults);
            triangles(&scene, &buffers, faults)
        }
        Err(error) => {
            faults.add(Some(error.line()), "", format!("expected a scene of glTF 2.0 in JSON: {error}"));
            Err(faults.list)
        }
    }
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
    let buffers = buffers(&scene, binary, &mut faults);
    triangles(&scene, &buffers, faults)
}

/// The triangles of a scene.
fn triangles(scene: &Value, buffers: &Buffers<'_>, mut faults: Faults) -> Result<TriangleMesh, Vec<RecordFault>> {
    let mut corners: Vec<[[f64; 3]; 3]> = Vec::new();
    let mut seen = HashSet::new();
    let meshes = list(scene, "meshes");
    for (m, matrix) in shown(scene, &mut faults) {
        let Some(mesh) = meshes.get(m) else {
            faults.add(None, &format!("mesh {m}"), format!("there are {} meshes", meshes.len()));
            continue;
        };
        if list(mesh, "weights").iter().any(|weight| weight.as_f64().is_none_or(|weight| weight.abs() > 0.0)) {
            faults.add(None, &format!("mesh {m}"), "morph targets are not read".to_owned());
        }
        for (p, value) in list(mesh, "primitives").iter().enumerate() {
            // The same triangles in the same place are no others.
            let parts = [value.get("mode"), value.get("attributes"), value.get("indices")];
            if !seen.insert(format!("{parts:?} {matrix:?}")) {
                continue;
            }
            match primitive(scene, buffers, value) {
                Ok(found) => {
                    let place = |corner: Point3<f64>| matrix.transform_point(&corner).into();
                    corners.extend(found.into_iter().map(|corners| corners.map(place)));
                }
                Err(message) => faults.add(None, &format!("mesh {m}, primitive {p}"), message),
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

#[cfg(test)]
mod tests {
    use super::super::tests::mesh;
    use super::super::write_glb;
    use super::*;
    use serde_json::json;

    /// The file of a ship with another scene.
    fn changed(change: impl Fn(&mut Value)) -> Vec<u8> {
        let bytes = write_glb(&mesh(), "ship");
        let size = word(&bytes, 12).unwrap();
        let mut scene: Value = serde_json::from_slice(&bytes[20..20 + size]).unwrap();
        change(&mut scene);
        let mut text = scene.to_string().into_bytes();
        text.resize(text.len().next_multiple_of(4), b' ');
        let length = u32::try_from(text.len()).unwrap().to_le_bytes();
        [&bytes[..12], &length, &bytes[16..20], &text, &bytes[20 + size..]].concat()
    }

    fn bounds(nodes: Value) -> [[f64; 3]; 2] {
        let scenes = json!([{"nodes": [0]}]);
        let bytes = changed(|scene| (scene["nodes"], scene["scenes"]) = (nodes.clone(), scenes.clone()));
        read_glb(&bytes).unwrap().bounds().unwrap()
    }

    #[test]
    fn a_moved_node_moves_the_hull() {
        let [least, greatest] = bounds(json!([{"mesh": 0}]));
        let near = |found: [[f64; 3]; 2], expected: [[f64; 3]; 2]| {
            let pairs = found.as_flattened().iter().zip(expected.as_flattened());
            assert!(pairs.clone().all(|(a, b)| (a - b).abs() < 1e-5), "{found:?}, expected {expected:?}");
        };
        let moved = |ends: [f64; 3]| [2.0 * ends[0] + 1.0, 3.0 * ends[1] + 2.0, ends[2] - 4.0];
        let node = json!([{"mesh": 0, "translation": [1.0, 2.0, -4.0], "scale": [2.0, 3.0, 1.0]}]);
        near(bounds(node), [moved(least), moved(greatest)]);
        // A quarter turn about x takes y to z; the node below it moves first.
        let half = 0.5f64.sqrt();
        let nodes = json!([
            {"children": [1], "rotation": [half, 0.0, 0.0, half]}, {"mesh": 0, "translation": [0.0, 10.0, 0.0]}
        ]);
        let turned = [[least[0], -greatest[2], least[1] + 10.0], [greatest[0], -least[2], greatest[1] + 10.0]];
        near(bounds(nodes), turned);
        let matrix = [1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.0, 10.0, 0.0, 1.0];
        let moved = [[least[0], turned[0][1] + 10.0, least[1]], [greatest[0], turned[1][1] + 10.0, greatest[1]]];
        near(bounds(json!([{"mesh": 0, "matrix": matrix}])), moved);
    }

    #[test]
    fn a_mesh_may_stand_in_two_places_and_nodes_outside_the_scene_are_not_shown() {
        let count = |nodes: Value, scenes: Value| {
            let bytes = changed(|scene| (scene["nodes"], scene["scenes"]) = (nodes.clone(), scenes.clone()));
            read_glb(&bytes).unwrap().triangles.len()
        };
        let nodes = json!([{"mesh": 0}, {"mesh": 0, "scale": [1.0, 1.0, -1.0]}, {"mesh": 0}]);
        let one = count(nodes.clone(), json!([{"nodes": [0]}]));
        assert_eq!(count(nodes.clone(), json!([{"nodes": [0, 2]}])), one);
        assert_eq!(count(nodes, json!([{"nodes": [0, 1]}])), 2 * one);
    }

    #[test]
    fn what_is_not_read_is_named() {
        let faults = |change: &dyn Fn(&mut Value)| {
            let list = read_glb(&changed(change)).unwrap_err();
            list.into_iter().map(|fault| format!("{}: {}", fault.found, fault.message)).collect::<Vec<_>>().join("; ")
        };
        let draco = json!({"KHR_draco_mesh_compression": {"bufferView": 0}});
        let found = faults(&|scene| scene["meshes"][0]["primitives"][0]["extensions"] = draco.clone());
        assert!(found.contains("mesh 0, primitive 0: KHR_draco_mesh_compression"), "{found}");
        let meshopt = json!({"EXT_meshopt_compression": {"buffer": 0}});
        let found = faults(&|scene| scene["bufferViews"][0]["extensions"] = meshopt.clone());
        assert!(found.contains("EXT_meshopt_compression is not read"), "{found}");
        let found = faults(&|scene| scene["nodes"] = json!([{"mesh": 0, "skin": 0, "rotation": [0, 0, 0, 0]}]));
        assert!(found.contains("node 0: rotation must be a unit quaternion"), "{found}");
        assert!(faults(&|scene| scene["nodes"] = json!([{"children": [0]}])).contains("below itself"));
        assert!(faults(&|scene| scene["nodes"] = json!([{"mesh": 7}])).contains("there are 1 meshes"));
        assert!(faults(&|scene| scene["accessors"][0]["sparse"] = json!({})).contains("sparse"));
        assert!(faults(&|scene| scene["buffers"][0]["uri"] = json!("ship.bin")).contains("not in the file"));
    }

    /// A strip and a fan of four corners in 16-bit parts of 10 m.
    #[test]
    fn strips_fans_and_quantised_corners_are_read() {
        for mode in [5, 6] {
            let corners: [[i16; 3]; 4] = [[0, 0, 0], [32767, 0, 0], [0, 32767, 0], [32767, 32767, -32767]];
            let binary: Vec<u8> =
                corners.iter().flat_map(|c| [c[0], c[1], c[2], 0]).flat_map(i16::to_le_bytes).collect();
            let scene = json!({
                "nodes": [{"mesh": 0, "scale": [10.0, 10.0, 10.0]}],
                "meshes": [{"primitives": [{"mode": mode, "attributes": {"POSITION": 0}}]}],
                "accessors": [{"bufferView": 0, "componentType": 5122, "normalized": true, "count": 4, "type": "VEC3"}],
                "bufferViews": [{"buffer": 0, "byteLength": binary.len(), "byteStride": 8}],
                "buffers": [{"byteLength": binary.len()}],
            });
            let text = scene.to_string();
            let size = |length: usize| u32::try_from(length).unwrap().to_le_bytes();
            let parts = [&MAGIC.to_le_bytes()[..], &[2, 0, 0, 0], &[0; 4], &size(text.len()), b"JSON", text.as_bytes()];
            let bytes = [&parts.concat()[..], &size(binary.len()), b"BIN\0", &binary].concat();
            let found = read_glb(&bytes).unwrap();
            assert_eq!(found.triangles.len(), 2);
            assert_eq!(found.bounds(), Some([[0.0, 0.0, -10.0], [10.0, 10.0, 0.0]]));
        }
    }
}
