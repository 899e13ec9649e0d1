//! The wave resistance against bending: one program for each weight, and the knee of seven.

use std::cell::RefCell;

use super::derive::{Derived, Job};
use super::inflections::inflections;
use super::nearest::{Failed, breadths};
use super::refusal::Refusal;
use crate::hull::Hull;
use crate::resistance::{NoWaveTerm, WaveRequest, WaveResult, WaveTerm, WaveTrade, knee};

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

/// That R_W is no term of the program.
fn no_term(why: &NoWaveTerm) -> Refusal {
    let remedy = match why {
        NoWaveTerm::Hull(error) => return Refusal::hull(error),
        NoWaveTerm::NotLevel(_) => "Derive from a hull with a level keel and level waterlines, as of generate",
        NoWaveTerm::TooMany(..) => "Derive from a hull with a coarser net",
    };
    Refusal::new("E425", vec!["wave-resistance"], why.to_string(), remedy.to_owned())
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
        let resistances = |hull: &Hull| request.resistances(hull, draught).map_err(|error| vec![Refusal::hull(&error)]);
        let before = resistances(self.scaled)?;
        let mut search = self.search(start);
        let free = search.freedom.points.clone();
        let term = WaveTerm::new(start, &free, request, draught, &before).map_err(|why| vec![no_term(&why)])?;
        let planes = &self.counted.planes;
        let base = breadths(start);
        let moves = |hull: &Hull| -> Vec<f64> {
            let after = breadths(hull);
            free.iter().map(|&k| after[k] - base[k]).collect()
        };
        request.within.into_iter().for_each(|most| search.within(most));
        // Rows that one weight needs are those of the next as well.
        let kept = RefCell::new(search);
        let solved = |weight: f64| {
            let mut search = kept.borrow().clone();
            search.programs = 0;
            search.with_waves(&term, weight);
            let derived = self.nearest_to(&mut search, amplitudes)?;
            if derived.keeps_signs && derived.keeps_body {
                kept.replace(search);
            }
            let change = moves(&derived.hull);
            let square = change.iter().map(|c| c * c).sum::<f64>() / change.len().max(1) as f64;
            let trade = WaveTrade {
                weight,
                ratio: term.after(&change),
                energy: derived.energy,
                moves: square.sqrt(),
                inflections: inflections(&derived.hull, planes),
                keeps_signs: derived.keeps_signs,
            };
            Ok::<_, Failed>((derived, trade))
        };
        let ratio = |weight: f64| Some(solved(weight).ok()?.1.ratio);
        let weights = request.weights(term.after(&moves(&plain.hull)), 0.5 * self.reference.breadth, ratio);
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
        let after = resistances(&derived.hull)?;
        let froude_numbers = request.froude_numbers.clone();
        let waves = WaveResult { froude_numbers, before, after, trades, taken };
        Ok(Derived { inflections: [plain.inflections[0], trade.inflections], waves: Some(waves), ..derived })
    }
}
