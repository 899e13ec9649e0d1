//! What the figures of a hull are made of.

use super::outline;
use crate::fairing::record::FairRecord;
use crate::hull::Hull;
use crate::hydrostatics::{CurvesOfForm, Hydrostatics};
use crate::plot::paper::error::PlotError;
use std::sync::OnceLock;

/// How far a table goes beyond the deck edge before its curves end there, as a part of its range.
const EDGE: f64 = 1e-3;

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
    pub(in crate::plot) fn immersed_edge(&self, rows: &[Hydrostatics]) -> Option<f64> {
        let [low, high] = self.range();
        rows.last().map(|row| row.draught).filter(|edge| *edge < high - EDGE * (high - low))
    }

    /// Hydrostatics over the range of draughts of the table, so dense that curves through them look smooth; up to the
    /// lowest point of the deck edge, where the table goes beyond it: form without a superstructure says nothing there.
    pub(in crate::plot) fn dense_rows(&self) -> Result<Vec<Hydrostatics>, PlotError> {
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
