//! The command `derive`: targets that are exact on random daughters, classical shifts, affine laws, refusals with numbers, files
//! that are the same each time.

use std::fs;

use loftsman::internals::config::{DeriveFile, read_derive_option};
use loftsman::internals::derivation::{Dimensions, Method, Quantity, Reference, Refusal, Request, derive, value_of};
use loftsman::internals::hydrostatics::{Conventions, CurvesOfForm};
use loftsman::internals::report::{DeriveJob, DeriveOutputs, Overrides, derive_files, derive_outputs, read_source};
use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};
use serde_json::Value;

use crate::cli::config;
use crate::support::{command, folder, json, names_in, program, stderr, stdout};

const PARENTS: [&str; 7] = ["bulk-carrier", "container-ship", "fishing-vessel", "frigate", "tug", "wigley", "yacht"];

/// A job on a design of `configs/` with options of the command.
fn job(parent: &str, options: &[(&str, &str, String)]) -> DeriveJob {
    let mut wanted = DeriveFile::default();
    for (option, key, value) in options {
        wanted = wanted.over(read_derive_option(option, key, value).unwrap());
    }
    let parent = config(&format!("{parent}.toml")).into();
    DeriveJob { parent, file: None, overrides: Overrides::default(), wanted, intervals: false }
}

#[track_caller]
fn derived(parent: &str, options: &[(&str, &str, String)]) -> DeriveOutputs {
    derive_outputs(&job(parent, options), &[]).unwrap_or_else(|failure| panic!("{parent} {options:?}: {failure}"))
}

fn error(achieved: f64, requested: f64) -> f64 {
    (achieved - requested).abs() / requested.abs()
}

/// Daughters at random: C_B within 0.04, LCB within 2 % of L_PP, dimensions within 15 %. Each meets its targets, or is
/// refused with numbers; a parent without inflections has a daughter without.
fn random_daughters(seed: u64, count: usize) -> [usize; 3] {
    let mut random = StdRng::seed_from_u64(seed);
    let (mut made, mut refused, mut more) = (0, 0, 0);
    for k in 0..count {
        let name = PARENTS[k % PARENTS.len()];
        let parent = read_source(config(&format!("{name}.toml")).as_ref()).unwrap();
        let p = *parent.hull.particulars();
        let reference = Reference::of(&parent.hull, &parent.conventions).unwrap();
        let mut by = |most: f64| random.random_range(-most..most);
        let (l, b) = (1.0 + by(0.15), 1.0 + by(0.15));
        let z = 1.0 + by(0.15);
        let block = value_of(Quantity::Volume, &parent.hull, &reference) / reference.volume() + by(0.04);
        let centre = value_of(Quantity::Lcb, &parent.hull, &reference) / reference.between - 0.5;
        // Within what a shift reaches on every parent: 2 % at most.
        let centre = 100.0 * centre + by(2.0);
        let request = Request {
            dimensions: Dimensions {
                length: Some(l * p.length_between_perpendiculars),
                breadth: Some(b * p.breadth),
                draught: p.draught.map(|t| z * t),
                depth: Some(z * p.depth),
            },
            block_coefficient: Some(block),
            lcb_percent: Some(centre),
            ..Request::default()
        };
        match derive(&parent.hull, &request, &parent.conventions, false) {
            Ok(daughter) => {
                made += 1;
                for reached in &daughter.targets {
                    let off = error(reached.achieved, reached.target.value);
                    assert!(off <= 1e-10, "{name} {request:?}: {:?} off by {off:e}", reached.target);
                }
                let [before, after] = daughter.inflections;
                println!("{name}: inflections {before} > {after}, {} programs", daughter.programs);
                more += usize::from(before == 0 && after > 0);
            }
            Err(refusals) => {
                refused += 1;
                for Refusal { code, message, remedy, .. } in refusals {
                    println!("{name}: {message}. {remedy}");
                    assert!(code == "E420" && message.contains(|c: char| c.is_ascii_digit()), "{message}");
                }
            }
        }
    }
    [made, refused, more]
}

#[test]
fn thirty_daughters_at_random_meet_their_targets() {
    let [made, refused, more] = random_daughters(30, 30);
    println!("{made} made, {refused} refused, {more} with an inflection that their parent has not");
    assert!(made >= 26 && more == 0, "{made} made, {refused} refused, {more} with more inflections");
}

#[test]
#[ignore = "takes 60 s"]
fn two_hundred_daughters_at_random_meet_their_targets() {
    let [made, refused, more] = random_daughters(200, 200);
    println!("{made} made, {refused} refused, {more} with an inflection that their parent has not");
    assert!(made >= 170 && more <= 4, "{made} made, {refused} refused, {more} with more inflections");
}

/// All quantities that are linear, then those that are not, each beside C_B, LCB and C_M, which are kept.
#[test]
fn every_target_is_met_beside_what_is_kept() {
    let tug = read_source(config("tug.toml").as_ref()).unwrap();
    let reference = Reference::of(&tug.hull, &tug.conventions).unwrap();
    let now = |quantity| value_of(quantity, &tug.hull, &reference);
    for (option, key, quantity, change) in [
        ("--cm", "Cm", Quantity::MidshipCoefficient, -0.02),
        ("--cwp", "Cwp", Quantity::WaterplaneCoefficient, 0.01),
        ("--kb", "KB", Quantity::Kb, 0.02),
        ("--km", "KM", Quantity::Km, 0.05),
        ("--wetted-surface", "wetted_surface", Quantity::WettedSurface, -1.0),
    ] {
        let wanted = now(quantity) + change;
        let outputs = derived("tug", &[(option, key, format!("{wanted}"))]);
        let row = CurvesOfForm::new(&outputs.derived.hull, &[reference.draught], &tug.conventions).rows.remove(0);
        let found = outputs.targets.iter().find(|target| target.key == quantity.key()).unwrap();
        assert!(error(found.achieved, wanted) <= 1e-10 && found.price.unwrap() * change > 0.0, "{key}: {found:?}");
        // What hydrostatics find by other rules.
        let own =
            [row.kb, row.km_transverse, Some(row.wetted_surface), row.midship_coefficient, row.waterplane_coefficient];
        assert!(own.iter().flatten().any(|value| error(*value, wanted) < 1e-8), "{key} {wanted}: {own:?}");
        for kept in outputs.targets.iter().filter(|target| target.origin == "kept") {
            assert!(error(kept.achieved, kept.scaled) <= 1e-10, "{key}: {kept:?}");
        }
        // Profiles, keel and deck stay.
        let (a, b) = (outputs.derived.scaled.surface(), outputs.derived.hull.surface());
        let [rows, columns] = a.shape();
        for k in 0..rows * columns {
            let (i, j) = (k / columns, k % columns);
            if i == 0 || j == 0 || i + 1 == rows || j + 1 == columns {
                assert!((a.points()[k][1] - b.points()[k][1]).abs() < 1e-12);
            }
        }
    }
}

/// Lackenby on Wigley's hull, whose curve of areas is a parabola: both targets are met, and |dphi| is below 1/6.
#[test]
fn classical_shifts_are_exact_and_fold_where_they_are_stated_to() {
    for (block, centre) in [(0.4744, "+1 %"), (0.46, "-1 %"), (0.43, "0 %")] {
        let options = [
            ("--cb", "Cb", format!("{block}")),
            ("--lcb", "LCB", centre.to_owned()),
            ("--method", "method", "lackenby".to_owned()),
        ];
        let outputs = derived("wigley", &options);
        assert_eq!(outputs.method, Method::Lackenby);
        for target in &outputs.targets {
            let size = if target.key == "XCB" { 100.0 } else { target.requested };
            assert!((target.achieved - target.requested).abs() <= 1e-10 * size, "{target:?}");
        }
        let [_, low, high] = outputs.derived.shift.unwrap();
        for (found, expected) in low.into_iter().chain(high).zip([-1.0, -1.0, 1.0, 1.0]) {
            assert!((found - expected / 6.0).abs() < 1e-3, "{found}");
        }
    }
    let prismatic =
        derived("bulk-carrier", &[("--cb", "Cb", "0.82".into()), ("--method", "method", "one-minus-prismatic".into())]);
    assert!(error(prismatic.targets[0].achieved, prismatic.targets[0].requested) <= 1e-10);
    let failure =
        derive_outputs(&job("wigley", &[("--cb", "Cb", "0.7".into()), ("--method", "method", "lackenby".into())]), &[]);
    let text = failure.err().unwrap().to_string();
    assert!(
        text.starts_with("E420 --cb sections pass each other before C_B 0.7000") && text.contains("+0.166"),
        "{text}"
    );
}

#[test]
fn affine_daughters_keep_their_coefficients() {
    let outputs = derived(
        "frigate",
        &[("--lpp", "Lpp", "120".into()), ("--beam", "B", "14".into()), ("--method", "method", "affine".into())],
    );
    let values = &outputs.comparison.values;
    let change = |key: &str| values.iter().find(|value| value.key == key).unwrap().change.unwrap();
    for key in ["CB", "CM", "CP", "CWP", "XCBPC", "KB", "T", "D"] {
        assert!(change(key).abs() < 1e-9, "{key} {}", change(key));
    }
}

fn run(arguments: &[&str]) -> (i32, String, String) {
    let output = program(&[&["derive"], arguments].concat());
    (output.status.code().unwrap(), stdout(&output), stderr(&output))
}

#[test]
fn what_is_infeasible_is_refused_with_numbers() {
    let folder = folder("refused");
    let out = folder.join("out").display().to_string();
    let tug = config("tug.toml");
    let cases: [(&[&str], i32, &[&str]); 9] = [
        (&["--cb", "1.2"], 2, &["E124 --cb", "is 1.2", "more than 0 and less than 1"]),
        (&["--cm", "-0.5"], 2, &["E124 --cm", "-0.5"]),
        (&["--lcb", "3"], 2, &["E122 --lcb", "+0.8 %"]),
        (&["--displacement", "9000 t"], 2, &["E421 --displacement", "C_B is", "less than 1"]),
        (&["--lcb", "60 %"], 2, &["E421 --lcb"]),
        (&["--cwp", "0.8", "--method", "lackenby"], 2, &["E422 --cwp", "--method nearest"]),
        (&["--cb", "0.6", "--displacement", "500"], 2, &["one target"]),
        (&["--cb", "0.9"], 4, &["E420 --cb", "C_B 0.9000 is out of reach", "Give C_B"]),
        (&["--depth", "3"], 4, &["E420 --depth", "3.000 m"]),
    ];
    for (options, code, words) in cases {
        let (exit, _, err) = run(&[&[tug.as_str()], options, &["-o", &out, "--no-figures"]].concat());
        assert_eq!(exit, code, "{options:?}: {err}");
        for word in words {
            assert!(err.contains(word), "{options:?}: {word} in {err}");
        }
        assert!(!folder.join("out").exists());
    }
}

/// What a refusal names as the nearest is met.
#[test]
fn the_nearest_value_of_a_refusal_is_feasible() {
    let refused = derive_outputs(&job("tug", &[("--cb", "Cb", "0.9".into())]), &[]).err().unwrap().to_string();
    let (_, nearest) = refused.split_once("Give C_B ").unwrap();
    let outputs = derived("tug", &[("--cb", "Cb", nearest[..6].to_owned())]);
    assert!(error(outputs.targets[0].achieved, outputs.targets[0].requested) <= 1e-10);
}

/// Sections that are alike amidships stay alike. Where targets leave them no room, and where a stated body is narrower, a warning
/// says so.
#[test]
fn the_parallel_body_of_the_parent_is_kept_or_its_loss_is_told() {
    let outputs = derived("bulk-carrier", &[("--cb", "Cb", "0.79".into())]);
    let [Some(scaled), Some(own)] = outputs.middle_bodies else { panic!("{:?}", outputs.middle_bodies) };
    assert!(own[1] - own[0] > 0.9 * (scaled[1] - scaled[0]), "{scaled:?} {own:?}");
    assert!(!outputs.warnings.iter().any(|warning| warning.starts_with("W423")), "{:?}", outputs.warnings);
    // Below T the half-breadths are one along the body.
    let hull = &outputs.derived.hull;
    let (aft, fore) = (own[0] + 0.2 * (own[1] - own[0]), own[1] - 0.2 * (own[1] - own[0]));
    for z in [0.5, 2.0, 6.0] {
        let [a, b] = [aft, fore].map(|x| hull.half_breadth(x, z).unwrap());
        assert!((a - b).abs() < 1e-9, "{z}: {a} {b}");
    }
    let lost = derived("bulk-carrier", &[("--entrance", "entrance", "20".into())]);
    assert!(lost.warnings.iter().any(|warning| warning.starts_with("W423")), "{:?}", lost.warnings);
    let narrow = derived("tug", &[("--parallel-body", "parallel_body", "12,16".into())]);
    assert!(narrow.warnings.iter().any(|warning| warning.starts_with("W422")), "{:?}", narrow.warnings);
}

/// What the interval of the wetted surface excludes was no limit: the parent has it.
#[test]
fn limits_of_the_wetted_surface_hold_the_parent() {
    let refused =
        derive_outputs(&job("wigley", &[("--wetted-surface", "wetted_surface", "1400".into())]), &[]).err().unwrap();
    let refused = refused.to_string();
    let low = refused.split("out of reach: ").nth(1).unwrap().split(' ').next().unwrap();
    let low: f64 = low.parse().unwrap();
    // Wigley's hull of 100 x 10 x 6.25 m has 1487.9 m2.
    assert!((1400.0..1488.0).contains(&low), "{refused}");
}

/// Another depth leaves displacement and LCB as they are, to rounding.
#[test]
fn what_is_kept_is_that_of_the_parent() {
    let outputs = derived("box", &[("--depth", "D", "7".into())]);
    assert!(outputs.targets.iter().all(|target| error(target.achieved, target.requested) < 1e-10));
}

/// Far from the parent the targets are met, and that lines are no longer fair is a warning and the exit code.
#[test]
fn more_inflections_are_a_warning() {
    let folder = folder("warned");
    let out = folder.join("out").display().to_string();
    let (code, _, err) = run(&[&config("tug.toml"), "--cb", "0.66", "--no-figures", "-q", "-o", &out]);
    assert!(code == 5 && err.contains("E505 the targets are met"), "{err}");
    let written: Value = json(folder.read("out/derive.json"));
    let [before, after] = ["scaled_parent", "daughter"].map(|key| written["inflections"][key].as_u64().unwrap());
    assert!(after > before && err.starts_with("W420 ") && err.contains(&format!("has {after} inflections")), "{err}");
}

#[test]
fn a_job_file_gives_what_options_give() {
    let folder = folder("files");
    let tug = config("tug.toml");
    let job = format!("[derive]\nparent = {:?}\nLpp = 30\nCb = 0.54\nLCB = \"-0.5 %\"\nCwp = 0.76\n", tug);
    let job = folder.write("job.toml", job);
    let outs = ["a", "b", "c"].map(|name| folder.join(name).display().to_string());
    let (code, page, err) =
        run(&[&tug, "--lpp", "30", "--cb", "0.54", "--lcb", "-0.5 %", "--cwp", "0.76", "-o", &outs[0]]);
    assert_eq!(code, 0, "{err}");
    assert!(page.lines().all(|line| line.chars().count() <= 80), "{page}");
    for word in
        ["derived by nearest", "requested", "given", "kept", "Inflections", "Moved from the scaled parent", "change"]
    {
        assert!(page.contains(word), "{word} in {page}");
    }
    for out in [&outs[1], &outs[2]] {
        let (code, _, err) = run(&[&job, "-o", out, "-q"]);
        assert_eq!(code, 0, "{err}");
    }
    let names = names_in(&outs[0]);
    for name in [
        "hull.json",
        "offsets.csv",
        "hydrostatics.csv",
        "report.md",
        "derive.json",
        "compare.md",
        "lines.png",
        "compared-body-plans.png",
    ] {
        assert!(names.iter().any(|found| found == name), "{name} in {names:?}");
    }
    assert_eq!(names, names_in(&outs[1]));
    let same = |a: &str, b: &str, name: &str| {
        fs::read(folder.join(a).join(name)).unwrap() == fs::read(folder.join(b).join(name)).unwrap()
    };
    assert!(names.iter().all(|name| same("b", "c", name)));
    assert!(same("a", "b", "hull.json") && same("a", "b", "derive.json") && !same("a", "b", "manifest.json"));
    let written: Value = json(folder.read("a/derive.json"));
    assert_eq!((&written["method"], &written["targets"][0]["origin"]), (&"nearest".into(), &"given".into()));
    // The hull is read again as what it is.
    let hull = read_source(folder.join("a").as_ref()).unwrap().hull;
    let reference = Reference::of(&hull, &Conventions::default()).unwrap();
    let block = value_of(Quantity::Volume, &hull, &reference) / (30.0 * reference.breadth * reference.draught);
    assert!((block - 0.54).abs() < 0.03, "{block}");
    let missing = folder.write("none.toml", "[derive]\nCb = 0.5\n");
    let (code, _, err) = run(&[&missing, "-o", &outs[2]]);
    assert!(code == 3 && err.contains("E125") && err.contains("derive.parent is missing"), "{err}");
}

#[test]
fn limits_are_printed_where_they_are_asked_for() {
    let folder = folder("limits");
    let out = folder.join("out").display().to_string();
    let (code, page, err) = run(&[&config("tug.toml"), "--cb", "0.53", "--limits", "--no-figures", "-o", &out]);
    assert_eq!(code, 0, "{err}");
    assert!(page.matches(" can be ").count() == 3, "{page}");
    let written: Value = json(folder.read("out/derive.json"));
    for target in written["targets"].as_array().unwrap() {
        let [low, high] = [0, 1].map(|k| target["interval"][k].as_f64().unwrap());
        let achieved = target["achieved"].as_f64().unwrap();
        assert!(low <= achieved * (1.0 + 1e-9) && achieved <= high * (1.0 + 1e-9), "{target}");
    }
}

/// Limits alone need no folder: nothing is written where none is named.
#[test]
fn limits_alone_write_nothing() {
    let folder = folder("limits-alone");
    for arguments in [
        &["derive", "catalogue:wigley", "--cb", "0.45", "--limits"][..],
        &["blend", "catalogue:wigley", "catalogue:wigley-i", "--cb", "0.5", "--limits"],
    ] {
        let output = command(arguments).current_dir(folder.join("")).output().unwrap();
        assert!(output.status.success() && stdout(&output).contains(" can be "), "{}", stderr(&output));
    }
    assert!(names_in(folder.join("")).is_empty());
}

/// LCB and LCF without a volume that is held are ratios: no vertex is left where another one has more.
#[test]
fn ends_of_ratios_are_ends() {
    let tug = read_source(config("tug.toml").as_ref()).unwrap();
    let reference = Reference::of(&tug.hull, &tug.conventions).unwrap();
    let lcf = value_of(Quantity::Lcf, &tug.hull, &reference);
    let request = |value: f64| Request {
        targets: vec![(Quantity::Lcf, value)],
        free: vec![Quantity::Volume, Quantity::Lcb, Quantity::MidshipCoefficient],
        ..Request::default()
    };
    let found = derive(&tug.hull, &request(lcf), &tug.conventions, true).unwrap();
    let interval =
        found.targets.iter().find(|target| target.target.quantity == Quantity::Lcf).unwrap().interval.unwrap();
    assert!(interval.low < lcf - 0.5 && interval.high > lcf + 0.5, "{interval:?}");
    for (inside, outside) in [(0.001, -0.02), (0.999, 1.02)] {
        let at = |part: f64| interval.low + part * (interval.high - interval.low);
        assert!(derive(&tug.hull, &request(at(inside)), &tug.conventions, false).is_ok(), "{interval:?} {inside}");
        // Beyond it the signs of curvature go, if they were kept inside.
        let beyond = derive(&tug.hull, &request(at(outside)), &tug.conventions, false);
        assert!(!beyond.is_ok_and(|derived| derived.keeps_signs), "{interval:?} {outside}");
    }
}

/// A heavier weight of the wave resistance lowers it and costs bending; targets stay exact, and R_W is that of the daughter.
#[test]
fn the_wave_resistance_falls_as_its_weight_rises() {
    let options = [("--wave-resistance", "wave_resistance", "0.30:0.34:0.02".to_owned())];
    let outputs = derived("wigley", &options);
    let waves = outputs.derived.waves.as_ref().unwrap();
    assert_eq!((waves.trades.len(), waves.froude_numbers.len()), (7, 3));
    for pair in waves.trades.windows(2) {
        assert!(pair[1].ratio < pair[0].ratio + 1e-9 && pair[1].energy > pair[0].energy - 1e-12, "{pair:?}");
        // Each is the least of J + w R of its own weight.
        for (this, other) in [(pair[0], pair[1]), (pair[1], pair[0])] {
            let sum = |trade: loftsman::internals::resistance::WaveTrade| trade.energy + this.weight * trade.ratio;
            assert!(sum(this) <= sum(other) * (1.0 + 1e-9), "{pair:?}");
        }
    }
    let taken = waves.trades[waves.taken];
    let mean = waves.after.iter().zip(&waves.before).map(|(a, b)| a / b).sum::<f64>() / 3.0;
    assert!((mean - taken.ratio).abs() < 1e-4 && mean < 0.97, "{mean} {taken:?}");
    for target in &outputs.targets {
        assert!(error(target.achieved, target.requested) < 1e-10, "{target:?}");
    }
    assert!(outputs.inflections[1] <= outputs.inflections[0] + 2, "{:?}", outputs.inflections);
    // The weights are drawn.
    let files = derive_files(&job("wigley", &options), &outputs, true).unwrap();
    let drawn = |name: &str| files.iter().find(|file| file.name == name).map(|file| file.contents.clone());
    let svg = String::from_utf8(drawn("wave-trade.svg").unwrap()).unwrap();
    assert!(svg.contains("knee: w = ") && drawn("wave-trade.png").unwrap().len() > 10_000);
    assert!(String::from_utf8(drawn("report.md").unwrap()).unwrap().contains("wave-trade.png"));
}

/// With raked ends the form is a sum over waterlines; half-breadths stay within what `--within` states.
#[test]
fn the_wave_resistance_of_a_raked_hull_falls_within_a_tolerance() {
    let options = [
        ("--wave-resistance", "wave_resistance", "0.28".to_owned()),
        ("--wave-weight", "wave_weight", "30000".to_owned()),
        ("--within", "within", "40 mm".to_owned()),
    ];
    let outputs = derived("container-ship", &options);
    let waves = outputs.derived.waves.as_ref().unwrap();
    assert!(waves.after[0] < 0.999 * waves.before[0], "{waves:?}");
    let points = |hull: &loftsman::internals::hull::Hull| hull.surface().points().to_vec();
    let (before, after) = (points(&outputs.derived.scaled), points(&outputs.derived.hull));
    let largest = before.iter().zip(&after).map(|(a, b)| (a[1] - b[1]).abs()).fold(0.0, f64::max);
    assert!(largest < 0.040_01 && largest > 0.001, "{largest}");
}

#[test]
fn a_wave_resistance_needs_the_nearest_hull_and_level_waterlines() {
    let parent = config("wigley.toml");
    let out = folder("derive-waves").join("out").display().to_string();
    for (options, code) in [
        (vec!["--wave-resistance", "0.3", "--method", "lackenby"], "E422"),
        (vec!["--wave-resistance", "3:5:1"], "E124"),
        (vec!["--wave-resistance", "0.3", "--wave-weight", "-1"], "E124"),
    ] {
        let (status, page, message) = run(&[&[&*parent], &options[..], &["-o", &out]].concat());
        assert!(status == 2 && message.contains(code), "{options:?} {status} {page} {message}");
    }
    let page = stdout(&program(&["explain", "E425"]));
    assert!(page.contains("quadratic form"), "{page}");
}
