//! Sites, values and tolerances, split at the knuckles.

/// Which way a curve bends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Bend {
    /// y'' > 0: below its chords.
    Hollow,
    /// y'' < 0: above its chords.
    Full,
}

impl Bend {
    /// The other one.
    #[must_use]
    pub fn opposite(self) -> Self {
        match self {
            Self::Hollow => Self::Full,
            Self::Full => Self::Hollow,
        }
    }

    /// The sign of y''.
    #[must_use]
    pub fn sign(self) -> f64 {
        match self {
            Self::Hollow => 1.0,
            Self::Full => -1.0,
        }
    }

    /// `hollow` or `full`.
    #[must_use]
    pub fn as_str(self) -> &'static str {
        match self {
            Self::Hollow => "hollow",
            Self::Full => "full",
        }
    }

    /// This bend after `changes` changes.
    #[must_use]
    pub fn after(self, changes: usize) -> Self {
        if changes.is_multiple_of(2) { self } else { self.opposite() }
    }
}

/// Why numbers make no bands.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum BandsError {
    /// Fewer than two sites.
    #[error("a curve needs two points at least; there are {0}")]
    TooFew(usize),
    /// Lists of different lengths.
    #[error("{found} {what} for {expected} sites")]
    Count {
        /// Of what.
        what: &'static str,
        /// Number found.
        found: usize,
        /// Number wanted.
        expected: usize,
    },
    /// A number that is none, or a tolerance below 0.
    #[error("{what} of point {index} is {value}")]
    Number {
        /// Of what.
        what: &'static str,
        /// Which point, from 0.
        index: usize,
        /// Its value.
        value: f64,
    },
    /// Sites that do not increase.
    #[error("point {index}: its abscissa does not lie beyond that of the point before it")]
    Order {
        /// The second of the two points, from 0.
        index: usize,
    },
    /// A knuckle that is no inner site.
    #[error("a knuckle at point {0}, which is no inner point or is named twice")]
    Knuckle(usize),
}

/// |y(x_k) - d_k| <= delta_k at rising sites x_k.
#[derive(Debug, Clone, PartialEq)]
pub struct Bands {
    sites: Vec<f64>,
    values: Vec<f64>,
    tolerances: Vec<f64>,
    knuckles: Vec<usize>,
}

impl Bands {
    /// Takes sites x_k, values d_k, tolerances delta_k (0 holds a point) and the indices of the knuckles, rising.
    ///
    /// # Errors
    /// [`BandsError`] for the first part that is wrong.
    pub fn new(
        sites: Vec<f64>,
        values: Vec<f64>,
        tolerances: Vec<f64>,
        knuckles: Vec<usize>,
    ) -> Result<Self, BandsError> {
        let count = sites.len();
        if count < 2 {
            return Err(BandsError::TooFew(count));
        }
        for (what, found) in [("values", values.len()), ("tolerances", tolerances.len())] {
            if found != count {
                return Err(BandsError::Count { what, found, expected: count });
            }
        }
        for (what, list) in [("the abscissa", &sites), ("the ordinate", &values), ("the tolerance", &tolerances)] {
            if let Some(index) = list.iter().position(|value| !value.is_finite()) {
                return Err(BandsError::Number { what, index, value: list[index] });
            }
        }
        if let Some(index) = tolerances.iter().position(|&value| value < 0.0) {
            return Err(BandsError::Number { what: "the tolerance", index, value: tolerances[index] });
        }
        if let Some(index) = sites.windows(2).position(|pair| pair[1] <= pair[0]) {
            return Err(BandsError::Order { index: index + 1 });
        }
        for (place, &index) in knuckles.iter().enumerate() {
            if index == 0 || index + 1 >= count || (place > 0 && knuckles[place - 1] >= index) {
                return Err(BandsError::Knuckle(index));
            }
        }
        Ok(Self { sites, values, tolerances, knuckles })
    }

    /// x_k.
    #[must_use]
    pub fn sites(&self) -> &[f64] {
        &self.sites
    }

    /// d_k.
    #[must_use]
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// delta_k.
    #[must_use]
    pub fn tolerances(&self) -> &[f64] {
        &self.tolerances
    }

    /// Indices of the knuckles.
    #[must_use]
    pub fn knuckles(&self) -> &[usize] {
        &self.knuckles
    }

    /// First and last site of every stretch between ends and knuckles.
    #[must_use]
    pub fn stretches(&self) -> Vec<[usize; 2]> {
        let mut ends = vec![0];
        ends.extend(&self.knuckles);
        ends.push(self.sites.len() - 1);
        ends.windows(2).map(|pair| [pair[0], pair[1]]).collect()
    }

    /// The sites `from` to `to`, both included, without knuckles.
    pub(super) fn part(&self, [from, to]: [usize; 2]) -> Self {
        Self {
            sites: self.sites[from..=to].to_vec(),
            values: self.values[from..=to].to_vec(),
            tolerances: self.tolerances[from..=to].to_vec(),
            knuckles: Vec::new(),
        }
    }

    /// The size of the values, to which rounding is relative: largest minus smallest, at least the largest tolerance.
    #[must_use]
    pub fn size(&self) -> f64 {
        let (low, high) =
            self.values.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), &value| (a.min(value), b.max(value)));
        let widest = self.tolerances.iter().fold(0.0_f64, |most, &value| most.max(value));
        let size = (high - low).max(widest);
        if size > 0.0 { size } else { high.abs().max(1.0) }
    }
}
