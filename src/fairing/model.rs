//! The quadratic model that fairing a curve and fairing a surface have in common.
//!
//! Unknown control values c; an energy c'E c; readings a_k c = d_k with weights w_k (one over the square of the noise
//! level relative to that of the others) and tolerances; control values that are known; and linear limits l <= r c <= u
//! with names. What smooths ([`super::smoothing`]) and what is certified ([`super::program`]) sees nothing else of a
//! ship.

use crate::numeric::SymmetricBand;
use crate::qp::SparseRows;

/// A row of a matrix: (column, value), columns rising.
pub type Row = Vec<(usize, f64)>;

/// One offset: what is read where.
#[derive(Debug, Clone, PartialEq)]
pub struct Reading {
    /// Basis values over the control values: the surface there is row . c \[m\].
    pub row: Row,
    /// What was read \[m\].
    pub value: f64,
    /// 1 over the square of the relative noise level; 0 leaves the reading out.
    pub weight: f64,
    /// How far the surface may depart from the reading \[m\]; none: as far as it likes.
    pub tolerance: Option<f64>,
    /// What its line is too wide by \[m\]. It is taken off before the reading is smoothed, and not for its tolerance.
    pub shared: f64,
}

/// A linear limit.
#[derive(Debug, Clone, PartialEq)]
pub struct Limit {
    /// Row over the control values.
    pub row: Row,
    /// Lower limit, minus infinity for none.
    pub lower: f64,
    /// Upper limit, infinity for none.
    pub upper: f64,
}

/// The model.
#[derive(Debug, Clone)]
pub struct Model {
    /// Energy: c'E c, banded in the order of the unknowns.
    pub energy: SymmetricBand,
    /// What was read.
    pub readings: Vec<Reading>,
    /// Control values that are known \[m\].
    pub known: Vec<Option<f64>>,
    /// What straight parts ask: c'S c in the size of one reading of weight 1, whatever the smoothing; known values
    /// there are 0.
    pub straight: Option<SymmetricBand>,
    /// Control values to stay near where nothing else is said \[m\].
    pub start: Option<Vec<f64>>,
    /// What is added to every control value of the readings and the start before they are smoothed \[m\]; the
    /// tolerances go on being counted from the readings as they are.
    pub carried: Option<Vec<f64>>,
    /// The answer where nothing is asked for.
    pub stationary: Option<Stationary>,
}

/// A field F, stationary for its weight w. Its energy grows with a move d = c - F by
///
/// ```text
/// E(c) - E(F) = 2 g'd + d'E d,   g = A'W (y - b - A F) / w.
/// ```
///
/// Here b is what the lines of the readings are too wide by.
///
/// For c'E c itself g would be E F, which has what E is on the ends of the hull.
#[derive(Debug, Clone)]
pub struct Stationary {
    /// w: of the energy against the sum of squares.
    pub weight: f64,
    /// F \[m\].
    pub net: Vec<f64>,
    /// E(F), over the whole rectangle of the field.
    pub energy: f64,
    /// What a move of the whole hull costs, d'Q d: its mean square and its bending.
    pub moves: SymmetricBand,
}

/// The model over its free unknowns x: minimise sum w_k (a_k x - d_k)^2 + lambda (x'E x + 2 e'x). The control values are
/// those of an origin and x. Known values are their own origin. That of the free ones is the field with what is carried,
/// or 0 without a field. Moves of millimetres are not lost in the breadth of a ship.
#[derive(Debug, Clone)]
pub struct Reduced {
    /// Indices of the free control values in the whole.
    pub free: Vec<usize>,
    /// Where a control value stands among the free ones.
    pub place: Vec<Option<usize>>,
    /// E over the free values.
    pub energy: SymmetricBand,
    /// e: E_fk c_k of known values c_k; g of a field ([`Stationary`]).
    pub pull: Vec<f64>,
    /// The energy of the origin.
    pub constant: f64,
    /// Rows a_k over the free values.
    pub data: SparseRows,
    /// S over the free values.
    pub straight: Option<SymmetricBand>,
    /// Free unknowns to stay near.
    pub start: Option<Vec<f64>>,
    /// Q over the free values.
    pub moves: Option<SymmetricBand>,
    /// d_k less what the origin contributes.
    pub values: Vec<f64>,
    /// The control values for x = 0 \[m\].
    origin: Vec<f64>,
}

impl Model {
    /// Number of control values.
    #[must_use]
    pub fn unknowns(&self) -> usize {
        self.known.len()
    }

    /// The energy of control values: c'E c, or that of a field and of the move from it ([`Stationary`]).
    #[must_use]
    pub fn energy_of(&self, c: &[f64]) -> f64 {
        let Some(field) = &self.stationary else { return self.energy.quadratic(c) };
        let moves: Vec<f64> = c.iter().zip(&field.net).map(|(c, f)| c - f).collect();
        let along: f64 = self.slope(field).iter().zip(&moves).map(|(g, d)| g * d).sum();
        field.energy + 2.0 * along + self.energy.quadratic(&moves)
    }

    /// g of a field.
    fn slope(&self, field: &Stationary) -> Vec<f64> {
        let mut slope = vec![0.0; field.net.len()];
        for reading in &self.readings {
            let left = reading.weight * (reading.value - reading.shared - value(&reading.row, &field.net));
            reading.row.iter().for_each(|&(i, a)| slope[i] += left * a / field.weight);
        }
        slope
    }

    /// Residuals a_k c - d_k \[m\].
    #[must_use]
    pub fn residuals(&self, c: &[f64]) -> Vec<f64> {
        self.readings.iter().map(|reading| value(&reading.row, c) - reading.value).collect()
    }

    /// sum w_k (a_k c - d_k)^2 \[m^2\] to the readings as they are.
    #[must_use]
    pub fn misfit(&self, c: &[f64], weights: &[f64]) -> f64 {
        self.residuals(c).iter().zip(weights).map(|(r, w)| w * r.powi(2)).sum()
    }

    /// A reading without what its line is too wide by, with what is carried \[m\].
    fn wished(&self, reading: &Reading) -> f64 {
        reading.value - reading.shared + self.carried.as_ref().map_or(0.0, |carried| value(&reading.row, carried))
    }

    /// Takes the known control values out.
    #[must_use]
    pub fn reduced(&self) -> Reduced {
        let n = self.unknowns();
        let free: Vec<usize> = (0..n).filter(|&i| self.known[i].is_none()).collect();
        let mut place = vec![None; n];
        free.iter().enumerate().for_each(|(k, &i)| place[i] = Some(k));
        let carried = |i: usize| self.carried.as_ref().map_or(0.0, |carried| carried[i]);
        let field = |i: usize| self.stationary.as_ref().map_or(0.0, |field| field.net[i] + carried(i));
        let known = |(i, known): (usize, &Option<f64>)| known.unwrap_or_else(|| field(i));
        let origin: Vec<f64> = self.known.iter().enumerate().map(known).collect();
        let reduce = |band: &SymmetricBand| {
            let w = band.width();
            let mut reduced = SymmetricBand::zeros(free.len(), w.min(free.len().saturating_sub(1)));
            for (k, &i) in free.iter().enumerate() {
                for (j, l) in place.iter().enumerate().take(i + 1).skip(i.saturating_sub(w)) {
                    if let Some(l) = *l {
                        let value = band.get(i, j);
                        if value != 0.0 {
                            reduced.add(k, l, value);
                        }
                    }
                }
            }
            reduced
        };
        let (energy, straight) = (reduce(&self.energy), self.straight.as_ref().map(reduce));
        let mut data = SparseRows::new(free.len());
        let mut values = Vec::with_capacity(self.readings.len());
        for reading in &self.readings {
            let (row, offset) = split(&reading.row, &place, &origin);
            data.push(row);
            values.push(self.wished(reading) - offset);
        }
        let (pull, constant) = match &self.stationary {
            Some(field) => (self.slope(field), field.energy),
            None => (self.energy.apply(&origin), self.energy.quadratic(&origin)),
        };
        Reduced {
            pull: free.iter().map(|&i| pull[i]).collect(),
            constant,
            start: self.start.as_ref().map(|start| free.iter().map(|&i| start[i] + carried(i) - origin[i]).collect()),
            moves: self.stationary.as_ref().map(|known| reduce(&known.moves)),
            free,
            place,
            energy,
            straight,
            data,
            values,
            origin,
        }
    }
}

impl Reduced {
    /// All control values for unknowns x.
    #[must_use]
    pub fn expand(&self, x: &[f64]) -> Vec<f64> {
        let mut all = self.origin.clone();
        self.free.iter().zip(x).for_each(|(&i, &value)| all[i] += value);
        all
    }

    /// The unknowns x of control values.
    #[must_use]
    pub fn unknowns_of(&self, net: &[f64]) -> Vec<f64> {
        self.free.iter().map(|&i| net[i] - self.origin[i]).collect()
    }

    /// A row over the unknowns, and what the origin contributes.
    #[must_use]
    pub fn row(&self, row: &[(usize, f64)]) -> (Row, f64) {
        split(row, &self.place, &self.origin)
    }
}

fn split(row: &[(usize, f64)], place: &[Option<usize>], origin: &[f64]) -> (Row, f64) {
    let mut offset = 0.0;
    let mut kept = Row::with_capacity(row.len());
    for &(column, value) in row {
        offset += value * origin[column];
        if let Some(k) = place[column] {
            kept.push((k, value));
        }
    }
    (kept, offset)
}

/// row . c.
#[must_use]
pub fn value(row: &[(usize, f64)], c: &[f64]) -> f64 {
    row.iter().map(|&(column, value)| value * c[column]).sum()
}

/// By how much a net breaks a limit.
pub(super) fn violated(limit: &Limit, net: &[f64]) -> f64 {
    let y = value(&limit.row, net);
    (limit.lower - y).max(y - limit.upper).max(0.0)
}
