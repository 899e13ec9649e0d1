//! What a workbook shows beside its values: units and words of number formats, and which rows and columns it hides.

use std::collections::{BTreeMap, BTreeSet};
use std::io::{Cursor, Read as _};

use zip::ZipArchive;

use super::grid::Grid;
use super::header::axis_of;
use super::xlsx::MOST_UNPACKED;
use crate::units::Notation;

/// Words that a number format shows around a number: `0.00" m"`, `"Fr "0`.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Around {
    /// A word for lines in front of it.
    before: Option<String>,
    unit: Option<Notation>,
    /// What the number is divided by before it is shown.
    divisor: f64,
}

impl Around {
    /// Of the code of a format; none where it shows nothing that counts.
    pub(super) fn of(code: &str) -> Option<Self> {
        let [before, after, commas] = parts(code)?;
        let unit = match after.trim().trim_matches(['[', ']', '(', ')']) {
            "'" | "\u{2032}" => Some(Notation::Feet),
            "\"" | "\u{2033}" => Some(Notation::Inches),
            word => Notation::from_word(word),
        };
        let before = Some(before.trim().to_owned()).filter(|word| axis_of(word).is_some());
        let thousands = i32::try_from(commas.len()).unwrap_or(0);
        (unit.is_some() || before.is_some()).then(|| Self { before, unit, divisor: 1000_f64.powi(thousands) })
    }

    /// A value as it is shown, with all its digits.
    pub(super) fn text(&self, value: f64) -> String {
        let before = self.before.as_ref().map_or(String::new(), |word| format!("{word} "));
        let unit = self.unit.map_or(String::new(), |unit| format!(" {}", unit.as_str()));
        format!("{before}{}{unit}", value / self.divisor)
    }
}

/// The words before and after the digits of the first section of a format, and the commas at their end; none for per cent.
fn parts(code: &str) -> Option<[String; 3]> {
    let [mut before, mut after, mut commas] = [const { String::new() }; 3];
    let mut has_digits = false;
    let mut chars = code.chars();
    while let Some(c) = chars.next() {
        let mut literal = String::new();
        match c {
            ';' => break,
            '%' => return None,
            '"' => literal.extend(chars.by_ref().take_while(|c| *c != '"')),
            '\\' => literal.extend(chars.next()),
            '[' => chars.by_ref().take_while(|c| *c != ']').for_each(drop),
            '_' | '*' => {
                chars.next();
            }
            '0' | '#' | '?' => {
                has_digits = true;
                commas.clear();
            }
            ',' if has_digits => commas.push(','),
            ' ' | '\'' => literal.push(c),
            _ => {}
        }
        (if has_digits { &mut after } else { &mut before }).push_str(&literal);
    }
    has_digits.then_some([before, after, commas])
}

/// Rows and columns that a sheet hides, from 1.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Hidden {
    rows: BTreeSet<usize>,
    columns: Vec<[usize; 2]>,
}

impl Hidden {
    /// Whether a cell is in a hidden row; whether it is in a hidden column.
    pub(super) fn hides(&self, row: usize, column: usize) -> [bool; 2] {
        [self.rows.contains(&row), self.columns.iter().any(|[from, to]| (*from..=*to).contains(&column))]
    }

    /// Takes hidden columns out of a grid, and what merged cells leave in hidden rows; places stay those of the sheet.
    pub(super) fn take_out(&self, grid: &mut Grid) {
        for (index, row) in grid.rows.iter_mut().enumerate() {
            if self.rows.contains(&(index + 1)) {
                row.clear();
            }
            row.retain(|field| !self.hides(0, field.column)[1]);
        }
    }

    fn of(sheet: &str) -> Self {
        let mut hidden = Self::default();
        let mut row = 0;
        for tag in tags(sheet) {
            let number = |key: &str| attribute(tag, key).and_then(|value| value.parse::<usize>().ok());
            let is_hidden = attribute(tag, "hidden").is_some_and(|value| matches!(value, "1" | "true"));
            match name(tag) {
                "row" => {
                    row = number("r").unwrap_or(row + 1);
                    hidden.rows.extend(is_hidden.then_some(row));
                }
                "col" if is_hidden => hidden.columns.extend(number("min").zip(number("max")).map(|(a, b)| [a, b])),
                _ => {}
            }
        }
        hidden
    }
}

/// What the sheets of a workbook hide, by their names; what cannot be read hides nothing.
pub(super) fn hidden(bytes: &[u8]) -> BTreeMap<String, Hidden> {
    let Ok(mut archive) = ZipArchive::new(Cursor::new(bytes)) else { return BTreeMap::new() };
    let mut part = |name: &str| {
        let mut text = String::new();
        archive.by_name(name).ok()?.take(MOST_UNPACKED).read_to_string(&mut text).ok()?;
        Some(text)
    };
    let (Some(book), Some(links)) = (part("xl/workbook.xml"), part("xl/_rels/workbook.xml.rels")) else {
        return BTreeMap::new();
    };
    let link = |tag: &str| {
        let target = attribute(tag, "Target")?;
        let path = target.strip_prefix('/').map_or_else(|| format!("xl/{target}"), str::to_owned);
        Some((attribute(tag, "Id")?.to_owned(), path))
    };
    let links: BTreeMap<String, String> = tags(&links).filter_map(link).collect();
    let sheets = tags(&book).filter(|tag| name(tag) == "sheet");
    let found = sheets.filter_map(|tag| {
        let text = part(links.get(attribute(tag, "id")?)?)?;
        Some((unescaped(attribute(tag, "name")?), Hidden::of(&text)))
    });
    found.collect()
}

/// The opening tags of a text of XML, without their brackets.
fn tags(text: &str) -> impl Iterator<Item = &str> {
    let tags = text.split('<').skip(1).filter(|part| !part.starts_with('/'));
    tags.map(|part| part.split('>').next().unwrap_or(part))
}

/// The name of a tag without its space.
fn name(tag: &str) -> &str {
    let whole = tag.split([' ', '\t', '\r', '\n', '/']).find(|word| !word.is_empty()).unwrap_or("");
    whole.rsplit(':').next().unwrap_or(whole)
}

/// The value of an attribute by its name without its space.
fn attribute<'t>(tag: &'t str, key: &str) -> Option<&'t str> {
    let mut rest = tag;
    while let Some((before, after)) = rest.split_once('=') {
        let quote = after.trim_start().chars().next().filter(|c| matches!(c, '"' | '\''))?;
        let (value, behind) = after.trim_start()[1..].split_once(quote)?;
        if before.trim_end().rsplit([' ', '\t', '\r', '\n', ':']).next() == Some(key) {
            return Some(value);
        }
        rest = behind;
    }
    None
}

/// A text with its five entities as signs.
fn unescaped(text: &str) -> String {
    let entities = [("&lt;", "<"), ("&gt;", ">"), ("&quot;", "\""), ("&apos;", "'"), ("&amp;", "&")];
    entities.iter().fold(text.to_owned(), |text, (entity, sign)| text.replace(entity, sign))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_of_number_formats() {
        for (code, value, text) in [
            ("0.00\" ft\"", 1.5, "1.5 ft"),
            ("0.000\\ \\m", 1.5, "1.5 m"),
            ("#,##0\\ \"mm\"", 1500.0, "1500 mm"),
            ("0.000,\" m\"", 1500.0, "1.5 m"),
            ("0.00\"'\";-0.00\"'\"", 2.0, "2 ft"),
            ("\"Fr \"0", 5.0, "Fr 5"),
            ("\"WL \"0.00\" m\"", 1.5, "WL 1.5 m"),
        ] {
            assert_eq!(Around::of(code).map(|around| around.text(value)).as_deref(), Some(text), "{code}");
        }
        for code in ["General", "0.000", "0.0%\" m\"", "0.0\" m2\"", "yyyy\\-mm\\-dd", "#,##0\\ [$\u{20ac}-407]"] {
            assert_eq!(Around::of(code), None, "{code}");
        }
    }

    #[test]
    fn hidden_rows_and_columns() {
        let sheet = r#"<x:cols><x:col min="3" max="4" width="9" hidden="1"/><x:col min="6" max="6"/></x:cols>
            <x:row r="2" hidden="true"><x:c r="A2"/></x:row><x:row hidden='1'/><x:row r="9" hidden="0"/>"#;
        let hidden = Hidden::of(sheet);
        assert_eq!(hidden, Hidden { rows: [2, 3].into(), columns: vec![[3, 4]] });
        assert_eq!(
            (hidden.hides(2, 1), hidden.hides(1, 4), hidden.hides(9, 6)),
            ([true, false], [false, true], [false; 2])
        );
    }
}
