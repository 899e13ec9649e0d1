//! The lines of a table inside their runs of offsets, places along them, and measures of what is drawn there.

use super::Table;
use crate::truth_hulls::measure::sign_changes;

/// Places along a line.
pub(crate) const PLACES: usize = 201;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Direction {
    Waterline,
    Station,
}

/// A waterline or a station, from where to where it is measured.
#[derive(Debug, Clone)]
pub(crate) struct Line {
    pub(crate) direction: Direction,
    /// Number of the waterline or station.
    pub(crate) index: usize,
    /// Its height or place along the ship \[m\].
    pub(crate) at: f64,
    pub(crate) from: f64,
    pub(crate) to: f64,
    /// First and last cell of the run.
    pub(crate) run: [usize; 2],
}

impl Line {
    /// The place number `k`, 0 to [`PLACES`] - 1.
    pub(crate) fn place(&self, k: usize) -> f64 {
        let t = k as f64 / (PLACES - 1) as f64;
        self.from + (self.to - self.from) * t
    }

    fn step(&self) -> f64 {
        (self.to - self.from) / (PLACES - 1) as f64
    }
}

/// Waterlines with seven offsets in a row, then stations with six: the longest run, without its first interval, and
/// for waterlines without its last.
pub(crate) fn lines(table: &Table) -> Vec<Line> {
    let mut lines = Vec::new();
    for (direction, least) in [(Direction::Waterline, 7), (Direction::Station, 6)] {
        let [along, across] = direction.of(table);
        for (index, &at) in across.iter().enumerate() {
            let full = |k: usize| match direction {
                Direction::Waterline => table.full(k, index),
                Direction::Station => table.full(index, k),
            };
            let (mut best, mut start) = ([0, 0], 0);
            for k in 0..=along.len() {
                if k == along.len() || !full(k) {
                    if k - start > best[1] - best[0] {
                        best = [start, k];
                    }
                    start = k + 1;
                }
            }
            if best[1] - best[0] >= least {
                let run = [best[0], best[1] - 1];
                let last = if direction == Direction::Waterline { run[1] - 1 } else { run[1] };
                lines.push(Line { direction, index, at, from: along[run[0] + 1], to: along[last], run });
            }
        }
    }
    lines
}

/// A surface y(x, z) at the places of every line.
pub(crate) fn samples(lines: &[Line], surface: impl Fn(f64, f64) -> f64) -> Vec<Vec<f64>> {
    let at = |line: &Line, t: f64| match line.direction {
        Direction::Waterline => surface(t, line.at),
        Direction::Station => surface(line.at, t),
    };
    lines.iter().map(|line| (0..PLACES).map(|k| at(line, line.place(k))).collect()).collect()
}

/// The departure of a hump from its chord from which it counts \[m\], for stations over a length \[m\] and a table of a
/// resolution \[mm\].
pub(crate) fn seen(x: &[f64], resolution: f64) -> f64 {
    let ends = x.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], &x| [a.min(x), b.max(x)]);
    ((ends[1] - ends[0]) / 50_000.0).max(2e-3 * resolution)
}

/// Root of the mean square over all numbers that are there.
fn root_mean_square(values: impl Iterator<Item = f64>) -> f64 {
    let (sum, count) = values.filter(|v| v.is_finite()).fold((0.0, 0usize), |(sum, count), v| (sum + v * v, count + 1));
    (sum / count.max(1) as f64).sqrt()
}

/// RMS off the truth over all lines \[m\].
pub(crate) fn rms(drawn: &[Vec<f64>], truth: &[Vec<f64>]) -> f64 {
    root_mean_square(drawn.iter().flatten().zip(truth.iter().flatten()).map(|(a, b)| a - b))
}

/// Curvature at the places of a line but the first and the last.
fn curvature(line: &Line, y: &[f64]) -> Vec<f64> {
    let h = line.step();
    let at = |w: &[f64]| {
        let (first, second) = ((w[2] - w[0]) / (2.0 * h), (w[2] - 2.0 * w[1] + w[0]) / (h * h));
        second / (1.0 + first * first).powf(1.5)
    };
    y.windows(3).map(at).collect()
}

fn variation(k: &[f64]) -> f64 {
    k.windows(2).map(|w| (w[1] - w[0]).abs()).filter(|v| v.is_finite()).sum()
}

fn quantile(sorted: &[f64], part: f64) -> f64 {
    let at = part * (sorted.len() - 1) as f64;
    let low = at as usize;
    let high = (low + 1).min(sorted.len() - 1);
    sorted[low] + (at - low as f64) * (sorted[high] - sorted[low])
}

/// What is between the 2nd and the 98th hundredth of the curvature of a line; none where it is nearly straight.
fn range(line: &Line, k: &[f64]) -> Option<f64> {
    let mut sorted: Vec<f64> = k.iter().copied().filter(|k| k.is_finite()).collect();
    sorted.sort_by(f64::total_cmp);
    let range = (sorted.len() > 60).then(|| quantile(&sorted, 0.98) - quantile(&sorted, 0.02))?;
    (range * (line.to - line.from).powi(2) / 8.0 >= 0.02).then_some(range)
}

/// Turning points of at least this size: monotone pieces less one.
fn turns(k: &[f64], least: f64) -> usize {
    let k: Vec<f64> = k.iter().copied().filter(|k| k.is_finite()).collect();
    let Some(&start) = k.first() else { return 0 };
    let (mut count, mut low, mut high, mut going) = (0, start, start, 0);
    for &v in &k[1..] {
        (low, high) = (low.min(v), high.max(v));
        if going >= 0 && high - v >= least {
            count += usize::from(going == 1);
            (going, low, high) = (-1, v, v);
        } else if going <= 0 && v - low >= least {
            count += usize::from(going == -1);
            (going, low, high) = (1, v, v);
        }
    }
    count
}

/// How lines compare with those of the truth.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Shape {
    /// RMS of the curvature off the truth's, in parts of the range of the truth's on each line.
    pub(crate) curvature: f64,
    /// Total variation of the curvature over the truth's: median over the lines.
    pub(crate) variation: f64,
    /// Changes of sign of the curvature beyond the truth's, between humps that count: sums over all waterlines and over all
    /// stations.
    pub(crate) signs: [i64; 2],
    /// Monotone pieces of the curvature beyond the truth's: on the worst line.
    pub(crate) pieces: i64,
}

/// The comparison of lines with those of the truth; a hump counts from a departure of `seen` \[m\] from its chord on.
pub(crate) fn shape(lines: &[Line], drawn: &[Vec<f64>], truth: &[Vec<f64>], seen: f64) -> Shape {
    let curves: Vec<[Vec<f64>; 2]> = lines
        .iter()
        .zip(drawn.iter().zip(truth))
        .map(|(line, (a, b))| [curvature(line, a), curvature(line, b)])
        .collect();
    let totals: Vec<[f64; 2]> = curves.iter().map(|pair| [variation(&pair[0]), variation(&pair[1])]).collect();
    let most = totals.iter().map(|pair| pair[1]).fold(0.0, f64::max);
    let mut ratios: Vec<f64> = totals.iter().filter(|pair| pair[1] > 0.02 * most).map(|[a, b]| a / b).collect();
    ratios.sort_by(f64::total_cmp);
    let (mut parts, mut changes, mut pieces) = (Vec::new(), [0; 2], i64::MIN);
    for ((line, [ours, true_line]), [a, b]) in
        lines.iter().zip(&curves).zip(drawn.iter().zip(truth).map(|(a, b)| [a, b]))
    {
        let which = usize::from(line.direction == Direction::Station);
        changes[which] +=
            sign_changes(line.step(), a, ours, seen) as i64 - sign_changes(line.step(), b, true_line, seen) as i64;
        let Some(range) = range(line, true_line) else { continue };
        parts.extend(ours.iter().zip(true_line).map(|(a, b)| (a - b) / range));
        let least = [0.03, 0.01][which] * range;
        pieces = pieces.max(turns(ours, least) as i64 - turns(true_line, least) as i64);
    }
    Shape {
        curvature: root_mean_square(parts.into_iter()),
        variation: if ratios.is_empty() { f64::NAN } else { quantile(&ratios, 0.5) },
        signs: changes,
        pieces: pieces.max(0),
    }
}
