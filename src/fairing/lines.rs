//! Knuckles and tangent lines that a table has and does not declare, along its waterlines and stations.
//!
//! On each crossing line a window of offsets about the place in question is described by two rivals of five
//! coefficients, one smooth and one with a break at the place t = 0 (least squares):
//!
//! * smooth: 1, t, t², t³, t⁴,
//! * knuckle: 1, t, t², t₊, t₊² (value continuous, slope broken),
//! * tangent line: 1, t, t², t³, t₊² (slope continuous, curvature broken).
//!
//! A smooth line is followed better by the smooth rival, however much it is curved, and noise prefers neither. A line
//! is proposed where, over a run of neighbouring crossing lines, the break explains what the smooth rival leaves, by
//! more than the noise of the table and down to that noise. The gain is the root of the ratio of the sums of squares
//! that the rivals leave.

use super::suspects::{Along, Grid, Suspects};
use crate::hull::OffsetTable;

/// Offsets on each side of a place: where a line of the table runs through it, and between two of them.
const SIDE: [usize; 2] = [3, 4];
/// Most offsets in a window.
const MOST: usize = 8;
/// Coefficients of each rival.
const COEFFICIENTS: usize = 5;
/// Fewest crossing lines of a proposal.
const LEAST_LINES: usize = 5;
/// Least gain of a proposal.
const LEAST_GAIN: f64 = 2.5;
/// Least fall of the sum of squares on one crossing line, in noise variances, that speaks for the break.
const LEAST_FALL: f64 = 6.0;
/// Least fall of the sum of squares over all crossing lines of a proposal, for each of them, in noise variances.
const LEAST_MEAN_FALL: f64 = 20.0;
/// Most that the rival with the break leaves, in standard deviations of the noise; of no account from a gain of
/// [`CLEAR_GAIN`].
const MOST_LEFT: f64 = 2.0;
/// Gain from which a break is clear although the curve on its sides is no parabola.
const CLEAR_GAIN: f64 = 5.0;
/// Share of the gain of a knuckle at the same place from which a tangent line is proposed instead: beside an arc the
/// knuckle's rival, a parabola on each side, may be the closer one although the slope does not break.
const GENTLER: f64 = 0.4;
/// Proposals of one kind of place nearer than this many half steps hide the weaker.
const HIDDEN: usize = 4;

/// What breaks along a line.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum LineKind {
    /// The slope.
    Knuckle,
    /// The curvature: a flat or a straight part begins.
    Tangent,
}

impl LineKind {
    /// `knuckle`, `tangent`.
    #[must_use]
    pub fn as_str(self) -> &'static str {
        match self {
            Self::Knuckle => "knuckle",
            Self::Tangent => "tangent",
        }
    }
}

/// Which way a proposed line runs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum LineCourse {
    /// At one height, along the ship.
    Waterline,
    /// At one station, up the side.
    Station,
}

impl LineCourse {
    /// `waterline`, `station`.
    #[must_use]
    pub fn as_str(self) -> &'static str {
        match self {
            Self::Waterline => "waterline",
            Self::Station => "station",
        }
    }
}

/// A line that the offsets speak for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ProposedLine {
    /// What breaks.
    pub kind: LineKind,
    /// Which way it runs.
    pub course: LineCourse,
    /// Height of the line \[m\] or its place forward of AP \[m\].
    pub at: f64,
    /// First and last crossing line: places of stations forward of AP \[m\], or heights \[m\].
    pub reach: [f64; 2],
    /// Root mean square that the smooth rival leaves over what the break leaves.
    pub gain: f64,
}

/// What the rivals leave on one crossing line: sums of squares \[m²\].
#[derive(Debug, Clone, Copy, Default)]
struct Left {
    smooth: f64,
    /// By kind.
    broken: [f64; 2],
    freedom: f64,
}

/// The sum of squares that the least-squares combination of `columns` leaves of `y`.
fn left(columns: &[[f64; MOST]; COEFFICIENTS], y: &[f64; MOST], n: usize) -> f64 {
    let mut basis: [[f64; MOST]; COEFFICIENTS] = [[0.0; MOST]; COEFFICIENTS];
    let mut rest = *y;
    let dot = |a: &[f64; MOST], b: &[f64; MOST]| (0..n).map(|k| a[k] * b[k]).sum::<f64>();
    for (count, column) in columns.iter().enumerate() {
        let mut v = *column;
        let before = dot(&v, &v);
        for _ in 0..2 {
            for q in &basis[..count] {
                let h = dot(&v, q);
                (0..n).for_each(|k| v[k] -= h * q[k]);
            }
        }
        let norm2 = dot(&v, &v);
        if norm2 > 1e-20 * before {
            v.iter_mut().for_each(|a| *a /= norm2.sqrt());
            let h = dot(&rest, &v);
            (0..n).for_each(|k| rest[k] -= h * v[k]);
            basis[count] = v;
        }
    }
    dot(&rest, &rest)
}

/// What the rivals leave in a window of offsets `y` at `t`, with the break at 0.
fn compare(t: &[f64], y: &[f64; MOST]) -> Left {
    let reach = t.iter().fold(0.0f64, |a, b| a.max(b.abs()));
    let column = |f: &dyn Fn(f64) -> f64| {
        let mut values = [0.0; MOST];
        values.iter_mut().zip(t).for_each(|(value, &t)| *value = f(t / reach));
        values
    };
    let power = |p: i32| column(&|t| t.powi(p));
    let ramp = |p: i32| column(&|t| t.max(0.0).powi(p));
    let n = t.len();
    let smooth = left(&[power(0), power(1), power(2), power(3), power(4)], y, n);
    let knuckle = left(&[power(0), power(1), power(2), ramp(1), ramp(2)], y, n);
    let tangent = left(&[power(0), power(1), power(2), power(3), ramp(2)], y, n);
    Left { smooth, broken: [knuckle, tangent], freedom: (n - COEFFICIENTS) as f64 }
}

/// The rivals on a crossing line `run` (cells in order along it) at the coordinate `at`; none where too few offsets of
/// the run lie on one of the sides.
fn on_line(grid: &Grid, values: &[f64], along: Along, run: &[usize], at: f64, between: bool) -> Option<Left> {
    let above = run.partition_point(|&cell| grid.coordinate(along, cell) < at);
    let side = SIDE[usize::from(between)];
    let on = usize::from(!between);
    if !between && run.get(above).is_none_or(|&cell| grid.coordinate(along, cell) > at) {
        return None;
    }
    let from = above.checked_sub(side)?;
    let cells = run.get(from..above + on + side)?;
    let (mut t, mut y) = ([0.0; MOST], [0.0; MOST]);
    for (k, &cell) in cells.iter().enumerate() {
        t[k] = grid.coordinate(along, cell) - at;
        y[k] = values[cell];
    }
    Some(compare(&t[..cells.len()], &y))
}

/// The run of crossing lines in which the break explains most: first, behind the last.
fn best_run(lines: &[Option<Left>], kind: usize, noise2: f64) -> Option<(usize, usize)> {
    let (mut best, mut best_sum) = (None, 0.0);
    let (mut from, mut sum) = (0, 0.0);
    for (k, line) in lines.iter().enumerate() {
        let fall = line
            .map_or(f64::NEG_INFINITY, |l| ((l.smooth - l.broken[kind]) / noise2).min(20.0 * LEAST_FALL) - LEAST_FALL);
        if sum + fall < 0.0 {
            (from, sum) = (k + 1, 0.0);
            continue;
        }
        sum += fall;
        if sum > best_sum {
            (best, best_sum) = (Some((from, k + 1)), sum);
        }
    }
    best.filter(|(from, to)| to - from >= LEAST_LINES)
}

/// Proposals for lines that run one way; `along` is the way of the crossing lines.
fn proposals(grid: &Grid, values: &[f64], along: Along, noise2: f64) -> Vec<ProposedLine> {
    let (places, crossings, course) = match along {
        Along::Station => (&grid.z, &grid.x, LineCourse::Waterline),
        Along::Waterline => (&grid.x, &grid.z, LineCourse::Station),
    };
    let runs: Vec<Vec<Vec<usize>>> = (0..crossings.len()).map(|line| grid.runs(along, line)).collect();
    let mut found: Vec<(usize, ProposedLine)> = Vec::new();
    for half in 0..(2 * places.len()).saturating_sub(1) {
        let between = half % 2 == 1;
        let at = if between { 0.5 * (places[half / 2] + places[half / 2 + 1]) } else { places[half / 2] };
        let lines: Vec<Option<Left>> = runs
            .iter()
            .map(|runs| runs.iter().find_map(|run| on_line(grid, values, along, run, at, between)))
            .collect();
        for (k, kind) in [LineKind::Knuckle, LineKind::Tangent].into_iter().enumerate() {
            let Some((from, to)) = best_run(&lines, k, noise2) else { continue };
            let mut all = Left::default();
            for line in lines[from..to].iter().flatten() {
                all.smooth += line.smooth;
                all.broken[k] += line.broken[k];
                all.freedom += line.freedom;
            }
            let noise = noise2 * all.freedom;
            let gain = ((all.smooth + noise) / (all.broken[k] + noise)).sqrt();
            let fall = (all.smooth - all.broken[k]) / (noise2 * (to - from) as f64);
            let rough = all.broken[k] > MOST_LEFT * MOST_LEFT * noise && gain < CLEAR_GAIN;
            if gain < LEAST_GAIN || fall < LEAST_MEAN_FALL || rough {
                continue;
            }
            let reach = [crossings[from], crossings[to - 1]];
            found.push((half, ProposedLine { kind, course, at, reach, gain }));
        }
    }
    let gentler = |half: usize, knuckle: &ProposedLine| {
        found.iter().any(|(other, line)| {
            *other == half && line.kind == LineKind::Tangent && line.gain >= GENTLER * knuckle.gain
        })
    };
    let hard: Vec<bool> =
        found.iter().map(|(half, line)| line.kind == LineKind::Tangent || !gentler(*half, line)).collect();
    let mut keep = hard.into_iter();
    found.retain(|_| keep.next().unwrap_or(true));
    // The strongest of those that describe one break from neighbouring places.
    found.sort_by(|a, b| b.1.gain.total_cmp(&a.1.gain).then(a.0.cmp(&b.0)));
    let mut kept: Vec<(usize, ProposedLine)> = Vec::new();
    for (half, line) in found {
        let hidden = |(other, strong): &(usize, ProposedLine)| {
            other.abs_diff(half) <= HIDDEN && strong.reach[0] <= line.reach[1] && line.reach[0] <= strong.reach[1]
        };
        if !kept.iter().any(hidden) {
            kept.push((half, line));
        }
    }
    kept.into_iter().map(|(_, line)| line).collect()
}

/// Lines along waterlines and stations that the offsets of a table speak for, the greatest gain first. Suspects count
/// with what their neighbours predict.
#[must_use]
pub fn proposed_lines(table: &OffsetTable, suspects: &Suspects) -> Vec<ProposedLine> {
    let grid = Grid::new(table);
    let mut values = grid.value.clone();
    for suspect in &suspects.suspects {
        if let Some(value) = values.get_mut(suspect.station * table.waterlines.len() + suspect.waterline) {
            *value = suspect.verdict.expected;
        }
    }
    let noise2 = suspects.noise * suspects.noise;
    if noise2 <= 0.0 {
        return Vec::new();
    }
    let mut list: Vec<ProposedLine> =
        Along::BOTH.into_iter().flat_map(|along| proposals(&grid, &values, along, noise2)).collect();
    list.sort_by(|a, b| b.gain.total_cmp(&a.gain));
    list
}
