//! Suspects of a table of 40 stations and 25 waterlines with 5 mm of reading noise and three errors: at most 100 ms is
//! wanted.

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use loftsman::internals::fairing::suspects;
use loftsman::internals::hull::{Cell, OffsetTable, StationOffsets};

fn table() -> OffsetTable {
    let waterlines: Vec<f64> = (0..25).map(|j| 0.4 * f64::from(j)).collect();
    let mut seed = 1u64;
    let mut noise = || {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((seed >> 33) as f64 / f64::from(1u32 << 31) - 0.5) * 0.005 * 12f64.sqrt()
    };
    let stations = (0..40)
        .map(|i| {
            let x = 3.0 * (f64::from(i) + 0.5);
            let mut station = StationOffsets::new(format!("{i}"), x);
            let along = 1.0 - (x / 60.0 - 1.0).powi(4);
            let half = |z: f64| 9.0 * along * (1.0 - (1.0 - (z + 0.4) / 11.0).powi(4));
            station.half_breadths =
                waterlines.iter().map(|&z| Cell::from(Some(((half(z) + noise()) * 1000.0).round() / 1000.0))).collect();
            station
        })
        .collect();
    let mut table = OffsetTable { waterlines, stations, ..OffsetTable::default() };
    table.form.decimals = Some(3);
    for (i, j, by) in [(10, 5, 0.09), (20, 12, -0.5), (33, 20, 1.0)] {
        let value = table.stations[i].half_breadths[j].value().unwrap_or_default() + by;
        table.stations[i].half_breadths[j] = Cell::from(Some(value));
    }
    table
}

fn bench(criterion: &mut Criterion) {
    let table = table();
    let mut group = criterion.benchmark_group("check");
    group.sample_size(20);
    group.bench_function("suspects 40x25", |b| b.iter(|| suspects(black_box(&table))));
    group.finish();
}

criterion_group!(benches, bench);
criterion_main!(benches);
