//! The layout of matrices: which lines are stations, which are waterlines or buttocks, which stand beside them.
//!
//! One block is a header and the rows below it (see `pieces`). What the rows are is taken
//! from the conventions, else from the words of the headers, else from the numbers: a hull tapers to both of its ends,
//! and does not taper upwards.

use super::header::{Axis, Corner, axis_of, has_area_unit, is_base_line, is_deck, is_orderly, plain_number, side_of};
use super::pieces::Piece;
use super::problem::{Field, FilePosition, Problems};
use super::settings::{Settings, spacing};
use crate::hull::{Rows, SideKind};
use crate::units::{CellEntry, CellRules, Notation, counted, parse_cell};

/// More rows of three numbers are points.
const LEAST_POINTS: usize = 12;

/// One station, or one ending, of a block.
#[derive(Debug, Clone, Default)]
pub(super) struct MatrixRow {
    /// Its position.
    pub(super) head: Field,
    /// Its name, when that stands in a field of its own.
    pub(super) name: Option<Field>,
    /// As many as the block has heads.
    pub(super) cells: Vec<Field>,
    /// As many as the block has sides.
    pub(super) sides: Vec<Field>,
}

/// A side column of a block.
#[derive(Debug, Clone)]
pub(super) struct SideHeader {
    pub(super) kind: SideKind,
    pub(super) head: Field,
    /// Before the offsets.
    pub(super) before: bool,
}

/// One matrix, turned so that its lines are stations.
#[derive(Debug, Clone)]
pub(super) struct Block {
    /// Where the headers cross, as far as it says what they are.
    pub(super) corner: Field,
    /// The first field of the header with the positions; another one than `corner` when names stand in a header above.
    pub(super) first: Field,
    pub(super) rows: Rows,
    /// Why the rows are what they are, for the note.
    pub(super) reason: &'static str,
    /// Waterline or buttock.
    pub(super) across: Axis,
    /// Positions of the waterlines or buttocks.
    pub(super) heads: Vec<Field>,
    pub(super) sides: Vec<SideHeader>,
    pub(super) name_column: Option<Field>,
    pub(super) stations: Vec<MatrixRow>,
    /// Stern and stem.
    pub(super) endings: Vec<(SideKind, MatrixRow)>,
    /// Every row ended with an empty field.
    pub(super) trailing: bool,
}

/// The blocks of the tables of a file.
pub(super) fn blocks(tables: &[Piece], settings: &Settings, problems: &mut Problems) -> Vec<Block> {
    tables.iter().filter_map(|piece| block(piece, settings, problems)).flatten().collect()
}

/// A rectangle of fields, without an empty last column; rows of other lengths are errors.
fn rectangle(part: &[Vec<Field>], problems: &mut Problems) -> Option<(Vec<Vec<Field>>, bool)> {
    let length = |row: &Vec<Field>| row.iter().rposition(|f| !f.is_blank()).map_or(0, |at| at + 1);
    let trailing = part.iter().all(|row| row.len() > 1 && row.last().is_some_and(Field::is_blank));
    let width = part[0].len() - usize::from(trailing);
    let wrong: Vec<&Vec<Field>> =
        part.iter().filter(|row| length(row) > width || row.len() < part[0].len() && row.len() < width).collect();
    // As many fields again as the header has: every number was cut in two at its decimal comma.
    let doubled = wrong
        .iter()
        .filter(|row| row.len() > width && row.len() + 3 >= 2 * width && row.len() <= 2 * width + 3)
        .count();
    // Numbers with decimal points are not cut at commas.
    let whole = wrong.iter().flat_map(|row| row.iter()).all(|field| !field.text.contains('.'));
    if doubled > 0 && 2 * doubled >= part.len() - 1 && whole {
        let message = format!(
            "{doubled} rows have about twice as many fields as the header ({width}), the first of them {}: decimal commas between \
             separators that are commas too",
            wrong[0].len()
        );
        problems.error(
            "E308",
            FilePosition::row(wrong[0][0].row),
            message,
            "Separate the fields with ';' or tabs, or write decimal points",
        );
        return None;
    }
    for row in &wrong {
        let message = format!("the row has {} fields, the header has {width}", row.len());
        let remedy = if row.len() > width {
            "Take away what is too much, or a decimal comma"
        } else {
            "Fill up with empty fields where there is no hull"
        };
        problems.error("E307", FilePosition::row(row[0].row), message, remedy);
    }
    // The other rows, and what stands in these, are looked at all the same.
    let even = part.iter().map(|row| {
        let mut row: Vec<Field> = row.iter().take(width).cloned().collect();
        let line = row.first().map_or(0, |field| field.row);
        while row.len() < width {
            row.push(Field { text: String::new(), row: line, column: row.len() + 1 });
        }
        row
    });
    Some((even.collect(), trailing))
}

/// What the rows are, and why.
fn orientation(fields: &[Vec<Field>], settings: &Settings, problems: &mut Problems) -> (Rows, &'static str) {
    let rows_of = |axis: Axis| if axis.is_station() { Rows::Stations } else { Rows::Waterlines };
    let other = |axis: Axis| if axis.is_station() { Rows::Waterlines } else { Rows::Stations };
    if let Some(rows) = settings.rows {
        return (rows, "by the conventions");
    }
    let corner = Corner::of(fields[0][0].trimmed());
    // Beside or below a column or row of names the two headers may stand one field further.
    let further = [fields[0].get(1), fields.get(1).and_then(|row| row.first())];
    for corner in further.into_iter().flatten().map(|f| Corner::of(f.trimmed())).chain([corner]) {
        if let (Some(rows), Some(_)) = (corner.rows, corner.columns) {
            return (rows_of(rows), "by the first header");
        }
    }
    // A second word for what the first one says: names and positions stand side by side, or one below the other.
    let second_is = |field: Option<&Field>, first: Axis| {
        field.filter(|field| is_word(field) && side_of(field.trimmed()).is_none()).is_some_and(|field| {
            axis_of(field.trimmed()).is_some_and(|second| first.is_station() == second.is_station())
        })
    };
    if let Some(first) = corner.rows {
        if second_is(fields.get(1).and_then(|row| row.first()), first) {
            return (other(first), "by the two headers");
        }
        if second_is(fields[0].get(1), first) {
            return (rows_of(first), "by the two headers");
        }
    } else if second_is(fields[0].get(1), Axis::X) {
        return (Rows::Stations, "by the second header");
    }
    let most = |cells: &mut dyn Iterator<Item = &Field>| {
        let (mut stations, mut lines) = (0, 0);
        for axis in cells.filter_map(|f| if side_of(&f.text).is_some() { None } else { axis_of(&f.text) }) {
            *(if axis.is_station() { &mut stations } else { &mut lines }) += 1;
        }
        (stations != lines).then_some(if stations > lines { Axis::Station } else { Axis::Waterline })
    };
    if let Some(axis) = most(&mut fields[0].iter().skip(1)) {
        return (other(axis), "by the words of the headers");
    }
    if let Some(axis) = most(&mut fields.iter().skip(1).map(|row| &row[0])) {
        return (rows_of(axis), "by the words of the headers");
    }
    let tapers = tapering(fields);
    let (rows, why) = match (corner.rows, tapers) {
        (Some(axis), _) => (rows_of(axis), "by the words of the headers"),
        (None, Some(Rows::Stations)) => (Rows::Stations, "because the numbers taper to the first and the last row"),
        (None, Some(Rows::Waterlines)) => {
            (Rows::Waterlines, "because the numbers taper to the first and the last column")
        }
        (None, None) => (Rows::Stations, "assumed; the headers do not say it"),
    };
    let (turned, here, there) = match rows {
        Rows::Stations => (Rows::Waterlines, "stations", "column"),
        Rows::Waterlines => (Rows::Stations, "waterlines", "row"),
    };
    let remedy = "Declare rows = \"stations\" or rows = \"waterlines\"";
    if let Some([length, breadth, depth]) = extents(fields, rows).filter(|[l, b, d]| l < b && b < d) {
        let message = format!(
            "rows are not taken as {here}: the hull would be {length} long, {breadth} broad and {depth} high in the units of the file"
        );
        problems.warning("W320", FilePosition::FILE, message, remedy);
        return (turned, "because a hull is longer than it is broad");
    }
    // One header over both directions says less than a hull that tapers to its ends.
    if corner.rows.is_some() && tapers.is_some_and(|by_numbers| by_numbers != rows) {
        let message = format!(
            "rows are taken as {here} by the first header '{}', but the numbers taper to the first and the last {there} only, \
             as if the stations stood the other way",
            fields[0][0].trimmed()
        );
        problems.warning("W320", FilePosition::FILE, message, remedy);
    }
    (rows, why)
}

/// Length, breadth and depth in the numbers of a matrix whose rows are these; none where its headers are no numbers.
fn extents(fields: &[Vec<Field>], rows: Rows) -> Option<[f64; 3]> {
    let extent = |all: Option<Vec<f64>>| {
        let all = all?;
        let ends = all.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], n| [a.min(*n), b.max(*n)]);
        (all.len() > 1).then(|| ends[1] - ends[0])
    };
    let along_rows = extent(fields.iter().skip(1).map(|row| row.first().and_then(number)).collect())?;
    let along_columns = extent(fields[0].iter().skip(1).map(number).collect())?;
    let cells = fields.iter().skip(1).flat_map(|row| row.iter().skip(1)).filter_map(number);
    let breadth = 2.0 * cells.map(f64::abs).fold(0.0, f64::max);
    Some(match rows {
        Rows::Stations => [along_rows, breadth, along_columns],
        Rows::Waterlines => [along_columns, breadth, along_rows],
    })
}

/// What the rows are by the numbers: a hull tapers to its ends; none when they taper both ways or not at all.
fn tapering(fields: &[Vec<Field>]) -> Option<Rows> {
    let (mut by_row, mut by_column) = (vec![0.0; fields.len() - 1], vec![0.0; fields[0].len().saturating_sub(1)]);
    for (i, row) in fields.iter().skip(1).enumerate() {
        for (j, field) in row.iter().skip(1).enumerate() {
            let value = plain_number(&field.text).unwrap_or(0.0);
            if value.is_finite() {
                by_row[i] += value.abs();
                by_column[j] += value.abs();
            }
        }
    }
    let tapers = |sums: &[f64]| match (sums.first(), sums.last()) {
        (Some(&first), Some(&last)) => first.max(last) < 0.8 * sums.iter().copied().fold(0.0, f64::max),
        _ => false,
    };
    match (tapers(&by_row), tapers(&by_column)) {
        (true, false) => Some(Rows::Stations),
        (false, true) => Some(Rows::Waterlines),
        _ => None,
    }
}

fn transposed(fields: Vec<Vec<Field>>) -> Vec<Vec<Field>> {
    let width = fields.first().map_or(0, Vec::len);
    let mut columns: Vec<Vec<Field>> = (0..width).map(|_| Vec::with_capacity(fields.len())).collect();
    for row in fields {
        for (column, field) in columns.iter_mut().zip(row) {
            column.push(field);
        }
    }
    columns
}

fn number(field: &Field) -> Option<f64> {
    plain_number(&field.text).filter(|n| n.is_finite())
}

/// Whether numbers have neither stations nor waterlines beside them: the first field is one of them, or the first row or
/// column does not rise or fall. A corner of zero, as programs fill it in, says nothing.
fn is_bare(fields: &[Vec<Field>]) -> bool {
    let heads: Option<Vec<f64>> = fields[0].iter().map(number).collect();
    let Some(heads) = heads else { return false };
    let lines: Option<Vec<f64>> = fields.iter().skip(1).map(|row| number(&row[0])).collect();
    heads[0].abs() > 0.0 || !is_orderly(&heads[1..]) || !lines.is_some_and(|lines| is_orderly(&lines))
}

/// Whether a header is words alone, without a number.
fn is_word(field: &Field) -> bool {
    !field.text.bytes().any(|b| b.is_ascii_digit()) && !field.is_blank()
}

/// Whether a header is a bare word for the positions of lines: `x`, `z [m]`, `height`.
fn is_positions(field: &Field, stations: bool) -> bool {
    let text = field.trimmed();
    let corner = Corner::of(text);
    // `z\x` too is over the positions of stations, once the table is turned.
    let crossed = stations && corner.columns.is_some() && [corner.rows, corner.columns].contains(&Some(Axis::X));
    let named = axis_of(text).is_some_and(|axis| if stations { axis == Axis::X } else { axis == Axis::Waterline });
    side_of(text).is_none() && (crossed || named)
}

/// Whether more headers name buttocks than waterlines. The base line is none of these, and lines without a name are what the
/// first one is.
fn are_buttocks<'f>(heads: impl Iterator<Item = &'f Field>) -> bool {
    let is_line = |head: &&Field| side_of(&head.text).is_none() && !is_base_line(head.trimmed()) && !head.is_blank();
    let axes: Vec<Option<Axis>> = heads.filter(is_line).map(|head| axis_of(&head.text)).collect();
    let (buttocks, others): (Vec<Axis>, Vec<Axis>) = axes.iter().flatten().partition(|axis| **axis == Axis::Buttock);
    let begins = axes.first().is_some_and(Option::is_some) || axes.iter().all(Option::is_some);
    begins && buttocks.len() > others.len()
}

/// Whether a title is that of heights at buttocks; `Buttocks 2 m apart` is none.
fn is_over_buttocks(text: &str) -> bool {
    let lower = text.to_lowercase();
    let states_spacing = spacing(&lower, &["buttock", "buttocks"]).is_some() && !lower.contains("height");
    let is_over_heights = lower.contains("height") && !lower.contains("half");
    (axis_of(text) == Some(Axis::Buttock) || is_over_heights) && names_buttock(text) && !states_spacing
}

/// Whether a header names a buttock in full; `BL` may be the base line.
fn names_buttock(text: &str) -> bool {
    let lower = text.to_lowercase();
    lower.split(|c: char| !c.is_alphabetic()).any(|word| matches!(word, "bt" | "butt" | "buttock" | "buttocks"))
}

/// Whether a header names what is no line of offsets: sums and multipliers (Simpson's rule), areas, volumes and remarks.
fn is_reckoning(field: &Field) -> bool {
    const FIRST: [&str; 13] = [
        "sm",
        "simpson",
        "simpsons",
        "multiplier",
        "multipliers",
        "sum",
        "sums",
        "total",
        "totals",
        "product",
        "products",
        "f(a)",
        "f(v)",
    ];
    const ANY: [&str; 10] =
        ["area", "areas", "volume", "volumes", "remark", "remarks", "note", "notes", "comment", "comments"];
    let name = field.trimmed().to_lowercase().replace(['.', '\'', '\u{2019}'], "");
    let mut words = name.split(|c: char| !c.is_alphabetic());
    FIRST.contains(&name.as_str())
        || name.split_whitespace().next().is_some_and(|word| FIRST.contains(&word)) && !field.text.contains('=')
        || words.any(|word| ANY.contains(&word))
        || has_area_unit(field.trimmed())
}

/// Without columns and rows of what is no offset, which are named.
fn without_reckoning(fields: Vec<Vec<Field>>, problems: &mut Problems) -> Vec<Vec<Field>> {
    let columns: Vec<bool> = fields[0].iter().enumerate().map(|(j, head)| j > 0 && is_reckoning(head)).collect();
    let is_row = |i: usize, row: &[Field]| i > 0 && row.first().is_some_and(is_reckoning);
    let left_out = fields[0].iter().zip(&columns).filter(|(_, out)| **out).map(|(head, _)| head);
    let rows = fields.iter().enumerate().filter(|(i, row)| is_row(*i, row)).map(|(_, row)| &row[0]);
    for head in left_out.chain(rows) {
        let message = "left out: sums, multipliers, areas, volumes and remarks are no offsets".to_owned();
        problems.warning("W332", head.place(), message, "");
    }
    let kept = fields.into_iter().enumerate().filter(|(i, row)| !is_row(*i, row));
    let without = |row: Vec<Field>| row.into_iter().zip(&columns).filter(|(_, out)| !**out).map(|(f, _)| f).collect();
    kept.map(|(_, row)| without(row)).collect()
}

/// The least over the greatest height of a deck, at least, and that of its half-breadths, at most; and the half-breadth of a fine
/// end over the greatest.
const DECK_HEIGHTS: f64 = 0.5;
const DECK_BREADTHS: f64 = 0.35;
const FINE_END: f64 = 0.5;

/// What a column named deck holds, by its numbers: half-breadths fall to the fine ends of the hull, heights do not. `rows` are
/// its numbers beside the greatest half-breadths of the stations.
fn deck_by_numbers(rows: &[(f64, f64)]) -> Option<SideKind> {
    let greatest = |of: fn(&(f64, f64)) -> f64| rows.iter().map(of).fold(0.0, f64::max);
    let (deck, breadth) = (greatest(|row| row.0), greatest(|row| row.1));
    let fine = rows.iter().filter(|row| row.1 <= FINE_END * breadth);
    let least = fine.map(|row| row.0).reduce(f64::min)? / deck;
    if least <= DECK_BREADTHS {
        Some(SideKind::DeckHalfBreadth)
    } else {
        (least >= DECK_HEIGHTS).then_some(SideKind::DeckHeight)
    }
}

/// The kind of the column of a deck at `column` below `head`, with what was assumed; an error where nothing tells it.
fn deck(head: &Field, rows: &[Vec<Field>], column: usize, problems: &mut Problems) -> Option<SideKind> {
    let length = |field: &Field| {
        let rules = CellRules { unit: Notation::Metres, decimal_comma: field.text.contains(',') };
        match parse_cell(&field.text, rules).ok()?.entry {
            CellEntry::Length(length) => Some(length.abs()),
            _ => None,
        }
    };
    let beside = |row: &Vec<Field>| {
        let others =
            row.iter().enumerate().filter(|(j, _)| *j > 0 && *j != column).filter_map(|(_, field)| length(field));
        Some((length(&row[column])?, others.reduce(f64::max)?))
    };
    let numbers: Vec<(f64, f64)> = rows.iter().filter(|row| !row[0].is_blank()).filter_map(beside).collect();
    let kind = deck_by_numbers(&numbers);
    let remedy = "Write 'z deck' over its heights, 'y deck' over its half-breadths";
    match kind {
        None => {
            let message = "a line named deck, of heights or of half-breadths: its numbers do not tell which".to_owned();
            problems.error("E310", head, message, remedy);
        }
        Some(kind) => {
            let (what, why) = match kind {
                SideKind::DeckHeight => ("heights", "they do not fall to the ends as half-breadths do"),
                _ => ("half-breadths", "they fall to the ends as those of the waterlines do"),
            };
            problems.warning("W320", head.place(), format!("taken as {what} of the deck at side: {why}"), remedy);
        }
    }
    kind
}

/// What a column of a matrix holds.
#[derive(Clone, Copy, PartialEq)]
enum Held {
    Side,
    Cell,
    /// A height at a buttock, beside half-breadths.
    Height,
}

/// Whether the group of headers over a column is that of heights at buttocks: the last one that begins before it, in the nearest
/// row that has several.
fn is_below_buttocks(head: &Field, texts: &[Field]) -> bool {
    let rows = texts.iter().map(|text| text.row).filter(|row| *row < head.row);
    let has_groups = |row: &usize| texts.iter().filter(|text| text.row == *row).count() > 1;
    let Some(row) = rows.filter(has_groups).max() else { return false };
    let over = texts.iter().filter(|text| text.row == row && text.column <= head.column);
    over.max_by_key(|text| text.column).is_some_and(|text| is_over_buttocks(&text.text))
}

/// The block of a table, and that of the heights at buttocks beside it.
fn block(piece: &Piece, settings: &Settings, problems: &mut Problems) -> Option<Vec<Block>> {
    let (fields, trailing) = rectangle(&piece.rows, problems)?;
    if fields.len() < 2 || fields[0].len() < 2 {
        let message =
            format!("{} of {}: no table of offsets", counted(fields.len(), "row"), counted(fields[0].len(), "field"));
        problems.error("E300", &fields[0][0], message, "A matrix has a row of headers and rows of offsets below it");
        return None;
    }
    let fields = without_reckoning(fields, problems);
    if fields.len() < 2 || fields[0].len() < 2 {
        return None;
    }
    if is_bare(&fields) {
        let (message, remedy) = if fields[0].len() == 3 && fields.len() > LEAST_POINTS {
            ("three columns of numbers, and no word says what they are", "Write a header above them, as x,y,z")
        } else {
            let remedy = "Write the heights of the waterlines above them, the distances of the stations before them, and 'x [m]' \
                          where the two meet";
            ("half-breadths alone: no field of the first row is a word, and its numbers are no positions", remedy)
        };
        problems.error("E300", &fields[0][0], message.to_owned(), remedy);
        return None;
    }
    let (rows, reason) = orientation(&fields, settings, problems);
    let fields = if rows == Rows::Waterlines { transposed(fields) } else { fields };
    // Names and positions of waterlines may stand in two lines, and those of stations too.
    let top = usize::from(fields.len() > 2 && is_word(&fields[1][0]) && is_positions(&fields[1][0], false));
    let names = fields[0].len() > 2 && {
        let (first, second) = (&fields[0][0], &fields[0][1]);
        let named =
            first.is_blank() || axis_of(first.trimmed()).is_none_or(|axis| axis.is_station() && axis != Axis::X);
        is_word(second) && is_positions(second, true) && named
    };
    let left = usize::from(names);
    // With two lines of waterlines the names of the stations stand in the corner's row.
    let heads = &fields[top];
    let corner = if top == 1 && left == 0 { fields[0][0].clone() } else { heads[left].clone() };
    let says = Corner::of(corner.trimmed());
    let across =
        if rows == Rows::Waterlines { says.rows.filter(|a| !a.is_station()).or(says.columns) } else { says.columns };
    let beside: Vec<bool> = heads
        .iter()
        .map(|head| names_buttock(head.trimmed()) || rows == Rows::Stations && is_below_buttocks(head, &piece.texts))
        .collect();
    let are_mixed = beside.iter().skip(left + 1).any(|is_height| *is_height)
        && heads.iter().zip(&beside).skip(left + 1).any(|(head, is_height)| {
            !is_height
                && !head.is_blank()
                && side_of(head.trimmed()).is_none()
                && axis_of(head.trimmed()) != Some(Axis::Buttock)
        });
    let buttocks = across == Some(Axis::Buttock)
        || across.is_none() && !are_mixed && piece.texts.iter().any(|text| is_over_buttocks(&text.text))
        || !are_mixed && are_buttocks(heads.iter().skip(left + 1));
    let mut block = Block {
        corner,
        first: heads[left].clone(),
        rows,
        reason,
        across: if buttocks { Axis::Buttock } else { Axis::Waterline },
        heads: Vec::new(),
        sides: Vec::new(),
        name_column: names.then(|| fields[0][0].clone()),
        stations: Vec::new(),
        endings: Vec::new(),
        trailing,
    };
    // Which column is what: a position, a side, or nothing.
    let mut columns: Vec<Option<Held>> = vec![None; heads.len()];
    let mut heights = Block { across: Axis::Buttock, ..block.clone() };
    for (j, head) in heads.iter().enumerate().skip(left + 1) {
        let by_numbers = is_deck(head.trimmed());
        let kind = if by_numbers { deck(head, &fields[top + 1..], j, problems) } else { side_of(head.trimmed()) };
        if by_numbers && kind.is_none() {
            continue;
        }
        if let Some(kind) = kind.filter(|kind| !matches!(kind, SideKind::Stern | SideKind::Stem)) {
            let before = block.heads.is_empty();
            block.sides.push(SideHeader { kind, head: head.clone(), before });
            columns[j] = Some(Held::Side);
        } else if head.is_blank() {
            if let Some(full) = fields.iter().skip(top + 1).map(|row| &row[j]).find(|f| !f.is_blank()) {
                let message = "an offset without a header".to_owned();
                problems.error("E310", full, message, "Write the position of its waterline over it");
            }
        } else if !buttocks && beside[j] {
            heights.heads.push(head.clone());
            columns[j] = Some(Held::Height);
        } else {
            block.heads.push(head.clone());
            columns[j] = Some(Held::Cell);
        }
    }
    for row in fields.into_iter().skip(top + 1) {
        let (mut line, mut at_buttocks) = (MatrixRow::default(), Vec::new());
        for (j, field) in row.into_iter().enumerate() {
            match columns[j] {
                _ if j == left => line.head = field,
                None if j < left => line.name = Some(field),
                Some(Held::Side) => line.sides.push(field),
                Some(Held::Cell) => line.cells.push(field),
                Some(Held::Height) => at_buttocks.push(field),
                None => {}
            }
        }
        match side_of(line.head.trimmed()) {
            Some(kind @ (SideKind::Stern | SideKind::Stem)) => block.endings.push((kind, line)),
            _ => {
                let (head, name) = (line.head.clone(), line.name.clone());
                heights.stations.push(MatrixRow { head, name, cells: at_buttocks, sides: Vec::new() });
                block.stations.push(line);
            }
        }
    }
    let heights = Some(heights).filter(|heights| !heights.heads.is_empty());
    Some([block].into_iter().chain(heights).collect())
}
