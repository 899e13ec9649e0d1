//! Figures: one file a figure, drawn in millimetres, as SVG and PNG.
//!
//! Everything shown was computed by the floors below; this module places it on paper. Text is set in the embedded DejaVu
//! Sans, so that pictures are the same on every machine. The same inputs give the same bytes.

mod body_plan;
mod bonjean;
mod canvas;
mod caption;
mod chart;
mod comb;
mod comparison;
mod convergence;
mod deviation;
mod diagram_sheet;
mod fair_curve;
mod fairing;
mod fairing_arrows;
mod fairing_arrows_long;
mod fairing_body;
mod fairing_combs;
mod fairing_curves;
mod fairing_half_breadths;
mod fairing_long;
mod fairing_moves;
mod fairing_reach;
mod fairing_sections;
mod fairing_suspects;
mod fairing_table;
mod figure;
mod font;
mod grades;
mod hydrostatics;
mod label;
mod lines;
mod lines_grid;
mod loft;
mod map_legend;
mod outline;
mod pages;
mod pareto;
#[cfg(feature = "pdf")]
mod pdf;
#[cfg(not(feature = "pdf"))]
#[path = "no_pdf.rs"]
mod pdf;
#[cfg(feature = "pictures")]
mod png;
#[cfg(not(feature = "pictures"))]
#[path = "no_png.rs"]
mod png;
mod profile;
#[cfg(test)]
mod report_tests;
mod resistance;
mod scale;
mod sectional_area;
mod sections;
mod sheet;
mod smoothing;
mod station_names;
mod straight;
mod surface_map;
mod suspects;
mod table_sheet;
#[cfg(test)]
mod tests;
mod title_block;
mod trade;
mod view;
mod zero_lines;

pub use bonjean::{BonjeanTable, bonjean_figure};
pub use comparison::{ComparedHulls, compared_areas, compared_body_plans};
pub use convergence::convergence_figure;
pub use deviation::deviation_figure;
pub use fair_curve::{CurveSheet, fair_curve_figure};
pub use fairing_arrows::fairing_arrows;
pub use fairing_arrows_long::fairing_arrows_long;
pub use fairing_body::fairing_body_plan;
pub use fairing_combs::{CombLine, FairingCombs};
pub use fairing_curves::{fairing_stations, fairing_waterlines};
pub use fairing_half_breadths::fairing_half_breadth_plan;
pub use fairing_long::{fairing_buttocks, fairing_diagonals};
pub use fairing_moves::fairing_moves;
pub use fairing_suspects::fairing_suspects;
pub use fairing_table::fairing_table;
pub use figure::{Figure, FigureInputs, PlotError, Svg};
pub use grades::{GradePoint, grades_figure};
/// The embedded typeface, DejaVu Sans, as the file of its font.
pub const FONT: &[u8] = font::DEJAVU_SANS;

pub use loft::{LoftSheet, loft_frame, loft_tile_count, loft_tiles};
pub use pages::{Heading, Page};
pub use pareto::pareto_figure;
pub use pdf::write_pdf;
pub use resistance::{ResistanceSheet, resistance_figure};
pub use scale::{DRAWING_SCALES, sheet_scale};
pub use sheet::Sheet;
pub use smoothing::smoothing_figure;
pub use surface_map::{SurfaceMapKind, SurfaceMaps, surface_map};
pub use suspects::{suspect_heights_figure, suspect_points_figure, suspects_figure};
pub use table_sheet::{table_figure, table_sheets};
pub use trade::trade_figure;
