//! The lines of a table that have a strip of their own: those that moved most.

use super::sections::station_cut;
use crate::fairing::change::Change;
use crate::fairing::record::FairRecord;
use crate::fairing::surface::Origin;
use crate::hull::Cut;
use crate::plot::ship::caption;

/// Most columns and rows of strips on a sheet.
pub(in crate::plot) const GRID: [usize; 2] = [2, 3];
/// Fewest offsets of a line that has a strip.
const LEAST: usize = 4;

/// What the lines run along.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::plot) enum Along {
    /// Waterlines.
    Ship,
    /// Stations, laid on their side: heights to the right.
    Height,
}

impl Along {
    /// Coordinate along the line: 0 or 2.
    pub(in crate::plot) fn axis(self) -> usize {
        match self {
            Self::Ship => 0,
            Self::Height => 2,
        }
    }

    pub(in crate::plot) fn place(self, change: &Change) -> f64 {
        match self {
            Self::Ship => change.x,
            Self::Height => change.z,
        }
    }

    pub(in crate::plot) fn words(self) -> [&'static str; 3] {
        match self {
            Self::Ship => ["WATERLINES", "waterlines", "x forward of AP [m]"],
            Self::Height => ["STATIONS", "stations", "z above the base line [m]"],
        }
    }
}

/// A line with its offsets.
pub(in crate::plot) struct StripLine<'a> {
    pub(in crate::plot) name: String,
    pub(in crate::plot) cut: Cut,
    pub(in crate::plot) offsets: Vec<&'a Change>,
    /// Root of the mean square and largest of its moves \[m\].
    pub(in crate::plot) moves: [f64; 2],
}

/// The lines that moved most, in their order on the ship.
pub(in crate::plot) fn chosen(record: &FairRecord, along: Along) -> Vec<StripLine<'_>> {
    let count = if along == Along::Ship { record.lines.waterlines.len() } else { record.lines.stations.len() };
    let line = |k: usize| {
        let own = |change: &&Change| match along {
            Along::Ship => matches!(change.origin, Origin::HalfBreadth { waterline, .. } if waterline == k),
            Along::Height => change.station == k && !matches!(change.origin, Origin::Deck { .. }),
        };
        let mut offsets: Vec<&Change> = record.changes.iter().filter(own).collect();
        offsets.sort_by(|a, b| along.place(a).total_cmp(&along.place(b)));
        let kept: Vec<f64> = offsets.iter().filter(|c| !c.suspect).map(|c| (c.after - c.before).abs()).collect();
        let squares: f64 = kept.iter().map(|by| by * by).sum();
        let moves = [(squares / kept.len().max(1) as f64).sqrt(), kept.iter().copied().fold(0.0, f64::max)];
        let (name, cut) = match along {
            Along::Ship => {
                let z = record.lines.waterlines[k];
                (format!("waterline {z:.3} m"), Cut::Waterline { z })
            }
            Along::Height => {
                let station = &record.lines.stations[k];
                let name: String = caption::plain(&station.words()).chars().take(24).collect();
                (name, station_cut(record, station.x))
            }
        };
        StripLine { name, cut, offsets, moves }
    };
    let mut lines: Vec<(usize, StripLine<'_>)> =
        (0..count).map(|k| (k, line(k))).filter(|(_, line)| line.offsets.len() >= LEAST).collect();
    lines.sort_by(|a, b| b.1.moves[0].total_cmp(&a.1.moves[0]).then(a.0.cmp(&b.0)));
    lines.truncate(GRID[0] * GRID[1]);
    lines.sort_by_key(|(k, _)| *k);
    lines.into_iter().map(|(_, line)| line).collect()
}

/// The planes of the lines that moved most.
pub(in crate::plot) fn moved_most(record: &FairRecord, along: Along) -> Vec<Cut> {
    chosen(record, along).into_iter().map(|line| line.cut).collect()
}
