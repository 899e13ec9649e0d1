//! What knows paper and no ship: the canvas in millimetres, letters, labels, charts, scales, sheets, PNG.

pub(super) mod canvas;
pub(super) mod chart;
pub(super) mod error;
pub(super) mod font;
pub(super) mod label;
#[cfg(feature = "pictures")]
pub(super) mod png;
#[cfg(not(feature = "pictures"))]
#[path = "no_png.rs"]
pub(super) mod png;
pub(super) mod scale;
pub(super) mod sheet;
pub(super) mod straight;
pub(super) mod svg;
