//! The combs of a faired table: which lines bear them, and their scales. Stations, waterlines, buttocks and diagonals
//! have a scale each, which is the same on every sheet of a report, before and after.

use super::strip_lines::{Along, moved_most};
use crate::fairing::inspect::{Comb, Planes, combs};
use crate::fairing::record::FairRecord;
use crate::hull::{Cut, Hull};
use crate::numeric::join;
use crate::plot::ship::comb::{CombScale, LONGEST};

/// Longest tooth of a comb \[mm\].
pub(in crate::plot) const LONGEST_IN_STRIP: f64 = 7.0;
/// Longest tooth of a comb \[mm\]: the room above and below a line in its strip.
pub(in crate::plot) const LONGEST_ALONG: f64 = 10.0;
/// Teeth of a comb; its tips are joined.
pub(in crate::plot) const TEETH: usize = 241;
/// Most stations and most waterlines that bear combs where none are asked for: evenly among all, the first and the last
/// not.
const MOST: [usize; 2] = [8, 7];

/// Part of the teeth of stations, and of all other lines, that are short on a plan; the ends of these turn sharply.
const SHORT: [f64; 2] = [0.9, 0.75];
/// Length of a short tooth on a plan, as a part of the longest.
const USUAL: f64 = 0.5;
/// Part of the teeth that have room on the sheets with a panel for each station or waterline, and with a strip for each
/// other line.
const MOST_TEETH: [f64; 2] = [0.9, 0.96];
/// Length of the teeth along half of the lines where a few sharp corners would leave none to be seen, as a part of the
/// longest.
const SEEN: f64 = 0.05;
/// What the lines of a scale are called.
const KINDS: [&str; 4] = ["stations", "waterlines", "buttocks", "diagonals"];

/// Number of the kind of a plane among [`KINDS`].
fn kind(cut: &Cut) -> usize {
    match cut {
        Cut::Station { .. } => 0,
        Cut::Waterline { .. } => 1,
        Cut::Buttock { .. } => 2,
        _ => 3,
    }
}

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

impl CombLine {
    /// The plane of the line.
    #[must_use]
    pub fn cut(self, record: &FairRecord) -> Cut {
        match self {
            Self::Station(k) => super::sections::station_cut(record, record.lines.stations[k].x),
            Self::Waterline(k) => Cut::Waterline { z: record.lines.waterlines[k] },
            Self::Buttock(y) => Cut::Buttock { y },
            Self::Diagonal(height) => {
                Cut::Diagonal { height, angle: Planes::with_defaults(&record.after).diagonal_angle }
            }
        }
    }
}

/// Evenly `most` of `count` lines, without the first and the last where there are more.
pub(in crate::plot) fn some(count: usize, most: usize) -> Vec<usize> {
    if count <= most {
        return (0..count).collect();
    }
    (0..most).map(|k| ((k as f64 + 0.5) * count as f64 / most as f64).floor() as usize).collect()
}

/// The combs of a faired table.
#[derive(Debug, Clone)]
pub struct FairingCombs {
    pub(in crate::plot) buttocks: Vec<Cut>,
    pub(in crate::plot) diagonals: Vec<Cut>,
    /// The lines that bear combs on the plans.
    shown: Vec<Cut>,
    before: Vec<Comb>,
    after: Vec<Comb>,
    /// Scales of the combs of [`KINDS`].
    scales: [CombScale; 4],
}

impl FairingCombs {
    /// The combs of the lines `chosen`; where none are, of some stations and waterlines and of all buttocks and
    /// diagonals.
    #[must_use]
    pub fn new(record: &FairRecord, chosen: &[CombLine]) -> Self {
        let planes = Planes::with_defaults(&record.after);
        let angle = planes.diagonal_angle;
        let mut buttocks: Vec<Cut> = planes.buttocks.iter().map(|&y| Cut::Buttock { y }).collect();
        let mut diagonals: Vec<Cut> = planes.diagonals.iter().map(|&height| Cut::Diagonal { height, angle }).collect();
        let shown: Vec<Cut> = if chosen.is_empty() {
            let stations = some(record.lines.stations.len(), MOST[0]).into_iter().map(CombLine::Station);
            let waterlines = some(record.lines.waterlines.len(), MOST[1]).into_iter().map(CombLine::Waterline);
            let of_table = stations.chain(waterlines).map(|line| line.cut(record));
            of_table.chain(buttocks.iter().copied()).chain(diagonals.iter().copied()).collect()
        } else {
            chosen.iter().map(|line| line.cut(record)).collect()
        };
        for cut in &shown {
            match cut {
                Cut::Buttock { .. } if !buttocks.contains(cut) => buttocks.push(*cut),
                Cut::Diagonal { .. } if !diagonals.contains(cut) => diagonals.push(*cut),
                _ => {}
            }
        }
        let mut cuts = shown.clone();
        for cut in [Along::Ship, Along::Height].into_iter().flat_map(|along| moved_most(record, along)) {
            if !cuts.contains(&cut) {
                cuts.push(cut);
            }
        }
        let of = |hull: &Hull| combs(hull, &cuts, TEETH, record.resolution);
        let (before, after) = join(|| of(&record.before), || of(&record.after));
        let scales = std::array::from_fn(|k| {
            let own = || before.iter().chain(&after).filter(move |comb| kind(&comb.cut) == k);
            let plan = || CombScale::fitting(own(), SHORT[usize::from(k > 0)], USUAL * LONGEST);
            let strips = |room| CombScale::fitting(own(), MOST_TEETH[usize::from(k > 1)], room);
            if k < 2 {
                plan().coarser(strips(LONGEST_IN_STRIP))
            } else {
                let seen = CombScale::halfway(own(), SEEN * LONGEST_ALONG);
                strips(LONGEST_ALONG).finer(seen)
            }
        });
        Self { buttocks, diagonals, shown, before, after, scales }
    }

    /// The scale of the lines that `cut` is one of.
    pub(in crate::plot) fn scale(&self, cut: &Cut) -> CombScale {
        self.scales[kind(cut)]
    }

    /// That scale, for a sheet with `bearing` of `all` lines that bear combs.
    pub(in crate::plot) fn words(&self, cut: &Cut, [bearing, all]: [usize; 2]) -> String {
        let lines = if bearing < all {
            format!("{bearing} of {all} {}", KINDS[kind(cut)])
        } else {
            KINDS[kind(cut)].to_owned()
        };
        format!("combs of {lines}, on every sheet, before and after: {}", self.scale(cut).words())
    }

    /// The combs that plans show on some planes, before and after.
    pub(in crate::plot) fn on(&self, cuts: &[Cut]) -> [Vec<&Comb>; 2] {
        let shown = |comb: &&Comb| self.shown.contains(&comb.cut) && cuts.contains(&comb.cut);
        [&self.before, &self.after].map(|list| list.iter().filter(shown).collect())
    }

    /// The combs of one plane, before and after.
    pub(in crate::plot) fn of(&self, cut: Cut) -> [Vec<&Comb>; 2] {
        [&self.before, &self.after].map(|list| list.iter().filter(|comb| comb.cut == cut).collect())
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
