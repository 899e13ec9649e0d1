//! Suspects among the points of sections that a table gives as lines of points.
//!
//! The place of a point along its section says nothing; its distance from the curve of the others does. Predictors are
//! polynomials through the nearest points, the point itself left out, in a frame whose axis runs from neighbour to
//! neighbour (from the two nearest on one side where a predictor looks to one side only, which is right beside a
//! knuckle). The scale of a predictor is its mean square at the points around, computed as if the point were not there,
//! and at the same share of the girth on the neighbouring sections, moderated by the level of the whole table; of the
//! predictors with the smallest scales the one that the point offends least testifies, as for cells (head of
//! `judge.rs`).
//!
//! Each slip of the pen is tried on the half-breadth and on the height of the point in the notation of the table; its
//! evidence is the distance at which the repaired point would lie (head of `posterior.rs`). Marked knuckles end the
//! predictors.

use super::posterior::{Reading, readings, student};
use super::reading::{Hypothesis, Writing, bare, repairs};
use crate::hull::{OffsetTable, OutlinePoint};

/// A way to predict a point: offsets of its neighbours in the sequence, degree.
pub(super) struct Predictor {
    pub(super) offsets: &'static [isize],
    pub(super) degree: usize,
}

const PREDICTORS: [Predictor; 7] = [
    Predictor { offsets: &[-2, -1, 1, 2], degree: 3 },
    Predictor { offsets: &[-3, -2, -1, 1, 2, 3], degree: 3 },
    Predictor { offsets: &[-1, 1], degree: 1 },
    Predictor { offsets: &[-3, -2, -1], degree: 2 },
    Predictor { offsets: &[1, 2, 3], degree: 2 },
    Predictor { offsets: &[-2, -1], degree: 1 },
    Predictor { offsets: &[1, 2], degree: 1 },
];
/// Farthest neighbour of a predictor.
const MOST_OFFSET: usize = 3;
/// How many predictors are heard, and how far above the smallest scale (squared) one may lie.
const JURY: usize = 3;
const HEARD: f64 = 9.0;
/// Points of the own section that a scale rests on, to either side.
const REACH: usize = 5;
/// Least residuals that a scale rests on.
const LEAST: usize = 4;
/// Weight of the table's level against the residuals around.
const PRIOR: f64 = 4.0;
/// Independent residuals among those of overlapping predictors.
const INDEPENDENT: f64 = 0.6;
/// Variance at a point whose neighbours lie on one side only.
const AT_END: f64 = 4.0;
/// Least score and probability of a suspect, as for cells.
const LEAST_SCORE: f64 = 3.0;
const LEAST_PROBABILITY: f64 = 0.6;
/// Wrong points that a table is expected to have before any has been found, and most suspects as a share of the points.
const UNFOUND: f64 = 0.1;
const MOST: f64 = 0.1;

/// Which number of a point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PointNumber {
    /// The half-breadth y.
    HalfBreadth,
    /// The height z.
    Height,
}

impl PointNumber {
    /// `y` or `z`.
    #[must_use]
    pub fn as_str(self) -> &'static str {
        match self {
            Self::HalfBreadth => "y",
            Self::Height => "z",
        }
    }

    /// The number of a point.
    #[must_use]
    pub fn of(self, point: &OutlinePoint) -> f64 {
        match self {
            Self::HalfBreadth => point.y,
            Self::Height => point.z,
        }
    }
}

/// A point that stands out of its section.
#[derive(Debug, Clone, PartialEq)]
pub struct PointSuspect {
    /// `P1` is the most severe.
    pub id: String,
    /// Index of the station in the table.
    pub station: usize,
    /// Index of the branch of the section.
    pub branch: usize,
    /// Index of the point on the branch.
    pub point: usize,
    /// Which of its numbers is the likelier one to be wrong.
    pub number: PointNumber,
    /// That number as it is written in the notation of the table.
    pub written: String,
    /// The point as given (y, z) \[m\].
    pub given: [f64; 2],
    /// The point of the curve through its neighbours that lies nearest (y, z) \[m\].
    pub expected: [f64; 2],
    /// Distance from that curve \[m\].
    pub distance: f64,
    /// Local noise \[m\]: standard deviation of the distance where nothing is wrong.
    pub noise: f64,
    /// Distance over the local noise, brought to a normal law.
    pub score: f64,
    /// The hypotheses, most probable first; probabilities sum to one.
    pub readings: Vec<Reading>,
    /// Probability that the point is wrong.
    pub probability: f64,
    /// What the number should be in the quantum of the table \[m\].
    pub proposed: f64,
    /// The same as it would be written.
    pub proposed_text: String,
    /// Its line and cell in a table of lines, as boats have them; none in sections.
    pub line: Option<LinePlace>,
}

/// Where a number of a line of a boat stands.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct LinePlace {
    /// Name of the line.
    pub name: String,
    /// Row (line) in the file, from 1.
    pub row: usize,
    /// Column (field) in the file, from 1.
    pub column: usize,
}

impl PointSuspect {
    /// The most probable hypothesis that holds the point for wrong.
    #[must_use]
    pub fn hypothesis(&self) -> Hypothesis {
        self.readings.iter().map(|r| r.hypothesis).find(|&h| h != Hypothesis::Noise).unwrap_or(Hypothesis::Unexplained)
    }
}

/// The suspects among the points of the sections of a table.
#[derive(Debug, Clone, PartialEq)]
pub struct PointSuspects {
    /// Noise of the table \[m\]: standard deviation of the distance of a point from the curve of its neighbours.
    pub noise: f64,
    /// How many points have enough neighbours to be judged.
    pub judged: usize,
    /// The suspects, most severe first.
    pub suspects: Vec<PointSuspect>,
}

/// A smooth part of a section, between knuckles; or a line of a boat as a graph over its length.
pub(super) struct Run {
    pub(super) station: usize,
    pub(super) branch: usize,
    pub(super) first: usize,
    pub(super) points: Vec<[f64; 2]>,
    pub(super) aside: Vec<bool>,
    /// Whether the second number of a point is a function of the first, which is right.
    pub(super) is_graph: bool,
}

/// A prediction: a polynomial d(s) in a frame.
struct Curve {
    origin: [f64; 2],
    axis: [f64; 2],
    s: Vec<f64>,
    d: Vec<f64>,
    degree: usize,
    /// Where the curve is known, s from and to; open where a predictor looks to one side.
    reach: [f64; 2],
    is_graph: bool,
}

impl Curve {
    fn frame(&self, p: [f64; 2]) -> [f64; 2] {
        let (y, z) = (p[0] - self.origin[0], p[1] - self.origin[1]);
        [y * self.axis[0] + z * self.axis[1], z * self.axis[0] - y * self.axis[1]]
    }

    /// The polynomial at `s`: Lagrange's through all points, or least squares by normal equations of the centred powers.
    fn height(&self, s: f64) -> f64 {
        if self.s.len() == self.degree + 1 {
            let weight = |k: usize| {
                let others = (0..self.s.len()).filter(|&j| j != k);
                others.map(|j| (s - self.s[j]) / (self.s[k] - self.s[j])).product::<f64>()
            };
            return (0..self.s.len()).map(|k| self.d[k] * weight(k)).sum();
        }
        let reach = self.s.iter().fold(0.0f64, |a, b| a.max(b.abs())).max(f64::MIN_POSITIVE);
        // Orthogonal polynomials over the points (Forsythe 1957): the sum of projections needs no system.
        let (mut before, mut here) = (vec![0.0; self.s.len()], vec![1.0; self.s.len()]);
        let (mut before_s, mut here_s, mut norm_before, mut sum) = (0.0, 1.0, 1.0, 0.0);
        for degree in 0..=self.degree {
            let norm: f64 = here.iter().map(|q| q * q).sum();
            sum += here.iter().zip(&self.d).map(|(q, d)| q * d).sum::<f64>() / norm * here_s;
            let alpha = here.iter().zip(&self.s).map(|(q, s)| q * q * s / reach).sum::<f64>() / norm;
            let beta = if degree > 0 { norm / norm_before } else { 0.0 };
            let next: Vec<f64> =
                (0..here.len()).map(|k| (self.s[k] / reach - alpha) * here[k] - beta * before[k]).collect();
            let next_s = (s / reach - alpha) * here_s - beta * before_s;
            (before, here, before_s, here_s, norm_before) = (here, next, here_s, next_s, norm);
        }
        sum
    }

    /// Distance of a point from the curve, positive on one side, and the point of the curve beside it.
    fn distance(&self, p: [f64; 2]) -> (f64, [f64; 2]) {
        let [s, d] = self.frame(p);
        if self.is_graph {
            let height = self.height(s);
            return (d - height, [p[0], self.origin[1] + height]);
        }
        let near = s.clamp(self.reach[0], self.reach[1]);
        let height = self.height(near);
        let step = 1e-3 * (self.s.iter().fold(0.0f64, |a, b| a.max(b.abs())));
        let slope = (self.height(near + step) - self.height(near - step)) / (2.0 * step);
        // The normal distance to first order; beyond the reach the way along counts too.
        let across = (d - height) / slope.hypot(1.0);
        let distance = across.hypot(s - near).copysign(d - height);
        let foot = near + (d - height) * slope / (1.0 + slope * slope);
        let foot = foot.clamp(self.reach[0], self.reach[1]);
        let at = self.height(foot);
        let [a, b] = self.axis;
        (distance, [self.origin[0] + foot * a - at * b, self.origin[1] + foot * b + at * a])
    }
}

/// What the neighbours of a point say.
struct Testimony {
    curve: Curve,
    distance: f64,
    foot: [f64; 2],
    scale: f64,
    freedom: f64,
}

impl Testimony {
    /// As `Verdict::score` of cells (Wallace 1959).
    fn score(&self) -> f64 {
        let (t, nu) = (self.distance / self.scale, self.freedom);
        (nu * (t * t / nu).ln_1p()).sqrt() * (8.0 * nu + 1.0) / (8.0 * nu + 3.0)
    }
}

impl Run {
    /// The neighbours of a point on one side that are not set aside, nearest first; `also` is no neighbour either.
    fn side(&self, at: usize, step: isize, also: Option<usize>) -> [Option<[f64; 2]>; MOST_OFFSET] {
        let mut found = [None; MOST_OFFSET];
        let (mut k, mut count) = (at, 0);
        while let Some(next) = k.checked_add_signed(step).filter(|&k| k < self.points.len() && count < MOST_OFFSET) {
            k = next;
            if !self.aside[k] && Some(k) != also {
                found[count] = Some(self.points[k]);
                count += 1;
            }
        }
        found
    }

    /// The curve of one predictor at a point, as if the point `also` were not there either.
    fn curve(&self, predictor: &Predictor, at: usize, also: Option<usize>) -> Option<Curve> {
        let (before, after) = (self.side(at, -1, also), self.side(at, 1, also));
        let index = |offset: isize| {
            let side = if offset < 0 { &before } else { &after };
            side.get(offset.unsigned_abs() - 1).copied().flatten()
        };
        let near: Vec<[f64; 2]> = predictor.offsets.iter().map(|&offset| index(offset)).collect::<Option<_>>()?;
        let two_sided = predictor.offsets[0] < 0 && predictor.offsets[predictor.offsets.len() - 1] > 0;
        let (from, to) = if two_sided {
            (index(-1)?, index(1)?)
        } else if predictor.offsets[0] < 0 {
            (index(-2)?, index(-1)?)
        } else {
            (index(1)?, index(2)?)
        };
        let chord = [to[0] - from[0], to[1] - from[1]];
        let length = chord[0].hypot(chord[1]);
        if length <= 0.0 {
            return None;
        }
        let axis = if self.is_graph { [1.0, 0.0] } else { chord.map(|c| c / length) };
        let reach = match (two_sided, predictor.offsets[0] < 0) {
            (true, _) => [0.0, length],
            (false, true) => [0.0, f64::INFINITY],
            (false, false) => [f64::NEG_INFINITY, length],
        };
        let mut curve = Curve {
            origin: from,
            axis,
            s: Vec::new(),
            d: Vec::new(),
            degree: predictor.degree,
            reach,
            is_graph: self.is_graph,
        };
        for point in near {
            let [s, d] = curve.frame(point);
            curve.s.push(s);
            curve.d.push(d);
        }
        // A section that turns back in this frame is no graph over it.
        curve.s.windows(2).all(|pair| pair[1] - pair[0] > 1e-3 * length).then_some(curve)
    }

    fn share(&self, at: usize) -> f64 {
        at as f64 / (self.points.len() - 1).max(1) as f64
    }
}

pub(super) struct Judge {
    runs: Vec<Run>,
    /// By run the runs at the same branch of the neighbouring stations.
    beside: Vec<Vec<usize>>,
    floor2: f64,
    predictors: &'static [Predictor],
    /// Level of each predictor over the table, squared \[m²\]; none where it rarely applies.
    level2: Vec<Option<f64>>,
}

impl Judge {
    fn of_sections(table: &OffsetTable, quantum: f64) -> Self {
        let mut runs: Vec<Run> = Vec::new();
        for (station, column) in table.stations.iter().enumerate() {
            for (branch, line) in column.outlines.iter().enumerate() {
                let mut first = 0;
                for last in 0..line.len() {
                    if last + 1 == line.len() || (last > first && line[last].marks.knuckle) {
                        let points: Vec<[f64; 2]> = line[first..=last].iter().map(|p| [p.y, p.z]).collect();
                        let aside = vec![false; points.len()];
                        runs.push(Run { station, branch, first, points, aside, is_graph: false });
                        first = last;
                    }
                }
            }
        }
        let beside = runs
            .iter()
            .map(|run| {
                let near = |other: &Run| other.branch == run.branch && other.station.abs_diff(run.station) == 1;
                let same = |other: &Run| (other.first == 0) == (run.first == 0);
                runs.iter().enumerate().filter(|(_, o)| near(o) && same(o)).map(|(k, _)| k).collect()
            })
            .collect();
        Self::new(runs, beside, quantum, &PREDICTORS)
    }

    /// The judge of runs, each with those beside it.
    pub(super) fn new(runs: Vec<Run>, beside: Vec<Vec<usize>>, quantum: f64, predictors: &'static [Predictor]) -> Self {
        let level2 = vec![None; predictors.len()];
        let mut judge = Self { runs, beside, floor2: quantum * quantum / 12.0, predictors, level2 };
        for (q, predictor) in predictors.iter().enumerate() {
            let mut squares: Vec<f64> = Vec::new();
            for run in &judge.runs {
                squares.extend((0..run.points.len()).filter_map(|k| residual(run, predictor, k, None)).map(|r| r * r));
            }
            squares.sort_by(f64::total_cmp);
            // The median of the square of a normal number is 0.455 of its variance.
            judge.level2[q] = squares.get(squares.len() / 2).map(|m| m / 0.455 + judge.floor2);
        }
        judge
    }

    fn testimony(&self, r: usize, at: usize) -> Option<Testimony> {
        let run = &self.runs[r];
        let mut heard: Vec<Testimony> = Vec::new();
        for (q, predictor) in self.predictors.iter().enumerate() {
            let (Some(curve), Some(level2)) = (run.curve(predictor, at, None), self.level2[q]) else { continue };
            let mut squares: Vec<f64> = Vec::new();
            for k in at.saturating_sub(REACH)..(at + REACH + 1).min(run.points.len()) {
                if k != at && !run.aside[k] {
                    squares.extend(residual(run, predictor, k, Some(at)).map(|r| r * r));
                }
            }
            for &other in &self.beside[r] {
                let other = &self.runs[other];
                let place = (run.share(at) * (other.points.len() - 1) as f64).round() as usize;
                for k in place.saturating_sub(1)..(place + 2).min(other.points.len()) {
                    if !other.aside[k] {
                        squares.extend(residual(other, predictor, k, None).map(|r| r * r));
                    }
                }
            }
            if squares.len() < LEAST {
                continue;
            }
            let n = INDEPENDENT * squares.len() as f64;
            let mean = squares.iter().sum::<f64>() / squares.len() as f64;
            let one_sided = at == 0 || at + 1 == run.points.len();
            let scale2 = (PRIOR * level2 + n * mean) / (PRIOR + n) * if one_sided { AT_END } else { 1.0 };
            let (distance, foot) = curve.distance(run.points[at]);
            let scale = scale2.max(self.floor2).sqrt();
            heard.push(Testimony { curve, distance, foot, scale, freedom: PRIOR + n });
        }
        heard.sort_by(|a, b| a.scale.total_cmp(&b.scale));
        let limit = HEARD.sqrt() * heard.first()?.scale;
        let offence = |t: &Testimony| (t.distance / t.scale).abs();
        let jury = heard.into_iter().take(JURY).filter(|t| t.scale <= limit);
        jury.filter(|t| t.distance.is_finite()).min_by(|a, b| offence(a).total_cmp(&offence(b)))
    }
}

fn residual(run: &Run, predictor: &Predictor, at: usize, also: Option<usize>) -> Option<f64> {
    let curve = run.curve(predictor, at, also)?;
    Some(curve.distance(run.points[at]).0).filter(|r| r.is_finite())
}

/// A number of a point that may be wrong: which of the two that the judge knows, its name, its text and cell.
pub(super) struct Number {
    pub(super) index: usize,
    pub(super) number: PointNumber,
    pub(super) text: String,
    pub(super) writing: Writing,
    pub(super) line: Option<LinePlace>,
}

/// What the numbers of points are, by run and point.
pub(super) type Numbers<'n> = dyn Fn(&Run, usize) -> Vec<Number> + 'n;

/// A point with the readings of one of its numbers in front.
fn suspect(judge: &Judge, (r, at): (usize, usize), numbers: &Numbers<'_>, wrong: f64) -> Option<PointSuspect> {
    let testimony = judge.testimony(r, at)?;
    if testimony.score() < LEAST_SCORE {
        return None;
    }
    let run = &judge.runs[r];
    let given = run.points[at];
    let density = |p: [f64; 2]| {
        let (distance, _) = testimony.curve.distance(p);
        student(distance / testimony.scale, testimony.freedom) / testimony.scale
    };
    let mut list = vec![Reading {
        hypothesis: Hypothesis::Noise,
        text: String::new(),
        value: 0.0,
        probability: (1.0 - wrong) * density(given),
    }];
    let numbers = numbers(run, at);
    let mut best = (0, 0.0);
    let foot = testimony.foot;
    for (k, &Number { index, number, ref text, writing, .. }) in numbers.iter().enumerate() {
        let texts = repairs(text, writing);
        for hypothesis in Hypothesis::ALL {
            let total: f64 = texts.iter().filter(|t| t.hypothesis == hypothesis).map(|t| t.weight).sum();
            for repair in texts.iter().filter(|t| t.hypothesis == hypothesis) {
                let mut point = given;
                point[index] = repair.value;
                let probability = wrong * 0.5 * hypothesis.prior() * repair.weight / total * density(point);
                if probability > best.1 {
                    best = (k, probability);
                }
                // The text says which number is meant.
                let text = format!("{} = {}", number.as_str(), repair.text);
                list.push(Reading { hypothesis, text, value: repair.value, probability });
            }
        }
    }
    let unexplained = wrong * Hypothesis::Unexplained.prior() / (20.0 * testimony.distance.abs().max(testimony.scale));
    list.push(Reading {
        hypothesis: Hypothesis::Unexplained,
        text: String::new(),
        value: 0.0,
        probability: unexplained,
    });
    let explained = best.1 > unexplained;
    if !explained {
        // The number that has further to go.
        let way = |k: &usize| (foot[numbers[*k].index] - given[numbers[*k].index]).abs();
        best.0 = (0..numbers.len()).rev().max_by(|a, b| way(a).total_cmp(&way(b)))?;
    }
    // Without a text a reading has what the neighbours predict.
    let predicted = foot[numbers.get(best.0)?.index];
    list.iter_mut().filter(|reading| reading.text.is_empty()).for_each(|reading| reading.value = predicted);
    let readings = readings(list);
    let noise = readings.iter().find(|r| r.hypothesis == Hypothesis::Noise).map_or(0.0, |r| r.probability);
    let &Number { index, number, text: ref written, writing, ref line } = numbers.get(best.0)?;
    let named = readings.iter().find(|r| r.hypothesis != Hypothesis::Noise).filter(|_| explained);
    let proposed_text = named.and_then(|r| r.text.split_once(" = ")).map(|(_, text)| text.to_owned());
    let proposed_text = proposed_text.unwrap_or_else(|| writing.write(foot[index]));
    Some(PointSuspect {
        id: String::new(),
        station: run.station,
        branch: run.branch,
        point: run.first + at,
        number,
        written: bare(written).to_owned(),
        given,
        expected: foot,
        distance: testimony.distance.abs(),
        noise: testimony.scale,
        score: testimony.score(),
        probability: 1.0 - noise,
        proposed: writing.read(&proposed_text).unwrap_or(foot[index]),
        proposed_text,
        readings,
        line: line.clone(),
    })
}

/// The suspects among the points of the sections of a table; nothing is changed. The strongest is set aside before the
/// next is looked for, and all are heard again at the end. Cost: linear in the points, and in the points of a section
/// for each suspect.
pub(super) fn section_suspects(table: &OffsetTable) -> PointSuspects {
    let quantum = table.form.quantum().unwrap_or(1e-4);
    // Sections are half sections whatever the grid of a table is.
    let writing = Writing { factor: 1.0, ..Writing::of(&table.form) };
    let numbers = |run: &Run, at: usize| {
        let both = [PointNumber::HalfBreadth, PointNumber::Height].into_iter().enumerate();
        both.map(|(index, number)| {
            let text = writing.write(run.points[at][index]);
            Number { index, number, text, writing, line: None }
        })
        .collect()
    };
    search(Judge::of_sections(table, quantum), &numbers)
}

/// The suspects that a judge finds.
pub(super) fn search(mut judge: Judge, numbers: &Numbers<'_>) -> PointSuspects {
    let count: usize = judge.runs.iter().map(|run| run.points.len()).sum();
    let wrong = |found: usize| ((UNFOUND + found as f64) / count.max(1) as f64).min(MOST);
    let of_run = |judge: &Judge, r: usize, found: usize| -> Vec<(usize, PointSuspect)> {
        let points = 0..judge.runs[r].points.len();
        let heard = points.filter(|&k| !judge.runs[r].aside[k]);
        heard.filter_map(|k| Some((k, suspect(judge, (r, k), numbers, wrong(found))?))).collect()
    };
    let judged = (0..judge.runs.len())
        .map(|r| (0..judge.runs[r].points.len()).filter(|&k| judge.testimony(r, k).is_some()).count())
        .sum();
    let mut candidates: Vec<Vec<(usize, PointSuspect)>> = (0..judge.runs.len()).map(|r| of_run(&judge, r, 0)).collect();
    let mut found: Vec<(usize, usize)> = Vec::new();
    let most = (MOST * count as f64).ceil() as usize;
    while found.len() < most {
        let strong = |s: &PointSuspect| s.probability >= LEAST_PROBABILITY;
        let all = candidates.iter().enumerate().flat_map(|(r, list)| list.iter().map(move |(k, s)| (r, *k, s)));
        let best = all.filter(|(_, _, s)| strong(s)).max_by(|a, b| a.2.score.total_cmp(&b.2.score));
        let Some((r, k)) = best.map(|(r, k, _)| (r, k)) else { break };
        judge.runs[r].aside[k] = true;
        found.push((r, k));
        let again: Vec<usize> = judge.beside[r].iter().copied().chain([r]).collect();
        for r in again {
            candidates[r] = of_run(&judge, r, 0);
        }
    }
    // Heard again: what stood out only beside another wrong point is none.
    let mut suspects: Vec<PointSuspect> = found
        .iter()
        .filter_map(|&(r, k)| {
            let others = found.len().saturating_sub(1);
            suspect(&judge, (r, k), numbers, wrong(others)).filter(|s| s.probability >= LEAST_PROBABILITY)
        })
        .collect();
    suspects.sort_by(|a, b| b.score.total_cmp(&a.score));
    for (index, suspect) in suspects.iter_mut().enumerate() {
        suspect.id = format!("P{}", index + 1);
    }
    PointSuspects { noise: judge.level2[0].unwrap_or(judge.floor2).sqrt(), judged, suspects }
}
