//! The curves of the lines plan as polylines: in space, and in the three views of a drawing.

use crate::exchange::DxfLine;
use crate::hull::{Cut, Hull, StationNumbers, default_buttocks, default_stations, default_waterlines};

/// Points of the deck at side.
const DECK_POINTS: usize = 200;

/// Space between the views over the breadth.
const GAP: f64 = 0.5;

/// The branches of a section as points \[m\].
fn curves(hull: &Hull, cut: Cut, deviation: f64) -> Vec<Vec<[f64; 3]>> {
    hull.section(cut, 1e-9).branches.iter().map(|branch| branch.polyline(deviation)).collect()
}

/// Stations, waterlines and buttocks in space on layers of their names, both sides, z = 0 at `datum` \[m\].
pub(super) fn lines_in_space(hull: &Hull, numbers: StationNumbers, deviation: f64, datum: f64) -> Vec<DxfLine> {
    let mut lines = Vec::new();
    let mut add = |layer: &str, cut: Cut| {
        for mut points in curves(hull, cut, deviation) {
            points.iter_mut().for_each(|point| point[2] -= datum);
            let mirrored = points.iter().any(|point| point[1].abs() > 1e-9);
            let other: Vec<[f64; 3]> = points.iter().map(|&[x, y, z]| [x, 0.0 - y, z]).collect();
            lines.push(DxfLine { layer: layer.to_owned(), points, flat: false });
            if mirrored {
                lines.push(DxfLine { layer: layer.to_owned(), points: other, flat: false });
            }
        }
    };
    for station in default_stations(hull, numbers) {
        add("STATIONS", Cut::Station { x: station.x });
    }
    for z in default_waterlines(hull) {
        add("WATERLINES", Cut::Waterline { z });
    }
    for y in default_buttocks(hull) {
        add("BUTTOCKS", Cut::Buttock { y });
    }
    lines
}

/// The three views in one plane at full size: the profile in its place (x, z); below it the half-breadth plan (x, y)
/// with y upward; beside it, forward, the body plan with the sections of the after body to the left of its centreline.
/// Each view has its curves, its outline and its grid on layers of their own.
pub(super) fn drawn_plan(hull: &Hull, numbers: StationNumbers, deviation: f64, datum: f64) -> Vec<DxfLine> {
    let particulars = hull.particulars();
    let (length, breadth) = (particulars.length_between_perpendiculars, particulars.breadth);
    let (stations, waterlines, buttocks) =
        (default_stations(hull, numbers), default_waterlines(hull), default_buttocks(hull));
    let along = hull.surface().points().iter().map(|point| point[0]);
    let (aft, fore) = along.fold((0.0_f64, length), |(a, b), x| (a.min(x), b.max(x)));
    let low = hull.bottom() - datum;
    // Where the centreline of the half-breadth plan lies, and that of the body plan.
    let centreline = low - (0.5 + GAP) * breadth;
    let middle = fore + (0.5 + GAP) * breadth;
    let profile = |[x, _, z]: [f64; 3]| [x, z - datum];
    let plan = |[x, y, _]: [f64; 3]| [x, centreline + y];
    let mut lines = Vec::new();
    let mut put = |layer: &str, points: Vec<[f64; 2]>| {
        let points = points.into_iter().map(|[x, y]| [x, y, 0.0]).collect();
        lines.push(DxfLine { layer: layer.to_owned(), points, flat: true });
    };
    for station in &stations {
        let side = if station.x < 0.5 * length { -1.0 } else { 1.0 };
        for points in curves(hull, Cut::Station { x: station.x }, deviation) {
            put("BODY_STATIONS", points.into_iter().map(|[_, y, z]| [middle + side * y, z - datum]).collect());
        }
        put("PROFILE_GRID", vec![[station.x, low], [station.x, hull.top() - datum]]);
        put("PLAN_GRID", vec![[station.x, centreline], [station.x, centreline + 0.5 * breadth]]);
    }
    for &z in &waterlines {
        for points in curves(hull, Cut::Waterline { z }, deviation) {
            put("PLAN_WATERLINES", points.into_iter().map(plan).collect());
        }
        put("PROFILE_GRID", vec![[aft, z - datum], [fore, z - datum]]);
        put("BODY_GRID", vec![[middle - 0.5 * breadth, z - datum], [middle + 0.5 * breadth, z - datum]]);
    }
    for &y in buttocks.iter().filter(|y| **y > 0.0) {
        for points in curves(hull, Cut::Buttock { y }, deviation) {
            put("PROFILE_BUTTOCKS", points.into_iter().map(profile).collect());
        }
        put("PLAN_GRID", vec![[aft, centreline + y], [fore, centreline + y]]);
        for side in [-1.0, 1.0] {
            put("BODY_GRID", vec![[middle + side * y, low], [middle + side * y, hull.top() - datum]]);
        }
    }
    put("BODY_GRID", vec![[middle, low], [middle, hull.top() - datum]]);
    put("PLAN_GRID", vec![[aft, centreline], [fore, centreline]]);
    for points in curves(hull, Cut::Buttock { y: 0.0 }, deviation) {
        put("PROFILE_OUTLINE", points.into_iter().map(profile).collect());
    }
    let deck: Vec<[f64; 3]> = (0..=DECK_POINTS)
        .map(|k| aft + (fore - aft) * k as f64 / DECK_POINTS as f64)
        .filter_map(|x| {
            let z = hull.deck_height(x);
            hull.half_breadth(x, z).map(|y| [x, y, z])
        })
        .collect();
    put("PROFILE_DECK", deck.iter().copied().map(profile).collect());
    put("PLAN_DECK", deck.into_iter().map(plan).collect());
    lines
}
