//! The command `blend`: weights that are given or follow from targets, half-breadths between those of the hulls, refusals with
//! numbers, and files that are the same each time.

use std::fs;

use loftsman::internals::derivation::{
    Blend, BlendRequest, Dimension, Dimensions, Method, Quantity, Reference, Request, blend, derive, scaled, value_of,
};
use loftsman::internals::hull::Hull;
use loftsman::internals::hydrostatics::Conventions;
use loftsman::internals::report::read_source;
use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};

use crate::cli::config;
use crate::support::{folder, json, names_in, program, stderr, stdout};

fn design(name: &str) -> Hull {
    read_source(config(&format!("{name}.toml")).as_ref()).unwrap().hull
}

/// A daughter of a design on its own chart.
fn daughter(name: &str, targets: &[(Quantity, f64)]) -> Hull {
    let request = Request {
        targets: targets.to_vec(),
        free: vec![Quantity::Lcb, Quantity::MidshipCoefficient],
        method: Method::Nearest,
        ..Request::default()
    };
    derive(&design(name), &request, &Conventions::default(), false).unwrap().hull
}

fn of(quantity: Quantity, hull: &Hull) -> f64 {
    value_of(quantity, hull, &Reference::of(hull, &Conventions::default()).unwrap())
}

fn blended(hulls: &[Hull], request: &BlendRequest) -> Blend {
    blend(hulls, request, &Conventions::default(), false).unwrap_or_else(|refusals| panic!("{refusals:?}"))
}

fn with_weights(weights: &[f64]) -> BlendRequest {
    BlendRequest { weights: Some(weights.to_vec()), ..BlendRequest::default() }
}

/// On one chart volume, moments and areas are the sums of those of the hulls with the weights, and half-breadths lie between
/// theirs.
#[test]
fn on_one_profile_volumes_moments_and_areas_are_linear() {
    let (a, b) = (design("wigley"), daughter("wigley", &[(Quantity::Volume, 2900.0)]));
    let half = blended(&[a.clone(), b.clone()], &with_weights(&[0.3, 0.7]));
    assert!(half.is_linear);
    let mixed = |value: &dyn Fn(&Hull) -> f64| 0.3 * value(&a) + 0.7 * value(&b);
    let moment = |hull: &Hull| of(Quantity::Lcb, hull) * of(Quantity::Volume, hull);
    for (name, found, expected) in [
        ("V", of(Quantity::Volume, &half.hull), mixed(&|h| of(Quantity::Volume, h))),
        ("M", moment(&half.hull), mixed(&moment)),
        ("C_WP", of(Quantity::WaterplaneCoefficient, &half.hull), mixed(&|h| of(Quantity::WaterplaneCoefficient, h))),
        ("C_M", of(Quantity::MidshipCoefficient, &half.hull), mixed(&|h| of(Quantity::MidshipCoefficient, h))),
    ] {
        // The daughter stands on a chart of its own, and is refitted.
        assert!((found / expected - 1.0).abs() < 1e-7, "{name} {found} {expected}");
    }
    for x in [3.0, 20.0, 47.0, 81.0, 96.5] {
        for z in [0.4, 2.0, 4.4, 6.1] {
            let [y, a, b] = [&half.hull, &a, &b].map(|hull| hull.half_breadth(x, z).unwrap());
            assert!(y > a.min(b) - 1e-9 && y < a.max(b) + 1e-9, "x {x} z {z}: {a} {y} {b}");
        }
    }
}

/// A hull with all of the weight is itself: the base exactly, another one within what the page states.
#[test]
fn all_of_the_weight_gives_the_hull() {
    let hulls = [design("frigate"), design("container-ship")];
    let alone = blended(&hulls, &with_weights(&[1.0, 0.0]));
    let other = blended(&hulls, &with_weights(&[0.0, 1.0]));
    for (blend, which) in [(&alone, 0), (&other, 1)] {
        let parent = &blend.parents[which];
        assert!(parent.error < 1e-5 * 142.0, "{}", parent.error);
        let away = loftsman::internals::hull::surface_distance(&blend.hull, &parent.scaled).unwrap();
        assert!(away.largest < 2.0 * parent.error + 1e-9, "{} {}", away.largest, parent.error);
    }
    assert!(alone.parents[alone.base].error == 0.0);
}

/// Blends of three designs at random: volume and LCB of a convex combination are met to 1e-10 by other weights or the same.
#[test]
fn targets_within_reach_are_met_to_rounding() {
    let mut random = StdRng::seed_from_u64(11);
    for names in [["container-ship", "frigate", "tug"], ["bulk-carrier", "container-ship", "fishing-vessel"]] {
        let hulls = names.map(design);
        let mut weights = [(); 3].map(|()| random.random_range(0.1..1.0));
        let total: f64 = weights.iter().sum();
        weights.iter_mut().for_each(|w| *w /= total);
        let goal = blended(&hulls, &with_weights(&weights));
        let [volume, lcb] = [Quantity::Volume, Quantity::Lcb].map(|quantity| of(quantity, &goal.hull));
        let targets = vec![(Quantity::Volume, volume), (Quantity::Lcb, lcb)];
        let found = blended(&hulls, &BlendRequest { targets, ..BlendRequest::default() });
        let weights_found: Vec<f64> = found.parents.iter().map(|parent| parent.weight).collect();
        assert!((weights_found.iter().sum::<f64>() - 1.0).abs() < 1e-12, "{weights_found:?}");
        assert!(weights_found.iter().all(|w| *w >= 0.0));
        for target in &found.targets {
            assert!((target.achieved / target.target.value - 1.0).abs() < 1e-10, "{names:?} {target:?}");
        }
        let most = found.parents.iter().map(|parent| parent.inflections).max().unwrap();
        assert!(found.inflections <= most + most / 2 + 2, "{names:?} {} {most}", found.inflections);
    }
}

/// With the breadth free two hulls meet two targets; C_B is that of the breadth that results.
#[test]
fn a_free_dimension_meets_one_more_target() {
    let hulls = [design("wigley"), daughter("wigley", &[(Quantity::Volume, 2900.0)])];
    let request = BlendRequest {
        block_coefficient: Some(0.452),
        targets: vec![(Quantity::WettedSurface, 1530.0)],
        free: vec![Dimension::Breadth],
        ..BlendRequest::default()
    };
    let found = blended(&hulls, &request);
    assert!((found.hull.particulars().breadth - 10.0).abs() > 0.01);
    let reference = Reference::of(&found.hull, &Conventions::default()).unwrap();
    let block = value_of(Quantity::Volume, &found.hull, &reference) / reference.volume();
    assert!((block - 0.452).abs() < 1e-10 && (of(Quantity::WettedSurface, &found.hull) / 1530.0 - 1.0).abs() < 1e-10);
}

/// Hulls of other dimensions are brought to those that are named.
#[test]
fn dimensions_are_common() {
    let dimensions = Dimensions { length: Some(60.0), breadth: Some(11.0), draught: Some(4.0), depth: Some(6.0) };
    let hulls = [design("tug"), design("fishing-vessel")];
    let found = blended(&hulls, &BlendRequest { dimensions, ..with_weights(&[0.5, 0.5]) });
    let p = found.hull.particulars();
    assert_eq!((p.length_between_perpendiculars, p.breadth, p.draught, p.depth), (60.0, 11.0, Some(4.0), 6.0));
    for parent in &found.parents {
        assert_eq!(parent.scaled.particulars(), p);
    }
    assert_eq!(scaled(&hulls[0], &dimensions).unwrap().particulars(), p);
}

fn run(arguments: &[&str]) -> (i32, String, String) {
    let output = program(arguments);
    (output.status.code().unwrap(), stdout(&output), stderr(&output))
}

#[test]
fn what_cannot_be_blended_is_refused_with_numbers() {
    let (wigley, boxy) = (config("wigley.toml"), config("box.toml"));
    let out = folder("blend-refused").join("out").display().to_string();
    let refused = |hulls: &[&str], options: &[&str]| {
        let arguments: Vec<&str> = ["blend"].iter().chain(hulls).chain(options).copied().chain(["-o", &out]).collect();
        run(&arguments)
    };
    for (hulls, options, code, exit, words) in [
        (vec![&*wigley], vec!["--weights", "1"], "E423", 2, "1 hull is given"),
        (vec![&*wigley, &boxy], vec!["--weights", "0.5"], "E423", 2, "1 weights are given for 2 hulls"),
        (vec![&*wigley, &boxy], vec!["--weights", "0.5,0.6"], "E423", 2, "must sum to 1"),
        (vec![&*wigley, &boxy], vec!["--weights", "-0.5,1.5"], "E423", 2, "none may be negative"),
        (vec![&*wigley, &boxy], vec![], "E423", 2, "neither weights nor a target"),
        (vec![&*wigley, &boxy], vec!["--weights", "0.5,0.5", "--cb", "0.6"], "E423", 2, "targets or free"),
        (
            vec![&*wigley, &boxy],
            vec!["--cb", "0.6", "--lcb", "+1 %"],
            "E423",
            2,
            "2 hulls with 0 free dimensions meet 1",
        ),
        (vec![&*wigley, &boxy], vec!["--displacement", "9000000 t"], "E421", 2, "C_B"),
        (vec![&*wigley, &boxy], vec!["--cb", "0.6", "--beam", "11", "--free", "beam"], "E423", 2, "free and given"),
        (vec![&*wigley, &boxy], vec!["--km", "7"], "E420", 4, "can be"),
        (vec![&*wigley, &boxy], vec!["--cb", "0.3"], "E420", 4, "C_B can be 0.44445"),
    ] {
        let (status, page, message) = refused(&hulls, &options);
        assert!(
            status == exit && message.contains(code) && message.contains(words),
            "{options:?}: {status} {page} {message}"
        );
    }
}

/// The files are those of a hull, with the weights, and the same each time; the hull floats as `blend.json` states.
#[test]
fn the_files_of_a_blend() {
    let root = folder("blend-files");
    let (a, b) = (config("wigley.toml"), config("box.toml"));
    let blend = |name: &str| {
        let out = root.join(name);
        let path = out.display().to_string();
        let output = program(&["blend", &a, &b, "--cb", "0.6", "--limits", "--no-figures", "--json", "-o", &path]);
        assert!(output.status.success(), "{}", stderr(&output));
        (out, stdout(&output))
    };
    let ((first, printed), (second, again)) = (blend("first"), blend("second"));
    assert_eq!(printed, again);
    let found = names_in(&first);
    for name in ["hull.json", "offsets.csv", "blend.json", "compare.json", "report.md", "manifest.json", "summary.json"]
    {
        assert!(found.iter().any(|other| other == name), "{found:?}");
        assert_eq!(fs::read(first.join(name)).unwrap(), fs::read(second.join(name)).unwrap(), "{name}");
    }
    let record = json(fs::read(first.join("blend.json")).unwrap());
    let weights: Vec<f64> =
        record["hulls"].as_array().unwrap().iter().map(|hull| hull["weight"].as_f64().unwrap()).collect();
    // Both hulls come to L 100, B 10, T 6.25: the box to a C_B of 1, Wigley's hull has 4/9.
    assert!((weights[0] * 4.0 / 9.0 + weights[1] - 0.6).abs() < 1e-6, "{weights:?}");
    let interval = &record["targets"][0]["interval"];
    assert!((interval[0].as_f64().unwrap() / 2777.777 - 1.0).abs() < 1e-4, "{interval}");
    let (status, table, _) = run(&["hydro", &first.join("hull.json").display().to_string(), "--json"]);
    assert!(status == 0 && table.contains("DISPVOL"));
}

/// The ends of an interval are values of blends that meet the other targets, with the breadth free as well.
#[test]
fn the_ends_of_an_interval_are_feasible() {
    let hulls = [design("wigley"), daughter("wigley", &[(Quantity::Volume, 2900.0)])];
    let request = |km: f64| BlendRequest {
        targets: vec![(Quantity::Volume, 2850.0), (Quantity::Km, km)],
        free: vec![Dimension::Breadth],
        ..BlendRequest::default()
    };
    let conventions = Conventions::default();
    let first = blend(&hulls, &request(5.25), &conventions, true).unwrap();
    let interval =
        first.targets.iter().find(|target| target.target.quantity == Quantity::Km).unwrap().interval.unwrap();
    assert!(interval.high > interval.low + 1e-3, "{interval:?}");
    let inside = 1e-4 * (interval.high - interval.low);
    for km in [interval.low + inside, interval.high - inside] {
        let found =
            blend(&hulls, &request(km), &conventions, false).unwrap_or_else(|r| panic!("{km} {interval:?} {r:?}"));
        assert!(found.targets.iter().all(|t| (t.achieved / t.target.value - 1.0).abs() < 1e-10));
    }
}

/// A hull at its own draught, and what has no common chart.
#[test]
fn a_hull_has_its_own_draught_and_profiles_must_be_alike() {
    let folder = folder("own-draught");
    let out = folder.join("out").display().to_string();
    let wigley = config("wigley.toml");
    let with = |of: &str, more: &[&str]| {
        run(&[
            &["blend", &wigley, &wigley, "--weights", "0.5,0.5", "--of", of, "-o", &out, "--no-figures", "--force"],
            more,
        ]
        .concat())
    };
    // At 5 m the second hull is 5/6.25 as deep in the water: brought to T 6.25 it is another form.
    let (status, _, message) = with("2:T=5", &["-q"]);
    assert_eq!(status, 0, "{message}");
    let read = |key: &str| json(folder.read("out/summary.json"))["design"][key].as_f64().unwrap();
    let fuller = |t: f64| {
        // C_B of Wigley's sections up to the height t of T 6.25: 1 - c^2 from the keel, over t.
        let part = t / 6.25;
        2.0 / 3.0 * (1.0 - (1.0 - (1.0 - part).powi(3)) / (3.0 * part))
    };
    let expected = 0.5 * (4.0 / 9.0 + fuller(5.0));
    assert!((read("CB") - expected).abs() < 2e-5, "{} {expected}", read("CB"));
    for (of, words) in [("3:T=5", "hull 3"), ("2:T=50", "--of 2:T=50"), ("2:up=z", "up")] {
        let (status, _, message) = with(of, &[]);
        assert!((2..=3).contains(&status) && message.contains(words), "{of}: {status} {message}");
    }
    let (status, _, message) = with("2:draught=5", &[]);
    assert!(status == 2 && message.contains("waterline_spacing"), "{message}");
    let ellipsoid = config("ellipsoid.toml");
    let (status, _, message) = run(&["blend", &wigley, &ellipsoid, "--weights", "0.5,0.5", "-o", &out, "--force"]);
    assert!(status == 2 && message.contains("E424") && message.contains("have no common chart"), "{status} {message}");
}

/// The prelude blends what the command does.
#[test]
fn a_program_blends() {
    let hulls = [config("wigley.toml"), config("box.toml")];
    let half = loftsman::prelude::blend(&hulls, &[0.5, 0.5], &[("depth", "12")]);
    assert!(half.is_err(), "an unknown key is refused");
    let made = loftsman::prelude::blend(&hulls, &[], &[("Cb", "0.6")]).unwrap();
    let [a, b] = made.weights()[..] else { panic!() };
    assert!((a * 4.0 / 9.0 + b - 0.6).abs() < 1e-6, "{a} {b}");
    assert!((made.outputs.design_row.block_coefficient.unwrap() - 0.6).abs() < 1e-9);
}

/// Each code of this command is explained.
#[test]
fn codes_of_a_blend_are_explained() {
    for code in ["W421", "E424", "E423"] {
        let (status, page, _) = run(&["explain", code]);
        assert!(status == 0 && page.contains(code), "{code} {page}");
    }
}
