//! From blocks of fields to a table of offsets: positions, units, cells, side lines, and the order of lines.

use super::checks;
use super::grid::MOST_LINES;
use super::header::{Axis, Coordinate, Corner, From, Position, is_level, position, positions, unit_of};
use super::heights;
use super::matrix::{Block, MatrixRow};
use super::numbering::{Breadths, origin};
use super::problem::{Field, Problems};
use super::scale::{Size, Units, ends_from_midship, units};
use super::settings::{Settings, metres};
use crate::hull::{
    Cell, Entry, Kept, Marks, OffsetTable, Order, SideKind, SideLine, StationDatum, StationOffsets, TableForm, Written,
};
use crate::units::{CellEntry, CellReading, CellRules, CellWriting, Notation, UnitError, counted, parse_cell};

/// Two positions nearer than this are one \[m\].
pub(super) const SAME: f64 = 1e-6;
/// No length of a ship is larger \[m\].
pub(super) const LARGEST: f64 = 1e5;

/// Reads the fields of one table.
pub(super) struct TableReader<'a> {
    pub(super) settings: &'a Settings,
    pub(super) form: TableForm,
    pub(super) units: Units,
    pub(super) problems: &'a mut Problems,
    /// Length between perpendiculars, where it is known \[m\].
    pub(super) length: Option<f64>,
    /// How often offsets have so many digits after the decimal sign; more than the last count as the last.
    digits: [usize; 18],
    /// Offsets as plain numbers, and in feet, inches and eighths.
    writings: [usize; 2],
}

impl<'a> TableReader<'a> {
    pub(super) fn new(settings: &'a Settings, mut form: TableForm, units: Units, problems: &'a mut Problems) -> Self {
        (form.notation, form.x_notation, form.z_notation) = (units.y, units.x, units.z);
        form.full_breadths = settings.full.unwrap_or(false);
        let length = settings.stated.length_between_perpendiculars;
        Self { settings, form, units, problems, length, digits: [0; 18], writings: [0; 2] }
    }

    fn reading(&mut self, field: &Field, unit: Notation) -> Option<CellReading> {
        let rules = CellRules { unit, decimal_comma: self.form.decimal_comma };
        match parse_cell(&field.text, rules) {
            Ok(reading) => match reading.entry {
                CellEntry::Length(value) => self.bounded(field, value).then_some(reading),
                _ => Some(reading),
            },
            Err(error) => {
                let code = if matches!(error, crate::units::CellError::DecimalComma { .. }) { "E308" } else { "E301" };
                self.problems.error(code, field, error.to_string(), &error.remedy());
                None
            }
        }
    }

    /// Whether a length can be one of a ship; an error otherwise.
    fn bounded(&mut self, field: &Field, value: f64) -> bool {
        let good = value.abs() <= LARGEST;
        if !good {
            let size = if value.abs() < 1e9 { format!("{value}") } else { format!("{value:e}") };
            let message = format!("a length of {size} m is no ship's; at most {LARGEST} m are read");
            self.problems.error("E315", field, message, "Correct the number, or its unit");
        }
        good
    }

    /// A cell of half-breadths (`half`), or of heights.
    pub(super) fn cell(&mut self, field: &Field, half: bool) -> Cell {
        let unit = if half { self.units.y } else { self.units.z };
        let Some(reading) = self.reading(field, unit) else { return Cell::default() };
        match reading.writing {
            CellWriting::Plain { decimals } => {
                self.digits[decimals.min(17)] += 1;
                self.writings[0] += 1;
            }
            CellWriting::Eighths => self.writings[1] += 1,
            CellWriting::WithUnit => {
                if let Some(decimals) = decimals_in(field.trimmed(), unit) {
                    self.digits[decimals.min(17)] += 1;
                }
            }
            CellWriting::Nothing => {}
        }
        let share = if half && self.form.full_breadths { 0.5 } else { 1.0 };
        let entry = match reading.entry {
            CellEntry::Absent => Entry::Absent,
            CellEntry::Unknown => Entry::Unknown,
            CellEntry::Length(value) => Entry::Given(share * value),
        };
        let marks = Marks {
            doubtful: reading.doubtful,
            locked: reading.locked,
            knuckle: reading.knuckle,
            tangent: reading.tangent,
        };
        let written = Written { text: field.text.trim().to_owned(), row: field.row, column: field.column };
        Cell { entry, marks, written: Some(written) }
    }

    /// A single length beside the offsets; none where nothing is written.
    pub(super) fn length(&mut self, field: &Field, unit: Notation) -> Option<f64> {
        match self.reading(field, unit)?.entry {
            CellEntry::Length(value) => Some(value),
            CellEntry::Absent | CellEntry::Unknown => None,
        }
    }

    /// A position across the stations with the spacing of numbered waterlines \[m\].
    fn across_by(&self, position: Position, spacing: Option<f64>) -> f64 {
        match position.place {
            Coordinate::Number(number) => match spacing {
                Some(spacing) => number * spacing,
                None => self.units.z.metres(number),
            },
            Coordinate::Length(length) => length,
            Coordinate::AftPerpendicular | Coordinate::ForePerpendicular | Coordinate::Midship => 0.0,
        }
    }

    /// A position of a station \[m\]. Numbers that are lengths carry their unit already.
    pub(super) fn along(&self, position: Position) -> f64 {
        match (position.place, self.form.origin) {
            (Coordinate::Number(number), StationDatum::Lengths) => self.units.x.metres(number),
            (Coordinate::Number(number), StationDatum::Shifted { offset, sign }) => {
                offset + sign * self.units.x.metres(number)
            }
            (Coordinate::Number(number), StationDatum::Numbers { offset, spacing }) => offset + spacing * number,
            (Coordinate::Length(length), StationDatum::Shifted { offset, sign }) => offset + sign * length,
            (Coordinate::Length(length), _) => length,
            (Coordinate::AftPerpendicular, _) => 0.0,
            (Coordinate::ForePerpendicular, _) => self.length.unwrap_or(0.0),
            (Coordinate::Midship, _) => 0.5 * self.length.unwrap_or(0.0),
        }
    }

    /// Where the waterline is that is named `LWL` alone: at the draught, or at the number between its neighbours.
    fn level(&self, fields: &[Field], found: &[Result<Position, UnitError>], what: &str) -> Option<Position> {
        let at = fields.iter().position(|field| is_level(field.trimmed())).filter(|_| what == "waterline")?;
        let place = match (self.settings.from_waterline.is_some(), self.settings.stated.draught) {
            (true, _) => Coordinate::Length(0.0),
            (false, Some(draught)) => Coordinate::Length(draught),
            (false, None) => {
                let number = |at: usize| found.get(at)?.as_ref().ok()?.number();
                let (before, after) = (at.checked_sub(1).and_then(number), number(at + 1));
                let between = before.zip(after).map(|(before, after)| 0.5 * (before + after));
                let beyond = before.zip(at.checked_sub(2).and_then(number)).map(|(near, far)| 2.0 * near - far);
                Coordinate::Number(between.or(beyond.filter(|_| after.is_none()))?)
            }
        };
        Some(Position { place, axis: Some(Axis::Waterline), named: true, end: None })
    }

    /// Positions of fields; a field that names none is an error, and none is returned then.
    fn positions(&mut self, fields: &[Field], what: &str) -> Option<Vec<Position>> {
        let mut list = Vec::with_capacity(fields.len());
        let found = positions(fields.iter().map(Field::trimmed), self.form.decimal_comma);
        let level = self.level(fields, &found, what);
        for (field, found) in fields.iter().zip(found) {
            match found {
                Ok(position) => list.push(position),
                Err(_) if is_level(field.trimmed()) && level.is_some() => list.extend(level),
                Err(error) => {
                    let message = format!("the header of a {what} names no position: {error}");
                    let is_end = what == "station" && super::boat::end_of(field.trimmed()) != 0;
                    let remedy = match is_end {
                        true => format!("Write the position behind the name, as {} (2.50 m)", field.trimmed()),
                        false => super::settings::suggestion(field.trimmed()),
                    };
                    self.problems.error("E310", field, message, &remedy);
                }
            }
        }
        (list.len() == fields.len()).then_some(list)
    }

    /// The form with the notation and the digits that most offsets have.
    ///
    /// Whole numbers count where there are no others: a 6 among numbers with two decimals is 6.00. Of two numbers of
    /// digits that are as frequent the larger is taken.
    pub(super) fn finish(mut self) -> TableForm {
        let [plain, eighths] = self.writings;
        if eighths > plain {
            self.form.notation = Notation::FeetInchesEighths;
        }
        let most = (1..self.digits.len()).filter(|&d| self.digits[d] > 0).max_by_key(|&d| (self.digits[d], d));
        // Where nothing is a plain number, nothing tells the digits.
        let counts = self.form.notation != Notation::FeetInchesEighths && self.digits.iter().any(|count| *count > 0);
        self.form.decimals = counts.then_some(most.unwrap_or(0));
        self.form
    }
}

/// The digits after the decimal sign of `3.211 m`, where the unit is that of the table.
fn decimals_in(text: &str, unit: Notation) -> Option<usize> {
    let (number, word) = text.split_at(text.find(|c: char| c.is_alphabetic())?);
    let digits = number.trim().split_once(['.', ',']).map_or(0, |(_, digits)| digits.len());
    (Notation::from_word(word.trim()) == Some(unit)).then_some(digits)
}

/// The order of positions, when they rise or fall; otherwise the errors are noted.
pub(super) fn order(values: &[f64], fields: &[Field], what: &str, problems: &mut Problems) -> Option<Order> {
    let rising = values.windows(2).filter(|w| w[1] > w[0]).count();
    let order = if 2 * rising >= values.len().saturating_sub(1) { Order::Rising } else { Order::Falling };
    let mut good = true;
    for i in 1..values.len() {
        let (before, here) = (values[i - 1], values[i]);
        if let Some(twin) = values[..i].iter().position(|v| (v - here).abs() < SAME) {
            let twin = &fields[twin];
            let place = format!("row {}, column {}", twin.row, twin.column);
            let message = format!("a {what} at {} m stands in {place} already ('{}')", metres(here), twin.trimmed());
            problems.error("E306", &fields[i], message, "Take one of them away, or correct its position");
            good = false;
        } else if (here > before) != (order == Order::Rising) {
            let word = if order == Order::Rising { "rise" } else { "fall" };
            let message = format!(
                "the positions of the {what}s {word}, but {} m ('{}') follows {} m ('{}')",
                metres(here),
                fields[i].trimmed(),
                metres(before),
                fields[i - 1].trimmed()
            );
            problems.error("E303", &fields[i], message, "Correct the position, or put the lines in order");
            good = false;
        }
    }
    good.then_some(order)
}

/// Items in rising order.
fn rising<T>(mut items: Vec<T>, order: Order) -> Vec<T> {
    if order == Order::Falling {
        items.reverse();
    }
    items
}

fn kept(fields: &[Field], values: &[f64], order: Order) -> Vec<Kept> {
    let list = fields.iter().zip(values).map(|(f, &value)| Kept { text: f.trimmed().to_owned(), value }).collect();
    rising(list, order)
}

/// The stations and lines of one block with their positions \[m\].
struct Placed {
    xs: Vec<f64>,
    across: Vec<f64>,
    station_order: Order,
    across_order: Order,
}

/// The table of the blocks of a file.
pub(super) fn assemble(
    blocks: Vec<Block>,
    form: TableForm,
    settings: &Settings,
    problems: &mut Problems,
) -> Option<OffsetTable> {
    let first = blocks.first()?;
    let corner = Corner::of(first.corner.trimmed());
    let comma = form.decimal_comma;
    let unread = |fields: &mut dyn Iterator<Item = &Field>| -> Vec<Position> {
        positions(fields.map(Field::trimmed), comma).into_iter().flatten().collect()
    };
    let breadths = || blocks.iter().filter(|b| b.across == Axis::Waterline);
    let y = Size::of(breadths().flat_map(|b| &b.stations).flat_map(|line| &line.cells), comma);
    let y = if breadths().next().is_some() {
        y
    } else {
        Size::of(blocks.iter().flat_map(|b| &b.stations).flat_map(|line| &line.cells), comma)
    };
    let heads = unread(&mut blocks.iter().flat_map(|b| &b.heads));
    let stations = unread(&mut first.stations.iter().map(|line| &line.head));
    let half = if settings.full == Some(true) { 0.5 } else { 1.0 };
    // Which unit the offsets have is not known yet, but their size is when it tells stations from lengths.
    let rough = settings.units.or(corner.unit).unwrap_or(if y.eighths > 0 {
        Notation::Feet
    } else if y.largest > 120.0 {
        Notation::Millimetres
    } else {
        Notation::Metres
    });
    let end = |line: Option<&MatrixRow>| Size::of(line.into_iter().flat_map(|line| &line.cells), comma).largest;
    let ends = [first.stations.first(), first.stations.last()].map(|line| end(line) / y.largest.max(f64::MIN_POSITIVE));
    let breadths =
        Breadths { largest: half * rough.metres(y.largest), ends, stem_is_beyond: stem_is_beyond(&blocks, comma) };
    let origin = origin(settings, corner, &stations, breadths, problems);
    let sizes = [Size::of_positions(stations.iter()), y, Size::of_positions(heads.iter())];
    let units = units(settings, corner, sizes, origin.numbers, problems);
    let datum = ends_from_midship(origin.datum, settings, &stations, units.x, problems);
    let mut reader = TableReader::new(settings, TableForm { origin: datum, ..form }, units, problems);
    reader.length = reader.length.or(origin.length).or(between(origin.datum.open, datum));
    let mut table = OffsetTable::default();
    for block in blocks {
        let Some(placed) = place(&block, &mut reader) else {
            only_read(&block, &mut reader);
            continue;
        };
        if block.across == Axis::Waterline && !table.waterlines.is_empty() {
            let message = "a second block of half-breadths".to_owned();
            reader.problems.error("E306", &block.corner, message, "Give one block of half-breadths and one of heights");
            continue;
        }
        insert(&mut table, block, placed, &mut reader);
    }
    checks::signs(&mut table, &mut reader);
    table.form = reader.finish();
    Some(table)
}

/// Whether the distances of the stem are greater than those of the stern, on the average.
fn stem_is_beyond(blocks: &[Block], comma: bool) -> Option<bool> {
    let mean = |wanted: SideKind| {
        let rows = blocks.iter().flat_map(|block| &block.endings).filter(|(kind, _)| *kind == wanted);
        let fields = rows.flat_map(|(_, line)| &line.cells).filter(|field| !field.is_blank());
        let all: Vec<f64> = fields
            .filter_map(|field| match position(field.trimmed(), comma).ok()?.place {
                Coordinate::Number(distance) | Coordinate::Length(distance) => Some(distance),
                _ => None,
            })
            .collect();
        (!all.is_empty()).then(|| all.iter().sum::<f64>() / all.len() as f64)
    };
    Some(mean(SideKind::Stem)? > mean(SideKind::Stern)?)
}

/// Distance between the perpendiculars \[m\] as distances from `open` were placed; none where they count from AP.
fn between(open: Option<From>, datum: StationDatum) -> Option<f64> {
    let StationDatum::Shifted { offset, .. } = datum else { return None };
    let length = if open? == From::Midship { 2.0 * offset } else { offset };
    (length > 0.0).then_some(length)
}

/// Reads the cells of a block that has no place in a table, for what is wrong with them.
fn only_read(block: &Block, reader: &mut TableReader<'_>) {
    let half = block.across == Axis::Waterline;
    for line in &block.stations {
        line.cells.iter().for_each(|field| {
            reader.cell(field, half);
        });
        for (side, field) in block.sides.iter().zip(&line.sides) {
            let breadth = matches!(side.kind, SideKind::FlatOfBottom | SideKind::DeckHalfBreadth);
            reader.length(field, if breadth { reader.units.y } else { reader.units.z });
        }
    }
    for field in block.endings.iter().flat_map(|(_, line)| &line.cells) {
        reader.length(field, reader.units.x);
    }
}

fn place(block: &Block, reader: &mut TableReader<'_>) -> Option<Placed> {
    let what = if block.across == Axis::Waterline { "waterline" } else { "buttock" };
    let lines: Vec<Field> = block.stations.iter().map(|line| line.head.clone()).collect();
    if block.stations.len().max(block.heads.len()) > MOST_LINES {
        let message = format!(
            "{} and {}; a table has at most {MOST_LINES}",
            counted(lines.len(), "station"),
            counted(block.heads.len(), what)
        );
        reader.problems.error("E312", &block.first, message, "");
        return None;
    }
    let heads = reader.positions(&block.heads, what);
    let stations = reader.positions(&lines, "station");
    let (mut heads, stations) = (heads?, stations?);
    if heights::names_waterlines(block.corner.trimmed()) {
        heads.iter_mut().for_each(|head| head.named = true);
    }
    let spacing = heights::spacing(block, &heads, reader);
    let across: Vec<f64> = heads.into_iter().map(|p| reader.across_by(p, spacing)).collect();
    let xs: Vec<f64> = stations.into_iter().map(|p| reader.along(p)).collect();
    let mut good = true;
    for (field, &value) in block.heads.iter().zip(&across).chain(lines.iter().zip(&xs)) {
        good &= reader.bounded(field, value);
    }
    if !good {
        return None;
    }
    let across_order = order(&across, &block.heads, what, reader.problems);
    let station_order = order(&xs, &lines, "station", reader.problems);
    Some(Placed { xs, across, station_order: station_order?, across_order: across_order? })
}

/// Puts a block into the table.
fn insert(table: &mut OffsetTable, block: Block, placed: Placed, reader: &mut TableReader<'_>) {
    let half = block.across == Axis::Waterline;
    let heads = kept(&block.heads, &placed.across, placed.across_order);
    let across = rising(placed.across, placed.across_order);
    let lines = rising(block.stations, placed.station_order);
    let xs = rising(placed.xs, placed.station_order);
    let fields: Vec<Field> = lines.iter().map(|line| line.head.clone()).collect();
    let first = table.stations.is_empty();
    if first {
        table.stations = lines.iter().zip(&xs).map(|(line, &x)| StationOffsets::new(name_of(line), x)).collect();
        reader.form.station_heads = kept(&fields, &xs, Order::Rising);
        reader.form.station_order = placed.station_order;
        reader.form.rows = block.rows;
        reader.form.trailing_separator = block.trailing;
    }
    let mut columns: Vec<SideLine> = Vec::new();
    if let Some(head) = &block.name_column {
        let texts =
            lines.iter().map(|line| line.name.as_ref().map(|f| Kept { text: f.trimmed().to_owned(), value: 0.0 }));
        let texts = texts.collect();
        columns.push(SideLine { kind: SideKind::Name, head: head.trimmed().to_owned(), before: true, texts });
    }
    columns.extend(block.sides.iter().map(|side| SideLine {
        kind: side.kind,
        head: side.head.trimmed().to_owned(),
        before: side.before,
        texts: Vec::new(),
    }));
    let named = usize::from(block.name_column.is_some());
    for (line, x) in lines.iter().zip(&xs) {
        // The second block gives the same stations, perhaps fewer.
        let at = table.stations.iter().position(|s| (s.station.x - x).abs() < SAME);
        let cells: Vec<Cell> = line.cells.iter().map(|field| reader.cell(field, half)).collect();
        let cells: Vec<Cell> = rising(cells, placed.across_order);
        let mut sides = Vec::new();
        for (side, field) in block.sides.iter().zip(&line.sides) {
            let is_breadth = matches!(side.kind, SideKind::FlatOfBottom | SideKind::DeckHalfBreadth);
            let unit = unit_of(side.head.trimmed()).unwrap_or(if is_breadth { reader.units.y } else { reader.units.z });
            let share = if is_breadth && reader.form.full_breadths { 0.5 } else { 1.0 };
            let value = reader.length(field, unit).map(|value| share * value);
            sides.push((side.kind, value, field.trimmed().to_owned()));
        }
        let Some(at) = at else {
            let message = format!("a station at {x} m that the half-breadths do not have");
            reader.problems.error("E306", &line.head, message, "Give the same stations in both blocks");
            continue;
        };
        let station = &mut table.stations[at];
        *(if half { &mut station.half_breadths } else { &mut station.heights }) = cells;
        for (column, (kind, value, text)) in columns[named..].iter_mut().zip(sides) {
            column.texts.push(value.map(|value| Kept { text, value }));
            *side_value(station, kind) = value;
        }
    }
    let corner = block.first.trimmed().to_owned();
    if half {
        table.endings = endings(&block.endings, placed.across_order, across.len(), reader);
        table.waterlines = across;
        reader.form.waterline_order = placed.across_order;
        (reader.form.corner, reader.form.waterline_heads, reader.form.side_columns) = (Some(corner), heads, columns);
    } else {
        table.buttocks = across;
        (reader.form.buttock_corner, reader.form.buttock_heads) = (Some(corner), heads);
        reader.form.buttock_columns = columns;
    }
}

fn name_of(line: &MatrixRow) -> String {
    let own = line.name.as_ref().filter(|name| !name.is_blank());
    own.unwrap_or(&line.head).trimmed().to_owned()
}

/// The place of a side value; that of a name or an ending is the deck on the centreline, which no caller asks for.
fn side_value(station: &mut StationOffsets, kind: SideKind) -> &mut Option<f64> {
    match kind {
        SideKind::Keel => &mut station.keel_height,
        SideKind::FlatOfBottom => &mut station.flat_of_bottom,
        SideKind::FlatOfSide => &mut station.flat_of_side,
        SideKind::DeckHeight => &mut station.deck_height,
        SideKind::DeckHalfBreadth => &mut station.deck_half_breadth,
        SideKind::DeckCentreHeight | SideKind::Name | SideKind::Stern | SideKind::Stem => {
            &mut station.deck_centre_height
        }
    }
}

/// The ends of the waterlines.
fn endings(
    lines: &[(SideKind, MatrixRow)],
    order: Order,
    count: usize,
    reader: &mut TableReader<'_>,
) -> Vec<[Option<f64>; 2]> {
    let mut ends = vec![[None; 2]; if lines.is_empty() { 0 } else { count }];
    for (kind, line) in lines {
        let fields = rising(line.cells.clone(), order);
        let end = usize::from(*kind == SideKind::Stem);
        let mut texts = Vec::with_capacity(fields.len());
        for (ends, field) in ends.iter_mut().zip(&fields) {
            let unit = unit_of(line.head.trimmed()).unwrap_or(reader.units.x);
            // Endings are lengths even where stations are numbered.
            let value = reader.length(field, unit).map(|v| match reader.form.origin {
                StationDatum::Shifted { offset, sign } => offset + sign * v,
                StationDatum::Lengths | StationDatum::Numbers { .. } => v,
            });
            ends[end] = value;
            texts.push(value.map(|value| Kept { text: field.trimmed().to_owned(), value }));
        }
        let head = line.head.trimmed().to_owned();
        reader.form.side_rows.push(SideLine { kind: *kind, head, before: false, texts });
    }
    ends
}
