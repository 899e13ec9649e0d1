//! What became of a table: every offset with its move, the table with the new offsets, inflections before and after.

use super::change::{Change, Predicted, Turns};
use super::inspect::{Counts, Planes, Traced, is_of_table};
use super::surface::{FairSurface, Origin};
use crate::hull::{Cell, Cut, Entry, Hull, OffsetTable, default_waterlines};

/// Every reading with its move; what was left out has the value of the fair surface beside what the table says.
pub(super) fn changes(
    table: &OffsetTable,
    surface: &FairSurface,
    after: &Hull,
    excluded: &[(usize, usize)],
) -> Vec<Change> {
    let mut changes: Vec<Change> = Vec::new();
    for (place, reading) in surface.places.iter().zip(&surface.model.readings) {
        changes.push(Change {
            station: place.origin.station(),
            origin: place.origin,
            x: place.x,
            z: place.z,
            before: reading.value,
            after: after.surface().eval(place.at[0], place.at[1])[1],
            tolerance: reading.tolerance,
            suspect: false,
            locked: place.locked,
        });
    }
    for &(station, waterline) in excluded {
        let (column, z) = (&table.stations[station], table.waterlines[waterline]);
        let x = column.station.x;
        if let (Some(before), Some(after)) = (column.half_breadths[waterline].value(), after.half_breadth(x, z)) {
            changes.push(Change {
                station,
                origin: Origin::HalfBreadth { station, waterline },
                x,
                z,
                before,
                after,
                tolerance: None,
                suspect: true,
                locked: false,
            });
        }
    }
    changes.sort_by_key(|change| match change.origin {
        Origin::HalfBreadth { station, waterline } => (station, 0, waterline),
        Origin::Deck { station } => (station, usize::MAX, 0),
        Origin::Point { station, outline, point } => (station, outline + 1, point),
    });
    changes
}

/// What offsets move normal to the hull, root of the mean square and the most \[m\]: n_y |dy|, n the unit normal of the
/// surface there, to first order in the move.
pub(super) fn normal_moves(surface: &FairSurface, after: &Hull) -> [f64; 2] {
    let moves = surface.places.iter().zip(&surface.model.readings).map(|(place, reading)| {
        let [[here, across], [along, _]] = after.surface().derivatives::<2>(place.at[0], place.at[1]);
        let part = |a: usize, b: usize| along[a] * across[b] - along[b] * across[a];
        let [x, y, z] = [part(1, 2), part(2, 0), part(0, 1)];
        let area = x.hypot(y).hypot(z);
        let cosine = if area > 0.0 { (y / area).abs() } else { 1.0 };
        cosine * (here[1] - reading.value).abs()
    });
    let (count, squares, most) = moves.fold((0.0, 0.0, 0.0_f64), |(n, s, most), m| (n + 1.0, s + m * m, most.max(m)));
    [(squares / f64::max(count, 1.0)).sqrt(), most]
}

/// The half-breadths of the fair surface where the table says `?`; a blank says nothing.
pub(super) fn predicted(table: &OffsetTable, after: &Hull) -> Vec<Predicted> {
    let asked = |cell: &Cell| {
        let said = cell.written.as_ref().is_some_and(|written| written.text.contains('?'));
        cell.entry == Entry::Unknown && said
    };
    let mut list = Vec::new();
    for (station, column) in table.stations.iter().enumerate() {
        let x = column.station.x;
        for (waterline, (cell, &z)) in column.half_breadths.iter().zip(&table.waterlines).enumerate() {
            if let Some(half_breadth) = after.half_breadth(x, z).filter(|_| asked(cell)) {
                list.push(Predicted { station, waterline, x, z, half_breadth: half_breadth.max(0.0) });
            }
        }
    }
    list
}

/// The table with the new half-breadths; those that were unknown are doubtful.
pub(super) fn written(table: &OffsetTable, changes: &[Change], predicted: &[Predicted]) -> OffsetTable {
    let mut table = table.clone();
    for change in changes {
        let station = &mut table.stations[change.station];
        match change.origin {
            Origin::HalfBreadth { waterline, .. } => {
                let cell = &mut station.half_breadths[waterline];
                cell.entry = Entry::Given(change.after);
                cell.written = None;
            }
            Origin::Deck { .. } => station.deck_half_breadth = Some(change.after),
            Origin::Point { outline, point, .. } => station.outlines[outline][point].y = change.after,
        }
    }
    for own in predicted {
        let cell = &mut table.stations[own.station].half_breadths[own.waterline];
        (cell.entry, cell.written) = (Entry::Given(own.half_breadth), None);
        cell.marks.doubtful = true;
    }
    table
}

/// The lines of the table, buttocks and diagonals of the surface before.
#[derive(Debug, Clone)]
pub(super) struct Watched {
    planes: Planes,
    before: Traced,
}

impl Watched {
    /// Heights of the waterlines that are looked at \[m\]: those of the table, of a table of sections those of a drawing.
    pub(super) fn waterlines(table: &OffsetTable, before: &Hull) -> Vec<f64> {
        if table.waterlines.is_empty() { default_waterlines(before) } else { table.waterlines.clone() }
    }

    pub(super) fn new(table: &OffsetTable, before: &Hull) -> Self {
        let mut planes = Planes::with_defaults(before);
        planes.stations = table.stations.iter().map(|station| station.station.x).collect();
        planes.waterlines = Self::waterlines(table, before);
        let before = Traced::new(before, &planes);
        Self { planes, before }
    }

    /// What counts before; `tolerance` is the departure that can just be seen \[m\].
    pub(super) fn counted(self, tolerance: f64) -> Counted {
        Counted { before: self.before.counts(tolerance), planes: self.planes, tolerance }
    }
}

/// Lines with what counts before.
pub(super) struct Counted {
    planes: Planes,
    before: Vec<(Cut, Counts)>,
    tolerance: f64,
}

impl Counted {
    /// Changes of sign of curvature before, on stations and waterlines.
    pub(super) fn changes_of_sign(&self) -> usize {
        let of_table = self.before.iter().filter(|(cut, _)| is_of_table(cut));
        of_table.map(|(_, counts)| counts.inflections).sum()
    }

    /// Inflections and monotone pieces before and after.
    pub(super) fn turns(&self, after: &Hull) -> Vec<Turns> {
        let new = Traced::new(after, &self.planes).counts(self.tolerance);
        let cuts = self.before.iter().filter_map(|&(cut, before)| {
            let after = new.iter().find(|(other, _)| *other == cut)?.1;
            Some(Turns {
                cut,
                before: before.inflections,
                after: after.inflections,
                minimum: None,
                pieces: [before.pieces, after.pieces],
                variation: [before.variation, after.variation],
            })
        });
        cuts.collect()
    }
}
