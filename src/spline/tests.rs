//! Random splines for the tests of this module.

use super::basis::MAX_DEGREE;
use super::{BsplineCurve, BsplineSurface, KnotVector};
use proptest::prelude::*;

/// Clamped knots of degree 1 to `highest`, with uneven spans and multiplicities up to the degree.
pub(super) fn knots(highest: usize) -> impl Strategy<Value = KnotVector> {
    knots_of(1..=highest.min(MAX_DEGREE))
}

fn knots_of(degrees: std::ops::RangeInclusive<usize>) -> impl Strategy<Value = KnotVector> {
    (degrees, prop::collection::vec((0.05f64..1.0, 1usize..=7), 1..6), -3.0f64..3.0).prop_map(
        |(degree, spans, start)| {
            let mut breaks = vec![start];
            for (length, _) in &spans {
                breaks.push(breaks[breaks.len() - 1] + length);
            }
            let multiplicities: Vec<usize> = spans[1..].iter().map(|(_, m)| 1 + (m - 1) % degree).collect();
            KnotVector::from_breakpoints(degree, &breaks, &multiplicities).unwrap()
        },
    )
}

/// Curves with coordinates between -1 and 1.
pub(super) fn curve<const D: usize>(highest: usize) -> impl Strategy<Value = BsplineCurve<D>> {
    knots(highest).prop_flat_map(|knots| {
        let count = knots.basis_count();
        prop::collection::vec(prop::array::uniform::<_, D>(-1.0f64..1.0), count)
            .prop_map(move |points| BsplineCurve::new(knots.clone(), points).unwrap())
    })
}

/// Surfaces with coordinates between -1 and 1.
pub(super) fn surface<const D: usize>(highest: usize) -> impl Strategy<Value = BsplineSurface<D>> {
    net(knots(highest), knots(highest))
}

/// Bicubic surfaces with coordinates between -1 and 1.
pub(super) fn bicubic<const D: usize>() -> impl Strategy<Value = BsplineSurface<D>> {
    net(knots_of(3..=3), knots_of(3..=3))
}

fn net<const D: usize>(
    u: impl Strategy<Value = KnotVector>,
    v: impl Strategy<Value = KnotVector>,
) -> impl Strategy<Value = BsplineSurface<D>> {
    (u, v).prop_flat_map(|(u, v)| {
        let count = u.basis_count() * v.basis_count();
        prop::collection::vec(prop::array::uniform::<_, D>(-1.0f64..1.0), count)
            .prop_map(move |points| BsplineSurface::new(u.clone(), v.clone(), points).unwrap())
    })
}

/// Parameters over the domain: every knot and points between.
pub(super) fn parameters(knots: &KnotVector) -> Vec<f64> {
    let mut all = knots.breakpoints();
    let between: Vec<f64> = all.windows(2).flat_map(|w| [0.1, 0.37, 0.82].map(|f| w[0] + (w[1] - w[0]) * f)).collect();
    all.extend(between);
    all
}

/// The greatest difference of a coordinate.
pub(super) fn distance<const D: usize>(a: &[[f64; D]], b: &[[f64; D]]) -> f64 {
    assert_eq!(a.len(), b.len());
    let differences = a.iter().zip(b).flat_map(|(p, q)| (0..D).map(move |d| (p[d] - q[d]).abs()));
    differences.fold(0.0, f64::max)
}
