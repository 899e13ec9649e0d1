//! How probable each hypothesis about a cell is: Bayes' rule over a closed list that sums to one.
//!
//! With the prediction p, its scale s and Student's law t_nu of the scale's degrees of freedom:
//! * right as written: (1 - a) t_nu((w - p)/s)/s,
//! * a slip of kind k that turned v into the written w: a P(k) P(v -> w | k) t_nu((v - p)/s)/s, summed over the v,
//! * the text of a neighbour, when it is that very text: 0.05 a P(k) over the quantum of the table, at least 1 mm,
//! * wrong and unexplained: a P(u)/(20 |w - p|), flat over the decade of what is wrong.
//!
//! a is the share of wrong cells that the rest of the table makes likely (head of `search.rs`).

use super::judge::Verdict;
use super::reading::{Hypothesis, Repair};

/// How much likelier a repeated text is when it was copied: neighbours are alike without that, too.
const COPIED: f64 = 0.05;
/// Quantum below which a repeated text says no more: flats repeat every decimal \[m\].
const FLAT: f64 = 1e-3;

/// A hypothesis about a cell with its probability.
#[derive(Debug, Clone, PartialEq)]
pub struct Reading {
    /// What happened.
    pub hypothesis: Hypothesis,
    /// What the cell would say in its notation; empty where the hypothesis names no text.
    pub text: String,
    /// Its half-breadth \[m\]; the prediction where the hypothesis names no text.
    pub value: f64,
    /// Probability; those of a cell sum to one.
    pub probability: f64,
}

/// Logarithm of the gamma function for x >= 0.5 (Stirling's series after shifting x above 8), to 1e-10.
fn ln_gamma(x: f64) -> f64 {
    let (mut x, mut shift) = (x, 0.0);
    while x < 8.0 {
        shift -= x.ln();
        x += 1.0;
    }
    let inverse = 1.0 / (x * x);
    let series = (1.0 / 12.0 - inverse * (1.0 / 360.0 - inverse * (1.0 / 1260.0 - inverse / 1680.0))) / x;
    shift + (x - 0.5) * x.ln() - x + 0.5 * (2.0 * std::f64::consts::PI).ln() + series
}

/// Density of Student's t.
pub(super) fn student(t: f64, nu: f64) -> f64 {
    let constant = ln_gamma(0.5 * (nu + 1.0)) - ln_gamma(0.5 * nu) - 0.5 * (nu * std::f64::consts::PI).ln();
    (constant - 0.5 * (nu + 1.0) * (t * t / nu).ln_1p()).exp()
}

/// The hypotheses about a cell, most probable first: [`weighed`] and brought to the sum one.
pub(super) fn readings(mut list: Vec<Reading>) -> Vec<Reading> {
    // What two slips explain alike goes to the likelier: a swap is also two wrong digits, a misread digit a wrong one.
    let total: f64 = list.iter().map(|reading| reading.probability).sum();
    list.iter_mut().for_each(|reading| reading.probability /= total);
    list.sort_by(|a, b| b.probability.total_cmp(&a.probability));
    list
}

/// The hypotheses about a cell with their evidence in place of probabilities, "right as written" first. `copies` are
/// kinds of neighbours whose text the cell repeats, `wrong` is the share of wrong cells that the rest of the table
/// makes likely.
pub(super) fn weighed(
    verdict: &Verdict,
    written: f64,
    text: &str,
    repairs: &[Repair],
    copies: &[Hypothesis],
    quantum: f64,
    wrong: f64,
) -> Vec<Reading> {
    let (p, s, nu) = (written - verdict.residual, verdict.scale, verdict.freedom);
    let density = |value: f64| student((value - p) / s, nu) / s;
    let mut list = vec![Reading {
        hypothesis: Hypothesis::Noise,
        text: text.to_owned(),
        value: written,
        probability: (1.0 - wrong) * density(written),
    }];
    for hypothesis in Hypothesis::ALL {
        let kind: Vec<&Repair> = repairs.iter().filter(|repair| repair.hypothesis == hypothesis).collect();
        let total: f64 = kind.iter().map(|repair| repair.weight).sum();
        for repair in kind {
            list.push(Reading {
                hypothesis,
                text: repair.text.clone(),
                value: repair.value,
                probability: wrong * hypothesis.prior() * repair.weight / total * density(repair.value),
            });
        }
    }
    for &hypothesis in copies {
        list.push(Reading {
            hypothesis,
            text: String::new(),
            value: p,
            probability: wrong * hypothesis.prior() * COPIED / quantum.max(FLAT),
        });
    }
    list.push(Reading {
        hypothesis: Hypothesis::Unexplained,
        text: String::new(),
        value: p,
        probability: wrong * Hypothesis::Unexplained.prior() / (20.0 * verdict.residual.abs().max(s)),
    });
    list
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    pub(super) fn student_integrates_to_one_and_ends_as_normal() {
        for nu in [2.0, 7.5, 40.0] {
            let n = 200_000;
            let sum: f64 = (0..n).map(|k| student(-500.0 + 1000.0 * (f64::from(k) + 0.5) / f64::from(n), nu)).sum();
            assert!((sum * 1000.0 / f64::from(n) - 1.0).abs() < 1e-4, "{nu}");
        }
        assert!((student(1.0, 1e7) - 0.241_970_724_5).abs() < 1e-7);
    }
}
