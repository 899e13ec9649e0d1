//! Signs that part thousands: `1,500`, `1.500`, `1 500`, `1'500` for 1500.
//!
//! A comma or a point before three digits may be a decimal sign as well. It parts thousands where no number of the table
//! says otherwise and one proves it: by two such signs, by a decimal sign beside it, or by a line of numbers that is in
//! order only so.

use super::header::is_orderly;
use super::problem::{Field, FilePosition, Problems};
use super::settings::Settings;
use super::triples::are_digits;
use crate::units::{Notation, counted};

/// Signs that are never decimal ones.
const PLAIN: [char; 6] = [' ', '\u{a0}', '\u{202f}', '\u{2009}', '\'', '\u{2019}'];

/// Signs that may be.
const DECIMAL: [char; 2] = [',', '.'];

/// Numbers from this on are longer than any half-breadth in metres.
const LARGE: f64 = 121.0;

/// What stands around the number in a cell: brackets, signs and marks.
fn is_around(c: char) -> bool {
    matches!(c, '(' | ')' | '-' | '+' | '!' | 'K' | 'T' | '\u{2212}' | '?')
}

/// A number whose thousands are parted by a sign.
#[derive(Debug, Clone, PartialEq)]
struct Grouped {
    /// Without the sign.
    text: String,
    /// Whether it can be nothing else: two signs, or a decimal sign of the other kind.
    proves: bool,
}

fn grouped(text: &str, sign: char) -> Option<Grouped> {
    let core = text.trim().trim_matches(is_around);
    let decimal = core.rfind(|c| DECIMAL.contains(&c) && c != sign);
    let (whole, rest) = core.split_at(decimal.unwrap_or(core.len()));
    let mut groups = whole.split(sign);
    let first = groups.next()?;
    let groups: Vec<&str> = groups.collect();
    let good = are_digits(first)
        && first.len() <= 3
        && !first.starts_with('0')
        && !groups.is_empty()
        && groups.iter().all(|group| group.len() == 3 && are_digits(group))
        && (rest.is_empty() || are_digits(&rest[1..]));
    let without = core.replace(sign, "");
    good.then(|| Grouped { text: text.replacen(core, &without, 1), proves: groups.len() > 1 || !rest.is_empty() })
}

/// Whether a field is one number with this sign inside it.
fn has_inside(field: &Field, sign: char) -> bool {
    let core = field.trimmed().trim_matches(is_around);
    core.contains(sign)
        && core.starts_with(|c: char| c.is_ascii_digit())
        && core.chars().all(|c| c.is_ascii_digit() || c == sign || DECIMAL.contains(&c))
}

fn plain(field: &Field) -> Option<f64> {
    field.trimmed().parse().ok().filter(|_| are_digits(field.trimmed()))
}

/// Whether a line of numbers, without its head, is in order only where the sign parts thousands.
fn proves_by_order(line: &[&Field], sign: char) -> bool {
    let numbers: Vec<(f64, f64)> = line
        .iter()
        .filter_map(|field| match grouped(&field.text, sign) {
            Some(whole) => {
                let decimal = field.trimmed().replace(sign, ".").parse().ok()?;
                Some((whole.text.trim().parse().ok()?, decimal))
            }
            None => plain(field).map(|number| (number, number)),
        })
        .collect();
    let (whole, decimal): (Vec<f64>, Vec<f64>) = numbers.into_iter().unzip();
    let mixed = line.iter().any(|field| plain(field).is_some_and(|n| n >= 100.0));
    mixed
        && line.iter().any(|field| grouped(&field.text, sign).is_some())
        && is_orderly(&whole)
        && !is_orderly(&decimal)
}

/// Whether a comma or a point parts thousands, and whether that is beyond doubt.
fn parts(rows: &[Vec<Field>], sign: char, in_millimetres: bool) -> Option<bool> {
    let with: Vec<&Field> = rows.iter().flatten().filter(|field| has_inside(field, sign)).collect();
    let all: Option<Vec<Grouped>> = with.iter().map(|field| grouped(&field.text, sign)).collect();
    let all = all.filter(|all| !all.is_empty())?;
    let others = DECIMAL.into_iter().filter(|other| *other != sign);
    let decimal = others.into_iter().any(|other| rows.iter().flatten().any(|field| has_inside(field, other)));
    if decimal || all.iter().any(|number| number.proves) {
        return Some(true);
    }
    let width = rows.iter().map(Vec::len).max().unwrap_or(0);
    let by_row = rows.iter().map(|row| row.iter().skip(1).collect::<Vec<_>>());
    let by_column = (0..width).map(|j| rows.iter().filter_map(|row| row.get(j)).skip(1).collect::<Vec<_>>());
    let ordered = by_row.clone().chain(by_column).any(|line| proves_by_order(&line, sign));
    let is_grouped = |field: &&&Field| grouped(&field.text, sign).is_some();
    let is_large = |field: &&Field| plain(field).is_some_and(|number| number >= LARGE);
    let beside = by_row.clone().any(|row| row.iter().any(|f| is_grouped(&f)) && row.iter().any(is_large));
    let body = || rows.iter().skip(1).flat_map(|row| row.iter().skip(1));
    let over_millimetres = in_millimetres && !body().any(|f| is_grouped(&&f)) && body().any(|f| is_large(&f));
    (ordered || beside || over_millimetres).then_some(false)
}

/// Takes signs between thousands out of the numbers of a table.
pub(super) fn settle(rows: &mut [Vec<Field>], separator: char, settings: &Settings, problems: &mut Problems) {
    let mut found: Vec<(char, bool)> = Vec::new();
    for sign in PLAIN.into_iter().filter(|sign| *sign != separator) {
        let mut with = rows.iter().flatten().filter(|field| has_inside(field, sign)).peekable();
        if with.peek().is_some() && with.all(|field| grouped(&field.text, sign).is_some()) {
            found.push((sign, true));
        }
    }
    let says = |field: &Field| field.text.split(|c: char| !c.is_alphabetic()).any(|word| word == "mm");
    let in_millimetres = settings.units == Some(Notation::Millimetres) || rows.iter().flatten().any(says);
    for sign in DECIMAL {
        let stated = settings.decimal_comma.is_some_and(|comma| comma == (sign == ','));
        if let Some(sure) = parts(rows, sign, in_millimetres).filter(|_| !stated) {
            found.push((sign, sure));
        }
    }
    for (sign, sure) in found {
        let mut count = 0;
        let mut first = String::new();
        for field in rows.iter_mut().flatten() {
            if has_inside(field, sign)
                && let Some(number) = grouped(&field.text, sign)
            {
                if count == 0 {
                    first = format!("'{}' is {}", field.trimmed(), number.text.trim());
                }
                count += 1;
                field.text = number.text;
            }
        }
        let message = format!("thousands are parted by '{sign}' in {}: {first}", counted(count, "number"));
        if sure {
            problems.note(message);
        } else {
            let word = if sign == ',' { "\",\"" } else { "\".\"" };
            let remedy = format!("Give decimal = {word} in the conventions where it is a decimal sign");
            problems.warning("W320", FilePosition::FILE, message, &remedy);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn settled(text: &str, settings: &Settings) -> (String, usize) {
        let field = |row: usize, (k, text): (usize, &str)| Field { text: text.to_owned(), row, column: k + 1 };
        let mut rows: Vec<Vec<Field>> = text
            .split('|')
            .enumerate()
            .map(|(row, line)| line.split(';').enumerate().map(|part| field(row + 1, part)).collect())
            .collect();
        let mut problems = Problems::new("table.csv");
        settle(&mut rows, ';', settings, &mut problems);
        let texts: Vec<String> =
            rows.iter().map(|row| row.iter().map(|f| f.text.as_str()).collect::<Vec<_>>().join(";")).collect();
        (texts.join("|"), problems.finish().unwrap().len())
    }

    #[test]
    fn thousands_that_are_proved() {
        let settings = Settings::default();
        for (text, read) in [
            ("z;0;750;1,500;2,250|0;0;900;980;1,010", "z;0;750;1500;2250|0;0;900;980;1010"),
            ("z;0;750;1.500|0;0;900;1.010", "z;0;750;1500|0;0;900;1010"),
            ("z;0;1 500|0;0;(12 345K)", "z;0;1500|0;0;(12345K)"),
            ("z;0;1,234.5|0;0;900", "z;0;1234.5|0;0;900"),
            ("x [mm];0;750|5,000;0;8000|10,000;0;8500", "x [mm];0;750|5000;0;8000|10000;0;8500"),
        ] {
            assert_eq!(settled(text, &settings), (read.to_owned(), 1), "{text}");
        }
    }

    #[test]
    fn decimals_stay() {
        let settings = Settings::default();
        for text in [
            "z;0;1,500;3,000|0;0;2,250;4,125",
            "z;0,750;1,500|0;0;2,250",
            "x;1.500;3.000|0;1.250;4.125|140;3.125;5.250",
            "station;1.500;3.000|3;1.125;2.250|4;2.125;3.250",
            "z;1 1/2;2 500 3|0;1;2",
        ] {
            assert_eq!(settled(text, &settings), (text.to_owned(), 0), "{text}");
        }
        let stated = Settings { decimal_comma: Some(true), ..Settings::default() };
        let text = "z;0;750;1,500|0;0;900;1,010";
        assert_eq!(settled(text, &stated).0, text);
    }
}
