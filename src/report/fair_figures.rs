//! The pictures of `fair`: before and after with combs, the map of moves, the search for the smoothing weight.

use super::failure::Failure;
use super::files::OutputFile;
use crate::fairing::job::Outcome;
use crate::hull::OffsetTable;
use crate::plot::{PlotError, Svg, fairing_body_plan, fairing_half_breadth_plan, fairing_moves, smoothing_figure};

/// Resolution of the pictures \[dots per inch\]: about 2600 pixels across.
const DOTS_PER_INCH: f64 = 160.0;

/// A picture of a table and its outcome; none where there is nothing to draw.
type Draw = fn(&OffsetTable, &Outcome) -> Result<Option<Svg>, PlotError>;

/// The pictures with their names.
const PICTURES: [(&str, Draw); 4] = [
    ("fairing-body-plan", |table, outcome| fairing_body_plan(table, outcome).map(Some)),
    ("fairing-half-breadth-plan", |table, outcome| fairing_half_breadth_plan(table, outcome).map(Some)),
    ("fairing-moves", |table, outcome| fairing_moves(table, outcome).map(Some)),
    ("lcurve", smoothing_figure),
];

/// The pictures of a fair hull, each as SVG and PNG.
pub(super) fn fair_figures(table: &OffsetTable, outcome: &Outcome) -> Result<Vec<OutputFile>, Failure> {
    let mut files = Vec::new();
    for (name, draw) in PICTURES {
        let failure = |error: PlotError| Failure::Internal(format!("{name}: {error}"));
        let Some(svg) = draw(table, outcome).map_err(failure)? else { continue };
        let contents = svg.to_png(DOTS_PER_INCH).map_err(failure)?;
        files.push(OutputFile { name: format!("{name}.png"), contents });
        files.push(OutputFile::text(&format!("{name}.svg"), svg.as_str().to_owned()));
    }
    Ok(files)
}
