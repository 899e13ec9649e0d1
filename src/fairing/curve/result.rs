//! What fairing a curve comes to.

use super::super::infeasible::Diagnosis;
use super::super::inflections::Inflections;
use super::super::smoothing::Trial;
use super::suspects::CurveSuspect;
use crate::qp::Certificate;
use crate::spline::BsplineCurve;

/// y'' below this part of its largest value on the same stretch is flat when inflections are counted.
pub(super) const FLAT: f64 = 1e-3;
/// The same where it bows over the whole curve by less than this part of the largest ordinate: rounding.
const NIL: f64 = 1e-10;
/// Places a span at which y'' is looked at.
const SAMPLES: usize = 8;

/// How the job ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FairStatus {
    /// The optimum of the convex program.
    Optimal,
    /// The targets contradict each other within the tolerances: the curve is the best with the tolerances multiplied by
    /// [`FairCurve::widening`], or the one that comes nearest to them ([`FairCurve::nearest`]).
    Infeasible,
    /// The solver stopped early.
    Limit,
}

impl FairStatus {
    /// `optimal`, `infeasible` or `limit`.
    #[must_use]
    pub fn as_str(self) -> &'static str {
        match self {
            Self::Optimal => "optimal",
            Self::Infeasible => "infeasible",
            Self::Limit => "limit",
        }
    }
}

/// One point before and after.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CurveMove {
    /// Abscissa.
    pub x: f64,
    /// As given; none where it was to be predicted.
    pub before: Option<f64>,
    /// On the fair curve.
    pub after: f64,
    /// The tolerance that held, without widening.
    pub tolerance: Option<f64>,
    /// Whether it holds the curve: the move has used it up.
    pub active: bool,
    /// dy/dx on the fair curve.
    pub slope: f64,
    /// Curvature on the fair curve.
    pub curvature: f64,
    /// Left out as a suspect.
    pub suspect: bool,
}

impl CurveMove {
    /// After minus before.
    #[must_use]
    pub fn moved(&self) -> Option<f64> {
        self.before.map(|before| self.after - before)
    }
}

/// What a line of the list of constraints is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LineKind {
    /// Area under the curve.
    Area,
    /// Abscissa of its centroid.
    Centroid,
    /// Slope at the first point.
    FirstSlope,
    /// Slope at the last point.
    LastSlope,
}

impl LineKind {
    /// Name in files.
    #[must_use]
    pub fn key(self) -> &'static str {
        match self {
            Self::Area => "area",
            Self::Centroid => "centroid",
            Self::FirstSlope => "first_slope",
            Self::LastSlope => "last_slope",
        }
    }
}

/// One constraint.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CurveLine {
    /// What it is about.
    pub kind: LineKind,
    /// What was wished.
    pub target: f64,
    /// Of the batten through the points as given.
    pub before: f64,
    /// Of the fair curve.
    pub after: f64,
    /// Multiplier in the program: growth of the objective for a growth of the target by one unit of the row.
    pub multiplier: f64,
    /// What it costs: how much the root of the mean weighted square of the moves falls when it is dropped; not a number
    /// where the program without it was not solved.
    pub price: f64,
}

/// The fair curve and everything that is known about it.
#[derive(Debug, Clone)]
pub struct FairCurve {
    /// How it ended.
    pub status: FairStatus,
    /// y(x).
    pub curve: BsplineCurve<1>,
    /// The cubic batten of least bending through the points as given.
    pub batten: BsplineCurve<1>,
    /// Every point.
    pub points: Vec<CurveMove>,
    /// Order of the energy.
    pub order: usize,
    /// E_m of the curve and of the spline of this energy through the points as given.
    pub energy: [f64; 2],
    /// Noise level of a reading.
    pub sigma: f64,
    /// Weight of the energy, lambda of cross-validation.
    pub lambda: f64,
    /// Effective degrees of freedom of the smoothed curve.
    pub freedom: f64,
    /// The weights that were tried.
    #[doc(hidden)]
    pub trials: Vec<Trial>,
    /// Bound and residuals, computed outside the solver.
    pub certificate: Certificate,
    /// Constraints of the whole curve.
    #[doc(hidden)]
    pub lines: Vec<CurveLine>,
    /// The least number of inflections within the tolerances, with its proof.
    pub least: Inflections,
    /// Inflections of the batten, and of the curve.
    pub inflections: [Vec<f64>; 2],
    /// The number that was allowed; none when signs were left free.
    pub allowed: Option<usize>,
    /// Price of the pattern in sigma^2.
    pub price: f64,
    /// Prices of smaller numbers that were too dear: number and price in sigma^2, infinite where the pattern is not
    /// possible.
    pub refused: Vec<(usize, f64)>,
    /// Factor on all tolerances; 1 unless infeasible.
    pub widening: f64,
    /// Why area, centroid and slopes cannot be met, in numbers.
    #[doc(hidden)]
    pub diagnosis: Option<Diagnosis>,
    /// Whether area, centroid and slopes were replaced by the nearest that can be met.
    pub nearest: bool,
    /// Convex programs solved, and iterations of the solver in them.
    pub work: [usize; 2],
    /// Times the metric of curvature was refreshed.
    pub refreshes: usize,
}

impl FairCurve {
    /// Says of points that were fitted without their ordinates, because they are suspected, what was given.
    #[doc(hidden)]
    pub fn left_out(&mut self, suspects: &[CurveSuspect]) {
        for suspect in suspects {
            if let Some(point) = self.points.get_mut(suspect.index) {
                (point.before, point.suspect) = (Some(suspect.value), true);
            }
        }
    }

    /// Root mean square and largest move of what was not left out, and where the latter is.
    #[must_use]
    pub fn moves(&self) -> (f64, f64, f64) {
        let kept = self.points.iter().filter(|point| !point.suspect);
        let moves: Vec<(f64, f64)> = kept.filter_map(|p| p.moved().map(|m| (p.x, m))).collect();
        let square: f64 = moves.iter().map(|m| m.1 * m.1).sum();
        let (at, most) = moves.iter().fold((0.0, 0.0_f64), |b, m| if m.1.abs() > b.1 { (m.0, m.1.abs()) } else { b });
        ((square / moves.len().max(1) as f64).sqrt(), most, at)
    }
}

/// Where y'' changes its sign between the knuckles; parts below [`FLAT`] of its largest value on the stretch, or below
/// [`NIL`] of the curve, are flat, and a change over a flat is put at its middle.
pub(super) fn inflections(curve: &BsplineCurve<1>, knuckles: &[f64]) -> Vec<f64> {
    let breaks = curve.knots().breakpoints();
    let (from, to) = curve.knots().domain();
    let ends: Vec<f64> = [from].into_iter().chain(knuckles.iter().copied()).chain([to]).collect();
    let highest = curve.points().iter().fold(0.0_f64, |most, point| most.max(point[0].abs()));
    // y'' l^2 / 8 is the bow over a length l.
    let nil = 8.0 * NIL * highest / (to - from).powi(2);
    let mut found = Vec::new();
    for stretch in ends.windows(2) {
        let spans = breaks.windows(2).filter(|span| span[0] >= stretch[0] && span[1] <= stretch[1]);
        let samples: Vec<(f64, f64)> = spans
            .flat_map(|span| {
                let h = (span[1] - span[0]) / SAMPLES as f64;
                (0..SAMPLES).map(move |k| span[0] + h * (k as f64 + 0.5))
            })
            .map(|x| (x, curve.derivatives::<3>(x)[2][0]))
            .collect();
        let largest = samples.iter().fold(0.0_f64, |most, s| most.max(s.1.abs()));
        let seen: Vec<&(f64, f64)> = samples.iter().filter(|s| s.1.abs() > nil.max(FLAT * largest)).collect();
        for pair in seen.windows(2).filter(|pair| pair[0].1 * pair[1].1 < 0.0) {
            let ((a, u), (b, v)) = (*pair[0], *pair[1]);
            let h = samples.get(1).map_or(0.0, |s| s.0 - samples[0].0);
            // Next to each other: where the straight line between them vanishes.
            let near = b - a < 3.0 * h;
            found.push(if near { a + (b - a) * u.abs() / (u.abs() + v.abs()) } else { 0.5 * (a + b) });
        }
    }
    found
}
