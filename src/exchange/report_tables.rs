//! Tables of a report: offsets on diagonals and areas of sections as CSV, hydrostatics as a workbook with its
//! conventions.

use rust_xlsxwriter::{DocProperties, ExcelDateTime, Format, Workbook, XlsxError};

use super::number::{cell, line, to_decimals};
use crate::hull::{Hull, OffsetStation, diagonal_offset};
use crate::hydrostatics::{CurvesOfForm, QUANTITIES};
use crate::units::Notation;

/// Distances along diagonals of `angle` \[rad\] below the horizontal that start at `heights` \[m\] on the centreplane:
/// one row a station, empty where a diagonal does not meet the side.
#[must_use]
pub fn diagonals_csv(
    hull: &Hull,
    stations: &[OffsetStation],
    heights: &[f64],
    angle: f64,
    notation: Notation,
) -> String {
    let mut head = vec![format!("x\\height on CL {:.3} deg down [{}]", angle.to_degrees(), notation.as_str())];
    head.extend(heights.iter().map(|&height| notation.write(micrometres(height))));
    let mut text = line(&head);
    for station in stations {
        let mut row = vec![notation.write(micrometres(station.x))];
        let offset = |&height: &f64| diagonal_offset(hull, station.x, height, angle);
        row.extend(
            heights.iter().map(|height| offset(height).map_or(String::new(), |s| notation.write(micrometres(s)))),
        );
        text.push_str(&line(&row));
    }
    text
}

/// A length \[m\] to the micrometre, for tables that people read.
#[must_use]
pub fn micrometres(length: f64) -> f64 {
    to_decimals(length, 6)
}

/// Areas of sections, both sides [m^2]: one row a height \[m\], one column a station \[m from AP\]; empty above the deck.
#[must_use]
pub fn section_areas_csv(stations: &[f64], heights: &[f64], areas: &[Vec<Option<f64>>]) -> String {
    let mut head = vec!["z [m]\\x [m], areas [m2]".to_owned()];
    head.extend(stations.iter().map(|x| cell(Some(micrometres(*x)))));
    let mut text = line(&head);
    for (height, row) in heights.iter().zip(areas) {
        let mut fields = vec![cell(Some(micrometres(*height)))];
        fields.extend(row.iter().map(|area| cell(area.map(micrometres))));
        text.push_str(&line(&fields));
    }
    text
}

/// The hydrostatic table as a workbook: a sheet of the table with one row of keys and one of units, a sheet of
/// `conventions` (what, how), and a sheet that defines every quantity. Same table, same bytes.
///
/// # Errors
/// What a workbook cannot hold, in words.
pub fn hydrostatics_workbook(table: &CurvesOfForm, conventions: &[(String, String)]) -> Result<Vec<u8>, String> {
    write(table, conventions).map_err(|error| error.to_string())
}

fn write(table: &CurvesOfForm, conventions: &[(String, String)]) -> Result<Vec<u8>, XlsxError> {
    let mut book = Workbook::new();
    let made = ExcelDateTime::from_ymd(2000, 1, 1)?;
    book.set_properties(&DocProperties::new().set_creation_datetime(&made));
    let bold = Format::new().set_bold();
    let sheet = book.add_worksheet();
    sheet.set_name("Hydrostatics")?;
    sheet.set_freeze_panes(2, 1)?;
    for (column, quantity) in (0..).zip(QUANTITIES) {
        let digits =
            if quantity.decimals == 0 { "0".to_owned() } else { format!("0.{}", "0".repeat(quantity.decimals)) };
        let format = Format::new().set_num_format(digits);
        sheet.write_string_with_format(0, column, quantity.key, &bold)?;
        sheet.write_string(1, column, quantity.unit)?;
        // Six digits more than are shown.
        for (row, values) in (2..).zip(&table.rows) {
            if let Some(value) = (quantity.value)(values).filter(|value| value.is_finite()) {
                sheet.write_number_with_format(row, column, to_decimals(value, quantity.decimals + 6), &format)?;
            }
        }
    }
    let sheet = book.add_worksheet();
    sheet.set_name("Conventions")?;
    sheet.set_column_width(0, 28)?;
    sheet.set_column_width(1, 80)?;
    for (row, (what, how)) in (0..).zip(conventions) {
        sheet.write_string_with_format(row, 0, what, &bold)?;
        sheet.write_string(row, 1, how)?;
    }
    let sheet = book.add_worksheet();
    sheet.set_name("Quantities")?;
    sheet.set_column_width(1, 36)?;
    sheet.set_column_width(3, 80)?;
    for (column, head) in (0..).zip(["key", "quantity", "unit", "definition"]) {
        sheet.write_string_with_format(0, column, head, &bold)?;
    }
    for (row, quantity) in (1..).zip(QUANTITIES) {
        for (column, text) in (0..).zip([quantity.key, quantity.name, quantity.unit, quantity.definition]) {
            sheet.write_string(row, column, text)?;
        }
    }
    book.save_to_buffer()
}
