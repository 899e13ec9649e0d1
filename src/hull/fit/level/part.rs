//! Waterlines between which lines across are smooth, and the lines across them.
//!
//! A line across may start on a flat: from a double knot on it is straight in z, so that nothing of the curve below
//! passes into the flat (flat of side, tangent line along a waterline). The stern profile may have a corner where the
//! transom begins; the chart has a crease there, and y(u, v) takes the slope in v that keeps the tangent plane: with g
//! the jump of the slope of the profile, the jump of y_v is (y_u / x_u) (dx / dx_stern) g.

use super::super::bounded::{Line, carried, flatten, with_multiple};
use super::super::chart::{Heights, Span, heights, lengths};
use super::super::features::FlatOfSide;
use super::super::floor;
use super::super::rows::Row;
use super::FitError;
use crate::hull::cell::TransomPlane;
use crate::hull::form::HullError;
use crate::spline::{BsplineCurve, Collocation, Energy, KnotVector};

/// A bottom counts as flat when its half-breadth is more than this part of that of the waterline above.
const FLAT_BOTTOM: f64 = 0.05;

/// Swings beyond centreplane and greatest half-breadth that are left alone, over the latter.
const SWING: f64 = 1e-4;

/// Half-breadths below 0 by less than this part of the greatest one are left alone: a tenth of a millimetre on a ship.
/// Ringing dies down by a factor of four a waterline, so that a smaller part would ask for knots on nearly all of them.
const FLOOR: f64 = 1e-5;

/// Control values that are one half-breadth differ by less than this part of it.
const SAME: f64 = 1e-10;

/// Half-breadths of each waterline by station.
fn by_station(rows: &[Row], stations: usize) -> Vec<Vec<Option<f64>>> {
    let line = |row: &Row| {
        let mut line = vec![None; stations];
        row.sites.iter().for_each(|s| line[s.station] = Some(s.y));
        line
    };
    rows.iter().map(line).collect()
}

/// Whether the sections leave a flat bottom with a bilge, dy/dz infinite, and not at a corner: over all stations the mean
/// dy/dz between the two lowest waterlines, a height h up, is that of y = sqrt(z) rather than that of a straight line, over the mean
/// between the second and the third, H up: 1 + sqrt(H/h) or 1, which part at their geometric mean. What does not widen at all is no corner.
fn leaves_with_a_bilge(rows: &[Row], stations: usize) -> bool {
    let [first, second, third, ..] = rows else { return true };
    let (low, high) = (second.z - first.z, third.z - first.z);
    let known = by_station(&rows[..3], stations);
    let mut slopes = [0.0; 2];
    for ((a, b), c) in known[0].iter().zip(&known[1]).zip(&known[2]) {
        if let (Some(a), Some(b), Some(c)) = (a, b, c) {
            slopes[0] += (b - a) / low;
            slopes[1] += (c - b) / (high - low);
        }
    }
    slopes[0] <= 0.0 || slopes[0] >= (1.0 + (high / low).sqrt()).sqrt() * slopes[1]
}

/// Mean over the stations of the chord lengths of sections between waterlines.
fn girths(rows: &[Row], stations: usize) -> Vec<f64> {
    let known = by_station(rows, stations);
    rows.windows(2)
        .zip(known.windows(2))
        .map(|(pair, lines)| {
            let dz = pair[1].z - pair[0].z;
            let (mut sum, mut count) = (0.0, 0usize);
            for (a, b) in lines[0].iter().zip(&lines[1]) {
                if let (Some(a), Some(b)) = (a, b) {
                    sum += dz.hypot(b - a);
                    count += 1;
                }
            }
            if count == 0 { dz } else { sum / count as f64 }
        })
        .collect()
}

/// What the table says of the hull besides its waterlines.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Shape<'a> {
    pub(super) flat: Option<&'a FlatOfSide>,
    pub(super) transom: Option<TransomPlane>,
}

/// A spline over its own knots.
#[derive(Debug, Clone, Default)]
struct Spline {
    knots: Option<KnotVector>,
    control: Vec<f64>,
}

impl Spline {
    fn on(&self, knots: &KnotVector) -> Result<Vec<f64>, FitError> {
        self.knots.as_ref().map_or_else(|| Ok(self.control.clone()), |own| carried(own, &self.control, knots))
    }
}

/// Where a line across becomes straight in z.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Start {
    /// Its v.
    at: f64,
    /// Value there, where no waterline gives it.
    value: Option<f64>,
    /// dy/dz of the straight part.
    lean: f64,
}

/// Columns x and y of a net, one list a column in v.
pub(super) struct Columns {
    pub(super) x: Vec<Vec<f64>>,
    pub(super) y: Vec<Vec<f64>>,
}

/// Waterlines between which lines across are smooth.
pub(super) struct Part {
    rows: Vec<Row>,
    /// z(v).
    pub(super) up: Heights,
    span: Span,
    /// Stern and stem in v.
    profiles: [Spline; 2],
    /// v of the corner of the stern profile at the foot of the transom.
    corner: Option<usize>,
    /// For each row its data in u.
    pub(super) lines: Vec<Line>,
}

impl Part {
    pub(super) fn new(rows: Vec<Row>, stations: usize, greatest: f64, shape: Shape<'_>) -> Result<Self, FitError> {
        let z: Vec<f64> = rows.iter().map(|r| r.z).collect();
        let widest = |row: &Row| row.sites.iter().map(|s| s.y).fold(0.0, f64::max);
        let times: Vec<usize> = rows.iter().map(|r| if r.knuckle { 3 } else { 1 + usize::from(r.tangent) }).collect();
        let blunt = widest(&rows[0]) > FLAT_BOTTOM * widest(&rows[1]) && leaves_with_a_bilge(&rows, stations);
        let up = heights(&z, &girths(&rows, stations), &times, blunt)?;
        let profiles = [Spline::default(), Spline::default()];
        let mut part = Self { rows, up, span: Span::Blend, profiles, corner: None, lines: Vec::new() };
        part.set_profiles(shape.transom)?;
        for row in &part.rows {
            part.lines.push(row_line(row, part.span, greatest, shape.flat));
        }
        Ok(part)
    }

    /// Profiles on the present knots in v, without swings at plumb ends; the transom in its plane.
    fn set_profiles(&mut self, transom: Option<TransomPlane>) -> Result<(), FitError> {
        let length = self.rows.iter().map(|r| r.ends[1].x - r.ends[0].x).fold(0.0, f64::max);
        let line = |side: usize| {
            let ends = self.rows.iter().map(|r| r.ends[side].x).collect();
            Line::flat_kept(self.up.sites.clone(), ends, 1e-5 * length)
        };
        let lines = [line(0), line(1)];
        // The waterlines that end on the transom go up to the highest; one alone makes no plane.
        let foot = self.rows.iter().rposition(|r| !r.transom).map_or(0, |j| j + 1);
        let transom = transom.filter(|_| foot + 1 < self.rows.len());
        // Plumb parts begin and end on double knots.
        let edges: Vec<f64> = lines.iter().flat_map(|line| line.slopes.iter().map(|s| line.sites[s.0])).collect();
        self.up = self.up.on(with_multiple(&self.up.knots, &edges, 2)?)?;
        let own = |part: &Self, side: usize| -> Result<KnotVector, FitError> {
            let corner = (side == 0 && transom.is_some() && foot > 0).then(|| part.up.sites[foot]);
            with_multiple(&part.up.knots, corner.as_slice(), 3)
        };
        let mut middles = Vec::new();
        for (side, line) in lines.iter().enumerate() {
            let knots = own(self, side)?;
            middles.extend(line.swings(&knots, &line.free(&Energy::new(&knots, 2))?));
        }
        if !middles.is_empty() {
            self.up = self.up.refined(middles)?;
        }
        for (side, line) in lines.iter().enumerate() {
            let knots = own(self, side)?;
            let energy = Energy::new(&knots, 2);
            let mut control = line.flattened(&knots, line.solve(&energy, line.free(&energy)?));
            if let Some(plane) = transom.filter(|_| side == 0) {
                let z = carried(&self.up.knots, &self.up.z, &knots)?;
                let first = if foot == 0 { 0 } else { knots.knots().partition_point(|&t| t < self.up.sites[foot]) - 1 };
                control.iter_mut().zip(z).skip(first).for_each(|(x, z)| *x = plane.x_base + plane.slope * z);
                self.corner = (foot > 0).then_some(foot);
            }
            self.profiles[side] = Spline { knots: Some(knots), control };
        }
        self.span = Span::new(&self.profiles[0].control, &self.profiles[1].control);
        Ok(())
    }

    /// Where each line across becomes straight: on the flat of side at the lowest waterline from which all are as wide,
    /// or on its level edge below that; on a tangent line along a waterline towards the straighter side.
    fn starts(&self, u: &KnotVector, rows: &[Vec<f64>], flat: Option<&FlatOfSide>) -> Vec<Option<Start>> {
        let degree = u.degree();
        let last = self.rows.len() - 1;
        let on_flat = |i: usize| -> Option<Start> {
            let flat = flat?;
            let wide = |j: usize| (rows[j][i] - flat.half).abs() <= SAME * flat.half;
            let first = (0..=last).rev().take_while(|&j| wide(j)).last()?;
            let knots = &u.knots()[i..=i + degree + 1];
            let from = |j: usize, x: f64| self.span.u(x, self.rows[j].ends.map(|e| e.x));
            let below = first.checked_sub(1)?;
            let edge = flat.level_parts().into_iter().find(|(z, ends)| {
                *z > self.rows[below].z + SAME
                    && *z < self.rows[first].z - SAME
                    && [below, first]
                        .iter()
                        .all(|&j| from(j, ends[0]) <= knots[0] + SAME && knots[degree + 1] <= from(j, ends[1]) + SAME)
            });
            Some(match edge {
                Some((z, _)) => Start { at: self.up.parameter(z), value: Some(flat.half), lean: 0.0 },
                None => Start { at: self.up.sites[first], value: None, lean: 0.0 },
            })
        };
        let on_tangent = |i: usize| -> Option<Start> {
            let j = (1..last).find(|&j| self.rows[j].tangent)?;
            let chord = |a: usize, b: usize| (rows[b][i] - rows[a][i]) / (self.rows[b].z - self.rows[a].z);
            // How much the chords turn on each side; a side of one space has nothing to turn.
            let up = if j + 2 <= last { (chord(j + 1, j + 2) - chord(j, j + 1)).abs() } else { 0.0 };
            let down = if j >= 2 { (chord(j - 1, j) - chord(j - 2, j - 1)).abs() } else { 0.0 };
            let lean = if up <= down { chord(j, j + 1) } else { chord(j - 1, j) };
            Some(Start { at: self.up.sites[j], value: None, lean })
        };
        (0..rows[0].len()).map(|i| on_flat(i).or_else(|| on_tangent(i))).collect()
    }

    /// v of the crease, and the jump of y_v there over u, as control values.
    fn crease(&self, u: &KnotVector, rows: &[Vec<f64>]) -> Result<Option<(f64, Vec<f64>)>, FitError> {
        let (Some(j), Some(knots)) = (self.corner, self.profiles[0].knots.as_ref()) else { return Ok(None) };
        let (at, stern) = (self.up.sites[j], &self.profiles[0].control);
        let k = knots.knots().partition_point(|&t| t < at) - 1;
        let slope = |a: usize, width: f64| 3.0 * (stern[a + 1] - stern[a]) / width;
        let jump = slope(k, knots.knots()[k + 4] - at) - slope(k - 1, at - knots.knots()[k]);
        let points = rows[j].iter().map(|&y| [y]).collect();
        let line = BsplineCurve::new(u.clone(), points).map_err(HullError::from)?;
        let (sites, ends) = (u.greville(), self.rows[j].ends.map(|e| e.x));
        let mut slopes: Vec<f64> = sites
            .iter()
            .map(|&t| {
                let [_, slope] = line.derivatives::<2>(t);
                slope[0] / self.span.x(t, ends).1 * self.span.share_of_stern(t) * jump
            })
            .collect();
        Collocation::new(u, &sites).map_err(HullError::from)?.solve(&mut slopes);
        Ok(Some((at, slopes)))
    }

    /// The net over `u` for rows with the control values `rows`.
    pub(super) fn across(
        &mut self,
        u: &KnotVector,
        rows: &[Vec<f64>],
        greatest: f64,
        flat: Option<&FlatOfSide>,
    ) -> Result<Columns, FitError> {
        let starts = self.starts(u, rows, flat);
        let wide = |i: usize| flat.map(|f| f.half).filter(|half| (rows[rows.len() - 1][i] - half).abs() <= SAME * half);
        let flats: Vec<Option<f64>> = starts.iter().enumerate().map(|(i, s)| s.and_then(|_| wide(i))).collect();
        let mut crease = self.crease(u, rows)?;
        if let Some((_, slopes)) = &mut crease {
            // Nothing bends on the flat.
            slopes.iter_mut().zip(&flats).filter(|(_, flat)| flat.is_some()).for_each(|(slope, _)| *slope = 0.0);
        }
        let places: Vec<f64> = starts.iter().flatten().map(|s| s.at).filter(|&v| v > 0.0 && v < 1.0).collect();
        let doubled = with_multiple(&self.up.knots, &places, 2)?;
        self.up = self.up.on(doubled)?;
        let lines: Vec<Line> =
            (0..starts.len()).map(|i| self.column(rows, i, starts[i], crease.as_ref(), greatest)).collect();
        let free = |up: &Heights| -> Result<Vec<Vec<f64>>, FitError> {
            let energy = Energy::new(&up.knots, 2);
            // Lines that start at the same place share one problem.
            let mut problems: Vec<(Option<u64>, _)> = Vec::new();
            let mut solved = Vec::with_capacity(lines.len());
            for (line, start) in lines.iter().zip(&starts) {
                let key = start.map(|s| s.at.to_bits());
                let known = match problems.iter().position(|p| p.0 == key) {
                    Some(k) => k,
                    None => {
                        problems.push((key, line.problem(&energy)?));
                        problems.len() - 1
                    }
                };
                solved.push(problems[known].1.solve(&line.data()));
            }
            Ok(solved)
        };
        let first = free(&self.up)?;
        let middles: Vec<f64> =
            lines.iter().zip(&first).flat_map(|(line, free)| line.swings(&self.up.knots, free)).collect();
        self.up = self.up.refined(middles)?;
        let energy = Energy::new(&self.up.knots, 2);
        let mut solved: Vec<Vec<f64>> =
            lines.iter().zip(free(&self.up)?).map(|(line, free)| line.solve(&energy, free)).collect();
        for ((line, start), flat) in solved.iter_mut().zip(&starts).zip(&flats) {
            let Some(start) = start else { continue };
            if let Some(half) = flat {
                flatten(&self.up.knots, line, [start.at, 1.0], *half);
            }
            line.iter_mut().zip(&self.up.z).for_each(|(y, z)| *y += start.lean * z);
        }
        if let Some((at, slopes)) = &crease {
            let knots = with_multiple(&self.up.knots, &[*at], 3)?;
            let ramp: Vec<f64> = knots.greville().iter().map(|v| (v - at).max(0.0)).collect();
            for (line, slope) in solved.iter_mut().zip(slopes) {
                *line = carried(&self.up.knots, line, &knots)?;
                line.iter_mut().zip(&ramp).for_each(|(y, r)| *y += slope * r);
            }
            self.up = self.up.on(knots)?;
        }
        let added = floor::lift(u, &self.up.knots, &mut solved, FLOOR * greatest)?;
        if !added.is_empty() {
            let knots = floor::inserted(&self.up.knots, &self.up.z, &added)?.0;
            self.up = self.up.on(knots)?;
        }
        let [stern, stem] = [self.profiles[0].on(&self.up.knots)?, self.profiles[1].on(&self.up.knots)?];
        let y = (0..self.up.z.len()).map(|j| solved.iter().map(|line| line[j]).collect()).collect();
        Ok(Columns { x: lengths(u, self.span, &stern, &stem)?, y })
    }

    /// The data of line `i` across, without what is added to it afterwards.
    fn column(
        &self,
        rows: &[Vec<f64>],
        i: usize,
        start: Option<Start>,
        crease: Option<&(f64, Vec<f64>)>,
        greatest: f64,
    ) -> Line {
        let mut sites = self.up.sites.clone();
        let mut values: Vec<f64> = rows.iter().map(|r| r[i]).collect();
        let mut limits = [0.0, greatest];
        let lean = start.map_or(0.0, |s| s.lean);
        if lean.abs() > 0.0 {
            values.iter_mut().zip(&self.rows).for_each(|(y, row)| *y -= lean * row.z);
        }
        if let Some((at, slopes)) = crease {
            values.iter_mut().zip(&sites).for_each(|(y, v)| *y -= slopes[i] * (v - at).max(0.0));
        }
        if lean.abs() > 0.0 || crease.is_some_and(|c| c.1[i].abs() > 0.0) {
            limits = [f64::NEG_INFINITY, f64::INFINITY];
        }
        let mut slopes = Vec::new();
        if let Some(start) = start {
            let k = sites.partition_point(|&v| v < start.at);
            if let Some(value) = start.value {
                sites.insert(k, start.at);
                values.insert(k, value);
            }
            slopes.push((k, 0.0));
        }
        let slacks = vec![0.0; sites.len()];
        Line { slopes, ..Line::within(sites, values, slacks, limits, SWING * greatest) }
    }
}

/// The data of a waterline in u: its cells, its ends, and the ends of the flat of side.
fn row_line(row: &Row, span: Span, greatest: f64, flat: Option<&FlatOfSide>) -> Line {
    let ends = row.ends.map(|e| e.x);
    let mut points = vec![(0.0, row.ends[0].y, 0.0)];
    points.extend(row.sites.iter().map(|s| (span.u(s.x, ends), s.y, s.slack)));
    points.push((1.0, row.ends[1].y, 0.0));
    let mut level = Vec::new();
    // A station between whose edge is higher keeps its own offset.
    let all_wide = |half: f64, [aft, fore]: [f64; 2]| {
        row.sites.iter().filter(|s| s.x > aft && s.x < fore).all(|s| (s.y - half).abs() <= SAME * half)
    };
    let flat = flat.and_then(|f| Some((f.half, f.ends(row.z)?))).filter(|(half, edges)| all_wide(*half, *edges));
    if let Some((half, edges)) = flat {
        for edge in edges {
            let u = span.u(edge.clamp(ends[0], ends[1]), ends);
            match points.iter().position(|p| (p.0 - u).abs() <= SAME) {
                Some(k) if (points[k].1 - half).abs() <= SAME * half => level.push(u),
                Some(_) => {}
                None => {
                    points.push((u, half, 0.0));
                    level.push(u);
                }
            }
        }
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
    }
    let level = points.iter().enumerate().filter(|(_, p)| level.iter().any(|u| (u - p.0).abs() <= SAME));
    let level: Vec<usize> = level.map(|(k, _)| k).collect();
    let sites = points.iter().map(|p| p.0).collect();
    let values = points.iter().map(|p| p.1).collect();
    let slacks = points.iter().map(|p| p.2).collect();
    let runs = if let [aft, fore] = level[..] { vec![[aft, fore]] } else { Vec::new() };
    Line {
        slopes: level.into_iter().map(|k| (k, 0.0)).collect(),
        runs,
        ..Line::within(sites, values, slacks, [0.0, greatest], SWING * greatest)
    }
}
