//! Why there is no daughter, with numbers.

use std::fmt;

/// A target that no daughter meets, or a value that no ship has.
#[derive(Debug, Clone, PartialEq)]
pub struct Refusal {
    /// Code of the message.
    pub code: &'static str,
    /// Words of the targets that conflict, as of [`super::Quantity::word`]; the first is shown.
    pub words: Vec<&'static str>,
    /// What, with numbers.
    pub message: String,
    /// What helps, with the nearest feasible value.
    pub remedy: String,
}

impl Refusal {
    pub(super) fn new(code: &'static str, words: Vec<&'static str>, message: String, remedy: String) -> Self {
        Self { code, words, message, remedy }
    }

    pub(super) fn no_draught() -> Self {
        let message = "the parent states no draught, to which displacement and coefficients refer".to_owned();
        Self::new("E184", vec!["draught"], message, "Give its draught with --parent-draught".to_owned())
    }

    pub(super) fn depth(found: f64, least: f64, draught: f64) -> Self {
        let message =
            format!("the depth {found:.3} m does not go with the draught {draught:.3} m: more than {least:.3} m");
        let remedy = format!("Give a depth above {least:.3} m, or a lesser draught");
        Self::new("E420", vec!["depth", "draught"], message, remedy)
    }

    pub(super) fn hull(error: &impl fmt::Display) -> Self {
        let message = format!("the daughter is no hull: {error}");
        Self::new("E420", vec![], message, "Give targets nearer to the parent".to_owned())
    }
}
