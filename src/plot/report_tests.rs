//! The figures of reports: text keeps apart and on the sheet, and they fit into the frame of A3.

use super::figures::fairing::body::BodyView;
use super::figures::fairing::combs::FairingCombs;
use super::figures::fairing::long::Kind;
use super::figures::fairing::strip_lines::Along;
use super::figures::fairing::{arrows, arrows_long, body, curves, half_breadths, long, moves, suspects, table};
use super::figures::map_legend::SurfaceMapKind;
use super::figures::surface_map::SurfaceMaps;
use super::figures::{bonjean, deviation, pareto, surface_map};
use super::paper::canvas::Canvas;
use super::paper::error::PlotError;
use super::paper::sheet::{ROOM, Sheet};
use super::ship::inputs::FigureInputs;
use crate::fairing::job::Job;
use crate::fairing::record::FairRecord;
use crate::hull::{Entry, Hull, OffsetStation, OffsetTable};
use crate::hydrostatics::{Conventions, CurvesOfForm};
use crate::parametric::ShipType;
use crate::parametric::analytic::{self, Dimensions};
use crate::parametric::cosh::{self, DesignTargets};
use crate::units::Notation;

fn faults(name: &str, canvas: &Canvas) -> Vec<String> {
    faults_within(ROOM, name, canvas)
}

fn faults_within(room: [f64; 2], name: &str, canvas: &Canvas) -> Vec<String> {
    let (texts, sheet) = (canvas.texts(), canvas.sheet());
    let mut faults = Vec::new();
    if sheet.width() > room[0] + 1e-9 || sheet.height() > room[1] + 1e-9 {
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

/// Lines and areas of a document in millimetres that leave its sheet.
fn outside([width, height]: [f64; 2], document: &str) -> Vec<String> {
    let points = document.split(" points=\"").skip(1).filter_map(|rest| rest.split('"').next());
    let has = |point: &str| {
        let place: Vec<f64> = point.split(',').filter_map(|c| c.parse().ok()).collect();
        matches!(place[..], [x, y] if (0.0..=width).contains(&x) && (0.0..=height).contains(&y))
    };
    points.flat_map(str::split_whitespace).filter(|point| !has(point)).map(str::to_owned).collect()
}

fn wigley() -> Hull {
    let dimensions = Dimensions { length: 100.0, breadth: 10.0, draught: 6.25, depth: 9.0 };
    analytic::wigley("Wigley", &dimensions).unwrap().hull
}

fn frigate() -> Hull {
    let requested = DesignTargets {
        ship_type: Some(ShipType::Frigate),
        length: 100.0,
        breadth: Some(13.2),
        draught: Some(4.4),
        depth: Some(9.0),
        block_coefficient: Some(0.5),
        ..DesignTargets::default()
    };
    cosh::generate("frigate", &requested).unwrap().hull
}

#[test]
fn maps_and_bonjean_curves_keep_their_text_apart() {
    let mut found = Vec::new();
    let start = wigley();
    for (hull, before) in [(wigley(), Some(&start)), (frigate(), None)] {
        let maps = SurfaceMaps::new(&hull, before);
        for kind in SurfaceMapKind::ALL {
            let canvas = surface_map::compose(&maps, kind).unwrap();
            found.extend(faults(&format!("{} {}", hull.name(), kind.key()), &canvas));
        }
        let draught = hull.reference_height();
        let table = CurvesOfForm::new(&hull, &[draught], &Conventions::default());
        let inputs = FigureInputs {
            hull: &hull,
            before: None,
            record: None,
            design: table.rows.first(),
            curves: &table,
            source: None,
            dense: None,
        };
        found.extend(faults(&format!("{} bonjean", hull.name()), &bonjean::compose(&inputs).unwrap()));
    }
    assert!(found.is_empty(), "{}", found.join("\n"));
}

/// A table of a Wigley hull with an error of some millimetres and two wrong offsets, written in feet, inches and
/// eighths, with a knuckle, faired.
fn record() -> FairRecord {
    record_of(100.0)
}

/// The same of a ship of another length.
fn record_of(length: f64) -> FairRecord {
    let dimensions = Dimensions { length, breadth: 10.0, draught: 6.25, depth: 9.0 };
    let hull = analytic::wigley("Wigley", &dimensions).unwrap().hull;
    let stations: Vec<OffsetStation> =
        (0..=20).map(|k| OffsetStation { name: k.to_string(), x: 0.05 * length * f64::from(k) }).collect();
    let waterlines: Vec<f64> = (0..=8).map(|k| 0.78125 * f64::from(k)).collect();
    let mut table = OffsetTable::from_hull(&hull, &stations, &waterlines, &[]);
    for (i, station) in table.stations.iter_mut().enumerate() {
        for (j, cell) in station.half_breadths.iter_mut().enumerate() {
            if let Some(y) = cell.value().filter(|y| *y > 0.1) {
                let wrong = if (i, j) == (6, 4) || (i, j) == (14, 5) { 0.35 } else { 0.0 };
                cell.entry = Entry::Given(y + wrong + 0.004 * (((7 * i + 3 * j) % 5) as f64 - 2.0));
            }
        }
    }
    table.form.notation = Notation::FeetInchesEighths;
    table.stations[10].half_breadths[8].marks.knuckle = true;
    FairRecord::new(&table, &Job::default().run(&table).unwrap())
}

#[test]
fn long_ships_have_a_sheet_for_each_half() {
    let record = record_of(380.0);
    let combs = FairingCombs::new(&record, &[]);
    let words = |canvas: &Canvas, part: &str| canvas.texts().iter().any(|text| text.content.contains(part));
    for sheet in Sheet::ALL {
        for (name, sheets) in [
            ("half-breadth plan", half_breadths::half_breadth_plan(&record, &combs, sheet).unwrap()),
            ("diagonals", long::compose(&record, &combs, sheet, Kind::Diagonals).unwrap()),
        ] {
            // Diagonals are two to a sheet.
            let [aft, fore, ..] = &sheets[..] else { panic!("{name}: {} sheets", sheets.len()) };
            assert!(words(aft, ", AFT BODY TO x = 190.00 m") && words(fore, ", FORE BODY FROM x = 190.00 m"));
            // On A3 the whole would be 1:1250.
            assert!(sheet != Sheet::A3 || words(aft, "scale 1:750") && words(fore, "scale 1:750"));
            let found: Vec<String> = sheets.iter().flat_map(|one| faults_within(sheet.room(), name, one)).collect();
            assert!(found.is_empty(), "{}", found.join("\n"));
        }
    }
}

#[test]
fn body_plans_fill_their_sheet_and_name_every_station() {
    // At 1:100 a plan of 9 m is half as wide as the sheet, at 1:50 it fits no more: 1:75.
    for (breadth, depth, n) in [(10.0, 9.0, 50), (15.0, 7.0, 50), (20.0, 9.0, 75), (24.0, 9.0, 75), (25.0, 14.0, 100)] {
        let view = BodyView::of([0.5 * breadth, 0.0, depth], 0.0, Sheet::A3.room());
        assert_eq!(view.n, n, "{breadth} x {depth}");
    }
    let record = record();
    let combs = FairingCombs::new(&record, &[]);
    let plans = [body::body_plan(&record, &combs, Sheet::A3).unwrap(), arrows::compose(&record, Sheet::A3).unwrap()];
    for plan in plans {
        let is_number = |text: &str| text.parse::<usize>().ok();
        let named: Vec<usize> = plan
            .texts()
            .iter()
            .flat_map(|text| match text.content.split_once(" – ") {
                Some((first, last)) => match (is_number(first), is_number(last)) {
                    (Some(first), Some(last)) => (first..=last).collect(),
                    _ => Vec::new(),
                },
                None => is_number(&text.content).into_iter().collect(),
            })
            .collect();
        // The ends of a Wigley hull have no section.
        for station in 1..20 {
            assert!(named.contains(&station), "station {station} bears no name: {named:?}");
        }
    }
}

#[test]
fn figures_of_faired_tables_keep_their_text_apart() {
    let record = record();
    assert_eq!(record.doubts.len(), 2);
    let combs = FairingCombs::new(&record, &[]);
    let mut found = Vec::new();
    for sheet in Sheet::ALL {
        let mut scales = std::collections::BTreeSet::new();
        let one = |canvas: Result<Canvas, PlotError>| canvas.map(|canvas| vec![canvas]);
        let figures = [
            ("arrows", one(arrows::compose(&record, sheet))),
            ("long arrows", one(arrows_long::compose(&record, sheet))),
            ("body plan", one(body::body_plan(&record, &combs, sheet))),
            ("half-breadth plan", half_breadths::half_breadth_plan(&record, &combs, sheet)),
            ("buttocks", long::compose(&record, &combs, sheet, Kind::Buttocks)),
            ("diagonals", long::compose(&record, &combs, sheet, Kind::Diagonals)),
            ("suspects", one(suspects::compose(&record, sheet).map(Option::unwrap))),
            ("waterlines", Ok(vec![curves::compose(&record, &combs, sheet, Along::Ship).unwrap()])),
            ("stations", Ok(vec![curves::compose(&record, &combs, sheet, Along::Height).unwrap()])),
        ];
        let sheets =
            figures.into_iter().flat_map(|(name, sheets)| sheets.unwrap().into_iter().map(move |one| (name, one)));
        for (name, canvas) in sheets {
            let name = format!("{name} on {}", sheet.as_str());
            let words = canvas.texts().iter().filter_map(|text| text.content.split("combs of ").nth(1));
            // How many of all lines bear combs is not the same on all sheets.
            let counted = |word: &str| word == "of" || word.parse::<usize>().is_ok();
            let scale = |words: &str| words.split(' ').skip_while(|word| counted(word)).collect::<Vec<_>>().join(" ");
            scales.extend(words.filter_map(|words| Some(scale(&words[..words.find("1/m")?]))));
            found.extend(faults_within(sheet.room(), &name, &canvas));
            let beyond = outside(sheet.room(), &canvas.finish(&name));
            found.extend(beyond.first().map(|point| format!("{name}: {} points off the sheet, {point}", beyond.len())));
        }
        // One scale for each kind of line, whatever the sheet.
        assert_eq!(scales.len(), 4, "{scales:?}");
    }
    let moves = moves::compose(&record).unwrap();
    let words: Vec<&str> = moves.texts().iter().map(|text| text.content.as_str()).collect();
    assert!(words.iter().any(|word| word.starts_with("moves in eighths of an inch")), "{words:?}");
    found.extend(faults("moves", &moves));
    let limit = 0.0254 / 8.0;
    let [sheet] = &table::compose(&record, &[], limit, "1/8 in")[..] else { panic!("one sheet is enough") };
    let words: Vec<&str> = sheet.texts().iter().map(|text| text.content.as_str()).collect();
    let more = record.changes.iter().filter(|c| !c.suspect && (c.after - c.before).abs() > limit).count();
    assert!(more > 0 && words.contains(&format!("moved by more than 1/8 in: {more}").as_str()), "{words:?}");
    assert!(words.iter().any(|word| word.starts_with("left out as a suspect") && word.ends_with(": 2")), "{words:?}");
    let written = record.changes.iter().map(|change| record.lines.notation.write(change.after));
    assert!(written.into_iter().all(|text| words.contains(&text.as_str())));
    found.extend(faults("faired offsets", sheet));
    found.extend(faults("deviation", &deviation::compose(&record).unwrap().unwrap()));
    let front = pareto::compose(&record).unwrap().unwrap();
    let said = |part: &str| front.texts().iter().any(|text| text.content.contains(part));
    // The likeliest field has a deviation, and the surface through the table is none of its front.
    assert_eq!(said("% of the energy of the likeliest field"), record.is_field);
    assert_eq!(said("before: the surface through the table"), !record.is_field);
    found.extend(faults("pareto", &front));
    assert!(found.is_empty(), "{}", found.join("\n"));
}
