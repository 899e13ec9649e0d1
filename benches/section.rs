//! Time of one plane section of a bicubic 24x14 surface at a tolerance of 1e-9 m: waterlines, stations, buttocks.

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use loftsman::internals::hull::{Cut, Hull, PrincipalParticulars};
use loftsman::internals::spline::{BsplineCurve, BsplineSurface, Collocation, KnotVector};

const LENGTH: f64 = 100.0;
const BREADTH: f64 = 10.0;
const DRAUGHT: f64 = 6.25;

/// Wigley's form, exactly, as a bicubic net of 24 x 14 points.
fn wigley() -> Hull {
    let (u, v) = (KnotVector::uniform(3, 21).unwrap(), KnotVector::uniform(3, 11).unwrap());
    let (su, sv) = (u.greville(), v.greville());
    let mut breadths: Vec<f64> =
        (su.iter()).flat_map(|&a| sv.iter().map(move |&b| 2.0 * BREADTH * a * (1.0 - a) * b * (2.0 - b))).collect();
    Collocation::new(&u, &su).unwrap().solve_tensor(&Collocation::new(&v, &sv).unwrap(), &mut breadths);
    // Greville abscissae are the control values of the parameter itself.
    let points = (su.iter())
        .flat_map(|&a| sv.iter().map(move |&b| (LENGTH * a, DRAUGHT * b)))
        .zip(&breadths)
        .map(|((x, z), &y)| [x, y.max(0.0), z])
        .collect();
    let surface = BsplineSurface::new(u, v, points).unwrap();
    let deck = BsplineCurve::new(KnotVector::uniform(1, 1).unwrap(), vec![[0.0, DRAUGHT], [LENGTH, DRAUGHT]]).unwrap();
    let particulars = PrincipalParticulars {
        length_between_perpendiculars: LENGTH,
        breadth: BREADTH,
        draught: Some(DRAUGHT),
        depth: DRAUGHT,
    };
    Hull::new("wigley", particulars, surface, deck).unwrap()
}

fn sections(criterion: &mut Criterion) {
    let hull = wigley();
    let kinds: [(&str, Vec<Cut>); 4] = [
        ("waterline", (0..10).map(|k| Cut::Waterline { z: DRAUGHT * (f64::from(k) + 0.37) / 10.0 }).collect()),
        ("station", (0..21).map(|k| Cut::Station { x: LENGTH * (f64::from(k) + 0.41) / 21.0 }).collect()),
        ("buttock", (0..8).map(|k| Cut::Buttock { y: 0.5 * BREADTH * (f64::from(k) + 0.3) / 8.0 }).collect()),
        ("diagonal", (1..6).map(|k| Cut::Diagonal { height: f64::from(k), angle: 0.6 }).collect()),
    ];
    let mut group = criterion.benchmark_group("section");
    for (name, cuts) in kinds {
        // Time per contour.
        let mut next = cuts.iter().cycle();
        group.bench_function(name, |bencher| {
            bencher.iter(|| next.next().map(|&cut| hull.section(black_box(cut), 1e-9)));
        });
    }
    group.finish();
}

criterion_group!(benches, sections);
criterion_main!(benches);
