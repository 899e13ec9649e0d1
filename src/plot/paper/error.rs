//! Why a figure could not be drawn.

/// Why a figure could not be drawn.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum PlotError {
    /// The table of hydrostatics has fewer than two draughts.
    #[error("curves need hydrostatics at two draughts at least; there are {0}")]
    TooFewDraughts(usize),
    /// The figure is one at the design draught, and none is stated.
    #[error("the figure is one at the design draught: give --draught")]
    NoDraught,
    /// The axes of a chart could not be drawn.
    #[error("the chart could not be drawn: {0}")]
    Chart(String),
    /// The document is not SVG.
    #[error("the drawing could not be read: {0}")]
    Svg(String),
    /// The picture is empty or too large.
    #[error(
        "a picture of {width} x {height} pixels ({dots_per_inch} dots per inch) cannot be made; sides from 1 to 20000"
    )]
    PictureSize {
        /// Resolution asked for.
        dots_per_inch: f64,
        /// Width, in pixels.
        width: f64,
        /// Height, in pixels.
        height: f64,
    },
    /// The PDF could not be written.
    #[error("the PDF could not be written: {0}")]
    Pdf(String),
    /// The library was built without a feature.
    #[error("this needs the feature `{0}` of the library")]
    Feature(&'static str),
    /// The picture could not be packed.
    #[error("the picture could not be written as PNG: {0}")]
    Png(String),
}
