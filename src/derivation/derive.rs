//! From a parent and a request to a daughter.

use std::sync::OnceLock;

use super::affine::scaled;
use super::inflections::{counted_planes, inflections};
use super::limits::Interval;
use super::moved::with_moves;
use super::nearest::{BindingLimits, Failed, Search};
use super::parallel;
use super::quantity::{Quantity, Reference, value_of};
use super::refusal::Refusal;
use super::request::{Laws, Method, Request, Target};
use super::shift::{Ends, Family, LEVEL_FOLD, level, shifted};
use crate::fairing::inspect::Planes;
use crate::hull::Hull;
use crate::hydrostatics::Conventions;
use crate::numeric::join;
use crate::resistance::WaveResult;

/// Part of the amplitude at which a shift folds that the start of the nearest hull takes at most.
pub(super) const OF_FOLD: f64 = 0.8;
/// Amplitudes of shifts that are closer make the same start.
const SAME_SHIFT: f64 = 1e-3;
/// Parts of the way to the targets that the shift takes, in the order in which they are tried.
const PARTS: [f64; 3] = [0.5, 1.0, 0.0];

/// A target with what the daughter has.
#[derive(Debug, Clone, PartialEq)]
pub struct Reached {
    /// The target.
    pub target: Target,
    /// The value of the scaled parent.
    pub before: f64,
    /// The value of the daughter.
    pub achieved: f64,
    /// Derivative of the optimum by the relative change of the target, of LCB and LCF by their change over L_PP \[m^2\]: below 0
    /// where more of it costs less. None of methods without a program.
    pub price: Option<f64>,
    /// What it can be with the others as they are, where that was asked for.
    pub interval: Option<Interval>,
}

/// A daughter.
#[derive(Debug, Clone)]
pub struct Derived {
    /// The parent at the dimensions of the daughter, with the lines moved that are to be elsewhere.
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
    /// Duality gap of the last program over its optimum.
    pub gap: f64,
    /// Limits that bound the answer: centreplane, breadth, order of sections, signs, tolerance.
    #[doc(hidden)]
    pub binding: Vec<BindingLimits>,
    /// Ends of the parallel body that the nearest hull has \[m\].
    #[doc(hidden)]
    pub parallel_body: Option<[f64; 2]>,
    /// Programs that were solved.
    pub programs: usize,
    /// Whether the signs of curvature of the parent are kept.
    pub keeps_signs: bool,
    /// Whether the parallel body of the parent is kept, where it has one.
    #[doc(hidden)]
    pub keeps_body: bool,
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
    let mut scaled = scaled(parent, &request.dimensions).map_err(|refusal| vec![refusal])?;
    scaled = with_moves(&scaled, &request.moved_heights, &request.moved_positions).map_err(|refusal| vec![refusal])?;
    let body = request.parallel_body.filter(|_| request.method == Method::Nearest);
    if let Some((ends, draught)) = body.zip(scaled.particulars().draught) {
        scaled = parallel::with_ends(&scaled, draught, ends).map_err(|refusal| vec![refusal])?;
    }
    let Some(reference) = Reference::of(&scaled, conventions) else { return Err(vec![Refusal::no_draught()]) };
    let Some(own) = Reference::of(parent, conventions) else { return Err(vec![Refusal::no_draught()]) };
    let targets = request.targets(&Laws { parent, own, scaled: &scaled }, &reference)?;
    let counted = Counted { planes: counted_planes(&scaled, conventions.stations), before: OnceLock::new() };
    let job = Job { scaled: &scaled, request, reference, targets: &targets, conventions, body, counted: &counted };
    let mut derived = match request.method {
        Method::Affine => Ok(job.affine()),
        Method::OneMinusPrismatic | Method::Lackenby => job.classical(),
        Method::Nearest => job.nearest().and_then(|(derived, start, amplitudes)| match &request.waves {
            Some(waves) => job.with_waves(waves, derived, &start, amplitudes),
            None => Ok(derived),
        }),
    }?;
    if request.method != Method::Nearest {
        let (before, after) = join(|| counted.before(&scaled), || inflections(&derived.hull, &counted.planes));
        derived.inflections = [before, after];
    }
    if intervals && request.method == Method::Nearest {
        for k in 0..derived.targets.len() {
            let quantity = targets[k].quantity;
            let others: Vec<Target> = targets.iter().copied().filter(|other| other.quantity != quantity).collect();
            derived.targets[k].interval = job.limits(&derived.hull, quantity, &others);
        }
    }
    Ok(derived)
}

/// What ends the search for the best of several starts.
#[derive(Debug, Default)]
pub(super) struct Wanted {
    /// The first daughter is enough.
    pub(super) first: bool,
    /// The signs of curvature are known to be infeasible.
    pub(super) without_signs: bool,
}

/// A daughter with the shifted parent that it is nearest to, and the amplitudes of the shift.
type Started = (Derived, Hull, [f64; 2]);

/// Where inflections are counted, and how many the scaled parent has.
pub(super) struct Counted {
    pub(super) planes: Planes,
    before: OnceLock<usize>,
}

impl Counted {
    fn before(&self, scaled: &Hull) -> usize {
        *self.before.get_or_init(|| inflections(scaled, &self.planes))
    }
}

/// What a daughter is made of.
pub(super) struct Job<'a> {
    pub(super) scaled: &'a Hull,
    pub(super) request: &'a Request,
    pub(super) reference: Reference,
    pub(super) targets: &'a [Target],
    pub(super) conventions: &'a Conventions,
    /// Ends of the parallel body of the nearest hull.
    pub(super) body: Option<[f64; 2]>,
    pub(super) counted: &'a Counted,
}

impl Job<'_> {
    pub(super) fn midship(&self) -> f64 {
        0.5 * self.reference.between
    }

    pub(super) fn reached(&self, hull: &Hull, prices: Option<&[f64]>) -> Vec<Reached> {
        let of = |(k, target): (usize, &Target)| Reached {
            target: *target,
            before: value_of(target.quantity, self.scaled, &self.reference),
            achieved: value_of(target.quantity, hull, &self.reference),
            price: prices.map(|prices| prices[k]),
            interval: None,
        };
        self.targets.iter().enumerate().map(of).collect()
    }

    pub(super) fn plain(&self, hull: Hull) -> Derived {
        Derived {
            scaled: self.scaled.clone(),
            targets: self.reached(&hull, None),
            hull,
            reference: self.reference,
            shift: None,
            shift_reach: None,
            energy: 0.0,
            gap: 0.0,
            binding: Vec::new(),
            parallel_body: self.body,
            programs: 0,
            keeps_signs: false,
            keeps_body: true,
            inflections: [0, 0],
            waves: None,
        }
    }

    fn affine(&self) -> Derived {
        self.plain(self.scaled.clone())
    }

    /// The targets that a shift meets: the volume or C_P, and LCB.
    pub(super) fn of_shift(&self) -> Vec<Target> {
        let volume = self.targets.iter().find(|target| target.quantity == Quantity::Volume);
        let first = volume.or_else(|| self.targets.iter().find(|t| t.quantity == Quantity::PrismaticCoefficient));
        let centre = self.targets.iter().find(|target| target.quantity == Quantity::Lcb);
        first.into_iter().chain(centre).copied().collect()
    }

    /// What C_B a shift reaches with both amplitudes at these limits.
    pub(super) fn reach(
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

    /// The program around a start.
    pub(super) fn search<'s>(&'s self, start: &'s Hull) -> Search<'s> {
        Search::new(self.scaled, start, &self.reference, self.targets, self.body)
    }

    /// The hull nearest to starts with different parts of the shift: the first one without more inflections than the scaled
    /// parent, or the one with the fewest.
    fn nearest(&self) -> Result<Started, Vec<Refusal>> {
        self.best(&Wanted::default())
            .map_err(|failure| failure.map_or(Vec::new(), |failure| self.infeasible(&failure.0, &failure.1)))
    }

    /// The same; where none is found, the first start with why it has none.
    pub(super) fn best(&self, wanted: &Wanted) -> Result<Started, Option<Box<(Hull, Failed)>>> {
        let planes = &self.counted.planes;
        let mut best: Option<((usize, bool, bool), Started)> = None;
        let mut failure = None;
        let mut tried: Vec<[f64; 2]> = Vec::new();
        for part in PARTS {
            let (start, amplitudes) = self.started(part);
            let is_same = |other: &[f64; 2]| amplitudes.iter().zip(other).all(|(a, b)| (a - b).abs() < SAME_SHIFT);
            if tried.iter().any(is_same) {
                continue;
            }
            tried.push(amplitudes);
            let mut search = self.search(&start);
            if wanted.without_signs {
                search.without_signs();
            } else if best.is_none() && failure.is_some() {
                // Where another start had nothing even without signs, these are tried last.
                let mut without = search.clone();
                without.without_signs();
                if without.run().is_err() && (!without.without_own_body() || without.run().is_err()) {
                    continue;
                }
            }
            match self.nearest_to(&mut search, amplitudes) {
                Ok(derived) => {
                    let before = self.counted.before(self.scaled);
                    let after = inflections(&derived.hull, planes);
                    let rank = (after.max(before), !derived.keeps_signs, !derived.keeps_body);
                    let derived = Derived { inflections: [before, after], ..derived };
                    if best.as_ref().is_none_or(|(other, _)| rank < *other) {
                        best = Some((rank, (derived, start.clone(), amplitudes)));
                    }
                    // Without a shift all parts are one.
                    let is_still = amplitudes.iter().all(|a| a.abs() < 1e-12);
                    if rank == (before, false, false) || wanted.first || is_still {
                        break;
                    }
                }
                Err(failed) => failure = failure.or(Some((start, failed))),
            }
        }
        best.map(|(_, found)| found).ok_or(failure.map(Box::new))
    }

    /// The scaled parent with a level shift that brings volume and LCB so far towards their targets, and its amplitudes.
    pub(super) fn started(&self, part: f64) -> (Hull, [f64; 2]) {
        let towards = |target: &Target| {
            let before = value_of(target.quantity, self.scaled, &self.reference);
            Target { value: before + part * (target.value - before), ..*target }
        };
        if self.body.is_some() {
            // Sections that are shifted would leave the ends of the body.
            return (self.scaled.clone(), [0.0; 2]);
        }
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

    /// The hull nearest to a start, with the signs of curvature of the parent where they are feasible.
    pub(super) fn nearest_to(&self, search: &mut Search<'_>, amplitudes: [f64; 2]) -> Result<Derived, Failed> {
        let (mut keeps_signs, mut keeps_body) = (search.has_signs(), true);
        let mut found = search.run();
        if found.is_err() && search.without_own_body() {
            keeps_body = false;
            found = search.run();
        }
        if found.is_err() && keeps_signs {
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
            keeps_body,
            ..self.plain(nearest.hull)
        })
    }
}
