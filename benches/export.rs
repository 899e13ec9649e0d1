//! Files for other programs: STEP of one net beside its numbers alone, the mesh, and all formats of one hull.

use criterion::{Criterion, criterion_group, criterion_main};
use loftsman::internals::exchange::{CadUnit, write_step};
use loftsman::internals::hull::{Hull, HullMesh, PrincipalParticulars, Solid};
use loftsman::internals::parametric::analytic::{self, Dimensions};
use loftsman::internals::report::{ExportFormat, ExportSettings, export};
use loftsman::internals::spline::{BsplineCurve, BsplineSurface, KnotVector};
use std::fmt::Write as _;
use std::hint::black_box;

/// A cubic net of 24 x 14 points: x = 100 u, z = 10 v, y a smooth bump that closes at the ends and at the keel.
fn hull_24x14() -> Option<Hull> {
    let (u, v) = (KnotVector::uniform(3, 21).ok()?, KnotVector::uniform(3, 11).ok()?);
    let heights = v.greville();
    let points = u
        .greville()
        .into_iter()
        .flat_map(|s| heights.iter().map(move |t| [100.0 * s, 28.0 * s * (1.0 - s) * t.sqrt(), 10.0 * t]))
        .collect();
    let deck = BsplineCurve::new(KnotVector::uniform(1, 1).ok()?, vec![[0.0, 10.0], [100.0, 10.0]]).ok()?;
    let particulars =
        PrincipalParticulars { length_between_perpendiculars: 100.0, breadth: 14.0, draught: Some(6.0), depth: 10.0 };
    Hull::new("bench", particulars, BsplineSurface::new(u, v, points).ok()?, deck).ok()
}

fn files(c: &mut Criterion) {
    let mut group = c.benchmark_group("export");
    if let Some(solid) = hull_24x14().and_then(|hull| Solid::new(&hull).ok()) {
        group.bench_function("write_step of 24 x 14", |b| {
            b.iter(|| write_step(black_box(&solid), "bench", CadUnit::Metre));
        });
        // What any writer must do: its ratio to this says how much is lost around the numbers.
        group.bench_function("the numbers of its nets alone", |b| {
            b.iter(|| {
                let mut text = String::new();
                for point in solid.faces.iter().flat_map(|face| face.surface.points()) {
                    for coordinate in black_box(point) {
                        let _ = write!(text, "{coordinate},");
                    }
                }
                text
            });
        });
    }
    let dimensions = Dimensions { length: 100.0, breadth: 10.0, draught: 6.25, depth: 9.0 };
    if let Ok(form) = analytic::wigley("Wigley", &dimensions) {
        group.sample_size(10);
        group.bench_function("mesh at 1e-3 B", |b| b.iter(|| HullMesh::new(black_box(&form.hull), 0.01, 8)));
        group.bench_function("all formats", |b| {
            b.iter(|| export(black_box(&form.hull), "wigley", &ExportFormat::ALL, &ExportSettings::default()));
        });
    }
    group.finish();
}

criterion_group!(benches, files);
criterion_main!(benches);
