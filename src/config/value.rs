//! Values of the known keys: units, words, lists, and what is wrong with them.

use super::keys::{Kind, expected};
use std::ops::Range;

use super::document::{Document, Raw, nearest};
use crate::units::{self, Dimension, Measure};

/// A number with its kind, or a word.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Scalar {
    Measure(Measure),
    Word(&'static str),
}

fn accepts(kind: Kind, dimension: Dimension) -> bool {
    if let Kind::OrWord(inner, _) = kind {
        return accepts(*inner, dimension);
    }
    match dimension {
        Dimension::None => true,
        Dimension::Percent => {
            matches!(kind, Kind::Number | Kind::NumberOrWord(_) | Kind::FractionOrLength | Kind::Interval)
        }
        Dimension::Length => {
            matches!(kind, Kind::Length | Kind::FractionOrLength | Kind::Positions | Kind::NamedLengths)
        }
        Dimension::Angle => matches!(kind, Kind::Angle | Kind::RawAngle | Kind::NamedAngles(_)),
        Dimension::Area => kind == Kind::Area,
        Dimension::Mass | Dimension::Volume => kind == Kind::Displacement,
        Dimension::Density => kind == Kind::Density,
        Dimension::Speed => false,
    }
}

impl Document<'_> {
    /// Notes that the value at `span` is not what `kind` asks for.
    pub(super) fn unexpected(&mut self, path: &str, raw: &Raw, span: &Range<usize>, kind: Kind) {
        let found = raw.describe();
        self.problem("E122", path, span, format!("{path} is {found}, expected {}", expected(kind)), String::new());
    }

    /// Whether the value is the number or the text that `raw` says, in the units that `kind` takes.
    pub(super) fn measure(&mut self, path: &str, raw: &Raw, span: &Range<usize>, kind: Kind) -> Option<Measure> {
        match raw {
            Raw::Number(value) if value.is_finite() => Some(Measure { value: *value, dimension: Dimension::None }),
            Raw::Number(value) => {
                self.problem("E123", path, span, format!("{path} is {value}, expected a finite number"), String::new());
                None
            }
            Raw::Text(text) => match units::parse(text) {
                Ok(measure) if accepts(kind, measure.dimension) => Some(measure),
                Ok(measure) => {
                    let found = measure.dimension.as_str();
                    self.problem(
                        "E123",
                        path,
                        span,
                        format!("{path}: \"{text}\" is {found}, expected {}", expected(kind)),
                        String::new(),
                    );
                    None
                }
                Err(error) => {
                    self.problem(
                        "E123",
                        path,
                        span,
                        format!("{path}: {error}"),
                        format!("Expected {}.", expected(kind)),
                    );
                    None
                }
            },
            _ => {
                self.unexpected(path, raw, span, kind);
                None
            }
        }
    }

    /// The word of the list that a text is, whatever its case.
    pub(super) fn one_of(
        &mut self,
        path: &str,
        text: &str,
        span: &Range<usize>,
        words: &[&'static str],
    ) -> Option<&'static str> {
        let found = words.iter().find(|word| word.eq_ignore_ascii_case(text.trim())).copied();
        if found.is_none() {
            let help = match nearest(text, words.iter().copied()) {
                Some(near) => format!("Did you mean \"{near}\"?"),
                None => format!("Known are \"{}\".", words.join("\", \"")),
            };
            let shown = Raw::Text(text.to_owned()).describe();
            self.problem("E127", path, span, format!("{path}: {shown} is not known"), help);
        }
        found
    }

    /// Value and place of a key; none when the key is absent.
    pub(super) fn raw(&self, path: &str) -> Option<(Raw, Range<usize>, Kind)> {
        self.entry(path).map(|entry| (entry.value.clone(), entry.span.clone(), entry.key.kind))
    }

    /// The number of a key in SI units: metres, radians, tonnes per cubic metre, plain fractions.
    pub(super) fn number(&mut self, path: &str) -> Option<f64> {
        let (raw, span, kind) = self.raw(path)?;
        let measure = self.measure(path, &raw, &span, kind)?;
        match (kind, measure.dimension) {
            (Kind::Angle, Dimension::None) => Some(measure.value.to_radians()),
            _ => Some(measure.value),
        }
    }

    /// The number with its dimension, for keys whose meaning depends on the unit.
    pub(super) fn dimensioned(&mut self, path: &str) -> Option<Measure> {
        let (raw, span, kind) = self.raw(path)?;
        self.measure(path, &raw, &span, kind)
    }

    /// A whole number of a key.
    pub(super) fn integer(&mut self, path: &str) -> Option<u32> {
        let (raw, span, kind) = self.raw(path)?;
        let Kind::Integer(from, to) = kind else { return None };
        match raw {
            Raw::Number(value) if value.fract().abs() <= 0.0 && (f64::from(from)..=f64::from(to)).contains(&value) => {
                Some(value as u32)
            }
            Raw::Number(value) if path == "schema" => {
                self.problem(
                    "E128",
                    path,
                    &span,
                    format!("schema {value} is not known to this program, which reads schema {from} to {to}"),
                    "Use a newer loftsman, or schema = 1.".into(),
                );
                None
            }
            other => {
                self.unexpected(path, &other, &span, kind);
                None
            }
        }
    }

    /// A text of a key.
    pub(super) fn text(&mut self, path: &str) -> Option<String> {
        let (raw, span, kind) = self.raw(path)?;
        match raw {
            Raw::Text(text) => Some(text),
            other => {
                self.unexpected(path, &other, &span, kind);
                None
            }
        }
    }

    /// A word of a key.
    pub(super) fn word(&mut self, path: &str) -> Option<&'static str> {
        let (raw, span, kind) = self.raw(path)?;
        match (raw, kind) {
            (Raw::Text(text), Kind::Word(words)) => self.one_of(path, &text, &span, words),
            (other, _) => {
                self.unexpected(path, &other, &span, kind);
                None
            }
        }
    }

    /// A number or a word of a key.
    pub(super) fn number_or_word(&mut self, path: &str) -> Option<Scalar> {
        let (raw, span, kind) = self.raw(path)?;
        if let (Raw::Text(text), Kind::NumberOrWord(words)) = (&raw, kind)
            && !text.trim_start().starts_with(|c: char| c.is_ascii_digit() || "+-.".contains(c))
        {
            return self.one_of(path, text, &span, words).map(Scalar::Word);
        }
        self.measure(path, &raw, &span, kind).map(Scalar::Measure)
    }

    /// A number in the unit of the inner kind, or a word, of a key of the kind [`Kind::OrWord`].
    pub(super) fn measure_or_word(&mut self, path: &str) -> Option<Scalar> {
        let (raw, span, kind) = self.raw(path)?;
        let Kind::OrWord(_, words) = kind else { return None };
        if let Raw::Text(text) = &raw
            && !text.trim_start().starts_with(|c: char| c.is_ascii_digit() || "+-.".contains(c))
        {
            return self.one_of(path, text, &span, words).map(Scalar::Word);
        }
        self.measure(path, &raw, &span, kind).map(Scalar::Measure)
    }

    /// true or false.
    pub(super) fn switch(&mut self, path: &str) -> Option<bool> {
        let (raw, span, kind) = self.raw(path)?;
        if let Raw::Switch(value) = raw {
            return Some(value);
        }
        self.unexpected(path, &raw, &span, kind);
        None
    }

    /// Two rising fractions.
    pub(super) fn interval(&mut self, path: &str) -> Option<[f64; 2]> {
        let (raw, span, kind) = self.raw(path)?;
        let Raw::Array(items) = &raw else {
            self.unexpected(path, &raw, &span, kind);
            return None;
        };
        let [(from, from_span), (to, to_span)] = &items[..] else {
            self.unexpected(path, &raw, &span, kind);
            return None;
        };
        let from = self.measure(path, from, from_span, kind)?.value;
        let to = self.measure(path, to, to_span, kind)?.value;
        if (0.0..=1.0).contains(&from) && (from..=1.0).contains(&to) {
            return Some([from, to]);
        }
        self.problem(
            "E124",
            path,
            &span,
            format!("{path} is {from} to {to}"),
            format!("Expected {}, rising, within 0 and 1.", expected(kind)),
        );
        None
    }

    /// Plain numbers of a list; every bad item is reported.
    pub(super) fn numbers(&mut self, path: &str) -> Option<Vec<f64>> {
        let (raw, span, kind) = self.raw(path)?;
        let Raw::Array(items) = &raw else {
            self.unexpected(path, &raw, &span, kind);
            return None;
        };
        let mut numbers = Vec::with_capacity(items.len());
        for (item, at) in items {
            match item {
                Raw::Number(value) if value.is_finite() => numbers.push(*value),
                other => self.unexpected(path, other, at, Kind::Number),
            }
        }
        (numbers.len() == items.len()).then_some(numbers)
    }

    /// Froude numbers of at most 2, and at most 60 of them.
    pub(super) fn froude_numbers(&mut self, path: &str) -> Option<Vec<f64>> {
        let list = self.positions(path)?;
        if (1..=60).contains(&list.len()) && list.iter().all(|number| (0.05..=2.0).contains(number)) {
            return Some(list);
        }
        let span = self.entry(path).map_or(0..0, |e| e.span.clone());
        let message =
            format!("{path} has {} numbers, {:?} the first", list.len(), list.first().copied().unwrap_or(0.0));
        let help = "Expected 1 to 60 Froude numbers of 0.05 to 2, as \"0.25:0.30:0.01\".".to_owned();
        self.problem("E124", path, &span, message, help);
        None
    }

    /// Positions \[m\] of a list.
    pub(super) fn positions(&mut self, path: &str) -> Option<Vec<f64>> {
        let (raw, span, kind) = self.raw(path)?;
        let list = match &raw {
            Raw::Text(text) => units::parse_list(text).map_err(|error| error.to_string()),
            Raw::Number(_) => Ok(vec![self.measure(path, &raw, &span, kind)?.value]),
            Raw::Array(items) if items.len() > units::MAX_ITEMS => Err(units::ListError::TooLong.to_string()),
            Raw::Array(items) if items.is_empty() => Err(units::ListError::Empty.to_string()),
            Raw::Array(items) => {
                // Every bad item is reported, so the list is read to its end.
                let values: Vec<Option<f64>> =
                    items.iter().map(|(item, at)| self.measure(path, item, at, kind).map(|m| m.value)).collect();
                Ok(values.into_iter().collect::<Option<Vec<f64>>>()?)
            }
            Raw::Table(fields) => {
                let numbers = self.fields(path, fields, ["from", "to", "step"], kind)?;
                match numbers {
                    [Some(from), Some(to), Some(step)] => {
                        units::parse_list(&format!("{from}:{to}:{step}")).map_err(|e| e.to_string())
                    }
                    _ => Err("from, to and step are all needed".into()),
                }
            }
            Raw::Switch(_) | Raw::Other(_) => {
                self.unexpected(path, &raw, &span, kind);
                return None;
            }
        };
        match list {
            Ok(list) => Some(list),
            Err(message) => {
                self.problem(
                    "E123",
                    path,
                    &span,
                    format!("{path}: {message}"),
                    format!("Expected {}.", expected(kind)),
                );
                None
            }
        }
    }

    /// The numbers of the named fields of an inline table; none when a field is unknown or bad.
    pub(super) fn fields<const N: usize>(
        &mut self,
        path: &str,
        fields: &[(String, Raw, Range<usize>)],
        names: [&'static str; N],
        kind: Kind,
    ) -> Option<[Option<f64>; N]> {
        let mut values = [None; N];
        let mut good = true;
        for (name, raw, span) in fields {
            match names.iter().position(|known| known.eq_ignore_ascii_case(name)) {
                Some(index) => {
                    values[index] = self.measure(&format!("{path}.{name}"), raw, span, kind).map(|m| m.value);
                    good &= values[index].is_some();
                }
                None => {
                    good = false;
                    let help = match nearest(name, names.iter().copied()) {
                        Some(near) => format!("Did you mean {near}?"),
                        None => format!("Known here: {}.", names.join(", ")),
                    };
                    self.problem("E121", path, span, format!("{path}.{name} is not a key of {}", self.noun), help);
                }
            }
        }
        good.then_some(values)
    }
}
