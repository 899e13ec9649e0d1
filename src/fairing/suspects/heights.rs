//! Suspects among the heights at buttocks: the same judge on the grid of stations and buttocks.

use super::search::{Suspects, suspects};
use crate::hull::{OffsetTable, StationOffsets, TableForm};

/// The table with heights at buttocks in place of half-breadths at waterlines; none without heights. Heights are
/// heights whatever the half-breadths are: neither doubled nor negative.
#[must_use]
pub fn height_grid(table: &OffsetTable) -> Option<OffsetTable> {
    let heights = |station: &StationOffsets| station.heights.iter().any(|cell| cell.value().is_some());
    if table.buttocks.is_empty() || !table.stations.iter().any(heights) {
        return None;
    }
    let stations = table.stations.iter().map(|station| StationOffsets {
        half_breadths: station.heights.clone(),
        ..StationOffsets::new(station.station.name.clone(), station.station.x)
    });
    Some(OffsetTable {
        name: table.name.clone(),
        waterlines: table.buttocks.clone(),
        stations: stations.collect(),
        form: TableForm { full_breadths: false, negative: false, ..table.form.clone() },
        ..OffsetTable::default()
    })
}

/// The suspects among the heights at buttocks of a table, their `waterline` the index of the buttock; none without
/// buttocks.
#[must_use]
pub fn height_suspects(table: &OffsetTable) -> Option<Suspects> {
    let mut found = suspects(&height_grid(table)?);
    for suspect in &mut found.suspects {
        suspect.id = suspect.id.replacen('S', "H", 1);
    }
    Some(found)
}
