//! From model, limits and signs to one convex quadratic program, and back with prices.
//!
//! minimise (1/2) c'(2 N) c - 2 b'c over the free control values, N = A'WA + lambda E, subject to the limits of the
//! constraints, the tolerance of every reading, the signs of curvature and the limits of every control value. The
//! objective is the weighted sum of squares plus lambda times the energy, in square metres, up to a constant.

use super::determined::Determined;
use super::model::{Limit, Model, Reduced, Row};
use super::smoothing::Smoother;
use crate::numeric::SymmetricBand;
use crate::qp::{Certificate, Interior, Problem, ProblemError, Settings, Solution, SparseRows, Status};

/// Part of the greatest entry of a row below which what is left of it over the free control values is rounding. Taken to
/// unit size it would be a limit that nobody set.
const LEFT: f64 = 1e-12;

/// What a row of the program stands for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RowName {
    /// A constraint of the whole hull: its index.
    Constraint(usize),
    /// The tolerance of a reading: its index.
    Tolerance(usize),
    /// A sign of curvature of a curve: its index.
    Sign(usize),
    /// A sign of curvature that a line of the table keeps: its index.
    Bend(usize),
    /// A limit of the half-breadth at a point of the surface: its index.
    Breadth(usize),
    /// A limit of what the surface moves between the offsets: its index.
    Between(usize),
    /// One of the rows of a rule for a line or a region: the index of the rule.
    Rule(usize),
}

/// Everything that is wished.
#[derive(Debug, Clone, Default)]
pub struct Wishes {
    /// Constraints of the whole hull.
    pub constraints: Vec<Limit>,
    /// Limits of half-breadths.
    pub breadths: Vec<Limit>,
    /// Limits of what the surface moves between the offsets: with the tolerance that widens \[m\] and the room that
    /// does not \[m\].
    pub between: Vec<Between>,
    /// Signs of curvature that single lines keep.
    pub bends: Vec<Limit>,
    /// Rows of rules, with the index of the rule.
    pub rules: Vec<(usize, Limit)>,
    /// Multiplies every tolerance.
    pub widening: f64,
}

/// |a y - d| <= tolerance times widening + room.
#[derive(Debug, Clone, PartialEq)]
pub struct Between {
    /// The row a over the net.
    pub row: Vec<(usize, f64)>,
    /// d \[m\].
    pub value: f64,
    /// Tolerance \[m\].
    pub tolerance: f64,
    /// Room besides \[m\].
    pub room: f64,
}

/// A program ready to be solved.
#[derive(Debug, Clone)]
pub struct Program {
    /// The problem over the free control values.
    pub problem: Problem,
    /// What each row stands for.
    pub names: Vec<RowName>,
    /// Tolerance of each row \[m\]: what either limit gives for a widening by one.
    pub tolerances: Vec<f64>,
    /// Rows that equalities of rules decide, within their limits.
    decided: Vec<Wanted>,
}

/// A row over the free control values.
#[derive(Debug, Clone)]
struct Wanted {
    name: RowName,
    row: Row,
    tolerance: f64,
    limits: [f64; 2],
}

/// A solved program.
#[derive(Debug, Clone)]
pub struct Solved {
    /// How it ended, x and multipliers.
    pub solution: Solution,
    /// Bound and residuals computed outside the solver.
    pub certificate: Certificate,
    /// All control values \[m\].
    pub net: Vec<f64>,
    /// sum w r^2 + lambda c'E c \[m^2\].
    pub objective: f64,
}

/// Both triangles of a band as rows.
pub(super) fn symmetric(band: &SymmetricBand, factor: f64) -> SparseRows {
    let (n, w) = (band.size(), band.width());
    let mut rows = SparseRows::new(n);
    for i in 0..n {
        let columns = i.saturating_sub(w)..=(i + w).min(n.saturating_sub(1));
        rows.push(columns.map(|j| (j, factor * band.get(i, j))).filter(|&(j, value)| value != 0.0 || j == i));
    }
    rows
}

impl Program {
    /// Assembles the program.
    #[must_use]
    pub fn new(
        model: &Model,
        smoother: &Smoother,
        lambda: f64,
        wishes: &Wishes,
        signs: Option<(&[Row], &[i8])>,
    ) -> Self {
        let (normal, right) = smoother.normal(lambda);
        let n = right.len();
        let problem = Problem {
            quadratic: symmetric(&normal, 2.0),
            linear: right.iter().map(|b| -2.0 * b).collect(),
            squares: SparseRows::new(n),
            rows: SparseRows::new(n),
            lower: Vec::new(),
            upper: Vec::new(),
        };
        let reduced = &smoother.reduced;
        let mut wanted: Vec<Wanted> = Vec::new();
        let mut add = |name: RowName, row: &[(usize, f64)], lower: f64, upper: f64, tolerance: f64| {
            let size = row.iter().map(|(_, value)| value.abs()).fold(0.0, f64::max);
            let (row, offset) = reduced.row(row);
            // What known control values leave of a row is rounding.
            let counts = row.iter().any(|(_, value)| value.abs() >= LEFT * size);
            // A target so far away that its row vanishes beside it still cannot be met.
            let beyond = matches!(name, RowName::Constraint(_)) && (lower - offset > 1e-6 || upper - offset < -1e-6);
            let row = if counts { row } else { row.into_iter().map(|(i, _)| (i, 0.0)).collect() };
            if counts || beyond {
                wanted.push(Wanted { name, row, tolerance, limits: [lower - offset, upper - offset] });
            }
        };
        for (k, limit) in &wishes.rules {
            add(RowName::Rule(*k), &limit.row, limit.lower, limit.upper, 0.0);
        }
        for (k, limit) in wishes.constraints.iter().enumerate() {
            add(RowName::Constraint(k), &limit.row, limit.lower, limit.upper, 0.0);
        }
        for (k, reading) in model.readings.iter().enumerate() {
            if let Some(tolerance) = reading.tolerance.filter(|_| reading.weight > 0.0) {
                let band = tolerance * wishes.widening;
                add(RowName::Tolerance(k), &reading.row, reading.value - band, reading.value + band, tolerance);
            }
        }
        let signs = signs.into_iter().flat_map(|(rows, imposed)| rows.iter().zip(imposed));
        for (k, (row, &sign)) in signs.enumerate() {
            let limits = match sign {
                0 => continue,
                1.. => (0.0, f64::INFINITY),
                _ => (f64::NEG_INFINITY, 0.0),
            };
            add(RowName::Sign(k), row, limits.0, limits.1, 0.0);
        }
        for (k, limit) in wishes.bends.iter().enumerate() {
            add(RowName::Bend(k), &limit.row, limit.lower, limit.upper, 0.0);
        }
        for (k, limit) in wishes.breadths.iter().enumerate() {
            add(RowName::Breadth(k), &limit.row, limit.lower, limit.upper, 0.0);
        }
        for (k, limit) in wishes.between.iter().enumerate() {
            let band = limit.tolerance * wishes.widening + limit.room;
            add(RowName::Between(k), &limit.row, limit.value - band, limit.value + band, limit.tolerance);
        }
        Self::assembled(problem, wanted)
    }

    /// The program with what is wanted, less the rows that equalities of rules decide already.
    fn assembled(mut problem: Problem, wanted: Vec<Wanted>) -> Self {
        let n = problem.linear.len();
        problem.rows = SparseRows::new(n);
        (problem.lower, problem.upper) = (Vec::new(), Vec::new());
        let equal = |row: &Wanted| {
            matches!(row.name, RowName::Rule(_) | RowName::Tolerance(_)) && row.limits[0] >= row.limits[1]
        };
        let mut known = Determined::new(n);
        let mut follows = vec![false; wanted.len()];
        // Rules make equalities that follow from each other (lines that cross, flats), and offsets that are locked leave limits
        // at them no room.
        if wanted.iter().any(|row| matches!(row.name, RowName::Rule(_)) || equal(row)) {
            for single in [true, false] {
                for (row, follows) in wanted.iter().zip(&mut follows) {
                    if equal(row) && (row.row.len() == 1) == single {
                        *follows = !known.take(&row.row, row.limits[0]);
                    }
                }
            }
        }
        let ruled = !known.is_empty();
        let (mut names, mut tolerances, mut decided) = (Vec::new(), Vec::new(), Vec::new());
        for (row, follows) in wanted.into_iter().zip(follows) {
            // What a fixed line does beyond 0 or B/2 between the offsets, by which its spline passes them, stays.
            let limits = if matches!(row.name, RowName::Breadth(_) | RowName::Between(_)) {
                [f64::NEG_INFINITY, f64::INFINITY]
            } else {
                row.limits
            };
            if follows || ruled && !equal(&row) && known.decides(&row.row, limits) {
                decided.push(row);
                continue;
            }
            problem.rows.push(row.row);
            problem.lower.push(row.limits[0]);
            problem.upper.push(row.limits[1]);
            names.push(row.name);
            tolerances.push(row.tolerance);
        }
        Self { problem, names, tolerances, decided }
    }

    /// The program without the rows of these names, and with what they alone decided.
    #[must_use]
    pub fn without(&self, these: impl Fn(RowName) -> bool) -> Self {
        let rows = self.names.iter().enumerate().map(|(k, &name)| {
            let row = self.problem.rows.entries(k).collect();
            Wanted { name, row, tolerance: self.tolerances[k], limits: [self.problem.lower[k], self.problem.upper[k]] }
        });
        let all = rows.chain(self.decided.iter().cloned()).filter(|row| !these(row.name));
        Self::assembled(self.problem.clone(), all.collect())
    }

    /// The same program with other limits in the place of the rows of these names.
    #[must_use]
    pub fn with_rows(&self, changed: &[(RowName, Limit)], reduced: &Reduced) -> Self {
        let mut program = self.clone();
        program.problem.rows = SparseRows::new(self.problem.rows.column_count());
        for (k, name) in self.names.iter().enumerate() {
            if let Some((_, limit)) = changed.iter().find(|(other, _)| other == name) {
                let (row, offset) = reduced.row(&limit.row);
                program.problem.rows.push(row);
                program.problem.lower[k] = limit.lower - offset;
                program.problem.upper[k] = limit.upper - offset;
            } else {
                program.problem.rows.push(self.problem.rows.entries(k));
            }
        }
        program
    }

    /// The program with more signs of curvature, and the number of the first of them.
    #[must_use]
    pub fn with_bends(&self, limits: &[Limit], reduced: &Reduced) -> (Self, usize) {
        let number = |name: &RowName| match name {
            RowName::Bend(k) => Some(*k),
            _ => None,
        };
        let first = self.names.iter().filter_map(number).max().map_or(0, |last| last + 1);
        let mut program = self.clone();
        for (k, limit) in limits.iter().enumerate() {
            let (row, offset) = reduced.row(&limit.row);
            program.problem.rows.push(row);
            program.problem.lower.push(limit.lower - offset);
            program.problem.upper.push(limit.upper - offset);
            program.names.push(RowName::Bend(first + k));
            program.tolerances.push(0.0);
        }
        (program, first)
    }

    /// Solves, and judges the answer.
    ///
    /// # Errors
    /// [`ProblemError`] when the numbers make no problem.
    pub fn solve(&self, smoother: &Smoother, lambda: f64, settings: &Settings) -> Result<Solved, ProblemError> {
        self.solve_from(smoother, lambda, settings, None)
    }

    /// The same from a point of a similar program.
    ///
    /// # Errors
    /// [`ProblemError`] when the numbers make no problem.
    pub fn solve_from(
        &self,
        smoother: &Smoother,
        lambda: f64,
        settings: &Settings,
        start: Option<&Interior>,
    ) -> Result<Solved, ProblemError> {
        Ok(self.judged(self.problem.solve_from(settings, start)?, smoother, lambda))
    }

    /// An answer with what can be known of it without the solver.
    pub(super) fn judged(&self, solution: Solution, smoother: &Smoother, lambda: f64) -> Solved {
        let certificate = self.problem.certificate(&solution.x, &solution.multipliers, 0.0);
        let net = smoother.reduced.expand(&solution.x);
        let objective = smoother.objective(lambda, &solution.x);
        Solved { solution, certificate, net, objective }
    }
}

impl Solved {
    /// Whether the optimum was found.
    #[must_use]
    pub fn is_optimal(&self) -> bool {
        self.solution.status == Status::Optimal
    }
}
