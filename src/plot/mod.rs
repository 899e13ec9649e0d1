//! Figures: one file a figure, drawn in millimetres, as SVG and PNG.
//!
//! Everything shown was computed by the floors below; this module places it on paper. Text is set in the embedded DejaVu
//! Sans, so that pictures are the same on every machine. The same inputs give the same bytes.

mod body_plan;
mod canvas;
mod caption;
mod chart;
mod comb;
mod diagram_sheet;
mod fair_curve;
mod fairing;
mod fairing_moves;
mod figure;
mod font;
mod hydrostatics;
mod label;
mod lines;
mod lines_grid;
mod outline;
mod png;
mod profile;
mod scale;
mod sectional_area;
mod sections;
mod smoothing;
mod suspects;
#[cfg(test)]
mod tests;
mod title_block;
mod view;

pub use fair_curve::fair_curve_figure;
pub use fairing::{fairing_body_plan, fairing_half_breadth_plan};
pub use fairing_moves::fairing_moves;
pub use figure::{Figure, FigureInputs, PlotError, Svg};
/// The embedded typeface, DejaVu Sans, as the file of its font.
pub const FONT: &[u8] = font::DEJAVU_SANS;

pub use scale::{DRAWING_SCALES, sheet_scale};
pub use smoothing::smoothing_figure;
pub use suspects::{suspect_heights_figure, suspect_points_figure, suspects_figure};
