//! Lengths in the notations of tables of offsets.
//!
//! Factors are exact by definition: 1 in = 0.0254 m, 1 ft = 0.3048 m. Whole units of a metre are divided by powers of
//! ten, so that 6410 mm is the same double as 6.41 m.

/// How a length is written in a table.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Notation {
    /// Metres, shortest decimal number that reads back the same.
    Metres,
    /// Centimetres.
    Centimetres,
    /// Whole millimetres, unless more digits are asked for.
    Millimetres,
    /// Feet as a decimal number.
    Feet,
    /// Inches as a decimal number.
    Inches,
    /// Feet, inches, eighths of an inch; `+` and `-` are a sixteenth more or less.
    FeetInchesEighths,
}

/// An eighth of an inch \[m\].
const EIGHTH: f64 = 0.0254 / 8.0;

/// Smaller numbers are what rounding leaves of 0, and have more digits than a cell.
const LEAST: f64 = 1e-18;

impl Notation {
    /// A small length \[m\] in words: in millimetres, or in eighths of an inch where tables are written in those.
    #[must_use]
    pub fn small(self, length: f64) -> String {
        match self {
            Self::FeetInchesEighths => format!("{:.2} eighths of an inch", length / EIGHTH),
            _ => format!("{:.2} mm", 1e3 * length),
        }
    }

    /// Every notation.
    pub const ALL: [Self; 6] =
        [Self::Metres, Self::Millimetres, Self::FeetInchesEighths, Self::Centimetres, Self::Feet, Self::Inches];

    /// The word on the command line.
    #[must_use]
    pub fn as_str(self) -> &'static str {
        match self {
            Self::Metres => "m",
            Self::Centimetres => "cm",
            Self::Millimetres => "mm",
            Self::Feet => "ft",
            Self::Inches => "in",
            Self::FeetInchesEighths => "feet-inches-eighths",
        }
    }

    /// The notation that a word names, on a command line, in a header or in a file of conventions; upper and lower case
    /// are the same.
    #[must_use]
    pub fn from_word(word: &str) -> Option<Self> {
        Some(match word.trim().to_ascii_lowercase().as_str() {
            "m" | "metre" | "metres" | "meter" | "meters" => Self::Metres,
            "cm" | "centimetre" | "centimetres" | "centimeter" | "centimeters" => Self::Centimetres,
            "mm" | "millimetre" | "millimetres" | "millimeter" | "millimeters" => Self::Millimetres,
            "ft" | "foot" | "feet" => Self::Feet,
            "in" | "inch" | "inches" => Self::Inches,
            "feet-inches-eighths" | "ft-in-8" | "ft-in-8ths" | "f-i-e" | "feet inches eighths" => {
                Self::FeetInchesEighths
            }
            _ => return None,
        })
    }

    /// The length \[m\] of a plain number in this notation; of plain numbers among feet-inches-eighths, feet.
    #[must_use]
    pub fn metres(self, number: f64) -> f64 {
        match self {
            Self::Metres => number,
            Self::Centimetres => number / 100.0,
            Self::Millimetres => number / 1000.0,
            Self::Feet | Self::FeetInchesEighths => number * 0.3048,
            Self::Inches => number * 0.0254,
        }
    }

    /// The plain number in this notation of a length \[m\].
    #[must_use]
    pub fn number(self, length: f64) -> f64 {
        match self {
            Self::Metres => length,
            Self::Centimetres => length * 100.0,
            Self::Millimetres => length * 1000.0,
            Self::Feet | Self::FeetInchesEighths => length / 0.3048,
            Self::Inches => length / 0.0254,
        }
    }

    /// `length` \[m\] as it is written; rounding to the quantum of the notation (none, 1 mm, 1/16 in) is to the nearest.
    #[must_use]
    pub fn write(self, length: f64) -> String {
        self.write_to(length, if self == Self::Millimetres { Some(0) } else { None })
    }

    /// `length` \[m\] with so many decimals; the shortest number that reads back as the same length for none. Eighths
    /// have no decimals.
    #[must_use]
    pub fn write_to(self, length: f64, decimals: Option<usize>) -> String {
        if self == Self::FeetInchesEighths {
            return feet_inches_eighths(length);
        }
        let number = self.number(length);
        let Some(decimals) = decimals else { return self.shortest(length, number) };
        let text = format!("{number:.decimals$}");
        // A negative number that rounds to zero loses its sign.
        if text.bytes().all(|b| matches!(b, b'-' | b'0' | b'.')) { text.replace('-', "") } else { text }
    }

    /// Fewest digits that read back as `length`: 6.41 m is 641 cm, not 641.0000000000001.
    fn shortest(self, length: f64, number: f64) -> String {
        // Adding zero takes the sign from a negative zero.
        let number = if number.abs() < LEAST { 0.0 } else { number };
        let full = format!("{}", number + 0.0);
        if self == Self::Metres {
            return full;
        }
        (0..=12)
            .map(|digits| self.write_to(length, Some(digits)))
            .find(|text| text.parse::<f64>().is_ok_and(|n| self.metres(n).to_bits() == (length + 0.0).to_bits()))
            .unwrap_or(full)
    }

    /// The step between two lengths that can be told apart when they are written with so many decimals \[m\]; none where
    /// numbers are written in full.
    #[must_use]
    pub fn quantum(self, decimals: Option<usize>) -> Option<f64> {
        match self {
            Self::FeetInchesEighths => Some(0.0254 / 16.0),
            Self::Millimetres if decimals.is_none() => Some(0.001),
            _ => decimals.map(|n| self.metres(10f64.powi(-i32::try_from(n).unwrap_or(17)))),
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
        assert_eq!(Notation::Millimetres.write(-0.0002), "0");
        assert_eq!(Notation::Centimetres.write(6.41), "641");
        assert_eq!(Notation::Feet.write(3.048), "10");
        assert_eq!(Notation::Inches.write(0.0127), "0.5");
        assert_eq!(Notation::Metres.write_to(6.414_999, Some(2)), "6.41");
        assert_eq!(Notation::Millimetres.write_to(6.4146, Some(1)), "6414.6");
        assert_eq!(feet_inches_eighths(-0.3048), "-1-0-0");
        assert_eq!(feet_inches_eighths(0.304_799), "1-0-0");
    }

    #[test]
    fn whole_millimetres_are_the_same_double_as_metres() {
        for mm in 0..20_000 {
            let metres: f64 = format!("{}.{:03}", mm / 1000, mm % 1000).parse().unwrap();
            assert_eq!(Notation::Millimetres.metres(f64::from(mm)).to_bits(), metres.to_bits(), "{mm}");
        }
    }

    #[test]
    fn full_numbers_read_back_as_the_same_length() {
        assert_eq!([1e-90, -1e-20].map(|rest| Notation::Metres.write(rest)), ["0", "0"]);
        for k in 0..3000 {
            let length = f64::from(k) * 0.010_370_123_7 - 5.0;
            for notation in [Notation::Metres, Notation::Centimetres, Notation::Feet, Notation::Inches] {
                let text = notation.write(length);
                let back = notation.metres(text.parse().unwrap());
                assert!((back - length).abs() <= 4e-16 * length.abs(), "{text} {length} {back}");
            }
        }
    }

    #[test]
    fn words_of_units() {
        for notation in Notation::ALL {
            assert_eq!(Notation::from_word(notation.as_str()), Some(notation));
        }
        assert_eq!(Notation::from_word(" MM "), Some(Notation::Millimetres));
        assert_eq!(Notation::from_word("furlong"), None);
    }

    #[test]
    fn steps_of_the_notations() {
        assert_eq!(Notation::Metres.quantum(None), None);
        assert!((Notation::Metres.quantum(Some(3)).unwrap() - 1e-3).abs() < 1e-18);
        assert!((Notation::Millimetres.quantum(None).unwrap() - 1e-3).abs() < 1e-18);
        assert!((Notation::Feet.quantum(Some(2)).unwrap() - 0.003_048).abs() < 1e-15);
        assert!((Notation::FeetInchesEighths.quantum(Some(3)).unwrap() - 0.0254 / 16.0).abs() < 1e-18);
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
