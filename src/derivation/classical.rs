//! The daughters of the classical shifts: Lackenby (1950) and one minus prismatic, iterated until targets are exact.

use super::derive::{Derived, Job};
use super::lackenby::{HalfBody, changes_of_halves, halves};
use super::quantity::{Quantity, value_of};
use super::refusal::Refusal;
use super::request::{Method, Target};
use super::shift::{Ends, Family, Settled};
use crate::hydrostatics::CurvesOfForm;

/// Relative error that a daughter may have.
const EXACT: f64 = 1e-10;

impl Job<'_> {
    /// Lackenby, or one minus prismatic.
    pub(super) fn classical(&self) -> Result<Derived, Vec<Refusal>> {
        let t = self.reference.draught;
        let row = CurvesOfForm::new(self.scaled, &[t], self.conventions).rows;
        let parallel = row.first().and_then(|row| row.parallel_body_aft.zip(row.parallel_body_fore));
        let midship = self.midship();
        let parallel = parallel.map(|(a, b)| [a.min(midship), b.max(midship)]);
        let Some(bodies) = halves(self.scaled, t, midship, parallel) else {
            let message = "midship is not between the ends of the waterline".to_owned();
            return Err(vec![Refusal::new("E420", vec!["method"], message, "Take --method nearest".to_owned())]);
        };
        let grown = self.grown(&bodies)?;
        let lackenby = self.request.method == Method::Lackenby;
        let limit = |side: usize| {
            let found = if lackenby {
                bodies[side].lackenby_limit(grown[side])
            } else {
                bodies[side].one_minus_prismatic_limit()
            };
            [0.9999 * found.low, 0.9999 * found.high]
        };
        let limits = [limit(0), limit(1)];
        let shift = |side: usize, x: f64, change: f64| {
            if lackenby {
                bodies[side].lackenby(x, change, grown[side])
            } else {
                bodies[side].one_minus_prismatic(x, change)
            }
        };
        let targets = self.of_shift();
        let ends = Ends::upright(midship, [bodies[0].length, bodies[1].length]);
        let family =
            Family { hull: self.scaled, ends, reference: &self.reference, targets: &targets, shift: &shift, limits };
        let start = self.first_pass(&bodies, &targets, grown);
        let settled = family.settle(if lackenby { start } else { [0.5 * (start[0] + start[1]); 2] });
        let reach = self.reach(&ends, &shift, limits);
        let folds = |settled: Option<&Settled>| self.folds(settled, limits, reach, &targets);
        let settled = match settled {
            Some(settled) if settled.error <= EXACT => settled,
            other => return Err(vec![folds(other.as_ref())]),
        };
        let [low, high] = [0, 1].map(|k| [limits[0][k], limits[1][k]]);
        Ok(Derived { shift: Some([settled.amplitudes, low, high]), shift_reach: reach, ..self.plain(settled.hull) })
    }

    /// Changes of the parallel parts that are asked for, in half lengths.
    fn grown(&self, bodies: &[HalfBody; 2]) -> Result<[f64; 2], Vec<Refusal>> {
        let Some([aft, fore]) = self.request.parallel_body else { return Ok([0.0; 2]) };
        let midship = self.midship();
        let wanted = [(midship - aft) / bodies[0].length, (fore - midship) / bodies[1].length];
        if wanted.iter().any(|part| !(0.0..0.95).contains(part)) {
            let [low, high] = [midship - 0.95 * bodies[0].length, midship + 0.95 * bodies[1].length];
            let message = format!(
                "the parallel body from {aft:.3} to {fore:.3} m does not hold midship at {midship:.3} m, or leaves no ends"
            );
            let remedy = format!("Give an aft end from {low:.3} m on and a fore end up to {high:.3} m");
            return Err(vec![Refusal::new("E421", vec!["parallel-body"], message, remedy)]);
        }
        Ok([wanted[0] - bodies[0].parallel, wanted[1] - bodies[1].parallel])
    }

    /// Changes of the halves by Lackenby's formula, which are exact for areas.
    fn first_pass(&self, bodies: &[HalfBody; 2], targets: &[Target], grown: [f64; 2]) -> [f64; 2] {
        let wanted = |quantity: Quantity| targets.iter().find(|target| target.quantity == quantity);
        let phi = 0.5 * (bodies[0].prismatic + bodies[1].prismatic);
        let ratio = |quantity: Quantity| {
            wanted(quantity).map(|target| target.value / value_of(quantity, self.scaled, &self.reference))
        };
        let change = ratio(Quantity::Volume).or_else(|| ratio(Quantity::PrismaticCoefficient)).unwrap_or(1.0);
        let moved = wanted(Quantity::Lcb).map_or(0.0, |target| {
            let half = 0.5 * (bodies[0].length + bodies[1].length);
            (target.value - value_of(Quantity::Lcb, self.scaled, &self.reference)) / half
        });
        changes_of_halves(bodies, phi * (change - 1.0), moved, grown)
    }

    fn folds(
        &self,
        settled: Option<&Settled>,
        limits: [[f64; 2]; 2],
        reach: Option<[f64; 2]>,
        targets: &[Target],
    ) -> Refusal {
        let words: Vec<&'static str> = targets.iter().map(|target| target.quantity.word()).collect();
        let wanted: Vec<String> = targets.iter().map(|target| self.shown(target.quantity, target.value)).collect();
        let reach = reach.map_or(String::new(), |[low, high]| format!("; C_B from {low:.4} to {high:.4} with both"));
        let got = settled.map_or(String::new(), |settled| {
            let has: Vec<String> = targets
                .iter()
                .map(|target| self.shown(target.quantity, value_of(target.quantity, &settled.hull, &self.reference)))
                .collect();
            format!(" The nearest is {}.", has.join(", "))
        });
        let [[al, ah], [fl, fh]] = limits;
        let message = format!(
            "sections pass each other before {} are reached: phi of the run can change by {al:+.4} to {ah:+.4}, of the entrance by {fl:+.4} to {fh:+.4}{reach}.{got}",
            wanted.join(" and ")
        );
        Refusal::new("E420", words, message, "Take --method nearest, or targets within reach".to_owned())
    }
}
