//! The command `fair`: files, certificate, notation, locks, job files and their messages.

use std::fs;
use std::path::Path;

use loftsman::internals::fairing::change::Turns;
use loftsman::internals::hull::{Cut, Hull};
use loftsman::internals::report::{FairJob, FairOutputs, fair_outputs, fair_page, read_fair};
use serde_json::Value;

use crate::random::Random;
use crate::support::{Folder, carried, folder, json, program, read_text, stderr};

pub(crate) const TABLE: &str = "tests/data/series60_cb060/offsets.csv";
pub(crate) const YACHT: &str = "tests/data/pdstrip_yacht/offsets.csv";

/// Design draughts of tables that state none, between their waterlines.
const DRAUGHTS: [(&str, &str); 3] = [("series60", "6.828 m"), ("s175", "7.7 m"), ("yacht", "0.673 m")];

/// The option that states the draught of a table.
fn draught(table: &Path) -> Option<&'static str> {
    let name = table.display().to_string();
    DRAUGHTS.iter().find(|(table, _)| name.contains(table) && name.ends_with(".csv")).map(|(_, draught)| *draught)
}

/// Faired with the options, at the draught of the table where they state none.
pub(crate) fn faired(input: &Path, options: &[(&str, &str, &str)]) -> (FairJob, FairOutputs) {
    let stated = options.iter().any(|(_, key, _)| *key == "dimensions.T");
    let at = draught(input).filter(|_| !stated).map(|draught| ("--draught", "dimensions.T", draught));
    faired_as_it_is(input, &[options, at.as_slice()].concat())
}

pub(crate) fn faired_as_it_is(input: &Path, options: &[(&str, &str, &str)]) -> (FairJob, FairOutputs) {
    let options: Vec<_> = options.iter().map(|(option, key, value)| (*option, *key, (*value).to_owned())).collect();
    let job = read_fair(input, &options).unwrap_or_else(|failure| panic!("{failure}"));
    let outputs = fair_outputs(&job, false).unwrap_or_else(|failure| panic!("{failure}"));
    (job, outputs)
}

pub(crate) fn file(outputs: &FairOutputs, name: &str) -> String {
    let found = outputs.files.iter().find(|file| file.name == name).unwrap_or_else(|| panic!("no {name}"));
    String::from_utf8(found.contents.clone()).unwrap()
}

pub(crate) fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is no number"))
}

/// C_B says the displacement again, in the digits in which it is written: L_PP 121.92 m, B 16.256 m, T 6.828 m.
#[test]
fn displacement_and_block_coefficient_may_both_be_asked_for() {
    let options = |cb| {
        let stated = [
            ("--displacement", "hold.displacement", "8170 m3"),
            ("--cb", "hold.Cb", cb),
            ("--draught", "dimensions.T", "6.828 m"),
        ];
        stated.map(|(option, key, value): (&str, &str, &str)| (option, key, value.to_owned()))
    };
    let job = read_fair(&carried(TABLE), &options("0.60")).unwrap();
    let outputs = fair_outputs(&job, false).unwrap();
    let held = &outputs.outcome.held;
    assert!(held.iter().any(|held| held.constraint.key() == "displacement" && (held.after - 8170.0).abs() < 1e-8));
    assert!(held.iter().all(|held| held.constraint.key() != "block_coefficient"));
    let apart = fair_outputs(&read_fair(&carried(TABLE), &options("0.62")).unwrap(), false).err().unwrap().to_string();
    assert!(apart.starts_with("E170 --cb hold.Cb: a displacement of 8170.00 m3 is C_B 0.60"), "{apart}");
}

/// A job with a section area of 106 m2 amidships and this C_M.
fn with_midship_coefficient(coefficient: &str) -> Result<FairOutputs, String> {
    let path = folder(coefficient);
    let text = format!(
        "table.file = {:?}\n[hold]\nsection_areas = [[60.96, 106]]\nCm = {coefficient}\n[tolerance]\ntable = \"60 mm\"\n[dimensions]\nT = 6.828\n",
        carried(TABLE)
    );
    let job = path.write("j.toml", text);
    fair_outputs(&read_fair(Path::new(&job), &[]).unwrap(), false).map_err(|refused| refused.to_string())
}

/// The area amidships gives C_M again: 106 m2 over 16.256 m times 6.828 m is 0.955.
#[test]
#[ignore = "takes 15 s"]
fn an_area_amidships_and_a_midship_coefficient_are_one_target() {
    let outputs = with_midship_coefficient("0.955").unwrap();
    let held: Vec<&str> = outputs.outcome.held.iter().map(|held| held.constraint.key()).collect();
    assert_eq!(held, ["displacement", "lcb", "section_area"]);
}

#[test]
fn an_area_amidships_and_another_midship_coefficient_are_refused() {
    let apart = with_midship_coefficient("0.97").err().unwrap();
    assert!(apart.contains("E170") && apart.contains("j.toml:4:6 hold.Cm: a section area of 106.000 m2"), "{apart}");
}

/// At the end of what the tolerances allow some of the programs have answers that are no hulls: they are left alone.
#[test]
#[ignore = "takes 96 s"]
fn a_target_at_the_end_of_its_interval_is_no_fault_of_the_table() {
    let (_, outputs) = faired(&carried("tests/data/s175/offsets.csv"), &[("--lcb", "hold.LCB", "85.5395 m AP")]);
    assert!(!outputs.outcome.held.is_empty());
}

#[test]
fn targets_are_met_and_locks_hold() {
    let options = [
        ("--cb", "hold.Cb", "0.601"),
        ("--lcb", "hold.LCB", "-1.45 %"),
        ("--kb", "hold.KB", "table"),
        ("--tolerance", "tolerance.table", "0.2 m"),
        ("--lock", "lock.cells", "30.48@3.2512"),
        ("--lock", "lock.cells", "9.144@6.5024"),
        ("--draught", "dimensions.T", "6.5024"),
    ];
    let (_, outputs) = faired(&carried("configs/methods/series60-cb060.csv"), &options);
    outputs.verdict().unwrap();
    let held = &outputs.outcome.held;
    let keys: Vec<&str> = held.iter().map(|held| held.constraint.key()).collect();
    assert_eq!(keys, ["midship_coefficient", "kb", "block_coefficient", "lcb"]);
    let p = outputs.outcome.after.particulars();
    let [own_midship, own_kb] = [0, 1].map(|k| held[k].constraint.target());
    let targets = [own_midship, own_kb, 0.601, (0.5 - 0.0145) * p.length_between_perpendiculars];
    for (held, target) in held.iter().zip(targets) {
        assert!((held.after / target - 1.0).abs() < 1e-9, "{}: {} {target}", held.constraint.key(), held.after);
    }
    assert!((held[2].before - 0.601).abs() > 1e-5, "the target is not the table's own");
    let locked: Vec<_> = outputs.outcome.changes.iter().filter(|change| change.locked).collect();
    assert_eq!(locked.len(), 2);
    for change in &locked {
        assert!((change.after - change.before).abs() < 1e-9, "{change:?}");
    }
    assert!(outputs.outcome.changes.iter().any(|change| (change.after - change.before).abs() > 1e-4));
    // What did not move keeps its text.
    let changes = file(&outputs, "changes.csv");
    let texts = changes.lines().map(|line| line.split(',').collect::<Vec<_>>()).filter(|row| row[9] == "yes");
    assert!(texts.inspect(|row| assert_eq!(row[11], row[12], "{row:?}")).count() == locked.len());
}

#[test]
#[ignore = "takes 46 s"]
fn infeasible_targets_end_with_4_and_are_written() {
    let folder = folder("infeasible");
    let out = folder.join("out");
    let table = carried(TABLE).display().to_string();
    let options = ["--cb", "0.7", "--tolerance", "1 mm", "--draught", "6.828", "--no-figures"];
    let output = program(&[&["fair", &table, "-o", out.to_str().unwrap()][..], &options].concat());
    assert_eq!(output.status.code(), Some(4), "{}", stderr(&output));
    assert!(stderr(&output).contains("E401"), "{}", stderr(&output));
    let certificate = json(read_text(out.join("fairing.json")));
    assert_eq!(certificate["status"], "infeasible");
    let found = &certificate["infeasible"];
    assert!(found["widening"].as_f64().unwrap() > 1.0, "{found}");
    assert_eq!(found["cheapest"], "block_coefficient");
    let alone = found["alone"].as_array().unwrap();
    let alone = alone.iter().find(|alone| alone["kind"] == "block_coefficient").unwrap();
    let [least, greatest] = ["least", "greatest"].map(|key| alone[key].as_f64().unwrap());
    // Within a millimetre of the table, C_B is that of the table but for a part in a hundred.
    assert!(0.59 < least && least < greatest && greatest < 0.62, "{alone}");
    assert!(stderr(&output).contains("C_B (--cb) alone would have to give by"), "{}", stderr(&output));
    // Every file says that it is a compromise.
    let read = |name: &str| read_text(out.join(name));
    let mark = "# compromise: not all targets are met; fairing.json lists those that are not";
    let written = read("offsets.csv");
    assert_eq!(written.lines().next(), Some(mark));
    for name in ["hull.json", "summary.json"] {
        let file = json(read(name));
        assert!(file["name"].as_str().unwrap().ends_with(" (compromise)"), "{name}: {}", file["name"]);
    }
    let changes = read("changes.csv");
    assert!(changes.lines().skip(1).all(|line| line.ends_with(",infeasible")), "{changes}");
    // A table of a compromise that is faired in its turn loses the mark when all targets are met.
    let again = folder.join("again");
    let table = out.join("offsets.csv").display().to_string();
    let output = program(&["fair", &table, "-o", again.to_str().unwrap(), "--no-figures"]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    assert!(!read_text(again.join("offsets.csv")).contains("compromise"));
    let summary = json(read_text(again.join("summary.json")));
    assert!(!summary["name"].as_str().unwrap().contains("compromise"), "{}", summary["name"]);
}

/// A centre of buoyancy that is 1 % of L further aft than the table's comes by a smooth move of the whole hull.
#[test]
fn targets_other_than_the_table_s_are_had_by_a_smooth_move() {
    let options = [("--lcb", "hold.LCB", "-1.0 %"), ("--tolerance", "tolerance.table", "0.3 m")];
    let (_, outputs) = faired(&carried("configs/methods/series60-cb060.csv"), &options);
    outputs.verdict().unwrap();
    let outcome = &outputs.outcome;
    let turns =
        |of: fn(&loftsman::internals::fairing::change::Turns) -> usize| outcome.turns.iter().map(of).sum::<usize>();
    let (before, after) = (turns(|turns| turns.before), turns(|turns| turns.after));
    // 305 inflections and 8.5 times the energy where the readings stay where they are.
    assert!(after < before, "{before} > {after}");
    assert!(outcome.energy[1] < 16.0 * outcome.energy[0], "{:?}", outcome.energy);
    let lcb = outcome.held.iter().find(|held| held.constraint.key() == "lcb").unwrap();
    assert!((lcb.after / lcb.constraint.target() - 1.0).abs() < 1e-9, "{lcb:?}");
    // What it costs is the move, of which the tolerances have room for nearly all.
    let (rms, _, _) = outcome.moves();
    assert!((0.7 * rms..1.1 * rms).contains(&lcb.price), "{} {rms}", lcb.price);
    let widening = outcome.faired.carried.unwrap();
    assert!((0.3..1.1).contains(&widening), "{widening}");
}

/// A target that is as small as an error of the table is a smooth move too. Few lines have a hump more.
#[test]
fn a_small_change_of_target_leaves_a_fairer_hull() {
    for displacement in ["8385 t", "8380 t"] {
        let (_, outputs) = faired(&carried(TABLE), &[("--displacement", "hold.displacement", displacement)]);
        outputs.verdict().unwrap();
        let [before, after] = outputs.outcome.changes_of_sign();
        assert!(after < before, "{displacement}: {before} > {after}");
        let own = |turns: &&Turns| matches!(turns.cut, Cut::Station { .. } | Cut::Waterline { .. });
        let worse: Vec<_> = outputs.outcome.turns.iter().filter(own).filter(|t| t.after > t.before).collect();
        assert!(worse.len() <= 3 && worse.iter().all(|t| t.after <= t.before + 2), "{displacement}: {worse:?}");
    }
}

/// Two targets that are both out of reach: no single one would do, and each has its interval.
#[test]
#[ignore = "takes 44 s"]
fn targets_that_are_out_of_reach_together_have_intervals() {
    let options = [("--displacement", "hold.displacement", "9300 t"), ("--lcb", "hold.LCB", "+3 %")];
    let (_, outputs) = faired(&carried("configs/methods/series60-cb060.csv"), &options);
    let said = outputs.verdict().unwrap_err().to_string();
    let found = outputs.outcome.faired.diagnosis.as_ref().unwrap();
    assert_eq!(found.cheapest(), None);
    for (held, reach) in outputs.outcome.held.iter().zip(&found.reaches) {
        let [low, high] = reach.values.unwrap();
        assert!(low < held.before && held.before < high && reach.missing.is_none(), "{reach:?} {held:?}");
    }
    let [least, fair] = [found.widening, outputs.outcome.faired.carried].map(Option::unwrap);
    assert!(1.0 < least && least < fair, "{least} {fair}");
    for words in [
        "no single target would do",
        "displacement (--displacement) without",
        "LCB (--lcb) without",
        "by one smooth move",
    ] {
        assert!(said.contains(words), "{words}: {said}");
    }
}

/// Eight per cent less displacement than there is, more than the tolerances leave, and ten times as much as there is: no waves, the
/// nearest fair hull within the tolerances and an interval that holds what was written.
#[test]
#[ignore = "takes 103 s"]
fn targets_out_of_reach_give_the_nearest_fair_hull() {
    let table = carried(TABLE);
    let (_, outputs) = faired(&table, &[("--displacement", "hold.displacement", "7700 t")]);
    let outcome = &outputs.outcome;
    assert!(outputs.verdict().is_err() && outcome.nearest);
    let held = outcome.held.iter().find(|held| held.constraint.key() == "displacement").unwrap();
    let reach = &outcome.faired.diagnosis.as_ref().unwrap().reaches;
    let reach = reach.iter().find(|reach| outcome.held[reach.constraint].constraint == held.constraint).unwrap();
    let [low, high] = reach.values.unwrap();
    let target = held.constraint.target();
    assert!(low < held.before && held.before < high && !(low..=high).contains(&target), "{reach:?}");
    // A part of the way to what can be had.
    let end = if target < low { low } else { high };
    let part = (held.after - held.before) / (end - held.before);
    assert!((0.05..=1.0).contains(&part), "{part} of the way, {held:?}");
    for change in &outcome.changes {
        assert!(change.tolerance.is_none_or(|most| (change.after - change.before).abs() <= most * 1.0001));
    }
    let counts = ["station", "waterline", "buttock", "diagonal"].map(|kind| outcome.inflections(kind));
    let sum = |side: usize| counts.iter().map(|count| count[side]).sum::<usize>();
    assert!(sum(1) <= sum(0), "{counts:?}");
    // Between the offsets as well nothing moves further than a few tolerances.
    let at = |hull: &Hull, k: u32, j: u32| hull.half_breadth(4.0 + 1.5 * f64::from(k), 1.0 + 0.4 * f64::from(j));
    let moved = |k, j| Some((at(&outcome.after, k, j)? - at(&outcome.before, k, j)?).abs());
    let most = (0..75).flat_map(|k| (0..20).map(move |j| (k, j))).filter_map(|(k, j)| moved(k, j)).fold(0.0, f64::max);
    assert!(most < 0.3, "the hull moved by {most} m");
}

/// Exit code and messages of a job with this text; its file is called `job.toml` in them.
pub(crate) fn answer_to_job(folder: &Folder, table: &str, text: &str, options: &[&str]) -> (Option<i32>, String) {
    let job = folder.write("job.toml", format!("[table]\nfile = {:?}\n{text}", carried(table).display().to_string()));
    let out = folder.join("out").display().to_string();
    let output = program(&[&["fair", &job, "-o", &out, "--force", "--no-figures"], options].concat());
    (output.status.code(), stderr(&output).replace(&format!("{}/", folder.display()), ""))
}

#[test]
#[ignore = "takes 84 s"]
fn what_is_infeasible_names_the_line_of_the_job() {
    let folder = folder("infeasible-places");
    let text = "[tolerance]\ntable = \"1 mm\"\n[shape]\nconvex = [\n  \"waterline 6.5024\",\n]\nconcave = [\"waterline 6.5024\"]\n";
    let (code, words) = answer_to_job(&folder, TABLE, text, &[]);
    let expected = "given up was the waterline at z = 6.502 m convex (job.toml:7), the waterline at z = 6.502 m concave (job.toml:9)";
    assert!(code == Some(4) && words.contains(expected) && words.contains("no tolerances were found"), "{words}");
    let (code, words) =
        answer_to_job(&folder, TABLE, "[hold]\nLCB = \"+3 %\"\n", &["--displacement", "9300 t", "--draught", "6.828"]);
    assert_eq!(code, Some(4));
    assert!(
        words.contains(" LCB (job.toml:4) without") && words.contains(" displacement (--displacement) w"),
        "{words}"
    );
}

/// A section area with a band that is out of reach: the tolerances that would do are told.
#[test]
#[ignore = "takes 136 s"]
fn the_least_tolerances_for_a_section_area_are_found() {
    let folder = folder("widening");
    let run = |tolerance: f64| {
        let (job, out) = (folder.join("job.toml"), folder.join("out"));
        let table = carried(TABLE).display().to_string();
        let hold = "[hold]\nsection_areas = [[30.48, 70, 5]]";
        fs::write(
            &job,
            format!("[table]\nfile = {table:?}\n[dimensions]\nT = 6.828\n[tolerance]\ntable = {tolerance}\n{hold}\n"),
        )
        .unwrap();
        let (job, to) = (job.display().to_string(), out.display().to_string());
        let output = program(&["fair", &job, "-o", &to, "--force", "--no-figures"]);
        let certificate = json(read_text(out.join("fairing.json")));
        (output.status.code(), stderr(&output), certificate["infeasible"]["widening"].as_f64())
    };
    let (code, said, widening) = run(0.01);
    assert!(
        code == Some(4) && said.contains(" mm where it is widest now 10.0 mm) would do, but distorts the hull"),
        "{said}"
    );
    assert!(widening.is_some_and(|widening| (21.0..24.5).contains(&widening)), "{widening:?}");
}

/// A tolerance that is less than what the surface through the table passes B/2 by between offsets leaves no room to do better:
/// it may stay there, and no line bends more often for it.
#[test]
#[ignore = "takes 14 s"]
fn tolerances_below_the_swings_of_the_start_harm_nothing() {
    let folder = folder("tight");
    let out = folder.join("out");
    let (table, to) = (carried(TABLE).display().to_string(), out.display().to_string());
    let output = program(&["fair", &table, "--tolerance", "0.5 mm", "-o", &to, "--no-figures"]);
    // Its lines have the least changes of sign that such a tolerance leaves, before and after.
    let page = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(output.status.success() && page.starts_with("Fair as before"), "{page}{}", stderr(&output));
    let certificate = json(read_text(out.join("fairing.json")));
    for kind in ["stations", "waterlines", "buttocks", "diagonals"] {
        for line in certificate["inflections"][kind].as_array().unwrap() {
            assert!(line["after"].as_u64() <= line["before"].as_u64(), "{kind} {line}");
        }
    }
    let [before, after] = ["before", "after"].map(|side| certificate["energy"][side].as_f64().unwrap());
    assert!(after <= before, "{after} {before}");
    let beyond: Vec<f64> =
        certificate["beyond_half_breadth"].as_array().unwrap().iter().map(|value| value.as_f64().unwrap()).collect();
    assert!(beyond[0] > 5e-4 && beyond[1] <= beyond[0] + 1e-6, "{beyond:?}");
}

/// The whole sectional-area curve: that of the smoothed table within a band, or from a file beside the job.
#[test]
#[ignore = "takes 8 s"]
fn a_sectional_area_curve_is_held() {
    let folder = folder("areas");
    let run = |areas: &str| {
        let (job, out) = (folder.join("job.toml"), folder.join("out"));
        let table = carried(TABLE).display().to_string();
        fs::write(&job, format!("[table]\nfile = {table:?}\n[dimensions]\nT = 6.828\n[hold]\n{areas}\n")).unwrap();
        let (job, to) = (job.display().to_string(), out.display().to_string());
        let output = program(&["fair", &job, "-o", &to, "--force", "--no-figures", "--verbose"]);
        (output.status.code(), stderr(&output), String::from_utf8_lossy(&output.stdout).into_owned())
    };
    let certificate = || json(folder.read("out/fairing.json"));
    let areas = || -> Vec<[f64; 4]> {
        let all = certificate()["constraints"].as_array().unwrap().clone();
        let own = all.iter().filter(|c| c["kind"] == "section_area");
        own.map(|c| ["x", "band", "target", "after"].map(|key| c[key].as_f64().unwrap())).collect()
    };
    let (code, said, page) = run("section_areas = \"table\"");
    assert_eq!(code, Some(0), "{said}");
    assert!(page.contains("Section areas at 25 places: off target by "), "{page}");
    let exact = areas();
    assert_eq!(exact.len(), 25);
    assert!(exact.iter().all(|[_, band, target, after]| band.abs() < 1e-15 && (after / target - 1.0).abs() < 1e-10));
    let (code, said, _) = run("section_areas = \"table\"\nsection_area_band = 0.01");
    assert_eq!(code, Some(0), "{said}");
    let within = areas();
    assert!(
        within
            .iter()
            .all(|[_, band, target, after]| (band - 0.01).abs() < 1e-15 && (after - target).abs() < 0.01 + 1e-9)
    );
    assert!(within.iter().any(|[_, _, target, after]| (after - target).abs() > 1e-4));
    let [x, _, area, _] = exact[12];
    fs::write(folder.join("areas.csv"), format!("x,area,band\n{x},{area},\n20,54.82,0.05\n")).unwrap();
    let (code, said, page) = run("section_areas = \"areas.csv\"\nsection_area_band = 0.02");
    assert_eq!(code, Some(0), "{said}");
    assert!(page.contains("section area at x = 20.000 m"), "{page}");
    let mut bands: Vec<f64> = areas().iter().map(|area| area[1]).collect();
    bands.sort_by(f64::total_cmp);
    assert!(bands.len() == 2 && (bands[0] - 0.02).abs() < 1e-15 && (bands[1] - 0.05).abs() < 1e-15, "{bands:?}");
    fs::write(folder.join("areas.csv"), "x,area\n20,54.8\n30,x\n").unwrap();
    let (code, said, _) = run("section_areas = \"areas.csv\"");
    assert!(code == Some(3) && said.contains("E340") && said.contains("areas.csv:3"), "{code:?} {said}");
    // The area of the midship section says the midship coefficient.
    let (code, said, page) = run("section_areas = [[60.96, 108.10, 0.02]]");
    assert!(code == Some(0) && page.contains("section area at x = 60.960 m: 108.246 -> 108.120 m2"), "{said} {page}");
    assert!(certificate()["constraints"].as_array().unwrap().iter().all(|c| c["kind"] != "midship_coefficient"));
    let (code, said, _) = run("section_areas = \"nowhere.csv\"");
    assert!(code == Some(6) && said.contains("nowhere.csv"), "{code:?} {said}");
    let (code, said, _) = run("section_areas = \"table\"\nsection_area_band = -1");
    assert!(code == Some(3) && said.contains("E124") && said.contains("hold.section_area_band is -1"), "{said}");
}

/// Sections of a hull with y = (B/2)(1 - s^2)(1 - w^2) as points at heights of their own, 5 mm of noise on the
/// half-breadths.
#[test]
#[ignore = "takes 8 s"]
fn sections_given_as_points_are_faired() {
    use std::fmt::Write;
    let mut random = Random(5);
    let truth = |x: f64, z: f64| 5.0 * (1.0 - (x / 50.0 - 1.0).powi(2)) * (1.0 - (1.0 - z / 6.0).powi(2));
    let mut text = "station,x [m],point,y [m],z [m]\n".to_owned();
    for station in 1..20 {
        let x = 5.0 * f64::from(station);
        for point in 0..12 {
            let z = 6.0
                * (f64::from(point) / 11.0 + 0.002 * f64::from(station % 3) * f64::from(point * (11 - point)) / 11.0);
            let y = if point == 0 { 0.0 } else { truth(x, z) + 0.005 * random.normal() };
            writeln!(text, "{station},{x},{point},{y:.5},{z:.5}").unwrap();
        }
    }
    let folder = folder("points");
    let table = folder.join("sections.csv");
    fs::write(&table, text).unwrap();
    let (job, outputs) = faired(&table, &[]);
    let changes = &outputs.outcome.changes;
    // Keels are no half-breadths.
    assert_eq!(changes.len(), 19 * 11);
    assert!(
        changes.iter().all(|change| (change.after - change.before).abs() <= change.tolerance.unwrap_or(0.0) + 1e-9)
    );
    let rms = |of: &dyn Fn(usize) -> f64| {
        let squares: f64 = (0..changes.len()).map(|k| (of(k) - truth(changes[k].x, changes[k].z)).powi(2)).sum();
        (squares / changes.len() as f64).sqrt()
    };
    let errors = [rms(&|k| changes[k].before), rms(&|k| changes[k].after)];
    assert!(errors[1] < 0.99 * errors[0], "{errors:?}");
    let held = &outputs.certificate["constraints"][0];
    assert!((number(&held["after"]) / number(&held["target"]) - 1.0).abs() < 1e-10, "{held}");
    // The points are written back where they were, with their new half-breadths.
    let written = &outputs.outcome.table;
    for (old, new) in job.table.stations.iter().zip(&written.stations) {
        let pairs = old.outlines.iter().flatten().zip(new.outlines.iter().flatten());
        assert!(pairs.clone().all(|(a, b)| a.z.to_bits() == b.z.to_bits() && (a.y - b.y).abs() < 0.05));
        assert!(pairs.clone().any(|(a, b)| a.y.to_bits() != b.y.to_bits()));
    }
    assert!(file(&outputs, "changes.csv").contains(",point 0.11,"));
}

/// Station and waterline of what is left out.
fn excluded(outputs: &FairOutputs) -> Vec<(usize, usize)> {
    let excluded = outputs.outcome.changes.iter().filter(|change| change.suspect);
    excluded.map(|change| (change.station, change.origin.waterline().unwrap())).collect()
}

/// 9.31 m at station 8 and 8.54 m at station 5 are written 9.13 and 8.34 m, both on waterline 3: each hides the other from its
/// neighbours.
#[test]
fn errors_that_contradict_the_field_are_left_out() {
    let (_, outputs) = faired(&carried("tests/frigate_misread.csv"), &[]);
    assert_eq!(excluded(&outputs), [(5, 3), (8, 3)]);
    let expected = [8.54, 9.31];
    let half_breadth = |[x, z]: [f64; 2]| outputs.outcome.after.half_breadth(x, z).unwrap();
    for (place, expected) in [[32.297, 4.965], [50.806, 4.965]].into_iter().zip(expected) {
        assert!((half_breadth(place) - expected).abs() < 0.03, "{} {expected}", half_breadth(place));
    }
}

/// 4.841 m at station 13 is written 4.814 m on the highest waterline. The knuckle that it looks like has no offsets beyond it.
#[test]
fn a_misprint_on_the_highest_waterline_is_left_out() {
    let (_, outputs) = faired(&carried("tests/wigley_misread.csv"), &[]);
    assert_eq!(excluded(&outputs), [(13, 13)]);
    let found = outputs.outcome.after.half_breadth(58.909, 10.0).unwrap();
    assert!((found - 4.841).abs() < 1e-3, "{found}");
}

#[test]
#[ignore = "takes 11 s"]
fn a_misprint_is_left_out_and_listed() {
    let table = carried("reports/suspects/series60-misprinted.csv");
    let (job, outputs) = faired(&table, &[]);
    let excluded: Vec<_> = outputs.outcome.changes.iter().filter(|change| change.suspect).collect();
    assert!(!excluded.is_empty());
    let page = fair_page(&job, &outputs, "out");
    for change in &excluded {
        assert!(change.tolerance.is_none());
        let suspect = outputs
            .outcome
            .suspects
            .iter()
            .find(|s| (s.station, Some(s.waterline)) == (change.station, change.origin.waterline()))
            .unwrap();
        assert!(page.contains(&format!("{} station", suspect.id)), "{page}");
    }
    let listed = outputs.certificate["excluded"].as_array().unwrap();
    assert_eq!(listed.len(), excluded.len());
    let (_, kept) = faired(&table, &[("--keep-suspects", "suspects.exclude", "false")]);
    assert!(kept.outcome.changes.iter().all(|change| !change.suspect));
}

/// Wigley's half-breadths of a hull of 100 m, the stations written by `name`.
pub(crate) fn wigley_table(name: impl Fn(f64) -> String) -> String {
    let heights: Vec<f64> = (0..=8).map(|k| 0.75 * f64::from(k)).collect();
    let mut text = format!("station,{}\n", heights.iter().map(|z| format!("{z}")).collect::<Vec<_>>().join(","));
    for station in 0..=20 {
        let t = f64::from(station) / 10.0 - 1.0;
        let at = |z: &f64| format!("{:.4}", 5.0 * (1.0 - t * t) * (1.0 - (1.0 - z / 6.0).powi(2)));
        let row: Vec<String> = heights.iter().map(at).collect();
        text.push_str(&format!("{},{}\n", name(f64::from(station)), row.join(",")));
    }
    text
}
