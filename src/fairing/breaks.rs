//! Straight parts of a table: parallel bodies, flats of side and bottom, straight floors, found from the offsets, and
//! how the curves leave them.
//!
//! The lines that run one way (all waterlines, or all stations) are straight between two offsets when the straight
//! lines of least squares leave no more than the noise,
//!
//! ```text
//! RSS <= sigma^2 (f + 3 sqrt(2 f)),   f = (sites - 2) lines.
//! ```
//!
//! The longest such parts are taken, and once more those of 1.3 sigma, since sigma may have been estimated too low by
//! chance (by a quarter or more in three of thirty tables of the benchmark's middle body with 10 mm): of both lists the
//! one with the least criterion below stands. At their ends the curves are continuous in value and slope (tangent line:
//! four-fold knot of a quintic net) or in curvature as well (three-fold knot); kind and place come from pooled
//! cross-validation, in which all lines are smoothed one by one on the same knots with the same weight and share their
//! leverages h,
//!
//! ```text
//! GCV = M RSS / (M - gamma L sum h)^2,   M readings on L lines, gamma = 1.2.
//! ```
//!
//! Parts that do not lower its least value are dropped. Tried without success: breaks anywhere, taken one by one while
//! the criterion falls (the two shoulders of a parallel body show together only, and a tangent line of a bilge is taken
//! for two breaks beside it).

use super::smoothing::GAMMA;
use crate::numeric::SymmetricBand;
use crate::spline::{Gram, KnotVector, SplineError};

/// Deviations of the sum of squares above its mean that noise is given.
const DEVIATIONS: f64 = 3.0;

/// Times the noise that straight lines may leave where it was estimated too low by chance; the criterion decides.
const DOUBT: f64 = 1.3;

/// Fewest offsets of a straight part.
const LEAST: usize = 3;

/// Steps of the golden section for a place.
const STEPS: usize = 7;

/// Powers of ten of the weight that are tried.
const POWERS: [i32; 2] = [-10, 4];

/// Degree of the splines.
const DEGREE: usize = 5;

/// Places nearer than this are one.
const SAME: f64 = 1e-9;

/// Weight of straightness over that of the offsets.
pub(super) const STIFF: f64 = 1e4;

/// A line across which a derivative breaks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Break {
    /// Where, from 0 to 1.
    pub at: f64,
    /// Highest derivative that is continuous: 0 on a knuckle, 1 on a tangent line, 2 where the third one breaks.
    pub smooth: usize,
}

/// The least value of the criterion, and the power of ten of the weight that has it.
#[derive(Debug, Clone, Copy)]
struct Fit {
    gcv: f64,
    power: i32,
}

/// What is special about lines that run one way.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Course {
    /// Breaks, rising.
    pub breaks: Vec<Break>,
    /// Straight parts, from 0 to 1.
    pub straight: Vec<[f64; 2]>,
}

impl Course {
    fn is_straight(&self, from: f64, to: f64) -> bool {
        let mid = 0.5 * (from + to);
        self.straight.iter().any(|[a, b]| (*a..=*b).contains(&mid))
    }

    /// Quintic knots on [0, 1] with the breaks, and about `spans` spans shared out by the numbers of the offsets
    /// between the breaks; straight parts have one.
    ///
    /// # Errors
    /// [`SplineError`] when breaks coincide.
    pub fn knots(&self, sites: &[f64], spans: usize) -> Result<KnotVector, SplineError> {
        let breaks = &self.breaks;
        let degree = DEGREE.min(sites.len().saturating_sub(1)).max(1);
        if breaks.is_empty() {
            return KnotVector::uniform(degree, spans.max(1));
        }
        let ends: Vec<f64> = std::iter::once(0.0).chain(breaks.iter().map(|b| b.at)).chain([1.0]).collect();
        let per_interval = spans as f64 / (sites.len() - 1) as f64;
        // Offsets up to t, with the part of the interval in which it lies.
        let passed = |t: f64| {
            let k = sites.partition_point(|s| *s <= t).clamp(1, sites.len() - 1);
            (k - 1) as f64 + (t - sites[k - 1]) / (sites[k] - sites[k - 1])
        };
        let (mut points, mut multiplicities) = (vec![0.0], Vec::new());
        for (piece, pair) in ends.windows(2).enumerate() {
            let share = (passed(pair[1]) - passed(pair[0])) * per_interval;
            let count = if self.is_straight(pair[0], pair[1]) { 1 } else { share.round().max(1.0) as usize };
            for k in 1..=count {
                points.push(if k == count { pair[1] } else { pair[0] + (pair[1] - pair[0]) * k as f64 / count as f64 });
                let inner =
                    if k < count { 1 } else { breaks.get(piece).map_or(1, |b| degree - b.smooth.min(degree - 1)) };
                multiplicities.push(inner);
            }
        }
        multiplicities.pop();
        KnotVector::from_breakpoints(degree, &points, &multiplicities)
    }

    /// sum over the straight parts of int (d^2 y / dt^2)^2 dt, none where there are none.
    #[must_use]
    pub fn stiffness(&self, knots: &KnotVector) -> Option<Vec<Gram>> {
        let parts = self.straight.iter().map(|[a, b]| Gram::over(knots, knots, [2, 2], *a, *b));
        (!self.straight.is_empty()).then(|| parts.collect())
    }
}

/// Whether no value is missing.
fn is_whole(values: &[f64]) -> bool {
    values.iter().all(|value| value.is_finite())
}

/// Offsets on parallel lines, the same sites on all.
#[derive(Debug, Clone)]
pub struct Lines {
    /// Sites, rising from 0 to 1.
    pub sites: Vec<f64>,
    /// Values of each line \[m\]; not a number where there is none.
    pub values: Vec<Vec<f64>>,
    /// Spans of the knots without breaks.
    pub spans: usize,
}

impl Lines {
    /// The least value of the criterion over the weight, downhill from the power `near` of a course like this where it
    /// is known; none where no weight determines the splines.
    fn criterion(&self, course: &Course, near: Option<i32>) -> Option<Fit> {
        let lines: Vec<&Vec<f64>> = self.values.iter().filter(|values| is_whole(values)).collect();
        let knots = course.knots(&self.sites, self.spans).ok()?;
        let (n, p) = (knots.basis_count(), knots.degree());
        let order = 4.min(p);
        let gram = Gram::new(&knots, &knots, [order, order]);
        let width = p.min(n - 1);
        let (mut energy, mut normal) = (SymmetricBand::zeros(n, width), SymmetricBand::zeros(n, width));
        for i in 0..n {
            for j in i.saturating_sub(width)..=i {
                energy.add(i, j, gram.get(i, j));
            }
        }
        let rows: Vec<(usize, [f64; 8])> = self
            .sites
            .iter()
            .map(|&t| {
                let span = knots.find_span(t);
                (span - p, knots.basis(span, t))
            })
            .collect();
        for (first, basis) in &rows {
            for a in 0..=p {
                for b in 0..=a {
                    normal.add(first + a, first + b, basis[a] * basis[b]);
                }
            }
        }
        // A column a line.
        let mut right = vec![0.0; n * lines.len()];
        for (site, (first, basis)) in rows.iter().enumerate() {
            for a in 0..=p {
                let row = &mut right[(first + a) * lines.len()..(first + a + 1) * lines.len()];
                row.iter_mut().zip(&lines).for_each(|(sum, values)| *sum += basis[a] * values[site]);
            }
        }
        let unit = normal.trace() / energy.trace().max(f64::MIN_POSITIVE);
        if let Some(parts) = course.stiffness(&knots) {
            let mut stiff = SymmetricBand::zeros(n, width);
            for part in &parts {
                for i in 0..n {
                    for j in i.saturating_sub(width)..=i {
                        stiff.add(i, j, part.get(i, j));
                    }
                }
            }
            normal = normal.plus(STIFF * normal.trace() / stiff.trace().max(f64::MIN_POSITIVE), &stiff);
        }
        let count = (self.sites.len() * lines.len()) as f64;
        // None where the splines are not determined; no number where they take all freedom.
        let at = |power: i32| -> Option<f64> {
            let factor = normal.factor_plus(unit * 10f64.powi(power), &energy).ok()?;
            let inverse = factor.inverse_band();
            let edf: f64 = rows
                .iter()
                .map(|(first, basis)| {
                    inverse.quadratic_form(basis[..=p].iter().enumerate().map(|(a, b)| (first + a, *b)))
                })
                .sum();
            let freedom = count - GAMMA * edf * lines.len() as f64;
            if freedom <= 0.0 {
                return Some(f64::NAN);
            }
            let mut c = right.clone();
            factor.solve_columns(&mut c, lines.len());
            let mut rss = 0.0;
            for (site, (first, basis)) in rows.iter().enumerate() {
                for (line, values) in lines.iter().enumerate() {
                    let at: f64 = (0..=p).map(|a| basis[a] * c[(first + a) * lines.len() + line]).sum();
                    rss += (at - values[site]).powi(2);
                }
            }
            Some(count * rss / (freedom * freedom))
        };
        if let Some(near) = near
            && let Some(gcv) = at(near).filter(|gcv| gcv.is_finite())
        {
            let mut least = Fit { gcv, power: near };
            for step in [1, -1] {
                let range = POWERS[0]..=POWERS[1];
                let mut power = least.power + step;
                while range.contains(&power)
                    && let Some(gcv) = at(power).filter(|gcv| *gcv < least.gcv)
                {
                    least = Fit { gcv, power };
                    power += step;
                }
                if least.power != near {
                    break;
                }
            }
            return Some(least);
        }
        let mut least: Option<Fit> = None;
        for power in (POWERS[0]..=POWERS[1]).rev() {
            let Some(gcv) = at(power) else { continue };
            if gcv.is_nan() || least.is_some_and(|least| gcv > 4.0 * least.gcv) {
                break;
            }
            if least.is_none_or(|least| gcv < least.gcv) {
                least = Some(Fit { gcv, power });
            }
        }
        least
    }

    /// Longest parts between offsets, as (first, last), that are straight within the noise; two may share an end.
    fn straight_runs(&self, noise: f64) -> Vec<(usize, usize)> {
        let n = self.sites.len();
        let straight = |from: usize, to: usize| {
            let sites = &self.sites[from..=to];
            let count = sites.len() as f64;
            let mean = sites.iter().sum::<f64>() / count;
            let spread: f64 = sites.iter().map(|t| (t - mean).powi(2)).sum();
            let whole = self.values.iter().map(|values| &values[from..=to]).filter(|values| is_whole(values));
            let lines = whole.clone().count();
            let left: f64 = whole
                .map(|values| {
                    let middle = values.iter().sum::<f64>() / count;
                    let slope = sites.iter().zip(values).map(|(t, y)| (t - mean) * (y - middle)).sum::<f64>() / spread;
                    sites.iter().zip(values).map(|(t, y)| (y - middle - slope * (t - mean)).powi(2)).sum::<f64>()
                })
                .sum();
            let freedom = (count - 2.0) * lines as f64;
            2 * lines > self.values.len() && left <= noise * noise * (freedom + DEVIATIONS * (2.0 * freedom).sqrt())
        };
        let mut runs: Vec<(usize, usize)> = Vec::new();
        for from in 0..n.saturating_sub(LEAST - 1) {
            let last = (from + LEAST - 1..n).take_while(|&to| straight(from, to)).last();
            runs.extend(last.map(|to| (from, to)));
        }
        runs.sort_by_key(|(from, to)| (n - (to - from), *from));
        let mut kept: Vec<(usize, usize)> = Vec::new();
        for (from, to) in runs {
            if kept.iter().all(|(a, b)| to <= *a || from >= *b) && (from, to) != (0, n - 1) {
                kept.push((from, to));
            }
        }
        kept.sort_unstable();
        kept
    }

    /// Breaks and straight parts, beside breaks that are given and stay.
    #[must_use]
    pub fn course(&self, given: &[Break], noise: f64) -> Course {
        let mut best = Course { breaks: given.to_vec(), straight: Vec::new() };
        best.breaks.sort_by(|a, b| a.at.total_cmp(&b.at));
        let plain = self.straight_runs(noise);
        let mut doubted = self.straight_runs(DOUBT * noise);
        // What noise makes straight by chance is short.
        doubted.retain(|run| run.1 - run.0 >= LEAST || plain.contains(run));
        let mut tried = vec![plain, doubted];
        tried.dedup();
        tried.retain(|runs| !runs.is_empty());
        if tried.is_empty() {
            return best;
        }
        let bare = best.clone();
        let whole = self.criterion(&best, None).unwrap_or(Fit { gcv: f64::INFINITY, power: 0 });
        let mut least = whole;
        for runs in tried {
            let (mut now, mut found) = (whole, bare.clone());
            for (from, to) in runs {
                if let Some((fit, course)) = self.with_part(&found, from, to)
                    && fit.gcv < now.gcv
                {
                    (now, found) = (fit, course);
                }
            }
            if now.gcv < least.gcv {
                (least, best) = (now, found);
            }
        }
        best
    }

    /// The best course with one more straight part between two sites, where it begins and ends, and how smoothly.
    fn with_part(&self, old: &Course, from: usize, to: usize) -> Option<(Fit, Course)> {
        let n = self.sites.len();
        let shape = |ends: [Break; 2]| {
            let mut course = old.clone();
            let inside = |b: &Break| ends[0].at - SAME < b.at && b.at < ends[1].at + SAME;
            let declared: Vec<Break> = course.breaks.iter().copied().filter(inside).collect();
            course.breaks.retain(|b| !inside(b));
            for (end, outer) in ends.into_iter().zip([0.0, 1.0]) {
                let before = declared.iter().find(|b| (b.at - end.at).abs() < SAME);
                if (end.at - outer).abs() > SAME {
                    course.breaks.push(before.map_or(end, |b| Break { smooth: b.smooth.min(end.smooth), ..end }));
                }
            }
            course.breaks.sort_by(|a, b| a.at.total_cmp(&b.at));
            course.straight.push([ends[0].at, ends[1].at]);
            course
        };
        let mut near = None;
        let mut of = |ends: [Break; 2]| {
            let found = self.criterion(&shape(ends), near);
            near = found.map(|fit| fit.power).or(near);
            found.unwrap_or(Fit { gcv: f64::INFINITY, power: 0 })
        };
        let mut ends = [from, to].map(|k| Break { at: self.sites[k], smooth: 2 });
        let mut least = of(ends);
        for side in 0..2 {
            let k = [from, to][side];
            if k == 0 || k == n - 1 {
                continue;
            }
            for smooth in [2, 1] {
                // The place at an offset first: that is where draughtsmen put them.
                let mut at = |t: f64| {
                    let mut other = ends;
                    other[side] = Break { at: t, smooth };
                    (of(other), other)
                };
                let mut found = vec![at(self.sites[k])];
                let golden = 0.5 * (5f64.sqrt() - 1.0);
                let [mut a, mut b] = [self.sites[k - 1], self.sites[k + 1]];
                let [mut p, mut q] = [b - golden * (b - a), a + golden * (b - a)].map(|t| (t, at(t)));
                found.extend([p.1, q.1]);
                for _ in 0..STEPS {
                    if p.1.0.gcv <= q.1.0.gcv {
                        (b, q) = (q.0, p);
                        let t = b - golden * (b - a);
                        p = (t, at(t));
                        found.push(p.1);
                    } else {
                        (a, p) = (p.0, q);
                        let t = a + golden * (b - a);
                        q = (t, at(t));
                        found.push(q.1);
                    }
                }
                for (value, other) in found {
                    if value.gcv < least.gcv * (1.0 - 1e-3) {
                        (least, ends) = (value, other);
                    }
                }
            }
        }
        least.gcv.is_finite().then(|| (least, shape(ends)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Noise of up to one on an even grid, the same for ever.
    fn jitter(i: usize, j: usize) -> f64 {
        ((i * 7919 + j * 104_729) % 1009) as f64 / 504.0 - 1.0
    }

    fn lines(sites: Vec<f64>, count: usize, noise: f64, y: impl Fn(f64, f64) -> f64) -> Lines {
        let values = (0..count).map(|j| {
            let scale = (j + 1) as f64 / count as f64;
            sites.iter().enumerate().map(|(i, &t)| y(t, scale) + noise * jitter(i, j)).collect()
        });
        Lines { values: values.collect(), spans: sites.len() / 2, sites }
    }

    fn even(n: usize) -> Vec<f64> {
        (0..n).map(|k| k as f64 / (n - 1) as f64).collect()
    }

    /// A parallel body from 0.36 to 0.64 between cubic ends; none where the waterlines are parabolas or most lines have
    /// gaps.
    #[test]
    fn a_parallel_body_and_none() {
        let body = |t: f64, b: f64| 8.0 * b * (1.0 - (((t - 0.5).abs() - 0.14).max(0.0) / 0.36).powi(3));
        let mut table = lines(even(21), 12, 0.002, body);
        let found = table.course(&[], 0.0015);
        let [[from, to]] = found.straight[..] else { panic!("{found:?}") };
        assert!((from - 0.36).abs() < 0.02 && (to - 0.64).abs() < 0.02, "{found:?}");
        assert!(found.breaks.len() == 2 && found.breaks.iter().all(|b| b.smooth == 2), "{found:?}");
        table.values[3][10] = f64::NAN;
        assert_eq!(table.course(&[], 0.0015).straight.len(), 1);
        table.values[..7].iter_mut().for_each(|values| values.fill(f64::NAN));
        assert_eq!(table.course(&[], 0.0015), Course::default());
        let curved = lines(even(21), 12, 0.002, |t, b| 20.0 * b * t * (1.0 - t));
        assert_eq!(curved.course(&[], 0.0015), Course::default());
    }

    /// Floor, arc of radius 5 m and vertical side of a section: both tangent lines, from the offsets alone.
    #[test]
    fn the_tangent_lines_of_a_bilge() {
        let (low, high) = (2.7133 / 9.0, 7.0434 / 9.0);
        let section = |t: f64, b: f64| {
            let z = 9.0 * t;
            let y = match z {
                z if t <= low => 0.8 + z / 30f64.to_radians().tan(),
                z if t < high => 3.0 + (25.0 - (7.0434 - z).powi(2)).max(0.0).sqrt(),
                _ => 8.0,
            };
            y * b
        };
        let sites = [0.0, 0.9, 1.8, 9.0 * low, 3.3, 4.0, 4.8, 5.6, 6.4, 9.0 * high, 8.0, 9.0].map(|z| z / 9.0);
        let found = lines(sites.to_vec(), 21, 0.002, section).course(&[], 0.0015);
        let [[bottom, a], [b, top]] = found.straight[..] else { panic!("{found:?}") };
        assert!(bottom == 0.0 && (top - 1.0).abs() < 1e-12, "{found:?}");
        assert!((a - low).abs() < 0.04 && (b - high).abs() < 0.06, "{found:?}");
    }

    /// Between the breaks the spans go by the offsets, and each break has the knots that its smoothness asks for.
    #[test]
    fn knots_of_a_course() {
        let breaks = vec![Break { at: 0.3, smooth: 1 }, Break { at: 0.7, smooth: 2 }];
        let course = Course { breaks, straight: vec![[0.3, 0.7]] };
        let knots = course.knots(&even(21), 10).unwrap();
        assert_eq!([0.3, 0.7].map(|t| knots.multiplicity(t)), [4, 3]);
        assert_eq!(knots.breakpoints().len() - 1, 3 + 1 + 3);
        let stiff = course.stiffness(&knots).unwrap();
        let line: Vec<f64> = knots.greville().iter().map(|t| 2.0 * t - 1.0).collect();
        let bent: Vec<f64> = line.iter().map(|t| t * t).collect();
        let size = |c: &[f64]| stiff[0].apply(c).iter().zip(c).map(|(a, b)| a * b).sum::<f64>();
        assert!(size(&line).abs() < 1e-9 && size(&bent) > 1.0, "{} {}", size(&line), size(&bent));
    }
}
