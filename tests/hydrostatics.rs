//! Tables of hydrostatics of hulls whose lines in u slant: generated ships against identities, sheared bodies against
//! closed forms and against section areas taken one by one.

use loftsman::internals::hull::{Functional, Hull, PrincipalParticulars, SectionalAreaCurve};
use loftsman::internals::hydrostatics::{Conventions, CurvesOfForm, QUANTITIES};
use loftsman::internals::parametric::ShipType;
use loftsman::internals::parametric::cosh::{self, DesignTargets, MidshipTarget};
use loftsman::internals::spline::{BsplineCurve, BsplineSurface, Collocation, KnotVector};

fn ships() -> Vec<(&'static str, Hull)> {
    let base = |ship, length| DesignTargets { ship_type: Some(ship), length, ..DesignTargets::default() };
    let requested = [
        (
            "frigate",
            DesignTargets {
                breadth: Some(19.06),
                draught: Some(6.15),
                depth: Some(10.5),
                block_coefficient: Some(0.50),
                midship_coefficient: Some(MidshipTarget::Value(0.80)),
                flare: Some(14f64.to_radians()),
                sheer_fore: Some(1.0),
                ..base(ShipType::Frigate, 142.0)
            },
        ),
        (
            "bulk carrier",
            DesignTargets {
                breadth: Some(32.25),
                draught: Some(12.2),
                depth: Some(17.5),
                block_coefficient: Some(0.80),
                midship_coefficient: Some(MidshipTarget::Value(0.99)),
                waterplane_coefficient: Some(0.885),
                lcb: Some(217.0 * 0.522),
                ..base(ShipType::BulkCarrier, 217.0)
            },
        ),
        ("yacht", base(ShipType::Yacht, 12.0)),
    ];
    requested.map(|(name, requested)| (name, cosh::generate(name, &requested).unwrap().hull)).into()
}

fn area(hull: &Hull, x: f64, draught: f64) -> f64 {
    Functional::SectionArea { x }.value(hull, draught)
}

#[test]
fn generated_ships_from_a_fifth_of_the_draught_to_the_deck() {
    for (name, hull) in ships() {
        let p = hull.particulars();
        let (from, to, count) = (0.2 * hull.reference_height(), p.depth, 40);
        let draughts: Vec<f64> = (0..count).map(|k| from + (to - from) * f64::from(k) / f64::from(count - 1)).collect();
        let rows = CurvesOfForm::new(&hull, &draughts, &Conventions::default()).rows;
        assert!(rows.windows(2).all(|w| w[1].displacement_volume > w[0].displacement_volume), "{name}");
        let step = 1e-5 * hull.reference_height();
        let beside: Vec<f64> = draughts.iter().flat_map(|t| [t - step, t + step]).collect();
        let beside = CurvesOfForm::new(&hull, &beside, &Conventions::default()).rows;
        let deck = hull.deck().points().iter().map(|point| point[1]).fold(f64::INFINITY, f64::min);
        for (k, row) in rows.iter().enumerate() {
            let label = format!("{name} at {}", row.draught);
            for quantity in QUANTITIES {
                assert!((quantity.value)(row).is_none_or(f64::is_finite), "{label}: {}", quantity.key);
            }
            assert_eq!(row.remark.is_some(), row.draught > deck + 1e-9, "{label}: {:?}", row.remark);
            // At the deck the difference above is that of another body.
            if row.draught + step < deck {
                let rise = beside[2 * k + 1].displacement_volume - beside[2 * k].displacement_volume;
                let slope = rise / (2.0 * step);
                assert!((slope - row.waterplane_area).abs() < 1e-6 * slope, "{label}: {slope} {}", row.waterplane_area);
            }
            let (cb, cp, cx) = (row.block_coefficient, row.prismatic_coefficient, row.maximum_section_coefficient);
            let (cb, product) = (cb.unwrap(), cp.unwrap() * cx.unwrap());
            assert!((cb - product).abs() <= 1e-13 * cb, "{label}: {cb} {product}");
            let largest = row.maximum_section_area;
            assert!(largest >= row.midship_section_area, "{label}");
            let midship = area(&hull, 0.5 * p.length_between_perpendiculars, row.draught);
            assert!((row.midship_section_area - midship).abs() <= 1e-13 * midship, "{label}: {midship}");
            let place = row.maximum_section_position.unwrap();
            let parallel = row.parallel_body_aft.zip(row.parallel_body_fore);
            let (aft, fore) = parallel.unwrap_or((place, place));
            for share in [0.0, 0.25, 0.5, 0.75, 1.0] {
                let value = area(&hull, aft + share * (fore - aft), row.draught);
                let tolerance = if parallel.is_some() { 1.001e-6 } else { 1e-11 };
                assert!((value - largest).abs() <= tolerance * largest, "{label}: {value} {largest}");
            }
            if name == "bulk carrier" {
                assert!(fore - aft > 0.1 * p.length_between_perpendiculars, "{label}: {parallel:?}");
            }
            if k % 8 == 0 {
                for i in 0..=200 {
                    let x = p.length_between_perpendiculars * (1.1 * f64::from(i) / 200.0 - 0.05);
                    let value = area(&hull, x, row.draught);
                    assert!(value <= largest * (1.0 + 1e-12), "{label}: {value} at {x}, {largest} at {place}");
                }
            }
        }
    }
}

/// With sheer the deck at side is immersed amidships before it is at the ends.
#[test]
fn a_frigate_down_to_the_deck_at_its_ends() {
    let (_, hull) = ships().remove(0);
    let depth = hull.particulars().depth;
    assert!(hull.top() > depth + 0.5);
    let draughts: Vec<f64> = (0..=10).map(|k| depth - 0.2 + 0.1 * f64::from(k)).collect();
    let rows = CurvesOfForm::new(&hull, &draughts, &Conventions::default()).rows;
    for (row, &t) in rows.iter().zip(&draughts) {
        assert_eq!(row.remark.is_some(), t > depth + 1e-9, "{t}: {:?}", row.remark);
        assert!(QUANTITIES.iter().all(|quantity| (quantity.value)(row).is_none_or(f64::is_finite)), "{t}");
        assert!(row.maximum_section_area >= row.midship_section_area, "{t}");
        for i in 0..=100 {
            let x = 142.0 * (1.1 * f64::from(i) / 100.0 - 0.05);
            assert!(area(&hull, x, t) <= row.maximum_section_area * (1.0 + 1e-9), "{t} {x}: {row:?}");
        }
    }
    assert!(rows.windows(2).all(|w| w[1].displacement_volume > w[0].displacement_volume));
}

/// A hull with x = u + `slant` z and y(u, z), interpolated; 100 m long, 10 m deep.
fn sheared(u: KnotVector, v: KnotVector, slant: f64, y: impl Fn(f64, f64) -> f64) -> Hull {
    let (us, vs) = (u.greville(), v.greville());
    let mut breadths: Vec<f64> = us.iter().flat_map(|&s| vs.iter().map(|&z| y(s, z)).collect::<Vec<_>>()).collect();
    let (rows, columns) = (us.len(), vs.len());
    let (along, across) = (Collocation::new(&u, &us).unwrap(), Collocation::new(&v, &vs).unwrap());
    for column in 0..columns {
        along.solve_strided(&mut breadths, column, columns);
    }
    for row in 0..rows {
        across.solve_strided(&mut breadths, row * columns, 1);
    }
    let points = (0..rows * columns)
        .map(|k| {
            let (s, z) = (us[k / columns], vs[k % columns]);
            [s + slant * z, breadths[k], z]
        })
        .collect();
    let line = KnotVector::uniform(1, 1).unwrap();
    let deck = BsplineCurve::new(line, vec![[-50.0, 10.0], [150.0, 10.0]]).unwrap();
    let particulars =
        PrincipalParticulars { length_between_perpendiculars: 100.0, breadth: 16.0, draught: Some(6.0), depth: 10.0 };
    Hull::new("sheared", particulars, BsplineSurface::new(u, v, points).unwrap(), deck).unwrap()
}

fn knots(degree: usize, breaks: &[f64]) -> KnotVector {
    KnotVector::from_breakpoints(degree, breaks, &vec![1; breaks.len() - 2]).unwrap()
}

/// y = 8 g (1 - ((x - 47 - z) / 60)^2) with g = z (20 - z) / 100 on lines x = u + slant z: the area is a parabola in x
/// with its vertex at 47 + int g z dz / int g dz.
#[test]
fn largest_section_where_the_lines_slant() {
    for slant in [0.5, -0.7, 2.0] {
        let g = |z: f64| z * (20.0 - z) / 100.0;
        let u: Vec<f64> = (0..=12).map(|k| 100.0 * f64::from(k) / 12.0).collect();
        let hull = sheared(knots(3, &u), knots(4, &[0.0, 2.5, 5.0, 7.5, 10.0]), slant, |u, z| {
            8.0 * g(z) * (1.0 - ((u + slant * z - 47.0 - z) / 60.0).powi(2))
        });
        let draughts: Vec<f64> = (1..=40).map(|k| 0.25 * f64::from(k)).collect();
        for row in CurvesOfForm::new(&hull, &draughts, &Conventions::default()).rows {
            let t = row.draught;
            // int g, int g z and int g z^2 dz.
            let moment = |k: i32| (20.0 * t.powi(k + 2) / f64::from(k + 2) - t.powi(k + 3) / f64::from(k + 3)) / 100.0;
            let centre = moment(1) / moment(0);
            let largest = 16.0 * (moment(0) - (moment(2) - centre * moment(1)) / 3600.0);
            let place = row.maximum_section_position.unwrap();
            assert!((row.maximum_section_area - largest).abs() < 1e-12 * largest, "{slant} {row:?} {largest}");
            assert!((place - 47.0 - centre).abs() < 1e-7 * 100.0, "{slant} {t}: {place} {}", 47.0 + centre);
            assert!((area(&hull, 50.0, t) - row.midship_section_area).abs() < 1e-13 * largest);
            assert!(row.parallel_body_aft.is_none());
        }
    }
}

/// A parallel body between slanting ends: its ends are where the areas, taken one by one, pass (1 - 1e-6) A_X.
#[test]
fn parallel_body_where_the_lines_slant() {
    for slant in [0.0, 0.4, -1.1] {
        let u = [0.0, 10.0, 20.0, 30.0, 45.0, 60.0, 70.0, 85.0, 100.0];
        let hull = sheared(knots(3, &u), knots(3, &[0.0, 3.0, 6.0, 10.0]), slant, |u, z| {
            let fall = ((30.0 - u).max(0.0) / 31.0).powi(3) + ((u - 60.0).max(0.0) / 42.0).powi(3);
            8.0 * (1.0 - (1.0 - 0.1 * z).powi(2)) * (1.0 - fall)
        });
        let draughts: Vec<f64> = (1..=20).map(|k| 0.5 * f64::from(k)).collect();
        for row in CurvesOfForm::new(&hull, &draughts, &Conventions::default()).rows {
            let t = row.draught;
            let (aft, fore) = (row.parallel_body_aft.unwrap(), row.parallel_body_fore.unwrap());
            let largest = area(&hull, 45.0 + 0.5 * slant * t, t);
            assert!((row.maximum_section_area - largest).abs() < 1e-12 * largest);
            for (found, outside) in [(aft, aft - 15.0), (fore, fore + 15.0)] {
                let (mut good, mut bad) = (0.5 * (aft + fore), outside);
                for _ in 0..50 {
                    let middle = 0.5 * (good + bad);
                    if area(&hull, middle, t) >= largest * (1.0 - 1e-6) { good = middle } else { bad = middle }
                }
                assert!((found - good).abs() < 1e-6 * 100.0, "{slant} {t}: {found} {good}");
            }
            assert!((row.maximum_section_position.unwrap() - 0.5 * (aft + fore)).abs() < 1e-12 * 100.0);
        }
    }
}

/// Areas of many draughts at once are those of each alone: on plumb, raked and rockered hulls, below the keel and above
/// the deck.
#[test]
fn areas_of_draughts_together_and_alone() {
    for (name, hull) in ships() {
        let (p, top) = (hull.particulars(), hull.top());
        let draughts = [
            hull.reference_height(),
            0.3 * hull.reference_height(),
            -1e3,
            0.71 * top,
            0.3 * hull.reference_height(),
            2.0 * top,
        ];
        let stations: Vec<f64> = (-2..=42).map(|k| f64::from(k) / 40.0 * p.length_between_perpendiculars).collect();
        let together = SectionalAreaCurve::areas(&hull, &draughts, &stations);
        for (d, &draught) in draughts.iter().enumerate() {
            let alone = SectionalAreaCurve::new(&hull, draught, &stations);
            for (row, area) in together.iter().zip(&alone.areas) {
                let gap = (row[d] - area).abs();
                assert!(gap <= 1e-10 * p.breadth * p.depth, "{name} at {draught} m: {} {area}", row[d]);
            }
        }
    }
}
