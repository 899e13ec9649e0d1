//! Skins of several shells: what they enclose together is that of closed forms.

use std::fs;

use loftsman::internals::hydrostatics::{Conventions, Hydrostatics};
use loftsman::internals::report::{Failure, read_hydrostatic_body};

use crate::support::{folder, program, stderr};

type Point = [f64; 3];
type Triangle = [Point; 3];

/// A quadrilateral whose edges are divided.
fn plate([a, b, c, d]: [Point; 4], [m, n]: [u32; 2]) -> Vec<Triangle> {
    let at = |i: u32, j: u32| -> Point {
        let (s, t) = (f64::from(i) / f64::from(m), f64::from(j) / f64::from(n));
        [0, 1, 2].map(|k| (1.0 - t) * ((1.0 - s) * a[k] + s * b[k]) + t * ((1.0 - s) * d[k] + s * c[k]))
    };
    let cell = |i: u32, j: u32| {
        let [p, q, r, s] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
        [[p, q, r], [p, r, s]]
    };
    (0..m).flat_map(|i| (0..n).flat_map(move |j| cell(i, j))).collect()
}

/// The sides of a box, outward: those at the least and the greatest x, y and z; each divided by itself.
fn sides([low, high]: [Point; 2], counts: [[u32; 2]; 6]) -> [Vec<Triangle>; 6] {
    std::array::from_fn(|side| {
        let (axis, is_high) = (side / 2, side % 2 == 1);
        let corner = |p: bool, q: bool| {
            let mut point = low;
            point[axis] = if is_high { high[axis] } else { low[axis] };
            let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
            point[u] = if p { high[u] } else { low[u] };
            point[v] = if q { high[v] } else { low[v] };
            point
        };
        let around = [corner(false, false), corner(true, false), corner(true, true), corner(false, true)];
        let [a, b, c, d] = around;
        plate(if is_high { around } else { [a, d, c, b] }, counts[side])
    })
}

fn block(low: Point, high: Point) -> Vec<Triangle> {
    sides([low, high], [[1, 1]; 6]).concat()
}

fn written(name: &str, triangles: &[Triangle]) -> std::path::PathBuf {
    let path = folder(&format!("body-skins-{name}")).join(format!("{name}.stl"));
    fs::create_dir_all(path.parent().unwrap()).unwrap();
    let facet = |corners: &Triangle| {
        let corners = corners.map(|[x, y, z]| format!("vertex {x:.17} {y:.17} {z:.17}\n")).concat();
        format!("facet normal 0 0 0\nouter loop\n{corners}endloop\nendfacet\n")
    };
    let facets: String = triangles.iter().map(facet).collect();
    fs::write(&path, format!("solid {name}\n{facets}endsolid\n")).unwrap();
    path
}

fn row(name: &str, triangles: &[Triangle], draught: f64) -> Result<Hydrostatics, Failure> {
    let body = read_hydrostatic_body(&written(name, triangles))?;
    Ok(body.curves_of_form(&[draught], &Conventions::default())?.0.rows.remove(0))
}

#[track_caller]
fn displaces(name: &str, triangles: &[Triangle], draught: f64, wanted: [f64; 2]) {
    let row = row(name, triangles, draught).unwrap_or_else(|error| panic!("{name}: {error}"));
    let found = [row.displacement_volume, row.waterplane_area];
    for (found, wanted) in found.into_iter().zip(wanted) {
        assert!((found - wanted).abs() < 1e-6 * wanted, "{name}: {found} for {wanted}");
    }
}

const HULL: [Point; 2] = [[0.0, -5.0, 0.0], [60.0, 5.0, 6.0]];

/// Boxes that pass through each other, or end flush, with what they displace at 3 m and their waterplane.
#[test]
fn parts_that_pass_through_others_or_end_flush_count_once() {
    let hull = || block(HULL[0], HULL[1]);
    let pontoon = || block([0.0, -5.0, 0.0], [60.0, 5.0, 1.0]);
    let with = |mut parts: Vec<Triangle>, low: Point, high: Point| {
        parts.extend(block(low, high));
        parts
    };
    let cases = [
        ("flush-column", with(pontoon(), [5.0, -1.0, 0.0], [55.0, 1.0, 6.0]), [800.0, 100.0]),
        ("column-through", with(pontoon(), [5.0, -1.0, -8.0], [55.0, 1.0, 10.0]), [600.0 + 1100.0 - 100.0, 100.0]),
        ("column-on-top", with(pontoon(), [5.0, -1.0, 1.0], [55.0, 1.0, 6.0]), [800.0, 100.0]),
        ("fin-through", with(hull(), [20.0, -9.0, 1.0], [24.0, 9.0, 1.3]), [1809.6, 600.0]),
        ("keel-into", with(hull(), [20.0, -0.5, -1.0], [40.0, 0.5, 0.05]), [1820.0, 600.0]),
        ("wing-tank", with(hull(), [0.0, 4.0, 0.0], [60.0, 5.0, 6.0]), [1800.0, 600.0]),
        ("short-wing-tank", with(hull(), [20.0, 4.0, 0.0], [40.0, 5.0, 6.0]), [1800.0, 600.0]),
        (
            "two-wing-tanks",
            with(with(hull(), [0.0, 4.0, 0.0], [60.0, 5.0, 6.0]), [0.0, -5.0, 0.0], [60.0, -4.0, 6.0]),
            [1800.0, 600.0],
        ),
        ("block-ahead", with(hull(), [60.0, -5.0, 0.0], [70.0, 5.0, 6.0]), [2100.0, 700.0]),
    ];
    for (name, triangles, wanted) in cases {
        displaces(name, &triangles, 3.0, wanted);
    }
    let tank = written("named", &with(hull(), [20.0, -9.0, 1.0], [24.0, 9.0, 1.3]));
    let output = program(&["hydro", &tank.display().to_string(), "--draughts", "3"]);
    assert!(stderr(&output).contains("shells of 12 triangles reach into others"), "{}", stderr(&output));
}

/// Sides, bottom and ends of a box without a deck, each divided by itself, and a moonpool of such walls.
#[test]
fn plates_that_are_meshed_on_their_own_are_skin() {
    let counts = [[2, 3], [1, 1], [4, 3], [2, 7], [5, 2], [3, 3]];
    let plates = sides(HULL, counts);
    let open = plates[..5].concat();
    displaces("plates", &open, 3.0, [1800.0, 600.0]);
    displaces("plates-and-deck", &plates.concat(), 3.0, [1800.0, 600.0]);
    // A bulkhead and a flat keel are none.
    let bulkhead = plate([[30.0, -5.0, 0.0], [30.0, 5.0, 0.0], [30.0, 5.0, 6.0], [30.0, -5.0, 6.0]], [3, 2]);
    displaces("plates-and-bulkhead", &[open.clone(), bulkhead].concat(), 3.0, [1800.0, 600.0]);
    // Two hulls whose inner sides face each other.
    let hulls = [[3.0, 7.0], [-7.0, -3.0]]
        .map(|[low, high]| sides([[0.0, low, 0.0], [60.0, high, 6.0]], counts)[..5].concat())
        .concat();
    displaces("two-hulls-of-plates", &hulls, 3.0, [1440.0, 480.0]);
    // Corners that differ by errors of rounding.
    let mut place = 0_u32;
    let off = open.iter().map(|t| {
        t.map(|point| {
            point.map(|c| {
                place = place.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
                c + f64::from(place >> 16) / 65536.0 * 1e-9
            })
        })
    });
    let off: Vec<Triangle> = off.collect();
    let row = row("plates-off", &off, 3.0).unwrap();
    assert!((row.displacement_volume - 1800.0).abs() < 1e-3, "{}", row.displacement_volume);
}

/// Half a box that is open on the centreplane, with a whole keel below it.
#[test]
fn parts_on_both_sides_are_not_mirrored() {
    let [aft, fore, _, port, bottom, deck] = sides([[0.0, 0.0, 0.0], [60.0, 5.0, 6.0]], [[1, 1]; 6]);
    let mut triangles = [aft, fore, port, bottom, deck].concat();
    triangles.extend(block([20.0, -0.3, -2.0], [30.0, 0.3, 0.0]));
    displaces("half-and-keel", &triangles, 3.0, [1812.0, 600.0]);
    let path = written("half-stated", &triangles);
    fs::write(path.with_extension("toml"), "[table]\nbody = 'half'\n").unwrap();
    let body = read_hydrostatic_body(&path).unwrap();
    let row = body.curves_of_form(&[3.0], &Conventions::default()).unwrap().0.rows.remove(0);
    assert!((row.displacement_volume - 1812.0).abs() < 1e-6, "{}", row.displacement_volume);
    let output = program(&["hydro", &path.display().to_string(), "--draughts", "3"]);
    assert!(stderr(&output).contains("12 triangles of parts on both sides of y = 0"), "{}", stderr(&output));
}

#[test]
fn a_body_that_begins_near_the_centreplane_is_named() {
    for inner in [0.15, 0.3, 0.45, -0.2] {
        let path = written(&format!("near-{inner}"), &block([0.0, inner, 0.0], [60.0, 5.0, 6.0]));
        let output = program(&["hydro", &path.display().to_string(), "--draughts", "3"]);
        let text = stderr(&output);
        assert!(text.contains("W320") && text.contains("it is taken as whole"), "{inner}: {text}");
    }
}

/// Two prisms of 300 m2 on each other, the upper one a rounding error of 32 bits off.
#[test]
fn a_seam_of_rounding_errors_at_the_draught_counts_once() {
    for off in [2.4e-7, -2.4e-7] {
        let low = sides([[0.0, -5.0, 0.0], [60.0, 5.0, 3.0]], [[1, 1], [1, 1], [2, 1], [2, 1], [1, 1], [1, 1]]);
        let high = sides([[0.0, -5.0, 3.0 + off], [60.0, 5.0, 6.0]], [[1, 1], [1, 1], [3, 1], [3, 1], [1, 1], [1, 1]]);
        let triangles = [&low[..5].concat()[..], &high[..4].concat(), &high[5]].concat();
        let row = row(&format!("seam-{off}"), &triangles, 3.0).unwrap();
        let found = (row.displacement_volume, row.waterplane_area);
        assert!((found.0 - 1800.0).abs() < 1e-3 && (found.1 - 600.0).abs() < 1e-2, "{off}: {found:?}");
    }
}

/// Files of the same box as programs write them.
#[test]
fn names_marks_and_fields_of_files_are_passed_over() {
    let triangles = block(HULL[0], HULL[1]);
    let text = fs::read_to_string(written("plain", &triangles)).unwrap();
    let mut binary = vec![b' '; 80];
    binary.extend(12_u32.to_le_bytes());
    for corners in &triangles {
        binary.extend([0; 12]);
        corners.iter().flatten().for_each(|c| binary.extend((*c as f32).to_le_bytes()));
        binary.extend([0, 0]);
    }
    let without_count = [&binary[..80], &[0; 4], &binary[84..]].concat();
    let grid: String = triangles.iter().flatten().map(|[x, y, z]| format!("{x} {y} {z}\n")).collect();
    let faces: String = (0..12).map(|k| format!("3 {} {} {}\n", 3 * k, 3 * k + 1, 3 * k + 2)).collect();
    let vtk = format!(
        "# vtk DataFile Version 3.0\nx\nASCII\nDATASET POLYDATA\nFIELD FieldData 2\nTIME 1 1 double\n0\n\nCYCLE 1 2 int\n1 2\n\
         POINTS 36 float\n{grid}POLYGONS 12 48\n{faces}"
    );
    let files: [(&str, Vec<u8>); 6] = [
        ("umlaut.stl", text.replacen("solid plain", "solid F\u{e4}hre", 1).into_bytes()),
        ("mark.stl", format!("\u{feff}{text}").into_bytes()),
        ("latin.stl", [b"solid F\xe4hre\n", text.split_once('\n').unwrap().1.as_bytes()].concat()),
        ("longer.stl", [&binary[..], b"made by a program"].concat()),
        ("uncounted.stl", without_count),
        ("field.vtk", vtk.into_bytes()),
    ];
    for (name, bytes) in files {
        let path = folder(&format!("body-skins-{name}")).join(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(&path, bytes).unwrap();
        let body = read_hydrostatic_body(&path).unwrap_or_else(|error| panic!("{name}: {error}"));
        let volume = body.curves_of_form(&[3.0], &Conventions::default()).unwrap().0.rows[0].displacement_volume;
        assert!((volume - 1800.0).abs() < 1e-9 * 1800.0, "{name}: {volume}");
    }
}

/// A box with round holes in bottom and deck, of 16 sides, and between them a wall of 64 sides that is meshed on its own.
#[test]
fn a_moonpool_of_its_own_mesh_is_no_tank() {
    let place = |k: u32, n: u32, z: f64| -> Point {
        let angle = std::f64::consts::TAU * (f64::from(k % n) / f64::from(n) + 0.125);
        [30.0 + 2.0 * angle.cos(), 2.0 * angle.sin(), z]
    };
    let [aft, fore, starboard, port, ..] = sides(HULL, [[1, 1]; 6]);
    let mut triangles = [aft, fore, starboard, port].concat();
    let corners = [[60.0, 5.0], [0.0, 5.0], [0.0, -5.0], [60.0, -5.0]];
    for (z, is_deck) in [(0.0, false), (6.0, true)] {
        let corner = |k: u32| {
            let [x, y] = corners[(k % 4) as usize];
            [x, y, z]
        };
        let turned = |[a, b, c]: Triangle| if is_deck { [a, b, c] } else { [a, c, b] };
        for k in 0..16 {
            // Each quarter of the hole begins between two corners.
            let own = corner((k + 2) / 4);
            triangles.push(turned([own, place(k + 1, 16, z), place(k, 16, z)]));
        }
        for k in 0..4 {
            triangles.push(turned([corner(k), corner(k + 1), place(4 * k + 2, 16, z)]));
        }
    }
    for k in 0..64 {
        let [a, b] = [k, k + 1].map(|k| place(k, 64, 0.0));
        let [c, d] = [k + 1, k].map(|k| place(k, 64, 6.0));
        triangles.extend([[a, b, c], [a, c, d]]);
    }
    let pool = 0.5 * 64.0 * 4.0 * (std::f64::consts::TAU / 64.0).sin();
    displaces("moonpool", &triangles, 3.0, [1800.0 - 3.0 * pool, 600.0 - pool]);
}

/// Triangles of two bodies with a common wall, in turn: the wall belongs to each.
#[test]
fn a_wall_of_two_bodies_is_of_each() {
    let (aft, fore) = (block([0.0, -5.0, 0.0], [30.0, 5.0, 6.0]), block([30.0, -5.0, 0.0], [60.0, 5.0, 6.0]));
    let turns: Vec<Triangle> = aft.iter().zip(&fore).flat_map(|(a, b)| [*a, *b]).collect();
    displaces("turns", &turns, 3.0, [1800.0, 600.0]);
    // A whole body given twice is one.
    let hull = block(HULL[0], HULL[1]);
    displaces("twice", &[hull.clone(), hull].concat(), 3.0, [1800.0, 600.0]);
}

/// A block on one side of a whole hull, of her length and half breadth, leaves her whole.
#[test]
fn a_block_beside_the_centreplane_leaves_a_hull_whole() {
    let house = block([0.0, 0.0, 6.0], [60.0, 5.0, 8.0]);
    displaces("house", &[block(HULL[0], HULL[1]), house].concat(), 3.0, [1800.0, 600.0]);
}

/// Without deck and transom, the transom raked by 4 m; with slits and holes in the sides; above the rim of a deck that is missing.
#[test]
fn a_skin_whose_integrals_disagree_is_named_or_refused() {
    let said = |name: &str, triangles: &[Triangle], draughts: &str| {
        let output = program(&["hydro", &written(name, triangles).display().to_string(), "--draughts", draughts]);
        (output.status.code(), stderr(&output))
    };
    let raked = |p: Point| -> Point { [if p[0] > 0.0 { p[0] } else { 4.0 * (1.0 - p[2] / 6.0) }, p[1], p[2]] };
    let [_, bow, starboard, port, bottom, _] =
        sides(HULL, [[6, 6]; 6]).map(|side| side.into_iter().map(|t| t.map(raked)));
    let open: Vec<Triangle> = bow.chain(starboard).chain(port).chain(bottom).collect();
    displaces("raked", &open, 3.0, [1710.0, 580.0]);
    let (code, message) = said("raked", &open, "1,2,3,5");
    assert!(code == Some(0) && message.contains("W351") && !message.contains("W355"), "{message}");
    // One cell of 60 of a side; a column of them on both sides.
    let whole = sides(HULL, [[6, 10], [6, 10], [60, 6], [6, 60], [6, 6], [6, 6]]).concat();
    let without = |is_out: &dyn Fn(Point) -> bool| -> Vec<Triangle> {
        let middle = |t: &Triangle| [0, 1, 2].map(|k: usize| (t[0][k] + t[1][k] + t[2][k]) / 3.0);
        whole.iter().filter(|t| !is_out(middle(t))).copied().collect()
    };
    let slit = without(&|[x, y, z]| y > 4.99 && (1.0..2.0).contains(&z) && (30.0..31.0).contains(&x));
    let (code, message) = said("one-cell", &slit, "4");
    assert!(code == Some(0) && message.contains("W355"), "{message}");
    assert!(message.contains("at 4.000 m the integrals over the skin differ by 0.2 % of the volume"), "{message}");
    let hole = without(&|[x, y, z]| y.abs() > 4.99 && (1.0..3.0).contains(&z) && (20.0..30.0).contains(&x));
    let (code, message) = said("holes", &hole, "4");
    assert!(code == Some(3) && message.contains("E353") && message.contains("the skin is not closed"), "{message}");
    // The deck is missing and the sheer falls to 4 m amidships.
    let sheer = |p: Point| -> Point { [p[0], p[1], p[2] * (4.0 + 2.0 * (p[0] / 30.0 - 1.0).powi(2)) / 6.0] };
    let sheered: Vec<Triangle> = whole.iter().filter(|t| t.iter().any(|p| p[2] < 6.0)).map(|t| t.map(sheer)).collect();
    let (code, message) = said("sheer", &sheered, "1,2,3.9");
    assert!(code == Some(0) && !message.contains("W355"), "{message}");
    let (code, message) = said("sheer", &sheered, "1,2,5");
    assert!(code == Some(0) && message.contains("the draught is above the rim of an open deck"), "{message}");
}

/// Sides that begin 8 mm above the bilge are skin, and a hollow body whose skins are 3 mm apart displaces what the outer one does.
#[test]
fn plates_beside_the_skin_are_no_sheets() {
    let [aft, bow, starboard, port, bottom, _] = sides(HULL, [[1, 3], [3, 1], [1, 20], [20, 1], [6, 6], [6, 6]]);
    let above = |side: Vec<Triangle>| {
        side.into_iter().map(|t| t.map(|[x, y, z]: Point| [x, y, if z > 0.0 { z } else { 0.008 }])).collect::<Vec<_>>()
    };
    let parts = [aft, bow, above(starboard), above(port), bottom].concat();
    let row = row("slits", &parts, 4.0).unwrap();
    assert!((row.displacement_volume / 2400.0 - 1.0).abs() < 3e-3, "{}", row.displacement_volume);
    let [_, high] = HULL;
    let [_, _, _, _, _, lid] = sides(HULL, [[1, 1]; 6]);
    assert!(lid.iter().flatten().all(|p| p[2] >= high[2]));
    let outer = sides(HULL, [[1, 1]; 6])[..5].concat();
    let inner = sides([[0.003, -4.997, 0.003], [59.997, 4.997, 6.0]], [[1, 1]; 6])[..5].concat();
    let inner: Vec<Triangle> = inner.into_iter().map(|[a, b, c]| [a, c, b]).collect();
    displaces("skins", &[outer, inner].concat(), 4.0, [2400.0, 600.0]);
}

/// A mast that is higher than its hull is long, and a house that is longer and broader than it.
#[test]
fn masts_and_houses_leave_a_hull_as_it_is() {
    let hull = block(HULL[0], HULL[1]);
    let mast = block([29.8, -0.2, 5.0], [30.2, 0.2, 80.0]);
    displaces("mast", &[hull.clone(), mast].concat(), 3.0, [1800.0, 600.0]);
    let house = block([-3.0, -7.0, 6.0], [63.0, 7.0, 9.0]);
    displaces("wide-house", &[hull, house].concat(), 3.0, [1800.0, 600.0]);
}

/// A barge with walls 1 m thick about an open hold: the water may come in, and the message says so.
#[test]
fn a_hold_that_is_open_from_above_is_named() {
    let [aft, bow, starboard, port, bottom, _] = sides(HULL, [[4, 8], [8, 4], [4, 40], [40, 4], [8, 40], [1, 1]]);
    let hold = sides([[1.0, -4.0, 1.0], [59.0, 4.0, 6.0]], [[4, 8], [8, 4], [4, 40], [40, 4], [8, 40], [1, 1]]);
    let hold = hold[..5].concat().into_iter().map(|[a, b, c]| [a, c, b]);
    let corners =
        |[low, high]: [[f64; 2]; 2]| [low, [high[0], low[1]], high, [low[0], high[1]]].map(|[x, y]| [x, y, 6.0]);
    let (outer, inner) = (corners([[0.0, -5.0], [60.0, 5.0]]), corners([[1.0, -4.0], [59.0, 4.0]]));
    let rim = (0..4).flat_map(|k| {
        let n = (k + 1) % 4;
        [[outer[k], outer[n], inner[n]], [outer[k], inner[n], inner[k]]]
    });
    let barge: Vec<Triangle> =
        [aft, bow, starboard, port, bottom].concat().into_iter().chain(hold).chain(rim).collect();
    let output = program(&["hydro", &written("hold", &barge).display().to_string(), "--draughts", "4"]);
    let message = stderr(&output);
    assert!(output.status.code() == Some(0) && message.contains("open from above have 64 %"), "{message}");
}

/// A slit of 20 mm all around the sides is no side that is missing; shells of no area are nothing.
#[test]
fn a_slit_around_the_hull_is_no_hole() {
    let counts = [[6, 3], [3, 6], [3, 20], [20, 3], [6, 20], [20, 6]];
    let lower = sides([HULL[0], [60.0, 5.0, 1.0]], counts);
    let upper = sides([[0.0, -5.0, 1.02], HULL[1]], counts);
    let hull = [&lower[..5], &upper[..4], &upper[5..]].concat().concat();
    let row = row("slit", &hull, 3.0).unwrap();
    assert!((row.displacement_volume / 1800.0 - 1.0).abs() < 1e-2, "{}", row.displacement_volume);
    let line = |z: f64| -> Point { [70.0, 0.0, z] };
    let edge = vec![[line(0.0), line(2.0), line(1.0)], [line(1.0), line(2.0), line(3.0)]];
    let output = program(&[
        "hydro",
        &written("edge", &[block(HULL[0], HULL[1]), edge].concat()).display().to_string(),
        "--draughts",
        "3",
    ]);
    assert!(output.status.code() == Some(0) && !stderr(&output).contains("W320"), "{}", stderr(&output));
}
