//! The loft on the level chart: every waterline a spline of least energy through its own cells and ends, the waterlines
//! joined across.
//!
//! All waterlines share one knot vector in u, on which none has more than one site a span; each meets its cells at its
//! own sites u_ij (x(u_ij, v_j) = x_i), and what is missing is filled with the least energy int y_uu^2 du. The control
//! values are then interpolated across at the v_j with the least energy int y_vv^2 dv. The surface passes through every
//! cell to rounding (below 1e-9 m), and stays between the centreplane and the greatest half-breadth but for swings
//! below 1e-4 of it ([`super::bounded`]).
//!
//! Where a profile jumps along a level keel (a dome or skeg below it) the surface has a level strip without height,
//! which is the keel: the waterline there is written twice, for the body below and for the hull, and the lines across
//! break at both.
//!
//! Cost: linear in the number of cells.

mod part;

use super::super::{Hull, HullError, OffsetTable};
use super::FitError;
use super::bounded::{with_knots, with_multiple};
use super::chart::{Heights, length_knots};
use super::features::{self, FlatOfSide};
use super::particulars;
use super::rows::{Row, Rows};
use crate::spline::{BsplineCurve, BsplineSurface, Energy, KnotVector};
use part::{Columns, Part, Shape};

/// Control values of a waterline this far beyond centreplane and greatest half-breadth, over the latter, ask for more
/// knots.
const WILD: f64 = 0.05;

/// A profile jumps when an end moves by more than this part of the longest waterline from one waterline to the next.
const JUMP: f64 = 0.4;

/// How far from level such a keel may be, over the height of the table.
const LEVEL: f64 = 2e-3;

/// Width in v of a strip without height, over that of the whole.
const STRIP: f64 = 0.02;

/// Height of a strip over that of the body below it.
const HAIR: f64 = 1e-9;

/// Rounds in which rows are kept above the centreplane: what is held in one gap may swing in the next.
const STEERED: usize = 4;

/// Splits the rows where a profile jumps to a longer waterline; the longer one is written a second time, between the
/// ends of the body below.
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
    let mut copy = Row { transom: false, ..row.clone() };
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

/// Knots in u that serve every row, more of them where a row swings, and the control values of all rows.
fn length_rows(parts: &[Part], greatest: f64) -> Result<(KnotVector, Vec<Vec<f64>>), FitError> {
    let lines = || parts.iter().flat_map(|p| &p.lines);
    let sites: Vec<Vec<f64>> = lines().map(|line| line.sites[1..line.sites.len() - 1].to_vec()).collect();
    let edges = lines().flat_map(|line| line.slopes.iter().map(|s| line.sites[s.0]));
    let edges: Vec<f64> = edges.filter(|&u| u > 0.0 && u < 1.0).collect();
    let mut first = with_multiple(&length_knots(&sites)?, &edges, 2)?;
    let free = |knots: &KnotVector| -> Result<(Vec<f64>, bool), FitError> {
        let energy = Energy::new(knots, 2);
        let (mut middles, mut wild) = (Vec::new(), false);
        for line in lines() {
            let control = line.free(&energy)?;
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
    let rows: Result<Vec<Vec<f64>>, FitError> =
        lines().map(|line| Ok(line.flattened(&u, line.solve(&energy, line.free(&energy)?)))).collect();
    Ok((u, rows?))
}

/// The hull of prepared rows.
pub(super) fn loft(table: &OffsetTable, prepared: Rows) -> Result<(Hull, Vec<String>), FitError> {
    let Rows { rows, mut notes } = prepared;
    let greatest = rows.iter().flat_map(|r| r.sites.iter().map(|s| s.y).chain(r.ends.map(|e| e.y))).fold(0.0, f64::max);
    let particulars = particulars::particulars(table, &rows, &mut notes);
    let deck = particulars::deck(table, &rows, &mut notes)?;
    let flat = FlatOfSide::new(table, &mut notes);
    let shape = Shape { flat: flat.as_ref(), transom: table.transom };
    features::unused(table, flat.as_ref(), &mut notes);
    let mut parts = Vec::new();
    for rows in split(table, rows, &mut notes) {
        parts.push(Part::new(rows, table.stations.len(), greatest, shape)?);
    }
    let mut lined = length_rows(&parts, greatest)?;
    // Where a row falls below the centreplane between two cells it follows the monotone cubic there.
    for _ in 0..STEERED {
        let (u, rows) = &lined;
        let lines = parts.iter_mut().flat_map(|p| &mut p.lines);
        let steered = lines.zip(rows).map(|(line, control)| line.steer(u, control, -line.tolerance));
        if steered.filter(|&steered| steered).count() == 0 {
            break;
        }
        lined = length_rows(&parts, greatest)?;
    }
    let (u, rows) = lined;
    let mut rows = rows.into_iter();
    let mut net = Net::default();
    for part in &mut parts {
        let rows: Vec<Vec<f64>> = rows.by_ref().take(part.lines.len()).collect();
        let Columns { x, y } = part.across(&u, &rows, greatest, flat.as_ref())?;
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
