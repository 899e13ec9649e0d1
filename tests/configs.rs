//! Every file of `configs/` is run, and so is every template; what they promise is checked.

use std::fs;
use std::path::{Path, PathBuf};

use loftsman::internals::config::{TEMPLATES, read, template};
use loftsman::internals::exchange::read_hull;
use loftsman::internals::report::{generate_outputs, read_design};
use serde_json::Value;

use crate::support::{carried, json, read_text, shared_folder};

fn configs() -> Vec<PathBuf> {
    let mut files: Vec<PathBuf> =
        fs::read_dir(carried("configs")).unwrap().map(|entry| entry.unwrap().path()).collect();
    files.retain(|path| path.extension().is_some_and(|e| e == "toml"));
    files.sort();
    assert!(files.len() >= 10);
    files
}

/// Targets of a summary within the promise: coefficients to 1e-10, the centre of buoyancy to 1e-9 of the length.
fn check(name: &str, summary: &Value) {
    let length = summary["particulars"]["Lpp"].as_f64().unwrap();
    for target in summary["targets"].as_array().unwrap() {
        let error = target["error"].as_f64().unwrap().abs();
        let allowed = if target["key"] == "XCB" { 1e-9 * length } else { 1e-10 };
        assert!(error <= allowed, "{name}: {target}");
        let design = summary["design"][target["key"].as_str().unwrap()].as_f64().unwrap();
        let achieved = target["achieved"].as_f64().unwrap();
        // What is asked is on Lpp; a table on another length has other coefficients.
        if summary["conventions"]["coefficient_length"] != "Lpp" && target["key"] != "XCB" && target["key"] != "CM" {
            continue;
        }
        assert!((design - achieved).abs() <= 1e-9 * achieved.abs(), "{name}: {target} and hydrostatics {design}");
    }
    assert!(summary["design"]["DISPVOL"].as_f64().unwrap() > 0.0);
}

#[test]
fn every_config_says_in_its_first_line_what_it_shows() {
    for path in configs() {
        let text = read_text(&path);
        let first = text.lines().next().unwrap();
        assert!(first.starts_with("# ") && first.len() > 20 && first.ends_with('.'), "{}: {first}", path.display());
    }
}

#[test]
fn every_config_gives_what_it_asks() {
    for path in configs() {
        let name = path.display().to_string();
        let (design, bytes) = read_design(&path).unwrap_or_else(|e| panic!("{e}"));
        let outputs = generate_outputs(&design, (&path, &bytes), &[]).unwrap_or_else(|e| panic!("{name}: {e}"));
        let file = |wanted: &str| outputs.files.iter().find(|f| f.name == wanted).map(|f| f.contents.clone()).unwrap();
        let summary = json(file("summary.json"));
        check(&name, &summary);
        let back = read_hull(&String::from_utf8(file("hull.json")).unwrap()).unwrap();
        assert_eq!(back.hull, outputs.hull, "{name}: hull.json is not the hull");
        assert_eq!(back.conventions, design.conventions);
        for wanted in ["offsets.csv", "heights.csv", "hydrostatics.csv", "manifest.json"] {
            let text = String::from_utf8(file(wanted)).unwrap();
            assert!(!["NaN", "inf", "null,"].iter().any(|bad| text.contains(bad)), "{name}: {wanted}");
        }
        let again = generate_outputs(&design, (&path, &bytes), &[]).unwrap();
        assert!(again.files == outputs.files, "{name}: not the same bytes twice");
    }
}

#[test]
fn every_template_generates() {
    for t in TEMPLATES {
        let text = template(t.name).unwrap();
        let design = read("new.toml", &text).unwrap();
        let outputs = generate_outputs(&design, (Path::new("new.toml"), text.as_bytes()), &[]);
        let outputs = outputs.unwrap_or_else(|e| panic!("{}: {e}", t.name));
        check(t.name, &serde_json::to_value(&outputs.summary).unwrap());
    }
}

#[test]
fn the_example_of_the_raw_generator_is_read() {
    let Some(folder) = shared_folder() else { return };
    let path = folder.join("seed002_frigate/frigate.hgf");
    if !path.is_file() {
        println!("skipped: {} is absent", path.display());
        return;
    }
    let (design, bytes) = read_design(&path).unwrap();
    let outputs = generate_outputs(&design, (&path, &bytes), &[]).unwrap();
    // The record's draughts are 7 m forward and 7.5 m aft.
    assert!((outputs.design_row.draught - 7.25).abs() < 1e-12);
    assert!((outputs.design_row.waterplane_area / 1159.0 - 1.0).abs() < 0.02, "{}", outputs.design_row.waterplane_area);
}

#[test]
fn the_published_schema_is_that_of_the_program() {
    let published = json(read_text(carried("configs/design.schema.json")));
    assert_eq!(
        published,
        loftsman::internals::config::design_schema(),
        "run `loftsman schema > configs/design.schema.json`"
    );
}
