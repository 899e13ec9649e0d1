//! What became of the offsets of a table, and of the inflections of a line.

use super::surface::Origin;
use crate::hull::Cut;

/// A cell and what became of it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Change {
    /// Index of the station.
    pub station: usize,
    /// What it is of the station.
    pub origin: Origin,
    /// Position forward of AP \[m\].
    pub x: f64,
    /// Height above the base line \[m\].
    pub z: f64,
    /// Half-breadth in the table \[m\].
    pub before: f64,
    /// Half-breadth of the fair surface \[m\].
    pub after: f64,
    /// Tolerance that was used \[m\]; none for cells that were left out.
    pub tolerance: Option<f64>,
    /// The cell was left out as a suspect.
    pub suspect: bool,
    /// The cell was locked.
    pub locked: bool,
}

/// An offset that the table marks as unknown (`?`), from the fair surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Predicted {
    /// Index of the station.
    pub station: usize,
    /// Index of the waterline.
    pub waterline: usize,
    /// Position forward of AP \[m\].
    pub x: f64,
    /// Height above the base line \[m\].
    pub z: f64,
    /// Half-breadth \[m\].
    pub half_breadth: f64,
}

/// Inflections and monotone pieces of one curve.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Turns {
    /// The plane that cuts it.
    pub cut: Cut,
    /// Inflections of the surface through the table.
    pub before: usize,
    /// Inflections of the fair surface.
    pub after: usize,
    /// The least number of inflections of any curve within the tolerances of the offsets, and whether that is proved;
    /// none on lines that the table does not have.
    pub minimum: Option<(usize, bool)>,
    /// Monotone pieces of curvature before and after.
    pub pieces: [usize; 2],
    /// Total variation of curvature over its range before and after \[-\]; none on straight lines.
    pub variation: [Option<f64>; 2],
}

impl Turns {
    /// The least number of monotone pieces, max(1, m) of the least number m of inflections; none where that is not known.
    ///
    /// Between two successive zeros of curvature it has an extremum (Rolle): m inflections have m - 1 turning points
    /// between them, which part m pieces; without inflections there is one. The number rests on the least number of
    /// inflections, and is proved where that is. It says nothing of curves within the tolerances whose curvature has
    /// few zeros and must turn all the same.
    #[must_use]
    pub fn least_pieces(&self) -> Option<usize> {
        // Of a hump that just counts the swings beside it may not.
        self.minimum.map(|(least, _)| least.max(1).min(self.pieces[1]))
    }
}

/// Root of the mean square and largest of the moves of what was not left out \[m\], with the place of the largest.
pub(super) fn moves(changes: &[Change]) -> (f64, f64, Option<&Change>) {
    let kept: Vec<&Change> = changes.iter().filter(|change| !change.suspect).collect();
    let size = |change: &Change| (change.after - change.before).abs();
    let squares: f64 = kept.iter().map(|change| size(change).powi(2)).sum();
    let largest = kept.iter().copied().max_by(|a, b| size(a).total_cmp(&size(b)));
    ((squares / kept.len().max(1) as f64).sqrt(), largest.map_or(0.0, size), largest)
}
