//! Why the nearest hull has not what is asked for, with what is within reach.

use super::derive::{Job, Wanted};
use super::inflections::is_about_as_fair;
use super::limits::Interval;
use super::nearest::{Failed, Search};
use super::parallel::with_ends;
use super::quantity::{Quantity, Reference, value_of};
use super::refusal::Refusal;
use super::request::{Origin, Target};
use crate::hull::Hull;

/// Most targets that a message lists.
const MOST_LISTED: usize = 8;
/// Parts of the way from the end of an interval to the parent at which a daughter is looked for.
const MARGINS: [f64; 2] = [0.02, 0.2];
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
        let (mut refused, mut held) = (Vec::new(), Vec::new());
        for target in given {
            let others: Vec<Target> =
                self.targets.iter().copied().filter(|other| other.quantity != target.quantity).collect();
            match self.limits(start, target.quantity, &others) {
                Some(found) if !found.holds(target.value) => refused.push(self.out_of_reach(target, &found, &others)),
                Some(found) => held.push((*target, found, others)),
                None => {}
            }
        }
        if refused.is_empty() {
            refused.push(self.body.map_or_else(|| self.together(failed, &held), |ends| self.too_long(ends)));
        }
        refused
    }

    /// A value of a target near `end` with which a daughter was found, on the way to the middle of its interval, and whether she is
    /// about as fair as her parent.
    fn within_reach(&self, target: &Target, end: f64, found: &Interval, others: &[Target]) -> Option<(f64, bool)> {
        let middle = 0.5 * (found.low + found.high);
        let parent = found.nearest(value_of(target.quantity, self.scaled, &self.reference));
        let far = if (parent - end).abs() > 1e-3 * (found.high - found.low) { parent } else { middle };
        let mut first = None;
        for part in MARGINS {
            let value = self.rounded(target.quantity, end + part * (far - end), found);
            let mut targets = others.to_vec();
            targets.push(Target { value, ..*target });
            let job = Job { targets: &targets, ..*self };
            let wanted = Wanted { first: true, without_signs: !found.keeps_signs };
            let Ok((derived, ..)) = job.best(&wanted) else { continue };
            let [before, after] = derived.inflections;
            if is_about_as_fair(before, after) {
                return Some((value, true));
            }
            first = first.or(Some((value, false)));
        }
        first
    }

    /// The nearest value of a target with which a daughter was found, in words.
    fn nearest_words(&self, target: &Target, end: f64, found: &Interval, others: &[Target]) -> String {
        match self.within_reach(target, end, found, others) {
            Some((value, true)) => {
                format!("Give {}, which is met, or free a target that is kept", self.shown(target.quantity, value))
            }
            Some((value, false)) => format!(
                "Give {}, which is met, maybe with more than one and a half times the inflections, or free a target that is kept",
                self.shown(target.quantity, value)
            ),
            None => {
                "Free a target that is kept (--free cm, --free lcb), or give a value nearer to the parent".to_owned()
            }
        }
    }

    /// Targets that are infeasible together, while none of them is alone.
    fn together(&self, failed: &Failed, held: &[(Target, Interval, Vec<Target>)]) -> Refusal {
        let given = self.targets.iter().filter(|target| target.origin == Origin::Given);
        let words: Vec<&str> = given.map(|target| target.quantity.word()).collect();
        let left =
            if let Failed::Astray(left) = failed { format!(" (the last step left {left:.1e})") } else { String::new() };
        let message = format!("no hull near the parent has {} together{left}", self.list(self.targets));
        let span = |(target, found, _): &(Target, Interval, Vec<Target>)| {
            let [low, high] = self.inwards(target.quantity, found);
            format!("{} to {}", self.shown(target.quantity, low), self.number(target.quantity, high))
        };
        let alone: Vec<String> = held.iter().map(span).collect();
        let alone =
            if alone.is_empty() { String::new() } else { format!("; each with the others: {}", alone.join(", ")) };
        let remedy = match held {
            [(target, found, others)] => self.nearest_words(target, target.value, found, others),
            _ => "Free a target that is kept (--free cm, --free lcb), or give targets nearer to the parent".to_owned(),
        };
        Refusal::new("E420", words, message + &alone, remedy)
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
        let with = if others.is_empty() { String::new() } else { format!(" with {}", self.list(others)) };
        let [low, high] = self.inwards(target.quantity, found).map(|end| self.number(target.quantity, end));
        let signs = if found.keeps_signs { "" } else { ", without the signs of curvature of the parent" };
        let wanted = self.shown(target.quantity, target.value);
        let message = format!("{wanted} is out of reach: {low} to {high}{with}{signs}");
        let remedy = self.nearest_words(target, found.nearest(target.value), found, others);
        Refusal::new("E420", vec![target.quantity.word()], message, remedy)
    }

    /// The interval in the digits that are shown, rounded inwards, so that its ends are feasible; rising as it is shown.
    fn inwards(&self, quantity: Quantity, found: &Interval) -> [f64; 2] {
        let scale = self.scale(quantity);
        let mut ends = [found.low, found.high];
        ends.sort_by(|a, b| scale.steps(*a).total_cmp(&scale.steps(*b)));
        let [low, high] = [scale.steps(ends[0]).ceil(), scale.steps(ends[1]).floor()];
        if low <= high { [low, high].map(|steps| scale.value(steps)) } else { ends }
    }

    /// A value in the digits that are shown, within an interval where one is.
    fn rounded(&self, quantity: Quantity, value: f64, found: &Interval) -> f64 {
        let scale = self.scale(quantity);
        let [a, b] = self.inwards(quantity, found);
        scale.value(scale.steps(value).round()).clamp(a.min(b), a.max(b))
    }

    /// How a value is stated: volumes as C_B, LCB and LCF in per cent, C_M as the bilge radius where that is given.
    fn scale(&self, quantity: Quantity) -> Scale {
        let of = |name, factor, offset, decimals, unit| Scale {
            name,
            measure: Measure::Linear { factor, offset },
            decimals,
            unit,
        };
        let percent = |name| of(name, 100.0 / self.reference.between, -50.0, 3, " % of Lpp");
        match quantity {
            Quantity::Volume => of("C_B", 1.0 / self.reference.volume(), 0.0, 4, ""),
            Quantity::Lcb => percent("LCB"),
            Quantity::Lcf => percent("LCF"),
            Quantity::MidshipCoefficient if self.request.bilge_radius.is_some() => {
                Scale { name: "bilge radius", measure: Measure::Radius(self.reference), decimals: 3, unit: " m" }
            }
            Quantity::MidshipCoefficient => of("C_M", 1.0, 0.0, 4, ""),
            Quantity::PrismaticCoefficient => of("C_P", 1.0, 0.0, 4, ""),
            Quantity::WaterplaneCoefficient => of("C_WP", 1.0, 0.0, 4, ""),
            Quantity::Kb => of("KB", 1.0, 0.0, 3, " m"),
            Quantity::Km => of("KM", 1.0, 0.0, 3, " m"),
            Quantity::WettedSurface => of("S", 1.0, 0.0, 2, " m2"),
            Quantity::HalfAngleOfEntrance => of("i_E", 1.0, 0.0, 3, " deg"),
            Quantity::HalfAngleOfRun => of("i_R", 1.0, 0.0, 3, " deg"),
            Quantity::SectionArea { .. } => of("A", 1.0, 0.0, 3, " m2"),
        }
    }

    fn number(&self, quantity: Quantity, value: f64) -> String {
        let scale = self.scale(quantity);
        let (value, decimals, unit) = (scale.stated(value), usize::from(scale.decimals), scale.unit);
        let has_sign = matches!(scale.measure, Measure::Linear { offset, .. } if offset < 0.0);
        if has_sign { format!("{value:+.decimals$}{unit}") } else { format!("{value:.decimals$}{unit}") }
    }

    /// A value with its name and unit.
    pub(super) fn shown(&self, quantity: Quantity, value: f64) -> String {
        let at = if let Quantity::SectionArea { x } = quantity { format!("@{x:.3}") } else { String::new() };
        format!("{}{at} {}", self.scale(quantity).name, self.number(quantity, value))
    }
}

/// How values of a quantity are stated, with decimals and unit.
#[derive(Debug, Clone, Copy)]
struct Scale {
    name: &'static str,
    measure: Measure,
    decimals: u8,
    unit: &'static str,
}

/// What is stated in the place of a value.
#[derive(Debug, Clone, Copy)]
enum Measure {
    /// factor times value and offset
    Linear { factor: f64, offset: f64 },
    /// The bilge radius of C_M, as far as it fits into the section.
    Radius(Reference),
}

impl Scale {
    fn stated(&self, value: f64) -> f64 {
        match &self.measure {
            Measure::Linear { factor, offset } => factor * value + offset,
            Measure::Radius(reference) => reference.bilge_radius(value).min(reference.largest_bilge()),
        }
    }

    /// A value in units of the last decimal.
    fn steps(&self, value: f64) -> f64 {
        self.stated(value) * 10f64.powi(i32::from(self.decimals))
    }

    fn value(&self, steps: f64) -> f64 {
        let stated = steps / 10f64.powi(i32::from(self.decimals));
        match &self.measure {
            Measure::Linear { factor, offset } => (stated - offset) / factor,
            Measure::Radius(reference) => reference.midship_coefficient(stated),
        }
    }
}
