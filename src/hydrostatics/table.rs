//! Curves of form: hydrostatics over a list of draughts, from one pass over the surface.

use super::charted;
use super::conventions::{CoefficientLength, Conventions, PrismaticSection, Shell};
use super::row::Hydrostatics;
use super::sections::{Sections, sections};
use super::station::Stations;
use super::volume::{Body, bodies};
use super::waterplane::{Rule, Waterplane, bottom_area, waterplane};
use crate::hull::{Hull, Immersion, PrincipalParticulars, UpperEnd};
use crate::spline::MAX_DEGREE;

/// Hydrostatics of a hull at a list of draughts.
#[derive(Debug, Clone, PartialEq)]
pub struct CurvesOfForm {
    /// What the rows are referred to.
    pub conventions: Conventions,
    /// One row a draught, in the order asked.
    pub rows: Vec<Hydrostatics>,
}

impl CurvesOfForm {
    /// One row for each of `draughts` [m above the base line], in any order, at a cost of O(spans_u (spans_v +
    /// draughts)).
    ///
    /// Every draught gets a row of finite numbers. Below the lowest line it is zero; at the lowest line it is the limit
    /// from above (no volume, the waterplane is the flat of bottom); where the deck at side is immersed the body ends
    /// at the deck; above it the row is that of the whole body without a waterplane. Such rows carry a remark, and what
    /// is not defined is `None`. A draught that is not a finite number gives an empty row with a remark and draught 0.
    #[must_use]
    pub fn new(hull: &Hull, draughts: &[f64], conventions: &Conventions) -> Self {
        let immersions: Vec<Option<Immersion>> = draughts
            .iter()
            .map(|&draught| if draught.is_finite() { Immersion::new(hull, draught) } else { None })
            .collect();
        let midship = 0.5 * hull.particulars().length_between_perpendiculars;
        let Parts { bodies, sections } = parts(hull, &immersions, midship);
        let mut rows = Vec::with_capacity(draughts.len());
        for (((&draught, immersion), (body, waterplane)), section) in
            draughts.iter().zip(&immersions).zip(&bodies).zip(&sections)
        {
            let Some(immersion) = immersion else {
                rows.push(nothing_immersed(hull, draught, conventions));
                continue;
            };
            let mut row = row(hull.particulars(), draught, conventions, body, waterplane, section);
            row.remark = remark(hull, draught, immersion);
            rows.push(row);
        }
        Self { conventions: *conventions, rows }
    }
}

/// What the passes over the surface and along stations give for each draught.
struct Parts {
    bodies: Vec<(Body, Waterplane)>,
    sections: Vec<Sections>,
}

/// The passes, for the order in v.
fn parts(hull: &Hull, immersions: &[Option<Immersion>], midship: f64) -> Parts {
    match hull.surface().v().degree() {
        1 => parts_of::<2>(hull, immersions, midship),
        2 => parts_of::<3>(hull, immersions, midship),
        3 => parts_of::<4>(hull, immersions, midship),
        4 => parts_of::<5>(hull, immersions, midship),
        5 => parts_of::<6>(hull, immersions, midship),
        6 => parts_of::<7>(hull, immersions, midship),
        _ => parts_of::<{ MAX_DEGREE + 1 }>(hull, immersions, midship),
    }
}

fn parts_of<const N: usize>(hull: &Hull, immersions: &[Option<Immersion>], midship: f64) -> Parts {
    let stations = Stations::<N>::new(hull);
    let sections = sections(&stations, immersions);
    if !hull.is_level() {
        return Parts { bodies: charted::bodies::<N>(hull, immersions, midship), sections };
    }
    let rule = Rule::new(hull);
    let bottom = bottom_area(hull, &rule);
    let planes = immersions.iter().map(|i| i.as_ref().map_or_else(Waterplane::default, |i| waterplane(hull, i, &rule)));
    let whole = bodies(&stations, immersions, midship).into_iter().map(|body| Body { bottom, ..body });
    Parts { bodies: whole.zip(planes).collect(), sections }
}

/// The row of a draught below the hull, or of one that is no number.
fn nothing_immersed(hull: &Hull, draught: f64, conventions: &Conventions) -> Hydrostatics {
    if !draught.is_finite() {
        let remark = Some(format!("draught {draught} is not a finite number; nothing is computed"));
        return Hydrostatics { remark, ..Hydrostatics::default() };
    }
    let remark =
        Some(format!("draught below the lowest point of the hull, {:.3} m; nothing is immersed", hull.bottom()));
    Hydrostatics { draught, keel_draught: draught + conventions.keel_thickness, remark, ..Hydrostatics::default() }
}

/// What is out of the ordinary about a draught.
fn remark(hull: &Hull, draught: f64, immersion: &Immersion) -> Option<String> {
    if draught <= hull.bottom() {
        return Some(
            "draught at the lowest point of the hull; no volume, the waterplane is the flat of bottom".to_owned(),
        );
    }
    let wet: Vec<[f64; 2]> = immersed_deck(hull, immersion);
    if immersion.above() {
        return Some(format!(
            "draught above the top of the hull, {:.3} m; whole body closed at the deck, no waterplane",
            hull.top()
        ));
    }
    if wet.is_empty() {
        return None;
    }
    let ranges: Vec<String> = wet.iter().map(|[from, to]| format!("{from:.3} to {to:.3} m")).collect();
    Some(format!("deck at side immersed from x = {}; the body ends at the deck", ranges.join(" and ")))
}

/// Stretches of x over which the deck at side is below the waterline.
fn immersed_deck(hull: &Hull, immersion: &Immersion) -> Vec<[f64; 2]> {
    let mut ranges: Vec<[f64; 2]> = Vec::new();
    if hull.is_level() && !immersion.deck_immersed() {
        return ranges;
    }
    let mut open = false;
    for piece in immersion.pieces() {
        let at_deck = piece.upper == UpperEnd::Deck;
        if at_deck {
            let x = |u: f64| {
                let end = if hull.is_level() { immersion.waterline() } else { immersion.end(u) };
                hull.surface().eval(u, end)[0]
            };
            match ranges.last_mut().filter(|_| open) {
                Some(range) => range[1] = x(piece.to),
                None => ranges.push([x(piece.from), x(piece.to)]),
            }
        }
        open = at_deck;
    }
    ranges
}

/// All quantities of one draught from its integrals.
pub(super) fn row(
    particulars: &PrincipalParticulars,
    draught: f64,
    conventions: &Conventions,
    body: &Body,
    plane: &Waterplane,
    section: &Sections,
) -> Hydrostatics {
    let (lpp, breadth) = (particulars.length_between_perpendiculars, particulars.breadth);
    let length = match conventions.coefficient_length {
        CoefficientLength::BetweenPerpendiculars => lpp,
        CoefficientLength::Waterline => plane.length,
    };
    let prismatic_area = match conventions.prismatic_section {
        PrismaticSection::Maximum => section.largest,
        PrismaticSection::Midship => section.midship,
    };
    // A quotient is defined where its divisor is positive.
    let over = |value: f64, divisor: f64| Some(value / divisor).filter(|q| divisor > 0.0 && q.is_finite());
    let volume = body.volume;
    let afloat = |value: Option<f64>| value.filter(|_| volume > 0.0);
    let surface = body.side + body.bottom + body.ends;
    let mass = conventions.density * volume;
    let extreme = match conventions.shell {
        Shell::None => volume,
        Shell::Factor(factor) => volume * factor,
        Shell::Thickness(thickness) => volume + thickness * surface,
    };
    let lcb = over(body.moment_x, volume);
    let kb = over(body.moment_z, volume);
    let lcf = over(plane.moment, plane.area);
    let longitudinal_inertia = plane.second - lcf.map_or(0.0, |lcf| plane.moment * lcf);
    let has_plane = |value: Option<f64>| value.filter(|_| plane.area > 0.0);
    let bm_transverse = has_plane(over(plane.transverse, volume));
    let bm_longitudinal = has_plane(over(longitudinal_inertia, volume));
    let sum = |a: Option<f64>, b: Option<f64>| a.zip(b).map(|(a, b)| a + b);
    let (km_transverse, km_longitudinal) = (sum(kb, bm_transverse), sum(kb, bm_longitudinal));
    let above = |km: Option<f64>| km.zip(conventions.centre_of_gravity_height).map(|(km, kg)| km - kg);
    let gm_longitudinal = above(km_longitudinal);
    let arm = if conventions.centre_of_gravity_height.is_some() { gm_longitudinal } else { bm_longitudinal };
    let moment_to_change_trim = arm.map(|arm| mass * arm / (100.0 * lpp));
    let half = 0.5 * prismatic_area * length;
    let parallel = section.parallel;
    Hydrostatics {
        draught,
        keel_draught: draught + conventions.keel_thickness,
        displacement_volume: volume,
        displacement_mass: mass,
        displacement_mass_extreme: conventions.density * extreme,
        lcb,
        lcb_percent: lcb.map(|lcb| 100.0 * (lcb - 0.5 * lpp) / lpp),
        kb,
        waterplane_area: plane.area,
        lcf,
        tonnes_per_centimetre: conventions.density * plane.area / 100.0,
        moment_to_change_trim,
        moment_to_trim_metre: moment_to_change_trim.map(|moment| 100.0 * moment),
        transverse_inertia: plane.transverse,
        longitudinal_inertia,
        bm_transverse,
        bm_longitudinal,
        km_transverse,
        km_longitudinal,
        gm_transverse: above(km_transverse),
        gm_longitudinal,
        block_coefficient: afloat(over(volume, length * breadth * draught)),
        midship_coefficient: afloat(over(section.midship, breadth * draught)),
        maximum_section_coefficient: afloat(over(section.largest, breadth * draught)),
        prismatic_coefficient: afloat(over(volume, prismatic_area * length)),
        prismatic_coefficient_fore: afloat(body.aft.and_then(|aft| over(volume - aft, half))),
        prismatic_coefficient_aft: afloat(body.aft.and_then(|aft| over(aft, half))),
        waterplane_coefficient: has_plane(over(plane.area, length * breadth)),
        vertical_prismatic_coefficient: afloat(over(volume, plane.area * draught)),
        wetted_surface_coefficient: afloat(over(surface, (volume * length).sqrt())),
        wetted_surface: surface,
        waterline_aft: (plane.length > 0.0).then_some(plane.aft),
        waterline_length: plane.length,
        waterline_breadth: plane.breadth,
        midship_section_area: section.midship,
        maximum_section_area: section.largest,
        maximum_section_position: section.place,
        half_angle_of_entrance: plane.entrance,
        half_angle_of_run: plane.run,
        parallel_body_aft: parallel.map(|ends| ends[0]),
        parallel_body_fore: parallel.map(|ends| ends[1]),
        entrance_length: section.place.map(|place| lpp - parallel.map_or(place, |ends| ends[1])),
        run_length: section.place.map(|place| parallel.map_or(place, |ends| ends[0])),
        slenderness: afloat(over(length, volume.cbrt())).filter(|&ratio| ratio > 0.0),
        displacement_length_ratio: afloat(over(mass, (0.01 * length).powi(3))),
        lateral_area: body.lateral,
        lateral_centre_x: over(body.lateral_x, body.lateral),
        lateral_centre_z: over(body.lateral_z, body.lateral),
        // Rounding makes an end that is closed a little negative.
        transom_area: body.transom.max(0.0) + 0.0,
        transverse_centre: None,
        heel: None,
        remark: None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hull::Functional;
    use crate::spline::{BsplineCurve, BsplineSurface, KnotVector};
    use proptest::prelude::*;

    /// A hull with raked ends, a flat of bottom 0.5 m above the base line and a deck with sheer; `noise` bends its sides.
    fn hull(noise: &[f64], lowest_deck: f64) -> Hull {
        let (u, v) = (KnotVector::uniform(3, 4).unwrap(), KnotVector::uniform(3, 3).unwrap());
        let mut points = Vec::new();
        for (i, &s) in u.greville().iter().enumerate() {
            for (j, &t) in v.greville().iter().enumerate() {
                let x = 2.0 - 5.0 * t + (94.0 + 11.0 * t) * s;
                let bend = noise.get((7 * i + j) % noise.len().max(1)).copied().unwrap_or(0.0);
                let y = 8.0 * (1.0 - s.powi(3)) * (0.2 + 0.8 * t) * (1.0 + bend);
                points.push([x, y, 0.5 + 8.5 * t]);
            }
        }
        let line = KnotVector::uniform(2, 1).unwrap();
        let deck = BsplineCurve::new(line, vec![[-5.0, 9.0], [50.0, 2.0 * lowest_deck - 9.0], [105.0, 9.0]]).unwrap();
        let particulars = PrincipalParticulars {
            length_between_perpendiculars: 100.0,
            breadth: 16.0,
            draught: Some(5.0),
            depth: 9.0,
        };
        Hull::new("test", particulars, BsplineSurface::new(u, v, points).unwrap(), deck).unwrap()
    }

    fn row_at(hull: &Hull, draught: f64) -> Hydrostatics {
        CurvesOfForm::new(hull, &[draught], &Conventions::default()).rows.remove(0)
    }

    /// What holds for the row of every hull and draught.
    /// No section is larger than the largest by more than a part `unseen`.
    fn check(noise: &[f64], draught: f64, unseen: f64) -> Result<(), TestCaseError> {
        let hull = hull(noise, 9.0);
        let row = row_at(&hull, draught);
        let close = |a: f64, b: f64| (a - b).abs() <= 1e-13 * b.abs();
        let (cb, cp) = (row.block_coefficient.unwrap(), row.prismatic_coefficient.unwrap());
        prop_assert!(close(cb, cp * row.maximum_section_coefficient.unwrap()));
        prop_assert!(close(cb, row.vertical_prismatic_coefficient.unwrap() * row.waterplane_coefficient.unwrap()));
        prop_assert!(close(row.km_transverse.unwrap(), row.kb.unwrap() + row.bm_transverse.unwrap()));
        let halves = row.prismatic_coefficient_fore.unwrap() + row.prismatic_coefficient_aft.unwrap();
        prop_assert!(close(halves, 2.0 * cp));
        prop_assert!(row.maximum_section_area >= row.midship_section_area);
        // dV/dT is the waterplane area.
        let step = 1e-4;
        let rows = CurvesOfForm::new(&hull, &[draught - step, draught + step], &Conventions::default()).rows;
        let slope = (rows[1].displacement_volume - rows[0].displacement_volume) / (2.0 * step);
        prop_assert!((slope - row.waterplane_area).abs() < 1e-7 * slope);
        // The rows over the net are the table.
        for (functional, value) in [
            (Functional::Volume, row.displacement_volume),
            (Functional::LongitudinalMoment, row.lcb.unwrap() * row.displacement_volume),
            (Functional::VerticalMoment, row.kb.unwrap() * row.displacement_volume),
            (Functional::WaterplaneArea, row.waterplane_area),
            (Functional::WaterplaneMoment, row.lcf.unwrap() * row.waterplane_area),
            (Functional::SectionArea { x: 50.0 }, row.midship_section_area),
        ] {
            prop_assert!((functional.value(&hull, draught) - value).abs() <= 1e-13 * value, "{:?}", functional);
        }
        // The largest section has its area, and none is larger: along the hull, at its ends and next to the place.
        let area = |x: f64| Functional::SectionArea { x }.value(&hull, draught);
        let place = row.maximum_section_position.unwrap();
        prop_assert!((area(place) / row.maximum_section_area - 1.0).abs() <= unseen.max(1e-11));
        let [aft, fore] = hull.endings(draught).unwrap();
        let along = (0..=120).map(|k| 110.0 * f64::from(k) / 120.0 - 5.0);
        let corners = [aft, 2.0, fore, 96.0].into_iter().flat_map(|x| [x - 1e-6, x, x + 1e-6, x + 1e-2]);
        for x in along.chain(corners).chain([place - 0.1, place - 0.001, place + 0.001, place + 0.1]) {
            prop_assert!(area(x) <= row.maximum_section_area * (1.0 + unseen), "{x} {} {row:?}", area(x));
        }
        Ok(())
    }

    #[test]
    fn coefficients_belong_together_on_fixed_hulls() {
        // Fractional parts of multiples of the golden ratio: spread evenly, the same in every run.
        let spread = |k: usize| (k as f64 * 0.618_033_988_749_894_9).fract();
        for case in 0..120 {
            let noise: Vec<f64> = (0..12).map(|k| 0.2 * spread(13 * case + k + 1) - 0.1).collect();
            let draught = 0.8 + 8.1 * spread(7 * case + 5);
            check(&noise, draught, 1e-12).unwrap_or_else(|error| panic!("case {case}, draught {draught}: {error}"));
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(24))]

        #[test]
        fn coefficients_belong_together(noise in prop::collection::vec(-0.1..0.1f64, 12), draught in 0.8..8.9f64) {
            // Second maxima that neither slopes nor cubics show are not seen.
            check(&noise, draught, 1e-4)?;
        }
    }

    #[test]
    fn a_draught_out_of_the_ordinary_has_a_finite_row_and_a_remark() {
        for hull in [hull(&[], 9.0), hull(&[], 7.0)] {
            for draught in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, -3.0, 0.0, 0.2, 0.5, 9.5, 1e9] {
                let row = row_at(&hull, draught);
                assert!(row.remark.is_some(), "{draught}");
                for quantity in crate::hydrostatics::QUANTITIES {
                    assert!((quantity.value)(&row).is_none_or(f64::is_finite), "{draught} {}", quantity.key);
                }
            }
        }
    }

    #[test]
    fn the_keel_is_the_limit_from_above() {
        let hull = hull(&[], 9.0);
        let (keel, above) = (row_at(&hull, 0.5), row_at(&hull, 0.5 + 1e-9));
        assert!(keel.displacement_volume.abs() < 1e-300 && keel.kb.is_none() && keel.block_coefficient.is_none());
        assert!((keel.waterplane_area - above.waterplane_area).abs() < 1e-6 && keel.waterplane_area > 100.0);
        assert!((keel.wetted_surface - keel.waterplane_area).abs() < 1e-9);
        assert!(row_at(&hull, 0.49).waterplane_area.abs() < 1e-300);
    }

    #[test]
    fn above_the_deck_the_body_is_whole_and_has_no_waterplane() {
        let hull = hull(&[], 9.0);
        let (top, above) = (row_at(&hull, 9.0), row_at(&hull, 12.0));
        assert!(top.remark.is_none() && top.waterplane_area > 0.0);
        assert!((above.displacement_volume - top.displacement_volume).abs() < 1e-12 * top.displacement_volume);
        assert!(above.waterplane_area.abs() < 1e-300 && above.lcf.is_none() && above.km_transverse.is_none());
    }

    #[test]
    fn an_immersed_deck_closes_the_body() {
        let hull = hull(&[], 7.0);
        let dry = row_at(&hull, 6.9);
        assert!(dry.remark.is_none());
        let row = row_at(&hull, 8.0);
        // The deck is the parabola 9 - 4 * 2 s (1 - s), lowest at x = 50 m; it is at 8 m where s (1 - s) = 1/8.
        let s = 0.5 - (0.25f64 - 0.125).sqrt();
        let wet = format!("x = {:.3} to {:.3} m", 110.0 * s - 5.0, 110.0 * (1.0 - s) - 5.0);
        assert!(row.remark.as_ref().unwrap().contains(&wet), "{:?} {wet}", row.remark);
        assert!(row.prismatic_coefficient_fore.is_none());
        assert!(
            (Functional::Volume.value(&hull, 8.0) - row.displacement_volume).abs() < 1e-9 * row.displacement_volume
        );
        let step = 1e-3;
        let slope = (row_at(&hull, 8.0 + step).displacement_volume - row_at(&hull, 8.0 - step).displacement_volume)
            / (2.0 * step);
        assert!((slope - row.waterplane_area).abs() < 1e-5 * slope, "{slope} {}", row.waterplane_area);
        // The area over the sections is the volume.
        let n = 2000;
        let sum: f64 = (0..n)
            .map(|k| {
                let x = 110.0 * (f64::from(k) + 0.5) / f64::from(n) - 4.0;
                Functional::SectionArea { x }.value(&hull, 8.0) * 110.0 / f64::from(n)
            })
            .sum();
        assert!((sum - row.displacement_volume).abs() < 1e-3 * sum, "{sum} {}", row.displacement_volume);
    }
}
