//! Nanoseconds a point for point, first and second derivatives of bicubic surfaces, scattered and on a grid.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use loftsman::internals::spline::{BsplineSurface, KnotVector, SurfaceJet};
use rand::{RngExt, SeedableRng, rngs::StdRng};
use std::hint::black_box;

const POINTS: usize = 100_000;
const GRID: [usize; 2] = [400, 250];

/// A bicubic surface with slightly uneven knots.
fn surface(rows: usize, columns: usize, rng: &mut StdRng) -> BsplineSurface<3> {
    let mut knots = |count: usize| {
        let spans = count - 3;
        let breaks: Vec<f64> = (0..=spans)
            .map(|k| match k {
                0 => 0.0,
                k if k == spans => 1.0,
                k => (k as f64 + rng.random_range(-0.2..0.2)) / spans as f64,
            })
            .collect();
        KnotVector::from_breakpoints(3, &breaks, &vec![1; spans - 1]).unwrap()
    };
    let (u, v) = (knots(rows), knots(columns));
    let points = (0..rows * columns)
        .map(|k| {
            let (i, j) = ((k / columns) as f64, (k % columns) as f64);
            [i, j + rng.random_range(-0.1..0.1), (0.3 * i).sin() * (0.2 * j).cos()]
        })
        .collect();
    BsplineSurface::new(u, v, points).unwrap()
}

/// Uses every number of the result.
fn consume(sum: &mut [f64; 3], jet: &SurfaceJet<3>) {
    for (d, s) in sum.iter_mut().enumerate() {
        *s += jet.point[d] + jet.du[d] + jet.dv[d] + jet.duu[d] + jet.duv[d] + jet.dvv[d];
    }
}

fn evaluation(criterion: &mut Criterion) {
    let mut rng = StdRng::seed_from_u64(20);
    let mut group = criterion.benchmark_group("spline");
    for (rows, columns) in [(24, 14), (60, 40)] {
        let surface = surface(rows, columns, &mut rng);
        let name = format!("{rows}x{columns}");
        let sites: Vec<[f64; 2]> = (0..POINTS).map(|_| [rng.random(), rng.random()]).collect();
        group.throughput(Throughput::Elements(POINTS as u64));
        group.bench_function(BenchmarkId::new("jet-scattered", &name), |b| {
            b.iter(|| {
                let mut sum = [0.0; 3];
                for &[u, v] in &sites {
                    consume(&mut sum, &surface.jet(u, v));
                }
                black_box(sum)
            });
        });
        group.bench_function(BenchmarkId::new("tangents-scattered", &name), |b| {
            b.iter(|| {
                let mut sum = [0.0; 3];
                for &[u, v] in &sites {
                    let t = surface.tangents(u, v);
                    for (d, s) in sum.iter_mut().enumerate() {
                        *s += t.point[d] + t.du[d] + t.dv[d];
                    }
                }
                black_box(sum)
            });
        });
        let line = |count: usize| -> Vec<f64> { (0..count).map(|k| (k as f64 + 0.5) / count as f64).collect() };
        let (us, vs) = (line(GRID[0]), line(GRID[1]));
        group.throughput(Throughput::Elements((GRID[0] * GRID[1]) as u64));
        group.bench_function(BenchmarkId::new("jet-grid", &name), |b| {
            b.iter(|| {
                let mut sum = [0.0; 3];
                surface.grid_jets(&us, &vs, |_, _, jet| consume(&mut sum, jet));
                black_box(sum)
            });
        });
    }
    group.finish();
}

criterion_group!(benches, evaluation);
criterion_main!(benches);
