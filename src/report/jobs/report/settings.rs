//! What a report is made with.

use crate::plot::Sheet;

/// What a report is made with.
#[derive(Debug, Clone, PartialEq)]
pub struct ReportSettings {
    /// Resolution of the pictures \[dots per inch\].
    pub dots_per_inch: f64,
    /// Sheet of the PDF; drawings that have a scale are made as large as it lets them be.
    pub sheet: Sheet,
    /// Lines that bear combs, as `waterline 2.0, station 5`; empty: some of all.
    pub combs: String,
    /// Date for the title blocks, as it is to stand there; none is taken from the clock.
    pub date: Option<String>,
}

impl Default for ReportSettings {
    fn default() -> Self {
        Self { dots_per_inch: 150.0, sheet: Sheet::A3, combs: String::new(), date: None }
    }
}
