//! Wave resistance of thin ships at 21 speeds, Fn 0.2 to 0.6: `wigley`, whose net is over fixed x and z, with its
//! gradient at one speed, and `frigate`, whose ends rake. Reading the hull is not counted, building the integrals is.

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use loftsman::internals::hull::Hull;
use loftsman::internals::parametric::ShipType;
use loftsman::internals::parametric::analytic::{self, Dimensions};
use loftsman::internals::parametric::cosh::{self, DesignTargets};
use loftsman::internals::resistance::{ThinShip, Water};

fn speeds(length: f64, water: &Water) -> Vec<f64> {
    (0..21).map(|n| (0.2 + 0.02 * f64::from(n)) * (water.gravity * length).sqrt()).collect()
}

fn resistances(hull: &Hull, draught: f64, speeds: &[f64], water: &Water) -> Vec<f64> {
    let ship = ThinShip::new(hull, draught).unwrap();
    speeds.iter().map(|&speed| ship.wave_resistance(speed, water)).collect()
}

fn thin_ships(criterion: &mut Criterion) {
    let water = Water::new(1025.0, 15.0);
    let dimensions = Dimensions { length: 100.0, breadth: 10.0, draught: 6.25, depth: 10.0 };
    let wigley = analytic::wigley("Wigley", &dimensions).unwrap().hull;
    let targets = DesignTargets { ship_type: Some(ShipType::Frigate), length: 100.0, ..DesignTargets::default() };
    let frigate = cosh::generate("frigate", &targets).unwrap().hull;
    let list = speeds(100.0, &water);
    let mut group = criterion.benchmark_group("michell");
    group.bench_function("wigley 21 speeds", |bench| {
        bench.iter(|| resistances(black_box(&wigley), 6.25, &list, &water));
    });
    let ship = ThinShip::new(&wigley, 6.25).unwrap();
    group.bench_function("wigley Fn 0.3", |bench| {
        bench.iter(|| ship.wave_resistance(black_box(list[5]), &water));
    });
    group.bench_function("wigley Fn 0.3 with gradient", |bench| {
        bench.iter(|| ship.wave_gradient(black_box(list[5]), &water));
    });
    group.sample_size(10);
    let draught = frigate.particulars().draught.unwrap();
    group.bench_function("frigate 21 speeds", |bench| {
        bench.iter(|| resistances(black_box(&frigate), draught, &list, &water));
    });
    group.finish();
}

criterion_group!(benches, thin_ships);
criterion_main!(benches);
