//! One hull in the mesh formats of other programs, written by meshio 5.3, trimesh 4, PyVista and VTK 9, gmsh 4.15: the volume
//! that trimesh finds, 354.1898148 m3, and a box of gmsh of 480 m3.

use std::fs;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use loftsman::internals::exchange::{ReadBody, TableProblem, read_body};

use crate::support::{carried, folder, program, stderr, stdout};

const HULL: f64 = 354.189_814_8;
const BOX: f64 = 480.0;

fn read(name: &str) -> Result<ReadBody, Vec<TableProblem>> {
    let bytes = fs::read(carried("tests/mesh_formats").join(name)).unwrap();
    read_body(name, &bytes, None).unwrap_or_else(|| panic!("{name} is no body"))
}

#[test]
fn meshes_of_other_programs_have_their_volume() {
    // File, volume [m3], what it may be off by: coordinates of 32 bits are rounded.
    let cases = [
        ("hull-ascii.ply", HULL, 1e-9),
        ("hull.ply", HULL, 1e-9),
        ("hull-pv.ply", HULL, 1e-7),
        ("hull.off", HULL, 1e-9),
        ("hull-trimesh.off", HULL, 1e-7),
        ("hull42-ascii.vtk", HULL, 1e-9),
        ("hull42.vtk", HULL, 1e-9),
        ("hull51-ascii.vtk", HULL, 1e-9),
        ("hull51.vtk", HULL, 1e-9),
        ("hull-strips.vtk", HULL, 1e-9),
        ("hull-ascii.vtu", HULL, 1e-9),
        ("hull-plain.vtu", HULL, 1e-9),
        ("hull.vtu", HULL, 1e-9),
        ("hull-pv.vtp", HULL, 1e-9),
        ("hull-strips.vtp", HULL, 1e-9),
        ("hull-raw.vtp", HULL, 1e-9),
        ("hull-raw-plain.vtp", HULL, 1e-9),
        ("hull22-ascii.msh", HULL, 1e-9),
        ("hull22.msh", HULL, 1e-9),
        ("hull41-ascii.msh", HULL, 1e-9),
        ("hull41.msh", HULL, 1e-9),
        ("hull.hst", HULL, 1e-9),
        ("hull.glb", HULL, 1e-7),
        ("hull.gltf", HULL, 1e-7),
        // Of 30 mm: the file says that its unit is a millimetre.
        ("hull.3mf", 1e-9 * HULL, 1e-6),
        ("box22-gmsh.msh", BOX, 1e-9),
        ("box41-o2.msh", BOX, 1e-9),
        ("box41-o2-bin.msh", BOX, 1e-9),
        ("box41-solid.msh", BOX, 1e-9),
    ];
    for (name, volume, off) in cases {
        let body = read(name).unwrap_or_else(|problems| panic!("{name}: {}", problems[0].message));
        let found = body.meshes[0].report().volume;
        assert!((found - volume).abs() <= off * volume, "{name}: {found}, expected {volume}");
        assert_eq!(body.meshes[0].open_edges().len(), 0, "{name}");
    }
}

#[test]
fn faces_may_stand_before_their_vertices() {
    let box_of = |faces_first: bool| {
        let vertices = "element vertex 8\nproperty float nx\nproperty double x\nproperty uchar red\nproperty double y\nproperty double z\n";
        let faces = "element edge 1\nproperty int from\nproperty int to\nelement face 6\nproperty uchar flag\n\
                     property list uchar int vertex_indices\nproperty list uchar float texture\n";
        let points: String =
            (0..8).map(|k| format!("0 {} 7 {} {}\n", 60 * (k >> 2), 10 * (k >> 1 & 1) - 5, 6 * (k & 1))).collect();
        let list = ["0 1 3 2", "4 6 7 5", "0 4 5 1", "2 3 7 6", "0 2 6 4", "1 5 7 3"];
        let rows: String = list.iter().map(|face| format!("1 4 {face} 2 0.5 0.25\n")).collect();
        let rows = format!("0 1\n{rows}");
        let (head, body) = if faces_first {
            (format!("{faces}{vertices}"), rows + &points)
        } else {
            (format!("{vertices}{faces}"), points + &rows)
        };
        format!("ply\nformat ascii 1.0\n{head}end_header\n{body}")
    };
    for faces_first in [false, true] {
        let body = read_body("a.ply", box_of(faces_first).as_bytes(), None).unwrap().unwrap();
        let found = body.meshes[0].report().volume;
        assert!((found - 3600.0).abs() < 1e-9, "{faces_first}: {found}");
    }
    let outside = box_of(true).replace("1 4 0 1 3 2", "1 4 0 1 3 9");
    let refused = read_body("a.ply", outside.as_bytes(), None).unwrap().unwrap_err();
    assert!(refused[0].message.contains("no vertex; there are 8"), "{}", refused[0].message);
}

/// A block of 3600 m3 with others that are not printed, of type `other` and of type `surface`.
#[test]
fn objects_of_a_package_that_are_no_model_are_left_out_and_named() {
    let body = read("left-out.3mf").unwrap();
    let found = body.meshes[0].report().volume;
    assert!((found - 3600.0).abs() < 1e-9, "{found}");
    let notes: Vec<String> = body.notes.iter().map(ToString::to_string).collect();
    for why in ["1 object, not printed", "1 object, of type other", "1 object, of type surface"] {
        assert!(notes.iter().any(|note| note.contains("W352") && note.contains(why)), "{notes:?}");
    }
}

#[test]
fn what_is_not_read_of_a_mesh_is_named() {
    let refused = |name: &str| read(name).unwrap_err().iter().map(|p| p.message.clone()).collect::<Vec<_>>().join("; ");
    assert!(refused("hull-lzma.vtp").contains("vtkLZMADataCompressor"), "{}", refused("hull-lzma.vtp"));
    assert!(refused("tets.vtk").contains("cells with a volume and no faces"), "{}", refused("tets.vtk"));
    let of = |name: &str, text: &[u8]| read_body(name, text, None).unwrap().unwrap_err()[0].message.clone();
    assert!(of("a.msh", b"$MeshFormat\n4 0 8\n$EndMeshFormat\n").contains("expected version 2.2 or 4.1"));
    let grid = b"# vtk DataFile Version 3.0\nt\nASCII\nDATASET STRUCTURED_GRID\n";
    assert!(of("a.vtk", grid).contains("expected POLYDATA or UNSTRUCTURED_GRID"));
    let image = b"<?xml version=\"1.0\"?><VTKFile type=\"ImageData\"></VTKFile>";
    assert!(of("a.vti", image).contains("a file of ImageData"));
    let outside = br#"{"asset": {"version": "2.0"}, "buffers": [{"uri": "hull.bin", "byteLength": 4}]}"#;
    assert!(of("a.gltf", outside).contains("its bytes are neither in the file nor beside it"));
}

#[test]
fn buffers_of_a_scene_may_stand_beside_it() {
    let text = fs::read_to_string(carried("tests/mesh_formats").join("hull.gltf")).unwrap();
    let mut scene: serde_json::Value = serde_json::from_str(&text).unwrap();
    let uri = scene["buffers"][0]["uri"].as_str().unwrap().split_once(";base64,").unwrap().1.to_owned();
    scene["buffers"][0]["uri"] = "hull%20lines.bin".into();
    let folder = folder("buffers");
    folder.write("hull.gltf", scene.to_string());
    let path = folder.join("hull.gltf");
    let volume = |path: &std::path::Path| -> f64 {
        let done = program(&["hydro", &path.display().to_string(), "--draughts", "100", "--json"]);
        let answer: serde_json::Value = serde_json::from_str(&stdout(&done)).unwrap();
        answer["rows"][0]["DISPVOL"].as_f64().unwrap_or(0.0)
    };
    let missing = program(&["hydro", &path.display().to_string()]);
    assert!(missing.status.code() == Some(3) && stderr(&missing).contains("neither in the file nor beside it"));
    fs::write(folder.join("hull lines.bin"), STANDARD.decode(uri).unwrap()).unwrap();
    assert!((volume(&path) - HULL).abs() < 1e-6 * HULL, "{}", volume(&path));
}

#[test]
fn a_damaged_mesh_is_refused() {
    let cases: [(&str, &[u8], &str); 7] = [
        ("a.off", b"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n", "no vertex; there are 3"),
        ("a.off", b"OFF\n900000000 1 0\n0 0 0\n", "so many vertices are not in the file"),
        (
            "a.ply",
            b"ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n1\n",
            "vertices have no x, y and z",
        ),
        ("a.ply", b"ply\nformat ascii 1.0\nelement vertex 1\n", "the file ends, expected end_header"),
        ("a.vtk", b"# vtk DataFile Version 5.1\nt\nASCII\nDATASET POLYDATA\nPOINTS 9 float\n0 0 0\n", "so many points"),
        ("a.msh", b"$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n1\n1 0 0 0\n$EndNodes\n", "no faces"),
        (
            "a.hst",
            b"COORDINATES TYPE 1\n1 0 0 0\nENDCOORDINATES\nPANEL TYPE 0\n1 2 3\nENDPANEL\n",
            "no node; there are 1",
        ),
    ];
    for (name, text, expected) in cases {
        let problems = read_body(name, text, None).unwrap().unwrap_err();
        let found: Vec<_> = problems.iter().map(|problem| problem.message.as_str()).collect();
        assert!(found.iter().any(|message| message.contains(expected)), "{name}: {found:?}");
    }
}

#[test]
fn planes_of_symmetry_of_hydrostar_are_mirrored() {
    // A quarter of a box of 8 m by 4 m by 2 m: its outside panels.
    let text = "SYMMETRY 2\nCOORDINATES TYPE 0\n0 0 -2\n4 0 -2\n4 2 -2\n0 2 -2\n4 0 0\n4 2 0\n0 2 0\nENDCOORDINATES\n\
                PANEL TYPE 1\n1 1 4 3 2\n2 2 3 6 5\n3 3 4 7 6\nENDPANEL\nENDFILE\n";
    // Its aftmost point is taken as AP.
    let body = read_body("box.hst", text.as_bytes(), None).unwrap().unwrap();
    assert_eq!(body.meshes[0].bounds(), Some([[0.0, -2.0, -2.0], [8.0, 2.0, 0.0]]));
}

fn volume(path: &std::path::Path) -> f64 {
    let bytes = fs::read(path).unwrap();
    let body = read_body(&path.display().to_string(), &bytes, None).unwrap().unwrap();
    assert_eq!(body.meshes[0].open_edges().len(), 0, "{}", path.display());
    body.meshes[0].report().volume
}

#[test]
fn written_meshes_are_read_back() {
    let to = folder("written");
    let out = to.to_str().unwrap();
    let done = program(&["export", "configs/wigley.toml", "-f", "stl,obj,ply,glb,3mf,vtk,msh", "-o", out]);
    assert_eq!(done.status.code(), Some(0), "{}", stderr(&done));
    let whole = volume(&to.join("wigley.ply"));
    for ending in ["stl", "obj", "glb", "3mf", "vtk", "msh"] {
        let found = volume(&to.join(format!("wigley.{ending}")));
        assert!((found / whole - 1.0).abs() < 1e-6, "{ending}: {found}, expected {whole}");
    }
}

#[test]
fn half_a_mesh_is_closed_on_the_centreplane_and_has_half_the_volume() {
    for config in ["wigley", "bulk-carrier", "tug"] {
        let to = folder(config);
        let (out, config_file) = (to.to_str().unwrap(), format!("configs/{config}.toml"));
        let deviation = ["--deviation", "5 cm"];
        let of = |arguments: &[&str]| {
            let done = program(&[&["export", config_file.as_str(), "-o", out, "--force"], arguments].concat());
            assert_eq!(done.status.code(), Some(0), "{}", stderr(&done));
            stdout(&done)
        };
        of(&[&["-f", "ply"], &deviation[..]].concat());
        let whole = volume(&to.join(format!("{config}.ply")));
        // Given as a half it is mirrored: closed on the centreplane it is ambiguous.
        let page = of(&[&["-f", "obj", "--half"], &deviation[..]].concat());
        assert!(page.contains(", closed;") && page.contains("half of the body"), "{page}");
        let text = fs::read(to.join(format!("{config}.obj"))).unwrap();
        let beside = ("half.toml", "[table]\nbody = \"whole\"\n");
        let body = read_body("half.obj", &text, [beside]).unwrap().unwrap();
        let half = body.meshes[0].report().volume;
        assert!((2.0 * half / whole - 1.0).abs() < 1e-3, "{config}: {half} of {whole}");
        assert!(String::from_utf8_lossy(&text).contains("usemtl centreplane"));
    }
}

#[test]
fn a_model_has_its_scale_and_unit() {
    let to = folder("scale");
    let out = to.to_str().unwrap();
    let arguments =
        ["export", "configs/wigley.toml", "-f", "stl,3mf,glb", "--scale", "1:50", "--unit", "mm", "-o", out];
    let done = program(&arguments);
    assert_eq!(done.status.code(), Some(0), "{}", stderr(&done));
    let extent = |name: &str| {
        let bytes = fs::read(to.join(name)).unwrap();
        let [least, greatest] = read_body(name, &bytes, None).unwrap().unwrap().meshes[0].bounds().unwrap();
        greatest[0] - least[0]
    };
    let long = extent("wigley.glb");
    // 3MF states its unit, STL does not.
    assert!((extent("wigley.3mf") / long - 1.0).abs() < 1e-6 && (extent("wigley.stl") / long - 1000.0).abs() < 1e-3);
    let refused = program(&["export", "configs/wigley.toml", "-f", "step", "--scale", "1:50", "-o", out]);
    assert_eq!(refused.status.code(), Some(2));
    assert!(stderr(&refused).contains("--half and --scale are of meshes"), "{}", stderr(&refused));
}

/// A box as a group of an OBJ file, its vertices numbered from `first`.
fn group(name: &str, [low, high]: [[f64; 3]; 2], first: usize) -> String {
    let corner = |k: usize| [0, 1, 2].map(|axis| if k >> axis & 1 == 1 { high[axis] } else { low[axis] });
    let vertices = (0..8).map(corner).map(|[x, y, z]| format!("v {x} {y} {z}\n"));
    let faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let faces = faces.map(|face| format!("f {}\n", face.map(|k| (first + k).to_string()).join(" ")));
    format!("g {name}\n{}{}", vertices.collect::<String>(), faces.concat())
}

#[test]
fn parts_of_a_body_are_chosen_by_name_or_number() {
    let to = folder("parts");
    let path = to.join("barges.obj");
    let hull = group("hull", [[0.0, -3.0, 0.0], [20.0, 3.0, 4.0]], 1);
    let tender = group("tender", [[0.0, 5.0, 0.0], [8.0, 7.0, 2.0]], 9);
    fs::write(&path, hull + &tender).unwrap();
    let file = path.to_str().unwrap();
    let volume = |parts: &[&str]| {
        let done = program(&[&["hydro", file, "--draughts", "1", "--json"], parts].concat());
        assert_eq!(done.status.code(), Some(0), "{}", stderr(&done));
        let json: serde_json::Value = serde_json::from_str(&stdout(&done)).unwrap();
        (json["rows"][0]["DISPVOL"].as_f64().unwrap(), stderr(&done))
    };
    let (whole, said) = volume(&[]);
    assert!((whole - 136.0).abs() < 1e-6, "{whole}");
    assert!(
        said.contains("parts of the file: hull, tender") && said.contains("shells, the largest first: 1 (12"),
        "{said}"
    );
    for (parts, expected) in [("hull", 120.0), ("1", 120.0), ("Hull,tender", 136.0), ("1,2", 136.0)] {
        let (found, _) = volume(&["--parts", parts]);
        assert!((found - expected).abs() < 1e-6, "{parts}: {found}");
    }
    for (parts, expected) in [("mast", "Known are hull, tender"), ("3", "the body has 2 shells")] {
        let done = program(&["hydro", file, "--draughts", "1", "--parts", parts]);
        assert_eq!(done.status.code(), Some(3));
        assert!(stderr(&done).contains(expected), "{}", stderr(&done));
    }
}
