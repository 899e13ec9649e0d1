//! Frames of the mould loft: closed forms of a sphere, a box and a wedge, and the files of the command.

use std::fs;

use loftsman::internals::hull::{Hull, StationNumbers, default_stations};
use loftsman::internals::parametric::analytic::{Dimensions, ellipsoid, rectangular_box, wigley};

use crate::support::{carried, folder, program, stderr, stdout};

const THICKNESS: f64 = 0.05;

fn hull(
    generated: Result<loftsman::internals::parametric::Generated, Vec<loftsman::internals::parametric::Infeasible>>,
) -> Hull {
    generated.unwrap_or_else(|_| panic!("infeasible")).hull
}

#[test]
fn a_frame_inside_a_sphere_is_a_smaller_circle() {
    // Radius 10 m, centre 10 m forward of AP on the deck.
    let dimensions = Dimensions { length: 20.0, breadth: 20.0, draught: 10.0, depth: 10.0 };
    let sphere = hull(ellipsoid("sphere", &dimensions));
    for offset in [-THICKNESS, 0.0, THICKNESS] {
        for x in [4.0, 7.5, 10.0, 15.0] {
            let frame = sphere.lofted_frame(x, offset, 1e-5).unwrap();
            let radius = ((10.0 + offset).powi(2) - (x - 10.0).powi(2)).sqrt();
            for point in frame.points() {
                let off = point.y.hypot(point.z - 10.0) - radius;
                assert!(off.abs() < 2e-5, "x {x}, offset {offset}: ({}, {}) is {off:e} off", point.y, point.z);
            }
            // The normal of a sphere points from its centre: sin of the bevel is (x - 10)/R.
            let middle = frame.at_height(6.0).unwrap();
            let bevel = ((x - 10.0) / (10.0 + offset)).asin();
            assert!((middle.bevel - bevel).abs() < 1e-4, "x {x}: {} for {bevel}", middle.bevel);
            assert!((frame.points().last().unwrap().z - 10.0).abs() < 1e-9);
        }
    }
    // The face inside does not reach the ends.
    assert!(sphere.lofted_frame(0.02, -THICKNESS, 1e-4).is_none());
}

#[test]
fn frames_of_a_box_have_sharp_corners() {
    let dimensions = Dimensions { length: 20.0, breadth: 8.0, draught: 2.0, depth: 4.0 };
    let barge = hull(rectangular_box("box", &dimensions));
    for (offset, y, z) in [(-THICKNESS, 3.95, 0.05), (0.0, 4.0, 0.0), (THICKNESS, 4.05, -0.05)] {
        let frame = barge.lofted_frame(10.0, offset, 1e-4).unwrap();
        let near = |a: f64, b: f64| (a - b).abs() < 1e-9;
        assert!(frame.points().any(|p| near(p.y, y) && near(p.z, z)), "{offset}: {:?}", frame.branches);
        assert!(near(frame.branches[0][0].y, 0.0) && near(frame.branches[0][0].z, z));
        assert!(near(frame.at_height(2.0).unwrap().y, y) && near(frame.at_breadth(2.0).unwrap().z, z));
        assert!(frame.points().all(|p| p.bevel.abs() < 1e-9 && p.y < y + 1e-9 && p.z > z - 1e-9));
    }
}

#[test]
fn a_moulded_frame_is_the_section_and_its_bevel_the_slope_of_the_waterline() {
    let dimensions = Dimensions { length: 100.0, breadth: 10.0, draught: 6.25, depth: 9.0 };
    let ship = hull(wigley("Wigley", &dimensions));
    let frame = ship.lofted_frame(80.0, 0.0, 1e-5).unwrap();
    for z in [1.0, 3.0, 5.0] {
        let found = frame.at_height(z).unwrap();
        assert!((found.y - ship.half_breadth(80.0, z).unwrap()).abs() < 2e-5);
        // y = f(x, z): n = (-y_x, 1, -y_z).
        let slope = |h: f64, at: &dyn Fn(f64) -> f64| (at(h) - at(-h)) / (2.0 * h);
        let along = slope(1e-4, &|h| ship.half_breadth(80.0 + h, z).unwrap());
        let up = slope(1e-4, &|h| ship.half_breadth(80.0, z + h).unwrap());
        let bevel = (-along).atan2(1.0_f64.hypot(up));
        assert!((found.bevel - bevel).abs() < 1e-3 && found.bevel > 0.0, "{} for {bevel}", found.bevel);
    }
}

#[test]
fn the_command_writes_drawings_and_ordinates() {
    let to = folder("loft");
    let out = to.to_str().unwrap();
    let done = program(&[
        "loft",
        "configs/wigley.toml",
        "--frames",
        "20,50,80,-30",
        "--thickness",
        "12 mm",
        "-f",
        "svg,dxf,pdf",
        "-o",
        out,
    ]);
    assert_eq!(done.status.code(), Some(0), "{}", stderr(&done));
    assert!(stderr(&done).contains("W515") && stderr(&done).contains("-30.000 m"), "{}", stderr(&done));
    assert!(stdout(&done).contains("3 frames of the face 12 mm inside the moulded surface"), "{}", stdout(&done));
    let read = |name: &str| fs::read_to_string(to.join(name)).unwrap();
    // Millimetres, in the notation of the command.
    let rows: Vec<String> = read("half-breadths.csv").lines().map(str::to_owned).collect();
    assert!(rows[0].starts_with("x\\z [mm]") && rows.len() == 4, "{rows:?}");
    assert!(read("bevels.csv").lines().nth(3).is_some_and(|row| row.starts_with("80000")));
    assert!(read("frames.dxf").contains("FRAME_80_000"));
    assert!(read("frame-50.000.svg").starts_with("<svg"));
    assert!(fs::read(to.join("frames.pdf")).unwrap().starts_with(b"%PDF"));
}

/// Frames of all presets without a skin are their sections: every default frame, along its whole height.
#[test]
fn moulded_frames_of_all_presets_are_their_sections() {
    for preset in ["bulk-carrier", "container-ship", "fishing-vessel", "frigate", "tug", "yacht"] {
        let path = carried("configs").join(format!("{preset}.toml"));
        let ship = loftsman::internals::report::read_source(&path).unwrap().hull;
        for station in default_stations(&ship, StationNumbers::default()) {
            let Some(frame) = ship.lofted_frame(station.x, 0.0, 1e-4) else { continue };
            let heights: Vec<f64> = (0..60).map(|k| f64::from(k) / 60.0 * ship.deck_height(station.x)).collect();
            for z in heights {
                // Where the surface reaches, above the keel.
                let Some(y) = ship.half_breadth(station.x, z).filter(|y| *y > 1e-3) else { continue };
                let found = frame.at_height(z).map_or(0.0, |point| point.y);
                assert!((found - y).abs() < 2e-3, "{preset}, x {:.3}, z {z:.3}: {found} for {y}", station.x);
            }
        }
    }
}

#[test]
fn a_frame_inside_is_nowhere_nearer_to_the_skin_than_its_thickness() {
    let ship = loftsman::internals::report::read_source(&carried("configs/tug.toml")).unwrap().hull;
    let thickness = 0.3;
    for x in [3.0, 10.0, 20.0, 24.0, 26.0, 27.5, 28.0] {
        let Some(frame) = ship.lofted_frame(x, -thickness, 1e-3) else { continue };
        for point in frame.points() {
            assert!(point.y >= 0.0 && point.y.is_finite(), "x {x}: {point:?}");
            // The moulded section at the frame is further out than the skin is thick.
            if let Some(y) = ship.half_breadth(x, point.z).filter(|_| point.y > 0.0) {
                assert!(y - point.y > 0.98 * thickness, "x {x}: {point:?} inside {y}");
            }
        }
    }
}
