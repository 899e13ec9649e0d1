//! The pictures of `fair`: before and after with combs, the map of moves, the search for the smoothing weight.

use super::failure::Failure;
use super::files::OutputFile;
use crate::fairing::record::FairRecord;
use crate::plot::{
    FairingCombs, PlotError, Sheet, Svg, fairing_body_plan, fairing_half_breadth_plan, fairing_moves, smoothing_figure,
};

/// Resolution of the pictures \[dots per inch\]: about 2600 pixels across.
const DOTS_PER_INCH: f64 = 160.0;

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
pub(super) fn fair_figures(record: &FairRecord) -> Result<Vec<OutputFile>, Failure> {
    let combs = FairingCombs::new(record, &[]);
    let mut files = Vec::new();
    for (name, draw) in PICTURES {
        files.extend(pictures(name, draw(record, &combs))?);
    }
    Ok(files)
}

/// The files of the sheets of a picture.
pub(super) fn pictures(
    name: &str,
    sheets: Result<impl IntoIterator<Item = Svg>, PlotError>,
) -> Result<Vec<OutputFile>, Failure> {
    let failure = |error: PlotError| Failure::Internal(format!("{name}: {error}"));
    let mut files = Vec::new();
    for (k, svg) in sheets.map_err(failure)?.into_iter().enumerate() {
        let name = if k == 0 { name.to_owned() } else { format!("{name}-{}", k + 1) };
        let contents = svg.to_png(DOTS_PER_INCH).map_err(failure)?;
        files.push(OutputFile { name: format!("{name}.png"), contents });
        files.push(OutputFile::text(&format!("{name}.svg"), svg.as_str().to_owned()));
    }
    Ok(files)
}
