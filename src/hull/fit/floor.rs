//! Half-breadths that stay above the centreplane: splines through data, lifted where they dip below it.
//!
//! Where a profile slides quickly from waterline to waterline, values next to it are 0, 0, 0 and then much, and every
//! twice differentiable curve through them dips below 0. On knots that are double (C1) the value at a knot is the mean
//! of the control values beside it,
//!
//! > y = (h' c + h c') / (h + h'),  h and h' the spans below and above,
//!
//! so that a negative one can be put to 0 and the other one made to keep y. If the knots next to it are double as well,
//! no other value at a knot changes. Knots are made double only where the surface falls below 0, and beside that.

use std::collections::BTreeSet;

use super::super::HullError;
use super::FitError;
use crate::spline::{BsplineCurve, KnotVector};

/// Points a span, each way, in which a surface is looked at.
const LOOKS: usize = 8;

/// Values of less than this part of the greatest control value are 0.
const ROUNDING: f64 = 1e-13;

/// Rounds of lifting: what is taken from one side of a knot may be missed on the other. In the first ones each line is
/// lifted by itself; after them all lines that have part in a dip are level at its knots, so that the surface there has
/// the sign of the data.
const ROUNDS: usize = 6;
const OWN: usize = 3;

/// A scalar spline with the knots `added`, exactly: knots and control values.
pub(super) fn inserted(knots: &KnotVector, control: &[f64], added: &[f64]) -> Result<(KnotVector, Vec<f64>), FitError> {
    let points = control.iter().map(|&c| [c]).collect();
    let fine = BsplineCurve::new(knots.clone(), points)
        .and_then(|curve| curve.insert_knots(added))
        .map_err(HullError::from)?;
    Ok((fine.knots().clone(), fine.points().iter().map(|p| p[0]).collect()))
}

/// Lifts a surface that dips below 0 by more than `tolerance`: control values are `lines` over `knots`, one a basis
/// function of `along`. Gives the knots that were inserted into all lines, none where nothing dips.
pub(super) fn lift(
    along: &KnotVector,
    knots: &KnotVector,
    lines: &mut [Vec<f64>],
    tolerance: f64,
) -> Result<Vec<f64>, FitError> {
    let breaks = knots.breakpoints();
    let single = |t: f64| knots.multiplicity(t) < 2;
    if dips(along, knots, &breaks, lines, tolerance)?.is_empty() {
        return Ok(Vec::new());
    }
    // All knots double for the time of the search.
    let all: Vec<f64> = breaks[1..breaks.len() - 1].iter().copied().filter(|&t| single(t)).collect();
    let mut fine = knots.clone();
    let mut lifted = Vec::with_capacity(lines.len());
    for line in lines.iter() {
        let (finer, control) = inserted(knots, line, &all)?;
        fine = finer;
        lifted.push(control);
    }
    let mut raised: BTreeSet<(usize, usize)> = BTreeSet::new();
    for round in 0..ROUNDS {
        let mut done = false;
        for (line, span) in dips(along, &fine, &breaks, &lifted, tolerance)? {
            for at in [span, span + 1] {
                if raise(&fine, &breaks, at, &mut lifted[line], round >= OWN) {
                    raised.insert((line, at));
                    done = true;
                }
            }
        }
        if !done {
            break;
        }
    }
    // Of these knots only those that were used, and their neighbours.
    let last = breaks.len() - 1;
    let needed: BTreeSet<usize> =
        raised.iter().flat_map(|r| r.1.saturating_sub(1)..=r.1 + 1).filter(|k| (1..last).contains(k)).collect();
    let added: Vec<f64> = needed.into_iter().map(|k| breaks[k]).filter(|&t| single(t)).collect();
    let mut coarse = knots.clone();
    for line in lines.iter_mut() {
        (coarse, *line) = inserted(knots, line, &added)?;
    }
    for (line, at) in raised {
        for (to, from) in beside(&coarse, &breaks, at).zip(beside(&fine, &breaks, at)) {
            lines[line][to] = lifted[line][from];
        }
    }
    Ok(added)
}

/// Lines and spans of `breaks` that have part in a dip of the surface.
fn dips(
    along: &KnotVector,
    knots: &KnotVector,
    breaks: &[f64],
    lines: &[Vec<f64>],
    tolerance: f64,
) -> Result<BTreeSet<(usize, usize)>, FitError> {
    let degree = along.degree();
    let mut found = BTreeSet::new();
    for w in along.breakpoints().windows(2) {
        // The edges as well: dips along a profile may be narrow.
        for n in 0..=LOOKS {
            let u = w[0] + (w[1] - w[0]) * n as f64 / LOOKS as f64;
            let span = along.find_span(u);
            let [basis] = along.basis_derivatives::<1>(span, u);
            let first = span - degree;
            let values = |c: usize| (0..=degree).map(|k| basis[k] * lines[first + k][c]).sum::<f64>();
            let control: Vec<[f64; 1]> = (0..knots.basis_count()).map(|c| [values(c)]).collect();
            if control.iter().all(|c| c[0] >= -tolerance) {
                continue;
            }
            let curve = BsplineCurve::new(knots.clone(), control).map_err(HullError::from)?;
            for (k, b) in breaks.windows(2).enumerate() {
                let look = |n: usize| b[0] + (b[1] - b[0]) * (n as f64 + 0.5) / LOOKS as f64;
                if (0..LOOKS).any(|n| curve.eval(look(n))[0] < -tolerance) {
                    found.extend((first..=span).map(|line| (line, k)));
                }
            }
        }
    }
    Ok(found)
}

/// The control values that make value and slope at a break: at an end the first or the last two, at a double knot those
/// beside it.
fn beside(knots: &KnotVector, breaks: &[f64], at: usize) -> std::ops::Range<usize> {
    let count = knots.basis_count();
    if at == 0 {
        0..2
    } else if at + 1 == breaks.len() {
        count - 2..count
    } else {
        let first = knots.knots().partition_point(|&t| t < breaks[at]);
        first - 2..first + knots.multiplicity(breaks[at]) - 2
    }
}

/// Makes the control values beside a break not negative if the value there is not, and else equal to it: control values
/// of waterlines may be negative themselves, which are data here. With `level` they are equal in any case. Tells
/// whether they were not so before.
fn raise(knots: &KnotVector, breaks: &[f64], at: usize, control: &mut [f64], level: bool) -> bool {
    let rounding = ROUNDING * control.iter().fold(0.0f64, |most, c| most.max(c.abs()));
    let own = &mut control[beside(knots, breaks, at)];
    let double = own.len() == 2 && at > 0 && at + 1 < breaks.len();
    // At an end, and at a break of the slope, the value is a control value itself.
    let middle = if at > 0 { 1 } else { 0 };
    let (h, g) = if double { (breaks[at] - breaks[at - 1], breaks[at + 1] - breaks[at]) } else { (1.0, 1.0) };
    let value = if double { (g * own[0] + h * own[1]) / (h + g) } else { own[middle] };
    let before = [own[0], own[own.len() - 1]];
    if level || value < -rounding {
        own.fill(value);
    } else if double {
        let value = value.max(0.0);
        if own[0] < 0.0 {
            (own[0], own[1]) = (0.0, value * (h + g) / h);
        } else if own[1] < 0.0 {
            (own[0], own[1]) = (value * (h + g) / g, 0.0);
        }
    } else {
        own.iter_mut().enumerate().filter(|(k, _)| *k != middle).for_each(|(_, c)| *c = c.max(0.0));
    }
    before.iter().zip([own[0], own[own.len() - 1]]).any(|(old, new)| (old - new).abs() > rounding)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spline::{Condition, Energy};

    /// A surface that is the same all along: the interpolating spline of least energy across.
    fn prism(sites: &[f64], values: &[f64]) -> (KnotVector, KnotVector, Vec<Vec<f64>>) {
        let along = KnotVector::uniform(3, 1).unwrap();
        let knots = KnotVector::from_breakpoints(3, sites, &vec![1; sites.len() - 2]).unwrap();
        let conditions: Vec<Condition> = sites.iter().map(|&site| Condition { site, order: 0 }).collect();
        let control = Energy::new(&knots, 2).interpolation(&conditions).unwrap().solve(values);
        (along, knots, vec![control; 4])
    }

    #[test]
    fn a_dip_goes_and_the_data_stay() {
        let sites = [0.0, 0.2, 0.35, 0.5, 0.7, 0.8, 1.0];
        let values = [0.0, 0.0, 0.0, 0.0, 4.0, 4.2, 4.0];
        let (along, knots, mut lines) = prism(&sites, &values);
        let before = lines[0].clone();
        let added = lift(&along, &knots, &mut lines, 1e-9).unwrap();
        assert!(!added.is_empty());
        let fine = inserted(&knots, &before, &added).unwrap().0;
        let curve = BsplineCurve::new(fine, lines[0].iter().map(|&c| [c]).collect()).unwrap();
        for (t, y) in sites.iter().zip(values) {
            assert!((curve.eval(*t)[0] - y).abs() < 1e-12, "{t}");
        }
        assert!((0..=1000).all(|n| curve.eval(f64::from(n) / 1000.0)[0] >= -1e-9));
        // What does not dip is left alone.
        let mut flat = vec![vec![1.0; before.len()]; 4];
        assert!(lift(&along, &knots, &mut flat, 1e-9).unwrap().is_empty());
        assert_eq!(flat[0].len(), before.len());
    }

    #[test]
    fn knots_are_added_where_it_dips_only() {
        let sites: Vec<f64> = (0..=20).map(|k| f64::from(k) / 20.0).collect();
        let values: Vec<f64> = (0..=20).map(|k| if k < 3 { 1e-3 } else { 4.0 + f64::from(k) }).collect();
        let (along, knots, mut lines) = prism(&sites, &values);
        // One line of four that does not dip keeps its shape under the knots of the others.
        lines[3] = vec![1.0; lines[0].len()];
        let before = lines.clone();
        let added = lift(&along, &knots, &mut lines, 1e-9).unwrap();
        assert!((1..=5).contains(&added.len()) && added.iter().all(|&t| t < 0.3), "{added:?}");
        let fine = inserted(&knots, &before[0], &added).unwrap().0;
        let curve = |line: &[f64], knots: &KnotVector| {
            BsplineCurve::new(knots.clone(), line.iter().map(|&c| [c]).collect()).unwrap()
        };
        let (new, old) = (curve(&lines[0], &fine), curve(&before[0], &knots));
        for n in 0..=100 {
            let t = f64::from(n) / 100.0;
            assert!(t < 0.3 || (new.eval(t)[0] - old.eval(t)[0]).abs() < 1e-12, "{t}");
        }
        assert!(lines[3].iter().all(|c| (*c - 1.0).abs() < 1e-12));
        for (t, y) in sites.iter().zip(values) {
            assert!((new.eval(*t)[0] - y).abs() < 1e-11, "{t}");
        }
    }
}
