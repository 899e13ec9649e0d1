//! Curvature of stations and waterlines as linear forms of the half-breadths.
//!
//! A station is the line x(u, v) = X of the chart. With dv = 1, du = a = -x_v / x_u and u'' = a a_u + a_v along it,
//!
//! ```text
//! y'  = a y_u + y_v,      y'' = a^2 y_uu + 2 a y_uv + y_vv + u'' y_u,      z' and z'' likewise,
//! kappa = (z' y'' - z'' y') / (z'^2 + y'^2)^(3/2):
//! ```
//!
//! the chart is fixed, so that the numerator is linear in the net of y and its sign is the sign of curvature, without
//! approximation. Waterlines are the same with u and v, x and z exchanged.

use super::model::{Limit, Row, value};
use super::surface::{FairSurface, basis_row};
use crate::hull::Cut;
use crate::spline::{BsplineSurface, KnotVector};

/// Points of a line in a span of the knots across it: the second derivative of a cubic is straight there, so that its
/// ends count.
const PLACES: [f64; 3] = [0.01, 0.5, 0.99];

/// The same of stations whose heights do not run on evenly: z' y'' - z'' y' of two cubics is a parabola there.
const PLACES_UPRIGHT: [f64; 5] = [0.01, 0.25, 0.5, 0.75, 0.99];

/// The same where the line runs across the other lines of the net: its second derivative is no straight line.
const PLACES_ACROSS: [f64; 7] = [0.01, 0.17, 0.33, 0.5, 0.67, 0.83, 0.99];

/// Curvature below this part of the largest of the line is none.
pub const DEAD: f64 = 0.01;

/// A line that leaves its chord by less is straight \[m\].
const STRAIGHT: f64 = 1e-5;

/// A line stands still where it runs on by less than this part of its greatest speed.
const STILL: f64 = 1e-6;

/// Part of the dead band that limits of signs leave open: without it they touch wherever a line is straight, and
/// nothing lies strictly within them all.
const ROOM: f64 = 0.01;

/// A line of the ship's drawing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Line {
    /// The station at x \[m\].
    Station(f64),
    /// The waterline at z \[m\].
    Waterline(f64),
}

impl Line {
    /// The station or the waterline in a plane; none of other planes.
    #[must_use]
    pub fn of(cut: Cut) -> Option<Self> {
        match cut {
            Cut::Station { x } => Some(Self::Station(x)),
            Cut::Waterline { z } => Some(Self::Waterline(z)),
            _ => None,
        }
    }
}

/// The numerator of curvature at a point, and (x'^2 or z'^2, the form of y').
#[derive(Debug, Clone)]
pub struct Bend {
    /// z' y'' - z'' y' on a station, x' y'' - x'' y' on a waterline, over the net.
    pub numerator: Row,
    /// What the numerator has besides; 0 on stations and waterlines.
    pub offset: f64,
    /// y' over the net.
    pub slope: Row,
    /// z' or x' \[m\].
    pub along: f64,
    /// Where along the line: z of a station, x of a waterline \[m\].
    pub at: f64,
}

/// The bend of the station or the waterline through (u, v); none where the chart has no such line.
#[must_use]
pub fn bend(surface: &BsplineSurface<3>, at: [f64; 2], station: bool) -> Option<Bend> {
    let d = surface.derivatives::<3>(at[0], at[1]);
    // (s, t): the parameter that follows and the one that runs; held and along: the coordinate that stays and the one
    // that runs.
    let (held, along) = if station { (0, 2) } else { (2, 0) };
    let order = |s: usize, t: usize| if station { [s, t] } else { [t, s] };
    let c = |axis: usize, s: usize, t: usize| {
        let [a, b] = order(s, t);
        d[a][b][axis]
    };
    let steep = c(held, 1, 0);
    let level = c(held, 0, 1);
    // The line runs along the parameter itself where the held coordinate does not change with it.
    let (a, bent) = if level == 0.0 && c(held, 1, 1) == 0.0 && c(held, 0, 2) == 0.0 {
        (0.0, 0.0)
    } else if steep.abs() > 1e-9 * (steep.abs() + level.abs()) {
        let a = -level / steep;
        let by_s = -(c(held, 1, 1) * steep - level * c(held, 2, 0)) / (steep * steep);
        let by_t = -(c(held, 0, 2) * steep - level * c(held, 1, 1)) / (steep * steep);
        (a, a * by_s + by_t)
    } else {
        return None;
    };
    let first = a * c(along, 1, 0) + c(along, 0, 1);
    let second = a * a * c(along, 2, 0) + 2.0 * a * c(along, 1, 1) + c(along, 0, 2) + bent * c(along, 1, 0);
    let row = |s: usize, t: usize| basis_row(surface, at, order(s, t));
    let (s, t, ss, st, tt) = (row(1, 0), row(0, 1), row(2, 0), row(1, 1), row(0, 2));
    let (mut numerator, mut slope) = (Row::with_capacity(s.len()), Row::with_capacity(s.len()));
    for k in 0..s.len() {
        let dy = a * s[k].1 + t[k].1;
        let ddy = a * a * ss[k].1 + 2.0 * a * st[k].1 + tt[k].1 + bent * s[k].1;
        slope.push((s[k].0, dy));
        numerator.push((s[k].0, first * ddy - second * dy));
    }
    Some(Bend { numerator, offset: 0.0, slope, along: first, at: d[0][0][along] })
}

impl Bend {
    /// Curvature of the line for a net \[1/m\].
    #[must_use]
    pub fn curvature(&self, net: &[f64]) -> f64 {
        let speed = self.along.hypot(value(&self.slope, net));
        if speed > 0.0 { (value(&self.numerator, net) + self.offset) / speed.powi(3) } else { 0.0 }
    }
}

impl Bend {
    /// The limit that gives the numerator a sign, scaled to size 1, but for a part of the dead band about `none`
    /// \[1/m\], the curvature below which there is none, at the slopes of `net`; none where the line has no bend to
    /// give.
    #[must_use]
    pub fn limit(&self, positive: bool, net: &[f64], none: f64) -> Option<Limit> {
        let scaled = self.scaled(net, ROOM * none)?;
        let room = scaled.room;
        Some(scaled.limit(if positive { [-room, f64::INFINITY] } else { [f64::NEG_INFINITY, room] }))
    }

    /// The numerator scaled to size 1, with the room that a curvature has on it \[1/m\].
    pub(super) fn scaled(&self, net: &[f64], room: f64) -> Option<Scaled> {
        let size = self.numerator.iter().fold(0.0_f64, |size, (_, value)| size.max(value.abs()));
        let row = self.numerator.iter().map(|&(i, value)| (i, value / size)).collect();
        let room = room * self.along.hypot(value(&self.slope, net)).powi(3) / size;
        (size > 0.0).then_some(Scaled { row, offset: self.offset / size, room })
    }
}

/// A numerator scaled to size 1.
pub(super) struct Scaled {
    row: Row,
    offset: f64,
    pub(super) room: f64,
}

impl Scaled {
    pub(super) fn at(&self, net: &[f64]) -> f64 {
        value(&self.row, net) + self.offset
    }

    /// Limits of the numerator as limits of its row.
    pub(super) fn limit(self, [lower, upper]: [f64; 2]) -> Limit {
        Limit { lower: lower - self.offset, upper: upper - self.offset, row: self.row }
    }
}

/// Points inside the spans.
#[must_use]
pub fn sites(knots: &KnotVector) -> Vec<f64> {
    inside(knots, &PLACES)
}

/// Points at these parts of each span.
pub(super) fn inside(knots: &KnotVector, places: &[f64]) -> Vec<f64> {
    let breaks = knots.breakpoints();
    breaks.windows(2).flat_map(|w| places.iter().map(move |part| w[0] + (w[1] - w[0]) * part)).collect()
}

/// The bends along a line, from keel to deck or from aft forward, without places at which the line stands still: where
/// sections close on the centreplane the chart runs on in one point, and there is no curvature.
#[must_use]
pub fn bends(surface: &FairSurface, line: Line) -> Vec<Bend> {
    let hull = &surface.hull;
    let net = hull.surface();
    let bends: Vec<Bend> = match line {
        Line::Station(x) => {
            let places: &[f64] = match () {
                () if surface.is_field => &PLACES_UPRIGHT,
                () if hull.is_level() => &PLACES,
                () if hull.is_upright() => &PLACES_UPRIGHT,
                () => &PLACES_ACROSS,
            };
            let along = inside(net.v(), places).into_iter();
            along.filter_map(|v| hull.length_parameter(x, v).and_then(|u| bend(net, [u, v], true))).collect()
        }
        Line::Waterline(z) => {
            let places: &[f64] = match () {
                () if surface.is_field => &PLACES_UPRIGHT,
                () if hull.is_level() => &PLACES,
                () => &PLACES_ACROSS,
            };
            let along = inside(net.u(), places).into_iter();
            along.filter_map(|u| hull.height_parameter_at(u, z).and_then(|v| bend(net, [u, v], false))).collect()
        }
    };
    moving(bends, &surface.start)
}

/// Those bends at which the line of a net does not stand still.
pub(super) fn moving(mut bends: Vec<Bend>, net: &[f64]) -> Vec<Bend> {
    let speed = |bend: &Bend| bend.along.hypot(value(&bend.slope, net));
    let fastest = bends.iter().map(speed).fold(0.0, f64::max);
    bends.retain(|bend| speed(bend) > STILL * fastest);
    bends
}

/// The curvature below which a line has none \[1/m\]: a part of the ninth decile, so that a tight bilge does not make
/// flats of all else, and at least that of an arc as long as the line that leaves its chord by a hundredth of a
/// millimetre.
#[must_use]
pub fn dead(bends: &[Bend], net: &[f64]) -> f64 {
    let length = bends.first().zip(bends.last()).map_or(0.0, |(first, last)| (last.at - first.at).abs());
    let least = if length > 0.0 { 8.0 * STRAIGHT / (length * length) } else { 0.0 };
    let mut sizes: Vec<f64> = bends.iter().map(|bend| bend.curvature(net).abs()).collect();
    sizes.sort_by(f64::total_cmp);
    least.max(DEAD * sizes.get(sizes.len() * 9 / 10).copied().unwrap_or(0.0))
}

/// Signs of curvature along bends, 0 within the dead band.
#[must_use]
pub fn signs(bends: &[Bend], net: &[f64]) -> Vec<i8> {
    let dead = dead(bends, net);
    let sign = |k: f64| match k {
        k if k.abs() <= dead => 0,
        k if k > 0.0 => 1,
        _ => -1,
    };
    bends.iter().map(|bend| sign(bend.curvature(net))).collect()
}

/// Changes of sign, zeros left out.
#[must_use]
pub fn changes(signs: &[i8]) -> usize {
    let nonzero: Vec<i8> = signs.iter().copied().filter(|&sign| sign != 0).collect();
    nonzero.windows(2).filter(|pair| pair[0] != pair[1]).count()
}

/// Length of a line over that of the coordinate along it, at a bend.
fn stretch(bend: &Bend, net: &[f64]) -> f64 {
    bend.along.hypot(value(&bend.slope, net)) / bend.along.abs()
}

/// Length of the coordinate for which the bend `k` stands, from the middle of the gap before it to the middle of that
/// after it \[m\].
fn gap(bends: &[Bend], k: usize) -> f64 {
    let middle = |a: usize, b: usize| 0.5 * (bends[a].at + bends[b].at);
    (middle(k, (k + 1).min(bends.len() - 1)) - middle(k.saturating_sub(1), k)).abs()
}

/// Greatest distance of a part of a line from its chord \[m\]: with theta the integral of curvature along the line, the
/// integral of theta less its mean, from the middle of the gap before the part to the middle of the gap after it.
pub(super) fn departure(bends: &[Bend], [from, to]: [usize; 2], net: &[f64]) -> f64 {
    let (mut s, mut turned, mut off) = (vec![0.0], 0.0, vec![0.0]);
    for k in from..to {
        let step = gap(bends, k) * stretch(&bends[k], net);
        let bent = bends[k].curvature(net) * step;
        let (last, before) = (off[off.len() - 1], s[s.len() - 1]);
        off.push(last + (turned + 0.5 * bent) * step);
        s.push(before + step);
        turned += bent;
    }
    let (length, end) = (s[s.len() - 1], off[off.len() - 1]);
    if length <= 0.0 {
        return 0.0;
    }
    s.iter().zip(&off).map(|(s, off)| (off - end * s / length).abs()).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    /// A line from 0 to 10 m with this y''.
    fn line(second: impl Fn(f64) -> f64) -> (Vec<Bend>, Vec<f64>) {
        let at: Vec<f64> = (0..101).map(|k| 0.1 * f64::from(k)).collect();
        let bend = |(k, &at): (usize, &f64)| Bend {
            numerator: vec![(k, 1.0)],
            offset: 0.0,
            slope: Vec::new(),
            along: 1.0,
            at,
        };
        (at.iter().enumerate().map(bend).collect(), at.iter().copied().map(second).collect())
    }

    /// An arc departs by kappa l^2 / 8, a half wave by kappa l^2 / pi^2, a wave with as much of either sign the same way as
    /// its two halves.
    #[test]
    fn what_departs_is_known_to_a_hundredth() {
        let off = |second: &dyn Fn(f64) -> f64| {
            let (bends, second) = line(second);
            departure(&bends, [0, bends.len()], &second)
        };
        assert!((off(&|_| 1e-3) - 0.0125).abs() < 1e-4);
        assert!((off(&|x| 1e-3 * (PI * x / 10.0).sin()) - 0.1 / PI.powi(2)).abs() < 1e-4);
        assert!((off(&|x| 1e-3 * (PI * x / 5.0).sin()) - 0.1 / (4.0 * PI.powi(2))).abs() < 1e-4);
        // Sharp: an arc of its greatest curvature departs by 2.5 times as much.
        assert!((off(&|x| 1e-3 * (1.0 - (x - 5.0).abs() / 5.0).powi(3)) - 0.0125 / 2.5).abs() < 1e-4);
    }
}
