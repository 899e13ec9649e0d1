//! Every hydrostatic quantity of bodies with closed forms: box, wedges, half cylinders, Wigley hull, ellipsoids.
//!
//! The bodies are splines that equal the closed shape to about 1e-13 of their size: exactly for the polynomial ones, by
//! interpolation of degree 7 of graded parameters (angles) for the round ones. Tolerance 1e-10 relative, 1e-8 for the
//! wetted surface and what is made of it.

use loftsman::internals::hull::{Functional, Hull, PrincipalParticulars};
use loftsman::internals::hydrostatics::{
    CoefficientLength, Conventions, CurvesOfForm, Hydrostatics, PrismaticSection, QUANTITIES, Shell,
};
use loftsman::internals::spline::{BsplineCurve, BsplineSurface, Collocation, KnotVector};
use std::f64::consts::FRAC_PI_2;

use crate::analytic_round_bodies::ellipsoid;

/// Control values of the spline that interpolates `function` at the Greville abscissae.
pub(crate) fn interpolate(knots: &KnotVector, function: impl Fn(f64) -> f64) -> Vec<f64> {
    let sites = knots.greville();
    let mut values: Vec<f64> = sites.iter().map(|&t| function(t)).collect();
    Collocation::new(knots, &sites).unwrap().solve_strided(&mut values, 0, 1);
    values
}

/// Uniform knots of `spans` spans on [from, to].
pub(crate) fn knots(degree: usize, from: f64, to: f64, spans: usize) -> KnotVector {
    let breaks: Vec<f64> = (0..=spans).map(|k| from + (to - from) * k as f64 / spans as f64).collect();
    KnotVector::from_breakpoints(degree, &breaks, &vec![1; spans - 1]).unwrap()
}

/// A hull from control values: x = origin + s_i t_j, y = b_i c_j, z_j, with a deck at its top.
pub(crate) struct Product {
    pub(crate) u: KnotVector,
    pub(crate) v: KnotVector,
    pub(crate) along: Vec<f64>,
    pub(crate) stretch: Vec<f64>,
    pub(crate) origin: f64,
    pub(crate) breadth_along: Vec<f64>,
    pub(crate) breadth_up: Vec<f64>,
    pub(crate) heights: Vec<f64>,
}

impl Product {
    pub(crate) fn hull(self, length: f64, breadth: f64, draught: f64) -> Hull {
        let mut points = Vec::new();
        for (s, b) in self.along.iter().zip(&self.breadth_along) {
            for ((t, c), z) in self.stretch.iter().zip(&self.breadth_up).zip(&self.heights) {
                points.push([self.origin + s * t, (b * c).max(0.0), *z]);
            }
        }
        let top = self.heights[self.heights.len() - 1];
        let line = KnotVector::uniform(1, 1).unwrap();
        let deck = BsplineCurve::new(line, vec![[-length, top], [2.0 * length, top]]).unwrap();
        let particulars =
            PrincipalParticulars { length_between_perpendiculars: length, breadth, draught: Some(draught), depth: top };
        Hull::new("body", particulars, BsplineSurface::new(self.u, self.v, points).unwrap(), deck).unwrap()
    }
}

/// What the closed forms of a body give; everything else follows from these.
#[derive(Clone, Copy, Default)]
pub(crate) struct Closed {
    pub(crate) volume: f64,
    /// Volume aft of Lpp / 2.
    pub(crate) aft: f64,
    pub(crate) xb: f64,
    pub(crate) kb: f64,
    pub(crate) area: f64,
    pub(crate) xf: f64,
    pub(crate) transverse: f64,
    pub(crate) longitudinal: f64,
    pub(crate) surface: f64,
    pub(crate) length: f64,
    pub(crate) breadth: f64,
    pub(crate) midship: f64,
    pub(crate) largest: f64,
    pub(crate) place: f64,
    pub(crate) entrance: f64,
    pub(crate) run: f64,
    pub(crate) parallel: Option<[f64; 2]>,
    pub(crate) lateral: f64,
    pub(crate) lateral_x: f64,
    pub(crate) lateral_z: f64,
    pub(crate) transom: f64,
}

/// Every quantity, by key.
fn expected(hull: &Hull, draught: f64, c: &Conventions, b: &Closed) -> Vec<(&'static str, Option<f64>)> {
    let p = hull.particulars();
    let (lpp, breadth) = (p.length_between_perpendiculars, p.breadth);
    let length = if c.coefficient_length == CoefficientLength::Waterline { b.length } else { lpp };
    let reference = if c.prismatic_section == PrismaticSection::Midship { b.midship } else { b.largest };
    let extreme = match c.shell {
        Shell::None => b.volume,
        Shell::Factor(f) => f * b.volume,
        Shell::Thickness(t) => b.volume + t * b.surface,
    };
    let (mass, bmt, bml) = (c.density * b.volume, b.transverse / b.volume, b.longitudinal / b.volume);
    let kg = c.centre_of_gravity_height;
    let mtc = mass * kg.map_or(bml, |kg| b.kb + bml - kg) / (100.0 * lpp);
    let [aft, fore] = b.parallel.unwrap_or([b.place; 2]);
    vec![
        ("T", Some(draught)),
        ("TK", Some(draught + c.keel_thickness)),
        ("DISPVOL", Some(b.volume)),
        ("DISPM", Some(mass)),
        ("DISPX", Some(c.density * extreme)),
        ("XCB", Some(b.xb)),
        ("XCBPC", Some((b.xb / lpp - 0.5) * 100.0)),
        ("KB", Some(b.kb)),
        ("AWL", Some(b.area)),
        ("XWL", Some(b.xf)),
        ("TPC", Some(c.density * b.area * 0.01)),
        ("MTC", Some(mtc)),
        ("MTM", Some(mtc * 100.0)),
        ("IT", Some(b.transverse)),
        ("IL", Some(b.longitudinal)),
        ("BMT", Some(bmt)),
        ("BML", Some(bml)),
        ("KMT", Some(b.kb + bmt)),
        ("KML", Some(b.kb + bml)),
        ("GMT", kg.map(|kg| b.kb + bmt - kg)),
        ("GML", kg.map(|kg| b.kb + bml - kg)),
        ("CB", Some(b.volume / length / breadth / draught)),
        ("CM", Some(b.midship / breadth / draught)),
        ("CX", Some(b.largest / breadth / draught)),
        ("CP", Some(b.volume / reference / length)),
        ("CPF", Some((b.volume - b.aft) / reference / length * 2.0)),
        ("CPA", Some(b.aft / reference / length * 2.0)),
        ("CWP", Some(b.area / length / breadth)),
        ("CVP", Some(b.volume / b.area / draught)),
        ("CS", Some(b.surface / (b.volume * length).sqrt())),
        ("S", Some(b.surface)),
        ("LWL", Some(b.length)),
        ("BWL", Some(b.breadth)),
        ("AM", Some(b.midship)),
        ("AX", Some(b.largest)),
        ("XAX", Some(b.place)),
        ("IE", Some(b.entrance).filter(|angle| *angle > 0.0)),
        ("IR", Some(b.run)),
        ("XPA", b.parallel.map(|ends| ends[0])),
        ("XPF", b.parallel.map(|ends| ends[1])),
        ("LE", Some(lpp - fore)),
        ("LP", b.parallel.map(|ends| ends[1] - ends[0])),
        ("LR", Some(aft)),
        ("SLEND", Some(length / b.volume.cbrt())),
        ("DLR", Some(mass / (length / 100.0).powi(3))),
        ("ALV", Some(b.lateral)),
        ("XLV", Some(b.lateral_x)),
        ("ZLV", Some(b.lateral_z)),
        ("AT", Some(b.transom)),
    ]
}

/// Holds every quantity of every draught against its closed form.
pub(crate) fn check(name: &str, hull: &Hull, draughts: &[f64], closed: impl Fn(f64) -> Closed) {
    let plain = Conventions::default();
    let other = Conventions {
        density: 1.0,
        coefficient_length: CoefficientLength::Waterline,
        prismatic_section: PrismaticSection::Midship,
        shell: Shell::Thickness(0.01),
        keel_thickness: 0.02,
        centre_of_gravity_height: Some(0.3),
        ..plain
    };
    let factor = Conventions { shell: Shell::Factor(1.006), ..plain };
    let bodies: Vec<Closed> = draughts.iter().map(|&draught| closed(draught)).collect();
    let mut wrong = Vec::new();
    for conventions in [plain, other, factor] {
        let table = CurvesOfForm::new(hull, draughts, &conventions);
        assert_eq!(table.rows.len(), draughts.len());
        for ((row, &draught), body) in table.rows.iter().zip(draughts).zip(&bodies) {
            let expected = expected(hull, draught, &conventions, body);
            assert_eq!(expected.len(), QUANTITIES.len());
            for quantity in QUANTITIES {
                let (_, wanted) = expected.iter().find(|(key, _)| *key == quantity.key).expect(quantity.key);
                let found = (quantity.value)(row);
                let by_surface = matches!(quantity.key, "S" | "CS")
                    || (quantity.key == "DISPX" && matches!(conventions.shell, Shell::Thickness(_)));
                let relative = if by_surface { 1e-8 } else { 1e-10 };
                // Percentages and places that may be 0 are measured against what they are parts of.
                let size = match quantity.key {
                    "XCBPC" => 100.0,
                    "XPA" | "LE" | "LR" | "XAX" => hull.particulars().length_between_perpendiculars,
                    "IE" | "IR" => 90.0,
                    "CPF" | "CPA" | "AT" | "GMT" => 1.0,
                    _ => 0.0,
                };
                let right = match (found, *wanted) {
                    (Some(found), Some(wanted)) => (found - wanted).abs() <= relative * wanted.abs().max(size),
                    (found, wanted) => found.is_none() && wanted.is_none(),
                };
                if !right {
                    wrong.push(format!("T {draught}, {}: {found:?}, closed form {wanted:?}", quantity.key));
                }
            }
            assert_eq!(row.remark, None);
        }
    }
    assert!(wrong.is_empty(), "{name}:\n{}", wrong.join("\n"));
}

fn rectangle(degree: usize, spans: usize) -> Hull {
    let (length, breadth, depth) = (40.0, 8.0, 5.0);
    let (u, v) = (knots(degree, 0.0, length, spans), knots(degree, 0.0, depth, spans));
    let (m, n) = (u.basis_count(), v.basis_count());
    Product {
        along: u.greville(),
        stretch: vec![1.0; n],
        origin: 0.0,
        breadth_along: vec![0.5 * breadth; m],
        breadth_up: vec![1.0; n],
        heights: v.greville(),
        u,
        v,
    }
    .hull(length, breadth, 3.0)
}

#[test]
fn boxes() {
    for hull in [rectangle(1, 1), rectangle(3, 5)] {
        // 1, 2, 3 and 4 m are knots of the second.
        check("box", &hull, &[2.5, 0.01, 5.0, 1.0, 2.0, 3.0, 4.0, 2.5], |t| {
            let (l, b) = (40.0, 8.0);
            Closed {
                volume: l * b * t,
                aft: 0.5 * l * b * t,
                xb: 0.5 * l,
                kb: 0.5 * t,
                area: l * b,
                xf: 0.5 * l,
                transverse: l * b * b * b / 12.0,
                longitudinal: b * l * l * l / 12.0,
                surface: 2.0 * (l + b) * t + l * b,
                length: l,
                breadth: b,
                midship: b * t,
                largest: b * t,
                place: 0.5 * l,
                parallel: Some([0.0, l]),
                lateral: l * t,
                lateral_x: 0.5 * l,
                lateral_z: 0.5 * t,
                transom: b * t,
                ..Closed::default()
            }
        });
    }
}

/// y = (B/2) z / D: a prism of V sections.
#[test]
fn wedge_of_v_sections() {
    let (l, half, depth) = (30.0f64, 3.0, 4.0);
    let (u, v) = (knots(3, 0.0, l, 4), knots(2, 0.0, depth, 4));
    let hull = Product {
        along: u.greville(),
        stretch: vec![1.0; v.basis_count()],
        origin: 0.0,
        breadth_along: vec![half; u.basis_count()],
        breadth_up: v.greville().iter().map(|z| z / depth).collect(),
        heights: v.greville(),
        u,
        v,
    }
    .hull(l, 2.0 * half, 3.0);
    check("V wedge", &hull, &[3.3, 1.0, 4.0, 0.2], |t| {
        let y: f64 = half * t / depth;
        Closed {
            volume: y * t * l,
            aft: 0.5 * y * t * l,
            xb: 0.5 * l,
            kb: 2.0 / 3.0 * t,
            area: 2.0 * y * l,
            xf: 0.5 * l,
            transverse: 2.0 / 3.0 * y.powi(3) * l,
            longitudinal: 2.0 * y * l.powi(3) / 12.0,
            surface: 2.0 * l * t.hypot(y) + 2.0 * y * t,
            length: l,
            breadth: 2.0 * y,
            midship: y * t,
            largest: y * t,
            place: 0.5 * l,
            parallel: Some([0.0, l]),
            lateral: l * t,
            lateral_x: 0.5 * l,
            lateral_z: 0.5 * t,
            transom: y * t,
            ..Closed::default()
        }
    });
}

/// y = (B/2) (1 - x / L): a wall-sided wedge with its edge forward.
#[test]
fn wedge_of_triangular_waterlines() {
    let (l, half, depth) = (30.0f64, 3.0f64, 4.0);
    let (u, v) = (knots(2, 0.0, l, 5), knots(3, 0.0, depth, 3));
    let hull = Product {
        along: u.greville(),
        stretch: vec![1.0; v.basis_count()],
        origin: 0.0,
        breadth_along: u.greville().iter().map(|x| half * (1.0 - x / l)).collect(),
        breadth_up: vec![1.0; v.basis_count()],
        heights: v.greville(),
        u,
        v,
    }
    .hull(l, 2.0 * half, 3.0);
    check("wall-sided wedge", &hull, &[1.7, 4.0, 4.0 / 3.0], |t| {
        let area = half * l;
        Closed {
            volume: area * t,
            aft: 0.75 * area * t,
            xb: l / 3.0,
            kb: 0.5 * t,
            area,
            xf: l / 3.0,
            transverse: half.powi(3) * l / 6.0,
            longitudinal: half * l.powi(3) / 18.0,
            surface: area + 2.0 * t * l.hypot(half) + 2.0 * half * t,
            length: l,
            breadth: 2.0 * half,
            midship: half * t,
            largest: 2.0 * half * t,
            place: 0.0,
            entrance: (half / l).atan().to_degrees(),
            run: (half / l).atan().to_degrees(),
            lateral: l * t,
            lateral_x: 0.5 * l,
            lateral_z: 0.5 * t,
            transom: 2.0 * half * t,
            ..Closed::default()
        }
    });
}

fn wigley() -> Hull {
    let (l, half, depth) = (100.0, 5.0, 6.25);
    let (u, v) = (knots(3, 0.0, l, 7), knots(3, 0.0, depth, 4));
    Product {
        along: u.greville(),
        stretch: vec![1.0; v.basis_count()],
        origin: 0.0,
        breadth_along: interpolate(&u, |x| half * (1.0 - (2.0 * x / l - 1.0).powi(2))),
        breadth_up: interpolate(&v, |z| 1.0 - (1.0 - z / depth).powi(2)),
        heights: v.greville(),
        u,
        v,
    }
    .hull(l, 2.0 * half, depth)
}

/// y = (B/2) (1 - xi^2) (1 - zeta^2) (Wigley 1942).
#[test]
fn wigley_hull() {
    let (l, half, depth) = (100.0f64, 5.0f64, 6.25f64);
    let hull = wigley();
    check("Wigley", &hull, &[6.25, 3.0, 6.25 / 4.0, 0.5], |t| {
        let s = t / depth;
        let w = 2.0 * s - s * s;
        let section = 2.0 * half * depth * (s * s - s * s * s / 3.0);
        let moment = 2.0 * half * depth * depth * (2.0 / 3.0 * s.powi(3) - s.powi(4) / 4.0);
        // The wetted surface has no closed form: Simpson's rule with 400 x 400 intervals.
        let n = 400;
        let simpson = |k: usize| f64::from(if k == 0 || k == n { 1 } else { 2 + 2 * (k as i32 % 2) });
        let mut surface = 0.0;
        for i in 0..=n {
            for j in 0..=n {
                let (xi, z) = (2.0 * i as f64 / n as f64 - 1.0, t * j as f64 / n as f64);
                let zeta = 1.0 - z / depth;
                let along = half * (1.0 - zeta * zeta) * 2.0 * xi * 2.0 / l;
                let up = half * (1.0 - xi * xi) * 2.0 * zeta / depth;
                surface += simpson(i) * simpson(j) * (1.0 + along * along + up * up).sqrt();
            }
        }
        surface *= 2.0 * l * t / (9.0 * (n * n) as f64);
        let angle = (half * w * 4.0 / l).atan().to_degrees();
        Closed {
            volume: section * 2.0 / 3.0 * l,
            aft: section * l / 3.0,
            xb: 0.5 * l,
            kb: moment / section,
            area: 2.0 * half * w * 2.0 / 3.0 * l,
            xf: 0.5 * l,
            transverse: 2.0 / 3.0 * (half * w).powi(3) * l * 16.0 / 35.0,
            longitudinal: 2.0 * half * w * (0.5 * l).powi(3) * 4.0 / 15.0,
            surface,
            length: l,
            breadth: 2.0 * half * w,
            midship: section,
            largest: section,
            place: 0.5 * l,
            entrance: angle,
            run: angle,
            lateral: l * t,
            lateral_x: 0.5 * l,
            lateral_z: 0.5 * t,
            ..Closed::default()
        }
    });
}

/// Rows over the net and tables are the same numbers.
#[test]
fn rows_are_the_table() {
    for hull in [wigley(), ellipsoid([12.0, 4.0, 3.0], FRAC_PI_2, 20.0), rectangle(3, 5)] {
        let draughts: Vec<f64> = (1..=9).map(|k| 0.1 * f64::from(k) * hull.top()).collect();
        let table = CurvesOfForm::new(&hull, &draughts, &Conventions::default());
        for (row, &t) in table.rows.iter().zip(&draughts) {
            let middle = 0.5 * hull.particulars().length_between_perpendiculars;
            for (functional, value) in [
                (Functional::Volume, row.displacement_volume),
                (Functional::LongitudinalMoment, row.lcb.unwrap() * row.displacement_volume),
                (Functional::VerticalMoment, row.kb.unwrap() * row.displacement_volume),
                (Functional::WaterplaneArea, row.waterplane_area),
                (Functional::WaterplaneMoment, row.lcf.unwrap() * row.waterplane_area),
                (Functional::SectionArea { x: middle }, row.midship_section_area),
            ] {
                let linear = functional.value(&hull, t);
                assert!((linear - value).abs() <= 1e-13 * value, "{functional:?} {t}: {linear} {value}");
            }
        }
    }
}

#[test]
fn the_order_of_draughts_is_kept_and_duplicates_are_equal() {
    let hull = wigley();
    let one = |t: f64| CurvesOfForm::new(&hull, &[t], &Conventions::default()).rows.remove(0);
    let draughts = [3.0, 1.0, 6.0, 1.0, 2.0, 3.0];
    let table = CurvesOfForm::new(&hull, &draughts, &Conventions::default());
    let rows: Vec<Hydrostatics> = draughts.iter().map(|&t| one(t)).collect();
    assert_eq!(table.rows, rows);
}
