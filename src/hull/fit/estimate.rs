//! How well a table fixes a figure of its hull, found from the table itself.
//!
//! The hull is fitted again from every second station, and again from every second waterline (or point of a section).
//! An error that falls with the square of the spacing is a third of what the figure changes by (Richardson 1911); the
//! surface is better than that where the hull is smooth, so that the estimate is on the safe side there. It says
//! nothing of errors that all lines share: ends of waterlines and bottoms that the table does not give. Cost: two more
//! fits.

use super::super::{Functional, Hull, OffsetTable};
use super::features::runs_along;
use super::method::FitMethod;
use crate::hull::cell::LineKind;

/// Fewest lines of which every second one can be left out.
const LEAST: usize = 5;

/// The hulls of a table without every second line.
#[derive(Debug, Clone)]
pub struct Thinned {
    /// From every second station, the first and the last among them; none with fewer than five stations, or where they
    /// make no hull.
    pub stations: Option<Hull>,
    /// From every second waterline (the lowest, the highest and the one at the draught stay) and every second point of a
    /// section; none with fewer than five, or where they make no hull.
    pub waterlines: Option<Hull>,
}

impl Thinned {
    /// Both fits of `table` by `method`; `draught` \[m\] is the waterline that stays.
    #[must_use]
    pub fn new(table: &OffsetTable, method: &FitMethod, draught: f64) -> Self {
        let fit = |thin: OffsetTable| Hull::fit(&thin, method).ok().map(|fitted| fitted.hull);
        Self {
            stations: every_second_station(table).and_then(fit),
            waterlines: every_second_waterline(table, draught).and_then(fit),
        }
    }

    /// Richardson's estimate of the error of `fine`, where half as many lines give `coarse`: |coarse - fine| / 3, in
    /// their unit.
    #[must_use]
    pub fn error(fine: f64, coarse: f64) -> f64 {
        (coarse - fine).abs() / 3.0
    }
}

/// Estimated relative errors of the volume.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct VolumeEstimate {
    /// The volume of the fitted hull below the draught \[m^3\].
    pub volume: f64,
    /// Relative error from the spacing of stations; none with too few of them.
    pub stations: Option<f64>,
    /// Relative error from the spacing of waterlines; none with too few of them.
    pub waterlines: Option<f64>,
}

impl VolumeEstimate {
    /// The estimate for `hull`, the fit of `table` by `method`, below `draught` \[m\].
    #[must_use]
    pub fn new(table: &OffsetTable, method: &FitMethod, hull: &Hull, draught: f64) -> Self {
        let volume = Functional::Volume.value(hull, draught);
        let thinned = Thinned::new(table, method, draught);
        let error = |coarse: &Hull| {
            let other = Functional::Volume.value(coarse, draught);
            (volume > 0.0).then(|| Thinned::error(volume, other) / volume)
        };
        Self {
            volume,
            stations: thinned.stations.as_ref().and_then(error),
            waterlines: thinned.waterlines.as_ref().and_then(error),
        }
    }

    /// Both errors together; none where one of them cannot be told.
    #[must_use]
    pub fn total(&self) -> Option<f64> {
        Some(self.stations? + self.waterlines?)
    }

    /// The estimate in words.
    #[must_use]
    pub fn words(&self) -> String {
        let percent = |value: f64| format!("{:.2} %", 100.0 * value);
        let part = |value: Option<f64>| value.map_or("is not known".to_owned(), percent);
        let whole = self.total().map_or_else(
            || "The error of the volume".to_owned(),
            |e| format!("The table determines the volume to about {}", percent(e)),
        );
        format!("{whole} (stations {}, waterlines {})", part(self.stations), part(self.waterlines))
    }
}

/// Whether the line `k` of `count` stays when every second one is left out; both ends stay.
fn stays(k: usize, count: usize) -> bool {
    k.is_multiple_of(2) || k + 1 == count
}

/// The items of `list` whose index is kept.
fn kept<T: Clone>(list: &[T], keep: impl Fn(usize) -> bool) -> Vec<T> {
    list.iter().enumerate().filter(|(k, _)| keep(*k)).map(|(_, item)| item.clone()).collect()
}

/// Every second station.
fn every_second_station(table: &OffsetTable) -> Option<OffsetTable> {
    let count = table.stations.len();
    (count >= LEAST).then(|| OffsetTable { stations: kept(&table.stations, |k| stays(k, count)), ..table.clone() })
}

/// Every second waterline and those that are knuckles and tangent lines, and every second point of a section.
fn every_second_waterline(table: &OffsetTable, draught: f64) -> Option<OffsetTable> {
    let count = table.waterlines.len();
    let slack = 1e-9 * draught.abs();
    let line = |j: usize| [LineKind::Knuckle, LineKind::Tangent].into_iter().any(|kind| runs_along(table, j, kind));
    let lines: Vec<bool> = (0..count).map(line).collect();
    // A short list would lose what it says.
    let keep = |j: usize| {
        count < LEAST
            || stays(j, count)
            || table.waterlines.get(j).is_some_and(|z| (z - draught).abs() <= slack)
            // A line of the hull is no sample of it.
            || lines.get(j) == Some(&true)
    };
    let mut thin = table.clone();
    let mut fewer = false;
    thin.waterlines = kept(&table.waterlines, keep);
    thin.endings = kept(&table.endings, keep);
    fewer |= thin.waterlines.len() < count;
    for column in &mut thin.stations {
        column.half_breadths = kept(&column.half_breadths, keep);
        for outline in column.outlines.iter_mut().filter(|outline| outline.len() >= LEAST) {
            *outline = kept(outline, |k| stays(k, outline.len()));
            fewer = true;
        }
    }
    fewer.then_some(thin)
}
