//! Knuckles of a hull: lines of the net at which the tangent plane of its surface breaks.

use super::form::Hull;
use crate::spline::{cross, dot, length};

/// Normals on two sides of a line of knots that differ by more than this are those of a knuckle \[rad\].
const BREAK: f64 = 5e-3;

/// Places along a line of knots that are looked at.
const PLACES: usize = 400;

/// Distance from a line of knots at which normals are looked at, over the domain.
const BESIDE: f64 = 1e-7;

impl Hull {
    /// The outward normal of unit length at parameters (u, v); none where the surface has none.
    pub(super) fn outward_normal(&self, u: f64, v: f64) -> Option<[f64; 3]> {
        let d = self.surface().derivatives::<2>(u, v);
        let normal = cross(d[0][1], d[1][0]);
        let long = length(normal);
        (long > 0.0 && long.is_finite()).then(|| normal.map(|c| c / long))
    }

    /// Whether the surface has a knuckle at (u, v) on a line of knots along the hull.
    pub(super) fn is_knuckle(&self, u: f64, v: f64) -> bool {
        let (low, high) = self.surface().v().domain();
        let step = BESIDE * (high - low);
        match (self.outward_normal(u, v - step), self.outward_normal(u, v + step)) {
            (Some(a), Some(b)) => length(cross(a, b)).atan2(dot(a, b)) > BREAK,
            _ => false,
        }
    }

    /// Knuckles along the hull below the deck at side, as points \[m\] of the port side from aft forward.
    #[must_use]
    pub fn knuckle_lines(&self) -> Vec<Vec<[f64; 3]>> {
        let (first, last) = self.surface().u().domain();
        let knots = self.surface().v().breakpoints();
        let mut lines = Vec::new();
        for &v in knots.get(1..knots.len().saturating_sub(1)).unwrap_or_default() {
            let mut line: Vec<[f64; 3]> = Vec::new();
            for k in 0..=PLACES {
                let u = first + (last - first) * k as f64 / PLACES as f64;
                let point = self.surface().eval(u, v);
                if self.is_knuckle(u, v) && point[2] <= self.deck_height(point[0]) {
                    line.push(point);
                } else if !line.is_empty() {
                    lines.push(std::mem::take(&mut line));
                }
            }
            lines.push(line);
        }
        lines.retain(|line| line.len() > 1);
        lines
    }
}
