//! The wave resistance against bending: one program for each weight, and the knee of seven.

use super::derive::{Derived, Job};
use super::inflections::{counted_planes, inflections};
use super::nearest::{Failed, breadths};
use super::refusal::Refusal;
use super::waves::{WaveRequest, WaveResult, WaveTerm, WaveTrade, knee, resistances};
use crate::hull::Hull;

/// R that the middle one of seven weights of the wave resistance gains, about.
const MIDDLE_GAIN: f64 = 0.1;
/// Factor from one weight of the wave resistance to the next.
const WEIGHT_STEP: f64 = 4.0;

/// That no weight of the wave resistance has a daughter.
fn no_weight(request: &WaveRequest, failed: Option<&Failed>) -> Refusal {
    let left = match failed {
        Some(Failed::Astray(left)) => format!(" (the last step left {left:.1e})"),
        _ => String::new(),
    };
    let (words, within) = match request.within {
        Some(most) => (vec!["within"], format!(" within {:.1} mm", 1e3 * most)),
        None => (vec!["wave-resistance"], String::new()),
    };
    let message = format!("no hull{within} of the start meets the targets with a weight of the wave resistance{left}");
    Refusal::new("E420", words, message, "Allow more with --within, or free a target that is kept".to_owned())
}

impl Job<'_> {
    /// The daughter of least bending and wave resistance: for the weight that is given, or for seven of which the knee is taken.
    pub(super) fn with_waves(
        &self,
        request: &WaveRequest,
        plain: Derived,
        start: &Hull,
        amplitudes: [f64; 2],
    ) -> Result<Derived, Vec<Refusal>> {
        let draught = self.reference.draught;
        let before = resistances(self.scaled, request, draught).map_err(|refusal| vec![refusal])?;
        let free = self.search(start).freedom.points;
        let term = WaveTerm::new(start, &free, request, draught, &before).map_err(|refusal| vec![refusal])?;
        let planes = counted_planes(self.scaled, self.conventions.stations);
        let base = breadths(start);
        let moves = |hull: &Hull| -> Vec<f64> {
            let after = breadths(hull);
            free.iter().map(|&k| after[k] - base[k]).collect()
        };
        let solved = |weight: f64| {
            let mut search = self.search(start);
            search.with_waves(&term, weight);
            request.within.into_iter().for_each(|most| search.within(most));
            let derived = self.nearest_to(search, amplitudes)?;
            let change = moves(&derived.hull);
            let square = change.iter().map(|c| c * c).sum::<f64>() / change.len().max(1) as f64;
            let trade = WaveTrade {
                weight,
                ratio: term.after(&change),
                energy: derived.energy,
                moves: square.sqrt(),
                inflections: inflections(&derived.hull, &planes),
                keeps_signs: derived.keeps_signs,
            };
            Ok::<_, Failed>((derived, trade))
        };
        let weights = match request.weight {
            Some(weight) => vec![weight],
            None => self.weights_of_waves(&term, &plain, &moves, &solved),
        };
        let (mut found, mut failure) = (Vec::new(), None);
        for weight in weights {
            match solved(weight) {
                Ok(one) => found.push(one),
                Err(failed) => failure = Some(failed),
            }
        }
        if found.is_empty() {
            return Err(vec![no_weight(request, failure.as_ref())]);
        }
        let trades: Vec<WaveTrade> = found.iter().map(|(_, trade)| *trade).collect();
        let taken = knee(&trades);
        let (derived, trade) = found.swap_remove(taken);
        let after = resistances(&derived.hull, request, draught).map_err(|refusal| vec![refusal])?;
        let froude_numbers = request.froude_numbers.clone();
        let waves = WaveResult { froude_numbers, before, after, trades, taken };
        Ok(Derived { inflections: [plain.inflections[0], trade.inflections], waves: Some(waves), ..derived })
    }

    /// Seven weights by factors of [`WEIGHT_STEP`], the middle one of which lowers R by about [`MIDDLE_GAIN`]: from the gain of a
    /// weight so small that it grows with it.
    fn weights_of_waves(
        &self,
        term: &WaveTerm,
        plain: &Derived,
        moves: &dyn Fn(&Hull) -> Vec<f64>,
        solved: &dyn Fn(f64) -> Result<(Derived, WaveTrade), Failed>,
    ) -> Vec<f64> {
        let unit = 0.5 * self.reference.breadth;
        let without = term.after(&moves(&plain.hull));
        let mut weight = 1e-4 * unit * unit;
        for _ in 0..8 {
            let Ok((_, trade)) = solved(weight) else { break };
            let gain = without - trade.ratio;
            if !gain.is_finite() {
                break;
            } else if gain > 0.2 * MIDDLE_GAIN {
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
