//! The wave resistance as a term of a convex program over half-breadths.
//!
//! ```text
//! minimise    J(c) + w R(c),     R = 1/n sum over speeds of R_W(c) / R_W(first hull)
//! ```
//!
//! subject to the rows of the program. R_W of thin ships (Michell 1898) is a convex quadratic form of half-breadths on a
//! chart with level waterlines, so that the whole is one convex quadratic program. That least wave resistance alone is no
//! well-posed problem, and needs a term of this kind, is known (Dambrine, Pierre and Rousseaux 2016, who add a Dirichlet energy).
//! Here J is the bending of the change from a parent, or the energy of the move from the fair hull of a table. Signs of curvature,
//! displacement and centres are rows.

use super::michell::roots::roots;
use super::michell::{ThinShip, WaveForms};
use super::water::Water;
use crate::hull::{Hull, HullError};
use crate::numeric::join;
use crate::qp::SparseRows;

/// Most half-breadths that may change: the linear forms of R_W at a speed take about 12 kB for each.
const MOST_FREE: usize = 5000;
/// R that the middle one of seven weights gains, about.
const MIDDLE_GAIN: f64 = 0.1;
/// Factor from one weight to the next.
const WEIGHT_STEP: f64 = 4.0;

/// What is asked of the wave resistance.
#[derive(Debug, Clone, PartialEq)]
pub struct WaveRequest {
    /// Froude numbers U / sqrt(g L_PP).
    pub froude_numbers: Vec<f64>,
    /// The weight w [m^2]; seven of them, and the knee between, where none is given.
    pub weight: Option<f64>,
    /// How far control half-breadths may move from the first hull \[m\]; none: as far as the rows let them.
    pub within: Option<f64>,
    /// The water.
    pub water: Water,
}

/// One weight with what it comes to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WaveTrade {
    /// w [m^2].
    pub weight: f64,
    /// R: mean of R_W over that of the first hull.
    pub ratio: f64,
    /// J, less that without a weight [m^2].
    pub energy: f64,
    /// Root of the mean square of the moves of control half-breadths \[m\].
    pub moves: f64,
    /// Inflections of stations and waterlines.
    pub inflections: usize,
    /// Whether the signs of curvature of the first hull are rows.
    pub keeps_signs: bool,
}

/// What the wave resistance comes to.
#[derive(Debug, Clone, PartialEq)]
pub struct WaveResult {
    /// Froude numbers.
    pub froude_numbers: Vec<f64>,
    /// R_W of the first hull at each \[N\].
    pub before: Vec<f64>,
    /// R_W of the hull of the weight that was taken at each \[N\].
    pub after: Vec<f64>,
    /// The weights that were solved, rising.
    pub trades: Vec<WaveTrade>,
    /// The one that was taken.
    pub taken: usize,
}

/// R around the start of a program, over its free control values.
pub struct WaveTerm {
    /// R of the start.
    pub value: f64,
    /// g, by the free control values [1/m].
    pub gradient: Vec<f64>,
    /// Columns of a matrix F over the free control values [1/m]: R(c + d) = R + g'd + |F'd|^2.
    pub roots: Vec<Vec<f64>>,
}

impl WaveRequest {
    /// Speeds of the Froude numbers for L_PP [m/s].
    fn speeds(&self, between: f64) -> Vec<f64> {
        let unit = (self.water.gravity * between).sqrt();
        self.froude_numbers.iter().map(|number| number * unit).collect()
    }

    /// R_W of a hull at the Froude numbers \[N\].
    ///
    /// # Errors
    /// [`HullError`] where the hull does not float at its draught \[m\].
    pub fn resistances(&self, hull: &Hull, draught: f64) -> Result<Vec<f64>, HullError> {
        let speeds = self.speeds(hull.particulars().length_between_perpendiculars);
        Ok(ThinShip::new(hull, draught)?.wave_resistances(&speeds, &self.water))
    }

    /// The weights to solve [m^2], rising: the one that is asked for, or seven by factors of [`WEIGHT_STEP`], the middle one of
    /// which lowers R by about [`MIDDLE_GAIN`] below its value `without` a weight. `ratio` is R at a weight, none where there is
    /// no answer; `unit` is half the breadth \[m\]. The search begins with a weight so small that the gain grows with it.
    pub fn weights(&self, without: f64, unit: f64, ratio: impl Fn(f64) -> Option<f64>) -> Vec<f64> {
        if let Some(weight) = self.weight {
            return vec![weight];
        }
        let mut weight = 1e-4 * unit * unit;
        for _ in 0..8 {
            let Some(gain) = ratio(weight).map(|ratio| without - ratio).filter(|gain| gain.is_finite()) else { break };
            if gain > 0.2 * MIDDLE_GAIN {
                weight *= 0.1;
            } else if gain < 1e-3 * MIDDLE_GAIN {
                weight *= 30.0;
            } else {
                weight *= MIDDLE_GAIN / gain;
                break;
            }
        }
        (-3..=3).map(|k| weight * WEIGHT_STEP.powi(k)).collect()
    }
}

/// Why R_W is no term of a program.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum NoWaveTerm {
    /// Waterlines are no lines of the net.
    #[error("the waterlines of {0} are not lines of its net, over which R_W is a quadratic form")]
    NotLevel(String),
    /// Too many half-breadths that may change.
    #[error("{0} has {1} half-breadths below the waterline that may change: at most {MOST_FREE}")]
    TooMany(String, usize),
    /// The hull does not float at its draught.
    #[error(transparent)]
    Hull(#[from] HullError),
}

impl WaveTerm {
    /// R about a hull over the control values `free`, by their indices in the net; `before` are the R_W of the first hull \[N\].
    ///
    /// # Errors
    /// [`NoWaveTerm`] where waterlines are not lines of the net, or too many of its values are free.
    pub fn new(
        start: &Hull,
        free: &[usize],
        request: &WaveRequest,
        draught: f64,
        before: &[f64],
    ) -> Result<Self, NoWaveTerm> {
        let Some(forms) = WaveForms::new(start, draught) else {
            return Err(NoWaveTerm::NotLevel(start.name().to_owned()));
        };
        if free.len() > MOST_FREE {
            return Err(NoWaveTerm::TooMany(start.name().to_owned(), free.len()));
        }
        let speeds = request.speeds(start.particulars().length_between_perpendiculars);
        let mut term = Self { value: 0.0, gradient: vec![0.0; free.len()], roots: Vec::new() };
        let at = |k: usize| forms.at(speeds[k], &request.water, free);
        for pair in (0..speeds.len()).collect::<Vec<_>>().chunks(2) {
            let (first, second) = join(|| at(pair[0]), || pair.get(1).map(|&k| at(k)));
            for (&k, found) in pair.iter().zip([Some(first), second].into_iter().flatten()) {
                let part = 1.0 / (before[k] * speeds.len() as f64);
                term.value += part * found.resistance;
                term.gradient.iter_mut().zip(&found.gradient).for_each(|(sum, g)| *sum += part * g);
                let sized = |mut root: Vec<f64>| {
                    root.iter_mut().for_each(|value| *value *= part.sqrt());
                    root
                };
                term.roots.extend(found.roots.into_iter().map(sized));
            }
        }
        term.roots = roots(&term.roots);
        Ok(term)
    }

    /// The forms whose half squares are w |F'd|^2, over the unknowns that the free control values are.
    #[must_use]
    pub fn squares(&self, unknowns: usize, places: &[usize], weight: f64) -> SparseRows {
        let mut squares = SparseRows::new(unknowns);
        for root in &self.roots {
            squares.push(places.iter().zip(root).map(|(&place, value)| (place, (2.0 * weight).sqrt() * value)));
        }
        squares
    }

    /// R after a change of the free control values \[m\].
    pub fn after(&self, change: &[f64]) -> f64 {
        let along = |form: &[f64]| form.iter().zip(change).map(|(a, d)| a * d).sum::<f64>();
        self.value + along(&self.gradient) + self.roots.iter().map(|root| along(root).powi(2)).sum::<f64>()
    }
}

/// The knee of trades with rising weights: the greatest distance from the chord between first and last in R and the root of
/// J, each over its range.
pub fn knee(trades: &[WaveTrade]) -> usize {
    let Some((first, last)) = trades.first().zip(trades.last()) else { return 0 };
    let cost = |trade: &WaveTrade| trade.energy.max(0.0).sqrt();
    let ranges = [first.ratio - last.ratio, cost(last) - cost(first)];
    if ranges.iter().any(|range| *range <= 0.0) {
        return 0;
    }
    let gain = |trade: &WaveTrade| (first.ratio - trade.ratio) / ranges[0] - (cost(trade) - cost(first)) / ranges[1];
    let best = trades.iter().enumerate().max_by(|a, b| gain(a.1).total_cmp(&gain(b.1)).then(b.0.cmp(&a.0)));
    best.map_or(0, |(k, _)| k)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// R = 1 / (1 + s), J = s^2: the knee is where the slope is that of the chord.
    #[test]
    fn the_knee_is_farthest_from_the_chord() {
        let of = |s: f64| WaveTrade {
            weight: s,
            ratio: 1.0 / (1.0 + s),
            energy: s * s,
            moves: s,
            inflections: 0,
            keeps_signs: true,
        };
        let trades: Vec<WaveTrade> = [0.0, 0.2, 0.4, 0.7, 1.0, 2.0, 3.0].map(of).to_vec();
        // 1 - 1/(1+s) over 3/4 less s/3 is greatest at s = 1.
        assert_eq!(knee(&trades), 4);
        assert_eq!(knee(&trades[..1]), 0);
    }
}
