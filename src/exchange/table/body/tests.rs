use super::super::Severity;
use super::*;
use crate::spline::{BsplineSurface, KnotVector};

/// A box of corners (0, -3, 0) and (40, 3, 4) with its deck, as OBJ in axes that `place` gives.
fn brick(place: impl Fn([f64; 3]) -> [f64; 3]) -> String {
    let mut text = String::new();
    for k in 0..8 {
        let [x, y, z] = place([
            if k & 1 == 0 { 0.0 } else { 40.0 },
            if k & 2 == 0 { -3.0 } else { 3.0 },
            if k & 4 == 0 { 0.0 } else { 4.0 },
        ]);
        text.push_str(&format!("v {x} {y} {z}\n"));
    }
    for [a, b, c, d] in [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]] {
        text.push_str(&format!("f {} {} {} {}\n", a + 1, b + 1, c + 1, d + 1));
    }
    text
}

fn body(text: &str, sidecar: &str) -> Result<ReadBody, Vec<TableProblem>> {
    read_body("a.obj", text.as_bytes(), Some(("a.toml", sidecar))).unwrap()
}

fn notes(list: &[TableProblem]) -> String {
    list.iter().map(|note| format!("{note}\n")).collect()
}

#[test]
fn a_box_becomes_a_table() {
    let read = body(&brick(|p| p), "[table]\nname = 'Box'\nT = 2.5\nsections = 8\n").unwrap();
    assert!((read.meshes[0].report().volume - 960.0).abs() < 1e-9);
    let table = read.table().unwrap().table;
    assert_eq!((table.name.as_str(), table.stated.draught, table.stations.len()), ("Box", Some(2.5), 9));
    for station in &table.stations {
        assert_eq!(station.outlines.len(), 1);
        let points: Vec<[f64; 2]> = station.outlines[0].iter().map(|p| [p.y, p.z]).collect();
        assert_eq!(points, [[0.0, 0.0], [3.0, 0.0], [3.0, 4.0]]);
        assert_eq!((station.deck_height, station.deck_half_breadth), (Some(4.0), Some(3.0)));
    }
    assert!((table.stations[4].station.x - 20.0).abs() < 1e-9);
}

#[test]
fn frames_are_stated_or_found() {
    let volume = |text: &str, sidecar: &str| {
        body(text, sidecar).map(|read| (read.meshes[0].report().volume, notes(&read.notes)))
    };
    // y up, x aft, feet, half of it.
    let half = brick(|[x, y, z]| [-x / 0.3048, z / 0.3048, -0.5 * (y + 3.0) / 0.3048]);
    let (found, said) = volume(&half, "[table]\nunits = 'ft'\naxes = '-x -z y'\nbody = 'half'\n").unwrap();
    assert!((found - 960.0).abs() < 1e-9 && said.contains("mirrored"), "{found} {said}");
    // y up is seen when z is the axis of symmetry and the sides flare; the height does not begin at 0. A box may lie anyhow.
    let flared = |[x, y, z]: [f64; 3]| [x, z - 1.0, -y * (0.5 + 0.125 * z)];
    let (found, said) = volume(&brick(flared), "").unwrap();
    assert!((found - 720.0).abs() < 1e-9 && said.contains("\"x -z y\""), "{found} {said}");
    assert!(said.contains("lowest point is -1.000 m"), "{said}");
    let error = volume(&brick(|[x, y, z]| [x, z - 1.0, -y]), "").unwrap_err();
    assert!(notes(&error).contains("E351") && notes(&error).contains("the axes are ambiguous"), "{error:?}");
    // So is y forward; a flap stays as it is written, and what is broader than long is said.
    let (found, said) = volume(&brick(|[x, y, z]| [-y * (0.5 + 0.0125 * x), x - 20.0, z]), "").unwrap();
    assert!((found - 720.0).abs() < 1e-9 && said.contains("\"y -x z\""), "{found} {said}");
    let (_, said) = volume(&brick(|[x, y, z]| [-y, x - 20.0, z]), "").unwrap();
    assert!(!said.contains("axes are taken") && said.contains("6.000 long, 40.000 broad"), "{said}");
    // A whole body that touches the centreplane along its edge is none half of one.
    let error = volume(&brick(|[x, y, z]| [x, y + 3.0 - 0.25 * (4.0 - z) * (y - 3.0) / 6.0 * 0.5, z]), "");
    assert!(notes(&error.unwrap_err()).contains("is closed there"));
    // A mirrored frame is turned outward.
    let (found, said) = volume(&brick(|[x, y, z]| [x, -y, z]), "[table]\nscale = 2\n").unwrap();
    assert!((found - 8.0 * 960.0).abs() < 1e-9 && said.contains("12 triangles turned"), "{found} {said}");
    let (_, said) = volume(&brick(|[x, y, z]| [x + 100.0, y, z]), "").unwrap();
    assert!(said.contains("taken as AP"), "{said}");
    let read = body(&brick(|[x, y, z]| [x + 100.0, y, z]), "[table]\nx_origin = -99\nz_origin = 0.5\n").unwrap();
    assert_eq!(read.meshes[0].bounds(), Some([[1.0, -3.0, 0.5], [41.0, 3.0, 4.5]]));
    // Beside the centreplane z is up all the same; a body that stands on end and is symmetric nowhere may lie anyhow.
    let (found, said) = volume(&brick(|[x, y, z]| [x, y + 9.0, z + 9.0]), "").unwrap();
    assert!((found - 960.0).abs() < 1e-9 && said.contains("not symmetric about the centreplane"), "{found} {said}");
    let error = volume(&brick(|[x, y, z]| [z + 9.0, y + 9.0, x]), "").unwrap_err();
    assert!(notes(&error).contains("E351") && notes(&error).contains("the axes are ambiguous"), "{error:?}");
    let error = volume(&brick(|p| p), "[table]\naxes = 'x x z'\nsections = 2\n").unwrap_err();
    assert_eq!(error.iter().filter(|p| p.severity == Severity::Error && p.code == "E311").count(), 2, "{error:?}");
}

#[test]
fn faults_say_their_line() {
    let error = |name: &str, bytes: &[u8]| notes(&read_body(name, bytes, None).unwrap().unwrap_err());
    let found = error("a.obj", b"v 0 0 0\nv 1 x 0\nv 1 1\nf 1 2 9\nf 1 -1\n");
    for part in ["row 2", "'x'", "row 3", "2 numbers, expected 3", "row 4", "'9'", "row 5", "a face of 2"] {
        assert!(found.contains(part), "{part}: {found}");
    }
    let found = error("a.stl", b"solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 1e999\nendloop\nwall\n");
    for part in ["row 4", "row 5", "a loop of 0 corners", "row 6", "E350"] {
        assert!(found.contains(part), "{part}: {found}");
    }
    assert!(error("b.stl", &[0; 90]).contains("90 bytes; a binary file of 0 triangles has 84"));
    let mut bytes = vec![0; 134];
    bytes[80] = 1;
    bytes[96..100].copy_from_slice(&f32::NAN.to_le_bytes());
    assert!(error("b.stl", &bytes).contains("triangle 1 has a corner that is no number"));
    assert!(error("c.obj", b"v 0 0 0\n").contains("no faces"));
}

#[test]
fn an_open_body_is_told() {
    let text: String =
        brick(|p| p).lines().filter(|line| *line != "f 5 6 8 7").map(|line| format!("{line}\n")).collect();
    let read = body(&text, "").unwrap();
    assert!(notes(&read.notes).contains("W351") && notes(&read.notes).contains("4 edges open"), "{:?}", read.notes);
    let table = read.table().unwrap().table;
    // The sections end at the edge.
    assert!(table.stations.iter().all(|station| (station.outlines[0][2].z - 4.0).abs() < 1e-12));
    assert!(table.stations.iter().all(|station| station.outlines[0].len() == 3), "{:?}", table.stations[3].outlines);
}

#[test]
fn lines_are_joined_end_to_end() {
    let line = |points: &[[f64; 2]]| MeshLine { points: points.to_vec(), closed: false };
    // A strip upside down between two others, a ring of two halves, a line for itself.
    let lines = vec![
        line(&[[0.0, 0.0], [1.0, 0.0]]),
        line(&[[2.0, 0.0], [1.01, 0.0]]),
        line(&[[10.0, 0.0], [11.0, 1.0], [12.0, 0.0]]),
        line(&[[2.0, 0.01], [3.0, 0.0]]),
        line(&[[10.0, 0.01], [11.0, -1.0], [12.0, 0.01]]),
        line(&[[20.0, 0.0], [21.0, 0.0]]),
    ];
    let found = joined(lines, 0.1);
    assert_eq!(found.len(), 3);
    assert_eq!(found[0].points, [[0.0, 0.0], [1.0, 0.0], [1.01, 0.0], [2.0, 0.0], [2.0, 0.01], [3.0, 0.0]]);
    assert!(!found[0].closed && found[1].closed && !found[2].closed);
    assert_eq!(found[1].points.len(), 6);
    // Ten thousand strips one above the other are one line.
    let strips = (0..10_000_u32).map(|k| line(&[[f64::from(k), 0.0], [f64::from(k) + 0.99, 0.0]])).collect();
    assert_eq!(joined(strips, 0.02).len(), 1);
}

#[test]
fn surfaces_that_would_need_too_many_triangles_are_not_built() {
    let knots = KnotVector::uniform(1, 1).unwrap();
    let points = vec![[0.0, 0.0, 0.0, 1.0], [0.0, 1.0, 1.0, 1.0], [1.0, 0.0, 0.0, 1.0], [1.0, 1.0, 2.0, 1.0]];
    let surface = [BsplineSurface::new(knots.clone(), knots, points).unwrap()];
    assert!(TriangleMesh::nested(&surface, 1e-3, 100_000).is_ok());
    assert!(TriangleMesh::nested(&surface, 1e-3, 0).unwrap_err() > 0);
}

#[test]
fn nested_meshes_that_enclose_different_volumes_are_refused() {
    let mesh =
        |scale: f64| read_body("a.obj", brick(|p| p.map(|c| scale * c)).as_bytes(), None).unwrap().unwrap().meshes;
    for (scale, is_refused) in [(1.0, false), (1.00001, false), (1.01, true)] {
        let mut problems = Problems::new("a.step");
        cad::agree(&[mesh(1.0), mesh(scale)].concat(), 1e-3, &mut problems);
        assert_eq!(problems.any_errors(), is_refused, "{scale}");
    }
}

#[test]
fn faces_that_enclose_nothing_are_refused() {
    let deck = "v 0 -3 4\nv 40 -3 4\nv 40 3 4\nv 0 3 4\nf 1 2 3 4\n";
    let list = body(deck, "").unwrap_err();
    assert!(notes(&list).contains("E354") && notes(&list).contains("enclose no volume"), "{list:?}");
}
