//! DXF files of ezdxf 1.4 in R12 to 2018, as text and bytes: a box of 480 m3, half a cylinder, half an elliptical one and the Wigley
//! hull in closed form, and what is refused.

use std::f64::consts::PI;
use std::fs;

use loftsman::internals::exchange::{ReadTable, TableProblem, read_body, read_table, read_table_with};
use loftsman::internals::hull::{FitMethod, Hull};
use loftsman::internals::hydrostatics::{Conventions, CurvesOfForm};
use loftsman::internals::report::{ExportFormat, ExportSettings, export, read_source};

use crate::support::carried;

const BOX: f64 = 480.0;

/// 4/9 L B T with 20, 2 and 1.25 m.
const WIGLEY: f64 = 20.0 * 2.0 * 1.25 * 4.0 / 9.0;

fn bytes(name: &str) -> Vec<u8> {
    fs::read(carried("tests/dxf_files").join(name)).unwrap()
}

fn said(notes: &[TableProblem]) -> String {
    notes.iter().map(|note| format!("{note}\n")).collect()
}

/// The volume of the hull fitted to a table, to a draught \[m, m^3\].
fn volume(read: &ReadTable, draught: f64) -> f64 {
    let hull = Hull::fit(&read.table, &FitMethod::default()).unwrap().hull;
    CurvesOfForm::new(&hull, &[draught], &Conventions::default()).rows[0].displacement_volume
}

#[test]
fn faces_of_every_kind_are_a_box() {
    for (name, warned) in [
        ("box-faces-mm.dxf", "1 curve beside the faces"),
        ("box-polyface-r12.dxf", "states no unit of length"),
        ("box-mesh-ft.dxf", ""),
        ("box-polymesh.dxf", ""),
        ("box-blocks.dxf", ""),
    ] {
        let body = read_body(name, &bytes(name), None).unwrap().unwrap_or_else(|e| panic!("{name}: {}", said(&e)));
        let report = body.meshes[0].report();
        assert!((report.volume / BOX - 1.0).abs() < 1e-9, "{name}: {}", report.volume);
        assert_eq!(body.meshes[0].open_edges().len(), 0, "{name}");
        assert!(said(&body.notes).contains(warned), "{name}: {}", said(&body.notes));
    }
}

#[test]
fn layers_are_the_parts_of_a_body() {
    let chosen = [("a.toml", "[table]\nparts = \"hull\"\n")];
    let body = read_body("box-faces-mm.dxf", &bytes("box-faces-mm.dxf"), chosen).unwrap().unwrap();
    assert_eq!(body.meshes[0].open_edges().len(), 4);
    assert!(said(&body.notes).contains("parts of the file: HULL, DECK"), "{}", said(&body.notes));
    let body = read_body("box-blocks.dxf", &bytes("box-blocks.dxf"), None).unwrap().unwrap();
    assert!(said(&body.notes).contains("parts of the file: STARBOARD, PORT"), "{}", said(&body.notes));
}

#[test]
fn round_sections_have_their_areas() {
    for (name, area) in [
        ("round-arcs.dxf", 0.5 * PI * 4.0),
        ("round-bulges.dxf", 0.5 * PI * 4.0),
        ("round-ellipses.dxf", 0.5 * PI * 6.0),
    ] {
        let read = read_table(name, &bytes(name)).unwrap_or_else(|e| panic!("{name}: {}", said(&e)));
        assert_eq!(read.table.stations.len(), 11, "{name}: {}", said(&read.notes));
        let found = volume(&read, 2.0);
        assert!((found / (20.0 * area) - 1.0).abs() < 1e-4, "{name}: {found}, expected {}", 20.0 * area);
    }
}

#[test]
fn curves_of_every_kind_are_the_wigley_hull() {
    for (name, off) in [
        ("wigley-bin-r12.dxf", 1e-3),
        ("wigley-bin-2000.dxf", 1e-3),
        ("wigley-fit-R2018.dxf", 1e-3),
        ("wigley-control-R2007.dxf", 1e-3),
        ("wigley-waterlines.dxf", 3e-3),
    ] {
        let read = read_table(name, &bytes(name)).unwrap_or_else(|e| panic!("{name}: {}", said(&e)));
        let found = volume(&read, 1.25);
        assert!((found / WIGLEY - 1.0).abs() < off, "{name}: {found}, expected {WIGLEY}\n{}", said(&read.notes));
    }
}

#[test]
fn what_holds_no_hull_is_refused() {
    let of = |name: &str, text: &[u8]| {
        let faults = read_table(name, text).err().unwrap_or_else(|| panic!("{name} is read"));
        said(&faults)
    };
    let cycle = of("cycle.dxf", &bytes("cycle.dxf"));
    assert!(cycle.contains("E350") && cycle.contains("more than 16 deep"), "{cycle}");
    let dwg = of("a.dwg", b"AC1032\0\0\0\0");
    assert!(dwg.contains("E300") && dwg.contains("Save it as DXF"), "{dwg}");
    assert!(of("a.dxf", b"AC1032\0\0\0\0").contains("this is a DWG file: save it as DXF"));
    assert!(of("a.dxf", b"AutoCAD Binary DXF\r\n\x1a\0\0\0SECTION").contains("the file ends within a group"));
    let entities = |body: &str| format!("0\nSECTION\n2\nENTITIES\n{body}0\nENDSEC\n0\nEOF\n");
    let cases = [
        (
            "0\n3DSOLID\n1\nxx\n0\nREGION\n0\n3DSOLID\n",
            "data of ACIS, which are not read (2 of 3DSOLID, 1 of REGION): export STEP",
        ),
        ("0\nLINE\n8\n0\n10\nNaN\n20\n0\n30\n0\n", "'NaN': group 10: expected a number of at most 1e8"),
        ("0\nLINE\n8\n0\nten\n0\n", "'ten': expected a group code, a whole number"),
        ("0\nPOLYLINE\n70\n16\n71\n30000\n72\n30000\n0\nSEQEND\n", "0 vertices of a mesh of 30000 by 30000"),
        (
            "0\nMESH\n92\n1\n10\n0\n20\n0\n30\n0\n93\n2\n90\n999999999\n90\n0\n",
            "a face of 999999999 corners, 1 numbers",
        ),
        ("0\nSPLINE\n71\n3\n40\n0\n10\n0\n20\n0\n30\n0\n", "E350"),
        ("0\nINSERT\n2\nNONE\n70\n32000\n71\n32000\n", "no faces and no curves"),
        ("0\nPOLYLINE\n70\n16\n71\n1000000000000\n72\n0\n0\nSEQEND\n", "no faces and no curves"),
        ("0\nHELIX\n10\n0\n40\n0\n41\n1\n", "no faces and no curves; there are 1 of HELIX"),
        ("0\nTEXT\n1\nhull\n0\nACAD_PROXY_ENTITY\n", "no faces and no curves; there are 1 of ACAD_PROXY_ENTITY"),
    ];
    for (body, expected) in cases {
        let found = of("a.dxf", entities(body).as_bytes());
        assert!(found.contains(expected), "{body}: {found}");
    }
    let unseen = of("a.dxf", entities("0\nPOLYLINE\n60\n1\n0\nVERTEX\n10\n0\n0\nSEQEND\n").as_bytes());
    assert!(unseen.contains("no faces and no curves") && !unseen.contains("VERTEX"), "{unseen}");
    let line = entities("0\nLINE\n8\n0\n10\n0\n20\n0\n30\n0\n11\n1\n21\n1\n31\n1\n");
    let cut = of("a.dxf", &line.as_bytes()[..line.len() - 16]);
    assert!(cut.contains("ends within the section ENTITIES"), "{cut}");
    // Blocks of blocks of blocks, each ten times.
    let mut bomb = "0\nSECTION\n2\nBLOCKS\n".to_owned();
    for k in 0..10 {
        bomb.push_str(&format!("0\nBLOCK\n2\nB{k}\n0\nINSERT\n2\nB{}\n70\n10\n0\nENDBLK\n", k + 1));
    }
    bomb.push_str("0\nBLOCK\n2\nB10\n0\nENDBLK\n0\nENDSEC\n");
    let bomb = of("a.dxf", (bomb + &entities("0\nINSERT\n2\nB0\n")).as_bytes());
    assert!(bomb.contains("more than 100000 inserts"), "{bomb}");
}

#[test]
fn our_own_lines_come_back() {
    for (name, allowed) in [("wigley", 1e-3_f64), ("box", 1e-6), ("bulk-carrier", 1e-3), ("seed002-frigate", 1e-3)] {
        let hull = read_source(&carried("configs").join(format!("{name}.toml"))).unwrap().hull;
        let draught = hull.reference_height();
        let conventions = Conventions::default();
        let own = CurvesOfForm::new(&hull, &[draught], &conventions).rows[0].displacement_volume;
        let file = export(&hull, name, &[ExportFormat::Dxf], &ExportSettings::default()).unwrap().files.remove(0);
        let stated = [("a.toml", "[table]\nx_origin = 0\n")];
        let read =
            read_table_with(&file.name, &file.contents, stated).unwrap_or_else(|e| panic!("{name}: {}", said(&e)));
        let found = volume(&read, draught);
        assert!((found / own - 1.0).abs() < allowed, "{name}: {found}, expected {own}\n{}", said(&read.notes));
        assert!(!said(&read.notes).contains("no unit of length"), "{}", said(&read.notes));
    }
}

#[test]
fn our_own_plan_is_refused() {
    let hull = read_source(&carried("configs").join("wigley.toml")).unwrap().hull;
    let plan = export(&hull, "a", &[ExportFormat::DxfPlan], &ExportSettings::default()).unwrap().files.remove(0);
    let faults = read_table(&plan.name, &plan.contents).unwrap_err();
    assert!(faults.iter().any(|fault| fault.code == "E328" && fault.message.contains("views of a drawing")));
}

/// Entities of 3D polylines, each on its layer.
fn polylines(curves: &[(&str, Vec<[f64; 3]>)]) -> String {
    let mut text = String::new();
    for (layer, points) in curves {
        text.push_str(&format!("0\nPOLYLINE\n8\n{layer}\n70\n8\n"));
        for [x, y, z] in points {
            text.push_str(&format!("0\nVERTEX\n8\n{layer}\n10\n{x:?}\n20\n{y:?}\n30\n{z:?}\n"));
        }
        text.push_str("0\nSEQEND\n");
    }
    text
}

fn drawing(entities: &str) -> String {
    format!("0\nSECTION\n2\nENTITIES\n{entities}0\nENDSEC\n0\nEOF\n")
}

/// Eleven sections from the keel to a height \[m\].
fn sections(height: f64) -> Vec<(&'static str, Vec<[f64; 3]>)> {
    let section = |x: f64| vec![[x, 0.0, 0.0], [x, 1.5, 0.2], [x, 2.0, 0.5 * height], [x, 2.0, height]];
    (0..11).map(|k| ("SECT", section(2.0 * f64::from(k)))).collect()
}

#[test]
fn layers_of_few_sections_go_on_from_the_others() {
    let mut curves = sections(1.0);
    for k in 3..8 {
        let x = 2.0 * f64::from(k);
        curves.push(("TOP", vec![[x, 2.0, 3.0], [x, 2.0, 2.0], [x, 2.0, 1.0]]));
    }
    for x in [4.0, 6.0] {
        curves.push(("FLOOR", vec![[x, 0.2, 0.4], [x, 1.0, 0.4]]));
    }
    let read = read_table("a.dxf", drawing(&polylines(&curves)).as_bytes()).unwrap_or_else(|e| panic!("{}", said(&e)));
    let high = read.table.stations.iter().filter(|s| s.outlines.iter().flatten().any(|p| p.z > 2.9));
    assert_eq!(high.count(), 5, "{}", said(&read.notes));
    let notes = said(&read.notes);
    assert!(notes.contains("W332 a.dxf: left out: 2 curves, on layers of few sections (FLOOR 2)"), "{notes}");
}

#[test]
fn curves_beside_each_other_are_named() {
    let mut curves = sections(3.0);
    for k in 0..11 {
        let x = 2.0 * f64::from(k);
        curves.push(("GRID", vec![[x, 0.0, 1.0], [x, 4.0, 1.0]]));
    }
    let notes = match read_table("a.dxf", drawing(&polylines(&curves)).as_bytes()) {
        Ok(read) => said(&read.notes),
        Err(faults) => said(&faults),
    };
    assert!(notes.contains("curves beside each other at one height") && notes.contains("GRID, SECT"), "{notes}");
}

#[test]
fn solids_beside_curves_or_faces_are_refused() {
    let solid = "0\n3DSOLID\n8\nSOLIDS\n1\nxx\n0\nREGION\n8\nSOLIDS\n";
    let wanted = "1 of 3DSOLID, 1 of REGION (layers SOLIDS): data of ACIS";
    let text = drawing(&(polylines(&sections(3.0)) + solid));
    let faults = said(&read_table("a.dxf", text.as_bytes()).unwrap_err());
    assert!(faults.contains("E352") && faults.contains(wanted), "{faults}");
    let chosen = [("a.toml", "[table]\nunits = \"m\"\nparts = \"sect\"\n")];
    let read = read_table_with("a.dxf", text.as_bytes(), chosen).unwrap_or_else(|e| panic!("{}", said(&e)));
    assert_eq!(read.table.stations.len(), 11);
    let faces: String = box_faces("HULL");
    let both = drawing(&format!("{faces}{solid}"));
    let faults = said(&read_table("a.dxf", both.as_bytes()).unwrap_err());
    assert!(faults.contains("E352") && faults.contains(wanted), "{faults}");
    let of = |part: &str| {
        let beside = format!("[table]\nunits = \"m\"\nparts = \"{part}\"\n");
        read_body("a.dxf", both.as_bytes(), [("a.toml", beside.as_str())]).unwrap()
    };
    let volume = of("hull").unwrap_or_else(|e| panic!("{}", said(&e))).meshes[0].report().volume;
    assert!((volume - 720.0).abs() < 1e-9, "{volume}");
    assert!(said(&of("solids").unwrap_err()).contains(wanted));
}

/// A box of 30 x 8 x 3 m as faces on a layer.
fn box_faces(layer: &str) -> String {
    let corner = |k: usize| [[0.0, 30.0][k & 1], [-4.0, 4.0][k >> 1 & 1], [0.0, 3.0][k >> 2]];
    let face = |places: [usize; 4]| {
        let point = |(n, k): (usize, &usize)| {
            let [x, y, z] = corner(*k);
            format!("1{n}\n{x}\n2{n}\n{y}\n3{n}\n{z}\n")
        };
        format!("0\n3DFACE\n8\n{layer}\n{}", places.iter().enumerate().map(point).collect::<String>())
    };
    [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]].map(face).concat()
}

#[test]
fn references_to_other_files_are_named() {
    let blocks = "0\nSECTION\n2\nBLOCKS\n0\nBLOCK\n2\nAFT\n70\n4\n1\naft.dwg\n0\nENDBLK\n0\nENDSEC\n";
    let text = format!("{blocks}{}", drawing(&(polylines(&sections(3.0)) + "0\nINSERT\n2\nAFT\n")));
    let read = read_table("a.dxf", text.as_bytes()).unwrap_or_else(|e| panic!("{}", said(&e)));
    let notes = said(&read.notes);
    assert!(notes.contains("W352") && notes.contains("1 of INSERT name blocks that the file does not hold"), "{notes}");
}

#[test]
fn many_comments_before_the_first_section_are_passed() {
    let comments = "999\ncomment of a program\n".repeat(10_000);
    let text = comments + &drawing(&polylines(&sections(3.0)));
    let read = read_table("a.dxf", text.as_bytes()).unwrap_or_else(|e| panic!("{}", said(&e)));
    assert_eq!(read.table.stations.len(), 11);
}
