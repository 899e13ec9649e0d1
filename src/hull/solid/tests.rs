use super::*;
use crate::hull::PrincipalParticulars;

/// A barge: x = 60 u, y = 5 everywhere, z = 4 v, or with ends that close; every region but what has no breadth.
fn hull(transom: bool, bow: bool, sheer: f64) -> Hull {
    let (u, v) = (KnotVector::uniform(2, 3).unwrap(), KnotVector::uniform(2, 2).unwrap());
    let rows = u.basis_count();
    let mut points = Vec::new();
    for (i, s) in u.greville().into_iter().enumerate() {
        for t in v.greville() {
            let closed = (i == 0 && !transom) || (i + 1 == rows && !bow);
            points.push([60.0 * s, if closed { 0.0 } else { 5.0 * (0.6 + 0.4 * t) }, 4.0 * t]);
        }
    }
    let line = KnotVector::uniform(2, 1).unwrap();
    let deck = BsplineCurve::new(line, vec![[0.0, 4.0], [30.0, 4.0 - 2.0 * sheer], [60.0, 4.0]]).unwrap();
    let particulars =
        PrincipalParticulars { length_between_perpendiculars: 60.0, breadth: 10.0, draught: Some(3.0), depth: 4.0 };
    Hull::new("barge", particulars, BsplineSurface::new(u, v, points).unwrap(), deck).unwrap()
}

fn regions(solid: &Solid) -> Vec<Region> {
    solid.faces.iter().map(|face| face.region).collect()
}

#[test]
fn every_edge_has_two_faces() {
    use Region::{Bottom, Bow, Deck, Hull, Transom};
    for (transom, bow, expected) in [
        (true, true, vec![Hull, Hull, Bottom, Bow, Deck, Transom]),
        (true, false, vec![Hull, Hull, Bottom, Deck, Transom]),
        (false, false, vec![Hull, Hull, Bottom, Deck]),
    ] {
        let solid = Solid::new(&hull(transom, bow, 0.0)).unwrap();
        assert!(
            solid.is_closed(),
            "{transom} {bow}: {:?}",
            solid.faces.iter().map(|f| &f.boundary).collect::<Vec<_>>()
        );
        assert_eq!(regions(&solid), expected);
        // Euler's formula for a body without holes.
        let (v, e, f) = (solid.vertices.len(), solid.edges.len(), solid.faces.len());
        assert_eq!(v + f, e + 2, "{v} {e} {f}");
        assert!(solid.deviation.abs() < 1e-300);
    }
}

#[test]
fn loops_run_from_edge_to_edge() {
    let solid = Solid::new(&hull(true, false, 0.0)).unwrap();
    for face in &solid.faces {
        let ends: Vec<[usize; 2]> = face
            .boundary
            .iter()
            .map(|&(edge, along)| {
                let edge = &solid.edges[edge];
                if along { [edge.from, edge.to] } else { [edge.to, edge.from] }
            })
            .collect();
        for k in 0..ends.len() {
            assert_eq!(ends[k][1], ends[(k + 1) % ends.len()][0], "{}", face.name);
        }
        for &(edge, _) in &face.boundary {
            let edge = &solid.edges[edge];
            let points = edge.curve.points();
            assert!(apart(points[0], solid.vertices[edge.from]) < 1e-9);
            assert!(apart(points[points.len() - 1], solid.vertices[edge.to]) < 1e-9);
        }
    }
}

#[test]
fn normals_point_out() {
    let solid = Solid::new(&hull(true, true, 0.0)).unwrap();
    let centre = [30.0, 0.0, 2.0];
    for face in &solid.faces {
        let ((a, b), (c, d)) = (face.surface.u().domain(), face.surface.v().domain());
        let at = face.surface.derivatives::<2>(0.5 * (a + b), 0.5 * (c + d));
        let (p, q) = (at[1][0], at[0][1]);
        let normal = [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]];
        let out: f64 = (0..3).map(|k| normal[k] * (at[0][0][k] - centre[k])).sum();
        assert!(out > 0.0, "{}: {normal:?}", face.name);
    }
}

#[test]
fn below_a_deck_that_cuts_the_surface_the_sides_have_topsides() {
    // The deck crosses the knot line at mid-depth with the larger sheer, and stays above it with the smaller.
    for (sheer, allowed) in [(0.4, 1e-8), (1.3, 1e-4)] {
        let hull = hull(true, true, sheer);
        let solid = Solid::new(&hull).unwrap();
        assert!(solid.is_closed());
        assert!(solid.deviation > 0.0 && solid.deviation < allowed, "{:e}", solid.deviation);
        let (v, e, f) = (solid.vertices.len(), solid.edges.len(), solid.faces.len());
        assert_eq!(v + f, e + 2, "{v} {e} {f}");
        let sides: Vec<&str> = solid.faces.iter().take(4).map(|face| face.name.as_str()).collect();
        if sheer < 1.0 {
            assert_eq!(sides, ["hull port", "hull starboard", "topsides port", "topsides starboard"]);
        }
        let exact = crate::hull::whole_volume(&hull);
        assert!((solid.volume() / exact - 1.0).abs() < allowed, "{} for {exact}", solid.volume());
        let deck = solid.faces.iter().find(|face| face.region == Region::Deck).unwrap();
        let (a, b) = deck.surface.u().domain();
        let middle = deck.surface.eval(0.5 * (a + b), 0.5);
        assert!((middle[2] - (4.0 - sheer)).abs() < allowed, "{middle:?}");
    }
}

#[test]
fn a_solid_has_the_volume_of_its_hull() {
    for (transom, bow) in [(true, true), (true, false), (false, false)] {
        let hull = hull(transom, bow, 0.0);
        let solid = Solid::new(&hull).unwrap();
        let exact = crate::hull::whole_volume(&hull);
        assert!((solid.volume() / exact - 1.0).abs() < 1e-13, "{} for {exact}", solid.volume());
    }
}

#[test]
fn a_surface_that_crosses_the_centreplane_gives_faces_that_do_not() {
    let (u, v) = (KnotVector::uniform(2, 2).unwrap(), KnotVector::uniform(1, 2).unwrap());
    let mut points = Vec::new();
    for (i, &s) in u.greville().iter().enumerate() {
        for (j, &t) in v.greville().iter().enumerate() {
            // One point of the net beyond the centreplane.
            let y = if (i, j) == (1, 0) { -0.2 } else { 4.0 * t };
            points.push([60.0 * s, y, 4.0 * t]);
        }
    }
    let deck = BsplineCurve::new(KnotVector::uniform(1, 1).unwrap(), vec![[0.0, 4.0], [60.0, 4.0]]).unwrap();
    let particulars =
        PrincipalParticulars { length_between_perpendiculars: 60.0, breadth: 10.0, draught: Some(3.0), depth: 4.0 };
    let hull = Hull::new("dip", particulars, BsplineSurface::new(u, v, points).unwrap(), deck).unwrap();
    let solid = Solid::new(&hull).unwrap();
    assert!(solid.is_closed());
    assert!(solid.deviation > 0.05 && solid.deviation < 0.2, "{}", solid.deviation);
    let port = solid.faces.iter().find(|face| face.name == "hull port").unwrap();
    assert!(port.surface.points().iter().all(|point| point[1] >= 0.0));
}

#[test]
fn areas_are_those_of_closed_forms() {
    // Sides that flare by half of their height, a trapezium at each end, flat deck and bottom.
    let barge = Solid::new(&hull(true, true, 0.0)).unwrap();
    let exact = 2.0 * 60.0 * 4.0 * 1.25_f64.sqrt() + 60.0 * 6.0 + 60.0 * 10.0 + 2.0 * 4.0 * 0.5 * (6.0 + 10.0);
    assert!((barge.area() / exact - 1.0).abs() < 1e-12, "{} for {exact}", barge.area());
    // A wall-sided parabola of length L, half-breadth b and height h: two walls, deck and bottom. The length of its arc
    // is sqrt(L^2 + 16 b^2) / 2 + L^2 / (8 b) asinh(4 b / L).
    let (long, b, h) = (60.0, 5.0, 4.0);
    let (u, v) = (KnotVector::uniform(2, 2).unwrap(), KnotVector::uniform(1, 1).unwrap());
    let mut points = Vec::new();
    for i in 0..u.basis_count() {
        let [s, t] = [u.knots()[i + 1], u.knots()[i + 2]];
        let y = b * (2.0 * (s + t) - 4.0 * s * t);
        points.extend([[0.5 * long * (s + t), y, 0.0], [0.5 * long * (s + t), y, h]]);
    }
    let deck = BsplineCurve::new(KnotVector::uniform(1, 1).unwrap(), vec![[0.0, h], [long, h]]).unwrap();
    let particulars =
        PrincipalParticulars { length_between_perpendiculars: long, breadth: 2.0 * b, draught: Some(3.0), depth: h };
    let parabola = Hull::new("parabola", particulars, BsplineSurface::new(u, v, points).unwrap(), deck).unwrap();
    let arc = 0.5 * (long * long + 16.0 * b * b).sqrt() + long * long / (8.0 * b) * (4.0 * b / long).asinh();
    let exact = 2.0 * h * arc + 2.0 * (4.0 / 3.0) * long * b;
    let area = Solid::new(&parabola).unwrap().area();
    assert!((area / exact - 1.0).abs() < 1e-10, "{area} for {exact}");
}
