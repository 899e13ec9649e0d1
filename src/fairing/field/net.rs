//! The net of a half-breadth field over the unit square and its energy.
//!
//! The energy is of order n = 4, over parameters counted in intervals of the table, s = N u and t = M v.
//!
//! ```text
//! E = int int sum_k g_k C(n, k) a^(1-2k) (d^n y / ds^(n-k) dt^k)^2 ds dt = c'P(a, g) c
//! ```
//!
//! Here a is the anisotropy; g_k is 1 for k = 0 and n, and g for the mixed derivatives. The kernel of E are the polynomials
//! in u and v of total degree n - 1. A hull whose half-breadth is a product, as Wigley's, has mixed derivatives alone: a
//! small g leaves it nearly free.
//!
//! Across a break v = constant the derivatives by v from some order r on may jump. The energy has their jumps J_k.
//!
//! ```text
//! h int sum_(k = r)^3 (J_k / M^k)^2 ds
//! ```
//!
//! With the charge h a break is a prior of its own, and adds nothing to the kernel.

use super::density::Density;
use crate::numeric::{SingularMatrix, SymmetricBand};
use crate::spline::{Collocation, Gram, KnotVector, SplineError, binomial};
use nalgebra::DMatrix;

/// Order of the energy.
pub const ORDER: usize = 4;

/// Degree of the net.
pub const DEGREE: usize = 5;

/// Polynomials of the kernel.
pub const KERNEL: usize = ORDER * (ORDER + 1) / 2;

/// Lines of the net nearer to each other than this part of a span are one.
pub const CLOSE: f64 = 0.4;

/// Parts of its diagonal that are added to P where rounding makes it indefinite, the least that suffices.
const ROUNDING: [f64; 3] = [1e-15, 1e-14, 1e-13];

/// A symmetric matrix over the functions along v: of each one the entries with it and with those after it.
pub(super) type Strip = Vec<[f64; DEGREE + 1]>;

/// A line v = constant of a net across which derivatives may jump.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Break {
    /// v on it.
    pub at: f64,
    /// The least order of the derivatives that jump: 1 for a knuckle, 2 for a tangent line.
    pub order: usize,
    /// h: what a jump of one is charged.
    pub charge: f64,
}

impl Break {
    /// Multiplicity of its knot.
    #[must_use]
    pub fn multiplicity(&self) -> usize {
        DEGREE + 1 - self.order
    }

    /// What the derivatives jump by across it, order by order, in the functions of `knots` from the first on that has any.
    #[must_use]
    pub fn jumps(&self, knots: &KnotVector) -> (usize, Vec<Vec<f64>>) {
        let above = knots.find_span(self.at);
        let below = above - self.multiplicity();
        let sides = [below, above].map(|span| knots.basis_derivatives::<ORDER>(span, self.at));
        let row = |order: usize| {
            let mut row = vec![0.0; DEGREE + 1 + self.multiplicity()];
            for k in 0..=DEGREE {
                row[k] -= sides[0][order][k];
                row[self.multiplicity() + k] += sides[1][order][k];
            }
            row
        };
        (below - DEGREE, (self.order..ORDER).map(row).collect())
    }
}

/// Uniform knots of so many spans with these breaks.
fn broken_knots(spans: usize, breaks: &[Break]) -> Result<KnotVector, SplineError> {
    let spacing = 1.0 / spans.max(1) as f64;
    let far = |t: f64| breaks.iter().all(|b| (b.at - t).abs() >= CLOSE * spacing);
    let mut lines: Vec<(f64, usize)> = (0..=spans)
        .map(|k| k as f64 * spacing)
        .filter(|&t| t <= 0.0 || t >= 1.0 - 1e-12 || far(t))
        .map(|t| (t.min(1.0), 1))
        .collect();
    lines.extend(breaks.iter().map(|b| (b.at, b.multiplicity())));
    lines.sort_by(|a, b| a.0.total_cmp(&b.0));
    let (places, times): (Vec<f64>, Vec<usize>) = lines.into_iter().unzip();
    KnotVector::from_breakpoints(DEGREE, &places, &times[1..times.len() - 1])
}

/// What the derivatives of order 4 weigh.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Metric {
    /// Anisotropy a.
    pub anisotropy: f64,
    /// Factor g of the mixed derivatives.
    pub mixed: f64,
}

impl Metric {
    /// a^(1-2k), times g where both parameters are derived by.
    #[must_use]
    pub fn factor(self, k: usize) -> f64 {
        let mixed = if (1..ORDER).contains(&k) { self.mixed } else { 1.0 };
        mixed * self.anisotropy.powi(1 - 2 * k as i32)
    }
}

/// A tensor-product net over the unit square, numbered v fastest, with the parts of its energy.
#[derive(Debug, Clone)]
pub struct Net {
    /// Knots along u and v.
    pub knots: [KnotVector; 2],
    /// Intervals that a parameter is counted in.
    pub intervals: [f64; 2],
    /// Lines across which it may break.
    pub breaks: Vec<Break>,
    /// Diagonals below the main one of its energy.
    width: usize,
    /// Integrals of products of derivatives by u, by their order.
    along: Vec<Gram>,
    /// The same by v.
    up: Vec<Strip>,
    /// Control values that are taken out to make the energy definite.
    grounded: Vec<usize>,
    /// The logarithm of the square of the determinant of the kernel's functions at these.
    grounding: f64,
}

impl Net {
    /// The net on the given knots, which have those of the breaks.
    ///
    /// # Errors
    /// [`SplineError`] when the knots do not determine a polynomial.
    pub fn new(knots: [KnotVector; 2], intervals: [f64; 2], breaks: Vec<Break>) -> Result<Self, SplineError> {
        let count = [knots[0].basis_count(), knots[1].basis_count()];
        let most = breaks.iter().map(Break::multiplicity).max().unwrap_or(0);
        let width = DEGREE.min(count[0] - 1) * count[1] + (DEGREE + most).min(count[1] - 1);
        let gram = |k: usize, order: usize| Gram::new(&knots[k], &knots[k], [order, order]);
        let along = (0..=ORDER).map(|order| gram(0, order)).collect();
        let strip = |order: usize| {
            let gram = gram(1, order);
            (0..count[1]).map(|l| std::array::from_fn(|t| gram.get(l, l + t))).collect()
        };
        let up = (0..=ORDER).map(strip).collect();
        let spread = |k: usize, j: usize| j * (count[k] - 1) / (ORDER - 1);
        let pairs: Vec<[usize; 2]> = (0..ORDER).flat_map(|i| (0..ORDER - i).map(move |j| [i, j])).collect();
        let powers = [powers(&knots[0])?, powers(&knots[1])?];
        let places: Vec<[usize; 2]> = pairs.iter().map(|&[i, j]| [spread(0, i), spread(1, j)]).collect();
        let functions = DMatrix::from_fn(KERNEL, KERNEL, |row, column| {
            let ([i, j], [p, q]) = (places[row], pairs[column]);
            powers[0][p][i] * powers[1][q][j]
        });
        let grounding = 2.0 * functions.lu().determinant().abs().max(f64::MIN_POSITIVE).ln();
        let grounded = places.iter().map(|[i, j]| i * count[1] + j).collect();
        Ok(Self { knots, intervals, breaks, width, along, up, grounded, grounding })
    }

    /// Adds what jumps of a net are charged: its intervals times the integral over the break of their squares.
    fn charge(&self, sum: &mut SymmetricBand) {
        let [rows, columns] = self.shape();
        let gram = &self.along[0];
        for line in &self.breaks {
            let (first, jumps) = line.jumps(&self.knots[1]);
            for (order, jump) in (line.order..).zip(&jumps) {
                let factor = line.charge * self.intervals[0] * self.intervals[1].powi(-2 * order as i32);
                let pairs = jump
                    .iter()
                    .enumerate()
                    .flat_map(|(a, x)| jump.iter().enumerate().map(move |(b, y)| (a, b, factor * x * y)));
                for (a, b, product) in pairs {
                    for (i, k) in (0..rows).flat_map(|i| (i.saturating_sub(DEGREE)..=i).map(move |k| (i, k))) {
                        let (p, q) = (i * columns + first + a, k * columns + first + b);
                        // Each pair once: of the same function along the break both orders are met.
                        if i > k || p >= q {
                            sum.add(p, q, product * gram.get(i, k));
                        }
                    }
                }
            }
        }
    }

    /// Clamped uniform knots of so many spans.
    ///
    /// # Errors
    /// [`SplineError`] without spans.
    pub fn uniform(spans: [usize; 2], intervals: [f64; 2]) -> Result<Self, SplineError> {
        Self::broken(spans, intervals, Vec::new())
    }

    /// The same with breaks; lines of the knots beside them are left out.
    ///
    /// # Errors
    /// [`SplineError`] without spans, or for breaks beside each other.
    pub fn broken(spans: [usize; 2], intervals: [f64; 2], breaks: Vec<Break>) -> Result<Self, SplineError> {
        let [along, up] = [KnotVector::uniform(DEGREE, spans[0])?, broken_knots(spans[1], &breaks)?];
        Self::new([along, up], intervals, breaks)
    }

    /// Numbers of control values along u and v.
    #[must_use]
    pub fn shape(&self) -> [usize; 2] {
        [self.knots[0].basis_count(), self.knots[1].basis_count()]
    }

    /// Number of control values.
    #[must_use]
    pub fn size(&self) -> usize {
        self.shape().iter().product()
    }

    /// Diagonals below the main one of the energy, and of the normal matrix of rows at places.
    #[must_use]
    pub fn energy_width(&self) -> usize {
        self.width
    }

    /// Factors of the squares of the derivatives by u and v, of order 4 - k and k, in the energy.
    #[must_use]
    pub(super) fn factors(&self, metric: Metric) -> [f64; ORDER + 1] {
        let [n, m] = self.intervals;
        std::array::from_fn(|k| {
            let counts = n.powi(1 - 2 * (ORDER - k) as i32) * m.powi(1 - 2 * k as i32);
            binomial(ORDER, k) * metric.factor(k) * counts
        })
    }

    /// P(a, g), with the factor of a density.
    #[must_use]
    pub fn energy(&self, metric: Metric, density: Option<&Density>) -> SymmetricBand {
        let mut all = SymmetricBand::zeros(self.size(), self.width);
        match density {
            Some(density) => density.add_energy(self, metric, &mut all),
            None => self.add_even_energy(metric, &mut all),
        }
        self.charge(&mut all);
        all
    }

    /// The parts of the energy of a field without a density, by the order of the derivative by v and without the factors of
    /// a metric.
    #[must_use]
    pub fn even_energies(&self, values: &[f64]) -> [f64; ORDER + 1] {
        let [rows, columns] = self.shape();
        let plain = self.factors(Metric { anisotropy: 1.0, mixed: 1.0 });
        let (column, lines) =
            (|j: usize| values[j..].iter().step_by(columns).copied().collect::<Vec<f64>>(), 0..columns);
        let columns_of: Vec<Vec<f64>> = lines.map(column).collect();
        std::array::from_fn(|order| {
            let along: Vec<Vec<f64>> = columns_of.iter().map(|line| self.along[ORDER - order].apply(line)).collect();
            let product = |j: usize, l: usize| -> f64 { (0..rows).map(|i| along[j][i] * columns_of[l][i]).sum() };
            let strip = self.up[order].iter().enumerate();
            let energy = |(l, run): (usize, &[f64; DEGREE + 1])| -> f64 {
                let terms = (1..run.len().min(columns - l)).map(|t| 2.0 * run[t] * product(l + t, l));
                run[0] * product(l, l) + terms.sum::<f64>()
            };
            plain[order] * strip.map(energy).sum::<f64>()
        })
    }

    /// Adds the energy without a density, a sum of products of the integrals along u and v.
    fn add_even_energy(&self, metric: Metric, all: &mut SymmetricBand) {
        let ([rows, columns], factors) = (self.shape(), self.factors(metric));
        let mut strip = vec![[0.0; DEGREE + 1]; columns];
        for i in 0..rows {
            for k in i.saturating_sub(DEGREE)..=i {
                strip.fill([0.0; DEGREE + 1]);
                for (order, part) in self.up.iter().enumerate() {
                    let factor = factors[order] * self.along[ORDER - order].get(i, k);
                    for (sum, run) in strip.iter_mut().zip(part) {
                        sum.iter_mut().zip(run).for_each(|(sum, value)| *sum += factor * value);
                    }
                }
                add_block(all, [i, k], &strip);
            }
        }
    }

    /// The logarithm of the product of the eigenvalues of P that are not zero over the determinant of the Gram matrix of the
    /// kernel's functions in control values: that of the determinant of P without the rows and columns of as many control
    /// values as its kernel has functions, over the square of that of the functions there. Eigenvalues below the rounding of P,
    /// of long waves on a net of many spans, are raised to it.
    ///
    /// # Errors
    /// [`SingularMatrix`] when rounding makes it indefinite by more.
    pub fn log_determinant(&self, energy: &SymmetricBand) -> Result<f64, SingularMatrix> {
        let grounded = energy.clone().without(&self.grounded);
        let raised = |part: f64| {
            let mut raised = grounded.clone();
            (0..raised.size()).for_each(|k| raised.add(k, k, part * grounded.get(k, k)));
            raised.factor()
        };
        let known = ROUNDING.iter().fold(grounded.factor(), |known, &part| known.or_else(|_| raised(part)));
        Ok(known?.log_determinant() - self.grounding)
    }

    /// The values of the functions along one direction that are not zero at a place, and the first of them.
    #[must_use]
    pub fn basis(&self, direction: usize, at: f64) -> (usize, [f64; DEGREE + 1]) {
        let knots = &self.knots[direction];
        let span = knots.find_span(at);
        let all = knots.basis(span, at);
        (span - DEGREE, std::array::from_fn(|k| all[k]))
    }

    /// Columns and values of the row that evaluates the net at (u, v), columns rising.
    #[must_use]
    pub fn row(&self, [u, v]: [f64; 2]) -> Vec<(usize, f64)> {
        let ((i, along), (j, up), [_, count]) = (self.basis(0, u), self.basis(1, v), self.shape());
        let entry = |r: usize, s: usize| ((i + r) * count + j + s, along[r] * up[s]);
        (0..=DEGREE).flat_map(|r| (0..=DEGREE).map(move |s| (r, s))).map(|(r, s)| entry(r, s)).collect()
    }
}

/// Adds the symmetric strip to the block of two functions along u, the first not before the second.
pub(super) fn add_block(matrix: &mut SymmetricBand, [i, k]: [usize; 2], strip: &[[f64; DEGREE + 1]]) {
    let columns = strip.len();
    for (l, run) in strip.iter().enumerate() {
        let count = run.len().min(columns - l);
        matrix.add_run(i * columns + l, k * columns + l, &run[..count]);
        if i > k {
            let from = l.saturating_sub(DEGREE);
            let mut before = [0.0; DEGREE];
            (from..l).for_each(|j| before[j - from] = strip[j][l - j]);
            matrix.add_run(i * columns + from, k * columns + l, &before[..l - from]);
        }
    }
}

/// Control values of the powers of 2 t - 1 up to the degree of the kernel.
fn powers(knots: &KnotVector) -> Result<Vec<Vec<f64>>, SplineError> {
    let sites = knots.greville();
    let solver = Collocation::new(knots, &sites)?;
    let power = |k: usize| {
        let mut values: Vec<f64> = sites.iter().map(|t| (2.0 * t - 1.0).powi(k as i32)).collect();
        solver.solve(&mut values);
        values
    };
    Ok((0..ORDER).map(power).collect())
}
