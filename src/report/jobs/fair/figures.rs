//! The pictures of `fair`: before and after with combs, the map of moves, the search for the smoothing weight.

use crate::fairing::record::FairRecord;
use crate::plot::{
    FairingCombs, PlotError, Sheet, Svg, fairing_body_plan, fairing_half_breadth_plan, fairing_moves, smoothing_figure,
};
use crate::report::failure::Failure;
use crate::report::output::files::OutputFile;
pub(in crate::report) use crate::report::output::pictures::pictures;

/// The sheets of a picture of a faired table; none where there is nothing to draw.
type Draw = fn(&FairRecord, &FairingCombs) -> Result<Vec<Svg>, PlotError>;

/// The pictures with their names.
const PICTURES: [(&str, Draw); 4] = [
    ("fairing-body-plan", |record, combs| fairing_body_plan(record, combs, Sheet::A3).map(|svg| vec![svg])),
    ("fairing-half-breadth-plan", |record, combs| fairing_half_breadth_plan(record, combs, Sheet::A3)),
    ("fairing-moves", |record, _| fairing_moves(record).map(|svg| vec![svg])),
    ("lcurve", |record, _| Ok(smoothing_figure(record)?.into_iter().collect())),
];

/// The pictures of a fair hull, each as SVG and PNG; the second sheet of one has the number 2 behind its name.
pub(in crate::report) fn fair_figures(record: &FairRecord) -> Result<Vec<OutputFile>, Failure> {
    let combs = FairingCombs::new(record, &[]);
    let mut files = Vec::new();
    for (name, draw) in PICTURES {
        files.extend(pictures(name, draw(record, &combs))?);
    }
    Ok(files)
}
