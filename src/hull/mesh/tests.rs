use super::*;
use crate::hull::PrincipalParticulars;
use crate::spline::{BsplineCurve, BsplineSurface, KnotVector};

/// x = 100 u, y = 4 (1 - (2u - 1)^2) v^(1/1), z = 6 v: V = 2 int int y dx dz = 2 * 4 * (2/3) * 100 * 6 / 2.
fn parabolic(sheer: f64) -> Hull {
    let (u, v) = (KnotVector::uniform(2, 2).unwrap(), KnotVector::uniform(1, 3).unwrap());
    // 1 - (2u - 1)^2 = 4 u (1 - u), by its blossom over the knots.
    let mut points = Vec::new();
    for i in 0..u.basis_count() {
        let [a, b] = [u.knots()[i + 1], u.knots()[i + 2]];
        let y = 4.0 * (2.0 * (a + b) - 4.0 * a * b);
        for t in v.greville() {
            points.push([50.0 * (a + b), y * t, 6.0 * t]);
        }
    }
    let line = KnotVector::uniform(2, 1).unwrap();
    let deck = BsplineCurve::new(line, vec![[0.0, 6.0], [50.0, 6.0 - 2.0 * sheer], [100.0, 6.0]]).unwrap();
    let particulars =
        PrincipalParticulars { length_between_perpendiculars: 100.0, breadth: 8.0, draught: Some(4.0), depth: 6.0 };
    Hull::new("parabolic", particulars, BsplineSurface::new(u, v, points).unwrap(), deck).unwrap()
}

#[test]
fn a_mesh_is_closed_mirrored_and_of_the_right_volume() {
    let hull = parabolic(0.0);
    let exact = 2.0 * 4.0 * (2.0 / 3.0) * 100.0 * 6.0 / 2.0;
    assert!((whole_volume(&hull) / exact - 1.0).abs() < 1e-12);
    let mut last = f64::NAN;
    for deviation in [0.1, 0.025, 0.00625] {
        let mesh = HullMesh::new(&hull, deviation, 4).unwrap();
        let report = mesh.report();
        assert!(report.closed && report.open_edges == 0, "{report:?}");
        let error = (report.volume / exact - 1.0).abs();
        // Volume falls with the deviation: second order in the length of edges.
        assert!(error < 0.5 * deviation, "{error:e} at {deviation}");
        assert!(last.is_nan() || error < 0.35 * last || error < 0.1 * deviation, "{error:e} after {last:e}");
        last = error;
        for vertex in &mesh.vertices {
            let other = [vertex[0], 0.0 - vertex[1], vertex[2]];
            assert!(mesh.vertices.contains(&other), "{vertex:?}");
        }
    }
}

#[test]
fn no_triangle_leaves_the_surface_by_more_than_the_deviation() {
    let hull = parabolic(0.0);
    for deviation in [0.05, 0.005] {
        let mesh = HullMesh::new(&hull, deviation, 1).unwrap();
        let mut worst = 0.0_f64;
        for (region, corners) in &mesh.triangles {
            if *region != Region::Hull {
                continue;
            }
            let [a, b, c] = corners.map(|k| mesh.vertices[k]);
            let [x, y, z] = [0, 1, 2].map(|k| (a[k] + b[k] + c[k]) / 3.0);
            worst = worst.max((hull.half_breadth(x, z).unwrap() - y.abs()).abs());
        }
        assert!(worst <= deviation && worst > 0.05 * deviation, "{worst:e} for {deviation}");
    }
}

#[test]
fn the_deck_cuts_the_surface() {
    let hull = parabolic(1.0);
    let exact = whole_volume(&hull);
    let mesh = HullMesh::new(&hull, 2e-3, 6).unwrap();
    let report = mesh.report();
    assert!(report.closed && report.open_edges == 0, "{report:?}");
    assert!((report.volume / exact - 1.0).abs() < 2e-3, "{} for {exact}", report.volume);
    // Every corner of the deck is on the deck at side.
    for vertex in mesh.triangles.iter().filter(|(region, _)| *region == Region::Deck).flat_map(|(_, corners)| corners) {
        let [x, _, z] = mesh.vertices[*vertex];
        assert!((z - hull.deck_height(x)).abs() < 1e-9, "{z} at {x}");
    }
}

#[test]
fn regions_point_outward() {
    let hull = parabolic(0.0);
    let mesh = HullMesh::new(&hull, 0.01, 3).unwrap();
    let normal = |wanted: Region| {
        let mut sum = [0.0; 3];
        for (region, corners) in mesh.triangles.iter().filter(|(region, _)| *region == wanted) {
            let [a, b, c] = corners.map(|k| mesh.vertices[k]);
            let n = cross(minus(b, a), minus(c, a));
            sum = [sum[0] + n[0], sum[1] + n[1], sum[2] + n[2]];
            assert_eq!(*region, wanted);
        }
        sum
    };
    let deck = normal(Region::Deck);
    // Twice the area of the deck, 2 * 4 * (2/3) * 100 m^2 without the error of the mesh.
    assert!(deck[2] > 0.99 * 2.0 * 1600.0 / 3.0 && deck[0].abs() < 1e-9 && deck[1].abs() < 1e-9, "{deck:?}");
    for none in [Region::Bottom, Region::Transom, Region::Bow] {
        assert!(mesh.triangles.iter().all(|(region, _)| *region != none), "{none:?}");
    }
}

#[test]
fn a_mesh_that_nobody_can_hold_is_refused() {
    let refused = HullMesh::new(&parabolic(0.0), 1e-12, 1).unwrap_err();
    assert!(refused.to_string().contains("triangles, expected at most 4000000"), "{refused}");
}
