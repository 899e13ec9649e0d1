//! The hull nearest to a start that has all targets: a convex quadratic program over the half-breadths on its chart.
//!
//! ```text
//! minimise    J(c)                                     the bending of the change c
//! subject to  g_k . c = -r_k                           the equations of the targets, linearised where they are not linear
//!             y_ij = y_i+1,j                           in a parallel body
//!             0 <= y + c <= B/2, order of sections and waterlines, signs of curvature
//! ```
//!
//! A wave resistance joins J as a second convex term ([`crate::resistance::WaveTerm`]). Rows of limits come into the program when an answer misses them. Equations that are not linear (KM, wetted surface, the
//! place of the largest section) are linearised at the answer until they hold; a last correction of least size takes what
//! the solver leaves, so that relative errors are those of rounding.

use nalgebra::{DMatrix, DVector};

use super::bending::form;
use super::parallel::{Band, band, own_band};
use super::pool::{AT_LIMIT, Candidate, Kind, candidates};
use super::quantity::{Equation, Reference, equation};
use super::request::Target;
use crate::hull::{Hull, HullError};
use crate::qp::{Interior, Problem, ProblemError, Settings, Solution, SparseRows, Status};
use crate::resistance::WaveTerm;
use crate::spline::BsplineSurface;

/// Relative error at which an equation holds.
const HELD: f64 = 2e-13;
/// Largest relative error that is left to the last correction.
const CORRECTED: f64 = 1e-7;
/// Most linearisations.
const TANGENTS: usize = 12;
/// Most rounds in which missed rows come into the program.
const ROUNDS: usize = 40;
/// Most rows of a round for each row that is in the program.
const LEAST_ADDED: usize = 120;
/// Most iterations of a program from one start: what has a solution takes a third of them.
const ITERATIONS: usize = 100;
/// Largest violation of rows that a program without a proof may leave.
const MOST_VIOLATED: f64 = 1e-6;
/// Optimum over (B/2)^2 that a duality gap is divided by at least.
const LEAST_OPTIMUM: f64 = 1e-9;
/// A multiplier beside the square of B/2 from which a limit binds.
const BINDS: f64 = 1e-7;
/// Most corrections.
const CORRECTIONS: usize = 4;

/// Why there is no nearest hull.
#[derive(Debug)]
pub(super) enum Failed {
    /// No half-breadths within the limits meet the targets.
    Infeasible,
    /// The steps came to no end: the largest relative error that was left.
    Astray(f64),
    /// The half-breadths make no hull.
    Hull(HullError),
    /// The program could not be stated: a fault of this one.
    Program(ProblemError),
}

/// Limits of one kind that bound an answer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BindingLimits {
    /// What they are about: `centreplane`, `breadth`, `order`, `signs` or `within`.
    pub kind: &'static str,
    /// How many of them bind.
    pub count: usize,
    /// Derivative of the optimum by a slack that all of them get: at most 0, since limits that widen cost nothing. \[m\] where
    /// the slack is one of half-breadths, \[m^3\] where it is one of curvatures.
    pub price: f64,
}

/// The nearest hull.
#[derive(Debug, Clone)]
pub(super) struct Nearest {
    pub(super) hull: Hull,
    /// Derivative of the optimum by the relative change of each target, with its sign \[m^2\].
    pub(super) prices: Vec<f64>,
    /// J of the change \[m^2\].
    pub(super) energy: f64,
    /// Duality gap of the last program over its optimum.
    pub(super) gap: f64,
    /// Limits that bound the answer, by kind.
    pub(super) binding: Vec<BindingLimits>,
    /// Programs that were solved.
    pub(super) programs: usize,
}

/// The solution of a program, from a point of a similar one where that is known.
///
/// # Errors
/// [`Failed::Infeasible`] where none was found: no proof of it is looked for, which costs more than the search itself.
pub(super) fn solved(problem: &Problem, known: Option<&Interior>, iterations: usize) -> Result<Solution, Failed> {
    let settings = Settings { tolerance: 1e-11, iterations, proof: false };
    let solution = problem.solve_from(&settings, known).map_err(Failed::Program)?;
    let is_met = || problem.certificate(&solution.x, &solution.multipliers, 0.0).max_violation <= MOST_VIOLATED;
    match solution.status {
        Status::Optimal => Ok(solution),
        Status::Limit if is_met() => Ok(solution),
        _ => Err(Failed::Infeasible),
    }
}

/// The hull with these half-breadths on its chart.
pub(super) fn with_breadths(hull: &Hull, y: &[f64]) -> Result<Hull, HullError> {
    let surface = hull.surface();
    let points = surface.points().iter().zip(y).map(|([x, _, z], y)| [*x, *y, *z]).collect();
    let surface = BsplineSurface::new(surface.u().clone(), surface.v().clone(), points)?;
    Hull::new(hull.name(), *hull.particulars(), surface, hull.deck().clone())
}

/// Half-breadths of the net.
pub(super) fn breadths(hull: &Hull) -> Vec<f64> {
    hull.surface().points().iter().map(|point| point[1]).collect()
}

/// What is free of the net: not keel, stem, stern and deck, not the centreplane, not the flat of side. In a parallel body all is
/// free but stem and stern, and with it the edge of the flat of bottom.
#[derive(Debug, Clone)]
pub(super) struct Freedom {
    /// The number of each point among the free ones.
    pub(super) places: Vec<Option<usize>>,
    /// The free points.
    pub(super) points: Vec<usize>,
}

impl Freedom {
    pub(super) fn of(hull: &Hull, band: Option<&Band>) -> Self {
        let surface = hull.surface();
        let [rows, columns] = surface.shape();
        let breadth = hull.particulars().breadth;
        let slack = AT_LIMIT * breadth;
        let is_free = |k: usize| {
            let (i, j, y) = (k / columns, k % columns, surface.points()[k][1]);
            let end = i == 0 || i + 1 == rows;
            let edge = end || (j == 0 && band.is_none()) || j + 1 == columns;
            let in_band = !end && band.is_some_and(|band| band.holds(i, j));
            in_band || (!edge && y > slack && (y - 0.5 * breadth).abs() > slack)
        };
        let points: Vec<usize> = (0..rows * columns).filter(|k| is_free(*k)).collect();
        let mut places = vec![None; rows * columns];
        points.iter().enumerate().for_each(|(place, &point)| places[point] = Some(place));
        Self { places, points }
    }

    /// A row over the free points.
    pub(super) fn row(&self, row: impl IntoIterator<Item = (usize, f64)>) -> Vec<(usize, f64)> {
        row.into_iter().filter_map(|(k, weight)| Some((self.places[k]?, weight))).filter(|e| e.1 != 0.0).collect()
    }

    /// A dense gradient over the free points.
    pub(super) fn gradient(&self, gradient: &[f64]) -> Vec<f64> {
        self.points.iter().map(|&k| gradient[k]).collect()
    }
}

/// A program over the free points, to which rows are added.
#[derive(Clone)]
pub(super) struct Search<'a> {
    pub(super) start: &'a Hull,
    pub(super) reference: &'a Reference,
    pub(super) targets: &'a [Target],
    pub(super) freedom: Freedom,
    pub(super) candidates: Vec<Candidate>,
    /// Which candidates are in the program.
    taken: Vec<bool>,
    /// The same in the order in which they came into it.
    order: Vec<usize>,
    pub(super) base: Vec<f64>,
    /// Unit of the changes \[m\].
    pub(super) unit: f64,
    form: SparseRows,
    /// The parallel body that is stated, or that the start has.
    band: Option<Band>,
    /// Whether it is stated.
    states_band: bool,
    /// Whether the signs of curvature of the parent are among the candidates.
    keeps_signs: bool,
    /// The wave resistance with its weight [m^2].
    waves: Option<(&'a WaveTerm, f64)>,
    pub(super) programs: usize,
    /// An early iterate of the last program.
    known: Option<Interior>,
}

/// An answer to a program.
pub(super) struct Answer {
    pub(super) y: Vec<f64>,
    pub(super) multipliers: Vec<f64>,
    gap: f64,
    /// Kinds of the limits that were in the program with the sizes of their rows, in the order of their multipliers.
    limits: Vec<(Kind, f64)>,
}

impl<'a> Search<'a> {
    /// With the limits of `parent` on the chart of `start`, and the sections alike between the ends of a parallel body.
    pub(super) fn new(
        parent: &Hull,
        start: &'a Hull,
        reference: &'a Reference,
        targets: &'a [Target],
        body: Option<[f64; 2]>,
    ) -> Self {
        let band = body.and_then(|ends| band(start, reference.draught, ends));
        let freedom = Freedom::of(start, band.as_ref());
        let states_band = body.is_some();
        let band = if states_band { band } else { own_band(start, reference.draught) };
        let bears = |candidate: &Candidate| candidate.row.iter().any(|(k, _)| freedom.places[*k].is_some());
        let candidates: Vec<Candidate> = candidates(parent, start).into_iter().filter(bears).collect();
        let form = form(start, &freedom.places);
        Self {
            start,
            reference,
            targets,
            taken: vec![false; candidates.len()],
            order: Vec::new(),
            candidates,
            freedom,
            base: breadths(start),
            unit: 0.5 * start.particulars().breadth,
            form,
            band,
            states_band,
            keeps_signs: true,
            waves: None,
            programs: 0,
            known: None,
        }
    }

    /// The same for other targets, with no row in the program.
    pub(super) fn with_targets<'b>(&self, targets: &'b [Target]) -> Search<'b>
    where
        'a: 'b,
    {
        let mut search: Search<'b> = self.clone();
        search.targets = targets;
        search.take_none();
        search
    }

    /// The equations of the targets, then those of the parallel body.
    pub(super) fn equations(&self, hull: &Hull) -> Vec<Equation> {
        let targets = self.targets.iter().map(|target| equation(target.quantity, target.value, hull, self.reference));
        let [columns, points] = [hull.surface().shape()[1], hull.surface().points().len()];
        let is_free = |k: usize| self.freedom.places[k].is_some();
        let pairs = self.band.iter().flat_map(|band| band.pairs(columns));
        let pairs = pairs.filter(|[a, b]| is_free(*a) || is_free(*b));
        let alike = pairs.map(|[a, b]| {
            let mut gradient = vec![0.0; points];
            (gradient[a], gradient[b]) = (-1.0 / self.unit, 1.0 / self.unit);
            let rise = hull.surface().points()[b][1] - hull.surface().points()[a][1];
            Equation { residual: rise / self.unit, gradient }
        });
        targets.chain(alike).collect()
    }

    /// The program: equations hold at `at` by their tangents there; `towards` replaces the bending by a linear objective.
    pub(super) fn problem(&self, equations: &[Equation], at: &[f64], towards: Option<&[f64]>) -> Problem {
        let n = self.freedom.points.len();
        let (mut rows, mut lower, mut upper) = (SparseRows::new(n), Vec::new(), Vec::new());
        for equation in equations {
            let gradient = self.freedom.gradient(&equation.gradient);
            let moved: f64 = self.freedom.points.iter().zip(&gradient).map(|(&k, g)| g * (at[k] - self.base[k])).sum();
            rows.push(gradient.iter().enumerate().map(|(k, g)| (k, g * self.unit)).filter(|e| e.1 != 0.0));
            lower.push(moved - equation.residual);
            upper.push(moved - equation.residual);
        }
        for candidate in self.in_program() {
            let (row, size) = self.limit(candidate);
            rows.push(row.iter().map(|(k, w)| (*k, w * self.unit / size)));
            // A start that misses a row is held to what it has at most.
            lower.push((candidate.lower - candidate.value(&self.base)) / size);
            upper.push(f64::INFINITY);
        }
        let no_squares = SparseRows::new(n);
        let (quadratic, linear, squares) = match (towards, self.waves) {
            (Some(row), _) => (SparseRows::from_entries(n, n, &[]), row.to_vec(), no_squares),
            (None, None) => (self.form.clone(), vec![0.0; n], no_squares),
            // J + w R over the square of the unit.
            (None, Some((term, weight))) => {
                let places: Vec<usize> = (0..n).collect();
                let slopes = term.gradient.iter().map(|g| weight * g / self.unit).collect();
                (self.form.clone(), slopes, term.squares(n, &places, weight))
            }
        };
        Problem { quadratic, linear, squares, rows, lower, upper }
    }

    /// The limits that are in the program.
    fn in_program(&self) -> impl Iterator<Item = &Candidate> {
        self.order.iter().map(|&k| &self.candidates[k])
    }

    /// The row of a limit over the free points, and its size.
    fn limit(&self, candidate: &Candidate) -> (Vec<(usize, f64)>, f64) {
        let row = self.freedom.row(candidate.row.iter().copied());
        let size = row.iter().map(|(_, w)| w.abs()).fold(0.0, f64::max).max(1e-300) * self.unit;
        (row, size)
    }

    /// J of half-breadths [m^2].
    fn bending(&self, y: &[f64]) -> f64 {
        let change: Vec<f64> = self.freedom.points.iter().map(|&k| y[k] - self.base[k]).collect();
        0.5 * self.form.apply(&change).iter().zip(&change).map(|(a, b)| a * b).sum::<f64>()
    }

    /// With a weight of the wave resistance besides.
    pub(super) fn with_waves(&mut self, term: &'a WaveTerm, weight: f64) {
        self.waves = Some((term, weight));
    }

    /// With half-breadths that stay so near to the start \[m\].
    pub(super) fn within(&mut self, most: f64) {
        let slack = AT_LIMIT * self.unit;
        let base = self.base.clone();
        let free = self.freedom.points.clone();
        let rows = free.iter().flat_map(|&k| [1.0, -1.0].map(|way| (k, way)));
        let candidates = rows.map(|(k, way)| Candidate {
            kind: Kind::Tolerance,
            row: vec![(k, way)],
            lower: way * base[k] - most,
            slack,
        });
        self.candidates.extend(candidates);
        self.taken.resize(self.candidates.len(), false);
    }

    /// Solves, and takes missed rows in until none is. A round starts from an early iterate of the one before.
    fn solve(&mut self, equations: &[Equation], at: &[f64]) -> Result<Answer, Failed> {
        for _ in 0..ROUNDS {
            let problem = self.problem(equations, at, None);
            let known = self.known.take().filter(|known| known.rows.len() == problem.lower.len());
            let solution = solved(&problem, known.as_ref(), ITERATIONS)?;
            self.programs += 1;
            let y = self.moved(&solution.x);
            let limits: Vec<(Kind, f64)> =
                self.in_program().map(|candidate| (candidate.kind, self.limit(candidate).1)).collect();
            let added = self.take_missed(&y);
            self.known = solution.interior;
            if added == 0 {
                let certificate = problem.certificate(&solution.x, &solution.multipliers, 0.0);
                let gap = (certificate.primal - certificate.dual).abs() / certificate.primal.abs().max(LEAST_OPTIMUM);
                return Ok(Answer { y, multipliers: solution.multipliers, gap, limits });
            }
            self.known.iter_mut().for_each(|known| known.rows.extend(std::iter::repeat_n(None, added)));
        }
        Err(Failed::Infeasible)
    }

    /// Half-breadths after changes of the free points, in units.
    pub(super) fn moved(&self, changes: &[f64]) -> Vec<f64> {
        let mut y = self.base.clone();
        self.freedom.points.iter().zip(changes).for_each(|(&k, c)| y[k] += self.unit * c);
        y
    }

    /// Takes every row into the program.
    pub(super) fn take_all(&mut self) {
        self.known = None;
        self.order.extend((0..self.candidates.len()).filter(|k| !self.taken[*k]));
        self.taken.fill(true);
    }

    /// Takes no row into the program.
    pub(super) fn take_none(&mut self) {
        self.known = None;
        self.order.clear();
        self.taken = vec![false; self.candidates.len()];
    }

    /// Takes the most missed rows into the program; how many.
    fn take_missed(&mut self, y: &[f64]) -> usize {
        let miss = |candidate: &Candidate| (candidate.lower - candidate.value(y)) / candidate.slack;
        let open = self.candidates.iter().enumerate().filter(|(k, c)| !self.taken[*k] && c.is_missed(y));
        let mut missed: Vec<(f64, usize)> = open.map(|(k, candidate)| (miss(candidate), k)).collect();
        missed.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
        missed.truncate(LEAST_ADDED);
        missed.iter().for_each(|(_, k)| self.taken[*k] = true);
        self.order.extend(missed.iter().map(|(_, k)| *k));
        missed.len()
    }

    /// Corrects what the equations are off by with the least change of points that stand off the centreplane.
    fn correct(&self, mut y: Vec<f64>) -> Result<(Vec<f64>, f64), Failed> {
        let off = |equations: &[Equation]| equations.iter().map(|e| e.residual.abs()).fold(0.0, f64::max);
        if let Some(band) = self.band.as_ref().filter(|_| self.states_band) {
            band.level(&mut y, self.start.surface().shape()[1]);
        }
        let mut best = (y.clone(), f64::INFINITY);
        for _ in 0..=CORRECTIONS {
            let hull = with_breadths(self.start, &y).map_err(Failed::Hull)?;
            let equations = self.equations(&hull);
            if off(&equations) < best.1 {
                best = (y.clone(), off(&equations));
            }
            if off(&equations) <= HELD {
                break;
            }
            let loose: Vec<usize> = self.freedom.points.iter().copied().filter(|&k| y[k] > 1e-4 * self.unit).collect();
            let bears = |equation: &Equation| loose.iter().any(|&k| equation.gradient[k].abs() > 0.0);
            let equations: Vec<Equation> = equations.into_iter().filter(bears).collect();
            let rows = DMatrix::from_fn(equations.len(), loose.len(), |k, i| equations[k].gradient[loose[i]]);
            let normal = &rows * rows.transpose();
            let residuals = DVector::from_iterator(equations.len(), equations.iter().map(|e| -e.residual));
            let Some(factor) = normal.cholesky() else { break };
            let change = rows.transpose() * factor.solve(&residuals);
            loose.iter().zip(change.iter()).for_each(|(&k, c)| y[k] += c);
        }
        Ok(best)
    }

    /// The nearest hull.
    pub(super) fn run(&mut self) -> Result<Nearest, Failed> {
        let mut hull = self.start.clone();
        let mut at = self.base.clone();
        let mut last = None;
        let mut error = f64::INFINITY;
        for _ in 0..TANGENTS {
            let equations = self.equations(&hull);
            error = equations.iter().map(|e| e.residual.abs()).fold(0.0, f64::max);
            let keeps = self.candidates.iter().all(|candidate| !candidate.is_missed(&at));
            if error <= CORRECTED && (last.is_some() || (keeps && self.waves.is_none())) {
                break;
            }
            let answer = self.solve(&equations, &at)?;
            at.clone_from(&answer.y);
            hull = with_breadths(self.start, &at).map_err(Failed::Hull)?;
            last = Some(answer);
        }
        if error > CORRECTED {
            let now = self.equations(&hull).iter().map(|e| e.residual.abs()).fold(0.0, f64::max);
            if now > CORRECTED {
                return Err(Failed::Astray(now));
            }
        }
        let (y, left) = self.correct(at)?;
        if left > 1e-10 {
            return Err(Failed::Astray(left));
        }
        let prices = last.as_ref().map_or(vec![0.0; self.targets.len()], |answer| self.prices(answer));
        let binding = last.as_ref().map_or(Vec::new(), |answer| self.binding(answer));
        Ok(Nearest {
            hull: with_breadths(self.start, &y).map_err(Failed::Hull)?,
            prices,
            energy: self.bending(&y),
            gap: last.as_ref().map_or(0.0, |answer| answer.gap),
            binding,
            programs: self.programs,
        })
    }

    /// Derivatives of the optimum by the targets: of rows g.c = r the multiplier z is -dJ/dr.
    fn prices(&self, answer: &Answer) -> Vec<f64> {
        let square = self.unit * self.unit;
        answer.multipliers[..self.targets.len()].iter().map(|z| -z * square).collect()
    }

    /// The limits that bind, by kind.
    fn binding(&self, answer: &Answer) -> Vec<BindingLimits> {
        let multipliers = &answer.multipliers[answer.multipliers.len() - answer.limits.len()..];
        let of_kind = |kind: Kind| {
            let bind = answer.limits.iter().zip(multipliers).filter(|((k, _), z)| *k == kind && z.abs() > BINDS);
            let (mut count, mut price) = (0, 0.0);
            for ((_, size), z) in bind {
                count += 1;
                price -= z.abs() * self.unit * self.unit / size;
            }
            BindingLimits { kind: kind.word(), count, price }
        };
        Kind::ALL.map(of_kind).into_iter().filter(|limits| limits.count > 0).collect()
    }

    /// Leaves the parallel body of the start out; false where it has none, or it is stated.
    pub(super) fn without_own_body(&mut self) -> bool {
        self.known = None;
        !self.states_band && self.band.take().is_some()
    }

    /// Whether signs of curvature are among the limits.
    pub(super) fn has_signs(&self) -> bool {
        self.keeps_signs
    }

    /// Leaves the signs of curvature out.
    pub(super) fn without_signs(&mut self) {
        self.candidates.retain(|candidate| candidate.kind != Kind::Sign);
        self.keeps_signs = false;
        self.take_none();
    }
}
