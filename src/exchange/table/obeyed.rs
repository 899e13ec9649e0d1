//! What the TOML beside a file says of a table in a format of another program.

use super::problem::{FilePosition, Problems};
use super::settings::Settings;
use crate::hull::{Entry, OffsetTable};

/// Takes over the name, the dimensions, the breadths, the lines and the transom; names the keys that mean nothing for such a
/// file, `units` among them where it states its `own_unit`.
pub(super) fn obey(settings: &Settings, own_unit: bool, table: &mut OffsetTable, problems: &mut Problems) {
    if let Some(name) = &settings.name {
        table.name.clone_from(name);
    }
    table.stated = settings.stated.over(&table.stated);
    table.transom = settings.transom.or(table.transom);
    table.lines.extend(settings.lines.iter().cloned());
    if settings.full == Some(true) {
        for station in &mut table.stations {
            station.outlines.iter_mut().flatten().for_each(|point| point.y *= 0.5);
            for cell in &mut station.half_breadths {
                if let Entry::Given(value) = &mut cell.entry {
                    *value *= 0.5;
                }
            }
        }
    }
    let keys = [
        ("units", own_unit && settings.units.is_some()),
        ("rows", settings.rows.is_some()),
        ("layout", settings.layout.is_some()),
        ("waterline_spacing", settings.waterline_spacing.is_some()),
        ("buttock_spacing", settings.buttock_spacing.is_some()),
        ("station_spacing", settings.station_spacing.is_some()),
        ("spaces", settings.spaces.is_some()),
        ("sheet", settings.sheet.is_some()),
        ("endings", settings.endings.iter().any(|ends| !ends.is_empty()) && table.waterlines.is_empty()),
    ];
    let idle: Vec<&str> = keys.into_iter().filter(|(_, given)| *given).map(|(key, _)| key).collect();
    if !idle.is_empty() {
        let message = format!("the conventions of the table have no meaning for this format: {}", idle.join(", "));
        problems.warning("W332", FilePosition::FILE, message, "");
    }
}
