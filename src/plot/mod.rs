//! Figures: one file a figure, drawn in millimetres, as SVG and PNG.
//!
//! Everything shown was computed by the floors below; this module places it on paper. Text is set in the embedded DejaVu
//! Sans, so that pictures are the same on every machine. The same inputs give the same bytes.

mod figures;
mod pages;
mod paper;
#[cfg(feature = "pdf")]
mod pdf;
#[cfg(not(feature = "pdf"))]
#[path = "no_pdf.rs"]
mod pdf;
#[cfg(test)]
mod report_tests;
mod ship;
#[cfg(test)]
mod tests;

pub use figures::bonjean::{BonjeanTable, bonjean_figure};
pub use figures::comparison::{ComparedHulls, compared_areas, compared_body_plans};
pub use figures::convergence::convergence_figure;
pub use figures::deviation::deviation_figure;
pub use figures::fair_curve::{CurveSheet, fair_curve_figure};
pub use figures::fairing::arrows::fairing_arrows;
pub use figures::fairing::arrows_long::fairing_arrows_long;
pub use figures::fairing::body::fairing_body_plan;
pub use figures::fairing::combs::{CombLine, FairingCombs};
pub use figures::fairing::curves::{fairing_stations, fairing_waterlines};
pub use figures::fairing::half_breadths::fairing_half_breadth_plan;
pub use figures::fairing::long::{fairing_buttocks, fairing_diagonals};
pub use figures::fairing::moves::fairing_moves;
pub use figures::fairing::suspects::fairing_suspects;
pub use figures::fairing::table::fairing_table;
pub use figures::figure::Figure;
pub use figures::grades::{GradePoint, grades_figure};
pub use paper::error::PlotError;
pub use paper::svg::Svg;
pub use ship::inputs::FigureInputs;
/// The embedded typeface, DejaVu Sans, as the file of its font.
pub const FONT: &[u8] = paper::font::DEJAVU_SANS;

pub use figures::loft::{LoftSheet, loft_frame, loft_tile_count, loft_tiles};
pub use figures::map_legend::SurfaceMapKind;
pub use figures::pareto::pareto_figure;
pub use figures::resistance::{ResistanceSheet, resistance_figure};
pub use figures::smoothing::smoothing_figure;
pub use figures::surface_map::{SurfaceMaps, surface_map};
pub use figures::suspects::{suspect_heights_figure, suspect_points_figure, suspects_figure};
pub use figures::table_sheet::{table_figure, table_sheets};
pub use figures::trade::trade_figure;
pub use pages::{Heading, Page};
pub use paper::scale::{DRAWING_SCALES, sheet_scale};
pub use paper::sheet::Sheet;
pub use pdf::write_pdf;
