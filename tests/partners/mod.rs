//! Three other ways from a table of half-breadths to fair lines, beside which fairing is measured: C2 cubic
//! interpolation, a smoother with one weight found by cross-validation, and a spline on a chart of four numbers that
//! are chosen with the weight by restricted likelihood.
//!
//! They know no displacement, ends, flats, features or mistakes. What is worse than they are has something to mend.

mod fair_net;
mod interpolation;
mod likelihood;
pub(crate) mod lines;
mod net;
mod smoother;

use loftsman::internals::hull::OffsetTable;

pub(crate) use fair_net::FairNet;
use lines::{Direction, Line};

/// Half-breadths \[m\] at every station and waterline; NaN where nothing is given.
#[derive(Debug, Clone)]
pub(crate) struct Table {
    /// Stations \[m\].
    pub(crate) x: Vec<f64>,
    /// Waterlines \[m\].
    pub(crate) z: Vec<f64>,
    /// One row a station.
    pub(crate) y: Vec<Vec<f64>>,
}

impl From<&OffsetTable> for Table {
    fn from(table: &OffsetTable) -> Self {
        Self {
            x: table.stations.iter().map(|station| station.station.x).collect(),
            z: table.waterlines.clone(),
            y: table
                .stations
                .iter()
                .map(|s| s.half_breadths.iter().map(|cell| cell.value().unwrap_or(f64::NAN)).collect())
                .collect(),
        }
    }
}

impl Table {
    /// Whether an offset off the centreplane is given.
    pub(crate) fn full(&self, i: usize, j: usize) -> bool {
        self.y[i][j] > 1e-9
    }
}

/// The lines of a table as one of the partners draws them.
pub(crate) struct Drawn {
    /// Half-breadths at the places of every line.
    pub(crate) samples: Vec<Vec<f64>>,
    /// What the partner chose, in words.
    pub(crate) chosen: String,
}

/// The C2 interpolation in x and the root of z. On a line of the table it is the cubic spline through that line.
pub(crate) fn interpolation(table: &Table, lines: &[Line]) -> Drawn {
    let samples = lines.iter().map(|line| interpolation::along(table, line)).collect();
    Drawn { samples, chosen: String::new() }
}

/// The smoother.
pub(crate) fn smoother(table: &Table, lines: &[Line]) -> Drawn {
    let (net, exponent) = smoother::cross_validated(table);
    Drawn { samples: lines::samples(lines, |x, z| net.value(x, z)), chosen: format!("weight 1e{exponent}") }
}

/// The surface of greatest likelihood.
pub(crate) fn likelihood(table: &Table, lines: &[Line]) -> Drawn {
    let best = likelihood::choose(table);
    let samples = lines::samples(lines, |x, z| best.net.value(x, z));
    Drawn { samples, chosen: best.to_string() }
}

/// Which of two lists of places a line runs along, and which it is one of.
impl Direction {
    fn of(self, table: &Table) -> [&[f64]; 2] {
        match self {
            Self::Waterline => [&table.x, &table.z],
            Self::Station => [&table.z, &table.x],
        }
    }
}
