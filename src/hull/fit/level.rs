//! The loft on the level chart: every waterline a spline of least energy through its own cells and ends, the waterlines joined
//! across.
//!
//! All waterlines share one knot vector in u, on which none has more than one site a span; each meets its cells at its own
//! sites u_ij (x(u_ij, v_j) = x_i), and what is missing is filled with the least energy int y_uu^2 du. The control values are then
//! interpolated across at the v_j with the least energy int y_vv^2 dv. The surface passes through every cell to rounding (below
//! 1e-9 m), and stays between the centreplane and the greatest half-breadth but for swings below 1e-4 of it ([`super::bounded`]).
//!
//! Where a profile jumps along a level keel (a dome or skeg below it) the surface has a level strip without height, which is the
//! keel: the waterline there is written twice, for the body below and for the hull, and the lines across break at both.
//!
//! Cost: linear in the number of cells.

use super::super::{Hull, HullError, OffsetTable};
use super::FitError;
use super::bounded::{Line, with_knots};
use super::chart::{Heights, Span, heights, length_knots, lengths};
use super::floor;
use super::particulars;
use super::rows::{Row, Rows};
use crate::spline::{BsplineCurve, BsplineSurface, Energy, KnotVector};

/// A bottom counts as flat when its half-breadth is more than this part of that of the waterline above.
const FLAT_BOTTOM: f64 = 0.05;

/// Swings beyond centreplane and greatest half-breadth that are left alone, over the latter.
const SWING: f64 = 1e-4;

/// Half-breadths below 0 by less than this part of the greatest one are left alone: a tenth of a millimetre on a ship. Ringing dies down by
/// a factor of four a waterline, so that a smaller part would ask for knots on nearly all of them.
const FLOOR: f64 = 1e-5;

/// Control values of a waterline this far beyond centreplane and greatest half-breadth, over the latter, ask for more knots.
const WILD: f64 = 0.05;

/// A profile jumps when an end moves by more than this part of the longest waterline from one waterline to the next.
const JUMP: f64 = 0.4;

/// How far from level such a keel may be, over the height of the table.
const LEVEL: f64 = 2e-3;

/// Width in v of a strip without height, over that of the whole.
const STRIP: f64 = 0.02;

/// Height of a strip over that of the body below it.
const HAIR: f64 = 1e-9;

/// Mean over the stations of the chord lengths of sections between waterlines.
fn girths(rows: &[Row], stations: usize) -> Vec<f64> {
    let known: Vec<Vec<Option<f64>>> = rows
        .iter()
        .map(|row| {
            let mut line = vec![None; stations];
            row.sites.iter().for_each(|s| line[s.station] = Some(s.y));
            line
        })
        .collect();
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

/// Waterlines between which lines across are smooth.
struct Part {
    rows: Vec<Row>,
    up: Heights,
    span: Span,
    /// Control values of the profiles in v.
    profiles: [Vec<f64>; 2],
    /// For each row its data in u.
    lines: Vec<Line>,
}

impl Part {
    fn new(rows: Vec<Row>, stations: usize, greatest: f64) -> Result<Self, FitError> {
        let z: Vec<f64> = rows.iter().map(|r| r.z).collect();
        let widest = |row: &Row| row.sites.iter().map(|s| s.y).fold(0.0, f64::max);
        let corners: Vec<usize> = (1..rows.len() - 1).filter(|&j| rows[j].knuckle).collect();
        let blunt = widest(&rows[0]) > FLAT_BOTTOM * widest(&rows[1]);
        let up = heights(&z, &girths(&rows, stations), &corners, blunt)?;
        let mut part = Self { rows, up, span: Span::Blend, profiles: [Vec::new(), Vec::new()], lines: Vec::new() };
        part.set_profiles()?;
        for row in &part.rows {
            let ends = row.ends.map(|e| e.x);
            let mut sites = vec![0.0];
            sites.extend(row.sites.iter().map(|s| part.span.u(s.x, ends)));
            sites.push(1.0);
            let y = |side: usize| std::iter::once(row.ends[side].y);
            let values = y(0).chain(row.sites.iter().map(|s| s.y)).chain(y(1)).collect();
            let none = || std::iter::once(0.0);
            let slacks = none().chain(row.sites.iter().map(|s| s.slack)).chain(none()).collect();
            part.lines.push(Line::within(sites, values, slacks, [0.0, greatest], SWING * greatest));
        }
        Ok(part)
    }

    /// Profiles on the present knots in v, without swings at plumb ends.
    fn set_profiles(&mut self) -> Result<(), FitError> {
        let length = self.rows.iter().map(|r| r.ends[1].x - r.ends[0].x).fold(0.0, f64::max);
        let line = |side: usize| {
            let ends = self.rows.iter().map(|r| r.ends[side].x).collect();
            Line::flat_kept(self.up.sites.clone(), ends, 1e-5 * length)
        };
        let lines = [line(0), line(1)];
        let energy = Energy::new(&self.up.knots, 2);
        let free = |line: &Line| -> Result<Vec<f64>, FitError> { Ok(line.problem(&energy)?.solve(&line.values)) };
        let frees = [free(&lines[0])?, free(&lines[1])?];
        let middles: Vec<f64> =
            lines.iter().zip(&frees).flat_map(|(line, free)| line.swings(&self.up.knots, free)).collect();
        if !middles.is_empty() {
            self.up = self.up.refined(middles)?;
        }
        let energy = Energy::new(&self.up.knots, 2);
        let solve = |line: &Line| -> Result<Vec<f64>, FitError> {
            Ok(line.solve(&energy, line.problem(&energy)?.solve(&line.values)))
        };
        self.profiles = [solve(&lines[0])?, solve(&lines[1])?];
        self.span = Span::new(&self.profiles[0], &self.profiles[1]);
        Ok(())
    }

    /// Adds knots in v without changing the profiles and z(v).
    fn refine(&mut self, middles: Vec<f64>) -> Result<(), FitError> {
        let old = self.up.knots.clone();
        let carry = |control: &Vec<f64>, up: &Heights| Heights { z: control.clone(), ..up.clone() };
        let profiles = [carry(&self.profiles[0], &self.up), carry(&self.profiles[1], &self.up)];
        self.up = self.up.refined(middles.clone())?;
        if self.up.knots != old {
            let [stern, stem] = profiles;
            self.profiles = [stern.refined(middles.clone())?.z, stem.refined(middles)?.z];
        }
        Ok(())
    }

    /// The net of y, one list a column in v, for rows with control values `rows` in u.
    fn across(&mut self, u: &KnotVector, rows: &[Vec<f64>], greatest: f64) -> Result<Vec<Vec<f64>>, FitError> {
        let count = rows[0].len();
        let line = |i: usize, sites: &[f64]| {
            let values: Vec<f64> = rows.iter().map(|r| r[i]).collect();
            Line::within(sites.to_vec(), values, vec![0.0; rows.len()], [0.0, greatest], SWING * greatest)
        };
        let lines: Vec<Line> = (0..count).map(|i| line(i, &self.up.sites)).collect();
        let problem = lines[0].problem(&Energy::new(&self.up.knots, 2))?;
        let middles: Vec<f64> =
            lines.iter().flat_map(|line| line.swings(&self.up.knots, &problem.solve(&line.values))).collect();
        self.refine(middles)?;
        let energy = Energy::new(&self.up.knots, 2);
        let problem = lines[0].problem(&energy)?;
        let mut solved: Vec<Vec<f64>> =
            lines.iter().map(|line| line.solve(&energy, problem.solve(&line.values))).collect();
        let added = floor::lift(u, &self.up.knots, &mut solved, FLOOR * greatest)?;
        if !added.is_empty() {
            for profile in &mut self.profiles {
                *profile = floor::inserted(&self.up.knots, profile, &added)?.1;
            }
            (self.up.knots, self.up.z) = floor::inserted(&self.up.knots, &self.up.z, &added)?;
        }
        Ok((0..self.up.z.len()).map(|j| solved.iter().map(|line| line[j]).collect()).collect())
    }
}

/// Splits the rows where a profile jumps to a longer waterline; the longer one is written a second time, between the ends of
/// the body below.
fn split(table: &OffsetTable, rows: Vec<Row>, notes: &mut Vec<String>) -> Vec<Vec<Row>> {
    let longest = rows.iter().map(|r| r.ends[1].x - r.ends[0].x).fold(0.0, f64::max);
    let mut parts: Vec<Vec<Row>> = vec![Vec::new()];
    let count = rows.len();
    let flat = LEVEL * (rows[count - 1].z - rows[0].z);
    // A level keel: at two stations at least that the waterline gains, the lowest point is at its height.
    let level_keel = |row: &Row, below: &Row| {
        let gained =
            |x: f64| row.ends[0].x <= x && x <= row.ends[1].x && !(below.ends[0].x..=below.ends[1].x).contains(&x);
        let keels = table.stations.iter().filter(|s| gained(s.station.x)).filter_map(|s| s.keel_height);
        keels.filter(|z| (z - row.z).abs() <= flat).count() >= 2
    };
    for (j, row) in rows.into_iter().enumerate() {
        let current = parts.len() - 1;
        if let Some(below) = parts[current].last() {
            let moved = [below.ends[0].x - row.ends[0].x, row.ends[1].x - below.ends[1].x];
            if moved.iter().any(|&m| m > JUMP * longest) && j + 1 < count && level_keel(&row, below) {
                notes.push(format!(
                    "the profile jumps along the keel at z = {:.3} m: the body below it joins the hull in a level strip",
                    row.z
                ));
                let copy = narrowed(&row, &parts[current]);
                parts[current].push(copy);
                parts.push(Vec::new());
            }
        }
        let current = parts.len() - 1;
        parts[current].push(row);
    }
    parts
}

/// The part of a waterline between the ends of the body below, continued to its height.
fn narrowed(row: &Row, below: &[Row]) -> Row {
    let last = &below[below.len() - 1];
    let before = below.len().checked_sub(2).map(|k| &below[k]);
    let mut copy = row.clone();
    // A hair below, so that the height of the waterline belongs to the hull alone.
    copy.z -= HAIR * (row.z - below[0].z);
    for side in 0..2 {
        let (near, own) = (last.ends[side].x, row.ends[side].x);
        let slope = before.map_or(0.0, |b| (near - b.ends[side].x) / (last.z - b.z));
        let at = near + slope * (row.z - last.z);
        let x = if side == 0 { at.clamp(own.min(near), near) } else { at.clamp(near, own.max(near)) };
        // Where the two agree the end is that of the waterline.
        copy.ends[side].x = x;
        let inside = row.sites.iter().find(|s| (s.x - x).abs() < 1e-9);
        copy.ends[side].y = inside.map_or(0.0, |s| s.y);
    }
    let [aft, fore] = copy.ends.map(|e| e.x);
    copy.sites.retain(|s| s.x > aft + 1e-9 && s.x < fore - 1e-9);
    copy
}

/// The hull of prepared rows.
pub(super) fn loft(table: &OffsetTable, prepared: Rows) -> Result<(Hull, Vec<String>), FitError> {
    let Rows { rows, mut notes } = prepared;
    let greatest = rows.iter().flat_map(|r| r.sites.iter().map(|s| s.y).chain(r.ends.map(|e| e.y))).fold(0.0, f64::max);
    let particulars = particulars::particulars(table, &rows, &mut notes);
    let deck = particulars::deck(table, &rows, &mut notes)?;
    let mut parts = Vec::new();
    for rows in split(table, rows, &mut notes) {
        parts.push(Part::new(rows, table.stations.len(), greatest)?);
    }
    // Knots in u that serve every row, and more of them where a row swings.
    let lines = || parts.iter().flat_map(|p| &p.lines);
    let sites: Vec<Vec<f64>> = lines().map(|line| line.sites[1..line.sites.len() - 1].to_vec()).collect();
    let mut first = length_knots(&sites)?;
    let free = |knots: &KnotVector| -> Result<(Vec<f64>, bool), FitError> {
        let energy = Energy::new(knots, 2);
        let (mut middles, mut wild) = (Vec::new(), false);
        for line in lines() {
            let control = line.problem(&energy)?.solve(&line.values);
            wild |= line.excess(&control) > WILD * greatest;
            middles.extend(line.swings(knots, &control));
        }
        Ok((middles, wild))
    };
    let (mut middles, wild) = free(&first)?;
    if wild {
        // One site a span is not always enough where the sites of different waterlines do not agree.
        let breaks = first.breakpoints();
        first = with_knots(&first, breaks.windows(2).map(|w| 0.5 * (w[0] + w[1])).collect())?;
        middles = free(&first)?.0;
    }
    let u = with_knots(&first, middles)?;
    let energy = Energy::new(&u, 2);
    let mut net = Net::default();
    for part in &mut parts {
        let mut rows = Vec::with_capacity(part.lines.len());
        for line in &part.lines {
            rows.push(line.solve(&energy, line.problem(&energy)?.solve(&line.values)));
        }
        let y = part.across(&u, &rows, greatest)?;
        let x = lengths(&u, part.span, &part.profiles[0], &part.profiles[1])?;
        net.push(x, y, &part.up);
    }
    let surface = net.surface(u)?;
    let deck = BsplineCurve::new(deck.0, deck.1).map_err(HullError::from)?;
    Ok((Hull::new(&table.name, particulars, surface, deck)?, notes))
}

/// The net as it grows upwards: parts, and strips without height between them.
#[derive(Default)]
struct Net {
    x: Vec<Vec<f64>>,
    y: Vec<Vec<f64>>,
    z: Vec<f64>,
    /// Interior knots with their multiplicities, and the length so far.
    knots: Vec<f64>,
    end: f64,
}

impl Net {
    fn push(&mut self, x: Vec<Vec<f64>>, y: Vec<Vec<f64>>, up: &Heights) {
        if let (Some(a), Some(b)) = (self.x.last(), self.y.last()) {
            let blend =
                |p: &[f64], q: &[f64], t: f64| -> Vec<f64> { p.iter().zip(q).map(|(p, q)| p + (q - p) * t).collect() };
            let strips: Vec<_> = [1.0 / 3.0, 2.0 / 3.0].map(|t| (blend(a, &x[0], t), blend(b, &y[0], t))).into();
            for (x, y) in strips {
                self.x.push(x);
                self.y.push(y);
            }
            let (low, high) = (self.z[self.z.len() - 1], up.z[0]);
            self.z.extend([1.0 / 3.0, 2.0 / 3.0].map(|t| low + (high - low) * t));
            let start = self.end;
            self.end += STRIP;
            self.knots.extend([start, start, start, self.end, self.end, self.end]);
        }
        let inner = &up.knots.knots()[4..up.knots.knots().len() - 4];
        self.knots.extend(inner.iter().map(|v| self.end + v));
        self.end += 1.0;
        self.x.extend(x);
        self.y.extend(y);
        self.z.extend_from_slice(&up.z);
    }

    fn surface(self, u: KnotVector) -> Result<BsplineSurface<3>, FitError> {
        let inner = self.knots.iter().map(|v| v / self.end);
        let knots = std::iter::repeat_n(0.0, 4).chain(inner).chain(std::iter::repeat_n(1.0, 4)).collect();
        let v = KnotVector::new(3, knots).map_err(HullError::from)?;
        let mut points = Vec::with_capacity(u.basis_count() * self.z.len());
        for i in 0..u.basis_count() {
            points.extend((0..self.z.len()).map(|j| [self.x[j][i], self.y[j][i], self.z[j]]));
        }
        Ok(BsplineSurface::new(u, v, points).map_err(HullError::from)?)
    }
}
