//! `loftsman export`: every configuration in every format.

use std::fs;
use std::path::PathBuf;

use loftsman::internals::exchange::{DxfVersion, read_table, sha256};
use loftsman::internals::hull::{
    FitMethod, Hull, HullMesh, LEAST_ANGLE, PanelMesh, PanelSettings, Solid, whole_volume,
};
use loftsman::internals::hydrostatics::{Conventions, CurvesOfForm};
use loftsman::internals::report::{ExportFormat, ExportSettings, export, read_source, read_table_file};

use crate::support::{carried, folder, program, stderr};

fn config(name: &str) -> PathBuf {
    carried("configs").join(name)
}

#[test]
fn every_config_is_written_in_every_format_and_its_mesh_is_closed() {
    for name in ["box", "bulk-carrier", "fishing-vessel", "seed002-frigate", "wigley", "yacht"] {
        let hull = read_source(&config(&format!("{name}.toml"))).unwrap().hull;
        let settings =
            ExportSettings { deviation: Some(5e-3 * hull.particulars().breadth), ..ExportSettings::default() };
        let exported = export(&hull, name, &ExportFormat::ALL, &settings).unwrap();
        assert_eq!(exported.files.len(), ExportFormat::ALL.len());
        assert!(exported.page.contains(", closed; "), "{name}: {}", exported.page);
        // What tables and control nets hold is said.
        let said =
            |begin: &str, part: &str| exported.page.lines().any(|line| line.starts_with(begin) && line.contains(part));
        assert!(said("offsets: ", "below the lowest and above the highest"), "{name}: {}", exported.page);
        assert!(said("control net: ", "of the hull's"), "{name}: {}", exported.page);
        assert!(exported.files.iter().all(|file| !file.contents.is_empty()));
        // The same bytes again.
        assert_eq!(export(&hull, name, &ExportFormat::ALL, &settings).unwrap(), exported, "{name}");
    }
}

#[test]
fn files_are_not_overwritten_unasked() {
    let folder = folder("again");
    let (hull, out) = (config("box.toml").display().to_string(), folder.display().to_string());
    let arguments = ["export", hull.as_str(), "-f", "step,obj", "-o", out.as_str(), "--datum", "waterline"];
    assert_eq!(program(&arguments).status.code(), Some(0));
    let text = folder.read("box.obj");
    let heights = text.lines().filter_map(|line| line.strip_prefix("v ")?.split(' ').nth(2)?.parse::<f64>().ok());
    let (least, most) = heights.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), z| (a.min(z), b.max(z)));
    let particulars = *read_source(&config("box.toml")).unwrap().hull.particulars();
    let draught = particulars.draught.unwrap();
    assert!((least + draught).abs() < 1e-12, "{least}");
    assert!((most + draught - particulars.depth).abs() < 1e-12, "{most}");
    let again = program(&arguments);
    assert_eq!(again.status.code(), Some(6));
    assert_eq!(folder.read("box.obj"), text);
    let mut forced = arguments.to_vec();
    forced.push("--force");
    assert_eq!(program(&forced).status.code(), Some(0));
    let wrong = program(&["export", hull.as_str(), "-f", "dwg"]);
    assert_eq!(wrong.status.code(), Some(2));
    assert!(stderr(&wrong).contains(
        "step, iges, 3dm, dxf, stl, stl-ascii, obj, ply, glb, 3mf, vtk, msh, gdf, nemoh, pnl, ghs, britfair, pias, pdstrip, freeship, \
         delftship, ftm, michlet, csv, xlsx, dxf-plan"
    ));
}

/// The files of a small box. After a wanted change of a writer they are remade by
/// `loftsman export configs/box.toml -f FORMATS -o tests/golden --divisions-across 1 --panel 25m --force`.
#[test]
fn files_are_those_of_the_golden_folder() {
    let hull = read_source(&config("box.toml")).unwrap().hull;
    let settings = ExportSettings { across: 1, panel: Some(25.0), ..ExportSettings::default() };
    let exported = export(&hull, "box", &ExportFormat::ALL, &settings).unwrap();
    let golden = carried("tests/golden");
    for file in &exported.files {
        let wanted = fs::read(golden.join(&file.name)).unwrap_or_default();
        assert!(wanted == file.contents, "{} is not what tests/golden has", file.name);
    }
    // DXF of AutoCAD 2000 by its hash: as large as that of R12, with the same lines.
    let settings = ExportSettings { dxf: DxfVersion::R2000, ..settings };
    let format = ExportFormat::ALL.into_iter().find(|format| format.name() == "dxf-plan").unwrap();
    let plan = export(&hull, "box", &[format], &settings).unwrap().files.remove(0);
    assert_eq!(sha256(&plan.contents), "08490d760f6ebf95df05ade864c5ed07ec604c9aa513731dcf307e34e49f84d8");
    let kept = fs::read_dir(golden).unwrap().filter(|entry| entry.as_ref().unwrap().path().is_file());
    assert_eq!(kept.count(), exported.files.len());
}

/// Sections run from end to end, closer where areas turn, with stations and chords within the page's bound.
#[test]
fn sections_have_the_volume_of_the_hull() {
    for name in ["box", "bulk-carrier", "fishing-vessel", "frigate", "tug", "wigley", "yacht"] {
        let hull = read_source(&config(&format!("{name}.toml"))).unwrap().hull;
        let format = ExportFormat::ALL.into_iter().find(|format| format.name() == "ghs").unwrap();
        let page = export(&hull, name, &[format], &ExportSettings::default()).unwrap().page;
        let (_, off) = page.split_once(" m3, ").unwrap();
        let off: f64 = off.split(' ').next().unwrap().parse().unwrap();
        assert!(off.abs() < 3e-3, "{name}: {page}");
    }
}

#[test]
fn solids_have_the_volume_of_the_hull() {
    for name in ["box", "bulk-carrier", "fishing-vessel", "frigate", "seed002-frigate", "tug", "wigley", "yacht"] {
        let hull = read_source(&config(&format!("{name}.toml"))).unwrap().hull;
        let solid = Solid::new(&hull).unwrap();
        assert!(solid.is_closed(), "{name}");
        let error = solid.volume() / whole_volume(&hull) - 1.0;
        assert!(error.abs() < 1e-10, "{name}: {error:e}");
        assert!(solid.deviation < 1e-6, "{name}: {:e}", solid.deviation);
    }
}

#[test]
fn panels_have_the_volume_of_the_hull_and_converge() {
    for name in ["bulk-carrier", "fishing-vessel", "seed002-frigate", "wigley", "yacht"] {
        let hull = read_source(&config(&format!("{name}.toml"))).unwrap().hull;
        let length = hull.particulars().length_between_perpendiculars;
        let draught = 0.9 * hull.reference_height();
        let exact = CurvesOfForm::new(&hull, &[draught], &Conventions::default()).rows.remove(0);
        let mut last = [f64::NAN; 2];
        for parts in [25.0, 50.0, 100.0] {
            let mesh = PanelMesh::new(&hull, &PanelSettings { draught, size: length / parts, flatness: 0.0 }).unwrap();
            let report = mesh.report();
            let errors = [report.volume / exact.displacement_volume - 1.0, report.area / exact.wetted_surface - 1.0];
            let limit = 50.0 / (parts * parts);
            assert!(errors.iter().all(|error| error.abs() < limit), "{name} {parts}: {errors:?}");
            // Second order: a quarter, or near to it where rows are added one by one.
            for (error, last) in errors.iter().zip(last) {
                assert!(last.is_nan() || error.abs() < 0.45 * last || error.abs() < 1e-4, "{name} {parts}: {errors:?}");
            }
            last = errors.map(f64::abs);
        }
    }
}

fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// The corners of the panels of a GDF file.
fn corners_of(gdf: &[u8]) -> Vec<[[f64; 3]; 4]> {
    let text = String::from_utf8_lossy(gdf);
    let number = |word: &str| word.parse::<f64>().unwrap();
    let points = text.lines().skip(4).map(|line| {
        let values: Vec<f64> = line.split_whitespace().map(number).collect();
        [values[0], values[1], values[2]]
    });
    points.collect::<Vec<_>>().chunks(4).map(|panel| [panel[0], panel[1], panel[2], panel[3]]).collect()
}

#[test]
fn panels_are_planar_and_small_enough_where_nothing_is_said() {
    for name in ["box", "bulk-carrier", "wigley", "yacht"] {
        let hull = read_source(&config(&format!("{name}.toml"))).unwrap().hull;
        let draught = hull.reference_height();
        let exact = CurvesOfForm::new(&hull, &[draught], &Conventions::default()).rows.remove(0).displacement_volume;
        let written = export(&hull, name, &[ExportFormat::Gdf], &ExportSettings::default()).unwrap();
        let (mut volume, mut quadrilaterals) = (0.0, 0);
        for [a, b, c, d] in corners_of(&written.files[0].contents) {
            let (p, q, r) = (minus(b, a), minus(c, a), minus(d, a));
            let (first, second) = (cross(p, q), cross(q, r));
            volume += first[1] * (a[1] + b[1] + c[1]) / 3.0 + second[1] * (a[1] + c[1] + d[1]) / 3.0;
            if dot(minus(c, d), minus(c, d)) > 0.0 {
                quadrilaterals += 1;
                // Six times the volume of the tetrahedron of the corners, over the cube of a diagonal.
                let long = dot(q, q).max(dot(minus(d, b), minus(d, b))).powf(1.5);
                assert!(dot(first, r).abs() < 1e-11 * long, "{name}: {a:?} {b:?} {c:?} {d:?}");
            }
        }
        assert!((volume / exact - 1.0).abs() < 5e-3, "{name}: {volume} of {exact}");
        assert!(quadrilaterals > 0, "{name}");
    }
}

#[test]
fn panels_of_an_immersed_deck_are_refused() {
    let hull = config("box.toml").display().to_string();
    for format in ["gdf", "michlet", "pdstrip"] {
        let refused = program(&["export", &hull, "-f", format, "--draught", "12"]);
        assert_eq!(refused.status.code(), Some(2), "{format}");
        assert!(String::from_utf8_lossy(&refused.stderr).contains("lies above the depth"), "{format}");
    }
}

#[test]
fn what_cannot_be_meant_is_refused() {
    let hull = config("box.toml").display().to_string();
    for (arguments, said) in [
        (["-f", "step,obj,step", "--datum", "0"], "--format names step twice"),
        (["-f", "step", "--datum", "1e300"], "expected at most 1000 m from the base line"),
        (["-f", "dxf", "--deviation", "1e-9"], "a millionth of the breadth"),
        (["-f", "stl", "--deviation", "1e9"], "a tenth of the lesser of breadth and depth"),
    ] {
        let refused = program(&[&["export", hull.as_str()], &arguments[..]].concat());
        assert_eq!(refused.status.code(), Some(2), "{arguments:?}");
        assert!(
            String::from_utf8_lossy(&refused.stderr).contains(said),
            "{}",
            String::from_utf8_lossy(&refused.stderr)
        );
    }
    let ellipsoid = config("ellipsoid.toml").display().to_string();
    let refused = program(&["export", &ellipsoid, "-f", "stl", "--deviation", "0.00003"]);
    assert_eq!(refused.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&refused.stderr).contains("triangles, expected at most 4000000"));
}

#[test]
fn sections_and_tables_are_read_back_as_the_hull() {
    for (name, allowed) in [("bulk-carrier", 2e-3_f64), ("seed002-frigate", 2e-3), ("yacht", 3e-3)] {
        let hull = read_source(&config(&format!("{name}.toml"))).unwrap().hull;
        let draught = [hull.reference_height()];
        let volume =
            |hull: &Hull| CurvesOfForm::new(hull, &draught, &Conventions::default()).rows[0].displacement_volume;
        let formats: Vec<ExportFormat> = ["ghs", "britfair", "pias", "freeship", "delftship", "csv", "xlsx"]
            .iter()
            .map(|name| ExportFormat::ALL.into_iter().find(|format| format.name() == *name).unwrap())
            .collect();
        let settings =
            ExportSettings { deviation: Some(3e-4 * hull.particulars().breadth), ..ExportSettings::default() };
        for file in export(&hull, name, &formats, &settings).unwrap().files {
            let table = read_table(&file.name, &file.contents).unwrap_or_else(|e| panic!("{}: {e:?}", file.name)).table;
            let fitted = Hull::fit(&table, &FitMethod::default()).unwrap().hull;
            let error = volume(&fitted) / volume(&hull) - 1.0;
            assert!(error.abs() < allowed, "{}: {error:e}", file.name);
        }
    }
}

#[test]
fn the_drawn_plan_has_its_views_apart() {
    let hull = read_source(&config("seed002-frigate.toml")).unwrap().hull;
    let format = ExportFormat::ALL.into_iter().find(|format| format.name() == "dxf-plan").unwrap();
    let exported = export(&hull, "f", &[format], &ExportSettings::default()).unwrap();
    assert_eq!(exported.files[0].name, "f-plan.dxf");
    let text = String::from_utf8(exported.files[0].contents.clone()).unwrap();
    let lines: Vec<&str> = text.lines().map(str::trim).collect();
    let pairs: Vec<(&str, &str)> = lines.chunks(2).map(|pair| (pair[0], pair[1])).collect();
    // The extents of the vertices of each view.
    let mut extents = std::collections::BTreeMap::new();
    let (mut vertex, mut view, mut x) = (false, String::new(), 0.0);
    for (code, value) in pairs {
        match code {
            "0" => vertex = value == "VERTEX",
            "8" => view = value.split('_').next().unwrap().to_owned(),
            "10" => x = value.parse::<f64>().unwrap(),
            "20" if vertex => {
                let y: f64 = value.parse().unwrap();
                let e = extents.entry(view.clone()).or_insert([x, y, x, y]);
                *e = [e[0].min(x), e[1].min(y), e[2].max(x), e[3].max(y)];
            }
            "30" => assert_eq!(value, "0.0"),
            _ => {}
        }
    }
    let particulars = hull.particulars();
    let [body, plan, profile] = ["BODY", "PLAN", "PROFILE"].map(|view| extents[view]);
    let (length, breadth) = (particulars.length_between_perpendiculars, particulars.breadth);
    assert!((profile[2] - profile[0] - length).abs() < 0.02 * length && profile[1].abs() < 1e-9, "{profile:?}");
    assert!((plan[3] - plan[1] - 0.5 * breadth).abs() < 1e-3 * breadth && plan[3] < profile[1], "{plan:?}");
    assert!((body[2] - body[0] - breadth).abs() < 1e-3 * breadth && body[0] > profile[2], "{body:?}");
}

/// The least angle of a triangle \[degrees\] and the corner that has it.
fn least_angle(corners: [[f64; 3]; 3]) -> (f64, usize) {
    let angle = |k: usize| {
        let [a, b, c] = [0, 1, 2].map(|j| corners[(k + j) % 3]);
        let (p, q) = (minus(b, a), minus(c, a));
        dot(cross(p, q), cross(p, q)).sqrt().atan2(dot(p, q)).to_degrees()
    };
    (0..3).map(|k| (angle(k), k)).min_by(|p, q| p.0.total_cmp(&q.0)).unwrap()
}

/// Triangles below the bound that stand at no sharp corner, after what a mesh says of itself was found true.
fn slivers(name: &str, hull: &Hull, deviation: f64) -> usize {
    let mesh = HullMesh::new(hull, deviation, 8).unwrap();
    let report = mesh.report();
    assert!(report.closed && report.open_edges == 0, "{name}: {report:?}");
    let mut found = 0;
    for (region, corners) in &mesh.triangles {
        let (angle, at) = least_angle(corners.map(|k| mesh.vertices[k]));
        if angle < LEAST_ANGLE.to_degrees() {
            let sharp = mesh.sharp_corners.iter().any(|c| c.vertex == corners[at] && c.region == *region);
            found += usize::from(!sharp);
        }
    }
    assert_eq!(found, mesh.slivers(), "{name}");
    // A corner is sharper than the bound, and on the outline of its face: at the centreplane or on the edge of another.
    for corner in &mesh.sharp_corners {
        assert!(corner.angle < LEAST_ANGLE, "{name}: {corner:?}");
        let others = mesh.triangles.iter().any(|(region, t)| *region != corner.region && t.contains(&corner.vertex));
        assert!(others || mesh.vertices[corner.vertex][1].abs() <= 0.0, "{name}: {corner:?}");
    }
    assert!(mesh.sharp_corners.len() <= 1 + mesh.triangles.len() / 1000, "{name}: {:?}", mesh.sharp_corners);
    found
}

#[test]
fn no_triangle_is_a_sliver_but_at_sharper_corners() {
    for entry in fs::read_dir(config("")).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_none_or(|ending| ending != "toml") {
            continue;
        }
        let hull = read_source(&path).unwrap().hull;
        let name = path.file_stem().unwrap().to_string_lossy().into_owned();
        for share in [4e-3, 1e-3] {
            assert_eq!(slivers(&name, &hull, share * hull.particulars().breadth), 0, "{name} at {share}");
        }
    }
}

#[test]
fn hulls_laid_through_tables_have_no_slivers() {
    let tables = [
        "s175/sections.csv",
        "wigley/offsets.csv",
        "pdstrip_yacht/sections.csv",
        "series60_cb060/offsets.csv",
        "series60_cb070/offsets.csv",
    ];
    for table in tables {
        let path = carried("tests/data").join(table);
        let (table_read, _) = read_table_file(&path).unwrap();
        let hull = Hull::fit(&table_read, &FitMethod::default()).unwrap().hull;
        assert_eq!(slivers(table, &hull, 1e-3 * hull.particulars().breadth), 0, "{table}");
    }
}

#[test]
fn the_page_says_what_its_angles_are() {
    let hull = read_source(&config("bulk-carrier.toml")).unwrap().hull;
    let page = export(&hull, "b", &[ExportFormat::Stl], &ExportSettings::default()).unwrap().page;
    assert!(
        page.contains("degrees (bound 15, 0 triangles below it but at 1 sharper corner of the body: bottom "),
        "{page}"
    );
    let hull = read_source(&config("wigley.toml")).unwrap().hull;
    let page = export(&hull, "w", &[ExportFormat::Stl], &ExportSettings::default()).unwrap().page;
    assert!(page.contains("degrees (bound 15, 0 triangles below it); volume"), "{page}");
}

#[test]
fn volumes_of_meshes_converge_at_second_order() {
    for name in ["bulk-carrier", "seed002-frigate", "wigley"] {
        let hull = read_source(&config(&format!("{name}.toml"))).unwrap().hull;
        let (breadth, exact) = (hull.particulars().breadth, whole_volume(&hull));
        let error = |share: f64| {
            let mesh = HullMesh::new(&hull, share * breadth, 8).unwrap();
            ((mesh.report().volume / exact - 1.0).abs(), mesh.triangles.len() as f64)
        };
        let ((coarse, many), (fine, more)) = (error(4e-3), error(1e-3));
        // The error over the number of triangles, which grows with the square of the fineness.
        let order: f64 = 2.0 * (coarse / fine).ln() / (more / many).ln();
        assert!(order > 1.6, "{name}: {order} ({coarse:e} to {fine:e}, {many} to {more} triangles)");
    }
}
