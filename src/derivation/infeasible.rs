//! Why the nearest hull has not what is asked for, with what is within reach.

use super::derive::Job;
use super::limits::{Interval, interval};
use super::nearest::{Failed, Search};
use super::parallel::with_ends;
use super::quantity::Quantity;
use super::refusal::Refusal;
use super::request::{Origin, Target};
use crate::hull::Hull;

/// Most targets that a message lists.
const MOST_LISTED: usize = 8;
/// Halvings of the length of a parallel body that is too long.
const HALVINGS: usize = 6;

impl Job<'_> {
    /// The refusal of targets that no half-breadths on the chart of `start` meet together.
    pub(super) fn infeasible(&self, start: &Hull, failed: &Failed) -> Vec<Refusal> {
        match failed {
            Failed::Hull(error) => return vec![Refusal::hull(error)],
            Failed::Program(error) => return vec![Refusal::hull(error)],
            Failed::Infeasible | Failed::Astray(_) => {}
        }
        let given = self.targets.iter().filter(|target| target.origin == Origin::Given);
        let mut refused = Vec::new();
        for target in given {
            let others: Vec<Target> =
                self.targets.iter().copied().filter(|other| other.quantity != target.quantity).collect();
            let found = interval(self.scaled, start, &self.reference, target.quantity, &others, self.body);
            if let Some(found) = found.filter(|found| !found.holds(target.value)) {
                refused.push(self.out_of_reach(target, &found, &others));
            }
        }
        if refused.is_empty() {
            refused.push(self.body.map_or_else(|| self.together(failed), |ends| self.too_long(ends)));
        }
        refused
    }

    /// Targets that are infeasible together, while none of them is alone.
    fn together(&self, failed: &Failed) -> Refusal {
        let given = self.targets.iter().filter(|target| target.origin == Origin::Given);
        let words: Vec<&str> = given.map(|target| target.quantity.word()).collect();
        let left =
            if let Failed::Astray(left) = failed { format!(" (the last step left {left:.1e})") } else { String::new() };
        let message = format!("no hull near the parent has {} together{left}", self.list(self.targets));
        let remedy = "Free a target that is kept (--free cm, --free lcb), or give targets nearer to the parent";
        Refusal::new("E420", words, message, remedy.to_owned())
    }

    /// A parallel body that the targets leave no ends for, with the longest about the same middle.
    fn too_long(&self, [aft, fore]: [f64; 2]) -> Refusal {
        let ends = |part: f64| {
            let (middle, half) = (0.5 * (aft + fore), 0.5 * part * (fore - aft));
            [middle - half, middle + half]
        };
        let is_feasible = |part: f64| {
            let scaled = with_ends(self.scaled, self.reference.draught, ends(part)).ok();
            scaled.is_some_and(|scaled| {
                let mut search = Search::new(&scaled, &scaled, &self.reference, self.targets, Some(ends(part)));
                let with_signs = search.run().is_ok();
                with_signs || {
                    search.without_signs();
                    search.run().is_ok()
                }
            })
        };
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            if is_feasible(middle) {
                low = middle;
            } else {
                high = middle;
            }
        }
        let message =
            format!("a parallel body from {aft:.3} to {fore:.3} m leaves no ends with {}", self.list(self.targets));
        let [aft, fore] = ends(low);
        let remedy = if low > 0.0 {
            format!("The longest about its middle is {aft:.3} to {fore:.3} m; or free a target that is kept")
        } else {
            "Free a target that is kept (--free cm, --free lcb), or place the body elsewhere".to_owned()
        };
        Refusal::new("E420", vec!["parallel-body"], message, remedy)
    }

    fn list(&self, targets: &[Target]) -> String {
        let of = |target: &Target| self.shown(target.quantity, target.value);
        let rest = targets.len().saturating_sub(MOST_LISTED);
        let rest = if rest > 0 { format!(" and {rest} others") } else { String::new() };
        format!("{}{rest}", targets.iter().take(MOST_LISTED).map(of).collect::<Vec<_>>().join(", "))
    }

    fn out_of_reach(&self, target: &Target, found: &Interval, others: &[Target]) -> Refusal {
        let shown = |value: f64| self.shown(target.quantity, value);
        let number = |value: f64| shown(value).split_once(' ').map_or(String::new(), |(_, number)| number.to_owned());
        let with = if others.is_empty() { String::new() } else { format!(" with {}", self.list(others)) };
        let message =
            format!("{} is out of reach: {} to {}{with}", shown(target.value), number(found.low), number(found.high));
        let remedy = format!("The nearest is {}; or free a target that is kept", shown(found.nearest(target.value)));
        Refusal::new("E420", vec![target.quantity.word()], message, remedy)
    }

    /// A value as it is stated: volumes as C_B, LCB and LCF in per cent.
    pub(super) fn shown(&self, quantity: Quantity, value: f64) -> String {
        let percent = |x: f64| 100.0 * (x / self.reference.between - 0.5);
        match quantity {
            Quantity::Volume => format!("C_B {:.4}", value / self.reference.volume()),
            Quantity::Lcb => format!("LCB {:+.3} % of Lpp", percent(value)),
            Quantity::Lcf => format!("LCF {:+.3} % of Lpp", percent(value)),
            Quantity::MidshipCoefficient => format!("C_M {value:.4}"),
            Quantity::PrismaticCoefficient => format!("C_P {value:.4}"),
            Quantity::WaterplaneCoefficient => format!("C_WP {value:.4}"),
            Quantity::Kb => format!("KB {value:.3} m"),
            Quantity::Km => format!("KM {value:.3} m"),
            Quantity::WettedSurface => format!("S {value:.2} m2"),
            Quantity::HalfAngleOfEntrance => format!("i_E {value:.3} deg"),
            Quantity::HalfAngleOfRun => format!("i_R {value:.3} deg"),
            Quantity::SectionArea { x } => format!("A@{x:.3} {value:.3} m2"),
        }
    }
}
