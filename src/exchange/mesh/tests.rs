use super::*;
use crate::hull::PanelMesh;

/// A tetrahedron of unit edges along the axes, normals out.
pub(super) fn mesh() -> HullMesh {
    HullMesh {
        vertices: vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        triangles: vec![
            (Region::Bottom, [0, 2, 1]),
            (Region::Hull, [0, 1, 3]),
            (Region::Hull, [1, 2, 3]),
            (Region::Transom, [0, 3, 2]),
        ],
        sharp_corners: Vec::new(),
    }
}

#[test]
fn a_binary_stl_is_read_back() {
    let bytes = write_stl(&mesh(), "solid ship");
    assert_eq!(bytes.len(), 84 + 4 * 50);
    assert!(!bytes.starts_with(b"solid"));
    assert_eq!(u32::from_le_bytes(bytes[80..84].try_into().unwrap()), 4);
    let real = |at: usize| f32::from_le_bytes(bytes[at..at + 4].try_into().unwrap());
    // The first triangle is of the hull: normal -y, corners 0, 1, 3.
    let first: Vec<f32> = (0..12).map(|k| real(84 + 4 * k)).collect();
    assert_eq!(first, [0.0, -1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0]);
}

#[test]
fn an_ascii_stl_names_its_regions() {
    let text = write_stl_ascii(&mesh());
    let solids: Vec<&str> = text.lines().filter(|line| line.starts_with("solid")).collect();
    assert_eq!(solids, ["solid hull", "solid bottom", "solid transom"]);
    assert_eq!(text.matches("vertex ").count(), 12);
    assert_eq!(text.matches("endfacet").count(), 4);
}

#[test]
fn an_obj_has_each_vertex_once() {
    let text = write_obj(&mesh(), "two\nlines");
    assert_eq!(text.lines().filter(|line| line.starts_with("v ")).count(), 4);
    let faces: Vec<&str> = text.lines().filter(|line| line.starts_with("f ")).collect();
    assert_eq!(faces, ["f 1 2 4", "f 2 3 4", "f 1 3 2", "f 1 4 3"]);
    assert!(text.starts_with("# two lines:"));
}

#[test]
fn the_chunks_of_a_glb_have_their_lengths() {
    let bytes = write_glb(&mesh(), "ship");
    let word = |at: usize| u32::from_le_bytes(bytes[at..at + 4].try_into().unwrap()) as usize;
    assert_eq!(&bytes[..4], b"glTF");
    assert_eq!((word(4), word(8)), (2, bytes.len()));
    let length = word(12);
    assert_eq!(&bytes[16..20], b"JSON");
    let json: serde_json::Value = serde_json::from_slice(&bytes[20..20 + length]).unwrap();
    assert_eq!(json["meshes"][0]["primitives"].as_array().unwrap().len(), 3);
    // y to port is -Z, z up is Y.
    assert_eq!(json["accessors"][0]["max"], serde_json::json!([1.0, 1.0, 0.0]));
    assert_eq!(json["accessors"][0]["min"], serde_json::json!([0.0, 0.0, -1.0]));
    let binary = word(20 + length);
    assert_eq!(20 + length + 8 + binary, bytes.len());
    assert_eq!(json["buffers"][0]["byteLength"].as_u64().unwrap() as usize, binary);
    let views = json["bufferViews"].as_array().unwrap();
    let end = views.iter().map(|view| view["byteOffset"].as_u64().unwrap() + view["byteLength"].as_u64().unwrap());
    assert_eq!(end.max().unwrap() as usize, binary);
}

/// A quadrilateral and a triangle.
fn panels() -> PanelMesh {
    PanelMesh {
        vertices: vec![[0.0, 1.5, -2.0], [0.0, 1.5, 0.0], [4.0, 1.5, 0.0], [4.0, 1.5, -2.0], [5.5, 0.0, 0.0]],
        panels: vec![[0, 1, 2, 3], [3, 2, 4, 4]],
    }
}

#[test]
fn a_gdf_file_has_four_corners_for_each_panel() {
    assert_eq!(
        write_gdf(&panels(), "a\nb"),
        "a_b\n1 9.80665 ULEN GRAV\n0 1 ISX ISY\n2\n0 1.5 -2\n0 1.5 0\n4 1.5 0\n4 1.5 -2\n4 1.5 -2\n4 1.5 0\n5.5 0 0\n5.5 0 0\n"
    );
}

#[test]
fn a_nemoh_file_ends_its_lists_with_zeros() {
    assert_eq!(
        write_nemoh(&panels()),
        "2 1\n1 0 1.5 -2\n2 0 1.5 0\n3 4 1.5 0\n4 4 1.5 -2\n5 5.5 0 0\n0 0 0 0\n1 2 3 4\n4 3 5 5\n0 0 0 0\n"
    );
}

#[test]
fn a_pnl_file_counts_the_corners_of_panels() {
    let text = write_pnl(&panels());
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!((lines[3], lines[6], lines[14], lines[15]), ("2 5 0 1", "1 0 1.5 -2", "1 4 1 2 3 4", "2 3 4 3 5"));
}

#[test]
fn corners_that_are_no_numbers_are_faults_of_their_triangle() {
    for wrong in [f32::NAN, f32::INFINITY, 2e8] {
        let (mut stl, mut glb) = (write_stl(&mesh(), "ship"), write_glb(&mesh(), "ship"));
        // The first corner of the second triangle; a corner of the first one.
        stl[84 + 50 + 12..84 + 50 + 16].copy_from_slice(&wrong.to_le_bytes());
        let text = u32::from_le_bytes(glb[12..16].try_into().unwrap()) as usize;
        glb[28 + text..32 + text].copy_from_slice(&wrong.to_le_bytes());
        for (faults, triangle) in [(read_stl(&stl).unwrap_err(), 2), (read_glb(&glb).unwrap_err(), 1)] {
            let wanted = format!("triangle {triangle} has a corner that is no number of at most 1e8");
            assert_eq!(faults[0].message, wanted, "{wrong}");
        }
    }
}
