//! Whether a fitted surface stays within what its table says: warnings, each with the place.
//!
//! The surface is sampled on 201 x 61 parameters, below the deck. A half-breadth below -B/1000, or above the greatest
//! given one by more than 2 %, is reported; so is a coefficient above one at the design draught. Cost: 12 thousand points.

use crate::hull::{Hull, OffsetTable};
use crate::hydrostatics::{Hydrostatics, QUANTITIES};

/// Intervals of the sampling along and around the hull.
const INTERVALS: [u32; 2] = [200, 60];
/// Deepest half-breadth below zero that is rounding of the net, in breadths.
const BELOW: f64 = 1e-3;
/// Part by which the surface may swell beyond the greatest given half-breadth.
const ABOVE: f64 = 0.02;

/// The greatest half-breadth that the table gives \[m\]; 0 where it gives none.
fn greatest(table: &OffsetTable) -> f64 {
    let cells = table.stations.iter().flat_map(|s| s.half_breadths.iter().filter_map(|cell| cell.value()));
    let decks = table.stations.iter().filter_map(|s| s.deck_half_breadth);
    let points = table.stations.iter().flat_map(|s| s.outlines.iter().flatten().map(|point| point.y));
    let stated = table.stated.breadth.map(|b| 0.5 * b);
    cells.chain(decks).chain(points).chain(stated).filter(|y| y.is_finite()).fold(0.0, f64::max)
}

/// What is wrong with `hull`, the fit of `table`; `design` is its row of hydrostatics at the design draught, where one is
/// stated. Empty when nothing is.
pub(in crate::report) fn warnings(table: &OffsetTable, hull: &Hull, design: Option<&Hydrostatics>) -> Vec<String> {
    let surface = hull.surface();
    let (along, around) = (surface.u().domain(), surface.v().domain());
    let at = |(from, to): (f64, f64), k: u32, n: u32| from + (to - from) * f64::from(k) / f64::from(n);
    let (mut narrow, mut wide) = ([0.0f64; 3], [0.0f64; 3]);
    for i in 0..=INTERVALS[0] {
        for j in 0..=INTERVALS[1] {
            let point = surface.eval(at(along, i, INTERVALS[0]), at(around, j, INTERVALS[1]));
            if point[2] > hull.deck_height(point[0]) {
                continue;
            }
            if point[1] < narrow[1] {
                narrow = point;
            }
            if point[1] > wide[1] {
                wide = point;
            }
        }
    }
    let mut list = Vec::new();
    if narrow[1] < -BELOW * hull.particulars().breadth {
        let [x, y, z] = narrow;
        list.push(format!("the surface crosses the centreplane by {:.3} m at x {x:.2} m, z {z:.2} m", -y));
    }
    let given = greatest(table);
    if given > 0.0 && wide[1] > (1.0 + ABOVE) * given {
        let [x, y, z] = wide;
        let percent = 100.0 * (y / given - 1.0);
        list.push(format!(
            "the surface swells to a half-breadth of {y:.3} m at x {x:.2} m, z {z:.2} m, {percent:.1} % beyond the greatest given one, {given:.3} m"
        ));
    }
    for quantity in QUANTITIES.iter().filter(|quantity| matches!(quantity.key, "CVP" | "CWP" | "CX")) {
        if let Some(value) = design.and_then(quantity.value).filter(|value| *value > 1.0 + 1e-9) {
            list.push(format!(
                "the {} at the design draught is {value:.4}, above 1: Lpp, B or T do not suit the offsets, or the surface swells",
                quantity.name
            ));
        }
    }
    list
}
