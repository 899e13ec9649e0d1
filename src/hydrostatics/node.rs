//! Nodes in v on which lines u = constant are summed.

use crate::hull::Hull;
use crate::numeric::gauss_legendre;

/// A node in v with the N = q + 1 basis functions that do not vanish there.
#[derive(Debug, Clone, Copy)]
pub(super) struct Node<const N: usize> {
    /// Index of the first of the basis functions.
    pub(super) first: usize,
    /// Their values.
    pub(super) value: [f64; N],
    /// Their derivatives.
    pub(super) slope: [f64; N],
    /// Weight of the rule.
    pub(super) weight: f64,
    /// z on a level hull, else 0.
    pub(super) z: f64,
    /// dz/dv on a level hull, else 0.
    pub(super) rise: f64,
}

/// Gauss nodes of the part of `span` below `end`.
pub(super) fn nodes<const N: usize>(hull: &Hull, span: usize, end: f64, count: usize, into: &mut Vec<Node<N>>) {
    let knots = hull.surface().v();
    let (from, to) = (knots.knots()[span], knots.knots()[span + 1].min(end));
    if to <= from {
        return;
    }
    into.extend(gauss_legendre(count).on(from, to).map(|(v, weight)| node_at(hull, span, v, weight)));
}

/// The node at `v` in `span`.
pub(super) fn node_at<const N: usize>(hull: &Hull, span: usize, v: f64, weight: f64) -> Node<N> {
    let first = span + 1 - N;
    let rows = hull.surface().v().basis_derivatives::<2>(span, v);
    let (mut value, mut slope) = ([0.0; N], [0.0; N]);
    value.copy_from_slice(&rows[0][..N]);
    slope.copy_from_slice(&rows[1][..N]);
    let Some(heights) = hull.heights().map(|heights| &heights.points()[first..=span]) else {
        return Node { first, value, slope, weight, z: 0.0, rise: 0.0 };
    };
    let sum = |row: &[f64; N]| row.iter().zip(heights).map(|(b, h)| b * h[0]).sum::<f64>();
    Node { first, value, slope, weight, z: sum(&value), rise: sum(&slope) }
}
