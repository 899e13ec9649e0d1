//! Cells of VTK (Kitware, file formats of VTK, 2023) and elements of gmsh (C. Geuzaine, J.-F. Remacle 2009): which of them
//! are faces.

use super::polygons::{Polygons, through_middles};
use crate::exchange::fault::Faults;

/// What a cell is to the surface of a body.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Cell {
    /// Points and lines.
    Less,
    /// A polygon, its corners in turn, or a face with nodes in the middle of its sides.
    Face,
    /// A strip of triangles.
    Strip,
    /// A rectangle whose corners stand row by row.
    Pixel,
    /// A cell with a volume.
    Solid,
    /// Another.
    Unknown,
}

impl Cell {
    /// By its number in VTK.
    pub(super) fn of_vtk(number: usize) -> Self {
        match number {
            0..=4 | 21 | 35 => Self::Less,
            5 | 7 | 9 | 22 | 23 | 28 => Self::Face,
            6 => Self::Strip,
            8 => Self::Pixel,
            10..=16 | 24..=27 | 29 | 32 | 33 | 42 => Self::Solid,
            _ => Self::Unknown,
        }
    }
}

/// Adds cells to a mesh, and counts those that are no faces.
#[derive(Default)]
pub(super) struct Cells {
    faces: usize,
    solids: usize,
}

impl Cells {
    /// Adds a cell of a kind, whose number is `number`; whether to go on.
    pub(super) fn add(
        &mut self,
        (kind, number): (Cell, usize),
        nodes: &[usize],
        mesh: &mut Polygons,
        faults: &mut Faults,
    ) -> bool {
        match kind {
            Cell::Less => return true,
            Cell::Solid => {
                self.solids += 1;
                return true;
            }
            Cell::Unknown => {
                let message = "cells of this kind are not read; write triangles or quadrilaterals".to_owned();
                faults.add(None, &format!("kind {number}"), message);
                return false;
            }
            Cell::Face | Cell::Strip | Cell::Pixel => self.faces += 1,
        }
        match (kind, nodes) {
            (Cell::Pixel, &[a, b, c, d]) => mesh.face(None, &[a, b, d, c], faults),
            (Cell::Strip, _) => mesh.strip(nodes, faults),
            _ => mesh.face(None, nodes, faults),
        }
    }

    /// Adds a face with nodes in the middle of its sides.
    pub(super) fn curved(&mut self, nodes: &[usize], mesh: &mut Polygons, faults: &mut Faults) -> bool {
        self.faces += 1;
        through_middles(nodes).iter().all(|part| mesh.face(None, part, faults))
    }

    /// Says of a mesh of volumes alone that it has no faces.
    pub(super) fn finish(&self, faults: &mut Faults) {
        if self.faces == 0 && self.solids > 0 {
            let message = format!("{} cells with a volume and no faces; write the faces of the surface", self.solids);
            faults.add(None, "", message);
        }
    }
}
