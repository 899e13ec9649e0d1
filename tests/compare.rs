//! The command `compare`: closed distances and changes, files, draughts, refusals.

use std::fs;

use serde_json::Value;

use crate::cli::{config, table};
use crate::support::{folder, json, names_in, program, stderr, stdout};

#[track_caller]
fn answer(arguments: &[&str]) -> Value {
    let output = program(&[&["compare"], arguments, &["--json"]].concat());
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    json(stdout(&output))
}

fn value<'a>(json: &'a Value, key: &str) -> &'a Value {
    let values = json["values"].as_array().unwrap();
    values.iter().find(|value| value["key"] == key).unwrap_or_else(|| panic!("{key}"))
}

const BOX: &str = "[project]\nfamily = \"box\"\n[dimensions]\nLpp = 80\nB = 10\nT = 4\nD = 6\n";

/// Boxes of 10 and 11 m breadth: the sides are 0.5 m apart, areas differ by a tenth.
#[test]
fn boxes_differ_as_they_do() {
    let folder = folder("boxes");
    let first = folder.write("a.toml", BOX);
    let second = folder.write("b.toml", BOX.replace("B = 10", "B = 11"));
    let json = answer(&[&first, &second]);
    let near = |found: &Value, expected: f64| {
        assert!((found.as_f64().unwrap() - expected).abs() < 1e-9, "{found} {expected}");
    };
    near(&value(&json, "B")["change"], 10.0);
    near(&value(&json, "DISPVOL")["change"], 10.0);
    near(&value(&json, "CB")["change"], 0.0);
    near(&value(&json, "KB")["second"], 2.0);
    let distance = &json["distances"]["second_from_first"];
    near(&distance["largest"], 0.5);
    near(&distance["rms"], 0.5);
    assert_eq!(distance["outside"], true);
    for row in json["hydrostatics"].as_array().unwrap() {
        near(&row["AWL"]["change"], 10.0);
    }
}

#[test]
fn a_hull_is_not_far_from_itself() {
    let hull = config("tug.toml");
    let json = answer(&[&hull, &hull]);
    for way in ["second_from_first", "first_from_second"] {
        assert!(json["distances"][way]["largest"].as_f64().unwrap() < 1e-7, "{json}");
    }
    assert!(json["values"].as_array().unwrap().iter().all(|v| v["change"].as_f64().is_none_or(|c| c.abs() < 1e-12)));
}

/// A table against the design that it was drawn from, at one draught; the same files every time.
#[test]
fn files_are_written_and_the_same_each_time() {
    let folder = folder("files");
    let table = table().display().to_string();
    let wigley = config("wigley.toml");
    let run = |name: &str, more: &[&str]| {
        let out = folder.join(name).display().to_string();
        let arguments = [&["compare", &wigley, &table, "--draught", "5", "-o", &out], more].concat();
        let output = program(&arguments);
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
        assert!(stdout(&output).lines().all(|line| line.chars().count() <= 80), "{}", stdout(&output));
        assert!(stdout(&output).contains("both at T 5.000 m"), "{}", stdout(&output));
        names_in(&out)
    };
    let names = [
        "compare.csv",
        "compare.json",
        "compare.md",
        "compared-areas.png",
        "compared-areas.svg",
        "compared-body-plans.png",
        "compared-body-plans.svg",
        "manifest.json",
    ];
    assert_eq!(run("a", &[]), names);
    run("b", &[]);
    for name in names {
        assert_eq!(
            fs::read(folder.join("a").join(name)).unwrap(),
            fs::read(folder.join("b").join(name)).unwrap(),
            "{name}"
        );
    }
    let manifest = json(folder.read("a/manifest.json"));
    assert_eq!(
        (&manifest["input"]["file"], &manifest["others"][0]["file"]),
        (&"wigley.toml".into(), &"offsets.csv".into())
    );
    assert_eq!(run("c", &["--no-figures"]).len(), 4);
    let csv = folder.read("a/compare.csv");
    let volume: Vec<&str> = csv.lines().find(|line| line.contains("DISPVOL")).unwrap().split(',').collect();
    assert!(volume[5].parse::<f64>().unwrap().abs() < 0.2, "{volume:?}");
}

#[test]
fn what_cannot_be_compared_is_refused() {
    let wigley = config("wigley.toml");
    let deep = program(&["compare", &wigley, &config("tug.toml"), "--draught", "7"]);
    assert!(deep.status.code() == Some(2) && stderr(&deep).contains("--draught"), "{}", stderr(&deep));
    let absent = program(&["compare", &wigley, "absent.json"]);
    assert!(absent.status.code() == Some(6) && stderr(&absent).contains("E602"), "{}", stderr(&absent));
}

#[test]
fn other_conventions_are_a_warning() {
    let output = program(&["compare", &config("container-ship.toml"), &config("fishing-vessel.toml"), "--json"]);
    assert!(output.status.success());
    let warned = stderr(&output);
    assert!(warned.contains("W520 ") && warned.contains("its shell differs"), "{warned}");
    assert!(json(stdout(&output))["warnings"][0].as_str().unwrap().starts_with("W520"));
}
