//! From bytes to fields: the encoding, the separator, quotes, comment lines, and the limits that keep any input harmless.
//!
//! Tabs, semicolons, bars or commas part the fields, or blanks where none of these does. Fields follow RFC 4180: a field in quotes may hold separators, line ends and doubled quotes. A line whose first
//! character is `#` is a comment; the last one before numbers alone, with as many fields as they have, is their header. Memory is bounded by [`LARGEST_TABLE`] bytes of text and [`MOST_CELLS`] fields.

use super::blanks::MOST_COLUMNS;
use std::borrow::Cow;

use super::blanks;
use super::header::plain_number;
use super::problem::{Field, FilePosition, Problems};

/// Longer files are not tables of offsets \[bytes\].
pub const LARGEST_TABLE: usize = 16 << 20;
/// The most rows of a file; a tidy table has one row an offset.
pub const MOST_ROWS: usize = 200_000;
/// The most stations, and the most waterlines, buttocks or lines of points; keeps comparisons of all with all short.
pub const MOST_LINES: usize = MOST_COLUMNS;
/// The most fields of a file.
pub const MOST_CELLS: usize = 1_000_000;
/// The longest field \[bytes\].
pub const LONGEST_FIELD: usize = 1_000;

/// A file as rows of fields.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Grid {
    /// Rows in the order of the file; an empty line is a row without fields.
    pub(super) rows: Vec<Vec<Field>>,
    /// Comment lines with their line numbers, without the `#`.
    pub(super) comments: Vec<(usize, String)>,
    pub(super) separator: char,
    pub(super) carriage_returns: bool,
    /// The last line has no end.
    pub(super) open_end: bool,
}

/// The text of a file: UTF-8, UTF-16 with its mark, or Latin-1, which is announced.
pub(super) fn decode(bytes: &[u8], problems: &mut Problems) -> Option<String> {
    if bytes.len() > LARGEST_TABLE {
        let message = format!("the file has {} bytes; a table has at most {LARGEST_TABLE}", bytes.len());
        problems.error("E312", FilePosition::FILE, message, "");
        return None;
    }
    let wide = match bytes {
        [0xff, 0xfe, rest @ ..] => Some((rest, u16::from_le_bytes as fn([u8; 2]) -> u16)),
        [0xfe, 0xff, rest @ ..] => Some((rest, u16::from_be_bytes as fn([u8; 2]) -> u16)),
        _ => None,
    };
    let text = if let Some((rest, order)) = wide {
        let units = rest.chunks_exact(2).map(|pair| order([pair[0], pair[1]]));
        char::decode_utf16(units).map(|c| c.unwrap_or(char::REPLACEMENT_CHARACTER)).collect()
    } else {
        match std::str::from_utf8(bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes)) {
            Ok(text) => text.to_owned(),
            Err(_) => {
                problems.note("the file is not UTF-8; read as Latin-1".to_owned());
                bytes.iter().map(|&b| char::from(b)).collect()
            }
        }
    };
    let text = with_line_ends(text.into()).into_owned();
    if text.chars().any(|c| c.is_control() && !matches!(c, '\t' | '\n' | '\r')) {
        problems.error(
            "E300",
            FilePosition::FILE,
            "the file is not text".to_owned(),
            "Give the table as CSV, TSV or XLSX.",
        );
        return None;
    }
    Some(text)
}

/// A text whose lines end with line feeds: old Macs end them with a carriage return alone.
pub(super) fn with_line_ends(text: Cow<'_, str>) -> Cow<'_, str> {
    if text.contains('\r') && !text.contains('\n') { text.replace('\r', "\n").into() } else { text }
}

/// The character between fields: the tab, the semicolon or the bar when most lines have one outside quotes; else the
/// comma, or the blank.
fn sniff(text: &str) -> char {
    let mut counts = [0usize; 3];
    let labels = has_hash_labels(text.lines());
    let all = text.lines().filter(|line| !line.trim().is_empty() && (labels || !line.starts_with('#')));
    let lines: Vec<&str> = all.take(200).collect();
    for line in &lines {
        let mut open = false;
        let mut seen = [false; 3];
        for c in line.chars() {
            match c {
                '"' => open = !open,
                '\t' if !open => seen[0] = true,
                ';' if !open => seen[1] = true,
                '|' if !open => seen[2] = true,
                _ => {}
            }
        }
        for (count, seen) in counts.iter_mut().zip(seen) {
            *count += usize::from(seen);
        }
    }
    let most = ['\t', ';', '|'].into_iter().zip(counts).max_by_key(|(_, count)| *count);
    let other = if blanks::part(&lines) { ' ' } else { ',' };
    most.filter(|(_, count)| 2 * count > lines.len()).map_or(other, |(c, _)| c)
}

/// Whether a line is numbers behind a label as `#0`.
pub(super) fn is_hash_label(line: &str) -> bool {
    let mut fields = line.split(['\t', ';', '|', ',', ' ']).map(str::trim).filter(|field| !field.is_empty());
    let is_number = |field: &str| field.parse::<f64>().is_ok();
    let label = fields.next().and_then(|field| field.strip_prefix('#'));
    label.is_some_and(is_number) && fields.next().is_some_and(is_number)
}

/// Whether the rows of a table are labelled `#0`, `#1`: more lines of numbers begin so than otherwise. Fewer are comments.
pub(super) fn has_hash_labels<'t>(lines: impl Iterator<Item = &'t str>) -> bool {
    let numbers = lines.filter_map(|line| match is_hash_label(line) {
        true => Some(1),
        false => line.trim_start().starts_with(|c: char| c.is_ascii_digit() || c == '-').then_some(-1),
    });
    numbers.sum::<i64>() > 0
}

/// Splits a text into rows of fields; every breach of a limit is an error.
pub(super) fn split(text: &str, separator: Option<char>, problems: &mut Problems) -> Option<Grid> {
    let separator = separator.unwrap_or_else(|| sniff(text));
    let mut grid = Grid {
        separator,
        carriage_returns: text.contains("\r\n"),
        open_end: !text.is_empty() && !text.ends_with('\n'),
        ..Grid::default()
    };
    if separator == ' ' {
        split_at_blanks(text, &mut grid, problems)?;
    } else {
        split_at_separators(text, &mut grid, problems)?;
    }
    // Rules below titles and headers of text tables.
    let is_rule = |field: &Field| field.trimmed().chars().all(|c| matches!(c, '-' | ':' | '=' | '+' | '_' | '*' | '~'));
    let rules = |row: &Vec<Field>| row.iter().all(is_rule) && row.iter().any(|field| field.trimmed().len() > 2);
    grid.rows.iter_mut().filter(|row| rules(row)).for_each(Vec::clear);
    header_of_comment(&mut grid);
    Some(grid)
}

/// Takes the header of rows of numbers from the last comment before them.
fn header_of_comment(grid: &mut Grid) {
    let is_number = |text: &str| plain_number(text).is_some();
    let Some(first) = grid.rows.iter().find(|row| !row.is_empty()) else { return };
    let Some(at) = grid.comments.iter().rposition(|(line, _)| *line < first[0].row) else { return };
    let (row, comment) = &grid.comments[at];
    let texts: Vec<&str> = match grid.separator {
        ' ' => comment.split_whitespace().collect(),
        separator => comment.split(separator).map(str::trim).collect(),
    };
    let numbers = first.len() > 1 && first.iter().all(|field| is_number(&field.text));
    if !numbers || texts.len() != first.len() || comment.contains('=') || is_number(texts[0]) {
        return;
    }
    let field = |(k, text): (usize, &&str)| Field { text: (*text).to_owned(), row: *row, column: k + 1 };
    let header = texts.iter().enumerate().map(field).collect();
    grid.rows.insert(0, header);
    grid.comments.remove(at);
}

fn split_at_blanks(text: &str, grid: &mut Grid, problems: &mut Problems) -> Option<()> {
    let labels = has_hash_labels(text.lines());
    let mut lines: Vec<(usize, &str)> = Vec::new();
    for (index, line) in text.lines().enumerate() {
        match line.trim_start().strip_prefix('#').filter(|_| !(labels && is_hash_label(line))) {
            Some(comment) => grid.comments.push((index + 1, comment.trim().to_owned())),
            None => lines.push((index + 1, line)),
        }
    }
    let fields: usize = lines.iter().map(|(_, line)| line.split_whitespace().count()).sum();
    refuse_large(lines.len(), fields, lines.last().map_or(0, |(row, _)| *row), problems)?;
    grid.rows = blanks::rows(&lines, problems)?;
    Some(())
}

fn refuse_large(rows: usize, cells: usize, line: usize, problems: &mut Problems) -> Option<()> {
    if rows <= MOST_ROWS && cells <= MOST_CELLS {
        return Some(());
    }
    let message = format!("more than {MOST_ROWS} rows or {MOST_CELLS} cells");
    problems.error("E312", FilePosition::row(line), message, "");
    None
}

fn split_at_separators(text: &str, grid: &mut Grid, problems: &mut Problems) -> Option<()> {
    let separator = grid.separator;
    let (mut line, mut cells) = (1, 0);
    let mut rest = text;
    let labels = has_hash_labels(text.lines());
    while !rest.is_empty() {
        let is_label = labels && rest.lines().next().is_some_and(is_hash_label);
        if let Some(comment) = rest.strip_prefix('#').filter(|_| !is_label) {
            let end = comment.find('\n').unwrap_or(comment.len());
            grid.comments.push((line, comment[..end].trim().to_owned()));
            rest = comment.get(end + 1..).unwrap_or("");
            line += 1;
            continue;
        }
        let (row, lines, left) = record(rest, line, separator, problems)?;
        cells += row.len();
        grid.rows.push(row);
        refuse_large(grid.rows.len(), cells, line, problems)?;
        line += lines;
        rest = left;
    }
    Some(())
}

/// One row from the start of `rest`: its fields, the lines it takes, and what follows.
fn record<'t>(
    rest: &'t str,
    line: usize,
    separator: char,
    problems: &mut Problems,
) -> Option<(Vec<Field>, usize, &'t str)> {
    let mut fields = Vec::new();
    let mut field = Field { row: line, column: 1, text: String::new() };
    let mut lines = 1;
    let mut quotes = false;
    let mut characters = rest.char_indices().peekable();
    let mut end = rest.len();
    while let Some((at, c)) = characters.next() {
        match c {
            '"' if quotes && characters.peek().is_some_and(|&(_, next)| next == '"') => {
                field.text.push('"');
                characters.next();
            }
            '"' if quotes => quotes = false,
            // Inches, as in 3' 4 5/8", are no quotes.
            '"' if field.text.trim().is_empty() => {
                field.text.clear();
                quotes = true;
            }
            '\n' if !quotes => {
                end = at + 1;
                break;
            }
            c if c == separator && !quotes => {
                let next = Field { row: line, column: field.column + 1, text: String::new() };
                fields.push(std::mem::replace(&mut field, next));
                if fields.len() > MOST_COLUMNS {
                    problems.error(
                        "E312",
                        FilePosition::row(line),
                        format!("more than {MOST_COLUMNS} fields in a row"),
                        "",
                    );
                    return None;
                }
            }
            c => {
                lines += usize::from(c == '\n');
                field.text.push(c);
                if field.text.len() > LONGEST_FIELD {
                    let remedy = if quotes { "A quotation mark is opened and not closed." } else { "" };
                    problems.error("E312", &field, format!("a field longer than {LONGEST_FIELD} bytes"), remedy);
                    return None;
                }
            }
        }
    }
    if quotes {
        problems.error("E307", &field, "a quotation mark is opened and not closed".to_owned(), "");
        return None;
    }
    if field.text.ends_with('\r') {
        field.text.pop();
    }
    fields.push(field);
    if fields.iter().all(Field::is_blank) {
        fields.clear();
    }
    Some((fields, lines, &rest[end..]))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn texts(text: &str) -> (Vec<Vec<String>>, char) {
        let mut problems = Problems::new("t.csv");
        let grid = split(text, None, &mut problems).unwrap();
        (grid.rows.into_iter().map(|row| row.into_iter().map(|f| f.text).collect()).collect(), grid.separator)
    }

    fn row(fields: &[&str]) -> Vec<String> {
        fields.iter().map(|&f| f.to_owned()).collect()
    }

    #[test]
    fn separators_quotes_comments_and_empty_lines() {
        let (rows, separator) = texts("# a, b\nx,\"1,5\",\"a \"\"b\"\"\"\r\n\n3' 4\",2\n,,\n5");
        assert_eq!(separator, ',');
        let expected = [row(&["x", "1,5", "a \"b\""]), row(&[]), row(&["3' 4\"", "2"]), row(&[]), row(&["5"])];
        assert_eq!(rows, expected);
        assert_eq!(texts("x;1,5;2\n0;1,5;2\n").1, ';');
        assert_eq!(texts("x\t1,5\t2\n0\t1,5\t2\n").1, '\t');
        assert_eq!(texts("x|1.5\n0|2\n").1, '|');
        assert_eq!(texts("x 1.5\n0 2\n").1, ' ');
        assert_eq!(texts("\"a;b\",1\n2,3\n").1, ',');
    }

    #[test]
    fn a_comment_over_numbers_is_their_header() {
        assert_eq!(texts("# made by hand\n# x 0.5 1\n0 1 2\n10 2 3\n").0[0], row(&["x", "0.5", "1"]));
        assert_eq!(texts("# x, 0.5, 1\n0,1,2\n10,2,3\n").0[0], row(&["x", "0.5", "1"]));
        assert_eq!(texts("# T = 3 m\n0 1 2\n10 2 3\n").0[0], row(&["0", "1", "2"]));
    }

    #[test]
    fn places_count_lines_and_fields() {
        let mut problems = Problems::new("t.csv");
        let grid = split("# c\n\"a\nb\",2\n3,4\n", None, &mut problems).unwrap();
        assert_eq!(grid.comments, [(1, "c".to_owned())]);
        assert_eq!((grid.rows[0][1].row, grid.rows[0][1].column), (2, 2));
        assert_eq!((grid.rows[1][0].row, grid.rows[1][0].column), (4, 1));
    }

    #[test]
    fn encodings() {
        let mut problems = Problems::new("t.csv");
        assert_eq!(decode(b"\xef\xbb\xbfx", &mut problems).unwrap(), "x");
        assert_eq!(decode(b"\xff\xfex\0;\0", &mut problems).unwrap(), "x;");
        assert_eq!(decode(b"\xfe\xff\0x", &mut problems).unwrap(), "x");
        assert_eq!(decode(b"\xbd", &mut problems).unwrap(), "\u{bd}");
        assert!(!problems.any_errors());
        assert!(decode(b"a\0b", &mut problems).is_none());
        assert!(problems.any_errors());
    }
}
