//! Keys, titles and units beside a table are followed whatever its layout, or a warning names what is not.

use super::table_evidence::{columns, distances, matrix, metres, read, same};
use loftsman::internals::hull::{FitMethod, Hull};
use std::fmt::Write as _;

const SPACED: [(&str, f64); 6] = [("0", 0.0), ("1", 1.5), ("2", 3.0), ("3", 4.5), ("4", 6.0), ("5", 7.5)];

/// Rows of heights and half-breadths of a chine boat of nine stations; `head` is the first row.
fn boat(head: &str) -> String {
    let s = |k: u32| f64::from(k) / 4.0 - 1.0;
    let mut text = head.to_owned();
    let rows: [(&str, &dyn Fn(f64) -> f64); 6] = [
        ("Sheer height", &|s| 2.5 + 0.5 * s * s),
        ("Chine height", &|s| 0.6 + 0.4 * s * s),
        ("Keel height", &|s| 0.3 * s * s),
        ("Sheer half-breadth", &|s| 5.0 * (1.0 - 0.5 * s * s)),
        ("Chine half-breadth", &|s| 4.0 * (1.0 - 0.6 * s * s)),
        ("Keel half-breadth", &|_| 0.08),
    ];
    for (name, of) in rows {
        let cells: Vec<String> = (0..9).map(|k| format!("{:.3}", of(s(k)))).collect();
        write!(text, "\n{name},{}", cells.join(",")).unwrap();
    }
    text + "\n"
}

fn length(text: &str, conventions: &str) -> f64 {
    let table = read(text, conventions).unwrap_or_else(|list| panic!("{}\n{text}", list[0])).table;
    let x = |k: usize| table.stations[k].station.x;
    assert_eq!(table.stations.len(), 9, "{text}");
    (x(8) - x(0)).abs()
}

#[test]
fn a_spacing_that_is_stated_is_followed_whatever_the_heads() {
    let full = columns(|z| z.to_string());
    let heads: Vec<(String, f64)> = SPACED.iter().map(|(name, z)| ((*name).to_owned(), *z)).collect();
    let height = |text: &str, conventions: &str| {
        let read = read(text, conventions).unwrap_or_else(|list| panic!("{}\n{text}", list[0]));
        let told = read.notes.iter().any(|note| note.message.contains("may be numbers"));
        (*read.table.waterlines.last().unwrap(), told)
    };
    for corner in ["x [m]", "Station (m)", ""] {
        let text = matrix(corner, &distances(), &heads, metres);
        let found = height(&text, "[table]\nwaterline_spacing = 1.5\n");
        assert!((found.0 - 7.5).abs() < 1e-9, "{corner}: {found:?}");
        let found = height(&format!("Waterlines spaced 1.5 m\n{text}"), "");
        assert!((found.0 - 7.5).abs() < 1e-9, "{corner}: {found:?}");
    }
    // Heights that lie so far apart stay heights, and of others that have a unit a key that is not followed is named.
    same(&format!("Waterlines 0.75 m apart\n{}", matrix("x [m]", &distances(), &full, metres)), "");
    let text = matrix("x\\z [m]", &distances(), &heads, metres);
    let notes = read(&text, "[table]\nwaterline_spacing = 1.5\n").unwrap().notes;
    assert!(notes.iter().any(|note| note.code == "W332" && note.message.contains("waterline_spacing")), "{notes:?}");
    // Bare numbers beside numbered stations, and beside the base line, are warned of.
    let numbers: Vec<String> = (0..21).map(|k| k.to_string()).collect();
    assert!(height(&matrix("Station", &numbers, &heads, metres), "[table]\nLpp = 100.0\n").1);
    let base: Vec<(String, f64)> =
        heads.iter().map(|(name, z)| (if name == "0" { "BL".to_owned() } else { name.clone() }, *z)).collect();
    assert!(height(&matrix("x [m]", &distances(), &base, metres), "").1);
    // Stations without a word.
    let heights = columns(|z| format!("{z} m"));
    let text = matrix("", &numbers, &heights, metres);
    same(&text, "[table]\nstation_spacing = 5.0\nunits = \"m\"\n");
    same(&text, "[table]\nLpp = 100.0\nunits = \"m\"\n");
    let both: Vec<String> = (-10..=10).map(|k| k.to_string()).collect();
    let table = read(&matrix("Station", &both, &heights, metres), "[table]\nLpp = 100.0\n").unwrap().table;
    assert!((table.stations[20].station.x - table.stations[0].station.x - 100.0).abs() < 1e-9);
}

#[test]
fn titles_with_commas_are_titles() {
    for title in [
        "Station spacing 5 m, numbered from AP",
        "Lines of the ship, drawn 1934, 1:50, offsets in metres",
        "Rev 3, 2019-05-01",
    ] {
        same(&format!("{title}\n{}", matrix("x [m] \\ z [m]", &distances(), &columns(|z| z.to_string()), metres)), "");
    }
    let head = "Station,0,1,2,3,4,5,6,7,8";
    for title in ["All dimensions in feet, stations 3 ft apart, station 0 at FP", "Sloop,30 ft,stations 3 ft apart"] {
        assert!((length(&format!("{title}\n{}", boat(head)), "") - 24.0 * 0.3048).abs() < 1e-9, "{title}");
    }
    // A line or an empty row below the header.
    let text = matrix("x [m] \\ z [m]", &distances(), &columns(|z| z.to_string()), metres);
    let (header, rows) = text.split_once('\n').unwrap();
    same(&format!("{header}\n,,,,,,,\n{rows}"), "");
    same(&format!("{header}\n---,---,---,---,---,---,---,---\n{rows}"), "");
}

#[test]
fn units_of_stations_make_distances_of_them() {
    let feet = 0.3048 * 24.0;
    let head = |label: &str, step: u32| {
        format!("{label},{}", (0..9).map(|k| (step * k).to_string()).collect::<Vec<_>>().join(","))
    };
    for (label, step, title, conventions) in [
        ("Station (ft)", 3, "", ""),
        ("Distance from stem (ft)", 3, "", ""),
        ("Station", 3, "", "[table]\nx_units = \"ft\"\nunits = \"ft\"\n"),
        ("Station", 36, "All dimensions in inches\n", ""),
    ] {
        let text = format!("{title}{}", boat(&head(label, step)));
        assert!((length(&text, conventions) - feet).abs() < 1e-6, "{label} {title}");
    }
    // Numbers stay numbers where their spacing is stated.
    let spaced = length(&boat(&head("Station", 1)), "[table]\nunits = \"ft\"\nstation_spacing = 2.0\n");
    assert!((spaced - 16.0).abs() < 1e-9, "{spaced}");
}

#[test]
fn titles_state_dimensions_and_breadths() {
    let twice = |y: f64| format!("{:.3}", 2.0 * y);
    let text =
        |corner: &str, cell: &dyn Fn(f64) -> String| matrix(corner, &distances(), &columns(|z| z.to_string()), cell);
    for title in ["Lpp 100 m, B 16 m, T 6 m, D 7.5 m", "LBP 100.0 m x B 16.0 m x D 7.5 m", "Lpp 100 / B 16 / T 6"] {
        let stated = read(&format!("{title}\n{}", text("x [m]", &metres)), "").unwrap().table.stated;
        let found = (stated.length_between_perpendiculars, stated.breadth);
        assert_eq!(found, (Some(100.0), Some(16.0)), "{title}");
    }
    for title in ["2y in m", "Ordinates 2y", "Breadth offsets", "Moulded breadths", "Beam at waterlines in m"] {
        let found = same(&format!("{title}\n{}", text("x [m]", &twice)), "");
        assert!(found.iter().any(|w| w.starts_with("W320") && w.contains("readth")), "{title}: {found:?}");
    }
    for corner in ["x [m] \\ 2y [m]", "B [m]"] {
        same(&text(corner, &twice), "");
    }
    for words in
        ["Station interval 5 m", "Stations every 5 m", "Distance between stations 5 m", "Stations at 5 m intervals"]
    {
        let numbers: Vec<String> = (0..21).map(|k| k.to_string()).collect();
        let heights = columns(|z| format!("{z} m"));
        same(&format!("{words}\n{}", matrix("Station", &numbers, &heights, metres)), "");
    }
}

#[test]
fn tables_that_are_upside_down_or_have_a_lone_offset_are_warned_of() {
    let heads: Vec<(String, f64)> = columns(|z| z.to_string()).into_iter().map(|(name, z)| (name, 7.5 - z)).collect();
    let warns = |text: &str, code: &str, of: &str| {
        let notes = read(text, "").unwrap().notes;
        assert!(notes.iter().any(|note| note.code == code && note.message.contains(of)), "{text}: {notes:?}");
    };
    warns(&matrix("x [m] \\ z [m]", &distances(), &heads, metres), "W320", "count downward");
    // One wrong cell of the base line: a warning, and a surface.
    let dense: Vec<String> = (0..=200).map(|k| format!("{}", 0.5 * f64::from(k))).collect();
    let text = matrix("x [m] \\ z [m]", &dense, &columns(|z| z.to_string()), metres);
    let wrong = text.replacen("\n80,0.000,", "\n80,1.688,", 1);
    assert_ne!(text, wrong);
    warns(&wrong, "W335", "alone among zeros");
    let at = |text: &str| {
        let table = read(text, "").unwrap().table;
        let fitted = Hull::fit(&table, &FitMethod::Graded).unwrap_or_else(|error| panic!("{error}"));
        [(30.0, 0.4), (50.0, 3.0), (80.0, 1.0)].map(|(x, z)| fitted.hull.half_breadth(x, z).unwrap())
    };
    let (right, found) = (at(&text), at(&wrong));
    assert!(right.iter().zip(found).all(|(a, b)| (a - b).abs() < 1e-3), "{found:?} for {right:?}");
}
