//! The sheets of an XLSX workbook, as the rows of CSV files, and the text of a table as a workbook.
//!
//! A row that begins with `#` is a comment, as in CSV. Texts that are numbers with decimal commas are numbers. Formulas
//! without stored values, dates and errors are refused, each kind in one line. Units and words of number formats count as text
//! beside the number; hidden rows and columns are left out as hidden sheets are. In a workbook that is written, plain decimal numbers are
//! numbers, shown with their digits, and all else is text; the same table gives the same bytes.
//!
//! Cells are taken one by one, so that a sheet that claims a million rows costs nothing. Packed workbooks that say to
//! hold more than [`MOST_UNPACKED`] bytes are refused; a workbook that lies about it is not recognised.

use std::collections::{BTreeMap, BTreeSet};
use std::io::{Cursor, Read as _};

use calamine::{DataRef, Dimensions, Reader as _, SheetVisible, Style, Xlsx};
use rust_xlsxwriter::{DocProperties, ExcelDateTime, Format, Workbook, XlsxError};
use zip::ZipArchive;

use super::blanks::MOST_COLUMNS;
use super::grid::{Grid, LARGEST_TABLE, LONGEST_FIELD, MOST_CELLS, MOST_ROWS, has_hash_labels, is_hash_label};
use super::problem::{Field, FilePosition, Problems};
use super::shown::{Around, hidden};
use super::xlsx::{MOST_UNPACKED, Sheet};
use crate::hull::TableForm;
use crate::units::{Notation, counted};

/// Sum of the sizes that the directory of the archive states.
fn unpacked(bytes: &[u8]) -> u64 {
    let mut sum = 0u64;
    let mut at = 0;
    while let Some(found) = bytes[at..].windows(4).position(|w| w == b"PK\x01\x02") {
        at += found;
        if let Some(&[a, b, c, d]) = bytes.get(at + 24..at + 28) {
            sum = sum.saturating_add(u64::from(u32::from_le_bytes([a, b, c, d])));
        }
        at += 4;
    }
    sum
}

/// The most texts that a part of shared texts says it has: memory is set aside for so many before any is read.
fn claimed_texts(bytes: &[u8]) -> u64 {
    const CLAIM: &[u8] = b"uniqueCount";
    let Ok(mut archive) = ZipArchive::new(Cursor::new(bytes)) else { return 0 };
    let mut most = 0;
    for k in 0..archive.len() {
        let Ok(part) = archive.by_index(k) else { continue };
        if !part.name().is_ok_and(|name| name.to_lowercase().ends_with("sharedstrings.xml")) {
            continue;
        }
        let mut text = Vec::new();
        // What cannot be unpacked is told by the reader of the workbook.
        let _ = part.take(MOST_UNPACKED).read_to_end(&mut text);
        let places = text.windows(CLAIM.len()).enumerate().filter(|(_, window)| *window == CLAIM).map(|(at, _)| at);
        for at in places {
            let digits = text[at + CLAIM.len()..].iter().copied().skip_while(|c| b" \t\r\n=\"'".contains(c));
            let number = digits.take_while(u8::is_ascii_digit);
            most = number.fold(0_u64, |n, c| n.saturating_mul(10).saturating_add(u64::from(c - b'0'))).max(most);
        }
    }
    most
}

/// Whether a workbook is small enough; a problem otherwise.
fn is_small(bytes: &[u8], problems: &mut Problems) -> bool {
    let stated = unpacked(bytes);
    if bytes.len() > LARGEST_TABLE || stated > MOST_UNPACKED {
        let message = format!(
            "{} bytes, unpacked {stated}; a workbook has at most {LARGEST_TABLE}, unpacked {MOST_UNPACKED}",
            bytes.len()
        );
        problems.error("E312", FilePosition::FILE, message, "");
        return false;
    }
    let claimed = claimed_texts(bytes);
    if claimed > MOST_CELLS as u64 {
        let message =
            format!("the workbook says that it has {claimed} shared texts; a table has at most {MOST_CELLS} cells");
        problems.error("E312", FilePosition::FILE, message, "");
        return false;
    }
    true
}

/// The sheets of a workbook that have cells, each with what is wrong with them.
pub(super) fn sheets(bytes: &[u8], problems: &mut Problems) -> Option<Vec<Sheet>> {
    if !is_small(bytes, problems) {
        return None;
    }
    let failed = |error: String| format!("not a workbook that can be read: {error}");
    let mut book = match Xlsx::new(Cursor::new(bytes)) {
        Ok(book) => book,
        Err(error) => {
            problems.error("E300", FilePosition::FILE, failed(error.to_string()), "Give the table as XLSX or CSV");
            return None;
        }
    };
    let mut sheets = Vec::new();
    let mut cells = 0;
    let hidden = hidden(bytes);
    for metadata in book.sheets_metadata().to_vec() {
        let merged = book.merge_cells_by_sheet_name(&metadata.name).unwrap_or_default();
        let around = around(&mut book, &metadata.name);
        let hidden = hidden.get(&metadata.name).cloned().unwrap_or_default();
        let mut left = [BTreeSet::new(), BTreeSet::new()];
        // A sheet of a chart has no cells.
        let Ok(mut reader) = book.worksheet_cells_reader(&metadata.name) else { continue };
        let mut sheet = Sheet {
            hidden: metadata.visible != SheetVisible::Visible,
            name: metadata.name,
            grid: Grid { separator: ',', ..Grid::default() },
            problems: problems.alike(),
        };
        let mut dates = Vec::new();
        loop {
            let cell = match reader.next_cell_with_formula() {
                Ok(Some(cell)) => cell,
                Ok(None) => break,
                Err(error) => {
                    problems.error("E300", FilePosition::FILE, failed(error.to_string()), "");
                    return None;
                }
            };
            let (row, column) = (cell.pos.0 as usize, cell.pos.1 as usize);
            let mut field = Field { text: String::new(), row: row + 1, column: column + 1 };
            let hides = hidden.hides(row + 1, column + 1);
            if hides.contains(&true) {
                // As those of hidden sheets, cells that nobody sees do not count.
                left[0].extend(hides[0].then_some(row + 1));
                left[1].extend(hides[1].then_some(column + 1));
                continue;
            }
            match text(&cell.value, cell.formula.is_some(), &field, &mut sheet.problems) {
                Some(text) => field.text = shown(&cell.value, around.get(&cell.pos)).unwrap_or(text),
                None => continue,
            }
            if is_date(&cell.value) {
                dates.push((row, column));
            }
            cells += 1;
            if row >= MOST_ROWS || column >= MOST_COLUMNS || cells > MOST_CELLS || field.text.len() > LONGEST_FIELD {
                let message = format!(
                    "a table has at most {MOST_ROWS} rows, {MOST_COLUMNS} columns, {MOST_CELLS} cells and {LONGEST_FIELD} \
                     bytes in a cell"
                );
                problems.error("E312", &field, message, "");
                return None;
            }
            place(&mut sheet.grid, field, &mut cells, problems)?;
        }
        left_out(&left, &mut sheet.problems);
        refuse_dates(&dates, &mut sheet);
        for range in merged {
            fill(&mut sheet.grid, range, &mut cells, problems)?;
        }
        hidden.take_out(&mut sheet.grid);
        let is_filled = sheet.grid.rows.iter().flatten().any(|field| !field.is_blank());
        if is_filled || sheet.problems.any_errors() {
            comments(&mut sheet.grid);
            points(&mut sheet.grid, &mut sheet.problems);
            even(&mut sheet.grid);
            sheets.push(sheet);
        }
    }
    if sheets.is_empty() {
        problems.error("E300", FilePosition::FILE, "no sheet of the workbook has cells".to_owned(), "");
        return None;
    }
    Some(sheets)
}

/// What the number formats of the cells of a sheet show around their numbers, where they do.
fn around(book: &mut Xlsx<Cursor<&[u8]>>, sheet: &str) -> BTreeMap<(u32, u32), Around> {
    let Ok(mut reader) = book.worksheet_cells_reader(sheet) else { return BTreeMap::new() };
    let of_style = |style: &Style| Around::of(&style.number_format.as_ref()?.format_code);
    let styles: Vec<Option<Around>> = reader.styles().iter().map(of_style).collect();
    let mut found = BTreeMap::new();
    if styles.iter().all(Option::is_none) {
        return found;
    }
    // What cannot be read is told by the reader of the values.
    while let Ok(Some((row, column, style))) = reader.next_style_id() {
        found.extend(styles.get(style).cloned().flatten().map(|around| ((row, column), around)));
        if found.len() > MOST_CELLS {
            break;
        }
    }
    found
}

/// A number with what its format shows around it.
fn shown(value: &DataRef<'_>, around: Option<&Around>) -> Option<String> {
    match value {
        DataRef::Int(n) => Some(around?.text(*n as f64)),
        DataRef::Float(n) => Some(around?.text(*n)),
        _ => None,
    }
}

/// Says which rows and columns with cells are left out because the sheet hides them.
fn left_out([rows, columns]: &[BTreeSet<usize>; 2], problems: &mut Problems) {
    let list = |numbers: &BTreeSet<usize>| numbers.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ");
    for (noun, numbers) in [("row", rows), ("column", columns)] {
        if !numbers.is_empty() {
            let message = format!(
                "left out: {} that the sheet hides, {}",
                counted(numbers.len(), &format!("{noun} with cells")),
                list(numbers)
            );
            problems.warning("W332", FilePosition::FILE, message, "Show them in the workbook if they count");
        }
    }
}

/// Whether a text is a number, perhaps with the unit that its format shows.
fn is_number(text: &str) -> bool {
    let (number, unit) = text.trim().split_once(' ').unwrap_or((text.trim(), ""));
    number.parse::<f64>().is_ok() && (unit.is_empty() || Notation::from_word(unit).is_some())
}

/// The text of a cell; none for an empty one, and for one that holds no text or number.
fn text(value: &DataRef<'_>, formula: bool, field: &Field, problems: &mut Problems) -> Option<String> {
    match value {
        DataRef::Int(n) => Some(n.to_string()),
        DataRef::Float(n) if n.is_finite() => Some(n.to_string()),
        DataRef::String(text) if formula && text.is_empty() => unstored(field, problems),
        DataRef::String(text) => Some(text.clone()),
        DataRef::SharedString(text) => Some((*text).to_owned()),
        DataRef::Bool(truth) => Some(truth.to_string()),
        DataRef::Float(_) | DataRef::Empty if formula => unstored(field, problems),
        DataRef::Float(_) | DataRef::Empty => None,
        DataRef::DateTime(date) => {
            let (year, month, day, ..) = date.to_ymd_hms_milli();
            Some(format!("{year}-{month:02}-{day:02}"))
        }
        DataRef::DateTimeIso(date) | DataRef::DurationIso(date) => Some(date.clone()),
        DataRef::Error(error) => {
            problems.error("E301", field, format!("the cell holds the error {error}"), "");
            None
        }
    }
}

fn unstored(field: &Field, problems: &mut Problems) -> Option<String> {
    let message = "the cell has a formula without a stored value".to_owned();
    let remedy = "Open the workbook in a spreadsheet and save it, or give values";
    problems.error("E317", field, message, remedy);
    None
}

fn is_date(value: &DataRef<'_>) -> bool {
    matches!(value, DataRef::DateTime(_) | DataRef::DateTimeIso(_) | DataRef::DurationIso(_))
}

/// Refuses dates among numbers, or below each other: they are no title.
fn refuse_dates(dates: &[(usize, usize)], sheet: &mut Sheet) {
    for &(row, column) in dates {
        let numbers = sheet.grid.rows[row].iter().filter(|field| is_number(&field.text)).count();
        let others = dates.iter().filter(|(r, c)| *r == row || *c == column).count();
        if numbers > 0 || others > 2 {
            let field = sheet.grid.rows[row][column].clone();
            refuse_date(&field, &mut sheet.problems);
        }
    }
}

/// What `2005-03-04` may have been: 3-4-5, or 4-3-5 where days come first.
fn refuse_date(field: &Field, problems: &mut Problems) {
    let date = field.text.as_str();
    let parts: Vec<u32> = date.split(['-', 'T', ' ']).take(3).filter_map(|part| part.parse().ok()).collect();
    let typed = match parts[..] {
        [year, month, day] if month == day => format!(": {date} may be {month}-{day}-{}", year % 100),
        [year, month, day] => {
            let eighths = year % 100;
            format!(": {date} may be {month}-{day}-{eighths} or {day}-{month}-{eighths}")
        }
        _ => String::new(),
    };
    let message = format!("the cell is a date; spreadsheets make dates of feet-inches-eighths{typed}");
    // The date stands in the message.
    let place = Field { text: String::new(), ..field.clone() };
    problems.error("E317", &place, message, "Format the cells as text before typing 3-4-5");
}

/// Numbers in merged cells stand in each of them; titles stand in the first.
fn fill(grid: &mut Grid, range: Dimensions, cells: &mut usize, problems: &mut Problems) -> Option<()> {
    let [(top, left), (bottom, right)] = [range.start, range.end].map(|(row, column)| (row as usize, column as usize));
    let text = grid.rows.get(top).and_then(|row| row.get(left)).map(|field| field.text.clone()).unwrap_or_default();
    // A number beside a name, above the table, is no offset.
    let numbers = grid.rows.get(top).map_or(0, |row| row.iter().filter(|field| is_number(&field.text)).count());
    let is_offset = is_number(&text) && (bottom > top || numbers > 1);
    if !is_offset || bottom >= MOST_ROWS || right >= MOST_COLUMNS {
        return Some(());
    }
    for row in top..=bottom {
        for column in left..=right {
            place(grid, Field { text: text.clone(), row: row + 1, column: column + 1 }, cells, problems)?;
        }
    }
    Some(())
}

/// A text that is a number with a decimal comma, with a point.
fn pointed(text: &str) -> Option<String> {
    let (whole, part) = text.trim().strip_prefix('-').unwrap_or(text.trim()).split_once(',')?;
    let digits = |part: &str| !part.is_empty() && part.bytes().all(|b| b.is_ascii_digit());
    (digits(whole) && digits(part)).then(|| text.trim().replace(',', "."))
}

/// Texts with decimal commas become numbers, where no text has a decimal point.
fn points(grid: &mut Grid, problems: &mut Problems) {
    let found: Vec<String> = grid.rows.iter().flatten().filter_map(|field| pointed(&field.text)).collect();
    if found.is_empty() {
        return;
    }
    let three =
        |text: &String| text.split_once('.').is_some_and(|(whole, part)| part.len() == 3 && !whole.ends_with('0'));
    let message = format!("{} with decimal commas in texts are numbers", counted(found.len(), "cell"));
    if found.iter().all(three) {
        let remedy = "Write 1234 for a comma between thousands";
        problems.warning(
            "W320",
            FilePosition::FILE,
            format!("{message}: none has its comma between thousands"),
            remedy,
        );
    } else {
        problems.note(message);
    }
    for field in grid.rows.iter_mut().flatten() {
        if let Some(text) = pointed(&field.text) {
            field.text = text;
        }
    }
}

/// Takes the rows that begin with `#` out, as comments.
fn comments(grid: &mut Grid) {
    let lines: Vec<String> =
        grid.rows.iter().map(|row| row.iter().map(|f| f.text.as_str()).collect::<Vec<_>>().join(";")).collect();
    let labels = has_hash_labels(lines.iter().map(String::as_str));
    for (row, line) in grid.rows.iter_mut().zip(&lines) {
        if labels && is_hash_label(line) {
            continue;
        }
        if let Some(comment) = row.first().and_then(|field| field.text.trim_start().strip_prefix('#')) {
            grid.comments.push((row[0].row, comment.trim().to_owned()));
            row.clear();
        }
    }
}

/// The text of a table, as `write_table` makes it for `form`, as a workbook with one sheet.
///
/// # Errors
/// What the text or the name of the sheet has that a workbook cannot hold, in words.
pub fn workbook(text: &str, form: &TableForm) -> Result<Vec<u8>, String> {
    let mut problems = Problems::new("");
    let Some(grid) = super::grid::split(text, Some(form.separator), &mut problems) else {
        return Err("the table is larger than a sheet".to_owned());
    };
    let failed = |error: XlsxError| error.to_string();
    let mut book = Workbook::new();
    // The same table, the same bytes.
    let made = ExcelDateTime::from_ymd(2000, 1, 1).map_err(failed)?;
    book.set_properties(&DocProperties::new().set_creation_datetime(&made));
    let sheet = book.add_worksheet();
    sheet.set_name(form.sheet.as_deref().unwrap_or("offsets")).map_err(failed)?;
    let place = |field: &Field| -> Result<(u32, u16), String> {
        let column = u16::try_from(field.column - 1).map_err(|_| "more columns than a sheet has".to_owned())?;
        Ok((u32::try_from(field.row - 1).map_err(|_| "more rows than a sheet has".to_owned())?, column))
    };
    for (line, comment) in &grid.comments {
        let row = u32::try_from(line - 1).map_err(|_| "more rows than a sheet has".to_owned())?;
        sheet.write_string(row, 0, format!("# {comment}")).map_err(failed)?;
    }
    for field in grid.rows.iter().flatten().filter(|field| !field.text.is_empty()) {
        let (row, column) = place(field)?;
        match number(&field.text, form.decimal_comma) {
            Some((value, digits)) => {
                let shown = if digits == 0 { "0".to_owned() } else { format!("0.{}", "0".repeat(digits)) };
                sheet.write_number_with_format(row, column, value, &Format::new().set_num_format(shown))
            }
            None => sheet.write_string(row, column, &field.text),
        }
        .map_err(failed)?;
    }
    book.save_to_buffer().map_err(failed)
}

/// The value and the digits after the decimal sign of a plain decimal number.
fn number(text: &str, decimal_comma: bool) -> Option<(f64, usize)> {
    let text = if decimal_comma { text.replace(',', ".") } else { text.to_owned() };
    let digits = text.strip_prefix('-').unwrap_or(&text);
    let (whole, part) = digits.split_once('.').unwrap_or((digits, ""));
    let plain = |part: &str| part.bytes().all(|b| b.is_ascii_digit());
    // A leading zero, as of a frame 007, belongs to a name.
    let named = whole.len() > 1 && whole.starts_with('0');
    if whole.is_empty() || named || !plain(whole) || !plain(part) || digits.len() > 15 {
        return None;
    }
    text.parse().ok().map(|value| (value, part.len()))
}

/// Puts a field into its row; blank fields fill the row before it, and count as cells.
fn place(grid: &mut Grid, field: Field, cells: &mut usize, problems: &mut Problems) -> Option<()> {
    while grid.rows.len() < field.row {
        grid.rows.push(Vec::new());
    }
    let row = &mut grid.rows[field.row - 1];
    while row.len() < field.column - 1 {
        row.push(Field { text: String::new(), row: field.row, column: row.len() + 1 });
        *cells += 1;
        if *cells > MOST_CELLS {
            problems.error("E312", &field, format!("more than {MOST_CELLS} cells"), "");
            return None;
        }
    }
    if row.len() >= field.column {
        let at = field.column - 1;
        row[at] = field;
    } else {
        row.push(field);
    }
    Some(())
}

/// Sheets leave out empty cells at the ends of rows: the rows of each block become equally long, as far as its header
/// goes.
fn even(grid: &mut Grid) {
    for row in &mut grid.rows {
        if row.iter().all(Field::is_blank) {
            row.clear();
        }
    }
    let mut width = 0;
    for row in &mut grid.rows {
        if row.is_empty() {
            width = 0;
            continue;
        }
        width = width.max(row.len());
        while row.len() < width {
            row.push(Field { text: String::new(), row: row[0].row, column: row.len() + 1 });
        }
    }
}
