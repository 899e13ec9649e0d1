//! Milliseconds from a table of offsets to a hull, for tables from 20 x 25 to 80 x 50 cells.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use loftsman::internals::hull::{Cell, FitMethod, Hull, OffsetTable, StationOffsets};

/// A hull with a flat of bottom, a raked stern and a flat side.
fn table(stations: usize, waterlines: usize) -> OffsetTable {
    let mut table = OffsetTable { name: "bench".to_owned(), ..OffsetTable::default() };
    table.waterlines = (0..waterlines).map(|j| 12.0 * j as f64 / (waterlines - 1) as f64).collect();
    table.endings = table.waterlines.iter().map(|z| [Some(10.0 - 1.2 * z), Some(190.0 + 0.5 * z)]).collect();
    for i in 0..stations {
        let x = 200.0 * i as f64 / (stations - 1) as f64;
        let mut station = StationOffsets::new(format!("{i}"), x);
        let half = |z: f64| {
            let (aft, fore) = (10.0 - 1.2 * z, 190.0 + 0.5 * z);
            let s = ((x - aft) / (fore - aft) - 0.5) * 2.0;
            let side = 1.0 - (1.0 - z / 12.0).powi(6) * (0.2 + 0.7 * s * s);
            (s.abs() < 1.0).then(|| 15.0 * (1.0 - s.powi(6)) * side)
        };
        station.half_breadths = table.waterlines.iter().map(|&z| Cell::from(half(z))).collect();
        table.stations.push(station);
    }
    table
}

fn fit(c: &mut Criterion) {
    let mut group = c.benchmark_group("fit");
    for (stations, waterlines) in [(20, 25), (40, 25), (40, 50), (80, 50)] {
        let table = table(stations, waterlines);
        group.throughput(Throughput::Elements((stations * waterlines) as u64));
        group.bench_function(BenchmarkId::from_parameter(format!("{stations} x {waterlines}")), |b| {
            b.iter(|| Hull::fit(&table, &FitMethod::Graded).map(|fitted| fitted.notes.len()));
        });
    }
    group.finish();
}

criterion_group!(benches, fit);
criterion_main!(benches);
