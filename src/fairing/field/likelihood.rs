//! The fair field for a chart and a weight, and how likely the table makes them.
//!
//! Half-breadths y_i at cells are those of a net c, M c, with errors of standard deviation s_i sigma. The field minimises
//! |S^-1 (y - M c)|^2 + w c'Pc, with the energy c'Pc. Let A = I - M (M'M + wP)^-1 M' with rows over S, and let X be the k
//! functions in the kernel of the energy. Then this is the restricted likelihood l (Patterson and Thompson 1971; Wahba
//! 1985).
//!
//! ```text
//! -2 log l = (n - k) log sigma^2 + y'Ay / sigma^2 - log det+ A,   sigma^2 = max(y'Ay / (n - k), least)
//! log det+ A = r log w + log det+ P - log det(M'M + wP) + log det X'X,   r = rank P
//! ```
//!
//! Where lines have errors in common, L b with variance q sigma^2 of each of the m numbers b ([`super::line_errors`]), they
//! are unknowns beside c. This takes the place of y'Ay.
//!
//! ```text
//! |S^-1 (y - M c - L b)|^2 + w c'Pc + b'b / q
//! ```
//!
//! The determinant of both together times q^m takes the place of that of M'M + wP. The band of c is factored first; its Schur
//! complement has order m.
//!
//! A field may pass the centreplane between the offsets of a station by three times sigma, or by [`ALLOWED`] of the breadth.
//! With d more than that it is as unlikely as with a reading there that is off by d: it costs (d / sigma)^2.

use super::chart::Chart;
use super::density::Density;
use super::line_errors::LineErrors;
use super::net::{DEGREE, KERNEL, Metric, Net, ORDER};
use crate::numeric::{BandedCholesky, SingularMatrix, SymmetricBand};
use nalgebra::{Cholesky, DMatrix, DMatrixView, DMatrixViewMut, DVector, Dyn, SymmetricEigen};
use std::collections::HashMap;

/// Candidates of a score test whose systems are solved at once.
const AT_ONCE: usize = 16;

/// An offset on the hull.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cell {
    /// Position \[m\].
    pub x: f64,
    /// Height \[m\].
    pub z: f64,
    /// Half-breadth \[m\].
    pub y: f64,
    /// Standard deviation of its error over that of an error normal to the hull.
    pub scale: f64,
}

/// What a field is made from.
#[derive(Debug, Clone, Default)]
pub struct Readings {
    /// Offsets.
    pub cells: Vec<Cell>,
    /// Places (x, z) \[m\] between the offsets at which the hull is: half-breadths are not negative there.
    pub inside: Vec<[f64; 2]>,
    /// What the errors of lines have in common; none: they are independent.
    pub common: Option<LineErrors>,
}

/// What a field may pass the centreplane by: in standard deviations of the errors, and over the breadth. Beside its ends it
/// does.
pub const ALLOWED: [f64; 2] = [3.0, 3e-3];

/// Places between two offsets of a station at which a field is looked at, one after the other.
pub const PLACES: usize = 3;

/// The functions of a net at a cell, over the scale of its errors: products along u and v.
#[derive(Debug, Clone, Copy)]
struct Row {
    /// The first control value, and how many further that of the next function along u is.
    first: usize,
    stride: usize,
    along: [f64; DEGREE + 1],
    up: [f64; DEGREE + 1],
    /// The number of the shift of its line, with the factors of this and of the turn, which follows it.
    line: Option<(usize, [f64; 2])>,
}

impl Row {
    /// Value of a net without what its line has in common.
    fn of_net(&self, net: &[f64]) -> f64 {
        let line = |r: usize| -> f64 {
            let from = self.first + r * self.stride;
            self.up.iter().zip(&net[from..=from + DEGREE]).map(|(b, c)| b * c).sum()
        };
        (0..=DEGREE).map(|r| self.along[r] * line(r)).sum()
    }

    fn of(&self, net: &[f64], common: &[f64]) -> f64 {
        self.of_net(net) + self.line.map_or(0.0, |(k, [shift, turn])| shift * common[k] + turn * common[k + 1])
    }

    fn add_common(&self, common: &mut [f64], value: f64) {
        if let Some((k, [shift, turn])) = self.line {
            common[k] += shift * value;
            common[k + 1] += turn * value;
        }
    }

    fn add_to(&self, net: &mut [f64], value: f64) {
        for (r, along) in self.along.iter().enumerate() {
            let from = self.first + r * self.stride;
            net[from..=from + DEGREE].iter_mut().zip(&self.up).for_each(|(sum, b)| *sum += along * value * b);
        }
    }

    fn add_square(&self, normal: &mut SymmetricBand) {
        for k in 0..=DEGREE {
            for l in 0..=DEGREE {
                let value = self.along[k] * self.up[l];
                let column = self.first + k * self.stride + l;
                for i in k..=DEGREE {
                    let factor = value * self.along[i];
                    let run = self.up.map(|b| factor * b);
                    let from = if i == k { l } else { 0 };
                    normal.add_run(self.first + i * self.stride + from, column, &run[from..]);
                }
            }
        }
    }
}

/// u and v of places (x, z) on a chart; many share their x.
pub(super) fn places(chart: &Chart, places: impl Iterator<Item = [f64; 2]>) -> Vec<[f64; 2]> {
    let mut known = HashMap::new();
    let mut u = |x: f64| *known.entry(x.to_bits()).or_insert_with(|| chart.u(x));
    places.map(|[x, z]| [u(x), chart.v(z)]).collect()
}

/// The cells of a table as rows over a net on one chart.
#[derive(Debug, Clone)]
pub struct Observed {
    normal: SymmetricBand,
    right: Vec<f64>,
    /// M'L, column by column, and L'L, of what lines have in common.
    borders: Vec<f64>,
    corner: DMatrix<f64>,
    right_of_lines: Vec<f64>,
    /// q.
    ratio: f64,
    /// Rows over the scales.
    rows: Vec<Row>,
    /// Rows of places at which the hull is.
    inside: Vec<Row>,
    values: Vec<f64>,
    scales: Vec<f64>,
    /// Twice the greatest half-breadth \[m\].
    breadth: f64,
    /// log det X'X.
    kernel: f64,
}

impl Observed {
    /// Rows of the readings.
    #[must_use]
    pub fn new(net: &Net, chart: &Chart, Readings { cells, inside, common }: &Readings) -> Self {
        let places = places(chart, cells.iter().map(|cell| [cell.x, cell.z]));
        let mut normal = SymmetricBand::zeros(net.size(), net.energy_width());
        let mut right = vec![0.0; net.size()];
        let (mut rows, mut values) = (Vec::with_capacity(cells.len()), Vec::with_capacity(cells.len()));
        let stride = net.shape()[1];
        let row = |[u, v]: [f64; 2], scale: f64| {
            let ((i, along), (j, up)) = (net.basis(0, u), net.basis(1, v));
            Row { first: i * stride + j, stride, along, up: up.map(|b| b / scale), line: None }
        };
        let size = net.size();
        let count = 2 * common.as_ref().map_or(0, |common| common.lines.len());
        let mut of_line = vec![None; cells.len()];
        for (k, line) in common.iter().flat_map(|common| &common.lines).enumerate() {
            for &(cell, along) in &line.cells {
                of_line[cell] = Some((2 * k, [1.0, along].map(|factor| factor / cells[cell].scale)));
            }
        }
        let ratio = common.as_ref().map_or(1.0, |common| common.ratio);
        let mut borders = vec![0.0; size * count];
        let mut corner = DMatrix::zeros(count, count);
        let mut right_of_lines = vec![0.0; count];
        for ((cell, &at), &line) in cells.iter().zip(&places).zip(&of_line) {
            let row = Row { line, ..row(at, cell.scale) };
            let value = cell.y / cell.scale;
            row.add_to(&mut right, value);
            row.add_common(&mut right_of_lines, value);
            row.add_square(&mut normal);
            if let Some((k, factors)) = line {
                for (a, factor) in factors.into_iter().enumerate() {
                    row.add_to(&mut borders[(k + a) * size..(k + a + 1) * size], factor);
                    factors.into_iter().enumerate().for_each(|(b, other)| corner[(k + a, k + b)] += factor * other);
                }
            }
            rows.push(row);
            values.push(value);
        }
        let inside = self::places(chart, inside.iter().copied()).into_iter().map(|at| row(at, 1.0)).collect();
        let powers = |[u, v]: [f64; 2]| -> Vec<f64> {
            let of = |t: f64, k: usize| (2.0 * t - 1.0).powi(k as i32);
            (0..ORDER).flat_map(|i| (0..ORDER - i).map(move |j| of(u, i) * of(v, j))).collect()
        };
        let mut gram = DMatrix::<f64>::zeros(KERNEL, KERNEL);
        for (cell, &at) in cells.iter().zip(&places) {
            let x = powers(at);
            for i in 0..KERNEL {
                for j in 0..KERNEL {
                    gram[(i, j)] += x[i] * x[j] / (cell.scale * cell.scale);
                }
            }
        }
        let kernel = SymmetricEigen::new(gram).eigenvalues.iter().map(|e| e.max(1e-300).ln()).sum();
        let scales = cells.iter().map(|cell| cell.scale).collect();
        let breadth = 2.0 * cells.iter().map(|cell| cell.y).fold(0.0, f64::max);
        Self { normal, right, borders, corner, right_of_lines, ratio, rows, inside, values, scales, breadth, kernel }
    }

    /// Takes another ratio q of what lines have in common.
    pub(super) fn set_ratio(&mut self, ratio: f64) {
        self.ratio = ratio;
    }

    /// The system of a weight.
    fn system(&self, roughness: &Roughness, weight: f64) -> Result<System, SingularMatrix> {
        let band = self.normal.factor_plus(weight, &roughness.matrix)?;
        let (size, count) = (self.right.len(), self.right_of_lines.len());
        let mut halved = self.borders.clone();
        band.forward_blocks(&mut halved);
        let half = DMatrixView::from_slice(&halved, size, count);
        let corner = &self.corner + DMatrix::from_diagonal_element(count, count, 1.0 / self.ratio);
        let gram = corner - half.tr_mul(&half);
        let gram = Cholesky::new(gram).ok_or(SingularMatrix { column: size })?;
        Ok(System { size, band, halved, gram, log_ratio: count as f64 * self.ratio.ln() })
    }

    /// How likely it is that functions, given by their values at the cells, are in the errors of the field of a weight: the
    /// statistic b'G^-1 b / sigma^2 of the score test, chi-squared without them (Rao 1948), with the scaled values Phi.
    ///
    /// ```text
    /// b = Phi'(y - M c),   G = Phi'Phi - Phi'M (M'M + wP)^-1 M'Phi
    /// ```
    ///
    /// # Errors
    /// [`SingularMatrix`] when the cells do not determine the field.
    pub fn scores(
        &self,
        roughness: &Roughness,
        weight: f64,
        field: &Smoothed,
        candidates: &[Vec<Vec<f64>>],
    ) -> Result<Vec<f64>, SingularMatrix> {
        let system = self.system(roughness, weight)?;
        let residuals: Vec<f64> =
            self.rows.iter().zip(&self.values).map(|(row, y)| y - row.of(&field.values, &field.common)).collect();
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let score = |scaled: &[Vec<f64>], left: &[Vec<f64>]| {
            let count = scaled.len();
            let gram =
                DMatrix::from_fn(count, count, |i, j| 0.5 * (dot(&scaled[i], &left[j]) + dot(&scaled[j], &left[i])));
            let right = DVector::from_fn(count, |i, _| dot(&scaled[i], &residuals));
            let solved = SymmetricEigen::new(gram);
            let greatest = solved.eigenvalues.max();
            let parts = solved.eigenvectors.tr_mul(&right);
            let sum: f64 = parts
                .iter()
                .zip(&solved.eigenvalues)
                .filter(|(_, e)| **e > 1e-9 * greatest)
                .map(|(part, e)| part * part / e)
                .sum();
            sum / (field.sigma * field.sigma)
        };
        let (size, count) = (self.right.len(), self.right_of_lines.len());
        let scores = candidates.chunks(AT_ONCE).flat_map(|candidates| {
            let scaled: Vec<Vec<Vec<f64>>> = candidates
                .iter()
                .map(|functions| functions.iter().map(|f| f.iter().zip(&self.scales).map(|(f, s)| f / s).collect()))
                .map(Iterator::collect)
                .collect();
            let columns = scaled.iter().map(Vec::len).sum::<usize>();
            let (mut nets, mut common) = (vec![0.0; size * columns], vec![0.0; count * columns]);
            for (k, f) in scaled.iter().flatten().enumerate() {
                let (net, common) = (&mut nets[k * size..][..size], &mut common[k * count..][..count]);
                for (row, value) in self.rows.iter().zip(f) {
                    row.add_to(net, *value);
                    row.add_common(common, *value);
                }
            }
            system.solve(&mut nets, &mut common);
            let mut solved = (0..columns).map(|k| (&nets[k * size..][..size], &common[k * count..][..count]));
            let left = |f: &Vec<f64>, (net, common): (&[f64], &[f64])| -> Vec<f64> {
                self.rows.iter().zip(f).map(|(row, value)| value - row.of(net, common)).collect()
            };
            let score = |functions: &Vec<Vec<f64>>| {
                let left: Vec<Vec<f64>> = functions.iter().zip(&mut solved).map(|(f, net)| left(f, net)).collect();
                score(functions, &left)
            };
            scaled.iter().map(score).collect::<Vec<_>>()
        });
        Ok(scores.collect())
    }

    /// Standard deviations \[m\] of values of the field of a weight, by their rows: sigma sqrt(l'(M'M + wP)^-1 l).
    ///
    /// # Errors
    /// [`SingularMatrix`] when the cells do not determine the field.
    pub fn errors(
        &self,
        roughness: &Roughness,
        weight: f64,
        field: &Smoothed,
        rows: &[Vec<(usize, f64)>],
    ) -> Result<Vec<f64>, SingularMatrix> {
        let system = self.system(roughness, weight)?;
        let error = |row: &Vec<(usize, f64)>| {
            let mut solved = vec![0.0; self.right.len()];
            row.iter().for_each(|&(j, b)| solved[j] = b);
            system.solve(&mut solved, &mut vec![0.0; self.right_of_lines.len()]);
            field.sigma * row.iter().map(|(j, b)| b * solved[*j]).sum::<f64>().max(0.0).sqrt()
        };
        Ok(rows.iter().map(error).collect())
    }

    /// Number of cells.
    #[must_use]
    pub fn count(&self) -> usize {
        self.values.len()
    }
}

/// The factor of the unknowns of a field and of what lines have in common.
///
/// ```text
/// | M'M + wP   M'L        |
/// | L'M        L'L + I/q  |
/// ```
struct System {
    /// C C' = M'M + wP.
    band: BandedCholesky,
    /// Number of unknowns of the field.
    size: usize,
    /// C^-1 M'L.
    halved: Vec<f64>,
    /// Of the Schur complement of M'M + wP.
    gram: Cholesky<f64, Dyn>,
    log_ratio: f64,
}

impl System {
    /// Solves for columns of right-hand sides, those of nets and those of what lines have in common.
    fn solve(&self, nets: &mut [f64], common: &mut [f64]) {
        let count = self.gram.l_dirty().nrows();
        let is_one = nets.len() == self.size;
        if is_one {
            self.band.forward(nets);
        } else {
            self.band.forward_blocks(nets);
        }
        if let Some(columns) = common.len().checked_div(count) {
            let half: DMatrixView<'_, f64> = DMatrixView::from_slice(&self.halved, self.size, count);
            let mut nets = DMatrixViewMut::from_slice(nets, self.size, columns);
            let mut common = DMatrixViewMut::from_slice(common, count, columns);
            common -= half.tr_mul(&nets);
            self.gram.solve_mut(&mut common);
            nets -= half * &common;
        }
        if is_one {
            self.band.backward(nets);
        } else {
            self.band.backward_blocks(nets);
        }
    }

    /// log det, with that of the variances of what lines have in common.
    fn log_determinant(&self) -> f64 {
        self.band.log_determinant() + self.gram.ln_determinant() + self.log_ratio
    }
}

/// A fair field.
#[derive(Debug, Clone)]
pub struct Smoothed {
    /// Control values \[m\].
    pub values: Vec<f64>,
    /// Shift and turn of each line that has errors in common \[m\].
    pub common: Vec<f64>,
    /// Standard deviation of the errors of the offsets, normal to the hull \[m\].
    pub sigma: f64,
    /// -2 log l, but for a constant.
    pub cost: f64,
    /// The part of it that passing the centreplane costs.
    pub below: f64,
}

/// The energy of one metric.
#[derive(Debug, Clone)]
pub struct Roughness {
    /// P.
    pub matrix: SymmetricBand,
    /// log det+ P, but for a constant of the net.
    pub log_determinant: f64,
}

impl Roughness {
    /// Of a net, a metric and a density.
    ///
    /// # Errors
    /// [`SingularMatrix`] when rounding makes it indefinite.
    pub fn new(net: &Net, metric: Metric, density: Option<&Density>) -> Result<Self, SingularMatrix> {
        let matrix = net.energy(metric, density);
        Ok(Self { log_determinant: net.log_determinant(&matrix)?, matrix })
    }
}

/// The field of least |S^-1 (y - M c)|^2 + w c'Pc and its likelihood; sigma is at least `least`.
///
/// # Errors
/// [`SingularMatrix`] when the cells do not determine the field.
pub fn smoothed(
    observed: &Observed,
    roughness: &Roughness,
    weight: f64,
    least: f64,
) -> Result<Smoothed, SingularMatrix> {
    let system = observed.system(roughness, weight)?;
    let (mut values, mut common) = (observed.right.clone(), observed.right_of_lines.clone());
    system.solve(&mut values, &mut common);
    let off = |(row, y): (&Row, &f64)| (row.of(&values, &common) - y).powi(2);
    let misfit: f64 = observed.rows.iter().zip(&observed.values).map(off).sum();
    let of_lines = common.iter().map(|value| value * value).sum::<f64>() / observed.ratio;
    let left = misfit + weight * roughness.matrix.quadratic(&values).max(0.0) + of_lines;
    let freedom = observed.count().saturating_sub(KERNEL).max(1) as f64;
    let variance = (left / freedom).max(least * least);
    let rank = (values.len() - KERNEL) as f64;
    let determinant = rank * weight.ln() + roughness.log_determinant - system.log_determinant() + observed.kernel;
    let allowed = (ALLOWED[0] * variance.sqrt()).max(ALLOWED[1] * observed.breadth);
    let deepest = |gap: &[Row]| gap.iter().map(|row| row.of_net(&values) + allowed).fold(0.0, f64::min).powi(2);
    let below = observed.inside.chunks(PLACES).map(deepest).sum::<f64>() / variance;
    let cost = freedom * variance.ln() + left / variance - determinant + below;
    Ok(Smoothed { values, common, sigma: variance.sqrt(), cost, below })
}

/// Scale of the errors of an offset that is exact, over that of others.
pub const EXACT: f64 = 1e-3;
