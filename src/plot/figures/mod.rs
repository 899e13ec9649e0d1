//! One file a figure; the figures of a faired table in `fairing/`.

pub(super) mod bonjean;
pub(super) mod comparison;
pub(super) mod convergence;
pub(super) mod deviation;
pub(super) mod diagram_sheet;
pub(super) mod fair_curve;
pub(super) mod fairing;
pub(super) mod figure;
pub(super) mod grades;
pub(super) mod hydrostatics;
pub(super) mod lines;
pub(super) mod loft;
pub(super) mod map_legend;
pub(super) mod pareto;
pub(super) mod resistance;
pub(super) mod sectional_area;
pub(super) mod sections;
pub(super) mod smoothing;
pub(super) mod surface_map;
pub(super) mod suspects;
pub(super) mod table_sheet;
pub(super) mod trade;
