//! Words and units beside a table: from where stations and heights count, numbers after abbreviations, columns that are no offsets,
//! titles and main dimensions. Each writing gives the plain table, or says what it is.

use std::fmt::Write as _;

use loftsman::internals::exchange::{TableWriting, write_table};

use crate::table_evidence::{HEIGHTS, columns, distances, half_breadth, matrix, metres, read, same};

/// What a table is warned of or refused for.
fn messages(text: &str, conventions: &str) -> String {
    let list = read(text, conventions).map_or_else(|list| list, |read| read.notes);
    list.iter().map(|problem| format!("{problem}\n")).collect()
}

/// The plain matrix below a corner, with stations by `head`, aft first.
fn stations(corner: &str, head: impl Fn(f64) -> String) -> String {
    let heads: Vec<String> = (0..21).map(|k| head(5.0 * f64::from(k))).collect();
    matrix(corner, &heads, &columns(|z| format!("{z} m")), metres)
}

/// The plain matrix with one more column, by its name and its values.
fn with_column(name: &str, value: impl Fn(f64) -> String) -> String {
    let text = stations("x [m]", |x| x.to_string());
    let rows = text.lines().enumerate().map(|(k, row)| match k {
        0 => format!("{row},{name}\n"),
        _ => format!("{row},{}\n", value(5.0 * (k as f64 - 1.0))),
    });
    rows.collect()
}

#[test]
fn labels_with_a_unit_count_from_where_the_words_say() {
    let length = "[table]\nLpp = 100\n";
    let from_fp = |x: f64| format!("{} m", 100.0 - x);
    same(&stations("Distance from FP [m]", from_fp), length);
    same(&stations("x [m]", from_fp), "[table]\nLpp = 100\nstations = \"from FP\"\n");
    same(&format!("Distances from FP\n{}", stations("x [m]", from_fp)), length);
    same(&format!("Stations from the FP\n{}", stations("", from_fp)), length);
    same(&stations("x from midship", |x| format!("{} m", x - 50.0)), length);
    same(&stations("x from midship", |x| format!("{} mm", 1000.0 * (x - 50.0))), length);
    // Without L_PP the ends are assumed, and named.
    let assumed = same(&stations("Distance from FP [m]", from_fp), "");
    assert!(
        assumed.iter().any(|w| w.contains("the aftermost station, 100 m aft of FP, is taken as AP")),
        "{assumed:?}"
    );
    same(&stations("x from FP [m]", |x| (100.0 - x).to_string()), "");
    same(&stations("x", |x| format!("{} m", x - 50.0)), "[table]\nstations = \"from midship\"\n");
}

#[test]
fn distances_aft_of_midship_and_negative_ones() {
    for corner in
        ["x aft of midship [m]", "Distance abaft amidships [m]", "x from amidships (+ aft)", "x aft from midship"]
    {
        let text = stations(corner, |x| (50.0 - x).to_string());
        same(&text, "[table]\nunits = \"m\"\nLpp = 100\n");
        same(&text, "[table]\nunits = \"m\"\n");
    }
    same(&format!("x aft of midship\n{}", stations("x [m]", |x| (50.0 - x).to_string())), "[table]\nLpp = 100\n");
    let forward = stations("x forward of midship [m]", |x| (x - 50.0).to_string());
    same(&forward, "[table]\nLpp = 100\n");
    same(&stations("x from FP [m]", |x| (x - 100.0).to_string()), "[table]\nLpp = 100\n");
    same(&stations("x from AP [m]", |x| (-x).to_string()), "[table]\nLpp = 100\n");
}

#[test]
fn numbers_after_an_abbreviation_are_no_decimals() {
    let numbered = |name: &str| -> Vec<(String, f64)> {
        (0..6).map(|k| (format!("{name}{k}"), 1.5 * f64::from(k))).filter(|(_, z)| *z < 8.0).collect()
    };
    let heights = |text: &str, conventions: &str| read(text, conventions).unwrap().table.waterlines;
    let wanted = vec![0.0, 1.5, 3.0, 4.5, 6.0, 7.5];
    let conventions = "[table]\nunits = \"m\"\nwaterline_spacing = 1.5\n";
    for name in ["WL.", "WL ", "W.L.", "No.", "WL. "] {
        let text = matrix("x [m]", &distances(), &numbered(name), metres);
        assert_eq!(heights(&text, conventions), wanted, "{name}");
    }
    let text = matrix("x [m]", &distances(), &numbered("WL."), metres);
    assert!(messages(&text, "").contains("their spacing is not known"), "{}", messages(&text, ""));
    let titled = format!("Waterline spacing 1.5 m\n{text}");
    assert_eq!(heights(&titled, ""), wanted);
    assert!(messages(&titled, "").contains("waterlines are 1.5 m apart"));
    // Decimals without a zero: they rise as decimals alone.
    let heads = ["WL.25", "WL.5", "WL.75", "WL1", "WL1.5"].map(|head| (head.to_owned(), head[2..].parse().unwrap()));
    assert_eq!(heights(&matrix("x [m]", &distances(), &heads, metres), ""), [0.25, 0.5, 0.75, 1.0, 1.5]);
    for name in ["St.", "Fr.", "Sta.", "Sec."] {
        let heads: Vec<String> = (0..21).map(|k| format!("{name}{k}")).collect();
        let text = matrix("", &heads, &columns(|z| format!("{z} m")), metres);
        same(&text, "[table]\nstations = \"numbers from AP\"\nLpp = 100\n");
    }
}

#[test]
fn areas_volumes_and_remarks_are_no_offsets() {
    for name in ["A [m2]", "Area [m\u{b2}]", "SA m2", "Section area", "Volume (m^3)", "A sq m", "Remarks"] {
        let text = with_column(name, |x| metres(2.0 * half_breadth(x, 7.5)));
        same(&text, "");
        assert!(messages(&text, "").contains("W332"), "{name}");
    }
    let areas: Vec<String> = HEIGHTS.iter().map(|z| metres(60.0 * half_breadth(50.0, *z))).collect();
    same(&format!("{}Awl [m2],{}\n", stations("x [m]", |x| x.to_string()), areas.join(",")), "");
    let text = with_column("A", |_| "2".to_owned());
    let (head, rest) = text.split_once('\n').unwrap();
    same(&format!("{head}\n{}[m2]\n{rest}", "[m],".repeat(1 + HEIGHTS.len())), "");
    // Heights at buttocks may stand beside half-breadths, below a heading of theirs.
    let beside = with_column("Buttock 2 m", |_| "1.5".to_owned());
    let headed = beside.replace("Buttock 2 m", "2 m");
    let groups = format!(",Half-breadths{}Heights at buttocks\n", ",".repeat(HEIGHTS.len()));
    for text in [beside.clone(), format!("{groups}{beside}"), format!("{groups}{headed}")] {
        same(&text, "");
        let table = read(&text, "").unwrap().table;
        let heights = table.stations[3].heights.iter().map(|cell| cell.value()).collect::<Vec<_>>();
        assert_eq!((table.buttocks, heights), (vec![2.0], vec![Some(1.5)]), "{text}");
    }
}

#[test]
fn a_deck_is_what_its_numbers_are() {
    let decks = |text: &str| {
        let table = read(text, "").unwrap().table;
        (table.stations[10].deck_height, table.stations[10].deck_half_breadth)
    };
    let breadths = with_column("Deck", |x| metres(half_breadth(x, 7.5)));
    assert_eq!(decks(&breadths), (None, Some(8.0)));
    let found = messages(&breadths, "");
    assert!(
        found.contains("taken as half-breadths of the deck") && found.contains("no heights: they are not used"),
        "{found}"
    );
    let heights = with_column("Deck [m]", |x| metres(7.5 + 1e-4 * (x - 50.0).powi(2)));
    assert_eq!(decks(&heights).0, Some(7.5));
    assert!(messages(&heights, "").contains("taken as heights of the deck"));
    let open = messages(&with_column("Deck", |x| metres(2.0 + 0.6 * half_breadth(x, 7.5) / 2.0)), "");
    assert!(open.contains("E310") && open.contains("'z deck'") && open.contains("'y deck'"), "{open}");
    for name in ["Deck side height", "Height of sheer", "Sheer ht", "Height at deck"] {
        assert_eq!(decks(&with_column(name, |_| "7.5".to_owned())), (Some(7.5), None), "{name}");
    }
    for name in ["Sheer half-breadth", "Half-breadth at sheer", "Deck HB"] {
        assert_eq!(decks(&with_column(name, |x| metres(half_breadth(x, 7.5)))), (None, Some(8.0)), "{name}");
    }
    for name in ["Keel ht", "Rabbet ht", "Height of rabbet"] {
        let table = read(&with_column(name, |_| "-0.1".to_owned()), "").unwrap().table;
        assert_eq!(table.stations[3].keel_height, Some(-0.1), "{name}");
    }
    let above = messages(&with_column("z deck", |_| "9".to_owned()), "");
    assert!(
        above.contains("up to 1.500 m above the highest waterline") && above.contains("% of the volume"),
        "{above}"
    );
}

#[test]
fn sides_have_their_own_unit() {
    let rows = stations("x [m]", |x| x.to_string());
    let stem = |head: &str, x: f64| {
        let cells: Vec<String> = HEIGHTS.iter().map(|_| x.to_string()).collect();
        format!("{rows}{head},{}\n", cells.join(","))
    };
    let table = read(&stem("stem [mm]", 100_500.0), "").unwrap().table;
    assert!((table.endings[0][1].unwrap() - 100.5).abs() < 1e-9);
    let found = messages(&stem("stem", 100_000.0), "");
    assert!(found.contains("E305") && found.contains("'stem' is at 100000 m"), "{found}");
    let found = messages(&stem("stem", 328.0), "");
    assert!(found.contains("W320") && found.contains("'stem' is at 328 m"), "{found}");
    let table = read(&with_column("Keel (mm)", |_| "-100".to_owned()), "").unwrap().table;
    assert!((table.stations[3].keel_height.unwrap() + 0.1).abs() < 1e-12);
}

#[test]
fn heights_above_the_load_waterline_need_the_draught() {
    let lines: Vec<(String, f64)> = HEIGHTS.iter().map(|z| (format!("{}", z - 6.0), *z)).collect();
    let text = |corner: &str| matrix(corner, &distances(), &lines, metres);
    for text in [
        format!("Heights above LWL in metres\n{}", text("x [m]")),
        text("x \\ z above DWL [m]"),
        format!("z = 0 at the design waterline\n{}", text("x [m]")),
    ] {
        let warned = same(&text, "[table]\nT = 6\n");
        assert!(warned.iter().any(|w| w.contains("heights count from the waterline")), "{warned:?}");
        let found = messages(&text, "");
        assert!(found.contains("E311") && found.contains("Give the draught T"), "{found}");
    }
    let found = messages(&text("x [m]"), "");
    assert!(found.contains("the lowest waterline is at z = -6.000 m"), "{found}");
    let positive = format!("Heights above LWL\n{}", stations("x [m]", |x| x.to_string()));
    assert!(same(&positive, "[table]\nT = 6\n").iter().any(|w| w.contains("is not followed")));
}

/// The points of the hull, a section after the other: x, y and z \[m\], heights above `level`.
fn hull_points(level: f64) -> Vec<[f64; 3]> {
    let at =
        |k: u32| HEIGHTS.iter().map(move |z| [5.0 * f64::from(k), half_breadth(5.0 * f64::from(k), *z), z - level]);
    (0..21).flat_map(at).collect()
}

#[test]
fn heights_of_points_and_of_lines_may_count_from_the_load_waterline() {
    let rows: String = hull_points(6.0).iter().map(|[x, y, z]| format!("{x},{y:.3},{z}\n")).collect();
    for text in [format!("x,y,z above LWL\n{rows}"), format!("# Heights above the LWL\nx,y,z\n{rows}")] {
        let found = messages(&text, "[table]\nT = 6\n");
        assert!(found.contains("heights count from the waterline"), "{found}");
        assert!(messages(&text, "").contains("E311"));
        let table = read(&text, "[table]\nT = 6\n").unwrap().table;
        let heights = table.stations[3].outlines.iter().flatten().map(|point| point.z);
        assert!(heights.zip(HEIGHTS).all(|(a, b)| (a - b).abs() < 1e-9));
    }
    let lines = "Station,0,1,2,3\nDistance,0,5,10,15\nHeights above LWL,,,,\nSheer,1.5,1.4,1.4,1.6\nChine,0,-0.2,-0.2,0.1\n\
                 Keel,-0.5,-0.6,-0.6,-0.4\nHalf-breadths,,,,\nSheer,1,2,2,1\nChine,0.8,1.5,1.5,0.6\nKeel,0,0,0,0\n";
    assert!(messages(lines, "").contains("E311"));
    let table = read(lines, "[table]\nT = 0.6\n").unwrap().table;
    let heights: Vec<f64> = table.stations[1].outlines[0].iter().map(|point| point.z).collect();
    assert!(heights.iter().zip([0.0, 0.4, 2.0]).all(|(a, b)| (a - b).abs() < 1e-12), "{heights:?}");
    let written = write_table(&table, TableWriting::default()).text;
    let again = read(&written, "").unwrap_or_else(|list| panic!("{}\n{written}", list[0])).table;
    assert_eq!(again.stations[1].outlines, table.stations[1].outlines, "{written}");
}

#[test]
fn sections_stand_side_by_side() {
    let all = hull_points(0.0);
    let sections: Vec<&[[f64; 3]]> = all.chunks(HEIGHTS.len()).collect();
    let rows: String = (0..HEIGHTS.len())
        .map(|j| {
            let cells: Vec<String> =
                sections.iter().map(|section| format!("{:.3},{}", section[j][1], section[j][2])).collect();
            cells.join(",") + "\n"
        })
        .collect();
    let heads = |head: &dyn Fn(usize) -> String| (0..21).map(head).collect::<Vec<_>>().join(",");
    let ordinates = heads(&|_| "y,z".to_owned());
    for (header, beside) in [
        (format!("{}\n{ordinates}", heads(&|k| format!("x = {} m,", 5 * k))), ""),
        (format!("{}\n{ordinates}", heads(&|k| format!("Station {k},"))), "[table]\nstation_spacing = 5\n"),
        (heads(&|k| format!("St {k} y,St {k} z")), "[table]\nstation_spacing = 5\n"),
    ] {
        same(&format!("{header}\n{rows}"), beside);
    }
}

#[test]
fn titles_stand_below_each_other() {
    let table = stations("x [m]", |x| x.to_string());
    same(&format!("M.V. ANNA\nTable of offsets\n{table}"), "");
    same(&format!("M.V. ANNA\nTable of offsets\nMoulded\n{table}"), "");
    let blanks: String = table.replace(" m", "m").replace("x [m]", "x").replace(',', "   ");
    let mut ruled = "OFFSETS OF ANNA (METRES)\n-------------------\n".to_owned();
    writeln!(ruled, "{blanks}-------------------").unwrap();
    same(&ruled, "");
}

#[test]
fn titles_state_main_dimensions_and_spacings() {
    let from_fp = |corner: &str| stations(corner, |x| ((100.0 - x) / 5.0).to_string());
    for title in [
        "Station 0 is the F.P.\nLpp: 100 m",
        "Station 0 = FP; station 20 = AP\nL.B.P. = 100 m",
        "Station spacing 5.0 m. Station 0 at FP",
        "Stations from FP\nLpp,100,m",
        "Stations numbered from the forward perpendicular\n\"L.B.P.\",100 m",
        "Station 0 at FP\nLength between perpendiculars: 328.084 ft",
    ] {
        same(&format!("{title}\n\n{}", from_fp("Station")), "[table]\nunits = \"m\"\n");
    }
    let table = read(&format!("Lpp: 100 m, B = 16 m\n{}", from_fp("Station")), "").unwrap().table;
    assert_eq!((table.stated.length_between_perpendiculars, table.stated.breadth), (Some(100.0), Some(16.0)));
    // A bare length may be the length overall.
    let table = read(&format!("Length: 105 m\n{}", stations("x [m]", |x| x.to_string())), "").unwrap().table;
    assert_eq!(table.stated.length_between_perpendiculars, None);
    same(&stations("Station (ft from AP)", |x| (x / 0.3048).to_string()), "[table]\nunits = \"m\"\n");
    let millimetres = |z: f64| format!("{}", 1000.0 * z);
    let whole = |y: f64| format!("{:.0}", 1000.0 * y);
    same(&matrix("Station (m from AP)", &distances(), &columns(millimetres), whole), "");
    // No ship has 100 000 frames.
    let heads: Vec<String> = (0..21).map(|k| (5000 * k).to_string()).collect();
    let text = matrix("St.", &heads, &columns(millimetres), whole);
    same(&text, "[table]\nunits = \"mm\"\n");
    let full = matrix("x [m]", &distances(), &columns(|z| format!("{z} m")), |y| metres(2.0 * y));
    same(&format!("Breadths (full) in metres\n{full}"), "");
    let ends = |x: f64| match (100.0 - x) / 5.0 {
        n if n < 0.5 => "0 (bow)".to_owned(),
        n if n > 19.5 => "20 (stern)".to_owned(),
        n => n.to_string(),
    };
    same(&stations("Station", ends), "[table]\nstation_spacing = 5\n");
    same(&matrix("x [m]", &distances(), &columns(|z| format!("{z}m above base")), metres), "");
}

/// The plain hull as rows of points below a header, with stations by `head`.
fn points(header: &str, head: impl Fn(f64) -> String, share: f64) -> String {
    let mut text = format!("{header}\n");
    for x in (0..21).map(|k| 5.0 * f64::from(k)) {
        for z in HEIGHTS {
            writeln!(text, "{},{z},{}", head(x), metres(share * half_breadth(x, z))).unwrap();
        }
    }
    text
}

#[test]
fn titles_state_the_origin_of_every_layout() {
    let length = "[table]\nunits = \"m\"\nLpp = 100\n";
    let from_fp = |x: f64| (100.0 - x).to_string();
    let from_midship = |x: f64| (x - 50.0).to_string();
    for title in [
        "Stations measured from the fore perpendicular in metres",
        "\"x from FP, positive aft\"",
        "Distances aft of F.P.",
        "Sections measured from bow",
        "M.V. Anna. Longitudinal positions are in metres from the fore perpendicular",
        "Origin of x: F.P.",
        "x = 0 at FP",
    ] {
        for table in [
            stations("x [m]", from_fp),
            stations("Station", |x| format!("{} m", 100.0 - x)),
            points("x [m],waterline [m],y [m]", from_fp, 1.0),
            points("station,z,y", from_fp, 1.0),
        ] {
            let warnings = same(&format!("{title}\n{table}"), length);
            assert!(warnings.iter().any(|w| w.starts_with("W320") && w.contains("from FP")), "{warnings:?}");
        }
    }
    // A comma without quotes parts a title above columns of points, and above one offset a row.
    same(&format!("x from FP, positive aft\n{}", points("x,z,y", from_fp, 1.0)), length);
    same(&format!("x from Lpp/2\n{}", stations("x [m]", from_midship)), length);
    let tidy = points("x,z,y", from_fp, 1.0).lines().skip(1).fold("x,curve,z,y\n".to_owned(), |text, row| {
        let (x, rest) = row.split_once(',').unwrap();
        text + &format!("{x},WL,{rest}\n")
    });
    same(&format!("Stations from FP\n{tidy}"), length);
    for title in ["Stations from AP to FP", "Table of offsets, distances forward of A.P.", "LCB position from midship"]
    {
        same(&format!("{title}\n{}", stations("x [m]", |x| x.to_string())), length);
    }
}

#[test]
fn distances_of_both_signs_count_from_where_their_hull_shows() {
    let units = "[table]\nunits = \"m\"\n";
    let ends = |stern: f64, stem: f64| {
        let row = |name: &str, x: f64| format!("{name},{}\n", vec![x.to_string(); 7].join(","));
        row("stern", stern) + &row("stem", stem)
    };
    for (head, ends, from) in [
        ((|x| x - 100.0) as fn(f64) -> f64, ends(-100.0, 0.0), "from FP, positive forward, by the profiles"),
        (|x| -x, ends(0.0, -100.0), "from AP, positive aft, by the profiles"),
        (|x| 50.0 - x, ends(50.0, -50.0), "from midship, positive aft, by the profiles"),
        (|x| x - 100.0, String::new(), "from FP, positive forward, and nothing tells which end is the bow"),
        (|x| x - 50.0, String::new(), "from midship, positive forward, and nothing tells which end is the bow"),
    ] {
        let table = stations("x [m]", |x| head(x).to_string());
        let warnings = same(&format!("{table}{ends}"), units);
        assert!(warnings.iter().any(|w| w.starts_with("W320") && w.contains(from)), "{from}: {warnings:?}");
    }
    let numbers = stations("Station", |x| (x / 5.0 - 20.0).to_string());
    let said = messages(&numbers, "[table]\nunits = \"m\"\nLpp = 100\n");
    assert!(said.contains("taken from FP") && said.contains("Give stations = \"from FP\""), "{said}");
    same(&numbers, "[table]\nunits = \"m\"\nLpp = 100\n");
    // A key, and a word, stand over what the numbers show.
    let negative = stations("x [m]", |x| (-x).to_string());
    let keyed = same(&negative, "[table]\nunits = \"m\"\nstations = \"from AP\"\n");
    assert!(!keyed.iter().any(|warning| warning.starts_with("W320")), "{keyed:?}");
}

#[test]
fn frames_are_as_far_apart_as_their_spacing() {
    let units = "[table]\nunits = \"m\"\n";
    let frame = |x: f64| (2.0 * x).to_string();
    let label = |x: f64| format!("Fr {}", 2.0 * x);
    for title in [
        "Frame spacing 500 mm",
        "Frame spacing = 0.5",
        "# Frame spacing = 0.5",
        "# frame_spacing = 0.5 m",
        "Frames 0.5 m apart; frame 0 at AP",
        "Frame spacing [mm],500",
    ] {
        for table in [stations("Frame", frame), stations("", label)] {
            let warnings = same(&format!("{title}\n{table}"), units);
            assert!(warnings.iter().any(|w| w.contains("says that stations are 0.5 m apart")), "{title}: {warnings:?}");
        }
    }
    same(&format!("Frame spacing: 0.5 m\n{}", points("frame,z [m],y [m]", frame, 1.0)), "");
    // Stations are no frames, and frames without a spacing are named.
    same(
        &format!("Frame spacing 0.5 m\n{}", stations("Station", |x| (x / 5.0).to_string())),
        "[table]\nunits = \"m\"\nLpp = 100\n",
    );
    assert!(messages(&stations("Frame", frame), units).contains("taken as 1 m apart. Give Lpp, or station_spacing"));
}

#[test]
fn breadths_without_a_word_are_what_the_ship_allows() {
    let table =
        |corner: &str, share: f64| matrix(corner, &distances(), &columns(|z| format!("{z} m")), |y| metres(share * y));
    let taken = |text: &str, conventions: &str, as_what: &str| {
        let warnings = same(text, conventions);
        assert!(warnings.iter().any(|w| w.starts_with("W320") && w.contains(as_what)), "{as_what}: {warnings:?}");
    };
    let said = |text: &str, conventions: &str| same(text, conventions).join("\n");
    let units = "[table]\nunits = \"m\"\n";
    taken(&table("\"B(x,z)\"", 2.0), units, "taken as full breadths, because L/B is 6.2, and 3.1 otherwise");
    taken(
        &format!("B = 16 m\nbreadths B\n{}", table("x [m]", 2.0)),
        "",
        "taken as full breadths, by the breadth of 16 m",
    );
    taken(
        &format!("breadths B\n{}", table("x [m]", 1.0)),
        &format!("{units}B = 16\n"),
        "taken as half-breadths, by the breadth",
    );
    taken(&table("\"2y(x,z)\"", 2.0), units, "full breadths, by '2y(x,z)'");
    assert!(!said(&table("\"y(x,z)\"", 1.0), units).contains("breadth"));
    taken(
        &format!("Full breadths\n{}", points("x [m],waterline [m],y [m]", |x| x.to_string(), 2.0)),
        "",
        "full breadths, by",
    );
    // The breadth of the ship is no word for its offsets.
    for title in ["Lpp 100 m; full breadth moulded 16 m", "Lpp 100 m, full breadth moulded 16 m", "Full beam 16 m"] {
        assert!(!said(&format!("{title}\n{}", table("x [m]", 1.0)), "").contains("full"), "{title}");
    }
}

#[test]
fn labels_with_a_hash_and_titles_of_buttocks() {
    let length = "[table]\nunits = \"m\"\nLpp = 100\n";
    same(&stations("station", |x| format!("#{}", x / 5.0)), length);
    // A row that is commented out stays so.
    let table = stations("x [m]", |x| x.to_string());
    same(&format!("{table}#105,9,9,9,9,9,9,9\n"), "");
    same(&format!("Buttocks 2 m apart\n{table}"), "");
    let heights = "\n\nx [m],Butt 1,Butt 2,Butt 3\n45,1,2,3\n50,1,2,3\n";
    let read = |text: &str| read(text, "").unwrap().table;
    assert_eq!(read(&format!("Buttocks 2 m apart\n{table}{heights}")).buttocks, [2.0, 4.0, 6.0]);
    assert_eq!(read(&format!("# buttock_spacing = 1.5\n{table}{heights}")).buttocks, [1.5, 3.0, 4.5]);
    assert!(messages(&format!("{table}{heights}"), "").contains("buttocks are numbered, 'Butt 1' to 'Butt 3'"));
}
