//! How well a table fixes its volume, found from the table itself.
//!
//! The hull is fitted again from every second station, and again from every second waterline. An error that falls with the
//! square of the spacing is a third of what the volume changes by (Richardson 1911); the surface is better than that where the
//! hull is smooth, so that the estimate is on the safe side there. It says nothing of errors that all lines share: ends of
//! waterlines and bottoms that the table does not give.

use super::super::{Functional, Hull, OffsetTable};
use super::method::FitMethod;

/// Fewest lines of which every second one can be left out.
const LEAST: usize = 5;

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
    /// The estimate for `hull`, the fit of `table`, below `draught` \[m\].
    #[must_use]
    pub fn new(table: &OffsetTable, hull: &Hull, draught: f64) -> Self {
        let volume = Functional::Volume.value(hull, draught);
        let error = |coarse: OffsetTable| {
            let fitted = Hull::fit(&coarse, &FitMethod::Graded).ok()?;
            let other = Functional::Volume.value(&fitted.hull, draught);
            (volume > 0.0).then(|| (other - volume).abs() / (3.0 * volume))
        };
        Self {
            volume,
            stations: every_second_station(table).and_then(error),
            waterlines: every_second_waterline(table, draught).and_then(error),
        }
    }

    /// The estimate in words.
    #[must_use]
    pub fn words(&self) -> String {
        let part = |value: Option<f64>| value.map_or("not to be told".to_owned(), |e| format!("{:.2} %", 100.0 * e));
        format!(
            "The table fixes the volume to about {} by its stations and {} by its waterlines (fits from every second one).",
            part(self.stations),
            part(self.waterlines)
        )
    }
}

/// Every second station; the first and the last stay.
fn every_second_station(table: &OffsetTable) -> Option<OffsetTable> {
    let count = table.stations.len();
    let mut coarse = table.clone();
    let mut index = 0;
    coarse.stations.retain(|_| {
        index += 1;
        index % 2 == 1 || index == count
    });
    (count >= LEAST).then_some(coarse)
}

/// Every second waterline; the lowest, the highest and the one at the draught stay.
fn every_second_waterline(table: &OffsetTable, draught: f64) -> Option<OffsetTable> {
    let count = table.waterlines.len();
    let slack = 1e-9 * draught.abs();
    let kept: Vec<bool> =
        (0..count).map(|j| j % 2 == 0 || j + 1 == count || (table.waterlines[j] - draught).abs() <= slack).collect();
    let keep = |j: usize| kept.get(j).copied().unwrap_or(false);
    let mut coarse = table.clone();
    coarse.waterlines = (0..count).filter(|&j| kept[j]).map(|j| table.waterlines[j]).collect();
    coarse.endings = table.endings.iter().enumerate().filter(|(j, _)| keep(*j)).map(|(_, e)| *e).collect();
    for (column, source) in coarse.stations.iter_mut().zip(&table.stations) {
        let cells = source.half_breadths.iter().enumerate();
        column.half_breadths = cells.filter(|(j, _)| keep(*j)).map(|(_, c)| c.clone()).collect();
    }
    (count >= LEAST && coarse.waterlines.len() < count).then_some(coarse)
}
