//! Feet, inches and eighths with other signs between them than dashes: `1.2.3`, `1 2 3`, `1/2/3`, `1:2:3`.
//!
//! One cell alone may be a slip of the pen. The whole table decides, and its cells are read as `1-2-3`.

use std::collections::BTreeSet;

use super::header::begins_as_number;
use super::problem::{Field, FilePosition, Problems};
use crate::units::counted;

/// Signs between feet, inches and eighths.
const SIGNS: [char; 4] = ['.', ' ', '/', ':'];
/// Vulgar fractions of an inch.
const FRACTIONS: [char; 7] = ['\u{bd}', '\u{bc}', '\u{be}', '\u{215b}', '\u{215c}', '\u{215d}', '\u{215e}'];
/// Fewer cells prove no notation.
const LEAST: usize = 3;

/// What stands around the number in a cell: brackets, signs and marks.
fn is_around(c: char) -> bool {
    matches!(c, '(' | ')' | '-' | '+' | '!' | 'K' | 'T' | ' ' | '\u{bd}')
}

/// The cell with dashes, when it has three whole numbers with this sign between them.
fn dashed(text: &str, sign: char) -> Option<String> {
    let core = text.trim_matches(is_around);
    let parts: Vec<&str> = core.split(sign).filter(|part| sign != ' ' || !part.is_empty()).collect();
    let whole = |part: &&str| (1..=3).contains(&part.len()) && part.bytes().all(|b| b.is_ascii_digit());
    (parts.len() == 3 && parts.iter().all(whole)).then(|| text.replacen(core, &parts.join("-"), 1))
}

fn is_decimal(field: &Field) -> bool {
    field.text.contains('.') && field.trimmed().parse::<f64>().is_ok()
}

/// `2-3` for 2-3-0 where other cells of the table have feet and inches with a fraction, as `2-3 1/2`; and the fraction before
/// the sign of inches where it stands behind it.
fn fractions(rows: &mut [Vec<Field>], problems: &mut Problems) {
    let is_fraction = |text: &str| {
        text.ends_with(FRACTIONS) || text.split_once('/').is_some_and(|(a, b)| are_digits(a) && are_digits(b))
    };
    let parts = |text: &str| -> Option<(String, String)> {
        let (feet, inches) = text.trim().trim_matches(is_around_fraction).split_once('-')?;
        Some((feet.to_owned(), inches.trim().to_owned()))
    };
    let with = |text: &str| {
        parts(text).is_some_and(|(feet, inches)| {
            let inner = inches
                .split_once(' ')
                .map_or_else(|| inches.ends_with(FRACTIONS), |(whole, rest)| are_digits(whole) && is_fraction(rest));
            are_digits(&feet) && inner
        })
    };
    let without =
        |text: &str| parts(text).filter(|(feet, inches)| are_digits(feet) && are_digits(inches) && inches.len() < 3);
    for field in rows.iter_mut().flatten() {
        if let Some((before, after)) = field.text.split_once('"')
            && is_fraction(after.trim())
            && before.ends_with(|c: char| c.is_ascii_digit())
        {
            field.text = format!("{before} {}\"", after.trim());
        }
    }
    let head = rows.iter().position(|row| !row.is_empty()).map_or(0, |at| at + 1);
    if rows.iter().skip(head).flatten().filter(|field| with(&field.text)).count() < LEAST {
        return;
    }
    let mut count = 0;
    for field in rows.iter_mut().skip(head).flatten() {
        if let Some((feet, inches)) = without(&field.text) {
            let core = format!("{feet}-{inches}");
            field.text = field.text.replacen(&core, &format!("{core}-0"), 1);
            count += 1;
        }
    }
    if count > 0 {
        problems.note(format!(
            "{} of feet and inches alone among others with fractions: read as such",
            counted(count, "cell")
        ));
    }
}

pub(super) fn are_digits(text: &str) -> bool {
    !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit())
}

fn is_around_fraction(c: char) -> bool {
    matches!(c, '(' | ')' | '!' | 'K' | 'T')
}

/// `1-10` for 1-10-0 where all numbers of a table are written so: feet and inches.
fn feet_and_inches(rows: &mut [Vec<Field>], problems: &mut Problems) {
    let is_pair = |text: &str| {
        let parts = text.trim().trim_start_matches('-').trim_matches(is_around_fraction).split_once('-');
        let inches = |text: &str| text.len() < 3 && text.parse::<u32>().is_ok_and(|inches| inches < 12);
        parts.is_some_and(|(feet, rest)| are_digits(feet) && are_digits(rest) && feet.len() < 4 && inches(rest))
    };
    let head = rows.iter().position(|row| !row.is_empty()).map_or(0, |at| at + 1);
    let cells =
        || rows.iter().skip(head).flat_map(|row| row.iter().skip(1)).filter(|field| begins_as_number(&field.text));
    let count = cells().filter(|field| is_pair(&field.text)).count();
    let Some(first) = cells().find(|field| is_pair(&field.text)).cloned() else { return };
    if count < LEAST * LEAST || cells().count() > count {
        return;
    }
    for field in rows.iter_mut().skip(head).flat_map(|row| row.iter_mut().skip(1)).filter(|field| is_pair(&field.text))
    {
        let core = field.text.trim().trim_matches(is_around_fraction).to_owned();
        field.text = field.text.replacen(&core, &format!("{core}-0"), 1);
    }
    let message = format!("{} as '{}': read as feet and inches", counted(count, "cell"), first.trimmed());
    problems.warning("W320", FilePosition::FILE, message, "Write 1-10-0 for 1 ft 10 in");
}

/// Gives the cells dashes where most cells of the table have three numbers with another sign between them.
pub(super) fn settle(rows: &mut [Vec<Field>], problems: &mut Problems) {
    fractions(rows, problems);
    feet_and_inches(rows, problems);
    let Some(head) = rows.iter().position(|row| !row.is_empty()) else { return };
    let of = |sign: char| rows.iter().flatten().filter(move |field| dashed(&field.text, sign).is_some());
    let Some((count, sign)) = SIGNS.map(|sign| (of(sign).count(), sign)).into_iter().max_by_key(|(count, _)| *count)
    else {
        return;
    };
    let Some(first) = of(sign).next().cloned() else { return };
    let decimals = rows.iter().skip(head + 1).flatten().filter(|field| is_decimal(field)).count();
    if count < LEAST || sign == '.' && count <= decimals {
        return;
    }
    let message = format!(
        "{} as '{}': read as feet, inches and eighths of an inch ({})",
        counted(count, "cell"),
        first.trimmed(),
        dashed(&first.text, sign).unwrap_or_default().trim()
    );
    if sign == '.' {
        problems.warning("W320", FilePosition::FILE, message, "Write 1-2-3 for 1 ft 2 3/8 in");
    } else {
        problems.note(message);
    }
    let columns: BTreeSet<usize> = of(sign).map(|field| field.column).collect();
    for field in rows.iter_mut().skip(head).flatten() {
        if let Some(text) = dashed(&field.text, sign) {
            field.text = text;
        }
    }
    for field in rows.iter().skip(head + 1).flat_map(|row| row.iter().skip(1)) {
        if sign == '.' && is_decimal(field) && columns.contains(&field.column) {
            let message = "two numbers among feet, inches and eighths: feet and inches, or a decimal number".to_owned();
            problems.error("E301", field, message, "Write 1-2-0 for 1 ft 2 in, or 1.2 ft");
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn settled(text: &str) -> (Vec<String>, usize, bool) {
        let field = |(k, text): (usize, &str)| Field { text: text.to_owned(), row: 1, column: k + 1 };
        let mut rows: Vec<Vec<Field>> =
            text.lines().map(|line| line.split(',').enumerate().map(field).collect()).collect();
        let mut problems = Problems::new("t");
        settle(&mut rows, &mut problems);
        let texts = rows.into_iter().skip(1).flatten().map(|field| field.text).collect();
        let list = problems.finish();
        let any = list.is_err();
        (texts, list.unwrap_or_else(|list| list).len(), any)
    }

    #[test]
    fn the_whole_table_decides() {
        assert_eq!(settled("x,1\n0,1.2.3\n1,(1.2.4K)\n2,-1.10.7+").0, ["0", "1-2-3", "1", "(1-2-4K)", "2", "-1-10-7+"]);
        assert_eq!(settled("x,1\n0,1 2 3\n1,1  2 4\n2,1 10 7\u{bd}").0[5], "1-10-7\u{bd}");
        assert_eq!(settled("x,1\n0,1/2/3\n1,1/2/4\n2,1/10/7").0[5], "1-10-7");
        let inches = "x,1,2,3\n0,1-2,1-3,1-4\n1,1-6,(1-7),1-11K\n2,2-0,2-1,0-2";
        assert_eq!(settled(inches).0[6..8], ["(1-7-0)", "1-11-0K"]);
        // A slip of the pen, and versions or dates.
        for text in [
            "x,1\n0,1.2.3\n1,1.2\n2,3.4",
            "x,1\n0,3/4/2005\n1,3/5/2005\n2,3/6/2005",
            "x,1\n0,1 2\n1,2 3\n2,3 4",
            "x,1,2,3\n0,1-2,1-3,1-4\n1,1-6,1-7,1-14\n2,2-0,2-1,0.2",
        ] {
            assert_eq!((settled(text).1, settled(text).2), (0, false), "{text}");
        }
        assert!(settled("x,1\n0,1.2.3\n1,1.2.4\n2,1.10.7\n3,1.2").2);
    }
}
