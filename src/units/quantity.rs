//! One quantity: a number, or numbers with units, or feet-inches-eighths.
//!
//! Grammar: `13.2`, `32250 mm`, `62 ft 3 in`, `3' 4 5/8"`, `3'-4 5/8"`, `3' 4`, `3-4 5/8` (feet, inches and a fraction),
//! `3-4-5+` (3 ft 4 in and 5 eighths; the sign, or a half, adds or takes one sixteenth of an inch), `12 deg`, `4050 t`,
//! `1103 m2`, `2.5 %`, `14 kn`. Typographic dashes, primes and fractions (`3′ 4⅝″`) are those of a keyboard. A decimal comma
//! is refused, with what to write instead.
//! Factors are exact by definition: 1 in = 0.0254 m, 1 kn = 1852/3600 m/s, 1 long ton = 1.0160469088 t (NIST SP 811).

use std::borrow::Cow;

/// A knot [m/s].
pub const KNOT: f64 = 1852.0 / 3600.0;

/// What a number measures; plain numbers have none.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Dimension {
    /// A plain number.
    None,
    /// Length \[m\].
    Length,
    /// Angle \[rad\].
    Angle,
    /// Mass \[t\].
    Mass,
    /// Area \[m^2\].
    Area,
    /// Volume \[m^3\].
    Volume,
    /// Density \[t/m^3\].
    Density,
    /// Speed \[m/s\].
    Speed,
    /// A ratio written with `%`; the value is the fraction.
    Percent,
}

impl Dimension {
    /// The words for messages.
    #[must_use]
    pub fn as_str(self) -> &'static str {
        match self {
            Self::None => "a plain number",
            Self::Length => "a length",
            Self::Angle => "an angle",
            Self::Mass => "a mass",
            Self::Area => "an area",
            Self::Volume => "a volume",
            Self::Density => "a density",
            Self::Speed => "a speed",
            Self::Percent => "a percentage",
        }
    }
}

/// A number in SI units with what it measures.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Measure {
    /// Value in the unit of [`Dimension`].
    pub value: f64,
    /// What it measures.
    pub dimension: Dimension,
}

/// Why a text is not a quantity.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum UnitError {
    /// Nothing written.
    #[error("nothing is written; expected a number")]
    Empty,
    /// Not a number where one should stand.
    #[error("'{0}' is not a number")]
    Number(String),
    /// 13,2 instead of 13.2.
    #[error("'{found}' has a decimal comma; write {meant}")]
    DecimalComma {
        /// As written.
        found: String,
        /// With a point.
        meant: String,
    },
    /// A unit that is not known.
    #[error(
        "'{unit}' is not a unit; known are m, cm, mm, km, ft, in, deg, rad, t, kg, lt, m2, ft2, m3, ft3, t/m3, kg/m3, kn, m/s, %"
    )]
    Unit {
        /// As written.
        unit: String,
    },
    /// Inches or eighths beyond their range in feet-inches-eighths.
    #[error("'{text}': {what} must be 0 to {largest}")]
    Range {
        /// As written.
        text: String,
        /// `inches` or `eighths`.
        what: &'static str,
        /// The largest number that may stand there.
        largest: u32,
    },
    /// Parts that do not add, as a length and an angle.
    #[error("'{0}' mixes units that cannot be added")]
    Mixed(String),
    /// A quantity of another kind than asked.
    #[error("'{text}' is {found}, expected {expected}")]
    Kind {
        /// As written.
        text: String,
        /// What it is.
        found: &'static str,
        /// What it should be.
        expected: &'static str,
    },
    /// Not finite, or too long to be a number.
    #[error("'{0}' is too large to be a quantity")]
    TooLarge(String),
}

/// The longest text that is looked at, in bytes.
const LONGEST: usize = 200;

/// A text as it is quoted in messages: never longer than one line.
fn quoted(text: &str) -> String {
    if text.chars().count() > 40 { text.chars().take(37).chain("...".chars()).collect() } else { text.to_owned() }
}

/// A text with the dashes, primes and fractions of a keyboard for those of typesetters.
pub(super) fn keyed(text: &str) -> Cow<'_, str> {
    if text.is_ascii() {
        return if text.contains("''") { Cow::Owned(text.replace("''", "\"")) } else { Cow::Borrowed(text) };
    }
    let mut plain = String::with_capacity(text.len() + 8);
    for c in text.chars() {
        let fraction = match c {
            '\u{2010}'..='\u{2015}' | '\u{2212}' => "-",
            '\u{2032}' | '\u{2018}' | '\u{2019}' | '\u{b4}' => "'",
            '\u{2033}' | '\u{201c}' | '\u{201d}' => "\"",
            '\u{2044}' => "/",
            '\u{a0}' | '\u{2009}' | '\u{202f}' => " ",
            '\u{bd}' => " 1/2",
            '\u{bc}' => " 1/4",
            '\u{be}' => " 3/4",
            '\u{215b}' => " 1/8",
            '\u{215c}' => " 3/8",
            '\u{215d}' => " 5/8",
            '\u{215e}' => " 7/8",
            '\u{2153}' => " 1/3",
            '\u{2154}' => " 2/3",
            other => {
                plain.push(other);
                continue;
            }
        };
        // A fraction is parted from the whole number before it, and from nothing else.
        let parted = plain.ends_with(|c: char| c.is_ascii_digit());
        plain.push_str(if parted {
            fraction
        } else {
            fraction.strip_prefix(' ').filter(|f| !f.is_empty()).unwrap_or(fraction)
        });
    }
    Cow::Owned(plain.replace("''", "\""))
}

/// Factor to SI and dimension of a unit.
fn unit(word: &str) -> Option<(f64, Dimension)> {
    use Dimension::{Angle, Area, Density, Length, Mass, Percent, Speed, Volume};
    Some(match word.to_ascii_lowercase().as_str() {
        "m" | "metre" | "metres" | "meter" | "meters" => (1.0, Length),
        "km" => (1000.0, Length),
        "cm" => (0.01, Length),
        "mm" => (0.001, Length),
        "ft" | "feet" | "foot" | "'" => (0.3048, Length),
        "in" | "inch" | "inches" | "\"" => (0.0254, Length),
        "deg" | "degree" | "degrees" | "\u{b0}" => (std::f64::consts::PI / 180.0, Angle),
        "rad" => (1.0, Angle),
        "t" | "tonne" | "tonnes" => (1.0, Mass),
        "kg" => (0.001, Mass),
        "lt" | "ton" | "tons" => (1.016_046_908_8, Mass),
        "m2" | "m^2" | "m\u{b2}" => (1.0, Area),
        "ft2" | "ft^2" | "ft\u{b2}" => (0.3048 * 0.3048, Area),
        "m3" | "m^3" | "m\u{b3}" => (1.0, Volume),
        "ft3" | "ft^3" | "ft\u{b3}" => (0.3048 * 0.3048 * 0.3048, Volume),
        "t/m3" | "t/m^3" | "t/m\u{b3}" => (1.0, Density),
        "kg/m3" | "kg/m^3" | "kg/m\u{b3}" => (0.001, Density),
        "kn" | "kt" | "kts" | "knots" => (KNOT, Speed),
        "m/s" => (1.0, Speed),
        "km/h" => (1.0 / 3.6, Speed),
        "%" => (0.01, Percent),
        _ => return None,
    })
}

fn number(text: &str) -> Result<f64, UnitError> {
    let value: f64 = text.parse().map_err(|_| UnitError::Number(quoted(text)))?;
    if value.is_finite() { Ok(value) } else { Err(UnitError::TooLarge(quoted(text))) }
}

/// What stands before a half: `3-4-5` of `3-4-5 1/2`.
pub(super) fn before_half(text: &str) -> Option<&str> {
    text.strip_suffix("1/2")?.strip_suffix([' ', '-'])
}

/// `3-4-5`, `3-4-5+`, `-3-4-5-`: feet, inches, eighths, and a sixteenth more or less \[m\]; none when it does not look
/// so.
fn eighths(text: &str) -> Option<Result<f64, UnitError>> {
    let (sign, body) = match text.strip_prefix('-') {
        Some(rest) => (-1.0, rest),
        None => (1.0, text),
    };
    let half = before_half(body);
    let (body, tick) = match (body.strip_suffix('+'), body.strip_suffix('-'), half) {
        (Some(rest), _, _) | (_, _, Some(rest)) => (rest, 0.5),
        (_, Some(rest), _) => (rest, -0.5),
        _ => (body, 0.0),
    };
    let parts: Vec<&str> = body.split('-').map(str::trim).collect();
    let [feet, inches, eighths] = parts[..] else { return None };
    if ![feet, inches, eighths].iter().all(|p| !p.is_empty() && p.bytes().all(|b| b.is_ascii_digit())) {
        return None;
    }
    let value = |part: &str, what: &'static str, largest: u32| match part.parse::<u32>() {
        Ok(n) if n <= largest => Ok(f64::from(n)),
        _ => Err(UnitError::Range { text: quoted(text), what, largest }),
    };
    let sum = || {
        let (f, i, e) = (value(feet, "feet", 99_999)?, value(inches, "inches", 11)?, value(eighths, "eighths", 7)?);
        Ok(sign * (f * 12.0 + i + (e + tick) / 8.0) * 0.0254)
    };
    Some(sum())
}

/// `3-4 5/8`: feet, and inches with a fraction \[m\]; none when it does not look so.
fn feet_and_fraction(text: &str) -> Option<Result<f64, UnitError>> {
    let (sign, body) = text.strip_prefix('-').map_or((1.0, text), |rest| (-1.0, rest));
    let (feet, inches) = body.split_once('-')?;
    let (inches, above) = inches.split_once([' ', '-'])?;
    let (above, below, rest) = fraction(above.trim_start())?;
    let digits = |part: &str| !part.is_empty() && part.bytes().all(|b| b.is_ascii_digit());
    if !rest.is_empty() || ![feet, inches, above].into_iter().all(digits) {
        return None;
    }
    let sum = || {
        let whole = number(inches)?;
        if whole > 11.0 {
            return Err(UnitError::Range { text: quoted(text), what: "inches", largest: 11 });
        }
        let part = number(above)? / denominator(below, text)?;
        Ok(sign * (12.0 * number(feet)? + whole + part) * 0.0254)
    };
    Some(sum())
}

/// One part of a quantity: a number with an optional fraction and its unit.
struct Part<'a> {
    value: f64,
    unit: &'a str,
}

/// Whether a unit is that of feet.
fn is_feet(unit: &str) -> bool {
    unit == "'" || ["ft", "feet", "foot"].iter().any(|word| word.eq_ignore_ascii_case(unit))
}

/// Splits `62 ft 3 in`, `3'-4 5/8"`, `4 5/8"`, `12 deg` into numbers with units; what follows feet without a unit is inches.
fn parts(text: &str) -> Result<Vec<Part<'_>>, UnitError> {
    let mut rest = text;
    let mut parts = Vec::new();
    let is_digit = |c: char| c.is_ascii_digit() || c == '.';
    while !rest.is_empty() {
        let after_feet = parts.last().is_some_and(|part: &Part<'_>| is_feet(part.unit));
        if let Some(inches) = rest.strip_prefix('-').filter(|_| after_feet) {
            rest = inches.trim_start();
        }
        let signed = usize::from(parts.is_empty() && rest.starts_with(['+', '-']));
        let mut end = rest[signed..].find(|c| !is_digit(c)).map_or(rest.len(), |at| at + signed);
        // An exponent belongs to the number only when digits follow it.
        let tail = &rest.as_bytes()[end..];
        if let [b'e' | b'E', after @ ..] = tail {
            let sign = usize::from(matches!(after.first(), Some(b'+' | b'-')));
            let digits = after[sign..].iter().take_while(|b| b.is_ascii_digit()).count();
            if digits > 0 {
                end += 1 + sign + digits;
            }
        }
        let mut value = if end == signed { Err(UnitError::Number(quoted(text))) } else { number(&rest[..end]) }?;
        rest = &rest[end..];
        // `4 5/8` or `5/8`: a common fraction.
        if let Some(below) = rest.strip_prefix('/') {
            let stop = below.find(|c: char| !c.is_ascii_digit()).unwrap_or(below.len());
            value /= denominator(&below[..stop], text)?;
            rest = &below[stop..];
        } else if let Some((above, below, left)) = fraction(rest.strip_prefix('-').unwrap_or(rest.trim_start())) {
            value += number(above)? / denominator(below, text)?;
            rest = left;
        }
        rest = rest.trim_start();
        let stop = rest
            .find(|c: char| c.is_whitespace() || ((is_digit(c) || c == '-') && !after_unit(rest, c)))
            .unwrap_or(rest.len());
        let (word, left) = rest.split_at(stop);
        let inches = word.is_empty() && left.is_empty() && after_feet;
        parts.push(Part { value, unit: if inches { "in" } else { word } });
        rest = left.trim_start();
    }
    Ok(parts)
}

/// Whether the first `c` in `text` is the power in `m2`, `m3`, `t/m3` or `m^3`: nothing follows, as in `6 ft2 in`.
fn after_unit(text: &str, c: char) -> bool {
    let power = |at: usize| text[..at].ends_with(['m', 't', 'M', 'T', '^']) && text[at + 1..].trim().is_empty();
    matches!(c, '2' | '3') && text.find(c).is_some_and(power)
}

/// A fraction `5/8` at the start of `text`: above, below, and what follows.
fn fraction(text: &str) -> Option<(&str, &str, &str)> {
    let slash = text.find('/')?;
    let (above, below) = (&text[..slash], &text[slash + 1..]);
    if above.is_empty() || !above.bytes().all(|b| b.is_ascii_digit()) {
        return None;
    }
    let stop = below.find(|c: char| !c.is_ascii_digit()).unwrap_or(below.len());
    (stop > 0).then(|| (above, &below[..stop], &below[stop..]))
}

fn denominator(text: &str, whole: &str) -> Result<f64, UnitError> {
    let value = number(text)?;
    if value > 0.0 { Ok(value) } else { Err(UnitError::Number(quoted(whole))) }
}

/// 13,2 where 13.2 is meant.
fn decimal_comma(text: &str) -> Option<UnitError> {
    let (before, after) = text.split_once(',')?;
    let digits = after.chars().take_while(char::is_ascii_digit).count();
    let starts = before.trim_start_matches(['+', '-']);
    (digits > 0 && !after.contains(',') && !starts.is_empty() && starts.bytes().all(|b| b.is_ascii_digit()))
        .then(|| UnitError::DecimalComma { found: quoted(text), meant: quoted(&format!("{before}.{after}")) })
}

/// The quantity that a text writes.
///
/// # Errors
/// [`UnitError`] when it writes none.
pub fn parse(text: &str) -> Result<Measure, UnitError> {
    let keyed = keyed(text.trim());
    let text = keyed.as_ref();
    if text.is_empty() {
        return Err(UnitError::Empty);
    }
    if text.len() > LONGEST {
        return Err(UnitError::TooLarge(quoted(text)));
    }
    if let Some(error) = decimal_comma(text) {
        return Err(error);
    }
    if let Some(length) = eighths(text).or_else(|| feet_and_fraction(text)) {
        return length.map(|value| Measure { value, dimension: Dimension::Length });
    }
    let parts = parts(text)?;
    let negative = text.starts_with('-');
    let mut sum = Measure { value: 0.0, dimension: Dimension::None };
    for (index, part) in parts.iter().enumerate() {
        let (factor, dimension) = match part.unit {
            "" => (1.0, Dimension::None),
            word => unit(word).ok_or_else(|| UnitError::Unit { unit: quoted(word) })?,
        };
        if index == 0 {
            sum = Measure { value: part.value * factor, dimension };
        } else if dimension == sum.dimension && dimension != Dimension::None {
            sum.value += if negative { -part.value * factor } else { part.value * factor };
        } else {
            return Err(UnitError::Mixed(quoted(text)));
        }
    }
    if sum.value.is_finite() { Ok(sum) } else { Err(UnitError::TooLarge(quoted(text))) }
}

/// A length \[m\]; a plain number is metres.
///
/// # Errors
/// [`UnitError`] when the text writes no length.
pub fn parse_length(text: &str) -> Result<f64, UnitError> {
    let measure = parse(text)?;
    match measure.dimension {
        Dimension::None | Dimension::Length => Ok(measure.value),
        other => Err(UnitError::Kind { text: quoted(text), found: other.as_str(), expected: "a length" }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn close(text: &str, value: f64, dimension: Dimension) {
        let found = parse(text).unwrap();
        assert!((found.value - value).abs() <= 1e-12 * value.abs().max(1.0), "{text}: {found:?}");
        assert_eq!(found.dimension, dimension, "{text}");
    }

    #[test]
    fn lengths_of_every_notation() {
        close("217 m", 217.0, Dimension::Length);
        close("32250 mm", 32.25, Dimension::Length);
        close("32250mm", 32.25, Dimension::Length);
        close("62 ft 3 in", 62.25 * 0.3048, Dimension::Length);
        close("3' 4 5/8\"", (3.0 * 12.0 + 4.625) * 0.0254, Dimension::Length);
        close("3'4\"", 40.0 * 0.0254, Dimension::Length);
        close("6ft2in", 74.0 * 0.0254, Dimension::Length);
        close("6 ft3 in", 75.0 * 0.0254, Dimension::Length);
        close("5/8 in", 0.625 * 0.0254, Dimension::Length);
        close("3-4-5", (3.0 * 12.0 + 4.625) * 0.0254, Dimension::Length);
        close("3-4-5+", (3.0 * 12.0 + 4.6875) * 0.0254, Dimension::Length);
        close("3-4-5-", (3.0 * 12.0 + 4.5625) * 0.0254, Dimension::Length);
        close("-0-4-0", -4.0 * 0.0254, Dimension::Length);
        close("-3 ft 6 in", -3.5 * 0.3048, Dimension::Length);
        close("1e-3 km", 1.0, Dimension::Length);
        for text in [
            "3'-4 5/8\"",
            "3' - 4 5/8\"",
            "3'-4-5/8\"",
            "3\u{2032} 4\u{215d}\u{2033}",
            "3\u{2019}4 5/8\u{201d}",
            "3' 4 5/8''",
            "3' 4 5/8",
            "3 \u{2014} 4 \u{2014} 5",
            "3 ft 4 5\u{2044}8 in",
            "3-4 5/8",
            "3-4\u{215d}",
            "3\u{2013}4\u{2013}5",
            "3 ft-4.625 in",
        ] {
            close(text, (3.0 * 12.0 + 4.625) * 0.0254, Dimension::Length);
        }
        close("3-4-5\u{bd}", (3.0 * 12.0 + 4.6875) * 0.0254, Dimension::Length);
        close("0' \u{bd}\"", 0.0127, Dimension::Length);
        close("7\u{bd}\"", 7.5 * 0.0254, Dimension::Length);
        close("\u{2212}0-4-0", -4.0 * 0.0254, Dimension::Length);
    }

    #[test]
    fn other_quantities() {
        close("12 deg", 12f64.to_radians(), Dimension::Angle);
        close("0.13 rad", 0.13, Dimension::Angle);
        close("4050 t", 4050.0, Dimension::Mass);
        close("4050 m3", 4050.0, Dimension::Volume);
        close("1103 m2", 1103.0, Dimension::Area);
        close("100 ft^2", 9.290304, Dimension::Area);
        close("1025 kg/m3", 1.025, Dimension::Density);
        close("2.5 %", 0.025, Dimension::Percent);
        close("+0.8 %", 0.008, Dimension::Percent);
        close("14 kn", 14.0 * 1852.0 / 3600.0, Dimension::Speed);
        close("-1.5e2", -150.0, Dimension::None);
    }

    #[test]
    fn every_message() {
        let message = |text: &str| parse(text).unwrap_err().to_string();
        assert_eq!(message(" "), "nothing is written; expected a number");
        assert_eq!(message("13,2"), "'13,2' has a decimal comma; write 13.2");
        assert_eq!(message("13,2 m"), "'13,2 m' has a decimal comma; write 13.2 m");
        assert_eq!(message("3-11-9"), "'3-11-9': eighths must be 0 to 7");
        assert_eq!(message("3-12-1"), "'3-12-1': inches must be 0 to 11");
        assert_eq!(message("3-12 1/2"), "'3-12 1/2': inches must be 0 to 11");
        assert!(message("12 furlong").contains("'furlong' is not a unit"));
        assert_eq!(message("twelve"), "'twelve' is not a number");
        assert_eq!(message("12 m 3 deg"), "'12 m 3 deg' mixes units that cannot be added");
        assert!(message("1e999").contains("too large"));
        assert_eq!(parse_length("14 kn").unwrap_err().to_string(), "'14 kn' is a speed, expected a length");
    }
}
