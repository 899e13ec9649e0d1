//! The program without signs; where it has no answer, the best compromise: every other wish, with tolerances as wide as
//! they must be, and why.
//!
//! Limits that would hardly ever matter, of half-breadths far from 0 and B/2 and of what the surface moves between the
//! offsets, are asked for where an answer breaks them, until it breaks none. What contradicts itself goes on doing so
//! with more limits: the tolerances are wide from then on, and only where that is not wide enough any more the least
//! widening is asked for again.

use super::constraint::{between, broken, control_values};
use super::fair::FairError;
use super::infeasible::{Diagnosis, diagnose, least_widening};
use super::model::Model;
use super::program::{Program, Solved, Wishes};
use super::smoothing::Smoother;
use super::surface::FairSurface;
use crate::qp::{Settings, Status};

/// Room above the least widening, for an interior to solve in.
const ROOMS: [f64; 3] = [1e-3, 0.05, 0.5];

/// What an answer may break a limit of half-breadths by, over the greatest one.
const LIMIT_SLACK: f64 = 1e-6;

/// What the surface may move between the offsets beyond the tolerance, over the greatest half-breadth: room for the
/// swings of a table's own surface, none for a displacement that is had by waves.
const ROOM_BETWEEN: f64 = 0.02;

/// Most times that limits are added that an answer breaks.
const LIMIT_ROUNDS: usize = 10;

/// The program without signs.
pub(super) struct Basic<'a> {
    pub(super) surface: &'a FairSurface,
    pub(super) model: &'a Model,
    pub(super) smoother: &'a Smoother,
    pub(super) lambda: f64,
    /// The net from which the surface must not move far between the offsets.
    pub(super) reference: &'a [f64],
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
    pub(super) programs: usize,
    pub(super) iterations: usize,
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

impl Basic<'_> {
    /// Solves it, or the best compromise.
    ///
    /// # Errors
    /// [`FairError::Problem`] when the numbers make no program.
    pub(super) fn solve(&self, wishes: &mut Wishes) -> Result<Answer, FairError> {
        let tolerance = self.typical_tolerance();
        let mut wider: Option<Widening> = None;
        // The least widening, once it has been asked for.
        let mut contradiction: Option<Option<f64>> = None;
        let (mut programs, mut iterations, mut rounds) = (0, 0, 0);
        // A stall is looked into by the least widening, which proves more.
        let solver = Settings { proof: false, ..self.solver.clone() };
        let (program, solved) = loop {
            let factor = wider.as_ref().map_or(1.0, Widening::factor);
            let program = self.program(wishes, factor);
            let mut solved = program.solve(self.model, self.smoother, self.lambda, &solver)?;
            programs += 1;
            iterations += solved.solution.iterations;
            if solved.is_optimal() {
                if rounds < LIMIT_ROUNDS && self.limit(wishes, &solved.net, [tolerance, factor]) {
                    rounds += 1;
                    continue;
                }
                break (program, solved);
            }
            if contradiction.is_none() {
                // Linear programs have no energy to keep them near.
                wishes.breadths.extend(control_values(self.surface.start.len(), self.greatest));
            }
            let least = least_widening(&self.program(wishes, 1.0), self.solver)?;
            programs += 1;
            contradiction = Some(least);
            wider = least.and_then(|least| Widening::next(wider.as_ref(), least));
            if wider.is_none() {
                // Nothing solves: what the solver left is no hull. The surface as it was is one, and claims nothing.
                solved.net.clone_from(&self.surface.start);
                solved.solution.x = self.smoother.reduced.free.iter().map(|&i| self.surface.start[i]).collect();
                break (program, solved);
            }
        };
        let mut answer = Answer { program, solved, diagnosis: None, programs, iterations };
        if let Some(least) = contradiction {
            let plain = self.program(wishes, 1.0);
            let (found, programs) = diagnose(plain, least, self.solver, |x| {
                let net = self.smoother.reduced.expand(x);
                self.limit(wishes, &net, [tolerance, 1.0]).then(|| self.program(wishes, 1.0))
            })?;
            answer.programs += programs;
            answer.diagnosis = Some(found);
            if least.is_none_or(|least| least > 1.0) && !answer.solved.is_optimal() {
                answer.solved.solution.status = Status::Infeasible;
            }
        }
        Ok(answer)
    }

    /// The program with all tolerances times a factor.
    fn program(&self, wishes: &Wishes, widening: f64) -> Program {
        let wider = Wishes { widening, ..wishes.clone() };
        Program::new(self.model, self.smoother, self.lambda, &wider, None)
    }

    /// The median tolerance of a reading \[m\].
    fn typical_tolerance(&self) -> f64 {
        let mut tolerances: Vec<f64> = self.model.readings.iter().filter_map(|reading| reading.tolerance).collect();
        tolerances.sort_by(f64::total_cmp);
        tolerances.get(tolerances.len() / 2).copied().unwrap_or(f64::INFINITY)
    }

    /// Adds the limits that a net breaks; false where it breaks none.
    fn limit(&self, wishes: &mut Wishes, net: &[f64], [tolerance, widening]: [f64; 2]) -> bool {
        let hull = &self.surface.hull;
        let slack = LIMIT_SLACK * self.greatest;
        let limits = broken(hull, net, &self.surface.start, self.greatest, slack);
        let room = [tolerance, widening, ROOM_BETWEEN * self.greatest];
        let bands = between(hull, net, self.reference, room, slack);
        let any = !(limits.is_empty() && bands.is_empty());
        wishes.breadths.extend(limits);
        wishes.between.extend(bands);
        any
    }
}
