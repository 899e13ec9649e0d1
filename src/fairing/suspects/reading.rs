//! What a cell would say had it been written or read right: hypotheses in the loftsman's terms.
//!
//! Each slip is undone on the text of the cell in its own notation: adjacent digits swapped back, a 1 read for a 7.
//! Slips that change the value by copying another cell leave that cell's text behind instead.

use crate::hull::TableForm;
use crate::units::{CellEntry, CellRules, Notation, parse_cell};

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

    /// How often such a slip is the cause of a wrong cell, before the cell is looked at. Judgement: swapped digits and
    /// look-alikes lead every list of transcription errors.
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
    pub(super) decimal_comma: bool,
    /// What is written over the half-breadth: 2 for full breadths, negative where half-breadths are written so.
    pub(super) factor: f64,
}

/// The text of an offset without the marks around it: brackets, `!`, `K`, `T`, blanks.
pub(super) fn bare(text: &str) -> &str {
    text.trim_matches(|c: char| c.is_whitespace() || matches!(c, '(' | ')' | '!' | 'K' | 'T'))
}

impl Writing {
    pub(super) fn of(form: &TableForm) -> Self {
        let factor = if form.full_breadths { 2.0 } else { 1.0 } * if form.negative { -1.0 } else { 1.0 };
        Self { notation: form.notation, decimals: form.decimals, decimal_comma: form.decimal_comma, factor }
    }

    /// `value` \[m\] in this writing; millimetres where computed values have no digits of their own.
    pub(super) fn write(self, value: f64) -> String {
        let decimals = self.decimals.or((self.notation == Notation::Metres).then_some(3));
        let text = self.notation.write_to(value * self.factor, decimals);
        if self.decimal_comma { text.replace('.', ",") } else { text }
    }

    /// The half-breadth that `text` stands for \[m\].
    pub(super) fn read(self, text: &str) -> Option<f64> {
        let rules = CellRules { unit: self.notation, decimal_comma: self.decimal_comma };
        match parse_cell(text, rules).ok()?.entry {
            CellEntry::Length(length) if length.is_finite() => Some(length / self.factor),
            _ => None,
        }
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

/// Every text that one slip of the pen makes into `text`.
pub(super) fn repairs(text: &str, writing: Writing) -> Vec<Repair> {
    let text = bare(text);
    if writing.read(text).is_none() {
        return Vec::new();
    }
    let plain = text.replace(',', ".").parse::<f64>().ok();
    let mut list: Vec<Repair> = Vec::new();
    let mut add = |hypothesis: Hypothesis, text: String, weight: f64| {
        if let Some(value) = writing.read(&text)
            && !list.iter().any(|r| r.hypothesis == hypothesis && r.text == text)
        {
            list.push(Repair { hypothesis, text, value, weight });
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
            add(
                Hypothesis::DigitDropped,
                with(&|copy| {
                    copy.remove(k);
                }),
                1.0,
            );
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
    match plain {
        Some(number) => decimal_slips(text, number, &mut add),
        None => feet_slips(text, &mut add),
    }
    list
}

/// The decimal sign one place off, seldom two; without decimals a digit lost at the end.
fn decimal_slips(text: &str, number: f64, add: &mut impl FnMut(Hypothesis, String, f64)) {
    let decimals = text.find(['.', ',']).map_or(0, |k| text.len() - k - 1);
    let finer = if decimals > 0 { decimals + 1 } else { 0 };
    for (factor, decimals, weight) in
        [(10.0, decimals, 1.0), (0.1, finer, 1.0), (100.0, decimals, 0.1), (0.01, finer, 0.1)]
    {
        let slipped = format!("{:.decimals$}", number * factor);
        add(Hypothesis::DecimalSlipped, if text.contains(',') { slipped.replace('.', ",") } else { slipped }, weight);
    }
    if decimals == 0 {
        for digit in '1'..='9' {
            add(Hypothesis::DecimalSlipped, format!("{text}{digit}"), 0.3);
        }
    }
}

/// A foot or an inch too many or too few.
fn feet_slips(text: &str, add: &mut impl FnMut(Hypothesis, String, f64)) {
    let signs = ['-', ',', ' ', '\''];
    let (sign, unsigned) = text.strip_prefix('-').map_or(("", text), |rest| ("-", rest));
    let Some(end) = unsigned.find(signs) else { return };
    let (feet, rest) = unsigned.split_at(end);
    let Ok(number) = feet.parse::<i64>() else { return };
    for other in [number - 1, number + 1].into_iter().filter(|&other| other >= 0) {
        add(Hypothesis::WrongFoot, format!("{sign}{other}{rest}"), 1.0);
    }
    let start = rest.find(|c: char| c.is_ascii_digit()).unwrap_or(rest.len());
    let (between, rest) = rest.split_at(start);
    let end = rest.find(|c: char| !c.is_ascii_digit()).unwrap_or(rest.len());
    let (inches, rest) = rest.split_at(end);
    let Ok(number) = inches.parse::<i64>() else { return };
    for other in [number - 1, number + 1].into_iter().filter(|other| (0..12).contains(other)) {
        add(Hypothesis::WrongInch, format!("{sign}{feet}{between}{other}{rest}"), 1.0);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn writing(notation: Notation) -> Writing {
        Writing { notation, decimals: None, decimal_comma: false, factor: 1.0 }
    }

    fn finds(text: &str, notation: Notation, meant: &str, hypothesis: Hypothesis) {
        let list = repairs(text, writing(notation));
        assert!(list.iter().any(|r| r.hypothesis == hypothesis && r.text == meant), "{text} for {meant}: {list:?}");
    }

    #[test]
    fn each_slip_is_undone_in_its_notation() {
        let (m, mm, feet) = (Notation::Metres, Notation::Millimetres, Notation::FeetInchesEighths);
        finds("29363", mm, "29633", Hypothesis::DigitsSwapped);
        finds("3-7-4", feet, "3-1-4", Hypothesis::DigitMisread);
        finds("6.83", m, "6.33", Hypothesis::DigitMisread);
        finds("0.641", m, "6.410", Hypothesis::DecimalSlipped);
        finds("64.1", m, "6.41", Hypothesis::DecimalSlipped);
        finds("641", mm, "6410", Hypothesis::DecimalSlipped);
        finds("2-11-3", feet, "1-11-3", Hypothesis::WrongFoot);
        finds("2-11-3+", feet, "2-10-3+", Hypothesis::WrongInch);
        finds("-6.41", m, "6.41", Hypothesis::SignLost);
        finds("2933", mm, "29633", Hypothesis::DigitDropped);
        finds("299633", mm, "29633", Hypothesis::DigitDropped);
        finds("(29363)K", mm, "29633", Hypothesis::DigitsSwapped);
    }

    #[test]
    fn a_repair_has_the_value_of_its_text_in_full_breadths_too() {
        let doubled = Writing { factor: 2.0, decimal_comma: true, ..writing(Notation::Metres) };
        let list = repairs("12,82", doubled);
        let swapped = list.iter().find(|r| r.text == "12,28").unwrap();
        assert!((swapped.value - 6.14).abs() < 1e-12 && swapped.hypothesis == Hypothesis::DigitsSwapped);
        assert_eq!(doubled.write(6.41), "12,820");
    }
}
