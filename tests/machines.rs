//! What other programs rely on: one valid document on stdout, codes, standard input, sets of files that are whole.

use std::fs;
use std::io::Write as _;
use std::path::Path;
use std::process::{Output, Stdio};

use loftsman::internals::report::{Destination, Inputs, OutputFile};
use serde_json::Value;

use crate::cli::{config, table, wigley};
use crate::support::{carried, command, folder, json, names_in, program, read_text, stderr, stdout};

/// The errors in the document that a command prints, each with all members.
#[track_caller]
fn errors(output: &Output) -> Vec<Value> {
    let document = json(stdout(output));
    let list = document["error"].as_array().unwrap_or_else(|| panic!("{document}")).clone();
    for error in &list {
        let keys: Vec<&String> = error.as_object().unwrap().keys().collect();
        assert_eq!(keys, ["code", "expected", "file", "found", "key", "line", "message", "remedy"]);
    }
    list
}

/// What the program answers to a text on its standard input.
fn piped(arguments: &[&str], text: &[u8]) -> Output {
    let mut child =
        command(arguments).stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    child.stdin.take().unwrap().write_all(text).unwrap();
    child.wait_with_output().unwrap()
}

#[test]
fn errors_are_one_document_in_json() {
    let folder = folder("errors");
    let bad = folder.write("bad.toml", "[dimensions]\nLpp = 80\n[form]\nCpw = 1\n");
    let tall = folder.write("tall.toml", TALL);
    let made = wigley("errors-made");
    let made = made.display().to_string();
    let wigley = config("wigley.toml");
    let table = table().display().to_string();
    let cases: [(&[&str], i32, &str); 11] = [
        (&["generate", &bad, "--json"], 3, "E121"),
        (&["generate", &tall, "--json", "-o", "none"], 4, "E105"),
        (&["generate", "absent.toml", "--json"], 6, "E602"),
        (&["generate", &wigley, "--json", "-o", &made, "--no-figures"], 6, "E601"),
        (&["generate", "--json", "--foo"], 2, "E701"),
        (&["generate", "--json"], 2, "E702"),
        (&["hydro", &wigley, "--json", "--draughts", "1:2"], 2, "E703"),
        (&["hydro", &wigley, "--json", "--csv"], 2, "E704"),
        (&["fit", &bad, "--method", "bilinear", "--json"], 2, "E705"),
        (&["check", &bad, "--json"], 3, "E300"),
        (&["fair", &table, "--cb", "x", "--json"], 2, "E127"),
    ];
    for (arguments, exit, code) in cases {
        let output = program(arguments);
        assert_eq!(output.status.code(), Some(exit), "{arguments:?}: {}", stderr(&output));
        let found = errors(&output);
        assert!(found.iter().any(|error| error["code"] == code), "{arguments:?}: {found:?}");
        assert!(stderr(&output).contains(code), "{arguments:?}: {}", stderr(&output));
        // Without --json nothing but the message.
        let plain: Vec<&str> = arguments.iter().copied().filter(|word| *word != "--json").collect();
        if code != "E704" {
            assert!(program(&plain).stdout.is_empty(), "{plain:?}");
        }
    }
    let error = errors(&program(&["generate", &bad, "--json"])).remove(0);
    assert_eq!(error["line"], 4);
    assert_eq!((error["key"].as_str(), error["found"].as_str()), (Some("form.Cpw"), Some("Cpw")));
    assert_eq!(error["file"], bad);
    assert!(error["remedy"].as_str().unwrap().contains("Did you mean Cwp?"));
    let error = errors(&program(&["hydro", &wigley, "--json", "--lcb-reference", "keel"])).remove(0);
    assert_eq!(error["found"], "keel");
}

const TALL: &str = "[project]\nfamily = \"box\"\n[dimensions]\nLpp = 80\nB = 10\nT = 8.2\nD = 7.9\n";

/// A failure after the document is a member of it.
#[test]
fn a_verdict_is_in_the_document() {
    let misread = carried("tests/wigley_misread.csv").display().to_string();
    let output = program(&["check", &misread, "--json"]);
    assert_eq!(output.status.code(), Some(5), "{}", stderr(&output));
    let document = json(stdout(&output));
    assert!(!document["suspects"].as_array().unwrap().is_empty());
    assert_eq!(document["error"][0]["code"], "E502");
}

#[test]
fn several_designs_are_one_document_and_go_on_after_a_failure() {
    let folder = folder("several");
    let tall = folder.write("tall.toml", TALL);
    let bad = folder.write("bad.toml", "x\n");
    let (wigley, shape) = (config("wigley.toml"), config("box.toml"));
    let run = |out: &str, more: &[&str]| {
        let out = folder.join(out).display().to_string();
        let designs = ["generate", &wigley, &tall, &bad, &shape, "-o", &out, "--no-figures"];
        program(&[&designs, more].concat())
    };
    let output = run("a", &["--json"]);
    assert_eq!(output.status.code(), Some(4), "{}", stderr(&output));
    let document = json(stdout(&output));
    let designs = document["designs"].as_array().unwrap();
    assert_eq!(designs.len(), 4);
    assert_eq!((&designs[0]["name"], &designs[1]["error"][0]["code"]), (&"Wigley hull".into(), &"E105".into()));
    assert_eq!((&designs[2]["error"][0]["code"], &designs[3]["family"]), (&"E120".into(), &"box".into()));
    assert_eq!(names_in(folder.join("a")), ["box", "wigley"]);
    let last: Vec<String> = stderr(&output).lines().rev().take(3).map(str::to_owned).collect();
    assert!(last[2].starts_with("2 of 4 failed") && last[1].contains("4  ") && last[1].contains("E105"), "{last:?}");
    assert!(last[0].contains("3  ") && last[0].contains("bad.toml"), "{last:?}");

    let lines: Vec<Value> = stdout(&run("b", &["--jsonl"])).lines().map(json).collect();
    assert_eq!(Value::from(lines), document["designs"]);

    let stopped = run("c", &["--jsonl", "--fail-fast"]);
    assert_eq!((stdout(&stopped).lines().count(), stopped.status.code()), (2, Some(4)));
    assert_eq!(names_in(folder.join("c")), ["wigley"]);
    let one = program(&["generate", &tall, "--jsonl"]);
    assert_eq!(json(stdout(&one).trim())["error"][0]["code"], "E105");
}

#[test]
fn standard_input_is_read_as_what_it_holds() {
    let folder = folder("stdin");
    let out = folder.join("out").display().to_string();
    let design = fs::read(config("wigley.toml")).unwrap();
    let made = piped(&["generate", "-", "-o", &out, "--no-figures", "--json"], &design);
    assert!(made.status.success(), "{}", stderr(&made));
    assert_eq!(json(stdout(&made))["name"], "Wigley hull");
    let hull = fs::read(folder.join("out/hull.json")).unwrap();
    let of = |text: &[u8]| {
        let output = piped(&["hydro", "-", "--draughts", "3", "--json"], text);
        assert!(output.status.success(), "{}", stderr(&output));
        json(stdout(&output))["rows"][0]["DISPVOL"].as_f64().unwrap()
    };
    let volume = of(&hull);
    assert!((of(&design) / volume - 1.0).abs() < 1e-12);
    let offsets = fs::read(table()).unwrap();
    assert!((of(&offsets) / volume - 1.0).abs() < 1e-3);
    let checked = piped(&["check", "-", "--json"], &offsets);
    assert!(checked.status.success(), "{}", stderr(&checked));
    assert!(!piped(&["convert", "-"], &offsets).stdout.is_empty());
    assert_eq!(piped(&["hydro", "-", "--json"], b"").status.code(), Some(3));
}

#[test]
fn a_bad_design_costs_no_more_than_its_length() {
    let folder = folder("toml");
    let lines = |of: fn(usize) -> String| (0..4000).map(of).collect::<Vec<_>>().join("\n");
    let cases = [
        (lines(|i| format!("line {i} bad bad")), 50),
        (lines(|i| format!("unknown{i} = 3")), 50),
        (format!("output.draughts = [{}]", lines(|_| "\"x\",".to_owned())), 50),
        (lines(|i| format!("0.{i},1.25,3.5,7.25")), 50),
    ];
    for (text, most) in cases {
        let path = folder.write("bad.toml", text);
        let output = program(&["generate", &path]);
        assert_eq!(output.status.code(), Some(3));
        let messages = stderr(&output);
        let last = messages.lines().rfind(|line| !line.starts_with("More: ")).unwrap();
        assert!(last.starts_with("E131 ") && last.ends_with("more problems not shown"), "{last}");
        assert!((most..=most + 4).contains(&messages.lines().count()), "{messages}");
    }
}

/// One rule for names, wherever they come from.
#[test]
fn names_that_no_drawing_can_show_are_refused_before_the_work() {
    let folder = folder("names");
    let design = read_text(config("wigley.toml"));
    let refused = |arguments: &[&str], code: &str| {
        let output = program(arguments);
        let message = stderr(&output);
        assert_eq!(output.status.code(), Some(3), "{message}");
        assert!(message.contains(code), "{message}");
        assert!(message.contains("control character") || message.contains("255 characters"), "{message}");
    };
    let file = folder.write("a\u{7}b.toml", &design);
    refused(&["generate", &file], "E132");
    let long = design.replace("Wigley hull", &"x".repeat(40_000));
    refused(&["generate", &folder.write("long.toml", long)], "E123");
    let made = wigley("names-made");
    let hull = read_text(made.join("hull.json")).replace("Wigley hull", "a\\u0007b");
    refused(&["hydro", &folder.write("hull.json", hull), "--draughts", "3"], "E141");
    let rows = read_text(table());
    let named = rows.replacen("-50,", &format!("\"{}\",", "y".repeat(300)), 1);
    let output = program(&["check", &folder.write("t.csv", &named)]);
    assert_ne!(output.status.code(), Some(0));
    let name = format!("name = \"{}\"\n", "z".repeat(300));
    folder.write("n.toml", format!("[table]\n{name}"));
    refused(&["hydro", &folder.write("n.csv", &rows)], "E316");
}

#[test]
fn results_have_no_volatile_data() {
    let folder = folder("volatile");
    let curve = folder.write("c.csv", "x,y\n0,0\n1,1\n2,1.8\n3,2.1\n4,1.8\n5,1\n6,0.2\n");
    let run = |out: &str| {
        let out = folder.join(out).display().to_string();
        let output = program(&["fair-curve", &curve, "-o", &out, "--json", "--no-figures"]);
        assert!(output.status.success(), "{}", stderr(&output));
        (stdout(&output), read_text(Path::new(&out).join("fairing.json")))
    };
    let first = run("a");
    assert_eq!(first, run("b"));
    assert!(!first.0.contains("seconds") && !first.1.contains("seconds") && !first.1.contains("c.csv"));
}

/// Numbers of no ship are refused, whatever becomes of them later.
#[test]
fn numbers_beyond_all_ships_are_refused_in_curves() {
    let folder = folder("beyond");
    for (name, rows) in [("y", "0,0\n1,1e154\n2,2e154\n3,0\n"), ("x", "0,0\n1e154,1\n2e154,1\n3e154,0\n")] {
        let output = program(&["fair-curve", &folder.write(name, format!("x,y\n{rows}"))]);
        assert_eq!(output.status.code(), Some(3));
        assert!(stderr(&output).starts_with("E340 ") && stderr(&output).contains("no ship"), "{}", stderr(&output));
    }
}

#[test]
fn text_of_a_table_is_no_formula() {
    let folder = folder("formula");
    let text = "station,x,curve,z,y\n=1+2,0,WL,0,1\n=1+2,0,WL,1,1.5\n@b,5,WL,0,2\n@b,5,WL,1,2.5\n-1,10,WL,0,1\n-1,10,WL,1,1.5\n";
    let table = folder.write("t.csv", text.replace(",curve", "").replace(",WL", ""));
    let out = folder.join("out").display().to_string();
    let output = program(&["fit", &table, "-o", &out, "--no-figures", "-q"]);
    assert!(output.status.success(), "{}", stderr(&output));
    let rows = read_text(Path::new(&out).join("residuals.csv"));
    for name in ["\n'=1+2,", "\n'@b,", "\n-1,"] {
        assert!(rows.contains(name), "{name}: {rows}");
    }
}

#[test]
fn a_file_without_a_table_is_bad_input() {
    let folder = folder("unread");
    for (name, bytes) in [("a.csv", &b"abc\n"[..]), ("b.csv", b""), ("c.bin", &[0, 159, 146, 150, 7, 7])] {
        let path = folder.write(name, bytes);
        let output = program(&["check", &path]);
        assert_eq!(output.status.code(), Some(3), "{name}: {}", stderr(&output));
        assert!(stderr(&output).contains("E3") && output.stdout.is_empty(), "{}", stderr(&output));
        assert!(!errors(&program(&["check", &path, "--json"])).is_empty());
    }
}

fn file(name: &str) -> OutputFile {
    OutputFile::text(name, format!("{name}\n"))
}

/// A new folder is there with all of its files or not at all, and what a killed run left goes with the next.
#[test]
fn a_set_of_files_is_whole() {
    let parent = folder("whole");
    let target = parent.join("deep/new");
    let inputs = Inputs::default();
    let destination = Destination { folder: &target, inputs: &inputs, force: false };
    // No folder can have the name of a file.
    destination.write(&[file("a"), file("a/b")]).unwrap_err();
    assert!(names_in(&parent).is_empty());
    for number in [0, 2] {
        fs::create_dir(parent.join(format!(".loftsman-{number}.part"))).unwrap();
        fs::write(parent.join(format!(".loftsman-{number}.part/half")), "").unwrap();
        fs::write(parent.join(format!(".loftsman-{number}.lock")), "").unwrap();
    }
    // One that goes on holds its lock.
    let other = fs::File::create(parent.join(".loftsman-1.lock")).unwrap();
    other.lock().unwrap();
    let beside = parent.join("beside");
    Destination { folder: &beside, inputs: &inputs, force: false }.write(&[file("a"), file("b/c")]).unwrap();
    assert_eq!(names_in(&parent), [".loftsman-1.lock", "beside"]);
    drop(other);
    destination.write(&[file("a"), file("b/c"), file("manifest.json")]).unwrap();
    assert_eq!(names_in(&target), ["a", "b", "manifest.json"]);
    // In a folder that is there foreign files stay.
    fs::write(target.join("mine"), "mine").unwrap();
    Destination { force: true, ..destination }.write(&[file("b/d"), file("a")]).unwrap();
    assert_eq!(names_in(&target), ["a", "b", "manifest.json", "mine"]);
    assert_eq!(names_in(target.join("b")), ["c", "d"]);
}

#[test]
fn a_folder_of_two_runs_has_no_report() {
    let path = wigley("two-runs");
    let out = path.join("report").display().to_string();
    fs::copy(path.join("hydrostatics.csv"), path.join("offsets.csv")).unwrap();
    let output = program(&["report", path.to_str().unwrap(), "-o", &out]);
    assert_eq!(output.status.code(), Some(3));
    let message = stderr(&output);
    assert!(message.starts_with("E185 ") && message.contains("offsets.csv"), "{message}");
    assert!(!Path::new(&out).exists());
}

/// The stack of the process does not matter.
#[cfg(unix)]
#[test]
fn fairing_needs_little_stack() {
    let folder = folder("stack");
    let line = format!(
        "ulimit -s 256; exec {} fair {} -o {} --no-figures -q",
        env!("CARGO_BIN_EXE_loftsman"),
        table().display(),
        folder.join("out").display()
    );
    let output = std::process::Command::new("sh").args(["-c", &line]).output().unwrap();
    assert!(output.status.success(), "{}", stderr(&output));
}

#[test]
fn gm_is_shown_where_kg_is_known_and_marked_where_it_is_small() {
    let path = wigley("gm");
    let page = |kg: &[&str]| {
        let arguments = [&["hydro", path.to_str().unwrap(), "--draughts", "3,6.25"], kg].concat();
        stdout(&program(&arguments))
    };
    let none = page(&[]);
    assert!(!none.contains("GMT") && !none.contains("GM is below"), "{none}");
    let safe = page(&["--kg", "2"]);
    assert!(safe.contains("GMT") && safe.contains("GML") && !safe.contains("GM is below"), "{safe}");
    let tender = page(&["--kg", "3.7"]);
    assert!(tender.contains("GM is below 0.15 m") && tender.contains("at T 3.000 m."), "{tender}");
    assert!(!tender.contains('\u{1b}'), "no colour where nobody looks");
    // The report marks the same rows.
    let folder = folder("gm-report");
    let rows = program(&["hydro", path.to_str().unwrap(), "--draughts", "3,6.25", "--kg", "3.7", "--json"]);
    let result = folder.write("rows.json", stdout(&rows));
    let to = folder.join("report").display().to_string();
    let output = program(&["report", &result, "-o", &to, "--dpi", "20", "--quiet"]);
    assert!(output.status.success(), "{}", stderr(&output));
    let html = folder.read("report/report.html");
    assert!(html.contains("<p class=\"bad\">GM is below 0.15 m, the least of the IS Code, at T 3.000 m"), "not marked");
}

#[test]
fn a_centre_of_buoyancy_that_hardly_any_ship_has_is_a_warning() {
    let folder = folder("unusual");
    let text = read_text(config("bulk-carrier.toml"));
    let lcb = text.lines().find(|line| line.trim_start().starts_with("LCB")).unwrap();
    let moved = folder.write("moved.toml", text.replacen(lcb, "LCB = \"+6.4 %\"", 1));
    let output = program(&["generate", &moved, "-o", &folder.join("out").display().to_string(), "--no-figures"]);
    if output.status.success() {
        assert!(stderr(&output).contains("W204 ") && stderr(&output).contains("LCB is +6.40 %"), "{}", stderr(&output));
    } else {
        assert_eq!(output.status.code(), Some(4), "{}", stderr(&output));
    }
    // A wedge that floats with its centre far aft, and its length twice as long by statement.
    let wedge = "x\\z [m],0,1,2\n0,3,3,3\n5,3,3,3\n10,3,3,3\n15,1.5,1.5,1.5\n20,0,0,0\n";
    let path = folder.write("wedge.csv", wedge);
    folder.write("wedge.toml", "[table]\nT = 1\nLpp = 20\n");
    let output = program(&["hydro", &path, "--draughts", "1"]);
    assert!(stderr(&output).contains("W354 ") && stderr(&output).contains("% of Lpp"), "{}", stderr(&output));
}
