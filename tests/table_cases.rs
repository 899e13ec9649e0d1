//! Cases in which the program was wrong in silence: each is right now, or warned of, or refused with what to do. Their
//! sisters have other words, notations and layouts.

use std::fmt::Write as _;
use std::path::Path;

use loftsman::internals::hydrostatics::{Conventions, Hydrostatics};
use loftsman::internals::report::{Failure, HydrostaticBody, read_hydrostatic_body};

use crate::support::{carried, folder, json, program, read_text, stderr, stdout};

fn case(name: &str) -> std::path::PathBuf {
    carried("tests/table_cases").join(name)
}

/// The volume at a draught \[m3\] with the remarks, or the refusal.
fn answer(path: &Path, draught: f64) -> Result<(f64, Vec<String>), Failure> {
    let body = read_hydrostatic_body(path)?;
    let (table, warned) = body.curves_of_form(&[draught], &body.conventions)?;
    let remarks = body.warnings().chain(body.notes.iter().cloned()).chain(warned).collect();
    Ok((table.rows[0].displacement_volume, remarks))
}

/// Right to a share, or warned of with one of the codes, or refused with one of them.
#[track_caller]
fn right_or_told(path: &Path, draught: f64, volume: f64, codes: &[&str]) {
    match answer(path, draught) {
        Ok((found, remarks)) => {
            let told = remarks.iter().any(|remark| codes.iter().any(|code| remark.starts_with(code)));
            assert!(
                (found / volume - 1.0).abs() < 0.01 || told,
                "{}: {found} for {volume}, {remarks:?}",
                path.display()
            );
        }
        Err(refusal) => {
            let text = refusal.to_string();
            assert!(codes.iter().any(|code| text.contains(code)), "{}: {text}", path.display());
        }
    }
}

#[test]
fn each_case_is_right_or_told() {
    // Closed forms and integrals of the sections as they are drawn [m3].
    for (name, draught, volume, codes) in [
        ("from-wl-1.csv", 4.0, 3151.9, &["W315"][..]),
        ("wl-0-to-6.csv", 4.0, f64::NAN, &["W320"]),
        ("station-0-at-fp.csv", 6.0, f64::NAN, &["W320"]),
        ("rows-are-heights.csv", 1.5, 70.3, &[]),
        ("skiff-sections.csv", 0.4, 0.234, &["W340"]),
        ("no-knuckles.csv", 0.4, 0.234, &["W340"]),
        ("f_named.csv", 4.0, 3169.0, &[]),
        ("uprime.csv", 0.6096, 4.998, &[]),
        ("savetxt.txt", 4.0, f64::NAN, &["E300", "E302", "E310"]),
    ] {
        right_or_told(&case(name), draught, volume, codes);
    }
}

/// 104 stations at uneven distances and 20 waterlines of a smooth hull with a cut-away stern: a surface, or E314.
#[test]
fn dense_sections_have_a_surface() {
    let heights: Vec<f64> = (0..20).map(|j| 0.3 * f64::from(j)).collect();
    let half = |x: f64, z: f64| {
        let s = (x - 50.0) / 50.0;
        let full = 1.0 - (1.0 - (z + 0.2) / 6.2).powi(5);
        if s > 0.0 { 8.0 * (1.0 - s * s) * full } else { 8.0 * (1.0 - s.powi(4)) * full }
    };
    let xs: Vec<f64> =
        (0..=103).map(|k| 100.0 * (f64::from(k) / 103.0 + 0.04 * (0.37 * f64::from(k)).sin() / 6.0)).collect();
    let mut text = "x [m]\\z [m]".to_owned();
    heights.iter().for_each(|z| write!(text, ",{z:.1}").unwrap());
    for x in xs.iter().map(|x| x.clamp(0.0, 100.0)) {
        write!(text, "\n{x:.4}").unwrap();
        heights.iter().for_each(|z| write!(text, ",{:.3}", half(x, *z).max(0.0)).unwrap());
    }
    let folder = folder("dense");
    let path = folder.write("dense.csv", text + "\n");
    let (n, mut volume) = (400, 0.0);
    for i in 0..n {
        for j in 0..n {
            let (x, z) = (100.0 * (f64::from(i) + 0.5) / f64::from(n), 3.0 * (f64::from(j) + 0.5) / f64::from(n));
            volume += 2.0 * half(x, z) * 100.0 * 3.0 / f64::from(n * n);
        }
    }
    let (found, _) = answer(Path::new(&path), 3.0).unwrap_or_else(|error| panic!("{error}"));
    assert!((found / volume - 1.0).abs() < 5e-3, "{found} for {volume}");
}

/// No energy is negative, and no net leaves the hull, whatever the table holds.
#[test]
fn energies_are_positive_and_nets_stay_at_the_hull() {
    let folder = folder("nets");
    for (name, options) in [("dm.csv", &["--draught", "11 in"][..]), ("noise-10mm-a.csv", &[])] {
        let path = case(name).display().to_string();
        let to = folder.join(name.replace(".csv", "")).display().to_string();
        let done = program(&[&["fair", &path, "-o", &to, "--no-figures", "--quiet"], options].concat());
        // Files are written where the hull is no fairer as well.
        if !matches!(done.status.code(), Some(0 | 5)) {
            assert!(matches!(done.status.code(), Some(3 | 4)), "{name}: {}", stderr(&done));
            continue;
        }
        let record = read_text(Path::new(&to).join("fairing.json"));
        let energies = json(&record)["energy"].clone();
        let mut numbers = Vec::new();
        collect(&energies, &mut numbers);
        assert!(numbers.iter().all(|energy| *energy >= 0.0), "{name}: {energies}");
        let hull = json(read_text(Path::new(&to).join("hull.json")));
        let mut net = Vec::new();
        collect(&hull["surface"], &mut net);
        assert!(!net.is_empty() && net.iter().all(|number| *number > -8.0), "{name}");
    }
}

fn collect(value: &serde_json::Value, numbers: &mut Vec<f64>) {
    match value {
        serde_json::Value::Number(number) => numbers.extend(number.as_f64()),
        serde_json::Value::Array(list) => list.iter().for_each(|value| collect(value, numbers)),
        serde_json::Value::Object(members) => members.values().for_each(|value| collect(value, numbers)),
        _ => {}
    }
}

/// Heights of the waterlines of the ship of the sisters \[m\].
const WATERLINES: [f64; 10] = [0.0, 0.75, 1.5, 2.25, 3.0, 4.0, 5.0, 6.0, 7.5, 9.0];

/// A ship of 100 by 20 m, full aft.
fn half(x: f64, z: f64) -> f64 {
    let s = (x - 50.0) / 50.0;
    10.0 * (1.0 - if s > 0.0 { s * s } else { s.powi(4) }) * (1.0 - (1.0 - z / 12.0).powi(6))
}

fn matrix(head: &str, names: &dyn Fn(f64) -> String, stations: &[(String, f64)], rest: &str) -> String {
    let heads: Vec<String> = WATERLINES.iter().map(|z| names(*z)).collect();
    let mut text = format!("{head},{}\n", heads.join(","));
    for (name, x) in stations {
        let cells: Vec<String> = WATERLINES.iter().map(|z| format!("{:.3}", half(*x, *z))).collect();
        writeln!(text, "{name},{}", cells.join(",")).unwrap();
    }
    text + rest
}

fn distances() -> Vec<(String, f64)> {
    (0..=20).map(|k| (format!("{}", 5 * k), 5.0 * f64::from(k))).collect()
}

/// Sisters of the cases, in words and layouts that no other test has. The volume at 4.5 m is 4179 m3.
#[test]
fn sisters_are_right_or_told() {
    let metres = |z: f64| format!("{z} m");
    let numbered: Vec<(String, f64)> = (0..=20).map(|k| ((20 - k).to_string(), 5.0 * f64::from(k))).collect();
    let long = |head: &str, scale: f64| -> String {
        let mut text = format!("{head}\n");
        for (_, x) in distances() {
            for z in WATERLINES {
                writeln!(text, "{x},{z},{:.3}", scale * half(x, z)).unwrap();
            }
        }
        text
    };
    let aft = matrix("x [m]", &metres, &distances()[..11], "\n");
    let fore = matrix("x [m]", &metres, &distances()[10..], "");
    let turned = |separator: &str, rule: &str| {
        let mut text = format!("| x [m] | {} |\n{rule}", WATERLINES.map(|z| z.to_string()).join(separator));
        for (x, at) in distances() {
            let cells: Vec<String> = WATERLINES.iter().map(|z| format!("{:.3}", half(at, *z))).collect();
            writeln!(text, "| {x} | {} |", cells.join(separator)).unwrap();
        }
        text
    };
    let rule = format!("|{}\n", "---|".repeat(WATERLINES.len() + 1));
    let sisters: [(&str, String, &[&str]); 12] = [
        ("from-bow.csv", matrix("Ordinate", &metres, &numbered, ""), &["W320"]),
        ("joined.csv", format!("AFT BODY\n{aft}FORE BODY\n{fore}"), &[]),
        ("ordinate.csv", long("Frame position [m],Level [m],Ordinate [mm]", 1000.0), &[]),
        ("semi.csv", long("section position [m],WL [m],semi-breadth [cm]", 100.0), &[]),
        ("rules.txt", turned(" | ", &rule), &[]),
        ("amidships.csv", matrix("dist. from amidships (+ fwd) [m]", &metres, &amidships(), ""), &["W320"]),
        ("aft-of-fp.csv", matrix("Distance aft of FP (m)", &metres, &from_fp(), ""), &["W320"]),
        ("percent.csv", matrix("x [m]", &|z| format!("{} %", 100.0 * z / 6.0), &distances(), ""), &["E310"]),
        (
            "starred.csv",
            matrix("x [m]", &metres, &distances(), "* by eye\n").replace("6.822", "6.822*"),
            &["E301", "E310"],
        ),
        ("high.csv", high_waterlines(), &["W315"]),
        ("heights-in-mm.csv", matrix("x [m]", &|z| format!("{} mm", 1000.0 * z), &distances(), ""), &[]),
        ("transom.csv", named_ends(), &["E310", "W320"]),
    ];
    let folder = folder("sisters");
    for (name, text, codes) in &sisters {
        let path = folder.write(name, text);
        right_or_told(Path::new(&path), 4.5, 4179.4, codes);
    }
    let refused = |name: &str| answer(&folder.join(name), 4.5).unwrap_err().to_string();
    assert!(refused("transom.csv").contains("Write the position behind the name, as Transom (2.50 m)"));
}

fn amidships() -> Vec<(String, f64)> {
    distances().into_iter().map(|(_, x)| (format!("{}", x - 50.0), x)).collect()
}

fn from_fp() -> Vec<(String, f64)> {
    distances().into_iter().rev().map(|(_, x)| (format!("{}", 100.0 - x), x)).collect()
}

fn named_ends() -> String {
    let mut stations = distances();
    (stations[0], stations[20]) = (("Transom".to_owned(), 2.0), ("Stem".to_owned(), 100.0));
    matrix("Station", &|z| format!("{z} m"), &stations, "")
}

/// The lowest waterline is 1.5 m above the keel.
fn high_waterlines() -> String {
    let text = matrix("Frame (m from AP)", &|z| format!("{z} m WL"), &distances(), "");
    let without = |line: &str| {
        let cells: Vec<&str> = line.split(',').collect();
        [&cells[..1], &cells[3..]].concat().join(",")
    };
    text.lines().map(without).collect::<Vec<_>>().join("\n") + "\n"
}

/// Layouts that were wrong in silence: full beams in the headers, per cent of the length, distances forward of the transom.
#[test]
fn headers_that_change_what_numbers_are_are_heard() {
    let folder = folder("headers");
    let beams = matrix("x [m]", &|z| format!("Beam at {z} m"), &distances(), "");
    let path = folder.write("beams.csv", beams);
    let (_, remarks) = answer(Path::new(&path), 4.5).unwrap_or_else(|error| panic!("{error}"));
    assert!(remarks.iter().any(|remark| remark.contains("W320") && remark.contains("half or full")), "{remarks:?}");
    let shares = matrix("x in % of Lpp from AP", &|z| format!("{z} m"), &distances(), "");
    let path = folder.write("shares.csv", format!("# Lpp = 80 m\n{shares}"));
    let (found, remarks) = answer(Path::new(&path), 4.5).unwrap_or_else(|error| panic!("{error}"));
    assert!((found / (0.8 * 4179.4) - 1.0).abs() < 0.01, "{found}: {remarks:?}");
    let parts: Vec<(String, f64)> = distances().into_iter().map(|(_, x)| (format!("{}", x / 100.0), x)).collect();
    let path =
        folder.write("parts.csv", format!("# Lpp = 80 m\n{}", matrix("x/Lpp", &|z| format!("{z} m"), &parts, "")));
    let (found, remarks) = answer(Path::new(&path), 4.5).unwrap_or_else(|error| panic!("{error}"));
    assert!((found / (0.8 * 4179.4) - 1.0).abs() < 0.01, "{found}: {remarks:?}");
    let boat = |distance: &str| {
        let text = format!(
            "Station,St. 0,St. 1,St. 2\n{distance},0-0-0,6-0-0,12-0-0\nHeights,,,\nSheer,2-0-0,1-8-0,2-0-0\nKeel,0-4-0,0-1-0,0-4-0\n\
             Half-breadths,,,\nSheer,1-8-0,2-2-0,0-1-0\nKeel,0-0-6,0-0-6,0-0-6\n"
        );
        let table = crate::support::read("boat.csv", &text).table;
        let greatest = |station: usize| table.stations[station].outlines[0].last().map_or(0.0, |point| point.y);
        greatest(0) > greatest(2)
    };
    for (distance, is_aft_first) in [
        ("Distance from transom", true),
        ("Dist. fwd of transom", true),
        ("Distance forward of AP", true),
        ("Distance aft of stem", false),
        ("Distance from FP", false),
        ("Distance from AP positive forward", true),
        ("Distance from AP (+ fwd)", true),
    ] {
        assert_eq!(boat(distance), is_aft_first, "{distance}");
    }
}

/// Units in the cells say the digits as well: an error of 0.3 m is found among them.
#[test]
fn cells_with_units_have_digits() {
    let text = matrix("x [m]", &|z| format!("{z} m"), &distances(), "");
    let cell = format!("{:.3}", half(45.0, 3.0));
    let wrong = text.replacen(&format!(",{cell}"), ",6.533", 1);
    assert_ne!(text, wrong);
    let with_units: Vec<String> = wrong
        .lines()
        .enumerate()
        .map(|(row, line)| match line.split_once(',') {
            Some((x, cells)) if row > 0 => {
                format!("{x},{}", cells.split(',').map(|c| format!("{c} m")).collect::<Vec<_>>().join(","))
            }
            _ => line.to_owned(),
        })
        .collect();
    let table = crate::support::read("units.csv", &(with_units.join("\n") + "\n")).table;
    assert_eq!(table.form.decimals, Some(3));
    assert!(!loftsman::internals::fairing::suspects(&table).suspects.is_empty());
}

/// Waterlines that are counted in words, and lines of boats in other words.
#[test]
fn ordinals_and_other_words_of_boats_are_read() {
    let mut text = "Station,Base,1st WL,2nd WL,3rd WL,4th WL\n".to_owned();
    for k in 0..=20 {
        let cells: Vec<String> =
            (0..5).map(|j| format!("{:.3}", half(5.0 * f64::from(k), 0.75 * f64::from(j)))).collect();
        writeln!(text, "{k},{}", cells.join(",")).unwrap();
    }
    let folder = folder("ordinals");
    let path = folder.write("ordinals.csv", text);
    folder.write("ordinals.toml", "[table]\nLpp = 100\nwaterline_spacing = 0.75\nstations = \"numbers from AP\"\n");
    let (found, _) = answer(Path::new(&path), 3.0).unwrap_or_else(|error| panic!("{error}"));
    assert!((found / 2221.3 - 1.0).abs() < 0.01, "{found}");
    for (heights, breadths) in
        [("Elevations", "Semi-breadths"), ("Heights", "Halves"), ("Ht. above base", "Half breadths")]
    {
        let text = format!(
            "Station,St. 0,St. 1,St. 2\nDistance from transom,0-0-0,6-0-0,12-0-0\n{heights},,,\nSheer,2-0-0,1-8-0,2-0-0\n\
             Chine,0-9-0,0-6-0,0-9-0\nKeel,0-4-0,0-1-0,0-4-0\n{breadths},,,\nSheer,1-8-0,2-2-0,1-0-0\nChine,1-4-0,1-10-0,0-9-0\n\
             Keel,0-0-6,0-0-6,0-0-6\n"
        );
        let read = crate::support::read("boat.csv", &text);
        let section = &read.table.stations[1].outlines[0];
        assert!(section.len() == 3 && (section[1].y - 22.0 * 0.0254).abs() < 1e-9, "{heights}: {section:?}");
        assert!(!read.notes.iter().any(|note| note.message.contains("half or full")), "{heights}");
    }
}

#[test]
fn a_row_of_the_stern_that_holds_half_breadths_is_told() {
    let table =
        |row: &str| format!("x [m],0.5,1,1.5,2\n2,1,2,3,3.2\n6,2,3,4,4.2\n12,2,3,4,4.1\n20,0.1,0.2,0.3,0.4\n{row}\n");
    let notes = |row: &str| crate::support::notes(&table(row), "");
    let told = |notes: &[String]| notes.iter().any(|note| note.contains("as half-breadths of a station do"));
    assert!(told(&notes("stern,0.2,0.6,1.1,1.6")));
    assert!(!told(&notes("stern,1.6,1.1,0.6,0.2")) && !told(&notes("stern,0.5,0.5,0.5,0.5")));
    let bytes = table("stem,0.1,0.2,0.3,0.4");
    let problems = loftsman::internals::exchange::read_table("t.csv", bytes.as_bytes()).unwrap_err();
    let text = problems[0].to_string();
    assert!(
        text.contains("E303") && text.contains("write its position behind the name, as 'stem station (20 m)'"),
        "{text}"
    );
}

/// Hulls and tables that a command does not take are refused with the command that does.
#[test]
fn designs_and_tables_that_a_command_does_not_take() {
    for (arguments, words) in [
        (vec!["check", "catalogue:frigate"], ["E300", "the file is a design", "loftsman generate catalogue:frigate"]),
        (vec!["fit", "catalogue:frigate"], ["E300", "the file is a design", "loftsman hydro catalogue:frigate"]),
        (
            vec!["report", "catalogue:s175"],
            ["E182", "found a table or a body", "loftsman fit catalogue:s175 -o FOLDER"],
        ),
        (vec!["report", "catalogue:tug"], ["E182", "found a design", "loftsman generate catalogue:tug -o FOLDER"]),
    ] {
        let done = program(&arguments);
        assert_eq!(done.status.code(), Some(3), "{arguments:?}: {}", stderr(&done));
        assert!(words.iter().all(|word| stderr(&done).contains(word)), "{arguments:?}: {}", stderr(&done));
    }
    let design = carried("configs/box.toml").display().to_string();
    let done = program(&["check", &design]);
    assert!(done.status.code() == Some(3) && stderr(&done).contains("E300"), "{}", stderr(&done));
}

#[test]
fn a_value_that_an_option_does_not_take_has_a_remedy() {
    let remedy = |arguments: &[&str]| {
        let done = program(&[arguments, &["--json"]].concat());
        let error = json(stdout(&done))["error"][0].clone();
        assert_eq!(error["code"], "E703", "{error}");
        [error["message"].as_str().unwrap().to_owned(), error["remedy"].as_str().unwrap().to_owned()]
    };
    let [_, help] = remedy(&["hydro", "x", "--kg", "y"]);
    assert_eq!(help, "Correct the value of --kg <KG>, which the command describes with --help");
    let [message, help] = remedy(&["fit", "x", "--stations", "y"]);
    assert!(help.starts_with("Give one of from AP, from midship") && !message.contains("possible values"), "{message}");
}

/// Nodes and weights of Gauss over 0 to 1.
const NODES: [[f64; 2]; 4] = [
    [0.069_431_844_202_973_7, 0.173_927_422_568_726_9],
    [0.330_009_478_207_571_9, 0.326_072_577_431_273_1],
    [0.669_990_521_792_428_1, 0.326_072_577_431_273_1],
    [0.930_568_155_797_026_3, 0.173_927_422_568_726_9],
];

/// By panel of draughts the volume that it adds, and the integral of its waterplane \[m3\].
fn added(body: &HydrostaticBody, panels: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let mut draughts: Vec<f64> = Vec::new();
    for &[a, b] in panels {
        draughts.push(a);
        draughts.extend(NODES.map(|[t, _]| a + t * (b - a)));
        draughts.push(b);
    }
    let (table, _) = body.curves_of_form(&draughts, &Conventions::default()).unwrap();
    let of = |(rows, [a, b]): (&[Hydrostatics], &[f64; 2])| {
        let areas = NODES.iter().zip(&rows[1..5]);
        let integral: f64 = areas.map(|([_, weight], row)| weight * (b - a) * row.waterplane_area).sum();
        [rows[5].displacement_volume - rows[0].displacement_volume, integral]
    };
    table.rows.chunks(6).zip(panels).map(of).collect()
}

/// V(b) - V(a) is the integral of the waterplane. It has kinks, and above the lowest point of the deck edge it falls as a
/// root: panels are halved until they are exact. Volume without a waterplane, or a waterplane without volume, would stay.
#[test]
fn volumes_of_a_tug_are_integrals_of_its_waterplanes() {
    volumes_are_integrals(&["tug"]);
}

#[test]
#[ignore = "takes 60 s"]
fn volumes_are_integrals_of_waterplanes() {
    volumes_are_integrals(&["yacht", "fishing-vessel", "frigate", "container-ship", "bulk-carrier", "ellipsoid"]);
}

fn volumes_are_integrals(names: &[&str]) {
    for name in names {
        let body = read_hydrostatic_body(&carried(format!("configs/{name}.toml"))).unwrap();
        let hull = body.hull().unwrap();
        let (low, high) = (hull.bottom(), hull.top());
        let level = |k: usize| low + (high - low) * (1e-6 + (1.0 - 2e-6) * k as f64 / 20.0);
        let mut panels: Vec<[f64; 2]> = (0..20).map(|k| [level(k), level(k + 1)]).collect();
        let [whole, _] = added(&body, &[[level(0), level(20)]])[0];
        let mut sum = 0.0;
        for round in 0..18 {
            let found = added(&body, &panels);
            let mut left = Vec::new();
            for (&[a, b], [volume, integral]) in panels.iter().zip(found) {
                if (volume - integral).abs() > 3e-8 * whole && round < 17 {
                    left.extend([[a, 0.5 * (a + b)], [0.5 * (a + b), b]]);
                } else {
                    sum += volume - integral;
                }
            }
            if left.is_empty() {
                break;
            }
            panels = left;
        }
        assert!(sum.abs() < 1e-6 * whole, "{name}: {:e}", sum / whole);
    }
}
