//! Curvature combs: section curves with their curvature at equal steps, and their inflections.

use super::contour::{Breadth, Locator, Trace};
use super::{LONGEST_END, NO_BREADTH, SECTION};
use crate::hull::{Cut, Face, Hull};

/// A tooth of a comb.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tooth {
    /// Where it stands \[m\].
    pub at: [f64; 3],
    /// From the curve to its convex side, as long as the curvature \[1/m\].
    pub tooth: [f64; 3],
}

/// The comb of one connected curve.
#[derive(Debug, Clone, PartialEq)]
pub struct Comb {
    /// The plane of the curve.
    pub cut: Cut,
    /// Teeth in order along the curve.
    pub teeth: Vec<Tooth>,
    /// Inflections \[m\], by the same rule as in an inspection.
    pub inflections: Vec<[f64; 3]>,
}

/// The combs of the curves in which planes cut the side of a hull, `count` teeth each; `tolerance` is the departure
/// that can just be seen \[m\]. Curves without breadth have none.
#[must_use]
pub fn combs(hull: &Hull, cuts: &[Cut], count: usize, tolerance: f64) -> Vec<Comb> {
    let locator = Locator::new(hull.surface());
    let p = hull.particulars();
    let close = SECTION * p.length_between_perpendiculars;
    let breadth = Breadth { least: NO_BREADTH * p.breadth, longest: LONGEST_END * p.breadth };
    let mut list = Vec::new();
    for &cut in cuts {
        let Some((normal, _)) = cut.plane() else { continue };
        let section = hull.section(cut, close);
        for branch in section.branches.iter().filter(|branch| branch.face == Face::Side) {
            let breadth = (!matches!(cut, Cut::Buttock { .. })).then_some(breadth);
            let Some(trace) = Trace::new(&locator, branch, normal, 100.0 * close, breadth, hull.follows_net(cut))
            else {
                continue;
            };
            let samples = trace.profile.even(count);
            // The surface says how much the curve bends, the curve itself to which side.
            let turns = samples.windows(2).map(|pair| {
                let ([a, b], [c, d]) = (pair[0].1, pair[1].1);
                (a * d - b * c) * pair[0].2
            });
            let side = if turns.sum::<f64>() < 0.0 { 1.0 } else { -1.0 };
            let teeth = samples.iter().map(|&(point, [a, b], curvature)| {
                let tip = [-b, a].map(|c| side * curvature * c);
                let (at, end) = (trace.space(point), trace.space([point[0] + tip[0], point[1] + tip[1]]));
                Tooth { at, tooth: std::array::from_fn(|d| end[d] - at[d]) }
            });
            let found = trace.profile.findings(tolerance);
            list.push(Comb {
                cut,
                teeth: teeth.collect(),
                inflections: found.inflections.iter().map(|place| trace.space(place.point)).collect(),
            });
        }
    }
    list
}
