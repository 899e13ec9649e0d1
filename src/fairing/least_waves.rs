//! The hull of least wave resistance and energy within the tolerances of a table.
//!
//! ```text
//! minimise    lambda E(d) + w R(c + d),     R = 1/n sum over speeds of R_W(c + d) / R_W(c)
//! ```
//!
//! over the moves d from the fair hull c, subject to all that c is held to, and to the signs of curvature that its lines have. The
//! tolerances bound the move of each offset; the energy keeps the move fair. It is one convex program for each weight w.
//! [`crate::resistance::WaveTerm`] has R_W and what is known of such programs. Tried: the misfit beside the energy. Tables without noise have
//! little energy in their objective, and a Wigley hull got 250 monotone pieces for 90.

use std::cell::{Cell, RefCell};

use super::error::FairError;
use super::humps::Question;
use super::program::{Program, Solved, Wishes, symmetric};
use super::surface::FairSurface;
use crate::hull::Hull;
use crate::qp::RepeatedSolver;
use crate::resistance::{NoWaveTerm, WaveRequest, WaveResult, WaveTerm, WaveTrade, knee};

/// What is asked, and the draught at which it is \[m\].
#[derive(Debug, Clone, PartialEq)]
pub struct WaveAim {
    /// Speeds, weight and water.
    pub request: WaveRequest,
    /// Draught \[m\].
    pub draught: f64,
}

/// The program of the weight that is taken, with its answer.
pub(super) struct LeastWaves {
    pub(super) program: Program,
    pub(super) solved: Solved,
    pub(super) waves: WaveResult,
    /// Programs that were solved, and iterations of the solver.
    pub(super) work: [usize; 2],
}

/// R over the unknowns of a program.
struct Term<'a> {
    term: &'a WaveTerm,
    /// The unknowns that R depends on.
    places: &'a [usize],
    /// Their values about which R is known \[m\].
    at: Vec<f64>,
}

impl Term<'_> {
    fn change(&self, x: &[f64]) -> Vec<f64> {
        self.places.iter().zip(&self.at).map(|(&k, at)| x[k] - at).collect()
    }

    /// The program with w R beside its objective.
    fn added(&self, base: &Program, weight: f64) -> Program {
        let mut program = base.clone();
        let squares = self.term.squares(base.problem.linear.len(), self.places, weight);
        // |F'(x - at)|^2 = |F'x|^2 - 2 (F F'at)'x + ...
        let mut there = vec![0.0; base.problem.linear.len()];
        self.places.iter().zip(&self.at).for_each(|(&place, at)| there[place] = *at);
        let pull = squares.apply_transposed(&squares.apply(&there));
        for (&place, slope) in self.places.iter().zip(&self.term.gradient) {
            program.problem.linear[place] += weight * slope - pull[place];
        }
        program.problem.squares = squares;
        program
    }
}

/// Control values of the net below a level draught.
fn submerged(hull: &Hull, draught: f64) -> Option<impl Fn(usize) -> bool> {
    let surface = hull.surface();
    let top = hull.height_parameter(draught)?;
    let columns = surface.shape()[1];
    let knots = surface.v().knots().to_vec();
    Some(move |k: usize| knots[k % columns] < top)
}

/// The hull of least wave resistance and energy of its move from `first`, the fair hull, with her signs; for the weight that is asked for,
/// or for the knee of seven.
///
/// # Errors
/// [`FairError::Waves`] where R_W is no quadratic form of the net, and [`FairError::NoWaves`] where no weight was solved.
pub(super) fn least_waves(
    question: &Question<'_>,
    surface: &FairSurface,
    WaveAim { request, draught }: &WaveAim,
    first: &Solved,
) -> Result<LeastWaves, FairError> {
    let hull = surface.hull_of(&first.net)?;
    let before = request.resistances(&hull, *draught)?;
    let reduced = &question.smoother.reduced;
    let Some(is_submerged) = submerged(&hull, *draught) else {
        return Err(NoWaveTerm::NotLevel(hull.name().to_owned()).into());
    };
    let places: Vec<usize> = (0..reduced.free.len()).filter(|&k| is_submerged(reduced.free[k])).collect();
    let free: Vec<usize> = places.iter().map(|&k| reduced.free[k]).collect();
    let term = WaveTerm::new(&hull, &free, request, *draught, &before)?;
    let unknowns = reduced.unknowns_of(&first.net);
    let term = Term { term: &term, at: places.iter().map(|&k| unknowns[k]).collect(), places: &places };
    let wishes = Wishes { bends: question.signs_of(&first.net), ..question.wishes.clone() };
    let mut base = Program::new(question.model, question.smoother, question.lambda, &wishes, None);
    let energy = question.smoother.energy_of_moves(question.lambda);
    base.problem.quadratic = symmetric(&energy, 2.0);
    base.problem.linear = energy.apply(&unknowns).iter().map(|slope| -2.0 * slope).collect();
    let work = Cell::new([0; 2]);
    let solver = RefCell::new(RepeatedSolver::new(question.solver));
    let solved = |weight: f64| -> Result<Option<(Program, Solved, WaveTrade)>, FairError> {
        let program = term.added(&base, weight);
        let solution = solver.borrow_mut().solve(&program.problem).map_err(FairError::from)?;
        let solved = program.judged(solution, question.smoother, question.lambda);
        let [programs, iterations] = work.get();
        work.set([programs + 1, iterations + solved.solution.iterations]);
        if !solved.is_optimal() {
            return Ok(None);
        }
        let change = term.change(&solved.solution.x);
        let square = change.iter().map(|c| c * c).sum::<f64>() / change.len().max(1) as f64;
        let trade = WaveTrade {
            weight,
            ratio: term.term.after(&change),
            energy: energy
                .quadratic(&solved.solution.x.iter().zip(&unknowns).map(|(x, at)| x - at).collect::<Vec<_>>()),
            moves: square.sqrt(),
            inflections: question.inflections(&solved.net),
            keeps_signs: true,
        };
        Ok(Some((program, solved, trade)))
    };
    let ratio = |weight: f64| Some(solved(weight).ok()??.2.ratio);
    let mut found = Vec::new();
    for weight in request.weights(1.0, 0.5 * hull.particulars().breadth, ratio) {
        found.extend(solved(weight)?);
    }
    let trades: Vec<WaveTrade> = found.iter().map(|(_, _, trade)| *trade).collect();
    if trades.is_empty() {
        return Err(FairError::NoWaves);
    }
    let taken = knee(&trades);
    let (program, solved, _) = found.swap_remove(taken);
    let after = request.resistances(&surface.hull_of(&solved.net)?, *draught)?;
    let waves = WaveResult { froude_numbers: request.froude_numbers.clone(), before, after, trades, taken };
    Ok(LeastWaves { program, solved, waves, work: work.get() })
}
