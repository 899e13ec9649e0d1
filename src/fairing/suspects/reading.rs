//! What a cell would say had it been written or read right: hypotheses in the loftsman's terms.
//!
//! Each slip is undone on the text of the cell in its own notation: adjacent digits swapped back, a 1 read for a 7. Slips that
//! change the value by copying another cell leave that cell's text behind instead.

use crate::units::Notation;

/// How a cell may have come to say what it says.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Hypothesis {
    /// Two adjacent digits changed places.
    DigitsSwapped,
    /// A digit read for one that looks like it: 1 and 7, 3 and 8, and more rarely 0, 5, 6, 8, 9, 4.
    DigitMisread,
    /// The decimal sign one place off, or a nought too many or too few at the end.
    DecimalSlipped,
    /// One foot too many or too few.
    WrongFoot,
    /// One inch too many or too few.
    WrongInch,
    /// A digit left out or written twice.
    DigitDropped,
    /// The minus sign lost or gained.
    SignLost,
    /// The value of a neighbouring waterline.
    NeighbouringWaterline,
    /// The value of a neighbouring station.
    NeighbouringStation,
    /// One digit wrong.
    DigitWrong,
    /// Wrong, and none of these.
    Unexplained,
    /// Right: reading noise, or the shape of the hull.
    Noise,
}

impl Hypothesis {
    /// Every hypothesis.
    pub const ALL: [Self; 12] = [
        Self::DigitsSwapped,
        Self::DigitMisread,
        Self::DecimalSlipped,
        Self::WrongFoot,
        Self::WrongInch,
        Self::DigitDropped,
        Self::SignLost,
        Self::NeighbouringWaterline,
        Self::NeighbouringStation,
        Self::DigitWrong,
        Self::Unexplained,
        Self::Noise,
    ];

    /// In the loftsman's words.
    #[must_use]
    pub fn as_str(self) -> &'static str {
        match self {
            Self::DigitsSwapped => "digits swapped",
            Self::DigitMisread => "digit misread",
            Self::DecimalSlipped => "decimal slipped",
            Self::WrongFoot => "wrong foot",
            Self::WrongInch => "wrong inch",
            Self::DigitDropped => "digit dropped or doubled",
            Self::SignLost => "sign lost",
            Self::NeighbouringWaterline => "value of the neighbouring waterline",
            Self::NeighbouringStation => "value of the neighbouring station",
            Self::DigitWrong => "one digit wrong",
            Self::Unexplained => "unexplained",
            Self::Noise => "right as written",
        }
    }

    /// How often such a slip is the cause of a wrong cell, before the cell is looked at. Judgement: swapped digits and look-alikes
    /// lead every list of transcription errors.
    pub(super) fn prior(self) -> f64 {
        match self {
            Self::DigitsSwapped | Self::DigitMisread => 0.2,
            Self::DecimalSlipped | Self::NeighbouringWaterline | Self::NeighbouringStation => 0.09,
            Self::WrongFoot => 0.1,
            Self::WrongInch | Self::DigitDropped => 0.04,
            Self::SignLost => 0.03,
            Self::DigitWrong => 0.08,
            Self::Unexplained => 0.04,
            Self::Noise => 0.0,
        }
    }
}

/// A text that a cell may have meant.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Repair {
    pub(super) hypothesis: Hypothesis,
    pub(super) text: String,
    /// Its value \[m\].
    pub(super) value: f64,
    /// How many times likelier than the other repairs of its kind.
    pub(super) weight: f64,
}

/// How a table writes its offsets.
#[derive(Debug, Clone, Copy)]
pub(super) struct Writing {
    pub(super) notation: Notation,
    pub(super) decimals: Option<usize>,
}

/// The digits of a text without the marks around them: brackets, `!`, `K`, `T`, blanks.
fn bare(text: &str) -> &str {
    text.trim_matches(|c: char| !(c.is_ascii_digit() || matches!(c, '-' | '+' | '.' | ',')))
}

fn decimal(text: &str) -> Option<f64> {
    text.replace(',', ".").parse::<f64>().ok().filter(|v| v.is_finite())
}

/// `3-4-5`, `3-4-5+`, `3,4,5` as feet.
fn feet(text: &str) -> Option<f64> {
    let (sign, rest) = text.strip_prefix('-').map_or((1.0, text), |rest| (-1.0, rest));
    let (rest, sixteenth) = match rest.strip_suffix(['+', '-']) {
        Some(head) => (head, if rest.ends_with('+') { 0.5 } else { -0.5 }),
        None => (rest, 0.0),
    };
    let parts: Vec<&str> = rest.split(['-', ',', ' ']).collect();
    let [feet, inches, eighths] = parts[..] else { return None };
    let number = |part: &str| part.parse::<u32>().ok().map(f64::from);
    let (feet, inches, eighths) = (number(feet)?, number(inches)?, number(eighths)?);
    (inches < 12.0 && eighths < 8.0).then_some(sign * (feet + (inches + (eighths + sixteenth) / 8.0) / 12.0))
}

impl Writing {
    /// `value` \[m\] in this writing.
    pub(super) fn write(self, value: f64) -> String {
        match (self.notation, self.decimals) {
            (Notation::Metres, decimals) => format!("{value:.*}", decimals.unwrap_or(3)),
            (Notation::Millimetres, Some(decimals)) => format!("{:.decimals$}", value * 1000.0),
            (notation, _) => notation.write(value),
        }
    }

    /// Metres a unit of the number in `text` that stands for `value`; the number itself.
    fn read(text: &str, value: f64) -> Option<(fn(&str) -> Option<f64>, f64)> {
        let readers: [fn(&str) -> Option<f64>; 2] = [decimal, feet];
        readers.into_iter().find_map(|reader| {
            let number = reader(text)?;
            let unit = if number.abs() > 0.0 { value / number } else { 1.0 };
            (unit > 0.0).then_some((reader, unit))
        })
    }
}

/// What a digit may have been, and how likely against the other look-alikes.
fn look_alikes(digit: u8) -> &'static [(u8, f64)] {
    match digit {
        b'0' => &[(b'6', 0.2), (b'8', 0.15), (b'9', 0.15)],
        b'1' => &[(b'7', 1.0), (b'4', 0.1)],
        b'2' => &[(b'7', 0.15), (b'3', 0.1)],
        b'3' => &[(b'8', 1.0), (b'5', 0.2), (b'2', 0.1)],
        b'4' => &[(b'9', 0.25), (b'1', 0.1)],
        b'5' => &[(b'6', 0.25), (b'3', 0.2), (b'8', 0.1)],
        b'6' => &[(b'5', 0.25), (b'0', 0.2), (b'8', 0.2)],
        b'7' => &[(b'1', 1.0), (b'2', 0.15), (b'9', 0.15)],
        b'8' => &[(b'3', 1.0), (b'6', 0.2), (b'0', 0.15), (b'5', 0.1)],
        b'9' => &[(b'4', 0.25), (b'7', 0.15), (b'0', 0.15)],
        _ => &[],
    }
}

/// Every text that one slip of the pen makes into `text`, which stands for `value` \[m\].
pub(super) fn repairs(text: &str, value: f64) -> Vec<Repair> {
    let text = bare(text);
    let Some((reader, unit)) = Writing::read(text, value) else { return Vec::new() };
    let is_feet = decimal(text).is_none();
    let mut list: Vec<Repair> = Vec::new();
    let mut add = |hypothesis: Hypothesis, text: String, weight: f64| {
        if let Some(number) = reader(&text) {
            let value = number * unit;
            if !list.iter().any(|r| r.hypothesis == hypothesis && r.text == text) {
                list.push(Repair { hypothesis, text, value, weight });
            }
        }
    };
    let bytes = text.as_bytes();
    let with = |change: &dyn Fn(&mut Vec<u8>)| {
        let mut copy = bytes.to_vec();
        change(&mut copy);
        String::from_utf8(copy).unwrap_or_default()
    };
    let digits: Vec<usize> = (0..bytes.len()).filter(|&k| bytes[k].is_ascii_digit()).collect();
    for pair in digits.windows(2).filter(|pair| bytes[pair[0]] != bytes[pair[1]]) {
        // Across a decimal sign the fingers swap less often.
        let weight = if pair[1] == pair[0] + 1 { 1.0 } else { 0.3 };
        add(Hypothesis::DigitsSwapped, with(&|copy| copy.swap(pair[0], pair[1])), weight);
    }
    for &k in &digits {
        for &(digit, weight) in look_alikes(bytes[k]) {
            add(Hypothesis::DigitMisread, with(&|copy| copy[k] = digit), weight);
        }
        for digit in b'0'..=b'9' {
            if digit != bytes[k] {
                add(Hypothesis::DigitWrong, with(&|copy| copy[k] = digit), 1.0);
            }
        }
        if k > 0 && bytes[k - 1] == bytes[k] {
            add(Hypothesis::DigitDropped, with(&|copy| drop(copy.remove(k))), 1.0);
        }
        for digit in b'0'..=b'9' {
            let weight = if digit == bytes[k] { 1.0 } else { 0.2 };
            add(Hypothesis::DigitDropped, with(&|copy| copy.insert(k, digit)), weight);
        }
    }
    for digit in b'0'..=b'9' {
        add(Hypothesis::DigitDropped, with(&|copy| copy.insert(digits.last().map_or(0, |k| k + 1), digit)), 0.2);
    }
    add(Hypothesis::SignLost, text.strip_prefix('-').map_or_else(|| format!("-{text}"), str::to_owned), 1.0);
    if is_feet {
        let parts: Vec<&str> = text.splitn(2, ['-', ',', ' ']).collect();
        if let [feet, rest] = parts[..]
            && let Ok(feet) = feet.parse::<i64>()
        {
            let sign = text.as_bytes()[parts[0].len()] as char;
            for other in [feet - 1, feet + 1] {
                if other >= 0 {
                    add(Hypothesis::WrongFoot, format!("{other}{sign}{rest}"), 1.0);
                }
            }
            let inner: Vec<&str> = rest.splitn(2, ['-', ',', ' ']).collect();
            if let [inches, rest] = inner[..]
                && let Ok(inches) = inches.parse::<i64>()
            {
                for other in [inches - 1, inches + 1] {
                    if (0..12).contains(&other) {
                        add(Hypothesis::WrongInch, format!("{feet}{sign}{other}{sign}{rest}"), 1.0);
                    }
                }
            }
        }
    } else {
        let number = reader(text).unwrap_or(0.0);
        let decimals = text.find(['.', ',']).map_or(0, |k| text.len() - k - 1);
        for (factor, decimals) in
            [(10.0, decimals), (0.1, if decimals > 0 { decimals + 1 } else { 0 }), (100.0, decimals), (0.01, decimals)]
        {
            let weight = if factor > 50.0 || factor < 0.05 { 0.1 } else { 1.0 };
            add(Hypothesis::DecimalSlipped, format!("{:.decimals$}", number * factor), weight);
        }
        // A nought or another digit lost at the end leaves a tenth, whatever the digit was.
        if decimals == 0 {
            for digit in b'1'..=b'9' {
                add(Hypothesis::DecimalSlipped, with(&|copy| copy.push(digit)), 0.3);
            }
        }
    }
    list
}

#[cfg(test)]
mod tests {
    use super::*;

    fn finds(text: &str, value: f64, meant: &str, hypothesis: Hypothesis) {
        let list = repairs(text, value);
        assert!(list.iter().any(|r| r.hypothesis == hypothesis && r.text == meant), "{text} for {meant}: {list:?}");
    }

    #[test]
    fn each_slip_is_undone_in_its_notation() {
        finds("29363", 29.363, "29633", Hypothesis::DigitsSwapped);
        finds("3-7-4", 1.1, "3-1-4", Hypothesis::DigitMisread);
        finds("6.83", 6.83, "6.33", Hypothesis::DigitMisread);
        finds("0.641", 0.641, "6.410", Hypothesis::DecimalSlipped);
        finds("64.1", 64.1, "6.41", Hypothesis::DecimalSlipped);
        finds("2-11-3", 0.3048 * (2.0 + 11.375 / 12.0), "1-11-3", Hypothesis::WrongFoot);
        finds("-6.41", -6.41, "6.41", Hypothesis::SignLost);
        finds("2933", 2.933, "29633", Hypothesis::DigitDropped);
        finds("299633", 299.633, "29633", Hypothesis::DigitDropped);
    }

    #[test]
    fn a_repair_has_the_value_of_its_text() {
        for repair in repairs("3-4-5+", 0.3048 * (3.0 + 4.6875 / 12.0)) {
            let value = feet(&repair.text).unwrap() * 0.3048;
            assert!((value - repair.value).abs() < 1e-9, "{repair:?}");
        }
        for repair in repairs("(6,41)", 6.41) {
            assert!((decimal(&repair.text).unwrap() - repair.value).abs() < 1e-9, "{repair:?}");
        }
    }
}
