//! Whole jobs of fairing without pictures: tables of 21 stations and 11 waterlines of Wigley's hull with 2 mm and 25 mm
//! of noise, for which at most 30 ms are wanted: the mean over 30 seeds.

#[allow(dead_code, reason = "the truths of real hulls are nets of a partner")]
#[path = "../tests/partners/mod.rs"]
mod partners;
#[path = "../tests/random/mod.rs"]
mod random;
#[allow(dead_code, reason = "one hull of many is timed, nothing is measured")]
#[path = "../tests/truth_hulls/mod.rs"]
mod truth_hulls;

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use truth_hulls::{Errors, wigley};

fn bench(criterion: &mut Criterion) {
    let truth = wigley();
    let job = truth.job();
    let mut group = criterion.benchmark_group("fair");
    group.sample_size(20);
    for noise in [0.002, 0.025] {
        let tables: Vec<_> = (1..=30).map(|seed| truth.table(Errors::Normal(noise), seed)).collect();
        let mut turn = tables.iter().cycle();
        group.bench_function(format!("Wigley 21x11, {} mm", 1e3 * noise), |b| {
            b.iter(|| turn.next().map(|table| job.run(black_box(table))));
        });
    }
    group.finish();
}

criterion_group!(benches, bench);
criterion_main!(benches);
