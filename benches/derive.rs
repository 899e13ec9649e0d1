//! Daughters of a 24 x 14 net: a daughter, a refusal with its intervals and a blend, each over the time of one table of hydrostatics
//! of the same hull, turn by turn in one run.

use std::time::Instant;

use loftsman::internals::derivation::{BlendRequest, Dimension, Request, blend, counted_planes, derive, inflections};
use loftsman::internals::hull::{Hull, surface_distance};
use loftsman::internals::hydrostatics::{Conventions, CurvesOfForm};
use loftsman::internals::parametric::ShipType;
use loftsman::internals::parametric::cosh::{DesignTargets, generate};

const TURNS: usize = 5;

fn hull(ship: ShipType, block: f64) -> Hull {
    let requested = DesignTargets {
        ship_type: Some(ship),
        length: 100.0,
        breadth: Some(15.0),
        draught: Some(5.0),
        depth: Some(8.0),
        block_coefficient: Some(block),
        ..DesignTargets::default()
    };
    generate("bench", &requested).unwrap().hull
}

/// Median seconds of `TURNS`.
fn seconds(mut work: impl FnMut()) -> f64 {
    let mut found: Vec<f64> = (0..TURNS)
        .map(|_| {
            let start = Instant::now();
            work();
            start.elapsed().as_secs_f64()
        })
        .collect();
    found.sort_by(f64::total_cmp);
    found[TURNS / 2]
}

fn main() {
    let conventions = Conventions::default();
    let parent = hull(ShipType::Tug, 0.54);
    let other = hull(ShipType::Frigate, 0.5);
    let [rows, columns] = parent.surface().shape();
    println!("net of {rows} x {columns}");
    let draughts: Vec<f64> = (1..=40).map(|k| 0.15 * f64::from(k)).collect();
    let unit = seconds(|| drop(CurvesOfForm::new(&parent, &draughts, &conventions)));
    println!("a table of 40 draughts: {:.2} ms", 1e3 * unit);
    let of = |block: f64| Request { block_coefficient: Some(block), ..Request::default() };
    let daughter = derive(&parent, &of(0.56), &conventions, false).unwrap();
    let programs = daughter.programs;
    let all = [
        ("a daughter", seconds(|| drop(derive(&parent, &of(0.56), &conventions, false)))),
        (
            "its inflections",
            seconds(|| {
                let _: usize = inflections(&daughter.hull, &counted_planes(&parent, conventions.stations));
            }),
        ),
        (
            "its distance from the parent",
            seconds(|| assert!(surface_distance(&daughter.hull, &daughter.scaled).is_some())),
        ),
        ("a daughter with her limits", seconds(|| drop(derive(&parent, &of(0.56), &conventions, true)))),
        ("a refusal with intervals", seconds(|| drop(derive(&parent, &of(0.9), &conventions, false).unwrap_err()))),
        (
            "a blend, beam free",
            seconds(|| {
                let request = BlendRequest {
                    block_coefficient: Some(0.53),
                    free: vec![Dimension::Breadth],
                    ..BlendRequest::default()
                };
                drop(blend(&[parent.clone(), other.clone()], &request, &conventions, false));
            }),
        ),
    ];
    for (what, time) in all {
        println!("{what}: {:.1} ms, {:.1} tables", 1e3 * time, time / unit);
    }
    println!("{programs} programs");
}
