//! The curves of a plane on a hull as a draughtsman draws them, and the plane of a station at an end of the hull.

use crate::fairing::record::FairRecord;
use crate::hull::{Cut, Face, Hull};

/// The curves of a plane on the side of a hull.
pub(in crate::plot) fn curves(hull: &Hull, cut: Cut, deviation: f64) -> Vec<Vec<[f64; 3]>> {
    let section = hull.section(cut, 1e-6);
    let side = section.branches.iter().filter(|branch| branch.face == Face::Side);
    side.map(|branch| branch.polyline(deviation)).collect()
}

/// The curves of a plane on the hull, in one piece where the hull is one: stations and diagonals run on over the flats,
/// to the centre line; a station at an end of the hull that goes in and out of its side, or leaves it before the keel,
/// is the edge there.
pub(in crate::plot) fn whole_curves(hull: &Hull, cut: Cut, deviation: f64) -> Vec<Vec<[f64; 3]>> {
    let section = hull.section(cut, 1e-6);
    let on = |faces: &[Face]| {
        let branches = section.branches.iter().filter(|branch| faces.contains(&branch.face));
        branches.map(|branch| branch.polyline(deviation)).collect::<Vec<_>>()
    };
    match cut {
        Cut::Station { x } => {
            // What lies in the plane of a transom or a flat bow is no line of the side.
            let lines = on(&[Face::Side, Face::Bottom]);
            let in_pieces = on(&[Face::Side]).len() > 1;
            let foot = lines.iter().flatten().min_by(|a, b| a[2].total_cmp(&b[2]).then(a[1].total_cmp(&b[1])));
            let is_open = foot.is_some_and(|foot| foot[1] > OPEN * hull.particulars().breadth);
            // A bulb under a flare is in two pieces too, far wider than the stem beside it.
            let edge = if in_pieces || is_open { end_curve(hull, x) } else { None };
            let edge = edge.filter(|edge| widest(edge) >= 0.5 * widest(lines.iter().flatten()));
            edge.map_or(lines, |edge| vec![edge])
        }
        Cut::Diagonal { .. } => on(&[Face::Side, Face::Bottom, Face::Transom, Face::Bow]),
        _ => on(&[Face::Side]),
    }
}

/// The greatest half-breadth of points \[m\].
fn widest<'a>(points: impl IntoIterator<Item = &'a [f64; 3]>) -> f64 {
    points.into_iter().map(|p| p[1]).fold(0.0, f64::max)
}

/// Half-breadth of the foot of a section that ends away from the centre line, in breadths of the hull.
const OPEN: f64 = 1e-3;

/// The end of the surface beside the station at `x`, from the centre line at the keel to the deck; none where no end is
/// near.
fn end_curve(hull: &Hull, x: f64) -> Option<Vec<[f64; 3]>> {
    const POINTS: usize = 400;
    let surface = hull.surface();
    let (ends, (v0, v1)) = (surface.u().domain(), surface.v().domain());
    let near = END * hull.particulars().length_between_perpendiculars;
    let edge = |u: f64| {
        let points = (0..=POINTS).map(|k| surface.eval(u, v0 + (v1 - v0) * k as f64 / POINTS as f64));
        let all: Vec<[f64; 3]> = points.filter(|p| p[2] <= hull.deck_height(p[0])).collect();
        let beside: Vec<[f64; 3]> = all.iter().copied().filter(|p| (p[0] - x).abs() <= near).collect();
        // An upright end that is rounded off at its foot is drawn down to it.
        if 2 * beside.len() >= all.len() { all } else { beside }
    };
    let xs = || surface.points().iter().map(|p| p[0]);
    let (low, high) = (xs().fold(f64::INFINITY, f64::min), xs().fold(f64::NEG_INFINITY, f64::max));
    let end = if x - low <= near { ends.0 } else { Some(ends.1).filter(|_| high - x <= near)? };
    let mut points = Some(edge(end)).filter(|points| points.len() > 1)?;
    let [x, y, z] = points[0];
    if y > 0.0 {
        points.insert(0, [x, 0.0, z]);
    }
    Some(points)
}

/// Part of the length within which a station is at an end of the hull, and by which it stands inside when it is drawn
/// there: an upright end that is a plane at the waterlines alone leaves that plane by less.
const END: f64 = 0.01;
const INSIDE: f64 = 1e-4;

/// The plane of a station; at an end of the hull, where it may go in and out of the side, a hair inside if that is in
/// fewer pieces.
pub(in crate::plot) fn station_cut(record: &FairRecord, x: f64) -> Cut {
    let hull = &record.after;
    let xs = || hull.surface().points().iter().map(|p| p[0]);
    let (low, high) = (xs().fold(f64::INFINITY, f64::min), xs().fold(f64::NEG_INFINITY, f64::max));
    let length = high - low;
    if x - low > END * length && high - x > END * length {
        return Cut::Station { x };
    }
    let inward = Cut::Station { x: x + INSIDE * length * if x - low < high - x { 1.0 } else { -1.0 } };
    let pieces = |cut: Cut| match curves(hull, cut, END * length).len() {
        0 => usize::MAX,
        count => count,
    };
    if pieces(inward) < pieces(Cut::Station { x }) { inward } else { Cut::Station { x } }
}
