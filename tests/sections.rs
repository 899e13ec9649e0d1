//! Plane sections against closed forms, and their connection against brute-force root counts.

use loftsman::hull::{Branch, Cut, Face, Hull, PrincipalParticulars, Section};
use loftsman::spline::{BsplineCurve, BsplineSurface, Collocation, KnotVector};

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
        draught: DRAUGHT,
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
    let net = prop::collection::vec(0.0..5.0f64, 200);
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
