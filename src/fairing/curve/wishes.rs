//! What is wished of the whole curve, and what it may do between the points.

use super::super::model::{Limit, Row, value};
use super::super::program::Between;
use super::given::{CurvePoint, CurveSettings};
use super::result::LineKind;
use super::space::CurveSpace;
use crate::spline::BsplineCurve;

/// Places a span at which the curve is kept.
const FINENESS: usize = 4;

/// What the curve may move between the points beyond the tolerance, over the range of the ordinates: none for an area
/// that is had by waves.
const ROOM: f64 = 0.02;

/// The same where the points say little: beside one that is to be predicted, and at an end whose slope is wished.
const OPEN: f64 = 0.25;

/// Spans over which a slope at the end is felt.
const BENT: f64 = 2.5;

/// A constraint of the whole curve.
pub(super) struct Wished {
    pub(super) kind: LineKind,
    pub(super) target: f64,
    pub(super) limit: Limit,
}

impl Wished {
    /// The same wish for another target.
    pub(super) fn with_target(&self, space: &CurveSpace, target: f64) -> Self {
        let (from, to) = space.knots.domain();
        // In units of a mean ordinate over the whole length.
        let length = to - from;
        let limit = |row, right| Limit { row, lower: right, upper: right };
        let limit = match self.kind {
            LineKind::FirstSlope => limit(space.row(from, 1), target),
            LineKind::LastSlope => limit(space.row(to, 1), target),
            LineKind::Area => limit(dense(space.moment(0), length), target / length),
            LineKind::Centroid => {
                // int (x - target) y dx = 0 with the area that the points have.
                let row = space.moment(1).iter().zip(space.moment(0)).map(|(m, a)| m - target * a).collect();
                limit(dense(row, length * length), 0.0)
            }
        };
        Self { kind: self.kind, target, limit }
    }

    /// What a miss of the target is measured in.
    pub(super) fn scale(&self, space: &CurveSpace) -> f64 {
        let (from, to) = space.knots.domain();
        match self.kind {
            LineKind::Area | LineKind::Centroid => to - from,
            LineKind::FirstSlope | LineKind::LastSlope => 1.0,
        }
    }
}

fn dense(row: Vec<f64>, scale: f64) -> Row {
    row.into_iter().enumerate().map(|(i, v)| (i, v / scale)).filter(|entry| entry.1 != 0.0).collect()
}

/// The wishes of the settings.
pub(super) fn limits(space: &CurveSpace, settings: &CurveSettings) -> Vec<Wished> {
    let wished = [
        (LineKind::FirstSlope, settings.slopes[0]),
        (LineKind::LastSlope, settings.slopes[1]),
        (LineKind::Area, settings.area),
        (LineKind::Centroid, settings.centroid),
    ];
    let none = |kind| Wished { kind, target: 0.0, limit: Limit { row: Vec::new(), lower: 0.0, upper: 0.0 } };
    wished.into_iter().filter_map(|(kind, target)| target.map(|target| none(kind).with_target(space, target))).collect()
}

/// The quantity of a constraint for a curve.
pub(super) fn quantity(kind: LineKind, curve: &BsplineCurve<1>) -> f64 {
    let (from, to) = curve.knots().domain();
    let moment = |power: u32| -> f64 {
        curve.knots().moments(power, from, to).iter().zip(curve.points()).map(|(m, c)| m * c[0]).sum()
    };
    match kind {
        LineKind::Area => moment(0),
        LineKind::Centroid => moment(1) / moment(0),
        LineKind::FirstSlope => curve.derivatives::<2>(from)[1][0],
        LineKind::LastSlope => curve.derivatives::<2>(to)[1][0],
    }
}

/// Limits about the curve of `reference` at places between the points.
pub(super) fn between(
    space: &CurveSpace,
    points: &[CurvePoint],
    tolerances: &[Option<f64>],
    settings: &CurveSettings,
    reference: &[f64],
) -> Vec<Between> {
    let given = points.iter().filter_map(|point| point.y);
    let [low, high] = given.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], y| [low.min(y), high.max(y)]);
    let range = if high > low { high - low } else { high.abs() };
    let (from, to) = space.knots.domain();
    let mut limits = Vec::new();
    for span in space.knots.breakpoints().windows(2) {
        let within = |x: f64| x >= span[0] && x <= span[1];
        let guessed = points.iter().any(|point| point.y.is_none() && within(point.x));
        // A slope at an end is felt over some spans.
        let reach = BENT * (span[1] - span[0]);
        let near = |end: f64| (end - span[0]).abs().min((end - span[1]).abs()) < reach;
        let bent = [from, to].iter().zip(settings.slopes).any(|(&end, slope)| slope.is_some() && near(end));
        let room = range * if guessed || bent { OPEN } else { ROOM };
        let near = points.iter().zip(tolerances).filter(|(point, _)| within(point.x));
        let tolerance = near.filter_map(|(_, tolerance)| *tolerance).fold(0.0, f64::max);
        for k in 1..FINENESS {
            let row = space.row(span[0] + (span[1] - span[0]) * k as f64 / FINENESS as f64, 0);
            limits.push(Between { value: value(&row, reference), row, tolerance, room });
        }
    }
    limits
}
