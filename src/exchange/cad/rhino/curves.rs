//! Curves of an archive: lines, arcs, polylines, splines, and curves of these.

use std::f64::consts::FRAC_PI_2;

use super::super::surfaces::{MOST_POINTS, spline_curve};
use super::chunks::class;
use super::cursor::{Cursor, Object};
use crate::exchange::fault::Faults;
use crate::hull::{Conic, SpaceCurve};
use crate::spline::{BsplineCurve, KnotVector};

/// Curves of curves, at most.
const DEEPEST: usize = 8;

/// A curve with the ends of its parameter in the file, and those of ours.
#[derive(Debug, Clone)]
pub(super) struct Run {
    pub(super) curve: SpaceCurve,
    pub(super) domain: [f64; 2],
    pub(super) range: [f64; 2],
}

impl Run {
    /// Our parameter for one of the file.
    pub(super) fn parameter(&self, t: f64) -> f64 {
        let ([a, b], [from, to]) = (self.domain, self.range);
        from + (t - a) / (b - a) * (to - from)
    }
}

/// A plane of an archive: its origin, x and y; z and its equation follow from them.
pub(super) fn plane(data: &mut Cursor<'_>) -> Option<[[f64; 3]; 3]> {
    let [ox, oy, oz, ax, ay, az, bx, by, bz, ..] = data.reals::<16>()?;
    Some([[ox, oy, oz], [ax, ay, az], [bx, by, bz]])
}

/// Two numbers of which the second is the larger one.
pub(super) fn interval(data: &mut Cursor<'_>) -> Option<[f64; 2]> {
    data.reals().filter(|[a, b]| a < b)
}

/// The number of control points and the knots of a spline with the first and the last, which files leave out.
pub(super) fn knots(data: &mut Cursor<'_>) -> Option<Vec<f64>> {
    let mut own = data.list()?;
    let (&first, &last) = (own.first()?, own.last()?);
    own.insert(0, first);
    own.push(last);
    Some(own)
}

/// Control points as weights and points, in space or in a plane; of rational ones files have (w x, w y, w z, w).
pub(super) fn net(data: &mut Cursor<'_>, [spatial, rational]: [bool; 2], count: usize) -> Option<Vec<(f64, [f64; 3])>> {
    let stated = data.count(8 * (2 + usize::from(spatial) + usize::from(rational)))?;
    let point = |data: &mut Cursor<'_>| {
        let [x, y] = data.reals()?;
        let z = if spatial { data.real()? } else { 0.0 };
        let w = if rational { data.real().filter(|w| *w > 0.0)? } else { 1.0 };
        Some((w, [x / w, y / w, z / w]))
    };
    let all: Option<Vec<_>> = (0..stated).map(|_| point(data)).collect();
    all.filter(|all| all.len() == count)
}

/// Reads curves, up to a number of control points.
#[derive(Debug, Default)]
pub(super) struct Budget {
    points: usize,
}

impl Budget {
    /// Whether so many points more are read.
    pub(super) fn allows(&mut self, count: usize) -> bool {
        self.points = self.points.saturating_add(count);
        self.points <= MOST_POINTS
    }

    /// A curve; none where its kind is not read.
    pub(super) fn curve(&mut self, object: &Object<'_>) -> Option<Run> {
        self.nested(object, 0)
    }

    fn nested(&mut self, object: &Object<'_>, depth: usize) -> Option<Run> {
        let mut data = object.data.inside;
        match object.class {
            class::LINE_CURVE => line(&mut data),
            class::ARC_CURVE => arc(&mut data),
            class::NURBS_CURVE => self.spline(&mut data),
            class::POLYLINE_CURVE => self.polyline(&mut data),
            class::POLY_CURVE if depth < DEEPEST => self.joined(&mut data, depth),
            _ => None,
        }
    }

    fn spline(&mut self, data: &mut Cursor<'_>) -> Option<Run> {
        let [1, _] = data.version()? else { return None };
        let (dimension, rational) = (data.int()?, data.int()? != 0);
        let [order, count] = [data.int()?, data.int()?].map(usize::try_from);
        let (order, count) = (order.ok()?, count.ok()?);
        data.take(8)?;
        data.take(48)?;
        if !matches!(dimension, 2 | 3) || order < 2 || !self.allows(count) {
            return None;
        }
        let knots = knots(data)?;
        let net = net(data, [dimension == 3, rational], count)?;
        let made = spline_curve(&mut Faults::default(), 0, "", order - 1, knots, net.into_iter())?;
        let ends = made.knots().domain().into();
        Some(Run { curve: SpaceCurve::Spline(made), domain: ends, range: ends })
    }

    fn polyline(&mut self, data: &mut Cursor<'_>) -> Option<Run> {
        let [1, _] = data.version()? else { return None };
        let count = data.count(24)?;
        if !self.allows(count) {
            return None;
        }
        let points: Option<Vec<[f64; 3]>> = (0..count).map(|_| data.reals()).collect();
        let breaks = data.list()?;
        let net: Vec<[f64; 4]> = points?.into_iter().map(|[x, y, z]| [x, y, z, 1.0]).collect();
        let knots = KnotVector::from_breakpoints(1, &breaks, &vec![1; breaks.len().checked_sub(2)?]).ok()?;
        let ends = knots.domain().into();
        let made = BsplineCurve::new(knots, net).ok()?;
        Some(Run { curve: SpaceCurve::Spline(made), domain: ends, range: ends })
    }

    /// The curves of a curve of curves.
    pub(super) fn parts(&mut self, object: &Object<'_>) -> Option<Vec<Run>> {
        let is_sound = object.class == class::POLY_CURVE;
        is_sound.then(|| self.segments(&mut { object.data.inside }, 0)).flatten().map(|(runs, _)| runs)
    }

    /// The same with the values of the parameter where they meet.
    fn segments(&mut self, data: &mut Cursor<'_>, depth: usize) -> Option<(Vec<Run>, Vec<f64>)> {
        data.version()?;
        // Each is a chunk with at least 60 bytes.
        let count = data.count(60)?;
        data.take(8 + 48)?;
        let breaks = data.list()?;
        let mut runs = Vec::new();
        for _ in 0..count {
            runs.push(self.nested(&data.object()?, depth + 1)?);
        }
        Some((runs, breaks))
    }

    /// A curve of curves as one spline.
    fn joined(&mut self, data: &mut Cursor<'_>, depth: usize) -> Option<Run> {
        let (runs, breaks) = self.segments(data, depth)?;
        let parts: Vec<BsplineCurve<4>> = runs.iter().map(as_spline).collect::<Option<_>>()?;
        let curve = joined(&parts, &breaks)?;
        if !self.allows(curve.points().len()) {
            return None;
        }
        let ends = curve.knots().domain().into();
        Some(Run { curve: SpaceCurve::Spline(curve), domain: ends, range: ends })
    }
}

fn line(data: &mut Cursor<'_>) -> Option<Run> {
    let [1, _] = data.version()? else { return None };
    let (from, to) = (data.reals()?, data.reals()?);
    let domain = interval(data)?;
    Some(Run { curve: SpaceCurve::between(from, to), domain, range: [0.0, 1.0] })
}

fn arc(data: &mut Cursor<'_>) -> Option<Run> {
    let [1, _] = data.version()? else { return None };
    let [centre, x, y] = plane(data)?;
    let radius = data.real().filter(|radius| *radius > 0.0)?;
    data.reals::<9>()?;
    let range = interval(data)?;
    let domain = interval(data)?;
    Some(Run { curve: SpaceCurve::circle(centre, x, y, radius), domain, range })
}

/// The rational spline of a curve between its ends; of conics those of ellipses alone, by arcs of a quarter at most:
/// (w x, w y, w z, w) with w = cos(a/2) at the corner between two ends that are an angle a apart.
pub(super) fn as_spline(Run { curve, range: [from, to], .. }: &Run) -> Option<BsplineCurve<4>> {
    let weighted = |[x, y, z]: [f64; 3], w: f64| [w * x, w * y, w * z, w];
    match curve {
        SpaceCurve::Line { .. } => {
            let ends = [*from, *to].map(|t| weighted(curve.point(t), 1.0));
            BsplineCurve::new(KnotVector::from_breakpoints(1, &[0.0, 1.0], &[]).ok()?, ends.to_vec()).ok()
        }
        SpaceCurve::Conic { kind: Conic::Ellipse, centre, x, y } => {
            let parts = ((to - from) / FRAC_PI_2 - 1e-9).ceil().clamp(1.0, 8.0) as usize;
            let step = (to - from) / parts as f64;
            let weight = (0.5 * step).cos();
            let mut points = vec![weighted(curve.point(*from), 1.0)];
            for k in 0..parts {
                let (middle, end) = (from + (k as f64 + 0.5) * step, from + (k as f64 + 1.0) * step);
                let (sine, cosine) = middle.sin_cos();
                let corner = [0, 1, 2].map(|i| centre[i] + (cosine * x[i] + sine * y[i]) / weight);
                points.extend([weighted(corner, weight), weighted(curve.point(end), 1.0)]);
            }
            let breaks: Vec<f64> = (0..=parts).map(|k| k as f64).collect();
            let knots = KnotVector::from_breakpoints(2, &breaks, &vec![2; parts - 1]).ok()?;
            BsplineCurve::new(knots, points).ok()
        }
        SpaceCurve::Conic { .. } => None,
        SpaceCurve::Spline(spline) => Some(spline.clone()),
    }
}

/// Splines end to end as one whose parameter has the given values where they meet; none where their number does not fit.
fn joined(parts: &[BsplineCurve<4>], breaks: &[f64]) -> Option<BsplineCurve<4>> {
    if parts.is_empty() || breaks.len() != parts.len() + 1 {
        return None;
    }
    let degree = parts.iter().map(|part| part.knots().degree()).max()?;
    let (mut knots, mut points) = (vec![breaks[0]; degree + 1], Vec::<[f64; 4]>::new());
    for (part, ends) in parts.iter().zip(breaks.windows(2)) {
        let part = part.elevate(degree - part.knots().degree()).ok()?;
        let (a, b) = part.knots().domain();
        let own = part.knots().knots();
        let inner = own[degree + 1..own.len() - degree - 1].iter();
        knots.extend(inner.map(|t| ends[0] + (t - a) / (b - a) * (ends[1] - ends[0])));
        knots.extend(vec![ends[1]; degree]);
        // Its first point is the last one of the part before it, whose weight it takes.
        let scale = points.last().map_or(1.0, |last| last[3] / part.points()[0][3]);
        let skip = usize::from(!points.is_empty());
        points.extend(part.points()[skip..].iter().map(|point| point.map(|c| scale * c)));
    }
    knots.extend(breaks.last());
    BsplineCurve::new(KnotVector::new(degree, knots).ok()?, points).ok()
}
