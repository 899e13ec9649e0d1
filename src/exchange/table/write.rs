//! Writing tables of offsets back: in their own notation, layout, order and headers, or in others.
//!
//! A text of the file is written again wherever it still says what the table holds; only changed cells are written anew.
//! Rounding to the quantum of the notation is the last step, and what it does is returned. A table in pairs
//! becomes a matrix; sections of points keep the format of their program, or become a tidy table.

use super::around::says_full;
use super::boat_rows;
use super::header::{side_name, unit_of};
use super::numbering::OVERHANG;
use super::tidy;
use crate::hull::{
    Cell, Entry, Kept, Marks, OffsetTable, Order, Rows, SideKind, SideLine, StationDatum, StationOffsets, TableForm,
    TableLayout, Written,
};
use crate::units::{CellEntry, CellReading, CellRules, CellWriting, Notation, guarded, parse_cell};
use std::borrow::Cow;

/// In which notation and layout a table is to be written; its own by default.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct TableWriting {
    /// Unit of all lengths.
    pub notation: Option<Notation>,
    /// Shape of the file.
    pub layout: Option<TableLayout>,
}

/// What writing with limited digits did to the offsets.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Rounding {
    /// Offsets that were written.
    pub cells: usize,
    /// Those whose text was taken over from the file.
    pub kept: usize,
    /// Largest change \[m\].
    pub largest: f64,
    /// Root of the mean square of all changes \[m\].
    pub root_mean_square: f64,
    /// Largest change of the position of a station, waterline or buttock \[m\].
    pub largest_of_positions: f64,
}

/// A table as text.
#[derive(Debug, Clone, PartialEq)]
pub struct WrittenTable {
    /// The file.
    pub text: String,
    /// What rounding did.
    pub rounding: Rounding,
    /// Whether units, layout and positions are those of the file that was read, so that its conventions hold.
    pub is_alike: bool,
}

/// Digits that a notation is given when a table is turned into it: a tenth of a millimetre, or whole millimetres.
fn usual_decimals(notation: Notation) -> Option<usize> {
    match notation {
        Notation::Metres | Notation::Feet => Some(4),
        Notation::Millimetres => Some(0),
        Notation::Centimetres => Some(2),
        Notation::Inches => Some(3),
        Notation::FeetInchesEighths => None,
    }
}

/// Whether a line above a table still holds in another notation: prose, a title, and conventions that say nothing of
/// units, positions and layout.
fn stays(line: &str, separator: char) -> bool {
    match line.strip_prefix('#').map(|comment| comment.split_once('=')) {
        Some(Some((key, _))) => {
            let key = key.trim();
            let known = super::settings::KEYS.iter().any(|k| k.eq_ignore_ascii_case(key));
            !known || ["name", "Lpp", "B", "T", "D"].iter().any(|k| k.eq_ignore_ascii_case(key))
        }
        Some(None) => says_nothing(line),
        None => says_nothing(line) && !line.trim_end_matches(separator).contains(separator) && !says_full(line),
    }
}

/// Whether a sentence says nothing of positions: the new ones are lengths from AP.
fn says_nothing(line: &str) -> bool {
    let mut settings = super::settings::Settings::default();
    settings.prose(line.trim_start_matches('#').trim());
    settings == super::settings::Settings::default()
}

/// Whether a table has sections of points and neither half-breadths at waterlines nor heights at buttocks.
#[must_use]
pub fn only_sections(table: &OffsetTable) -> bool {
    let cells = |s: &StationOffsets| s.half_breadths.iter().chain(&s.heights).any(|cell| cell.value().is_some());
    table.stations.iter().any(|s| !s.outlines.is_empty()) && !table.stations.iter().any(cells)
}

/// The most digits after the decimal sign of the texts of the offsets.
fn digits(table: &OffsetTable) -> usize {
    let cells = table.stations.iter().flat_map(|s| s.half_breadths.iter().chain(&s.heights));
    let digits = cells.filter_map(|cell| {
        let written = cell.written.as_ref()?;
        match parse_cell(&written.text, table.form.cell_rules()).ok()?.writing {
            CellWriting::Plain { decimals } => Some(decimals),
            _ => None,
        }
    });
    digits.max().unwrap_or(0)
}

/// Whether the lines before a table state a key.
fn states(form: &TableForm, key: &str) -> bool {
    form.preamble.iter().any(|line| line.trim_start_matches('#').trim_start().starts_with(key))
}

/// Comment lines with the name and the stated particulars.
fn stated_lines(table: &OffsetTable) -> Vec<String> {
    let name: String = table.name.chars().filter(|c| !c.is_control()).collect();
    let stated = &table.stated;
    let values = [
        ("Lpp", stated.length_between_perpendiculars),
        ("B", stated.breadth),
        ("T", stated.draught),
        ("D", stated.depth),
    ];
    let name = Some(name.trim()).filter(|name| !name.is_empty()).map(|name| format!("# name = {name}"));
    let usable = |value: &f64| *value > 0.0 && *value < 1e5;
    let values = values.into_iter().filter_map(|(key, value)| Some(format!("# {key} = {} m", value.filter(usable)?)));
    name.into_iter().chain(values).collect()
}

/// Writes a table. Sections of points in another program's format are written in that format where it can be, and as a
/// tidy table otherwise; a matrix, when it is asked for, does not hold them.
#[must_use]
pub fn write_table(table: &OffsetTable, writing: TableWriting) -> WrittenTable {
    let mut form = table.form.clone();
    let notation = writing.notation.unwrap_or(form.notation);
    let sections = only_sections(table);
    if let (None, None, TableLayout::Other, Some(program)) =
        (writing.layout, writing.notation, form.layout, form.program)
        && let Some(written) = super::formats::write(table, program)
    {
        return WrittenTable { is_alike: false, ..written };
    }
    if let (None, None, false) = (writing.layout, writing.notation, form.boat_lines.is_empty())
        && let Some(written) = boat_table(table)
    {
        return WrittenTable { is_alike: false, ..written };
    }
    let layout = match writing.layout.unwrap_or(form.layout) {
        TableLayout::Tidy => TableLayout::Tidy,
        // A matrix has no place for points.
        TableLayout::Pairs | TableLayout::Other if sections => TableLayout::Tidy,
        TableLayout::Matrix | TableLayout::Pairs | TableLayout::Other => TableLayout::Matrix,
    };
    let renotated = notation != form.notation;
    // A unit in the corner is that of the positions; that of the offsets was said elsewhere, and is said here.
    let apart = |unit: Notation| (unit.metres(1.0) - notation.metres(1.0)).abs() > 0.0;
    if !renotated
        && notation != Notation::FeetInchesEighths
        && form.corner.as_deref().and_then(unit_of).is_some_and(apart)
        && !states(&form, "units")
    {
        form.preamble.push(format!("# units = {}", notation.as_str()));
    }
    if renotated {
        (form.notation, form.x_notation, form.z_notation) = (notation, notation, notation);
        form.decimals = usual_decimals(notation);
    }
    let is_alike = !renotated && layout == form.layout;
    if !is_alike {
        // The headers of the file speak of other units or of another layout, and its conventions may not go with the new
        // file: positions become lengths from AP. Station numbers become names.
        let named = |columns: &[SideLine]| columns.iter().any(|side| side.kind == SideKind::Name);
        if matches!(form.origin, StationDatum::Numbers { .. }) {
            let columns = if table.waterlines.is_empty() { &mut form.buttock_columns } else { &mut form.side_columns };
            if !named(columns) {
                let head = "station".to_owned();
                columns.insert(0, SideLine { kind: SideKind::Name, head, before: true, texts: Vec::new() });
            }
        }
        form.origin = StationDatum::Lengths;
        // One unit for all, as the new header says.
        (form.x_notation, form.z_notation) = (notation, notation);
        form.station_heads.clear();
        form.preamble.retain(|line| stays(line, form.separator));
        (form.corner, form.buttock_corner) = (None, None);
        if !renotated {
            // Texts are written anew; none loses a digit.
            let most = digits(table);
            form.decimals = form.decimals.map(|digits| digits.max(most));
        }
        if form.full_breadths && !renotated {
            // Half of the last digit is a digit more.
            form.decimals = form.decimals.map(|digits| digits + 1);
        }
        (form.full_breadths, form.negative) = (false, false);
        form.waterline_heads.clear();
        form.buttock_heads.clear();
        if layout != form.layout {
            (form.rows, form.station_order, form.waterline_order) = (Rows::Stations, Order::Rising, Order::Rising);
            form.preamble.clear();
        }
        if layout == TableLayout::Tidy && form.layout == TableLayout::Other {
            form.preamble = stated_lines(table);
        }
        if is_far_aft(table) {
            form.preamble.push("# stations = from AP".to_owned());
        }
        for side in form.side_columns.iter_mut().chain(&mut form.side_rows).chain(&mut form.buttock_columns) {
            if side.kind != SideKind::Name {
                side.texts.clear();
            }
        }
    }
    if layout == TableLayout::Tidy && form.full_breadths && !states(&form, "breadths") {
        // The column y has no other word for it.
        form.preamble.push("# breadths = full".to_owned());
    }
    let table = &with_holes(table);
    // The texts of the cells hold where unit, factor and sign are those of the file.
    let own = !renotated && (form.full_breadths, form.negative) == (table.form.full_breadths, table.form.negative);
    let mut writer = Writer { form, own, rounding: Rounding::default(), squares: 0.0 };
    let records = if layout == TableLayout::Tidy { tidy::records(table, &mut writer) } else { writer.matrix(table) };
    WrittenTable { is_alike, ..writer.table(&records) }
}

/// Whether stations lie so far aft of AP that their distances alone would be taken from another point.
fn is_far_aft(table: &OffsetTable) -> bool {
    let (Some(first), Some(last)) = (table.stations.first(), table.stations.last()) else { return false };
    let [aft, fore] = [first.station.x.min(0.0), last.station.x.max(0.0)];
    -aft > OVERHANG * (fore - aft)
}

/// A table of lines of a boat as it was read; none where its sections have other points than its lines.
fn boat_table(table: &OffsetTable) -> Option<WrittenTable> {
    let mut form = table.form.clone();
    let own = !form.full_breadths && !form.negative;
    (form.full_breadths, form.negative) = (false, false);
    if form.notation != Notation::FeetInchesEighths && !states(&form, "units") {
        form.preamble.push(format!("# units = {}", form.notation.as_str()));
    }
    let stated: Vec<String> = stated_lines(table).into_iter().filter(|line| !form.preamble.contains(line)).collect();
    form.preamble.splice(0..0, stated);
    let mut writer = Writer { form, own, rounding: Rounding::default(), squares: 0.0 };
    let records = boat_rows::records(table, &mut writer)?;
    Some(writer.table(&records))
}

/// What says that there is no hull, where a blank cell would be read as an offset that is missing.
const NO_HULL: &str = "-";

/// The table with cells without hull among half-breadths that say so.
fn with_holes(table: &OffsetTable) -> Cow<'_, OffsetTable> {
    let holes = super::checks::holes(table, |cell| cell.entry == Entry::Absent);
    if holes.is_empty() {
        return Cow::Borrowed(table);
    }
    let mut table = table.clone();
    for (i, j) in holes {
        if let Some(cell) = table.stations[i].half_breadths.get_mut(j) {
            let said = cell.written.take().filter(|written| !written.text.is_empty());
            cell.written = said.or_else(|| Some(Written { text: NO_HULL.to_owned(), row: 0, column: 0 }));
        }
    }
    Cow::Owned(table)
}

/// Writes the parts of a table and keeps account of the rounding.
pub(super) struct Writer {
    pub(super) form: TableForm,
    /// Whether the texts of the cells are in the notation that is written.
    own: bool,
    rounding: Rounding,
    squares: f64,
}

impl Writer {
    fn comma(&self, text: String) -> String {
        if self.form.decimal_comma { text.replace('.', ",") } else { text }
    }

    /// A cell of half-breadths (`half`) or heights.
    pub(super) fn cell(&mut self, cell: &Cell, half: bool) -> String {
        let sign = if half && self.form.negative { -1.0 } else { 1.0 };
        let factor = if half && self.form.full_breadths { 2.0 } else { 1.0 };
        let unit = if half { self.form.notation } else { self.form.z_notation };
        let mut rules = self.form.cell_rules();
        rules.unit = unit;
        let value_in = |text: &str, rules: CellRules| match parse_cell(text, rules) {
            Ok(reading) => match reading.entry {
                CellEntry::Length(value) => Some((Some(sign * value / factor), reading)),
                CellEntry::Absent | CellEntry::Unknown => Some((None, reading)),
            },
            Err(_) => None,
        };
        let value_of = |text: &str| value_in(text, rules);
        let parsed = cell.written.as_ref().filter(|_| self.own).and_then(|written| {
            // Among feet, inches and eighths a plain number has the unit of the headers.
            let plain = CellRules { unit: self.form.z_notation, ..rules };
            let same = |read: &(Option<f64>, CellReading)| match (read.0, cell.entry) {
                (Some(a), Entry::Given(b)) => (a - b).abs() <= 1e-12 * b.abs().max(1.0),
                _ => false,
            };
            let other = || value_in(&written.text, plain).filter(|read| half && same(read));
            Some((written, value_of(&written.text).filter(same).or_else(other).or_else(|| value_of(&written.text))?))
        });
        if let Some((written, (value, reading))) = parsed {
            let marks = Marks {
                doubtful: reading.doubtful,
                locked: reading.locked,
                knuckle: reading.knuckle,
                tangent: reading.tangent,
            };
            let same = match (value, cell.entry) {
                (Some(a), Entry::Given(b)) => (a - b).abs() <= 1e-12 * b.abs().max(1.0),
                (None, Entry::Absent) => reading.entry == CellEntry::Absent,
                // Blank among half-breadths is read as unknown.
                (None, Entry::Unknown) => reading.entry == CellEntry::Unknown || written.text.is_empty(),
                _ => false,
            };
            if same && marks == cell.marks {
                self.rounding.cells += usize::from(value.is_some());
                self.rounding.kept += usize::from(value.is_some());
                return written.text.clone();
            }
        }
        let text = match cell.entry {
            Entry::Absent => {
                let said = cell.written.as_ref().is_some_and(|written| !written.text.is_empty());
                return if said { NO_HULL.to_owned() } else { String::new() };
            }
            Entry::Unknown => "?".to_owned(),
            Entry::Given(value) if !value.is_finite() => return String::new(),
            Entry::Given(value) => {
                let text = self.comma(unit.write_to(sign * factor * value, self.form.decimals));
                if let Some((Some(back), _)) = value_of(&text) {
                    self.rounding.cells += 1;
                    self.rounding.largest = self.rounding.largest.max((back - value).abs());
                    self.squares += (back - value) * (back - value);
                }
                text
            }
        };
        marked(text, cell.marks)
    }

    /// A length beside the offsets, in full digits.
    pub(super) fn length(&mut self, value: f64, unit: Notation) -> String {
        let digits = if unit == Notation::Millimetres { Some(0) } else { None };
        // Whole millimetres where that is exact, all digits where it is not.
        let short = unit.write_to(value, digits);
        let exact = |text: &str| text.parse().is_ok_and(|n: f64| (unit.metres(n) - value).abs() <= 1e-12 * value.abs());
        let text =
            if unit == Notation::FeetInchesEighths || exact(&short) { short } else { unit.write_to(value, None) };
        self.comma(text)
    }

    fn position(&mut self, heads: &[Kept], value: f64, unit: Notation) -> String {
        if let Some(text) = heads.iter().find_map(|head| head.text_of(value)) {
            return text.to_owned();
        }
        let text = self.length(value, unit);
        let rules = CellRules { unit, decimal_comma: self.form.decimal_comma };
        if let Ok(reading) = parse_cell(&text, rules)
            && let CellEntry::Length(back) = reading.entry
        {
            let largest = &mut self.rounding.largest_of_positions;
            *largest = largest.max((back - value).abs());
        }
        text
    }

    /// The position of a station as it is written.
    pub(super) fn station(&mut self, x: f64) -> String {
        let heads = std::mem::take(&mut self.form.station_heads);
        let (value, unit) = match self.form.origin {
            StationDatum::Lengths => (x, self.form.x_notation),
            StationDatum::Shifted { offset, sign } => (sign * (x - offset), self.form.x_notation),
            StationDatum::Numbers { offset, spacing } => ((x - offset) / spacing, Notation::Metres),
        };
        let text = match heads.iter().find_map(|head| head.text_of(x)) {
            Some(text) => text.to_owned(),
            None => self.position(&[], value, unit),
        };
        self.form.station_heads = heads;
        text
    }

    pub(super) fn height(&mut self, z: f64) -> String {
        let heads = std::mem::take(&mut self.form.waterline_heads);
        let text = self.position(&heads, z, self.form.z_notation);
        self.form.waterline_heads = heads;
        text
    }

    fn side(&mut self, side: &SideLine, at: usize, value: Option<f64>) -> String {
        let Some(value) = value.filter(|v| v.is_finite()) else { return String::new() };
        if let Some(text) = side.texts.get(at).and_then(Option::as_ref).and_then(|kept| kept.text_of(value)) {
            return text.to_owned();
        }
        let full = if self.form.full_breadths && is_breadth(side.kind) { 2.0 } else { 1.0 };
        let (value, unit) = match (side.kind, self.form.origin) {
            (SideKind::Stern | SideKind::Stem, StationDatum::Shifted { offset, sign }) => {
                (sign * (value - offset), self.form.x_notation)
            }
            (SideKind::Stern | SideKind::Stem, _) => (value, self.form.x_notation),
            (SideKind::FlatOfBottom | SideKind::DeckHalfBreadth, _) => (full * value, self.form.notation),
            _ => (value, self.form.z_notation),
        };
        self.length(value, unit_of(&side.head).unwrap_or(unit))
    }

    fn matrix(&mut self, table: &OffsetTable) -> Vec<Vec<String>> {
        let mut records = Vec::new();
        let computed = self.form.corner.is_none() && self.form.buttock_corner.is_none();
        // Sides that the file did not have, or a computed table has, stand behind the offsets of the first block.
        let stands = |kind: SideKind| {
            self.form.side_columns.iter().chain(&self.form.buttock_columns).any(|side| side.kind == kind)
        };
        let more: Vec<SideLine> = ALONG
            .into_iter()
            .filter(|&kind| !stands(kind) && table.stations.iter().any(|s| side_value(s, kind).is_some()))
            .map(|kind| SideLine { kind, head: side_name(kind).to_owned(), before: false, texts: Vec::new() })
            .collect();
        let halves = !table.waterlines.is_empty() || table.buttocks.is_empty();
        if halves {
            self.form.side_columns.extend(more);
            let columns = self.form.side_columns.clone();
            let mut rows = self.form.side_rows.clone();
            if computed && rows.is_empty() {
                for (end, kind) in [SideKind::Stern, SideKind::Stem].into_iter().enumerate() {
                    if table.endings.iter().any(|ends| ends[end].is_some()) {
                        rows.push(SideLine {
                            kind,
                            head: side_name(kind).to_owned(),
                            before: false,
                            texts: Vec::new(),
                        });
                    }
                }
            }
            records.extend(self.block(table, &columns, &rows, true));
        } else {
            self.form.buttock_columns.extend(more);
        }
        if !table.buttocks.is_empty() {
            if halves {
                records.push(Vec::new());
            }
            let columns = self.form.buttock_columns.clone();
            records.extend(self.block(table, &columns, &[], false));
        }
        records
    }

    /// One block: half-breadths, or heights.
    fn block(&mut self, table: &OffsetTable, sides: &[SideLine], rows: &[SideLine], half: bool) -> Vec<Vec<String>> {
        let numbered = matches!(self.form.origin, StationDatum::Numbers { .. });
        let (first, across) = (if numbered { "station" } else { "x" }, if half { "z" } else { "y" });
        let own = if self.form.rows == Rows::Waterlines {
            format!("{across}\\{first} [{}]", self.form.notation.as_str())
        } else {
            format!("{first}\\{across} [{}]", self.form.notation.as_str())
        };
        let corner = if half { &self.form.corner } else { &self.form.buttock_corner };
        let corner = corner.clone().unwrap_or(own);
        let mut order: Vec<usize> = (0..if half { table.waterlines.len() } else { table.buttocks.len() }).collect();
        if self.form.waterline_order == Order::Falling && half {
            order.reverse();
        }
        let names: Vec<&SideLine> = sides.iter().filter(|s| s.kind == SideKind::Name).collect();
        let (before, after): (Vec<&SideLine>, Vec<&SideLine>) =
            sides.iter().filter(|s| s.kind != SideKind::Name).partition(|s| s.before);
        let mut head: Vec<String> = names.iter().map(|s| s.head.clone()).collect();
        head.push(corner);
        head.extend(before.iter().map(|s| s.head.clone()));
        for &j in &order {
            let text = if half {
                self.height(table.waterlines[j])
            } else {
                let heads = std::mem::take(&mut self.form.buttock_heads);
                let text = self.position(&heads, table.buttocks[j], self.form.z_notation);
                self.form.buttock_heads = heads;
                text
            };
            head.push(text);
        }
        head.extend(after.iter().map(|s| s.head.clone()));
        let mut records = vec![head];
        let mut stations: Vec<usize> = (0..table.stations.len()).collect();
        if self.form.station_order == Order::Falling {
            stations.reverse();
        }
        for i in stations {
            let station = &table.stations[i];
            let mut row: Vec<String> = names.iter().map(|_| station.station.name.clone()).collect();
            row.push(self.station(station.station.x));
            row.extend(before.iter().map(|side| self.side(side, i, side_value(station, side.kind))));
            let cells = if half { &station.half_breadths } else { &station.heights };
            let absent = Cell::default();
            row.extend(order.iter().map(|&j| self.cell(cells.get(j).unwrap_or(&absent), half)));
            row.extend(after.iter().map(|side| self.side(side, i, side_value(station, side.kind))));
            records.push(row);
        }
        for side in rows {
            let end = usize::from(side.kind == SideKind::Stem);
            let mut row: Vec<String> = names.iter().map(|_| String::new()).collect();
            row.push(side.head.clone());
            row.extend(before.iter().map(|_| String::new()));
            row.extend(order.iter().map(|&j| self.side(side, j, table.endings.get(j).and_then(|ends| ends[end]))));
            row.extend(after.iter().map(|_| String::new()));
            records.push(row);
        }
        if self.form.rows == Rows::Waterlines { transposed(&records) } else { records }
    }

    /// The file of the records, with what rounding did.
    fn table(&self, records: &[Vec<String>]) -> WrittenTable {
        let mut rounding = self.rounding;
        rounding.root_mean_square = (self.squares / (rounding.cells.max(1)) as f64).sqrt();
        WrittenTable { text: self.text(records), rounding, is_alike: true }
    }

    /// The file of the records.
    fn text(&self, records: &[Vec<String>]) -> String {
        let end = if self.form.carriage_returns { "\r\n" } else { "\n" };
        let separator = self.form.separator;
        let mut text = String::new();
        for line in &self.form.preamble {
            text.push_str(&guarded(line));
            text.push_str(end);
        }
        for record in records {
            for (index, field) in record.iter().enumerate() {
                if index > 0 {
                    text.push(separator);
                }
                let field = guarded(field);
                let quoted = field.contains([separator, '\n', '\r'])
                    || field.starts_with('"')
                    || index == 0 && field.starts_with('#');
                if quoted {
                    text.push('"');
                    text.push_str(&field.replace('"', "\"\""));
                    text.push('"');
                } else {
                    text.push_str(&field);
                }
            }
            if self.form.trailing_separator && !record.is_empty() {
                text.push(separator);
            }
            text.push_str(end);
        }
        if self.form.open_end {
            text.truncate(text.trim_end_matches(['\n', '\r']).len());
        }
        text
    }
}

/// `text` with its marks.
fn marked(text: String, marks: Marks) -> String {
    let mut text = if marks.doubtful { format!("({text})") } else { text };
    for (mark, letter) in [(marks.knuckle, 'K'), (marks.tangent, 'T'), (marks.locked, '!')] {
        if mark {
            text.push(letter);
        }
    }
    text
}

fn is_breadth(kind: SideKind) -> bool {
    matches!(kind, SideKind::FlatOfBottom | SideKind::DeckHalfBreadth)
}

/// What stands along the stations.
pub(super) const ALONG: [SideKind; 6] = [
    SideKind::Keel,
    SideKind::FlatOfBottom,
    SideKind::FlatOfSide,
    SideKind::DeckHeight,
    SideKind::DeckHalfBreadth,
    SideKind::DeckCentreHeight,
];

/// A value beside the offsets of a station.
pub(super) fn side_value(station: &StationOffsets, kind: SideKind) -> Option<f64> {
    match kind {
        SideKind::Keel => station.keel_height,
        SideKind::FlatOfBottom => station.flat_of_bottom,
        SideKind::FlatOfSide => station.flat_of_side,
        SideKind::DeckHeight => station.deck_height,
        SideKind::DeckHalfBreadth => station.deck_half_breadth,
        SideKind::DeckCentreHeight => station.deck_centre_height,
        SideKind::Name | SideKind::Stern | SideKind::Stem => None,
    }
}

fn transposed(records: &[Vec<String>]) -> Vec<Vec<String>> {
    let width = records.first().map_or(0, Vec::len);
    (0..width).map(|j| records.iter().map(|row| row.get(j).cloned().unwrap_or_default()).collect()).collect()
}
