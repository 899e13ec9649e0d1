//! Curvature of stations and waterlines as linear forms of the half-breadths, and the guard that no line bends more
//! often after than before.
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
//!
//! The start passes through its own signs and through every offset, so that imposing them on a line never makes a program
//! infeasible whose other limits the start meets.

use super::model::{Limit, Row, value};
use super::surface::{FairSurface, basis_row};
use crate::hull::Cut;
use crate::spline::{BsplineSurface, KnotVector};
use std::ops::Range;

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
    signs_beyond(bends, net, dead(bends, net))
}

/// Signs of curvature along bends, 0 up to `dead` \[1/m\].
fn signs_beyond(bends: &[Bend], net: &[f64], dead: f64) -> Vec<i8> {
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

/// Limits that keep a line at the signs that `start` has there, and in the dead band where it is; a hundredth of the
/// band is left open, and no more than what departs by `seen` \[m\] over the length of the part. Lobes that depart by
/// less than `seen` from their chord, which nobody counts, may fade but not grow: they would be counted. Where
/// `strictly`, nothing is in the dead band, and what lies between lobes that are counted turns as the one before it, at
/// the start of the line as the first: lobes that nobody sees might join to one that is seen.
#[must_use]
pub fn kept(bends: &[Bend], start: &[f64], seen: f64, strictly: bool) -> Vec<Limit> {
    let none = dead(bends, start);
    let mut signs = signs_beyond(bends, start, if strictly { 0.0 } else { none });
    let mut small = unseen(bends, &signs, start, seen);
    let counted = |k: usize| signs[k] != 0 && !small[k];
    if strictly && let Some(first) = (0..signs.len()).find(|&k| counted(k)) {
        let turned = (0..signs.len()).scan(signs[first], |last, k| {
            *last = if counted(k) { signs[k] } else { *last };
            Some(*last)
        });
        signs = turned.collect();
        small.fill(false);
    }
    let limit = |(k, room): (usize, f64)| {
        let scaled = bends[k].scaled(start, room)?;
        let (most, room) = (scaled.at(start), scaled.room);
        Some(scaled.limit(match signs[k] {
            // A long part can be seen to bend however little it does.
            0 => [most.min(-room), most.max(room)],
            1.. => [-room, if small[k] { most.max(-room) } else { f64::INFINITY }],
            _ => [if small[k] { most.min(room) } else { f64::NEG_INFINITY }, room],
        }))
    };
    rooms(bends, &signs, start, [ROOM * none, seen]).into_iter().enumerate().filter_map(limit).collect()
}

/// The curvature that the limits of each bend leave open \[1/m\]: `most`, and no more than what departs by `seen` \[m\]
/// over the length of its part of one sign.
fn rooms(bends: &[Bend], signs: &[i8], net: &[f64], [most, seen]: [f64; 2]) -> Vec<f64> {
    let mut rooms = vec![most; bends.len()];
    let mut from = 0;
    while from < bends.len() {
        let to = (from..bends.len()).find(|&k| signs[k] != signs[from]).unwrap_or(bends.len());
        let part = length(bends, [from, to], net);
        if part > 0.0 {
            rooms[from..to].fill(most.min(8.0 * seen / (part * part)));
        }
        from = to;
    }
    rooms
}

/// A part of a line that bends one way.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Lobe {
    /// Which way.
    pub sign: i8,
    /// Its first bend.
    pub from: usize,
    /// The bend with its greatest curvature.
    pub top: usize,
    /// kappa l^2 / 8 of its greatest curvature and its length \[m\].
    pub departure: f64,
}

/// The lobes of a line that are seen, each of another sign than the one before: what departs from its chord by less than
/// `seen` \[m\] or is in the dead band goes with the lobe before, at the start of the line with the first.
#[must_use]
pub fn lobes(bends: &[Bend], net: &[f64], seen: f64) -> Vec<Lobe> {
    let signs = signs(bends, net);
    let small = unseen(bends, &signs, net, seen);
    let counted = |k: usize| signs[k] != 0 && !small[k];
    let mut found: Vec<Lobe> = Vec::new();
    let mut from = 0;
    while let Some(first) = (from..bends.len()).find(|&k| counted(k)) {
        from = (first + 1..bends.len()).find(|&k| counted(k) && signs[k] != signs[first]).unwrap_or(bends.len());
        let size = |k: &usize| bends[*k].curvature(net).abs();
        let mut own = (first..from).filter(|&k| signs[k] == signs[first]);
        let top = own.clone().max_by(|a, b| size(a).total_cmp(&size(b))).unwrap_or(first);
        let length = length(bends, [first, own.next_back().unwrap_or(first) + 1], net);
        found.push(Lobe { sign: signs[first], from: first, top, departure: size(&top) * length * length / 8.0 });
    }
    found
}

/// Limits that give the bends of a line these signs, those of sign 0 none. A hundredth of the dead band is left open, and no
/// more than what departs by `seen` \[m\] over the length of a part of one sign; outside `strictly`, what is beyond that
/// may stay but not grow.
#[must_use]
pub fn asked(bends: &[Bend], net: &[f64], signs: &[i8], strictly: Range<usize>, seen: f64) -> Vec<Limit> {
    let none = dead(bends, net);
    let limit = |(k, room): (usize, f64)| {
        let scaled = bends[k].scaled(net, room).filter(|_| signs[k] != 0)?;
        let (room, sign) = (scaled.room, f64::from(signs[k]));
        let now = if strictly.contains(&k) { 0.0 } else { sign * scaled.at(net) };
        let beyond = now.min(-room);
        Some(scaled.limit(if sign > 0.0 { [beyond, f64::INFINITY] } else { [f64::NEG_INFINITY, -beyond] }))
    };
    rooms(bends, signs, net, [ROOM * none, seen]).into_iter().enumerate().filter_map(limit).collect()
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

/// Length of the part of a line with these bends, from the middle of the gap before it to the middle of the gap after
/// \[m\].
fn length(bends: &[Bend], [from, to]: [usize; 2], net: &[f64]) -> f64 {
    let along: f64 = (from..to).map(|k| gap(bends, k)).sum();
    let mean = bends[from..to].iter().map(|bend| stretch(bend, net)).sum::<f64>() / (to - from) as f64;
    along * mean
}

/// Whether each bend lies in a lobe of the signs that departs from its chord by less than `seen` \[m\], or so little more
/// that it may fade below it: an arc of its greatest curvature kappa and its length l by kappa l^2 / 8 < 2 `seen`.
fn unseen(bends: &[Bend], signs: &[i8], net: &[f64], seen: f64) -> Vec<bool> {
    let mut small = vec![false; bends.len()];
    let mut from = 0;
    while let Some(first) = (from..bends.len()).find(|&k| signs[k] != 0) {
        from = first;
        let to = (from + 1..bends.len()).find(|&k| signs[k] == -signs[from]).unwrap_or(bends.len());
        let largest = bends[from..to].iter().map(|bend| bend.curvature(net).abs()).fold(0.0, f64::max);
        let arc = largest * length(bends, [from, to], net).powi(2) / 8.0;
        small[from..to].fill(arc < 2.0 * seen || departure(bends, [from, to], net) < seen);
        from = to;
    }
    small
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

    /// A lobe of a metre and 1e-3 / m between two of the other sign. It departs by 1.25e-4 m.
    #[test]
    fn lobes_that_nobody_sees_may_not_grow() {
        let (bends, second) = line(|x| if (4.45..5.45).contains(&x) { -1e-3 } else { 1e-2 });
        let limit_at = |seen: f64, x: usize| kept(&bends, &second, seen, false)[x].clone();
        // Seen, it may grow; else it stays between where it is and nothing. The others are seen.
        assert!(limit_at(5e-5, 50).lower.is_infinite());
        let small = limit_at(1e-4, 50);
        assert!((small.lower + 1e-3).abs() < 1e-18 && small.upper > 0.0 && small.upper < 1e-4, "{small:?}");
        assert!(limit_at(1e-4, 20).upper.is_infinite());
        // Strictly, it goes with the others.
        let strict = kept(&bends, &second, 1e-4, true)[50].clone();
        assert!(strict.lower > -1e-4 && strict.upper.is_infinite(), "{strict:?}");
    }

    /// Two lobes that are seen, and six of a metre that nobody sees: three of them might join to one that is.
    #[test]
    fn lobes_that_nobody_sees_go_strictly_with_the_one_before() {
        let (bends, second) = line(|x| match x {
            x if x < 2.0 => 1e-2,
            x if x < 4.0 => -1e-2,
            x if (x as usize).is_multiple_of(2) => 1e-4,
            _ => -1e-4,
        });
        let limits = kept(&bends, &second, 1e-4, true);
        assert!(limits[..20].iter().all(|limit| limit.upper.is_infinite() && limit.lower > -2e-4));
        assert!(limits[20..].iter().all(|limit| limit.lower.is_infinite() && limit.upper < 2e-4));
        let loose = kept(&bends, &second, 1e-4, false);
        assert!(loose[40..].iter().all(|limit| limit.lower.is_finite() && limit.upper.is_finite()));
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

    /// A lobe that turns sharply and departs by less than is seen may not grow though an arc of its greatest curvature
    /// would be seen twice over.
    #[test]
    fn sharp_lobes_that_nobody_sees_may_not_grow() {
        let sharp = |x: f64| if (x - 5.0).abs() < 1.0 { -1e-2 * (1.0 - (x - 5.0).abs()).powi(3) } else { 1e-2 };
        let (bends, second) = line(sharp);
        let limits = kept(&bends, &second, 2.3e-3, false);
        assert!((limits[50].lower + 1e-2).abs() < 1e-15, "{:?}", limits[50]);
        assert!(kept(&bends, &second, 1.5e-3, false)[50].lower.is_infinite());
    }

    /// + from 0 to 4 m, a lobe of a metre and -1e-3 / m in it, - from 4 m, and what nobody sees at the end.
    #[test]
    fn lobes_are_those_that_are_seen() {
        let second = |x: f64| match x {
            x if (1.95..2.95).contains(&x) => -1e-3,
            x if x < 4.05 => 1e-2,
            x if x < 8.95 => -1e-2,
            _ => 1e-4,
        };
        let (bends, second) = line(second);
        let signs = |seen: f64| lobes(&bends, &second, seen).iter().map(|lobe| lobe.sign).collect::<Vec<_>>();
        // 1.25e-4 m off its chord, counted from twice what is seen on.
        assert_eq!(signs(5e-5), [1, -1, 1, -1]);
        assert_eq!(signs(1e-4), [1, -1]);
        let found = lobes(&bends, &second, 5e-5)[1];
        assert_eq!((found.from, found.sign), (20, -1));
        assert!((20..30).contains(&found.top) && (found.departure - 1.25e-4).abs() < 5e-6, "{found:?}");
    }

    #[test]
    fn signs_that_are_asked_for_leave_what_is_not_strict_where_it_is() {
        let (bends, second) = line(|x| if x < 5.0 { 1e-2 } else { -1e-3 });
        let mut signs = vec![1; bends.len()];
        signs[10] = 0;
        let limits = asked(&bends, &second, &signs, 60..80, 1e-3);
        assert_eq!(limits.len(), bends.len() - 1);
        let at = |k: usize| &limits[k - 1];
        // Strictly: no more than a hundredth of the dead band the other way; else no more than now.
        assert!(at(70).lower > -2e-6 && at(70).lower < 0.0 && at(70).upper.is_infinite(), "{:?}", at(70));
        assert!((at(90).lower + 1e-3).abs() < 1e-15 && at(90).upper.is_infinite(), "{:?}", at(90));
        assert!(at(20).lower > -2e-6, "{:?}", at(20));
    }
}
