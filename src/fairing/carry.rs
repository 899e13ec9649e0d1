//! Targets that are others than the table's: what they ask for is carried over the whole hull as one smooth move, and
//! the offsets that are smoothed are those of the table with that move.
//!
//! Over the net r that is fairest without these targets, the move d is least in
//!
//! ```text
//! sum w_k (a_k d)^2 + mu d'E d   subject to the constraints, the tolerances and the rules for r + d
//! ```
//!
//! On a field, which has nothing else to hold it between its waterlines, the sum over the readings is d'Q d
//! ([`super::move_metric`]). The weight mu is far above the one that smooths the noise: a displacement that is several
//! percent away comes by a hull that is fuller, and not by one that swells between offsets which hold it where they are. A
//! Series 60 with 5 % more displacement and tolerances of 500 mm had 442 inflections for the 119 of its table and 114 times its energy,
//! and has 108 and 3.5 times; with LCB 1 % of L further aft, 305 and 8.5 times, and now 83 and 0.7 times. With mu = 1e2
//! instead of 1e4 it is 114 and 96 inflections, with 1e6 108 and 87, and moves are larger. The tolerances go on being
//! counted from the table.

use super::compromise::Basic;
use super::error::FairError;
use super::model::{Model, value};
use super::program::{Program, RowName, Wishes, symmetric};
use super::smoothing::Smoother;
use crate::qp::Settings;

/// Weight of the energy of the move.
const SMOOTH: f64 = 1e4;

/// What the surface may move between the offsets within the tolerances, over what a program of the offsets may: one and a
/// half tolerances. With two thirds of it a Series 60 with 300 mm and 5 % more displacement cannot be met so (309
/// inflections for 241), with twice as much tolerances that are just wide enough are used up by swells between the
/// offsets.
const BETWEEN: f64 = 0.5;

/// Most times that limits are added that a move breaks.
const LIMIT_ROUNDS: usize = 10;

/// What the targets ask for.
#[derive(Default)]
pub(super) struct Carry {
    /// The readings with the move; none where no target is another than the table's, or the targets cannot be met.
    pub(super) carried: Option<Carried>,
    /// The factor on the tolerances from which they do not bend the move; none where the targets cannot be met at all.
    pub(super) widening: Option<f64>,
    /// Each such target, and what the linear part of a program over the free values has more without it, where the
    /// move is that of the others.
    pub(super) without: Vec<(usize, Vec<f64>)>,
    /// Programs solved.
    pub(super) programs: usize,
}

impl Basic<'_> {
    /// What the targets ask for.
    ///
    /// # Errors
    /// [`FairError`] when the numbers make no program.
    pub(super) fn carried(&self, wishes: &Wishes) -> Result<Carry, FairError> {
        let mut carry = Carry::default();
        let others: Vec<usize> = (0..self.others.len()).filter(|&k| self.others[k]).collect();
        if others.is_empty() {
            return Ok(carry);
        }
        let (moved, widening) = self.moved(wishes, &mut carry.programs)?;
        carry.widening = widening;
        let Some(moved) = moved else { return Ok(carry) };
        let carried = Carried::new(self.model, self.smoother, moved);
        for &k in &others {
            let mut rest = wishes.clone();
            rest.constraints.remove(k);
            let moved = if others.len() > 1 { self.moved(&rest, &mut carry.programs)?.0 } else { None };
            let smoother = match moved {
                Some(moved) => &Carried::new(self.model, self.smoother, moved).smoother,
                None => self.smoother,
            };
            carry.without.push((k, carried.smoother.linear_less(self.lambda, smoother)));
        }
        carry.carried = Some(carried);
        Ok(carry)
    }

    /// The move of the control values \[m\]; none where the targets cannot be met within the tolerances. And the factor
    /// on these from which they do not bend it.
    fn moved(&self, wishes: &Wishes, programs: &mut usize) -> Result<(Option<Vec<f64>>, Option<f64>), FairError> {
        let mut wishes = wishes.clone();
        let Some(free) = self.smooth_move(&mut wishes, false, programs)? else { return Ok((None, None)) };
        let tolerated = self.model.readings.iter().filter(|reading| reading.weight > 0.0);
        let times = tolerated.filter_map(|reading| {
            let tolerance = reading.tolerance.filter(|tolerance| *tolerance > 0.0)?;
            Some((value(&reading.row, &free) - reading.value).abs() / tolerance)
        });
        let widening = times.fold(0.0, f64::max);
        let within = if widening <= 1.0 { Some(free) } else { self.smooth_move(&mut wishes, true, programs)? };
        let moved = within.map(|net| net.iter().zip(&self.reference).map(|(net, start)| net - start).collect());
        Ok((moved, Some(widening)))
    }

    /// The net with the smoothest move, within the tolerances or without them; none where there is none. The limits of
    /// half-breadths that it would break are added to the wishes.
    fn smooth_move(
        &self,
        wishes: &mut Wishes,
        within: bool,
        programs: &mut usize,
    ) -> Result<Option<Vec<f64>>, FairError> {
        let solver = Settings { proof: false, ..self.solver.clone() };
        let reference = self.smoother.reduced.unknowns_of(&self.reference);
        let metric = self.smoother.metric_of_moves(SMOOTH);
        let stays = metric.apply(&reference);
        for _ in 0..LIMIT_ROUNDS {
            let mut program = Program::new(self.model, self.smoother, SMOOTH, wishes, None);
            if !within {
                let locked = |k: usize| self.model.readings[k].tolerance == Some(0.0);
                program = program.without(|name| matches!(name, RowName::Tolerance(k) if !locked(k)));
            }
            program.problem.quadratic = symmetric(&metric, 2.0);
            program.problem.linear = stays.iter().map(|value| -2.0 * value).collect();
            let solved = program.solve(self.smoother, SMOOTH, &solver)?;
            *programs += 1;
            if !solved.is_optimal() {
                break;
            }
            let far = within && self.limit_between(wishes, &solved.net, 1.0, [self.room[0] * BETWEEN, self.room[1]]);
            if !(self.limit_breadths(wishes, &solved.net) || far) {
                return Ok(Some(solved.net));
            }
        }
        Ok(None)
    }
}

/// The model with a move, and what smooths it.
pub(super) struct Carried {
    pub(super) model: Model,
    pub(super) smoother: Smoother,
}

impl Carried {
    /// `moved` is added to every control value of what is smoothed.
    pub(super) fn new(model: &Model, smoother: &Smoother, moved: Vec<f64>) -> Self {
        let model = Model { carried: Some(moved), ..model.clone() };
        let smoother = Smoother::new(&model).reweighted(smoother.weights());
        Self { model, smoother }
    }
}
