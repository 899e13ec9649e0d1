//! The methods by which a table becomes a surface: the default, and those of five published systems with their settings.

use crate::spline::{MAX_DEGREE, Parametrization};
use std::fmt;

/// How a table becomes a surface.
#[derive(Debug, Clone, PartialEq, Default)]
pub enum FitMethod {
    /// Interpolation on graded charts with minimum energy, the default.
    #[default]
    Graded,
    /// S(x, z) = sum y_ij psi_i(x) psi_j(z) with hat functions: every cell is met, between cells the surface is
    /// bilinear. It errs by |y_xx| dx^2 / 8 + |y_zz| dz^2 / 8 (Blagojevic, Split, programs 1 and 2).
    Bilinear,
    /// Least squares on a tensor product with few control points; cells are not met.
    #[doc(hidden)]
    LeastSquares(LeastSquares),
    /// Uniform bicubic surface over the offsets as vertices, ends repeated three times; inner cells are not met.
    #[doc(hidden)]
    UniformBicubic(UniformBicubic),
    /// Quadratic surface over the offsets as control points; inner cells are not met.
    #[doc(hidden)]
    QuadraticNet(QuadraticNet),
    /// Waterlines splined with their ends and cut into equal parts, columns likewise, and a surface through those points.
    #[doc(hidden)]
    ParametricStations(ParametricStations),
}

/// Least squares on given or chosen knots (Blagojevic, Split, programs 3 and 4). The first of each pair is along the
/// hull, the second up it.
#[derive(Debug, Clone, PartialEq)]
pub struct LeastSquares {
    /// Orders, degree + 1.
    pub orders: [usize; 2],
    /// Numbers of control points; none for three quarters of the lines of the table, rounded up, and at least the order.
    pub control_points: [Option<usize>; 2],
    /// Knots, clamped or not, `control_points + order` of them used; none for knots by the sites (Piegl & Tiller 1997,
    /// 9.69).
    pub knots: [Option<Vec<f64>>; 2],
    /// Parameters of the stations and of the waterlines; none for parameters in proportion to x and z.
    pub parameters: [Option<Vec<f64>>; 2],
}

impl Default for LeastSquares {
    fn default() -> Self {
        Self { orders: [3, 3], control_points: [None, None], knots: [None, None], parameters: [None, None] }
    }
}

/// Uniform bicubic surface over the offsets (Nitu, Macovei & Dobran, Bucharest 1993). Border curves depend on border
/// vertices only and the corners are met. Along a knuckle the vertices are repeated three times: two surfaces joined
/// C0.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct UniformBicubic {
    /// Waterlines of the table that are knuckles \[m\].
    pub knuckle_waterlines: Vec<f64>,
    /// Stations of the table across which the tangent breaks, x \[m\].
    pub knuckle_stations: Vec<f64>,
}

/// Where the knots of [`QuadraticNet`] stand.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum NetKnots {
    /// Three-fold at the ends and equally spaced between, `[0, 0, 0, 1, 2, 3, 3, 3]` for five control points: the
    /// non-uniform knots of the thesis.
    #[default]
    OpenUniform,
    /// Three-fold at the ends and midway between the inner lines of the table, so that spans follow its spacing.
    Midpoints,
}

/// Quadratic surface over the offsets as control points (program SetaForm, Turkish thesis of the 2000s).
#[derive(Debug, Clone, PartialEq, Default)]
pub struct QuadraticNet {
    /// The knots.
    pub knots: NetKnots,
    /// Stations of the table where one surface ends and the next begins, x \[m\]; the thesis has two surfaces a ship.
    pub split_stations: Vec<f64>,
}

/// Parametric stations and waterlines (Silalahi, Surabaya 1999).
#[derive(Debug, Clone, PartialEq)]
pub struct ParametricStations {
    /// Order of waterlines, columns and surface, degree + 1.
    pub order: usize,
    /// Equal parts of each waterline; none for one more than there are stations.
    pub parts_along: Option<usize>,
    /// Equal parts of each column; none for one less than there are waterlines.
    pub parts_up: Option<usize>,
    /// How parameters follow from points.
    pub parametrization: Parametrization,
}

impl Default for ParametricStations {
    fn default() -> Self {
        Self { order: 3, parts_along: None, parts_up: None, parametrization: Parametrization::ChordLength }
    }
}

impl FitMethod {
    /// Every method with its default settings.
    #[must_use]
    pub fn all() -> [Self; 6] {
        [
            Self::Graded,
            Self::Bilinear,
            Self::LeastSquares(LeastSquares::default()),
            Self::UniformBicubic(UniformBicubic::default()),
            Self::QuadraticNet(QuadraticNet::default()),
            Self::ParametricStations(ParametricStations::default()),
        ]
    }

    /// The word for it in files and on the command line.
    #[must_use]
    pub fn as_str(&self) -> &'static str {
        match self {
            Self::Graded => "graded",
            Self::Bilinear => "bilinear",
            Self::LeastSquares(_) => "least-squares",
            Self::UniformBicubic(_) => "uniform-bicubic",
            Self::QuadraticNet(_) => "quadratic-net",
            Self::ParametricStations(_) => "parametric-stations",
        }
    }
}

/// A setting that does not go with itself or with the table.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SettingProblem {
    /// The setting, by its key in method files.
    pub key: &'static str,
    /// What is wrong, with numbers.
    pub message: String,
    /// The remedy.
    pub help: String,
}

/// Every problem of the settings of a method.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SettingProblems(pub Vec<SettingProblem>);

impl fmt::Display for SettingProblems {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (index, problem) in self.0.iter().enumerate() {
            let gap = if index > 0 { "; " } else { "" };
            write!(f, "{gap}{}: {}. {}", problem.key, problem.message, problem.help)?;
        }
        Ok(())
    }
}

impl std::error::Error for SettingProblems {}

/// Collects problems of settings.
#[derive(Debug, Default)]
pub(super) struct Problems(Vec<SettingProblem>);

impl Problems {
    pub(super) fn add(&mut self, key: &'static str, message: String, help: impl Into<String>) {
        self.0.push(SettingProblem { key, message, help: help.into() });
    }

    /// The order, within what a spline may have, as a degree.
    pub(super) fn degree(&mut self, key: &'static str, order: usize) -> usize {
        if !(2..=MAX_DEGREE + 1).contains(&order) {
            self.add(key, format!("the order is {order}"), format!("Orders are 2 to {}.", MAX_DEGREE + 1));
        }
        order.clamp(2, MAX_DEGREE + 1) - 1
    }

    /// Indices of the lines at the given places, each a line of the table within the millionth of its extent.
    pub(super) fn lines(&mut self, key: &'static str, places: &[f64], lines: &[f64]) -> Vec<usize> {
        let extent = lines.last().zip(lines.first()).map_or(0.0, |(b, a)| b - a);
        let mut found = Vec::new();
        for &place in places {
            let nearest =
                (0..lines.len()).min_by(|&a, &b| (lines[a] - place).abs().total_cmp(&(lines[b] - place).abs()));
            let Some(index) = nearest else { continue };
            if (lines[index] - place).abs() > 1e-6 * extent || place.is_nan() {
                let help = format!("The nearest is at {} m.", lines[index]);
                self.add(key, format!("no line of the table is at {place} m"), help);
            } else {
                found.push(index);
            }
        }
        found.sort_unstable();
        found.dedup();
        found
    }

    /// Nothing, or every problem.
    pub(super) fn done(self) -> Result<(), SettingProblems> {
        if self.0.is_empty() { Ok(()) } else { Err(SettingProblems(self.0)) }
    }
}
