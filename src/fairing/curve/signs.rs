//! Patterns of signs along one curve: where a given number of changes suits the unconstrained curve best.

use super::super::model::Row;
use super::super::smoothing::{Smoothed, Smoother};

/// For each stretch between knuckles the sign at its beginning and the forms before which it changes.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Signs {
    /// First form of each stretch, and their number.
    pub(super) starts: Vec<usize>,
    /// Sign of y'' at the beginning of each stretch.
    pub(super) first: Vec<i8>,
    /// Forms before which it changes, counted along the whole curve.
    pub(super) changes: Vec<Vec<usize>>,
    /// What the changes of sign cost: the sum of the squared scores that they overrule, for each stretch.
    pub(super) cost: Vec<f64>,
}

/// The forms of a smoothed curve over their standard deviations (sigma = 1).
pub(super) fn scores(forms: &[Row], smoother: &Smoother, smoothed: &Smoothed, net: &[f64]) -> Vec<f64> {
    let inverse = smoothed.factor.inverse_band();
    forms
        .iter()
        .map(|form| {
            let (row, _) = smoother.reduced.row(form);
            let variance = inverse.quadratic_form(row.iter().copied());
            let deviation = variance.max(0.0).sqrt();
            let value = super::super::model::value(form, net);
            if deviation > 0.0 { value / deviation } else { 0.0 }
        })
        .collect()
}

/// The best runs of alternating signs for one stretch: the first sign, the changes and the sum of squares overruled.
/// Dynamic programming over the forms, O(n k).
fn runs(scores: &[f64], count: usize) -> Option<(i8, Vec<usize>, f64)> {
    let n = scores.len();
    if n < count + 1 {
        return None;
    }
    let against = |i: usize, sign: i8| if scores[i] * f64::from(sign) < 0.0 { scores[i] * scores[i] } else { 0.0 };
    let mut best: Option<(i8, Vec<usize>, f64)> = None;
    for first in [1_i8, -1] {
        let sign = |m: usize| if m.is_multiple_of(2) { first } else { -first };
        // least[i][m]: forms 0 ..= i in m + 1 runs; came[i][m]: whether run m begins at i.
        let mut least = vec![vec![f64::INFINITY; count + 1]; n];
        let mut came = vec![vec![false; count + 1]; n];
        least[0][0] = against(0, first);
        for i in 1..n {
            for m in 0..=count.min(i) {
                let stay = least[i - 1][m];
                let change = if m > 0 { least[i - 1][m - 1] } else { f64::INFINITY };
                came[i][m] = change < stay;
                least[i][m] = stay.min(change) + against(i, sign(m));
            }
        }
        let cost = least[n - 1][count];
        if best.as_ref().is_none_or(|b| cost < b.2) {
            let (mut changes, mut m) = (Vec::new(), count);
            for i in (1..n).rev() {
                if m > 0 && came[i][m] {
                    changes.push(i);
                    m -= 1;
                }
            }
            changes.reverse();
            best = Some((first, changes, cost));
        }
    }
    best
}

impl Signs {
    /// The pattern with these numbers of changes that overrules least.
    pub(super) fn best(scores: &[f64], starts: &[usize], counts: &[usize]) -> Option<Self> {
        let mut signs = Self { starts: starts.to_vec(), first: Vec::new(), changes: Vec::new(), cost: Vec::new() };
        for (stretch, &count) in counts.iter().enumerate() {
            let from = starts[stretch];
            let (first, changes, cost) = runs(&scores[from..starts[stretch + 1]], count)?;
            signs.first.push(first);
            signs.changes.push(changes.into_iter().map(|i| i + from).collect());
            signs.cost.push(cost);
        }
        Some(signs)
    }

    /// The same with one change moved by some forms; `None` where runs would vanish.
    pub(super) fn moved(&self, stretch: usize, which: usize, by: isize) -> Option<Self> {
        let mut next = self.clone();
        let place = next.changes[stretch][which].checked_add_signed(by)?;
        next.changes[stretch][which] = place;
        let list = &next.changes[stretch];
        let inside = place > self.starts[stretch] && place < self.starts[stretch + 1];
        (inside && list.windows(2).all(|pair| pair[0] < pair[1])).then_some(next)
    }

    /// The signs for the program: -1 or 1, and 0 where it is free. Free is at each change the form before it or after it, the
    /// one with the smaller score, if its run keeps another.
    pub(super) fn imposed(&self, scores: &[f64]) -> Vec<i8> {
        let mut imposed = vec![0_i8; scores.len()];
        for (stretch, changes) in self.changes.iter().enumerate() {
            let (from, to) = (self.starts[stretch], self.starts[stretch + 1]);
            let mut sign = self.first[stretch];
            for (i, place) in (from..to).zip(&mut imposed[from..to]) {
                if changes.contains(&i) {
                    sign = -sign;
                }
                *place = sign;
            }
            let ends: Vec<usize> = [from].into_iter().chain(changes.iter().copied()).chain([to]).collect();
            for (m, &change) in changes.iter().enumerate() {
                let kept = |run: usize| (ends[run]..ends[run + 1]).filter(|&i| imposed[i] != 0).count();
                let wish =
                    if scores[change - 1].abs() < scores[change].abs() { (change - 1, m) } else { (change, m + 1) };
                if kept(wish.1) > 1 {
                    imposed[wish.0] = 0;
                }
            }
        }
        imposed
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn runs_overrule_least() {
        let scores = [3.0, 2.0, -0.5, 4.0, -1.0, -6.0, 0.2, -3.0];
        assert_eq!(runs(&scores, 1), Some((1, vec![4], 0.25 + 0.2 * 0.2)));
        let (first, changes, cost) = runs(&scores, 0).unwrap();
        assert_eq!((first, changes), (-1, vec![]));
        assert!((cost - (9.0 + 4.0 + 16.0 + 0.04)).abs() < 1e-12);
        assert_eq!(runs(&scores[..2], 2), None);
        let signs = Signs::best(&scores, &[0, 8], &[1]).unwrap();
        assert_eq!(signs.imposed(&scores), [1, 1, 1, 1, 0, -1, -1, -1]);
        assert_eq!(signs.moved(0, 0, -3).unwrap().changes, [[1]]);
        assert_eq!(signs.moved(0, 0, -4), None);
    }
}
