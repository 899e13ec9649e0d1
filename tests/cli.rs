//! The built program: what it prints, what it writes, and how it ends.

use std::fs;
use std::path::{Path, PathBuf};

use serde_json::Value;

use crate::support::{Folder, carried, folder, json, names_in, program, read_text, stderr, stdout};

pub(crate) fn config(name: &str) -> String {
    carried("configs").join(name).display().to_string()
}

pub(crate) fn table() -> PathBuf {
    carried("tests/data/wigley/offsets.csv")
}

/// Generates the Wigley hull without figures into an empty folder.
pub(crate) fn wigley(test: &str) -> Folder {
    let path = folder(test);
    let output = program(&["generate", &config("wigley.toml"), "-o", path.to_str().unwrap(), "--no-figures", "-q"]);
    assert!(output.status.success(), "{}", stderr(&output));
    assert!(output.stdout.is_empty() && output.stderr.is_empty());
    path
}

#[test]
fn generate_writes_its_files_and_one_screen() {
    let path = folder("generate");
    let path = path.to_str().unwrap();
    let output = program(&["generate", &config("wigley.toml"), "-o", path]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let page = stdout(&output);
    assert!(page.lines().count() <= 24, "{page}");
    assert!(page.lines().all(|line| line.chars().count() <= 80), "{page}");
    for word in ["Wigley hull", "requested", "achieved", "origin", "DISPVOL", "Coefficients on Lpp", "manifest.json"] {
        assert!(page.contains(word), "{word}: {page}");
    }
    let names = names_in(path);
    let expected = [
        "diagram-sheet.png",
        "heights.csv",
        "hull.json",
        "hydrostatics.csv",
        "hydrostatics.png",
        "lines.png",
        "manifest.json",
        "offsets.csv",
        "offsets.toml",
        "report.md",
        "sectional-area.png",
        "sections.svg",
        "summary.json",
    ];
    assert_eq!(names, expected);
    let manifest = json(fs::read(Path::new(path).join("manifest.json")).unwrap());
    for entry in manifest["outputs"].as_array().unwrap() {
        let bytes = fs::read(Path::new(path).join(entry["file"].as_str().unwrap())).unwrap();
        assert_eq!(entry["sha256"], loftsman::internals::exchange::sha256(&bytes), "{entry}");
    }
}

#[test]
fn nothing_is_overwritten_without_force() {
    let path = wigley("force");
    let before = fs::read(path.join("hull.json")).unwrap();
    fs::remove_file(path.join("summary.json")).unwrap();
    let arguments = ["generate", &config("box.toml"), "-o", path.to_str().unwrap(), "--no-figures", "-q"];
    let output = program(&arguments);
    assert_eq!(output.status.code(), Some(6));
    assert!(stderr(&output).contains("E601") && stderr(&output).contains("hull.json"), "{}", stderr(&output));
    assert!(stderr(&output).contains("--force"));
    assert_eq!(fs::read(path.join("hull.json")).unwrap(), before);
    assert!(!path.join("summary.json").exists(), "a file was written although another was in the way");
    let mut forced = arguments.to_vec();
    forced.push("--force");
    assert!(program(&forced).status.success());
    assert_ne!(fs::read(path.join("hull.json")).unwrap(), before);
}

/// What a link points to is written; a device is no file that another can take the place of, and a file no folder.
#[cfg(unix)]
#[test]
fn only_files_are_written_over() {
    use std::os::unix::fs::FileTypeExt;
    let path = wigley("nodes");
    let (target, link) = (path.join("target.csv"), path.join("link.csv"));
    fs::write(&target, "old").unwrap();
    std::os::unix::fs::symlink("target.csv", &link).unwrap();
    let hull = path.join("hull.json").display().to_string();
    let to = |file: &Path| {
        let file = file.display().to_string();
        program(&["offsets", &hull, "--stations", "10,20", "--waterlines", "1,2", "-o", &file, "--force"])
    };
    let written = to(&link);
    assert_eq!(written.status.code(), Some(0), "{}", stderr(&written));
    assert!(link.symlink_metadata().unwrap().file_type().is_symlink());
    assert!(read_text(&target).starts_with("x\\z"));
    let device = to(Path::new("/dev/null"));
    assert_eq!(device.status.code(), Some(6), "{}", stderr(&device));
    assert!(stderr(&device).contains("/dev/null") && stderr(&device).contains("no file"), "{}", stderr(&device));
    assert!(fs::metadata("/dev/null").unwrap().file_type().is_char_device());
    let fair = program(&["fair", &table().display().to_string(), "-o", &target.display().to_string()]);
    assert_eq!(fair.status.code(), Some(6));
    assert!(!stderr(&fair).contains("faired in"), "{}", stderr(&fair));
}

#[test]
fn force_removes_what_the_earlier_run_wrote() {
    let path = folder("stale");
    let run = |more: &[&str]| {
        let mut arguments = vec!["generate".to_owned(), config("wigley.toml"), "-q".into(), "-o".into()];
        arguments.push(path.display().to_string());
        arguments.extend(more.iter().map(|word| (*word).to_owned()));
        let output = program(&arguments.iter().map(String::as_str).collect::<Vec<_>>());
        assert!(output.status.success(), "{}", stderr(&output));
    };
    run(&["--figures", "sections,sectional-area,hydrostatics"]);
    fs::write(path.join("hydrostatics.png"), "drawn over by hand").unwrap();
    fs::write(path.join("notes.txt"), "mine").unwrap();
    run(&["--figures", "sections", "--force"]);
    let there = |name: &str| path.join(name).exists();
    assert!(there("sections.svg") && there("notes.txt") && there("hull.json"));
    assert!(there("hydrostatics.png"), "a file that was changed since is not ours to remove");
    assert!(!there("sectional-area.png"));
    run(&["--no-figures", "--force"]);
    assert!(!there("sections.svg") && there("notes.txt"));
}

#[test]
fn tables_carry_the_decimals_that_are_meant() {
    let path = folder("decimals");
    for name in ["fishing-vessel.toml", "bulk-carrier.toml", "tug.toml"] {
        let target = path.join(name);
        let output = program(&["generate", &config(name), "-o", target.to_str().unwrap(), "--no-figures", "-q"]);
        assert!(output.status.success(), "{}", stderr(&output));
        let text = read_text(target.join("offsets.csv"));
        let header = text.lines().next().unwrap();
        assert!(header.split(',').skip(1).all(|z| z.len() <= 8), "{name}: {header}");
        for line in text.lines().skip(1) {
            let x = line.split(',').next().unwrap();
            assert!(x.len() <= 8 || x.starts_with('-') || line == text.lines().nth_back(2).unwrap(), "{name}: {line}");
        }
        for line in text.lines().filter(|line| line.starts_with("ste")) {
            assert!(!line.contains("0.0000000") && !line.contains("e-"), "{name}: {line}");
        }
    }
}

#[test]
fn json_is_one_object_and_the_same_bytes_twice() {
    let path = folder("json");
    let run = |name: &str| {
        let target = path.join(name);
        let output = program(&[
            "generate",
            &config("wigley.toml"),
            "-o",
            target.to_str().unwrap(),
            "--json",
            "--figures",
            "sections",
        ]);
        assert!(output.status.success());
        (stdout(&output), fs::read(target.join("hull.json")).unwrap(), fs::read(target.join("manifest.json")).unwrap())
    };
    let first = run("a");
    assert_eq!(first, run("b"));
    let summary = json(&first.0);
    assert_eq!(summary["name"], "Wigley hull");
    assert!((summary["design"]["CB"].as_f64().unwrap() - 4.0 / 9.0).abs() < 1e-12);
    let keys = ["key", "requested", "achieved", "error", "origin"];
    assert!(keys.iter().all(|key| !summary["targets"][0][key].is_null()));
    assert!(path.join("a/sections.svg").exists() && !path.join("a/lines.png").exists());
}

#[test]
fn hydro_from_file_folder_and_design() {
    let path = wigley("hydro");
    let file = path.join("hull.json");
    let of = |hull: &str, how: &str| {
        let output = program(&["hydro", hull, "--draughts", "1.25:6.25:1.25", how]);
        assert!(output.status.success(), "{}", stderr(&output));
        stdout(&output)
    };
    let from_file = of(file.to_str().unwrap(), "--json");
    assert_eq!(from_file, of(path.to_str().unwrap(), "--json"));
    assert_eq!(from_file, of(&config("wigley.toml"), "--json"));
    let table = json(&from_file);
    assert_eq!(table["rows"].as_array().unwrap().len(), 5);
    assert!((table["rows"][4]["DISPVOL"].as_f64().unwrap() / (4.0 / 9.0 * 6250.0) - 1.0).abs() < 1e-12);
    assert_eq!(table["conventions"]["density"], 1.025);
    let csv = of(path.to_str().unwrap(), "--csv");
    let lines: Vec<&str> = csv.lines().collect();
    assert!(lines[0].starts_with("T,") && lines[1].starts_with("m,") && lines.len() == 7);
    let page = stdout(&program(&["hydro", path.to_str().unwrap(), "--draughts", "1,2,...,6"]));
    assert!(page.lines().all(|line| line.chars().count() <= 80) && page.contains("DISPVOL"), "{page}");
}

#[test]
fn conventions_of_the_hull_can_be_overridden() {
    let path = wigley("conventions");
    let rows = |more: &[&str]| {
        let mut arguments = vec!["hydro", path.to_str().unwrap(), "--draughts", "3", "--json"];
        arguments.extend(more);
        let output = program(&arguments);
        assert!(output.status.success(), "{}", stderr(&output));
        let table = json(stdout(&output));
        (table["conventions"].clone(), table["rows"][0].clone())
    };
    let (_, plain) = rows(&[]);
    let (said, row) =
        rows(&["--density", "1000 kg/m3", "--kg", "2", "--coefficient-length", "Lwl", "--section-for-cp", "midship"]);
    let of = |row: &Value, key: &str| row[key].as_f64().unwrap();
    assert!((of(&row, "DISPM") - of(&row, "DISPVOL")).abs() < 1e-9);
    assert!((of(&row, "GMT") - of(&row, "KMT") + 2.0).abs() < 1e-12 && plain["GMT"].is_null());
    assert_eq!((&said["coefficient_length"], &said["section_for_Cp"]), (&Value::from("Lwl"), &Value::from("midship")));
    let page = |reference: &str| {
        let arguments = ["hydro", path.to_str().unwrap(), "--draughts", "3", "--lcb-reference", reference];
        stdout(&program(&arguments))
    };
    let printed = |page: &str| page.lines().find(|l| l.trim_start().starts_with("3.000")).unwrap().to_owned();
    let lcb = |reference: &str| printed(&page(reference)).split_whitespace().nth(3).unwrap().to_owned();
    assert_eq!(["AP", "midship", "fp", "percent"].map(lcb), ["50.000", "0.000", "50.000", "0.000"]);
    assert!(page("FP").contains("LCB from FP, + aft") && page("percent").contains(" % "), "{}", page("percent"));
    let water = program(&["hydro", path.to_str().unwrap(), "--draughts", "3", "--density", "1025"]);
    assert_eq!(water.status.code(), Some(2));
}

#[test]
fn offsets_in_three_notations() {
    let path = wigley("offsets");
    let of = |notation: &str| {
        let output = program(&[
            "offsets",
            path.to_str().unwrap(),
            "--stations",
            "50,150",
            "--waterlines",
            "6.25",
            "--buttocks",
            "1 m",
            "--notation",
            notation,
        ]);
        assert!(output.status.success(), "{}", stderr(&output));
        stdout(&output)
    };
    let metres = of("m");
    let lines: Vec<&str> = metres.lines().collect();
    assert_eq!(lines[0], "x\\z [m],6.25");
    let (x, y) = lines[1].split_once(',').unwrap();
    assert_eq!(x, "50");
    assert!((y.parse::<f64>().unwrap() - 5.0).abs() < 1e-12, "{y}");
    assert_eq!(lines[2], "150,");
    assert!(lines[4].starts_with("x\\y [m],1,keel,"), "{metres}");
    assert!(of("mm").contains("\n50000,5000\n"));
    assert!(of("feet-inches-eighths").contains("\n164-0-4,16-4-7\n"), "{}", of("feet-inches-eighths"));
}

#[test]
fn sections_of_every_plane() {
    let path = wigley("section");
    let hull = path.to_str().unwrap();
    for plane in [["--station", "50"], ["--waterline", "3"], ["--buttock", "2"], ["--plane", "1,0.5,0,50"]] {
        let csv = stdout(&program(&["section", hull, plane[0], plane[1]]));
        let mut lines = csv.lines();
        assert_eq!(lines.next(), Some("branch,x,y,z,face"));
        assert!(lines.next().is_some_and(|line| line.starts_with("1,") && line.ends_with(",side")), "{plane:?}: {csv}");
        let found = json(stdout(&program(&["section", hull, plane[0], plane[1], "--json"])));
        assert!(found["branches"][0]["points"].as_array().unwrap().len() >= 2);
    }
    let beside = program(&["section", hull, "--station", "500"]);
    assert_eq!((stdout(&beside).as_str(), beside.status.code()), ("branch,x,y,z,face\n", Some(0)));
    assert!(stderr(&beside).contains("the plane does not cut the hull"));
}

#[test]
fn templates_and_schema() {
    let list = stdout(&program(&["new"]));
    assert_eq!(list.lines().count(), 12);
    for aliases in ["(also: tanker)", "(also: trawler)", "(also: ferry, cruise)", "(also: coaster)"] {
        assert!(list.contains(aliases), "{list}");
    }
    assert_eq!(stdout(&program(&["new", "ferry"])), stdout(&program(&["new", "ro-ro"])));
    let folder = folder("new");
    let path = folder.join("ship.toml");
    let file = path.to_str().unwrap();
    assert!(program(&["new", "frigate", "-o", file]).status.success());
    assert_eq!(read_text(&path), stdout(&program(&["new", "frigate"])));
    assert_eq!(program(&["new", "tug", "-o", file]).status.code(), Some(6));
    assert_eq!(program(&["new", "submarine"]).status.code(), Some(2));
    let schema = json(stdout(&program(&["schema"])));
    assert_eq!(schema["$schema"], "https://json-schema.org/draft/2020-12/schema");
    assert_eq!(schema, json(stdout(&program(&["schema", "design"]))));
}

#[test]
fn the_self_test_passes() {
    let output = program(&["self-test"]);
    assert_eq!(output.status.code(), Some(0), "{}", stdout(&output));
    assert!(stdout(&output).lines().last().unwrap().ends_with("checks passed."));
}

#[test]
fn designs_of_one_name_do_not_replace_each_other() {
    let path = folder("stems");
    let design = |folder: &str| {
        fs::create_dir_all(path.join(folder)).unwrap();
        fs::copy(config("box.toml"), path.join(folder).join("x.toml")).unwrap();
        path.join(folder).join("x.toml").display().to_string()
    };
    let (a, b, out) = (design("a"), design("b"), path.join("out").display().to_string());
    let output = program(&["generate", &a, &b, "-o", &out, "--force", "--no-figures"]);
    assert_eq!(output.status.code(), Some(2), "{}", stderr(&output));
    assert!(stderr(&output).contains(&format!("{a} and {b} would both be written to ")), "{}", stderr(&output));
    assert!(!Path::new(&out).exists());
}

/// Completions name the commands and their options, manual pages have one file a command; the same call gives the same bytes.
#[test]
fn completions_and_manual_pages() {
    let printed = stdout(&program(&["completions", "bash"]));
    assert!(printed.contains("fair-curve") && printed.contains("--tolerance"));
    let path = folder("completions");
    let path = path.to_str().unwrap();
    let output = program(&["completions", "-o", path]);
    assert!(output.status.success(), "{}", stderr(&output));
    let names = names_in(path);
    let pages = names.iter().filter(|name| name.ends_with(".1")).count();
    assert!(pages > 16 && names.len() == pages + 5, "{names:?}");
    assert!(["_loftsman", "loftsman.1", "loftsman-fair.1"].iter().all(|name| names.iter().any(|other| other == name)));
    assert_eq!(read_text(Path::new(path).join("loftsman.bash")), printed);
    let page = read_text(Path::new(path).join("loftsman-fair.1"));
    assert!(page.starts_with(".ie") && page.contains("loftsman\\-fair") && page.contains("\\-\\-tolerance"), "{page}");
    // Nothing is overwritten, and a shell or a folder must be named.
    assert_eq!(program(&["completions", "-o", path]).status.code(), Some(6));
    assert_eq!(program(&["completions"]).status.code(), Some(2));
}
