//! Tables of lines and of points as builders of boats write them: waterlines and buttocks with numbers, units in headings,
//! chines at common heights, skegs. Each hull is a prism, whose volume is that of its section.

use std::fmt::Write as _;

use loftsman::internals::exchange::{TableWriting, write_table};
use loftsman::internals::hull::OffsetTable;
use loftsman::internals::hydrostatics::Conventions;
use loftsman::internals::report::read_hydrostatic_body;

use crate::support::{among, folder};

const FOOT: f64 = 0.3048;

/// The volume at a draught \[m3\] with the remarks, or the refusal.
fn answer(name: &str, text: &str, beside: &str, draught: f64) -> Result<(f64, Vec<String>), String> {
    let folder = folder(&format!("boats-{name}-{}", text.len() + 10_000 * beside.len()));
    let path = folder.write(name, text);
    if !beside.is_empty() {
        folder.write(&format!("{}.toml", name.rsplit_once('.').unwrap().0), format!("[table]\n{beside}\n"));
    }
    let body = read_hydrostatic_body(path.as_ref()).map_err(|error| error.to_string())?;
    let (table, warned) =
        body.curves_of_form(&[draught], &Conventions::default()).map_err(|error| error.to_string())?;
    let remarks = body.warnings().chain(body.notes.iter().cloned()).chain(warned).collect();
    Ok((table.rows[0].displacement_volume, remarks))
}

/// The remarks of a hull whose volume is right.
#[track_caller]
fn right(name: &str, text: &str, beside: &str, [draught, volume]: [f64; 2]) -> Vec<String> {
    let (found, remarks) = answer(name, text, beside, draught).unwrap_or_else(|error| panic!("{error}\n{text}"));
    assert!((found / volume - 1.0).abs() < 0.01, "{found} for {volume}: {remarks:#?}\n{text}");
    remarks
}

#[track_caller]
fn refused(name: &str, text: &str, beside: &str, parts: &[&str]) {
    match answer(name, text, beside, 0.5) {
        Ok((found, remarks)) => panic!("{found}: {remarks:#?}\n{text}"),
        Err(error) => assert!(parts.iter().all(|part| error.contains(part)), "{parts:?}: {error}"),
    }
}

/// Lengths of feet as feet, inches and eighths.
fn eighths(feet: f64) -> String {
    let all = (96.0 * feet).round() as i64;
    format!("{}-{}-{}", all / 96, all % 96 / 8, all % 8)
}

/// A V of 20 x 6 x 2 ft over stations at 0, 5, 10 and 20 ft, as `write` writes feet; `heights` and `breadths` are more rows.
fn vee(write: impl Fn(f64) -> String, heights: &[(&str, f64)], breadths: &[(&str, f64)]) -> String {
    let row = |name: &str, values: [f64; 4]| format!("{name},{}\n", values.map(&write).join(","));
    let mut text = "Station,Transom,1,2,Stem\n".to_owned() + &row("Distance", [0.0, 5.0, 10.0, 20.0]);
    for (group, all, sheer) in [("Heights above base", heights, 2.0), ("Half-breadths", breadths, 3.0)] {
        writeln!(text, "{group},,,,").unwrap();
        text += &row("Sheer", [sheer; 4]);
        text += &row("Keel", [0.0; 4]);
        all.iter().for_each(|(name, value)| text += &row(name, [*value; 4]));
    }
    text
}

/// Draught and volume of it.
const VEE: [f64; 2] = [FOOT, 30.0 * FOOT * FOOT * FOOT];

#[test]
fn numbers_of_waterlines_are_what_the_lines_allow() {
    let inches = vee(eighths, &[], &[("WL 6", 0.75), ("WL 12", 1.5), ("WL 18", 2.25)]);
    among(&right("boat.csv", &inches, "", VEE), &["W320", "taken as inches; as feet 12 of 12 points are outside"]);
    let metres = |feet: f64| format!("{:.4}", FOOT * feet);
    let cut = |at: f64| 1.5 * at / 100.0 / FOOT;
    let centimetres = vee(metres, &[], &[("WL 15", cut(15.0)), ("WL 30", cut(30.0)), ("WL 45", cut(45.0))]);
    among(&right("boat.csv", &centimetres, "units = \"m\"", VEE), &["W320", "taken as centimetres; as metres"]);
    let counted = vee(eighths, &[], &[("WL 1", 0.75), ("WL 2", 1.5), ("WL 3", 2.25)]);
    refused("boat.csv", &counted, "", &["E310", "'WL 1' to 'WL 3' are numbers", "Give waterline_spacing"]);
    let quiet = right("boat.csv", &counted, "waterline_spacing = \"6 in\"", VEE);
    assert!(!quiet.iter().any(|remark| remark.contains("waterlines")), "{quiet:?}");
    for words in ["# Waterlines 6 in apart", "Waterline spacing: 6 in,,,,", "WL 6 in apart,,,,"] {
        let text = format!("{counted}{words}\n");
        among(&right("boat.csv", &text, "", VEE), &["W320", "says that waterlines are 0.1524 m apart"]);
    }
    let heading = counted
        .replace("Keel,0-0-0,0-0-0,0-0-0,0-0-0\nWL 1", "Keel,0-0-0,0-0-0,0-0-0,0-0-0\nWaterlines (in),,,,\nWL 1");
    let heading = heading.replace("WL 1,", "WL 6,").replace("WL 2,", "WL 12,").replace("WL 3,", "WL 18,");
    let quiet = right("boat.csv", &heading, "", VEE);
    assert!(!quiet.iter().any(|remark| remark.contains("waterlines '")), "{quiet:?}");
    // Feet that may be numbers, and decimals that may not.
    let feet = vee(eighths, &[], &[("WL 1", 1.5), ("WL 2", 3.0)]);
    among(&right("boat.csv", &feet, "", VEE), &["W320", "their spacing is not known: taken as 1 ft apart"]);
    let quiet =
        right("boat.csv", &vee(metres, &[], &[("WL 0.25", cut(25.0)), ("WL 0.50", cut(50.0))]), "units = \"m\"", VEE);
    assert!(!quiet.iter().any(|remark| remark.contains("waterlines '")), "{quiet:?}");
}

#[test]
fn buttocks_agree_with_the_waterlines_and_the_lines() {
    let waterlines = [("WL 0-6-0", 0.75), ("WL 1-0-0", 1.5), ("1-6-0 WL", 2.25)];
    let counted = vee(eighths, &[("Butt 1", 4.0 / 12.0), ("Butt 2", 8.0 / 12.0)], &waterlines);
    refused("boat.csv", &counted, "", &["E310", "buttocks 'Butt 1' to 'Butt 2' are numbers", "Give buttock_spacing"]);
    right("boat.csv", &counted, "buttock_spacing = \"6 in\"", VEE);
    among(
        &right("boat.csv", &format!("{counted}# Buttocks 6 in apart\n"), "", VEE),
        &["W320", "says that buttocks are 0.1524 m apart"],
    );
    let stated = vee(eighths, &[("6 in buttock", 4.0 / 12.0), ("Butt 1-0-0", 8.0 / 12.0)], &waterlines);
    let quiet = right("boat.csv", &stated, "", VEE);
    assert!(!quiet.iter().any(|remark| remark.starts_with("W336")), "{quiet:?}");
    let wrong = vee(eighths, &[("Butt 1-0-0", 4.0 / 12.0)], &waterlines);
    let (_, remarks) = answer("boat.csv", &wrong, "", FOOT).unwrap();
    among(&remarks, &["W336", "the buttock 'Butt 1-0-0' is outside the section of the other lines at 4 of 4 stations"]);
    // Without waterlines nothing judges them.
    let alone = vee(eighths, &[("Butt 1", 4.0 / 12.0), ("Butt 2", 8.0 / 12.0)], &[]);
    let (_, remarks) = answer("boat.csv", &alone, "", FOOT).unwrap();
    among(&remarks, &["W320", "buttocks 'Butt 1' to 'Butt 2' are numbers, and their spacing is not known"]);
}

#[test]
fn headings_and_titles_state_units() {
    let cuts = [("WL 0.5", 0.75), ("WL 1.0", 1.5)];
    let decimal = |scale: f64| move |feet: f64| format!("{:.3}", scale * feet);
    let feet = vee(decimal(1.0), &[], &cuts);
    let headed = |text: &str, unit: &str| {
        let text = text.replace("Distance", &format!("Distance ({unit})"));
        text.replace("base", &format!("base [{unit}]")).replace("breadths", &format!("breadths in {unit}"))
    };
    let mut all =
        vec![headed(&feet, "ft"), format!("All dimensions in feet\n{feet}"), format!("{feet}# All in feet\n")];
    for (scale, unit) in [(12.0, "inches"), (30.48, "cm"), (304.8, "mm")] {
        let text = vee(decimal(scale), &[], &[]);
        all.extend([headed(&text, unit), format!("Offsets in {unit},,,,\n{text}")]);
    }
    for text in all {
        let remarks = right("boat.csv", &text, "", VEE);
        assert!(!remarks.iter().any(|remark| remark.contains("no unit is declared")), "{remarks:?}\n{text}");
    }
    let torn =
        headed(&feet, "ft").replace("Half-breadths in ft,,,,", "Half-breadths in ft,,,,\nHalf-breadths in mm,,,,");
    refused("boat.csv", &torn, "", &["E305", "state different units"]);
}

#[test]
fn rows_of_boats_belong_to_what_their_words_say() {
    let plain = vee(eighths, &[], &[("WL 0-6-0", 0.75), ("WL 1-0-0", 1.5)]);
    let diagonal = plain.replace("WL 0-6-0", "Diag A,0-9-0,0-9-0,0-9-0,0-9-0\nWL 0-6-0");
    let remarks = right("boat.csv", &diagonal, "", VEE);
    among(&remarks, &["W332", "the diagonal 'Diag A'"]);
    assert!(!remarks.iter().any(|remark| remark.contains("the diagonal 'WL")), "{remarks:?}");
    // Waterlines below the heights, and lines that begin with their number.
    let rows: String =
        plain.lines().filter(|line| line.starts_with("WL")).fold(String::new(), |all, row| all + row + "\n");
    let moved = plain.replace(&rows, "").replace("Half-breadths", &format!("{rows}Half-breadths"));
    right("boat.csv", &moved, "", VEE);
    right("boat.csv", &plain.replace("WL 0-6-0", "0-6-0 WL").replace("WL 1-0-0", "1-0-0 waterline"), "", VEE);
    among(&right("boat.csv", &plain.replace("Half-breadths", "Beams"), "", VEE), &["W320", "half or full"]);
    let letters = "Station,0,1,2\nDistance from transom,0-0-0,6-0-0,20-0-0\nSheer (H),2-0-0,2-0-0,2-0-0\nKeel (H),0-0-0,0-0-0,0-0-0\n\
                   Sheer (B),3-0-0,3-0-0,3-0-0\nKeel (B),0-0-0,0-0-0,0-0-0\n";
    right("boat.csv", letters, "breadths = \"half\"", VEE);
    right("boat.csv", &letters.replace("(H)", "ht.").replace("(B)", "HB"), "", VEE);
    refused("boat.csv", &plain.replace("Heights above base", "Depth below LWL"), "", &["E311", "count downward"]);
    let inches = |feet: f64| format!("{}-{}", (12.0 * feet).round() as i64 / 12, (12.0 * feet).round() as i64 % 12);
    among(&right("boat.csv", &vee(inches, &[], &[]), "", VEE), &["W320", "read as feet and inches"]);
}

/// Keel, chine and sheer at heights of 0, 1 and 3 m, 10 m long: 65 m3 at 2 m.
fn chine(row: impl Fn(f64, f64, f64, &str) -> String) -> String {
    let points = [(0.0, 0.0, "keel"), (2.0, 1.0, "chine"), (3.0, 3.0, "sheer")];
    let all = [0.0, 5.0, 10.0].into_iter().flat_map(|x| points.map(|(y, z, name)| (x, y, z, name)));
    all.fold(String::new(), |text, (x, y, z, name)| text + &row(x, y, z, name) + "\n")
}

#[test]
fn points_of_keel_chine_and_sheer_are_sections_in_every_writing() {
    let comma = |x: f64, y: f64, z: f64, _: &str| format!("{x},{y},{z}");
    let plain = format!("x,y,z\n{}", chine(comma));
    let writings = [
        ("commas.csv", plain.clone()),
        ("blanks.txt", plain.replace(',', " ")),
        ("tabs.txt", plain.replace(',', "\t")),
        ("named.csv", format!("x,y,z,line\n{}", chine(|x, y, z, name| format!("{x},{y},{z},{name}")))),
        ("station.csv", format!("station,y,z\n{}", chine(comma))),
        ("other.csv", format!("Height,Frame location,Half breadth\n{}", chine(|x, y, z, _| format!("{z},{x},{y}")))),
        ("title.csv", format!("Skiff\n{plain}")),
        ("titles.csv", format!("Skiff,,\n\nAll dimensions in m,,\n{plain}")),
        ("tail.csv", format!("{plain},,\n,,\n")),
        ("both.txt", format!("Skiff\n{}", plain.replace(',', " "))),
    ];
    for (name, text) in writings {
        let beside = if name == "station.csv" { "units = \"m\"\nstations = \"from AP\"" } else { "units = \"m\"" };
        among(&right(name, &text, beside, [2.0, 65.0]), &["W338", "3 sections of 4 points or fewer"]);
    }
    // Waterline after waterline, or under their name, three heights are waterlines.
    let heights = format!("station,waterline,half breadth\n{}", chine(|x, y, z, _| format!("{x},{z},{y}")));
    let read = crate::support::read("heights.csv", &heights);
    assert_eq!(read.table.waterlines.len(), 3);
}

#[test]
fn columns_of_points_have_many_names() {
    for head in [
        "Frame location,Height above base,Half beam",
        "Abscissa (m),Elevation (m),Offset (m)",
        "LongPos,Height,Offset",
        "pos_x,pos_z,pos_y",
        "x coordinate,z coordinate,y coordinate",
    ] {
        let text = format!("{head}\n{}", chine(|x, y, z, _| format!("{x},{z},{y}")));
        right("points.csv", &text, "units = \"m\"", [2.0, 65.0]);
    }
    let full = format!("x,z,full breadth\n{}", chine(|x, y, z, _| format!("{x},{z},{}", 2.0 * y)));
    among(&right("points.csv", &full, "units = \"m\"", [2.0, 65.0]), &["W320", "full breadths, by 'full breadth'"]);
    let parts = format!("x/L,z/D,y/B\n{}", chine(|x, y, z, _| format!("{},{},{}", x / 10.0, z / 3.0, y / 6.0)));
    right("points.csv", &parts, "Lpp = 10\nB = 6\nD = 3", [2.0, 65.0]);
    refused("points.csv", &parts, "Lpp = 10\nB = 6\nT = 3", &["E327", "fractions of the depth", "Give D"]);
    let down = format!("x [m],y [m],z below LWL [m]\n{}", chine(|x, y, z, _| format!("{x},{y},{}", 3.0 - z)));
    refused("points.csv", &down, "", &["E311", "count downward"]);
    let other = format!("alpha,beta,gamma\n{}", chine(|x, y, z, _| format!("{x},{y},{z}")));
    refused("points.csv", &other, "", &["E310", "'alpha'", "x or station, z or height, y or half-breadth"]);
}

#[test]
fn knuckles_of_a_skeg_under_a_level_bottom_enclose_what_is_drawn() {
    let section = |marks: [&str; 3]| {
        let rows = (0..11).map(|k| {
            let [a, b, c] = marks;
            format!("{k},{k},SEC,0,0,\n{k},{k},SEC,0,0.05,{a}\n{k},{k},SEC,0.5,0.05,{b}\n{k},{k},SEC,0.5,2,{c}\n{k},{k},SEC,2,2,\n")
        });
        format!("station,x,curve,z,y,flag\n{}", rows.collect::<String>())
    };
    for marks in [["K"; 3], [""; 3], ["", "K", "K"]] {
        right("skeg.csv", &section(marks), "units = \"m\"", [2.0, 60.5]);
    }
    // Heights and breadths that vary, and a bottom that rises.
    let mut text = "station,x,curve,z,y,flag\n".to_owned();
    for k in 0..9 {
        let (x, rise) = (f64::from(k), 0.02 * f64::from(k));
        for (z, y, mark) in
            [(0.2 + rise, 0.0, ""), (0.2 + rise, 0.04, "K"), (1.0, 0.04, "K"), (1.0, 1.5, "K"), (2.3, 1.8, "")]
        {
            writeln!(text, "{k},{x},SEC,{z},{y},{mark}").unwrap();
        }
    }
    // Trapezoids above the bottom, and the keel below it, 0.08 m broad.
    let volume = 8.0 * 2.0 * 0.5 * (1.5 + 1.5 + 0.3 / 1.3 * 0.5) * 0.5 + 8.0 * 0.08 * (1.0 - 0.2 - 0.08);
    right("skeg.csv", &text, "units = \"m\"", [1.5, volume]);
}

/// Full breadths of points are written with the word that says so, and come back as they are.
#[test]
fn full_breadths_of_points_come_back() {
    let mut text = "x,z,full breadth\n".to_owned();
    for station in 0..=10 {
        for level in 0..=6 {
            let (s, t) = (f64::from(station) / 5.0 - 1.0, f64::from(level) / 6.0);
            text += &format!("{},{},{:.4}\n", 10 * station, level, 10.0 * (1.0 - s * s) * t.sqrt());
        }
    }
    let read = |text: &str| crate::support::read("points.csv", text).table;
    let table = read(&text);
    let again = read(&write_table(&table, TableWriting::default()).text);
    let widest = |table: &OffsetTable| {
        let cells = table.stations.iter().flat_map(|station| &station.half_breadths).filter_map(|cell| cell.value());
        let points = table.stations.iter().flat_map(|station| station.outlines.iter().flatten()).map(|point| point.y);
        cells.chain(points).fold(0.0, f64::max)
    };
    assert!((widest(&table) - 5.0).abs() < 1e-3 && (widest(&again) - 5.0).abs() < 1e-3, "{}", widest(&again));
}
