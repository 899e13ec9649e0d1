//! The humps of one line, and the signs that its places have once some of them are removed.

use super::super::bends::{Bend, dead, departure};
use super::super::model::{Limit, value};
use std::ops::Range;

/// Part of the dead band of curvature that the limits leave open, for an interior to solve in.
const ROOM: f64 = 1e-2;

/// A part of a line with one sign.
#[derive(Debug, Clone, Copy)]
pub(super) struct Hump {
    pub(super) sign: i8,
    pub(super) from: usize,
    pub(super) to: usize,
    /// Its clearest place, in standard errors.
    pub(super) clear: f64,
    /// Whether the move to the targets made it.
    pub(super) new: bool,
}

/// A sign at a place of a hump.
pub(super) struct Sign {
    /// Place along the line.
    pub(super) at: usize,
    pub(super) positive: bool,
    pub(super) limit: Limit,
}

/// A line with what is asked of it.
#[derive(Clone)]
pub(super) struct Asked {
    /// Its bends.
    pub(super) bends: Vec<Bend>,
    /// The field's own humps.
    pub(super) humps: Vec<Hump>,
    /// Those that are given back.
    pub(super) back: Vec<bool>,
    /// Whether signs are asked for whatever becomes of its humps.
    pub(super) watched: bool,
    /// Places to each side of an inflection without a sign.
    pub(super) around: usize,
}

/// Inflections between humps.
pub(super) fn inflections(humps: &[Hump]) -> usize {
    humps.len().saturating_sub(1)
}

/// Inflections of a net along a line that depart from their chords by `seen` \[m\] at least.
pub(super) fn counted(bends: &[Bend], net: &[f64], seen: f64) -> usize {
    inflections(&bare_humps(bends, net, seen))
}

/// The humps of a net, however clear they are.
fn bare_humps(bends: &[Bend], net: &[f64], seen: f64) -> Vec<Hump> {
    humps(bends, &vec![0.0; bends.len()], net, 1.0, seen)
}

/// Marks the humps that those before have none of the same sign for.
pub(super) fn mark_new(humps: &mut [Hump], before: &[Hump]) {
    for hump in humps {
        let same = |old: &&Hump| old.sign == hump.sign && old.from < hump.to && hump.from < old.to;
        if !before.iter().any(|old| same(&old)) {
            (hump.new, hump.clear) = (true, 0.0);
        }
    }
}

/// The humps of a line that depart from their chords by `seen` \[m\] at least; the whole line where none does.
pub(super) fn humps(bends: &[Bend], errors: &[f64], net: &[f64], sigma: f64, seen: f64) -> Vec<Hump> {
    let values: Vec<f64> = bends.iter().map(|bend| value(&bend.numerator, net) + bend.offset).collect();
    let mut found: Vec<Hump> = Vec::new();
    for (k, value) in values.iter().enumerate() {
        let clear = if errors[k] > 0.0 { value.abs() / (sigma * errors[k]) } else { 0.0 };
        let sign = if *value >= 0.0 { 1 } else { -1 };
        match found.last_mut().filter(|last| last.sign == sign) {
            Some(last) => (last.to, last.clear) = (k + 1, last.clear.max(clear)),
            None => found.push(Hump { sign, from: k, to: k + 1, clear, new: false }),
        }
    }
    let departs = |hump: &Hump| departure(bends, [hump.from, hump.to], net);
    let mut departures: Vec<f64> = found.iter().map(departs).collect();
    while found.len() > 1 {
        let least = (0..found.len()).min_by(|&a, &b| departures[a].total_cmp(&departures[b]));
        let Some(k) = least.filter(|&k| departures[k] < seen) else { break };
        let (whole, range) = joined(&found, k);
        departures.splice(range.clone(), [departs(&whole)]);
        found.splice(range, [whole]);
    }
    found
}

/// A hump with those beside it as one of their sign, and which they are.
pub(super) fn joined(humps: &[Hump], k: usize) -> (Hump, Range<usize>) {
    let range = k.saturating_sub(1)..(k + 2).min(humps.len());
    let beside = || range.clone().filter(|&other| other != k).map(|other| humps[other]);
    let whole = Hump {
        sign: -humps[k].sign,
        from: humps[range.start].from,
        to: humps[range.end - 1].to,
        clear: beside().map(|hump| hump.clear).fold(0.0, f64::max),
        new: beside().all(|hump| hump.new),
    };
    (whole, range)
}

impl Asked {
    /// A line that is asked for the signs that it has on a net.
    pub(super) fn as_it_is(bends: &[Bend], net: &[f64], seen: f64) -> Self {
        let humps = bare_humps(bends, net, seen);
        Self { bends: bends.to_vec(), back: vec![false; humps.len()], humps, watched: true, around: 1 }
    }

    /// Signs of all places once the humps below the price are removed; none where none is.
    pub(super) fn signs(&self, price: f64) -> Option<Vec<i8>> {
        let least = price.sqrt();
        let (mut parts, mut back) = (self.humps.clone(), self.back.clone());
        while parts.len() > 1 {
            let free = (0..parts.len()).filter(|&k| !back[k] && parts[k].clear < least);
            let Some(k) = free.min_by(|&a, &b| parts[a].clear.total_cmp(&parts[b].clear)) else { break };
            let (whole, range) = joined(&parts, k);
            let kept = range.clone().any(|other| other != k && back[other]);
            parts.splice(range.clone(), [whole]);
            back.splice(range, [kept]);
        }
        if parts.len() == self.humps.len() && !self.watched {
            return None;
        }
        let mut signs = vec![0; self.bends.len()];
        parts.iter().for_each(|part| signs[part.from..part.to].fill(part.sign));
        Some(signs)
    }

    /// Inflections of the field.
    pub(super) fn count(&self) -> usize {
        inflections(&self.humps)
    }

    /// Those of a net.
    pub(super) fn counted(&self, net: &[f64], seen: f64) -> usize {
        counted(&self.bends, net, seen)
    }

    /// The limits of the places that have a sign, but for those about an inflection. A place whose curvature has not the
    /// sign of its hump, which nobody sees, may keep it and not grow.
    pub(super) fn limits(&self, signs: &[i8], net: &[f64]) -> Vec<(usize, Sign)> {
        let none = ROOM * dead(&self.bends, net);
        let count = signs.len();
        let beside = |k: usize| {
            let near = k.saturating_sub(self.around)..(k + self.around + 1).min(count);
            signs[near].iter().any(|&sign| sign != signs[k])
        };
        let mut limits = Vec::new();
        for (index, hump) in self.humps.iter().enumerate() {
            let places = (hump.from..hump.to).filter(|&k| !beside(k)).map(|k| (k, &self.bends[k], signs[k]));
            for (at, bend, sign) in places {
                let Some(scaled) = bend.scaled(net, none) else { continue };
                let (now, room) = (f64::from(sign) * scaled.at(net), scaled.room);
                let is_own = f64::from(hump.sign) * scaled.at(net) >= 0.0;
                let least = if is_own { -room } else { now.min(-room) };
                let range = if sign > 0 { [least, f64::INFINITY] } else { [f64::NEG_INFINITY, -least] };
                limits.push((index, Sign { at, positive: sign > 0, limit: scaled.limit(range) }));
            }
        }
        limits
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A line of places one metre apart with humps of these signs, lengths and clearness.
    fn line(list: &[(i8, usize, f64)]) -> Asked {
        let mut humps: Vec<Hump> = Vec::new();
        for &(sign, count, clear) in list {
            let from = humps.last().map_or(0, |last| last.to);
            humps.push(Hump { sign, from, to: from + count, clear, new: false });
        }
        let back = vec![false; humps.len()];
        Asked { bends: places(humps.last().map_or(0, |last| last.to)), humps, back, watched: false, around: 1 }
    }

    /// Places one metre apart whose control values are y''.
    fn places(count: usize) -> Vec<Bend> {
        let bend =
            |k: usize| Bend { numerator: vec![(k, 1.0)], offset: 0.0, slope: Vec::new(), along: 1.0, at: k as f64 };
        (0..count).map(bend).collect()
    }

    #[test]
    fn humps_below_the_price_take_the_sign_around_them() {
        let mut inner = line(&[(-1, 4, 30.0), (1, 3, 2.0), (-1, 4, 40.0)]);
        assert_eq!(inner.signs(12.0), Some(vec![-1; 11]));
        assert_eq!((inner.count(), inner.signs(3.0)), (2, None));
        inner.back[1] = true;
        assert_eq!(inner.signs(12.0), None);
        // At an end: the sign beside it.
        let outer = line(&[(1, 2, 1.0), (-1, 5, 9.0)]);
        assert_eq!(outer.signs(12.0), Some(vec![-1; 7]));
    }

    /// Arcs of 4, 2 and 4 m with y'' of 1e-3 / m depart by 2, 0.5 and 2 mm. The least goes to its neighbours, and what they
    /// are together departs by more than 3 mm.
    #[test]
    fn humps_that_are_seen_together_count_as_one() {
        let signs = [-1, 1, -1, 1, -1];
        let second = |lengths: [usize; 5]| -> Vec<f64> {
            signs.iter().zip(lengths).flat_map(|(&sign, count)| vec![1e-3 * f64::from(sign); count]).collect()
        };
        let parts = |net: &[f64], seen: f64| -> Vec<(i8, usize)> {
            let bends = places(net.len());
            let found = humps(&bends, &vec![1.0; net.len()], net, 1.0, seen);
            found.iter().map(|hump| (hump.sign, hump.from)).collect()
        };
        let net = second([8, 4, 2, 4, 8]);
        assert_eq!(parts(&net, 1e-6), [(-1, 0), (1, 8), (-1, 12), (1, 14), (-1, 18)]);
        assert_eq!(parts(&net, 3e-3), [(-1, 0), (1, 8), (-1, 18)]);
        // Alone such an arc is none.
        assert_eq!(parts(&second([8, 4, 0, 0, 8]), 3e-3), [(-1, 0)]);
    }

    #[test]
    fn what_nobody_sees_may_stay_and_not_grow() {
        let wide = line(&[(-1, 12, 30.0), (1, 4, 1.0)]);
        let net: Vec<f64> = (0..16).map(|k| if (4..7).contains(&k) || k >= 12 { 0.5 } else { -1.0 }).collect();
        let limits = wide.limits(&[-1; 16], &net);
        let upper =
            |k: usize| limits.iter().find(|(_, sign)| sign.limit.row[0].0 == k).map(|(_, sign)| sign.limit.upper);
        assert!(upper(5).is_some_and(|upper| (upper - 0.5).abs() < 1e-12));
        assert!(upper(13).is_some_and(|upper| upper < 0.01));
    }

    #[test]
    fn no_sign_is_asked_for_beside_an_inflection() {
        let changing = line(&[(-1, 6, 30.0), (1, 6, 40.0)]);
        let signs: Vec<i8> = (0..12).map(|k| if k < 6 { -1 } else { 1 }).collect();
        let limits = changing.limits(&signs, &signs.iter().map(|&sign| f64::from(sign)).collect::<Vec<_>>());
        let rows: Vec<usize> = limits.iter().map(|(_, sign)| sign.limit.row[0].0).collect();
        assert_eq!(rows, (0..5).chain(7..12).collect::<Vec<_>>());
    }
}
