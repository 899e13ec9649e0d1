//! A table as a full matrix of half-breadths, and what a surface over it comes to.
//!
//! What a table leaves blank is filled so: below the lowest offset of a station, between two, and at stations without
//! any, the half-breadth is 0; above the highest offset it is the one at the deck where the table has that, else the
//! highest; an unknown cell (`?`) lies on the line between its neighbours along the waterline.

use super::super::{CellResidual, Chart, FitError, Fitted};
use crate::hull::cell::Entry;
use crate::hull::form::{Hull, HullError};
use crate::hull::offsets::{OffsetTable, StationOffsets};
use crate::hull::particulars::PrincipalParticulars;
use crate::spline::{BsplineCurve, BsplineSurface, KnotVector};
use crate::units::counted;

/// Half-breadths at every station and waterline.
pub(super) struct Matrix {
    /// Stations \[m\], rising.
    pub xs: Vec<f64>,
    /// Waterlines \[m\], rising.
    pub zs: Vec<f64>,
    /// Half-breadths \[m\], stations slowest.
    pub ys: Vec<f64>,
    /// What was assumed.
    pub notes: Vec<String>,
}

fn entry(station: &StationOffsets, waterline: usize) -> Entry {
    station.half_breadths.get(waterline).map_or(Entry::Absent, |cell| cell.entry)
}

/// The half-breadth on the line between the nearest known ones along a waterline; that of the nearest where one side
/// has none.
fn between(xs: &[f64], known: &[Option<f64>], at: usize) -> f64 {
    let before = (0..at).rev().find_map(|i| known[i].map(|y| (xs[i], y)));
    let behind = (at + 1..xs.len()).find_map(|i| known[i].map(|y| (xs[i], y)));
    match (before, behind) {
        (Some((xa, ya)), Some((xb, yb))) => ya + (yb - ya) * (xs[at] - xa) / (xb - xa),
        (Some((_, y)), None) | (None, Some((_, y))) => y,
        (None, None) => 0.0,
    }
}

impl Matrix {
    /// The matrix of a table with at least so many stations and waterlines with offsets.
    pub(super) fn new(table: &OffsetTable, least: [usize; 2]) -> Result<Self, FitError> {
        let (stations, lines) = (&table.stations, table.waterlines.len());
        let said = |i: usize, j: usize| entry(&stations[i], j) != Entry::Absent;
        let rows = (0..stations.len()).filter(|&i| (0..lines).any(|j| said(i, j))).count();
        let columns = (0..lines).filter(|&j| (0..stations.len()).any(|i| said(i, j))).count();
        for (found, least) in [(rows, least[0]), (columns, least[1])] {
            if found < least {
                return Err(FitError::TooFew { stations: rows, waterlines: columns, least });
            }
        }
        let xs: Vec<f64> = stations.iter().map(|s| s.station.x).collect();
        let (mut outside, mut above, mut unknown) = (0usize, 0usize, 0usize);
        let mut filled: Vec<Vec<Option<f64>>> = Vec::with_capacity(stations.len());
        for station in stations {
            let given: Vec<Option<f64>> =
                (0..lines).map(|j| station.half_breadths.get(j).and_then(|c| c.value())).collect();
            let highest = (0..lines).rev().find(|&j| entry(station, j) != Entry::Absent);
            let last = given.iter().rev().find_map(|y| *y);
            let row = (0..lines).map(|j| match entry(station, j) {
                Entry::Given(y) => Some(y),
                Entry::Unknown => {
                    unknown += 1;
                    None
                }
                Entry::Absent if highest.is_some_and(|top| j > top) => {
                    above += 1;
                    station.deck_half_breadth.or(last).or(Some(0.0))
                }
                Entry::Absent => {
                    outside += 1;
                    Some(0.0)
                }
            });
            filled.push(row.collect());
        }
        let mut ys = vec![0.0; stations.len() * lines];
        for j in 0..lines {
            let line: Vec<Option<f64>> = filled.iter().map(|row| row[j]).collect();
            for i in 0..stations.len() {
                ys[i * lines + j] = line[i].unwrap_or_else(|| between(&xs, &line, i));
            }
        }
        let mut notes = Vec::new();
        let mut note = |count: usize, text: &str| {
            if count > 0 {
                notes.push(format!("{count} {text}"));
            }
        };
        note(outside, "blank cells below the hull or beyond its ends have half-breadth 0");
        note(above, "blank cells above the highest offset of their station carry its half-breadth up");
        note(unknown, "unknown cells (?) lie on the line between their neighbours along the waterline");
        note(table.lines.len(), "knuckles and tangent lines of the table are not used by this method");
        Ok(Self { xs, zs: table.waterlines.clone(), ys, notes })
    }

    /// The hull of a surface, and what the surface makes of the cells.
    pub(super) fn finish(mut self, table: &OffsetTable, surface: BsplineSurface<3>) -> Result<Fitted, FitError> {
        let deck = self.deck(table)?;
        let particulars = self.particulars(table);
        let hull = Hull::new(&table.name, particulars, surface, deck)?;
        let mut cells = Vec::new();
        for (i, station) in table.stations.iter().enumerate() {
            for (j, &z) in table.waterlines.iter().enumerate() {
                let entry = entry(station, j);
                if entry == Entry::Absent {
                    continue;
                }
                // Where the surface does not reach there is no hull.
                let half_breadth = hull.half_breadth(station.station.x, z).unwrap_or(0.0);
                let residual = if let Entry::Given(y) = entry { Some(half_breadth - y) } else { None };
                cells.push(CellResidual { station: i, waterline: j, half_breadth, residual });
            }
        }
        Ok(Fitted { hull, chart: Chart::Level, cells, notes: self.notes })
    }

    /// The deck at side: the heights that the table gives, straight between; the highest waterline without, and where
    /// they are above it.
    fn deck(&mut self, table: &OffsetTable) -> Result<BsplineCurve<2>, HullError> {
        let (bottom, top) = (self.zs[0], self.zs[self.zs.len() - 1]);
        let heights = table.stations.iter().filter_map(|s| Some((s.station.x, s.deck_height.filter(|&z| z > bottom)?)));
        let mut points: Vec<[f64; 2]> = heights.map(|(x, z)| [x, z.min(top)]).collect();
        let cut =
            table.stations.iter().filter(|s| s.deck_height.is_some_and(|z| z > top + 1e-9 * (top - bottom))).count();
        if cut > 0 {
            self.notes
                .push(format!("the deck is cut at the highest waterline, {top} m, at {}", counted(cut, "station")));
        }
        if points.len() < 2 {
            points = vec![[self.xs[0], top], [self.xs[self.xs.len() - 1], top]];
            self.notes.push(format!("the deck is at the highest waterline, {top} m"));
        }
        let breakpoints: Vec<f64> = points.iter().map(|p| p[0]).collect();
        let knots = KnotVector::from_breakpoints(1, &breakpoints, &vec![1; points.len() - 2])?;
        Ok(BsplineCurve::new(knots, points)?)
    }

    /// The main dimensions that the table states, else those of its numbers.
    fn particulars(&mut self, table: &OffsetTable) -> PrincipalParticulars {
        let mut or = |stated: Option<f64>, name: &str, value: f64, from: &str| {
            stated.unwrap_or_else(|| {
                self.notes.push(format!("{name} is not stated: {value:.3} m, {from}"));
                value
            })
        };
        let top = self.zs[self.zs.len() - 1];
        let widest = self.ys.iter().copied().fold(0.0, f64::max);
        let length = self.xs[self.xs.len() - 1] - self.xs[0];
        let s = &table.stated;
        let depth = or(s.depth, "D", top, "the highest waterline");
        PrincipalParticulars {
            length_between_perpendiculars: or(
                s.length_between_perpendiculars,
                "Lpp",
                length,
                "from the first station to the last",
            ),
            breadth: or(s.breadth, "B", 2.0 * widest, "twice the largest half-breadth"),
            draught: s.draught.filter(|_| s.states_draught()),
            depth,
        }
    }
}
