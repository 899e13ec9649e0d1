//! Tables of hydrostatics of a bicubic net of 24 x 14 control points: 40 draughts, and 80 for the growth of the cost.
//!
//! `wigley`: Wigley-like half-breadths between a raked stem and a raked stern, x(u, v) non-linear in u and dependent on
//! v in the outer thirds of the length. `slanting`: the same with x dependent on v over the whole length. `frigate`: a
//! generated ship of 31 x 19 control points, whose lines slant at the ends. `canoe` and `canoe-mixed`: a rockered keel,
//! z(u, v), with upright stations and with lines that rake.

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use loftsman::internals::hull::{Hull, PrincipalParticulars};
use loftsman::internals::hydrostatics::{Conventions, CurvesOfForm};
use loftsman::internals::parametric::ShipType;
use loftsman::internals::parametric::cosh::{self, DesignTargets};
use loftsman::internals::spline::{BsplineCurve, BsplineSurface, KnotVector};
use std::hint::black_box;

fn hull(slanting: bool) -> Hull {
    let (u, v) = (KnotVector::uniform(3, 21).unwrap(), KnotVector::uniform(3, 11).unwrap());
    let (length, breadth, depth) = (100.0, 16.0, 10.0);
    let mut points = Vec::new();
    for &s in &u.greville() {
        for &t in &v.greville() {
            let (aft, fore) = ((0.35 - s).max(0.0) / 0.35, (s - 0.65).max(0.0) / 0.35);
            let rake = if slanting { 4.0 * (2.0 * s - 1.0) * t } else { 4.0 * t * (fore * fore - aft * aft) };
            let x = length * (s + 0.02 * (fore * fore * (1.0 - fore) - aft * aft * (1.0 - aft))) + rake;
            let y = 0.5 * breadth * (1.0 - (2.0 * s - 1.0).powi(2)) * (1.0 - (1.0 - t).powi(2));
            points.push([x, y, depth * t]);
        }
    }
    let line = KnotVector::uniform(1, 1).unwrap();
    let deck = BsplineCurve::new(line, vec![[-10.0, depth], [110.0, depth]]).unwrap();
    let particulars =
        PrincipalParticulars { length_between_perpendiculars: length, breadth, draught: Some(6.0), depth };
    Hull::new("bench", particulars, BsplineSurface::new(u, v, points).unwrap(), deck).unwrap()
}

/// A canoe body: a rockered keel, stations or (`mixed`) lines that rake with the ends, y like a square root over the
/// keel.
fn canoe(mixed: bool) -> Hull {
    let (u, v) = (KnotVector::uniform(3, 21).unwrap(), KnotVector::uniform(3, 11).unwrap());
    let (length, breadth, depth) = (100.0, 16.0, 10.0);
    let mut points = Vec::new();
    for &s in &u.greville() {
        for &t in &v.greville() {
            let xi = 2.0 * s - 1.0;
            let keel = 5.0 * xi * xi;
            let rake = if mixed { 4.0 * t * t * xi } else { 0.0 };
            points.push([length * s + rake, 0.5 * breadth * (1.0 - xi * xi) * t, keel + (depth - keel) * t * t]);
        }
    }
    let line = KnotVector::uniform(1, 1).unwrap();
    let deck = BsplineCurve::new(line, vec![[-10.0, depth], [110.0, depth]]).unwrap();
    let particulars =
        PrincipalParticulars { length_between_perpendiculars: length, breadth, draught: Some(6.0), depth };
    Hull::new("bench", particulars, BsplineSurface::new(u, v, points).unwrap(), deck).unwrap()
}

fn tables(criterion: &mut Criterion) {
    let requested = DesignTargets { ship_type: Some(ShipType::Frigate), length: 100.0, ..DesignTargets::default() };
    let frigate = cosh::generate("frigate", &requested).unwrap().hull;
    let depth = frigate.particulars().depth;
    let mut group = criterion.benchmark_group("hydrostatics");
    for (name, hull, top) in [
        ("wigley", hull(false), 10.0),
        ("slanting", hull(true), 10.0),
        ("frigate", frigate, depth),
        ("canoe", canoe(false), 10.0),
        ("canoe-mixed", canoe(true), 10.0),
    ] {
        for count in [40, 80] {
            let draughts: Vec<f64> = (1..=count).map(|k| top * f64::from(k) / f64::from(count + 1)).collect();
            group.bench_with_input(BenchmarkId::new(name, count), &draughts, |bench, draughts| {
                bench.iter(|| CurvesOfForm::new(black_box(&hull), draughts, &Conventions::default()));
            });
        }
    }
    group.finish();
}

criterion_group!(benches, tables);
criterion_main!(benches);
