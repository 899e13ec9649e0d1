//! The list of figures of a hull.

use super::{diagram_sheet, hydrostatics, lines, sectional_area, sections};
use crate::plot::paper::canvas::Canvas;
use crate::plot::paper::error::PlotError;
use crate::plot::paper::sheet::Sheet;
use crate::plot::paper::svg::Svg;
use crate::plot::ship::inputs::FigureInputs;

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

    pub(in crate::plot) fn compose(self, inputs: &FigureInputs) -> Result<Canvas, PlotError> {
        match self {
            Self::Lines => lines::draw(inputs, Sheet::A3),
            Self::Sections => sections::draw(inputs, Sheet::A3),
            Self::SectionalArea => sectional_area::draw(inputs),
            Self::Hydrostatics => hydrostatics::draw(inputs),
            Self::DiagramSheet => diagram_sheet::draw(inputs),
        }
    }
}
