//! Monotone pieces of curvature along a curve: where it turns, and which turns count.
//!
//! A curve is fair when its curvature kappa(s) has few monotone pieces (Farin and Sapidis 1989, "Curvature and the
//! fairness of curves and surfaces", IEEE Computer Graphics and Applications 9(2), 52-57). A *swing* is the course of
//! kappa between two successive turning points. It has a change of curvature dk \[1/m\] of either sign, and the arc length
//! l \[m\] between its turning points. Its height is
//!
//! ```text
//! h = |dk| l^2 / pi^2 \[m\],
//! ```
//!
//! A half wave whose curvature swings by dk over its length l departs by that from its chord. While the least swing has
//! a height below a band \[m\], it is merged: within the curve with both its neighbours, at an end of the curve with its
//! one neighbour. Ripple upon ripple goes, the least first, and what is left is what persists (Edelsbrunner, Letscher and
//! Zomorodian 2002). The ends of the curve count as turning points. One that lies on a plateau has no place of its own:
//! it counts as the middle of the stretch along which kappa differs from it by less than a tenth of its smaller swing, so
//! that the arc of a bilge between straights is two swings wherever rounding puts its extremum.

use std::f64::consts::PI;

/// Part of the smaller swing beside a turning point within which it is a plateau.
const PLATEAU: f64 = 0.1;

/// Height of a swing \[m\] by its change of curvature \[1/m\] and its length \[m\].
pub(super) fn height(change: f64, length: f64) -> f64 {
    change.abs() * (length / PI).powi(2)
}

/// The curvature along a curve with those of its points at which it turns.
struct Swings<'a> {
    /// Arc length \[m\], rising, and curvature \[1/m\].
    course: &'a [(f64, f64)],
    /// Indices of the turning points that are left. The first and the last stand for the ends.
    turns: Vec<usize>,
}

impl<'a> Swings<'a> {
    fn new(course: &'a [(f64, f64)]) -> Self {
        let mut swings = Self { course, turns: (0..course.len()).collect() };
        swings.keep_turns();
        swings
    }

    fn curvature(&self, turn: usize) -> f64 {
        self.course[self.turns[turn]].1
    }

    /// Drops the points at which the curvature runs on.
    fn keep_turns(&mut self) {
        let mut kept: Vec<usize> = Vec::with_capacity(self.turns.len());
        for &next in &self.turns {
            while let [.., before, here] = kept[..] {
                let [a, b, c] = [before, here, next].map(|k| self.course[k].1);
                if (b - a) * (c - b) < 0.0 {
                    break;
                }
                kept.pop();
            }
            kept.push(next);
        }
        self.turns = kept;
    }

    /// Arc length of a turning point \[m\]: an end of the curve, or the middle of its plateau.
    fn place(&self, turn: usize) -> f64 {
        let last = self.turns.len() - 1;
        if turn == 0 {
            return self.course[0].0;
        }
        if turn == last {
            return self.course[self.course.len() - 1].0;
        }
        let here = self.curvature(turn);
        let beside = [turn - 1, turn + 1].map(|other| (self.curvature(other) - here).abs());
        let limit = PLATEAU * beside[0].min(beside[1]);
        let at = self.turns[turn];
        let off = |k: usize| (self.course[k].1 - here).abs();
        // Where the curvature passes the limit between a point within it and the next one, beyond it.
        let edge = |inside: usize, outside: usize| {
            let part = (limit - off(inside)) / (off(outside) - off(inside));
            self.course[inside].0 + part.clamp(0.0, 1.0) * (self.course[outside].0 - self.course[inside].0)
        };
        let beyond = |k: &usize| off(*k) > limit;
        let from = (self.turns[turn - 1]..at).rev().find(beyond).map_or(self.course[at].0, |k| edge(k + 1, k));
        let to = (at + 1..=self.turns[turn + 1]).find(beyond).map_or(self.course[at].0, |k| edge(k - 1, k));
        0.5 * (from + to)
    }

    /// Merges the swings below `band` \[m\], the least first.
    fn merge(&mut self, band: f64) {
        while self.turns.len() > 2 {
            let places: Vec<f64> = (0..self.turns.len()).map(|turn| self.place(turn)).collect();
            let count = self.turns.len() - 1;
            let height = |k: usize| height(self.curvature(k + 1) - self.curvature(k), places[k + 1] - places[k]);
            let least = (0..count).min_by(|&a, &b| height(a).total_cmp(&height(b)));
            let Some(least) = least.filter(|&k| height(k) < band) else { return };
            // At an end the swing beside it runs on to the end.
            match least {
                0 => self.turns.drain(..1),
                k if k + 1 == count => self.turns.drain(count..),
                k => self.turns.drain(k..k + 2),
            };
            self.keep_turns();
        }
    }
}

/// The turning points that are left when every swing below `band` \[m\] is merged, as indices of `course`: arc length \[m\],
/// rising, and curvature \[1/m\] of either sign, extrema included. The first and the last are the ends of the curve, which
/// has one monotone piece less than these are.
pub(super) fn turning_points(course: &[(f64, f64)], band: f64) -> Vec<usize> {
    let mut swings = Swings::new(course);
    swings.merge(band);
    swings.turns
}

/// Total variation int |d kappa| of a course \[1/m\], jumps included.
pub(super) fn total_variation(course: &[(f64, f64)]) -> f64 {
    course.windows(2).map(|pair| (pair[1].1 - pair[0].1).abs()).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The course of a curvature over a length \[m\].
    fn course(length: f64, curvature: impl Fn(f64) -> f64) -> Vec<(f64, f64)> {
        (0..=2000).map(|k| length * f64::from(k) / 2000.0).map(|s| (s, curvature(s))).collect()
    }

    fn pieces(course: &[(f64, f64)], band: f64) -> usize {
        turning_points(course, band).len() - 1
    }

    /// A sine of n half waves over 10 m has n turning points. Its inner swings have the height 2 a l^2 / pi^2, those at
    /// the ends an eighth of it.
    #[test]
    fn a_sine_has_its_half_waves_and_ripples_below_the_band_change_nothing() {
        for n in 1..9 {
            let (a, l) = (0.02, 10.0 / f64::from(n));
            let end = a * (0.5 * l / PI).powi(2);
            let sine = |s: f64| a * (PI * s / l).sin();
            let ripple = |s: f64| 0.3 * a * (40.0 * PI * s / l).sin();
            let noise = |s: f64| 0.01 * a * (7919.0 * s).sin();
            for list in [course(10.0, sine), course(10.0, |s| sine(s) + ripple(s) + noise(s))] {
                assert_eq!(pieces(&list, 0.5 * end), n as usize + 1, "{n}");
            }
            // Without the ends, whose swings are smaller; n = 1 has nothing else.
            let inner = if n > 1 { n as usize - 1 } else { 1 };
            assert_eq!(pieces(&course(10.0, sine), 2.0 * end), inner, "{n}");
            assert_eq!(pieces(&course(10.0, sine), 8.1 * f64::from(n * n) * end), 1, "{n}");
        }
    }

    /// A swing counts from the band on: two thousandths above and below its height.
    #[test]
    fn a_swing_counts_from_its_height_on() {
        // Down by 0.01 / m over the 2 m from 4 to 6 m between two long rises.
        let list = [(0.0, 0.0), (4.0, 0.03), (6.0, 0.02), (10.0, 0.06)];
        let fine: Vec<(f64, f64)> = list
            .windows(2)
            .flat_map(|p| {
                (0..100)
                    .map(|k| f64::from(k) / 100.0)
                    .map(|r| (p[0].0 + r * (p[1].0 - p[0].0), p[0].1 + r * (p[1].1 - p[0].1)))
            })
            .chain([list[3]])
            .collect();
        // A tenth of the swing ends 0.2 m within it and 0.133 m or 0.1 m beyond.
        let length = 2.0 - (0.2 - 0.1 * 4.0 / 3.0) / 2.0 - (0.2 - 0.1) / 2.0;
        let exact = height(0.01, length);
        assert_eq!(pieces(&fine, 0.998 * exact), 3);
        assert_eq!(pieces(&fine, 1.002 * exact), 1);
    }

    /// A bilge of 2 m radius between straights rises and falls once, whatever rounding does to its plateaus.
    #[test]
    fn an_arc_between_straights_is_two_pieces() {
        let arc = |s: f64| if (4.0..7.0).contains(&s) { 0.5 } else { 0.0 };
        for sign in [-1.0, 1.0] {
            assert_eq!(pieces(&course(10.0, arc), 1e-3), 2);
            assert_eq!(pieces(&course(10.0, |s| arc(s) + sign * 1e-9 * s), 1e-3), 2);
            assert_eq!(pieces(&course(10.0, |s| arc(s) + 1e-6 * (900.0 * s).sin()), 1e-3), 2);
        }
    }

    /// A spike that nobody sees is no turn, at an end or within.
    #[test]
    fn spikes_count_by_what_they_bend() {
        let slow = |s: f64| 0.05 * (PI * s / 10.0).sin();
        let spike = |at: f64| move |s: f64| slow(s) + 0.2 * (1.0 - (s - at).abs() / 0.02).max(0.0);
        for at in [0.0, 2.5, 5.0, 10.0] {
            assert_eq!(pieces(&course(10.0, spike(at)), 1e-3), 2, "{at}");
        }
        assert_eq!(pieces(&course(10.0, slow), 1e-3), 2);
    }

    #[test]
    fn variation_adds_what_rises_and_falls() {
        let list = course(4.0, |s| (PI * s).sin());
        assert!((total_variation(&list) - 8.0).abs() < 1e-4, "{}", total_variation(&list));
    }
}
