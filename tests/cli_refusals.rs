//! What the built program refuses: exit codes, messages, files that it does not write over.

use std::fs;
use std::path::Path;
use std::process::Stdio;

use crate::cli::{config, table, wigley};
use crate::support::{carried, command, folder, program, read_text, stderr, stdout};

#[test]
fn exit_codes_tell_what_went_wrong() {
    let path = folder("exit");
    let write = |name: &str, text: &[u8]| path.write(name, text);
    let out = path.join("out").display().to_string();
    let generate = |file: &str| program(&["generate", file, "-o", &out, "--no-figures"]);
    for (arguments, code) in [(&["generate"][..], 2), (&["frobnicate"], 2), (&["--help"], 0), (&["--version"], 0)] {
        assert_eq!(program(arguments).status.code(), Some(code), "{arguments:?}");
    }
    let bad_list = program(&["hydro", "x", "--draughts", "1:2"]);
    assert_eq!(bad_list.status.code(), Some(2));
    assert!(stderr(&bad_list).contains("a range is from:to:step"), "{}", stderr(&bad_list));

    let bad = generate(&write("bad.toml", b"[dimensions]\nLpp = 80\n[form]\nCpw = 1\nCm = \"x\"\n"));
    assert_eq!(bad.status.code(), Some(3));
    assert_eq!(stderr(&bad).lines().filter(|line| line.contains("bad.toml:")).count(), 2, "{}", stderr(&bad));
    assert!(stderr(&bad).contains("bad.toml:4:1 form.Cpw is not a key of a design. Did you mean Cwp?"));
    assert!(bad.stdout.is_empty());
    let latin = generate(&write("latin.toml", b"a = 1\n# \xe9\n"));
    assert!(
        latin.status.code() == Some(3)
            && stderr(&latin).starts_with("E129 ")
            && stderr(&latin).contains("latin.toml:2 byte 8 is not UTF-8"),
        "{}",
        stderr(&latin)
    );
    let record = generate(&write("ship.hgf", b"Name,LOA,BOA,D,HullData\nx,1,y,3,1 2\n"));
    assert_eq!(record.status.code(), Some(3));
    assert_eq!(stderr(&record).lines().filter(|line| line.starts_with("E130 ")).count(), 2, "{}", stderr(&record));
    assert!(stderr(&record).contains("ship.hgf:2 BOA: 'y' is not a number"), "{}", stderr(&record));
    assert!(stderr(&record).contains("ship.hgf:2 HullData: 2 numbers"), "{}", stderr(&record));
    let hull = program(&["hydro", &write("hull.json", b"{\"format\": 1}"), "--draughts", "1"]);
    assert!(
        hull.status.code() == Some(3) && stderr(&hull).starts_with("E140 ") && stderr(&hull).contains("hull.json:1:"),
        "{}",
        stderr(&hull)
    );
    let newer =
        program(&["hydro", &write("h.json", b"{\"format\":\"loftsman-hull\",\"version\":9}"), "--draughts", "1"]);
    assert!(stderr(&newer).starts_with("E141 "), "{}", stderr(&newer));
    assert!(stderr(&newer).contains("version 9 is newer than this program"), "{}", stderr(&newer));

    let tall = write("tall.toml", b"[project]\nfamily = \"box\"\n[dimensions]\nLpp = 80\nB = 10\nT = 8.2\nD = 7.9\n");
    let infeasible = generate(&tall);
    assert_eq!(infeasible.status.code(), Some(4));
    assert!(
        stderr(&infeasible).contains("E105") && stderr(&infeasible).contains("tall.toml:"),
        "{}",
        stderr(&infeasible)
    );

    let absent = generate(&path.join("absent.toml").display().to_string());
    assert!(absent.status.code() == Some(6) && stderr(&absent).starts_with("E602 cannot read "), "{}", stderr(&absent));
    let both = write("both.toml", b"[dimensions]\nLpp = 80\nB = 10\nT = 8.2\nD = 7.9\n[output]\nfigures = 3\n");
    let both = generate(&both);
    assert_eq!(both.status.code(), Some(3));
    assert!(stderr(&both).contains("E105 ") && stderr(&both).contains("E122 "), "{}", stderr(&both));
    fs::write(path.join("file"), "").unwrap();
    let inside = path.join("file/out").display().to_string();
    assert_eq!(program(&["generate", &config("box.toml"), "-o", &inside, "--no-figures"]).status.code(), Some(6));
    assert!(!Path::new(&out).exists(), "a failed run wrote something");
}

#[test]
fn a_reader_that_stops_early_is_no_error() {
    let mut child = command(&["hydro", &config("wigley.toml"), "--draughts", "0.01:6:0.01", "--json"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stdout.take());
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    assert_eq!(stderr(&output), "");
}

#[test]
fn what_is_too_much_is_refused() {
    let path = folder("too-much");
    let hull = path.join("wigley");
    let hull = hull.to_str().unwrap();
    assert_eq!(program(&["generate", &config("wigley.toml"), "--no-figures", "-o", hull]).status.code(), Some(0));
    let output = program(&["offsets", hull, "--stations", "0:100:0.02", "--waterlines", "0:6:0.002"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(stderr(&output).contains("cells"), "{}", stderr(&output));
    let named = path.join("named.toml");
    fs::write(&named, "[project]\nname = \"a\\u0001b\"\nfamily = \"box\"\n[dimensions]\nLpp = 10\nB = 2\nT = 1\n")
        .unwrap();
    let output = program(&["generate", named.to_str().unwrap(), "-o", path.join("named").to_str().unwrap()]);
    assert_eq!(output.status.code(), Some(3));
    assert!(stderr(&output).contains("control character"), "{}", stderr(&output));
}

#[test]
fn no_command_writes_over_what_it_reads() {
    let path = folder("inputs");
    let here = |name: &str| path.join(name).display().to_string();
    fs::copy(table(), path.join("offsets.csv")).unwrap();
    fs::copy(table(), path.join("validation.csv")).unwrap();
    fs::write(path.join("curve.csv"), "x,y\n0,0\n1,1\n2,1.6\n3,1.9\n4,2\n5,2.05\n").unwrap();
    fs::write(
        path.join("reference.toml"),
        "[particulars]\nlpp = 100\nbeam = 10\ndraught = 6.25\ndepth = 6.25\n[exact]\ncb = 0.444\n[table]\nfile = \"validation.csv\"\n",
    )
    .unwrap();
    let generated = wigley("inputs-hull");
    let hull = generated.join("hull.json").display().to_string();
    let count = fs::read_dir(&path).unwrap().count();
    let (folder, offsets, curve) = (path.display().to_string(), here("offsets.csv"), here("curve.csv"));
    let contents = || ["offsets.csv", "validation.csv", "curve.csv"].map(|name| fs::read(path.join(name)).unwrap());
    let before = contents();
    for arguments in [
        &["fit", &offsets, "-o", &folder, "--no-figures"][..],
        &["export", &offsets, "-f", "csv", "-o", &folder],
        &["fair-curve", &curve, "-o", &folder, "--no-figures"],
        &["validate", &folder, "-o", &folder],
        &["convert", &offsets, &offsets],
        &["convert", &offsets, "-o", &here("./offsets.csv")],
        &["hydro", &offsets, "--draughts", "3", "-o", &offsets],
        &["offsets", &hull, "--stations", "50", "--waterlines", "3", "-o", &hull],
        &["section", &hull, "--station", "50", "-o", &hull],
        &["inspect", &offsets, "-o", &offsets],
        &["check", &offsets, "--accept", "S1", "-o", &offsets],
    ] {
        let output = program(&[arguments, &["--force"]].concat());
        if arguments[0] == "check" {
            // The table is right: nothing can be accepted, and nothing is written either.
            assert_ne!(output.status.code(), Some(0));
            continue;
        }
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {}", stderr(&output));
        let said = stderr(&output);
        assert!(said.contains("is read and would be overwritten, with --force too; choose another place"), "{said}");
    }
    assert_eq!(contents(), before);
    assert_eq!(fs::read_dir(&path).unwrap().count(), count);
}

#[test]
fn what_is_read_is_not_removed_with_an_earlier_run() {
    let path = folder("inputs-kept");
    let table = path.join("table.csv");
    let text = fs::read(self::table()).unwrap();
    fs::write(&table, &text).unwrap();
    let entry = serde_json::json!({
        "file": "table.csv", "bytes": text.len(), "sha256": loftsman::internals::exchange::sha256(&text)
    });
    let manifest = serde_json::json!({ "program": "loftsman", "version": "0", "input": entry, "outputs": [entry] });
    fs::write(path.join("manifest.json"), manifest.to_string()).unwrap();
    let arguments = ["fit", table.to_str().unwrap(), "-o", path.to_str().unwrap(), "--no-figures", "-q", "--force"];
    let output = program(&arguments);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    assert_eq!(fs::read(&table).unwrap(), text);
}

#[test]
fn a_long_job_asks_before_it_begins() {
    let path = wigley("before");
    let arguments =
        ["fair", table().to_str().unwrap(), "-o", path.to_str().unwrap(), "--no-figures"].map(str::to_owned);
    let output = program(&arguments.iter().map(String::as_str).collect::<Vec<_>>());
    assert_eq!(output.status.code(), Some(6));
    assert!(stderr(&output).contains("E601") && !stderr(&output).contains("faired in"), "{}", stderr(&output));
}

/// Every command here is refused: its arguments, its exit code, what the message holds.
fn refused(cases: &[(&[&str], i32, &[&str])]) {
    for (arguments, code, parts) in cases {
        let output = program(arguments);
        assert_eq!(output.status.code(), Some(*code), "{arguments:?}: {}", stderr(&output));
        for part in *parts {
            assert!(stderr(&output).contains(part), "{arguments:?}: {part} is not in {}", stderr(&output));
        }
    }
}

#[test]
fn dimensions_and_conventions_that_no_ship_has() {
    let path = wigley("faults");
    let text = read_text(path.join("hull.json"));
    let write = |name: &str, text: &str| path.write(name, text);
    let changed = text.replace("\"density\":1.025", "\"density\":0").replace("\"KG\":null", "\"KG\":1e300");
    assert_ne!(changed, text);
    let faults = write("faults.json", &changed);
    let deep = write("deep.json", &text.replace("\"T\":6.25", "\"T\":60"));
    let cut = write("cut.json", &text[..text.find("\"surface\"").unwrap()]);
    let heavy = write(
        "heavy.toml",
        "[project]\nfamily = \"box\"\n[dimensions]\nLpp = 80\nB = 10\nT = 4\n[weight]\nKG = 7500\n",
    );
    let table = table().display().to_string();
    let out = path.join("out").display().to_string();
    refused(&[
        (
            &["hydro", &faults, "--draughts", "1"],
            3,
            &[
                "conventions.density is 0 t/m3, expected 0.9 to 1.3. Correct it",
                "conventions.KG is ",
                "expected -1000 to 1000",
            ],
        ),
        (&["report", &faults], 3, &["E182", "conventions.density is 0", "conventions.KG is "]),
        (&["hydro", &deep, "--draughts", "1"], 3, &["E141", "particulars.T is 60 m, expected at most particulars.D"]),
        (
            &["hydro", &cut, "--draughts", "1"],
            3,
            &["E140", "cut.json:", "cut off", "Run the command that wrote it again"],
        ),
        (&["report", &cut], 3, &["E182", "cut.json line ", "cut off", "Run the command that wrote it again"]),
        (
            &["generate", &heavy, "-o", &out],
            3,
            &["E124", "heavy.toml:8:", "weight.KG is 7500 m, expected -1000 to 1000"],
        ),
        (&["hydro", &table, "--draughts", "1", "--kg", "5000"], 2, &["--kg", "expected -1000 to 1000 m"]),
        (
            &["fit", &table, "--draught", "50", "-o", &out],
            2,
            &[
                "--draught: the design draught of 50.000 m lies above the depth of 6.250 m: state one within it (--draught",
            ],
        ),
        (&["fair", &table, "--draught", "50", "-o", &out], 2, &["E175", "lies above the depth of 6.250 m: state one"]),
    ]);
    assert!(!Path::new(&out).exists());
}

#[test]
fn messages_name_the_file_the_key_or_the_option() {
    let path = folder("names");
    let write = |name: &str, text: &str| path.write(name, text);
    let table = table().display().to_string();
    let mesh = carried("tests/golden/box.stl").display().to_string();
    let job = write("job.toml", "[table]\nfile = \"\"\n");
    let method = write("method.toml", "table = \" \"\n[method]\nkind = \"graded\"\n");
    let long = write("long.toml", &format!("[table]\nfile = \"{table}\"\n[dimensions]\nLpp = 1e9\n"));
    let dense = write("dense.toml", &format!("[table]\nfile = \"{table}\"\n[water]\ndensity = 10\n"));
    let curve = write("curve.csv", "x,y\n0,0\n1,1\n2,1.6\n3,1.9\n4,2\n5,2.05\n");
    refused(&[
        (&["fair", &job], 3, &["E174", "job.toml the file names no table. Write [table] file"]),
        (&["fit", &method], 3, &["E161", "method.toml the file names no table"]),
        (&["fair", &long], 3, &["E124", "long.toml:4:7 dimensions.Lpp is 1000000000.", "length below 100000 m"]),
        (&["fair", &table, "--draught", "1e9"], 2, &["E124 --draught dimensions.T is 1000000000"]),
        (&["hydro", &mesh, "--draughts", "1", "--up", "w"], 2, &["E311 command line 'up': up is \"w\""]),
        (&["inspect", &mesh, "--up", "w"], 2, &["E311 command line 'up': up is \"w\""]),
        (&["convert", &mesh, "-f", "obj", "--up", "w"], 2, &["E311 command line 'up': up is \"w\""]),
        (&["fair", &dense], 3, &["E124", "dense.toml:4:", "water.density is 10. Expected 0.9 to 1.3 t/m3"]),
        (&["fair-curve", &curve, "--first-slope", "nan"], 2, &["--first-slope", "expected a number"]),
        (&["fair-curve", &curve, "--last-slope", "inf"], 2, &["--last-slope", "expected a number"]),
        (&["fair-curve", &curve, "--weight", "-1"], 2, &["--weight", "expected a number above 0"]),
        (&["fair-curve", &curve, "--area", "nan"], 2, &["--area", "expected a number or keep"]),
        (&["fair-curve", &curve, "--centroid", "1e400"], 2, &["--centroid", "expected a number or keep"]),
    ]);
}

#[test]
fn convert_takes_its_file_as_other_commands_do() {
    let path = folder("convert-option");
    let (table, out) = (table().display().to_string(), path.join("out.csv").display().to_string());
    let output = program(&["convert", &table, "-o", &out, "-q"]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    assert_eq!(fs::read(&out).unwrap(), program(&["convert", &table, "-q"]).stdout);
    refused(&[(&["convert", &table, &out, "-o", &out], 2, &["cannot be used with"])]);
}

/// A table of points has no grid of offsets: its points are judged and drawn all the same.
#[test]
fn points_of_sections_are_checked_and_drawn() {
    let path = folder("points-checked");
    let table = carried("tests/data/s175/sections.csv").display().to_string();
    let output = program(&["check", &table, "-o", &path.display().to_string(), "--force"]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    assert!(path.join("suspect-points.svg").exists() && !path.join("suspects.svg").exists());
}

/// Areas are drawn and told in square metres; a straight line of locked points bends nowhere, and where one ends the
/// page says what lets the curvature jump.
#[test]
fn curves_of_areas_and_straight_locks() {
    let path = folder("curves");
    let here = |name: &str| path.join(name).display().to_string();
    let areas: String = (0..=20).map(|i| format!("{},{}\n", 5 * i, 120.0 * (f64::from(i) * 0.157).sin())).collect();
    fs::write(path.join("areas.csv"), format!("x,area\n{areas}")).unwrap();
    let output = program(&["fair-curve", &here("areas.csv"), "-o", &here("areas")]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let picture = read_text(path.join("areas/fair-curve.svg"));
    for words in ["area [m2]", "moves [m2]", "FAIRING OF A CURVE – areas"] {
        assert!(picture.contains(words), "{words}");
    }
    assert!(!picture.contains("moves [mm]"));
    // Of units in the head areas are squares, and a unit that is none is refused.
    let said = |head: &str, unit: &str| {
        fs::write(path.join("said.csv"), format!("{head}\n{areas}")).unwrap();
        program(&["fair-curve", &here("said.csv"), "-o", &here("said"), "--force", "--no-figures", "--unit", unit])
    };
    let largest = |head: &str, unit: &str| {
        let output = said(head, unit);
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
        let table = read_text(path.join("said/curve.csv"));
        let given = table.lines().skip(1).filter_map(|line| line.split(',').nth(4)?.parse::<f64>().ok());
        given.fold(0.0, f64::max)
    };
    let metres = largest("x,area", "m");
    for (head, unit, factor) in [
        ("x,area", "ft", 0.3048 * 0.3048),
        ("x [m],area [ft2]", "m", 0.3048 * 0.3048),
        ("x [mm],area [mm^2]", "m", 1e-6),
        ("x,area [m2]", "mm", 1.0),
    ] {
        let found = largest(head, unit);
        assert!((found / (factor * metres) - 1.0).abs() < 1e-9, "{head}: {found} for {metres}");
    }
    for (head, words) in [
        ("x,area [foo]", "'foo' is no unit of areas in the column area"),
        ("x [m2],area", "'m2' is no unit of lengths in the column x"),
    ] {
        let output = said(head, "m");
        assert_eq!(output.status.code(), Some(3));
        assert!(stderr(&output).contains(words), "{}", stderr(&output));
    }
    let line = |marks: [&str; 3]| {
        let rows = (0..21).map(|i| {
            let (x, bow) = (5.0 * f64::from(i), f64::from((6 - i).max(i - 12).max(0)));
            let mark = match i {
                6 => marks[0],
                7..=11 => marks[1],
                12 => marks[2],
                _ => "",
            };
            let noise = 0.004 * (7.3 * f64::from(i)).sin() * f64::from(u8::from(bow > 0.0));
            format!("{x},{:.4}{mark}\n", 8.0 + 0.01 * f64::from(i) - 0.05 * bow * bow + noise)
        });
        format!("x,y\n{}", rows.collect::<String>())
    };
    fs::write(path.join("locked.csv"), line(["!"; 3])).unwrap();
    fs::write(path.join("tangent.csv"), line(["T!", "!", "T!"])).unwrap();
    let straight: String = (0..21).map(|i| format!("{},{:.4}!\n", 5 * i, 8.0 + 0.01 * f64::from(i))).collect();
    fs::write(path.join("straight.csv"), format!("x,y\n{straight}")).unwrap();
    let page =
        |name: &str| stdout(&program(&["fair-curve", &here(name), "-o", &here("out"), "--force", "--no-figures"]));
    let locked = page("locked.csv");
    assert!(locked.contains("locked on a straight line from x = 30.000 to 60.000 m: with T at both"), "{locked}");
    let tangent = page("tangent.csv");
    assert!(tangent.contains(" -> 0\n") && !tangent.contains("with T at both"), "{tangent}");
    let straight = page("straight.csv");
    assert!(straight.contains("inflections   0 -> 0\n"), "{straight}");
}
