//! The curves of the lines plan as polylines: in space, and in the three views of a drawing.

use crate::exchange::DxfLine;
use crate::hull::{Branch, Cut, Face, Hull, StationNumbers, default_buttocks, default_stations, default_waterlines};
use crate::spline::{dot, length, minus};

/// Points of the deck at side.
const DECK_POINTS: usize = 200;

/// Space between the views over the breadth.
const GAP: f64 = 0.5;

/// The branches of a section as points \[m\].
fn curves(hull: &Hull, cut: Cut, deviation: f64) -> Vec<Vec<[f64; 3]>> {
    hull.section(cut, 1e-9).branches.iter().map(|branch| branch.polyline(deviation)).collect()
}

/// The part of a line below the deck at side, up to where it meets it.
fn below_deck(hull: &Hull, points: &[[f64; 3]]) -> Vec<[f64; 3]> {
    let over = |p: &[f64; 3]| p[2] - hull.deck_height(p[0]);
    let mut kept: Vec<[f64; 3]> = Vec::new();
    for point in points {
        if over(point) <= 0.0 {
            kept.push(*point);
            continue;
        }
        if let Some(&last) = kept.last() {
            let share = over(&last) / (over(&last) - over(point));
            kept.push([0, 1, 2].map(|k| last[k] + share * (point[k] - last[k])));
        }
        break;
    }
    kept
}

/// A line without the points that its other points keep within `deviation` \[m\] (Ramer, Douglas and Peucker).
fn thinned(points: &[[f64; 3]], deviation: f64) -> Vec<[f64; 3]> {
    let mut kept = vec![false; points.len()];
    let mut open = vec![(0, points.len().saturating_sub(1))];
    while let Some((from, to)) = open.pop() {
        if points.is_empty() {
            break;
        }
        (kept[from], kept[to]) = (true, true);
        let chord = minus(points[to], points[from]);
        let squared = dot(chord, chord);
        let off = |point: [f64; 3]| {
            let out = minus(point, points[from]);
            let share = if squared > 0.0 { (dot(out, chord) / squared).clamp(0.0, 1.0) } else { 0.0 };
            length([0, 1, 2].map(|k| out[k] - share * chord[k]))
        };
        let farthest = (from + 1..to).map(|k| (k, off(points[k]))).max_by(|a, b| a.1.total_cmp(&b.1));
        if let Some((k, _)) = farthest.filter(|(_, distance)| *distance > deviation) {
            open.extend([(from, k), (k, to)]);
        }
    }
    points.iter().zip(kept).filter(|(_, kept)| *kept).map(|(point, _)| *point).collect()
}

/// Stem, stern, keel, sheer (the deck at side) and knuckles, each with its layer.
fn own_lines(hull: &Hull, deviation: f64) -> Vec<(&'static str, Vec<[f64; 3]>)> {
    let surface = hull.surface();
    let ((aft, fore), (low, _)) = (surface.u().domain(), surface.v().domain());
    let polyline = |curve| Branch { face: Face::Side, curve, closed: false }.polyline(deviation);
    let ends = [("STERN", aft), ("STEM", fore)];
    let mut lines: Vec<(&'static str, Vec<[f64; 3]>)> =
        ends.map(|(layer, u)| (layer, below_deck(hull, &polyline(surface.curve_at_u(u))))).to_vec();
    lines.push(("KEEL", polyline(surface.curve_at_v(low))));
    lines.push(("SHEER", thinned(&sheer(hull), deviation)));
    lines.extend(hull.knuckle_lines().iter().map(|line| ("KNUCKLES", thinned(line, deviation))));
    lines
}

/// The deck at side.
fn sheer(hull: &Hull) -> Vec<[f64; 3]> {
    let xs = hull.surface().points().iter().map(|point| point[0]);
    let [aft, fore] = xs.fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], x| [a.min(x), b.max(x)]);
    let point = |k: usize| {
        let x = aft + (fore - aft) * k as f64 / DECK_POINTS as f64;
        let z = hull.deck_height(x);
        hull.half_breadth(x, z).map(|y| [x, y, z])
    };
    (0..=DECK_POINTS).filter_map(point).collect()
}

/// Stations, waterlines and buttocks in space on layers of their names, stem, stern, keel, sheer and knuckles on theirs, both
/// sides, z = 0 at `datum` \[m\].
pub(in crate::report) fn lines_in_space(
    hull: &Hull,
    numbers: StationNumbers,
    deviation: f64,
    datum: f64,
) -> Vec<DxfLine> {
    let mut lines = Vec::new();
    let mut put = |layer: &str, all: Vec<Vec<[f64; 3]>>| {
        for mut points in all {
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
        put("STATIONS", curves(hull, Cut::Station { x: station.x }, deviation));
    }
    for z in default_waterlines(hull) {
        put("WATERLINES", curves(hull, Cut::Waterline { z }, deviation));
    }
    for y in default_buttocks(hull) {
        put("BUTTOCKS", curves(hull, Cut::Buttock { y }, deviation));
    }
    for (layer, points) in own_lines(hull, deviation) {
        put(layer, vec![points]);
    }
    lines
}

/// The three views in one plane at full size: the profile in its place (x, z); below it the half-breadth plan (x, y)
/// with y upward; beside it, forward, the body plan with the sections of the after body to the left of its centreline.
/// Each view has its curves, its outline and its grid on layers of their own.
pub(in crate::report) fn drawn_plan(hull: &Hull, numbers: StationNumbers, deviation: f64, datum: f64) -> Vec<DxfLine> {
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
    let deck = sheer(hull);
    put("PROFILE_DECK", deck.iter().copied().map(profile).collect());
    put("PLAN_DECK", deck.into_iter().map(plan).collect());
    lines
}
