//! The pictures of `fair`: before and after with combs, the map of moves, the search for the smoothing weight.

use super::failure::Failure;
use super::files::OutputFile;
use crate::fairing::record::FairRecord;
use crate::plot::{
    FairingCombs, PlotError, Sheet, Svg, fairing_body_plan, fairing_half_breadth_plan, fairing_moves, smoothing_figure,
};

/// Resolution of the pictures \[dots per inch\]: about 2600 pixels across.
const DOTS_PER_INCH: f64 = 160.0;

/// A picture of a faired table; none where there is nothing to draw.
type Draw = fn(&FairRecord, &FairingCombs) -> Result<Option<Svg>, PlotError>;

/// The pictures with their names.
const PICTURES: [(&str, Draw); 4] = [
    ("fairing-body-plan", |record, combs| fairing_body_plan(record, combs, Sheet::A3).map(Some)),
    ("fairing-half-breadth-plan", |record, combs| fairing_half_breadth_plan(record, combs, Sheet::A3).map(Some)),
    ("fairing-moves", |record, _| fairing_moves(record).map(Some)),
    ("lcurve", |record, _| smoothing_figure(record)),
];

/// The pictures of a fair hull, each as SVG and PNG.
pub(super) fn fair_figures(record: &FairRecord) -> Result<Vec<OutputFile>, Failure> {
    let combs = FairingCombs::new(record, &[]);
    let mut files = Vec::new();
    for (name, draw) in PICTURES {
        let failure = |error: PlotError| Failure::Internal(format!("{name}: {error}"));
        let Some(svg) = draw(record, &combs).map_err(failure)? else { continue };
        let contents = svg.to_png(DOTS_PER_INCH).map_err(failure)?;
        files.push(OutputFile { name: format!("{name}.png"), contents });
        files.push(OutputFile::text(&format!("{name}.svg"), svg.as_str().to_owned()));
    }
    Ok(files)
}
