//! The list of figures, what they are made of, and the finished drawing.

use super::canvas::Canvas;
use super::png::Drawing;
use super::sheet::Sheet;
use super::{diagram_sheet, hydrostatics, lines, outline, png, sectional_area, sections};
use crate::fairing::record::FairRecord;
use crate::hull::Hull;
use crate::hydrostatics::{CurvesOfForm, Hydrostatics};
use std::fmt;
use std::sync::{Arc, OnceLock};

/// How far a table goes beyond the deck edge before its curves end there, as a part of its range.
const EDGE: f64 = 1e-3;

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

/// What figures are made of.
#[derive(Debug, Clone, Copy)]
pub struct FigureInputs<'a> {
    /// The hull.
    pub hull: &'a Hull,
    /// The hull before fairing, drawn in grey under it; none where there is none.
    pub before: Option<&'a Hull>,
    /// The faired table that the hull comes from, where there is one: what lies beyond its offsets is dashed.
    pub record: Option<&'a FairRecord>,
    /// Hydrostatics at the design draught; none where no draught is stated.
    pub design: Option<&'a Hydrostatics>,
    /// Hydrostatics over the draughts of interest: their range and conventions.
    pub curves: &'a CurvesOfForm,
    /// What the hull was read from, for title blocks: name of the file and the first digits of its SHA-256.
    pub source: Option<&'a str>,
    /// Where hydrostatics at many draughts are kept for all figures of the same inputs.
    pub dense: Option<&'a OnceLock<Vec<Hydrostatics>>>,
}

impl FigureInputs<'_> {
    /// Least and largest draught of the table \[m\].
    fn range(&self) -> [f64; 2] {
        let draughts = self.curves.rows.iter().map(|row| row.draught).filter(|draught| draught.is_finite());
        draughts.fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], d| [a.min(d), b.max(d)])
    }

    /// The draught at which `rows` of [`FigureInputs::dense_rows`] end, where it is that at which the deck edge goes
    /// under \[m\]; none where they go as far as the table.
    pub(super) fn immersed_edge(&self, rows: &[Hydrostatics]) -> Option<f64> {
        let [low, high] = self.range();
        rows.last().map(|row| row.draught).filter(|edge| *edge < high - EDGE * (high - low))
    }

    /// Hydrostatics over the range of draughts of the table, so dense that curves through them look smooth; up to the
    /// lowest point of the deck edge, where the table goes beyond it: form without a superstructure says nothing there.
    pub(super) fn dense_rows(&self) -> Result<Vec<Hydrostatics>, PlotError> {
        const ROWS: usize = 120;
        let [low, high] = self.range();
        if low >= high {
            return Err(PlotError::TooFewDraughts(self.curves.rows.len().min(1)));
        }
        let rows = || {
            let edge = outline::lowest_deck_edge(self.hull);
            let end = if low < edge && edge < high - EDGE * (high - low) { edge } else { high };
            let draughts: Vec<f64> = (0..ROWS).map(|k| low + (end - low) * k as f64 / (ROWS - 1) as f64).collect();
            CurvesOfForm::new(self.hull, &draughts, &self.curves.conventions).rows
        };
        Ok(self.dense.map_or_else(rows, |kept| kept.get_or_init(rows).clone()))
    }
}

/// A finished drawing.
#[derive(Clone)]
pub struct Svg {
    text: String,
    /// As it was read for a picture or a document.
    tree: OnceLock<Arc<Drawing>>,
}

impl fmt::Debug for Svg {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.debug_struct("Svg").field("text", &self.text).finish()
    }
}

impl PartialEq for Svg {
    fn eq(&self, other: &Self) -> bool {
        self.text == other.text
    }
}

impl Svg {
    pub(super) fn new(text: String) -> Self {
        Self { text, tree: OnceLock::new() }
    }

    /// The drawing as resvg reads it, which takes as long as some pictures do: once.
    pub(super) fn tree(&self) -> Result<Arc<Drawing>, PlotError> {
        if let Some(tree) = self.tree.get() {
            return Ok(Arc::clone(tree));
        }
        let tree = Arc::new(png::tree(&self.text)?);
        Ok(Arc::clone(self.tree.get_or_init(|| tree)))
    }

    /// The SVG document; its size is in millimetres.
    #[must_use]
    pub fn as_str(&self) -> &str {
        &self.text
    }

    /// The drawing as PNG at `dots_per_inch`.
    ///
    /// # Errors
    /// [`PlotError::PictureSize`] when the picture would be empty or have a side of more than 20000 pixels.
    pub fn to_png(&self, dots_per_inch: f64) -> Result<Vec<u8>, PlotError> {
        png::render(self.tree()?.as_ref(), dots_per_inch)
    }
}

/// The figures.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Figure {
    /// Profile, half-breadth plan and body plan on one sheet.
    Lines,
    /// The body plan alone.
    Sections,
    /// Section areas along the hull at the design draught.
    SectionalArea,
    /// Hydrostatic curves in panels.
    Hydrostatics,
    /// The classic sheet of hydrostatic curves with a scale for each.
    DiagramSheet,
}

impl Figure {
    /// Every figure.
    pub const ALL: [Self; 5] =
        [Self::Lines, Self::Sections, Self::SectionalArea, Self::Hydrostatics, Self::DiagramSheet];

    /// Stem of the file name, and the word in lists of figures.
    #[must_use]
    pub fn key(self) -> &'static str {
        match self {
            Self::Lines => "lines",
            Self::Sections => "sections",
            Self::SectionalArea => "sectional-area",
            Self::Hydrostatics => "hydrostatics",
            Self::DiagramSheet => "diagram-sheet",
        }
    }

    /// Whether the figure is one at the design draught, so that there is none without.
    #[must_use]
    pub fn needs_draught(self) -> bool {
        self == Self::SectionalArea
    }

    /// Resolution at which the picture of the figure is read well on a screen: about 3300 pixels across for the lines
    /// plan, 1800 to 2000 for the others.
    #[must_use]
    pub fn dots_per_inch(self) -> f64 {
        match self {
            Self::Lines => 200.0,
            Self::Sections => 180.0,
            Self::SectionalArea | Self::Hydrostatics => 154.0,
            Self::DiagramSheet => 140.0,
        }
    }

    /// Draws the figure.
    ///
    /// ```
    /// use loftsman::internals::hydrostatics::{Conventions, CurvesOfForm};
    /// use loftsman::internals::parametric::analytic::{Dimensions, wigley};
    /// use loftsman::internals::plot::{Figure, FigureInputs};
    ///
    /// let dimensions = Dimensions { length: 100.0, breadth: 10.0, draught: 6.25, depth: 9.0 };
    /// let hull = wigley("Wigley", &dimensions).map_err(|_| "dimensions out of range")?.hull;
    /// let conventions = Conventions::default();
    /// let design = CurvesOfForm::new(&hull, &[6.25], &conventions);
    /// let curves = CurvesOfForm::new(&hull, &[1.25, 9.0], &conventions);
    /// let inputs = FigureInputs { hull: &hull, before: None, record: None, design: design.rows.first(), curves: &curves, source: None, dense: None };
    /// let lines = Figure::Lines.draw(&inputs)?;
    /// assert!(lines.as_str().starts_with("<svg"));
    /// assert!(lines.to_png(Figure::Lines.dots_per_inch())?.starts_with(b"\x89PNG"));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`PlotError`] when there is nothing to draw.
    pub fn draw(self, inputs: &FigureInputs) -> Result<Svg, PlotError> {
        Ok(Svg::new(self.compose(inputs)?.finish(self.key())))
    }

    /// Draws the figure as large as `sheet` lets it be; only lines plan and body plan, which have a scale, become
    /// larger than on A3.
    ///
    /// # Errors
    /// [`PlotError`] when there is nothing to draw.
    pub fn draw_on(self, inputs: &FigureInputs, sheet: Sheet) -> Result<Svg, PlotError> {
        let canvas = match self {
            Self::Lines => lines::draw(inputs, sheet)?,
            Self::Sections => sections::draw(inputs, sheet)?,
            _ => self.compose(inputs)?,
        };
        Ok(Svg::new(canvas.finish(self.key())))
    }

    pub(super) fn compose(self, inputs: &FigureInputs) -> Result<Canvas, PlotError> {
        match self {
            Self::Lines => lines::draw(inputs, Sheet::A3),
            Self::Sections => sections::draw(inputs, Sheet::A3),
            Self::SectionalArea => sectional_area::draw(inputs),
            Self::Hydrostatics => hydrostatics::draw(inputs),
            Self::DiagramSheet => diagram_sheet::draw(inputs),
        }
    }
}
