//! Tables of section outlines: the surface goes around each section by its girth, and from section to section.
//!
//! S(u, v) = (x(u), y(u, v), z(u, v)): the upright chart with heights that are free at every section. y(v) and z(v) of
//! a section are piecewise cubic in v, which runs like its girth, so that flat bottoms, ledges, tunnels and bulbs,
//! where y(z) is steep or jumps, are as smooth as walls. z does not fall with v, in the net: the chart cannot fold.
//!
//! Exact: every point of a section that rises from keel to deck, to rounding. Straight pieces between points in line
//! stay straight, corners stay sharp. Second order around the section, up to fourth along the ship; C1 everywhere, and
//! C2 at the sections where no limit acts. Nothing swings: control values stay within what neighbouring sections have,
//! half-breadths are not negative.
//!
//! Limits: pieces that fall on the way from keel to deck (tunnels seen from below, hooks) are left out, with a note.
//! Cost: linear in the number of sections, and in that of nodes but for their assignment, which takes points times
//! nodes a section.

mod along;
mod nodes;
mod section;

use super::particulars::{BY_STATIONS, length_by_stations};
use super::upright::profile::{Profile, SectionPoint};
use super::upright::{self, Length, ends};
use super::{Chart, FitError, Fitted, outlines};
use crate::hull::form::Hull;
use crate::hull::offsets::OffsetTable;
use crate::spline::{BsplineSurface, SplineError};
use along::Along;
use nodes::Nodal;
use section::Section;

/// Fewest sections.
const LEAST: usize = 2;

/// A keel line jumps by more than this part of the depth.
const JUMP: f64 = 0.2;

/// Its slope there over the steepest of those next to it.
const STEEPER: f64 = 3.0;

fn spline(error: SplineError) -> FitError {
    FitError::Hull(error.into())
}

/// The hull of a table of section outlines.
///
/// # Errors
/// [`FitError::TooFew`] below two sections, [`FitError::Hull`] when the surface is no hull.
pub(super) fn fit(table: &OffsetTable) -> Result<Fitted, FitError> {
    let mut notes = Vec::new();
    let sections = section::sections(&outlines::with_straight_panels(table), &mut notes);
    let too_few = FitError::TooFew { stations: sections.len(), waterlines: table.waterlines.len(), least: LEAST };
    if sections.len() < LEAST {
        return Err(too_few);
    }
    let mut profiles: Vec<Profile> = sections.iter().map(profile).collect();
    let size = upright::size(&profiles);
    if !(size.depth > 0.0 && size.breadth > 0.0) {
        return Err(too_few);
    }
    ends::close(table, &mut profiles, &mut notes);
    let surface = skin(&sections, &profiles, size.depth, &mut notes).map_err(spline)?;
    let deck = upright::deck(&surface, &profiles)?;
    let stated = table.stated.length_between_perpendiculars.is_some();
    let mut assumed = Vec::new();
    let mut particulars = upright::particulars(table, &profiles, &mut assumed);
    let mut hull = Hull::new(&table.name, particulars, surface, deck)?;
    let afloat = particulars.draught.and_then(|draught| hull.endings(draught));
    if let (false, Some([aft, fore])) = (stated, afloat) {
        let (length, how) = length_by_stations(table, fore - aft)
            .map_or((fore - aft, "that of the waterline at T"), |length| (length, BY_STATIONS));
        particulars.length_between_perpendiculars = length;
        assumed.retain(|note| !note.starts_with("no length"));
        assumed.push(format!("no length is stated: L_PP = {length:.3} m, {how}"));
        hull = Hull::new(&table.name, particulars, hull.surface().clone(), hull.deck().clone())?;
    }
    notes.extend(assumed);
    notes.push(outlines::note(table, &hull));
    let cells = super::residuals(table, &hull);
    Ok(Fitted { hull, chart: Chart::Upright, cells, notes })
}

/// Keel, breadth and upper edge of a section, for the ends of the hull.
fn profile(section: &Section) -> Profile {
    let points = section.points.iter().map(|&[y, z]| SectionPoint { z, y: Some(y), mark: None }).collect();
    Profile { x: section.x, station: Some(section.station), points }
}

/// Neighbouring sections between which the keel line jumps.
fn jumps(x: &[f64], keels: &[f64], depth: f64) -> Vec<[usize; 2]> {
    let slope = |k: usize| ((keels[k + 1] - keels[k]) / (x[k + 1] - x[k])).abs();
    let gaps = x.len() - 1;
    (0..gaps)
        .filter(|&k| {
            let beside = [k.checked_sub(1), Some(k + 1).filter(|&j| j < gaps)];
            let steepest = beside.into_iter().flatten().map(slope).fold(0.0, f64::max);
            gaps > 1 && (keels[k + 1] - keels[k]).abs() > JUMP * depth && slope(k) > STEEPER * steepest
        })
        .map(|k| [k, k + 1])
        .collect()
}

/// The surface.
fn skin(
    sections: &[Section],
    profiles: &[Profile],
    depth: f64,
    notes: &mut Vec<String>,
) -> Result<BsplineSurface<3>, SplineError> {
    let x: Vec<f64> = profiles.iter().map(|p| p.x).collect();
    let own: Vec<f64> = sections.iter().map(|s| s.x).collect();
    let keels: Vec<f64> = sections.iter().map(Section::keel).collect();
    let pairs = jumps(&own, &keels, depth);
    for &[aft, fore] in &pairs {
        notes.push(format!(
            "the keel line jumps between x = {:.3} m and {:.3} m; between these sections the surface closes from one to the other",
            own[aft], own[fore]
        ));
    }
    let parameters = nodes::parameters(sections, &pairs);
    let nodes = nodes::nodes(&parameters);
    let breadth = profiles.iter().map(Profile::breadth).fold(0.0, f64::max);
    let tolerance = nodes::tolerance(sections, breadth);
    let mut drawn = sections.iter().zip(&parameters).map(|(section, own)| match section.points[..] {
        [point] => Nodal::point(point, nodes.len()),
        _ => nodes::nodal(section, own, &nodes, tolerance),
    });
    let nodal: Vec<Nodal> = profiles
        .iter()
        .map(|profile| {
            let section = if profile.station.is_some() { drawn.next() } else { None };
            section.unwrap_or_else(|| Nodal::point([0.0, profile.keel()], nodes.len()))
        })
        .collect();
    let length = Length::new(&x, ends::blunt(profiles));
    let shift = usize::from(profiles[0].station.is_none());
    let pairs: Vec<[usize; 2]> = pairs.iter().map(|pair| pair.map(|k| k + shift)).collect();
    let along = Along::new(&length.sites, &pairs)?;
    let control = |axis: usize| -> Vec<Vec<f64>> { nodal.iter().map(|n| n.control(&nodes, axis)).collect() };
    let (y, z) = (control(0), control(1));
    let y = along.control(&y, &along.half_breadths(&y));
    let mut z = along.control(&z, &along.heights(&z));
    // Rounding must not make heights fall.
    for row in &mut z {
        for c in 1..row.len() {
            row[c] = row[c].max(row[c - 1]);
        }
    }
    let u = along::double_knots(&length.sites)?;
    let v = along::double_knots(&nodes)?;
    let x = length.control_lengths(&u);
    let points =
        x.iter().zip(y.iter().zip(&z)).flat_map(|(&x, (y, z))| y.iter().zip(z).map(move |(&y, &z)| [x, y.max(0.0), z]));
    BsplineSurface::new(u, v, points.collect())
}
