//! 3DM files of rhino3dm 8.35 in archives of the versions 2 to 8, by closed forms and the volumes of their own triangles.

use std::f64::consts::PI;
use std::fs;

use loftsman::internals::exchange::{
    CadUnit, ReadBody, TableProblem, read_body, read_table, read_table_with, write_3dm,
};
use loftsman::internals::hull::{FitMethod, Hull, Solid};
use loftsman::internals::hydrostatics::{Conventions, CurvesOfForm};
use loftsman::internals::report::{read_hydrostatic_body, read_source};

use crate::random::Random;
use crate::support::carried;

/// The volume of a mesh of a Wigley hull, 100 x 10 x 6.25 m, by its 420 faces cut along their first diagonals.
const WIGLEY: f64 = 2_759.473_903_944_809;

fn bytes(name: &str) -> Vec<u8> {
    fs::read(carried("tests/rhino").join(format!("{name}.3dm"))).unwrap()
}

fn read(name: &str, beside: &str) -> Result<ReadBody, Vec<TableProblem>> {
    // The content tells the format, whatever the ending.
    read_body("hull.dat", &bytes(name), [("hull.toml", beside)]).unwrap_or_else(|| panic!("{name} is no body"))
}

/// The volume of a mesh \[m3\].
fn volume(body: &ReadBody) -> f64 {
    body.meshes[0].report().volume
}

fn said(problems: &[TableProblem]) -> String {
    problems.iter().map(|p| format!("{} {} {}", p.code, p.message, p.remedy)).collect::<Vec<_>>().join("; ")
}

/// Displacements, of halves where the volume is that of a half.
#[test]
fn bodies_of_all_versions_displace_what_they_should() {
    let foot: f64 = 0.3048;
    let ball = 250.0 / 3.0 * PI;
    // File, draught [m], volume [m3].
    let cases = [
        ("box-v3", 2.0, 1200.0),
        ("cylinder-v4", 20.0, 180.0 * PI),
        ("ball-v8", 0.0, ball),
        // One rational spline whose sides meet in a seam, and end in two poles.
        ("ball-nurbs-v2", 0.0, ball),
        ("extruded-v7", 20.0, 180.0 * PI),
        ("box-ft-v2", 2.0 * foot, 1200.0 * foot.powi(3)),
        // A block at two places, one of them mirrored; another instance is on a hidden layer.
        ("blocks-v5", 1.5, 60.0),
        ("blocks-v8", 1.5, 60.0),
        // Scaled by 2, of half the radius.
        ("block-ball-v8", 0.0, ball),
        // A block in a block, stretched across in the one and along in the other.
        ("block-nested-v8", 0.5, 120.0),
        ("hidden-v8", 1.5, 60.0),
    ];
    for (name, draught, volume) in cases {
        let body = read_hydrostatic_body(&carried("tests/rhino").join(format!("{name}.3dm"))).unwrap();
        let rows = body.curves_of_form(&[draught], &Conventions::default()).unwrap().0.rows;
        let found = rows[0].displacement_volume;
        assert!((found - volume).abs() <= 1e-6 * volume, "{name}: {found}, expected {volume}");
    }
    // Vertices of 64 bits beside the mesh, and in it.
    for name in ["wigley-v5", "wigley-v8"] {
        let found = volume(&read(name, "").unwrap());
        assert!((found - WIGLEY).abs() <= 1e-12 * WIGLEY, "{name}: {found}");
    }
}

/// B L T 4/9 below the design waterline of a Wigley hull, of which one side is given in inches.
#[test]
fn a_half_in_inches_is_mirrored() {
    let body = read("wigley-half-inch-v8", "").unwrap();
    let table = body.table().unwrap().table;
    let widest = table.stations.iter().flat_map(|s| s.outlines.iter().flatten()).map(|p| p.y).fold(0.0, f64::max);
    assert!((widest - 5.0).abs() < 1e-3, "{widest}");
    let ends = [table.stations[0].station.x, table.stations[40].station.x];
    assert!(ends[0].abs() < 1e-2 && (ends[1] - 100.0).abs() < 1e-2, "{ends:?}");
}

#[test]
fn layers_are_parts_and_hidden_ones_are_left_out() {
    let body = read("layers-v8", "").unwrap();
    assert!((volume(&body) - 4800.0).abs() < 1e-6, "{}", volume(&body));
    let notes = said(&body.notes);
    assert!(notes.contains("W352 left out: 1 object on layers that the file hides (yard::dock)"), "{notes}");
    assert!(notes.contains("not part of the body: 1 curve"), "{notes}");
    let named = |names: &str| read("layers-v8", &format!("[table]\nparts = {names}\n"));
    for (names, volume_of_it) in [("\"hull\"", 2400.0), ("\"TANK\"", 2400.0), ("\"yard::dock\"", 7200.0)] {
        let body = named(names).unwrap_or_else(|problems| panic!("{names}: {}", said(&problems)));
        assert!((volume(&body) - volume_of_it).abs() < 1e-6, "{names}: {}", volume(&body));
    }
    let wrong = said(&named("\"keel\"").unwrap_err());
    assert!(wrong.contains("E311 parts: no part 'keel' Known are hull, tank, yard::dock"), "{wrong}");
}

/// An object that is hidden by itself stays so; one of a block is where its own layer and those of the block are shown.
#[test]
fn what_is_hidden_is_named_with_what_helps() {
    let found = said(&read("hidden-v8", "").unwrap().notes);
    let alone = "W352 left out: 1 object that the file hides one by one (layers hull) Show them in the file";
    assert!(found.contains(alone), "{found}");
    let chosen = read("hidden-v8", "[table]\nparts = \"hull\"\n").unwrap();
    assert!((volume(&chosen) - 80.0).abs() < 1e-9 && said(&chosen.notes).contains("one by one"));
    let found = said(&read("blocks-v8", "").unwrap().notes);
    assert!(found.contains("W352 left out: 1 object on layers that the file hides (spare)"), "{found}");
    let spare = read("blocks-v8", "[table]\nparts = \"spare\"\n").unwrap();
    assert!((volume(&spare) - 40.0).abs() < 1e-9, "{}", volume(&spare));
}

/// A Wigley hull of 100 x 10 x 6.25 m, B L T 4/9 below its draught, in millimetres: stations as splines, or as curves of curves.
#[test]
fn curves_alone_are_a_table() {
    for (name, allowed) in [("curves-nurbs-v8", 1e-4), ("curves-polycurve-v6", 1e-3)] {
        let read = read_table("lines.3dm", &bytes(name)).unwrap_or_else(|p| panic!("{name}: {}", said(&p)));
        let hull = Hull::fit(&read.table, &FitMethod::default()).unwrap().hull;
        let found = CurvesOfForm::new(&hull, &[6.25], &Conventions::default()).rows[0].displacement_volume;
        let expected = 100.0 * 10.0 * 6.25 * 4.0 / 9.0;
        assert!((found / expected - 1.0).abs() < allowed, "{name}: {found}, expected {expected}");
        let notes = said(&read.notes);
        assert!(notes.contains("W352 left out: 1 curve on layers that the file hides"), "{notes}");
        let beside = [("lines.toml", "[table]\nparts = \"keel\"\n")];
        let wrong = said(&read_table_with("lines.3dm", &bytes(name), beside).unwrap_err());
        assert!(wrong.contains("E328"), "{wrong}");
    }
}

/// A layer that is its own parent has one name, and objects stay on it.
#[test]
fn a_layer_in_itself_ends() {
    let mut bytes = bytes("layers-v8");
    let name: Vec<u8> = "dock\0".encode_utf16().flat_map(u16::to_le_bytes).collect();
    // Behind the name: whether it is shown, line type, colour and width in print, lock.
    let id = bytes.windows(name.len()).position(|window| window == name).unwrap() + name.len() + 18;
    bytes.copy_within(id..id + 16, id + 16);
    let chosen = |name: &str| {
        let beside = format!("[table]\nparts = \"{name}\"\n");
        read_body("a.3dm", &bytes, [("a.toml", beside.as_str())]).unwrap()
    };
    let body = chosen("dock").unwrap_or_else(|problems| panic!("{}", said(&problems)));
    assert!((volume(&body) - 7200.0).abs() < 1e-6, "{}", volume(&body));
    let wrong = said(&chosen("keel").unwrap_err());
    assert!(wrong.contains("Known are hull, tank, dock"), "{wrong}");
}

/// One side of y = g z with g = 1 - |x - 10|/10 [m] has 10 T^2 m3 below the draught T, both sides.
#[test]
fn loose_surfaces_count_once_and_without_sheets() {
    let notes = |name: &str| said(&read(name, "").unwrap_or_else(|p| panic!("{name}: {}", said(&p))).notes);
    // The second one has its parameters the other way round; of two patches one has more control points.
    for name in ["twice-v8", "patches-v8"] {
        let body = read_hydrostatic_body(&carried("tests/rhino").join(format!("{name}.3dm"))).unwrap();
        let rows = body.curves_of_form(&[1.0], &Conventions::default()).unwrap().0.rows;
        let found = rows[0].displacement_volume;
        assert!((found - 10.0).abs() < 1e-2, "{name}: {found}");
        let found = notes(name);
        assert!(!found.contains("W351"), "{name}: {found}");
        assert_eq!(found.contains("W320 1 surface given twice: counted once"), name == "twice-v8", "{found}");
    }
    let found = notes("inner-v8");
    assert!(found.contains("W351 2 groups of surfaces share no side with each other"), "{found}");
    let numbered = said(&read("inner-v8", "[table]\nparts = 1\n").unwrap_err());
    assert!(numbered.contains("E311 parts: surfaces that nothing trims have no numbers"), "{numbered}");
}

/// A barge with two wing tanks and a double bottom, all of loose patches: walls in common are walls of both.
#[test]
fn tanks_of_patches_that_share_walls_with_the_hull_add_nothing() {
    let body = read_hydrostatic_body(&carried("tests/rhino/tanks-v8.3dm")).unwrap();
    let row = body.curves_of_form(&[3.0], &Conventions::default()).unwrap().0.rows.remove(0);
    let found = [row.displacement_volume, row.waterplane_area];
    assert!((found[0] - 1800.0).abs() < 1e-6 && (found[1] - 600.0).abs() < 1e-6, "{found:?}");
}

#[test]
fn what_is_not_read_is_refused_by_its_kind() {
    let refused = |name: &str, beside: &str| said(&read(name, beside).unwrap_err());
    let cases = [
        ("subd-v8", "E352 1 of 1 object cannot be read (1 ON_SubD), and without them the body is not whole"),
        ("block-ball-stretched-v8", "E352 1 of 1 object cannot be read (1 object of a block)"),
        ("both-v5", "E352 1 object of a mesh beside 1 object of surfaces"),
        ("no-unit-v4", "E351 the file states no unit of length"),
    ];
    for (name, wanted) in cases {
        let found = refused(name, "");
        assert!(found.contains(wanted), "{name}: {found}");
    }
    let chosen = read("both-v5", "[table]\nparts = \"copy\"\n").unwrap();
    assert!((volume(&chosen) - 2400.0).abs() < 1e-6);
    let in_feet = read("no-unit-v4", "[table]\nunits = \"ft\"\n").unwrap();
    assert!((volume(&in_feet) - 67.960_431_820_8).abs() < 1e-6, "{}", volume(&in_feet));
    let of = |bytes: &[u8]| said(&read_body("a.3dm", bytes, None).unwrap().unwrap_err());
    assert!(of(b"3D Geometry File Format        1").contains("E350 an archive of version 1"));
    assert!(of(b"3D Geometry File Format       50").contains("E350 the file is cut off"));
    assert!(of(b"3D Geometry File Format     none").contains("states no version"));
    assert!(of(b"station,z,y\n1,2,3\n").contains("E350 no 3DM file, by its first words"));
    let whole = bytes("box-v3");
    assert!(of(&whole[..whole.len() / 2]).contains("E350 the file is cut off or damaged"));
}

/// An array of a mesh with a bit turned over: its CRC tells.
#[test]
fn a_damaged_mesh_is_not_read() {
    let mut bytes = bytes("box-ft-v2");
    let vertex: Vec<u8> = 60_f32.to_le_bytes().to_vec();
    let places: Vec<usize> = (0..bytes.len() - 4).filter(|&k| bytes[k..k + 4] == vertex[..]).collect();
    // The first is in the box around it.
    bytes[places[2]] ^= 1;
    let found = said(&read_body("a.3dm", &bytes, None).unwrap().unwrap_err());
    assert!(found.contains("its CRC is another one"), "{found}");
}

#[test]
fn random_changes_never_stop_the_reader() {
    let mut random = Random(11);
    for name in ["box-ft-v2", "layers-v8", "box-v3"] {
        let whole = bytes(name);
        for _ in 0..4 {
            let mut changed = whole.clone();
            for _ in 0..=random.below(4) {
                let at = random.below(changed.len());
                changed[at] = random.next() as u8;
            }
            if let Some(Ok(body)) = read_body("a.3dm", &changed, None) {
                assert!(body.meshes.iter().flat_map(|mesh| mesh.vertices.iter().flatten()).all(|c| c.is_finite()));
            }
        }
    }
}

/// The same hull gives the same bytes, in a layer that is a part of the file.
#[test]
fn a_written_hull_is_the_same_again() {
    for name in ["box", "fishing-vessel", "wigley", "yacht"] {
        let hull = read_source(&carried("configs").join(format!("{name}.toml"))).unwrap().hull;
        let solid = Solid::new(&hull).unwrap();
        for unit in [CadUnit::Metre, CadUnit::Millimetre] {
            let bytes = write_3dm(&solid, name, unit).unwrap();
            assert!(bytes.starts_with(b"3D Geometry File Format       50"));
            assert_eq!(bytes, write_3dm(&solid, name, unit).unwrap());
            let length = u64::from_le_bytes(bytes[bytes.len() - 8..].try_into().unwrap());
            assert_eq!(length, bytes.len() as u64);
        }
    }
}
