//! Hydrostatics of half cylinders and ellipsoids against their closed forms.

use loftsman::internals::hull::Hull;
use std::f64::consts::{FRAC_PI_2, PI};

use crate::analytic_bodies::{Closed, Product, check, interpolate, knots};

/// Area of the segment of height h of a circle of radius r, and its moment about the bottom of the circle.
fn segment(r: f64, h: f64) -> [f64; 2] {
    let c = r - h;
    let half = (r * r - c * c).max(0.0).sqrt();
    let area = r * r * (c / r).acos() - c * half;
    [area, r * area - 2.0 / 3.0 * half.powi(3)]
}

/// Sections are the lower halves of circles with their centre in the deck.
#[test]
fn half_cylinder_lying_along_x() {
    let (l, r) = (50.0f64, 4.0f64);
    let (u, v) = (knots(3, 0.0, l, 5), knots(7, 0.0, FRAC_PI_2, 12));
    let hull = Product {
        along: u.greville(),
        stretch: vec![1.0; v.basis_count()],
        origin: 0.0,
        breadth_along: vec![r; u.basis_count()],
        breadth_up: interpolate(&v, f64::sin),
        heights: interpolate(&v, |t| r * (1.0 - t.cos())),
        u,
        v,
    }
    .hull(l, 2.0 * r, r);
    check("half cylinder", &hull, &[4.0, 1.0, 2.0, 3.5, 0.5], |t| {
        let [section, moment] = segment(r, t);
        let y = (t * (2.0 * r - t)).sqrt();
        Closed {
            volume: section * l,
            aft: 0.5 * section * l,
            xb: 0.5 * l,
            kb: moment / section,
            area: 2.0 * y * l,
            xf: 0.5 * l,
            transverse: 2.0 / 3.0 * y.powi(3) * l,
            longitudinal: 2.0 * y * l.powi(3) / 12.0,
            surface: 2.0 * r * (1.0 - t / r).acos() * l + 2.0 * section,
            length: l,
            breadth: 2.0 * y,
            midship: section,
            largest: section,
            place: 0.5 * l,
            parallel: Some([0.0, l]),
            lateral: l * t,
            lateral_x: 0.5 * l,
            lateral_z: 0.5 * t,
            transom: section,
            ..Closed::default()
        }
    });
}

/// The profile is the lower half of a circle, the breadth constant; no line in u is vertical but the middle one.
#[test]
fn half_cylinder_lying_along_y() {
    let (r, b) = (6.0f64, 5.0f64);
    let (u, v) = (knots(3, -1.0, 1.0, 3), knots(7, 0.0, FRAC_PI_2, 12));
    let mut stretch = interpolate(&v, |t| r * t.sin());
    stretch[0] = 0.0;
    let hull = Product {
        along: u.greville(),
        stretch,
        origin: r,
        breadth_along: vec![0.5 * b; u.basis_count()],
        breadth_up: vec![1.0; v.basis_count()],
        heights: interpolate(&v, |t| r * (1.0 - t.cos())),
        u,
        v,
    }
    .hull(2.0 * r, b, r);
    check("transverse half cylinder", &hull, &[6.0, 3.0, 1.2, 5.0], |t| {
        let [profile, moment] = segment(r, t);
        let half = (t * (2.0 * r - t)).sqrt();
        Closed {
            volume: profile * b,
            aft: 0.5 * profile * b,
            xb: r,
            kb: moment / profile,
            area: 2.0 * half * b,
            xf: r,
            transverse: 2.0 * half * b.powi(3) / 12.0,
            longitudinal: b * (2.0 * half).powi(3) / 12.0,
            surface: 2.0 * profile + 2.0 * r * (1.0 - t / r).acos() * b,
            length: 2.0 * half,
            breadth: b,
            midship: b * t,
            largest: b * t,
            place: r,
            lateral: profile,
            lateral_x: r,
            lateral_z: moment / profile,
            transom: b * t,
            ..Closed::default()
        }
    });
}

/// The lower part, up to the angle `top` from the keel, of an ellipsoid that touches x = 0 and z = 0.
pub(crate) fn ellipsoid([a, b, c]: [f64; 3], top: f64, length: f64) -> Hull {
    let (u, v) = (knots(7, -FRAC_PI_2, FRAC_PI_2, 25), knots(7, 0.0, top, 17));
    let mut breadth_along = interpolate(&u, |t| b * t.cos());
    let last = breadth_along.len() - 1;
    (breadth_along[0], breadth_along[last]) = (0.0, 0.0);
    let mut stretch = interpolate(&v, f64::sin);
    stretch[0] = 0.0;
    Product {
        along: interpolate(&u, |t| a * t.sin()),
        breadth_up: stretch.clone(),
        stretch,
        origin: a,
        breadth_along,
        heights: interpolate(&v, |t| c * (1.0 - t.cos())),
        u,
        v,
    }
    .hull(length, 2.0 * b, c)
}

/// Closed forms of a cap of height t; `surface` is the wetted surface there, midship at `middle`.
fn cap([a, b, c]: [f64; 3], t: f64, middle: f64, surface: f64) -> Closed {
    let h = t / c;
    let volume = PI * a * b * c * h * h * (1.0 - h / 3.0);
    // Scale of the waterplane against the equator, squared.
    let w2 = h * (2.0 - h);
    let w = w2.sqrt();
    let area = PI * a * b * w2;
    // Sections at x are segments of similar ellipses.
    let section = |x: f64| {
        let s = (1.0 - ((x - a) / a).powi(2)).max(0.0).sqrt();
        let depth = t - c * (1.0 - s);
        if depth <= 0.0 { 0.0 } else { b / c * segment(c * s, depth)[0] }
    };
    // Part of the volume aft of `middle`: the sections integrated with the place as an angle from the waterline's middle.
    let n = 4000u32;
    let (mut aft, reach) = (0.0, a * w);
    let end = ((middle - a) / reach).clamp(-1.0, 1.0).asin();
    for k in 0..n {
        let place = |s: f64| -FRAC_PI_2 + (end + FRAC_PI_2) * s;
        let value = |s: f64| section(a + reach * place(s).sin()) * reach * place(s).cos() * (end + FRAC_PI_2);
        let (p, q) = (f64::from(k) / f64::from(n), f64::from(k + 1) / f64::from(n));
        aft += (value(p) + 4.0 * value(0.5 * (p + q)) + value(q)) / (6.0 * f64::from(n));
    }
    let [profile, moment] = segment(c, t);
    Closed {
        volume,
        aft,
        xb: a,
        kb: c * (h * (8.0 - 3.0 * h)) / (4.0 * (3.0 - h)),
        area,
        xf: a,
        transverse: PI / 4.0 * a * b.powi(3) * w2 * w2,
        longitudinal: PI / 4.0 * b * a.powi(3) * w2 * w2,
        surface,
        length: 2.0 * a * w,
        breadth: 2.0 * b * w,
        midship: section(middle),
        largest: section(a),
        place: a,
        entrance: 90.0,
        run: 90.0,
        lateral: a / c * profile,
        lateral_x: a,
        lateral_z: moment / profile,
        ..Closed::default()
    }
}

#[test]
fn sphere() {
    let r = 3.0;
    let hull = ellipsoid([r; 3], 0.75 * PI, 2.0 * r);
    check("sphere", &hull, &[3.0, 1.0, 0.3, 4.5, 5.0], |t| {
        let mut closed = cap([r; 3], t, r, 2.0 * PI * r * t);
        if t > r {
            // Above the equator the profile is longer than the waterline; only the halving by symmetry is needed.
            closed.aft = 0.5 * closed.volume;
        }
        closed
    });
}

#[test]
fn prolate_spheroid_floating_at_its_equator() {
    let (a, b) = (12.0f64, 3.0f64);
    let hull = ellipsoid([a, b, b], FRAC_PI_2, 2.0 * a);
    let e = (1.0 - (b / a).powi(2)).sqrt();
    check("spheroid", &hull, &[3.0], |t| cap([a, b, b], t, a, PI * b * b * (1.0 + a / (b * e) * e.asin())));
}

/// Midship is not at the largest section, and the lines in u are not vertical.
#[test]
fn ellipsoid_with_midship_aft_of_the_largest_section() {
    let axes = [12.0, 4.0, 3.0];
    let hull = ellipsoid(axes, FRAC_PI_2, 20.0);
    // The wetted surface of three unequal axes has no closed form: Simpson's rule in the angles.
    let surface = |t: f64| {
        let [a, b, c] = axes;
        let (n, top) = (600, (1.0 - t / c).acos());
        let simpson = |k: usize| f64::from(if k == 0 || k == n { 1 } else { 2 + 2 * (k as i32 % 2) });
        let mut sum = 0.0;
        for i in 0..=n {
            for j in 0..=n {
                let (phi, theta) = (FRAC_PI_2 * i as f64 / n as f64, top * j as f64 / n as f64);
                let across = theta.sin() * ((b * c * phi.sin()).powi(2) + (a * c * phi.cos()).powi(2)).sqrt();
                sum += simpson(i) * simpson(j) * theta.sin() * (a * b * theta.cos()).hypot(across);
            }
        }
        4.0 * sum * FRAC_PI_2 * top / (9.0 * (n * n) as f64)
    };
    check("ellipsoid", &hull, &[3.0, 2.0, 0.7], |t| cap(axes, t, 10.0, surface(t)));
}
