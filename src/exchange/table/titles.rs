//! Titles above a table whose commas parted them into fields: `All dimensions in feet, stations 3 ft apart`.
//!
//! A row above the table that has another number of fields than the table, no blank one, and several words in one of them is one
//! text, and no row of stations.

use super::header::begins_as_number;
use super::problem::Field;
use crate::units::Notation;

/// Titles stand among so many rows.
const MOST: usize = 20;

/// Joins the fields of titles, and takes the line below a header away: `|---|---|`, or a row of blank fields.
pub(super) fn settle(rows: &mut Vec<Vec<Field>>, separator: char) {
    let is_rule = |row: &Vec<Field>| {
        let rule =
            |field: &Field| field.trimmed().chars().all(|c| matches!(c, '-' | ':' | '=')) && field.trimmed().len() > 2;
        row.iter().any(rule) && row.iter().all(|field| field.is_blank() || rule(field))
    };
    rows.retain(|row| !is_rule(row));
    let Some(width) = width(rows) else { return };
    let names = |row: &Vec<Field>| row.len() == width && filled(row) + 1 >= width && !begins_as_number(&row[0].text);
    if let Some(head) = rows.iter().take(MOST).position(names) {
        let blank = rows[head + 1..].iter().take_while(|row| row.is_empty()).count();
        let goes_on = |row: &Vec<Field>| row.len() == width && begins_as_number(&row[0].text);
        if rows.get(head + 1 + blank).is_some_and(goes_on) {
            rows.drain(head + 1..head + 1 + blank);
        }
    }
    // The table begins with words: its corner, or a blank one. Where it begins with numbers its header is among the rows
    // above.
    let Some(at) = rows.iter().take(MOST).position(|row| row.len() == width && filled(row) > 1) else { return };
    if begins_as_number(&rows[at][0].text) {
        return;
    }
    for row in rows[..at].iter_mut().filter(|row| is_title(row)) {
        let glue = if separator == ' ' { " ".to_owned() } else { format!("{separator} ") };
        let text = row.iter().map(Field::trimmed).collect::<Vec<_>>().join(&glue);
        let first = Field { text, ..row[0].clone() };
        *row = vec![first];
    }
}

/// Takes the units in a row below the header of columns to their names.
pub(super) fn units_below(rows: &mut Vec<Vec<Field>>, from_header: impl Fn(&[Vec<Field>]) -> &[Vec<Field>]) {
    let at = rows.len() - from_header(rows).len();
    let unit = |field: &Field| Notation::from_word(field.trimmed().trim_matches(['[', ']', '(', ')']));
    let Some(below) = (at + 1..rows.len()).find(|k| !rows[*k].is_empty()) else { return };
    let are_units = rows[below].iter().all(|field| field.is_blank() || unit(field).is_some());
    if !are_units || filled(&rows[below]) < 2 {
        return;
    }
    for (k, field) in rows.remove(below).iter().enumerate() {
        if let (Some(unit), Some(head)) = (unit(field), rows[at].get_mut(k)) {
            head.text = format!("{} [{}]", head.trimmed(), unit.as_str());
        }
    }
}

fn filled(row: &[Field]) -> usize {
    row.iter().filter(|field| !field.is_blank()).count()
}

/// The number of fields that most rows have.
fn width(rows: &[Vec<Field>]) -> Option<usize> {
    let lengths = || rows.iter().map(Vec::len).filter(|length| *length > 1);
    lengths().map(|length| (lengths().filter(|other| *other == length).count(), length)).max().map(|(_, length)| length)
}

/// Whether a row is a text: none of its fields is blank, and one has several words. A word with a number beside it is a
/// dimension.
fn is_title(row: &[Field]) -> bool {
    let several = |field: &Field| {
        field.trimmed().split_whitespace().filter(|word| word.contains(char::is_alphanumeric)).count() > 1
            && field.text.contains(char::is_alphabetic)
    };
    let is_pair = row.len() == 2 && begins_as_number(&row[1].text) && row[1].trimmed().split_whitespace().count() < 3;
    row.len() > 1 && filled(row) == row.len() && row.iter().any(several) && !is_pair
}

#[cfg(test)]
mod tests {
    use super::*;

    fn settled(text: &str) -> Vec<usize> {
        let field = |row: usize, (k, text): (usize, &str)| Field { text: text.to_owned(), row, column: k + 1 };
        let mut rows: Vec<Vec<Field>> = text
            .lines()
            .enumerate()
            .map(|(row, line)| line.split(',').enumerate().map(|part| field(row + 1, part)).collect())
            .collect();
        settle(&mut rows, ',');
        rows.iter().map(Vec::len).collect()
    }

    #[test]
    fn titles_are_one_text_and_headers_are_not() {
        for title in ["In feet, stations 3 ft apart", "Sloop,30 ft,LOA", "Moulded lines, 1:50, 12.5.1987"] {
            assert_eq!(settled(&format!("{title}\nx,0,1,2\n0,0,1,2\n5,1,2,3")), [1, 4, 4, 4], "{title}");
        }
        // Main dimensions, groups of headers, a header with too few fields, and one of the width of the table.
        for first in ["Lpp,100 m", ",Half breadths", "WL no,1", "Half breadths,,,"] {
            let before = first.split(',').count();
            assert_eq!(settled(&format!("{first}\nx,0,1,2\n0,0,1,2\n5,1,2,3"))[0], before, "{first}");
        }
        assert_eq!(settled("x in m,WL 1,WL 2\n0,0,1,2\n5,1,2,3")[0], 3);
    }
}
