//! Knuckles and tangent lines that `check` proposes where a table does not declare them.

use loftsman::internals::exchange::read_table;
use loftsman::internals::fairing::{LineCourse, LineKind, ProposedLine, proposed_lines, suspects};
use loftsman::internals::hull::OffsetTable;

use crate::random::Random;
use crate::support::{carried, folder, sampled, table_of};

/// 25 stations and 21 waterlines of a hull with half-breadths `half(x, z)`, normal noise and a tenth of a millimetre.
fn made(half: impl Fn(f64, f64) -> f64, sigma: f64) -> OffsetTable {
    let mut random = Random(77);
    let waterlines: Vec<f64> = (0..21).map(|j| 0.5 * f64::from(j)).collect();
    sampled(waterlines, 25, |i| 4.0 * i + 2.0, 4, |x, z| half(x, z) + sigma * random.normal())
}

fn lines_of(table: &OffsetTable) -> Vec<ProposedLine> {
    proposed_lines(table, &suspects(table))
}

fn fullness(x: f64) -> f64 {
    1.0 - 0.4 * (x / 50.0 - 1.0).powi(2)
}

/// The place is that of a line of the table.
fn same(found: f64, place: f64) -> bool {
    (found - place).abs() < 1e-9
}

#[test]
fn knuckles_and_the_upper_edge_of_a_bilge_are_proposed_where_they_run() {
    // A chine at 6 m from end to end, with and without noise.
    for sigma in [0.0, 0.002] {
        let chined = |x: f64, z: f64| fullness(x) * (6.0 + 0.5 * z - 0.02 * z * z) + 0.35 * (z - 6.0).max(0.0);
        let lines = lines_of(&made(chined, sigma));
        let [line] = lines[..] else { panic!("{lines:?}") };
        assert_eq!((line.kind, line.course), (LineKind::Knuckle, LineCourse::Waterline));
        assert!(
            same(line.at, 6.0) && same(line.reach[0], 2.0) && same(line.reach[1], 98.0) && line.gain > 5.0,
            "{line:?}"
        );
    }
    // A chine that ends amidships.
    let ending = |x: f64, z: f64| {
        fullness(x) * (6.0 + 0.5 * z - 0.02 * z * z) + if x < 50.0 { 0.35 * (z - 6.0).max(0.0) } else { 0.0 }
    };
    let lines = lines_of(&made(ending, 0.001));
    assert!(
        lines.iter().any(|l| l.course == LineCourse::Waterline
            && same(l.at, 6.0)
            && same(l.reach[0], 2.0)
            && same(l.reach[1], 46.0)),
        "{lines:?}"
    );
    // A bilge of 4 m radius under a flat side: the curvature breaks.
    let bilge = |x: f64, z: f64| 9.0 * fullness(x) - 4.0 + (16.0 - 0.8 * (4.0 - z).max(0.0).powi(2)).sqrt();
    let lines = lines_of(&made(bilge, 0.0));
    let [line] = lines[..] else { panic!("{lines:?}") };
    assert_eq!((line.kind, line.course), (LineKind::Tangent, LineCourse::Waterline));
    assert!((line.at - 4.0).abs() <= 0.25 && same(line.reach[0], 2.0) && same(line.reach[1], 98.0), "{line:?}");
    // The run begins at 62 m: a tangent line along a station.
    let run = |x: f64, z: f64| (9.0 - 0.02 * (x - 62.0).max(0.0).powi(2)) * (1.0 - 0.3 * (1.0 - z / 12.0).powi(4));
    for sigma in [0.0, 0.002] {
        let lines = lines_of(&made(run, sigma));
        let [line] = lines[..] else { panic!("{lines:?}") };
        assert_eq!((line.kind, line.course), (LineKind::Tangent, LineCourse::Station));
        assert!(same(line.at, 62.0) && line.gain > 5.0, "{line:?}");
    }
}

#[test]
fn no_line_is_proposed_on_smooth_hulls() {
    let smooth = |x: f64, z: f64| 9.0 * fullness(x) * (1.0 - (1.0 - (z + 0.6) / 12.0).powi(6));
    for sigma in [0.0, 0.001, 0.005] {
        assert_eq!(lines_of(&made(smooth, sigma)), []);
    }
    let own = carried("tests/data");
    for name in ["series60_cb060", "series60_cb070", "series60_cb075", "s175", "wigley", "pdstrip_yacht"] {
        let lines = lines_of(&table_of(own.join(name).join("offsets.csv")));
        assert!(lines.is_empty(), "{name}: {lines:?}");
    }
}

#[test]
fn proposed_lines_are_printed_and_written() {
    let mut text = String::from("x");
    (0..16).for_each(|j| text.push_str(&format!(",{}", 0.5 * f64::from(j))));
    for i in 0..12 {
        text.push_str(&format!("\n{}", 5 * i));
        for z in (0..16).map(|j| 0.5 * f64::from(j)) {
            let y = 4.0 - 0.002 * (f64::from(5 * i) - 28.0).powi(2) + 0.3 * z + 0.4 * (z - 4.0).max(0.0);
            text.push_str(&format!(",{y:.4}"));
        }
    }
    let folder = folder("printed");
    folder.write("lines.csv", text + "\n");
    let check = loftsman::internals::report::check_table(&folder.join("lines.csv")).unwrap();
    let json = loftsman::internals::report::check_json(&check);
    let line = &json["lines"][0];
    assert_eq!((line["kind"].as_str(), line["course"].as_str()), (Some("knuckle"), Some("waterline")), "{json}");
    assert!(line["at"] == 4.0 && line["from"] == 0.0 && line["to"] == 55.0 && line["gain"].as_f64().unwrap() > 5.0);
    let page = loftsman::internals::report::check_page(&check);
    assert!(page.contains("knuckle along the waterline at 4.000 m, from 0.000 to 55.000 m"), "{page}");
    assert!(check.verdict(&[]).is_ok(), "a line that may be declared is no error");
}

/// Walls that flare out from other heights at other stations, and one misprint: what ends a wall is no misprint.
#[test]
fn the_end_of_a_wall_is_no_suspect() {
    let mut rows: Vec<Vec<String>> = Vec::new();
    for i in 0..17 {
        let s = (5.0 * f64::from(i) - 40.0) / 44.0;
        let wide = 8.0 * (1.0 - s * s);
        let flares = 9.0 - f64::from(i - 12);
        let half = |z: f64| {
            let bilge = if z < 4.0 { 1.0 - ((4.0 - z) / 4.6).powi(3) } else { 1.0 };
            let flare = if i >= 12 && z > flares { 0.4 * (z - flares).powf(1.3) } else { 0.0 };
            format!("{:.3}", wide * bilge + flare)
        };
        rows.push((0..12).map(|z| half(f64::from(z))).collect());
    }
    rows[5][7] = "7.700".to_owned();
    let heads: Vec<String> = (0..12).map(|z| z.to_string()).collect();
    let mut text = format!("x_m,{}\n", heads.join(","));
    for (i, row) in rows.iter().enumerate() {
        text += &format!("{},{}\n", 5 * i, row.join(","));
    }
    let table = read_table("t.csv", text.as_bytes()).unwrap().table;
    let found: Vec<_> = suspects(&table).suspects.iter().map(|s| (s.station, s.waterline)).collect();
    assert_eq!(found, [(5, 7)]);
}
