//! What a cell of a table of offsets says: a length in any notation, and marks.
//!
//! Grammar, in the order in which it is looked at:
//!
//! | written | means |
//! |---|---|
//! | blank, `-`, `*` | there is no hull here |
//! | `?` | there is a hull, its offset is not known |
//! | `6.41`, `6410`, `-0.25` | a number in the unit of the table |
//! | `6,41` | the same, where the table has decimal commas |
//! | `3-4-5`, `3-4-5+`, `3-4-5-`, `-0-3-4` | feet, inches, eighths; `+` and `-` a sixteenth of an inch more or less |
//! | `3,4,5` | feet, inches, eighths with commas |
//! | `3' 4 5/8"`, `3'-4 5/8"`, `3′ 4⅝″`, `3-4 5/8` | feet, inches and a fraction |
//! | `6.41 m`, `32 in` | a number with its unit |
//! | `(6.41)` | doubtful |
//! | `6.41!` | locked |
//! | `6.41K`, `6.41T` | on a knuckle, on a tangent line (edge of a flat of side or bottom) |
//!
//! Marks may be combined and stand inside or outside the brackets: `(3-4-5+K)`, `6.41TK!`. Nothing that is not finite is
//! ever a value. Cost: one pass over the text, no allocation for plain numbers.

use super::notation::Notation;
use super::quantity::{Dimension, UnitError, before_half, keyed, parse};

/// The longest cell that is looked at \[bytes\].
pub const LONGEST_CELL: usize = 80;

/// What a cell says about the hull.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum CellEntry {
    /// There is no hull here.
    Absent,
    /// There is a hull, and its offset is not known.
    Unknown,
    /// A length \[m\].
    Length(f64),
}

/// How the length of a cell is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CellWriting {
    /// A plain number with so many digits after the decimal sign; its unit is that of the table.
    Plain {
        /// Digits after the decimal sign.
        decimals: usize,
    },
    /// Feet, inches, eighths, or feet and inches with a fraction.
    Eighths,
    /// With its own unit.
    WithUnit,
    /// No length is written.
    Nothing,
}

/// A cell as it was understood.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CellReading {
    /// What it says.
    pub entry: CellEntry,
    /// How it is written.
    pub writing: CellWriting,
    /// `(...)`.
    pub doubtful: bool,
    /// `!`.
    pub locked: bool,
    /// `K`.
    pub knuckle: bool,
    /// `T`.
    pub tangent: bool,
}

/// How the cells of one table are to be understood.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct CellRules {
    /// The unit of plain numbers.
    pub unit: Notation,
    /// Whether `6,41` is 6.41.
    pub decimal_comma: bool,
}

/// Why a text is no cell.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum CellError {
    /// Inches or eighths beyond their range.
    #[error("{what} are 0 to {largest}")]
    Range {
        /// `inches` or `eighths`.
        what: &'static str,
        /// The largest number that may stand there.
        largest: u32,
        /// What may have been meant.
        meant: Vec<String>,
    },
    /// `6,41` where the table has no decimal commas.
    #[error("a decimal comma in a table of decimal points")]
    DecimalComma {
        /// With a point.
        meant: String,
    },
    /// Both doubtful and locked.
    #[error("an offset cannot be doubtful, in brackets, and locked, with '!'")]
    DoubtfulAndLocked,
    /// Two parts, as `3-4`.
    #[error("two numbers with a dash are no length")]
    TwoParts {
        /// With eighths.
        meant: String,
    },
    /// Brackets that are not closed.
    #[error("the bracket is not closed")]
    Bracket,
    /// Marks on a cell that says that there is no hull.
    #[error("a mark without an offset")]
    MarkAlone,
    /// Longer than [`LONGEST_CELL`].
    #[error("{0} characters; a cell has at most {LONGEST_CELL}")]
    TooLong(usize),
    /// Anything else.
    #[error("not a number, a length or one of - * ?")]
    Text,
    /// A quantity with something wrong.
    #[error(transparent)]
    Quantity(#[from] UnitError),
}

impl CellError {
    /// The likely remedy; empty when the message says it.
    #[must_use]
    pub fn remedy(&self) -> String {
        match self {
            Self::Range { meant, .. } if !meant.is_empty() => format!("Did you mean {}?", meant.join(" or ")),
            Self::DecimalComma { meant } | Self::TwoParts { meant } => format!("Did you mean {meant}?"),
            Self::DoubtfulAndLocked => "Take away the brackets or the '!'.".to_owned(),
            Self::Bracket => "Write (6.41).".to_owned(),
            Self::MarkAlone => "Write the offset before the mark, or ? where it is not known.".to_owned(),
            Self::Text => {
                "Leave the cell empty where there is no hull; write ? where the offset is not known.".to_owned()
            }
            _ => String::new(),
        }
    }
}

/// A plain decimal number, `-12.50` or `1e-3`, with its digits after the decimal sign.
fn plain(text: &str, decimal_comma: bool) -> Option<(f64, usize)> {
    let body = text.strip_prefix(['-', '+']).unwrap_or(text);
    let sign = if decimal_comma { ',' } else { '.' };
    let mantissa = body.find(['e', 'E']).map_or(body, |at| &body[..at]);
    let (whole, fraction) = mantissa.split_once(sign).unwrap_or((mantissa, ""));
    let digits = |part: &str| part.bytes().all(|b| b.is_ascii_digit());
    if whole.len() + fraction.len() == 0 || !digits(whole) || !digits(fraction) {
        return None;
    }
    // The rest, the exponent, is left to the parser of the standard library; words like `inf` do not come so far.
    let value: f64 = if decimal_comma { text.replace(',', ".").parse().ok()? } else { text.parse().ok()? };
    value.is_finite().then_some((value, fraction.len()))
}

/// What `3-11-9` or `3-12-4` may have been meant to be.
fn meant(text: &str, separator: char) -> Vec<String> {
    let (sign, body) = text.strip_prefix('-').map_or(("", text), |rest| ("-", rest));
    let (body, tick) = match body.strip_suffix(['+', '-']) {
        Some(rest) => (rest, &body[rest.len()..]),
        None => (body, ""),
    };
    let parts: Vec<u32> = body.split(separator).filter_map(|part| part.parse().ok()).collect();
    let [feet, inches, eighths] = parts[..] else { return Vec::new() };
    let shown = |f: u32, i: u32, e: u32| format!("{sign}{f}{separator}{i}{separator}{e}{tick}");
    let mut list = Vec::new();
    let mut add = |text: String| {
        if !list.contains(&text) {
            list.push(text);
        }
    };
    if inches <= 11 && eighths <= 9 {
        // A nought that lost its curve, or eighths carried over.
        add(shown(feet, inches, 0));
        let sum = inches + eighths / 8;
        add(shown(feet.saturating_add(sum / 12), sum % 12, eighths % 8));
    } else if inches <= 23 && eighths <= 7 {
        add(shown(feet.saturating_add(1), inches - 12, eighths));
        if inches <= 19 {
            add(shown(feet, inches % 10, eighths));
        }
    }
    list
}

/// Feet, inches and eighths with dashes or commas, when the text looks like them.
fn eighths(text: &str, separator: char) -> Option<Result<f64, CellError>> {
    let body = text.strip_prefix('-').unwrap_or(text);
    let body = body.strip_suffix(['+', '-']).unwrap_or(body);
    let mut parts = 0;
    let half = before_half(body);
    for part in half.unwrap_or(body).split(separator).map(str::trim) {
        if part.is_empty() || !part.bytes().all(|b| b.is_ascii_digit()) {
            return None;
        }
        parts += 1;
    }
    if parts == 2 && separator == '-' && half.is_none() {
        return Some(Err(CellError::TwoParts { meant: format!("{body}-0") }));
    }
    if parts != 3 {
        return None;
    }
    let dashed = if separator == '-' { text.to_owned() } else { text.replace(separator, "-") };
    Some(match parse(&dashed) {
        Ok(measure) => Ok(measure.value),
        Err(UnitError::Range { what, largest, .. }) => {
            Err(CellError::Range { what, largest, meant: meant(text, separator) })
        }
        Err(error) => Err(CellError::Quantity(error)),
    })
}

/// Whether a length is in feet with inches, or in the marks of either.
fn is_imperial(text: &str) -> bool {
    let words = text.split(|c: char| !c.is_ascii_alphabetic()).filter(|word| !word.is_empty());
    text.contains(['\'', '"']) || words.count() != 1
}

/// The length \[m\] of a text without marks.
fn length(text: &str, rules: CellRules) -> Result<(f64, CellWriting), CellError> {
    if let Some((number, decimals)) = plain(text, rules.decimal_comma).or_else(|| plain(text, false)) {
        let value = rules.unit.metres(number);
        return Ok((value, CellWriting::Plain { decimals }));
    }
    for separator in ['-', ','] {
        if let Some(found) = eighths(text, separator) {
            return found.map(|value| (value, CellWriting::Eighths));
        }
    }
    let with_points = if rules.decimal_comma { text.replace(',', ".") } else { text.to_owned() };
    if !rules.decimal_comma && plain(text, true).is_some() {
        return Err(CellError::DecimalComma { meant: text.replace(',', ".") });
    }
    if !text.bytes().any(|b| b.is_ascii_digit()) {
        return Err(CellError::Text);
    }
    match parse(&with_points) {
        Ok(measure) => match measure.dimension {
            Dimension::None => Ok((rules.unit.metres(measure.value), CellWriting::WithUnit)),
            Dimension::Length if is_imperial(text) => Ok((measure.value, CellWriting::Eighths)),
            Dimension::Length => Ok((measure.value, CellWriting::WithUnit)),
            other => Err(UnitError::Kind { text: text.to_owned(), found: other.as_str(), expected: "a length" }.into()),
        },
        Err(UnitError::Number(_)) => Err(CellError::Text),
        Err(error) => Err(error.into()),
    }
}

/// What a cell says.
///
/// # Errors
/// [`CellError`] when it says nothing that a table of offsets can hold.
pub fn parse_cell(text: &str, rules: CellRules) -> Result<CellReading, CellError> {
    let mut reading = CellReading {
        entry: CellEntry::Absent,
        writing: CellWriting::Nothing,
        doubtful: false,
        locked: false,
        knuckle: false,
        tangent: false,
    };
    let text = text.trim();
    if text.len() > LONGEST_CELL {
        return Err(CellError::TooLong(text.chars().count()));
    }
    let keyed = keyed(text);
    if matches!(keyed.as_ref(), "" | "-" | "*") {
        return Ok(reading);
    }
    let mut rest = keyed.as_ref();
    loop {
        if let Some(before) = rest.strip_suffix('!') {
            reading.locked = true;
            rest = before.trim_end();
        } else if let Some(before) = rest.strip_suffix(['K', 'T'])
            && !before.ends_with(|c: char| c.is_ascii_alphabetic() && !matches!(c, 'K' | 'T'))
        {
            // A letter before it makes it part of a unit, as in `FT`.
            *(if rest.ends_with('K') { &mut reading.knuckle } else { &mut reading.tangent }) = true;
            rest = before.trim_end();
        } else if !reading.doubtful && rest.starts_with('(') {
            reading.doubtful = true;
            rest = rest.strip_prefix('(').and_then(|r| r.strip_suffix(')')).ok_or(CellError::Bracket)?.trim();
        } else {
            break;
        }
    }
    if reading.doubtful && reading.locked {
        return Err(CellError::DoubtfulAndLocked);
    }
    if matches!(rest, "" | "-" | "*") {
        return Err(CellError::MarkAlone);
    }
    if rest == "?" {
        reading.entry = CellEntry::Unknown;
        return Ok(reading);
    }
    let (value, writing) = length(rest, rules)?;
    reading.entry = CellEntry::Length(value);
    reading.writing = writing;
    Ok(reading)
}

#[cfg(test)]
mod tests {
    use super::*;

    const METRES: CellRules = CellRules { unit: Notation::Metres, decimal_comma: false };

    fn value(text: &str) -> f64 {
        match parse_cell(text, METRES).unwrap().entry {
            CellEntry::Length(value) => value,
            other => panic!("{text}: {other:?}"),
        }
    }

    fn close(text: &str, expected: f64) {
        assert!((value(text) - expected).abs() < 1e-14, "{text} {}", value(text));
    }

    #[test]
    fn every_writing_of_a_length() {
        close("6.41", 6.41);
        close(" -0.25 ", -0.25);
        close(".5", 0.5);
        close("5.", 5.0);
        close("1e-3", 0.001);
        close("6410 mm", 6.41);
        close("3-4-5", (36.0 + 4.625) * 0.0254);
        close("3-4-5+", (36.0 + 4.6875) * 0.0254);
        close("3-4-5-", (36.0 + 4.5625) * 0.0254);
        close("-0-3-4", -3.5 * 0.0254);
        close("3,4,5", (36.0 + 4.625) * 0.0254);
        close("3,4,5+", (36.0 + 4.6875) * 0.0254);
        close("3' 4 5/8\"", (36.0 + 4.625) * 0.0254);
        close("12 FT", 12.0 * 0.3048);
        for text in ["3'-4 5/8\"", "3\u{2032} 4\u{215d}\u{2033}", "3-4 5/8", "3\u{2013}4\u{2013}5", "3-4\u{215d}"] {
            close(text, (36.0 + 4.625) * 0.0254);
            assert_eq!(parse_cell(text, METRES).unwrap().writing, CellWriting::Eighths, "{text}");
        }
        close("3-4-5\u{bd}", (36.0 + 4.6875) * 0.0254);
        close("(3\u{2032} 4\u{215d}\u{2033}K)", (36.0 + 4.625) * 0.0254);
        let rules = CellRules { unit: Notation::Millimetres, decimal_comma: false };
        assert_eq!(parse_cell("6410", rules).unwrap().entry, CellEntry::Length(6.41));
        assert_eq!(parse_cell("6.41 m", rules).unwrap().entry, CellEntry::Length(6.41));
        let comma = CellRules { unit: Notation::Metres, decimal_comma: true };
        assert_eq!(parse_cell("6,41", comma).unwrap().entry, CellEntry::Length(6.41));
        assert_eq!(parse_cell("6,41 m", comma).unwrap().entry, CellEntry::Length(6.41));
        assert_eq!(parse_cell("-1,5e-1", comma).unwrap().entry, CellEntry::Length(-0.15));
        assert_eq!(parse_cell("6.410", METRES).unwrap().writing, CellWriting::Plain { decimals: 3 });
        assert_eq!(parse_cell("3-4-5", METRES).unwrap().writing, CellWriting::Eighths);
        assert_eq!(parse_cell("3 m", METRES).unwrap().writing, CellWriting::WithUnit);
    }

    #[test]
    fn marks_and_their_combinations() {
        for (text, marks) in [
            ("(6.41)", [true, false, false, false]),
            ("6.41!", [false, true, false, false]),
            ("6.41K", [false, false, true, false]),
            ("6.41T", [false, false, false, true]),
            ("6.41 K T !", [false, true, true, true]),
            ("6.41!TK", [false, true, true, true]),
            ("(6.41K)", [true, false, true, false]),
            ("(6.41)T", [true, false, false, true]),
        ] {
            let r = parse_cell(text, METRES).unwrap();
            assert_eq!([r.doubtful, r.locked, r.knuckle, r.tangent], marks, "{text}");
            assert_eq!(r.entry, CellEntry::Length(6.41), "{text}");
        }
        close("(3-4-5+K)", (36.0 + 4.6875) * 0.0254);
        for text in ["", " ", "-", "*", "\u{2013}"] {
            assert_eq!(parse_cell(text, METRES).unwrap().entry, CellEntry::Absent);
        }
        assert_eq!(parse_cell("?", METRES).unwrap().entry, CellEntry::Unknown);
        assert!(parse_cell("?K", METRES).unwrap().knuckle);
    }

    #[test]
    fn every_message() {
        let message = |text: &str| {
            let error = parse_cell(text, METRES).unwrap_err();
            format!("{error}. {}", error.remedy())
        };
        assert_eq!(message("3-11-9"), "eighths are 0 to 7. Did you mean 3-11-0 or 4-0-1?");
        assert_eq!(message("3-4-8"), "eighths are 0 to 7. Did you mean 3-4-0 or 3-5-0?");
        assert_eq!(message("3-12-4+"), "inches are 0 to 11. Did you mean 4-0-4+ or 3-2-4+?");
        assert_eq!(message("-3-21-4"), "inches are 0 to 11. Did you mean -4-9-4?");
        assert_eq!(message("3,11,9"), "eighths are 0 to 7. Did you mean 3,11,0 or 4,0,1?");
        assert_eq!(message("3-99-9"), "inches are 0 to 11. ");
        assert_eq!(message("3-4"), "two numbers with a dash are no length. Did you mean 3-4-0?");
        assert_eq!(message("6,41"), "a decimal comma in a table of decimal points. Did you mean 6.41?");
        assert!(message("(6.41!)").starts_with("an offset cannot be doubtful"));
        assert!(message("(6.41").starts_with("the bracket is not closed"));
        assert!(message("K").starts_with("a mark without an offset"));
        assert!(message("abc").starts_with("not a number, a length"));
        assert!(message("nan").starts_with("not a number, a length"));
        assert!(message("inf").starts_with("not a number, a length"));
        assert!(message("12 deg").starts_with("'12 deg' is an angle, expected a length"));
        assert!(message("12 furlong").contains("'furlong' is not a unit"));
        assert!(message("1e999").contains("too large"));
        assert!(message(&"9".repeat(100)).starts_with("100 characters"));
    }

    #[test]
    fn nothing_that_is_not_finite_is_a_value() {
        let pieces =
            ["1", "9e308", "-", "+", ",", ".", "'", "\"", "/", "0", "(", ")", "!", "K", " ", "e", "mm", "?", "inf"];
        let mut state = 7u64;
        for _ in 0..200_000 {
            let mut text = String::new();
            for _ in 0..5 {
                state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
                text.push_str(pieces[(state >> 33) as usize % pieces.len()]);
            }
            for decimal_comma in [false, true] {
                let rules = CellRules { unit: Notation::Feet, decimal_comma };
                if let Ok(CellReading { entry: CellEntry::Length(value), .. }) = parse_cell(&text, rules) {
                    assert!(value.is_finite(), "{text}");
                }
            }
        }
    }
}
