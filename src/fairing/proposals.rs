//! Knuckles and tangent lines that a table has and does not declare, with what they would bring, and nets that have them.
//!
//! A line at one height is v = constant on a level chart, a line at one station u = constant on an upright chart or
//! where the ends do not lean. A p-fold knot there lets the slope break (knuckle), a (p-1)-fold one the curvature
//! (tangent line); the energy charges nothing across either. What a line brings is told by smoothing with the same
//! weight with and without it: the root of the mean square of what the offsets depart, and by how much sum w r^2 +
//! lambda E falls, in units of the square of the noise.

use super::error::FairError;
use super::lines::{LineCourse, LineKind, ProposedLine};
use super::metric::ANISOTROPY;
use super::model::Model;
use super::smoothing::Smoother;
use super::surface::{FairSurface, energy as plain_energy};
use super::unbroken::{AT_KNOT, Along, Breaks, runs_on};
use crate::hull::{self, FeatureLine, Hull, HullError, OffsetTable};
use crate::spline::KnotVector;

/// A line of the net departs by no more than this \[m\] from the line that is proposed.
const STRAIGHT: f64 = 1e-6;

/// Which proposals are taken.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub enum Accepted {
    /// None.
    #[default]
    None,
    /// All of them.
    All,
    /// Those of these numbers, from 1: L1, L2, ...
    These(Vec<usize>),
}

impl Accepted {
    /// Whether the proposal of number `k`, from 1, is taken.
    #[must_use]
    pub fn has(&self, k: usize) -> bool {
        match self {
            Self::None => false,
            Self::All => true,
            Self::These(list) => list.contains(&k),
        }
    }
}

/// A proposal and what it would bring.
#[derive(Debug, Clone, PartialEq)]
pub struct Proposal {
    /// Number, from 1.
    pub number: usize,
    /// The line.
    pub line: ProposedLine,
    /// Root of the mean square of what the offsets depart from the smoothed surface without and with the line \[m\];
    /// none where the chart has no such line.
    pub rms: Option<[f64; 2]>,
    /// What the objective falls by with the line, in squares of the noise.
    pub gain: Option<f64>,
    /// Whether it was taken.
    pub accepted: bool,
}

/// The hull with a line along which it may break, its surface being the same; none where the chart has no such line.
///
/// # Errors
/// [`HullError`] when the net makes no hull.
pub fn with_line(hull: &Hull, line: &ProposedLine) -> Result<Option<Hull>, HullError> {
    let surface = hull.surface();
    let Some(t) = parameter(hull, line) else { return Ok(None) };
    // Along the reach of the line its parameter stands still.
    let follows = (0..=8).all(|k| {
        let part = line.reach[0] + (line.reach[1] - line.reach[0]) * f64::from(k) / 8.0;
        let place = match line.course {
            LineCourse::Waterline => hull.parameters(part, line.at),
            LineCourse::Station => hull.parameters(line.at, part),
        };
        place.is_none_or(|[u, v]| {
            let [on, axis] = match line.course {
                LineCourse::Waterline => [surface.eval(u, t)[2], line.at],
                LineCourse::Station => [surface.eval(t, v)[0], line.at],
            };
            (on - axis).abs() <= STRAIGHT
        })
    });
    let (from, to) = knots(hull, line.course).domain();
    if !follows || t <= from || t >= to {
        return Ok(None);
    }
    broken(hull, line.course, t, line.kind).map(Some)
}

/// The parameter of the net across a line, in its middle.
pub(super) fn parameter(hull: &Hull, line: &ProposedLine) -> Option<f64> {
    let middle = 0.5 * (line.reach[0] + line.reach[1]);
    match line.course {
        LineCourse::Waterline => hull.parameters(middle, line.at).map(|at| at[1]),
        LineCourse::Station => hull.parameters(line.at, middle).map(|at| at[0]),
    }
}

pub(super) fn knots(hull: &Hull, course: LineCourse) -> &KnotVector {
    if course == LineCourse::Waterline { hull.surface().v() } else { hull.surface().u() }
}

/// Whether the surface of a hull breaks along a line already. A net that might let the curvature jump where the surface
/// does not is none.
pub(super) fn has_line(hull: &Hull, line: &ProposedLine) -> bool {
    let knots = knots(hull, line.course);
    let wanted = knots.degree() - usize::from(line.kind == LineKind::Tangent);
    let ((from, to), at) = (knots.domain(), parameter(hull, line));
    let near = |t: f64| at.is_some_and(|at| (at - t).abs() <= AT_KNOT * (to - from));
    let mut lines = knots.breakpoints().into_iter().filter(|&t| t > from && t < to && near(t));
    lines.any(|t| match knots.multiplicity(t) {
        times if times < wanted => false,
        times if times >= knots.degree() => true,
        _ => !runs_on(hull.surface(), usize::from(line.course == LineCourse::Waterline), (t - from) / (to - from)),
    })
}

/// Adds lines along which a hull may break.
pub(super) fn add_lines<'a>(hull: &Hull, lines: impl Iterator<Item = &'a ProposedLine>, breaks: &mut Breaks) {
    for line in lines {
        let (from, to) = knots(hull, line.course).domain();
        let way = usize::from(line.course == LineCourse::Waterline);
        let along = |t: f64| Along { at: (t - from) / (to - from), reach: line.reach };
        breaks.of(line.kind)[way].extend(parameter(hull, line).map(along));
    }
}

/// The knuckles along waterlines that were taken, as lines of the table: the fit itself then breaks there, where a fit
/// without them runs through as a curve.
pub(super) fn declared(proposals: &[Proposal], hull: &Hull, table: &OffsetTable) -> Vec<FeatureLine> {
    let taken = proposals.iter().filter(|proposal| {
        proposal.accepted && proposal.line.kind == LineKind::Knuckle && proposal.line.course == LineCourse::Waterline
    });
    taken
        .map(|proposal| {
            let ([from, to], z) = (proposal.line.reach, proposal.line.at);
            let mut places: Vec<f64> = table.stations.iter().map(|station| station.station.x).collect();
            places.retain(|x| (from..=to).contains(x));
            places.sort_by(f64::total_cmp);
            let points = places.into_iter().filter_map(|x| Some([x, hull.half_breadth(x, z)?, z])).collect();
            FeatureLine { name: format!("L{}", proposal.number), kind: hull::LineKind::Knuckle, points }
        })
        .collect()
}

/// The same surface with a line of the parameters along which its slope or its curvature may break: a p-fold or a
/// (p-1)-fold knot.
pub(super) fn broken(hull: &Hull, course: LineCourse, mut t: f64, kind: LineKind) -> Result<Hull, HullError> {
    let (surface, knots) = (hull.surface(), knots(hull, course));
    let (from, to) = knots.domain();
    let nearest = knots.breakpoints().into_iter().min_by(|a, b| (a - t).abs().total_cmp(&(b - t).abs()));
    if let Some(knot) = nearest.filter(|knot| (knot - t).abs() <= AT_KNOT * (to - from)) {
        t = knot;
    }
    let wanted = match kind {
        LineKind::Knuckle => knots.degree(),
        LineKind::Tangent => knots.degree() - 1,
    };
    let inserted = vec![t; wanted.saturating_sub(knots.multiplicity(t))];
    let finer = match course {
        LineCourse::Waterline => surface.insert_knots(&[], &inserted)?,
        LineCourse::Station => surface.insert_knots(&inserted, &[])?,
    };
    Hull::new(hull.name(), *hull.particulars(), finer, hull.deck().clone())
}

/// Every proposal with what it would bring to the surface of the fit, smoothed with the greatest weight at which the
/// typical offset departs by no more than `noise` \[m\].
///
/// # Errors
/// [`FairError`] when a net with a line makes no problem.
pub fn proposals(
    table: &OffsetTable,
    hull: &Hull,
    lines: &[ProposedLine],
    noise: f64,
    (accepted, breaks): (&Accepted, &Breaks),
) -> Result<Vec<Proposal>, FairError> {
    if lines.is_empty() {
        return Ok(Vec::new());
    }
    // Departure, objective, and the weight of the energy itself, which is the same for all nets.
    let of = |hull: &Hull, weight: Option<f64>, breaks: &Breaks| -> Result<[f64; 3], FairError> {
        let surface = FairSurface::new(table, hull, breaks);
        // Neither the start, which runs smoothly through what a line would break, nor weights of cells, which give way
        // there.
        let net = surface.hull.surface();
        let plain = plain_energy(net.u(), net.v(), surface.order, ANISOTROPY);
        let smoother = Smoother::new(&Model { start: None, energy: plain, ..surface.model.clone() });
        let lambda = match weight {
            Some(weight) => weight / smoother.unit,
            None => smoother.for_discrepancy(noise)?,
        };
        let smoothed = smoother.at(lambda)?;
        let rms = (smoothed.rss / smoother.count().max(1) as f64).sqrt();
        let weight = lambda * smoother.unit;
        Ok([rms, smoothed.rss + weight * smoothed.energy, weight])
    };
    let without = of(hull, None, breaks)?;
    let mut list = Vec::with_capacity(lines.len());
    for (k, line) in lines.iter().enumerate() {
        let accepted = accepted.has(k + 1);
        let mut proposal = Proposal { number: k + 1, line: *line, rms: None, gain: None, accepted };
        if let Some(lined) = with_line(hull, line)? {
            let mut broken = breaks.clone();
            add_lines(&lined, std::iter::once(line), &mut broken);
            let with = match of(&lined, Some(without[2]), &broken) {
                // Beyond the line there are too few offsets.
                Err(FairError::Undetermined(_)) => None,
                with => Some(with?),
            };
            proposal.rms = with.map(|with| [without[0], with[0]]);
            proposal.gain = with.map(|with| (without[1] - with[1]) / (noise * noise));
        }
        proposal.accepted &= proposal.rms.is_some();
        list.push(proposal);
    }
    Ok(list)
}
