//! The bound from below, the spline from above, and what is done where they do not meet.

use std::collections::BTreeSet;

use super::attain::{Pattern, Tried, dead_band, least_factor};
use super::bands::{Bands, Bend};
use super::space::Space;
use super::witness::{Chain, windows};
use crate::spline::BsplineCurve;

/// Knots between the sites, tried one after the other.
const REFINEMENTS: [usize; 3] = [0, 1, 3];
/// Most linear programs of one search.
const PROGRAMS: usize = 150;
/// Most patterns that are excluded one by one.
const PATTERNS: usize = 600;
/// A factor that counts as 1: the precision to which the programs are solved.
const WITHIN: f64 = 1.0 + 1e-7;
/// The greatest factor on the tolerances that is looked for.
const FARTHEST: f64 = 1e6;

/// Where an inflection can be.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Interval {
    /// Every curve within the bands with this number of inflections and this bend at its beginning has this one after
    /// here.
    pub from: f64,
    /// And before here.
    pub to: f64,
    /// Where the curve that was found has it; the middle of the flat where it runs straight.
    pub at: f64,
}

/// One stretch between ends and knuckles.
#[derive(Debug, Clone, PartialEq)]
pub struct Stretch {
    /// First and last site.
    pub sites: [usize; 2],
    /// No curve within the bands has fewer inflections here.
    pub lower_bound: usize,
    /// The bend at the beginning of the curve that was found.
    pub first: Bend,
    /// Its inflections here.
    pub inflections: Vec<Interval>,
    /// The proofs: for a stretch that begins hollow, and for one that begins full.
    pub chains: [Chain; 2],
}

/// What a smaller number of inflections would cost.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SmallerCount {
    /// The number.
    pub count: usize,
    /// No curve has as few unless every tolerance is multiplied by this; `None` where points that are held forbid it at
    /// any tolerance.
    pub factor: Option<f64>,
}

/// The least number of inflections, and the proof.
#[derive(Debug, Clone, PartialEq)]
pub struct Inflections {
    /// Inflections of [`Inflections::curve`].
    pub count: usize,
    /// No curve within the bands has fewer.
    pub lower_bound: usize,
    /// The stretches between ends and knuckles.
    #[doc(hidden)]
    pub stretches: Vec<Stretch>,
    /// The numbers below [`Inflections::count`].
    #[doc(hidden)]
    pub smaller: Vec<SmallerCount>,
    /// The part of the tolerances that the curve uses, at most 1.
    pub factor: f64,
    /// A cubic spline y(x) within the bands with that number; none when none was found.
    pub curve: Option<BsplineCurve<1>>,
    /// Patterns that were excluded by checked multipliers, beyond what the chains prove.
    pub refuted: usize,
    /// Linear programs that were solved.
    pub programs: usize,
}

impl Inflections {
    /// Whether the number is proved to be the least.
    #[must_use]
    pub fn certified(&self) -> bool {
        self.curve.is_some() && self.count == self.lower_bound
    }
}

/// What a search found.
struct Found {
    pattern: Pattern,
    tried: Tried,
    space: Space,
}

/// The state of the work on one set of bands.
struct Work<'a> {
    bands: &'a Bands,
    stretches: Vec<[usize; 2]>,
    programs: usize,
    refuted: usize,
}

/// Finds the least number of changes of the sign of y'' within the bands; changes across a knuckle do not count.
#[must_use]
pub fn minimum_inflections(bands: &Bands) -> Inflections {
    let stretches = bands.stretches();
    let chains: Vec<[Chain; 2]> = stretches
        .iter()
        .map(|&stretch| [Bend::Hollow, Bend::Full].map(|first| Chain::longest_runs(bands, stretch, first, 1.0)))
        .collect();
    let mut lower: Vec<usize> = chains.iter().map(|pair| pair[0].count().min(pair[1].count())).collect();
    let mut counts = lower.clone();
    let mut work = Work { bands, stretches, programs: 0, refuted: 0 };
    let mut found = None;
    // Values at the sites change at most n - 3 times, so that the loop ends.
    for _ in 0..bands.sites().len() {
        found = work.attain(&counts);
        if found.is_some() {
            break;
        }
        let Some(stuck) = work.stuck(&counts) else { break };
        if counts[stuck] == lower[stuck] && work.refute(stuck, counts[stuck]) {
            lower[stuck] += 1;
        }
        counts[stuck] += 1;
    }
    let count = counts.iter().sum();
    let smaller = smaller(bands, &work.stretches, count);
    let curve = found.as_ref().and_then(|f| {
        let control = f.tried.coefficients.iter().map(|&c| [c]).collect();
        BsplineCurve::new(f.space.knots.clone()?, control).ok()
    });
    let stretches = work
        .stretches
        .iter()
        .zip(chains)
        .enumerate()
        .map(|(index, (&sites, chains))| {
            let first = match &found {
                Some(f) if !f.pattern.hollow[index] => Bend::Full,
                _ => Bend::Hollow,
            };
            let inflections = found.as_ref().map_or_else(Vec::new, |f| intervals(bands, f, index, sites, first));
            Stretch { sites, lower_bound: lower[index], first, inflections, chains }
        })
        .collect();
    Inflections {
        count,
        lower_bound: lower.iter().sum(),
        stretches,
        smaller,
        factor: found.as_ref().map_or(f64::INFINITY, |f| f.tried.factor),
        curve,
        refuted: work.refuted,
        programs: work.programs,
    }
}

impl Work<'_> {
    /// A spline with these numbers of inflections.
    fn attain(&mut self, counts: &[usize]) -> Option<Found> {
        for between in REFINEMENTS {
            // Stretch by stretch, then all together: at a knuckle two stretches share a value.
            let mut pattern = Pattern { hollow: Vec::new(), changes: Vec::new() };
            let mut offset = 0;
            let mut single = None;
            for (index, &stretch) in self.stretches.clone().iter().enumerate() {
                let part = self.bands.part(stretch);
                let space = Space::cubic(&part, between).ok()?;
                let Some((best, tried)) = self.search(&part, &space, counts[index]) else {
                    single = None;
                    pattern.hollow.clear();
                    break;
                };
                pattern.hollow.extend(&best.hollow);
                pattern.changes.push(best.changes[0].iter().map(|change| change + offset).collect());
                offset += space.places.len();
                single = Some((space, tried));
            }
            if pattern.hollow.len() != counts.len() {
                continue;
            }
            if let ([_], Some((space, tried))) = (counts, single) {
                return Some(Found { pattern, tried, space });
            }
            let space = Space::cubic(self.bands, between).ok()?;
            let tried = self.try_pattern(self.bands, &space, &pattern);
            if tried.factor <= WITHIN {
                return Some(Found { pattern, tried, space });
            }
        }
        None
    }

    fn try_pattern(&mut self, bands: &Bands, space: &Space, pattern: &Pattern) -> Tried {
        self.programs += 1;
        least_factor(bands, space, pattern)
    }

    /// The first pattern of a single stretch that fits, the most promising neighbours first.
    fn search(&mut self, part: &Bands, space: &Space, count: usize) -> Option<(Pattern, Tried)> {
        let whole = [0, part.sites().len() - 1];
        let mut open: Vec<(f64, Pattern, Vec<[usize; 2]>)> = Vec::new();
        for first in [Bend::Full, Bend::Hollow] {
            let Some(windows) = windows(part, whole, first, count) else { continue };
            let Some((limits, start)) = allowed(part, space, &windows) else { continue };
            open.push((0.0, Pattern { hollow: vec![first == Bend::Hollow], changes: vec![start] }, limits));
        }
        let mut seen: BTreeSet<Pattern> = open.iter().map(|entry| entry.1.clone()).collect();
        let budget = self.programs + PROGRAMS;
        while self.programs < budget {
            let best = (0..open.len()).min_by(|&a, &b| open[a].0.total_cmp(&open[b].0))?;
            let (_, pattern, limits) = open.swap_remove(best);
            let tried = self.try_pattern(part, space, &pattern);
            if tried.factor <= WITHIN {
                return Some((pattern, tried));
            }
            for m in 0..count {
                for forward in [true, false] {
                    let mut next = pattern.clone();
                    let place = &mut next.changes[0][m];
                    *place = if forward { *place + 1 } else { *place - 1 };
                    let moved = *place;
                    let rising = next.changes[0].windows(2).all(|pair| pair[0] < pair[1]);
                    if rising && (limits[m][0]..=limits[m][1]).contains(&moved) && seen.insert(next.clone()) {
                        open.push((tried.factor, next, limits.clone()));
                    }
                }
            }
        }
        None
    }

    /// The stretch that cannot have its number by itself, or the one with most room.
    fn stuck(&mut self, counts: &[usize]) -> Option<usize> {
        let room =
            |index: usize| (self.stretches[index][1] - self.stretches[index][0]).saturating_sub(counts[index] + 2);
        let most = (0..counts.len()).max_by_key(|&index| room(index)).filter(|&index| room(index) > 0);
        for (index, stretch) in self.stretches.clone().into_iter().enumerate() {
            let part = self.bands.part(stretch);
            let Ok(space) = Space::cubic(&part, REFINEMENTS[REFINEMENTS.len() - 1]) else { continue };
            if self.search(&part, &space, counts[index]).is_none() && stretch[1] - stretch[0] > counts[index] + 2 {
                return Some(index);
            }
        }
        most
    }

    /// Whether no values at the sites of a stretch have `count` changes: every pattern excluded by its multipliers.
    fn refute(&mut self, index: usize, count: usize) -> bool {
        let part = self.bands.part(self.stretches[index]);
        let space = Space::of_values(&part);
        let whole = [0, part.sites().len() - 1];
        let mut patterns = Vec::new();
        for first in [Bend::Hollow, Bend::Full] {
            let Some(windows) = windows(&part, whole, first, count) else { continue };
            let mut partial: Vec<Vec<usize>> = vec![Vec::new()];
            for window in &windows {
                // The difference that belongs to the inner site j + 1 is number j.
                partial = partial
                    .iter()
                    .flat_map(|head| {
                        let from = head.last().map_or(window[0], |last| window[0].max(last + 1));
                        (from..=window[1]).map(|change| {
                            let mut longer = head.clone();
                            longer.push(change);
                            longer
                        })
                    })
                    .take(PATTERNS + 1)
                    .collect();
            }
            patterns.extend(
                partial
                    .into_iter()
                    .map(|changes| Pattern { hollow: vec![first == Bend::Hollow], changes: vec![changes] }),
            );
            if patterns.len() > PATTERNS {
                return false;
            }
        }
        for pattern in &patterns {
            let proved = self.try_pattern(&part, &space, pattern).at_least > WITHIN;
            if !proved {
                return false;
            }
        }
        self.refuted += patterns.len();
        true
    }
}

/// The differences before which each change can stand, given its window among the sites, and a start in the middle of
/// each.
fn allowed(part: &Bands, space: &Space, windows: &[[usize; 2]]) -> Option<(Vec<[usize; 2]>, Vec<usize>)> {
    let (x, places) = (part.sites(), &space.places);
    let last = x.len() - 1;
    if places.len() < windows.len() + 1 {
        return None;
    }
    let (mut limits, mut start) = (Vec::new(), Vec::new());
    for &[from, to] in windows {
        let (earliest, latest) = (x[from - 1], x[(to + 2).min(last)]);
        let low = places.partition_point(|&place| place <= earliest).max(1);
        let high = places.partition_point(|&place| place < latest).min(places.len() - 1);
        let middle = 0.5 * (x[from] + x[to + 1]);
        let wish = places.partition_point(|&place| place < middle).clamp(low, high.max(low));
        let after = start.last().map_or(1, |&previous: &usize| previous + 1);
        limits.push([low, high.max(low)]);
        start.push(wish.max(after));
    }
    // Starts that were pushed beyond their limits by those before them are out of reach.
    start.iter().zip(&limits).all(|(at, limit)| *at <= limit[1]).then_some((limits, start))
}

/// Intervals of the inflections of a stretch: what the chains leave, and the place in the curve.
fn intervals(bands: &Bands, found: &Found, index: usize, sites: [usize; 2], first: Bend) -> Vec<Interval> {
    let x = bands.sites();
    let changes = &found.pattern.changes[index];
    let Some(windows) = windows(bands, sites, first, changes.len()) else { return Vec::new() };
    let bends = found.space.bends.apply(&found.tried.coefficients);
    let flat = dead_band(bands, &bends);
    let range = found.space.starts[index]..found.space.starts[index + 1];
    let places = &found.space.places;
    windows
        .iter()
        .zip(changes)
        .map(|(window, &change)| {
            let seen = |i: &usize| bends[*i].abs() > flat;
            let left = (range.start..change).rev().find(seen).unwrap_or(range.start);
            let right = (change..range.end).find(seen).unwrap_or(range.end - 1);
            let at = if right == left + 1 {
                let (a, b) = (bends[left].abs(), bends[right].abs());
                places[left] + (places[right] - places[left]) * if a + b > 0.0 { a / (a + b) } else { 0.5 }
            } else {
                0.5 * (places[left + 1] + places[right - 1])
            };
            Interval { from: x[window[0] - 1], to: x[(window[1] + 2).min(sites[1])], at }
        })
        .collect()
}

/// The least factor that the chains leave for every number below `count`, by halving.
fn smaller(bands: &Bands, stretches: &[[usize; 2]], count: usize) -> Vec<SmallerCount> {
    let needed = |factor: f64| -> usize {
        let of = |stretch, first| Chain::longest_runs(bands, stretch, first, factor).count();
        stretches.iter().map(|&s| of(s, Bend::Hollow).min(of(s, Bend::Full))).sum()
    };
    (0..count)
        .map(|wanted| {
            if needed(1.0) <= wanted {
                return SmallerCount { count: wanted, factor: Some(1.0) };
            }
            if needed(FARTHEST) > wanted {
                return SmallerCount { count: wanted, factor: None };
            }
            let (mut low, mut high) = (1.0_f64, FARTHEST);
            while high > low * (1.0 + 1e-6) {
                let middle = (low * high).sqrt();
                if needed(middle) > wanted { low = middle } else { high = middle }
            }
            SmallerCount { count: wanted, factor: Some(low) }
        })
        .collect()
}
