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
