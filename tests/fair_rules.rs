//! Rules of a fairing for single lines and regions: each is kept where it says so, and its price is told.

use loftsman::internals::fairing::bends::Line;
use loftsman::internals::fairing::change::Change;
use loftsman::internals::fairing::constraint::{Constraint, FixedLine, Rule, TangentPlace};
use loftsman::internals::fairing::held::HeldRule;
use loftsman::internals::fairing::job::{Holding, Job, Tolerance};
use loftsman::internals::fairing::outcome::Outcome;
use loftsman::internals::fairing::proposals::Accepted;
use loftsman::internals::fairing::surface::with_half_breadths;
use loftsman::internals::fairing::{LineCourse, LineKind, ProposedLine};
use loftsman::internals::hull::{Cut, FitMethod, Hull, OffsetTable, transverse_inertia, transverse_inertia_gradient};
use loftsman::internals::hydrostatics::{
    Conventions, CurvesOfForm, QUANTITIES, wetted_surface, wetted_surface_gradient,
};
use loftsman::internals::qp::Status;

use crate::support::{carried, sampled, table_of, weyl_noise};

/// The parent of Series 60 with C_B 0.60: 121.92 m between perpendiculars, B 16.256 m, at a draught between its
/// waterlines.
fn series60() -> OffsetTable {
    let mut table = table_of(carried("tests/data/series60_cb060/offsets.csv"));
    table.stated.draught = Some(6.828);
    table
}

fn faired(rules: Vec<Rule>) -> Outcome {
    let outcome = Job { rules, ..Job::default() }.run(&series60()).unwrap();
    assert_eq!(outcome.status, Status::Optimal);
    let gap = outcome.faired.solved.certificate.gap.abs();
    assert!(gap < 5e-8, "gap {gap:e}");
    for rule in &outcome.rules {
        assert!(rule.violation < 1e-9, "{}: {:e}", rule.rule.words(), rule.violation);
    }
    outcome
}

fn only(outcome: &Outcome) -> &HeldRule {
    assert_eq!(outcome.rules.len(), 1);
    &outcome.rules[0]
}

/// Half-breadths of both hulls along a waterline or a station \[m\].
fn along(outcome: &Outcome, points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let at = |hull: &Hull, [x, z]: [f64; 2]| hull.half_breadth(x, z).unwrap();
    points.iter().map(|&point| [at(&outcome.before, point), at(&outcome.after, point)]).collect()
}

/// dy/dx or dy/dz by central differences.
fn slope(hull: &Hull, [x, z]: [f64; 2], station: bool) -> f64 {
    let h = 1e-4;
    let step = if station { [0.0, h] } else { [h, 0.0] };
    let y = |sign: f64| hull.half_breadth(x + sign * step[0], z + sign * step[1]).unwrap();
    (y(1.0) - y(-1.0)) / (2.0 * h)
}

#[test]
#[ignore = "takes 10 s"]
fn fixed_lines_do_not_move_and_others_do() {
    let lines = [FixedLine::Line(Line::Station(30.48)), FixedLine::Line(Line::Waterline(6.5024)), FixedLine::Stem];
    let outcome = faired(lines.into_iter().map(Rule::Fixed).collect());
    // Their offsets stay; between them the lines are those of the fair surface through them.
    let stays = |change: &&Change| (change.x - 30.48).abs() < 1e-9 || (change.z - 6.5024).abs() < 1e-9;
    let kept: Vec<&Change> = outcome.changes.iter().filter(stays).collect();
    assert!(kept.len() > 30 && kept.iter().all(|change| change.locked), "{}", kept.len());
    // To the accuracy of the program.
    let least = 1e-8 * outcome.before.particulars().breadth;
    for change in kept {
        assert!((change.before - change.after).abs() < least, "{change:?}");
    }
    let lengths: Vec<[f64; 2]> = (5..115).map(|k| [f64::from(k), 6.5024]).collect();
    for [before, after] in along(&outcome, &lengths) {
        assert!((before - after).abs() < 0.05, "{before} {after}");
    }
    let beside: Vec<[f64; 2]> = (10..110).map(|k| [f64::from(k), 4.8]).collect();
    assert!(along(&outcome, &beside).iter().any(|[before, after]| (before - after).abs() > 1e-3));
    assert!(
        outcome.rules.iter().all(|rule| rule.multiplier > 1e-4 && rule.binding == rule.rows),
        "{:?}",
        outcome.rules
    );
}

#[test]
fn tangents_are_met() {
    let table = series60();
    let before = faired(Vec::new()).before;
    let end_slope = |hull: &Hull| {
        let end = hull.endings(6.5024).unwrap()[1];
        let y = |back: f64| hull.half_breadth(end - back, 6.5024).unwrap();
        // Second order: y = a h + b h^2.
        let h = 1e-3;
        (4.0 * (y(h) - y(0.0)) - (y(2.0 * h) - y(0.0))) / (2.0 * h)
    };
    // A tenth of a degree off what the surface through the table has, and a wall where it leans.
    let degree = 1f64.to_radians();
    let entrance = end_slope(&before).atan() + 0.1 * degree;
    let (wall, place) = ([60.96, 5.5], [30.48, 6.5024]);
    let angle = slope(&before, place, false).atan() + 0.05 * degree;
    let rules = vec![
        Rule::Tangent(TangentPlace::Entrance(6.5024), entrance),
        Rule::Tangent(TangentPlace::Station(wall), 0.0),
        Rule::Tangent(TangentPlace::Waterline(place), angle),
    ];
    let outcome =
        Job { rules, tolerance: Tolerance { table: Some(0.05), ..Job::default().tolerance }, ..Job::default() }
            .run(&table)
            .unwrap();
    assert_eq!(outcome.status, Status::Optimal);
    assert!(slope(&outcome.after, wall, true).abs() < 1e-6);
    assert!((slope(&outcome.after, place, false) - angle.tan()).abs() < 1e-6);
    let first = end_slope(&outcome.after);
    assert!((first - entrance.tan()).abs() < 1e-5, "{first} {}", entrance.tan());
    assert!(outcome.rules.iter().all(|rule| rule.rows == 1));
    assert!(outcome.rules.iter().filter(|rule| rule.binding == 1).count() >= 2, "{:?}", outcome.rules);
}

#[test]
#[ignore = "takes 14 s"]
fn a_flat_of_side_is_flat() {
    let outcome = faired(vec![Rule::FlatOfSide { x: [54.864, 67.056], z: [6.0, 9.7536] }]);
    let half = 0.5 * outcome.after.particulars().breadth;
    let inside: Vec<[f64; 2]> =
        (0..20).flat_map(|i| (0..10).map(move |j| [55.0 + 0.6 * f64::from(i), 6.6 + 0.3 * f64::from(j)])).collect();
    for [_, after] in along(&outcome, &inside) {
        assert!((after - half).abs() < 1e-9, "{after} {half}");
    }
}

#[test]
fn a_waterline_rises_and_a_part_is_hollow() {
    let line = Line::Waterline(1.6256);
    let rising = only(&faired(vec![Rule::Monotone { line, over: [0.0, 50.0], rising: true }])).clone();
    assert!(rising.rows > 50);
    let outcome = faired(vec![Rule::Curvature { line, over: [6.0, 20.0], convex: false }]);
    let y = |x: f64| outcome.after.half_breadth(x, 1.6256).unwrap();
    for k in 0..28 {
        let x = 6.2 + 0.5 * f64::from(k) * 0.98;
        let bend = y(x - 0.1) - 2.0 * y(x) + y(x + 0.1);
        assert!(bend > -1e-9, "x {x}: {bend:e}");
    }
}

#[test]
fn a_line_has_no_more_inflections_than_it_may() {
    // Without the guard of inflections, so that only the rule can be what takes one away.
    let run = |rules: Vec<Rule>| Job { rules, signs: false, ..Job::default() }.run(&series60()).unwrap();
    let free = run(Vec::new());
    let turns = |outcome: &Outcome, z: f64| {
        outcome
            .turns
            .iter()
            .find(|turns| matches!(turns.cut, Cut::Waterline { z: other } if (other - z).abs() < 1e-9))
            .unwrap()
            .after
    };
    let heights = [0.48768, 1.6256, 3.2512, 4.8768, 6.5024, 8.128];
    let z = heights.into_iter().max_by_key(|&z| turns(&free, z)).unwrap();
    assert!(turns(&free, z) >= 3, "{}", turns(&free, z));
    let all = [f64::NEG_INFINITY, f64::INFINITY];
    let outcome = run(vec![Rule::Inflections { line: Line::Waterline(z), over: all, most: 2 }]);
    assert_eq!(outcome.status, Status::Optimal);
    assert!(turns(&outcome, z) <= 2, "z {z}: {} -> {}", turns(&free, z), turns(&outcome, z));
    let rule = only(&outcome);
    assert!(rule.binding > 0 && rule.rows > 20 && rule.violation < 1e-9, "{rule:?}");
    let rows = rule.rows;
    // A part of the line: no change of sign of the second differences left in it, where there were some. What is below
    // a micrometre on half a metre departs from its chord by less than a twentieth of a millimetre.
    let over = [20.0, 60.0];
    let changes = |outcome: &Outcome| {
        let y = |x: f64| outcome.after.half_breadth(x, z).unwrap();
        let bend = |k: i32| {
            let x = 21.0 + 0.5 * f64::from(k);
            y(x - 0.25) - 2.0 * y(x) + y(x + 0.25)
        };
        let bends: Vec<f64> = (0..=76).map(bend).filter(|bend| bend.abs() > 1e-6).collect();
        bends.windows(2).filter(|pair| (pair[0] > 0.0) != (pair[1] > 0.0)).count()
    };
    assert!(changes(&free) > 0, "z {z}");
    let outcome = run(vec![Rule::Inflections { line: Line::Waterline(z), over, most: 0 }]);
    assert_eq!(outcome.status, Status::Optimal);
    let rule = only(&outcome);
    assert!(rule.rule.words().contains("from x = 20.000 to 60.000 m without inflections"), "{}", rule.rule.words());
    assert!((5..rows).contains(&rule.rows) && rule.violation < 1e-9, "{rule:?}");
    assert_eq!(changes(&outcome), 0, "z {z}");
}

#[test]
fn rules_that_name_nothing_are_refused_all_at_once() {
    let rules = vec![
        Rule::Fixed(FixedLine::Line(Line::Station(500.0))),
        Rule::FlatOfSide { x: [200.0, 210.0], z: [1.0, 2.0] },
        Rule::Tangent(TangentPlace::Entrance(40.0), 0.1),
    ];
    let said = Job { rules, ..Job::default() }.run(&series60()).unwrap_err().to_string();
    for words in ["no station at x = 500", "no cell of the net", "the stem does not reach z = 40"] {
        assert!(said.contains(words), "{said}");
    }
}

#[test]
#[ignore = "takes 21 s"]
fn contradictory_rules_are_infeasible_and_say_which() {
    let line = Line::Waterline(6.5024);
    let rules = vec![Rule::Monotone { line, over: [80.0, 115.0], rising: true }, Rule::Fixed(FixedLine::Stern)];
    let outcome = Job { rules, ..Job::default() }.run(&series60()).unwrap();
    assert_eq!(outcome.status, Status::Infeasible);
    let found = outcome.faired.diagnosis.as_ref().unwrap();
    let give = found.rules.iter().map(|(_, give)| give.unwrap_or(f64::INFINITY)).collect::<Vec<_>>();
    // The waterline falls by metres there: no small slack would do; the stern is no hindrance at all.
    assert!(give[0] > 1e-3, "{give:?}");
    assert!(give[1].is_infinite(), "{give:?}");
    // What cannot be met is given up; the rest is held, and the hull is fair.
    let given_up: Vec<bool> = outcome.rules.iter().map(|rule| rule.given_up).collect();
    assert_eq!(given_up, [true, false]);
    assert!(outcome.rules[0].violation > 1e-3 && outcome.rules[1].violation < 1e-9, "{:?}", outcome.rules);
    assert!(outcome.held.iter().all(|held| held.is_had()), "{:?}", outcome.held);
    let counts = ["station", "waterline"].map(|kind| outcome.inflections(kind));
    assert!(counts.iter().all(|[before, after]| after <= before), "{counts:?}");
}

fn disturbed(hull: &Hull, by: f64) -> Hull {
    let points = hull.surface().points();
    let y: Vec<f64> =
        points.iter().enumerate().map(|(k, p)| p[1] + by * (0.7 * k as f64).sin() * p[1].signum()).collect();
    with_half_breadths(hull, &y).unwrap()
}

#[test]
fn gradients_are_those_of_finite_differences() {
    let table = series60();
    let level = Hull::fit(&table, &FitMethod::Graded).unwrap().hull;
    let mut yacht = table_of(carried("tests/data/pdstrip_yacht/offsets.csv"));
    yacht.stated.draught = Some(0.673);
    let upright = Hull::fit(&yacht, &FitMethod::Graded).unwrap().hull;
    assert!(level.is_level() && !upright.is_level());
    for hull in [level, upright] {
        let draught = hull.reference_height();
        let h = 1e-4;
        let ends = [disturbed(&hull, -h), disturbed(&hull, h)];
        let direction: Vec<f64> = ends[1]
            .surface()
            .points()
            .iter()
            .zip(ends[0].surface().points())
            .map(|(a, b)| (a[1] - b[1]) / (2.0 * h))
            .collect();
        let along = |gradient: Vec<f64>| gradient.iter().zip(&direction).map(|(g, d)| g * d).sum::<f64>();
        let difference = |value: &dyn Fn(&Hull) -> f64| (value(&ends[1]) - value(&ends[0])) / (2.0 * h);
        let inertia =
            [along(transverse_inertia_gradient(&hull, draught)), difference(&|hull| transverse_inertia(hull, draught))];
        assert!((inertia[0] - inertia[1]).abs() < 1e-6 * inertia[1].abs(), "{inertia:?}");
        let skin = [along(wetted_surface_gradient(&hull, draught)), difference(&|hull| wetted_surface(hull, draught))];
        let gradient = wetted_surface_gradient(&hull, draught);
        let size: f64 = gradient.iter().zip(&direction).map(|(g, d)| (g * d).abs()).sum();
        assert!((skin[0] - skin[1]).abs() < 1e-5 * size, "{skin:?} {size}");
        // The metacentre of the constraint is that of the hydrostatics.
        let rows = CurvesOfForm::new(&hull, &[draught], &Conventions::default()).rows;
        let km = Constraint::Metacentre { height: 0.0, gravity: 0.0 }.value(&hull);
        let of = |name: &str| QUANTITIES.iter().find(|q| q.key == name).and_then(|q| (q.value)(&rows[0])).unwrap();
        assert!((km / of("KMT") - 1.0).abs() < 1e-9, "{km} {}", of("KMT"));
    }
}

#[test]
#[ignore = "takes 6 s"]
fn metacentre_and_wetted_surface_are_held() {
    let table = series60();
    let free = faired(Vec::new());
    let km = Constraint::Metacentre { height: 0.0, gravity: 0.0 };
    let gm = Constraint::Metacentre { height: 0.0, gravity: 6.0 };
    let skin = Constraint::WettedSurface(0.0);
    let values = [km, skin].map(|constraint| constraint.value(&free.before));
    // The surface through the table, which no fairing has had; then targets of our own, off by parts of a thousand.
    for (factors, metacentre) in [([1.0, 1.0], km), ([1.0008, 0.9995], gm)] {
        let shift = if metacentre == gm { 6.0 } else { 0.0 };
        let given = vec![
            Constraint::Displacement(Constraint::Displacement(0.0).value(&free.before)),
            metacentre.with_target(factors[0] * values[0] - shift),
            skin.with_target(factors[1] * values[1]),
        ];
        let outcome = Job { holding: Holding::Given(given.clone()), ..Job::default() }.run(&table).unwrap();
        assert_eq!(outcome.status, Status::Optimal, "{:?}", outcome.faired.settled);
        for (held, target) in outcome.held.iter().zip(&given) {
            let error = (held.after - target.target()) / target.scale(&outcome.after);
            assert!(error.abs() <= 1e-9, "{}: {error:e}", held.constraint.words());
        }
        let errors = outcome.faired.settled.as_ref().unwrap();
        assert!(errors.last().is_some_and(|error| *error <= 1e-10), "{errors:?}");
        assert!(outcome.faired.solved.certificate.gap.abs() < 1e-8);
    }
}

/// 25 stations and 21 waterlines of a hull with a chine at 6 m, which the table does not declare and which turns the
/// stations by `turn` of x, with noise of 2 mm.
fn chined(turn: impl Fn(f64) -> f64) -> OffsetTable {
    let waterlines: Vec<f64> = (0..21).map(|j| 0.5 * f64::from(j)).collect();
    let mut noise = weyl_noise();
    let half = |x: f64, z: f64| {
        let y = (1.0 - 0.4 * (x / 50.0 - 1.0).powi(2)) * (6.0 + 0.5 * z - 0.02 * z * z) + turn(x) * (z - 6.0).max(0.0);
        y + 0.002 * noise()
    };
    sampled(waterlines, 25, |i| 4.0 * i + 2.0, 4, half)
}

/// By how much the slope of a station is more above a height than below.
fn bend(hull: &Hull, x: f64, z: f64) -> f64 {
    let y = |z: f64| hull.half_breadth(x, z).unwrap();
    let (h, away) = (0.02, 0.005);
    (y(z + away + h) - y(z + away)) / h - (y(z - away) - y(z - away - h)) / h
}

/// A chine of the after body that has run out at 50 m: declared as far as that, the stations forward of it stay smooth.
#[test]
fn a_chine_ends_where_it_is_said_to_end() {
    let table = chined(|x| 0.35 * (1.0 - x / 50.0).max(0.0).sqrt());
    let line =
        ProposedLine { kind: LineKind::Knuckle, course: LineCourse::Waterline, at: 6.0, reach: [2.0, 50.0], gain: 1.0 };
    let outcome = Job { lines: vec![line], ..Job::default() }.run(&table).unwrap();
    assert_eq!(outcome.status, Status::Optimal);
    for x in [6.0, 18.0, 30.0] {
        let (own, truth) = (bend(&outcome.after, x, 6.0), 0.35 * (1.0 - x / 50.0).sqrt());
        assert!((own - truth).abs() < 0.25 * truth, "{x} {own} for {truth}");
    }
    // The curve itself bends by 0.001 over the 0.03 m.
    for x in [62.0, 70.0, 78.0, 86.0, 94.0] {
        let own = bend(&outcome.after, x, 6.0);
        assert!(own.abs() < 5e-3, "{x} {own}");
    }
}

/// Wigley's hull with a chine at 4 m that fades out at x = 32 and 68 m, and 2 mm of noise: a net that smooths it away has
/// five offsets side by side against it, which are no typing errors.
#[test]
fn a_chine_is_not_taken_for_typing_errors() {
    let waterlines: Vec<f64> = (0..9).map(f64::from).collect();
    let mut noise = weyl_noise();
    let half = |x: f64, z: f64| {
        let own = 6.0 * (1.0 - (x / 50.0 - 1.0).powi(2)) * (1.0 - ((8.0 - z) / 8.0).powi(2));
        let part = (x - 32.0) / 36.0;
        let fades = if (0.0..1.0).contains(&part) { 0.2 * (std::f64::consts::PI * part).sin().powi(2) } else { 0.0 };
        let y = own - fades * (z - 4.0).abs() * (-((z - 4.0) / 2.5).powi(2)).exp();
        if own > 0.0 { (y + 0.002 * noise()).max(0.0) } else { 0.0 }
    };
    let table = sampled(waterlines, 21, |i| 5.0 * i, 4, half);
    let outcome = Job::default().run(&table).unwrap();
    assert_eq!(outcome.status, Status::Optimal);
    assert!(outcome.changes.iter().all(|change| !change.suspect), "{:?}", outcome.suspects);
    let furthest = outcome.moves().1;
    assert!(furthest < 0.01, "{furthest}");
    let line = &outcome.proposals[0].line;
    assert_eq!((line.kind, line.course), (LineKind::Knuckle, LineCourse::Waterline));
    assert!((line.at - 4.0).abs() < 1e-9 && line.reach[0] < 45.0 && line.reach[1] > 55.0, "{line:?}");
}

#[test]
#[ignore = "takes 6 s"]
fn an_undeclared_chine_is_proposed_and_taken() {
    let table = chined(|_| 0.35);
    let run = |accepted: Accepted| Job { accepted, ..Job::default() }.run(&table);
    let without = run(Accepted::None).unwrap();
    let [line] = &without.proposals[..] else { panic!("{:?}", without.proposals) };
    assert_eq!((line.line.kind, line.line.course), (LineKind::Knuckle, LineCourse::Waterline));
    assert!((line.line.at - 6.0).abs() < 1e-9 && !line.accepted && line.number == 1);
    let [rms, with] = line.rms.unwrap();
    assert!(with < 0.8 * rms && line.gain.unwrap() > 100.0, "{line:?}");
    let taken = run(Accepted::These(vec![1])).unwrap();
    assert!(taken.proposals[0].accepted && taken.status == Status::Optimal);
    // The slope of a station breaks at the chine; half of the 0.35 of the truth, since the surface that the line is put
    // into is one that runs through it as a curve.
    let bend = |outcome: &Outcome| bend(&outcome.after, 50.0, 6.0);
    assert!(bend(&taken) > 0.12 && bend(&taken) > 3.0 * bend(&without), "{} {}", bend(&taken), bend(&without));
    // Whoever says that it is there has the same hull.
    let lines = vec![ProposedLine { gain: 1.0, ..line.line }];
    let told = Job { lines, ..Job::default() }.run(&table).unwrap();
    assert_eq!(told.proposals.len(), 1);
    assert!(told.proposals[0].accepted && told.after.surface().points() == taken.after.surface().points());
    let refused = run(Accepted::These(vec![4])).unwrap_err().to_string();
    assert_eq!(refused, "L4 is not proposed: there is L1");
}
