//! A primal-dual interior point for programs whose rows are local but for a few dense ones.
//!
//! Every two-sided row has one value t between its limits and two slacks:
//!
//! ```text
//! minimise 1/2 x'P x + q'x,   A x = t,   s_u = u - t > 0,   s_l = t - l > 0
//! ```
//!
//! (an equality has t = u = l). With multipliers z = z_u - z_l the conditions of optimality are
//!
//! ```text
//! P x + q + A'z = 0,   A x = t,   s_u z_u = s_l z_l = 0,   z_u, z_l >= 0
//! ```
//!
//! and the iteration follows the points where the products equal a falling mu. With residuals r_d = P x + q + A'z,
//! r_p = t - A x and targets tau of the products, Newton's equations give, row by row,
//!
//! ```text
//! dt = A dx - r_p,   dz = gamma + W dt,   W = z_u/s_u + z_l/s_l,   gamma = (tau_u/s_u - z_u) - (tau_l/s_l - z_l)
//! P dx + A'dz = -r_d,   A dx - dz/W = r_p - gamma/W
//! ```
//!
//! Elimination of dz leaves the normal matrix N = P + A'WA. Bands and differences of a tensor-product net keep N in the
//! pattern of P; the dense rows (volume, moments) stay outside and are served by a Schur complement ([`schur`]), so
//! that N stays sparse. N is factored by supernodal Cholesky in an order of minimum degree ([`normal`], [`factor`])
//! once an iteration, and refinement removes what its regularisation changed ([`newton`]).
//!
//! An iteration ([`interior`]): the predictor aims at tau = 0 and shows how far it may go; mu falls by the cube of what
//! it leaves (Mehrotra 1992), its second-order term ds dz corrects tau, and further correctors pull stray products back
//! towards mu as long as they lengthen the step (Gondzio 1996). P keeps primal and dual steps equal; a linear program
//! has two. Beyond the tolerance it goes on while the duality gap still falls. The start is a soft least-squares fit, with
//! slacks and multipliers near the solution, and where that stalls far inside ([`start`]). It may come from a similar
//! problem ([`Interior`]). Where limits alone have changed, a later solve of a [`Solver`] starts from the rows that bound the
//! last solution ([`active`]). Others start from the iterate their predecessor had before it neared the boundary. Where the
//! iteration stalls two auxiliary programs look for a proof that there is no solution ([`phase`]).

mod active;
mod factor;
mod interior;
mod newton;
mod normal;
mod phase;
mod point;
mod scaled;
mod schur;
mod start;

use super::problem::{Interior, Problem, ProblemError, Progress, Settings, Solution, Status};
use active::Binding;
use interior::End;
use newton::Newton;
use point::Iterate;
use scaled::Scaled;

/// A solver that keeps orderings, patterns and the last solution over changes of the numbers.
pub struct Solver {
    /// The problem over its unknowns and those of its squares ([`Problem::lifted`]).
    problem: Problem,
    /// Unknowns and rows of the problem that was asked.
    shape: [usize; 2],
    settings: Settings,
    scaled: Scaled,
    newton: Newton,
    kept: Option<Iterate>,
    /// The rows that bound the last solution, as long as limits alone have changed since.
    bound: Option<Vec<Binding>>,
    auxiliary: bool,
}

/// Multipliers that exclude feasible points within this radius count as a Farkas proof.
const RADIUS: f64 = 1e7;
/// A warm start that takes longer was none.
const WARM: usize = 30;
/// The largest defect of a ray.
const DEFECT: f64 = 1e-8;

impl Solver {
    /// Orders and analyses.
    ///
    /// # Errors
    /// [`ProblemError`] when shapes or numbers are wrong.
    pub fn new(problem: &Problem, settings: &Settings) -> Result<Self, ProblemError> {
        problem.check()?;
        let shape = [problem.linear.len(), problem.rows.row_count()];
        let problem = problem.lifted();
        let scaled = Scaled::new(&problem);
        let newton = Newton::new(&scaled);
        Ok(Self {
            problem,
            shape,
            settings: settings.clone(),
            scaled,
            newton,
            kept: None,
            bound: None,
            auxiliary: false,
        })
    }

    /// Takes other numbers with the same pattern: orderings, the symbolic factorisation and the warm start stay.
    ///
    /// # Errors
    /// [`ProblemError`] when shapes, patterns or numbers are wrong; the solver then keeps the old ones.
    pub fn update(&mut self, problem: &Problem) -> Result<(), ProblemError> {
        problem.check()?;
        let shape = [problem.linear.len(), problem.rows.row_count()];
        let problem = problem.lifted();
        let same = shape == self.shape
            && self.problem.quadratic.same_pattern(&problem.quadratic)
            && self.problem.rows.same_pattern(&problem.rows);
        if !same {
            return Err(ProblemError::Pattern);
        }
        let limits_alone = self.problem.quadratic == problem.quadratic
            && self.problem.linear == problem.linear
            && self.problem.rows == problem.rows;
        if !limits_alone {
            self.bound = None;
        }
        self.scaled.load(&problem);
        self.problem = problem;
        Ok(())
    }

    /// Forgets the last solution: the next solve starts cold.
    pub fn forget(&mut self) {
        self.kept = None;
        self.bound = None;
    }

    /// Starts the next solve from a point of a similar problem.
    ///
    /// # Errors
    /// [`ProblemError::Shape`] when it has other numbers of variables or rows.
    pub fn start_from(&mut self, start: &Interior) -> Result<(), ProblemError> {
        let [n, m] = self.shape;
        let shapes = [("the start", start.x.len(), n), ("the rows of the start", start.rows.len(), m)];
        if let Some(&(what, found, expected)) = shapes.iter().find(|(_, found, expected)| found != expected) {
            return Err(ProblemError::Shape { what, found, expected });
        }
        self.bound = None;
        self.kept = Some(start::like(&self.scaled, &self.problem.lifted_point(start)));
        Ok(())
    }

    /// Solves; a solve after the first starts from the rows that bound the last where limits alone have changed, else,
    /// and where that comes to nothing, from an iterate of the last.
    pub fn solve(&mut self) -> Solution {
        let mut solution = self.solve_lifted();
        let [n, m] = self.shape;
        solution.x.truncate(n);
        solution.multipliers.truncate(m);
        solution.interior = solution.interior.map(|interior| self.asked(interior));
        solution
    }

    /// A point over the unknowns and rows of the problem that was asked.
    fn asked(&self, mut point: Interior) -> Interior {
        let [n, m] = self.shape;
        point.x.truncate(n);
        point.rows.truncate(m);
        point
    }

    /// The solution over the unknowns of the problem and of its squares.
    fn solve_lifted(&mut self) -> Solution {
        let (n, m) = (self.problem.linear.len(), self.problem.rows.row_count());
        let failed = Solution {
            status: Status::Limit,
            x: vec![0.0; n],
            multipliers: vec![0.0; m],
            iterations: 0,
            progress: Vec::new(),
            interior: None,
        };
        let mut progress = Vec::new();
        let newton = &mut self.newton;
        if let Some((point, rounds)) = self.bound.take().and_then(|bound| active::resume(&self.scaled, newton, &bound))
        {
            let residuals = point.residuals(&self.scaled);
            let size = residuals.objective.abs().max(self.scaled.objective_scale);
            let found = Progress {
                primal: residuals.primal_size,
                dual: residuals.dual_size,
                gap: residuals.gap(&point) / size,
            };
            progress.push(found);
            if found.primal.max(found.dual).max(found.gap) <= self.settings.tolerance {
                self.bound = Some(active::bindings(&point));
                return Solution {
                    status: Status::Optimal,
                    x: self.scaled.variables(&point.x),
                    multipliers: self.scaled.multipliers(&point.z),
                    iterations: rounds,
                    progress,
                    interior: None,
                };
            }
        }
        let warm = self.kept.take().map(|kept| start::warm(&self.scaled, &kept));
        let mut outcome = None;
        let mut iterations = 0;
        if let Some(mut point) = warm {
            let settings = Settings { iterations: self.settings.iterations.min(WARM), ..self.settings.clone() };
            let (count, end) =
                interior::iterate(&self.scaled, newton, &mut point, &settings, (&mut self.kept, &mut progress));
            iterations = count;
            outcome = (end == End::Optimal).then_some((point, end));
        }
        for from in start::STARTS {
            if outcome.as_ref().is_some_and(|(_, end)| *end != End::Stalled) {
                break;
            }
            let Some(mut point) = start::cold(&self.scaled, newton, from) else { break };
            let (count, end) =
                interior::iterate(&self.scaled, newton, &mut point, &self.settings, (&mut self.kept, &mut progress));
            iterations += count;
            outcome = Some((point, end));
        }
        let Some((point, end)) = outcome else { return failed };
        let mut solution = Solution {
            status: Status::Limit,
            x: self.scaled.variables(&point.x),
            multipliers: self.scaled.multipliers(&point.z),
            iterations,
            progress,
            interior: self.kept.as_ref().map(|kept| self.scaled.interior(kept)),
        };
        match end {
            End::Optimal => {
                solution.status = Status::Optimal;
                self.bound = Some(active::bindings(&point));
            }
            _ if self.auxiliary => {}
            _ => self.explain(&mut solution),
        }
        solution
    }

    /// Finds the proof that there is no solution, if there is one.
    fn explain(&self, solution: &mut Solution) {
        let problem = &self.problem;
        let reach = solution.x.iter().fold(1.0_f64, |most, value| most.max(value.abs())).min(1e6);
        if problem.infeasible_within(&solution.multipliers) >= RADIUS * reach {
            solution.status = Status::Infeasible;
            return;
        }
        if problem.ray_defect(&solution.x) <= DEFECT {
            solution.status = Status::Unbounded;
            return;
        }
        if !self.settings.proof {
            return;
        }
        let auxiliary = |problem: &Problem| {
            let mut solver = Self::new(problem, &self.settings).ok()?;
            solver.auxiliary = true;
            let answer = solver.solve();
            Some(answer)
        };
        if let Some(answer) = auxiliary(&phase::nearest_feasible(problem)) {
            let multipliers = phase::farkas(problem, &answer.multipliers);
            solution.iterations += answer.iterations;
            if problem.infeasible_within(&multipliers) >= RADIUS {
                solution.status = Status::Infeasible;
                solution.multipliers = multipliers;
                return;
            }
        }
        if let Some(answer) = auxiliary(&phase::steepest_ray(problem)) {
            solution.iterations += answer.iterations;
            if problem.ray_defect(&answer.x) <= DEFECT {
                solution.status = Status::Unbounded;
                solution.x = answer.x;
            }
        }
    }
}

impl Problem {
    /// Solves.
    ///
    /// # Errors
    /// [`ProblemError`] when shapes or numbers are wrong; not solving is a [`Status`].
    pub fn solve(&self, settings: &Settings) -> Result<Solution, ProblemError> {
        Ok(Solver::new(self, settings)?.solve())
    }

    /// Solves from a point of a similar problem.
    ///
    /// # Errors
    /// [`ProblemError`] when shapes or numbers are wrong.
    pub fn solve_from(&self, settings: &Settings, start: Option<&Interior>) -> Result<Solution, ProblemError> {
        let mut solver = Solver::new(self, settings)?;
        if let Some(start) = start {
            solver.start_from(start)?;
        }
        Ok(solver.solve())
    }
}

#[cfg(test)]
mod tests {
    use super::super::sparse::SparseRows;
    use super::*;

    /// The smoothest of n values, by the squares of their second differences, within `band` of others.
    fn smoothest(n: usize, band: f64) -> Problem {
        let mut entries = Vec::new();
        for k in 1..n - 1 {
            let difference = [(k - 1, 1.0), (k, -2.0), (k + 1, 1.0)];
            entries.extend(difference.iter().flat_map(|&(i, a)| difference.map(|(j, b)| (i, j, a * b))));
        }
        let wanted: Vec<f64> =
            (0..n).map(|k| (0.3 * k as f64).sin() + 0.05 * ((k * 7919 % 13) as f64 / 6.0 - 1.0)).collect();
        let mut rows = SparseRows::new(n);
        (0..n).for_each(|k| rows.push([(k, 1.0)]));
        Problem {
            quadratic: SparseRows::from_entries(n, n, &entries),
            linear: vec![0.0; n],
            squares: SparseRows::new(n),
            rows,
            lower: wanted.iter().map(|y| y - band).collect(),
            upper: wanted.iter().map(|y| y + band).collect(),
        }
    }

    fn from(problem: &Problem, from: start::Start) -> (Vec<f64>, usize, End) {
        let scaled = Scaled::new(problem);
        let mut newton = Newton::new(&scaled);
        let mut point = start::cold(&scaled, &mut newton, from).unwrap();
        let (count, end) =
            interior::iterate(&scaled, &mut newton, &mut point, &Settings::default(), (&mut None, &mut Vec::new()));
        (scaled.variables(&point.x), count, end)
    }

    #[test]
    fn all_starts_come_to_the_same_solution() {
        let problem = smoothest(40, 0.03);
        let [near, far] = start::STARTS.map(|start| from(&problem, start));
        assert_eq!((near.2, far.2), (End::Optimal, End::Optimal));
        assert!(near.1 < 25 && far.1 < 35, "{} and {} iterations", near.1, far.1);
        assert!(near.0.iter().zip(&far.0).all(|(a, b)| (a - b).abs() < 1e-8), "{:?} {:?}", near.0, far.0);
    }

    /// The second problem has three rows more, which cut a little off.
    #[test]
    fn a_start_from_a_similar_problem_takes_fewer_iterations() {
        let first = smoothest(400, 0.03);
        let known = first.solve(&Settings::default()).unwrap();
        let mut second = first.clone();
        for k in [100, 200, 300] {
            second.rows.push([(k, 1.0), (k + 1, -1.0)]);
            second.lower.push(f64::NEG_INFINITY);
            second.upper.push(known.x[k] - known.x[k + 1] - 1e-4);
        }
        let cold = second.solve(&Settings::default()).unwrap();
        let mut start = known.interior.unwrap();
        assert!(second.solve_from(&Settings::default(), Some(&start)).is_err());
        start.rows.extend([None; 3]);
        let warm = second.solve_from(&Settings::default(), Some(&start)).unwrap();
        assert_eq!([cold.status, warm.status], [Status::Optimal; 2]);
        assert!(warm.iterations < cold.iterations, "{} of {}", warm.iterations, cold.iterations);
        assert!(warm.x.iter().zip(&cold.x).all(|(a, b)| (a - b).abs() < 1e-8));
    }

    #[test]
    fn an_iteration_that_halves_nothing_ends_long_before_the_most() {
        let mut problem = smoothest(40, 0.03);
        // 1 <= x_3 - x_4 contradicts the bands by 0.9.
        problem.rows.push([(3, 1.0), (4, -1.0)]);
        problem.lower.push(1.0);
        problem.upper.push(f64::INFINITY);
        for start in start::STARTS {
            let (_, count, end) = from(&problem, start);
            assert_ne!(end, End::Optimal);
            assert!(count < 100, "{count} iterations");
        }
        assert_eq!(problem.solve(&Settings::default()).unwrap().status, Status::Infeasible);
    }
}
