//! Hydrostatics as a workbook with its conventions.

use rust_xlsxwriter::{DocProperties, ExcelDateTime, Format, Workbook, XlsxError};

use super::number::to_decimals;
use crate::hydrostatics::{CurvesOfForm, QUANTITIES};

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
