//! Inspection of curves and hulls against closed forms.

use std::f64::consts::PI;

use loftsman::internals::fairing::inspect::{
    Counts, Findings, Inspection, Local, Planes, Profile, Resolution, SurfaceMap, gaussian_regions, kind,
};
use loftsman::internals::hull::{Cut, Hull, PrincipalParticulars};
use loftsman::internals::parametric::analytic::{self, Dimensions};
use loftsman::internals::parametric::cosh::{self, DesignTargets, MidshipTarget};
use loftsman::internals::spline::{BsplineCurve, BsplineSurface, Collocation, KnotVector};
use proptest::prelude::*;

use crate::support::carried;

/// Graph y(x) with its first three derivatives, positive where it turns to the left.
fn graph(x: f64, [y, y1, y2, y3]: [f64; 4]) -> Local {
    let w = 1.0 + y1 * y1;
    Local {
        point: [x, y],
        velocity: [1.0, y1],
        curvature: y2 / w.powf(1.5),
        slope: (y3 * w - 3.0 * y1 * y2 * y2) / w.powi(3),
    }
}

fn findings(ends: &[f64], closed: bool, tolerance: f64, local: impl Fn(f64) -> Local) -> Findings {
    let pieces: Vec<[f64; 2]> = ends.windows(2).map(|pair| [pair[0], pair[1]]).collect();
    Profile::sample(&pieces, closed, |t| Some(local(t))).expect("a curve").findings(tolerance)
}

fn even(from: f64, to: f64, count: usize) -> Vec<f64> {
    (0..=count).map(|k| from + (to - from) * k as f64 / count as f64).collect()
}

/// The ellipse of these semi-axes.
fn ellipse(a: f64, b: f64) -> impl Fn(f64) -> Local {
    move |t| {
        let w = (a * t.sin()).powi(2) + (b * t.cos()).powi(2);
        Local {
            point: [a * t.cos(), b * t.sin()],
            velocity: [-a * t.sin(), b * t.cos()],
            curvature: a * b / w.powf(1.5),
            slope: -3.0 * a * b * (a * a - b * b) * t.sin() * t.cos() / w.powi(3),
        }
    }
}

#[test]
fn a_circle_has_neither_inflections_nor_extrema_nor_flats() {
    let r = 3.0;
    let found = findings(&even(0.0, 2.0 * PI, 8), true, 1e-4, |t| Local {
        point: [r * t.cos(), r * t.sin()],
        velocity: [-r * t.sin(), r * t.cos()],
        curvature: 1.0 / r,
        slope: 0.0,
    });
    assert!((found.length - 2.0 * PI * r).abs() < 1e-12, "{}", found.length);
    assert!((found.turning - 2.0 * PI).abs() < 1e-12);
    assert!((found.bending - 2.0 * PI / r).abs() < 1e-12);
    assert!(found.variation.abs() < 1e-30);
    assert!((found.largest.0 - 1.0 / r).abs() < 1e-15);
    assert!(found.inflections.is_empty() && found.extrema.is_empty() && found.flats.is_empty());
    assert!(found.knuckles.is_empty());
}

#[test]
fn an_ellipse_has_four_extrema() {
    let (a, b) = (5.0f64, 2.0f64);
    let ellipse = ellipse(a, b);
    // From any start.
    for start in [0.0, 0.3, 1.2] {
        let found = findings(&even(start, start + 2.0 * PI, 12), true, 1e-3, &ellipse);
        assert_eq!(found.extrema.len(), 4, "{start}: {:?}", found.extrema);
        assert!(found.inflections.is_empty());
        assert!((found.largest.0 - a / (b * b)).abs() < 5e-2);
        for place in &found.extrema {
            let [x, y] = place.point;
            let on_axis = x.abs().min(y.abs());
            // The place is O(h^4) exact; where the start is the largest of the nodes, it is that node.
            assert!(on_axis < 0.02, "{start}: {place:?}");
        }
    }
    // Half of it, open, cut on the short axis: the end of the long axis is the only extremum inside.
    let half = findings(&even(-0.5 * PI, 0.5 * PI, 6), false, 1e-3, &ellipse);
    assert_eq!(half.extrema.len(), 1);
    assert!((half.extrema[0].point[0] - a).abs() < 1e-6 && half.extrema[0].point[1].abs() < 1e-4);
    // int (d kappa / ds)^2 ds by a fine rule.
    let fine: f64 = (0..20_000)
        .map(|k| {
            let l = ellipse(2.0 * PI * (f64::from(k) + 0.5) / 20_000.0);
            l.slope * l.slope * l.velocity[0].hypot(l.velocity[1]) * 2.0 * PI / 20_000.0
        })
        .sum();
    let found = findings(&even(0.0, 2.0 * PI, 24), true, 1e-3, &ellipse);
    assert!((found.variation - fine).abs() < 1e-7 * fine, "{} {fine}", found.variation);
}

/// Monotone pieces of curvature, total variation over its range: an arc of a circle, parts of an ellipse, a sine.
#[test]
fn monotone_pieces_of_curves_in_closed_form() {
    let count = |ends: &[f64], local: &dyn Fn(f64) -> Local| {
        let spans: Vec<[f64; 2]> = ends.windows(2).map(|pair| [pair[0], pair[1]]).collect();
        Counts::of(&[Profile::sample(&spans, false, |t| Some(local(t))).expect("a curve")], 1e-3)
    };
    let arc = count(&even(0.0, 2.0, 3), &ellipse(3.0, 3.0));
    assert_eq!((arc.inflections, arc.pieces, arc.variation), (0, 1, None));
    for (to, pieces) in [(0.5 * PI, 1), (PI, 2), (1.5 * PI, 3)] {
        let part = count(&even(0.0, to, 9), &ellipse(5.0, 2.0));
        assert_eq!((part.inflections, part.pieces), (0, pieces), "{to}");
        assert!((part.variation.unwrap() - pieces as f64).abs() < 1e-6, "{part:?}");
    }
    // Half waves of 6 m that depart by 10 mm, from crest to crest; with ripples of 2 um, 40 to a half wave.
    let (wave, amplitude) = (PI / 6.0, 0.01);
    for n in 1..8 {
        let ends = even(0.0, 6.0 * f64::from(n), 8 * n as usize);
        let sine = |x: f64, a: f64, w: f64| {
            let (s, c) = (w * x).sin_cos();
            [a * c, -a * w * s, -a * w * w * c, a * w.powi(3) * s]
        };
        let plain = count(&ends, &|x| graph(x, sine(x, amplitude, wave)));
        let rough = count(&even(0.0, 6.0 * f64::from(n), 40 * n as usize), &|x| {
            let (a, b) = (sine(x, amplitude, wave), sine(x, 2e-6, 40.0 * wave));
            graph(x, [0, 1, 2, 3].map(|k| a[k] + b[k]))
        });
        assert_eq!((plain.inflections, plain.pieces), (n as usize, n as usize));
        assert_eq!((rough.inflections, rough.pieces), (n as usize, n as usize));
        assert!((plain.variation.unwrap() - f64::from(n)).abs() < 1e-3, "{plain:?}");
        assert!(rough.variation.unwrap() > 3.0 * f64::from(n), "{rough:?}");
    }
}

/// Ellipsoids are synclastic; Wigley's y = (B/2)(1 - s^2)(1 - w^2) has the sign of (1 - s^2)(1 - w^2) - 4 s^2 w^2, which
/// turns toward both ends of the keel; a box is developable.
#[test]
fn regions_of_gaussian_curvature_in_closed_form() {
    let ellipsoid = analytic::ellipsoid("ellipsoid", &dimensions(40.0, 10.0, 4.0)).unwrap().hull;
    let wigley = analytic::wigley("Wigley", &dimensions(100.0, 10.0, 6.25)).unwrap().hull;
    let block = analytic::rectangular_box("box", &dimensions(40.0, 8.0, 5.0)).unwrap().hull;
    let count = |hull: &Hull| gaussian_regions(hull, 2e-3);
    assert_eq!([count(&ellipsoid), count(&wigley), count(&block)], [1, 3, 0]);
    assert_eq!(gaussian_regions(&wigley, 1e3), 0);
}

#[test]
fn a_straight_and_an_arc() {
    // 4 m straight, a quarter of a circle of 2 m, 3 m straight: two flats, no inflection, one extremum (the arc).
    let r = 2.0;
    let quarter = 0.5 * PI * r;
    let local = |s: f64| {
        if s < 4.0 {
            Local { point: [s, 0.0], velocity: [1.0, 0.0], curvature: 0.0, slope: 0.0 }
        } else if s < 4.0 + quarter {
            let t = (s - 4.0) / r;
            let point = [4.0 + r * t.sin(), r * (1.0 - t.cos())];
            Local { point, velocity: [t.cos(), t.sin()], curvature: 1.0 / r, slope: 0.0 }
        } else {
            let point = [4.0 + r, r + s - 4.0 - quarter];
            Local { point, velocity: [0.0, 1.0], curvature: 0.0, slope: 0.0 }
        }
    };
    let found = findings(&[0.0, 4.0, 4.0 + quarter, 7.0 + quarter], false, 1e-3, local);
    assert!((found.length - 7.0 - quarter).abs() < 1e-9);
    assert!((found.bending - quarter / (r * r)).abs() < 1e-6);
    assert_eq!(found.inflections.len(), 0);
    assert_eq!(found.extrema.len(), 1);
    assert_eq!(found.flats.len(), 2, "{:?}", found.flats);
    let lengths: Vec<f64> = found.flats.iter().map(|flat| flat.to.s - flat.from.s).collect();
    assert!((lengths[0] - 4.0).abs() < 1e-5 && (lengths[1] - 3.0).abs() < 1e-5, "{lengths:?}");
}

#[test]
fn a_reversed_bend_through_a_flat_has_its_inflection_in_the_middle_of_the_flat() {
    // Arc to the left, 6 m straight with curvature noise of 1e-9, arc to the right.
    let (r, arc) = (5.0, 2.0);
    let turn: f64 = arc / r;
    let (c, s) = (turn.cos(), turn.sin());
    let corner = [r * s, r * (1.0 - c)];
    let local = |t: f64| {
        if t < arc {
            let a = t / r;
            let point = [r * a.sin(), r * (1.0 - a.cos())];
            Local { point, velocity: [a.cos(), a.sin()], curvature: 1.0 / r, slope: 0.0 }
        } else if t < arc + 6.0 {
            let d = t - arc;
            let point = [corner[0] + d * c, corner[1] + d * s];
            Local { point, velocity: [c, s], curvature: 1e-9 * (7.0 * d).cos(), slope: -7e-9 * (7.0 * d).sin() }
        } else {
            let a = turn - (t - arc - 6.0) / r;
            let start = [corner[0] + 6.0 * c, corner[1] + 6.0 * s];
            let point = [start[0] + r * (s - a.sin()), start[1] - r * (c - a.cos())];
            Local { point, velocity: [a.cos(), a.sin()], curvature: -1.0 / r, slope: 0.0 }
        }
    };
    let found = findings(&[0.0, arc, arc + 6.0, 2.0 * arc + 6.0], false, 1e-3, local);
    assert_eq!((found.inflections.len(), found.flats.len()), (1, 1), "{found:?}");
    assert!((found.inflections[0].s - arc - 3.0).abs() < 1e-4, "{:?}", found.inflections);
}

#[test]
fn a_cubic_has_one_inflection() {
    let found = findings(&[-2.0, 0.3, 1.5], false, 1e-4, |x| graph(x, [x.powi(3), 3.0 * x * x, 6.0 * x, 6.0]));
    assert_eq!(found.inflections.len(), 1);
    assert!(found.inflections[0].point[0].abs() < 1e-3, "{:?}", found.inflections);
    // The extrema of x^3 are where 45 x^4 = 1 (its curvature's derivative vanishes).
    assert_eq!(found.extrema.len(), 2);
    for place in &found.extrema {
        assert!((place.point[0].abs() - 45f64.powf(-0.25)).abs() < 5e-3, "{place:?}");
    }
}

#[test]
fn a_clothoid_has_the_energies_of_its_curvature() {
    // kappa = a s: int kappa^2 = a^2 L^3 / 3, int kappa'^2 = a^2 L.
    let (a, length) = (0.02f64, 12.0f64);
    let heading = |s: f64| 0.5 * a * s * s;
    let simpson = |f: &dyn Fn(f64) -> f64, to: f64| {
        let h = to / 400.0;
        (0..=400usize)
            .map(|k| [1.0, 4.0, 2.0][if k == 0 || k == 400 { 0 } else { 1 + (k + 1) % 2 }] * f(k as f64 * h))
            .sum::<f64>()
            * h
            / 3.0
    };
    let found = findings(&even(0.0, length, 3), false, 1e-4, |s| Local {
        point: [simpson(&|t| heading(t).cos(), s), simpson(&|t| heading(t).sin(), s)],
        velocity: [heading(s).cos(), heading(s).sin()],
        curvature: a * s,
        slope: a,
    });
    assert!((found.bending - a * a * length.powi(3) / 3.0).abs() < 1e-6);
    assert!((found.variation - a * a * length).abs() < 1e-9);
    assert!((found.length - length).abs() < 1e-6);
    assert!(found.extrema.is_empty());
}

#[test]
fn a_knuckle_splits_the_curve() {
    // Two arcs that meet at 20 degrees: convex, knuckle, convex.
    let local = |t: f64| {
        let (side, a) = if t < 1.0 { (0.0, t) } else { (1.0, t + 20f64.to_radians()) };
        let joint = [1f64.sin(), 1.0 - 1f64.cos()];
        let start = 1.0 + 20f64.to_radians();
        let point = if side < 0.5 {
            [a.sin(), 1.0 - a.cos()]
        } else {
            [joint[0] + a.sin() - start.sin(), joint[1] - a.cos() + start.cos()]
        };
        Local { point, velocity: [a.cos(), a.sin()], curvature: 1.0, slope: 0.0 }
    };
    let found = findings(&[0.0, 1.0, 2.0], false, 1e-4, local);
    assert_eq!((found.knuckles.len(), found.inflections.len()), (1, 0));
    assert!((found.knuckles[0].point[0] - 1f64.sin()).abs() < 1e-6);
}

proptest! {
    /// Sine waves: every inflection is found when a lobe can be seen, none when the wave cannot.
    #[test]
    fn sines_have_the_inflections_that_can_be_seen(
        logarithm in -2.0f64..1.5, wave in 0.3f64..1.2, waves in 2u32..9, offset in 0.0f64..0.2, spans in 11usize..40,
    ) {
        let amplitude = 10f64.powf(logarithm);
        let tolerance = 0.1;
        // Seen: the half lobes at the ends depart by 0.21 of the amplitude. Not seen: the chords of all lobes together
        // are at most two amplitudes away.
        prop_assume!(0.2 * amplitude > 1.1 * tolerance || 2.0 * amplitude < 0.9 * tolerance);
        let ends = even(0.5 * PI / wave, (0.5 + f64::from(waves)) * PI / wave, spans + 6 * waves as usize);
        let found = findings(&ends, false, tolerance, |x| {
            let (s, c) = (wave * x).sin_cos();
            let w = wave;
            graph(x + offset, [amplitude * s, amplitude * w * c, -amplitude * w * w * s, -amplitude * w.powi(3) * c])
        });
        if amplitude > tolerance {
            prop_assert_eq!(found.inflections.len(), waves as usize);
            for (k, place) in found.inflections.iter().enumerate() {
                let x = f64::from(k as u32 + 1) * PI / wave + offset;
                prop_assert!((place.point[0] - x).abs() < 1e-2, "{} {}", place.point[0], x);
            }
            // A crest between every two inflections, and none at the ends.
            prop_assert_eq!(found.extrema.len(), waves as usize - 1);
        } else {
            prop_assert_eq!(found.inflections.len(), 0);
            prop_assert_eq!(found.flats.len(), 1);
        }
    }
}

fn dimensions(length: f64, breadth: f64, draught: f64) -> Dimensions {
    Dimensions { length, breadth, draught, depth: draught }
}

fn at<'a>(
    inspection: &'a Inspection,
    word: &'a str,
) -> impl Iterator<Item = &'a loftsman::internals::fairing::inspect::CurveReport> {
    inspection.curves.iter().filter(move |curve| kind(&curve.cut) == word)
}

#[test]
fn a_wigley_hull_has_no_inflection() {
    let (l, b, t) = (100.0, 10.0, 6.25);
    let hull = analytic::wigley("Wigley", &Dimensions { depth: 9.0, ..dimensions(l, b, t) }).unwrap().hull;
    let planes =
        Planes { stations: even(5.0, 95.0, 9), waterlines: vec![1.25, 2.5, 3.75, 5.0, 6.25], ..Planes::default() };
    let inspection = Inspection::new(&hull, &planes, 1e-3);
    assert!(inspection.empty.is_empty());
    assert_eq!(inspection.curves.len(), 15);
    for curve in &inspection.curves {
        assert!(curve.inflections.is_empty() && curve.knuckles.is_empty(), "{curve:?}");
        assert!(curve.largest.value > 0.0, "convex outward is positive: {curve:?}");
    }
    for curve in at(&inspection, "waterline") {
        let Cut::Waterline { z } = curve.cut else { unreachable!() };
        let zeta = 1.0 - z / t;
        let height = 0.5 * b * (1.0 - zeta * zeta);
        // The parabola y = height (1 - (2 x / l)^2): kappa = 8 height / l^2 on top, and its length in closed form.
        assert!((curve.largest.value - 8.0 * height / (l * l)).abs() < 1e-9, "{curve:?}");
        assert!((curve.largest.at[0] - 50.0).abs() < 1.0);
        let q: f64 = 4.0 * height / l;
        let length = 0.5 * l * ((1.0 + q * q).sqrt() + q.asinh() / q);
        assert!((curve.length - length).abs() < 1e-8, "{} {length}", curve.length);
        // int kappa^2 ds = int y''^2 (1 + y'^2)^(-5/2) dx, with y' = p: (8 h / l^2) [p/(3 w^3) + 2p/(3 w)], w =
        // sqrt(1 + p^2).
        let w = (1.0 + q * q).sqrt();
        let energy = 8.0 * height / (l * l) * 2.0 * (q / (3.0 * w.powi(3)) + 2.0 * q / (3.0 * w));
        assert!((curve.bending - energy).abs() < 1e-9, "{} {energy}", curve.bending);
        // Steps between stations 10 m apart: largest where kappa falls fastest.
        let kappa = |x: f64| {
            let p = 8.0 * height / (l * l) * (x - 50.0);
            8.0 * height / (l * l) / (1.0 + p * p).powf(1.5)
        };
        let step = even(5.0, 95.0, 9).windows(2).map(|p| (kappa(p[1]) - kappa(p[0])).abs()).fold(0.0, f64::max);
        assert!((curve.step.unwrap() - step).abs() < 1e-6 * step.max(1e-3), "{:?} {step}", curve.step);
    }
    for curve in at(&inspection, "station") {
        let Cut::Station { x } = curve.cut else { unreachable!() };
        let xi = 2.0 * x / l - 1.0;
        let height = 0.5 * b * (1.0 - xi * xi);
        // z from the keel, y = height (1 - (1 - z/t)^2): the vertex, with the largest curvature, is at the draught.
        assert!((curve.largest.value - 2.0 * height / (t * t)).abs() < 1e-7, "{curve:?}");
    }
}

#[test]
fn a_hemisphere_has_circles_and_one_gaussian_curvature() {
    let r = 6.0;
    let hull = analytic::ellipsoid("hemisphere", &dimensions(2.0 * r, 2.0 * r, r)).unwrap().hull;
    let planes = Planes {
        stations: vec![3.0, 6.0, 8.0],
        waterlines: vec![2.0, 4.0],
        buttocks: vec![1.5, 3.0],
        diagonals: vec![5.0],
        diagonal_angle: 0.7,
        others: vec![Cut::Plane { normal: [0.3, 1.0, 0.4], offset: 6.0 }],
    };
    let inspection = Inspection::new(&hull, &planes, 2e-3);
    assert_eq!(inspection.curves.len(), 9, "{:?}", inspection.empty);
    for curve in &inspection.curves {
        // The section of a sphere is a circle.
        let (normal, offset) = curve.cut.plane().unwrap();
        let away = offset - normal[0] * r - normal[2] * r;
        let radius = (r * r - away * away).sqrt();
        let mean = curve.turning / curve.length;
        assert!((mean * radius - 1.0).abs() < 2e-3, "{:?} {mean} {radius}", curve.cut);
        assert!((curve.largest.value * radius - 1.0).abs() < 5e-2, "{:?} {:?} {radius}", curve.cut, curve.largest);
        assert!(curve.inflections.is_empty() && curve.flats.is_empty(), "{curve:?}");
    }
    let surface = &inspection.surface;
    assert!((surface.area - PI * r * r).abs() < 1e-2, "{}", surface.area);
    // k1^2 + k2^2 = 2 / r^2 over half a hemisphere of area pi r^2.
    assert!((surface.bending - 2.0 * PI).abs() < 2e-2, "{}", surface.bending);
    let gaussian = surface.ranges.iter().find(|range| range.name == "gaussian").unwrap();
    assert!(gaussian.least.value > 0.0);
}

#[test]
fn a_box_is_flat() {
    let hull = analytic::rectangular_box("box", &dimensions(40.0, 8.0, 5.0)).unwrap().hull;
    let planes = Planes { waterlines: vec![1.0, 3.0], stations: vec![10.0, 20.0], ..Planes::default() };
    let inspection = Inspection::new(&hull, &planes, 2e-3);
    assert_eq!(inspection.curves.len(), 4);
    for curve in &inspection.curves {
        assert_eq!((curve.inflections.len(), curve.flats.len(), curve.extrema.len()), (0, 1, 0), "{curve:?}");
        assert!((curve.flats[0].length - curve.length).abs() < 1e-5);
        assert!(curve.bending < 1e-20);
    }
    assert!(inspection.net.iter().all(|line| line.changes == 0 && line.enclosed == 0));
}

/// y = b(z) f(|2x/L - 1|) with the cosine kernel f(t) = 1 - (1 - cos a t) / (1 - cos a), a^2 = 8 on the keel and 1 at
/// the top.
fn hollow() -> Hull {
    let (u, v) = (KnotVector::uniform(3, 80).unwrap(), KnotVector::uniform(3, 16).unwrap());
    let (su, sv) = (u.greville(), v.greville());
    let (cu, cv) = (Collocation::new(&u, &su).unwrap(), Collocation::new(&v, &sv).unwrap());
    let mut y: Vec<f64> = su.iter().flat_map(|&p| sv.iter().map(move |&q| half_breadth(100.0 * p, 6.0 * q))).collect();
    cu.solve_tensor(&cv, &mut y);
    let points = su
        .iter()
        .flat_map(|&p| sv.iter().map(move |&q| [100.0 * p, 0.0, 6.0 * q]))
        .zip(y)
        .map(|(p, y)| [p[0], y, p[2]])
        .collect();
    let deck = BsplineCurve::new(KnotVector::uniform(1, 1).unwrap(), vec![[0.0, 6.0], [100.0, 6.0]]).unwrap();
    let particulars =
        PrincipalParticulars { length_between_perpendiculars: 100.0, breadth: 10.0, draught: Some(5.0), depth: 6.0 };
    Hull::new("hollow", particulars, BsplineSurface::new(u, v, points).unwrap(), deck).unwrap()
}

fn wave(z: f64) -> f64 {
    (8.0 - 7.0 * z / 6.0).sqrt()
}

fn half_breadth(x: f64, z: f64) -> f64 {
    let (a, t) = (wave(z), (x / 50.0 - 1.0).abs());
    (2.0 + 0.5 * z) * (1.0 - (1.0 - (a * t).cos()) / (1.0 - a.cos()))
}

#[test]
fn hollow_waterlines_turn_where_the_cosine_does() {
    let hull = hollow();
    let planes = Planes { waterlines: vec![0.5, 1.5, 2.5, 3.5, 5.5], ..Planes::default() };
    let inspection = Inspection::new(&hull, &planes, 5e-3);
    for curve in at(&inspection, "waterline") {
        let Cut::Waterline { z } = curve.cut else { unreachable!() };
        // One inflection an end at t = pi / (2 a), when that is inside.
        let t = 0.5 * PI / wave(z);
        if t < 1.0 {
            assert_eq!(curve.inflections.len(), 2, "{z}: {:?}", curve.inflections);
            for (place, x) in curve.inflections.iter().zip([50.0 * (1.0 - t), 50.0 * (1.0 + t)]) {
                assert!((place[0] - x).abs() < 0.01, "{z}: {} {x}", place[0]);
            }
        } else {
            assert!(curve.inflections.is_empty(), "{z}: {:?}", curve.inflections);
        }
    }
    // The rows of the net say the same.
    for row in inspection.net.iter().filter(|line| line.line.as_str() == "row") {
        assert_eq!(row.enclosed, 0, "{row:?}");
        assert!(row.changes == 0 || row.changes == 2, "{row:?}");
    }
}

#[test]
fn a_bulk_carrier_has_flat_sides_and_few_inflections() {
    let requested = DesignTargets {
        ship_type: Some(loftsman::internals::parametric::ShipType::BulkCarrier),
        length: 217.0,
        breadth: Some(32.25),
        draught: Some(12.2),
        block_coefficient: Some(0.80),
        midship_coefficient: Some(MidshipTarget::Value(0.99)),
        ..DesignTargets::default()
    };
    let hull = cosh::generate("bulk carrier", &requested).unwrap().hull;
    let resolution = Resolution::for_length(217.0);
    assert!((resolution.tolerance() - 0.01).abs() < 1e-15);
    let inspection = Inspection::new(&hull, &Planes::with_defaults(&hull), resolution.tolerance());
    let parallel: Vec<_> = at(&inspection, "waterline").filter(|c| c.flats.iter().any(|f| f.length > 60.0)).collect();
    assert!(parallel.len() > 5, "flat sides: {}", parallel.len());
    for curve in at(&inspection, "waterline") {
        assert!(curve.inflections.len() <= 2, "{curve:?}");
    }
    for curve in at(&inspection, "station") {
        assert!(curve.inflections.len() <= 2, "{curve:?}");
    }
    // Amidships: flat of bottom apart, bilge, flat of side.
    let Some(midship) =
        at(&inspection, "station").find(|c| matches!(c.cut, Cut::Station { x } if (x - 108.5).abs() < 1e-9))
    else {
        panic!("no midship section")
    };
    assert_eq!(midship.inflections.len(), 0, "{midship:?}");
    assert!(!midship.flats.is_empty(), "{midship:?}");
}

#[test]
fn what_has_no_breadth_is_not_counted() {
    let hull = analytic::wigley("Wigley", &Dimensions { depth: 9.0, ..dimensions(100.0, 10.0, 6.25) }).unwrap().hull;
    // Half-breadths at x = 0.01 m stay below 5 (1 - 0.9998^2) = 2 mm, at x = 5 m they reach 0.95 m.
    let planes = Planes { stations: vec![0.01, 5.0], waterlines: vec![6.25], ..Planes::default() };
    let inspection = Inspection::new(&hull, &planes, 1e-3);
    assert_eq!(inspection.narrow, [Cut::Station { x: 0.01 }]);
    assert!(inspection.empty.is_empty());
    assert_eq!(inspection.curves.len(), 2);
    assert!(inspection.curves.iter().all(|curve| curve.without_breadth.abs() < 1e-12), "fine ends stay");
    // The end station of this table lies on the centreplane up to 6.5 m.
    let table = carried("tests/data/series60_cb060/offsets.csv");
    let hull = loftsman::internals::report::read_source(&table).unwrap().hull;
    let planes = Planes { stations: vec![121.92], waterlines: vec![2.0, 4.0], ..Planes::default() };
    let inspection = Inspection::new(&hull, &planes, 5e-3);
    let end = at(&inspection, "station").next().expect("the part above has breadth");
    assert!(end.without_breadth > 5.0 && end.length < 4.0, "{} {}", end.without_breadth, end.length);
    assert!(end.bending < 1.0 && end.variation < 1.0, "{} {}", end.bending, end.variation);
}

/// Waterlines of the Wigley hull are parabolas y = a (1 - (2 x/L)^2): kappa = 8 a / L^2 amidships, on the convex side
/// outward.
#[test]
fn a_parabola_has_its_curvature_outward() {
    let dimensions = loftsman::internals::parametric::analytic::Dimensions {
        length: 100.0,
        breadth: 10.0,
        draught: 6.25,
        depth: 6.25,
    };
    let hull = loftsman::internals::parametric::analytic::wigley("Wigley", &dimensions).unwrap().hull;
    let found = loftsman::internals::fairing::inspect::combs(
        &hull,
        &[loftsman::internals::hull::Cut::Waterline { z: 6.25 }, loftsman::internals::hull::Cut::Station { x: 50.0 }],
        41,
        1e-3,
    );
    assert_eq!(found.len(), 2);
    let middle = found[0].teeth[20];
    assert!((middle.at[0] - 50.0).abs() < 0.05, "{middle:?}");
    assert!((middle.tooth[1] - 8.0 * 5.0 / 1e4).abs() < 1e-6 && middle.tooth[0].abs() < 1e-5, "{middle:?}");
    for comb in &found {
        assert!(comb.inflections.is_empty() && comb.teeth.len() == 41);
        assert!(comb.teeth.iter().all(|tooth| tooth.tooth[1] > 0.0), "{:?}", comb.cut);
    }
}

/// Curvatures of y = (B/2) (1 - (2x/L - 1)^2) (1 - (1 - z/T)^2) as a graph over the centreplane: K = (y_xx y_zz -
/// y_xz^2) / (1 + y_x^2 + y_z^2)^2 and H = -((1 + y_z^2) y_xx - 2 y_x y_z y_xz + (1 + y_x^2) y_zz) / (2 (1 + y_x^2 +
/// y_z^2)^(3/2)).
#[test]
fn maps_of_the_wigley_hull_have_its_curvature_and_girth() {
    let dimensions = Dimensions { length: 100.0, breadth: 10.0, draught: 6.25, depth: 9.0 };
    let hull = analytic::wigley("Wigley", &dimensions).unwrap().hull;
    for map in [SurfaceMap::new(&hull, 31, 17), SurfaceMap::at_stations(&hull, 31, 17)] {
        // The wall above T begins at a line of the surface: it has rows of its own on the map over stations.
        assert_eq!((map.columns(), map.points.len()), (31, 31 * map.rows));
        assert!((17..=20).contains(&map.rows), "{}", map.rows);
        let mut compared = 0;
        for point in map.points.iter().filter(|p| p.at[2] < 6.2 && p.at[0] > 1.0 && p.at[0] < 99.0) {
            let [x, y, z] = point.at;
            let (s, t) = (2.0 * x / 100.0 - 1.0, 1.0 - z / 6.25);
            let (a, b) = (1.0 - s * s, 1.0 - t * t);
            assert!((y - 5.0 * a * b).abs() < 1e-9, "{point:?}");
            let (ax, bz) = (-4.0 * s / 100.0, 2.0 * t / 6.25);
            let (yx, yz, yxz) = (5.0 * ax * b, 5.0 * a * bz, 5.0 * ax * bz);
            let (yxx, yzz) = (5.0 * b * -8.0 / 1e4, 5.0 * a * -2.0 / (6.25 * 6.25));
            let w = 1.0 + yx * yx + yz * yz;
            let gaussian = (yxx * yzz - yxz * yxz) / (w * w);
            let mean = -((1.0 + yz * yz) * yxx - 2.0 * yx * yz * yxz + (1.0 + yx * yx) * yzz) / (2.0 * w.powf(1.5));
            let [k, h] = point.curvature.unwrap();
            assert!((k - gaussian).abs() < 1e-9 && (h - mean).abs() < 1e-9, "{point:?}: {gaussian} {mean}");
            let normal = point.normal.unwrap();
            assert!((normal[1] - 1.0 / w.sqrt()).abs() < 1e-9 && (normal[0] + yx / w.sqrt()).abs() < 1e-9, "{point:?}");
            compared += 1;
        }
        assert!(compared > 150, "{compared}");
    }
    // The girth of the midship section: the length of the parabola y = 5 (1 - t^2) with z = 6.25 (1 - t), and the wall
    // above it.
    let map = SurfaceMap::at_stations(&hull, 31, 17);
    let middle = map.point(15, map.rows - 1);
    let slope: f64 = 1.6;
    let parabola = 6.25 * 0.5 * ((1.0 + slope * slope).sqrt() + slope.asinh() / slope);
    let above = middle.at[2] - 6.25;
    assert!((middle.girth - parabola - above).abs() < 2e-3, "{} {}", middle.girth, parabola + above);
}
