//! The combs of a faired table: which lines bear them, and their scales. Lines around the ship (stations) have one scale and lines along
//! her (waterlines, buttocks, diagonals) another, in all figures, before and after.

use super::comb::CombScale;
use crate::fairing::inspect::{Comb, Planes, combs};
use crate::fairing::record::FairRecord;
use crate::hull::{Cut, Hull};

/// Teeth of a comb; its tips are joined.
pub(super) const TEETH: usize = 241;
/// Most stations and most waterlines that bear combs where none are asked for: evenly among all, the first and the last not.
const MOST: [usize; 2] = [8, 7];

/// Part of the teeth of stations, and of all other lines, that are short; the ends of these turn sharply.
const SHORT: [f64; 2] = [0.9, 0.75];

/// A line that bears a comb.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum CombLine {
    /// A station of the table, by its number in the list of stations.
    Station(usize),
    /// A waterline of the table, by its number in the list of waterlines.
    Waterline(usize),
    /// A buttock, by its distance from the centreplane \[m\].
    Buttock(f64),
    /// A diagonal, by its height on the centreplane \[m\].
    Diagonal(f64),
}

/// Evenly `most` of `count` lines, without the first and the last where there are more.
fn some(count: usize, most: usize) -> Vec<usize> {
    if count <= most {
        return (0..count).collect();
    }
    (0..most).map(|k| ((k as f64 + 0.5) * count as f64 / most as f64).floor() as usize).collect()
}

/// The combs of a faired table.
#[derive(Debug, Clone)]
pub struct FairingCombs {
    pub(super) buttocks: Vec<Cut>,
    pub(super) diagonals: Vec<Cut>,
    pub(super) before: Vec<Comb>,
    pub(super) after: Vec<Comb>,
    /// Scale of the combs of stations.
    pub(super) around: CombScale,
    /// Scale of the combs of all other lines.
    pub(super) along: CombScale,
}

impl FairingCombs {
    /// The combs of the lines `chosen`; where none are, of some stations and waterlines and of all buttocks and diagonals.
    #[must_use]
    pub fn new(record: &FairRecord, chosen: &[CombLine]) -> Self {
        let planes = Planes::with_defaults(&record.after);
        let angle = planes.diagonal_angle;
        let mut buttocks: Vec<Cut> = planes.buttocks.iter().map(|&y| Cut::Buttock { y }).collect();
        let mut diagonals: Vec<Cut> = planes.diagonals.iter().map(|&height| Cut::Diagonal { height, angle }).collect();
        let station = |k: usize| super::fairing::station_cut(record, record.lines.stations[k].x);
        let waterline = |k: usize| Cut::Waterline { z: record.lines.waterlines[k] };
        let cuts: Vec<Cut> = if chosen.is_empty() {
            let stations = some(record.lines.stations.len(), MOST[0]).into_iter().map(station);
            let waterlines = some(record.lines.waterlines.len(), MOST[1]).into_iter().map(waterline);
            stations.chain(waterlines).chain(buttocks.iter().copied()).chain(diagonals.iter().copied()).collect()
        } else {
            let cut = |line: &CombLine| match *line {
                CombLine::Station(k) => station(k),
                CombLine::Waterline(k) => waterline(k),
                CombLine::Buttock(y) => Cut::Buttock { y },
                CombLine::Diagonal(height) => Cut::Diagonal { height, angle },
            };
            chosen.iter().map(cut).collect()
        };
        for cut in &cuts {
            match cut {
                Cut::Buttock { .. } if !buttocks.contains(cut) => buttocks.push(*cut),
                Cut::Diagonal { .. } if !diagonals.contains(cut) => diagonals.push(*cut),
                _ => {}
            }
        }
        let of = |hull: &Hull| combs(hull, &cuts, TEETH, record.tolerance());
        let (before, after) = (of(&record.before), of(&record.after));
        let scale = |around: bool| {
            let own = move |comb: &&Comb| matches!(comb.cut, Cut::Station { .. }) == around;
            CombScale::fitting(before.iter().chain(&after).filter(own), SHORT[usize::from(!around)])
        };
        Self { buttocks, diagonals, around: scale(true), along: scale(false), before, after }
    }

    /// The scale of the lines that `cut` is one of.
    pub(super) fn scale(&self, cut: &Cut) -> CombScale {
        if matches!(cut, Cut::Station { .. }) { self.around } else { self.along }
    }

    /// The combs on some planes, before and after.
    pub(super) fn on(&self, cuts: &[Cut]) -> [Vec<&Comb>; 2] {
        [&self.before, &self.after].map(|list| list.iter().filter(|comb| cuts.contains(&comb.cut)).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_with_combs_are_spread_over_all() {
        assert_eq!(some(3, 8), [0, 1, 2]);
        assert_eq!(some(25, 8), [1, 4, 7, 10, 14, 17, 20, 23]);
    }
}
