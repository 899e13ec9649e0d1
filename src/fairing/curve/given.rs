//! What is given and what is wished.

use super::super::inflections::BandsError;
use crate::numeric::SingularMatrix;
use crate::qp::{ProblemError, Settings};
use crate::spline::SplineError;

/// One point of the curve.
#[derive(Debug, Clone, PartialEq)]
pub struct CurvePoint {
    /// Abscissa.
    pub x: f64,
    /// Ordinate; none where it is to be predicted.
    pub y: Option<f64>,
    /// How far the curve may depart; none takes that of the settings.
    pub tolerance: Option<f64>,
    /// Weight; 1 for ordinary points.
    pub weight: f64,
    /// Must not move.
    pub locked: bool,
    /// The curve has a corner here.
    pub knuckle: bool,
    /// The curvature jumps here: the tangent point of a straight piece.
    pub tangent: bool,
}

impl CurvePoint {
    /// An ordinary point.
    #[must_use]
    pub fn new(x: f64, y: f64) -> Self {
        Self { x, y: Some(y), tolerance: None, weight: 1.0, locked: false, knuckle: false, tangent: false }
    }
}

/// How many inflections there may be.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum InflectionWish {
    /// The least number within the tolerances, more only where it costs more than [`super::PRICE`].
    #[default]
    Least,
    /// So many at most, whatever it costs.
    AtMost(usize),
    /// As they come.
    Any,
}

/// How a curve is faired.
#[derive(Debug, Clone, PartialEq)]
pub struct CurveSettings {
    /// Order m of the energy: 2 bending, 3 change of curvature, 4 its change.
    pub order: usize,
    /// Tolerance of points without their own; none takes three noise levels.
    pub tolerance: Option<f64>,
    /// Least noise level: rounding of the readings, quantum / sqrt(12); also the least tolerance is twice the quantum.
    pub quantum: f64,
    /// Smoothing weight lambda; none takes that of cross-validation.
    pub weight: Option<f64>,
    /// Inflections.
    pub inflections: InflectionWish,
    /// Slope dy/dx at the first and at the last point.
    pub slopes: [Option<f64>; 2],
    /// Area under the curve.
    pub area: Option<f64>,
    /// Abscissa of the centroid of this area.
    pub centroid: Option<f64>,
    /// Whether the metric of true curvature is used where slopes are not mild.
    pub true_curvature: bool,
    /// The solver.
    #[doc(hidden)]
    pub solver: Settings,
}

impl Default for CurveSettings {
    fn default() -> Self {
        Self {
            order: 4,
            tolerance: None,
            quantum: 0.0,
            weight: None,
            inflections: InflectionWish::default(),
            slopes: [None; 2],
            area: None,
            centroid: None,
            true_curvature: true,
            solver: Settings::default(),
        }
    }
}

/// Why a question is none.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum CurveError {
    /// Too few points with an ordinate.
    #[error("{found} points with an ordinate; an energy of order {order} needs {needed}")]
    TooFew {
        /// Found.
        found: usize,
        /// Order of the energy.
        order: usize,
        /// Wanted.
        needed: usize,
    },
    /// An order that there is not.
    #[error("order {0} of the energy; it is 2, 3 or 4")]
    Order(usize),
    /// A setting that is not positive or not finite.
    #[error("{what} is {value:?}; at most 1e12 are taken, and none below 0 but of slopes, area and centroid")]
    Setting {
        /// Which one.
        what: &'static str,
        /// Its value.
        value: f64,
    },
    /// Points or tolerances that make no bands.
    #[error(transparent)]
    #[doc(hidden)]
    Bands(#[from] BandsError),
    /// Knots that make no spline.
    #[error(transparent)]
    Spline(#[from] SplineError),
    /// Points that do not determine the curve.
    #[error(
        "the points do not determine the curve: too few with an ordinate between its knuckles and tangent points for an energy of this order, \
         2 at least and more between tangent points; give more, or take a lower --order ({0})"
    )]
    #[doc(hidden)]
    Undetermined(#[from] SingularMatrix),
    /// Numbers that make no program.
    #[error(transparent)]
    #[doc(hidden)]
    Problem(#[from] ProblemError),
}
