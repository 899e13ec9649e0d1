//! Bodies of other programs and of other habits: units, versions, axes, halves, and skins that no hull has. Volumes are those
//! of boxes and of outside readers.

use std::fs;
use std::path::PathBuf;

use loftsman::internals::hydrostatics::{Conventions, Hydrostatics};
use loftsman::internals::report::{Failure, read_hydrostatic_body};

use crate::support::{carried, folder, program, stderr};

fn case(name: &str) -> PathBuf {
    carried("tests/body_cases").join(name)
}

fn row(name: &str, draught: f64) -> Result<Hydrostatics, Failure> {
    let body = read_hydrostatic_body(&case(name))?;
    Ok(body.curves_of_form(&[draught], &Conventions::default())?.0.rows.remove(0))
}

#[test]
fn bodies_of_other_programs_displace_what_they_should() {
    // File, draught [m], volume [m3].
    let cases = [
        ("box-4.3.ftm", 1.0, 80.0),
        ("capitals.stl", 3.0, 1800.0),
        ("box.mar", -1.0, 320.0),
        ("box.dat", -1.0, 320.0),
        ("barge-inch.step", 2.0, 240.0),
        ("barge-ft.step", 2.0, 240.0),
        ("off-0.1.stl", 3.0, 1350.0),
        ("wide.gdf", -2.0, 97.2),
        ("half-flap.gdf", -2.0, 239.76),
        ("half-y-from-0.stl", 3.0, 1350.0),
        ("half-y-from-0.03.stl", 3.0, 1350.0),
        ("half-1cm.stl", 10.8, 51_855.0),
        ("whole-y0-to-4.gdf", -1.0, 40.0),
    ];
    for (name, draught, volume) in cases {
        let found = row(name, draught).unwrap_or_else(|error| panic!("{name}: {error}")).displacement_volume;
        assert!((found - volume).abs() <= 1e-3 * volume, "{name}: {found}, expected {volume}");
    }
}

#[test]
fn a_waterplane_turns_about_its_own_axis() {
    // 40 m by 2 m about y = 5 m, and not about y = 0; a flap by its breadth of 12 m.
    let beside = row("box-y-4-to-6.gdf", -0.5).unwrap();
    let inertia = beside.waterplane_area.powi(3) / 40.0f64.powi(2) / 12.0;
    assert!((beside.transverse_inertia - inertia).abs() < 1e-9 * inertia, "{}", beside.transverse_inertia);
    let said = |row: &Hydrostatics| row.remark.clone().unwrap_or_default();
    assert!(said(&beside).contains("YCB 1.000 m, to port of the centreplane"), "{}", said(&beside));
    assert_eq!((beside.transverse_centre.map(|y| (1e6 * y).round()), beside.heel), (Some(1e6), None));
    // With KG known it heels by atan(YCB / GM).
    let body = read_hydrostatic_body(&carried("tests/body_cases/box-y-4-to-6.gdf")).unwrap();
    let known = Conventions { centre_of_gravity_height: Some(-9.0), ..Conventions::default() };
    let heeled = body.curves_of_form(&[-0.5], &known).unwrap().0.rows.remove(0);
    let expected = (1.0 / heeled.gm_transverse.unwrap()).atan().to_degrees();
    assert!((heeled.heel.unwrap() - expected).abs() < 1e-9 && said(&heeled).contains("heels it by"));
    let wide = row("wide.gdf", -2.0).unwrap().transverse_inertia;
    assert!((wide - 874.8).abs() < 1e-9 * 874.8, "{wide}");
}

#[test]
fn a_row_of_vertices_at_the_waterline_may_have_errors_of_rounding() {
    let area = row("noise-2e-6.gdf", 0.0).unwrap().waterplane_area;
    assert!((area - 40.0).abs() < 1e-4, "{area}");
}

#[test]
fn triangles_given_twice_count_once() {
    let twice = row("twice.stl", 3.0).unwrap();
    assert!((twice.displacement_volume - 1800.0).abs() < 1e-9 * 1800.0, "{}", twice.displacement_volume);
    let output = program(&["hydro", &case("twice.stl").display().to_string(), "--draughts", "3"]);
    assert!(stderr(&output).contains("given twice: counted once"), "{}", stderr(&output));
}

/// Triangles of boxes [least, greatest] as text of an STL file; `without` one side: 0 to 2 for the axis, and whether the greater.
fn boxes(list: &[[[f64; 3]; 2]], without: Option<(usize, bool)>) -> String {
    let mut text = String::from("solid boxes\n");
    for [low, high] in list {
        let corner = |bits: usize| [0, 1, 2].map(|k| if bits >> k & 1 == 1 { high[k] } else { low[k] });
        for axis in 0..3 {
            for greater in [false, true] {
                if without == Some((axis, greater)) {
                    continue;
                }
                let base = usize::from(greater) << axis;
                let (p, q) = (1 << ((axis + 1) % 3), 1 << ((axis + 2) % 3));
                let mut around = [base, base + p, base + p + q, base + q].map(corner);
                if !greater {
                    around.reverse();
                }
                for triangle in [[0, 1, 2], [0, 2, 3]] {
                    text.push_str("facet normal 0 0 0\nouter loop\n");
                    for k in triangle {
                        let [x, y, z] = around[k];
                        text.push_str(&format!("vertex {x} {y} {z}\n"));
                    }
                    text.push_str("endloop\nendfacet\n");
                }
            }
        }
    }
    text + "endsolid\n"
}

fn volume_of(name: &str, text: &str, draught: f64) -> Result<f64, Failure> {
    let path = folder("body-skins").join(name);
    fs::create_dir_all(path.parent().unwrap()).unwrap();
    fs::write(&path, text).unwrap();
    let body = read_hydrostatic_body(&path)?;
    Ok(body.curves_of_form(&[draught], &Conventions::default())?.0.rows.remove(0).displacement_volume)
}

/// Two boxes in one place, of which a tube from the deck of one to the bottom of the other makes one skin.
#[test]
fn skins_that_no_hull_has_are_refused() {
    let corner = |k: usize, by: f64| -> [f64; 3] {
        let [x, y, z] = [0, 1, 2].map(|axis| (k >> axis & 1) as f64);
        [60.0 * x, 10.0 * y - 5.0, 6.0 * z + by]
    };
    let faces = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
    let mut triangles: Vec<[[f64; 3]; 3]> = Vec::new();
    for by in [0.0, 0.01] {
        for [a, b, c, d] in faces {
            for triangle in [[a, b, c], [a, c, d]] {
                let hole = if by > 0.0 { [0, 3, 1] } else { [4, 5, 7] };
                if triangle != hole {
                    triangles.push(triangle.map(|k| corner(k, by)));
                }
            }
        }
    }
    for [p, q] in [[4, 5], [5, 7], [7, 4]] {
        let (low, high) = ([corner(p - 4, 0.01), corner(q - 4, 0.01)], [corner(p, 0.0), corner(q, 0.0)]);
        triangles.push([high[0], high[1], low[1]]);
        triangles.push([high[0], low[1], low[0]]);
    }
    let mut text = String::from("solid twice\n");
    for triangle in triangles {
        let corners = triangle.map(|[x, y, z]| format!("vertex {x} {y} {z}\n")).concat();
        text.push_str(&format!("facet normal 0 0 0\nouter loop\n{corners}endloop\nendfacet\n"));
    }
    let error = volume_of("one-skin.stl", &(text + "endsolid\n"), 3.0).unwrap_err().to_string();
    assert!(error.contains("E353") && error.contains("displacement volume"), "{error}");
}

#[test]
fn a_side_that_is_missing_is_refused_and_shells_are_united() {
    let hull = [[0.0, -5.0, 0.0], [60.0, 5.0, 6.0]];
    let refused = volume_of("side.stl", &boxes(&[hull], Some((1, true))), 3.0).unwrap_err().to_string();
    assert!(refused.contains("E354") && refused.contains("a hole of"), "{refused}");
    let open = volume_of("deck.stl", &boxes(&[hull], Some((2, true))), 3.0).unwrap();
    assert!((open - 1800.0).abs() < 1e-6, "{open}");
    // Two halves that overlap, a bridge between two hulls, a tank on the bottom.
    for (name, list, draught, expected) in [
        ("halves.stl", vec![[[0.0, -5.0, 0.0], [60.0, 0.5, 6.0]], [[0.0, -0.5, 0.0], [60.0, 5.0, 6.0]]], 3.0, 1800.0),
        (
            "bridge.stl",
            vec![
                [[0.0, -8.0, 0.0], [60.0, -4.0, 6.0]],
                [[0.0, 4.0, 0.0], [60.0, 8.0, 6.0]],
                [[10.0, -6.0, 4.0], [50.0, 6.0, 6.0]],
            ],
            5.0,
            2.0 * 60.0 * 4.0 * 5.0 + 40.0 * 8.0,
        ),
        ("tank.stl", vec![hull, [[10.0, -2.0, 0.0], [30.0, 2.0, 2.0]]], 3.0, 1800.0),
    ] {
        let found = volume_of(name, &boxes(&list, None), draught).unwrap_or_else(|error| panic!("{name}: {error}"));
        assert!((found - expected).abs() < 1e-3 * expected, "{name}: {found} for {expected}");
    }
    // Off the centreplane, and a column, z is up.
    for (name, list) in
        [("off.stl", [[0.0, -4.3, 0.0], [60.0, 5.7, 6.0]]), ("column.stl", [[0.0, -2.0, 0.0], [4.0, 2.0, 40.0]])]
    {
        let [low, high] = list;
        let found = volume_of(name, &boxes(&[list], None), 3.0).unwrap();
        let expected = (high[0] - low[0]) * (high[1] - low[1]) * 3.0;
        assert!((found - expected).abs() < 1e-6 * expected, "{name}: {found} for {expected}");
    }
    let feet = fs::read_to_string(case("box-y-4-to-6.gdf")).unwrap();
    let (metres, feet) = (volume_of("a.gdf", &feet, -0.5).unwrap(), {
        let lines: Vec<String> = feet
            .lines()
            .enumerate()
            .map(
                |(k, line)| {
                    if k == 1 { line.replace("9.80665", "32.174").replace("9.81", "32.174") } else { line.to_owned() }
                },
            )
            .collect();
        volume_of("b.gdf", &lines.join("\n"), -0.5 * 0.3048).unwrap()
    });
    assert!((feet / metres - 0.3048f64.powi(3)).abs() < 1e-9, "{feet} {metres}");
}

#[test]
fn shells_inside_add_nothing() {
    for (name, what) in [
        ("bulkheads.stl", "4 triangles of open sheets left out"),
        ("tank-inside.stl", "12 triangles of shells inside the others left out"),
    ] {
        assert!((row(name, 3.0).unwrap().displacement_volume / 1800.0 - 1.0).abs() < 1e-9, "{name}");
        let output = program(&["hydro", &case(name).display().to_string(), "--draughts", "3"]);
        assert!(output.status.success() && stderr(&output).contains(what), "{name}: {}", stderr(&output));
    }
}

/// A box with a keel of 15 x 1 x 4 m whose upper half is inside.
#[test]
fn shells_that_reach_into_others_are_named() {
    let output = program(&["hydro", &case("skeg-overlaps.stl").display().to_string(), "--draughts", "3"]);
    assert!(stderr(&output).contains("shells of 12 triangles reach into others"), "{}", stderr(&output));
}

/// Files of OpenCASCADE: faces on planes, cylinders, spheres and splines, trimmed and not, and splines over periodic knots.
/// The volumes are those of OpenCASCADE, or closed forms.
#[test]
fn faces_of_cad_files_displace_what_is_inside_them() {
    let cases = [
        ("pontoon.igs", 2.0, 1440.0),
        ("barge_mm.step", 2.0, 600.720_116_836),
        ("cyl-nurbs.step", 6.0, 1080.0 * std::f64::consts::PI),
        ("moonpool.step", 2.0, 640.0 - 4.5 * std::f64::consts::PI),
        ("moonpool.igs", 2.0, 640.0 - 4.5 * std::f64::consts::PI),
        ("bulb.step", 2.5, 461.453_723_217),
        ("bulb.igs", 2.5, 461.453_723_217),
        ("ball270.igs", -0.5, 222.660_379_315),
        ("round-ends.step", 0.7, 544.610_639_133),
        ("sphere.igs", 0.0, 250.0 / 3.0 * std::f64::consts::PI),
        // One rational spline that no face refers to.
        ("ball-loose.igs", 0.0, 250.0 / 3.0 * std::f64::consts::PI),
        ("cone.step", 0.5, 184.989_941_823),
        ("thruster.step", 2.5, 272.052_729),
    ];
    for (name, draught, volume) in cases {
        let found = row(name, draught).unwrap_or_else(|error| panic!("{name}: {error}")).displacement_volume;
        assert!((found - volume).abs() <= 1e-6 * volume, "{name}: {found}, expected {volume}");
    }
    let notes = read_hydrostatic_body(&case("moonpool.step")).unwrap().notes;
    assert!(!notes.iter().any(|note| note.starts_with('W')), "{notes:?}");
}

#[track_caller]
fn displaces(name: &str, draught: f64, volume: f64) {
    let found = row(name, draught).unwrap_or_else(|error| panic!("{name}: {error}")).displacement_volume;
    assert!((found - volume).abs() <= 2e-5 * volume, "{name}: {found}, expected {volume}");
}

/// A ball on a box, with a vertex beside the hole of its loop, and one whose loop passes both poles, as other readers measure it.
#[test]
fn balls_have_loops_that_are_points_or_holes() {
    displaces("bulb-vertex.step", 4.0, 2400.0 + 9.0 * std::f64::consts::PI);
    displaces("bulb-aft.igs", 3.0, 1_819.104_484);
}

#[test]
fn a_ring_may_have_no_edges() {
    displaces("ring-vertex.step", 10.0, 32.0 * std::f64::consts::PI.powi(2));
}

/// A ball of one rational spline whose knots do not end its ends, bounded by a vertex alone.
#[test]
fn a_ball_may_have_no_edges() {
    displaces("sphere-spline-vertex.step", 5.0, 500.0 / 3.0 * std::f64::consts::PI);
}

/// A round pontoon, open at both ends of 48 sides, lying or upright: a lying one ends in a transom and a flat bow, an upright one
/// has no bottom.
#[test]
fn tubes_without_caps_are_closed_at_their_ends_or_refused() {
    let facets = |place: fn(f64, f64, f64) -> [f64; 3]| -> String {
        let ring = |k: u32, x: f64| {
            let (sine, cosine) = (std::f64::consts::TAU * f64::from(k % 48) / 48.0).sin_cos();
            place(x, 2.0 * cosine, 2.0 + 2.0 * sine)
        };
        let vertex = |p: [f64; 3]| format!("vertex {} {} {}\n", p[0], p[1], p[2]);
        let facet =
            |t: [[f64; 3]; 3]| format!("facet normal 0 0 0\nouter loop\n{}endloop\nendfacet\n", t.map(vertex).concat());
        let both = |k: u32| {
            let [a, b, c, d] = [ring(k, 0.0), ring(k, 40.0), ring(k + 1, 40.0), ring(k + 1, 0.0)];
            facet([a, b, c]) + &facet([a, c, d])
        };
        format!("solid\n{}endsolid\n", (0..48).map(both).collect::<String>())
    };
    let lying = facets(|x, y, z| [x, y, z]);
    // 48 sectors of an inscribed polygon; 16 of them are above 3 m, less the triangle between their ends.
    let sector = 0.5 * 4.0 * (std::f64::consts::TAU / 48.0).sin();
    let expected = 40.0 * (32.0 * sector + 0.5 * 4.0 * (std::f64::consts::TAU / 3.0).sin());
    let found = volume_of("lying.stl", &lying, 3.0).unwrap();
    assert!((found - expected).abs() < 1e-4 * expected, "{found}, expected {expected}");
    let path = folder("body-tubes").join("lying.stl");
    fs::create_dir_all(path.parent().unwrap()).unwrap();
    fs::write(&path, &lying).unwrap();
    let notes = stderr(&program(&["hydro", &path.display().to_string(), "--draughts", "3"]));
    assert!(notes.contains("W351") && notes.contains("96 edges open, the lowest at z = 0.000 m"), "{notes}");
    let upright = facets(|x, y, z| [y, z, x]);
    let refused = volume_of("upright.stl", &upright, 3.0).unwrap_err().to_string();
    assert!(refused.contains("E354") && refused.contains("a side or the bottom is missing"), "{refused}");
}

/// A quarter of a sphere, or the three others: without the curves among its parameters the file does not say which.
#[test]
fn faces_that_cannot_be_read_are_counted_by_their_kinds() {
    let text = fs::read_to_string(case("bulb.igs")).unwrap();
    let without = text.replace("142,0,125,137,143,3;", "142,0,125,0,143,3;  ");
    assert_ne!(without, text);
    let folder = folder("body-either-side");
    let path = folder.join("bulb.igs");
    fs::write(&path, without).unwrap();
    let output = program(&["hydro", &path.display().to_string(), "--draughts", "2"]);
    let said = stderr(&output);
    assert!(output.status.code() == Some(3) && said.contains("E352"), "{said}");
    assert!(said.contains("1 of 9 faces cannot be read (1 of entity 120)") && said.contains("meets a pole"), "{said}");
    fs::remove_dir_all(folder).unwrap();
}

#[test]
fn warnings_stand_in_the_document() {
    let output = program(&["hydro", &case("cyl-nurbs.step").display().to_string(), "--draughts", "6", "--json"]);
    let document: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(document["warnings"], serde_json::json!([]), "{document}");
    let output = program(&["hydro", &case("sphere.igs").display().to_string(), "--draughts=0", "--json"]);
    let document: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let warnings = document["warnings"].as_array().unwrap();
    assert!(warnings.iter().any(|text| text.as_str().unwrap().starts_with("W320")), "{warnings:?}");
}

#[test]
fn coefficients_above_one_are_told() {
    let folder = folder("body-above-one");
    let path = folder.join("box.stl");
    fs::copy(case("capitals.stl"), &path).unwrap();
    fs::write(path.with_extension("toml"), "[table]\nLpp = 30\nB = 10\nT = 3\n").unwrap();
    let (table, warnings) =
        read_hydrostatic_body(&path).unwrap().curves_of_form(&[3.0], &Conventions::default()).unwrap();
    assert!((table.rows[0].block_coefficient.unwrap() - 2.0).abs() < 1e-9);
    assert!(warnings[0].contains("W353") && warnings[0].contains("CB 2.000"), "{warnings:?}");
    fs::remove_dir_all(folder).unwrap();
}

/// A prism between ends that slope in: its largest section is the rectangle, and no parabola over the corner.
#[test]
fn the_largest_section_of_a_prism_is_its_own() {
    let found = row("half-y-from-0.stl", 3.0).unwrap();
    assert!((found.maximum_section_area - 30.0).abs() < 1e-9, "{}", found.maximum_section_area);
}

#[test]
fn a_wall_on_the_centreplane_asks_whether_the_body_is_whole() {
    let half = |part: &[&str]| {
        let path = case("half-wall.stl").display().to_string();
        program(&[&["hydro", &path, "--draughts", "2", "--csv"], part].concat())
    };
    assert!(stderr(&half(&[])).contains("--body half or --body whole"), "{}", stderr(&half(&[])));
    for (part, volume) in [("half", "480"), ("whole", "240")] {
        let found = half(&["--body", part]);
        let text = String::from_utf8_lossy(&found.stdout).into_owned();
        let values: Vec<&str> = text.lines().last().unwrap().split(',').collect();
        assert!(values.contains(&volume), "{part}: {text}");
    }
}
