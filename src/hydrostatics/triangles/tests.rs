use super::*;
use crate::hull::{Hull, HullMesh};
use crate::spline::{BsplineCurve, BsplineSurface, KnotVector};
use proptest::prelude::*;

fn particulars() -> PrincipalParticulars {
    PrincipalParticulars { length_between_perpendiculars: 100.0, breadth: 8.0, draught: Some(4.0), depth: 6.0 }
}

fn rows(mesh: &TriangleMesh, draughts: &[f64]) -> Vec<Hydrostatics> {
    CurvesOfForm::of_triangles(mesh, None, &particulars(), draughts, &Conventions::default()).rows
}

fn mesh(hull: &HullMesh) -> TriangleMesh {
    TriangleMesh { vertices: hull.vertices.clone(), triangles: hull.triangles.iter().map(|(_, t)| *t).collect() }
}

/// x = 100 u, y = 4 (1 - (2u - 1)^2) by its blossom, z = 6 v: wall-sided.
fn parabolic() -> Hull {
    let (u, v) = (KnotVector::uniform(2, 2).unwrap(), KnotVector::uniform(1, 3).unwrap());
    let mut points = Vec::new();
    for i in 0..u.basis_count() {
        let [a, b] = [u.knots()[i + 1], u.knots()[i + 2]];
        for t in v.greville() {
            points.push([50.0 * (a + b), 8.0 * (a + b - 2.0 * a * b), 6.0 * t]);
        }
    }
    let deck = BsplineCurve::new(KnotVector::uniform(1, 1).unwrap(), vec![[-1.0, 6.0], [101.0, 6.0]]).unwrap();
    Hull::new("parabolic", particulars(), BsplineSurface::new(u, v, points).unwrap(), deck).unwrap()
}

/// A prism of the outline (y, z) of port, from the keel up, over 0 <= x <= 100, with ends and deck.
fn prism(outline: &[[f64; 2]]) -> TriangleMesh {
    let at = |x: f64, k: usize, side: f64| [x, side * outline[k][0], outline[k][1]];
    let last = outline.len() - 1;
    let mut corners = Vec::new();
    let mut quad = |p: [[f64; 3]; 4]| corners.extend([[p[0], p[1], p[2]], [p[0], p[2], p[3]]]);
    for k in 0..last {
        quad([at(0.0, k, 1.0), at(0.0, k + 1, 1.0), at(100.0, k + 1, 1.0), at(100.0, k, 1.0)]);
        quad([at(0.0, k, -1.0), at(100.0, k, -1.0), at(100.0, k + 1, -1.0), at(0.0, k + 1, -1.0)]);
        quad([at(0.0, k, -1.0), at(0.0, k + 1, -1.0), at(0.0, k + 1, 1.0), at(0.0, k, 1.0)]);
        quad([at(100.0, k, -1.0), at(100.0, k, 1.0), at(100.0, k + 1, 1.0), at(100.0, k + 1, -1.0)]);
    }
    quad([at(0.0, last, -1.0), at(100.0, last, -1.0), at(100.0, last, 1.0), at(0.0, last, 1.0)]);
    if outline[0][0] > 0.0 {
        quad([at(0.0, 0, -1.0), at(0.0, 0, 1.0), at(100.0, 0, 1.0), at(100.0, 0, -1.0)]);
    }
    TriangleMesh::from_corners(corners.into_iter())
}

#[test]
fn a_box_has_its_closed_forms_also_on_rows_of_vertices() {
    let mesh = prism(&[[4.0, 0.0], [4.0, 2.0], [4.0, 4.0], [4.0, 6.0]]);
    assert!(mesh.report().closed);
    let draughts = [4.0, 2.0, 3.3, 0.5, 6.0];
    for (row, t) in rows(&mesh, &draughts).iter().zip(draughts) {
        let close = |a: f64, b: f64| assert!((a - b).abs() <= 1e-8 * b.abs().max(1.0), "{a} for {b} at {t}: {row:?}");
        close(row.displacement_volume, 800.0 * t);
        close(row.lcb.unwrap(), 50.0);
        close(row.kb.unwrap(), 0.5 * t);
        close(row.wetted_surface, 800.0 + 200.0 * t + 16.0 * t);
        close(row.midship_section_area, 8.0 * t);
        close(row.maximum_section_area, 8.0 * t);
        close(row.transom_area, 8.0 * t);
        close(row.lateral_area, 100.0 * t);
        close(row.lateral_centre_z.unwrap(), 0.5 * t);
        close(row.prismatic_coefficient_aft.unwrap(), 1.0);
        {
            close(row.waterplane_area, 800.0);
            close(row.lcf.unwrap(), 50.0);
            close(row.transverse_inertia, 100.0 * 512.0 / 12.0);
            close(row.longitudinal_inertia, 8.0 * 1e6 / 12.0);
            close(row.waterline_length, 100.0);
            close(row.waterline_breadth, 8.0);
            assert_eq!(row.remark, None);
        }
    }
    let above = rows(&mesh, &[6.5]).remove(0);
    assert!(above.waterplane_area.abs() < 1e-12 && above.remark.is_some());
    assert!((above.displacement_volume - 4800.0).abs() < 1e-9);
}

#[test]
fn a_prism_with_rise_of_floor_is_exact() {
    // y = z up to 4 m, then wall-sided.
    let mesh = prism(&[[0.0, 0.0], [4.0, 4.0], [4.0, 6.0]]);
    for (row, t) in rows(&mesh, &[1.0, 4.0, 5.0]).iter().zip([1.0_f64, 4.0, 5.0]) {
        let y = t.min(4.0);
        let area = y * y + 8.0 * (t - y);
        assert!((row.displacement_volume - 100.0 * area).abs() < 1e-10);
        let moment = 2.0 * y.powi(3) / 3.0 + 8.0 * 0.5 * (t * t - y * y);
        assert!((row.kb.unwrap() - moment / area).abs() < 1e-12);
        assert!((row.transverse_inertia - 100.0 * (2.0 * y).powi(3) / 12.0).abs() < 1e-9);
        assert!((row.maximum_section_area - area).abs() < 1e-12);
    }
}

#[test]
fn the_mesh_of_a_hull_has_its_hydrostatics() {
    let hull = parabolic();
    let draughts = [0.7, 2.0, 4.0, 5.5];
    let exact = CurvesOfForm::new(&hull, &draughts, &Conventions::default()).rows;
    let found = rows(&mesh(&HullMesh::new(&hull, 1e-3, 2).unwrap()), &draughts);
    for (a, b) in found.iter().zip(&exact) {
        for (x, y) in [
            (a.displacement_volume, b.displacement_volume),
            (a.waterplane_area, b.waterplane_area),
            (a.wetted_surface, b.wetted_surface),
            (a.kb.unwrap(), b.kb.unwrap()),
            (a.lcb.unwrap(), b.lcb.unwrap()),
            (a.transverse_inertia, b.transverse_inertia),
            (a.longitudinal_inertia, b.longitudinal_inertia),
            (a.midship_section_area, b.midship_section_area),
            (a.maximum_section_area, b.maximum_section_area),
            (a.lateral_area, b.lateral_area),
            (a.block_coefficient.unwrap(), b.block_coefficient.unwrap()),
        ] {
            assert!((x / y - 1.0).abs() < 1e-3, "{x} for {y} at {}", a.draught);
        }
    }
}

#[test]
fn a_missing_deck_and_a_missing_transom_do_not_matter_below() {
    let whole = prism(&[[0.0, 0.0], [4.0, 4.0], [4.0, 6.0]]);
    let kept = whole.corners().filter(|t| t.iter().any(|p| p[2] < 6.0) && t.iter().any(|p| p[0] > 0.0));
    let open = TriangleMesh::from_corners(kept.collect::<Vec<_>>().into_iter());
    assert!(!open.report().closed);
    let (a, b) = (rows(&whole, &[3.0]).remove(0), rows(&open, &[3.0]).remove(0));
    assert!((a.displacement_volume - b.displacement_volume).abs() < 1e-10 && a.lcb == b.lcb && a.kb == b.kb);
    assert!(
        (a.waterplane_area - b.waterplane_area).abs() < 1e-10
            && (a.transverse_inertia - b.transverse_inertia).abs() < 1e-9
    );
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]

    /// Volumes are continuous and their slope is the waterplane, also where draughts meet vertices; rows do not depend
    /// on each other.
    #[test]
    fn rows_are_continuous_and_independent(steps in prop::collection::vec(0.1..1.5_f64, 3..8), y in prop::collection::vec(0.5..5.0_f64, 9)) {
        let mut z = 0.0;
        let outline: Vec<[f64; 2]> = std::iter::once([y[8], 0.0]).chain(steps.iter().zip(&y).map(|(step, &y)| { z += step; [y, z] })).collect();
        let mesh = prism(&outline);
        for at in &outline[1..outline.len() - 1] {
            let t = at[1];
            let three = rows(&mesh, &[t - 1e-6, t, t + 1e-6]);
            let one = rows(&mesh, &[t]).remove(0);
            prop_assert!((three[1].displacement_volume / one.displacement_volume - 1.0).abs() < 1e-12);
            prop_assert!((three[1].kb.unwrap() / one.kb.unwrap() - 1.0).abs() < 1e-12);
            let slope = (three[2].displacement_volume - three[0].displacement_volume) / 2e-6;
            prop_assert!((slope / one.waterplane_area - 1.0).abs() < 1e-4, "{} for {}", slope, one.waterplane_area);
            prop_assert!((one.waterplane_area - 200.0 * at[0]).abs() < 1e-9 * one.waterplane_area);
        }
    }
}
