//! Curves of form: hydrostatics over a list of draughts, from one pass over the surface.

use super::conventions::{CoefficientLength, Conventions, PrismaticSection, Shell};
use super::quantity::Hydrostatics;
use super::sections::{Sections, sections};
use super::volume::{Body, bodies};
use super::waterplane::{Rule, Waterplane, bottom_area, waterplane};
use crate::hull::{Hull, Immersion, UpperEnd};

/// Hydrostatics of a hull at a list of draughts.
#[derive(Debug, Clone, PartialEq)]
pub struct CurvesOfForm {
    /// What the rows are referred to.
    pub conventions: Conventions,
    /// One row a draught, in the order asked.
    pub rows: Vec<Hydrostatics>,
}

impl CurvesOfForm {
    /// One row for each of `draughts` [m above the base line], in any order, at a cost of O(spans_u (spans_v + draughts)).
    ///
    /// Every draught gets a row of finite numbers. Below the lowest line it is zero; at the lowest line it is the limit from
    /// above (no volume, the waterplane is the flat of bottom); where the deck at side is immersed the body ends at the
    /// deck; above it the row is that of the whole body without a waterplane. Such rows carry a remark, and what is not
    /// defined is `None`. A draught that is not a finite number gives an empty row with a remark and draught 0.
    #[must_use]
    pub fn new(hull: &Hull, draughts: &[f64], conventions: &Conventions) -> Self {
        let immersions: Vec<Option<Immersion>> = draughts
            .iter()
            .map(|&draught| if draught.is_finite() { Immersion::new(hull, draught) } else { None })
            .collect();
        let midship = 0.5 * hull.particulars().length_between_perpendiculars;
        let rule = Rule::new(hull);
        let bottom = bottom_area(hull, &rule);
        let bodies = bodies(hull, &immersions, midship);
        let sections = sections(hull, &immersions);
        let mut rows = Vec::with_capacity(draughts.len());
        for (((&draught, immersion), body), section) in draughts.iter().zip(&immersions).zip(&bodies).zip(&sections) {
            let Some(immersion) = immersion else {
                rows.push(nothing_immersed(hull, draught, conventions));
                continue;
            };
            let waterplane = waterplane(hull, immersion, &rule);
            let mut row = row(hull, draught, conventions, body, &waterplane, section, bottom);
            row.remark = remark(hull, draught, immersion);
            rows.push(row);
        }
        Self { conventions: *conventions, rows }
    }
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
    if !immersion.deck_immersed() {
        return ranges;
    }
    let mut open = false;
    for piece in immersion.pieces() {
        let at_deck = piece.upper == UpperEnd::Deck;
        if at_deck {
            let x = |u: f64| hull.surface().eval(u, immersion.waterline())[0];
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
fn row(
    hull: &Hull,
    draught: f64,
    conventions: &Conventions,
    body: &Body,
    plane: &Waterplane,
    section: &Sections,
    bottom: f64,
) -> Hydrostatics {
    let particulars = hull.particulars();
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
    let surface = body.side + bottom + body.ends;
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
        transom_area: body.transom,
        remark: None,
    }
}
