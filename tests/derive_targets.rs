//! Targets of `derive` beyond coefficients: areas of sections, parallel body, half angles, GM; and what its prices are.

use loftsman::internals::config::{DeriveFile, read_derive_option};
use loftsman::internals::derivation::{Quantity, Reference, value_of};
use loftsman::internals::hull::{Functional, Hull};
use loftsman::internals::report::{DeriveJob, DeriveOutputs, Overrides, derive_outputs};

use crate::cli::config;
use crate::support::{folder, program, stderr, stdout};

fn job(parent: &str, options: &[(&str, &str)]) -> DeriveJob {
    let mut wanted = DeriveFile::default();
    for (key, value) in options {
        wanted = wanted.over(read_derive_option(key, key, value).unwrap());
    }
    let parent = config(&format!("{parent}.toml")).into();
    DeriveJob { parent, file: None, overrides: Overrides::default(), wanted, intervals: false }
}

#[track_caller]
fn derived(parent: &str, options: &[(&str, &str)]) -> DeriveOutputs {
    derive_outputs(&job(parent, options), &[]).unwrap_or_else(|failure| panic!("{parent} {options:?}: {failure}"))
}

fn run(arguments: &[&str]) -> (i32, String, String) {
    let output = program(&[&["derive"], arguments].concat());
    (output.status.code().unwrap(), stdout(&output), stderr(&output))
}

/// The curve of areas of a hidden daughter: its areas are met, its volume and LCB follow, whatever gives the curve.
#[test]
fn a_curve_of_areas_is_met() {
    let hidden = derived("tug", &[("Cb", "0.55"), ("LCB", "-1 %")]);
    let (hull, draught) = (&hidden.derived.hull, hidden.derived.reference.draught);
    let area_at = |hull: &Hull, x: f64| Functional::SectionArea { x }.value(hull, draught);
    let areas: Vec<[f64; 2]> = (1..14).map(|k| 2.0 * f64::from(k)).map(|x| [x, area_at(hull, x)]).collect();
    let mut wanted = job("tug", &[]);
    wanted.wanted.section_areas = areas.clone();
    let found = derive_outputs(&wanted, &[]).unwrap();
    assert_eq!(found.targets.len(), areas.len());
    for (target, [x, area]) in found.targets.iter().zip(&areas) {
        assert_eq!(target.key, format!("A@{x:.3}"));
        let own = area_at(&found.derived.hull, *x);
        assert!((own / area - 1.0).abs() < 1e-10 && (target.achieved / own - 1.0).abs() < 1e-12, "{target:?}");
    }
    let reference = Reference::of(hull, &hidden.comparison.conventions).unwrap();
    for (quantity, off) in [(Quantity::Volume, 2e-3), (Quantity::Lcb, 2e-3)] {
        let [a, b] = [hull, &found.derived.hull].map(|hull| value_of(quantity, hull, &reference));
        assert!((b / a - 1.0).abs() < off, "{quantity:?} {a} {b}");
    }
    // The same from a file.
    let folder = folder("areas");
    let rows: String = areas.iter().map(|[x, area]| format!("{x},{area}\n")).collect();
    let file = folder.write("areas.csv", format!("x,area\n{rows}"));
    let out = folder.join("out").display().to_string();
    let (code, page, err) = run(&[&config("tug.toml"), "--section-areas", &file, "-o", &out, "--no-figures"]);
    assert!(code == 0 && page.contains("A@14.000"), "{err}{page}");
    assert!(folder.read("out/manifest.json").contains("areas.csv"));
}

#[test]
fn areas_that_no_section_has_are_refused_with_numbers() {
    let out = folder("no-areas").join("out").display().to_string();
    let folder = folder("areas-refused");
    for (rows, status, words) in [
        ("10,9\n40,9\n", 2, ["E421 --section-areas", "40.000 m"]),
        ("10,9\n14,900\n", 2, ["E421 --section-areas", "900"]),
        // C_M of 0.88 says what the area at midship is.
        ("14,31.5\n", 4, ["E420 --section-areas A@14.000 31.500 m2 is out of reach: 28.5", "C_M 0.8800"]),
    ] {
        let file = folder.write("areas.csv", format!("x,area\n{rows}"));
        let (code, _, err) =
            run(&[&config("tug.toml"), "--section-areas", &file, "--cm", "0.88", "-o", &out, "--no-figures"]);
        assert!(code == status && words.iter().all(|word| err.contains(word)), "{code} {err}");
    }
}

/// Sections are alike from end to end, the targets that are kept are kept.
#[test]
fn a_parallel_body_reaches_from_end_to_end() {
    let outputs = derived("wigley", &[("parallel_body", "45,55")]);
    let hull = &outputs.derived.hull;
    for z in [0.3, 2.0, 4.0, 6.2] {
        let at = |x: f64| hull.half_breadth(x, z).unwrap();
        for x in [45.0, 47.3, 52.9, 55.0] {
            assert!((at(x) - at(50.0)).abs() < 1e-9, "{x} {z}: {} {}", at(x), at(50.0));
        }
        assert!(at(60.0) < at(55.0) - 1e-6 && at(40.0) < at(45.0) - 1e-6, "{z}");
    }
    for target in &outputs.targets {
        assert!((target.achieved / target.requested - 1.0).abs() < 1e-10, "{target:?}");
    }
    assert_eq!(outputs.inflections, [0, 0]);
    // C_P of 2/3 leaves no ends to a body of nine tenths of the length.
    let refused = derive_outputs(&job("wigley", &[("parallel_body", "5,95")]), &[]).err().unwrap().to_string();
    assert!(refused.starts_with("E420 --parallel-body") && refused.contains("longest about its middle"), "{refused}");
}

/// Angles by other rules of hydrostatics, and GM as KM less KG.
#[test]
fn angles_and_metacentric_heights_are_met() {
    let parent = derived("wigley", &[]);
    let row = &parent.outputs.design_row;
    let [entrance, run] = [row.half_angle_of_entrance.unwrap(), row.half_angle_of_run.unwrap()];
    let [entrance, run] = [entrance - 1.0, run + 0.7].map(|angle| format!("{angle}"));
    let outputs = derived("wigley", &[("entrance", &entrance), ("run", &run)]);
    let row = &outputs.outputs.design_row;
    for (found, wanted) in [(row.half_angle_of_entrance, &entrance), (row.half_angle_of_run, &run)] {
        let wanted: f64 = wanted.parse().unwrap();
        assert!((found.unwrap() / wanted - 1.0).abs() < 1e-9, "{found:?} {wanted}");
    }
    for target in &outputs.targets {
        assert!((target.achieved / target.requested - 1.0).abs() < 1e-10, "{target:?}");
    }
    let tug = derived("tug", &[("GM", "1.35"), ("KG", "3 m")]);
    let found = tug.outputs.design_row.km_transverse.unwrap();
    assert!((found - 4.35).abs() < 1e-9, "{found}");
    assert_eq!(tug.stability, Some([1.35, 3.0]));
    let alone = derive_outputs(&job("tug", &[("GM", "1.35")]), &[]).err().unwrap().to_string();
    assert!(alone.contains("--kg"), "{alone}");
    let unlike = derive_outputs(&job("tug", &[("GM", "9"), ("KG", "3 m")]), &[]).err().unwrap().to_string();
    assert!(unlike.contains("--gm"), "{unlike}");
}

/// A bilge of radius r under level bottom and plumb sides leaves (2 - pi/2) r^2 of B T; one that does not fit is refused.
#[test]
fn a_bilge_radius_stands_for_a_midship_coefficient() {
    let outputs = derived("tug", &[("bilge_radius", "2.9 m")]);
    let row = &outputs.outputs.design_row;
    let particulars = outputs.derived.hull.particulars();
    let box_area = particulars.breadth * particulars.draught.unwrap();
    let radius = ((1.0 - row.midship_coefficient.unwrap()) * box_area / (2.0 - std::f64::consts::FRAC_PI_2)).sqrt();
    assert!((radius - 2.9).abs() < 1e-9, "{radius}");
    let refused = |entries: &[(&str, &str)]| derive_outputs(&job("tug", entries), &[]).err().unwrap().to_string();
    let wide = refused(&[("bilge_radius", "3.7 m")]);
    assert!(wide.contains("--bilge-radius") && wide.contains("at most 3.600 m"), "{wide}");
    let sharp = refused(&[("bilge_radius", "0.3 m")]);
    let (_, rest) = sharp.split_once("E420 --bilge-radius bilge radius 0.300 m is out of reach: ").unwrap();
    let (low, rest) = rest.split_once(" m to ").unwrap();
    let (high, _) = rest.split_once(" m with C_B").unwrap();
    let [low, high] = [low, high].map(|end| end.parse::<f64>().unwrap());
    assert!(low > 0.3 && high > low && high <= 3.6, "{sharp}");
    // What it names as the nearest is met.
    let (_, nearest) = sharp.split_once("Give bilge radius ").unwrap();
    let (nearest, _) = nearest.split_once(',').unwrap();
    let daughter = derived("tug", &[("bilge_radius", nearest)]);
    let midship = daughter.targets.iter().find(|target| target.key == "CM").unwrap();
    assert!((midship.achieved / midship.requested - 1.0).abs() < 1e-10, "{nearest} {midship:?}");
}

/// What lies at a height, or a position, comes to another one, and the targets are met all the same.
#[test]
fn lines_are_moved_to_where_they_are_wanted() {
    let plain = derived("tug", &[]);
    let [_, columns] = plain.derived.scaled.surface().shape();
    let height = |outputs: &DeriveOutputs, j: usize| outputs.derived.scaled.surface().point(0, j)[2];
    let line = (0..columns).rev().find(|&j| height(&plain, j) < 4.4).unwrap();
    let (from, to) = (height(&plain, line), height(&plain, line) + 0.07);
    let aft = plain.derived.scaled.surface().points().iter().map(|p| p[0]).fold(f64::INFINITY, f64::min);
    let moved = [("move_height", format!("{from} m : {to} m")), ("move_position", format!("{aft}:{}", aft - 0.4))];
    let moved: Vec<(&str, &str)> = moved.iter().map(|(key, value)| (*key, value.as_str())).collect();
    let outputs = derived("tug", &moved);
    assert!((height(&outputs, line) - to).abs() < 1e-12);
    let now = outputs.derived.hull.surface().points().iter().map(|p| p[0]).fold(f64::INFINITY, f64::min);
    assert!((now - aft + 0.4).abs() < 1e-12, "{now} {aft}");
    for target in &outputs.targets {
        assert!((target.achieved / target.requested - 1.0).abs() < 1e-10, "{target:?}");
    }
    let folded = derive_outputs(&job("tug", &[("move_height", "4.2:5.2")]), &[]).err().unwrap().to_string();
    assert!(folded.contains("E420 --move-height") && folded.contains("Give "), "{folded}");
}

/// The price of a target is the derivative of the bending by it, with its sign; the gap is that of the optimum itself.
#[test]
fn prices_are_derivatives_with_their_signs() {
    let parent = derived("tug", &[]);
    let reference = Reference::of(&parent.derived.hull, &parent.comparison.conventions).unwrap();
    let now = value_of(Quantity::WaterplaneCoefficient, &parent.derived.hull, &reference);
    for change in [0.012, -0.012] {
        let at = |part: f64| {
            let value = (now + change) * (1.0 + part);
            derived("tug", &[("Cwp", &format!("{value}"))])
        };
        let middle = at(0.0);
        let step = 2e-4;
        let slope = (at(step).derived.energy - at(-step).derived.energy) / (2.0 * step);
        let target = middle.targets.iter().find(|target| target.key == "CWP").unwrap();
        let price = target.price.unwrap();
        println!("{change}: {price} {slope}, gap {:e}, {:?}", middle.derived.gap, middle.derived.binding);
        assert!(price * change > 0.0 && (price / slope - 1.0).abs() < 0.02, "{price} {slope}");
        assert!(middle.derived.gap < 1e-5, "{:e}", middle.derived.gap);
        for limits in &middle.derived.binding {
            assert!(limits.count > 0 && limits.price <= 0.0, "{limits:?}");
        }
    }
}

/// The tolerance has a price: a little more of it lowers the optimum by so much.
#[test]
fn the_price_of_a_tolerance_is_a_derivative() {
    let at = |within: f64| {
        let within = format!("{within}");
        let options = [("wave_resistance", "0.28"), ("wave_weight", "30"), ("within", within.as_str())];
        let outputs = derived("wigley", &options);
        let waves = outputs.derived.waves.clone().unwrap();
        let trade = waves.trades[waves.taken];
        let found = outputs.derived.binding.iter().find(|limits| limits.kind == "within").copied();
        (trade.energy + 30.0 * trade.ratio, found)
    };
    let (step, within) = (1e-6, 0.001);
    let slope = (at(within + step).0 - at(within - step).0) / (2.0 * step);
    let (_, found) = at(within);
    let found = found.unwrap();
    assert!(found.count > 0 && (found.price / slope - 1.0).abs() < 0.02, "{found:?} {slope}");
}

/// The sections of the yacht of PDSTRIP hang from a keel with rocker: its waterlines are no lines of the net.
#[test]
fn the_wave_resistance_of_a_rockered_hull_is_refused() {
    let out = folder("derive-rocker").join("out").display().to_string();
    let (status, _, message) =
        run(&["catalogue:pdstrip-yacht", "--wave-resistance", "0.3", "-o", &out, "--no-figures"]);
    assert!(status == 2 && message.contains("E425 --wave-resistance") && message.contains("not lines"), "{message}");
}
