//! What a fit makes of the cells of its table.

use super::outlines::{self, PointResidual};
use super::{CellResidual, Fitted};
use crate::hull::cell::{Cell, Entry};
use crate::hull::offsets::OffsetTable;

/// How far a surface is from the given cells of its table.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Misfit {
    /// Number of given cells.
    pub given: usize,
    /// Number of cells that the table leaves open and the surface fills.
    pub predicted: usize,
    /// Root of the mean square of surface minus table \[m\]; 0 without given cells.
    pub rms: f64,
    /// The given cell that is missed most, the first of equals.
    pub worst: Option<CellResidual>,
}

impl Misfit {
    /// The largest distance \[m\]; 0 without given cells.
    #[must_use]
    pub fn largest(&self) -> f64 {
        self.worst.and_then(|cell| cell.residual).map_or(0.0, f64::abs)
    }
}

impl Fitted {
    /// How far the surface is from the given cells.
    #[must_use]
    pub fn misfit(&self) -> Misfit {
        let mut misfit = Misfit { given: 0, predicted: 0, rms: 0.0, worst: None };
        for cell in &self.cells {
            let Some(residual) = cell.residual else {
                misfit.predicted += 1;
                continue;
            };
            misfit.given += 1;
            misfit.rms += residual * residual;
            if misfit.worst.is_none() || residual.abs() > misfit.largest() {
                misfit.worst = Some(*cell);
            }
        }
        misfit.rms = (misfit.rms / misfit.given.max(1) as f64).sqrt();
        misfit
    }

    /// The points of sections that the surface is to pass through: outermost points above the bottom, at which the hull
    /// reaches. Empty for tables without such points.
    #[must_use]
    #[doc(hidden)]
    pub fn points(&self, table: &OffsetTable) -> Vec<PointResidual> {
        outlines::point_residuals(table, &self.hull).0
    }

    /// The table with the half-breadths of the surface in its own cells; cells without a hull stay blank. Ends of
    /// waterlines are those of the surface where the table gives them. Heights, outlines, lines and deck are those of
    /// the table.
    #[must_use]
    pub fn surface_table(&self, table: &OffsetTable) -> OffsetTable {
        let mut surface = table.clone();
        for station in &mut surface.stations {
            for cell in &mut station.half_breadths {
                *cell = Cell::default();
            }
        }
        for cell in &self.cells {
            let place = surface.stations.get_mut(cell.station).and_then(|s| s.half_breadths.get_mut(cell.waterline));
            if let Some(place) = place {
                // The surface beyond the centreplane is no hull.
                place.entry = Entry::Given(cell.half_breadth.max(0.0) + 0.0);
            }
        }
        for (ends, &z) in surface.endings.iter_mut().zip(&table.waterlines) {
            let found = self.hull.endings(z);
            for (side, end) in ends.iter_mut().enumerate() {
                *end = end.and(found.map(|ends| ends[side]));
            }
        }
        surface
    }
}
