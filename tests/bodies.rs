//! Bodies of triangles: what is exported is read back, floats as the hull does, and becomes a table that can be fitted.

use std::fs;
use std::path::{Path, PathBuf};

use loftsman::internals::exchange::{CadUnit, Severity, read_body, read_subdivision, read_table, write_ftm};
use loftsman::internals::hull::{FitMethod, Hull, PanelMesh, PanelSettings, TriangleMesh};
use loftsman::internals::hydrostatics::{Conventions, CurvesOfForm, Hydrostatics};
use loftsman::internals::report::{ExportFormat, ExportSettings, export, read_hydrostatic_body, read_source};

use crate::random::Random;
use crate::support::{carried, folder, program, read_text, stderr};

fn config(name: &str) -> Hull {
    let path = carried("configs").join(format!("{name}.toml"));
    read_source(&path).unwrap().hull
}

/// The files of a hull in a folder, with the conventions that its dimensions give.
fn files(folder: &Path, hull: &Hull, name: &str, formats: &[ExportFormat]) -> Vec<PathBuf> {
    let particulars = hull.particulars();
    let deviation = Some(3e-4 * particulars.breadth);
    let exported = export(hull, name, formats, &ExportSettings { deviation, ..ExportSettings::default() }).unwrap();
    let beside = format!(
        "[table]\nLpp = {}\nB = {}\nT = {}\nx_origin = 0\n",
        particulars.length_between_perpendiculars,
        particulars.breadth,
        hull.reference_height()
    );
    let write = |file: &loftsman::internals::report::OutputFile| {
        let path = folder.join(&file.name);
        fs::write(&path, &file.contents).unwrap();
        fs::write(path.with_extension("toml"), &beside).unwrap();
        path
    };
    exported.files.iter().map(write).collect()
}

const MESHES: [ExportFormat; 3] = [ExportFormat::Stl, ExportFormat::StlAscii, ExportFormat::Obj];

const PANELS: [ExportFormat; 3] = [ExportFormat::Gdf, ExportFormat::Nemoh, ExportFormat::Pnl];

#[test]
fn panels_and_scenes_are_read_back() {
    let hull = config("seed002-frigate");
    let draught = hull.reference_height();
    let settings = PanelSettings {
        draught,
        size: hull.particulars().length_between_perpendiculars / 50.0,
        flatness: ExportSettings::default().flatness,
    };
    let wanted = PanelMesh::new(&hull, &settings).unwrap().report();
    let enclosed = |mesh: &TriangleMesh| {
        let of = |[a, b, c]: [[f64; 3]; 3]| {
            let normal = (b[2] - a[2]) * (c[0] - a[0]) - (b[0] - a[0]) * (c[2] - a[2]);
            normal * (a[1] + b[1] + c[1]) / 6.0
        };
        mesh.corners().map(of).sum::<f64>()
    };
    for file in export(&hull, "frigate", &PANELS, &ExportSettings::default()).unwrap().files {
        let body = read_body(&file.name, &file.contents, None).unwrap().unwrap();
        let volume = enclosed(&body.meshes[0]);
        assert!((volume / wanted.volume - 1.0).abs() < 1e-9, "{}: {volume} for {}", file.name, wanted.volume);
        let [least, greatest] = body.meshes[0].bounds().unwrap();
        assert!(
            (least[2] + draught).abs() < 0.02 && greatest[2].abs() < 1e-12 && (least[1] + greatest[1]).abs() < 1e-12
        );
    }
    let formats = [ExportFormat::Obj, ExportFormat::Glb];
    let files = export(&hull, "frigate", &formats, &ExportSettings::default()).unwrap().files;
    let volumes = files.iter().map(|file| {
        let said = [("frigate.toml", if file.name.ends_with("glb") { "[table]\nup = 'y'\n" } else { "" })];
        enclosed(&read_body(&file.name, &file.contents, said).unwrap().unwrap().meshes[0])
    });
    let volumes: Vec<f64> = volumes.collect();
    assert!((volumes[0] / volumes[1] - 1.0).abs() < 1e-6, "{volumes:?}");
    // Faults name their record.
    for (name, text, said) in [
        ("a.gdf", "title\n1 9.8 ULEN GRAV\n0 1 ISX ISY\n2\n0 0 0 1 0 0 1 1 0 0 1\n", "a corner of panel 1 of 2"),
        ("a.mar", "2 1\n1 0 0 0\n0 0 0 0\n1 2 3 4\n", "no node; there are 1"),
        ("a.pnl", "1 1 0 1\n1 0 0 x\n", "expected node 1 of 1"),
        ("a.glb", "glTF", "expected a scene of glTF 2.0"),
    ] {
        let list = read_body(name, text.as_bytes(), None).unwrap().unwrap_err();
        assert!(list.iter().any(|p| p.to_string().contains(said)), "{name}: {list:?}");
    }
}

fn main_quantities(row: &Hydrostatics) -> [f64; 9] {
    [
        row.displacement_volume,
        row.lcb.unwrap(),
        row.kb.unwrap(),
        row.waterplane_area,
        row.lcf.unwrap(),
        row.transverse_inertia,
        row.longitudinal_inertia,
        row.midship_section_area,
        row.wetted_surface,
    ]
}

#[test]
fn exported_meshes_float_as_their_hulls() {
    for name in ["box", "bulk-carrier", "seed002-frigate", "yacht"] {
        let hull = config(name);
        let draughts = [0.4, 0.75, 1.0].map(|share| share * hull.reference_height());
        let exact = CurvesOfForm::new(&hull, &draughts, &Conventions::default()).rows;
        let folder = folder(name);
        for path in files(&folder, &hull, name, &MESHES) {
            let body = read_hydrostatic_body(&path).unwrap();
            assert!((body.particulars.breadth - hull.particulars().breadth).abs() < 1e-12);
            let found = body.curves_of_form(&draughts, &Conventions::default()).unwrap().0.rows;
            for (a, b) in found.iter().zip(&exact) {
                for (k, (x, y)) in main_quantities(a).into_iter().zip(main_quantities(b)).enumerate() {
                    assert!(
                        (x / y - 1.0).abs() < 4e-3,
                        "{} at {}: quantity {k} is {x} for {y}",
                        path.display(),
                        a.draught
                    );
                }
            }
        }
    }
}

#[test]
fn exported_surfaces_float_as_their_hulls_to_a_millionth() {
    for name in ["box", "wigley"] {
        let hull = config(name);
        let draughts = [0.4, 0.75].map(|share| share * hull.reference_height());
        let exact = CurvesOfForm::new(&hull, &draughts, &Conventions::default()).rows;
        let folder = folder(&format!("surfaces-{name}"));
        for path in files(&folder, &hull, name, &[ExportFormat::Step, ExportFormat::Iges, ExportFormat::Rhino]) {
            let found = read_hydrostatic_body(&path)
                .unwrap()
                .curves_of_form(&draughts, &Conventions::default())
                .unwrap()
                .0
                .rows;
            for (a, b) in found.iter().zip(&exact) {
                for (k, (x, y)) in main_quantities(a).into_iter().zip(main_quantities(b)).enumerate() {
                    // A single line is not averaged over the triangles as a volume is.
                    let allowed = if k < 3 { 2e-6 } else { 2e-4 };
                    assert!(
                        (x / y - 1.0).abs() < allowed,
                        "{} at {}: quantity {k} is {x} for {y}",
                        path.display(),
                        a.draught
                    );
                }
            }
        }
    }
}

#[test]
fn surfaces_in_millimetres_become_a_table() {
    let hull = config("wigley");
    let settings = ExportSettings { unit: CadUnit::Millimetre, ..ExportSettings::default() };
    let exported =
        export(&hull, "wigley", &[ExportFormat::Step, ExportFormat::Iges, ExportFormat::Rhino], &settings).unwrap();
    for file in &exported.files {
        let table = read_table(&file.name, &file.contents).unwrap().table;
        assert_eq!(table.stations.len(), 41, "{}", file.name);
        for station in &table.stations {
            assert_eq!(station.outlines.len(), 1, "{} at {}", file.name, station.station.x);
            for point in &station.outlines[0] {
                let y = hull.half_breadth(station.station.x, point.z).unwrap_or(0.0);
                assert!((point.y - y).abs() < 4e-3, "{} at {}: {point:?} for {y}", file.name, station.station.x);
            }
        }
    }
}

#[test]
fn a_mesh_is_fitted_like_a_table() {
    let hull = config("bulk-carrier");
    let folder = folder("fitted");
    let path = files(&folder, &hull, "fitted", &[ExportFormat::Stl]).remove(0);
    let (table, _) = loftsman::internals::report::read_table_file(&path).unwrap();
    assert_eq!(table.stations.len(), 41);
    let fitted = Hull::fit(&table, &FitMethod::default()).unwrap().hull;
    let draught = [hull.reference_height()];
    let volume = |hull: &Hull| CurvesOfForm::new(hull, &draught, &Conventions::default()).rows[0].displacement_volume;
    let error = volume(&fitted) / volume(&hull) - 1.0;
    assert!(error.abs() < 2e-3, "{error:e}");
}

#[test]
fn the_commands_take_meshes() {
    let hull = config("yacht");
    let folder = folder("commands");
    let path = files(&folder, &hull, "commands", &[ExportFormat::Obj]).remove(0).display().to_string();
    let told = program(&["hydro", &path, "--draughts", "0.3,0.6", "--csv"]);
    assert_eq!(told.status.code(), Some(0), "{}", stderr(&told));
    assert_eq!(String::from_utf8_lossy(&told.stdout).lines().count(), 4);
    assert!(stderr(&told).contains("a mesh (OBJ)"));
    let out = Path::new(&path).with_extension("csv").display().to_string();
    let converted = program(&["convert", &path, &out]);
    assert_eq!(converted.status.code(), Some(0), "{}", stderr(&converted));
    // The table is the one that the mesh gives, to the rounding of its notation.
    let read = |name: &str| read_table(name, &fs::read(name).unwrap()).unwrap().table;
    let (table, mesh) = (read(&out), loftsman::internals::report::read_table_file(Path::new(&path)).unwrap().0);
    assert_eq!(table.stations.len(), mesh.stations.len());
    for (a, b) in table.stations.iter().zip(&mesh.stations) {
        assert!((a.station.x - b.station.x).abs() < 1e-6);
        assert_eq!(a.outlines.iter().flatten().count(), b.outlines.iter().flatten().count());
    }
    let missing = program(&["hydro", "no.stl", "--draughts", "1"]);
    assert_eq!(missing.status.code(), Some(6));
}

#[test]
fn damaged_meshes_and_random_bytes_never_stop_the_program() {
    let hull = config("box");
    let settings = ExportSettings { across: 1, ..ExportSettings::default() };
    let others = [ExportFormat::Step, ExportFormat::Iges, ExportFormat::Rhino, ExportFormat::Ftm, ExportFormat::Glb];
    let formats = [&MESHES[..], &others, &PANELS].concat();
    let exported = export(&hull, "box", &formats, &settings).unwrap();
    let mut random = Random(7);
    for file in &exported.files {
        for _ in 0..60 {
            let mut bytes = file.contents.clone();
            for _ in 0..=random.below(6) {
                let at = random.below(bytes.len());
                match random.below(4) {
                    0 => bytes[at] = random.next() as u8,
                    1 => bytes.truncate(at.max(1)),
                    2 => {
                        bytes.remove(at);
                    }
                    _ => bytes.splice(at..at, *b"-9,(nan 1e9,").for_each(drop),
                }
                if bytes.is_empty() {
                    bytes.push(0);
                }
            }
            for name in [file.name.as_str(), "unknown"] {
                sound(name, &bytes);
            }
        }
    }
    for length in [0, 1, 83, 84, 85, 134, 500, 5000] {
        let bytes: Vec<u8> = (0..length).map(|_| random.next() as u8).collect();
        for name in ["a.stl", "a.obj", "a.igs", "a.3dm", "a.step", "a.ftm", "a.fbm", "a.glb", "a.gdf", "a.pnl", "a.mar"]
        {
            sound(name, &bytes);
        }
    }
    // A count that promises more than there is.
    let mut bytes = vec![0; 84];
    bytes[80..].copy_from_slice(&u32::MAX.to_le_bytes());
    sound("a.stl", &bytes);
}

fn sound(name: &str, bytes: &[u8]) {
    if let Some(read) = read_body(name, bytes, None) {
        match read {
            Ok(body) => {
                assert!(body.meshes.iter().flat_map(|mesh| mesh.vertices.iter().flatten()).all(|c| c.is_finite()));
                if let Ok(read) = body.table() {
                    let points = read.table.stations.iter().flat_map(|s| s.outlines.iter().flatten());
                    assert!(points.into_iter().all(|p| p.y >= 0.0 && p.y.is_finite() && p.z.is_finite()));
                }
            }
            Err(problems) => {
                assert!(problems.iter().any(|p| p.severity == Severity::Error) && problems.len() < 300);
                assert!(problems.iter().all(|p| p.found.chars().count() < 200));
            }
        }
    }
}

fn golden(name: &str) -> String {
    read_text(carried("tests/golden").join(name))
}

/// The volume of the box of the golden files, read from a text with changes, and what is said about it.
fn volume(name: &str, text: &str, beside: &str) -> Result<(f64, String), String> {
    let said = |list: &[loftsman::internals::exchange::TableProblem]| {
        list.iter().map(|p| format!("{p}\n")).collect::<String>()
    };
    match read_body(name, text.as_bytes(), Some(("box.toml", beside))).unwrap() {
        Ok(body) => {
            let sum = |corners: [[f64; 3]; 3]| {
                let [a, b, c] = corners;
                let normal = (b[2] - a[2]) * (c[0] - a[0]) - (b[0] - a[0]) * (c[2] - a[2]);
                normal * (a[1] + b[1] + c[1]) / 6.0
            };
            Ok((body.meshes[0].corners().map(sum).sum(), said(&body.notes)))
        }
        Err(list) => Err(said(&list)),
    }
}

#[test]
fn units_and_axes_of_cad_files() {
    let close = |found: Result<(f64, String), String>, wanted: f64| {
        let (found, said) = found.unwrap();
        assert!((found / wanted - 1.0).abs() < 1e-9, "{found} for {wanted}: {said}");
        said
    };
    let (iges, step) = (golden("box.igs"), golden("box.step"));
    close(volume("box.igs", &iges, ""), 20_000.0);
    close(volume("box.step", &step, ""), 20_000.0);
    // Inches by the flag, feet by the name of the unit, inches by a unit of their own.
    close(volume("a", &iges.replace("1.,6,1HM", "1.,1,1HM"), ""), 20_000.0 * 0.0254_f64.powi(3));
    let named = iges.replace("1.,6,1HM,1,0.,15H19700101.000000,", "1.,3,2HFT,,0.,15H19700101.000000,");
    close(volume("a", &named, ""), 20_000.0 * 0.3048_f64.powi(3));
    let inches = "#10=(CONVERSION_BASED_UNIT('INCH',#9001)LENGTH_UNIT()NAMED_UNIT(#9003));\n\
                  #9001=LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(25.4),#9002);\n\
                  #9002=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.));";
    let text = step.replace("#10=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT($,.METRE.));", inches);
    assert_ne!(text, step);
    close(volume("a", &text, ""), 20_000.0 * 0.0254_f64.powi(3));
    let milli = step.replace("SI_UNIT($,.METRE.)", "SI_UNIT(.MILLI.,.METRE.)");
    close(volume("a", &milli, "[table]\nscale = 10\n"), 2e-2);
    // What is stated stands over the file; axes turned and mirrored enclose the same.
    close(volume("a", &milli, "[table]\nunits = 'm'\n"), 20_000.0);
    let said = close(volume("a", &step, "[table]\naxes = '-x y z'\nx_origin = 100\n"), 20_000.0);
    assert!(!said.contains("W320"), "{said}");
    // Without faces the splines are whole, and what has no ends is left out.
    let loose = other_kind(&step).replace("ADVANCED_FACE", "NO_FACE");
    let said = close(volume("a", &loose, ""), 20_000.0);
    assert!(said.contains("W352") && said.contains("1 CYLINDRICAL_SURFACE of no face are not read"), "{said}");
    // A surface of no face is construction; a face without a surface that is read is missing.
    close(volume("a", &other_kind(&step), ""), 20_000.0);
    let missing = step.replace("DATA;\n", "DATA;\n#9002=ADVANCED_FACE('',(),#1,.T.);\n");
    let found = volume("a", &missing, "").unwrap_err();
    assert!(found.contains("E352") && found.contains("1 of 7 faces cannot be read"), "{found}");
}

/// The file with a cylinder that belongs to no face.
fn other_kind(step: &str) -> String {
    let other = step.replace("DATA;\n", "DATA;\n#9001=CYLINDRICAL_SURFACE('',#1,1.);\n");
    assert_ne!(other, step);
    other
}

#[test]
fn faults_of_cad_files_name_their_record() {
    let (iges, step) = (golden("box.igs"), golden("box.step"));
    let error = |name: &str, text: &str| volume(name, text, "").unwrap_err();
    let cut: String = iges.lines().filter(|line| !line.ends_with("P     60")).map(|line| format!("{line}\n")).collect();
    let found = error("box.igs", &cut);
    assert!(
        found.contains("E350") && found.contains("entity 128, D") && found.contains("parameters, expected"),
        "{found}"
    );
    assert!(error("a.igs", "nothing\n").contains("no B-spline surfaces (entity 128)"));
    // A net with a point that the file does not have.
    let without = step.replacen("3,3,((#", "3,3,((#99999,#", 1);
    assert_ne!(without, step);
    let found = error("box.step", &without);
    assert!(
        found.contains("row ") && found.contains("E352") && found.contains("its surface cannot be read"),
        "{found}"
    );
    let found = error("box.step", &step.replace("DATA;", "DATA;\n#5;\n"));
    assert!(found.contains("'#5'") && found.contains("not an instance"), "{found}");
    assert!(error("a.stp", "ISO-10303-21;\nDATA;\nENDSEC;\n").contains("no faces, and no B_SPLINE_SURFACE_WITH_KNOTS"));
}

#[test]
fn control_nets_float_as_their_hulls_and_come_back_as_they_are() {
    for name in ["box", "seed002-frigate", "fishing-vessel"] {
        let hull = config(name);
        let draughts = [0.4, 0.75, 1.0].map(|share| share * hull.reference_height());
        let exact = CurvesOfForm::new(&hull, &draughts, &Conventions::default()).rows;
        let folder = folder(&format!("nets-{name}"));
        let path = files(&folder, &hull, name, &[ExportFormat::Ftm]).remove(0);
        let body = read_hydrostatic_body(&path).unwrap();
        assert!((body.particulars.breadth - hull.particulars().breadth).abs() < 1e-12);
        for (a, b) in body.curves_of_form(&draughts, &Conventions::default()).unwrap().0.rows.iter().zip(&exact) {
            for (k, (x, y)) in main_quantities(a).into_iter().zip(main_quantities(b)).enumerate() {
                assert!((x / y - 1.0).abs() < 4e-3, "{name} at {}: quantity {k} is {x} for {y}", a.draught);
            }
        }
        let bytes = fs::read(&path).unwrap();
        let project = read_subdivision("a.ftm", &bytes).unwrap().unwrap();
        assert_eq!(write_ftm(&project).as_bytes(), bytes, "{name}");
    }
}

#[test]
fn files_are_converted_by_the_endings_of_their_names() {
    let folder = folder("converted");
    let hull = carried("configs/box.toml").display().to_string();
    let place = |name: &str| folder.join(name).display().to_string();
    let run = |arguments: &[&str]| {
        let told = program(arguments);
        assert_eq!(told.status.code(), Some(0), "{arguments:?}: {}", stderr(&told));
        told.stdout
    };
    run(&["convert", &hull, &place("box.ftm")]);
    run(&["convert", &place("box.ftm"), &place("again.ftm"), "-q"]);
    assert_eq!(fs::read(place("box.ftm")).unwrap(), fs::read(place("again.ftm")).unwrap());
    run(&["convert", &hull, &place("box.gf")]);
    run(&["convert", &place("box.gf"), &place("box.bri")]);
    let text = run(&["convert", &place("box.bri"), "--format", "pias"]);
    let back = read_table("a-pias.txt", &text).unwrap().table;
    let first = read_table("box.gf", &fs::read(place("box.gf")).unwrap()).unwrap().table;
    assert_eq!(back.stations.len(), first.stations.len());
    // A station of one point is no section.
    fs::write(place("raked.csv"), "x [m],0,1,2\n-1,,,1\n0,0,1,2\n5,1,2,2\n10,0,1,2\n").unwrap();
    for file in ["raked.gf", "raked.bri"] {
        run(&["convert", &place("raked.csv"), &place(file), "-q"]);
        assert_eq!(read_table(file, &fs::read(place(file)).unwrap()).unwrap().table.stations.len(), 3);
    }
    run(&["convert", &hull, &place("box.stl")]);
    run(&["convert", &place("box.stl"), &place("box.obj")]);
    run(&["convert", &hull, &place("box.csv"), "-q"]);
    run(&["convert", &place("box.csv"), &place("fitted.step"), "-q"]);
    // What is there is not written over, and a hull has its own units.
    assert_eq!(program(&["convert", &hull, &place("box.stl")]).status.code(), Some(6));
    let refused = program(&["convert", &hull, &place("new.stl"), "--input-unit", "mm"]);
    assert_eq!(refused.status.code(), Some(2));
    assert!(stderr(&refused).contains("leave out its conventions: units"));
    // Units and axes of a body on the command line stand over the file.
    let volume = |flags: &[&str]| {
        let told = run(&[&["hydro", &place("box.obj"), "--draughts", "1", "--csv"], flags].concat());
        String::from_utf8(told).unwrap().lines().last().unwrap().to_owned()
    };
    let body = read_text(place("box.obj"));
    let turned: String = body
        .lines()
        .map(|line| match line.strip_prefix("v ") {
            Some(point) => {
                let p: Vec<f64> = point.split(' ').map(|word| 1000.0 * word.parse::<f64>().unwrap()).collect();
                format!("v {} {} {}\n", p[0], p[2], -p[1])
            }
            None => format!("{line}\n"),
        })
        .collect();
    let upright = volume(&[]);
    fs::write(place("box.obj"), turned).unwrap();
    let (a, b) = (upright, volume(&["--input-unit", "mm", "--up", "y"]));
    let numbers = |row: &str| row.split(',').filter_map(|cell| cell.parse::<f64>().ok()).collect::<Vec<_>>();
    for (x, y) in numbers(&a).into_iter().zip(numbers(&b)) {
        assert!((x - y).abs() <= 1e-9 * x.abs().max(1.0), "{a}\n{b}");
    }
    let wrong = program(&["hydro", &place("box.obj"), "--draughts", "1", "--up", "w"]);
    assert_eq!(wrong.status.code(), Some(2));
    assert!(stderr(&wrong).contains("E311 command line"), "{}", stderr(&wrong));
    let negative = program(&["export", &hull, "-f", "gdf", "--draught", "-1"]);
    assert!(stderr(&negative).contains("must be more than 0"));
}
