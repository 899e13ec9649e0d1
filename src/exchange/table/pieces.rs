//! The pieces of a sheet, as people lay them out: tables beside or below each other, titles, groups of headers and units above
//! them, notes below them, main dimensions in two columns.
//!
//! Empty rows and columns part the pieces. A piece that begins with numbers goes on with the table before it.

use super::header::{Coordinate, begins_as_number, is_area_unit, position, side_of};
use super::problem::{Field, FilePosition, Problems};
use crate::units::Notation;

/// A table with what stands around it.
#[derive(Debug, Clone, Default)]
pub(super) struct Piece {
    /// The header and the rows below it.
    pub(super) rows: Vec<Vec<Field>>,
    /// Titles, groups of headers and notes.
    pub(super) texts: Vec<Field>,
    /// Units in a row below the header, one a column.
    pub(super) units: Vec<Option<Notation>>,
    /// Words with a number beside them.
    pairs: Vec<(Field, Field)>,
}

/// What a sheet holds.
#[derive(Debug, Clone, Default)]
pub(super) struct Pieces {
    pub(super) tables: Vec<Piece>,
    /// Titles and notes that stand by no table.
    pub(super) texts: Vec<Field>,
    /// Words with a number beside them.
    pub(super) pairs: Vec<(Field, Field)>,
}

/// Whether a field begins as a number does.
pub(super) fn is_numeric(field: &Field) -> bool {
    begins_as_number(&field.text)
}

/// Whether a header names where a line lies: by its number, or by a word for such lines.
fn names_position(field: &Field) -> bool {
    let text = field.trimmed();
    side_of(text).is_some()
        || position(text, true).is_ok_and(|p| {
            is_numeric(field) || p.axis.is_some() || !matches!(p.place, Coordinate::Number(_) | Coordinate::Length(_))
        })
}

fn filled(row: &[Field]) -> usize {
    row.iter().filter(|field| !field.is_blank()).count()
}

fn first_text(row: &[Field]) -> Option<&Field> {
    row.iter().find(|field| !field.is_blank())
}

/// A row below which others are, without its blank columns: where they are, from the first to the last that is filled.
fn groups(part: &[Vec<Field>]) -> Vec<[usize; 2]> {
    let width = part.iter().map(Vec::len).max().unwrap_or(0);
    let is_filled = |j: usize| part.iter().any(|row| row.get(j).is_some_and(|field| !field.is_blank()));
    let mut groups: Vec<[usize; 2]> = Vec::new();
    for j in (0..width).filter(|&j| is_filled(j)) {
        match groups.last_mut() {
            Some(group) if group[1] == j => group[1] = j + 1,
            _ => groups.push([j, j + 1]),
        }
    }
    // Empty columns behind the last are those of the file.
    if let Some(last) = groups.last_mut() {
        last[1] = width;
    }
    groups
}

/// The rows of a part between two columns, in runs without empty rows.
fn cut(part: &[Vec<Field>], [from, to]: [usize; 2]) -> Vec<Vec<Vec<Field>>> {
    let rows: Vec<Vec<Field>> = part
        .iter()
        .map(|row| {
            let row: Vec<Field> = row.iter().skip(from).take(to - from).cloned().collect();
            if row.iter().all(Field::is_blank) { Vec::new() } else { row }
        })
        .collect();
    rows.split(|row| row.is_empty()).filter(|run| !run.is_empty()).map(<[Vec<Field>]>::to_vec).collect()
}

/// Whether rows go on with the table before them: their first field is a number.
fn goes_on(rows: &[Vec<Field>]) -> bool {
    rows[0].first().is_some_and(is_numeric)
}

/// Whether columns go on with the table to the left of them: their header is a position, not a word for positions.
fn widens(left: &[Vec<Field>], rows: &[Vec<Field>]) -> bool {
    let line = |rows: &[Vec<Field>], at: usize| rows.get(at).and_then(|row| row.first()).map(|field| field.row);
    let beside = left.len() == rows.len() && (0..rows.len()).all(|at| line(left, at) == line(rows, at));
    let own_stations = is_numeric(&rows[0][0]) && left.first().is_some_and(|row| row[0].text == rows[0][0].text);
    names_position(&rows[0][0]) && beside && !own_stations
}

/// Whether any row has numbers enough for a table.
fn is_table(rows: &[Vec<Field>]) -> bool {
    rows.iter().any(|row| row.iter().filter(|field| is_numeric(field)).count() > 1)
}

/// Whether the first row is a title, or groups of headers: few words over a row with more fields. Titles may stand below each
/// other.
fn is_heading(rows: &[Vec<Field>]) -> bool {
    let [first, rest @ ..] = rows else { return false };
    let count = filled(first);
    let words = |field: &Field| field.text.contains(char::is_alphabetic);
    let texts = || first.iter().filter(|field| !field.is_blank());
    let is_title = |row: &&Vec<Field>| filled(row) == 1 && row.iter().any(words);
    let Some(below) = rest.iter().find(|row| !is_title(row)) else { return false };
    match count {
        0 => true,
        1 => texts().all(words) && filled(below) > 1 && below.len() > 1,
        _ => {
            let plain = |field: &Field| words(field) && !is_numeric(field) && !names_position(field);
            2 * count <= filled(below) && texts().all(plain)
        }
    }
}

/// Whether a last row is a note: one text of several words, which names no position.
fn is_note(row: &[Field]) -> bool {
    let Some(text) = first_text(row).filter(|_| filled(row) == 1).map(Field::trimmed) else { return false };
    let several =
        text.contains(char::is_whitespace) || text.starts_with('*') || text.to_lowercase().starts_with("note");
    several && text.contains(char::is_alphabetic) && first_text(row).is_some_and(|field| !names_position(field))
}

/// The unit that a field is, alone or in brackets.
fn unit(field: &Field) -> Option<Notation> {
    Notation::from_word(field.trimmed().trim_matches(['[', ']', '(', ')']))
}

/// Takes titles, units and notes off a table.
fn bare(mut rows: Vec<Vec<Field>>) -> Piece {
    let mut piece = Piece::default();
    let widest = rows.iter().map(|row| filled(row)).max().unwrap_or(0);
    let mut top = 0;
    loop {
        let left = &rows[top..];
        if let Some(pair) = left.first().filter(|_| widest > 3 && left.len() > 2).and_then(|row| pair(row)) {
            piece.pairs.push(pair);
        } else if is_heading(left) {
            piece.texts.extend(left[0].iter().filter(|field| !field.is_blank()).cloned());
        } else {
            break;
        }
        top += 1;
    }
    rows.drain(..top);
    while rows.len() > 1 && rows.last().is_some_and(|row| is_note(row)) {
        piece.texts.extend(rows.pop().into_iter().flatten().filter(|field| !field.is_blank()));
    }
    let units_below = rows.len() > 2 && {
        let (given, heads) = (filled(&rows[1]), filled(&rows[0]));
        given > 0
            && 2 * given + 1 >= heads
            && rows[1].iter().all(|field| field.is_blank() || unit(field).is_some() || is_area_unit(field.trimmed()))
    };
    if units_below {
        // The unit of an area goes with its name.
        let (heads, below) = rows.split_at_mut(1);
        for (head, field) in heads[0].iter_mut().zip(&below[0]).filter(|(_, field)| is_area_unit(field.trimmed())) {
            head.text = format!("{} {}", head.trimmed(), field.trimmed());
        }
        piece.units = rows.remove(1).iter().map(unit).collect();
    }
    piece.rows = rows;
    piece
}

/// A word with a number beside it, and perhaps its unit, in a row of nothing else.
fn pair(row: &[Field]) -> Option<(Field, Field)> {
    let mut fields = row.iter().filter(|field| !field.is_blank());
    let (key, value) = (fields.next()?, fields.next()?);
    let value = match fields.next() {
        Some(word) => Field { text: format!("{} {}", value.trimmed(), unit(word)?.as_str()), ..value.clone() },
        None => value.clone(),
    };
    (fields.next().is_none() && is_numeric(&value) && !is_numeric(key)).then(|| (key.clone(), value))
}

/// The texts and the pairs of a piece without a table.
fn words(rows: Vec<Vec<Field>>, pieces: &mut Pieces) {
    for row in rows {
        match pair(&row) {
            Some(pair) => pieces.pairs.push(pair),
            None => pieces.texts.extend(row.into_iter().filter(|field| !field.is_blank())),
        }
    }
}

/// The pieces of the rows of a sheet.
pub(super) fn pieces(rows: &[Vec<Field>]) -> Pieces {
    let mut pieces = Pieces::default();
    // Tables with the columns where they stand, before titles and notes are taken off.
    let mut tables: Vec<([usize; 2], Vec<Vec<Field>>)> = Vec::new();
    for part in rows.split(|row| row.is_empty()).filter(|part| !part.is_empty()) {
        let start = tables.len();
        for columns in groups(part) {
            for run in cut(part, columns) {
                let left = tables.len() > start;
                match tables.last_mut() {
                    Some((before, table)) if left && widens(table, &run) => {
                        table.iter_mut().zip(run).for_each(|(row, more)| row.extend(more));
                        before[1] = columns[1];
                    }
                    _ if !is_table(&run) => words(run, &mut pieces),
                    _ => match tables.iter_mut().rev().find(|(before, _)| before[0] == columns[0]) {
                        Some((_, table)) if goes_on(&run) => table.extend(run),
                        _ => tables.push((columns, run)),
                    },
                }
            }
        }
    }
    pieces.tables = tables.into_iter().map(|(_, rows)| bare(rows)).collect();
    pieces.pairs.extend(pieces.tables.iter_mut().flat_map(|piece| std::mem::take(&mut piece.pairs)));
    pieces
}

/// Leaves tables out that name no positions, as hydrostatics, where another one does.
pub(super) fn without_others(pieces: &mut Pieces, problems: &mut Problems) {
    let places_lines = |piece: &Piece| {
        let along = |fields: &mut dyn Iterator<Item = &Field>| {
            let all: Vec<bool> = fields.filter(|field| !field.is_blank()).map(names_position).collect();
            2 * all.iter().filter(|named| **named).count() > all.len()
        };
        piece.rows.len() > 1
            && along(&mut piece.rows[0].iter().skip(1))
            && along(&mut piece.rows.iter().skip(1).filter_map(|row| row.first()))
    };
    if !pieces.tables.iter().any(places_lines) {
        return;
    }
    pieces.tables.retain(|piece| {
        let below = || Piece { rows: piece.rows[1..].to_vec(), ..Piece::default() };
        let kept =
            places_lines(piece) || piece.rows.len() > 2 && !is_numeric(&piece.rows[1][0]) && places_lines(&below());
        if let Some(corner) = piece.rows.first().and_then(|row| first_text(row)).filter(|_| !kept) {
            let message =
                format!("left out: the table that begins with '{}', whose headers name no positions", corner.trimmed());
            problems.warning("W332", FilePosition::row(corner.row), message, "");
        }
        kept
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(text: &str) -> Pieces {
        let field = |row: usize, (k, text): (usize, &str)| Field { text: text.to_owned(), row, column: k + 1 };
        let rows: Vec<Vec<Field>> = text
            .lines()
            .enumerate()
            .map(|(row, line)| line.split(',').enumerate().map(|part| field(row + 1, part)).collect::<Vec<_>>())
            .map(|row| if row.iter().all(Field::is_blank) { Vec::new() } else { row })
            .collect();
        pieces(&rows)
    }

    fn heads(pieces: &Pieces) -> Vec<String> {
        let head = |piece: &Piece| piece.rows[0].iter().map(|field| field.text.as_str()).collect::<Vec<_>>().join(",");
        pieces.tables.iter().map(head).collect()
    }

    #[test]
    fn tables_away_from_the_first_cell() {
        let found = of("Ship,,,\n,,,\n,,x,1\n,,0,2\n,,5,3\n,,,\nNote: moulded,,,");
        assert_eq!((heads(&found), found.texts.len()), (vec!["x,1".to_owned()], 2));
        assert_eq!(found.tables[0].rows[1][0].column, 3);
    }

    #[test]
    fn tables_side_by_side_and_wide_ones() {
        let found = of("x,1,,x,BT 1\n0,2,,0,3\n5,3,,5,4");
        assert_eq!(heads(&found), ["x,1", "x,BT 1"]);
        assert_eq!(heads(&of("x,1,,WL 2\n0,2,,3\n5,3,,4")), ["x,1,WL 2"]);
    }

    #[test]
    fn rows_around_a_table() {
        let found = of(",Half breadths,,\nx,1,2,3\n(m),(m),(m),(m)\n0,2,3,4\n,,,\n5,3,4,5\nChecked by N.N.,,,");
        assert_eq!((heads(&found), found.tables[0].rows.len()), (vec!["x,1,2,3".to_owned()], 3));
        assert_eq!(found.tables[0].units, [Some(Notation::Metres); 4]);
        assert_eq!(found.tables[0].texts.len(), 2);
        let found = of("Lpp,100\nB,12\n,\nx,1,2\n0,2,3\n5,3,4");
        assert_eq!((heads(&found), found.pairs.len()), (vec!["x,1,2".to_owned()], 2));
    }
}
