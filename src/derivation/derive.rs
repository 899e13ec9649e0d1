//! From a parent and a request to a daughter.

use super::affine::scaled;
use super::inflections::{counted_planes, inflections};
use super::lackenby::{HalfBody, changes_of_halves, halves};
use super::limits::{Interval, interval};
use super::nearest::{Failed, Freedom, Search, breadths};
use super::quantity::{Quantity, Reference, value_of};
use super::refusal::Refusal;
use super::request::{Method, Origin, Request, Target};
use super::shift::{Ends, Family, LEVEL_FOLD, Settled, level, shifted};
use super::waves::{WaveRequest, WaveResult, WaveTerm, WaveTrade, knee, resistances};
use crate::hull::Hull;
use crate::hydrostatics::{Conventions, CurvesOfForm};
use crate::numeric::join;

/// Part of the amplitude at which a shift folds that the start of the nearest hull takes at most.
const OF_FOLD: f64 = 0.8;
/// Parts of the way to the targets that the shift takes, in the order in which they are tried.
const PARTS: [f64; 3] = [0.5, 1.0, 0.0];
/// R that the middle one of seven weights of the wave resistance gains, about.
const MIDDLE_GAIN: f64 = 0.1;
/// Factor from one weight of the wave resistance to the next.
const WEIGHT_STEP: f64 = 4.0;
/// Relative error that a daughter may have.
const EXACT: f64 = 1e-10;

/// A target with what the daughter has.
#[derive(Debug, Clone, PartialEq)]
pub struct Reached {
    /// The target.
    pub target: Target,
    /// The value of the scaled parent.
    pub before: f64,
    /// The value of the daughter.
    pub achieved: f64,
    /// Bending energy of the change per relative change of the target \[m^2\]; none of methods without a program.
    pub price: Option<f64>,
    /// What it can be with the others as they are, where that was asked for.
    pub interval: Option<Interval>,
}

/// A daughter.
#[derive(Debug, Clone)]
pub struct Derived {
    /// The parent at the dimensions of the daughter.
    pub scaled: Hull,
    /// The daughter.
    pub hull: Hull,
    /// What its coefficients refer to.
    pub reference: Reference,
    /// The targets.
    pub targets: Vec<Reached>,
    /// Amplitudes of the shift of the aft and the fore body, in parts of their lengths, and those at which it folds.
    pub shift: Option<[[f64; 2]; 3]>,
    /// C_B that the shift alone reaches before it folds.
    pub shift_reach: Option<[f64; 2]>,
    /// Bending energy of the change of half-breadths \[m^2\].
    pub energy: f64,
    /// Relative duality gap of the last program.
    pub gap: f64,
    /// Limits that bound the answer: centreplane, breadth, order of sections, signs.
    pub binding: usize,
    /// Programs that were solved.
    pub programs: usize,
    /// Whether the signs of curvature of the parent are kept.
    pub keeps_signs: bool,
    /// Inflections of stations and waterlines, of the scaled parent and of the daughter.
    pub inflections: [usize; 2],
    /// The wave resistance, where it is made small.
    #[doc(hidden)]
    pub waves: Option<WaveResult>,
}

/// Derives a daughter; `intervals` says whether what each target can be is computed as well.
///
/// # Errors
/// Every refusal: a value that no ship has (E421), a target that the method does not take (E422), targets that no daughter
/// meets (E420), each with numbers.
pub fn derive(
    parent: &Hull,
    request: &Request,
    conventions: &Conventions,
    intervals: bool,
) -> Result<Derived, Vec<Refusal>> {
    if parent.particulars().draught.is_none() {
        return Err(vec![Refusal::no_draught()]);
    }
    let scaled = scaled(parent, &request.dimensions).map_err(|refusal| vec![refusal])?;
    let Some(reference) = Reference::of(&scaled, conventions) else { return Err(vec![Refusal::no_draught()]) };
    let targets = request.targets(&scaled, &reference)?;
    let job = Job { scaled: &scaled, request, reference, targets: &targets, conventions };
    let mut derived = match request.method {
        Method::Affine => Ok(job.affine()),
        Method::OneMinusPrismatic | Method::Lackenby => job.classical(),
        Method::Nearest => job.nearest().and_then(|(derived, start, amplitudes)| match &request.waves {
            Some(waves) => job.with_waves(waves, derived, &start, amplitudes),
            None => Ok(derived),
        }),
    }?;
    if request.method != Method::Nearest {
        let planes = counted_planes(&scaled, conventions.stations);
        let (before, after) = join(|| inflections(&scaled, &planes), || inflections(&derived.hull, &planes));
        derived.inflections = [before, after];
    }
    if intervals && request.method == Method::Nearest {
        for k in 0..derived.targets.len() {
            let quantity = targets[k].quantity;
            let others: Vec<Target> = targets.iter().copied().filter(|other| other.quantity != quantity).collect();
            derived.targets[k].interval = interval(&scaled, &derived.hull, &reference, quantity, &others);
        }
    }
    Ok(derived)
}

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

/// A daughter with the shifted parent that it is nearest to, and the amplitudes of the shift.
type Started = (Derived, Hull, [f64; 2]);

/// What a daughter is made of.
struct Job<'a> {
    scaled: &'a Hull,
    request: &'a Request,
    reference: Reference,
    targets: &'a [Target],
    conventions: &'a Conventions,
}

impl Job<'_> {
    fn midship(&self) -> f64 {
        0.5 * self.reference.between
    }

    fn reached(&self, hull: &Hull, prices: Option<&[f64]>) -> Vec<Reached> {
        let of = |(k, target): (usize, &Target)| Reached {
            target: *target,
            before: value_of(target.quantity, self.scaled, &self.reference),
            achieved: value_of(target.quantity, hull, &self.reference),
            price: prices.map(|prices| prices[k]),
            interval: None,
        };
        self.targets.iter().enumerate().map(of).collect()
    }

    fn plain(&self, hull: Hull) -> Derived {
        Derived {
            scaled: self.scaled.clone(),
            targets: self.reached(&hull, None),
            hull,
            reference: self.reference,
            shift: None,
            shift_reach: None,
            energy: 0.0,
            gap: 0.0,
            binding: 0,
            programs: 0,
            keeps_signs: false,
            inflections: [0, 0],
            waves: None,
        }
    }

    fn affine(&self) -> Derived {
        self.plain(self.scaled.clone())
    }

    /// The targets that a shift meets: the volume or C_P, and LCB.
    fn of_shift(&self) -> Vec<Target> {
        let volume = self.targets.iter().find(|target| target.quantity == Quantity::Volume);
        let first = volume.or_else(|| self.targets.iter().find(|t| t.quantity == Quantity::PrismaticCoefficient));
        let centre = self.targets.iter().find(|target| target.quantity == Quantity::Lcb);
        first.into_iter().chain(centre).copied().collect()
    }

    /// What C_B a shift reaches with both amplitudes at these limits.
    fn reach(
        &self,
        ends: &Ends,
        shift: &(dyn Fn(usize, f64, f64) -> f64 + Sync),
        limits: [[f64; 2]; 2],
    ) -> Option<[f64; 2]> {
        let at = |which: usize| {
            let shift = |side: usize, t: f64| shift(side, t, limits[side][which]);
            let hull = shifted(self.scaled, ends, &shift).ok()?;
            Some(value_of(Quantity::Volume, &hull, &self.reference) / self.reference.volume())
        };
        Some([at(0)?, at(1)?])
    }

    /// The hull nearest to starts with different parts of the shift: the first one without more inflections than the scaled
    /// parent, or the one with the fewest.
    fn nearest(&self) -> Result<Started, Vec<Refusal>> {
        let planes = counted_planes(self.scaled, self.conventions.stations);
        let before = inflections(self.scaled, &planes);
        let mut best: Option<((usize, bool), Started)> = None;
        let mut failure = None;
        for part in PARTS {
            let (start, amplitudes) = self.started(part);
            let search = Search::new(self.scaled, &start, &self.reference, self.targets);
            match self.nearest_to(search, amplitudes) {
                Ok(derived) => {
                    let after = inflections(&derived.hull, &planes);
                    let rank = (after.max(before), !derived.keeps_signs);
                    let derived = Derived { inflections: [before, after], ..derived };
                    if best.as_ref().is_none_or(|(other, _)| rank < *other) {
                        best = Some((rank, (derived, start.clone(), amplitudes)));
                    }
                    // Without a shift all parts are one.
                    if rank == (before, false) || amplitudes.iter().all(|a| a.abs() < 1e-12) {
                        break;
                    }
                }
                Err(failed) => failure = failure.or(Some((start, failed))),
            }
        }
        match (best, failure) {
            (Some((_, found)), _) => Ok(found),
            (None, Some((start, failed))) => Err(self.infeasible(&start, &failed)),
            (None, None) => Err(Vec::new()),
        }
    }

    /// The scaled parent with a level shift that brings volume and LCB so far towards their targets, and its amplitudes.
    fn started(&self, part: f64) -> (Hull, [f64; 2]) {
        let towards = |target: &Target| {
            let before = value_of(target.quantity, self.scaled, &self.reference);
            Target { value: before + part * (target.value - before), ..*target }
        };
        let targets: Vec<Target> = self.of_shift().iter().map(towards).collect();
        let most = OF_FOLD * LEVEL_FOLD;
        let family = Family {
            hull: self.scaled,
            ends: Ends::inside(self.scaled, self.midship()),
            reference: &self.reference,
            targets: &targets,
            shift: &|_, t, amplitude| level(t, amplitude),
            limits: [[-most, most]; 2],
        };
        let settled = family.settle([0.0; 2]).filter(|_| part > 0.0);
        settled.map_or((self.scaled.clone(), [0.0; 2]), |settled| (settled.hull, settled.amplitudes))
    }

    /// The daughter of least bending and wave resistance: for the weight that is given, or for seven of which the knee is taken.
    fn with_waves(
        &self,
        request: &WaveRequest,
        plain: Derived,
        start: &Hull,
        amplitudes: [f64; 2],
    ) -> Result<Derived, Vec<Refusal>> {
        let draught = self.reference.draught;
        let before = resistances(self.scaled, request, draught).map_err(|refusal| vec![refusal])?;
        let free = Freedom::of(start).points;
        let term = WaveTerm::new(start, &free, request, draught, &before).map_err(|refusal| vec![refusal])?;
        let planes = counted_planes(self.scaled, self.conventions.stations);
        let base = breadths(start);
        let moves = |hull: &Hull| -> Vec<f64> {
            let after = breadths(hull);
            free.iter().map(|&k| after[k] - base[k]).collect()
        };
        let solved = |weight: f64| {
            let mut search = Search::new(self.scaled, start, &self.reference, self.targets);
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

    /// The hull nearest to a start, with the signs of curvature of the parent where they are feasible.
    fn nearest_to(&self, mut search: Search<'_>, amplitudes: [f64; 2]) -> Result<Derived, Failed> {
        let mut keeps_signs = true;
        let mut found = search.run();
        if found.is_err() {
            keeps_signs = false;
            search.without_signs();
            found = search.run();
        }
        let nearest = found?;
        let ends = Ends::inside(self.scaled, self.midship());
        let at_fold = [[-0.999 * LEVEL_FOLD, 0.999 * LEVEL_FOLD]; 2];
        Ok(Derived {
            targets: self.reached(&nearest.hull, Some(&nearest.prices)),
            shift: Some([amplitudes, [-LEVEL_FOLD; 2], [LEVEL_FOLD; 2]]),
            shift_reach: self.reach(&ends, &|_, t, amplitude| level(t, amplitude), at_fold),
            energy: nearest.energy,
            gap: nearest.gap,
            binding: nearest.binding,
            programs: nearest.programs,
            keeps_signs,
            ..self.plain(nearest.hull)
        })
    }

    /// The refusal of targets that no half-breadths on the chart of `start` meet together.
    fn infeasible(&self, start: &Hull, failed: &Failed) -> Vec<Refusal> {
        match failed {
            Failed::Hull(error) => return vec![Refusal::hull(error)],
            Failed::Program(error) => return vec![Refusal::hull(error)],
            Failed::Infeasible | Failed::Astray(_) => {}
        }
        let given = || self.targets.iter().filter(|target| target.origin == Origin::Given);
        let mut refused = Vec::new();
        for target in given() {
            let others: Vec<Target> =
                self.targets.iter().copied().filter(|other| other.quantity != target.quantity).collect();
            let found = interval(self.scaled, start, &self.reference, target.quantity, &others);
            if let Some(found) = found.filter(|found| !found.holds(target.value)) {
                refused.push(self.out_of_reach(target, &found, &others));
            }
        }
        if refused.is_empty() {
            let words: Vec<&str> = given().map(|target| target.quantity.word()).collect();
            let shown: Vec<String> =
                self.targets.iter().map(|target| self.shown(target.quantity, target.value)).collect();
            let left = if let Failed::Astray(left) = failed {
                format!(" (the last step left {left:.1e})")
            } else {
                String::new()
            };
            let message = format!("no hull near the parent has {} together{left}", shown.join(", "));
            let remedy = "Free a target that is kept (--free cm, --free lcb), or give targets nearer to the parent";
            refused.push(Refusal::new("E420", words, message, remedy.to_owned()));
        }
        refused
    }

    fn out_of_reach(&self, target: &Target, found: &Interval, others: &[Target]) -> Refusal {
        let shown = |value: f64| self.shown(target.quantity, value);
        let number = |value: f64| shown(value).split_once(' ').map_or(String::new(), |(_, number)| number.to_owned());
        let with: Vec<String> = others.iter().map(|other| self.shown(other.quantity, other.value)).collect();
        let with = if with.is_empty() { String::new() } else { format!(" with {}", with.join(", ")) };
        let message =
            format!("{} is out of reach: {} to {}{with}", shown(target.value), number(found.low), number(found.high));
        let remedy = format!("The nearest is {}; or free a target that is kept", shown(found.nearest(target.value)));
        Refusal::new("E420", vec![target.quantity.word()], message, remedy)
    }

    /// A value as it is stated: volumes as C_B, LCB and LCF in per cent.
    fn shown(&self, quantity: Quantity, value: f64) -> String {
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
        }
    }

    /// Lackenby, or one minus prismatic.
    fn classical(&self) -> Result<Derived, Vec<Refusal>> {
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
