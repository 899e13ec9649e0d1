//! The level chart: z(v), the profiles x_stern(v) and x_stem(v), and x(u, v) between them.
//!
//! x(u, v) = s + (e - s) u + (stern(v) - s) A(u) + (stem(v) - e) F(u), with A = (1 - u/ua)^3 up to ua,
//! F = ((u - uf)/(1 - uf))^3 from uf, 0 beyond. s is the foremost point of the stern profile and e the aftmost one of
//! the stem profile, so that both cubes only lengthen the shortest waterline: x_u >= e - s > 0, and so for the net. In
//! the middle stations are lines u = constant. Cubes and line lie in the cubic spline space of u: the net is exact.
//!
//! v runs like the girth of the sections (mean over the stations of the chord lengths between waterlines), and dz/dv =
//! 0 at the bottom where it is flat and a bilge leaves it, so that y(v) is smooth where dy/dz is infinite.

use super::super::HullError;
use super::FitError;
use super::bounded::{carried, with_knots};
use crate::spline::{Collocation, Condition, Energy, KnotVector, SplineError};

/// Shoulders of the cubes.
pub(super) const SHOULDERS: [f64; 2] = [0.4, 0.6];

/// x over u between given profiles.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Span {
    /// Line and cubes: the foremost point of the stern profile and the aftmost of the stem profile \[m\].
    Cubes([f64; 2]),
    /// x = stern (1 - u) + stem u, where the two profiles overlap in x.
    Blend,
}

/// The cubes A and F and their slopes.
fn cubes(u: f64) -> [(f64, f64); 2] {
    let [ua, uf] = SHOULDERS;
    let (a, f) = ((1.0 - u / ua).max(0.0), ((u - uf) / (1.0 - uf)).max(0.0));
    [(a * a * a, -3.0 * a * a / ua), (f * f * f, 3.0 * f * f / (1.0 - uf))]
}

impl Span {
    /// For profiles with control values `stern` and `stem`.
    pub(super) fn new(stern: &[f64], stem: &[f64]) -> Self {
        /// Least part of the whole length that the shortest line may have for the cubes.
        const LEAST: f64 = 1e-3;
        let most = |x: &[f64]| x.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let least = |x: &[f64]| x.iter().copied().fold(f64::INFINITY, f64::min);
        let inner = [most(stern), least(stem)];
        if inner[1] - inner[0] > LEAST * (most(stem) - least(stern)) { Self::Cubes(inner) } else { Self::Blend }
    }

    /// x and dx/du at `u` on a waterline between `ends`.
    pub(super) fn x(&self, u: f64, ends: [f64; 2]) -> (f64, f64) {
        match *self {
            Self::Cubes([s, e]) => {
                let [(a, da), (f, df)] = cubes(u);
                (
                    s + (e - s) * u + (ends[0] - s) * a + (ends[1] - e) * f,
                    e - s + (ends[0] - s) * da + (ends[1] - e) * df,
                )
            }
            Self::Blend => (ends[0] + (ends[1] - ends[0]) * u, ends[1] - ends[0]),
        }
    }

    /// dx / d(stern) at `u`: how far a waterline moves there when its stern end moves.
    pub(super) fn share_of_stern(&self, u: f64) -> f64 {
        match self {
            Self::Cubes(_) => cubes(u)[0].0,
            Self::Blend => 1.0 - u,
        }
    }

    /// u at `x` on a waterline between `ends`, to rounding.
    pub(super) fn u(&self, x: f64, ends: [f64; 2]) -> f64 {
        let (mut low, mut high) = (0.0, 1.0);
        let mut u = ((x - ends[0]) / (ends[1] - ends[0])).clamp(0.0, 1.0);
        for _ in 0..100 {
            let (value, slope) = self.x(u, ends);
            if value > x {
                high = u;
            } else {
                low = u;
            }
            let newton = u - (value - x) / slope;
            let next = if newton > low && newton < high { newton } else { 0.5 * (low + high) };
            if (next - u).abs() <= 2.0 * f64::EPSILON {
                return next;
            }
            u = next;
        }
        u
    }
}

/// A monotone z(v) over knots that hold one site a waterline.
#[derive(Debug, Clone)]
pub(super) struct Heights {
    /// Knots in v, 0 to 1.
    pub(super) knots: KnotVector,
    /// v of each waterline.
    pub(super) sites: Vec<f64>,
    /// Control values of z \[m\].
    pub(super) z: Vec<f64>,
}

impl Heights {
    /// The same z(v) with more knots at `middles`, exactly.
    pub(super) fn refined(&self, middles: Vec<f64>) -> Result<Self, FitError> {
        self.on(with_knots(&self.knots, middles)?)
    }

    /// The same z(v) over `knots`, which hold all of its own, exactly.
    pub(super) fn on(&self, knots: KnotVector) -> Result<Self, FitError> {
        Ok(Self { z: carried(&self.knots, &self.z, &knots)?, knots, sites: self.sites.clone() })
    }

    /// v at the height `z` \[m\], to rounding; the nearer end beyond the heights.
    pub(super) fn parameter(&self, z: f64) -> f64 {
        let (mut low, mut high) = self.knots.domain();
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            let span = self.knots.find_span(middle);
            let [basis] = self.knots.basis_derivatives::<1>(span, middle);
            let first = span - self.knots.degree();
            let at: f64 = basis.iter().zip(&self.z[first..=span]).map(|(b, z)| b * z).sum();
            if at < z { low = middle } else { high = middle }
        }
        0.5 * (low + high)
    }
}

/// Knots through `sites` (0 to 1, rising) for cubics: the sites, each as often as `times` says.
fn knots_at(sites: &[f64], times: &[usize]) -> Result<KnotVector, SplineError> {
    KnotVector::from_breakpoints(3, sites, &times[1..sites.len() - 1])
}

/// z(v) for waterlines at heights `z` with the mean chord lengths `girths` between them and `times`-fold knots on them;
/// `blunt` where a bilge leaves a flat bottom. Ever less of the chord lengths and more of the heights until z rises with v.
pub(super) fn heights(z: &[f64], girths: &[f64], times: &[usize], blunt: bool) -> Result<Heights, FitError> {
    const STEPS: u32 = 8;
    let total: f64 = girths.iter().sum();
    let rise = z[z.len() - 1] - z[0];
    for step in 0..=STEPS {
        let share = f64::from(step) / f64::from(STEPS);
        let mut sites = vec![0.0];
        for (k, girth) in girths.iter().enumerate() {
            let part = (1.0 - share) * girth / total + share * (z[k + 1] - z[k]) / rise;
            sites.push(sites[k] + part);
        }
        let end = sites[sites.len() - 1];
        sites.iter_mut().for_each(|v| *v /= end);
        if let Some(last) = sites.last_mut() {
            *last = 1.0;
        }
        let knots = knots_at(&sites, times).map_err(HullError::from)?;
        let mut conditions: Vec<Condition> = sites.iter().map(|&site| Condition { site, order: 0 }).collect();
        let mut data = z.to_vec();
        if blunt && step < STEPS {
            conditions.push(Condition { site: 0.0, order: 1 });
            data.push(0.0);
        }
        let Ok(problem) = Energy::new(&knots, 2).interpolation(&conditions) else { continue };
        let mut control = problem.solve(&data);
        let last = control.len() - 1;
        (control[0], control[last]) = (z[0], z[z.len() - 1]);
        if blunt && step < STEPS {
            control[1] = control[0];
        }
        if control.windows(2).all(|w| w[1] >= w[0]) {
            return Ok(Heights { knots, sites, z: control });
        }
    }
    // Straight pieces always rise.
    let mut sites: Vec<f64> = z.iter().map(|z0| (z0 - z[0]) / rise).collect();
    if let Some(last) = sites.last_mut() {
        *last = 1.0;
    }
    let knots = knots_at(&sites, times).map_err(HullError::from)?;
    let control = knots.greville().iter().map(|v| z[0] + rise * v).collect();
    Ok(Heights { knots, sites, z: control })
}

/// The net of x, one list a column in v, for profiles with control values `stern` and `stem`.
pub(super) fn lengths(u: &KnotVector, span: Span, stern: &[f64], stem: &[f64]) -> Result<Vec<Vec<f64>>, FitError> {
    let sites = u.greville();
    let matrix = Collocation::new(u, &sites).map_err(HullError::from)?;
    let mut parts: [Vec<f64>; 2] = [0, 1].map(|k| sites.iter().map(|&t| cubes(t)[k].0).collect());
    parts.iter_mut().for_each(|p| matrix.solve(p));
    let column = |(&aft, &fore): (&f64, &f64)| match span {
        Span::Cubes([s, e]) => (0..sites.len())
            .map(|i| s + (e - s) * sites[i] + (aft - s) * parts[0][i] + (fore - e) * parts[1][i])
            .collect(),
        Span::Blend => sites.iter().map(|t| aft * (1.0 - t) + fore * t).collect(),
    };
    Ok(stern.iter().zip(stem).map(column).collect())
}

/// Knots in u on which every waterline, with sites `rows` in (0, 1), has at most one site a span; the shoulders are
/// knots.
pub(super) fn length_knots(rows: &[Vec<f64>]) -> Result<KnotVector, FitError> {
    let mut gaps: Vec<[f64; 2]> = Vec::new();
    for row in rows {
        let ends = || std::iter::once(0.0).chain(row.iter().copied());
        gaps.extend(ends().zip(row.iter().copied().chain([1.0])).map(|(a, b)| [a, b]));
    }
    gaps.sort_by(|a, b| a[1].total_cmp(&b[1]).then(a[0].total_cmp(&b[0])));
    let mut breaks = vec![0.0];
    for [low, high] in gaps {
        // A knot in (low, high]; the end of the domain serves the last gaps.
        if breaks[breaks.len() - 1] <= low && high < 1.0 - 1e-9 {
            breaks.push(high);
        }
    }
    breaks.push(1.0);
    for shoulder in SHOULDERS {
        let place = breaks.partition_point(|&b| b < shoulder);
        let near = [place.wrapping_sub(1), place]
            .into_iter()
            .any(|k| breaks.get(k).is_some_and(|b| (b - shoulder).abs() < 1e-12));
        if !near {
            breaks.insert(place, shoulder);
        }
    }
    let last = breaks.len() - 1;
    Ok(KnotVector::from_breakpoints(3, &breaks, &vec![1; last - 1]).map_err(HullError::from)?)
}
