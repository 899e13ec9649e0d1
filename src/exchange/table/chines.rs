//! Chines of sections as points that no mark tells.
//!
//! Between straight panels a section turns at one point, and hardly at those beside it. Where the same is found at stations
//! beside each other, the points are on a chine. A section of four points or fewer shows no curve at all: its points are
//! joined by straight lines.

use super::problem::{FilePosition, Problems};
use crate::hull::{OffsetTable, OutlinePoint, StationOffsets};
use crate::units::counted;
use std::f64::consts::PI;

/// Most points of a section that is a chain of straight lines.
const FEW: usize = 4;

/// Least turn between two panels.
const TURN: f64 = 15.0 * PI / 180.0;

/// Most turn at the points beside it, over that.
const BESIDE: f64 = 0.25;

/// Fewer stations beside each other prove no chine.
const LEAST: usize = 3;

/// One of so many stations at least has a chine.
const SHARE: usize = 6;

/// Points of two stations are on one chine up to this distance, over the length of the section.
const NEAR: f64 = 0.2;

/// Marks the points on chines, where no line and no point of the table is marked; says so.
pub(super) fn mark(table: &mut OffsetTable, problems: &mut Problems) {
    let is_marked = |p: &OutlinePoint| p.marks.knuckle || p.marks.tangent;
    if !table.lines.is_empty() || table.stations.iter().flat_map(|s| s.outlines.iter().flatten()).any(is_marked) {
        return;
    }
    let outlined = table.stations.iter().filter(|s| s.outlines.iter().any(|o| o.len() > 1)).count();
    let has_few = |s: &&mut StationOffsets| s.outlines.len() == 1 && (3..=FEW).contains(&s.outlines[0].len());
    let few = table.stations.iter_mut().filter(has_few).count();
    if outlined >= LEAST && 2 * few > outlined {
        for station in table.stations.iter_mut().filter(has_few) {
            let last = station.outlines[0].len() - 1;
            station.outlines[0][1..last].iter_mut().for_each(|point| point.marks.knuckle = true);
        }
        let message = format!(
            "{} of 4 points or fewer: joined by straight lines, with a chine where these meet",
            counted(few, "section")
        );
        let remedy = "Give more points where the sections are round, or marks K on the chines";
        return problems.warning("W338", FilePosition::FILE, message, remedy);
    }
    let found: Vec<Vec<usize>> = table.stations.iter().map(corners).collect();
    let mut marked = vec![Vec::new(); found.len()];
    // Three sections beside each other may turn alike at a bulb.
    let least = LEAST.max(table.stations.len() / SHARE);
    let (mut first, mut last, mut count) = (f64::INFINITY, f64::NEG_INFINITY, 0);
    for start in 0..found.len() {
        for &corner in &found[start] {
            let run = run(table, &found, [start, corner]);
            if run.len() < least {
                continue;
            }
            for &[station, point] in &run {
                if !marked[station].contains(&point) {
                    marked[station].push(point);
                    count += 1;
                }
            }
            first = first.min(table.stations[start].station.x);
            last = last.max(table.stations[run[run.len() - 1][0]].station.x);
        }
    }
    for (station, points) in table.stations.iter_mut().zip(marked) {
        points.into_iter().for_each(|point| station.outlines[0][point].marks.knuckle = true);
    }
    if count > 0 {
        let message = format!(
            "chines between straight panels from x = {first:.3} to {last:.3} m: {} taken as knuckles",
            counted(count, "point")
        );
        let remedy = "Mark knuckles with K where the chines are others";
        problems.warning("W338", FilePosition::FILE, message, remedy);
    }
}

/// Angle between two chords \[rad\].
fn turn([a, b, c]: [OutlinePoint; 3]) -> f64 {
    let (first, second) = ([b.y - a.y, b.z - a.z], [c.y - b.y, c.z - b.z]);
    (first[0] * second[1] - first[1] * second[0]).atan2(first[0] * second[0] + first[1] * second[1]).abs()
}

/// The points at which a section turns alone.
fn corners(station: &StationOffsets) -> Vec<usize> {
    let [points] = station.outlines.as_slice() else { return Vec::new() };
    let angle = |k: usize| {
        let near: Option<[OutlinePoint; 3]> =
            k.checked_sub(1).and_then(|before| points.get(before..before + 3)?.try_into().ok());
        near.map_or(0.0, turn)
    };
    let is_corner = |&k: &usize| {
        let own = angle(k);
        own > TURN && angle(k - 1) < BESIDE * own && angle(k + 1) < BESIDE * own
    };
    (1..points.len().saturating_sub(1)).filter(is_corner).collect()
}

/// The corners of the stations that follow one, each near the one before.
fn run(table: &OffsetTable, found: &[Vec<usize>], from: [usize; 2]) -> Vec<[usize; 2]> {
    let at = |[station, point]: [usize; 2]| table.stations[station].outlines[0][point];
    let girth = |station: usize| -> f64 {
        table.stations[station].outlines[0].windows(2).map(|p| (p[1].y - p[0].y).hypot(p[1].z - p[0].z)).sum()
    };
    let mut run = vec![from];
    for (station, corners) in found.iter().enumerate().skip(from[0] + 1) {
        let here = at(run[run.len() - 1]);
        let apart = |&point: &usize| {
            let other = at([station, point]);
            (other.y - here.y).hypot(other.z - here.z)
        };
        let nearest = corners.iter().copied().min_by(|a, b| apart(a).total_cmp(&apart(b)));
        match nearest.filter(|point| apart(point) < NEAR * girth(station)) {
            Some(point) => run.push([station, point]),
            None => break,
        }
    }
    run
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hull::Marks;

    fn table(sections: usize, points: &[(f64, f64)]) -> OffsetTable {
        let outline: Vec<OutlinePoint> =
            points.iter().map(|&(y, z)| OutlinePoint { y, z, marks: Marks::default() }).collect();
        let station =
            |k: usize| StationOffsets { outlines: vec![outline.clone()], ..StationOffsets::new("", 5.0 * k as f64) };
        OffsetTable { stations: (0..sections).map(station).collect(), ..OffsetTable::default() }
    }

    fn marked(table: &mut OffsetTable) -> Vec<usize> {
        mark(table, &mut Problems::new("points.csv"));
        let outline = &table.stations[0].outlines[0];
        (0..outline.len()).filter(|k| outline[*k].marks.knuckle).collect()
    }

    #[test]
    fn chines_between_straight_panels() {
        assert_eq!(marked(&mut table(5, &[(0.0, 0.0), (4.0, 1.0), (5.0, 6.0)])), [1]);
        let panels = [(0.0, 0.0), (2.0, 0.5), (4.0, 1.0), (4.3, 2.5), (4.6, 4.0), (5.0, 6.0)];
        assert_eq!(marked(&mut table(5, &panels)), [2]);
    }

    #[test]
    fn round_bilges_have_none() {
        let arc = |k: usize| {
            let angle = 0.5 * PI * k as f64 / 5.0;
            (4.0 + angle.sin(), 1.0 - angle.cos())
        };
        let mut points = vec![(0.0, 0.0), (2.0, 0.0)];
        points.extend((0..6).map(arc));
        points.extend([(5.0, 3.0), (5.0, 6.0)]);
        assert!(marked(&mut table(5, &points)).is_empty());
        assert!(marked(&mut table(2, &[(0.0, 0.0), (4.0, 1.0), (5.0, 6.0)])).is_empty());
    }
}
