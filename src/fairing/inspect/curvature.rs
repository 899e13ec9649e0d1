//! Curvature of the whole surface: extremes and integrals.
//!
//! Taken at 6 x 6 Gauss points to a patch below the deck at side. Integrals are those of the Gauss rule: on a patch
//! that is smooth and regular, of high order; the borders of the deck inside a patch cost one order or more. Extremes
//! are those among the points, which stand inside the patches: towards an edge at which the surface has no tangent
//! plane (a keel or a stem that is a point or a blunt line) curvature grows without bound, and the points stop short of
//! it. With u forward and v upward a surface that is convex outward has positive principal curvatures.

use super::contour::breaks;
use crate::hull::Hull;
use crate::numeric::gauss_legendre;
use crate::spline::SurfaceCurvature;

/// Gauss points to a span.
const POINTS: usize = 6;

/// A curvature somewhere on the surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CurvatureAt {
    /// The value [1/m, or 1/m^2 for the Gaussian curvature].
    pub value: f64,
    /// Where \[m\].
    pub at: [f64; 3],
}

/// Least and greatest value of a curvature.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CurvatureRange {
    /// Name: `gaussian`, `mean`, `principal_1` (the greater), `principal_2`.
    pub name: &'static str,
    /// The least.
    pub least: CurvatureAt,
    /// The greatest.
    pub greatest: CurvatureAt,
}

/// Curvature of one side of a hull below the deck at side.
#[derive(Debug, Clone, PartialEq)]
pub struct SurfaceMeasures {
    /// Area \[m^2\].
    pub area: f64,
    /// int (k1^2 + k2^2) dA, the bending energy of a thin plate.
    pub bending: f64,
    /// Ranges of the Gaussian, mean and principal curvatures; empty when the surface has no regular point.
    pub ranges: Vec<CurvatureRange>,
    /// Points without a tangent plane, which are left out.
    pub degenerate: usize,
}

type Read = fn(&SurfaceCurvature) -> f64;

/// The parameter on the line `u` at which the surface reaches the deck at side.
pub(super) fn deck_parameter(hull: &Hull, u: f64) -> f64 {
    let (from, to) = hull.surface().v().domain();
    let above = |v: f64| {
        let p = hull.surface().eval(u, v);
        p[2] > hull.deck_height(p[0])
    };
    if !above(to) {
        return to;
    }
    let (mut low, mut high) = (from, to);
    for _ in 0..52 {
        let middle = 0.5 * (low + high);
        if above(middle) { high = middle } else { low = middle }
    }
    low
}

impl SurfaceMeasures {
    /// Measures the side of a hull.
    #[must_use]
    pub fn of(hull: &Hull) -> Self {
        let read: [(&'static str, Read); 4] = [
            ("gaussian", |c| c.gaussian),
            ("mean", |c| c.mean),
            ("principal_1", |c| c.principal[0]),
            ("principal_2", |c| c.principal[1]),
        ];
        let surface = hull.surface();
        let rule = gauss_legendre(POINTS);
        let mut measures = Self { area: 0.0, bending: 0.0, ranges: Vec::new(), degenerate: 0 };
        let lines = breaks(surface.v());
        for across in breaks(surface.u()).windows(2) {
            for (u, weight_u) in rule.on(across[0], across[1]) {
                let deck = deck_parameter(hull, u);
                for up in lines.windows(2).filter(|up| up[0] < deck) {
                    for (v, weight_v) in rule.on(up[0], up[1].min(deck)) {
                        let jet = surface.jet(u, v);
                        let Some(curvature) = jet.curvature() else {
                            measures.degenerate += 1;
                            continue;
                        };
                        let (a, b) = (jet.du, jet.dv);
                        let area = weight_u
                            * weight_v
                            * (a[1] * b[2] - a[2] * b[1])
                                .hypot(a[2] * b[0] - a[0] * b[2])
                                .hypot(a[0] * b[1] - a[1] * b[0]);
                        measures.area += area;
                        measures.bending += area * curvature.principal.iter().map(|k| k * k).sum::<f64>();
                        measures.take(&read, &curvature, jet.point);
                    }
                }
            }
        }
        measures
    }

    fn take(&mut self, read: &[(&'static str, Read); 4], curvature: &SurfaceCurvature, at: [f64; 3]) {
        let here = |(_, value): &(&'static str, Read)| CurvatureAt { value: value(curvature), at };
        if self.ranges.is_empty() {
            self.ranges =
                read.iter().map(|r| CurvatureRange { name: r.0, least: here(r), greatest: here(r) }).collect();
        }
        for (range, r) in self.ranges.iter_mut().zip(read) {
            let now = here(r);
            if now.value < range.least.value {
                range.least = now;
            }
            if now.value > range.greatest.value {
                range.greatest = now;
            }
        }
    }
}
