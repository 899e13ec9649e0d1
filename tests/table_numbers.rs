//! Numbers of stations and waterlines by what is stated of them: spacings, L_PP, units, words of titles.

use crate::table_evidence::read;
use loftsman::internals::hull::OffsetTable;

/// Sections y = w (z / h)^(1/2) of a hull of 21 stations and 7 waterlines, with these heads.
fn table(title: &str, corner: &str, stations: &[f64], waterlines: &[&str], scale: f64) -> String {
    let mut text = format!("{title}{corner},{}\n", waterlines.join(","));
    let count = stations.len() as f64 - 1.0;
    for (k, station) in stations.iter().enumerate() {
        let s = 2.0 * k as f64 / count - 1.0;
        let width = 9.0 * (1.0 - s.powi(4)) * (1.0 + 0.1 * s);
        let cells = (0..waterlines.len()).map(|j| scale * width * (j as f64 / 6.0).sqrt());
        let cells: Vec<String> = cells.map(|y| format!("{y:.3}")).collect();
        text += &format!("{station},{}\n", cells.join(","));
    }
    text
}

fn count(n: usize) -> Vec<f64> {
    (0..n).map(|k| k as f64).collect()
}

const WATERLINES: [&str; 7] = ["0", "1", "2", "3", "4", "5", "6"];

fn extents(table: &OffsetTable) -> [f64; 2] {
    let x: Vec<f64> = table.stations.iter().map(|station| station.station.x).collect();
    [x[x.len() - 1] - x[0], *table.waterlines.last().unwrap()]
}

fn near(found: [f64; 2], expected: [f64; 2]) -> bool {
    found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-9)
}

#[test]
fn a_stated_spacing_counts_bare_numbers() {
    for corner in ["Station", "", "Stn", "Station\\z"] {
        let text = table("", corner, &count(21), &WATERLINES, 1.0);
        let beside = "[table]\nwaterline_spacing = 1.5\nstation_spacing = 6\nunits = \"m\"\n";
        let read = read(&text, beside).unwrap();
        assert!(near(extents(&read.table), [120.0, 9.0]), "{corner}: {:?}", extents(&read.table));
    }
    for title in [
        "Stations spaced 6 m; waterlines spaced 1.5 m\n",
        "Distance between stations 6 m; distance between waterlines 1.5 m\n",
        "All waterlines 1.50 m apart and all stations 6.00 m apart\n",
        "Stations at 6 m intervals; waterlines at 1.5 m intervals\n",
        "Section spacing 6.000 m / waterline spacing 1.500 m\n",
        "Sta. spacing: 6 m; WLs 1.5m apart\n",
    ] {
        let read = read(&table(title, "Station", &count(21), &WATERLINES, 1.0), "").unwrap();
        assert!(near(extents(&read.table), [120.0, 9.0]), "{title}: {:?}", extents(&read.table));
    }
}

/// Heights and distances that have the spacing already are not multiplied by it, and the user is warned.
#[test]
fn a_spacing_does_not_multiply_positions() {
    let stations: Vec<f64> = (0..21).map(|k| 6.0 * f64::from(k)).collect();
    let text = table("", "", &stations, &["0", "1.5", "3", "4.5", "6", "7.5", "9"], 1.0);
    let read = read(&text, "[table]\nwaterline_spacing = 1.5\nstation_spacing = 6\n").unwrap();
    assert!(near(extents(&read.table), [120.0, 9.0]), "{:?}", extents(&read.table));
    assert!(read.notes.iter().any(|p| p.code == "W332" && p.message.contains("waterline_spacing")));
}

/// Bare whole numbers beside numbered stations, or above a base line, may be numbers.
#[test]
fn heights_that_may_be_numbers_are_named() {
    let mut heads = WATERLINES;
    for (first, beside) in [("0", "[table]\nLpp = 120\n"), ("Base", "[table]\nLpp = 120\n"), ("BL", "")] {
        heads[0] = first;
        let corner = if beside.is_empty() { "x [m]" } else { "Station" };
        let read = read(&table("", corner, &count(21), &heads, 0.1), beside).unwrap();
        let warned = read.notes.iter().any(|p| p.code == "W320" && p.message.contains("may be numbers"));
        assert!(warned || corner == "x [m]", "{first}");
    }
    let read = read(
        &table("", "Station", &count(21), &["0", "1.5", "3.0", "4.5", "6.0", "7.5", "9.0"], 1.0),
        "[table]\nLpp = 120\n",
    );
    assert!(!read.unwrap().notes.iter().any(|p| p.message.contains("may be numbers, and")));
}

/// Numbers that reach far less than L_PP count its spaces; from -10 to 10 there are twenty.
#[test]
fn the_length_between_perpendiculars_settles_numbers() {
    let from_midship: Vec<f64> = (-10..=10).map(f64::from).collect();
    let shares: Vec<f64> = (0..21).map(|k| f64::from(k) / 20.0).collect();
    for (corner, stations) in [("", count(21)), ("", from_midship), ("x/L", shares)] {
        let read = read(&table("", corner, &stations, &WATERLINES, 1.0), "[table]\nLpp = 120\n").unwrap();
        assert!((extents(&read.table)[0] - 120.0).abs() < 1e-9, "{corner} {stations:?}");
    }
}

/// No station is numbered 19.685: the unit that is declared is that of distances.
#[test]
fn distances_in_a_column_of_stations_are_lengths() {
    let stations: Vec<f64> = (0..21).map(|k| (1e4 * 6.0 * f64::from(k) / 0.3048).round() / 1e4).collect();
    let heads = ["0", "4.9213", "9.8425", "14.7638", "19.685", "24.6063", "29.5276"];
    let read = read(&table("", "Station", &stations, &heads, 1.0 / 0.3048), "[table]\nunits = \"ft\"\n").unwrap();
    let [length, height] = extents(&read.table);
    assert!((length - 120.0).abs() < 1e-3 && (height - 9.0).abs() < 1e-3, "{length} {height}");
}

#[test]
fn titles_say_full_breadths_dimensions_and_units() {
    let stations: Vec<f64> = (0..21).map(|k| 6.0 * f64::from(k)).collect();
    let heads = ["0", "1.5", "3", "4.5", "6", "7.5", "9"];
    let widest = |title: &str, corner: &str, scale: f64| {
        let read = read(&table(title, corner, &stations, &heads, scale), "").unwrap();
        read.table.stations.iter().flat_map(|s| &s.half_breadths).filter_map(|c| c.value()).fold(0.0, f64::max)
    };
    let half = widest("", "x [m]", 1.0);
    for (title, corner) in [
        ("Moulded breadths\n", "x [m]"),
        ("Breadth offsets\n", "x [m]"),
        ("Beam at waterlines, m\n", "x [m]"),
        ("Ordinates 2y\n", "x [m]"),
        ("", "x [m] \\ 2y [m]"),
        ("", "B [m]"),
    ] {
        assert!((widest(title, corner, 2.0) - half).abs() < 1e-3, "{title}{corner}");
    }
    let text = table("Lpp 120 m, B 18 m, T 7 m, D 11 m\n", "x [m]", &stations, &heads, 1.0);
    let stated = read(&text, "").unwrap().table.stated;
    let dimensions = [stated.length_between_perpendiculars, stated.breadth, stated.draught, stated.depth];
    assert_eq!(dimensions, [Some(120.0), Some(18.0), Some(7.0), Some(11.0)]);
    let text = table("Half-breadths in mm, heights in m\n", "x from AP (m)", &stations, &heads, 1000.0);
    let read = read(&text, "").unwrap();
    assert!(near(extents(&read.table), [120.0, 9.0]));
    let widest =
        read.table.stations.iter().flat_map(|s| &s.half_breadths).filter_map(|c| c.value()).fold(0.0, f64::max);
    assert!((widest - half).abs() < 1e-3);
}

/// `LWL` among numbers stands at the draught, or at its number.
#[test]
fn the_load_waterline_has_its_place_among_numbers() {
    let heads = ["BL", "1 WL", "2 WL", "3 WL", "LWL", "5 WL", "6 WL"];
    for title in ["T = 6.0 m; waterlines 1.5 m apart\n", "waterlines 1.5 m apart\n"] {
        let text = table(title, "Station", &count(21), &heads, 1.0);
        let read = read(&text, "[table]\nLpp = 120\n").unwrap();
        assert!((read.table.waterlines[4] - 6.0).abs() < 1e-9, "{title}{:?}", read.table.waterlines);
    }
}
