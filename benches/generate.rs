//! The whole generator, from requested to the exact hull, without tables and drawings.

use criterion::{Criterion, criterion_group, criterion_main};
use loftsman::internals::parametric::ShipType;
use loftsman::internals::parametric::cosh::{self, DesignTargets, MidshipTarget};
use loftsman::internals::parametric::ucl_cosh;
use std::hint::black_box;

fn requested(ship: ShipType, dimensions: [f64; 4], block: f64, midship: f64) -> DesignTargets {
    DesignTargets {
        ship_type: Some(ship),
        length: dimensions[0],
        breadth: Some(dimensions[1]),
        draught: Some(dimensions[2]),
        depth: Some(dimensions[3]),
        block_coefficient: Some(block),
        midship_coefficient: Some(MidshipTarget::Value(midship)),
        ..DesignTargets::default()
    }
}

fn generate(c: &mut Criterion) {
    let mut group = c.benchmark_group("generate");
    for (name, requested) in [
        ("bulk carrier", requested(ShipType::BulkCarrier, [217.0, 32.25, 12.2, 18.0], 0.80, 0.99)),
        ("frigate", requested(ShipType::Frigate, [142.0, 19.06, 6.15, 12.0], 0.50, 0.80)),
        ("fishing vessel", requested(ShipType::Fishing, [21.04, 6.86, 2.5, 3.7], 0.50, 0.80)),
    ] {
        group.bench_function(name, |b| b.iter(|| cosh::generate("bench", black_box(&requested))));
    }
    let raw = ucl_cosh::Parameters {
        length: 100.0,
        breadth: 15.0,
        depth: 9.4,
        draught: 5.0,
        midship_fullness: 1.5,
        bow: 0.1,
        transom_fullness: 1.5,
        forward_deck: 0.8,
        transom_breadth_ratio: 0.9,
        transom_tip_ratio: 0.4,
        aft_cut_up_ratio: 0.2,
        keel_forward_ratio: 0.9,
        side_slope: 0.13,
    };
    group.bench_function("raw frigate", |b| b.iter(|| ucl_cosh::generate("bench", black_box(&raw))));
    group.finish();
}

criterion_group!(benches, generate);
criterion_main!(benches);
