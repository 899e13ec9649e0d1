//! Suspect cells: a real misprint, and a seeded study of planted errors on real hulls.
//!
//! The study. Hulls: the three Series 60 parents, S-175, Wigley and a yacht of `tests/data`; DTC, DTMB 5415, a VLCC
//! (its misprint repaired) and a coaster of the shared folder where it is there. Every hull is brought to the size of a
//! ship: those shorter than 100 m are scaled to 120 m, a table without a length to 320 m. Of DTMB 5415 the sections cut
//! through the transom are left out. Reading noise of 1, 5 or 20 mm is added to every offset; the table is written in
//! metres with three decimals, in whole millimetres or in feet-inches-eighths in turn. Then 1 to 5 errors are planted
//! in the written text, of kinds drawn evenly. An error counts when it is at least six noise levels: the noise level of
//! a cell is the root of the squares of the reading noise, of the rounding, and of the roughness of the clean table at
//! that cell, which is the root mean square, over the cell and its eight neighbours in both directions, of the distance
//! to the cubic through the nearest four offsets of the line, over the noise gain of that cubic. Cells from which no
//! such cubic can be laid in both directions get no error. The constants of the search were chosen on other seeds and
//! on these (910 000 and on, 2 to 5 million). With the seeds from 7 million, never looked at before, recall was 0.971
//! with 0.30 false alarms a table, none on tables without errors. Two cells of the published table of S-175 are errors
//! themselves: its third differences along the waterlines say 10.35 where 10.23 is printed (x 113.75 m, 4 m) and about
//! 11.40 for 11.68 (70 m, 2 m). Like the misprint of the VLCC they count neither as found nor as false alarms; unlike
//! it they are not repaired, since what was meant is not known. With LOFTSMAN_REPORT set, the study writes
//! reports/suspects/report.md and the example beside it.

use std::fmt::Write as _;
use std::path::Path;

use loftsman::internals::fairing::{Hypothesis, Suspects, suspects};
use loftsman::internals::hull::{Cell, Entry, Marks, OffsetTable, Written};
use loftsman::internals::units::Notation;

use crate::random::Random;
use crate::support::{carried, folder, read_text, shared_folder, table_of};

fn scale(table: &mut OffsetTable, factor: f64) {
    table.waterlines.iter_mut().for_each(|z| *z *= factor);
    for station in &mut table.stations {
        station.station.x *= factor;
        station.keel_height = station.keel_height.map(|z| z * factor);
        for cell in &mut station.half_breadths {
            if let Entry::Given(y) = &mut cell.entry {
                *y *= factor;
            }
        }
    }
}

fn vlcc(folder: &Path) -> OffsetTable {
    table_of(folder.join("vlcc_roh/offsets.csv"))
}

/// The hulls of the study, with their names.
fn hulls() -> Vec<(&'static str, OffsetTable)> {
    let own = carried("tests/data");
    let mut list: Vec<(&str, OffsetTable)> =
        ["series60_cb060", "series60_cb070", "series60_cb075", "s175", "wigley", "pdstrip_yacht"]
            .into_iter()
            .map(|name| (name, table_of(own.join(name).join("offsets.csv"))))
            .collect();
    if let Some(folder) = shared_folder() {
        for name in ["dtc", "dtmb5415", "coaster_sharif"] {
            list.push((name, table_of(folder.join(name).join("offsets.csv"))));
        }
        let mut table = vlcc(&folder);
        let at = misprint(&table);
        table.stations[at.0].half_breadths[at.1].entry = Entry::Given(29.633);
        list.push(("vlcc_roh", table));
    }
    for (name, table) in &mut list {
        if *name == "dtmb5415" {
            table.stations.retain(|station| station.station.x > 1.0);
        }
        let first = table.stations.first().unwrap().station.x;
        let length = table.stations.last().unwrap().station.x - first;
        if *name == "vlcc_roh" {
            // Only the stations are without a length: half-breadths are metres already.
            table.stations.iter_mut().for_each(|s| s.station.x *= 320.0 / length);
        } else if length < 99.0 {
            scale(table, 120.0 / length);
        }
    }
    list
}

fn misprint(table: &OffsetTable) -> (usize, usize) {
    let wrong = |cell: &Cell| cell.value().is_some_and(|y| (y - 29.363).abs() < 1e-9);
    (0..table.stations.len())
        .find_map(|i| table.stations[i].half_breadths.iter().position(wrong).map(|j| (i, j)))
        .unwrap()
}

#[test]
fn the_misprint_of_the_vlcc_is_found_and_its_swap_named() {
    let Some(folder) = shared_folder() else { return };
    let table = vlcc(&folder);
    let found = suspects(&table);
    let first = &found.suspects[0];
    assert_eq!((first.station, first.waterline), misprint(&table));
    assert_eq!(first.hypothesis(), Hypothesis::DigitsSwapped);
    assert!((first.proposed - 29.633).abs() < 1e-9 && first.proposed_text == "29.633", "{first:?}");
    assert!(first.probability > 0.999 && first.verdict.score < -6.0, "{first:?}");
    // The next is far behind.
    assert!(found.suspects.iter().skip(1).all(|s| s.verdict.score.abs() < 0.7 * first.verdict.score.abs()));
    let sum: f64 = first.readings.iter().map(|r| r.probability).sum();
    assert!((sum - 1.0).abs() < 1e-12);
}

/// Roughness of a clean table: see the head of this file.
fn roughness(table: &OffsetTable) -> Vec<Vec<f64>> {
    let (n, m) = (table.stations.len(), table.waterlines.len());
    let value = |i: isize, j: isize| {
        let station = table.stations.get(usize::try_from(i).ok()?)?;
        station.half_breadths.get(usize::try_from(j).ok()?)?.value().filter(|&y| y > 0.0)
    };
    let mut squares = vec![vec![(0.0, 0usize); m]; n];
    for (i, j) in (0..n).flat_map(|i| (0..m).map(move |j| (i, j))) {
        let (row, column) = (i as isize, j as isize);
        let Some(y) = value(row, column) else { continue };
        for along_station in [true, false] {
            let point = |k: isize| {
                let (r, c) = if along_station { (row, column + k) } else { (row + k, column) };
                let at = |r: isize, c: isize| {
                    if along_station { table.waterlines[c as usize] } else { table.stations[r as usize].station.x }
                };
                value(r, c).map(|y| (at(r, c), y))
            };
            let at = if along_station { table.waterlines[j] } else { table.stations[i].station.x };
            for four in [[-2, -1, 1, 2], [-1, 1, 2, 3], [-3, -2, -1, 1], [1, 2, 3, 4], [-4, -3, -2, -1]] {
                let points: Vec<(f64, f64)> = four.into_iter().filter_map(point).collect();
                if points.len() < 4 {
                    continue;
                }
                let weight = |a: usize| -> f64 {
                    (0..4).filter(|&b| b != a).map(|b| (at - points[b].0) / (points[a].0 - points[b].0)).product()
                };
                let residual = y - (0..4).map(|a| weight(a) * points[a].1).sum::<f64>();
                let gain = 1.0 + (0..4).map(|a| weight(a).powi(2)).sum::<f64>();
                squares[i][j].0 += residual * residual / gain;
                squares[i][j].1 += 1;
                break;
            }
        }
    }
    let level = |i: usize, j: usize| {
        if squares[i][j].1 < 2 {
            return f64::INFINITY;
        }
        let near = (i.saturating_sub(1)..(i + 2).min(n))
            .flat_map(|a| (j.saturating_sub(1)..(j + 2).min(m)).map(move |b| (a, b)));
        let (sum, count) = near.fold((0.0, 0), |s, (a, b)| (s.0 + squares[a][b].0, s.1 + squares[a][b].1));
        (sum / count as f64).sqrt()
    };
    (0..n).map(|i| (0..m).map(|j| level(i, j)).collect()).collect()
}

const KINDS: [&str; 8] = [
    "digits swapped",
    "1/7 or 3/8 misread",
    "decimal slipped",
    "wrong foot",
    "one digit wrong",
    "neighbouring waterline",
    "neighbouring station",
    "sign gained",
];

/// The text after an error of that kind; none where this text cannot have it.
fn corrupted(random: &mut Random, kind: usize, texts: &[Vec<String>], i: usize, j: usize) -> Option<String> {
    let text = &texts[i][j];
    let feet = text.contains('-');
    let mut chars: Vec<char> = text.chars().collect();
    let digits: Vec<usize> = (0..chars.len()).filter(|&k| chars[k].is_ascii_digit()).collect();
    let pick = digits[random.below(digits.len())];
    let up = random.below(2) == 0;
    match kind {
        0 => (chars.get(pick + 1)?.is_ascii_digit() && chars[pick] != chars[pick + 1])
            .then(|| chars.swap(pick, pick + 1))?,
        1 => chars[pick] = [('1', '7'), ('7', '1'), ('3', '8'), ('8', '3')].into_iter().find(|p| p.0 == chars[pick])?.1,
        2 if feet => return None,
        2 => match (text.find('.'), up) {
            (Some(dot), true) => chars.swap(dot, dot + 1),
            (Some(1), false) => return Some(format!("0.{}{}", chars[0], &text[2..])),
            (Some(dot), false) => chars.swap(dot - 1, dot),
            (None, true) => chars.push('0'),
            (None, false) => {
                chars.pop();
            }
        },
        3 => {
            let (whole, rest) = text.split_once('-').filter(|_| feet)?;
            let whole: i64 = whole.parse().ok()?;
            let other = if up { whole + 1 } else { whole - 1 };
            return (other >= 0).then(|| format!("{other}-{rest}"));
        }
        4 => chars[pick] = char::from_digit((chars[pick].to_digit(10)? + 1 + random.below(9) as u32) % 10, 10)?,
        5 => return texts[i].get(if up { j + 1 } else { j.checked_sub(1)? }).filter(|t| !t.is_empty()).cloned(),
        6 => {
            return texts
                .get(if up { i + 1 } else { i.checked_sub(1)? })
                .map(|row| row[j].clone())
                .filter(|t| !t.is_empty());
        }
        _ => return Some(format!("-{text}")),
    }
    Some(chars.into_iter().collect())
}

fn parsed(text: &str, notation: Notation) -> Option<f64> {
    if notation != Notation::FeetInchesEighths {
        return text.parse().ok().map(|number| notation.metres(number));
    }
    let (sign, rest) = text.strip_prefix('-').map_or((1.0, text), |rest| (-1.0, rest));
    let sixteenth = if rest.ends_with('+') { 1.0 / 16.0 } else { 0.0 };
    let parts: Vec<u32> = rest.trim_end_matches('+').split('-').map(|p| p.parse().ok()).collect::<Option<_>>()?;
    let [feet, inches, eighths] = parts[..] else { return None };
    let inch = f64::from(inches) + f64::from(eighths) / 8.0 + sixteenth;
    (inches < 12 && eighths < 8).then_some(sign * (0.3048 * f64::from(feet) + 0.0254 * inch))
}

struct Planted {
    place: (usize, usize),
    kind: usize,
    meant: String,
    what: String,
}

/// A table of the study with its errors.
fn planted(
    random: &mut Random,
    base: &OffsetTable,
    rough: &[Vec<f64>],
    sigma: f64,
    errors: usize,
    writing: usize,
) -> (OffsetTable, Vec<Planted>) {
    let mut table = base.clone();
    let notation = [Notation::Metres, Notation::Millimetres, Notation::FeetInchesEighths][writing];
    table.form.notation = notation;
    table.form.decimals = [Some(3), Some(0), None][writing];
    (table.form.full_breadths, table.form.negative, table.form.decimal_comma) = (false, false, false);
    let quantum = table.form.quantum().unwrap();
    let mut texts: Vec<Vec<String>> = Vec::new();
    for station in &table.stations {
        let mut row = Vec::new();
        for cell in &station.half_breadths {
            row.push(cell.value().map_or(String::new(), |y| {
                let read = if y > 0.0 { (y + sigma * random.normal()).max(0.001) } else { 0.0 };
                notation.write_to(read, table.form.decimals)
            }));
        }
        texts.push(row);
    }
    let clean = texts.clone();
    let mut list: Vec<Planted> = Vec::new();
    for _ in 0..4000 {
        if list.len() == errors {
            break;
        }
        let kind = random.below(KINDS.len());
        for _ in 0..40 {
            let (i, j) = (random.below(texts.len()), random.below(table.waterlines.len()));
            let hull = base.stations[i].half_breadths[j].value().is_some_and(|y| y > 0.0);
            if !hull || list.iter().any(|p| p.place == (i, j)) {
                continue;
            }
            let Some(wrong) = corrupted(random, kind, &clean, i, j) else { continue };
            let (Some(a), Some(b)) = (parsed(&clean[i][j], notation), parsed(&wrong, notation)) else { continue };
            let level = (sigma * sigma + rough[i][j].powi(2) + quantum * quantum / 12.0).sqrt();
            if !level.is_finite() || (b - a).abs() < 6.0 * level {
                continue;
            }
            let what = format!("({i}, {j}) {} for {}, {:.0} levels", wrong, clean[i][j], (b - a).abs() / level);
            list.push(Planted { place: (i, j), kind, meant: clean[i][j].clone(), what });
            texts[i][j] = wrong;
            break;
        }
    }
    for (i, (station, row)) in table.stations.iter_mut().zip(texts).enumerate() {
        for (j, (cell, text)) in station.half_breadths.iter_mut().zip(row).enumerate() {
            let entry = parsed(&text, notation).map_or(Entry::Absent, Entry::Given);
            let written = (!text.is_empty()).then_some(Written { text, row: i + 2, column: j + 2 });
            *cell = Cell { entry, marks: Marks::default(), written };
        }
    }
    (table, list)
}

#[derive(Default, Clone, Copy)]
struct Count {
    planted: usize,
    found: usize,
    repaired: usize,
    alarms: usize,
    tables: usize,
    clean_alarms: usize,
    clean_tables: usize,
}

impl Count {
    fn recall(&self) -> f64 {
        self.found as f64 / self.planted.max(1) as f64
    }

    fn alarms_a_table(&self) -> f64 {
        self.alarms as f64 / self.tables.max(1) as f64
    }

    fn clean_alarms_a_table(&self) -> f64 {
        self.clean_alarms as f64 / self.clean_tables.max(1) as f64
    }
}

const SIGMAS: [f64; 3] = [0.001, 0.005, 0.02];
/// Tables with errors.
const TABLES: usize = 200;
/// Tables without: every hull with every noise, twice, and as it is.
const CLEAN_ROUNDS: usize = 2;

struct Study {
    by_noise: [Count; 3],
    by_kind: [Count; 8],
    by_hull: Vec<(&'static str, Count)>,
    total: Count,
    misses: Vec<String>,
    false_alarms: Vec<String>,
    /// How often a table with planted errors held a cell that is wrong as published, and how often it was named.
    published: [usize; 2],
}

/// Cells that are wrong in the table as published: see the head of this file.
const PUBLISHED_WRONG: [(f64, f64); 2] = [(113.75, 4.0), (70.0, 2.0)];

fn published_wrong(name: &str, table: &OffsetTable, place: (usize, usize)) -> bool {
    let at = (table.stations[place.0].station.x, table.waterlines[place.1]);
    name == "s175" && PUBLISHED_WRONG.contains(&at)
}

fn described(result: &Suspects, table: &OffsetTable, name: &str, k: usize) -> String {
    let s = &result.suspects[k];
    let station = &table.stations[s.station].station;
    format!(
        "{name} x {:.2} z {:.2} {} score {:+.1}",
        station.x, table.waterlines[s.waterline], s.written, s.verdict.score
    )
}

fn study() -> Study {
    let hulls = hulls();
    let rough: Vec<Vec<Vec<f64>>> = hulls.iter().map(|(_, table)| roughness(table)).collect();
    let mut result = Study {
        by_noise: [Count::default(); 3],
        by_kind: [Count::default(); 8],
        by_hull: hulls.iter().map(|&(name, _)| (name, Count::default())).collect(),
        total: Count::default(),
        misses: Vec::new(),
        false_alarms: Vec::new(),
        published: [0; 2],
    };
    let count = |result: &mut Study, hull: usize, noise: Option<usize>, change: &dyn Fn(&mut Count)| {
        change(&mut result.total);
        change(&mut result.by_hull[hull].1);
        if let Some(noise) = noise {
            change(&mut result.by_noise[noise]);
        }
    };
    for t in 0..TABLES {
        let (hull, noise) = (t % hulls.len(), (t / hulls.len()) % 3);
        let mut random = Random(910_000 + 17 * t as u64);
        let errors = 1 + random.below(5);
        let writing = random.below(3);
        let (table, list) = planted(&mut random, &hulls[hull].1, &rough[hull], SIGMAS[noise], errors, writing);
        let found = suspects(&table);
        count(&mut result, hull, Some(noise), &|c| c.tables += 1);
        for error in &list {
            let hit = found.suspects.iter().find(|s| (s.station, s.waterline) == error.place);
            let repaired = usize::from(hit.is_some_and(|s| s.proposed_text == error.meant));
            let add = |c: &mut Count| {
                c.planted += 1;
                c.found += usize::from(hit.is_some());
                c.repaired += repaired;
            };
            add(&mut result.by_kind[error.kind]);
            count(&mut result, hull, Some(noise), &add);
            if hit.is_none() {
                let mm = 1000.0 * SIGMAS[noise];
                result.misses.push(format!("{} {mm} mm: {} {}", hulls[hull].0, KINDS[error.kind], error.what));
            }
        }
        if hulls[hull].0 == "s175" {
            // Where an error was planted into one of the two, that is what is found there.
            let overwritten = |e: &&Planted| published_wrong("s175", &table, e.place);
            result.published[0] += PUBLISHED_WRONG.len() - list.iter().filter(overwritten).count();
        }
        for (k, suspect) in found.suspects.iter().enumerate() {
            let place = (suspect.station, suspect.waterline);
            let known = published_wrong(hulls[hull].0, &table, place);
            if !known && !list.iter().any(|error| error.place == place) {
                count(&mut result, hull, Some(noise), &|c| c.alarms += 1);
                result.false_alarms.push(described(&found, &table, hulls[hull].0, k));
            }
            if known && !list.iter().any(|error| error.place == place) {
                result.published[1] += 1;
            }
        }
    }
    for (hull, (name, base)) in hulls.iter().enumerate() {
        for noise in [None, Some(0), Some(1), Some(2)] {
            for round in 0..if noise.is_some() { CLEAN_ROUNDS } else { 1 } {
                let mut random =
                    Random(1_000_000 + 1000 * hull as u64 + 10 * noise.map_or(9, |n| n as u64) + round as u64);
                let sigma = noise.map_or(0.0, |n| SIGMAS[n]);
                let writing = random.below(3);
                let table = match noise {
                    Some(_) => planted(&mut random, base, &rough[hull], sigma, 0, writing).0,
                    None => base.clone(),
                };
                let found = suspects(&table);
                count(&mut result, hull, noise, &|c| {
                    c.clean_tables += 1;
                    c.clean_alarms += found.suspects.len();
                });
                for k in 0..found.suspects.len() {
                    result.false_alarms.push(format!("clean {}", described(&found, &table, name, k)));
                }
            }
        }
    }
    result
}

fn page(study: &Study) -> String {
    let mut text = String::from(
        "# Suspect offsets: a study with planted errors\n\nMade by `LOFTSMAN_REPORT=1 cargo test --test integration suspects::`. ",
    );
    text.push_str("What the tables are and what a noise level is: head of `tests/suspects.rs`.\n\n");
    let row = |text: &mut String, name: &str, c: &Count| {
        let _ = writeln!(
            text,
            "| {name} | {} | {} | {:.3} | {:.2} | {:.2} | {:.2} |",
            c.planted,
            c.found,
            c.recall(),
            c.repaired as f64 / c.found.max(1) as f64,
            c.alarms_a_table(),
            c.clean_alarms_a_table()
        );
    };
    let head = "| planted | found | recall | repaired exactly | false alarms a table | a table without errors |\n|---|---|---|---|---|---|---|\n";
    let _ = write!(text, "| reading noise {head}");
    for (sigma, c) in SIGMAS.iter().zip(&study.by_noise) {
        row(&mut text, &format!("{} mm", 1000.0 * sigma), c);
    }
    row(&mut text, "all", &study.total);
    let _ = write!(text, "\n| hull {head}");
    study.by_hull.iter().for_each(|(name, c)| row(&mut text, name, c));
    text.push_str("\n| kind | planted | found | recall | repaired exactly |\n|---|---|---|---|---|\n");
    for (name, c) in KINDS.iter().zip(&study.by_kind) {
        let exact = c.repaired as f64 / c.found.max(1) as f64;
        let _ = writeln!(text, "| {name} | {} | {} | {:.3} | {exact:.2} |", c.planted, c.found, c.recall());
    }
    let _ = writeln!(
        text,
        "\n{} tables with errors, {} without. Wanted: recall 0.95, at most 0.5 false alarms a table, at most 0.1 a table without errors. \
         \"Repaired exactly\": the proposal is the text that was overwritten; a copied neighbour leaves nothing to repair from.\n",
        study.total.tables, study.total.clean_tables
    );
    let [held, named] = study.published;
    let all = study.total;
    let s175 = study.by_hull.iter().find(|(name, _)| *name == "s175").map_or(Count::default(), |(_, c)| *c);
    let alarms = |c: &Count| (c.alarms + named) as f64 / c.tables.max(1) as f64;
    let recall = (all.found + named) as f64 / (all.planted + held).max(1) as f64;
    let _ = writeln!(
        text,
        "## Two cells of the published table of S-175\n\n\
         At x 113.75 m, z 4 m (10.23) and at x 70 m, z 2 m (11.68) the third differences along the waterlines speak against what is printed \
         (10.35 and about 11.40); what was meant is not known. They stood in the tables with planted errors {held} times and were named \
         {named} times; on the tables without errors every suspect counts as a false alarm, these two included. Three ways of \
         counting:\n\n\
         | the two cells count as | recall | false alarms a table | of S-175 |\n|---|---|---|---|\n\
         | nothing, as in the figures above | {:.3} | {:.2} | {:.2} |\n\
         | right, so that naming them is a false alarm | {:.3} | {:.2} | {:.2} |\n\
         | wrong, so that not naming them is a miss | {recall:.3} | {:.2} | {:.2} |\n\n## Missed\n",
        all.recall(),
        all.alarms_a_table(),
        s175.alarms_a_table(),
        all.recall(),
        alarms(&all),
        alarms(&s175),
        all.alarms_a_table(),
        s175.alarms_a_table(),
    );
    study.misses.iter().for_each(|line| text.push_str(&format!("* {line}\n")));
    text.push_str("\n## False alarms\n\n");
    study.false_alarms.iter().for_each(|line| text.push_str(&format!("* {line}\n")));
    text
}

#[test]
fn planted_errors_are_found_and_hulls_are_left_alone() {
    let study = study();
    let text = page(&study);
    println!("{text}");
    if std::env::var_os("LOFTSMAN_REPORT").is_some() {
        let folder = carried("reports/suspects");
        std::fs::create_dir_all(&folder).unwrap();
        std::fs::write(folder.join("report.md"), &text).unwrap();
        example(&folder);
    }
    let total = study.total;
    assert!(total.tables == TABLES && total.planted > 2 * TABLES);
    assert!(total.recall() >= 0.95, "recall {:.3}", total.recall());
    assert!(total.alarms_a_table() <= 0.5, "{:.2} false alarms a table", total.alarms_a_table());
    assert!(total.clean_alarms_a_table() <= 0.1, "{:.2} a clean table", total.clean_alarms_a_table());
}

/// A Series 60 parent with three errors, and what `check` makes of it.
fn example(folder: &Path) {
    let source = read_text(carried("tests/data/series60_cb060/offsets.csv"));
    let wrong = source.replacen("6.7788", "6.7738", 1).replacen("5.1159", "5.1519", 1).replacen("7.1852", "1.7852", 1);
    std::fs::write(folder.join("series60-misprinted.csv"), &wrong).unwrap();
    let check = loftsman::internals::report::check_table(&folder.join("series60-misprinted.csv")).unwrap();
    let files = loftsman::internals::report::check_files(&check, true).unwrap();
    loftsman::internals::report::Destination {
        folder,
        inputs: &loftsman::internals::report::Inputs::default(),
        force: true,
    }
    .write(&files)
    .unwrap();
}

#[test]
fn accepting_changes_the_named_cells_and_nothing_else() {
    let folder = folder("accept");
    let source = read_text(carried("tests/data/series60_cb060/offsets.csv"));
    let wrong = source.replacen("7.1852", "1.7852", 1).replacen("5.1159", "5.1519", 1);
    let path = folder.join("table.csv");
    std::fs::write(&path, &wrong).unwrap();
    let check = loftsman::internals::report::check_table(&path).unwrap();
    let list = &check.suspects.as_ref().unwrap().suspects;
    let first = &list[0];
    assert_eq!((first.written.as_str(), first.proposed_text.as_str()), ("1.7852", "7.1852"));
    assert_eq!(first.hypothesis(), Hypothesis::DigitsSwapped);
    let accepted = loftsman::internals::report::accept(&check, &["S1".to_owned()]).unwrap();
    assert_eq!(accepted.text, wrong.replacen("1.7852", "7.1852", 1));
    assert_eq!(accepted.changes.len(), 1);
    assert!(accepted.changes[0].contains("1.7852 becomes 7.1852"), "{:?}", accepted.changes);
    let unknown = loftsman::internals::report::accept(&check, &["S99".to_owned()]).unwrap_err().to_string();
    assert!(unknown.contains("E203 no suspect is called S99: there are S1"), "{unknown}");
    let json = loftsman::internals::report::check_json(&check);
    assert_eq!(json["suspects"][0]["written"], "1.7852");
    assert_eq!(json["suspects"][0]["row"], first_row(&wrong, "1.7852"));
    assert!(json["noise"]["sigma"].as_f64().unwrap() > 0.0 && json["lines"].as_array().unwrap().is_empty());
    let failure = check.verdict(&[]).unwrap_err();
    assert_eq!(failure.exit_code(), 5);
    assert!(failure.to_string().contains(&format!("E502 {} suspect", list.len())), "{failure}");
    let all: Vec<String> = list.iter().map(|s| s.id.clone()).collect();
    assert!(check.verdict(&all).is_ok());
}

fn first_row(text: &str, cell: &str) -> usize {
    text.lines().position(|line| line.contains(cell)).unwrap() + 1
}
