//! A keel that is not level: heights above it, as a part of the depth.
//!
//! ```text
//! zeta = z0 + (z - k(x)) H / (z1 - k(x)),   H = z1 - z0
//! ```
//!
//! Here k is the keel line, z0 its least height and z1 the upper edge. Half-breadths over (x, zeta) are those of a hull on a
//! level keel: the field and its chart are the same. The keel line is the quintic spline of greatest restricted likelihood
//! through the heights of the keel ([`super::likelihood`] along one direction).

use super::likelihood::EXACT;
use super::net::{DEGREE, ORDER};
use crate::hull::{OffsetTable, Outermost, carried_on};
use crate::numeric::gauss_legendre;
use crate::spline::{BsplineCurve, KnotVector};
use nalgebra::{DMatrix, DVector};

/// Fewest heights of the keel.
const FEWEST: usize = 6;

/// A keel line that varies by less than this part of the depth is level.
const LEVEL: f64 = 0.02;

/// A height of the keel this far from its line, over the depth, is on no line: it jumps there.
const JUMP: f64 = 0.03;

/// Heights above the keel line below this part of the depth there are on the keel.
const ON_KEEL: f64 = 1e-3;

/// Least part of the heights of a keel that lie on one line, where it jumps.
const RUN: f64 = 0.5;

/// Scale of the errors of heights with which a keel line goes on beyond its run.
const BEYOND: f64 = 10.0;

/// Half-breadths below this part of the greatest are on the centreplane.
const CLOSED: f64 = 1e-6;

/// Decimal logarithms of the least and of the greatest weight, and their step.
const WEIGHTS: [f64; 2] = [-8.0, 4.0];
const STEP: f64 = 0.25;

/// The keel line of a hull with rocker, and its upper edge.
#[derive(Debug, Clone)]
pub struct Rocker {
    /// k over x \[m\].
    keel: BsplineCurve<1>,
    /// z0 and z1 \[m\].
    pub height: [f64; 2],
    /// x of the ends of the keel line \[m\].
    pub length: [f64; 2],
    /// Whether the hull closes there; none where the keel line ends before the hull, at a stem or below a counter.
    pub closed: [Option<bool>; 2],
    /// x between which heights of the keel are on its line \[m\].
    pub run: [f64; 2],
    /// How far a height of the keel is from its line at most \[m\].
    pub off: f64,
}

/// The height of the keel at a station, or at an end.
#[derive(Debug, Clone, Copy)]
struct Height {
    x: f64,
    z: f64,
    /// Scale of its error.
    scale: f64,
}

impl Rocker {
    /// That of a table whose keel heights lie on one line from end to end, or on one that ends where they jump: below a
    /// counter, or at a stem. `least` \[m\] is the least error of a height, `extent` \[m\] has the ends of the hull. None
    /// where fewer than half of the heights are on a line, or the keel is level.
    #[must_use]
    pub fn new(table: &OffsetTable, least: f64, extent: [f64; 2]) -> Option<Self> {
        let top = table.waterlines.last().copied()?;
        let mut heights: Vec<Height> = Vec::new();
        let mut breadths: Vec<f64> = Vec::new();
        for station in &table.stations {
            let x = station.station.x;
            let offsets = station.half_breadths.iter().filter_map(|cell| cell.value());
            let deck = station.deck_half_breadth;
            let breadth = offsets.chain(deck).fold(0.0f64, f64::max);
            match station.keel_height.filter(|z| z.is_finite()) {
                Some(z) if z < top => heights.push(Height { x, z, scale: 1.0 }),
                None if breadth <= 0.0 => continue,
                _ => return None,
            }
            breadths.push(breadth);
        }
        let [bottom, highest] = range(&heights);
        if heights.len() < FEWEST || highest - bottom <= LEVEL * (top - bottom) {
            return None;
        }
        let greatest = breadths.iter().copied().fold(0.0, f64::max);
        let last = heights.len() - 1;
        let outermost = |k: usize| Outermost { x: heights[k].x, keel: heights[k].z, top, breadth: breadths[k] };
        let tips = [[0, 1], [last, last - 1]].map(|[end, before]| carried_on(outermost(before), outermost(end)));
        let least_run = FEWEST.max((RUN * heights.len() as f64).ceil() as usize);
        let mut run = 0..heights.len();
        while run.len() >= least_run {
            let own = &heights[run.clone()];
            // Whether the hull closes at a side, and where the keel line goes on to.
            let ends = [0, 1].map(|side| {
                let end = [0, last][side];
                if !run.contains(&end) {
                    let x = extent[side];
                    return (None, Some(Height { x, z: straight_on(own, side, x), scale: BEYOND }));
                }
                let is_closed = breadths[end] <= CLOSED * greatest;
                let tip = tips[side].filter(|_| !is_closed).map(|[x, _]| Height { x, z: top, scale: EXACT });
                (Some(is_closed || tip.is_some()), tip)
            });
            let line: Vec<Height> = ends[0].1.into_iter().chain(own.iter().copied()).chain(ends[1].1).collect();
            let keel = keel_line(&line, least)?;
            let [bottom, _] = range(own);
            let off = line.iter().filter(|height| height.scale < BEYOND);
            let off = off.map(|height| (keel.eval(height.x)[0] - height.z).abs()).fold(0.0, f64::max);
            if off <= JUMP * (top - bottom) {
                let (length, run) = ([line[0].x, line[line.len() - 1].x], [own[0].x, own[own.len() - 1].x]);
                return Some(Self { keel, height: [bottom, top], length, closed: ends.map(|end| end.0), run, off });
            }
            // The longer part to one side of the steepest step.
            let step = |k: &usize| (heights[k + 1].z - heights[*k].z).abs();
            let at = (run.start..run.end - 1).max_by(|a, b| step(a).total_cmp(&step(b)))? + 1;
            run = if at - run.start > run.end - at { run.start..at } else { at..run.end };
        }
        None
    }

    /// Height of the keel at x \[m\].
    #[must_use]
    pub fn keel(&self, x: f64) -> f64 {
        self.keel.eval(x)[0].min(self.height[1])
    }

    /// zeta of a place \[m\]; none on the keel and below it.
    #[must_use]
    pub fn relative(&self, x: f64, z: f64) -> Option<f64> {
        let [bottom, top] = self.height;
        let depth = top - self.keel(x);
        let part = (z - self.keel(x)) / depth;
        (depth > 0.0 && part > ON_KEEL).then_some(bottom + part * (top - bottom))
    }

    /// z of a place by zeta \[m\].
    #[must_use]
    pub fn absolute(&self, x: f64, zeta: f64) -> f64 {
        let [bottom, top] = self.height;
        let keel = self.keel(x);
        keel + (top - keel) * (zeta - bottom) / (top - bottom)
    }

    /// zeta by x and by z at a place.
    #[must_use]
    pub fn slopes(&self, x: f64, z: f64) -> [f64; 2] {
        let [bottom, top] = self.height;
        let [[keel], [slope]] = self.keel.derivatives::<2>(x);
        let (height, depth) = (top - bottom, (top - keel).max(f64::MIN_POSITIVE));
        [-height * slope * (top - z) / (depth * depth), height / depth]
    }
}

/// The least and the greatest of heights \[m\].
fn range(heights: &[Height]) -> [f64; 2] {
    heights.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], height| [a.min(height.z), b.max(height.z)])
}

/// z at x \[m\] on the straight line through the outermost height of a side and the third one from there.
fn straight_on(heights: &[Height], side: usize, x: f64) -> f64 {
    let last = heights.len() - 1;
    let [end, before] = if side == 0 { [0, 2] } else { [last, last - 2] }.map(|k| heights[k]);
    end.z + (end.z - before.z) / (end.x - before.x) * (x - end.x)
}

/// The quintic spline of greatest restricted likelihood through heights of rising x.
fn keel_line(heights: &[Height], least: f64) -> Option<BsplineCurve<1>> {
    let (from, to) = (heights[0].x, heights[heights.len() - 1].x);
    let spans = heights.len() - 1;
    let breaks: Vec<f64> = (0..=spans).map(|k| from + (to - from) * k as f64 / spans as f64).collect();
    let knots = KnotVector::from_breakpoints(DEGREE, &breaks, &vec![1; spans - 1]).ok()?;
    let size = knots.basis_count();
    let mut normal = DMatrix::<f64>::zeros(size, size);
    let mut right = DVector::<f64>::zeros(size);
    let row = |x: f64, order: usize| {
        let span = knots.find_span(x);
        (span - DEGREE, knots.basis_derivatives::<{ ORDER + 1 }>(span, x)[order])
    };
    for height in heights {
        let (first, values) = row(height.x, 0);
        for a in 0..=DEGREE {
            right[first + a] += values[a] * height.z / height.scale.powi(2);
            for b in 0..=DEGREE {
                normal[(first + a, first + b)] += values[a] * values[b] / height.scale.powi(2);
            }
        }
    }
    // The energy over intervals of the stations.
    let unit = ((to - from) / spans as f64).powi(2 * ORDER as i32 - 1);
    let rule = gauss_legendre(DEGREE + 1 - ORDER);
    let mut energy = DMatrix::<f64>::zeros(size, size);
    for span in breaks.windows(2) {
        for (x, weight) in rule.on(span[0], span[1]) {
            let (first, values) = row(x, ORDER);
            for a in 0..=DEGREE {
                for b in 0..=DEGREE {
                    energy[(first + a, first + b)] += unit * weight * values[a] * values[b];
                }
            }
        }
    }
    let (count, rank) = (heights.len() as f64, (size - ORDER) as f64);
    let freedom = count - ORDER as f64;
    let trial = |weight: f64| {
        let factor = (&normal + weight * &energy).cholesky()?;
        let values = factor.solve(&right);
        let square = |height: &Height| {
            let (first, basis) = row(height.x, 0);
            let value: f64 = (0..=DEGREE).map(|a| basis[a] * values[first + a]).sum();
            ((value - height.z) / height.scale).powi(2)
        };
        let left = heights.iter().map(square).sum::<f64>() + weight * values.dot(&(&energy * &values)).max(0.0);
        let variance = (left / freedom).max(least * least);
        let determinant = 2.0 * factor.l().diagonal().iter().map(|d| d.ln()).sum::<f64>();
        Some((freedom * variance.ln() + left / variance - rank * weight.ln() + determinant, values))
    };
    let steps = ((WEIGHTS[1] - WEIGHTS[0]) / STEP).round() as usize;
    let tried = (0..=steps).filter_map(|k| trial(10f64.powf(WEIGHTS[0] + STEP * k as f64)));
    let (_, values) = tried.min_by(|a, b| a.0.total_cmp(&b.0))?;
    BsplineCurve::new(knots, values.iter().map(|&z| [z]).collect()).ok()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hull::StationOffsets;

    /// The keel 0.035 x^2 meets the upper edge, 3.2 m, beyond x = 9 m by 2 (3.2 - 2.835) / (2.835 - 1.715) at both ends.
    #[test]
    fn a_double_ender_closes_at_both_ends_alike() {
        let station = |k: i32| {
            let x = f64::from(k);
            StationOffsets {
                keel_height: Some(0.035 * x * x),
                deck_half_breadth: Some(3.0 * (1.0 - (x / 9.6).powi(2))),
                ..StationOffsets::new(format!("{k}"), x)
            }
        };
        let stations = (-9..=9).step_by(2).map(station).collect();
        let table = OffsetTable { stations, waterlines: vec![1.0, 3.2], ..OffsetTable::default() };
        let found = Rocker::new(&table, 1e-6, [-9.0, 9.0]).unwrap();
        let tip = 9.0 + 2.0 * 0.365 / 1.12;
        assert_eq!(found.closed, [Some(true); 2]);
        assert!((found.length[0] + tip).abs() < 1e-9 && (found.length[1] - tip).abs() < 1e-9, "{:?}", found.length);
    }

    /// A parabola and a cubic with errors of 5 mm: the line is nearer to it than the errors are.
    #[test]
    fn a_keel_line_is_smoothed() {
        let truth = |x: f64| 0.02 * (x - 6.0).powi(2) + 1e-3 * x.powi(3);
        let errors = [1.0, -1.0, 0.5, 0.2, -1.3, 0.7, 0.9, -0.8, -0.1, 1.1, -0.6, 0.4, -0.9];
        let heights: Vec<Height> = errors
            .iter()
            .enumerate()
            .map(|(k, error)| Height { x: k as f64, z: truth(k as f64) + 5e-3 * error, scale: 1.0 })
            .collect();
        let keel = keel_line(&heights, 1e-6).unwrap();
        let rms = |off: &dyn Fn(&Height) -> f64| {
            (heights.iter().map(|h| off(h).powi(2)).sum::<f64>() / heights.len() as f64).sqrt()
        };
        let [before, after] = [rms(&|h| h.z - truth(h.x)), rms(&|h| keel.eval(h.x)[0] - truth(h.x))];
        assert!(after < 0.7 * before, "{before} > {after}");
        let exact: Vec<Height> = heights.iter().map(|h| Height { z: truth(h.x), ..*h }).collect();
        let keel = keel_line(&exact, 1e-9).unwrap();
        assert!((0..=48).all(|k| (keel.eval(0.25 * f64::from(k))[0] - truth(0.25 * f64::from(k))).abs() < 1e-7));
    }
}
