//! Fairing of single curves: known truth under noise, what is held exactly, what is refused with numbers, the command.

use loftsman::internals::fairing::curve::{
    CurvePoint, CurveSettings, CurveSuspect, FairStatus, InflectionWish, LineKind, contradictions, fair_curve,
};
use rand::SeedableRng;
use rand::rngs::StdRng;

use crate::support::{Folder, command, folder, json, normal, stderr, stdout, waterline};

fn points(curve: impl Fn(f64) -> f64, from: f64, to: f64, count: usize, sigma: f64, seed: u64) -> Vec<CurvePoint> {
    let mut random = StdRng::seed_from_u64(seed);
    (0..count)
        .map(|k| {
            let x = from + (to - from) * k as f64 / (count - 1) as f64;
            CurvePoint::new(x, curve(x) + sigma * normal(&mut random))
        })
        .collect()
}

/// Root mean square and largest error to the truth on 201 places.
fn error(curve: impl Fn(f64) -> f64, truth: impl Fn(f64) -> f64, from: f64, to: f64) -> (f64, f64) {
    let off: Vec<f64> =
        (0..=200).map(|k| from + (to - from) * f64::from(k) / 200.0).map(|x| (curve(x) - truth(x)).abs()).collect();
    ((off.iter().map(|e| e * e).sum::<f64>() / 201.0).sqrt(), off.iter().fold(0.0, |m, e| m.max(*e)))
}

#[test]
fn waterlines_come_back_with_their_inflections() {
    let shapes = [(1.0, 2.0, 0), (-8.0, 2.0, 1), (-9.0, -8.0, 2)];
    for sigma in [0.040, 0.002] {
        let (mut before, mut after, mut counts, mut worst, mut raw) = (0.0, 0.0, 0, 0.0_f64, 0);
        let clock = std::time::Instant::now();
        for seed in 0..30 {
            let (aft, forward, truth) = shapes[seed as usize % 3];
            let line = |x: f64| waterline(aft, forward, x);
            let given = points(line, 0.0, 100.0, 21, sigma, seed);
            let fair = fair_curve(&given, &CurveSettings::default()).unwrap();
            assert_eq!(fair.status, FairStatus::Optimal);
            assert!(fair.certificate.gap.abs() < 1e-7, "{:?}", fair.certificate);
            assert!(fair.certificate.max_violation < 1e-8, "{:?}", fair.certificate);
            assert!(fair.least.certified());
            assert!(
                fair.least.count <= fair.inflections[1].len() || fair.inflections[1].len() < fair.inflections[0].len()
            );
            before += error(|x| fair.batten.eval(x)[0], line, 0.0, 100.0).0 / 30.0;
            let now = error(|x| fair.curve.eval(x)[0], line, 0.0, 100.0);
            after += now.0 / 30.0;
            worst = worst.max(now.1);
            counts += usize::from(fair.inflections[1].len() == truth);
            raw += fair.inflections[0].len();
            if fair.inflections[1].len() != truth {
                println!(
                    "sigma {sigma} seed {seed}: truth {truth}, before {}, least {}, allowed {:?}, after {:?} price {:.2} refused {:?} est {:.4}",
                    fair.inflections[0].len(),
                    fair.least.count,
                    fair.allowed,
                    fair.inflections[1],
                    fair.price,
                    fair.refused,
                    fair.sigma
                );
            }
        }
        println!(
            "sigma {:.0} mm: RMS {:.2} -> {:.2} mm, worst {:.1} mm, right number {counts} of 30 (battens have {raw}), {:.1} ms each",
            1e3 * sigma,
            1e3 * before,
            1e3 * after,
            1e3 * worst,
            1e3 * clock.elapsed().as_secs_f64() / 30.0
        );
        assert!(after < 0.75 * before, "{before} {after}");
        assert!(counts >= 28, "{counts}");
    }
}

/// A corner that nobody declares, held by three locked points; points that jump and are held; every point held.
#[test]
fn locked_points_hold_where_the_smooth_curve_would_not_go() {
    let corner = |x: f64| if x < 60.0 { 2.0 + 4.0 * x / 60.0 } else { 6.0 - 0.1 * (x - 60.0) };
    let mut bent = points(corner, 0.0, 100.0, 21, 0.005, 3);
    [11, 12, 13].iter().for_each(|&k| bent[k].locked = true);
    let mut jumping: Vec<CurvePoint> = [1.0, 2.0, 3.0, 9.0, 5.0, 6.0, 7.0, 8.0]
        .iter()
        .zip(0u32..)
        .map(|(&y, x)| CurvePoint::new(x.into(), y))
        .collect();
    jumping[2..5].iter_mut().for_each(|point| point.locked = true);
    let mut all = points(corner, 0.0, 100.0, 21, 0.005, 3);
    all.iter_mut().for_each(|point| point.locked = true);
    for given in [bent, jumping, all] {
        for order in [2, 3, 4] {
            let fair = fair_curve(&given, &CurveSettings { order, ..CurveSettings::default() }).unwrap();
            assert_eq!(fair.status, FairStatus::Optimal, "order {order}: {:?}", fair.diagnosis);
            for (given, point) in given.iter().zip(&fair.points) {
                let (moved, most) = (point.moved().unwrap().abs(), point.tolerance.unwrap());
                assert!(moved <= if given.locked { 1e-9 } else { most * (1.0 + 1e-6) + 1e-9 }, "{order}: {point:?}");
            }
        }
    }
}

#[test]
fn settings_that_overflow_are_refused() {
    let given = points(|x| 0.01 * x, 0.0, 100.0, 11, 0.0, 1);
    for (settings, said) in [
        (CurveSettings { area: Some(1e200), ..CurveSettings::default() }, "the area is 1e200"),
        (CurveSettings { slopes: [Some(1e160), None], ..CurveSettings::default() }, "the first slope is 1e160"),
        (CurveSettings { tolerance: Some(1e300), ..CurveSettings::default() }, "the tolerance is 1e300"),
    ] {
        let error = fair_curve(&given, &settings).unwrap_err().to_string();
        assert!(error.starts_with(said), "{error}");
    }
}

#[test]
fn area_centroid_slopes_and_locks_are_held() {
    let line = |x: f64| waterline(-8.0, 3.0, x);
    let mut given = points(line, 0.0, 100.0, 21, 0.03, 7);
    for k in [0, 10, 20] {
        given[k].y = Some(line(given[k].x));
        given[k].locked = true;
    }
    let free = fair_curve(&given, &CurveSettings::default()).unwrap();
    let area =
        free.batten.knots().integrals().iter().zip(free.batten.points()).map(|(w, c)| w * c[0]).sum::<f64>() + 1.0;
    let settings = CurveSettings {
        area: Some(area),
        centroid: Some(53.3),
        slopes: [Some(0.03), Some(-0.5)],
        ..CurveSettings::default()
    };
    let fair = fair_curve(&given, &settings).unwrap();
    assert_eq!(fair.status, FairStatus::Optimal, "{:?}", fair.diagnosis);
    assert_eq!(fair.lines.len(), 4);
    for line in &fair.lines {
        let scale = if line.kind == LineKind::Area { area } else { 1.0 };
        assert!((line.after - line.target).abs() < 1e-9 * scale.max(50.0), "{line:?}");
        assert!((line.before - line.target).abs() > 1e-4 * scale, "{line:?}");
        assert!(line.multiplier != 0.0);
    }
    for k in [0, 10, 20] {
        assert!(fair.points[k].moved().unwrap().abs() < 1e-9, "{:?}", fair.points[k]);
    }
    for point in &fair.points {
        assert!(point.moved().unwrap().abs() <= point.tolerance.unwrap() * (1.0 + 1e-6) + 1e-9);
    }
    // What is held more costs more.
    assert!(fair.moves().0 > free.moves().0);
}

#[test]
fn fewer_inflections_than_the_tolerance_allows_are_refused_with_the_tolerance_that_would_do() {
    let line = |x: f64| waterline(-9.0, -9.0, x);
    let given = points(line, 0.0, 100.0, 21, 0.0, 1);
    let settings =
        CurveSettings { tolerance: Some(0.01), inflections: InflectionWish::AtMost(0), ..CurveSettings::default() };
    let fair = fair_curve(&given, &settings).unwrap();
    assert_eq!(fair.status, FairStatus::Infeasible);
    assert_eq!((fair.least.count, fair.least.certified()), (2, true));
    // The proof says that no curve does with less, and the curve shows that the program's does.
    let proved = fair.least.smaller[0].factor.unwrap();
    println!("widening {} proved {proved}", fair.widening);
    assert!(fair.widening >= proved * (1.0 - 1e-6) && fair.widening < 1.5 * proved, "{} {proved}", fair.widening);
    assert_eq!(fair.inflections[1].len(), 0);
    let again = CurveSettings { tolerance: Some(0.01 * fair.widening * 1.001), ..settings };
    assert_eq!(fair_curve(&given, &again).unwrap().status, FairStatus::Optimal);
}

/// The waterline at 6.5024 m of the Series 60 with one inflection: 13.656 mm would do, however little less is given.
#[test]
fn the_tolerance_that_would_do_is_found_just_below_it() {
    let table = include_str!("data/series60_cb060/offsets.csv");
    let rows: Vec<Vec<&str>> = table.lines().map(|line| line.split(',').collect()).collect();
    let column = rows[0].iter().position(|name| *name == "6.5024").unwrap();
    let given = rows[1..].iter().map(|row| CurvePoint::new(row[0].parse().unwrap(), row[column].parse().unwrap()));
    let given: Vec<CurvePoint> = given.collect();
    for tolerance in [0.0134, 0.0135, 0.01365, 0.013655] {
        let one = InflectionWish::AtMost(1);
        let settings = CurveSettings { tolerance: Some(tolerance), inflections: one, ..CurveSettings::default() };
        let fair = fair_curve(&given, &settings).unwrap();
        assert_eq!((fair.status, fair.inflections[1].len()), (FairStatus::Infeasible, 1), "{tolerance}");
        assert!((tolerance * fair.widening - 0.013656).abs() < 1e-6, "{tolerance} {}", fair.widening);
    }
}

#[test]
fn the_price_guard_keeps_what_the_readings_say() {
    // Tolerances so wide that a straight line would do: the hollow is paid for all the same.
    let line = |x: f64| waterline(-9.0, -9.0, x);
    let given = points(line, 0.0, 100.0, 21, 0.01, 3);
    let wide = CurveSettings { tolerance: Some(8.0), ..CurveSettings::default() };
    let fair = fair_curve(&given, &wide).unwrap();
    assert_eq!(fair.least.count, 0);
    assert_eq!(fair.inflections[1].len(), 2);
    assert!(fair.refused.len() == 2 && fair.refused.iter().all(|r| r.1 > 12.0), "{:?}", fair.refused);
}

#[test]
fn a_knuckle_stays_sharp() {
    let line = |x: f64| 5.0 - 0.002 * (x - 40.0).powi(2) - 0.25 * (x - 40.0).max(0.0);
    let mut given = points(line, 0.0, 80.0, 17, 0.01, 5);
    let smooth = fair_curve(&given, &CurveSettings::default()).unwrap();
    given[8].knuckle = true;
    let sharp = fair_curve(&given, &CurveSettings::default()).unwrap();
    let errors = [&smooth, &sharp].map(|fair| error(|x| fair.curve.eval(x)[0], line, 0.0, 80.0));
    println!("knuckle not declared {:?}, declared {:?}", errors[0], errors[1]);
    assert!(errors[1].0 < 0.6 * errors[0].0);
    let jump = sharp.curve.derivatives::<2>(40.0)[1][0] - sharp.curve.derivatives::<2>(40.0 - 1e-9)[1][0];
    assert!((jump + 0.25).abs() < 0.02, "{jump}");
}

#[test]
fn true_curvature_makes_a_round_end_round() {
    // Most of a quarter of a circle of 5 m: slopes up to 3.
    let line = |x: f64| (25.0_f64 - x * x).sqrt();
    let given = points(line, 0.0, 4.75, 13, 0.01, 11);
    let with = fair_curve(&given, &CurveSettings::default()).unwrap();
    let without = fair_curve(&given, &CurveSettings { true_curvature: false, ..CurveSettings::default() }).unwrap();
    let errors = [&without, &with].map(|fair| error(|x| fair.curve.eval(x)[0], line, 0.0, 4.75));
    let spread = |fair: &loftsman::internals::fairing::curve::FairCurve| {
        fair.points.iter().map(|p| (p.curvature + 0.2).abs()).fold(0.0, f64::max)
    };
    println!(
        "derivatives {:?} {:.4}, curvature {:?} {:.4}, refreshes {}",
        errors[0],
        spread(&without),
        errors[1],
        spread(&with),
        with.refreshes
    );
    assert!(with.refreshes >= 1);
    assert!(spread(&with) < spread(&without), "{} {}", spread(&with), spread(&without));
    assert!(errors[1].0 <= errors[0].0);
}

/// Exit code, standard output and error of the command in a folder.
fn run(folder: &Folder, arguments: &[&str]) -> (i32, String, String) {
    let output = command(&[&["fair-curve"], arguments].concat()).current_dir(folder).output().unwrap();
    (output.status.code().unwrap(), stdout(&output), stderr(&output))
}

fn csv(points: &[CurvePoint]) -> String {
    points
        .iter()
        .fold(String::from("x,y,tolerance,flag\n"), |text, p| text + &format!("{},{:.3},,\n", p.x, p.y.unwrap()))
}

#[test]
fn the_command_writes_curve_proof_and_picture() {
    let folder = folder("files");
    folder.write("curve.csv", csv(&points(|x| waterline(-9.0, 2.0, x), 0.0, 100.0, 21, 0.04, 2)));
    let (code, page, error) =
        run(&folder, &["curve.csv", "-o", "out", "--area", "keep", "--centroid", "keep", "--lock", "50"]);
    assert_eq!((code, error.as_str()), (0, ""), "{page}");
    assert!(page.contains("status        optimal") && page.contains("proved"), "{page}");
    let fairing = json(folder.read("out/fairing.json"));
    assert_eq!(fairing["status"], "optimal");
    let entry = &fairing["inflections"]["curve"][0];
    assert_eq!(
        (entry["after"].as_u64(), entry["minimum"].as_u64(), &entry["certified"]),
        (Some(1), Some(1), &serde_json::Value::Bool(true))
    );
    assert!(entry["before"].as_u64().unwrap() > 1, "{entry}");
    // Whichever bend the stretch begins with, one of the two proofs has as many witnesses as inflections are claimed.
    let proofs = entry["stretches"][0]["proof"].as_array().unwrap();
    assert_eq!(proofs.iter().map(|p| p["witnesses"].as_array().unwrap().len()).min(), Some(1));
    assert!(fairing["certificate"]["gap"].as_f64().unwrap().abs() < 1e-7);
    for line in fairing["constraints"].as_array().unwrap() {
        let target = line["target"].as_f64().unwrap();
        assert!(line["residual"].as_f64().unwrap().abs() < 1e-10 * target.abs(), "{line}");
    }
    let table = folder.read("out/curve.csv");
    assert_eq!(table.lines().count(), 22);
    let locked = table.lines().find(|line| line.starts_with("50,")).unwrap();
    assert!(
        locked.split(',').nth(3) == Some("!") && locked.split(',').nth(5).unwrap().parse::<f64>().unwrap().abs() < 1e-9
    );
    assert!(std::fs::read(folder.join("out/fair-curve.png")).unwrap().starts_with(b"\x89PNG"));
    // The result is a curve that reads back, and it is fair already.
    let (code, again, _) = run(&folder, &["out/curve.csv", "--json"]);
    assert_eq!(code, 0);
    let again = json(&again);
    assert!(again["moves"]["max"].as_f64().unwrap() < fairing["moves"]["max"].as_f64().unwrap());
    // Nothing is overwritten without being told.
    assert_eq!(run(&folder, &["curve.csv", "-o", "out"]).0, 6);
    assert_eq!(run(&folder, &["curve.csv", "-o", "out", "--force", "--no-figures", "-q"]).0, 0);
}

/// What no sensible curve within the tolerances has is refused with the interval that it has, and the nearest curve.
#[test]
fn impossible_areas_centroids_and_slopes_are_refused() {
    let folder = folder("impossible");
    folder.write("curve.csv", csv(&points(|x| waterline(-9.0, -9.0, x), 0.0, 100.0, 21, 0.02, 2)));
    let run = |option: &str, value: &str| {
        let (code, page, error) = run(&folder, &["curve.csv", "-o", "out", "--force", "--no-figures", option, value]);
        let json = json(folder.read("out/fairing.json"));
        (code, page + &error, json)
    };
    for (option, value) in
        [("--area", "0"), ("--area", "-5"), ("--area", "1e9"), ("--centroid", "1e9"), ("--first-slope", "1e6")]
    {
        let (code, said, json) = run(option, value);
        assert!(code == 4 && said.contains("E410") && said.contains(" alone could be "), "{option} {value}: {said}");
        let line = &json["constraints"][0];
        let alone = &json["infeasible"]["alone"][0];
        let number = |value: &serde_json::Value| value.as_f64().unwrap();
        let (least, greatest) = (number(&alone["least"]), number(&alone["greatest"]));
        assert!((least..=greatest).contains(&number(&line["after"])), "{line} {alone}");
        // The interval is what can be had: just inside is optimal, just outside is not.
        let inside = least + 0.02 * (greatest - least);
        let outside = least - 0.02 * (greatest - least);
        assert_eq!([run(option, &inside.to_string()).0, run(option, &outside.to_string()).0], [0, 4], "{option}");
        let moves = &json["moves"];
        assert!(number(&moves["max"]) < 0.2, "{moves}");
    }
}

#[test]
fn the_command_refuses_with_numbers() {
    let folder = folder("refuse");
    folder.write("curve.csv", csv(&points(|x| waterline(-9.0, -9.0, x), 0.0, 100.0, 21, 0.0, 2)));
    let (code, page, error) = run(&folder, &["curve.csv", "-o", "out", "--tolerance", "10 mm", "--inflections", "0"]);
    assert_eq!(code, 4, "{page}{error}");
    assert!(error.contains("E410") && error.contains("times as wide"), "{error}");
    let json = json(folder.read("out/fairing.json"));
    assert_eq!(json["status"], "infeasible");
    let widening = json["widening"].as_f64().unwrap();
    // Every file says that it is a compromise; the curve reads back, and what is had of it loses the mark.
    let written = folder.read("out/curve.csv");
    assert!(written.starts_with("# compromise: not all targets are met;"), "{written}");
    let rows = || written.lines().skip(1);
    assert!(rows().next().unwrap().ends_with(",status") && rows().skip(1).all(|row| row.ends_with(",infeasible")));
    assert!(folder.read("out/fair-curve.svg").contains("A COMPROMISE"));
    assert_eq!(run(&folder, &["out/curve.csv", "-o", "again"]).0, 0);
    let again = folder.read("again/curve.csv");
    assert_eq!(again.lines().count(), rows().count());
    assert!(again.lines().skip(1).all(|row| row.ends_with(",optimal")), "{again}");
    assert!(!folder.read("again/fair-curve.svg").contains("A COMPROMISE"));
    // With that tolerance, and not with one a hundredth smaller, it can be had.
    let with = |factor: f64| {
        let tolerance = format!("{} mm", 10.0 * widening * factor);
        run(&folder, &["curve.csv", "--tolerance", &tolerance, "--inflections", "0"]).0
    };
    assert_eq!((with(1.001), with(0.99)), (0, 4));
    // Locks that contradict a target at any tolerance.
    let all = "0:100:5";
    let (code, _, error) = run(&folder, &["curve.csv", "--lock", all, "--inflections", "0"]);
    assert_eq!(code, 4, "{error}");
    assert_eq!(run(&folder, &["curve.csv", "--lock", "51"]).0, 2);
    assert_eq!(run(&folder, &["curve.csv", "--order", "7"]).0, 2);
    folder.write("bad.csv", "x,y\n0,1\n1,abc\n2,3-13-1\n");
    let (code, _, error) = run(&folder, &["bad.csv"]);
    assert!(
        code == 3 && error.contains("bad.csv:3") && error.contains("bad.csv:4") && error.contains("E340"),
        "{error}"
    );
    folder.write("few.csv", "x,y\n0,1\n1,2\n2,3\n");
    let (code, _, error) = run(&folder, &["few.csv"]);
    assert!(code == 3 && error.contains("E342"), "{error}");
}

/// 21 points of a full waterline with noise, of which one is off by `off` standard deviations.
fn with_error(seed: u64, off: f64) -> (Vec<CurvePoint>, usize) {
    let truth = |x: f64| 8.0 * (1.0 - (x / 50.0 - 1.0).powi(4));
    let mut list = points(truth, 0.0, 100.0, 21, 0.01, seed);
    let k = 2 + (seed as usize) % 17;
    list[k].y = list[k].y.map(|y| y + off * 0.01);
    (list, k)
}

#[test]
#[ignore = "takes 7 s"]
fn a_point_that_contradicts_all_others_is_suspected() {
    let settings = CurveSettings::default();
    let (mut false_alarms, mut found) = (0, 0);
    for seed in 0..40 {
        let (clean, _) = with_error(seed, 0.0);
        false_alarms += usize::from(!contradictions(&clean, &settings).unwrap().suspects.is_empty());
        let (wrong, k) = with_error(seed, 15.0);
        let told = contradictions(&wrong, &settings).unwrap();
        let right = |s: &CurveSuspect| s.index == k && (s.value - s.expected - 0.15).abs() < 0.06;
        found += usize::from(told.suspects.len() == 1 && told.suspects.iter().all(right) && told.corners.is_empty());
        // Whoever vouches for a point is believed.
        let mut locked = wrong;
        locked[k].locked = true;
        assert!(contradictions(&locked, &settings).unwrap().suspects.iter().all(|s| s.index != k), "{seed}");
    }
    assert!(false_alarms <= 2 && found >= 38, "{false_alarms} {found}");
}

#[test]
fn corners_that_nobody_declared_are_told() {
    for sigma in [0.0, 0.002, 0.01] {
        let side = |x: f64| (x / 8.0).min(4.0).min((100.0 - x) / 8.0);
        let list = points(side, 0.0, 100.0, 26, sigma, 7);
        let told = contradictions(&list, &CurveSettings::default()).unwrap();
        let places: Vec<f64> = told.corners.iter().map(|corner| list[corner.index].x).collect();
        assert_eq!((places, told.suspects.len()), (vec![32.0, 68.0], 0), "{sigma}");
        assert!(told.corners.iter().all(|corner| corner.noise[1] < 0.5 * corner.noise[0]), "{told:?}");
    }
}

#[test]
fn suspects_are_left_out_and_listed_unless_they_are_kept() {
    let files = folder("suspects");
    let (list, k) = with_error(3, 27.0);
    files.write("curve.csv", csv(&list));
    let (code, page, _) = run(&files, &["curve.csv", "-o", "out", "--area", "keep"]);
    assert_eq!(code, 0);
    let place = format!("x = {:.3} m: given", list[k].x);
    assert!(page.contains(&place) && page.contains("left out; --keep-suspects takes it"), "{page}");
    let json = json(files.read("out/fairing.json"));
    assert_eq!(json["suspects"][0]["left_out"], true);
    assert!(json["noise"]["sigma"].as_f64().unwrap() < 0.02, "{}", json["noise"]);
    // The area as given is that without it.
    assert!(json["constraints"][0]["residual"].as_f64().unwrap().abs() < 1e-9);
    let row = files.read("out/curve.csv").lines().find(|line| line.ends_with("suspect")).unwrap().to_owned();
    assert!((row.split(',').nth(5).unwrap().parse::<f64>().unwrap() + 0.27).abs() < 0.05, "{row}");
    let (_, page, _) = run(&files, &["curve.csv", "--keep-suspects"]);
    assert!(page.contains("taken as it is"), "{page}");
}
