//! The pictures of `fair`: before and after with combs, and the map of moves.

use super::failure::Failure;
use super::files::OutputFile;
use crate::fairing::job::Outcome;
use crate::hull::OffsetTable;
use crate::plot::{PlotError, Svg, fairing_body_plan, fairing_half_breadth_plan, fairing_moves};

/// Resolution of the pictures \[dots per inch\]: about 2600 pixels across.
const DOTS_PER_INCH: f64 = 160.0;

/// A picture of a table and its outcome.
type Draw = fn(&OffsetTable, &Outcome) -> Result<Svg, PlotError>;

/// The pictures with their names.
const PICTURES: [(&str, Draw); 3] = [
    ("fairing-body-plan", fairing_body_plan),
    ("fairing-half-breadth-plan", fairing_half_breadth_plan),
    ("fairing-moves", fairing_moves),
];

/// The pictures of a fair hull, each as SVG and PNG.
pub(super) fn fair_figures(table: &OffsetTable, outcome: &Outcome) -> Result<Vec<OutputFile>, Failure> {
    let mut files = Vec::new();
    for (name, draw) in PICTURES {
        let failure = |error: PlotError| Failure::Internal(format!("{name}: {error}"));
        let svg = draw(table, outcome).map_err(failure)?;
        let contents = svg.to_png(DOTS_PER_INCH).map_err(failure)?;
        files.push(OutputFile { name: format!("{name}.png"), contents });
        files.push(OutputFile::text(&format!("{name}.svg"), svg.as_str().to_owned()));
    }
    Ok(files)
}
