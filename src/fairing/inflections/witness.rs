//! Three sites that prove a bend, and chains of them that prove a number of inflections.

use super::bands::{Bands, Bend};

/// A chord must be missed by more than this part of the size of the values, so that rounding proves nothing.
pub(super) const ROUNDING: f64 = 1e-10;

/// Three sites i < j < k at which every curve within the bands bends one way: no value in the band of j reaches the chord
/// of any values in the bands of i and k. With w = (x_k - x_j) / (x_k - x_i), a full witness has
///
/// ```text
/// (d_j - delta_j) - w (d_i + delta_i) - (1 - w) (d_k + delta_k) = excess > 0
/// ```
///
/// which is a Farkas certificate with the multipliers 1, w and 1 - w.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Witness {
    /// The bend that is proved somewhere between the outer sites.
    pub bend: Bend,
    /// i, j, k.
    pub places: [usize; 3],
    /// By how much the chord is missed, in the unit of the values.
    pub excess: f64,
}

impl Witness {
    /// The excess of three sites as a witness of `bend`, whatever its sign.
    fn excess_of(bands: &Bands, factor: f64, bend: Bend, [i, j, k]: [usize; 3]) -> f64 {
        let (x, d, delta) = (bands.sites(), bands.values(), bands.tolerances());
        let w = (x[k] - x[j]) / (x[k] - x[i]);
        let chord = w * d[i] + (1.0 - w) * d[k];
        let reach = delta[j] + w * delta[i] + (1.0 - w) * delta[k];
        -bend.sign() * (d[j] - chord) - factor * reach
    }

    /// Whether the witness stands for these bands, computed from the numbers alone.
    #[must_use]
    pub fn holds(&self, bands: &Bands) -> bool {
        let [i, j, k] = self.places;
        i < j
            && j < k
            && k < bands.sites().len()
            && Self::excess_of(bands, 1.0, self.bend, self.places) > ROUNDING * bands.size()
    }
}

/// Witnesses of alternating bends, each beginning not before the last cell but one of the one before it. A stretch that
/// begins with the bend `first` changes its bend at least once for each.
///
/// Why: the first run of one bend cannot hold the first witness, i_1 to k_1, so that it hands over to the next run at
/// or before the cell k_1 - 2 to k_1 - 1. The next run therefore holds i_2 >= k_1 - 2 if it reaches k_2, which the
/// second witness forbids. And so on.
#[derive(Debug, Clone, PartialEq)]
pub struct Chain {
    /// The bend at the beginning.
    pub first: Bend,
    /// What stops the runs one after the other.
    pub witnesses: Vec<Witness>,
}

impl Chain {
    /// The chain of the longest runs on a stretch with all tolerances multiplied by `factor`.
    pub(super) fn longest_runs(bands: &Bands, [from, to]: [usize; 2], first: Bend, factor: f64) -> Self {
        let mut witnesses: Vec<Witness> = Vec::new();
        let (mut start, mut bend) = (from, first);
        while let Some(witness) = stop(bands, start, to, bend, factor) {
            start = witness.places[2] - 2;
            witnesses.push(witness);
            bend = bend.opposite();
        }
        Self { first, witnesses }
    }

    /// The number of inflections that it proves for a stretch that begins with [`Chain::first`].
    #[must_use]
    pub fn count(&self) -> usize {
        self.witnesses.len()
    }

    /// Whether the chain proves what it says for the stretch of these first and last sites, from the numbers alone.
    #[must_use]
    pub fn holds(&self, bands: &Bands, [from, to]: [usize; 2]) -> bool {
        let mut start = from;
        for (index, witness) in self.witnesses.iter().enumerate() {
            let [i, _, k] = witness.places;
            if witness.bend != self.first.after(index + 1) || i < start || k > to || !witness.holds(bands) {
                return false;
            }
            start = k - 2;
        }
        true
    }
}

/// What stops the longest run of `bend` that begins at the site `start`: the worst witness against it at the first site
/// that it cannot reach.
fn stop(bands: &Bands, start: usize, to: usize, bend: Bend, factor: f64) -> Option<Witness> {
    let (x, d, delta) = (bands.sites(), bands.values(), bands.tolerances());
    let against = bend.opposite();
    let sign = -against.sign();
    // Seen so that the witness is full: outer sites at their upper limits, the middle one at its lower.
    let upper = |k: usize| sign * d[k] + factor * delta[k];
    let lower = |k: usize| sign * d[k] - factor * delta[k];
    // The steepest way up to the lower limit of j from the upper limit of a site before it, and that site.
    let mut steepest: Vec<(f64, usize)> = Vec::new();
    for k in start + 1..=to {
        let mut worst: Option<Witness> = None;
        for (index, &(slope, i)) in steepest.iter().enumerate() {
            let j = start + 1 + index;
            if slope > (upper(k) - lower(j)) / (x[k] - x[j]) {
                let excess = Witness::excess_of(bands, factor, against, [i, j, k]);
                if excess > ROUNDING * bands.size() && worst.is_none_or(|w| excess > w.excess) {
                    worst = Some(Witness { bend: against, places: [i, j, k], excess });
                }
            }
        }
        if worst.is_some() {
            return worst;
        }
        let ways = (start..k).map(|i| ((lower(k) - upper(i)) / (x[k] - x[i]), i));
        steepest.push(ways.fold((f64::NEG_INFINITY, start), |most, way| if way.0 > most.0 { way } else { most }));
    }
    None
}

/// Between which inner sites j and j + 1 each of `count` changes can stand, for a stretch that begins with `first`: the
/// earliest and the latest j, from the chains read forward and backward. `None` when the chains forbid the number.
pub(super) fn windows(bands: &Bands, [from, to]: [usize; 2], first: Bend, count: usize) -> Option<Vec<[usize; 2]>> {
    let forward = Chain::longest_runs(bands, [from, to], first, 1.0);
    let mirrored = mirror(bands, [from, to]);
    let backward = Chain::longest_runs(&mirrored, [0, to - from], first.after(count), 1.0);
    if forward.count() > count || backward.count() > count || (count > 0 && to - from < count + 2) {
        return None;
    }
    // Inner sites are from + 1 ..= to - 1, and every run holds one of them.
    let mut result: Vec<[usize; 2]> = (0..count).map(|m| [from + 1 + m, to - 1 - (count - m)]).collect();
    for (window, witness) in result.iter_mut().zip(&forward.witnesses) {
        window[1] = window[1].min(witness.places[2] - 2);
    }
    for (window, witness) in result.iter_mut().rev().zip(&backward.witnesses) {
        window[0] = window[0].max(to + 1 - witness.places[2]);
    }
    result.iter().all(|window| window[0] <= window[1]).then_some(result)
}

/// The stretch read from its end.
fn mirror(bands: &Bands, stretch: [usize; 2]) -> Bands {
    let part = bands.part(stretch);
    let backward = |list: &[f64], sign: f64| list.iter().rev().map(|value| sign * value).collect::<Vec<f64>>();
    let (x, d, delta) = (backward(part.sites(), -1.0), backward(part.values(), 1.0), backward(part.tolerances(), 1.0));
    // The parts of valid bands are valid; a copy of the part stands in where that were not so.
    Bands::new(x, d, delta, Vec::new()).unwrap_or(part)
}
