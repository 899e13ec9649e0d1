//! The Kochin function of any hull, by its waterlines.
//!
//! F = int e^{-q d} W(k, d) dd over the depth d below the waterline, W(k, d) = int e^{ikx} dy along the waterline there.
//! W is closed over panels of Legendre series in x, however its ends rake and however blunt they are. The depth is cut at
//! T/2, T/4, T/8, ...: each ring has a Gauss rule, and what is above the last ring that matters is one panel, so that the
//! decay is resolved at every q. The rings near the keel are cut more finely, for bilges and the tops of bulbs.

use super::panel::{Moments, Panel, Sample, oscillation, panels};
use crate::hull::{Branch, Cut, Face, Hull};
use crate::numeric::gauss_legendre;

/// Rings of depth, each half as deep as the one below.
const RINGS: usize = 14;
/// The least number of rings below the uppermost panel.
const LEAST_RINGS: usize = 3;
/// Nodes of the rule over a ring.
pub(super) const NODES: usize = 6;
/// The uppermost panel is no deeper than this part of 1/q.
const CAP: f64 = 1.5;
/// What decays by this power is left out.
const DEEPEST: f64 = 32.0;
/// Terms of series along a waterline that are dropped, beside B/2.
const TOLERANCE: f64 = 1e-8;
/// Deviation of sections from the hull, beside its length.
const SECTION: f64 = 1e-8;

/// A waterline with the weight of its depth.
#[derive(Debug, Clone)]
struct Level {
    depth: f64,
    weight: f64,
    panels: Vec<Panel<1>>,
}

/// Levels of depth with the weights of a rule, the same for every hull.
#[derive(Debug, Clone)]
pub(super) struct Rings<T> {
    /// From the keel up; the depth of the top of each \[m\].
    rings: Vec<(f64, Vec<T>)>,
    /// From the surface down to the top of each ring.
    caps: Vec<(f64, Vec<T>)>,
}

impl<T> Rings<T> {
    /// Down to a depth \[m\]; `level` gets a depth with its weight.
    pub(super) fn new(deepest: f64, nodes: usize, level: impl Fn(f64, f64) -> T) -> Self {
        let part = |ring: usize| deepest * 0.5f64.powi(ring as i32);
        let list = |from: f64, to: f64, count: usize| -> Vec<T> {
            let edges = graded(from, to, count);
            let pairs = edges.windows(2).map(|pair| [pair[0], pair[1]]);
            let depths = pairs.flat_map(|[a, b]| gauss_legendre(nodes).on(a, b));
            depths.map(|(depth, weight)| level(depth, weight)).collect()
        };
        let rings = (0..RINGS).map(|n| (part(n + 1), list(part(n + 1), part(n), [4, 2].get(n).copied().unwrap_or(1))));
        let caps = (0..=RINGS).map(|n| (part(n), if n < LEAST_RINGS { Vec::new() } else { list(0.0, part(n), 1) }));
        Self { rings: rings.collect(), caps: caps.collect() }
    }

    /// The levels that matter at the decay `q`, each counted once.
    pub(super) fn at(&self, q: f64) -> impl Iterator<Item = &T> {
        let cap = (LEAST_RINGS..RINGS).find(|&n| q * self.caps[n].0 <= CAP).unwrap_or(RINGS);
        let near = self.rings[..cap].iter().filter(move |(top, _)| q * top < DEEPEST).flat_map(|(_, levels)| levels);
        near.chain(&self.caps[cap].1)
    }
}

impl<T> Rings<Option<T>> {
    /// None where a level is missing.
    pub(super) fn whole(self) -> Option<Rings<T>> {
        let all = |list: Vec<(f64, Vec<Option<T>>)>| -> Option<Vec<(f64, Vec<T>)>> {
            list.into_iter().map(|(top, levels)| Some((top, levels.into_iter().collect::<Option<_>>()?))).collect()
        };
        Some(Rings { rings: all(self.rings)?, caps: all(self.caps)? })
    }
}

/// A hull below a waterline, by its waterlines.
#[derive(Debug, Clone)]
pub(super) struct WaterlineKochin(Rings<Level>);

impl WaterlineKochin {
    pub(super) fn new(hull: &Hull, draught: f64, nodes: usize) -> Self {
        Self(Rings::new(draught - hull.bottom(), nodes, |depth, weight| level(hull, draught, depth, weight)))
    }

    /// F at wave number `k` and decay `q`, real and imaginary part [m^2].
    pub(super) fn kochin(&self, k: f64, q: f64) -> [f64; 2] {
        let mut sums = [0.0; 2];
        for level in self.0.at(q) {
            let weight = level.weight * (-q * level.depth).exp();
            let [real, imaginary] = level.wave(k);
            sums[0] += weight * real;
            sums[1] += weight * imaginary;
        }
        sums
    }
}

/// Edges from `from` to `to` in `count` panels, each half of the one above, the last two alike.
fn graded(from: f64, to: f64, count: usize) -> Vec<f64> {
    let inner = (0..count).map(|n| to - (to - from) * 0.5f64.powi(n as i32));
    inner.chain([to]).collect()
}

impl Level {
    /// int e^{ikx} dy along the waterline.
    fn wave(&self, k: f64) -> [f64; 2] {
        let mut moments = Moments::default();
        let mut sums = [0.0; 2];
        for panel in &self.panels {
            let [a, b] = oscillation(&panel.series[0], moments.of_wave(k, panel.half), panel.count);
            let (sine, cosine) = (k * panel.middle).sin_cos();
            sums[0] += cosine * a - sine * b;
            sums[1] += cosine * b + sine * a;
        }
        sums
    }
}

fn level(hull: &Hull, draught: f64, depth: f64, weight: f64) -> Level {
    let z = draught - depth;
    let length = hull.particulars().length_between_perpendiculars;
    let section = hull.section(Cut::Waterline { z }, SECTION * length);
    let breadth = 0.5 * hull.particulars().breadth;
    let mut list = Vec::new();
    for branch in &section.branches {
        match branch.face {
            Face::Side => side(branch, breadth, length, &mut list),
            Face::Bow => list.extend(closing(branch)),
            _ => {}
        }
    }
    Level { depth, weight, panels: list }
}

/// A flat bow falls to the centreplane at one x.
fn closing(branch: &Branch) -> Option<Panel<1>> {
    let points = branch.curve.points();
    let widest = points.iter().map(|p| p[1]).fold(0.0, f64::max);
    let mut series = [[0.0; super::panel::TERMS]];
    series[0][0] = -0.5 * widest;
    points.first().map(|point| Panel { middle: point[0], half: 0.0, series, count: 1 })
}

/// The panels of a branch on the side, spans that stand still in x as jumps.
fn side(branch: &Branch, breadth: f64, length: f64, list: &mut Vec<Panel<1>>) {
    let knots = branch.curve.knots();
    for span in knots.spans() {
        let (from, to) = (knots.knots()[span], knots.knots()[span + 1]);
        let sample = |t: f64| -> Sample<1> {
            let [value, slope] = branch.curve.derivatives::<2>(t.clamp(from, to));
            (value[0], slope[0], [slope[1]])
        };
        let [start, end] = [from, to].map(|t| branch.curve.eval(t));
        if (end[0] - start[0]).abs() <= 1e-9 * length {
            let mut series = [[0.0; super::panel::TERMS]];
            series[0][0] = 0.5 * (end[1] - start[1]);
            list.push(Panel { middle: 0.5 * (start[0] + end[0]), half: 0.0, series, count: 1 });
        } else {
            list.extend(panels(&sample, [from, to], true, TOLERANCE * breadth));
        }
    }
}
