//! What a drawing shows: its entities, and those of the blocks it inserts, in one list.

use std::collections::{BTreeMap, HashMap};

use super::super::super::fault::Faults;
use super::super::super::mesh::MOST_TRIANGLES;
use super::super::surfaces::MOST_POINTS;
use super::faces::{Corners, Drawn};
use super::groups::Record;
use super::read::{Block, Layers};
use crate::hull::Motion;

/// Blocks inside blocks at most.
const DEEPEST: usize = 16;

/// Inserts of a drawing at most, those inside blocks among them.
pub(super) const MOST_INSERTS: usize = 100_000;

/// Entities and inserts at most, each as often as its block is inserted.
const MOST_VISITED: usize = 20_000_000;

/// A block at a place of a drawing.
#[derive(Debug)]
pub(super) struct Insert {
    /// The name of the block in capitals.
    name: String,
    layer: usize,
    line: Option<usize>,
    /// From the block less its base to the drawing.
    place: Motion,
    /// Columns and rows, and how far they are apart.
    counts: [usize; 2],
    steps: [[f64; 3]; 2],
}

impl Insert {
    /// Of a record on a layer whose normal makes `axes`.
    pub(super) fn of(record: &Record<'_>, layer: usize, axes: &Motion, faults: &mut Faults) -> Self {
        let at = record.point(10, faults).unwrap_or_default();
        let scales = [41, 42, 43].map(|code| record.real(code, 1.0, faults));
        let (sin, cos) = record.real(50, 0.0, faults).to_radians().sin_cos();
        let [a, b, c] = scales;
        let turned = Motion([[a * cos, -b * sin, 0.0, at[0]], [a * sin, b * cos, 0.0, at[1]], [0.0, 0.0, c, at[2]]]);
        let [columns, rows] = [70, 71].map(|code| usize::try_from(record.whole(code, faults)).unwrap_or(0).max(1));
        let [across, up] = [44, 45].map(|code| record.real(code, 0.0, faults));
        Self {
            name: record.text(2).to_ascii_uppercase(),
            layer,
            line: record.line(),
            place: axes.after(&turned),
            counts: [columns, rows],
            steps: [[across * cos, across * sin, 0.0], [-up * sin, up * cos, 0.0]].map(|step| axes.along(step)),
        }
    }

    /// The motion of one of its copies.
    fn copy(&self, base: [f64; 3], column: usize, row: usize) -> Motion {
        let Motion(mut rows) = self.place;
        for (k, line) in rows.iter_mut().enumerate() {
            line[3] += column as f64 * self.steps[0][k] + row as f64 * self.steps[1][k];
        }
        let [x, y, z] = base.map(|c| -c);
        Motion(rows).after(&Motion([[1.0, 0.0, 0.0, x], [0.0, 1.0, 0.0, y], [0.0, 0.0, 1.0, z]]))
    }
}

/// Curves of a drawing at most.
const MOST_CURVES: usize = 100_000;

/// What a drawing shows.
#[derive(Debug, Default)]
pub(super) struct Expanded {
    /// Triangles with their layers.
    pub(super) faces: Vec<(usize, Corners)>,
    /// Curves with their layers and lines.
    pub(super) curves: Vec<(usize, usize, Vec<[f64; 3]>)>,
    /// Entities that are not read, by their layers and kinds.
    pub(super) unread: BTreeMap<(usize, String), usize>,
    /// Entities on layers that are off or frozen.
    pub(super) hidden: usize,
    pub(super) subdivided: usize,
    /// Inserts of blocks that are not there, or in other files.
    pub(super) missing: usize,
    visited: usize,
    inserts: usize,
    points: usize,
}

/// All that the model shows.
pub(super) fn expand(model: &Block, blocks: &HashMap<String, Block>, layers: &Layers, faults: &mut Faults) -> Expanded {
    let mut found = Expanded::default();
    found.block(model, &Motion::NONE, None, (blocks, layers), 0, faults);
    found
}

impl Expanded {
    /// Adds what a block shows, on the layer of its insert where its own is 0; whether to go on.
    fn block(
        &mut self,
        block: &Block,
        place: &Motion,
        layer: Option<usize>,
        (blocks, layers): (&HashMap<String, Block>, &Layers),
        depth: usize,
        faults: &mut Faults,
    ) -> bool {
        self.visited += 1 + block.drawn.len() + block.unread.len() + block.inserts.len();
        if self.visited > MOST_VISITED {
            faults.add(None, "", format!("more than {MOST_VISITED} entities, with those of inserted blocks"));
            return false;
        }
        let resolved = |own: usize| layer.filter(|_| own == 0).unwrap_or(own);
        for (own, line, drawn) in &block.drawn {
            let layer = resolved(*own);
            if layers.list[layer].hidden {
                self.hidden += 1;
                continue;
            }
            match drawn {
                Drawn::Curve(points) => {
                    let points: Vec<[f64; 3]> = points.iter().map(|&point| place.point(point)).collect();
                    self.points += points.len();
                    self.curves.push((layer, *line, points));
                }
                Drawn::Faces(list) => {
                    let moved = list.iter().map(|corners| (layer, corners.map(|point| place.point(point))));
                    self.faces.extend(moved);
                }
            }
            let most = if self.points > MOST_POINTS {
                format!("curves of more than {MOST_POINTS} points")
            } else if self.curves.len() > MOST_CURVES {
                format!("more than {MOST_CURVES} curves")
            } else if self.faces.len() > MOST_TRIANGLES {
                format!("more than {MOST_TRIANGLES} triangles")
            } else {
                continue;
            };
            faults.add(Some(*line).filter(|line| *line > 0), "", most);
            return false;
        }
        for ((own, kind), count) in &block.unread {
            let layer = resolved(*own);
            if layers.list[layer].hidden {
                self.hidden += count;
            } else {
                *self.unread.entry((layer, kind.clone())).or_default() += count;
            }
        }
        self.subdivided += block.subdivided;
        block.inserts.iter().all(|insert| {
            let layer = resolved(insert.layer);
            if layers.list[layer].frozen {
                self.hidden += 1;
                return true;
            }
            let Some(inner) = blocks.get(&insert.name).filter(|inner| !inner.is_elsewhere()) else {
                self.missing += 1;
                return true;
            };
            if depth >= DEEPEST {
                let message = format!("blocks are inserted more than {DEEPEST} deep in each other");
                faults.add(insert.line, &insert.name, message);
                return false;
            }
            let [columns, rows] = insert.counts;
            let copies = (0..rows).flat_map(|row| (0..columns).map(move |column| (column, row)));
            for (column, row) in copies {
                self.inserts += 1;
                if self.inserts > MOST_INSERTS {
                    faults.add(insert.line, &insert.name, format!("more than {MOST_INSERTS} inserts"));
                    return false;
                }
                let place = place.after(&insert.copy(inner.base, column, row));
                if !self.block(inner, &place, Some(layer), (blocks, layers), depth + 1, faults) {
                    return false;
                }
            }
            true
        })
    }
}
