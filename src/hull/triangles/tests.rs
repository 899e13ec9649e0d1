use super::*;
use crate::spline::{BsplineSurface, KnotVector};

/// A box 0 <= x <= 4, |y| <= 1, 0 <= z <= 2, two triangles a face.
pub(super) fn brick() -> TriangleMesh {
    let p = |k: usize| {
        [if k & 1 == 0 { 0.0 } else { 4.0 }, if k & 2 == 0 { -1.0 } else { 1.0 }, if k & 4 == 0 { 0.0 } else { 2.0 }]
    };
    let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    TriangleMesh::from_corners(quads.into_iter().flat_map(|[a, b, c, d]| [[p(a), p(b), p(c)], [p(a), p(c), p(d)]]))
}

#[test]
fn equal_corners_are_one_vertex() {
    let mesh = brick();
    assert_eq!((mesh.vertices.len(), mesh.triangles.len()), (8, 12));
    let report = mesh.report();
    assert!(report.closed && (report.volume - 16.0).abs() < 1e-14, "{report:?}");
    assert_eq!(mesh.bounds(), Some([[0.0, -1.0, 0.0], [4.0, 1.0, 2.0]]));
    let odd = [[[0.0; 3], [1.0, 0.0, 0.0], [0.0; 3]], [[f64::NAN; 3], [1.0, 0.0, 0.0], [0.0; 3]]];
    assert_eq!(TriangleMesh::from_corners(odd.into_iter()).triangles.len(), 0);
}

#[test]
fn triangles_are_turned_outward() {
    let mesh = brick();
    let mut wrong = mesh.clone();
    for k in [0, 3, 4, 9, 11] {
        wrong.triangles[k].swap(0, 1);
    }
    let (right, turned) = wrong.oriented();
    assert_eq!(turned, 5);
    assert!(right.report().closed && (right.report().volume - 16.0).abs() < 1e-14);
    let mut inward = mesh.clone();
    inward.triangles.iter_mut().for_each(|t| t.swap(0, 1));
    assert_eq!(inward.oriented().1, 12);
    assert_eq!(mesh.clone().oriented(), (mesh, 0));
}

#[test]
fn half_a_body_is_mirrored_without_its_middle() {
    let mesh = brick();
    let half = TriangleMesh::from_corners(
        mesh.corners().map(|t| t.map(|[x, y, z]| [x, 0.5 * (y + 1.0), z])).collect::<Vec<_>>().into_iter(),
    );
    assert_eq!([half.part(), mesh.part()], [BodyPart::ClosedBeside, BodyPart::Whole]);
    let report_of = |half: &TriangleMesh, slack: f64| {
        let whole = half.mirrored(slack);
        assert!(whole.open_edges().is_empty() && whole.part() == BodyPart::Whole);
        whole.report()
    };
    let report = report_of(&half, 0.0);
    assert!(report.closed && report.open_edges == 0 && (report.volume - 16.0).abs() < 1e-12, "{report:?}");
    // Without the wall, its inner edge 5 mm off the centreplane to either side.
    for inner in [0.005, -0.005] {
        let moved = |[x, y, z]: [f64; 3]| [x, if y == 0.0 { inner } else { y }, z];
        let open = half.corners().filter(|t| t.iter().any(|point| point[1] != 0.0)).map(|t| t.map(moved));
        let open = TriangleMesh::from_corners(open.collect::<Vec<_>>().into_iter());
        assert_eq!(open.part(), BodyPart::Half { inner });
        assert!((report_of(&open, 0.006).volume - 16.0).abs() < 1e-12);
    }
}

#[test]
fn planes_through_vertices_cut_closed_loops() {
    let mesh = brick();
    for x in [1e-9, 1.0, 4.0] {
        let lines = mesh.section(x);
        assert_eq!(lines.len(), 1, "{x}");
        assert!(lines[0].closed && (lines[0].area() - 4.0).abs() < 1e-14, "{x}: {lines:?}");
        assert_eq!(lines[0].thinned(1e-9).points.len(), 4, "{x}: {lines:?}");
    }
    assert!(mesh.section(0.0).is_empty() && mesh.section(4.1).is_empty());
}

#[test]
fn sections_of_an_open_mesh_are_open() {
    let mesh = brick();
    // Without its deck.
    let open = TriangleMesh::from_corners(
        mesh.corners().filter(|t| t.iter().any(|p| p[2] < 1.0)).collect::<Vec<_>>().into_iter(),
    );
    assert_eq!(open.open_edges().len(), 4);
    let lines = open.section(2.0);
    assert_eq!(lines.len(), 1);
    let ends = [lines[0].points[0], lines[0].points[lines[0].points.len() - 1]];
    assert!(!lines[0].closed && ends.iter().all(|p| p[1] > 1.9), "{lines:?}");
}

/// Half a cylinder of radius 2 along x, as a rational surface.
fn cylinder() -> BsplineSurface<4> {
    let (u, v) = (KnotVector::uniform(1, 1).unwrap(), KnotVector::uniform(2, 2).unwrap());
    let v = KnotVector::from_breakpoints(2, &v.breakpoints(), &[2]).unwrap();
    let half = std::f64::consts::FRAC_1_SQRT_2;
    let arc = [[0.0, -2.0, 1.0], [2.0, -2.0, half], [2.0, 0.0, 1.0], [2.0, 2.0, half], [0.0, 2.0, 1.0]];
    let points = [0.0, 10.0].iter().flat_map(|&x| arc.map(|[y, z, w]| [w * x, w * y, w * z, w])).collect();
    BsplineSurface::new(u, v, points).unwrap()
}

#[test]
fn rational_surfaces_are_met_within_the_deviation() {
    let mut last = f64::NAN;
    for times in [1, 2] {
        let mesh = TriangleMesh::of_surfaces(&[cylinder()], 1e-3, times);
        let bounds = mesh.bounds().unwrap();
        assert!((bounds[1][1] - 2.0).abs() < 1e-12 && (bounds[0][2] + 2.0).abs() < 1e-12, "{bounds:?}");
        let mut worst = 0.0_f64;
        for [a, b, c] in mesh.corners() {
            for (p, q) in [(a, b), (b, c), (c, a)] {
                worst = worst.max(2.0 - (0.5 * (p[1] + q[1])).hypot(0.5 * (p[2] + q[2])));
            }
        }
        assert!(worst < 1.2e-3 / (times * times) as f64, "{worst:e}");
        assert!(last.is_nan() || (worst / last - 0.25).abs() < 0.02, "{worst:e} after {last:e}");
        last = worst;
        assert!((mesh.mirrored(0.0).report().area / (20.0 * 2.0 * std::f64::consts::PI) - 1.0).abs() < 1e-3);
    }
}
