//! The upright chart: stations are lines of the net, and so are keel, knuckles and upper edge.
//!
//! S(u, v) = (x(u), y(u, v), z(u, v)). x(u) is one polynomial over the length. Between two successive lines of the
//! hull, a below b,
//!
//! > z(u, v) = z_a(u) + (z_b(u) - z_a(u)) zeta(v),
//!
//! with z_a and z_b splines in u through their heights at the stations and zeta a polynomial of v in the band (v or, at
//! a round keel, v^2): a product of splines, hence exactly in the tensor space. y is the unknown: each station's y(v)
//! passes through its own cells and points with the least bending, on knots common to all stations; then every column
//! of the net is interpolated across the stations. Volume = 2 int int y x_u z_v dv du stays linear in y.
//!
//! A knuckle is a p-fold knot in v: the surface on one side of it does not know of the other, and they share the line
//! as their edge. That is the join of two surfaces along a knuckle, exactly, in one net. On a tangent line, and where a
//! knuckle has ended and runs out as a line of the net, both sides take value and slope of one curve at every station:
//! the tangent plane is continuous at the stations, and between them to the error of interpolation.
//!
//! Exact: every given cell and point (to 1e-9 m), keel, knuckles and upper edge at the stations, hulls whose sections
//! are cubic in the band and whose lines are cubic along it (prisms, pyramids). Order: four along the ship (tested),
//! two to four around the section.
//!
//! Limits: sections are functions y(z): no level ledges inside, no hooks. A plumb stem or a bulb ahead of a recess
//! makes the keel line jump; the piece between the stations beside the jump is then ruled, and a note says so. Cost:
//! linear in the number of cells (banded systems in both directions), times the number of lines.

pub(super) mod ends;
mod girth;
mod length;
mod lines;
pub(super) mod profile;
#[cfg(test)]
mod published;
#[cfg(test)]
mod tests;

use super::features::{self, FlatOfSide};
use super::particulars::{BY_ENDS, BY_STATIONS, length_by_stations, shorter_than_broad};
use super::{CellResidual, Chart, FitError, Fitted};
use crate::hull::cell::{Entry, FeatureLine, LineKind};
use crate::hull::form::Hull;
use crate::hull::offsets::OffsetTable;
use crate::hull::particulars::PrincipalParticulars;
use crate::spline::{BsplineCurve, BsplineSurface, KnotVector, SplineError};
use girth::Band;
use length::Course;
pub(super) use length::Length;
use lines::Line;
pub(super) use lines::Size;
use profile::Profile;

/// Fewest stations.
const LEAST_STATIONS: usize = 2;

/// Variation of the keel line in parts of the depth.
const ROCKER: f64 = 0.05;

/// A curve that leaves the range of its half-breadths by this part of the greatest one swings.
const OVERSHOOT: f64 = 0.05;

/// Bulge between stations beyond what their neighbours allow, in parts of depth or breadth, that is left.
const BULGE: f64 = 1e-3;

/// Heights nearer than this, in parts of the depth, are one height.
const SLACK: f64 = 1e-9;

/// Whether the upright chart is the one for a table: where it has knuckles that do not run along waterlines, and where
/// the keel line of the middle three fifths of the length varies by more than a twentieth of the depth (rocker, rake).
pub(super) fn suits(table: &OffsetTable) -> bool {
    (has_knuckles(table) && !features::knuckles_are_level(table)) || has_rocker(table)
}

/// Whether a table has knuckles off the centreplane.
pub(super) fn has_knuckles(table: &OffsetTable) -> bool {
    table.lines.iter().any(|line| line.kind == LineKind::Knuckle && line.points.iter().any(|p| p[1] > 0.0))
        || table.stations.iter().any(|s| {
            s.half_breadths.iter().any(|cell| cell.marks.knuckle)
                || s.outlines.iter().flatten().any(|p| p.marks.knuckle)
        })
}

/// Whether the keel line varies by more than a twentieth of the depth in the middle three fifths of the length.
#[must_use]
pub fn has_rocker(table: &OffsetTable) -> bool {
    let keels: Vec<(f64, f64)> = table.stations.iter().filter_map(|s| Some((s.station.x, s.keel_height?))).collect();
    let (Some(first), Some(last), Some(&top)) =
        (table.stations.first(), table.stations.last(), table.waterlines.last())
    else {
        return false;
    };
    let (from, length) = (first.station.x, last.station.x - first.station.x);
    let middle = keels.iter().filter(|(x, _)| (0.2..=0.8).contains(&((x - from) / length)));
    let (low, high) = middle.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), &(_, z)| (a.min(z), b.max(z)));
    high - low > ROCKER * (top - low)
}

/// The hull of a table on the upright chart.
///
/// # Errors
/// [`FitError::TooFew`] below two stations with a section, [`FitError::Hull`] when the surface is no hull.
pub(super) fn fit(table: &OffsetTable) -> Result<Fitted, FitError> {
    let mut net = Net::new(table)?;
    let particulars = particulars(table, &net.profiles, &mut net.notes);
    let hull = Hull::new(&table.name, particulars, net.surface.clone(), deck(&net.surface, &net.profiles)?)?;
    Ok(Fitted { hull, chart: Chart::Upright, cells: net.cells(table), notes: net.notes })
}

/// The lines of a table, the lower edge of its flat of side among them.
fn with_flat_of_side(table: &OffsetTable, notes: &mut Vec<String>) -> Vec<FeatureLine> {
    let mut lines = table.lines.clone();
    if table.stations.iter().any(|s| s.flat_of_side.is_some())
        && let Some(flat) = FlatOfSide::new(table, notes)
    {
        let points = flat.edge.iter().map(|&[x, z]| [x, flat.half, z]).collect();
        lines.push(FeatureLine { name: "flat of side".to_owned(), kind: LineKind::Tangent, points });
        notes.push(
            "flat of side: exact at the stations; between them the surface keeps it as interpolation does".to_owned(),
        );
    }
    lines
}

/// The surface with what it was made of.
struct Net {
    surface: BsplineSurface<3>,
    profiles: Vec<Profile>,
    lines: Vec<Line>,
    length: Length,
    bands: Vec<Band>,
    notes: Vec<String>,
    slack: f64,
}

impl Net {
    fn new(table: &OffsetTable) -> Result<Self, FitError> {
        let mut notes = Vec::new();
        let mut profiles = profile::profiles(table, &mut notes);
        let too_few = |profiles: &[Profile]| FitError::TooFew {
            stations: profiles.len(),
            waterlines: table.waterlines.len(),
            least: LEAST_STATIONS,
        };
        if profiles.len() < LEAST_STATIONS {
            return Err(too_few(&profiles));
        }
        ends::close(table, &mut profiles, &mut notes);
        let size = size(&profiles);
        if !(size.depth > 0.0 && size.breadth > 0.0) {
            return Err(too_few(&profiles));
        }
        let slack = SLACK * size.depth;
        let lines = lines::lines(&with_flat_of_side(table, &mut notes), &profiles, size, &mut notes);
        let x: Vec<f64> = profiles.iter().map(|p| p.x).collect();
        let length = Length::new(&x, ends::blunt(&profiles));
        let levels = Levels::new(&profiles, &lines, &length, size, &mut notes).map_err(spline)?;
        let bands = girth::bands(&profiles, &lines, slack).map_err(spline)?;
        let surface = assemble(&profiles, &lines, &length, &levels, &bands, size).map_err(spline)?;
        let mut net = Self { surface, profiles, lines, length, bands, notes, slack };
        net.note_overshoots(table);
        Ok(net)
    }

    /// Names the stations whose curve swings beyond its points: there a knuckle is missing, or a point is wrong.
    fn note_overshoots(&mut self, table: &OffsetTable) {
        let breaks = self.surface.v().breakpoints();
        let mut names = Vec::new();
        for (profile, &u) in self.profiles.iter().zip(&self.length.sites) {
            let (Some(station), greatest) = (profile.station, profile.breadth()) else { continue };
            let known = profile.points.iter().rfind(|p| p.y.is_some()).map_or(profile.top(), |p| p.z);
            let curve = self.surface.curve_at_u(u);
            let swings = breaks.windows(2).flat_map(|w| [0.25, 0.5, 0.75].map(|t| w[0] + t * (w[1] - w[0]))).any(|v| {
                let [_, y, z] = curve.eval(v);
                z < known && (y < -OVERSHOOT * greatest || y > (1.0 + OVERSHOOT) * greatest)
            });
            if swings {
                names.push(table.stations[station].station.name.clone());
            }
        }
        if !names.is_empty() {
            self.notes.push(format!(
                "the sections of stations {} swing beyond their points: is a knuckle there, or a point wrong?",
                names.join(", ")
            ));
        }
    }

    /// v at a height of a station; none outside its section.
    fn v(&self, station: usize, z: f64) -> Option<f64> {
        let levels = girth::levels(&self.profiles[station], &self.lines, station);
        self.bands.iter().enumerate().find_map(|(j, band)| {
            let (a, b) = (levels[j], levels[j + 1]);
            (b - a > self.slack && z >= a - self.slack && z <= b + self.slack).then(|| band.v((z - a) / (b - a)))
        })
    }

    /// The cells with a value or to be predicted.
    fn cells(&self, table: &OffsetTable) -> Vec<CellResidual> {
        let mut result = Vec::new();
        for (number, profile) in self.profiles.iter().enumerate() {
            let Some(station) = profile.station else { continue };
            for (waterline, cell) in table.stations[station].half_breadths.iter().enumerate() {
                let Some(&z) = table.waterlines.get(waterline) else { continue };
                if cell.entry == Entry::Absent {
                    continue;
                }
                if let Some(v) = self.v(number, z) {
                    let half_breadth = self.surface.eval(self.length.sites[number], v)[1];
                    let residual = cell.value().map(|y| half_breadth - y);
                    result.push(CellResidual { station, waterline, half_breadth, residual });
                }
            }
        }
        result.sort_by_key(|cell| (cell.station, cell.waterline));
        result
    }
}

/// Stated dimensions, and where nothing is stated: L_PP by the stations, else between the ends of the hull, B twice the
/// greatest half-breadth, D the highest point. What was not stated is noted.
pub(super) fn particulars(table: &OffsetTable, profiles: &[Profile], notes: &mut Vec<String>) -> PrincipalParticulars {
    let size = size(profiles);
    let (first, last) = (&profiles[0], &profiles[profiles.len() - 1]);
    let length = last.x - first.x;
    let (length, how) = length_by_stations(table, length).map_or((length, BY_ENDS), |l| (l, BY_STATIONS));
    let top = profiles.iter().map(Profile::top).fold(f64::NEG_INFINITY, f64::max);
    let mut or = |value: Option<f64>, what: &str, guess: f64, how: &str| {
        value.unwrap_or_else(|| {
            notes.push(format!("no {what} is stated: {guess:.3} m, {how}"));
            guess
        })
    };
    let stated = &table.stated;
    let particulars = PrincipalParticulars {
        length_between_perpendiculars: or(stated.length_between_perpendiculars, "length", length, how),
        breadth: or(stated.breadth, "breadth", 2.0 * size.breadth, "twice the greatest half-breadth"),
        draught: stated.draught.filter(|_| stated.states_draught()),
        depth: or(stated.depth, "depth", if top > 0.0 { top } else { size.depth }, "the highest point"),
    };
    notes.extend(shorter_than_broad(particulars.length_between_perpendiculars, particulars.breadth));
    particulars
}

/// The upper edge of the surface as the deck at side.
pub(super) fn deck(surface: &BsplineSurface<3>, profiles: &[Profile]) -> Result<BsplineCurve<2>, FitError> {
    let [rows, columns] = surface.shape();
    let edge: Vec<[f64; 2]> = (0..rows)
        .map(|row| {
            let [x, _, z] = surface.point(row, columns - 1);
            [x, z]
        })
        .collect();
    if edge.windows(2).all(|w| w[1][0] > w[0][0]) {
        return BsplineCurve::new(surface.u().clone(), edge).map_err(spline);
    }
    // At a blunt end two control points share x; the edge over x itself has none such.
    let x: Vec<f64> = profiles.iter().map(|p| p.x).collect();
    let plain = Length::new(&x, length::Blunt { aft: false, fore: false });
    let heights: Vec<f64> = profiles.iter().map(Profile::top).collect();
    let bulge = BULGE * size(profiles).depth;
    let course = plain.course(&[], &heights, f64::NEG_INFINITY, bulge).map_err(spline)?;
    let knots = plain.knots([&course]).map_err(spline)?;
    let z = plain.control(&course, &knots).map_err(spline)?;
    let points = plain.control_lengths(&knots).into_iter().zip(z).map(|(x, z)| [x, z]).collect();
    BsplineCurve::new(knots, points).map_err(spline)
}

fn spline(error: SplineError) -> FitError {
    FitError::Hull(error.into())
}

/// Depth from the lowest keel to the highest upper edge, and the greatest half-breadth \[m\].
pub(super) fn size(profiles: &[Profile]) -> Size {
    let low = profiles.iter().map(Profile::keel).fold(f64::INFINITY, f64::min);
    let high = profiles.iter().map(Profile::top).fold(f64::NEG_INFINITY, f64::max);
    Size { depth: high - low, breadth: profiles.iter().map(Profile::breadth).fold(0.0, f64::max) }
}

/// Heights of keel, lines and upper edge along the ship.
struct Levels {
    /// Stations at which each of them is interrupted.
    breaks: Vec<Vec<usize>>,
    courses: Vec<Course>,
}

impl Levels {
    /// Splines across the stations; where two lines would cross between stations, both are straight from station to station there.
    fn new(
        profiles: &[Profile],
        lines: &[Line],
        length: &Length,
        size: Size,
        notes: &mut Vec<String>,
    ) -> Result<Self, SplineError> {
        let last = profiles.len() - 1;
        let x: Vec<f64> = profiles.iter().map(|p| p.x).collect();
        let mut values: Vec<Vec<f64>> = vec![profiles.iter().map(Profile::keel).collect()];
        values.extend(lines.iter().map(|line| line.z.clone()));
        values.push(profiles.iter().map(Profile::top).collect());
        let mut breaks: Vec<Vec<usize>> = values.iter().map(|z| length::jumps(&x, z, size.depth)).collect();
        for pair in breaks[0].windows(2).filter(|w| w[1] == w[0] + 1) {
            notes.push(format!(
                "the keel line jumps between x = {:.3} m and {:.3} m; the surface is ruled there",
                x[pair[0]], x[pair[1]]
            ));
        }
        // Where a line only goes on as a line of the net it jumps with the keel.
        let keel_jumps: Vec<usize> = breaks[0].windows(2).filter(|w| w[1] == w[0] + 1).map(|w| w[0]).collect();
        for (line, own) in lines.iter().zip(&mut breaks[1..]) {
            for &k in keel_jumps
                .iter()
                .filter(|&&k| line.y[k].is_none() && line.y[k + 1].is_none() && line.z[k] > values[0][k])
            {
                own.extend([k, k + 1]);
            }
            own.sort_unstable();
            own.dedup();
        }
        loop {
            let course =
                |(own, z): (&Vec<usize>, &Vec<f64>)| length.course(own, z, f64::NEG_INFINITY, BULGE * size.depth);
            let courses = breaks.iter().zip(&values).map(course).collect::<Result<Vec<_>, _>>()?;
            let knots = length.knots(&courses)?;
            let control = courses.iter().map(|course| length.control(course, &knots)).collect::<Result<Vec<_>, _>>()?;
            // A control height below the one of the line beneath it: lines would cross near its site.
            let dust = SLACK * size.depth;
            let mut found = Vec::new();
            let greville = knots.greville();
            for j in 1..control.len() {
                for (i, &site) in greville.iter().enumerate() {
                    if control[j][i] < control[j - 1][i] - dust {
                        let next = length.sites.partition_point(|&u| u <= site).min(last);
                        for line in [j - 1, j] {
                            found.extend([next.saturating_sub(1), next].map(|k| (line, k)));
                        }
                    }
                }
            }
            found.retain(|(line, k)| (1..last).contains(k) && !breaks[*line].contains(k));
            if found.is_empty() {
                return Ok(Self { breaks, courses });
            }
            for (line, k) in found {
                if !breaks[line].contains(&k) {
                    breaks[line].push(k);
                    breaks[line].sort_unstable();
                }
            }
        }
    }

    /// Control heights of each line over `knots`, in order from below.
    fn control(&self, length: &Length, knots: &KnotVector) -> Result<Vec<Vec<f64>>, SplineError> {
        let mut control: Vec<Vec<f64>> = Vec::new();
        for course in &self.courses {
            let mut line = length.control(course, knots)?;
            if let Some(below) = control.last() {
                line.iter_mut().zip(below).for_each(|(z, &floor)| *z = z.max(floor));
            }
            control.push(line);
        }
        Ok(control)
    }
}

/// The net of x, y and z.
fn assemble(
    profiles: &[Profile],
    lines: &[Line],
    length: &Length,
    levels: &Levels,
    bands: &[Band],
    size: Size,
) -> Result<BsplineSurface<3>, SplineError> {
    let slack = SLACK * size.depth;
    let curves = (0..profiles.len())
        .map(|k| girth::station_curve(&profiles[k], lines, bands, k, slack))
        .collect::<Result<Vec<_>, _>>()?;
    // The courses of half-breadths, one a column, band by band.
    let mut courses: Vec<Course> = Vec::new();
    let shares: Vec<Vec<f64>> = bands.iter().map(Band::control_shares).collect();
    for (j, shares) in shares.iter().enumerate() {
        let mut inside: Vec<usize> = [&levels.breaks[j][..], &levels.breaks[j + 1]].concat();
        inside.sort_unstable();
        inside.dedup();
        // Keel and upper edge go with the only band beside them.
        let edge = |line: usize| if line == 0 || line == bands.len() { &inside } else { &levels.breaks[line] };
        for c in usize::from(j > 0)..shares.len() {
            let breaks = match c {
                0 => edge(j),
                c if c + 1 == shares.len() => edge(j + 1),
                _ => &inside,
            };
            let values: Vec<f64> = curves.iter().map(|curve| curve[j][c]).collect();
            courses.push(length.course(breaks, &values, 0.0, BULGE * size.breadth)?);
        }
    }
    let along = length.knots(levels.courses.iter().chain(&courses))?;
    let heights = levels.control(length, &along)?;
    let x = length.control_lengths(&along);
    let mut courses = courses.iter();
    let mut columns: Vec<Vec<[f64; 3]>> = Vec::new();
    let mut knots: Vec<f64> = Vec::new();
    for (j, (band, shares)) in bands.iter().zip(&shares).enumerate() {
        for ((c, share), course) in shares.iter().enumerate().skip(usize::from(j > 0)).zip(&mut courses) {
            let y = length.control(course, &along)?;
            let column = (0..x.len()).map(|i| {
                let (a, b) = (heights[j][i], heights[j + 1][i]);
                [x[i], y[i], if c + 1 == shares.len() { b } else { a + (b - a) * share }]
            });
            columns.push(column.collect());
        }
        // Of the clamped ends of two bands at their join, p knots remain.
        knots.pop();
        knots.extend(&band.knots.knots()[if j > 0 { length::DEGREE + 1 } else { 0 }..]);
    }
    let v = KnotVector::new(length::DEGREE, knots)?;
    let points = (0..x.len()).flat_map(|i| columns.iter().map(move |column| column[i])).collect();
    BsplineSurface::new(along, v, points)
}
