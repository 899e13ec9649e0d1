//! What the single values of a job may be.

use super::super::document::Document;
use super::super::value::Scalar;
use crate::fairing::strength::Fairness;
use crate::hydrostatics::DENSITIES;

/// A value where it is allowed; otherwise the message names what was expected.
pub(super) fn allowed(
    document: &mut Document<'_>,
    path: &str,
    value: f64,
    allowed: bool,
    expected: &str,
) -> Option<f64> {
    if allowed {
        return Some(value);
    }
    let span = document.entry(path).map_or(0..0, |e| e.span.clone());
    let found = format!("{value:?}");
    let message = format!("{path} is {}", found.trim_end_matches(".0"));
    document.problem("E124", path, &span, message, format!("Expected {expected}."));
    None
}

/// A number above 0.
pub(super) fn positive(document: &mut Document<'_>, path: &str, noun: &str) -> Option<f64> {
    let value = document.number(path)?;
    allowed(document, path, value, value > 0.0, &format!("a positive {noun}"))
}

/// Greatest main dimension \[m\], as of a table.
const MOST_LENGTH: f64 = 1e5;

/// A main dimension.
pub(super) fn dimension(document: &mut Document<'_>, path: &str) -> Option<f64> {
    let value = document.number(path)?;
    let expected = format!("a positive length below {MOST_LENGTH} m");
    allowed(document, path, value, value > 0.0 && value < MOST_LENGTH, &expected)
}

/// The density of a water.
pub(super) fn density(document: &mut Document<'_>) -> Option<f64> {
    let value = document.number("water.density")?;
    let expected = format!("{} to {} t/m3", DENSITIES.start(), DENSITIES.end());
    allowed(document, "water.density", value, DENSITIES.contains(&value), &expected)
}

/// Greatest price of a sign: no sign that the tolerances have is as dear.
const MOST_PRICE: f64 = 1e6;

/// What a sign may cost.
pub(super) fn price(document: &mut Document<'_>) -> Option<f64> {
    let value = document.number("inflections.cost")?;
    let expected = format!("a positive number, {MOST_PRICE:.0e} at most");
    allowed(document, "inflections.cost", value, value > 0.0 && value <= MOST_PRICE, &expected)
}

/// A grade of fairness, by number or name.
pub(super) fn fairness(document: &mut Document<'_>) -> Option<Fairness> {
    match document.number_or_word("fairness")? {
        Scalar::Measure(measure) => {
            let grade = Fairness::new(measure.value);
            allowed(document, "fairness", measure.value, grade.is_some(), "a number from 0 to 10")?;
            grade
        }
        Scalar::Word(name) => Fairness::named(name),
    }
}

/// Greatest smoothing weight: nothing but the energy is left well below it.
const MOST_WEIGHT: f64 = 1e9;

pub(super) fn weight(document: &mut Document<'_>) -> Option<Option<f64>> {
    let Scalar::Measure(measure) = document.number_or_word("energy.weight")? else { return Some(None) };
    let sensible = measure.value > 0.0 && measure.value <= MOST_WEIGHT;
    let expected = format!("a positive number, {MOST_WEIGHT:.0e} at most, or \"auto\"");
    allowed(document, "energy.weight", measure.value, sensible, &expected).map(Some)
}
