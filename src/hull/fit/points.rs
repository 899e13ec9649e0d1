//! Readings between the lines of the net: heights at buttocks on the level chart.
//!
//! A reading says y(x, z) = b at the height z at which the buttock b meets the station x, anywhere between waterlines.
//! The surface is moved to the readings by the net d of least energy
//!
//! > int int d_uu^2 + 2 d_uv^2 + d_vv^2 du dv,   d = 0 at every cell and along the edges,   d = b - y at every reading,
//!
//! on the knots of the surface and as many more in v as the readings of a station need. The system is banded: the
//! conditions enter as penalties, and their multipliers follow by repeated solution (augmented Lagrangian: Hestenes
//! 1969, Powell 1969), which meets them to rounding. Cost: O(n w^2) for n points of the net and w along its shorter
//! side.

use super::FitError;
use super::features::FlatOfSide;
use crate::hull::cell::Entry;
use crate::hull::form::{Hull, HullError};
use crate::hull::offsets::OffsetTable;
use crate::spline::{BsplineSurface, KnotVector, basis_row, energy};
use crate::units::counted;

/// A reading nearer to the bottom than this part of the height of the hull, or to another datum of its station, says
/// nothing new.
const APART: f64 = 1e-6;

/// Weight of the penalties over the mean of the diagonal of the energy.
const PENALTY: f64 = 1e4;

/// Most rounds of multipliers.
const ROUNDS: usize = 60;

/// Readings are met when none is missed by more than this \[m\].
const MET: f64 = 1e-10;

/// A surface that leaves centreplane or greatest half-breadth by this part of it swings.
const SWING: f64 = 0.02;

/// Control values that are the half-breadth of the flat of side differ from it by less than this part.
const SAME: f64 = 1e-10;

/// Looks a span for that.
const LOOKS: usize = 4;

/// A value at a place of the surface.
#[derive(Debug, Clone, Copy)]
struct Reading {
    at: [f64; 2],
    station: usize,
    value: f64,
}

/// Moves the surface of `hull` to the heights at buttocks of the table; what cannot be followed is noted.
///
/// # Errors
/// [`FitError::Hull`] when the surface that was moved is no hull.
pub(super) fn follow(table: &OffsetTable, hull: Hull, notes: &mut Vec<String>) -> Result<Hull, FitError> {
    let (readings, beyond, bottom) = readings(table, &hull);
    if beyond > 0 {
        notes.push(format!("{} at buttocks not used: the surface does not reach there", counted(beyond, "height")));
    }
    if bottom > 0 {
        notes.push(format!(
            "{} at buttocks not used: the bottom, or an offset on a waterline, rules there",
            counted(bottom, "height")
        ));
    }
    if readings.is_empty() {
        return Ok(hull);
    }
    let surface = hull.surface();
    let away = |r: &Reading| r.value - surface.eval(r.at[0], r.at[1])[1];
    let largest = readings.iter().map(|r| away(r).abs()).fold(0.0, f64::max);
    let fine = surface.insert_knots(&[], &knots_between(surface.v(), &readings)).map_err(HullError::from)?;
    let cells = cells(table, &hull);
    let rows: Vec<(Vec<(usize, f64)>, f64)> = cells
        .iter()
        .map(|&at| (at, 0.0))
        .chain(readings.iter().map(|r| (r.at, away(r))))
        .map(|(at, value)| (basis_row(&fine, at, [0, 0]), value))
        .collect();
    let flat = FlatOfSide::new(table, &mut Vec::new()).map(|flat| flat.half);
    let Some(moves) = least_moves(&fine, &rows, flat) else {
        notes.push(format!(
            "the {} at buttocks cannot be followed between the waterlines",
            counted(readings.len(), "height")
        ));
        return Ok(hull);
    };
    let points = fine.points().iter().zip(&moves).map(|(&[x, y, z], d)| [x, y + d, z]).collect();
    let moved = BsplineSurface::new(fine.u().clone(), fine.v().clone(), points).map_err(HullError::from)?;
    // Cells and readings alike.
    let lacking = |(row, value): &(Vec<(usize, f64)>, f64)| row.iter().map(|&(k, a)| a * moves[k]).sum::<f64>() - value;
    let missed = rows.iter().map(|row| lacking(row).abs()).fold(0.0, f64::max);
    let (before, after) = (range(surface), range(&moved));
    let allowed = SWING * before[1];
    if missed > 10.0 * MET || after[0] < before[0] - allowed || after[1] > before[1] + allowed {
        notes.push(format!(
            "not followed: {} at buttocks: they contradict the offsets on waterlines, or ask for a section that swings (the \
             surface is up to {largest:.3} m away in half-breadth)",
            counted(readings.len(), "height")
        ));
        return Ok(hull);
    }
    notes.push(format!(
        "met: {} at buttocks; the surface through the offsets alone was up to {largest:.3} m away in half-breadth",
        counted(readings.len(), "height")
    ));
    Ok(Hull::new(hull.name(), *hull.particulars(), moved, hull.deck().clone())?)
}

/// The readings at which the hull reaches, without doubtful ones, how many it does not reach, and how many say nothing
/// new.
fn readings(table: &OffsetTable, hull: &Hull) -> (Vec<Reading>, usize, usize) {
    let (mut list, mut beyond, mut known): (Vec<Reading>, usize, usize) = (Vec::new(), 0, 0);
    let height = hull.top() - hull.bottom();
    for (station, column) in table.stations.iter().enumerate() {
        for (cell, &value) in column.heights.iter().zip(&table.buttocks) {
            let doubtful = cell.marks.doubtful && !cell.marks.locked;
            let Some(z) = cell.value().filter(|z| z.is_finite() && value > 0.0 && !doubtful) else { continue };
            let on_line = column
                .half_breadths
                .iter()
                .zip(&table.waterlines)
                .any(|(c, w)| c.value().is_some() && (w - z).abs() <= APART * height);
            if z <= hull.bottom() + APART * height || on_line {
                known += 1;
                continue;
            }
            match hull.parameters(column.station.x, z) {
                Some(at) if list.iter().any(|r| r.station == station && (r.at[1] - at[1]).abs() <= APART) => known += 1,
                Some(at) => list.push(Reading { at, station, value }),
                None => beyond += 1,
            }
        }
    }
    (list, beyond, known)
}

/// The places of the given cells.
fn cells(table: &OffsetTable, hull: &Hull) -> Vec<[f64; 2]> {
    let columns = table
        .stations
        .iter()
        .flat_map(|s| s.half_breadths.iter().zip(&table.waterlines).map(move |(c, &z)| (s.station.x, c.entry, z)));
    columns
        .filter(|(_, entry, _)| matches!(entry, Entry::Given(_)))
        .filter_map(|(x, _, z)| hull.parameters(x, z))
        .collect()
}

/// Knots such that no span holds two readings of a station, and a reading shares none with both its neighbours on the
/// knots.
fn knots_between(v: &KnotVector, readings: &[Reading]) -> Vec<f64> {
    let breaks = v.breakpoints();
    let stations = readings.iter().map(|r| r.station).max().map_or(0, |s| s + 1);
    let mut added = Vec::new();
    for span in breaks.windows(2) {
        let mut gaps: Vec<[f64; 2]> = Vec::new();
        for station in 0..stations {
            let mut own: Vec<f64> = readings
                .iter()
                .filter(|r| r.station == station && r.at[1] > span[0] && r.at[1] < span[1])
                .map(|r| r.at[1])
                .collect();
            if own.is_empty() {
                continue;
            }
            own.sort_by(f64::total_cmp);
            own.push(span[1]);
            gaps.extend(own.windows(2).map(|w| [w[0], w[1]]));
        }
        gaps.sort_by(|a, b| a[1].total_cmp(&b[1]));
        // The fewest knots that have one in each gap.
        let mut common: Option<[f64; 2]> = None;
        for [low, high] in gaps {
            match &mut common {
                Some([from, to]) if low < *to => *from = from.max(low),
                _ => {
                    added.extend(common.map(|[from, to]| 0.5 * (from + to)));
                    common = Some([low, high]);
                }
            }
        }
        added.extend(common.map(|[from, to]| 0.5 * (from + to)));
    }
    added
}

/// The moves of the net of least energy that meet `rows` and leave the edges stern, stem and bottom and the flat of
/// side of half-breadth `flat`; none where they cannot.
fn least_moves(surface: &BsplineSurface<3>, rows: &[(Vec<(usize, f64)>, f64)], flat: Option<f64>) -> Option<Vec<f64>> {
    let [along, across] = surface.shape();
    let count = along * across;
    let on_flat = |k: usize| flat.is_some_and(|half| (surface.points()[k][1] - half).abs() <= SAME * half);
    let held = |k: usize| k < across || k >= count - across || k.is_multiple_of(across) || on_flat(k);
    let mut matrix = energy(surface.u(), surface.v(), 2, 1.0);
    let weight = PENALTY * matrix.trace() / count as f64;
    let free: Vec<Vec<(usize, f64)>> =
        rows.iter().map(|(row, _)| row.iter().copied().filter(|(k, _)| !held(*k)).collect()).collect();
    for row in &free {
        for &(i, a) in row {
            for &(j, b) in row.iter().filter(|(j, _)| *j <= i) {
                matrix.add(i, j, weight * a * b);
            }
        }
    }
    // What is held has no neighbours.
    for i in 0..count {
        for j in i.saturating_sub(matrix.width())..=i {
            if held(i) || held(j) {
                let value = matrix.get(i, j);
                matrix.add(i, j, if i == j { 1.0 - value } else { -value });
            }
        }
    }
    let factor = matrix.factor().ok()?;
    let mut multipliers = vec![0.0; rows.len()];
    let mut moves = vec![0.0; count];
    for _ in 0..ROUNDS {
        moves.fill(0.0);
        for ((row, (_, value)), multiplier) in free.iter().zip(rows).zip(&multipliers) {
            row.iter().for_each(|&(k, a)| moves[k] += a * (weight * value + multiplier));
        }
        factor.solve(&mut moves);
        let mut worst = 0.0f64;
        for ((row, (_, value)), multiplier) in free.iter().zip(rows).zip(&mut multipliers) {
            let lacking = value - row.iter().map(|&(k, a)| a * moves[k]).sum::<f64>();
            *multiplier += weight * lacking;
            worst = worst.max(lacking.abs());
        }
        if worst <= MET {
            break;
        }
    }
    moves.iter().all(|d| d.is_finite()).then_some(moves)
}

/// The least and the greatest half-breadth of a surface \[m\].
fn range(surface: &BsplineSurface<3>) -> [f64; 2] {
    let places = |knots: &KnotVector| -> Vec<f64> {
        let breaks = knots.breakpoints();
        let look = |k: usize| (k as f64 + 0.5) / LOOKS as f64;
        breaks.windows(2).flat_map(|w| (0..LOOKS).map(move |k| w[0] + (w[1] - w[0]) * look(k))).collect()
    };
    let across = places(surface.v());
    let mut range = [f64::INFINITY, f64::NEG_INFINITY];
    for u in places(surface.u()) {
        for &v in &across {
            let y = surface.eval(u, v)[1];
            range = [range[0].min(y), range[1].max(y)];
        }
    }
    range
}
