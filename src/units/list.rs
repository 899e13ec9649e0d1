//! Lists of lengths: `1:9:1` (from, to, step, both ends), `1,2.5,4`, `0,5,...,30,40,...,90`; every number may carry a
//! unit.

use super::quantity::{UnitError, parse_length};

/// The most items that a list may have.
pub const MAX_ITEMS: usize = 10_000;

/// Why a text is not a list.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ListError {
    /// An item that is not a length.
    #[error("item {item}: {error}")]
    Item {
        /// Number of the item, from 1.
        item: usize,
        /// What is wrong with it.
        error: UnitError,
    },
    /// No item at all.
    #[error("the list is empty; write 1:9:1, 1,2.5,4 or 0,5,...,30")]
    Empty,
    /// A range with other than three numbers.
    #[error("item {item}: a range is from:to:step, as 1:9:1")]
    Range {
        /// Number of the item, from 1.
        item: usize,
    },
    /// A step that does not lead from the first number to the last.
    #[error("item {item}: a step of {step} does not lead from {from} to {to}")]
    Step {
        /// Number of the item, from 1.
        item: usize,
        /// From.
        from: f64,
        /// To.
        to: f64,
        /// Step.
        step: f64,
    },
    /// Dots without two numbers before and one after them.
    #[error("item {item}: '...' needs two numbers before it and one after it, as 0,5,...,30")]
    Dots {
        /// Number of the item, from 1.
        item: usize,
    },
    /// Too many items.
    #[error("the list has more than {MAX_ITEMS} items")]
    TooLong,
}

/// The multiple of 1e-9 that a sum or product of decimal fractions means, when it is one to 1e-13 of itself; otherwise
/// the value.
#[must_use]
pub fn decimal(value: f64) -> f64 {
    let rounded = (value * 1e9).round() / 1e9;
    if (rounded - value).abs() <= 1e-13 * value.abs().max(1.0) { rounded } else { value }
}

/// Appends from + step, from + 2 step, ..., `to`; both ends belong to the range, so that a last shorter step may occur.
fn extend(list: &mut Vec<f64>, item: usize, from: f64, to: f64, step: f64) -> Result<(), ListError> {
    let count = (to - from) / step;
    if !count.is_finite() || count < 0.0 {
        return Err(ListError::Step { item, from, to, step });
    }
    if count > MAX_ITEMS as f64 {
        return Err(ListError::TooLong);
    }
    let mut k = 1.0;
    while k < count - 1e-9 {
        list.push(decimal(from + k * step));
        k += 1.0;
    }
    if count > 1e-9 {
        list.push(to);
    }
    Ok(())
}

/// The lengths \[m\] of a list, in the order written.
///
/// # Errors
/// [`ListError`] naming the item.
pub fn parse_list(text: &str) -> Result<Vec<f64>, ListError> {
    let mut list: Vec<f64> = Vec::new();
    let mut dots = None;
    if text.trim().is_empty() {
        return Err(ListError::Empty);
    }
    for (index, raw) in text.split(',').enumerate() {
        let item = index + 1;
        let length = |text: &str| parse_length(text).map_err(|error| ListError::Item { item, error });
        let raw = raw.trim();
        if raw == "..." || raw == "\u{2026}" {
            if list.len() < 2 || dots.is_some() {
                return Err(ListError::Dots { item });
            }
            dots = Some(item);
            continue;
        }
        if list.len() > MAX_ITEMS {
            return Err(ListError::TooLong);
        }
        let fields: Vec<&str> = raw.splitn(4, ':').collect();
        match (&fields[..], dots.take()) {
            ([one], None) => list.push(length(one)?),
            ([one], Some(_)) => {
                let (to, last) = (length(one)?, list[list.len() - 1]);
                let step = decimal(last - list[list.len() - 2]);
                extend(&mut list, item, last, to, step)?;
            }
            ([from, to, step], None) => {
                let (from, to, step) = (length(from)?, length(to)?, length(step)?);
                list.push(from);
                extend(&mut list, item, from, to, step)?;
            }
            (_, Some(at)) => return Err(ListError::Dots { item: at }),
            _ => return Err(ListError::Range { item }),
        }
    }
    match dots {
        Some(item) => Err(ListError::Dots { item }),
        None if list.len() > MAX_ITEMS => Err(ListError::TooLong),
        None => Ok(list),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_of_every_form() {
        assert_eq!(parse_list("1:9:1").unwrap(), [1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0]);
        assert_eq!(parse_list("1,2.5,4").unwrap(), [1.0, 2.5, 4.0]);
        assert_eq!(parse_list("0,5,...,20,30,...,50").unwrap(), [0.0, 5.0, 10.0, 15.0, 20.0, 30.0, 40.0, 50.0]);
        assert_eq!(parse_list("0.1:0.5:0.1").unwrap(), [0.1, 0.2, 0.3, 0.4, 0.5]);
        assert_eq!(parse_list("1:2.2:0.5").unwrap(), [1.0, 1.5, 2.0, 2.2]);
        assert_eq!(parse_list("6150 mm, 1 m").unwrap(), [6.15, 1.0]);
        assert_eq!(parse_list("9:1:-4").unwrap(), [9.0, 5.0, 1.0]);
        assert_eq!(parse_list("3:3:1").unwrap(), [3.0]);
    }

    #[test]
    fn steps_are_the_decimals_that_are_meant() {
        let shown = |x: f64| format!("{}", decimal(x));
        assert_eq!((shown(21.04 * 12.0 / 20.0), shown(1.1 * 1.5)), ("12.624".to_owned(), "1.65".to_owned()));
        let third = 1.0 / 3.0;
        assert_eq!(decimal(third).to_bits(), third.to_bits());
    }

    #[test]
    fn every_message() {
        let message = |text: &str| parse_list(text).unwrap_err().to_string();
        assert!(message("").starts_with("the list is empty"));
        assert_eq!(message("1,x"), "item 2: 'x' is not a number");
        assert_eq!(message("1:2"), "item 1: a range is from:to:step, as 1:9:1");
        assert_eq!(message("1:9:-1"), "item 1: a step of -1 does not lead from 1 to 9");
        assert_eq!(message("1:9:0"), "item 1: a step of 0 does not lead from 1 to 9");
        assert_eq!(message("1,...,9"), "item 2: '...' needs two numbers before it and one after it, as 0,5,...,30");
        assert_eq!(message("1,2,..."), "item 3: '...' needs two numbers before it and one after it, as 0,5,...,30");
        assert_eq!(message("0:1e9:1"), "the list has more than 10000 items");
    }
}
