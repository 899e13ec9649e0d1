//! `check` on sections given as points and on heights at buttocks: planted errors are found, clean tables are silent.
//!
//! A planted error is one slip of the pen (digits swapped, a look-alike digit, one digit wrong, a decimal slipped) in y
//! or z of a point with three points on either side, that moves the point at least LEAST off the polygon through the
//! true neighbours; what moves it less, or along the section, changes no section. Tables that must not be carried are
//! read from the folder LOFTSMAN_DATA (or ../shared/data) and said to be skipped when it is absent.

use loftsman::internals::exchange::{TableWriting, read_table, write_table};
use loftsman::internals::fairing::{PointNumber, height_suspects, point_suspects};
use loftsman::internals::hull::{Entry, OffsetStation, OffsetTable};
use loftsman::internals::parametric::analytic::{Dimensions, wigley};
use loftsman::internals::report::{accept, check_json, check_page, check_table, read_table_file};
use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};

use crate::support::{carried, folder, read_text, shared_folder};

/// Least distance of a planted error from the section, in noise levels of the table and in quanta.
const LEAST: f64 = 10.0;

fn tables() -> Vec<(&'static str, OffsetTable)> {
    let mut list = Vec::new();
    for name in ["s175", "pdstrip_yacht"] {
        let file = carried(format!("tests/data/{name}/sections.csv"));
        list.push((name, read_table_file(&file).expect("a table").0));
    }
    let Some(folder) = shared_folder() else { return list };
    for (name, file) in
        [("dtc", "dtc/sections.csv"), ("dtmb5415", "dtmb5415/sections.csv"), ("moro", "moro_m16/M16_GG.bri")]
    {
        match read_table_file(&folder.join(file)) {
            Ok((table, _)) => list.push((name, table)),
            Err(_) => println!("skipped: {name}"),
        }
    }
    list
}

/// One slip of the pen in a number written with the decimals of the table.
fn slip(value: f64, decimals: usize, rng: &mut StdRng) -> Option<f64> {
    let text = format!("{value:.decimals$}");
    let mut bytes = text.clone().into_bytes();
    let digits: Vec<usize> = (0..bytes.len()).filter(|&k| bytes[k].is_ascii_digit()).collect();
    let k = digits[rng.random_range(0..digits.len())];
    match rng.random_range(0..4) {
        0 => {
            let next = *digits.iter().find(|&&d| d > k)?;
            bytes.swap(k, next);
        }
        1 => {
            bytes[k] = match bytes[k] {
                b'1' => b'7',
                b'7' => b'1',
                b'3' => b'8',
                b'8' => b'3',
                _ => return None,
            }
        }
        2 => bytes[k] = b'0' + (bytes[k] - b'0' + rng.random_range(1..10)) % 10,
        _ => return Some(value * if rng.random_range(0..2) == 0 { 10.0 } else { 0.1 }),
    }
    String::from_utf8(bytes).ok()?.parse().ok()
}

fn off(p: [f64; 2], line: &[[f64; 2]]) -> f64 {
    let one = |a: [f64; 2], b: [f64; 2]| {
        let (d, e) = ([b[0] - a[0], b[1] - a[1]], [p[0] - a[0], p[1] - a[1]]);
        let t = ((d[0] * e[0] + d[1] * e[1]) / (d[0] * d[0] + d[1] * d[1])).clamp(0.0, 1.0);
        (e[0] - t * d[0]).hypot(e[1] - t * d[1])
    };
    line.windows(2).map(|pair| one(pair[0], pair[1])).fold(f64::INFINITY, f64::min)
}

/// Plants `count` errors; the places (station, branch, point).
fn plant(table: &mut OffsetTable, noise: f64, count: usize, rng: &mut StdRng) -> Vec<(usize, usize, usize)> {
    let decimals = table.form.decimals.unwrap_or(4);
    let quantum = 10f64.powi(-i32::try_from(decimals).unwrap());
    let mut places = Vec::new();
    for _ in 0..10_000 {
        if places.len() == count {
            break;
        }
        let station = rng.random_range(0..table.stations.len());
        let outlines = &mut table.stations[station].outlines;
        if outlines.is_empty() {
            continue;
        }
        let branch = rng.random_range(0..outlines.len());
        let line = &mut outlines[branch];
        if line.len() < 7 || places.iter().any(|&(s, b, _)| (s, b) == (station, branch)) {
            continue;
        }
        let point = rng.random_range(3..line.len() - 3);
        let truth: Vec<[f64; 2]> = line[point - 3..=point + 3].iter().map(|p| [p.y, p.z]).collect();
        let (old, half) = (line[point], rng.random_range(0..2) == 0);
        let Some(value) = slip(if half { old.y } else { old.z }, decimals, rng) else { continue };
        let new = if half { [value, old.z] } else { [old.y, value] };
        if off(new, &truth) < LEAST * noise.max(quantum) {
            continue;
        }
        (line[point].y, line[point].z) = (new[0], new[1]);
        places.push((station, branch, point));
    }
    places
}

#[test]
fn planted_errors_in_sections_are_found() {
    let (mut planted, mut found, mut false_alarms, mut tables_read, mut repaired) = (0u32, 0u32, 0u32, 0u32, 0u32);
    for (name, clean) in tables() {
        let base = point_suspects(&clean);
        let known: Vec<_> = base.suspects.iter().map(|s| (s.station, s.branch, s.point)).collect();
        let points: usize = clean.stations.iter().flat_map(|s| &s.outlines).map(Vec::len).sum();
        println!("{name}: {} of {points} points judged, noise {:.5} m, clean {known:?}", base.judged, base.noise);
        assert!(base.judged as f64 > 0.8 * points as f64);
        let mut of_hull = [0u32; 4];
        // Tables of thousands of points take long without optimisation.
        for seed in 0..if points < 1000 { 20 } else { 3 } {
            let mut rng = StdRng::seed_from_u64(175 + seed);
            let mut table = clean.clone();
            let places = plant(&mut table, base.noise, 3, &mut rng);
            let result = point_suspects(&table);
            let hits = |place: &(usize, usize, usize)| {
                result.suspects.iter().find(|s| (s.station, s.branch, s.point) == *place)
            };
            of_hull[0] += places.len() as u32;
            of_hull[1] += places.iter().filter(|place| hits(place).is_some()).count() as u32;
            for place in &places {
                let point = &clean.stations[place.0].outlines[place.1][place.2];
                let Some(s) = hits(place) else {
                    let wrong = &table.stations[place.0].outlines[place.1][place.2];
                    println!("  missed {place:?}: ({}, {}) for ({}, {})", wrong.y, wrong.z, point.y, point.z);
                    continue;
                };
                of_hull[3] += u32::from((s.proposed - s.number.of(point)).abs() < 1e-9);
            }
            let others = result.suspects.iter().map(|s| (s.station, s.branch, s.point));
            of_hull[2] += others.filter(|s| !places.contains(s) && !known.contains(s)).count() as u32;
            tables_read += 1;
        }
        println!(
            "{name}: planted {}, found {}, others {}, repaired exactly {}",
            of_hull[0], of_hull[1], of_hull[2], of_hull[3]
        );
        planted += of_hull[0];
        found += of_hull[1];
        false_alarms += of_hull[2];
        repaired += of_hull[3];
    }
    let recall = f64::from(found) / f64::from(planted);
    println!(
        "all: planted {planted}, recall {recall:.3}, repaired {repaired}, false alarms {false_alarms} in {tables_read} tables"
    );
    assert!(planted > 50 && recall >= 0.85, "{found} of {planted}");
    assert!(f64::from(false_alarms) <= 0.5 * f64::from(tables_read), "{false_alarms} in {tables_read}");
}

#[test]
fn clean_sections_are_silent() {
    for (name, table) in tables() {
        let result = point_suspects(&table);
        assert!(result.suspects.len() <= 1, "{name}: {:#?}", result.suspects);
    }
}

#[test]
fn a_swapped_digit_of_a_section_is_named_and_repaired() {
    let text = read_text(carried("tests/data/pdstrip_yacht/sections.csv"));
    // 0.4542 of point 4 of the first section of twelve points.
    let wrong = text.replacen("-6.519845,6,0.5982,0.7720", "-6.519845,6,0.9582,0.7720", 1);
    assert_ne!(text, wrong);
    let folder = folder("repaired");
    folder.write("sections.csv", &wrong);
    let check = check_table(&folder.join("sections.csv")).unwrap();
    let (page, json) = (check_page(&check), check_json(&check));
    assert!(page.lines().all(|line| line.chars().count() <= 80), "{page}");
    assert!(page.contains("P1   station") && page.contains("digits swapped"), "{page}");
    let suspect = &json["suspects"][0];
    assert_eq!((&suspect["of"], &suspect["point"], &suspect["number"]), (&"point".into(), &6.into(), &"y".into()));
    assert_eq!((&suspect["written"], &suspect["proposed_written"]), (&"0.9582".into(), &"0.5982".into()));
    assert!(check.verdict(&[]).is_err() && check.verdict(&["P1".to_owned()]).is_ok());
    let accepted = accept(&check, &["P1".to_owned()]).unwrap();
    assert!(accepted.changes[0].contains("y 0.9582 becomes 0.5982"), "{:?}", accepted.changes);
    let back = read_table("sections.csv", accepted.text.as_bytes()).unwrap().table;
    let clean = read_table("sections.csv", text.as_bytes()).unwrap().table;
    for (a, b) in back.stations.iter().zip(&clean.stations) {
        for (p, q) in a.outlines.iter().flatten().zip(b.outlines.iter().flatten()) {
            assert!((p.y - q.y).abs() < 1e-9 && (p.z - q.z).abs() < 1e-9, "{p:?} {q:?}");
        }
    }
    assert_eq!(PointNumber::Height.as_str(), "z");
}

/// A table of half-breadths and heights lifted off Wigley's hull, in millimetres.
fn with_heights() -> OffsetTable {
    let dimensions = Dimensions { length: 100.0, breadth: 10.0, draught: 6.25, depth: 6.25 };
    let hull = wigley("Wigley", &dimensions).expect("a hull").hull;
    let buttocks: Vec<f64> = (1..13).map(|k| 0.3 * f64::from(k)).collect();
    let waterlines: Vec<f64> = (0..11).map(|k| 0.625 * f64::from(k)).collect();
    let stations: Vec<_> = (0..41).map(|k| OffsetStation { name: format!("{k}"), x: 2.5 * f64::from(k) }).collect();
    let mut lifted = OffsetTable::from_hull(&hull, &stations, &waterlines, &buttocks);
    for cell in lifted.stations.iter_mut().flat_map(|s| s.half_breadths.iter_mut().chain(&mut s.heights)) {
        if let Entry::Given(value) = &mut cell.entry {
            *value = ((*value * 1000.0).round() / 1000.0).max(0.0);
        }
    }
    let written = write_table(&lifted, TableWriting::default()).text;
    read_table("lifted.csv", written.as_bytes()).expect("what was written").table
}

#[test]
fn wrong_heights_at_buttocks_are_found() {
    let clean = with_heights();
    let base = height_suspects(&clean).expect("heights");
    assert!(base.suspects.len() <= 1, "{:#?}", base.suspects);
    assert!(height_suspects(&OffsetTable { buttocks: Vec::new(), ..clean.clone() }).is_none());
    let (mut planted, mut found) = (0u32, 0u32);
    for station in (14..27).step_by(2) {
        for buttock in [3, 5, 7] {
            let mut table = clean.clone();
            let cell = &mut table.stations[station].heights[buttock];
            let Some(height) = cell.value().filter(|&z| z > 0.2) else { continue };
            // A tenth too many, at least ten times the noise.
            let wrong = height + (0.1f64).max(10.0 * base.noise);
            cell.entry = Entry::Given(wrong);
            if let Some(written) = &mut cell.written {
                written.text = format!("{wrong:.4}");
            }
            let result = height_suspects(&table).expect("heights");
            planted += 1;
            found += u32::from(result.suspects.iter().any(|s| (s.station, s.waterline) == (station, buttock)));
            assert!(result.suspects.iter().all(|s| s.id.starts_with('H')));
        }
    }
    println!("heights: planted {planted}, found {found}, noise {:.4} m", base.noise);
    assert!(planted >= 8 && f64::from(found) >= 0.9 * f64::from(planted), "{found} of {planted}");
}
