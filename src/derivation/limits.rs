//! The interval of each target, the others given: what half-breadths on the chart of the daughter reach without passing the
//! centreplane or B/2, without sections or waterlines that pass each other, and with the signs of curvature of the parent.
//!
//! Linear programs, one for each end. Their answers are evaluated: an end is the value of a hull, which is feasible as far as
//! rounding goes. KM and wetted surface are linearised.

use super::nearest::{Search, with_breadths};
use super::pool::Kind;
use super::quantity::{Quantity, Reference, equation, value_of};
use super::request::Target;
use crate::hull::Hull;

/// Most rounds in which missed signs come into a linear program; after them the interval is that without signs.
const ROUNDS: usize = 10;

/// What a quantity of the daughter can be while the others are as they are.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Interval {
    /// The quantity.
    pub quantity: Quantity,
    /// Its least value.
    pub low: f64,
    /// Its greatest value.
    pub high: f64,
}

impl Interval {
    /// Whether a value is within it, by more than rounding.
    #[must_use]
    pub fn holds(&self, value: f64) -> bool {
        let slack = 1e-9 * self.low.abs().max(self.high.abs());
        (self.low - slack..=self.high + slack).contains(&value)
    }

    /// The value within it that is nearest.
    #[must_use]
    pub fn nearest(&self, value: f64) -> f64 {
        value.clamp(self.low, self.high)
    }
}

/// The interval of `quantity` with the `others` given; none where they alone are infeasible. Where the signs of curvature of the
/// parent are, it is that without them.
pub(super) fn interval(
    parent: &Hull,
    start: &Hull,
    reference: &Reference,
    quantity: Quantity,
    others: &[Target],
    body: Option<[f64; 2]>,
) -> Option<Interval> {
    let of = |signs: bool| {
        let end = |way: f64| extreme((parent, start), reference, (quantity, way), (others, body), signs);
        Some([end(1.0)?, end(-1.0)?])
    };
    let [low, high] = of(true).or_else(|| of(false))?;
    Some(Interval { quantity, low: low.min(high), high: high.max(low) })
}

/// The least value of `quantity`, or the greatest for a `way` of -1.
fn extreme(
    (parent, start): (&Hull, &Hull),
    reference: &Reference,
    (quantity, way): (Quantity, f64),
    (others, body): (&[Target], Option<[f64; 2]>),
    signs: bool,
) -> Option<f64> {
    let mut search = Search::new(parent, start, reference, others, body);
    search.rounds = ROUNDS;
    if !signs {
        search.without_signs();
    }
    // A linear program needs its limits from the beginning.
    for (taken, candidate) in search.taken.iter_mut().zip(&search.candidates) {
        *taken = candidate.kind != Kind::Sign;
    }
    let equations = search.equations(start);
    let now = value_of(quantity, start, reference);
    let gradient = equation(quantity, now, start, reference).gradient;
    let towards: Vec<f64> = search.freedom.gradient(&gradient).iter().map(|g| way * search.unit * g).collect();
    let base = search.base.clone();
    let answer = search.solve(&equations, &base, Some(&towards)).ok()?;
    let hull = with_breadths(start, &answer.y).ok()?;
    Some(value_of(quantity, &hull, reference))
}
