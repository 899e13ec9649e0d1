//! Bracketed roots of a function of one variable: Brent's method, from argmin.

use argmin::core::{CostFunction, Executor, State};
use argmin::solver::brent::BrentRoot;
use std::cell::Cell;

/// Why no root was found.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum RootError {
    /// The values at the ends have one sign.
    #[error("no sign change between {low} (value {at_low}) and {high} (value {at_high})")]
    NoSignChange {
        /// Lower end of the bracket.
        low: f64,
        /// Value at the lower end.
        at_low: f64,
        /// Upper end of the bracket.
        high: f64,
        /// Value at the upper end.
        at_high: f64,
    },
    /// The function returned a value that is not finite.
    #[error("the function is not finite at {at}")]
    NotFinite {
        /// Where.
        at: f64,
    },
}

struct Function<'a, F> {
    value: &'a F,
    bad: &'a Cell<Option<f64>>,
}

impl<F: Fn(f64) -> f64> CostFunction for Function<'_, F> {
    type Param = f64;
    type Output = f64;

    fn cost(&self, at: &f64) -> Result<f64, argmin::core::Error> {
        let value = (self.value)(*at);
        if value.is_finite() {
            Ok(value)
        } else {
            self.bad.set(Some(*at));
            Err(argmin::core::Error::msg("not finite"))
        }
    }
}

/// The root of `function` between `low` and `high` to an error of `tolerance` in the argument (Brent 1973, chapter 4).
/// An end at which the value is zero is returned as it is.
///
/// # Errors
/// [`RootError::NoSignChange`] when the ends do not bracket a root, [`RootError::NotFinite`] when a value is not finite.
pub fn bracketed_root(function: impl Fn(f64) -> f64, low: f64, high: f64, tolerance: f64) -> Result<f64, RootError> {
    let (at_low, at_high) = (function(low), function(high));
    for (at, value) in [(low, at_low), (high, at_high)] {
        if !value.is_finite() {
            return Err(RootError::NotFinite { at });
        }
        if value == 0.0 {
            return Ok(at);
        }
    }
    if (at_low > 0.0) == (at_high > 0.0) {
        return Err(RootError::NoSignChange { low, at_low, high, at_high });
    }
    let bad = Cell::new(None);
    let problem = Function { value: &function, bad: &bad };
    let result = Executor::new(problem, BrentRoot::new(low, high, tolerance))
        .configure(|state| state.max_iters(200))
        .timer(false)
        .run();
    match (bad.get(), result) {
        (Some(at), _) => Err(RootError::NotFinite { at }),
        (None, Ok(found)) => Ok(found.state().get_best_param().copied().unwrap_or(low)),
        (None, Err(_)) => Err(RootError::NoSignChange { low, at_low, high, at_high }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_the_root_to_the_tolerance() {
        let root = bracketed_root(|x| x * x * x - 2.0, 0.0, 3.0, 1e-14).unwrap();
        assert!((root - 2f64.cbrt()).abs() < 1e-13, "{root}");
    }

    #[test]
    fn an_end_may_be_the_root() {
        assert_eq!(bracketed_root(|x| x, 0.0, 1.0, 1e-12).unwrap().to_bits(), 0.0f64.to_bits());
    }

    #[test]
    fn no_bracket_and_no_number_are_errors() {
        assert!(matches!(bracketed_root(|x| x + 5.0, 0.0, 1.0, 1e-9), Err(RootError::NoSignChange { .. })));
        assert!(matches!(
            bracketed_root(
                |x| if x.abs() < 1e-9 || (x - 2.0).abs() < 1e-9 { x - 1.0 } else { f64::NAN },
                0.0,
                2.0,
                1e-9
            ),
            Err(RootError::NotFinite { .. })
        ));
    }
}
