//! The wave resistance as a term of the program of the nearest hull.
//!
//! ```text
//! minimise    J(c) + w R(c),     R = 1/n sum over speeds of R_W(c) / R_W(scaled parent)
//! ```
//!
//! subject to all rows of the nearest hull. R_W of thin ships (Michell 1898) is a convex quadratic form of half-breadths on a
//! chart with level waterlines, so that the whole is one convex quadratic program. That least wave resistance alone is no
//! well-posed problem, and needs a term of this kind, is known (Dambrine, Pierre and Rousseaux 2016, who add a Dirichlet energy).
//! Here the term is the bending of the change, with the signs of curvature, displacement and centres of the parent held.

use nalgebra::{DMatrix, DVector};

use super::refusal::Refusal;
use crate::hull::Hull;
use crate::numeric::join;
use crate::resistance::{ThinShip, Water, WaveForms};

/// Most half-breadths that may change: R_W couples each with all others.
const MOST_FREE: usize = 1500;

/// What is asked of the wave resistance.
#[derive(Debug, Clone, PartialEq)]
pub struct WaveRequest {
    /// Froude numbers U / sqrt(g L_PP).
    pub froude_numbers: Vec<f64>,
    /// The weight w [m^2]; seven of them, and the knee between, where none is given.
    pub weight: Option<f64>,
    /// How far control half-breadths may move from the scaled parent, or from where the shift of sections puts them \[m\].
    pub within: Option<f64>,
    /// The water.
    pub water: Water,
}

/// One weight with what it comes to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WaveTrade {
    /// w [m^2].
    pub weight: f64,
    /// R: mean of R_W over that of the scaled parent.
    pub ratio: f64,
    /// J of the change [m^2].
    pub energy: f64,
    /// Root of the mean square of the moves of control half-breadths \[m\].
    pub moves: f64,
    /// Inflections of stations and waterlines.
    pub inflections: usize,
    /// Whether the signs of curvature of the parent are kept.
    pub keeps_signs: bool,
}

/// What the wave resistance comes to.
#[derive(Debug, Clone, PartialEq)]
pub struct WaveResult {
    /// Froude numbers.
    pub froude_numbers: Vec<f64>,
    /// R_W of the scaled parent at each \[N\].
    pub before: Vec<f64>,
    /// R_W of the daughter at each \[N\].
    pub after: Vec<f64>,
    /// The weights that were solved, rising.
    pub trades: Vec<WaveTrade>,
    /// The one that was taken.
    pub taken: usize,
}

/// R around the start of a program, over its free control values.
pub(super) struct WaveTerm {
    /// R of the start.
    pub(super) value: f64,
    pub(super) gradient: Vec<f64>,
    pub(super) form: DMatrix<f64>,
}

/// Speeds of Froude numbers [m/s].
pub(super) fn speeds(request: &WaveRequest, between: f64) -> Vec<f64> {
    let unit = (request.water.gravity * between).sqrt();
    request.froude_numbers.iter().map(|number| number * unit).collect()
}

/// R_W of a hull at the Froude numbers \[N\].
///
/// # Errors
/// E420 where the hull does not float at its draught.
pub(super) fn resistances(hull: &Hull, request: &WaveRequest, draught: f64) -> Result<Vec<f64>, Refusal> {
    let speeds = speeds(request, hull.particulars().length_between_perpendiculars);
    let ship = ThinShip::new(hull, draught).map_err(|error| Refusal::hull(&error))?;
    Ok(ship.wave_resistances(&speeds, &request.water))
}

impl WaveTerm {
    /// # Errors
    /// E425 where waterlines are not lines of the net.
    pub(super) fn new(
        start: &Hull,
        free: &[usize],
        request: &WaveRequest,
        draught: f64,
        before: &[f64],
    ) -> Result<Self, Refusal> {
        let Some(forms) = WaveForms::new(start, draught) else { return Err(not_level(start)) };
        if free.len() > MOST_FREE {
            return Err(too_many(start, free.len()));
        }
        let speeds = speeds(request, start.particulars().length_between_perpendiculars);
        let count = free.len();
        let mut term = Self { value: 0.0, gradient: vec![0.0; count], form: DMatrix::zeros(count, count) };
        let at = |k: usize| forms.at(speeds[k], &request.water, free);
        for pair in (0..speeds.len()).collect::<Vec<_>>().chunks(2) {
            let (first, second) = join(|| at(pair[0]), || pair.get(1).map(|&k| at(k)));
            for (&k, found) in pair.iter().zip([Some(first), second].into_iter().flatten()) {
                let part = 1.0 / (before[k] * speeds.len() as f64);
                term.value += part * found.resistance;
                term.gradient.iter_mut().zip(&found.gradient).for_each(|(sum, g)| *sum += part * g);
                term.form += part * found.form;
            }
        }
        Ok(term)
    }

    /// R after a change of the free control values \[m\].
    pub(super) fn after(&self, change: &[f64]) -> f64 {
        let change = DVector::from_row_slice(change);
        let linear: f64 = self.gradient.iter().zip(change.iter()).map(|(g, c)| g * c).sum();
        self.value + linear + (&self.form * &change).dot(&change)
    }
}

fn too_many(hull: &Hull, count: usize) -> Refusal {
    let message =
        format!("{} has {count} half-breadths that may change, and R_W couples each with all others", hull.name());
    let remedy = format!("Derive from a hull with a coarser net: at most {MOST_FREE}");
    Refusal::new("E425", vec!["wave-resistance"], message, remedy)
}

fn not_level(hull: &Hull) -> Refusal {
    let message =
        format!("the waterlines of {} are not lines of its net, over which R_W is a quadratic form", hull.name());
    let remedy = "Derive from a hull with a level keel and level waterlines, as of generate";
    Refusal::new("E425", vec!["wave-resistance"], message, remedy.to_owned())
}

/// The knee of trades with rising weights: the greatest distance from the chord between first and last in R and the root of
/// J, each over its range.
pub(super) fn knee(trades: &[WaveTrade]) -> usize {
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
