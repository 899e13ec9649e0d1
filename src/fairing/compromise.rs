//! The program without signs; where it has no answer, why, and the best compromise: within the tolerances the nearest
//! that targets other than the table's can be had, else every wish with tolerances as wide as they must be. (Where
//! tolerances gave way to targets, a coaster had her displacement by waves, with 420 inflections for 99.)
//!
//! Limits that would hardly ever matter, of half-breadths far from 0 and B/2 and of what the surface moves between the
//! offsets, are asked for where an answer breaks them, until it breaks none. What contradicts itself goes on doing so
//! with more limits: the tolerances are wide from then on, and only where that is not wide enough any more the least
//! widening is asked for again.

use super::constraint::{Constraint, between, broken, control_values};
use super::error::FairError;
use super::infeasible::{Diagnosis, Ends, Target, diagnose, least_widening, nearest};
use super::model::Model;
use super::program::{Between, Program, Solved, Wishes};
use super::smoothing::Smoother;
use super::surface::FairSurface;
use crate::hull::Hull;
use crate::qp::{Settings, Status};

/// Room above the least widening, for an interior to solve in.
const ROOMS: [f64; 3] = [1e-3, 0.05, 0.5];

/// Least widening from which the targets of the table give way and not the tolerances.
const FAR: f64 = 1.5;

/// What an answer may break a limit of half-breadths by, over the greatest one.
const LIMIT_SLACK: f64 = 1e-6;

/// What the surface may move between the offsets beyond the tolerance, over the greatest half-breadth: room for the
/// swings of a table's own surface.
const ROOM_BETWEEN: f64 = 0.02;

/// Tolerances that the surface may be off between the offsets from the one without targets where these are others than
/// the table's: none for a displacement that is had by waves. (With the room above, a Series 60 with 0.9 % less
/// displacement was hollow by 1.3 m between offsets that kept within 16 mm.)
const LEVELS_BETWEEN: f64 = 3.0;

/// Limits between the offsets from which a program goes on breaking others.
const MANY: usize = 1000;

/// How much more a control value may move than the surface.
const NET_BETWEEN: f64 = 3.0;

/// Most times that limits are added that an answer breaks.
const LIMIT_ROUNDS: usize = 10;

/// Parts of the way from the nearest that targets can be had, where no offset has room left, to the fairest hull within
/// the tolerances, that are gone back: the first on which no more inflections are counted than before, or the last.
const GONE_BACK: [f64; 3] = [0.25, 0.5, 0.75];

/// Part of a smooth move that just fits into the tolerances which is asked for.
const WITHIN: f64 = 0.97;

/// The program without signs.
pub(super) struct Basic<'a> {
    pub(super) surface: &'a FairSurface,
    pub(super) model: &'a Model,
    pub(super) smoother: &'a Smoother,
    pub(super) lambda: f64,
    /// What the constraints of the wishes are.
    pub(super) constraints: &'a [Constraint],
    /// Room of each beyond its own band ([`super::fair::FairSettings::rooms`]).
    pub(super) rooms: &'a [f64],
    /// Which of them ask for something else than the surface through the table has.
    pub(super) others: &'a [bool],
    /// The net from which the surface must not move far between the offsets.
    pub(super) reference: Vec<f64>,
    /// How far: tolerance, which widens, and room besides \[m\].
    pub(super) room: [f64; 2],
    /// Greatest half-breadth \[m\].
    pub(super) greatest: f64,
    pub(super) solver: &'a Settings,
}

/// What it comes to.
pub(super) struct Answer {
    pub(super) program: Program,
    pub(super) solved: Solved,
    /// Why not every wish is met.
    pub(super) diagnosis: Option<Diagnosis>,
    /// What to ask for instead; the answer is none then.
    pub(super) instead: Option<Instead>,
    pub(super) programs: usize,
    pub(super) iterations: usize,
}

/// What can be had of wishes that cannot all be had.
#[derive(Debug, Clone, PartialEq)]
pub enum Instead {
    /// Targets between those of the net on which they are as near as they can be had and those of the fairest.
    Targets([Vec<f64>; 2]),
    /// Everything but these rules, by index.
    WithoutRules(Vec<usize>),
}

/// A factor on the tolerances that is tried.
struct Widening {
    /// The least that would do.
    least: f64,
    /// Index of the room above it.
    room: usize,
}

impl Widening {
    fn factor(&self) -> f64 {
        self.least.max(1.0) * (1.0 + ROOMS[self.room])
    }

    /// The next that is tried, whose least is known now: more room where more limits do not ask for more; none when
    /// there is none.
    fn next(before: Option<&Self>, least: f64) -> Option<Self> {
        let room = before.filter(|before| least <= before.least * (1.0 + ROOMS[0])).map_or(0, |before| before.room + 1);
        (room < ROOMS.len()).then_some(Self { least, room })
    }
}

impl<'a> Basic<'a> {
    /// The program of a surface for its constraints; `smoothed` is its net as it was smoothed.
    ///
    /// # Errors
    /// [`FairError::Problem`] when the numbers make no program.
    pub(super) fn new(
        surface: &'a FairSurface,
        model: &'a Model,
        (smoother, lambda): (&'a Smoother, f64),
        (constraints, rooms, others): (&'a [Constraint], &'a [f64], &'a [bool]),
        wishes: &Wishes,
        greatest: f64,
        solver: &'a Settings,
    ) -> Result<Self, FairError> {
        let reference = surface.start.clone();
        let mut tolerances: Vec<f64> = model.readings.iter().filter_map(|reading| reading.tolerance).collect();
        tolerances.sort_by(f64::total_cmp);
        let median = tolerances.get(tolerances.len() / 2).copied().unwrap_or(f64::INFINITY);
        let room = [median, ROOM_BETWEEN * greatest];
        let mut basic =
            Self { surface, model, smoother, lambda, constraints, rooms, others, reference, room, greatest, solver };
        if others.contains(&true) {
            let free = Wishes { constraints: Vec::new(), ..wishes.clone() };
            let free = basic.program(&free, 1.0).solve(smoother, lambda, solver)?;
            if free.is_optimal() {
                basic.reference = free.net;
                basic.room = [LEVELS_BETWEEN * tolerances.last().copied().unwrap_or(f64::INFINITY), 0.0];
            }
        }
        Ok(basic)
    }

    /// The same about readings that were moved.
    pub(super) fn carry(&mut self, model: &'a Model, smoother: &'a Smoother) {
        (self.model, self.smoother) = (model, smoother);
        if let Some(moved) = &model.carried {
            self.reference.iter_mut().zip(moved).for_each(|(value, more)| *value += more);
        }
    }

    /// What the constraints ask for.
    fn targets(&self) -> Vec<Target> {
        let hull = &self.surface.hull;
        let target = |(constraint, room): (&Constraint, &f64)| {
            let ([target, band], scale) = ([constraint.target(), constraint.band() + room], constraint.scale(hull));
            // A row that is relative to the value at the start grows by one where the quantity grows by that.
            let here = constraint.with_target(constraint.value(hull));
            let size = here.scale(hull);
            let row = self.smoother.reduced.row(&here.limit(hull).row).0;
            let row = row.into_iter().map(|(i, value)| (i, value * size)).collect();
            Target { limits: [target - band, target + band], scale, row }
        };
        self.constraints.iter().zip(self.rooms).map(target).collect()
    }

    /// Solves it, or the best compromise.
    ///
    /// # Errors
    /// [`FairError::Problem`] when the numbers make no program.
    pub(super) fn solve(&self, wishes: &mut Wishes) -> Result<Answer, FairError> {
        let mut wider: Option<Widening> = None;
        // The least widening, once it has been asked for.
        let mut contradiction: Option<Option<f64>> = None;
        let mut instead = None;
        let (mut programs, mut iterations, mut rounds) = (0, 0, 0);
        // A stall is looked into by the least widening, which proves more.
        let solver = Settings { proof: false, ..self.solver.clone() };
        let (program, solved) = loop {
            let factor = wider.as_ref().map_or(1.0, Widening::factor);
            let program = self.program(wishes, factor);
            let mut solved = program.solve(self.smoother, self.lambda, &solver)?;
            programs += 1;
            iterations += solved.solution.iterations;
            if solved.is_optimal() {
                if rounds < LIMIT_ROUNDS && self.limit(wishes, &solved.net, factor) {
                    rounds += 1;
                    continue;
                }
                break (program, solved);
            }
            if contradiction.is_none() {
                // Linear programs have no energy to keep them near.
                wishes.breadths.extend(control_values(self.surface.start.len(), self.greatest));
            }
            let mut least = least_widening(&self.program(wishes, 1.0), self.solver, |_, _| None)?;
            programs += 1;
            if contradiction.is_none() {
                let far = least.is_none_or(|least| least > FAR);
                let (found, more) = self.nearest(wishes, far)?;
                programs += more;
                instead = found.map(Instead::Targets);
                if instead.is_none() && far && !wishes.rules.is_empty() {
                    let (found, more) = self.without_rules(wishes)?;
                    programs += more;
                    instead = found.map(Instead::WithoutRules);
                }
            }
            if instead.is_some() {
                let plain = self.program(wishes, 1.0);
                least = least_widening(&plain, self.solver, |x, factor| self.further(wishes, x, factor))?;
                contradiction = Some(least);
                break (program, solved);
            }
            contradiction = Some(least);
            wider = least.and_then(|least| Widening::next(wider.as_ref(), least));
            if wider.is_none() {
                // Nothing solves: what the solver left is no hull. The surface as it was is one, and claims nothing.
                solved.net.clone_from(&self.surface.start);
                solved.solution.x = self.smoother.reduced.unknowns_of(&self.surface.start);
                break (program, solved);
            }
        };
        let mut answer = Answer { program, solved, diagnosis: None, instead, programs, iterations };
        if let Some(least) = contradiction {
            let plain = self.program(wishes, 1.0);
            let targets = self.targets();
            let value = |k: usize, x: &[f64]| {
                let hull = self.surface.hull_of(&self.smoother.reduced.expand(x)).ok()?;
                Some(self.constraints[k].value(&hull)).filter(|value| value.is_finite())
            };
            let (found, programs) =
                diagnose(plain, least, &targets, value, self.solver, |x| self.further(wishes, x, 1.0))?;
            answer.programs += programs;
            answer.diagnosis = Some(found);
            if least.is_none_or(|least| least > 1.0) && !answer.solved.is_optimal() {
                answer.solved.solution.status = Status::Infeasible;
            }
        }
        Ok(answer)
    }

    /// Where the targets are as near as they can be had within the tolerances: those that are not the table's, or
    /// else, where `far`, all of them; and the fairest net without those.
    fn nearest(&self, wishes: &mut Wishes, far: bool) -> Result<(Option<Ends>, usize), FairError> {
        let (others, targets) = (self.others, self.targets());
        let mut programs = 0;
        for all in [false, true] {
            if self.constraints.is_empty() || !(if all { far } else { others.contains(&true) }) {
                continue;
            }
            let program = self.program(wishes, 1.0);
            let cut = |x: &[f64]| self.further(wishes, x, 1.0);
            let (found, more) = nearest(program, |k| all || others[k], &targets, self.solver, cut)?;
            programs += more;
            if let Some(found) = found {
                return Ok((Some(found.map(|x| self.smoother.reduced.expand(&x))), programs));
            }
        }
        Ok((None, programs))
    }

    /// The rules that cannot be met, taking one after the other what can; none where it is not them.
    fn without_rules(&self, wishes: &Wishes) -> Result<(Option<Vec<usize>>, usize), FairError> {
        let mut rules: Vec<usize> = wishes.rules.iter().map(|(rule, _)| *rule).collect();
        rules.dedup();
        let solver = Settings { proof: false, ..self.solver.clone() };
        let mut programs = 0;
        let mut can = |kept: &[usize]| {
            let mut some = wishes.clone();
            some.rules.retain(|(rule, _)| kept.contains(rule));
            programs += 1;
            let solved = self.program(&some, 1.0).solve(self.smoother, self.lambda, &solver);
            solved.map(|solved| solved.is_optimal())
        };
        let mut kept = Vec::new();
        if !can(&kept)? {
            return Ok((None, programs));
        }
        for &rule in &rules {
            kept.push(rule);
            if !can(&kept)? {
                kept.pop();
            }
        }
        rules.retain(|rule| !kept.contains(rule));
        Ok((Some(rules).filter(|rules| !rules.is_empty()), programs))
    }

    /// The program with the limits that an x breaks with tolerances times a factor; none where it breaks none.
    fn further(&self, wishes: &mut Wishes, x: &[f64], widening: f64) -> Option<Program> {
        let net = self.smoother.reduced.expand(x);
        self.limit(wishes, &net, widening).then(|| self.program(wishes, 1.0))
    }

    /// The program with all tolerances times a factor.
    fn program(&self, wishes: &Wishes, widening: f64) -> Program {
        let wider = Wishes { widening, ..wishes.clone() };
        Program::new(self.model, self.smoother, self.lambda, &wider, None)
    }

    /// Adds the limits of half-breadths that a net breaks; false where it breaks none.
    pub(super) fn limit_breadths(&self, wishes: &mut Wishes, net: &[f64]) -> bool {
        let limits = broken(&self.surface.hull, net, &self.surface.start, self.greatest, LIMIT_SLACK * self.greatest);
        wishes.breadths.extend(limits.iter().cloned());
        !limits.is_empty()
    }

    /// Adds the limits that a net breaks; false where it breaks none.
    fn limit(&self, wishes: &mut Wishes, net: &[f64], widening: f64) -> bool {
        let far = self.limit_between(wishes, net, widening, self.room);
        self.limit_breadths(wishes, net) || far
    }

    /// Adds the limits that a net breaks of what the surface may move between the offsets: tolerance, which widens, and
    /// room besides \[m\]; false where it breaks none.
    pub(super) fn limit_between(&self, wishes: &mut Wishes, net: &[f64], widening: f64, room: [f64; 2]) -> bool {
        let slack = LIMIT_SLACK * self.greatest;
        let bands = between(&self.surface.hull, net, &self.reference, [room[0], widening, room[1]], slack);
        let any = !bands.is_empty();
        // What is kept back at one place comes out at the next: where targets ask for it, or where it goes on, the net is
        // kept back as a whole.
        let going_on = wishes.between.iter().all(|limit| limit.row.len() > 1) && wishes.between.len() > MANY;
        if going_on || (self.others.contains(&true) && any && wishes.between.is_empty()) {
            let [tolerance, room] = room.map(|room| NET_BETWEEN * room);
            let net = self.reference.iter().enumerate();
            wishes.between.extend(net.map(|(i, &value)| Between { row: vec![(i, 1.0)], value, tolerance, room }));
        }
        wishes.between.extend(bands);
        any
    }
}

/// What may be asked for in the place of targets that are out of reach, in the order in which it is tried: the part of them
/// that one smooth move has within the tolerances, where these would have to be `carried` times as wide for all; and what
/// the hulls have on the way from the first of `ends`, the nearest that they can be had, to the second, the fairest; what
/// the surface through the table, `before`, has, where there is neither. Nothing that is further from a target than that.
pub(super) fn within_reach(
    asked: &[Constraint],
    before: &Hull,
    ends: &Ends,
    carried: Option<f64>,
    surface: &FairSurface,
) -> Vec<Vec<Constraint>> {
    let start = &surface.hull;
    let eased = |constraint: &Constraint, value: f64| {
        let own = constraint.value(before);
        let nearer = constraint.missed(value, start) <= constraint.missed(own, start);
        constraint.eased(if nearer { value } else { own }, start)
    };
    let mut choices: Vec<Vec<Constraint>> = Vec::new();
    let mut smooth = None;
    for part in GONE_BACK {
        let [near, fair] = ends;
        let net: Vec<f64> = near.iter().zip(fair).map(|(near, fair)| near + part * (fair - near)).collect();
        // A linear program may leave control values far out where nothing holds them.
        let Ok(had) = surface.hull_of(&net) else { continue };
        choices.push(asked.iter().map(|constraint| eased(constraint, constraint.value(&had))).collect());
    }
    if let Some(factor) = carried.filter(|factor| *factor > 1.0 && factor.is_finite()) {
        let part = WITHIN / factor;
        let value = |constraint: &Constraint| {
            let own = constraint.value(before);
            own + part * (constraint.target() - own)
        };
        smooth = Some(asked.iter().map(|constraint| eased(constraint, value(constraint))).collect::<Vec<_>>());
    }
    let missed = |choice: &[Constraint]| {
        let nearest = |asked: &Constraint, eased: &Constraint| {
            let value = eased.target() + eased.band().copysign(eased.target() - asked.target());
            asked.missed(value, start)
        };
        asked.iter().zip(choice).map(|(asked, eased)| nearest(asked, eased)).sum::<f64>()
    };
    // What is nearer than a smooth move takes waves.
    match smooth {
        Some(smooth) if choices.iter().any(|choice| missed(&smooth) <= missed(choice)) => choices.insert(0, smooth),
        Some(smooth) => choices.push(smooth),
        None => {}
    }
    if choices.is_empty() {
        choices.push(asked.iter().map(|constraint| constraint.eased(constraint.value(before), start)).collect());
    }
    choices
}
