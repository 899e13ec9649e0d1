use super::*;

fn volume(mesh: &TriangleMesh) -> f64 {
    mesh.report().volume
}

/// A cube of side 2 about the origin with faces of four corners, sharp or smooth.
fn cube(crease: bool) -> SubdivisionNet {
    let points = (0..8_u8).map(|k| {
        let side = |bit: u8| if k & bit == 0 { -1.0 } else { 1.0 };
        ([side(1), side(2), side(4)], NetPointKind::Regular)
    });
    let faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let mut edges: Vec<(usize, usize)> = faces.iter().flat_map(|face| sides(face).collect::<Vec<_>>()).collect();
    edges.sort_unstable();
    edges.dedup();
    SubdivisionNet {
        points: points.collect(),
        edges: edges.into_iter().map(|(a, b)| NetEdge { ends: [a, b], crease }).collect(),
        faces: faces.iter().map(|face| NetFace { corners: face.to_vec(), layer: 0 }).collect(),
        layers: vec![NetLayer { name: "all".to_owned(), colour: 0, symmetric: false, in_hydrostatics: true }],
    }
}

#[test]
fn a_cube_with_creases_stays_a_cube() {
    let [coarse, fine] = cube(true).meshes(10_000, 3);
    for mesh in [&coarse, &fine] {
        assert!(mesh.report().closed);
        assert!((volume(mesh) - 8.0).abs() < 1e-12);
    }
    assert_eq!(fine.triangles.len(), 4 * coarse.triangles.len());
}

#[test]
fn a_smooth_cube_is_the_surface_of_catmull_and_clark() {
    // One step moves a point of three faces to (Q + 2R + 0 S)/3 with Q = p/2... : p 5/9, by their rule.
    let first = Level::of(&cube(false)).split().averaged();
    for (point, _) in cube(false).points {
        let wanted = point.map(|c| c * 5.0 / 9.0);
        assert!(first.points.iter().any(|p| minus(*p, wanted).iter().all(|c| c.abs() < 1e-14)), "{wanted:?}");
    }
    // Halving falls by four, so that two sums are extrapolated.
    let volumes: Vec<f64> = (2..6).map(|k| volume(&cube(false).meshes(1 << 20, k)[1])).collect();
    let steps: Vec<f64> = volumes.windows(2).map(|pair| pair[1] - pair[0]).collect();
    for pair in steps.windows(2) {
        assert!((3.5..4.5).contains(&(pair[0] / pair[1])), "{volumes:?}");
    }
}

#[test]
fn triangles_follow_loop() {
    // An octahedron: four triangles at each point. The point of Loop's rule is 5/8 of it, neighbours adding to zero
    // about it: (1 - n b) p + b sum, b = (5/8 - (3/8 + cos(2 pi/4)/4)^2)/4.
    let points =
        [[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, 1.0], [0.0, 0.0, -1.0]];
    let faces = [[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]];
    let net = SubdivisionNet {
        points: points.iter().map(|&p| (p, NetPointKind::Regular)).collect(),
        edges: Vec::new(),
        faces: faces.iter().map(|face| NetFace { corners: face.to_vec(), layer: 0 }).collect(),
        layers: Vec::new(),
    };
    let first = Level::of(&net).split().averaged();
    let beta = (0.625 - 0.375_f64 * 0.375) / 4.0;
    assert!((first.points[0][0] - (1.0 - 4.0 * beta)).abs() < 1e-14, "{:?}", first.points[0]);
}

#[test]
fn the_net_of_a_hull_is_closed_and_has_its_volume() {
    use crate::hull::{Functional, Hull, PrincipalParticulars};
    use crate::spline::{BsplineCurve, BsplineSurface, KnotVector};
    // x = 60 u, z = 4 v, y = 5 (0.6 + 0.4 v) cos-like along: a bow that closes, a transom, a flat bottom.
    let (u, v) = (KnotVector::uniform(3, 4).unwrap(), KnotVector::uniform(3, 2).unwrap());
    let mut points = Vec::new();
    for s in u.greville() {
        for t in v.greville() {
            points.push([60.0 * s, 5.0 * (0.6 + 0.4 * t) * (1.0 - s * s * s), 4.0 * t]);
        }
    }
    let deck = BsplineCurve::new(KnotVector::uniform(1, 1).unwrap(), vec![[0.0, 4.0], [60.0, 4.0]]).unwrap();
    let particulars =
        PrincipalParticulars { length_between_perpendiculars: 60.0, breadth: 10.0, draught: Some(3.0), depth: 4.0 };
    let hull = Hull::new("half", particulars, BsplineSurface::new(u, v, points).unwrap(), deck).unwrap();
    let (net, deviation) = SubdivisionNet::of_hull(&hull, 1e-3);
    assert!(deviation <= 1e-3, "{deviation}");
    assert_eq!(
        net.layers.iter().map(|layer| layer.name.as_str()).collect::<Vec<_>>(),
        ["hull", "bottom", "transom", "deck"]
    );
    let [coarse, fine] = net.meshes(60_000, 5);
    assert!(fine.report().closed, "{:?}", fine.report());
    let exact = Functional::Volume.value(&hull, 10.0);
    let found = (4.0 * volume(&fine) - volume(&coarse)) / 3.0;
    assert!((found / exact - 1.0).abs() < 2e-4, "{found} for {exact}");
}
