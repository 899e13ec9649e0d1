//! `residuals.csv`: every cell of a table, and every point of its sections, beside the surface fitted to it.

use super::number::{cell, line};
use crate::hull::{Entry, Fitted, OffsetTable};

/// One row a cell: station, x, height of its waterline, half-breadth of the table (empty where it is to be predicted),
/// of the surface, and surface minus table, all in metres. Points of sections ([`Fitted::points`]) follow in the same
/// columns with their own heights.
#[must_use]
pub fn residuals_csv(table: &OffsetTable, fitted: &Fitted) -> String {
    let head = ["station", "x [m]", "waterline [m]", "table [m]", "surface [m]", "residual [m]"];
    let mut text = line(&head.map(str::to_owned));
    for residual in &fitted.cells {
        let Some(station) = table.stations.get(residual.station) else { continue };
        let given = match station.half_breadths.get(residual.waterline).map(|c| c.entry) {
            Some(Entry::Given(value)) => Some(value),
            _ => None,
        };
        text.push_str(&line(&[
            station.station.name.clone(),
            cell(Some(station.station.x)),
            cell(table.waterlines.get(residual.waterline).copied()),
            cell(given),
            cell(Some(residual.half_breadth)),
            cell(residual.residual),
        ]));
    }
    for point in fitted.points(table) {
        let Some(station) = table.stations.get(point.station) else { continue };
        text.push_str(&line(&[
            station.station.name.clone(),
            cell(Some(station.station.x)),
            cell(Some(point.height)),
            cell(Some(point.given)),
            cell(Some(point.half_breadth)),
            cell(Some(point.residual())),
        ]));
    }
    text
}
