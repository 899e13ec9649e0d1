//! The figures of reports: text keeps apart and on the sheet, and they fit into the frame of A3.

use super::canvas::Canvas;
use super::sheet::ROOM;
use super::surface_map::{self, SurfaceMapKind};
use super::{FigureInputs, bonjean, deviation, fairing, fairing_arrows, fairing_long, fairing_moves};
use crate::fairing::inspect::Planes;
use crate::fairing::job::Job;
use crate::fairing::record::FairRecord;
use crate::hull::{Cut, Entry, Hull, OffsetStation, OffsetTable};
use crate::hydrostatics::{Conventions, CurvesOfForm};
use crate::parametric::ShipType;
use crate::parametric::analytic::{self, Dimensions};
use crate::parametric::cosh::{self, Wishes};

fn faults(name: &str, canvas: &Canvas) -> Vec<String> {
    let (texts, sheet) = (canvas.texts(), canvas.sheet());
    let mut faults = Vec::new();
    if sheet.width() > ROOM[0] + 1e-9 || sheet.height() > ROOM[1] + 1e-9 {
        faults.push(format!("{name}: {} x {} mm", sheet.width(), sheet.height()));
    }
    for (k, text) in texts.iter().enumerate() {
        if !sheet.contains(&text.place) {
            faults.push(format!("{name}: {text:?} leaves the sheet"));
        }
        for other in &texts[..k] {
            if text.place.grown(-0.05).overlaps(&other.place.grown(-0.05)) {
                faults.push(format!("{name}: {text:?} on {other:?}"));
            }
        }
    }
    faults
}

fn wigley() -> Hull {
    let dimensions = Dimensions { length: 100.0, breadth: 10.0, draught: 6.25, depth: 9.0 };
    analytic::wigley("Wigley", &dimensions).unwrap().hull
}

fn frigate() -> Hull {
    let wishes = Wishes {
        ship_type: Some(ShipType::Frigate),
        length: 100.0,
        breadth: Some(13.2),
        draught: Some(4.4),
        depth: Some(9.0),
        block_coefficient: Some(0.5),
        ..Wishes::default()
    };
    cosh::generate("frigate", &wishes).unwrap().hull
}

#[test]
fn maps_and_bonjean_curves_keep_their_text_apart() {
    let mut found = Vec::new();
    let start = wigley();
    for (hull, before) in [(wigley(), Some(&start)), (frigate(), None)] {
        for kind in SurfaceMapKind::ALL {
            let canvas = surface_map::compose(&hull, before, kind).unwrap();
            found.extend(faults(&format!("{} {}", hull.name(), kind.key()), &canvas));
        }
        let draught = hull.particulars().draught;
        let table = CurvesOfForm::new(&hull, &[draught], &Conventions::default());
        let inputs = FigureInputs { hull: &hull, before: None, design: &table.rows[0], curves: &table };
        found.extend(faults(&format!("{} bonjean", hull.name()), &bonjean::compose(&inputs).unwrap()));
    }
    assert!(found.is_empty(), "{}", found.join("\n"));
}

/// A table of a Wigley hull with an error of some millimetres, faired.
fn record() -> FairRecord {
    let hull = wigley();
    let stations: Vec<OffsetStation> =
        (0..=10).map(|k| OffsetStation { name: k.to_string(), x: 10.0 * f64::from(k) }).collect();
    let waterlines: Vec<f64> = (0..=8).map(|k| 0.78125 * f64::from(k)).collect();
    let mut table = OffsetTable::from_hull(&hull, &stations, &waterlines, &[]);
    for (i, station) in table.stations.iter_mut().enumerate() {
        for (j, cell) in station.half_breadths.iter_mut().enumerate() {
            if let Some(y) = cell.value().filter(|y| *y > 0.1) {
                cell.entry = Entry::Given(y + 0.004 * (((7 * i + 3 * j) % 5) as f64 - 2.0));
            }
        }
    }
    FairRecord::new(&table, &Job::default().run(&table).unwrap())
}

#[test]
fn figures_of_faired_tables_keep_their_text_apart() {
    let record = record();
    let planes = Planes::with_defaults(&record.after);
    let buttocks = planes.buttocks.iter().map(|&y| Cut::Buttock { y }).collect();
    let figures = [
        ("arrows", fairing_arrows::compose(&record)),
        ("moves", fairing_moves::compose(&record)),
        ("body plan", fairing::body_plan(&record)),
        ("half-breadth plan", fairing::half_breadth_plan(&record)),
        ("buttocks", fairing_long::compose(&record, "BUTTOCKS", buttocks, |_, p| [p[0], p[2]])),
    ];
    let mut found = Vec::new();
    for (name, canvas) in figures {
        found.extend(faults(name, &canvas.unwrap()));
    }
    found.extend(faults("deviation", &deviation::compose(&record).unwrap().unwrap()));
    assert!(found.is_empty(), "{}", found.join("\n"));
}
