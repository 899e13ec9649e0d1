//! The sheets of a picture as files.

use super::files::OutputFile;
use crate::plot::{PlotError, Svg};
use crate::report::failure::Failure;

/// Resolution of the pictures \[dots per inch\]: about 2600 pixels across.
const DOTS_PER_INCH: f64 = 160.0;

/// The files of the sheets of a picture.
pub(in crate::report) fn pictures(
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
