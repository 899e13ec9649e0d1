//! Where nobody states a draught none is invented: pages, files and drawings do without, and what needs one is refused.

use std::fs;
use std::path::Path;

use loftsman::internals::exchange::{read_hull, write_hull};
use loftsman::internals::fairing::constraint::Constraint;
use loftsman::internals::fairing::job::{Holding, Job, JobError};
use loftsman::internals::hull::{FitMethod, Hull};
use loftsman::internals::hydrostatics::Conventions;
use loftsman::internals::report::read_source;
use serde_json::Value;

use crate::support::{Folder, carried, folder, json, names_in, program, read_text, stderr, stdout, table_of};

const WIGLEY: &str = "tests/data/wigley/offsets.csv";
const YACHT: &str = "tests/data/pdstrip_yacht/offsets.csv";

const NONE: &str = "No draught is stated: give --draught (T under [table] beside a table, under [dimensions] of a job) for displacement and coefficients.";

/// What a command prints, and its exit code.
fn answer(arguments: &[&str]) -> (Option<i32>, String, String) {
    let output = program(arguments);
    (output.status.code(), stdout(&output), stderr(&output))
}

/// A page in one line.
fn in_one_line(page: &str) -> String {
    page.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// A fit in the folder `name` of a test, with these options; its page.
fn fit(folder: &Folder, name: &str, options: &[&str]) -> String {
    let (table, out) = (carried(WIGLEY).display().to_string(), folder.join(name).display().to_string());
    let (code, page, said) = answer(&[&["fit", &table, "-o", &out, "--force"], options].concat());
    assert_eq!(code, Some(0), "{said}");
    page
}

#[test]
fn a_fit_without_a_draught_has_no_displacement() {
    let folder = folder("fit");
    let page = fit(&folder, "none", &[]);
    let words = in_one_line(&page);
    assert!(page.lines().all(|line| line.chars().count() <= 80) && words.matches(NONE).count() == 1, "{page}");
    assert!(page.contains("Lpp 100.000 m   B 10.000 m   D 6.250 m\n"), "{page}");
    assert!(words.contains("below z = 6.250 m."), "{page}");
    for word in ["DISP", "CWP", "KMT", " T ", "T assumed", "no draught is stated: T"] {
        assert!(!page.contains(word), "{word}: {page}");
    }
    let names = names_in(folder.join("none"));
    assert!(!names.contains(&"sectional-area.png".to_owned()) && names.contains(&"lines.png".to_owned()), "{names:?}");
    let summary = json(folder.read("none/fit.json"));
    assert!(summary["design"].is_null() && summary["particulars"].get("T").is_none(), "{}", summary["particulars"]);
    let hull = json(folder.read("none/hull.json"));
    assert!(hull["particulars"].get("T").is_none() && hull["conventions"].get("design_draught_assumed").is_none());
    assert_eq!(read_source(&folder.join("none")).unwrap().hull.particulars().draught, None);
    // The same with one.
    let page = fit(&folder, "stated", &["--draught", "5", "--no-figures"]);
    assert!(page.contains("T 5.000 m") && page.contains("DISPVOL") && !page.contains("No draught"), "{page}");
    assert!((json(folder.read("stated/hull.json"))["particulars"]["T"].as_f64().unwrap() - 5.0).abs() < 1e-15);
}

/// L_PP is the length of the hull where no station stands at x = 0 and no draught says which waterline counts.
#[test]
fn without_a_draught_the_length_is_that_of_the_hull() {
    let mut table = table_of(carried(WIGLEY));
    table.stated.length_between_perpendiculars = None;
    table.stations.iter_mut().for_each(|station| station.station.x += 7.0);
    let fitted = Hull::fit(&table, &FitMethod::default()).unwrap();
    let p = fitted.hull.particulars();
    assert!(p.draught.is_none() && (p.length_between_perpendiculars - 100.0).abs() < 1e-6, "{p:?}");
    let told = fitted.notes.iter().any(|note| note.contains("L_PP = 100.000 m, between the ends of the hull"));
    assert!(told && !fitted.notes.iter().any(|note| note.contains("draught")), "{:?}", fitted.notes);
}

#[test]
fn hydrostatics_need_no_draught() {
    let folder = folder("hydro");
    fit(&folder, "hull", &["--no-figures"]);
    let hull = folder.join("hull").display().to_string();
    for source in [hull.clone(), carried(WIGLEY).display().to_string()] {
        let (code, page, said) = answer(&["hydro", &source]);
        assert!(code == Some(0) && page.contains("No design draught is stated (--draught).\n"), "{said}");
        let rows = page.lines().skip_while(|line| !line.contains("DISPVOL")).skip(2);
        let draughts: Vec<f64> =
            rows.take_while(|line| !line.is_empty()).map(|line| line[..10].trim().parse().unwrap()).collect();
        assert!((20..=50).contains(&draughts.len()), "{page}");
        assert!((draughts[0] - 1.25).abs() < 0.3 && (draughts[draughts.len() - 1] - 6.25).abs() < 1e-9, "{draughts:?}");
        let (code, page, said) = answer(&["hydro", &source, "--draught", "4.1", "--draughts", "4"]);
        assert!(code == Some(0) && !page.contains("No design draught"), "{said}");
    }
    let (code, _, said) = answer(&["hydro", &hull, "--draught", "70"]);
    assert!(code == Some(2) && said.contains("--draught"), "{said}");
}

#[test]
fn what_goes_to_a_waterline_is_not_exported_without_one() {
    let folder = folder("export");
    fit(&folder, "hull", &["--no-figures"]);
    let (hull, out) = (folder.join("hull").display().to_string(), folder.join("out").display().to_string());
    for format in ["gdf", "nemoh", "pnl", "michlet", "pdstrip", "delftship"] {
        let (code, _, said) = answer(&["export", &hull, "-f", format, "-o", &out]);
        let expected = format!("--format {format} needs a draught, and none is stated: give --draught");
        assert!(code == Some(2) && said.contains(&expected), "{said}");
        let (code, _, said) = answer(&["export", &hull, "-f", format, "-o", &out, "--draught", "4", "--panel", "9"]);
        assert_eq!(code, Some(0), "{said}");
    }
    let (code, _, said) =
        answer(&["export", &hull, "-f", "gdf,pnl,stl", "-o", &folder.join("some").display().to_string()]);
    // One format that cannot be written does not cancel the others.
    assert!(code == Some(5) && said.contains("E504") && said.contains("--format gdf needs a draught"), "{said}");
    assert!(folder.join("some/hull.stl").is_file() && !folder.join("some/hull.pnl").is_file());
    let one = folder.join("one/boat.obj").display().to_string();
    assert_eq!(answer(&["export", &hull, "-o", &one]).0, Some(0));
    assert!(folder.join("one/boat.obj").is_file());
    let (code, _, said) = answer(&["export", &hull, "-f", "obj", "--datum", "waterline", "-o", &out]);
    assert!(code == Some(2) && said.contains("--datum waterline needs a draught"), "{said}");
    let (code, _, said) = answer(&["export", &hull, "-f", "stl,csv,ghs", "-o", &out]);
    assert_eq!(code, Some(0), "{said}");
    // The option overrides what the hull states, for the datum too.
    fit(&folder, "stated", &["--no-figures", "--draught", "5"]);
    let stated = folder.join("stated").display().to_string();
    let datum = |name: &str, options: &[&str]| {
        let out = folder.join(name).display().to_string();
        let (code, _, said) = answer(&[&["export", &stated, "-f", "dxf", "-o", &out], options].concat());
        assert_eq!(code, Some(0), "{said}");
        folder.read(&format!("{name}/stated.dxf"))
    };
    assert!(datum("a", &["--datum", "waterline", "--draught", "2"]) == datum("b", &["--datum", "2 m"]));
    assert!(datum("c", &["--datum", "waterline"]) == datum("d", &["--datum", "5 m"]));
    let (table, panels) = (carried(WIGLEY).display().to_string(), folder.join("a.gdf").display().to_string());
    let (code, _, said) = answer(&["convert", &table, &panels]);
    assert!(code == Some(2) && said.contains("give --draught"), "{said}");
    assert_eq!(answer(&["convert", &table, &panels, "--draught", "4"]).0, Some(0));
    for format in ["delftship", "pdstrip"] {
        let (code, text, said) = answer(&["convert", &table, "-f", format]);
        assert!(
            code == Some(2) && text.is_empty() && said.contains(&format!("--format {format} needs a draught")),
            "{said}"
        );
    }
    // The option stands over what the file states.
    let stated = folder.write("stated.csv", format!("# T = 3 m\n{}", read_text(carried(WIGLEY))));
    for (options, draught) in [(&[][..], "3.0000"), (&["--draught", "2.5"][..], "2.5000")] {
        let (code, text, said) = answer(&[&["convert", &stated, "-f", "pdstrip"], options].concat());
        assert!(code == Some(0) && text.lines().next().is_some_and(|head| head.contains(draught)), "{text} {said}");
    }
}

/// A draught of the command at which the hull does not float is an error of the command, whichever it is.
#[test]
fn a_draught_that_is_none_of_the_hull_is_refused() {
    let folder = folder("none-of-the-hull");
    fit(&folder, "hull", &["--no-figures"]);
    let (hull, table) = (folder.join("hull").display().to_string(), carried(WIGLEY).display().to_string());
    let out = folder.join("out").display().to_string();
    let commands = [
        &["convert", &table, "-f", "pdstrip"][..],
        &["convert", &table, "-f", "delftship"],
        &["export", &hull, "-f", "pdstrip", "-o", &out],
        &["export", &hull, "-f", "delftship", "-o", &out],
        &["export", &hull, "-f", "stl", "--datum", "waterline", "-o", &out],
        &["hydro", &hull],
        &["hydro", &table],
        &["fit", &table, "-o", &out],
        &["fair", &table, "-o", &out],
    ];
    for (draught, expected) in [
        ("0", ""),
        ("-1", ""),
        ("NaN", ""),
        ("deep", ""),
        ("1e6", ""),
        ("1e-9", "the design draught of 1e-9 m is not above the lowest point of the hull, 0.000 m, and nothing floats"),
        ("70", "the design draught of 70.000 m lies above the depth of 6.250 m"),
    ] {
        for command in commands {
            let (code, page, said) = answer(&[command, &["--draught", draught]].concat());
            assert!(code == Some(2) && page.is_empty(), "{command:?} {draught}: {code:?} {said}");
            assert!(said.contains("--draught") || said.contains("command line"), "{command:?} {draught}: {said}");
            assert!(said.contains(expected), "{command:?} {draught}: {said}");
        }
    }
    assert!(!Path::new(&out).exists());
    // A table that states one is wrong itself.
    let deep = folder.write("deep.csv", format!("# T = 30 m\n{}", read_text(carried(WIGLEY))));
    for command in [&["convert", &deep, "-f", "pdstrip"][..], &["hydro", &deep], &["fit", &deep, "-o", &out]] {
        let (code, _, said) = answer(command);
        assert!(code == Some(3) && said.contains("deep.csv") && said.contains("of 30.000 m lies above"), "{said}");
    }
    // A section that ends below the waterline is open.
    let open = folder.write("open.csv", "x [m],0,1,2,3\n0,0,1,1.5,1.6\n5,0,2,,\n10,0,1,1.5,1.6\n");
    let (code, _, said) = answer(&["convert", &open, "-f", "pdstrip", "--draught", "2.5"]);
    let expected = "the section at x = 5.000 m ends at z = 1.000 m, below the draught of 2.500 m";
    assert!(code == Some(2) && said.contains(expected), "{said}");
}

/// z = 0 of panels is their waterline: what is below counts.
#[test]
fn hydrostatics_of_panels_are_within_them() {
    let folder = folder("panels");
    fit(&folder, "hull", &["--no-figures"]);
    let (hull, panels) = (folder.join("hull").display().to_string(), folder.join("hull.gdf").display().to_string());
    let out = folder.display().to_string();
    let (code, _, said) = answer(&["export", &hull, "-f", "gdf", "--draught", "4", "--panel", "5", "-o", &out]);
    assert_eq!(code, Some(0), "{said}");
    let (code, csv, said) = answer(&["hydro", &panels, "--csv"]);
    assert!(code == Some(0) && !csv.contains("above the top"), "{said} {csv}");
    let column = |k: usize| -> Vec<f64> {
        csv.lines().skip(2).map(|line| line.split(',').nth(k).unwrap().parse().unwrap()).collect()
    };
    let at = csv.lines().next().unwrap().split(',').position(|key| key == "DISPVOL").unwrap();
    let (draughts, volumes) = (column(0), column(at));
    assert!((-3.21..-2.8).contains(&draughts[0]) && draughts[draughts.len() - 1].abs() < 1e-9, "{draughts:?}");
    assert!(volumes[0] > 0.0 && volumes.windows(2).all(|pair| pair[1] > pair[0]), "{volumes:?}");
    let (code, _, said) = answer(&["hydro", &panels, "--draught", "4"]);
    let expected = "the design draught of 4.000 m lies above the highest point of the body, 0.000 m";
    assert!(code == Some(2) && said.contains(expected), "{said}");
}

/// What is at a draught is refused: options of the command with 2, keys of the job with 3, all at once.
#[test]
fn targets_at_a_draught_are_refused_without_one() {
    let folder = folder("targets");
    let (table, out) = (carried(YACHT).display().to_string(), folder.join("out").display().to_string());
    for option in [
        ["--displacement", "13 m3"],
        ["--displacement", "table"],
        ["--lcb", "table"],
        ["--cm", "table"],
        ["--cb", "0.4"],
        ["--lcb", "1 m AP"],
        ["--cm", "0.7"],
        ["--kb", "0.4"],
        ["--lcf", "1 m AP"],
        ["--cwp", "0.7"],
        ["--waterplane-area", "34"],
        ["--km", "2"],
        ["--wetted-surface", "40"],
    ] {
        let (code, _, said) = answer(&[&["fair", &table, "-o", &out], &option[..]].concat());
        let words = said.contains(&format!("E184 {} hold.", option[0])) && said.contains("Give --draught");
        assert!(code == Some(2) && words, "{code:?} {said}");
    }
    let (code, _, said) = answer(&["fair", &table, "-o", &out, "--gm", "1", "--kg", "1", "--lcb", "1 m AP"]);
    assert!(code == Some(2) && said.matches("E184 ").count() == 2, "{said}");
    let text = format!("[table]\nfile = {table:?}\n[hold]\nCm = \"table\"\nsection_areas = \"table\"\n");
    let job = folder.write("job.toml", text);
    let (code, _, said) = answer(&["fair", &job, "-o", &out, "--cb", "0.4"]);
    assert!(code == Some(3) && said.matches("E184 ").count() == 3, "{said}");
    assert!(said.contains("job.toml:4:6 hold.Cm: C_M needs a draught, and none is stated."), "{said}");
    assert!(!Path::new(&out).exists());
    // The library refuses them as well.
    let given = Holding::Given(vec![Constraint::WettedSurface(40.0), Constraint::CentreOfBuoyancy(1.0)]);
    let refused = Job { holding: given, ..Job::default() }.run(&table_of(carried(YACHT))).unwrap_err();
    assert!(matches!(&refused, JobError::NoDraught(words) if words == "wetted surface, LCB"), "{refused}");
}

/// The volume below the highest waterline of all stations and its centre take the place of displacement and LCB.
#[test]
fn without_a_draught_volume_and_centre_of_volume_are_held() {
    let folder = folder("held");
    let table = carried("tests/data/series60_cb060/offsets.csv").display().to_string();
    let out = folder.join("out").display().to_string();
    let (code, page, said) = answer(&["fair", &table, "-o", &out, "--no-figures"]);
    assert_eq!(code, Some(0), "{said}");
    let held = "volume and centre of volume below z = 9.754 m";
    let words = in_one_line(&page);
    assert!(page.lines().next().is_some_and(|line| line.ends_with(&format!("{held} kept."))), "{page}");
    assert!(
        words.contains("Assumed: L_PP, B, LCB origin, density, D. No draught is stated: give --draught."),
        "{page}"
    );
    assert_eq!(page.lines().count(), 9, "{page}");
    assert!(page.contains("Volume below z = 9.754 m 12587") && !page.contains("Displacement"), "{page}");
    assert!(page.lines().skip(1).all(|line| line.starts_with("Written") || line.chars().count() <= 80), "{page}");
    let certificate = json(folder.read("out/fairing.json"));
    assert_eq!(certificate["held_below"]["words"], format!("{held} (no draught is stated)"));
    assert!((certificate["held_below"]["z"].as_f64().unwrap() - 9.7536).abs() < 1e-9);
    let constraints = certificate["constraints"].as_array().unwrap();
    let kinds: Vec<&Value> = constraints.iter().map(|held| &held["kind"]).collect();
    assert_eq!(kinds, ["volume", "centre_of_volume"]);
    for held in constraints {
        let [low, high, after] = ["low", "high", "after"].map(|key| held[key].as_f64().unwrap());
        assert!(low < high && (low - 1e-9..=high + 1e-9).contains(&after), "{held}");
    }
    let summary = json(folder.read("out/summary.json"));
    assert!(summary["design"].is_null() && summary["before"].is_null());
    assert_eq!(summary["held_below"], certificate["held_below"]);
    assert!(summary["targets"].as_array().unwrap().iter().all(|target| target["origin"] == "table"));
    assert!(fs::metadata(folder.join("out/offsets.toml")).is_err());
    // With a draught the certificate says nothing of another height.
    let (code, _, said) = answer(&["fair", &table, "-o", &out, "--no-figures", "--force", "--draught", "6.5"]);
    assert_eq!(code, Some(0), "{said}");
    assert!(json(folder.read("out/fairing.json"))["held_below"].is_null());
}

/// A report of a hull without a draught has every figure but those at one.
#[test]
fn a_report_does_without_a_draught() {
    let folder = folder("report");
    let (table, out) = (carried(YACHT).display().to_string(), folder.join("out").display().to_string());
    let (code, page, said) = answer(&["fair", &table, "-o", &out, "--verbose"]);
    assert_eq!(code, Some(0), "{said}");
    let words = in_one_line(&page);
    assert!(page.contains("D 0.965 m"), "{page}");
    assert!(words.contains("Volume below z = 0.965 m 24.82 -> 24.83 m3") && words.matches(NONE).count() == 1, "{page}");
    assert!(words.contains("centre of the volume below z = 0.965 m: 0.8783 -> 0.8742 m"), "{page}");
    let (code, _, said) = answer(&["report", &out, "--dpi", "24"]);
    assert_eq!(code, Some(0), "{said}");
    let names = names_in(folder.join("out/report"));
    for name in ["sectional-area.svg", "design-condition.svg"] {
        assert!(!names.contains(&name.to_owned()), "{names:?}");
    }
    for name in ["lines.svg", "bonjean.svg", "hydrostatics.svg", "diagram-sheet.svg", "fairing-arrows-long.svg"] {
        let svg = folder.read(&format!("out/report/{name}"));
        assert!(!svg.contains("DWL") && !svg.contains("NaN"), "{name}");
    }
    let page = folder.read("out/report/report.html");
    let above = "No design draught is stated: give --draught to the command that wrote this result. The hydrostatic table holds at";
    assert!(page.contains(above) && !page.contains("id=\"condition\"") && !page.contains("dash-dot"));
    assert!(page.contains("Held: volume and centre of volume below z = 0.965 m (no draught is stated)."));
    assert!(!page.contains("draught is assumed"));
}

/// Older programs wrote a draught that nobody had stated, with a mark.
#[test]
fn a_marked_draught_of_an_older_file_is_none() {
    let folder = folder("older");
    fit(&folder, "hull", &["--no-figures", "--draught", "4.375"]);
    let text = folder.read("hull/hull.json");
    assert_eq!(read_hull(&text).unwrap().hull.particulars().draught, Some(4.375));
    let marked = text.replace("\"conventions\": {", "\"conventions\": {\"design_draught_assumed\":true,");
    assert_ne!(marked, text);
    let read = read_hull(&marked).unwrap();
    assert_eq!(read.hull.particulars().draught, None);
    let again = write_hull(&read.hull, &Conventions::default()).unwrap();
    assert_eq!(read_hull(&again).unwrap().hull, read.hull);
    assert!(!again.contains("\"T\""), "{}", &read_text(folder.join("hull/hull.json"))[..200]);
}
