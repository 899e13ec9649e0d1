//! Plane sections against closed forms, and their connection against brute-force root counts.

use loftsman::internals::hull::{Branch, Cut, Face, Hull, PrincipalParticulars, Section};
use loftsman::internals::spline::{BsplineCurve, BsplineSurface, Collocation, KnotVector};

const LENGTH: f64 = 100.0;
const BREADTH: f64 = 10.0;
const DRAUGHT: f64 = 6.25;

/// Half-breadth of Wigley's form, x from AP, z from the keel.
fn wigley(x: f64, z: f64) -> f64 {
    let (xi, zeta) = (2.0 * x / LENGTH - 1.0, 1.0 - z / DRAUGHT);
    0.5 * BREADTH * (1.0 - xi * xi) * (1.0 - zeta * zeta)
}

/// The hull whose surface interpolates `shape(u, v)` at the Greville sites of the knots.
fn interpolated(u: &KnotVector, v: &KnotVector, shape: impl Fn(f64, f64) -> [f64; 3]) -> Hull {
    let (su, sv) = (u.greville(), v.greville());
    let (cu, cv) = (Collocation::new(u, &su).unwrap(), Collocation::new(v, &sv).unwrap());
    let mut nets: [Vec<f64>; 3] = std::array::from_fn(|d| {
        su.iter().flat_map(|&a| sv.iter().map(move |&b| (a, b))).map(|(a, b)| shape(a, b)[d]).collect()
    });
    for net in &mut nets {
        cu.solve_tensor(&cv, net);
    }
    let columns = v.basis_count();
    // z is the same in every column to rounding; the hull asks for the same bits.
    let points: Vec<[f64; 3]> =
        (0..nets[0].len()).map(|k| [nets[0][k], nets[1][k].max(0.0), nets[2][k % columns]]).collect();
    hull(BsplineSurface::new(u.clone(), v.clone(), points).unwrap())
}

fn hull(surface: BsplineSurface<3>) -> Hull {
    let [rows, columns] = surface.shape();
    let top = surface.point(0, columns - 1)[2];
    let xs = (0..columns).flat_map(|j| [surface.point(0, j)[0], surface.point(rows - 1, j)[0]]);
    let (a, b) = xs.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| (a.min(x), b.max(x)));
    let deck = BsplineCurve::new(KnotVector::uniform(1, 1).unwrap(), vec![[a, top], [b, top]]).unwrap();
    with_deck(surface, deck)
}

fn with_deck(surface: BsplineSurface<3>, deck: BsplineCurve<2>) -> Hull {
    let particulars = PrincipalParticulars {
        length_between_perpendiculars: LENGTH,
        breadth: BREADTH,
        draught: Some(DRAUGHT),
        depth: DRAUGHT,
    };
    Hull::new("test", particulars, surface, deck).unwrap()
}

fn wigley_hull() -> Hull {
    let (u, v) = (KnotVector::uniform(3, 21).unwrap(), KnotVector::uniform(3, 11).unwrap());
    interpolated(&u, &v, |a, b| {
        let (x, z) = (LENGTH * a, DRAUGHT * b);
        [x, wigley(x, z), z]
    })
}

fn distance_to_plane(cut: Cut, p: [f64; 3]) -> f64 {
    let (n, d) = cut.plane().unwrap();
    (n[0] * p[0] + n[1] * p[1] + n[2] * p[2] - d).abs()
}

/// 200 points of a branch.
fn points(branch: &Branch) -> Vec<[f64; 3]> {
    let (a, b) = branch.curve.knots().domain();
    (0..200).map(|k| branch.curve.eval(a + (b - a) * f64::from(k) / 199.0)).collect()
}

fn sides(section: &Section) -> Vec<&Branch> {
    section.branches.iter().filter(|b| b.face == Face::Side).collect()
}

/// Largest distance of 200 points a branch from the plane and, along y, from Wigley's form.
fn deviation(section: &Section) -> f64 {
    sides(section)
        .iter()
        .flat_map(|b| points(b))
        .map(|p| distance_to_plane(section.cut, p).max((p[1] - wigley(p[0], p[2])).abs()))
        .fold(0.0, f64::max)
}

#[test]
fn every_kind_of_cut_of_wigleys_form_keeps_its_tolerance() {
    let hull = wigley_hull();
    let mut cuts: Vec<Cut> = (0..10).map(|k| Cut::Waterline { z: DRAUGHT * (f64::from(k) + 0.37) / 10.0 }).collect();
    cuts.extend((0..21).map(|k| Cut::Station { x: LENGTH * (f64::from(k) + 0.41) / 21.0 }));
    cuts.extend((0..8).map(|k| Cut::Buttock { y: 0.5 * BREADTH * (f64::from(k) + 0.3) / 8.0 }));
    cuts.extend((1..6).map(|k| Cut::Diagonal { height: f64::from(k), angle: 0.6 }));
    cuts.push(Cut::Plane { normal: [0.3, 1.0, 0.2], offset: 17.0 });
    cuts.push(Cut::Plane { normal: [0.03, -0.4, 0.7], offset: 3.0 });
    for tolerance in [1e-3, 1e-6, 1e-9] {
        for &cut in &cuts {
            let section = hull.section(cut, tolerance);
            assert_eq!(sides(&section).len(), 1, "{cut:?}");
            let found = deviation(&section);
            assert!(found <= tolerance, "{cut:?}: {found} at {tolerance}");
        }
    }
}

/// A surface over x = LENGTH u, z = DRAUGHT v with the given net of y, row by row in u.
fn sheet(u: &KnotVector, v: &KnotVector, breadths: &[f64]) -> Hull {
    let (gu, gv) = (u.greville(), v.greville());
    let points = (gu.iter().flat_map(|&a| gv.iter().map(move |&b| (a, b))).zip(breadths))
        .map(|((a, b), &y)| [LENGTH * a, y, DRAUGHT * b])
        .collect();
    hull(BsplineSurface::new(u.clone(), v.clone(), points).unwrap())
}

/// Knots on [0, 1] of the given degree; the multiplicities of interior knots come from `seeds`.
fn knots(degree: usize, seeds: &[usize]) -> KnotVector {
    let breaks: Vec<f64> = (0..seeds.len() + 2).map(|k| k as f64 / (seeds.len() + 1) as f64).collect();
    let multiplicities: Vec<usize> = seeds.iter().map(|s| 1 + s % degree).collect();
    KnotVector::from_breakpoints(degree, &breaks, &multiplicities).unwrap()
}

/// Every branch is unbroken; it closes or both its ends lie on an edge of the surface.
fn assert_connected(section: &Section) {
    for branch in sides(section) {
        let points = branch.curve.points();
        let (a, b) = (points[0], points[points.len() - 1]);
        if branch.closed {
            assert_eq!(a.map(f64::to_bits), b.map(f64::to_bits), "{:?}", section.cut);
        } else {
            for end in [a, b] {
                let gap = [end[0], LENGTH - end[0], end[2], DRAUGHT - end[2]];
                assert!(gap.iter().any(|g| g.abs() < 1e-9), "{:?} ends at {end:?}", section.cut);
            }
        }
        // No jump at a joint.
        let breaks = branch.curve.knots().breakpoints();
        for pair in breaks.windows(2) {
            let (before, at) = (branch.curve.eval(pair[1] - 1e-9 * (pair[1] - pair[0])), branch.curve.eval(pair[1]));
            let jump = (0..3).map(|d| (before[d] - at[d]).abs()).fold(0.0, f64::max);
            assert!(jump < 1e-5, "{:?}: {jump}", section.cut);
        }
    }
}

/// The places where the branches cross the line `coordinate` = `at` (0: x, 2: z), as values of the other of the two.
fn crossings_of_branches(section: &Section, coordinate: usize, at: f64) -> Vec<f64> {
    let mut places = Vec::new();
    for branch in sides(section) {
        let value = |t: f64| branch.curve.eval(t)[coordinate] - at;
        for span in branch.curve.knots().breakpoints().windows(2) {
            for k in 0..48 {
                let step = (span[1] - span[0]) / 48.0;
                let mut a = span[0] + step * f64::from(k);
                let mut b = if k == 47 { span[1] } else { span[0] + step * f64::from(k + 1) };
                if (value(a) < 0.0) == (value(b) < 0.0) {
                    continue;
                }
                let sign = value(a) < 0.0;
                for _ in 0..50 {
                    let middle = 0.5 * (a + b);
                    if (value(middle) < 0.0) == sign { a = middle } else { b = middle }
                }
                places.push(branch.curve.eval(a)[2 - coordinate]);
            }
        }
    }
    places
}

/// Compares the branches with the sign changes of the distance along one iso-line, cell by cell.
fn assert_complete(hull: &Hull, section: &Section, coordinate: usize, fraction: f64) {
    const CELLS: usize = 600;
    let (n, d) = section.cut.plane().unwrap();
    let line = if coordinate == 0 { hull.surface().curve_at_u(fraction) } else { hull.surface().curve_at_v(fraction) };
    let extent = if coordinate == 0 { DRAUGHT } else { LENGTH };
    let at = if coordinate == 0 { LENGTH * fraction } else { DRAUGHT * fraction };
    let f = |t: f64| {
        let p = line.eval(t);
        n[0] * p[0] + n[1] * p[1] + n[2] * p[2] - d
    };
    let mut counts = vec![0; CELLS];
    for place in crossings_of_branches(section, coordinate, at) {
        counts[((place / extent * CELLS as f64) as usize).min(CELLS - 1)] += 1;
    }
    for (k, count) in counts.iter().enumerate() {
        let (a, b) = (k as f64 / CELLS as f64, (k + 1) as f64 / CELLS as f64);
        let changes = usize::from((f(a) < 0.0) != (f(b) < 0.0));
        assert_eq!(count % 2, changes, "{:?}, line {coordinate} at {at}, cell {k}", section.cut);
    }
}

#[test]
fn no_branch_of_a_random_surface_is_missed_or_invented() {
    use proptest::prelude::*;
    use proptest::test_runner::{Config, TestRunner};
    let net = prop::collection::vec(0.0..5.0f64, 441);
    let seeds = (prop::collection::vec(0..4usize, 0..4), prop::collection::vec(0..4usize, 0..4));
    let plane = (0..4usize, 0.1..0.9f64, -0.5..0.5f64, -0.5..0.5f64);
    let lines = (0.01..0.99f64, 0.01..0.99f64);
    let strategy = (net, seeds, (1..=5usize, 1..=5usize), plane, lines);
    let config = Config { cases: 400, failure_persistence: None, ..Config::default() };
    let mut runner = TestRunner::new_with_rng(
        config,
        proptest::test_runner::TestRng::deterministic_rng(proptest::test_runner::RngAlgorithm::ChaCha),
    );
    let outcome = runner.run(&strategy, |(net, seeds, degrees, (kind, r, a, b), (line_u, line_v))| {
        let (u, v) = (knots(degrees.0, &seeds.0), knots(degrees.1, &seeds.1));
        let hull = sheet(&u, &v, &net[..u.basis_count() * v.basis_count()]);
        let cut = match kind {
            0 => Cut::Station { x: LENGTH * r },
            1 => Cut::Diagonal { height: DRAUGHT * r, angle: 0.9 + a },
            2 => Cut::Plane { normal: [0.1 * a, 1.0, b], offset: 5.0 * r + 5.0 * a + 3.0 * b },
            _ => Cut::Buttock { y: 5.0 * r },
        };
        let section = hull.section(cut, 1e-9);
        assert_connected(&section);
        for branch in sides(&section) {
            for p in points(branch) {
                let surface = hull.half_breadth(p[0].clamp(0.0, LENGTH), p[2].clamp(0.0, DRAUGHT)).unwrap();
                // Distance along y, over the slope of the surface at most 1e3, bounds the distance.
                prop_assert!(distance_to_plane(cut, p) < 1e-9, "{:?} {}", cut, distance_to_plane(cut, p));
                prop_assert!((surface - p[1]).abs() < 1e-6, "{:?} {:?} {}", cut, p, surface - p[1]);
            }
        }
        assert_complete(&hull, &section, 0, line_u);
        assert_complete(&hull, &section, 2, line_v);
        Ok(())
    });
    if let Err(error) = outcome {
        panic!("{error}");
    }
}

#[test]
fn planes_through_lines_and_points_of_the_net_are_no_exception() {
    let hull = wigley_hull();
    for k in 0..=21 {
        let section = hull.section(Cut::Station { x: LENGTH * f64::from(k) / 21.0 }, 1e-9);
        assert_eq!(sides(&section).len(), 1, "station {k}");
        assert!(deviation(&section) <= 1e-9, "station {k}: {}", deviation(&section));
        assert_connected(&section);
        let curve = sides(&section)[0].curve.points();
        assert!(curve[0][2].abs() < 1e-12 && (curve[curve.len() - 1][2] - DRAUGHT).abs() < 1e-12, "station {k}");
    }
    for k in 0..=11 {
        let section = hull.section(Cut::Waterline { z: DRAUGHT * f64::from(k) / 11.0 }, 1e-9);
        assert_eq!(sides(&section).len(), 1, "waterline {k}");
        assert!(deviation(&section) <= 1e-9, "waterline {k}");
    }
    // Planes through vertices of the patches, exactly: the half-breadth of a vertex, and planes across the grid.
    for (i, j) in [(3, 4), (7, 2), (10, 10), (1, 9), (20, 1)] {
        let [x, y, z] = hull.surface().eval(f64::from(i) / 21.0, f64::from(j) / 11.0);
        let planes = [
            Cut::Buttock { y },
            Cut::Plane { normal: [0.0, 1.0, 1.0], offset: y + z },
            Cut::Plane { normal: [0.02, 1.0, -1.0], offset: 0.02 * x + y - z },
            Cut::Plane { normal: [DRAUGHT / 11.0, 0.0, LENGTH / 21.0], offset: DRAUGHT / 11.0 * x + LENGTH / 21.0 * z },
        ];
        for cut in planes {
            let section = hull.section(cut, 1e-9);
            assert!(!sides(&section).is_empty(), "{cut:?}");
            assert!(deviation(&section) <= 1e-9, "{cut:?}: {}", deviation(&section));
            assert_connected(&section);
        }
    }
}

#[test]
fn a_plane_that_touches_has_no_branch_and_one_just_inside_a_small_one() {
    let hull = wigley_hull();
    // The form is widest at (L/2, B/2, T), on the upper edge.
    for y in [0.5 * BREADTH, 0.5 * BREADTH + 1e-9, 6.0] {
        let section = hull.section(Cut::Buttock { y }, 1e-9);
        assert!(section.branches.iter().all(|b| points(b).iter().all(|p| (p[1] - y).abs() < 1e-9)), "{y}");
        assert!(sides(&section).len() <= 1);
    }
    let section = hull.section(Cut::Buttock { y: 0.5 * BREADTH - 1e-4 }, 1e-9);
    assert_eq!(sides(&section).len(), 1);
    assert!(deviation(&section) <= 1e-9);
    assert_connected(&section);
}

/// Two bumps of different height on a sheet: y = 1 + bumps.
fn bumps() -> Hull {
    let (u, v) = (KnotVector::uniform(3, 16).unwrap(), KnotVector::uniform(3, 9).unwrap());
    interpolated(&u, &v, |a, b| {
        let bump = |a0: f64, b0: f64| (-((a - a0) / 0.12).powi(2) - ((b - b0) / 0.2).powi(2)).exp();
        [LENGTH * a, 1.0 + 2.0 * bump(0.25, 0.5) + 3.0 * bump(0.75, 0.55), DRAUGHT * b]
    })
}

#[test]
fn loops_and_several_branches() {
    let hull = bumps();
    for (y, loops) in [(2.0, 2), (2.9, 2), (3.3, 1), (3.9, 1), (4.2, 0)] {
        let section = hull.section(Cut::Buttock { y }, 1e-9);
        assert_eq!(section.branches.len(), loops, "buttock {y}");
        for branch in &section.branches {
            assert!(branch.closed);
            let line = branch.polyline(1e-3);
            assert_eq!(line[0].map(f64::to_bits), line[line.len() - 1].map(f64::to_bits));
            for p in points(branch) {
                let on = hull.half_breadth(p[0], p[2]).unwrap();
                // Along y; the sides of the bumps are up to 4 times as steep.
                assert!((on - p[1]).abs() < 4e-9 && (p[1] - y).abs() <= 1e-9, "{p:?} {on}");
            }
        }
        assert_connected(&section);
    }
    // Two open branches: y = 1 + (x - 50)^2 z^2 / ... is cut at the two sides of the saddle.
    let (u, v) = (KnotVector::uniform(3, 7).unwrap(), KnotVector::uniform(2, 5).unwrap());
    let hull =
        interpolated(&u, &v, |a, b| [LENGTH * a, 2.0 + (2.0 * a - 1.0).powi(2) - (b - 0.5).powi(2), DRAUGHT * b]);
    for (y, count) in [(2.3, 2), (1.9, 2), (2.0 + 1e-7, 2), (2.0 - 1e-7, 2)] {
        let section = hull.section(Cut::Buttock { y }, 1e-9);
        assert_eq!(sides(&section).len(), count, "buttock {y}");
        assert_connected(&section);
    }
    // Through the saddle itself: two branches that meet in a point.
    let section = hull.section(Cut::Buttock { y: 2.0 }, 1e-9);
    assert_eq!(sides(&section).len(), 2);
    for p in sides(&section).into_iter().flat_map(points) {
        assert!((p[1] - 2.0).abs() <= 1e-9 && (hull.half_breadth(p[0], p[2]).unwrap() - 2.0).abs() <= 1e-9, "{p:?}");
    }
}

/// A ship-shaped body: transom aft, raked above z = 4, raked stem, flat of bottom, flat side, rising deck.
/// Degree 3 in both directions; graded so that the waterlines are round forward and the bilge is round.
fn ship() -> Hull {
    let (u, v) = (KnotVector::uniform(3, 12).unwrap(), KnotVector::uniform(3, 8).unwrap());
    let (gu, gv) = (u.greville(), v.greville());
    let mut points = Vec::new();
    for &a in &gu {
        for &b in &gv {
            let z = 10.0 * b * b;
            let stern = if z > 4.0 { 0.5 * (4.0 - z) } else { 0.0 };
            let stem = 92.0 + 0.8 * z;
            let x = stern + (stem - stern) * a * (2.0 - a).min(1.5) / 1.0_f64.max((2.0 - a).min(1.5));
            let body = if a < 0.35 { 1.0 - 0.6 * (1.0 - a / 0.35).powi(2) } else { 1.0 };
            let entrance = if a > 0.6 { 1.0 - ((a - 0.6) / 0.4).powi(2) } else { 1.0 };
            let section = if b < 0.5 { 0.5 + 0.5 * (b / 0.5) * (2.0 - b / 0.5) } else { 1.0 };
            points.push([x, 8.0 * body * entrance * section, z]);
        }
    }
    let deck =
        BsplineCurve::new(KnotVector::uniform(2, 1).unwrap(), vec![[-3.0, 9.0], [45.0, 8.0], [100.0, 10.0]]).unwrap();
    with_deck(BsplineSurface::new(u, v, points).unwrap(), deck)
}

#[test]
fn a_ship_with_flats_a_transom_and_sheer() {
    let hull = ship();
    let mut cuts: Vec<Cut> = (0..=40).map(|k| Cut::Station { x: -3.0 + 103.0 * f64::from(k) / 40.0 }).collect();
    cuts.extend((0..=20).map(|k| Cut::Waterline { z: 0.5 * f64::from(k) }));
    cuts.extend((0..=32).map(|k| Cut::Buttock { y: 0.25 * f64::from(k) }));
    cuts.extend((1..10).map(|k| Cut::Diagonal { height: f64::from(k), angle: 0.5 }));
    cuts.extend((1..10).map(|k| Cut::Plane { normal: [0.1, 0.0, 1.0], offset: f64::from(k) }));
    for cut in cuts {
        let section = hull.section(cut, 1e-9);
        for branch in &section.branches {
            for p in points(branch) {
                assert!(distance_to_plane(cut, p) <= 1e-9, "{cut:?} {:?} {p:?}", branch.face);
                assert!(p[2] <= hull.deck_height(p[0]) + 1e-9, "{cut:?} {:?} {p:?}", branch.face);
                if branch.face == Face::Side {
                    let [a, b] = hull.endings(p[2].clamp(0.0, 10.0)).unwrap();
                    let on = hull.half_breadth(p[0].clamp(a, b), p[2].clamp(0.0, 10.0)).unwrap();
                    assert!((on - p[1]).abs() <= 1e-6, "{cut:?} {p:?} {on}");
                }
            }
        }
    }
}

/// A barge-like form with exact flats: flat side amidships from z = 5 up, flat of bottom, transom across at x = 0.
fn barge() -> Hull {
    let (u, v) = (KnotVector::uniform(3, 12).unwrap(), KnotVector::uniform(3, 10).unwrap());
    let mut points = Vec::new();
    for &a in &u.greville() {
        for &b in &v.greville() {
            let end = if a < 0.3 { 1.0 - 3.0 * (0.3 - a).powi(2) } else { 1.0 - (a - 0.6).max(0.0).powi(2) / 0.16 };
            let bilge = if b < 0.4 { 1.0 - (0.4 - b).powi(2) } else { 1.0 };
            points.push([100.0 * a, 8.0 * end * bilge, 10.0 * b]);
        }
    }
    hull(BsplineSurface::new(u, v, points).unwrap())
}

fn length(line: &[[f64; 3]]) -> f64 {
    line.windows(2).map(|w| (0..3).map(|d| (w[1][d] - w[0][d]).powi(2)).sum::<f64>().sqrt()).sum()
}

#[test]
fn planes_in_the_flats() {
    let hull = barge();
    // The flat side reaches from x = 100 5/12 to 50 and from z = 5 up: its boundary down, along, and up again.
    let section = hull.section(Cut::Buttock { y: 8.0 }, 1e-9);
    assert_eq!(section.branches.len(), 1);
    assert!(section.branches[0].curve.points().len() < 100);
    for p in points(&section.branches[0]) {
        let gap = [p[0] - 125.0 / 3.0, p[0] - 50.0, p[2] - 5.0].map(f64::abs);
        assert!((p[1] - 8.0).abs() < 1e-12 && gap.iter().any(|g| *g < 1e-9), "{p:?}");
    }
    assert!((length(&section.branches[0].polyline(1e-6)) - 5.0 - 25.0 / 3.0 - 5.0).abs() < 1e-9);
    // The transom across, in its own plane: its outline, and the line of the flat of bottom.
    let section = hull.section(Cut::Station { x: 0.0 }, 1e-9);
    let faces: Vec<Face> = section.branches.iter().map(|b| b.face).collect();
    assert_eq!(faces, [Face::Side, Face::Bottom]);
    for p in points(&section.branches[0]) {
        assert!(p[0].abs() < 1e-12 && (hull.half_breadth(0.0, p[2]).unwrap() - p[1]).abs() < 1e-9);
    }
    // A hair inside the flat side: the contour runs where the surface leaves the plane by 1e-9 m.
    let section = hull.section(Cut::Buttock { y: 8.0 - 1e-9 }, 1e-10);
    assert_eq!(section.branches.len(), 1);
    for p in points(&section.branches[0]) {
        assert!((hull.half_breadth(p[0], p[2]).unwrap() - p[1]).abs() < 1e-9);
    }
    // The centreplane: the profile of Wigley's form, aft end, keel and fore end in one.
    let section = wigley_hull().section(Cut::Buttock { y: 0.0 }, 1e-9);
    assert_eq!(section.branches.len(), 1);
    // Near the corners of the keel the plane and the surface touch; there the branch may run within the tolerance.
    assert!((length(&section.branches[0].polyline(1e-9)) - LENGTH - 2.0 * DRAUGHT).abs() < 1e-3);
    assert!(deviation(&section) <= 1e-9);
}

#[test]
fn polylines_keep_the_ends_and_the_deviation() {
    let hull = ship();
    let cuts = [
        Cut::Station { x: 80.0 },
        Cut::Waterline { z: 5.3 },
        Cut::Buttock { y: 5.0 },
        Cut::Diagonal { height: 6.0, angle: 0.6 },
    ];
    for branch in cuts.iter().flat_map(|&cut| hull.section(cut, 1e-6).branches) {
        for deviation in [0.1, 1e-3, 1e-5] {
            let line = branch.polyline(deviation);
            let curve = branch.curve.points();
            assert_eq!([line[0], line[line.len() - 1]], [curve[0], curve[curve.len() - 1]]);
            for p in points(&branch) {
                let nearest = line.windows(2).map(|w| {
                    let chord: [f64; 3] = std::array::from_fn(|d| w[1][d] - w[0][d]);
                    let out: [f64; 3] = std::array::from_fn(|d| p[d] - w[0][d]);
                    let square: f64 = chord.iter().map(|c| c * c).sum();
                    let r = ((0..3).map(|d| chord[d] * out[d]).sum::<f64>() / square).clamp(0.0, 1.0);
                    (0..3).map(|d| (out[d] - r * chord[d]).powi(2)).sum::<f64>().sqrt()
                });
                let nearest = nearest.fold(f64::INFINITY, f64::min);
                assert!(nearest <= deviation * (1.0 + 1e-9), "{nearest} {deviation}");
            }
        }
        assert!(branch.polyline(1e-3).len() < 400);
    }
}

/// Nets of whole numbers cut at whole numbers: flats, saddles and corners on the plane everywhere.
#[test]
fn degenerate_nets_give_connected_branches_in_bounded_work() {
    use proptest::prelude::*;
    use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};
    let net = prop::collection::vec(0..4u8, 81);
    let seeds = (prop::collection::vec(0..1usize, 0..4), prop::collection::vec(0..3usize, 0..2));
    let strategy = (net, seeds, (1..=3usize, 1..=3usize), 0..4usize);
    let config = Config { cases: 300, failure_persistence: None, ..Config::default() };
    let mut runner = TestRunner::new_with_rng(config, TestRng::deterministic_rng(RngAlgorithm::ChaCha));
    let outcome = runner.run(&strategy, |(net, seeds, degrees, kind)| {
        let (u, v) = (knots(degrees.0, &seeds.0), knots(degrees.1, &seeds.1));
        let net: Vec<f64> = net.iter().map(|&y| f64::from(y)).collect();
        let hull = sheet(&u, &v, &net[..u.basis_count() * v.basis_count()]);
        let cut = match kind {
            0 => Cut::Plane { normal: [0.0, 1.0, 0.0], offset: 0.0 },
            1 => Cut::Plane { normal: [1.0 / LENGTH, 1.0, 0.0], offset: 1.0 },
            _ => Cut::Buttock { y: kind as f64 - 1.0 },
        };
        let section = hull.section(cut, 1e-9);
        assert_connected(&section);
        for branch in sides(&section) {
            prop_assert!(branch.curve.points().len() < 20_000, "{}", branch.curve.points().len());
            for p in points(branch) {
                prop_assert!(distance_to_plane(cut, p) < 1e-9, "{:?} {}", cut, distance_to_plane(cut, p));
                let surface = hull.half_breadth(p[0].clamp(0.0, LENGTH), p[2].clamp(0.0, DRAUGHT)).unwrap();
                prop_assert!((surface - p[1]).abs() < 1e-6, "{:?} {:?} {}", cut, p, surface - p[1]);
            }
        }
        Ok(())
    });
    if let Err(error) = outcome {
        panic!("{error}");
    }
}

#[test]
fn a_plane_is_the_same_however_it_is_written() {
    let hull = ship();
    for (named, normal, offset) in [
        (Cut::Station { x: 20.0 }, [1.0, 0.0, 0.0], 20.0),
        (Cut::Station { x: 20.0 }, [-1e200, 0.0, 0.0], -20e200),
        (Cut::Buttock { y: 0.0 }, [0.0, 1e-200, 0.0], 0.0),
        (Cut::Waterline { z: 0.0 }, [0.0, 0.0, 3.0], 0.0),
    ] {
        let (one, other) = (hull.section(named, 1e-6), hull.section(Cut::Plane { normal, offset }, 1e-6));
        assert!(!one.branches.is_empty() && one.branches == other.branches, "{named:?}");
    }
}
