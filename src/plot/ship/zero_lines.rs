//! Lines on which a curvature of a map changes its sign, as whole curves.
//!
//! The crossings of the sides of cells are joined to chains. A piece of a chain counts where the curvature reaches a
//! least size with both signs nearby: what is flat but for rounding has signs without meaning. From there a line goes
//! on as long as the curvature reaches a small part of that size, so that it ends at an edge, in itself, or where the
//! surface is developable. Short gaps in a chain are filled and short pieces left out, so that lines neither stutter
//! nor leave crumbs.

use std::collections::BTreeMap;

use crate::fairing::inspect::SurfaceMap;

/// How near both signs stand, in cells.
const NEAR: usize = 3;
/// Part of the least size down to which a line goes on: what stays below it on either side is rounding.
pub(in crate::plot) const FAINT: f64 = 0.08;
/// Most pieces of a gap that is filled.
const GAP: usize = 6;
/// Least length of a line [mm].
const SHORT: f64 = 12.0;

/// Two points of the map with a crossing between them, the lower index first.
type MapEdge = (usize, usize);

/// The lines of zero of curvature `which` (0 Gaussian, 1 mean) where it reaches `least`; `place` takes x and girth to
/// the sheet.
pub(in crate::plot) fn zero_lines(
    map: &SurfaceMap,
    which: usize,
    least: f64,
    place: &dyn Fn([f64; 2]) -> [f64; 2],
) -> Vec<Vec<[f64; 2]>> {
    let value = |k: usize| map.points[k].curvature.map(|c| c[which]);
    let crossing = |(a, b): MapEdge| {
        let (Some(p), Some(q)) = (value(a), value(b)) else { return [0.0; 2] };
        let t = p / (p - q);
        let [from, to] = [a, b].map(|k| place([map.points[k].at[0], map.points[k].girth]));
        [from[0] + t * (to[0] - from[0]), from[1] + t * (to[1] - from[1])]
    };
    let pieces = pieces(map, &value);
    let mut at: BTreeMap<MapEdge, Vec<usize>> = BTreeMap::new();
    for (k, piece) in pieces.iter().enumerate() {
        piece.sides.iter().for_each(|side| at.entry(*side).or_default().push(k));
    }
    let reaching =
        |least: f64| -> Vec<bool> { pieces.iter().map(|piece| reaches(map, &value, piece.cell, least)).collect() };
    let (strong, faint) = (reaching(least), reaching(FAINT * least));
    let mut used = vec![false; pieces.len()];
    let mut lines = Vec::new();
    // Chains with ends first, then rings.
    let starts = at.iter().filter(|(_, list)| list.len() == 1).map(|(side, list)| (*side, list[0]));
    let rings = (0..pieces.len()).map(|k| (pieces[k].sides[0], k));
    for (side, first) in starts.chain(rings).collect::<Vec<_>>() {
        if used[first] {
            continue;
        }
        let (mut sides, mut members) = (vec![side], Vec::new());
        let mut next = Some(first);
        while let Some(k) = next {
            used[k] = true;
            members.push(k);
            let last = sides[sides.len() - 1];
            let [a, b] = pieces[k].sides;
            let far = if a == last { b } else { a };
            sides.push(far);
            next = at[&far].iter().copied().find(|&other| !used[other]);
        }
        let points: Vec<[f64; 2]> = sides.into_iter().map(&crossing).collect();
        let of = |list: &[bool]| members.iter().map(|&k| list[k]).collect::<Vec<_>>();
        lines.extend(kept(&points, &of(&strong), of(&faint)));
    }
    lines
}

/// A piece of a line in a cell (column, row), from side to side.
struct Piece {
    cell: [usize; 2],
    sides: [MapEdge; 2],
}

fn pieces(map: &SurfaceMap, value: &dyn Fn(usize) -> Option<f64>) -> Vec<Piece> {
    let mut list = Vec::new();
    for i in 0..map.columns() - 1 {
        for j in 0..map.rows - 1 {
            let corners = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)].map(|(i, j)| i * map.rows + j);
            let [Some(a), Some(b), Some(c), Some(d)] = corners.map(value) else { continue };
            let negative = [a, b, c, d].map(|v| v < 0.0);
            let crossed: Vec<MapEdge> = (0..4)
                .filter(|&k| negative[k] != negative[(k + 1) % 4])
                .map(|k| (corners[k].min(corners[(k + 1) % 4]), corners[k].max(corners[(k + 1) % 4])))
                .collect();
            list.extend(crossed.chunks_exact(2).map(|pair| Piece { cell: [i, j], sides: [pair[0], pair[1]] }));
        }
    }
    list
}

/// Whether the curvature reaches `least` with both signs near a cell.
fn reaches(map: &SurfaceMap, value: &dyn Fn(usize) -> Option<f64>, [i, j]: [usize; 2], least: f64) -> bool {
    let columns = i.saturating_sub(NEAR)..(i + NEAR + 2).min(map.columns());
    let rows = j.saturating_sub(NEAR)..(j + NEAR + 2).min(map.rows);
    let all = columns.flat_map(|i| rows.clone().map(move |j| i * map.rows + j)).filter_map(value);
    let [low, high] = all.fold([0.0, 0.0], |[low, high]: [f64; 2], v| [low.min(v), high.max(v)]);
    high >= least && low <= -least
}

/// The parts of a chain that are faint at least and somewhere strong, gaps filled and crumbs left out.
fn kept(points: &[[f64; 2]], strong: &[bool], mut counts: Vec<bool>) -> Vec<Vec<[f64; 2]>> {
    let marked: Vec<usize> = (0..counts.len()).filter(|&k| counts[k]).collect();
    for pair in marked.windows(2) {
        if pair[1] - pair[0] <= GAP + 1 {
            counts[pair[0]..pair[1]].fill(true);
        }
    }
    let mut from = 0;
    for run in counts.clone().chunk_by(|a, b| a == b) {
        let all = from..from + run.len();
        from = all.end;
        if !strong[all.clone()].contains(&true) {
            counts[all].fill(false);
        }
    }
    let mut lines: Vec<Vec<[f64; 2]>> = Vec::new();
    let mut open = false;
    for (k, count) in counts.iter().enumerate() {
        if *count && !open {
            lines.push(vec![points[k]]);
        }
        if let (true, Some(line)) = (*count, lines.last_mut()) {
            line.push(points[k + 1]);
        }
        open = *count;
    }
    lines.retain(|line| crate::plot::paper::label::length(line) >= SHORT);
    lines
}
