//! One view of a lines plan: true proportions, its own origin on the sheet; and the pens of the drawing.

use crate::plot::paper::canvas::{Canvas, Pen};

/// Curves of the hull.
pub(in crate::plot) const STATION: Pen = Pen::new(0.35, "#000000");
/// Waterlines.
pub(in crate::plot) const WATERLINE: Pen = Pen::new(0.35, "#0b3d78");
/// Buttocks.
pub(in crate::plot) const BUTTOCK: Pen = Pen::new(0.35, "#7a2f00");
/// Diagonals.
pub(in crate::plot) const DIAGONAL: Pen = Pen::new(0.35, "#00553c");
/// Profile and deck.
pub(in crate::plot) const OUTLINE: Pen = Pen::new(0.5, "#000000");
/// A hull as it was before, under what it is.
pub(in crate::plot) const BEFORE: Pen = Pen::new(0.2, "#7d7d7d");
/// Grid.
pub(in crate::plot) const GRID: Pen = Pen::new(0.13, "#8a8a8a");
/// From a name to its curve.
pub(in crate::plot) const THREAD: Pen = Pen::new(0.15, "#000000");
/// Centre line and base line.
pub(in crate::plot) const BASE: Pen = Pen::new(0.25, "#000000");
/// Design waterline.
pub(in crate::plot) const DESIGN: Pen = Pen::new(0.25, "#000000").dashed(&[6.0, 1.0, 0.8, 1.0]);
/// The design waterline in the half-breadth plan.
pub(in crate::plot) const DESIGN_WATERLINE: Pen = Pen::new(0.55, "#0b3d78").dashed(&[6.0, 1.0, 0.8, 1.0]);
/// Planes of diagonals where they stand edgewise.
pub(in crate::plot) const DIAGONAL_PLANE: Pen = Pen::new(0.18, "#00553c").dashed(&[3.0, 0.8]);

/// From metres to millimetres of the sheet: the first coordinate to the right, the second up.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::plot) struct View {
    /// Where (0, 0) stands on the sheet [mm].
    pub(in crate::plot) origin: [f64; 2],
    /// Millimetres a metre.
    pub(in crate::plot) scale: f64,
}

impl View {
    pub(in crate::plot) fn new(origin: [f64; 2], scale: u32) -> Self {
        Self { origin, scale: 1000.0 / f64::from(scale) }
    }

    pub(in crate::plot) fn at(&self, point: [f64; 2]) -> [f64; 2] {
        [self.origin[0] + point[0] * self.scale, self.origin[1] - point[1] * self.scale]
    }

    pub(in crate::plot) fn place(&self, points: impl IntoIterator<Item = [f64; 2]>) -> Vec<[f64; 2]> {
        points.into_iter().map(|point| self.at(point)).collect()
    }

    /// Draws a curve and returns its place on the sheet.
    pub(in crate::plot) fn draw(
        &self,
        canvas: &mut Canvas,
        points: impl IntoIterator<Item = [f64; 2]>,
        pen: &Pen,
    ) -> Vec<[f64; 2]> {
        let placed = self.place(points);
        canvas.polyline(&placed, pen);
        placed
    }
}
