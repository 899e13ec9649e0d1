//! The direction around the section: bands between the lines, their share of v and their knots, and the curve of each
//! station.
//!
//! In a band z = z_a + (z_b - z_a) zeta, with zeta = t or, at a round keel, zeta = t^2 for t from 0 to 1: there y ~
//! sqrt(z - z_keel) is smooth in t. A station that leaves the keel, or a knuckle at which such a band begins, straight
//! has dy/dt = 0 there, and is told so. The knots of a band are common to all stations and so fine that no span holds
//! two given points of one station; every station then meets all its points with the least bending (`spline::Energy` of
//! the second derivative). Where a line is a knuckle the bands on its sides are independent; where it is none at a
//! station, or a tangent line, one curve runs through, and gives both bands value and slope there.

use super::lines::Line;
use super::profile::{Profile, SectionPoint};
use crate::hull::cell::LineKind;
use crate::spline::{BsplineCurve, Condition, Energy, KnotVector, SplineError};

const DEGREE: usize = super::length::DEGREE;

/// The order of the derivative whose square is least.
const ORDER: usize = 2;

/// Exponents below this are round keels.
const ROUND: f64 = 0.75;

/// Fewest spans of a band with points inside.
const LEAST_SPANS: usize = 4;

/// A band between two lines.
#[derive(Debug, Clone)]
pub(super) struct Band {
    /// v on its lower line.
    pub(super) from: f64,
    /// v on its upper line.
    pub(super) to: f64,
    /// zeta = t^2.
    pub(super) round: bool,
    /// Clamped knots over [from, to].
    pub(super) knots: KnotVector,
}

/// Share of a band's height at the share `zeta` of its parameter and back.
fn parameter(round: bool, zeta: f64) -> f64 {
    let zeta = zeta.clamp(0.0, 1.0);
    if round { zeta.sqrt() } else { zeta }
}

impl Band {
    /// v at the share `zeta` of the height.
    pub(super) fn v(&self, zeta: f64) -> f64 {
        self.from + (self.to - self.from) * parameter(self.round, zeta)
    }

    /// The control values of zeta, exactly: blossoms of t or t^2.
    pub(super) fn control_shares(&self) -> Vec<f64> {
        let share = |v: f64| (v - self.from) / (self.to - self.from);
        (0..self.knots.basis_count())
            .map(|i| {
                let t = &self.knots.knots()[i + 1..=i + 3];
                let (a, b, c) = (share(t[0]), share(t[1]), share(t[2]));
                if self.round { (a * b + b * c + c * a) / 3.0 } else { (a + b + c) / 3.0 }
            })
            .collect()
    }
}

/// Heights of keel, lines and upper edge at a station.
pub(super) fn levels(profile: &Profile, lines: &[Line], station: usize) -> Vec<f64> {
    let mut levels = vec![profile.keel()];
    levels.extend(lines.iter().map(|line| line.z[station]));
    levels.push(profile.top());
    levels
}

/// The bands of a hull.
pub(super) fn bands(profiles: &[Profile], lines: &[Line], slack: f64) -> Result<Vec<Band>, SplineError> {
    let count = lines.len() + 1;
    let mut lengths = vec![0.0; count];
    // Shares of zeta of the points inside, by band and station.
    let mut inside: Vec<Vec<Vec<f64>>> = vec![vec![Vec::new(); profiles.len()]; count];
    for (k, profile) in profiles.iter().enumerate() {
        let levels = levels(profile, lines, k);
        for j in 0..count {
            let (a, b) = (levels[j], levels[j + 1]);
            let width = |z: f64| breadth_at(&profile.points, z);
            lengths[j] += (b - a).hypot(width(b) - width(a));
            let points = profile.points.iter().filter(|p| p.y.is_some() && p.z > a + slack && p.z < b - slack);
            inside[j][k].extend(points.map(|p| (p.z - a) / (b - a)));
        }
    }
    let total: f64 = lengths.iter().sum();
    let mut result = Vec::new();
    let mut from = 0.0;
    let shares: Vec<f64> = lengths.iter().map(|l| (l / total).max(0.02)).collect();
    let all: f64 = shares.iter().sum();
    for j in 0..count {
        let to = if j + 1 == count { 1.0 } else { from + shares[j] / all };
        let round = is_round(profiles, lines, j, slack);
        let sites: Vec<Vec<f64>> =
            inside[j].iter().map(|shares| shares.iter().map(|&s| parameter(round, s)).collect()).collect();
        let breakpoints: Vec<f64> = breakpoints(&sites).iter().map(|t| from + (to - from) * t).collect();
        let knots = KnotVector::from_breakpoints(DEGREE, &breakpoints, &vec![1; breakpoints.len() - 2])?;
        result.push(Band { from, to, round, knots });
        from = to;
    }
    Ok(result)
}

/// Half-breadth at a height, linear between the points.
fn breadth_at(points: &[SectionPoint], z: f64) -> f64 {
    let known: Vec<(f64, f64)> = points.iter().filter_map(|p| Some((p.z, p.y?))).collect();
    let above = known.partition_point(|p| p.0 < z);
    match (above.checked_sub(1).and_then(|k| known.get(k)), known.get(above)) {
        (Some(a), Some(b)) => a.1 + (b.1 - a.1) * (z - a.0) / (b.0 - a.0),
        (Some(a), None) | (None, Some(a)) => a.1,
        (None, None) => 0.0,
    }
}

/// The exponent e in y - y_keel ~ (z - z_keel)^e through the two lowest points of a section: 1/2 at a round keel, 1 at
/// a V; none where there are none between the keel and `ceiling`.
fn exponent(profile: &Profile, ceiling: f64) -> Option<f64> {
    let [keel, first, second, ..] = profile.points[..] else { return None };
    let rise = |p: SectionPoint| Some((p.z - keel.z, p.y? - keel.y?));
    let ((z1, y1), (z2, y2)) = (rise(first)?, rise(second)?);
    (second.z <= ceiling && y1 > 0.0 && y2 > y1).then(|| (y2 / y1).ln() / (z2 / z1).ln())
}

/// Whether a section leaves its keel round rather than straight.
fn leaves_round(profile: &Profile, ceiling: f64) -> bool {
    exponent(profile, ceiling).is_some_and(|e| e < ROUND)
}

/// Whether the band has stations that leave the keel in it, round in the median.
fn is_round(profiles: &[Profile], lines: &[Line], band: usize, slack: f64) -> bool {
    let mut exponents: Vec<f64> = profiles
        .iter()
        .enumerate()
        .filter_map(|(k, profile)| {
            let levels = levels(profile, lines, k);
            let starts = levels[band] - levels[0] <= slack && levels[band + 1] - levels[band] > slack;
            if starts { exponent(profile, levels[band + 1] + slack) } else { None }
        })
        .collect();
    exponents.sort_by(f64::total_cmp);
    exponents.get(exponents.len() / 2).is_some_and(|&e| e < ROUND)
}

/// The fewest breakpoints from 0 to 1 that part any two successive points of a station, the ends included, and spans
/// enough.
fn breakpoints(sites: &[Vec<f64>]) -> Vec<f64> {
    let mut gaps: Vec<[f64; 2]> = Vec::new();
    for own in sites.iter().filter(|own| !own.is_empty()) {
        let ends = [0.0].into_iter().chain(own.iter().copied()).chain([1.0]);
        let ends: Vec<f64> = ends.collect();
        gaps.extend(ends.windows(2).filter(|w| w[1] > w[0]).map(|w| [w[0], w[1]]));
    }
    gaps.sort_by(|a, b| a[1].total_cmp(&b[1]));
    let mut result = vec![0.0];
    let mut common: Option<[f64; 2]> = None;
    for [low, high] in gaps {
        match &mut common {
            Some([from, to]) if low < *to => *from = from.max(low),
            _ => {
                result.extend(common.map(|[from, to]| 0.5 * (from + to)));
                common = Some([low, high]);
            }
        }
    }
    result.extend(common.map(|[from, to]| 0.5 * (from + to)));
    result.push(1.0);
    if result.len() == 2 {
        return result;
    }
    // Halve the widest spans until there are enough.
    while result.len() <= LEAST_SPANS {
        let widest = (1..result.len())
            .max_by(|&a, &b| (result[a] - result[a - 1]).total_cmp(&(result[b] - result[b - 1])))
            .unwrap_or(1);
        result.insert(widest, 0.5 * (result[widest - 1] + result[widest]));
    }
    result
}

/// What is known of a station on a line: half-breadth, and slope dy/dz where the curve runs through.
#[derive(Debug, Clone, Copy, Default)]
struct OnLine {
    y: Option<f64>,
    slope: Option<f64>,
}

/// The control half-breadths of the station's curve, all bands one after the other, each with both its ends.
pub(super) fn station_curve(
    profile: &Profile,
    lines: &[Line],
    bands: &[Band],
    station: usize,
    slack: f64,
) -> Result<Vec<Vec<f64>>, SplineError> {
    let levels = levels(profile, lines, station);
    let last = levels.len() - 1;
    let mut on: Vec<OnLine> = vec![OnLine::default(); levels.len()];
    for (j, &level) in levels.iter().enumerate() {
        let own = profile.points.iter().find(|p| (p.z - level).abs() <= slack).and_then(|p| p.y);
        let line = (1..last).contains(&j).then(|| lines[j - 1].y[station]).flatten();
        on[j].y = own.or(line);
    }
    let hard =
        |j: usize| j == 0 || j == last || (lines[j - 1].kind == LineKind::Knuckle && lines[j - 1].y[station].is_some());
    let mut start = 0;
    for end in 1..=last {
        if !hard(end) {
            continue;
        }
        if end - start > 1 {
            run_through(profile, lines, station, &levels[start..=end], &mut on[start..=end], start, slack)?;
        }
        start = end;
    }
    // Above the lower edge of a flat of side nothing changes.
    for j in 1..last {
        let tangent = lines[j - 1].kind == LineKind::Tangent && lines[j - 1].y[station].is_some();
        let mut above = profile.points.iter().filter(|p| p.z > levels[j] + slack).filter_map(|p| p.y).peekable();
        if tangent && above.peek().is_some() && on[j].y.is_some_and(|y| above.all(|p| (p - y).abs() <= slack)) {
            on[j].slope = Some(0.0);
        }
    }
    bands
        .iter()
        .enumerate()
        .map(|(j, band)| band_curve(profile, band, [levels[j], levels[j + 1]], [on[j], on[j + 1]], slack))
        .collect()
}

/// Points strictly between two heights, as shares of the height and half-breadths.
fn between(points: &[SectionPoint], [a, b]: [f64; 2], slack: f64) -> Vec<(f64, f64)> {
    let inner = points.iter().filter(|p| p.z > a + slack && p.z < b - slack);
    inner.filter_map(|p| Some(((p.z - a) / (b - a), p.y?))).collect()
}

/// One curve over several bands: half-breadths and slopes on the lines that it crosses.
fn run_through(
    profile: &Profile,
    lines: &[Line],
    station: usize,
    levels: &[f64],
    on: &mut [OnLine],
    first: usize,
    slack: f64,
) -> Result<(), SplineError> {
    let last = levels.len() - 1;
    let (a, b) = (levels[0], levels[last]);
    let round = a - profile.keel() <= slack && leaves_round(profile, b + slack);
    if b - a <= slack {
        return Ok(());
    }
    let share = |z: f64| (z - a) / (b - a);
    let mut data = between(&profile.points, [a, b], slack);
    let mut corners = Vec::new();
    for j in 1..last {
        let line = &lines[first + j - 1];
        if let Some(y) = on[j].y
            && levels[j] > a + slack
            && levels[j] < b - slack
        {
            if !data.iter().any(|d| (d.0 - share(levels[j])).abs() * (b - a) <= slack) {
                data.push((share(levels[j]), y));
            }
            if line.kind == LineKind::Tangent && line.y[station].is_some() {
                corners.push(parameter(round, share(levels[j])));
            }
        }
    }
    data.sort_by(|p, q| p.0.total_cmp(&q.0));
    let data: Vec<(f64, f64)> = data.into_iter().map(|(s, y)| (parameter(round, s), y)).collect();
    let mut breaks = breakpoints(&[data.iter().map(|d| d.0).collect()]);
    breaks.extend(&corners);
    breaks.sort_by(f64::total_cmp);
    breaks.dedup_by(|a, b| *a - *b <= 1e-9);
    let times: Vec<usize> = breaks[1..breaks.len() - 1]
        .iter()
        .map(|t| if corners.iter().any(|c| (c - t).abs() <= 1e-9) { DEGREE - 1 } else { 1 })
        .collect();
    let knots = KnotVector::from_breakpoints(DEGREE, &breaks, &times)?;
    let curve = least_bending(&knots, &data, [on[0].y, on[last].y], [None; 2])?;
    let curve = BsplineCurve::new(knots, curve.into_iter().map(|y| [y]).collect())?;
    for j in 1..last {
        let zeta = share(levels[j]).clamp(0.0, 1.0);
        let t = parameter(round, zeta);
        let [value, slope] = curve.derivatives::<2>(t);
        on[j].y = Some(on[j].y.unwrap_or(value[0]));
        // dz/dt = 2 t (b - a) or b - a; on a round keel itself the slope is infinite.
        let rate = if round { 2.0 * t * (b - a) } else { b - a };
        on[j].slope = (rate > 1e-6 * (b - a)).then(|| slope[0] / rate);
    }
    Ok(())
}

/// The control half-breadths of one band of a station.
fn band_curve(
    profile: &Profile,
    band: &Band,
    [a, b]: [f64; 2],
    ends: [OnLine; 2],
    slack: f64,
) -> Result<Vec<f64>, SplineError> {
    let count = band.knots.basis_count();
    if b - a <= slack {
        // A band without height is a point of the section.
        let y = ends[0].y.or(ends[1].y).unwrap_or(0.0);
        return Ok(vec![y; count]);
    }
    let data: Vec<(f64, f64)> =
        between(&profile.points, [a, b], slack).into_iter().map(|(s, y)| (band.v(s), y)).collect();
    let width = band.to - band.from;
    // dz/dv at the ends of the band.
    let rates = if band.round { [0.0, 2.0 * (b - a) / width] } else { [(b - a) / width; 2] };
    // Where the parameter stands still (rate 0) only a round keel has dy/dv other than 0.
    let straight = band.round && !(a - profile.keel() <= slack && leaves_round(profile, b + slack));
    let slope = |k: usize| match ends[k].slope {
        Some(slope) if rates[k] > 0.0 => Some(slope * rates[k]),
        _ => (k == 0 && straight).then_some(0.0),
    };
    least_bending(&band.knots, &data, [ends[0].y, ends[1].y], [slope(0), slope(1)])
}

/// The spline of least bending through `data` (sites inside, rising) and what is given at the ends. With fewer than two
/// values it is constant.
fn least_bending(
    knots: &KnotVector,
    data: &[(f64, f64)],
    values: [Option<f64>; 2],
    slopes: [Option<f64>; 2],
) -> Result<Vec<f64>, SplineError> {
    let ends: [f64; 2] = knots.domain().into();
    let mut conditions = Vec::new();
    let mut right = Vec::new();
    let mut add = |site: f64, order: usize, value: f64| {
        conditions.push(Condition { site, order });
        right.push(value);
    };
    for k in 0..2 {
        if k == 1 {
            data.iter().for_each(|&(site, y)| add(site, 0, y));
        }
        if let Some(y) = values[k] {
            add(ends[k], 0, y);
        }
        if let Some(slope) = slopes[k] {
            add(ends[k], 1, slope);
        }
    }
    if right.len() < 2 {
        return Ok(vec![right.first().copied().unwrap_or(0.0); knots.basis_count()]);
    }
    Ok(Energy::new(knots, ORDER).interpolation(&conditions)?.solve(&right))
}
