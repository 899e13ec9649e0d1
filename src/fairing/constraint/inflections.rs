//! No more than so many inflections on a line: which signs to ask for.
//!
//! Over sign patterns with at most m changes the one of least cost is taken, the cost of a point being |kappa| h where
//! the net has the other sign, h its share of the line: dynamic programming over (point, changes, sign), exact and
//! O(points m). The two points beside a change have one free between them. The program with these signs is convex; that
//! no curve within the tolerances has fewer inflections than some number is proved elsewhere
//! ([`super::super::inflections`]).

use super::super::bends::{Bend, changes, dead, signs};
use super::super::model::Limit;

/// Whether the net bends more often than `most` along the line.
#[must_use]
pub fn bends_too_often(bends: &[Bend], net: &[f64], most: usize) -> bool {
    changes(&signs(bends, net)) > most
}

/// The sign of every point, -1 or 1, with at most `most` changes, that goes least against `curvature` times `share`.
fn cheapest(curvature: &[f64], share: &[f64], most: usize) -> Vec<i8> {
    let count = curvature.len();
    let states = 2 * (most + 1);
    let cost = |k: usize, state: usize| {
        let against = if state.is_multiple_of(2) { curvature[k] < 0.0 } else { curvature[k] > 0.0 };
        if against { curvature[k].abs() * share[k] } else { 0.0 }
    };
    // State 2 c + s: c changes so far, s = 0 for +, 1 for -.
    let mut best = vec![vec![f64::INFINITY; states]; count];
    let mut from = vec![vec![0_usize; states]; count];
    for k in 0..count {
        for state in 0..states {
            let (before, value) = match k {
                0 if state < 2 => (state, 0.0),
                0 => continue,
                _ => {
                    let stay = (state, best[k - 1][state]);
                    let turned = state.checked_sub(2).map(|lower| lower ^ 1).map(|lower| (lower, best[k - 1][lower]));
                    turned.filter(|turned| turned.1 < stay.1).unwrap_or(stay)
                }
            };
            best[k][state] = value + cost(k, state);
            from[k][state] = before;
        }
    }
    let mut signs = vec![1; count];
    let Some(last) = count.checked_sub(1) else { return signs };
    let mut state = (0..states).min_by(|&a, &b| best[last][a].total_cmp(&best[last][b])).unwrap_or(0);
    for k in (0..count).rev() {
        signs[k] = if state % 2 == 0 { 1 } else { -1 };
        state = from[k][state];
    }
    signs
}

/// Limits that leave a line at most `most` inflections, as near as may be to what the net has.
#[must_use]
pub fn limits(bends: &[Bend], net: &[f64], most: usize) -> Vec<Limit> {
    let curvature: Vec<f64> = bends.iter().map(|bend| bend.curvature(net)).collect();
    let share: Vec<f64> = (0..bends.len())
        .map(|k| 0.5 * (bends[(k + 1).min(bends.len() - 1)].at - bends[k.saturating_sub(1)].at).abs())
        .collect();
    let signs = cheapest(&curvature, &share, most);
    let mut free = vec![false; bends.len()];
    for k in 1..signs.len() {
        if signs[k] != signs[k - 1] {
            free[if curvature[k].abs() < curvature[k - 1].abs() { k } else { k - 1 }] = true;
        }
    }
    let none = dead(bends, net);
    let asked = bends.iter().zip(&signs).zip(free).filter(|(_, free)| !free);
    asked.filter_map(|((bend, sign), _)| bend.limit(*sign > 0, net, none)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_cheapest_pattern_keeps_the_strong_lobes() {
        let curvature = [1.0, 2.0, -0.1, 1.5, -2.0, -1.0, 0.2, -1.0];
        let share = [1.0; 8];
        assert_eq!(cheapest(&curvature, &share, 0), [1; 8]);
        assert_eq!(cheapest(&curvature, &share, 1), [1, 1, 1, 1, -1, -1, -1, -1]);
        assert_eq!(cheapest(&curvature, &share, 3), [1, 1, 1, 1, -1, -1, 1, -1]);
        assert_eq!(cheapest(&curvature, &share, 9), [1, 1, -1, 1, -1, -1, 1, -1]);
        // A long share outweighs a strong point.
        assert_eq!(cheapest(&[1.0, -3.0], &[10.0, 1.0], 0), [1, 1]);
        assert!(cheapest(&[], &[], 2).is_empty());
    }
}
