//! Columns that blanks part: fixed width, and what numerical programs print.
//!
//! A unit in brackets belongs to the word before it. A header may have words with blanks (`WL 1`), and lacks its first
//! field where a program prints an index before each row. Where a row has fewer fields than the others, its fields go
//! to the columns below which they stand, if the columns of the full rows are apart.

use super::header::{begins_as_number, plain_number};
use super::problem::{Field, FilePosition, Problems};

/// A field with the characters where it starts and ends.
type Token<'t> = (&'t str, usize, usize);

/// The fields of a line; `least` blanks part two of them.
fn tokens(line: &str, least: usize) -> Vec<Token<'_>> {
    let mut list: Vec<Token<'_>> = Vec::new();
    let (mut start, mut end, mut gap) = (None, 0, 0);
    for (at, c) in line.char_indices().chain([(line.len(), '\n')]) {
        if c.is_whitespace() {
            gap += 1;
            if let Some(from) = start
                && (gap >= least || c == '\n' || c == '\t')
            {
                list.push((&line[from..end], from, end));
                start = None;
            }
        } else {
            start = start.or(Some(at));
            end = at + c.len_utf8();
            gap = 0;
        }
    }
    list
}

/// The fields of a line with bracketed units beside their words.
fn fields_of(line: &str) -> Vec<Token<'_>> {
    let mut list: Vec<Token<'_>> = Vec::new();
    for (text, start, end) in tokens(line, 1) {
        match list.last_mut() {
            Some((word, from, to)) if text.starts_with('[') && word.chars().all(|c| !c.is_ascii_digit()) => {
                (*word, *to) = (&line[*from..end], end);
            }
            _ => list.push((text, start, end)),
        }
    }
    list
}

fn is_number(text: &str) -> bool {
    plain_number(text).is_some()
}

/// Whether half of the fields begin as numbers do.
fn is_data(row: &[Token<'_>]) -> bool {
    2 * row.iter().filter(|token| begins_as_number(token.0)).count() >= row.len()
}

/// Whether blanks part the fields of most lines: no other sign does, or commas are decimal signs between blanks.
pub(super) fn part(lines: &[&str]) -> bool {
    let (mut parted, mut commas, mut pairs, mut inner) = (0, 0, 0, 0);
    for line in lines {
        parted += usize::from(line.split_whitespace().nth(1).is_some());
        commas += usize::from(line.contains(','));
        let parts: Vec<&str> = line.split(',').collect();
        for part in parts.iter().skip(1).take(parts.len().saturating_sub(2)) {
            inner += 1;
            let words: Vec<&str> = part.split_whitespace().collect();
            let outside = part.starts_with(char::is_whitespace) || part.ends_with(char::is_whitespace);
            pairs += usize::from(words.len() == 2 && words.iter().all(|word| is_number(word)) && !outside);
        }
    }
    2 * parted > lines.len() && (2 * commas <= lines.len() || inner > 0 && 2 * pairs > inner)
}

/// How many fields most lines have.
fn usual(rows: &[(usize, Vec<Token<'_>>)]) -> usize {
    let mut counts: Vec<usize> = rows.iter().map(|(_, row)| row.len()).collect();
    counts.sort_unstable();
    counts.chunk_by(|a, b| a == b).max_by_key(|same| same.len()).map_or(0, |same| same[0])
}

/// A header with as many fields as the rows below it, where one can be made of its words.
fn header<'t>(line: &'t str, row: Vec<Token<'t>>, width: usize) -> Vec<Token<'t>> {
    if row.len() > width {
        let wide = tokens(line, 2);
        if wide.len() == width {
            return wide;
        }
        let mut joined: Vec<Token<'_>> = Vec::new();
        for (text, start, end) in row.iter().copied() {
            match joined.last_mut() {
                Some((word, from, to)) if is_number(text) && word.chars().all(char::is_alphabetic) && *from > 0 => {
                    (*word, *to) = (&line[*from..end], end);
                }
                _ => joined.push((text, start, end)),
            }
        }
        if joined.len() == width {
            return joined;
        }
    }
    // Programs print no word over an index.
    if row.len() + 1 == width && row[0].1 > 0 {
        return [&[("", 0, 0)], row.as_slice()].concat();
    }
    row
}

/// The columns of rows that have all fields; none when they are not apart.
fn columns(rows: &[(usize, Vec<Token<'_>>)], width: usize) -> Option<Vec<[usize; 2]>> {
    let mut columns: Vec<[usize; 2]> = Vec::new();
    for (_, row) in rows.iter().filter(|(_, row)| row.len() == width) {
        if columns.is_empty() {
            columns = row.iter().map(|(_, start, end)| [*start, *end]).collect();
        }
        for (column, (_, start, end)) in columns.iter_mut().zip(row) {
            *column = [column[0].min(*start), column[1].max(*end)];
        }
    }
    let apart = columns.windows(2).all(|pair| pair[0][1] <= pair[1][0]);
    (apart && !columns.is_empty()).then_some(columns)
}

/// A short row with its fields in the columns where they stand; none when one stands in no column, or two in one.
fn placed<'t>(row: &[Token<'t>], columns: &[[usize; 2]]) -> Option<Vec<Token<'t>>> {
    let mut list: Vec<Token<'t>> = columns.iter().map(|column| ("", column[0], column[0])).collect();
    for token in row {
        let (_, start, end) = *token;
        let mut over = (0..columns.len()).filter(|&k| start < columns[k][1] && end > columns[k][0]);
        let at = over.next().filter(|_| over.next().is_none())?;
        if !list[at].0.is_empty() {
            return None;
        }
        list[at] = *token;
    }
    Some(list)
}

/// The rows of the lines of a text, with their numbers from 1; an empty line is a row without fields.
pub(super) fn rows(lines: &[(usize, &str)], problems: &mut Problems) -> Option<Vec<Vec<Field>>> {
    let mut rows: Vec<(usize, Vec<Token<'_>>)> = lines.iter().map(|(row, line)| (*row, fields_of(line))).collect();
    if let Some((row, _)) = rows.iter().find(|(_, row)| row.len() > MOST_COLUMNS) {
        let message = format!("more than {MOST_COLUMNS} fields in a row");
        problems.error("E312", FilePosition::row(*row), message, "");
        return None;
    }
    let width = usual(&rows);
    let Some(data) = rows.iter().position(|(_, row)| row.len() == width && is_data(row)) else {
        return Some(of_tokens(rows));
    };
    let above = data.checked_sub(1).filter(|&at| {
        let row = &rows[at].1;
        row.len() != width && row.len() + 1 >= width && width > 1 && is_number(rows[data].1[0].0)
    });
    if let Some(at) = above {
        rows[at].1 = header(lines[at].1, std::mem::take(&mut rows[at].1), width);
    }
    // Words of titles and notes are one text.
    for (k, ((_, row), (_, line))) in rows.iter_mut().zip(lines).enumerate() {
        let is_title = k < data && row.iter().any(|token| token.0.contains(char::is_alphabetic));
        if row.len() != width && !row.is_empty() && (is_title || row.iter().all(|token| !is_number(token.0))) {
            *row = vec![(line.trim(), 0, line.len())];
        }
    }
    if let Some(columns) = columns(&rows, width) {
        for (_, row) in rows.iter_mut().filter(|(_, row)| row.len() > 1 && row.len() < width) {
            if let Some(full) = placed(row, &columns) {
                *row = full;
            }
        }
    }
    Some(of_tokens(rows))
}

fn of_tokens(rows: Vec<(usize, Vec<Token<'_>>)>) -> Vec<Vec<Field>> {
    let field = |row: usize, column: usize, text: &str| Field { text: text.to_owned(), row, column };
    let fields = |(row, tokens): (usize, Vec<Token<'_>>)| {
        tokens.into_iter().enumerate().map(|(k, (text, _, _))| field(row, k + 1, text)).collect()
    };
    rows.into_iter().map(fields).collect()
}

/// The most fields of a row.
pub const MOST_COLUMNS: usize = 4_000;

#[cfg(test)]
mod tests {
    use super::*;

    fn texts(text: &str) -> Vec<Vec<String>> {
        let lines: Vec<(usize, &str)> = text.lines().enumerate().map(|(k, line)| (k + 1, line)).collect();
        let rows = rows(&lines, &mut Problems::new("t")).unwrap();
        rows.into_iter().map(|row| row.into_iter().map(|field| field.text).collect()).collect()
    }

    #[test]
    fn headers_of_several_words() {
        assert_eq!(texts("x [m]  0 0.5\n0 1 2\n1 2 3")[0], ["x [m]", "0", "0.5"]);
        assert_eq!(texts("stn  WL 1  WL 2\n0 1 2\n1 2 3")[0], ["stn", "WL 1", "WL 2"]);
        assert_eq!(texts("x WL 1 WL 2\n0 1 2\n1 2 3")[0], ["x", "WL 1", "WL 2"]);
        assert_eq!(texts("    x    y\n0  1.0  2.0\n1  1.5  2.5")[0], ["", "x", "y"]);
        assert_eq!(
            texts("Offsets of boat 12\n\nx [m] WL 0 WL 1\n0 1 2\n1 2 3")[..3].concat(),
            ["Offsets of boat 12", "x [m]", "WL 0", "WL 1"]
        );
        assert_eq!(texts("Offsets of a boat\nx 0 1\n0 1 2\n1 2 3")[0], ["Offsets of a boat"]);
    }

    #[test]
    fn short_rows_of_fixed_width() {
        let rows = texts("x     0.0   1.0   2.0\n0           0.5   1.5\n10    1.0   2.0   3.0\n20          1.0");
        assert_eq!(rows[1], ["0", "", "0.5", "1.5"]);
        assert_eq!(rows[3], ["20", "", "1.0", ""]);
        // Columns that are not apart give no place.
        assert_eq!(texts("x 0.0 1.0\n0 0.5\n100 1.0 2.0\n1000 1.25 3.5")[1], ["0", "0.5"]);
    }

    #[test]
    fn commas_among_blanks() {
        assert!(part(&["0 1,5 2,5", "1 2,5 3,5 4,5"]));
        assert!(part(&["x 1 2", "0 1.5 2"]));
        assert!(!part(&["3,0 7 4,1 1 6,1 4 3", "6,1 0 1,1 10 1,2 2 3"]));
        assert!(!part(&["x [m],1,2", "0, 1.5, 2"]));
        assert!(!part(&["hello", "1,2"]));
    }
}
