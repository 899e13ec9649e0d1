//! What is wrong with a table of offsets, and what should be known about it.

use std::collections::BTreeMap;
use std::fmt;

use crate::hull::Cell;
use crate::units::counted;

/// How serious a problem of a table is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Severity {
    /// The table cannot be used as it is.
    Error,
    /// It can be used, and the reader should know.
    Warning,
    /// What was detected.
    Note,
}

/// One problem of a table: where, what was found, why it is wrong, and the likely remedy.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct TableProblem {
    /// Error, warning or note.
    pub severity: Severity,
    /// Code, `E301`.
    pub code: &'static str,
    /// File as it was named by the user.
    pub file: String,
    /// Row (line) from 1; none when it is about the whole file.
    pub row: Option<usize>,
    /// Column (field) from 1.
    pub column: Option<usize>,
    /// What stands there; empty when it is about the whole file.
    pub found: String,
    /// What is wrong, with numbers.
    pub message: String,
    /// The likely remedy; empty when the message says it.
    pub remedy: String,
}

/// `E301 offsets.csv row 14, column 3: '3-11-9': eighths are 0 to 7. Did you mean 3-11-0 or 4-0-1?`
impl fmt::Display for TableProblem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {}", self.code, self.file)?;
        match (self.row, self.column) {
            (Some(row), Some(column)) => write!(f, " row {row}, column {column}")?,
            (Some(row), None) => write!(f, " row {row}")?,
            (None, Some(column)) => write!(f, " column {column}")?,
            (None, None) => {}
        }
        write!(f, ": ")?;
        if !self.found.is_empty() {
            write!(f, "'{}': ", self.found)?;
        }
        write!(f, "{}", self.message)?;
        if !self.remedy.is_empty() {
            let dotted = self.message.ends_with(['.', '?', '!']);
            write!(f, "{} {}", if dotted { "" } else { "." }, self.remedy)?;
        }
        Ok(())
    }
}

impl std::error::Error for TableProblem {}

/// After so many errors, and after so many remarks, the rest is only counted.
const MOST_LISTED: usize = 100;
/// More errors of cells that are alike, but for what stands in the cells, are one.
const MOST_ALIKE: usize = 4;

/// A place in a file; rows and columns from 1.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) struct FilePosition {
    /// Line.
    pub(super) row: Option<usize>,
    /// Field of the line.
    pub(super) column: Option<usize>,
}

impl FilePosition {
    /// The whole file.
    pub(super) const FILE: Self = Self { row: None, column: None };

    /// A line.
    pub(super) fn row(row: usize) -> Self {
        Self { row: Some(row), column: None }
    }
}

/// A field of a file with its place; the text is owned in a grid and borrowed from a line.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) struct Field<T = String> {
    /// As it is written.
    pub(super) text: T,
    /// Line, from 1; 0 where there is none.
    pub(super) row: usize,
    /// Field of the line, from 1; 0 where there is none.
    pub(super) column: usize,
}

impl<T> Field<T> {
    /// Where it stands.
    pub(super) fn place(&self) -> FilePosition {
        let known = |index: usize| Some(index).filter(|&index| index > 0);
        FilePosition { row: known(self.row), column: known(self.column) }
    }
}

impl Field {
    pub(super) fn trimmed(&self) -> &str {
        self.text.trim()
    }

    pub(super) fn is_blank(&self) -> bool {
        self.trimmed().is_empty()
    }

    /// The field that a cell was read from.
    pub(super) fn of_cell(cell: &Cell) -> Self {
        let written = cell.written.as_ref();
        written.map(|w| Self { text: w.text.clone(), row: w.row, column: w.column }).unwrap_or_default()
    }
}

/// A place, and what stands there where that is worth a quotation.
#[derive(Debug)]
pub(super) struct QuotedPosition<'t> {
    place: FilePosition,
    found: &'t str,
}

impl From<FilePosition> for QuotedPosition<'_> {
    fn from(place: FilePosition) -> Self {
        Self { place, found: "" }
    }
}

impl<'t> From<(FilePosition, &'t str)> for QuotedPosition<'t> {
    fn from((place, found): (FilePosition, &'t str)) -> Self {
        Self { place, found }
    }
}

impl<'t, T: AsRef<str>> From<&'t Field<T>> for QuotedPosition<'t> {
    fn from(field: &'t Field<T>) -> Self {
        Self { place: field.place(), found: field.text.as_ref() }
    }
}

impl<'t> From<Field<&'t str>> for QuotedPosition<'t> {
    fn from(field: Field<&'t str>) -> Self {
        Self { place: field.place(), found: field.text }
    }
}

/// A text as it is quoted in messages: never longer than a line, without control characters.
fn quoted(text: &str) -> String {
    let shown: String = text.trim().chars().map(|c| if c.is_control() { ' ' } else { c }).collect();
    if shown.chars().count() > 40 { shown.chars().take(37).chain("...".chars()).collect() } else { shown }
}

/// A message whose decimals are the shortest to 1e-9: 0.9144 for 0.9144000000000001.
fn shortened(message: &str) -> String {
    let mut out = String::with_capacity(message.len());
    for part in message.split_inclusive(|c: char| !c.is_ascii_digit() && c != '.') {
        let number = part.trim_end_matches(|c: char| !c.is_ascii_digit());
        let digits = number.split_once('.').map_or("", |(_, digits)| digits);
        match number.parse::<f64>() {
            Ok(value) if digits.len() > 9 => {
                let short = format!("{value:.9}");
                out += short.trim_end_matches('0').trim_end_matches('.');
                out += &part[number.len()..];
            }
            _ => out += part,
        }
    }
    out
}

/// Errors that are alike: how many, and the rows and columns from the first to the last.
#[derive(Debug, Clone, Copy)]
struct Alike {
    count: usize,
    rows: [usize; 2],
    columns: [usize; 2],
}

impl Alike {
    /// `40 cells in all, rows 2 to 21, columns 2 to 3`.
    fn words(&self) -> String {
        let range = |noun: &str, [first, last]: [usize; 2]| {
            if first == last { format!(", {noun} {first}") } else { format!(", {noun}s {first} to {last}") }
        };
        let rows = range("row", self.rows);
        match self.columns {
            [0, _] => format!("{} in all{rows}", counted(self.count, "row")),
            columns => format!("{} in all{rows}{}", counted(self.count, "cell"), range("column", columns)),
        }
    }

    fn join(&mut self, other: &Self) {
        let outer = |a: [usize; 2], b: [usize; 2]| [a[0].min(b[0]), a[1].max(b[1])];
        self.count += other.count;
        self.rows = outer(self.rows, other.rows);
        self.columns = outer(self.columns, other.columns);
    }
}

/// Code, message and remedy without their numbers.
type Cause = (&'static str, String, String);

fn cause(code: &'static str, message: &str, remedy: &str) -> Cause {
    let bare = |text: &str| text.chars().filter(|c| !c.is_ascii_digit() && !matches!(c, '.' | '-' | ',')).collect();
    (code, bare(message), bare(remedy))
}

/// Everything that was noticed while a table was read.
#[derive(Debug, Clone)]
pub(super) struct Problems {
    file: String,
    list: Vec<TableProblem>,
    alike: BTreeMap<Cause, Alike>,
    errors: usize,
    remarks: usize,
    /// Most digits after the decimal point of the lengths that were read from text.
    pub(super) decimals: usize,
}

impl Problems {
    pub(super) fn new(file: &str) -> Self {
        Self { file: file.to_owned(), list: Vec::new(), alike: BTreeMap::new(), errors: 0, remarks: 0, decimals: 0 }
    }

    /// An empty list about the same file.
    pub(super) fn alike(&self) -> Self {
        Self::new(&self.file)
    }

    /// Takes over what was noticed in another list.
    pub(super) fn absorb(&mut self, other: Self) {
        self.errors += other.errors;
        self.remarks += other.remarks;
        self.decimals = self.decimals.max(other.decimals);
        self.list.extend(other.list);
        for (key, alike) in other.alike {
            self.alike.entry(key).and_modify(|own| own.join(&alike)).or_insert(alike);
        }
    }

    /// Whether an error was noticed.
    pub(super) fn any_errors(&self) -> bool {
        self.errors > 0
    }

    fn push(
        &mut self,
        severity: Severity,
        code: &'static str,
        spot: QuotedPosition<'_>,
        message: String,
        remedy: &str,
    ) {
        if severity == Severity::Error && self.is_one_more(code, &spot, &message, remedy) {
            return;
        }
        let count = if severity == Severity::Error { &mut self.errors } else { &mut self.remarks };
        *count += 1;
        if *count > MOST_LISTED {
            return;
        }
        let QuotedPosition { place: FilePosition { row, column }, found } = spot;
        let (file, found, remedy, message) = (self.file.clone(), quoted(found), remedy.to_owned(), shortened(&message));
        self.list.push(TableProblem { severity, code, file, row, column, found, message, remedy });
    }

    /// Counts an error of a cell or a row; whether it is one more of many that are alike.
    fn is_one_more(&mut self, code: &'static str, spot: &QuotedPosition<'_>, message: &str, remedy: &str) -> bool {
        let Some(row) = spot.place.row.filter(|_| self.alike.len() <= MOST_LISTED) else { return false };
        let own = Alike { count: 1, rows: [row; 2], columns: [spot.place.column.unwrap_or(0); 2] };
        let alike = self.alike.entry(cause(code, message, remedy)).or_insert(Alike { count: 0, ..own });
        alike.join(&own);
        alike.count > MOST_ALIKE
    }

    /// Makes one error of many that are alike: the first, with the range of all.
    fn collapse(&mut self) {
        for (of, alike) in std::mem::take(&mut self.alike).into_iter().filter(|(_, alike)| alike.count > MOST_ALIKE) {
            let same = |p: &TableProblem| p.row.is_some() && cause(p.code, &p.message, &p.remedy) == of;
            let Some(mut first) = self.list.iter().find(|p| same(p)).cloned() else { continue };
            let before = self.list.len();
            self.list.retain(|p| !same(p));
            self.errors -= (before - self.list.len()).saturating_sub(1);
            first.message += &format!("; so are {}", alike.words());
            self.list.push(first);
        }
    }

    /// An error.
    pub(super) fn error<'t>(
        &mut self,
        code: &'static str,
        at: impl Into<QuotedPosition<'t>>,
        message: String,
        remedy: &str,
    ) {
        self.push(Severity::Error, code, at.into(), message, remedy);
    }

    /// Something that the reader of the table should know.
    pub(super) fn warning(&mut self, code: &'static str, at: FilePosition, message: String, remedy: &str) {
        self.push(Severity::Warning, code, at.into(), message, remedy);
    }

    /// Something that was detected.
    pub(super) fn note(&mut self, message: String) {
        self.push(Severity::Note, "N321", FilePosition::FILE.into(), message, "");
    }

    /// An error of another file, of the conventions beside the table.
    pub(super) fn error_in(&mut self, file: &str, at: &Field, message: String, remedy: &str) {
        let own = std::mem::replace(&mut self.file, file.to_owned());
        self.error("E311", at, message, remedy);
        self.file = own;
    }

    /// The errors in the order of rows and columns, with what was detected after them; or the remarks when there is no
    /// error.
    pub(super) fn finish(mut self) -> Result<Vec<TableProblem>, Vec<TableProblem>> {
        self.collapse();
        // What was detected helps to understand the errors; it comes after them.
        self.list.sort_by_key(|p| (p.severity, p.row.unwrap_or(0), p.column.unwrap_or(0)));
        for (severity, code, count) in
            [(Severity::Error, "E312", self.errors), (Severity::Warning, "W312", self.remarks)]
        {
            if count > MOST_LISTED {
                let file = self.file.clone();
                let message = format!("{} not shown", counted(count - MOST_LISTED, "more problem"));
                let (found, remedy) = (String::new(), String::new());
                let at = self.list.iter().position(|p| p.severity > severity).unwrap_or(self.list.len());
                let more = TableProblem { severity, code, file, row: None, column: None, found, message, remedy };
                self.list.insert(at, more);
            }
        }
        if self.errors == 0 { Ok(self.list) } else { Err(self.list) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn many_problems_are_counted() {
        let mut problems = Problems::new("a");
        for row in 0..1000 {
            problems.error("E321", (FilePosition::row(1000 - row), "x"), format!("bad {}", "x".repeat(row)), "");
            problems.warning("W332", FilePosition::row(row + 1), "odd".to_owned(), "");
        }
        let list = problems.finish().unwrap_err();
        let of = |severity: Severity| list.iter().filter(|p| p.severity == severity).collect::<Vec<_>>();
        let (errors, remarks) = (of(Severity::Error), of(Severity::Warning));
        assert_eq!((errors.len(), remarks.len()), (MOST_LISTED + 1, MOST_LISTED + 1));
        assert!(errors.windows(2).take(MOST_LISTED - 1).all(|pair| pair[0].row < pair[1].row));
        assert_eq!(
            (errors[MOST_LISTED].code, errors[MOST_LISTED].message.as_str()),
            ("E312", "900 more problems not shown")
        );
        assert_eq!(remarks[MOST_LISTED].code, "W312");
        assert_eq!(list.len(), 2 * MOST_LISTED + 2);
    }

    #[test]
    fn errors_that_are_alike_are_one() {
        let mut problems = Problems::new("a");
        for row in 2..30 {
            for column in 3..20 {
                problems.error("E301", &Field { text: format!("{row}"), row, column }, "bad".to_owned(), "Mend it");
            }
        }
        let list = problems.finish().unwrap_err();
        assert_eq!(list.len(), 1);
        let expected =
            "E301 a row 2, column 3: '2': bad; so are 476 cells in all, rows 2 to 29, columns 3 to 19. Mend it";
        assert_eq!(list[0].to_string(), expected);
    }

    #[test]
    fn quotations_are_short_and_of_one_line() {
        let mut problems = Problems::new("a");
        problems.error(
            "E301",
            &Field { text: format!(" a\tb{}", "c".repeat(80)), row: 2, column: 0 },
            String::new(),
            "",
        );
        let list = problems.finish().unwrap_err();
        assert_eq!((list[0].row, list[0].column), (Some(2), None));
        assert_eq!(list[0].found, format!("a b{}...", "c".repeat(34)));
    }
}
