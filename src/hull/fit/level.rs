//! The loft on the level chart: every waterline a spline of least energy through its own cells and ends, the waterlines joined
//! across.
//!
//! All waterlines share one knot vector in u, on which none has more than one site a span; each meets its cells at its own
//! sites u_ij (x(u_ij, v_j) = x_i), and what is missing is filled with the least energy int y_uu^2 du. The control values are then
//! interpolated across at the v_j, all with one factored matrix. The surface passes through every cell to rounding (below 1e-9 m).
//! Cost: linear in the number of cells.

use super::chart::{Span, heights, length_knots, lengths};
use super::rows::{Row, Rows};
use super::{FitError, particulars};
use crate::hull::{Hull, HullError, OffsetTable};
use crate::spline::{BsplineCurve, BsplineSurface, Condition, Energy, KnotVector};

/// A bottom counts as flat when its half-breadth is more than this part of that of the waterline above.
const FLAT_BOTTOM: f64 = 0.05;

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

/// Interpolates values at the sites of the waterlines in v.
fn across(knots: &KnotVector, sites: &[f64], order: usize) -> Result<crate::spline::MinimumEnergy, FitError> {
    let conditions: Vec<Condition> = sites.iter().map(|&site| Condition { site, order: 0 }).collect();
    Ok(Energy::new(knots, order).interpolation(&conditions).map_err(HullError::from)?)
}

/// The hull of prepared rows.
pub(super) fn loft(table: &OffsetTable, prepared: Rows) -> Result<(Hull, Vec<String>), FitError> {
    let Rows { rows, mut notes } = prepared;
    let z: Vec<f64> = rows.iter().map(|r| r.z).collect();
    let flat = rows[0].sites.iter().map(|s| s.y).fold(0.0, f64::max);
    let above = rows[1].sites.iter().map(|s| s.y).fold(0.0, f64::max);
    let corners: Vec<usize> = (1..rows.len() - 1).filter(|&j| rows[j].knuckle).collect();
    let blunt = flat > FLAT_BOTTOM * above;
    let up = heights(&z, &girths(&rows, table.stations.len()), &corners, blunt)?;
    let vertical = across(&up.knots, &up.sites, 2)?;
    let profile = |side: usize| vertical.solve(&rows.iter().map(|r| r.ends[side].x).collect::<Vec<f64>>());
    let (stern, stem) = (profile(0), profile(1));
    let inner =
        [stern.iter().copied().fold(f64::NEG_INFINITY, f64::max), stem.iter().copied().fold(f64::INFINITY, f64::min)];
    let span = Span { inner };
    let sites: Vec<Vec<f64>> =
        rows.iter().map(|r| r.sites.iter().map(|s| span.u(s.x, r.ends.map(|e| e.x))).collect()).collect();
    let u = length_knots(&sites)?;
    let energy = Energy::new(&u, 2);
    let (count, columns) = (u.basis_count(), up.knots.basis_count());
    let mut lines: Vec<Vec<f64>> = Vec::with_capacity(rows.len());
    for (row, sites) in rows.iter().zip(&sites) {
        let mut conditions = vec![Condition { site: 0.0, order: 0 }];
        let (mut data, mut slacks) = (vec![row.ends[0].y], vec![0.0]);
        for (&site, cell) in sites.iter().zip(&row.sites) {
            conditions.push(Condition { site, order: 0 });
            data.push(cell.y);
            slacks.push(cell.slack);
        }
        conditions.push(Condition { site: 1.0, order: 0 });
        data.push(row.ends[1].y);
        slacks.push(0.0);
        lines.push(energy.smoothing(&conditions, &slacks).map_err(HullError::from)?.solve(&data));
    }
    let x = lengths(&u, span, &stern, &stem)?;
    let mut points = Vec::with_capacity(count * columns);
    let mut column = vec![0.0; rows.len()];
    for i in 0..count {
        lines.iter().zip(&mut column).for_each(|(line, c)| *c = line[i]);
        let y = vertical.solve(&column);
        points.extend((0..columns).map(|j| [x[i * columns + j], y[j], up.z[j]]));
    }
    let surface = BsplineSurface::new(u, up.knots, points).map_err(HullError::from)?;
    let particulars = particulars::particulars(table, &rows, &mut notes);
    let deck = particulars::deck(table, &rows, &mut notes)?;
    let deck = BsplineCurve::new(deck.0, deck.1).map_err(HullError::from)?;
    Ok((Hull::new(&table.name, particulars, surface, deck)?, notes))
}
