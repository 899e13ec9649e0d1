//! The whole job of fairing a surface: smooth, solve one convex program with targets and limits, and take no inflections
//! out of its lines without their price.
//!
//! 1. The weight: of a field by its likelihood; on the net of the surface through the table by Mallows' criterion for the
//!    errors of the table.
//! 2. Tolerances, constraints, 0 <= y <= B/2 as one program without signs: J_free.
//! 3. The same with signs of curvature of the lines of the table: J_signs. price = (J_signs - J_free) / sigma^2 is at most
//!    [`FairSettings::price`] for each hump (`humps`).

use super::bends::Line;
use super::compromise::{Answer, Basic, Instead};
use super::constraint::{Constraint, Rule, admit, breadths};
use super::error::FairError;
use super::humps::{self, Fewer};
use super::infeasible::Diagnosis;
use super::least::TableLine;
use super::least_waves::{WaveAim, least_waves};
use super::local_noise::{below_centreplane, local_noise};
use super::model::Limit;
use super::noise::{Differences, errors, taken};
use super::program::{Program, RowName, Solved, Wishes};
use super::relinearise::{ON_TARGET, Settling};
use super::rules::{counted_lines, rule_limits, turned};
use super::smoothing::{Smoothed, Smoother, Trial};
use super::strength::Few;
use super::surface::FairSurface;
use crate::qp::Settings;
use crate::resistance::WaveResult;

/// Dearest signs where nobody says another price, in units of sigma^2.
pub const PRICE: f64 = 12.0;

/// How a surface is faired.
#[derive(Debug, Clone)]
pub struct FairSettings {
    /// Constraints of the whole hull.
    pub constraints: Vec<Constraint>,
    /// Room of each beyond its own band, in its unit: what nobody stated is known to two standard errors.
    pub rooms: Vec<f64>,
    /// Which of them ask for something else than the surface through the table has.
    pub others: Vec<bool>,
    /// Rules for lines and regions.
    pub rules: Vec<Rule>,
    /// Factor on the weight of the search.
    pub strength: f64,
    /// How far an offset may be from the surface through the table, where that is asked for \[m\].
    pub through: Option<f64>,
    /// Smoothing weight; none: that of the search.
    pub weight: Option<f64>,
    /// Noise of the table where its neighbourhood is smooth \[m\].
    pub table_noise: f64,
    /// What differences leave of the table in which the hull's form is least, where it is known and the net is that of a
    /// fit.
    pub differences: Option<Differences>,
    /// Greatest noise level that is taken for roughness of a drawing on the net of a fit \[m\]: a third of a designer's
    /// tolerance.
    pub most_noise: f64,
    /// Least noise level that is assumed \[m\]: rounding of the table.
    pub least_noise: f64,
    /// Tolerance of a reading in noise levels, not below `least_tolerance`; none: no tolerances.
    pub tolerance_levels: Option<f64>,
    /// Least tolerance \[m\].
    pub least_tolerance: f64,
    /// Tolerances of single readings \[m\] that stand instead of these; empty for none at all.
    pub tolerances: Vec<Option<f64>>,
    /// Whether signs of curvature are imposed.
    pub signs: bool,
    /// Dearest of them, in units of sigma^2.
    pub price: f64,
    /// When inflections are few: others are removed until they are; none: those at the price stand.
    pub few: Option<Few>,
    /// Changes of sign of curvature of the surface through the table on stations and waterlines.
    pub before: usize,
    /// Lines whose inflections are counted.
    pub lines: Vec<Line>,
    /// The least departure of a lobe from its chord that counts \[m\].
    pub seen: f64,
    /// Whether half-breadths may be outside 0 to B/2 as far as those of the surface through the table are.
    pub admits: bool,
    /// The wave resistance that joins the objective, where it is asked for.
    pub waves: Option<WaveAim>,
    /// The solver.
    pub solver: Settings,
}

impl FairSettings {
    /// The least and the greatest noise level that is assumed \[m\].
    fn noises(&self) -> [f64; 2] {
        [self.least_noise, self.most_noise]
    }

    /// What is taken for errors of a noise of `sigma` \[m\].
    fn errors(&self, sigma: f64) -> f64 {
        errors(self.differences, self.noises(), sigma)
    }
}

/// What fairing comes to.
#[derive(Debug, Clone)]
pub struct Faired {
    /// All control values \[m\].
    pub net: Vec<f64>,
    /// Noise level of a reading \[m\].
    pub sigma: f64,
    /// What a search for the weight takes of it for errors \[m\].
    pub errors: f64,
    /// Smoothing weight.
    pub lambda: f64,
    /// The search for the weight.
    pub trials: Vec<Trial>,
    /// The smoothed net without any wish, at the weight that was taken.
    pub chosen: Trial,
    /// Effective degrees of freedom of the smoothed net.
    pub edf: f64,
    /// The program that was solved last.
    pub program: Program,
    /// Its answer.
    pub solved: Solved,
    /// Why the wishes cannot all be had; the net is then the best compromise, with the tolerances widened.
    pub diagnosis: Option<Diagnosis>,
    /// What to ask for instead where the wishes cannot all be had; the answer is none then.
    pub instead: Option<Instead>,
    /// What became of the lines of the table, on a net that follows its features.
    pub fewer: Option<Fewer>,
    /// Price of the signs in sigma^2.
    pub price: f64,
    /// What one less was allowed to cost, in sigma^2.
    pub dearest: f64,
    /// The factor on the tolerances from which what targets other than the table's ask for is one smooth move over the
    /// whole hull; none where there are no such targets, or they cannot be met at all.
    pub carried: Option<f64>,
    /// Each such target by index, and what the linear part of the program has more when it is dropped.
    pub without: Vec<(usize, Vec<f64>)>,
    /// Rows of the rules, with the index of the rule.
    pub rules: Vec<(usize, Limit)>,
    /// Largest relative error of metacentre and wetted surface before their first new linearisation and after each;
    /// none where everything that is held is linear.
    pub settled: Option<Vec<f64>>,
    /// What the wave resistance came to, where it joined the objective.
    pub waves: Option<WaveResult>,
    /// The smoothing problem, for further questions.
    pub smoother: Smoother,
    /// Programs solved.
    pub programs: usize,
    /// Iterations of the solver, all programs together.
    pub iterations: usize,
}

/// How much is smoothed and how noisy the readings are, found once for all programs.
#[derive(Debug, Clone)]
pub struct Prepared {
    /// The smoothing problem.
    pub smoother: Smoother,
    /// The weight.
    pub lambda: f64,
    /// The net for it.
    pub smoothed: Smoothed,
    /// The net for the weight of the search, where that is another.
    pub likely: Option<Smoothed>,
    /// Noise of a reading \[m\].
    pub sigma: f64,
    /// What a search for the weight takes of it for errors \[m\].
    pub errors: f64,
    /// The search for the weight.
    pub trials: Vec<Trial>,
    /// The lines of the table with their least inflections, on a net that follows its features.
    pub lines: Vec<TableLine>,
}

impl Prepared {
    /// Finds weight and noise, and gives the readings of the surface their tolerances.
    ///
    /// # Errors
    /// [`FairError`] when the readings leave a control value open.
    pub fn new(surface: &mut FairSurface, settings: &FairSettings) -> Result<Self, FairError> {
        let smoother = Smoother::new(&surface.model);
        // Features that the offsets do not resolve rule cross-validation on this net: the noise is that of the table,
        // whatever the weight is. What is within the tolerance of a designer counts as the roughness of a drawing and gets
        // no more room than he gives. The weight is that for errors, which the hull's own form is not.
        let sigma = taken(settings.table_noise, settings.noises());
        let search = match settings.weight {
            Some(weight) => (weight, Vec::new()),
            None => smoother.for_noise(settings.errors(sigma))?,
        };
        Self::searched(surface, settings, smoother, search, sigma)
    }

    /// The same from a smoothing problem whose weight is known, with the search that found it, and the noise \[m\].
    ///
    /// # Errors
    /// [`FairError`] when the readings leave a control value open.
    pub fn searched(
        surface: &mut FairSurface,
        settings: &FairSettings,
        smoother: Smoother,
        (lambda, trials): (f64, Vec<Trial>),
        sigma: f64,
    ) -> Result<Self, FairError> {
        let smoothed = smoother.at(lambda)?;
        let local = surface.is_field.then(|| local_noise(surface, &smoothed, sigma));
        for (k, (reading, place)) in surface.model.readings.iter_mut().zip(&surface.places).enumerate() {
            // A reading of known control values alone weighs nothing; it has the tolerance of the others.
            let weight = if reading.weight > 0.0 { reading.weight } else { 1.0 };
            let levels = settings.tolerance_levels;
            let sigma = local.as_ref().map_or(sigma, |local| local[k]);
            let free = levels.map(|levels| (levels * sigma / weight.sqrt()).max(settings.least_tolerance));
            let own = settings.tolerances.get(k).copied().flatten();
            reading.tolerance = if place.locked { Some(0.0) } else { own.or(free) };
        }
        let errors = settings.errors(sigma);
        let found = Self { smoother, lambda, smoothed, likely: None, sigma, errors, trials, lines: Vec::new() };
        let mut graded = found.graded(surface, settings)?;
        if settings.signs {
            graded.lines = settings.lines.iter().map(|&line| TableLine::new(surface, line)).collect();
        }
        Ok(graded)
    }

    /// The weight of the search times the strength of the settings, and the tolerances of a surface through the table
    /// where that is asked for. The least inflections of the lines stay those for the tolerances before.
    ///
    /// # Errors
    /// [`FairError`] when the readings leave a control value open.
    pub fn graded(mut self, surface: &mut FairSurface, settings: &FairSettings) -> Result<Self, FairError> {
        let stronger = self.lambda * settings.strength;
        // Digits that the table does not have are not followed.
        let graded = if settings.strength < 1.0 {
            self.smoother.through(self.lambda, settings.least_noise).max(stronger)
        } else {
            stronger
        };
        if graded.total_cmp(&self.lambda).is_ne() {
            self.likely = Some(std::mem::replace(&mut self.smoothed, self.smoother.at(graded)?));
            self.lambda = graded;
        }
        for (k, (reading, place)) in surface.model.readings.iter_mut().zip(&surface.places).enumerate() {
            if let Some(through) = settings.through.filter(|_| !place.locked) {
                let own = settings.tolerances.get(k).copied().flatten();
                reading.tolerance = Some(own.map_or(through, |own| own.min(through)));
            }
        }
        Ok(self)
    }
}

/// Fairs with a weight and a noise that are known.
///
/// # Errors
/// [`FairError`] when the question is none.
pub fn fair_prepared(
    surface: &mut FairSurface,
    settings: &FairSettings,
    prepared: &Prepared,
) -> Result<Faired, FairError> {
    let Prepared { smoother, smoothed, .. } = prepared;
    let (lambda, sigma) = (prepared.lambda, prepared.sigma);
    surface.model.carried = None;
    let hull = &surface.hull;
    let widest = surface.model.readings.iter().map(|reading| reading.value).fold(0.0, f64::max);
    // A field knows no greatest half-breadth: B is known or assumed, and its offsets may be off.
    let greatest = widest.max(0.5 * hull.particulars().breadth) * if surface.is_field { 2.0 } else { 1.0 };
    let first = smoother.reduced.expand(&smoothed.free);
    let constraints: Vec<Limit> =
        settings.constraints.iter().zip(&settings.rooms).map(|(wish, &room)| wish.limit_within(hull, room)).collect();
    let mut wishes = Wishes {
        constraints,
        breadths: breadths(hull, &first, greatest, 2.0 * sigma),
        rules: rule_limits(surface, &settings.rules).map_err(FairError::Rules)?,
        widening: 1.0,
        ..Wishes::default()
    };
    // The surface through the table swings past B/2 between offsets that stay: so does any other through them.
    if surface.is_field || settings.admits || surface.places.iter().any(|place| place.locked) {
        admit(&mut wishes.breadths, &surface.start);
    }
    if surface.is_field {
        let least = below_centreplane(sigma, hull);
        // What is no more than its errors below the centreplane is at the centreplane.
        wishes.breadths.iter_mut().for_each(|limit| limit.lower = limit.lower.max(-least));
    }
    let model = &surface.model.clone();
    let weighed = (smoother, lambda);
    let asked = (settings.constraints.as_slice(), settings.rooms.as_slice(), settings.others.as_slice());
    let mut basic = Basic::new(surface, model, weighed, asked, &wishes, greatest, &settings.solver)?;
    let carry = basic.carried(&wishes)?;
    let (model, smoother) = match &carry.carried {
        Some(carried) => (&carried.model, &carried.smoother),
        None => (model, smoother),
    };
    basic.carry(model, smoother);
    let Answer { mut program, mut solved, mut diagnosis, mut instead, mut programs, mut iterations } =
        basic.solve(&mut wishes)?;
    programs += carry.programs;
    if diagnosis.is_none()
        && solved.is_optimal()
        && let Some(found) = turned(surface, &settings.rules, &prepared.lines, &solved.net, |rules| {
            let asked = Wishes { rules: wishes.rules.iter().chain(rules).cloned().collect(), ..wishes.clone() };
            let program = Program::new(model, smoother, lambda, &asked, None);
            let solved = program.solve(smoother, lambda, &settings.solver)?;
            programs += 1;
            iterations += solved.solution.iterations;
            Ok((program, solved))
        })?
    {
        wishes.rules.extend(found.limits);
        (program, solved) = (found.program, found.solved);
        if !solved.is_optimal() {
            let answer = basic.solve(&mut wishes)?;
            programs += answer.programs;
            iterations += answer.iterations;
            (program, solved, diagnosis, instead) = (answer.program, answer.solved, answer.diagnosis, answer.instead);
        }
    }
    let mut price = 0.0;
    let mut fewer = None;
    let lines = &counted_lines(&prepared.lines, &settings.rules);
    let question = humps::Question {
        model,
        smoother,
        likely: prepared.likely.as_ref().unwrap_or(&prepared.smoothed),
        lambda,
        sigma,
        wishes: &wishes,
        lines,
        seen: settings.seen,
        price: settings.price,
        few: settings.few,
        before: settings.before,
        least_tolerance: settings.least_tolerance,
        solver: &settings.solver,
    };
    if settings.signs && diagnosis.is_none() && solved.is_optimal() {
        let mut found = question.run(&solved)?;
        programs += found.programs;
        iterations += found.iterations;
        if let Some(accepted) = found.accepted.take() {
            price = (accepted.1.objective - solved.objective) / (sigma * sigma);
            (program, solved) = accepted;
        }
        fewer = Some(found);
    }
    let mut waves = None;
    if let Some(aim) = settings.waves.as_ref().filter(|_| diagnosis.is_none() && solved.is_optimal()) {
        let found = least_waves(&question, surface, aim, &solved)?;
        programs += found.work[0];
        iterations += found.work[1];
        (program, solved, waves) = (found.program, found.solved, Some(found.waves));
    }
    surface.model.carried.clone_from(&model.carried);
    let mut settled = None;
    if diagnosis.is_none() && solved.is_optimal() {
        let constraints = &settings.constraints;
        let settling = Settling { surface, constraints, smoother, lambda, solver: &settings.solver };
        if let Some(found) = settling.run(&program, &solved)? {
            programs += found.programs;
            iterations += found.iterations;
            (program, solved) = (found.program, found.solved);
            settled = Some(found.errors);
        }
    }
    Ok(Faired {
        carried: carry.widening,
        without: carry.without,
        rules: wishes.rules,
        settled,
        waves,
        diagnosis,
        instead,
        net: solved.net.clone(),
        sigma,
        errors: prepared.errors,
        dearest: fewer.as_ref().map_or(settings.price, |fewer| fewer.dearest),
        lambda,
        trials: prepared.trials.clone(),
        chosen: prepared.smoothed.trial(smoother.count()),
        edf: prepared.smoothed.edf,
        program,
        solved,
        price,
        fewer,
        smoother: smoother.clone(),
        programs,
        iterations,
    })
}

impl Faired {
    /// The same with the programs of an attempt before it.
    #[must_use]
    pub fn after(mut self, before: &Self) -> Self {
        self.programs += before.programs;
        self.iterations += before.iterations;
        self
    }

    /// Whether metacentre or wetted surface did not come to their targets.
    #[must_use]
    pub fn stalled(&self) -> bool {
        self.settled.as_ref().and_then(|errors| errors.last()).is_some_and(|error| *error > ON_TARGET)
    }

    /// Rows of the program whose names are these.
    pub fn rows(&self, these: impl Fn(RowName) -> bool) -> impl Iterator<Item = usize> {
        self.program.names.iter().enumerate().filter(move |(_, name)| these(**name)).map(|(row, _)| row)
    }
}
