//! What is agreed about a table beside its numbers.

use super::header::From;
use crate::hull::{Rows, StatedParticulars, TableLayout};
use crate::units::Notation;

/// How the positions of stations are to be understood.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct StationScale {
    pub(super) from: From,
    /// Station numbers instead of distances.
    pub(super) numbers: bool,
}

/// The conventions of one table; whatever is not said is found in the table.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Settings {
    pub(super) name: Option<String>,
    pub(super) stated: StatedParticulars,
    pub(super) units: Option<Notation>,
    pub(super) x_units: Option<Notation>,
    pub(super) z_units: Option<Notation>,
    /// Full breadths.
    pub(super) full: Option<bool>,
    pub(super) rows: Option<Rows>,
    pub(super) layout: Option<TableLayout>,
    pub(super) stations: Option<StationScale>,
    pub(super) station_spacing: Option<f64>,
    pub(super) waterline_spacing: Option<f64>,
    pub(super) spaces: Option<f64>,
    pub(super) separator: Option<char>,
    pub(super) decimal_comma: Option<bool>,
}

/// What a header that cannot be read may have been meant to be.
pub(super) fn suggestion(text: &str) -> String {
    let names = super::header::SIDES.iter().map(|(name, _)| *name);
    let word = text.to_lowercase();
    let near = names.map(|name| (strsim::osa_distance(&word, name), name)).min();
    match near {
        Some((distance, name)) if distance <= 1 + name.len() / 4 => format!("Did you mean '{name}'?"),
        _ => "Write a number, or words with a number, as WL 3 (1.50 m)".to_owned(),
    }
}
