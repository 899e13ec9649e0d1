//! Segments, rectangles and lengths of curves, for the places of names.

use super::THREAD_FOOT;
use crate::plot::paper::canvas::Rectangle;

/// Whether a segment passes through a rectangle.
pub(super) fn crosses(r: &Rectangle, a: [f64; 2], b: [f64; 2]) -> bool {
    // Liang and Barsky (1984): the part of the segment inside the four half-planes.
    let (mut enter, mut leave) = (0.0f64, 1.0f64);
    for (start, step, low, high) in [(a[0], b[0] - a[0], r.left, r.right), (a[1], b[1] - a[1], r.top, r.bottom)] {
        if step.abs() < 1e-12 {
            if start < low || start > high {
                return false;
            }
        } else {
            let (t, s) = ((low - start) / step, (high - start) / step);
            enter = enter.max(t.min(s));
            leave = leave.min(t.max(s));
        }
    }
    enter <= leave
}

/// Whether two segments cross.
pub(in crate::plot) fn meet([a, b]: [[f64; 2]; 2], [c, d]: [[f64; 2]; 2]) -> bool {
    let side = |p: [f64; 2], q: [f64; 2], r: [f64; 2]| (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
    side(a, b, c) * side(a, b, d) <= 0.0 && side(c, d, a) * side(c, d, b) <= 0.0
}

/// The rectangle around points.
pub(super) fn bounds(points: &[[f64; 2]]) -> Rectangle {
    let empty = Rectangle::new(f64::INFINITY, f64::INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY);
    points
        .iter()
        .fold(empty, |r, p| Rectangle::new(r.left.min(p[0]), r.top.min(p[1]), r.right.max(p[0]), r.bottom.max(p[1])))
}

/// Places for a name over the end `at` of a line, the nearest first: up to `columns` steps aside and `rows` steps up, of
/// 0.9 and 0.5 of `unit` \[mm\]. None is more than `slope` times as far aside as up: a flat thread lies on the deck line or on
/// those of its neighbours.
pub(in crate::plot) fn places_over(at: [f64; 2], unit: f64, [columns, rows]: [i32; 2], slope: f64) -> Vec<[f64; 2]> {
    let aside = move |row: i32| (-columns..=columns).map(move |k| [0.9 * f64::from(k), 0.5 * f64::from(row)]);
    let mut steps: Vec<[f64; 2]> =
        (0..rows).flat_map(aside).filter(|[dx, dy]| dx.abs() <= slope * (dy + THREAD_FOOT)).collect();
    steps.sort_by(|a, b| (a[0].abs() + a[1]).total_cmp(&(b[0].abs() + b[1])));
    steps.into_iter().map(|[dx, dy]| [at[0] + dx * unit, at[1] - (0.9 + dy) * unit]).collect()
}

/// Length of a polyline [mm].
pub(in crate::plot) fn length(points: &[[f64; 2]]) -> f64 {
    points.windows(2).map(|w| (w[1][0] - w[0][0]).hypot(w[1][1] - w[0][1])).sum()
}

/// A polyline by the parts of its length.
pub(super) struct Path<'a> {
    points: &'a [[f64; 2]],
    lengths: Vec<f64>,
}

impl<'a> Path<'a> {
    pub(super) fn new(points: &'a [[f64; 2]]) -> Self {
        let mut lengths = vec![0.0];
        let mut sum = 0.0;
        for w in points.windows(2) {
            sum += (w[1][0] - w[0][0]).hypot(w[1][1] - w[0][1]);
            lengths.push(sum);
        }
        Self { points, lengths }
    }

    pub(super) fn point(&self, part: f64) -> Option<[f64; 2]> {
        let target = part * self.lengths.last()?;
        let k = self.lengths.partition_point(|&length| length < target).clamp(1, self.points.len().max(2) - 1);
        let (a, b) = (self.points.get(k - 1)?, self.points.get(k)?);
        let step = self.lengths[k] - self.lengths[k - 1];
        let t = if step > 0.0 { (target - self.lengths[k - 1]) / step } else { 0.0 };
        Some([a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])])
    }
}
