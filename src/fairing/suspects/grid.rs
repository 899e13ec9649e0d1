//! The half-breadths of a table as a grid of values that neighbours can predict, cut into runs where there is hull.

use crate::hull::{Entry, OffsetTable};

/// Which way a line of the grid runs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::fairing) enum Along {
    /// Along a station, from waterline to waterline.
    Station,
    /// Along a waterline, from station to station.
    Waterline,
}

impl Along {
    pub(in crate::fairing) const BOTH: [Self; 2] = [Self::Station, Self::Waterline];
}

/// What a cell of the grid is to its neighbours.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum State {
    /// A value on the hull.
    Given,
    /// There is hull, and no value: lines pass over it.
    Open,
    /// No hull: lines end here.
    Beyond,
}

/// Half-breadths by station and waterline. Cells are numbered station by station.
#[derive(Debug, Clone)]
pub(in crate::fairing) struct Grid {
    /// Positions of the stations \[m\].
    pub(in crate::fairing) x: Vec<f64>,
    /// Heights of the waterlines \[m\].
    pub(in crate::fairing) z: Vec<f64>,
    /// Heights of the keel by station, where the table gives them \[m\].
    pub(in crate::fairing) keel: Vec<Option<f64>>,
    /// Half-breadths \[m\]; 0 where there is none.
    pub(in crate::fairing) value: Vec<f64>,
    state: Vec<State>,
}

impl Grid {
    pub(in crate::fairing) fn new(table: &OffsetTable) -> Self {
        let width = table.waterlines.len();
        let mut value = vec![0.0; table.stations.len() * width];
        let mut state = vec![State::Beyond; value.len()];
        for (i, station) in table.stations.iter().enumerate() {
            for (j, cell) in station.half_breadths.iter().enumerate().take(width) {
                match cell.entry {
                    Entry::Given(y) if y.is_finite() => {
                        value[i * width + j] = y;
                        state[i * width + j] = State::Given;
                    }
                    Entry::Unknown => state[i * width + j] = State::Open,
                    Entry::Given(_) | Entry::Absent => {}
                }
            }
        }
        let mut grid = Self {
            x: table.stations.iter().map(|station| station.station.x).collect(),
            z: table.waterlines.clone(),
            keel: table.stations.iter().map(|station| station.keel_height).collect(),
            value,
            state,
        };
        grid.set_zeros_aside();
        grid
    }

    /// Zeros that hang together with the edge of the table, or with cells without hull, say that there is no hull; a zero
    /// among offsets is an offset, and so is one that the hull bridges.
    fn set_zeros_aside(&mut self) {
        let (rows, width) = (self.x.len(), self.z.len());
        let enclosed: Vec<bool> =
            (0..self.value.len()).map(|cell| Along::BOTH.into_iter().any(|along| self.bridges(along, cell))).collect();
        let zero = |grid: &Self, cell: usize| {
            grid.state[cell] == State::Given && grid.value[cell].abs() < 1e-12 && !enclosed[cell]
        };
        let mut waiting = Vec::new();
        for cell in 0..self.value.len() {
            let (i, j) = (cell / width, cell % width);
            let outer = i == 0 || j == 0 || i + 1 == rows || j + 1 == width;
            let borders = self.neighbours(cell).any(|n| self.state[n] == State::Beyond);
            if zero(self, cell) && (outer || borders) {
                waiting.push(cell);
            }
        }
        while let Some(cell) = waiting.pop() {
            if self.state[cell] == State::Beyond {
                continue;
            }
            self.state[cell] = State::Beyond;
            waiting.extend(self.neighbours(cell).filter(|&n| zero(self, n)).collect::<Vec<_>>());
        }
    }

    /// Whether hull comes up to a cell from before and from behind on a line and does not shrink to nothing there, as
    /// it does between a bulb and the stem: straight lines through the two nearest offsets of either side reach at
    /// least a fifth of the nearest.
    fn bridges(&self, along: Along, cell: usize) -> bool {
        let at = self.coordinate(along, cell);
        let hull = |steps: isize| {
            let other = self.shifted(along, cell, steps, 0).filter(|&other| self.value[other].abs() >= 1e-12)?;
            Some((self.coordinate(along, other), self.value[other]))
        };
        [-1, 1].into_iter().all(|side| {
            let Some((s, near)) = hull(side) else { return false };
            let reached = hull(2 * side).map_or(near, |(t, far)| near + (near - far) * (at - s) / (s - t));
            reached / near >= 0.2
        })
    }

    fn neighbours(&self, cell: usize) -> impl Iterator<Item = usize> + use<> {
        let (rows, width) = (self.x.len(), self.z.len());
        let (i, j) = (cell / width, cell % width);
        [
            (i > 0).then(|| cell - width),
            (i + 1 < rows).then_some(cell + width),
            (j > 0).then(|| cell - 1),
            (j + 1 < width).then_some(cell + 1),
        ]
        .into_iter()
        .flatten()
    }

    pub(in crate::fairing) fn len(&self) -> usize {
        self.value.len()
    }

    pub(in crate::fairing) fn is_given(&self, cell: usize) -> bool {
        self.state[cell] == State::Given
    }

    /// Station and waterline of a cell.
    pub(in crate::fairing) fn place(&self, cell: usize) -> (usize, usize) {
        (cell / self.z.len(), cell % self.z.len())
    }

    /// How many lines run that way.
    pub(in crate::fairing) fn lines(&self, along: Along) -> usize {
        match along {
            Along::Station => self.x.len(),
            Along::Waterline => self.z.len(),
        }
    }

    /// Cells with offsets that follow each other on a line without a gap in the hull, one list a run.
    pub(in crate::fairing) fn runs(&self, along: Along, line: usize) -> Vec<Vec<usize>> {
        let width = self.z.len();
        let cells: Vec<usize> = match along {
            Along::Station => (line * width..(line + 1) * width).collect(),
            Along::Waterline => (0..self.x.len()).map(|i| i * width + line).collect(),
        };
        cells
            .split(|&cell| self.state[cell] == State::Beyond)
            .map(|run| run.iter().copied().filter(|&cell| self.is_given(cell)).collect::<Vec<_>>())
            .filter(|run| !run.is_empty())
            .collect()
    }

    /// The coordinate of a cell along lines that run that way \[m\].
    pub(in crate::fairing) fn coordinate(&self, along: Along, cell: usize) -> f64 {
        let (i, j) = self.place(cell);
        match along {
            Along::Station => self.z[j],
            Along::Waterline => self.x[i],
        }
    }

    /// The cell `steps` places along lines that run that way and `across` lines further; none outside the table or
    /// without an offset.
    pub(in crate::fairing) fn shifted(&self, along: Along, cell: usize, steps: isize, across: isize) -> Option<usize> {
        let (i, j) = self.place(cell);
        let (di, dj) = match along {
            Along::Station => (across, steps),
            Along::Waterline => (steps, across),
        };
        let i = i.checked_add_signed(di).filter(|&i| i < self.x.len())?;
        let j = j.checked_add_signed(dj).filter(|&j| j < self.z.len())?;
        let other = i * self.z.len() + j;
        self.is_given(other).then_some(other)
    }
}
