//! Hulls whose heights depend on both parameters: rockered keels, chines, re-parametrised bodies, against closed forms
//! and quadrature of the formulas of the bodies.

use loftsman::internals::exchange::{read_hull, write_hull};
use loftsman::internals::hull::{Cut, Face, Functional, Hull, HullError, OffsetTable, PrincipalParticulars};
use loftsman::internals::hydrostatics::{Conventions, CurvesOfForm, Hydrostatics, QUANTITIES};
use loftsman::internals::plot::{Figure, FigureInputs};
use loftsman::internals::spline::{BsplineCurve, BsplineSurface, KnotVector};
use proptest::prelude::*;

/// The net of degrees p, q that interpolates `body`, with `spans` in u and in v; exact for polynomials of these degrees.
fn surface(degrees: [usize; 2], spans: [usize; 2], body: impl Fn(f64, f64) -> [f64; 3]) -> BsplineSurface<3> {
    let (u, v) =
        (KnotVector::uniform(degrees[0], spans[0]).unwrap(), KnotVector::uniform(degrees[1], spans[1]).unwrap());
    let (gu, gv) = (u.greville(), v.greville());
    let points: Vec<[f64; 3]> =
        gu.iter().flat_map(|&s| gv.iter().map(move |&t| (s, t))).map(|(s, t)| body(s, t)).collect();
    BsplineSurface::interpolate([u, v], [&gu, &gv], &points).unwrap()
}

/// The surface with the heights of its first station everywhere, equal to the bit.
fn levelled(surface: BsplineSurface<3>) -> BsplineSurface<3> {
    let [rows, columns] = surface.shape();
    let point = |i: usize, j: usize| [surface.point(i, j)[0], surface.point(i, j)[1], surface.point(0, j)[2]];
    let points = (0..rows).flat_map(|i| (0..columns).map(move |j| (i, j))).map(|(i, j)| point(i, j)).collect();
    BsplineSurface::new(surface.u().clone(), surface.v().clone(), points).unwrap()
}

fn level_deck(length: f64, height: f64) -> BsplineCurve<2> {
    let line = KnotVector::uniform(1, 1).unwrap();
    BsplineCurve::new(line, vec![[-0.1 * length, height], [1.1 * length, height]]).unwrap()
}

fn particulars(length: f64, breadth: f64, draught: f64, depth: f64) -> PrincipalParticulars {
    PrincipalParticulars { length_between_perpendiculars: length, breadth, draught: Some(draught), depth }
}

fn row(hull: &Hull, draught: f64) -> Hydrostatics {
    CurvesOfForm::new(hull, &[draught], &Conventions::default()).rows.remove(0)
}

/// Composite midpoint rule.
fn midpoint(from: f64, to: f64, count: usize, function: impl Fn(f64) -> f64) -> f64 {
    let step = (to - from) / count as f64;
    (0..count).map(|k| function(from + step * (k as f64 + 0.5))).sum::<f64>() * step
}

#[track_caller]
fn near(found: f64, expected: f64, tolerance: f64, what: &str) {
    assert!((found - expected).abs() <= tolerance * expected.abs().max(1e-3), "{what}: {found}, expected {expected}");
}

const LENGTH: f64 = 30.0;
const BREADTH: f64 = 6.0;
const DEPTH: f64 = 4.0;
const ROCKER: f64 = 3.0;

/// Canoe body: keel z_k = ROCKER xi^2, xi = 2 x / L - 1, half-breadth (B / 2) (1 - xi^2) zeta^(1/2) at the fraction
/// zeta of the height between keel and deck; zeta = v^2, so that all is polynomial.
fn canoe(spans: [usize; 2]) -> Hull {
    let surface = surface([3, 3], spans, |u, v| {
        let xi = 2.0 * u - 1.0;
        let keel = ROCKER * xi * xi;
        [LENGTH * u, 0.5 * BREADTH * (1.0 - xi * xi) * v, keel + (DEPTH - keel) * v * v]
    });
    Hull::new("canoe", particulars(LENGTH, BREADTH, 2.0, DEPTH), surface, level_deck(LENGTH, DEPTH)).unwrap()
}

/// Integral over the immersed length of the canoe of a function of xi, in the angle that takes out the root at its ends.
fn along_canoe(draught: f64, function: impl Fn(f64) -> f64) -> f64 {
    let end = (draught / ROCKER).sqrt().min(1.0);
    midpoint(-0.5, 0.5, 4000, |s| {
        let angle = std::f64::consts::PI * s;
        let xi = end * angle.sin();
        function(xi) * end * angle.cos() * std::f64::consts::PI * 0.5 * LENGTH
    })
}

#[test]
fn a_canoe_body_with_a_rockered_keel() {
    for spans in [[1, 1], [5, 4]] {
        let hull = canoe(spans);
        assert!(hull.is_upright() && !hull.is_level() && hull.heights().is_none());
        assert!(hull.bottom().abs() < 1e-13 && (hull.top() - DEPTH).abs() < 1e-13);
        for draught in [0.4, 1.7, 2.999, 3.3, 4.0] {
            let height = |xi: f64| DEPTH - ROCKER * xi * xi;
            let zeta = |xi: f64| ((draught - ROCKER * xi * xi) / height(xi)).max(0.0);
            let breadth = |xi: f64| BREADTH * (1.0 - xi * xi);
            let area = |xi: f64| breadth(xi) * height(xi) * 2.0 / 3.0 * zeta(xi).powf(1.5);
            let volume = along_canoe(draught, area);
            let row = row(&hull, draught);
            let what = |name: &str| format!("{name}, {spans:?}, T = {draught}");
            near(row.displacement_volume, volume, 1e-9, &what("volume"));
            near(row.lcb.unwrap(), 0.5 * LENGTH, 1e-10, &what("LCB"));
            // int z dA over a section: z_k A + h int zeta (B) zeta^(1/2) h dzeta.
            let moment = along_canoe(draught, |xi| {
                ROCKER * xi * xi * area(xi) + breadth(xi) * height(xi).powi(2) * 0.4 * zeta(xi).powf(2.5)
            });
            near(row.kb.unwrap(), moment / volume, 1e-9, &what("KB"));
            let waterline = |xi: f64| breadth(xi) * zeta(xi).sqrt();
            near(row.waterplane_area, along_canoe(draught, waterline), 1e-9, &what("waterplane"));
            near(row.lcf.unwrap(), 0.5 * LENGTH, 1e-10, &what("LCF"));
            near(row.transverse_inertia, along_canoe(draught, |xi| waterline(xi).powi(3) / 12.0), 1e-9, &what("I_T"));
            let arm = |xi: f64| 0.25 * LENGTH * LENGTH * xi * xi;
            near(row.longitudinal_inertia, along_canoe(draught, |xi| arm(xi) * waterline(xi)), 1e-9, &what("I_L"));
            let end = (draught / ROCKER).sqrt().min(1.0);
            near(row.waterline_length, LENGTH * end, 1e-12, &what("L_WL"));
            near(row.waterline_breadth, BREADTH * (draught / DEPTH).sqrt(), 1e-12, &what("B_WL"));
            near(row.midship_section_area, area(0.0), 1e-12, &what("A_M"));
            near(row.maximum_section_area, area(0.0), 1e-12, &what("A_X"));
            near(row.maximum_section_position.unwrap(), 0.5 * LENGTH, 1e-6, &what("x_X"));
            near(row.prismatic_coefficient_aft.unwrap(), row.prismatic_coefficient_fore.unwrap(), 1e-9, &what("C_PA"));
            let profile = along_canoe(draught, |xi| draught - ROCKER * xi * xi);
            near(row.lateral_area, profile, 1e-8, &what("lateral area"));
            assert!(row.transom_area.abs() < 1e-12);
            if draught < 2.9 {
                // Half angle at the end of the waterline: infinite dy/dx.
                near(row.half_angle_of_entrance.unwrap(), 90.0, 1e-6, &what("half angle"));
            }
            // Wetted surface: 2 int int (1 + y_x^2 + y_z^2)^(1/2) dz dx, dz = 2 h v dv.
            let wetted = along_canoe(draught, |xi| {
                midpoint(0.0, zeta(xi).sqrt(), 150, |v| {
                    let h = height(xi);
                    let y_v = 0.5 * BREADTH * (1.0 - xi * xi);
                    let y_z = y_v / (2.0 * h * v);
                    // zeta = (z - z_k) / (D - z_k); at fixed z d zeta / d z_k = -(1 - zeta) / h.
                    let keel_x = 2.0 * ROCKER * xi * 2.0 / LENGTH;
                    let y_x = -BREADTH * xi * v * 2.0 / LENGTH - y_v / (2.0 * v) * (1.0 - v * v) / h * keel_x;
                    4.0 * h * v * (1.0 + y_x * y_x + y_z * y_z).sqrt()
                })
            });
            near(row.wetted_surface, wetted, 3e-5, &what("wetted surface"));
        }
    }
    // The whole body in closed form: (L B / 3) (4 D / 3 - 4 r / 15).
    let whole = LENGTH * BREADTH / 3.0 * (4.0 * DEPTH / 3.0 - 4.0 * ROCKER / 15.0);
    near(row(&canoe([4, 3]), 4.0).displacement_volume, whole, 1e-13, "whole volume");
}

#[test]
fn half_ellipsoid() {
    let (a, b, c) = (10.0, 2.0, 1.5);
    let body = surface([5, 5], [32, 16], |u, v| {
        let t = 2.0 * u - 1.0;
        let xi = 0.5 * t * (3.0 - t * t);
        let share = 0.5 * (1.0 - t * t) * (4.0 - t * t).sqrt();
        [a * (1.0 + xi), b * share * v * (2.0 - v * v).sqrt(), c - c * share * (1.0 - v * v)]
    });
    let hull = Hull::new("spheroid", particulars(2.0 * a, 2.0 * b, c, c), body, level_deck(2.0 * a, c)).unwrap();
    let pi = std::f64::consts::PI;
    for draught in [0.2, 0.75, 1.2, 1.5] {
        let what = |name: &str| format!("{name}, T = {draught}");
        let row = row(&hull, draught);
        // Segment of a sphere of radius 1 and height t, scaled.
        let t = draught / c;
        let volume = a * b * c * pi * t * t * (3.0 - t) / 3.0;
        let below_centre = 0.75 * (2.0 - t).powi(2) / (3.0 - t);
        near(row.displacement_volume, volume, 1e-9, &what("volume"));
        near(row.kb.unwrap(), c - c * below_centre, 1e-7, &what("KB"));
        near(row.lcb.unwrap(), a, 1e-8, &what("LCB"));
        let radius = (1.0 - (1.0 - t).powi(2)).sqrt();
        near(row.waterplane_area, pi * a * b * radius * radius, 1e-8, &what("waterplane"));
        near(row.transverse_inertia, 0.25 * pi * a * b.powi(3) * radius.powi(4), 2e-8, &what("I_T"));
        near(row.longitudinal_inertia, 0.25 * pi * b * a.powi(3) * radius.powi(4), 1e-7, &what("I_L"));
        near(row.waterline_length, 2.0 * a * radius, 1e-6, &what("L_WL"));
        near(row.waterline_breadth, 2.0 * b * radius, 1e-7, &what("B_WL"));
        near(row.half_angle_of_entrance.unwrap(), 90.0, 1e-3, &what("half angle"));
        let wetted = midpoint(0.0, 1.0, 800, |s| {
            // On the unit sphere below the plane: polar angle from the lowest point.
            let polar = (1.0 - t).acos() * s;
            (1.0 - t).acos()
                * polar.sin()
                * midpoint(0.0, 2.0 * pi, 200, |around| {
                    let n = [polar.sin() * around.cos(), polar.sin() * around.sin(), polar.cos()];
                    a * b * c * ((n[0] / a).powi(2) + (n[1] / b).powi(2) + (n[2] / c).powi(2)).sqrt()
                })
        });
        near(row.wetted_surface, wetted, 2e-6, &what("wetted surface"));
    }
    // The inverse of the chart.
    for (x, z) in [(3.0, 0.9), (10.0, 0.01), (17.5, 1.4)] {
        let y = b * (1.0 - (x / a - 1.0f64).powi(2) - (z / c - 1.0f64).powi(2)).sqrt();
        near(hull.half_breadth(x, z).unwrap(), y, 1e-6, "half-breadth");
    }
    assert!(hull.half_breadth(1.0, 0.1).is_none() && hull.half_breadth(21.0, 1.0).is_none());
    let radius = (1.0f64 - 0.25).sqrt();
    let [aft, fore] = hull.endings(0.75).unwrap();
    near(aft, a * (1.0 - radius), 1e-6, "aft end");
    near(fore, a * (1.0 + radius), 1e-7, "fore end");
}

/// A box of half-breadth 2 with a keel that rises from 0 to 1.5 over 20 m, 3 m deep.
fn wedge() -> Hull {
    let body = surface([1, 1], [3, 2], |u, v| [20.0 * u, 2.0, 1.5 * u + (3.0 - 1.5 * u) * v]);
    Hull::new("wedge", particulars(20.0, 4.0, 1.0, 3.0), body, level_deck(20.0, 3.0)).unwrap()
}

#[test]
fn a_wedge_with_a_raked_keel() {
    let (hull, slope) = (wedge(), 1.5 / 20.0f64);
    for draught in [0.3, 1.0, 1.5, 2.2, 3.0] {
        let what = |name: &str| format!("{name}, T = {draught}");
        let length = (draught / slope).min(20.0);
        let row = row(&hull, draught);
        let profile = draught * length - 0.5 * slope * length * length;
        near(row.displacement_volume, 4.0 * profile, 1e-12, &what("volume"));
        near(row.waterplane_area, 4.0 * length, 1e-12, &what("waterplane"));
        near(row.transverse_inertia, 64.0 / 12.0 * length, 1e-12, &what("I_T"));
        near(row.waterline_length, length, 1e-12, &what("L_WL"));
        near(row.lateral_area, profile, 1e-12, &what("profile"));
        near(row.transom_area, 4.0 * draught, 1e-12, &what("transom"));
        let bow = if length < 20.0 { 0.0 } else { 4.0 * (draught - 1.5) };
        let wetted = 2.0 * profile + 4.0 * length * slope.hypot(1.0) + 4.0 * draught + bow;
        near(row.wetted_surface, wetted, 1e-12, &what("wetted surface"));
        let moment = draught * length.powi(2) / 2.0 - slope * length.powi(3) / 3.0;
        near(row.lcb.unwrap(), moment / profile, 1e-12, &what("LCB"));
        near(row.midship_section_area, 4.0 * (draught - 0.75).max(0.0), 1e-12, &what("A_M"));
        near(row.maximum_section_area, 4.0 * draught, 1e-12, &what("A_X"));
        near(Functional::SectionArea { x: 5.0 }.value(&hull, draught), 4.0 * (draught - 0.375f64).max(0.0), 1e-12, "A");
        // C_PA: the volume aft of midship.
        let aft = draught * length.min(10.0) - 0.5 * slope * length.min(10.0).powi(2);
        let half = 0.5 * row.maximum_section_area * 20.0;
        near(row.prismatic_coefficient_aft.unwrap(), 4.0 * aft / half, 1e-12, &what("C_PA"));
    }
}

#[test]
fn a_chined_barge_whose_keel_and_chine_rise() {
    // Sections: from (0, k) to (2, c) at the chine and (3, 3) at the sheer, k = 0.06 x, c = 1 + 0.03 x.
    let (u, v) = (KnotVector::uniform(1, 1).unwrap(), KnotVector::uniform(1, 2).unwrap());
    let net = |x: f64| [[x, 0.0, 0.06 * x], [x, 2.0, 1.0 + 0.03 * x], [x, 3.0, 3.0]];
    let points = net(0.0).into_iter().chain(net(24.0)).collect();
    let body = BsplineSurface::new(u, v, points).unwrap();
    let hull = Hull::new("barge", particulars(24.0, 6.0, 1.5, 3.0), body, level_deck(24.0, 3.0)).unwrap();
    let area = |x: f64, draught: f64| {
        let (keel, chine) = (0.06 * x, 1.0 + 0.03 * x);
        let low = (draught.min(chine) - keel).max(0.0);
        let high = (draught - chine).max(0.0);
        2.0 * (low * low / (chine - keel) + high * 2.0 + 0.5 * high * high / (3.0 - chine))
    };
    for draught in [0.5, 1.2, 1.5, 2.8] {
        let row = row(&hull, draught);
        let stops = [0.0, (draught - 1.0) / 0.03, draught / 0.06, 24.0].map(|x: f64| x.clamp(0.0, 24.0));
        let integrate = |f: &dyn Fn(f64) -> f64| {
            stops.windows(2).filter(|w| w[1] > w[0]).map(|w| midpoint(w[0], w[1], 20_000, f)).sum::<f64>()
        };
        near(row.displacement_volume, integrate(&|x| area(x, draught)), 1e-9, "volume");
        let beam = |x: f64| {
            let (keel, chine) = (0.06 * x, 1.0 + 0.03 * x);
            if draught >= chine {
                4.0 + 2.0 * (draught - chine) / (3.0 - chine)
            } else {
                (4.0 * (draught - keel) / (chine - keel)).max(0.0)
            }
        };
        near(row.waterplane_area, integrate(&beam), 1e-9, "waterplane");
        near(row.transverse_inertia, integrate(&|x| beam(x).powi(3) / 12.0), 1e-8, "I_T");
        for x in [0.0, 3.0, 11.0, 23.0] {
            near(Functional::SectionArea { x }.value(&hull, draught), area(x, draught), 1e-12, "section");
        }
        near(row.maximum_section_area, area(0.0, draught), 1e-10, "A_X");
    }
    // Plane sections: the station is the chain keel, chine, sheer, the waterline one branch that ends on the keel.
    let station = hull.section(Cut::Station { x: 12.0 }, 1e-9);
    assert_eq!(station.branches.len(), 1);
    let line = station.branches[0].polyline(1e-6);
    assert!(line.iter().any(|p| (p[1] - 2.0).abs() < 1e-9 && (p[2] - 1.36).abs() < 1e-9), "{line:?}");
    let waterline = hull.section(Cut::Waterline { z: 1.2 }, 1e-9);
    let side: Vec<_> = waterline.branches.iter().filter(|b| b.face == Face::Side).collect();
    assert_eq!(side.len(), 1);
    let points = side[0].curve.points();
    let end = points[points.len() - 1];
    assert!((end[0] - 20.0).abs() < 1e-8 && end[1].abs() < 1e-8, "{end:?}");
    for p in side[0].polyline(1e-5) {
        assert!(
            (p[2] - 1.2).abs() < 1e-8 && (hull.half_breadth(p[0], 1.2).unwrap_or(0.0) - p[1]).abs() < 1e-6,
            "{p:?}"
        );
    }
}

/// Differences of all quantities of two hulls that are the same body.
fn same(one: &Hull, other: &Hull, draughts: &[f64], tolerance: f64) {
    for &draught in draughts {
        let (a, b) = (row(one, draught), row(other, draught));
        for quantity in QUANTITIES {
            let (x, y) = ((quantity.value)(&a), (quantity.value)(&b));
            assert_eq!(x.is_some(), y.is_some(), "{} at {draught}: {x:?} {y:?}", quantity.key);
            let (x, y) = (x.unwrap_or(0.0), y.unwrap_or(0.0));
            // Places of maxima are stated to 1e-7 of the length; half angles to 1e-5 deg.
            let limit = if ["XMAX", "LE", "LR", "XPA", "XPF"].contains(&quantity.key) { 1e-6 } else { tolerance };
            assert!((x - y).abs() <= limit * x.abs().max(1.0), "{} at {draught}: {x} {y}", quantity.key);
        }
    }
}

#[test]
fn a_body_in_a_level_and_in_an_upright_chart() {
    // y = (B / 2) (1 - xi^2) (2 zeta - zeta^2) with zeta = z / D.
    let (length, breadth, depth) = (40.0, 6.0, 4.0);
    let body = |xi: f64, zeta: f64| 0.5 * breadth * (1.0 - xi * xi) * zeta * (2.0 - zeta);
    let hull =
        |surface| Hull::new("w", particulars(length, breadth, 2.5, depth), surface, level_deck(length, depth)).unwrap();
    let level = hull(levelled(surface([2, 2], [3, 3], |u, v| [length * u, body(2.0 * u - 1.0, v), depth * v])));
    let upright = hull(surface([6, 4], [2, 2], |u, v| {
        let zeta = v + 0.9 * u * (1.0 - u) * v * (1.0 - v);
        [length * u, body(2.0 * u - 1.0, zeta), depth * zeta]
    }));
    assert!(level.is_level() && !upright.is_level() && upright.is_upright());
    same(&level, &upright, &[0.1, 0.8, 2.0, 3.1, 3.99, 4.0, 5.0], 1e-9);
    let (one, other) = (OffsetTable::with_defaults(&level), OffsetTable::with_defaults(&upright));
    for (a, b) in one.stations.iter().zip(&other.stations) {
        for (x, y) in a.half_breadths.iter().zip(&b.half_breadths).chain(a.heights.iter().zip(&b.heights)) {
            assert_eq!(x.value().is_some(), y.value().is_some(), "{a:?} {b:?}");
            assert!((x.value().unwrap_or(0.0) - y.value().unwrap_or(0.0)).abs() < 1e-8);
        }
    }
}

#[test]
fn a_body_in_a_level_and_in_a_mixed_chart() {
    let (length, breadth, depth) = (40.0, 6.0, 4.0);
    let body = |xi: f64, zeta: f64| 0.5 * breadth * (1.0 - xi * xi) * zeta;
    let hull =
        |surface| Hull::new("w", particulars(length, breadth, 2.5, depth), surface, level_deck(length, depth)).unwrap();
    let level = hull(levelled(surface([2, 2], [3, 3], |u, v| [length * u, body(2.0 * u - 1.0, v), depth * v])));
    let mixed = hull(surface([6, 4], [1, 1], |u, v| {
        let zeta = v + 0.6 * u * (1.0 - u) * v * (1.0 - v);
        let along = u + 0.3 * u * (1.0 - u) * v;
        [length * along, body(2.0 * along - 1.0, zeta), depth * zeta]
    }));
    assert!(!mixed.is_level() && !mixed.is_upright());
    same(&level, &mixed, &[0.1, 0.8, 2.0, 3.1, 3.99, 4.0, 5.0], 1e-9);
    for (x, z) in [(0.1, 0.2), (7.0, 3.3), (20.0, 2.0), (39.0, 3.9), (40.0, 1.0)] {
        near(mixed.half_breadth(x, z).unwrap(), level.half_breadth(x, z).unwrap(), 1e-9, "half-breadth");
    }
}

#[test]
fn a_chart_that_folds_is_refused() {
    let u = || KnotVector::uniform(1, 1).unwrap();
    // z rises with v and x with u, but the upper edge is swept so far aft of the steep keel line that the lines cross.
    let points = vec![[0.0, 1.0, 0.0], [9.0, 1.0, 1.0], [1.0, 1.0, 8.0], [10.0, 1.0, 9.0]];
    let body = BsplineSurface::new(u(), u(), points).unwrap();
    let error = Hull::new("x", particulars(10.0, 2.0, 1.0, 9.0), body, level_deck(10.0, 9.0)).unwrap_err();
    assert!(matches!(error, HullError::Folded { .. }), "{error}");
    assert!(error.to_string().contains("must not be negative"), "{error}");
}

#[test]
fn a_hump_in_the_keel_parts_the_waterline() {
    // Keel z = 1 - (2 xi^2 - 1)^2: up at xi = 1 / sqrt 2, down at both ends and amidships... as a polynomial of degree 4.
    let keel = |xi: f64| 1.0 - (2.0 * xi * xi - 1.0).powi(2);
    let body = surface([4, 2], [3, 2], |u, v| {
        let low = keel(2.0 * u - 1.0);
        [20.0 * u, 1.0 + v, low + (3.0 - low) * v]
    });
    let hull = Hull::new("hump", particulars(20.0, 4.0, 1.0, 3.0), body, level_deck(20.0, 3.0)).unwrap();
    for draught in [0.2, 0.9, 0.999, 1.001, 1.5] {
        // y = 1 + (z - k) / (3 - k).
        let area = |xi: f64| {
            let (k, wet) = (keel(xi), (draught - keel(xi)).max(0.0));
            2.0 * wet + wet * wet / (3.0 - k)
        };
        let volume = midpoint(-1.0, 1.0, 400_000, |xi| 10.0 * area(xi));
        near(Functional::Volume.value(&hull, draught), volume, 1e-8, "volume");
        let beam = |xi: f64| {
            let wet = draught - keel(xi);
            if wet > 0.0 { 2.0 * (1.0 + wet / (3.0 - keel(xi))) } else { 0.0 }
        };
        let row = row(&hull, draught);
        near(row.displacement_volume, volume, 1e-8, "volume");
        near(row.waterplane_area, midpoint(-1.0, 1.0, 400_000, |xi| 10.0 * beam(xi)), 2e-5, "waterplane");
        let branches = hull.section(Cut::Waterline { z: draught }, 1e-7).branches;
        let side = branches.iter().filter(|b| b.face == Face::Side).count();
        assert_eq!(side, if draught < 1.0 { 3 } else { 1 }, "T = {draught}");
    }
}

#[test]
fn the_sheer_line_may_be_the_upper_edge() {
    // The canoe with a sheer of 0.8 m at the ends; the deck is the upper edge itself.
    let body = surface([3, 3], [4, 3], |u, v| {
        let xi = 2.0 * u - 1.0;
        let (keel, sheer) = (0.5 * xi * xi, 2.0 + 0.8 * xi * xi);
        [20.0 * u, 2.0 * (1.0 - xi * xi) * v, keel + (sheer - keel) * v * v]
    });
    let edge = body.curve_at_v(1.0);
    let deck = BsplineCurve::new(edge.knots().clone(), edge.points().iter().map(|p| [p[0], p[2]]).collect()).unwrap();
    let hull = Hull::new("sheer", particulars(20.0, 4.0, 1.0, 2.0), body, deck).unwrap();
    near(hull.top(), 2.8, 1e-13, "top");
    // A = 2 int y dz = (8 / 3) (1 - xi^2) h with h = 1.5 + ... over the whole section.
    let whole = midpoint(-1.0, 1.0, 200_000, |xi| 10.0 * 8.0 / 3.0 * (1.0 - xi * xi) * (2.0 + 0.3 * xi * xi));
    for draught in [2.8, 9.0] {
        near(row(&hull, draught).displacement_volume, whole, 1e-10, "whole volume");
    }
    let partly = row(&hull, 2.3);
    // The deck is under water where 0.8 xi^2 < 0.3.
    let stretch = 0.375f64.sqrt();
    let remark = partly.remark.clone().unwrap();
    let ends = format!("{:.3} to {:.3} m", 10.0 * (1.0 - stretch), 10.0 * (1.0 + stretch));
    assert!(remark.contains(&ends), "{remark} {ends}");
    let part = midpoint(-1.0, 1.0, 400_000, |xi| {
        let height = 2.0 + 0.3 * xi * xi;
        let share = ((2.3 - 0.5 * xi * xi) / height).min(1.0);
        10.0 * 8.0 / 3.0 * (1.0 - xi * xi) * height * share.powf(1.5)
    });
    near(partly.displacement_volume, part, 1e-8, "volume with the deck partly immersed");
}

#[test]
fn files_and_figures_of_a_canoe_body() {
    let hull = canoe([5, 4]);
    let conventions = Conventions::default();
    let text = write_hull(&hull, &conventions).unwrap();
    let read = read_hull(&text).unwrap();
    assert_eq!(read.hull, hull);
    assert_eq!(write_hull(&read.hull, &conventions).unwrap(), text);
    let design = row(&hull, 2.0);
    let curves = CurvesOfForm::new(&hull, &[0.4, 2.0, 4.0], &conventions);
    for figure in Figure::ALL {
        let drawn = figure
            .draw(&FigureInputs {
                hull: &hull,
                before: None,
                record: None,
                design: Some(&design),
                curves: &curves,
                source: None,
                dense: None,
            })
            .unwrap();
        assert!(drawn.as_str().contains("<svg"), "{}", figure.key());
    }
    // Waterlines are sections: above the ends of the keel one branch from end to end, below them one between its ends.
    for z in [1.0, 3.5] {
        let section = hull.section(Cut::Waterline { z }, 1e-7);
        assert_eq!(section.branches.len(), 1, "z = {z}");
        let points = section.branches[0].curve.points();
        let end = 0.5 * LENGTH * (z / ROCKER).sqrt().min(1.0);
        near(points[0][0], 0.5 * LENGTH - end, 1e-6, "aft end");
        near(points[points.len() - 1][0], 0.5 * LENGTH + end, 1e-6, "fore end");
        for p in section.branches[0].polyline(1e-5) {
            let y = hull.half_breadth(p[0], z).unwrap_or(0.0);
            assert!((p[2] - z).abs() < 2e-7 && (y - p[1]).abs() < 2e-3, "{p:?} {y}");
        }
    }
    // Stations, buttocks and offsets lie on the body.
    let body = |x: f64, z: f64| {
        let xi = 2.0 * x / LENGTH - 1.0;
        let keel = ROCKER * xi * xi;
        0.5 * BREADTH * (1.0 - xi * xi) * ((z - keel) / (DEPTH - keel)).max(0.0).sqrt()
    };
    for cut in [Cut::Station { x: 6.0 }, Cut::Buttock { y: 1.5 }, Cut::Diagonal { height: 2.0, angle: 0.5 }] {
        let branches = hull.section(cut, 1e-7).branches;
        assert_eq!(branches.len(), 1, "{cut:?}");
        for p in branches[0].polyline(1e-6) {
            let keel = ROCKER * (2.0 * p[0] / LENGTH - 1.0).powi(2);
            // Above the keel, where dy/dz is infinite.
            assert!(p[2] < keel + 0.02 || (p[1] - body(p[0], p[2])).abs() < 1e-5, "{cut:?} {p:?}");
        }
    }
    let table = OffsetTable::with_defaults(&hull);
    for station in &table.stations {
        let xi = 2.0 * station.station.x / LENGTH - 1.0;
        near(station.keel_height.unwrap(), ROCKER * xi * xi, 1e-9, "keel");
        for (&z, cell) in table.waterlines.iter().zip(&station.half_breadths) {
            let y = body(station.station.x, z);
            assert!((cell.value().unwrap_or(0.0) - y).abs() < 1e-7, "{} {z} {cell:?} {y}", station.station.x);
        }
    }
}

/// A mixed chart bent by `bend`, each within 1.
fn bent(bend: &[f64]) -> Hull {
    let (u, v) = (KnotVector::uniform(3, 3).unwrap(), KnotVector::uniform(3, 2).unwrap());
    let (gu, gv) = (u.greville(), v.greville());
    let mut points = Vec::new();
    for (i, &s) in gu.iter().enumerate() {
        for (j, &t) in gv.iter().enumerate() {
            let at = |k: usize| bend[(5 * i + j + 7 * k) % bend.len()];
            let keel = 1.5 * (2.0 * s - 1.0).powi(2);
            let x = 50.0 * s + 0.8 * at(0) + 2.0 * t * (2.0 * s - 1.0);
            let z = keel + (6.0 - keel) * t + 0.15 * at(1);
            points.push([x, 4.0 * (1.0 - 0.8 * (2.0 * s - 1.0).powi(2)) * (0.2 + t) * (1.0 + 0.1 * at(2)), z]);
        }
    }
    let surface = BsplineSurface::new(u, v, points).unwrap();
    Hull::new("bent", particulars(50.0, 10.0, 3.0, 6.0), surface, level_deck(50.0, 6.15)).unwrap()
}

/// Integral over the parameters below the draught by composite rules that know nothing of knots or pieces.
fn brute(hull: &Hull, draught: f64, kernel: fn(f64, f64) -> f64) -> f64 {
    midpoint(0.0, 1.0, 1500, |u| {
        let height = |v: f64| hull.surface().eval(u, v)[2];
        let (mut low, mut high) = (0.0, 1.0);
        if height(1.0) > draught {
            for _ in 0..50 {
                let middle = 0.5 * (low + high);
                if height(middle) < draught { low = middle } else { high = middle }
            }
        }
        midpoint(0.0, high, 120, |v| {
            let at = hull.surface().tangents(u, v);
            let jacobian = at.du[0] * at.dv[2] - at.dv[0] * at.du[2];
            2.0 * at.point[1] * jacobian * kernel(at.point[0], at.point[2])
        })
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(16))]

    #[test]
    fn functionals_on_random_charts(bend in prop::collection::vec(-1.0..1.0f64, 23), draught in 0.4..6.3f64) {
        let hull = bent(&bend);
        let row = row(&hull, draught);
        for (functional, kernel, value) in [
            (Functional::Volume, (|_, _| 1.0) as fn(f64, f64) -> f64, row.displacement_volume),
            (Functional::LongitudinalMoment, |x, _| x, row.lcb.unwrap() * row.displacement_volume),
            (Functional::VerticalMoment, |_, z| z, row.kb.unwrap() * row.displacement_volume),
        ] {
            let (found, expected) = (functional.value(&hull, draught), brute(&hull, draught, kernel));
            let net = functional.row(&hull, draught);
            let product: f64 = net.iter().zip(hull.surface().points()).map(|(r, p)| r * p[1]).sum();
            prop_assert!((product - found).abs() <= 1e-12 * found.abs());
            // The deck at 6.15 m never cuts: the upper edge is about 6 m high.
            if hull.top() <= 6.15 {
                prop_assert!((found - expected).abs() <= 3e-4 * expected, "{:?} {} {}", functional, found, expected);
            }
            prop_assert!((found - value).abs() <= 1e-8 * value, "{:?} {} {}", functional, found, value);
        }
        // dV/dT is the waterplane area, its moment about x = 0 that of the volume.
        let step = 1e-4;
        let slope = |f: Functional| (f.value(&hull, draught + step) - f.value(&hull, draught - step)) / (2.0 * step);
        if draught < 5.8 {
            for (volume, plane) in
                [(Functional::Volume, Functional::WaterplaneArea), (Functional::LongitudinalMoment, Functional::WaterplaneMoment)]
            {
                let (a, b) = (slope(volume), plane.value(&hull, draught));
                prop_assert!((a - b).abs() <= 2e-5 * b.abs(), "{:?} {} {}", plane, a, b);
            }
        }
        // The volume aft of midship is that of the sections.
        let halves = row.prismatic_coefficient_fore.zip(row.prismatic_coefficient_aft);
        if let Some((fore, aft)) = halves.filter(|_| draught < 5.8) {
            let sections = |from: f64, to: f64| {
                midpoint(from, to, 600, |x| Functional::SectionArea { x }.value(&hull, draught))
            };
            let (run, entrance) = (sections(-4.0, 25.0), sections(25.0, 54.0));
            prop_assert!((run / entrance - aft / fore).abs() < 1e-4 * aft / fore, "{} {} {} {}", run, entrance, aft, fore);
        }
    }
}
