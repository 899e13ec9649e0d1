//! Lengths in the notations of tables of offsets.

/// How a length is written in a table.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Notation {
    /// Metres, shortest decimal number that reads back the same.
    Metres,
    /// Whole millimetres.
    Millimetres,
    /// Feet, inches, eighths of an inch; `+` and `-` are a sixteenth more or less.
    FeetInchesEighths,
}

impl Notation {
    /// Every notation.
    pub const ALL: [Self; 3] = [Self::Metres, Self::Millimetres, Self::FeetInchesEighths];

    /// The word on the command line.
    #[must_use]
    pub fn as_str(self) -> &'static str {
        match self {
            Self::Metres => "m",
            Self::Millimetres => "mm",
            Self::FeetInchesEighths => "feet-inches-eighths",
        }
    }

    /// `length` \[m\] as it is written; rounding to the quantum of the notation (none, 1 mm, 1/16 in) is to the nearest.
    #[must_use]
    pub fn write(self, length: f64) -> String {
        match self {
            // Adding zero takes the sign from a negative zero.
            Self::Metres => format!("{}", length + 0.0),
            Self::Millimetres => format!("{:.0}", (length * 1000.0).round() + 0.0),
            Self::FeetInchesEighths => feet_inches_eighths(length),
        }
    }
}

/// `3-4-5`, `3-4-5+` (a sixteenth of an inch more), with the sign before it; the nearest sixteenth.
#[must_use]
pub fn feet_inches_eighths(length: f64) -> String {
    let sixteenths = (length.abs() / 0.0254 * 16.0).round();
    let sign = if length < 0.0 && sixteenths > 0.0 { "-" } else { "" };
    let tick = if sixteenths % 2.0 > 0.5 { "+" } else { "" };
    let eighths = (sixteenths / 2.0).floor();
    let inches = (eighths / 8.0).floor();
    let feet = (inches / 12.0).floor();
    format!("{sign}{feet:.0}-{:.0}-{:.0}{tick}", inches - 12.0 * feet, eighths - 8.0 * inches)
}

#[cfg(test)]
mod tests {
    use super::super::quantity::parse_length;
    use super::*;

    #[test]
    fn notations_of_one_length() {
        let length = (3.0 * 12.0 + 4.6875) * 0.0254;
        assert_eq!(Notation::FeetInchesEighths.write(length), "3-4-5+");
        assert_eq!(Notation::Millimetres.write(length), "1033");
        assert_eq!(Notation::Metres.write(6.15), "6.15");
        assert_eq!(Notation::Metres.write(-0.0), "0");
        assert_eq!(feet_inches_eighths(-0.3048), "-1-0-0");
        assert_eq!(feet_inches_eighths(0.304_799), "1-0-0");
    }

    #[test]
    fn eighths_read_back_within_a_thirty_second_of_an_inch() {
        for k in 0..2000 {
            let length = f64::from(k) * 0.01037 - 5.0;
            let back = parse_length(&feet_inches_eighths(length)).unwrap();
            assert!((back - length).abs() <= 0.0254 / 32.0 + 1e-12, "{length} {back}");
        }
    }
}
